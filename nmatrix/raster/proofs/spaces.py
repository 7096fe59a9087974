"""Proofs that two ways give one picture: five shading spaces, and the plan against everything."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from nmatrix.enums import NormalRule, Reflection, Space
from nmatrix.linear.rational import identity
from nmatrix.raster.image import Panel, compose, levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.proofs.angles import normals_by
from nmatrix.raster.proofs.proof import (
    TORUS,
    DrawnScene,
    Proof,
    ProofSettings,
    drawn_scene,
    effect_names,
    level_difference,
    together,
)
from nmatrix.raster.proofs.showpiece import showpiece
from nmatrix.raster.render import render
from nmatrix.report import Value
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

SKEWED = World(scale=(1, 1.6, 0.7), rotate_degrees=(50, 20, 10), shear=(0.4, 0, 0))
BULB = SceneLight(
    "bulb", LightKind.POINT, position=(2, 3, 3), intensity=0.5, attenuation=(1, 0.05, 0.01)
)
AMPLIFIED = 50  # a difference in levels is drawn so many times brighter


def spaces(settings: ProofSettings) -> Proof:
    """Draw one scene in five shading spaces; the differences are rounding."""
    lit = replace(settings, lights=(replace(settings.lights[0], intensity=0.45), BULB))
    if settings.reflection is Reflection.LAMBERT:
        lit = replace(lit, reflection=Reflection.BLINN_PHONG)
    scene = lit.scene(settings.placed(SKEWED), settings.geometry(TORUS))
    names = (Space.WORLD, Space.CAMERA, Space.OBJECT, Space.LIGHT)
    drawn = {one: drawn_scene(_in_space(scene, one)) for one in names}
    drawn[Space.STATIC] = drawn_scene(_in_space(_baked(scene, drawn[Space.WORLD]), Space.STATIC))
    reference = drawn[Space.WORLD].rendered.image
    differences = {
        one.value: float(np.abs(found.rendered.image - reference).max())
        for one, found in drawn.items()
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
    return Proof(
        compose("One picture, whatever the shading space", panels, columns=5),
        settings.subject,
        f"Five shading spaces give the same picture: the largest difference is {worst:.1e}.",
        together(*(one.rendered.work for one in drawn.values())),
        drawn[Space.OBJECT].effects,
        {"differences": differences},
        max_level_difference=max(
            level_difference(one.levels, drawn[Space.WORLD].levels) for one in drawn.values()
        ),
        remarks=drawn[Space.WORLD].loaded.remarks,
    )


def _in_space(scene: Scene, space: Space) -> Scene:
    return replace(scene, settings=replace(scene.settings, space=space))


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


def effects(settings: ProofSettings) -> Proof:
    """Draw a scene with everything on and by its plan: the same picture for less work."""
    ready = loaded(showpiece(settings.picture))
    started = settings.clock()
    full = render(everything(ready))
    between = settings.clock()
    plan = planned(ready)
    found = render(plan)
    ended = settings.clock()
    difference = np.abs(full.rgb - found.rgb)
    worst = float(difference.max())
    saved = 1 - found.work.multiplications / full.work.multiplications
    numbers: dict[str, Value] = {
        "difference": worst,
        "multiplications_everything": full.work.multiplications,
        "multiplications_planned": found.work.multiplications,
        "milliseconds_everything": (between - started) * 1000,
        "milliseconds_planned": (ended - between) * 1000,
    }
    shown_full, shown_plan = levels(full.rgb), levels(found.rgb)
    panels = (
        Panel(shown_full, "Everything on", f"{full.work.multiplications:,} multiplications"),
        Panel(shown_plan, "What the scene calls for", f"{found.work.multiplications:,}"),
        Panel(levels(difference * AMPLIFIED), f"Difference × {AMPLIFIED}", f"at most {worst:.0e}"),
    )
    return Proof(
        compose("The plan leaves out what cannot be seen", panels),
        settings.subject,
        f"The plan saves {saved:.0%} of the multiplications; no channel moves by more than "
        f"{worst:.0e}.",
        together(full.work, found.work),
        effect_names(plan),
        numbers,
        max_level_difference=level_difference(shown_full, shown_plan),
        remarks=ready.remarks,
    )
