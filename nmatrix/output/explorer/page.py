"""The explorer's page: a template, its style and script, and the data of one scene.

The shaders are those that `space -f glsl` prints for a stretched object in this scene, so that
object space has its metric. The script is allowed by its hash alone, and nothing is fetched.
"""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Iterable
from dataclasses import replace
from hashlib import sha256
from importlib.resources import files
from typing import Any

from nmatrix.enums import Handedness, NormalRule, Space
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.linear.decompose import parts
from nmatrix.linear.rational import RationalMatrix, to_floats
from nmatrix.linear.rules import RULES
from nmatrix.report import Number
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import WHITE
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.shaders.sheet import MATERIAL, Request, program_of

SPACES = (Space.WORLD, Space.CAMERA, Space.OBJECT, Space.STATIC, Space.LIGHT)
TESSELLATION = (32, 64)
PLACED = ("eye", "target", "up")  # what places a camera that looks at something
BACKGROUND = (0.93, 0.93, 0.93)
WRONG_RULES = (
    NormalRule.NONE,
    NormalRule.NOT_TRANSPOSED,
    NormalRule.NOT_INVERTED,
    NormalRule.COFACTOR,
)
DOWNWARDS = (0, -1, 0)  # where the sliders stand for a light without a direction
STRETCHED = World(scale=(1, 2, 1))  # calls for everything that a shader may need


def page(setup: Setup) -> bytes:
    """Write the page for a scene.

    Raises
    ------
    NoAnswerError
        If the world matrix is singular and not given by its parts: sliders cannot show it.
    """
    folder = files(__package__)
    script = folder.joinpath("explorer.js").read_text(encoding="utf-8")
    style = folder.joinpath("explorer.css").read_text(encoding="utf-8")
    text = folder.joinpath("page.html").read_text(encoding="utf-8")
    data = json.dumps(page_data(setup), ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    for name, value in (
        ("SCRIPT_HASH", _hash(script)),
        ("STYLE_HASH", _hash(style)),
        ("STYLE", style),
        ("DATA", data.replace("<", "\\u003c")),
        ("SCRIPT", script),
    ):
        text = text.replace(name, value, 1)
    return text.encode()


def page_data(setup: Setup) -> dict[str, Any]:
    """Collect the data that the script works with."""
    maps = setup.maps
    light = maps.light
    return {
        "start": _start(setup),
        "translate": _floats(row[3] for row in maps.world_from_object.exact[:3]),
        "camera_from_world": to_floats(maps.camera_from_world.exact),
        "clip_from_camera": to_floats(maps.clip_from_camera),
        "eye": _floats(maps.eye),
        "up": _floats(maps.up),
        "has_direction": light.direction is not None,
        "light_position": None if light.position is None else _floats(light.position),
        "shaders": _shaders(setup),
        "rules": {rule.value: RULES[rule].title for rule in WRONG_RULES},
        "constants": {
            "light_color": WHITE,
            "ambient_color": MATERIAL.ambient,
            "diffuse_color": MATERIAL.diffuse,
            "specular_color": MATERIAL.specular,
            "shininess": MATERIAL.shininess,
        },
        "background": BACKGROUND,
        "tessellation": TESSELLATION,
        "options": _options(setup),
    }


def _start(setup: Setup) -> dict[str, float | str]:
    """Place the sliders."""
    scale, rotate, shear = _sliders(setup)
    direction = _floats(setup.maps.light.direction or DOWNWARDS)
    start: dict[str, float | str] = {"rule": "none", "space": "world", "shape": "torus"}
    for axis, s, r, d in zip("xyz", scale, rotate, direction, strict=True):
        start |= {f"s{axis}": abs(s), f"m{axis}": int(s < 0), f"r{axis}": r, f"l{axis}": d}
    return start | dict(zip(("hxy", "hxz", "hyz"), shear, strict=True))


def _sliders(setup: Setup) -> tuple[tuple[float, ...], tuple[float, ...], tuple[float, ...]]:
    """Take scale, angles about x, y, z and shear of the world."""
    world = setup.world
    plain = World(world.translate, world.rotate_degrees, None, world.scale, world.shear)
    if world == plain:
        return _floats(world.scale), _floats(world.rotate_degrees), _floats(world.shear)
    taken = parts(world.world_from_object)
    if taken is None:
        raise NoAnswerError(
            "world matrix (determinant 0)",
            "sliders cannot show a singular matrix that is not given by its parts",
            f"give {quantity('scale')} with a 0 in it",
        )
    return _floats(taken.scale), _floats(taken.rotate), _floats(taken.shear)


def _shaders(setup: Setup) -> dict[str, dict[str, Any]]:
    maps = replace(setup, world=STRETCHED).maps
    found = {}
    for space in SPACES:
        request = Request(space)
        shown = program_of(maps, request)
        found[space.value] = {
            "vertex": shown.vertex_shader,
            "fragment": shown.fragment_shader,
            "uniforms": [(one.name, one.kind) for one in shown.uniforms],
        }
    return found


def _options(setup: Setup) -> list[str]:
    """Write the rest of a command that shows the same scene."""
    view, lens, light = setup.view, setup.lens, setup.maps.light
    found = []
    if view.matrix is None and view.angles is None and view.handed is Handedness.RIGHT:
        usual = View()
        given = [one for one in PLACED if getattr(view, one) != getattr(usual, one)]
        found += [f"--{one} {_spaced(getattr(view, one))}" for one in given]
    else:
        found.append(f"--view-matrix {_literal(setup.maps.camera_from_world.exact)}")
    if lens != Lens():
        found.append(f"--projection-matrix {_literal(lens.clip_from_camera)}")
    if light.position is not None:
        found.append(f"--light-position {_spaced(light.position)}")
    return found


def _spaced(values: Iterable[Number]) -> str:
    return " ".join(f"{value:.17g}" for value in _floats(values))


def _literal(A: RationalMatrix) -> str:
    return '"' + "; ".join(" ".join(map(repr, row)) for row in to_floats(A)) + '"'


def _floats(values: Iterable[Number]) -> tuple[float, ...]:
    return tuple(map(float, values))


def _hash(text: str) -> str:
    return f"sha256-{b64encode(sha256(text.encode()).digest()).decode()}"
