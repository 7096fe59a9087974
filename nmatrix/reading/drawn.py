r"""Matrices as nmatrix draws them in text, with names beside rows and columns and a bar before t.

One too wide for its lines is drawn in pieces, one below the other. Decimals beside or below the
exact numbers, behind ≈ or =, say the same once more, and are passed over.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from nmatrix.enums import Layout
from nmatrix.reading.contents import Contents, Tokens, cut_off, unreadable
from nmatrix.report import LARGEST_MATRIX

NARROWEST = 40  # columns of text, beyond which a matrix may be drawn in pieces
LONGEST = 400  # characters of a line

_CELLS = r"[^\s⎡⎢⎣⎤⎥⎦\[\](),;:][^⎡⎢⎣⎤⎥⎦\[\](),;:\n]{0,400}"
_ASCII = r"[ ]{2,30}(?:[xyzw] )?(?P<ascii>\[)"
_BRACKET = r"[ ]{0,30}(?:[xyzw] )?(?P<open>[⎡⎢⎣])"
_ENTRIES = rf"[ ]+(?P<cells>{_CELLS})[ ][⎤⎥⎦\]]"
_DRAWN = re.compile(rf"(?:{_ASCII}|{_BRACKET}){_ENTRIES}")
_VECTOR = re.compile(rf"(?P<name>\S.{{0,80}}?) {{2,40}}\([ ]+(?P<cells>{_CELLS})[ ]\)")
_AXES = re.compile(r"\s+[xyzwt](?:\s+[xyzwt])*\s*")
DRAWING = re.compile(
    r"(?m:^[ ]{0,30}(?:[xyzw] )?⎡[ ])"
    rf"|\A[^\s\[({{<|│][^\n]*\n(?:[^\n]*\n){{0,40}}?{_ASCII}{_ENTRIES}(?=\n|\Z|[ ]{{2}})"
)


def drawn_text(text: str, source: str) -> Contents:
    """Read the matrices and vectors of a text by the keys or titles above or beside them.

    Raises
    ------
    IllegalValueError
        If a drawing breaks off, or does not tell its rows from its pieces.

    Examples
    --------
    >>> text = '''M: the world matrix
    ...   ⎡ √3/2  0   ⎤   ⎡ 0.866  0   ⎤
    ...   ⎣    0  1/2 ⎦ ≈ ⎣ 0      0.5 ⎦'''
    >>> drawn_text(text, "x").quantities
    {'M': [['√3/2', '0'], ['0', '1/2']]}
    """
    quantities: dict[str, Tokens] = {}
    drawing = _Drawing("", source)
    for line in (*text.split("\n"), ""):
        row = _DRAWN.match(line[:LONGEST])
        if row is not None:
            drawing.take(row)
        elif _AXES.fullmatch(line):
            drawing.begin(named=True)
        elif line.strip() in ("≈", "=", "~"):
            drawing.is_over = True
        else:
            if drawing.pieces:
                quantities.setdefault(drawing.name, drawing.rows())
            drawing = _Drawing(line.partition(":")[0].strip(), source)
            vector = _VECTOR.match(line[:LONGEST])
            if vector is not None:
                quantities.setdefault(vector["name"], [vector["cells"].split()])
    return Contents(quantities, Layout.ROW_MAJOR)


@dataclass
class _Drawing:
    """The pieces of one matrix, each with its rows; those after its end are not its own.

    In Unicode the brackets tell where a piece begins and ends, else the names of the axes do.
    """

    name: str
    source: str
    pieces: list[list[list[str]]] = field(default_factory=list)
    is_over: bool = False
    is_named: bool = False
    last: str = ""
    widest: int = 0

    def begin(self, *, named: bool) -> None:
        """Begin a piece, unless one is begun."""
        if not self.is_over and (not self.pieces or self.pieces[-1]):
            self.pieces.append([])
            self.is_named = named

    def take(self, row: re.Match[str]) -> None:
        """Take a row of the piece."""
        opening = row["open"] or row["ascii"]
        if opening == "⎡" or (opening == "[" and not self.pieces):
            self.begin(named=self.is_named)
        if self.is_over or not self.pieces:  # the rest of a formula
            return
        self.pieces[-1].append(row["cells"].replace("│", " ").replace("|", " ").split())
        self.last, self.widest = opening, max(self.widest, row.end())
        if max(len(self.pieces), len(self.pieces[-1])) > LARGEST_MATRIX:
            most = f"use at most {LARGEST_MATRIX}×{LARGEST_MATRIX}"
            raise unreadable(self.source, "its drawing has too many rows or pieces", most)

    def rows(self) -> Tokens:
        """Put the pieces side by side."""
        if len({len(piece) for piece in self.pieces}) > 1 or self.last not in ("⎣", "["):
            raise cut_off(self.source, "in a drawing")
        found = [[one for part in rows for one in part] for rows in zip(*self.pieces, strict=True)]
        widest = max((len(one) for row in found for one in row), default=0)
        is_wide = self.widest + len("  ") + widest > NARROWEST
        if self.last == "[" and not self.is_named and is_wide and len(found) > 3:
            why = "brackets of ASCII do not tell its rows from its pieces"
            raise unreadable(self.source, why, "write it with -f json")
        return found
