"""A map from above in the corner of a picture: the eye sees the picture and is not in it."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas import glyphs
from nmatrix.canvas.marks import Box
from nmatrix.canvas.text import width
from nmatrix.enums import DepthRange
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.overlay.labels import Labels
from nmatrix.raster.overlay.stage import Stage

Array = NDArray[Any]

PART, LARGEST = 0.34, 300.0  # of the shorter side of the picture, and units
MARGIN, PAD = 14.0, 30.0
EYE, LAMP = 15.0, 7.0
ENDLESS = 1e6  # of what is known: a corner so far away, or at infinity, is put there
TITLE = "from above"
DIRECTIONS = 72  # in which the outline of a body is looked for


def eye_map(stage: Stage, labels: Labels) -> Box:
    """Draw the bodies, the eye, what it sees and the lamps from above, in the lower left corner.

    Returns the box of the map.
    """
    canvas, palette = stage.canvas, stage.canvas.palette
    side = min(LARGEST, PART * min(canvas.width, canvas.height))
    box = Box(MARGIN, canvas.height - MARGIN - side, side, side)
    labels.cover(box)
    canvas.polygon(box.corners, fill=palette.paper, edge=palette.ink, width=1.6)
    outlines = [_outline(body) for body in stage.loaded.bodies]
    near, far = _sight(stage)
    eye, ahead = _from_above(stage.eye), far.mean(axis=0) - near.mean(axis=0)
    known = np.concatenate([*outlines, [eye]])
    low, high = known.min(axis=0), known.max(axis=0)
    scale = (side - 2 * PAD) / (float((high - low).max()) or 1.0)
    middle = np.array(box.middle)

    def put(points: Array) -> Array:
        return np.asarray((points - (low + high) / 2) * scale + middle)

    inner = box.inset(1.6)
    wedge = _clipped(put(_convex(np.concatenate([near, far]))), inner)
    if len(wedge) > 2:
        canvas.polygon(wedge, fill=palette.eye, opacity=0.2)
    for outline in outlines:
        canvas.polygon(put(outline), fill=palette.body, edge=palette.ink, width=1.6)
    for one in stage.loaded.lights:
        if one.position is not None:
            place = put(_from_above(np.array([float(x) for x in one.position])))
            if inner.holds(tuple(place)):
                glyphs.disc(canvas, tuple(place), LAMP, palette.light, palette.ink)
    glyphs.eye(canvas, tuple(put(eye)), tuple(ahead), EYE)
    if width(TITLE, labels.size) <= side:
        labels.letter((box.x + side / 2, box.y - 14), TITLE)
    return box


def _from_above(points: Array) -> Array:
    """Return x to the right and z towards the reader of points (…, 3) of the world."""
    return np.asarray(points[..., [0, 2]])


def _outline(body: Body) -> Array:
    """Return the corners (k, 2) of a convex outline of a body from above."""
    turns = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
    points = _from_above(body.positions_world)
    ways = np.stack([np.cos(turns), np.sin(turns)])
    return np.array([points[int((points @ way).argmax())] for way in ways.T])


def _sight(stage: Stage) -> tuple[Array, Array]:
    """Return the near and the far corners (4, 2) of what the eye sees, from above."""
    loaded = stage.loaded
    corners = loaded.frustum.corners
    if loaded.clip.depth is DepthRange.REVERSED:
        corners = corners[[i ^ 1 for i in range(len(corners))]]  # so far is the second of a pair
    place, w = corners[:, :3], corners[:, 3:]
    known = [stage.eye, *(one.positions_world for one in loaded.bodies)]
    reach = ENDLESS * (1.0 + max(float(np.abs(one).max(initial=0.0)) for one in known))
    long = np.abs(place).max(axis=1, keepdims=True)
    is_endless = w * reach <= long
    at = np.where(is_endless, stage.eye + reach * place / long, place / np.where(is_endless, 1, w))
    return _from_above(at[::2]), _from_above(at[1::2])


def _convex(points: Array) -> Array:
    """Return the corners (k, 2) of the least convex outline around points (n, 2)."""
    found: list[Array] = []
    ordered = points[np.lexsort(points.T[::-1])]
    for way in (ordered, ordered[::-1]):
        half: list[Array] = []
        for one in way:
            while len(half) > 1 and _turn(half[-2], half[-1], one) <= 0:
                half.pop()
            half.append(one)
        found += half[:-1]
    return np.array(found)


def _turn(a: Array, b: Array, c: Array) -> float:
    """Return a positive number if the way from a over b to c turns to the left."""
    u, v = b - a, c - a
    return float(u[0] * v[1] - u[1] * v[0])


def _clipped(loop: Array, box: Box) -> Array:
    """Cut a polygon (n, 2) by the four sides of a box."""
    for axis, limit, sign in (
        (0, box.x, 1),
        (0, box.right, -1),
        (1, box.y, 1),
        (1, box.bottom, -1),
    ):
        inside = sign * (loop[:, axis] - limit)
        kept = []
        for i in range(len(loop)):
            a, b, p, q = loop[i - 1], loop[i], inside[i - 1], inside[i]
            if (p < 0) != (q < 0):
                kept.append(a + (b - a) * (p / (p - q)))
            if q >= 0:
                kept.append(b)
        loop = np.array(kept).reshape(-1, 2)
    return loop
