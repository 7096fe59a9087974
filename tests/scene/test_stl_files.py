"""STL files: text and binary, and what their headers say wrongly."""

from __future__ import annotations

from pathlib import Path
from struct import pack

import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.file import read_mesh_file
from nmatrix.scene.meshes.parts import MeshFile

FACET = (
    "facet normal 9 9 9\n outer loop\n  vertex 0 0 0\n  vertex 1e0 0.0 0\n  vertex 0 +1.0E+0 0\n"
    " endloop\nendfacet\n"
)
TEXT = f"solid a part\n{FACET}{FACET}endsolid a part\n"
RECORD = pack("<12fH", 9, 9, 9, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0)
TRIANGLE = [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def binary(count: int, *, held: int | None = None, name: bytes = b"", after: bytes = b"") -> bytes:
    return name.ljust(80) + pack("<I", count) + RECORD * (count if held is None else held) + after


def file_of(folder: Path, content: str | bytes) -> MeshFile:
    path = folder / "a.stl"
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    return read_mesh_file(path)


@pytest.mark.parametrize(
    "content",
    [
        TEXT,
        TEXT.upper(),
        TEXT.replace("\n", "\r\n"),
        TEXT.replace("\n", "\r"),
        TEXT.replace("\n", " # why\n"),
        "# made by hand\n" + TEXT,
        f"solid vertex facet\n{FACET}endsolid\nsolid\n{FACET}endsolid\n",
        f"solid\n{FACET.replace(chr(10), ' ')}{FACET}",
        binary(2),
        binary(2, name=b"solid made by a program"),
    ],
    ids="text upper crlf cr comments comment-first solids one-line binary solid-binary".split(),
)
def test_two_triangles_are_two_flat_triangles(tmp_path: Path, content: str | bytes) -> None:
    mesh = file_of(tmp_path, content).parts[0].mesh
    assert mesh.positions[mesh.triangles].tolist() == [TRIANGLE] * 2
    assert mesh.normals.tolist() == [[0, 0, 1]] * 6


@pytest.mark.parametrize(
    ("content", "triangles", "words"),
    [
        (binary(0, held=2), 2, "The header counts 0 triangles; a.stl holds 2."),
        (binary(9, held=2), 2, "The header counts 9 triangles; a.stl holds 2."),
        (binary(2, after=b"abc"), 2, "Not read of a.stl: 3 bytes after the last triangle."),
        (binary(2)[:-2] + b"\x1f\x7c", 2, "Not drawn of a.stl: the attribute bytes of triangles."),
    ],
)
def test_what_a_header_says_wrongly_is_told(
    tmp_path: Path, content: bytes, triangles: int, words: str
) -> None:
    file = file_of(tmp_path, content)
    assert len(file.parts[0].mesh.triangles) == triangles
    assert words in file.remarks


@pytest.mark.parametrize(
    ("content", "words"),
    [
        (binary(2)[:-1], "it breaks off in triangle 2 of 2"),
        (binary(4_000_000_000, held=1, after=b"x"), "it breaks off in triangle 2 of 4,000,000,000"),
        (TEXT[:-40], "it breaks off in facet 2"),
        (binary(2, name=b"x")[:40], "it has 40 bytes"),
        (b"x", "it has 1 byte,"),
        (TEXT.replace("vertex", "vertx", 1), "did you mean vertex?"),
        (TEXT.replace("endloop", "endlop", 1), "(endlop): no line of an STL file begins so"),
        (TEXT.replace("0.0", "zero"), "line 5 (vertex 1e0 zero 0): zero stands where a number"),
        (TEXT.replace("1e0 0.0 0", "1e0 0.0"), "line 5 (vertex 1e0 0.0): a vertex has 3 numbers"),
        (TEXT.replace("0.0", "nan"), "triangle 1 (1 nan 0): a coordinate is a finite number"),
        (TEXT.replace(" endloop", "  vertex 1 1 1\n endloop"), "facet 1 has 4 vertices"),
    ],
)
def test_a_fault_is_told_with_its_place(tmp_path: Path, content: str | bytes, words: str) -> None:
    with pytest.raises(IllegalValueError) as caught:
        file_of(tmp_path, content)
    assert words in str(caught.value)


@pytest.mark.parametrize("content", [TEXT.encode(), binary(2)], ids=["text", "binary"])
def test_every_beginning_of_a_file_is_read_or_refused_in_one_line(
    tmp_path: Path, content: bytes
) -> None:
    refused = 0
    for end in range(1, len(content)):
        try:
            file_of(tmp_path, content[:end])
        except IllegalValueError as error:
            assert "\n" not in str(error)
            assert "Error" not in str(error)
            refused += 1
    assert refused > len(content) // 2
