"""`--scene` gives what the same options by hand give; an option beside it replaces its own key."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

from nmatrix.report import SCREEN
from nmatrix.scene.words import Mover

ROOT = Path(__file__).parents[2]
TEXT = """
[camera]
eye = [3.0, 2.5, 5.0]
target = [0.0, 0.5, 0.0]
fov = 40
near = 0.5
far = 50
depth = "zero-to-one"

[render]
size = [640, 480]
space = "camera"

[[light]]
name = "sky"
kind = "ambient"

[[light]]
name = "sun"
direction = [-1.0, -2.0, -1.5]

[[light]]
name = "lantern"
kind = "point"
fixed_to = "tall"
position = [0.0, 1.0, 0.0]

[[light]]
name = "torch"
kind = "spot"
fixed_to = "eye"

[[object]]
name = "egg"
shape = "sphere"
translate = [0.1, 0.5, -0.25]
rotate = [0.0, 90.0, 0.0]
scale = [1.0, 2.0, 1.0]

[[object]]
name = "tall"
shape = "box"
scale = [1.0, 3.0, 1.0]

[[object]]
name = "turned"
parent = "tall"
shape = "box"
rotate = [0.0, 0.0, 90.0]
translate = [0.0, 1.0, 0.0]

[[object]]
name = "given"
shape = "box"
matrix = [[1, 0, 0.5], [0, 1, 0], [0, 0, 1]]
"""
WORLD = "--translate 0.1 0.5 -0.25 --rotate 0 90 0 --scale 1 2 1"
VIEW = "--eye 3 2.5 5 --target 0 0.5 0"
LENS = "--fov 40 --near 0.5 --far 50 --aspect 4/3 --depth zero-to-one"
SUN = "--light-direction -1 -2 -1.5"

BY_HAND = [
    ("world", "", WORLD),
    ("view", "", VIEW),
    ("projection", "", LENS),
    ("normal", "--normal 1 1 0", f"{WORLD} {VIEW} --space camera --normal 1 1 0"),
    ("light", "", f"{WORLD} {VIEW} {SUN}"),
    ("eye", "object", f"object {WORLD} {VIEW}"),
    ("space", "", f"{WORLD} {VIEW} {LENS} {SUN} --space camera"),
    ("trace", "--point 1 1 1", f"{WORLD} {VIEW} {LENS} --viewport 640 480 --point 1 1 1"),
    ("calc", "M", f"M {WORLD}"),
    ("calc", "P@V@M", f"P@V@M {WORLD} {VIEW} {LENS}"),
    # an option replaces its own key
    ("world", "--scale 2 2 2", "--translate 0.1 0.5 -0.25 --rotate 0 90 0 --scale 2 2 2"),
    ("calc", "M --translate 1/3 0 0", "M --translate 1/3 0 0 --rotate 0 90 0 --scale 1 2 1"),
    ("view", "--eye 1 2 3", "--eye 1 2 3 --target 0 0.5 0"),
    ("projection", "--far inf", f"{LENS} --far inf".replace("--far 50 ", "")),
    ("projection", "--api vulkan", f"{LENS} --api vulkan".replace("--depth zero-to-one", "")),
    ("light", "--light-position 1 2 3", f"{WORLD} {VIEW} {SUN} --light-position 1 2 3"),
    ("space", "world", f"world {WORLD} {VIEW} {LENS} {SUN}"),
    # an alternative replaces the whole alternative
    (
        "world",
        "--quaternion 0 0 1 1",
        "--translate 0.1 0.5 -0.25 --quaternion 0 0 1 1 --scale 1 2 1",
    ),
    ("world", "--world-matrix 1,0,0;0,1,0;0,0,2", "--world-matrix 1,0,0;0,1,0;0,0,2"),
    ("view", "--elevation -10", "--eye 3 2.5 5 --elevation -10"),
    (
        "projection",
        "--ortho -1 1 -1 1",
        "--ortho -1 1 -1 1 --near 0.5 --far 50 --depth zero-to-one",
    ),
    ("trace", "--viewport 100 200", f"{WORLD} {VIEW} {LENS} --viewport 100 200"),
    # other objects and lights
    ("world", "--object tall", "--scale 1 3 1"),
    ("world", "--object turned", "--world-matrix 0,-1,0,0;3,0,0,3;0,0,1,0;0,0,0,1"),
    # beside a parent, an option replaces the object's own key
    (
        "world",
        "--object turned --translate 0 2 0",
        "--world-matrix 0,-1,0,0;3,0,0,6;0,0,1,0;0,0,0,1",
    ),
    ("world", "--object given", "--world-matrix 1,0,0.5;0,1,0;0,0,1"),
    ("world", "--object given --scale 1 2 1", "--scale 1 2 1"),
    ("light", "--light lantern", f"{WORLD} {VIEW} --light-position 0 3 0"),
    (
        "light",
        "world --object tall --scale 1 5 1 --light lantern",
        f"world --scale 1 5 1 {VIEW} --light-position 0 5 0",
    ),
]


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    path = tmp_path / "scene.toml"
    path.write_text(TEXT)
    return path


@pytest.fixture
def answer(nmatrix):
    def call(line: str) -> dict[str, object]:
        found = nmatrix(f"{line} -f json")
        assert found.code == 0, found.err
        return found.data

    return call


@pytest.mark.parametrize(("command", "beside", "by_hand"), BY_HAND, ids=lambda text: text[:40])
def test_a_scene_gives_what_its_options_give(
    answer, scene: Path, command: str, beside: str, by_hand: str
) -> None:
    free = "trace" in command and "100 200" in beside
    if free:  # the picture's shape follows the window
        by_hand = by_hand.replace("--aspect 4/3", "--aspect 0.5")
    found = answer(f"{command} --scene {scene} {beside}")
    found["remarks"] = [one for one in found["remarks"] if not one.startswith("Of node")]
    assert found == answer(f"{command} {by_hand}")


@pytest.mark.parametrize(
    ("command", "told"),
    [
        ("world", "Of node egg, the first of 4: --object names another."),
        ("normal --object turned", "Of node tall/turned."),
        ("light --object given", "Of node given."),
        (
            "world --object tall --scale 1 2 1",
            "Of node tall, with what was given in place of its own.",
        ),
    ],
)
def test_an_answer_names_its_node(nmatrix, scene: Path, command: str, told: str) -> None:
    line = f"{command} --scene {scene}"
    assert nmatrix(f"{line} -f json").data["remarks"][0] == told
    text = nmatrix(line).out
    assert f"• {told}" in text
    assert len(text.splitlines()) <= SCREEN


@pytest.mark.parametrize(
    "command", ["view", "projection", "calc P", "world --world-matrix 1,0,0;0,1,0;0,0,1"]
)
def test_an_answer_that_is_of_no_node_names_none(nmatrix, scene: Path, command: str) -> None:
    assert "Of node" not in nmatrix(f"{command} --scene {scene} --full").out


MOVERS = {
    Mover.JOINTS: {"mesh": 0, "skin": 0},
    Mover.INSTANCES: {"mesh": 0, "extensions": {"EXT_mesh_gpu_instancing": {"attributes": {}}}},
    Mover.ANIMATION: {},
}


@pytest.mark.parametrize("mover", Mover)
def test_a_matrix_at_rest_is_called_so(nmatrix, tmp_path: Path, mover: Mover) -> None:
    """The long answer of parts makes room for it: `inspect` may say the opposite of the mesh."""
    still = {"name": "still", "matrix": [0, 2, 0, 0, 2, 0, 0, 0, 0, 0, 2, 0, 3, 1, 2, 1]}
    node = still | {"name": "moved"} | MOVERS[mover]
    above = {"name": "above", "children": [1]}
    channel = {"sampler": 0, "target": {"node": 0, "path": "rotation"}}
    document = {
        "asset": {"version": "2.0"},
        "nodes": [above, node, still],
        "meshes": [{"primitives": [{"attributes": {}}]}],
        "skins": [{"joints": [2]}],
        "animations": [{"samplers": [], "channels": [channel]}] if mover is Mover.ANIMATION else [],
    }
    file = tmp_path / "made.gltf"
    file.write_text(json.dumps(document))
    for command in ("world", "normal"):
        answer = nmatrix(f"{command} --scene {file} --object moved")
        assert "inspect judges" in answer.out, answer.err
        assert len(answer.out.splitlines()) <= SCREEN
        assert "inspect judges" not in nmatrix(f"{command} --scene {file} --object still").out


def test_a_hint_of_names_can_be_pasted(nmatrix, tmp_path: Path) -> None:
    """A shell takes # for a comment, and a blank for the end of a word."""
    names = ["cube", "cube", "left wing"]
    file = tmp_path / "twins.gltf"
    file.write_text(
        json.dumps({"asset": {"version": "2.0"}, "nodes": [{"name": n} for n in names]})
    )
    said = nmatrix(f"world --scene {file} --object cube").err
    hint = said[said.index("take one of ") + len("take one of ") :]
    assert shlex.split(hint, comments=True) == ["#0,", "#1"]
    assert nmatrix(f"world --scene {file} --object {shlex.split(hint)[1]!r}").code == 0
    assert "did you mean 'left wing'?" in nmatrix(f"world --scene {file} --object 'left win'").err


def test_matrices_do_not_need_the_materials_of_a_mesh(nmatrix, tmp_path: Path) -> None:
    file = tmp_path / "one.obj"
    file.write_text("mtllib ../other/one.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    assert nmatrix(f"world --scene {file}").code == 0
    assert "--allow-outside" in nmatrix(f"render {file} -o {tmp_path / 'one.png'}").err


def test_a_flashlight_points_where_the_camera_looks(answer, scene: Path) -> None:
    found = answer(f"light camera --scene {scene} --light torch --eye 1 2 3")
    assert found["direction"] == [0, 0, -1]
    assert found["position"] == pytest.approx([0, 0, 0], abs=1e-15)


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("world --scene SCENE --object eg", "did you mean egg? there are egg, tall, turned, given"),
        ("world --scene SCENE --object lamp", "there are egg, tall"),
        ("light --scene SCENE --light son", "did you mean sun?"),
        ("light --scene SCENE --light sky", "ambient light has neither a direction"),
        ("world --object egg", "it is a name in a scene; add --scene FILE"),
        ("light --light sun", "it is a name in a scene; add --scene FILE"),
        ("world --scene none.toml", "there is no such file"),
        ("world --scene scene.txt", "scenes and meshes are"),
        ("world --scene SCENE --scale 1 2", "--scale takes 1 or 3 numbers, got 2 at the end"),
        ("world --scene SCENE --order ZYX --quaternion 0 0 0 1", "--quaternion with --order"),
        ("projection --scene SCENE --near 60", "near"),
        ("view --scene SCENE --eye 0 0.5 0", "they coincide"),
    ],
)
def test_refusals(nmatrix, scene: Path, line: str, words: str) -> None:
    found = nmatrix(line.replace("SCENE", str(scene)))
    assert found.code in (2, 3)
    assert words in found.err
    assert found.is_one_line


def test_nodes_of_a_gltf_file(answer, data: Path) -> None:
    file = data / "gltf/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf"
    found = answer(f"light world --scene {file} --light Point.003")
    assert found["position"] == pytest.approx([0.137618, 2.066984, -1.178986], abs=1e-6)
    file = data / "gltf/NegativeScaleTest/glTF-Binary/NegativeScaleTest.glb"
    assert answer(f"world --scene {file}")["transform"]


def test_without_a_scene_no_reader_is_loaded() -> None:
    code = (
        "import sys; from nmatrix.cli.app import run\n"
        "run(['world', '--scale', '1', '2', '1'])\n"
        "sys.exit(any(one in sys.modules for one in ('msgspec', 'tomllib', 'nmatrix.scene.open')))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=False, cwd=ROOT, capture_output=True)
    assert done.returncode == 0
