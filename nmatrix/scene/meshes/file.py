"""OBJ, PLY and STL files as meshes; trimesh reads them, and every array is checked after it."""

from __future__ import annotations

import io
import warnings
from pathlib import Path
from typing import Any

import numpy as np

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.mesh import Mesh, area_weighted_normals
from nmatrix.scene.words import MESH_SUFFIXES


def read_mesh(path: Path) -> Mesh:
    """Read the triangles of a mesh file, with its own normals or area-weighted ones.

    Texture coordinates and colours of vertices come along where the file has them.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read, holds no triangles, or has numbers that are not finite.
    """
    found = _loaded(path)
    positions = np.asarray(getattr(found, "vertices", np.zeros((0, 3))), np.float64)
    triangles = np.asarray(getattr(found, "faces", np.zeros((0, 3))), np.intp)
    if positions.ndim != 2 or len(triangles) == 0:
        raise _unreadable(path, "it holds no triangles")
    normals = _normals(found, positions, triangles)
    visual = getattr(found, "visual", None)
    try:
        return Mesh(
            positions,
            normals,
            triangles,
            uv=_finite(getattr(visual, "uv", None), (len(positions), 2)),
            colours=_colours(visual, len(positions)),
        )
    except IllegalValueError as error:
        raise _unreadable(path, str(error)) from None


def _loaded(path: Path) -> object:
    """Return what trimesh makes of a file."""
    content = _content(path)
    import trimesh

    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            return trimesh.load(
                io.BytesIO(content),
                file_type=path.suffix[1:].lower(),
                process=False,
                force="mesh",
                skip_materials=True,
            )
        except Exception as error:  # trimesh's readers raise whatever they meet
            raise _unreadable(path, f"it cannot be read ({type(error).__name__})") from None


def _normals(found: object, positions: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """Return the file's normals where it has them for every vertex, at length one."""
    cache = getattr(found, "_cache", None)
    given = None if cache is None else cache.cache.get("vertex_normals")
    if given is None or np.shape(given) != positions.shape or not np.isfinite(given).all():
        return area_weighted_normals(positions, triangles)
    length = np.sqrt((np.asarray(given, np.float64) ** 2).sum(axis=1, keepdims=True))
    unit: np.ndarray = np.divide(given, length, out=np.zeros_like(positions), where=length > 0)
    return unit


def _colours(visual: Any, count: int) -> np.ndarray | None:  # noqa: ANN401  # of a library without types
    """Return the colours of the vertices in [0, 1], if the file has any."""
    if getattr(visual, "kind", None) != "vertex":
        return None
    found = _finite(visual.vertex_colors, (count, 4))
    return None if found is None else found[:, :3] / 255.0


def _finite(values: Any, shape: tuple[int, int]) -> np.ndarray | None:  # noqa: ANN401  # as above
    """Return what a file has for each vertex, or None if it is not all there."""
    if values is None or np.shape(values) != shape:
        return None
    found = np.asarray(values, np.float64)
    return found if np.isfinite(found).all() else None


def _content(path: Path) -> bytes:
    if path.suffix.lower() not in MESH_SUFFIXES:
        raise _unreadable(path, "meshes are .obj, .ply or .stl, scenes .gltf or .glb")
    try:
        content = path.read_bytes()
    except OSError as error:
        raise _unreadable(path, f"{error.strerror}") from None
    if not content.strip():
        raise _unreadable(path, "it is empty")
    return _as_utf8(content) if path.suffix.lower() == ".obj" else content


def _as_utf8(content: bytes) -> bytes:
    """Return text as UTF-8; other encodings are recognised."""
    try:
        content.decode("utf-8")
    except UnicodeDecodeError:
        from charset_normalizer import from_bytes

        best = from_bytes(content).best()
        return content if best is None else str(best).encode()
    return content.replace(b"\x00", b"")


def _unreadable(path: Path, why: str) -> IllegalValueError:
    return IllegalValueError(f"{path}", why, "check the file")
