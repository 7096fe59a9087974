"""Small scenes that several tests draw."""

from __future__ import annotations

from nmatrix.enums import Reflection, Space
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

SUN = SceneLight("sun", LightKind.DIRECTIONAL, direction=(-1, -2, -1.5), intensity=0.6)
BULB = SceneLight(
    "bulb",
    LightKind.POINT,
    position=(2, 3, 2),
    intensity=0.6,
    attenuation=(1, 0.05, 0.02),
    range=12,
)
LAMBERT = Material("matt")
PHONG = Material("phong", reflection=Reflection.PHONG, shininess=40, specular=grey(0.5))
BLINN = Material("blinn", reflection=Reflection.BLINN_PHONG, shininess=128)
TOON = Material("toon", reflection=Reflection.TOON, outline=0.2)

LENS = Lens(fov_degrees=45, near=0.5, far=40)
VIEW = View(eye=(1.2, 1.5, 4.5), target=(0, 0, 0))


HERE = World()
BALL = ShapeGeometry(Shape.SPHERE, (24, 48))


def single(
    world: World = HERE,
    material: Material = LAMBERT,
    lights: tuple[SceneLight, ...] = (SUN,),
    shape: ShapeGeometry = BALL,
    view: View = VIEW,
    **settings: object,
) -> Scene:
    """One object under some lights."""
    shown = SceneObject("thing", shape, world.world_from_object, material)
    chosen = {"size": (96, 96), "samples": 1, "space": Space.WORLD, **settings}
    return Scene((shown,), lights, view, LENS, Settings(**chosen))  # type: ignore[arg-type]
