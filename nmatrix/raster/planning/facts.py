"""Facts that decisions about one body under its lamps rest on: each computed once, when asked for.

What effects can change is a sum over the records of those that the scene asks for.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from math import inf, prod, radians
from typing import Any

from numpy.typing import NDArray

from nmatrix.enums import Effect, Space
from nmatrix.linear.classify import most_excess
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.recipe import STEADY, Decision, Influence, Recipe, Strength
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.shading.space import column
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import Material

Array = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Facts:
    """One body as it is seen, and the lamps that light it."""

    seen: SeenBody
    lights: tuple[PlacedLight, ...]
    recipes: Mapping[Effect, Recipe]
    _decided: dict[Effect, Decision] = field(default_factory=dict, init=False)
    _influencing: dict[Effect, Influence] = field(default_factory=dict, init=False)

    @property
    def loaded(self) -> LoadedScene:
        """The loaded scene."""
        return self.seen.loaded

    @property
    def body(self) -> Body:
        """The body."""
        return self.seen.body

    @property
    def material(self) -> Material:
        """The material of the body."""
        return self.body.material

    @property
    def space(self) -> Space:
        """The shading space."""
        return self.loaded.settings.space

    @property
    def is_lit_at_fragments(self) -> bool:
        """True if light is evaluated at fragments, and not at vertices alone."""
        return self.seen.is_lit_at_fragments

    @cached_property
    def decisions(self) -> dict[Effect, Decision]:
        """The decision on every effect that belongs to bodies, needs apart."""
        return {
            effect: self.decision(effect)
            for effect, recipe in self.recipes.items()
            if recipe.judge is not None
        }

    def decision(self, effect: Effect) -> Decision:
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
                found = self.influence(effect)
                if matters(found):
                    yield found

    def influence(self, effect: Effect) -> Influence:
        """Find the influence of an effect here, once: steady where the scene does not ask."""
        if effect not in self._influencing:
            told = self.recipes[effect].influence
            if not self.decision(effect).is_asked:
                told = STEADY
            self._influencing[effect] = told if isinstance(told, Influence) else told(self)
        return self._influencing[effect]

    def strength(self, placed: PlacedLight) -> Strength:
        """Bound what is left of a lamp's light where it arrives, and how fast that changes."""
        found = [one.strength(self.seen, placed) for one in self._on_the_way]
        others = (
            product(one.per_unit, prod(o.most for o in found if o is not one)) for one in found
        )
        return Strength(most=prod(one.most for one in found), per_unit=sum(others))

    @cached_property
    def _on_the_way(self) -> list[Influence]:
        """The influences that change a lamp's light on its way."""
        return [*self._influences(lambda one: one.strength is not STEADY.strength)]

    @cached_property
    def brightness(self) -> float:
        """The most light that all the lamps together bring to a channel."""
        channels = [0.0, 0.0, 0.0]
        for one in self.lights:
            most = self.strength(one).most
            channels = [
                sum_ + product(channel, most)
                for sum_, channel in zip(channels, one.colour, strict=True)
            ]
        return max(channels)

    @cached_property
    def gain(self) -> float:
        """How many times more a channel of the picture moves than the light on a surface."""
        return prod((one.gain for one in self._influences(lambda one: one.gain != 1.0)), start=1.0)

    def _most(self, change: Callable[[Influence], float], times: float = 1.0) -> float:
        """Sum up what effects change, at full gain: the most that a channel moves."""
        following = fixed = 0.0
        for one in self._influences(lambda one: change(one) > 0):
            if one.follows_lights:
                following += change(one)
            else:
                fixed += change(one)
        found = product(product(following, times), self.brightness) + product(fixed, times)
        return product(found, self.gain)

    def _any(self, matters: Callable[[Influence], bool]) -> bool:
        return next(self._influences(matters), None) is not None

    @cached_property
    def max_change_per_radian(self) -> float:
        """The most that a channel moves for a normal that turns, by the radian."""
        return self._most(lambda one: one.per_radian)

    def max_change_by_shortening(self, part: float) -> float:
        """Bound what a channel moves for normals that lose a part of their length."""
        return self._most(lambda one: one.per_length, part)

    @cached_property
    def max_light(self) -> float:
        """The most light that effects add to a channel, and so the most that it can differ."""
        return self._most(lambda one: one.most)

    def max_change_without(self, placed: PlacedLight) -> float:
        """Bound what a channel moves if one lamp is left out."""
        most = sum(one.most for one in self._influences(_may_use_lights))
        arriving = product(max(placed.colour), self.strength(placed).most)
        return product(product(arriving, most), self.gain)

    @cached_property
    def max_change_per_unit(self) -> float:
        """The most that a channel moves for a fragment whose place moves, by the unit of the world.

        Where fragments are lit, a lamp weakens on the way there, and its light turns by 1/d.
        """
        fixed = sum(one.per_unit for one in self._influences(lambda one: one.per_unit > 0))
        following = [*self._influences(lambda one: one.follows_lights)]
        most = sum(one.most for one in following)
        per_radian = sum(one.per_radian for one in following)
        for placed in self.lights if self.is_lit_at_fragments else ():
            if placed.position is not None:
                least, _ = self.seen.distances(column(placed.position)[:, 0])
                strength, brightest = self.strength(placed), max(placed.colour)
                turns = product(per_radian, 1.0 / least if least else inf)
                moved = product(strength.per_unit, most) + product(strength.most, turns)
                fixed += product(brightest, moved)
        return product(fixed, self.gain)

    @cached_property
    def bend(self) -> float:
        """The angle in radians that normals may bend by because the matrix itself carries them.

        Bounds of what is left out besides start from normals that are bent already.
        """
        if self.decision(Effect.INVERSE_TRANSPOSE).on:
            return 0.0
        excess = most_excess(self.seen.map_to_space)
        return min(excess / 2, radians(90))

    @property
    def shortest_normal(self) -> float:
        """The length that interpolation can shrink a normal to, as normals are carried."""
        return self.seen.shortest_normal(self.bend)

    @cached_property
    def why_lengths_matter(self) -> str | None:
        """The reason why no bound holds for shorter normals, or None if one does."""
        reasons = [one.because for one in self._influences(lambda one: one.per_length == inf)]
        return reasons[-1] if reasons else None

    @cached_property
    def has_jumps(self) -> bool:
        """True if colours may jump: highlights at n·l = 0, bands, shadows."""
        return self._any(lambda one: one.jumps)

    @cached_property
    def lights_backs(self) -> bool:
        """True if light from behind a surface may change it."""
        return self._any(lambda one: one.lights_backs)

    @cached_property
    def brings_colour(self) -> bool:
        """True if an effect may bring a hue of its own."""
        return self._any(lambda one: one.brings_colour)


def _may_use_lights(one: Influence) -> bool:
    return one.most > 0 and (one.follows_lights or one.most == inf)


def product(a: float, b: float) -> float:
    """Multiply, where nothing times an unknown number is nothing.

    Examples
    --------
    >>> product(0.0, inf), product(2.0, inf)
    (0.0, inf)
    """
    return a * b if a and b else 0.0
