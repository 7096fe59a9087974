"""Light on a point: reflection models on unit vectors, all in world space.

n is the normal, l the vector to the light, v the vector to the eye; all have length one.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Reflection
from nmatrix.raster.normals import unit

Array = NDArray[Any]


@dataclass(frozen=True)
class Material:
    """How much of each kind of light a surface sends back."""

    ambient: float = 0.12
    diffuse: float = 0.78
    specular: float = 0.45
    shininess: float = 32.0
    toon_steps: int = 3


DEFAULT_MATERIAL = Material()


@dataclass(frozen=True, eq=False)
class Lighting:
    """A light and an eye in world space; the light has a direction of travel or a position."""

    eye: Array
    direction: Array | None
    position: Array | None
    reflection: Reflection = Reflection.LAMBERT
    material: Material = DEFAULT_MATERIAL

    def shade(self, normals: Array, positions: Array) -> Array:
        """Return grey levels in [0, 1] for unit normals at positions, both (N, 3)."""
        total = np.full(len(normals), self.material.ambient)
        to_eye = unit(self.eye - positions)
        if self.direction is not None:
            to_light = np.broadcast_to(unit(-self.direction), normals.shape)
            total += self._one_light(normals, to_light, to_eye)
        if self.position is not None:
            total += self._one_light(normals, unit(self.position - positions), to_eye)
        return np.asarray(np.clip(total, 0.0, 1.0))

    def _one_light(self, n: Array, light: Array, eye: Array) -> Array:
        material = self.material
        cosine = np.maximum((n * light).sum(axis=1), 0.0)
        if self.reflection is Reflection.TOON:
            steps = material.toon_steps
            return np.asarray(material.diffuse * np.ceil(cosine * steps) / steps)
        diffuse = material.diffuse * cosine
        if self.reflection is Reflection.LAMBERT:
            return np.asarray(diffuse)
        lit = cosine > 0
        highlight = np.clip(self._highlight(n, light, eye), 0.0, 1.0)
        return np.asarray(diffuse + material.specular * lit * highlight**material.shininess)

    def _highlight(self, n: Array, light: Array, eye: Array) -> Array:
        if self.reflection is Reflection.BLINN_PHONG:
            return np.asarray((n * unit(light + eye)).sum(axis=1))
        mirrored = 2 * (n * light).sum(axis=1, keepdims=True) * n - light
        return np.asarray((mirrored * eye).sum(axis=1))
