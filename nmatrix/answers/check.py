"""`nmatrix check`: whether an answer is right, and if not, which mistake it is.

The right answer itself is not shown: the command that shows it is.
"""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from nmatrix.answers.points import submission
from nmatrix.enums import Space
from nmatrix.errors import (
    OF_THE_SCENE,
    CheckFailedError,
    IllegalValueError,
    NoAnswerError,
    quantity,
)
from nmatrix.lessons.check.answer import Answer, shaped
from nmatrix.lessons.check.judge import NO_MISTAKE, Judge, Judgement, Outcome
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.lessons.map_sentences import verdict
from nmatrix.linear.classify import classify
from nmatrix.linear.rational import AFFINE_ROW
from nmatrix.linear.rounding import short_text
from nmatrix.reading.literal import MatrixLiteral
from nmatrix.report import Block, Heading, Report, Table, Text, Tone, Value, Verdict
from nmatrix.scene.setup import Setup

SHOWN_DIGITS = 6
NO_WORLD = "M is the identity here: no place, turn, scale, shear or matrix was given."
NO_VIEW = "The usual camera is meant: no eye, target or angle was given."
NO_LENS = "The usual lens is meant: no field of view, aspect, near or far was given."
WRONG = "✗"
VECTOR_COLUMNS = ("x", "y", "z", "w")
MATRIX_COLUMNS = ("column 1", "column 2", "column 3", "column 4")


def check(question: Question, literal: MatrixLiteral) -> Report:
    """Answer whether these numbers are right.

    Examples
    --------
    >>> from nmatrix.reading.matrix import matrix_literal
    >>> from nmatrix.scene.setup import Setup
    >>> from nmatrix.scene.world import World
    >>> asked = Question(Subject.NORMAL, Setup(World(scale=(1, 2, 1))))
    >>> check(asked, matrix_literal("1 0 0; 0 0.5 0; 0 0 1")).data["verdict"]
    'correct'
    """
    try:
        asked, answer, found = best_judgement(judges(question), literal)
    except NoAnswerError as error:
        return _without_answer(question, error)
    if found.explanation == NO_MISTAKE and not asked.is_vector:
        found = replace(found, explanation=f"{NO_MISTAKE} {_by_itself(literal)}")
    return judged(asked, answer, found)


def _by_itself(literal: MatrixLiteral) -> str:
    """Tell what a matrix that nothing explains is by itself, as `identify` does."""
    rows = literal.as_floats
    if len(rows) == 3 or rows[3] == AFFINE_ROW:
        return verdict(classify(rows)).replace("This", "By itself this", 1)
    from nmatrix.answers.identify import described
    from nmatrix.linear.identify import identify

    return f"By itself this is {described(identify(rows)[0])}."


def _without_answer(question: Question, error: NoAnswerError) -> Report:
    """Report that the scene has no right answer."""
    data: dict[str, Value] = {
        "verdict": Outcome.UNKNOWN.value,
        "mistake": None,
        "also": [],
        "explanation": f"There is no right answer: {error}",
        "max_difference": None,
        "wrong_entries": [],
    }
    heading = Heading(f"Check: {_named(question)}")
    blocks = (heading, Verdict("There is no right answer."), Text(str(error)))
    return Report("check", data, blocks, failure=error)


def judges(question: Question) -> tuple[Judge, ...]:
    """Make the judge of a question; for a light, one judge for each part that the light has."""
    if question.subject is not Subject.LIGHT:
        return (Judge(question),)
    light = question.setup.maps.light
    has = {LightPart.DIRECTION: light.direction, LightPart.POSITION: light.position}
    parts = [part for part in LightPart if has[part] is not None]
    if question.unit:
        parts = [part for part in parts if part is LightPart.DIRECTION]
    if not parts:
        raise IllegalValueError(
            f"{quantity('unit')} with a light position",
            "only a direction has a length to bring to 1",
            f"leave {quantity('unit')} out, or give {quantity('light_direction')} X Y Z",
        )
    return tuple(Judge(replace(question, light=part)) for part in parts)


def best_judgement(
    judges: tuple[Judge, ...], literal: MatrixLiteral
) -> tuple[Question, Answer, Judgement]:
    """Judge numbers; for a light with two parts, by the part that they fit better."""
    found = []
    for judge in judges:
        answer = shaped(literal, judge.question)
        found.append((judge.question, answer, judge.judge(answer)))
    return min(found, key=lambda one: list(Outcome).index(one[2].verdict))


def judged(
    question: Question, answer: Answer, found: Judgement, named: str = "", command: str = ""
) -> Report:
    """Report one judgement.

    `named` is the subject in words and `command` the one that computes it; by default both follow
    from the question.
    """
    blocks = _blocks(named or _named(question), question, answer, found)
    remarks = (*found.remarks, *_defaults_used(question, found))
    failure = _failure(question, found, command)
    given = (submission(named or _named(question), found),)
    return Report("check", judgement_data(found), blocks, remarks, failure, submissions=given)


def _defaults_used(question: Question, found: Judgement) -> tuple[str, ...]:
    """State the defaults that a wrong answer was compared with, where no scene was given."""
    if found.verdict is Outcome.CORRECT:
        return ()
    setup, usual = question.setup, Setup()
    of_objects = question.subject in (Subject.WORLD, Subject.NORMAL)
    if (of_objects or question.space is Space.OBJECT) and setup.world == usual.world:
        return (NO_WORLD,)
    if question.subject is Subject.VIEW and setup.view == usual.view:
        return (NO_VIEW,)
    if question.subject is Subject.PROJECTION and setup.lens == usual.lens:
        return (NO_LENS,)
    return ()


def judgement_data(found: Judgement) -> dict[str, Value]:
    """Describe a judgement under the keys of the data."""
    return {
        "verdict": found.verdict.value,
        "mistake": found.mistake,
        "also": list(found.also),
        "explanation": found.explanation,
        "max_difference": found.max_difference,
        "wrong_entries": [list(place) for place in found.wrong_entries],
    }


def _failure(question: Question, found: Judgement, command: str) -> CheckFailedError | None:
    if found.verdict is Outcome.CORRECT:
        return None
    why = found.mistake or "no known mistake gives these numbers"
    if found.mistakes:
        return CheckFailedError("answer (wrong)", why, f"try {_commands(question, found)[0]}")
    shows = f"nmatrix {command or _command(question)} {OF_THE_SCENE}"
    return CheckFailedError("answer (wrong)", why, f"{shows} shows the right one")


def _command(question: Question) -> str:
    """Name the command that answers the question."""
    if question.subject in (Subject.LIGHT, Subject.EYE):
        return f"{question.subject} {question.space}"
    if question.axes is not None:
        return f"axes {question.axes.source.name} {question.axes.target.name}"
    return question.subject.value


def _commands(question: Question, found: Judgement) -> list[str]:
    """List the command lines that show the right way, one for each mistake."""
    return [MISTAKES[one].command_for(question.subject) for one in found.mistakes]


def _blocks(named: str, question: Question, answer: Answer, found: Judgement) -> tuple[Block, ...]:
    heading = Heading(f"Check: {named}")
    if found.verdict is Outcome.CORRECT:
        return (heading, Verdict("Correct.", Tone.RIGHT))
    named = ", or ".join(filter(None, (found.mistake, *found.also)))
    verdict = f"Mistake: {named}." if named else "Wrong."
    marked = _marked(question, answer, found)
    seen = (Text(f"See: {command}") for command in _commands(question, found))
    return (heading, Verdict(verdict, Tone.WRONG), Text(found.explanation), marked, *seen)


def _named(question: Question) -> str:
    """Name the subject of the question."""
    subject, space = question.subject, question.space
    if subject is Subject.NORMAL:
        thing = "a normal" if question.normal is not None else "the normal matrix"
        return f"{thing} in {space} space"
    if subject is Subject.LIGHT:
        return f"the light {question.light} in {space} space"
    if subject is Subject.EYE:
        return f"the eye in {space} space"
    if subject is Subject.TRACE:
        return f"the vertex in {'NDC' if question.window is None else 'the window'}"
    if question.axes is not None:
        told = "F" if question.asks_for_way else "the matrix"
        return f"{told} from {question.axes.source.name} to {question.axes.target.name}"
    return f"the {subject} matrix"


def _marked(question: Question, answer: Answer, found: Judgement) -> Table:
    """Show the answer with a mark at every wrong entry."""
    names = VECTOR_COLUMNS if question.is_vector else MATRIX_COLUMNS
    wrong = set(found.wrong_entries)
    rows = tuple(
        tuple(_cell(entry, is_wrong=(i, j) in wrong) for j, entry in enumerate(row))
        for i, row in enumerate(answer.rows)
    )
    marked = f"wrong entries marked {WRONG}" if wrong else "the length is what is wrong"
    return Table(names[: len(answer.rows[0])], rows, f"Your answer, {marked}")


def _cell(entry: Fraction, *, is_wrong: bool) -> str:
    return short_text(entry, SHOWN_DIGITS) + (f" {WRONG}" if is_wrong else "")
