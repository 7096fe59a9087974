"""Proofs about the rule that carries normals: right and wrong ones, side by side."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule, Shading
from nmatrix.linear.classify import Classification
from nmatrix.raster.image import Panel, compose, levels
from nmatrix.raster.proofs.angles import (
    INVISIBLE_DEG,
    ROUNDING_DEG,
    UNDEFINED,
    AngleMap,
    Scale,
    normals_by,
    rule_error,
)
from nmatrix.raster.proofs.proof import (
    TORUS,
    DrawnScene,
    Proof,
    ProofSettings,
    drawn_scene,
    level_difference,
)
from nmatrix.raster.shading.space import length
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.scene import Scene
from nmatrix.scene.world import World

Array = NDArray[Any]

TALL = World(scale=(1, 2, 1))
TURNED = World(rotate_degrees=(20, 30, 40))

# What the right rule is called, by the rank of A.
RIGHT_RULE = {
    3: ("Right: A⁻ᵀ n", "the inverse transpose carries them"),
    2: ("Right: C n, two-sided", "no inverse is left; the cofactors carry them"),
}
NO_RULE = ("Right: none", "no plane is left to be normal to")


def normals(settings: ProofSettings) -> Proof:
    """Draw a mesh with wrong and with right normals, and the angle between them."""
    wrong, right = _both(settings.scene(settings.placed(TALL)))
    found = rule_error(right.plan, NormalRule.NONE)
    scale = Scale.reaching(found.worst_deg)
    kind = right.loaded.bodies[0].kind
    panels = (
        Panel(wrong.levels, "Wrong: A n", "the matrix itself carries the normals"),
        Panel(right.levels, *RIGHT_RULE.get(kind.rank, NO_RULE)),
        Panel(_heat(found, scale, right), "Angle between them", _angle_caption(found)),
    )
    return Proof.of(
        settings.subject,
        compose(_title(settings.subject, kind), panels, scale.legend),
        _verdict(found),
        [wrong, right],
        max_level_difference=level_difference(wrong, right),
        **found.errors,
    )


def bias(settings: ProofSettings) -> Proof:
    """Draw what a rotation hides and a scale shows: the same wrong matrix under both."""
    shape = settings.geometry(TORUS)
    turned = _both(settings.scene(TURNED, shape))
    stretched = settings.placed(replace(TALL, rotate_degrees=TURNED.rotate_degrees))
    scaled = _both(settings.scene(stretched, shape))
    hidden, seen = (level_difference(a, b) for a, b in (turned, scaled))
    panels = (
        Panel(turned[0].levels, "Rotation: A n", "looks right, and is"),
        Panel(turned[1].levels, "Rotation: A⁻ᵀ n", f"differs by {hidden} levels: A⁻ᵀ = A"),
        Panel(scaled[0].levels, "Scale: A n", "the same code, and wrong"),
        Panel(scaled[1].levels, "Scale: A⁻ᵀ n", f"differs by {seen} levels"),
    )
    return Proof.of(
        settings.subject,
        compose("A test on rotations cannot tell a wrong normal matrix", panels, columns=4),
        f"The wrong matrix is off by {hidden} levels in a rotation, by {seen} in a scale.",
        [*turned, *scaled],
        numbers={"rotation_level_difference": hidden, "scale_level_difference": seen},
        max_level_difference=seen,
        **rule_error(scaled[1].plan, NormalRule.NONE).errors,
    )


def mirror(settings: ProofSettings) -> Proof:
    """Draw a mirrored object by cofactors without their sign, rightly, and with wrong winding."""
    scene = settings.scene(settings.placed(World(scale=(-1, 1.4, 1), rotate_degrees=(0, 30, 0))))
    right = drawn_scene(scene)
    unsigned = drawn_scene(scene, normals=NormalRule.COFACTOR)
    inside_out = drawn_scene(_other_winding(scene))
    found = rule_error(right.plan, NormalRule.COFACTOR)
    panels = (
        Panel(unsigned.levels, "Cofactors, sign dropped", _angle_caption(found)),
        Panel(right.levels, "sign(det) · C = A⁻ᵀ · |det|", "normals point outwards"),
        Panel(inside_out.levels, "Winding not flipped", "faces are culled from the wrong side"),
    )
    return Proof.of(
        settings.subject,
        compose("A mirror flips the sign of the cofactors, and the winding", panels),
        f"Without the sign of det A the normals are {found.worst_deg or 0:.0f}° off.",
        [unsigned, right, inside_out],
        numbers={"winding_level_difference": level_difference(inside_out, right)},
        max_level_difference=level_difference(unsigned, right),
        **found.errors,
    )


def translation(settings: ProofSettings) -> Proof:
    """Draw normals that a translation moved, and normals measured over four components."""
    scene = settings.scene(settings.placed(World(translate=(5, 0, 0))))
    right = drawn_scene(scene)
    moved = drawn_scene(scene, normals=NormalRule.TRANSLATED)
    short = drawn_scene(scene, normals=NormalRule.FOUR_COMPONENT, shading=Shading.GOURAUD)
    found = rule_error(right.plan, NormalRule.TRANSLATED)
    (body,) = right.loaded.bodies
    shortest = float(length(normals_by(right.loaded, body, NormalRule.FOUR_COMPONENT)).min())
    panels = (
        Panel(moved.levels, "w = 1 with M", _angle_caption(found)),
        Panel(short.levels, "A⁻ᵀ in 4×4, 4-component normalise", f"lengths fall to {shortest:.3f}"),
        Panel(right.levels, "Right: w = 0, three components", "a normal knows no place"),
    )
    return Proof.of(
        settings.subject,
        compose("A normal is no point: a translation must not reach it", panels),
        f"With w = 1 the normals are up to {found.worst_deg or 0:.2f}° off; normalised over four "
        f"components the shortest has length {shortest:.3f}.",
        [moved, short, right],
        numbers={"shortest_normal": shortest},
        max_level_difference=level_difference(moved, short),
        **found.errors,
    )


def flatten(settings: ProofSettings) -> Proof:
    """Draw a flattened object: with no inverse, with a zero matrix, with the cofactors."""
    scene = settings.scene(
        settings.placed(World(scale=(1, 0, 1), rotate_degrees=(25, 0, 0), order="XYZ"))
    )
    right = drawn_scene(scene)
    without = drawn_scene(scene, normals=NormalRule.INVERSE)
    found = rule_error(right.plan, NormalRule.INVERSE)
    missing = found.covered[:, :, None] * UNDEFINED + _paper(right, found)
    lost = level_difference(without, right)
    panels = (
        Panel(
            levels(missing), "inv(A): no answer", "det A = 0: it raises; grey is what stays empty"
        ),
        Panel(without.levels, "A zero matrix instead", "normals of length 0: ambient light alone"),
        Panel(right.levels, "C n, two-sided", "the plane's own normal, and its shade"),
    )
    return Proof.of(
        settings.subject,
        compose("Flattened: the inverse is gone, the normal of the plane is not", panels),
        f"The cofactors still know the plane's normal; without it {lost} levels of light are lost.",
        [without, right],
        numbers={"rank": right.loaded.bodies[0].kind.rank},
        max_level_difference=lost,
        **found.errors,
    )


def _heat(found: AngleMap, scale: Scale, on: DrawnScene) -> Array:
    """Return the map of angles as an 8-bit image; grey where a normal is missing."""
    compared, covered = found.compared[:, :, None], found.covered[:, :, None]
    colours = compared * scale.colours(found.pixel_deg) + (covered - compared) * UNDEFINED
    return levels(colours + _paper(on, found))


def _paper(on: DrawnScene, found: AngleMap) -> Array:
    background = np.array(on.loaded.settings.background)
    return np.asarray((1 - found.covered[:, :, None]) * background)


def _both(scene: Scene) -> tuple[DrawnScene, DrawnScene]:
    """Return the scene by the matrix itself, and by the right rule."""
    return drawn_scene(scene, normals=NormalRule.NONE), drawn_scene(scene)


def _other_winding(scene: Scene) -> Scene:
    """Return the scene with every triangle turned the other way, and its faces still culled."""
    (one,) = scene.objects
    mesh = one.geometry.mesh()
    turned = replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))
    return replace(scene, objects=(replace(one, geometry=LoadedGeometry(turned)),))


def _title(subject: str, found: Classification) -> str:
    kind = found.kind.value.replace("-scale", " scale")
    if found.condition is None:
        return f"{subject}: {kind}, rank {found.rank}"
    bound = found.worst_angle_deg or 0.0
    return f"{subject}: {kind}, κ = {found.condition_text}, bound {bound:.2f}°"


def _angle_caption(found: AngleMap) -> str:
    if not found.covered.any():
        return "nothing of it is seen"
    if found.worst_deg is None or found.mean_deg is None:
        return "no normal is left to compare"
    if found.worst_deg <= ROUNDING_DEG:
        return "none beyond rounding, anywhere"
    return f"worst {found.worst_deg:.2f}°, mean {found.mean_deg:.2f}° over what is seen"


def _verdict(found: AngleMap) -> str:
    if not found.covered.any():
        return "Nothing of the mesh covers a sample: move the camera or make the picture larger."
    if found.worst_deg is None:
        return "No normal survives this map."
    if found.worst_deg < INVISIBLE_DEG:
        return "Both are the same here: a test on this map cannot tell a wrong normal matrix."
    return f"With A itself the normals are up to {found.worst_deg:.2f}° off."
