"""Every notation of the table is read as itself; what is cut, folded or unknown is refused."""

from __future__ import annotations

import json
import random
from collections.abc import Callable, Iterator
from pathlib import Path

import numpy as np
import pytest
from counted import at_most
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.calculator.evaluate import calculate
from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.reading.constructors import bracketed
from nmatrix.reading.literal import as_affine
from nmatrix.reading.matrix import matrix_literal
from nmatrix.reading.notations import NOTATIONS, WITHIN_BRACKETS, Notation

Matrix = list[list[float]]
Writer = Callable[[Matrix], str]

DOCS = Path(__file__).parents[2] / "docs" / "command-line.md"
M: Matrix = [[(-1) ** (r + c) * (4 * r + c + 1) / 4 for c in range(4)] for r in range(4)]
EXAMPLE = as_affine(matrix_literal("1 2 0; 0 3 0; 0 0 4")).rows


def columns(m: Matrix) -> Matrix:
    return [list(column) for column in zip(*m, strict=True)]


def flat(m: Matrix) -> list[float]:
    return [entry for row in m for entry in row]


def joined(entries: list[float], comma: str = ", ", form: str = "g") -> str:
    return comma.join(format(entry, form) for entry in entries)


def nested(m: Matrix, pair: str, head: str = "", form: str = "g", between: str = ", ") -> str:
    """Write rows in brackets, a word before each, without the outer bracket."""
    return between.join(f"{head}{pair[0]}{joined(row, form=form)}{pair[1]}" for row in m)


def glam(m: Matrix) -> str:
    axes = zip("xyzw", columns(m), strict=True)
    fields = (f"{axis}_axis: Vec4({joined(column, form='.2f')})" for axis, column in axes)
    return f"Mat4 {{ {', '.join(fields)} }}"


def glam_in_lines(m: Matrix) -> str:
    axes = zip("xyzw", columns(m), strict=True)
    fields = (
        f"    {axis}_axis: Vec4(\n        " + joined(column, ",\n        ", ".2f") + ",\n    ),\n"
        for axis, column in axes
    )
    return f"Mat4 {{\n{''.join(fields)}}}"


def places(m: Matrix, first: int) -> Iterator[tuple[str, float]]:
    for r, row in enumerate(m):
        for c, entry in enumerate(row):
            yield f"{r + first}{c + first}", entry


def report_rows(m: Matrix) -> str:
    lines = [f"M,{r},{c},{entry}\n" for r, row in enumerate(m) for c, entry in enumerate(row)]
    return "key,row,column,value\n" + "".join(lines)


def wrapped(entries: list[float], width: int) -> str:
    """Write a list as Node does, so many to a line."""
    lines = [joined(entries[at : at + width]) for at in range(0, len(entries), width)]
    return "[\n  " + ",\n  ".join(lines) + "\n]"


def mathml_table(m: Matrix) -> str:
    rows = (
        "".join(
            "<mtd>" + ("<mo>−</mo>" if entry < 0 else "") + f"<mn>{abs(entry):g}</mn></mtd>"
            for entry in row
        )
        for row in m
    )
    return f"<mtable>{''.join(f'<mtr>{row}</mtr>' for row in rows)}</mtable>"


def decimal_commas(m: Matrix, between: str) -> str:
    return "\n".join(between.join(format(x, ".5f").replace(".", ",") for x in row) for row in m)


def godot(m: Matrix) -> str:
    """Write the rows of three columns, then the fourth column, as a scene file does."""
    return f"Transform3D({joined(flat([row[:3] for row in m]) + [row[3] for row in m])})"


def planes(m: Matrix, form: str, between: str) -> str:
    """Write the columns as rows whose entries are named, as Unreal does with W first or last."""
    rows = [dict(zip("xyzw", column, strict=True)) for column in columns(m)]
    return between.join(form.format(**row) for row in rows)


def yaml(m: Matrix, head: str) -> str:
    return f"{head}\n  rows: {len(m)}\n  cols: {len(m[0])}\n  data: [ {joined(flat(m))} ]"


WRITERS: dict[str, list[Writer]] = {
    "three.js": [
        lambda m: json.dumps({"elements": flat(columns(m))}),
        lambda m: json.dumps({"uuid": "1-2", "matrixWorld": {"elements": flat(columns(m))}}),
    ],
    "glTF's matrix": [
        lambda m: json.dumps({"matrix": flat(columns(m))}),
        lambda m: json.dumps(
            {"name": "arm", "mesh": 0, "matrix": flat(columns(m)), "children": [1, 2]}, indent=2
        ),
        lambda m: json.dumps(
            {"asset": {"version": "2.0"}, "nodes": [{"name": "a"}, {"matrix": flat(columns(m))}]}
        ),
        lambda m: json.dumps({"object": {"up": [0, 1, 0], "matrix": flat(columns(m))}}),
        lambda m: f'"matrix": {json.dumps(flat(columns(m)))}',
        lambda m: f'"matrix": {json.dumps(flat(columns(m)))},',
    ],
    "three.js's Matrix": [
        lambda m: f"_Matrix4 {{elements: (16) [{joined(flat(columns(m)))}]}}",
        lambda m: f"Matrix4 {{\n  elements: {wrapped(flat(columns(m)), 6)}\n}}",
    ],
    "a typed array's JSON": [
        lambda m: json.dumps({str(i): entry for i, entry in enumerate(flat(columns(m)))}),
        lambda m: "{" + ", ".join(f"{i}: {x}" for i, x in enumerate(flat(columns(m)))) + "}",
        lambda m: "Float32Array(16)\n"  # unfolded in a console
        + "".join(f"{i}: {x}\n" for i, x in enumerate(flat(columns(m))))
        + "byteLength: 64\nlength: 16\n[[Prototype]]: TypedArray",
    ],
    "a DOMMatrix": [
        lambda m: json.dumps(
            {"a": m[0][0], "b": m[1][0], "c": m[0][1], "d": m[1][1], "e": m[0][3], "f": m[1][3]}
            | {f"m{place}": entry for place, entry in places(columns(m), 1)}
            | {"is2D": False, "isIdentity": False},
            separators=(",", ":"),
        )
    ],
    "Unity's fields": [
        lambda m: json.dumps({f"e{place}": entry for place, entry in places(m, 0)}),
        lambda m: json.dumps({f"m{place}": entry for place, entry in places(m, 0)}, indent=2),
        lambda m: "m_M:\n" + "".join(f"  e{place}: {entry}\n" for place, entry in places(m, 0)),
        lambda m: ", ".join(f"m{place} = {entry}f" for place, entry in places(m, 0)),
    ],
    ".NET's fields": [  # of the transpose, which is made for row vectors
        lambda m: "{ "
        + " ".join(
            "{" + " ".join(f"M{r + 1}{c + 1}:{x}" for c, x in enumerate(row)) + "}"
            for r, row in enumerate(columns(m))
        )
        + " }",
        lambda m: json.dumps({f"M{place}": entry for place, entry in places(columns(m), 1)}),
        lambda m: " ".join(  # SharpDX
            "[" + " ".join(f"M{r}{c}:{x}" for c, x in enumerate(row, 1)) + "]"
            for r, row in enumerate(columns(m), 1)
        ),
        lambda m: "SCNMatrix4("
        + ", ".join(f"m{place}: {x}" for place, x in places(columns(m), 1))
        + ")",
    ],
    "Unreal's planes": [
        lambda m: planes(m, "[X={x:.3f} Y={y:.3f} Z={z:.3f} W={w:.3f}]", " "),
        lambda m: f"(X{planes(m, 'Plane=(W={w},X={x},Y={y},Z={z})', ',Y')})",
        lambda m: "{"
        + ",".join(
            f'"{axis}Plane":' + json.dumps(dict(zip("XYZW", column, strict=True)))
            for axis, column in zip("XYZW", columns(m), strict=True)
        )
        + "}",
    ],
    "JSON": [lambda m: json.dumps({"world_from_object": m, "remarks": []})],
    "CSV report": [report_rows],
    "LaTeX": [
        lambda m: r"\begin{bmatrix}"
        + r" \\ ".join(joined(row, " & ") for row in m)
        + r"\end{bmatrix}",
        lambda m: "$$\\begin{pmatrix}\n"
        + "\\\\\n".join(joined(row, "&") for row in m)
        + "\n\\end{pmatrix}$$",
        lambda m: r"\left( \begin{array}{cccc} "  # Mathematica's TeXForm
        + r" \\ ".join(joined(row, " & ") for row in m)
        + r" \end{array} \right)",
        lambda m: r"\left[\begin{matrix}"  # SymPy's latex()
        + r"\\".join(joined(row, " & ") for row in m)
        + r"\end{matrix}\right]",
    ],
    "MathML": [
        lambda m: f"<math>{mathml_table(m)}</math>",
        lambda m: "<math display='block'><mi>M</mi><mo>=</mo><mfenced open='['>"
        + mathml_table(m).replace("<mn>", "<mstyle><mn>").replace("</mn>", "</mn></mstyle>\n")
        + "</mfenced></math>",
    ],
    "Typst": [
        lambda m: f"mat({'; '.join(joined(row) for row in m)})",
        lambda m: f'$ M = mat(delim: "[",\n  {"; ".join(joined(row) for row in m)}) $',
        lambda m: f'mat(delim: "(", {";".join(joined(row, ",") for row in m)};)',
        lambda m: f"$mat(delim: #none, {'; '.join(joined(row) for row in m)})$",
    ],
    "JavaScript program": [
        lambda m: f"const m = [{nested(m, '[]')}];",
        lambda m: f"var n = 3\nlet m = [\n  {nested(m, '[]', between=',' + chr(10))},\n];",
    ],
    "NumPy program": [
        lambda m: f"M = np.array([{nested(m, '[]')}])",
        lambda m: f"import numpy as np\nM = numpy.matrix([{nested(m, '[]')}], dtype=float)\n",
    ],
    "GLSL program": [
        lambda m: f"uniform mat4 m = mat4({joined(flat(columns(m)))});",
        lambda m: f"const mat4 m = mat4({nested(columns(m), '()', 'vec4')});",
        lambda m: f"glm::mat4 m = glm::mat4({joined(flat(columns(m)), form='.4f')});",
    ],
    "GLSL, GLM or WGSL": [
        lambda m: f"mat4x4({nested(columns(m), '()', form='f')})",  # glm::to_string
        lambda m: f"dmat4x4({nested(columns(m), '()', form='f')})",
        lambda m: f"mat4x4({nested(columns(m), '()').replace('(', '( ').replace(')', ' )')})",
        lambda m: f"mat4({joined(flat(columns(m)))})",  # gl-matrix's mat4.str
        lambda m: f"mat4(\n  {nested(columns(m), '()', 'vec4', between=',' + chr(10))})",
        lambda m: f"mat4x4<f32>({nested(columns(m), '()', 'vec4<f32>')})",
        lambda m: f"mat4x4f({nested(columns(m), '()', 'vec4f')})",
    ],
    "a typed array": [
        lambda m: f"Float32Array(16) [{joined(flat(columns(m)))}]",
        lambda m: f"Float64Array(16) {wrapped(flat(columns(m)), 6)}",
        lambda m: f"Float32Array [ {joined(flat(columns(m)))} ]",
        lambda m: f"new Float32Array([{joined(flat(columns(m)))}])",
        lambda m: f"const m = new Float32Array([{joined(flat(columns(m)))}]);",
        lambda m: f"new THREE.Matrix4().fromArray([{joined(flat(columns(m)))}])",
        lambda m: f"modelMatrix Float32Array(16) [{joined(flat(columns(m)))}]",  # with a word
    ],
    "a console's array": [
        lambda m: f"(16) [{joined(flat(m))}]",
        lambda m: f"Array(16) [ {joined(flat(m))} ]",
    ],
    "a Mat of Rust": [
        glam,
        glam_in_lines,
        lambda m: "D" + glam(m).replace("Vec4", "DVec4"),
        lambda m: f"Matrix4 [{nested(columns(m), '[]', form='.2f')}]",  # cgmath
    ],
    "Godot's print": [
        lambda m: "[X: ({}), Y: ({}), Z: ({}), O: ({})]".format(*map(joined, columns(m))),
        lambda m: f"Transform3D({nested(columns(m), '()', 'Vector3')})",
        lambda m: f"Transform3D(Basis({nested(columns(m)[:3], '()', 'Vector3')}), "
        f"Vector3({joined(columns(m)[3])}))",
    ],
    "Godot's scene file": [godot, lambda m: f"transform = {godot(m)}"],
    "CSS": [
        lambda m: f"matrix3d({joined(flat(columns(m)))})",
        lambda m: f"matrix3d({joined(flat(columns(m)), ',')});",
        lambda m: f"transform: matrix3d({joined(flat(columns(m)))});",
        lambda m: f"  -webkit-transform : matrix3d({joined(flat(columns(m)))})",
        lambda m: f'style="transform: matrix3d({joined(flat(columns(m)))})"',
    ],
    "Qt's QMatrix4x4": [
        lambda m: f"QMatrix4x4({joined(flat(m))})",
        lambda m: "QMatrix4x4(type:Translation,Scale\n"
        + "".join(f"{joined(row, '     ')}\n" for row in m)
        + ")",
        lambda m: f"QMatrix4x4 m({joined(flat(m))});",
        lambda m: f"const QMatrix4x4 view = QMatrix4x4({joined(flat(m), 'f, ', '.2f')}f);",
    ],
    "three.js's set": [
        lambda m: f"new THREE.Matrix4({joined(flat(m))})",
        lambda m: f"new THREE.Matrix4().set({joined(flat(m))});",
        lambda m: f"mesh.matrix.set(\n  {nested(m, '  ', between=','+ chr(10))}\n);",
    ],
    "Eigen's <<": [
        lambda m: f"m << {joined(flat(m))};",
        lambda m: f"Eigen::Matrix4f m; m << {joined(flat(m))};",
        lambda m: f"Matrix4d pose;\npose << {nested(m, '  ', between=',' + chr(10))};",
    ],
    "a matrix for row vectors": [
        lambda m: f"XMMATRIX({joined(flat(columns(m)))})",
        lambda m: f"DirectX::XMMatrixSet({joined(flat(columns(m)), 'f, ', '.2f')}f)",
        lambda m: f"XMFLOAT4X4({joined(flat(columns(m)))})",
        lambda m: f"var m = new Matrix4x4({joined(flat(columns(m)), 'f, ', '.2f')}f);",
        lambda m: f"Gf.Matrix4d({joined(flat(columns(m)))})",
        lambda m: f"om.MMatrix(({nested(columns(m), '()')}))",
        lambda m: f"BABYLON.Matrix.FromValues({joined(flat(columns(m)))})",
        lambda m: f"FMatrix({nested(columns(m), '()', 'FPlane')})",
        lambda m: f"FMatrix View({nested(columns(m), '()', 'FPlane')});",
        lambda m: f"XMMATRIX({nested(columns(m), '()', 'XMVectorSet', '.2f')})",
    ],
    "a declaration for row vectors": [
        lambda m: f"matrix4d xformOp:transform = ( {nested(columns(m), '()')} )",
        lambda m: f"static const XMFLOAT4X4 m = {{ {joined(flat(columns(m)), 'f, ', '.2f')}f }};",
        lambda m: f"DirectX::XMMATRIX m{{{joined(flat(columns(m)))}}};",
    ],
    "Unity's constructor": [
        lambda m: f"new Matrix4x4({nested(columns(m), '()', 'new Vector4')})",
        lambda m: f"Matrix4x4 m = new Matrix4x4({nested(columns(m), '()', 'new Vector4')});",
    ],
    "OpenCV's YAML": [
        lambda m: yaml(m, "camera_matrix: !!opencv-matrix").replace("data:", "dt: d\n  data:"),
        lambda m: yaml(m, "!!opencv-matrix"),
        lambda m: yaml(m, "projection_matrix:"),
    ],
    "an element of XML": [
        lambda m: f'<matrix sid="transform">{joined(flat(m), " ")}</matrix>',
        lambda m: f'<matrix value="{joined(flat(m), " ")}"/>',
        lambda m: "<matrix>\n" + "\n".join(joined(row, " ") for row in m) + "\n</matrix>",
    ],
    "Swift's simd": [lambda m: f"simd_float4x4([{nested(columns(m), '[]', form='.2f')}])"],
    "HLSL": [
        lambda m: f"float4x4({joined(flat(m))})",
        lambda m: f"float4x4({nested(m, '()', 'float4')})",
        lambda m: f"float4x4 m = float4x4({joined(flat(m), form='.3f')});",
        lambda m: f"float4x4({joined(flat(m), 'f, ', '.2f')}f)",  # Unity.Mathematics
    ],
    "Blender's Matrix": [
        lambda m: f"<Matrix 4x4 {nested(m, '()', form='.4f', between=chr(10) + ' ' * 12)}>",
        lambda m: f"Matrix(({nested(m, '()')}))",
        lambda m: f"M = mathutils.Matrix(({nested(m, '()')}))",
    ],
    "SymPy's Matrix": [
        lambda m: f"Matrix([{nested(m, '[]')}])",
        lambda m: f"Matrix([\n{nested(m, '[]', between=',' + chr(10))}])",
        lambda m: f"ImmutableDenseMatrix([{nested(m, '[]')}])",
    ],
    "a tensor": [
        lambda m: f"tensor([{nested(m, '[]', form='.4f', between=',' + chr(10) + ' ' * 8)}])",
        lambda m: f"tensor([{nested(m, '[]')}], device='cuda:0', dtype=torch.float64)",
        lambda m: f"tensor([{nested(m, '[]')}], grad_fn=<MulBackward0>)",
        lambda m: f"tensor([{nested(m, '[]')}], requires_grad=True)",
        lambda m: f"tensor([[{nested(m, '[]')}]])",  # a batch of one
    ],
    "a NumPy array": [
        lambda m: f"array([{nested(m, '[]', between=',' + chr(10) + ' ' * 7)}])",
        lambda m: f"np.array([{nested(m, '[]')}], dtype=np.float32)",
        lambda m: f"matrix([{nested(m, '[]')}])",
        lambda m: f"Array([{nested(m, '[]')}], dtype=float32)",  # JAX
        lambda m: f"array([[[{nested(m, '[]')}]]])",
        lambda m: f"<tf.Tensor: shape=(4, 4), dtype=float32, numpy=\narray([{nested(m, '[]')}])>",
    ],
    "Mathematica's CForm": [lambda m: f"List({nested(m, '()', 'List').replace(', ', ',')})"],
    "braces": [
        lambda m: f"{{{nested(m, '{}')}}}",
        lambda m: "float m[4][4] = { "
        + ", ".join(f"{{{joined(row, 'f, ', '.2f')}f}}" for row in m)
        + " };",
        lambda m: f"{{{joined(flat(m), 'f, ', '.2f')}f}}",
        lambda m: f"const double m[16] = {{{joined(flat(m))}}};",
        lambda m: f"{{{nested([[100 * x for x in row] for row in m], '{}', form='.1f')}}}".replace(
            ".0", ".*^-2"
        ),
    ],
    "a matrix of R": [
        lambda m: "      [,1]  [,2]  [,3]  [,4]\n"
        + "\n".join(f"[{r},] {joined(row, '  ')}" for r, row in enumerate(m, 1)),
    ],
    "a drawing": [
        lambda m: "M = "  # as formulas are drawn
        + "\n    ".join(
            f"{left} {joined(row, '  ')} {right}"
            for row, left, right in zip(m, "⎡⎢⎢"[: len(m) - 1] + "⎣", "⎤⎥⎥⎦", strict=False)
        ),
        lambda m: "M\n"
        + "\n".join(
            f"  {left} {joined(row, '  ')} {right}"
            for row, left, right in zip(m, "⎡⎢⎢"[: len(m) - 1] + "⎣", "⎤⎥⎥⎦", strict=False)
        ),
        lambda m: "M: its columns are x y z t\n      x  y  z  t\n"
        + "\n".join(f"  {'xyzw'[at]} [ {joined(row, '  ')} ]" for at, row in enumerate(m)),
    ],
    "rows in a frame": [
        lambda m: "\n".join(f"|{joined(row, '  ')}|" for row in m),
        lambda m: "Matrix (float4x4): \x1b[36m\n"  # cglm
        + "".join(f"  | {joined(row, '  ', '.5f')}  |\n" for row in m)
        + "\x1b[0m\n",
        lambda m: "  ┌       ┐\n"  # nalgebra
        + "".join(f"  │ {joined(row, ' ')} │\n" for row in m)
        + "  └       ┘\n",
        lambda m: "\n⎢    ⎥\n".join(  # SymPy's pretty
            f"{left}{joined(row, '  ')}{right}"
            for row, left, right in zip(m, "⎡⎢⎢⎣", "⎤⎥⎥⎦", strict=True)
        ),
        lambda m: "4×4 Matrix{Float64}:\n" + "\n".join(f" {joined(row, '  ')}" for row in m),
        lambda m: "4×4 StaticArrays.SMatrix{4, 4, Float64, 16} with indices SOneTo(4)×SOneTo(4):\n"
        + "\n".join(f" {joined(row, '  ')}" for row in m),
    ],
    "lists": [
        lambda m: f"[{nested(m, '[]')}]",
        lambda m: f"({nested(m, '()')})",
        lambda m: nested(m, "()"),
        lambda m: nested(m, "[]", between="\n"),  # Sage, Eigen's clean format
        lambda m: f"[{'; '.join(joined(row, ' ') for row in m)}]",
        lambda m: f"[{chr(10).join(joined(row, ' ') for row in m)}]",
        lambda m: f"m = [{'; '.join(joined(row, ', ') for row in m)}];",
        lambda m: "\n".join(f"[ {joined(row, ' | ')} ]" for row in m),  # PyGLM's str
        lambda m: f"[{joined(flat(m))}] (16)",  # Safari
        lambda m: f"Float64[{'; '.join(joined(row, ' ') for row in m)}]",  # Julia
        lambda m: str([[np.float64(entry) for entry in row] for row in m]),
        lambda m: str([[np.float32(entry) for entry in row] for row in m]),
        lambda m: f"[{nested(m, '[]').replace(',', '')}]",  # NumPy's str
        lambda m: f"modelMatrix: [{nested(m, '[]')}]",
        lambda m: "Matrix4f\n[\n" + "".join(f" {joined(row, '  ')} \n" for row in m) + "]",  # jME
    ],
    "rows": [
        lambda m: "; ".join(joined(row, " ") for row in m),
        lambda m: "\n".join(joined(row, "\t", ".5f") for row in m) + "\n",  # Unity's ToString
        lambda m: "\r\n".join(joined(row, ",") for row in m),
        lambda m: "\n".join(joined(row, ";") for row in m),
        lambda m: "\n".join(joined(row, ",") + "," for row in m),
        lambda m: "\n".join(f" {joined(row, ' ', '.3E')}" for row in m),  # JOML
        lambda m: "M =\n\n" + "\n".join(f"   {joined(row, '   ', '.4f')}" for row in m),  # MATLAB
        lambda m: "M: " + "; ".join(joined(row, " ") for row in m),
        lambda m: "```\n" + "\n".join(joined(row, " ") for row in m) + "\n```",
        lambda m: "Diagonal Matrix\n\n" + "\n".join(joined(row, "  ") for row in m),  # Octave
        lambda m: decimal_commas(m, " "),
        lambda m: decimal_commas(m, "\t"),
        lambda m: decimal_commas(m, ";"),
        lambda m: "; ".join(joined(row, " ") for row in m).replace("-", "−"),
        lambda m: "\ufeff" + "\n".join(joined(row, "\u00a0") for row in m),
    ],
}  # fmt: skip
CASES = [(name, i) for name, written in WRITERS.items() for i in range(len(written))]
STATED = ("CSV report", "LaTeX", "MathML", "Typst", "a drawing")
BY_NAME = {one.name: one for one in NOTATIONS}


def matrix_for(notation: Notation) -> Matrix:
    """Sixteen different entries, or an affine matrix where a notation has no more rows."""
    return M[:3] if notation.name.startswith("Godot") else M


def test_every_notation_has_a_writer_here() -> None:
    assert list(WRITERS) == list(BY_NAME)


@pytest.mark.parametrize(("name", "i"), CASES)
def test_a_matrix_of_different_entries_is_read_as_itself(name: str, i: int) -> None:
    m = matrix_for(BY_NAME[name])
    text = WRITERS[name][i](m)
    assert [list(row) for row in matrix_literal(text).rows] == m, text


@pytest.mark.parametrize(("name", "i"), CASES)
def test_the_layout_that_a_caller_names_wins_over_a_notation(name: str, i: int) -> None:
    notation = BY_NAME[name]
    m = matrix_for(notation)
    for layout in Layout:
        found = matrix_literal(WRITERS[name][i](m), layout)
        is_stated = name in STATED  # in which everybody sees the rows
        expected = m if is_stated or layout is notation.layout else columns(m)
        assert [list(row) for row in found.rows] == expected
        assert all(one == notation.rounded for one in found.remarks)


@pytest.mark.parametrize(("name", "i"), CASES)
def test_a_remark_names_the_notation_and_how_to_read_it_the_other_way(name: str, i: int) -> None:
    notation = BY_NAME[name]
    other = next(one for one in Layout if one is not notation.layout)
    text = WRITERS[name][i](matrix_for(notation))
    found = " ".join(matrix_literal(text).remarks)
    is_flat = notation.layout is Layout.ROW_MAJOR and text.count("{") + text.count("[") < 2
    if notation.told and not (name == "braces" and "}, {" not in text.replace("},{", "}, {")):
        assert notation.name in found
        assert str(other) in found
    elif name == "a console's array" or (name in ("lists", "braces") and is_flat):
        assert found == "" or "three.js, glTF and OpenGL store columns first" in found
    else:
        assert found in ("", notation.rounded) or name in ("lists", "braces", "JSON")


@pytest.mark.parametrize("notation", NOTATIONS, ids=lambda one: one.name)
def test_the_example_of_the_table_is_read(notation: Notation) -> None:
    assert as_affine(matrix_literal(notation.example)).rows == EXAMPLE


def table() -> str:
    """Write the table of the docs."""
    lines = ["| Notation | Printed by | Example | Layout |", "|---|---|---|---|"]
    for one in NOTATIONS:
        layout = "rows" if one.layout is Layout.ROW_MAJOR else "columns"
        example = " ".join(one.example.split()).replace("|", "\\|")
        lines.append(f"| {one.name} | {one.printed_by} | `{example}` | {layout} |")
    return "\n".join(lines)


def test_the_table_of_the_docs_is_that_of_the_reader() -> None:
    assert table() in DOCS.read_text(encoding="utf-8")


def test_flat_numbers_are_remarked_only_where_their_order_matters() -> None:
    assert "columns first" in matrix_literal("1 2 3 4 5 6 7 8 9").remarks[0]
    assert "columns first" in matrix_literal("{1,2,3,4,5,6,7,8,9}").remarks[0]
    assert matrix_literal("1 0 0 0 2 0 0 0 3").remarks == ()
    assert matrix_literal("1 2 0 5 0 3 0 6 0 0 1 7 0 0 0 1").remarks == ()
    assert matrix_literal("1 2 0 0 0 3 0 0 0 0 1 0 0 0 0 1").remarks != ()
    assert matrix_literal("1 2 3; 4 5 6; 7 8 9").remarks == ()
    assert matrix_literal("vec3(1, 2, 3)").remarks == ()


def test_an_affine_matrix_may_leave_out_its_last_row() -> None:
    text = (
        "Affine3A { matrix3: Mat3A { x_axis: Vec3A(1.0, 0.0, 0.0), y_axis: Vec3A(2.0, 3.0, 0.0), "
        "z_axis: Vec3A(0.0, 0.0, 4.0) }, translation: Vec3A(5.0, 6.0, 7.0) }"
    )
    expected = ((1, 2, 0, 5), (0, 3, 0, 6), (0, 0, 4, 7), (0, 0, 0, 1))
    assert as_affine(matrix_literal(text)).rows == expected


def test_nested_rows_beside_a_list_of_columns_stay_rows() -> None:
    text = json.dumps({"matrix": flat(columns(M)), "elements": M})
    for key in ("matrix", "elements"):
        found = matrix_literal(text, key=key)
        assert [list(row) for row in found.rows] == M
    assert matrix_literal(text, key="elements").remarks == ()
    assert matrix_literal(json.dumps({"matrix": M})).remarks == ()


def test_css_of_the_plane_moves_and_turns_x_and_y() -> None:
    expected = ((1, 3, 0, 5), (2, 4, 0, 6), (0, 0, 1, 0), (0, 0, 0, 1))
    for text in (
        "matrix(1, 2, 3, 4, 5, 6)", "transform: matrix(1, 2, 3, 4, 5, 6);",
        'transform="matrix(1 2 3 4 5 6)"',
    ):  # fmt: skip
        assert matrix_literal(text).rows == expected


@pytest.mark.parametrize("text", ["(0.7 0 0.7 0)", "[0, 0, 0, 1]", "1; 0; 0; 0"])
def test_four_numbers_are_told_what_makes_a_matrix_of_them(text: str) -> None:
    with pytest.raises(IllegalValueError, match="nmatrix world --quaternion X Y Z W makes one"):
        as_affine(matrix_literal(text))
    with pytest.raises(IllegalValueError, match=r"a matrix has 9 or 16; give them all\Z"):
        as_affine(matrix_literal("1 2 3"))


def test_a_transposed_column_notation_is_told_the_layout_that_would_do() -> None:
    text = "mat4(1, 0, 0, 5,  0, 1, 0, 6,  0, 0, 1, 7,  0, 0, 0, 1)"
    with pytest.raises(IllegalValueError, match="this looks row-major: input_layout row-major"):
        as_affine(matrix_literal(text))
    assert as_affine(matrix_literal(text, Layout.ROW_MAJOR)).rows[0] == (1, 0, 0, 5)


REFUSED = {
    "(16) [Array(4), Array(4), Array(4), Array(4)]": "the console folded its rows",
    "Array(16) [ 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, … ]": "left numbers out",
    "[[1. 0. ... 0.]\n [0. 1. ... 0.]]": "left numbers out",
    "Transform(1,0,0,0,2,0,0,0,3)": r'write "1 0 0; 0 2 0; 0 0 3", if these are its rows',
    "FMat(1, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1)": (
        'write "1 0 0 5; 0 2 0 6; 0 0 1 7; 0 0 0 1", if it moves by 5 6 7'
    ),
    "Quaternion(0, 0, 0, 1)": "nmatrix world --quaternion X Y Z W makes one",
    "FQuat(X=0 Y=0 Z=0 W=1)": "nmatrix world --quaternion X Y Z W makes one",
    "translate(3px) rotateX(30deg)": r"getComputedStyle\(element\)\.transform is one matrix",
    '{"rotation":[0,0,0,1],"translation":[5,6,7]}': (
        "nmatrix world --quaternion 0 0 0 1 --translate 5 6 7 makes one"
    ),
    "QMatrix4x4 m(1, 0, 0)": "QMatrix4x4 takes 16 numbers, got 3",
    "m << 1, 0, 0, 1, 5, 6, 7, 8, 1, 1": "it holds 10 numbers, a matrix has 9 or 16",
    "identity(3)": r"'identity\(' begins no notation",
    "float4x4(2.0)": "float4x4 takes 16 numbers, got 1",
    "matrix3d(1, 0, 0, 1, 5, 6)": "matrix3d takes 16 numbers, got 6",
    "transform: matrix(1, 0, 0, 1, 5)": "matrix takes 6 numbers, got 5",
    "Transform3D(1, 0, 0, 0, 1, 0, 0, 0, 1)": "Transform3D takes 12 numbers, got 9",
    "QMatrix4x4(1, 0, 0, 0, 1, 0, 0, 0, 1)": "QMatrix4x4 takes 16 numbers, got 9",
    "tensor([[[1, 0], [0, 1]], [[1, 0], [0, 1]]])": "it holds several matrices; give one of them",
    "1 0 0: 0 1 0; 0 0 1": "'0:'",
    "m 1 0 0 = 0 1 0; 0 0 1": "'m'",
    "[X=1 Y=0] [X=0 Z=1]": "it breaks off in row 2",
    "1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17": "it holds 17 numbers, a matrix has 9 or 16",
    "1 2 3 4 5 6 7 8 nine": "'nine'",
    "[[1, 2], [3, four]]": "'four'",
    "mat3(vec3(1, 2), vec3(3), vec3(4))": "vec3 takes 3 numbers, got 2",
    "{fov: 60, near: 1}": "begins no notation",
    "[1, 2], 3": "stands outside of the brackets",
    "1,5 0; 0 1": "1,5 may be one number or two; write 1.5",
    "mat2(1, 0, 0, 1), mat2(1, 0, 0, 1)": "it holds several matrices",
    '{"e00": 1, "e00": 2}': "it holds several matrices",
}


@pytest.mark.parametrize("text", REFUSED)
def test_a_refusal_says_what_is_wrong_and_what_would_do(text: str) -> None:
    with pytest.raises(IllegalValueError, match=REFUSED[text]):
        matrix_literal(text)


UNCLOSED = ("rows", "rows in a frame", "a matrix of R", "CSV report")
CUT = [
    (name, i)
    for name, i in CASES
    if name not in UNCLOSED and WRITERS[name][i](matrix_for(BY_NAME[name])).strip()[-1] in ")]}>;$"
]


@pytest.mark.parametrize(("name", "i"), CUT)
def test_a_text_cut_inside_its_brackets_never_passes_for_a_whole_one(name: str, i: int) -> None:
    m = matrix_for(BY_NAME[name])
    text = WRITERS[name][i](m).strip()
    whole = (
        text.rpartition(r"\end")[0]
        or text.rpartition("</mtable>")[0]
        or text.rstrip(";$)>]} (16\n")
    )
    for end in range(len(whole)):
        try:
            found = matrix_literal(text[:end])
        except IllegalValueError as refusal:
            assert "\n" not in str(refusal)
            assert len(str(refusal)) < 400
        else:
            assert found.shape != (len(m), len(m[0])), text[:end]


@pytest.mark.parametrize(
    ("text", "where"),
    [
        ("Float32Array(16) [1, 0, 0, 0, 0, 1, 0", r"after 7 numbers: \] is missing"),
        ("mat4(1, 0, 0", r"after 3 numbers: \) is missing"),
        ("<Matrix 4x4 (1, 0, 0, 0)\n (0, 1", r"after 6 numbers: \) is missing"),
        ('{"0":1,"1":2,"2"', "after 2 numbers: } is missing"),
        ('{"e00":1,"e01":2,"e10":3', "after 3 numbers: 1 are missing"),
        ('{"normal_matrix":[[1,0,0],[0,', "at line 1, column 30"),
        (r"\begin{bmatrix} 1 & 0 \\ 0", r"before \\end{bmatrix}"),
        ("1 0 0 0\n0 1 0 0\n0 0", "in row 3, after 2 of 4 numbers"),
    ],
)
def test_a_cut_text_says_where_it_breaks_off(text: str, where: str) -> None:
    with pytest.raises(IllegalValueError, match=f"it breaks off {where}; copy it whole"):
        matrix_literal(text)


TEXTS = [WRITERS[name][i](matrix_for(BY_NAME[name])) for name, i in CASES]
ODD = ["٣", "１", "²", "\u200b", "\u3000", "\ufeff", "\x00", "\ud800", "−", "∞", "\x1b[31m", "💥"]


@given(st.sampled_from(TEXTS), st.sampled_from(TEXTS), st.integers(0, 2**32))
@settings(max_examples=400, deadline=None)
def test_mixed_and_damaged_texts_are_a_matrix_or_one_line(a: str, b: str, seed: int) -> None:
    rng = random.Random(seed)
    cut = rng.randrange(len(a) + 1)
    mixed = [a[:cut] + b[rng.randrange(len(b)) :], a[:cut] + rng.choice(ODD) + a[cut:], a + b]
    for text in mixed:
        try:
            matrix_literal(text)
        except NMatrixError as refusal:
            assert "\n" not in str(refusal)
            assert str(refusal).encode()


# They hold many by name.
READ_TO_THE_END = (
    "CSV report", "LaTeX", "MathML", "Typst", "JavaScript program", "NumPy program", "GLSL program",
)  # fmt: skip
FIRST_AND_LAST = [(name, i) for name, i in CASES if i in (0, len(WRITERS[name]) - 1)]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "i"), FIRST_AND_LAST)
def test_a_million_characters_end_in_few_calls(name: str, i: int) -> None:
    text = WRITERS[name][i](matrix_for(BY_NAME[name]))
    many = 10**6 // len(text) if name in READ_TO_THE_END else 0
    with at_most(4000 + 1000 * many):
        for long in (text * (10**6 // len(text)), text + " " * 10**6 + "x", text[:9] + "(" * 10**6):
            try:
                matrix_literal(long)
            except NMatrixError as refusal:
                assert len(str(refusal)) < 400


def test_a_program_that_declares_without_end_is_refused_early() -> None:
    with at_most(10**6), pytest.raises(IllegalValueError, match="it declares more than"):
        matrix_literal("m=mat3(" * 140_000)


IN_EXPRESSIONS = [(name, i) for name, i in CASES if BY_NAME[name] in WITHIN_BRACKETS]


@pytest.mark.parametrize(("name", "i"), IN_EXPRESSIONS)
def test_the_calculator_reads_the_same_literals(name: str, i: int) -> None:
    m = matrix_for(BY_NAME[name])
    text = WRITERS[name][i](m)
    is_bracketed = BY_NAME[name].read is bracketed or text[0] == "{"
    if not (is_bracketed and BY_NAME[name].sign.search(text)):
        pytest.skip("an assignment or a part of an object is no expression")
    found = calculate(f"{text.rstrip(';')} * 2", {}).value.entries
    assert [[float(x) / 2 for x in row] for row in found] == m
