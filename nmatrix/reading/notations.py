"""The notations of matrices: what each looks like, who prints it, and if columns come first."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass

from nmatrix.enums import Layout
from nmatrix.errors import quantity, quoted
from nmatrix.reading import constructors, drawn, equations, jsontext, places, rows
from nmatrix.reading.brackets import closing
from nmatrix.reading.contents import Contents, Tokens, unreadable
from nmatrix.reading.literal import shaped_rows
from nmatrix.reading.roots import in_one_word

ROWS, COLUMNS = Layout.ROW_MAJOR, Layout.COLUMN_MAJOR


@dataclass(frozen=True)
class Notation:
    """One way to write a matrix.

    `sign` is what its texts begin with, or a word that others never hold; `layout` is its own,
    where the text does not state one, or that of its `flat` lists alone: nested ones show their
    rows. What everybody can see, rows and lists, is not `told`.
    `rounded` is what is to be said of numbers that were rounded to be printed.
    """

    name: str
    printed_by: str
    example: str
    sign: re.Pattern[str]
    read: Callable[[str, str], Contents]
    layout: Layout = ROWS
    told: bool = True
    rounded: str = ""
    flat: bool = False

    def shows_rows(self, tokens: Tokens) -> bool:
        """Whether everybody sees which numbers of a text are a row."""
        return not self.told or (self.flat and len(tokens) > 1 < len(tokens[0]))

    def layout_of(self, tokens: Tokens) -> Layout:
        """Choose the layout in which the numbers of a text in this notation are read."""
        return ROWS if self.shows_rows(tokens) else self.layout


def read(text: str, source: str) -> tuple[Notation, Contents]:
    """Read a text in the first notation whose sign it bears, after what stands before a matrix.

    Raises
    ------
    IllegalValueError
        If it is none that is known, or is not what it begins as.

    Examples
    --------
    >>> read("float m[2][2] = {{1, 0}, {0, 1}};", "x")[0].name, read("1 0; 0 1", "x")[0].name
    ('braces', 'rows')
    """
    candidate = text
    for candidate in _uncovered(text):
        found = _signed(candidate, NOTATIONS[:-1])
        if found is not None:
            return found, found.read(candidate, source)
    bracket = _BRACKET.search(candidate)
    if bracket is not None:
        *_, word = candidate[: bracket.end()][-LONGEST_WORD:].split() or [""]
        raise unreadable(source, f"{quoted(word)} begins no notation that is read")
    return NOTATIONS[-1], NOTATIONS[-1].read(candidate, source)


def has_no_end(text: str) -> bool:
    """Recognise the first line of a matrix that only an empty line ends: a frame, fields, a table.

    Examples
    --------
    >>> has_no_end("| 1 0 |"), has_no_end("e00: 1"), has_no_end("{e00: 1")
    (True, True, False)
    """
    return text.startswith(places.YAML_TAG) or _is_read_by(text, _WITHOUT_END)


def is_no_list(text: str) -> bool:
    """Recognise a matrix that says by other signs than brackets what its numbers are.

    Examples
    --------
    >>> is_no_list("[X=1 Y=0] [X=0 Y=1]"), is_no_list("| 1 0 |"), is_no_list("[1 0]")
    (True, True, False)
    """
    return _is_read_by(text, (*_WITHOUT_END, *_OF_OTHER_SIGNS))


def _is_read_by(text: str, readers: Sequence[Callable[[str, str], Contents]]) -> bool:
    found = _signed(text, NOTATIONS[:-1])
    return found is not None and not text.startswith("{") and found.read in readers


def value_at(text: str, start: int, source: str) -> tuple[Tokens, int] | None:
    """Read a matrix in brackets within a longer text, as rows, and find where it ends.

    The result is None where no notation but a plain list begins.

    Examples
    --------
    >>> value_at("det(mat2(1, 2, 3, 4)) + 1", 4, "x")
    ([('1', '3'), ('2', '4')], 20)
    """
    latex = equations.LATEX_MATRIX.match(text, start)
    if latex is not None:
        tokens, end = equations.LATEX.matrix(text, latex, source)
        return shaped_rows(tokens, ROWS, source), text.index("}", end) + 1
    found = _signed(text[start:], WITHIN_BRACKETS)
    if found is None:
        return None
    end = closing(text, start)
    contents = found.read(in_one_word(text[start:end]), source)
    tokens = next(iter(contents.likely), [])
    return shaped_rows(tokens, found.layout_of(tokens), source), end


def _uncovered(text: str) -> Iterator[str]:
    """Take off one name, declaration, heading or call after another, numbers never among them."""
    yield text
    if declared := _DECLARED.match(text):
        yield declared["type"] + text[declared.end() :].rstrip(_AFTER)
    for _ in range(MOST_COVERS):
        cover = next((found for one in _COVERS if (found := one.match(text))), None)
        if cover is None or _NUMBER.search(cover[0]):
            return
        text = text[cover.end() :].rstrip(_AFTER)
        yield text


def _signed(text: str, among: Iterable[Notation]) -> Notation | None:
    for one in among:
        if one.sign.search(text):
            return one
    return None


_DECLARED = re.compile(  # QMatrix4x4 m(
    r"(?:(?:static|const|constexpr)\s+)*(?P<type>(?:\w{1,30}::){0,2}[A-Za-z]\w{1,30})\s+\w{1,60}\s?"
    r"(?=\([+\-.0-9A-Za-z\s])"
)
_COVERS = (
    re.compile(r"(?:[\w:<>*&\s]|\[[0-9]*\]){1,200}?(?:=|<<)\s*[\"']?"),  # float m[4][4] =
    re.compile(r"(?:\w{1,30}::){0,2}[A-Z]\w{1,30}\s+\w{1,60}\s?(?=\{)"),  # Matrix3d m{
    re.compile(r"[\"']?-?[A-Za-z_][\w.\- ]{0,60}[\"']?\s?:(?!:)\s*"),  # transform:
    re.compile(r"(?:new\s+)?[\w.]{1,60}(?:\(\s*\))?\.(?=(?:set|fromArray)\s*\()"),  # m.set(
    re.compile(r"<tf\.[^\n]{1,80}numpy=\s*"),
    re.compile(r"[^\n\[\](){}<>|;,:=]{1,60}\n\s*"),  # a heading
    re.compile(
        r"[A-Za-z_][\w.]{0,60}\s+(?=[A-Z]\w{1,30}\s?[({]|\([0-9]{1,2}\)\s?\[)"
    ),  # a log's word
)
# A word may end in digits: mat4. Numbers in parentheses tell a size: shape=(4, 4).
_NUMBER = re.compile(r"(?<![^\s,;])[+\-−]?\.?[0-9](?![^()]{0,20}\))")
_AFTER = " \n\t;,\"'`>"
MOST_COVERS = 3  # a style of HTML: style="transform: matrix3d(…)"
_BRACKET = re.compile(r"[\[\](){}<>]")
LONGEST_WORD = 40  # characters before a bracket that an error shows

NOTATIONS = (
    Notation(
        "three.js", "JSON.stringify of a Matrix3, a Matrix4, or what holds them",
        '{"elements":[1,0,0,2,3,0,0,0,4]}',
        re.compile(r"\A(?:\{(?=\s*\").*?)?\"elements\"\s*:\s*\[", re.DOTALL),
        jsontext.json_notation, COLUMNS, flat=True,
    ),
    Notation(
        "glTF's matrix", "glTF nodes; JSON.stringify of three.js's objects",
        '{"matrix":[1,0,0,0,2,3,0,0,0,0,4,0,0,0,0,1]}',
        re.compile(r"\A(?:\{(?=\s*\").*?)?\"matrix\"\s*:\s*\[(?=[\s0-9.\-])", re.DOTALL),
        jsontext.json_notation, COLUMNS, flat=True,
    ),
    Notation(
        "three.js's Matrix", "console.log of a Matrix3 or Matrix4",
        "Matrix3 {elements: (9) [1, 0, 0, 2, 3, 0, 0, 0, 4]}",
        re.compile(r"\A(?:_?Matrix[34]\s?)?\{\s*elements\s*:"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a typed array's JSON", "JSON.stringify of a Float32Array: gl-matrix, WebGL",
        '{"0":1,"1":0,"2":0,"3":2,"4":3,"5":0,"6":0,"7":0,"8":4}',
        re.compile(r"\A(?:Float[0-9]{2}Array\s?\([0-9]{1,2}\)\s)?\{?\s{0,9}[\"']?0[\"']?\s?:"),
        places.fields, COLUMNS,
    ),
    Notation(
        "a DOMMatrix", "JSON.stringify of a DOMMatrix: its m12 stands in column 1",
        '{"a":1,"b":0,"c":2,"d":3,"e":0,"f":0,"m11":1,"m12":0,"m13":0,"m14":0,"m21":2,"m22":3,'
        '"m23":0,"m24":0,"m31":0,"m32":0,"m33":4,"m34":0,"m41":0,"m42":0,"m43":0,"m44":1}',
        re.compile(r"\A\{\s*\"a\":.{0,400}\"m11\":", re.DOTALL), places.fields, COLUMNS,
    ),
    Notation(
        "Unity's fields", "JsonUtility and YAML (e00 … e33), Json.NET (m00 … m33)",
        '{"e00":1,"e01":2,"e02":0,"e10":0,"e11":3,"e12":0,"e20":0,"e21":0,"e22":4}',
        re.compile(r"\A(?:[\"']?\w{1,60}[\"']?\s?[:=]?\s{0,9})?\{?\s{0,9}[\"']?[em]00[\"']?\s?[:=]"),
        places.fields,
    ),
    Notation(
        ".NET's fields", "Matrix4x4 of System.Numerics and SceneKit, made for row vectors",
        "{ {M11:1 M12:0 M13:0} {M21:2 M22:3 M23:0} {M31:0 M32:0 M33:4} }",
        re.compile(r"\A(?:SCNMatrix4|CATransform3D)?[\s{\[(]*[\"']?[Mm]11[\"']?\s?[:=]"),
        places.fields, COLUMNS,
    ),
    Notation(
        "Unreal's planes", "FMatrix, made for row vectors: its planes, its text, its JSON",
        "[X=1 Y=0 Z=0] [X=2 Y=3 Z=0] [X=0 Y=0 Z=4]",
        re.compile(r"\A(?:\[\s?X=|[({]\s*\"?XPlane\"?\s?[:=])"), places.planes, COLUMNS,
    ),
    Notation(
        "JSON", "nmatrix with -f json, and objects that hold lists of numbers by name",
        '{"normal_matrix": [[1, 2, 0], [0, 3, 0], [0, 0, 4]]}',
        re.compile(r"\A(?:\{\s*(?:\"|\}|\Z)|\"\w{1,60}\"\s*:\s*\[)"),
        jsontext.json_notation, told=False,
    ),
    Notation(
        "CSV report", "nmatrix with -f csv",
        "key,row,column,value\na,0,0,1\na,0,1,2\na,0,2,0\na,1,0,0\na,1,1,3\na,1,2,0\n"
        "a,2,0,0\na,2,1,0\na,2,2,4",
        places.HEADER, places.csv_report, told=False,
    ),
    Notation(
        "LaTeX", "nmatrix with -f latex or markdown, SymPy's latex(), papers",
        r"\begin{pmatrix} 1 & 2 & 0 \\ 0 & 3 & 0 \\ 0 & 0 & 4 \end{pmatrix}",
        equations.LATEX_MATRIX, equations.LATEX.read, told=False,
    ),
    Notation(
        "MathML", "nmatrix with -f mathml, pages, Pandoc",
        "<mtable><mtr><mtd><mn>1</mn></mtd><mtd><mn>2</mn></mtd><mtd><mn>0</mn></mtd></mtr>"
        "<mtr><mtd><mn>0</mn></mtd><mtd><mn>3</mn></mtd><mtd><mn>0</mn></mtd></mtr>"
        "<mtr><mtd><mn>0</mn></mtd><mtd><mn>0</mn></mtd><mtd><mn>4</mn></mtd></mtr></mtable>",
        re.compile(r"<mtable\b"), equations.MATHML.read, told=False,
    ),
    Notation(
        "Typst", "nmatrix with -f typst, papers",
        "mat(1, 2, 0; 0, 3, 0; 0, 0, 4)",
        equations.TYPST_MATRIX, equations.TYPST.read, told=False,
    ),
    Notation(
        "JavaScript program", "nmatrix with -f js, scripts that declare a list",
        "const m = [[1, 2, 0], [0, 3, 0], [0, 0, 4]];",
        constructors.JS_DECLARED, constructors.js_program, told=False,
    ),
    Notation(
        "NumPy program", "nmatrix with -f numpy, Python with np.array",
        "M = np.array([[1, 2, 0], [0, 3, 0], [0, 0, 4]])",
        constructors.NUMPY_DECLARED, constructors.numpy_program, told=False,
    ),
    Notation(
        "GLSL program", "nmatrix with -f glsl, shaders that declare a matrix",
        "const mat3 m = mat3(1.0, 0.0, 0.0, 2.0, 3.0, 0.0, 0.0, 0.0, 4.0);",
        constructors.GLSL_DECLARED, constructors.glsl_program, COLUMNS,
    ),
    Notation(
        "GLSL, GLM or WGSL", "shaders, glm::to_string, PyGLM's repr, gl-matrix's str",
        "mat3x3((1, 0, 0), (2, 3, 0), (0, 0, 4))",
        re.compile(r"\A(?:glm(?:::|\.))?(?:[a-z]{0,3}[0-9]{0,2}mat[234]|[diub]?vec[234])"),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a typed array", "console.log of a Float32Array: gl-matrix, WebGL",
        "Float32Array(9) [1, 0, 0, 2, 3, 0, 0, 0, 4]",
        re.compile(r"\A(?:(?:new\s+)?Float(?:16|32|64)Array|fromArray)\b"),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a console's array", "console.log of an array, in Chrome, Firefox and Safari",
        "(9) [1, 2, 0, 0, 3, 0, 0, 0, 4]",
        re.compile(r"\A(?:Array\s?)?\([0-9]{1,2}\)\s*\["), constructors.bracketed, told=False,
    ),
    Notation(
        "a Mat of Rust", "{:?} of glam's Mat3, Mat4, Affine3A and of cgmath's Matrix4",
        "Mat3 { x_axis: Vec3(1.0, 0.0, 0.0), y_axis: Vec3(2.0, 3.0, 0.0), "
        "z_axis: Vec3(0.0, 0.0, 4.0) }",
        re.compile(r"\A(?:D?(?:Mat[234]|Affine[23])A?\s*\{|Matrix[234] \[\[)"),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "Godot's print", "print of a Basis or a Transform3D; what is made of its Vector3",
        "[X: (1, 0, 0), Y: (2, 3, 0), Z: (0, 0, 4), O: (0, 0, 0)]",
        re.compile(r"\A(?:\[X:|(?:Transform3D|Transform|Basis)\s*\(\s*(?:Vector|Basis)|Projection\s*\()"),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "Godot's scene file", "Transform3D: the rows of its basis, then its origin; Basis",
        "Transform3D(1, 2, 0, 0, 3, 0, 0, 0, 4, 0, 0, 0)",
        re.compile(r"\A(?:Transform3D|Basis|Transform(?=\s*\((?:[^,()]{1,60},){11}))\s*\("),
        constructors.bracketed,
    ),
    Notation(
        "CSS", "transform, getComputedStyle; matrix(…) of six numbers in SVG too",
        "matrix3d(1, 0, 0, 0, 2, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1)",
        re.compile(r"\Amatrix(?:3d\s*\(|\s*\(\s*[+\-.0-9])"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "Qt's QMatrix4x4", "qDebug, and C++ that makes one",
        "QMatrix4x4(1, 2, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1)",
        re.compile(r"\AQMatrix[34]x[34]\s*\(\s*(?:type:[\w,]{1,60}\s*)?[+\-.0-9]"),
        constructors.bracketed,
    ),
    Notation(
        "three.js's set", "JavaScript with Matrix3 and Matrix4; Bullet's btMatrix3x3",
        "new THREE.Matrix3().set(1, 2, 0, 0, 3, 0, 0, 0, 4)",
        re.compile(r"\A(?:(?:new\s+)?THREE\.Matrix[34]|set|btMatrix3x3)\s*\(\s*[+\-.0-9]"),
        constructors.bracketed,
    ),
    Notation(
        "Eigen's <<", "C++ that fills a matrix row by row",
        "Eigen::Matrix3d m; m << 1, 2, 0, 0, 3, 0, 0, 0, 4;",
        re.compile(
            r"\A(?:[\w:<>,]{1,60}\s+\w{1,60}\s*;\s*)?\w[\w.>\[\]\-]{0,60}\s*<<\s*[+\-−.0-9]"
        ),
        rows.streamed_rows,
    ),
    Notation(
        "a matrix for row vectors",
        "DirectXMath, .NET's Matrix4x4, USD's Matrix4d, Maya's MMatrix, Unreal's FMatrix, Babylon",
        "XMFLOAT3X3(1, 0, 0, 2, 3, 0, 0, 0, 4)",
        re.compile(
            r"\A(?:(?:new|uniform|custom)\s+)?(?:DirectX::|Gf\.|om\.|imath\.)?"
            r"(?:XMMATRIX|XMMatrixSet|XMFLOAT[34]X[34]A?|Matrix4x4|Matrix[34][df]|matrix[34]d|MMatrix"
            r"|LMatrix[34][fd]?|M[34]{2}[fd]|FMatrix|(?:BABYLON\.)?Matrix\.FromValues)"
            r"\s*\(\s*\(*\s*(?:[+\-.0-9]|FPlane|XMVectorSet)"
        ),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a declaration for row vectors", "usda files with matrix4d, C++ with XMMATRIX, XMFLOAT4X4",
        "matrix3d m = ( (1, 0, 0), (2, 3, 0), (0, 0, 4) )",
        re.compile(
            r"\A(?:(?:uniform|custom|static|const|constexpr|DirectX::)\s*)*+"
            r"(?:matrix[234]d|XMMATRIX|XMFLOAT[34]X[34]A?)\s[\w:]{1,60}\s?=?\s?[({]"
        ),
        constructors.declared, COLUMNS,
    ),
    Notation(
        "Unity's constructor", "C# that makes a Matrix4x4 of its columns",
        "new Matrix4x4(new Vector4(1, 0, 0, 0), new Vector4(2, 3, 0, 0), new Vector4(0, 0, 4, 0), "
        "new Vector4(0, 0, 0, 1))",
        re.compile(r"\A(?:new\s+)?Matrix4x4\s*\(\s*(?:new\s+)?Vector4"),
        constructors.bracketed, COLUMNS,
    ),
    Notation(
        "OpenCV's YAML", "FileStorage, and the camera files of ROS",
        "!!opencv-matrix\n   rows: 3\n   cols: 3\n   dt: d\n"
        "   data: [ 1., 2., 0., 0., 3., 0., 0., 0., 4. ]",
        places.YAML, places.yaml_matrix,
    ),
    Notation(
        "an element of XML", "COLLADA's matrix; Mitsuba's",
        "<matrix>1 2 0 0 0 3 0 0 0 0 4 0 0 0 0 1</matrix>",
        re.compile(r"\A<matrix\b"), rows.element_rows,
    ),
    Notation(
        "Swift's simd", "Swift's print of a simd matrix",
        "simd_float3x3([[1.0, 0.0, 0.0], [2.0, 3.0, 0.0], [0.0, 0.0, 4.0]])",
        re.compile(r"\Asimd_(?:float|double|half)[234]x[234]"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "HLSL", "shaders, Unity.Mathematics; Metal's float4x4 takes columns instead",
        "float3x3(1, 2, 0, 0, 3, 0, 0, 0, 4)",
        re.compile(r"\A(?:min16)?(?:float|half|double|int|uint)[234]x[234]\s*\("),
        constructors.bracketed,
    ),
    Notation(
        "Blender's Matrix", "Matrix in its console and in scripts",
        "<Matrix 3x3 (1.0000, 2.0000, 0.0000)\n"
        "            (0.0000, 3.0000, 0.0000)\n            (0.0000, 0.0000, 4.0000)>",
        re.compile(r"\A(?:<Matrix |(?:mathutils\.)?Matrix\(\s*\(\s*\()"), constructors.bracketed,
    ),
    Notation(
        "SymPy's Matrix", "str and repr of a Matrix; Maple",
        "Matrix([[1, 2, 0], [0, 3, 0], [0, 0, 4]])",
        re.compile(r"\A(?:sympy\.|sp\.)?(?:Immutable|Mutable)?(?:Dense)?Matrix\(\s*\["),
        constructors.bracketed,
    ),
    Notation(
        "a tensor", "print of a tensor",
        "tensor([[1., 2., 0.],\n        [0., 3., 0.],\n        [0., 0., 4.]], dtype=torch.float64)",
        re.compile(r"\A(?:torch\.|tf\.)?[tT]ensor\s*\("), constructors.bracketed,
    ),
    Notation(
        "a NumPy array", "repr of an array or a matrix, also JAX's",
        "array([[1., 2., 0.],\n       [0., 3., 0.],\n       [0., 0., 4.]], dtype=float32)",
        re.compile(r"\A(?:j?np\.|numpy\.)?(?:array|matrix|asarray|Array)\s*\("),
        constructors.bracketed, told=False,
    ),
    Notation(
        "Mathematica's CForm", "Mathematica's CForm",
        "List(List(1,2,0),List(0,3,0),List(0,0,4))",
        re.compile(r"\AList\s*\("), constructors.bracketed,
    ),
    Notation(
        "braces", "C, C++, C#, Mathematica",
        "{{1.0f, 2.0f, 0.0f}, {0.0f, 3.0f, 0.0f}, {0.0f, 0.0f, 4.0f}}",
        re.compile(r"\A\{\s*[{+\-−.0-9]"), constructors.bracketed,
    ),
    Notation(
        "a matrix of R", "print of a matrix",
        "[,1] [,2] [,3]\n[1,]    1    2    0\n[2,]    0    3    0\n[3,]    0    0    4",
        re.compile(r"\A\[,1\]"), rows.framed_rows,
    ),
    Notation(
        "a drawing", "nmatrix as text",
        "⎡ 1  2  0 ⎤\n⎢ 0  3  0 ⎥\n⎣ 0  0  4 ⎦",
        drawn.DRAWING, drawn.drawn_text, told=False,
        rounded="Read as it is drawn, to the digits shown: "
        f"{quantity('format')} json has all of them.",
    ),
    Notation(
        "rows in a frame", "cglm, SymPy's pretty, nalgebra, Julia",
        "| 1 2 0 |\n| 0 3 0 |\n| 0 0 4 |",
        re.compile(r"\A(?:[|│┃┌⎡⎛]|Matrix \(float[234]x|[234]×[234] )"), rows.framed_rows,
    ),
    Notation(
        "lists", "Python, NumPy, MATLAB, Julia, JavaScript, Eigen",
        "[[1, 2, 0], [0, 3, 0], [0, 0, 4]]",
        re.compile(r"\A(?:(?:Float|Int)[0-9]{2})?[\[(]"), constructors.bracketed, told=False,
    ),
    Notation(
        "rows", "people, MATLAB, Eigen, JOML, Unity's tabs, spreadsheets",
        "1 2 0; 0 3 0; 0 0 4",
        re.compile(r""), rows.bare_rows, told=False,
    ),
)  # fmt: skip
# Inside of an expression a list is an expression itself, and a report is not a value.
WITHIN_BRACKETS = tuple(
    one
    for one in NOTATIONS
    if one.read in (constructors.bracketed, places.fields, jsontext.json_notation)
    and one.name not in ("lists", "JSON")
)
_WITHOUT_END = (
    drawn.drawn_text,
    places.csv_report,
    places.fields,
    places.yaml_matrix,
    rows.framed_rows,
)
_OF_OTHER_SIGNS = (constructors.declared, places.planes, rows.element_rows, rows.streamed_rows)
