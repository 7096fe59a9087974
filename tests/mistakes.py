"""How well the mistakes of `check` are told apart, counted: two tables of `docs/mistakes.md`.

`python tests/mistakes.py` writes them anew; a test compares. Each mistake is made, by its slip, in
scenes of numbers that no coincidence helps, and typed with six decimals.
"""

from __future__ import annotations

import random
from collections import Counter
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path

from nmatrix.enums import Api, Convention, Space
from nmatrix.errors import NoAnswerError
from nmatrix.lessons.check.answer import Answer
from nmatrix.lessons.check.judge import Judge, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import LightPart, Question, Subject
from nmatrix.linear.axes import AxisChange, axis_system
from nmatrix.linear.projection import clip_space
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.viewport import Viewport
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

PAGE = Path(__file__).resolve().parents[1] / "docs" / "mistakes.md"
SCENES = 100
LAST_PLACE = Fraction(1, 10**6)
SYSTEMS = ("blender", "opengl", "unity", "unreal", "opencv", "ros")
ALSO = "also: "
LIST = "| id | what was done | see |\n|---|---|---|\n"
COUNTED = (
    "| made | times | named first | beside | which is first then |\n|---|---:|---:|---:|---|\n"
)


def scene(draw: random.Random) -> Setup:
    """Return a scene without coincidences, of every way to give a place, a camera and a lens."""

    def three(low: float, high: float) -> tuple[float, ...]:
        return tuple(round(draw.uniform(low, high), 2) for _ in range(3))

    scale = tuple(draw.choice((1, 1, 1, -1)) * one for one in three(0.3, 3))
    place, shear = three(-5, 5), draw.choice(((0, 0, 0), three(-1, 1)))
    turned = draw.choice(("angles", "quaternion", "polimi"))
    if turned == "quaternion":
        world = World(place, quaternion=(*three(-1, 1), 0.7), scale=scale, shear=shear)
    else:
        convention = Convention.STANDARD if turned == "angles" else draw.choice(list(Convention))
        world = World(place, three(-80, 80), scale=scale, shear=shear, convention=convention)
    view = View(three(6, 9), three(-2, 2))
    clip = clip_space(draw.choice(list(Api)).value, "camera")
    if draw.random() < 0.4:
        view = View(three(6, 9), angles=FirstPerson(*three(-60, 60)))
    lens = Lens(draw.uniform(35, 85), draw.choice((1.37, 0.71, 1.9)), 0.3, 40, clip=clip)
    light = Light(three(-3, 3), position=three(-5, 5))
    return Setup(world, view, lens, light)


def questions(setup: Setup, draw: random.Random) -> Iterator[Question]:
    """Ask for everything in a scene, in the spaces in which it differs."""
    n = tuple(round(draw.uniform(-2, 2), 2) for _ in range(3))
    for subject in (Subject.WORLD, Subject.VIEW, Subject.PROJECTION):
        yield Question(subject, setup)
    space = draw.choice((Space.WORLD, Space.CAMERA))
    yield Question(Subject.NORMAL, setup, space)
    yield Question(Subject.NORMAL, setup, space, normal=n, unit=draw.random() < 0.5)
    space = draw.choice((Space.CAMERA, Space.OBJECT))
    yield Question(Subject.EYE, setup, space)
    for part in LightPart:
        yield Question(Subject.LIGHT, setup, space, light=part)
    window = draw.choice((None, Viewport(640, 480)))
    yield Question(Subject.TRACE, setup, point=n, window=window)
    axes = AxisChange(*map(axis_system, draw.sample(SYSTEMS, 2)))
    yield Question(Subject.AXES, setup, axes=axes)


def confusion(scenes: range) -> dict[MistakeId, Counter[str]]:
    """Count for each mistake what it is called first; where it stands in `also`, as "also: ID".

    One variant of it is made in each question. What is right to six decimals is not counted: the
    eye in camera space is at the origin whatever is done to the object.
    """
    found: dict[MistakeId, Counter[str]] = {one: Counter() for one in MISTAKES}
    for seed in scenes:
        draw = random.Random(seed)
        for question in questions(scene(draw), draw):
            judge = Judge(question)
            try:
                _ = judge.right
            except NoAnswerError:
                continue  # a vertex behind the eye
            for mistake in MISTAKES:
                wrong = judge.wrong_by(mistake)
                if not wrong:
                    continue
                judged = judge.judge(typed(draw.choice(wrong)))
                if judged.verdict is not Outcome.CORRECT:
                    beside = ALSO if mistake.value in judged.also else ""
                    found[mistake][beside + (judged.mistake or judged.verdict)] += 1
    return found


def typed(value: RationalMatrix) -> Answer:
    """Return the numbers as they are typed with six decimals."""
    rows = tuple(tuple(round(entry, 6) for entry in row) for row in value)
    return Answer(rows, tuple(tuple(LAST_PLACE for _ in row) for row in rows))


def listed() -> str:
    """Return the list of the mistakes: what was done, and the command to see."""
    return "".join(
        f"| `{one}` | {told.did} | `{told.command}` |\n" for one, told in MISTAKES.items()
    )


def counted(found: dict[MistakeId, Counter[str]]) -> str:
    """Return the matrix of confusion, of which only what is not 0 is written."""
    return "".join(_row(one, counts) for one, counts in found.items())


def _row(made: MistakeId, counts: Counter[str]) -> str:
    others = sorted(name.removeprefix(ALSO) for name in counts if name.startswith(ALSO))
    beside = {one: counts[ALSO + one] for one in others}
    named = ", ".join(f"`{one}` {count}" for one, count in beside.items())
    numbers = f"{counts.total()} | {counts[made]} | {sum(beside.values())}"
    return f"| `{made}` | {numbers} | {named or '─'} |\n"


def page(text: str, found: dict[MistakeId, Counter[str]]) -> str:
    """Return the page with both tables made anew."""
    for head, rows in ((LIST, listed()), (COUNTED, counted(found))):
        before, _, after = text.partition(head)
        text = before + head + rows + after[after.index("\n\n") + 1 :]
    return text


if __name__ == "__main__":
    PAGE.write_text(
        page(PAGE.read_text(encoding="utf-8"), confusion(range(SCENES))), encoding="utf-8"
    )
