"""glTF files: containers, matrices of nodes, buffers and images inside the file or beside it."""

from __future__ import annotations

import json
from base64 import b64encode
from io import BytesIO
from pathlib import Path
from struct import pack

import numpy as np
import pytest
from gltf_files import Made
from PIL import Image

from nmatrix.errors import IllegalValueError
from nmatrix.scene.gltf.file import read_gltf
from nmatrix.scene.gltf.meshes import primitive_mesh
from nmatrix.scene.gltf.scene import gltf_scene
from nmatrix.scene.material import EmbeddedImage, Texture
from nmatrix.scene.words import Filter, Wrap

TRIANGLE = pack("<9f", 0, 0, 0, 1, 0, 0, 0, 1, 0)
JSON_CHUNK, BINARY_CHUNK = b"JSON", b"BIN\0"
IDENTITY = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]


def document(**changes: object) -> dict[str, object]:
    """Return a file of one triangle, whose bytes are those of the container."""
    return {
        "asset": {"version": "2.0"},
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36}],
    } | changes


def container(*chunks: tuple[bytes, bytes]) -> bytes:
    body = b"".join(pack("<I", len(content)) + name + content for name, content in chunks)
    return b"glTF" + pack("<2I", 2, 12 + len(body)) + body


def json_chunk(**changes: object) -> tuple[bytes, bytes]:
    text = json.dumps(document(**changes)).encode()
    return JSON_CHUNK, text + b" " * (-len(text) % 4)


def saved(folder: Path, name: str, content: bytes | dict[str, object]) -> Path:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else json.dumps(content).encode())
    return path


def data_uri(content: bytes, kind: str = "application/octet-stream") -> str:
    return f"data:{kind};base64,{b64encode(content).decode()}"


def picture(level: int) -> bytes:
    file = BytesIO()
    Image.new("RGB", (2, 2), (level, 0, 0)).save(file, "PNG")
    return file.getvalue()


@pytest.mark.parametrize("where", ["container", "embedded", "beside"])
def test_a_buffer_lies_in_the_container_in_the_text_or_beside(tmp_path: Path, where: str) -> None:
    if where == "container":
        unknown = (b"XTRA", b"four")  # readers pass over chunks that they do not know
        content = container(json_chunk(), unknown, (BINARY_CHUNK, TRIANGLE))
        path = saved(tmp_path, "a.glb", content)
    elif where == "embedded":
        buffers = [{"byteLength": 36, "uri": data_uri(TRIANGLE)}]
        path = saved(tmp_path, "a.gltf", document(buffers=buffers))
    else:
        saved(tmp_path, "a b.bin", TRIANGLE)
        buffers = [{"byteLength": 36, "uri": "a%20b.bin"}]
        path = saved(tmp_path, "a.gltf", document(buffers=buffers))
    mesh = primitive_mesh(read_gltf(path), 0, 0)
    assert mesh.positions.tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_a_container_that_is_cut_short_is_refused(tmp_path: Path) -> None:
    whole = container(json_chunk(), (BINARY_CHUNK, TRIANGLE))
    path = saved(tmp_path, "a.glb", whole[:-1])
    with pytest.raises(IllegalValueError, match="ends in the middle of a chunk; copy it again"):
        read_gltf(path)


def test_a_file_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(IllegalValueError, match=r"none\.gltf: no such file"):
        read_gltf(tmp_path / "none.gltf")


def test_a_matrix_is_stored_column_by_column(tmp_path: Path) -> None:
    matrix = [2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 4, 0, 5, 6, 7, 1]
    parts = {"scale": [2, 3, 4], "translation": [5, 6, 7]}
    path = saved(tmp_path, "a.gltf", document(nodes=[{"matrix": matrix}, parts]))
    by_matrix, by_parts = read_gltf(path).nodes
    assert by_matrix.world_from_object == by_parts.world_from_object
    assert [row[3] for row in by_matrix.local] == [5, 6, 7, 1]


def test_a_node_with_a_matrix_is_an_object_with_that_place(tmp_path: Path) -> None:
    sheared = [1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]
    content = container(json_chunk(nodes=[{"mesh": 0, "matrix": sheared}]))
    (one,) = gltf_scene(saved(tmp_path, "a.glb", content)).objects
    assert one.place is not None
    assert one.place.matrix == one.world_from_object
    assert one.world_from_object[0] == (1, 0.5, 0, 0)


@pytest.mark.parametrize(
    ("node", "words"),
    [
        ({"matrix": [*IDENTITY[:15], 2]}, "its matrix ends in 0 0 0 2 and not in 0 0 0 1"),
        ({"matrix": [1, 0, 0, 0.5, *IDENTITY[4:]]}, "its matrix ends in 0.5 0 0 1 and not"),
        ({"matrix": IDENTITY[:12]}, "a transform needs 16 finite numbers"),
        ({"rotation": [0, 0, 1]}, "a transform needs 4 finite numbers"),
        ({"translation": [0, 0]}, "a transform needs 3 finite numbers"),
    ],
)
def test_a_transform_that_is_none_names_its_node(
    tmp_path: Path, node: dict[str, object], words: str
) -> None:
    path = saved(tmp_path, "a.gltf", document(nodes=[{"name": "arm", **node}]))
    with pytest.raises(IllegalValueError) as caught:
        read_gltf(path)
    assert f"{path} (arm): {words}" in str(caught.value)


def textured(image: dict[str, object], **changes: object) -> dict[str, object]:
    texture = {"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}
    primitive = {"attributes": {"POSITION": 0}, "material": 0}
    return {
        "meshes": [{"primitives": [primitive]}],
        "materials": [texture],
        "textures": [{"source": 0}],
        "images": [image],
        **changes,
    }


@pytest.mark.parametrize("where", ["container", "embedded", "beside"])
def test_an_image_lies_in_the_container_in_the_text_or_beside(tmp_path: Path, where: str) -> None:
    content = picture(77)
    views = [
        {"buffer": 0, "byteLength": 36},
        {"buffer": 0, "byteOffset": 36, "byteLength": len(content)},
    ]
    image: dict[str, object] = {"bufferView": 1}
    if where == "embedded":
        image = {"uri": data_uri(content, "image/png")}
    elif where == "beside":
        image = {"uri": "a%20b.png"}
        saved(tmp_path, "a b.png", content)
    chunk = json_chunk(**textured(image, bufferViews=views))
    whole = container(chunk, (BINARY_CHUNK, TRIANGLE + content + b"after"))
    found = gltf_scene(saved(tmp_path, "a.glb", whole)).objects[0].material.texture
    assert found == Texture(found.image, is_optional=True)
    texture = found.image
    if where == "beside":
        assert texture == tmp_path / "a b.png"
    else:
        assert isinstance(texture, EmbeddedImage)
        assert texture.content == content
        assert str(texture) == f"{tmp_path / 'a.glb'} (image 0)"
        assert np.asarray(Image.open(BytesIO(texture.content)))[0, 0].tolist() == [77, 0, 0]


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (textured({}), "an image has no bytes"),
        (textured({"bufferView": 4}), "an image has no bytes"),
        (
            textured({"bufferView": 0}, bufferViews=[{"buffer": 0, "byteLength": 99}]),
            "an image reaches beyond its buffer",
        ),
        (textured({"uri": "data:image/png;base64,!"}), "an image is embedded and is not base64"),
    ],
)
def test_an_image_that_is_damaged_costs_only_itself(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert f"An image is not drawn: image 0: {words}." in scene.remarks
    assert scene.objects[0].material.texture is None


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        (textured({}, images=[]), "An image is not drawn: image 0 does not exist."),
        (textured({}, images=[5]), "An image is not drawn: image 0 cannot be read."),
        (textured({}, textures=[]), "A texture is not drawn: texture 0 does not exist."),
        (textured({}, textures=["x"]), "A texture is not drawn: texture 0 cannot be read."),
        (
            textured({}, materials=[{"alphaMode": 5}]),
            "A material is drawn as the default one: material 0 cannot be read.",
        ),
        (
            textured({}, materials=[]),
            "A material is drawn as the default one: material 0 does not exist.",
        ),
    ],
)
def test_a_part_of_a_material_that_is_not_there_costs_only_itself(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert words in scene.remarks
    (one,) = scene.objects
    assert one.material.texture is None


@pytest.mark.parametrize("samplers", [[], [{"wrapS": "x"}]])
def test_a_sampler_that_is_not_there_leaves_its_texture(
    tmp_path: Path, samplers: list[object]
) -> None:
    image = {"uri": data_uri(picture(1), "image/png")}
    changes = textured(image, textures=[{"source": 0, "sampler": 0}], samplers=samplers)
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert any(one.startswith("A texture is read as by default: ") for one in scene.remarks)
    texture = scene.objects[0].material.texture
    assert isinstance(texture, Texture)
    assert texture.wrap == (Wrap.REPEAT, Wrap.REPEAT)


@pytest.mark.parametrize(
    ("uri", "named"),
    [
        ("none.png", "none.png"),
        ("a" * 300, f"'{'a' * 40}'…"),  # longer than the names of a file system
        ("é" * 150, f"'{'é' * 40}'…"),
        ("a%00b", r"'a\x00b'"),
        ("a%0Ab", r"'a\nb'"),
    ],
)
def test_an_image_that_is_missing_is_a_remark(tmp_path: Path, uri: str, named: str) -> None:
    whole = container(json_chunk(**textured({"uri": uri})), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert scene.objects[0].material.texture is None
    assert f"Images are missing: {named}." in scene.remarks


@pytest.mark.parametrize(
    ("material", "left_out"),
    [
        ({"occlusionTexture": {"index": 0}}, "metallic and roughness (1), occlusion (1)"),
        ({"pbrMetallicRoughness": {"metallicFactor": 0}, "alphaMode": "ADD"}, "alpha mode ADD (1)"),
        (
            {
                "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}},
                "normalTexture": {"index": 0, "texCoord": 1},
            },
            "metallic and roughness (1), textures by another set of coordinates (1)",
        ),
        (
            {"extensions": {"KHR_materials_pbrSpecularGlossiness": {}}},
            "specular and glossiness (1)",
        ),
    ],
)
def test_what_is_not_drawn_of_a_material_is_a_remark(
    tmp_path: Path, material: dict[str, object], left_out: str
) -> None:
    changes = textured({"uri": data_uri(picture(0))}, materials=[material])
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert f"Not drawn of the materials (and of how many): {left_out}." in scene.remarks
    assert scene.objects[0].material.normal_map is None


def test_samplers_and_the_transform_of_a_texture_are_read(tmp_path: Path) -> None:
    """Checked where v runs down, by the rule of the extension: moved · turned · scaled."""
    given = {"offset": [0.3, -0.2], "rotation": 0.7, "scale": [2, -1.5]}
    reference = {"index": 0, "extensions": {"KHR_texture_transform": given}}
    changes = textured(
        {"uri": data_uri(picture(0))},
        materials=[{"pbrMetallicRoughness": {"baseColorTexture": reference}}],
        textures=[{"source": 0, "sampler": 0}],
        samplers=[{"wrapS": 33071, "wrapT": 33648, "magFilter": 9728}],
        extensionsUsed=["KHR_texture_transform"],
    )
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    found = scene.objects[0].material.texture
    assert found.wrap == (Wrap.CLAMP, Wrap.MIRROR)
    assert not any("Extensions" in one for one in scene.remarks)
    assert found.filter is Filter.NEAREST
    c, s = np.cos(0.7), np.sin(0.7)
    for u, v in [(0, 0), (0.2, 0.9), (-1, 3)]:
        across, down = 2 * u, -1.5 * v
        right = (c * across + s * down + 0.3, -s * across + c * down - 0.2)
        mine = np.array(found.uv_map) @ (u, 1 - v, 1)
        assert np.abs(mine - (right[0], 1 - right[1])).max() < 1e-12


def test_a_transform_may_name_other_coordinates(tmp_path: Path) -> None:
    reference = {"index": 0, "extensions": {"KHR_texture_transform": {"texCoord": 1}}}
    changes = textured({"uri": data_uri(picture(0))}, materials=[{"normalTexture": reference}])
    whole = container(json_chunk(**changes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert scene.objects[0].material.normal_map is not None
    assert scene.objects[0].geometry.plain.coordinates == 1


def test_a_texture_without_an_image_is_none(tmp_path: Path) -> None:
    whole = container(json_chunk(**textured({}, textures=[{}])), (BINARY_CHUNK, TRIANGLE))
    assert gltf_scene(saved(tmp_path, "a.glb", whole)).objects[0].material.texture is None


def test_a_file_without_scenes_draws_its_roots(tmp_path: Path) -> None:
    nodes = [{"mesh": 0, "name": "under"}, {"mesh": 0, "name": "root", "children": [0]}]
    whole = container(json_chunk(nodes=nodes), (BINARY_CHUNK, TRIANGLE))
    scene = gltf_scene(saved(tmp_path, "a.glb", whole))
    assert [one.name for one in scene.objects] == ["root", "under"]


def test_a_tall_cameras_picture_is_tall(tmp_path: Path) -> None:
    lens = {"yfov": 1.0, "znear": 0.1, "aspectRatio": 0.25}
    cameras = [{"type": "perspective", "perspective": lens}]
    chunk = json_chunk(nodes=[{"mesh": 0, "camera": 0}], cameras=cameras)
    scene = gltf_scene(saved(tmp_path, "a.glb", container(chunk, (BINARY_CHUNK, TRIANGLE))))
    assert scene.settings.size == (128, 512)


def test_objects_are_called_by_what_means_their_nodes_alone(tmp_path: Path) -> None:
    names = ["a", "a 2", "a", "a"]
    chunk = json_chunk(nodes=[{"mesh": 0, "name": name} for name in names])
    path = saved(tmp_path, "a.glb", container(chunk, (BINARY_CHUNK, TRIANGLE)))
    assert [one.name for one in gltf_scene(path).objects] == ["#0", "a 2", "#2", "#3"]


def test_a_light_that_is_not_there_costs_only_itself(tmp_path: Path) -> None:
    carrier = {"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 3}}}
    lights = {"KHR_lights_punctual": {"lights": []}}
    chunk = json_chunk(nodes=[carrier], extensions=lights)
    path = saved(tmp_path, "a.glb", container(chunk, (BINARY_CHUNK, TRIANGLE)))
    scene = gltf_scene(path)
    assert not scene.lights
    told = "the light of node 0 (node 0) is not used: light 3 does not exist."
    assert told in scene.remarks


def test_what_is_drawn_beyond_the_largest_number_has_the_radius_one(tmp_path: Path) -> None:
    """Light from a place fades with d²/r², where r is the radius of what is drawn."""
    light = {"type": "point"}
    bounds = {"min": [-1e200, 0, 0], "max": [1e200, 0, 0]}
    accessor = {"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", **bounds}
    chunk = json_chunk(
        accessors=[accessor],
        nodes=[{"mesh": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}],
        extensions={"KHR_lights_punctual": {"lights": [light]}},
    )
    path = saved(tmp_path, "a.glb", container(chunk, (BINARY_CHUNK, TRIANGLE)))
    assert gltf_scene(path).lights[0].attenuation == (1, 0, 1)


@pytest.mark.parametrize(
    ("said", "words"),
    [
        (20, "Buffer 0 is said to have 20 bytes, and buffer views reach to its byte 36."),
        (36, "Buffer 0 is said to have 36 bytes and has 60: not all is read."),
        (57, None),
        (60, None),
    ],
)
@pytest.mark.parametrize("is_embedded", [True, False])
def test_a_buffer_of_another_length_than_said_is_told(
    tmp_path: Path, said: int, words: str | None, *, is_embedded: bool
) -> None:
    made = Made()
    made.add(np.eye(3))
    content = made.content + bytes(24)
    (tmp_path / "a.bin").write_bytes(content)
    buffer = {"byteLength": said, "uri": data_uri(content) if is_embedded else "a.bin"}
    told = [one for one in made.file(tmp_path, buffers=[buffer]).remarks if "Buffer" in one]
    assert told == ([words] if words else [])
