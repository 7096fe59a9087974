"""A picture that proves nothing: a scene as it is, and the error of its normals."""

from __future__ import annotations

from dataclasses import replace

from nmatrix.enums import NormalRule
from nmatrix.raster.proofs.angles import angle_map, normals_by
from nmatrix.raster.proofs.proof import (
    DrawnScene,
    Proof,
    drawn_scene,
    effect_names,
    level_difference,
)
from nmatrix.scene.scene import Scene

INVISIBLE = 1e-4  # degrees: far below what a picture can show


def picture(scene: Scene, subject: str) -> Proof:
    """Draw a scene; under a wrong rule for normals, compare it with the right one.

    A single object is measured against A n even where the right rule draws it: that is what the
    rule is worth here.
    """
    drawn = drawn_scene(scene)
    image = drawn.levels
    difference = 0
    rule = scene.settings.normals
    if rule is not NormalRule.EXACT:
        right = replace(scene, settings=replace(scene.settings, normals=NormalRule.EXACT))
        difference = level_difference(image, drawn_scene(right).levels)
    worst, mean = _angles(drawn, NormalRule.NONE if rule is NormalRule.EXACT else rule)
    return Proof(
        image,
        subject,
        _verdict(drawn, worst, rule),
        drawn.rendered.work,
        effect_names(drawn.plan),
        max_angle_error_deg=worst,
        mean_angle_error_deg=mean,
        max_level_difference=difference,
        remarks=drawn.loaded.remarks,
    )


def _angles(drawn: DrawnScene, rule: NormalRule) -> tuple[float | None, float | None]:
    """Return the worst and the mean angle between a rule and the right one, for one object."""
    if len(drawn.loaded.bodies) != 1:
        return None, None
    (body,) = drawn.loaded.bodies
    by_both = (normals_by(drawn.loaded, body, one) for one in (rule, NormalRule.EXACT))
    found = angle_map(drawn.loaded, *by_both)
    return found.worst_deg, found.mean_deg


def _verdict(drawn: DrawnScene, worst: float | None, rule: NormalRule) -> str:
    if not drawn.rendered.work.fragments:
        return "Nothing covers a sample: move the camera or make the picture larger."
    if worst is None:
        return f"{len(drawn.loaded.bodies)} objects, drawn."
    if worst < INVISIBLE:
        return "Drawn; here A itself carries the normals just as well."
    if rule is NormalRule.EXACT:
        return f"Drawn rightly; with A itself the normals would be up to {worst:.3g}° off."
    return f"By the rule “{rule}” the normals are up to {worst:.3g}° off."
