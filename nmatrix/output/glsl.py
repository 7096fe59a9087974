"""GLSL ES 3.00: shaders as they are, and numbers as constants; matrices are column-major."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from nmatrix.enums import Format
from nmatrix.linear.rational import transpose
from nmatrix.output.assignments import Assigned, Language, program, statements
from nmatrix.output.numbers import float_or_none, is_matrix, is_number, is_vector, round_trip_text
from nmatrix.output.write import OutputOptions
from nmatrix.report import Code, Matrix, Number, Report, Vector

SHADER_BREAK = "// ---- fragment shader ----"
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
    shaders = [
        block.text.rstrip("\n")
        for block in report.blocks
        if isinstance(block, Code) and block.language == "glsl"
    ]
    if shaders:
        return "\n".join([f"\n{SHADER_BREAK}\n".join(shaders), *_uniforms(report)]) + "\n"
    return program(report, _glsl("const")) + (report.glsl and f"{report.glsl}\n")


def _glsl(qualifier: str) -> Language:
    about = "GLSL ES 3.00, matrices are column-major."
    return Language(Format.GLSL, "//", about, partial(_statement, qualifier))


def _uniforms(report: Report) -> list[str]:
    """Write the values of the shaders' uniforms as comments."""
    values = report.data.get("uniforms")
    if not isinstance(values, Mapping):
        return []
    lines = ["// The uniforms' values; matrices are column-major."]
    for statement in statements(values, _glsl("uniform")):
        commented = statement.removeprefix("// ").replace("\n", "\n// ")
        lines.append(f"// {commented}")
    return lines


def _statement(qualifier: str, name: str, value: Assigned) -> str:
    kind, written, numbers = _typed(value, name)
    too_large = any(abs(float_or_none(entry) or 0.0) > LARGEST_FLOAT32 for entry in numbers)
    return f"{qualifier} {kind} = {written};{OUTSIDE if too_large else ''}"


def _typed(value: Assigned, name: str) -> tuple[str, str, Vector]:
    """Write the declaration and the initial value; the third part is the floats in it."""
    if is_matrix(value):
        return _matrix(value, name)
    if is_vector(value):
        constructor = f"vec{len(value)}" if 2 <= len(value) <= 4 else f"float[{len(value)}]"
        return f"{constructor} {name}", f"{constructor}({_list(value)})", value
    if is_number(value):
        if isinstance(value, int):
            return f"int {name}", str(value), ()
        return f"float {name}", _literal(value), (value,)
    return f"bool {name}", "true" if value else "false", ()


def _matrix(value: Matrix, name: str) -> tuple[str, str, Vector]:
    columns = transpose(value)
    entries = tuple(entry for column in columns for entry in column)
    rows, across = len(value), len(columns)
    if across == 1:
        return f"vec{rows} {name}", f"vec{rows}({_list(entries)})", entries
    constructor = f"mat{across}" if rows == across else f"mat{across}x{rows}"
    if rows * across <= 4:
        return f"{constructor} {name}", f"{constructor}({_list(entries)})", entries
    lines = ",\n".join(f"    {_list(column)}" for column in columns)
    return f"{constructor} {name}", f"{constructor}(\n{lines})", entries


def _list(entries: Vector) -> str:
    return ", ".join(_literal(entry) for entry in entries)


def _literal(value: Number) -> str:
    """Write a float literal; GLSL ES knows no silent step from int to float."""
    text = round_trip_text(float(value)) or "0.0"
    return text if "." in text or "e" in text else f"{text}.0"
