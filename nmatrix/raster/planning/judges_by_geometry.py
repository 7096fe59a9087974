"""Shortcuts: what need not be computed because of what a body is, and where it is seen from.

Leaving out is *exact* (no bit changes), *rounding* (≤ 1e-12) or *bounded*: then it is only
proposed, with the most that it can move a channel by, and the plan's budget decides.
"""

from __future__ import annotations

from math import inf, radians, sqrt

from nmatrix.enums import LeftOut, NormalRule, Reflection, Shading
from nmatrix.raster.planning.culled_lights import occluders
from nmatrix.raster.planning.decision import Verdict
from nmatrix.raster.planning.facts import Facts
from nmatrix.scene.words import DepthBuffer, Sides

ROUNDING = 1e-12
MODEST_RATIO = 256.0  # of w within a triangle: sums then lose 2⁸ · 8u < 1e-12


def _by_bound(bound: float, because: str) -> Verdict:
    """Leave out what moves channels by rounding, and propose what has a bound at all."""
    if bound <= ROUNDING:
        return False, because, LeftOut.ROUNDING, bound
    return (True, because) if bound == inf else (False, because, LeftOut.BOUNDED, bound)


def inverse_transpose(facts: Facts) -> Verdict:
    """Decide on the inverse transpose, or the matrix itself."""
    if facts.loaded.settings.normals is not NormalRule.EXACT:
        return True, f"normals are carried by the rule “{facts.loaded.settings.normals}”"
    found = facts.map_to_space
    if found.rank < 3:
        return True, f"the map has rank {found.rank}: only the cofactors are left"
    worst = found.worst_angle_deg or 0.0
    if not worst and _is_power_of_two(facts):
        return False, "the map is a turn times a power of two: it carries normals itself"
    bound = radians(worst) * facts.slope
    if facts.has_jumps and max(bound, radians(worst)) > ROUNDING:
        bound = inf
    return _by_bound(bound, f"κ = {found.condition_text}: without it normals bend by {worst:.3g}°")


def _is_power_of_two(facts: Facts) -> bool:
    """Return whether AᵀA = 4ᵏ·I exactly: then A and its cofactors differ by a power of two."""
    linear_map = facts.map_to_space.linear_map
    square = sum(entry * entry for entry in linear_map.entries[0])
    size = square.bit_length() - 1
    return square == 1 << size and size % 2 == 0


def metric(facts: Facts) -> Verdict:
    """Decide on the metric of a space that is not rigid."""
    if facts.space_is_rigid:
        return False, f"{facts.space} space is rigid", LeftOut.ROUNDING, 0.0
    return True, f"{facts.space} space stretches lengths"


def position(facts: Facts) -> Verdict:
    """Decide on where a fragment is, for lights that have a place."""
    placed = [one for one in facts.lights if one.position is not None]
    if facts.loaded.settings.shading is Shading.PHONG and placed:
        return True, f"{len(placed)} lamps have a place"
    return False, "nothing asks where a fragment is"


def shadows(facts: Facts) -> Verdict:
    """Decide on shadows, where something can cast them."""
    casting = [one for one in facts.lights if one.light.shadows]
    if not casting:
        return False, "no lamp that reaches it casts shadows"
    found = {one.light.name: occluders(facts.loaded, one, facts.body) for one in casting}
    blocked = {name: bodies for name, bodies in found.items() if bodies}
    if not blocked:
        return False, "nothing stands between it and a lamp"
    name, bodies = next(iter(blocked.items()))
    return True, f"{bodies[0]} can keep {name}'s light off"


def renormalise(facts: Facts) -> Verdict:
    """Decide on normals at length one again."""
    if facts.loaded.settings.shading is not Shading.PHONG:
        return False, "light is not evaluated at fragments"
    if facts.body.material.normal_map is not None:
        return True, "a normal map turns normals"
    material, short = facts.body.material, 1.0 - facts.shortest_normal
    if material.reflection is Reflection.TOON or material.outline:
        return True, "bands and outlines have edges that lengths would move"
    if facts.body.linear_map.rank < 3:
        return True, "normals of a flattened body can cancel"
    if facts.shines and material.shininess < 1:
        return True, "a highlight this wide has an infinite slope"
    gain = max(material.diffuse)
    if facts.shines:
        turns = 4.0 if material.reflection is Reflection.PHONG else 1.0
        gain += turns * material.shininess * max(material.specular)
    bound = gain * short * facts.brightness * facts.contrast
    return _by_bound(bound, f"interpolation shortens normals by up to {short:.2g}")


def perspective(facts: Facts) -> Verdict:
    """Decide on weights by 1/w."""
    if facts.is_parallel:
        return False, "the view is parallel: w is 1 everywhere"
    if facts.loaded.settings.shading is Shading.FLAT and not facts.reads_places:
        return False, "whole triangles have one colour"
    ratio = facts.w_ratio
    because = f"w changes by a factor of up to {ratio:.3g} within a triangle"
    if ratio == inf:
        return True, "triangles are cut by the view"
    if facts.reads_places or (facts.has_jumps and facts.loaded.settings.shading is Shading.PHONG):
        return True, because
    wrong = (sqrt(ratio) - 1.0) / (sqrt(ratio) + 1.0)
    if facts.loaded.settings.shading is Shading.GOURAUD:
        return _by_bound(wrong * facts.colour_range, because)
    chord = sqrt(max(0.0, 2.0 - 2.0 * facts.normal_cosine))
    shortest = facts.shortest_normal
    return _by_bound(wrong * chord / shortest * facts.slope if shortest else inf, because)


def exact_weights(facts: Facts) -> Verdict:
    """Decide on each weight by itself."""
    if facts.is_parallel:
        return False, "the view is parallel: w is 1 everywhere"
    because = f"w changes by a factor of up to {facts.w_ratio:.3g} within a triangle"
    return _by_bound(0.0 if facts.w_ratio <= MODEST_RATIO else inf, because)


def near_clip(facts: Facts) -> Verdict:
    """Decide on the clip."""
    if facts.is_whole:
        return False, "every vertex lies between near and far"
    return True, "vertices lie outside of the view"


def back_faces(facts: Facts) -> Verdict:
    """Decide on faces that are seen from behind."""
    material = facts.body.material
    if material.sides is Sides.FRONT:
        return False, "the material has a front alone"
    if facts.body.linear_map.rank < 3 and material.opacity == 1.0:
        return False, "a flattened body turns its normals to the eye at its vertices"
    why = _why_backs_show(facts)
    return (True, why) if why else (False, "the mesh is closed, and seen from outside")


def _why_backs_show(facts: Facts) -> str | None:
    """Return why a back may be in front somewhere, or None if it never is."""
    if facts.body.material.opacity < 1.0 or facts.body.material.sides is Sides.BOTH:
        return "the material shows both sides"
    if not facts.body.mesh.is_closed:
        return "the mesh is open"
    if not facts.is_whole or not facts.eye_is_outside:
        return "the view may look into it"
    if facts.loaded.settings.depth is not DepthBuffer.FULL or facts.is_thin:
        return "its front and its back may share a step of depth"
    return None
