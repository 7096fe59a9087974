"""The nodes of a glTF file in their hierarchy, checked at once, placed when someone asks.

World matrices are exact products of the local ones, rounded at each node, but for what rounding
would change of their rank and mirroring. They are dear, and most readers of a file of thousands of
nodes look at a few: each is computed when it is asked for, with those above it, and kept.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import Enum
from functools import cached_property
from math import isfinite
from pathlib import Path
from typing import overload

from nmatrix.errors import IllegalValueError, printable, shortlist
from nmatrix.linear.affine import compose, rotation_from_quaternion
from nmatrix.linear.rank_keeping import rounded_keeping_rank
from nmatrix.linear.rational import (
    AFFINE_ROW,
    RationalMatrix,
    product,
    rational_matrix,
    to_floats,
)
from nmatrix.scene.gltf.records import NodeRecord
from nmatrix.scene.hierarchy import Hierarchy

UNIT_SLACK = 1e-6
LAST_ROW_SLACK = 1e-6  # files hold float32
MOST_NAMED = 5  # nodes that a remark names


class Mended(Enum):
    """What of a node's transform was nearly as the format has it, and taken as that."""

    QUATERNION = (
        "quaternion was not of length one and normalised",
        "quaternions were not of length one and normalised",
    )
    LAST_ROW = ("matrix did not quite end in 0 0 0 1", "matrices did not quite end in 0 0 0 1")


@dataclass(frozen=True, eq=False)
class Node:
    """A node in its place: its own matrix and the one that its ancestors make of it.

    Both are computed when they are asked for; an `IllegalValueError` names the node where a number
    of its world matrix is beyond the largest float64.
    """

    index: int
    name: str
    mesh: int | None
    parent: int | None
    record: NodeRecord
    nodes: Nodes

    @cached_property
    def local(self) -> RationalMatrix:
        """The map from the node to its parent, exactly."""
        return _local(self.record)

    @property
    def world_from_object(self) -> RationalMatrix:
        """The map from the node to the world."""
        return self.nodes.world(self.index)


@dataclass(frozen=True, eq=False)
class Nodes(Sequence[Node]):
    """The nodes in the file's order, each made when someone looks at it.

    `order` has parents before their children.
    """

    path: Path
    records: Sequence[NodeRecord]
    hierarchy: Hierarchy
    order: tuple[int, ...]
    mended: dict[int, Mended]

    def __len__(self) -> int:
        return len(self.records)

    @overload
    def __getitem__(self, place: int) -> Node: ...

    @overload
    def __getitem__(self, place: slice) -> tuple[Node, ...]: ...

    def __getitem__(self, place: int | slice) -> Node | tuple[Node, ...]:
        if isinstance(place, slice):
            return tuple(self[index] for index in range(len(self))[place])
        index = range(len(self))[place]
        if index not in self._made:
            name, parent = self.hierarchy.names[index], self.hierarchy.parents[index]
            record = self.records[index]
            self._made[index] = Node(index, name, record.mesh, parent, record, self)
        return self._made[index]

    @cached_property
    def _made(self) -> dict[int, Node]:
        return {}

    @cached_property
    def _worlds(self) -> dict[int, RationalMatrix]:
        return {}

    def world(self, index: int) -> RationalMatrix:
        """Multiply the maps from a node up to the root; what is known of them is not done again.

        Raises
        ------
        IllegalValueError
            If a number of it is beyond the largest float64.
        """
        waiting, at = [], index
        while at not in self._worlds:
            waiting.append(at)
            above = self.hierarchy.parents[at]
            if above is None:
                break
            at = above
        for at in reversed(waiting):
            above = self.hierarchy.parents[at]
            local = self[at].local
            whole = local if above is None else product(self._worlds[above], local)
            try:
                placed = rounded_keeping_rank(whole)
                to_floats(placed)
            except IllegalValueError as error:
                raise _fault(self.path, at, self.records[at], str(error)) from None
            self._worlds[at] = placed
        return self._worlds[index]

    def told(self) -> list[str]:
        """Tell of the nodes whose transforms were mended."""
        told = []
        for kind in Mended:
            names = [
                printable(self.hierarchy.names[index])
                for index, mended in self.mended.items()
                if mended is kind
            ]
            if names:
                what = kind.value[len(names) > 1]
                told.append(f"{len(names)} {what}: {shortlist(names, MOST_NAMED)}.")
        return told


def placed(path: Path, records: Sequence[NodeRecord], meshes: int) -> Nodes:
    """Check the nodes of a file that has so many meshes, and put them under one another.

    Raises
    ------
    IllegalValueError
        For a cycle, a node of two parents, an unknown child or mesh, and numbers that make no map.
    """
    order, parents = _order(path, records)
    mended = {}
    for index, record in enumerate(records):
        if record.mesh is not None and not 0 <= record.mesh < meshes:
            raise _fault(
                path, index, record, f"nodes[{index}].mesh: mesh {record.mesh} does not exist"
            )
        kind = _checked(path, index, record)
        if kind is not None:
            mended[index] = kind
    names = tuple(record.name or f"node {index}" for index, record in enumerate(records))
    return Nodes(path, records, Hierarchy(names, tuple(parents)), tuple(order), mended)


def _order(path: Path, nodes: Sequence[NodeRecord]) -> tuple[list[int], list[int | None]]:
    """Return the nodes with parents first, and each node's parent."""
    parents: list[int | None] = [None] * len(nodes)
    for index, record in enumerate(nodes):
        for place, child in enumerate(record.children):
            if not 0 <= child < len(nodes):
                why = f"nodes[{index}].children[{place}]: node {child} does not exist"
                raise _fault(path, index, record, why)
            if parents[child] is not None:
                raise _fault(path, child, nodes[child], "it has two parents")
            parents[child] = index
    order = [index for index, parent in enumerate(parents) if parent is None]
    for index in order:  # grows while it is walked: children follow their parents
        order.extend(nodes[index].children)
    if len(order) < len(nodes):
        missing = min(set(range(len(nodes))) - set(order))
        raise _fault(
            path, missing, nodes[missing], "it is its own ancestor: the hierarchy is a cycle"
        )
    return order, parents


def _checked(path: Path, index: int, record: NodeRecord) -> Mended | None:
    """Refuse numbers that make no map; tell what of the others has to be mended."""
    if record.matrix is not None:
        _check(path, index, record, record.matrix, 16)
        last = record.matrix[3::4]
        if last == [0, 0, 0, 1]:
            return None
        if max(abs(x - y) for x, y in zip(last, (0, 0, 0, 1), strict=True)) > LAST_ROW_SLACK:
            shown = " ".join(f"{x:g}" for x in last)
            why = f"its matrix ends in {shown} and not in 0 0 0 1"
            raise _fault(path, index, record, why)
        return Mended.LAST_ROW
    for numbers, size in ((record.translation, 3), (record.rotation, 4), (record.scale, 3)):
        if numbers is not None:
            _check(path, index, record, numbers, size)
    if not record.rotation:
        return None
    x, y, z, w = record.rotation
    square = x * x + y * y + z * z + w * w
    if square == 0 and not any(record.rotation):
        why = "quaternion (0 0 0 0): it has no direction"
        raise _fault(path, index, record, why)
    return Mended.QUATERNION if abs(square**0.5 - 1) > UNIT_SLACK else None


def _check(path: Path, index: int, record: NodeRecord, numbers: Sequence[float], size: int) -> None:
    if len(numbers) != size or not all(map(isfinite, numbers)):
        raise _fault(path, index, record, f"a transform needs {size} finite numbers")


def _local(record: NodeRecord) -> RationalMatrix:
    if record.matrix is not None:
        columns = [record.matrix[i : i + 4] for i in range(0, 16, 4)]
        return (*rational_matrix(zip(*columns, strict=True))[:3], AFFINE_ROW)
    turned = rotation_from_quaternion(record.rotation or (0, 0, 0, 1))
    return compose(turned, record.scale or (1, 1, 1), translate=record.translation or (0, 0, 0))


def _fault(path: Path, index: int, record: NodeRecord, why: str) -> IllegalValueError:
    name = record.name or f"node {index}"
    return IllegalValueError(f"{path} ({name[:60]})", why, "mend the file")
