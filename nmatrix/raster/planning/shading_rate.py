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

from nmatrix.enums import Reflection
from nmatrix.raster.shading.space import dot, length, quotient
from nmatrix.raster.triangles.spans import SUBPIXELS
from nmatrix.raster.triangles.vertices import Projected, signed_area
from nmatrix.scene.material import Material

Array = NDArray[Any]

CURVED = sqrt(4.0 / 3.0)  # |u″| over e² at the most
PART = 1 << 14  # triangles that are judged together
SMOOTH = 2.0  # the least shininess for which a highlight has a bounded second derivative


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
    anything but turning vectors; `gain` multiplies all; `saturates` where a channel may pass 1.
    """

    material: Material
    lamps: tuple[Lamp, ...]
    eye: Array
    drift: float
    gain: float
    saturates: bool
    limit: float

    def even_triangles(
        self, projected: Projected, normals: Array, places: Array, per_side: int
    ) -> Array:
        """Return a mask (F,) of the triangles whose bound is within the limit.

        `normals` of length one and `places` are those of the mesh's vertices (3, V) in the world.
        """
        near = projected.inverse_w
        normals = projected.per_vertex(normals) * near
        places = projected.per_vertex(places)
        found = np.zeros(projected.triangles.shape[1], bool)
        for first in range(0, len(found), PART):
            corners = np.ascontiguousarray(projected.triangles[:, first : first + PART])
            steps = _steps(projected.x.take(corners), projected.y.take(corners), per_side)
            part = _Part(steps, near.take(corners), places.take(corners, 1))
            with np.errstate(invalid="ignore", over="ignore"):
                bound = self._bound(part, part.turning(normals.take(corners, 1)))
            found[first : first + PART] = bound <= self.limit
        return found

    def _bound(self, part: _Part, normal: _Turning) -> Array:
        """Return the most that shading once moves a channel, for each triangle."""
        bound, first = np.zeros_like(normal.turn), np.zeros_like(normal.turn)
        to_eye = part.turning(part.ways(self.eye)) if self.material.shines else None
        for lamp in self.lamps:
            light = part.to_lamp(lamp)
            bent, moved = self._by_lamp(normal, light, to_eye)
            bound += lamp.brightness * bent
            first += lamp.brightness * moved
        if self.saturates:
            bound += first / 2
        if self.drift:
            bound += self.drift * part.shift
        return np.asarray(self.gain * bound)

    def _by_lamp(
        self, normal: _Turning, light: _Turning, to_eye: _Turning | None
    ) -> tuple[Array, Array]:
        """Return how far the mean and the middle differ, and how far samples do, under one lamp."""
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
    """Unit vectors over triangles: what they are at corners, how they turn towards a sample.

    `corners` (3, 3, F) or (3, 1, 1) have any positive length, not less than `least` between them;
    `turn` bounds |u′| and `curve` |u″|, from the middle of a pixel to its farthest sample.
    """

    corners: Array
    least: Array
    turn: Array
    curve: Array


@dataclass(frozen=True, eq=False)
class _Part:
    """Some triangles: the growth of weights (2, 3, F), 1/w (3, F) and places (3, 3, F) at corners."""

    steps: Array
    near: Array
    places: Array

    def turning(self, corners: Array) -> _Turning:
        """Return vectors that are linear on the canvas, as they turn."""
        moved = sum(length((corners * step).sum(axis=1)) for step in self.steps)
        middle = corners.sum(axis=1)
        least = dot(corners, middle[:, None]).min(axis=0) / np.maximum(length(middle), 1e-300)
        turn = np.full_like(least, inf)
        np.divide(moved, least, out=turn, where=least > 0)
        return _Turning(corners, least, turn, CURVED * turn * turn)

    def ways(self, place: Array) -> Array:
        """Return the ways from corners to a place (3, 1) of the world, times 1/w."""
        return np.asarray((place[:, :, None] - self.places) * self.near)

    def to_lamp(self, lamp: Lamp) -> _Turning:
        """Return the ways to a lamp."""
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
    """Return how much the corners' weights grow to the farthest sample, across and down (2, 3, F).

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
    """Return the products of every corner of one with every corner of the other, (n, F).

    Between corners all products are means of these.
    """
    found = [dot(p, q) for p in a.corners.swapaxes(0, 1) for q in b.corners.swapaxes(0, 1)]
    return np.stack([np.broadcast_to(one, a.turn.shape) for one in found])


def _keep_their_side(normal: _Turning, light: _Turning) -> Array:
    """Return a mask of the triangles that face a lamp, or look away from it, all over."""
    products = _pairs(normal, light)
    return np.asarray((products > 0).all(axis=0) | (products < 0).all(axis=0))


def _halfway(light: _Turning, to_eye: _Turning) -> _Turning:
    """Return the vectors halfway between two: (l + v)/|l + v|, as they turn."""
    cosine = np.minimum(_pairs(to_eye, light).min(axis=0), 0.0)
    cosine = np.maximum(cosine / (light.least * to_eye.least), -1.0)
    least = np.sqrt(2.0 + 2.0 * cosine)
    turn = quotient(light.turn + to_eye.turn, least) + np.where(least > 0, 0.0, inf)
    curve = quotient(light.curve + to_eye.curve, least) + CURVED * turn * turn
    return _Turning(light.corners, least, turn, curve)


def _mirrored(normal: _Turning, light: _Turning) -> _Turning:
    """Return the mirrored light r = 2(n·l)n − l, as it turns.

    Differentiating twice, each product of n, n and l sums up its factors' turns.
    """
    n, l = normal.turn, light.turn  # noqa: E741 — the letters of the law
    bend = normal.curve + 2.0 * n * l + light.curve  # of n·l
    curve = 2.0 * (bend + 2.0 * (n + l) * n + normal.curve) + light.curve
    return _Turning(light.corners, light.least, 2.0 * n + l, curve)
