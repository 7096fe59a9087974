"""Commands that stand by themselves: the calculator, derivations, checks, files and their plans."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from pathlib import Path

from nmatrix.api.report import Report
from nmatrix.api.setup import Part, Setup, setup_values, world_part
from nmatrix.enums import ShaderLanguage, Space
from nmatrix.linear.values import flag, named_file, number, refused, text, vector, whole
from nmatrix.reading.arrays import read_affine, read_matrix
from nmatrix.samples import file_or_sample
from nmatrix.spaces.shading_spaces import space_named

NO_SETUP = Setup()


def calc(
    expression: str,
    setup: Setup = NO_SETUP,
    *,
    let: Mapping[str, object] | None = None,
    steps: bool = False,
    rounded: bool = False,
) -> Report:
    r"""Compute an expression of the matrix calculator, or run the statements of a session.

    Parameters
    ----------
    expression
        Over M, V and P of the setup, literals, and the names of `let`; or statements, a line each,
        as `nmatrix calc FILE` has them: then the text is the transcript, `lines` in the data are
        what each came to, and `failure` is the first error.
    let
        Numbers, vectors and matrices by name.
    steps
        Keep every operation.
    rounded
        Round every product and sum to float64 (`--float`).

    Raises
    ------
    IllegalValueError
        For a fault in an expression, with a caret in front of it.
    NoAnswerError
        For the inverse of a singular matrix, a division by zero, a direction of length zero.

    Examples
    --------
    >>> calc("det(A) / 4", let={"A": [[1, 2], [3, 4]]}).data["value"]
    -0.5
    >>> print(calc("d = 2\nd^3"), end="")
    > d = 2
    d  2
    > d^3
    ans  8
    """
    from nmatrix.calculator.answer import report
    from nmatrix.calculator.arithmetic.values import Arithmetic
    from nmatrix.calculator.names import EVERY_NAME, names_of, with_name
    from nmatrix.calculator.sessions.session import Session, Settings
    from nmatrix.output.transcript import Disk, is_session, transcript
    from nmatrix.output.write import OutputOptions

    typed = text(expression, "expression")
    names = names_of(setup_values(setup), EVERY_NAME if is_session(typed) else typed)
    for name, value in _mapping({} if let is None else let, "let").items():
        rows = (
            ((Fraction(number(value, name)),),)
            if _is_number(value)
            else read_matrix(value, name).rows_exact
        )
        names = with_name(names, text(name, "let"), rows)
    arithmetic = Arithmetic.FLOAT if flag(rounded, "rounded") else Arithmetic.EXACT
    settings = Settings(steps=flag(steps, "steps"), arithmetic=arithmetic)
    session = Session(names, settings)
    if is_session(typed):
        return Report(transcript(session, typed, OutputOptions(), Disk()))
    return Report(
        report(session.calculation(typed), with_steps=settings.steps, inverse_by=settings.by)
    )


def derive(case: str = "rule", world: Part = None) -> Report:
    """Derive a lesson, each step proved by SymPy; with a world, your own matrix follows it.

    Parameters
    ----------
    case
        rule, cofactor, translation, rotation, uniform, nonuniform, shear, mirror, singular,
        lightdirection, eye, metric, reflection or all.
    world
        As for `Setup`; fractions stay fractions, and 30° gives √3/2.

    Examples
    --------
    >>> lesson = derive("mirror").data["cases"][0]
    >>> all(step["verified"] for step in lesson["steps"])
    True
    """
    from nmatrix.lessons.derive.lesson import derive as answer

    return Report(answer(text(case, "case"), None if world is None else world_part(world)))


def check(
    what: str,
    answer: object,
    setup: Setup = NO_SETUP,
    *,
    space: str | Space = Space.WORLD,
    unit: bool = False,
    tolerance: float | None = None,
    normal: object = None,
    point: object = (0, 0, 0),
    window: object = None,
    axes: tuple[str, str] | None = None,
) -> Report:
    """Judge an answer: right to its digits, or the mistake that gives these numbers.

    `data` has the verdict: correct, mistake or unknown; a wrong answer is also the `failure`.

    Parameters
    ----------
    what
        world, view, projection, normal, light, eye, trace or axes.
    answer
        Text in any notation, or an array-like: a matrix, or 3 or 4 numbers for a vector.
    unit
        A direction must have length 1.
    tolerance
        How far an entry may be off, in place of the digits given.
    normal
        The normal to carry, in object space, where that and not the matrix is asked for.
    point, window
        The vertex that is traced, in object space: into NDC, or into a window of so many pixels,
        width and height.
    axes
        The axis systems, from and to: F is asked for, or with a world matrix F · M · F⁻¹.

    Examples
    --------
    >>> stretched = Setup(world={"scale": (1, 2, 1)})
    >>> check("normal", [[1, 0, 0], [0, 2, 0], [0, 0, 1]], stretched).data["mistake"]
    'not-inverted'
    """
    from nmatrix.answers.check import check as checked
    from nmatrix.enums import chosen
    from nmatrix.lessons.check.question import Question, Subject
    from nmatrix.linear.axes import axis_change
    from nmatrix.linear.viewport import read_viewport

    question = Question(
        chosen(Subject, what, "what"),
        setup_values(setup),
        space_named(space),
        unit=flag(unit, "unit"),
        tolerance=None if tolerance is None else Fraction(number(tolerance, "tolerance")),
        normal=None if normal is None else vector(normal, "normal"),
        point=vector(point, "point"),
        window=None if window is None else read_viewport(window, "window"),
        axes=None if axes is None else axis_change(axes),
    )
    return Report(checked(question, read_matrix(answer, "answer")))


def check_exercise(
    exercise: int, answer: str, *, seed: str | int, student: str = "", salt: bytes = b""
) -> Report:
    """Judge the answer to an exercise of a student's sheet.

    Parameters
    ----------
    exercise
        Its number on the sheet, from 1.
    answer
        Text as on paper: numbers, or the letter or words of a choice.
    seed, student, salt
        Those that the sheet was made with.

    Raises
    ------
    IllegalValueError
        For a number that no exercise has, or an answer that cannot be read.

    Examples
    --------
    >>> check_exercise(2, "1 0 0; 0 1 0; 0 0 1", seed=7, student="Ada").data["mistake"]
    'normal-rotation-only'
    """
    from nmatrix.answers.exercise import check_exercise as checked
    from nmatrix.lessons.exercises.scheme import Sheet

    sheet = Sheet(_seed(seed), text(student, "student"), _bytes(salt, "salt"))
    return Report(checked(whole(exercise, "exercise"), sheet, text(answer, "answer")))


def identify(matrix: object) -> Report:
    """Tell what a matrix is from its entries: every reading that they allow, likeliest first.

    Parameters
    ----------
    matrix
        3×3, 3×4 or 4×4: any array-like, or text in any notation. A float32 array is known to
        float32, a decimal of three digits and more to half a unit of its last one.

    Examples
    --------
    >>> likeliest = identify("1 0 0 0; 0 1 0 0; 0 0 1.001 -0.1001; 0 0 1 0").data["readings"][0]
    >>> likeliest["apis"], likeliest["command"]
    (['direct3d'], 'nmatrix projection --fov 90 --near 0.1 --far 100 --api direct3d')
    """
    from nmatrix.answers.identify import identify_matrix

    return Report(identify_matrix(read_matrix(matrix, "matrix").as_floats))


def axes(from_axes: str, to_axes: str, matrix: object = None, *, order: str = "XYZ") -> Report:
    """Tell points of one axis system in another, and a matrix of the one as one of the other.

    Parameters
    ----------
    from_axes, to_axes
        `opengl`, `blender`, `unity`, `unreal`, …, or three signed axes that point right, up and
        forward.
    matrix
        A map between two frames of `from_axes`: an affine 4×4, or its 3×3 linear part.
    order
        In which the angles of its parts are told.

    Examples
    --------
    >>> [[int(x) for x in row[:3]] for row in axes("ros", "opencv").data["to_from"][:3]]
    [[0, -1, 0], [0, 0, -1], [1, 0, 0]]
    """
    from nmatrix.answers.axes import axes as answer
    from nmatrix.linear.affine import checked_order

    given = None if matrix is None else read_affine(matrix, "matrix")
    return Report(
        answer(text(from_axes, "from_axes"), text(to_axes, "to_axes"), given, checked_order(order))
    )


def plan(scene: str | Path, *, allow_outside: bool = False) -> Report:
    """List the effects that a scene file calls for, why, and how safely the others are left out."""
    from nmatrix.answers.plan import plan_of_file

    return Report(
        plan_of_file(file_or_sample(named_file(scene, "scene")), allow_outside=allow_outside)
    )


def inspect(file: str | Path) -> Report:
    """Inspect a glTF scene or a mesh: the kind of each node's map, and where normals break."""
    from nmatrix.answers.inspect.file import inspect_file
    from nmatrix.answers.inspect.report import report

    return Report(report((inspect_file(file_or_sample(named_file(file, "file"))),)))


def lint(
    sources: Mapping[str, str],
    *,
    language: str | None = None,
    world: Part = None,
) -> Report:
    """Read shaders for their spaces, and tell where two meet that must not.

    `data` has the findings, a patch of what can be mended, and the spaces of the names.
    Two sources are one program; of more, those whose names differ only in their endings.

    Parameters
    ----------
    sources
        The text of each shader under its name, whose ending tells the stage.
    language
        glsl or hlsl, where name and text leave it open.
    world
        A world, or the options of one: the findings that depend on it get their degrees.

    Raises
    ------
    MissingPackageError
        Without the grammars of the extra `lint`.

    Examples
    --------
    >>> text = "uniform mat4 model; in vec3 n; out vec3 N; void main() { N = mat3(model) * n; }"
    >>> found = lint({"a.vert": text}, world={"scale": (1, 2, 1)}).data["findings"]
    >>> [(one["rule"], round(one["degrees"], 4)) for one in found]
    [('NM101', 36.8699)]
    """
    from nmatrix.answers.lint import Asked, Source, report
    from nmatrix.enums import chosen

    given = [
        Source(text(name, "sources"), text(one, "sources"))
        for name, one in _mapping(sources, "sources").items()
    ]
    asked = Asked(
        world=None if world is None else world_part(world).world_from_object,
        language=None if language is None else chosen(ShaderLanguage, language, "language"),
        are_one_program=len(given) == 2,
        with_fixes=True,
    )
    return Report(report(given, asked))


def _mapping(value: object, name: str) -> Mapping[str, object]:
    if isinstance(value, Mapping):
        return value
    raise refused(value, name, "it is not a dict of names and values", "give {name: value}")


def _is_number(value: object) -> bool:
    return not isinstance(value, str) and not hasattr(value, "__len__")


def _seed(value: object) -> str:
    return value if isinstance(value, str) else str(whole(value, "seed"))


def _bytes(value: object, name: str) -> bytes:
    if isinstance(value, bytes):
        return value
    raise refused(value, name, "it is not bytes", 'write b"..."')
