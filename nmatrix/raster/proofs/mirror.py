"""The proof that a mirror turns normals and triangles around: keep a sign, flip the winding."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import Enum, auto
from fractions import Fraction

import numpy as np

from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.slide import GUTTER
from nmatrix.enums import NormalRule
from nmatrix.linear.rational import linear_part
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, loaded
from nmatrix.raster.overlay.stage import Stage, radius_of
from nmatrix.raster.proofs.angles import normals_by, rule_error
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import NO_SURFACE, Pose, put_inside, staged, tacks
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import SceneObject
from nmatrix.scene.words import LightKind, Sides
from nmatrix.scene.world import World

MIRRORED = World(scale=(-1, 1, 1))
AT_THE_LETTER = Pose((-5.4, 2.0, 7.8), radius=1.25, room=0.1, free=(20, 112, 20, 30))
ON_THE_FACE = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-0.45, -0.6, -1))
BELOW = 244.0  # units under the stages, for captions and a number under them


class Part(Enum):
    """What a panel shows."""

    BEFORE = auto()
    UNSIGNED = auto()
    CULLED = auto()
    RIGHT = auto()


@dataclass(frozen=True)
class Words:
    """What is true of the picture for one sign of det A.

    `panels` are those that differ, in their order, each with its heading, verdict and caption: under
    some maps a mistake is none. `number` explains the determinant.
    """

    title: str
    panels: Mapping[Part, tuple[str, Verdict | None, str]]
    number: str
    verdict: str


BEFORE = ("Before", None, "The shape before A, in the same light.")
KEPT = "Every normal keeps its side, and the front is in front."
WORDS = {
    -1: Words(
        "Mirror a shape: keep the sign of det A, and flip the winding",
        {
            Part.BEFORE: BEFORE,
            Part.UNSIGNED: (
                "C *n*, sign lost",
                Verdict.WRONG,
                "Without the sign every normal changes sides, and the light with them.",
            ),
            Part.CULLED: (
                "winding kept",
                Verdict.WRONG,
                "The front is culled: all that is left to see is the inside of the back.",
            ),
            Part.RIGHT: ("sign(det A) · C *n*", Verdict.RIGHT, KEPT),
        },
        "a mirror is in the map: a rule that forgets the sign is 180° off",
        "Without the sign of det A the normals are 180° off.",
    ),
    0: Words(
        "A shape without volume has no inside: no sign to keep",
        {
            Part.BEFORE: BEFORE,
            Part.RIGHT: (
                "C *n*, both sides",
                Verdict.RIGHT,
                "Its two sides are alike, and the one that is seen is lit.",
            ),
        },
        "neither a mirror nor none: plus and minus stand on the same plane",
        "det A is 0: this map has no sign to lose, and no inside to show.",
    ),
    1: Words(
        "No mirror in this map: the cofactors alone keep their sign",
        {
            Part.BEFORE: BEFORE,
            Part.CULLED: (
                "winding flipped",
                Verdict.WRONG,
                "Flipped without a mirror, the front is culled: what is left is the inside.",
            ),
            Part.RIGHT: ("C *n*, with or without sign", Verdict.RIGHT, KEPT),
        },
        "no mirror is in the map: a sign of plus can be forgotten",
        "det A is positive: without its sign the normals are the same.",
    ),
}
NO_WORDS = Words(
    "No surface is here, and so no normal to mirror",
    {
        Part.BEFORE: BEFORE,
        Part.RIGHT: ("C *n*", None, "The cofactors find no side that a normal could be on."),
    },
    "",
    "No normal is here to be mirrored.",
)


def mirror(settings: ProofSettings) -> Proof:
    """Draw a shape, and its mirror image by cofactors without a sign, by old winding, rightly."""
    one = settings.object(settings.placed(MIRRORED), settings.geometry(LoadedGeometry(letter_r())))
    after = settings.scene(one, lights=(ON_THE_FACE,))
    (body,) = loaded(after).bodies
    has_normals = bool(normals_by(loaded(after), body, NormalRule.EXACT).any())
    words = WORDS[body.kind.determinant_sign] if has_normals else NO_WORDS
    parts = [part for part in words.panels if part is not Part.BEFORE or _is_changed(body)]
    slide = settings.slide(words.title)
    panels = {
        part: slide.panel(box, *words.panels[part])
        for part, box in zip(parts, slide.body(BELOW).columns(len(parts), GUTTER), strict=True)
    }
    without_sign = replace(after.settings, normals=NormalRule.COFACTOR)
    scenes = {
        Part.BEFORE: replace(after, objects=(_before(settings, one, body),)),
        Part.UNSIGNED: replace(after, settings=without_sign),
        Part.CULLED: replace(after, objects=(_inside_out(one),)),
        Part.RIGHT: after,
    }
    drawn = staged(slide, settings, AT_THE_LETTER, [(panels[part], scenes[part]) for part in parts])
    stages = dict(zip(parts, drawn, strict=True))
    right = stages[Part.RIGHT]
    if has_normals:
        slide.large_number(slide.frame.x, slide.frame.bottom - 56, _determinant(body), words.number)
    elif right.drawn.rendered.work.fragments:
        slide.no_answer(panels[Part.RIGHT], NO_SURFACE[body.linear_map.rank])
    for part, stage in stages.items():
        if not stage.drawn.rendered.work.fragments:
            continue
        if part is Part.CULLED:
            put_inside(slide, panels[part], stage.drawn)
        if has_normals or part is Part.BEFORE:
            _mark(part, stage, right, settings)
    changes = {part: level_difference(stage.drawn, right.drawn) for part, stage in stages.items()}
    return Proof.of(
        settings.subject,
        slide,
        words.verdict,
        [stage.drawn for stage in drawn],
        numbers={"winding_level_difference": changes.get(Part.CULLED, 0)},
        max_level_difference=changes.get(Part.UNSIGNED, 0),
        **rule_error(right.drawn.plan, NormalRule.COFACTOR).errors,
    )


def _mark(part: Part, stage: Stage, right: Stage, settings: ProofSettings) -> None:
    """Draw edges, the light, and the normals of a part; the same places as on the right one."""
    stage.outline()
    stage.lights()
    rule, ink = {
        Part.BEFORE: (NormalRule.EXACT, Ink.NORMAL),
        Part.UNSIGNED: (NormalRule.COFACTOR, Ink.WRONG),
        Part.CULLED: (None, Ink.WRONG),
        Part.RIGHT: (NormalRule.EXACT, Ink.RIGHT),
    }[part]
    on = stage if part is Part.BEFORE else right
    (body,) = on.loaded.bodies
    if rule is not None:
        stage.tacks(tacks(on, body, rule, settings), ink, radius_of(body))


def _is_changed(body: Body) -> bool:
    """True if the map does more than move a body and make it larger."""
    A = linear_part(body.world_from_object.exact)
    return A[0][0] <= 0 or any(
        A[i][j] != (A[0][0] if i == j else 0) for i in range(3) for j in range(3)
    )


def _before(settings: ProofSettings, one: SceneObject, after: Body) -> SceneObject:
    """Return an object before its map, as large and in the place where the map brings it."""
    unmoved = replace(one, world_from_object=World().world_from_object)
    (own,) = loaded(settings.still.scene(unmoved)).bodies
    k = radius_of(after) / radius_of(own)
    offset = tuple((after.centre - k * own.centre).tolist())
    return settings.object(World(scale=(k, k, k), translate=offset), one.geometry)


def _inside_out(one: SceneObject) -> SceneObject:
    """Return an object whose triangles all run the other way, so that its front is culled."""
    mesh = one.geometry.mesh()
    turned = replace(
        mesh,
        triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]),
        normals=-mesh.normals,  # so that walls are told apart inside too
    )
    material = replace(one.material, sides=Sides.FRONT)
    return replace(one, geometry=LoadedGeometry(turned), material=material)


def _determinant(body: Body) -> str:
    """Write det A in three digits, or its sign alone where it takes more."""
    det, sign = body.linear_map.determinant, body.kind.determinant_sign
    if sign and Fraction(1, 1000) <= abs(det) < 1000:
        short = f"{float(det):.3g}"
        return f"det A {'=' if Fraction(short) == det else '≈'} {short}".replace("-", "−")
    return f"det A {'<=>'[sign + 1]} 0"
