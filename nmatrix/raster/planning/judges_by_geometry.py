"""Shortcuts: what need not be computed because of what a body is, and where it is seen from.

Leaving out is *exact* (no bit changes), *rounding* (≤ 1e-12) or *bounded*: then it is only
proposed, with the most that it can move a channel by, and the plan's budget decides.
"""

from __future__ import annotations

from math import inf, radians, sqrt

from nmatrix.enums import NormalRule, Shading
from nmatrix.linear.classify import condition_text, most_excess, worst_angle_deg
from nmatrix.linear.exact import LinearMap
from nmatrix.raster.planning.facts import Facts, product
from nmatrix.raster.planning.recipe import (
    ROUNDING,
    Decision,
    adds_nothing,
    by_bound,
    called_for,
    not_asked,
)
from nmatrix.scene.meshes.shell import Shell
from nmatrix.scene.words import DepthBuffer, Sides

BACKS = {
    Shell.OPEN: "the mesh is open",
    Shell.INSIDE_OUT: "the mesh is inside out",
    Shell.CLOSED: "the mesh is closed, and may pass through itself",
}
MODEST_RATIO = 256.0  # of w within a triangle: sums then lose 2⁸ · 8u < 1e-12


def inverse_transpose(facts: Facts) -> Decision:
    """Decide on the inverse transpose, or the matrix itself."""
    if facts.loaded.settings.normals is not NormalRule.EXACT:
        return called_for(f"normals are carried by the rule “{facts.loaded.settings.normals}”")
    linear_map = facts.seen.map_to_space
    if linear_map.rank < 3:
        return called_for(f"the map has rank {linear_map.rank}: only the cofactors are left")
    if _is_power_of_two(linear_map):
        return adds_nothing("the map is a turn times a power of two: it carries normals itself")
    excess = most_excess(linear_map)
    if excess <= ROUNDING:
        bound = _change_by_bent_normals(facts, excess / 2)
        return by_bound(bound, f"κ = 1 to {excess / 2:.2g}: the matrix itself carries normals")
    worst = worst_angle_deg(linear_map) or 0.0
    bound = _change_by_bent_normals(facts, radians(worst))
    because = f"κ = {condition_text(linear_map)}: without it normals bend by {worst:.3g}°"
    return by_bound(bound, because)


def _change_by_bent_normals(facts: Facts, angle: float) -> float:
    """Bound what a channel moves if each normal of a vertex bends by an angle in radians."""
    if not facts.seen.is_rigid:
        return inf  # the angle is one between coordinates, not one of the world
    if facts.has_jumps and angle > ROUNDING:
        return inf
    bound = product(angle, facts.max_change_per_radian)
    if bound and facts.loaded.settings.shading is Shading.PHONG:
        shortest = facts.seen.shortest_normal()  # a mixture of bent normals bends by θ/|mixture|
        bound = bound / shortest if shortest else inf
    return inf if facts.has_jumps and bound > ROUNDING else bound


def _is_power_of_two(linear_map: LinearMap) -> bool:
    """Return True if AᵀA = 4ᵏ·I exactly: then A and its cofactors differ by a power of two."""
    G = linear_map.gram
    size = G[0][0].bit_length() - 1
    is_even = G[0][0] == 1 << size and size % 2 == 0
    return is_even and all(G[i][j] == G[0][0] * (i == j) for i in range(3) for j in range(3))


def metric(facts: Facts) -> Decision:
    """Decide on the metric of a space that is not rigid."""
    if facts.seen.is_rigid:
        return by_bound(0.0, f"{facts.space} space is rigid")
    return called_for(f"{facts.space} space stretches lengths")


def position(facts: Facts) -> Decision:
    """Decide on where a fragment is, for lights that have a place."""
    placed = [one for one in facts.lights if one.position is not None]
    if facts.is_lit_at_fragments and placed:
        return called_for(f"{len(placed)} lamps have a place")
    return not_asked("nothing asks where a fragment is")


def shadows(facts: Facts) -> Decision:
    """Decide on shadows, where something can cast them."""
    casting = [one for one in facts.lights if one.light.shadows]
    if not casting:
        return not_asked("no lamp that reaches it casts shadows")
    for placed in casting:
        for one in facts.seen.casters(placed)[:1]:
            return called_for(f"{one.name} can keep {placed.light.name}'s light off")
    return adds_nothing("nothing stands between what is seen of it and a lamp")


def renormalise(facts: Facts) -> Decision:
    """Decide on normals at length one again."""
    if not facts.is_lit_at_fragments:
        return adds_nothing("light is not evaluated at fragments")
    if facts.why_lengths_matter is not None:
        return called_for(facts.why_lengths_matter)
    if facts.body.linear_map.rank < 3:
        return called_for("normals of a flattened body can cancel")
    short = 1.0 - facts.shortest_normal
    bound = facts.max_change_by_shortening(short)
    return by_bound(bound, f"interpolation shortens normals by up to {short:.2g}")


def perspective(facts: Facts) -> Decision:
    """Decide on weights by 1/w."""
    if facts.seen.is_parallel:
        return adds_nothing("the view is parallel: w is 1 everywhere")
    if facts.loaded.settings.shading is Shading.FLAT and not facts.max_change_per_unit:
        return adds_nothing("whole triangles have one colour")
    ratio = facts.seen.w_ratio
    because = f"w changes by a factor of up to {ratio:.3g} within a triangle"
    if ratio == inf:
        return called_for("triangles are cut by the view")
    if facts.has_jumps and facts.is_lit_at_fragments:
        return called_for(because)
    return by_bound(_change_by_affine_weights(facts, ratio), because)


def _change_by_affine_weights(facts: Facts, ratio: float) -> float:
    """Bound what a channel moves if weights forget a ratio of w's.

    Of a triangle's whole weight they put the part `wrong` into the wrong place, so an attribute
    moves by that part of its range at the most.
    """
    wrong = (sqrt(ratio) - 1.0) / (sqrt(ratio) + 1.0)
    by_place = product(wrong, facts.max_change_per_unit)
    if by_place:
        by_place = product(by_place, facts.seen.longest_edge)
    if not facts.is_lit_at_fragments:
        is_flat = facts.loaded.settings.shading is Shading.FLAT
        return by_place + (0.0 if is_flat else product(wrong, facts.max_light))
    if not facts.shortest_normal:
        return inf
    chord = sqrt(max(0.0, 2.0 - 2.0 * facts.seen.normal_cosine)) + 2.0 * facts.bend
    turned = product(wrong * chord / facts.shortest_normal, facts.max_change_per_radian)
    return by_place + turned


def exact_weights(facts: Facts) -> Decision:
    """Decide on each weight by itself."""
    if facts.seen.is_parallel:
        return adds_nothing("the view is parallel: w is 1 everywhere")
    because = f"w changes by a factor of up to {facts.seen.w_ratio:.3g} within a triangle"
    return by_bound(0.0 if facts.seen.w_ratio <= MODEST_RATIO else inf, because)


def near_clip(facts: Facts) -> Decision:
    """Decide on the clip."""
    if facts.seen.is_whole:
        return adds_nothing("every vertex lies between near and far")
    return called_for("vertices lie outside of the view")


def back_faces(facts: Facts) -> Decision:
    """Decide on faces that are seen from behind."""
    material = facts.body.material
    if material.sides is Sides.FRONT:
        return not_asked("the material has a front alone")
    if facts.body.linear_map.rank < 3 and not material.is_clear:
        return adds_nothing("a flattened body turns its normals to the eye at its vertices")
    why = _why_backs_show(facts)
    if why is None:
        return adds_nothing("the mesh is closed, and seen from outside")
    return called_for(why)


def _why_backs_show(facts: Facts) -> str | None:
    """Find the reason why a back may be in front somewhere, or None if it never is."""
    shell = facts.body.mesh.shell
    if facts.material.is_clear:
        return "the back is seen through the front"
    if facts.material.alpha_cutoff is not None:
        return "the back is seen through holes"
    if shell is not Shell.SOLID:
        return BACKS[shell]
    if not facts.seen.is_whole or not facts.seen.eye_is_outside:
        return "the view may look into it"
    if facts.loaded.settings.depth is not DepthBuffer.FULL or facts.seen.is_thin:
        return "its front and its back may share a step of depth"
    return None
