"""The words of a scene: lights, shapes, sides, textures, depth, endings of files; free of NumPy."""

from __future__ import annotations

from enum import StrEnum

GLTF_SUFFIXES = (".gltf", ".glb")
MESH_SUFFIXES = (".obj", ".ply", ".stl")


class NormalsFrom(StrEnum):
    """Where the normals of a mesh come from; packed ones were not read."""

    FILE = "file"
    COMPUTED = "computed"
    PACKED = "packed"
    NONE = "none"


class Mover(StrEnum):
    """What carries the mesh of a node, or the node itself, beside the node's own matrix."""

    JOINTS = "joints"
    INSTANCES = "instances"
    ANIMATION = "animation"


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
    """The sides of a surface that are drawn: as its back can be seen, the front alone, both."""

    AS_NEEDED = "as-needed"
    FRONT = "front"
    BOTH = "both"


class Pattern(StrEnum):
    """Textures that are built in: eight squares to the unit of u and of v."""

    CHECKER = "checker"


class Wrap(StrEnum):
    """What a texture shows outside of the unit square: itself again, its border, its mirror."""

    REPEAT = "repeat"
    CLAMP = "clamp"
    MIRROR = "mirror"


class Filter(StrEnum):
    """How an image is read between its texels: the mean of four around a place, or the nearest."""

    LINEAR = "linear"
    NEAREST = "nearest"


class DepthBuffer(StrEnum):
    """The precision of stored depth: integers of 16 or 24 bits, float32, or float64."""

    UNORM16 = "16"
    UNORM24 = "24"
    FLOAT32 = "float32"
    FULL = "full"


VERTEX = ("vertex", "vertices")
