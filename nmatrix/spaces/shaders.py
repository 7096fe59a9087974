"""The GLSL of one shading space: a vertex and a fragment shader with only the terms it needs.

n is the unit normal, l the unit vector to the light, v the unit vector to the eye, h the half
vector, all in the shading space. Where the space is not rigid, lengths are taken back to the
world by the metric's factors.
"""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.enums import Reflection, Shading, Space
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.shading_spaces import PROFILES
from nmatrix.spaces.uniforms import Needs, Request, Uniform, needs, uniforms

VERTEX_UNIFORMS = ("clip_from_object", "space_from_object", "normal_matrix")


def shader_pair(maps: ExactMaps, request: Request) -> tuple[str, str]:
    """Write the vertex and the fragment shader as `#version 300 es` text.

    Per vertex (`gouraud`) or per fragment (`phong`), in the space asked for, with just the terms
    that the light and the reflection model call for.
    """
    found, listed = needs(maps, request), uniforms(maps, request)
    at_vertex = request.shading is Shading.GOURAUD
    lighting = _lighting(found, request)
    if at_vertex:
        return _join(_gouraud_vertex(found, request, listed, lighting)), _join(_pass_through())
    return (
        _join(_phong_vertex(found, request, listed)),
        _join(_phong_fragment(found, request, listed, lighting)),
    )


def _header(purpose: str) -> list[str]:
    return ["#version 300 es", "precision highp float;", f"// {purpose}"]


def _declared(listed: Sequence[Uniform], *, vertex: bool) -> list[str]:
    return [f"uniform {u.kind} {u.name};" for u in listed if (u.name in VERTEX_UNIFORMS) is vertex]


def _attributes(space: Space) -> list[str]:
    profile = PROFILES[space]
    baked = "" if profile.vertices_in is Space.OBJECT else " (baked)"
    place = f"{profile.mesh_space}{baked}"
    return [
        f"in vec3 vertex_position;  // {place} space",
        f"in vec3 vertex_normal;    // {place} space, unit length",
    ]


def _moved(found: Needs, request: Request) -> tuple[str, str]:
    """Return the expressions for position and normal in the shading space."""
    position = "vertex_position"
    if found.moves_positions:
        position = "(space_from_object * vec4(vertex_position, 1.0)).xyz"
    normal = "vertex_normal"
    if found.moves_normals:
        normal = "normalize(normal_matrix * vertex_normal)"
    return position, normal


def _phong_vertex(found: Needs, request: Request, listed: Sequence[Uniform]) -> list[str]:
    space = request.space
    position, normal = _moved(found, request)
    outputs = [f"out vec3 normal_{space};"]
    body = [f"    normal_{space} = {normal};"]
    if found.position:
        outputs.append(f"out vec3 position_{space};")
        body.append(f"    position_{space} = {position};")
    return [
        *_header(f"vertex shader, {space} space"),
        *_declared(listed, vertex=True),
        *_attributes(space),
        *outputs,
        "void main() {",
        *body,
        "    gl_Position = clip_from_object * vec4(vertex_position, 1.0);",
        "}",
    ]


def _phong_fragment(
    found: Needs, request: Request, listed: Sequence[Uniform], lighting: list[str]
) -> list[str]:
    space = request.space
    inputs = [f"in vec3 normal_{space};"]
    body = [f"    vec3 n = normalize(normal_{space});  // interpolation shortened it"]
    if found.position:
        inputs.append(f"in vec3 position_{space};")
        body.append(f"    vec3 p = position_{space};")
    return [
        *_header(f"fragment shader, {space} space"),
        *_declared(listed, vertex=False),
        *inputs,
        "out vec4 fragment_color;",
        "void main() {",
        *body,
        *lighting,
        "    fragment_color = vec4(color, 1.0);",
        "}",
    ]


def _gouraud_vertex(
    found: Needs, request: Request, listed: Sequence[Uniform], lighting: list[str]
) -> list[str]:
    position, normal = _moved(found, request)
    body = [f"    vec3 n = {normal};"]
    if found.position:
        body.append(f"    vec3 p = {position};")
    return [
        *_header(f"vertex shader, {request.space} space, lighting per vertex"),
        *_declared(listed, vertex=True),
        *_declared(listed, vertex=False),
        *_attributes(request.space),
        "out vec3 vertex_color;",
        "void main() {",
        *body,
        *lighting,
        "    vertex_color = color;",
        "    gl_Position = clip_from_object * vec4(vertex_position, 1.0);",
        "}",
    ]


def _pass_through() -> list[str]:
    return [
        *_header("fragment shader: the interpolated colour"),
        "in vec3 vertex_color;",
        "out vec4 fragment_color;",
        "void main() {",
        "    fragment_color = vec4(vertex_color, 1.0);",
        "}",
    ]


def _lighting(found: Needs, request: Request) -> list[str]:
    lines = ["    vec3 color = ambient_color;"]
    if found.metric:
        lines.append("    float n_length = length(normal_world_from_space * n);")
    if found.specular:
        lines.append(f"    vec3 v = {_unit('eye - p', found)};")
    sources = []
    if found.directional:
        sources.append("-light_direction")
    if found.point_light:
        sources.append("light_position - p")
    for source in sources:
        lines += ["    {", *_one_light(found, request, source), "    }"]
    return lines


def _unit(vector: str, found: Needs) -> str:
    if not found.metric:
        return f"normalize({vector})"
    return f"({vector}) / length(vector_world_from_space * ({vector}))"


def _one_light(found: Needs, request: Request, source: str) -> list[str]:
    lambert = "dot(n, l) / n_length" if found.metric else "dot(n, l)"
    lines = [
        f"        vec3 l = {_unit(source, found)};",
        f"        float n_dot_l = max({lambert}, 0.0);",
    ]
    if request.reflection is Reflection.TOON:
        lines.append("        n_dot_l = n_dot_l > 0.0 ? ceil(n_dot_l * 3.0) / 3.0 : 0.0;")
    lines.append("        color += light_color * diffuse_color * n_dot_l;")
    if found.specular:
        lines += [
            *_highlight(found, request),
            "        if (n_dot_l > 0.0)",
            "            color += light_color * specular_color * pow(highlight, shininess);",
        ]
    return lines


def _highlight(found: Needs, request: Request) -> list[str]:
    if request.reflection is Reflection.BLINN_PHONG:
        half = _unit("l + v", found)
        cosine = "dot(n, h) / n_length" if found.metric else "dot(n, h)"
        return [
            f"        vec3 h = {half};",
            f"        float highlight = clamp({cosine}, 0.0, 1.0);",
        ]
    if not found.metric:
        return ["        float highlight = clamp(dot(reflect(-l, n), v), 0.0, 1.0);"]
    return [
        "        float r_dot_v = 2.0 * dot(n, l) * dot(n, v) / (n_length * n_length)",
        "            - dot(vector_world_from_space * l, vector_world_from_space * v);",
        "        float highlight = clamp(r_dot_v, 0.0, 1.0);",
    ]


def _join(lines: list[str]) -> str:
    return "\n".join(lines) + "\n"
