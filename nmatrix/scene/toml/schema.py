"""The JSON Schema of scene files, made from the records that check them, for editors."""

from __future__ import annotations

from typing import Any

import msgspec

from nmatrix.scene.toml.records import SceneRecord

DRAFT = "https://json-schema.org/draft/2020-12/schema"
Schema = Any  # what JSON can say


def schema() -> str:
    """Return the schema as JSON, one key a line.

    Examples
    --------
    >>> "The object whose world matrix stands before its own." in schema()
    True
    """
    found = msgspec.json.schema(SceneRecord)
    whole = {"$schema": DRAFT, "title": "An nmatrix scene", **_as_written(found)}
    return msgspec.json.format(msgspec.json.encode(whole), indent=2).decode() + "\n"


def _as_written(part: Schema) -> Schema:
    """Return the schema of what a file may say: never null, and angles as texts too."""
    if isinstance(part, list):
        return [_as_written(one) for one in part if one != {"type": "null"}]
    if not isinstance(part, dict):
        return part
    kept = {
        key: _as_written(value)
        for key, value in part.items()
        if not (key == "default" and value is None)
    }
    if kept.get("format") == "angle":
        kept["type"] = ["number", "string"]
    alternatives = kept.get("anyOf")
    if alternatives is not None and len(alternatives) == 1:
        kept = {key: value for key, value in kept.items() if key != "anyOf"} | alternatives[0]
    return kept
