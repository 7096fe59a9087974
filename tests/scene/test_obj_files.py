"""OBJ files and their materials: what the format allows is read, and what is wrong is told."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from nmatrix.enums import Reflection
from nmatrix.errors import IllegalValueError
from nmatrix.raster.loaded_scene import loaded
from nmatrix.scene.meshes.file import read_mesh, read_mesh_file
from nmatrix.scene.meshes.parts import MeshFile
from nmatrix.scene.open import scene_of
from nmatrix.scene.words import NormalsFrom, Wrap

SQUARE = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
TWO = "mtllib two.mtl\nusemtl red\n" + SQUARE + "f 1 2 3\nusemtl green\nf 1 3 4\n"
MTL = "newmtl red\nKd 1 0 0\nnewmtl green\nKd 0 1 0\nKs .5 .5 .5\nNs 9\nillum 2\nd 0.5\n"


def file_of(folder: Path, text: str | bytes, mtl: str | None = None) -> MeshFile:
    path = folder / "a.obj"
    path.write_bytes(text if isinstance(text, bytes) else text.encode())
    if mtl is not None:
        (folder / "two.mtl").write_text(mtl)
    return read_mesh_file(path)


def corners(file: MeshFile) -> list[list[float]]:
    return [
        corner
        for part in file.parts
        for corner in part.mesh.positions[part.mesh.triangles].reshape(-1, 3).tolist()
    ]


def test_relative_indices_are_counted_from_their_own_line(tmp_path: Path) -> None:
    moved = SQUARE.replace("v 0", "v 5").replace("v 1", "v 6")
    face = "f -4 -3 -2 -1\n"
    found = file_of(tmp_path, SQUARE + face + moved + face)
    plain = file_of(tmp_path, SQUARE + moved + "f 1 2 3 4\nf 5 6 7 8\n")
    assert corners(found) == corners(plain)
    assert len({tuple(corner) for corner in corners(found)}) == 8


def test_indices_may_name_vertices_that_come_later(tmp_path: Path) -> None:
    assert corners(file_of(tmp_path, "f 1 2 3\n" + SQUARE)) == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]


@pytest.mark.parametrize(
    "text",
    [
        SQUARE.replace("\n", "\r\n") + "f 1 2 3\r\n",
        SQUARE.replace("\n", "\r") + "f 1 2 3",
        "\ufeff" + SQUARE + "f 1 2 3",
        SQUARE.replace(" ", "\t  ") + " f  1 \t2 3  \n",
        SQUARE + "f 1 \\\n2 \\\r\n3\n",
        SQUARE.replace("\n", " # a corner\n") + "f 1 2 3 # a face\n#f 1 2 4\n",
        SQUARE.replace("1", "+1.0e0") + "f 1 2 3\n",
        SQUARE.replace("0\n", "0 1.0\n") + "f 1 2 3\n",
        (SQUARE + "g côté\nf 1 2 3\n").encode("latin-1"),
        (SQUARE + "f 1 2 3\n").encode("utf-16"),
        b"\xfe\xff" + (SQUARE + "f 1 2 3\n").encode("utf-16-be"),
    ],
    ids="crlf cr mark blanks continued comments signs weights latin-1 utf-16 utf-16-be".split(),
)
def test_any_way_to_write_a_triangle_is_read(tmp_path: Path, text: str | bytes) -> None:
    assert corners(file_of(tmp_path, text)) == [[0, 0, 0], [1, 0, 0], [1, 1, 0]]


def test_a_long_file_is_read_as_a_short_one(tmp_path: Path) -> None:
    """Blocks of one kind are read at once, and others line by line: both count lines alike."""
    count = 70_000
    vertices = "".join(f"v {i} {i % 7} 0\n" for i in range(count))
    faces = "".join(f"f {i} {i + 1} {i + 2}\n" for i in range(1, count - 1))
    relative = "".join(
        f"v {i} {i % 7} 0\n" + ("f -3 -2 -1\n" if i > 1 else "") for i in range(count)
    )
    one, other = file_of(tmp_path, vertices + faces), file_of(tmp_path, relative)
    assert np.array_equal(one.parts[0].mesh.positions, other.parts[0].mesh.positions)
    assert np.array_equal(one.parts[0].mesh.triangles, other.parts[0].mesh.triangles)
    with pytest.raises(IllegalValueError, match=rf"line {2 * count - 1} \(x\)"):
        file_of(tmp_path, vertices + faces + "f 1 2 x\n")
    with pytest.raises(IllegalValueError, match=rf"line {2 * count - 1} \(99999999\)"):
        file_of(tmp_path, vertices + faces + "f 1 99999999 2\n" + faces)


def test_what_is_not_drawn_is_counted(tmp_path: Path) -> None:
    file = file_of(tmp_path, SQUARE + "l 1 2\nl 2 3\np 1\ncurv 0 1 1 2\nf 1 2\nf 1 2 3\n")
    told = "lines (2), points (1), curves (1), faces with fewer than three corners (1)"
    assert f"Not drawn of a.obj: {told}." in file.remarks


@pytest.mark.parametrize(
    ("word", "is_flat"), [("off", True), ("0", True), ("1", False), ("", False)]
)
def test_made_normals_are_flat_where_smoothing_is_off(
    tmp_path: Path, word: str, is_flat: bool
) -> None:
    roof = "v 0 0 0\nv 0 0 1\nv 1 .25 0\nv 1 .25 1\nv 2 0 0\nv 2 0 1\n"
    file = file_of(tmp_path, roof + (f"s {word}\n" if word else "") + "f 1 2 4 3\nf 3 4 6 5\n")
    mesh = file.parts[0].mesh
    assert file.normals_from is NormalsFrom.COMPUTED
    assert len(mesh.positions) == (8 if is_flat else 6)
    assert (abs(abs(mesh.normals[:, 0]) - 17**-0.5) < 1e-12).all() == is_flat
    assert any("flat" in one for one in file.remarks) == is_flat


def test_smoothing_groups_meet_in_an_edge(tmp_path: Path) -> None:
    roof = "v 0 0 0\nv 0 0 1\nv 1 1 0\nv 1 1 1\nv 2 0 0\nv 2 0 1\n"
    mesh = file_of(tmp_path, roof + "s 1\nf 1 2 4 3\ns 2\nf 3 4 6 5\n").parts[0].mesh
    assert len(mesh.positions) == 8


def test_colours_of_vertices_are_drawn_without_being_asked_for(tmp_path: Path) -> None:
    text = "v 0 0 0 1 0 0\nv 1 0 0 0 .5 0\nv 0 1 0\nf 1 2 3\n"
    (part,) = file_of(tmp_path, text).parts
    assert part.mesh.colours is not None
    assert part.mesh.colours.tolist() == [[1, 0, 0], [0, 0.5, 0], [1, 1, 1]]
    assert part.material is not None
    assert part.material.vertex_colours
    of_bytes = file_of(tmp_path, "v 0 0 0 255 0 0\nv 1 0 0 0 51 0\nv 0 1 0 0 0 0\nf 1 2 3\n")
    assert of_bytes.parts[0].mesh.colours.tolist()[1] == [0, 0.2, 0]
    assert any("parts of 255" in one for one in of_bytes.remarks)
    odd = file_of(tmp_path, "v 0 0 0 nan 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 0\nf 1 2 3\n")
    assert odd.parts[0].mesh.colours.tolist()[0] == [1, 1, 1]
    assert any("drawn white: 1" in one for one in odd.remarks)


def test_materials_are_those_of_the_library_and_name_the_objects(tmp_path: Path) -> None:
    file = file_of(tmp_path, TWO, MTL)
    red, green = (part.material for part in file.parts)
    assert red is not None
    assert green is not None
    assert (red.diffuse, green.diffuse) == ((0.85, 0, 0), (0, 0.85, 0))  # the rest is ambient
    assert (red.reflection, green.reflection) == (Reflection.LAMBERT, Reflection.BLINN_PHONG)
    assert (green.shininess, green.opacity) == (9, 0.5)
    assert [one.name for one in scene_of(tmp_path / "a.obj").objects] == ["a/red", "a/green"]
    assert len(read_mesh(tmp_path / "a.obj").triangles) == 2


@pytest.mark.parametrize(
    ("line", "field", "value"),
    [
        ("Ka 1 1 1", "ambient", (0.15, 0.15, 0.15)),
        ("Ka 0", "ambient", (0.15, 0, 0)),
        ("Ka 0.5 0.5 0", "ambient", (0.075, 0.075, 0)),
        ("Tr 0.25", "opacity", 0.75),
        ("d -halo 0.25", "opacity", 0.25),
        ("illum 0", "unlit", (1, 0, 0)),
        ("Ke 0 0 2", "emission", (0, 0, 1)),
        ("Ns nan", "shininess", 32),
    ],
)
def test_a_line_of_a_material_is_read(tmp_path: Path, line: str, field: str, value: object) -> None:
    file = file_of(tmp_path, TWO, f"newmtl red\nKd 1 0 0\n{line}\nnewmtl green\n")
    assert getattr(file.parts[0].material, field) == value
    assert any("two.mtl, line 3" in one for one in file.remarks) == ("nan" in line)


def test_images_are_found_with_their_options(tmp_path: Path) -> None:
    (tmp_path / "my images").mkdir()
    (tmp_path / "my images" / "a b.png").write_bytes(b"")
    options = "-s 2 3 1 -o 0.5 -clamp on -bm 0.2"
    red = f"newmtl red\nmap_Kd {options} my images\\a b.png\n"
    mtl = red + "newmtl green\nmap_Kd none.png\nmap_Bump b\n"
    file = file_of(tmp_path, TWO.replace("f 1 2 3", "vt 0 0\nf 1/1 2/1 3/1"), mtl)
    texture = file.parts[0].material.texture
    assert texture.image == tmp_path / "my images" / "a b.png"
    assert (texture.scale, texture.offset) == ((2, 3), (0.5, 0))
    assert texture.wrap == (Wrap.CLAMP, Wrap.CLAMP)
    assert file.parts[1].material.texture is None
    assert "Files are missing: none.png (two.mtl, line 4)." in file.remarks
    assert "Not drawn of the materials: bumps." in file.remarks


def test_a_library_or_a_material_that_is_missing_is_a_remark(tmp_path: Path) -> None:
    file = file_of(tmp_path, TWO)
    assert "Files are missing: two.mtl (a.obj, line 1)." in file.remarks
    told = "Materials are missing: red (a.obj, line 2), green (a.obj, line 8)."
    assert told in file.remarks
    (told,) = file_of(tmp_path, TWO, "newmtl red\n").remarks[1:]
    assert told == "Materials are missing: green (a.obj, line 8)."


@pytest.mark.parametrize(
    ("text", "mtl"),
    [
        (TWO.replace("two.mtl", "two.mtl # inline comment"), MTL),
        (TWO.replace("usemtl red", "usemtl red # ../x"), MTL),
        (TWO, MTL.replace("newmtl red", "newmtl red # of roses")),
        (TWO.replace("usemtl red", "usemtl red #25"), MTL.replace("newmtl red", "newmtl red #25")),
    ],
)
def test_a_comment_behind_a_name_costs_no_colour(tmp_path: Path, text: str, mtl: str) -> None:
    file = file_of(tmp_path, text, mtl)
    assert len(file.remarks) == 1  # of normals
    red = file.parts[0].material
    assert red is not None
    assert red.diffuse[1:] == (0, 0) < red.diffuse[:2]


def test_an_image_is_found_before_a_comment(tmp_path: Path) -> None:
    (tmp_path / "a.png").write_bytes(b"")
    text = TWO.replace("f 1 2 3", "vt 0 0\nf 1/1 2/1 3/1")
    file = file_of(tmp_path, text, "newmtl red\nmap_Kd a.png # diffuse\nnewmtl green\n")
    assert file.parts[0].material.texture.image == tmp_path / "a.png"


def test_a_value_that_is_none_is_shown_as_written_with_what_is_taken(tmp_path: Path) -> None:
    mtl = "newmtl red\nKd 1 zero 0\nNs much\nnewmtl green\n"
    remarks = file_of(tmp_path, TWO, mtl).remarks
    told = "two.mtl, line 2 (Kd 1 zero 0): it was not understood; 0.8 0.8 0.8 is taken."
    assert told in remarks
    assert any("line 3 (Ns much): it was not understood; " in one for one in remarks)


def test_matrices_need_no_material(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text(TWO.replace("two.mtl", "../two.mtl"))
    scene = scene_of(path)
    assert [one.name for one in scene.objects] == ["a/red", "a/green"]
    with pytest.raises(
        IllegalValueError, match=r"line 1\): it names ../two.mtl, which lies outside"
    ):
        loaded(scene)


@pytest.mark.parametrize("name", ["../x.mtl", "/etc/passwd", "file:///etc/passwd", "C:\\x.mtl"])
def test_nothing_outside_of_the_folder_is_reached(tmp_path: Path, name: str) -> None:
    folder = tmp_path / "deep"
    folder.mkdir()
    with pytest.raises(IllegalValueError, match="outside its folder"):
        file_of(folder, TWO.replace("two.mtl", name))
    with pytest.raises(IllegalValueError, match="outside its folder"):
        file_of(folder, TWO, f"newmtl red\nmap_Kd {name}\n")
    assert len(read_mesh(folder / "a.obj").triangles) == 2


def test_every_beginning_of_a_file_is_read_or_refused_in_one_line(tmp_path: Path) -> None:
    text = (TWO.replace("f 1", "vt 0 1\nvn 0 0 1\nf 1/1/1") + "f -4//-1 -3/-1 -2\n").encode()
    refused = 0
    for end in range(len(text)):
        try:
            file_of(tmp_path, text[:end])
        except IllegalValueError as error:
            assert "\n" not in str(error)
            assert "Error" not in str(error)
            refused += 1
    assert 0 < refused < len(text)


@pytest.mark.parametrize(
    ("lines", "opacity"),
    [("Tr 1", 1), ("Tr 1\nillum 9", 0), ("d 0", 0), ("Tr 0.25", 0.75), ("Tr 1\nd 0.5", 0.5)],
)
def test_a_material_that_would_let_all_through_is_opaque_as_some_programs_mean_it(
    tmp_path: Path, lines: str, opacity: float
) -> None:
    file = file_of(tmp_path, TWO, f"newmtl red\nKd 1 0 0\n{lines}\nnewmtl green\nKd 0 1 0\n")
    found = file.parts[0].material
    assert found is not None
    assert found.opacity == opacity
    assert any("(Tr 1)" in one for one in file.remarks) is (lines == "Tr 1")


def test_what_a_file_has_beside_faces_is_counted_and_named(tmp_path: Path) -> None:
    path = tmp_path / "a.obj"
    path.write_text("v 0 0 0\nv 1 0 0\nl 1 2\nl 2 1\n")
    with pytest.raises(IllegalValueError, match="it holds 2 lines and no faces"):
        read_mesh(path)
    mtl = "newmtl red\nKd 1 0 0\nmap_Disp a.png\nPs 1\nmap_Kd -colorspace sRGB none.png\n"
    file_of(tmp_path, f"{TWO}l 1 2\n", mtl)
    features = {one.feature: one for one in scene_of(path).features}
    assert features["lines"].count == 1
    assert features["material with displacement"].made_of_it == "not drawn"
    assert features["material with sheen"].count == 1
    assert features["missing file"].count == 1
    assert features["material"].made_of_it == "drawn but for what is named here"
    assert "Files are missing: none.png (two.mtl, line 5)." in scene_of(path).remarks


def test_a_black_colour_over_an_image_does_not_black_it_out(tmp_path: Path) -> None:
    Image.new("RGB", (1, 1), (255, 0, 0)).save(tmp_path / "a.png")
    file = file_of(tmp_path, TWO, "newmtl red\nKd 0 0 0\nmap_Kd a.png\nnewmtl green\nKd 0 0 0\n")
    red, green = (part.material for part in file.parts)
    assert red is not None
    assert green is not None
    assert min(red.diffuse) > 0.8
    assert green.diffuse == (0, 0, 0)
    assert any("a black Kd over an image" in one for one in file.remarks)


def test_a_library_that_nothing_uses_is_told(tmp_path: Path) -> None:
    text = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"
    file = file_of(tmp_path, text, "newmtl red\nKd 1 0 0\n")
    assert "a.obj names a.mtl and uses no material of it." in file.remarks
