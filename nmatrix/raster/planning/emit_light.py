"""The GLSL of one light: the lines that a body's plan has on, and the uniforms that they read."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

from nmatrix.enums import Effect, Reflection
from nmatrix.raster.loaded_scene import PlacedLight
from nmatrix.raster.planning.plan import BodyPlan
from nmatrix.scene.words import LightKind


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


def number(value: float) -> str:
    """Return a number as GLSL reads it.

    Examples
    --------
    >>> number(3)
    '3.0'
    """
    return repr(float(value))
