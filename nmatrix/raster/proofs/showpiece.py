"""A scene of its own for proofs that need one: several objects, three lights, many effects."""

from __future__ import annotations

from dataclasses import replace
from math import atan, degrees, radians, tan

from nmatrix.enums import Reflection
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import CHECKER, Material, grey
from nmatrix.scene.scene import Fog, Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

FLOOR = Material("floor", diffuse=grey(0.8), texture=CHECKER)
RED = Material(
    "red",
    ambient=(0.12, 0.03, 0.02),
    diffuse=(0.8, 0.2, 0.15),
    specular=grey(0.4),
    shininess=40,
    reflection=Reflection.PHONG,
)
BLUE = Material(
    "blue",
    diffuse=(0.2, 0.35, 0.8),
    specular=grey(0.5),
    shininess=64,
    reflection=Reflection.BLINN_PHONG,
)
GREEN = Material(
    "green",
    ambient=(0.05, 0.12, 0.05),
    diffuse=(0.3, 0.8, 0.3),
    reflection=Reflection.TOON,
    outline=0.25,
)
GLASS = Material(
    "glass",
    diffuse=(0.5, 0.7, 0.8),
    specular=grey(0.8),
    shininess=80,
    reflection=Reflection.PHONG,
    opacity=0.35,
)

LIGHTS = (
    SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -2, -1.5), intensity=0.6, shadows=True),
    SceneLight(
        "bulb",
        LightKind.POINT,
        position=(-1.4, 2.2, 2),
        color=(1, 0.9, 0.7),
        intensity=0.6,
        attenuation=(1, 0.05, 0.02),
        range=12,
    ),
    SceneLight(
        "torch",
        LightKind.SPOT,
        position=(0.3, -0.2, 0),
        direction=(0, 0, -1),
        intensity=0.5,
        cone_degrees=(8, 14),
        fixed_to="eye",
    ),
)


FOV_DEG = 45.0
WIDE = 0.5  # the tangent of half the angle that the row of objects takes


def showpiece(settings: Settings) -> Scene:
    """Return the scene, drawn as the settings say, with sRGB levels; fog ends in the background.

    A picture too narrow for the row of objects sees more above and below it.
    """
    width, height = settings.size
    half = max(tan(radians(FOV_DEG) / 2), WIDE * height / width)
    return Scene(
        objects=(
            _object("floor", Shape.PLANE, World(translate=(0, -1, 0), scale=(6, 1, 6)), FLOOR),
            _object(
                "egg",
                Shape.SPHERE,
                World(translate=(-1.6, 0.2, 0), scale=(0.7, 1.2, 0.7), rotate_degrees=(0, 0, 30)),
                RED,
            ),
            _object(
                "ring",
                Shape.TORUS,
                World(translate=(0.6, 0, 0.3), rotate_degrees=(60, 0, 20), shear=(0.4, 0, 0)),
                BLUE,
            ),
            _object(
                "cone",
                Shape.CONE,
                World(translate=(2.4, -0.2, -0.8), scale=(-0.8, 0.8, 0.8)),
                GREEN,
            ),
            _object(
                "glass", Shape.SPHERE, World(translate=(0.2, 0.1, 1.9), scale=(0.6,) * 3), GLASS
            ),
        ),
        lights=LIGHTS,
        view=View(eye=(1, 2.5, 6.5), target=(0, 0, 0)),
        lens=Lens(fov_degrees=2 * degrees(atan(half)), aspect=width / height, near=0.5, far=40),
        settings=replace(settings, fog=Fog(settings.background, 6, 16), gamma=True),
    )


def _object(name: str, shape: Shape, world: World, material: Material) -> SceneObject:
    return SceneObject(name, ShapeGeometry(shape), world.world_from_object, material)
