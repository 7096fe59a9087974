"""OBJ files: vertices, texture coordinates, normals, and faces that point into them.

Lines are sorted by their first word, and the numbers of each kind are read many lines at a time. A
relative index counts back from what was read before its own line.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass, field
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, printable
from nmatrix.scene.meshes.parts import FLAT, NONE, Attribute, MeshFile, Polygons, without_triangles
from nmatrix.scene.meshes.polygons import TRIANGLE
from nmatrix.scene.meshes.text import (
    BadFigureError,
    Figures,
    blocks_of,
    figures,
    lines_of,
    readable,
)
from nmatrix.scene.words import counted

Array = NDArray[np.float64]
Indices = NDArray[np.integer[Any]]

TOGETHER = 1 << 15  # lines whose numbers are read at once
NOT_DRAWN = {
    **{"l": "lines", "p": "points", "call": "other files that are called"},
    **dict.fromkeys(("curv", "curv2", "cdc", "cdp"), "curves"),
    **dict.fromkeys(("surf", "bsp", "bzp"), "free-form surfaces"),
}
SMOOTHING_OFF = (b"off", b"0")
BEYOND = (1 << 31) - 1  # the index of a corner that points to nothing
_LEFT_OUT = {word.encode(): what for word, what in NOT_DRAWN.items()}
_WITH_COLOUR = (6, 7)  # numbers of a vertex; the seventh is its opacity


@dataclass
class _Lines:
    """Lines of one kind that wait to be read, without their first word, and their numbers."""

    path: Path
    lines: list[bytes] = field(default_factory=list)
    numbers: list[int] = field(default_factory=list)
    count: int = 0  # lines that were read before these

    def __len__(self) -> int:
        """Count the lines that stood in the file so far."""
        return self.count + len(self.lines)

    def figures(self, dtype: type, *, slashes: bool = False) -> Figures:
        """Read the numbers of the lines that wait."""
        try:
            return figures(self.lines, dtype, slashes=slashes)
        except BadFigureError as error:
            raise self.fault(error.row, error.parts[0], error.parts[1]) from None

    def done(self) -> None:
        """Put away the lines, which were read."""
        self.count += len(self.lines)
        self.lines.clear()
        self.numbers.clear()

    def fault(self, row: int, word: str, why: str) -> IllegalValueError:
        """Make the error for a word of a line that waits."""
        named = f"{self.path}, line {self.numbers[row]} ({word})"
        return IllegalValueError(named, why, "mend that line")


@dataclass
class _Values(_Lines):
    """The lines v, vt or vn: numbers that corners point to."""

    what: str = "vertex"
    fewest: int = 3
    most: int = 3
    blocks: list[Array] = field(default_factory=list)
    colours: list[Array] = field(default_factory=list)
    has_colours: bool = False

    def read(self) -> None:
        """Read the lines that wait, of any number of numbers each."""
        found, lines = self.figures(np.float64), len(self.lines)
        width = np.bincount(found.row, minlength=lines)
        if width.min(initial=self.fewest) < self.fewest:
            row = int(np.argmax(width < self.fewest))
            shown = printable(readable(b" ".join(self.lines[row].split())[:40]))
            why = f"a {self.what} has {counted(self.fewest, 'number')} and this one {width[row]}"
            raise self.fault(row, shown, why)
        start = np.cumsum(width) - width
        block = np.zeros((lines, self.most))
        for i in range(self.most):
            has = width > i
            block[has, i] = found.values[start[has] + i]
        if self.what == _Values.what:
            self._check_finite(block)
            coloured = np.isin(width, _WITH_COLOUR)
            self.has_colours |= bool(coloured.any())
            self.colours.append(np.ones((lines, 3), np.float32))
            for i in range(3):
                self.colours[-1][coloured, i] = found.values[start[coloured] + 3 + i]
        self.blocks.append(block)
        self.done()

    def _check_finite(self, block: Array) -> None:
        bad = ~np.isfinite(block).all(axis=1)
        if bad.any():
            row = int(np.argmax(bad))
            word = next(one for one in self.lines[row].split() if not np.isfinite(float(one)))
            raise self.fault(row, readable(word[:40]), "a coordinate is a finite number")

    @property
    def values(self) -> Array:
        """All values, a row for each line."""
        return np.concatenate([np.empty((0, self.most)), *self.blocks])


@dataclass
class _Faces(_Lines):
    """The lines f: for each corner the indices of v, vt and vn, counted from 0.

    `before` holds, for lines with a relative index, how many v, vt and vn stood before them.
    """

    before: dict[int, tuple[int, int, int]] = field(default_factory=dict)
    corners: list[NDArray[np.int32]] = field(default_factory=list)
    sizes: list[NDArray[np.int32]] = field(default_factory=list)
    line: list[NDArray[np.int32]] = field(default_factory=list)

    def read(self) -> None:
        """Read the lines that wait; relative indices are resolved, and those of nothing refused."""
        found, lines = self.figures(np.int64, slashes=True), len(self.lines)
        words = int(found.word[-1]) + 1 if len(found.word) else 0
        given, has = np.zeros((words, 3), np.int64), np.zeros((words, 3), bool)
        face = np.zeros(words, np.intp)
        face[found.word] = found.row
        too_many = np.zeros(words, bool)
        too_many[found.word[found.part >= TRIANGLE]] = True
        part = np.minimum(found.part, 2)
        given[found.word, part], has[found.word, part] = found.values, True
        before = np.zeros((lines, 3), np.int64)
        for row in np.unique(face[(given < 0).any(axis=1)]).tolist():
            before[row] = self.before[row]
        index = np.where(given < 0, before[face] + given, given - 1)
        lost = has & (index < 0)
        index[lost | ~has] = NONE
        bad = (index[:, 0] == NONE) | too_many
        if bad.any():
            word = int(np.argmax(bad))
            row = int(face[word])
            token = self.lines[row].split()[word - int(np.searchsorted(face, row))]
            why = f"only {before[row, 0]:,} lines v stand before it"
            if too_many[word]:
                why = "a corner has three indices at most: v/vt/vn"
            elif given[word, 0] >= 0:
                why = "indices of v count from 1, or back from −1"
            raise self.fault(row, printable(readable(token[:40])), why)
        index[lost] = BEYOND
        self.corners.append(np.minimum(index, BEYOND).astype(np.int32))
        self.sizes.append(np.bincount(face, minlength=lines).astype(np.int32))
        self.line.append(np.array(self.numbers, np.int32))
        self.before.clear()
        self.done()


class _Sorted:
    """The lines of a file by what they are for; changes hold for the faces after them."""

    def __init__(self, path: Path) -> None:
        self.values = (
            _Values(path),
            _Values(path, what="texture coordinate", fewest=1, most=2),
            _Values(path, what="normal"),
        )
        self.faces = _Faces(path)
        self.tables: dict[bytes, _Values | _Faces] = dict(
            zip((b"v", b"vt", b"vn", b"f"), (*self.values, self.faces), strict=True)
        )
        self.materials: list[tuple[int, bytes]] = []
        self.smoothing: list[tuple[int, bytes]] = []
        self.libraries: list[str] = []
        self.left_out: Counter[str] = Counter()

    def read(self, content: bytes) -> None:
        """Sort all lines; blocks of one kind are not walked."""
        for numbers, block in blocks_of(content):
            word = block.partition(b" ")[0]
            table = self.tables.get(word)
            if table is None or not _is_alike(word, block, len(numbers)):
                self._walk(numbers, block)
                continue
            table.lines += block[len(word) + 1 :].split(b"\n" + word + b" ")
            table.numbers += numbers
            table.read()
        for table in self.tables.values():
            table.read()

    def _walk(self, numbers: Sequence[int], block: bytes) -> None:
        faces, (v, vt, vn) = self.faces, self.values
        for number, line in zip(numbers, block.split(b"\n"), strict=True):
            word, _, rest = (line if line[:1] != b" " else line.lstrip()).partition(b" ")
            table = self.tables.get(word)
            if table is None:
                self._note(word, rest.strip())
                continue
            if table is faces and b"-" in rest:
                faces.before[len(faces.lines)] = (len(v), len(vt), len(vn))
            table.lines.append(rest)
            table.numbers.append(number)
            if len(table.lines) == TOGETHER:
                table.read()

    def _note(self, word: bytes, rest: bytes) -> None:
        """Keep a line that is no numbers."""
        if word == b"usemtl":
            self.materials.append((len(self.faces), rest))
        elif word == b"mtllib":
            self.libraries.append(readable(rest))
        elif word == b"s":
            self.smoothing.append((len(self.faces), rest.split(b"#")[0].strip().lower()))
        elif word in _LEFT_OUT:
            self.left_out[_LEFT_OUT[word]] += 1


def read_obj(path: Path, content: bytes) -> MeshFile:
    """Read the faces of an OBJ file, one part for each material that is used.

    Raises
    ------
    IllegalValueError
        For a number that is none, a vertex that is not there, or no faces; with the line.
    """
    found = _Sorted(path)
    found.read(content)
    v, vt, vn = found.values
    remarks = _left_out(path, found)
    sizes = np.concatenate([np.empty(0, np.intp), *found.faces.sizes])
    long = sizes >= TRIANGLE
    if not long.any():
        raise IllegalValueError(f"{path}", *without_triangles(len(v), int(np.count_nonzero(sizes))))
    corners = np.concatenate(found.faces.corners)
    found.faces.corners.clear()
    remarks += _checked(path, content, found, sizes, corners)
    corners = corners if long.all() else corners[np.repeat(long, sizes)]
    names, material = _spans(found.materials, len(sizes))
    colours, told = _colours(path, v)
    places = corners[:, 0].astype(np.intp)
    polygons = Polygons(
        path.name,
        v.values,
        places,
        sizes[long],
        _attribute(vn.values, corners[:, 2]),
        _attribute(vt.values, corners[:, 1]),
        None if colours is None else Attribute(colours, places),
        _smoothing(found.smoothing, long),
    )
    parts, made, origin = polygons.parts([readable(one) for one in names], material[long])
    libraries = tuple(dict.fromkeys(found.libraries))
    return MeshFile(parts, (*remarks, *told, *made), origin, libraries)


def _is_alike(word: bytes, block: bytes, lines: int) -> bool:
    """Tell whether all lines of a block begin with a word, and no face has a relative index."""
    alike = block.count(b"\n" + word + b" ") == lines - 1
    return alike and (word != b"f" or b"-" not in block)


def _checked(
    path: Path, content: bytes, found: _Sorted, sizes: Indices, corners: Indices
) -> list[str]:
    """Refuse vertices that are not there; texture coordinates and normals alike are left out."""
    remarks = []
    for which, table in enumerate(found.values):
        beyond = corners[:, which] >= len(table)
        if not beyond.any():
            continue
        face = int(np.searchsorted(np.cumsum(sizes), np.argmax(beyond), side="right"))
        line = int(np.concatenate(found.faces.line)[face])
        if which == 0:
            text = next(text for number, text in lines_of(content) if number == line)
            word = text.split()[1 + int(np.argmax(beyond)) - int(sizes[:face].sum())]
            raise IllegalValueError(
                f"{path}, line {line} ({printable(readable(word[:40]))})",
                f"the file has {len(table):,} lines v",
                "mend that line",
            )
        corners[beyond, which] = NONE
        count = np.count_nonzero(beyond)
        told = f"line {line} is the first to name a {table.what} that is not there"
        corners_go = "corner goes" if count == 1 else "corners go"
        remarks.append(f"{path.name}, {told}: {count:,} {corners_go} without.")
    return remarks


def _colours(path: Path, table: _Values) -> tuple[Array | None, list[str]]:
    """Read the colours of vertices in [0, 1], where there are any."""
    if not table.has_colours:
        return None, []
    remarks = []
    colours = np.concatenate(table.colours).astype(np.float64)
    broken = ~np.isfinite(colours).all(axis=1)
    if broken.any():
        colours[broken] = 1.0
        count = np.count_nonzero(broken)
        remarks.append(f"Colours that are no finite numbers are drawn white: {count:,} of them.")
    if colours.max() > 1.0:
        colours /= 255.0
        remarks.append(f"Colours of {path.name} go beyond 1: they were taken as parts of 255.")
    return np.clip(colours, 0.0, 1.0), remarks


def _attribute(values: Array, at: Indices) -> Attribute | None:
    """Pair values with the corners that point to them; what is not finite is missing."""
    if not len(values):
        return None
    bad = np.logical_not(np.isfinite(values).all(axis=-1))
    if bad.any():
        at = np.where((at != NONE) & bad[at], NONE, at)
    return Attribute(values, at) if (at != NONE).any() else None


def _spans(changes: Sequence[tuple[int, bytes]], faces: int) -> tuple[list[bytes], Indices]:
    """List the names that hold for some face, and which one holds for each."""
    names: dict[bytes, int] = {}
    found = np.zeros(faces, np.intp)
    for (first, name), (after, _) in pairwise([(0, b""), *changes, (faces, b"")]):
        if first < after:
            found[first:after] = names.setdefault(name, len(names))
    return list(names), found


def _smoothing(changes: Sequence[tuple[int, bytes]], kept: NDArray[np.bool_]) -> Indices | None:
    """Give each face the number of its smoothing group; before the first word all is smooth."""
    if not changes:
        return None
    names, at = _spans(changes, len(kept))
    numbers = [FLAT if name in SMOOTHING_OFF else 1 + i for i, name in enumerate(names)]
    return np.array(numbers)[at][kept]


def _left_out(path: Path, found: _Sorted) -> list[str]:
    """Name what is not drawn."""
    counts = Counter(found.left_out)
    counts["faces with fewer than three corners"] = sum(
        int(np.count_nonzero(sizes < TRIANGLE)) for sizes in found.faces.sizes
    )
    listed = ", ".join(f"{what} ({count:,})" for what, count in counts.items() if count)
    return [f"Not drawn of {path.name}: {listed}."] if listed else []
