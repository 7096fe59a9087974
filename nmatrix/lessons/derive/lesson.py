"""`derive`: choose lessons, put the user's own matrix in, and write the report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from fractions import Fraction

from nmatrix.lessons.derive import (
    derivations,
    examples,
    lighting,
    mirrors_and_flattening,
    reflecting,
)
from nmatrix.lessons.derive.cases import TITLES, chosen
from nmatrix.lessons.derive.users_matrix import users_matrix
from nmatrix.lessons.map_sentences import transform_remarks, verdict
from nmatrix.linear.classify import classify
from nmatrix.report import Block, Heading, Report, Step, Value, Verdict
from nmatrix.scene.world import World

SYMBOLIC = Fraction(1, 10**30)  # sines come in 130 bits here; what they miss by, surds do not
Lesson = Callable[[], tuple[list[Step], str]]

LESSONS: dict[str, Lesson] = {
    "rule": derivations.rule,
    "cofactor": derivations.cofactor,
    "translation": derivations.translation,
    "rotation": examples.rotation,
    "uniform": examples.uniform,
    "nonuniform": examples.nonuniform,
    "shear": examples.shear,
    "mirror": mirrors_and_flattening.mirror,
    "singular": mirrors_and_flattening.singular,
    "lightdirection": lighting.lightdirection,
    "eye": lighting.eye,
    "metric": lighting.metric,
    "reflection": reflecting.reflection,
}


def derive(case: str, world: World | None = None) -> Report:
    """Prove every step of the lessons that a word stands for.

    With a world, its own matrix follows the first lesson in exact numbers: fractions stay
    fractions, and 30° gives √3/2. What holds for it is said apart from what the lesson shows.

    Raises
    ------
    IllegalValueError
        If no case has this name.

    Examples
    --------
    >>> found = derive("mirror")
    >>> all(step.verified for step in found.data["cases"][0]["steps"])
    True
    """
    lessons = [_lesson(name, world if i == 0 else None) for i, name in enumerate(chosen(case))]
    return Report(
        "derive",
        {"cases": [one.data for one in lessons]},
        tuple(block for one in lessons for block in one.blocks),
        tuple(remark for one in lessons for remark in one.remarks),
    )


def _lesson(name: str, world: World | None) -> Report:
    """Teach a lesson; after its conclusion the user's own matrix, with a conclusion of its own."""
    steps, conclusion = LESSONS[name]()
    blocks: tuple[Block, ...] = (Heading(TITLES[name]), *steps, Verdict(conclusion))
    data: dict[str, Value] = {
        "case": name,
        "title": TITLES[name],
        "steps": steps,
        "conclusion": conclusion,
    }
    if world is None:
        return Report("derive", data, blocks)
    own = users_matrix(world)
    kind = replace(classify(world.exact, SYMBOLIC), kind_exact=True)
    told = verdict(kind)
    return Report(
        "derive",
        {**data, "steps": [*steps, *own], "own_conclusion": told},
        (*blocks, Heading("Your matrix"), *own, Verdict(told)),
        (*world.remarks, *transform_remarks(kind)),
    )
