"""PLY files: what their elements mean for a mesh; vertices, faces, triangle strips."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError
from nmatrix.scene.meshes.elements import Columns, Header, Lists, read_elements, read_header
from nmatrix.scene.meshes.parts import NONE, Attribute, MeshFile, Polygons, without_triangles
from nmatrix.scene.words import counted

Array = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]

VERTEX, FACE, STRIPS = "vertex", "face", "tristrips"
AXES, NORMALS = ("x", "y", "z"), ("nx", "ny", "nz")
COLOURS = (
    ("red", "green", "blue"),
    ("diffuse_red", "diffuse_green", "diffuse_blue"),
    ("r", "g", "b"),
)
COORDINATES = (("u", "v"), ("s", "t"), ("texture_u", "texture_v"), ("texture_s", "texture_t"))
LISTS = ("vertex_indices", "vertex_index")
FACE_COORDINATES = "texcoord"
ALPHA = ("alpha", "diffuse_alpha", "a")
_FULL = {"u1": 255.0, "i1": 255.0, "u2": 65535.0, "f4": 1.0, "f8": 1.0}  # of a colour


def read_ply(path: Path, content: bytes) -> MeshFile:
    """Read the faces and triangle strips of a PLY file.

    Raises
    ------
    IllegalValueError
        For a header that is none, a body that breaks off, an index of nothing, or no faces.
    """
    header = read_header(path, content)
    found = read_elements(path, header, content)
    vertices = found.get(VERTEX, {})
    if not vertices:
        raise IllegalValueError(f"{path}", "it holds no vertices", "export it again")
    if not all(isinstance(vertices.get(axis), np.ndarray) for axis in AXES):
        raise IllegalValueError(f"{path}", "its vertices have no x, y and z", "export it again")
    positions = _together(vertices, AXES)
    _check_finite(path, positions)
    corners, sizes = _corners(path, header, found, len(positions))
    remarks = [*header.remarks, *_left_out(path, header)]
    long = sizes > 2
    if not long.all():
        short = int(np.count_nonzero(~long))
        remarks.append(
            f"Not drawn of {path.name}: {counted(short, 'face')} with fewer than three corners."
        )
    if not long.any():
        raise IllegalValueError(f"{path}", *without_triangles(len(positions), len(sizes)))
    kept = slice(None) if long.all() else np.repeat(long, sizes)
    normals, uv, colours = (
        None if one is None else Attribute(one.values, one.at[kept])
        for one in (
            _of_vertices(vertices, (NORMALS,), corners),
            _uv(found, corners, sizes),
            _colours(header, found, corners, sizes),
        )
    )
    polygons = Polygons(path.name, positions, corners[kept], sizes[long], normals, uv, colours)
    parts, told, origin = polygons.parts()
    return MeshFile(parts, (*remarks, *told), origin, header.textures)


def _together(columns: Columns, names: Sequence[str]) -> Array:
    return np.stack([np.asarray(columns[name], np.float64) for name in names], axis=1)


def _check_finite(path: Path, positions: Array) -> None:
    bad = ~np.isfinite(positions).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        shown = " ".join(f"{one:g}" for one in positions[row].tolist())
        raise IllegalValueError(
            f"{path}, vertex {row} ({shown})",
            "a coordinate is a finite number; vertices count from 0",
            "export it again",
        )


def _corners(
    path: Path, header: Header, found: Mapping[str, Columns], count: int
) -> tuple[Indices, Indices]:
    """Read the vertex of each corner, and the number of corners of each face."""
    faces = next((one for name in LISTS if (one := found.get(FACE, {}).get(name))), None)
    strips = next((one for name in LISTS if (one := found.get(STRIPS, {}).get(name))), None)
    corners: Indices = np.empty(0, np.intp)
    sizes: Indices = np.empty(0, np.intp)
    if isinstance(faces, Lists):
        corners, sizes = _indices(path, FACE, faces, range(count)), faces.lengths
    if isinstance(strips, Lists):
        triangles = _of_strips(_indices(path, STRIPS, strips, range(NONE, count)), strips.lengths)
        corners = np.concatenate([corners, triangles.ravel()])
        sizes = np.concatenate([sizes, np.full(len(triangles), 3)])
    return corners, sizes


def _indices(path: Path, name: str, lists: Lists, allowed: range) -> Indices:
    """Read indices, each of which is one of a vertex."""
    values = lists.values
    with np.errstate(invalid="ignore"):
        found = values.astype(np.intp)
        bad = (found != values) | (found < allowed.start) | (found >= allowed.stop)
    if bad.any():
        place = int(np.argmax(bad))
        row = int(np.searchsorted(np.cumsum(lists.lengths), place, side="right"))
        raise IllegalValueError(
            f"{path}, row {row + 1:,} of the element {name} (index {values[place]:g})",
            f"vertices count from 0, and the file has {allowed.stop:,}",
            "export it again",
        )
    return found


def _of_strips(strips: Indices, lengths: Indices) -> Indices:
    """Cut strips into triangles (T, 3): each corner makes one with the two before it.

    −1 ends a strip. Every second triangle is turned; one with a corner twice only leads on.

    Examples
    --------
    >>> _of_strips(np.array([0, 1, 2, 3, -1, 4, 5, 6]), np.array([8])).tolist()
    [[0, 1, 2], [2, 1, 3], [4, 5, 6]]
    """
    if len(strips) < 3:
        return np.empty((0, 3), np.intp)
    begins = np.zeros(len(strips), bool)
    begins[np.concatenate([[0], np.cumsum(lengths)[:-1]])[lengths > 0]] = True
    begins[1:] |= strips[:-1] == NONE
    place = np.arange(len(strips))
    since = place - np.maximum.accumulate(np.where(begins, place, 0))
    a, b, c = strips[:-2], strips[1:-1], strips[2:]
    kept = (since[2:] >= 2) & (c != NONE) & (a != b) & (b != c) & (c != a)
    odd = since[2:] % 2 == 1
    return np.asarray(np.stack([np.where(odd, b, a), np.where(odd, a, b), c], axis=1)[kept])


def _named(columns: Columns, choices: Sequence[Sequence[str]]) -> Sequence[str] | None:
    """Find the first choice of names of which every one is a column of single values."""
    for names in choices:
        if all(isinstance(columns.get(name), np.ndarray) for name in names):
            return names
    return None


def _of_vertices(
    vertices: Columns, choices: Sequence[Sequence[str]], corners: Indices
) -> Attribute | None:
    """Take what each vertex has for its corners; what is not finite is missing."""
    names = _named(vertices, choices)
    if names is None:
        return None
    values = _together(vertices, names)
    bad = np.logical_not(np.isfinite(values).all(axis=-1))
    at = np.where(bad[corners], NONE, corners) if bad.any() else corners
    return Attribute(values, at)


def _uv(found: Mapping[str, Columns], corners: Indices, sizes: Indices) -> Attribute | None:
    """Take texture coordinates of vertices, or else those of the corners of faces."""
    own = found.get(FACE, {}).get(FACE_COORDINATES)
    if not isinstance(own, Lists) or not len(own.values):
        return _of_vertices(found[VERTEX], COORDINATES, corners)
    fits = np.zeros(len(sizes), bool)
    fits[: len(own.lengths)] = own.lengths == 2 * sizes[: len(own.lengths)]
    at = np.full(len(corners), NONE)
    at[np.repeat(fits, sizes)] = np.arange(int(sizes[fits].sum()))
    whole = np.repeat(fits[: len(own.lengths)], own.lengths)
    values = np.asarray(own.values[whole], np.float64).reshape(-1, 2)
    if not len(values):
        return None
    finite = np.asarray(np.isfinite(values).all(axis=1))
    return Attribute(values, np.where((at != NONE) & finite[at], at, NONE))


def _colours(
    header: Header, found: Mapping[str, Columns], corners: Indices, sizes: Indices
) -> Attribute | None:
    """Take the colours of vertices, or else those of faces, in [0, 1]."""
    elements = {element.name: element for element in header.elements}
    for name in (VERTEX, FACE):
        columns = found.get(name, {})
        names = _named(columns, COLOURS)
        if names is None:
            continue
        values = _together(columns, names)
        full = _FULL.get(elements[name].kind(names[0]), 255.0)
        if full == 1.0 and np.nan_to_num(values).max(initial=0.0) > 1.0:
            full = 255.0
        values = np.clip(np.nan_to_num(values / full, nan=1.0), 0.0, 1.0)
        if name == VERTEX:
            return Attribute(values, corners)
        at = np.repeat(np.arange(len(sizes)), sizes)
        white = len(values)  # triangles of strips have no colour of a face
        return Attribute(np.vstack([values, np.ones(3)]), np.minimum(at, white))
    return None


def _left_out(path: Path, header: Header) -> list[str]:
    """Name what is not drawn."""
    listed = []
    for element in header.elements:
        if element.name not in (VERTEX, FACE, STRIPS) and element.count:
            listed.append(f"{counted(element.count, 'row')} of the element {element.shown}")
        elif any(one.name in ALPHA for one in element.properties):
            listed.append(f"alpha of the element {element.shown}")
    return [f"Not drawn of {path.name}: {', '.join(listed)}."] if listed else []
