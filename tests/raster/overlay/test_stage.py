"""Marks of the world over a picture: they are where the rasterizer draws the points they mark."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Ink
from nmatrix.canvas.marks import Box, Canvas, Polygon, Stroke
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import DepthRange, NormalRule, Theme
from nmatrix.linear.projection import ClipSpace
from nmatrix.raster.drawn_scene import drawn_scene
from nmatrix.raster.overlay.stage import Stage, Tack, filling, radius_of
from nmatrix.raster.proofs.proof import ProofSettings
from nmatrix.raster.proofs.staging import tacks
from nmatrix.raster.shading.space import as_array
from nmatrix.raster.triangles.vertices import project
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.meshes.shapes import box, plane, sphere
from nmatrix.scene.scene import Scene, Settings
from nmatrix.scene.words import Shape
from nmatrix.scene.world import World

VIEW = View(eye=(2.5, 1.8, 4.0))
LENSES = [Lens(near=1, far=20, aspect=1.5, clip=ClipSpace(depth=one)) for one in DepthRange] + [
    Lens(near=1, far=20, aspect=1.5, frustum=(-0.2, 0.4, -0.1, 0.3))
]
SQUASHED = World(scale=(1, 1.4, 0.7), rotate_degrees=(10, 30, 0))


def stage(
    world: World = SQUASHED, geometry=None, lens: Lens = LENSES[0], scale: float = 1.0
) -> Stage:
    canvas = Canvas(300, 200, PALETTES[Theme.LIGHT], scale)
    place = canvas.onpixels(Box(30, 20, 240, 160))
    thing = ProofSettings("thing").object(world, geometry or ShapeGeometry(Shape.SPHERE))
    picture = Settings(size=canvas.pixels_of(place), samples=4, background=(1.0, 0.0, 1.0))
    scene = Scene((thing,), (), VIEW, lens, picture)
    return Stage(canvas, place, drawn_scene(scene, keeps_depth=True))


@pytest.mark.parametrize("lens", LENSES)
def test_points_of_the_world_are_where_the_rasterizer_puts_them(lens: Lens) -> None:
    found = stage(lens=lens)
    loaded = found.loaded
    (body,) = loaded.bodies
    mesh = body.mesh
    projected = project(mesh, as_array(loaded.clip_from_object(body)), loaded.canvas, loaded.clip)
    here = found.pixels(found.window(body.positions_world))
    per_side = loaded.canvas.per_side
    assert np.abs((projected.x / 256 + 0.5) / per_side - here[:, 0]).max() < 1 / 256
    assert np.abs((projected.y / 256 + 0.5) / per_side - here[:, 1]).max() < 1 / 256
    depth = 1 - projected.depth if projected.is_reversed else projected.depth
    assert np.abs(depth - here[:, 2]).max() < 1e-12


def test_a_point_behind_the_eye_has_no_place() -> None:
    assert stage().place((5.0, 3.6, 8.0)) is None


@pytest.mark.parametrize("lens", LENSES)
def test_the_depth_that_is_kept_is_that_of_the_surface(lens: Lens) -> None:
    found = stage(geometry=LoadedGeometry(plane()), world=World(), lens=lens)
    points = np.array([[x, 0.0, z] for x in (-0.3, 0.1, 0.3) for z in (-0.3, 0.2)])
    assert found.sees(points).all()
    above = np.array([0, 0.15, 0])
    assert found.sees(points + above).all()
    assert not found.sees(points - above).any()
    assert found.covers(points).all()
    assert found.depth.coverage.max() == 1


def test_the_outline_runs_where_coverage_is_one_half() -> None:
    found = stage()
    found.outline(sharp=False)
    strokes = [one for one in found.canvas.marks if isinstance(one, Stroke)]
    assert strokes
    rows, columns = np.nonzero(found.depth.coverage > 0.5)
    x, y = np.concatenate([one.points for one in strokes]).T
    assert x.min() == pytest.approx(found.box.x + columns.min(), abs=1)
    assert x.max() == pytest.approx(found.box.x + columns.max() + 1, abs=1)
    assert y.min() == pytest.approx(found.box.y + rows.min(), abs=1)
    assert y.max() == pytest.approx(found.box.y + rows.max() + 1, abs=1)


def test_a_cube_shows_nine_of_its_twelve_edges() -> None:
    found = stage(World(), LoadedGeometry(box()))
    found.outline()
    corners = found.window(np.array([[x, y, z] for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)])
                           * np.abs(box().positions).max())[:, :2]  # fmt: skip
    hidden = corners[0]  # the one that is farthest from the eye
    for mark in found.canvas.marks:
        if isinstance(mark, Stroke):
            points = np.array(mark.points)
            assert np.sqrt(((points - hidden) ** 2).sum(axis=1)).min() > 5


def test_a_tack_stands_on_its_place_and_points_along_its_arrow() -> None:
    found = stage()
    (body,) = found.loaded.bodies
    for one in tacks(found, body, NormalRule.NONE):
        found.canvas.marks.clear()
        found.tacks([one], Ink.RIGHT, radius_of(body))
        tip = found.place(one.place + 0.27 * radius_of(body) * one.arrow)
        points = [p for mark in found.canvas.marks for p in getattr(mark, "points", ())]
        points += [p for mark in found.canvas.marks if isinstance(mark, Polygon)
                   for loop in mark.loops for p in loop]  # fmt: skip
        assert found.place(one.place) in points
        assert tip in points


def test_tacks_stand_on_the_surface_upright_by_the_right_rule_alone() -> None:
    found = stage()
    (body,) = found.loaded.bodies
    right, wrong = (tacks(found, body, one) for one in (NormalRule.EXACT, NormalRule.NONE))
    assert 9 <= len(right) <= 13
    lean = []
    for one, other in zip(right, wrong, strict=True):
        assert (one.place == other.place).all()
        assert one.arrow @ one.normal == pytest.approx(1, abs=1e-12)
        lean.append(float(other.arrow @ other.normal))
    assert min(lean) < 0.9


@pytest.mark.parametrize("scale", [(1, 1.4, 0.7), (1, 0.1, 1), (0.1, 1, 0.1)])
def test_tacks_stand_apart(scale: tuple) -> None:
    found = stage(World(scale=scale))
    (body,) = found.loaded.bodies
    places = np.array([one.place for one in tacks(found, body, NormalRule.EXACT)])
    window = found.window(places)[:, :2]
    unit_length = np.abs(np.diff(found.window(
        body.centre + np.outer([0, 1], radius_of(body) * found.across))[:, 0]))[0]  # fmt: skip
    apart = np.sqrt(((window[:, None] - window) ** 2).sum(axis=2)) + 1e9 * np.eye(len(window))
    assert apart.min() > 0.33 * unit_length


def test_most_tacks_stand_on_the_silhouette() -> None:
    found = stage()
    (body,) = found.loaded.bodies
    towards = [
        abs(float(one.normal @ (found.eye - one.place)) / np.linalg.norm(found.eye - one.place))
        for one in tacks(found, body, NormalRule.EXACT)
    ]
    assert sum(one < 0.13 for one in towards) >= 6


@pytest.mark.parametrize(
    ("world", "geometry"),
    [
        (World(scale=(1, 0, 1), rotate_degrees=(40, 0, 0)), None),
        (World(scale=(1, 0, 0)), None),
        (World(scale=(0, 0, 0)), None),
        (World(translate=(0, 0, 40)), None),
        (World(), LoadedGeometry(replace(plane(), triangles=plane().triangles[:1]))),
    ],
)
def test_bodies_of_which_little_or_nothing_is_seen_have_few_tacks_or_none(
    world: World, geometry
) -> None:
    found = stage(world, geometry)
    (body,) = found.loaded.bodies
    placed = tacks(found, body, NormalRule.EXACT)
    for one in placed:
        assert np.isfinite([*one.place, *one.normal, *one.arrow]).all()
    found.tacks(placed, Ink.RIGHT, radius_of(body))
    found.outline()
    found.lights()


def test_a_tack_without_a_normal_is_a_disc_or_nothing() -> None:
    found = stage()
    nothing = np.zeros(3)
    found.tacks([Tack(nothing, np.array([0, 0, 1.0]), nothing)], Ink.WRONG, 1.0)
    assert [type(one) for one in found.canvas.marks] == [Polygon]


@pytest.mark.parametrize("size", [(240, 160), (160, 240), (200, 200)])
def test_a_filling_lens_leaves_the_pad_and_no_more(size: tuple[int, int]) -> None:
    points = sphere(12, 24).positions * [1, 2, 1] + [5, -3, 2]
    view = View(eye=(9, 0, 14), target=(5, -3, 2))
    area = Box(0, 0, *size)
    lens = filling(view, points, area)
    thing = ProofSettings("thing").object(World(), ShapeGeometry(Shape.SPHERE))
    scene = Scene((thing,), (), view, lens, Settings(size=size, samples=1))
    found = Stage(Canvas(*size, PALETTES[Theme.LIGHT]), area, drawn_scene(scene, keeps_depth=True))
    x, y, depth = found.window(points).T
    sides = np.array([x.min(), size[0] - x.max(), y.min(), size[1] - y.max()])
    assert sides.min() == pytest.approx(34, abs=1e-6)
    assert sides[0] == pytest.approx(sides[1])
    assert sides[2] == pytest.approx(sides[3])
    assert 0 < depth.min() < depth.max() < 1
