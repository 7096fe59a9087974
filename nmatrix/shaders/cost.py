"""The cost of a shading space: multiplications counted where they happen, and bytes of uniforms.

Counted as mat4·vec4 16, mat3·vec3 9, dot 3, normalise 6, mat4·mat4 64, inverse transpose 30
(nine 2×2 determinants, one dot, nine divisions).
"""

from __future__ import annotations

from dataclasses import dataclass

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.shaders.program import Program
from nmatrix.shaders.sheet import Request, program_of
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.shading_spaces import PROFILES, Place

MAT4_VEC4, MAT3_VEC3, DOT, NORMALISE = 16, 9, 3, 6
MAT4_MAT4, INVERSE_TRANSPOSE = 64, 30
SCALE = 3  # a vector times a number


@dataclass(frozen=True)
class Cost:
    """Multiplications in each place, and the bytes that are uploaded."""

    per_fragment_multiplications: int
    per_vertex_multiplications: int
    per_object_multiplications: int
    per_scene_multiplications: int
    uniform_bytes: int


def cost(maps: ExactMaps, request: Request) -> Cost:
    """Count what one frame costs in this space.

    Examples
    --------
    >>> from nmatrix.scene.setup import Light, Setup
    >>> bulb = Setup(light=Light(position=(0, 3, 0))).maps
    >>> world = cost(bulb, Request(Space.WORLD, reflection=Reflection.LAMBERT))
    >>> world.per_vertex_multiplications  # clip position, position, normal and its length
    47
    """
    found = program_of(maps, request)
    lighting = _lighting(maps, found, request)
    at_vertex = request.shading is Shading.GOURAUD
    normal = _normal_made_unit(found)
    return Cost(
        per_fragment_multiplications=0 if at_vertex else normal + lighting,
        per_vertex_multiplications=_per_vertex(found) + (lighting if at_vertex else 0),
        per_object_multiplications=_per_object(maps, found, request),
        per_scene_multiplications=_per_scene(maps, found, request),
        uniform_bytes=sum(uniform.bytes for uniform in found.uniforms),
    )


def _normal_made_unit(found: Program) -> int:
    return NORMALISE + (MAT3_VEC3 if found.reads("normal_world_from_space") else 0)


def _per_vertex(found: Program) -> int:
    position = MAT4_VEC4 if found.reads("space_from_object") else 0
    normal = MAT3_VEC3 if found.reads("normal_matrix") else 0
    moved = found.reads("normal_matrix") or found.reads("normal_world_from_space")
    return MAT4_VEC4 + position + normal + (_normal_made_unit(found) if moved else 0)


def _lighting(maps: ExactMaps, found: Program, request: Request) -> int:
    unit = NORMALISE + (MAT3_VEC3 if found.reads("vector_world_from_space") else 0)
    specular = found.reads("shininess")
    each = DOT + 2 * SCALE + (_highlight(found, request) if specular else 0)
    lights = (maps.light.direction is not None) + (maps.light.position is not None)
    to_place = unit if maps.light.position is not None else 0
    return (unit if specular else 0) + to_place + lights * each


def _highlight(found: Program, request: Request) -> int:
    moved = MAT3_VEC3 if found.reads("vector_world_from_space") else 0
    if request.reflection is Reflection.BLINN_PHONG:
        return NORMALISE + moved + DOT + 2 * SCALE
    return 2 + DOT + 2 * moved + DOT + 2 * SCALE


def _per_object(maps: ExactMaps, found: Program, request: Request) -> int:
    profile = PROFILES[request.space]
    if profile.vertices_in is not Space.OBJECT:
        return 0
    total = MAT4_MAT4
    if found.reads("space_from_object") and profile.symbol:
        total += MAT4_MAT4
    if found.reads("normal_matrix"):
        total += INVERSE_TRANSPOSE
    return total + (_lights_moved(maps, found) if profile.lights_moved is Place.OBJECT else 0)


def _per_scene(maps: ExactMaps, found: Program, request: Request) -> int:
    view = MAT4_MAT4
    profile = PROFILES[request.space]
    if profile.lights_moved is not Place.SCENE:
        return view
    return view + _lights_moved(maps, found, eye=not profile.eye_is_origin)


def _lights_moved(maps: ExactMaps, found: Program, *, eye: bool = True) -> int:
    return (
        (MAT3_VEC3 if maps.light.direction is not None else 0)
        + (MAT4_VEC4 if maps.light.position is not None else 0)
        + (MAT4_VEC4 if found.reads("eye") and eye else 0)
    )
