r"""Matrices in LaTeX: `bmatrix` and its relatives, named by nmatrix's `% key:` comments."""

from __future__ import annotations

import re

from nmatrix.enums import Layout
from nmatrix.reading.contents import Contents, Tokens, cut_off

LONGEST = 40_000  # characters between \begin and \end
_BEGIN = r"\\begin\{([bpvBV]?matrix|smallmatrix|array)\}(?:\{[lcr|]{1,20}\})?"
MATRIX = re.compile(_BEGIN)
_NAMED = re.compile(rf"^(?:%|<!--) key: (\S{{1,200}})(?: -->)?[ \t]*$|{_BEGIN}", re.MULTILINE)
# What a matrix is about, or equal to, is that matrix once more.
_AGAIN = re.compile(rf"\\end\{{\w{{1,20}}\}}\s*(?:\\approx|=)\s*(?={_BEGIN})")
_POWER = re.compile(r" ?\\(?:times|cdot) ?10\^ ?\{? ?(-?[0-9]{1,6}) ?\}?")
_ONE = r" ?(?:([0-9])|\{([^{}]{1,4000})\})"  # \frac13 is \frac{1}{3}
_FRACTION = re.compile(rf"\\[dt]?frac{_ONE}{_ONE}")
_ROOT = re.compile(rf"\\sqrt{_ONE}")
_RATIO = re.compile(r"([+\-−]?)\(([+-]?[0-9]+)\)/\(([0-9]+)\)")
DEEPEST = 4  # fractions and roots inside of one another


def latex_notation(text: str, source: str) -> Contents:
    r"""Read the matrices of a LaTeX text; a column of several numbers is a vector.

    A second matrix that stands behind a first and an = or ≈ says the same, and is passed over.

    Raises
    ------
    IllegalValueError
        If a matrix is not closed.

    Examples
    --------
    >>> text = r"\begin{bmatrix} 1 & 0 \\ 0 & 2 \times 10^{-7} \end{bmatrix}"
    >>> latex_notation(text, "x").quantities
    {'': [['1', '0'], ['0', '2e-7']]}
    >>> text = r"\begin{pmatrix} \tfrac13 & -\frac{\sqrt{3}}{2} \\ 0 & 1 \end{pmatrix}"
    >>> latex_notation(text, "x").quantities
    {'': [['1/3', '-(√(3))/(2)'], ['0', '1']]}
    """
    quantities: dict[str, Tokens] = {}
    name, is_again = "", False
    found = _NAMED.search(text)
    while found:
        after = found.end()
        if found[1]:
            name = found[1]
        else:
            end = text.find(rf"\end{{{found[2]}}}", after)
            if end < 0 or end - after > LONGEST:
                raise cut_off(source, f"before \\end{{{found[2]}}}")
            if not is_again:
                quantities.setdefault(name, _rows(text[after:end]))
            again = _AGAIN.match(text, end)
            name, after, is_again = "", again.end() if again else end, again is not None
        found = _NAMED.search(text, after)
    return Contents(quantities, Layout.ROW_MAJOR)


def _rows(body: str) -> Tokens:
    spaced = " ".join(body.split())
    plain = _POWER.sub(r"e\1", spaced).replace(r"\cdot", "·")
    for _ in range(DEEPEST):
        plain = _FRACTION.sub(_over, _ROOT.sub(lambda found: f"√({found[1] or found[2]})", plain))
    rows = [[_cell(cell) for cell in row.split("&")] for row in plain.split(r"\\")]
    return [row for row in rows if any(row)]


def _over(found: re.Match[str]) -> str:
    return f"({found[1] or found[2]})/({found[3] or found[4]})"


def _cell(text: str) -> str:
    """Write a cell as people type numbers; a fraction of whole numbers is p/q."""
    bare = text.strip(" {}$")
    if "(" not in bare:
        return bare
    tight = bare.replace(" ", "")
    ratio = _RATIO.fullmatch(tight)
    return f"{ratio[1]}{ratio[2]}/{ratio[3]}" if ratio else tight
