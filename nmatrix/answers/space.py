"""`nmatrix space`: the whole sheet of one shading space, and its shaders."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict

from nmatrix.enums import Space
from nmatrix.linear import rational
from nmatrix.linear.projection import front_sign
from nmatrix.report import (
    Block,
    Brief,
    Code,
    Heading,
    Matrix,
    Quantity,
    Report,
    Table,
    Text,
    Value,
    Vector,
    Verdict,
)
from nmatrix.scene.setup import Setup
from nmatrix.shaders.cost import Cost, cost
from nmatrix.shaders.shaded import FrontFace
from nmatrix.shaders.sheet import Request, program_of
from nmatrix.spaces.light_and_eye import light_in
from nmatrix.spaces.shading_spaces import PROFILES, Row, SpaceProfile

SHEET = 60  # lines of the short sheet
SHADERS = ("the other matrices", "the metric", "both shaders and their uniforms (-f glsl too)")


def space(setup: Setup, request: Request) -> Report:
    """Answer with the transforms, uniforms, cost and shaders of a shading space.

    Examples
    --------
    >>> found = space(Setup(), Request(Space.CAMERA))
    >>> [float(x) for x in found.data["eye"]], found.data["metric"]
    ([0.0, 0.0, 0.0], None)
    """
    maps, chosen = setup.maps, request.space
    front_face = FrontFace.of_sign(front_sign(maps.clip_from_object, setup.lens.clip))
    shown = program_of(maps, request, front_face)
    quantities = _quantities(setup, chosen)
    profile, counted = PROFILES[chosen], cost(maps, request)
    rows = profile.table(is_flattened=maps.world_from_object.linear_map.rank < 3)
    data: dict[str, Value] = {
        "space": chosen.value,
        **quantities,
        "table": [asdict(row) for row in rows],
        "uniforms": {one.key: one.value for one in shown.uniforms},
        "cost": asdict(counted),
        "pros": list(profile.pros),
        "cons": list(profile.cons),
        "used": profile.used,
        "vertex_shader": shown.vertex_shader,
        "fragment_shader": shown.fragment_shader,
    }
    blocks: tuple[Block, ...] = (
        Heading(f"Shading in {chosen} space"),
        _table(rows),
        *(Quantity(key, value, _TITLES[key]) for key, value in quantities.items()),
        _cost_table(counted),
        *(Text(f"+ {pro}") for pro in profile.pros),
        *(Text(f"− {con}") for con in profile.cons),
        Text(f"Used in: {profile.used}."),
        Heading("Uniforms"),
        *(
            Quantity(f"uniforms.{one.key}", one.value, f"{one.kind} {one.name}")
            for one in shown.uniforms
        ),
        Code("glsl", shown.vertex_shader, "vertex shader"),
        Code("glsl", shown.fragment_shader, "fragment shader"),
        Verdict(_verdict(chosen, rigid=maps.is_rigid(chosen))),
    )
    remarks = (*setup.remarks, *_remarks(setup, chosen, front_face))
    brief = Brief(tuple(_brief(blocks, profile)), SHADERS, SHEET)
    return Report("space", data, blocks, remarks, brief=brief)


def _brief(blocks: tuple[Block, ...], profile: SpaceProfile) -> Iterator[Block]:
    """Show the verdict, what is transformed, by which matrices, and at what price."""
    yield blocks[-1]
    shown = ("normal_matrix", "clip_from_object", "light_direction", "light_position", "eye")
    for one in blocks:
        if isinstance(one, Table) or (isinstance(one, Quantity) and one.key in shown):
            yield one
    told = (*(f"+ {pro}" for pro in profile.pros), *(f"− {con}" for con in profile.cons))
    yield Text("\n".join(told))
    yield Text(f"Used in: {profile.used}.")


def _quantities(setup: Setup, chosen: Space) -> dict[str, Vector | Matrix | None]:
    """Compute every matrix and vector of the sheet, under its key."""
    maps = setup.maps
    seen = light_in(maps, chosen)
    moved = maps.space_from_object(chosen)
    return {
        "space_from_world": maps.space_from_world(chosen).exact,
        "space_from_object": moved.exact,
        "normal_matrix": moved.linear_map.normal_matrix,
        "clip_from_object": maps.clip_from_object,
        "light_direction": seen.direction,
        "light_position": seen.position,
        "eye": maps.eye_in(chosen),
        "metric": maps.metric(chosen),
    }


_TITLES = {
    "space_from_world": "S, space from world",
    "space_from_object": "S·M, space from object",
    "normal_matrix": "normal matrix (S·M)⁻ᵀ",
    "clip_from_object": "P·V·M, clip from object",
    "light_direction": "light direction (unit)",
    "light_position": "light position",
    "eye": "eye",
    "metric": "metric of vectors",
}


def _table(rows: tuple[Row, ...]) -> Table:
    return Table(
        ("data", "usually in", "transform", "by", "where"),
        tuple(
            (row.data, row.usually_in, "yes" if row.transform else "no", row.by, row.where)
            for row in rows
        ),
    )


def _cost_table(counted: Cost) -> Table:
    return Table(
        ("multiplications", "count"),
        (
            ("per fragment", counted.per_fragment_multiplications),
            ("per vertex", counted.per_vertex_multiplications),
            ("per object", counted.per_object_multiplications),
            ("per scene", counted.per_scene_multiplications),
            ("uniform bytes", counted.uniform_bytes),
        ),
        "Cost",
    )


def _verdict(chosen: Space, *, rigid: bool) -> str:
    if rigid:
        return f"{chosen} space is rigid here: lengths and angles are true, no metric is needed."
    return (
        f"{chosen} space is not rigid here: measure vectors by B⁻¹ and normals by Bᵀ, and the "
        "picture is the same as in world space."
    )


def _remarks(setup: Setup, chosen: Space, front_face: FrontFace) -> tuple[str, ...]:
    remarks = []
    if front_face is FrontFace.CW:
        remarks.append(
            "A mirror lies between the object and the picture, so front faces run clockwise: "
            "glFrontFace(GL_CW)."
        )
    moved = setup.maps.world_from_object.exact != rational.identity(4)
    if chosen is Space.STATIC and moved:
        remarks.append(
            "Static space stands still: the world matrix given here is baked into the mesh once, "
            "positions by M and normals by M⁻ᵀ; afterwards nothing is transformed."
        )
    if chosen is Space.CAMERA:
        remarks.append("The vector to the eye is −p normalised: from the point to the origin.")
    if chosen is Space.OBJECT and not setup.maps.is_rigid(chosen):
        remarks.append(
            "The usual cost argument for object space leaves the metric out: two 3×3 matrices per "
            "object and work per fragment."
        )
    return tuple(remarks)
