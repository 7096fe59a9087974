"""Proofs of the maps at which rules for normals fail: mirrors, translations, maps that flatten."""

from __future__ import annotations

from dataclasses import dataclass, replace
from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.diagrams import circle_to_line
from nmatrix.canvas.glyphs import DIAGRAM_SHAFT, Ink, Verdict, arrow
from nmatrix.canvas.slide import GUTTER, HEADING, Slide
from nmatrix.enums import Kind, NormalRule, Shading
from nmatrix.linear import rational
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, loaded
from nmatrix.raster.overlay.mesh_lines import silhouettes
from nmatrix.raster.overlay.stage import ARROW, Stage, radius_of
from nmatrix.raster.proofs.angles import INVISIBLE_DEG, normals_by, rule_error, worst_at_vertices
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.rules import BELOW, EGG
from nmatrix.raster.proofs.staging import NO_SURFACE, Pose, put_inside, staged, tacks
from nmatrix.raster.shading.normals import angles_deg, unit
from nmatrix.raster.shading.space import length
from nmatrix.scene.geometry import Geometry, LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, SQUARES
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import LightKind, Sides
from nmatrix.scene.world import World

Array = NDArray[Any]

MIRRORED = World(scale=(-1, 1, 1))
AT_THE_LETTER = Pose((-4.1, 1.9, 8.4), radius=1.15)
ON_THE_FACE = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.45, -0.6, -1))


@dataclass(frozen=True)
class MirrorWords:
    """What is true of the picture of a mirror for one sign of det A."""

    title: str
    unsigned: str
    unsigned_caption: str
    winding: str
    winding_caption: str
    right_caption: str
    number: str


MIRROR_WORDS = {
    -1: MirrorWords(
        "Mirror a shape: keep the sign of det A, and flip the winding",
        "C *n*, sign lost",
        "Without the sign every normal changes sides, and the light with them.",
        "winding kept",
        "The front is culled: all that is left to see is the inside of the back.",
        "Every normal keeps its side, and the front is in front.",
        "a mirror is in the map: a rule that forgets the sign is 180° off",
    ),
    0: MirrorWords(
        "A shape without volume has no inside: no sign to keep",
        "C *n*, no sign",
        "Its two sides are alike, and the one that is seen is lit.",
        "winding kept",
        "No side is the back one, so none is culled.",
        "Its two sides are alike, and the one that is seen is lit.",
        "neither a mirror nor none: plus and minus are the same plane",
    ),
    1: MirrorWords(
        "No mirror in this map: the cofactors alone keep their sign",
        "C *n*, no sign",
        "The sign is plus: the cofactors lose nothing without it.",
        "winding flipped",
        "Flipped without a mirror, the front is culled: what is left is the inside.",
        "Every normal keeps its side, and the front is in front.",
        "no mirror is in the map: nothing is to be kept, nothing to be flipped",
    ),
}


def mirror(settings: ProofSettings) -> Proof:
    """Draw a shape, and its mirror image by cofactors without a sign, by old winding, rightly."""
    one = settings.object(settings.placed(MIRRORED), settings.geometry(LoadedGeometry(letter_r())))
    after = settings.scene(one, lights=(ON_THE_FACE,))
    (body,) = loaded(after).bodies
    sign = body.kind.determinant_sign
    words, keeps = MIRROR_WORDS[sign], Verdict.RIGHT if sign >= 0 else Verdict.WRONG
    slide = settings.slide(words.title)
    shown, second, third, last = slide.body(BELOW).columns(4, GUTTER)
    panels = (
        slide.panel(shown, "Before", caption="The shape before A, in the same light."),
        slide.panel(second, words.unsigned, keeps, words.unsigned_caption),
        slide.panel(
            third, words.winding, Verdict.WRONG if sign else Verdict.RIGHT, words.winding_caption
        ),
        slide.panel(last, "sign(det A) · C *n*", Verdict.RIGHT, words.right_caption),
    )
    unsigned = replace(after, settings=replace(after.settings, normals=NormalRule.COFACTOR))
    scenes = (
        replace(after, objects=(_before(settings, one, body),)),
        unsigned,
        replace(after, objects=(_inside_out(one),)) if sign else after,
        after,
    )
    stages = staged(slide, settings, AT_THE_LETTER, list(zip(panels, scenes, strict=True)))
    before, lost, culled, right = stages
    if sign and culled.drawn.rendered.work.fragments:
        put_inside(slide, panels[2], culled.drawn)
    if body.linear_map.rank > 1:
        for stage in stages:
            stage.outline()
            stage.lights()
        by = NormalRule.COFACTOR if sign < 0 else NormalRule.EXACT
        ink = Ink.WRONG if sign < 0 else Ink.RIGHT
        for stage, on, rule, colour in (
            (before, before, NormalRule.EXACT, Ink.NORMAL),
            (lost, right, by, ink),
            (right, right, NormalRule.EXACT, Ink.RIGHT),
        ):
            (seen,) = on.loaded.bodies
            stage.tacks(tacks(on, seen, rule, settings), colour, radius_of(seen))
    if not sign:
        slide.compare(panels[1], panels[2], same=True)
        slide.compare(panels[2], panels[3], same=True)
    slide.large_number(slide.frame.x, slide.frame.bottom - 48, _determinant(body), words.number)
    found = rule_error(right.drawn.plan, NormalRule.COFACTOR)
    return Proof.of(
        settings.subject,
        slide,
        f"Without the sign of det A the normals are {found.worst_deg or 0:.0f}° off.",
        [stage.drawn for stage in stages],
        numbers={"winding_level_difference": level_difference(culled.drawn, right.drawn)},
        max_level_difference=level_difference(lost.drawn, right.drawn),
        **found.errors,
    )


def _before(settings: ProofSettings, one: SceneObject, after: Body) -> SceneObject:
    """Return an object before its map, as large and in the place where the map brings it."""
    still = settings.still
    placed = loaded(still.scene(replace(one, world_from_object=World().world_from_object)))
    (own,) = placed.bodies
    k = radius_of(after) / radius_of(own)
    offset = tuple((after.centre - k * own.centre).tolist())
    return settings.object(World(scale=(k, k, k), translate=offset), one.geometry)


def _inside_out(one: SceneObject) -> SceneObject:
    """Return an object whose triangles all run the other way, so that its front is culled."""
    mesh = one.geometry.mesh()
    turned = replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))
    material = replace(one.material, sides=Sides.FRONT)
    return replace(one, geometry=LoadedGeometry(turned), material=material)


def _determinant(body: Body) -> str:
    """Write det A in three digits, or its sign alone where it takes more."""
    det, sign = body.linear_map.determinant, body.kind.determinant_sign
    if sign and Fraction(1, 1000) <= abs(det) < 10000:
        short = f"{float(det):.3g}"
        return f"det A {'=' if Fraction(short) == det else '≈'} {short}".replace("-", "−")
    return f"det A {'<=>'[sign + 1]} 0"


MOVED = World(translate=(2.6, 0, 0))
FROM_THE_FRONT = Pose((0.9, 2.1, 9.2), radius=2)
FROM_ABOVE_RIGHT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.5, -0.75, -0.6))
AXES = 0.75  # of the body's radius
BLOWN_DEG = 1.0  # a lean that can be seen
GHOST, GHOST_DASHES = 2.4, (7.0, 6.0)  # the outline of where a body was
WHOLE = 1 - 1e-6  # the length of a normal, but for rounding


@dataclass(frozen=True)
class Moved:
    """What a translation t does to a body's normals by wrong rules.

    `worst_deg` is the largest angle between A n + t and the right normal, `blown_deg` that between
    A n + t and A n; `shortest` the least length of a normal measured over four components.
    """

    body: Body
    t: Array
    worst_deg: float | None
    blown_deg: float
    shortest: float

    @classmethod
    def of(cls, scene: Scene) -> Moved:
        """Measure it over the vertices of the one body of a scene."""
        ready = loaded(scene)
        (body,) = ready.bodies
        by = {rule: normals_by(ready, body, rule).T for rule in NormalRule}
        some = by[NormalRule.EXACT].any(axis=1)
        blown = angles_deg(unit(by[NormalRule.TRANSLATED]), unit(by[NormalRule.NONE]))
        lengths = length(by[NormalRule.FOUR_COMPONENT][some].T)
        return cls(
            body,
            np.array([float(x) for x in rational.translation(body.world_from_object.exact)]),
            worst_at_vertices(ready, body, NormalRule.TRANSLATED),
            float(blown.max()),
            float(lengths.min()) if some.any() else 0.0,
        )

    @property
    def title(self) -> str:
        """The claim."""
        if self.worst_deg is None:
            return "Where no surface is left, no normal is, wherever it goes"
        if self.blown_deg >= BLOWN_DEG:
            return "A normal has no place: with w = 1 a translation blows it away"
        if self.t.any():
            return "So small a translation hides w = 1: test with a larger one"
        return "Without a translation w = 1 stays hidden: test with one"

    @property
    def moved(self) -> tuple[Verdict, str]:
        """Whether w = 1 is right here, and what it does."""
        if self.worst_deg is None:
            return Verdict.WRONG, "There is no normal to move."
        if self.blown_deg >= BLOWN_DEG:
            turned = "*n*" if self.body.kind.kind is Kind.IDENTITY else "A*n*"
            told = f"M moves the normal like a point: {turned} + *t*. All lean the way it went."
            return Verdict.WRONG, told
        if self.worst_deg < BLOWN_DEG:
            return Verdict.RIGHT, "The same arrows, the same shade: M moves nothing here."
        return Verdict.WRONG, "Hardly anything is moved here, but A itself bends the normals."

    @property
    def short(self) -> tuple[Verdict, str]:
        """Whether lengths over four components are right here, and what they do."""
        if self.body.linear_map.rank < 3:
            return Verdict.WRONG, "M has no inverse: no normal comes out, and no light falls."
        if self.shortest >= WHOLE:
            return Verdict.RIGHT, "The fourth component is 0 here, and every length is right."
        told = (
            f"A fourth component appears. Normalised with it, arrows shrink to {self.shortest:.2f}"
        )
        return Verdict.WRONG, f"{told} and the light with them."

    @property
    def number(self) -> tuple[str, str]:
        """The largest angle off, and what it means."""
        if self.worst_deg is None:
            return "", ""
        if self.worst_deg < INVISIBLE_DEG:
            return "0°", "off: neither mistake shows where nothing is moved"
        words = "off: every normal leans the way the shape went"
        if self.worst_deg > 90:
            words = "off: what faces back to where it came from now points into the shape"
        elif self.blown_deg < BLOWN_DEG:
            words = "off, and not by the translation"
        return f"up to {self.worst_deg:.3g}°", words


def translation(settings: ProofSettings) -> Proof:
    """Draw normals that a translation moved, and normals measured over four components."""
    one = settings.object(settings.placed(MOVED), settings.geometry(EGG))
    scene = settings.scene(one, lights=(FROM_ABOVE_RIGHT,))
    facts = Moved.of(scene)
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
    by_rule[1] = replace(by_rule[1], shading=Shading.GOURAUD)  # it keeps the lengths
    parts = [
        (panel, replace(scene, settings=chosen))
        for panel, chosen in zip(panels, by_rule, strict=True)
    ]
    reach = radius_of(facts.body)
    came_from = facts.body.positions_world - facts.t
    beside = np.concatenate([came_from, np.eye(3) * AXES * reach, np.zeros((1, 3))])
    stages = staged(slide, settings, FROM_THE_FRONT, parts, (beside,))
    right = stages[-1]
    for stage, panel, rule in zip(stages, panels, rules, strict=True):
        if facts.worst_deg is None:
            continue
        stage.outline()
        stage.lights()
        _way(stage, facts, came_from)
        ink = Ink.WRONG if panel.verdict is Verdict.WRONG else Ink.RIGHT
        stage.tacks(tacks(right, facts.body, rule, settings), ink, reach)
    for a, b in pairwise(panels):
        if a.verdict is b.verdict is Verdict.RIGHT:
            slide.compare(a, b, same=True)
    slide.large_number(slide.frame.x, slide.frame.bottom - 48, *facts.number)
    found = rule_error(right.drawn.plan, NormalRule.TRANSLATED)
    return Proof.of(
        settings.subject,
        slide,
        f"With w = 1 the normals are up to {found.worst_deg or 0:.2f}° off; normalised over four "
        f"components the shortest has length {facts.shortest:.3f}.",
        [stage.drawn for stage in stages],
        numbers={"shortest_normal": facts.shortest},
        max_level_difference=level_difference(stages[0].drawn, stages[1].drawn),
        **found.errors,
    )


def _way(stage: Stage, facts: Moved, came_from: Array) -> None:
    """Draw the origin with its axes, where a body was before it was moved, and its way."""
    palette = stage.canvas.palette
    origin = np.zeros(3)
    if facts.t.any():
        for chain in silhouettes(facts.body.mesh, came_from, stage.eye):
            stage.surface_line(chain, GHOST, palette.soft, dash=GHOST_DASHES)
    stage.axes(np.eye(3, 4, 1) * AXES * radius_of(facts.body))
    a, b = stage.place(origin), stage.place(facts.t)
    if facts.t.any() and a is not None and b is not None:
        arrow(stage.canvas, a, b, Ink.PLAIN, DIAGRAM_SHAFT)
        place = (a[0] + 0.3 * (b[0] - a[0]), a[1] + 0.3 * (b[1] - a[1]) - 14)
        stage.canvas.text(place, "*t*", HEADING, bold=True, align=0.5, halo=palette.stage)


FLAT = World(scale=(1, 0, 1), rotate_degrees=(14, 0, -16))
FROM_ABOVE = Pose((0.4, 5.2, 8.2), radius=1.6)
ONTO_THE_COIN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.5, -1, -0.35))
CELLS = 2.5  # of the coin's checker, to a unit
LONG = 0.5  # an arrow of the coin, of its radius
NOTHING = 64  # the size of what stands where there is no answer


def flatten(settings: ProofSettings) -> Proof:
    """Draw a flattened object: with no inverse, with a zero matrix, with the cofactors."""
    texture = CHECKER if settings.mesh is None else None
    one = settings.object(settings.placed(FLAT), settings.geometry(_coin()), texture=texture)
    scene = settings.scene(one, lights=(ONTO_THE_COIN,))
    (body,) = loaded(scene).bodies
    by_inverse = replace(scene, settings=replace(scene.settings, normals=NormalRule.INVERSE))
    left = body.linear_map.rank
    draw = _flattened if left == 2 else _kept if left == 3 else _gone
    slide, stages = draw(settings, by_inverse, scene)
    without, right = stages
    lost = level_difference(without.drawn, right.drawn)
    return Proof.of(
        settings.subject,
        slide,
        f"The cofactors still know the plane's normal; without it {lost} levels of light are lost.",
        [without.drawn, right.drawn],
        numbers={"rank": left},
        max_level_difference=lost,
        **rule_error(right.drawn.plan, NormalRule.INVERSE).errors,
    )


def _flattened(settings: ProofSettings, without: Scene, right: Scene) -> tuple[Slide, list[Stage]]:
    """Draw what a plane's normals are: nothing by an inverse, two by the cofactors."""
    slide = settings.slide("Flatten a shape: the inverse is gone, the plane's normal is not")
    boxes = slide.body(BELOW).columns(4, GUTTER)
    told = "A squeezes the ball to a coin. Its tangents span a plane, and a plane has a normal."
    circle_to_line(slide.canvas, slide.panel(boxes[0], "The idea", caption=told).stage)
    stops = "det A = 0. There is no inverse: a program stops here, or makes up numbers."
    hatched = slide.panel(boxes[1], "inv(A)", Verdict.WRONG, stops)
    panels = (
        slide.panel(
            boxes[2],
            "a zero matrix",
            Verdict.WRONG,
            "Normals of length 0: no arrow, and no light but the ambient one.",
        ),
        slide.panel(
            boxes[3],
            "C *n*, both sides",
            Verdict.RIGHT,
            "The cofactors C divide by nothing. Each of the two sides has its normal.",
        ),
    )
    stages = staged(slide, settings, FROM_ABOVE, list(zip(panels, (without, right), strict=True)))
    zero, lit = stages
    slide.no_answer(hatched, "1 / 0", NOTHING)
    Stage(slide.canvas, hatched.stage, lit.drawn).lost_outline()
    for stage in stages:
        stage.outline()
        stage.lights()
    (body,) = lit.loaded.bodies
    found = tacks(lit, body, NormalRule.EXACT, settings)
    for one in found:
        zero.nothing(one, radius_of(body))
        lit.arrow(one.place, one.place - LONG * radius_of(body) * one.normal, Ink.RIGHT)
    lit.tacks(
        [replace(one, arrow=one.arrow * LONG / ARROW) for one in found], Ink.RIGHT, radius_of(body)
    )
    return slide, stages


def _kept(settings: ProofSettings, without: Scene, right: Scene) -> tuple[Slide, list[Stage]]:
    """Draw that a map which flattens nothing has an inverse, as good as float64 computes it."""
    ready = loaded(right)
    (body,) = ready.bodies
    worst = worst_at_vertices(ready, body, NormalRule.INVERSE) or 0.0
    title = "This map flattens nothing: it has an inverse, and either rule does"
    inverse = "Its inverse is there: the same arrows, the same shade."
    if worst >= INVISIBLE_DEG:
        title = f"Almost flat: an inverse in float64 is up to {worst:.3g}° off"
        inverse = "An inverse is there, but floats do not find it: det A is lost in rounding."
    slide = settings.slide(title)
    boxes = slide.body(BELOW).columns(2, GUTTER)
    fine = Verdict.RIGHT if worst < INVISIBLE_DEG else Verdict.WRONG
    panels = (
        slide.panel(boxes[0], "inv(A)^{T} *n*", fine, inverse),
        slide.panel(
            boxes[1], "sign(det A) · C *n*", Verdict.RIGHT, "The cofactors C divide by nothing."
        ),
    )
    stages = staged(slide, settings, FROM_ABOVE, list(zip(panels, (without, right), strict=True)))
    rules = NormalRule.INVERSE, NormalRule.EXACT
    for stage, panel, rule in zip(stages, panels, rules, strict=True):
        stage.outline()
        stage.lights()
        ink = Ink.WRONG if panel.verdict is Verdict.WRONG else Ink.RIGHT
        stage.tacks(tacks(stages[1], body, rule, settings), ink, radius_of(body))
    if fine is Verdict.RIGHT:
        slide.compare(*panels, same=True)
    return slide, stages


def _gone(settings: ProofSettings, without: Scene, right: Scene) -> tuple[Slide, list[Stage]]:
    """Draw that a line or a point has no normal, and that the cofactors say so."""
    (body,) = loaded(right).bodies
    left = NO_SURFACE[body.linear_map.rank]
    slide = settings.slide(f"Flattened to {left}: no plane is left, and no normal")
    boxes = slide.body(BELOW).columns(2, GUTTER)
    panels = (
        slide.panel(
            boxes[0],
            "inv(A)",
            Verdict.WRONG,
            "det A = 0. There is no inverse: a program stops here, or makes up numbers.",
        ),
        slide.panel(
            boxes[1],
            "C *n* = 0",
            Verdict.RIGHT,
            f"The cofactors C are all 0, and that is true: {left} has no plane.",
        ),
    )
    stages = staged(slide, settings, FROM_ABOVE, list(zip(panels, (without, right), strict=True)))
    return slide, stages


def _coin() -> Geometry:
    """Return a ball whose checker is laid on it from above."""
    ball = EGG.mesh()
    return LoadedGeometry(replace(ball, uv=ball.positions[:, [0, 2]] * CELLS / SQUARES))
