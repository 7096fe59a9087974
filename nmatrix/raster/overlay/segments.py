"""Many straight lines of the world at once: cut to what the eye sees, and hidden parts left out.

A line is cut before it is divided by w, so one that passes beside the eye or behind it is drawn as
far as it is in front. What is left is straight on the canvas, and its depth is linear along it.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange
from nmatrix.raster.overlay.mesh_lines import seen
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.triangles.run_expansion import RunExpansion

Array = NDArray[Any]


def in_view(stage: Stage, a: Array, b: Array, pad: float = 0.0) -> tuple[Array, Array]:
    """Cut lines from a to b (n, 3) of the world to the picture; return their ends (m, 3).

    They stay so many units inside. Lines without a part there are left out.
    """
    M = stage.clip_from_world
    first, last = (M[:, :3] @ one.T + M[:, 3:] for one in (a, b))
    start, end = np.zeros(len(a)), np.ones(len(a))
    for p, q in zip(_inside(stage, first, pad), _inside(stage, last, pad), strict=True):
        part = np.divide(p, p - q, out=np.zeros_like(p), where=p != q)
        start = np.where(p < 0, np.maximum(start, part), start)
        end = np.where(q < 0, np.minimum(end, part), end)
        end = np.where((p < 0) & (q < 0), -1.0, end)
    kept = start < end
    along = (b - a)[kept]
    return a[kept] + along * start[kept, None], a[kept] + along * end[kept, None]


def _inside(stage: Stage, clip: Array, pad: float) -> tuple[Array, ...]:
    """Return the distances of clip points to the picture's planes, negative beyond them."""
    x, y, z, w = clip
    near = {
        DepthRange.MINUS_ONE_TO_ONE: z + w,
        DepthRange.ZERO_TO_ONE: z,
        DepthRange.REVERSED: w - z,
    }[stage.loaded.clip.depth]
    wide, high = (w * (1 - 2 * pad / side) for side in (stage.box.width, stage.box.height))
    return near, wide + x, wide - x, high + y, high - y


def seen_pieces(stage: Stage, a: Array, b: Array) -> Array:
    """Return the pieces (k, 2, 2), on the canvas, of lines (n, 3) that no surface hides.

    Each is looked at once a pixel.
    """
    first, last = (stage.pixels(stage.window(one)) for one in in_view(stage, a, b))
    steps = np.ceil(np.abs(last - first)[:, :2].max(axis=1, initial=0.0)).astype(np.intp) + 1
    runs = RunExpansion(steps + 1)
    growth = (last - first) / steps[:, None]
    samples = runs.ramps(first.T, growth.T).T
    line = runs.each(np.arange(len(steps)))
    is_seen = seen(samples, stage.depth.farthest)
    before = np.concatenate([[False], is_seen[:-1] & (line[1:] == line[:-1])])
    after = np.concatenate([is_seen[1:] & (line[1:] == line[:-1]), [False]])
    begins, ends = (np.flatnonzero(is_seen & ~one) for one in (before, after))
    longer = begins < ends
    pieces = np.stack([samples[begins[longer], :2], samples[ends[longer], :2]], axis=1)
    return stage.from_pixels(pieces)
