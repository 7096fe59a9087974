"""A report as a document: one walk over its blocks, in the words of whichever dialect."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator, Sequence
from fractions import Fraction

from nmatrix.enums import Numbers
from nmatrix.formula import Grid, Name, Node, Numeral, Power, Quotient, Root, Row, Sign, parse
from nmatrix.output.exact import SAME, exact_and_decimal, relation, short_form
from nmatrix.output.numbers import is_matrix, is_number, is_vector, leaves, significant
from nmatrix.output.symbols import label, letter
from nmatrix.output.write import OutputOptions
from nmatrix.report import (
    Blank,
    Block,
    Code,
    Figure,
    Formula,
    Framed,
    Heading,
    PageBreak,
    Quantity,
    Report,
    Shown,
    ShownMatrix,
    Step,
    Symbols,
    Table,
    Task,
    Text,
    Tone,
    Verdict,
)
from nmatrix.surds import Surd

Cells = Sequence[Sequence[str]]


class Dialect(ABC):
    """How one document format writes each kind of block.

    Sentences and titles come in unescaped; cells and values are already written, by `inline` for
    numbers, by `words` for all else.
    """

    def __init__(self, options: OutputOptions) -> None:
        self.options = options

    @abstractmethod
    def heading(self, text: str) -> str:
        """Write a heading."""

    def paragraph(self, text: str) -> str:
        """Write a paragraph."""
        return self.words(text)

    @abstractmethod
    def strong(self, text: str) -> str:
        """Write the one-line conclusion."""

    def verdict(self, text: str, tone: Tone) -> str:  # for those that have colours
        """Write the one-line conclusion as what it tells: right, wrong or neither."""
        return self.strong(text)

    @abstractmethod
    def matrix(self, key: str, title: str, equation: Node) -> str:
        """Write a matrix, or a vector as one column, in the equation that names it.

        Its key is for programs; the title says what the name does not.
        """

    def scalar(self, title: str, value: str) -> str:
        """Write a number or a word under its title."""
        return f"{self.words(title)}: {value}"

    @abstractmethod
    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table."""

    @abstractmethod
    def formula(self, formula: Formula) -> str:
        """Write a formula that stands by itself."""

    def code(self, language: str, text: str) -> str:
        """Write program text; Markdown and Typst have the same fences."""
        return f"```{language}\n{text.rstrip()}\n```"

    def remarks(self, remarks: Sequence[str]) -> str:
        """Write the remarks as a list; Markdown and Typst have the same dashes."""
        return "\n".join(f"- {self.words(remark)}" for remark in remarks)

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write one line of a derivation, with its reason."""
        mark = "proved" if verified else "NOT PROVED"
        return f"{self.formula(formula)}\n\n{self.paragraph(f'{because} ({mark})')}"

    def figure(self, figure: Figure) -> str:
        """Write a picture; where pictures cannot stand, the sentence in its place."""
        return self.paragraph(figure.alternative)

    def symbols(self, meanings: Sequence[tuple[str, str]]) -> str:
        """Write letters, already written, beside their words."""
        return self.table("", ("", ""), meanings)

    def framed(self, body: str) -> str:
        """Put a frame around some blocks, where the format has frames."""
        return body

    def blank(self, blank: Blank) -> str:
        """Leave room for an answer."""
        return self.table("", [" "] * blank.columns, [[" "] * blank.columns] * (blank.rows - 1))

    def task(self, task: Task, body: str) -> str:
        """Write an exercise under its title."""
        points = f" ({task.points} points)" if task.points else ""
        return f"{self.heading(task.title + points)}\n\n{body}"

    def page_break(self) -> str:
        """End a printed page, where the format has pages."""
        return ""

    @abstractmethod
    def inline(self, node: Node) -> str:
        """Write a number, or an equation of one, in a sentence or a table."""

    def inline_formula(self, formula: Formula) -> str:
        """Write a formula in a sentence or a table, on one line."""
        return self.words("".join(part for part in formula.parts if isinstance(part, str)))

    @abstractmethod
    def words(self, text: str) -> str:
        """Escape a text, so that it is shown as it is."""


def blocks_in(blocks: Sequence[Block], dialect: Dialect) -> str:
    """Write some blocks in a dialect, parted by empty lines."""
    written = (_block(block, dialect).rstrip("\n") for block in blocks)
    return "\n\n".join(part for part in written if part)


def compose(report: Report, dialect: Dialect) -> str:
    """Write the whole report in a dialect, ending in a newline."""
    body = blocks_in((*report.blocks, *_not_shown_yet(report)), dialect)
    remarks = dialect.remarks(report.remarks) if report.remarks else ""
    return "\n\n".join(part for part in (body, remarks) if part) + "\n"


def _not_shown_yet(report: Report) -> Iterator[Quantity]:
    """Find the matrices and vectors of the data that no block shows under their key."""
    told = {block.key for block in report.blocks if isinstance(block, Quantity)}
    for leaf in leaves(report.data):
        if leaf.key not in told and (is_matrix(leaf.value) or is_vector(leaf.value)):
            yield Quantity(leaf.key, leaf.value)


def _block(block: Block, dialect: Dialect) -> str:  # noqa: C901, PLR0912  # one branch for each kind of block
    match block:
        case Heading(text):
            found = dialect.heading(text)
        case Text(text):
            found = dialect.paragraph(text)
        case Verdict(text, tone):
            found = dialect.verdict(text, tone)
        case Quantity():
            found = _quantity(block, dialect)
        case Table(columns, rows, title):
            cells = [[_cell(cell, dialect) for cell in row] for row in rows]
            found = dialect.table(title, columns, cells)
        case Formula():
            found = dialect.formula(block)
        case Step(formula, because, verified):
            found = dialect.step(formula, because, verified=verified)
        case Code(language, text, title):
            about = f"{dialect.paragraph(title)}\n\n" if title else ""
            found = about + dialect.code(language, text)
        case Figure():
            found = dialect.figure(block)
        case Symbols(meanings):
            written = ((Formula((letter,)), words) for letter, words in meanings)
            found = dialect.symbols(
                [(dialect.inline_formula(one), dialect.words(words)) for one, words in written]
            )
        case Framed(blocks):
            found = dialect.framed(blocks_in(blocks, dialect))
        case Blank():
            found = dialect.blank(block)
        case Task():
            found = dialect.task(block, blocks_in(block.blocks, dialect))
        case PageBreak():
            found = dialect.page_break()
    return found


def _quantity(block: Quantity, dialect: Dialect) -> str:
    value = block.value
    rows = _rows(value)
    if rows is not None:
        name, about = label(block.key, block.title)
        return dialect.matrix(block.key, about, _equation(name, rows, dialect.options))
    shown = _cell(value, dialect)
    if is_number(value) and (symbol := letter(block.key)):
        left = (*_pieces(parse(symbol)), Sign(SAME))
        shown = dialect.inline(Row((*left, *_pieces(formula_of(value, dialect.options)))))
    return dialect.scalar(block.title or block.key, shown + dialect.words(block.unit))


def _rows(value: object) -> ShownMatrix | None:
    """Take a matrix as it is and a vector as one column."""
    if is_matrix(value):
        return value
    return tuple((entry,) for entry in value) if is_vector(value) else None


def _equation(name: Node, rows: ShownMatrix, options: OutputOptions) -> Node:
    """Set a matrix equal to its name; a second one of decimals follows where both are wanted."""
    left = (*_pieces(name), Sign(SAME))
    if options.numbers is not Numbers.BOTH:
        return Row((*left, _grid(rows, options)))
    exact, decimal = (_grid(rows, one) for one in exact_and_decimal(options))
    sign = relation((entry for row in rows for entry in row), options.digits)
    return Row((*left, exact, *(() if sign is None else (Sign(sign), decimal))))


def _grid(rows: ShownMatrix, options: OutputOptions) -> Grid:
    return Grid(tuple(tuple(formula_of(entry, options) for entry in row) for row in rows))


def _pieces(node: Node) -> tuple[Node, ...]:
    return node.items if isinstance(node, Row) else (node,)


def _cell(value: object, dialect: Dialect) -> str:
    if is_number(value):
        return dialect.inline(formula_of(value, dialect.options))
    if isinstance(value, Formula):
        return dialect.inline_formula(value)
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    return dialect.words(" ".join(str(value).split()))


def formula_of(value: Shown, options: OutputOptions) -> Node:
    """Write a number as a formula.

    Examples
    --------
    >>> formula_of(1 / 3, OutputOptions(numbers=Numbers.EXACT))
    Quotient(top=Numeral(text='1'), bottom=Numeral(text='3'))
    """
    if options.numbers is Numbers.BOTH:
        sign = relation([value], options.digits)
        ways = [formula_of(value, one) for one in exact_and_decimal(options)]
        return ways[0] if sign is None else Row((ways[0], Sign(sign), ways[1]))
    exact = short_form(value, options)
    return _decimal(significant(value, options.digits)) if exact is None else _formula(exact)


def _decimal(text: str) -> Node:
    if text.endswith("inf"):
        return Name("∞") if text == "inf" else Row((Sign("−"), Name("∞")))
    mantissa, mark, exponent = text.partition("e")
    if not mark:
        return Numeral(text)
    power = Power(Numeral("10"), str(int(exponent)).replace("-", "−"))
    return Row((Numeral(mantissa), Sign("×"), power))


def _formula(exact: Fraction | Surd) -> Node:
    if isinstance(exact, Fraction):
        tops, bottom = [(1, exact.numerator)], exact.denominator
    else:
        tops, bottom = exact.over_one_denominator
    if bottom == 1 and len(tops) == 1 and tops[0][0] == 1:
        return Numeral(str(tops[0][1]))
    if len(tops) == 1:  # the minus of −√3/2 stands before the bar
        (under, before) = tops[0]
        over = _over(_term(under, abs(before)), bottom)
        return Row((Sign("−"), over)) if before < 0 else over
    items: list[Node] = []
    for under, before in tops:
        if items or before < 0:
            items.append(Sign("−" if before < 0 else "+"))
        items.append(_term(under, abs(before)))
    return _over(Row(tuple(items)), bottom)


def _over(top: Node, bottom: int) -> Node:
    return top if bottom == 1 else Quotient(top, Numeral(str(bottom)))


def _term(under: int, before: int) -> Node:
    if under == 1:
        return Numeral(str(before))
    root = Root(Numeral(str(under)))
    return root if before == 1 else Row((Numeral(str(before)), root))
