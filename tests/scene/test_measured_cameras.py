"""Cameras as others measure them, against the formulas that those others document."""

from __future__ import annotations

import json
from dataclasses import fields
from fractions import Fraction
from math import atan, atan2, degrees, inf, radians, tan
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import nmatrix
from nmatrix.answers.trace import trace
from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.enums import API_PRESETS, Api, CameraAxes, ClipY, DepthRange, Handedness
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import to_floats
from nmatrix.linear.viewport import Viewport
from nmatrix.scene.given import lens_of, view_of
from nmatrix.scene.setup import Setup
from nmatrix.scene.toml.file import read_scene
from nmatrix.scene.toml.records import CameraRecord

halves = st.integers(-20, 20).map(lambda n: n / 2)
CLIPS = [
    *(ClipSpace(*preset) for preset in API_PRESETS.values()),
    *(ClipSpace(depth, hand, y) for depth in DepthRange for hand in Handedness for y in ClipY),
]


def rotation(a: int, b: int, c: int, d: int) -> tuple[tuple[Fraction, ...], ...]:
    """Return an exact rotation, by Euler's and Rodrigues' parameters."""
    n = Fraction(a * a + b * b + c * c + d * d)
    return (
        ((a*a + b*b - c*c - d*d) / n, 2 * (b*c - a*d) / n, 2 * (b*d + a*c) / n),
        (2 * (b*c + a*d) / n, (a*a - b*b + c*c - d*d) / n, 2 * (c*d - a*b) / n),
        (2 * (b*d - a*c) / n, 2 * (c*d + a*b) / n, (a*a - b*b - c*c + d*d) / n),
    )  # fmt: skip


quarters = st.tuples(*(st.integers(-3, 3),) * 4).filter(any).map(lambda q: rotation(*q))
places = st.tuples(halves, halves, halves)


def projected(given: dict[str, Any]) -> Any:
    return np.array(nmatrix.Setup(lens=given).projection().data["clip_from_camera"])


# ---- OpenCV and COLMAP ----


@settings(max_examples=200, deadline=None)
@given(
    quarters, places, places, st.sampled_from(CLIPS),
    st.tuples(st.integers(100, 900), st.integers(100, 900), st.integers(0, 640), halves),
)  # fmt: skip
def test_colmap_s_camera_shows_a_point_where_colmap_has_it(
    R: Any, t: Any, point: Any, clip: ClipSpace, K: Any
) -> None:
    # Oracle: x_camera = R X + t; pixel = (fx x/z + cx, fy y/z + cy), from the corner of the image.
    assume(clip.handed is Handedness.RIGHT)
    fx, fy, cx, cy = K
    x, y, z = (
        sum(a * Fraction(b) for a, b in zip(row, point, strict=True)) + Fraction(move)
        for row, move in zip(R, t, strict=True)
    )
    assume(z > 0)
    extrinsics = [[*row, Fraction(move)] for row, move in zip(R, t, strict=True)]
    parts = {"depth": clip.depth, "clip_y": clip.clip_y}
    lens = lens_of({"intrinsics": K, "viewport": (640, 480), **parts})
    setup = Setup(view=view_of({"extrinsics": extrinsics}), lens=lens)
    found = trace(setup, point, None, Viewport(640, 480)).data
    assert found["pixel"] == (fx * x / z + cx, fy * y / z + Fraction(cy))
    assert found["inside"] in (True, False)


def test_opencv_s_principal_point_is_half_a_pixel_less() -> None:
    # cv::projectPoints counts from the middle of the first pixel: a point on the axis of a camera
    # with cx = 319.5 is in the middle of 640 columns, which is 320 from the corner.
    report = nmatrix.Setup(
        lens={"intrinsics": (500, 500, 319.5 + 0.5, 239.5 + 0.5), "viewport": (640, 480)},
        view={"extrinsics": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0]]},
    ).trace((0, 0, 2))
    assert report.data["pixel"] == [320, 240]
    assert any("add 0.5" in one for one in report.remarks)


@pytest.mark.parametrize("K", [(500, 520, 300, 200), (1000, 900, 640, 360), (50, 60, 0, 479)])
def test_fields_of_view_are_those_of_calibration_matrix_values(K: Any) -> None:
    # cv::calibrationMatrixValues: fovx = atan2(cx, fx) + atan2(w - cx, fx), and so for y.
    fx, fy, cx, cy = K
    data = nmatrix.Setup(lens={"intrinsics": K, "viewport": (640, 480)}).projection().data
    assert data["fov_x_deg"] == pytest.approx(degrees(atan2(cx, fx) + atan2(640 - cx, fx)))
    assert data["fov_y_deg"] == pytest.approx(degrees(atan2(cy, fy) + atan2(480 - cy, fy)))
    assert data["intrinsics"] == list(K)


def test_the_projection_of_intrinsics_is_the_one_that_pyrender_documents() -> None:
    # pyrender.IntrinsicsCamera.get_projection_matrix, from its source's formula.
    fx, fy, cx, cy, w, h, n, f = 500, 480, 300, 200, 640, 480, 0.05, 100.0
    wanted = [
        [2 * fx / w, 0, 1 - 2 * cx / w, 0],
        [0, 2 * fy / h, 2 * cy / h - 1, 0],
        [0, 0, (f + n) / (n - f), 2 * f * n / (n - f)],
        [0, 0, -1, 0],
    ]
    lens = {"intrinsics": (fx, fy, cx, cy), "viewport": (w, h), "near": n, "far": f}
    assert np.allclose(projected(lens), wanted, rtol=1e-15, atol=1e-16)


@settings(deadline=None)
@given(quarters, places, st.sampled_from(CameraAxes))
def test_a_pose_and_the_extrinsics_that_undo_it_are_one_camera(
    R: Any, t: Any, axes: CameraAxes
) -> None:
    pose = [[*row, Fraction(move)] for row, move in zip(R, t, strict=True)]
    by_pose = Setup(view=view_of({"pose": pose, "pose_axes": axes})).camera
    flip = 1 if axes is CameraAxes.OPENCV else -1  # R of OpenCV's camera: columns y and z turn
    turned = [[row[0], flip * row[1], flip * row[2]] for row in R]
    back = [[turned[j][i] for j in range(3)] for i in range(3)]
    moved = [-sum(a * Fraction(b) for a, b in zip(row, t, strict=True)) for row in back]
    extrinsics = [[*row, move] for row, move in zip(back, moved, strict=True)]
    assert by_pose == Setup(view=view_of({"extrinsics": extrinsics})).camera
    assert by_pose.eye == tuple(map(Fraction, t))


@pytest.mark.parametrize("axes", CameraAxes)
def test_view_tells_pose_and_extrinsics_that_make_it_again(axes: CameraAxes) -> None:
    given = {"eye": (3, 1, 2), "target": (0, 1, -1)}
    told = nmatrix.Setup(view=given).view().data
    again = nmatrix.Setup(view={"extrinsics": told["extrinsics"]}).view().data
    assert np.allclose(again["camera_from_world"], told["camera_from_world"], atol=0, rtol=0)
    pose = np.array(told["world_from_camera"])
    if axes is CameraAxes.OPENCV:
        pose = pose @ np.diag([1, -1, -1, 1])
    posed = nmatrix.Setup(view={"pose": pose, "pose_axes": axes}).view().data
    assert np.allclose(posed["camera_from_world"], told["camera_from_world"], atol=4e-16)
    assert posed["eye"] == [3, 1, 2]
    assert np.allclose(posed["extrinsics"], told["extrinsics"], atol=4e-16)


# ---- NeRF ----


@pytest.mark.parametrize("pixel", [(0, 0), (400, 400), (799, 13.5)])
def test_nerf_s_rays_are_those_of_transforms_json(pixel: tuple[float, float]) -> None:
    # run_nerf_helpers.get_rays: focal = W/2 / tan(camera_angle_x/2), rays_o = c2w[:3, 3],
    # dirs = ((i - W/2)/focal, -(j - H/2)/focal, -1), rays_d = c2w[:3, :3] @ dirs.
    angle, W, H = 0.6911112070083618, 800, 800  # the lego scene's camera_angle_x
    c2w = np.array([
        [-0.9999021887779236, 0.004192245192825794, -0.013345719315111637, -0.05379832163453102],
        [-0.013988681137561798, -0.2996590733528137, 0.95394366979599, 3.845470428466797],
        [-4.656612873077393e-10, 0.9540371894836426, 0.29968830943107605, 1.2080823183059692],
        [0, 0, 0, 1],
    ])  # fmt: skip
    i, j = pixel
    focal = W / 2 / tan(angle / 2)
    wanted = c2w[:3, :3] @ [(i - W / 2) / focal, -(j - H / 2) / focal, -1]
    setup = nmatrix.Setup(
        view={"pose": c2w}, lens={"fov_x": nmatrix.Angle.radians(angle), "viewport": (W, H)}
    )
    ray = setup.trace(pixel=pixel).data["ray"]
    assert ray["origin_world"] == c2w[:3, 3].tolist()
    assert np.allclose(
        ray["direction_world"], wanted / np.linalg.norm(wanted), atol=3e-16, rtol=1e-14
    )


# ---- sensors: Blender, three.js, glTF ----


@pytest.mark.parametrize("focal", [18, 35, 50, 85.5])
@pytest.mark.parametrize("size", [(1920, 1080), (1080, 1920), (512, 512), (4096, 1)])
def test_blender_s_auto_fit_lays_one_number_along_the_longer_side(
    focal: float, size: tuple[int, int]
) -> None:
    # BKE_camera_params_compute_viewplane: with AUTO the sensor's x is laid along the longer side.
    width, height = size
    seen = 36 / 2 / focal / max(width, height)  # the tangent of one pixel, from the middle
    wanted = np.diag([1 / (seen * width), 1 / (seen * height)])
    lens = {"focal": focal, "sensor": (36, 36), "viewport": size}
    assert np.allclose(projected(lens)[:2, :2], wanted, rtol=1e-14, atol=0)


@pytest.mark.parametrize("aspect", [2, 16 / 9, 1, 0.5])
def test_three_js_s_film_gauge_is_a_square_sensor(aspect: float) -> None:
    # PerspectiveCamera.setFocalLength: fov = 2 atan(filmHeight/2 / f), where filmHeight is
    # 35/max(aspect, 1).
    wanted = degrees(2 * atan(35 / max(aspect, 1) / 2 / 50))
    found = nmatrix.Setup(lens={"focal": 50, "sensor": (35, 35), "aspect": aspect}).projection()
    assert found.data["fov_y_deg"] == pytest.approx(wanted, rel=1e-14)


def test_the_sensor_has_its_own_aspect_until_another_is_said() -> None:
    own = nmatrix.Setup(lens={"focal": 50, "sensor": (36, 24)}).projection()
    assert own.data["aspect"] == 1.5
    assert own.data["fov_x_deg"] == pytest.approx(degrees(2 * atan(18 / 50)))
    assert own.data["fov_y_deg"] == pytest.approx(degrees(2 * atan(12 / 50)))
    assert not any("sensor" in one for one in own.remarks)
    same = nmatrix.Setup(lens={"focal": 50, "sensor": (16, 9), "aspect": 16 / 9}).projection()
    assert not any("sensor" in one for one in same.remarks)
    wide = nmatrix.Setup(lens={"focal": 50, "sensor": (36, 24), "aspect": 2}).projection()
    assert wide.data["fov_x_deg"] == own.data["fov_x_deg"]
    assert wide.data["fov_y_deg"] == pytest.approx(degrees(2 * atan(9 / 50)))
    assert "width lies across" in wide.remarks[0]
    tall = nmatrix.Setup(lens={"focal": 50, "sensor": (36, 24), "aspect": 0.5}).projection()
    assert tall.data["fov_y_deg"] == own.data["fov_y_deg"]
    assert tall.data["fov_x_deg"] == pytest.approx(degrees(2 * atan(6 / 50)))
    assert "height lies along" in tall.remarks[0]


@settings(deadline=None)
@given(st.floats(1, 179), st.floats(0.1, 10))
def test_a_horizontal_field_is_the_vertical_one_over_the_aspect(fov: float, aspect: float) -> None:
    data = nmatrix.Setup(lens={"fov_x": fov, "aspect": aspect}).projection().data
    assert data["fov_x_deg"] == pytest.approx(fov, rel=1e-14)
    # Unity's Camera.HorizontalToVerticalFieldOfView
    vertical = degrees(2 * atan(tan(radians(fov) / 2) / aspect))
    assert data["fov_y_deg"] == pytest.approx(vertical, rel=1e-12)


# ---- OpenXR ----


def openxr(angles: tuple[float, ...], near: float, far: float, api: Api) -> Any:
    """Compute XrMatrix4x4f_CreateProjectionFov of the OpenXR SDK's xr_linear.h, row by row."""
    left, right, up, down = (tan(radians(one)) for one in angles)
    width, height = right - left, (down - up if api is Api.VULKAN else up - down)
    offset = near if api is Api.OPENGL else 0
    depth = (-1, -(near + offset))
    if far > near and far != inf:
        depth = (-(far + offset) / (far - near), -(far * (near + offset)) / (far - near))
    return np.array([
        [2 / width, 0, (right + left) / width, 0],
        [0, 2 / height, (up + down) / height, 0],
        [0, 0, *depth],
        [0, 0, -1, 0],
    ])  # fmt: skip


@pytest.mark.parametrize("far", [100.0, inf])
@pytest.mark.parametrize("api", [Api.OPENGL, Api.VULKAN, Api.METAL, Api.WEBGPU])
@pytest.mark.parametrize("sides", [(-45, 45, 45, -45), (-52.5, 40.25, 43, -54), (5, 60, -1, -30)])
def test_four_angles_are_openxr_s_field_of_view(sides: Any, api: Api, far: float) -> None:
    left, right, up, down = sides
    found = projected({"angles": (left, right, down, up), "near": 0.05, "far": far, "api": api})
    wanted = openxr(sides, 0.05, far, api)
    assert np.allclose(found, wanted, rtol=1e-13, atol=1e-15)


def test_openxr_s_own_order_is_told_when_it_turns_the_picture() -> None:
    found = nmatrix.Setup(lens={"angles": (-50, 40, 45, -45)}).projection()
    assert "upside down" in found.remarks[0]
    assert found.data["fov_y_deg"] is None
    mirrored = nmatrix.Setup(lens={"angles": (50, -40, -45, 45)}).projection()
    assert "mirrors" in mirrored.remarks[0]
    assert nmatrix.Setup(lens={"angles": (-50, 40, -45, 45)}).projection().remarks[:1] != (
        mirrored.remarks[0],
    )


# ---- what is kept, what is replaced, what is refused ----


def test_another_near_plane_changes_no_direction_of_a_measured_lens() -> None:
    for shape in (
        {"intrinsics": (500, 500, 300, 250), "viewport": (640, 480)},
        {"angles": (-40, 30, -20, 50)},
        {"focal": 50, "sensor": (36, 24)},
        {"fov_x": 80},
    ):
        first = lens_of(shape)
        assert to_floats(lens_of({"near": 3}, first).exact)[:2] == to_floats(first.exact)[:2]


def test_each_way_to_shape_a_view_takes_the_place_of_another_in_the_base() -> None:
    ways: list[dict[str, Any]] = [
        {"fov": 50}, {"fov_x": 50}, {"focal": 50, "sensor": (36, 24)},
        {"intrinsics": (5, 5, 3, 2), "viewport": (6, 4)}, {"angles": (-40, 30, -20, 50)},
        {"ortho": (-1, 1, -1, 1)}, {"frustum": (-1, 1, -1, 1)},
    ]  # fmt: skip
    for first in ways:
        for second in ways:
            over = lens_of(second, lens_of(first))
            plain = lens_of({**second, "viewport": (6, 4)} if over.viewport else second)
            assert over.exact == plain.exact, (first, second)
            if first != second:
                with pytest.raises(IllegalValueError, match="both shape the view"):
                    lens_of({**first, **second})


def test_a_lens_s_own_numbers_change_one_by_one() -> None:
    film = lens_of({"focal": 50, "sensor": (36, 24)})
    assert lens_of({"focal": 25}, film).exact == lens_of({"focal": 25, "sensor": (36, 24)}).exact
    assert lens_of({"sensor": (8, 8)}, film).exact == lens_of({"focal": 50, "sensor": (8, 8)}).exact
    posed = view_of({"pose": np.eye(4)})
    assert view_of({"pose_axes": "opencv"}, posed) == view_of(
        {"pose": np.eye(4), "pose_axes": "opencv"}
    )
    assert view_of({"eye": (1, 2, 3)}, posed).measured is None


WHOLE_MATRICES = {"view_matrix", "projection_matrix"}  # which a file says by parts


def test_every_option_of_view_and_lens_has_its_name_in_files_and_in_python() -> None:
    names = {one.name for group in (ViewOptions, LensOptions) for one in fields(group)}
    assert names - WHOLE_MATRICES == set(CameraRecord.__struct_fields__)
    for read, group in ((view_of, ViewOptions), (lens_of, LensOptions)):
        read(dict.fromkeys(one.name for one in fields(group)))


CAMERAS = [
    {"fov_x": 70},
    {"focal": 50, "sensor": [36, 24]},
    {"intrinsics": [500, 510, 300, 200], "viewport": [600, 400]},
    {"angles": [-40, 30, -20, 50], "near": 0.5},
    {"extrinsics": [[0, 0, 1, 2], [1, 0, 0, 3], [0, 1, 0, 4]]},
    {"pose": [[0, 0, 1, 2], [1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 0, 1]], "pose_axes": "opencv"},
]


def toml(camera: dict[str, Any], size: tuple[int, int] = (600, 400)) -> str:
    keys = "\n".join(f"{name} = {json.dumps(value)}" for name, value in camera.items())
    return f'[[object]]\nshape = "box"\n[render]\nsize = {list(size)}\n[camera]\n{keys}\n'


def option_words(camera: dict[str, Any]) -> str:
    words = []
    for name, value in camera.items():
        rows = value if isinstance(value, list) else [value]
        text = "; ".join(" ".join(map(str, r)) if isinstance(r, list) else str(r) for r in rows)
        shown = f"'{text}'" if ";" in text and isinstance(rows[0], list) else text.replace(";", "")
        words.append(f"--{name.replace('_', '-')} {shown}")
    return " ".join(words)


@pytest.mark.parametrize("camera", CAMERAS, ids=lambda one: next(iter(one)))
def test_a_scene_file_says_what_the_options_say(camera: Any, nmatrix: Any, tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(toml(camera))
    words = option_words(camera)
    seen = words if "viewport" in camera else f"{words} --viewport 600 400"
    pixel = "--pixel 12 34 --depth-value 0.5"
    by_file = nmatrix(f"trace --scene {file} {pixel} -f json")
    by_words = nmatrix(f"trace {seen} {pixel} -f json")
    assert by_file.code == by_words.code == 0, by_file.err + by_words.err
    ours, theirs = by_file.data, by_words.data
    for key in ("origin_world", "direction_world"):
        assert ours["ray"][key] == pytest.approx(theirs["ray"][key], rel=1e-15)
    assert ours["point_world"] == pytest.approx(theirs["point_world"], rel=1e-14)
    assert ours["window"] == theirs["window"]


@pytest.mark.parametrize(
    ("camera", "words"),
    [
        ({"fov_x": 70, "fov": 50}, "fov_x with fov"),
        ({"focal": 50}, "sensor"),
        ({"intrinsics": [1, 2, 3, 4], "aspect": 2}, "intrinsics with aspect"),
        ({"pose_axes": "opencv"}, "add pose"),
        ({"pose_axes": "maya", "pose": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "opengl"),
        ({"extrinsics": [[1, 0], [0, 1]]}, "three rows"),
        ({"extrinsics": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "eye": [1, 2, 3]}, "with eye"),
        ({"pose": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "handed": "left"}, "left"),
        ({"pose": [[1, 0, 0], [0, 1, 0], [0, 0, 0]]}, "determinant 0"),
        ({"angles": [-95, 1, 2, 3]}, "left -95"),
        ({"viewport": [0, 5]}, "whole pixels"),
        ({"intrinsics": [1, -2, 3, 4]}, "above 0"),
    ],
)  # fmt: skip
def test_a_scene_file_s_contradictions_name_the_file_and_the_key(
    camera: Any, words: str, nmatrix: Any, tmp_path: Path
) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(toml(camera))
    found = nmatrix(f"projection --scene {file}")
    assert found.code == 2
    assert "scene.toml, [camera]" in found.err
    assert words in found.err


def test_a_scene_s_intrinsics_are_pixels_of_its_picture_at_any_size(tmp_path: Path) -> None:
    file = tmp_path / "scene.toml"
    file.write_text(toml({"intrinsics": [500, 510, 300, 200]}))
    scene = read_scene(file)
    assert scene.lens.viewport == Viewport(600, 400)
    assert scene.sized(60, 40).lens.exact == scene.lens.exact


@pytest.mark.parametrize(
    ("line", "code", "words"),
    [
        ("projection --intrinsics 500 500 320 240", 2, "add --viewport"),
        ("projection --intrinsics 500 0 320 240 --viewport 640 480", 2, "above 0"),
        ("projection --intrinsics 5 5 3 2 --viewport 6 4 --aspect 2", 2, "--aspect"),
        ("projection --angles -40 40 -40 40 --aspect 2", 2, "--angles with --aspect"),
        ("projection --focal 50", 2, "add --sensor"),
        ("projection --sensor 36 24", 2, "add --focal"),
        ("projection --focal 0 --sensor 36 24", 2, "--focal (0)"),
        ("projection --focal 50 --sensor 36 -24", 2, "--sensor (36 -24)"),
        ("projection --fov-x 180", 2, "--fov-x (180)"),
        ("projection --fov-x 50 --fov 50", 2, "--fov-x with --fov"),
        ("projection --angles -90 40 -40 40", 2, "left -90"),
        ("projection --angles 40 40 -40 40", 3, "no extent"),
        ("projection --fov-x 9 --projection-matrix '1 0 0 0; 0 1 0 0; 0 0 1 0; 0 0 1 0'", 2, "x"),
        ("view --extrinsics '1 0 0 0; 0 1 0 0; 0 0 0 0'", 3, "determinant 0"),
        ("view --extrinsics '1 0 0 0; 0 1 0 0; 0 0 1 0' --eye 1 2 3", 2, "with --eye"),
        ("view --extrinsics '1 0 0 0; 0 1 0 0; 0 0 1 0' --handed left", 2, "--handed left"),
        ("view --pose '1 0 0 0; 0 1 0 0; 0 0 1 0' --handed left", 2, "--pose with --handed left"),
        ("trace --pose '1 0 0 0; 0 1 0 0; 0 0 1 0' --api direct3d", 2, "--api direct3d"),
        ("view --pose-axes opencv", 2, "add --pose"),
        ("view --pose '1 0; 0 1'", 2, "2 × 2"),
        ("trace --pixel 1 2 --point 1 2 3", 2, "--pixel with --point"),
        ("trace --pixel 1 2 --normal 1 2 3", 2, "--pixel with --normal"),
        ("trace --depth-value 0.5", 2, "add --pixel"),
        ("trace --pixel 1 2 --depth-value 1.5", 2, "0 to 1"),
        ("trace --pixel 1 2 --depth-value 1 --far inf", 3, "infinitely far"),
        ("trace --pixel 1 2 --viewport 0 5", 2, "whole pixels"),
    ],
)  # fmt: skip
def test_contradictions_and_illegal_values_are_one_clear_line(
    nmatrix: Any, line: str, code: int, words: str
) -> None:
    found = nmatrix(line)
    assert found.code == code
    assert words in found.err
    assert found.err.count("\n") == 1


def test_a_block_that_is_no_rotation_is_told_to_the_digits_given() -> None:
    def remarks(block: str, name: str) -> str:
        rows = "; ".join(f"{row} 1" for row in block.split("; "))
        return " ".join(nmatrix.Setup(view={name: rows}).view().remarks)

    for name in ("extrinsics", "pose"):
        assert "A camera only moves and turns" not in remarks(
            "0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1", name
        )
        assert "also stretches" in remarks("0.70811 -0.70711 0; 0.70711 0.70711 0; 0 0 1", name)
        assert "also stretches" in remarks("2 0 0; 0 2 0; 0 0 2", name)
        assert "also mirrors" in remarks("1 0 0; 0 1 0; 0 0 -1", name)


def test_a_singular_pose_is_no_camera() -> None:
    with pytest.raises(NoAnswerError, match="pose"):
        nmatrix.Setup(view={"pose": np.diag([1, 1, 0, 1])})
