"""What carries a mesh is what is judged: joints, instances, scales over time; and its normals.

The expected numbers are worked out by hand: a scale of 1 2 1 bends normals by up to
arctan((2 − 1/2)/2) = 36.87°, one of 1 3 1 by up to arctan((3 − 1/3)/2) = 53.13°.
"""

from __future__ import annotations

import json
from base64 import b64encode
from pathlib import Path
from struct import pack

import pytest

from nmatrix.answers.inspect import carried
from nmatrix.answers.inspect.file import inspect_file
from nmatrix.answers.inspect.node import Carriers
from nmatrix.answers.inspect.report import Chosen, report
from nmatrix.enums import Flaw, Kind
from nmatrix.scene.gltf import animations
from nmatrix.scene.words import NormalsFrom

INSTANCING = "EXT_mesh_gpu_instancing"
CORNERS = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
UP = [(0, 0, 1)] * 3
BY_TWO, BY_THREE = 36.86989764584402, 53.13010235415598
QUARTER = [0, 0, 0.5**0.5, 0.5**0.5]


class Made:
    """A glTF file in the making: rows of floats become accessors."""

    def __init__(self) -> None:
        self.content = b""
        self.document: dict[str, list] = {"accessors": [], "bufferViews": [], "nodes": []}

    def rows(self, rows: list[tuple[float, ...]], kind: str = "VEC3") -> int:
        data = b"".join(pack(f"<{len(row)}f", *row) for row in rows)
        views, accessors = self.document["bufferViews"], self.document["accessors"]
        views.append({"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)})
        accessors.append(
            {
                "bufferView": len(views) - 1,
                "componentType": 5126,
                "count": len(rows),
                "type": kind,
            }
        )
        self.content += data
        return len(accessors) - 1

    def joints(self, count: int) -> int:
        """Name the first joint for each of some vertices."""
        accessor = self.rows([(0.0,)] * count, "SCALAR")  # four bytes of 0
        self.document["accessors"][accessor] |= {"componentType": 5121, "type": "VEC4"}
        return accessor

    def mesh(self, normals: list[tuple[float, ...]] | None = UP, **more: object) -> int:
        attributes = {"POSITION": self.rows(CORNERS)}
        if normals is not None:
            attributes["NORMAL"] = self.rows(normals)
        meshes = self.document.setdefault("meshes", [])
        meshes.append({"primitives": [{"attributes": attributes, **more}]})
        return len(meshes) - 1

    def node(self, **record: object) -> int:
        self.document["nodes"].append(record)
        return len(self.document["nodes"]) - 1

    def scaled_over_time(self, node: int, keys: list[tuple[float, ...]], **more: object) -> None:
        sampler = {"input": self.rows([(i,) for i in range(len(keys))], "SCALAR")}
        sampler |= {"output": self.rows(keys), **more}
        target = {"node": node, "path": "scale"}
        animation = {"samplers": [sampler], "channels": [{"sampler": 0, "target": target}]}
        self.document.setdefault("animations", []).append(animation)

    def written(self, folder: Path, *more_buffers: dict[str, object]) -> Path:
        uri = f"data:;base64,{b64encode(self.content).decode()}"
        buffers = [{"byteLength": len(self.content), "uri": uri}, *more_buffers]
        path = folder / "made.gltf"
        whole = {"asset": {"version": "2.0"}, **self.document, "buffers": buffers}
        path.write_text(json.dumps(whole))
        return path


def columns(matrix: list[list[float]]) -> tuple[float, ...]:
    return tuple(entry for column in zip(*matrix, strict=True) for entry in column)


def scaling(x: float, y: float, z: float) -> list[list[float]]:
    return [[x, 0, 0, 0], [0, y, 0, 0], [0, 0, z, 0], [0, 0, 0, 1]]


def test_a_skinned_mesh_is_judged_by_its_joints_and_not_by_its_node(tmp_path: Path) -> None:
    made = Made()
    mesh = made.mesh()
    made.node(name="body", mesh=mesh, skin=0, scale=[1, 5, -1])
    made.node(name="hip", scale=[1, 2, 1], children=[2])
    made.node(name="knee", rotation=QUARTER)
    # The inverse bind matrix of the first joint takes its scale back; the second mirrors.
    binds = [columns(scaling(1, 0.5, 1)), columns(scaling(-1, 1, 1))]
    made.document["skins"] = [{"joints": [1, 2], "inverseBindMatrices": made.rows(binds, "MAT4")}]
    found = inspect_file(made.written(tmp_path))
    body, hip, knee = found.nodes
    assert (body.skinned, body.maps.carriers) == (True, Carriers.JOINTS)
    assert [one.kind for one in body.maps.each] == [Kind.IDENTITY, Kind.NON_UNIFORM_SCALE]
    assert body.flaws == (Flaw.MIRRORED, Flaw.NON_UNIFORM_SCALE)
    assert body.found == "1 of 2 joints mirrored and non-uniform"
    assert body.maps.worst_angle_deg == pytest.approx(BY_TWO, abs=1e-6)
    assert body.maps.determinant_sign is None
    assert body.normal_matrix is None
    assert (hip.skinned, knee.skinned) == (False, False)
    told = report((found,))
    assert any("transform of a skinned mesh's own node" in one for one in told.remarks)
    assert told.data["summary"]["skinned"] == 1


def test_a_skinned_mesh_whose_joints_are_plain_has_no_flaw(tmp_path: Path) -> None:
    made = Made()
    made.node(name="body", mesh=made.mesh(), skin=0, scale=[-1, 5, 1])
    made.node(name="hip", translation=[1, 2, 3])
    made.document["skins"] = [{"joints": [1]}]
    found = inspect_file(made.written(tmp_path))
    assert found.flawed == ()
    assert report((found,), Chosen(fail_on=tuple(Flaw))).failure is None


def test_instances_are_judged_by_their_own_maps(tmp_path: Path) -> None:
    made = Made()
    places = {
        "TRANSLATION": made.rows([(0, 0, 0), (5, 0, 0), (6, 0, 0)]),
        "SCALE": made.rows([(1, 1, 1), (-1, 2, 1), (1, 1, 1)]),
    }
    extensions = {INSTANCING: {"attributes": places}}
    made.node(name="forest", mesh=made.mesh(), extensions=extensions)
    found = inspect_file(made.written(tmp_path))
    (forest,) = found.nodes
    assert forest.instances == {"count": 3, "mirrored": 1, "non_uniform": 1}
    assert forest.found == "1 of 3 instances mirrored and non-uniform"
    assert forest.maps.worst_angle_deg == pytest.approx(BY_TWO, abs=1e-9)
    failure = report((found,), Chosen(fail_on=(Flaw.MIRRORED,))).failure
    assert "1 of 1 node is mirrored (forest)" in str(failure)


def test_instances_with_different_flaws_are_counted_apart(tmp_path: Path) -> None:
    made = Made()
    scales = made.rows([(-1, 1, 1), (1, 2, 1), (1, 2, 1), (0, 1, 1)])
    extensions = {INSTANCING: {"attributes": {"SCALE": scales}}}
    made.node(mesh=made.mesh(), extensions=extensions)
    (node,) = inspect_file(made.written(tmp_path)).nodes
    assert node.found == "of 4 instances 1 mirrored, 1 singular, 2 non-uniform"
    assert node.maps.worst_angle_deg == 90


def test_the_worst_angle_is_found_behind_a_bound_that_is_not_reached(tmp_path: Path) -> None:
    """The discs around a shear's rows reach far beyond it: the stretched instance is the worst."""
    made = Made()
    turned = (0, 0, 0.19509032201612825, 0.9807852804032304)
    places = {
        "ROTATION": made.rows([turned, (0, 0, 0, 1)], "VEC4"),
        "SCALE": made.rows([(1, 1, 1), (1, 1, 2.5)]),
    }
    extensions = {INSTANCING: {"attributes": places}}
    made.node(name="trees", mesh=made.mesh(), extensions=extensions, scale=[1, 2, 1])
    (trees,) = inspect_file(made.written(tmp_path)).nodes
    alone = [one.worst_angle_deg for one in trees.maps.each]
    assert alone[0] == pytest.approx(BY_TWO, abs=1e-6)
    assert trees.maps.worst_angle_deg == max(alone) == alone[1]


@pytest.mark.parametrize(
    ("keys", "more", "words"),
    [
        ([(1, 1, 1), (2, 2, 2)], {}, ""),
        ([(1, 1, 1), (1, 1.0000001, 1)], {}, ""),
        ([(1, 1, 1), (-1, 1, 1), (1, 2, 1)], {}, "of 3 scales over time 1 mirrored, 1 non-uniform"),
        ([(2, 2, 2), (-1, 3, 1)], {}, "1 of 3 scales over time mirrored and non-uniform"),
        ([(1, 1, 1), (0, 0, 0)], {}, "1 of 2 scales over time singular"),
        # Of a spline the tangents on both sides of a key are no keys.
        (
            [(9, 1, 1), (1, 1, 1), (-9, 1, 1), (9, 1, 1), (1, 3, 1), (0, 0, 0)],
            {"interpolation": "CUBICSPLINE"},
            "1 of 2 scales over time non-uniform",
        ),
    ],
)
def test_an_animated_scale_is_judged_by_its_keys(
    tmp_path: Path, keys: list[tuple[float, ...]], more: dict[str, str], words: str
) -> None:
    made = Made()
    made.node(name="heart", mesh=made.mesh())
    made.scaled_over_time(0, keys, **more)
    found = inspect_file(made.written(tmp_path))
    assert [node.found for node in found.flawed] == ([words] if words else [])
    assert found.nodes[0].animated == ("scale",)
    assert any("keys of an animated scale" in one for one in report((found,)).remarks)


def test_keys_that_many_channels_name_are_read_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = Made()
    nodes = [made.node(scale=[1, 1, 1]) for _ in range(5)]
    made.scaled_over_time(0, [(1, 1, 1), (1, 2, 1)])
    (animation,) = made.document["animations"]
    targets = [{"node": node, "path": "scale"} for node in nodes * 4]
    animation["channels"] = [{"sampler": 0, "target": one} for one in targets]
    read = []
    keys = animations._keys
    monkeypatch.setattr(animations, "_keys", lambda *of: read.append(of) or keys(*of))
    found = inspect_file(made.written(tmp_path))
    assert {node.found for node in found.nodes} == {"1 of 2 scales over time non-uniform"}
    assert len(read) == 1


def test_more_scales_over_time_than_a_file_may_have_are_told_of_their_node(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(carried, "MOST_SCALES", 3)
    made = Made()
    for name in "ab":
        node = made.node(name=name)
        made.scaled_over_time(node, [(1, 1, 1), (1, 2, 1), (1, 3, 1)])
    a, b = inspect_file(made.written(tmp_path)).nodes
    assert (a.found, a.unread) == ("2 of 3 scales over time non-uniform", "")
    assert b.found == "not wholly read"
    assert b.unread == "uneven scales over time are more than 3, with its own"


def test_keys_stand_under_the_node_above(tmp_path: Path) -> None:
    made = Made()
    made.node(scale=[1, 0.5, 1], children=[1])
    made.node(name="even", scale=[1, 2, 1])
    made.scaled_over_time(1, [(1, 6, 1)])
    _, even = inspect_file(made.written(tmp_path)).nodes
    assert even.maps.worst_angle_deg == pytest.approx(BY_THREE, abs=1e-6)
    assert even.found == "1 of 2 scales over time non-uniform"


@pytest.mark.parametrize(
    ("normals", "origin", "degenerate"),
    [
        (UP, NormalsFrom.FILE, 0),
        ([(0, 0, 1), (0, 0, 0), (0, 0, 0)], NormalsFrom.FILE, 2),
        ([(0, 0, 1), (float("nan"), 0, 0), (0, 0, 1)], NormalsFrom.FILE, 1),
        (None, NormalsFrom.COMPUTED, 0),
    ],
)
def test_normals_are_counted_and_their_origin_is_told(
    tmp_path: Path, normals, origin: NormalsFrom, degenerate: int
) -> None:
    made = Made()
    made.node(mesh=made.mesh(normals))
    made.node(name="no mesh")
    found = inspect_file(made.written(tmp_path))
    one, other = found.nodes
    assert (one.normals.origin, one.normals.degenerate) == (origin, degenerate)
    assert other.normals.origin is NormalsFrom.NONE
    shown = report((found,))
    assert ("bad normals" in str(shown.blocks)) == bool(degenerate)


def test_a_vertex_that_no_triangle_has_is_not_judged(tmp_path: Path) -> None:
    made = Made()
    made.node(mesh=made.mesh(UP))
    accessors = made.document["accessors"]
    extra = made.rows([*CORNERS, (9, 9, 9)]), made.rows([*UP, (0, 0, 0)])
    attributes = dict(zip(("POSITION", "NORMAL"), extra, strict=True))
    made.document["meshes"][0]["primitives"][0] = {"attributes": attributes}
    assert len(accessors) == 4
    assert inspect_file(made.written(tmp_path)).flawed == ()


def packed(folder: Path) -> Path:
    """A mesh packed by an extension that nobody reads, on a node that is stretched."""
    made = Made()
    made.node(name="part", mesh=made.mesh(), scale=[1, 2, 1])
    for view in made.document["bufferViews"]:
        packing = {"buffer": 0, "byteLength": 1, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}
        view |= {"buffer": 1, "extensions": {"EXT_meshopt_compression": packing}}
    made.document["extensionsRequired"] = made.document["extensionsUsed"] = [
        "EXT_meshopt_compression"
    ]
    fallback = {"EXT_meshopt_compression": {"fallback": True}}
    return made.written(folder, {"byteLength": len(made.content), "extensions": fallback})


def test_packed_normals_are_not_read_and_their_node_is_answered(tmp_path: Path) -> None:
    found = inspect_file(packed(tmp_path))
    (data,) = report((found,)).data["nodes"]
    assert (data["normals_from"], data["degenerate_normals"]) == ("packed", None)
    assert data["worst_angle_without_deg"] == pytest.approx(BY_TWO, abs=1e-9)
    assert any("meshopt" in one for one in report((found,)).remarks)


@pytest.mark.parametrize(
    ("flaw", "words"),
    [
        (Flaw.DEGENERATE, "1 of 1 node has normals that were not wholly read (part)"),
        (Flaw.UNREADABLE, "1 of 1 node is not wholly read (part)"),
        (Flaw.NON_UNIFORM_SCALE, "1 of 1 node is non-uniform (part)"),
        (Flaw.MIRRORED, None),
    ],
)
def test_what_was_not_read_is_no_pass_and_no_invention(
    tmp_path: Path, flaw: Flaw, words: str | None
) -> None:
    failure = report((inspect_file(packed(tmp_path)),), Chosen(fail_on=(flaw,))).failure
    assert (failure is None) == (words is None)
    assert words is None or words in str(failure)
    assert "degenerate normals" not in str(failure)


def test_one_part_that_cannot_be_read_costs_only_itself(tmp_path: Path) -> None:
    """The second primitive lacks its accessor; the first has a normal that is none."""
    made = Made()
    made.node(name="a", mesh=made.mesh([(0, 0, 1), (0, 0, 0), (0, 0, 1)]))
    made.node(name="b", scale=[-1, 1, 1])
    made.document["meshes"][0]["primitives"].append({"attributes": {"POSITION": 99}})
    found = inspect_file(made.written(tmp_path))
    assert {node.path: node.flaws for node in found.flawed} == {
        "a": (Flaw.DEGENERATE, Flaw.UNREADABLE),
        "b": (Flaw.MIRRORED,),
    }
    assert any("accessor 99 does not exist" in one for one in report((found,)).remarks)


def test_joints_that_cannot_be_read_leave_the_others_their_verdict(tmp_path: Path) -> None:
    made = Made()
    made.node(name="body", mesh=made.mesh(), skin=7)
    made.node(name="m", scale=[-1, 1, 1])
    found = inspect_file(made.written(tmp_path))
    assert {node.path: node.flaws for node in found.flawed} == {
        "body": (Flaw.UNREADABLE,),
        "m": (Flaw.MIRRORED,),
    }
    assert any("skin 7 does not exist" in one for one in report((found,)).remarks)


def test_morph_targets_are_told(tmp_path: Path) -> None:
    made = Made()
    target = {"POSITION": made.rows(CORNERS)}
    made.node(mesh=made.mesh(UP, targets=[target]))
    told = report((inspect_file(made.written(tmp_path)),))
    assert told.data["summary"]["morphed"] == 1
    assert any("morph targets" in one for one in told.remarks)


def test_each_flaw_has_its_own_number_and_the_name_of_its_worst(tmp_path: Path) -> None:
    made = Made()
    made.node(name="body", mesh=made.mesh(), skin=0)
    made.node(name="hip", scale=[1, 2, 1], children=[2])
    made.node(name="knee", rotation=[0, 0, 0.05, 0.99875], scale=[1, 1.1, 1])
    made.node(name="eye", scale=[1, 1.01, 1])
    made.document["skins"] = [{"joints": [3, 2, 1]}]
    found = report((inspect_file(made.written(tmp_path)),)).findings.found
    body = {one.rule.code: one.message for one in found if one.place == "body"}
    assert set(body) == {"NM-A01", "NM-A05"}
    assert body["NM-A01"].startswith("body: 1 of 3 joints sheared; ")
    assert body["NM-A01"].endswith("the worst is joint knee.")
    assert body["NM-A05"].startswith("body: 2 of 3 joints non-uniform; ")
    assert "up to 36.87° off; the worst is joint hip." in body["NM-A05"]


def test_instances_and_keys_are_named(tmp_path: Path) -> None:
    made = Made()
    scales = made.rows([(1, 1, 1), (1, 2, 1), (1, 3, 1)])
    instances = {INSTANCING: {"attributes": {"SCALE": scales}}}
    made.node(name="many", mesh=made.mesh(), extensions=instances)
    made.scaled_over_time(made.node(name="beat"), [(1, 1, 1), (2, 4, 2), (1, 1.5, 1)])
    found = report((inspect_file(made.written(tmp_path)),)).findings.found
    told = {one.place: one.message for one in found}
    assert told["many"].endswith("up to 53.13° off; the worst is instance 2.")
    assert told["beat"].endswith("up to 36.87° off; the worst is scale 2 4 2.")


def test_pictures_and_plans_tell_of_joints_that_bend_normals(tmp_path: Path, nmatrix) -> None:
    for scale, told in (([1, 2, 1], True), ([2, 2, 2], False)):
        made = Made()
        weights = made.rows([(1, 0, 0, 0)] * 3, "VEC4")
        made.node(name="body", mesh=made.mesh(), skin=0)
        made.node(name="hip", scale=scale)
        (primitive,) = made.document["meshes"][0]["primitives"]
        primitive["attributes"] |= {"WEIGHTS_0": weights, "JOINTS_0": made.joints(3)}
        made.document["skins"] = [{"joints": [1]}]
        file = made.written(tmp_path)
        for line in (f"plan {file}", f"render {file} --size 8 8 --force -o {tmp_path / 'a.png'}"):
            answer = nmatrix(f"{line} -f json")
            assert answer.code == 0, answer.err
            said = "Of 1 joints 1 needs" in " ".join(answer.data["remarks"])
            assert said == told


@pytest.mark.parametrize(("zeros", "words"), [(1, "1 normal is"), (2, "2 normals are")])
def test_degenerate_normals_are_counted_in_a_right_sentence(
    tmp_path: Path, zeros: int, words: str
) -> None:
    made = Made()
    made.node(name="a", mesh=made.mesh([(0, 0, 0)] * zeros + UP[zeros:]))
    (node,) = inspect_file(made.written(tmp_path)).nodes
    assert node.told(Flaw.DEGENERATE) == f"a: {words} no direction; the first at 0 0 0."
