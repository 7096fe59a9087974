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
from nmatrix.errors import NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.classify import classify
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import to_floats
from nmatrix.raster.compare import Comparison, Subject, compare
from nmatrix.raster.draw import Canvas, project
from nmatrix.raster.heat import ROUNDING_DEG, UNDEFINED, Scale
from nmatrix.raster.image import Panel, compose, levels, png
from nmatrix.raster.normals import moved_by_matrix, outward, turned_towards, unit
from nmatrix.raster.shade import Lighting
from nmatrix.scene.mesh import Mesh
from nmatrix.spaces.stage import Stage

Array = NDArray[Any]

BACKGROUND = 0.93
FARTHEST = 1e100

# What the right rule is called, by the rank of A.
RIGHT_RULE = {
    3: ("Right: A⁻ᵀ n", "the inverse transpose carries them"),
    2: ("Right: C n, two-sided", "no inverse is left; the cofactors carry them"),
}
NO_RULE = ("Right: none", "no plane is left to be normal to")


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

    Raises
    ------
    NoAnswerError
        If the mesh or the eye is so far or so small in the world that float64 cannot draw it.
    """
    carried = subject_in_world(mesh, stage)
    projected = project(mesh, to_floats(stage.clip_from_object), setup.canvas, setup.clip)
    found = compare(carried, projected, lighting, setup.shading)
    shown = [levels(_on_paper(grey, found)) for grey in (found.wrong, found.right)]
    scale = Scale.reaching(found.worst_deg)
    rank = stage.world_from_object.linear_map.rank
    panels = (
        Panel(shown[0], "Wrong: A n", "the matrix itself carries the normals"),
        Panel(shown[1], *RIGHT_RULE.get(rank, NO_RULE)),
        Panel(levels(_heat(found, scale)), "Angle between them", _angle_caption(found)),
    )
    return Proof(
        image=compose(_title(subject, stage), panels, scale.legend),
        subject=subject,
        max_angle_error_deg=found.worst_deg,
        mean_angle_error_deg=found.mean_deg,
        max_level_difference=int(np.abs(shown[0].astype(int) - shown[1]).max()),
        triangles=projected.triangles,
        fragments=found.fragments,
        work=_work(mesh, found),
    )


def subject_in_world(mesh: Mesh, stage: Stage) -> Subject:
    """Return the mesh under both rules.

    A flattened mesh has two sides and shows one to the eye. Its right normals are turned there at
    the vertices: between opposite ones interpolation would find none.
    """
    linear_map = stage.world_from_object.linear_map
    positions = positions_in_world(mesh, stage)
    wrong, right = moved_by_matrix(linear_map, mesh.normals), outward(linear_map, mesh.normals)
    is_flat = linear_map.rank < 3
    if is_flat:
        eye = np.array([float(x) for x in stage.eye])
        right = turned_towards(right, unit(eye - positions))
    return Subject(mesh, positions, wrong, right, is_flat)


def _on_paper(grey: Array, found: Comparison) -> Array:
    """Return a grey image (height, width) in colour, on the background."""
    return np.repeat((grey + BACKGROUND * (1 - found.covered))[:, :, None], 3, axis=2)


def _heat(found: Comparison, scale: Scale) -> Array:
    """Return the map of angles; grey where a normal is missing."""
    compared, covered = found.compared[:, :, None], found.covered[:, :, None]
    colours = scale.colours(found.angle_deg)
    return np.asarray(
        compared * colours + (covered - compared) * UNDEFINED + (1 - covered) * BACKGROUND
    )


def _angle_caption(found: Comparison) -> str:
    if not found.visible_samples:
        return "nothing of it is seen"
    if found.worst_deg is None or found.mean_deg is None:
        return "no normal is left to compare"
    if found.worst_deg <= ROUNDING_DEG:
        return "none beyond rounding, anywhere"
    return f"worst {found.worst_deg:.2f}°, mean {found.mean_deg:.2f}° over what is seen"


def _title(subject: str, stage: Stage) -> str:
    found = classify(stage.world_from_object.exact, stage.tolerance)
    kind = found.kind.value.replace("-", " ")
    if found.condition is None:
        return f"{subject}: {kind}, rank {found.rank}"
    bound = found.worst_angle_deg or 0.0
    return f"{subject}: {kind}, κ = {found.condition_text}, bound {bound:.2f}°"


def _work(mesh: Mesh, found: Comparison) -> dict[str, int]:
    """Count what was computed: the multiplications of vertices and of visible samples."""
    vertices, samples = len(mesh.positions), found.visible_samples
    return {
        "vertices": vertices,
        "triangles": len(mesh.triangles),
        "fragments": found.fragments,
        "visible_samples": samples,
        "multiplications": vertices * (16 + 2 * 9) + samples * 3 * (9 + 6 + 3),
    }


def positions_in_world(mesh: Mesh, stage: Stage) -> Array:
    """Return the vertices in world space.

    Raises
    ------
    NoAnswerError
        If they, or the eye, are further than 1e+100 or all nearer than 1e-100 to the origin: the
        squares of such lengths leave float64.
    """
    M = np.array(to_floats(stage.world_from_object.exact))
    with np.errstate(over="ignore", invalid="ignore"):
        moved = mesh.positions @ M[:3, :3].T + M[:3, 3]
    mesh_size = float(np.abs(moved).max())
    size = max(mesh_size, *(abs(float(x)) for x in stage.eye))
    if not size <= FARTHEST or 0 < mesh_size < 1 / FARTHEST:
        raise NoAnswerError(
            f"a mesh that reaches {mesh_size:.3g} in a scene that reaches {size:.3g}",
            "a picture can be computed between 1e-100 and 1e+100",
            "scale the scene",
        )
    return np.asarray(moved)


def bounding_ball(mesh: Mesh, stage: Stage) -> tuple[Array, float]:
    """Return a ball around the mesh in world space."""
    moved = positions_in_world(mesh, stage)
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
