"""The JSON of a glTF file, decoded into records, with its faults told in words.

A whole number may be written as 1.0 where an integer is meant: decoders differ in whether they take
it, and exporters write it. Files without such faults are decoded at once; of others each record is
looked at by itself.
"""

from __future__ import annotations

import json
import re
from functools import cache
from math import isfinite
from pathlib import Path
from typing import TypeVar, get_args

import msgspec

from nmatrix.errors import IllegalValueError, printable, quoted
from nmatrix.scene.gltf.records import Asset, Document

Record = TypeVar("Record")

MOST_NAMED = 4  # records that a remark names
_BYTE = re.compile(r"\(byte (\d+)\)")
_EXPECTED = re.compile("expected ('.*') \\(")
_WORD = re.compile(rb"[\w.+-]{1,20}|[^\s]")
_LITERAL = re.compile(rb'[:\[,]\s*([tfn]\w{0,4})[^"\w]{0,4}$')  # true, false or null, misspelled
_BREAKS = (b"\n", b"\r", b"\t")
_FAULTS = {
    "trailing comma": "nothing follows a comma",
    "trailing characters": "the text goes on after its end",
    "invalid number": "a number is not written as JSON writes it",
    "escape": "a backslash within quotes begins no escape of JSON",
}
_CLOSING = (b"}", b"]", b",")
_JSON_WORDS = {
    "int": "an integer",
    "float": "a number",
    "str": "text",
    "bool": "true or false",
    "array": "a list",
    "object": "an object",
    "null": "null",
    "_Boundless": "a number out of range",
}


class _Boundless:
    """A number beyond the largest float64, which nothing in a file may be."""


def read_document(path: Path, text: bytes) -> tuple[Document, tuple[str, ...]]:
    """Decode the JSON of a file, and tell which records of it cannot be read.

    Raises
    ------
    IllegalValueError
        If it is no JSON, no glTF, or of another version than 2.0.
    """
    faults: list[str] = []
    try:
        found = msgspec.json.decode(text, type=Document)
        _look_for_null(found, faults)
    except msgspec.ValidationError as error:
        raw = _raw(text)
        check_version(path, _asset_of(raw))
        if not isinstance(raw, dict):
            raise _no_gltf(path, _in_words(error)) from None
        try:
            found = msgspec.convert(_read_one_by_one(raw, faults), type=Document)
        except msgspec.ValidationError as left:
            raise _no_gltf(path, _in_words(left)) from None
    except UnicodeDecodeError as error:
        raise _no_gltf(path, f"byte {error.start} is not UTF-8") from None
    except msgspec.DecodeError as error:
        raise _no_gltf(path, _place_in(text, str(error))) from None
    except RecursionError:
        raise _no_gltf(path, "it is nested too deeply") from None
    check_version(path, found.asset)
    more = ["…"] * (len(faults) > MOST_NAMED)
    told = f"Records cannot be read: {'; '.join([*faults[:MOST_NAMED], *more])}."
    return found, (told,) if faults else ()


def converted(value: object, kind: type[Record], place: str) -> Record:
    """Make a record of what JSON has at a place, as an extension's.

    Raises
    ------
    IllegalValueError
        With the place, and what is wrong there.

    Examples
    --------
    >>> from nmatrix.scene.gltf.records import PunctualReference
    >>> converted({"light": 2.0}, PunctualReference, "here")
    PunctualReference(light=2)
    >>> try:
    ...     converted({"light": "two"}, PunctualReference, "here")
    ... except IllegalValueError as error:
    ...     print(error)
    here.light: expected an integer, got text; mend the file
    """
    try:
        return msgspec.convert(value, kind)
    except msgspec.ValidationError:
        pass
    try:
        return msgspec.convert(_whole(value), kind)
    except msgspec.ValidationError as error:
        where, _, why = _in_words(error, place).partition(": ")
        raise IllegalValueError(where, why, "mend the file") from None


def _whole(value: object) -> object:
    """Turn whole numbers into integers, however deep they lie."""
    if isinstance(value, dict):
        return {key: _whole(one) for key, one in value.items()}
    if isinstance(value, list):
        return [_whole(one) for one in value]
    return int(value) if isinstance(value, float) and value.is_integer() else value


@cache
def _dispensable() -> dict[str, type[object]]:
    """Find the lists of a document that may miss a record, and what they are made of."""
    found = {}
    for one in msgspec.structs.fields(Document):
        kinds = [kind for inside in get_args(one.type) for kind in get_args(inside)]
        if type(None) in kinds:
            found[one.encode_name] = next(kind for kind in kinds if kind is not type(None))
    return found


def _look_for_null(document: Document, faults: list[str]) -> None:
    for name in _dispensable():
        for i, record in enumerate(getattr(document, name)):
            if record is None:
                faults.append(f"{name}[{i}]: expected an object, got null")


def _read_one_by_one(raw: dict[str, object], faults: list[str]) -> dict[str, object]:
    """Read the lists that may miss a record; what is wrong with one is added to the faults."""
    read = dict(raw)
    for name, kind in _dispensable().items():
        records = _or_fault(raw.get(name, []), list, name, faults) or []
        read[name] = [
            _or_fault(record, kind, f"{name}[{i}]", faults) for i, record in enumerate(records)
        ]
    return read


def _or_fault(value: object, kind: type[Record], place: str, faults: list[str]) -> Record | None:
    try:
        return converted(value, kind, place)
    except IllegalValueError as error:
        faults.append(": ".join(error.parts[:2]))
        return None


def _raw(text: bytes) -> object:
    """Decode JSON of whatever shape, with whole numbers as integers."""

    def number(digits: str) -> float | int | _Boundless:
        found = float(digits)
        if not isfinite(found):
            return _Boundless()
        return int(found) if found.is_integer() else found

    try:
        return json.loads(text, parse_float=number)
    except (ValueError, RecursionError):
        return None


def _asset_of(raw: object) -> Asset:
    """Find the version of what may be another version's document."""
    asset = raw.get("asset") if isinstance(raw, dict) else None
    version = asset.get("version") if isinstance(asset, dict) else None
    if isinstance(version, (str, float, int)):
        return Asset(version=str(version))
    lists = ("nodes", "meshes", "accessors", "buffers")
    by_name = isinstance(raw, dict) and any(isinstance(raw.get(one), dict) for one in lists)
    return Asset(version="1.0" if by_name else "2.0")


def check_version(path: Path, asset: Asset) -> None:
    """Refuse another version than 2.0.

    Raises
    ------
    IllegalValueError
        With the version, and how to go on.
    """
    needed = asset.min_version or asset.version
    if not needed.strip():
        raise _no_gltf(path, "its asset names no version")
    major, _, minor = needed.partition(".")
    if major == "2" and (asset.min_version is None or minor == "0"):
        return
    told = f"it is glTF {printable(needed)}, and glTF 2.0 is read"
    if asset.min_version:
        told = f"it needs glTF {printable(needed)} at least, and glTF 2.0 is read"
    next_step = "convert it, for example by gltf-pipeline" if major == "1" else "export it as 2.0"
    raise IllegalValueError(f"{path}", told, next_step)


def _no_gltf(path: Path, why: str) -> IllegalValueError:
    return IllegalValueError(f"{path}", f"it is not glTF: {why}", "export it again")


def _in_words(error: msgspec.ValidationError, within: str = "") -> str:
    """Tell what is wrong where, of a checker's sentence.

    Examples
    --------
    >>> error = msgspec.ValidationError("Expected `int`, got `str` - at `$.mesh`")
    >>> _in_words(error), _in_words(error, "nodes[2]")
    ('mesh: expected an integer, got text', 'nodes[2].mesh: expected an integer, got text')
    """
    sentence, _, place = str(error).partition(" - at ")
    for name, word in _JSON_WORDS.items():
        sentence = sentence.replace(f"`{name}`", word).replace(f"`{name} | null`", word)
    told = sentence[:1].lower() + sentence[1:].replace("`", "")
    place = f"{within}{place.strip('`').removeprefix('$')}".removeprefix(".")
    return f"{place}: {told}" if place else told


def _place_in(text: bytes, sentence: str) -> str:
    r"""Tell where JSON breaks off or is no JSON: the line, and what is wrong there.

    Examples
    --------
    >>> text = b'{"nodes": [\n{},\n]}'
    >>> _place_in(text, "JSON is malformed: trailing comma in array (byte 16)")
    'line 2: nothing follows a comma'
    """
    at = _BYTE.search(sentence)
    if at is None:
        return "its JSON ends too early" if "truncated" in sentence else sentence
    byte = int(at[1])
    if "trailing comma" in sentence:
        byte = text.rindex(b",", 0, byte)
    character = text[byte : byte + 1]
    word = _LITERAL.search(text[:byte], max(byte - 12, 0)) or _WORD.match(text, byte)
    found = (
        quoted(word[word.lastindex or 0].decode(errors="replace"))
        if word
        else "the end of the text"
    )
    missing = _EXPECTED.search(sentence)
    told = next((why for part, why in _FAULTS.items() if part in sentence), None)
    if missing:
        told = f"{missing[1]} is missing before {found}"
    elif "keys" in sentence:
        told = f"a name in double quotes is meant where {found} stands"
    elif told is None and word and word.lastindex:
        told = f"no value of JSON is {found}"
    elif told is None and character in _BREAKS:
        told = "a line break or a tab stands within quotes"
    elif told is None and character in _CLOSING:
        told = f"a value is missing before {found}"
    told = told or f"no value of JSON has {found} there"
    return f"line {text.count(_BREAKS[0], 0, byte) + 1}: {told}"
