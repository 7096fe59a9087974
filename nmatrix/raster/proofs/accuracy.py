"""The accuracy proof: one hard matrix, its normals in four precisions, and what each took."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from functools import partial
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import NormalRule
from nmatrix.linear.affine import compose as composed
from nmatrix.linear.affine import rotation
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import affine_matrix, linear_part, product, rational_matrix, to_floats
from nmatrix.raster.image import Panel, compose
from nmatrix.raster.proofs.angles import angle_map, normals_by
from nmatrix.raster.proofs.proof import (
    TORUS,
    DrawnScene,
    Proof,
    ProofSettings,
    drawn_scene,
    level_difference,
)
from nmatrix.raster.shading.normals import unit
from nmatrix.raster.shading.space import length, quotient
from nmatrix.raster.shading.surface import Surface
from nmatrix.scene.geometry import Geometry, LoadedGeometry
from nmatrix.scene.world import World

Array = NDArray[Any]

PRECISIONS = (np.float16, np.float32, np.float64)
COFACTOR_MULTIPLICATIONS = 18
SQUASHED = Fraction(1, 1_000_000)


def hard_world() -> World:
    """Return a map with κ = 10⁶ whose axes are not the coordinate axes: turn, squash, turn."""
    turn = rotation([Angle.degrees(25), Angle.degrees(40), Angle.degrees(15)])
    squash = linear_part(composed(turn, (1, SQUASHED, 1)))
    there = rotation([Angle.degrees(35), Angle.degrees(-20), Angle.degrees(50)])
    return World(matrix=rational_matrix(to_floats(affine_matrix(product(squash, there)))))


def accuracy(settings: ProofSettings) -> Proof:
    """Draw a mesh under a hard map with cofactors in float16, float32, float64 and exactly."""
    scene = settings.scene(
        settings.placed(hard_world()), settings.geometry(_squashed_back(settings))
    )
    exact = drawn_scene(scene)
    (body,) = exact.loaded.bodies
    true = normals_by(exact.loaded, body, NormalRule.EXACT)
    panels: list[Panel] = []
    numbers: dict[str, float | None] = {}
    drawn = []
    for precision in PRECISIONS:
        name = np.dtype(precision).name
        started = settings.clock()
        found = _normals_in(precision, exact)
        numbers[f"milliseconds_{name}"] = (settings.clock() - started) * 1000
        drawn.append(exact.redrawn(partial(_with_normals, normals=found)))
        worst = angle_map(exact.plan, [found], [true]).worst_deg
        numbers[f"worst_deg_{name}"] = worst
        told = "no normal is left" if worst is None else f"worst {worst:.3g}°"
        panels.append(
            Panel(drawn[-1].levels, name, f"{told}; {COFACTOR_MULTIPLICATIONS} multiplications")
        )
    bits = max(abs(entry).bit_length() for row in body.linear_map.entries for entry in row)
    panels.append(
        Panel(exact.levels, "exact", f"{COFACTOR_MULTIPLICATIONS} of {bits}-bit whole numbers")
    )
    kappa = body.kind.condition_text
    return Proof.of(
        settings.subject,
        compose(f"One map, κ = {kappa}, in four precisions", panels, columns=4),
        f"At κ = {kappa} the cofactors are up to {numbers['worst_deg_float32'] or 0:.2g}° off in "
        f"float32, {numbers['worst_deg_float64'] or 0:.2g}° in float64.",
        [exact],
        numbers=numbers,
        max_angle_error_deg=numbers["worst_deg_float32"],
        max_level_difference=max(level_difference(one, exact) for one in drawn),
    )


def _squashed_back(settings: ProofSettings) -> Geometry:
    """Return a torus stretched so that the hard map makes it round: then its shade can be seen."""
    if settings.world is not None:
        return TORUS
    A = np.array(to_floats(linear_part(hard_world().world_from_object)))
    mesh = TORUS.mesh()
    tilt = rotation([Angle.degrees(50), Angle.degrees(0), Angle.degrees(20)])
    R = np.array(to_floats(tilt))
    normals = mesh.normals @ R.T @ A  # covectors go back by Aᵀ
    positions = np.linalg.solve(A, R @ mesh.positions.T).T
    return LoadedGeometry(replace(mesh, positions=positions, normals=unit(normals)))


def _normals_in(precision: type, exact: DrawnScene) -> Array:
    """Return the world normals (3, V) by cofactors computed in one precision, as programs do.

    The rows of the cofactor matrix are cross products of the rows of A.
    """
    (body,) = exact.loaded.bodies
    A: Array = np.array(to_floats(linear_part(body.world_from_object.exact)), precision)
    with np.errstate(all="ignore"):
        C = np.stack([np.cross(A[1], A[2]), np.cross(A[2], A[0]), np.cross(A[0], A[1])])
        moved = (C @ body.mesh.normals.T.astype(precision)).astype(np.float64)
        sign = np.sign(np.float64((A[0] * C[0]).sum())) or 1.0
        moved *= sign / (np.abs(moved).max() or 1.0)
        found = quotient(moved, length(moved))
    return found if np.isfinite(found).all() else np.zeros_like(found)


def _with_normals(surface: Surface, normals: Array) -> Surface:
    """Return the surface with other vertex normals."""
    changed = replace(surface)
    changed.__dict__["vertex_normals"] = normals  # as if the property had computed them
    return changed
