"""`nmatrix check exercise`: the answer to one exercise of one sheet."""

from __future__ import annotations

from collections.abc import Callable, Mapping

from nmatrix.answers.check import judged, judgement_data
from nmatrix.answers.points import submission
from nmatrix.errors import CheckFailedError, IllegalValueError
from nmatrix.lessons.check.judge import Judgement, Outcome
from nmatrix.lessons.exercises.exercise import Computed, Exercise, ExerciseKind
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.report import Block, Heading, Report, Text, Tone, Verdict

COMMANDS = {ExerciseKind.TRACE: "trace"}  # where the question's own is not the one that answers it


def check_exercise(number: int, sheet: Sheet, text: str) -> Report:
    """Answer whether a typed answer to an exercise is right.

    Examples
    --------
    >>> one = exercise(3, Sheet("7", "Ada"))
    >>> check_exercise(3, Sheet("7", "Ada"), one.right).data["verdict"]
    'correct'
    """
    one = exercise(number, sheet)
    found = one.judge(text)
    if isinstance(one.grader, Computed):
        answer, command = one.grader.answer(text), COMMANDS.get(one.kind, "")
        return judged(one.grader.question, answer, found, _title(one, sheet), command)
    blocks: list[Block] = [Heading(f"Check: {_title(one, sheet)}")]
    verdict, wrong = Verdict("Correct.", Tone.RIGHT), None
    if found.verdict is not Outcome.CORRECT:
        verdict = Verdict("Wrong.", Tone.WRONG)
        wrong = CheckFailedError("answer (wrong)", "another choice is right", "think again")
    blocks += [verdict, Text(found.explanation)]
    given = (submission(_title(one, sheet), found),)
    data = judgement_data(found)
    return Report("check", data, tuple(blocks), found.remarks, wrong, submissions=given)


def exercises_of(seed: str, salt: bytes) -> Callable[[Mapping[str, str]], Judgement]:
    """Make the judge of a class, whose rows hold a student, an exercise and an answer."""

    def judge(cells: Mapping[str, str]) -> Judgement:
        if not cells["student"]:
            raise IllegalValueError("student ()", "the cell is empty", "give the name of the sheet")
        sheet = Sheet(seed, cells["student"], salt)
        return exercise(whole_number(cells["exercise"]), sheet).judge(cells["answer"])

    return judge


def whole_number(text: str) -> int:
    """Read the number of an exercise.

    Raises
    ------
    IllegalValueError
        If the text is not a short whole number.
    """
    if not (text.isascii() and text.isdigit() and len(text) < 5):
        raise IllegalValueError(
            f"exercise ({text[:20]})", "it is a whole number", "give the number from the sheet"
        )
    return int(text)


def _title(one: Exercise, sheet: Sheet) -> str:
    """Name the exercise with its student and seed, on which its numbers depend."""
    whose = sheet.student or "the sheet without a name"
    return f"exercise {one.title} ({whose}, seed {sheet.seed})"
