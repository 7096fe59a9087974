"""What a result says before anyone shows it: data for machines, blocks for people.

A `Report` is the only thing that goes from the core to a writer. `data` holds the keys of the
command-line contract; `blocks` tell the same story to a person; `remarks` are the teaching part.
A `Quantity` names its place in `data` by its `key`, so that every format speaks of the same number.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from fractions import Fraction
from functools import cached_property
from importlib import import_module
from typing import TYPE_CHECKING, Any, TypeVar, overload

from nmatrix.enums import Numbers, Severity
from nmatrix.errors import NMatrixError, spelled
from nmatrix.surds import Surd, is_short

if TYPE_CHECKING:
    from nmatrix.formula import Row
    from nmatrix.typed import TypedRows

Entry = TypeVar("Entry", covariant=True)

Number = int | float | Fraction
Vector = tuple[Number, ...]
Matrix = tuple[Vector, ...]
Shown = Number | Surd  # what a writer can print, to the last digit if need be
ShownVector = tuple[Shown, ...]
ShownMatrix = tuple[ShownVector, ...]
ENVELOPE = ("command", "version", "layout", "remarks")  # keys of every answer as data
LARGEST_MATRIX = 8  # rows and columns: the eight corners of a box


@dataclass(frozen=True)
class Heading:
    """A line that opens a part of the report."""

    text: str


@dataclass(frozen=True)
class Text:
    """A sentence or a short paragraph."""

    text: str


class Tone(StrEnum):
    """What a conclusion tells its reader: that it is right, that it is wrong, or neither."""

    NEUTRAL = "neutral"
    RIGHT = "right"
    WRONG = "wrong"


@dataclass(frozen=True)
class Verdict:
    """The one-line conclusion."""

    text: str
    tone: Tone = Tone.NEUTRAL


@dataclass(frozen=True)
class Quantity:
    """A named number, vector or matrix; `key` is its dotted path in the report's data."""

    key: str
    value: Shown | ShownVector | ShownMatrix | str | None
    title: str = ""
    unit: str = ""


@dataclass(frozen=True)
class Formula:
    """Words as one types them and matrices of such words, side by side.

    `parts` is what text shows; every other notation is printed from the tree that they spell.

    Examples
    --------
    >>> Formula(("n = ", (("1/2",), ("−1",)))).tree.items[0]
    Name(text='n')
    """

    parts: tuple[str | TypedRows, ...]

    @cached_property
    def tree(self) -> Row:
        """The formula as mathematics."""
        from nmatrix.formula import parse_parts  # most reports have no formula

        return parse_parts(self.parts)


Cells = tuple[Number | str | bool | Formula | None, ...]


@dataclass(frozen=True)
class Table:
    """Rows of cells under column names; numbers stay numbers until a writer formats them."""

    columns: tuple[str, ...]
    rows: Sequence[Cells]
    title: str = ""


@dataclass(frozen=True)
class Step:
    """One line of a derivation: the formula, why it follows, and whether it was proved."""

    formula: Formula
    because: str
    verified: bool


@dataclass(frozen=True)
class Code:
    """Program text in a named language."""

    language: str
    text: str
    title: str = ""


@dataclass(frozen=True)
class Figure:
    """A picture file with the sentence that replaces it for those who cannot see it.

    `title` is the claim that the caption begins with.

    Raises
    ------
    ValueError
        If there is no such sentence.
    """

    path: str
    alternative: str
    caption: str = ""
    title: str = ""

    def __post_init__(self) -> None:
        if not self.alternative.strip():
            raise ValueError(f"the picture {self.path} needs words for those who cannot see it")


@dataclass(frozen=True)
class Symbols:
    """Letters, each with the words for what it stands for."""

    meanings: tuple[tuple[str, str], ...]


@dataclass(frozen=True)
class Framed:
    """Blocks in a frame, which the eye finds first: a theorem and its proof."""

    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Blank:
    """Room for an answer on paper: rows and columns of lines, below room to work if it has some.

    Examples
    --------
    >>> Blank(3, 1).names, Blank(1, 1).names, Blank(4, 4).names
    (('x', 'y', 'z'), ('',), ())
    """

    rows: int
    columns: int
    has_room: bool = False

    @property
    def names(self) -> tuple[str, ...]:
        """The names of its lines where they stand side by side; a matrix has none."""
        if self.columns > 1:
            return ()
        return ("x", "y", "z") if self.rows == 3 else ("",) * self.rows


@dataclass(frozen=True)
class Task:
    """An exercise that stays on one page: what is asked, room for the answer, and its points.

    Without points there is room for the teacher to write some.
    """

    title: str
    blocks: tuple[Block, ...]
    points: int | None = None


@dataclass(frozen=True)
class PageBreak:
    """Where a printed page ends."""


Block = (
    Heading
    | Text
    | Verdict
    | Quantity
    | Table
    | Formula
    | Step
    | Code
    | Figure
    | Symbols
    | Framed
    | Blank
    | Task
    | PageBreak
)

SCREEN = 22  # lines of a short answer: with the command and the next prompt a screen of 24


@dataclass(frozen=True)
class Brief:
    """The short answer, which a person sees whole on a small screen.

    Parameters
    ----------
    blocks
        What was asked for and the verdict, the most important first.
    more
        Words for what only the whole answer has.
    lines
        How many there may be, remarks and the last line included; remarks that find no room are
        counted.
    """

    blocks: tuple[Block, ...]
    more: tuple[str, ...] = ()
    lines: int = SCREEN


# What JSON can say, with exact fractions; a step is an object of four keys.
Value = None | bool | str | Shown | Step | Sequence["Value"] | Mapping[str, "Value"]


class OnDemand(Sequence[Entry]):
    """A sequence that is made when someone looks into it; most formats never do.

    Examples
    --------
    >>> rows = OnDemand(lambda: print("made") or ["a", "b"])
    >>> len(rows), rows[0]
    made
    (2, 'a')
    """

    def __init__(self, make: Callable[[], Iterable[Entry]]) -> None:
        self._make = make

    @cached_property
    def _made(self) -> tuple[Entry, ...]:
        return tuple(self._make())

    def __len__(self) -> int:
        return len(self._made)

    @overload
    def __getitem__(self, place: int) -> Entry: ...

    @overload
    def __getitem__(self, place: slice) -> Sequence[Entry]: ...

    def __getitem__(self, place: int | slice) -> Entry | Sequence[Entry]:
        return self._made[place]


@dataclass(frozen=True)
class Rule:
    """What a finding goes against; its `code` never changes, so that people can switch it off."""

    code: str
    name: str
    sentence: str
    advice: str


@dataclass(frozen=True)
class Finding:
    """One fault in a file: on a line of it, or at a named place in what it describes.

    `line` and `column` count from 1; 0 where a fault is on no line.
    """

    rule: Rule
    severity: Severity
    message: str
    file: str
    line: int = 0
    column: int = 0
    place: str = ""


@dataclass(frozen=True)
class Findings:
    """What was looked for, and what was found."""

    rules: tuple[Rule, ...]
    found: Sequence[Finding]


@dataclass(frozen=True)
class Score:
    """The points of one answer, of how many, and what is said about it."""

    name: str
    points: Fraction
    most: int
    explanation: str


@dataclass(frozen=True)
class Submission:
    """All that one student handed in, answer by answer."""

    student: str
    scores: tuple[Score, ...]


@dataclass(frozen=True)
class Report:
    """The answer of one command.

    `failure` is the error that the answer still ends in (an undefined normal, a failed check):
    the whole report is shown first, then its one line. `records` is for an answer that is a list
    of rows by nature, such as the grades of a class: as CSV it is written as that table.
    `findings` are the faults that a check of files met, `submissions` the scores that a grader
    gave. `glsl` is code that a shader needs beside the numbers. `brief` is what text shows unless
    all is asked for; the first `about` remarks tell what the answer is of, and are shown with it
    whatever room there is. `numbers` is how people read its numbers unless they say; it is exact
    where fractions are kept as they were typed, while those of other answers stand for the floats
    that programs are given.
    """

    command: str
    data: Mapping[str, Value]
    blocks: tuple[Block, ...]
    remarks: tuple[str, ...] = ()
    failure: NMatrixError | None = field(default=None, compare=False)
    records: Table | None = None
    findings: Findings | None = None
    submissions: tuple[Submission, ...] = ()
    glsl: str = ""
    brief: Brief | None = None
    about: int = 0
    numbers: Numbers = Numbers.DECIMAL

    @classmethod
    def of_value(cls, *blocks: Block) -> Report:
        """Tell of a value that nobody asked a question about, in short fractions and roots.

        Examples
        --------
        >>> Report.of_value(Quantity("a", (Fraction(1, 3), Fraction(3**0.5)))).blocks[0].value
        (Fraction(1, 3), 1.7320508075688772)
        """
        return cls("show", {}, _each_number(blocks, _short_or_nearest), numbers=Numbers.EXACT)

    def spelled(self, spell: Callable[[str], str]) -> Report:
        """Spell the names of quantities in sentences and remarks as the caller types them."""
        return replace(
            self,
            blocks=tuple(
                Text(spelled(one.text, spell)) if isinstance(one, Text) else one
                for one in self.blocks
            ),
            remarks=tuple(spelled(one, spell) for one in self.remarks),
        )

    def in_floats(self) -> Report:
        """Take each fraction for the float64 nearest to it; beyond their range it stays.

        Examples
        --------
        >>> Report("world", {"a": (Fraction(1, 2), 3)}, ()).in_floats().data
        {'a': (0.5, 3)}
        """
        short = self.brief
        return replace(
            self,
            data=_each_number(self.data, _nearest),
            blocks=_each_number(self.blocks, _nearest),
            brief=short and replace(short, blocks=_each_number(short.blocks, _nearest)),
        )


class Displayed(ABC):
    """A value that shows itself in a notebook: it says its blocks, and one function writes them.

    That function stands with the writers, floors above, and is found by its name when a notebook
    asks: who never shows a value never loads it.
    """

    @abstractmethod
    def _repr_report_(self) -> Report:
        """Tell this value to a person."""

    def _repr_mimebundle_(self, **_: object) -> dict[str, str | bytes]:
        """Show the value as HTML with MathML, as LaTeX, and as text."""
        found: dict[str, str | bytes] = import_module("nmatrix.output.notebook").bundle(self)
        return found


def _each_number(value: Any, told: Callable[[Fraction], Number]) -> Any:  # noqa: ANN401  # whatever a report holds
    """Take each fraction in a part of a report for what stands in its place."""
    match value:
        case Fraction():
            found: object = told(value)
        case Mapping():
            found = {key: _each_number(one, told) for key, one in value.items()}
        case Quantity():
            found = replace(value, value=_each_number(value.value, told))
        case Table():
            found = replace(value, rows=_each_number(value.rows, told))
        case Framed() | Task():
            found = replace(value, blocks=_each_number(value.blocks, told))
        case Sequence() if not isinstance(value, str):
            found = tuple(_each_number(one, told) for one in value)
        case _:
            found = value
    return found


def _nearest(value: Fraction) -> float | Fraction:
    try:
        rounded = float(value)
    except OverflowError:
        return value
    return rounded if rounded or not value else value


def _short_or_nearest(value: Fraction) -> Number:
    """Keep a fraction that people write; of one that only stands for √3/2 its float is told."""
    return value if is_short(value) else _nearest(value)
