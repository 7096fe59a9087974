"""The program of one sheet: an object of a plain material under the setup's light."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace

from nmatrix.enums import Effect, Reflection, Shading, Space
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.scene.light import PlacedLight, SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.words import LightKind
from nmatrix.shaders import glsl
from nmatrix.shaders.glsl import Glsl
from nmatrix.shaders.program import Program, program
from nmatrix.shaders.shaded import FrontFace, Shaded
from nmatrix.spaces.exact_maps import ExactMaps

MATERIAL = Material("sheet", ambient=grey(0.1), diffuse=grey(0.8), specular=grey(0.5))


@dataclass(frozen=True)
class Request:
    """The shader that is asked for."""

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


def program_of(maps: ExactMaps, request: Request, front_face: FrontFace = FrontFace.CCW) -> Program:
    """Write the shaders of a sheet, with just the terms that its light and reflection call for.

    Examples
    --------
    >>> from nmatrix.scene.setup import Setup
    >>> found = program_of(Setup().maps, Request(Space.WORLD, reflection=Reflection.LAMBERT))
    >>> [uniform.name for uniform in found.uniforms][:3]
    ['clip_from_object', 'normal_matrix', 'ambient_color']
    """
    material = replace(MATERIAL, reflection=request.reflection)
    effects = {Effect.METRIC} if not maps.is_rigid(request.space) else set()
    shaded = Shaded(
        maps,
        request.space,
        request.shading,
        material,
        tuple(_lights(maps)),
        frozenset(effects),
        front_face,
    )
    return program(shaded, _terms(shaded))


def _lights(maps: ExactMaps) -> Iterator[PlacedLight]:
    """Yield the lights of a setup: one that has a direction, and one that has a place."""
    if maps.light.direction is not None:
        sun = SceneLight("sun", LightKind.DIRECTIONAL)
        yield PlacedLight(sun, None, maps.light.direction)
    if maps.light.position is not None:
        bulb = SceneLight("bulb", LightKind.POINT)
        yield PlacedLight(bulb, maps.light.position, None)


def _terms(shaded: Shaded) -> Iterator[Glsl]:
    yield glsl.ambient(shaded)
    yield glsl.diffuse(shaded)
    if Effect.METRIC in shaded.effects:
        yield glsl.metric(shaded)
    if shaded.material.shines:
        yield glsl.specular(shaded)
    if shaded.material.reflection is Reflection.TOON:
        yield glsl.toon(shaded)
    yield glsl.RENORMALISE
