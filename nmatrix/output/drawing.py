"""Matrices, vectors, formulas and tables drawn in characters, for people.

A matrix has box brackets, aligned points, named axes, and a bar before t, the translation column
of an affine 4×4; fractions and roots end where a whole number would. Columns of a table are aligned
and fit the width: long sentences are wrapped inside their cells.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from itertools import chain
from textwrap import TextWrapper, wrap

from nmatrix.enums import Numbers
from nmatrix.linear.rational import is_affine
from nmatrix.output.exact import exact_and_decimal, relation, written
from nmatrix.output.style import AXES, Line, Span, Style, plain, spelled, width
from nmatrix.output.write import Charset, OutputOptions
from nmatrix.report import Formula, Shown, ShownMatrix, ShownVector
from nmatrix.typed import GAP, TypedRows, bar_of, columns_of

MARGIN = 8  # row name, two brackets, the bar
_WORDS = re.compile(r"\s+|\S+")
_NAMES = re.compile("/*[^/]+/*|/+")  # of a path, each with its separator
_BREAKS = tuple(  # where a formula may go on below: first before a statement, last before a term
    map(
        re.compile,
        (
            r"(?<!\s)(?= +(?:⇒|=>) )|(?<=,  )",
            r"(?<!\s)(?= [=≈~] )",
            r"(?<!\s)(?= (?:[+−·→*-]|->) (?!det ))",
        ),
    )
)
HANGING = "    "  # before what goes on below
BESIDE = 12  # columns of that, and of a name and a sign before a matrix that is cut
FORMULA = 78  # columns of a formula: with its indentation a line of 80
NARROWEST = 8  # columns that a wrapped cell of a table keeps
AXIS_NAMES = "xyzw"
BRACKETS = {  # of one row; of the first, a middle and the last of several
    Charset.UNICODE: (("[", "]"), ("⎡", "⎤"), ("⎢", "⎥"), ("⎣", "⎦")),
    Charset.ASCII: (("[", "]"),) * 4,
}
BARS = {Charset.UNICODE: "│", Charset.ASCII: "|"}


def aligned(texts: Sequence[str]) -> list[str]:
    """Pad numbers to one width, with their decimal points under each other.

    What has no point ends before that place.

    Examples
    --------
    >>> aligned(["0", "-1.5", "10"])
    [' 0  ', '-1.5', '10  ']
    >>> aligned(["√3/2", "-1/2", "0.25"])
    ['√3/2   ', '-1/2   ', '   0.25']
    """
    parts = [_at_point(text) for text in texts]
    left = max(len(whole) for whole, _ in parts)
    right = max(len(rest) for _, rest in parts)
    return [whole.rjust(left) + rest.ljust(right) for whole, rest in parts]


def _at_point(text: str) -> tuple[str, str]:
    place = next((i for i, mark in enumerate(text) if mark in ".e"), len(text))
    return text[:place], text[place:]


def _brackets(rows: int, charset: Charset) -> list[tuple[str, str]]:
    """Choose the opening and the closing bracket of each row of a matrix."""
    only, first, middle, last = BRACKETS[charset]
    return [only] if rows == 1 else [first, *[middle] * (rows - 2), last]


def draw_matrix(matrix: ShownMatrix, options: OutputOptions) -> list[Line]:
    """Draw a matrix; one too wide is cut between its columns.

    Where both exact numbers and decimals are wanted, the matrix of decimals stands beside, or
    below.

    Examples
    --------
    >>> from nmatrix.output.style import render
    >>> for line in draw_matrix(((1, 0), (0, 0.5)), OutputOptions()):
    ...     print(render(line, OutputOptions().colour))
    ⎡ 1  0   ⎤
    ⎣ 0  0.5 ⎦
    """
    if options.numbers is Numbers.BOTH:
        exact, decimal = (draw_matrix(matrix, one) for one in exact_and_decimal(options))
        return _side_by_side(exact, decimal, relation(chain(*matrix), options.digits), options)
    columns = _columns(matrix, options, aligned)
    groups = _groups(columns, options.width)
    if len(groups) > 1:
        columns = _columns(matrix, options, _right)
        groups = _groups(columns, options.width)
    lines: list[Line] = []
    for group in groups:
        lines += _draw_group(matrix, columns, group, options.charset)
    return lines


def draw_vector(vector: ShownVector, options: OutputOptions) -> list[Line]:
    """Draw a vector in one row, or as a column where the row would be too wide."""
    row = _row(vector, options)
    if width(row) + len(GAP) <= options.width:
        return [row]
    return draw_matrix(tuple((entry,) for entry in vector), options)


def _row(vector: ShownVector, options: OutputOptions) -> Line:
    if options.numbers is Numbers.BOTH:
        exact, decimal = (_row(vector, one) for one in exact_and_decimal(options))
        sign = relation(vector, options.digits)
        return exact if sign is None else (*exact, _between(sign, options), *decimal)
    spans = [Span("(")]
    for place, entry in enumerate(vector):
        spans += [Span(GAP if place else " "), _number(_text(entry, options))]
    return (*spans, Span(" )"))


def _side_by_side(
    exact: list[Line], decimal: list[Line], sign: str | None, options: OutputOptions
) -> list[Line]:
    """Put two drawings of a matrix side by side, or one below the other where they are too wide."""
    if sign is None:
        return exact
    between = _between(sign, options)
    left, right = max(map(width, exact)), max(map(width, decimal))
    if len(exact) != len(decimal) or len(GAP) + left + len(between.text) + right > options.width:
        return [*exact, (between,), *decimal]
    middle, gap = len(exact) // 2, Span(" " * len(between.text))
    return [
        (*one, Span(" " * (left - width(one))), between if place == middle else gap, *other)
        for place, (one, other) in enumerate(zip(exact, decimal, strict=True))
    ]


def _between(sign: str, options: OutputOptions) -> Span:
    return Span(f" {spelled(sign, options.charset)} ", Style.DIM)


def _text(entry: Shown, options: OutputOptions) -> str:
    return spelled(written(entry, options), options.charset)


def _columns(
    matrix: ShownMatrix, options: OutputOptions, align: Callable[[Sequence[str]], list[str]]
) -> list[list[str]]:
    columns = zip(*matrix, strict=True)
    return [align([_text(entry, options) for entry in column]) for column in columns]


def _right(texts: Sequence[str]) -> list[str]:
    longest = max(len(text) for text in texts)
    return [text.rjust(longest) for text in texts]


def _groups(columns: list[list[str]], limit: int) -> list[range]:
    """Cut the columns into runs that fit side by side."""
    groups, start, used = [], 0, MARGIN
    for place, column in enumerate(columns):
        needed = len(column[0]) + len(GAP)
        if place > start and used + needed > limit:
            groups.append(range(start, place))
            start, used = place, MARGIN
        used += needed
    return [*groups, range(start, len(columns))]


def _draw_group(
    matrix: ShownMatrix, columns: list[list[str]], group: range, charset: Charset
) -> list[Line]:
    barred = 3 if is_affine(matrix) and group[0] < 3 <= group[-1] else None
    named = 3 <= len(matrix) == len(columns) <= len(AXIS_NAMES)
    names = "xyzt" if is_affine(matrix) else AXIS_NAMES
    lines = [_header(columns, group, barred, names)] if named else []
    for place, (opening, closing) in enumerate(_brackets(len(matrix), charset)):
        spans = [_axis(AXIS_NAMES[place]), Span(" ")] if named else []
        spans.append(Span(opening + " "))
        for column in group:
            if column == barred:
                spans.append(Span(f" {BARS[charset]} ", Style.DIM))
            elif column != group[0]:
                spans.append(Span(GAP))
            spans.append(_number(columns[column][place]))
        lines.append((*spans, Span(" " + closing)))
    return lines


def _header(columns: list[list[str]], group: range, barred: int | None, names: str) -> Line:
    """Write the names of the columns over the ones digits of their numbers."""
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


def draw_formula(formula: Formula, width: int = FORMULA) -> str:
    """Draw a formula as it was typed, with tall brackets around its matrices.

    What is wider than `width` goes on below, from a sign between two of its terms; a matrix that
    is wider by itself, from a column.

    Examples
    --------
    >>> print(draw_formula(Formula(("A = ", (("1", "0"), ("0", "−2"))))))
    A = ⎡ 1   0 ⎤
        ⎣ 0  −2 ⎦
    """
    parts = [
        piece
        for part in formula.parts
        for piece in ([part] if isinstance(part, str) else _cut(part, width - BESIDE))
    ]
    return "\n".join(map(_drawn_band, _bands(parts, width, _BREAKS)))


def _cut(cells: TypedRows, width: int) -> list[TypedRows]:
    """Cut a matrix that is too wide between its columns; dots stand for those that are elsewhere.

    Examples
    --------
    >>> _cut((("100", "200", "300"),), 16)
    [(('100', '200', '…'),), (('…', '300'),)]
    """
    dots, bar = ("…",) * len(cells), bar_of(cells)
    pieces: list[list[tuple[str, ...]]] = [[]]
    for place, column in enumerate(zip(*cells, strict=True)):
        is_behind = bar and place == bar + 1  # the bar stays with what it parts from the rest
        wider = (*pieces[-1], column, *([dots] if place + 1 < len(cells[0]) else []))
        if len(pieces[-1]) > 1 and not is_behind and columns_of([_rows(wider)]) > width:
            pieces[-1].append(dots)
            pieces.append([dots])
        pieces[-1].append(column)
    return [_rows(piece) for piece in pieces]


def _rows(columns: Sequence[tuple[str, ...]]) -> TypedRows:
    return tuple(zip(*columns, strict=True))


def _bands(
    parts: Sequence[str | TypedRows], width: int, breaks: Sequence[re.Pattern[str]]
) -> list[list[str | TypedRows]]:
    """Cut parts into bands that fit, between statements if that does, else before weaker signs."""
    bands: list[list[str | TypedRows]] = []
    for group in _unbroken(parts, breaks[0]):
        head, *rest = group
        hung = [HANGING, head.lstrip() if isinstance(head, str) else head, *rest]
        if bands and columns_of((*bands[-1], *group)) <= width:
            bands[-1] += group
        elif columns_of(hung if bands else group) <= width or len(breaks) == 1:
            bands.append(hung if bands else group)
        else:
            bands += _bands(hung if bands else group, width, breaks[1:])
    return bands


def _unbroken(
    parts: Sequence[str | TypedRows], sign: re.Pattern[str]
) -> list[list[str | TypedRows]]:
    """Cut parts before the signs that a line may begin with, outside of parentheses."""
    groups: list[list[str | TypedRows]] = [[]]
    depth = 0
    for part in parts:
        if not isinstance(part, str) and part[0][0] == "…":
            groups.append([])
        pieces = sign.split(part) if isinstance(part, str) else [part]
        for place, piece in enumerate(pieces):
            if place and not depth:
                groups.append([])
            groups[-1].append(piece)
            if isinstance(piece, str):
                depth += piece.count("(") - piece.count(")")
    return [group for group in groups if group != [""]]


def _drawn_band(parts: Sequence[str | TypedRows]) -> str:
    """Draw what stands side by side, each matrix with its middle on the line of the text."""
    blocks = [[part] if isinstance(part, str) else _drawn_cells(part) for part in parts]
    height = max(map(len, blocks))
    padded = []
    for block in blocks:
        above = (height - len(block)) // 2
        width = max(map(len, block))
        empty = " " * width
        lines = [line.ljust(width) for line in block]
        padded.append([empty] * above + lines + [empty] * (height - above - len(block)))
    return "\n".join("".join(line).rstrip() for line in zip(*padded, strict=True))


def _drawn_cells(cells: TypedRows) -> list[str]:
    bar = bar_of(cells)
    rows = zip(*map(_right, zip(*cells, strict=True)), strict=True)
    around = _brackets(len(cells), Charset.UNICODE)
    return [
        f"{opening} {GAP.join(_barred(row, bar))} {closing}"
        for row, (opening, closing) in zip(rows, around, strict=True)
    ]


def _barred(row: Sequence[str], bar: int) -> Sequence[str]:
    """Draw the bar of [A | I] in the place of its cells."""
    return (*row[:bar], BARS[Charset.UNICODE], *row[bar + 1 :]) if bar else row


def draw_table(
    columns: Sequence[str],
    rows: Sequence[Sequence[str]],
    numeric: Sequence[bool],
    frame: tuple[int, str],
) -> list[Line]:
    """Draw a table; `frame` is the width to keep and the character of the rule.

    Numbers stand with their points aligned. A table that cannot fit becomes one record per row.

    Examples
    --------
    >>> from nmatrix.output.style import render
    >>> from nmatrix.output.write import Colour
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
        aligned(column) if is_numeric else column
        for column, is_numeric in zip(zip(*rows, strict=True), numeric, strict=True)
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


def _widths(
    columns: Sequence[str],
    cells: Sequence[Sequence[str]],
    numeric: Sequence[bool],
    limit: int,
) -> list[int] | None:
    """Fit the columns into the limit, and cut words only where they do not fit whole."""
    uncut = [
        max(len(cell) for cell in column) if number else max(map(_longest_word, column))
        for column, number in zip(cells, numeric, strict=True)
    ]
    floors = [size if number else NARROWEST for size, number in zip(uncut, numeric, strict=True)]
    whole = [max(pair) for pair in zip(uncut, floors, strict=True)]
    return _fitted(columns, cells, whole, limit) or _fitted(columns, cells, floors, limit)


def _longest_word(cell: str) -> int:
    words = _CellWrapper(1).words(cell)
    return max(map(len, words), default=0)


def _fitted(
    columns: Sequence[str], cells: Sequence[Sequence[str]], floors: Sequence[int], limit: int
) -> list[int] | None:
    """Take room from the widest columns first, none below its floor."""
    widths = [
        max(len(name), *(len(cell) for cell in column))
        for name, column in zip(columns, cells, strict=True)
    ]
    while sum(widths) + len(GAP) * (len(widths) - 1) > limit:
        spare = [size - floor for size, floor in zip(widths, floors, strict=True)]
        if max(spare) <= 0:
            return None
        candidates = [place for place, room in enumerate(spare) if room > 0]
        widths[max(candidates, key=lambda place: widths[place])] -= 1
    return widths


class _CellWrapper(TextWrapper):
    """Wraps words, and a path that is longer than a line after a separator of it."""

    def words(self, text: str) -> list[str]:
        return [word for word in self._split(text) if not word.isspace()]

    def _split(self, text: str) -> list[str]:
        return [piece for word in _WORDS.findall(text) for piece in self._pieces(word)]

    def _pieces(self, word: str) -> list[str]:
        if "/" not in word:
            return super()._split(word)
        return _NAMES.findall(word) if len(word) > self.width else [word]


def _wrapped(cells: Sequence[str], widths: list[int]) -> list[str]:
    """Write one row; a cell longer than its column goes on below."""
    pieces = [
        [cell] if len(cell) <= size else _CellWrapper(size).wrap(cell.strip()) or [""]
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
