"""What people report about rays, calibrated cameras, fields of view and depth, one command each."""

from __future__ import annotations

from math import atan, degrees, radians, tan
from typing import Any

import numpy as np
import pytest


def found(data: Any, path: str) -> Any:
    for key in path.split("."):
        data = data[int(key)] if isinstance(data, list) else data[key]
    return data


def opencv_projection(K: tuple[float, ...], near: float, far: float) -> list[list[float]]:
    """Return the matrix that is written for K in many places, row by row."""
    fx, fy, cx, cy, w, h = K
    return [
        [2 * fx / w, 0, 1 - 2 * cx / w, 0],
        [0, 2 * fy / h, 2 * cy / h - 1, 0],
        [0, 0, -(far + near) / (far - near), -2 * far * near / (far - near)],
        [0, 0, -1, 0],
    ]


def gl_distance(depth: float, near: float, far: float) -> float:
    return 2 * near * far / (far + near - (2 * depth - 1) * (far - near))


VIVE = (-0.948912, 0.894034, -0.975546, 0.970919)  # radians: left, right, down, up
TANGENTS = tuple(map(tan, VIVE))
DEPTHAI = (
    "0.999915 -0.00947824 0.00895108 -7.47418; 0.009468 0.999954 0.00118608 -0.0847316; "
    "-0.00896192 -0.00110123 0.999959 0.106084"
)
ORTHO = "--ortho -2 2 -1 1 --near 1 --far 10 --viewport 400 200"
CORNER = "--near 0.01 --far 50 --depth-value 0.9"
THIRD = 3**-0.5

REPORTS: list[tuple[str, str, str, Any]] = [
    # rays
    ("three.js#9009", f"trace --pixel 0 0 {ORTHO}", "ray.origin_world", [-2, 1, 4]),
    ("three.js#14917", f"trace --pixel 100 30 {ORTHO}", "ray.direction_world", [0, 0, -1]),
    ("godot#83983", "trace --pixel 9 9 --near 0.5", "ray.origin_world", [0, 0, 5]),
    (
        "bevy_mod_raycast#85: a reversed near plane is z = 1",
        "trace --pixel 256 256 --depth-value 1 --depth reversed --far inf --eye 0 0 0 "
        "--target 0 0 -1",
        "point_world",
        [0, 0, -0.1],
    ),
    (
        "cglm#216: depth from 0 to 1",
        "trace --pixel 256 256 --depth-value 0.5 --depth zero-to-one --near 1 --far 3",
        "point_world",
        [0, 0, 5 - 1.5],
    ),
    (
        "UPBGE#765",
        "trace --pixel 64 64 --ortho -5 5 -5 5 --near 0.1 --viewport 256 256",
        "ray.origin_world",
        [-2.5, 2.5, 4.9],
    ),
    (
        "Vulkan-Tutorial#151: the upper left pixel",
        "trace --pixel 0 0 --api vulkan --fov 90",
        "ray.direction_world",
        [-THIRD, THIRD, -THIRD],
    ),
    (
        "pixi3d#50: an isometric ray",
        "trace --pixel 10 20 --ortho -5 5 -5 5 --eye 10 10 10 --viewport 200 200",
        "ray.direction_world",
        [-THIRD, -THIRD, -THIRD],
    ),
    # intrinsics
    (
        "NVISII#135: cx and cy are kept",
        "projection --intrinsics 450 450 325 245 --viewport 640 480",
        "intrinsics",
        [450, 450, 325, 245],
    ),
    (
        "READ#36",
        "projection --intrinsics 721.5 721.5 609.6 172.9 --viewport 1242 375",
        "clip_from_camera",
        opencv_projection((721.5, 721.5, 609.6, 172.9, 1242, 375), 0.1, 100),
    ),
    (
        "TRELLIS#302: the same with w = +z and depth from 0 to 1",
        "projection --intrinsics 1.2 1.2 0.5 0.5 --viewport 1 1 --near 1 --far 100 "
        "--depth zero-to-one --handed left",
        "clip_from_camera",
        [[2.4, 0, 0, 0], [0, 2.4, 0, 0], [0, 0, 100 / 99, -100 / 99], [0, 0, 1, 0]],
    ),
    (
        "gaussian-splatting#144: a field of view off the middle",
        "projection --intrinsics 1000 1000 500 400 --viewport 1200 800",
        "fov_x_deg",
        degrees(atan(0.5) + atan(0.7)),
    ),
    (
        "bullet3#2281: K of a projection matrix",
        'projection --projection-matrix "1.5 0 0 0; 0 2 0 0; 0 0 -1.002002 -0.2002002; 0 0 -1 0" '
        "--viewport 640 480",
        "intrinsics",
        [480, 480, 320, 240],
    ),
    (
        "Open3D#1343: 159.5 of OpenCV is 160",
        "projection --intrinsics 115 115 160 120 --viewport 320 240",
        "fov_y_deg",
        degrees(2 * atan(120 / 115)),
    ),
    (
        "nerfactor#6: a focal length of an angle",
        "projection --fov-x 39.6 --viewport 800 800",
        "intrinsics.0",
        400 / tan(radians(19.8)),
    ),
    # poses
    (
        "depthai-core#212: the inverse of (R, t)",
        f'view --extrinsics "{DEPTHAI}"',
        "eye",
        [7.4753, 0.0140025, -0.0390775],
    ),
    (
        "pyrender#123",
        'view --extrinsics "0 -1 0 1; 1 0 0 2; 0 0 1 3"',
        "world_from_camera",
        [[0, -1, 0, -2], [-1, 0, 0, 1], [0, 0, -1, -3], [0, 0, 0, 1]],
    ),
    (
        "pyrender#24: backwards",
        'view --pose "0.6 0 0.8 -0.5; 0 1 0 0; -0.8 0 0.6 0.4; 0 0 0 1"',
        "forward",
        [-0.8, 0, -0.6],
    ),
    (
        "NeuS#55: OpenGL's pose in OpenCV's axes",
        'view --pose "1 0 0 2; 0 1 0 3; 0 0 1 4" --pose-axes opengl',
        "extrinsics",
        [[1, 0, 0, -2], [0, -1, 0, 3], [0, 0, -1, 4]],
    ),
    # fields of view
    (
        "glTF-Blender-IO#2315: 39.6 across becomes 22.9",
        "projection --focal 50 --sensor 36 24 --aspect 16/9",
        "fov_y_deg",
        22.8951925,
    ),
    ("three.js#13642", "projection --fov 45 --aspect 1.5", "fov_x_deg", 63.7009),
    ("OSVR-Core#294", "projection --fov-x 95 --viewport 1920 1080", "fov_y_deg", 63.08828),
    ("yquake2#9", "projection --fov 73.739795 --aspect 16/9", "fov_x_deg", 106.26),
    (
        "assimp#1854",
        "projection --focal 35 --sensor 32 18",
        "fov_x_deg",
        2 * degrees(atan(16 / 35)),
    ),
    # headsets
    (
        "OpenXR-SDK#320: a Vive's left eye",
        f"projection --angles {' '.join(repr(degrees(one)) for one in VIVE)}",
        "clip_from_camera.0",
        [
            2 / (TANGENTS[1] - TANGENTS[0]),
            0,
            (TANGENTS[1] + TANGENTS[0]) / (TANGENTS[1] - TANGENTS[0]),
            0,
        ],
    ),
    ("raylib#5472", "projection --angles -50 45 -48 48", "fov_x_deg", 95),
    # depth
    ("mujoco-py#520", f"projection {CORNER}", "depths.0.distance", 0.01 / (1 - 0.9 * (1 - 2e-4))),
    (
        "lygia#43",
        "projection --depth-value 0.5",
        "depths.0.distance",
        gl_distance(0.5, 0.1, 100),
    ),
    (
        "pygfx#320: not OpenGL's formula",
        "projection --api webgpu --depth-value 0.5",
        "depths.0.distance",
        0.1 * 100 / (100 - 0.5 * 99.9),
    ),
    (
        "raylib#1872",
        "projection --near 0.01 --far 1000 --depth-value 0.999",
        "depths.0.distance",
        gl_distance(0.999, 0.01, 1000),
    ),
    (
        "ezquake#1136: near / depth",
        "projection --depth reversed --far inf --near 4 --depth-value 0.25",
        "depths.0.distance",
        16,
    ),
]


@pytest.mark.parametrize(("report", "line", "key", "wanted"), REPORTS, ids=[r[0] for r in REPORTS])
def test_a_reported_question_is_one_command(
    report: str, line: str, key: str, wanted: Any, nmatrix: Any
) -> None:
    answer = nmatrix(f"{line} -f json")
    assert answer.code == 0, (report, answer.err)
    told = np.array(found(answer.data, key), dtype=float)
    # Some reports give their numbers to five or six digits.
    assert told.shape == np.shape(wanted)
    assert np.allclose(told, wanted, rtol=1e-4 if np.ndim(wanted) == 0 else 1e-5, atol=1e-7)


def test_babylon_11744_a_pixel_at_the_depth_of_infinity_shows_no_point(nmatrix: Any) -> None:
    answer = nmatrix("trace --pixel 5 5 --depth-value 1 --far inf")
    assert (answer.code, answer.out) == (3, "")
    assert "infinitely far away" in answer.err


@pytest.mark.parametrize("shape", ["", "--fov-x 80", "--angles -40 30 -20 50", "--ortho -1 1 -1 1"])
@pytest.mark.parametrize(
    "clip", ["", "--api vulkan", "--api direct3d", "--depth reversed", "--far inf"]
)
def test_depth_and_distance_are_those_of_a_point_ahead_for_every_lens(
    shape: str, clip: str, nmatrix: Any
) -> None:
    if "ortho" in shape and "inf" in clip:
        return
    lens = f"{shape} {clip} --near 0.5"
    data = nmatrix(f"projection {lens} --at 0.5 2 7 -f json").data
    for pair in data["depths"]:
        z = 5 - pair["distance"]
        seen = nmatrix(f"trace --point 0 0 {z} {lens} -f json").data
        assert seen["window"][2] == pytest.approx(pair["depth"], abs=1e-15)
        back = nmatrix(f"projection {lens} --depth-value {pair['depth']!r} -f json").data
        assert back["depths"][0]["distance"] == pytest.approx(pair["distance"], rel=1e-12)
    line = nmatrix(f"projection {lens} -f glsl").out.strip().splitlines()[-1]
    body = line.partition("return ")[2].removesuffix("; }")
    for pair in data["depths"]:
        computed = eval(body, {}, {"depth": pair["depth"]})  # GLSL's sums are Python's
        assert computed == pytest.approx(pair["distance"], rel=1e-9)
