"""What a learning platform asks: one field for each number, or one choice; platforms share it.

A platform compares each number by itself and cannot tell a multiple of a vector from a wrong one,
so every question asks for one definite form: A⁻ᵀ itself, the unit vector. A field knows the wrong
numbers that known mistakes give there, each with the mistakes that it is a sign of.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction

from nmatrix.errors import NoAnswerError
from nmatrix.lessons.check.judge import Judge
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.question import Question, Subject
from nmatrix.lessons.check.tolerance import RELATIVE, yardsticks
from nmatrix.lessons.exercises.exercise import Choice, Computed, Exercise
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercises
from nmatrix.linear.rational import ONE, RationalMatrix, determinant, linear_part, scaled
from nmatrix.report import Blank, Block

PLACES = 4  # behind the point, that an answer is to have
LAST_PLACE = Fraction(1, 10**PLACES)
FILE_PLACES = 9  # of the numbers in a file


@dataclass(frozen=True)
class WrongNumber:
    """A number that mistakes give, in the order of their table."""

    value: Fraction
    mistakes: tuple[MistakeId, ...]


@dataclass(frozen=True)
class NumberField:
    """One entry of an answer: the right number, how far off it may be, and known wrong ones.

    `row` and `column` count from 0.
    """

    row: int
    column: int
    right: Fraction
    tolerance: Fraction
    wrong: tuple[WrongNumber, ...]

    def is_right(self, number: Fraction) -> bool:
        """Decide if a number is near enough."""
        return abs(number - self.right) <= self.tolerance


@dataclass(frozen=True)
class Numbers:
    """The fields of a matrix, row by row, or of a vector, one in each row."""

    fields: tuple[NumberField, ...]
    question: Question
    is_flat: bool = False  # a normal of a flattened surface, of which two are unit vectors

    @property
    def rows(self) -> tuple[tuple[NumberField, ...], ...]:
        """The fields by their rows."""
        rows = 1 + max(field.row for field in self.fields)
        return tuple(tuple(one for one in self.fields if one.row == i) for i in range(rows))

    @property
    def coordinates(self) -> tuple[str, ...]:
        """The names of a vector's numbers; a matrix has none."""
        rows = self.rows
        return Blank(len(rows), len(rows[0])).names

    @property
    def mistakes(self) -> tuple[MistakeId, ...]:
        """All mistakes that show in some field, in the order of their table."""
        shown = {one for field in self.fields for wrong in field.wrong for one in wrong.mistakes}
        return tuple(one for one in MistakeId if one in shown)


@dataclass(frozen=True)
class BankQuestion:
    """One exercise of one sheet, as a platform asks it."""

    exercise: Exercise
    student: str
    form: Numbers | Choice

    @property
    def title(self) -> str:
        """The heading of the exercise, and whose it is."""
        return f"{self.exercise.title} · {self.student}" if self.student else self.exercise.title

    @property
    def task(self) -> tuple[Block, ...]:
        """What is asked, without the form of the answer."""
        return self.exercise.task


@dataclass(frozen=True)
class Bank:
    """A question bank: a name, the questions of each sheet, and the points of each question."""

    name: str
    sheets: tuple[tuple[BankQuestion, ...], ...]
    points: int = 1


def questions(sheet: Sheet, count: int) -> tuple[BankQuestion, ...]:
    """Make the questions of one sheet.

    Examples
    --------
    >>> [len(one.form.fields) for one in questions(Sheet("7", "Ada"), 2)]
    [16, 9]
    """
    return tuple(BankQuestion(one, sheet.student, _form(one)) for one in exercises(count, sheet))


def decimal(value: Fraction) -> str:
    """Write a number as platforms read it: a point, no exponent, no needless zeros.

    Examples
    --------
    >>> decimal(Fraction(1, 4)), decimal(Fraction(-2, 3)), decimal(Fraction(0))
    ('0.25', '-0.666666667', '0')
    """
    text = f"{float(round(value, FILE_PLACES)):.{FILE_PLACES}f}".rstrip("0").rstrip(".")
    return "0" if text == "-0" else text


def _form(one: Exercise) -> Numbers | Choice:
    if isinstance(one.grader, Choice):
        return one.grader
    assert isinstance(one.grader, Computed)
    return numbers_of(definite(one.grader.question))


def definite(question: Question) -> Question:
    """Ask for one form: the unit vector of a direction, A⁻ᵀ itself and no multiple of it."""
    return replace(question, unit=True) if question.any_length else question


def numbers_of(question: Question) -> Numbers:
    """Make the fields of a question that has one definite answer."""
    judge = Judge(question)
    is_flat = _is_flat(question)
    right = forwards(judge.right) if is_flat else judge.right
    rulers = _entries(yardsticks(right, is_vector=question.is_vector), question)
    tolerances = {place: max(LAST_PLACE, RELATIVE * ruler) for place, ruler in rulers.items()}
    shown = _entries(right, question)
    wrong = [
        (mistake, _entries(forwards(value) if is_flat else value, question))
        for mistake, value in _wrong_answers(judge)
    ]
    fields = (
        NumberField(
            *place, value, tolerances[place], _wrong_numbers(place, shown, tolerances[place], wrong)
        )
        for place, value in shown.items()
    )
    return Numbers(tuple(fields), question, is_flat)


def forwards(direction: RationalMatrix) -> RationalMatrix:
    """Turn a direction of which both signs are right so that its first number is positive.

    Examples
    --------
    >>> [int(x) for x in forwards(((Fraction(0), Fraction(-1), Fraction(2)),))[0]]
    [0, 1, -2]
    """
    first = next((entry for entry in direction[0] if entry), ONE)
    return scaled(direction, -ONE) if first < 0 else direction


Place = tuple[int, int]
Entries = dict[Place, Fraction]


def _entries(value: RationalMatrix, question: Question) -> Entries:
    """Place the entries that are asked for by row and column; a vector stands upright."""
    rows = tuple((entry,) for entry in value[0][:3]) if question.is_vector else value
    return {(i, j): entry for i, row in enumerate(rows) for j, entry in enumerate(row)}


def _is_flat(question: Question) -> bool:
    if question.subject is not Subject.NORMAL or question.normal is None:
        return False
    S = question.setup.maps.space_from_object(question.space).exact
    return determinant(linear_part(S)) == 0


def _wrong_answers(judge: Judge) -> Iterator[tuple[MistakeId, RationalMatrix]]:
    """List what each known mistake gives, in the order of the table."""
    for one in judge.wrong.of_singles():
        try:
            value = one.value
        except NoAnswerError:
            continue
        if value is not None:
            yield one.mistakes[0], value


def _wrong_numbers(
    place: Place,
    right: Entries,
    tolerance: Fraction,
    wrong: list[tuple[MistakeId, Entries]],
) -> tuple[WrongNumber, ...]:
    """Collect the numbers that mistakes give at a place and that are right nowhere.

    A number that is right at another place may as well have been put into the wrong field.
    """
    found: dict[Fraction, list[MistakeId]] = {}
    for mistake, entries in wrong:
        number = entries.get(place)
        if number is None or any(abs(number - one) <= tolerance for one in right.values()):
            continue
        known = next((one for one in found if abs(one - number) <= tolerance), number)
        named = found.setdefault(known, [])
        if mistake not in named:
            named.append(mistake)
    return tuple(WrongNumber(value, tuple(named)) for value, named in found.items())
