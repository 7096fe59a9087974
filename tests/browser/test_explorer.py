"""The explorer in a real browser: its numbers are Python's, its pictures the rasterizer's."""

from __future__ import annotations

import io
import json
import random
from base64 import b64decode
from dataclasses import replace
from math import degrees

import numpy as np
import pytest
from PIL import Image

from nmatrix.cli.app import run
from nmatrix.enums import NormalRule, Reflection, Space
from nmatrix.linear.angle import exact_angle_between
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rounding import integers
from nmatrix.output.explorer.page import BACKGROUND, TESSELLATION, page, page_data
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything
from nmatrix.raster.render import render
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World
from nmatrix.shaders.sheet import MATERIAL

SETUP = Setup(World(scale=(1, 2, 1)), View(eye=(1.5, 1.75, 3.25)), light=Light((-1, -2, -1)))
SIZE = 480


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("explorer") / "explore.html"
    path.write_bytes(page(SETUP))
    return path


def state(opened_page) -> dict:
    return json.loads(opened_page.locator("#state").text_content())


def test_it_opens_without_a_request_or_a_complaint(opened, file) -> None:
    found = opened(file)
    assert found.requests_made == [f"file://{file}"]
    assert found.complaints == []
    assert state(found)["errors"] == []
    assert "36.87°" in found.locator("#verdict").text_content()


def drawn_states(count: int) -> list[dict]:
    draw = random.Random(4)
    found = []
    for _ in range(count):
        one: dict = {f"s{a}": draw.choice([0.25, 0.5, 1, 2, 3.5]) for a in "xyz"}
        one |= {f"m{a}": draw.choice([0, 0, 1]) for a in "xyz"}
        one |= {f"r{a}": draw.choice([0, 90, -180, 33, -71.5]) for a in "xyz"}
        one |= {f"h{a}": draw.choice([0, 0, 0.5, -1.25]) for a in ("xy", "xz", "yz")}
        found.append(one)
    return found


def world_of(one: dict) -> World:
    return World(
        scale=tuple(one[f"s{a}"] * (-1 if one[f"m{a}"] else 1) for a in "xyz"),
        rotate_degrees=tuple(one[f"r{a}"] for a in "xyz"),
        shear=tuple(one[f"h{a}"] for a in ("xy", "xz", "yz")),
    )


def test_its_numbers_are_pythons(opened, file) -> None:
    found = opened(file)
    for one in drawn_states(50):
        found.goto(f"file://{file}#" + "&".join(f"{k}={v}" for k, v in one.items()))
        found.wait_for_function(f"state.sx === {one['sx']} && state.rz === {one['rz']}")
        numbers = state(found)
        exact = LinearMap.of([row[:3] for row in world_of(one).exact[:3]])
        for key, matrix in (
            ("A", [[e / exact.denominator for e in row] for row in exact.entries]),
            ("N", exact.inverse_transpose),
            ("C", exact.cofactor_matrix),
        ):
            true = np.array(matrix, float)
            assert np.abs(np.array(numbers[key]) - true).max() <= 1e-12 * np.abs(true).max()
        assert numbers["det"] == pytest.approx(float(exact.determinant), rel=1e-12)
        mesh = ShapeGeometry(Shape.TORUS, TESSELLATION).mesh()
        sign = -1 if exact.integer_determinant < 0 else 1
        largest = max(
            degrees(
                exact_angle_between(
                    integers((np.array(exact.entries, float) @ n).tolist())[0],
                    integers((sign * np.array(exact.cofactors, float) @ n).tolist())[0],
                )
            )
            for n in mesh.normals[::7]
        )
        assert numbers["largest"] >= largest - 1e-9


def picture(found, side: str) -> np.ndarray:
    data = found.evaluate(f"document.getElementById('{side}').toDataURL()").partition(",")[2]
    image = Image.open(io.BytesIO(b64decode(data))).convert("RGB")
    return np.asarray(image, int)


def rasterized(world: World, space: Space, rule: NormalRule) -> np.ndarray:
    material = replace(MATERIAL, reflection=Reflection.BLINN_PHONG)
    shape = ShapeGeometry(Shape.TORUS, TESSELLATION)
    light = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -2, -1))
    settings = replace(
        Settings(), size=(SIZE, SIZE), samples=1, space=space, background=BACKGROUND, normals=rule
    )
    scene = Scene(
        (SceneObject("torus", shape, world.world_from_object, material),),
        (light,),
        SETUP.view,
        Lens(),
        settings,
    )
    image = render(everything(loaded(scene))).rgb
    return np.rint(image * 255).astype(int)


CASES = [
    ("world", "none", {}),
    ("camera", "none", {"rz": 30}),
    ("object", "none", {"hxy": 0.5}),
    ("static", "none", {}),
    ("light", "none", {"ry": 20}),
    ("world", "cofactor", {"mx": 1}),
    ("camera", "not-transposed", {"rz": 30, "hxz": 0.5}),
]


@pytest.mark.parametrize(("space", "rule", "more"), CASES)
def test_its_pictures_are_the_rasterizers(opened, file, space, rule, more) -> None:
    start = {**page_data(SETUP)["start"], **more}
    words = "&".join(
        f"{key}={value}" for key, value in {**more, "space": space, "rule": rule}.items()
    )
    found = opened(file, f"#{words}")
    assert state(found)["errors"] == []
    world = world_of(start)
    sides = {"right": NormalRule.EXACT}
    if space not in ("object", "static"):
        sides["wrong"] = NormalRule(rule)
    for side, carried in sides.items():
        ours, theirs = rasterized(world, Space(space), carried), picture(found, side)
        off = np.abs(ours - theirs).max(axis=2)
        share = (off <= 2).mean()
        assert share >= 0.995, (side, share)
        assert (ours != 237).mean() > 0.05, "something is drawn"


def test_what_is_flattened_has_one_shade(opened, file) -> None:
    """Both sides lie in one place; the one that is turned to the eye is seen, and no other."""
    found = opened(file, "#sy=0")
    drawn = picture(found, "right").reshape(-1, 3)
    drawn = drawn[(drawn != 237).any(axis=1)]
    _, counts = np.unique(drawn, axis=0, return_counts=True)
    assert len(drawn) > 0.02 * SIZE**2
    assert counts.max() > 0.95 * len(drawn)
    assert "does not exist" in found.locator("#right-name").inner_text()


def test_the_shader_in_use_can_be_read(opened, file) -> None:
    found = opened(file, "#space=camera")
    pair = page_data(SETUP)["shaders"]["camera"]
    text = found.locator("#shader").text_content()
    assert text.startswith(pair["vertex"])
    assert text.endswith(pair["fragment"])


def test_two_wrong_pictures_would_not_pass(opened, file) -> None:
    found = opened(file)
    off = np.abs(picture(found, "wrong") - picture(found, "right")).max(axis=2)
    assert (off <= 2).mean() < 0.98


def test_the_keyboard_moves_a_slider_and_the_address(opened, file) -> None:
    found = opened(file)
    found.locator("#sy").focus()
    before = state(found)["A"][1][1]
    found.keyboard.press("ArrowRight")
    assert state(found)["A"][1][1] == pytest.approx(before + 0.05)
    assert "sy=2.05" in found.url
    found.reload()
    assert state(found)["A"][1][1] == pytest.approx(2.05)
    found.locator("#reset").press("Enter")
    assert state(found)["A"][1][1] == 2


def test_a_hostile_address_changes_nothing(opened, file) -> None:
    found = opened(file, "#sx=NaN&sy=1e999&space=<img>&rule=__proto__&nothing=1&rz=&mx=x")
    assert state(found)["A"] == [[1, 0, 0], [0, 2, 0], [0, 0, 1]]
    assert found.complaints == []


def test_a_singular_matrix_is_named_and_never_nan(opened, file) -> None:
    for words in ("sy=0", "sy=0&rule=not-transposed", "sy=0&space=object", "sx=0&sy=0&sz=0"):
        found = opened(file, f"#{words}")
        assert state(found)["N"] is None
        text = found.locator("main").inner_text()
        assert "NaN" not in text
        assert "Infinity" not in text
        assert found.complaints == []


def test_numbers_work_without_webgl(browser, file) -> None:
    context = browser.new_context()
    context.add_init_script("HTMLCanvasElement.prototype.getContext = () => null")
    found = context.new_page()
    found.goto(f"file://{file}")
    assert found.locator("#no-gl").is_visible()
    assert state(found)["largest"] == pytest.approx(36.8699, abs=1e-3)
    found.locator("#sy-n").fill("1")
    assert state(found)["largest"] == 0
    context.close()


def test_it_prints_both_pictures_and_fits_a_phone(opened, file) -> None:
    found = opened(file, viewport={"width": 390, "height": 800})
    assert found.evaluate("document.documentElement.scrollWidth") <= 390
    found.evaluate("window.dispatchEvent(new Event('beforeprint'))")
    found.emulate_media(media="print")
    assert found.locator("img.drawn").count() == 2
    assert found.locator("#controls").is_hidden()
    assert found.locator("img.drawn").first.is_visible()


def test_the_copied_command_shows_the_same_matrix(opened, file, capsys) -> None:
    import shlex

    found = opened(file, "#sx=0.5&rz=33&hxy=0.5&mx=1")
    words = shlex.split(found.locator("#command").text_content())
    assert run([*words[1:], "-f", "json"]) == 0
    answer = json.loads(capsys.readouterr().out)
    assert np.allclose(np.array(answer["space_from_object"])[:3, :3], state(found)["A"], atol=1e-15)
    assert words[:3] == ["nmatrix", "space", "world"]


def test_the_shaders_are_those_that_are_printed(opened, file, capsys) -> None:
    found = opened(file)
    for space in ("world", "camera", "object", "static", "light"):
        words = (
            f"space {space} --scale 1 2 1 --eye 1.5 1.75 3.25 --light-direction -1 -2 -1 -f glsl"
        )
        assert run(words.split()) == 0
        printed = capsys.readouterr().out.partition("// The uniforms' values")[0]
        found.locator("#space").select_option(space)
        assert found.evaluate("glsl()") == printed


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_both_colour_schemes_have_contrast(opened, file, scheme) -> None:
    found = opened(file, color_scheme=scheme)
    ink, ground = (
        found.evaluate(f"getComputedStyle(document.body).{name}")
        for name in ("color", "backgroundColor")
    )
    dark, light = sorted(sum(map(int, one[4:-1].split(","))) for one in (ink, ground))
    assert light - dark > 500
