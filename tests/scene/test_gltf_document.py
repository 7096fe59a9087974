"""The JSON of a glTF file: its version, and what is wrong with it where."""

from __future__ import annotations

import codecs
import json
import struct
from pathlib import Path

import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.scene.gltf.document import read_document
from nmatrix.scene.gltf.extensions import Treatment, treatment
from nmatrix.scene.gltf.file import read_gltf

ASSET = '"asset": {"version": "2.0"}'
DISPENSABLE = ("cameras", "materials", "textures", "samplers", "images", "skins", "animations")
GOOD = {"type": "perspective", "joints": []}  # a record of each


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('{"asset": {"version": "1.0"}, "nodes": {}}', "it is glTF 1.0, and glTF 2.0 is read"),
        ('{"nodes": {"a": {}}}', "it is glTF 1.0, and glTF 2.0 is read"),
        ('{"asset": {"version": 1.1}}', "it is glTF 1.1"),
        ('{"asset": {"version": "3.0"}}', "it is glTF 3.0, .*export it as 2.0"),
        ('{"asset": {"version": "2.0", "minVersion": "2.1"}}', "it needs glTF 2.1 at least"),
        ("{}", "it is not glTF: object missing required field asset"),
        ("[]", "it is not glTF: expected an object, got a list"),
        (f'{{{ASSET}, "nodes": [{{}}, {{"mesh": "x"}}]}}', r"nodes\[1\].mesh: expected an integer"),
        (f'{{{ASSET}, "nodes": [{{"mesh": 0.5}}]}}', r"nodes\[0\].mesh: expected an integer"),
        (f'{{{ASSET},\n\n"nodes": [NaN\n]}}', r"line 3: no value of JSON has 'NaN' there"),
        (f'{{{ASSET},\n"nodes": [{{}},\n\n]}}', "line 2: nothing follows a comma"),
        (f'{{{ASSET},\n"scene": 0,\n}}', "line 2: nothing follows a comma"),
        (f'{{{ASSET},\n"scene":\n}}', "line 3: a value is missing before '}'"),
        (f'{{{ASSET}\n"scene": 0}}', "line 2: ',' or '}' is missing before"),
        (
            f"{{{ASSET},\nscene: 0}}",
            "line 2: a name in double quotes is meant where 'scene' stands",
        ),
        (f'{{{ASSET},\n"scene": 01}}', "line 2: a number is not written as JSON writes it"),
        (f'{{{ASSET},\n"scene": tru}}', "line 2: no value of JSON is 'tru'"),
        (f'{{{ASSET},\n"a": "\n"}}', "line 2: a line break or a tab stands within quotes"),
        (f'{{{ASSET},\n"a": "\\x"}}', "line 2: a backslash within quotes"),
        (f"{{{ASSET}}}\nmore", "line 2: the text goes on after its end"),
        (f'{{{ASSET}, "nodes": [', "its JSON ends too early"),
        (f'{{{ASSET}, "nodes": [{{"scale": [1e999, 1, 1]}}]}}', "number out of range"),
        ("[" * 10**6, "nested too deeply|expected an object"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(text: str, words: str) -> None:
    with pytest.raises(IllegalValueError, match=words) as caught:
        read_document(Path("a.gltf"), text.encode())
    assert "\n" not in str(caught.value)
    assert "Error" not in str(caught.value)


def test_bytes_that_are_no_text_are_refused() -> None:
    with pytest.raises(IllegalValueError, match=r"it is not glTF: .*UTF-8|line 1: "):
        read_document(Path("a.gltf"), b'{"asset": {"version": "\xff"}}')


def test_integers_may_be_written_as_floats() -> None:
    text = f'{{{ASSET}, "nodes": [{{"mesh": 0.0}}], "meshes": [{{}}]}}'
    found, faults = read_document(Path("a.gltf"), text.encode())
    assert found.nodes[0].mesh == 0
    assert not faults


@pytest.mark.parametrize("name", DISPENSABLE)
def test_a_record_that_cannot_be_read_costs_only_itself(name: str) -> None:
    """Its place in the list stays, so that the others are found where they were."""
    bad = [5, None, [], {"name": 1, "uri": 1, "source": "x", "wrapS": "x", "channels": 1}]
    for record in bad:
        text = json.dumps({"asset": {"version": "2.0"}, name: [record, GOOD]})
        found, (fault,) = read_document(Path("a.gltf"), text.encode())
        first, second = getattr(found, name)
        assert first is None
        assert second is not None
        assert fault.startswith(f"Records cannot be read: {name}[0]")
        assert "`" not in fault


@pytest.mark.parametrize("name", DISPENSABLE)
def test_a_list_that_is_none_costs_only_itself(name: str) -> None:
    text = json.dumps({"asset": {"version": "2.0"}, "nodes": [{}], name: {"0": {}}})
    found, faults = read_document(Path("a.gltf"), text.encode())
    assert len(found.nodes) == 1
    assert getattr(found, name) == []
    assert faults == (f"Records cannot be read: {name}: expected a list, got an object.",)


def test_of_many_bad_records_the_first_are_told() -> None:
    text = json.dumps(
        {"asset": {"version": "2.0"}, "materials": [{"alphaMode": i} for i in range(9)]}
    )
    _, (fault,) = read_document(Path("a.gltf"), text.encode())
    assert fault.count("expected text, got an integer") == 4
    assert fault.endswith("; ….")


def test_a_number_out_of_range_costs_only_its_record() -> None:
    text = f'{{{ASSET}, "materials": [{{"alphaCutoff": 1e999}}]}}'
    found, (fault,) = read_document(Path("a.gltf"), text.encode())
    assert found.materials == [None]
    assert "materials[0].alphaCutoff: expected a number, got a number out of range" in fault


@pytest.mark.parametrize("kind", ["nodes", "scenes", "asset"])
def test_without_nodes_scenes_or_a_version_a_file_is_refused(kind: str) -> None:
    text = json.dumps({"asset": {"version": "2.0"}, kind: [5]})
    with pytest.raises(IllegalValueError, match=rf"{kind}(\[0\])?: expected an object, got"):
        read_document(Path("a.gltf"), text.encode())


def test_a_byte_order_mark_is_passed_over_with_a_remark(tmp_path: Path) -> None:
    path = tmp_path / "a.gltf"
    path.write_bytes(codecs.BOM_UTF8 + json.dumps({"asset": {"version": "2.0"}}).encode())
    (remark,) = read_gltf(path).remarks
    assert "byte order mark" in remark


JSON = struct.pack("<I", 40) + b"JSON" + b'{"asset": {"version": "2.0"}}'.ljust(40)
BIN = struct.pack("<I", 4) + b"BIN\0four"


def container(*chunks: bytes, version: int = 2) -> bytes:
    body = b"".join(chunks)
    return b"glTF" + struct.pack("<2I", version, 12 + len(body)) + body


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (container(), "its container is empty: it has no chunk of JSON"),
        (container(BIN), "its first chunk is BIN, and not JSON"),
        (container(BIN, JSON), "its first chunk is BIN, and not JSON"),
        (container(bytes(8)), "its first chunk is of the unknown type 0x00000000, and not JSON"),
        (container(JSON, version=0), "its container is of version 0, and 2 is read"),
        (container(JSON, version=1), "it is glTF 1.0, and glTF 2.0 is read"),
        (container(JSON)[:9], "the file ends in the middle of its header; copy it again"),
        (container(JSON)[:15], "the file ends in the middle of the header of a chunk; copy"),
        (container(JSON)[:-1], "the file ends in the middle of a chunk; copy it again"),
        (b"\0", r"a .glb file begins with glTF, and it begins with '\\x00'"),
        (b"version https://", "a .glb file begins with glTF, and it begins with 'version http'"),
    ],
)
def test_what_is_no_container_is_told_in_its_own_words(
    tmp_path: Path, content: bytes, words: str
) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(content)
    with pytest.raises(IllegalValueError, match=words) as caught:
        read_gltf(path)
    assert "JSON ends" not in str(caught.value)


@pytest.mark.parametrize(
    "content", [container(JSON, BIN) + b"\0\0\0", b'{"asset": {"version": "2.0"}}']
)
def test_padding_and_a_wrong_ending_of_the_name_are_granted(tmp_path: Path, content: bytes) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(content)
    assert len(read_gltf(path).nodes) == 0


def test_the_container_of_another_version_is_named(tmp_path: Path) -> None:
    path = tmp_path / "a.glb"
    path.write_bytes(b"glTF\x01\0\0\0" + bytes(12))
    with pytest.raises(IllegalValueError, match=r"it is glTF 1\.0"):
        read_gltf(path)


@pytest.mark.parametrize(
    ("last", "is_taken"),
    [([0, 0, 0, 1.0000001], True), ([1e-7, 0, 0, 1], True), ([0, 0, 0, 1.01], False)],
)
def test_the_last_row_of_a_matrix_is_granted_what_float32_loses(
    tmp_path: Path, last: list[float], *, is_taken: bool
) -> None:
    rows = [[1, 0, 0, 5], [0, 1, 0, 6], [0, 0, 1, 7], last]
    matrix = [row[i] for i in range(4) for row in rows]
    path = tmp_path / "a.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "nodes": [{"matrix": matrix}]}))
    if not is_taken:
        with pytest.raises(IllegalValueError, match=r"its matrix ends in 0 0 0 1\.01"):
            read_gltf(path)
        return
    file = read_gltf(path)
    assert file.nodes[0].world_from_object[3] == (0, 0, 0, 1)
    assert file.remarks == ("1 matrix did not quite end in 0 0 0 1: node 0.",)


@pytest.mark.parametrize("kind", Treatment)
def test_every_treatment_has_an_extension(kind: Treatment) -> None:
    examples = {
        Treatment.READ: "KHR_mesh_quantization",
        Treatment.PACKING: "KHR_meshopt_compression",
        Treatment.IMAGES: "KHR_texture_basisu",
        Treatment.LEFT_OUT: "KHR_materials_sheen",
        Treatment.UNKNOWN: "ACME_teapot",
    }
    assert treatment(examples[kind]) is kind
