"""What the text of a shader says before it is parsed: its language, its stage, its comments."""

from __future__ import annotations

import re
from pathlib import PurePath

from nmatrix.enums import ShaderLanguage
from nmatrix.linting.tree import Stage

STAGES = {
    "vert": Stage.VERTEX,
    "vs": Stage.VERTEX,
    "vsh": Stage.VERTEX,
    "frag": Stage.FRAGMENT,
    "fs": Stage.FRAGMENT,
    "fsh": Stage.FRAGMENT,
    "ps": Stage.FRAGMENT,
    "geom": Stage.BETWEEN,
    "gs": Stage.BETWEEN,
    "tesc": Stage.BETWEEN,
    "tese": Stage.BETWEEN,
    "vertex": Stage.VERTEX,
    "fragment": Stage.FRAGMENT,
    "pixel": Stage.FRAGMENT,
}
HLSL_SUFFIXES = (".hlsl", ".hlsli", ".fx", ".fxh")
_VECTOR = re.compile(r"(?:float|half|fixed|real|double|min16float|d?vec)([234])$")
_MATRIX = re.compile(r"(?:float|half|fixed|real|double|min16float|d?mat)([234])(?:x([234]))?$")
_SCALAR = re.compile(r"(?:float|half|fixed|real|double|min16float|int|uint|bool)$")
COMMENT = re.compile(rb"//([^\n]*)|/\*(.*?)\*/", re.DOTALL)
_VERSION = re.compile(rb"^[ \t]*#[ \t]*version[ \t]+(\d+)(?:[ \t]+(es))?", re.MULTILINE)
_GLSL_ONLY = re.compile(rb"\b(?:void\s+main\s*\(\s*(?:void)?\s*\)|gl_Position|vec[234]|mat[34])\b")
_HLSL_ONLY = re.compile(rb"\b(?:float[234](?:x[34])?|cbuffer|SV_\w+|half[234])\b", re.IGNORECASE)
_SHADER_LAB = re.compile(
    rb"^[ \t]*(?:CG|HLSL)(?:PROGRAM|INCLUDE)\b(.*?)^[ \t]*END(?:CG|HLSL)\b",
    re.MULTILINE | re.DOTALL,
)
_BARE_MACRO = re.compile(
    rb"(?<=[;{}])(?:\s*\n[ \t]*[A-Z][A-Z0-9_]{3,}(?:[ \t]*\([^;{}()]*\))?[ \t]*(?=\r?\n))+"
)
_NOT_LINE_END = re.compile(rb"[^\r\n]")


def programs_alone(content: bytes) -> bytes:
    """Blank out what stands around the programs of a file of Unity's; places stay what they are."""
    blocks = list(_SHADER_LAB.finditer(content))
    if not blocks:
        return content
    found = bytearray(_NOT_LINE_END.sub(b" ", content))
    for block in blocks:
        found[block.start(1) : block.end(1)] = content[block.start(1) : block.end(1)]
    return bytes(found)


def without_bare_macros(content: bytes) -> bytes:
    r"""Blank out lines that are one macro in capitals, which stands for whole declarations.

    Examples
    --------
    >>> without_bare_macros(b"struct A {\n  UNITY_FOG_COORDS(1)\n};")
    b'struct A {\n                     \n};'
    """
    return _BARE_MACRO.sub(lambda one: _NOT_LINE_END.sub(b" ", one[0]), content)


def language_of(file: str, content: bytes) -> ShaderLanguage:
    """Tell GLSL from HLSL.

    Examples
    --------
    >>> language_of("a.vert", b""), language_of("a.fx", b"")
    (<ShaderLanguage.GLSL: 'glsl'>, <ShaderLanguage.HLSL: 'hlsl'>)
    """
    if PurePath(file).suffix.lower() in HLSL_SUFFIXES:
        return ShaderLanguage.HLSL
    if len(_HLSL_ONLY.findall(content)) > len(_GLSL_ONLY.findall(content)):
        return ShaderLanguage.HLSL
    return ShaderLanguage.GLSL


def stage_of(file: str, content: bytes) -> Stage:
    """Tell the stage by the endings of the name, else by what only one stage writes.

    Examples
    --------
    >>> stage_of("a.vert.glsl", b""), stage_of("a.glsl", b"void main() { gl_Position = p; }")
    (<Stage.VERTEX: 'vertex'>, <Stage.VERTEX: 'vertex'>)
    """
    words = re.split(r"[._-]", PurePath(file).name.lower())
    for word in reversed(words[1:]):
        if word in STAGES:
            return STAGES[word]
    if b"EmitVertex" in content or b"gl_TessCoord" in content:
        return Stage.BETWEEN
    if re.search(rb"\bgl_(?:FragColor|FragData|FragCoord|FragDepth)\b|\bdiscard\b", content):
        return Stage.FRAGMENT
    if re.search(rb"\bgl_Position\b|\battribute\b", content):
        return Stage.VERTEX
    for ending, stage in (("vs", Stage.VERTEX), ("fs", Stage.FRAGMENT), ("ps", Stage.FRAGMENT)):
        if PurePath(file).stem.lower().endswith(ending):
            return stage
    return Stage.UNKNOWN


def type_named(name: str) -> str:
    """Spell a type as GLSL does; a matrix of 4 × 3 entries is affine, and counts as `mat4`.

    Examples
    --------
    >>> type_named("float3"), type_named("half4x4"), type_named("mat4x3"), type_named("Light")
    ('vec3', 'mat4', 'mat4', 'Light')
    """
    vector = _VECTOR.match(name)
    if vector:
        return f"vec{vector[1]}"
    matrix = _MATRIX.match(name)
    if matrix:
        return f"mat{max(matrix[1], matrix[2] or matrix[1])}"
    if name in ("matrix", "float4x3"):
        return "mat4"
    return "float" if _SCALAR.match(name) else name


def notes(content: bytes) -> dict[int, tuple[bool, str]]:
    """Collect the comments by their last line, and whether a comment has the line to itself."""
    found: dict[int, tuple[bool, str]] = {}
    line = place = 0
    for one in COMMENT.finditer(content):
        start = content.rfind(b"\n", 0, one.start()) + 1
        alone = not content[start : one.start()].strip()
        line += content.count(b"\n", place, one.end())
        place = one.end()
        found[line] = (alone, (one[1] or one[2] or b"").decode("utf-8", "replace").strip())
    return found


def version_of(content: bytes) -> int:
    """Tell the version of GLSL; without a word it is the first one.

    Examples
    --------
    >>> version_of(b"#version 300 es"), version_of(b"#version 450"), version_of(b"")
    (330, 450, 100)
    """
    found = _VERSION.search(content)
    if found is None:
        return 100
    return 330 if int(found[1]) == 300 else int(found[1])  # ES 3.00 has what 3.30 has
