"""Rows of cells as aligned columns that fit: long sentences are wrapped inside their cells."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap

from nmatrix.output.grid import aligned
from nmatrix.output.style import Line, Span, Style, plain

GAP = "  "
NARROWEST = 8  # columns that a wrapped cell keeps


def draw_table(
    columns: Sequence[str],
    rows: Sequence[Sequence[str]],
    numeric: Sequence[bool],
    frame: tuple[int, str],
) -> list[Line]:
    """Return the lines of a table; `frame` is the width to keep and the character of the rule.

    Numbers stand with their points aligned. A table that cannot fit becomes one record per row.

    Examples
    --------
    >>> from nmatrix.output.style import render
    >>> from nmatrix.output.options import Colour
    >>> for line in draw_table(["n", "is"], [["1.5", "a"], ["10", "b"]], [True, False], (80, "-")):
    ...     print(render(line, Colour.PLAIN))
    n     is
    ----  --
     1.5  a
    10    b
    """
    if not rows:
        return [(Span(GAP.join(columns), Style.DIM),)]
    cells = [
        _column([row[place] for row in rows], number=numeric[place])
        for place in range(len(columns))
    ]
    widths = _widths(columns, cells, numeric, frame[0])
    if widths is None:
        return _records(columns, rows, frame[0])
    rule = tuple(frame[1] * size for size in widths)
    lines: list[Line] = [
        (Span(line, Style.DIM),) for line in [*_wrapped(columns, widths), GAP.join(rule)]
    ]
    for row in zip(*cells, strict=True):
        lines += [plain(line) for line in _wrapped(row, widths)]
    return lines


def _column(cells: list[str], *, number: bool) -> list[str]:
    return aligned(cells) if number else cells


def _widths(
    columns: Sequence[str], cells: list[list[str]], numeric: Sequence[bool], limit: int
) -> list[int] | None:
    """Return column widths within the limit, taking room from the widest words first."""
    widths = [
        max(len(name), *(len(cell) for cell in column))
        for name, column in zip(columns, cells, strict=True)
    ]
    floors = [
        max(len(cell) for cell in column) if number else NARROWEST
        for column, number in zip(cells, numeric, strict=True)
    ]
    while sum(widths) + len(GAP) * (len(widths) - 1) > limit:
        spare = [size - floor for size, floor in zip(widths, floors, strict=True)]
        if max(spare) <= 0:
            return None
        candidates = [place for place, room in enumerate(spare) if room > 0]
        widths[max(candidates, key=lambda place: widths[place])] -= 1
    return widths


def _wrapped(cells: Sequence[str], widths: list[int]) -> list[str]:
    """Return the lines of one row; a cell longer than its column goes on below."""
    pieces = [
        [cell] if len(cell) <= size else wrap(cell.strip(), size) or [""]
        for cell, size in zip(cells, widths, strict=True)
    ]
    return [
        GAP.join(
            (piece[line] if line < len(piece) else "").ljust(size)
            for piece, size in zip(pieces, widths, strict=True)
        ).rstrip()
        for line in range(max(len(piece) for piece in pieces))
    ]


def _records(columns: Sequence[str], rows: Sequence[Sequence[str]], limit: int) -> list[Line]:
    lines: list[Line] = []
    for row in rows:
        lines += [()] if lines else []
        for name, cell in zip(columns, row, strict=True):
            text = wrap(f"{name}: {cell.strip()}", max(limit, NARROWEST), subsequent_indent=GAP)
            lines += [plain(line) for line in text]
    return lines
