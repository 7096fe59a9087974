"""Surfaces: flat by the face's own normal, one outline for every shading, settings in vain."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
import pytest
from small_scenes import BALL, BULB, LAMBERT, SUN, TOON, single

from nmatrix.enums import Effect, NormalRule, Reflection, Shading, Space
from nmatrix.linear.projection import front_sign
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.render import render, surface_of
from nmatrix.raster.shading.outline import hull, hull_normals, thickness
from nmatrix.raster.shading.space import as_array
from nmatrix.raster.triangles.vertices import project
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import CHECKER, DEFAULT_MATERIAL, Material
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import torus
from nmatrix.scene.scene import Fog, Scene
from nmatrix.scene.words import Shape, Sides
from nmatrix.scene.world import World

TORUS = ShapeGeometry(Shape.TORUS, (6, 9))
BOX = ShapeGeometry(Shape.BOX)
BENT = World(scale=(1, 2, 0.5), shear=(0.4, -0.2, 0.3), rotate_degrees=(20, 30, 10))
MIRRORED = World(scale=(-1, 1.5, 0.7), rotate_degrees=(10, 50, 0))
WORLDS = {"as it is": World(), "bent": BENT, "mirrored": MIRRORED}
AFAR = View(eye=(2.4, 3, 9), target=(0, 0, 0))
NEAR = View(eye=(0.2, 0.1, 1.1), target=(0, 0, 0))  # the near plane cuts the torus


def drawn(scene: Scene) -> np.ndarray:
    return render(planned(loaded(scene))).image


@pytest.mark.parametrize("near", [False, True])
@pytest.mark.parametrize("name", WORLDS)
def test_flat_light_is_that_of_the_faces_own_normal_at_its_middle(name: str, near: bool) -> None:
    scene = single(WORLDS[name], lights=(SUN, BULB), shape=TORUS, shading=Shading.FLAT)
    scene = replace(scene, view=NEAR) if near else scene
    plan = everything(loaded(scene))
    (body,) = plan.bodies
    clip = plan.loaded.clip_from_object(body.body)
    front = front_sign(clip, plan.loaded.clip)
    projected = project(body.body.mesh, as_array(clip), plan.loaded.canvas, plan.loaded.clip)
    assert (projected.source is not None) is near
    found = surface_of(plan, body, {}, front).vertex(projected).faces["matte_front"]

    corners = body.body.positions_world[body.body.mesh.triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    if name == "mirrored":  # the world sees the winding turned, and outward stays outward
        normals = -normals
    middle = corners.mean(axis=1)
    to_sun = -np.array(SUN.direction) / np.linalg.norm(SUN.direction)
    way = np.array(BULB.position) - middle
    distance = np.linalg.norm(way, axis=1)
    c, l, q = BULB.attenuation  # noqa: E741  # as the formula has them
    fades = (distance <= BULB.range) / (c + l * distance + q * distance**2)
    cosine = (normals * way).sum(axis=1) / distance
    expected = LAMBERT.ambient[0] + LAMBERT.diffuse[0] * (
        SUN.intensity * np.maximum(0, normals @ to_sun)
        + BULB.intensity * np.maximum(0, cosine) * fades
    )
    of_faces = expected if projected.source is None else expected[projected.source]
    assert np.abs(found[0] - of_faces).max() < 1e-13


@pytest.mark.parametrize("name", WORLDS)
def test_flat_shading_is_alike_in_every_space(name: str) -> None:
    scene = single(WORLDS[name], Material(reflection=Reflection.PHONG), shape=TORUS)
    scenes = [
        replace(scene, settings=replace(scene.settings, shading=Shading.FLAT, space=space))
        for space in (Space.WORLD, Space.OBJECT, Space.CAMERA)
    ]
    world, *others = (drawn(one) for one in scenes)
    assert all(np.abs(world - other).max() < 1e-12 for other in others)


def test_flat_shading_does_not_read_the_normals_of_vertices() -> None:
    mesh = torus(6, 9)
    noise = np.random.default_rng(3).normal(size=mesh.normals.shape)
    other = replace(mesh, normals=noise / np.linalg.norm(noise, axis=1)[:, None])
    flat, smooth = (
        [drawn(single(BENT, shape=LoadedGeometry(one), shading=how)) for one in (mesh, other)]
        for how in (Shading.FLAT, Shading.PHONG)
    )
    assert (flat[0] == flat[1]).all()
    assert not (smooth[0] == smooth[1]).all()


def test_lamps_are_left_out_of_flat_shading_by_the_normals_of_faces() -> None:
    """The vertices' normals say that the lamp is behind; the face that is drawn looks to it."""
    (plain,) = loaded(single(shape=ShapeGeometry(Shape.PLANE))).bodies
    turned = LoadedGeometry(replace(plain.mesh, normals=-plain.mesh.normals))
    material = replace(LAMBERT, sides=Sides.FRONT)
    for light in (SUN, BULB):
        scene = single(material=material, lights=(light,), shape=turned, shading=Shading.FLAT)
        assert (drawn(scene) == render(everything(loaded(scene))).image).all()
        assert len(np.unique(drawn(scene).round(1))) > 1
        (body,) = planned(loaded(scene)).bodies
        assert body.lights


def test_a_wrong_rule_bends_the_normals_of_faces_too() -> None:
    right, wrong = (
        drawn(single(BENT, shape=TORUS, shading=Shading.FLAT, normals=rule))
        for rule in (NormalRule.EXACT, NormalRule.NONE)
    )
    assert np.abs(right - wrong).max() > 0.1


def test_a_face_without_area_takes_the_normals_of_its_vertices() -> None:
    positions = np.array([[0.0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1e-200, 0], [0, 3, 0]])
    up = np.broadcast_to([0.0, 0, 1], positions.shape)
    triangles = np.array([[0, 1, 2], [0, 0, 1], [0, 1, 3], [1, 0, 4]])
    expected = [[0, 0, 1], [0, 0, 1], [0, 0, 1], [0, 0, -1]]
    assert Mesh(positions, up, triangles).face_normals.tolist() == expected


@pytest.mark.parametrize("shape", [BOX, BALL])
@pytest.mark.parametrize("name", WORLDS)
def test_an_outline_lies_around_a_convex_body_and_never_on_it(
    name: str, shape: ShapeGeometry
) -> None:
    inked = replace(TOON, outline=0.5)
    for shading in Shading:
        plain, lined = (
            drawn(
                single(
                    WORLDS[name],
                    material,
                    shape=shape,
                    view=AFAR,
                    shading=shading,
                    background=(1.0, 1.0, 1.0),
                )
            )
            for material in (replace(inked, outline=0.0), inked)
        )
        body, black = plain[:, :, 0] < 1, lined[:, :, 0] == 0
        assert (lined[body] == plain[body]).all()
        beside = np.zeros_like(body)
        for axis in (0, 1):
            for step in (-1, 1):
                beside |= np.roll(body, step, axis)
        assert black[beside & ~body].all()  # no gap
        assert (lined[~body & ~black] == 1).all()


def test_every_shading_has_the_same_outline() -> None:
    ink = replace(TOON, outline=0.4)
    black = [drawn(single(BENT, ink, shape=TORUS, shading=one)) == 0 for one in Shading]
    assert black[0].any()
    assert all((one == black[0]).all() for one in black)


def test_an_outline_is_as_thick_as_the_rim_of_a_ball() -> None:
    ink = replace(TOON, outline=0.6)
    fine = ShapeGeometry(Shape.SPHERE, (60, 120))
    scene = single(material=ink, shape=fine, view=View(eye=(0, 0, 300)), size=(200, 200))
    found = drawn(replace(scene, lens=Lens(fov_degrees=0.6, near=200, far=400)))
    black = (found[100, :100, 0] == 0).sum()
    radius = 100 / (300 * np.tan(np.radians(0.3)))  # in pixels
    assert abs(black - 0.2 * radius) <= 1


def test_the_corners_of_a_box_move_along_its_diagonals() -> None:
    scene = loaded(single(shape=BOX))
    (body,) = scene.bodies
    expected = np.sign(body.mesh.positions.T) / np.sqrt(3)
    assert np.abs(hull_normals(scene, body) - expected).max() < 1e-15


def test_a_hull_stands_off_equally_in_the_world_however_the_body_is_stretched() -> None:
    scene = loaded(single(BENT, replace(TOON, outline=0.5), shape=BALL))
    (body,) = scene.bodies
    moved = hull(scene, body).mesh.positions - body.positions_world
    assert np.abs(np.linalg.norm(moved, axis=1) - thickness(body)).max() < 1e-12


def test_fog_lies_on_outlines_too() -> None:
    ink, fog = replace(TOON, outline=0.5), Fog((0.7, 0.7, 0.7), 0.0, 1.0)
    found = drawn(single(material=ink, fog=fog, background=(0.2,) * 3))
    assert sorted(np.unique(found).round(12).tolist()) == [0.2, 0.7]


BARE = LoadedGeometry(replace(torus(), uv=None))
IN_VAIN = {
    "texture": (single(material=Material(texture=CHECKER), shape=BARE), "coordinates"),
    "vertex_colours": (single(material=Material(vertex_colours=True)), "colours of its own"),
    "toon_steps": (single(material=Material(toon_steps=5)), "smooth"),
    "shininess": (single(material=Material(shininess=5)), "highlight"),
    "specular": (single(material=Material(specular=(1, 1, 1))), "highlight"),
    "outline": (single(material=replace(TOON, opacity=0.5)), "glass"),
    "normal_map": (single(material=Material(normal_map=CHECKER), shading=Shading.FLAT), "flat"),
    "emission_texture": (single(material=Material(emission_texture=CHECKER)), "no light"),
    "alpha_cutoff": (single(material=Material(alpha_cutoff=0.5)), "the same everywhere"),
}


@pytest.mark.parametrize("setting", [one for recipe in RECIPES.values() for one in recipe.settings])
def test_a_setting_in_vain_is_a_remark_of_every_plan(setting: str) -> None:
    scene, because = IN_VAIN[setting]
    for plan in (planned(loaded(scene)), everything(loaded(scene))):
        (found,) = [one for one in plan.remarks if one.startswith(setting)]
        assert because in found
        assert "thing" in found
    unset = {setting: getattr(DEFAULT_MATERIAL, setting)}
    plain = single(material=replace(scene.objects[0].material, **unset))
    assert not [one for one in planned(loaded(plain)).remarks if one.startswith(setting)]


def test_a_highlight_of_no_light_asks_for_nothing() -> None:
    plan = planned(loaded(single(material=Material(specular=(0, 0, 0)))))
    assert not [one for one in plan.remarks if one.startswith("specular")]


def test_every_field_of_a_material_is_always_read_or_belongs_to_an_effect() -> None:
    lit = {"ambient", "diffuse", "unlit", "emission"}
    always = lit | {"name", "reflection", "opacity", "has_alpha", "sides"}
    owned = [one for recipe in RECIPES.values() for one in recipe.settings]
    assert sorted(owned) == sorted({one.name for one in fields(Material)} - always)


@pytest.mark.parametrize(
    ("world", "material"),
    [
        (World(scale=(1, 1, 0)), TOON),
        (World(), replace(TOON, opacity=0.4)),
        (World(rotate_degrees=(70, 0, 0)), replace(TOON, sides=Sides.FRONT)),
    ],
)
def test_what_has_no_hull_has_no_outline_and_says_so(world: World, material: Material) -> None:
    shape = ShapeGeometry(Shape.PLANE) if material.sides is Sides.FRONT else BALL
    plan = planned(loaded(single(world, material, shape=shape)))
    assert Effect.OUTLINE not in plan.effects
    assert any(one.startswith("outline of material toon changes nothing") for one in plan.remarks)
