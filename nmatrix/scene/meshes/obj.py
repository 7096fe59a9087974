"""OBJ files: vertices, texture coordinates, normals, and faces that point into them.

Lines are sorted by their first word; the numbers of each kind are then read together. A relative
index counts back from what was read before its own line.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, printable
from nmatrix.scene.meshes.parts import FLAT, NONE, Attribute, MeshFile, Polygons
from nmatrix.scene.meshes.text import BadFigureError, Figures, figures, lines_of, readable

Array = NDArray[np.float64]
Indices = NDArray[np.intp]

TOGETHER = 1 << 15  # lines whose numbers are read at once
KINDS = ("v", "vt", "vn")
WORDS = {b"v": "vertex", b"vt": "texture coordinate", b"vn": "normal"}
FEWEST = {b"v": 3, b"vt": 1, b"vn": 3}
MOST = {b"v": 3, b"vt": 2, b"vn": 3}
NOT_DRAWN = {
    b"l": "lines",
    b"p": "points",
    b"curv": "curves",
    b"curv2": "curves",
    b"surf": "free-form surfaces",
    b"mg": "merging groups",
    b"call": "other files that are called",
    b"bsp": "patches",
    b"bzp": "patches",
    b"cdc": "curves",
    b"cdp": "curves",
}
_WITH_COLOUR = (6, 7)  # numbers of a vertex; the seventh is its opacity


@dataclass
class _Table:
    """The lines of one kind, without their first word, and their numbers."""

    lines: list[bytes] = field(default_factory=list)
    numbers: list[int] = field(default_factory=list)


@dataclass(frozen=True)
class _Change:
    """A line that holds for the faces after it."""

    face: int
    name: bytes


@dataclass
class _Sorted:
    """The lines of a file by what they are for.

    `relative` holds, by face, how many v, vt and vn stood before a face with a relative index.
    """

    tables: dict[bytes, _Table] = field(
        default_factory=lambda: {one: _Table() for one in (b"v", b"vt", b"vn", b"f")}
    )
    relative: dict[int, tuple[int, int, int]] = field(default_factory=dict)
    materials: list[_Change] = field(default_factory=list)
    smoothing: list[_Change] = field(default_factory=list)
    libraries: list[str] = field(default_factory=list)
    left_out: Counter[str] = field(default_factory=Counter)


def read_obj(path: Path, content: bytes) -> MeshFile:
    """Read the faces of an OBJ file, one part for each material that is used.

    Raises
    ------
    IllegalValueError
        For a number that is none, an index of nothing, or no faces; with the line.
    """
    found = _sorted(content)
    positions, colours, colour_remarks = _vertices(path, found.tables[b"v"])
    uv = _rows(path, found.tables[b"vt"], b"vt")
    normals = _rows(path, found.tables[b"vn"], b"vn")
    corners, sizes = _faces(path, found, (len(positions), len(uv), len(normals)))
    remarks = [*colour_remarks, *_left_out(path, found, sizes)]
    if not (sizes > 2).any():
        raise _nothing(path, len(positions))
    long = sizes > 2
    corners, kept = corners[np.repeat(long, sizes)], np.flatnonzero(long)
    names, material = _spans(found.materials, len(sizes))
    polygons = Polygons(
        path.name,
        positions,
        corners[:, 0],
        sizes[kept],
        _attribute(normals, _finite(normals, corners[:, 2])),
        _attribute(uv, _finite(uv, corners[:, 1])),
        None if colours is None else Attribute(colours, corners[:, 0]),
        _smoothing(found.smoothing, len(sizes), kept),
    )
    parts, told, origin = polygons.parts([readable(one) for one in names], material[kept])
    return MeshFile(parts, (*remarks, *told), origin, tuple(dict.fromkeys(found.libraries)))


def _sorted(content: bytes) -> _Sorted:
    found = _Sorted()
    tables = found.tables
    v, vt, vn, f = tables.values()
    for number, line in lines_of(content):
        word, _, rest = (line if line[:1] != b" " else line.lstrip()).partition(b" ")
        table = tables.get(word)
        if table is f and b"-" in rest:
            found.relative[len(f.lines)] = (len(v.lines), len(vt.lines), len(vn.lines))
        if table is not None:
            table.lines.append(rest)
            table.numbers.append(number)
        elif word == b"usemtl":
            found.materials.append(_Change(len(f.lines), rest.strip()))
        elif word == b"mtllib":
            found.libraries.append(readable(rest.strip()))
        elif word == b"s":
            found.smoothing.append(_Change(len(f.lines), rest.split(b"#")[0].strip().lower()))
        elif word in NOT_DRAWN:
            found.left_out[NOT_DRAWN[word]] += 1
    return found


def _read(
    path: Path, table: _Table, dtype: type, *, slashes: bool = False
) -> Iterator[tuple[int, list[bytes], Figures]]:
    """Read the numbers of a table, some lines at a time, with the place of the first of them."""
    for first in range(0, len(table.lines), TOGETHER):
        lines = table.lines[first : first + TOGETHER]
        try:
            yield first, lines, figures(lines, dtype, slashes=slashes)
        except BadFigureError as error:
            what, why, _ = error.parts
            raise _fault(path, table.numbers[first + error.row], what, why) from None


def _fault(path: Path, line: int, word: str, why: str) -> IllegalValueError:
    return IllegalValueError(f"{path}, line {line} ({word})", why, "mend that line")


def _rows(path: Path, table: _Table, kind: bytes) -> Array:
    """Read the numbers of v, vt or vn that are used, a row for each line; what lacks is 0."""
    return _wide_rows(path, table, kind)[0]


def _wide_rows(path: Path, table: _Table, kind: bytes) -> tuple[Array, Array, Indices]:
    """Read the leading numbers of each line, the three after its third, and how many there are."""
    most, lines = MOST[kind], len(table.lines)
    leading = np.zeros((lines, most))
    after = np.ones((lines, 3)) if kind == b"v" else np.empty((0, 3))
    widths = np.zeros(lines, np.intp)
    for first, text, found in _read(path, table, np.float64):
        width = np.bincount(found.row, minlength=len(text))
        if (width < FEWEST[kind]).any():
            row = int(np.argmax(width < FEWEST[kind]))
            shown = printable(readable(kind + b" " + text[row].strip()[:40]))
            why = f"a {WORDS[kind]} has {FEWEST[kind]} numbers and this one {width[row]}"
            raise _fault(path, table.numbers[first + row], shown, why)
        start = np.cumsum(width) - width
        here = slice(first, first + len(text))
        for i in range(most):
            has = width > i
            leading[here, i][has] = found.values[start[has] + i]
        if kind == b"v":
            has = np.isin(width, _WITH_COLOUR)
            for i in range(3):
                after[here, i][has] = found.values[start[has] + 3 + i]
        widths[here] = width
    return leading, after, widths


def _vertices(path: Path, table: _Table) -> tuple[Array, Array | None, list[str]]:
    """Read positions, and colours where vertices have them."""
    positions, colours, widths = _wide_rows(path, table, b"v")
    bad = ~np.isfinite(positions).all(axis=1)
    if bad.any():
        row = int(np.argmax(bad))
        word = next(one for one in table.lines[row].split() if not np.isfinite(float(one)))
        why = "a coordinate is a finite number"
        raise _fault(path, table.numbers[row], readable(word), why)
    if not np.isin(widths, _WITH_COLOUR).any():
        return positions, None, []
    remarks = []
    broken = ~np.isfinite(colours).all(axis=1)
    if broken.any():
        colours[broken] = 1.0
        remarks.append(f"Colours that are no numbers are drawn white: {broken.sum():,} vertices.")
    if colours.max() > 1.0:
        colours /= 255.0
        remarks.append(f"Colours of {path.name} go beyond 1: they were taken as parts of 255.")
    return positions, np.clip(colours, 0.0, 1.0), remarks


def _faces(path: Path, found: _Sorted, counts: tuple[int, int, int]) -> tuple[Indices, Indices]:
    """Read v, vt and vn (C, 3) of each corner, counted from 0, and the corners of each face."""
    table = found.tables[b"f"]
    corners: list[Indices] = []
    sizes: list[Indices] = []
    for first, lines, read in _read(path, table, np.int64, slashes=True):
        words = int(read.word[-1]) + 1 if len(read.word) else 0
        part = np.where(read.part > 2, 0, read.part)
        given = np.zeros((words, 3), np.int64)
        has = np.zeros((words, 3), bool)
        given[read.word, part] = read.values
        has[read.word, part] = True
        face = np.zeros(words, np.intp)
        face[read.word] = read.row
        read_before = np.tile(np.array(counts), (len(lines), 1))
        for i in np.unique(face[(given < 0).any(axis=1)]).tolist():
            read_before[i] = found.relative[first + i]
        before = read_before[face]
        index = np.where(given < 0, before + given, given - 1)
        index[~has] = NONE
        bad = has & ((given == 0) | (index < 0) | (index >= np.array(counts)))
        bad[:, 0] |= ~has[:, 0]
        too_long = np.zeros(words, bool)
        too_long[read.word[read.part > 2]] = True
        if bad.any() or too_long.any():
            word = int(np.argmax(bad.any(axis=1) | too_long))
            row = int(face[word])
            token = lines[row].split()[word - int(np.searchsorted(face, row))]
            which = int(np.argmax(bad[word]))
            why = _why(given[word], before[word], counts, which, too_long=bool(too_long[word]))
            raise _fault(path, table.numbers[first + row], printable(readable(token[:40])), why)
        corners.append(index)
        sizes.append(np.bincount(face, minlength=len(lines)))
    if not corners:
        return np.empty((0, 3), np.intp), np.empty(0, np.intp)
    return np.concatenate(corners), np.concatenate(sizes)


def _why(
    given: Indices, before: Indices, counts: tuple[int, int, int], which: int, *, too_long: bool
) -> str:
    """Explain what is wrong with a corner."""
    if too_long:
        return "a corner has three indices at most: v/vt/vn"
    kind, index = KINDS[which], int(given[which])
    if index == 0:
        return f"indices of {kind} count from 1, or back from −1"
    if index < 0:
        return f"only {int(before[which]):,} lines {kind} stand before it"
    return f"the file has {counts[which]:,} lines {kind}"


def _finite(values: Array, at: Indices) -> Indices:
    """Let corners that point to something that is not finite have none."""
    if not len(values):
        return at
    return np.where((at != NONE) & ~np.isfinite(values).all(axis=1)[at], NONE, at)


def _attribute(values: Array, at: Indices) -> Attribute | None:
    return Attribute(values, at) if (at != NONE).any() else None


def _spans(changes: list[_Change], faces: int) -> tuple[list[bytes], Indices]:
    """List the names that hold for some face, and which one holds for each."""
    names: dict[bytes, int] = {}
    found = np.zeros(faces, np.intp)
    spans = [_Change(0, b""), *changes, _Change(faces, b"")]
    for one, following in zip(spans, spans[1:], strict=False):
        if one.face < following.face:
            found[one.face : following.face] = names.setdefault(one.name, len(names))
    return list(names), found


def _smoothing(changes: list[_Change], faces: int, kept: Indices) -> Indices | None:
    """Number the smoothing groups of faces; before the first word of them all is smooth."""
    if not changes:
        return None
    names, at = _spans(changes, faces)
    flat = [name in (b"off", b"0") for name in names]
    number = np.array([FLAT if off else 1 + i for i, off in enumerate(flat)])
    return np.asarray(number[at][kept])


def _left_out(path: Path, found: _Sorted, sizes: Indices) -> list[str]:
    """Name what is not drawn."""
    counts: dict[str, Any] = dict(found.left_out)
    short = int(np.count_nonzero(sizes < 3))
    if short:
        counts["faces with fewer than three corners"] = short
    if not counts:
        return []
    listed = ", ".join(f"{count:,} {what}" for what, count in counts.items())
    return [f"Not drawn of {path.name}: {listed}."]


def _nothing(path: Path, vertices: int) -> IllegalValueError:
    why = f"it holds {vertices:,} points and no faces" if vertices else "it holds no triangles"
    return IllegalValueError(f"{path}", why, "export its surface as faces")
