"""Accessors of glTF: every type and layout, against Fractions and plain loops."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path
from struct import calcsize, pack

import numpy as np
import pytest
from gltf_files import COMPONENTS, Made

from nmatrix.errors import IllegalValueError
from nmatrix.scene.gltf.accessors import COMPONENTS as KNOWN
from nmatrix.scene.gltf.accessors import SHAPES, values

CODES = {"i1": "b", "u1": "B", "i2": "h", "u2": "H", "u4": "I", "f4": "f"}


@pytest.mark.parametrize("kind", CODES)
@pytest.mark.parametrize("kind_of_element", SHAPES)
def test_elements_of_every_type_and_component_are_read_where_the_format_puts_them(
    tmp_path: Path, kind: str, kind_of_element: str
) -> None:
    """Columns of matrices begin at multiples of four bytes; everything else lies close."""
    shape, count = SHAPES[kind_of_element], 3
    rows = shape[0]
    columns = shape[1] if len(shape) == 2 else 1
    size = calcsize(CODES[kind])
    exact, data = [], b""
    for element in range(count):
        rowwise = [[10 * element + 3 * i + j for j in range(columns)] for i in range(rows)]
        exact.append(tuple(Fraction(one) for row in rowwise for one in row))
        for column in zip(*rowwise, strict=True):
            data += pack(f"<{rows}{CODES[kind]}", *column)
            if len(shape) == 2:
                data += b"\7" * (-rows * size % 4)
    made = Made()
    record = {"componentType": COMPONENTS[kind], "count": count, "type": kind_of_element}
    made.accessors.append({"bufferView": made.view(data), **record})
    found = values(made.file(tmp_path), 0, "it", (kind_of_element,))
    assert found.finite().shape == (count, *shape)
    assert found.finite().reshape(count, -1).tolist() == [list(map(float, one)) for one in exact]
    assert found.exact() == exact


def test_every_component_type_of_the_format_is_known() -> None:
    assert sorted(KNOWN) == sorted(COMPONENTS.values())


@pytest.mark.parametrize("kind", ["i1", "u1", "i2", "u2"])
def test_normalised_integers_are_fractions_of_the_largest(tmp_path: Path, kind: str) -> None:
    limits = np.iinfo(kind)
    stored = [limits.min, limits.min + 1, 0, 1, limits.max]
    made = Made()
    made.add(stored, kind, normalized=True)
    found = values(made.file(tmp_path), 0, "it", ("SCALAR",))
    expected = [max(Fraction(one, int(limits.max)), Fraction(-1)) for one in map(int, stored)]
    assert found.exact() == [(one,) for one in expected]
    assert found.floats()[:, 0].tolist() == [float(one) for one in expected]


@pytest.mark.parametrize("based", [True, False])
@pytest.mark.parametrize("kind", ["u1", "u2", "u4"])
@pytest.mark.parametrize("order", [[1, 4, 6], [6, 1, 4]])
def test_a_sparse_accessor_changes_some_elements_of_its_base_or_of_zeros(
    tmp_path: Path, based: bool, kind: str, order: list[int]
) -> None:
    base = np.arange(21.0).reshape(7, 3)
    changes = 100 + np.arange(9.0).reshape(3, 3)
    made = Made()
    made.add(base)
    indices = made.view(np.array(order).astype(f"<{kind}").tobytes())
    sparse = {
        "count": 3,
        "indices": {"bufferView": indices, "componentType": COMPONENTS[kind]},
        "values": {"bufferView": made.view(changes.astype("<f4").tobytes())},
    }
    made.accessors[0]["sparse"] = sparse
    if not based:
        del made.accessors[0]["bufferView"]
        base = np.zeros_like(base)
    found = values(made.file(tmp_path), 0, "it", ("VEC3",))
    expected = base.copy()
    expected[order] = changes
    assert found.finite().tolist() == expected.tolist()
    some = np.array([6, 0, 1])
    assert found.finite(some).tolist() == expected[some].tolist()
    assert found.finite(slice(4, 5)).tolist() == expected[4:5].tolist()


def test_of_two_values_for_one_element_the_later_counts(tmp_path: Path) -> None:
    made = Made()
    made.add([0.0, 0.0, 0.0])
    made.accessors[0]["sparse"] = {
        "count": 3,
        "indices": {"bufferView": made.view(bytes([2, 0, 2])), "componentType": 5121},
        "values": {"bufferView": made.view(pack("<3f", 5, 6, 7))},
    }
    found = values(made.file(tmp_path), 0, "it", ("SCALAR",))
    assert found.finite()[:, 0].tolist() == [6, 0, 7]


def test_a_number_that_is_not_finite_is_named_by_its_own_index(tmp_path: Path) -> None:
    made = Made()
    made.add([[0.0, 0], [1, 1], [2, float("inf")]])
    found = values(made.file(tmp_path), 0, "it", ("VEC2",))
    assert found.finite(slice(0, 2)).tolist() == [[0, 0], [1, 1]]
    with pytest.raises(IllegalValueError, match=r"element 2 of accessor 0 \(2 inf\) is not finite"):
        found.finite(np.array([0, 2]))


def test_an_accessor_is_decoded_once_and_is_a_view_of_the_files_bytes(tmp_path: Path) -> None:
    made = Made()
    made.add(np.zeros((1000, 3)))
    file = made.file(tmp_path)
    found = values(file, 0, "it", ("VEC3",))
    assert values(file, 0, "it again", ("VEC3",)) is found
    assert found.stored.base is not None
    assert not found.stored.flags.owndata
    assert not found.stored.flags.writeable


def test_zeros_without_bytes_take_no_memory(tmp_path: Path) -> None:
    made = Made()
    made.accessors.append({"componentType": 5126, "count": 1 << 22, "type": "MAT4"})
    found = values(made.file(tmp_path), 0, "it", ("MAT4",))
    assert len(found) == 1 << 22
    assert found.stored.strides[0] == 0
    assert found.finite(slice(7, 8)).tolist() == np.zeros((1, 4, 4)).tolist()


@pytest.mark.parametrize("name", ["EXT_meshopt_compression", "KHR_meshopt_compression"])
@pytest.mark.parametrize("has_fallback", [True, False])
def test_a_view_that_meshopt_packed_is_read_from_its_fallback(
    tmp_path: Path, name: str, has_fallback: bool
) -> None:
    made = Made()
    made.add([1.0, 2.0])
    made.views[0]["buffer"] = 1
    made.views[0]["extensions"] = {name: {"buffer": 0, "byteLength": 8, "count": 2}}
    (tmp_path / "fallback.bin").write_bytes(made.content)
    buffers = made.document()["buffers"]
    fallback = {"byteLength": 8, "extensions": {name: {"fallback": True}}}
    if has_fallback:
        fallback["uri"] = "fallback.bin"
    file = made.file(tmp_path, buffers=[*buffers, fallback])
    if has_fallback:
        assert values(file, 0, "it", ("SCALAR",)).finite()[:, 0].tolist() == [1, 2]
        return
    with pytest.raises(IllegalValueError, match="it is packed by meshopt, which is not read"):
        values(file, 0, "it", ("SCALAR",))
