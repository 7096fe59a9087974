"""`inspect`: the nodes of an asset that need the inverse transpose, and why."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path

from nmatrix.enums import Kind
from nmatrix.errors import CheckFailedError, IllegalValueError, quantity, shortlist
from nmatrix.linear.classify import FROM_FILE, Classification, classify
from nmatrix.linear.rational import RationalMatrix, identity
from nmatrix.report import Heading, Report, Table, Value, Verdict
from nmatrix.scene.geometry import left_out
from nmatrix.scene.gltf.file import read_gltf
from nmatrix.scene.words import GLTF_SUFFIXES

SHOWN = 40  # nodes in the table for people; JSON has them all


class Flaw(StrEnum):
    """A property of a node that a pipeline may refuse."""

    MIRRORED = "mirrored"
    SHEAR = "shear"
    DEGENERATE = "degenerate"
    SINGULAR = "singular"


# The words of a sentence about nodes with each flaw.
FAILURES = {
    Flaw.MIRRORED: "mirrored",
    Flaw.SHEAR: "sheared",
    Flaw.DEGENERATE: "with degenerate normals",
    Flaw.SINGULAR: "singular",
}


@dataclass(frozen=True)
class InspectedNode:
    """One node: its world matrix, the kind of that map, and its mesh's bad normals."""

    name: str
    world_from_object: RationalMatrix
    classification: Classification
    sheared_by_ancestors: bool
    degenerate_normals: int

    def has(self, flaw: Flaw) -> bool:
        """Look for a flaw in the node."""
        return {
            Flaw.MIRRORED: self.classification.mirrored,
            Flaw.SHEAR: self.classification.kind is Kind.SHEAR,
            Flaw.DEGENERATE: self.degenerate_normals > 0,
            Flaw.SINGULAR: self.classification.kind is Kind.SINGULAR,
        }[flaw]


@dataclass(frozen=True)
class Inspection:
    """The nodes of a whole file."""

    path: Path
    nodes: tuple[InspectedNode, ...]
    remarks: tuple[str, ...]

    def having(self, flaw: Flaw) -> tuple[InspectedNode, ...]:
        """Find the nodes with this flaw."""
        return tuple(node for node in self.nodes if node.has(flaw))

    @property
    def needing(self) -> tuple[InspectedNode, ...]:
        """The nodes whose world matrix would bend normals."""
        return tuple(node for node in self.nodes if node.classification.needs_inverse_transpose)


def inspect_file(path: Path, tolerance: float = FROM_FILE) -> Inspection:
    """Inspect every node of a glTF scene; a mesh file is one node that stands still.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read or is damaged.
    """
    if path.suffix.lower() not in GLTF_SUFFIXES:
        from nmatrix.scene.meshes.file import read_mesh

        mesh = read_mesh(path)
        still = identity(4)
        node = InspectedNode(
            path.stem,
            still,
            classify(still, tolerance),
            sheared_by_ancestors=False,
            degenerate_normals=mesh.degenerate_normals,
        )
        return Inspection(path, (node,), mesh.remarks)
    return _inspect_gltf(path, tolerance)


def _inspect_gltf(path: Path, tolerance: float) -> Inspection:
    from nmatrix.scene.gltf.meshes import mesh_normals

    file = read_gltf(path)
    if not file.nodes:
        raise IllegalValueError(f"{path}", "it has no nodes", "there is nothing to inspect")
    normals = {
        mesh: mesh_normals(file, mesh)
        for mesh in dict.fromkeys(node.mesh for node in file.nodes if node.mesh is not None)
    }
    nodes = []
    for node, record in zip(file.nodes, file.document.nodes, strict=True):
        found = classify(node.world_from_object, tolerance)
        sheared = found.kind is Kind.SHEAR
        if sheared and record.matrix is not None:  # a turned scale is none by itself
            sheared = classify(node.local, tolerance).kind is not Kind.SHEAR
        count = 0 if node.mesh is None else normals[node.mesh].degenerate
        nodes.append(InspectedNode(node.name, node.world_from_object, found, sheared, count))
    made = dict.fromkeys(text for one in normals.values() for text in one.remarks)
    faults = left_out(fault for one in normals.values() for fault in one.faults)
    return Inspection(path, tuple(nodes), (*file.remarks, *made, *faults))


def report(inspection: Inspection, fail_on: Sequence[str] = ()) -> Report:
    """Report the nodes; it ends in a failure where one of them has a flaw of `fail_on`."""
    data: dict[str, Value] = {
        "nodes": [_node_data(node) for node in inspection.nodes],
        "summary": _summary(inspection),
    }
    blocks = (
        Heading(inspection.path.name),
        _table(inspection),
        Verdict(_sentence(inspection)),
    )
    return Report("inspect", data, blocks, _remarks(inspection), _failure(inspection, fail_on))


def _node_data(node: InspectedNode) -> dict[str, Value]:
    found = node.classification
    return {
        "name": node.name,
        "world_from_object": node.world_from_object,
        "transform": found.kind.value,
        "transform_exact": found.kind_exact,
        "mirrored": found.mirrored,
        "needs_inverse_transpose": found.needs_inverse_transpose,
        "determinant_sign": found.determinant_sign,
        "worst_angle_without_deg": found.worst_angle_deg,
        "degenerate_normals": node.degenerate_normals,
        "sheared_by_ancestors": node.sheared_by_ancestors,
    }


def _summary(inspection: Inspection) -> dict[str, Value]:
    return {
        "nodes": len(inspection.nodes),
        "needs_inverse_transpose": len(inspection.needing),
        "mirrored": len(inspection.having(Flaw.MIRRORED)),
        "sheared_by_ancestors": sum(node.sheared_by_ancestors for node in inspection.nodes),
        "degenerate": len(inspection.having(Flaw.DEGENERATE)),
        "sentence": _sentence(inspection),
    }


def _sentence(inspection: Inspection) -> str:
    total, flat = len(inspection.nodes), len(inspection.having(Flaw.SINGULAR))
    needing, mirrored = len(inspection.needing) - flat, len(inspection.having(Flaw.MIRRORED))
    nodes = "node needs" if needing == 1 else "nodes need"
    told = f"{needing} of {total} {nodes} the inverse transpose"
    if flat:
        told += f"; {flat} {'is' if flat == 1 else 'are'} singular"
    return f"{told}; {mirrored} {'is' if mirrored == 1 else 'are'} mirrored."


def _table(inspection: Inspection) -> Table:
    rows = []
    for node in inspection.nodes[:SHOWN]:
        found = node.classification
        needs_it = found.needs_inverse_transpose
        flags = ("yes" if flag else "no" for flag in (found.mirrored, needs_it))
        worst = found.worst_angle_deg if needs_it else 0
        kind = "mirror" if found.mirrored and found.is_rigid else found.kind.value
        rows.append((node.name[:24], kind, *flags, worst))
    more = len(inspection.nodes) - SHOWN
    title = f"The first {SHOWN} nodes; {more} more with -f json" if more > 0 else ""
    return Table(("node", "world matrix", "mirrored", "needs it", "worst °"), tuple(rows), title)


def _remarks(inspection: Inspection) -> tuple[str, ...]:
    remarks = list(inspection.remarks)
    sheared = [node.name for node in inspection.nodes if node.sheared_by_ancestors]
    if sheared:
        remarks.append(
            f"Sheared by their ancestors ({', '.join(sheared[:5])}): a rotation under a "
            "non-uniform scale is a shear that no translate-rotate-scale can hold."
        )
    if inspection.having(Flaw.MIRRORED):
        remarks.append("Mirrored nodes flip triangle winding; their normals stay outward.")
    if inspection.having(Flaw.SINGULAR):
        remarks.append(
            "Singular nodes are flattened and have no inverse transpose: the cofactor matrix gives "
            "the normal of the plane that is left."
        )
    if 0 < len(inspection.needing) < len(inspection.nodes):
        remarks.append("Where it is not needed the 3×3 block of the world matrix carries normals.")
    return tuple(remarks)


def _failure(inspection: Inspection, fail_on: Sequence[str]) -> CheckFailedError | None:
    """Name every flaw that some node has, with its nodes."""
    found = {flaw: inspection.having(flaw) for flaw in map(Flaw, fail_on)}
    told = [
        f"{len(nodes)} of {len(inspection.nodes)} nodes {FAILURES[flaw]}"
        f" ({shortlist([node.name for node in nodes], 5)})"
        for flaw, nodes in found.items()
        if nodes
    ]
    if not told:
        return None
    return CheckFailedError(
        f"{quantity('fail_on')} {','.join(fail_on)}", "; ".join(told), "see their rows, or -f json"
    )
