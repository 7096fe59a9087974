"""The explorer: one module of its scripts, style and markup, and the data of one scene.

The page and the notebook's widget hold the same text of the module. The shaders are those that
`space -f glsl` prints for this scene, for a body that keeps its shape and for one that does not:
object space has a metric for the second alone. The page allows its style and its script by their
hashes, and nothing is fetched.
"""

from __future__ import annotations

import json
from base64 import b64encode
from collections.abc import Iterable, Iterator
from dataclasses import astuple, replace
from fractions import Fraction
from hashlib import sha256
from importlib.resources import files
from typing import Any

from nmatrix.canvas.theme import PALETTES, Palette
from nmatrix.enums import API_PRESETS, DepthRange, Handedness, NormalRule, Reflection, Space, Theme
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE
from nmatrix.linear.rational import RationalMatrix, rational_matrix, to_floats
from nmatrix.linear.rules import RULES
from nmatrix.linear.viewport import window_from_ndc
from nmatrix.output.explorer.sliders import LARGEST, floats, start
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import AMBIENT, DIFFUSE
from nmatrix.report import Number
from nmatrix.scene.camera import AIM, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import WHITE
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.shaders.sheet import Request, program_of

PARTS = (  # of an explorer; the arithmetic before them is every explorer's
    "meshes",
    "map",
    "sentences",
    "views",
    "marks",
    "places",
    "state",
    "controls",
    "words",
    "hands",
    "page",
)
TESSELLATION = (32, 64)
WINDOW = (512, 512)  # what `trace` uses where no window is given
LENS = {"fov": 60, "aspect": 1, "near": 0.1, "far": 100}  # what an option says that is left out
WRONG_RULES = (
    NormalRule.NONE,
    NormalRule.NOT_TRANSPOSED,
    NormalRule.NOT_INVERTED,
    NormalRule.COFACTOR,
)
SURFACE = {"ambient_color": AMBIENT, "diffuse_color": DIFFUSE}
SCHEMES = {  # when the page takes a theme's colours; the last that holds wins
    Theme.LIGHT: ":root {%s}",
    Theme.DARK: "@media (prefers-color-scheme: dark) {:root {%s}}",
    Theme.PRINT: "@media print {:root:root {%s}}",
}
CHOSEN = ":root[data-theme=%s] {%s}"
# where none was given
OTHER_SPACE = rational_matrix([[2, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
BODIES = {"rigid": World(), "stretched": World(scale=(1, 2, 1))}
DEPTH_IN_WEBGL = {  # the row of z, by what an interface's depth runs from and to
    DepthRange.MINUS_ONE_TO_ONE: (0, 0, 1, 0),
    DepthRange.ZERO_TO_ONE: (0, 0, 2, -1),
    DepthRange.REVERSED: (0, 0, -2, 1),
}


def page(setup: Setup, *, fits: bool = False) -> bytes:
    """Write the page for a scene; the eye comes nearer where the body should fit its view.

    Raises
    ------
    NoAnswerError
        If the world matrix is singular and not given by its parts: sliders cannot show it.
    """
    data = json.dumps(
        page_data(setup, fits=fits), ensure_ascii=False, separators=(",", ":"), allow_nan=False
    )
    text = _text("page.html")
    for name, value in (
        ("COLOURS", colours()),
        ("DATA", data.replace("<", "\\u003c")),
        ("SCRIPT_TEXT", module()),
    ):
        text = text.replace(name, value, 1)
    for name, opens, closes in (
        ("STYLE_HASH", "<style>", "</style>"),
        ("SCRIPT_HASH", '<script type="module">', "</script>"),
    ):
        text = text.replace(name, _hash(text.partition(opens)[2].partition(closes)[0]), 1)
    return text.encode()


def module() -> str:
    """Write the explorer as one ES module, which exports `mount` and a widget's `render`."""
    text = _text("module.js")
    for name, value in (
        ('"MARKUP_TEXT"', _quoted(_text("markup.html"))),
        ('"STYLE_TEXT"', _quoted(_text("explorer.css"))),
        ("ARITHMETIC_TEXT", _text("matrices.js")),
        ("PARTS_TEXT", "\n".join(_text(f"{name}.js") for name in PARTS)),
    ):
        text = text.replace(name, value, 1)
    return text


def _quoted(text: str) -> str:
    return json.dumps(text, ensure_ascii=False).replace("<", "\\u003c")


def _text(name: str) -> str:
    return files(__package__).joinpath(name).read_text(encoding="utf-8")


def colours() -> str:
    """Write the palettes as variables of the style: by the reader's scheme, by choice, on paper."""
    told = {theme: _variables(palette) for theme, palette in PALETTES.items()}
    chosen = [CHOSEN % (theme.value, told[theme]) for theme in (Theme.LIGHT, Theme.DARK)]
    first, second, last = (SCHEMES[theme] % told[theme] for theme in SCHEMES)
    return "\n".join((first, second, *chosen, last, ""))


def _variables(palette: Palette) -> str:
    named = [f"--{name}:{colour}" for name, colour in palette.named.items()]
    return ";".join((*named, f"--heat:{','.join(palette.heat)}"))


def page_data(setup: Setup, *, fits: bool = False) -> dict[str, Any]:
    """Collect the data that the script works with."""
    maps, view = setup.maps, setup.view
    light = maps.light
    looks = view.is_aimed and view.handed is Handedness.RIGHT
    return {
        "start": start(setup),
        "largest": LARGEST,
        "camera_from_world": to_floats(maps.camera_from_world.exact),
        "clip_from_camera": to_floats(maps.clip_from_camera),
        "webgl_from_clip": (
            (1, 0, 0, 0),
            (0, setup.lens.clip.y_sign, 0, 0),
            DEPTH_IN_WEBGL[setup.lens.clip.depth],
            (0, 0, 0, 1),
        ),
        "window_from_ndc": to_floats(window_from_ndc(*WINDOW, setup.lens.clip)),
        "custom_from_world": to_floats(
            _with_custom_space(setup).maps.space_from_world(Space.CUSTOM).exact
        ),
        "eye": floats(maps.eye),
        "target": floats(maps.target),
        "up": floats(maps.up),
        "looks": looks,
        "looks_down": "−z" if setup.lens.clip.forward_z < 0 else "+z",
        "fits": fits,
        "has_direction": light.direction is not None,
        "has_position": light.position is not None,
        "shaders": _shaders(setup),
        "rules": {rule.value: RULES[rule].title for rule in WRONG_RULES},
        "constants": {"light_color": WHITE, **SURFACE},
        "palettes": {
            theme.value: {**palette.named, "heat": palette.heat}
            for theme, palette in PALETTES.items()
        },
        "tessellation": TESSELLATION,
        "letter": _letter(),
        "options": _options(setup, looks=looks),
    }


def _letter() -> dict[str, list[float]]:
    """Write the letter R as WebGL takes it: flat, to six decimals, finer than any screen."""
    mesh = letter_r()
    arrays = {"positions": mesh.positions, "normals": mesh.normals, "triangles": mesh.triangles}
    return {name: array.round(6).ravel().tolist() for name, array in arrays.items()}


def _with_custom_space(setup: Setup) -> Setup:
    return setup if setup.space_matrix else replace(setup, space_matrix=OTHER_SPACE)


def _shaders(setup: Setup) -> dict[str, dict[str, dict[str, Any]]]:
    """Write each space's shaders, for a body that keeps its shape and for one that does not."""
    return {
        space.value: {
            body: _shader(_with_custom_space(replace(setup, world=world)), space)
            for body, world in BODIES.items()
        }
        for space in Space
    }


def _shader(setup: Setup, space: Space) -> dict[str, Any]:
    shown = program_of(setup.maps, Request(space, reflection=Reflection.LAMBERT))
    return {
        "vertex": shown.vertex_shader,
        "fragment": shown.fragment_shader,
        "uniforms": [(one.name, one.kind) for one in shown.uniforms],
    }


def _options(setup: Setup, *, looks: bool) -> dict[str, str]:
    """Write the options that no slider changes; the page itself writes where its eye stands."""
    camera = ""
    if looks:
        usual = View()
        given = [one for one in AIM if getattr(setup.view, one) != getattr(usual, one)]
        camera = " ".join(f"--{one} {_spaced(getattr(setup.view, one))}" for one in given)
    custom = _with_custom_space(setup).maps.space_from_world(Space.CUSTOM)
    return {
        "camera": camera,
        "lens": " ".join(_lens_words(setup.lens)),
        "space": f"--space-matrix {_literal(custom.exact)}",
    }


def _lens_words(lens: Lens) -> Iterator[str]:
    if lens.matrix is None:
        yield from _shape_words(lens)
    else:
        yield f"--projection-matrix {_literal(lens.matrix)}"
    clip = lens.clip
    if clip == DEFAULT_CLIP_SPACE:
        return
    parts = (clip.depth, clip.handed, clip.clip_y, clip.origin)
    for api, preset in API_PRESETS.items():
        if preset == parts:
            yield f"--api {api}"
            return
    yield f"--depth {clip.depth} --clip-y {clip.clip_y} --handed {clip.handed}"


def _shape_words(lens: Lens) -> Iterator[str]:
    """Write the options of a lens that was built; a measured one is its window at near."""
    window = lens.ortho or lens.frustum
    said = {"near": lens.near, "far": lens.far}
    if window is None and lens.measured is None:
        said = {"fov": lens.fov_degrees, "aspect": float(lens.aspect_ratio)} | said
    for option, value in said.items():
        if value != LENS[option]:
            yield f"--{option} {value:.17g}"
    if window is not None:
        yield f"--{'ortho' if lens.ortho else 'frustum'} {_spaced(astuple(window))}"
    elif lens.measured_sides is not None:
        yield f"--frustum {_spaced(side * Fraction(lens.near) for side in lens.measured_sides)}"


def _spaced(values: Iterable[Number]) -> str:
    return " ".join(f"{value:.17g}" for value in floats(values))


def _literal(A: RationalMatrix) -> str:
    return '"' + "; ".join(" ".join(map(repr, row)) for row in to_floats(A)) + '"'


def _hash(text: str) -> str:
    return f"sha256-{b64encode(sha256(text.encode()).digest()).decode()}"
