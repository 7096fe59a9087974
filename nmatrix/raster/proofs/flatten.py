"""The proof that a flattened shape has normals although its map has no inverse."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.diagrams import circle_to_line
from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.slide import GUTTER, Slide
from nmatrix.enums import NormalRule
from nmatrix.errors import counted
from nmatrix.raster.drawn_scene import DrawnScene, level_difference
from nmatrix.raster.loaded_scene import Body, loaded
from nmatrix.raster.overlay.stage import ARROW, Stage, radius_of, rings_around
from nmatrix.raster.overlay.tacks import Tack, farthest_apart, spread_over
from nmatrix.raster.proofs.angles import INVISIBLE_DEG, rule_error, worst_at_vertices
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.rules import EGG
from nmatrix.raster.proofs.staging import NO_SURFACE, RIM_POINTS, Pose, staged, tacks
from nmatrix.raster.shading.normals import normals_by, unit
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

Array = NDArray[Any]

Found = tuple[Slide, tuple[DrawnScene, DrawnScene], str]  # with the sentence of the verdict

FLAT = World(scale=(1, 0, 1), rotate_degrees=(14, 0, -16))
FROM_ABOVE = Pose((0.4, 2.4, 8.8), radius=1.3, room=0.08, free=(24, 60, 24, 60))
BELOW = 140.0  # units under the stages, for captions
ONTO_THE_COIN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.5, -1, -0.35))
CANDIDATES, TACKS = 1000, 3  # places that are tried; what is chosen goes through the coin
CLEAR = 0.25  # from its edge, a part of its radius
LONG = 0.8  # an arrow of the coin, of its radius
IDEA = "A squeezes the ball to a coin. Its tangents span a plane, and a plane has a normal."
NO_INVERSE = "det A = 0. There is no inverse: a program stops here, or makes up numbers."
ALL_ZERO = "Normals of length 0: no arrow, and no light but the ambient one."
NO_DIVISION = "The cofactors C divide by nothing."
TWO_SIDES = f"{NO_DIVISION} Each of the two sides has its normal."
SAME = "Its inverse is there: the same arrows, the same shade."
IN_FLOATS = "An inverse is there, but floats do not find it: det A is lost in rounding."
NOTHING = 64  # the size of what stands where there is no answer


def flatten(settings: ProofSettings) -> Proof:
    """Draw a flattened object: with no inverse, with a zero matrix, with the cofactors."""
    one = settings.object(settings.placed(FLAT), settings.geometry(LoadedGeometry(EGG.mesh())))
    right = settings.scene(one, lights=(ONTO_THE_COIN,))
    without = replace(right, settings=replace(right.settings, normals=NormalRule.INVERSE))
    (body,) = loaded(right).bodies
    has_normals = normals_by(loaded(right), body, NormalRule.EXACT).any()
    rank = body.linear_map.rank
    draw = _gone if not has_normals else _flattened if rank == 2 else _kept
    slide, drawn, verdict = draw(settings, without, right)
    return Proof.of(
        settings.subject,
        slide,
        verdict,
        drawn,
        numbers={"rank": rank},
        max_level_difference=level_difference(*drawn),
        **rule_error(drawn[-1].plan, NormalRule.INVERSE).errors,
    )


def _flattened(settings: ProofSettings, without: Scene, right: Scene) -> Found:
    """Draw what a plane's normals are: nothing by an inverse, two by the cofactors."""
    slide = settings.slide("Flatten a shape: the inverse is gone, the plane's normal is not")
    first, second, third, last = slide.body(BELOW).columns(4, GUTTER)
    idea = slide.panel(first, "The idea", caption=IDEA)
    circle_to_line(slide.canvas, idea.stage)
    hatched = slide.panel(second, "inv(A)", Verdict.WRONG, NO_INVERSE)
    panels = (
        slide.panel(third, "a zero matrix", Verdict.WRONG, ALL_ZERO),
        slide.panel(last, "C *n*, both sides", Verdict.RIGHT, TWO_SIDES),
    )
    ready = loaded(right)
    (body,) = ready.bodies
    long = LONG * radius_of(body)
    across = unit(normals_by(ready, body, NormalRule.EXACT).T.mean(axis=0))
    tips = body.centre + long * np.stack([across, -across])
    parts = list(zip(panels, (without, right), strict=True))
    zero, lit = staged(slide, settings, FROM_ABOVE, parts, (tips,))
    lost = Stage(slide.canvas, hatched.stage, lit.drawn)
    middle = lost.place(body.centre)
    is_in_sight = middle is not None and hatched.stage.holds(middle)
    slide.no_answer(hatched, "1 / 0", NOTHING, middle if is_in_sight else None)
    lost.lost_outline()
    for stage in (zero, lit):
        stage.outline()
        stage.lights()
    found = _through(lit, body)
    zero.tacks([replace(one, arrow=0 * one.arrow) for one in found], Ink.WRONG, radius_of(body))
    for one in found:
        lit.arrow(one.place, one.place - long * one.normal, Ink.RIGHT)
    longer = [replace(one, arrow=one.arrow * LONG / ARROW) for one in found]
    lit.tacks(longer, Ink.RIGHT, radius_of(body))
    dark = level_difference(zero.drawn, lit.drawn)
    verdict = (
        "The cofactors still know the plane's normal; without it "
        f"{counted(dark, 'level')} of light {'is' if dark == 1 else 'are'} lost."
    )
    return slide, (zero.drawn, lit.drawn), verdict


def _through(stage: Stage, body: Body) -> list[Tack]:
    """Return tacks well inside a flat body, where arrows to its back come out in sight."""
    mesh, points, reach = body.mesh, body.positions_world, radius_of(body)
    true = normals_by(stage.loaded, body, NormalRule.EXACT).T
    found = spread_over(mesh, points, CANDIDATES)
    place, normal = found.of(mesh, points), unit(found.of(mesh, true))
    rings = rings_around(place, normal, CLEAR * reach, RIM_POINTS)
    inside = stage.covers(rings.reshape(-1, 3)).reshape(-1, RIM_POINTS).all(axis=1)
    behind = [stage.sees(place - part * LONG * reach * normal) for part in (0.65, 1.0)]
    shown = stage.sees(place)
    choices = (shown & inside & behind[0] & behind[1], shown & inside, shown)
    best = next((np.flatnonzero(one) for one in choices if one.any()), np.zeros(0, np.intp))
    chosen = best[farthest_apart(stage.window(place[best])[:, :2], TACKS, 0.0)]
    return [Tack(place[i], normal[i], normal[i]) for i in chosen]


def _kept(settings: ProofSettings, without: Scene, right: Scene) -> Found:
    """Draw that a map which flattens nothing has an inverse, as good as float64 computes it."""
    ready = loaded(right)
    (body,) = ready.bodies
    worst = worst_at_vertices(ready, body, NormalRule.INVERSE)
    title, caption = "This map flattens nothing: it has an inverse", SAME
    verdict = "This map has an inverse, and by it the normals are the same as by the cofactors."
    if worst is None or worst >= INVISIBLE_DEG:
        lost = "lost" if worst is None else f"up to {worst:.3g}° off"
        title = f"Almost flat: by an inverse in float64 normals are {lost}"
        verdict, caption = f"{title}.", IN_FLOATS
    fine = caption is SAME
    slide = settings.slide(title)
    first, second = slide.body(BELOW).columns(2, GUTTER)
    panels = (
        slide.panel(first, "inv(A)^{T} *n*", Verdict.RIGHT if fine else Verdict.WRONG, caption),
        slide.panel(second, "sign(det A) · C *n*", Verdict.RIGHT, NO_DIVISION),
    )
    parts = list(zip(panels, (without, right), strict=True))
    stages = staged(slide, settings, replace(FROM_ABOVE, room=ARROW), parts)
    rules = (NormalRule.INVERSE, Ink.RIGHT if fine else Ink.WRONG), (NormalRule.EXACT, Ink.RIGHT)
    for stage, (rule, ink) in zip(stages, rules, strict=True):
        stage.outline()
        stage.lights()
        stage.tacks(tacks(stages[1], body, rule, settings), ink, radius_of(body))
    if fine:
        slide.compare(*panels, same=True)
    return slide, (stages[0].drawn, stages[1].drawn), verdict


def _gone(settings: ProofSettings, without: Scene, right: Scene) -> Found:
    """Draw that a line or a point has no normal, and that the cofactors say so."""
    (body,) = loaded(right).bodies
    left = NO_SURFACE[body.linear_map.rank]
    title = "No surface is here, and so no normal"
    if body.linear_map.rank < 2:
        title = f"Flattened to {left}: no plane is left, and no normal"
    slide = settings.slide(title)
    told = "No rule can make a normal of what has no side: the cofactors say 0, and that is true."
    panel = slide.panel(slide.body(BELOW), caption=told)
    stages = staged(slide, settings, FROM_ABOVE, [(panel, without), (panel, right)])
    if stages[0].drawn.rendered.work.fragments:
        slide.no_answer(panel, left)
    drawn = stages[0].drawn, stages[1].drawn
    return slide, drawn, "No plane is left, and the cofactors say so: they give no normal."
