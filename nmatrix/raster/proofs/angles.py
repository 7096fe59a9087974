"""The angle between two sets of normals at every visible sample, and the colours that show it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.theme import channels
from nmatrix.enums import Effect, NormalRule
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.raster.shading.normals import angles_deg, normals_by, unit
from nmatrix.raster.shading.opacity import clear, opacity_inputs, solid
from nmatrix.raster.shading.space import as_array, quotient
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.picture import Drawable, Drawing
from nmatrix.raster.triangles.vertices import project

Array = NDArray[Any]

ROUNDING_DEG = 1e-6  # far above the rounding of this rasterizer, far below what can be seen
INVISIBLE_DEG = 1e-4  # far below what a picture can show
UNDEFINED = 0.5
CANCELLED = 1e-12  # an interpolated normal this short is rounding, not a direction


@dataclass(frozen=True, eq=False)
class AngleMap:
    """Angles over a picture (height, width), and their statistics over the samples.

    `pixel_deg` is the mean over a pixel's samples that have both normals, the part `compared` of
    it; these three are of opaque bodies. The statistics count every layer of glass; `worst_body`
    has the largest angle.
    """

    pixel_deg: Array
    compared: Array
    covered: Array
    worst_deg: float | None
    mean_deg: float | None
    worst_body: Body | None

    @property
    def errors(self) -> dict[str, float | None]:
        """Return the statistics under the names of a proof's fields."""
        return {"max_angle_error_deg": self.worst_deg, "mean_angle_error_deg": self.mean_deg}


def rule_error(plan: Plan, rule: NormalRule) -> AngleMap:
    """Measure the angle between the normals of a rule and the right ones, on all that is seen."""
    bodies = plan.loaded.bodies
    wrong, right = (
        [normals_by(plan.loaded, body, one) for body in bodies] for one in (rule, NormalRule.EXACT)
    )
    return angle_map(plan, wrong, right)


def angle_map(plan: Plan, wrong: Sequence[Array], right: Sequence[Array]) -> AngleMap:
    """Measure the angle between two sets of normals in world space, (3, V) for each body.

    The two sides of a flattened body are alike: there normals count up to their sign.
    """
    loaded = plan.loaded
    of_samples: list[tuple[Body, Array]] = []
    drawables = [
        _compared(loaded, *one, of_samples) for one in zip(plan.bodies, wrong, right, strict=True)
    ]
    drawing = Drawing(drawables, loaded.canvas, np.zeros(3), loaded.settings.depth)
    total, compared, covered = np.moveaxis(drawing.picture().image, 2, 0)
    angles = np.concatenate([np.zeros(0), *(found for _, found in of_samples)])
    worst, _ = max(of_samples, key=lambda one: one[1].max(), default=(None, angles))
    return AngleMap(
        quotient(total, compared),
        compared,
        covered,
        float(angles.max()) if len(angles) else None,
        float(angles.mean()) if len(angles) else None,
        worst,
    )


def _compared(
    loaded: LoadedScene,
    plan: BodyPlan,
    wrong: Array,
    right: Array,
    of_samples: list[tuple[Body, Array]],
) -> Drawable:
    """Return a body that is drawn as its angles, which are also added to those of the samples."""
    culled = 0 if Effect.BACK_FACES in plan.effects else -plan.seen.front
    clip_from_object = as_array(plan.seen.clip_from_object)
    projected = project(plan.body.mesh, clip_from_object, loaded.canvas, loaded.clip, culled)

    def colours(found: Fragments) -> Array:
        a, b = (unit(found[name].T, CANCELLED) for name in ("wrong", "right"))
        both = np.asarray(a.any(axis=1) & b.any(axis=1))
        angles = angles_deg(a, b)
        if plan.body.linear_map.rank < 3:
            angles = np.minimum(angles, 180 - angles)
        if both.any():
            of_samples.append((plan.body, angles[both]))
        return np.stack([angles * both, both.astype(float), np.ones(len(both))])

    points = {"wrong": projected.per_vertex(wrong), "right": projected.per_vertex(right)}
    outputs = VertexOutputs(points | opacity_inputs(plan.body, projected))
    seen_through, kept = clear(plan.body), solid(plan.body, projected)
    return Drawable(projected, outputs, colours, seen_through, kept)


@dataclass(frozen=True)
class Scale:
    """Colours for angles from 0 to `largest_deg`; lightness grows all the way.

    Angles that are rounding alone are shown on a scale to 1°, all dark: stretched to the full
    range they would look like a finding.
    """

    largest_deg: float

    @classmethod
    def reaching(cls, worst_deg: float | None) -> Scale:
        """Return the scale that ends at the worst angle."""
        return cls(worst_deg if worst_deg is not None and worst_deg > ROUNDING_DEG else 1.0)

    def colours(self, angle_deg: Array, stops: Sequence[str]) -> Array:
        """Return a colour (…, 3) in [0, 1] for each angle, along stops of one distance.

        Examples
        --------
        >>> Scale(90.0).colours(np.array([0.0, 45.0, 90.0]), ("#000000", "#FF0000"))[:, 0].tolist()
        [0.0, 0.5, 1.0]
        """
        return ramp(angle_deg / self.largest_deg, stops)


def ramp(parts: Array, stops: Sequence[str]) -> Array:
    """Return the colours (…, 3) in [0, 1] so far along stops of one distance, for parts of 1."""
    levels = np.array([channels(one) for one in stops])
    at = np.linspace(0, 1, len(stops))
    return np.stack([np.interp(parts, at, levels[:, i]) for i in range(3)], axis=-1)


def worst_at_vertices(loaded: LoadedScene, body: Body, rule: NormalRule) -> float | None:
    """Return the largest angle between a rule's normals and the right ones, over the vertices.

    Nothing of a camera or a picture is in it. None where no vertex has both.
    """
    wrong, right = (unit(normals_by(loaded, body, one).T) for one in (rule, NormalRule.EXACT))
    both = wrong.any(axis=1) & right.any(axis=1)
    if not both.any():
        return None
    angles = angles_deg(wrong[both], right[both])
    if body.linear_map.rank < 3:
        angles = np.minimum(angles, 180 - angles)
    return float(angles.max())
