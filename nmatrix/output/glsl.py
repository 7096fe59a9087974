"""GLSL ES 3.00: shaders as they are, and numbers as constants; matrices are column-major."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from nmatrix.enums import Format
from nmatrix.linear.rational import transpose
from nmatrix.output.assignments import Assigned, Language, program, statements
from nmatrix.output.numbers import (
    float_or_none,
    is_list,
    is_matrix,
    is_number,
    is_vector,
    leaves,
    round_trip_text,
)
from nmatrix.output.write import OutputOptions
from nmatrix.report import Code, Report, Shown, ShownMatrix, ShownVector, Value

SHADER_BREAK = "// ---- fragment shader ----"
LARGEST = 4  # rows and columns of GLSL's matrices
LARGEST_FLOAT32 = 3.4028234663852886e38
OUTSIDE = "  // outside the range of float32"


def write(report: Report, options: OutputOptions) -> str:
    """Write the report's shaders and uniform values, or else its numbers as constants.

    GLSL fills a matrix column by column, so `mat3(1, 2, 3, …)` begins with the first column.

    Raises
    ------
    IllegalValueError
        If the report has neither shaders nor numbers.

    Examples
    --------
    >>> answer = Report("calc", {"value": ((1.0, 2.0), (3.0, 4.0))}, ())
    >>> print(write(answer, OutputOptions()).splitlines()[-1])
    const mat2 value = mat2(1.0, 3.0, 2.0, 4.0);
    """
    programs = _programs(report.data)
    if programs:
        return "\n\n".join(map(_program, programs)) + "\n"
    code = [
        block.text.rstrip("\n")
        for block in report.blocks
        if isinstance(block, Code) and block.language == "glsl"
    ]
    if code:
        return "\n".join(code) + "\n"
    return program(report, _glsl("const")) + (report.glsl and f"{report.glsl}\n")


def _glsl(qualifier: str) -> Language:
    about = "GLSL ES 3.00, matrices are column-major."
    return Language(Format.GLSL, "//", about, partial(_statement, qualifier))


def _programs(data: Mapping[str, Value]) -> list[Mapping[str, Value]]:
    """Return what holds a pair of shaders: the answer itself, or its objects."""
    objects = data.get("objects", ())
    each = (data, *objects) if is_list(objects) else (data,)
    found = [one for one in each if isinstance(one, Mapping) and "vertex_shader" in one]
    return [one for pair in map(_with_outline, found) for one in pair]


def _with_outline(found: Mapping[str, Value]) -> tuple[Mapping[str, Value], ...]:
    outline = found.get("outline")
    if not isinstance(outline, Mapping):
        return (found,)
    return found, {"name": f"{found['name']}, its outline", **outline}


def _program(found: Mapping[str, Value]) -> str:
    """Write a pair of shaders, and what it is drawn with as comments."""
    shaders = (str(found[f"{stage}_shader"]).rstrip("\n") for stage in ("vertex", "fragment"))
    lines = [f"\n{SHADER_BREAK}\n".join(shaders)]
    if "name" in found:
        name = " ".join(str(found["name"]).split())
        lines = [_comment(f"==== {name} ===="), *lines]
    uniforms, samplers = found.get("uniforms"), found.get("samplers")
    if isinstance(uniforms, Mapping) and uniforms:
        lines.append("// The uniforms' values; matrices are column-major.")
        lines += (_comment(one) for one in statements(uniforms, _glsl("uniform")))
    if isinstance(samplers, Mapping) and samplers:
        lines.append("// What the samplers are bound to.")
        for leaf in leaves(samplers):
            shown = leaf.value if isinstance(leaf.value, str) else _bound(leaf.value)
            lines.append(_comment(f"{leaf.key}: {shown}"))
    if found.get("cull_face"):
        lines.append(f"// glEnable(GL_CULL_FACE), glCullFace(GL_{str(found['cull_face']).upper()})")
    if "depth_range" in found:
        lines.append(f"// clip space: depth {found['depth_range']}, y {found['clip_y']}")
        lines.append(f"// framebuffer: {found['target']}")
    if "front_face" in found:
        lines.append(f"// glFrontFace(GL_{str(found['front_face']).upper()})")
    return "\n".join(lines)


def _bound(value: Assigned | None) -> str:
    return "none" if value is None else _typed(value, "")[1]


def _comment(text: str) -> str:
    """Comment lines out; a backslash at an end would carry the comment on to the next line."""
    return "// " + text.removeprefix("// ").rstrip("\\").replace("\n", "\n// ")


def _statement(qualifier: str, name: str, value: Assigned) -> str:
    kind, written, numbers = _typed(value, name)
    too_large = any(abs(float_or_none(entry) or 0.0) > LARGEST_FLOAT32 for entry in numbers)
    return f"{qualifier} {kind} = {written};{OUTSIDE if too_large else ''}"


def _typed(value: Assigned, name: str) -> tuple[str, str, ShownVector]:
    """Write the declaration and the initial value; the third part is the floats in it."""
    if is_matrix(value):
        return _matrix(value, name)
    if is_vector(value):
        return _vector(value, name)
    if is_number(value):
        if isinstance(value, int):
            return f"int {name}", str(value), ()
        return f"float {name}", _literal(value), (value,)
    return f"bool {name}", "true" if value else "false", ()


def _matrix(value: ShownMatrix, name: str) -> tuple[str, str, ShownVector]:
    """Declare a matrix; one larger than GLSL has is an array of its columns, or of all numbers."""
    columns = transpose(value)
    entries = tuple(entry for column in columns for entry in column)
    rows, across = len(value), len(columns)
    if min(rows, across) == 1:
        return _vector(entries, name)
    lines = [_list(column) for column in columns]
    if max(rows, across) <= LARGEST:
        constructor = f"mat{across}" if rows == across else f"mat{across}x{rows}"
    elif rows <= LARGEST:
        constructor, lines = f"vec{rows}[{across}]", [f"vec{rows}({one})" for one in lines]
    else:
        constructor = f"float[{rows * across}]"
    if rows * across <= 4:
        return f"{constructor} {name}", f"{constructor}({', '.join(lines)})", entries
    body = ",\n".join(f"    {line}" for line in lines)
    return f"{constructor} {name}", f"{constructor}(\n{body})", entries


def _vector(entries: ShownVector, name: str) -> tuple[str, str, ShownVector]:
    constructor = f"vec{len(entries)}" if 2 <= len(entries) <= LARGEST else f"float[{len(entries)}]"
    return f"{constructor} {name}", f"{constructor}({_list(entries)})", entries


def _list(entries: ShownVector) -> str:
    return ", ".join(_literal(entry) for entry in entries)


def _literal(value: Shown) -> str:
    """Write a float literal; GLSL ES knows no silent step from int to float."""
    text = round_trip_text(float(value)) or "0.0"
    return text if "." in text or "e" in text else f"{text}.0"
