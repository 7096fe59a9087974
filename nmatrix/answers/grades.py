"""A class of answers, each judged by itself: one grade for each row of the table."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction

from nmatrix.answers.check import best_judgement, judges
from nmatrix.answers.points import Gradebook, Graded, share
from nmatrix.enums import Layout
from nmatrix.errors import CheckFailedError, NMatrixError
from nmatrix.lessons.check.judge import Judgement, Outcome
from nmatrix.lessons.check.question import Question
from nmatrix.reading.matrix import matrix_literal
from nmatrix.reading.records import Record
from nmatrix.report import Block, Heading, Report, Table, Value, Verdict

NEEDED = ("student", "answer")  # exercise too, where the exercises differ
COLUMNS = ("student", "exercise", "verdict", "mistake", "also", "explanation")
UNREADABLE = "unreadable"
_WORDS: dict[str, str] = {
    Outcome.MISTAKE: "with a known mistake",
    Outcome.UNKNOWN: "wrong in another way",
}
DECIMAL_COMMA = re.compile(r"(?<=\d),(?=\d)")
NAMED = 5  # of the students who answered more than once

JudgeRecord = Callable[[Mapping[str, str]], Judgement]


@dataclass(frozen=True)
class Grade:
    """One row: the student, the exercise, and the judgement."""

    student: str
    exercise: str
    verdict: str
    mistake: str | None
    also: tuple[str, ...]
    explanation: str
    share: Fraction = Fraction(0)  # of the entries that are right

    @property
    def cells(self) -> tuple[str | None, ...]:
        """The cells under `COLUMNS`."""
        return (
            self.student,
            self.exercise,
            self.verdict,
            self.mistake,
            " ".join(self.also) or None,
            self.explanation,
        )

    @property
    def data(self) -> dict[str, Value]:
        """The cells by their columns, as JSON has them."""
        return {**dict(zip(COLUMNS, self.cells, strict=True)), "also": list(self.also)}


def grades(records: Iterable[Record], judge: JudgeRecord, points: int | None = None) -> Report:
    """Answer with one grade for each row; a row that cannot be read costs only itself.

    With the points of an exercise there is one row a student. The report fails where rows could
    not be read.

    Examples
    --------
    >>> from nmatrix.lessons.check.question import Subject
    >>> from nmatrix.scene.setup import Setup
    >>> rows = [Record(2, {"student": "Ada", "answer": "0 0 5"}),
    ...         Record(3, {"student": "Bo", "answer": "five"})]
    >>> found = grades(rows, answers_to(Question(Subject.EYE, Setup())))
    >>> [row["verdict"] for row in found.data["rows"]]
    ['correct', 'unreadable']
    """
    found = [_grade(record, judge) for record in records]
    counts = Counter(grade.verdict for grade in found)
    summary = {name: counts[name] for name in (*map(str, Outcome), UNREADABLE)}
    table = Table(COLUMNS, tuple(grade.cells for grade in found))
    rows: list[Value] = [grade.data for grade in found]
    blocks: tuple[Block, ...] = (
        Heading(f"Check: {len(found)} answers"),
        Verdict(f"{_counted(summary)}."),
        Table(COLUMNS[:4], tuple(grade.cells[:4] for grade in found)),
        *_unreadable(found),
        *_mistakes(found),
    )
    report = Report(
        "check",
        {"rows": rows, "summary": dict(summary)},
        blocks,
        _repeated_answers(found, "each row graded by itself"),
        failure=_failure(summary[UNREADABLE]),
        records=table,
    )
    return report if points is None else _with_points(report, found, points)


def _with_points(report: Report, found: list[Grade], points: int) -> Report:
    """Put points in the place of verdicts: a row a student, with a part for each right entry."""
    answers = (Graded(one.student, one.exercise, one.share, one.explanation) for one in found)
    book = Gradebook.of(answers, points)
    heading, verdict, _, *others = report.blocks
    return replace(
        report,
        data={**report.data, "students": book.data},
        blocks=(heading, verdict, *book.blocks, *others),
        remarks=_repeated_answers(found, "the last one counts"),
        records=book.table,
        submissions=book.submissions,
    )


def answers_to(question: Question, layout: Layout | None = None) -> JudgeRecord:
    """Make the judge of a class's answers to one question; equal answers are judged once."""
    known: dict[str, Judgement] = {}
    asked = judges(question)
    for judge in asked:
        _ = judge.right  # a scene without an answer is the scene's fault, and no row's

    def judged(cells: Mapping[str, str]) -> Judgement:
        text = cells["answer"]
        if text not in known:
            known[text] = best_judgement(asked, matrix_literal(text, layout))[2]
        return known[text]

    return judged


def _grade(record: Record, judge: JudgeRecord) -> Grade:
    student, exercise = record.cells["student"], record.cells.get("exercise", "")
    try:
        if record.fault:
            raise CheckFailedError(record.fault)
        found = _judged(record.cells, judge)
    except NMatrixError as error:
        sentence = f"line {record.line}: {error}"
        return Grade(student, exercise, UNREADABLE, None, (), sentence)
    return Grade(
        student,
        exercise,
        found.verdict.value,
        found.mistake,
        found.also,
        found.explanation,
        share(found),
    )


def _judged(cells: Mapping[str, str], judge: JudgeRecord) -> Judgement:
    """Judge an answer as it was typed, or if that is none, with decimal commas."""
    try:
        return judge(cells)
    except NMatrixError:
        with_points = DECIMAL_COMMA.sub(".", cells["answer"])
        if with_points == cells["answer"] or "." in cells["answer"]:
            raise
        try:
            return judge({**cells, "answer": with_points})
        except NMatrixError:
            pass  # what was typed is told, and not what was tried
        raise


def _counted(summary: Mapping[str, int]) -> str:
    counted = (f"{count} {_WORDS.get(name, name)}" for name, count in summary.items() if count)
    return ", ".join(counted) or "No answers"


def _unreadable(found: list[Grade]) -> tuple[Block, ...]:
    rows = tuple((g.student, g.explanation) for g in found if g.verdict == UNREADABLE)
    return (Table(("student", "reason"), rows, "Could not be read"),) if rows else ()


def _repeated_answers(found: list[Grade], told: str) -> tuple[str, ...]:
    """Remark on students who answered the same exercise more than once."""
    counts = Counter((grade.student, grade.exercise) for grade in found)
    several = [
        f"{student}, exercise {exercise}" if exercise else student
        for (student, exercise), count in counts.items()
        if count > 1
    ]
    if not several:
        return ()
    named = "; ".join(several[:NAMED]) + (" …" if len(several) > NAMED else "")
    return (f"Answered more than once, {told}: {named}.",)


def _mistakes(found: list[Grade]) -> tuple[Block, ...]:
    counts = Counter(grade.mistake for grade in found if grade.mistake)
    if not counts:
        return ()
    return (Table(("mistake", "answers"), tuple(counts.most_common()), "What to teach again"),)


def _failure(unreadable: int) -> CheckFailedError | None:
    if not unreadable:
        return None
    return CheckFailedError(
        f"batch ({unreadable} unreadable)",
        "these rows hold no answer that fits",
        "see the reasons above, or in the explanation column of -f csv",
    )
