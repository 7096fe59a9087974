"""One decision for each effect on one body: is it called for, why, and how safe is it to leave out.

A decision to leave out is *exact* (no bit changes), *rounding* (≤ 1e-12) or *bounded*: then it is
only proposed, with the most that it can move a channel by, and the plan's budget decides.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import inf, radians, sqrt

from nmatrix.enums import Effect, LampKind, LeftOut, NormalRule, Reflection, Shading
from nmatrix.raster.facts import Facts
from nmatrix.raster.occluders import occluders

ROUNDING = 1e-12
MODEST_RATIO = 256.0  # of w within a triangle: sums then lose 2⁸ · 8u < 1e-12


@dataclass(frozen=True)
class Decision:
    """Whether an effect is on, why, and what leaving it out costs at the most."""

    effect: Effect
    on: bool
    because: str
    kind: LeftOut = LeftOut.EXACT
    bound: float = 0.0


Verdict = tuple[bool, str] | tuple[bool, str, LeftOut, float]


def decide(facts: Facts) -> dict[Effect, Decision]:
    """Return the decision for every effect that belongs to bodies, needs apart."""
    return {effect: Decision(effect, *judge(facts)) for effect, judge in JUDGES.items()}


def _by_bound(bound: float, because: str) -> Verdict:
    """Leave out what moves channels by rounding, and propose what has a bound at all."""
    if bound <= ROUNDING:
        return False, because, LeftOut.ROUNDING, bound
    return (True, because) if bound == inf else (False, because, LeftOut.BOUNDED, bound)


def _ambient(facts: Facts) -> Verdict:
    if not any(facts.body.material.ambient):
        return False, "the material sends none of it back"
    return True, "the material sends some of it back"


def _diffuse(facts: Facts) -> Verdict:
    if not any(facts.body.material.diffuse):
        return False, "the material has no diffuse part"
    if not facts.lamps:
        return False, "no light reaches it"
    return True, f"{len(facts.lamps)} of {len(facts.studio.lamps)} lamps can reach it"


def _inverse_transpose(facts: Facts) -> Verdict:
    if facts.studio.settings.normals is not NormalRule.EXACT:
        return True, f"normals are carried by the rule “{facts.studio.settings.normals}”"
    found = facts.map_to_space
    if found.rank < 3:
        return True, f"the map has rank {found.rank}: only the cofactors are left"
    worst = found.worst_angle_deg or 0.0
    if not worst and _is_power_of_two(facts):
        return False, "the map is a turn times a power of two: it carries normals itself"
    bound = radians(worst) * facts.slope
    if facts.has_jumps and bound > ROUNDING:
        bound = inf
    return _by_bound(bound, f"κ = {found.condition_text}: without it normals bend by {worst:.3g}°")


def _is_power_of_two(facts: Facts) -> bool:
    """Return whether AᵀA = 4ᵏ·I exactly: then A and its cofactors differ by a power of two."""
    linear_map = facts.map_to_space.linear_map
    square = sum(entry * entry for entry in linear_map.entries[0])
    size = square.bit_length() - 1
    return square == 1 << size and size % 2 == 0


def _metric(facts: Facts) -> Verdict:
    if facts.space_is_rigid:
        return False, f"{facts.space} space is rigid", LeftOut.ROUNDING, 0.0
    return True, f"{facts.space} space stretches lengths"


def _specular(facts: Facts) -> Verdict:
    if not facts.body.material.shines:
        return False, "the material has no highlight"
    return (True, "the material shines") if facts.lamps else (False, "no light reaches it")


def _toon(facts: Facts) -> Verdict:
    if facts.body.material.reflection is Reflection.TOON:
        return True, f"the material has {facts.body.material.toon_steps} bands"
    return False, "the material is smooth"


def _outline(facts: Facts) -> Verdict:
    if not facts.body.material.outline:
        return False, "the material has no outline"
    if facts.studio.settings.shading is not Shading.PHONG:
        return False, "an outline is drawn only where normals reach the fragments"
    return True, "the material has an outline"


def _position(facts: Facts) -> Verdict:
    placed = [one for one in facts.lamps if one.position is not None]
    if facts.studio.settings.shading is Shading.PHONG and placed:
        return True, f"{len(placed)} lamps have a place"
    return False, "nothing asks where a fragment is"


def _attenuation(facts: Facts) -> Verdict:
    fading = [one.lamp.name for one in facts.lamps if one.position is not None and one.lamp.fades]
    if fading:
        return True, f"{', '.join(fading)} fades with distance"
    return False, "no lamp that reaches it fades or ends"


def _spot(facts: Facts) -> Verdict:
    spots = [one.lamp.name for one in facts.lamps if one.lamp.kind is LampKind.SPOT]
    return (True, f"{', '.join(spots)} has a cone") if spots else (False, "no lamp has a cone")


def _shadows(facts: Facts) -> Verdict:
    casting = [one for one in facts.lamps if one.lamp.shadows]
    if not casting:
        return False, "no lamp that reaches it casts shadows"
    found = {one.lamp.name: occluders(facts.studio, one, facts.body) for one in casting}
    blocked = {name: bodies for name, bodies in found.items() if bodies}
    if not blocked:
        return False, "nothing stands between it and a lamp"
    name, bodies = next(iter(blocked.items()))
    return True, f"{bodies[0]} can keep {name}'s light off"


def _renormalise(facts: Facts) -> Verdict:
    if facts.studio.settings.shading is not Shading.PHONG:
        return False, "light is not evaluated at fragments"
    if facts.body.material.normal_map is not None:
        return True, "a normal map turns normals"
    material, short = facts.body.material, 1.0 - facts.shortest_normal
    if material.reflection is Reflection.TOON or facts.body.linear_map.rank < 3:
        return True, "bands have edges that lengths would move"
    gain = max(material.diffuse)
    if facts.shines:
        turns = 4.0 if material.reflection is Reflection.PHONG else 1.0
        gain += turns * material.shininess * max(material.specular)
    bound = gain * short * facts.brightness * facts.contrast
    return _by_bound(bound, f"interpolation shortens normals by up to {short:.2g}")


def _perspective(facts: Facts) -> Verdict:
    if facts.is_parallel:
        return False, "the view is parallel: w is 1 everywhere"
    if facts.studio.settings.shading is Shading.FLAT and not facts.reads_places:
        return False, "whole triangles have one colour"
    ratio = facts.w_ratio
    because = f"w changes by a factor of up to {ratio:.3g} within a triangle"
    if ratio == inf:
        return True, "triangles are cut by the view"
    if facts.reads_places or (facts.has_jumps and facts.studio.settings.shading is Shading.PHONG):
        return True, because
    wrong = (sqrt(ratio) - 1.0) / (sqrt(ratio) + 1.0)
    if facts.studio.settings.shading is Shading.GOURAUD:
        return _by_bound(wrong * facts.colour_range, because)
    chord = sqrt(max(0.0, 2.0 - 2.0 * facts.normal_cosine))
    shortest = facts.shortest_normal
    return _by_bound(wrong * chord / shortest * facts.slope if shortest else inf, because)


def _exact_weights(facts: Facts) -> Verdict:
    if facts.is_parallel:
        return False, "the view is parallel: w is 1 everywhere"
    because = f"w changes by a factor of up to {facts.w_ratio:.3g} within a triangle"
    return _by_bound(0.0 if facts.w_ratio <= MODEST_RATIO else inf, because)


def _near_clip(facts: Facts) -> Verdict:
    if facts.is_whole:
        return False, "every vertex lies between near and far"
    return True, "vertices lie outside of the view"


def _back_faces(facts: Facts) -> Verdict:
    if facts.body.material.opacity < 1.0 or facts.body.material.two_sided:
        return True, "the material shows both sides"
    if facts.body.linear_map.rank < 3:
        return False, "a flattened body turns its normals to the eye at its vertices"
    if not facts.body.mesh.is_closed:
        return True, "the mesh is open"
    if not facts.is_whole or not facts.eye_is_outside:
        return True, "the view may look into it"
    return False, "the mesh is closed, and seen from outside"


def _texture(facts: Facts) -> Verdict:
    if facts.body.material.texture is None:
        return False, "the material has no texture"
    if facts.body.mesh.uv is None:
        return False, "the mesh has no texture coordinates"
    return True, "the material has a texture"


def _normal_map(facts: Facts) -> Verdict:
    if facts.body.material.normal_map is None:
        return False, "the material has no normal map"
    if facts.body.mesh.tangents is None or facts.studio.settings.shading is not Shading.PHONG:
        return False, "the mesh has no tangents, or light is not evaluated at fragments"
    return True, "the material has a normal map"


def _vertex_colours(facts: Facts) -> Verdict:
    if facts.body.material.vertex_colours and facts.body.mesh.colours is not None:
        return True, "the mesh has colours"
    return False, "the mesh has no colours of its own"


def _transparency(facts: Facts) -> Verdict:
    opacity = facts.body.material.opacity
    return (True, f"opacity {opacity:g}") if opacity < 1.0 else (False, "everything is opaque")


def _fog(facts: Facts) -> Verdict:
    fog = facts.studio.settings.fog
    return (True, f"fog ends at {fog.end:g}") if fog else (False, "the scene has no fog")


JUDGES: dict[Effect, Callable[[Facts], Verdict]] = {
    Effect.AMBIENT: _ambient,
    Effect.DIFFUSE: _diffuse,
    Effect.INVERSE_TRANSPOSE: _inverse_transpose,
    Effect.METRIC: _metric,
    Effect.SPECULAR: _specular,
    Effect.TOON: _toon,
    Effect.OUTLINE: _outline,
    Effect.POSITION: _position,
    Effect.ATTENUATION: _attenuation,
    Effect.SPOT: _spot,
    Effect.SHADOWS: _shadows,
    Effect.RENORMALISE: _renormalise,
    Effect.PERSPECTIVE: _perspective,
    Effect.EXACT_WEIGHTS: _exact_weights,
    Effect.NEAR_CLIP: _near_clip,
    Effect.BACK_FACES: _back_faces,
    Effect.TEXTURE: _texture,
    Effect.NORMAL_MAP: _normal_map,
    Effect.VERTEX_COLOURS: _vertex_colours,
    Effect.TRANSPARENCY: _transparency,
    Effect.FOG: _fog,
}
