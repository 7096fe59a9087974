"""The table of effects: what each one reads, which others it needs, and what it multiplies.

Multiplications are counted as mat4·vec4 16, mat3·vec3 9, dot 3, normalise 6, division and square
root 1, for each sample or for each light at each sample.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

from nmatrix.enums import Effect

BASE_VERTEX = 16 + 9 + 6  # to clip space; the normal and its length
BASE_SAMPLE = 3 + 3 * 3  # depth; the normal's three sums


@dataclass(frozen=True)
class Recipe:
    """What an effect is made of."""

    says: str
    attributes: tuple[str, ...] = ()
    uniforms: tuple[str, ...] = ()
    passes: tuple[str, ...] = ()
    needs: tuple[Effect, ...] = ()
    per_vertex: int = 0
    per_sample: int = 0
    per_light: int = 0


RECIPES: dict[Effect, Recipe] = {
    Effect.AMBIENT: Recipe("light from everywhere", uniforms=("ambient_color",), per_sample=1),
    Effect.DIFFUSE: Recipe("Lambert's cosine", uniforms=("diffuse_color",), per_light=3 + 2),
    Effect.INVERSE_TRANSPOSE: Recipe(
        "normals by the inverse transpose, not by the matrix itself", uniforms=("normal_matrix",)
    ),
    Effect.METRIC: Recipe(
        "lengths and angles measured by the metric of a space that is not rigid",
        uniforms=("vector_world_from_space", "normal_world_from_space"),
        per_sample=9,
        per_light=9,
    ),
    Effect.SPECULAR: Recipe(
        "highlights",
        uniforms=("specular_color", "shininess"),
        needs=(Effect.EYE,),
        per_light=6 + 3 + 2,
    ),
    Effect.TOON: Recipe("bands in place of a smooth shade", uniforms=("toon_steps",), per_light=2),
    Effect.OUTLINE: Recipe(
        "a dark line where a surface turns away", needs=(Effect.EYE,), per_sample=3
    ),
    Effect.POSITION: Recipe(
        "the position of each fragment",
        attributes=("position",),
        uniforms=("space_from_object",),
        per_vertex=16,
        per_sample=12,
    ),
    Effect.EYE: Recipe(
        "the way to the eye", uniforms=("eye",), needs=(Effect.POSITION,), per_sample=6
    ),
    Effect.ATTENUATION: Recipe(
        "light that fades with distance and ends at its range",
        uniforms=("attenuation", "range"),
        needs=(Effect.POSITION,),
        per_light=4,
    ),
    Effect.SPOT: Recipe(
        "cones of light",
        uniforms=("light_axis", "cone"),
        needs=(Effect.POSITION,),
        per_light=3 + 4,
    ),
    Effect.SHADOWS: Recipe(
        "light kept off by what stands in its way",
        uniforms=("light_from_space",),
        passes=("shadow map",),
        needs=(Effect.POSITION,),
        per_light=16 + 6,
    ),
    Effect.RENORMALISE: Recipe("normals brought back to length one", per_sample=6),
    Effect.PERSPECTIVE: Recipe(
        "interpolation that perspective corrects", attributes=("1/w",), per_sample=5
    ),
    Effect.EXACT_WEIGHTS: Recipe(
        "each corner's weight by itself, for extreme ratios of w", per_sample=12
    ),
    Effect.NEAR_CLIP: Recipe("triangles cut where they pass the near plane"),
    Effect.BACK_FACES: Recipe(
        "faces that are seen from behind", attributes=("facing",), per_sample=3
    ),
    Effect.TEXTURE: Recipe(
        "an image or a pattern on the surface",
        attributes=("uv",),
        uniforms=("texture",),
        per_sample=8 + 18,
    ),
    Effect.NORMAL_MAP: Recipe(
        "normals from an image",
        attributes=("uv", "tangent"),
        uniforms=("normal_map",),
        per_sample=8 + 18 + 6 + 6 + 9 + 6,
    ),
    Effect.VERTEX_COLOURS: Recipe("colours of the vertices", attributes=("colour",), per_sample=12),
    Effect.TRANSPARENCY: Recipe(
        "what is behind shows through, sorted at each sample", passes=("layers",), per_sample=6
    ),
    Effect.FOG: Recipe(
        "fog that grows with distance",
        uniforms=("fog_color", "fog_range"),
        needs=(Effect.POSITION,),
        per_sample=4 + 3,
    ),
    Effect.COLOUR: Recipe("three channels and not one"),
    Effect.GAMMA: Recipe("sRGB levels", passes=("gamma",)),
    Effect.SUPERSAMPLING: Recipe("several samples in a pixel", passes=("resolve",)),
}


def closure(effects: Iterable[Effect]) -> frozenset[Effect]:
    """Return effects with all that they need.

    Examples
    --------
    >>> sorted(closure([Effect.SPECULAR]))
    [<Effect.EYE: 'eye'>, <Effect.POSITION: 'position'>, <Effect.SPECULAR: 'specular'>]
    """
    found = set(effects)
    queue = list(found)
    for one in queue:  # grows while it is walked
        missing = set(RECIPES[one].needs) - found
        found |= missing
        queue += missing
    return frozenset(found)


def per_sample(effects: Iterable[Effect], lights: int) -> int:
    """Return the multiplications at one sample under so many lights."""
    recipes = [RECIPES[one] for one in effects]
    each = sum(one.per_light for one in recipes)
    return BASE_SAMPLE + sum(one.per_sample for one in recipes) + lights * each


def per_vertex(effects: Iterable[Effect]) -> int:
    """Return the multiplications at one vertex."""
    return BASE_VERTEX + sum(RECIPES[one].per_vertex for one in effects)
