"""A node as machines read it: its keys in JSON, and a row of CSV with one number in each cell."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from nmatrix.answers.inspect.flaws import FLAWS
from nmatrix.answers.inspect.node import Carriers, InspectedNode, Maps
from nmatrix.enums import Flaw
from nmatrix.linear.classify import classify
from nmatrix.linear.rational import identity
from nmatrix.report import Cells, Number, Value
from nmatrix.scene.hierarchy import Hierarchy

SIZES = {"normal_matrix": 3, "world_from_object": 4}  # of the matrices among the keys
INSTANCES = ("count", "mirrored", "non_uniform")
Cell = Number | str | bool | None


def node_data(node: InspectedNode) -> dict[str, Value]:
    """Spread a node over the keys that it has in JSON.

    What is said of its map is said of all its maps together where joints, instances or scales over
    time give it several; there is no one normal matrix then.
    """
    maps = node.maps
    return {
        "file": node.file,
        "index": node.index,
        "path": node.path,
        "name": node.hierarchy.names[node.index],
        "object": node.hierarchy.addresses[node.index],
        "parent": node.hierarchy.parents[node.index],
        "mesh": node.mesh,
        "in_scene": node.in_scene,
        "skinned": node.skinned,
        "instances": node.instances,
        "animated": list(node.animated),
        "normal_matrix": node.normal_matrix,
        "normals_from": node.normals.origin.value,
        "world_from_object": node.world_from_object,
        "transform": maps.kind.value,
        "transform_exact": maps.kind_exact,
        "mirrored": maps.count(Flaw.MIRRORED) > 0,
        "needs_inverse_transpose": maps.needs_inverse_transpose,
        "determinant_sign": maps.determinant_sign,
        "worst_angle_without_deg": maps.worst_angle_deg,
        "degenerate_normals": None if node.normals.unread else node.normals.degenerate,
        "sheared_by_ancestors": node.sheared_by_ancestors,
        "found": node.found,
        "rules": [FLAWS[flaw].rule.code for flaw in node.flaws],
        "error": node.unread or None,
    }


def cells_of_node(node: InspectedNode) -> Cells:
    """Write a node as the cells of a row."""
    return tuple(dict(_flat(node)).values())


def cells_of_unread(file: str, reason: str) -> Cells:
    """Write a row about a file that could not be read: its name, the rule and the reason alone."""
    words = FLAWS[Flaw.UNREADABLE]
    told = {"file": file, "found": words.adjective, "rules": words.rule.code, "error": reason}
    return tuple(told.get(column) for column in COLUMNS)


def _flat(node: InspectedNode) -> Iterator[tuple[str, Cell]]:
    """Give every number its own key, the same keys for every node."""
    instances = node.instances or dict.fromkeys(INSTANCES)
    matrices = {"normal_matrix": node.normal_matrix, "world_from_object": node.world_from_object}
    for key, value in node_data(node).items():
        if key in SIZES:
            rows = matrices[key] or ((None,) * SIZES[key],) * SIZES[key]
            for i, row in enumerate(rows):
                yield from ((f"{key}_{i}_{j}", entry) for j, entry in enumerate(row))
        elif key == "instances":
            yield from ((f"{key}_{name}", instances[name]) for name in INSTANCES)
        elif isinstance(value, list):
            yield key, " ".join(map(str, value))
        elif value is None or isinstance(value, (str, int, float, Fraction)):
            yield key, value


def _plain_node() -> InspectedNode:
    still = identity(4)
    maps = Maps.of(Carriers.NODE, (classify(still),))
    return InspectedNode("", 0, Hierarchy(("",), (None,)), still, maps)


COLUMNS = tuple(dict(_flat(_plain_node())))
