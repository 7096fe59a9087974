"""The lines of GLSL that effects add to shaders, and the uniforms that these read.

n is the unit normal, l the unit vector to the light, v the unit vector to the eye, p the position,
all in the shading space. Lengths and angles are written as words, `unit_vector` or `vector_length`;
where the space is rigid the generator puts `normalize` or `length` in their place.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

from nmatrix.enums import Effect, Reflection
from nmatrix.report import Matrix, Number, Value, Vector
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import BLACK, DARK, SQUARES, Texture
from nmatrix.scene.words import LightKind, Pattern, Wrap
from nmatrix.shaders.shaded import EDGE, LEAST_COSINE, Shaded

FLOATS = {"mat4": 16, "mat3": 9, "vec4": 4, "vec3": 3, "vec2": 2, "float": 1}
FLOAT_BYTES = 4
SMALLEST = "1e-30"  # far above what a float32 loses, far below the length of a normal
SAFE_UNIT_NORMAL = f"vec3 unit_normal(vec3 n) {{ return n / max(length(n), {SMALLEST}); }}"


@dataclass(frozen=True)
class Uniform:
    """One uniform: its type, name and value, exact where it follows from matrices.

    `element` is its place in an array of uniforms of one name.
    """

    kind: str
    name: str
    value: Number | Vector | Matrix
    element: int | None = None

    @property
    def key(self) -> str:
        """The name by which an interface sets it."""
        return self.name if self.element is None else f"{self.name}[{self.element}]"

    @property
    def bytes(self) -> int:
        """The size as plain floats."""
        return FLOATS[self.kind] * FLOAT_BYTES


@dataclass(frozen=True)
class Sampler:
    """One texture that a shader reads, and what is to be bound: keys of its making."""

    name: str
    bind: Mapping[str, Value]
    kind: str = "highp sampler2D"


@dataclass(frozen=True)
class Glsl:
    """The lines of an effect, each run in the order of the table of effects, at its place.

    Parameters
    ----------
    uniforms, samplers, functions
        What the lines read; what is not read is not declared.
    bump
        Lines that bend the interpolated normal n.
    normal
        Lines that change n afterwards.
    base
        Lines that add to `matte` before any light does.
    arriving
        For each light: lines that change `light`, the light that arrives, or `shade`, its cosine.
    lit
        For each light: lines that add to `matte` and `gloss`.
    of_light
        Lines of one light alone, with `uniforms` of its own.
    matte
        Lines that change the light that takes a texture's colour.
    color
        Lines that change the sum of all.
    last
        Lines that change `fragment_color`.
    """

    uniforms: tuple[Uniform, ...] = ()
    samplers: tuple[Sampler, ...] = ()
    functions: tuple[str, ...] = ()
    bump: tuple[str, ...] = ()
    normal: tuple[str, ...] = ()
    base: tuple[str, ...] = ()
    arriving: tuple[str, ...] = ()
    lit: tuple[str, ...] = ()
    of_light: Callable[[PlacedLight], Glsl] | None = None
    matte: tuple[str, ...] = ()
    color: tuple[str, ...] = ()
    last: tuple[str, ...] = ()


NOTHING = Glsl()


def unlit(shaded: Shaded) -> Glsl:
    """Add a colour that no light changes."""
    color = Uniform("vec3", "unlit_color", shaded.material.unlit or BLACK)
    return Glsl((color,), base=("matte += unlit_color;",))


def ambient(shaded: Shaded) -> Glsl:
    """Add light from everywhere."""
    sent_back = zip(shaded.ambient, shaded.material.ambient, strict=True)
    color = Uniform("vec3", "ambient_color", tuple(light * part for light, part in sent_back))
    return Glsl((color,), base=("matte += ambient_color;",))


def diffuse(shaded: Shaded) -> Glsl:
    """Add Lambert's cosine."""
    color = Uniform("vec3", "diffuse_color", shaded.material.diffuse)
    return Glsl((color,), lit=("matte += light * diffuse_color * shade;",))


def metric(shaded: Shaded) -> Glsl:
    """Measure lengths by the factors of the metric."""
    maps, space = shaded.maps, shaded.space
    length = "length(normal_world_from_space * n)"
    divisor = f"max({length}, {SMALLEST})" if shaded.normals_can_vanish else length
    return Glsl(
        (
            Uniform("mat3", "vector_world_from_space", maps.vector_world_from_space(space)),
            Uniform("mat3", "normal_world_from_space", maps.normal_world_from_space(space)),
        ),
        functions=(
            "float vector_length(vec3 v) { return length(vector_world_from_space * v); }",
            "vec3 unit_vector(vec3 v) { return v / vector_length(v); }",
            "float vector_dot(vec3 a, vec3 b) {\n"
            "    return dot(vector_world_from_space * a, vector_world_from_space * b);\n"
            "}",
            f"vec3 unit_normal(vec3 n) {{ return n / {divisor}; }}",
        ),
    )


def specular(shaded: Shaded) -> Glsl:
    """Add a highlight where light falls on the front at all."""
    material = shaded.material
    sent_back = material.specular if material.shines else (0.0, 0.0, 0.0)
    cosine = "2.0 * n_dot_l * dot(n, v) - vector_dot(l, v)"
    if material.reflection is Reflection.BLINN_PHONG:
        cosine = "dot(n, unit_vector(l + v))"
    shine = "pow(clamp(highlight, 0.0, 1.0), shininess)"
    if not material.shininess:
        shine = "1.0"  # 0⁰ is undefined in GLSL
    return Glsl(
        (
            Uniform("vec3", "specular_color", sent_back),
            Uniform("float", "shininess", float(material.shininess)),
        ),
        lit=(
            f"float highlight = {cosine};",
            f"if (n_dot_l > {EDGE})\n    gloss += light * specular_color * {shine};",
        ),
    )


def toon(shaded: Shaded) -> Glsl:
    """Put bands in place of a smooth shade."""
    steps = Uniform("float", "toon_steps", float(shaded.material.toon_steps))
    return Glsl(
        (steps,), arriving=(f"shade = ceil(max(shade * toon_steps - {EDGE}, 0.0)) / toon_steps;",)
    )


def attenuation(shaded: Shaded) -> Glsl:
    """Let light fade with distance and end at its range."""
    return Glsl(of_light=_fading)


def _fading(placed: PlacedLight) -> Glsl:
    light = placed.light
    if placed.position is None or not light.fades:
        return NOTHING
    ends = light.range < float("inf")
    return Glsl(
        (
            Uniform("vec3", "attenuation", light.attenuation),
            *([Uniform("float", "light_range", float(light.range))] if ends else ()),
        ),
        arriving=(
            "float d = vector_length(light_position - p);",
            "light /= attenuation.x + d * (attenuation.y + attenuation.z * d);",
            *([f"light *= step(d, light_range * {1.0 + EDGE});"] if ends else ()),
        ),
    )


def spot(shaded: Shaded) -> Glsl:
    """Keep light inside of a cone: all inside the inner one, none outside the outer one."""
    return Glsl(of_light=_cone)


def _cone(placed: PlacedLight) -> Glsl:
    if placed.light.kind is not LightKind.SPOT:
        return NOTHING
    return Glsl(
        (Uniform("vec2", "cone_cosines", placed.light.cone_cosines),),
        arriving=(
            "float inside = -vector_dot(l, light_direction) - cone_cosines.y;",
            "inside = clamp(inside / max(cone_cosines.x - cone_cosines.y, 1e-9), 0.0, 1.0);",
            "light *= inside * inside * (3.0 - 2.0 * inside);",
        ),
    )


SHARE_OF_LIGHT = """\
float share_of_light(highp sampler2DArray map, int layer, vec4 seen, float slack) {
    if (seen.w <= 0.0 || max(abs(seen.x), abs(seen.y)) >= seen.w) return 1.0;
    ivec2 size = textureSize(map, 0).xy;
    vec2 place = (vec2(seen.x, -seen.y) / seen.w + 1.0) * 0.5 * vec2(size) + 0.5;
    vec2 part = fract(place);
    ivec2 high = min(ivec2(place), size - 1), low = max(ivec2(place) - 1, 0);
    vec4 distances = vec4(
        texelFetch(map, ivec3(low, layer), 0).r,
        texelFetch(map, ivec3(high.x, low.y, layer), 0).r,
        texelFetch(map, ivec3(low.x, high.y, layer), 0).r,
        texelFetch(map, ivec3(high, layer), 0).r);
    vec4 lit = step(seen.z - slack * seen.w, distances);
    return mix(mix(lit.x, lit.y, part.x), mix(lit.z, lit.w, part.x), part.y);
}"""


def shadows(shaded: Shaded) -> Glsl:
    """Keep light off where a lamp's maps end before the point, by the share of the four texels."""
    return Glsl(
        (Uniform("float", "shadow_rise", shaded.sagitta),),
        functions=(SHARE_OF_LIGHT,),
        of_light=lambda placed: _shadow(placed, shaded),
    )


def _shadow(placed: PlacedLight, shaded: Shaded) -> Glsl:
    views = shaded.shadows.get(placed.light.name)
    if not views:
        return NOTHING
    bind: dict[str, Value] = {
        "shadow_map": placed.light.name,
        "holds": "distances along the light's axis, infinite where it sees nothing",
        "format": "R32F",
        "layers": len(views),
        "rows": "the first row first",
        "filter": "nearest",
        "light_from_world": [view.light_from_world for view in views],
    }
    share = (
        "share_of_light(shadow_map, k, shadow_from_space[k] * vec4(asked, 1.0),\n"
        f"    shadow_slack[k] / max(n_dot_l, {LEAST_COSINE}))"
    )
    return Glsl(
        (
            *(
                Uniform("mat4", "shadow_from_space", shaded.from_space(view.light_from_world), k)
                for k, view in enumerate(views)
            ),
            *(Uniform("float", "shadow_slack", view.slack, k) for k, view in enumerate(views)),
        ),
        (Sampler("shadow_map", bind, "highp sampler2DArray"),),
        arriving=(
            f"vec3 asked = {_raised(shaded)};",
            "float share = 1.0;",
            f"for (int k = 0; k < {len(views)}; k++)\n    share = min(share, {share});",
            "light *= share;",
        ),
    )


def _raised(shaded: Shaded) -> str:
    """Return the place on the round surface that normals feign, above the triangles."""
    if not shaded.sagitta:
        return "p"
    if Effect.METRIC not in shaded.effects:
        return "p + shadow_rise * n"
    return "p + shadow_rise * (transpose(normal_world_from_space) * (normal_world_from_space * n))"


RENORMALISE = Glsl(normal=("n = unit_normal(n);  // interpolation shortened it",))


def back_faces(shaded: Shaded) -> Glsl:
    """Turn normals to the side that is seen."""
    return Glsl(normal=("if (!gl_FrontFacing) n = -n;",)) if shaded.is_sided else NOTHING


def fog(shaded: Shaded) -> Glsl:
    """Mix colours with the fog's, by distance."""
    fog = shaded.fog
    if fog is None:
        return NOTHING
    return Glsl(
        (
            Uniform("vec3", "fog_color", fog.color),
            Uniform("vec2", "fog_range", (fog.start, fog.end)),
        ),
        color=(
            "float share = (vector_length(eye - p) - fog_range.x) / (fog_range.y - fog_range.x);",
            "color = mix(color, fog_color, clamp(share, 0.0, 1.0));",
        ),
    )


def texture(shaded: Shaded) -> Glsl:
    """Multiply by an image or by a pattern of squares."""
    found = shaded.material.texture
    if found is None:
        return NOTHING
    uv, uniforms = _placed("surface_texture", found)
    if isinstance(found.image, Pattern):
        column, row = (
            CHECKER_WRAPS[how].format(index=f"floor(square.{axis})", size=SQUARES)
            for axis, how in zip("xy", found.wrap, strict=True)
        )
        lines = (f"matte *= mod({column} + {row}, 2.0) < 0.5 ? 1.0 : {DARK};",)
        return Glsl(uniforms, matte=(f"vec2 square = {uv} * {SQUARES}.0 + {EDGE};", *lines))
    return Glsl(
        uniforms,
        (_image("surface_texture", found, is_srgb=shaded.is_linear),),
        matte=(f"matte *= texture(surface_texture, {uv}).rgb;",),
    )


WRAPS = {Wrap.REPEAT: "REPEAT", Wrap.CLAMP: "CLAMP_TO_EDGE", Wrap.MIRROR: "MIRRORED_REPEAT"}
CHECKER_WRAPS = {
    Wrap.REPEAT: "{index}",
    Wrap.CLAMP: "clamp({index}, 0.0, {size}.0 - 1.0)",
    Wrap.MIRROR: "({size}.0 - 0.5 - abs(mod({index}, 2.0 * {size}.0) - {size}.0 + 0.5))",
}


def _placed(name: str, found: Texture) -> tuple[str, tuple[Uniform, ...]]:
    """Return where a fragment falls on an image, and the uniform that this takes."""
    rows = found.uv_map
    if rows == ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)):
        return "fragment_uv", ()
    moved = Uniform("mat3", f"{name}_uv", (*rows, (0.0, 0.0, 1.0)))
    return f"({moved.name} * vec3(fragment_uv, 1.0)).xy", (moved,)


def _image(name: str, found: Texture, *, is_srgb: bool) -> Sampler:
    """Say what image to bind; sRGB levels become linear before the four nearest are mixed."""
    bind: dict[str, Value] = {
        "image": str(found.image),
        "format": "SRGB8_ALPHA8" if is_srgb else "RGBA8",
        "rows": "the last row first",
        "filter": found.filter.value,
        "wrap": [WRAPS[one] for one in found.wrap],
    }
    return Sampler(name, bind)


def normal_map(shaded: Shaded) -> Glsl:
    """Bend normals by an image of them."""
    found = shaded.material.normal_map
    if found is None:
        return NOTHING
    uv, uniforms = _placed("normal_map", found)
    hand = Uniform("float", "bitangent_sign", -1.0 if shaded.is_mirrored else 1.0)
    normal, tangent, bent = "n", "fragment_tangent.xyz", "mat3(t, b, n) * bent"
    if Effect.METRIC in shaded.effects:
        normal, tangent = (
            f"normal_world_from_space * {normal}",
            f"vector_world_from_space * {tangent}",
        )
        bent = f"transpose(vector_world_from_space) * ({bent})"
    return Glsl(
        (hand, *uniforms),
        (_image("normal_map", found, is_srgb=False),),
        bump=(
            f"n = normalize({normal});",
            f"vec3 t = {tangent};",
            "t = normalize(t - n * dot(n, t));",
            "vec3 b = cross(n, t) * (fragment_tangent.w * bitangent_sign);",
            f"vec3 bent = texture(normal_map, {uv}).xyz * 2.0 - 1.0;",
            f"n = {bent};",
        ),
    )


VERTEX_COLOURS = Glsl(matte=("matte *= fragment_colour;",))


def emission(shaded: Shaded) -> Glsl:
    """Add light of the surface's own."""
    material, found = shaded.material, shaded.material.emission_texture
    color = Uniform("vec3", "emission_color", material.emission)
    if found is None:
        return Glsl((color,), matte=("matte += emission_color;",))
    uv, uniforms = _placed("emission_texture", found)
    image = _image("emission_texture", found, is_srgb=shaded.is_linear)
    texel = f"texture(emission_texture, {uv}).rgb"
    return Glsl((color, *uniforms), (image,), matte=(f"matte += emission_color * {texel};",))


def _opacity(shaded: Shaded) -> tuple[str, Uniform]:
    """Find the opacity of a fragment: an expression, and the uniform that it begins with."""
    own = Uniform("float", "opacity", float(shaded.material.opacity))
    factors = [own.name]
    if shaded.texture_has_alpha and shaded.material.texture is not None:
        uv, _ = _placed("surface_texture", shaded.material.texture)
        factors.append(f"texture(surface_texture, {uv}).a")
    if shaded.vertices_have_alpha:
        factors.append("fragment_alpha")
    return " * ".join(factors), own


def alpha_mask(shaded: Shaded) -> Glsl:
    """Leave out fragments whose opacity is below the cutoff."""
    opacity, own = _opacity(shaded)
    cutoff = Uniform("float", "alpha_cutoff", float(shaded.material.alpha_cutoff or 0.0))
    return Glsl((own, cutoff), last=(f"if ({opacity} < alpha_cutoff) discard;",))


def transparency(shaded: Shaded) -> Glsl:
    """Let through what is behind."""
    opacity, own = _opacity(shaded)
    return Glsl((own,), last=(f"fragment_color.a = {opacity};",))


GAMMA = Glsl(
    color=(
        "vec3 bright = 1.055 * pow(color, vec3(1.0 / 2.4)) - 0.055;",
        "color = mix(12.92 * color, bright, step(0.0031308, color));",
    )
)
