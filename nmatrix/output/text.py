"""Plain or coloured text for people: what is named, what is true, and why.

The lines are built as styled spans and become characters at the very end.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import groupby
from textwrap import wrap

from nmatrix.output.drawing import draw_formula, draw_matrix, draw_table, draw_vector
from nmatrix.output.exact import written
from nmatrix.output.numbers import is_matrix, is_number, is_vector
from nmatrix.output.style import Line, Span, Style, plain, printable, render, spelled, width
from nmatrix.output.write import Charset, OutputOptions
from nmatrix.report import (
    Blank,
    Block,
    Brief,
    Code,
    Figure,
    Formula,
    Framed,
    Heading,
    PageBreak,
    Quantity,
    Report,
    Step,
    Symbols,
    Table,
    Task,
    Text,
    Tone,
    Verdict,
)
from nmatrix.typed import TypedRows

INDENT = Span("  ")
BLANK = 6  # characters of a cell to fill in
_PLACE_IN_A_LIST = re.compile(r"^.*\.\d+\.")  # of a key such as spaces.0.space_from_world
LABEL = 30  # the widest label that others are lined up with
BULLETS = {Charset.UNICODE: "•", Charset.ASCII: "*"}
RULES = {Charset.UNICODE: "─", Charset.ASCII: "-"}
TONES = {Tone.NEUTRAL: Style.TITLE, Tone.RIGHT: Style.RIGHT, Tone.WRONG: Style.WRONG}
MARKS = {
    (Charset.UNICODE, True): "✓",
    (Charset.UNICODE, False): "✗ not proved:",
    (Charset.ASCII, True): "ok",
    (Charset.ASCII, False): "NOT PROVED:",
}


def write(report: Report, options: OutputOptions) -> str:
    """Write the report in lines of at most `options.width` columns.

    Examples
    --------
    >>> answer = Report("calc", {}, (Quantity("value", (1, 2, 3)),), ("Three numbers.",))
    >>> print(write(answer, OutputOptions()), end="")
    value  ( 1  2  3 )
    <BLANKLINE>
    • Three numbers.
    """
    writer = _Writer(options)
    short = None if options.full else report.brief
    parts = writer.parts(report) if short is None else writer.brief(short, report)
    written = ("".join(render(line, options.colour) + "\n" for line in part) for part in parts)
    return "\n".join(part for part in written if part)


def _is_labelled(block: Block) -> bool:
    """Recognise a value that stands beside its label, with no empty line to its neighbours."""
    return isinstance(block, Quantity) and not is_matrix(block.value)


class _Writer:
    """Draws each kind of block with one set of options."""

    def __init__(self, options: OutputOptions) -> None:
        self.options = options

    def parts(self, report: Report) -> Iterator[list[Line]]:
        """Draw the parts that empty lines stand between."""
        yield from self._parts_of(report.blocks)
        yield [line for remark in report.remarks for line in self._remark(remark)]

    def brief(self, short: Brief, report: Report) -> Iterator[list[Line]]:
        """Draw the short answer: its parts, as many remarks as find room, and what is left.

        Remarks on what the answer is of find room in any case: the last part makes room for them.
        """
        parts = [part for part in self._parts_of(short.blocks) if part]
        drawn = [self._remark(one) for one in report.remarks]
        shown: list[list[Line]] = []
        for most, kept, last in self._ways(len(parts), short, report):
            told = [line for one in drawn[:kept] for line in one]
            shown = [part for part in (*parts[:most], told, last) if part]
            if sum(len(part) + 1 for part in shown) - 1 <= short.lines:
                break
        yield from shown

    def _ways(
        self, parts: int, short: Brief, report: Report
    ) -> Iterator[tuple[int, int, list[Line]]]:
        """List ways to be shorter: how many parts and remarks stay, and the line on the others."""
        every = len(report.remarks)
        for kept in range(every, report.about - 1, -1):
            yield parts, kept, self._what_is_left(short, every - kept)
        if report.about:
            rest: list[Line] = [(Span("--full adds the rest.", Style.DIM),)]
            yield parts, report.about, rest
            for most in range(parts - 1, 0, -1):
                yield from ((most, kept, rest) for kept in range(every, report.about - 1, -1))

    def _what_is_left(self, short: Brief, remarks: int) -> list[Line]:
        more = list(short.more)
        if remarks:
            more.append("a remark" if remarks == 1 else f"{remarks} remarks")
        if not more:
            return []
        listed = more[0] if len(more) == 1 else f"{', '.join(more[:-1])} and {more[-1]}"
        return [(Span(line, Style.DIM),) for line in self._wrapped(f"--full adds {listed}.", 0)]

    def _parts_of(self, blocks: Iterable[Block]) -> Iterator[list[Line]]:
        for labelled, group in groupby(blocks, _is_labelled):
            if labelled:
                yield self._labelled([block for block in group if isinstance(block, Quantity)])
            else:
                yield from map(self._block, group)

    def _remark(self, text: str) -> list[Line]:
        bullet = BULLETS[self.options.charset]
        lines = self._wrapped(text, 2)
        return [
            (Span(f"{bullet} " if i == 0 else "  "), Span(line)) for i, line in enumerate(lines)
        ]

    def _block(self, block: Block) -> list[Line]:  # noqa: C901, PLR0912  # one branch for each kind of block
        match block:
            case Heading(text):
                lines = self._heading(text)
            case Text(text):
                lines = self._lines(text)
            case Verdict(text, tone):
                lines = self._lines(text, TONES[tone])
            case Quantity():
                lines = self._matrix(block)
            case Table():
                lines = self._table(block)
            case Formula():
                lines = self._formula(block)
            case Step():
                lines = self._step(block)
            case Code():
                lines = self._code(block)
            case Figure():
                lines = self._figure(block)
            case Symbols(meanings):
                lines = self._table(Table(("", ""), meanings))
            case Framed(blocks):
                lines = [line for one in blocks for line in self._block(one)]
            case Blank(rows, columns):
                lines = [plain("  ".join(["_" * BLANK] * columns))] * rows
            case Task(title, blocks):
                lines = [line for one in (Heading(title), *blocks) for line in self._block(one)]
            case PageBreak():
                lines = []
        return lines

    def _spelled(self, text: str) -> str:
        return spelled(printable(text), self.options.charset)

    def _wrapped(self, text: str, indent: int) -> list[str]:
        lines = self._spelled(text).splitlines()
        room = max(self.options.width - indent, 10)
        return [piece for line in lines for piece in wrap(line, room) or [""]]

    def _lines(self, text: str, style: Style = Style.PLAIN) -> list[Line]:
        wrapped = self._wrapped(text, 0)
        if style is Style.PLAIN:
            return list(map(plain, wrapped))
        return [(Span(line, style),) for line in wrapped]

    def _heading(self, text: str) -> list[Line]:
        lines = self._lines(text, Style.TITLE)
        rule = RULES[self.options.charset] * max(map(width, lines), default=0)
        return [*lines, (Span(rule, Style.DIM),)]

    def _titled(self, title: str, lines: list[Line]) -> list[Line]:
        return [*self._lines(title, Style.TITLE), *lines]

    def _matrix(self, block: Quantity) -> list[Line]:
        assert is_matrix(block.value)  # every other quantity has a label
        title = "" if block.title == block.key else block.title
        about = [part for part in (title, block.unit and f"in {block.unit}") if part]
        name = _PLACE_IN_A_LIST.sub("", block.key)
        head = [Span(self._spelled(name), Style.TITLE)]
        if about:
            head.append(Span(self._spelled(": " + ", ".join(about))))
        lines = draw_matrix(block.value, self.options)
        return [tuple(head), *((INDENT, *line) for line in lines)]

    def _labelled(self, blocks: list[Quantity]) -> list[Line]:
        labels = [self._spelled(block.title or block.key) for block in blocks]
        room = max((len(label) for label in labels if len(label) <= LABEL), default=0)
        lines: list[Line] = []
        for label, block in zip(labels, blocks, strict=True):
            values = self._values(block, room + 2)
            if len(label) > room or len(values) > 1:
                lines += [plain(label), *((INDENT, *value) for value in values)]
            else:
                lines.append((Span(label.ljust(room) + "  "), *values[0]))
        return lines

    def _values(self, block: Quantity, indent: int) -> list[Line]:
        """Write a scalar, a vector or a word, on as many lines as it needs."""
        value, unit = block.value, self._spelled(f" {block.unit}" if block.unit else "")
        if is_vector(value):
            room = self.options.width - indent - len(unit)
            lines = draw_vector(value, replace(self.options, width=room))
            return [*lines[:-1], (*lines[-1], Span(unit))] if unit else lines
        if is_number(value):
            return [plain(self._spelled(written(value, self.options)) + unit)]
        if value is None:
            return [(Span("none", Style.DIM),)]
        return [plain(line) for line in self._wrapped(str(value) + unit, indent)] or [()]

    def _table(self, block: Table) -> list[Line]:
        cells = [[self._cell(cell) for cell in row] for row in block.rows]
        numeric = [any(is_number(row[i]) for row in block.rows) for i in range(len(block.columns))]
        columns = [self._spelled(column) for column in block.columns]
        rule = RULES[self.options.charset]
        lines = draw_table(columns, cells, numeric, (self.options.width, rule))
        return self._titled(block.title, lines)

    def _cell(self, cell: object) -> str:
        if cell is None:
            return RULES[self.options.charset][0]
        if isinstance(cell, bool):
            return "yes" if cell else "no"
        if is_number(cell):
            return self._spelled(written(cell, self.options))
        if isinstance(cell, Formula):
            return self._spelled(draw_formula(cell))
        return self._spelled(str(cell)).replace("\n", " ")

    def _formula(self, block: Formula) -> list[Line]:
        parts = tuple(map(self._typed, block.parts))  # spelled first: some spellings are longer
        lines = self._spelled(draw_formula(Formula(parts), self.options.width - 2)).splitlines()
        if not all(isinstance(part, str) for part in block.parts):
            return [(INDENT, Span(line)) for line in lines]
        return [(INDENT, Span(piece)) for line in lines for piece in self._hung(line)]

    def _typed(self, part: str | TypedRows) -> str | TypedRows:
        if isinstance(part, str):
            return self._spelled(part)
        return tuple(tuple(map(self._spelled, row)) for row in part)

    def _hung(self, line: str) -> list[str]:
        """Wrap a line of a formula where no sign broke it, below its first word."""
        indent = line[: len(line) - len(line.lstrip())]
        room = max(self.options.width - 2, 10)
        return wrap(line.strip(), room, initial_indent=indent, subsequent_indent=indent) or [""]

    def _step(self, block: Step) -> list[Line]:
        mark = MARKS[self.options.charset, block.verified]
        style = Style.RIGHT if block.verified else Style.WRONG
        lines = self._formula(block.formula) or [()]
        reason = self._wrapped(block.because, 6 + len(mark))
        first = (Span("    "), Span(mark, style), Span(" " + (reason[0] if reason else "")))
        rest = [(Span(" " * (5 + len(mark))), Span(line)) for line in reason[1:]]
        return [*lines, first, *rest]

    def _code(self, block: Code) -> list[Line]:
        text = self._spelled(block.text.expandtabs(4))
        return self._titled(block.title, [plain(line) for line in text.splitlines()])

    def _figure(self, block: Figure) -> list[Line]:
        return self._lines(f"{block.caption}: {block.path}" if block.caption else block.path)
