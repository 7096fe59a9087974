"""One file: every node judged, from what the file says to what carries its mesh.

Nodes are judged when someone looks at them. In a file of thousands nearly all are plain, and are
counted without a look; `suspects` are those that may be something else.
"""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cache, cached_property, partial
from pathlib import Path

from nmatrix.answers.inspect.carried import Carried, carried, normals_of
from nmatrix.answers.inspect.node import Carriers, FoundNormals, InspectedNode, Maps
from nmatrix.answers.inspect.plain import suspects
from nmatrix.enums import Kind
from nmatrix.errors import NMatrixError, printable, shortlist
from nmatrix.linear.classify import FROM_FILE, Classification, classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalMatrix, identity, linear_part, translation
from nmatrix.reading.folders import STANDARD_INPUT
from nmatrix.scene.gltf.extensions import Treatment, treated
from nmatrix.scene.gltf.file import GltfFile, read_gltf
from nmatrix.scene.gltf.nodes import Node, Nodes
from nmatrix.scene.gltf.records import Document, NodeRecord
from nmatrix.scene.hierarchy import Hierarchy
from nmatrix.scene.words import GLTF_SUFFIXES, NormalsFrom

BINARY = ".glb"  # its JSON has lines, and the file has none
NORMALS_MADE, NOT_DRAWN = "Normals were made", "Not drawn of "  # as readers begin remarks
_FAULTY = re.compile(r", line (\d+)\b")
_SPOKEN = re.compile(r"(?:it is not glTF: |its header breaks off in )?line (\d+)\b")
MOST_NAMED = 5  # extensions


class Special(StrEnum):
    """What some nodes of a file are that changes how they were judged."""

    SKINNED = "skinned"
    INSTANCED = "instanced"
    ANIMATED = "animated"
    MORPHED = "morphed"
    OUTSIDE_SCENE = "outside_scene"
    COMPUTED_NORMALS = "computed_normals"


@dataclass(frozen=True, eq=False)
class InspectedFile:
    """One file: its nodes, or the error that stopped it.

    `judge` looks at one of so many nodes; `suspects` are the indices of all that have a flaw, and
    perhaps of some others. `special` counts nodes by what they are.
    """

    file: str
    count: int = 0
    judge: Callable[[int], InspectedNode] | None = None
    suspects: Sequence[int] = ()
    special: Mapping[Special, int] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    error: NMatrixError | None = None

    @property
    def reason(self) -> str:
        """Why the file could not be read, without its name; empty where it was."""
        if self.error is None:
            return ""
        what, *others = self.error.parts
        return str(NMatrixError(what.removeprefix(self.file).lstrip(",: "), *others))

    @property
    def line(self) -> int:
        """The line of the file that its error names, from 1; 0 if it names none."""
        if self.error is None or self.file.lower().endswith(BINARY):
            return 0
        what, why, _ = self.error.parts
        found = _FAULTY.match(what.removeprefix(self.file)) or _SPOKEN.match(why)
        return 0 if found is None else int(found[1])

    @cached_property
    def nodes(self) -> tuple[InspectedNode, ...]:
        """All nodes, in the file's order."""
        return self._judged(range(self.count))

    @cached_property
    def flawed(self) -> tuple[InspectedNode, ...]:
        """The nodes that have a flaw, in the file's order."""
        return tuple(node for node in self._judged(self.suspects) if node.flaws)

    def _judged(self, indices: Iterable[int]) -> tuple[InspectedNode, ...]:
        return () if self.judge is None else tuple(map(self.judge, indices))


def inspect_file(
    path: Path,
    tolerance: float = FROM_FILE,
    *,
    content: bytes | None = None,
    allow_outside: bool = False,
) -> InspectedFile:
    """Inspect every node of a glTF scene; a mesh file is one node that stands still.

    `content` is that of standard input; the ending of the path tells its format.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read or is damaged.
    """
    name = str(path) if content is None else STANDARD_INPUT
    if path.suffix.lower() in GLTF_SUFFIXES:
        file = read_gltf(path, content=content, allow_outside=allow_outside)
        return _GltfJudge.of(file, tolerance).inspected(name)
    return _inspect_mesh(path, name, content)


def _inspect_mesh(path: Path, name: str, content: bytes | None) -> InspectedFile:
    from nmatrix.scene.meshes.file import read_surface

    file = read_surface(path, content)
    computed = file.normals_from is NormalsFrom.COMPUTED
    degenerate = sum(part.mesh.degenerate_normals for part in file.parts)
    places = (part.mesh.degenerate_at for part in file.parts)
    at = next((place for place in places if place is not None), None)
    still = identity(4)
    node = InspectedNode(
        name,
        0,
        Hierarchy((path.stem,), (None,)),
        still,
        Maps.of(Carriers.NODE, (classify(still),)),
        FoundNormals(file.normals_from, degenerate, at=at),
        mesh=0,
    )
    special = {Special.COMPUTED_NORMALS: int(computed)}
    remarks = tuple(map(_without_a_picture, file.remarks))
    return InspectedFile(name, 1, lambda _: node, (0,), special, tuple(filter(None, remarks)))


def _without_a_picture(remark: str) -> str:
    """Tell of triangles and not of drawing; that normals were made is counted for all files."""
    if remark.startswith(NORMALS_MADE):
        return ""
    return (
        remark.replace(NOT_DRAWN, "Not judged of ", 1) if remark.startswith(NOT_DRAWN) else remark
    )


@dataclass(frozen=True, eq=False)
class _Classifier:
    """Classifies maps; one that came before is known, and so is its worst angle."""

    tolerance: float
    known: dict[tuple[LinearMap, bool], Classification] = field(default_factory=dict)

    def __call__(self, A: RationalMatrix) -> Classification:
        key = (LinearMap.of(linear_part(A)), any(translation(A)))
        if key not in self.known:
            self.known[key] = classify(A, self.tolerance)
        return self.known[key]


@dataclass(frozen=True, eq=False)
class _GltfJudge:
    """What judging a node of a glTF file takes; the bytes of its buffers are not kept."""

    document: Document
    nodes: Nodes
    in_scene: frozenset[int]
    classified: _Classifier
    carried: Carried
    normals: Mapping[int, FoundNormals]  # of meshes
    remarks: tuple[str, ...]

    @classmethod
    def of(cls, file: GltfFile, tolerance: float) -> _GltfJudge:
        """Read what a file says of its meshes and of what carries them."""
        used = dict.fromkeys(one.mesh for one in file.document.nodes if one.mesh is not None)
        classified = _Classifier(tolerance)
        found = carried(file, classified, tolerance)
        return cls(
            file.document,
            file.nodes,
            frozenset(file.in_scene),
            classified,
            found,
            {mesh: normals_of(file, mesh) for mesh in used},
            (*file.remarks, *_unknown_extensions(file.document), *found.remarks),
        )

    def inspected(self, name: str) -> InspectedFile:
        """Count what is known without a look at any node; looks are left to those who ask."""
        records = self.document.nodes
        normals = [None if one.mesh is None else self.normals[one.mesh] for one in records]
        found = {
            *suspects(self.nodes, self.classified.tolerance),
            *self.carried.maps,
            *self.carried.unread,
            *(i for i, one in enumerate(normals) if one and (one.degenerate or one.unread)),
        }
        carriers = Counter(maps.carriers for maps in self.carried.maps.values())
        special = {
            Special.SKINNED: sum(map(_is_skinned, records)),
            Special.INSTANCED: carriers[Carriers.INSTANCES],
            Special.ANIMATED: len(self.carried.animated),
            Special.MORPHED: sum(map(self._is_morphed, records)),
            Special.OUTSIDE_SCENE: len(records) - len(self.in_scene),
            Special.COMPUTED_NORMALS: sum(
                one is not None and one.origin is NormalsFrom.COMPUTED for one in normals
            ),
        }
        judge = cache(partial(self.node, name))
        return InspectedFile(name, len(records), judge, sorted(found), special, self.remarks)

    def _is_morphed(self, record: NodeRecord) -> bool:
        if record.mesh is None:
            return False
        return any(one.targets for one in self.document.meshes[record.mesh].primitives)

    def node(self, name: str, index: int) -> InspectedNode:
        """Judge one node."""
        node = self.nodes[index]
        maps = self.carried.maps.get(index)
        is_sheared_above = False
        if maps is None:
            maps = Maps.of(Carriers.NODE, (self.classified(node.world_from_object),))
            is_sheared_above = maps.kind is Kind.SHEAR and not self._is_sheared(node)
        mesh = None if node.mesh is None else self.document.meshes[node.mesh]
        return InspectedNode(
            name,
            index,
            self.nodes.hierarchy,
            node.world_from_object,
            maps,
            FoundNormals() if node.mesh is None else self.normals[node.mesh],
            node.mesh,
            "" if mesh is None else mesh.name or "",
            in_scene=index in self.in_scene,
            skinned=_is_skinned(node.record),
            animated=tuple(map(str, self.carried.animated.get(index, ()))),
            sheared_by_ancestors=is_sheared_above,
            unplaced=self.carried.unread.get(index, ""),
        )

    def _is_sheared(self, node: Node) -> bool:
        """Whether a node's own matrix is a shear; what is given in parts never is."""
        if node.record.matrix is None:
            return False
        return self.classified(node.local).kind is Kind.SHEAR


def _unknown_extensions(document: Document) -> Iterable[str]:
    """Tell of extensions without which the file means something else."""
    unknown = treated(document.extensions_required, Treatment.UNKNOWN)
    if unknown:
        names = shortlist(map(printable, unknown), MOST_NAMED)
        yield f"The file requires {names}, unknown here: nodes are judged as if it changed nothing."


def _is_skinned(record: NodeRecord) -> bool:
    return record.mesh is not None and record.skin is not None
