"""`nmatrix check exercise`: one answer to one exercise, or a class's."""

from __future__ import annotations

from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import progress, show
from nmatrix.cli.tables import table
from nmatrix.errors import IllegalValueError

NAME = "exercise"
GRADING = "grading answers"
COLUMNS = ("student", "exercise", "answer")


def check_exercise(
    number: str | None, answer: str | None, of: SheetOptions, everywhere: Everywhere
) -> None:
    """Check the answer to an exercise of a sheet."""
    from nmatrix.answers import exercise

    if number is None or answer is None:
        raise IllegalValueError(
            "check exercise",
            "it takes the number of the exercise and an ANSWER",
            "try nmatrix check exercise 3 c --seed 7 --student Ada",
        )
    show(exercise.check_exercise(exercise.whole_number(number), of.sheet, answer), everywhere)


def check_class(batch: str, answer: str | None, of: SheetOptions, everywhere: Everywhere) -> None:
    """Check the answers of a class, each with its student and exercise."""
    from nmatrix.answers.exercise import exercises_of
    from nmatrix.answers.grades import grades

    if answer is not None:
        raise IllegalValueError(
            f"argument ({answer[:30]}) with --batch",
            "the answers stand in the file",
            "leave it out",
        )
    if of.student is not None:
        raise IllegalValueError(
            "--student with --batch", "the students stand in the file", "leave it out"
        )
    rows, judge = table(batch, COLUMNS), exercises_of(of.seed, of.salt_read)
    show(grades(progress(rows, len(rows), GRADING), judge), everywhere)
