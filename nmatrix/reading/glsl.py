"""Matrices in GLSL: `mat3(…)` fills columns first, out of numbers or `vec3(…)` columns."""

from __future__ import annotations

import re
from collections.abc import Sequence
from functools import partial

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, quoted
from nmatrix.reading.brackets import MOST
from nmatrix.reading.literal import Notation, Tokens, unreadable

CONSTRUCTOR = re.compile(r"\b(?:mat[234](?:x[234])?|vec[234])[ \t\n]*\(")
_DECLARED = re.compile(
    r"\b(?P<type>mat[234](?:x[234])?|vec[234])[ \t]+(?P<name>[A-Za-z_][A-Za-z0-9_]{0,200})"
    r"[ \t]*=[ \t]*(?=(?P=type)[ \t\n]*\()"
)
_TOKEN = re.compile(r"(?P<open>(?:mat|vec)[234](?:x[234])?\s*\()|[(),]|[^\s(),]+")
_COMMENT = re.compile(r"^[ \t]*//", re.MULTILINE)
_SIZE = re.compile(r"(?:mat|vec)(?P<columns>[234])(?:x(?P<rows>[234]))?")

_unreadable = partial(unreadable, next_step="write mat3(1, 0, 0, 0, 2, 0, 0, 0, 1)")


def glsl_notation(text: str, source: str) -> Notation:
    """Read the declared matrices and vectors of a GLSL text, or its one constructor.

    Declarations inside `//` comments count: nmatrix writes the uniforms' values there.

    Raises
    ------
    IllegalValueError
        If a constructor is not made of numbers, or of the wrong count of them.

    Examples
    --------
    >>> glsl_notation("mat2(1.0, 2.0, 3.0, 4.0)", "x").quantities
    {'': [['1.0', '3.0'], ['2.0', '4.0']]}
    """
    bare = _COMMENT.sub("", text).strip()
    quantities: dict[str, Tokens] = {}
    refusals = []
    for found in _DECLARED.finditer(bare):
        try:
            quantities[found["name"]] = _constructed(bare, found.end(), source)[0]
        except IllegalValueError as refusal:
            # A shader also declares what it computes; that is no literal.
            refusals.append(refusal)
    if refusals and not quantities:
        raise refusals[0]
    if not quantities and CONSTRUCTOR.match(bare):
        rows, end = _constructed(bare, 0, source)
        rest = bare[end:].strip().strip(";").strip()
        if rest:
            raise _unreadable(source, f"{quoted(rest)} follows the constructor")
        quantities[""] = rows
    return Notation(quantities, Layout.ROW_MAJOR)


def _constructed(text: str, start: int, source: str) -> tuple[Tokens, int]:
    """Return the rows that the constructor at `start` builds, and where it ends."""
    size = _SIZE.match(text, start)
    if size is None:
        raise _unreadable(source, "it has no mat or vec")
    numbers, end = _arguments(text, start, source)
    columns = int(size["columns"])
    if size[0].startswith("vec"):
        return [_filled(numbers, columns, size[0], source)], end
    height = int(size["rows"] or columns)
    if len(numbers) == 1:
        return _diagonal(numbers[0], height, columns), end
    flat = _filled(numbers, columns * height, size[0], source)
    return [flat[row::height] for row in range(height)], end


def _arguments(text: str, start: int, source: str) -> tuple[list[str], int]:
    """Return the numbers of a constructor; a `vecN` inside gives its N numbers in place."""
    numbers: list[str] = []
    inner: list[tuple[str, int]] = []  # the open constructors and where their numbers begin
    for token in _TOKEN.finditer(text, start):
        if token["open"]:
            inner.append((token[0][:4], len(numbers)))
        elif token[0] == ")" and inner:
            kind, first = inner.pop()
            if not inner:
                return numbers, token.end()
            numbers[first:] = _filled(numbers[first:], int(kind[3]), kind, source)
        elif token[0] not in ",()":
            numbers.append(token[0].removesuffix("f").removesuffix("F"))
        elif token[0] == "(":
            raise _unreadable(source, "only numbers and vec columns stand in it")
        if len(inner) > 2 or (len(inner) == 2 and inner[-1][0].startswith("mat")):
            raise _unreadable(source, "only numbers and vec columns stand in it")
        if len(numbers) > MOST:
            raise _unreadable(source, f"it holds more than {MOST} numbers")
    raise _unreadable(source, "its brackets are not closed")


def _filled(numbers: Sequence[str], count: int, kind: str, source: str) -> list[str]:
    """Return the numbers of a constructor; a vector of a single one repeats it."""
    if len(numbers) == 1 and kind.startswith("vec"):
        return list(numbers) * count
    if len(numbers) != count:
        raise _unreadable(source, f"{kind} takes {count} numbers, got {len(numbers)}")
    return list(numbers)


def _diagonal(number: str, height: int, columns: int) -> Tokens:
    return [
        [number if row == column else "0" for column in range(columns)] for row in range(height)
    ]
