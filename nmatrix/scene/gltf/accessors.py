"""The numbers of a glTF file: accessors, checked before memory is taken, read where someone asks.

An accessor is a view of the file's own bytes. Only the elements that are asked for are copied, so
a file whose parts share one buffer takes no more memory than what is drawn of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, counted, quoted
from nmatrix.scene.gltf.extensions import MESHOPT, PACKING
from nmatrix.scene.gltf.file import GltfFile, in_digits
from nmatrix.scene.gltf.records import Accessor, BufferView, SparsePlace

Array = NDArray[Any]
Rows = slice | Array
Layout = tuple[np.dtype[Any], int, tuple[int, ...]]

COMPONENTS: dict[int, np.dtype[Any]] = {
    5120: np.dtype("i1"),
    5121: np.dtype("u1"),
    5122: np.dtype("<i2"),
    5123: np.dtype("<u2"),
    5125: np.dtype("<u4"),
    5126: np.dtype("<f4"),
}
SHAPES: dict[str, tuple[int, ...]] = {
    "SCALAR": (1,),
    "VEC2": (2,),
    "VEC3": (3,),
    "VEC4": (4,),
    "MAT2": (2, 2),
    "MAT3": (3, 3),
    "MAT4": (4, 4),
}
COLUMN = 4  # bytes: a column of a matrix begins at a multiple of them
MOST_ZEROS = 1 << 22  # elements that no bytes stand for
ALL = slice(None)


class PackedError(IllegalValueError):
    """Numbers that are packed in a way that is not read here."""

    def __init__(self, path: Path, packing: str) -> None:
        super().__init__(f"{path}", f"it is packed by {packing}, which is not read", "unpack it")
        self.packing = packing


@dataclass(frozen=True, eq=False)
class Values:
    """The elements of an accessor.

    Parameters
    ----------
    path, name
        The file and the words for errors, such as `accessor 3`.
    stored
        (N, components) or, of matrices, (N, rows, columns): a view of the file's bytes.
    divisor
        What normalised integers are divided by; 1 for all others.
    changed, changes
        The elements that a sparse accessor changes, in growing order, and what they become.
    """

    path: Path
    name: str
    stored: Array
    divisor: int = 1
    changed: Array | None = None
    changes: Array | None = None

    def __len__(self) -> int:
        return len(self.stored)

    @property
    def is_integer(self) -> bool:
        """True for whole numbers that count for themselves."""
        return self.divisor == 1 and self.stored.dtype.kind in "iu"

    def raw(self, rows: Rows = ALL) -> Array:
        """Copy elements as the file has them."""
        found = self.stored[rows].copy()
        if self.changed is not None and self.changes is not None:
            wanted = np.arange(len(self))[rows]
            place = np.searchsorted(self.changed, wanted).clip(max=len(self.changed) - 1)
            hit = self.changed[place] == wanted
            found[hit] = self.changes[place[hit]]
        return found

    def floats(self, rows: Rows = ALL) -> Array:
        """Read elements as float64, whatever they are: they may be infinite or no numbers."""
        found = self.raw(rows).astype(np.float64)
        return found if self.divisor == 1 else np.maximum(found / self.divisor, -1.0)

    def finite(self, rows: Rows = ALL) -> Array:
        """Read elements as float64.

        Raises
        ------
        IllegalValueError
            For the first that is not finite, with its index.
        """
        found = self.floats(rows)
        good = np.isfinite(found)
        if not good.all():
            first = int(np.argwhere(~good)[0][0])
            shown = " ".join(f"{one:g}" for one in found[first].ravel())
            index = int(np.arange(len(self))[rows][first])
            why = f"element {index} of {self.name} ({shown}) is not finite"
            raise IllegalValueError(f"{self.path}", why, "export it again")
        return found

    def exact(self, rows: Rows = ALL) -> list[tuple[Fraction, ...]]:
        """Read the components of elements, matrices row by row, as exact fractions.

        Raises
        ------
        IllegalValueError
            For one that is not finite.
        """
        self.finite(rows)
        least = -self.divisor
        return [
            tuple(
                Fraction(one) if self.divisor == 1 else Fraction(max(one, least), self.divisor)
                for one in element
            )
            for element in self.raw(rows).reshape(-1, self.stored[0:1].size or 1).tolist()
        ]


def values(file: GltfFile, index: int, what: str, types: Sequence[str]) -> Values:
    """Look an accessor up, decoded once however many parts of the file use it.

    `what` are the words for what it holds, and `types` those of the format that it may be of.

    Raises
    ------
    PackedError
        If its bytes are packed.
    IllegalValueError
        If it does not exist, is of another type, or reaches beyond its bytes; the error names the
        accessor, what was found and what was expected.
    """
    record = file.entry("accessor", file.document.accessors, index)
    if record.type not in types:
        why = f"{what} (accessor {index}) is of type {quoted(record.type)[1:-1]}"
        raise file.fault(f"{why} and has to be {' or '.join(types)}")
    if index not in file.kept.accessors:
        file.kept.accessors[index] = _values(file, index, record)
    return file.kept.accessors[index]


def _values(file: GltfFile, index: int, record: Accessor) -> Values:
    name = f"accessor {index}"
    kind = _component(file, name, record.component_type, COMPONENTS)
    if record.count < 0:
        raise file.fault(f"{name} has the count {record.count}")
    shape = SHAPES[record.type]
    if record.buffer_view is None:
        if record.count > MOST_ZEROS:
            why = f"{name} claims {in_digits(record.count)} elements without bytes"
            raise file.fault(f"{why}, and of zeros {MOST_ZEROS} at most are taken")
        stored = np.broadcast_to(np.zeros((1, *shape), kind), (record.count, *shape))
    else:
        place = SparsePlace(record.buffer_view, record.byte_offset)
        stored = _stored(file, name, place, (kind, record.count, shape))
    divisor = int(np.iinfo(kind).max) if record.normalized and kind.kind in "iu" else 1
    if record.sparse is None or record.sparse.count == 0:
        return Values(file.path, name, stored, divisor)
    return Values(file.path, name, stored, divisor, *_sparse(file, name, record))


def _component(
    file: GltfFile, name: str, component: int | None, known: Iterable[int]
) -> np.dtype[Any]:
    if component is None or component not in known:
        listed = ", ".join(map(str, known))
        raise file.fault(f"{name} has the component type {component}, and it has to be of {listed}")
    return COMPONENTS[component]


def _sparse(file: GltfFile, name: str, record: Accessor) -> tuple[Array, Array]:
    """Find the elements that a sparse accessor changes, and what they become."""
    sparse = record.sparse
    if sparse is None or not 0 <= sparse.count <= record.count:
        raise file.fault(
            f"{name} is sparse and changes more than its {counted(record.count, 'element')}"
        )
    of_indices = f"{name}, in its sparse indices,"
    kind = _component(file, of_indices, sparse.indices.component_type, (5121, 5123, 5125))
    indices = _stored(file, of_indices, sparse.indices, (kind, sparse.count, (1,)))[:, 0]
    indices = indices.astype(np.int64)
    if indices.max() >= record.count:
        raise file.fault(f"{name} changes its element {indices.max()} and has {record.count}")
    layout = COMPONENTS[record.component_type], sparse.count, SHAPES[record.type]
    found = _stored(file, f"{name}, in its sparse values,", sparse.values, layout)
    if (np.diff(indices) > 0).all():
        return indices, found
    grown, last = np.unique(indices[::-1], return_index=True)  # of two for one, the later counts
    return grown, found[::-1][last]


def _stored(file: GltfFile, name: str, place: SparsePlace, layout: Layout) -> Array:
    """Look at elements in a buffer view: their component, how many, and the shape of each."""
    kind, count, shape = layout
    view = file.entry("buffer view", file.document.buffer_views, place.buffer_view, name)
    content = _bytes_behind(file, view, f"bufferViews[{place.buffer_view}].buffer")
    view_name = f"buffer view {place.buffer_view}"
    if view.byte_offset < 0 or view.byte_length < 0:
        raise file.fault(f"{view_name} has a negative offset or length")
    end = view.byte_offset + view.byte_length
    if end > len(content):
        ends = f"{view_name} ends at byte {in_digits(end)}"
        raise file.fault(f"{ends}, and buffer {view.buffer} has {len(content)}")
    column = shape[-1] * kind.itemsize
    if len(shape) > 1:
        column = -(-column // COLUMN) * COLUMN
    columns = shape[0] if len(shape) > 1 else 1
    size = column * (columns - 1) + shape[-1] * kind.itemsize
    stride = view.byte_stride or column * columns
    if stride < size:
        strides = f"{view_name} has the stride {in_digits(stride)}"
        raise file.fault(f"{strides}, and an element of {name} has {counted(size, 'byte')}")
    if place.byte_offset < 0:
        raise file.fault(f"{name} begins at byte {place.byte_offset} of {view_name}")
    start = view.byte_offset + place.byte_offset
    if count == 0:
        return np.zeros((0, *shape), kind)
    end = place.byte_offset + stride * (count - 1) + size
    if end > view.byte_length:
        ends = f"{name} ends at byte {in_digits(end)}"
        raise file.fault(f"{ends} of {view_name}, which has {view.byte_length}")
    if len(shape) == 1:
        return np.ndarray((count, *shape), kind, content, start, (stride, kind.itemsize))
    by_columns = (stride, column, kind.itemsize)
    return np.ndarray((count, *shape), kind, content, start, by_columns).swapaxes(1, 2)


def _bytes_behind(file: GltfFile, view: BufferView, place: str) -> bytes:
    """Take the bytes of a view; of a packed one those of its fallback, if there are any."""
    behind = file.entry("buffer", file.document.buffers, view.buffer, place)
    packing = next((PACKING[one] for one in view.extensions if one in MESHOPT), None)
    if packing is None:
        return file.buffer(view.buffer)
    if behind.uri is None and (view.buffer > 0 or not file.binary or behind.extensions):
        raise PackedError(file.path, packing)
    try:
        return file.buffer(view.buffer)
    except IllegalValueError:
        raise PackedError(file.path, packing) from None
