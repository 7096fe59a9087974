"""What an answer without a named mistake still shows: a step left out, two steps exchanged."""

from __future__ import annotations

import random
import re

import pytest

from nmatrix.enums import Space
from nmatrix.lessons.check.answer import read_answer
from nmatrix.lessons.check.hints import HALF_UNDONE, LEFT_OUT, NOT_MOVED, NOT_YET
from nmatrix.lessons.check.judge import NO_MISTAKE, TOO_FEW_DIGITS, Judge, Outcome
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

BOX = World(translate=(1, 2, 3), rotate_degrees=(0, 0, 90), scale=(2, 4, 1))
SETUP = Setup(BOX, View(eye=(5, 0, 0)), light=Light((1, 2, 2), position=(4, 5, 6)))
NO_PLACE = NOT_MOVED.format(space="world")
FROM_BEHIND = Setup(BOX, View(eye=(5, 1, 3), target=(0, 1, 3)))
TRACED = Question(Subject.TRACE, FROM_BEHIND, point=(-0.5, -0.5, 0))
CASES = [
    (Question(Subject.EYE, SETUP, Space.OBJECT), "5 0 0", NO_PLACE),
    (Question(Subject.EYE, SETUP, Space.OBJECT), "4 -2 -3", HALF_UNDONE),
    (Question(Subject.LIGHT, SETUP, Space.OBJECT, light=LightPart.POSITION), "3 3 3", HALF_UNDONE),
    (Question(Subject.LIGHT, SETUP, Space.CAMERA, light=LightPart.DIRECTION), "1 2 2", NO_PLACE),
    (Question(Subject.NORMAL, SETUP, normal=(1, 2, 5)), "1 2 5", NOT_MOVED.format(space="object")),
    (TRACED, "3 1 3", NOT_YET.format(frame="world space")),
    (TRACED, "0 0 -2 1", NOT_YET.format(frame="camera space")),
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


MOVED = Question(Subject.WORLD, Setup(World(translate=(0.5, 0.3, 0.2))))
TURNED = Question(Subject.WORLD, Setup(World(translate=(3, 0, 7), rotate_degrees=(0, 0, 30))))
FLAT = Question(Subject.PROJECTION, Setup(lens=Lens(fov_degrees=170, near=0.001)))
IDENTITY = "1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 0 1"


@pytest.mark.parametrize(
    ("question", "text", "part"),
    [
        (MOVED, "1 0 0 0.5; 0 1 0 0; 0 0 1 0; 0 0 0 1", "row 2 column 4 and row 3 column 4 are"),
        (Question(Subject.WORLD, Setup()), f"{IDENTITY[:-1]}0", "row 4 is"),
        (TURNED, "0.866 0 0 3; 0 0.866 0 0; 0 0 1 7; 0 0 0 1",
         "row 1 column 2 and row 2 column 1 are"),
        (TURNED, "0.866 -0.5 0 3; 0 0 0 0; 0 0 1 7; 0 0 0 1", "row 2 is"),
        (TURNED, "0 -0.5 0 3; 0 0.866 0 0; 0 0 1 7; 0 0 0 1", "column 1 is"),
        (FLAT, "0.0875 0 0 0; 0 0.0875 0 0; 0 0 -1.00002 0; 0 0 -1 0", "column 4 is"),
        (FLAT, "0 0 0 0; 0 0 0 0; 0 0 -1.00002 -0.002; 0 0 -1 0",
         "row 1 column 1 and row 2 column 2 are"),
        (Question(Subject.EYE, Setup(view=View(eye=(3, 2, 5)))), "3 0 5", "y is"),
        (Question(Subject.EYE, Setup(view=View(eye=(3, 2, 5)))), "0 0 5", "x and y are"),
    ],
)  # fmt: skip
def test_what_is_left_out_is_named(question, text, part) -> None:
    found = Judge(question).judge(read_answer(text, question))
    assert (found.verdict, found.explanation) == (Outcome.UNKNOWN, LEFT_OUT.format(part=part))


@pytest.mark.parametrize(
    ("question", "text"),
    [
        (MOVED, IDENTITY),
        (MOVED, IDENTITY.replace("0", "0.0")),
        (MOVED, "1 0 0; 0 1 0; 0 0 1"),
        (Question(Subject.WORLD, SETUP), "0 -4 0; 2 0 0; 0 0 1"),
        (Question(Subject.VIEW, SETUP), "0 0 -1; 0 1 0; 1 0 0"),
    ],
)
def test_a_translation_left_out_is_a_mistake_with_a_name(question, text) -> None:
    found = Judge(question).judge(read_answer(text, question))
    assert "translation-missing" in (found.mistake, *found.also)


def drawn_question(draw) -> Question:
    """Draw a scene of small numbers, each entry of which matters or is 0."""

    def three(least, most):
        return tuple(draw.randint(least, most) / draw.choice([1, 2, 10, 100]) for _ in range(3))

    turns = tuple(draw.choice([0, 0, 30, 45, 90, 170]) for _ in range(3))
    world = World(translate=three(-5, 5), rotate_degrees=turns, scale=three(1, 4))
    view = View(eye=(3, draw.randint(-2, 2), 5.5))
    lens = Lens(draw.choice([30, 60, 90]), draw.choice([1, 2]), draw.choice([0.001, 0.1, 1]), 50)
    setup = Setup(world, view, lens, Light(position=(4, draw.randint(-3, 3), 0.5)))
    not_asked = (Subject.NORMAL, Subject.TRACE, Subject.AXES)
    subject = draw.choice([one for one in Subject if one not in not_asked])
    space = draw.choice([Space.WORLD, Space.CAMERA, Space.OBJECT])
    return Question(subject, setup, space, light=LightPart.POSITION)


def parts_named(sentence: str, rows) -> set[tuple[int, int]]:
    """Return the places that a sentence says are left out."""
    places = {(int(i) - 1, int(j) - 1) for i, j in re.findall(r"row (\d) column (\d)", sentence)}
    if places:
        return places
    for axis, name in enumerate(["row", "column"]):
        for number in re.findall(rf"{name} (\d) is", sentence):
            every = {(i, j) for i in range(len(rows)) for j in range(len(rows[0]))}
            return {place for place in every if place[axis] == int(number) - 1}
    letters = sentence.partition("; ")[2].partition(" left out")[0]
    return {(0, "xyzw".index(letter)) for letter in re.findall(r"\b[xyzw]\b", letters)}


@pytest.mark.parametrize(
    "seed", [0, *(pytest.param(one, marks=pytest.mark.slow) for one in range(1, 10))]
)
def test_what_is_said_of_numbers_left_0_is_true(seed) -> None:
    draw = random.Random(seed)
    said = 0
    for _ in range(50):
        question = drawn_question(draw)
        judge = Judge(question)
        right = [list(row[:3]) if question.is_vector else list(row) for row in judge.right]
        texts = [[f"{float(entry):.4f}" for entry in row] for row in right]
        places = [(i, j) for i, row in enumerate(right) for j, entry in enumerate(row) if entry]
        zeros = draw.sample(places, min(len(places), draw.choice([1, 1, 2, 3, 4])))
        for i, j in zeros:
            texts[i][j] = draw.choice(["0", "0", "0.0", "0.00"])
        answer = read_answer("; ".join(" ".join(row) for row in texts), question)
        if not any(map(any, answer.rows)):
            continue
        found = judge.judge(answer)
        largest = max(abs(entry) for row in right for entry in row)
        small = {(i, j) for i, j in zeros if abs(right[i][j]) <= 0.005 + 0.0005 * largest}
        if found.verdict is Outcome.CORRECT:
            assert small == set(zeros)
        elif found.explanation == TOO_FEW_DIGITS:
            assert all(texts[i][j] in ("0.0", "0.00") for i, j in found.wrong_entries)
            assert all(abs(right[i][j]) <= 0.05 for i, j in found.wrong_entries)
        elif found.verdict is Outcome.UNKNOWN and "left out" in found.explanation:
            said += 1
            named = parts_named(found.explanation, right)
            missing = {(i, j) for i, j in named if right[i][j]}
            assert set(found.wrong_entries) <= missing <= set(zeros)
            assert set(zeros) - named <= small
        else:
            assert found.verdict is Outcome.MISTAKE or question.subject is not Subject.WORLD
            assert found.verdict is Outcome.MISTAKE or found.explanation != NO_MISTAKE
    assert said > 20
