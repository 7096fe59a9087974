"""Shadows: a lamp is kept off by what is opaque, and by nothing else."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from small_scenes import LAMBERT, LENS

from nmatrix.linear.rational import inverse
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.render import render
from nmatrix.raster.shading.space import as_array
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

FLOOR, BALL = World(scale=(1.5, 1, 1.5)), World(translate=(0, 1, 0), scale=(0.2, 0.2, 0.2))
CASTING = [kind for kind in LightKind if kind is not LightKind.AMBIENT]


def darkened(kind: LightKind, opacity: float) -> np.ndarray:
    """Mask the pixels of a floor under a small ball that shadows make darker."""
    lamp = SceneLight("lamp", kind, position=(0, 3, 0), direction=(0, -1, 0), cone_degrees=(60, 70))
    floor = replace(LAMBERT, opacity=opacity)
    objects = (
        SceneObject("floor", ShapeGeometry(Shape.PLANE), FLOOR.world_from_object, floor),
        SceneObject("ball", ShapeGeometry(Shape.SPHERE), BALL.world_from_object, LAMBERT),
    )
    view, settings = View(eye=(0, 3, 4), target=(0, 0, 0)), Settings(size=(96, 96), samples=1)
    with_shadows, without = (
        render(
            planned(loaded(Scene(objects, (replace(lamp, shadows=on),), view, LENS, settings)))
        ).image
        for on in (True, False)
    )
    return (without - with_shadows)[:, :, 0] > 0.01


@pytest.mark.parametrize("kind", CASTING)
@pytest.mark.parametrize("opacity", [1.0, 0.5])
def test_a_small_ball_darkens_a_small_part_of_the_floor(kind: LightKind, opacity: float) -> None:
    assert 0.002 < darkened(kind, opacity).mean() < 0.05


@pytest.mark.parametrize("kind", CASTING)
def test_glass_is_dark_where_an_opaque_floor_would_be(kind: LightKind) -> None:
    assert (darkened(kind, 1.0) != darkened(kind, 0.5)).mean() < 0.002


LAMP = SceneLight(
    "lamp",
    LightKind.DIRECTIONAL,
    direction=(-1, -1, -0.6),
    position=(3, 3.3, 1.8),
    cone_degrees=(40, 50),
    shadows=True,
)
STANDING = (
    SceneObject(
        "ball",
        ShapeGeometry(Shape.SPHERE, (8, 12)),
        World(translate=(-0.9, 0.5, 0), scale=(0.5, 0.5, 0.5)).world_from_object,
        LAMBERT,
    ),
    SceneObject(
        "block",
        ShapeGeometry(Shape.BOX),
        World(
            translate=(0.9, 0.4, 0), rotate_degrees=(0, 25, 0), scale=(0.4, 0.4, 0.4)
        ).world_from_object,
        LAMBERT,
    ),
    SceneObject(
        "wall",
        ShapeGeometry(Shape.BOX),
        World(translate=(0, 0.5, -1.2), scale=(1.5, 0.5, 0.02)).world_from_object,
        LAMBERT,
    ),
)


def standing(
    kind: LightKind, scale: float, *more: SceneObject, ground: Shape = Shape.PLANE
) -> Scene:
    """Stand a ball, a block and a thin wall on a floor of some size, under one lamp."""
    low = World(translate=(0, -0.1, 0), scale=(scale, 0.1, scale))
    place = low if ground is Shape.BOX else World(scale=(scale, 1, scale))
    floor = SceneObject("floor", ShapeGeometry(ground), place.world_from_object, LAMBERT)
    view = View(eye=(2, 2.2, 4), target=(0, 0.3, 0))
    settings = Settings(size=(150, 100), samples=1)
    lens = Lens(fov_degrees=35, aspect=1.5)
    return Scene((floor, *STANDING, *more), (replace(LAMP, kind=kind),), view, lens, settings)


def share_of_light(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Draw how much of its lamp's light arrives at each pixel, and mask where any could."""
    dark_lamp = replace(scene.lights[0], shadows=False)
    shaded, unshaded = (
        render(planned(loaded(one))).image[:, :, 0]
        for one in (scene, replace(scene, lights=(dark_lamp,)))
    )
    black = replace(dark_lamp, intensity=0.0)
    ambient = render(planned(loaded(replace(scene, lights=(black,))))).image[:, :, 0]
    could = unshaded - ambient > 0.01
    return np.where(could, (shaded - ambient) / np.where(could, unshaded - ambient, 1), 1), could


def first_hit(triangles: np.ndarray, start: np.ndarray, way: np.ndarray) -> np.ndarray:
    """Cast rays (n, 3) at triangles; infinite where none is hit."""
    found = np.full(len(way), np.inf)
    for a, b, c in triangles:
        e, f = b - a, c - a
        p = np.cross(way, f)
        with np.errstate(divide="ignore", invalid="ignore"):
            inverse = 1.0 / (p @ e)
            s = start - a
            u, q = (s * p).sum(axis=1) * inverse, np.cross(s, e)
            v, t = (way * q).sum(axis=1) * inverse, (q @ f) * inverse
            hit = (u >= 0) & (v >= 0) & (u + v <= 1) & (t > 1e-9)
        found = np.where(hit & (t < found), t, found)
    return found


def seen_floor(scene: Scene) -> tuple[np.ndarray, np.ndarray]:
    """Cast rays through the pixels: which see the floor, and which of these a lamp is kept off."""
    found = loaded(scene)
    width, height = scene.settings.size
    row, column = np.mgrid[:height, :width]
    ndc = [(column + 0.5) / width * 2 - 1, 1 - (row + 0.5) / height * 2, 0 * row, 0 * row + 1]
    world = as_array(inverse(found.clip_from_world)) @ np.array(ndc).reshape(4, -1)
    eye = np.array([float(one) for one in found.eye])[None]
    way = (world[:3] / world[3]).T - eye
    floor, *others = (one.positions_world[one.mesh.triangles] for one in found.bodies)
    things = np.concatenate(others)
    distance = first_hit(floor, eye, way)
    on_floor = (distance < np.inf) & (distance < first_hit(things, eye, way))
    at = eye + distance[on_floor, None] * way[on_floor]
    lamp = scene.lights[0]
    if lamp.has_position:
        dark = first_hit(things, at, np.array(lamp.position, float) - at) < 1
    else:
        dark = first_hit(things, at, -np.array([lamp.direction] * len(at), float)) < np.inf
    kept_off = np.zeros(on_floor.shape, bool)
    kept_off[on_floor] = dark
    return on_floor.reshape(height, width), kept_off.reshape(height, width)


@pytest.mark.parametrize("kind", CASTING)
@pytest.mark.parametrize("scale", [3, 10, 60, 300])
@pytest.mark.parametrize("ground", [Shape.PLANE, Shape.BOX])
def test_shadows_are_where_rays_find_them_however_large_the_floor(
    kind: LightKind, scale: float, ground: Shape
) -> None:
    scene = standing(kind, scale, ground=ground)
    share, could = share_of_light(scene)
    on_floor, dark = seen_floor(scene)
    in_shadow, in_light = dark & could, on_floor & ~dark & could
    assert in_shadow.sum() > 300
    assert (share[in_shadow] > 0.5).mean() <= 0.01
    assert (share[in_light] < 0.5).mean() <= 0.001


@pytest.mark.parametrize("kind", CASTING)
def test_a_body_far_aside_changes_no_shadow(kind: LightKind) -> None:
    far = replace(
        STANDING[0],
        name="far",
        world_from_object=World(translate=(500, 1, -900), scale=(9, 9, 9)).world_from_object,
    )
    alone, beside = (render(planned(loaded(standing(kind, 3, *more)))) for more in ((), (far,)))
    assert (alone.image == beside.image).all()
    assert alone.work.passes == beside.work.passes


@pytest.mark.parametrize("shape", [one for one in Shape if one is not Shape.PLANE])
@pytest.mark.parametrize("cells", [8, 12, 48])
@pytest.mark.parametrize("direction", [(-1, -1, -0.6), (0, -1, 0), (0.3, -0.2, -1)])
@pytest.mark.parametrize("kind", [LightKind.DIRECTIONAL, LightKind.POINT])
def test_no_body_shades_its_own_lit_side(
    shape: Shape, cells: int, direction: tuple[float, float, float], kind: LightKind
) -> None:
    tessellation = (cells, cells) if shape in (Shape.SPHERE, Shape.TORUS) else (cells,)
    position = tuple(-3 * one for one in direction)
    lamp = replace(LAMP, kind=kind, direction=direction, position=position)
    place = World(rotate_degrees=(30, 20, 10)).world_from_object
    thing = SceneObject("thing", ShapeGeometry(shape, tessellation), place, LAMBERT)
    view, settings = View(eye=(0, 1, 4)), Settings(size=(96, 96), samples=1)
    with_shadows, without = (
        render(planned(loaded(Scene((thing,), (one,), view, LENS, settings)))).image
        for one in (lamp, replace(lamp, shadows=False))
    )
    assert np.abs(with_shadows - without).max() < 2 / 255


def test_shadows_touch_what_casts_them() -> None:
    """Just beside a wall's foot, on the side that is away from the lamp, no light leaks in."""
    scene = standing(LightKind.DIRECTIONAL, 60)
    scene = replace(scene, view=View(eye=(0.3, 1.5, -5), target=(0, 0.2, -1.2)))
    share, could = share_of_light(scene)
    _, dark = seen_floor(scene)
    rows = np.arange(len(dark))[:, None]
    top = np.where(dark.any(axis=0), np.argmax(dark, axis=0), -9)
    at_the_foot = dark & could & (rows <= top + 3)
    assert at_the_foot.sum() > 100
    assert (share[at_the_foot] > 0.5).mean() < 0.02


def test_edges_are_smooth() -> None:
    scene = standing(LightKind.DIRECTIONAL, 3)
    share, could = share_of_light(replace(scene, settings=replace(scene.settings, shadow_map=64)))
    assert ((share > 0.1) & (share < 0.9) & could).sum() > 50


@pytest.mark.parametrize("kind", CASTING)
def test_no_map_is_drawn_for_bodies_that_are_not_seen(kind: LightKind) -> None:
    scene = standing(kind, 3)
    away = replace(scene, view=View(eye=(2, 2.2, 4), target=(4, 4.4, 8)))
    assert render(planned(loaded(away))).work.passes == 1
    assert render(planned(loaded(scene))).work.passes > 1


def test_a_point_lamp_has_maps_only_where_shadows_fall() -> None:
    assert render(planned(loaded(standing(LightKind.POINT, 3)))).work.passes < 7


@pytest.mark.parametrize("kind", CASTING)
def test_texels_wider_than_two_pixels_are_told(kind: LightKind) -> None:
    fine = standing(kind, 60)
    coarse = replace(fine, settings=replace(fine.settings, shadow_map=32))
    assert not planned(loaded(fine)).remarks
    (remark,) = planned(loaded(coarse)).remarks
    assert remark.startswith("Shadows of lamp: a texel is")


def test_glass_that_casts_no_shadow_is_told() -> None:
    glass = replace(
        STANDING[0],
        name="glass",
        world_from_object=World(translate=(0, 1.5, 0)).world_from_object,
        material=replace(LAMBERT, opacity=0.5),
    )
    found = planned(loaded(standing(LightKind.DIRECTIONAL, 3, glass)))
    assert "The shadow of glass is not cast: its opacity is below 1." in found.remarks


@pytest.mark.parametrize("ground", [Shape.PLANE, Shape.BOX])
@pytest.mark.parametrize("kind", CASTING)
def test_a_floor_casts_nothing_on_what_stands_on_it(kind: LightKind, ground: Shape) -> None:
    (views,) = planned(loaded(standing(kind, 60, ground=ground))).light_views.values()
    assert {one.name for view in views for one in view.casters} == {"ball", "block", "wall"}
