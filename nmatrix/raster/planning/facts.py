"""Facts that decisions about one body rest on: each computed when it is asked for, and once.

What effects can change is a sum over the records of those that the scene asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Shading, Space
from nmatrix.linear.classify import Classification, classify
from nmatrix.linear.rational import RationalMatrix
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.recipe import STEADY, Decision, Influence, Recipe
from nmatrix.raster.shading.space import ShadingSpace, as_array, column, dot, world_normals
from nmatrix.raster.triangles.clip import inside
from nmatrix.raster.triangles.products import chunks, multiply
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import Material

Array = NDArray[Any]

THINNEST = 1e6  # of length to thickness, for fronts and backs to be told apart by depth


@dataclass(frozen=True, eq=False)
class Facts:
    """One body, the lights that reach it, and the space that it is shaded in."""

    loaded: LoadedScene
    body: Body
    lights: tuple[PlacedLight, ...]
    recipes: Mapping[Effect, Recipe]
    _decided: dict[Effect, Decision] = field(default_factory=dict, init=False)
    _influencing: dict[Effect, Influence] = field(default_factory=dict, init=False)

    @property
    def material(self) -> Material:
        """Return the material of the body."""
        return self.body.material

    @property
    def space(self) -> Space:
        """Return the shading space."""
        return self.loaded.settings.space

    @property
    def is_lit_at_fragments(self) -> bool:
        """Return True if light is evaluated at fragments, and not at vertices alone."""
        return self.loaded.settings.shading is Shading.PHONG

    @cached_property
    def map_to_space(self) -> Classification:
        """Classify the map from the body to its shading space."""
        seen = ShadingSpace(self.loaded, self.body, self.space, uses_metric=False)
        return classify(seen.exact_from_object)

    @cached_property
    def clip_from_object(self) -> RationalMatrix:
        """Return the exact map from the body to clip space."""
        return self.loaded.clip_from_object(self.body)

    def clip_parts(self) -> Iterator[Array]:
        """Yield the vertices in clip space, some at a time (4, n)."""
        matrix = as_array(self.clip_from_object)
        for part in chunks(self.body.mesh.positions.T):
            with np.errstate(over="ignore", invalid="ignore"):
                yield multiply(matrix, part)

    @cached_property
    def is_whole(self) -> bool:
        """Return True if no plane of the view cuts the body."""
        depth, canvas = self.loaded.clip.depth, self.loaded.canvas
        return all(bool(inside(part, depth, canvas).all()) for part in self.clip_parts())

    @property
    def is_thin(self) -> bool:
        """Return True if the map all but flattens the body: a front and a back in one place."""
        kappa = self.body.kind.condition
        return kappa is None or kappa > THINNEST

    @property
    def is_parallel(self) -> bool:
        """Return True if w is the same everywhere."""
        return not any(self.clip_from_object[3][:3])

    @cached_property
    def w_ratio(self) -> float:
        """Return the largest ratio of w between corners of one triangle; infinite if it is cut."""
        if not self.is_whole:
            return inf
        w = np.concatenate([part[3] for part in self.clip_parts()])
        low, high = float(w.min()), float(w.max())
        if high <= 2.0 * low:  # one triangle's ratio is no larger than the whole body's
            return high / low
        of_corners = (w.take(part) for part in chunks(self.body.mesh.triangles.T))
        return max(float((one.max(axis=0) / one.min(axis=0)).max()) for one in of_corners)

    @cached_property
    def normal_cosine(self) -> float:
        """Return the smallest cosine between the world normals of one triangle's corners."""
        normals = world_normals(self.loaded, self.body, self.loaded.settings.normals)
        found = inf
        for part in chunks(self.body.mesh.triangles.T):
            a, b, c = (normals[:, corner] for corner in part)
            found = min(found, *(float(dot(p, q).min()) for p, q in ((a, b), (b, c), (c, a))))
        return found

    @property
    def shortest_normal(self) -> float:
        """Return the length that interpolation can shrink a normal to: √((1 + 2 cos θ)/3)."""
        return sqrt(max(0.0, (1.0 + 2.0 * self.normal_cosine) / 3.0))

    @cached_property
    def brightness(self) -> float:
        """Return the brightest channel of all the lights together."""
        return max(
            (sum(one) for one in zip(*(light.colour for light in self.lights), strict=True)),
            default=0.0,
        )

    @cached_property
    def decisions(self) -> dict[Effect, Decision]:
        """Return the decision on every effect that belongs to bodies, needs apart."""
        return {
            effect: self._decision(effect)
            for effect, recipe in self.recipes.items()
            if recipe.judge is not None
        }

    def _decision(self, effect: Effect) -> Decision:
        """Decide on one effect, once: judges ask what other effects can change."""
        if effect not in self._decided:
            self._decided[effect] = self.recipes[effect].decision(self)
        return self._decided[effect]

    def _influences(self, matters: Callable[[Influence], bool]) -> Iterator[Influence]:
        """Yield the influences that matter of the effects that the scene asks for.

        Judges of effects whose record alone tells that they do not matter are not called.
        """
        for effect, recipe in self.recipes.items():
            told = recipe.influence
            if not isinstance(told, Influence) or matters(told):
                found = self._influence(effect)
                if matters(found):
                    yield found

    def _influence(self, effect: Effect) -> Influence:
        """Return the influence of an effect here, once: steady where the scene does not ask."""
        if effect not in self._influencing:
            told = self.recipes[effect].influence
            if not self._decision(effect).is_asked:
                told = STEADY
            self._influencing[effect] = told if isinstance(told, Influence) else told(self)
        return self._influencing[effect]

    def _most(self, change: Callable[[Influence], float], times: float = 1.0) -> float:
        """Return the most that a channel moves: the sum of what effects change, at full gain."""
        following = fixed = 0.0
        for one in self._influences(lambda one: change(one) > 0):
            if one.follows_lights:
                following += change(one)
            else:
                fixed += change(one)
        found = product(product(following, times), self.brightness) + product(fixed, times)
        for one in self._influences(lambda one: one.gain != 1.0):
            found = product(found, one.gain)
        return found

    def _any(self, matters: Callable[[Influence], bool]) -> bool:
        return next(self._influences(matters), None) is not None

    @cached_property
    def max_change_per_radian(self) -> float:
        """Return the most that a channel moves for a normal that turns, by the radian."""
        return self._most(lambda one: one.per_radian)

    def max_change_by_shortening(self, part: float) -> float:
        """Return the most that a channel moves for normals that lose a part of their length."""
        return self._most(lambda one: one.per_length, part)

    @cached_property
    def colour_range(self) -> float:
        """Return the most that the light at two vertices differs."""
        return self._most(lambda one: one.colour_range)

    @cached_property
    def why_lengths_matter(self) -> str | None:
        """Return the reason why no bound holds for shorter normals, or None if one does."""
        reasons = [one.because for one in self._influences(lambda one: one.per_length == inf)]
        return reasons[-1] if reasons else None

    @cached_property
    def has_jumps(self) -> bool:
        """Return True if colours may jump: highlights at n·l = 0, and bands."""
        return self._any(lambda one: one.jumps)

    @cached_property
    def reads_places(self) -> bool:
        """Return True if fragments ask where they are: in the scene or on an image."""
        return self._any(lambda one: one.reads_place)

    @cached_property
    def lights_backs(self) -> bool:
        """Return True if light from behind a surface may change it."""
        return self._any(lambda one: one.lights_backs)

    @cached_property
    def brings_colour(self) -> bool:
        """Return True if an effect may bring a hue of its own."""
        return self._any(lambda one: one.brings_colour)

    @property
    def eye_is_outside(self) -> bool:
        """Return True if the eye is outside of the box around the body."""
        eye, (low, high) = column(self.loaded.eye)[:, 0], self.body.box
        return bool((eye < low).any() or (eye > high).any())


def product(a: float, b: float) -> float:
    """Return a · b, where nothing times an unknown number is nothing.

    Examples
    --------
    >>> product(0.0, inf), product(2.0, inf)
    (0.0, inf)
    """
    return a * b if a and b else 0.0
