"""One matrix out of one text, in whichever notation it is written."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, printable, quoted, shortlist
from nmatrix.reading import brackets, csvtext, glsl, jsontext, latex
from nmatrix.reading.literal import (
    MatrixLiteral,
    Notation,
    Tokens,
    literal_from_tokens,
    unreadable,
)

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

_UNPRINTABLE = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")

_unreadable = partial(unreadable, next_step="give it as text of at most 16 numbers")


def matrix_literal(
    text: str,
    layout: Layout = Layout.ROW_MAJOR,
    key: str | None = None,
    source: str = "",
) -> MatrixLiteral:
    """Read a matrix in any notation: rows, brackets, NumPy, GLSL, JSON, CSV or LaTeX.

    A text that says its own layout (GLSL, a JSON report, a CSV report) is believed; `layout` is
    for all others. `key` chooses among several matrices.

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
    origin = source or quoted(text)
    if len(text) > LONGEST:
        raise _unreadable(origin, f"{len(text)} characters are too many")
    found = _UNPRINTABLE.search(text)
    if found is not None:
        raise _unreadable(origin, f"it holds the control character {found[0]!r}, so it is not text")
    notation = _notation(text.replace("\r\n", "\n").removeprefix("\ufeff").strip(), origin)
    tokens = _chosen(notation, key, origin)
    return literal_from_tokens(tokens, notation.layout or layout, origin, exact=notation.exact)


def _notation(text: str, source: str) -> Notation:
    for sign, reader in _NOTATIONS:
        if sign.search(text):
            return reader(text, source)
    return brackets.bare_notation(text, source)


def _chosen(notation: Notation, key: str | None, source: str) -> Tokens:
    """Choose the quantity under a key, else the first that is usually meant, else the only one.

    Dots and underscores in keys are alike, since programs cannot name a value with dots.

    Raises
    ------
    IllegalValueError
        If there is no such key, or no way to choose.

    Examples
    --------
    >>> _chosen(Notation({"eye": [["1"]], "value": [["2"]]}), None, "x")
    [['2']]
    """
    found = notation.quantities
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


# Each notation is known by its first characters, or by a word that the later ones never hold.
_NOTATIONS: tuple[tuple[re.Pattern[str], Callable[[str, str], Notation]], ...] = (
    (re.compile(r"\A\{"), jsontext.json_notation),
    (csvtext.HEADER, csvtext.csv_notation),
    (latex.MATRIX, latex.latex_notation),
    (brackets.ARRAY, brackets.numpy_notation),
    (glsl.CONSTRUCTOR, glsl.glsl_notation),
    (re.compile(r"\A[\[(]"), brackets.list_notation),
)
