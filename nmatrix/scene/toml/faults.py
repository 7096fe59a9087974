"""One line for every fault of a scene file: the file, the key, its value, what is accepted."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Mapping
from dataclasses import dataclass, field
from difflib import get_close_matches
from math import isfinite
from pathlib import Path
from typing import Any, TypeVar

import msgspec

from nmatrix.errors import IllegalValueError, quoted
from nmatrix.scene.toml.records import Table

Record = TypeVar("Record", bound=Table)
Raw = Any  # what TOML can say

UNBOUNDED = ("far", "range")  # keys that may be infinite
LONGEST = 60
MOST_BITS = 200  # of an integer that is worth showing
_WHERE = re.compile(r" - at `\$(?:\.(\w+))?((?:\[\d+\])*).*`\Z")


@dataclass(frozen=True)
class Place:
    """A table of a scene file: which file, what the table is called, what it holds."""

    path: Path
    table: str = ""
    raw: Mapping[str, Raw] = field(default_factory=dict)

    def fault(self, key: str, why: str, next_step: str = "mend the file") -> IllegalValueError:
        """Return the error for a key, with its value if it has one."""
        value = f" ({shown(self.raw[key])})" if key in self.raw else ""
        return self.refused(f"{key}{value}", why, next_step)

    def refused(self, what: str, why: str, next_step: str = "mend the file") -> IllegalValueError:
        """Return the error for a part of the table."""
        table = f", {self.table}" if self.table else ""
        return IllegalValueError(f"{self.path}{table}: {what}", why, next_step)

    def inner(self, key: str) -> Place:
        """Return the table that a key holds."""
        return Place(self.path, f"{self.table} {key}", self.raw[key])

    def file(self, key: str) -> Path:
        """Return the file that a key names, relative to the scene file.

        Raises
        ------
        IllegalValueError
            If there is no such file.
        """
        path: Path = self.path.parent / self.raw[key]
        try:
            if path.is_file():
                return path
        except (OSError, ValueError):  # a name too long, or with a NUL: no file has it
            pass
        raise self.fault(key, "there is no such file", "names are relative to the scene file")

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


def suggestion(name: str, names: Iterable[str]) -> str:
    """Return a question with the nearest name, or the list of all of them.

    Examples
    --------
    >>> suggestion("lihgt", ["light"]), suggestion("x", ["light", "sun"]), suggestion("x", [])
    ('did you mean light?', 'there are light, sun', 'there are none')
    """
    choice = list(names)
    near = get_close_matches(name, choice, n=1, cutoff=0.6)
    if near:
        return f"did you mean {printable(near[0])}?"
    listed = ", ".join(printable(one) for one in choice[:8])
    return f"there are {listed or 'none'}{', …' if len(choice) > 8 else ''}"


def printable(name: str) -> str:
    """Return a name as it is, or quoted where it would break the line."""
    return name if name.isprintable() and len(name) <= LONGEST else quoted(name)


def shown(value: Raw) -> str:
    """Return a value of a scene file in a few words."""
    if isinstance(value, str):
        return f'"{value}"' if printable(value) == value else quoted(value)
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int) and value.bit_length() > MOST_BITS:
        return "a huge integer"
    if isinstance(value, list):
        inside = " ".join(shown(one) for one in value[:6])
        text = f"{inside}{' …' if len(value) > 6 else ''}"
        return text if len(text) <= LONGEST else f"{text[:LONGEST]}…"
    return "a table" if isinstance(value, dict) else str(value)


def converted(place: Place, kind: type[Record]) -> Record:
    """Return a table as a record.

    Raises
    ------
    IllegalValueError
        For an unknown key, a value of another type or out of bounds, a number that is not finite.
    """
    if not isinstance(place.raw, dict):
        raise IllegalValueError(
            f"{place.path}, {place.table} ({shown(place.raw)})",
            "it is not a table",
            f"write it under {place.table.split(' ')[0]}",
        )
    for key in place.raw:
        if key not in kind.__struct_fields__:
            raise place.refused(
                printable(key), "no such key is known here", suggestion(key, kind.__struct_fields__)
            )
    for key, value in place.raw.items():
        _check_finite(place, key, value)
    try:
        return msgspec.convert(place.raw, kind)
    except msgspec.ValidationError as error:
        raise _translated(place, kind, str(error)) from None


def _check_finite(place: Place, key: str, value: Raw) -> None:
    if isinstance(value, float) and not isfinite(value):
        if value > 0 and key in UNBOUNDED:
            return
        raise place.fault(key, "it is not a finite number")
    if isinstance(value, list):
        for one in value:
            _check_finite(place, key, one)


def _translated(place: Place, kind: type[Table], message: str) -> IllegalValueError:
    """Return the checker's complaint in our words."""
    found = _WHERE.search(message)
    if found is None or found[1] is None:
        missing = re.search("field `(.*)`", message)
        what = missing[1] if missing else place.table
        return place.refused(what, "it is missing", f"add {what} = {example(kind, what)}")
    key, indices = found[1], [int(i) for i in re.findall(r"\d+", found[2])]
    value = place.raw[key]
    for i in indices:
        value = value[i]
    where = "".join(f", number {i + 1}" for i in indices[-1:])
    schema = field_schema(kind, key)
    choices = choices_of(schema)
    if choices and isinstance(value, str):
        return place.refused(
            f"{key} ({shown(value)})", f"it must be {accepted(schema)}", suggestion(value, choices)
        )
    return place.refused(f"{key}{where} ({shown(value)})", f"it must be {accepted(schema)}")


def field_schema(kind: type[Table], key: str) -> dict[str, Raw]:
    """Return what a key accepts, as JSON Schema with every reference resolved."""
    whole = msgspec.json.schema(kind)["$defs"]
    found: dict[str, Raw] = _resolved(whole[kind.__name__]["properties"][key], whole)
    return found


def _resolved(schema: Raw, definitions: Mapping[str, Raw]) -> Raw:
    if isinstance(schema, list):
        return [_resolved(one, definitions) for one in schema]
    if not isinstance(schema, dict):
        return schema
    if "$ref" in schema:
        found: Raw = definitions[schema["$ref"].rpartition("/")[2]]
        return found
    return {key: _resolved(value, definitions) for key, value in schema.items()}


def choices_of(schema: Mapping[str, Raw]) -> list[str]:
    """Return the words that a schema allows."""
    parts = [schema, *schema.get("anyOf", ())]
    return [str(word) for part in parts for word in part.get("enum", ())]


def example(kind: type[Table], key: str) -> str:
    """Return the kind of value that a key takes, for someone who left it out."""
    return accepted(field_schema(kind, key)) if key in kind.__struct_fields__ else "…"


def accepted(schema: Mapping[str, Raw]) -> str:
    """Return what a schema accepts, in words.

    Examples
    --------
    >>> accepted({"type": "number", "minimum": 0, "maximum": 1})
    'a number from 0 to 1'
    >>> accepted({"type": "array", "minItems": 3, "maxItems": 3, "items": {"type": "number"}})
    '3 numbers'
    """
    if "anyOf" in schema:
        parts = [one for one in schema["anyOf"] if one.get("type") != "null"]
        return " or ".join(accepted(one) for one in parts)
    if "enum" in schema:
        return f"one of {', '.join(map(str, schema['enum']))}"
    kind = schema.get("type")
    if kind == "array":
        return _accepted_list(schema)
    if kind == "object":
        return "a table"
    one = {"number": "a number", "integer": "a whole number", "boolean": "true or false"}
    return one.get(str(kind), "text in quotes") + _bounds(schema)


def _accepted_list(schema: Mapping[str, Raw]) -> str:
    items = schema.get("prefixItems", [schema.get("items")])[0]
    if not schema.get("maxItems"):
        return "three or four rows of numbers"
    low, high = schema["minItems"], schema["maxItems"]
    count = f"{low}" if low == high else f"{low} to {high}"
    what = "whole numbers" if items["type"] == "integer" else "numbers"
    return f"{count} {what}{_bounds(items)}"


def _bounds(schema: Mapping[str, Raw]) -> str:
    low, above = schema.get("minimum"), schema.get("exclusiveMinimum")
    high, below = schema.get("maximum"), schema.get("exclusiveMaximum")
    if low is not None and high is not None:
        return f" from {low} to {high}"
    if above is not None and below is not None:
        return f" between {above} and {below}, both excluded"
    if low is not None:
        return f" of at least {low}"
    return f" above {above}" if above is not None else ""
