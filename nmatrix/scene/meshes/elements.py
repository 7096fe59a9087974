"""The elements of a PLY file: a header declares their properties, the body holds them row by row.

Rows of one size are read at once. Where lists differ in length one walk finds where each begins,
and lists of one length are then read together.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path
from struct import Struct
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import IllegalValueError, did_you_mean, printable
from nmatrix.scene.meshes.text import is_beyond, numbers, readable, refused_word

Indices = NDArray[np.intp]

ORDERS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
KINDS = {
    **{"char": "i1", "uchar": "u1", "short": "i2", "ushort": "u2", "int": "i4", "uint": "u4"},
    **{"int8": "i1", "uint8": "u1", "int16": "i2", "uint16": "u2", "int32": "i4", "uint32": "u4"},
    **{"float": "f4", "double": "f8", "float32": "f4", "float64": "f8"},
}
TEXTURE = "texturefile"
LONGEST_HEADER = 1 << 20  # bytes
NOT_FINITE = (b"nan", b"inf", b"infinity")
_COMMENT = re.compile(rb"^ *(?:comment|obj_info)\b[^\n]*", re.MULTILINE)
_AS_LINES = bytes.maketrans(b"\r\t\v\f", b"\n   ")


@dataclass(frozen=True)
class Property:
    """A property: its kind as NumPy writes it, and that of its length if it is a list."""

    name: str
    kind: str
    count: str | None = None


@dataclass
class Element:
    """What the header declares of an element."""

    name: str
    count: int
    properties: list[Property] = field(default_factory=list)

    @property
    def shown(self) -> str:
        """The name as a message may show it."""
        return printable(self.name[:40])

    def kind(self, name: str) -> str:
        """Find the kind of a property."""
        return next(one.kind for one in self.properties if one.name == name)


@dataclass(frozen=True)
class Header:
    """A header: the order of bytes (None: text), the elements, its size in bytes and in lines."""

    order: str | None
    elements: tuple[Element, ...]
    size: int
    lines: int
    textures: tuple[str, ...] = ()
    remarks: tuple[str, ...] = ()


@dataclass(frozen=True)
class Lists:
    """A list in each row: all values, one row after the other, and the length of each."""

    values: NDArray[Any]
    lengths: Indices


Columns = Mapping[str, Any]  # of an element: arrays by property, or Lists


def read_header(path: Path, content: bytes) -> Header:
    """Read the header of a PLY file, whose lines end in LF, CR or both.

    Raises
    ------
    IllegalValueError
        For a line that cannot be understood, or a header that does not end.
    """
    if content[:3] != b"ply" or content[3:4] not in b"\r\n \t":
        raise IllegalValueError(
            f"{path}", "a PLY file begins with the line ply", "check its ending"
        )
    end = b"\r\n" if content[:LONGEST_HEADER].split(b"\n", 1)[0].endswith(b"\r") else b"\n"
    if (
        b"\n" not in content[: content.find(b"\r") + 2 or None]
        and b"\r" in content[:LONGEST_HEADER]
    ):
        end = b"\r"
    declared = _Declared()
    place = number = 0
    while True:
        stop = content.find(end, place, place + LONGEST_HEADER)
        line = content[place : stop if stop >= 0 else min(len(content), place + LONGEST_HEADER)]
        number, words = number + 1, readable(line).split()
        if words == ["end_header"]:
            place = len(content) if stop < 0 else stop + len(end)
            break
        if stop < 0:
            why = f"its header breaks off in line {number}, before end_header"
            raise IllegalValueError(f"{path}", why, "copy the file again")
        place = stop + len(end)
        shown = printable(" ".join(words)[:60])
        try:
            if not declared.understands(words):
                told = f"Line {number} of {path.name} was not understood: {shown}."
                declared.remarks.append(told)
        except (KeyError, ValueError, IndexError):
            raise IllegalValueError(
                f"{path}, line {number} ({shown})",
                "the header of a PLY file has no such line",
                _hint(words),
            ) from None
    if declared.form is None:
        raise IllegalValueError(f"{path}", "its header has no line format", "export it again")
    return Header(
        ORDERS[declared.form],
        tuple(declared.elements),
        place,
        number,
        tuple(declared.textures),
        tuple(declared.remarks),
    )


def _hint(words: list[str]) -> str:
    """Look for a form or a kind that is misspelled."""
    known = (*ORDERS, *KINDS)
    odd = [word for word in words[1:-1] if word not in (*known, "list")]
    return did_you_mean(odd[0] if odd else "", known, "export it again")


@dataclass
class _Declared:
    """What the lines of a header declare so far."""

    form: str | None = None
    elements: list[Element] = field(default_factory=list)
    textures: list[str] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)

    def understands(self, words: list[str]) -> bool:
        """Take in a line, if its first word is one of a header.

        Raises
        ------
        KeyError, ValueError, IndexError
            If the rest of it makes no sense.
        """
        match words:
            case [] | ["ply"]:
                pass
            case ["format", form, *_]:
                _ = ORDERS[form]
                self.form = form
            case ["comment" | "obj_info", *rest]:
                if rest and rest[0].lower() == TEXTURE:
                    self.textures.append(" ".join(rest[1:]))
            case ["element", name, count] if count.isdecimal():
                self.elements.append(Element(name, int(count)))
            case ["property", "list", count, kind, name]:
                self.elements[-1].properties.append(Property(name, KINDS[kind], KINDS[count]))
            case ["property", kind, name]:
                self.elements[-1].properties.append(Property(name, KINDS[kind]))
            case ["format" | "element" | "property", *_]:
                raise ValueError(words)
            case _:
                return False
        return True


def read_elements(path: Path, header: Header, content: bytes) -> dict[str, Columns]:
    """Read the rows of all elements, as columns by property.

    Raises
    ------
    IllegalValueError
        For a body that breaks off, or a word in it that is no number.
    """
    if header.order is not None:
        body = Body(path, header, content)
        return {element.name: body.columns(element) for element in header.elements}
    text = content[header.size :].replace(b"\r\n", b"\n").translate(_AS_LINES)
    if b"comment" in text:
        text = _COMMENT.sub(b"", text)
    as_doubles = replace(header, size=0)
    body = Body(path, as_doubles, _figures(path, header, text))
    try:
        found = {element.name: body.columns(element) for element in header.elements}
    except IllegalValueError:
        found = {}
    if body.is_read and found:
        return found
    body = Body(path, as_doubles, _row_by_row(path, header, text))  # lines hold more than rows
    return {element.name: body.columns(element) for element in header.elements}


def _figures(path: Path, header: Header, text: bytes) -> bytes:
    """Read a text's figures as the bytes of doubles, so that both kinds are walked alike."""
    found = numbers(text, np.float64)
    if found is not None and not is_beyond(found, text):
        return found.tobytes()
    for number, line in enumerate(text.split(b"\n"), header.lines + 1):
        for word in line.split():
            why = refused_word(word, whole=False)
            if why is not None and word.lower().lstrip(b"+-") not in NOT_FINITE:
                shown = printable(readable(word[:40]))
                raise IllegalValueError(f"{path}, line {number} ({shown})", why, "mend that line")
    raise IllegalValueError(f"{path}", "a number of it cannot be read", "export it again")


def _row_by_row(path: Path, header: Header, text: bytes) -> bytes:
    """Read the figures of a text line by line: one is a row, and what follows it is left out."""
    lines = iter([line.split() for line in text.split(b"\n") if line.strip()])
    kept: list[float] = []
    for element in header.elements:
        for row in range(element.count if element.properties else 0):
            words = next(lines, [])
            size = 0
            for one in element.properties:
                if one.count is not None and size < len(words):
                    length = float(words[size])  # one that is none is refused where it is read
                    size += int(length) if is_whole(length) else 0
                size += 1
            if size > len(words):
                raise breaks_off(path, element, row)
            kept.extend(map(float, words[:size]))
    return np.array(kept).tobytes()


def breaks_off(path: Path, element: Element, row: int) -> IllegalValueError:
    """Make the error for a body that ends in a row."""
    why = f"it breaks off in row {row + 1:,} of {element.count:,} of the element {element.shown}"
    return IllegalValueError(f"{path}", why, "copy the file again")


@dataclass
class Body:
    """What follows the header, element by element: figures of a text, or bytes."""

    path: Path
    header: Header
    content: bytes
    place: int = field(init=False)

    def __post_init__(self) -> None:
        """Begin after the header."""
        self.place = self.header.size

    @property
    def is_read(self) -> bool:
        """True if nothing is left."""
        return self.place == len(self.content)

    def columns(self, element: Element) -> Columns:
        """Read all rows of an element."""
        least = sum(self._kind(one.count or one.kind).itemsize for one in element.properties)
        if least * element.count > len(self.content) - self.place:
            rows = (len(self.content) - self.place) // max(least, 1)
            raise breaks_off(self.path, element, rows)
        if not element.count or not element.properties:
            return {}
        return self._rows_alike(element) or self._rows_of_any_length(element)

    def _kind(self, kind: str) -> np.dtype[Any]:
        return np.dtype("<f8" if self.header.order is None else self.header.order + kind)

    def _rows_alike(self, element: Element) -> Columns | None:
        """Read rows whose lists are as long as the first row's; None if some is not."""
        lengths = self._first_lengths(element)
        fields: list[Any] = []
        for index, one in enumerate(element.properties):
            if one.count is not None:
                fields.append((f"n{index}", self._kind(one.count)))
            size = (lengths[index],) if one.count is not None else ()
            fields.append((f"p{index}", self._kind(one.kind), size))
        row = np.dtype(fields)
        if row.itemsize * element.count > len(self.content) - self.place:
            return None
        table = np.frombuffer(self.content, row, element.count, self.place)
        for index, one in enumerate(element.properties):
            if one.count is not None and (table[f"n{index}"] != lengths[index]).any():
                return None
        self.place += row.itemsize * element.count
        found: dict[str, Any] = {}
        for index, one in enumerate(element.properties):
            values = table[f"p{index}"]
            found[one.name] = values
            if one.count is not None:
                counts = np.full(element.count, lengths[index], np.intp)
                found[one.name] = Lists(values.reshape(-1), counts)
        return found

    def _first_lengths(self, element: Element) -> list[int]:
        """Find the length of each list in the first row."""
        lengths, place = [], self.place
        for one in element.properties:
            length = 1
            if one.count is not None:
                kind = self._kind(one.count)
                if place + kind.itemsize > len(self.content):
                    raise breaks_off(self.path, element, 0)
                given = np.frombuffer(self.content, kind, 1, place)[0]
                length = self._length(element, 0, float(given))
                place += kind.itemsize
            lengths.append(length)
            place += length * self._kind(one.kind).itemsize
            if place > len(self.content):
                raise breaks_off(self.path, element, 0)
        return lengths

    def _rows_of_any_length(self, element: Element) -> Columns:
        """Find where each value and each list begins, and read those of one length together."""
        starts, lengths, self.place = self._walk(element)
        content = np.frombuffer(self.content, np.uint8)
        found: dict[str, Any] = {}
        for index, one in enumerate(element.properties):
            at, sizes = np.array(starts[index]), np.array(lengths[index], np.intp)
            kind = self._kind(one.kind)
            if one.count is None:
                found[one.name] = _gathered(content, at, 1, kind)[:, 0]
                continue
            ends = np.cumsum(sizes)
            values = np.empty(int(ends[-1]), kind)
            for size in np.unique(sizes[sizes > 0]).tolist():
                alike = np.flatnonzero(sizes == size)
                targets = (ends - sizes)[alike][:, None] + np.arange(size)
                values[targets] = _gathered(content, at[alike], size, kind)
            found[one.name] = Lists(values, sizes)
        return found

    def _walk(self, element: Element) -> tuple[list[list[int]], list[list[int]], int]:
        plan: list[tuple[Any, int, int]] = []
        for one in element.properties:
            first, kind = self._kind(one.count or one.kind), self._kind(one.kind)
            order = ">" if first.str[0] == ">" else "<"
            count = None if one.count is None else Struct(order + first.char).unpack_from
            plan.append((count, first.itemsize, kind.itemsize))
        starts: list[list[int]] = [[] for _ in plan]
        lengths: list[list[int]] = [[] for _ in plan]
        columns = list(zip(plan, starts, lengths, strict=True))
        place, content, end = self.place, self.content, len(self.content)
        for row in range(element.count):
            for (count, lead, size), start, length in columns:
                if count is None:
                    start.append(place)
                    place += size
                    continue
                if place + lead > end:
                    raise breaks_off(self.path, element, row)
                n = self._length(element, row, count(content, place)[0])
                place += lead
                start.append(place)
                length.append(n)
                place += n * size
            if place > end:
                raise breaks_off(self.path, element, row)
        return starts, lengths, place

    def _length(self, element: Element, row: int, given: float) -> int:
        """Take the length of a list, which is a whole number whatever its kind is."""
        if not is_whole(given):
            raise IllegalValueError(
                f"{self.path}, row {row + 1:,} of the element {element.shown}",
                f"a list of it has the length {given:g}",
                "export it again",
            )
        return int(given)


def is_whole(length: float) -> bool:
    """Tell whether a number may be the length of a list.

    Examples
    --------
    >>> [is_whole(one) for one in (0, 3.0, 3.5, -1, float("nan"), float("inf"))]
    [True, True, False, False, False, False]
    """
    return length >= 0 and length % 1 == 0


def _gathered(content: NDArray[Any], at: NDArray[Any], size: int, kind: Any) -> NDArray[Any]:  # noqa: ANN401
    """Read lists of one size that begin anywhere in the bytes."""
    wide = np.lib.stride_tricks.sliding_window_view(content, size * kind.itemsize)
    return np.asarray(np.ascontiguousarray(wide[at]).view(kind))
