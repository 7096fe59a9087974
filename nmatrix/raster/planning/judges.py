"""The judges of every effect that belongs to bodies, in the order in which plans show them."""

from __future__ import annotations

from collections.abc import Callable

from nmatrix.enums import Effect
from nmatrix.raster.planning import judges_by_geometry as shortcuts
from nmatrix.raster.planning import judges_by_scene as named
from nmatrix.raster.planning.decision import Decision, Verdict
from nmatrix.raster.planning.facts import Facts


def decide(facts: Facts) -> dict[Effect, Decision]:
    """Return the decision for every effect that belongs to bodies, needs apart."""
    return {effect: Decision(effect, *judge(facts)) for effect, judge in JUDGES.items()}


JUDGES: dict[Effect, Callable[[Facts], Verdict]] = {
    Effect.AMBIENT: named.ambient,
    Effect.DIFFUSE: named.diffuse,
    Effect.INVERSE_TRANSPOSE: shortcuts.inverse_transpose,
    Effect.METRIC: shortcuts.metric,
    Effect.SPECULAR: named.specular,
    Effect.TOON: named.toon,
    Effect.OUTLINE: named.outline,
    Effect.POSITION: shortcuts.position,
    Effect.ATTENUATION: named.attenuation,
    Effect.SPOT: named.spot,
    Effect.SHADOWS: shortcuts.shadows,
    Effect.RENORMALISE: shortcuts.renormalise,
    Effect.PERSPECTIVE: shortcuts.perspective,
    Effect.EXACT_WEIGHTS: shortcuts.exact_weights,
    Effect.NEAR_CLIP: shortcuts.near_clip,
    Effect.BACK_FACES: shortcuts.back_faces,
    Effect.TEXTURE: named.texture,
    Effect.NORMAL_MAP: named.normal_map,
    Effect.VERTEX_COLOURS: named.vertex_colours,
    Effect.TRANSPARENCY: named.transparency,
    Effect.FOG: named.fog,
}
