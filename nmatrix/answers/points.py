"""Points of a class: a part for each entry that is right, a row for each student."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction

from nmatrix.lessons.check.judge import Judgement, Outcome
from nmatrix.report import Block, Cells, Report, Score, Submission, Table, Value

VECTOR = 3  # entries of a vector that is asked for; its w is none of them
SHOWN = 2  # decimals of points


@dataclass(frozen=True)
class Graded:
    """One answer: whose, to which exercise, the part of it that is right, and what is said."""

    student: str
    exercise: str
    share: Fraction
    explanation: str


def share(found: Judgement) -> Fraction:
    """Give the part of the entries that are right; a wrong answer without a wrong entry has none.

    Examples
    --------
    >>> one = Fraction(1)
    >>> share(Judgement(Outcome.UNKNOWN, ((one,) * 4,), one, ((0, 1),)))
    Fraction(2, 3)
    """
    if found.verdict is Outcome.CORRECT:
        return Fraction(1)
    rows, columns = len(found.right), len(found.right[0])
    entries = VECTOR if rows == 1 and columns > VECTOR else rows * columns
    wrong = len(found.wrong_entries) or entries
    return max(Fraction(0), 1 - Fraction(wrong, entries))


def submission(name: str, found: Judgement) -> Submission:
    """Hand in one answer, for one point."""
    return Submission("", (Score(name, share(found), 1, found.explanation),))


def worth(report: Report, points: int) -> Report:
    """Give an answer so many points in the place of one."""
    submissions = tuple(
        replace(
            one,
            scores=tuple(
                replace(score, points=score.points * points, most=score.most * points)
                for score in one.scores
            ),
        )
        for one in report.submissions
    )
    return replace(report, submissions=submissions)


@dataclass(frozen=True)
class Gradebook:
    """The points of a class: of each exercise and in all; a later answer replaces an earlier one.

    Parameters
    ----------
    answers
        By student and exercise, in the order in which they first came.
    points
        Of each exercise.
    """

    answers: dict[tuple[str, str], Graded]
    points: int

    @classmethod
    def of(cls, answers: Iterable[Graded], points: int) -> Gradebook:
        """Enter the answers of a class."""
        return cls({(one.student, one.exercise): one for one in answers}, points)

    @property
    def students(self) -> tuple[str, ...]:
        """The students, in the order of their first answers."""
        return tuple(dict.fromkeys(student for student, _ in self.answers))

    @property
    def exercises(self) -> tuple[str, ...]:
        """The exercises that somebody answered, by their numbers."""
        named = dict.fromkeys(exercise for _, exercise in self.answers)
        return tuple(sorted(named, key=lambda one: (len(one), one)))

    @property
    def most(self) -> int:
        """The points of everything that is asked for."""
        return self.points * len(self.exercises)

    def points_of(self, student: str, exercise: str) -> Fraction | None:
        """Give the points of one answer; None where there is none."""
        found = self.answers.get((student, exercise))
        return None if found is None else found.share * self.points

    def total(self, student: str) -> Fraction:
        """Add the points of a student; what was not answered has none."""
        return sum(
            (self.points_of(student, one) or Fraction(0) for one in self.exercises), Fraction(0)
        )

    @property
    def table(self) -> Table:
        """One row a student: the points of each exercise, and of all."""
        rows = tuple(self._row(student) for student in self.students)
        return Table(("student", *self._columns, "points", "of"), rows)

    @property
    def blocks(self) -> tuple[Block, ...]:
        """The totals, a row a student."""
        rows = tuple(
            (student, _rounded(self.total(student)), self.most) for student in self.students
        )
        return (Table(("student", "points", "of"), rows),)

    @property
    def data(self) -> list[Value]:
        """The same for machines."""
        return [
            {
                "student": student,
                "points": self.total(student),
                "of": self.most,
                "exercises": {
                    exercise or "answer": self.points_of(student, exercise)
                    for exercise in self.exercises
                },
            }
            for student in self.students
        ]

    @property
    def submissions(self) -> tuple[Submission, ...]:
        """What an autograder reports, one a student."""
        return tuple(
            Submission(student, tuple(self._score(student, one) for one in self.exercises))
            for student in self.students
        )

    @property
    def _columns(self) -> Sequence[str]:
        return [f"exercise {one}" if one else "answer" for one in self.exercises]

    def _row(self, student: str) -> Cells:
        points = (self.points_of(student, one) for one in self.exercises)
        shown = (None if one is None else _rounded(one) for one in points)
        return (student, *shown, _rounded(self.total(student)), self.most)

    def _score(self, student: str, exercise: str) -> Score:
        found = self.answers.get((student, exercise))
        name = f"exercise {exercise}" if exercise else "answer"
        if found is None:
            return Score(name, Fraction(0), self.points, "Not answered.")
        return Score(name, found.share * self.points, self.points, found.explanation)


def _rounded(points: Fraction) -> float:
    return float(round(points, SHOWN))
