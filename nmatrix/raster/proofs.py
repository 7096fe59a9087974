"""Proof images: a picture whose claim is a number, and the number beside it.

`normals`: the same mesh lit with A n, with the right normals, and a map of the angle between.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Shading
from nmatrix.linear import rational
from nmatrix.linear.classify import classify
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import to_floats
from nmatrix.raster.draw import Canvas, Frame, draw
from nmatrix.raster.image import Legend, Panel, compose, levels, png
from nmatrix.raster.normals import angles_deg, moved_by_matrix, outward, unit
from nmatrix.raster.shade import Lighting
from nmatrix.scene.mesh import Mesh
from nmatrix.spaces.stage import Stage

Array = NDArray[Any]

BACKGROUND = 0.93
# Dark to light, blue to yellow: the order survives a greyscale print and colour blindness.
HEAT = ((13, 8, 80), (78, 35, 140), (158, 50, 128), (214, 92, 82), (248, 160, 48), (250, 240, 110))
HEAT_STEPS = 256
RIGHT_TITLE = ("Right: A⁻ᵀ n", "the inverse transpose carries them")
FLAT_TITLE = ("Right: C n, two-sided", "no inverse is left; the cofactors carry them")


@dataclass(frozen=True)
class Setup:
    """How to draw: size of a panel, where lighting is evaluated, what clip space is."""

    canvas: Canvas
    clip: ClipSpace
    shading: Shading = Shading.PHONG


@dataclass(frozen=True, eq=False)
class Proof:
    """A finished picture and the numbers that it shows."""

    image: Array
    subject: str
    max_angle_error_deg: float | None
    mean_angle_error_deg: float | None
    max_level_difference: int
    triangles: int
    fragments: int
    work: dict[str, int]

    def png(self) -> bytes:
        """Return the picture as PNG, its numbers in text chunks."""
        texts = {
            "Title": f"nmatrix normals: {self.subject}",
            "max_angle_error_deg": repr(self.max_angle_error_deg),
            "mean_angle_error_deg": repr(self.mean_angle_error_deg),
            "max_level_difference": str(self.max_level_difference),
            "triangles": str(self.triangles),
            "fragments": str(self.fragments),
        }
        return png(self.image, texts)


def normals_proof(
    mesh: Mesh, subject: str, stage: Stage, lighting: Lighting, setup: Setup
) -> Proof:
    """Draw a mesh with wrong and with right normals, and the angle between them.

    The angle is measured at every covered sample between the two interpolated normals.
    """
    frame = draw(mesh, to_floats(stage.clip_from_object), setup.canvas, setup.clip)
    linear_map = stage.world_from_object.linear_map
    right = outward(linear_map, mesh.normals)
    wrong = moved_by_matrix(linear_map, mesh.normals)
    pictures = [_lit(mesh, frame, stage, lighting, setup, n) for n in (wrong, right)]
    angles, defined = _angles(mesh, frame, wrong, right)
    is_flat = not linear_map.integer_determinant
    if is_flat:
        angles = np.minimum(angles, 180 - angles)
    worst = float(angles[defined].max()) if defined.any() else None
    mean = float(angles[defined].mean()) if defined.any() else None
    heat = _heat(frame, angles, defined, worst or 0.0)
    shown = [levels(picture) for picture in pictures]
    difference = int(np.abs(shown[0].astype(int) - shown[1]).max())
    panels = (
        Panel(shown[0], "Wrong: A n", "the matrix itself carries the normals"),
        Panel(shown[1], *(FLAT_TITLE if is_flat else RIGHT_TITLE)),
        Panel(levels(heat), "Angle between them", _angle_caption(worst, mean)),
    )
    legend = Legend(_heat_scale(), f"{worst or 0.0:.1f}", "°")
    return Proof(
        image=compose(_title(subject, stage), panels, legend),
        subject=subject,
        max_angle_error_deg=worst,
        mean_angle_error_deg=mean,
        max_level_difference=difference,
        triangles=frame.triangles,
        fragments=frame.fragments,
        work=_work(mesh, frame),
    )


def _lit(
    mesh: Mesh, frame: Frame, stage: Stage, lighting: Lighting, setup: Setup, normals: Array
) -> Array:
    M = np.array(stage.world_from_object.matrix)
    positions = mesh.positions @ M[:3, :3].T + M[:3, 3]
    if setup.shading is Shading.GOURAUD:
        grey = lighting.shade(normals, positions)[:, None]
        shade = frame.interpolate(mesh, grey)[:, 0]
    else:
        at = frame.interpolate(mesh, positions)
        found = _sample_normals(mesh, frame, setup.shading, normals)
        if not stage.world_from_object.linear_map.integer_determinant:
            found = _towards(found, lighting.eye - at)
        shade = lighting.shade(found, at)
    return frame.picture(np.repeat(shade[:, None], 3, axis=1), BACKGROUND)


def _towards(normals: Array, to_eye: Array) -> Array:
    """Return normals of a flattened surface on the side that is seen: both sides are alike."""
    behind = (normals * to_eye).sum(axis=1, keepdims=True) < 0
    return np.asarray(np.where(behind, -normals, normals))


def _sample_normals(mesh: Mesh, frame: Frame, shading: Shading, normals: Array) -> Array:
    if shading is Shading.FLAT:
        return unit(normals[mesh.triangles[frame.triangle]].mean(axis=1))
    return unit(frame.interpolate(mesh, normals))


def _angles(mesh: Mesh, frame: Frame, wrong: Array, right: Array) -> tuple[Array, Array]:
    """Return the angle at each sample, and where both normals exist."""
    a, b = unit(frame.interpolate(mesh, wrong)), unit(frame.interpolate(mesh, right))
    return angles_deg(a, b), np.asarray(a.any(axis=1) & b.any(axis=1))


def _heat(frame: Frame, angles: Array, defined: Array, worst: float) -> Array:
    scale = np.array(_heat_scale()) / 255
    part = angles / worst if worst > 0 else np.zeros_like(angles)
    colours = scale[np.rint(part * (HEAT_STEPS - 1)).astype(np.intp).clip(0, HEAT_STEPS - 1)]
    colours[~defined] = 0.5
    return frame.picture(colours, BACKGROUND)


def _heat_scale() -> tuple[tuple[int, int, int], ...]:
    stops = np.linspace(0, 1, len(HEAT))
    at = np.linspace(0, 1, HEAT_STEPS)
    channels = [np.interp(at, stops, [stop[i] for stop in HEAT]) for i in range(3)]
    red, green, blue = (np.rint(channel).astype(int).tolist() for channel in channels)
    return tuple(zip(red, green, blue, strict=True))


def _angle_caption(worst: float | None, mean: float | None) -> str:
    if worst is None or mean is None:
        return "no normal is left to compare"
    return f"worst {worst:.2f}°, mean {mean:.2f}° over the covered pixels"


def _title(subject: str, stage: Stage) -> str:
    found = classify(stage.world_from_object.exact, stage.tolerance)
    kind = found.kind.value.replace("-", " ")
    if found.condition is None:
        return f"{subject}: {kind}, rank {found.rank}"
    bound = found.worst_angle_deg or 0.0
    return f"{subject}: {kind}, κ = {float(found.condition):.4g}, bound {bound:.2f}°"


def _work(mesh: Mesh, frame: Frame) -> dict[str, int]:
    """Count what was computed: the multiplications of vertices and of visible samples."""
    vertices, samples = len(mesh.positions), len(frame.pixel)
    return {
        "vertices": vertices,
        "triangles": frame.triangles,
        "fragments": frame.fragments,
        "visible_samples": samples,
        "multiplications": vertices * (16 + 2 * 9) + samples * 3 * (9 + 6 + 3),
    }


def bounding_ball(mesh: Mesh, stage: Stage) -> tuple[Array, float]:
    """Return a ball around the mesh in world space."""
    M = np.array(to_floats(stage.world_from_object.exact))
    moved = mesh.positions @ M[:3, :3].T + M[:3, 3]
    centre = (moved.min(axis=0) + moved.max(axis=0)) / 2
    radius = float(np.sqrt(((moved - centre) ** 2).sum(axis=1).max()))
    return centre, radius or 1.0


def fitted_eye(centre: Array, radius: float, half_fov: float) -> tuple[Array, float, float]:
    """Return an eye that sees the whole ball, and near and far around it."""
    direction = unit(np.array([[0.45, 0.35, 1.0]]))[0]
    distance = radius / np.sin(half_fov) * 1.05
    return centre + direction * distance, distance - radius * 1.02, distance + radius * 1.02


def as_array(vector: rational.RationalVector | None) -> Array | None:
    """Return an exact vector as floats."""
    return None if vector is None else np.array([float(Fraction(x)) for x in vector])
