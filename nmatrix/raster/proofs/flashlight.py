"""The proof that a flashlight is a light whose place is given in camera space.

Someone walks around a body at night. A light that was put into the world stays behind; one that is
given in camera space is carried, and what is looked at stays lit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import asin, hypot, radians, sin
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas import glyphs
from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.marks import Box, Point
from nmatrix.canvas.slide import HEADING, Panel, Row, Slide
from nmatrix.enums import Theme
from nmatrix.errors import counted
from nmatrix.linear.projection import Window
from nmatrix.raster.drawn_scene import drawn_scene, level_difference
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.overlay.stage import Stage, radius_of, through
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import draw_on
from nmatrix.raster.shading.space import as_array
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.fitting import enclosing
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import EYE, WORLD, SceneLight
from nmatrix.scene.material import CHECKER, grey
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import LightKind, Shape, Sides
from nmatrix.scene.world import World

Array = NDArray[Any]

VASE = World(scale=(0.55, 1, 0.55))
WALK = 118  # degrees
CONE = (9.0, 15.0)  # half angles
EYE_AT, FIELD = (0.0, 0.9, 5.0), 38.0  # from the middle of the body, in its radius; degrees
FLOOR = 3.4  # half a side
POST = (-1.2, -1.3), (0.2, 1.05, 0.2)
BALL = (1.35, 0.5), 0.45
BEAM, NIGHT_LIGHT = (1.0, 0.93, 0.78), (0.4, 0.4, 0.46)
NIGHT, PRINTED_NIGHT = (0.035, 0.045, 0.075), grey(0.045)
COUNTED = (65, 65)  # pixels, whatever the size of the slide: the one in the middle is asked
BELOW = 76.0  # units under the stages
PLACES = ("from place 1", "from place 2", "seen from above")
ROWS = (
    Row("left behind", Verdict.WRONG, "its place was given in the world"),
    Row("carried", Verdict.RIGHT, "its place is the eye’s: 0 0 0 in camera space"),
)
PLAN_PAD = 48.0  # units around the walk on the plan, for eyes and their numbers
BACK, ASIDE = 28.0, 38.0  # of an eye behind its place, and of its number aside


def flashlight(settings: ProofSettings) -> Proof:
    """Walk around a body with a light that is left in the world, and with one that is carried."""
    walked = (WALK + settings.picture.turn_degrees) % 360
    settings = settings.still
    slide = settings.slide("A flashlight is a light whose place is given in camera space")
    panels = slide.table(slide.body(BELOW), ROWS, PLACES, undecided=1)
    carried = _night(settings, panels[0][0].stage)
    (here,) = (one for one in loaded(carried).lights if one.light.fixed_to == EYE)
    assert here.position is not None and here.direction is not None  # a spot light
    left = replace(here.light, fixed_to=WORLD, position=here.position, direction=here.direction)
    behind = replace(carried, lights=(left, *carried.lights[1:]))
    night = PRINTED_NIGHT if settings.theme is Theme.PRINT else NIGHT
    drawn = [
        [
            draw_on(slide, panel, _walked(scene, turn), background=night)
            for panel, turn in zip(row, (0, walked), strict=False)
        ]
        for row, scene in zip(panels, (behind, carried), strict=True)
    ]
    walk = Walk.between([stage.loaded for stage in drawn[1]], walked)
    for row, lit_from in zip(panels, ((0,), (0, 1)), strict=True):
        _plan(slide, row[2], carried, walk, lit_from)
    for i in (0, 1):
        if level_difference(drawn[0][i].drawn, drawn[1][i].drawn) == 0:
            slide.compare(panels[0][i], panels[1][i], same=True)
    slide.footer(
        f"Walk {walked:.4g}° around: what you look at must stay lit.", x=panels[0][0].stage.x
    )
    before = _middle(carried, 0)
    changed = [abs(before - _middle(scene, walked)) for scene in (behind, carried)]
    return Proof.of(
        settings.subject,
        slide,
        f"Walking around, the middle changes by {counted(changed[0], 'level')} under the light "
        f"that is left behind, by {changed[1]} under the flashlight.",
        [stage.drawn for row in drawn for stage in row],
        numbers={"middle_change_world": changed[0], "middle_change_eye": changed[1]},
        max_level_difference=max(changed),
    )


def _night(settings: ProofSettings, box: Box) -> Scene:
    """Return the scene with the light that is carried: the body on a floor, a post, a ball."""
    one = settings.object(settings.placed(VASE), LoadedGeometry(settings.geometry().mesh()))
    (body,) = loaded(settings.scene(one)).bodies
    (x, middle, z), unit = body.centre.tolist(), radius_of(body)
    ground = float(body.box[0][1])

    def thing(name: str, shape: Shape, at: Vector, scale: Vector) -> SceneObject:
        place = tuple(a + unit * b for a, b in zip((x, ground, z), at, strict=True))
        world = World(translate=place, scale=tuple(unit * side for side in scale))
        geometry = LoadedGeometry(ShapeGeometry(shape).mesh())  # once, not for every picture
        return SceneObject(name, geometry, world.world_from_object, settings.material())

    (post_x, post_z), post = POST
    (ball_x, ball_z), ball = BALL
    floor = thing("floor", Shape.PLANE, (0, -1e-3, 0), (FLOOR, 1, FLOOR))
    stone = settings.material(texture=CHECKER, sides=Sides.BOTH, diffuse=grey(0.95))
    objects = (
        one,
        thing("post", Shape.BOX, (post_x, post[1], post_z), post),
        thing("ball", Shape.SPHERE, (ball_x, ball, ball_z), (ball,) * 3),
        replace(floor, material=stone),
    )
    is_print = settings.theme is Theme.PRINT
    torch = SceneLight(
        "flashlight",
        LightKind.SPOT,
        direction=(0, 0, -1),
        color=grey(1.0) if is_print else BEAM,
        intensity=1.7,
        attenuation=(1.0, 0.0, 0.02 / unit**2),
        cone_degrees=CONE,
        fixed_to=EYE,
    )
    night = SceneLight("night", LightKind.AMBIENT, color=grey(0.42) if is_print else NIGHT_LIGHT)
    eye = tuple(a + unit * b for a, b in zip((x, middle, z), EYE_AT, strict=True))
    far = hypot(*EYE_AT) + 2 * FLOOR
    view = settings.view or View(eye=eye, target=(x, middle, z))
    own = Lens(fov_degrees=FIELD, aspect=box.width / box.height, near=unit / 4, far=far * unit)
    lens = own if settings.view is None else through(settings.lens, box)
    scene = settings.scene(*objects)
    return replace(scene, lights=(torch, night), view=view, lens=lens, has_camera=True)


def _walked(scene: Scene, turn: float) -> Scene:
    return replace(scene, settings=replace(scene.settings, turn_degrees=turn))


def _middle(scene: Scene, turn: float) -> int:
    """Return the level in the middle of a small picture from so far around."""
    found = drawn_scene(_walked(scene, turn), size=COUNTED, samples=1).levels
    return int(found[COUNTED[1] // 2, COUNTED[0] // 2, 0])


@dataclass(frozen=True, eq=False)
class Walk:
    """The way around the body: both places with what is looked at from there, and the turn."""

    places: tuple[Array, ...]
    looks: tuple[Array, ...]
    middle: Array
    turn: float

    @classmethod
    def between(cls, seen: Sequence[LoadedScene], turn: float) -> Walk:
        """Read the way from the cameras of the two places."""
        places = tuple(np.array([float(side) for side in one.eye]) for one in seen)
        looks = tuple(-as_array(one.camera_from_world.exact)[2, :3] for one in seen)
        middle, _ = enclosing([body.ball for body in seen[0].bodies])
        return cls(places, looks, middle, turn)

    def way(self, turn: float) -> Array:
        """Return points (n, 3) of the circle from the first place, so many degrees around."""
        x, _, z = self.places[0] - self.middle
        turns = np.radians(np.linspace(0, turn, 97))
        away = [x * np.cos(turns) + z * np.sin(turns), z * np.cos(turns) - x * np.sin(turns)]
        height = np.full_like(turns, self.places[0][1])
        return np.stack([self.middle[0] + away[0], height, self.middle[2] + away[1]], axis=1)


def _plan(slide: Slide, panel: Panel, scene: Scene, walk: Walk, lit_from: Sequence[int]) -> None:
    """Draw what is where, seen from straight above, with the light as it is at some places."""
    stage = _from_above(slide, panel, scene, walk)
    canvas, palette = slide.canvas, slide.palette
    floor = stage.window(np.array(_floor_corners(scene)))[:, :2]
    canvas.polygon(floor, fill=palette.paper, edge=palette.grid, width=2.4)
    for i in lit_from:
        beam = _beam(walk, i)
        opacity = 0.75 if i == lit_from[-1] else 0.3
        outline = _inside(panel.stage, stage.window(beam)[:, :2])
        canvas.polygon(
            outline, fill=palette.light, edge=palette.ink, width=glyphs.EDGE, opacity=opacity
        )
    stage.cut_out(palette.body)
    stage.path(walk.way(walk.turn), Ink.EYE)
    stage.lamp(walk.places[lit_from[-1]].tolist(), radius=11)
    for i, (place, look) in enumerate(zip(walk.places, walk.looks, strict=True)):
        _walker(stage, place, look, str(i + 1))


def _from_above(slide: Slide, panel: Panel, scene: Scene, walk: Walk) -> Stage:
    """Return a stage that looks straight down on all but the floor; nothing is laid on it yet."""
    box = panel.stage
    circle = walk.way(360)
    low, high = (
        np.array([*_floor_corners(scene), *circle]).min(axis=0),
        np.array([*_floor_corners(scene), *circle]).max(axis=0),
    )
    middle, sides = (low + high) / 2, high - low
    per_unit = max(
        sides[0] / (box.width - 2 * PLAN_PAD), sides[2] / (box.height - 2 * PLAN_PAD), 1e-9
    )
    tall = float(max(sides))
    half = box.width / 2 * per_unit, box.height / 2 * per_unit
    window = Window(-half[0], half[0], -half[1], half[1])
    top = (float(middle[0]), float(high[1]) + 2 * tall, float(middle[2]))
    target = (top[0], top[1] - 1, top[2])
    view = View(eye=top, target=target, up=(0, 0, -1))
    lens = Lens(ortho=window, near=tall / 4, far=8 * tall)
    seen = replace(scene, objects=scene.objects[:-1], view=view, lens=lens)
    size = slide.canvas.pixels_of(box)
    return Stage(slide.canvas, box, drawn_scene(seen, keeps_depth=True, size=size))


def _floor_corners(scene: Scene) -> list[Array]:
    """Return the corners of the floor in the world, in their order around it."""
    place = as_array(scene.objects[-1].world_from_object)
    corners = ((-1, -1), (1, -1), (1, 1), (-1, 1))
    return [place[:3] @ np.array([x, 0.0, z, 1.0]) for x, z in corners]


def _beam(walk: Walk, i: int) -> Array:
    """Return the outline (n, 3) of the light's cone from a place, as it is seen from above.

    A cone whose axis dips looks wider from above: sin h = sin a / cos p for its half angle a and
    its pitch p.
    """
    place, look = walk.places[i], walk.looks[i]
    level = float(np.hypot(look[0], look[2]))
    half = asin(min(sin(radians(CONE[1])) / max(level, 1e-9), 1.0))
    away = place - walk.middle
    long = 1.6 * float(np.hypot(away[0], away[2]))
    heading = np.arctan2(look[2], look[0])
    turns = heading + np.linspace(-half, half, 33)
    rim = place + long * np.stack([np.cos(turns), np.zeros(33), np.sin(turns)], axis=1)
    return np.concatenate([place[None], rim])


def _inside(box: Box, fan: Array) -> Array:
    """Shorten a fan (n, 2), whose first point is its hub, until it stays inside a box."""
    away = fan[1:] - fan[0]
    room = np.where(away > 0, [box.right, box.bottom], [box.x, box.y]) - fan[0]
    parts = np.divide(room, away, out=np.ones_like(away), where=np.abs(away) > 1e-9)
    return np.concatenate([fan[:1], fan[0] + min(1.0, float(parts.min())) * away])


def _walker(stage: Stage, place: Array, look: Array, number: str) -> None:
    """Draw an eye that looks along a direction, behind the light in its hand, and its number."""
    at = stage.place(place)
    x, y = stage.direction(look)
    size = hypot(x, y)
    if at is None or not size:
        return
    towards: Point = (x / size, y / size)
    back = at[0] - BACK * towards[0], at[1] - BACK * towards[1]
    glyphs.eye(stage.canvas, back, towards)
    beside = back[0] + ASIDE * towards[1], back[1] - ASIDE * towards[0] + 10
    colour = stage.canvas.palette.eye
    stage.canvas.text(beside, number, HEADING, colour, bold=True, align=0.5)
