"""Scene and mesh files: every node as three.js sees it, and one line for every damaged file."""

from __future__ import annotations

import json
from base64 import b64encode
from fractions import Fraction
from pathlib import Path
from struct import pack

import pytest

from nmatrix.answers.inspect.file import inspect_file
from nmatrix.answers.inspect.flaws import FLAWS
from nmatrix.answers.inspect.report import Chosen
from nmatrix.answers.inspect.report import report as report_on
from nmatrix.enums import Flaw, Kind
from nmatrix.errors import CheckFailedError, IllegalValueError
from nmatrix.linear.classify import classify
from nmatrix.linear.rational import Rows, identity, to_floats
from nmatrix.report import Table
from nmatrix.scene.gltf.file import read_gltf
from nmatrix.scene.meshes.file import read_mesh

# three.js does not normalise quaternions; these files hold some that are slightly off.
UNNORMALISED = ("Cameras", "TextureEncodingTest")
SIN30 = 0.25881904510252074  # sine of 15°, so that the node turns by 30° about z
COS30 = 0.9659258262890683


def report(found, fail_on=()):
    return report_on((found,), Chosen(show_all=True, fail_on=tuple(fail_on)))


def kind(node) -> Kind:
    return node.maps.kind


def scene(folder: Path, nodes: list[dict[str, object]]) -> Path:
    path = folder / "made.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "nodes": nodes}))
    return path


def test_every_node_agrees_with_three_js(data: Path) -> None:
    scenes: dict[str, tuple] = {}
    compared = 0
    for record in json.loads((data / "golden_gltf_nodes.json").read_text()):
        name = record["args"]["file"]
        if name not in scenes:
            scenes[name] = read_gltf(data / "gltf" / name).nodes
        node = scenes[name][record["args"]["node"]]
        limit = 1e-3 if name.startswith(UNNORMALISED) else 1e-6
        linear_map = classify(node.world_from_object).linear_map
        assert agrees(to_floats(node.world_from_object), record["result"]["W"], limit)
        assert agrees(to_floats(linear_map.inverse_transpose), record["result"]["N"], limit)
        assert linear_map.determinant_sign == (1 if record["result"]["det3"] > 0 else -1)
        compared += 1
    assert compared > 100


def agrees(ours: Rows, theirs: list[list[float]], limit: float) -> bool:
    size = max(abs(x) for row in theirs for x in row)
    return all(
        abs(x - y) <= limit * size
        for row, other in zip(ours, theirs, strict=True)
        for x, y in zip(row, other, strict=True)
    )


def test_mirrored_nodes_are_those_that_three_js_winds_backwards(data: Path) -> None:
    file = "NegativeScaleTest/glTF-Binary/NegativeScaleTest.glb"
    nodes = inspect_file(data / "gltf" / file).nodes
    for record in json.loads((data / "golden_gltf_nodes.json").read_text()):
        if record["args"]["file"] == file:
            found = nodes[record["args"]["node"]]
            assert (Flaw.MIRRORED in found.flaws) == (record["result"]["winding"] != "ccw")
    assert sum(Flaw.MIRRORED in node.flaws for node in nodes) == 6


def test_rotation_under_a_non_uniform_scale_is_sheared_by_its_ancestors(tmp_path: Path) -> None:
    path = scene(
        tmp_path,
        [
            {"name": "stretched", "scale": [1, 2, 1], "children": [1]},
            {"name": "turned", "rotation": [0, 0, SIN30, COS30]},
        ],
    )
    parent, child = inspect_file(path).nodes
    assert kind(parent) is Kind.NON_UNIFORM_SCALE
    assert not parent.sheared_by_ancestors
    assert kind(child) is Kind.SHEAR
    assert child.sheared_by_ancestors
    answer = report(inspect_file(path), (Flaw.SHEAR,))
    assert isinstance(answer.failure, CheckFailedError)
    assert answer.data["summary"]["sheared_by_ancestors"] == 1


def test_a_mirror_is_called_a_mirror_and_no_rotation(tmp_path: Path) -> None:
    nodes = [{"name": "m", "scale": [-1, 1, 1]}, {"name": "t", "rotation": [0, 0, SIN30, COS30]}]
    told = report(inspect_file(scene(tmp_path, nodes)))
    (table,) = (block for block in told.blocks if isinstance(block, Table))
    assert [row[1:3] for row in table.rows] == [("m", "mirrored"), ("t", "rotation")]
    assert [node["transform"] for node in told.data["nodes"]] == ["rotation", "rotation"]


def test_the_child_of_a_flattened_node_is_no_mirror(tmp_path: Path) -> None:
    """Rounded node by node, its determinant is below 0."""
    nodes = [
        {"rotation": [0.1129, 0.2259, 0.3388, 0.9063], "children": [1]},
        {"scale": [1, 0, 1], "children": [2]},
        {"rotation": [0.2113, -0.1057, 0.1057, 0.9659]},
    ]
    told = report(inspect_file(scene(tmp_path, nodes)), (Flaw.MIRRORED, Flaw.SHEAR))
    assert told.failure is None
    assert [node["transform"] for node in told.data["nodes"]][1:] == ["singular", "singular"]


def test_every_failing_condition_is_named_with_its_nodes(tmp_path: Path) -> None:
    path = scene(
        tmp_path,
        [
            {"name": "stretched", "scale": [1, 2, 1], "children": [1]},
            {"name": "turned", "rotation": [0, 0, SIN30, COS30]},
            {"name": "copy", "scale": [-1, 1, 1]},
        ],
    )
    failure = report(inspect_file(path), (Flaw.MIRRORED, Flaw.DEGENERATE, Flaw.SHEAR)).failure
    assert failure is not None
    told = "1 of 3 nodes is mirrored (copy); 1 of 3 nodes is sheared (stretched/turned)"
    assert told in str(failure)
    assert "degenerate normals" not in str(failure)


def test_a_mesh_file_is_one_node_that_stands_still(tmp_path: Path) -> None:
    """A triangle without area has no normals, so its three vertices have none."""
    path = tmp_path / "sliver.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")
    (node,) = inspect_file(path).nodes
    assert (node.path, node.world_from_object) == ("sliver", identity(4))
    assert (kind(node), node.normals.degenerate) == (Kind.IDENTITY, 3)
    failure = report(inspect_file(path), list(Flaw)).failure
    assert failure is not None
    assert "1 of 1 node has degenerate normals (sliver)" in str(failure)


def test_bad_normals_of_a_mesh_count_at_every_node_that_has_it(tmp_path: Path) -> None:
    """Two of the three normals are zero, in a mesh whose other primitive has lines only."""
    places = pack("<18f", 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 2, 0, 0, 0, 0)
    vectors = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}
    attributes = {"POSITION": 0, "NORMAL": 1}
    document = {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}, {"name": "group"}, {"mesh": 0, "scale": [-1, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": attributes}, {"attributes": {}, "mode": 1}]}],
        "accessors": [vectors, {**vectors, "byteOffset": 36}],
        "bufferViews": [{"buffer": 0, "byteLength": 72}],
        "buffers": [{"byteLength": 72, "uri": f"data:,{b64encode(places).decode()}"}],
    }
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps(document))
    found = inspect_file(path)
    assert [node.normals.degenerate for node in found.nodes] == [2, 0, 2]
    flawed = {node.path: node.flaws for node in found.flawed}
    assert flawed == {
        "node 0": (Flaw.DEGENERATE,),
        "node 2": (Flaw.MIRRORED, Flaw.DEGENERATE),
    }
    assert "Mirrored nodes flip" in " ".join(report(found).remarks)


def test_every_flaw_has_a_rule_of_its_own_that_keeps_its_code() -> None:
    assert {flaw: one.rule.code for flaw, one in FLAWS.items()} == {
        Flaw.SHEAR: "NM-A01",
        Flaw.MIRRORED: "NM-A02",
        Flaw.SINGULAR: "NM-A03",
        Flaw.DEGENERATE: "NM-A04",
        Flaw.NON_UNIFORM_SCALE: "NM-A05",
        Flaw.UNREADABLE: "NM-A06",
    }


def test_a_file_without_nodes_is_read_and_has_none(tmp_path: Path) -> None:
    told = report(inspect_file(scene(tmp_path, [])), list(Flaw))
    assert told.failure is None
    assert list(told.data["nodes"]) == []
    assert told.data["summary"]["sentence"] == "There are no nodes."


def test_a_node_without_a_flaw_fails_nothing(tmp_path: Path) -> None:
    path = scene(tmp_path, [{"name": "plain"}])
    assert report(inspect_file(path), list(Flaw)).failure is None


def test_world_matrices_are_products_from_the_root_down(tmp_path: Path) -> None:
    path = scene(
        tmp_path,
        [{"translation": [1, 0, 0], "children": [1]}, {"scale": [2, 2, 2], "children": [2]}, {}],
    )
    last = read_gltf(path).nodes[2].world_from_object
    assert [row[3] for row in last] == [1, 0, 0, 1]
    assert last[0][0] == Fraction(2)


def test_a_chain_of_two_thousand_nodes_needs_no_recursion(tmp_path: Path) -> None:
    nodes = [{"translation": [0, 0, 1], "children": [i + 1]} for i in range(2000)]
    found = read_gltf(scene(tmp_path, [*nodes, {}])).nodes
    assert found[-1].world_from_object[2][3] == 2000


@pytest.mark.parametrize(
    ("nodes", "words"),
    [
        ([{"children": [0]}], "cycle"),
        ([{"children": [1]}, {"children": [0]}], "cycle"),
        ([{"children": [7]}], r"nodes\[0\].children\[0\]: node 7 does not exist"),
        ([{"children": [2]}, {"children": [2]}, {}], "two parents"),
        ([{"scale": [1, 2]}], "3 finite numbers"),
        ([{}, {"mesh": 3}], r"nodes\[1\].mesh: mesh 3 does not exist"),
        ([{"rotation": [0, 0, 0, 0]}], "zero|direction"),
    ],
)
def test_damaged_hierarchies_are_named(
    tmp_path: Path, nodes: list[dict[str, object]], words: str
) -> None:
    with pytest.raises((IllegalValueError, ArithmeticError), match=words):
        read_gltf(scene(tmp_path, nodes))


@pytest.mark.parametrize("content", [b"", b"{", b"[]", b"glTF\x02", b"\xff\xfe{", b"glTF" * 9])
def test_what_is_no_gltf_is_refused(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "broken.glb"
    path.write_bytes(content)
    with pytest.raises(IllegalValueError):
        read_gltf(path)


def test_every_odd_file_loads_or_is_refused_in_one_line(data: Path) -> None:
    loaded = refused = 0
    for path in sorted((data / "meshes" / "odd").iterdir()):
        try:
            inspect_file(path)
            loaded += 1
        except IllegalValueError as error:
            assert "\n" not in str(error), path.name
            refused += 1
    assert loaded > 15
    assert refused >= 4


def test_normals_that_are_missing_are_made_and_have_length_one(data: Path) -> None:
    mesh = read_mesh(data / "meshes" / "teapot.obj")
    lengths = (mesh.normals**2).sum(axis=1)
    assert abs(lengths[lengths > 0] - 1).max() < 1e-12


def test_quaternions_off_unit_length_are_normalised_with_one_remark(tmp_path: Path) -> None:
    nodes: list[dict[str, object]] = [{"rotation": [0, 0, 2, 2]} for _ in range(8)]
    found = read_gltf(scene(tmp_path, nodes))
    assert found.nodes[0].world_from_object[0][:2] == (0, -1)
    assert len(found.remarks) == 1
    assert found.remarks[0].startswith("8 quaternions")
    assert read_gltf(scene(tmp_path, [{"rotation": [0, 0, 0.6, 0.8]}])).remarks == ()
