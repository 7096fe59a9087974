"""`nmatrix check`: one answer, or a class of them."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.scene_options import OptionGroups
from nmatrix.cli.shared_options import AXES, MOST_POINTS, CommonOptions, among, whole_number
from nmatrix.cli.sheet_options import SheetOptions
from nmatrix.cli.show import progress, show
from nmatrix.cli.sources import table
from nmatrix.enums import AxisName, Format
from nmatrix.errors import IllegalValueError, counted, did_you_mean
from nmatrix.output.files import write_file
from nmatrix.reading.numbers import fraction, numbers
from nmatrix.report import Report, Text
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
RESULTS = "results.json"
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


@dataclass(frozen=True)
class ClassOptions:
    """A class's answers, and what becomes of them."""

    batch: Annotated[
        str | None,
        Option(
            metavar="FILE",
            help="A .csv with the columns student, answer (and exercise).",
            autocompletion=among(samples, ".csv"),
        ),
    ] = None
    points: Annotated[
        str | None,
        Option(metavar="N", help="Of each exercise: a row a student, points by entries."),
    ] = None
    strict: Annotated[
        bool, Option("--strict", help="With --batch: exit 1 where a row could not be read.")
    ] = False
    output: Annotated[
        str | None,
        Option(
            "--output", "-o", metavar="DIR", help="With -f gradescope: a results.json a student."
        ),
    ] = None

    @property
    def points_of_each(self) -> int | None:
        """The points of an exercise, if they were given."""
        if self.points is None:
            return None
        why = f"an exercise has 1 to {MOST_POINTS}"
        return whole_number(self.points, "--points", range(1, MOST_POINTS + 1), 4, why)

    def refuse_without_batch(self) -> None:
        """Refuse what only a class has."""
        for name, is_given in (("--strict", self.strict), ("--output", self.output is not None)):
            if is_given:
                raise IllegalValueError(
                    f"{name} without --batch", "one answer is no class", "leave it out"
                )


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
        Argument(metavar="ANSWER_TO_N", help="The answer to exercise N.", show_default=False),
    ] = None,
    sheet: SheetOptions,
    of_class: ClassOptions,
) -> None:
    """Check an answer."""
    if of_class.batch is None:
        of_class.refuse_without_batch()
    if what == EXERCISE:
        _refuse_scene(groups, options)
        if of_class.batch is None:
            _check_exercise(answer, exercise_answer, sheet, of_class, common)
        else:
            _check_class(of_class, answer, sheet, common)
        return
    sheet.refuse(what)
    if exercise_answer is not None:
        typed, why = exercise_answer[:30], f"check {what} takes one ANSWER"
        raise IllegalValueError(f"argument ({typed})", why, "quote it as a whole")
    _check_scene(_question(what, groups, options, common), answer, of_class, common)


def _check_scene(
    question: Question, answer: str | None, of_class: ClassOptions, common: CommonOptions
) -> None:
    """Check one answer to a question about a scene, or a class's."""
    if (answer is None) is (of_class.batch is None):
        example = USUAL_ANSWERS.get(question.subject, IDENTITY)
        raise IllegalValueError(
            f"check {question.subject}",
            "it takes an ANSWER or --batch FILE, one of them",
            f'try nmatrix check {question.subject} "{example}"',
        )
    if of_class.batch is not None:
        from nmatrix.answers.grades import NEEDED, answers_to

        _show_grades(of_class, NEEDED, answers_to(question, common.input_layout), common)
    elif answer is not None:
        from nmatrix.answers.check import check as answer_of

        _show_one(answer_of(question, common.sources.literal(answer)), of_class, common)


def _check_exercise(
    number: str | None,
    answer: str | None,
    sheet: SheetOptions,
    of_class: ClassOptions,
    common: CommonOptions,
) -> None:
    """Check the answer to an exercise of a sheet."""
    from nmatrix.answers import exercise

    if number is None or answer is None:
        raise IllegalValueError(
            "check exercise",
            "it takes the number of the exercise and an ANSWER",
            "write it like nmatrix check exercise 3 c --seed 7 --student Ada",
        )
    found = exercise.check_exercise(exercise.whole_number(number), sheet.identity, answer)
    _show_one(found, of_class, common)


def _check_class(
    of_class: ClassOptions, answer: str | None, sheet: SheetOptions, common: CommonOptions
) -> None:
    """Check the answers of a class, each with its student and exercise."""
    from nmatrix.answers.exercise import exercises_of

    if answer is not None:
        raise IllegalValueError(
            f"argument ({answer[:30]}) with --batch",
            "the answers stand in the file",
            "leave it out",
        )
    _show_grades(of_class, EXERCISE_COLUMNS, exercises_of(*sheet.of_a_class("--batch")), common)


def _show_one(report: Report, of_class: ClassOptions, common: CommonOptions) -> None:
    from nmatrix.answers.points import worth

    show(worth(report, of_class.points_of_each or 1), common)


def _show_grades(
    of_class: ClassOptions, columns: Sequence[str], judge: JudgeRecord, common: CommonOptions
) -> None:
    """Grade the rows of a file; what could not be read is a failure only if that is asked for."""
    from nmatrix.answers.grades import grades

    is_for_files = common.format is Format.GRADESCOPE
    if of_class.output is not None and not is_for_files:
        raise IllegalValueError("--output", "a class is written to files", "add -f gradescope")
    points = of_class.points_of_each or (1 if is_for_files else None)
    found = table(str(file_or_sample(str(of_class.batch))), columns)
    rows = progress(found.rows, len(found.rows), "grading answers")
    report = grades(rows, judge, points)
    if of_class.output is not None:
        report, common = _as_files(report, Path(of_class.output)), common.as_text()
    remarks = (*found.remarks, *report.remarks)
    failure = report.failure if of_class.strict else None
    show(replace(report, remarks=remarks, failure=failure), common)


def _as_files(report: Report, folder: Path) -> Report:
    """Write a results.json for each student, each into a folder of their own."""
    from nmatrix.classroom.roster import stem_of
    from nmatrix.output.gradescope import results

    names = [folder / stem_of(i, one.student) / RESULTS for i, one in enumerate(report.submissions)]
    for name, one in zip(names, report.submissions, strict=True):
        try:
            name.parent.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            why = error.strerror or "it cannot be made"
            raise IllegalValueError(f"folder ({folder})", why, "choose another with -o") from None
        write_file(name, results(one).encode(), force=True)
    written = Text(f"Written: {counted(len(names), 'file')} {RESULTS} in {folder}")
    return replace(report, blocks=(*report.blocks, written))


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
