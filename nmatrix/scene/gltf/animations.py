"""The animations of a glTF file: what of which node moves, and the scales that it goes through."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from enum import StrEnum
from itertools import chain

from nmatrix.errors import IllegalValueError
from nmatrix.report import Vector
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.records import AnimationChannel, AnimationRecord

Curve = tuple[int, bool]  # the accessor of its values, and whether it is a cubic spline


class Animated(StrEnum):
    """What of a node an animation changes."""

    TRANSLATION = "translation"
    ROTATION = "rotation"
    SCALE = "scale"
    WEIGHTS = "weights"


@dataclass(frozen=True)
class AnimatedScales:
    """The scales that animations give to nodes, by the node's index: each different key once.

    `remarks` name the animations whose keys cannot be read.
    """

    keys: dict[int, tuple[Vector, ...]]
    remarks: tuple[str, ...] = ()


def animated_channels(file: GltfFile) -> dict[int, frozenset[Animated]]:
    """Find what animations change of each node: only nodes of which they change something."""
    found: dict[int, set[Animated]] = {}
    for _, _, channel, node in _channels(file):
        if channel.target.path in set(Animated):
            found.setdefault(node, set()).add(Animated(channel.target.path))
    return {node: frozenset(changed) for node, changed in found.items()}


def animated_scales(file: GltfFile) -> AnimatedScales:
    """Read the scales at the keys of all animations; between two keys they are between them.

    Only a cubic spline may leave what lies between its keys. Keys that many channels name are read
    once, and are one tuple for all nodes that they alone scale.
    """
    read: dict[Curve, tuple[Vector, ...]] = {}
    curves: dict[int, dict[Curve, None]] = {}
    remarks: dict[str, None] = {}
    for index, animation, channel, node in _channels(file):
        if channel.target.path == Animated.SCALE:
            try:
                curve = _curve(file, animation, channel)
                if curve not in read:
                    read[curve] = _keys(file, curve)
            except IllegalValueError as error:
                why = error.parts[1]
                remarks[f"Scales of animation {index} are not read: {why}."] = None
            else:
                curves.setdefault(node, {})[curve] = None
    keys = {}
    for node, found in curves.items():
        one, *others = (read[curve] for curve in found)
        keys[node] = tuple(dict.fromkeys(chain(one, *others))) if others else one
    return AnimatedScales(keys, tuple(remarks))


def _channels(file: GltfFile) -> Iterator[tuple[int, AnimationRecord, AnimationChannel, int]]:
    """Walk over the channels that move nodes that exist, with their animation and its index."""
    for index, animation in enumerate(file.document.animations):
        for channel in () if animation is None else animation.channels:
            node = channel.target.node
            if animation is not None and node is not None and 0 <= node < len(file.document.nodes):
                yield index, animation, channel, node


def _curve(file: GltfFile, animation: AnimationRecord, channel: AnimationChannel) -> Curve:
    sampler = file.entry("sampler", animation.samplers, channel.sampler)
    return sampler.output, sampler.interpolation == "CUBICSPLINE"


def _keys(file: GltfFile, curve: Curve) -> tuple[Vector, ...]:
    """Read the different values of a curve; a spline has a tangent on each side of a value."""
    import numpy as np

    from nmatrix.scene.gltf.accessors import values

    output, is_spline = curve
    found = values(file, output, "an animation's scale", ("VEC3",))
    rows = slice(1, None, 3) if is_spline else slice(None)
    return tuple(tuple(one) for one in np.unique(found.finite(rows), axis=0).tolist())
