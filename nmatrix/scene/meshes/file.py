"""OBJ, PLY and STL files as meshes; trimesh reads them, and every array is checked after it."""

from __future__ import annotations

import io
import warnings
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.mesh import Mesh, area_weighted_normals, joined, normals_made, unit
from nmatrix.scene.words import MESH_SUFFIXES


def read_mesh(path: Path) -> Mesh:
    """Read the triangles of a mesh file, with its own normals of vertices or area-weighted ones.

    A part of the file (an OBJ has one for each material) that lacks a normal for some vertex gets
    area-weighted ones, and a remark says so. Texture coordinates and colours of vertices come along
    where the file has them.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read, holds no triangles, or has numbers that are not finite.
    """
    parts = _parts(path, _content(path))
    if not parts:
        raise _unreadable(path, "it holds no triangles")
    try:
        return joined([_mesh(part, path.name) for part in parts])
    except IllegalValueError as error:
        raise _unreadable(path, str(error)) from None


@dataclass(frozen=True)
class _Part:
    """A part of a file as trimesh holds it, and the normals that the file has, if any.

    A trimesh makes normals where it has none and does not tell; the arguments of its constructor,
    which a reader returns, do.
    """

    trimesh: Any
    file_normals: np.ndarray | None


def _parts(path: Path, content: bytes) -> list[_Part]:
    """Return the parts of a file that have triangles."""
    import trimesh
    from trimesh.exchange.load import mesh_loaders

    read: Callable[..., dict[str, Any]] = mesh_loaders[path.suffix[1:].lower()]
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = read(file_obj=io.BytesIO(content), skip_materials=True)
            if "vertex_normals" in found and "visual" in found:  # a PLY with texture coordinates
                merged = read(file_obj=io.BytesIO(content), skip_materials=True, fix_texture=False)
                found["vertex_normals"] = _split_alike(found, merged["faces"])
            parts = found["geometry"].values() if "geometry" in found else (found,)
            for part in parts:
                part.pop("face_colors", None)  # vertices have the colours that are drawn
            return [
                _Part(trimesh.Trimesh(**part, process=False), part.get("vertex_normals"))
                for part in parts
                if np.size(part.get("faces", ()))
            ]
        except Exception as error:  # trimesh's readers raise whatever they meet
            raise _unreadable(path, f"it cannot be read ({type(error).__name__})") from None


def _split_alike(found: Mapping[str, Any], merged_faces: np.ndarray) -> np.ndarray:
    """Return the normals of vertices that were split where texture coordinates differ."""
    origin = np.arange(len(found["vertices"]))
    origin[np.ravel(found["faces"])] = np.ravel(merged_faces)
    return np.asarray(found["vertex_normals"])[origin]


def _mesh(part: _Part, source: str) -> Mesh:
    positions = np.asarray(part.trimesh.vertices, np.float64)
    triangles = np.asarray(part.trimesh.faces, np.intp)
    normals = _of_vertices(part.file_normals, positions.shape)
    return Mesh(
        positions,
        area_weighted_normals(positions, triangles) if normals is None else unit(normals),
        triangles,
        uv=_of_vertices(getattr(part.trimesh.visual, "uv", None), (len(positions), 2)),
        colours=_colours(part.trimesh.visual, len(positions)),
        remarks=(normals_made(source),) if normals is None else (),
    )


def _colours(visual: Any, count: int) -> np.ndarray | None:  # noqa: ANN401  # of a library without types
    """Return the colours of the vertices in [0, 1], if the file has any."""
    if getattr(visual, "kind", None) != "vertex":
        return None
    found = _of_vertices(visual.vertex_colors, (count, 4))
    return None if found is None else found[:, :3] / 255.0


def _of_vertices(values: Any, shape: tuple[int, ...]) -> np.ndarray | None:  # noqa: ANN401  # as above
    """Return the values of the vertices, or None where one is missing or not finite."""
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
