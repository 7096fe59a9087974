"""Matrices in Python text: `array([...])` as NumPy prints it, or named by an assignment."""

from __future__ import annotations

import re

from nmatrix.enums import Layout
from nmatrix.reading.brackets import bracketed
from nmatrix.reading.literal import Tokens
from nmatrix.reading.notation import Notation

ARRAY = re.compile(
    r"^[ \t]*(?:(?P<name>[A-Za-z_][A-Za-z0-9_]{0,200})[ \t]*=[ \t]*)?"
    r"(?:np\.|numpy\.)?(?:array|matrix)\([ \t\n]*(?=[\[(])",
    re.MULTILINE,
)
_STATED = re.compile(r"^#.*layout: (row-major|column-major)", re.MULTILINE)


def numpy_notation(text: str, source: str) -> Notation:
    """Return the arrays of a Python text by name; an array without one has the name "".

    Raises
    ------
    IllegalValueError
        If the brackets of an array do not match.

    Examples
    --------
    >>> numpy_notation("a = np.array([[1., 2.]])", "x").quantities
    {'a': [['1.', '2.']]}
    """
    quantities: dict[str, Tokens] = {}
    for found in ARRAY.finditer(text):
        quantities[found["name"] or ""] = bracketed(text, source, found.end())[0]
    stated = _STATED.search(text)
    return Notation(quantities, Layout(stated[1]) if stated else None)
