"""Proofs that A itself bends normals, and that a test which only turns things cannot tell."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from nmatrix.canvas.diagrams import circle_to_ellipse
from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.slide import CAPTION, GUTTER, HEADING, STAGE_AT, Panel, Slide
from nmatrix.enums import Kind, NormalRule
from nmatrix.errors import counted
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.stage import Stage, radius_of
from nmatrix.raster.proofs.angles import (
    INVISIBLE_DEG,
    Scale,
    rule_error,
    worst_at_vertices,
)
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import NO_SURFACE, Pose, put_heat, staged, tacks
from nmatrix.raster.shading.normals import normals_by, unit
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

EGG = ShapeGeometry(Shape.SPHERE, (64, 128))
TALL = World(scale=(1, 2, 1))
BESIDE = Pose((3.6, 1.5, 9.2), radius=2)
FROM_THE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.85, -0.55, -0.65))
STRETCHED_IDEA = "A tangent rides along with A. A normal must stay at a right angle to it."
EVEN_IDEA = "A tangent rides along with A, and so does the normal: their right angle stays."
BELOW = 190.0  # units under the stages, for captions and a number
TURNED = World(rotate_degrees=(0, 0, -38))
STRETCHED = World(rotate_degrees=(0, 0, -62)).under(
    World(scale=(0.85, 1.7, 0.85)).world_from_object
)
FRONT = Pose((2.0, 1.6, 9.2), radius=2)
FROM_ABOVE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.6, -0.75, -0.45))


@dataclass(frozen=True)
class Claim:
    """What the picture of normals shows for one map and one mesh: the words that are true of it."""

    title: str
    wrong: str
    right: str = "The inverse transpose keeps every normal upright."
    heading: str = "A^{−T} *n*"
    agrees: bool = False

    @classmethod
    def about(
        cls, settings: ProofSettings, body: Body, worst_deg: float | None, *, is_lost: bool
    ) -> Claim:
        """Find the words for a body whose normals A itself bends so far at the worst."""
        kind, rank = body.kind, body.linear_map.rank
        if worst_deg is None and not is_lost:
            return cls(
                "Flatten a shape along its normals, and A leaves none",
                "Carried by A every normal has length 0: no arrow, and no light.",
                "The cofactors C of A know the plane; both of its sides are lit.",
                "C *n*, both sides",
            )
        if worst_deg is None:
            return cls(
                "Where no plane is left, no normal is",
                "A leaves nothing that has a side: no arrow, no light.",
                "No rule can make a normal of what is no longer a surface.",
                "C *n*",
            )
        if worst_deg < INVISIBLE_DEG:
            title = "On this shape A itself does it: a test here proves nothing"
            if not kind.needs_inverse_transpose:
                title = "Turn it or scale it evenly, and A itself carries normals"
            same = "The same arrows, the same shade: here A does no harm."
            return cls(title, same, same, agrees=True)
        if rank < 3:
            return cls(
                "Flatten a shape by A, and A lays its normals into its plane",
                "Carried by A the normals lie in the surface, and no light is right.",
                "The cofactors C of A know the plane; both of its sides are lit.",
                "C *n*, both sides",
            )
        verb = "Shear" if kind.kind is Kind.SHEAR else "Stretch"
        own = settings.mesh is None and settings.world in (None, TALL)
        aside = "to the poles" if own else "off the surface"
        return cls(
            f"{verb} a shape by A, and A bends its normals off the surface",
            f"Carried by A the normals lean {aside}, and the light with them.",
        )


def normals(settings: ProofSettings) -> Proof:
    """Draw a mesh with wrong and with right normals, and the angle between them."""
    one = settings.object(settings.placed(TALL), settings.geometry(EGG))
    scene = settings.scene(one, lights=(FROM_THE_RIGHT,))
    (body,) = loaded(scene).bodies
    worst = worst_at_vertices(loaded(scene), body, NormalRule.NONE)
    is_lost = _is_lost(loaded(scene), body)
    claim = Claim.about(settings, body, worst, is_lost=is_lost)
    slide = settings.slide(claim.title)
    idea, first, second, last = slide.body(BELOW).columns(4, GUTTER)
    bends = body.kind.needs_inverse_transpose
    told = slide.panel(idea, "The idea", caption=STRETCHED_IDEA if bends else EVEN_IDEA)
    circle_to_ellipse(slide.canvas, told.stage, 2.0 if bends else 1.0)
    panels = (
        slide.panel(first, "A *n*", _verdict(claim.agrees), claim.wrong),
        slide.panel(second, claim.heading, None if is_lost else Verdict.RIGHT, claim.right),
    )
    wrong, right = _both(slide, settings, BESIDE, panels, scene)
    if claim.agrees:
        slide.compare(*panels, same=True)
    heat = slide.panel(last, "Angle between")
    found = rule_error(right.drawn.plan, NormalRule.NONE)
    if worst is None:
        slide.no_answer(heat, NO_SURFACE[body.linear_map.rank])
    else:
        put_heat(slide, heat, right.drawn, found, Scale.reaching(worst)).outline()
        number = f"{worst:.1f}°" if worst >= INVISIBLE_DEG else "0°"
        slide.large_number(heat.stage.x, slide.frame.bottom - 68, number, "off")
    return Proof.of(
        settings.subject,
        slide,
        _sentence(worst, is_lost=is_lost),
        [wrong.drawn, right.drawn],
        max_level_difference=level_difference(wrong.drawn, right.drawn),
        **found.errors,
    )


def _both(
    slide: Slide, settings: ProofSettings, pose: Pose, panels: tuple[Panel, Panel], scene: Scene
) -> tuple[Stage, Stage]:
    """Draw a scene by A itself and by the right rule, with their normals as tacks."""
    by_none = replace(scene, settings=replace(scene.settings, normals=NormalRule.NONE))
    pairs = list(zip(panels, (by_none, scene), strict=True))
    wrong, right = staged(slide, settings, pose, pairs)
    ink = Ink.WRONG if panels[0].verdict is Verdict.WRONG else Ink.RIGHT
    rules = (NormalRule.NONE, ink), (NormalRule.EXACT, Ink.RIGHT)
    (body,) = right.loaded.bodies
    if _is_lost(right.loaded, body):
        for panel in panels:
            slide.no_answer(panel, NO_SURFACE[body.linear_map.rank])
        return wrong, right
    for stage, (rule, colour) in zip((wrong, right), rules, strict=True):
        stage.outline()
        stage.lights()
        stage.tacks(tacks(right, body, rule, settings), colour, radius_of(body))
    return wrong, right


def _verdict(agrees: bool) -> Verdict:  # noqa: FBT001  # the one thing that it turns into a verdict
    return Verdict.RIGHT if agrees else Verdict.WRONG


def _is_lost(ready: LoadedScene, body: Body) -> bool:
    """Tell whether a body has no normal by any rule."""
    return not normals_by(ready, body, NormalRule.EXACT).any()


def _sentence(worst: float | None, *, is_lost: bool) -> str:
    if is_lost:
        return "No normal survives this map."
    if worst is None:
        return "A itself leaves no normal here, and the cofactors do."
    if worst < INVISIBLE_DEG:
        return "Both are the same here: a test on this map cannot tell a wrong normal matrix."
    return f"With A itself the normals are up to {worst:.2f}° off, unseen ones included."


def bias(settings: ProofSettings) -> Proof:
    """Draw what a rotation hides and a stretch shows: the same wrong matrix under both."""
    slide = settings.slide("A test that only turns things passes the wrong code")
    shape = settings.geometry(_ellipsoid())
    own = settings.world is None
    pairs = slide.body(BELOW - 40, top=STAGE_AT + 52).columns(2, GUTTER)
    drawn: list[Stage] = []
    for box, (words, caption, world) in zip(
        pairs,
        (
            ("Turn it", "The same pixels: for a rotation A^{−T} = A.", TURNED),
            ("Stretch it" if own else "Move it by your map", "", settings.placed(STRETCHED)),
        ),
        strict=True,
    ):
        scene = settings.scene(settings.object(world, shape), lights=(FROM_ABOVE_RIGHT,))
        (body,) = loaded(scene).bodies
        worst = worst_at_vertices(loaded(scene), body, NormalRule.NONE)
        agrees = worst is not None and worst < INVISIBLE_DEG
        slide.canvas.text((box.x, box.y - 68), words, HEADING, bold=True)
        line = ((box.x, box.y - 56), (box.right, box.y - 56))
        slide.canvas.stroke(line, 3, slide.palette.ink, round_ends=False)
        left, right = box.columns(2, GUTTER)
        is_lost = _is_lost(loaded(scene), body)
        told = caption or _second_caption(body, agrees=agrees, is_lost=is_lost)
        rule = "A^{−T} *n*" if body.linear_map.rank == 3 else "C *n*"
        panels = (
            slide.panel(left, "A *n*", Verdict.WRONG),
            slide.panel(right, rule, None if is_lost else Verdict.RIGHT),
        )
        slide.canvas.paragraph((box.x, box.bottom + 38), told, CAPTION, box.width)
        drawn += _both(slide, settings, FRONT, panels, scene)
        if not is_lost and not drawn[-1].is_empty:
            slide.compare(*panels, same=agrees)
    turned, stretched = drawn[:2], drawn[2:]
    hidden, seen = (level_difference(a.drawn, b.drawn) for a, b in (turned, stretched))
    under = f"by {seen} in a stretch" if own else f"by {seen} under your map"
    if is_lost:
        under = "and your map leaves no normal"
    return Proof.of(
        settings.subject,
        slide,
        f"The wrong matrix is off by {counted(hidden, 'level')} in a rotation, {under}.",
        [one.drawn for one in drawn],
        numbers={"rotation_level_difference": hidden, "scale_level_difference": seen},
        max_level_difference=seen,
        **rule_error(stretched[1].drawn.plan, NormalRule.NONE).errors,
    )


def _second_caption(body: Body, *, agrees: bool, is_lost: bool) -> str:
    if is_lost:
        return "This map leaves no plane, so there is no normal to test with."
    if agrees and body.kind.needs_inverse_transpose:
        return "The same pixels again: along its own axes a shape hides the mistake too."
    if agrees:
        return "The same pixels again: this map, too, only turns or scales evenly."
    return "The same code, found out: test with an uneven scale."


def _ellipsoid() -> LoadedGeometry:
    """Return a ball whose own shape is longer one way: its normals are its own, no map's."""
    ball = EGG.mesh()
    sides = np.array([0.72, 1.15, 0.72])
    return LoadedGeometry(
        replace(ball, positions=ball.positions * sides, normals=unit(ball.normals / sides))
    )
