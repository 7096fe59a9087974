"""The proof that five shading spaces give one picture."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nmatrix.enums import NormalRule, Reflection, Space
from nmatrix.linear.rational import identity
from nmatrix.raster.image import Panel, compose
from nmatrix.raster.proofs.proof import (
    TORUS,
    DrawnScene,
    Proof,
    ProofSettings,
    drawn_scene,
    level_difference,
)
from nmatrix.raster.shading.normals import normals_by
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SKEWED = World(scale=(1, 1.6, 0.7), rotate_degrees=(50, 20, 10), shear=(0.4, 0, 0))
BULB = SceneLight(
    "bulb", LightKind.POINT, position=(2, 3, 3), intensity=0.5, attenuation=(1, 0.05, 0.01)
)


def spaces(settings: ProofSettings) -> Proof:
    """Draw one scene in five shading spaces; the differences are rounding."""
    lit = replace(settings, lights=(replace(settings.lights[0], intensity=0.45), BULB))
    if settings.reflection is Reflection.LAMBERT:
        lit = replace(lit, reflection=Reflection.BLINN_PHONG)
    scene = lit.scene(settings.placed(SKEWED), settings.geometry(TORUS))
    names = (Space.WORLD, Space.CAMERA, Space.OBJECT, Space.LIGHT)
    drawn = {one: drawn_scene(scene, space=one) for one in names}
    reference = drawn[Space.WORLD]
    drawn[Space.STATIC] = drawn_scene(_baked(scene, reference), space=Space.STATIC)
    differences = {
        one.value: float(np.abs(scene.rendered.image - reference.rendered.image).max())
        for one, scene in drawn.items()
    }
    captions = {
        Space.WORLD: "the reference",
        Space.OBJECT: f"with the metric: differs by {differences['object']:.0e}",
        Space.STATIC: f"M = I, baked: differs by {differences['static']:.0e}",
    }
    panels = [
        Panel(
            found.levels, one.value, captions.get(one, f"differs by {differences[one.value]:.0e}")
        )
        for one, found in drawn.items()
    ]
    worst = max(differences.values())
    found = Proof.of(
        settings.subject,
        compose("One picture, whatever the shading space", panels, columns=5),
        f"Five shading spaces give the same picture: the largest difference is {worst:.1e}.",
        list(drawn.values()),
        numbers={"differences": differences},
        max_level_difference=max(level_difference(one, reference) for one in drawn.values()),
    )
    return replace(found, effects=drawn[Space.OBJECT].effects)


def _baked(scene: Scene, world: DrawnScene) -> Scene:
    """Return the scene with its object's vertices moved to the world once and for all: M = I."""
    (one,), (body,) = scene.objects, world.loaded.bodies
    mesh = replace(
        body.mesh,
        positions=body.positions_world,
        normals=np.ascontiguousarray(normals_by(world.loaded, body, NormalRule.EXACT).T),
    )
    if body.linear_map.determinant_sign < 0:
        mesh = replace(mesh, triangles=np.ascontiguousarray(mesh.triangles[:, ::-1]))
    baked = replace(one, geometry=LoadedGeometry(mesh), world_from_object=identity(4))
    return replace(scene, objects=(baked,))
