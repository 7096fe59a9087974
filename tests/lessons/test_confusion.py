"""How well the mistakes are told apart, counted; docs/mistakes.md shows the same table."""

from __future__ import annotations

import random
from collections import Counter
from fractions import Fraction
from pathlib import Path

import pytest

from nmatrix.enums import Convention, DepthRange, Handedness, Space
from nmatrix.lessons.check.answer import Answer
from nmatrix.lessons.check.judge import Judge, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.linear.projection import ClipSpace
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

PAGE = Path(__file__).parents[2] / "docs" / "mistakes.md"
SCENES = 40


def scene(seed: int) -> Setup:
    draw = random.Random(seed)

    def three(choices):
        return tuple(draw.choice(choices) for _ in range(3))

    world = World(
        three(range(-4, 5)),
        three((0, 30, -45, 60, 90, 20)),
        scale=three((0.25, 0.5, 1, 2, 3, -1)),
        shear=three((0, 0, 1, -2)),
        convention=draw.choice(list(Convention)),
    )
    view = View(eye=three(range(-5, 6)), target=(0, 0.5, -7))
    if seed % 2:
        view = View(view.eye, angles=FirstPerson(*three((0, 30, -45, 60))))
    clip = ClipSpace(draw.choice(list(DepthRange)), draw.choice(list(Handedness)))
    lens = Lens(draw.choice((45, 60, 90)), draw.choice((1.5, 2, 0.75)), 0.5, 20, clip=clip)
    light = Light(three((1, -2, 3, 4)), position=three(range(-5, 6)))
    return Setup(world, view, lens, light)


def questions(setup: Setup):
    n = (1, 2, -1)
    for subject in (Subject.WORLD, Subject.VIEW, Subject.PROJECTION):
        yield Question(subject, setup)
    for space in (Space.WORLD, Space.CAMERA):
        yield Question(Subject.NORMAL, setup, space)
        yield Question(Subject.NORMAL, setup, space, normal=n)
        yield Question(Subject.NORMAL, setup, space, normal=n, unit=True)
    for space in (Space.CAMERA, Space.OBJECT):
        yield Question(Subject.EYE, setup, space)
        for part in LightPart:
            yield Question(Subject.LIGHT, setup, space, light=part)


def confusion(scenes: range) -> dict[MistakeId, Counter[str]]:
    """Return for each mistake how often it was made, named first, named beside, or misnamed."""
    found: dict[MistakeId, Counter[str]] = {one: Counter() for one in MistakeId}
    for question in (one for seed in scenes for one in questions(scene(seed))):
        judge = Judge(question)
        for wrong in judge.singles:
            rows = tuple(tuple(Fraction(float(x)) for x in row) for row in wrong.value)
            all_digits = tuple(tuple(Fraction(1, 10**17) for _ in row) for row in rows)
            judged = judge.judge(Answer(rows, all_digits))
            if judged.verdict is Outcome.CORRECT:
                continue  # as near to the right answer as three digits can tell
            made = wrong.mistakes[0]
            named = (
                "first" if judged.mistake == made else "also" if made in judged.also else "other"
            )
            found[made][named] += 1
    return found


def table(found: dict[MistakeId, Counter[str]]) -> str:
    rows = [
        f"| `{one}` | {counts.total()} | {counts['first']} | {counts['also']} |"
        for one, counts in found.items()
    ]
    return "\n".join(rows)


def test_no_mistake_is_given_another_name():
    found = confusion(range(4))
    assert sum(counts.total() for counts in found.values()) > 500
    assert not any(counts["other"] for counts in found.values())


@pytest.mark.slow
def test_the_table_in_the_documentation_is_what_is_counted():
    found = confusion(range(SCENES))
    assert all(counts["first"] for counts in found.values()), "each is named first somewhere"
    assert table(found) in PAGE.read_text(encoding="utf-8")
