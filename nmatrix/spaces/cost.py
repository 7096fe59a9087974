"""The cost of a shading space: multiplications counted where they happen, and bytes of uniforms.

Counted as mat4·vec4 16, mat3·vec3 9, dot 3, normalise 6, mat4·mat4 64, inverse transpose 30
(nine 2×2 determinants, one dot, nine divisions).
"""

from __future__ import annotations

from dataclasses import dataclass

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.shading_spaces import PROFILES, Place
from nmatrix.spaces.uniforms import Needs, Request, needs, uniforms

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
    found = needs(maps, request)
    lighting = _lighting(found, request)
    at_vertex = request.shading is Shading.GOURAUD
    return Cost(
        per_fragment_multiplications=0 if at_vertex else NORMALISE + lighting,
        per_vertex_multiplications=_per_vertex(found) + (lighting if at_vertex else 0),
        per_object_multiplications=_per_object(found, request),
        per_scene_multiplications=_per_scene(found, request),
        uniform_bytes=sum(uniform.bytes for uniform in uniforms(maps, request)),
    )


def _per_vertex(found: Needs) -> int:
    position = MAT4_VEC4 if found.moves_positions else 0
    normal = MAT3_VEC3 + NORMALISE if found.moves_normals else 0
    return MAT4_VEC4 + position + normal


def _lighting(found: Needs, request: Request) -> int:
    unit = NORMALISE + (MAT3_VEC3 if found.metric else 0)
    lambert = DOT + (1 if found.metric else 0)
    lights = int(found.directional) + int(found.point_light)
    each = unit + lambert + 2 * SCALE + (_highlight(found, request) if found.specular else 0)
    once = (MAT3_VEC3 + DOT if found.metric else 0) + (unit if found.specular else 0)
    return once + lights * each


def _highlight(found: Needs, request: Request) -> int:
    unit = NORMALISE + (MAT3_VEC3 if found.metric else 0)
    if request.reflection is Reflection.BLINN_PHONG:
        return unit + DOT + (1 if found.metric else 0) + 2 * SCALE
    reflected = DOT + SCALE + 1
    measured = 2 * MAT3_VEC3 + DOT + 3 if found.metric else 0
    return reflected + DOT + 2 * SCALE + measured


def _per_object(found: Needs, request: Request) -> int:
    profile = PROFILES[request.space]
    if profile.vertices_in is not Space.OBJECT:
        return 0
    total = MAT4_MAT4
    if found.moves_positions and profile.symbol:
        total += MAT4_MAT4
    if found.moves_normals:
        total += INVERSE_TRANSPOSE
    return total + (_lights_moved(found) if profile.lights_moved is Place.OBJECT else 0)


def _per_scene(found: Needs, request: Request) -> int:
    view = MAT4_MAT4
    profile = PROFILES[request.space]
    if profile.lights_moved is not Place.SCENE:
        return view
    return view + _lights_moved(found, eye=not profile.eye_is_origin)


def _lights_moved(found: Needs, *, eye: bool = True) -> int:
    return (
        (MAT3_VEC3 if found.directional else 0)
        + (MAT4_VEC4 if found.point_light else 0)
        + (MAT4_VEC4 if found.specular and eye else 0)
    )
