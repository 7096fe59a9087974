"""One matrix out of one text, in whichever notation it is written."""

from __future__ import annotations

import re
from dataclasses import replace
from functools import partial
from itertools import islice
from typing import TYPE_CHECKING

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, printable, quantity, quoted, shortlist
from nmatrix.linear.rational import is_affine, transpose
from nmatrix.reading.contents import ACCEPTED, Contents, Tokens, unreadable
from nmatrix.reading.literal import SQUARES, MatrixLiteral, literal_from_tokens
from nmatrix.reading.roots import in_one_word
from nmatrix.report import LARGEST_MATRIX

if TYPE_CHECKING:
    from nmatrix.reading.notations import Notation

FIRST_OF = (
    "world_from_object",
    "camera_from_world",
    "clip_from_camera",
    "space_from_object",
    "space_from_world",
    "normal_matrix",
    "value",
)
LONGEST = 4_000_000  # characters; a page of shaders and tables has some ten thousand

LONGEST_LITERAL = 160  # characters of a matrix that an error writes again

_COLOURS = re.compile(r"\x1b\[[0-9;]{0,20}m")  # cglm prints in cyan
_UNPRINTABLE = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")
_NUMBER = re.compile(r"(?<![\w.])[+-]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][+-]?[0-9]+)?(?![\w.])")

_unreadable = partial(
    unreadable, next_step=f"give at most {LARGEST_MATRIX}×{LARGEST_MATRIX} numbers"
)


def matrix_literal(
    text: str,
    layout: Layout | None = None,
    key: str | None = None,
    source: str = "",
) -> MatrixLiteral:
    """Read a matrix in any notation of `NOTATIONS`.

    A text that states its layout is believed; else `layout` wins, and without it each notation has
    its own. `key` chooses among several matrices.

    Raises
    ------
    IllegalValueError
        If no notation fits, or what fits is not a matrix of finite numbers.

    Examples
    --------
    >>> matrix_literal("1 0 0; 0 1/2 0; 0 0 1").rows[1]
    (0.0, 0.5, 0.0)
    >>> matrix_literal("mat3(2.0)").rows == matrix_literal("[[2,0,0],[0,2,0],[0,0,2]]").rows
    True
    """
    from nmatrix.reading.notations import read  # thirty patterns, made where a text is read

    origin = source or quoted(text)
    if len(text) > LONGEST:
        raise _unreadable(origin, f"{len(text)} characters are too many")
    bare = _COLOURS.sub("", text).replace("\r\n", "\n").removeprefix("\ufeff").strip()
    found = _UNPRINTABLE.search(bare)
    if found is not None:
        raise _unreadable(origin, f"it holds the control character {found[0]!r}, so it is not text")
    try:
        notation, contents = read(in_one_word(bare), origin)
        tokens = _chosen(contents, key, origin)
        used = contents.layout or layout or notation.layout
        literal = literal_from_tokens(tokens, used, origin, exact=contents.exact)
    except IllegalValueError as refusal:
        raise _with_values(refusal, bare) from None
    is_stated = layout is not None or contents.layout is not None
    told = () if is_stated else _remarks(literal, notation, tokens)
    if notation.rounded and any(map(any, literal.half_units)):
        told = (*told, notation.rounded)
    return replace(literal, remarks=told)


def _remarks(literal: MatrixLiteral, notation: Notation, tokens: Tokens) -> tuple[str, ...]:
    """Tell the layout in which a matrix was read, where its reader may have meant the other."""
    if min(literal.shape) == 1:
        return ()
    own, other = literal.layout, _other(literal.layout)
    option = f"{quantity('input_layout')} {other}"
    is_flat = 1 in (len(tokens), len(tokens[0]))
    if notation.told and not (is_flat and own is Layout.ROW_MAJOR):
        how = "row by row" if own is Layout.ROW_MAJOR else "column by column"
        return (f"Read as {notation.name}, {how}; {option} reads it the other way.",)
    turned = transpose(literal.rows_exact)
    # The last row of an affine matrix, 0 0 0 1, says which are the rows.
    is_plain = is_affine(literal.rows_exact) and not is_affine(turned)
    if is_flat and literal.rows_exact != turned and not is_plain:
        stored = "three.js, glTF and OpenGL store columns first"
        return (f"Read row by row; {stored}: for those, {option}.",)
    return ()


def _other(layout: Layout) -> Layout:
    return Layout.COLUMN_MAJOR if layout is Layout.ROW_MAJOR else Layout.ROW_MAJOR


def _with_values(refusal: IllegalValueError, text: str) -> IllegalValueError:
    """Show how the numbers of a text that was refused would be read."""
    what, why, next_step = refusal.parts
    if next_step != ACCEPTED:
        return refusal
    found = islice(_NUMBER.finditer(text[: 10 * LONGEST_LITERAL]), 1 + max(SQUARES))
    numbers = [one[0].removesuffix(".") for one in found]
    side = SQUARES.get(len(numbers))
    if side is None:
        return refusal
    rows = [" ".join(numbers[start : start + side]) for start in range(0, len(numbers), side)]
    literal = "; ".join(rows)
    if len(literal) > LONGEST_LITERAL:
        return refusal
    return IllegalValueError(what, why, f'write "{literal}", if these are its rows')


def _chosen(contents: Contents, key: str | None, source: str) -> Tokens:
    """Choose the quantity under a key, else the first that is usually meant, else the only one.

    Dots and underscores in keys are alike, since programs cannot name a value with dots.

    Raises
    ------
    IllegalValueError
        If there is no such key, or no way to choose.

    Examples
    --------
    >>> _chosen(Contents({"eye": [["1"]], "value": [["2"]]}), None, "x")
    [['2']]
    """
    found = contents.quantities
    names = [printable(name) for name in found if name]
    if key is not None:
        for name, tokens in found.items():
            if name == key or _program_name(name) == _program_name(key):
                return tokens
        next_step = f"choose one of {shortlist(names)}" if names else "leave the key out"
        raise IllegalValueError(f"key ({quoted(key)})", f"{source} has no such matrix", next_step)
    for name in ("", *FIRST_OF):
        if name in found:
            return found[name]
    if len(found) == 1:
        return next(iter(found.values()))
    if not names:
        raise unreadable(source, "it holds no matrix")
    next_step = f"name one of {shortlist(names)} after a #"
    raise unreadable(source, "which of its matrices is meant?", next_step)


def _program_name(key: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "_", key).strip("_")
