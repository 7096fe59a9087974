"""What a handout may hold: each topic gives the blocks that a terminal shows, and its pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from enum import StrEnum
from fractions import Fraction

from nmatrix.enums import Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Cells, Figure, Heading, Quantity, Table, Text, Verdict
from nmatrix.scene.setup import Setup
from nmatrix.spaces.shading_spaces import PROFILES, UNMOVED, USUAL_SPACES


class Topic(StrEnum):
    """The topics of a handout, in the order in which they are printed."""

    RULE = "rule"
    WORKED = "worked"
    SPACES = "spaces"
    PROOFS = "proofs"
    PITFALLS = "pitfalls"
    COST = "cost"
    EXERCISES = "exercises"


USUAL = (Topic.RULE, Topic.WORKED, Topic.SPACES, Topic.PROOFS, Topic.PITFALLS)
PROOF_SIZE = (220, 220)
TOLD = {
    "normals": "Three pictures of a stretched sphere: lit by normals that A itself carried, lit by "
    "those of the inverse transpose, and a map of the angle between the two.",
    "mirror": "Three pictures of a mirrored object: by cofactors without the sign, by the inverse "
    "transpose, and with the winding of its triangles left as it was.",
}


@dataclass(frozen=True)
class Part:
    """One topic on paper: its blocks, and the PNG files that they name."""

    blocks: tuple[Block, ...]
    pictures: Mapping[str, bytes] = field(default_factory=dict)


def _rule(setup: Setup) -> Part:
    from nmatrix.lessons.derive.lesson import derive

    return Part(derive("rule").blocks)


def _worked(setup: Setup) -> Part:
    """Show the matrices of the given scene, and its light and eye in each space."""
    from nmatrix.answers.view import view
    from nmatrix.answers.world import world

    placed = world(setup).blocks
    matrices = [one for one in placed if _is(one, "world_from_object") or _is(one, "normal_matrix")]
    matrices += [one for one in view(setup).blocks if _is(one, "camera_from_world")]
    verdicts = [one for one in placed if isinstance(one, Verdict)]
    return Part((Heading("In numbers"), *matrices, *verdicts, _seen(setup)))


def _in_each(spaces: Iterable[Space], row: Callable[[Space], Cells]) -> tuple[Cells, ...]:
    """Make a row for each space that there is: a flattened world has no object space."""
    rows = []
    for space in spaces:
        with suppress(NoAnswerError):
            rows.append(row(space))
    return tuple(rows)


def _is(block: Block, key: str) -> bool:
    return isinstance(block, Quantity) and block.key == key


def _seen(setup: Setup) -> Table:
    """Tabulate the light and the eye in each space that there is."""
    from nmatrix.spaces.light_and_eye import light_in

    def row(space: Space) -> Cells:
        light, eye = light_in(setup.maps, space), setup.maps.eye_in(space)
        return space.value, _short(light.direction), _short(light.position), _short(eye)

    columns = ("space", "light direction", "light position", "eye")
    return Table(columns, _in_each(USUAL_SPACES[:3], row), "The light and the eye, moved")


def _short(vector: Sequence[float | Fraction] | None) -> str:
    if vector is None:
        return "none"
    numbers = (short_text(Fraction(x), 4).replace("-", "−") for x in vector)
    return f"({', '.join(numbers)})"


def _spaces(setup: Setup) -> Part:
    """Tabulate for each space what must be moved, by what."""
    blocks: list[Block] = [Heading("What each shading space moves")]
    is_flattened = setup.maps.world_from_object.linear_map.rank < 3
    for space in USUAL_SPACES:
        profile = PROFILES[space]
        moves = ((row.data, row.by) for row in profile.table(is_flattened=is_flattened))
        rows = tuple((data, "as it is" if by == UNMOVED else by) for data, by in moves)
        blocks += [
            Table(("data", "moves by"), rows, f"{space.value[:1].upper()}{space.value[1:]} space")
        ]
        blocks += [Text(f"For it: {profile.pros[0]}. Against it: {profile.cons[0]}.")]
    return Part(tuple(blocks))


def _proofs(setup: Setup) -> Part:
    """Draw two proof images with their numbers in the alternative text."""
    from dataclasses import replace

    from nmatrix.raster.proofs.mirror import mirror
    from nmatrix.raster.proofs.proof import ProofSettings
    from nmatrix.raster.proofs.rules import normals
    from nmatrix.scene.scene import Settings

    settings = ProofSettings("normals", picture=replace(Settings(), size=PROOF_SIZE))
    blocks: list[Block] = [Heading("Seen")]
    pictures = {}
    for name, draw in (("normals", normals), ("mirror", mirror)):
        proof = draw(replace(settings, subject=name))
        pictures[f"{name}.png"] = proof.png()
        blocks.append(Figure(f"{name}.png", f"{TOLD[name]} {proof.verdict}", proof.verdict))
    return Part(tuple(blocks), pictures)


def _pitfalls(setup: Setup) -> Part:
    from nmatrix.classroom.pitfalls import PITFALLS

    rows = tuple((one.id, one.claim, one.verdict) for one in PITFALLS)
    return Part(
        (Heading("What is often said, and what is true"), Table(("", "said", "true"), rows))
    )


def _cost(setup: Setup) -> Part:
    """Count the work; a time would be another one tomorrow."""
    from nmatrix.shaders.cost import cost
    from nmatrix.shaders.sheet import Request

    def row(space: Space) -> Cells:
        found = cost(setup.maps, Request(space))
        return (
            space.value,
            found.per_vertex_multiplications,
            found.per_fragment_multiplications,
            found.per_object_multiplications,
            found.uniform_bytes,
        )

    columns = ("space", "a vertex", "a fragment", "an object", "bytes of uniforms")
    return Part(
        (
            Heading("What it costs"),
            Text("Multiplications for light with a highlight, counted where they happen."),
            Table(columns, _in_each(USUAL_SPACES, row)),
            Text(
                "For one matrix exact whole numbers take less than twice the time of a float64 "
                "inverse. What is visible in a picture are normals that are zero, not a number, "
                "flipped or skewed; the last digits of a good one are not."
            ),
        )
    )


# Exercises belong to a student and are not made here.
PARTS: dict[Topic, Callable[[Setup], Part]] = {
    Topic.RULE: _rule,
    Topic.WORKED: _worked,
    Topic.SPACES: _spaces,
    Topic.PROOFS: _proofs,
    Topic.PITFALLS: _pitfalls,
    Topic.COST: _cost,
}
