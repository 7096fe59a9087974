"""`derive`: choose lessons, put the user's own matrix in, and write the report."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction

from nmatrix.enums import Numbers
from nmatrix.errors import IllegalValueError, did_you_mean
from nmatrix.lessons.derive import derivations, kinds_of_maps, lighting
from nmatrix.lessons.derive.users_matrix import users_matrix
from nmatrix.lessons.map_sentences import transform_remarks, verdict
from nmatrix.linear.classify import classify
from nmatrix.report import Block, Heading, Report, Step, Value, Verdict
from nmatrix.scene.world import World

SYMBOLIC = Fraction(1, 10**30)  # sines come in 130 bits here; what they miss by, surds do not
ALL = "all"


@dataclass(frozen=True)
class Lesson:
    """A title, and what proves it: steps and a conclusion."""

    title: str
    prove: Callable[[], tuple[list[Step], str]]


LESSONS = {
    "rule": Lesson("Why normals move by the inverse transpose", derivations.rule),
    "cofactor": Lesson("The cofactor matrix, and the sign that it lacks", derivations.cofactor),
    "translation": Lesson("What a translation does to normals", derivations.translation),
    "rotation": Lesson("A rotation is its own inverse transpose", kinds_of_maps.rotation),
    "uniform": Lesson("A uniform scale changes lengths only", kinds_of_maps.uniform),
    "nonuniform": Lesson("A non-uniform scale bends normals", kinds_of_maps.nonuniform),
    "shear": Lesson("A shear has determinant 1 and bends normals", kinds_of_maps.shear),
    "mirror": Lesson("A mirror, its determinant and the outward side", kinds_of_maps.mirror),
    "singular": Lesson("What is left when space is flattened", kinds_of_maps.singular),
    "lightdirection": Lesson(
        "A light direction is a vector, not a normal", lighting.lightdirection
    ),
    "eye": Lesson("Where the eye is in object space", lighting.eye),
    "metric": Lesson("Lengths and angles in a space that is not rigid", lighting.metric),
    "reflection": Lesson(
        "Mirrored light, the half vector, and the gate on n · l", lighting.reflection
    ),
}


def chosen(case: str) -> tuple[str, ...]:
    """Choose the cases that a word stands for.

    Raises
    ------
    IllegalValueError
        If no case has this name.

    Examples
    --------
    >>> chosen("mirror")
    ('mirror',)
    """
    if case == ALL:
        return tuple(LESSONS)
    if case in LESSONS:
        return (case,)
    raise IllegalValueError(
        f"case ({case[:40]})",
        f"the cases are {', '.join(LESSONS)}, all",
        did_you_mean(case.lower(), (*LESSONS, ALL), "try nmatrix derive rule"),
    )


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
        numbers=Numbers.EXACT,
    )


def _lesson(name: str, world: World | None) -> Report:
    """Teach a lesson; after its conclusion the user's own matrix, with a conclusion of its own."""
    lesson = LESSONS[name]
    steps, conclusion = lesson.prove()
    blocks: tuple[Block, ...] = (Heading(lesson.title), *steps, Verdict(conclusion))
    data: dict[str, Value] = {
        "case": name,
        "title": lesson.title,
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
