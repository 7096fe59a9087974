"""The proof that a light must be moved to its space: left in model space it turns with the model.

A body stands on a turntable. The wrong program carries its lamp along by the map that turns the
table; the right one leaves it where it is.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import atan2, degrees, hypot
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.marks import Box
from nmatrix.canvas.slide import Row
from nmatrix.canvas.theme import PALETTES, channels
from nmatrix.linear.affine import rotation_about_axis
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import RationalMatrix, affine_matrix, product
from nmatrix.raster.drawn_scene import DrawnScene, level_difference
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.overlay.stage import Stage, through
from nmatrix.raster.planning.plan import everything
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import IDENTITY, Proof, ProofSettings, turned_light
from nmatrix.raster.proofs.staging import Pose, draw_on
from nmatrix.raster.render import surface_of
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import LightKind, Sides
from nmatrix.scene.world import World

Array = NDArray[Any]

LAMP = (1.02, 1.83, 1.1)  # from the middle of the table, where the body's farthest point is at 1
IN_FRONT = Pose((0, 2.6, 8.6), radius=2.3, room=0.06)
TURNS = (0, 60, 160)  # degrees
AXIS = (0, -1, 0)  # clockwise seen from above: at first the light comes to the front
TICKS = 12
BELOW = 76.0  # units under the stages
INVISIBLE = 0.5 / 255  # of the light: half a level
AROUND = np.linspace(0, 2 * np.pi, 97)
ROWS = (
    Row("stuck", Verdict.WRONG, "its light turns with the table"),
    Row("right", Verdict.RIGHT, "its light stays in the world"),
)


@dataclass(frozen=True)
class Turntable:
    """The table under a body: a disc about the world's y axis that all of the body turns above.

    `top` and `reach` are how high and how far from the axis the body goes.
    """

    radius: float
    ground: float
    top: float
    reach: float

    @classmethod
    def under(cls, points: Array) -> Turntable:
        """Find the table for a body with these vertices (n, 3) in the world."""
        away = float(np.hypot(points[:, 0], points[:, 2]).max())
        low, high = float(points[:, 1].min()), float(points[:, 1].max())
        return cls(1.25 * max(away, 0.3 * (high - low)) or 1.0, low, high, away)

    @property
    def lamp(self) -> SceneLight:
        """A lamp beside the body, whatever its size: outside of all that it sweeps."""
        unit = hypot((self.top - self.ground) / 2, self.reach) or 1.0
        x, y, z = (unit * side for side in LAMP)
        return SceneLight("lamp", LightKind.POINT, position=(x, self.ground + y, z))

    @cached_property
    def mesh(self) -> Mesh:
        """Build the disc, a hair under the body."""
        rim = around(self.radius, self.ground)[:-1]
        middle = [[0.0, self.ground, 0.0]]
        points = np.concatenate([rim, middle]) - [0, 2e-3 * self.radius, 0]
        i = np.arange(len(rim))
        triangles = np.stack([np.roll(i, -1), i, np.full_like(i, len(rim))], axis=1)
        return Mesh(points, np.tile([0.0, 1.0, 0.0], (len(points), 1)), triangles)

    def ticks(self, stage: Stage, degrees_turned: float) -> None:
        """Draw twelve ticks at the rim, the first of them thick: it tells how far it has turned."""
        ink = stage.canvas.palette.ink
        for i in range(TICKS):
            turn = np.radians(degrees_turned + 360 * i / TICKS)
            out = np.array([np.cos(turn), 0, np.sin(turn)]) * self.radius
            inner, width = (0.72, 8.0) if i == 0 else (0.88, 3.0)
            line = np.stack([inner * out, 0.985 * out]) + np.array([0, self.ground, 0])
            stage.surface_line(line, width, ink)


def around(radius: float, height: float) -> Array:
    """Return points (n, 3) of a circle about the world's y axis."""
    return _at_height(height, radius * np.cos(AROUND), radius * np.sin(AROUND))


def stuck_light(settings: ProofSettings) -> Proof:
    """Turn a body on a table under a light that turns with it, and under one that stays."""
    already, is_moving = _degrees(settings.object_turn), settings.is_moving
    settings = replace(settings, object_turn=IDENTITY)
    turns = [(one + already) % 360 for one in TURNS]
    one = settings.object(settings.placed(World()), settings.geometry(_letter()))
    table = Turntable.under(loaded(settings.scene(one)).bodies[0].positions_world)
    light = settings.lit_by(table.lamp)[0]
    still = replace(settings.scene(one), lights=(light,))
    stuck, right = (
        [_turned(still, table, settings, turn, carried=carried) for turn in turns]
        for carried in (True, False)
    )
    before, *shades = (_shade(scene) for scene in (still, *stuck, *right))
    changed = [float(np.abs(shade - before).max()) for shade in shades]
    sticking, staying = max(changed[: len(turns)]), max(changed[len(turns) :])
    slide = settings.slide(
        "A light left in model space turns with the model"
        if staying > INVISIBLE
        else "Here a stuck light looks right: this test proves nothing"
    )
    headings = [f"{turn:.4g}°" for turn in turns]
    headings[0] += "" if already else ": before it turns"
    panels = slide.table(slide.body(BELOW), ROWS, headings, undecided=1)
    view, lens = _camera(settings, table, light, panels[0][0].stage)
    drawn: list[DrawnScene] = []
    for above, below, turn, wrong, correct in zip(*panels, turns, stuck, right, strict=True):
        pair = [
            draw_on(slide, panel, replace(scene, view=view, lens=lens))
            for panel, scene in ((above, wrong), (below, correct))
        ]
        for stage in pair:
            stage.outline()
            table.ticks(stage, turn)
        _mark_ride(pair[0], light, turn, whole=is_moving)
        for stage in pair:
            _mark_light(stage, light, table.ground)
        if turn:
            _mark_lost(pair[0], light, turn)
        first, second = (stage.drawn for stage in pair)
        if level_difference(first, second) == 0:
            slide.compare(above, below, same=True)
        drawn += (first, second)
    slide.footer(
        "The hollow light is where the wrong program has it: it rides on the turntable.",
        x=panels[0][0].stage.x,
    )
    return Proof.of(
        settings.subject,
        slide,
        f"In model space each vertex keeps its shade (it changes by {sticking:.0e}); in eye space "
        f"it changes by up to {staying * 255:.0f} levels.",
        drawn,
        numbers={"vertex_change_model_space": sticking, "vertex_change_eye_space": staying},
        max_level_difference=max(map(level_difference, drawn[::2], drawn[1::2])),
    )


def _letter() -> LoadedGeometry:
    return LoadedGeometry(letter_r())


def _degrees(rotation: RationalMatrix) -> float:
    """Return by how much a rotation about the axis turns, from 0 to 360."""
    return degrees(atan2(-rotation[0][2], rotation[0][0])) % 360


def _rotation(turn: float) -> RationalMatrix:
    return affine_matrix(rotation_about_axis(AXIS, Angle.degrees(turn)))


def _turned(
    still: Scene, table: Turntable, settings: ProofSettings, turn: float, *, carried: bool
) -> Scene:
    """Return the scene with its body on the table, turned, and its light carried along or not."""
    (one,), (light,) = still.objects, still.lights
    rotation = _rotation(turn)
    moved = replace(one, world_from_object=product(rotation, one.world_from_object))
    top = Material(
        ambient=channels(PALETTES[settings.theme].paper), diffuse=grey(0), sides=Sides.BOTH
    )
    disc = SceneObject("table", LoadedGeometry(table.mesh), IDENTITY, top)
    lights = (turned_light(light, rotation) if carried else light,)
    return replace(still, objects=(moved, disc), lights=lights)


def _camera(
    settings: ProofSettings, table: Turntable, light: SceneLight, box: Box
) -> tuple[View, Lens]:
    """Return the camera that was asked for, or the one that holds all turns of all things."""
    if settings.view is not None:
        return settings.view, through(settings.lens, box)
    rings = [around(table.radius, table.ground), around(table.reach, table.top)]
    if light.has_position:
        x, y, z = map(float, light.position)
        rings.append(around(hypot(x, z), y))
    return IN_FRONT.about(np.concatenate(rings), box)


def _shade(scene: Scene) -> Array:
    """Return the light at every vertex of the body, whether it is seen or not."""
    plan = everything(loaded(replace(scene, objects=scene.objects[:1])))
    surface = surface_of(plan, plan.bodies[0], {}, 1)
    matte, _ = surface.lighting.light(surface.vertex_normals, surface.space.positions())
    return matte


def _mark_light(stage: Stage, light: SceneLight, ground: float) -> None:
    """Draw the light where it is in the world."""
    if light.has_position:
        stage.above_ground(light.position, ground)
        stage.lamp(light.position)
    else:
        stage.sun(light.direction)


def _mark_ride(stage: Stage, light: SceneLight, turn: float, *, whole: bool) -> None:
    """Draw the way on which the wrong program carries a lamp; moving pictures show all of it."""
    if not light.has_position:
        return
    x, y, z = map(float, light.position)
    end = 2 * np.pi if whole else np.radians(turn)
    way = atan2(z, x) + np.linspace(0, end, 97)
    out = hypot(x, z)
    stage.path(_at_height(y, out * np.cos(way), out * np.sin(way)), Ink.WRONG)


def _mark_lost(stage: Stage, light: SceneLight, turn: float) -> None:
    """Draw where the wrong program has the light."""
    gone = turned_light(light, _rotation(turn))
    if light.has_position:
        stage.lamp(gone.position, lost=True)
    else:
        stage.sun(gone.direction, lost=True)


def _at_height(y: float, x: Array, z: Array) -> Array:
    return np.stack([x, np.full_like(x, y), z], axis=1)
