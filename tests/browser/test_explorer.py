"""The explorer's numbers are Python's, its pictures the rasterizer's, its commands true."""

from __future__ import annotations

import io
import json
import random
import shlex
from base64 import b64decode
from dataclasses import replace
from fractions import Fraction
from math import degrees

import numpy as np
import pytest
from browser.inside import inside
from PIL import Image

from nmatrix.canvas.theme import PALETTES
from nmatrix.cli.app import run
from nmatrix.enums import NormalRule, Reflection, Space, Theme
from nmatrix.linear.angle import exact_angle_between
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import to_floats
from nmatrix.linear.rounding import integers
from nmatrix.output.explorer.page import OTHER_SPACE, SURFACE, TESSELLATION, page, page_data
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.render import render
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

pytestmark = pytest.mark.slow  # a browser draws by software

SETUP = Setup(World(scale=(1, 2, 1)), View(eye=(1.5, 1.75, 3.25)), light=Light((-1, -2, -1)))
SIZE = 480
BARE = inside(
    """side => {
  const size = SIZE, pen = new Pen(document.createElement("canvas"), size, "light");
  painter.picture({ ...bodyOf(state, side, meaningNow()), size, ink: [0, 0, 0] });
  pen.clear(); painter.copyTo(pen.context, size);
  return pen.context.canvas.toDataURL();
}""".replace("SIZE", str(SIZE))
)
STAGE = tuple(int(PALETTES[Theme.LIGHT].stage[i : i + 2], 16) for i in (1, 3, 5))
TORUS = ShapeGeometry(Shape.TORUS, TESSELLATION)
TURNS = {f"r{a}": 0 for a in "xyz"}


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("explorer") / "explore.html"
    path.write_bytes(page(SETUP))
    return path


@pytest.fixture(scope="module")
def calm(browser, file):
    """One page for all tests that only read it, moved by its address."""
    found = browser.new_page()
    found.goto(f"file://{file}")
    yield found
    found.close()


def state(opened_page) -> dict:
    return json.loads(opened_page.locator("#state").text_content())


GO = "history.replaceState(null, '', '#' + words); read(); fill(null);"


def moved(opened_page, words: str) -> dict:
    """The page's state at an address, with everything drawn."""
    opened_page.evaluate(inside("words => {" + GO + "drawNow(); }"), words)
    return state(opened_page)


def told(opened_page, words: str) -> dict:
    """The page's state at an address, with its words and numbers, and no new pictures."""
    opened_page.evaluate(inside("words => {" + GO + "writeWords(state, meaningNow()); }"), words)
    return state(opened_page)


def written(one: dict) -> str:
    return "&".join(f"{key}={value}" for key, value in one.items())


def test_it_opens_without_a_request_or_a_complaint(opened, file) -> None:
    found = opened(file)
    assert found.requests_made == [f"file://{file}"]
    assert found.complaints == []
    assert state(found)["errors"] == []
    assert "36.9°" in found.locator("#sentence").text_content()
    assert found.locator("#number").text_content() == "36.9°"


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


def worst_angle(exact: LinearMap) -> float:
    """The angle between A n and A⁻ᵀ n at worst, over normals of a fine ball."""
    mesh = ShapeGeometry(Shape.SPHERE, TESSELLATION).mesh()
    sign = -1 if exact.integer_determinant < 0 else 1
    return max(
        degrees(
            exact_angle_between(
                integers((np.array(exact.entries, float) @ n).tolist())[0],
                integers((sign * np.array(exact.cofactors, float) @ n).tolist())[0],
            )
        )
        for n in mesh.normals[::7]
    )


def test_its_numbers_are_pythons(calm) -> None:
    for one in drawn_states(40):
        numbers = told(calm, written(one))
        exact = LinearMap.of([row[:3] for row in world_of(one).exact[:3]])
        for key, matrix in (
            ("A", [[e / exact.denominator for e in row] for row in exact.entries]),
            ("N", exact.inverse_transpose),
            ("C", exact.cofactor_matrix),
        ):
            true = np.array(matrix, float)
            assert np.abs(np.array(numbers[key]) - true).max() <= 1e-12 * np.abs(true).max()
        assert numbers["det"] == pytest.approx(float(exact.determinant), rel=1e-12)
        singular = np.linalg.svd(np.array(numbers["A"]), compute_uv=False)
        kappa = singular[0] / singular[2]
        known = degrees(np.arctan((kappa - 1 / kappa) / 2))
        assert numbers["largest"] == pytest.approx(known, abs=1e-6), one
        assert numbers["largest"] >= worst_angle(exact) - 1e-9


def test_its_fractions_are_pythons_where_no_sine_is_in_the_way(calm) -> None:
    for one in drawn_states(60):
        quarter = {key: round(one[key] / 90) * 90 for key in TURNS}
        numbers = told(calm, written(one | quarter))
        exact = world_of(one | quarter).exact
        assert [
            [Fraction(x.replace("−", "-")) for x in row] for row in numbers["exact"]
        ] == [list(row[:3]) for row in exact[:3]]  # fmt: skip
    assert told(calm, "rz=33")["exact"] is None
    assert "Decimals" in calm.locator("#matrices").text_content()


@pytest.mark.parametrize("rule", [NormalRule.NOT_TRANSPOSED, NormalRule.NOT_INVERTED])
def test_the_worst_angle_of_other_mistakes_is_no_less_than_a_search_finds(calm, rule) -> None:
    mesh = ShapeGeometry(Shape.SPHERE, (90, 180)).mesh()
    for one in drawn_states(8):
        numbers = told(calm, f"{written(one)}&rule={rule}")
        A, N = np.array(numbers["A"]), np.array(numbers["N"])
        W = np.linalg.inv(A) if rule is NormalRule.NOT_TRANSPOSED else A.T
        a, b = mesh.normals @ W.T, mesh.normals @ N.T
        cosine = (a * b).sum(1) / np.linalg.norm(a, axis=1) / np.linalg.norm(b, axis=1)
        found = degrees(np.arccos(np.clip(cosine, -1, 1)).max())
        assert found - 1e-6 <= numbers["largest"] <= found + 3.0, one


def pixels(address: str) -> np.ndarray:
    image = Image.open(io.BytesIO(b64decode(address.partition(",")[2]))).convert("RGB")
    return np.asarray(image, int)


def rasterized(
    world: World, space: Space, rule: NormalRule, eye: tuple, shape: object = TORUS
) -> np.ndarray:
    material = Material(
        ambient=SURFACE["ambient_color"],
        diffuse=SURFACE["diffuse_color"],
        reflection=Reflection.LAMBERT,
    )
    light = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -2, -1))
    settings = replace(
        Settings(),
        size=(SIZE, SIZE),
        samples=1,
        space=space,
        background=tuple(level / 255 for level in STAGE),
        normals=rule,
        space_matrix=OTHER_SPACE,
    )
    scene = Scene(
        (SceneObject("torus", shape, world.world_from_object, material),),
        (light,),
        View(eye=eye),
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
    ("custom", "none", {"ry": 20}),
    ("world", "cofactor", {"mx": 1}),
    ("camera", "not-transposed", {"rz": 30, "hxz": 0.5}),
]


def test_every_space_is_drawn_below() -> None:
    assert {space for space, _, _ in CASES} == set(Space)


@pytest.mark.parametrize(("space", "rule", "more"), CASES)
def test_its_pictures_are_the_rasterizers(calm, space, rule, more) -> None:
    start = {**page_data(SETUP)["start"], **more}
    numbers = moved(calm, written({**more, "shape": "torus", "space": space, "rule": rule}))
    assert numbers["errors"] == []
    world = world_of(start)
    sides = {"right": NormalRule.EXACT}
    if space not in ("object", "static"):
        sides["wrong"] = NormalRule(rule)
    for side, carried in sides.items():
        ours = rasterized(world, Space(space), carried, tuple(numbers["eye"]))
        theirs = pixels(calm.evaluate(BARE, side))
        off = np.abs(ours - theirs).max(axis=2)
        share = (off <= 2).mean()
        assert share >= 0.995, (side, share)
        assert (ours != STAGE).any(axis=2).mean() > 0.05, "something is drawn"


def test_the_letter_is_the_one_of_the_proofs(calm) -> None:
    numbers = moved(calm, "shape=R&mx=1&ry=20")
    world = world_of({**page_data(SETUP)["start"], "mx": 1, "ry": 20})
    letter = LoadedGeometry(letter_r())
    ours = rasterized(world, Space.WORLD, NormalRule.EXACT, tuple(numbers["eye"]), letter)
    off = np.abs(ours - pixels(calm.evaluate(BARE, "right"))).max(axis=2)
    assert (off <= 2).mean() >= 0.995
    assert (ours != STAGE).any(axis=2).mean() > 0.05


def test_two_wrong_pictures_would_not_pass(calm) -> None:
    moved(calm, "shape=torus")
    wrong, right = (pixels(calm.evaluate(BARE, side)) for side in ("wrong", "right"))
    assert (np.abs(wrong - right).max(axis=2) <= 2).mean() < 0.98


@pytest.mark.parametrize("axis", ["x", "y", "z"])
@pytest.mark.parametrize("shape", ["egg", "torus"])
def test_what_is_flattened_has_one_shade_and_no_specks(calm, axis, shape) -> None:
    """Both sides lie in one place; the one that is turned to the eye is seen, and no other."""
    moved(calm, f"sy=1&s{axis}=0&shape={shape}")
    drawn = pixels(calm.evaluate(BARE, "right")).reshape(-1, 3)
    drawn = drawn[(drawn != STAGE).any(axis=1)]
    _, counts = np.unique(drawn, axis=0, return_counts=True)
    assert len(drawn) > 0.02 * SIZE**2
    assert counts.max() > 0.95 * len(drawn)
    wrong = pixels(calm.evaluate(BARE, "wrong"))
    body = (wrong != STAGE).any(axis=2)
    inner = body[1:-1, 1:-1] & body[:-2, 1:-1] & body[2:, 1:-1] & body[1:-1, :-2] & body[1:-1, 2:]
    around = np.stack([wrong[:-2, 1:-1], wrong[2:, 1:-1], wrong[1:-1, :-2], wrong[1:-1, 2:]])
    alone = (np.abs(around - wrong[1:-1, 1:-1]).max(axis=3) > 40).sum(axis=0) >= 3
    assert (alone & inner).sum() <= 0.002 * inner.sum(), "no pixel stands out from its neighbours"
    assert "does not exist" in calm.locator("#matrices").inner_text()


def test_each_space_is_nmatrixs(calm) -> None:
    for one in drawn_states(6):
        numbers = told(calm, written(one))
        given = replace(
            SETUP,
            world=world_of(one),
            view=View(eye=tuple(numbers["eye"])),
            space_matrix=OTHER_SPACE,
        )
        for space in Space:
            theirs = np.array(to_floats(given.maps.space_from_world(space).exact))
            assert np.allclose(numbers["spaces"][space], theirs, atol=1e-12, rtol=1e-12), space


def answer(words: str, capsys) -> dict:
    capsys.readouterr()
    split = shlex.split(words)
    assert split[0] == "nmatrix"
    assert run([*split[1:], "-f", "json"]) == 0
    return json.loads(capsys.readouterr().out)


def test_the_copied_command_gives_what_the_page_shows(calm, capsys) -> None:
    numbers = told(calm, "sx=0.5&rz=33&hxy=0.5&mx=1")
    found = answer(calm.locator("#command").text_content(), capsys)
    assert np.allclose(np.array(found["world_from_object"])[:3, :3], numbers["A"], atol=1e-15)
    assert np.allclose(found["normal_matrix"], numbers["N"], atol=1e-15)
    told(calm, "sy=1")
    assert calm.locator("#command").text_content() == "nmatrix world"
    told(calm, "sy=1.75")
    assert run(shlex.split(calm.locator("#command").text_content())[1:]) == 0
    shown = calm.locator("#number").text_content()
    assert f"up to {shown[:-1]}" in capsys.readouterr().out


def assert_journey_is_the_trace(found, capsys, words: str) -> None:
    numbers = told(found, words)
    traced = answer(found.locator("#trace-command").text_content(), capsys)
    for name, values in numbers["journey"]:
        key = next(one for one in (name, f"{name}_position") if one in traced)
        assert np.allclose(values, traced[key], rtol=1e-9, atol=1e-9), name


def test_the_journey_is_the_trace(calm, capsys) -> None:
    for words in ("", "sx=0.5&rz=33&hxy=0.5&mx=1&v=0.7&yaw=20&tilt=10", "shape=R&v=0.1"):
        assert_journey_is_the_trace(calm, capsys, words)


LENSES = [
    "--api vulkan",
    "--depth reversed",
    "--handed left",
    "--ortho -3 3 -3 3 --near 1",
    "--frustum -1 1 -1 1 --near 2 --far inf",
    "--elevation -20 --angle 10 --eye 1 2 6",
    "--up 1 1 0 --target 0 0.5 0 --api direct3d",
]


@pytest.mark.parametrize("options", LENSES)
def test_every_lens_draws_the_body_in_the_middle_and_is_told(
    opened, tmp_path, capsys, options
) -> None:
    path = tmp_path / "page.html"
    assert run(["explore", *options.split(), "-o", str(path)]) == 0
    found = opened(path)
    assert found.complaints == []
    for words in ("mode=plain", "mode=plain&yaw=25&tilt=8"):
        assert moved(found, words)["errors"] == []
        drawn = pixels(found.evaluate(BARE, "right"))
        body = (drawn != STAGE).any(axis=2)
        assert 0.03 < body.mean() < 0.9
        lit, dark = drawn[body].sum(axis=1).max(), drawn[body].sum(axis=1).min()
        assert lit - dark > 150, "the front is seen, with its lit and its dark side"
        assert_journey_is_the_trace(found, capsys, words)


@pytest.mark.parametrize("body", ["", "sy=1", "hxy=1"])
def test_the_shaders_are_those_that_the_copied_command_prints(calm, capsys, body) -> None:
    for space in Space:
        told(calm, f"{body}&space={space}&yaw=12")
        words = shlex.split(calm.locator("#shader-command").text_content())
        capsys.readouterr()
        assert run(words[1:]) == 0
        printed = capsys.readouterr().out.partition("// The uniforms' values")[0]
        assert calm.evaluate(inside("() => glsl()")) == printed, space
        assert calm.locator("#shader").text_content() == printed


def test_a_hostile_address_changes_nothing(opened, file) -> None:
    found = opened(file, "#sx=NaN&sy=1e999&space=<img>&rule=__proto__&nothing=1&rz=&mx=x&story=a")
    assert state(found)["A"] == [[1, 0, 0], [0, 2, 0], [0, 0, 1]]
    assert found.complaints == []


def test_a_singular_matrix_is_named_and_never_nan(calm) -> None:
    for words in (
        "sy=0&mode=arrows",
        "sy=0&rule=not-transposed",
        "sy=0&rule=not-inverted&mode=heat",
        "sy=0&rule=cofactor&mode=plain",
        "sy=0&rule=stuck",
        "sy=0&space=object",
        "sx=0&sy=0",
        "sx=0&sy=0&sz=0",
        "sy=0&shape=R&rx=30",
    ):
        assert moved(calm, words)["N"] is None
        text = calm.locator("main").inner_text()
        for nonsense in ("NaN", "Infinity", "undefined", "null"):
            assert nonsense not in text, words
        assert state(calm)["errors"] == []


def test_the_sign_that_the_sentence_names_is_that_of_the_space_of_shading(opened, tmp_path) -> None:
    path = tmp_path / "mirror.html"
    mirror = "-1 0 0; 0 1 0; 0 0 1"
    assert run(["explore", "--space-matrix", mirror, "-o", str(path)]) == 0
    found = opened(path)
    for mirrored, sign in ((0, "det(S A) = −2 is negative"), (1, "det(S A) = 2 is positive")):
        numbers = told(found, f"mx={mirrored}&space=custom&rule=cofactor")
        assert sign in found.locator("#sentence").text_content()
        assert numbers["largest"] == (0 if mirrored else 180)


SENTENCES = {
    "sy=1": "Left as it is: lengths and angles stay",
    "sy=1&ry=30": "Turned 30° about y: lengths and angles stay",
    "sy=1&mx=1": "Only the rule that forgets the sign of det A would fail.",
    "sx=2&sz=2": "Scaled 2× in every direction: A n and A−T n differ in length alone",
    "sx=0.5&sy=3": "Stretched 3× along y and squeezed to 0.5× along x",
    "sy=0": "det A = 0, so the inverse is gone",
    "sy=0&sx=0": "the shape became a line",
    "sy=0&sx=0&sz=0": "nothing is left but a point",
    "sy=0&rule=not-transposed": "asks for the inverse and has no answer",
    "sy=0&rule=cofactor": "it is right here",
    "rule=cofactor": "det A = 2 is positive",
    "hxy=1&rule=not-transposed": "inverts and forgets to transpose, and is up to",
    "sy=1&rule=not-transposed": "with this very map A−1 n and A−T n point the same way",
    "sy=1&rz=40&rule=not-inverted": "turns normals another way, up to 80° off",
    "space=object": "no normal matrix, so none to get wrong",
    "sy=0&space=object": "no inverse leads back to object space",
    "sy=1&space=custom": "custom space stretches on its own",
    "sy=1&rule=stuck": "arrives where it was, so this test proves nothing",
    "sy=1&rz=40&rule=stuck": "the light was carried along as if it belonged to the model",
    "tx=0.5&sy=1": "Moved 0.5 along x: lengths and angles stay",
    "sy=1&ry=20&rule=stuck": "so the same part of it stays lit wherever it is put",
    "hxy=1&sy=1": "x slides 1 for each unit of y",
    "sx=999999&sy=0.05&rx=30&rz=90&hxy=0.05&space=light&rule=cofactor": "is positive, so cofactors",
    "mx=1&sx=999999&sy=0.05&rx=30&rz=90&hxy=0.05&space=light&rule=cofactor": "body, 180° off",
    "lx=0&ly=0&lz=0&rule=stuck": "The light has no direction here, so none can be carried along",
}


@pytest.mark.parametrize("words", SENTENCES)
def test_the_sentence_is_true_and_holds_the_number(calm, words) -> None:
    numbers = told(calm, words)
    said = calm.locator("#sentence").text_content()
    assert SENTENCES[words] in said
    assert numbers["isSame"] == ("proves nothing" in said or "it is right here" in said
                                 or "none to get wrong" in said)  # fmt: skip
    if numbers["largest"]:
        degrees_said = calm.locator("#number").text_content()
        assert degrees_said in said
        assert float(degrees_said[:-1]) == pytest.approx(numbers["largest"], abs=0.05)


BEYOND = {
    "--scale 1e150 --rotate 0 0 20": ("det A = 1e+450", "differ in length alone"),
    "--scale 1e-150 -1e-150 1e-150 --rotate 10 0 0": ("det A = −1e−450", "mirrored along y"),
    "--scale 1e150 1e-150 1e-150": ("1e−150", "Stretched 1e+150× along x"),
    "--scale 1e-310 1 1": ("1e+310", "Squeezed to 1e−310× along x"),
}


@pytest.mark.parametrize("options", BEYOND)
def test_sizes_beyond_the_floats_are_told_and_never_nan(opened, tmp_path, options) -> None:
    path = tmp_path / "page.html"
    assert run(["explore", *options.split(), "-o", str(path)]) == 0
    found = opened(path)
    for rule in ("none", "cofactor", "not-transposed", "not-inverted", "stuck"):
        told(found, f"rule={rule}")
        text = found.locator("main").inner_text()
        for nonsense in ("NaN", "Infinity", "undefined", "null"):
            assert nonsense not in text, rule
        assert found.locator("#number").text_content() != "—"
    told(found, "")
    in_matrices, in_sentence = BEYOND[options]
    assert in_matrices in found.locator("#matrices").inner_text()
    assert in_sentence in found.locator("#sentence").text_content()
    assert found.complaints == []


def test_the_light_that_is_stuck_lights_the_same_part_wherever_it_is_put(calm) -> None:
    """(A⁻ᵀ n) · (A l) = n · l: both sides have one sign at every vertex of the body."""
    script = inside(
        """() => { const { right, stuckLight, light, mesh } = meaningNow();
        const dot = (a, b) => a.reduce((sum, x, i) => sum + x * b[i], 0);
        return mesh.directions.map(n => [dot(apply(right, n), stuckLight), dot(n, light)]); }"""
    )
    for one in drawn_states(8):
        told(calm, f"{written(one)}&rule=stuck")
        for carried, before in calm.evaluate(script):
            assert carried * before >= -1e-12 * max(abs(carried), abs(before))


def test_numbers_work_without_webgl(browser, file) -> None:
    context = browser.new_context()
    context.add_init_script(
        """const made = HTMLCanvasElement.prototype, old = made.getContext;
        made.getContext = function (kind, ...more) {
            return kind === "webgl2" ? null : old.call(this, kind, ...more); };"""
    )
    found = context.new_page()
    found.goto(f"file://{file}")
    assert found.locator("#no-gl").is_visible()
    assert state(found)["largest"] == pytest.approx(36.8699, abs=1e-3)
    found.locator("#sy-n").fill("1")
    found.evaluate(inside("() => drawNow()"))
    assert state(found)["largest"] == 0
    context.close()
