"""`nmatrix light` and `nmatrix eye`: the light and the eye as one space, or four, see them."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

from nmatrix.enums import Space
from nmatrix.linear.rational import identity
from nmatrix.report import Block, Heading, Quantity, Report, Text, Value, Verdict
from nmatrix.scene.setup import Setup
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.light_and_eye import EyeSeen, LightInSpace, eye_in, light_in

Seen = TypeVar("Seen", LightInSpace, EyeSeen)

USUAL = (Space.WORLD, Space.CAMERA, Space.OBJECT, Space.STATIC)


def light(setup: Setup, space: Space | None) -> Report:
    """Answer with the light in one space, or in the four usual ones.

    Examples
    --------
    >>> light(Setup(), Space.WORLD).data["rules_differ_deg"]
    0.0
    """
    if space is not None:
        seen = light_in(setup.maps, space)
        return Report("light", _light_data(seen), _light_blocks(seen), _light_remarks(setup, seen))
    entries = _in_each(setup, light_in)
    blocks = [block for i, one in enumerate(entries) for block in _one_of_four(one, i)]
    remarks = list(setup.remarks)
    for one in entries:
        if one is None:
            remarks.append(_NO_OBJECT_SPACE)
        else:
            remarks += [text for text in _light_remarks(setup, one) if text not in remarks]
    data: dict[str, Value] = {
        "spaces": [None if one is None else _light_data(one) for one in entries]
    }
    return Report("light", data, tuple(blocks), tuple(remarks))


def eye(setup: Setup, space: Space | None) -> Report:
    """Answer with the eye in one space, or in the four usual ones.

    Examples
    --------
    >>> [float(x) for x in eye(Setup(), Space.CAMERA).data["eye"]]
    [0.0, 0.0, 0.0]
    """
    if space is not None:
        seen = eye_in(setup.maps, space)
        return Report(
            "eye", _eye_data(seen), tuple(_eye_blocks(seen)), _eye_remarks(setup, (seen,))
        )
    entries = _in_each(setup, eye_in)
    blocks: list[Block] = []
    for i, one in enumerate(entries):
        blocks += _eye_blocks(one, f"spaces.{i}.") if one else [Text(_NO_OBJECT_SPACE)]
    remarks = _eye_remarks(setup, tuple(one for one in entries if one))
    if None in entries:
        remarks = (*remarks, _NO_OBJECT_SPACE)
    data: dict[str, Value] = {
        "spaces": [None if one is None else _eye_data(one) for one in entries]
    }
    return Report("eye", data, tuple(blocks), remarks)


_NO_OBJECT_SPACE = (
    "The world matrix is singular: it has no inverse, so there is no way back to object space."
)


def _in_each(setup: Setup, see: Callable[[ExactMaps, Space], Seen]) -> list[Seen | None]:
    """See the light or the eye from each usual space; None for object space of a singular world."""
    singular = setup.placed_world.linear_map.rank < 3
    return [
        None if singular and space is Space.OBJECT else see(setup.maps, space) for space in USUAL
    ]


def _light_data(seen: LightInSpace) -> dict[str, Value]:
    return {
        "space": seen.space.value,
        "space_from_world": seen.space_from_world,
        "direction": seen.direction,
        "direction_unnormalised": seen.direction_unnormalised,
        "direction_course_rule": seen.direction_course_rule,
        "rules_differ_deg": seen.rules_differ_deg,
        "position": seen.position,
    }


def _one_of_four(seen: LightInSpace | None, index: int) -> tuple[Block, ...]:
    if seen is None:
        return (Text(_NO_OBJECT_SPACE),)
    return _light_blocks(seen, f"spaces.{index}.")


def _light_blocks(seen: LightInSpace, prefix: str = "") -> tuple[Block, ...]:
    blocks: list[Block] = [
        Heading(f"Light in {seen.space} space"),
        Quantity(f"{prefix}space_from_world", seen.space_from_world, f"{seen.space} from world"),
    ]
    if seen.direction is not None:
        blocks += [
            Quantity(f"{prefix}direction", seen.direction, "direction (unit)"),
            Quantity(
                f"{prefix}direction_unnormalised",
                seen.direction_unnormalised,
                "direction, not normalised",
            ),
            Quantity(
                f"{prefix}direction_course_rule",
                seen.direction_course_rule,
                "direction by the course's rule",
            ),
            Quantity(f"{prefix}rules_differ_deg", seen.rules_differ_deg, "they differ by", "°"),
        ]
    if seen.position is not None:
        blocks.append(Quantity(f"{prefix}position", seen.position, "position"))
    blocks.append(Verdict(_light_verdict(seen)))
    return tuple(blocks)


def _light_verdict(seen: LightInSpace) -> str:
    if seen.rules_differ_deg is None:
        return "A position is a point: it moves by the whole 4×4 matrix, w = 1."
    if seen.rules_differ_deg < 1e-6:
        return "Here the course's rule (inverse transpose) gives the same direction."
    return (
        f"The course's rule is {seen.rules_differ_deg:.4g}° off here: a light direction is a "
        "vector and moves by the 3×3 block itself."
    )


def _light_remarks(setup: Setup, seen: LightInSpace) -> tuple[str, ...]:
    remarks = list(setup.remarks)
    if seen.space is Space.CAMERA:
        remarks.append("A lamp fixed in the world moves by V only, never by V·M.")
    if seen.direction is not None and not setup.maps.is_rigid(seen.space):
        remarks.append(
            f"{seen.space} space is not rigid here: the unit direction alone gives a wrong shade; "
            "Lambert's cosine is n·l / (|Bᵀn| · |B⁻¹l|), the metric of `nmatrix space "
            f"{seen.space}`."
        )
    if seen.space is Space.STATIC and setup.placed_world.exact != identity(4):
        remarks.append("Static space: the mesh is baked into the world once, by M.")
    return tuple(remarks)


def _eye_data(seen: EyeSeen) -> dict[str, Value]:
    return {
        "space": seen.space.value,
        "eye": seen.eye,
        "eye_by_inverse_mv": seen.eye_by_inverse_mv,
        "relative_difference": seen.relative_difference,
    }


def _eye_blocks(seen: EyeSeen, prefix: str = "") -> list[Block]:
    return [
        Heading(f"Eye in {seen.space} space"),
        Quantity(f"{prefix}eye", seen.eye, "eye"),
        Quantity(
            f"{prefix}eye_by_inverse_mv",
            seen.eye_by_inverse_mv,
            "course's (MV)⁻¹, float64",
        ),
        Quantity(f"{prefix}relative_difference", seen.relative_difference, "relative difference"),
    ]


def _eye_remarks(setup: Setup, entries: tuple[EyeSeen, ...]) -> tuple[str, ...]:
    worst = max((one.relative_difference or 0.0 for one in entries), default=0.0)
    if worst < 1e-9:
        return setup.remarks
    return (
        *setup.remarks,
        f"The course's formula is {worst:.2g} off (relative): it adds and takes away a large "
        "translation. Subtract first, then solve A x = eye − t.",
    )
