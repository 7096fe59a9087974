"""The plan against everything on: the same picture, for less work; and each decision's reason."""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from io import BytesIO
from pathlib import Path

import numpy as np
import pytest
from PIL import Image
from small_scenes import BLINN, BULB, LAMBERT, PHONG, SUN, single

from nmatrix.enums import Effect, LeftOut, NormalRule, Reflection, Shading, Space
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rules import NormalTransform
from nmatrix.raster import loaded_scene as loaded_scene_module
from nmatrix.raster.image import png
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.planning.recipe import BUDGET, Decision, by_bound
from nmatrix.raster.proofs.angles import rule_error
from nmatrix.raster.proofs.showpiece import showpiece
from nmatrix.raster.render import Rendered, render
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import EmbeddedImage, Material, Texture, grey
from nmatrix.scene.meshes.shapes import sphere
from nmatrix.scene.meshes.tangents import with_tangents
from nmatrix.scene.open import scene_of
from nmatrix.scene.scene import Fog, Scene, Settings
from nmatrix.scene.words import DepthBuffer, LightKind, Shape, Sides
from nmatrix.scene.world import World

EXAMPLES = Path(__file__).resolve().parents[2] / "docs" / "scenes"
TINY_SHEAR = World(shear=(1e-4, 0, 0))
FINE = ShapeGeometry(Shape.SPHERE, (200, 400))


def bumpy_and_coloured() -> Scene:
    """A sphere whose normals come from an image, and its diffuse part from its vertices."""
    slanted = EmbeddedImage("slanted", png(np.full((2, 2, 3), (160, 110, 240), np.uint8), {}))
    mesh = with_tangents(sphere(12, 24))
    painted = replace(mesh, colours=0.5 + 0.5 * np.abs(mesh.normals))
    material = Material("bumpy", normal_map=Texture(slanted), vertex_colours=True)
    return single(TINY_SHEAR, material, shape=LoadedGeometry(painted))


def leafy() -> Scene:
    """A sphere that shines by itself, with holes where its image is clear."""
    texels = np.full((4, 4, 4), (200, 120, 40, 255), np.uint8)
    texels[::2, ::2, 3] = 0
    file = BytesIO()
    Image.fromarray(texels).save(file, "PNG")
    leaf = Texture(EmbeddedImage("leaf", file.getvalue()))
    material = Material(
        "leaf",
        texture=leaf,
        emission=(0.1, 0.2, 0.0),
        emission_texture=leaf,
        has_alpha=True,
        alpha_cutoff=0.5,
    )
    return single(material=material)


SCENES = {
    "leafy": leafy(),
    "unlit": single(TINY_SHEAR, LAMBERT.without_light()),
    "unlit, by everything": single(TINY_SHEAR, PHONG.without_light(), (SUN, BULB), gamma=True),
    "glowing": single(TINY_SHEAR, replace(LAMBERT, emission=grey(0.4)), shape=FINE, samples=4),
    "matt": single(World(rotate_degrees=(20, 30, 0))),
    "scaled": single(World(scale=(1, 2, 1))),
    "almost rigid": single(TINY_SHEAR),
    "fine": single(shape=FINE),
    "shiny": single(material=PHONG, lights=(SUN, BULB)),
    "fine and shiny": single(material=BLINN, shape=FINE),
    "gouraud": single(material=PHONG, lights=(BULB,), shading=Shading.GOURAUD),
    "flat": single(material=PHONG, shading=Shading.FLAT),
    "object space": single(World(scale=(1, 2, 1)), material=PHONG, space=Space.OBJECT),
    "open": single(World(rotate_degrees=(70, 0, 0)), shape=ShapeGeometry(Shape.PLANE)),
    "inside": single(view=View(eye=(0, 0, 0.2), target=(0, 0, -1))),
    "box": single(World(rotate_degrees=(20, 30, 0)), shape=ShapeGeometry(Shape.BOX)),
    "gamma": single(TINY_SHEAR, gamma=True, samples=4),
    "showpiece": showpiece(Settings(size=(160, 120), samples=4)),
    "bumpy and coloured": bumpy_and_coloured(),
}


@cache
def on_in_some_scene() -> frozenset[Effect]:
    return frozenset().union(*(planned(loaded(scene)).effects for scene in SCENES.values()))


@pytest.mark.parametrize("effect", Effect)
def test_every_effect_is_on_in_some_scene(effect: Effect) -> None:
    assert effect in on_in_some_scene()


@pytest.mark.parametrize("effect", Effect)
def test_every_effect_has_a_record_and_its_line_in_the_documentation(effect: Effect) -> None:
    table = (EXAMPLES.parent / "rendering.md").read_text(encoding="utf-8")
    assert f"| `{effect}` | {RECIPES[effect].says} |" in table


def test_the_table_stands_in_the_order_of_reports() -> None:
    assert list(RECIPES) == list(Effect)


def both(scene: Scene) -> tuple[Rendered, Rendered, float]:
    """Draw a scene by its plan and with everything on; the plan's bound is the third."""
    ready = loaded(scene)
    plan = planned(ready)
    return render(plan), render(everything(ready)), max(body.bound for body in plan.bodies)


@pytest.mark.parametrize("name", SCENES)
def test_the_plan_changes_no_channel_by_more_than_it_says(name: str) -> None:
    found, full, bound = both(SCENES[name])
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12
    assert bound <= BUDGET
    assert found.work.multiplications < full.work.multiplications


@pytest.mark.parametrize("name", [one.stem for one in sorted(EXAMPLES.glob("*.toml"))])
def test_the_plan_changes_no_example_scene(name: str) -> None:
    scene = scene_of(EXAMPLES / f"{name}.toml")
    settings = replace(scene.settings, size=(160, 120), samples=min(scene.settings.samples, 4))
    found, full, bound = both(replace(scene, settings=settings))
    assert np.abs(found.rgb - full.rgb).max() <= max(bound, 1e-12)
    assert found.work.multiplications < full.work.multiplications


def test_the_classroom_calls_for_few_effects_and_everything_for_nearly_all() -> None:
    few, many = (
        planned(loaded(scene_of(EXAMPLES / f"{name}.toml"))).effects
        for name in ("classroom", "everything")
    )
    assert len(few) <= 6
    assert len(many) >= 18
    assert Effect.SHADOWS in many
    assert Effect.TRANSPARENCY in many


def test_where_only_exact_shortcuts_are_taken_no_bit_changes() -> None:
    ready = loaded(single(material=PHONG, lights=(SUN, BULB)))
    plan = planned(ready)
    full = everything(ready)
    (body,), (all_on,) = plan.bodies, full.bodies
    exact = {
        effect for effect, one in body.decisions.items() if not one.on and one.kind is LeftOut.EXACT
    }
    trimmed = replace(all_on, effects=all_on.effects - exact)
    assert any(RECIPES[effect].is_shortcut for effect in exact)
    assert (render(replace(full, bodies=(trimmed,))).rgb == render(full).rgb).all()


def test_a_bound_that_is_too_small_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = single(World(scale=(1, 1.5, 1)))
    careless = replace(RECIPES[Effect.INVERSE_TRANSPOSE], judge=lambda _: by_bound(1e-3, "so"))
    monkeypatch.setitem(RECIPES, Effect.INVERSE_TRANSPOSE, careless)
    found, full, bound = both(scene)
    assert np.abs(found.rgb - full.rgb).max() > bound + 1e-12


def decision(scene: Scene, effect: Effect) -> Decision:
    return planned(loaded(scene)).bodies[0].decisions[effect]


def test_a_scale_calls_for_the_inverse_transpose_and_says_why() -> None:
    found = decision(single(World(scale=(1, 2, 1))), Effect.INVERSE_TRANSPOSE)
    assert found.on
    assert "κ = 2" in found.because
    assert "36.9°" in found.because


def test_what_has_no_part_is_left_out_exactly() -> None:
    for effect in (Effect.SPECULAR, Effect.POSITION, Effect.EYE, Effect.FOG, Effect.TEXTURE):
        found = decision(single(), effect)
        assert not found.on
        assert found.kind is LeftOut.EXACT


def test_a_tiny_shear_is_bounded_and_a_larger_one_is_not_afforded() -> None:
    small = decision(single(TINY_SHEAR), Effect.INVERSE_TRANSPOSE)
    assert not small.on
    assert small.kind is LeftOut.BOUNDED
    assert 0 < small.bound <= BUDGET
    large = decision(single(World(shear=(0.1, 0, 0))), Effect.INVERSE_TRANSPOSE)
    assert large.on
    assert "levels" in large.because


def test_highlights_allow_no_bound_because_they_jump() -> None:
    assert decision(single(TINY_SHEAR, material=PHONG), Effect.INVERSE_TRANSPOSE).on


def test_a_closed_mesh_needs_no_back_faces_until_the_eye_is_inside() -> None:
    assert not decision(single(), Effect.BACK_FACES).on
    assert decision(SCENES["inside"], Effect.BACK_FACES).on
    assert decision(SCENES["open"], Effect.BACK_FACES).on


BLACK = Material("black", diffuse=grey(0), ambient=grey(0.4))
WIDE = Material("wide", diffuse=grey(0), reflection=Reflection.PHONG, shininess=0)
LOW = replace(WIDE, shininess=0.1)
TRAPS = {
    "an outline on black": single(World(scale=(1, 0.3, 1)), replace(BLACK, outline=0.3)),
    "an outline alone": single(material=replace(LAMBERT, outline=0.3), samples=4),
    "a highlight that is a step": single(World(scale=(1, 0.3, 1)), WIDE, shading=Shading.GOURAUD),
    "a highlight with a steep foot": single(material=LOW, shape=FINE),
    "sixteen bits of depth": single(shape=ShapeGeometry(Shape.BOX), depth=DepthBuffer.UNORM16),
    "all but flat": single(World(scale=(1, 0, 1), shear=(0.3, 0.2, 0.1), rotate_degrees=(9, 8, 7))),
    "flat, light per face": single(World(scale=(1, 1, 0)), PHONG, shading=Shading.FLAT),
    "lit from behind through glass": single(
        material=replace(LAMBERT, opacity=0.4),
        lights=(SceneLight("back", LightKind.DIRECTIONAL, direction=(1, 1, 4)),),
    ),
}


@pytest.mark.parametrize("name", TRAPS)
def test_traps_for_a_plan_are_no_traps(name: str) -> None:
    found, full, bound = both(TRAPS[name])
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12


def test_lights_that_cannot_reach_are_named() -> None:
    far = replace(BULB, name="far", position=(100, 0, 0), range=5)
    black = SceneLight("black", LightKind.DIRECTIONAL, intensity=0)
    (body,) = planned(loaded(single(lights=(SUN, far, black)))).bodies
    assert [one.on for one in body.light_decisions] == [True, False, False]
    assert "ends at 5" in body.light_decisions[1].because
    assert "black" in body.light_decisions[2].because


def test_a_light_behind_every_face_is_left_out() -> None:
    below = SceneLight("below", LightKind.DIRECTIONAL, direction=(0, 1, 0))
    lid = single(
        material=replace(LAMBERT, sides=Sides.FRONT),
        lights=(below,),
        shape=ShapeGeometry(Shape.PLANE),
    )
    (body,) = planned(loaded(lid)).bodies
    assert not body.light_decisions[0].on
    (body,) = planned(loaded(single(lights=(below,), shape=ShapeGeometry(Shape.BOX)))).bodies
    assert body.light_decisions[0].on, "a box has a face for every light"


def test_shadows_are_left_out_where_nothing_stands_in_the_way() -> None:
    casting = replace(SUN, shadows=True)
    alone = single(lights=(casting,), shape=ShapeGeometry(Shape.PLANE))
    assert not decision(alone, Effect.SHADOWS).on
    assert decision(single(lights=(casting,)), Effect.SHADOWS).on


def test_steep_ratios_of_w_call_for_exact_weights() -> None:
    steep = single(
        World(translate=(0, -0.5, -900), scale=(5, 1, 903)),
        shape=ShapeGeometry(Shape.PLANE),
        view=View(eye=(0, 0, 4.5)),
    )
    wide = replace(steep, lens=replace(steep.lens, near=1e-3, far=1e4))
    assert decision(wide, Effect.EXACT_WEIGHTS).on
    assert not decision(single(), Effect.EXACT_WEIGHTS).on


def test_grey_scenes_have_one_channel() -> None:
    assert planned(loaded(single())).channels == 1
    tinted = single(material=replace(LAMBERT, diffuse=(0.8, 0.2, 0.2)))
    assert planned(loaded(tinted)).channels == 3


def test_a_room_seen_from_inside_is_lit_by_the_lamp_in_it() -> None:
    lamp = SceneLight("lamp", LightKind.POINT, position=(0.5, 0.5, 0.5))
    room = single(
        World(scale=(5, 5, 5)), lights=(lamp,), shape=ShapeGeometry(Shape.BOX), view=INSIDE
    )
    found, full, bound = both(room)
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12
    assert found.rgb.max() > 0.3, "most of it is bright"
    (body,) = planned(loaded(room)).bodies
    assert body.light_decisions[0].on
    assert body.decisions[Effect.BACK_FACES].on


INSIDE = View(eye=(1, 0, 2), target=(0, 0, -4))


def turned_inwards() -> Scene:
    mesh = sphere(12, 24)
    return single(shape=LoadedGeometry(replace(mesh, triangles=mesh.triangles[:, ::-1])))


def test_a_mesh_that_is_inside_out_keeps_its_visible_side_and_is_told() -> None:
    found, full, bound = both(turned_inwards())
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12
    plan = planned(loaded(turned_inwards()))
    assert plan.bodies[0].decisions[Effect.BACK_FACES].because == "the mesh is inside out"
    assert any("thing is inside out" in one for one in plan.remarks)
    assert not planned(loaded(single())).remarks


@pytest.mark.parametrize(
    ("place", "why"),
    [
        ((40, 0, 0), "is off the screen"),
        ((0, -40, 0), "is off the screen"),
        ((0, 0, 30), "is behind the eye"),
        ((0, 0, -200), "is beyond the far plane"),
    ],
)
def test_what_cannot_be_seen_costs_nothing_and_is_told(
    place: tuple[int, int, int], why: str
) -> None:
    ready = loaded(single(World(translate=place), PHONG, (SUN, BULB), view=View(eye=(0, 0, 6))))
    plan = planned(ready)
    assert plan.bodies[0].why_unseen == why
    assert not plan.drawn
    assert f"Nothing can be seen: thing {why}." in plan.remarks
    drawn = render(plan)
    assert drawn.work.multiplications == drawn.work.fragments == 0
    assert (drawn.rgb == render(everything(ready)).rgb).all()


def test_a_body_without_any_size_is_told() -> None:
    plan = planned(loaded(single(World(scale=(0, 0, 0)))))
    assert plan.remarks == ("Nothing can be seen: thing is shrunk to a point by its matrix.",)


def test_the_outline_of_what_is_off_the_screen_may_be_seen() -> None:
    inked = replace(LAMBERT, outline=0.9)
    edge = single(World(translate=(2.8, 0, 0)), inked, view=View(eye=(0, 0, 4)))
    found, full, bound = both(edge)
    assert found.rgb.min() == 0.0, "the line is there"
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12


def spot(direction: tuple[float, float, float]) -> SceneLight:
    return SceneLight(
        "torch",
        LightKind.SPOT,
        position=(0, 2, 2),
        direction=direction,
        cone_degrees=(30, 30),
    )


def test_a_spot_lights_what_its_cone_meets_and_nothing_else() -> None:
    for direction, is_on in (((0, -1, -1), True), ((0, 1, 1), False), ((1, 0, 0), False)):
        ready = loaded(single(lights=(spot(direction),)))
        plan = planned(ready)
        assert plan.bodies[0].light_decisions[0].on is is_on
        moved = np.abs(render(plan).rgb - render(everything(ready)).rgb).max()
        assert moved <= plan.bodies[0].bound + 1e-12


def test_fog_behind_a_body_is_left_out_and_fog_on_it_is_not() -> None:
    for start, is_on in ((5.9, False), (4.0, True)):
        foggy = single(fog=Fog(grey(0.5), start, 30))
        assert decision(foggy, Effect.FOG).on is is_on
        found, full, bound = both(foggy)
        assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12


def test_a_closed_body_shows_one_side_even_if_its_material_has_two() -> None:
    assert not decision(single(material=replace(LAMBERT, sides=Sides.BOTH)), Effect.BACK_FACES).on


def test_many_weak_lamps_stay_within_one_budget_together() -> None:
    ten = tuple(replace(SUN, name=f"sun {i}", intensity=0.1 * BUDGET) for i in range(30))
    (body,) = planned(loaded(single(lights=ten))).bodies
    left_out = [one for one in body.light_decisions if not one.on]
    assert 10 <= len(left_out) < 30
    assert 0 < body.bound <= BUDGET
    found, full, bound = both(single(lights=ten))
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12


def test_near_a_lamp_without_a_constant_light_is_stronger_than_it_was_sent() -> None:
    near = SceneLight(
        "near",
        LightKind.POINT,
        position=(0, 1.02, 0),
        intensity=1e-3,
        attenuation=(0.0, 0.0, 1.0),
    )
    scene = single(World(shear=(1e-3, 0, 0)), lights=(near,), shape=FINE)
    found, full, bound = both(scene)
    assert np.abs(found.rgb - full.rgb).max() <= bound + 1e-12
    assert planned(loaded(scene)).bodies[0].light_decisions[0].on, "it is no weak lamp there"


def test_a_body_that_comes_out_black_says_why() -> None:
    black = replace(LAMBERT, ambient=grey(0))
    below = SceneLight("below", LightKind.DIRECTIONAL, direction=(0, 1, 0))
    lid = single(material=black, lights=(below,), shape=ShapeGeometry(Shape.PLANE))
    (remark,) = render(planned(loaded(lid))).remarks
    assert "thing is black" in remark
    assert "sends no ambient light back" in remark
    assert not render(planned(loaded(single()))).remarks


def test_a_body_builds_its_transform_of_normals_once_for_each_rule(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """However often the plan, the picture and its proof ask: scenes have thousands of bodies."""
    built, build = [], loaded_scene_module.normal_transform

    def counted(rule: NormalRule, M: RationalMatrix) -> NormalTransform | None:
        built.append(rule)
        return build(rule, M)

    monkeypatch.setattr(loaded_scene_module, "normal_transform", counted)
    plan = planned(loaded(single(World(scale=(1, 2, 1)))))
    render(plan)
    rule_error(plan, NormalRule.NONE)
    assert sorted(built) == [NormalRule.EXACT, NormalRule.NONE]
