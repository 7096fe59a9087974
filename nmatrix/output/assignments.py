"""The numbers of a report as named values of a program, for js, numpy and glsl."""

from __future__ import annotations

import keyword
import re
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from nmatrix.enums import PARTICULAR_FORMATS, Format
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.numbers import (
    is_list,
    is_matrix,
    is_number,
    is_vector,
    leaves,
    round_trip_text,
    significant,
)
from nmatrix.report import Report, Shown, ShownMatrix, ShownVector, Step, Value
from nmatrix.version import __version__

# Words that one of the three languages keeps for itself, or names a function by.
_JAVASCRIPT = """
arguments case catch const debugger default delete do enum eval export extends false function
implements instanceof interface let new null package private protected public static super switch
this throw true typeof var void window"""
_GLSL = """
active asm atomic_uint attribute bool buffer cast centroid coherent common cross determinant discard
dot double external extern filter fixed flat float fvec2 fvec3 fvec4 goto half highp hvec2 hvec3
hvec4 inline inout input int invariant inverse layout length long lowp main mediump namespace
noinline noperspective normalize out output partition patch precision readonly reflect resource
restrict sample shared short sizeof smooth struct subroutine superp template transpose typedef uint
uniform union unsigned using varying volatile writeonly"""
_RESERVED = frozenset((*keyword.kwlist, *_JAVASCRIPT.split(), *_GLSL.split()))
_GLSL_TYPE = re.compile(
    r"[biud]?vec[234]|d?mat[234](?:x[234])?|[iu]?(?:sampler|image)(?:[123]D|Cube|Buffer)\w*"
)
Assigned = bool | Shown | ShownVector | ShownMatrix
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
    >>> [identifier(key) for key in ("spaces.0.eye", "2nd try", "window", "None", "vec3")]
    ['spaces_0_eye', 'v_2nd_try', 'window_', 'None_', 'vec3_']
    """
    name = re.sub(r"[^A-Za-z0-9]+", "_", key).strip("_") or "v"
    name = f"v_{name}" if name[0].isdigit() or name.startswith("gl_") else name
    is_taken = name in _RESERVED or _GLSL_TYPE.fullmatch(name)
    return f"{name}_" if is_taken else name


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

    Words and steps are left out: a program computes with numbers. What no float64 can hold is a
    comment.
    """
    numbers = {key: value for key, value in data.items() if not _is_derivation(key, value)}
    for leaf in leaves(numbers):
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


def _is_derivation(key: str, value: Value) -> bool:
    """Recognise the lines of a derivation, and their place where nobody asked for them."""
    if value is None:
        return key == "steps"
    return is_list(value) and any(isinstance(one, Step) for one in value)


def _commented(text: str, language: Language) -> str:
    return f"{language.comment} {' '.join(text.split())}"


def number(value: Shown) -> str:
    """Write a number of an assignment, which a float64 can hold."""
    return round_trip_text(value) or "0.0"


def vector(entries: ShownVector) -> str:
    """Write a vector in square brackets, as JavaScript and Python do.

    Examples
    --------
    >>> vector((1.0, 0.5))
    '[1.0, 0.5]'
    """
    return f"[{', '.join(map(number, entries))}]"


def matrix(rows: ShownMatrix) -> str:
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


def flat(rows: ShownMatrix) -> str:
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


def _numbers(value: Assigned) -> Iterator[Shown]:
    if is_matrix(value):
        yield from (entry for row in value for entry in row)
    elif is_vector(value):
        yield from value
    elif is_number(value):
        yield value
