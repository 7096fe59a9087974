"""The table of effects, one record for each, and the judges of those that a scene names.

The planner, the renderer's work counter, the GLSL and the report are sums over these records.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from math import cos, e, inf, radians, sqrt

from nmatrix.enums import Effect, Reflection
from nmatrix.raster.loaded_scene import LoadedScene
from nmatrix.raster.planning import judges_by_geometry as geometry
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.recipe import (
    STEADY,
    UNCHANGED,
    Decision,
    Influence,
    Recipe,
    Strength,
    adds_nothing,
    called_for,
    impossible,
    not_asked,
)
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.planning.shading_rate import sample_shading
from nmatrix.raster.shading.space import column
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import BLACK, Texture
from nmatrix.scene.words import LightKind, Pattern, Sides
from nmatrix.shaders import glsl

BASE_VERTEX = 16 + 9 + 6  # to clip space; the normal and its length
BASE_SAMPLE = 3 + 3 * 3  # depth; the normal's three sums
SMALLEST = 1e-150  # what is nearer to 0 has no useful reciprocal
STEEPEST_SRGB = 12.92  # levels for light, near black
BANDS = replace(
    STEADY,
    most=1.0,
    per_length=inf,
    follows_lights=True,
    jumps=True,
    because="bands have edges that lengths would move",
)


def unlit(facts: Facts) -> Decision:
    """Decide on a colour that is shown as it is."""
    if facts.material.unlit is None:
        return not_asked("the material shows what light makes of it")
    return called_for("the material is unlit")


def ambient(facts: Facts) -> Decision:
    """Decide on light from everywhere."""
    if not any(facts.material.ambient):
        return not_asked("the material sends none of it back")
    return called_for("the material sends some of it back")


def diffuse(facts: Facts) -> Decision:
    """Decide on Lambert's cosine."""
    if not any(facts.material.diffuse):
        return not_asked("the material has no diffuse part")
    if not facts.lights:
        return not_asked("no light reaches it")
    return called_for(f"{len(facts.lights)} of {len(facts.loaded.lights)} lamps can reach it")


def lambert(facts: Facts) -> Influence:
    """Bound max(0, cos): its slope is 1 at the most, and the cosine grows with n's length."""
    most = max(facts.material.diffuse)
    return replace(STEADY, most=most, per_radian=most, per_length=most, follows_lights=True)


def specular(facts: Facts) -> Decision:
    """Decide on highlights."""
    if not facts.material.shines:
        return not_asked("the material has no highlight")
    return called_for("the material shines") if facts.lights else not_asked("no light reaches it")


def highlight(facts: Facts) -> Influence:
    """Bound cosˢ: its slope is √(s/e) at the most, and a mirrored ray turns twice as far as n.

    The highlight ends where n·l = 0, and jumps there.
    """
    material = facts.material
    most, is_mirrored = max(material.specular), material.reflection is Reflection.PHONG
    by_length = (4.0 if is_mirrored else 1.0) * material.shininess * most
    return replace(
        STEADY,
        per_radian=most * (2.0 if is_mirrored else 1.0) * sqrt(material.shininess / e),
        per_length=inf if material.shininess < 1 else by_length,
        most=most,
        per_unit=inf if facts.is_lit_at_fragments else 0.0,
        follows_lights=True,
        jumps=True,
        because="a highlight this wide has an infinite slope",
    )


def toon(facts: Facts) -> Decision:
    """Decide on bands."""
    if facts.material.reflection is Reflection.TOON:
        return called_for(f"the material has {facts.material.toon_steps} bands")
    return not_asked("the material is smooth")


def outline(facts: Facts) -> Decision:
    """Decide on the black hull around a body."""
    if not facts.material.outline:
        return not_asked("the material has no outline")
    if facts.material.alpha_cutoff is not None:
        return impossible("the hull of an outline would show through holes")
    if facts.material.is_clear:
        return impossible("the hull of an outline would show through glass")
    if facts.body.linear_map.rank < 3:
        return impossible("a flattened body has no hull")
    if facts.material.sides is Sides.FRONT and not facts.body.mesh.shell.is_closed:
        return impossible("the mesh is open and has no backs: its hull would show there")
    return called_for("the material has an outline")


def attenuation(facts: Facts) -> Decision:
    """Decide on light that fades or ends."""
    fading = [
        one.light.name for one in facts.lights if one.position is not None and one.light.fades
    ]
    if fading:
        return called_for(f"{', '.join(fading)} fades with distance")
    return not_asked("no lamp that reaches it fades or ends")


def weakened(seen: SeenBody, placed: PlacedLight) -> Strength:
    """Bound 1/(c + l·d + q·d²) between the least and the largest distance to the body.

    It falls, by (l + 2q·d)/(…)² a unit; near the lamp it may exceed 1.
    """
    if placed.position is None:
        return UNCHANGED
    least, most = seen.distances(column(placed.position)[:, 0])
    constant, linear, quadratic = placed.light.attenuation
    below = constant + least * (linear + quadratic * least)
    if not below > SMALLEST:
        return Strength()
    jumps = placed.light.range < most
    falls = inf if jumps else (linear + 2 * quadratic * most) / below / below
    return Strength(most=1.0 / below, per_unit=falls)


def spot(facts: Facts) -> Decision:
    """Decide on cones of light."""
    spots = [one.light.name for one in facts.lights if one.light.kind is LightKind.SPOT]
    if not spots:
        return not_asked("no lamp has a cone")
    return called_for(f"{', '.join(spots)} has a cone")


def edge_of_cone(seen: SeenBody, placed: PlacedLight) -> Strength:
    """Bound the smooth step between the cones: 3/2 over their cosines' difference, and 1/d."""
    if placed.light.kind is not LightKind.SPOT or placed.position is None:
        return UNCHANGED
    inner, outer = (cos(radians(angle)) for angle in placed.light.cone_degrees)
    least, _ = seen.distances(column(placed.position)[:, 0])
    across = (inner - outer) * least
    return Strength(most=1.0, per_unit=1.5 / across if across > SMALLEST else inf)


def texture(facts: Facts) -> Decision:
    """Decide on images and patterns."""
    if facts.material.texture is None:
        return not_asked("the material has no texture")
    if facts.body.mesh.uv is None:
        return impossible("the mesh has no texture coordinates")
    return called_for("the material has a texture")


def normal_map(facts: Facts) -> Decision:
    """Decide on normals from an image."""
    if facts.material.normal_map is None:
        return not_asked("the material has no normal map")
    if not facts.is_lit_at_fragments:
        return impossible(f"{facts.loaded.settings.shading} shading has no normals at fragments")
    if facts.body.mesh.tangents is None:
        return impossible("the mesh has no texture coordinates, hence no tangents")
    return called_for("the material has a normal map")


def vertex_colours(facts: Facts) -> Decision:
    """Decide on colours of the vertices."""
    why_not = "the mesh has no colours of its own"
    if not facts.material.vertex_colours:
        return not_asked(why_not)
    if facts.body.mesh.colours is None:
        return impossible(why_not)
    return called_for("the mesh has colours")


def emission(facts: Facts) -> Decision:
    """Decide on light of the surface's own."""
    if not any(facts.material.emission):
        return not_asked("the material sends out no light of its own")
    return called_for("the material sends out light of its own")


def glow(facts: Facts) -> Influence:
    """Bound light that no lamp moves: only its image changes from place to place."""
    found = facts.material.emission_texture
    if found is None:
        return STEADY
    return replace(STEADY, per_unit=inf, brings_colour=not _is_grey(found))


def alpha_mask(facts: Facts) -> Decision:
    """Decide on holes."""
    cutoff = facts.material.alpha_cutoff
    if cutoff is None:
        return not_asked("the material cuts no holes")
    if not (facts.body.texture_has_alpha or facts.body.vertices_have_alpha):
        return adds_nothing("its opacity is the same everywhere")
    return called_for(f"what has an opacity below {cutoff:g} is a hole")


def transparency(facts: Facts) -> Decision:
    """Decide on what lets light through."""
    if not facts.material.is_clear:
        return not_asked("everything is opaque")
    if facts.body.texture_has_alpha or facts.body.vertices_have_alpha:
        return called_for("its opacity differs from place to place")
    return called_for(f"opacity {facts.material.opacity:g}")


def fog(facts: Facts) -> Decision:
    """Decide on fog."""
    fog = facts.loaded.settings.fog
    if fog is None:
        return not_asked("the scene has no fog")
    _, farthest = facts.seen.eye_distances
    if farthest <= fog.start:
        return adds_nothing(f"fog starts at {fog.start:g}, and the body ends at {farthest:.4g}")
    return called_for(f"fog ends at {fog.end:g}")


def thickening(facts: Facts) -> Influence:
    """Bound the share of fog, which grows evenly from its start to its end."""
    fog = facts.loaded.settings.fog
    return STEADY if fog is None else replace(STEADY, per_unit=1.0 / (fog.end - fog.start))


def tinted(loaded: LoadedScene, bodies: Sequence[Facts]) -> Decision:
    """Decide on three channels: one is enough where everything is grey."""
    colours = [loaded.settings.background, *(light.light.color for light in loaded.lights)]
    for one in (facts.material for facts in bodies):
        colours += [one.unlit or BLACK, one.ambient, one.diffuse, one.specular, one.emission]
    if loaded.settings.fog:
        colours.append(loaded.settings.fog.color)
    if any(len(set(colour)) > 1 for colour in colours) or any(one.brings_colour for one in bodies):
        return called_for("something has a colour")
    return not_asked("everything is grey")


def gamma(loaded: LoadedScene, _: Sequence[Facts]) -> Decision:
    """Decide on sRGB levels."""
    if not loaded.settings.gamma:
        return not_asked("levels are linear")
    return called_for("the scene asks for sRGB")


def supersampling(loaded: LoadedScene, _: Sequence[Facts]) -> Decision:
    """Decide on several samples in a pixel."""
    because = f"{loaded.settings.samples} samples in a pixel"
    return called_for(because) if loaded.settings.samples > 1 else not_asked(because)


def _is_grey(texture: Texture | None) -> bool:
    return texture is None or texture.image is Pattern.CHECKER


RECIPES: dict[Effect, Recipe] = {
    Effect.UNLIT: Recipe(
        "a colour that is shown as it is, whatever light falls on it",
        unlit,
        influence=STEADY,
        glsl=glsl.unlit,
    ),
    Effect.AMBIENT: Recipe(
        "light from everywhere",
        ambient,
        influence=STEADY,
        per_sample=1,
        is_shortcut=True,
        glsl=glsl.ambient,
    ),
    Effect.DIFFUSE: Recipe(
        "Lambert's cosine",
        diffuse,
        influence=lambert,
        per_light=3 + 2,
        is_shortcut=True,
        glsl=glsl.diffuse,
    ),
    Effect.INVERSE_TRANSPOSE: Recipe(
        "normals by the inverse transpose, not by the matrix itself",
        geometry.inverse_transpose,
        influence=STEADY,
        is_shortcut=True,
    ),
    Effect.METRIC: Recipe(
        "lengths and angles measured by the metric of a space that is not rigid",
        geometry.metric,
        influence=STEADY,
        per_sample=9,
        per_light=9,
        is_shortcut=True,
        glsl=glsl.metric,
    ),
    Effect.SPECULAR: Recipe(
        "highlights",
        specular,
        settings=("specular", "shininess"),
        influence=highlight,
        needs=(Effect.EYE,),
        per_light=6 + 3 + 2,
        is_shortcut=True,
        glsl=glsl.specular,
    ),
    Effect.TOON: Recipe(
        "bands in place of a smooth shade",
        toon,
        settings=("toon_steps",),
        influence=BANDS,
        per_light=2,
        glsl=glsl.toon,
    ),
    Effect.OUTLINE: Recipe(
        "a black line around the body: its swollen hull, seen from the inside",
        outline,
        settings=("outline",),
        influence=STEADY,
        passes=("outline",),
    ),
    Effect.POSITION: Recipe(
        "the position of each fragment",
        geometry.position,
        influence=STEADY,
        attributes=("position",),
        per_vertex=16,
        per_sample=12,
        is_shortcut=True,
    ),
    Effect.EYE: Recipe(
        "the way to the eye",
        influence=STEADY,
        needs=(Effect.POSITION,),
        per_sample=6,
        is_shortcut=True,
    ),
    Effect.ATTENUATION: Recipe(
        "light that fades with distance and ends at its range",
        attenuation,
        influence=replace(STEADY, strength=weakened),
        needs=(Effect.POSITION,),
        per_light=4,
        is_shortcut=True,
        glsl=glsl.attenuation,
    ),
    Effect.SPOT: Recipe(
        "cones of light",
        spot,
        influence=replace(STEADY, strength=edge_of_cone),
        needs=(Effect.POSITION,),
        per_light=3 + 4,
        glsl=glsl.spot,
    ),
    Effect.SHADOWS: Recipe(
        "light kept off by what stands in its way",
        geometry.shadows,
        influence=replace(
            STEADY,
            per_length=inf,
            per_unit=inf,
            jumps=True,
            because="shadows have edges, and ask how light falls in",
        ),
        passes=("shadow map",),
        needs=(Effect.POSITION,),
        per_light=16 + 6,
        glsl=glsl.shadows,
    ),
    Effect.RENORMALISE: Recipe(
        "normals brought back to length one",
        geometry.renormalise,
        influence=STEADY,
        per_sample=6,
        is_shortcut=True,
        only_at_fragments=True,
        glsl=glsl.RENORMALISE,
    ),
    Effect.PERSPECTIVE: Recipe(
        "interpolation that perspective corrects",
        geometry.perspective,
        influence=STEADY,
        attributes=("1/w",),
        per_sample=5,
        is_shortcut=True,
    ),
    Effect.EXACT_WEIGHTS: Recipe(
        "each corner's weight by itself, for extreme ratios of w",
        geometry.exact_weights,
        influence=STEADY,
        per_sample=12,
        is_shortcut=True,
    ),
    Effect.NEAR_CLIP: Recipe(
        "triangles cut where they pass the near plane",
        geometry.near_clip,
        influence=STEADY,
        is_shortcut=True,
    ),
    Effect.BACK_FACES: Recipe(
        "faces that are seen from behind",
        geometry.back_faces,
        influence=STEADY,
        attributes=("facing",),
        per_sample=3,
        is_shortcut=True,
        glsl=glsl.back_faces,
    ),
    Effect.TEXTURE: Recipe(
        "an image or a pattern on the surface",
        texture,
        settings=("texture",),
        influence=lambda facts: replace(
            STEADY, per_unit=inf, brings_colour=not _is_grey(facts.material.texture)
        ),
        attributes=("uv",),
        per_sample=8 + 18,
        glsl=glsl.texture,
    ),
    Effect.NORMAL_MAP: Recipe(
        "normals from an image",
        normal_map,
        settings=("normal_map",),
        influence=replace(
            STEADY, per_length=inf, per_unit=inf, because="a normal map turns normals"
        ),
        attributes=("uv", "tangent"),
        per_sample=8 + 18 + 6 + 6 + 9 + 6,
        only_at_fragments=True,
        glsl=glsl.normal_map,
    ),
    Effect.VERTEX_COLOURS: Recipe(
        "colours of the vertices",
        vertex_colours,
        settings=("vertex_colours",),
        influence=replace(STEADY, per_unit=inf, brings_colour=True),
        attributes=("colour",),
        per_sample=12,
        glsl=glsl.VERTEX_COLOURS,
    ),
    Effect.EMISSION: Recipe(
        "light that a surface sends out itself",
        emission,
        settings=("emission_texture",),
        influence=glow,
        attributes=("uv",),
        per_sample=8 + 18,
        glsl=glsl.emission,
    ),
    Effect.ALPHA_MASK: Recipe(
        "holes where the opacity is below a cutoff",
        alpha_mask,
        settings=("alpha_cutoff",),
        influence=STEADY,
        attributes=("uv",),
        per_sample=8 + 18,
        glsl=glsl.alpha_mask,
    ),
    Effect.TRANSPARENCY: Recipe(
        "what is behind shows through, sorted at each sample",
        transparency,
        influence=STEADY,
        passes=("layers",),
        per_sample=6,
        glsl=glsl.transparency,
    ),
    Effect.FOG: Recipe(
        "fog that grows with distance",
        fog,
        influence=thickening,
        needs=(Effect.POSITION,),
        per_sample=4 + 3,
        glsl=glsl.fog,
    ),
    Effect.COLOUR: Recipe(
        "three channels and not one", picture_judge=tinted, influence=STEADY, is_shortcut=True
    ),
    Effect.GAMMA: Recipe(
        "sRGB levels",
        picture_judge=gamma,
        influence=replace(STEADY, gain=STEEPEST_SRGB),
        passes=("gamma",),
        glsl=glsl.GAMMA,
    ),
    Effect.SAMPLE_SHADING: Recipe(
        "each sample shaded by itself, and not once a pixel",
        sample_shading,
        influence=STEADY,
        is_shortcut=True,
    ),
    Effect.SUPERSAMPLING: Recipe(
        "several samples in a pixel",
        picture_judge=supersampling,
        influence=STEADY,
        passes=("resolve",),
    ),
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
    return BASE_SAMPLE + sum(of_effect(one, lights) for one in effects)


def of_effect(effect: Effect, lights: int) -> int:
    """Return the multiplications of one effect at one sample under so many lights."""
    recipe = RECIPES[effect]
    return recipe.per_sample + lights * recipe.per_light


def per_vertex(effects: Iterable[Effect]) -> int:
    """Return the multiplications at one vertex."""
    return BASE_VERTEX + sum(RECIPES[one].per_vertex for one in effects)
