"""A setup in Python answers as the command line does, in data, in every format, and in errors."""

from __future__ import annotations

import json
import pickle
from decimal import Decimal
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import nmatrix
from nmatrix.enums import PARTICULAR_FORMATS, Format

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "docs" / "scenes" / "hierarchy.toml"
BESIDE = ("command", "version", "layout", "remarks")

PARTS: dict[str, dict[str, Any]] = {
    "usual": {},
    "parts": {
        "world": {"scale": (1, 2, 1), "rotate": (10, 20, 30), "order": "ZYX"},
        "view": {"eye": (3, 2, 1), "target": (0, 1, 0), "handed": "left"},
        "lens": {"fov": 40, "aspect": 1.5, "near": 0.5, "far": 50, "handed": "left"},
        "light": {"light_direction": (0.5, -1, 0.25), "light_position": (1, 2, 3)},
    },
    "alternatives": {
        "world": {"quaternion": (1, 2, 3, 4), "translate": (5, 0, 0)},
        "view": {"eye": (3, 2, 1), "elevation": -20, "angle": 30, "roll": 5},
        "lens": {"ortho": (-2, 2, -1, 1), "near": 0, "far": 9, "api": "vulkan"},
        "light": {"light_angles": (30, 40)},
    },
    "mirrored": {
        "world": {"scale": (-1, 1, 1), "shear": (0.5, 0, 0)},
        "lens": {"frustum": (-1, 2, -1, 1), "near": 1, "depth": "reversed", "clip_y": "down"},
    },
    "across": {"world": {"scale": (2, 1, 1)}, "lens": {"fov_x": 70, "aspect": 1.5}},
    "film": {
        "world": {"scale": (2, 1, 1)},
        "lens": {"focal": 35, "sensor": (36, 24), "aspect": 0.75, "far": float("inf")},
    },
    "headset": {
        "world": {"scale": (2, 1, 1)},
        "lens": {"angles": (-50, 40, -45, 48), "api": "webgpu"},
    },
    "course": {"world": {"rotate": (30, 60, 10), "convention": "polimi"}},
}
QUESTIONS: dict[str, Any] = {
    "world": lambda setup: setup.world(),
    "view": lambda setup: setup.view(),
    "projection": lambda setup: setup.projection(),
    "normal --normal 1 2 3": lambda setup: setup.normal([(1, 2, 3)]),
    "normal --space camera --method none --normal 1 2 3": lambda setup: setup.normal(
        (1, 2, 3), space="view", method="none"
    ),
    "light": lambda setup: setup.light(),
    "light object": lambda setup: setup.light("model"),
    "eye": lambda setup: setup.eye(),
    "eye object": lambda setup: setup.eye("object"),
    "space camera": lambda setup: setup.space("camera"),
    "space object --shading gouraud --reflection toon": lambda setup: setup.space(
        "object", shading="gouraud", reflection="toon"
    ),
    "trace --pixel 100 200.5 --depth-value 0.25": lambda setup: setup.trace(
        pixel=(100, 200.5), depth_value=0.25
    ),
    "trace --pixel 7 9 --viewport 512 512": lambda setup: setup.trace(pixel=(7, 9)),
    "trace --point 1 0.5 0.25 --normal 0 1 0 --viewport 512 512": lambda setup: setup.trace(
        (1, 0.5, 0.25), normal=(0, 1, 0)
    ),
}
TAKES = {
    "world": ("world",), "view": ("view",), "projection": ("lens",), "normal": ("world", "view"),
    "light": ("world", "view", "light"), "eye": ("world", "view"),
    "space": ("world", "view", "lens", "light"), "trace": ("world", "view", "lens"),
}  # fmt: skip


def options(parts: dict[str, Any], command: str) -> str:
    """Spell the parts that a command takes as its options."""
    found: dict[str, Any] = {}
    for part in TAKES[command]:
        found |= parts.get(part, {})
    words = []
    for name, value in found.items():
        shown = " ".join(map(str, value)) if isinstance(value, tuple) else str(value)
        words.append(f"--{name.replace('_', '-')} {shown}")
    return " ".join(words)


@pytest.mark.parametrize("question", QUESTIONS)
@pytest.mark.parametrize("name", PARTS)
def test_a_setup_answers_as_the_command_line(name: str, question: str, nmatrix) -> None:
    parts, command = PARTS[name], question.split()[0]
    spelled = options(parts, command)
    if command == "normal" and "--scale" not in spelled and name == "usual":
        spelled = "--scale 1 1 1"
    code, out, err = nmatrix(f"{question} {spelled} -f json")
    report = QUESTIONS[question](setup_of({part: parts.get(part) for part in TAKES[command]}))
    assert code == 0, err
    told = json.loads(out)
    assert report.data == {key: one for key, one in told.items() if key not in BESIDE}
    assert list(report.remarks) == told["remarks"]
    assert report.command == told["command"]


def setup_of(parts: dict[str, Any]) -> nmatrix.Setup:
    return nmatrix.Setup(**parts)


def test_parts_are_mappings_values_or_matrices_alike() -> None:
    by_name = nmatrix.Setup(world={"scale": (1, 2, 1)}, light={"light_position": (1, 2, 3)})
    by_value = nmatrix.Setup(
        nmatrix.World(scale=[1, 2, 1]), light=nmatrix.Light(position=np.array([1, 2, 3]))
    )
    by_matrix = nmatrix.Setup(np.diag([1, 2, 1]), light=nmatrix.Light(position=(1, 2, 3)))
    assert by_name.light("object").data == by_value.light("object").data
    assert by_name.light("object").data == by_matrix.light("object").data


def test_an_angle_and_degrees_are_the_same_turn() -> None:
    for degrees in (30, 12.5, -170.0, 1e-3):
        turn = nmatrix.Angle.degrees(degrees)
        assert nmatrix.World(rotate_degrees=(0, turn, 0)).exact == (
            nmatrix.World(rotate_degrees=(0, degrees, 0)).exact
        )
    half = nmatrix.Setup(lens={"fov": nmatrix.Angle.radians(1.0)}).projection().data
    in_radians = nmatrix.perspective(1.0, 1.0, 0.1, 100)
    assert np.allclose(half["clip_from_camera"], in_radians, rtol=4e-16, atol=0)


def test_a_scene_gives_the_setup_that_its_options_give(nmatrix) -> None:
    import nmatrix as package

    setup = package.Setup.from_scene(SCENE, object="hand")
    for command in ("world", "view", "projection", "light object", "eye object"):
        _, out, _ = nmatrix(f"{command} --scene {SCENE} --object hand -f json")
        told = json.loads(out)
        method, *space = command.split()
        found = getattr(setup, method)(*space).data
        assert found == {key: one for key, one in told.items() if key not in BESIDE}


@pytest.mark.parametrize("format", [one for one in Format if one not in PARTICULAR_FORMATS])
def test_a_report_is_written_as_the_command_line_writes_it(format: Format, nmatrix) -> None:
    import nmatrix as package

    _, out, _ = nmatrix(f"world --scale 1 2 1 -f {format} --digits 9")
    report = package.Setup(world={"scale": (1, 2, 1)}).world()
    assert report.to(format.value, digits=9) == out


def test_a_notebook_sees_mathml_latex_and_text() -> None:
    shown = nmatrix.Setup().world()._repr_mimebundle_()
    assert set(shown) == {"text/plain", "text/html", "text/latex"}
    assert "<math" in shown["text/html"]
    assert "bmatrix" in shown["text/latex"]
    assert "\x1b" not in shown["text/plain"]


def test_a_notebook_sees_a_picture() -> None:
    picture = nmatrix.render("bias", size=(60, 40))
    assert picture._repr_png_() == picture._repr_mimebundle_()["image/png"] == picture.png
    assert picture.png.startswith(b"\x89PNG")
    assert picture.image.dtype == np.uint8
    assert picture.data["width"] == picture.image.shape[1]


def test_a_picture_of_a_file_is_the_command_lines(tmp_path: Path, nmatrix) -> None:
    import nmatrix as package

    target = tmp_path / "hierarchy.png"
    nmatrix(f"render {SCENE} --size 48 36 --shading gouraud --samples 1 -o {target}")
    picture = package.render(SCENE, size=(48, 36), shading="gouraud", samples=1)
    assert picture.png == target.read_bytes()
    picture.save(tmp_path / "again.png")
    assert (tmp_path / "again.png").read_bytes() == picture.png
    with pytest.raises(package.IllegalValueError, match="the file exists"):
        picture.save(tmp_path / "again.png")


def test_marks_are_those_of_the_command_line(tmp_path: Path, nmatrix) -> None:
    import nmatrix as package

    target = tmp_path / "hierarchy.png"
    nmatrix(f"render {SCENE} --size 48 36 --samples 1 --show axes,bounds --theme dark -o {target}")
    for words in ("axes,bounds", ["bounds", "axes"]):
        picture = package.render(SCENE, size=(48, 36), samples=1, show=words, theme="dark")
        assert picture.png == target.read_bytes()
    with pytest.raises(package.IllegalValueError, match=r"show \(axis\).*did you mean axes"):
        package.render(SCENE, show="axis")
    with pytest.raises(package.IllegalValueError, match="a proof has the marks"):
        package.render("normals", show="axes")


def test_a_proof_draws_the_setup_that_it_is_given(tmp_path: Path, nmatrix) -> None:
    import nmatrix as package

    nmatrix(f"render normals --scale 1 3 1 --size 60 40 -o {tmp_path / 'normals.png'}")
    picture = package.render("normals", package.Setup({"scale": (1, 3, 1)}), size=(60, 40))
    assert picture.png == (tmp_path / "normals.png").read_bytes()


def test_an_undefined_normal_is_told_and_the_others_are_answered() -> None:
    report = nmatrix.Setup(world={"scale": (1, 0, 1)}).normal([(0, 1, 0), (1, 0, 0)])
    assert [one["status"] for one in report.data["normals"]] == ["two-sided", "undefined"]
    assert isinstance(report.failure, nmatrix.NoAnswerError)


def test_the_calculator_knows_the_setup_and_further_names() -> None:
    setup = nmatrix.Setup(world={"scale": (1, 2, 1)})
    found = nmatrix.calc(
        "normalize(A @ linear(M) @ v)", setup, let={"A": np.eye(3), "v": (0, 1, 0)}
    )
    assert found.data["value"] == [0.0, 1.0, 0.0]
    assert nmatrix.calc("a / 3", let={"a": Fraction(1, 3)}).data["exact"] == "1/9"
    with pytest.raises(nmatrix.IllegalValueError, match="let M: the name is taken"):
        nmatrix.calc("M", let={"M": 1})


def test_a_wrong_answer_is_named_and_is_the_failure() -> None:
    setup = nmatrix.Setup(world={"scale": (1, 2, 1)})
    right = np.diag([1, 0.5, 1])
    assert nmatrix.check("normal", right, setup).failure is None
    wrong = nmatrix.check("normal", np.linalg.inv(right), setup)
    assert isinstance(wrong.failure, nmatrix.CheckFailedError)
    assert nmatrix.check("normal", "1 0 0; 0 0.5 0; 0 0 1", setup).data["verdict"] == "correct"


def test_errors_speak_of_parameters_and_the_shell_of_options(nmatrix) -> None:
    import nmatrix as package

    _, _, err = nmatrix("projection --fov 200")
    assert "try --fov 60" in err
    with pytest.raises(package.IllegalValueError, match="try fov 60"):
        package.Setup(lens={"fov": 200}).projection()
    with pytest.raises(package.IllegalValueError, match=r"^world_matrix with scale: "):
        package.Setup({"world_matrix": np.eye(4), "scale": (1, 2, 1)})


def test_a_transform_of_an_array_checks_frames_and_is_exact() -> None:
    world = nmatrix.Transform.of("world", "object", np.diag([0.1, 2, 1]))
    camera = nmatrix.Transform.of(nmatrix.Frame.CAMERA, nmatrix.Frame.WORLD, np.eye(4))
    assert (camera @ world).point((1, 1, 1)) == (0.1, 2.0, 1.0)
    assert world.exact[0][0] == Fraction(0.1)
    assert world.inverse().vector((0.1, 2, 1)) == (1.0, 1.0, 1.0)
    with pytest.raises(nmatrix.FrameError):
        world @ camera


def test_errors_of_every_kind_go_to_another_process_whole() -> None:
    calls = (
        lambda: nmatrix.calc("1/0"),
        lambda: nmatrix.calc("M.x"),
        lambda: nmatrix.Setup(lens={"fov": 200}).projection(),
    )
    for call in calls:
        with pytest.raises(nmatrix.NMatrixError) as found:
            call()
        again = pickle.loads(pickle.dumps(found.value))
        assert (type(again), str(again)) == (type(found.value), str(found.value))
        assert again.spelled(str.upper) == found.value.spelled(str.upper)


def test_fractions_are_the_nearest_floats_and_large_integers_exact_or_refused() -> None:
    given = [[Fraction(1, 3), 0, 0], [0, Decimal("0.1"), 0], [0, 0, 2**60]]
    assert nmatrix.normal_matrix(given).diagonal().tolist() == [1 / (1 / 3), 10.0, 2.0**-60]
    longer = np.eye(3, dtype=np.longdouble) / 3
    assert nmatrix.normal_matrix(longer).diagonal().tolist() == [1 / float(longer[0, 0])] * 3
    with pytest.raises(nmatrix.IllegalValueError, match="no float64 is exactly"):
        nmatrix.normal_matrix(np.diag([1, 1, 2**60 + 1]))


def test_batches_of_angles_may_mix_radians_and_angles() -> None:
    quarter = nmatrix.Angle.degrees(90)
    found = nmatrix.world(rotate=[[quarter, 0, 0], [0, 0.5, quarter]])
    for i, turns in enumerate([(quarter, 0, 0), (0, 0.5, quarter)]):
        assert (found[i] == nmatrix.world(rotate=turns)).all()


WORLD = nmatrix.World(rotate_degrees=(10, 20, 30), scale=(1, 2, 3))
EYE4 = np.eye(4)
CONTRADICTIONS: dict[str, tuple[str, Any]] = {
    "world": ("scale", lambda: nmatrix.World(matrix=EYE4, scale=2)),
    "eye": ("eye", lambda: nmatrix.View(matrix=EYE4, eye=(1, 2, 3))),
    "angles": ("angles", lambda: nmatrix.View(matrix=EYE4, angles=(10, 20))),
    "target": ("target", lambda: nmatrix.View(target=(1, 2, 3), angles=(10, 20))),
    "turns": ("rotate", lambda: nmatrix.World(quaternion=(0, 0, 0, 1), rotate_degrees=(1, 2, 3))),
    "quaternion": ("order", lambda: nmatrix.World(quaternion=(0, 0, 0, 1), order="ZYX")),
    "windows": ("frustum", lambda: nmatrix.Lens(ortho=(-1, 1, -1, 1), frustum=(-1, 1, -1, 1))),
    "window": ("ortho", lambda: nmatrix.Lens(matrix=EYE4, ortho=(-1, 1, -1, 1))),
    "light": ("light_direction", lambda: nmatrix.Light((1, 0, 0), angles_degrees=(10, 20))),
}


@pytest.mark.parametrize("case", CONTRADICTIONS)
def test_a_frozen_value_never_ignores_a_part_in_silence(case: str) -> None:
    named, make = CONTRADICTIONS[case]
    with pytest.raises(nmatrix.IllegalValueError, match=f"with {named}: .*; keep one of them"):
        make()


def test_angles_over_a_view_with_a_target_take_its_place(tmp_path: Path, nmatrix) -> None:
    """A scene's camera has a target; two angles on the command line are no contradiction."""
    scene = tmp_path / "s.toml"
    scene.write_text("[camera]\neye = [1, 2, 3]\ntarget = [4, 5, 7]\n[[object]]\nshape = 'box'\n")
    turned = nmatrix(f"view --scene {scene} --angle 30 -f json")
    plain = nmatrix("view --eye 1 2 3 --angle 30 -f json")
    assert turned.code == plain.code == 0
    keys = "camera_from_world"
    assert json.loads(turned.out)[keys] == json.loads(plain.out)[keys]


@pytest.mark.parametrize("dtype", (np.float32, np.float64, list))
@pytest.mark.parametrize("places", (2, 3, 4))
def test_a_rounded_array_claims_the_decimals_that_it_has(dtype: type, places: int) -> None:
    """As text does: the answer is right to its digits, and a digit off is wrong."""
    setup = nmatrix.Setup(world=WORLD)
    exact = np.array(setup.world().data["world_from_object"])
    given = np.round(exact, places)
    assert (given != exact).any()
    off = given.copy()
    off[1, 1] += 20 * 10.0**-places
    kept = [one.tolist() if dtype is list else one.astype(dtype) for one in (given, off)]
    verdicts = [nmatrix.check("world", one, setup).data["verdict"] for one in kept]
    assert verdicts == ["correct", "unknown"]


def test_nine_or_sixteen_numbers_are_a_square_and_row_vectors_are_told_so() -> None:
    moved = np.array(nmatrix.World(translate=(1, 2, 3)).world_from_object, float)
    assert (
        nmatrix.Setup(world=moved.ravel()).world().data == nmatrix.Setup(world=moved).world().data
    )
    with pytest.raises(nmatrix.IllegalValueError, match=r"row vectors; transpose it$"):
        nmatrix.Setup(world=moved.T)


def test_what_knows_no_frames_does_not_compose() -> None:
    world_from_object = nmatrix.Transform.of("world", "object", EYE4)
    for other in (EYE4, 5, [1, 2, 3], None):
        for product in (lambda a, b: a @ b, lambda a, b: b @ a):
            with pytest.raises(nmatrix.FrameError, match="only two transforms compose"):
                product(world_from_object, other)


def test_a_lens_and_a_view_take_words_and_numbers_for_their_values() -> None:
    assert nmatrix.Setup(lens={"api": "vulkan"}).values.lens == nmatrix.Lens(clip="vulkan")
    assert nmatrix.View(angles=(10, 20)).angles.angle == 20
    assert nmatrix.Lens(ortho=(-2, 2, -1, 1)).ortho.left == -2


def test_python_numbers_leave_the_type_to_the_arrays_beside_them() -> None:
    near = np.float32(0.5)
    angle = nmatrix.Angle.degrees(60)
    assert nmatrix.perspective(angle, 1.5, near, float("inf")).dtype == np.float32
    assert nmatrix.perspective(angle, 1.5, near, np.float64("inf")).dtype == np.float64
    moved = np.ones(3, np.float32)
    assert nmatrix.world(translate=moved, scale=2.0).dtype == np.float32
    assert nmatrix.world(translate=moved, scale=np.float64(2)).dtype == np.float64


def test_an_angle_is_shown_as_the_float_that_makes_it() -> None:
    for degrees in (30, 0.1, 1 / 3, -90, 57.29577951308232):
        angle = nmatrix.Angle.degrees(degrees)
        assert eval(repr(angle), {"Angle": nmatrix.Angle}) == angle
    with pytest.raises(nmatrix.IllegalValueError, match="from 0 to 180°"):
        nmatrix.Angle.degrees(-30).half()


def test_an_error_is_one_line_whatever_was_given() -> None:
    for name in ("a\nb", "a\r\x1b[31mb", "a\u2028b"):
        with pytest.raises(nmatrix.IllegalValueError) as caught:
            nmatrix.plan(name)
        assert len(str(caught.value).splitlines()) == 1
        assert "\x1b" not in str(caught.value)


def test_none_is_no_value_where_a_value_is_needed() -> None:
    for kind, field in (
        (nmatrix.World, "scale"),
        (nmatrix.View, "eye"),
        (nmatrix.View, "handed"),
        (nmatrix.Lens, "near"),
        (nmatrix.Lens, "clip"),
    ):
        with pytest.raises(nmatrix.IllegalValueError, match=f"^{field}"):
            kind(**{field: None})


def test_what_cannot_be_shown_is_named_by_its_type() -> None:
    deep: list[Any] = [1]
    for _ in range(3000):
        deep = [deep]
    for given in (10**5000, Decimal("1E+5000")):
        with pytest.raises(nmatrix.IllegalValueError, match="no float64 is as large"):
            nmatrix.Lens(near=given)
    for given in (deep, np.zeros(3, [("a", "f8")])):
        with pytest.raises(nmatrix.IllegalValueError, match=r"^scale"):
            nmatrix.World(scale=given)
    with pytest.raises(nmatrix.IllegalValueError, match="answer"):
        nmatrix.check("eye", np.zeros(3, [("a", "f8"), ("b", "f8")]))
    with pytest.raises(nmatrix.IllegalValueError) as caught:
        nmatrix.plan("\ud800.toml")
    str(caught.value).encode()


def test_longer_floats_are_what_they_are() -> None:
    A = np.array([0, 0, 5], np.longdouble)
    assert nmatrix.check("eye", A).data["verdict"] == "correct"
    assert nmatrix.World(translate=A).translate == (0, 0, 5)


def test_a_scene_is_pixels_and_marks_are_words(tmp_path) -> None:
    picture = nmatrix.render(SCENE, size=(48, 36), samples=1)
    with pytest.raises(nmatrix.IllegalValueError, match="only a proof is lines"):
        picture.save(tmp_path / "scene.svg")
    for none in (None, 3):
        with pytest.raises(nmatrix.IllegalValueError, match="neither text nor words"):
            nmatrix.render(SCENE, show=none)
