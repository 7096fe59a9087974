"""The schema of scene files says what the reader checks."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path
from typing import Any

import pytest

from nmatrix.scene.toml import records as scene_records
from nmatrix.scene.toml.schema import schema

SCENES = Path(__file__).parents[2] / "docs" / "scenes"
WHOLE = json.loads(schema())
TYPES: dict[str, Any] = {
    "object": dict,
    "array": list,
    "string": str,
    "boolean": bool,
    "integer": int,
    "number": (int, float),
}


def faults(value: Any, part: dict[str, Any], where: str = "$") -> list[str]:
    """Return where a value breaks the part of JSON Schema that ours uses."""
    if "$ref" in part:
        part = WHOLE["$defs"][part["$ref"].rpartition("/")[2]]
    if "anyOf" in part:
        ways = [faults(value, one, where) for one in part["anyOf"]]
        return [] if [] in ways else ways[0]
    if "enum" in part:
        return [] if value in part["enum"] else [f"{where}: {value!r}"]
    kind, *others = part["type"] if isinstance(part["type"], list) else [part["type"]]
    if others and isinstance(value, str):
        kind = "string"  # an angle
    if not isinstance(value, TYPES[kind]) or (kind != "boolean" and isinstance(value, bool)):
        return [f"{where}: {value!r} is no {kind}"]
    if kind == "object":
        return _table_faults(value, part, where)
    if kind == "array":
        few, many = part.get("minItems", 0), part.get("maxItems", len(value))
        found = [] if few <= len(value) <= many else [f"{where}: {len(value)} items"]
        inner = part.get("prefixItems") or [part["items"]] * len(value)
        for i, (item, one) in enumerate(zip(value, inner, strict=False)):
            found += faults(item, one, f"{where}[{i}]")
        return found
    low, high = part.get("minimum", float("-inf")), part.get("maximum", float("inf"))
    return [] if kind in ("string", "boolean") or low <= value <= high else [f"{where}: {value}"]


def _table_faults(value: dict[str, Any], part: dict[str, Any], where: str) -> list[str]:
    known, other = part.get("properties", {}), part.get("additionalProperties")
    found = [f"{where}: {key} is missing" for key in part.get("required", ()) if key not in value]
    for key, item in value.items():
        if key in known:
            found += faults(item, known[key], f"{where}.{key}")
        elif other:
            found += faults(item, other, f"{where}.{key}")
        else:
            found.append(f"{where}: {key} is unknown")
    return found


@pytest.mark.parametrize("path", sorted(SCENES.glob("*.toml")), ids=lambda path: path.stem)
def test_every_example_is_valid(path: Path) -> None:
    assert faults(tomllib.loads(path.read_text(encoding="utf-8")), WHOLE) == []


@pytest.mark.parametrize(
    "text",
    [
        "[[object]]\nscal = 2",
        "[[object]]\nscale = 'x'",
        "[camera]",
        "[[object]]\n[materials.m]\nopacity = 2",
        "[[object]]\n[render]\nsamples = 5",
        "[[object]]\ntranslate = [1, 2]",
    ],
)
def test_what_the_reader_refuses_is_invalid(text: str) -> None:
    assert faults(tomllib.loads(text), WHOLE)


def test_every_key_has_a_description_and_no_null() -> None:
    for name in ("SceneRecord", "ObjectRecord", "LightRecord", "CameraRecord", "MaterialRecord"):
        properties = WHOLE["$defs"][name]["properties"]
        assert set(properties) == set(getattr(scene_records, name).__struct_fields__)
        assert all(one.get("description") for one in properties.values())
    assert '"null"' not in schema()


def test_every_key_stands_in_the_reference() -> None:
    page = (SCENES.parent / "scenes.md").read_text(encoding="utf-8")
    for name in ("ObjectRecord", "LightRecord", "CameraRecord", "MaterialRecord", "RenderRecord"):
        for key in WHOLE["$defs"][name]["properties"]:
            assert f"`{key}`" in page, key
