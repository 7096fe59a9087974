"""The words of a scene: kinds of lights, shapes, sides and depth buffers; free of NumPy."""

from __future__ import annotations

from enum import StrEnum


class LightKind(StrEnum):
    """The kinds of light in a scene."""

    DIRECTIONAL = "directional"
    POINT = "point"
    SPOT = "spot"
    AMBIENT = "ambient"


class Shape(StrEnum):
    """The shapes that are built in."""

    SPHERE = "sphere"
    TORUS = "torus"
    BOX = "box"
    PLANE = "plane"
    CONE = "cone"


class Sides(StrEnum):
    """Which sides of a surface are drawn: where its back can be seen, the front alone, both."""

    AS_NEEDED = "as-needed"
    FRONT = "front"
    BOTH = "both"


class DepthBuffer(StrEnum):
    """How finely depth is stored."""

    UNORM16 = "16"
    UNORM24 = "24"
    FLOAT32 = "float32"
    FULL = "full"
