"""What an answer without a named mistake still shows: a step left out, two steps exchanged."""

from __future__ import annotations

import pytest

from nmatrix.enums import Space
from nmatrix.lessons.check.answer import read_answer
from nmatrix.lessons.check.hints import HALF_UNDONE, NO_TRANSLATION, NOT_MOVED, SCALED_LAST
from nmatrix.lessons.check.judge import NO_MISTAKE, Judge, Outcome
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

BOX = World(translate=(1, 2, 3), rotate_degrees=(0, 0, 90), scale=(2, 4, 1))
SETUP = Setup(BOX, View(eye=(5, 0, 0)), light=Light((1, 2, 2), position=(4, 5, 6)))
NO_PLACE = NOT_MOVED.format(space="world")
CASES = [
    (Question(Subject.EYE, SETUP, Space.OBJECT), "5 0 0", NO_PLACE),
    (Question(Subject.EYE, SETUP, Space.OBJECT), "4 -2 -3", HALF_UNDONE),
    (Question(Subject.LIGHT, SETUP, Space.OBJECT, light=LightPart.POSITION), "3 3 3", HALF_UNDONE),
    (Question(Subject.LIGHT, SETUP, Space.CAMERA, light=LightPart.DIRECTION), "1 2 2", NO_PLACE),
    (Question(Subject.NORMAL, SETUP, normal=(1, 2, 5)), "1 2 5", NOT_MOVED.format(space="object")),
    (Question(Subject.WORLD, SETUP), "0 -4 0; 2 0 0; 0 0 1", NO_TRANSLATION),
    (Question(Subject.WORLD, SETUP), "0 -2 0 1; 4 0 0 2; 0 0 1 3; 0 0 0 1", SCALED_LAST),
    (Question(Subject.VIEW, SETUP), "0 0 -1; 0 1 0; 1 0 0", NO_TRANSLATION),
]


@pytest.mark.parametrize(("question", "text", "sentence"), CASES)
def test_a_step_left_out_is_named(question, text, sentence) -> None:
    judge = Judge(question)
    found = judge.judge(read_answer(text, question))
    assert found.verdict is not Outcome.CORRECT
    assert sentence in found.explanation
    judge.__dict__["hints"] = ()
    assert sentence not in judge.judge(read_answer(text, question)).explanation


def test_numbers_that_show_nothing_get_no_hint() -> None:
    for question, _, _ in CASES:
        text = "7 9 11" if question.is_vector else "7 9 11; 2 5 1; 3 1 8"
        assert Judge(question).judge(read_answer(text, question)).explanation == NO_MISTAKE


def test_a_mistake_with_the_same_numbers_keeps_its_name() -> None:
    """With the eye on the z axis the transposed view leaves a light where it was."""
    setup = Setup(BOX, View(eye=(0, 0, 5)), light=Light(position=(-3, -3, -2)))
    question = Question(Subject.LIGHT, setup, Space.CAMERA, light=LightPart.POSITION)
    found = Judge(question).judge(read_answer("-3 -3 -2", question))
    assert found.mistake == "transposed-layout"
    assert found.explanation.endswith(NO_PLACE)
