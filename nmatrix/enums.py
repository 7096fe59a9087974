"""The words that nmatrix chooses between; free of NumPy, so that help and completion start fast."""

from __future__ import annotations

from collections.abc import Iterable
from enum import StrEnum
from typing import TypeVar

from nmatrix.errors import IllegalValueError, did_you_mean, printable, quantity

Words = TypeVar("Words", bound=StrEnum)


def chosen(
    words: type[Words], word: object, parameter: str, among: Iterable[Words] | None = None
) -> Words:
    """Turn a word that a caller gave for a parameter into the member of its enum.

    Raises
    ------
    IllegalValueError
        For anything but a member, or one of those `among` which may be chosen; it lists them.

    Examples
    --------
    >>> chosen(Handedness, "left", "handed") is Handedness.LEFT
    True
    """
    try:
        found = words(word) if isinstance(word, str) else None
    except ValueError:
        found = None
    if found is not None and (among is None or found in among):
        return found
    right = tuple(words if among is None else among)
    shown = word if isinstance(word, str) else type(word).__name__
    raise IllegalValueError(
        f"{quantity(parameter)} ({printable(shown[:40])})",
        f"it is one of {', '.join(right)}",
        did_you_mean(str(shown), right, f"try {right[0]}"),
    )


def chosen_words(
    words: type[Words], given: str | Iterable[object], parameter: str
) -> tuple[Words, ...]:
    """Turn words between commas, or one after the other, into members of an enum, each once.

    Raises
    ------
    IllegalValueError
        For another word, or none.

    Examples
    --------
    >>> [one.name for one in chosen_words(Shown, "normals, axes,normals", "show")]
    ['NORMALS', 'AXES']
    """
    if not isinstance(given, Iterable):
        raise IllegalValueError(
            f"{quantity(parameter)} ({printable(repr(given)[:40])})",
            "it is neither text nor words one after the other",
            f"try {quantity(parameter)} {next(iter(words))}",
        )
    found: dict[Words, None] = {}
    for word in given.split(",") if isinstance(given, str) else map(str, given):
        try:
            found[words(word.strip())] = None
        except ValueError:
            raise IllegalValueError(
                f"{quantity(parameter)} ({printable(word.strip()[:40])})",
                f"it takes words with commas between them: {', '.join(words)}",
                did_you_mean(word, words, f"try {quantity(parameter)} {next(iter(words))}"),
            ) from None
    return tuple(found)


class Space(StrEnum):
    """A space to compute lighting in."""

    WORLD = "world"
    CAMERA = "camera"
    OBJECT = "object"
    STATIC = "static"
    LIGHT = "light"
    CUSTOM = "custom"


class Frame(StrEnum):
    """Every frame that a point passes on its way from the mesh to the screen."""

    OBJECT = "object"
    WORLD = "world"
    CAMERA = "camera"
    CLIP = "clip"
    NDC = "ndc"
    WINDOW = "window"
    LIGHT = "light"
    CUSTOM = "custom"
    STATIC = "static"


class DepthRange(StrEnum):
    """Where near and far land in normalised device coordinates."""

    MINUS_ONE_TO_ONE = "minus-one-to-one"
    ZERO_TO_ONE = "zero-to-one"
    REVERSED = "reversed"


class Handedness(StrEnum):
    """Right: the camera looks down −z. Left: down +z."""

    RIGHT = "right"
    LEFT = "left"


class CameraAxes(StrEnum):
    """A camera's own axes: x right and y up, z back (OpenGL), or y down, z ahead (OpenCV)."""

    OPENGL = "opengl"
    OPENCV = "opencv"


class ClipY(StrEnum):
    """Whether y in clip space points up (OpenGL, Direct3D) or down (Vulkan)."""

    UP = "up"
    DOWN = "down"


class Projected(StrEnum):
    """Whether lines of sight meet in the eye, so that depth is divided by distance, or never."""

    PERSPECTIVE = "perspective"
    PARALLEL = "parallel"


class WindowOrigin(StrEnum):
    """The corner that window y counts from: OpenGL's, or that of all other interfaces."""

    LOWER_LEFT = "lower-left"
    UPPER_LEFT = "upper-left"


class Convention(StrEnum):
    """How angles become a world or a view matrix."""

    STANDARD = "standard"
    POLIMI = "polimi"
    POLIMI_ASSIGNMENTS = "polimi-assignments"


class Api(StrEnum):
    """A graphics interface: short for depth range, handedness, clip-y and the window's origin."""

    OPENGL = "opengl"
    VULKAN = "vulkan"
    DIRECT3D = "direct3d"
    METAL = "metal"
    WEBGPU = "webgpu"


_GL, _ZERO_TO_ONE = DepthRange.MINUS_ONE_TO_ONE, DepthRange.ZERO_TO_ONE
_LOWER, _UPPER = WindowOrigin.LOWER_LEFT, WindowOrigin.UPPER_LEFT
API_PRESETS: dict[Api, tuple[DepthRange, Handedness, ClipY, WindowOrigin]] = {
    Api.OPENGL: (_GL, Handedness.RIGHT, ClipY.UP, _LOWER),
    Api.VULKAN: (_ZERO_TO_ONE, Handedness.RIGHT, ClipY.DOWN, _UPPER),
    Api.DIRECT3D: (_ZERO_TO_ONE, Handedness.LEFT, ClipY.UP, _UPPER),
    Api.METAL: (_ZERO_TO_ONE, Handedness.RIGHT, ClipY.UP, _UPPER),
    Api.WEBGPU: (_ZERO_TO_ONE, Handedness.RIGHT, ClipY.UP, _UPPER),
}


class Kind(StrEnum):
    """What kind of map a matrix is, from the most to the least special."""

    IDENTITY = "identity"
    TRANSLATION = "translation"
    ROTATION = "rotation"
    RIGID = "rigid"
    SIMILARITY = "similarity"
    NON_UNIFORM_SCALE = "non-uniform-scale"
    SHEAR = "shear"
    SINGULAR = "singular"


class MatrixKind(StrEnum):
    """What sixteen or nine numbers may be, when nobody says what they are."""

    PROJECTION = "projection"
    ORTHOGRAPHIC = "orthographic"
    RIGID = "rigid"
    AFFINE = "affine"
    SINGULAR = "singular"
    GENERAL = "general"


class NormalStatus(StrEnum):
    """What became of one normal."""

    OK = "ok"
    TWO_SIDED = "two-sided"
    UNDEFINED = "undefined"


class NormalRule(StrEnum):
    """A way to transform normals: the right one first, then those that people write instead."""

    EXACT = "exact"
    INVERSE = "inverse"
    COFACTOR = "cofactor"
    NONE = "none"
    NOT_TRANSPOSED = "not-transposed"
    NOT_INVERTED = "not-inverted"
    TRANSLATED = "translated"
    FOUR_COMPONENT = "four-component-normalise"


# One right method and three to compare with: each is a 3×3 matrix that a program may hold.
NORMAL_METHODS = (NormalRule.EXACT, NormalRule.INVERSE, NormalRule.COFACTOR, NormalRule.NONE)


class Shading(StrEnum):
    """Where lighting is evaluated: per face, per vertex, per fragment."""

    FLAT = "flat"
    GOURAUD = "gouraud"
    PHONG = "phong"


class Reflection(StrEnum):
    """How a surface answers to light."""

    LAMBERT = "lambert"
    PHONG = "phong"
    BLINN_PHONG = "blinn-phong"
    TOON = "toon"


class Layout(StrEnum):
    """The order in which sixteen numbers are written down."""

    ROW_MAJOR = "row-major"
    COLUMN_MAJOR = "column-major"


class Numbers(StrEnum):
    """How a number is written for people: 1/3 and √3/2, or 0.333333 and 0.866025, or both."""

    EXACT = "exact"
    DECIMAL = "decimal"
    BOTH = "both"


class Format(StrEnum):
    """The formats that a report can be written in."""

    TEXT = "text"
    JSON = "json"
    CSV = "csv"
    LATEX = "latex"
    MARKDOWN = "markdown"
    MATHML = "mathml"
    TYPST = "typst"
    GLSL = "glsl"
    JS = "js"
    NUMPY = "numpy"
    SARIF = "sarif"
    GITHUB = "github"
    GRADESCOPE = "gradescope"


# What they list are findings; an answer that found nothing to find fault with has none.
FINDING_FORMATS = (Format.SARIF, Format.GITHUB)
# What only some commands can say something in: findings, and scores.
PARTICULAR_FORMATS = (*FINDING_FORMATS, Format.GRADESCOPE)


class Severity(StrEnum):
    """How much a finding weighs."""

    ERROR = "error"
    WARNING = "warning"
    NOTE = "note"


class ShaderLanguage(StrEnum):
    """A language that shaders are written in."""

    GLSL = "glsl"
    HLSL = "hlsl"


class Flaw(StrEnum):
    """What can be the matter with a node of a file, the worst first."""

    SHEAR = "shear"
    SINGULAR = "singular"
    MIRRORED = "mirrored"
    DEGENERATE = "degenerate"
    NON_UNIFORM_SCALE = "non-uniform-scale"
    UNREADABLE = "unreadable"

    @classmethod
    def _missing_(cls, value: object) -> Flaw | None:
        return cls.NON_UNIFORM_SCALE if value == "non-uniform" else None


class NodeOrder(StrEnum):
    """What the nodes of a file are sorted by: the worst kind or the largest angle comes first."""

    KIND = "kind"
    INDEX = "index"
    PATH = "path"
    MESH = "mesh"
    ANGLE = "angle"


class Effect(StrEnum):
    """Everything that a picture can be made of, each computed only where a scene calls for it."""

    UNLIT = "unlit"
    AMBIENT = "ambient"
    DIFFUSE = "diffuse"
    INVERSE_TRANSPOSE = "inverse-transpose"
    METRIC = "metric"
    SPECULAR = "specular"
    TOON = "toon"
    OUTLINE = "outline"
    POSITION = "position"
    EYE = "eye"
    ATTENUATION = "attenuation"
    SPOT = "spot"
    SHADOWS = "shadows"
    RENORMALISE = "renormalise"
    PERSPECTIVE = "perspective"
    EXACT_WEIGHTS = "exact-weights"
    NEAR_CLIP = "near-clip"
    BACK_FACES = "back-faces"
    TEXTURE = "texture"
    NORMAL_MAP = "normal-map"
    VERTEX_COLOURS = "vertex-colours"
    EMISSION = "emission"
    ALPHA_MASK = "alpha-mask"
    TRANSPARENCY = "transparency"
    FOG = "fog"
    COLOUR = "colour"
    GAMMA = "gamma"
    SAMPLE_SHADING = "sample-shading"
    SUPERSAMPLING = "supersampling"


class LeftOut(StrEnum):
    """How safe it is to leave an effect out: no bit changes, rounding does, or a proved bound."""

    EXACT = "exact"
    ROUNDING = "rounding"
    BOUNDED = "bounded"


class Effort(StrEnum):
    """Whether a picture computes what its scene calls for, or everything that can be on."""

    PLANNED = "planned"
    ALL = "all"


class Level(StrEnum):
    """How exactly normals of arrays are computed, from the most exact to the fastest."""

    EXACT = "exact"
    CERTIFIED = "certified"
    GUARDED = "guarded"


class NormalMatrixKind(StrEnum):
    """A⁻ᵀ itself, or sign(det A)·cofactors, which exist for every A and keep outward sides."""

    INVERSE_TRANSPOSE = "inverse-transpose"
    ORIENTED = "oriented"


class Theme(StrEnum):
    """The colours of a picture: a bright page, a dark slide, grey paper."""

    LIGHT = "light"
    DARK = "dark"
    PRINT = "print"


class Shown(StrEnum):
    """What can be drawn over the picture of a scene or a mesh."""

    NORMALS = "normals"
    TANGENTS = "tangents"
    AXES = "axes"
    LIGHTS = "lights"
    EYE = "eye"
    WIREFRAME = "wireframe"
    BOUNDS = "bounds"


class PixelFormat(StrEnum):
    """The files that hold the pixels of a picture."""

    PNG = "png"
    GIF = "gif"
    WEBP = "webp"
    JPEG = "jpeg"

    @property
    def is_animated(self) -> bool:
        """Whether such a file can hold several pictures, one after the other."""
        return self in (PixelFormat.GIF, PixelFormat.WEBP)


class VectorFormat(StrEnum):
    """The files that hold the lines and letters of a picture."""

    SVG = "svg"
    PDF = "pdf"


class AxisName(StrEnum):
    """The axis systems that have a name; those of one line are one and the same."""

    OPENGL = "opengl"
    GLTF = "gltf"
    THREE = "three.js"
    MAYA = "maya"
    GODOT = "godot"
    BLENDER = "blender"
    USD_Z_UP = "usd-z-up"
    UNITY = "unity"
    DIRECTX = "directx"
    UNREAL = "unreal"
    OPENCV = "opencv"
    ROS = "ros"


class DeterminantBy(StrEnum):
    """The ways to work a determinant out on paper."""

    EXPANSION = "expansion"
    SARRUS = "sarrus"
    ELIMINATION = "elimination"


class InverseBy(StrEnum):
    """The ways to work an inverse out on paper; by blocks it is for affine matrices."""

    ADJUGATE = "adjugate"
    GAUSS = "gauss"
    BLOCKS = "blocks"
