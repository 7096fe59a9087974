"""glTF primitives at rest: flat, shared, morphed, skinned, instanced, packed; each by itself."""

from __future__ import annotations

import json
import sys
from fractions import Fraction
from pathlib import Path
from types import ModuleType, SimpleNamespace

import numpy as np
import pytest
from gltf_files import Made

from nmatrix.errors import IllegalValueError, MissingPackageError
from nmatrix.linear.rational import product, rational_matrix, to_floats
from nmatrix.raster.loaded_scene import loaded
from nmatrix.scene.geometry import DamagedPartError
from nmatrix.scene.gltf.animations import Animated, animated_channels, animated_scales
from nmatrix.scene.gltf.extensions import INSTANCING
from nmatrix.scene.gltf.instances import MOST, instance_matrices
from nmatrix.scene.gltf.meshes import mesh_normals, primitive_mesh
from nmatrix.scene.gltf.primitives import SPARE_CORNERS, Pose
from nmatrix.scene.gltf.scene import gltf_scene
from nmatrix.scene.gltf.skins import joint_matrices
from nmatrix.scene.words import NormalsFrom

SQUARE = [[0.0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]]
CORNERS = [0, 1, 2, 0, 2, 3]
UP = [[0.0, 0, 1]] * 4
CUBE = np.array([[x, y, z] for x in (-1.0, 1) for y in (-1.0, 1) for z in (-1.0, 1)])
SIDES = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
CUBE_CORNERS = [i for a, b, c, d in SIDES for i in (a, b, c, a, c, d)]


def square(made: Made, **attributes: int) -> dict[str, object]:
    """Return a primitive of two triangles with normals."""
    return {
        "attributes": {"POSITION": made.add(SQUARE), "NORMAL": made.add(UP), **attributes},
        "indices": made.add(CORNERS, "u1"),
    }


def meshes(*primitives: dict[str, object], **mesh: object) -> list[dict[str, object]]:
    return [{"primitives": list(primitives), **mesh}]


def test_a_cube_without_normals_has_six_flat_sides_and_says_so(tmp_path: Path) -> None:
    made = Made()
    uv = CUBE[:, :2] / 2 + 0.5
    attributes = {
        "POSITION": made.add(CUBE),
        "TEXCOORD_0": made.add(uv),
        "COLOR_0": made.add(np.abs(CUBE)),
        "TANGENT": made.add([[float("nan"), 0, 0, 1]] * 8),
    }
    primitive = {"attributes": attributes, "indices": made.add(CUBE_CORNERS, "u2")}
    file = made.file(tmp_path, meshes=meshes(primitive))
    mesh = primitive_mesh(file, 0, 0)
    assert len(mesh.positions) == 36
    for triangle in mesh.triangles:
        a, b, c = mesh.positions[triangle]
        outward = np.cross(b - a, c - a)
        outward /= np.linalg.norm(outward)
        assert (mesh.normals[triangle] == outward).all()
        assert np.dot(outward, a + b + c) > 0
    assert len(np.unique(mesh.normals, axis=0)) == 6
    assert (mesh.positions == CUBE[CUBE_CORNERS]).all()
    assert (mesh.uv == uv[CUBE_CORNERS] * (1, -1) + (0, 1)).all()
    assert mesh.colours.shape == (36, 3)
    assert mesh.tangents is None  # 3.7.2.1: they are ignored where normals are made
    assert mesh.remarks == ("Flat normals were made where made.gltf has none.",)
    found = mesh_normals(file, 0)
    assert (found.origin, found.degenerate) == (NormalsFrom.COMPUTED, 0)
    assert found.remarks == mesh.remarks


def test_vertices_that_no_triangle_refers_to_are_not_looked_at(tmp_path: Path) -> None:
    made = Made()
    nothing = [float("nan")] * 3
    attributes = {
        "POSITION": made.add([nothing, *SQUARE, nothing]),
        "NORMAL": made.add([[0.0, 0, 0], *UP, nothing]),
    }
    indices = made.add(np.array(CORNERS) + 1, "u1")
    file = made.file(tmp_path, meshes=meshes({"attributes": attributes, "indices": indices}))
    mesh = primitive_mesh(file, 0, 0)
    assert mesh.positions.tolist() == SQUARE
    assert mesh.triangles.ravel().tolist() == CORNERS
    found = mesh_normals(file, 0)
    assert (found.origin, found.degenerate, found.remarks) == (NormalsFrom.FILE, 0, ())


@pytest.mark.parametrize("spare", [0, 1, 1000])
def test_only_the_vertices_that_triangles_refer_to_are_kept(tmp_path: Path, spare: int) -> None:
    """Few of many are found by sorting corners, many of few by marking vertices."""
    made = Made()
    random = np.random.default_rng(3)
    points = random.normal(size=(9 + spare, 3)).astype(np.float32)
    corners = random.permutation(9 + spare)[:9]
    attributes = {"POSITION": made.add(points), "NORMAL": made.add(points)}
    primitive = {"attributes": attributes, "indices": made.add(corners, "u2")}
    mesh = primitive_mesh(made.file(tmp_path, meshes=meshes(primitive)), 0, 0)
    assert len(mesh.positions) == 9
    assert (mesh.positions[mesh.triangles.ravel()] == points[corners]).all()


def test_a_normal_that_is_not_finite_counts_as_none(tmp_path: Path) -> None:
    made = Made()
    one = square(made)
    one["attributes"]["NORMAL"] = made.add([[0.0, 0, 1], [0, float("inf"), 0], *UP[2:]])
    file = made.file(tmp_path, meshes=meshes(one, name="Wheel"))
    mesh = primitive_mesh(file, 0, 0)
    assert mesh.normals.tolist() == [[0, 0, 1], [0, 0, 0], [0, 0, 1], [0, 0, 1]]
    assert mesh_normals(file, 0).degenerate == 1
    told = "1 normal is not finite, first that of vertex 1, and taken as none."
    assert mesh.remarks == (f"mesh 0 (Wheel), primitive 0: {told}",)


def test_a_primitive_at_fault_costs_only_itself(tmp_path: Path) -> None:
    made = Made()
    good, bad = square(made), square(made)
    bad["indices"] = made.add([0, 1, 70], "u1")
    gone = square(made)
    gone["attributes"]["NORMAL"] = 99
    file = made.file(
        tmp_path, nodes=[{"mesh": 0}], meshes=meshes(good, bad, gone, gone, name="Wheel")
    )
    scene = loaded(gltf_scene(file.path))
    assert [body.name for body in scene.bodies] == ["node 0"]
    told = "mesh 0 (Wheel), primitive 1 is not drawn: its index 70 is beyond 4 vertices."
    assert told in scene.remarks
    found = mesh_normals(file, 0)
    assert found.origin is NormalsFrom.FILE
    assert [one.part for one in found.faults] == [
        f"mesh 0 (Wheel), primitive {i}" for i in (1, 2, 3)
    ]
    assert found.faults[1].reason == "accessor 99 does not exist"


def test_where_nothing_can_be_drawn_the_first_fault_is_the_error(tmp_path: Path) -> None:
    made = Made()
    bad = {"attributes": {"POSITION": 7}}
    file = made.file(tmp_path, nodes=[{"mesh": 0}], meshes=meshes(bad))
    with pytest.raises(DamagedPartError, match=r"\(mesh 0, primitive 0\): accessor 7 does not exi"):
        loaded(gltf_scene(file.path))


def test_primitives_of_the_same_accessors_are_read_once(tmp_path: Path) -> None:
    made = Made()
    one = square(made)
    file = made.file(
        tmp_path,
        nodes=[{"mesh": 0}, {"mesh": 1}],
        meshes=meshes(one, {**one, "material": 0}) + meshes(one),
        materials=[{}],
    )
    scene = loaded(gltf_scene(file.path))
    assert len({id(body.mesh) for body in scene.bodies}) == 1
    assert len(scene.bodies) == 3


def test_corners_beyond_the_bytes_of_a_file_are_not_drawn(tmp_path: Path) -> None:
    """Accessors that lie over one another would make a small file fill the memory."""
    made = Made()
    count = 3 * (SPARE_CORNERS // 12)
    positions = made.add(SQUARE)
    view = made.view(bytes(2 * count))
    primitives = []
    for i in range(8):
        record = {"bufferView": view, "componentType": 5121, "type": "SCALAR"}
        made.accessors.append({**record, "byteOffset": i, "count": count})
        attributes = {"POSITION": positions}
        primitives.append({"attributes": attributes, "indices": len(made.accessors) - 1})
    file = made.file(tmp_path, meshes=meshes(*primitives))
    assert len(primitive_mesh(file, 0, 0).triangles) == count // 3
    with pytest.raises(DamagedPartError, match=f"{count:,} corners are more than the file has"):
        primitive_mesh(file, 0, 7)


@pytest.mark.parametrize("of_node", [None, [0.0, 0.25], [0.0, 0.0]])
def test_morph_targets_stand_at_their_weights(tmp_path: Path, of_node: list[float] | None) -> None:
    made = Made()
    random = np.random.default_rng(1)
    deltas = random.integers(-8, 8, (2, 3, 4, 3)) / 8.0
    tangents = np.array([[1.0, 0, 0, -1]] * 4)
    one = square(made, TANGENT=made.add(tangents))
    names = ("POSITION", "NORMAL", "TANGENT")
    one["targets"] = [
        {name: made.add(delta) for name, delta in zip(names, target, strict=True)}
        for target in deltas
    ]
    node = {"mesh": 0} if of_node is None else {"mesh": 0, "weights": of_node}
    file = made.file(tmp_path, nodes=[node], meshes=meshes(one, weights=[1.0, 0.5]))
    (body,) = loaded(gltf_scene(file.path)).bodies
    weights = np.array([1.0, 0.5] if of_node is None else of_node)
    moved = np.tensordot(weights, deltas, 1)
    assert (body.mesh.positions == np.array(SQUARE) + moved[0]).all()
    normals = np.array(UP) + moved[1]
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    assert np.abs(body.mesh.normals - normals).max() < 1e-15
    assert (body.mesh.tangents[:, :3] == tangents[:, :3] + moved[2]).all()
    assert (body.mesh.tangents[:, 3] == -1).all()


def skinned(made: Made, *, sets: int = 1, mirrored: bool = False) -> dict[str, object]:
    """Return the parts of a file whose square is carried by three joints, one under another."""
    random = np.random.default_rng(7)
    attributes = {}
    for number in range(sets):
        joints = random.integers(0, 3, (4, 4))
        attributes[f"JOINTS_{number}"] = made.add(joints, "u1")
        weights = random.random((4, 4)) / (sets * 2)
        attributes[f"WEIGHTS_{number}"] = made.add(weights)
    binds = np.array([np.eye(4)] * 3)
    binds[:, :3] = random.integers(-4, 4, (3, 3, 4)) / 4 + np.eye(4)[:3] * 8
    turned = {"rotation": [0.0, 0.6, 0.0, 0.8], "scale": [1, 3, -1 if mirrored else 1]}
    return {
        "nodes": [
            {"mesh": 0, "skin": 0, "scale": [1, 2, 1], "name": "body"},
            {"translation": [1, 2, 3], "children": [2], **turned},
            {"rotation": [0.8, 0.0, 0.0, 0.6], "children": [3]},
            {"matrix": [1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 4, 0, 1]},
        ],
        "skins": [{"joints": [3, 1, 2], "inverseBindMatrices": made.add(binds)}],
        "meshes": meshes(square(made, TANGENT=made.add([[1.0, 0, 0, 1]] * 4), **attributes)),
    }


@pytest.mark.parametrize("mirrored", [False, True])
@pytest.mark.parametrize("sets", [1, 2])
def test_a_skinned_mesh_stands_where_its_joints_take_it(
    tmp_path: Path, sets: int, mirrored: bool
) -> None:
    """The blend is computed here vertex by vertex; the node's own scale does not count."""
    made = Made()
    file = made.file(tmp_path, **skinned(made, sets=sets, mirrored=mirrored))
    worlds = [np.array(to_floats(node.world_from_object)) for node in file.nodes]
    read = file.kept.accessors
    (body,) = loaded(gltf_scene(file.path)).bodies
    assert body.world_from_object.exact == rational_matrix(np.eye(4).tolist())
    mesh = primitive_mesh(file, 0, 0, Pose(skin=0))
    assert (mesh.positions == body.mesh.positions).all()
    attributes = file.document.meshes[0].primitives[0].attributes
    binds = read[file.document.skins[0].inverse_bind_matrices].floats()
    for vertex in range(4):
        blend, total = np.zeros((4, 4)), 0.0
        for number in range(sets):
            joints = read[attributes[f"JOINTS_{number}"]].floats()[vertex]
            weights = read[attributes[f"WEIGHTS_{number}"]].floats()[vertex]
            for joint, weight in zip(joints.astype(int), weights, strict=True):
                blend += weight * worlds[[3, 1, 2][joint]] @ binds[joint]
                total += weight
        blend /= total
        place = blend @ [*SQUARE[vertex], 1]
        assert np.abs(mesh.positions[vertex] - place[:3]).max() < 1e-12
        normal = np.linalg.inv(blend[:3, :3]).T @ [0, 0, 1]
        assert np.abs(mesh.normals[vertex] - normal / np.linalg.norm(normal)).max() < 1e-12
        tangent = blend[:3, 0] / np.linalg.norm(blend[:3, 0])
        assert np.abs(mesh.tangents[vertex, :3] - tangent).max() < 1e-12
        assert mesh.tangents[vertex, 3] == (-1 if np.linalg.det(blend) < 0 else 1)
        assert (np.linalg.det(blend) < 0) == mirrored
    for triangle in mesh.triangles:  # its front is where its normals point
        a, b, c = mesh.positions[triangle]
        assert np.dot(np.cross(b - a, c - a), mesh.normals[triangle].sum(axis=0)) > 0


def test_joint_matrices_are_exact_products(tmp_path: Path) -> None:
    made = Made()
    file = made.file(tmp_path, **skinned(made))
    found = joint_matrices(file, 0)
    binds = np.frombuffer(made.content[: 3 * 64], "<f4").reshape(3, 4, 4)
    at = file.document.accessors[file.document.skins[0].inverse_bind_matrices]
    start = file.document.buffer_views[at.buffer_view].byte_offset
    binds = np.frombuffer(made.content, "<f4", 48, start).reshape(3, 4, 4).swapaxes(1, 2)
    for joint, bind, matrix in zip([3, 1, 2], binds.tolist(), found, strict=True):
        assert matrix == product(file.nodes[joint].world_from_object, rational_matrix(bind))
        assert all(isinstance(entry, Fraction) for row in matrix for entry in row)
    assert joint_matrices(file, 0) is found


def test_joints_without_bind_matrices_are_where_their_nodes_are(tmp_path: Path) -> None:
    made = Made()
    parts = skinned(made)
    parts["skins"] = [{"joints": [2]}]
    file = made.file(tmp_path, **parts)
    assert joint_matrices(file, 0) == (file.nodes[2].world_from_object,)


def test_what_of_a_skin_counts_is_told(tmp_path: Path) -> None:
    made = Made()
    scene = loaded(gltf_scene(made.file(tmp_path, **skinned(made)).path))
    told = "Joints carry the meshes of nodes whose own transforms do not count: body."
    assert told in scene.remarks
    assert any("weights of 4 vertices were brought to a sum of 1" in text for text in scene.remarks)
    made = Made()
    parts = skinned(made)
    attributes = parts["meshes"][0]["primitives"][0]["attributes"]
    del attributes["JOINTS_0"]
    scene = loaded(gltf_scene(made.file(tmp_path, **parts).path))
    assert scene.bodies[0].mesh.positions.tolist() == SQUARE
    told = "mesh 0, primitive 0 has a skin and no joints: it stands as it was modelled."
    assert told in scene.remarks


def test_a_vertex_without_weights_follows_its_first_joint(tmp_path: Path) -> None:
    made = Made()
    joints = made.add([[1, 0, 0, 0]] * 4, "u1")
    weights = made.add([[0, 0, 0, 0], *[[0, 255, 0, 0]] * 3], "u1", normalized=True)
    file = made.file(
        tmp_path,
        nodes=[{"mesh": 0, "skin": 0}, {"translation": [5, 0, 0]}, {"translation": [0, 7, 0]}],
        skins=[{"joints": [1, 2]}],
        meshes=meshes(square(made, JOINTS_0=joints, WEIGHTS_0=weights)),
    )
    mesh = primitive_mesh(file, 0, 0, Pose(skin=0))
    assert mesh.positions.tolist() == [[0, 7, 0], [6, 0, 0], [6, 1, 0], [5, 1, 0]]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"skins": []}, "skin 0 does not exist"),
        ({"skins": [{"joints": [9]}]}, "skins[0].joints[0]: joint 9 does not exist"),
        ({"skins": [{"joints": [-1]}]}, "joint -1 does not exist"),
        ({"skins": [{"joints": []}]}, "and skin 0 has 0 joints"),
        ({"skins": [{"joints": [1]}]}, "a vertex follows joint 2, and skin 0 has 1 joint"),
        (
            {"skins": [{"joints": [1, 2, 3, 1], "inverseBindMatrices": 2}]},
            "the inverse bind matrices of skin 0 are 3, and it has 4 joints",
        ),
        (
            {"skins": [{"joints": [1, 2, 3], "inverseBindMatrices": 0}]},
            "the inverse bind matrices of skin 0 (accessor 0) is of type VEC4 and has to be MAT4",
        ),
    ],
)
def test_a_skin_at_fault_costs_the_primitives_that_it_carries(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    made = Made()
    file = made.file(tmp_path, **(skinned(made) | changes))
    with pytest.raises(DamagedPartError) as caught:
        primitive_mesh(file, 0, 0, Pose(skin=0))
    assert words in str(caught.value)
    assert mesh_normals(file, 0).origin is NormalsFrom.FILE


def instanced(made: Made, **attributes: int) -> dict[str, object]:
    return {
        "nodes": [
            {"translation": [0, 0, 9], "scale": [1, 2, 1], "children": [1]},
            {"mesh": 0, "name": "forest", "extensions": {INSTANCING: {"attributes": attributes}}},
        ],
        "meshes": meshes(square(made)),
        "extensionsUsed": [INSTANCING],
    }


def test_instances_stand_under_their_node_exactly(tmp_path: Path) -> None:
    """T · R · S multiplied here, with a quaternion of 8-bit integers that has no length one."""
    made = Made()
    turns = [[127, 0, 0, 127], [0, 0, 0, 64], [-128, 0, 0, 0]]
    parts = instanced(
        made,
        TRANSLATION=made.add([[1.0, 2, 3], [0, 0, 0], [0.5, 0, 0]]),
        ROTATION=made.add(turns, "i1", normalized=True),
        SCALE=made.add([[1.0, 2, 3], [-1, 1, 1], [2, 2, 2]]),
    )
    file = made.file(tmp_path, **parts)
    half = [[1, 0, 0, 1], [0, 0, -3, 2], [0, 2, 0, 3], [0, 0, 0, 1]]  # 90° about x
    mirror = [[-1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
    around = [[2, 0, 0, 0.5], [0, -2, 0, 0], [0, 0, -2, 0], [0, 0, 0, 1]]  # 180° about x
    above = file.nodes[1].world_from_object
    expected = tuple(product(above, rational_matrix(one)) for one in (half, mirror, around))
    assert instance_matrices(file, 1) == expected
    assert instance_matrices(file, 0) == (file.nodes[0].world_from_object,)
    scene = gltf_scene(file.path)
    assert [one.name for one in scene.objects] == ["forest", "forest 2", "forest 3"]
    assert tuple(one.world_from_object for one in scene.objects) == expected
    assert not any("Extensions" in text for text in scene.remarks)


@pytest.mark.parametrize(
    ("attributes", "words"),
    [
        ({}, "its instances are none; they are alike in number"),
        ({"TRANSLATION": 0, "SCALE": 1}, "its instances are 2 of TRANSLATION, 1 of SCALE; they"),
        ({"TRANSLATION": 2}, "TRANSLATION of instances (accessor 2) is of type VEC4 and has to"),
        ({"TRANSLATION": 77}, "accessor 77 does not exist"),
        ({"ROTATION": 2}, "instance 0: quaternion (0 0 0 0): it has no direction"),
    ],
)
def test_instances_that_cannot_be_read_cost_their_node(
    tmp_path: Path, attributes: dict[str, int], words: str
) -> None:
    made = Made()
    made.add([[0.0, 0, 0]] * 2)
    made.add([[1.0, 1, 1]])
    made.add([[0.0, 0, 0, 0]])
    parts = instanced(made, **attributes)
    parts["nodes"].append({"mesh": 0, "name": "tree"})
    file = made.file(tmp_path, **parts)
    with pytest.raises(IllegalValueError) as caught:
        instance_matrices(file, 1)
    assert words in str(caught.value)
    scene = loaded(gltf_scene(file.path))
    assert [body.name for body in scene.bodies] == ["tree"]
    assert any(f"node 1 (forest) is not drawn: {words}" in text for text in scene.remarks)


def test_instances_are_counted_over_the_whole_file(tmp_path: Path) -> None:
    """Nodes may share the places of their instances, which take bytes only once."""
    made = Made()
    made.accessors.append({"componentType": 5126, "count": MOST - 1, "type": "VEC3"})
    two = made.add([[0.0, 0, 0]] * 2)
    parts = instanced(made, TRANSLATION=two)
    parts["nodes"] += [{"mesh": 0, "extensions": {INSTANCING: {"attributes": {"TRANSLATION": 0}}}}]
    file = made.file(tmp_path, **parts)
    for _ in range(2):
        assert len(instance_matrices(file, 1)) == 2
        with pytest.raises(IllegalValueError, match=f"{MOST - 1:,} instances the file has more"):
            instance_matrices(file, 2)


def test_a_scene_of_too_many_objects_is_refused_before_they_are_made(tmp_path: Path) -> None:
    made = Made()
    one = square(made)
    file = made.file(tmp_path, nodes=[{"mesh": 0}] * 1000, meshes=meshes(*[one] * 1000), scenes=[])
    scene = gltf_scene(file.path)
    with pytest.raises(IllegalValueError, match="has 1000000 objects, and 262144 are drawn at mo"):
        loaded(scene)
    assert len(scene.nodes) == 1000


def test_animations_tell_what_moves_and_the_scales_at_their_keys(tmp_path: Path) -> None:
    made = Made()
    times = made.add([0.0, 1])
    plain = made.add([[1.0, 1, 1], [1, 2, 1]])
    spline = made.add([[9.0, 9, 9], [3, 3, 3], [9, 9, 9], [9, 9, 9], [-1, 1, 1], [9, 9, 9]])
    samplers = [
        {"input": times, "output": plain},
        {"input": times, "output": spline, "interpolation": "CUBICSPLINE"},
        {"input": times, "output": 99},
    ]
    moves = [(0, 0, "scale"), (1, 0, "scale"), (0, 1, "translation"), (2, 1, "scale")]
    moves += [(0, 1, "weights"), (0, 7, "rotation"), (0, 0, "pointer")]
    channels = [{"sampler": s, "target": {"node": n, "path": path}} for s, n, path in moves]
    channels.append({"sampler": 0, "target": {"path": "scale"}})
    animations = [{"channels": channels, "samplers": samplers}]
    file = made.file(tmp_path, nodes=[{}, {}], animations=animations)
    moved = {Animated.TRANSLATION, Animated.SCALE, Animated.WEIGHTS}
    assert animated_channels(file) == {0: {Animated.SCALE}, 1: moved}
    found = animated_scales(file)
    assert {n: set(keys) for n, keys in found.keys.items()} == {
        0: {(1, 1, 1), (1, 2, 1), (3, 3, 3), (-1, 1, 1)}
    }
    told = "Scales of animation 0 are not read: accessor 99 does not exist."
    assert found.remarks == (told,)


def packed(made: Made, *, fallback: bool = False) -> dict[str, object]:
    """Return a primitive whose attributes Draco packed under the numbers 5 and 3."""
    one = square(made, COLOR_0=made.add([[255, 0, 51]] * 4, "u1", normalized=True))
    numbers = {"POSITION": 5, "NORMAL": 3, "COLOR_0": 8}
    view = made.view(b"DRACO and more")
    extension = {"bufferView": view, "attributes": numbers}
    one["extensions"] = {"KHR_draco_mesh_compression": extension}
    for record in made.accessors:
        if not fallback:
            del record["bufferView"]
    return one


def decoder(monkeypatch: pytest.MonkeyPatch, decode: object) -> None:
    """Put a module in the place of DracoPy."""
    module = ModuleType("DracoPy")
    module.decode = decode
    monkeypatch.setitem(sys.modules, "DracoPy", module)


def test_what_draco_packed_is_read_by_the_numbers_of_its_attributes(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    given = []

    def decode(content: bytes) -> SimpleNamespace:
        given.append(content)
        data = {5: np.array(SQUARE, np.float32), 3: np.array(UP), 8: np.array([[255, 0, 51]] * 4)}
        listed = [{"unique_id": n, "data": rows} for n, rows in data.items()]
        listed[2]["data"] = listed[2]["data"].astype(np.uint8)
        return SimpleNamespace(attributes=listed, faces=np.array(CORNERS).reshape(-1, 3))

    decoder(monkeypatch, decode)
    made = Made()
    file = made.file(tmp_path, meshes=meshes(packed(made)))
    mesh = primitive_mesh(file, 0, 0)
    assert given == [b"DRACO and more"]
    assert mesh.positions.tolist() == SQUARE
    assert mesh.triangles.ravel().tolist() == CORNERS
    assert mesh.colours.tolist() == [[1, 0, 0.2]] * 4
    assert mesh_normals(file, 0).origin is NormalsFrom.FILE


def test_without_its_package_what_draco_packed_is_told_and_not_made_up(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    made = Made()
    file = made.file(tmp_path, nodes=[{"mesh": 0}], meshes=meshes(packed(made)))
    found = mesh_normals(file, 0)
    assert (found.origin, found.degenerate, found.packing) == (NormalsFrom.PACKED, 0, "Draco")
    assert "(pip install 'dracopy>=" in found.faults[0].reason
    with pytest.raises(MissingPackageError, match=r"packed by Draco.*pip install 'dracopy"):
        loaded(gltf_scene(file.path))


def test_a_primitive_that_lies_unpacked_beside_is_read_from_there(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "DracoPy", None)
    made = Made()
    file = made.file(tmp_path, meshes=meshes(packed(made, fallback=True)))
    assert primitive_mesh(file, 0, 0).positions.tolist() == SQUARE


def fails(content: bytes) -> None:
    raise ValueError(content)


@pytest.mark.parametrize(
    ("decode", "words"),
    [
        (fails, "buffer view 0 is no mesh of Draco's"),
        (
            lambda _: SimpleNamespace(attributes=[], faces=np.zeros((1, 3))),
            "its Draco bytes have no attribute 5, meant for POSITION",
        ),
        (
            lambda _: SimpleNamespace(
                attributes=[{"unique_id": i, "data": np.zeros((4, 2))} for i in (5, 3, 8)],
                faces=np.zeros((1, 3)),
            ),
            "POSITION has 2 components in Draco's bytes",
        ),
    ],
)
def test_bytes_that_are_not_dracos_cost_their_primitive(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, decode: object, words: str
) -> None:
    decoder(monkeypatch, decode)
    made = Made()
    primitive = json.loads(json.dumps(packed(made)))
    with pytest.raises(DamagedPartError) as caught:
        primitive_mesh(made.file(tmp_path, meshes=meshes(primitive)), 0, 0)
    assert words.split("view 0")[-1] in str(caught.value)


def test_primitives_without_triangles_are_counted_by_what_they_are(tmp_path: Path) -> None:
    made = Made()
    one = square(made)
    others = [{**one, "mode": mode} for mode in (0, 1, 2, 3, 9)]
    file = made.file(tmp_path, nodes=[{"mesh": 0}], meshes=meshes(one, *others, {"attributes": {}}))
    told = "1 of points, 3 of lines, 1 of an unknown mode, 1 without positions"
    assert f"Primitives that are not drawn: {told}." in gltf_scene(file.path).remarks
