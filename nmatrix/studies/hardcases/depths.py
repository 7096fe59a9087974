"""Fields of view, near and far planes, and the gaps that depth can resolve."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from math import inf, pi, radians, tan
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import DepthRange
from nmatrix.linear.affine import translation_matrix
from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, ClipSpace, perspective
from nmatrix.linear.rational import RationalMatrix, to_floats
from nmatrix.raster.triangles.visibility import TRIANGLE_MASK
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.words import DepthBuffer
from nmatrix.scene.world import World
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own
from nmatrix.studies.hardcases.coverage import rasterized

Array = NDArray[Any]
NEAR = 0.1
ZERO_TO_ONE = ClipSpace(depth=DepthRange.ZERO_TO_ONE)
REVERSED = ClipSpace(depth=DepthRange.REVERSED)


def _no_field(id_: str, fov: float, reason: str) -> Case:
    half = Angle.degrees(Fraction(fov) / 2)
    return Case(
        id_,
        f"a field of view of {fov:g}°",
        f"fov {fov:g}",
        None,
        reason,
        (
            own("perspective", lambda: to_floats(perspective(half, 1.0, NEAR, 100.0))[0]),
            Contestant("1 / tan(fov/2)", lambda: [1 / tan(radians(fov) / 2)]),
        ),
    )


def _wide_field() -> Case:
    """Take the last float64 before 180°: 90° − x is rounded, and only x counts."""
    fov = 179.99999999999997
    left = (180 - Fraction(fov)) / 2 * Fraction(pi) / 180  # 1/tan(90° − x) = tan x ≈ x + x³/3
    true = left + left**3 / 3
    half = Angle.degrees(Fraction(fov) / 2)
    return Case(
        "D2",
        "the widest field of view there is",
        f"fov {fov!r}",
        (true,),
        "π/2 − x is rounded before its tangent is taken, and x is what counts",
        (
            own("perspective", lambda: to_floats(perspective(half, 1.0, NEAR, 100.0))[1][1:2]),
            Contestant("1 / tan(fov/2)", lambda: [1 / tan(radians(fov) / 2)]),
        ),
    )


def _depth_row(
    id_: str,
    title: str,
    planes: tuple[float, float],
    true: tuple[Fraction, ...] | None,
    reason: str,
    kind: Callable[[float], Any] = np.float64,
) -> Case:
    near, far = planes

    def ours() -> tuple[float, ...]:
        return to_floats(perspective(Angle.degrees(30), 1.0, near, far))[2][2:]

    def naive() -> list[float]:
        n, f = kind(near), kind(far)
        return [float((f + n) / (n - f)), float(2 * f * n / (n - f))]

    return Case(
        id_,
        title,
        f"near {near!r}, far {far!r}",
        true,
        reason,
        (
            own("perspective", ours),
            Contestant(f"(f+n)/(n−f), {kind.__name__}", naive),
        ),
    )


def _nearer_wins(distance: float, gap: float, clip: ClipSpace, buffer: DepthBuffer) -> list[float]:
    """Draw a far and then a near wall; 1 if the near one is seen everywhere, else 0."""
    walls = [distance * (1 + gap), distance]
    corners = [[x * z, y * z, -z] for z in walls for x, y in ((-3, -3), (3, -3), (0, 4))]
    matrix = np.array(to_floats(perspective(Angle.degrees(45), 1.0, NEAR, 1e5, clip)))
    keys = rasterized(np.array(corners), matrix, 8, clip, buffer)
    return [float((keys & TRIANGLE_MASK == 1).all())]


def _told_apart(id_: str, distance: float, gap: float) -> Case:
    def seen(clip: ClipSpace, buffer: DepthBuffer) -> Callable[[], list[float]]:
        return lambda: _nearer_wins(distance, gap, clip, buffer)

    return Case(
        id_,
        f"two walls {gap:g} apart at {distance:g}",
        f"near {NEAR}, far 1e5; the near wall is drawn last: is it seen?",
        exactly(1),
        "reversed depth has its fine steps where perspective needs them",
        (
            own("reversed float32", seen(REVERSED, DepthBuffer.FLOAT32)),
            Contestant("−1…1, float32", seen(DEFAULT_CLIP_SPACE, DepthBuffer.FLOAT32)),
            Contestant("0…1, 24 bits", seen(ZERO_TO_ONE, DepthBuffer.UNORM24)),
        ),
    )


def _concatenated() -> Case:
    """P·V·M of an object and a camera that are both far away, in float32 and rounded once."""
    far = 2.0**20
    place = World((far, 1, -far), rotate_degrees=(20, 30, 40))
    view = View(matrix=translation_matrix((-far, 0, far - 5)))
    maps = Setup(place, view, Lens(near=NEAR, far=inf)).maps
    matrices = (maps.world_from_object.exact, maps.camera_from_world.exact, maps.clip_from_camera)
    point = (0.25, 0.5, -0.125)

    def by(matrix: Array) -> list[float]:
        clip = matrix @ np.array([*point, 1.0], matrix.dtype)
        return [float(x) for x in clip[:3] / clip[3]]

    def float32() -> list[float]:
        M, V, P = (np.array(to_floats(one), np.float32) for one in matrices)
        return by(P @ V @ M)

    return Case(
        "D8",
        "one matrix for everything, far from the origin",
        f"object and eye at {far:g}, one vertex to normalised coordinates",
        _one_after_the_other(matrices, point),
        "the two translations cancel, if they were not rounded before",
        (
            own("exact product", lambda: by(np.array(to_floats(maps.clip_from_object)))),
            Contestant("float32 product", float32),
        ),
    )


def _one_after_the_other(
    matrices: tuple[RationalMatrix, ...], point: tuple[float, ...]
) -> tuple[Fraction, ...]:
    v = [*map(Fraction, point), Fraction(1)]
    for A in matrices:
        v = [sum((a * x for a, x in zip(row, v, strict=True)), Fraction(0)) for row in A]
    return tuple(x / v[3] for x in v[:3])


TINY_RANGE = (1.0, 1.0 + 2.0**-52)
LIMIT = "the limit exists, the quotient does not"

CASES: tuple[Case, ...] = (
    _no_field("D1", 180.0, "the picture would be infinitely wide"),
    _no_field("D1b", 180.1, "a negative focal length mirrors the picture without a word"),
    _wide_field(),
    _depth_row("D3", "near = far", (NEAR, NEAR), None, "there is no depth between them"),
    _depth_row("D4", "far = inf", (NEAR, inf), exactly(-1, -2 * Fraction(NEAR)), LIMIT),
    _depth_row(
        "D5",
        "the smallest range of depth there is",
        TINY_RANGE,
        exactly(-(2**53 + 1), -(2**53 + 2)),
        "f − n is exact in float64; float32 cannot tell the two planes apart",
        np.float32,
    ),
    _told_apart("D6", 9e4, 1e-6),
    _told_apart("D7", 1e3, 1e-6),
    _concatenated(),
)
