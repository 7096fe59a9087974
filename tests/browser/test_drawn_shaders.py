"""What the printed shaders draw: a browser's WebGL2 against the rasterizer, pixel by pixel.

Nothing but what a plan prints is given to the browser, beside the mesh's arrays and the images
and maps that it names.
"""

from __future__ import annotations

import random
from dataclasses import dataclass, replace
from itertools import product
from pathlib import Path
from tempfile import mkdtemp

import numpy as np
import pytest
from browser import webgl
from PIL import Image
from small_scenes import BLINN, BULB, LAMBERT, PHONG, SUN, TOON, single

from nmatrix.enums import Api, DepthRange, NormalRule, Reflection, Shading, Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import rational_matrix
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.plan import Plan, everything, planned
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry, TangentGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, Texture
from nmatrix.scene.open import scene_of
from nmatrix.scene.scene import Fog, Scene, SceneObject
from nmatrix.scene.words import Filter, LightKind, Shape, Sides, Wrap
from nmatrix.scene.world import World

pytestmark = pytest.mark.slow  # a browser draws by software

ENOUGH = 0.999
IMAGES = Path(__file__).parents[2] / "docs" / "scenes"
SKEWED = rational_matrix([[2, 1, 0, 5], [0, 1, 0, -1], [0.5, 0, 1, 2], [0, 0, 0, 1]])
TORUS = TangentGeometry(ShapeGeometry(Shape.TORUS, (8, 12)))
BALL = ShapeGeometry(Shape.SPHERE, (6, 8))
SHEET = TangentGeometry(ShapeGeometry(Shape.PLANE, (6,)))
TURNED = World(rotate_degrees=(10, 20, 30))
MAPS = {
    "turned": TURNED,
    "stretched": replace(TURNED, scale=(1, 1.6, 0.4)),
    "sheared": World(rotate_degrees=(25, 5, 0), shear=(0.7, 0, 0.3)),
    "mirrored": World(scale=(-1, 1, 1.3), shear=(0.4, 0, 0), rotate_degrees=(15, 5, 7)),
}
FLATTENED = World(rotate_degrees=(65, 5, 10), scale=(1.3, 0, 1), shear=(0.3, 0, 0))
SPOT = SceneLight(
    "spot",
    LightKind.SPOT,
    position=(2, 3, 2.5),
    direction=(-2, -3, -2.3),
    cone_degrees=(6, 15),
    intensity=0.8,
    attenuation=(0.5, 0.1, 0.01),
)
LIGHTS = {
    "sun": (SUN,),
    "bulb": (replace(BULB, range=4.1),),
    "spot": (SPOT,),
    "equal cones": (replace(SPOT, cone_degrees=(11, 11)),),
    "three": (SUN, BULB, SPOT),
}
MATERIALS = {
    Reflection.LAMBERT: LAMBERT,
    Reflection.PHONG: PHONG,
    Reflection.BLINN_PHONG: BLINN,
    Reflection.TOON: replace(TOON, outline=0.0),
}
PLANNERS = {"planned": planned, "everything": everything}


@dataclass(frozen=True)
class Case:
    """One object in one space, under some lights, with one feature more."""

    space: Space
    shading: Shading
    reflection: Reflection = Reflection.BLINN_PHONG
    lights: str = "three"
    map: str = "stretched"

    def scene(self, **more: object) -> Scene:
        chosen = {
            "world": MAPS[self.map],
            "material": MATERIALS[self.reflection],
            "lights": LIGHTS[self.lights],
            "shape": TORUS,
            "view": View(eye=(1.0, 1.4, 3.4)),
            "space": self.space,
            "shading": self.shading,
            "space_matrix": SKEWED,
            "size": (200, 150),
            **more,
        }
        return single(**chosen)  # type: ignore[arg-type]


EVERY = [Case(*one) for one in product(Space, Shading, Reflection, LIGHTS, MAPS)]
LIT = [Case(*one) for one in product(Space, Shading)]


def must_agree(page, scene: Scene, least: int = 1500, what: object = "") -> None:
    """Draw a scene by its plan, and with everything on."""
    for name, planner in PLANNERS.items():
        plan = planner(loaded(scene))
        found = webgl.compared(page, plan)
        assert found.pixels >= least, (what, name, found)
        assert found.share >= ENOUGH, (what, name, found)
        assert_all_is_said(plan)


def assert_all_is_said(plan: Plan) -> None:
    """Each uniform and sampler that shaders declare has a value, and nothing else has one."""
    for one in webgl.printed_objects(plan):
        text = one["vertex_shader"] + one["fragment_shader"]
        declared = webgl.declared(text)
        assert declared == {**one["uniforms"], **one["samplers"]}.keys()
        assert not any(value is None for value in one["uniforms"].values())


@pytest.mark.parametrize("space", Space)
def test_spaces_shadings_reflections_lights_and_maps_agree(blank, space: Space) -> None:
    mine = [one for one in EVERY if one.space is space]
    for case in random.Random(space).sample(mine, 8):
        must_agree(blank, case.scene(), what=case)


@pytest.mark.parametrize("reflection", Reflection)
@pytest.mark.parametrize("shading", Shading)
@pytest.mark.parametrize("space", Space)
def test_each_space_shading_and_reflection_agrees(
    blank, space: Space, shading: Shading, reflection: Reflection
) -> None:
    mine = [
        one
        for one in EVERY
        if (one.space, one.shading, one.reflection) == (space, shading, reflection)
    ]
    for case in random.Random(f"{space} {shading} {reflection}").sample(mine, 10):
        must_agree(blank, case.scene(), what=case)


def coloured() -> LoadedGeometry:
    mesh = TORUS.mesh()
    colours = np.random.default_rng(1).random((len(mesh.positions), 3))
    return LoadedGeometry(replace(mesh, colours=colours))


def without_some_normals() -> LoadedGeometry:
    mesh = TORUS.mesh()
    normals = mesh.normals.copy()
    normals[::7] = 0.0
    return LoadedGeometry(replace(mesh, normals=normals))


def ambient(kind: str, color: tuple[float, float, float]) -> SceneLight:
    return SceneLight(kind, LightKind.AMBIENT, color=color)


TILES, BUMPS = (Texture(IMAGES / name) for name in ("tiles.png", "bumps.png"))
MOVED = {"scale": (2.3, 1.7), "rotation_degrees": 25, "offset": (0.3, -0.4)}
WRAPS = [(one, other) for one in Wrap for other in Wrap if one is not other]


def wrapped(plain: Texture, i: int) -> Texture:
    return replace(plain, **MOVED, wrap=WRAPS[i])


def saved(name: str, texels: np.ndarray) -> Texture:
    """A texture of its own file, as a program that draws it would load it."""
    path = Path(mkdtemp()) / name
    Image.fromarray(texels).save(path)
    return Texture(path)


def spotted() -> Texture:
    """Rings of alpha over colours."""
    y, x = np.mgrid[0:32, 0:32] / 31
    alpha = 0.5 + 0.5 * np.cos(9 * np.hypot(x - 0.5, y - 0.5))
    return saved("spotted.png", (255 * np.stack([x, y, 1 - x, alpha], -1)).astype(np.uint8))


def half_clear() -> LoadedGeometry:
    mesh = SHEET.mesh()
    colours = np.random.default_rng(2).uniform(0.3, 1, (len(mesh.positions), 4))
    return LoadedGeometry(replace(mesh, colours=colours))


SPOTTED = spotted()
HAZE = Fog((0.7, 0.8, 0.9), 2.5, 5.5)
SEEN_FROM_BEHIND = World(rotate_degrees=(-70, 10, 5), scale=(1.4, 1, 1))
GLASS = replace(BLINN, opacity=0.4)
FEATURES: dict[str, dict[str, object]] = {
    "an image": {"material": replace(BLINN, texture=TILES)},
    "an image in sRGB": {
        "material": replace(BLINN, texture=TILES),
        "gamma": True,
    },
    "a checker": {"material": replace(BLINN, texture=CHECKER), "size": (320, 240)},
    **{
        f"{name}, {' '.join(WRAPS[i])}": {
            "material": replace(BLINN, texture=wrapped(plain, i)),
            "shape": SHEET,
            "world": World(rotate_degrees=(60, 0, 5), scale=(1.5, 1, 1)),
            "size": (320, 240),
        }
        for name, plain in (("moved image", TILES), ("moved checker", CHECKER))
        for i in range(len(WRAPS))
    },
    "a moved normal map": {"material": replace(PHONG, normal_map=wrapped(BUMPS, 4))},
    "a normal map": {"material": replace(BLINN, normal_map=BUMPS)},
    "colours of vertices": {
        "material": replace(BLINN, vertex_colours=True),
        "shape": coloured(),
    },
    "unlit": {"material": replace(BLINN, texture=TILES).without_light()},
    "unlit, in sRGB and fog": {"material": LAMBERT.without_light(), "gamma": True, "fog": HAZE},
    "emission": {"material": replace(BLINN, emission=(0.3, 0.1, 0.5)), "gamma": True},
    "emission by an image": {
        "material": replace(BLINN, emission=(0.5, 0.9, 0.4), emission_texture=wrapped(TILES, 1))
    },
    "holes": {
        "material": replace(BLINN, texture=SPOTTED, has_alpha=True, alpha_cutoff=0.4),
        "shape": SHEET,
        "world": SEEN_FROM_BEHIND,
        "size": (320, 240),
    },
    "glass by an image and by vertices": {
        "material": replace(
            GLASS, texture=SPOTTED, has_alpha=True, vertex_colours=True, opacity=0.9
        ),
        "shape": half_clear(),
        "world": SEEN_FROM_BEHIND,
    },
    "the nearest texel": {
        "material": replace(BLINN, texture=replace(SPOTTED, filter=Filter.NEAREST)),
        "shape": SHEET,
        "world": SEEN_FROM_BEHIND,
        "size": (320, 240),
    },
    "fog": {"fog": HAZE},
    "fog in sRGB": {"fog": HAZE, "gamma": True},
    "backs": {
        "material": replace(BLINN, sides=Sides.BOTH),
        "shape": SHEET,
        "world": SEEN_FROM_BEHIND,
    },
    "fronts alone": {"material": replace(BLINN, sides=Sides.FRONT), "shape": SHEET, "least": 30},
    "glass": {"material": GLASS, "shape": SHEET, "world": SEEN_FROM_BEHIND},
    "glass in sRGB": {"material": GLASS, "shape": SHEET, "world": SEEN_FROM_BEHIND, "gamma": True},
    "a highlight of exponent 0": {"material": replace(PHONG, shininess=0)},
    "the near plane through it": {"view": View(eye=(0.6, 0.5, 1.2))},
    "light from everywhere": {"lights": (ambient("sky", (0.5, 0.7, 0.2)), SUN)},
    "no lamp": {"lights": ()},
    "no normals at some vertices": {"shape": without_some_normals()},
    "an outline": {"material": TOON},
    "an outline in fog": {"material": TOON, "fog": HAZE},
    "a coarse ball": {"shape": BALL, "material": PHONG},
}


@pytest.mark.parametrize("name", FEATURES)
def test_every_feature_agrees(blank, name: str) -> None:
    (case,) = random.Random(name).sample(LIT, 1)
    must_agree_with(blank, case, FEATURES[name])


@pytest.mark.parametrize("name", FEATURES)
def test_every_feature_agrees_in_many_spaces_shadings_and_maps(blank, name: str) -> None:
    for case, which in random.Random(name).sample([*product(LIT, MAPS)], len(LIT)):
        must_agree_with(blank, replace(case, map=which), FEATURES[name])


SHADOWS = {
    "the sun's": (SUN,),
    "a bulb's": (replace(BULB, range=20),),
    "a spot's": (replace(SPOT, cone_degrees=(20, 40)),),
    "both": (SUN, replace(BULB, range=20)),
}


def over_a_floor(scene: Scene) -> Scene:
    place = World(translate=(0, -1.2, 0), scale=(5, 1, 5), rotate_degrees=(8, 10, 0))
    floor = SceneObject("floor", SHEET, place.world_from_object, LAMBERT)
    return replace(scene, objects=(*scene.objects, floor))


def must_agree_in_shadow(page, case: Case, name: str) -> None:
    lights = tuple(replace(one, shadows=True) for one in SHADOWS[name])
    scene = over_a_floor(case.scene(lights=lights, size=(120, 90), shadow_map=256))
    must_agree(page, scene, 1000, (case, name))


@pytest.mark.parametrize("name", SHADOWS)
def test_shadows_agree(blank, name: str) -> None:
    for case in random.Random(name).sample(LIT, 2):
        must_agree_in_shadow(blank, case, name)


@pytest.mark.parametrize("name", SHADOWS)
def test_shadows_agree_in_many_spaces_shadings_and_maps(blank, name: str) -> None:
    for case, which in random.Random(name).sample([*product(LIT, MAPS)], 2 * len(LIT)):
        must_agree_in_shadow(blank, replace(case, map=which), name)


def must_agree_with(page, case: Case, feature: dict[str, object]) -> None:
    more = dict(feature)
    least = more.pop("least", 1000)
    must_agree(page, case.scene(**more), least, (case, feature))  # type: ignore[arg-type]


@pytest.mark.parametrize("rule", NormalRule)
def test_wrong_normals_are_as_wrong(blank, rule: NormalRule) -> None:
    for case in random.Random(rule).sample(LIT, 3):
        must_agree(blank, case.scene(normals=rule), what=case)


def test_a_flattened_body_agrees_where_it_has_a_space(blank) -> None:
    for case in LIT:
        scene = case.scene(world=FLATTENED, shape=SHEET, size=(100, 75))
        if case.space is Space.OBJECT:
            with pytest.raises(NoAnswerError):
                webgl.printed_objects(planned(loaded(scene)))
            continue
        must_agree(blank, scene, 300, case)


@pytest.mark.parametrize("api", Api)
def test_every_interface_sees_the_same(blank, api: Api) -> None:
    lens = Lens(fov_degrees=45, near=0.5, far=40, clip=api)
    for which in ("turned", "mirrored"):
        view = View(eye=(1.0, 1.4, 3.4), handed=lens.clip.handed)
        scene = Case(Space.CAMERA, Shading.GOURAUD, map=which).scene(view=view)
        must_agree(blank, replace(scene, lens=lens), what=api)


def test_reversed_depth_sees_the_same(blank) -> None:
    lens = Lens(fov_degrees=45, near=0.5, far=40, clip=ClipSpace(DepthRange.REVERSED))
    must_agree(blank, replace(Case(Space.OBJECT, Shading.PHONG).scene(), lens=lens))


SCENES = sorted(IMAGES.glob("*.toml"))


@pytest.mark.parametrize("path", SCENES, ids=[path.stem for path in SCENES])
def test_the_example_scenes_agree(blank, path: Path) -> None:
    scene = scene_of(path).sized(200, 150)
    scene = replace(scene, settings=replace(scene.settings, samples=1))
    opaque = tuple(one for one in scene.objects if not one.material.is_clear)
    must_agree(blank, replace(scene, objects=opaque), what=path.name)


def test_equal_cones_have_an_edge(blank) -> None:
    must_agree(blank, Case(Space.WORLD, Shading.PHONG, lights="equal cones").scene())
    text = webgl.printed_objects(
        planned(loaded(Case(Space.WORLD, Shading.PHONG, lights="equal cones").scene()))
    )[0]["fragment_shader"]
    assert "smoothstep" not in text
    assert "max(cone_cosines.x - cone_cosines.y, 1e-9)" in text


def test_a_wrong_value_would_be_seen(blank, monkeypatch: pytest.MonkeyPatch) -> None:
    scene = Case(Space.WORLD, Shading.PHONG).scene()
    right = webgl.printed_objects

    def turned(plan: Plan) -> list[dict]:
        found = right(plan)
        found[0]["uniforms"]["light_direction_0"][0] += 0.05
        return found

    monkeypatch.setattr(webgl, "printed_objects", turned)
    assert webgl.compared(blank, planned(loaded(scene))).share < ENOUGH


def test_every_effect_with_lines_is_drawn_in_some_case() -> None:
    scenes = [case.scene() for case in EVERY[:: len(MAPS)] if case.space is Space.WORLD]
    shaded = [replace(SUN, shadows=True)]
    scenes.append(over_a_floor(Case(Space.WORLD, Shading.PHONG).scene(lights=tuple(shaded))))
    for feature in FEATURES.values():
        more = {name: value for name, value in feature.items() if name != "least"}
        scenes.append(Case(Space.OBJECT, Shading.PHONG).scene(**more))
    drawn = {effect for scene in scenes for effect in everything(loaded(scene)).effects}
    with_lines = {effect for effect, one in RECIPES.items() if one.has_lines}
    assert with_lines <= drawn, with_lines - drawn
