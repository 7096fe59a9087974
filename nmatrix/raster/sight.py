"""What a picture shows of its objects, and the reasons where that is little or nothing."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from nmatrix.enums import Effect
from nmatrix.errors import printable, quantity, shortlist
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.planning.plan import BodyPlan, Plan, nothing_seen
from nmatrix.raster.render import APART, Rendered
from nmatrix.raster.shading.opacity import solid
from nmatrix.raster.shading.space import as_array
from nmatrix.raster.triangles.fragments import VertexOutputs
from nmatrix.raster.triangles.picture import Drawable, Drawing
from nmatrix.raster.triangles.spans import SUBPIXELS
from nmatrix.raster.triangles.vertices import Projected, project, signed_area

SMALL = 0.005  # of a picture: what covers less is easily missed
FAINT = 0.02  # of what is seen
MOST_EXPLAINED, MOST_NAMED = 3, 4  # objects


def sight_remarks(plan: Plan, rendered: Rendered) -> Iterator[str]:
    """Yield what a picture hardly shows, or does not show at all, and why."""
    if not plan.drawn:
        return  # the plan says why
    seen, samples = rendered.seen[: len(plan.drawn)], _samples(plan)
    if not any(seen):
        yield nothing_seen(
            [(one.body.name, why_not_seen(plan, one)) for one in plan.drawn[:MOST_EXPLAINED]]
        )
        return
    if sum(seen) < SMALL * samples:
        yield f"What is drawn covers less than {_percent(SMALL)} of the picture."
    elif plan.loaded.is_fitted:
        yield from _small(plan, seen)
    if rendered.faint > FAINT:
        yield (
            f"About {_percent(rendered.faint)} of what is seen differs by fewer than "
            f"{round(APART * 255)} levels from the background."
        )


def _small(plan: Plan, seen: Sequence[int]) -> Iterator[str]:
    """Yield how many of the objects are easily missed."""
    names = [
        printable(one.body.name)
        for one, count in zip(plan.drawn, seen, strict=True)
        if count < SMALL * _samples(plan)
    ]
    if names:
        cover, each = ("cover", " each") if len(names) > 1 else ("covers", "")
        yield (
            f"{len(names)} of {len(plan.bodies)} objects {cover} less than {_percent(SMALL)} of "
            f"the picture{each}: {shortlist(names, MOST_NAMED)}; {quantity('object')} NAME draws "
            "one alone."
        )


def why_not_seen(plan: Plan, one: BodyPlan) -> str:
    """Find the reason why no sample shows a body that a plan draws."""
    loaded, body = plan.loaded, one.body
    matrix = as_array(one.seen.clip_from_object)
    both = project(body.mesh, matrix, loaded.canvas, loaded.clip)
    x, y = both.x.take(both.triangles), both.y.take(both.triangles)
    area, culled = signed_area(x, y), 0 if Effect.BACK_FACES in one.effects else -one.seen.front
    shown = project(body.mesh, matrix, loaded.canvas, loaded.clip, culled)
    is_turned = bool(culled) and bool(area.any()) and not (area * culled < 0).any()
    reasons: dict[str, Callable[[], bool]] = {
        "has no triangle with an area": lambda: not body.facets.areas.any(),
        "is outside of the view": lambda: not area.size,
        "is smaller than a sample": lambda: max(np.ptp(x), np.ptp(y)) < SUBPIXELS,
        "is seen from its edge": lambda: not area.any(),
        "turns its back: all its triangles face away, and only their fronts are drawn": (
            lambda: is_turned
        ),
        "is beside the picture, or between its samples": lambda: not _covered(plan, shown),
        "is all holes where it is in the picture": (
            lambda: not _covered(plan, shown, solid_part=body)
        ),
    }
    return next((why for why, holds in reasons.items() if holds()), "is hidden by others")


def _covered(plan: Plan, projected: Projected, solid_part: Body | None = None) -> int:
    """Count the samples that triangles cover, all of them or those that are no holes."""
    kept = None if solid_part is None else solid(solid_part, projected)
    alone = Drawable(projected, VertexOutputs(), lambda found: np.zeros((1, len(found))), kept=kept)
    return Drawing([alone], plan.loaded.canvas, np.zeros(1)).picture().fragments


def _samples(plan: Plan) -> int:
    return plan.loaded.canvas.columns * plan.loaded.canvas.rows


def _percent(part: float) -> str:
    return f"{100 * part:.0f} %" if part >= FAINT else f"{100 * part:.2g} %"
