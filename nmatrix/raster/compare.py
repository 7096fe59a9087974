"""One mesh under two normal rules: both pictures, and the angle between the rules at each pixel.

Everything is accumulated band by band; nothing here grows with the number of samples.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Shading
from nmatrix.raster.draw import Frame, Projected
from nmatrix.raster.normals import angles_deg, turned_towards, unit
from nmatrix.raster.shade import Lighting
from nmatrix.scene.mesh import Mesh

Array = NDArray[Any]

CANCELLED = 1e-12  # an interpolated normal this short is rounding, not a direction


@dataclass(frozen=True, eq=False)
class Subject:
    """A mesh with its vertices in world space and their unit normals by the two rules.

    Both sides of a flat one are alike: normals count up to their sign.
    """

    mesh: Mesh
    positions: Array
    wrong: Array
    right: Array
    is_flat: bool


@dataclass(frozen=True, eq=False)
class Comparison:
    """Images (height, width) and the statistics over the covered samples.

    `wrong` and `right` are grey levels times coverage; `angle_deg` is the mean over the samples
    of a pixel that have both normals, which are the part `compared` of it.
    """

    wrong: Array
    right: Array
    covered: Array
    compared: Array
    angle_deg: Array
    worst_deg: float | None
    mean_deg: float | None
    fragments: int
    visible_samples: int


@dataclass(frozen=True, eq=False)
class _Band:
    images: tuple[Array, ...]
    angles: Array
    fragments: int
    samples: int


def compare(
    subject: Subject, projected: Projected, lighting: Lighting, shading: Shading
) -> Comparison:
    """Draw a mesh under both rules, and measure the angle between them where it is seen."""
    bands = [_band(subject, frame, lighting, shading) for frame in projected.bands()]
    wrong, right, covered, compared, total = (
        np.concatenate([band.images[i] for band in bands]) for i in range(5)
    )
    count = sum(len(band.angles) for band in bands)
    added = sum(float(band.angles.sum()) for band in bands)
    worst = max((float(band.angles.max()) for band in bands if len(band.angles)), default=None)
    return Comparison(
        wrong,
        right,
        covered,
        compared,
        np.divide(total, compared, out=np.zeros_like(total), where=compared > 0),
        worst,
        added / count if count else None,
        sum(band.fragments for band in bands),
        sum(band.samples for band in bands),
    )


def _band(subject: Subject, frame: Frame, lighting: Lighting, shading: Shading) -> _Band:
    pictures = [
        frame.resolve(_light(subject, frame, lighting, shading, normals))
        for normals in (subject.wrong, subject.right)
    ]
    a, b = (_interpolated(subject.mesh, frame, n) for n in (subject.wrong, subject.right))
    both = np.asarray(a.any(axis=1) & b.any(axis=1))
    angles = np.asarray(angles_deg(a, b) * both)
    if subject.is_flat:
        angles = np.minimum(angles, 180 - angles)
    images = (
        *pictures,
        frame.resolve(np.ones(len(angles))),
        frame.resolve(both.astype(np.float64)),
        frame.resolve(angles),
    )
    return _Band(images, angles[both], frame.fragments, len(frame.pixel))


def _light(
    subject: Subject, frame: Frame, lighting: Lighting, shading: Shading, normals: Array
) -> Array:
    mesh = subject.mesh
    if shading is Shading.GOURAUD:
        return frame.interpolate(mesh, lighting.shade(normals, subject.positions)[:, None])[:, 0]
    if shading is Shading.FLAT:
        seen = unit(normals[mesh.triangles[frame.triangle]].mean(axis=1), CANCELLED)
    else:
        seen = _interpolated(mesh, frame, normals)
    at = frame.interpolate(mesh, subject.positions)
    return lighting.shade(turned_towards(seen, lighting.eye - at) if subject.is_flat else seen, at)


def _interpolated(mesh: Mesh, frame: Frame, normals: Array) -> Array:
    return unit(frame.interpolate(mesh, normals), CANCELLED)
