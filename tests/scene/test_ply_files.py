"""PLY files: all three encodings hold the same, and each fault is told with element and row."""

from __future__ import annotations

import tempfile
from pathlib import Path
from struct import pack

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.elements import KINDS, ORDERS
from nmatrix.scene.meshes.file import read_mesh_file
from nmatrix.scene.meshes.parts import MeshFile

CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "i4": "i", "u4": "I", "f4": "f", "f8": "d"}
XYZ = [("float", "x"), ("float", "y"), ("float", "z")]
LIST = [("list uchar int", "vertex_indices")]
CORNERS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 1.5, 0)]
FACES = [([0, 1, 2, 3],), ([3, 2, 4],)]
VERTICES = ("vertex", XYZ, CORNERS)

Element = tuple[str, list[tuple[str, str]], list[tuple]]


def ply(form: str, *elements: Element, comment: str = "") -> bytes:
    lines = ["ply", f"format {form} 1.0", *([f"comment {comment}"] if comment else [])]
    body = b""
    for name, properties, rows in elements:
        lines.append(f"element {name} {len(rows)}")
        lines += [f"property {kind} {one}" for kind, one in properties]
        for row in rows:
            words = b""
            for (kind, _), value in zip(properties, row, strict=True):
                names = kind.split()[1:] if kind.startswith("list") else [kind]
                flat = [len(value), *value] if len(names) == 2 else [value]
                codes = [CODES[KINDS[names[0]]]] + [CODES[KINDS[names[-1]]]] * (len(flat) - 1)
                if ORDERS[form] is None:
                    words += "".join(f"{one!r} " for one in flat).encode()
                else:
                    words += pack(ORDERS[form] + "".join(codes), *flat)
            body += words + (b"\n" if ORDERS[form] is None else b"")
    return ("\n".join([*lines, "end_header"]) + "\n").encode() + body


def file_of(folder: Path, content: bytes) -> MeshFile:
    path = folder / "a.ply"
    path.write_bytes(content)
    return read_mesh_file(path)


def corners(file: MeshFile) -> list[list[float]]:
    mesh = file.parts[0].mesh
    return mesh.positions[mesh.triangles].reshape(-1, 3).tolist()


@pytest.mark.parametrize("form", ORDERS)
def test_faces_of_several_sizes_are_read_in_every_encoding(tmp_path: Path, form: str) -> None:
    found = corners(file_of(tmp_path, ply(form, VERTICES, ("face", LIST, FACES))))
    assert found == [list(CORNERS[i]) for i in (0, 1, 2, 0, 2, 3, 3, 2, 4)]


@settings(max_examples=40, deadline=None)
@given(st.data())
def test_three_encodings_of_one_content_read_the_same(data: st.DataObject) -> None:
    number = st.integers(-100, 100).map(lambda i: i / 8)
    places = st.lists(st.tuples(number, number, number), min_size=4, max_size=9, unique=True)
    vertices = data.draw(places)
    index = st.integers(0, len(vertices) - 1)
    face = st.tuples(
        st.lists(number, max_size=3), st.lists(index, min_size=3, max_size=5), st.integers(0, 9)
    )
    faces = data.draw(st.lists(face, min_size=1, max_size=6))
    kinds = st.sampled_from(["uchar", "ushort", "int", "uint", "int8", "int16", "uint32"])
    count, kind = data.draw(kinds), data.draw(kinds)
    properties = [
        (f"list {count} double", "more"),
        (f"list {count} {kind}", "vertex_index"),
        ("short", "id"),
    ]
    elements = (
        ("before", [("uchar", "a"), ("list uchar short", "b")], [(1, [2, 3]), (4, [])]),
        ("vertex", XYZ, vertices),
        ("face", properties, faces),
        ("edge", [("int", "vertex1"), ("int", "vertex2")], [(0, 1)]),
    )
    found = []
    with tempfile.TemporaryDirectory() as folder:
        for form in ORDERS:
            file = file_of(Path(folder), ply(form, *elements))
            found.append((corners(file), file.remarks))
    assert found[0] == found[1] == found[2]
    assert len(found[0][0]) == 3 * sum(len(one[1]) - 2 for one in faces)


@pytest.mark.parametrize("form", ORDERS)
def test_strips_turn_every_second_triangle(tmp_path: Path, form: str) -> None:
    strip = [([0, 1, 3, 2, 4, -1, 0, 0, 1, 2],)]
    content = ply(form, VERTICES, ("tristrips", [("list int int", "vertex_indices")], strip))
    order = (0, 1, 3, 3, 1, 2, 3, 2, 4, 1, 0, 2)
    assert corners(file_of(tmp_path, content)) == [list(CORNERS[i]) for i in order]


@pytest.mark.parametrize(
    ("kind", "values", "expected"),
    [
        ("uchar", (255, 51, 0), [1, 0.2, 0]),
        ("ushort", (65535, 13107, 0), [1, 0.2, 0]),
        ("float", (1.0, 0.25, 0.0), [1, 0.25, 0]),
        ("double", (255.0, 51.0, 0.0), [1, 0.2, 0]),
    ],
)
@pytest.mark.parametrize(
    "names", ["red green blue", "diffuse_red diffuse_green diffuse_blue", "r g b"]
)
def test_colours_are_drawn_whatever_their_kind_and_place(
    tmp_path: Path, kind: str, values: tuple[float, ...], expected: list[float], names: str
) -> None:
    channels = [(kind, name) for name in names.split()]
    of_vertices = ("vertex", XYZ + channels, [(*one, *values) for one in CORNERS])
    of_faces = ("face", LIST + channels, [(*one, *values) for one in FACES])
    for elements in ((of_vertices, ("face", LIST, FACES)), (VERTICES, of_faces)):
        part = file_of(tmp_path, ply("ascii", *elements)).parts[0]
        assert part.mesh.colours is not None
        assert np.allclose(part.mesh.colours, expected)
        assert part.material is not None
        assert part.material.vertex_colours


def test_the_image_of_a_ply_is_drawn_where_its_vertices_have_places_on_it(tmp_path: Path) -> None:
    (tmp_path / "my image.png").write_bytes(b"")
    placed = (
        "vertex",
        [*XYZ, ("float", "s"), ("float", "t")],
        [(*one, *one[:2]) for one in CORNERS],
    )
    content = ply("ascii", placed, ("face", LIST, FACES), comment="TextureFile my image.png")
    material = file_of(tmp_path, content).parts[0].material
    assert material is not None
    assert material.texture is not None
    assert material.texture.image == tmp_path / "my image.png"
    bare = ply("ascii", VERTICES, ("face", LIST, FACES), comment="TextureFile my image.png")
    assert "Not drawn of a.ply: an image." in file_of(tmp_path, bare).remarks
    gone = ply("ascii", VERTICES, ("face", LIST, FACES), comment="TextureFile gone.png")
    assert "Files are missing: gone.png." in file_of(tmp_path, gone).remarks
    outside = ply("ascii", VERTICES, ("face", LIST, FACES), comment="TextureFile ../x.png")
    with pytest.raises(IllegalValueError, match="outside its folder"):
        file_of(tmp_path, outside)


PLAIN = ply("ascii", VERTICES, ("face", LIST, FACES))


@pytest.mark.parametrize(
    "content",
    [
        PLAIN.replace(b"\n", b"\r"),
        PLAIN.replace(b"\n", b"\r\n"),
        PLAIN.replace(b" ", b"  \t"),
        PLAIN.replace(b"end_header\n", b"end_header\n\n \n"),
        PLAIN.replace(b"end_header\n", b"end_header\ncomment in the body\n"),
        PLAIN.replace(b"1.0\n", b"1.0\ncomment M\xf6bius\nobj_info x\n", 1),
        PLAIN.replace(b"0.5 1.5 0 \n", b"0.5 1.5 0 9 9\n"),
        PLAIN.replace(b"3 3 2 4", b"3 3\n2 4"),
        ply("binary_little_endian", VERTICES, ("face", LIST, FACES)).replace(b"\n", b"\r", 11),
    ],
    ids="cr crlf tabs blank-lines comments latin-1 longer-lines broken-lines cr-binary".split(),
)
def test_any_way_to_write_a_file_is_read(tmp_path: Path, content: bytes) -> None:
    assert corners(file_of(tmp_path, content)) == corners(file_of(tmp_path, PLAIN))


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (ply("ascii", VERTICES), "it holds 5 points and no faces"),
        (ply("ascii", ("face", LIST, FACES)), "it holds no vertices"),
        (ply("ascii", ("vertex", XYZ[:2], [(0, 0)])), "its vertices have no x, y and z"),
        (PLAIN.replace(b"3 3 2 4", b"3 3 2 5"), "row 2 of the element face (index 5)"),
        (PLAIN.replace(b"3 3 2 4", b"3 3 2 -1"), "row 2 of the element face (index -1)"),
        (PLAIN.replace(b"0.5 1.5 0", b"0.5 x 0"), "line 14 (x): x stands where a number is meant"),
        (
            PLAIN.replace(b"0.5 1.5 0", b"0.5 inf 0"),
            "vertex 4 (0.5 inf 0): a coordinate is a finite",
        ),
        (PLAIN.replace(b"float y", b"flaot y"), "line 5 (property flaot y): "),
        (PLAIN.replace(b"ascii", b"ascij"), "did you mean ascii?"),
        (PLAIN.split(b"end_header")[0], "its header breaks off in line 9"),
    ],
)
def test_a_fault_is_told_with_its_place(tmp_path: Path, content: bytes, words: str) -> None:
    with pytest.raises(IllegalValueError) as caught:
        file_of(tmp_path, content)
    assert words in str(caught.value)


@pytest.mark.parametrize("form", ORDERS)
def test_a_body_that_breaks_off_in_a_row_names_it(tmp_path: Path, form: str) -> None:
    content = ply(form, VERTICES, ("face", LIST, FACES))
    short = content.rstrip()[:-2] if form == "ascii" else content[:-1]
    with pytest.raises(IllegalValueError, match="breaks off in row 2 of 2 of the element face"):
        file_of(tmp_path, short)


@pytest.mark.parametrize("form", ORDERS)
def test_every_beginning_of_a_file_is_read_or_refused_in_one_line(
    tmp_path: Path, form: str
) -> None:
    content = ply(form, VERTICES, ("face", LIST, FACES))
    refused = 0
    for end in range(1, len(content)):
        try:
            file_of(tmp_path, content[:end])
        except IllegalValueError as error:
            assert "\n" not in str(error)
            assert "Error" not in str(error)
            refused += 1
    assert refused >= len(content) - 3


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("element", ["vertex 5", "face 2"])
def test_a_huge_count_is_refused_at_once(tmp_path: Path, form: str, element: str) -> None:
    content = ply(form, VERTICES, ("face", LIST, FACES))
    huge = content.replace(element.encode(), f"{element.split()[0]} 4000000000".encode())
    with pytest.raises(IllegalValueError, match=r"4,000,000,000"):
        file_of(tmp_path, huge)
    longer = ply(form, VERTICES, ("face", [("list uint int", "vertex_indices")], FACES))
    if form != "ascii":
        first = pack(ORDERS[form] + "I", 4)
        head, body = longer.split(b"end_header\n")
        longer = (
            head + b"end_header\n" + body[:60] + body[60:].replace(first, b"\xff\xff\xff\x7f", 1)
        )
        with pytest.raises(IllegalValueError, match="breaks off in row 1 of 2"):
            file_of(tmp_path, longer)


@pytest.mark.parametrize("form", ORDERS)
@pytest.mark.parametrize("before", [0, 1])
@pytest.mark.parametrize("length", [float("nan"), float("inf"), -1.0, 3.5])
def test_a_length_that_no_list_has_is_refused_with_its_row(
    tmp_path: Path, form: str, before: int, length: float
) -> None:
    """A length may be of any kind that a header can name, and so any number."""
    spelled = [("float", "length"), *[("int", f"corner{i}") for i in range(3)]]
    rows = [(3.0, 0, 1, 2)] * before + [(length, 0, 1, 2)]
    content = ply(form, VERTICES, ("face", spelled, rows))
    head, body = content.split(b"end_header\n")
    declared = head[: head.index(b"property float length")]
    content = declared + b"property list float int vertex_indices\nend_header\n" + body
    with pytest.raises(IllegalValueError, match=f"row {1 + before} .* has the length {length:g};"):
        file_of(tmp_path, content)
