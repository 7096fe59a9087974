"""Every mistake, made on purpose by arithmetic of its own, is recognised; nothing else is."""

from __future__ import annotations

import csv
import random
from dataclasses import replace
from fractions import Fraction
from itertools import product
from math import cos, pi, sin, tan
from pathlib import Path

import pytest

from nmatrix.enums import ClipY, Convention, DepthRange, Handedness, Space
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.lessons.check import judge as judging
from nmatrix.lessons.check.answer import Answer, read_answer
from nmatrix.lessons.check.judge import Judge, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import LightPart, Question, Subject, right_answer
from nmatrix.lessons.check.wrong import WrongAnswers
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

# Small matrices of floats, written down a second time on purpose: the oracle of this file.


def mul(*matrices):
    found = matrices[0]
    for B in matrices[1:]:
        found = [
            [
                sum(a * b for a, b in zip(row, column, strict=False))
                for column in zip(*B, strict=False)
            ]
            for row in found
        ]
    return found


def transposed(A):
    return [list(row) for row in zip(*A, strict=False)]


def turn(axis, radians):
    s, c = sin(radians), cos(radians)
    return {
        "x": [[1, 0, 0], [0, c, -s], [0, s, c]],
        "y": [[c, 0, s], [0, 1, 0], [-s, 0, c]],
        "z": [[c, -s, 0], [s, c, 0], [0, 0, 1]],
    }[axis]


def inverse3(A):
    (a, b, c), (d, e, f), (g, h, i) = A
    det = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    return [
        [(e * i - f * h) / det, (c * h - b * i) / det, (b * f - c * e) / det],
        [(f * g - d * i) / det, (a * i - c * g) / det, (c * d - a * f) / det],
        [(d * h - e * g) / det, (b * g - a * h) / det, (a * e - b * d) / det],
    ]


def affine(A, t):
    return [[*row, x] for row, x in zip(A, t, strict=False)] + [[0, 0, 0, 1]]


def inverse4(M):
    A = inverse3([row[:3] for row in M[:3]])
    t = [-sum(a * row[3] for a, row in zip(line, M, strict=False)) for line in A]
    return affine(A, t)


def at(M, v):
    return [sum(a * b for a, b in zip(row, v, strict=False)) for row in M]


def text(value) -> str:
    rows = value if isinstance(value[0], (list, tuple)) else [value]
    return "; ".join(" ".join(f"{float(x):.6f}" for x in row) for row in rows)


def asked(subject, setup, **more) -> Question:
    return Question(subject, setup, **more)


def verdict(question, value):
    return Judge(question).judge(read_answer(text(value), question))


def typed(rows) -> Answer:
    """Return exact numbers as an answer with all their digits."""
    return Answer(
        tuple(map(tuple, rows)), tuple(tuple(Fraction(1, 10**17) for _ in row) for row in rows)
    )


# One scene in which no mistake is hidden by a symmetry.

T, DEG, S, H = (1, -2, 3), (20, 35, -50), (2, 1, 0.5), (0.5, -1, 0.25)
WORLD = World(translate=T, rotate_degrees=DEG, scale=S, shear=H)
VIEW = View(eye=(3, 1, 2.5), angles=FirstPerson(25, -40, 10))
DIRECTION, POSITION = (0.3, -0.9, 0.2), (2, 5, -1)
SETUP = Setup(WORLD, VIEW, Lens(50, 1.5, 0.5, 20), Light(DIRECTION, position=POSITION))


def rotation(angles=DEG, order="xyz", unit=pi / 180):
    about = {axis: turn(axis, a * unit) for axis, a in zip("xyz", angles, strict=False)}
    return mul(*(about[axis] for axis in order))


def block(R, scale=S, shear=H):
    xy, xz, yz = shear
    D = [[scale[0], 0, 0], [0, scale[1], 0], [0, 0, scale[2]]]
    return mul(R, D, [[1, xy, xz], [0, 1, yz], [0, 0, 1]])


A = block(rotation())
M = affine(A, T)
N = transposed(inverse3(A))


def camera(elevation=25, angle=-40, roll=10, unit=pi / 180):
    R = mul(turn("z", -roll * unit), turn("x", -elevation * unit), turn("y", -angle * unit))
    return affine(R, [-x for x in at(R, VIEW.eye)])


V = camera()


def projection(f, aspect, near=0.5, far=20.0, depth="gl", g=-1):
    a, c = {
        "gl": ((far + near) / (far - near), -2 * far * near / (far - near)),
        "vulkan": (far / (far - near), -far * near / (far - near)),
        "reversed": (-near / (far - near), far * near / (far - near)),
    }[depth]
    return [[f / aspect, 0, 0, 0], [0, f, 0, 0], [0, 0, g * a, c], [0, 0, g, 0]]


F = 1 / tan(25 * pi / 180)
MV = mul(V, M)
VECTORS = {"unit": True}


def unit(v):
    length = sum(x * x for x in v) ** 0.5
    return [x / length for x in v]


n = (1, 2, -1)
object_from_world = inverse4(M)
d0, p1, e1 = (*DIRECTION, 0), (*POSITION, 1), (*VIEW.eye, 1)
aimed = {"light": LightPart.DIRECTION}
placed = {"light": LightPart.POSITION}

MADE = [
    # subject, extra, mistake, the wrong answer by the oracle
    ("normal", {}, "not-transposed", inverse3(A)),
    ("normal", {}, "not-inverted", transposed(A)),
    ("normal", {}, "used-world-matrix", A),
    ("normal", {"normal": n}, "not-transposed", at(inverse3(A), n)),
    ("normal", {"normal": n}, "translated", at(M, (*n, 1))[:3]),
    ("normal", {"normal": n, "unit": True}, "missing-normalise", at(N, n)),
    (
        "normal",
        {"normal": n, "unit": True},
        "four-component-normalise",
        unit(at(transposed(object_from_world), (*n, 0)))[:3],
    ),
    ("normal", {}, "used-model-view", transposed(inverse3([row[:3] for row in MV[:3]]))),
    ("normal", {}, "degrees-as-radians", transposed(inverse3(block(rotation(unit=1))))),
    ("normal", {}, "rotation-order", transposed(inverse3(block(rotation(order="zyx"))))),
    (
        "normal",
        {"space": Space.CAMERA},
        "view-not-inverted",
        transposed(inverse3([row[:3] for row in mul(inverse4(V), M)[:3]])),
    ),
    ("world", {}, "transposed-layout", transposed(M)),
    ("world", {}, "degrees-as-radians", affine(block(rotation(unit=1)), T)),
    ("world", {}, "rotation-order", affine(block(rotation(order="yxz")), T)),
    ("world", {}, "rotation-sign", affine(block(rotation((-20, -35, 50))), T)),
    ("world", {}, "rotation-sign", affine(block(rotation((20, -35, -50))), T)),
    ("world", {}, "polimi-angles-swapped", affine(block(rotation((35, -20, 50))), T)),
    ("world", {}, "polimi-angles-swapped", affine(block(rotation((35, 20, -50))), T)),
    ("world", {}, "scale-before-translate", affine(A, at(A, T))),
    ("view", {}, "view-not-inverted", inverse4(V)),
    ("view", {}, "used-model-view", MV),
    ("view", {}, "transposed-layout", transposed(V)),
    ("view", {}, "degrees-as-radians", camera(unit=1)),
    ("view", {}, "rotation-sign", camera(-25, 40, -10)),
    ("view", {}, "wrong-handedness", [*V[:2], [-x for x in V[2]], V[3]]),
    ("view", {}, "view-translation", affine([r[:3] for r in V[:3]], [-3, -1, -2.5])),
    ("projection", {}, "degrees-as-radians", projection(1 / tan(25), 1.5)),
    ("projection", {}, "wrong-handedness", projection(F, 1.5, g=1)),
    ("projection", {}, "depth-range", projection(F, 1.5, depth="vulkan")),
    ("projection", {}, "depth-range", projection(F, 1.5, depth="reversed")),
    ("projection", {}, "aspect-inverted", projection(F, 1 / 1.5)),
    ("projection", {}, "horizontal-fov", projection(F * 1.5, 1.5)),
    ("projection", {}, "near-far-swapped", projection(F, 1.5, near=20.0, far=0.5)),
    ("projection", {}, "transposed-layout", transposed(projection(F, 1.5))),
    ("light", {"space": Space.CAMERA, **placed}, "used-model-view", at(MV, p1)[:3]),
    ("light", {"space": Space.CAMERA, **aimed}, "used-model-view", at(MV, d0)[:3]),
    ("light", {"space": Space.CAMERA, **aimed}, "direction-as-point", at(V, (*DIRECTION, 1))[:3]),
    ("light", {"space": Space.CAMERA, **placed}, "view-not-inverted", at(inverse4(V), p1)[:3]),
    ("light", {"space": Space.OBJECT, **aimed}, "course-light-rule", at(transposed(A), DIRECTION)),
    ("light", {"space": Space.OBJECT, **aimed}, "used-world-matrix", at(A, DIRECTION)),
    ("light", {"space": Space.OBJECT, **placed}, "used-world-matrix", at(M, p1)[:3]),
    ("light", {"space": Space.OBJECT, **aimed, "unit": True}, "missing-normalise",
     at(inverse3(A), DIRECTION)),
    ("eye", {"space": Space.OBJECT}, "used-world-matrix", at(M, e1)[:3]),
    ("eye", {"space": Space.OBJECT}, "used-model-view", at(inverse4(MV), e1)[:3]),
    ("eye", {"space": Space.OBJECT}, "transposed-layout",
     at(transposed(object_from_world), e1)[:3]),
    ("eye", {"space": Space.OBJECT}, "scale-before-translate",
     at(inverse4(affine(A, at(A, T))), e1)[:3]),
]  # fmt: skip


@pytest.mark.parametrize(("subject", "more", "mistake", "value"), MADE)
def test_a_mistake_made_on_purpose_is_named(subject, more, mistake, value):
    found = verdict(asked(Subject(subject), SETUP, **more), value)
    assert (found.verdict, found.mistake) == (Outcome.MISTAKE, mistake)
    assert found.explanation.startswith(MISTAKES[MistakeId(mistake)].did)


def test_the_cofactors_of_a_mirror_have_the_wrong_sign():
    mirrored = replace(SETUP, world=replace(WORLD, scale=(-2, 1, 0.5)))
    B = block(rotation(), (-2, 1, 0.5))
    C = [[-x for x in row] for row in transposed(inverse3(B))]  # det < 0, so C points against N
    assert verdict(asked(Subject.NORMAL, mirrored), C).mistake == "cofactor-sign"
    assert verdict(asked(Subject.NORMAL, SETUP), N).verdict is Outcome.CORRECT


def test_every_mistake_has_its_record_in_the_order_of_the_enum():
    assert list(MISTAKES) == list(MistakeId)


def test_every_mistake_is_made_on_purpose():
    made = {MistakeId(mistake) for _, _, mistake, _ in MADE}
    with Path(__file__).with_name("real_code.csv").open(encoding="utf-8", newline="") as file:
        made |= {
            MistakeId(one) for row in csv.DictReader(file) for one in row["mistake"].split("+")
        }
    assert made == {*MistakeId} - {MistakeId.COFACTOR_SIGN}, "that one needs a mirror, as above"


RIGHT = [
    ("world", {}, M),
    ("view", {}, V),
    ("projection", {}, projection(F, 1.5)),
    ("normal", {}, N),
    ("normal", {"normal": n}, at(N, n)),
    ("normal", {"normal": n, "unit": True}, unit(at(N, n))),
    ("light", {"space": Space.CAMERA, **aimed}, at(V, d0)[:3]),
    ("light", {"space": Space.CAMERA, **placed}, at(V, p1)[:3]),
    (
        "light",
        {"space": Space.OBJECT, **aimed, "unit": True},
        unit(at(inverse3(A), DIRECTION)),
    ),
    ("eye", {"space": Space.OBJECT}, at(object_from_world, e1)[:3]),
    ("eye", {"space": Space.CAMERA}, [0, 0, 0]),
]


@pytest.mark.parametrize(("subject", "more", "value"), RIGHT)
@pytest.mark.parametrize("decimals", [3, 4, 6, 12])
def test_the_right_answer_is_right_to_any_number_of_digits(subject, more, value, decimals):
    question = asked(Subject(subject), SETUP, **more)
    rows = value if isinstance(value[0], list) else [value]
    written = "; ".join(" ".join(f"{x:.{decimals}f}" for x in row) for row in rows)
    assert Judge(question).judge(read_answer(written, question)).verdict is Outcome.CORRECT


def test_two_and_almost_two_are_right_and_one_and_nine_tenths_is_not():
    question = asked(Subject.NORMAL, Setup(World(scale=(0.5, 1, 1))))
    for entry, right in (("2", 1), ("2.0", 1), ("1.9998", 1), ("1.9", 0), ("2.05", 0)):
        found = Judge(question).judge(read_answer(f"{entry} 0 0; 0 1 0; 0 0 1", question))
        assert (found.verdict is Outcome.CORRECT) == bool(right), entry


@pytest.mark.parametrize("factor", [0.01, 3, 250])
def test_a_positive_factor_changes_no_direction_and_a_negative_one_does(factor):
    for more in ({}, {"normal": n}):
        question = asked(Subject.NORMAL, SETUP, **more)
        value = N if not more else [at(N, n)]
        longer = [[x * factor for x in row] for row in value]
        exact = tuple(tuple(Fraction(x) for x in row) for row in longer)
        found = Judge(question).judge(typed(exact))
        assert found.verdict is Outcome.CORRECT
        assert judging.UP_TO_LENGTH in found.remarks
        turned = tuple(tuple(-x for x in row) for row in exact)
        assert Judge(question).judge(typed(turned)).verdict is not Outcome.CORRECT


@pytest.mark.parametrize(
    "lens",
    [
        Lens(near=1, far=float("inf"), frustum=Window(-2, 2, -1, 1)),
        Lens(near=1, far=float("inf")),
        Lens(aspect=1e-300, near=1, far=10),
        Lens(aspect=1e-300, fov_degrees=179.9999, near=1e-300, far=1e300),
    ],
)
def test_lenses_at_the_limits_have_fewer_mistakes_and_no_crash(lens):
    question = asked(Subject.PROJECTION, Setup(lens=lens))
    numbers = " ".join(["1"] * 16)
    assert Judge(question).judge(read_answer(numbers, question)).verdict is Outcome.UNKNOWN


def test_with_unit_the_inverse_transpose_itself_is_asked_for():
    question = asked(Subject.NORMAL, Setup(World(scale=(1, 2, 1))), unit=True)
    right, cofactors = ("1 0 0; 0 0.5 0; 0 0 1", "2 0 0; 0 1 0; 0 0 2")
    assert Judge(question).judge(read_answer(right, question)).verdict is Outcome.CORRECT
    assert Judge(question).judge(read_answer(cofactors, question)).mistake == "missing-normalise"


def test_zeros_are_never_right_by_rounding():
    tiny = Setup(World(scale=(1000, 1000, 1000)))
    for question in (asked(Subject.NORMAL, tiny), asked(Subject.EYE, tiny, space=Space.OBJECT)):
        zeros = "0 0 0; 0 0 0; 0 0 0" if not question.is_vector else "0 0 0"
        found = Judge(question).judge(read_answer(zeros, question))
        assert found.verdict is not Outcome.CORRECT


def test_only_the_wrong_entries_are_marked_whatever_the_length():
    question = asked(Subject.NORMAL, Setup(World(scale=(1, 2, 1))))
    found = Judge(question).judge(read_answer("3 0 0; 0 7 0; 0 0 3", question))
    assert found.wrong_entries == ((1, 1),)


def test_a_symmetric_matrix_cannot_tell_and_also_says_so():
    question = asked(Subject.NORMAL, Setup(World(scale=(1, 2, 1))))
    found = Judge(question).judge(read_answer("1 0 0; 0 2 0; 0 0 1", question))
    assert (found.mistake, found.also) == ("not-inverted", ("used-world-matrix",))


def test_a_plain_inverse_is_never_a_layout():
    for space in (Space.WORLD, Space.CAMERA):
        question = asked(Subject.NORMAL, SETUP, space=space)
        named = {name for one in WrongAnswers(question).of_singles() for name in one.mistakes}
        assert MistakeId.TRANSPOSED_LAYOUT not in named


def test_the_course_rule_under_a_plain_scale_keeps_its_own_name():
    setup = Setup(World(scale=(1, 0.25, 1)), light=Light((0.3, 0.9, 0.2)))
    question = asked(Subject.LIGHT, setup, space=Space.OBJECT)
    assert verdict(question, (0.3, 0.225, 0.2)).mistake == "course-light-rule"


def test_the_matrix_itself_is_named_for_lights_whatever_its_symmetry():
    for turn in (0, 30):
        world = World(scale=(4, 1, 2), rotate_degrees=(0, 0, turn))
        setup = Setup(world, View(eye=(0, 3, 6), target=(2, 2, 4)), light=Light((1, -2, 0)))
        question = asked(Subject.LIGHT, setup, space=Space.CAMERA)
        moved = at(block(rotation((0, 0, turn)), (4, 1, 2), (0, 0, 0)), (1, -2, 0))
        assert verdict(question, moved).mistake == "used-world-matrix"


def test_angles_of_the_light_matter_in_its_own_space():
    light = Light(angles_degrees=(40, 50), position=(2, 5, -1))
    setup = Setup(World(rotate_degrees=(0, 0, 30), scale=(1, 2, 1)), light=light)
    question = asked(Subject.NORMAL, setup, space=Space.LIGHT)
    named = [
        one.value
        for one in WrongAnswers(question).of_singles()
        if one.mistakes == (MistakeId.DEGREES_AS_RADIANS,)
    ]
    assert len(set(named) - {right_answer(question)}) == 2 * 3, (
        "of two units: the world's angles, the light's, and both"
    )


def test_swapped_planes_from_zero_to_one_are_the_other_depth_range():
    for depth, swapped in (("vulkan", "reversed"), ("reversed", "vulkan")):
        kind = {"vulkan": DepthRange.ZERO_TO_ONE, "reversed": DepthRange.REVERSED}[depth]
        setup = replace(SETUP, lens=replace(SETUP.lens, clip=ClipSpace(depth=kind)))
        found = verdict(asked(Subject.PROJECTION, setup), projection(F, 1.5, depth=swapped))
        assert (found.mistake, found.also) == ("depth-range", ("near-far-swapped",))


PAIRS = [
    ("normal", {}, "used-world-matrix+degrees-as-radians", block(rotation(unit=1))),
    ("world", {}, "transposed-layout+degrees-as-radians",
     transposed(affine(block(rotation(unit=1)), T))),
    ("projection", {}, "degrees-as-radians+depth-range",
     projection(1 / tan(25), 1.5, depth="vulkan")),
    ("projection", {}, "transposed-layout+aspect-inverted", transposed(projection(F, 1 / 1.5))),
    ("normal", {"normal": n, "unit": True}, "used-world-matrix+missing-normalise", at(A, n)),
    ("light", {"space": Space.OBJECT, **aimed}, "course-light-rule+rotation-order",
     at(transposed(block(rotation(order="zyx"))), DIRECTION)),
]  # fmt: skip


@pytest.mark.parametrize(("subject", "more", "name", "value"), PAIRS)
def test_two_mistakes_at_once_are_named_where_only_one_pair_fits(subject, more, name, value):
    assert verdict(asked(Subject(subject), SETUP, **more), value).mistake == name


def test_a_light_without_the_other_part_cannot_be_asked_for_it():
    setup = Setup(light=Light(position=(1, 2, 3)))
    with pytest.raises(IllegalValueError, match="this light has none"):
        right_answer(asked(Subject.LIGHT, setup))


def test_a_flattened_normal_counts_with_either_sign():
    question = asked(Subject.NORMAL, Setup(World(scale=(1, 0, 1))), normal=(0, 1, 0))
    for sign in (1, -1):
        assert verdict(question, (0, sign, 0)).verdict is Outcome.CORRECT
    assert verdict(question, (1, 0, 0)).verdict is Outcome.UNKNOWN


def test_questions_without_an_answer_say_so():
    flat = Setup(World(scale=(1, 0, 1)))
    for question in (
        asked(Subject.NORMAL, flat),
        asked(Subject.NORMAL, flat, normal=(1, 0, 0)),
        asked(Subject.EYE, flat, space=Space.OBJECT),
    ):
        with pytest.raises(NoAnswerError):
            right_answer(question)


def nice_shot(seed: int) -> Setup:
    """Return a scene of small numbers; some seeds mirror, shear or use other conventions."""
    draw = random.Random(seed)
    angles = [0, 30, -45, 60, 90, 20, -75]
    world = World(
        translate=tuple(draw.randint(-4, 4) for _ in range(3)),
        rotate_degrees=tuple(draw.choice(angles) for _ in range(3)),
        scale=tuple(draw.choice([0.25, 0.5, 1, 2, 3, -1, -2]) for _ in range(3)),
        shear=tuple(draw.choice([0, 0, 1, -2]) for _ in range(3)),
        convention=draw.choice(list(Convention)),
    )
    view = View(eye=tuple(draw.randint(-5, 5) for _ in range(3)), target=(0, 0.5, -7))
    if seed % 2:
        view = View(view.eye, angles=FirstPerson(draw.choice(angles), draw.choice(angles), 0))
    handed = draw.choice(list(Handedness)) if not seed % 2 else Handedness.RIGHT
    clip = ClipSpace(draw.choice(list(DepthRange)), handed, draw.choice(list(ClipY)))
    lens = Lens(draw.choice([45, 60, 90]), draw.choice([1.5, 2, 0.75]), 0.5, 20, clip=clip)
    source = Light((draw.randint(1, 4), -2, draw.randint(-3, 3)), position=(2, 5, -1))
    return Setup(world, replace(view, handed=handed), lens, source)


def questions(seed: int):
    setup = nice_shot(seed)
    spaces = [Space.WORLD, Space.CAMERA, Space.OBJECT]
    for subject in (Subject.WORLD, Subject.VIEW, Subject.PROJECTION):
        yield asked(subject, setup)
    for space in spaces[:2]:
        yield asked(Subject.NORMAL, setup, space=space)
        yield asked(Subject.NORMAL, setup, space=space, normal=(1, 2, -1), unit=True)
    for space, part in product(spaces[1:], LightPart):
        yield asked(Subject.LIGHT, setup, space=space, light=part)
    yield asked(Subject.EYE, setup, space=Space.OBJECT)


def every_single_mistake_is_recognised(seed: int) -> int:
    count = 0
    for question in questions(seed):
        judge = Judge(question)
        for wrong in judge.singles:
            rows = tuple(tuple(Fraction(float(x)) for x in row) for row in wrong.value)
            found = judge.judge(typed(rows))
            if found.verdict is Outcome.CORRECT:
                continue  # closer to the right answer than its digits tell
            assert wrong.mistakes[0].value in (found.mistake, *found.also)
            count += 1
    return count


def test_every_mistake_is_recognised_on_scenes_of_every_kind():
    assert sum(map(every_single_mistake_is_recognised, range(12))) > 1_000


@pytest.mark.slow
def test_every_mistake_is_recognised_on_more_scenes():
    assert sum(map(every_single_mistake_is_recognised, range(12, 28))) > 3_000


@pytest.mark.slow
def test_random_numbers_are_no_mistake():
    draw = random.Random(5)
    for question in questions(3):
        judge = Judge(question)
        for _ in range(3):
            size = (1, 3) if question.is_vector else (len(judge.right), len(judge.right[0]))
            rows = tuple(
                tuple(Fraction(draw.randint(-9999, 9999), 1000) for _ in range(size[1]))
                for _ in range(size[0])
            )
            assert judge.judge(typed(rows)).verdict is Outcome.UNKNOWN


def test_a_pair_never_takes_the_name_of_a_single_mistake():
    question = asked(Subject.WORLD, nice_shot(4))
    singles = {one.value for one in Judge(question).singles}
    doubles = Judge(question).doubles
    assert doubles
    assert not any(one.value in singles for one in doubles)
    assert len(list(WrongAnswers(question).of_pairs())) > len(doubles)


def test_without_its_slip_a_mistake_is_not_recognised(monkeypatch):
    """The recognition comes from the mistake's slip, not from the name of the test."""
    monkeypatch.delitem(MISTAKES[MistakeId.NOT_TRANSPOSED].slips, Subject.NORMAL)
    assert verdict(asked(Subject.NORMAL, SETUP), inverse3(A)).mistake != "not-transposed"


@pytest.mark.parametrize(
    ("subject", "text"),
    [
        ("world", "1 2 3 4 5"),
        ("world", "the identity"),
        ("light", "1 2"),
        ("light", "1 2 3 4 5"),
        ("projection", "1 0 0; 0 1 0; 0 0 1"),
        ("normal", "nan 0 0; 0 1 0; 0 0 1"),
        ("normal", "1 " * 500_000),
        ("eye", ""),
    ],
)
def test_what_is_no_answer_is_refused_in_one_line(subject, text):
    question = asked(Subject(subject), SETUP, space=Space.CAMERA)
    with pytest.raises(IllegalValueError) as caught:
        read_answer(text, question)
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 250
