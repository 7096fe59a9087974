"""The numbers of a report as named values of a program, for js, numpy and glsl."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from nmatrix.enums import PARTICULAR_FORMATS, Format
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.numbers import (
    is_matrix,
    is_number,
    is_vector,
    leaves,
    round_trip_text,
    significant,
)
from nmatrix.report import Matrix, Number, Report, Value, Vector
from nmatrix.version import __version__

_RESERVED = (
    " as await break case catch class const continue debugger def default del delete do else enum"
    " export extends false finally for from function global if import in input instanceof is"
    " lambda let new nonlocal not null or output package pass private protected public raise"
    " return sample static super switch this throw true try typeof uniform var varying void while"
    " window with yield length normalize cross dot reflect transpose inverse determinant "
)
Assigned = bool | Number | Vector | Matrix
PROGRAMS = (Format.GLSL, Format.JS, Format.NUMPY)


@dataclass(frozen=True)
class Language:
    """How a program is written: its comments, what the first one says, and its statements.

    `preamble` is the lines before the first assignment.
    """

    format: Format
    comment: str
    about: str
    statement: Callable[[str, Assigned], str]
    preamble: tuple[str, ...] = ()


def identifier(key: str) -> str:
    """Turn a dotted key into a name that GLSL, JavaScript and Python all accept.

    Examples
    --------
    >>> identifier("spaces.0.eye"), identifier("2nd try"), identifier("window")
    ('spaces_0_eye', 'v_2nd_try', 'window_')
    """
    name = re.sub(r"[^A-Za-z0-9]+", "_", key).strip("_") or "v"
    name = f"v_{name}" if name[0].isdigit() or name.startswith("gl_") else name
    return f"{name}_" if f" {name} " in _RESERVED else name


def program(report: Report, language: Language) -> str:
    """Write the numbers of a report as statements, and its remarks as comments.

    Raises
    ------
    IllegalValueError
        If there is nothing to assign.
    """
    numbers = (leaf for leaf in leaves(report.data) if not isinstance(leaf.value, (str, bool)))
    if not any(leaf.value is not None for leaf in numbers):
        without = (Format.TEXT, *PROGRAMS, *PARTICULAR_FORMATS)
        works = sorted(each for each in Format if each not in without)
        raise IllegalValueError(
            f"{quantity('format')} ({language.format})",
            f"{report.command} has no numbers to write in a program",
            f"use text, {', '.join(works)}",
        )
    lines = [
        f"{language.comment} nmatrix {report.command} {__version__}; {language.about}",
        *language.preamble,
        *statements(report.data, language),
        *(_commented(remark, language) for remark in report.remarks),
    ]
    return "\n".join(lines) + "\n"


def statements(data: Mapping[str, Value], language: Language) -> Iterator[str]:
    """Write a statement for every number, vector, matrix and truth value of the data.

    Words are left out: a program computes with numbers. What no float64 can hold is a comment.
    """
    for leaf in leaves(data):
        value = leaf.value
        if value is None:
            yield _commented(f"{leaf.key} is null", language)
        elif not isinstance(value, str):
            outside = [entry for entry in _numbers(value) if round_trip_text(entry) is None]
            if outside:
                note = f"holds {significant(outside[0], 6)}, outside the range of float64"
                yield _commented(f"{leaf.key} {note}", language)
            else:
                yield language.statement(identifier(leaf.key), value)


def _commented(text: str, language: Language) -> str:
    return f"{language.comment} {' '.join(text.split())}"


def number(value: Number) -> str:
    """Write a number of an assignment, which a float64 can hold."""
    return round_trip_text(value) or "0.0"


def vector(entries: Vector) -> str:
    """Write a vector in square brackets, as JavaScript and Python do.

    Examples
    --------
    >>> vector((1.0, 0.5))
    '[1.0, 0.5]'
    """
    return f"[{', '.join(map(number, entries))}]"


def matrix(rows: Matrix) -> str:
    """Write a matrix as a list of rows, a row on each line.

    Examples
    --------
    >>> print(matrix(((1, 0), (0, 1))))
    [
      [1, 0],
      [0, 1],
    ]
    """
    return "[\n" + "".join(f"  {vector(row)},\n" for row in rows) + "]"


def flat(rows: Matrix) -> str:
    """Write the rows one after the other in a single list, a row on each line.

    Examples
    --------
    >>> print(flat(((1, 0), (0, 1))))
    [
      1, 0,
      0, 1,
    ]
    """
    return "[\n" + "".join(f"  {vector(row)[1:-1]},\n" for row in rows) + "]"


def _numbers(value: Assigned) -> Iterator[Number]:
    if is_matrix(value):
        yield from (entry for row in value for entry in row)
    elif is_vector(value):
        yield from value
    elif is_number(value):
        yield value
