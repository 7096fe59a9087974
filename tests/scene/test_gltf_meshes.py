"""The numbers of glTF meshes: every way to store triangles, and one line for every damage."""

from __future__ import annotations

import json
from base64 import b64encode
from pathlib import Path
from struct import pack

import numpy as np
import pytest

from nmatrix.scene.geometry import DamagedPartError
from nmatrix.scene.gltf.file import GltfFile, read_gltf
from nmatrix.scene.gltf.meshes import mesh_normals, primitive_mesh
from nmatrix.scene.gltf.records import FAN, STRIP
from nmatrix.scene.words import NormalsFrom

BYTE, SHORT, UNSIGNED_SHORT, FLOAT = 5120, 5122, 5123, 5126
# Five points on the edge of a convex shape, counter-clockwise.
POINTS = [(0, 0, 0), (2, 0, 0), (3, 1, 0), (2, 2, 0), (0, 2, 0)]
UP = [(0, 0, 1)] * 5


def written(
    folder: Path,
    stored: dict[str, tuple[bytes, dict[str, object]]],
    *,
    mode: int = 4,
    indices: str | None = None,
    **changes: object,
) -> GltfFile:
    """Return a file of one mesh whose attributes are these bytes, described by these accessors."""
    content, accessors, views = b"", [], []
    for data, accessor in stored.values():
        content += b"\0" * (-len(content) % 4)
        views.append({"buffer": 0, "byteOffset": len(content), "byteLength": len(data)})
        accessors.append({"bufferView": len(views) - 1, **accessor})
        content += data
    numbers = {name: index for index, name in enumerate(stored)}
    primitive: dict[str, object] = {
        "attributes": {name: index for name, index in numbers.items() if name != indices},
        "mode": mode,
    }
    if indices is not None:
        primitive["indices"] = numbers[indices]
    uri = f"data:application/octet-stream;base64,{b64encode(content).decode()}"
    document = {
        "asset": {"version": "2.0"},
        "meshes": [{"primitives": [primitive]}],
        "accessors": accessors,
        "bufferViews": views,
        "buffers": [{"byteLength": len(content), "uri": uri}],
    } | changes
    path = folder / "made.gltf"
    path.write_text(json.dumps(document))
    return read_gltf(path)


def floats(rows: list[tuple[float, ...]]) -> tuple[bytes, dict[str, object]]:
    width = len(rows[0])
    data = b"".join(pack(f"<{width}f", *row) for row in rows)
    return data, {"componentType": FLOAT, "count": len(rows), "type": f"VEC{width}"}


def shorts(numbers: list[int]) -> tuple[bytes, dict[str, object]]:
    data = pack(f"<{len(numbers)}H", *numbers)
    return data, {"componentType": UNSIGNED_SHORT, "count": len(numbers), "type": "SCALAR"}


def turned_like(normal: tuple[float, float, float], corners: np.ndarray) -> bool:
    """Return whether a triangle is counter-clockwise seen from where the normal points."""
    a, b, c = corners
    return float(np.dot(np.cross(b - a, c - a), normal)) > 0


def test_a_strip_shares_edges_and_turns_every_triangle_the_same_way(tmp_path: Path) -> None:
    """Corners go zigzag, so that as they stand every second triangle would be turned around."""
    zigzag = [POINTS[i] for i in (0, 1, 4, 2, 3)]
    file = written(tmp_path, {"POSITION": floats(zigzag), "NORMAL": floats(UP)}, mode=STRIP)
    mesh = primitive_mesh(file, 0, 0)
    assert [set(one) for one in mesh.triangles.tolist()] == [{0, 1, 2}, {1, 2, 3}, {2, 3, 4}]
    assert all(turned_like((0, 0, 1), mesh.positions[one]) for one in mesh.triangles)


def test_a_fan_shares_its_first_corner(tmp_path: Path) -> None:
    stored = {
        "POSITION": floats(POINTS),
        "NORMAL": floats(UP),
        "i": shorts([4, 0, 1, 2, 3]),
    }
    file = written(tmp_path, stored, mode=FAN, indices="i")
    mesh = primitive_mesh(file, 0, 0)
    assert mesh.triangles.tolist() == [[4, 0, 1], [4, 1, 2], [4, 2, 3]]
    assert all(turned_like((0, 0, 1), mesh.positions[one]) for one in mesh.triangles)


def test_a_list_leaves_corners_beyond_its_last_triangle_out(tmp_path: Path) -> None:
    mesh = primitive_mesh(written(tmp_path, {"POSITION": floats(POINTS)}), 0, 0)
    assert mesh.triangles.tolist() == [[0, 1, 2]]


@pytest.mark.parametrize("mode", [4, STRIP, FAN])
@pytest.mark.parametrize("count", [0, 1, 2])
def test_fewer_than_three_corners_are_no_triangle(tmp_path: Path, mode: int, count: int) -> None:
    stored = {"POSITION": floats(POINTS), "i": shorts([0] * count)}
    file = written(tmp_path, stored, mode=mode, indices="i")
    assert mesh_normals(file, 0).origin is NormalsFrom.NONE
    with pytest.raises(DamagedPartError, match=r"\(mesh 0, primitive 0\): it has no triangles"):
        primitive_mesh(file, 0, 0)


@pytest.mark.parametrize(
    ("component", "code", "stored", "expected"),
    [
        (BYTE, "b", (127, -127, -128), (1, -1, -1)),
        (SHORT, "h", (32767, -32767, -32768), (1, -1, -1)),
        (UNSIGNED_SHORT, "H", (65535, 0, 13107), (1, 0, 0.2)),
    ],
)
def test_normalised_integers_reach_from_minus_one_to_one(
    tmp_path: Path, component: int, code: str, stored: tuple[int, ...], expected: tuple[float, ...]
) -> None:
    row = pack(f"<3{code}", *stored)
    row += b"\0" * (-len(row) % 4)
    positions = {"componentType": component, "normalized": True, "count": 3, "type": "VEC3"}
    view = {"buffer": 0, "byteLength": 3 * len(row), "byteStride": len(row)}
    file = written(tmp_path, {"POSITION": (row * 3, positions)}, bufferViews=[view])
    assert primitive_mesh(file, 0, 0).positions.tolist() == [list(expected)] * 3


def test_integers_that_are_not_normalised_stay_what_they_are(tmp_path: Path) -> None:
    data = pack("<12h", 0, 0, 0, 0, 700, 0, 0, 0, 0, -700, 0, 0)
    positions = {"componentType": SHORT, "count": 3, "type": "VEC3"}
    view = {"buffer": 0, "byteLength": len(data), "byteStride": 8}
    file = written(tmp_path, {"POSITION": (data, positions)}, bufferViews=[view])
    assert primitive_mesh(file, 0, 0).positions.tolist() == [[0, 0, 0], [700, 0, 0], [0, -700, 0]]


def test_attributes_may_stand_between_each_other(tmp_path: Path) -> None:
    normal = (0.0, 3.0, 0.0)
    data = b"".join(pack("<6f", *place, *normal) for place in POINTS[:3])
    shared = {"componentType": FLOAT, "count": 3, "type": "VEC3", "bufferView": 0}
    file = written(
        tmp_path,
        {"POSITION": (data, shared), "NORMAL": (b"", {**shared, "byteOffset": 12})},
        bufferViews=[{"buffer": 0, "byteLength": len(data), "byteStride": 24}],
    )
    mesh = primitive_mesh(file, 0, 0)
    assert mesh.positions.tolist() == [list(map(float, place)) for place in POINTS[:3]]
    assert mesh.normals.tolist() == [[0, 1, 0]] * 3  # at length one


def test_normals_that_are_missing_are_those_of_the_triangles(tmp_path: Path) -> None:
    mesh = primitive_mesh(written(tmp_path, {"POSITION": floats(POINTS[:3])}), 0, 0)
    assert mesh.normals.tolist() == [[0, 0, 1]] * 3


def test_an_accessor_without_a_view_is_all_zeros(tmp_path: Path) -> None:
    zeros = {"componentType": FLOAT, "count": 3, "type": "VEC3"}
    positions = {**zeros, "bufferView": 0}
    file = written(tmp_path, {"POSITION": floats(POINTS[:3])}, accessors=[positions, zeros])
    file.document.meshes[0].primitives[0].attributes["NORMAL"] = 1
    assert primitive_mesh(file, 0, 0).degenerate_normals == 3


def test_a_buffer_is_read_once_for_all_accessors(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    data, accessor = floats(POINTS)
    (tmp_path / "a b.bin").write_bytes(data)
    file = written(
        tmp_path,
        {"POSITION": (data, accessor), "NORMAL": (b"", {**accessor, "bufferView": 0})},
        buffers=[{"byteLength": len(data), "uri": "a%20b.bin"}],
    )
    read = []

    def counted(path: Path) -> bytes:
        read.append(path.name)
        return data

    monkeypatch.setattr(Path, "read_bytes", counted)
    for _ in range(3):
        primitive_mesh(file, 0, 0)
    assert read == ["a b.bin"]


GOOD = {"bufferView": 0, "componentType": FLOAT, "count": 3, "type": "VEC3"}
SPARSE = {
    "count": 1,
    "indices": {"bufferView": 0, "componentType": 5121},
    "values": {"bufferView": 0},
}


def sparse(**changes: object) -> dict[str, object]:
    return {"accessors": [{**GOOD, "sparse": {**SPARSE, **changes}}]}


def view(**changes: object) -> dict[str, object]:
    return {"bufferViews": [{"buffer": 0, "byteLength": 36, **changes}]}


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"accessors": []}, "accessor 0 does not exist"),
        (
            {"accessors": [{**GOOD, "componentType": 5124}]},
            "accessor 0 has the component type 5124, and it has to be of 5120, 5121, 5122,",
        ),
        (
            {"accessors": [{**GOOD, "type": "MAT9"}]},
            "POSITION (accessor 0) is of type MAT9 and has to be VEC3",
        ),
        ({"accessors": [{**GOOD, "type": "VEC2"}]}, "is of type VEC2 and has to be VEC3"),
        ({"accessors": [{**GOOD, "count": -1}]}, "accessor 0 has the count -1"),
        (
            {"accessors": [{**GOOD, "count": 1 << 40}]},
            "accessor 0 ends at byte 13194139533312 of buffer view 0, which has 36",
        ),
        (
            {"accessors": [{**GOOD, "bufferView": None, "count": 1 << 30}]},
            "accessor 0 claims 1073741824 elements without bytes, and of zeros 4194304 at most",
        ),
        ({"accessors": [{**GOOD, "bufferView": 7}]}, "buffer view 7 does not exist"),
        ({"accessors": [{**GOOD, "bufferView": -1}]}, "buffer view -1 does not exist"),
        (
            {"accessors": [{**GOOD, "count": 4}]},
            "accessor 0 ends at byte 48 of buffer view 0, which has 36",
        ),
        (
            {"accessors": [{**GOOD, "byteOffset": -4}]},
            "accessor 0 begins at byte -4 of buffer view 0",
        ),
        (
            view(byteStride=8),
            "buffer view 0 has the stride 8, and an element of accessor 0 has 12 bytes",
        ),
        (view(byteStride=-12), "buffer view 0 has the stride -12"),
        (view(byteOffset=-4), "buffer view 0 has a negative offset or length"),
        (view(byteLength=40), "buffer view 0 ends at byte 40, and buffer 0 has 36"),
        (view(buffer=2), "bufferViews[0].buffer: buffer 2 does not exist"),
        (sparse(count=4), "accessor 0 is sparse and changes more than its 3 elements"),
        (
            sparse(indices={"bufferView": 0, "componentType": 5126}),
            "accessor 0, in its sparse indices, has the component type 5126",
        ),
        (
            sparse(indices={"bufferView": 0, "componentType": 5121, "byteOffset": 15}),
            "accessor 0 changes its element 64 and has 3",
        ),
        (view(byteLength=10**300), "buffer view 0 ends at byte about 10^300, and buffer 0"),
        (
            sparse(values={"bufferView": 0, "byteOffset": 28}),
            "accessor 0, in its sparse values, ends at byte 40 of buffer view 0",
        ),
        ({"buffers": [{"byteLength": 99, "uri": "data:,AAAA"}]}, "3 bytes and needs 99; copy"),
        (
            {"buffers": [{"byteLength": 3, "uri": "data:,A?A"}]},
            "buffer 0 is embedded and is not base64",
        ),
        ({"buffers": [{"byteLength": 3, "uri": "none.bin"}]}, "buffer 0, none.bin: no such file"),
        ({"buffers": [{"byteLength": 36}]}, "buffer 0 names no file (it has no uri)"),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_every_damage_of_the_numbers_costs_its_primitive_and_has_one_line(
    tmp_path: Path, changes: dict[str, object], words: str
) -> None:
    file = written(tmp_path, {"POSITION": floats(POINTS[:3])}, **changes)
    with pytest.raises(DamagedPartError) as caught:
        primitive_mesh(file, 0, 0)
    message = str(caught.value)
    assert words in message
    assert message.startswith(f"{tmp_path / 'made.gltf'} (mesh 0, primitive 0): ")
    assert "\n" not in message
    found = mesh_normals(file, 0)
    assert (found.origin, found.degenerate) == (NormalsFrom.NONE, 0)
    assert str(found.faults[0]) == message


@pytest.mark.parametrize(
    ("stored", "words"),
    [
        (
            {"POSITION": floats([(0, 0, 0), (1, float("nan"), 0), (0, 1, 0)])},
            r"element 1 of accessor 0 \(1 nan 0\) is not finite",
        ),
        (
            {"POSITION": floats(POINTS), "NORMAL": floats(UP[:3])},
            "NORMAL has 3 elements for 5 vertices",
        ),
        (
            {"POSITION": floats(POINTS), "TEXCOORD_0": floats([(0, 0)])},
            "TEXCOORD_0 has 1 element for 5 vertices",
        ),
        (
            {"POSITION": floats(POINTS), "TEXCOORD_0": floats(POINTS)},
            r"TEXCOORD_0 \(accessor 1\) is of type VEC3 and has to be VEC2",
        ),
    ],
)
def test_attributes_that_do_not_fit_are_refused(
    tmp_path: Path, stored: dict[str, tuple[bytes, dict[str, object]]], words: str
) -> None:
    with pytest.raises(DamagedPartError, match=words):
        primitive_mesh(written(tmp_path, stored), 0, 0)


def test_an_index_beyond_the_vertices_is_refused(tmp_path: Path) -> None:
    stored = {"POSITION": floats(POINTS[:3]), "i": shorts([0, 1, 3])}
    with pytest.raises(DamagedPartError, match="its index 3 is beyond 3 vertices"):
        primitive_mesh(written(tmp_path, stored, indices="i"), 0, 0)


@pytest.mark.parametrize("component", [BYTE, SHORT, FLOAT])
def test_indices_are_unsigned_integers(tmp_path: Path, component: int) -> None:
    indices = (bytes(12), {"componentType": component, "count": 3, "type": "SCALAR"})
    file = written(tmp_path, {"POSITION": floats(POINTS), "i": indices}, indices="i")
    with pytest.raises(DamagedPartError, match=r"its indices .* have to be of uint8, uint16 or"):
        primitive_mesh(file, 0, 0)
