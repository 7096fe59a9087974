"""A table of a scene file: what it holds, checked, and one line for every fault in it."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from functools import cache
from math import isfinite
from pathlib import Path
from typing import Any, Literal, TypeVar, get_args, get_origin

import msgspec

from nmatrix.errors import IllegalValueError, did_you_mean, printable, quoted, shortlist
from nmatrix.linear.rational import AFFINE_ROW, RationalMatrix, affine_matrix, rational_matrix
from nmatrix.reading.angles import angle
from nmatrix.reading.files import existing_file
from nmatrix.scene.beside import beside
from nmatrix.scene.toml.records import ANGLE, Record

Checked = TypeVar("Checked", bound=Record)
Raw = Any  # what TOML can say

UNBOUNDED = ("far", "range")  # keys that may be infinite
LONGEST = 60
MOST_BITS = 200  # of an integer that is worth showing


@dataclass(frozen=True)
class SceneTable:
    """A table of a scene file: which file, the header by which messages name it, what it holds."""

    path: Path
    header: str = ""
    raw: Mapping[str, Raw] = field(default_factory=dict)
    allow_outside: bool = False

    def fault(self, key: str, why: str, next_step: str = "mend the file") -> IllegalValueError:
        """Return the error for a key, with its value if it has one."""
        value = f" ({shown(self.raw[key])})" if key in self.raw else ""
        return self.refused(f"{key}{value}", why, next_step)

    def refused(self, what: str, why: str, next_step: str = "mend the file") -> IllegalValueError:
        """Return the error for a part of the table."""
        header = f", {self.header}" if self.header else ""
        on_one_line = "".join(one if one.isprintable() else "�" for one in why)
        return IllegalValueError(f"{self.path}{header}: {what}", on_one_line, next_step)

    def refuse_beside(self, key: str, others: Sequence[str], because: str) -> None:
        """Refuse keys that contradict another one.

        Raises
        ------
        IllegalValueError
            If the table has any of the others.
        """
        beside = [other for other in others if other in self.raw]
        if beside:
            raise self.refused(f"{key} with {', '.join(beside)}", because, "keep one of them")

    def inner(self, key: str) -> SceneTable:
        """Return the table that a key holds."""
        return self.part(f"{self.header} {key}", self.raw[key])

    def part(self, header: str, raw: Raw) -> SceneTable:
        """Return another table of the file."""
        return replace(self, header=header, raw=raw)

    def file(self, key: str) -> Path:
        """Return the file that a key names, relative to the scene file.

        Raises
        ------
        IllegalValueError
            If there is no such file, or it lies outside of the folder and must not.
        """
        named = beside(self.path, self.raw[key], allow_outside=self.allow_outside)
        path = existing_file(str(named))
        if path is None:
            raise self.fault(key, "there is no such file", "names are relative to the scene file")
        return path

    def affine_matrix(self, key: str, rows: Sequence[Sequence[float]]) -> RationalMatrix:
        """Return the affine 4×4 matrix of a key's rows; three rows are its linear part.

        Raises
        ------
        IllegalValueError
            For another size, or a last row other than 0 0 0 1.
        """
        shape = {(len(rows), len(row)) for row in rows}
        if shape == {(3, 3)}:
            return affine_matrix(rational_matrix(rows))
        if shape == {(3, 4)}:
            return (*rational_matrix(rows), AFFINE_ROW)
        if shape != {(4, 4)}:
            raise self.fault(key, "it is three rows of three numbers or four rows of four")
        if tuple(rows[3]) != (0, 0, 0, 1):
            raise self.refused(
                f"{key} (last row {' '.join(f'{x:g}' for x in rows[3])})",
                "an affine matrix ends in 0 0 0 1",
                "write rows, not columns",
            )
        return rational_matrix(rows)

    def known(self, key: str, name: str, names: Collection[str], what: str) -> str:
        """Return a name that the key refers to, if it is one of the names.

        Raises
        ------
        IllegalValueError
            With the nearest of the names, or all of them.
        """
        if name in names:
            return name
        raise self.fault(key, f"no {what} has this name", suggestion(name, names))

    def checked(self, kind: type[Checked]) -> Checked:
        """Return the table as a record.

        Raises
        ------
        IllegalValueError
            For an unknown key, a value of another type or out of bounds, a number that is not
            finite.
        """
        if not isinstance(self.raw, dict):
            raise IllegalValueError(
                f"{self.path}, {self.header} ({shown(self.raw)})",
                "it is not a table",
                f"write it under {self.header.split(' ')[0]}",
            )
        for key, value in self.raw.items():
            self._check_finite(key, value)
        raw = self._in_degrees(kind)
        try:
            return msgspec.convert(raw, kind)
        except msgspec.ValidationError:
            raise self._first_fault(kind, raw) from None

    def _in_degrees(self, kind: type[Record]) -> Mapping[str, Raw]:
        """Make degrees of the angles that are texts with a unit."""
        found = dict(self.raw)
        for key, angles in _angles_of(kind).items():
            value = found.get(key)
            if isinstance(value, str | list):
                try:
                    found[key] = _with_texts_read(value, angles)
                except IllegalValueError as error:
                    _, why, next_step = error.parts
                    raise self.fault(key, why, next_step) from None
        return found

    def _first_fault(self, kind: type[Record], raw: Mapping[str, Raw]) -> IllegalValueError:
        """Check again, key by key: then it is known whose fault the checker complains of."""
        fields = {one.name: one for one in msgspec.structs.fields(kind)}
        for key, value in raw.items():
            if key not in fields:
                near = suggestion(key, fields)
                return self.refused(printable(key), "no such key is known here", near)
            try:
                msgspec.convert(value, fields[key].type)
            except msgspec.ValidationError as error:
                return self.fault(key, in_words(error), _mending(value, fields[key]))
        missing = next(one for one in fields.values() if one.required and one.name not in self.raw)
        return self.refused(
            missing.name, "it is missing", f"add {missing.name}: {_meaning(missing)}"
        )

    def _check_finite(self, key: str, value: Raw) -> None:
        if isinstance(value, float) and not isfinite(value):
            if value > 0 and key in UNBOUNDED:
                return
            raise self.fault(key, "it is not a finite number")
        if isinstance(value, list):
            for one in value:
                self._check_finite(key, one)


@cache
def _angles_of(kind: type[Record]) -> Mapping[str, object]:
    """List the keys of a record that hold angles, with their types."""
    types = {one.name: one.type for one in msgspec.structs.fields(kind)}
    return {key: one for key, one in types.items() if _has_angle(one)}


def _has_angle(annotation: object) -> bool:
    if ANGLE in getattr(annotation, "__metadata__", ()):
        return True
    return any(map(_has_angle, get_args(annotation)))


def _with_texts_read(value: Raw, annotation: object) -> Raw:
    """Make degrees of a text where the type has an angle; all else stays."""
    if isinstance(value, str) and ANGLE in getattr(annotation, "__metadata__", ()):
        return float(angle(value))
    parts = get_args(annotation)
    if get_origin(annotation) is tuple:
        is_whole = isinstance(value, list) and len(value) == len(parts)
        return list(map(_with_texts_read, value, parts)) if is_whole else value
    for part in parts:
        value = _with_texts_read(value, part)
    return value


def in_words(error: msgspec.ValidationError) -> str:
    """Return the checker's sentence, without code marks, null (TOML has none) and the path.

    Examples
    --------
    >>> in_words(msgspec.ValidationError("Expected `float | null`, got `str` - at `$[2]`"))
    'expected float, got str'
    """
    sentence = str(error).partition(" - at ")[0].replace(" | null", "").replace("`", "")
    text = sentence[:1].lower() + sentence[1:]
    return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"  # it may repeat the value


def _mending(value: Raw, one: msgspec.structs.FieldInfo) -> str:
    """Return the next step: the nearest of the words that the key takes, or its meaning."""
    words = _choices(one.type)
    if words:
        return suggestion(value if isinstance(value, str) else "", words)
    return f"mend {one.name}: {_meaning(one)}"


def _meaning(one: msgspec.structs.FieldInfo) -> str:
    """Return a key's description, as the end of a sentence."""
    text = str(one.type.__metadata__[-1].description).removesuffix(".")
    return text[:1].lower() + text[1:]


def _choices(annotation: object) -> list[str]:
    """Return the words that a type allows; none for numbers and free text."""
    if isinstance(annotation, type) and issubclass(annotation, StrEnum):
        return [str(word) for word in annotation]
    if get_origin(annotation) is Literal:
        return [str(word) for word in get_args(annotation)]
    return [word for part in get_args(annotation) for word in _choices(part)]


def suggestion(name: str, names: Collection[str]) -> str:
    """Ask for the nearest name, or list what there is.

    Examples
    --------
    >>> suggestion("lihgt", ["light"]), suggestion("x", ["light", "sun"]), suggestion("x", [])
    ('did you mean light?', 'there are light, sun', 'there are none')
    """
    return did_you_mean(name, names, f"there are {shortlist(map(printable, names)) or 'none'}")


def shown(value: Raw) -> str:
    """Return a value of a scene file in a few words.

    Examples
    --------
    >>> shown([1, "x", [2, 3]]), shown({"x": 1}), shown(True)
    ('1 "x" [2 3]', 'a table', 'true')
    """
    if isinstance(value, str):
        return f'"{value}"' if printable(value) == value else quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value.bit_length() > MOST_BITS:
        return "a huge integer"
    if isinstance(value, list):
        inside = " ".join(f"[{shown(x)}]" if isinstance(x, list) else shown(x) for x in value[:6])
        text = f"{inside}{' …' if len(value) > 6 else ''}"
        return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
    return "a table" if isinstance(value, dict) else str(value)
