"""The numbers of a report as named values of a program: what js, numpy and glsl have in common."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from nmatrix.enums import Format
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.numbers import machine, significant
from nmatrix.output.quantities import Leaf, is_matrix, is_number, is_vector, leaves
from nmatrix.report import Matrix, Number, Report, Value, Vector

_RESERVED = (
    " as await break case catch class const continue debugger def default del delete do else enum"
    " export extends false finally for from function global if import in input instanceof is"
    " lambda let new nonlocal not null or output package pass private protected public raise"
    " return sample static super switch this throw true try typeof uniform var varying void while"
    " window with yield length normalize cross dot reflect transpose inverse determinant "
)
_WORDS = {Format.LATEX, Format.MARKDOWN, Format.MATHML, Format.TYPST, Format.JSON, Format.CSV}


@dataclass(frozen=True)
class Assignment:
    """A name and the value it gets; the value is None where no float64 can hold it."""

    name: str
    value: bool | Number | Vector | Matrix | None
    note: str = ""


def assignments(data: Mapping[str, Value]) -> Iterator[Assignment]:
    """Give every number, vector, matrix, truth value and null of the data a name.

    Words are left out: a program computes with numbers.

    Examples
    --------
    >>> [each.name for each in assignments({"spaces": [{"eye": (0, 0, 5)}], "kind": "shear"})]
    ['spaces_0_eye']
    """
    for leaf in leaves(data):
        if not isinstance(leaf.value, str):
            yield _assignment(leaf)


def identifier(key: str) -> str:
    """Return a dotted key as a name that GLSL, JavaScript and Python all accept.

    Examples
    --------
    >>> identifier("spaces.0.eye"), identifier("2nd try"), identifier("window")
    ('spaces_0_eye', 'v_2nd_try', 'window_')
    """
    name = re.sub(r"[^A-Za-z0-9]+", "_", key).strip("_") or "v"
    name = f"v_{name}" if name[0].isdigit() or name.startswith("gl_") else name
    return f"{name}_" if f" {name} " in _RESERVED else name


def require_numbers(report: Report, chosen: Format) -> None:
    """Refuse a program format for a report without a single number.

    Raises
    ------
    IllegalValueError
        If there is nothing to assign.
    """
    numbers = (leaf for leaf in leaves(report.data) if not isinstance(leaf.value, (str, bool)))
    if not any(leaf.value is not None for leaf in numbers):
        works = ", ".join(sorted(_WORDS))
        raise IllegalValueError(
            f"{quantity('format')} ({chosen})",
            f"{report.command} has no numbers to write in a program",
            f"use text, {works}",
        )


def comment(text: str) -> str:
    """Return a text that stays inside a one-line comment."""
    return " ".join(text.split())


def _assignment(leaf: Leaf) -> Assignment:
    value = leaf.value
    if value is None or isinstance(value, str):
        return Assignment(identifier(leaf.key), None, f"{leaf.key} is null")
    outside = next((entry for entry in _numbers(value) if machine(entry) is None), None)
    if outside is not None:
        shown = significant(outside, 6)
        note = f"{leaf.key} holds {shown}, outside the range of float64"
        return Assignment(identifier(leaf.key), None, note)
    return Assignment(identifier(leaf.key), value)


def _numbers(value: bool | Number | Vector | Matrix) -> Iterator[Number]:  # noqa: FBT001 - data
    if is_matrix(value):
        yield from (entry for row in value for entry in row)
    elif is_vector(value):
        yield from value
    elif is_number(value):
        yield value
