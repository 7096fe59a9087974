"""Where a matrix comes from: stdin, a file, a key in either, or the words themselves."""

from __future__ import annotations

import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError
from nmatrix.reading.arrays import read_matrix
from nmatrix.reading.literal import MatrixLiteral
from nmatrix.reading.source import matrix_source

JSON = '{"normal_matrix": [[1,0],[0,2]], "other": [[3,0],[0,3]]}'


def no_stdin() -> str:
    raise AssertionError("stdin was read")


def source(text: str, layout: Layout = Layout.ROW_MAJOR) -> MatrixLiteral:
    return matrix_source(text, no_stdin, layout)


@pytest.fixture(autouse=True)
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_stdin_and_its_keys() -> None:
    assert matrix_source("-", lambda: JSON).rows[1][1] == 2
    assert matrix_source("-#other", lambda: JSON).rows[1][1] == 3
    assert matrix_source("-", lambda: JSON).source == "stdin"


def test_a_literal_that_begins_with_a_minus_is_not_stdin() -> None:
    assert source("-1 0; 0 1").rows[0][0] == -1


def test_an_existing_file_comes_first(folder: Path) -> None:
    (folder / "1 0; 0 1").write_text("5 0; 0 5")
    (folder / "a#other").write_text("6 0; 0 6")
    (folder / "a").write_text(JSON)
    assert source("1 0; 0 1").rows[0][0] == 5
    assert source("a#other").rows[0][0] == 6


def test_a_file_and_its_keys(folder: Path) -> None:
    (folder / "my#file.json").write_text(JSON)
    assert source("my#file.json").rows[1][1] == 2
    assert source("my#file.json#other").rows[1][1] == 3
    with pytest.raises(IllegalValueError, match="choose one of normal_matrix, other"):
        source("my#file.json#none")


@pytest.mark.parametrize("name", ["a.txt", "a.csv", "a.json", "a"])
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "utf-16"])
def test_the_text_decides_not_the_name(folder: Path, name: str, encoding: str) -> None:
    for text in ("1,0\n0,2\n", "[[1, 0], [0, 2]]", JSON, "1 0\r\n0 2\r\n"):
        (folder / name).write_bytes(text.encode(encoding))
        assert source(name).rows == ((1.0, 0.0), (0.0, 2.0))


@pytest.mark.parametrize("dtype", ["<f8", ">f8", "<f4", "<i4", "u1"])
@pytest.mark.parametrize("order", ["C", "F"])
def test_npy(folder: Path, dtype: str, order: str) -> None:
    array = np.asarray(np.arange(9).reshape(3, 3), dtype=dtype, order=order)  # type: ignore[call-overload]
    np.save(folder / "a.npy", array)
    assert source("a.npy").rows == tuple(map(tuple, array.tolist()))
    assert source("a.npy", Layout.COLUMN_MAJOR).rows == tuple(map(tuple, array.T.tolist()))


@pytest.mark.parametrize("shape", [(4, 8), (8, 4), (8, 8), (1, 8), (8, 1)])
def test_the_corners_of_a_box_are_read_from_files_and_arrays(
    folder: Path, shape: tuple[int, int]
) -> None:
    array = np.sqrt(np.arange(shape[0] * shape[1])).reshape(shape)
    np.save(folder / "a.npy", array)
    np.savetxt(folder / "a.csv", array, delimiter=",", fmt="%.17g")
    expected = tuple(map(tuple, array.tolist()))
    assert source("a.npy").rows == source("a.csv").rows == expected
    assert read_matrix(array, "answer").rows == expected
    assert read_matrix(array.tolist(), "answer").rows == expected


def test_nine_rows_of_files_and_arrays_are_refused(folder: Path) -> None:
    array = np.ones((9, 2))
    np.save(folder / "a.npy", array)
    with pytest.raises(IllegalValueError, match="use at most 8×8"):
        source("a.npy")
    with pytest.raises(IllegalValueError, match="it has 9 rows"):
        read_matrix(array + np.arange(2), "answer")


@pytest.mark.parametrize("name", ["a.npy", "a.npz", "a.NPY"])
def test_what_is_named_as_numpy_names_it_and_is_another_file(folder: Path, name: str) -> None:
    for content in (b"", b"PK\x03\x04", b"\x89PNG\r\n", b"1 0 0; 0 1 0; 0 0 1"):
        (folder / name).write_bytes(content)
        with pytest.raises(IllegalValueError, match=r"does not begin as a \.npy file does; save a"):
            source(name)


def test_npy_keeps_every_bit(folder: Path) -> None:
    array = np.array([[0.1, 5e-324], [1.7976931348623157e308, -1 / 3]])
    np.save(folder / "a.npy", array)
    assert np.array_equal(np.array(source("a.npy").rows), array)


@pytest.mark.parametrize(
    "array",
    [
        np.array([["a", "b"]]),
        np.array([[1j, 0], [0, 1]]),
        np.zeros((2, 2, 2)),
        np.zeros((50, 50)),
        np.array([[np.nan, 0], [0, 1]]),
        np.array([[np.inf, 0], [0, 1]]),
        np.zeros((0, 3)),
        np.array([[True, False], [False, True]]),
    ],
    ids=str,
)
def test_npy_refusals(folder: Path, array: np.ndarray) -> None:
    np.save(folder / "a.npy", array)
    with pytest.raises(IllegalValueError):
        source("a.npy")


def test_npy_never_unpickles(folder: Path) -> None:
    np.save(folder / "a.npy", np.array([{"a": 1}], dtype=object), allow_pickle=True)
    with pytest.raises(IllegalValueError, match="Python objects"):
        source("a.npy")


@pytest.mark.parametrize("cut", [6, 8, 20, 100, 130])
def test_damaged_npy(folder: Path, cut: int) -> None:
    np.save(folder / "a.npy", np.eye(3))
    content = (folder / "a.npy").read_bytes()
    (folder / "a.npy").write_bytes(content[:cut])
    with pytest.raises(IllegalValueError, match="damaged"):
        source("a.npy")


def test_npy_that_claims_to_be_enormous(folder: Path) -> None:
    np.save(folder / "a.npy", np.eye(3))
    content = (folder / "a.npy").read_bytes()
    claim = content.replace(b"(3, 3), }    ", b"(999999999,)}")
    assert claim != content
    (folder / "a.npy").write_bytes(claim)
    with pytest.raises(IllegalValueError, match="damaged"):
        source("a.npy")


@pytest.mark.parametrize("content", [b"\xff\xfe\x00", b"\x89PNG\r\n\x1a\n\x00", b"\x00" * 100, b""])
def test_files_that_are_no_text(folder: Path, content: bytes) -> None:
    (folder / "a.txt").write_bytes(content)
    with pytest.raises(IllegalValueError, match=r"\A[^\n]+\Z"):
        source("a.txt")


@pytest.mark.parametrize(
    "text", ["none.json", "", "x" * 10_000, "a/b/c", "1", "#", "a#b", "\ud800"]
)
def test_what_is_neither_a_file_nor_a_literal(text: str) -> None:
    with pytest.raises(IllegalValueError, match="no such file"):
        source(text)


def test_a_folder_is_called_a_folder() -> None:
    with pytest.raises(IllegalValueError, match="folder"):
        source(".")


def test_an_endless_file_is_cut_off() -> None:
    if not Path("/dev/zero").exists():
        pytest.skip("this system has no /dev/zero")
    with pytest.raises(IllegalValueError, match="larger than"):
        source("/dev/zero")


def test_reading_text_loads_no_numpy() -> None:
    program = (
        "import sys\n"
        "from nmatrix.reading.source import matrix_source\n"
        "from nmatrix.reading.literal import as_affine\n"
        "as_affine(matrix_source('mat3(2.0)', str))\n"
        "sys.exit('numpy' in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0
