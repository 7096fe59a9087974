"""The shading spaces: what is transformed for each, and what each teaches.

M is the world matrix, V the view matrix, S `space_from_world`. How S is computed stands in
`exact_maps`; everything else about a space follows from its profile here.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from enum import StrEnum

from nmatrix.enums import Space, chosen


class Place(StrEnum):
    """Where a transform is carried out, and so how often."""

    VERTEX = "vertex shader"
    SCENE = "CPU, once per scene"
    OBJECT = "CPU, once per object"
    NOWHERE = "nowhere"


@dataclass(frozen=True)
class Row:
    """One line of the table: a piece of data and what must happen to it in this space."""

    data: str
    usually_in: str
    transform: bool
    by: str
    where: str


@dataclass(frozen=True)
class SpaceProfile:
    """A space in symbols and in words.

    Parameters
    ----------
    symbol
        S in formulas; empty where S is the identity.
    lights_moved
        Where lights and the eye are brought into the space.
    pros, cons, used
        What speaks for the space and against it, and where it is used.
    vertices_in
        The space that a mesh is stored in; where it is this one, no vertex is transformed.
    eye_is_origin
        True if the eye has the coordinates 0 0 0 by definition.
    is_usual
        True if it takes neither a matrix of its own nor a direction of the light.
    synonyms
        Other names of the space.
    """

    space: Space
    symbol: str
    lights_moved: Place
    pros: tuple[str, ...]
    cons: tuple[str, ...]
    used: str
    vertices_in: Space = Space.OBJECT
    eye_is_origin: bool = False
    is_usual: bool = True
    synonyms: tuple[str, ...] = ()

    @property
    def moves_vertices(self) -> bool:
        """True if positions and normals of every vertex are transformed for the space."""
        return self.vertices_in is not self.space

    @property
    def mesh_space(self) -> str:
        """The space of the vertices in words: a static mesh was baked into the world."""
        return "world" if self.vertices_in is Space.STATIC else self.vertices_in.value

    def table(self, *, is_flattened: bool = False) -> tuple[Row, ...]:
        """List the data of a shader: where each usually is, whether and by what it moves.

        Where M flattens the object only the cofactors still carry normals.

        Examples
        --------
        >>> [row.data for row in PROFILES[Space.WORLD].table() if row.transform]
        ['vertex position', 'vertex normal', 'tangent and bitangent']
        """
        position = normal = ""
        if self.moves_vertices:
            position = f"{self.symbol}·M" if self.symbol else "M"
            normal = f"({position})⁻ᵀ (3×3)" if self.symbol else "M⁻ᵀ (3×3)"
            if is_flattened:
                normal = f"cofactors of {position} (3×3)"
        home, lights = self.mesh_space, self.lights_moved
        eye = _row("eye position", "world", self.symbol, lights)
        if self.eye_is_origin:
            eye = Row(
                "eye position", "world", transform=False, by="it is the origin", where=Place.NOWHERE
            )
        return (
            _row("vertex position", home, position, Place.VERTEX),
            _row("vertex normal", home, normal, Place.VERTEX),
            _row("tangent and bitangent", home, _block(position), Place.VERTEX),
            _row("light direction", "world", _block(self.symbol), lights),
            _row("light position", "world", self.symbol, lights),
            eye,
        )


UNMOVED = "—"


def _block(matrix: str) -> str:
    return f"{matrix} (3×3)" if matrix else ""


def _row(data: str, usually_in: str, by: str, where: Place) -> Row:
    if not by:
        return Row(data, usually_in, transform=False, by=UNMOVED, where=Place.NOWHERE)
    return Row(data, usually_in, transform=True, by=by, where=where)


_ALL = (
    SpaceProfile(
        Space.WORLD,
        symbol="",
        lights_moved=Place.NOWHERE,
        pros=(
            "lights and the eye are used as they are",
            "lengths and angles are true: no metric",
            "easy to follow, since everything is where the scene file says",
        ),
        cons=(
            "positions and normals of every vertex are transformed",
            "far from the origin float32 positions get coarse",
        ),
        used="scenes with many lights, environment maps, most engines' default",
    ),
    SpaceProfile(
        Space.CAMERA,
        symbol="V",
        lights_moved=Place.SCENE,
        pros=(
            "the eye is the origin: the vector to it is −p normalised",
            "coordinates near the viewer are small, so float32 is at its best",
        ),
        cons=(
            "lights must be moved by V (not by V·M) whenever the camera moves",
            "less intuitive than world space",
        ),
        used="classic OpenGL lighting, deferred shading, flashlights held by the viewer",
        eye_is_origin=True,
        synonyms=("view", "eye"),
    ),
    SpaceProfile(
        Space.OBJECT,
        symbol="M⁻¹",
        lights_moved=Place.OBJECT,
        pros=(
            "vertices and normals are used as they are: it pays for many vertices",
            "light and eye are transformed once per object",
        ),
        cons=(
            "a different light for every object",
            "under a non-uniform scale or a shear lengths and angles are distorted: the metric "
            "costs two 3×3 matrices per object and work per fragment",
            "a singular world matrix has no object space to go back to",
        ),
        used="single detailed objects under a few directional lights, tangent-space bump mapping",
        synonyms=("model", "local"),
    ),
    SpaceProfile(
        Space.STATIC,
        symbol="",
        lights_moved=Place.NOWHERE,
        pros=("nothing is transformed: the cheapest of all", "light and eye are used as they are"),
        cons=("objects cannot move; a world matrix is baked into the mesh once",),
        used="medical and scientific visualisation, fixed backgrounds of virtual reality",
        vertices_in=Space.STATIC,
    ),
    SpaceProfile(
        Space.LIGHT,
        symbol="S",
        lights_moved=Place.SCENE,
        pros=("what the light sees: depth in this space is a shadow map",),
        cons=("one space per light", "everything is transformed for each light"),
        used="shadow maps, light shafts, projected textures",
        is_usual=False,
    ),
    SpaceProfile(
        Space.CUSTOM,
        symbol="S",
        lights_moved=Place.SCENE,
        pros=("any invertible matrix: texture space, a room, a vehicle, a planet's surface",),
        cons=("if the matrix is not rigid, lengths and angles need the metric",),
        used="large worlds with local origins, lighting baked per room",
        is_usual=False,
    ),
)

PROFILES: Mapping[Space, SpaceProfile] = {profile.space: profile for profile in _ALL}
USUAL_SPACES = tuple(profile.space for profile in _ALL if profile.is_usual)
SYNONYMS = {name: profile.space for profile in _ALL for name in profile.synonyms}


def space_named(name: object) -> Space:
    """Find the space that a name or a synonym means.

    Raises
    ------
    IllegalValueError
        For any other name; it lists the spaces.

    Examples
    --------
    >>> space_named("view")
    <Space.CAMERA: 'camera'>
    """
    lowered = name.lower() if isinstance(name, str) else ""
    return SYNONYMS.get(lowered) or chosen(Space, lowered or name, "space")
