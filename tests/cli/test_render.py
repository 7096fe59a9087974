"""`render` and `plan` as their users meet them: files, frames, formats, and misuse of each."""

from __future__ import annotations

import errno
import json
import shlex
from base64 import b64encode
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from nmatrix.cli.app import run
from nmatrix.enums import PixelFormat, Shown, Space, VectorFormat
from nmatrix.errors import IllegalValueError
from nmatrix.output import files
from nmatrix.output.files import PICTURES
from nmatrix.raster.image import IMAGE_DESCRIPTION, picture_file
from nmatrix.raster.proofs.catalogue import PROOFS
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.scene.meshes.shapes import box

pytestmark = pytest.mark.usefixtures("own_folder")

SMALL = "--size 40 40 --samples 1"
TRIANGLE = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
SCENE = """
[[light]]
name = "lamp"
kind = "point"
position = [2, 3, 4]
[[object]]
name = "ball"
shape = "sphere"
scale = [1, 2, 1]
material = "shiny"
[materials.shiny]
reflection = "phong"
specular = 0.4
[render]
size = [48, 32]
samples = 1
"""


@pytest.fixture
def scene(tmp_path: Path) -> str:
    (tmp_path / "scene.toml").write_text(SCENE)
    return "scene.toml"


KEYS = (
    "image width height subject max_angle_error_deg mean_angle_error_deg max_level_difference "
    "triangles fragments work milliseconds effects"
).split()


def test_a_scene_is_drawn_in_its_own_size(nmatrix, scene: str) -> None:
    found = nmatrix(f"render {scene} -f json")
    assert found.code == 0, found.err
    assert set(KEYS) <= set(found.data)
    assert (found.data["width"], found.data["height"]) == (48, 32)
    assert "specular" in found.data["effects"]
    assert Image.open("scene.png").size == (48, 32)


def test_a_mesh_is_drawn_and_measured(nmatrix, tmp_path: Path) -> None:
    (tmp_path / "a.obj").write_text(TRIANGLE)
    found = nmatrix(f"render a.obj --shear 1 0 0.5 {SMALL} -f json")
    assert found.code == 0, found.err
    assert found.data["triangles"] == 1
    assert found.data["max_angle_error_deg"] > 1
    assert (
        sum(
            "Normals were made, smooth but for sharp edges: a.obj" in one
            for one in found.data["remarks"]
        )
        == 1
    )
    (tmp_path / "b.obj").write_text(TRIANGLE.replace("f 1 2 3", "vn 0 1 1\nf 1//1 2//1 3//1"))
    assert not any(
        "made" in one for one in nmatrix(f"render b.obj {SMALL} -f json").data["remarks"]
    )


def cube_files(folder: Path) -> list[str]:
    """Write a cube in three kinds of files, none with a light or a camera."""
    cube = box()
    places, normals, triangles = cube.positions, cube.normals, cube.triangles
    lines = [f"v {' '.join(map(str, one))}\n" for one in places.tolist()]
    lines += [f"vn {' '.join(map(str, one))}\n" for one in normals.tolist()]
    lines += [f"f {' '.join(f'{i}//{i}' for i in one)}\n" for one in (triangles + 1).tolist()]
    (folder / "cube.obj").write_text("".join(lines))
    parts = [places.astype("<f4").tobytes(), normals.astype("<f4").tobytes()]
    parts.append(triangles.astype("<u2").tobytes())
    starts = [0, len(parts[0]), len(parts[0]) + len(parts[1])]
    rows, indices = len(places), triangles.size
    document = {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "count": rows, "type": "VEC3"},
            {"bufferView": 1, "componentType": 5126, "count": rows, "type": "VEC3"},
            {"bufferView": 2, "componentType": 5123, "count": indices, "type": "SCALAR"},
        ],
        "bufferViews": [
            {"buffer": 0, "byteOffset": start, "byteLength": len(part)}
            for start, part in zip(starts, parts, strict=True)
        ],
        "buffers": [
            {
                "byteLength": sum(map(len, parts)),
                "uri": f"data:;base64,{b64encode(b''.join(parts)).decode()}",
            }
        ],
    }
    (folder / "cube.gltf").write_text(json.dumps(document))
    (folder / "cube.toml").write_text("[[object]]\nshape = 'box'\n")
    return ["cube.obj", "cube.gltf", "cube.toml"]


def test_the_three_sides_of_a_cube_have_three_greys(nmatrix, tmp_path: Path) -> None:
    for name in cube_files(tmp_path):
        found = nmatrix(f"render {name} --size 200 200 -o a.png --force -f json").data["remarks"]
        assert sum("No camera was given" in one for one in found) == 1
        assert sum("No light was given" in one for one in found) == 1
        pixels = np.asarray(Image.open("a.png"))[:, :, 0].astype(int)
        paper = pixels[0, 0]
        levels, counts = np.unique(pixels[pixels != paper], return_counts=True)
        sides = sorted(levels[counts > 0.05 * counts.sum()].tolist())
        assert len(sides) == 3
        assert min(np.diff(sides)) > 40
        lit = nmatrix(f"render {name} {SMALL} --light-direction 0 0 -1 -o b.png --force -f json")
        assert not any("No light was given" in one for one in lit.data["remarks"])


def test_a_wrong_rule_shows_in_the_levels(nmatrix, scene: str) -> None:
    found = nmatrix(f"render {scene} --normals none -f json").data
    assert found["max_level_difference"] > 20
    assert found["max_angle_error_deg"] > 30


def test_everything_on_draws_the_same_with_more_work(nmatrix, scene: str) -> None:
    planned = nmatrix(f"render {scene} -o a.png -f json").data
    full = nmatrix(f"render {scene} --effects all -o b.png -f json").data
    assert full["work"]["multiplications"] > planned["work"]["multiplications"]
    a, b = (np.asarray(Image.open(name)).astype(int) for name in ("a.png", "b.png"))
    assert np.abs(a - b).max() <= 1


@pytest.mark.parametrize("space", sorted(set(Space) - {Space.WORLD, Space.CUSTOM}))
def test_spaces_are_an_option(nmatrix, scene: str, space: Space) -> None:
    nmatrix(f"render {scene} -o a.png")
    assert nmatrix(f"render {scene} --space {space} -o b.png").code == 0
    assert Path("a.png").read_bytes()[-200:] == Path("b.png").read_bytes()[-200:]


def told_in(name: str) -> dict[str, str]:
    """Return the numbers that a picture's file tells."""
    image = Image.open(name)
    if image.format == "PNG":
        return image.text
    told = image.getexif().get(IMAGE_DESCRIPTION) or image.info["comment"].decode()
    return json.loads(told)


@pytest.mark.parametrize("ending", [*PICTURES, *(one.upper() for one in PICTURES)])
def test_a_file_is_what_its_name_says_and_tells_its_numbers(nmatrix, ending: str) -> None:
    found = nmatrix(f"render normals {SMALL} -o a{ending} -f json")
    assert found.code == 0, found.err
    assert Image.open(f"a{ending}").format.lower() == PICTURES[ending.lower()]
    told = told_in(f"a{ending}")
    assert told["max_angle_error_deg"] == repr(found.data["max_angle_error_deg"])
    nmatrix(f"render normals {SMALL} -o b.png")
    exact, own = (np.asarray(Image.open(name).convert("RGB")) for name in ("b.png", f"a{ending}"))
    apart = np.abs(exact.astype(int) - own).mean()
    assert apart < 2
    assert apart == 0 or ending.lower() not in (".png", ".webp")


@pytest.mark.parametrize("ending", PICTURES)
def test_frames_are_numbered_files_or_one_animation(nmatrix, ending: str) -> None:
    line = f"render normals {SMALL} --frames 3 --turn -o walk{ending}"
    assert nmatrix(line).code == 0
    animated = PICTURES[ending].is_animated
    names = [f"walk{ending}"] if animated else [f"walk-{i}{ending}" for i in range(3)]
    assert sorted(one.name for one in Path().iterdir()) == names
    for name in names:
        with Image.open(name) as image:
            assert image.format.lower() == PICTURES[ending]
            assert getattr(image, "n_frames", 1) == (3 if animated else 1)
            assert told_in(name)["Title"].startswith("Stretch a shape by A")
    assert nmatrix(line).code == 2


@pytest.mark.parametrize("ending", VectorFormat)
def test_only_a_proof_is_written_as_lines(nmatrix, scene: str, ending: VectorFormat) -> None:
    assert nmatrix(f"render normals {SMALL} -o a.{ending}").code == 0
    found = nmatrix(f"render {scene} {SMALL} --show axes -o b.{ending}")
    assert found.code == 2
    assert found.is_one_line
    assert not Path(f"b.{ending}").exists()


@pytest.mark.parametrize("name", ["a.mp4", "a.exr", "a", ".png", "a.png.txt"])
@pytest.mark.parametrize("frames", ["", "--frames 2 --turn"])
def test_another_ending_is_refused_before_anything_is_drawn(
    nmatrix, monkeypatch, name: str, frames: str
) -> None:
    monkeypatch.setattr(PictureFrame, "draw", None)
    found = nmatrix(f"render normals {SMALL} {frames} -o {name}")
    assert found.code == 2
    assert found.is_one_line
    assert all(ending in found.err for ending in PICTURES)
    assert not list(Path().iterdir())


def test_a_picture_too_large_for_a_webp_is_refused_in_one_line() -> None:
    wide = np.zeros((1, 16384, 3), np.uint8)
    with pytest.raises(IllegalValueError, match="16384 × 1 pixels: a WebP has 16383"):
        picture_file([wide], {}, PixelFormat.WEBP)
    assert picture_file([wide[:, 1:]], {}, PixelFormat.WEBP)[8:12] == b"WEBP"


def test_a_device_may_be_called_anything(nmatrix) -> None:
    assert nmatrix(f"render normals {SMALL} -o /dev/null").code == 0


def test_two_workers_write_the_same_frames(nmatrix) -> None:
    line = f"render bias {SMALL} --frames 2"
    nmatrix(f"{line} -o one.gif")
    assert nmatrix(f"{line} -o two.gif --workers 2").code == 0
    assert Path("one.gif").read_bytes() == Path("two.gif").read_bytes()


def test_the_list_names_every_proof(nmatrix) -> None:
    found = nmatrix("render --list").out
    assert [line.split()[0] for line in found.splitlines()] == [one.name for one in PROOFS]


def test_a_preview_is_drawn_in_characters(nmatrix) -> None:
    found = nmatrix("render normals --size 320 180 --preview")
    assert max(map(len, found.out.splitlines())) <= 80
    assert ":::::" in found.out
    assert "✗ A n" in found.out


@pytest.mark.parametrize("beside", ["-f json", "-f markdown", "-o -"])
def test_a_preview_does_not_stand_within_what_a_program_reads(nmatrix, beside: str) -> None:
    found = nmatrix(f"render normals {SMALL} --preview {beside}")
    assert found.code == 2
    assert found.is_one_line
    assert "--preview" in found.err
    assert not list(Path().iterdir())


def test_a_proof_says_its_claim_first_and_nothing_that_was_not_measured(nmatrix) -> None:
    found = nmatrix(f"render normals {SMALL}").out.splitlines()
    data = nmatrix(f"render normals {SMALL} --force -f json").data
    assert found[0].startswith("Stretch a shape by A")
    assert found[3] == "With A itself the normals are up to 36.87° off, unseen ones included."
    assert found[-1] == "normals.png"
    assert not [line for line in found if "none" in line or "camera" in line]
    assert {"triangles", "fragments", "image"} <= set(data)


def test_a_picture_can_go_to_stdout(capfdbinary, tmp_path: Path) -> None:
    assert run(shlex.split(f"render normals {SMALL} -o -")) == 0
    assert capfdbinary.readouterr().out.startswith(b"\x89PNG")
    assert not list(tmp_path.iterdir())


def test_a_plan_explains_every_effect(nmatrix, scene: str) -> None:
    found = nmatrix(f"plan {scene} -f json").data
    assert {"effects", "attributes", "passes", "objects"} <= set(found)
    for row in found["effects"]:
        assert set(row) == {"name", "on", "because", "kind", "bound", "needs"}
        assert row["because"]
    on = {row["name"] for row in found["effects"] if row["on"]}
    assert {"specular", "position", "eye", "inverse-transpose", "light lamp"} <= on
    assert "fog" not in on
    assert "eye" in found["objects"][0]["uniforms"]
    text = nmatrix(f"plan {scene}").out
    assert "Left out" in text
    assert "// ---- fragment shader ----" in nmatrix(f"plan {scene} -f glsl").out


def test_the_schema_is_json(nmatrix) -> None:
    assert "$defs" in json.loads(nmatrix("plan --schema").out)


@pytest.mark.parametrize("ending", PICTURES)
def test_marks_are_drawn_in_every_kind_of_picture(nmatrix, scene: str, ending: str) -> None:
    line = f"render {scene} {SMALL} --theme dark"
    every = ",".join(Shown)
    assert nmatrix(f"{line} -o plain{ending}").code == 0
    found = nmatrix(f"{line} --show {every} -o marked{ending} -f json")
    assert found.code == 0
    plain, marked = (
        np.asarray(Image.open(f"{one}{ending}").convert("RGB")) for one in ("plain", "marked")
    )
    assert plain.shape == marked.shape
    assert (plain != marked).any()


def test_marks_ride_along_in_frames_and_processes(nmatrix, scene: str) -> None:
    line = f"render {scene} {SMALL} --show axes,normals --frames 2 --turn"
    assert nmatrix(f"{line} -o one.gif").code == 0
    assert nmatrix(f"{line} -o two.gif --workers 2").code == 0
    assert Path("one.gif").read_bytes() == Path("two.gif").read_bytes()


MISUSE = [
    ("render nothing", 2, "--list"),
    ("render no.toml", 2, "no.toml"),
    ("render --size 0 0", 2, "1 at least"),
    ("render --size 100000 100000", 2, "8192"),
    ("render --size 8192 8192 --samples 64", 2, "samples"),
    ("render --size 1.5 2", 2, "whole"),
    ("render --samples 5", 2, "1, 4, 16 or 64"),
    ("render --frames 0", 2, "--frames"),
    ("render --workers x", 2, "--workers"),
    ("render -o no/such/folder/x.png", 2, "folder"),
    ("render normals --mesh no.obj", 2, "no.obj"),
    ("render normals --scale 1e200 1 1", 3, "1e+100"),
    ("render normals --show normals", 2, "a proof has the marks that it needs"),
    ("render a.obj --show normls", 2, "did you mean normals"),
    ("render a.obj --show normals,,axes", 2, "--show ()"),
    ("render a.obj --show everything", 2, ", ".join(Shown)),
    ("plan", 2, "scene"),
]


@pytest.mark.parametrize(("line", "code", "says"), MISUSE)
def test_misuse_is_one_line(nmatrix, line: str, code: int, says: str) -> None:
    found = nmatrix(line)
    assert found.code == code
    assert found.is_one_line
    assert says in found.err
    assert not list(Path().iterdir())


def test_object_space_of_a_flat_world_has_no_answer(nmatrix) -> None:
    found = nmatrix("render normals --scale 1 0 1 --space object")
    assert found.code == 3
    assert found.is_one_line


MESHES = {
    "nan": "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
    "huge": "v 1e300 0 0\nv 0 1e300 0\nv 0 0 1e300\nf 1 2 3\n",
    "no-area": "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n",
    "one-point": "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n",
    "empty": "",
    "no-faces": "v 0 0 0\n",
    "index": "v 0 0 0\nf 1 2 3\n",
}


@pytest.mark.parametrize("name", MESHES)
def test_odd_meshes_are_drawn_or_refused_in_one_line(nmatrix, tmp_path: Path, name: str) -> None:
    (tmp_path / f"{name}.obj").write_text(MESHES[name])
    found = nmatrix(f"render {name}.obj {SMALL}")
    if found.code == 0:
        assert "nan" not in found.out.lower().replace("nan.obj", "")
    else:
        assert found.code in (2, 3)
        assert found.is_one_line
    proof = nmatrix(f"render normals --mesh {name}.obj {SMALL} -o b.png")
    assert proof.code == found.code


@pytest.mark.parametrize("eye", ["0.2 0.2 0", "0.2 0.2 1e-9", "0.2 0.2 1e150"])
def test_a_camera_inside_a_triangle_is_no_disaster(nmatrix, tmp_path: Path, eye: str) -> None:
    (tmp_path / "a.obj").write_text(TRIANGLE)
    found = nmatrix(f"render a.obj {SMALL} --eye '{eye}' --target '5 5 -1'")
    assert found.code in (0, 3)
    assert found.code == 0 or found.is_one_line


def test_a_full_disk_leaves_nothing_behind(nmatrix, monkeypatch) -> None:
    def full(*_: object, **__: object) -> None:
        raise OSError(errno.ENOSPC, "no space is left on device")

    monkeypatch.setattr(files.os, "fdopen", full)
    found = nmatrix(f"render normals {SMALL}")
    assert found.code == 2
    assert "no space is left" in found.err
    assert not list(Path().iterdir())


def test_an_interrupt_while_writing_leaves_nothing_behind(nmatrix, monkeypatch) -> None:
    def interrupted(*_: object, **__: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(files.os, "fdopen", interrupted)
    assert nmatrix(f"render normals {SMALL}").code == 130
    assert not list(Path().iterdir())


def test_a_cluster_without_its_package_names_the_command(nmatrix, monkeypatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "distributed", None)
    found = nmatrix(f"render normals {SMALL} --frames 2 --dask tcp://127.0.0.1:1")
    assert found.code == 4
    assert "pip install 'distributed>=" in found.err


FAMILY = """
[camera]
eye = [0, 0, 9]
[[object]]
name = "arm"
shape = "box"
[[object]]
name = "hand"
shape = "sphere"
parent = "arm"
translate = [2, 0, 0]
[[object]]
name = "other"
shape = "cone"
translate = [-2, 0, 0]
[[light]]
name = "lamp"
kind = "point"
fixed_to = "other"
[render]
size = [60, 60]
samples = 1
"""


def test_a_named_object_is_drawn_alone_with_what_hangs_below_it(nmatrix) -> None:
    Path("family.toml").write_text(FAMILY)
    columns = {}
    for name in ("arm", "hand"):
        found = nmatrix(f"render family.toml --object {name} -o {name}.png")
        assert found.code == 0, found.err
        drawn = np.asarray(Image.open(f"{name}.png").convert("L"))
        columns[name] = np.flatnonzero((drawn != drawn[0, 0]).any(axis=0))
    assert columns["arm"].min() > 20  # nothing is left of the box, which stands in the middle
    assert columns["hand"].min() > 30
    assert columns["hand"].max() == columns["arm"].max()
    assert "hand is drawn alone, without 2 other objects of the file." in " ".join(
        found.out.split()
    )


def test_world_options_move_the_named_object_within_its_scene(nmatrix) -> None:
    Path("family.toml").write_text(FAMILY)
    found = nmatrix("render family.toml --object hand --translate 1 0 0 -f json")
    assert (
        found.data["triangles"] == nmatrix("render family.toml -f json --force").data["triangles"]
    )
    assert "drawn alone" not in found.out


def test_an_object_that_is_not_there_is_not_drawn(nmatrix) -> None:
    Path("family.toml").write_text(FAMILY)
    found = nmatrix("render family.toml --object hnd")
    assert found.code == 2
    assert "did you mean hand?" in found.err
