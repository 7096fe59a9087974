"""The GLSL of a plan: shaders that hold just the terms that one body's plan has on.

n is the unit normal, l the unit vector to a light, v the unit vector to the eye, p the position,
all in the shading space. A light that cannot reach the body has no line.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from nmatrix.enums import Effect, Reflection, Shading
from nmatrix.raster.loaded_scene import PlacedLight
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.scene.words import LightKind

HEADER = ("#version 300 es", "precision highp float;")
TEXTURE_COLOUR = "texture(surface_texture, fragment_uv).rgb"


class Shaders:
    """The two shaders of one body."""

    def __init__(self, plan: Plan, body: BodyPlan) -> None:
        self.settings, self.body, self.on = plan.loaded.settings, body, body.effects
        self.terms = Terms(body)
        self.has_gamma = plan.picture[Effect.GAMMA].on
        self.per_vertex = self.settings.shading is not Shading.PHONG
        self.reads_position = Effect.POSITION in self.on

    def vertex(self) -> str:
        """Return the vertex shader."""
        return _text(self._vertex())

    def fragment(self) -> str:
        """Return the fragment shader."""
        return _text(self._fragment())

    def _vertex(self) -> Iterator[str]:
        yield from (*HEADER, f"// vertex shader, {self.settings.space} space")
        yield from ("in vec3 vertex_position;", "in vec3 vertex_normal;")
        yield from ("uniform mat4 clip_from_object;", "uniform mat3 normal_matrix;")
        if self.reads_position or self._has_fog:
            yield "uniform mat4 space_from_object;"
        if self.per_vertex:
            yield from self._light_uniforms()
        for kind, name in self._varyings():
            yield f"out {kind} {name};"
        if self._reads_uv:
            yield "in vec2 vertex_uv;"
        if Effect.VERTEX_COLOURS in self.on:
            yield "in vec3 vertex_colour;"
        if Effect.NORMAL_MAP in self.on:
            yield from ("in vec4 vertex_tangent;", "uniform mat3 vector_space_from_object;")
        yield from ("void main() {", *self._vertex_body(), "}")

    def _vertex_body(self) -> Iterator[str]:
        carries = Effect.INVERSE_TRANSPOSE in self.on
        matrix = "the inverse transpose" if carries else "A itself: it carries normals here"
        yield f"    vec3 n = normalize(normal_matrix * vertex_normal);  // {matrix}"
        if self.reads_position or self._has_fog:
            yield "    vec3 p = (space_from_object * vec4(vertex_position, 1.0)).xyz;"
        if self.per_vertex:
            yield from self._lighting()
            yield from (f"    vertex_{one} = {one};" for one in self._sums)
        else:
            yield "    fragment_normal = n;"
        if self._fragment_reads_position:
            yield "    fragment_position = p;"
        if self._reads_uv:
            yield "    fragment_uv = vertex_uv;"
        if Effect.VERTEX_COLOURS in self.on:
            yield "    fragment_colour = vertex_colour;"
        if Effect.NORMAL_MAP in self.on:
            yield "    vec3 t = vector_space_from_object * vertex_tangent.xyz;"
            yield "    fragment_tangent = vec4(t, vertex_tangent.w);"
        yield "    gl_Position = clip_from_object * vec4(vertex_position, 1.0);"

    def _fragment(self) -> Iterator[str]:
        yield from (*HEADER, f"// fragment shader, {self.settings.space} space")
        for kind, name in self._varyings():
            yield f"in {kind} {name};"
        if not self.per_vertex:
            yield from self._light_uniforms()
        if Effect.TEXTURE in self.on:
            yield "uniform sampler2D surface_texture;"
        if Effect.NORMAL_MAP in self.on:
            yield "uniform sampler2D normal_map;"
        if self._has_fog:
            yield from ("uniform vec3 fog_color;", "uniform vec2 fog_range;")
            if self.per_vertex:
                yield "uniform vec3 eye;"
        yield from ("out vec4 fragment_color;", "void main() {", *self._fragment_body(), "}")

    def _fragment_body(self) -> Iterator[str]:
        if self._fragment_reads_position:
            yield "    vec3 p = fragment_position;"
        if self.per_vertex:
            yield from (f"    vec3 {one} = vertex_{one};" for one in self._sums)
        else:
            yield from self._normal()
            yield from self._lighting()
        if Effect.TEXTURE in self.on:
            yield f"    matte *= {TEXTURE_COLOUR};"
        if Effect.VERTEX_COLOURS in self.on:
            yield "    matte *= fragment_colour;"
        yield f"    vec3 color = min({' + '.join(self._sums)}, 1.0);"
        if Effect.OUTLINE in self.on:
            width = number(self.body.body.material.outline)
            yield f"    if (abs(dot(n, v)) < {width}) color = vec3(0.0);"
        if self._has_fog:
            yield "    float distance_to_eye = length(eye - p);"
            yield "    float share = (distance_to_eye - fog_range.x) / (fog_range.y - fog_range.x);"
            yield "    color = mix(color, fog_color, clamp(share, 0.0, 1.0));"
        if self.has_gamma:
            yield "    vec3 bright = 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055;"
            yield "    color = mix(12.92 * color, bright, step(0.0031308, color));"
        yield f"    fragment_color = vec4(color, {number(self.body.body.material.opacity)});"

    def _normal(self) -> Iterator[str]:
        yield "    vec3 n = fragment_normal;"
        if Effect.NORMAL_MAP in self.on:
            yield "    vec3 t = normalize(fragment_tangent.xyz - n * dot(n, fragment_tangent.xyz));"
            yield "    vec3 b = cross(n, t) * fragment_tangent.w;"
            yield "    n = mat3(t, b, n) * (texture(normal_map, fragment_uv).xyz * 2.0 - 1.0);"
        if Effect.RENORMALISE in self.on:
            length = "length(normal_world_from_space * n)" if self.terms.has_metric else "length(n)"
            yield f"    n /= {length};"
        if Effect.BACK_FACES in self.on:
            yield "    if (!gl_FrontFacing) n = -n;"

    def _lighting(self) -> Iterator[str]:
        yield from (f"    vec3 {one} = vec3(0.0);" for one in self._sums)
        if Effect.AMBIENT in self.on:
            yield "    matte += ambient_color;"
        if Effect.EYE in self.on:
            yield f"    vec3 v = {self.terms.unit('eye - p')};"
        for i, placed in enumerate(self.body.lights):
            yield from ("    {", *self.terms.light(i, placed), "    }")

    def _light_uniforms(self) -> Iterator[str]:
        if Effect.AMBIENT in self.on:
            yield "uniform vec3 ambient_color;"
        if Effect.DIFFUSE in self.on:
            yield "uniform vec3 diffuse_color;"
        if Effect.SPECULAR in self.on:
            yield from ("uniform vec3 specular_color;", "uniform float shininess;")
        if Effect.EYE in self.on or (self._has_fog and not self.per_vertex):
            yield "uniform vec3 eye;"
        if self.terms.has_metric:
            yield "uniform mat3 vector_world_from_space;"
            yield "uniform mat3 normal_world_from_space;"
        for i, placed in enumerate(self.body.lights):
            yield from self.terms.uniforms(i, placed)

    def _varyings(self) -> Iterator[tuple[str, str]]:
        """Return what the vertex shader hands on."""
        if self.per_vertex:
            yield from (("vec3", f"vertex_{one}") for one in self._sums)
        else:
            yield "vec3", "fragment_normal"
        if self._fragment_reads_position:
            yield "vec3", "fragment_position"
        if self._reads_uv:
            yield "vec2", "fragment_uv"
        if Effect.VERTEX_COLOURS in self.on:
            yield "vec3", "fragment_colour"
        if Effect.NORMAL_MAP in self.on:
            yield "vec4", "fragment_tangent"

    @property
    def _sums(self) -> tuple[str, ...]:
        """The parts of the light: what takes the texture's colour, and the highlights."""
        return ("matte", "gloss") if Effect.SPECULAR in self.on else ("matte",)

    @property
    def _has_fog(self) -> bool:
        return Effect.FOG in self.on

    @property
    def _reads_uv(self) -> bool:
        return Effect.TEXTURE in self.on or Effect.NORMAL_MAP in self.on

    @property
    def _fragment_reads_position(self) -> bool:
        return self._has_fog or (self.reads_position and not self.per_vertex)


@dataclass(frozen=True)
class Terms:
    """Expressions of one body's shaders; lengths by the metric where its plan has that on."""

    body: BodyPlan

    @property
    def on(self) -> frozenset[Effect]:
        """Return the effects that are on."""
        return self.body.effects

    @property
    def has_metric(self) -> bool:
        """Return whether lengths are measured by the metric."""
        return Effect.METRIC in self.on

    def light(self, i: int, placed: PlacedLight) -> Iterator[str]:
        """Return the light of light i, added to the sums."""
        yield f"        // {placed.light.kind} light"
        if placed.position is None:
            yield f"        vec3 l = to_light_{i};"
        else:
            yield f"        vec3 way = light_position_{i} - p;"
            yield f"        float d = {self._length('way')};"
            yield "        vec3 l = way / d;"
        weaker = [*self._weaker(i, placed)]
        if weaker:
            yield from ("        float strength = 1.0;", *weaker)
        times = " * strength" if weaker else ""
        yield "        float n_dot_l = dot(n, l);"
        if Effect.DIFFUSE in self.on:
            yield f"        matte += light_color_{i} * diffuse_color * ({self._shade()}{times});"
        if Effect.SPECULAR in self.on:
            yield f"        float highlight = clamp({self._highlight()}, 0.0, 1.0);"
            yield "        if (n_dot_l > 0.0)"
            yield f"            gloss += light_color_{i} * specular_color"
            yield f"                * (pow(highlight, shininess){times});"

    def _weaker(self, i: int, placed: PlacedLight) -> Iterator[str]:
        """Return what takes light away: distance, the cone, what stands in the way."""
        if Effect.ATTENUATION in self.on and placed.position is not None and placed.light.fades:
            yield f"        strength /= dot(attenuation_{i}, vec3(1.0, d, d * d));"
            yield f"        strength *= step(d, range_{i});"
        if placed.light.kind is LightKind.SPOT and Effect.SPOT in self.on:
            cosine = f"-dot({self._in_world('l')}, {self._in_world(f'light_axis_{i}')})"
            yield f"        strength *= smoothstep(cone_{i}.y, cone_{i}.x, {cosine});"
        if placed.light.shadows and Effect.SHADOWS in self.on:
            yield f"        vec4 seen = light_from_space_{i} * vec4(p, 1.0);"
            yield "        vec3 at = seen.xyz / seen.w * 0.5 + 0.5;"
            yield f"        float nearest = texture(shadow_map_{i}, at.xy).r;"
            yield f"        strength *= step(at.z - shadow_bias_{i}, nearest);"

    def _shade(self) -> str:
        if Effect.TOON not in self.on:
            return "max(n_dot_l, 0.0)"
        steps = number(self.body.body.material.toon_steps)
        return f"ceil(max(n_dot_l, 0.0) * {steps}) / {steps}"

    def _highlight(self) -> str:
        if self.body.body.material.reflection is Reflection.BLINN_PHONG:
            return f"dot(n, {self.unit('l + v')})"
        return f"2.0 * n_dot_l * dot(n, v) - dot({self._in_world('l')}, {self._in_world('v')})"

    def uniforms(self, i: int, placed: PlacedLight) -> Iterator[str]:
        """Return what light i reads."""
        yield f"uniform vec3 light_color_{i};"
        yield f"uniform vec3 {'to_light' if placed.position is None else 'light_position'}_{i};"
        if placed.position is not None and placed.light.fades and Effect.ATTENUATION in self.on:
            yield from (f"uniform vec3 attenuation_{i};", f"uniform float range_{i};")
        if placed.light.kind is LightKind.SPOT and Effect.SPOT in self.on:
            yield from (f"uniform vec3 light_axis_{i};", f"uniform vec2 cone_{i};")
        if placed.light.shadows and Effect.SHADOWS in self.on:
            yield f"uniform mat4 light_from_space_{i};"
            yield from (f"uniform sampler2D shadow_map_{i};", f"uniform float shadow_bias_{i};")

    def _in_world(self, vector: str) -> str:
        return f"vector_world_from_space * {vector}" if self.has_metric else vector

    def _length(self, vector: str) -> str:
        return f"length({self._in_world(f'({vector})') if self.has_metric else vector})"

    def unit(self, vector: str) -> str:
        """Return a vector at length one."""
        return f"({vector}) / {self._length(vector)}"


def shaders(plan: Plan, body: BodyPlan) -> tuple[str, str]:
    """Return the vertex and the fragment shader of one body, as `#version 300 es` text."""
    found = Shaders(plan, body)
    return found.vertex(), found.fragment()


def number(value: float) -> str:
    """Return a number as GLSL reads it.

    Examples
    --------
    >>> number(3)
    '3.0'
    """
    return repr(float(value))


def _text(lines: Iterator[str]) -> str:
    return "\n".join(lines) + "\n"
