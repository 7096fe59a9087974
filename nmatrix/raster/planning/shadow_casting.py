"""Who casts a shadow on whom, and the views from lamps that are fitted to just that.

Bodies stand for the boxes around them, and what is seen of them is the box within the camera's
frustum. Of each view a rectangle is enough in which something that casts and something seen that it
can fall on overlap, as the lamp sees them.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import inf, radians, tan
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange, Handedness, NormalRule
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector
from nmatrix.linear.view import looking_along
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.shading.shadow import LightView
from nmatrix.raster.shading.space import as_array, column
from nmatrix.raster.triangles.convex import NEAR_CORNERS, frustum
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.meshes.shell import Shell
from nmatrix.scene.words import Sides

Array = NDArray[Any]

FLAT = 1e-7  # of the radius: what lies this close to a plane stands in no texel's slack of itself
TOUCHING = 1e-6  # of the radius: what sinks in no deeper stands on a plane; texels are larger
NEAREST = 1e-3  # of the farthest distance: what stands closer to a lamp casts no shadow
WIDEST = 60.0  # degrees from the axis: wider cones are seen in six ways, as points are
COARSE = 2.0  # pixels: the steps of wider texels are seen
BORDER = 2  # texels around what is fitted, so that all that have a say are there
UP: RationalVector = rational_vector((0, 1, 0))
SIX_WAYS = tuple(
    rational_vector(way)
    for way in ((1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1))
)


def occluders(loaded: LoadedScene, placed: PlacedLight, body: Body) -> Iterator[Body]:
    """Yield the bodies that can keep a lamp's light off what is seen of a body, never one too few.

    Whether they are opaque is not asked.
    """
    seen = body.hull.meeting(loaded.frustum)
    if len(seen):
        for one in loaded.bodies:
            if (
                _can_shade_itself(loaded, body)
                if one is body
                else _is_between(placed, one, body, seen)
            ):
                yield one


def _is_between(placed: PlacedLight, caster: Body, body: Body, seen: Array) -> bool:
    """Return False if a plane has a caster on one side, and what is seen and the lamp on the other.

    Then no way from there to the lamp meets the caster. The planes of both boxes are tried, and
    spheres first.
    """
    if not _spheres_meet(placed, caster, body):
        return False
    planes = np.concatenate([caster.hull.planes, body.hull.planes, -body.hull.planes])
    touching = TOUCHING * body.radius
    apart = (seen @ planes.T <= touching * seen[:, 3:]).all(axis=0)
    apart &= (caster.hull.corners @ planes.T >= -touching).all(axis=0)
    apart &= planes @ _lamp(placed) <= touching
    return not apart.any()


def _lamp(placed: PlacedLight) -> Array:
    """Return where light comes from: a point (w = 1), or a direction (w = 0)."""
    if placed.position is not None:
        return np.append(column(placed.position)[:, 0], 1.0)
    assert placed.direction is not None  # a light is somewhere or comes from somewhere
    travel = column(placed.direction)[:, 0]
    return np.append(-travel / np.sqrt(travel @ travel), 0.0)


def _spheres_meet(placed: PlacedLight, caster: Body, body: Body) -> bool:
    """Return False if the ball around a caster is clear of all ways from another to the lamp."""
    reach = caster.radius + body.radius
    way, lamp = caster.centre - body.centre, _lamp(placed)
    if placed.position is None:
        ahead = float(way @ lamp[:3])
        aside = float(np.sqrt(max(0.0, way @ way - ahead * ahead)))
        return ahead > -reach and aside < reach
    to_light = lamp[:3] - body.centre
    size = float(to_light @ to_light)
    share = float(np.clip(way @ to_light / size, 0.0, 1.0)) if size else 0.0
    nearest = way - share * to_light
    return float(np.sqrt(nearest @ nearest)) < reach


def _can_shade_itself(loaded: LoadedScene, body: Body) -> bool:
    """Return False for flat bodies, and for boxes seen from outside: there n·l ≤ 0 says it all."""
    return body.thickness > FLAT * body.radius and not (
        body.mesh.is_box
        and body.mesh.shell is Shell.SOLID
        and loaded.settings.normals is NormalRule.EXACT
        and body.linear_map.rank == 3
        and body.material.sides is not Sides.BOTH
        and body.material.normal_map is None
        and body.material.alpha_cutoff is None
        and _is_seen_from_outside(loaded, body)
    )


def _is_seen_from_outside(loaded: LoadedScene, body: Body) -> bool:
    """Return True if a face of a box has all of the near plane's window on its outer side.

    Every ray of the camera then begins outside, and meets a front first.
    """
    window = loaded.frustum.corners[NEAR_CORNERS]
    return bool((window @ body.hull.planes.T < 0).all(axis=0).any())


class Footprint(NamedTuple):
    """What a lamp sees of a set: the rectangle around it, and the distances along the axis."""

    low: Array
    high: Array
    nearest: float
    farthest: float

    def meets(self, other: Footprint) -> bool:
        """Return True if two rectangles overlap, and this set begins before the other one ends."""
        overlap = np.maximum(self.low, other.low) < np.minimum(self.high, other.high)
        return bool(overlap.all()) and self.nearest < other.farthest


@dataclass(frozen=True)
class Aim:
    """A way to look from a lamp: rows right, up and ahead, and how far aside is looked at all.

    `half` is the tangent of the widest angle of a perspective, and None for a parallel view.
    """

    axes: RationalMatrix
    half: float | None

    def footprint(self, points: Array) -> Footprint | None:
        """Return the footprint of the hull of points (n, 4), or None where it is out of view."""
        x, y, ahead, one = as_array(self.axes) @ points.T
        if self.half is None:
            placed = np.stack([x, y, ahead]) / one
            return Footprint(
                placed[:2].min(axis=1), placed[:2].max(axis=1), placed[2].min(), placed[2].max()
            )
        nearest = NEAREST * float((ahead / one).max())
        if nearest <= 0.0:
            return None
        x, y, ahead, one = _cut(np.stack([x, y, ahead, one]), nearest)
        low, high = (np.array([f(x / ahead), f(y / ahead)]) for f in (np.min, np.max))
        low, high = np.maximum(low, -self.half), np.minimum(high, self.half)
        if not (low < high).all():
            return None
        distances = ahead / one
        return Footprint(low, high, float(distances.min()), float(distances.max()))


def _cut(points: Array, nearest: float) -> Array:
    """Return points (4, n) whose hull is that of given ones beyond the nearest distance."""
    beyond = points[2] - nearest * points[3]
    if (beyond >= 0).all():
        return points
    kept, cut = points[:, beyond >= 0], points[:, beyond < 0]
    a, b = beyond[beyond >= 0][:, None], beyond[beyond < 0]
    share = a / (a - b)
    crossing = kept[:, :, None] * (1 - share) + cut[:, None, :] * share
    return np.concatenate([kept, crossing.reshape(4, -1)], axis=1)


def light_views(
    loaded: LoadedScene, placed: PlacedLight, casting: Mapping[Body, Sequence[Body]]
) -> tuple[LightView, ...]:
    """Fit the views of a lamp to what is seen of bodies, and to what can cast a shadow on each."""
    if not casting:
        return ()
    found = (_fitted(loaded, aim, casting) for aim in _aims(placed, [*casting]))
    return tuple(one for one in found if one is not None)


def _aims(placed: PlacedLight, receivers: Sequence[Body]) -> list[Aim]:
    place, half = placed.position, None
    if place is None:
        assert placed.direction is not None  # a light is somewhere or from somewhere
        return [Aim(_axes(rational_vector(receivers[0].centre.tolist()), placed.direction), None)]
    if placed.direction is not None and placed.light.cone_degrees[1] <= WIDEST:
        half = tan(radians(placed.light.cone_degrees[1]))
        return [Aim(_axes(place, placed.direction), half)]
    return [Aim(_axes(place, way), 1.0) for way in SIX_WAYS]


def _axes(place: RationalVector, direction: RationalVector) -> RationalMatrix:
    """Return the rows of x, y and of the distance ahead."""
    right, up, back, last = looking_along(place, direction, UP, Handedness.RIGHT).camera_from_world
    return right, up, tuple(-entry for entry in back), last


def _fitted(
    loaded: LoadedScene, aim: Aim, casting: Mapping[Body, Sequence[Body]]
) -> LightView | None:
    """Return the view that holds all shadows, or None if there are none in this direction."""
    of_casters = {
        one: aim.footprint(one.hull.corners) for casters in casting.values() for one in casters
    }
    low, high, far, casters = np.full(2, inf), np.full(2, -inf), -inf, {}
    for body, ones in casting.items():
        seen = aim.footprint(body.hull.meeting(loaded.frustum)) if ones else None
        for one in ones:
            footprint = of_casters[one]
            if seen is not None and footprint is not None and footprint.meets(seen):
                low = np.minimum(low, np.maximum(footprint.low, seen.low))
                high = np.maximum(high, np.minimum(footprint.high, seen.high))
                casters[one] = footprint
                far = max(far, footprint.farthest, seen.farthest)
    if not casters:
        return None
    near = min(one.nearest for one in casters.values())
    return _view(aim, Footprint(low, high, near, far), tuple(casters), loaded.settings.shadow_map)


def _view(aim: Aim, shadows: Footprint, casters: tuple[Body, ...], size: int) -> LightView:
    """Return the view of a footprint, and of a border around it."""
    reach = (shadows.high - shadows.low) / 2 * (size / max(size - 2 * BORDER, 1))
    middle = (shadows.low + shadows.high) / 2
    texel = 2 * float(reach.max()) / size
    pad = texel * (1.0 if aim.half is None else shadows.nearest) / 2
    right, up, ahead, last = aim.axes
    w = last if aim.half is None else ahead
    rows = (
        tuple((a - Fraction(c) * b) / Fraction(r) for a, b in zip(axis, w, strict=True))
        for axis, c, r in zip((right, up), middle.tolist(), reach.tolist(), strict=True)
    )
    near, far = shadows.nearest - pad, shadows.farthest + pad
    return LightView((*rows, ahead, w), near, far, texel, casters)


def texel_in_pixels(loaded: LoadedScene, view: LightView, receivers: Sequence[Body]) -> float:
    """Return the most pixels that a texel is wide where shadows may be seen."""
    clip = view.clip_from(rational.identity(4))
    lit = frustum(clip, np.linalg.inv(clip), DepthRange.ZERO_TO_ONE)
    x, y, _, w = as_array(loaded.clip_from_world)
    width, height = loaded.settings.size
    scale = max(
        width * float(np.sqrt(x @ x - x[3] ** 2)), height * float(np.sqrt(y @ y - y[3] ** 2))
    )
    most = 0.0
    for body in receivers:
        seen = body.hull.meeting(loaded.frustum, lit)
        if len(seen):
            most = max(most, float(((seen @ clip[3]) / (seen @ w)).max()))
    return most * view.texel * scale / 2


def shadow_remarks(
    loaded: LoadedScene, placed: PlacedLight, receivers: Sequence[Body], views: Sequence[LightView]
) -> Iterator[str]:
    """Yield what a lamp's shadows lack: fine texels, and the shadows of what is not opaque."""
    coarsest = max((texel_in_pixels(loaded, one, receivers) for one in views), default=0.0)
    if coarsest > COARSE:
        yield (
            f"Shadows of {placed.light.name}: a texel is {coarsest:.2g} pixels wide; "
            "a larger shadow_map makes them finer."
        )
    for body in receivers:
        for one in occluders(loaded, placed, body):
            if one.material.is_clear and one is not body:
                yield f"The shadow of {one.name} is not cast: its opacity is below 1."
