"""What each space teaches: its table, its advantages, its price, and where it is used.

M is the world matrix, V the view matrix, S `space_from_world`.
"""

from __future__ import annotations

from dataclasses import dataclass

from nmatrix.enums import Space


@dataclass(frozen=True)
class Row:
    """One line of the table: a piece of data and what must happen to it in this space."""

    data: str
    usually_in: str
    transform: bool
    by: str
    where: str


@dataclass(frozen=True)
class Lesson:
    """A space in words."""

    pros: tuple[str, ...]
    cons: tuple[str, ...]
    used: str


VERTEX, CPU_SCENE, CPU_OBJECT, NOWHERE = (
    "vertex shader",
    "CPU, once per scene",
    "CPU, once per object",
    "nowhere",
)
UNMOVED = "—"

_RULES: dict[Space, tuple[str, str, str, str, str, str]] = {
    # position, normal and tangent, light direction, light position, eye, place of the lights
    Space.WORLD: ("M", "M⁻ᵀ (3×3)", "", "", "", NOWHERE),
    Space.CAMERA: ("V·M", "(V·M)⁻ᵀ (3×3)", "V (3×3)", "V", "it is the origin", CPU_SCENE),
    Space.OBJECT: ("", "", "M⁻¹ (3×3)", "M⁻¹", "M⁻¹", CPU_OBJECT),
    Space.STATIC: ("", "", "", "", "", NOWHERE),
    Space.LIGHT: ("S·M", "(S·M)⁻ᵀ (3×3)", "S (3×3)", "S", "S", CPU_SCENE),
    Space.CUSTOM: ("S·M", "(S·M)⁻ᵀ (3×3)", "S (3×3)", "S", "S", CPU_SCENE),
}

LESSONS: dict[Space, Lesson] = {
    Space.WORLD: Lesson(
        (
            "lights and the eye are used as they are",
            "lengths and angles are true: no metric",
            "easy to follow, since everything is where the scene file says",
        ),
        (
            "positions and normals of every vertex are transformed",
            "far from the origin float32 positions get coarse",
        ),
        "scenes with many lights, environment maps, most engines' default",
    ),
    Space.CAMERA: Lesson(
        (
            "the eye is the origin: the vector to it is −p normalised",
            "coordinates near the viewer are small, so float32 is at its best",
        ),
        (
            "lights must be moved by V (not by V·M) whenever the camera moves",
            "less intuitive than world space",
        ),
        "classic OpenGL lighting, deferred shading, flashlights held by the viewer",
    ),
    Space.OBJECT: Lesson(
        (
            "vertices and normals are used as they are: it pays for many vertices",
            "light and eye are transformed once per object",
        ),
        (
            "a different light for every object",
            "under a non-uniform scale or a shear lengths and angles are distorted: the metric "
            "costs two 3×3 matrices per object and work per fragment",
            "a singular world matrix has no object space to go back to",
        ),
        "single detailed objects under a few directional lights, tangent-space bump mapping",
    ),
    Space.STATIC: Lesson(
        ("nothing is transformed: the cheapest of all", "light and eye are used as they are"),
        ("objects cannot move; a world matrix is baked into the mesh once",),
        "medical and scientific visualisation, fixed backgrounds of virtual reality",
    ),
    Space.LIGHT: Lesson(
        ("what the light sees: depth in this space is a shadow map",),
        ("one space per light", "everything is transformed for each light"),
        "shadow maps, light shafts, projected textures",
    ),
    Space.CUSTOM: Lesson(
        ("any invertible matrix: texture space, a room, a vehicle, a planet's surface",),
        ("if the matrix is not rigid, lengths and angles need the metric",),
        "large worlds with local origins, lighting baked per room",
    ),
}


def table(space: Space) -> tuple[Row, ...]:
    """Return the table of a space: data, where it usually is, whether and by what it moves.

    Examples
    --------
    >>> [row.data for row in table(Space.WORLD) if row.transform]
    ['vertex position', 'vertex normal', 'tangent and bitangent']
    """
    position, normal, direction, light_position, eye, lights = _RULES[space]
    home = "world" if space is Space.STATIC else "object"
    tangent = f"{position} (3×3)" if position else ""
    return (
        _row("vertex position", home, position, VERTEX),
        _row("vertex normal", home, normal, VERTEX),
        _row("tangent and bitangent", home, tangent, VERTEX),
        _row("light direction", "world", direction, lights),
        _row("light position", "world", light_position, lights),
        _eye_row(space, eye, lights),
    )


def _row(data: str, usually_in: str, by: str, where: str) -> Row:
    if not by:
        return Row(data, usually_in, transform=False, by=UNMOVED, where=NOWHERE)
    return Row(data, usually_in, transform=True, by=by, where=where)


def _eye_row(space: Space, by: str, where: str) -> Row:
    if space is Space.CAMERA:
        return Row("eye position", "world", transform=False, by=by, where=NOWHERE)
    return _row("eye position", "world", by, where)
