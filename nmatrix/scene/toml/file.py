"""Scene files: TOML to one frozen scene, checked while it is read; NumPy is not needed."""

from __future__ import annotations

import codecs
import tomllib
from math import inf
from pathlib import Path
from typing import Any

from nmatrix.errors import IllegalValueError, printable, quoted
from nmatrix.linear.viewport import Viewport
from nmatrix.reading.files import file_bytes
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.scene import Scene
from nmatrix.scene.toml.drawing import camera, material, settings
from nmatrix.scene.toml.lights import read_lights
from nmatrix.scene.toml.objects import named_objects, scene_objects
from nmatrix.scene.toml.records import SceneRecord
from nmatrix.scene.toml.table import SceneTable, shown, suggestion

LARGEST = 4_000_000  # bytes
_SPELLED = ("inf", "nan")


def read_scene(path: Path, *, allow_outside: bool = False) -> Scene:
    """Read a scene file; meshes and images that it names lie in its folder.

    Raises
    ------
    IllegalValueError
        In one line that names the file, the key, the value and what would be accepted.
    """
    raw = _raw(path)
    whole = SceneTable(path, raw=raw, allow_outside=allow_outside)
    _check_tables(whole)
    drawing = settings(whole.part("[render]", raw.get("render", {})))
    picture = Viewport(*map(float, drawing.size))
    materials = {
        name: material(whole.part(f"[materials.{printable(name)}]", table), name)
        for name, table in raw.get("materials", {}).items()
    }
    named = named_objects(_tables(whole, "object"))
    objects, nodes = scene_objects(named, materials)
    if not objects:
        raise IllegalValueError(f"{path}", "it draws nothing", 'add shape = "sphere" to an object')
    lights = read_lights(_tables(whole, "light"), [one.name for one in objects])
    view, lens = View(), Lens(aspect=float(picture.aspect))
    if "camera" in raw:
        view, lens = camera(whole.part("[camera]", raw["camera"]), picture)
    return Scene(
        objects=objects,
        lights=lights,
        view=view,
        lens=lens,
        settings=drawing,
        has_camera="camera" in raw,
        has_aspect="aspect" in raw.get("camera", {}),
        path=path,
        nodes=nodes,
    )


def _raw(path: Path) -> dict[str, Any]:
    """Return the file's tables, as TOML has them."""
    text = _text(path)
    try:
        return tomllib.loads(text, parse_float=lambda number: _float(path, number))
    except IllegalValueError:
        raise
    except (ValueError, RecursionError) as error:
        reason = "it is nested too deeply" if isinstance(error, RecursionError) else str(error)
        raise IllegalValueError(
            f"{path}", f"it is not TOML: {' '.join(reason.split())[:200]}", "mend that line"
        ) from None


def _text(path: Path) -> str:
    content = file_bytes(path)
    if len(content) > LARGEST:
        raise IllegalValueError(f"{path}", f"it is larger than {LARGEST} bytes", "cut it down")
    if not content.strip():
        raise IllegalValueError(f"{path}", "it is empty", 'begin with [[object]] shape = "sphere"')
    try:
        return content.removeprefix(codecs.BOM_UTF8).decode()
    except UnicodeDecodeError:
        raise IllegalValueError(
            f"{path}", "it is not UTF-8 text", "save it as UTF-8 without a byte order mark"
        ) from None


def _float(path: Path, text: str) -> float:
    """Return a number as the nearest float64, if that is neither infinite nor zero by accident."""
    found = float(text)
    digits = text.lower().partition("e")[0]
    vanished = found == 0 and any(digit in digits for digit in "123456789")
    if (abs(found) == inf and not text.endswith(_SPELLED)) or vanished:
        raise IllegalValueError(
            f"{path}: number ({quoted(text)})", "no float64 is near it", "use 5e-324 to 1.7e308"
        )
    return found


def _check_tables(whole: SceneTable) -> None:
    known = SceneRecord.__struct_fields__
    for key, value in whole.raw.items():
        if key not in known:
            raise whole.refused(
                printable(key), "a scene file has no such table", suggestion(key, known)
            )
        is_list = key in ("object", "light")
        if not isinstance(value, list if is_list else dict):
            table = f"[[{key}]]" if is_list else f"[{key}]"
            raise whole.refused(f"{key} ({shown(value)})", f"it is written {table}", "see the docs")
    if not whole.raw.get("object"):
        raise whole.refused(
            "[[object]]", "the scene has none", 'add [[object]] with shape = "sphere"'
        )


def _tables(whole: SceneTable, key: str) -> list[SceneTable]:
    """Return the tables of a list, each with a name by which a message finds it."""
    found = []
    for index, table in enumerate(whole.raw.get(key, [])):
        name = table.get("name") if isinstance(table, dict) else None
        label = f" {shown(name)}" if isinstance(name, str) else ""
        found.append(whole.part(f"[[{key}]] {index + 1}{label}", table))
    return found
