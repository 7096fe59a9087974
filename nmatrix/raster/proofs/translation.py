"""The proof that a normal has no place: a translation bends one that is taken for a point."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import DIAGRAM_SHAFT, Ink, Verdict, arrow
from nmatrix.canvas.slide import GUTTER, HEADING
from nmatrix.canvas.text import plain, scientific
from nmatrix.enums import NormalRule, Shading
from nmatrix.linear import rational
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, loaded
from nmatrix.raster.overlay.mesh_lines import creases, silhouettes
from nmatrix.raster.overlay.stage import ARROW, Stage, radius_of
from nmatrix.raster.proofs.angles import INVISIBLE_DEG, rule_error, worst_at_vertices
from nmatrix.raster.proofs.mirror import BELOW
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.rules import EGG
from nmatrix.raster.proofs.staging import NO_SURFACE, Pose, staged, tacks
from nmatrix.raster.shading.normals import angles_deg, normals_by, unit
from nmatrix.raster.shading.space import length
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

Array = NDArray[Any]

IDENTITY = rational.identity(3)
MOVED = World(translate=(2.6, 0, 0))
FROM_THE_FRONT = Pose((5.2, 2.6, 7.4), radius=2, room=0.14, free=(24, 60, 24, 30))
FROM_ABOVE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.8, -0.8, -0.15))
LARGER = 1.6  # tacks, so that they are seen on a ball that has the origin beside it
AXES = 0.62  # of the body's radius
FARTHEST = 12.0  # of it, from the origin to a body that still is large beside it
ASIDE = 1.7  # of it, from the origin to the arrow of t: clear of axes and tacks
BLOWN_DEG = 1.0  # a lean that can be seen
GHOST, GHOST_DASHES = 2.4, (7.0, 6.0)  # the outline of where a body was
WHOLE = 1 - 1e-6  # the length of a normal, but for rounding


@dataclass(frozen=True)
class Moved:
    """What a translation t does to a body's normals by wrong rules.

    `worst_deg` is the largest angle between A n + t and the right normal, `blown_deg` that between
    A n + t and A n; `shortest` the least length of a normal measured over four components. A body
    that `only_moves` has the identity for its A, and does not turn.
    """

    body: Body
    t: Array
    worst_deg: float
    blown_deg: float
    shortest: float
    only_moves: bool

    @classmethod
    def of(cls, scene: Scene, *, is_turned: bool) -> Moved | None:
        """Measure it over the vertices of the one body of a scene; None if it has no normals."""
        ready = loaded(scene)
        (body,) = ready.bodies
        A = rational.linear_part(body.world_from_object.exact)
        worst = worst_at_vertices(ready, body, NormalRule.TRANSLATED)
        if worst is None:
            return None
        by = {rule: normals_by(ready, body, rule).T for rule in NormalRule}
        some = by[NormalRule.EXACT].any(axis=1)
        blown = angles_deg(unit(by[NormalRule.TRANSLATED]), unit(by[NormalRule.NONE]))
        lengths = length(by[NormalRule.FOUR_COMPONENT][some].T)
        return cls(
            body,
            np.array([float(x) for x in rational.translation(body.world_from_object.exact)]),
            worst,
            float(blown[some].max()),
            float(lengths.min()),
            not is_turned and A == IDENTITY,
        )

    @property
    def is_shown_moved(self) -> bool:
        """True if the body is moved, and is large enough to be seen with the origin beside it."""
        far = float(np.abs(self.t).max())
        return 0 < far <= FARTHEST * radius_of(self.body)

    @property
    def is_blown(self) -> bool:
        """True if what the translation does to normals can be seen."""
        return self.blown_deg >= BLOWN_DEG

    @property
    def title(self) -> str:
        """The claim."""
        if self.is_blown:
            return "A normal has no place: with w = 1 a translation blows it away"
        if self.t.any():
            return "So small a translation hides w = 1: test with a larger one"
        return "Without a translation w = 1 stays hidden: test with one"

    @property
    def moved(self) -> tuple[Verdict, str]:
        """Whether w = 1 is right here, and what it does."""
        if self.is_blown:
            turned = "*n*" if self.only_moves else "A*n*"
            told = f"M moves the normal like a point: {turned} + *t*. They lean the way it went."
            return Verdict.WRONG, told
        if self.worst_deg < BLOWN_DEG:
            return Verdict.RIGHT, "The same arrows, the same shade: next to nothing is added."
        return Verdict.WRONG, "Next to nothing is added here, but A itself bends the normals."

    @property
    def short(self) -> tuple[Verdict, str]:
        """Whether lengths over four components are right here, and what they do."""
        if self.body.linear_map.rank < 3:
            return Verdict.WRONG, "M has no inverse: all normals are 0, and no light falls."
        if self.shortest >= WHOLE:
            return Verdict.RIGHT, "The fourth component is 0 here, and every length is right."
        told = "A fourth component appears. Normalised with it, arrows shrink to"
        return Verdict.WRONG, f"{told} {scientific(self.shortest)} and the light with them."

    @property
    def number(self) -> tuple[str, str]:
        """The largest angle off, and what it means."""
        if self.worst_deg < INVISIBLE_DEG:
            return f"< {INVISIBLE_DEG:.4f}°", "off: without a translation neither mistake shows"
        words = "off: every normal leans the way the shape went"
        if self.worst_deg > 90:
            words = "off: what faces back to where it came from now points into the shape"
        elif not self.is_blown:
            words = "off, and not by the translation"
        return f"up to {self.worst_deg:.3g}°", words

    @property
    def verdict(self) -> str:
        """The two mistakes in one sentence."""
        moved = f"With w = 1 the normals are up to {self.worst_deg:.2f}° off, unseen ones included"
        if self.body.linear_map.rank < 3:
            return f"{moved}; M has no inverse to transpose."
        short = "normalised over four components the shortest has length"
        return f"{moved}; {short} {plain(scientific(self.shortest, 3))}."


def translation(settings: ProofSettings) -> Proof:
    """Draw normals that a translation moved, and normals measured over four components."""
    one = settings.object(settings.placed(MOVED), settings.geometry(LoadedGeometry(EGG.mesh())))
    scene = settings.scene(one, lights=(FROM_ABOVE_RIGHT,))
    facts = Moved.of(scene, is_turned=settings.is_moving)
    if facts is None:
        return _nothing(settings, scene)
    slide = settings.slide(facts.title)
    boxes = slide.body(BELOW).columns(3, GUTTER)
    block = "A^{−T}" if facts.body.linear_map.rank == 3 else "C"
    told = "A direction has no place to move from."
    panels = (
        slide.panel(boxes[0], "w = 1", *facts.moved),
        slide.panel(boxes[1], "4×4 inverse transpose", *facts.short),
        slide.panel(boxes[2], f"w = 0, {block} of the 3×3", Verdict.RIGHT, told),
    )
    rules = NormalRule.TRANSLATED, NormalRule.FOUR_COMPONENT, NormalRule.EXACT
    by_rule = [replace(scene.settings, normals=rule) for rule in rules]
    if facts.shortest < WHOLE:
        by_rule[1] = replace(by_rule[1], shading=Shading.GOURAUD)  # it keeps the lengths
    scenes = [replace(scene, settings=chosen) for chosen in by_rule]
    way = Way.of(facts) if facts.is_shown_moved else None
    pose = FROM_THE_FRONT if way else replace(FROM_THE_FRONT, room=ARROW)
    beside = (way.points,) if way else ()
    stages = staged(slide, settings, pose, list(zip(panels, scenes, strict=True)), beside)
    reach = radius_of(facts.body)
    for stage, panel, rule in zip(stages, panels, rules, strict=True):
        stage.outline()
        stage.lights()
        if way:
            way.draw(stage)
        ink = Ink.WRONG if panel.verdict is Verdict.WRONG else Ink.RIGHT
        shown = tacks(stages[-1], facts.body, rule, settings)
        stage.tacks(shown, ink, LARGER * reach if way else reach)
    for a, b in pairwise(panels):
        if a.verdict is b.verdict is Verdict.RIGHT:
            slide.compare(a, b, same=True)
    slide.large_number(slide.frame.x, slide.frame.bottom - 56, *facts.number)
    return Proof.of(
        settings.subject,
        slide,
        facts.verdict,
        [stage.drawn for stage in stages],
        numbers={"shortest_normal": facts.shortest},
        max_level_difference=level_difference(stages[0].drawn, stages[1].drawn),
        **rule_error(stages[-1].drawn.plan, NormalRule.TRANSLATED).errors,
    )


def _nothing(settings: ProofSettings, scene: Scene) -> Proof:
    """Draw that there is no normal to be moved."""
    (body,) = loaded(scene).bodies
    slide = settings.slide("No surface is here, and so no normal to move")
    told = "No rule, right or wrong, can make a normal of what has no side."
    panel = slide.panel(slide.body(BELOW), caption=told)
    (stage,) = staged(slide, settings, FROM_THE_FRONT, [(panel, scene)])
    if stage.drawn.rendered.work.fragments:
        slide.no_answer(panel, NO_SURFACE[body.linear_map.rank])
    return Proof.of(settings.subject, slide, "No normal is here to be moved.", [stage.drawn])


@dataclass(frozen=True, eq=False)
class Way:
    """The marks of a translation: the origin, a body before it was moved, and t beside both."""

    body: Body
    came_from: Array
    axes: Array
    foot: Array
    tip: Array
    letter: Array

    @classmethod
    def of(cls, facts: Moved) -> Way:
        """Find where they stand for a body that was moved."""
        reach = radius_of(facts.body)
        aside = (
            ASIDE * reach * unit(np.cross(facts.t, np.array(FROM_THE_FRONT.eye, float)))
        )  # in a turn, as t turns
        came_from = facts.body.positions_world - facts.t
        axes = np.eye(3, 4, 1) * AXES * reach
        return cls(facts.body, came_from, axes, aside, aside + facts.t, 1.25 * aside + facts.t / 2)

    @property
    def points(self) -> Array:
        """Return the points (n, 3) that a picture must hold to show them."""
        return np.concatenate(
            [self.came_from, [self.foot, self.tip, self.letter], self.axes[:, 1:].T]
        )

    def draw(self, stage: Stage) -> None:
        """Draw them on a stage."""
        canvas = stage.canvas
        edges = (self.came_from[chain] for chain in creases(self.body.mesh))
        for chain in (*edges, *silhouettes(self.body.mesh, self.came_from, stage.eye)):
            stage.surface_line(chain, GHOST, canvas.palette.soft, dash=GHOST_DASHES)
        stage.axes(self.axes)
        ends = [stage.place(one) for one in (self.foot, self.tip, self.letter)]
        a, b, letter = (one if one and stage.box.holds(one) else None for one in ends)
        if a is None or b is None:
            return
        arrow(canvas, a, b, Ink.PLAIN, DIAGRAM_SHAFT)
        if letter is not None:
            x, y = letter[0], letter[1] + 0.27 * HEADING
            halo = canvas.palette.stage
            canvas.text((x, y), "*t*", HEADING, bold=True, align=0.5, halo=halo)
