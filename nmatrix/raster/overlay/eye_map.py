"""A map from above in the corner of a picture: the eye sees the picture and is not in it."""

from __future__ import annotations

from math import hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas import glyphs
from nmatrix.canvas.marks import Box
from nmatrix.canvas.text import width
from nmatrix.enums import DepthRange
from nmatrix.linear import rational
from nmatrix.linear.rational import to_floats
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.overlay.labels import Labels
from nmatrix.raster.overlay.stage import Stage

Array = NDArray[Any]

PART, LARGEST = 0.34, 300.0  # of the shorter side of the picture, and units
MARGIN, PAD = 14.0, 30.0
EYE, LAMP = 15.0, 7.0
NEAREST = {
    DepthRange.MINUS_ONE_TO_ONE: -1.0,
    DepthRange.ZERO_TO_ONE: 0.0,
    DepthRange.REVERSED: 1.0,
}
FARTHER = 0.5  # a depth between near and far in every range
TITLE = "from above"
DIRECTIONS = 72  # in which the outline of a body is looked for


def eye_map(stage: Stage, labels: Labels) -> None:
    """Draw the bodies, the eye, what it sees and the lamps from above, in the lower left corner."""
    canvas, palette = stage.canvas, stage.canvas.palette
    side = min(LARGEST, PART * min(canvas.width, canvas.height))
    box = Box(MARGIN, canvas.height - MARGIN - side, side, side)
    labels.cover(box)
    canvas.polygon(box.corners, fill=palette.paper, edge=palette.ink, width=1.6)
    outlines = [_outline(body) for body in stage.loaded.bodies]
    sight = _sight(stage)
    eye, ahead = _from_above(stage.eye), _from_above(sight[1].mean(axis=0) - sight[0].mean(axis=0))
    known = np.concatenate([*outlines, [eye]])
    low, high = known.min(axis=0), known.max(axis=0)
    scale = (side - 2 * PAD) / (float((high - low).max()) or 1.0)
    middle = np.array(box.middle)

    def put(points: Array) -> Array:
        return np.asarray((points - (low + high) / 2) * scale + middle)

    inner = box.inset(1.6)
    (left, right), (far_left, far_right) = put(_from_above(sight))
    far = 4 * side / max(1e-9, hypot(*(far_left - left)))  # beyond the map
    ends = [left, left + far * (far_left - left), right + far * (far_right - right), right]
    wedge = _clipped(np.array(ends), inner)
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


def _from_above(points: Array) -> Array:
    """Return x to the right and z towards the reader of points (…, 3) of the world."""
    return np.asarray(points[..., [0, 2]])


def _outline(body: Body) -> Array:
    """Return the corners (k, 2) of a convex outline of a body from above."""
    turns = np.linspace(0, 2 * np.pi, DIRECTIONS, endpoint=False)
    points = _from_above(body.positions_world)
    ways = np.stack([np.cos(turns), np.sin(turns)])
    return np.array([points[int((points @ way).argmax())] for way in ways.T])


def _sight(stage: Stage) -> Array:
    """Return where sight at the left and the right begins, and a place farther on: (2, 2, 3).

    It begins on the near plane.
    """
    world_from_clip = np.array(to_floats(rational.inverse(stage.loaded.clip_from_world)))
    found = []
    for depth in (NEAREST[stage.loaded.clip.depth], FARTHER):
        world = np.array([[-1.0, 0.0, depth, 1.0], [1.0, 0.0, depth, 1.0]]) @ world_from_clip.T
        found.append(world[:, :3] / world[:, 3:])
    return np.stack(found)


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
