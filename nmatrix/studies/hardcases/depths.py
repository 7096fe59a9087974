"""D1 to D7: fields of view, near and far, and what depth can tell apart."""

from __future__ import annotations

from fractions import Fraction
from math import pi, tan

import numpy as np

from nmatrix.enums import DepthBuffer
from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE, perspective
from nmatrix.raster.visibility import depth_code
from nmatrix.studies.hardcases.case import Case, Contestant, exactly, own

Vector = tuple[float, float, float]

UPRIGHT: Vector = (0.0, 1.0, 0.0)
EASY: Vector = (3.0, 4.0, 12.0)


def _field_case() -> Case:
    half = Angle.degrees(90)
    return Case(
        "D1",
        "a field of view of 180°",
        "fov 180",
        None,
        "the picture would be infinitely wide",
        (
            own("perspective", lambda: perspective(half, 1.0, 0.1, 100.0, DEFAULT_CLIP_SPACE)[0]),
            Contestant("1 / tan(fov/2)", lambda: [1 / tan(pi / 2)]),
        ),
    )


def _depth_row(
    id_: str, title: str, far: float, true: tuple[Fraction, ...] | None, reason: str
) -> Case:
    near = 0.1

    def naive() -> list[float]:
        n, f = np.float64(near), np.float64(far)
        return [float((f + n) / (n - f)), float(2 * f * n / (n - f))]

    return Case(
        id_,
        title,
        f"near {near}, far {far:g}",
        true,
        reason,
        (
            own(
                "perspective",
                lambda: perspective(Angle.degrees(30), 1.0, near, far, DEFAULT_CLIP_SPACE)[2][2:],
            ),
            Contestant("(f+n)/(n−f)", naive),
        ),
    )


def _told_apart(id_: str, distance: float, gap: float) -> Case:
    """Ask of two surfaces on a line of sight whether a depth buffer knows the nearer one."""
    near, far = 0.1, 1e5
    z = np.array([distance, distance * (1 + gap)])

    def standard(buffer: DepthBuffer) -> list[float]:
        codes = depth_code(far / (far - near) * (1 - near / z), buffer)
        return [float(codes[1] > codes[0])]

    def backwards() -> list[float]:
        codes = depth_code(near / (far - near) * (far / z - 1), DepthBuffer.FLOAT32)
        return [float(codes[1] < codes[0])]

    return Case(
        id_,
        f"two surfaces {gap:g} apart at {distance:g}",
        f"near {near}, far {far:g}",
        exactly(1),
        "reversed depth has its fine steps where perspective needs them",
        (
            own("reversed float32", backwards),
            Contestant("float32", lambda: standard(DepthBuffer.FLOAT32)),
            Contestant("24 bits", lambda: standard(DepthBuffer.UNORM24)),
        ),
    )


CASES: tuple[Case, ...] = (
    _field_case(),
    _depth_row("D3", "near = far", 0.1, None, "there is no depth between them"),
    _depth_row(
        "D4",
        "far = inf",
        float("inf"),
        exactly(-1, -2 * Fraction(0.1)),
        "the limit exists, the quotient does not",
    ),
    _told_apart("D6", 9e4, 1e-6),
    _told_apart("D7", 1e3, 1e-6),
)
