"""`nmatrix light` and `nmatrix eye`: the light and the eye as one space, or four, see them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields, replace
from typing import TypeVar

from nmatrix.enums import Space
from nmatrix.linear.rational import identity
from nmatrix.report import Block, Brief, Heading, Quantity, Report, Table, Text, Value, Verdict
from nmatrix.scene.setup import Setup
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.light_and_eye import EyeInSpace, LightInSpace, eye_in, light_in
from nmatrix.spaces.shading_spaces import USUAL_SPACES

Seen = TypeVar("Seen", LightInSpace, EyeInSpace)


def light(setup: Setup, space: Space | None) -> Report:
    """Answer with the light in one space, or in the four usual ones.

    Examples
    --------
    >>> light(Setup(), Space.WORLD).data["rules_differ_deg"]
    0.0
    """
    entries = _seen(setup, space, light_in)
    remarks = list(setup.remarks)
    for seen in entries:
        remarks += [_NO_OBJECT_SPACE] if seen is None else _light_remarks(setup, seen)
    found = _report("light", entries, _light_blocks, tuple(dict.fromkeys(remarks)))
    lights = [seen for seen in entries if seen is not None]
    return replace(found, brief=_brief_light(found, lights))


def _brief_light(found: Report, lights: Sequence[LightInSpace]) -> Brief:
    """Show the light of one space, the verdict first, or a row for each."""
    if "spaces" not in found.data:
        *shown, conclusion = (one for one in found.blocks if not isinstance(one, Heading))
        matrix, *numbers = shown
        return Brief((conclusion, *numbers, matrix))
    keys = [key for key in ("direction", "position") if getattr(lights[0], key) is not None]
    columns = ("space", *(f"{key if x == 'x' else ''} {x}".strip() for key in keys for x in "xyz"))
    rows = tuple(
        (one.space.value, *(number for key in keys for number in getattr(one, key)))
        for one in lights
    )
    worst = max(lights, key=lambda one: one.rules_differ_deg or 0.0)
    told = _light_verdict(worst)
    if worst.rules_differ_deg:
        told = told.replace(" here", f" in {worst.space} space", 1)
    return Brief((Verdict(told), Table(columns, rows)), ("the matrices", "each rule's direction"))


def eye(setup: Setup, space: Space | None) -> Report:
    """Answer with the eye in one space, or in the four usual ones.

    Examples
    --------
    >>> [float(x) for x in eye(Setup(), Space.CAMERA).data["eye"]]
    [0.0, 0.0, 0.0]
    """
    entries = _seen(setup, space, eye_in)
    remarks = [*setup.remarks, *_eye_remarks([seen for seen in entries if seen])]
    if None in entries:
        remarks.append(_NO_OBJECT_SPACE)
    found = _report("eye", entries, _eye_blocks, tuple(remarks))
    eyes = [seen for seen in entries if seen is not None]
    return found if "spaces" not in found.data else replace(found, brief=_brief_eye(eyes))


def _brief_eye(eyes: Sequence[EyeInSpace]) -> Brief:
    """Show the eye in each space, a row for each."""
    rows = tuple((one.space.value, *one.eye) for one in eyes)
    return Brief((Table(("space", "eye x", "y", "z"), rows),), ("the course's formula",))


_NO_OBJECT_SPACE = (
    "The world matrix is singular: it has no inverse, so there is no way back to object space."
)


def _seen(
    setup: Setup, space: Space | None, see: Callable[[ExactMaps, Space], Seen]
) -> list[Seen | None]:
    """See from one space, or each usual one; None for object space of a singular world."""
    if space is not None:
        return [see(setup.maps, space)]
    singular = setup.placed_world.linear_map.rank < 3
    return [
        None if singular and one is Space.OBJECT else see(setup.maps, one) for one in USUAL_SPACES
    ]


def _report(
    command: str,
    entries: list[Seen | None],
    blocks: Callable[[Seen, str], list[Block]],
    remarks: tuple[str, ...],
) -> Report:
    """Report one entry by itself, several as a list of `spaces`."""
    only, *others = entries
    if only is not None and not others:
        return Report(command, _data(only), tuple(blocks(only, "")), remarks)
    shown: list[Block] = []
    for i, seen in enumerate(entries):
        shown += [Text(_NO_OBJECT_SPACE)] if seen is None else blocks(seen, f"spaces.{i}.")
    data = {"spaces": [None if seen is None else _data(seen) for seen in entries]}
    return Report(command, data, tuple(shown), remarks)


def _data(seen: LightInSpace | EyeInSpace) -> dict[str, Value]:
    named: dict[str, Value] = {one.name: getattr(seen, one.name) for one in fields(seen)}
    return named | {"space": seen.space.value}


def _light_blocks(seen: LightInSpace, prefix: str) -> list[Block]:
    blocks: list[Block] = [
        Heading(f"Light in {seen.space} space"),
        Quantity(f"{prefix}space_from_world", seen.space_from_world, f"{seen.space} from world"),
    ]
    for key, title in _LIGHT_TITLES.items():
        value = getattr(seen, key)
        if value is not None:
            unit = "°" if key.endswith("_deg") else ""
            blocks.append(Quantity(f"{prefix}{key}", value, title, unit))
    return [*blocks, Verdict(_light_verdict(seen))]


_LIGHT_TITLES = {
    "direction": "direction (unit)",
    "direction_unnormalised": "direction, not normalised",
    "direction_course_rule": "direction by the course's rule",
    "rules_differ_deg": "they differ by",
    "position": "position",
}


def _light_verdict(seen: LightInSpace) -> str:
    if seen.rules_differ_deg is None:
        return "A position is a point: it moves by the whole 4×4 matrix, w = 1."
    if seen.rules_differ_deg < 1e-6:
        return "Here the course's rule (inverse transpose) gives the same direction."
    return (
        f"The course's rule is {seen.rules_differ_deg:.4g}° off here: a light direction is a "
        "vector and moves by the 3×3 block itself."
    )


def _light_remarks(setup: Setup, seen: LightInSpace) -> list[str]:
    remarks = []
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
    return remarks


def _eye_blocks(seen: EyeInSpace, prefix: str) -> list[Block]:
    titles = {
        "eye": "eye",
        "eye_by_inverse_mv": "course's (MV)⁻¹, float64",
        "relative_difference": "relative difference",
    }
    quantities = (
        Quantity(f"{prefix}{key}", getattr(seen, key), title) for key, title in titles.items()
    )
    return [Heading(f"Eye in {seen.space} space"), *quantities]


def _eye_remarks(entries: list[EyeInSpace]) -> list[str]:
    worst = max((one.relative_difference or 0.0 for one in entries), default=0.0)
    if worst < 1e-9:
        return []
    return [
        f"The course's formula is {worst:.2g} off (relative): it adds and takes away a large "
        "translation. Subtract first, then solve A x = eye − t."
    ]
