"""What a shader for one space needs to be told, and which of it this scene calls for.

The names here are the shaders' own: one list serves the sheet, the cost table and the GLSL.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.linear.rounding import integers, unit
from nmatrix.spaces import metric
from nmatrix.spaces.exact_maps import ExactMaps

UniformValue = Fraction | RationalVector | RationalMatrix

SHININESS = Fraction(32)
WHITE: RationalVector = (Fraction(1),) * 3
AMBIENT: RationalVector = (Fraction(1, 10),) * 3
DIFFUSE: RationalVector = (Fraction(4, 5),) * 3
SPECULAR: RationalVector = (Fraction(1, 2),) * 3

BYTES = {"mat4": 64, "mat3": 36, "vec3": 12, "float": 4}


@dataclass(frozen=True)
class Request:
    """Which shader is asked for."""

    space: Space
    shading: Shading = Shading.PHONG
    reflection: Reflection = Reflection.BLINN_PHONG

    def __post_init__(self) -> None:
        if self.shading is Shading.FLAT:
            raise IllegalValueError(
                f"{quantity('shading')} flat",
                "the sheet's shaders light per vertex or per fragment",
                "use gouraud or phong",
            )

    @property
    def is_specular(self) -> bool:
        """Return whether the eye matters."""
        return self.reflection in (Reflection.PHONG, Reflection.BLINN_PHONG)


@dataclass(frozen=True)
class Needs:
    """What this scene makes the shader compute; the rest is left out."""

    position: bool
    moves_positions: bool
    moves_normals: bool
    metric: bool
    directional: bool
    point_light: bool
    specular: bool


@dataclass(frozen=True)
class Uniform:
    """One uniform: GLSL type, name, exact value."""

    kind: str
    name: str
    value: UniformValue

    @property
    def bytes(self) -> int:
        """Return its size as plain floats."""
        return BYTES[self.kind]


def needs(maps: ExactMaps, request: Request) -> Needs:
    """Return what the scene calls for in this space."""
    point_light = maps.light.position is not None
    position = point_light or request.is_specular
    stays = request.space in (Space.OBJECT, Space.STATIC)
    return Needs(
        position=position,
        moves_positions=position and not stays,
        moves_normals=not stays,
        metric=not maps.is_rigid(request.space),
        directional=maps.light.direction is not None,
        point_light=point_light,
        specular=request.is_specular,
    )


def normal_space_from_object(maps: ExactMaps, space: Space) -> RationalMatrix:
    """Return the inverse transpose of `space_from_object`, or its cofactors if it is singular.

    The cofactors still give the normal of the plane that a map of rank 2 leaves.
    """
    linear_map = maps.space_from_object(space).linear_map
    if linear_map.integer_determinant:
        return linear_map.inverse_transpose
    return linear_map.cofactor_matrix


def uniforms(maps: ExactMaps, request: Request) -> tuple[Uniform, ...]:
    """Return every uniform that the shader pair of this space reads, with its value."""
    found = needs(maps, request)
    return tuple(
        Uniform(kind, name, value(maps, request))
        for kind, name, wanted, value in _UNIFORMS
        if wanted(found)
    )


Wanted = Callable[[Needs], bool]
Valued = Callable[[ExactMaps, Request], UniformValue]


def _light_direction(maps: ExactMaps, request: Request) -> UniformValue:
    direction = maps.light.direction
    assert direction is not None  # needs() asked for it
    moved = maps.space_from_world(request.space).exact_vector(direction)
    return rational.rational_vector(unit(integers(moved)[0]))


def _light_position(maps: ExactMaps, request: Request) -> UniformValue:
    position = maps.light.position
    assert position is not None  # needs() asked for it
    return maps.space_from_world(request.space).exact_point(position)


def _clip_from_vertex(maps: ExactMaps, request: Request) -> UniformValue:
    """Return P·V·M, or P·V where the vertices were baked into world space."""
    if request.space is Space.STATIC:
        return rational.product(maps.clip_from_camera, maps.camera_from_world.exact)
    return maps.clip_from_object


_UNIFORMS: tuple[tuple[str, str, Wanted, Valued], ...] = (
    ("mat4", "clip_from_object", lambda _: True, _clip_from_vertex),
    (
        "mat4",
        "space_from_object",
        lambda n: n.moves_positions,
        lambda maps, request: maps.space_from_object(request.space).exact,
    ),
    (
        "mat3",
        "normal_matrix",
        lambda n: n.moves_normals,
        lambda maps, request: normal_space_from_object(maps, request.space),
    ),
    ("vec3", "light_direction", lambda n: n.directional, _light_direction),
    ("vec3", "light_position", lambda n: n.point_light, _light_position),
    ("vec3", "eye", lambda n: n.specular, lambda maps, request: maps.eye_in(request.space)),
    (
        "mat3",
        "vector_world_from_space",
        lambda n: n.metric,
        lambda maps, request: metric.vector_world_from_space(maps, request.space),
    ),
    (
        "mat3",
        "normal_world_from_space",
        lambda n: n.metric,
        lambda maps, request: metric.normal_world_from_space(maps, request.space),
    ),
    ("vec3", "light_color", lambda _: True, lambda _, __: WHITE),
    ("vec3", "ambient_color", lambda _: True, lambda _, __: AMBIENT),
    ("vec3", "diffuse_color", lambda _: True, lambda _, __: DIFFUSE),
    ("vec3", "specular_color", lambda n: n.specular, lambda _, __: SPECULAR),
    ("float", "shininess", lambda n: n.specular, lambda _, __: SHININESS),
)
