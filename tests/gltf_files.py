"""Small glTF files made byte by byte, for the tests of their readers."""

from __future__ import annotations

import json
from base64 import b64encode
from pathlib import Path

import numpy as np

from nmatrix.scene.gltf.file import GltfFile, read_gltf

COMPONENTS = {"i1": 5120, "u1": 5121, "i2": 5122, "u2": 5123, "u4": 5125, "f4": 5126}
TYPES = {(): "SCALAR", (2,): "VEC2", (3,): "VEC3", (4,): "VEC4", (4, 4): "MAT4"}


class Made:
    """A glTF document that grows by arrays; matrices are given row by row."""

    def __init__(self) -> None:
        self.content = b""
        self.accessors: list[dict[str, object]] = []
        self.views: list[dict[str, object]] = []

    def view(self, data: bytes, **record: object) -> int:
        self.content += b"\0" * (-len(self.content) % 4)
        record = {"buffer": 0, "byteOffset": len(self.content), "byteLength": len(data)} | record
        self.views.append(record)
        self.content += data
        return len(self.views) - 1

    def add(self, rows: object, kind: str = "f4", **record: object) -> int:
        array = np.asarray(rows)
        shape = array.shape[1:]
        stored = array.swapaxes(1, 2) if len(shape) == 2 else array
        accessor = {
            "bufferView": self.view(stored.astype(f"<{kind}").tobytes()),
            "componentType": COMPONENTS[kind],
            "count": len(array),
            "type": TYPES[shape],
        }
        self.accessors.append(accessor | record)
        return len(self.accessors) - 1

    def document(self, **parts: object) -> dict[str, object]:
        uri = f"data:application/octet-stream;base64,{b64encode(self.content).decode()}"
        return {
            "asset": {"version": "2.0"},
            "accessors": self.accessors,
            "bufferViews": self.views,
            "buffers": [{"byteLength": len(self.content), "uri": uri}],
        } | parts

    def file(self, folder: Path, **parts: object) -> GltfFile:
        path = folder / "made.gltf"
        path.write_text(json.dumps(self.document(**parts)))
        return read_gltf(path)
