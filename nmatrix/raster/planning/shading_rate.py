"""The triangles whose pixels may be shaded once, at the middle, in place of at every sample.

The samples of a pixel are pairs on either side of its middle, ±t along a line. So what grows evenly
along that line cancels, and for a colour f with |f″| ≤ c along every such line

    |mean of f at the samples − f(middle)| ≤ c/2,  with t up to 1 at the farthest pair.

Why c is known: a normal times 1/w, and the ways p − eye and p − lamp times 1/w, are linear on the
canvas. Such a vector U moves by G along a line, and u = U/|U| turns by e = |G|/min|U| at the most;
differentiating twice, |u″| ≤ √(4/3) e². Cosines g between such unit vectors have |g′| ≤ sin γ · ω
and |g″| ≤ κ, for sums ω and κ of their turns. Then |f″| ≤ |F″(g)| g′² + |F′(g)| |g″|: for Lambert's
cosine F′ = 1 and F″ = 0; for a highlight gˢ, s ≥ 2, F′ ≤ s, and F″ sin² γ is largest where
g² = (s − 2)/s. Where the cosine to a lamp changes its sign within a triangle, max(0, g) has a kink,
which costs half of what g moves; a highlight jumps there, and such triangles are not taken. Where a
channel may pass 1, it has a kink as well.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import e, inf, sqrt
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, NormalRule, Reflection, Shading
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.facts import Facts, product
from nmatrix.raster.planning.recipe import (
    STEADY,
    Decision,
    Influence,
    by_bound,
    called_for,
    not_asked,
)
from nmatrix.raster.shading.space import column, dot, length, quotient, world_normals
from nmatrix.raster.triangles.spans import SUBPIXELS
from nmatrix.raster.triangles.vertices import Projected, signed_area
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import BLACK, Material
from nmatrix.scene.words import LightKind
from nmatrix.shaders.shaded import EDGE

Array = NDArray[Any]

CURVED = sqrt(4.0 / 3.0)  # |u″| over e² at the most
PART = 1 << 14  # triangles that are judged together
SMOOTH = 2.0  # the least shininess for which a highlight has a bounded second derivative
LIMIT = 0.25 / 255  # of a channel: half of the budget
ENOUGH = 0.5  # of the triangles
FEWEST = 8  # pixels a triangle, below which most pixels show an edge
BENDING = frozenset({Effect.DIFFUSE, Effect.SPECULAR})  # whose second derivatives are known here
ONE_SAMPLE = "one sample in a pixel"


def sample_shading(facts: Facts) -> Decision:
    """Decide on samples that are shaded each by itself, where one does for a whole pixel."""
    if facts.loaded.settings.samples == 1:
        return not_asked(ONE_SAMPLE)
    rate = shading_rate(facts)
    if isinstance(rate, str):
        return called_for(rate)
    return by_bound(rate.limit, "pixels inside a triangle are shaded once, where that moves little")


def shading_rate(facts: Facts) -> ShadingRate | str:
    """Find what bounds the colours between a body's samples, or the reason why nothing does."""
    loaded, material = facts.loaded, facts.material
    why = _why_samples_may_differ(facts)
    if why is not None:
        return why
    is_flat = loaded.settings.shading is Shading.FLAT
    lights = () if is_flat else facts.lights
    lamps = tuple(_lamp(facts, one) for one in lights)
    most = max(material.diffuse) + (max(material.specular) if material.shines else 0.0)
    drift = sum(one.per_unit for one in _beside_bending(facts))
    for placed in lights:
        drift += product(max(placed.colour), product(facts.strength(placed).per_unit, most))
    brightest = sum(one.brightness for one in lamps)
    if inf in (drift, brightest):
        return "a lamp's light has an edge on it"
    return ShadingRate(
        material,
        lamps,
        column(loaded.eye),
        drift,
        facts.gain,
        ambience=_ambience(loaded) * max(material.ambient)
        + max(material.unlit or BLACK)
        + max(material.emission),
        limit=LIMIT if lamps or drift else 0.0,
    )


def _why_samples_may_differ(facts: Facts) -> str | None:
    """Find the reason why no bound is known, or None."""
    loaded, material = facts.loaded, facts.material
    width, height = loaded.settings.size
    shading = loaded.settings.shading
    is_wide = material.shines and material.shininess < SMOOTH and shading is Shading.PHONG
    reasons = {
        ONE_SAMPLE: loaded.settings.samples == 1,
        "light at vertices costs little at samples": shading is Shading.GOURAUD,
        "normals may have any length": loaded.settings.normals is not NormalRule.EXACT,
        "normals of a flattened body can cancel": facts.body.linear_map.rank < 3,
        "layers of glass meet at each sample": material.is_clear,
        "most pixels show an edge of its triangles": len(facts.body.mesh.triangles) * FEWEST
        > width * height,
        "a highlight this wide has an edge": is_wide,
    }
    if any(one.jumps or one.per_radian or one.per_unit == inf for one in _beside_bending(facts)):
        reasons["colours may change from one sample to the next"] = True
    return next((why for why, holds in reasons.items() if holds), None)


def _beside_bending(facts: Facts) -> list[Influence]:
    """Find the influences of all effects but those whose second derivatives are known."""
    return [
        facts.influence(effect)
        for effect, recipe in facts.recipes.items()
        if effect not in BENDING and recipe.influence is not STEADY
    ]


def _lamp(facts: Facts, placed: PlacedLight) -> Lamp:
    brightness = product(max(placed.colour), facts.strength(placed).most)
    if placed.position is not None:
        return Lamp(None, column(placed.position), brightness)
    assert placed.direction is not None  # a light is somewhere or comes from somewhere
    travel = column(placed.direction)
    return Lamp(-travel / length(travel), None, brightness)


def _ambience(loaded: LoadedScene) -> float:
    """Find the most light that comes from everywhere."""
    found = [max(one.colour) for one in loaded.lights if one.light.kind is LightKind.AMBIENT]
    return sum(found) if found else 1.0


@dataclass(frozen=True)
class Lamp:
    """A lamp in the world: the way to it or its place (3, 1), and the most light that it brings."""

    to_light: Array | None
    position: Array | None
    brightness: float


@dataclass(frozen=True, eq=False)
class ShadingRate:
    """What a body's colours depend on, and the most that shading once may move a channel.

    `drift` is the most that a channel moves for a place that moves by one unit of the world through
    anything but turning vectors; `gain` multiplies all; `ambience` is what no lamp brings.
    """

    material: Material
    lamps: tuple[Lamp, ...]
    eye: Array
    drift: float
    gain: float
    ambience: float
    limit: float

    def even_triangles(self, loaded: LoadedScene, body: Body, projected: Projected) -> Array | None:
        """Find the projected triangles whose bound is within the limit: a mask (F,).

        None where they are few: then looking for whole pixels costs more than it saves.
        """
        per_side, near = loaded.canvas.per_side, projected.inverse_w
        normals = projected.per_vertex(world_normals(loaded, body, NormalRule.EXACT)) * near
        places = projected.per_vertex(body.positions_world.T)
        found = np.zeros(projected.triangles.shape[1], bool)
        for first in range(0, len(found), PART):
            corners = np.ascontiguousarray(projected.triangles[:, first : first + PART])
            steps = _steps(projected.x.take(corners), projected.y.take(corners), per_side)
            part = _Part(steps, near.take(corners), places.take(corners, 1))
            with np.errstate(invalid="ignore", over="ignore"):
                bound = self._bound(part, part.turning(normals.take(corners, 1)))
            found[first : first + PART] = bound <= self.limit
        return found if len(found) and found.mean() >= ENOUGH else None

    def _bound(self, part: _Part, normal: _Turning) -> Array:
        """Find the most that shading once moves a channel, for each triangle."""
        bound, first = np.zeros_like(normal.turn), np.zeros_like(normal.turn)
        light_sum = np.full_like(normal.turn, self.ambience)
        to_eye = part.turning(part.ways(self.eye)) if self.material.shines else None
        for lamp in self.lamps:
            light = part.to_lamp(lamp)
            bent, moved = self._by_lamp(normal, light, to_eye)
            bound += lamp.brightness * bent
            first += lamp.brightness * moved
            light_sum += lamp.brightness * self._most_by_lamp(normal, light)
        bound += np.where(light_sum > 1.0, first / 2, 0.0)
        if self.drift:
            bound += self.drift * part.shift
        return np.asarray(self.gain * bound)

    def _most_by_lamp(self, normal: _Turning, light: _Turning) -> Array:
        """Find the most that one lamp of brightness 1 adds: n·l grows largest between corners."""
        largest = np.maximum(_pairs(normal, light).max(axis=0), 0.0)
        cosine = np.minimum(quotient(largest, normal.least * light.least), 1.0)
        cosine[~(normal.least * light.least > 0)] = 1.0
        shine = max(self.material.specular) if self.material.shines else 0.0
        return np.asarray(max(self.material.diffuse) * cosine + shine)

    def _by_lamp(
        self, normal: _Turning, light: _Turning, to_eye: _Turning | None
    ) -> tuple[Array, Array]:
        """Find how far the mean and the middle differ, and how far samples do, under one lamp."""
        material, diffuse = self.material, max(self.material.diffuse)
        is_kinked = ~_keep_their_side(normal, light)
        moved = diffuse * (normal.turn + light.turn)
        bent = diffuse * _curvature(normal, light) / 2 + is_kinked * moved / 2
        if to_eye is not None:
            specular, s = max(material.specular), material.shininess
            if material.reflection is Reflection.BLINN_PHONG:
                cosine = (normal, _halfway(light, to_eye))
            else:
                cosine = (_mirrored(normal, light), to_eye)
            omega = cosine[0].turn + cosine[1].turn
            steep = 2.0 * (s - 1.0) * ((s - 2.0) / s) ** ((s - 2.0) / 2) if s >= SMOOTH else inf
            shine = specular * (steep * omega * omega + s * _curvature(*cosine)) / 2
            bent = bent + np.where(is_kinked, inf, shine)
            moved = moved + specular * sqrt(s / e) * omega
        return bent, moved


@dataclass(frozen=True, eq=False)
class _Turning:
    """Unit vectors over triangles: their corners, and how they turn on the way to a sample.

    `corners` (3, 3, F) or (3, 1, 1) have any positive length, not less than `least` between them;
    `turn` bounds |u′| and `curve` |u″|, from the middle of a pixel to its farthest sample.
    """

    corners: Array
    least: Array
    turn: Array
    curve: Array


@dataclass(frozen=True, eq=False)
class _Part:
    """Some triangles: growth of weights (2, 3, F), 1/w (3, F) and places (3, 3, F) at corners."""

    steps: Array
    near: Array
    places: Array

    def turning(self, corners: Array) -> _Turning:
        """Find vectors that are linear on the canvas, as they turn."""
        moved = sum(length((corners * step).sum(axis=1)) for step in self.steps)
        middle = corners.sum(axis=1)
        least = dot(corners, middle[:, None]).min(axis=0) / np.maximum(length(middle), 1e-300)
        turn = np.full_like(least, inf)
        np.divide(moved, least, out=turn, where=least > 0)
        return _Turning(corners, least, turn, CURVED * turn * turn)

    def ways(self, place: Array) -> Array:
        """Find the ways from corners to a place (3, 1) of the world, times 1/w."""
        return np.asarray((place[:, :, None] - self.places) * self.near)

    def to_lamp(self, lamp: Lamp) -> _Turning:
        """Find the ways to a lamp."""
        if lamp.position is not None:
            return self.turning(self.ways(lamp.position))
        assert lamp.to_light is not None  # a lamp is somewhere or comes from somewhere
        still = np.zeros(self.near.shape[1])
        return _Turning(lamp.to_light[:, :, None], still + 1.0, still, still)

    @property
    def shift(self) -> Array:
        """The most that the place moves from the middle of a pixel to a sample.

        p is a mean of corners with weights over 1/w: p′ sums up (corner − p) · weight′ over that.
        """
        a, b, c = (self.places[:, i] for i in range(3))
        reach = np.maximum(np.maximum(length(a - b), length(b - c)), length(c - a))
        grown = (np.abs(self.steps).sum(axis=0) * self.near).sum(axis=0)
        return np.asarray(reach * grown / self.near.min(axis=0))


def _steps(x: Array, y: Array, per_side: int) -> Array:
    """Find how much the corners' weights grow to the farthest sample, across and down (2, 3, F).

    Where a triangle has no area they are infinite.
    """
    area = signed_area(x, y)
    reach = SUBPIXELS * (per_side - 1) / 2
    found = np.full((2, *x.shape), inf)
    for i in range(3):
        for step, way in zip(found, (y[i - 2] - y[i - 1], x[i - 1] - x[i - 2]), strict=True):
            np.divide(way * reach, area, out=step[i], where=area != 0)
    return found


def _curvature(a: _Turning, b: _Turning) -> Array:
    """Bound the second derivative of a cosine between two unit vectors."""
    return np.asarray(a.curve + 2.0 * a.turn * b.turn + b.curve)


def _pairs(a: _Turning, b: _Turning) -> Array:
    """Find the products of every corner of one with every corner of the other, (n, F).

    Between corners all products are means of these.
    """
    found = [dot(p, q) for p in a.corners.swapaxes(0, 1) for q in b.corners.swapaxes(0, 1)]
    return np.stack([np.broadcast_to(one, a.turn.shape) for one in found])


def _keep_their_side(normal: _Turning, light: _Turning) -> Array:
    """Find a mask of the triangles that face a lamp, or look away from it, all over."""
    products = _pairs(normal, light)
    edge = 2 * EDGE * length(normal.corners).max(axis=0) * length(light.corners).max(axis=0)
    return np.asarray((products > edge).all(axis=0) | (products < -edge).all(axis=0))


def _halfway(light: _Turning, to_eye: _Turning) -> _Turning:
    """Find the vectors halfway between two: (l + v)/|l + v|, as they turn."""
    cosine = np.minimum(_pairs(to_eye, light).min(axis=0), 0.0)
    cosine = np.maximum(cosine / (light.least * to_eye.least), -1.0)
    least = np.sqrt(2.0 + 2.0 * cosine)
    turn = quotient(light.turn + to_eye.turn, least) + np.where(least > 0, 0.0, inf)
    curve = quotient(light.curve + to_eye.curve, least) + CURVED * turn * turn
    return _Turning(light.corners, least, turn, curve)


def _mirrored(normal: _Turning, light: _Turning) -> _Turning:
    """Find the mirrored light r = 2(n·l)n − l, as it turns.

    Differentiating twice, each product of n, n and l sums up its factors' turns.
    """
    n, l = normal.turn, light.turn  # noqa: E741 — the letters of the law
    bend = normal.curve + 2.0 * n * l + light.curve  # of n·l
    curve = 2.0 * (bend + 2.0 * (n + l) * n + normal.curve) + light.curve
    return _Turning(light.corners, light.least, 2.0 * n + l, curve)
