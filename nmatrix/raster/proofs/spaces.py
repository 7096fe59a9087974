"""The proof that one scene shaded in five spaces is one picture.

Above, where things are in each space: all of the world is carried there by the space's own matrix,
floor and lamp and eye with it, and looked at from the side. Below, what the eye sees, computed in
that space.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import Verdict, disc
from nmatrix.canvas.marks import Box
from nmatrix.canvas.slide import Panel, Slide
from nmatrix.enums import NormalRule, Reflection, Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, identity
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.stage import Stage, filling, radius_of
from nmatrix.raster.overlay.tacks import farthest_apart
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import Pose, ball, draw_on
from nmatrix.raster.shading.normals import normals_by
from nmatrix.raster.shading.space import as_array
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

Array = NDArray[Any]

SKEWED = World(scale=(0.9, 1.3, 0.9), rotate_degrees=(0, 18, -12), shear=(0.3, 0, 0))
STANDING = replace(SKEWED, translate=(1.0, 1.3, -0.2))
LAMP = (-0.3, 1.45, 1.2)  # from the middle of the body, in its radius
FROM_THE_SIDE = Pose((1.6, 0.4, 2.9), radius=1.7, room=0.05)
GUTTER = 16.0
LOWER, BETWEEN, BELOW = 214.0, 88.0, 84.0  # units: a picture, the captions above it, the footer
ALIKE = 1e-9  # of full brightness: rounding
CELLS = 6  # of the floor, along an edge
MOST_DOTS, DOTS_APART = 90, 9.0  # vertices that are drawn, and units between them
COUNT = {5: "Five", 4: "Four", 3: "Three"}


@dataclass(frozen=True)
class Standpoint:
    """A space, the direction in it from which its stage is seen, and what is so in it.

    `without` stands in its place where a body or a light has no such space: in short, and why.
    """

    space: Space
    seen_from: Vector
    caption: str
    without: tuple[str, str] = ("", "")


STANDPOINTS = (
    Standpoint(
        Space.OBJECT,
        (-0.8, 0.8, 2.2),
        "the shape is plain; M^{−1} moves lamp and eye",
        ("no M^{−1}", "M flattens: nothing leads back to the object"),
    ),
    Standpoint(Space.WORLD, (0, 0.8, 2.4), "everything stands where you put it"),
    Standpoint(Space.CAMERA, (0.5, 1.3, 2.1), "the eye is the origin and looks down −z"),
    Standpoint(
        Space.LIGHT,
        (0.3, 0.45, 2.4),
        "the lamp is the origin and looks down −z",
        ("no direction", "the lamp stands where it should look to"),
    ),
    Standpoint(
        Space.STATIC,
        (0, 0.8, 2.4),
        "M is baked into every vertex; then M = I",
        ("two sides", "a flat body has two, but a vertex one normal"),
    ),
)


def spaces(settings: ProofSettings) -> Proof:
    """Draw one scene in five shading spaces, and where things are in each of them."""
    own = SKEWED if settings.is_moving else STANDING  # what turns does so about its middle
    one = settings.object(settings.placed(own), settings.geometry(LoadedGeometry(letter_r())))
    before = settings.still.object(settings.placed(own), one.geometry)
    plain = settings.scene(one, lights=(_lamp(loaded(settings.scene(before)).bodies[0]),))
    shiny = replace(one.material, reflection=settings.reflection or Reflection.BLINN_PHONG)
    scene = replace(plain, objects=(replace(one, material=shiny),))
    able = [each for each in STANDPOINTS if _has(loaded(scene), each.space)]
    slide = settings.slide(f"{COUNT[len(able)]} places to stand, one picture")
    body = slide.body(BELOW)
    upper = Box(body.x, body.y, body.width, body.height - LOWER - BETWEEN).columns(5, GUTTER)
    lower = Box(body.x, body.bottom - LOWER, body.width, LOWER).columns(5, GUTTER)
    above = [
        slide.panel(
            box,
            each.space.value,
            caption=_caption(each, scene.lights[0]) if each in able else each.without[1],
        )
        for box, each in zip(upper, STANDPOINTS, strict=True)
    ]
    below = [slide.panel(box) for box in lower]
    view, lens = FROM_THE_SIDE.camera(settings, [loaded(scene)], below[0].stage)
    scene, plain = (replace(each, view=view, lens=lens, has_camera=True) for each in (scene, plain))
    ready = loaded(plain)
    drawn: dict[Space, Stage] = {}
    for standpoint, high, low in zip(STANDPOINTS, above, below, strict=True):
        space = standpoint.space
        if standpoint not in able:
            for panel in (high, low):
                slide.no_answer(panel, standpoint.without[0])
            continue
        _Surroundings(settings, ready, standpoint).draw(slide, high, plain)
        drawn[space] = draw_on(slide, low, _shaded_in(scene, loaded(scene), space))
        if not drawn[space].is_empty:
            drawn[space].outline_like(next(iter(drawn.values())))
    for a, b in pairwise(zip(STANDPOINTS, below, strict=True)):
        if a[0] in able and b[0] in able:
            pair = (drawn[each[0].space].drawn for each in (a, b))
            slide.compare(a[1], b[1], same=level_difference(*pair) == 0)
    reference = drawn[Space.WORLD].drawn
    images = np.stack([each.drawn.rendered.rgb for each in drawn.values()])
    worst = float((images.max(axis=0) - images.min(axis=0)).max())
    slide.footer(
        f"The largest difference between any two: {_power_of_ten(worst)} of full brightness. "
        "A space is a choice of where to compute.",
        Verdict.RIGHT if worst < ALIKE else None,
    )
    differences = {
        space.value: float(np.abs(each.drawn.rendered.image - reference.rendered.image).max())
        for space, each in drawn.items()
    }
    found = Proof.of(
        settings.subject,
        slide,
        f"{COUNT[len(able)]} shading spaces give the same picture: the largest difference is "
        f"{worst:.1e}.",
        [each.drawn for each in drawn.values()],
        numbers={"differences": differences},
        max_level_difference=max(
            level_difference(each.drawn, reference) for each in drawn.values()
        ),
    )
    return replace(found, effects=drawn[able[0].space].drawn.effects)


def _lamp(body: Body) -> SceneLight:
    """Return the proof's own lamp, above a body before its face."""
    place = body.centre + radius_of(body) * np.array(LAMP)
    return SceneLight("lamp", LightKind.POINT, position=tuple(place.tolist()))


def _has(scene: LoadedScene, space: Space) -> bool:
    """Tell whether a scene's body and light have a space in which the picture can be computed."""
    if space is Space.STATIC:
        return scene.bodies[0].linear_map.rank == 3
    try:
        scene.maps(scene.bodies[0]).space_from_world(space)
    except NoAnswerError:
        return False
    return True


def _caption(standpoint: Standpoint, light: SceneLight) -> str:
    if light.has_position:
        return standpoint.caption
    if standpoint.space is Space.LIGHT:
        return "the light of the sun goes down −z"
    return standpoint.caption.replace("lamp and eye", "light and eye")


def _shaded_in(scene: Scene, ready: LoadedScene, space: Space) -> Scene:
    """Return the scene as it is computed in a space; in static space M is baked in first."""
    baked = _baked(scene, ready) if space is Space.STATIC else scene
    return replace(baked, settings=replace(scene.settings, space=space))


def _baked(scene: Scene, ready: LoadedScene) -> Scene:
    """Return the scene with its object's vertices moved to the world once and for all: M = I."""
    (one,), (body,) = scene.objects, ready.bodies
    mesh = replace(
        body.mesh,
        positions=body.positions_world,
        normals=np.ascontiguousarray(normals_by(ready, body, NormalRule.EXACT).T),
    )
    if body.linear_map.determinant_sign < 0:
        mesh = replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))
    baked = replace(one, geometry=LoadedGeometry(mesh), world_from_object=identity(4))
    return replace(scene, objects=(baked,))


def _power_of_ten(number: float) -> str:
    """Write a small number for a slide, to one digit.

    Examples
    --------
    >>> _power_of_ten(2.4e-15), _power_of_ten(0.0)
    ('2 · 10^{−15}', '0')
    """
    if not number:
        return "0"
    digit, power = f"{number:.0e}".split("e")
    return f"{digit} · 10^{{{int(power)}}}".replace("-", "−")


@dataclass(frozen=True, eq=False)
class _Surroundings:
    """A body with its floor, its lamp and the eye, as they are in one space."""

    settings: ProofSettings
    ready: LoadedScene
    standpoint: Standpoint

    @property
    def body(self) -> Body:
        """The body."""
        return self.ready.bodies[0]

    @cached_property
    def exact(self) -> RationalMatrix:
        """The matrix that carries the world to the space."""
        return self.ready.maps(self.body).space_from_world(self.standpoint.space).exact

    @cached_property
    def eye(self) -> Array:
        """Where the eye is in the world."""
        return np.array([float(side) for side in self.ready.eye])

    @cached_property
    def lamp(self) -> Array | None:
        """Where the lamp is in the world, if the light has a place."""
        place = self.ready.lights[0].position
        return None if place is None else np.array([float(side) for side in place])

    @cached_property
    def floor(self) -> Array:
        """The corners (4, 3) of the world's floor, under the body and the world's origin."""
        points = np.concatenate([self.body.positions_world, np.zeros((1, 3))])
        low, high = points.min(axis=0), points.max(axis=0)
        ground = float(self.body.box[0][1])
        if self.settings.is_moving:  # nothing may jump
            away = float(np.sqrt((points * points).sum(axis=1).max()))
            low, high, ground = np.full(3, -away), np.full(3, away), -away
        middle, half = (low + high) / 2, 0.62 * float(max((high - low)[[0, 2]])) or 1.0
        middle[1] = ground
        corners = np.array([[-1, 0, -1], [1, 0, -1], [1, 0, 1], [-1, 0, 1]])
        return np.asarray(middle + half * corners)

    @cached_property
    def axes(self) -> Array:
        """The space's origin and its axes (3, 4) as columns in the world, as long as is drawn."""
        back = as_array(rational.inverse(self.exact))
        points = _through(as_array(self.exact), self.held)
        size = 0.3 * float(np.ptp(points, axis=0).max())
        return np.concatenate([back[:3, 3:], size * back[:3, :3]], axis=1)

    @cached_property
    def held(self) -> Array:
        """Points (n, 3) of the world that the stage must hold, but for the axes."""
        around = [self.eye[None], self.floor, *([] if self.lamp is None else [self.lamp[None]])]
        points = self.body.positions_world
        if not self.settings.is_moving:
            return np.concatenate([points, *around])
        # Nothing may jump: in object space all turns about the body, elsewhere the body itself.
        if self.standpoint.space is Space.OBJECT:
            return _ball_around(np.concatenate([points, *around]))
        return np.concatenate([_ball_around(points), *around])

    def draw(self, slide: Slide, panel: Panel, scene: Scene) -> Stage:
        """Draw it all, carried to the space by its matrix and seen there from one side.

        The matrix goes into the camera: so shade and places are those of the world, carried.
        """
        origin, *along = self.axes.T
        held = np.concatenate([self.held, [origin], [origin + one for one in along]])
        points = _through(as_array(self.exact), held)
        low, high = points.min(axis=0), points.max(axis=0)
        centre = (low + high) / 2
        reach = float(np.sqrt(((points - centre) ** 2).sum(axis=1).max())) or 1.0
        side = np.array(self.standpoint.seen_from, float)
        away = centre + 4 * reach * side / np.sqrt(side @ side)
        seen = View(eye=tuple(away.tolist()), target=tuple(centre.tolist()))
        view = View(matrix=rational.product(seen.placed().camera_from_world, self.exact))
        lens = filling(view, held, panel.stage)
        stage = draw_on(slide, panel, replace(scene, view=view, lens=lens))
        if not stage.is_empty:
            self._mark(stage)
        return stage

    def _mark(self, stage: Stage) -> None:
        grid = stage.canvas.palette.grid
        a, b, c, d = self.floor
        for part in np.linspace(0, 1, CELLS + 1):
            for ends in (
                (a + part * (b - a), d + part * (c - d)),
                (a + part * (d - a), b + part * (c - b)),
            ):
                stage.surface_line(np.array(ends), 2.4, grid)
        stage.outline()
        if self.standpoint.space is Space.STATIC:
            self._dots(stage)
        stage.axes(self.axes)
        look = -as_array(self.ready.camera_from_world.exact)[2, :3]
        far = float(look @ (self.body.centre - self.eye))
        stage.sight(self.eye, self.eye + look * (far if far > 0 else radius_of(self.body)))
        stage.lights()

    def _dots(self, stage: Stage) -> None:
        """Draw the vertices that are seen, or so many of them that they are told apart."""
        points = self.body.positions_world
        window = stage.window(points[stage.sees(points)])[:, :2]
        for i in farthest_apart(window, MOST_DOTS, DOTS_APART):
            x, y = window[i].tolist()
            disc(stage.canvas, (x, y), 3.6, stage.canvas.palette.dim, stage.canvas.palette.bright)


def _ball_around(points: Array) -> Array:
    return ball(float(np.sqrt((points * points).sum(axis=1).max())) or 1.0)


def _through(matrix: Array, points: Array) -> Array:
    return np.asarray(points @ matrix[:3, :3].T + matrix[:3, 3])
