"""Mesh files: normals, coordinates and colours as the file has them, corner by corner."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from struct import pack

import numpy as np
import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.file import read_mesh, read_surface
from nmatrix.scene.meshes.mesh import Mesh, joined, unit

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"  # its geometric normal is (0, 0, 1)
MADE = ("Normals were made, area-weighted: a.obj does not have one for every vertex.",)
UP, RIGHT, BACK = [0, 1, 0], [1, 0, 0], [0, 0, 1]
NORMALS = "vn 0 2 0\nvn 3 0 0\n"  # not of length one, and not those of the square
PLY = (
    "ply\nformat {form} 1.0\nelement vertex {count}\n{vertex}"
    "element face {faces}\n{face}end_header\n"
)
FLOATS = "property float {}\n"
PLACES = "".join(FLOATS.format(one) for one in ("x", "y", "z", "nx", "ny", "nz"))
LIST = "property list uchar int vertex_indices\n"


def mesh_of(folder: Path, name: str, content: str | bytes) -> Mesh:
    path = folder / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_mesh(path)


def at_corners(mesh: Mesh, values: np.ndarray | None) -> list[list[float]]:
    """Return a value for each corner of each triangle, however its vertices are numbered."""
    assert values is not None
    return values[mesh.triangles].reshape(-1, values.shape[1]).tolist()


def header(vertex: str, face: str, *, form: str = "ascii", faces: int = 1, count: int = 3) -> str:
    return PLY.format(form=form, vertex=vertex, face=face, faces=faces, count=count)


def test_normals_of_an_obj_are_those_of_the_file(tmp_path: Path) -> None:
    for face in ("f 1//1 2//1 3//2\n", "f -4//-2 -3//-2 -2//-1\n"):
        mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + face)
        assert at_corners(mesh, mesh.positions) == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]
        assert at_corners(mesh, mesh.normals) == [UP, UP, RIGHT]
        assert mesh.remarks == ()


def test_a_vertex_with_two_normals_is_split(tmp_path: Path) -> None:
    faces = "f 1//1 2//1 3//1\nf 1//2 3//2 4//2\n"
    mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + faces)
    assert at_corners(mesh, mesh.normals) == [UP] * 3 + [RIGHT] * 3
    corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 0, 0], [1, 1, 0], [0, 1, 0]]
    assert at_corners(mesh, mesh.positions) == corners


def test_normals_and_coordinates_stand_at_the_same_corners(tmp_path: Path) -> None:
    text = SQUARE + NORMALS + "vt 0 0\nvt 1 0\nvt 0.5 1\nf 1/3/1 2/1/2 3/2/1\n"
    mesh = mesh_of(tmp_path, "a.obj", text)
    assert at_corners(mesh, mesh.normals) == [UP, RIGHT, UP]
    assert at_corners(mesh, mesh.uv) == [[0.5, 1], [0, 0], [1, 0]]


def test_faces_with_more_than_three_corners_keep_their_normals(tmp_path: Path) -> None:
    mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + "f 1//1 2//1 3//2 4//2\n")
    height = at_corners(mesh, mesh.positions)
    assert len(mesh.triangles) == 2
    expected = [UP if y == 0 else RIGHT for _, y, _ in height]
    assert at_corners(mesh, mesh.normals) == expected


def test_a_part_without_normals_gets_area_weighted_ones(tmp_path: Path) -> None:
    faces = "usemtl a\nf 1//1 2//1 3//1\nusemtl b\nf 1 3 4\n"
    mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + faces)
    by_corner = zip(at_corners(mesh, mesh.positions), at_corners(mesh, mesh.normals), strict=True)
    found = {(*place, *normal) for place, normal in by_corner}
    given = {(0, 0, 0, *UP), (1, 0, 0, *UP), (1, 1, 0, *UP)}
    made = {(0, 0, 0, *BACK), (1, 1, 0, *BACK), (0, 1, 0, *BACK)}
    assert found == given | made
    assert mesh.remarks == MADE


@pytest.mark.parametrize(
    "text",
    [
        SQUARE + "f 1 2 3\n",
        SQUARE + NORMALS + "f 1//9 2//0 3//-9\n",  # there is no ninth
        SQUARE + "vn nan 0 0\nf 1//1 2//1 3//1\n",
    ],
    ids=["none", "beyond the last", "not finite"],
)
def test_normals_that_are_not_all_there_are_made(tmp_path: Path, text: str) -> None:
    mesh = mesh_of(tmp_path, "a.obj", text)
    assert at_corners(mesh, mesh.normals) == [BACK] * 3 * len(mesh.triangles)
    assert mesh.remarks[-1:] == MADE


def test_a_normal_that_is_not_there_is_told_with_its_line(tmp_path: Path) -> None:
    mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + "f 1//1 2//1 3//9\n")
    told = "a.obj, line 7 is the first to name a normal that is not there: 1 corner goes without."
    assert told in mesh.remarks
    assert at_corners(mesh, mesh.normals) == [UP, UP, BACK]


def test_a_face_without_normals_beside_one_with_them_gets_its_own(tmp_path: Path) -> None:
    faces = "f 1//1 2//1 3//1\nf 1 3 4\n"
    mesh = mesh_of(tmp_path, "a.obj", SQUARE + NORMALS + faces)
    assert at_corners(mesh, mesh.normals) == [UP] * 3 + [BACK] * 3
    assert mesh.remarks == MADE


def test_a_normal_of_zero_is_kept_and_counted(tmp_path: Path) -> None:
    text = SQUARE + "vn 0 0 0\nvn 0 1e300 0\nf 1//1 2//2 3//2\n"
    mesh = mesh_of(tmp_path, "a.obj", text)
    assert at_corners(mesh, mesh.normals) == [[0, 0, 0], UP, UP]
    assert mesh.degenerate_normals == 1


@pytest.mark.parametrize("size", [5e-324, 1e-200, 1.0, 1e200, 1.7e308])
def test_a_vector_of_any_length_becomes_one_of_length_one(size: float) -> None:
    assert unit(np.array([[size, 0, 0], [0, -size, 0]])).tolist() == [[1, 0, 0], [0, -1, 0]]


ROWS = [(0, 0, 0, *UP), (1, 0, 0, *RIGHT), (0, 1, 0, *UP)]


@pytest.mark.parametrize("form", ["ascii", "binary_little_endian", "binary_big_endian"])
def test_normals_of_a_ply_are_those_of_the_file(tmp_path: Path, form: str) -> None:
    if form == "ascii":
        body = "".join(" ".join(map(str, row)) + "\n" for row in ROWS).encode() + b"3 0 1 2\n"
    else:
        order = "<" if "little" in form else ">"
        body = b"".join(pack(f"{order}6f", *row) for row in ROWS) + pack(f"{order}B3i", 3, 0, 1, 2)
    mesh = mesh_of(tmp_path, "a.ply", header(PLACES, LIST, form=form).encode() + body)
    assert at_corners(mesh, mesh.positions) == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]
    assert at_corners(mesh, mesh.normals) == [UP, RIGHT, UP]
    assert mesh.remarks == ()


def test_a_ply_with_coordinates_of_vertices_keeps_its_normals(tmp_path: Path) -> None:
    """The vertices stand in another order than that of their coordinates and of their use."""
    vertex = PLACES + FLOATS.format("s") + FLOATS.format("t")
    rows = "0 0 0 0 1 0 1 1\n1 0 0 1 0 0 0.5 0\n0 1 0 0 0 1 0 0\n9 9 9 0 0 1 0 0.5\n"
    mesh = mesh_of(tmp_path, "a.ply", header(vertex, LIST, count=4) + rows + "3 2 0 1\n")
    assert at_corners(mesh, mesh.positions) == [[0, 1, 0], [0, 0, 0], [1, 0, 0]]
    assert at_corners(mesh, mesh.uv) == [[0, 0], [1, 1], [0.5, 0]]
    assert at_corners(mesh, mesh.normals) == [BACK, UP, RIGHT]


def test_a_ply_with_coordinates_of_faces_keeps_its_normals(tmp_path: Path) -> None:
    """The second and the third vertex have two coordinates each, so they are split."""
    rows = "0 0 0 0 1 0\n1 0 0 1 0 0\n0 1 0 0 0 1\n1 1 0 0 -1 0\n"
    faces = "3 0 1 2 6 0 0 1 0 0 1\n3 2 1 3 6 0.5 0.5 0 0.5 1 1\n"
    face = LIST + "property list uchar float texcoord\n"
    mesh = mesh_of(tmp_path, "a.ply", header(PLACES, face, faces=2, count=4) + rows + faces)
    assert at_corners(mesh, mesh.uv) == [[0, 0], [1, 0], [0, 1], [0.5, 0.5], [0, 0.5], [1, 1]]
    assert at_corners(mesh, mesh.normals) == [UP, RIGHT, BACK, BACK, RIGHT, [0, -1, 0]]
    assert at_corners(mesh, mesh.positions)[3:] == [[0, 1, 0], [1, 0, 0], [1, 1, 0]]


def test_colours_of_faces_are_drawn_on_their_corners(tmp_path: Path) -> None:
    channels = "".join(f"property uchar {one}\n" for one in ("red", "green", "blue"))
    rows = "".join(" ".join(map(str, row)) + "\n" for row in ROWS)
    faces = "3 0 1 2 255 0 0\n3 2 1 0 0 51 0\n"
    text = header(PLACES, LIST + channels, faces=2) + rows + faces
    mesh = mesh_of(tmp_path, "a.ply", text)
    assert at_corners(mesh, mesh.colours) == [[1, 0, 0]] * 3 + [[0, 0.2, 0]] * 3
    assert at_corners(mesh, mesh.normals) == [UP, RIGHT, UP] * 2


def test_colours_of_the_vertices_of_a_ply_are_parts_of_255(tmp_path: Path) -> None:
    channels = "".join(f"property uchar {one}\n" for one in ("red", "green", "blue"))
    rows = "0 0 0 0 0 1 255 0 0\n1 0 0 0 0 1 0 51 0\n0 1 0 0 0 1 0 0 0\n"
    mesh = mesh_of(tmp_path, "a.ply", header(PLACES + channels, LIST) + rows + "3 0 1 2\n")
    assert at_corners(mesh, mesh.colours) == [[1, 0, 0], [0, 0.2, 0], [0, 0, 0]]


def test_normals_of_an_stl_follow_from_its_corners(tmp_path: Path) -> None:
    corners = "".join(f"vertex {place}\n" for place in ("0 0 0", "1 0 0", "0 1 0"))
    facet = f"facet normal 1 0 0\nouter loop\n{corners}endloop\nendfacet\n"
    mesh = mesh_of(tmp_path, "a.stl", f"solid a\n{facet}endsolid a\n")
    assert at_corners(mesh, mesh.normals) == [BACK] * 3
    two = mesh_of(tmp_path, "b.stl", f"solid a\n{facet}endsolid a\nsolid b\n{facet}endsolid b\n")
    assert len(two.triangles) == 2
    assert at_corners(two, two.positions) == [[0, 0, 0], [1, 0, 0], [0, 1, 0]] * 2


def test_the_text_of_an_obj_may_be_latin_1_or_hold_a_nul(tmp_path: Path) -> None:
    named = "# façade du château, côté sud, à l'échelle\n".encode("latin-1") * 4
    for content in (named + (SQUARE + "f 1 2 3\n").encode(), (SQUARE + "f 1 2 3\n\0").encode()):
        assert len(mesh_of(tmp_path, "a.obj", content).triangles) == 1


def test_joined_parts_keep_only_what_every_part_has() -> None:
    places, normals = np.eye(3), np.tile([0.0, 0.0, 1.0], (3, 1))
    order = np.array([[0, 1, 2]])
    full = Mesh(places, normals, order, uv=np.zeros((3, 2)), colours=np.ones((3, 3)))
    plain = Mesh(places + 5, normals, order)
    both = joined([full, plain])
    assert both.triangles.tolist() == [[0, 1, 2], [3, 4, 5]]
    assert both.positions[3:].tolist() == (places + 5).tolist()
    assert both.uv is both.colours is None
    made, other = (replace(full, remarks=(words,)) for words in ("a", "b"))
    assert joined([made, made, full, other]).remarks == ("a", "b")
    twice = joined([full, full])
    assert twice.uv is not None
    assert twice.colours is not None
    assert (len(twice.uv), len(twice.colours)) == (6, 6)


def test_a_mesh_has_a_normal_for_each_position_and_no_index_beyond() -> None:
    places, order = np.eye(3), np.array([[0, 1, 2]])
    with pytest.raises(IllegalValueError, match="3 positions and 2 normals"):
        Mesh(places, places[:2], order)
    for bad in (3, -1):
        with pytest.raises(IllegalValueError, match=f"index {bad}: the mesh has 3 vertices"):
            Mesh(places, places, np.array([[0, 1, bad]]))


@pytest.mark.parametrize(
    ("name", "content", "words"),
    [
        ("a.obj", b"", "it is empty"),
        ("a.obj", b" \n", "it is empty"),
        ("a.obj", b"v 0 0 0\nv 1 0 0\n", "it holds 2 points and no faces"),
        ("a.obj", b"# nothing\n", "it holds no triangles"),
        ("a.obj", SQUARE.encode() + b"f 1 2 9\n", "line 5 (9): the file has 4 lines v"),
        ("a.obj", SQUARE.encode() + b"f 1 2 0\n", "line 5 (0): indices of v count from 1"),
        ("a.obj", SQUARE.encode() + b"f 1 2 -5\n", "line 5 (-5): only 4 lines v stand before"),
        ("a.obj", SQUARE.encode() + b"f 1 2 3/\\\n x\n", "line 5 (x): x stands where a whole"),
        ("a.obj", SQUARE.encode() + b"f 1 2 3/1/1/1\n", "line 5 (3/1/1/1): a corner has three"),
        ("a.obj", SQUARE.encode() + b"f 1 2 /1\n", "line 5 (/1): indices of v count from 1"),
        ("a.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "line 1 (nan): a coordinate is a"),
        ("a.obj", b"\nv 1 0\nf 1 1 1\n", "line 2 (1 0): a vertex has 3 numbers and this one 2"),
        ("a.obj", b"v 1 0 1,5\n", "line 1 (1,5): 1,5 stands where a number is meant"),
        ("a.ply", b"no ply at all", "a PLY file begins with the line ply"),
        ("a.ply", header(PLACES, LIST, faces=0).encode() + b"0 0 0 0 0 1\n" * 3, "3 points and"),
        ("a.stl", b"solid\nendsolid\n", "it holds no triangles"),
        ("a.stl", b"\0" * 84, "it holds no triangles"),
        ("a.stl", b"\0" * 83, "it has 83 bytes"),
        ("a.txt", b"v 0 0 0", "meshes are .obj, .ply or .stl"),
    ],
)
def test_what_is_no_mesh_is_refused_in_one_line(
    tmp_path: Path, name: str, content: bytes, words: str
) -> None:
    with pytest.raises(IllegalValueError) as caught:
        mesh_of(tmp_path, name, content)
    message = str(caught.value)
    assert message.startswith(str(tmp_path / name))
    assert words in message
    assert "\n" not in message


def test_a_mesh_file_that_is_missing_is_named(tmp_path: Path) -> None:
    with pytest.raises(IllegalValueError, match=r"none\.obj: no such file"):
        read_mesh(tmp_path / "none.obj")


@pytest.mark.parametrize(("count", "words"), [(1, "1 point"), (2, "2 points")])
def test_points_alone_are_counted_in_a_right_sentence(
    tmp_path: Path, count: int, words: str
) -> None:
    point = "0 0 0\n"
    head = f"ply\nformat ascii 1.0\nelement vertex {count}\n"
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    (tmp_path / "a.ply").write_text(f"{head}{axes}end_header\n{point * count}")
    (tmp_path / "a.obj").write_text(f"v {point}" * count)
    for name in ("a.ply", "a.obj"):
        with pytest.raises(IllegalValueError, match=f"it holds {words} and no faces"):
            read_surface(tmp_path / name)


@pytest.mark.parametrize(
    ("name", "content"),
    [
        ("a.ply", "{head}0 0 0\n1 {number} 0\n0 1 0\n3 0 1 2\n"),
        ("a.obj", "v 0 0 0\nv 1 {number} 0\nv 0 1 0\nf 1 2 3\n"),
        ("a.stl", "solid a\nfacet normal 0 0 1\nouter loop\n{corners}endloop\nendfacet\n"),
    ],
)
def test_a_number_beyond_all_floats_is_told_as_it_stands_in_the_text(
    tmp_path: Path, name: str, content: str
) -> None:
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    head = f"ply\nformat ascii 1.0\nelement vertex 3\n{axes}{face}"
    corners = "vertex 0 0 0\nvertex 1 1e999 0\nvertex 0 1 0\n"
    text = content.format(head=head, number="1e999", corners=corners)
    (tmp_path / name).write_text(text)
    line = 1 + text[: text.index("1e999")].count("\n")
    with pytest.raises(IllegalValueError, match=rf"line {line} \(.*1e999") as caught:
        read_surface(tmp_path / name)
    assert " inf" not in str(caught.value)


@pytest.mark.parametrize("count", [1, 2])
def test_faces_without_three_corners_are_counted_as_faces(tmp_path: Path, count: int) -> None:
    points = "0 0 0\n1 0 0\n"
    axes = "".join(f"property float {axis}\n" for axis in "xyz")
    face = f"element face {count}\nproperty list uchar int vertex_indices\nend_header\n"
    head = f"ply\nformat ascii 1.0\nelement vertex 2\n{axes}{face}"
    (tmp_path / "a.ply").write_text(head + points + "2 0 1\n" * count)
    (tmp_path / "a.obj").write_text("v 0 0 0\nv 1 0 0\n" + "f 1 2\n" * count)
    told = "1 face" if count == 1 else "2 faces"
    for name in ("a.ply", "a.obj"):
        with pytest.raises(IllegalValueError, match=f"it holds {told} and none with three corners"):
            read_surface(tmp_path / name)
