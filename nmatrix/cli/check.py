"""`nmatrix check`: one answer, or a class of them."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.scene_options import OptionGroups
from nmatrix.cli.shared_options import AXES, CommonOptions, among
from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import progress, show
from nmatrix.cli.sources import table
from nmatrix.enums import AxisName
from nmatrix.errors import IllegalValueError, did_you_mean
from nmatrix.reading.numbers import fraction, numbers
from nmatrix.samples import file_or_sample, samples

if TYPE_CHECKING:
    from collections.abc import Sequence

    from nmatrix.answers.grades import JudgeRecord
    from nmatrix.lessons.check.question import Question
    from nmatrix.linear.axes import AxisChange

HELP = {
    "check": """nmatrix check normal "1 0 0; 0 0.5 0; 0 0 1" --scale 1 2 1

nmatrix check exercise 2 "1 0 0; 0 2 0; 0 0 4" --seed 7 --student Ada

nmatrix check normal --batch answers --scale 1 2 1

Exit 0 if it is right, 1 if not.""",
}

EXERCISE = "exercise"
IDENTITY = "1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 0 1"
USUAL_ANSWERS = {
    "normal": "1 0 0; 0 1 0; 0 0 1",
    "light": "0 0 1",
    "eye": "0 0 5",
    "trace": "0 0 0.98",
}
EXERCISE_COLUMNS = ("student", "exercise", "answer")


@dataclass(frozen=True)
class CheckOptions:
    """How strictly to compare, and what exactly is asked for."""

    unit: Annotated[bool, Option("--unit", help="A direction must have length 1.")] = False
    tolerance: Annotated[
        str | None,
        Option(metavar="T", help="How far an entry may be off, for the digits given."),
    ] = None
    normal: Annotated[
        str | None,
        Option(metavar="X Y Z", help="check normal: the normal to carry, not the matrix."),
    ] = None
    point: Annotated[
        str | None,
        Option(metavar="X Y Z", help="check trace: the vertex, in object space (0 0 0)."),
    ] = None
    window: Annotated[
        bool, Option("--window", help="check trace: to the --viewport (512 512), not to NDC.")
    ] = False
    from_axes: Annotated[
        str | None,
        Option(
            "--from",
            metavar="AXES",
            help=f"check axes: from {AXES}",
            autocompletion=among(AxisName),
        ),
    ] = None
    to_axes: Annotated[
        str | None,
        Option(
            "--to",
            metavar="AXES",
            help="check axes: to another.",
            autocompletion=among(AxisName),
        ),
    ] = None

    @property
    def limit(self) -> Fraction | None:
        """The tolerance that was typed."""
        return None if self.tolerance is None else fraction(self.tolerance, "--tolerance")

    @property
    def of_one_subject(self) -> dict[str, tuple[str, bool]]:
        """The options that one WHAT alone takes: which one it is, and whether it was given."""
        return {
            "--normal": ("normal", self.normal is not None),
            "--point": ("trace", self.point is not None),
            "--window": ("trace", self.window),
            "--from": ("axes", self.from_axes is not None),
            "--to": ("axes", self.to_axes is not None),
        }


def _subjects() -> list[str]:
    from nmatrix.lessons.check.question import Subject

    return [*Subject, EXERCISE]


def _exercises() -> list[str]:
    from nmatrix.cli.handout import USUAL_EXERCISES

    return [str(number) for number in range(1, USUAL_EXERCISES + 1)]


def check(
    *,
    groups: OptionGroups,
    options: CheckOptions,
    common: CommonOptions,
    what: Annotated[
        str,
        Argument(
            metavar="WHAT",
            help="world, view, projection, normal, light, eye, trace, axes or exercise.",
            autocompletion=among(_subjects),
        ),
    ],
    answer: Annotated[
        str | None,
        Argument(
            metavar="ANSWER",
            help="Like MATRIX, or 3 or 4 numbers; the number N of an exercise.",
            show_default=False,
            autocompletion=among(_exercises),
        ),
    ] = None,
    exercise_answer: Annotated[
        str | None,
        Argument(metavar="ANSWER", help="The answer to exercise N.", show_default=False),
    ] = None,
    sheet: SheetOptions,
    batch: Annotated[
        str | None,
        Option(
            metavar="FILE",
            help="A .csv with the columns student, answer (and exercise).",
            autocompletion=among(samples, ".csv"),
        ),
    ] = None,
) -> None:
    """Check an answer."""
    if what == EXERCISE:
        _refuse_scene(groups, options)
        if batch is None:
            _check_exercise(answer, exercise_answer, sheet, common)
        else:
            _check_class(batch, answer, sheet, common)
        return
    sheet.refuse(what)
    if exercise_answer is not None:
        typed, why = exercise_answer[:30], f"check {what} takes one ANSWER"
        raise IllegalValueError(f"argument ({typed})", why, "quote it as a whole")
    _check_scene(_question(what, groups, options, common), answer, batch, common)


def _check_scene(
    question: Question, answer: str | None, batch: str | None, common: CommonOptions
) -> None:
    """Check one answer to a question about a scene, or a class's."""
    if (answer is None) is (batch is None):
        example = USUAL_ANSWERS.get(question.subject, IDENTITY)
        raise IllegalValueError(
            f"check {question.subject}",
            "it takes an ANSWER or --batch FILE, one of them",
            f'try nmatrix check {question.subject} "{example}"',
        )
    if batch is not None:
        from nmatrix.answers.grades import NEEDED, answers_to

        _show_grades(batch, NEEDED, answers_to(question, common.input_layout), common)
    elif answer is not None:
        from nmatrix.answers.check import check as answer_of

        show(answer_of(question, common.sources.literal(answer)), common)


def _check_exercise(
    number: str | None, answer: str | None, sheet: SheetOptions, common: CommonOptions
) -> None:
    """Check the answer to an exercise of a sheet."""
    from nmatrix.answers import exercise

    if number is None or answer is None:
        raise IllegalValueError(
            "check exercise",
            "it takes the number of the exercise and an ANSWER",
            "write it like nmatrix check exercise 3 c --seed 7 --student Ada",
        )
    show(exercise.check_exercise(exercise.whole_number(number), sheet.identity, answer), common)


def _check_class(
    batch: str, answer: str | None, sheet: SheetOptions, common: CommonOptions
) -> None:
    """Check the answers of a class, each with its student and exercise."""
    from nmatrix.answers.exercise import exercises_of

    if answer is not None:
        raise IllegalValueError(
            f"argument ({answer[:30]}) with --batch",
            "the answers stand in the file",
            "leave it out",
        )
    _show_grades(batch, EXERCISE_COLUMNS, exercises_of(*sheet.of_a_class("--batch")), common)


def _show_grades(
    batch: str, columns: Sequence[str], judge: JudgeRecord, common: CommonOptions
) -> None:
    from nmatrix.answers.grades import grades

    rows = table(str(file_or_sample(batch)), columns)
    show(grades(progress(rows, len(rows), "grading answers"), judge), common)


def _refuse_scene(groups: OptionGroups, options: CheckOptions) -> None:
    """Refuse what an exercise decides by itself: its numbers, and how they are compared."""
    given = {
        "--unit": options.unit,
        "--tolerance": options.tolerance is not None,
        **{name: is_given for name, (_, is_given) in options.of_one_subject.items()},
        "a scene": groups.is_given,
    }
    for name, is_given in given.items():
        if is_given:
            raise IllegalValueError(
                f"{name} with check {EXERCISE}",
                "the exercise has numbers of its own",
                "leave it out",
            )


def _question(
    what: str, groups: OptionGroups, options: CheckOptions, common: CommonOptions
) -> Question:
    from nmatrix.lessons.check.question import Question, Subject

    if what not in list(Subject):
        raise IllegalValueError(
            f"WHAT ({what[:20]})",
            f"it is one of {', '.join(_subjects())}",
            did_you_mean(what, _subjects(), "try normal"),
        )
    subject = Subject(what)
    for name, (of, is_given) in options.of_one_subject.items():
        if is_given and what != of:
            why = f"it belongs to check {of}"
            raise IllegalValueError(f"{name} with check {what}", why, f"use check {of}")
    setup = groups.setup(common)
    return Question(
        subject,
        setup,
        groups.shading_space(),
        unit=options.unit,
        tolerance=options.limit,
        normal=None if options.normal is None else numbers(options.normal, 3, "--normal"),
        point=(0, 0, 0) if options.point is None else numbers(options.point, 3, "--point"),
        window=groups.scene.window(setup.lens) if options.window else None,
        axes=_axes(options),
    )


def _axes(options: CheckOptions) -> AxisChange | None:
    if options.from_axes is None and options.to_axes is None:
        return None
    from nmatrix.linear.axes import axis_change

    if options.from_axes is None or options.to_axes is None:
        given, missing = ("--from", "--to") if options.to_axes is None else ("--to", "--from")
        raise IllegalValueError(
            f"{given} alone", "a way leads from one system to another", f"add {missing} opengl"
        )
    return axis_change((options.from_axes, options.to_axes))
