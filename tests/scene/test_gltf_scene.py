"""glTF files as scenes: nodes, cameras, lights, materials, and a sentence for what is not drawn."""

from __future__ import annotations

import json
from base64 import b64encode
from dataclasses import replace
from math import cos, degrees, pi, sin
from pathlib import Path
from struct import pack

import numpy as np
import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import identity, product, to_floats
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import planned
from nmatrix.raster.render import render
from nmatrix.scene.camera import View
from nmatrix.scene.chosen import setup_of
from nmatrix.scene.gltf.scene import gltf_scene
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import Texture
from nmatrix.scene.open import scene_of
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind, Sides

TRIANGLE = pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)


def made(folder: Path, **changes: object) -> Scene:
    """Return the scene of one triangle with these parts of the file changed."""
    document: dict[str, object] = {
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0, "name": "one"}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [
            {
                "bufferView": 0,
                "componentType": 5126,
                "count": 3,
                "type": "VEC3",
                "min": [0, 0, 0],
                "max": [1, 1, 0],
            }
        ],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [buffer(TRIANGLE)],
    } | changes
    path = folder / "made.gltf"
    path.write_text(json.dumps(document))
    return gltf_scene(path)


def buffer(content: bytes) -> dict[str, object]:
    uri = f"data:application/octet-stream;base64,{b64encode(content).decode()}"
    return {"byteLength": len(content), "uri": uri}


def lit(*lights: dict[str, object], **node: object) -> dict[str, object]:
    carriers = [
        {"extensions": {"KHR_lights_punctual": {"light": i}}, **node} for i in range(len(lights))
    ]
    return {
        "nodes": [{"mesh": 0}, *carriers],
        "scenes": [{"nodes": list(range(len(lights) + 1))}],
        "extensions": {"KHR_lights_punctual": {"lights": list(lights)}},
        "extensionsUsed": ["KHR_lights_punctual"],
    }


def test_every_file_is_a_scene_with_triangles(data: Path) -> None:
    for path in sorted((data / "gltf").glob("**/*.gl*")):
        scene = gltf_scene(path)
        names = [one.name for one in scene.objects]
        assert len(set(names)) == len(names), path.name
        assert len(scene.objects[0].geometry.mesh().triangles) > 0
        assert all(text.endswith(".") and "\n" not in text for text in scene.remarks)


def test_every_odd_file_is_a_scene_or_is_refused_in_one_line(data: Path) -> None:
    refused = 0
    for path in sorted((data / "meshes" / "odd").iterdir()):
        try:
            for one in scene_of(path).objects:
                one.geometry.mesh()
        except IllegalValueError as error:
            assert "\n" not in str(error), path.name
            refused += 1
    assert refused >= 4


def test_nodes_stand_where_three_js_puts_them(data: Path) -> None:
    compared = 0
    scenes: dict[str, dict[str, object]] = {}
    for record in json.loads((data / "golden_gltf_nodes.json").read_text()):
        name, args = record["args"]["file"], record["args"]
        if not args["name"] or args["mesh"] is None:
            continue
        if name not in scenes:
            found = gltf_scene(data / "gltf" / name)
            worlds = (one.world_from_object for one in found.nodes)
            scenes[name] = dict(zip(found.hierarchy.addresses, worlds, strict=True))
        if args["name"] in scenes[name]:
            ours = np.array(to_floats(scenes[name][args["name"]]))  # type: ignore[arg-type]
            theirs = np.array(record["result"]["W"])
            assert np.abs(ours - theirs).max() <= 1e-3 * np.abs(theirs).max()
            compared += 1
    assert compared > 50


def test_a_camera_undoes_its_node(data: Path) -> None:
    file = "Cameras/glTF-Embedded/Cameras.gltf"
    scene = gltf_scene(data / "gltf" / file)
    for record in json.loads((data / "golden_gltf_nodes.json").read_text()):
        if record["args"]["file"] == file and record["args"]["camera"] == 0:
            view = np.array(to_floats(scene.view.placed().camera_from_world))
            assert np.abs(view @ np.array(record["result"]["W"]) - np.eye(4)).max() < 1e-12
    assert scene.has_camera
    assert scene.lens.fov_degrees == pytest.approx(degrees(0.7))
    assert (scene.lens.near, scene.lens.far) == (0.01, 100)
    assert "Of 2 cameras the first is used." in scene.remarks


def test_a_cameras_scale_does_not_matter(tmp_path: Path) -> None:
    turned = {"rotation": [0, sin(pi / 8), 0, cos(pi / 8)], "translation": [1, 2, 3]}
    box = {"xmag": 2, "ymag": 1, "znear": 0, "zfar": 9}
    camera = {"type": "orthographic", "orthographic": box}
    scenes = [
        made(
            tmp_path,
            nodes=[{"mesh": 0}, {"camera": 0, **turned, **scale}],
            scenes=[{"nodes": [0, 1]}],
            cameras=[camera],
        )
        for scale in ({}, {"scale": [2, 3, 4]})
    ]
    views = [np.array(to_floats(scene.view.placed().camera_from_world)) for scene in scenes]
    assert np.abs(views[0] - views[1]).max() < 1e-15
    assert scenes[0].lens.ortho is not None
    assert scenes[0].settings.size == (512, 256)


def test_an_infinite_camera(tmp_path: Path) -> None:
    camera = {"type": "perspective", "perspective": {"yfov": 1.0, "znear": 0.5}}
    scene = made(tmp_path, nodes=[{"mesh": 0, "camera": 0}], cameras=[camera])
    assert scene.lens.far == float("inf")


def test_lights_of_the_light(data: Path) -> None:
    path = data / "gltf/LightsPunctualLamp/glTF/LightsPunctualLamp.gltf"
    scene, raw = gltf_scene(path), json.loads(path.read_text())
    stored = raw["extensions"]["KHR_lights_punctual"]["lights"]
    assert len(scene.lights) == len(stored) == 5
    brightest = max(one["intensity"] for one in stored)
    by_name = {one["name"]: one for one in stored}
    for light in scene.lights:
        assert light.kind is LightKind.POINT
        assert light.intensity == by_name[light.name]["intensity"] / brightest
        assert light.color == tuple(by_name[light.name].get("color", (1, 1, 1)))
    assert max(light.intensity for light in scene.lights) == 1
    assert "Intensities of light are relative: the brightest light is 1." in scene.remarks


def test_light_travels_along_minus_z_of_its_node(tmp_path: Path) -> None:
    down = {"rotation": [-sin(pi / 4), 0, 0, cos(pi / 4)], "translation": [0, 4, 0]}
    spot = {"innerConeAngle": pi / 8, "outerConeAngle": pi / 4}
    scene = made(
        tmp_path,
        **lit(
            {"type": "directional", "name": "sun", "intensity": 3},
            {"type": "spot", "spot": spot, "range": 7, "intensity": 6, "color": [1, 0.5, 0]},
            **down,
        ),
    )
    sun, light = scene.lights
    assert sun.direction == pytest.approx((0, -1, 0), abs=1e-15)
    assert (sun.intensity, sun.attenuation) == (0.5, (1, 0, 0))
    assert light.direction == pytest.approx((0, -1, 0), abs=1e-15)
    assert light.position == (0, 4, 0)
    assert light.cone_degrees == pytest.approx((22.5, 45))
    assert (light.range, light.color) == (7, (1, 0.5, 0))
    # half the diagonal of the triangle's box is 1/√2, so q = 1/r² = 2
    assert light.attenuation == pytest.approx((1, 0, 2))


def test_materials(tmp_path: Path) -> None:
    (tmp_path / "a b.png").write_bytes(b"")
    material = {
        "name": "glass",
        "pbrMetallicRoughness": {
            "baseColorFactor": [1, 0.5, 0, 0.25],
            "baseColorTexture": {"index": 0},
        },
        "normalTexture": {"index": 1},
        "alphaMode": "BLEND",
        "doubleSided": True,
        "emissiveFactor": [1, 0, 0],
    }
    scene = made(
        tmp_path,
        meshes=[{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        materials=[material],
        textures=[{"source": 0}, {"source": 1}, {"source": 2}],
        images=[{"uri": "a%20b.png"}, {"uri": "none.png"}, {"uri": "data:image/png;base64,"}],
    )
    found = scene.objects[0].material
    assert (found.name, found.opacity, found.sides) == ("glass", 0.25, Sides.BOTH)
    sent_back = [sum(parts) for parts in zip(found.ambient, found.diffuse, strict=True)]
    assert sent_back == pytest.approx([1, 0.5, 0], abs=1e-15)
    assert found.emission == (1, 0, 0)
    image = Texture(tmp_path / "a b.png", is_optional=True)
    assert (found.texture, found.normal_map) == (image, None)
    assert "Images are missing: none.png." in scene.remarks
    lacking = "Not drawn of the materials (and of how many): metallic and roughness (1)."
    assert lacking in scene.remarks


def test_colours_coordinates_and_tangents_of_vertices(tmp_path: Path) -> None:
    colours = bytes([255, 0, 0, 255, 0, 128, 0, 255, 0, 0, 255, 255])
    uv = pack("<6H", 0, 0, 65535, 0, 0, 65535)
    tangents = pack("<12f", *[1, 0, 0, -1] * 3)
    content = TRIANGLE + colours + uv + tangents
    starts = [0, 36, 48, 60]
    scene = made(
        tmp_path,
        meshes=[
            {
                "primitives": [
                    {
                        "attributes": {
                            "POSITION": 0,
                            "NORMAL": 0,
                            "COLOR_0": 1,
                            "TEXCOORD_0": 2,
                            "TANGENT": 3,
                        }
                    }
                ]
            }
        ],
        accessors=[
            {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
            {
                "bufferView": 1,
                "componentType": 5121,
                "normalized": True,
                "count": 3,
                "type": "VEC4",
            },
            {
                "bufferView": 2,
                "componentType": 5123,
                "normalized": True,
                "count": 3,
                "type": "VEC2",
            },
            {"bufferView": 3, "componentType": 5126, "count": 3, "type": "VEC4"},
        ],
        bufferViews=[
            {"buffer": 0, "byteOffset": start, "byteLength": end - start}
            for start, end in zip(starts, [*starts[1:], len(content)], strict=True)
        ],
        buffers=[buffer(content)],
    )
    mesh = scene.objects[0].geometry.mesh()
    assert mesh.colours is not None
    assert mesh.uv is not None
    assert mesh.tangents is not None
    assert mesh.colours.tolist() == [[1, 0, 0, 1], [0, 128 / 255, 0, 1], [0, 0, 1, 1]]
    assert mesh.uv.tolist() == [[0, 1], [1, 1], [0, 0]]  # v upwards
    assert mesh.tangents[:, 3].tolist() == [-1, -1, -1]
    assert scene.objects[0].material.vertex_colours


def test_vertex_colours_of_the_box(data: Path) -> None:
    path = data / "gltf/BoxVertexColors/glTF-Binary/BoxVertexColors.glb"
    (box,) = gltf_scene(path).objects
    colours = box.geometry.mesh().colours
    assert colours is not None
    assert colours.min() >= 0
    assert colours.max() == 1
    assert box.material.vertex_colours


def test_each_primitive_is_an_object_and_instances_share_it(tmp_path: Path) -> None:
    triangle = {"attributes": {"POSITION": 0}}
    scene = made(
        tmp_path,
        nodes=[{"mesh": 0, "name": "a", "children": [1]}, {"mesh": 0, "name": "a"}, {"mesh": 0}],
        meshes=[{"primitives": [triangle, {**triangle, "mode": 1}, triangle]}],
    )
    assert [one.name for one in scene.objects] == ["a", "a 2", "a/a", "a/a 2"]
    assert scene.objects[0].geometry is scene.objects[2].geometry
    assert "Primitives that are not drawn: 1 of lines." in scene.remarks
    assert "Nodes outside of the scene are not drawn: 1." in scene.remarks


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"nodes": [{"translation": [0, 3, 0]}]}, "it draws nothing"),
        (
            {"scenes": [{"nodes": []}]},
            "no triangles in its scene, and 1 node with a mesh is outside of it; put them into",
        ),
        ({"extensionsRequired": ["ACME_teapot"]}, "it requires ACME_teapot, which is not known"),
    ],
)
def test_what_cannot_be_drawn_still_has_its_nodes(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    nodes = [{"mesh": 0, "translation": [0, 3, 0]}]
    scene = made(tmp_path, **{"nodes": nodes, **changes})
    assert setup_of(scene, "node 0").world.world_from_object[1][3] == 3
    with pytest.raises(IllegalValueError, match=words):
        loaded(scene)


def test_the_place_of_a_node_keeps_its_parts(tmp_path: Path) -> None:
    scene = made(
        tmp_path,
        nodes=[
            {"scale": [1, 2, 1], "children": [1]},
            {"mesh": 0, "translation": [0, 3, 0], "rotation": [0, 0, 0, 1]},
        ],
    )
    (one,) = scene.objects
    assert one.place is not None
    assert one.place.translate == (0, 3, 0)
    assert one.world_from_parent is not None
    assert product(one.world_from_parent, one.place.exact) == one.world_from_object
    assert scene_of(tmp_path / "made.gltf").objects[0].world_from_object[1][3] == 6


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"scene": 3}, "scene 3 does not exist"),
        ({"scenes": [{"nodes": [9]}]}, r"scenes\[0\].nodes\[0\]: node 9 does not exist"),
        ({"nodes": [{"mesh": 0, "rotation": [0, 0, 0, 0]}]}, "made.gltf \\(node 0\\): quaternion"),
        (
            {
                "nodes": [
                    {"mesh": 0, "scale": [1e200, 1, 1], "children": [1]},
                    {"scale": [1e200, 1, 1]},
                ]
            },
            "1e400",
        ),
    ],
)
def test_damage_is_named(tmp_path: Path, changes: dict[str, object], words: str) -> None:
    with pytest.raises(IllegalValueError, match=words) as caught:
        made(tmp_path, **changes)
    assert "\n" not in str(caught.value)


SEEING = {"type": "perspective", "perspective": {"yfov": 1, "znear": 1}}


@pytest.mark.parametrize(
    ("camera", "words"),
    [
        (5, "camera 0 cannot be read"),
        ({"type": "perspective"}, "it sees nothing"),
        ({"type": "perspective", "perspective": {"yfov": 4, "znear": 1}}, "fov"),
    ],
)
def test_the_first_camera_that_can_be_used_is_used(
    tmp_path: Path, camera: object, words: str
) -> None:
    nodes = [{"mesh": 0, "camera": 0}, {"camera": 9}, {"camera": 1, "translation": [0, 0, 7]}]
    scene = made(tmp_path, nodes=nodes, scenes=[], cameras=[camera, SEEING])
    assert scene.has_camera
    assert "Of 3 cameras the first that can be is used." in scene.remarks
    assert any(
        one.startswith("the camera of node 0 (node 0) is not used: ") and words in one
        for one in scene.remarks
    )
    missing = "the camera of node 1 (node 1) is not used: camera 9 does not exist."
    assert missing in scene.remarks
    (cameras,) = (one for one in scene.features if one.feature == "camera")
    assert (cameras.count, cameras.made_of_it) == (3, "the first that can be is used")


def test_without_a_camera_that_can_be_used_there_is_none(tmp_path: Path) -> None:
    scene = made(tmp_path, nodes=[{"mesh": 0, "camera": 0}], cameras=[])
    assert not scene.has_camera
    assert "the camera of node 0 (node 0) is not used: camera 0 does not exist." in scene.remarks


@pytest.mark.parametrize(
    ("light", "node", "words"),
    [
        ({"type": "laser", "intensity": 99}, {}, "a light of type laser is unknown"),
        ({"type": "point", "range": -1}, {}, "below zero"),
        ({}, {}, "KHR_lights_punctual.lights[0]: object missing required field type"),
        (7, {}, "KHR_lights_punctual.lights[0]: expected an object, got an integer"),
        (
            {"type": "point", "color": "red"},
            {},
            "KHR_lights_punctual.lights[0].color: expected a list, got text",
        ),
        ({"type": "spot", "spot": {"outerConeAngle": 0}}, {}, "its cone goes from 0 to 0"),
        ({"type": "directional"}, {"scale": [1, 1, 0]}, "its node flattens its direction"),
    ],
)
def test_a_bad_light_costs_only_itself(
    tmp_path: Path, light: dict[str, object], node: dict[str, object], words: str
) -> None:
    """Nor does it count as the brightest."""
    changes = lit(light, {"type": "point", "intensity": 3})
    nodes = changes["nodes"]
    assert isinstance(nodes, list)
    nodes[1] |= node
    scene = made(tmp_path, **changes)
    (one,) = scene.lights
    assert one.intensity == 1
    told = [one for one in scene.remarks if "the light of node 1 (node 1)" in one]
    assert len(told) == 1
    assert words in told[0]
    assert "`" not in told[0]


@pytest.mark.parametrize("lights", ["x", {"lights": {}}])
def test_lights_that_are_no_list_are_one_fault(tmp_path: Path, lights: object) -> None:
    changes = lit({"type": "point"}, {"type": "point"})
    changes["extensions"] = {"KHR_lights_punctual": lights}
    scene = made(tmp_path, **changes)
    assert not scene.lights
    (told,) = (one for one in scene.remarks if "KHR_lights_punctual" in one)
    assert told.startswith("2 parts are not used (the light of node 1 (node 1); ")


def test_a_mesh_is_one_object_that_stands_still(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    scene = scene_of(path)
    (one,) = scene.objects
    assert (one.name, one.world_from_object) == ("a", identity(4))
    assert one.geometry.mesh().triangles.tolist() == [[0, 1, 2]]
    assert not scene.has_camera
    for wrong in ("b.obj", "b.txt", "b.toml", "b.glb"):
        with pytest.raises(IllegalValueError):
            scene_of(tmp_path / wrong)


@pytest.mark.parametrize(
    "accessor",
    [
        {"componentType": 5126, "count": 10**15, "type": "VEC3"},
        {"bufferView": 0, "componentType": 5126, "count": 30, "type": "VEC3"},
        {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC2"},
        {"bufferView": 0, "componentType": 5126, "count": 1, "type": "VEC3"},
    ],
)
def test_damaged_numbers_are_refused_when_they_are_read(
    tmp_path: Path, accessor: dict[str, object]
) -> None:
    scene = made(tmp_path, accessors=[accessor])
    with pytest.raises(IllegalValueError, match=r"made\.gltf"):
        scene.objects[0].geometry.mesh()


def test_mesh_files_bring_coordinates_and_colours(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n")
    uv = scene_of(path).objects[0].geometry.mesh().uv
    assert uv is not None
    assert uv.tolist() == [[0, 0], [1, 0], [0, 1]]
    path.write_text("v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nf 1 2 3\n")
    colours = scene_of(path).objects[0].geometry.mesh().colours
    assert colours is not None
    assert colours.tolist() == [[1, 0, 0], [0, 1, 0], [0, 0, 1]]


def test_the_negative_scale_sample_passes_its_own_test(data: Path) -> None:
    """Crosses show where a mirrored back is drawn; ticks where it is not."""
    file = data / "gltf" / "NegativeScaleTest" / "glTF-Binary" / "NegativeScaleTest.glb"
    scene = replace(
        scene_of(file), view=View(eye=(0, 0, 9)), has_camera=True, lens=Lens(near=1, far=30)
    )
    image = render(planned(loaded(scene.sized(320, 320)))).rgb
    red, green = image[:, :, 0] - image[:, :, 1], image[:, :, 1] - image[:, :, 0]
    assert (green > 0.4).sum() > 300
    assert (red > 0.4).sum() == 0


def test_a_named_node_is_the_node_wherever_its_triangles_are_drawn(tmp_path: Path) -> None:
    """Joints and instances carry triangles elsewhere; the matrices asked for are the node's."""
    instancing = {"attributes": {"TRANSLATION": 0}}
    scene = made(
        tmp_path,
        nodes=[
            {"name": "body", "mesh": 0, "skin": 0, "scale": [1, 2, 1]},
            {"name": "bone"},
            {
                "name": "forest",
                "mesh": 0,
                "translation": [0, 7, 0],
                "extensions": {"EXT_mesh_gpu_instancing": instancing},
            },
        ],
        scenes=[{"nodes": [0, 1, 2]}],
        skins=[{"joints": [1]}],
        extensionsUsed=["EXT_mesh_gpu_instancing"],
    )
    assert setup_of(scene, "body").world.world_from_object[1][1] == 2
    assert setup_of(scene, "forest").world.world_from_object[1][3] == 7
    counted = {one.feature: one.count for one in scene.features}
    assert (counted["skinned node"], counted["instanced node"]) == (1, 1)


def test_features_of_a_file_are_counted_and_what_is_made_of_them(tmp_path: Path) -> None:
    triangle = {"attributes": {"POSITION": 0}, "material": 0}
    scene = made(
        tmp_path,
        nodes=[{"mesh": 0}, {"mesh": 0}],
        scenes=[{"nodes": [0]}],
        meshes=[{"primitives": [triangle, {**triangle, "mode": 1}, {**triangle, "mode": 0}]}],
        materials=[{"occlusionTexture": {"index": 0}}],
        textures=[{}],
        animations=[{"channels": [], "samplers": []}],
        extensionsUsed=["KHR_materials_sheen"],
    )
    found = {one.feature: (one.count, one.made_of_it) for one in scene.features}
    assert found["animation"] == (1, "not played")
    assert found["node outside of the scene"] == (1, "not drawn")
    assert found["primitive of lines"] == (1, "not drawn")
    assert found["primitive of points"] == (1, "not drawn")
    assert found["material with occlusion"] == (1, "occlusion not drawn")
    assert found["extension KHR_materials_sheen"] == (1, "left out")
