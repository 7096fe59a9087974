"""Light on a surface, in any space: the parts of each light that reach the eye.

n is the unit normal, l the unit vector to the light, v the unit vector to the eye, d a distance;
"unit" and d by the space's own measure, so that every space gives the same numbers. Arrays are
(3, m), colours (1, m) where everything is grey and (3, m) else.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Reflection
from nmatrix.raster.shading.space import Measure, dot, quotient
from nmatrix.scene.material import BLACK, Material
from nmatrix.shaders.shaded import EDGE

Array = NDArray[Any]
Occlusion = Callable[[Array, Array, Array], Array]  # of positions, normals, cosines; 1 where lit

MOST_SQUARED = 1 << 10  # a larger shininess would take more products than a power costs


@dataclass(frozen=True, eq=False)
class ShadingLight:
    """A light as one space sees it; columns (3, 1), colour (channels, 1).

    `to_light` is the unit vector to a light without a place; `axis` the unit direction of a spot.
    """

    colour: Array
    to_light: Array | None = None
    position: Array | None = None
    axis: Array | None = None
    attenuation: tuple[float, float, float] = (1.0, 0.0, 0.0)
    range: float = inf
    cone: tuple[float, float] | None = None
    occlusion: Occlusion | None = None


class Lit(NamedTuple):
    """Light from a surface to the eye: `matte` takes the texture's colour, `gloss` does not."""

    matte: Array
    gloss: Array | None


@dataclass(frozen=True, eq=False)
class Lighting:
    """All the lights of one body, its material, and which effects are computed.

    `ambient` is (channels, 1): the light that comes from everywhere.
    """

    material: Material
    lights: tuple[ShadingLight, ...]
    ambient: Array
    eye: Array
    measure: Measure
    effects: frozenset[Effect]

    def light(self, normals: Array, positions: Array | None) -> Lit:
        """Return the light from points with unit normals; positions where an effect reads them."""
        channels = len(self.ambient)
        to_eye = None
        if Effect.EYE in self.effects and positions is not None:
            to_eye = self.to_eye(positions)
        matte = np.zeros((channels, normals.shape[1]))
        if Effect.UNLIT in self.effects:
            matte += colour(self.material.unlit or BLACK, channels)
        if Effect.AMBIENT in self.effects:
            matte += self.ambient * colour(self.material.ambient, channels)
        gloss = np.zeros_like(matte) if Effect.SPECULAR in self.effects else None
        diffuse = colour(self.material.diffuse, channels)
        specular = colour(self.material.specular, channels) * self.material.shines
        for light in self.lights:
            to_light, strength = self._reaching(light, positions)
            cosine = dot(normals, to_light)
            if light.occlusion is not None and positions is not None:
                strength = strength * light.occlusion(positions, normals, cosine)
            if Effect.DIFFUSE in self.effects:
                matte += (light.colour * diffuse) * (self._diffuse(cosine) * strength)
            if gloss is not None and to_eye is not None:
                shine = self._highlight(normals, to_light, to_eye, cosine)
                gloss += (light.colour * specular) * (shine * strength)
        return Lit(matte, gloss)

    def to_eye(self, positions: Array) -> Array:
        """Return the unit vectors from points to the eye."""
        return self._unit(self.eye - positions)

    def distance_to_eye(self, positions: Array) -> Array:
        """Return the distances from points to the eye."""
        return self.measure.vector_length(self.eye - positions)

    def _unit(self, vectors: Array) -> Array:
        return quotient(vectors, self.measure.vector_length(vectors))

    def _reaching(
        self, light: ShadingLight, positions: Array | None
    ) -> tuple[Array, Array | float]:
        """Return the vectors to a light, and which part of its light comes that far."""
        if light.position is None or positions is None:
            assert light.to_light is not None  # a light has a place or a direction
            return light.to_light, 1.0
        way = light.position - positions
        distance = self.measure.vector_length(way)
        to_light = quotient(way, distance)
        strength: Array | float = 1.0
        if Effect.ATTENUATION in self.effects:
            constant, linear, quadratic = light.attenuation
            weakened = constant + distance * (linear + quadratic * distance)
            # On the lamp itself light has no direction, and so no strength.
            strength = quotient(1.0 * (distance <= light.range * (1.0 + EDGE)), weakened)
        if Effect.SPOT in self.effects and light.cone is not None:
            strength = strength * self._inside_cone(light, to_light)
        return to_light, strength

    def _inside_cone(self, light: ShadingLight, to_light: Array) -> Array:
        """Return 1 inside the inner cone, 0 outside the outer one, smooth between."""
        assert light.cone is not None and light.axis is not None  # both or neither
        world = self.measure.vector_in_world
        inner, outer = light.cone
        cosine = -dot(world(to_light), world(light.axis))
        share = np.clip((cosine - outer) / max(inner - outer, 1e-9), 0.0, 1.0)
        return np.asarray(share * share * (3.0 - 2.0 * share))

    def _diffuse(self, cosine: Array) -> Array:
        found = np.maximum(cosine, 0.0)
        if Effect.TOON in self.effects:
            steps = self.material.toon_steps
            return np.asarray(np.ceil(np.maximum(found * steps - EDGE, 0.0)) / steps)
        return np.asarray(found)

    def _highlight(self, n: Array, to_light: Array, to_eye: Array, cosine: Array) -> Array:
        """Return the highlight where light falls on the front at all: 0⁰ must not glow."""
        if self.material.reflection is Reflection.BLINN_PHONG:
            found = dot(n, self._unit(to_light + to_eye))
        else:
            world = self.measure.vector_in_world
            found = 2.0 * cosine * dot(n, to_eye) - dot(world(to_light), world(to_eye))
        return power(np.clip(found, 0.0, 1.0), self.material.shininess) * (cosine > EDGE)


def power(base: Array, exponent: float) -> Array:
    """Raise to a power; to a whole one by squarings, which lose about as many roundings.

    Examples
    --------
    >>> power(np.array([0.5, 1.0]), 5.0).tolist()
    [0.03125, 1.0]
    """
    if exponent != int(exponent) or not 1 <= exponent <= MOST_SQUARED:
        return np.asarray(base**exponent)
    rest, square, found = int(exponent), base, None
    while True:
        if rest & 1:
            found = square if found is None else found * square
        rest >>= 1
        if not rest:
            return np.asarray(found)
        square = square * square


def colour(channels: tuple[float, ...], count: int) -> Array:
    """Return a colour as a column of as many channels as the picture has."""
    return np.array(channels[:count])[:, None]
