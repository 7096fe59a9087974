"""A picture that proves nothing: a scene as it is, and the error of its normals."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from nmatrix.canvas.paint import pixels
from nmatrix.enums import NormalRule, Shown, Theme
from nmatrix.errors import printable
from nmatrix.raster.drawn_scene import DrawnScene, drawn_scene, level_difference
from nmatrix.raster.overlay.shown import marked
from nmatrix.raster.proofs.angles import INVISIBLE_DEG, AngleMap, rule_error
from nmatrix.raster.proofs.proof import Proof
from nmatrix.raster.sight import sight_remarks
from nmatrix.scene.scene import Scene


def picture(
    scene: Scene,
    subject: str,
    shown: frozenset[Shown] = frozenset(),
    theme: Theme = Theme.LIGHT,
) -> Proof:
    """Draw a scene, marks over it; under a wrong rule for normals, compare it with the right one.

    Where the right rule draws it, it is compared with A n: that is what the rule is worth here.
    """
    drawn = drawn_scene(scene, keeps_depth=bool(shown))
    rule = scene.settings.normals
    measured: dict[str, Any] = {}
    if rule is not NormalRule.EXACT:
        right = drawn_scene(scene, normals=NormalRule.EXACT)
        measured["max_level_difference"] = level_difference(drawn, right)
    wrong = NormalRule.NONE if rule is NormalRule.EXACT else rule
    angles = rule_error(drawn.plan, wrong)
    measured |= angles.errors
    verdict = _verdict(drawn, angles, rule)
    found = Proof.of(subject, drawn.levels, verdict, [drawn], **measured)
    told = (*found.remarks, *sight_remarks(drawn.plan, drawn.rendered))
    found = replace(found, remarks=told, features=scene.features)
    if not shown:
        return found
    canvas, remarks = marked(drawn, shown, theme)
    return replace(found, picture=pixels(canvas), remarks=(*found.remarks, *remarks))


def _verdict(drawn: DrawnScene, angles: AngleMap, rule: NormalRule) -> str:
    worst = angles.worst_deg
    if not any(drawn.rendered.seen):
        return "Nothing covers a sample."
    if rule is not NormalRule.EXACT:
        return _of_rule(worst, rule, _where(drawn, angles))
    if worst is None:
        return "Drawn; by A itself no normal in sight survives."
    if worst < INVISIBLE_DEG:
        return "Drawn; A itself carries the normals in sight just as well."
    off = f"up to {worst:.3g}° off{_where(drawn, angles)}"
    return f"Drawn rightly; with A itself the normals in sight would be {off}."


def _where(drawn: DrawnScene, angles: AngleMap) -> str:
    """Name the body on which normals are the farthest off, if there are several."""
    if angles.worst_body is None or len(drawn.plan.loaded.bodies) == 1:
        return ""
    return f", on {printable(angles.worst_body.name)}"


def _of_rule(worst: float | None, rule: NormalRule, where: str) -> str:
    if worst is None:
        return f"Drawn; by the rule “{rule}” no normal in sight can be compared."
    if worst < INVISIBLE_DEG:
        return f"Drawn; in sight the rule “{rule}” gives the right normals."
    return f"By the rule “{rule}” the normals in sight are up to {worst:.3g}° off{where}."
