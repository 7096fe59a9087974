"""The depth proof: two floors, one just under the other, in three buffers, both ways round."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nmatrix.enums import DepthRange
from nmatrix.raster.image import Panel, compose
from nmatrix.raster.proofs.proof import DrawnScene, Proof, ProofSettings, drawn_scene
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import Material, grey
from nmatrix.scene.scene import Scene, SceneObject
from nmatrix.scene.words import DepthBuffer, Shape
from nmatrix.scene.world import World

HEIGHT, GAP, NEAR, FAR = 30.0, 0.05, 0.01, 3000.0
UPPER = Material("upper", ambient=(0.95, 0.75, 0.35), diffuse=grey(0.0))
LOWER = Material("lower", ambient=(0.1, 0.15, 0.4), diffuse=grey(0.0))
BUFFERS = {
    DepthBuffer.UNORM16: "16 bits",
    DepthBuffer.UNORM24: "24 bits",
    DepthBuffer.FLOAT32: "float32",
}
RANGES = {DepthRange.ZERO_TO_ONE: "standard", DepthRange.REVERSED: "reversed"}


def depth(settings: ProofSettings) -> Proof:
    """Draw two floors 0.05 apart, up to 3000 away, and count where the lower one shows through."""
    alone = drawn_scene(_floors(settings, DepthRange.ZERO_TO_ONE, DepthBuffer.FULL, UPPER))
    covered = _is_like(alone, UPPER)
    drawn = {
        (order, buffer): drawn_scene(_floors(settings, order, buffer, UPPER, LOWER))
        for order in RANGES
        for buffer in BUFFERS
    }
    wrong = {
        key: float((covered & ~_is_like(one, UPPER)).sum() / covered.sum())
        for key, one in drawn.items()
    }
    panels = [
        Panel(
            one.levels, f"{BUFFERS[buffer]}, {RANGES[order]}", f"{wrong[order, buffer]:.1%} wrong"
        )
        for (order, buffer), one in drawn.items()
    ]
    standard, reverse = (wrong[order, DepthBuffer.FLOAT32] for order in RANGES)
    return Proof.of(
        settings.subject,
        compose(f"Two floors {GAP} apart, seen from {HEIGHT:g} above, near {NEAR}", panels),
        f"In float32 {standard:.1%} of the floor is wrong with standard depth, {reverse:.1%} with "
        "reversed depth: its steps are finest where perspective needs them.",
        list(drawn.values()),
        numbers={
            f"wrong_{buffer.name.lower()}_{RANGES[order]}": share
            for (order, buffer), share in wrong.items()
        },
    )


def _floors(
    settings: ProofSettings, order: DepthRange, buffer: DepthBuffer, *materials: Material
) -> Scene:
    objects = [
        SceneObject(
            material.name,
            ShapeGeometry(Shape.PLANE),
            World(translate=(0, -GAP * i, 0), scale=(5000, 1, 5000)).world_from_object,
            material,
        )
        for i, material in enumerate(materials)
    ]
    # The lower floor is named first, so that equal depths do not hide behind the order.
    scene = settings.still.with_objects(*reversed(objects), depth=buffer, samples=1)
    clip = replace(settings.lens.clip, depth=order)
    width, height = settings.picture.size
    lens = Lens(fov_degrees=50, aspect=width / height, near=NEAR, far=FAR, clip=clip)
    roll = np.radians(settings.picture.turn_degrees)
    up = (float(np.sin(roll)), float(np.cos(roll)), 0.0)
    view = View(eye=(0, HEIGHT, 0), target=(0, HEIGHT - 15, -60), up=up)
    return replace(scene, view=view, lens=lens, has_camera=True)


def _is_like(found: DrawnScene, material: Material) -> np.ndarray:
    shade = np.rint(np.array(material.ambient) * 255)
    return np.asarray((np.abs(found.levels - shade) < 1).all(axis=2))
