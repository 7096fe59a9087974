"""Names that people give, read word by word: a space, a matrix, or nothing.

A name counts only if every one of its words is known: `modelMatrix` is one, `boneModelMatrix` is
not. A name that several schools use for different things says nothing: `viewPos` is the eye of one
and a point in camera space of the other, so a uniform of that name is an eye, a local is not.
"""

from __future__ import annotations

import re
from dataclasses import replace
from functools import lru_cache

from nmatrix.linting.tree import Stage, Storage, is_matrix, is_vector
from nmatrix.linting.values import (
    ANYTHING,
    Because,
    Carried,
    Fourth,
    Length,
    Matrix,
    Role,
    Sense,
    ShaderSpace,
    Value,
    Vector,
)

FRAMES = {
    "object": ShaderSpace.OBJECT,
    "obj": ShaderSpace.OBJECT,
    "local": ShaderSpace.OBJECT,
    "model": ShaderSpace.OBJECT,
    "world": ShaderSpace.WORLD,
    "view": ShaderSpace.CAMERA,
    "eye": ShaderSpace.CAMERA,
    "camera": ShaderSpace.CAMERA,
    "cam": ShaderSpace.CAMERA,
    "clip": ShaderSpace.CLIP,
    "hclip": ShaderSpace.CLIP,
    "projection": ShaderSpace.CLIP,
    "tangent": ShaderSpace.TANGENT,
}
_WORD = re.compile(r"[A-Z]+(?=[A-Z][a-z])|[A-Z]?[a-z]+|[A-Z]+|\d+")

_NOISE = frozenset(
    [
        "matrix",
        "mat",
        "mats",
        "mtx",
        "mx",
        "m44",
        "transform",
        "transf",
        "xform",
        "xf",
        "u",
        "g",
        "m",
        "f",
        "gl",
        "the",
        "my",
        "ubo",
        "matrices",
        "transforms",
        "current",
        "curr",
        "cur",
        "global",
        "unity",
        "glstate",
        "drw",
        "czm",
        "osg",
        "ci",
        "4",
        "44",
        "4x4",
        "4f",
        "3",
        "gbl",
        "uniforms",
        "uniform",
        "params",
        "data",
        "per",
        "frame",
        "draw",
        "pc",
        "push",
        "constants",
        "main",
        "c",
        "cb",
        "k",
        "s",
    ]
)
_INVERSE = frozenset({"inverse", "inv", "inverted", "i"})
_TRANSPOSE = frozenset({"transpose", "transposed", "transp", "trans", "t"})
_MODEL = frozenset({"model", "world", "mdl"})
_VIEW = frozenset({"view", "viewing", "modelview"})
_PROJECTION = frozenset({"projection", "proj", "perspective", "persp", "prj"})
_OF_LIGHTS = frozenset({"light", "lights", "shadow", "shadows", "depth", "sun", "spot", "cascade"})
_SPELLED_OUT = {
    "mvp": ("model", "view", "projection"),
    "pvm": ("model", "view", "projection"),
    "wvp": ("world", "view", "projection"),
    "mv": ("model", "view"),
    "vm": ("model", "view"),
    "wv": ("world", "view"),
    "vp": ("view", "projection"),
    "pv": ("view", "projection"),
    "it": ("inverse", "transpose"),
    "ti": ("inverse", "transpose"),
    "invtrans": ("inverse", "transpose"),
    "modelview": ("model", "view"),
    "worldview": ("world", "view"),
    "viewproj": ("view", "projection"),
    "viewprojection": ("view", "projection"),
    "projview": ("view", "projection"),
    "worldviewproj": ("world", "view", "projection"),
    "worldviewprojection": ("world", "view", "projection"),
    "modelviewproj": ("model", "view", "projection"),
    "modelviewprojection": ("model", "view", "projection"),
    "objecttoworld": ("object", "to", "world"),
    "worldtoobject": ("world", "to", "object"),
    "normalmatrix": ("normal", "matrix"),
    "modelmatrix": ("model", "matrix"),
    "viewmatrix": ("view", "matrix"),
    "projectionmatrix": ("projection", "matrix"),
    "lightpos": ("light", "position"),
    "lightdir": ("light", "direction"),
    "lightposition": ("light", "position"),
    "lightdirection": ("light", "direction"),
    "viewpos": ("view", "position"),
    "viewdir": ("view", "direction"),
    "eyepos": ("eye", "position"),
    "eyedir": ("eye", "direction"),
    "campos": ("camera", "position"),
    "camerapos": ("camera", "position"),
    "cameraposition": ("camera", "position"),
    "worldpos": ("world", "position"),
    "worldnormal": ("world", "normal"),
    "worldspace": ("world",),
    "modelspace": ("object",),
    "cameraspace": ("camera",),
    "viewspace": ("camera",),
    "eyespace": ("camera",),
    "tangentspace": ("tangent",),
    "objectspace": ("object",),
    "fragpos": ("fragment", "position"),
    "pos": ("position",),
    "posw": ("position", "world"),
    "normalw": ("normal", "world"),
    "ws": ("world",),
    "os": ("object",),
    "dir": ("direction",),
    "norm": ("normal",),
    "nrm": ("normal",),
    "lig": ("light",),
    "lights": ("light",),
    "cam": ("camera",),
    "tang": ("tangent",),
}
_SINGLE = {"M": "model", "V": "view", "P": "projection", "W": "world", "N": "normal"}
_OF_ONE_LETTER = re.compile(r"(?:u_?)?([MVPN])(?:_?[mM]at(?:rix)?)?")

_POINTS = frozenset({"position", "positions", "vertex", "vert", "point", "p", "location"})
_OF_MESHES = frozenset({"vertex", "vert"})
_NORMALS = frozenset({"normal", "normals", "n"})
_TANGENTS = frozenset({"tangent", "bitangent", "binormal", "tangents"})
_DIRECTIONS = frozenset({"direction", "vector", "vec", "ray"})
_LIGHTS = frozenset({"light", "lamp", "sun", "spotlight", "pointlight"})
_HALVES = frozenset({"half", "halfway"})
_CAMERAS = frozenset({"camera", "cam", "view"})  # last in a name they are a space, first an eye
_EYES = frozenset({"eye", "camera", "viewer", "view", "cam"})
_VECTOR_NOISE = frozenset(
    [
        "u",
        "g",
        "m",
        "a",
        "v",
        "i",
        "in",
        "out",
        "vs",
        "fs",
        "ps",
        "gl",
        "o",
        "my",
        "the",
        "frag",
        "fragment",
        "vtx",
        "input",
        "output",
        "attr",
        "attribute",
        "att",
        "var",
        "vary",
        "current",
        "space",
        "coord",
        "coords",
        "0",
        "3",
        "4",
        "f",
        "unity",
        "local3",
        "uniform",
        "transformed",
        "obj",
        "surface",
        "surf",
        "main",
        "ubo",
        "data",
        "pixel",
        "from",
        "to",
    ]
)


@lru_cache(maxsize=65536)
def words_of(name: str) -> tuple[str, ...]:
    """Cut a name into words, and spell out what is short.

    Examples
    --------
    >>> words_of("u_ModelViewMatrix"), words_of("gWorldInvTranspose"), words_of("lightPos")
    (('u', 'model', 'view', 'matrix'), ('g', 'world', 'inv', 'transpose'), ('light', 'position'))
    """
    found: list[str] = []
    for word in _WORD.findall(name):
        low = word.lower()
        found += _SPELLED_OUT.get(low, (low,))
    return tuple(found)


def matrix_named(path: str) -> Matrix | None:
    """Read the name of a matrix.

    Examples
    --------
    >>> matrix_named("uModelViewMatrix").told, matrix_named("WorldInverseTranspose").told
    ('camera_from_object', 'object_from_worldᵀ')
    >>> matrix_named("boneMatrix") is None
    True
    """
    *owners, name = path.split(".")
    last = re.sub(r"^(?:u|g|m|c|cb|gl)_|^_+", "", name)
    letter = _OF_ONE_LETTER.fullmatch(last)
    if last in _SINGLE or letter is not None:
        words: tuple[str, ...] = (_SINGLE[last if letter is None else letter[1]],)
    else:
        words = words_of(name)
    owned = {word for owner in owners for word in words_of(owner)}
    lit = {"light", "shadow", "sun"} & (set(words) | owned)
    if lit and {"projection", "proj", "space"} & set(words) and "bias" not in words:
        return Matrix(ShaderSpace.LIGHT, because=Because.NAME)
    if owned & (_OF_LIGHTS | {"prev", "previous", "last", "old", "bone", "bones", "probe"}):
        return None
    along = _along(words)
    if along is not None:
        return along
    return _product_named(words)


def _along(words: tuple[str, ...]) -> Matrix | None:
    """Read `A to B`, `A 2 B` and `B from A`."""
    for link, is_forward in (("to", True), ("2", True), ("from", False)):
        if link not in words:
            continue
        place = words.index(link)
        before = [word for word in words[:place] if word not in _NOISE]
        after = [word for word in words[place + 1 :] if word not in _NOISE]
        if len(before) != 1 or len(after) != 1:
            return None
        first, second = FRAMES.get(before[0]), FRAMES.get(after[0])
        if first is None or second is None:
            return None
        source, to = (first, second) if is_forward else (second, first)
        return Matrix(to, source, because=Because.NAME)
    return None


def _product_named(words: tuple[str, ...]) -> Matrix | None:
    left = [word for word in words if word not in _NOISE]
    inverts = [word for word in left if word in _INVERSE]
    transposes = [word for word in left if word in _TRANSPOSE]
    named = {word for word in left if word not in _INVERSE and word not in _TRANSPOSE}
    if not named or len(inverts) > 1:
        return None
    if "i" in inverts and left[0] == "i":  # iMatrix is an integer's or an instance's
        return None
    if named & {"normal", "normals"}:
        return _normal_matrix(named - {"normal", "normals"})
    if named & {"camera", "cam"} and named & (_VIEW | _PROJECTION):
        named -= {"camera", "cam"}
    has = [bool(named & group) for group in (_MODEL, _VIEW, _PROJECTION)]
    if named - _MODEL - _VIEW - _PROJECTION:
        return None
    frames = {
        (True, False, False): (ShaderSpace.WORLD, ShaderSpace.OBJECT),
        (False, True, False): (ShaderSpace.CAMERA, ShaderSpace.WORLD),
        (False, False, True): (ShaderSpace.CLIP, ShaderSpace.CAMERA),
        (True, True, False): (ShaderSpace.CAMERA, ShaderSpace.OBJECT),
        (False, True, True): (ShaderSpace.CLIP, ShaderSpace.WORLD),
        (True, True, True): (ShaderSpace.CLIP, ShaderSpace.OBJECT),
    }.get((has[0], has[1], has[2]))
    if frames is None:
        return None
    found = Matrix(*frames, because=Because.NAME)
    if inverts:
        found = found.inverse
    is_transposed = bool(transposes) and (bool(inverts) or set(transposes) & {"transpose"})
    return found.transposed if is_transposed else found


def _normal_matrix(others: set[str]) -> Matrix | None:
    to: ShaderSpace | None = None
    source: ShaderSpace | None = ShaderSpace.OBJECT
    if others:
        if others <= _MODEL:
            to = ShaderSpace.WORLD if others & {"world"} else None
        elif others <= _VIEW | {
            "eye",
            "camera",
        }:  # that of the view alone, or that which leads there
            to, source = ShaderSpace.CAMERA, ShaderSpace.OBJECT if "modelview" in others else None
        elif others <= _MODEL | _VIEW | {"eye", "camera"}:
            to = ShaderSpace.CAMERA
        else:
            return None
    return Matrix(source, to, is_transposed=True, size=3, because=Because.NAME)


@lru_cache(maxsize=65536)
def vector_named(path: str, type_: str, storage: Storage, stage: Stage) -> Vector:
    """Read the name of a vector.

    Examples
    --------
    >>> vector_named("aNormal", "vec3", Storage.INPUT, Stage.VERTEX).told
    'normal in object space'
    >>> vector_named("viewPos", "vec3", Storage.UNIFORM, Stage.FRAGMENT).told
    'position of the eye'
    >>> vector_named("tint", "vec3", Storage.UNIFORM, Stage.FRAGMENT).kind is None
    True
    """
    size = int(type_[-1]) if type_[-1:].isdigit() else 0
    nothing = Vector(size=size)
    if size < 3:
        return nothing
    *owners, name = path.split(".")
    words = [word for word in words_of(name) if word not in _VECTOR_NOISE]
    owned = {word for owner in owners for word in words_of(owner)} & _LIGHTS
    is_attribute = storage is Storage.INPUT and stage is Stage.VERTEX
    short = name.lstrip("_")
    if short in ("N", "n"):
        words = ["normal"]
    elif short in ("L", "l") and storage is not Storage.UNIFORM:
        words = ["light", "direction"]
    elif short in ("V", "E") and storage is not Storage.UNIFORM:
        words = ["eye", "direction"]
    elif short == "eye" and storage is Storage.UNIFORM:
        words = ["eye", "position"]
    elif short == "light" and storage is not Storage.UNIFORM:
        return nothing
    leads_to = _led_to(name) if storage is not Storage.UNIFORM else None
    if leads_to is not None:
        return Vector(
            Carried.DIRECTION, None, size, role=leads_to, sense=Sense.OUT, because=Because.NAME
        )
    is_seen = words[-1:] == ["eye"] and storage is not Storage.UNIFORM
    if len(words) > 1 and words[0] in _POINTS and (words[-1] in _CAMERAS or is_seen):
        return Vector(Carried.POINT, ShaderSpace.CAMERA, size, because=Because.NAME)
    if len(words) > 1 and words[0] in _HALVES and set(words[1:]) <= _DIRECTIONS:
        return Vector(Carried.DIRECTION, None, size, role=Role.HALFWAY, because=Because.NAME)
    return _vector_of(frozenset(words) | owned, size, storage, is_attribute=is_attribute)


def _vector_of(words: frozenset[str], size: int, storage: Storage, *, is_attribute: bool) -> Vector:
    nothing = Vector(size=size)
    kind = _kind(words)
    role = Role.LIGHT if words & _LIGHTS else None
    others = words - _POINTS - _NORMALS - _TANGENTS - _DIRECTIONS - _LIGHTS
    space = None
    if "world" in others:
        space, others = ShaderSpace.WORLD, others - {"world"}
    elif others & {"object", "local"}:
        space, others = ShaderSpace.OBJECT, others - {"object", "local"}
    elif "tangent" in words and (role is not None or kind is not Carried.TANGENT):
        space = ShaderSpace.TANGENT
    if others & _EYES:
        others -= _EYES
        if role is not None or kind is Carried.NORMAL:
            if space is None:
                space = ShaderSpace.CAMERA
        elif (kind is Carried.POINT and storage is Storage.UNIFORM) or kind is Carried.DIRECTION:
            role = Role.EYE
        else:
            return nothing
    if others or kind is None:
        return nothing
    if role is not None and kind is Carried.NORMAL:
        return nothing
    is_given = storage is Storage.UNIFORM and role in (Role.LIGHT, Role.EYE)
    w = Fourth.ONE if is_attribute and size == 4 and kind is Carried.POINT else None
    length = Length.UNIT if is_attribute and kind is Carried.NORMAL else None
    is_assumed = is_attribute and space is None
    return Vector(
        kind,
        ShaderSpace.OBJECT if is_assumed else space,
        size,
        w,
        role,
        length=length,
        likely=ShaderSpace.WORLD if is_given and space is None else None,
        is_assumed=is_assumed,
        because=Because.NAME,
    )


def _led_to(name: str) -> Role | None:
    """Read `toLight`, `surface_to_eye`: what a direction leads to."""
    words = words_of(name)
    if len(words) < 2 or words[-2] != "to":
        return None
    if words[-1] in _LIGHTS:
        return Role.LIGHT
    return Role.EYE if words[-1] in _EYES else None


def _kind(words: frozenset[str]) -> Carried | None:
    if words & _DIRECTIONS:
        return Carried.DIRECTION
    if words & _NORMALS:
        return None if words & (_POINTS - _OF_MESHES) else Carried.NORMAL
    if words & _TANGENTS:
        return None if words & (_POINTS - _OF_MESHES) else Carried.TANGENT
    return Carried.POINT if words & _POINTS else None


def meaning(path: str, type_: str, storage: Storage, stage: Stage) -> Value:
    """Read a name as what its type lets it be.

    Examples
    --------
    >>> meaning("view", "mat4", Storage.UNIFORM, Stage.VERTEX).told
    'camera_from_world'
    """
    if is_matrix(type_):
        found = matrix_named(path)
        size = int(type_[-1])
        if found is None:
            return Matrix(size=size)
        return Matrix(found.to, found.source, found.is_transposed, size, found.because)
    if is_vector(type_):
        return vector_named(path, type_, storage, stage)
    return ANYTHING


_SPACE_COMMENT = re.compile(
    r"\b(world|eye|camera|view|object|model|local|tangent)[ -]?(?:space|coord\w*)\b", re.IGNORECASE
)
_UNIT = re.compile(r"\bunit[ -]length\b", re.IGNORECASE)
_ANNOTATION = re.compile(r"@space\s+(.*)")
_KINDS = {kind.value: kind for kind in Carried} | {"vector": Carried.DIRECTION}


def annotated(note: str, value: Value, size: int) -> Value:
    """Let a comment beside a declaration say what the name does not: `// @space camera point`.

    A matrix is annotated as `// @space camera from object`.

    Examples
    --------
    >>> annotated("@space camera point", Vector(), 3).told
    'point in camera space'
    >>> annotated("light position in eye coordinates", Vector(Carried.POINT), 3).told
    'point in camera space'
    """
    if _UNIT.search(note) and isinstance(value, Vector):
        value = replace(value, length=Length.UNIT)
    given = _ANNOTATION.search(note)
    if given is None:
        told = {FRAMES[one.lower()] for one in _SPACE_COMMENT.findall(note)}
        if len(told) == 1 and isinstance(value, Vector) and value.because is not Because.ANNOTATION:
            return Vector(
                value.kind,
                told.pop(),
                value.size,
                value.w,
                value.role,
                length=value.length,
                because=Because.COMMENT,
            )
        return value
    words = given[1].lower().split()
    frames = [FRAMES[word] for word in words if word in FRAMES]
    if len(frames) == 2 and "from" in words:
        return Matrix(frames[0], frames[1], size=size or 4, because=Because.ANNOTATION)
    if not frames or not isinstance(value, Vector):
        return value
    kind = next((_KINDS[word] for word in words if word in _KINDS and len(words) > 1), value.kind)
    return Vector(kind, frames[0], value.size, value.w, value.role, because=Because.ANNOTATION)
