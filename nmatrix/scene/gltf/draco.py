"""Primitives that Draco packed, by the optional package DracoPy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import counted
from nmatrix.requirements import missing
from nmatrix.scene.gltf.accessors import SHAPES, Values
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.records import DracoRecord, Primitive


def unpacked(
    file: GltfFile, primitive: Primitive, packed: DracoRecord
) -> tuple[Mapping[str, Values], NDArray[Any]]:
    """Unpack the attributes of a primitive and its corners, three for each triangle.

    The accessors tell what integers mean; all else comes from Draco's own bytes.

    Raises
    ------
    MissingPackageError
        Without DracoPy.
    IllegalValueError
        For bytes that are no Draco mesh, or lack an attribute that the primitive names.
    """
    try:
        import DracoPy
    except ImportError:
        raise missing(f"{file.path} (packed by Draco)", "DracoPy") from None
    view = file.entry("buffer view", file.document.buffer_views, packed.buffer_view)
    content = file.buffer(view.buffer)
    if not 0 <= view.byte_offset <= view.byte_offset + view.byte_length <= len(content):
        raise file.fault(f"buffer view {packed.buffer_view} reaches beyond buffer {view.buffer}")
    try:
        mesh = DracoPy.decode(content[view.byte_offset :][: view.byte_length])
        by_number = {one["unique_id"]: one["data"] for one in mesh.attributes}
        corners = np.asarray(mesh.faces, np.intp).ravel()
    except Exception:  # the package raises whatever it meets
        raise file.fault(f"buffer view {packed.buffer_view} is no mesh of Draco's") from None
    found = {}
    for name, number in packed.attributes.items():
        if name in primitive.attributes:
            if number not in by_number:
                raise file.fault(f"its Draco bytes have no attribute {number}, meant for {name}")
            found[name] = _values(file, primitive.attributes[name], name, by_number[number])
    return found, corners


def _values(file: GltfFile, index: int, name: str, data: NDArray[Any]) -> Values:
    record = file.entry("accessor", file.document.accessors, index)
    stored = np.asarray(data).reshape(len(data), -1)
    if stored.shape[1:] != SHAPES.get(record.type):
        raise file.fault(f"{name} has {counted(stored.shape[1], 'component')} in Draco's bytes")
    is_whole = record.normalized and stored.dtype.kind in "iu"
    divisor = int(np.iinfo(stored.dtype).max) if is_whole else 1
    return Values(file.path, f"{name}, unpacked", stored, divisor)
