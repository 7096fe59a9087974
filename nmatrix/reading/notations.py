"""The notations of matrices: what each looks like, who prints it, and if columns come first."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable
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
    where the text does not state one. What everybody can see, rows and lists, is not `told`.
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


def read(text: str, source: str) -> tuple[Notation, Contents]:
    """Read a text in the first notation whose sign it bears, after what it is assigned to.

    Raises
    ------
    IllegalValueError
        If it is none that is known, or is not what it begins as.

    Examples
    --------
    >>> read("float m[2][2] = {{1, 0}, {0, 1}};", "x")[0].name, read("1 0; 0 1", "x")[0].name
    ('braces', 'rows')
    """
    for candidate in (text, _DECLARATION.sub("", text, count=1)):
        found = _signed(candidate, NOTATIONS[:-1])
        if found is not None:
            return found, found.read(candidate, source)
    bracket = _BRACKET.search(candidate)
    if bracket is not None:
        *_, word = candidate[: bracket.end()][-LONGEST_WORD:].split() or [""]
        raise unreadable(source, f"{quoted(word)} begins no notation that is read")
    return NOTATIONS[-1], NOTATIONS[-1].read(candidate, source)


def has_no_brackets(text: str) -> bool:
    """Recognise the first line of a matrix without brackets: a frame, fields or a table.

    Examples
    --------
    >>> has_no_brackets("| 1 0 |"), has_no_brackets("e00: 1"), has_no_brackets("{e00: 1")
    (True, True, False)
    """
    found = _signed(text, NOTATIONS[:-1])
    if found is None or text.startswith("{"):
        return False
    return found.read in (rows.framed_rows, drawn.drawn_text, places.fields, places.csv_report)


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
    found = _signed(text[start:], _IN_BRACKETS)
    if found is None:
        return None
    end = closing(text, start)
    contents = found.read(in_one_word(text[start:end]), source)
    tokens = next(iter(contents.quantities.values()), [])
    return shaped_rows(tokens, found.layout, source), end


def _signed(text: str, among: Iterable[Notation]) -> Notation | None:
    for one in among:
        if one.sign.search(text):
            return one
    return None


_DECLARATION = re.compile(r"\A(?:[\w:<>*&\s]|\[[0-9]*\]){1,200}?(?:=|<<)\s*")
_BRACKET = re.compile(r"[\[\](){}<>]")
LONGEST_WORD = 40  # characters before a bracket that an error shows

NOTATIONS = (
    Notation(
        "three.js", "JSON.stringify of a Matrix3, a Matrix4, or what holds them",
        '{"elements":[1,0,0,2,3,0,0,0,4]}',
        re.compile(r"\A\{(?=\s*\").*?\"elements\"\s*:\s*\[", re.DOTALL),
        jsontext.json_notation, COLUMNS,
    ),
    Notation(
        "three.js's Matrix", "console.log of a Matrix3 or Matrix4",
        "Matrix3 {elements: (9) [1, 0, 0, 2, 3, 0, 0, 0, 4]}",
        re.compile(r"\A(?:_?Matrix[34]\s?)?\{\s*elements\s*:"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a typed array's JSON", "JSON.stringify of a Float32Array: gl-matrix, WebGL",
        '{"0":1,"1":0,"2":0,"3":2,"4":3,"5":0,"6":0,"7":0,"8":4}',
        re.compile(r"\A\{\s*[\"']?0[\"']?\s*:"), places.fields, COLUMNS,
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
        ".NET's fields", "System.Numerics.Matrix4x4, made for row vectors",
        "{ {M11:1 M12:2 M13:0} {M21:0 M22:3 M23:0} {M31:0 M32:0 M33:4} }",
        re.compile(r"\A[\s{]*[\"']?M11[\"']?\s?[:=]"), places.fields,
    ),
    Notation(
        "JSON", "nmatrix with -f json, and objects that hold lists of numbers by name",
        '{"normal_matrix": [[1, 2, 0], [0, 3, 0], [0, 0, 4]]}',
        re.compile(r"\A\{\s*(?:\"|\}|\Z)"), jsontext.json_notation, told=False,
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
        re.compile(r"\A(?:new\s+)?Float(?:16|32|64)Array\b"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "a console's array", "console.log of an array, in Chrome, Firefox and Safari",
        "(9) [1, 2, 0, 0, 3, 0, 0, 0, 4]",
        re.compile(r"\A(?:Array\s?)?\([0-9]{1,2}\)\s*\["), constructors.bracketed, told=False,
    ),
    Notation(
        "glam's Mat", "Rust's {:?} of Mat3, Mat4, Affine3A and their doubles",
        "Mat3 { x_axis: Vec3(1.0, 0.0, 0.0), y_axis: Vec3(2.0, 3.0, 0.0), "
        "z_axis: Vec3(0.0, 0.0, 4.0) }",
        re.compile(r"\AD?(?:Mat[234]|Affine[23])A?\s*\{"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "Godot's Basis", "print of a Basis or a Transform3D",
        "[X: (1, 0, 0), Y: (2, 3, 0), Z: (0, 0, 4), O: (0, 0, 0)]",
        re.compile(r"\A\[X:"), constructors.bracketed, COLUMNS,
    ),
    Notation(
        "CSS", "getComputedStyle(…).transform",
        "matrix3d(1, 0, 0, 0, 2, 3, 0, 0, 0, 0, 4, 0, 0, 0, 0, 1)",
        re.compile(r"\Amatrix3d\s*\("), constructors.bracketed, COLUMNS,
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
_IN_BRACKETS = tuple(
    one
    for one in NOTATIONS
    if one.read in (constructors.bracketed, places.fields, jsontext.json_notation)
    and one.name not in ("lists", "JSON")
)
