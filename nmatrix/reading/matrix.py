"""One matrix out of one text, in whichever notation it is written."""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial

from nmatrix.enums import Layout
from nmatrix.errors import quoted
from nmatrix.reading import brackets, csvtext, glsl, jsontext, latex
from nmatrix.reading.literal import MatrixLiteral, literal_from_tokens, unreadable
from nmatrix.reading.notation import Notation, chosen

_unreadable = partial(unreadable, next_step="give it as text of at most 16 numbers")
LONGEST = 4_000_000  # characters; a page of shaders and tables has some ten thousand

_UNPRINTABLE = re.compile(r"[\x00-\x08\x0e-\x1f\x7f]")


def matrix_literal(
    text: str,
    layout: Layout = Layout.ROW_MAJOR,
    key: str | None = None,
    source: str = "",
) -> MatrixLiteral:
    """Return the matrix that a text spells: rows, brackets, NumPy, GLSL, JSON, CSV or LaTeX.

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
    tokens = chosen(notation, key, origin)
    return literal_from_tokens(tokens, notation.layout or layout, origin)


def _notation(text: str, source: str) -> Notation:
    for sign, reader in _NOTATIONS:
        if sign.search(text):
            return reader(text, source)
    return brackets.bare_notation(text, source)


# Each notation is known by its first characters, or by a word that the later ones never hold.
_NOTATIONS: tuple[tuple[re.Pattern[str], Callable[[str, str], Notation]], ...] = (
    (re.compile(r"\A\{"), jsontext.json_notation),
    (csvtext.HEADER, csvtext.csv_notation),
    (latex.MATRIX, latex.latex_notation),
    (brackets.ARRAY, brackets.numpy_notation),
    (glsl.CONSTRUCTOR, glsl.glsl_notation),
    (re.compile(r"\A[\[(]"), brackets.list_notation),
)
