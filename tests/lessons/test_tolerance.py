"""What is near enough to be right: by the digits typed, and among entries of one kind."""

from __future__ import annotations

import random
from fractions import Fraction
from math import floor, log10

import pytest

from nmatrix.enums import DepthRange, Space
from nmatrix.lessons.check.answer import read_answer
from nmatrix.lessons.check.hints import LEFT_OUT
from nmatrix.lessons.check.judge import TOO_FEW_DIGITS, Judge, Outcome
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.lessons.check.tolerance import NOISE, yardsticks
from nmatrix.linear.axes import AxisChange, axis_system
from nmatrix.linear.projection import ClipSpace
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

LONG = Light((3000, 0, 0))
FAR = Setup(World(translate=(5000, 3, 0)))
TINY_TURN = Setup(World(rotate_degrees=(0, 0, -0.01)))
MOVED = "1 0 0 1; 0 1 0 0; 0 0 1 0; 0 0 0 1"
CLOSE = Lens(60, 1, 0.0001, 1000)
EYES = ("5", "5.0", "5.00", "5.002", "5.004", "5.006", "5.01", "5.010", "5.1", "6")
FOCUS = "1.7321 0 0 0; 0 1.7321 0 0; 0 0 -1.0000002"


def judged(question, text):
    return Judge(question).judge(read_answer(text, question))


NEAR_BUT_WRONG = [
    # what hides what, question, answer, where it is wrong
    ("a translation hides a scale", Question(Subject.WORLD, FAR),
     "1 0 0 5000; 0 2 0 3; 0 0 1 0; 0 0 0 1", ((1, 1),)),
    ("a translation hides a scale with decimals", Question(Subject.WORLD, FAR),
     "1.0 0 0 5000.0; 0 1.9 0 3.0; 0 0 1.0 0; 0 0 0 1", ((1, 1),)),
    ("a translation hides the corner", Question(Subject.WORLD, FAR),
     "1 0 0 5000; 0 1 0 3; 0 0 1 0; 0 0 0 0", ((3, 3),)),
    ("one scale hides another", Question(Subject.WORLD, Setup(World(scale=(5000, 1, 1)))),
     "5000 0 0; 0 2 0; 0 0 1", ((1, 1),)),
    ("a small entry is left out", Question(Subject.NORMAL, Setup(World(scale=(1, 1000, 1)))),
     "1 0 0; 0 0 0; 0 0 1", ((1, 1),)),
    ("a long direction hides its w", Question(Subject.LIGHT, Setup(light=LONG)),
     "3000 0 0 1", ((0, 3),)),
    ("a distant eye hides its w", Question(Subject.EYE, Setup(view=View(eye=(0, 0, 5000)))),
     "0 0 5000 0", ((0, 3),)),
    ("the focal length hides the depth", Question(Subject.PROJECTION, Setup(lens=CLOSE)),
     f"{FOCUS} 0; 0 0 -1 0", ((2, 3),)),
    ("a tiny scale is doubled", Question(Subject.WORLD, Setup(World(scale=(0.01, 0.02, 0.01)))),
     "0.01 0 0; 0 0.01 0; 0 0 0.01", ((1, 1),)),
]  # fmt: skip


@pytest.mark.parametrize(
    ("question", "text", "wrong"), [case[1:] for case in NEAR_BUT_WRONG], ids=lambda case: ""
)
def test_a_large_entry_excuses_nothing_of_another_kind(question, text, wrong):
    found = judged(question, text)
    assert found.verdict is not Outcome.CORRECT
    assert found.wrong_entries == wrong


@pytest.mark.parametrize(
    ("scale", "normal", "text"),
    [
        ((1, 1.5, 1), (1, 1, 0), "0.01 0 0"),  # 34 degrees off
        ((1, 4, 1), (1, 1, 0), "1e-5 0 0"),  # 14 degrees off
        ((1, 4, 1), (1, 1, 0), "0.01 0 0"),
        ((4, 1, 2), None, "0 0 0; -0.01 0.01 0; 0 0 0.01"),
    ],
)
def test_few_digits_of_a_short_direction_are_no_direction(scale, normal, text):
    setup = Setup(World(scale=scale, shear=(1 if normal is None else 0, 0, 0)))
    found = judged(Question(Subject.NORMAL, setup, normal=normal), text)
    assert found.verdict is not Outcome.CORRECT


@pytest.mark.parametrize(
    ("question", "text", "mistake"),
    [
        (Question(Subject.WORLD, TINY_TURN), "1 -0.000175 0; 0.000175 1 0; 0 0 1", "rotation-sign"),
        (Question(Subject.PROJECTION, Setup(lens=CLOSE)),
         "1.7321 0 0 0; 0 1.7321 0 0; 0 0 -1.0000001 -0.0001; 0 0 -1 0", "depth-range"),
        (Question(Subject.LIGHT, Setup(light=LONG)), "3000 0 0 1", "direction-as-point"),
    ],
)  # fmt: skip
def test_a_mistake_that_gives_every_digit_wins_over_what_is_nearly_right(question, text, mistake):
    found = judged(question, text)
    assert found.verdict is Outcome.MISTAKE
    assert mistake in (found.mistake, *found.also)
    assert found.wrong_entries


TURNED = World(rotate_degrees=(0.5, 0, 0), translate=(20, 0, 0))
ON_THE_WAY = Setup(
    World(translate=(1, 0, 0)),
    View(eye=(3000, 0, 5), target=(3001, 0, 4)),
    light=Light(position=(2, 3, 4)),
)
TINY_MOVE = Setup(World(translate=(0.0001, 0, 0)))


@pytest.mark.parametrize(
    "text",
    [
        "1 0 0 20; 0 1 0.0000 0; 0 0.0000 1 0; 0 0 0 1",
        "1 0 0 20; 0 1 0.0007 0; 0 -0.0007 1 0; 0 0 0 1",
    ],
)
def test_a_translation_of_twenty_hides_no_rotation(text) -> None:
    question = Question(Subject.WORLD, Setup(TURNED))
    assert judged(question, text).verdict is not Outcome.CORRECT


@pytest.mark.parametrize("text", ["-2119.91 3.00 2118.49", "-2119.9 3.0 2118.5"])
def test_the_digits_that_count_are_those_that_were_typed(text) -> None:
    question = Question(Subject.LIGHT, ON_THE_WAY, Space.CAMERA, light=LightPart.POSITION)
    assert judged(question, text).mistake == "used-model-view"


@pytest.mark.parametrize("number", ["-0.0002", "-0.0003", "0.0004"])
def test_nearly_no_translation_is_not_called_one_left_out_or_transposed(number) -> None:
    found = judged(Question(Subject.WORLD, TINY_MOVE), f"1 0 0 {number}; 0 1 0 0; 0 0 1 0; 0 0 0 1")
    assert found.verdict is Outcome.UNKNOWN


def test_zeros_with_decimals_tell_a_matrix_from_its_transpose_as_well() -> None:
    setup = Setup(view=View(eye=(0.0001, 0.0001, -0.0003), target=(2.0001, -0.9999, -0.0003)))
    rows = "0.0 0.0 1.0 0.0003; 0.4472 0.8944 0.0 -0.0001; -0.8944 0.4472 0.0 0.0000"
    found = judged(Question(Subject.VIEW, setup), f"{rows}; 0.0 0.0 0.0 1.0")
    assert "transposed-layout" not in (found.mistake or "")


def test_a_rightly_rounded_direction_is_right_at_some_length() -> None:
    world = World(translate=(0, 0.25, 1), rotate_degrees=(17, 0, 0), scale=(0.0001, 1, 1))
    setup = Setup(world, View(eye=(3, -2, 0), target=(2, -3, 3)))
    question = Question(Subject.NORMAL, setup, Space.CAMERA, normal=(1, -2, 1))
    for text in ("-0.949 -0.0955 0.301", "-0.949 -0.096 0.301", "-0.9487 -0.0955 0.3014"):
        assert judged(question, text).verdict is Outcome.CORRECT
    for text in ("-0.949 0.0955 0.301", "-0.749 -0.0955 0.301"):
        assert judged(question, text).verdict is not Outcome.CORRECT


def test_too_few_digits_are_said_to_be_too_few() -> None:
    lens = Lens(90, 2, 0.1, 100, clip=ClipSpace(depth=DepthRange.REVERSED))
    question = Question(Subject.PROJECTION, Setup(lens=lens))
    found = judged(question, "0.5 0 0 0; 0 1 0 0; 0 0 0.00 0.1; 0 0 -1 0")
    assert (found.verdict, found.wrong_entries) == (Outcome.CORRECT, ())
    for text in ("0.5 0 0 0; 0 1 0 0; 0 0 0 0.1; 0 0 -1 0", "0 0 0 0; 0 0 0 0; 0 0 0 0; 0 0 -1 0"):
        assert judged(question, text).verdict is not Outcome.CORRECT
    eye = Question(Subject.EYE, Setup(view=View(eye=(3, 0.03, 5))))
    for zero, sentence in (("0.0", TOO_FEW_DIGITS), ("0", LEFT_OUT.format(part="y is"))):
        found = judged(eye, f"3 {zero} 5")
        assert (found.verdict, found.explanation) == (Outcome.UNKNOWN, sentence)
    assert judged(eye, "3 0.03 5").verdict is Outcome.CORRECT


def test_more_digits_never_make_a_right_answer_wrong() -> None:
    question = Question(Subject.EYE, Setup())
    right = {text: judged(question, f"0 0 {text}").verdict is Outcome.CORRECT for text in EYES}
    assert [text for text, is_right in right.items() if is_right] == ["5", "5.0", "5.00", "5.002"]


@pytest.mark.parametrize(
    ("text", "right"),
    [
        ("0.67", True),  # half a unit of the last place
        ("0.66", False),
        ("0.7", True),
        ("0.666", True),  # a whole unit from three decimals on: cut off
        ("0.665", False),
        ("0.6669", True),  # 5e-4 of the largest of its kind
        ("0.6674", False),
        ("2/3", True),
        ("667/1000", False),  # a fraction and a whole number claim all of their digits
        ("6.67e-1", True),
        ("1", False),
        ("0", False),
        ("0.0", False),
    ],
)
def test_an_entry_is_right_to_the_digits_that_it_was_written_with(text, right) -> None:
    question = Question(Subject.WORLD, Setup(World(scale=(Fraction(2, 3), 1, 1))))
    found = judged(question, f"{text} 0 0; 0 1 0; 0 0 1")
    assert (found.verdict is Outcome.CORRECT) is right


def test_what_a_whole_number_hides_is_never_right() -> None:
    """A billionth of the largest of its kind is noise, more is not."""
    for hidden, right in ((4e-10, True), (4e-9, False)):
        for world in (
            World(translate=(1, hidden, 0)),
            World(translate=(1, 0, 0), scale=(1, 1 + hidden, 1)),
            World(translate=(1, 0, 0), shear=(hidden, 0, 0)),
        ):
            found = judged(Question(Subject.WORLD, Setup(world)), MOVED)
            assert (found.verdict is Outcome.CORRECT) is right


def test_a_number_left_0_is_never_right() -> None:
    draw = random.Random(11)
    for _ in range(60):
        question = wide_question(draw)
        judge = Judge(question)
        rows = printed(judge.right, 12)
        size = range(len(rows)), range(3 if question.is_vector else len(rows[0]))
        places = [(i, j) for i in size[0] for j in size[1] if float(rows[i][j])]
        if len(places) < 2:
            continue
        i, j = draw.choice(places)
        kind = yardsticks(judge.right, is_vector=question.is_vector)[i][j]
        if abs(judge.right[i][j]) > 2 * NOISE * kind:
            rows[i][j] = "0"
            assert judge.judge(read_answer(written(rows), question)).verdict is not Outcome.CORRECT


def test_what_is_right_to_its_digits_stays_right_beside_a_mistake_that_is_as_close():
    text = "1.0000 0.0002 0; -0.0002 1.0000 0; 0 0 1"
    assert judged(Question(Subject.WORLD, TINY_TURN), text).verdict is Outcome.CORRECT
    found = judged(Question(Subject.WORLD, TINY_TURN), "1 0 0; 0 1 0; 0 0 1")
    assert found.mistake == "rotation-missing"


def test_a_tolerance_of_the_teachers_is_the_only_one():
    for tolerance, right in ((Fraction(2), True), (Fraction(1, 2), False)):
        question = Question(Subject.WORLD, FAR, tolerance=tolerance)
        found = judged(question, "1 0 0 5001; 0 2 0 3; 0 0 1 0; 0 0 0 1")
        assert (found.verdict is Outcome.CORRECT) is right


def wide_question(draw: random.Random) -> Question:
    """Return a question whose entries differ by many orders of magnitude."""

    def three(low, high):
        return tuple(draw.choice([1, -1]) * 10 ** draw.uniform(low, high) for _ in range(3))

    setup = Setup(
        World(
            translate=three(-1, 4),
            rotate_degrees=tuple(draw.uniform(-180, 180) for _ in range(3)),
            scale=three(-2, 3),
        ),
        View(eye=three(-1, 4), target=three(-1, 1)),
        Lens(draw.uniform(5, 120), 10 ** draw.uniform(-0.5, 0.5), 10 ** draw.uniform(-4, 0), 2000),
        Light(three(-1, 4), position=three(-1, 4)),
    )
    subject = draw.choice([one for one in Subject if one is not Subject.TRACE])
    space = draw.choice([Space.WORLD, Space.CAMERA, Space.OBJECT])
    if subject is Subject.NORMAL and space is Space.OBJECT:
        space = Space.CAMERA
    axes = AxisChange(*map(axis_system, draw.sample(["blender", "opengl", "ros", "unity"], 2)))
    return Question(subject, setup, space, light=draw.choice(list(LightPart)), axes=axes)


def printed(value, decimals: int) -> list[list[str]]:
    return [[f"{float(entry):.{decimals}f}" for entry in row] for row in value]


def written(rows) -> str:
    return "; ".join(" ".join(row) for row in rows)


def decimals_for(value, *, any_length) -> int:
    """Return how many decimals show the largest entry of every column.

    One digit of it, or two where length is free: one would not tell a direction.
    """
    columns = zip(*value[:3], strict=True) if len(value) > 1 else value
    smallest = min(max(map(abs, column)) or 1 for column in columns)
    return max(2, (1 if any_length else 0) - floor(log10(smallest)))


@pytest.mark.parametrize("seed", range(60))
def test_right_to_any_number_of_digits_at_any_magnitude(seed):
    draw = random.Random(seed)
    question = wide_question(draw)
    judge = Judge(question)
    least = decimals_for(judge.right, any_length=question.any_length)
    for decimals in range(least, least + 8):
        answer = read_answer(written(printed(judge.right, decimals)), question)
        assert judge.judge(answer).verdict is Outcome.CORRECT


@pytest.mark.parametrize("seed", range(60))
def test_an_entry_off_by_a_twentieth_of_its_column_is_found_at_any_magnitude(seed):
    draw = random.Random(seed)
    question = wide_question(draw)
    judge = Judge(question)
    rows = printed(judge.right, decimals_for(judge.right, any_length=question.any_length) + 4)
    i, j = draw.randrange(min(3, len(rows))), draw.randrange(3 if len(rows) == 1 else len(rows[0]))
    beside = judge.right[0][:3] if len(rows) == 1 else [row[j] for row in judge.right[:3]]
    largest = float(max(map(abs, beside))) or 1.0
    if question.any_length and largest == abs(float(judge.right[i][j])):
        return  # a longer direction along an axis is the same direction
    rows[i][j] = repr(float(rows[i][j]) + largest / 20)
    found = judge.judge(read_answer(written(rows), question))
    assert found.verdict is not Outcome.CORRECT
