"""The GLSL of a plan: shaders that hold just the terms that one body's plan has on.

n is the unit normal, l the unit vector to a light, v the unit vector to the eye, p the position,
all in the shading space. A light that cannot reach the body has no line.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from nmatrix.enums import Effect, Reflection, Shading
from nmatrix.raster.loaded_scene import PlacedLight
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.scene.words import LightKind

HEADER = ("#version 300 es", "precision highp float;")
# What the vertex shader hands on for an attribute of the table, in the order of declaration.
VARYINGS = {"uv": "vec2", "colour": "vec3", "tangent": "vec4"}


class Shaders:
    """The two shaders of one body."""

    def __init__(self, plan: Plan, body: BodyPlan) -> None:
        of_picture = {effect for effect, one in plan.picture.items() if one.on}
        self.settings, self.body, self.on = plan.loaded.settings, body, body.effects | of_picture
        self.terms = Terms(body)
        self.lines = [RECIPES[one].lines(body.body.material) for one in RECIPES if one in self.on]
        self.per_vertex = self.settings.shading is not Shading.PHONG
        self.reads_position = Effect.POSITION in self.on

    def vertex(self) -> Iterator[str]:
        """Yield the lines of the vertex shader."""
        yield from (*HEADER, f"// vertex shader, {self.settings.space} space")
        yield from ("in vec3 vertex_position;", "in vec3 vertex_normal;")
        yield from ("uniform mat4 clip_from_object;", "uniform mat3 normal_matrix;")
        if self.reads_position or self._has_fog:
            yield "uniform mat4 space_from_object;"
        if self.per_vertex:
            yield from self._light_uniforms()
        for kind, name in self._varyings():
            yield f"out {kind} {name};"
        yield from (f"in {VARYINGS[one]} vertex_{one};" for one in self._attributes)
        if "tangent" in self._attributes:
            yield "uniform mat3 vector_space_from_object;"
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
        for one in self._attributes:
            if one == "tangent":
                yield "    vec3 t = vector_space_from_object * vertex_tangent.xyz;"
            value = "vec4(t, vertex_tangent.w)" if one == "tangent" else f"vertex_{one}"
            yield f"    fragment_{one} = {value};"
        yield "    gl_Position = clip_from_object * vec4(vertex_position, 1.0);"

    def fragment(self) -> Iterator[str]:
        """Yield the lines of the fragment shader."""
        yield from (*HEADER, f"// fragment shader, {self.settings.space} space")
        for kind, name in self._varyings():
            yield f"in {kind} {name};"
        if not self.per_vertex:
            yield from self._light_uniforms()
        yield from (uniform for one in self.lines for uniform in one.uniforms)
        if self._has_fog and self.per_vertex:
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
        yield from (f"    {line}" for one in self.lines for line in one.matte)
        yield f"    vec3 color = min({' + '.join(self._sums)}, 1.0);"
        yield from (f"    {line}" for one in self.lines for line in one.color)
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
        """Yield the types and names of the outputs of the vertex shader."""
        if self.per_vertex:
            yield from (("vec3", f"vertex_{one}") for one in self._sums)
        else:
            yield "vec3", "fragment_normal"
        if self._fragment_reads_position:
            yield "vec3", "fragment_position"
        yield from ((VARYINGS[one], f"fragment_{one}") for one in self._attributes)

    @property
    def _sums(self) -> tuple[str, ...]:
        """The parts of the light: what takes the texture's colour, and the highlights."""
        return ("matte", "gloss") if Effect.SPECULAR in self.on else ("matte",)

    @property
    def _has_fog(self) -> bool:
        return Effect.FOG in self.on

    @property
    def _attributes(self) -> list[str]:
        """The attributes that effects read at fragments, in the order of their declaration."""
        read = {name for one in self.on for name in RECIPES[one].attributes}
        return [one for one in VARYINGS if one in read]

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
        """Return True if lengths are measured by the metric."""
        return Effect.METRIC in self.on

    def light(self, i: int, placed: PlacedLight) -> Iterator[str]:
        """Yield the lines that add the light of light i to the sums."""
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
        """Yield the lines that take light away: distance, the cone, what stands in the way."""
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
        """Yield the declarations of the uniforms of light i."""
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
    vertex, fragment = ("\n".join(lines) + "\n" for lines in (found.vertex(), found.fragment()))
    return vertex, fragment


def number(value: float) -> str:
    """Return a number as GLSL reads it.

    Examples
    --------
    >>> number(3)
    '3.0'
    """
    return repr(float(value))
