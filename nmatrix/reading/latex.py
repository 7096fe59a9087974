r"""Matrices in LaTeX: `bmatrix` and its relatives, named by nmatrix's `% key:` comments."""

from __future__ import annotations

import re

from nmatrix.enums import Layout
from nmatrix.reading.contents import Contents, Tokens, cut_off

LONGEST = 40_000  # characters between \begin and \end
_BEGIN = r"\\begin\{([bpvBV]?matrix|smallmatrix|array)\}(?:\{[lcr|]{1,20}\})?"
MATRIX = re.compile(_BEGIN)
_NAMED = re.compile(rf"^% key: (\S{{1,200}})[ \t]*$|{_BEGIN}", re.MULTILINE)
_POWER = re.compile(r" ?\\(?:times|cdot) ?10\^ ?\{? ?(-?[0-9]{1,6}) ?\}?")
_FRACTION = re.compile(r"\\[td]?frac\{([+-]?[0-9]{1,4000})\}\{([+-]?[0-9]{1,4000})\}")


def latex_notation(text: str, source: str) -> Contents:
    r"""Read the matrices of a LaTeX text; a column of several numbers is a vector.

    Raises
    ------
    IllegalValueError
        If a matrix is not closed.

    Examples
    --------
    >>> text = r"\begin{bmatrix} 1 & 0 \\ 0 & 2 \times 10^{-7} \end{bmatrix}"
    >>> latex_notation(text, "x").quantities
    {'': [['1', '0'], ['0', '2e-7']]}
    """
    quantities: dict[str, Tokens] = {}
    name = ""
    found = _NAMED.search(text)
    while found:
        after = found.end()
        if found[1]:
            name = found[1]
        else:
            end = text.find(rf"\end{{{found[2]}}}", after)
            if end < 0 or end - after > LONGEST:
                raise cut_off(source, f"before \\end{{{found[2]}}}")
            quantities.setdefault(name, _rows(text[after:end]))
            name, after = "", end
        found = _NAMED.search(text, after)
    return Contents(quantities, Layout.ROW_MAJOR)


def _rows(body: str) -> Tokens:
    spaced = " ".join(body.split())
    plain = _FRACTION.sub(r"\1/\2", _POWER.sub(r"e\1", spaced))
    rows = [[cell.strip(" {}$") for cell in row.split("&")] for row in plain.split(r"\\")]
    return [row for row in rows if any(row)]
