"""The proof that shading and reflection are two choices: where light is computed, and how."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import cos, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import EDGE, disc, eye, ramp_bar
from nmatrix.canvas.marks import Box, Canvas, Point
from nmatrix.canvas.slide import CAPTION, GUTTER, NARROW_HEADING, Panel, Slide
from nmatrix.enums import Effect, Reflection, Shading
from nmatrix.errors import counted
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import Pose, bar_of, put_map, staged
from nmatrix.raster.shading.lighting import Lighting, ShadingLight
from nmatrix.raster.shading.space import Measure
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

Array = NDArray[Any]

COARSE, FINE = (ShapeGeometry(Shape.TORUS, cells) for cells in ((9, 18), (72, 144)))
FROM_THE_LEFT = SceneLight("sun", LightKind.DIRECTIONAL, direction=(0.17, -0.97, 0.15))
FROM_ABOVE = Pose((0, 6.2, 7.6), radius=1.4, up=(0.5, 1, 0), room=0.0, free=(16, 14, 16, 64))
LABELS, ROWS_APART, BELOW = 224.0, 66.0, 86.0  # units
WHERE = {
    Shading.FLAT: "flat: once a face",
    Shading.GOURAUD: "Gouraud: at corners",
    Shading.PHONG: "Phong: every pixel",
}
HOW = {
    Reflection.LAMBERT: "Lambert: matte",
    Reflection.PHONG: "Phong: mirrored ray",
    Reflection.BLINN_PHONG: "Blinn–Phong: halfway",
    Reflection.TOON: "toon: steps",
}
Weights = tuple[float, float, float]  # of the corners of a triangle
CORNERS: tuple[Weights, ...] = ((1, 0, 0), (0, 1, 0), (0, 0, 1))
MIDDLE: tuple[Weights, ...] = ((1 / 3, 1 / 3, 1 / 3),)
EVERYWHERE: tuple[Weights, ...] = tuple(
    (i / 5, j / 5, (5 - i - j) / 5) for i in range(6) for j in range(6 - i)
)
GLOSS = grey(0.45)
ROW_NAME = 40
SIDE, DOT = 72.0, 8.0  # of the triangle that shows where
LOBE, EYE_AT = 74.0, 42.0  # units of a lobe where it is white; degrees off the normal
LEAST_SEEN = 0.01  # of white


def shading(settings: ProofSettings) -> Proof:
    """Draw where light is computed: by face, by corner, by pixel; and how it bounces, four ways."""
    slide = settings.slide(
        "Shading says where the light is computed, reflection says how it bounces"
    )
    upper, lower = slide.body(BELOW).rows(2, ROWS_APART)
    told = "A dot is one computation of light. All else is mixed from these."
    *places, last = _row(slide, upper, "Where", told)
    gloss = settings.reflection or Reflection.PHONG
    parts = [
        (slide.panel(place, words, size=NARROW_HEADING), _scene(settings, COARSE, gloss, one))
        for place, (one, words) in zip(places, WHERE.items(), strict=True)
    ]
    told = "A lobe is long where light that comes from there looks bright to the eye."
    parts += [
        (
            slide.panel(place, words, size=NARROW_HEADING),
            _scene(settings, FINE, one, Shading.PHONG),
        )
        for place, (one, words) in zip(_row(slide, lower, "How", told), HOW.items(), strict=True)
    ]
    pose = FROM_ABOVE if settings.mesh is None else replace(FROM_ABOVE, up=(0, 1, 0))
    stages = staged(slide, settings, pose, parts)
    where, how = stages[:3], stages[3:]
    for stage, dots in zip(where, (MIDDLE, CORNERS, EVERYWHERE), strict=True):
        stage.outline(sharp=False)
        stage.lights()
        _triangle(slide.canvas, stage.box, dots)
    for stage in how:
        stage.outline()
        stage.lights()
        _lobe(slide.canvas, stage.box, stage.loaded.bodies[0].material)
    panel = slide.panel(last, "Gouraud − Phong", size=NARROW_HEADING)
    most = _difference(slide, panel, *where[1:])
    slide.footer(f"These are choices, not mistakes. {_apart(most)}", x=where[0].box.x)
    flat, gouraud, phong, _, mirrored, half, toon = (one.drawn for one in stages)
    numbers = {
        "flat_against_phong": level_difference(flat, phong),
        "gouraud_against_phong": level_difference(gouraud, phong),
        "phong_against_blinn_phong": level_difference(mirrored, half),
        "toon_levels": len(np.unique(toon.levels)),
    }
    found = Proof.of(
        settings.subject,
        slide,
        _verdict(numbers["gouraud_against_phong"]),
        [one.drawn for one in stages],
        numbers=numbers,
        max_level_difference=numbers["flat_against_phong"],
    )
    return replace(found, effects=mirrored.effects)


def _row(slide: Slide, box: Box, words: str, told: str) -> tuple[Box, ...]:
    """Write what a row is about beside it; return the boxes of its four stages."""
    slide.canvas.text((box.x, box.y + 40), words, ROW_NAME, bold=True)
    slide.canvas.paragraph((box.x, box.y + 84), told, CAPTION, LABELS - 1.6 * GUTTER)
    return Box(box.x + LABELS, box.y, box.width - LABELS, box.height).columns(4, GUTTER)


def _scene(
    settings: ProofSettings, torus: ShapeGeometry, reflection: Reflection, shading: Shading
) -> Scene:
    one = settings.object(
        settings.placed(World()), settings.geometry(torus), reflection=reflection, specular=GLOSS
    )
    scene = settings.scene(one, lights=(FROM_THE_LEFT,))
    return replace(scene, settings=replace(scene.settings, shading=shading))


def _difference(slide: Slide, panel: Panel, one: Stage, other: Stage) -> float:
    """Draw where two pictures differ, with its bar; return by how much at the most, of white."""
    apart = np.abs(one.drawn.rendered.rgb - other.drawn.rendered.rgb).max(axis=2)
    most = float(apart.max())
    end = max(most, LEAST_SEEN)
    put_map(slide, panel, other.drawn, apart / end, other.depth.coverage).outline(sharp=False)
    ramp_bar(slide.canvas, bar_of(panel), ("0", f"{100 * end:.0f} %"))
    return most


def _verdict(most: int) -> str:
    if not most:
        return "Here Gouraud and Phong shading give the same picture."
    return (
        f"Gouraud shading is up to {counted(most, 'level')} from Phong shading: between its "
        "corners it has no light of its own."
    )


def _apart(most: float) -> str:
    if most < LEAST_SEEN:
        return "Here Gouraud and Phong shading cannot be told apart."
    return f"Here Gouraud and Phong shading are up to {100 * most:.0f} % of white apart."


def _triangle(canvas: Canvas, stage: Box, dots: Sequence[Weights]) -> None:
    """Draw a triangle in the lower right corner, with a dot where light is computed."""
    palette, (x, y) = canvas.palette, (stage.right - 22, stage.bottom - 18)
    corners = ((x - SIDE, y - 0.9 * SIDE), (x, y - 0.62 * SIDE), (x - 0.62 * SIDE, y))
    canvas.polygon(corners, fill=palette.paper, edge=palette.ink, width=2 * EDGE)
    radius = DOT if len(dots) <= len(corners) else DOT / 2
    for weights in dots:
        place = tuple(
            sum(w * corner[axis] for w, corner in zip(weights, corners, strict=True))
            for axis in (0, 1)
        )
        disc(canvas, (place[0], place[1]), radius, palette.light, palette.ink)


def _lobe(canvas: Canvas, stage: Box, material: Material) -> None:
    """Draw how bright a point of a surface looks to an eye, by where light comes from."""
    palette, middle = canvas.palette, (stage.right - 84, stage.bottom - 16)
    ends = ((middle[0] - 68, middle[1]), (middle[0] + 68, middle[1]))
    turns = np.radians(np.linspace(-90, 90, 181))
    bright = _brightness(material, turns)
    lobe = [_from(middle, turn, LOBE * far) for turn, far in zip(turns, bright, strict=True)]
    canvas.polygon(lobe, fill=palette.light, edge=palette.ink, width=2 * EDGE)
    canvas.stroke(ends, 3.2, palette.ink)
    far = _from(middle, -radians(EYE_AT), 70.0)
    near = _from(middle, -radians(EYE_AT), 8.0)
    canvas.stroke((far, near), 2.6, palette.eye, dash=(6, 4))
    eye(canvas, far, (near[0] - far[0], near[1] - far[1]), 13.0)


def _brightness(material: Material, turns: Array) -> Array:
    """Compute what the eye sees of light from some angles off the normal, by the shader itself."""
    effects = {Effect.DIFFUSE}
    if material.shines:
        effects |= {Effect.SPECULAR, Effect.EYE}
    if material.reflection is Reflection.TOON:
        effects |= {Effect.TOON}
    eye_at = np.array([[-sin(radians(EYE_AT))], [cos(radians(EYE_AT))], [0.0]])
    light = ShadingLight(np.ones((3, 1)), np.stack([np.sin(turns), np.cos(turns), 0 * turns]))
    lighting = Lighting(material, (light,), np.zeros((3, 1)), eye_at, Measure(), frozenset(effects))
    normals = np.repeat([[0.0], [1.0], [0.0]], len(turns), axis=1)
    matte, gloss = lighting.light(normals, np.zeros_like(normals))
    return np.asarray((matte if gloss is None else matte + gloss).mean(axis=0))


def _from(place: Point, turn: float, far: float) -> Point:
    """Return the point so far from another, at an angle to the right of upwards."""
    return place[0] + far * sin(turn), place[1] - far * cos(turn)
