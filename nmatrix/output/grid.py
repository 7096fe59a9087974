"""A matrix drawn for people: box brackets, aligned points, named axes, a bar before t.

t is the translation column of an affine 4×4.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence

from nmatrix.linear.rational import is_affine
from nmatrix.output.numbers import significant
from nmatrix.output.options import Charset, OutputOptions
from nmatrix.output.style import AXES, Line, Span, Style, width
from nmatrix.report import Matrix, Vector

GAP = "  "
MARGIN = 8  # row name, two brackets, the bar
AXIS_NAMES = "xyzw"
BRACKETS = {
    Charset.UNICODE: (("⎡", "⎤"), ("⎢", "⎥"), ("⎣", "⎦"), "│"),
    Charset.ASCII: (("[", "]"), ("[", "]"), ("[", "]"), "|"),
}


def aligned(texts: Sequence[str]) -> list[str]:
    """Return numbers at one width, with their decimal points under each other.

    Examples
    --------
    >>> aligned(["0", "-1.5", "10"])
    [' 0  ', '-1.5', '10  ']
    """
    parts = [_at_point(text) for text in texts]
    left = max(len(whole) for whole, _ in parts)
    right = max(len(rest) for _, rest in parts)
    return [whole.rjust(left) + rest.ljust(right) for whole, rest in parts]


def _at_point(text: str) -> tuple[str, str]:
    place = next((i for i, mark in enumerate(text) if mark in ".e"), len(text))
    return text[:place], text[place:]


def draw_matrix(matrix: Matrix, options: OutputOptions) -> list[Line]:
    """Return the lines of a matrix; one too wide is cut between its columns.

    Examples
    --------
    >>> from nmatrix.output.style import render
    >>> for line in draw_matrix(((1, 0), (0, 0.5)), OutputOptions()):
    ...     print(render(line, OutputOptions().colour))
    ⎡ 1  0   ⎤
    ⎣ 0  0.5 ⎦
    """
    columns = _columns(matrix, options.digits, aligned)
    groups = _groups(columns, options.width)
    if len(groups) > 1:
        columns = _columns(matrix, options.digits, _right)
        groups = _groups(columns, options.width)
    lines: list[Line] = []
    for group in groups:
        lines += _draw_group(matrix, columns, group, options.charset)
    return lines


def draw_vector(vector: Vector, options: OutputOptions) -> list[Line]:
    """Return a vector in one row, or as a column where the row would be too wide."""
    texts = [significant(entry, options.digits) for entry in vector]
    row: list[Span] = [Span("(")]
    for place, text in enumerate(texts):
        row += [Span(GAP if place else " "), _number(text)]
    row.append(Span(" )"))
    if width(tuple(row)) + len(GAP) <= options.width:
        return [tuple(row)]
    return draw_matrix(tuple((entry,) for entry in vector), options)


def _columns(
    matrix: Matrix, digits: int, align: Callable[[Sequence[str]], list[str]]
) -> list[list[str]]:
    columns = zip(*matrix, strict=True)
    return [align([significant(entry, digits) for entry in column]) for column in columns]


def _right(texts: Sequence[str]) -> list[str]:
    longest = max(len(text) for text in texts)
    return [text.rjust(longest) for text in texts]


def _groups(columns: list[list[str]], limit: int) -> list[range]:
    """Return runs of columns that fit side by side."""
    groups, start, used = [], 0, MARGIN
    for place, column in enumerate(columns):
        needed = len(column[0]) + len(GAP)
        if place > start and used + needed > limit:
            groups.append(range(start, place))
            start, used = place, MARGIN
        used += needed
    return [*groups, range(start, len(columns))]


def _draw_group(
    matrix: Matrix, columns: list[list[str]], group: range, charset: Charset
) -> list[Line]:
    top, middle, bottom, bar = BRACKETS[charset]
    last = len(matrix) - 1
    barred = 3 if is_affine(matrix) and group[0] < 3 <= group[-1] else None
    named = len(matrix) >= 3 and len(columns) == len(matrix)
    lines = (
        [_header(columns, group, barred, "xyzt" if is_affine(matrix) else AXIS_NAMES)]
        if named
        else []
    )
    for place in range(len(matrix)):
        opening, closing = bottom if place == last else middle if place else top
        spans = [_axis(AXIS_NAMES[place]), Span(" ")] if named else []
        spans.append(Span(opening + " "))
        for column in group:
            if column == barred:
                spans.append(Span(f" {bar} ", Style.DIM))
            elif column != group[0]:
                spans.append(Span(GAP))
            spans.append(_number(columns[column][place]))
        lines.append((*spans, Span(" " + closing)))
    return lines


def _header(columns: list[list[str]], group: range, barred: int | None, names: str) -> Line:
    """Return the names of the columns, over the ones digits of their numbers."""
    spans = [Span("    ")]
    for column in group:
        if column != group[0]:
            spans.append(Span("   " if column == barred else GAP))
        cells = columns[column]
        before = max(len(_at_point(cell.rstrip())[0]) for cell in cells) - 1
        spans += [
            Span(" " * before),
            _axis(names[column]),
            Span(" " * (len(cells[0]) - before - 1)),
        ]
    return tuple(spans)


def _axis(name: str) -> Span:
    return Span(name, AXES.get(name, Style.DIM))


def _number(text: str) -> Span:
    return Span(text, Style.DIM if text.strip() == "0" else Style.PLAIN)
