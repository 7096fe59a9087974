"""The accuracy proof: one hard matrix, and how wrong each normal comes out in four precisions."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from math import log10
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import Verdict, ramp
from nmatrix.canvas.marks import Box, Canvas
from nmatrix.canvas.slide import CAPTION, GUTTER, Panel, Slide
from nmatrix.canvas.text import scientific, with_power
from nmatrix.enums import NormalRule, Shading, Space
from nmatrix.linear.affine import compose, rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.classify import condition_text
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import affine_matrix, linear_part, product, rational_matrix, to_floats
from nmatrix.raster.drawn_scene import DrawnScene
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import Pose, drawn_for, put_map
from nmatrix.raster.shading.normals import angles_deg, unit
from nmatrix.raster.shading.surface import Surface
from nmatrix.raster.triangles.fragments import Fragments
from nmatrix.scene.geometry import Geometry, LoadedGeometry, ShapeGeometry
from nmatrix.scene.words import Shape
from nmatrix.scene.world import World

Array = NDArray[Any]
Precision = type[np.floating[Any]]

PRECISIONS: tuple[Precision, ...] = (np.float16, np.float32, np.float64)
COFACTOR_MULTIPLICATIONS = 18
SQUASHED = Fraction(1, 1_000_000)
HUED = (1.0, 0.0, 0.0)  # so that a grey page has three channels as well
BALL = ShapeGeometry(Shape.SPHERE, (64, 128))
BEFORE = Pose((-2.2, 1.5, 9.0), radius=1, room=0.0, free=(14, 14, 14, 92))
BELOW, NUMBER = 270.0, 52
SEEN_DEG = 0.1  # an angle that can be seen
LEAST_DEG, MOST_DEG = 1e-14, 180.0  # the ends of the scale
TICKS = (1e-14, 1e-10, 1e-6, SEEN_DEG, 180.0)
BAR_WIDE, BAR_HIGH = 0.62, 26.0  # of the width; units


THERE = rotation([Angle.degrees(35), Angle.degrees(-20), Angle.degrees(50)])


def hard_world() -> World:
    """Return a map with κ = 10⁶ whose axes are not the coordinate axes: turn, squash, turn."""
    turn = rotation([Angle.degrees(25), Angle.degrees(40), Angle.degrees(15)])
    squash = linear_part(compose(turn, (1, SQUASHED, 1)))
    return World(matrix=rational_matrix(to_floats(affine_matrix(product(squash, THERE)))))


@dataclass(frozen=True)
class Cofactors:
    """The cofactors of a map, in floats of any precision and in twice that of float64."""

    linear_map: LinearMap

    @cached_property
    def _parts(self) -> tuple[Array, Array]:
        """Return the exact matrix (3, 3) as the sum of two, the second of them tiny."""
        flat = [entry for row in self.linear_map.cofactors for entry in row]
        largest = max(map(abs, flat)) or 1
        sign = self.linear_map.determinant_sign or 1
        exact = [Fraction(sign * entry, largest) for entry in flat]
        high = [float(one) for one in exact]
        low = [float(one - Fraction(part)) for one, part in zip(exact, high, strict=True)]
        return np.reshape(high, (3, 3)), np.reshape(low, (3, 3))

    def exactly(self, normals: Array) -> Array:
        """Carry normals (n, 3) to unit length with sums that lose nothing that a float64 shows.

        Each product and sum keeps what its rounding cut off, so what cancels leaves the truth.
        """
        high, low = self._parts
        columns = []
        for i in range(3):
            total, rest = np.zeros(len(normals)), np.zeros(len(normals))
            for j in range(3):
                term, lost = _product(high[i, j], normals[:, j])
                total, cut = _sum(total, term)
                rest += lost + cut + low[i, j] * normals[:, j]
            columns.append(total + rest)
        return unit(np.stack(columns, axis=1))

    def rounded(self, precision: Precision, normals: Array) -> Array:
        """Carry normals (n, 3) with every operation in one precision, as programs do.

        The rows of the cofactor matrix are cross products of the rows of A. What overflows, or
        is rounded to nothing, becomes zero.
        """
        denominator = self.linear_map.denominator
        exact = tuple(
            tuple(Fraction(entry, denominator) for entry in row) for row in self.linear_map.entries
        )
        A: Array = np.array(to_floats(exact))
        with np.errstate(all="ignore"):
            A = A.astype(precision)
            C = np.stack([np.cross(A[1], A[2]), np.cross(A[2], A[0]), np.cross(A[0], A[1])])
            n = normals.T.astype(precision)
            moved = np.stack([(row[0] * n[0] + row[1] * n[1]) + row[2] * n[2] for row in C], axis=1)
            moved = moved.astype(np.float64)
            moved *= np.sign(np.float64((A[0] * C[0]).sum())) or 1.0
        return unit(np.where(np.isfinite(moved).all(axis=1, keepdims=True), moved, 0.0))

    def errors_deg(self, found: Array, right: Array) -> Array:
        """Return the angles between normals (n, 3) and the right ones; NaN where one is missing.

        Of a surface that the map flattens either side may be named.
        """
        angles = angles_deg(found, right)
        if self.linear_map.rank < 3:
            angles = np.minimum(angles, 180 - angles)
        return np.where(found.any(axis=1) & right.any(axis=1), angles, np.nan)


def _product(a: float, b: Array) -> tuple[Array, Array]:
    """Return products rounded, and what was cut off, by halves of 26 bits (Dekker)."""
    (a_high, a_low), (b_high, b_low) = _halves(np.asarray(a)), _halves(b)
    rounded = a * b
    cut = a_low * b_low - (((rounded - a_high * b_high) - a_low * b_high) - a_high * b_low)
    return np.asarray(rounded), np.asarray(cut)


def _halves(a: Array) -> tuple[Array, Array]:
    moved = a * (2.0**27 + 1)
    high = moved - (moved - a)
    return high, a - high


def _sum(a: Array, b: Array) -> tuple[Array, Array]:
    """Return sums rounded, and what was cut off (Knuth)."""
    rounded = a + b
    part = rounded - a
    return rounded, (a - (rounded - part)) + (b - part)


class _AsNormals(Surface):
    """A surface that is drawn as its unit normals n, in colours (1 + n) / 2."""

    @classmethod
    def of(cls, surface: Surface) -> Surface:
        """Return another surface drawn so."""
        return cls(surface.space, surface.lighting, surface.style, surface.effects, surface.front)

    def fragment(self, fragments: Fragments) -> Array:
        """Return the colours."""
        return np.asarray((1 + unit(fragments["normal"].T).T) / 2)


@dataclass(frozen=True)
class Run:
    """The normals of a mesh under a map in one precision, None for exact: time and largest error.

    `lost` counts those that came out zero although the map leaves a normal there; `worst_deg` is
    None where there is none to compare.
    """

    precision: Precision | None
    milliseconds: float
    lost: int
    worst_deg: float | None

    @property
    def name(self) -> str:
        """Return the name of the arithmetic."""
        return "exact" if self.precision is None else np.dtype(self.precision).name

    @property
    def verdict(self) -> Verdict | None:
        """Judge whether it will do; None where the map leaves nothing to compute."""
        if self.worst_deg is None and not self.lost:
            return None
        return Verdict.WRONG if self.is_seen else Verdict.RIGHT

    @property
    def is_seen(self) -> bool:
        """True if an error can be seen."""
        return self.lost > 0 or (self.worst_deg is not None and self.worst_deg >= SEEN_DEG)

    @property
    def number(self) -> str:
        """Return the largest error as text, or how many are lost where that cannot be seen."""
        if self.lost and (self.worst_deg or 0) < SEEN_DEG:
            return f"{self.lost:,} lost"
        if self.worst_deg is None:
            return "no normal"
        digits = 1 if self.worst_deg < 1 else 2 if self.worst_deg < 100 else 3
        return f"{scientific(self.worst_deg, digits)}°"

    def told(self, linear_map: LinearMap, normals: int) -> str:
        """Tell what the number is of, and how many bits a number of this arithmetic has."""
        if self.precision is None:
            bits = max(abs(entry).bit_length() for row in linear_map.entries for entry in row)
            size = f"as many bits as it takes: {bits}"
        else:
            size = f"{np.finfo(self.precision).nmant + 1} bits in a number"
        lost = f", {self.lost:,} lost" if self.lost else ""
        return f"worst of {normals:,} normals{lost};\n{size}"


def accuracy(settings: ProofSettings) -> Proof:
    """Draw how wrong every normal of a ball comes out under one map, in four precisions."""
    world = settings.placed(hard_world())
    cofactors = Cofactors(LinearMap.of(linear_part(world.world_from_object)))
    geometry = _ball(settings)
    normals = unit(geometry.mesh().normals)
    runs = [_run(settings, cofactors, precision, normals) for precision in (*PRECISIONS, None)]
    slide = settings.slide(_title(cofactors.linear_map, runs))
    places = slide.body(BELOW).columns(len(runs), GUTTER)
    panels = [
        slide.panel(place, one.name, one.verdict, one.told(cofactors.linear_map, len(normals)))
        for place, one in zip(_of_one_size(slide.canvas, places), runs, strict=True)
    ]
    drawn = _drawn_as_it_is(slide, settings, geometry, panels[0].stage)
    directions = _directions(settings, drawn)
    right = cofactors.exactly(directions)
    shades = []
    for one, panel in zip(runs, panels, strict=True):
        found = right if one.precision is None else cofactors.rounded(one.precision, directions)
        shades.append(_put_errors(slide, panel, drawn, cofactors.errors_deg(found, right)))
        foot = panel.stage.middle[0], panel.stage.bottom - 30
        slide.canvas.text(foot, one.number, NUMBER, bold=True, align=0.5)
    _scale(
        slide, Box(slide.frame.x, places[0].bottom + 124, BAR_WIDE * slide.frame.width, BAR_HIGH)
    )
    slide.footer(
        "Each point is a direction *n*: the lighter, the farther off its normal comes out. "
        f"{COFACTOR_MULTIPLICATIONS} multiplications make each matrix."
    )
    half, single, double, _ = runs
    return Proof.of(
        settings.subject,
        slide,
        _verdict(cofactors.linear_map, single, double),
        [drawn],
        numbers={
            f"{key}_{one.name}": value
            for one in (half, single, double)
            for key, value in (("milliseconds", one.milliseconds), ("worst_deg", one.worst_deg))
        },
        max_angle_error_deg=single.worst_deg,
        max_level_difference=max(int(np.abs(one - shades[-1]).max()) for one in shades),
    )


def _run(
    settings: ProofSettings, cofactors: Cofactors, precision: Precision | None, normals: Array
) -> Run:
    right, started = cofactors.exactly(normals), settings.clock()
    found = right if precision is None else cofactors.rounded(precision, normals)
    took = (settings.clock() - started) * 1000
    angles = cofactors.errors_deg(found, right)
    known = angles[np.isfinite(angles)]
    lost = int((right.any(axis=1) & ~found.any(axis=1)).sum())
    return Run(precision, took, lost, float(known.max()) if len(known) else None)


def _of_one_size(canvas: Canvas, places: Sequence[Box]) -> list[Box]:
    """Return boxes on pixels, all of the size of the first."""
    first = canvas.on_pixels(places[0])
    return [replace(first, x=canvas.on_pixels(one).x) for one in places]


def _ball(settings: ProofSettings) -> Geometry:
    """Return the mesh that was given, or a ball with its equator where the hard map is hardest."""
    if settings.world is not None or settings.mesh is not None:
        return settings.geometry(BALL)
    ball, there = BALL.mesh(), np.array(to_floats(THERE))
    turned = ball.positions @ there  # by its transpose: the axis is the direction that is squashed
    return LoadedGeometry(replace(ball, positions=turned, normals=unit(turned)))


def _title(linear_map: LinearMap, runs: Sequence[Run]) -> str:
    if linear_map.rank < 2:
        return "Where no plane is left, no normal is"
    if not any(one.is_seen for one in runs):
        return "Here every precision will do: no normal is visibly off"
    what = "precision decides what is left of a normal"
    if linear_map.rank == 2:
        return f"Flatten a shape, and {what}"
    kappa = condition_text(linear_map)
    if kappa == "1" or kappa.startswith("1 +"):
        return what.capitalize()
    return f"Squeeze a shape {with_power(kappa)} : 1, and {what}"


def _verdict(linear_map: LinearMap, single: Run, double: Run) -> str:
    kappa = condition_text(linear_map)
    if single.worst_deg is None or double.worst_deg is None:
        return f"At κ = {kappa} no normal is left in float32 or float64."
    return (
        f"At κ = {kappa} the cofactors are up to {single.worst_deg:.2g}° off in float32, "
        f"{double.worst_deg:.2g}° in float64."
    )


def _drawn_as_it_is(
    slide: Slide, settings: ProofSettings, geometry: Geometry, stage: Box
) -> DrawnScene:
    """Draw the ball or the mesh before any map, which shows its directions."""
    scene = settings.scene(settings.object(World(), geometry, diffuse=HUED))
    plain = replace(
        scene.settings, space=Space.WORLD, shading=Shading.PHONG, normals=NormalRule.EXACT
    )
    view, lens = BEFORE.camera(settings, [loaded(scene)], stage)
    return drawn_for(slide, stage, replace(scene, settings=plain, view=view, lens=lens))


def _directions(settings: ProofSettings, drawn: DrawnScene) -> Array:
    """Return the normal (height × width, 3) of the object at each pixel; of none it is zero."""
    depth, paper = drawn.rendered.depth, np.array(drawn.loaded.settings.background)
    assert depth is not None  # it was asked for
    covered = depth.coverage[:, :, None]
    found = drawn.redrawn(_AsNormals.of).rendered.rgb - (1 - covered) * paper
    shown = np.divide(found, covered, out=np.full(found.shape, 0.5), where=covered > 0)
    in_world = unit(2 * shown.reshape(-1, 3) - 1)
    return np.asarray(in_world @ np.array(to_floats(linear_part(settings.object_turn))))


def _put_errors(slide: Slide, panel: Panel, drawn: DrawnScene, angle_deg: Array) -> Array:
    """Lay errors (height × width) on a stage, on the scale of all; return their 8-bit levels."""
    depth = drawn.rendered.depth
    assert depth is not None  # it was asked for
    angles = angle_deg.reshape(depth.coverage.shape)
    parts = _part(np.where(np.isfinite(angles), angles, LEAST_DEG))
    known = np.isfinite(angles) * depth.coverage
    put_map(slide, panel, drawn, parts, known).outline()
    return levels(parts).astype(int)


def _part(angle_deg: Array) -> Array:
    """Return the place of angles on the logarithmic scale, from 0 to 1."""
    inside = np.clip(angle_deg, LEAST_DEG, MOST_DEG)
    return np.asarray(np.log10(inside / LEAST_DEG) / log10(MOST_DEG / LEAST_DEG))


def _scale(slide: Slide, bar: Box) -> None:
    """Draw the scale of all four maps, with a mark where errors begin to be seen."""
    canvas, palette = slide.canvas, slide.palette
    ramp(canvas, bar)
    for tick in TICKS:
        x = bar.x + float(_part(np.array(tick))) * bar.width
        up = 26 if tick == SEEN_DEG else 0
        canvas.stroke(((x, bar.y - up), (x, bar.bottom + 8)), 3.0, palette.ink, round_ends=False)
        align = 0.0 if tick == LEAST_DEG else 1.0 if tick == MOST_DEG else 0.5
        words = f"{scientific(tick)}°"
        canvas.text((x, bar.bottom + 34), words, CAPTION, palette.soft, align=align)
        if up:
            canvas.text((x + 10, bar.y - 10), "can be seen →", CAPTION, bold=True)
