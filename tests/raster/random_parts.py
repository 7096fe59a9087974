"""The parts of a random scene: an object, a material, lamps, a camera and settings, by dice."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import numpy as np
from random_meshes import Dice, Vector

from nmatrix.enums import DepthRange, NormalRule, Reflection, Shading, Space
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.rational import determinant, linear_part
from nmatrix.raster.image import png
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import EYE, WORLD, SceneLight
from nmatrix.scene.material import EmbeddedImage, ImageSource, Material, Texture, grey
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Fog, Scene, SceneObject, Settings
from nmatrix.scene.words import DepthBuffer, LightKind, Pattern, Sides, Wrap
from nmatrix.scene.world import World


def _image(seed: int, low: int, high: int) -> EmbeddedImage:
    pixels = np.random.default_rng(seed).integers(low, high, (5, 4, 3), np.uint8, endpoint=True)
    return EmbeddedImage(f"image {seed}", png(pixels, {}))


PATTERNS = (Pattern.CHECKER, _image(1, 0, 255), _image(2, 60, 200))
BUMPS = (_image(3, 100, 255), _image(4, 120, 136), _image(5, 0, 255))
ATTENUATIONS = (
    (1.0, 0.0, 0.0),
    (0.0, 0.0, 1.0),
    (0.01, 0.0, 5.0),
    (0.0, 1.0, 0.0),
    (1.0, 0.3, 0.2),
)
CONES = ((20.0, 30.0), (20.0, 20.0), (0.1, 0.1), (0.0, 90.0), (90.0, 90.0), (5.0, 60.0))
ENDS = (inf, inf, 2.0, 0.5, 6.0)


def scene_of(dice: Dice, *objects: SceneObject, lights: tuple[SceneLight, ...] = ()) -> Scene:
    """Draw some objects from anywhere, under some lamps or any."""
    lights = lights or lamps(dice, dice.whole(0, 4))
    return Scene(objects, lights, view(dice), lens(dice), settings(dice))


def in_a_space_that_is_there(scene: Scene) -> Scene:
    """Shade in the world what has no object space, or no light space.

    A flattened body has no coordinates for the rest; a lamp at the origin, the target of the space
    of light, looks nowhere.
    """
    is_flat = any(not determinant(linear_part(one.world_from_object)) for one in scene.objects)
    is_blind = any(one.has_position and not any(one.position) for one in scene.lights)
    lost = [Space.OBJECT] * is_flat + [Space.LIGHT] * is_blind
    if scene.settings.space not in lost:
        return scene
    return replace(scene, settings=replace(scene.settings, space=Space.WORLD))


def body(dice: Dice, mesh: Mesh, where: World | None = None) -> SceneObject:
    """Make an object of any material."""
    stands = (where or place(dice)).world_from_object
    return SceneObject(f"body {dice.source.random()}", LoadedGeometry(mesh), stands, material(dice))


def solid(dice: Dice, mesh: Mesh, where: World | None = None) -> SceneObject:
    """Make an opaque object; its sides are most often a matter of need."""
    made = body(dice, mesh, where)
    sides = Sides.AS_NEEDED if dice.chance(0.8) else made.material.sides
    return replace(made, material=replace(made.material, opacity=1.0, sides=sides))


def place(dice: Dice) -> World:
    scale = grey(dice.between(0.4, 1.6)) if dice.chance(0.5) else dice.vector(1.5)
    return World(
        translate=dice.vector(0.8),
        rotate_degrees=dice.vector(180),
        scale=scale,
        shear=dice.vector(0.6) if dice.chance(0.2) else (0, 0, 0),
    )


def colour(dice: Dice) -> Vector:
    if dice.chance(0.4):
        return grey(dice.between(0, 1))
    return dice.between(0, 1), dice.between(0, 1), dice.between(0, 1)


def material(dice: Dice) -> Material:
    return Material(
        ambient=grey(0) if dice.chance(0.3) else colour(dice),
        diffuse=grey(0) if dice.chance(0.1) else colour(dice),
        specular=colour(dice),
        shininess=dice.one_of((0.0, 0.3, 1.0, dice.power(0, 3))),
        reflection=dice.one_of((*Reflection, Reflection.LAMBERT, Reflection.LAMBERT)),
        opacity=dice.one_of((1.0, 1.0, 1.0, 1.0, dice.between(0, 1))),
        texture=texture(dice, PATTERNS) if dice.chance(0.1) else None,
        toon_steps=dice.whole(1, 5),
        outline=dice.between(0, 0.5) if dice.chance(0.1) else 0.0,
        sides=dice.one_of((Sides.AS_NEEDED, *Sides)),
    )


def texture(dice: Dice, images: Sequence[ImageSource | Pattern]) -> Texture:
    """Lay an image on a surface as it comes, or wrapped and turned."""
    image = dice.one_of(images)
    if dice.chance(0.5):
        return Texture(image)
    wraps = tuple(Wrap)
    return Texture(
        image,
        wrap=(dice.one_of(wraps), dice.one_of(wraps)),
        scale=(dice.between(-3, 3), dice.between(-3, 3)),
        rotation_degrees=dice.between(0, 360),
        offset=(dice.between(-1, 1), dice.between(-1, 1)),
    )


def lamps(dice: Dice, count: int) -> tuple[SceneLight, ...]:
    return tuple(lamp(dice, f"lamp {i}") for i in range(count))


def lamp(dice: Dice, name: str) -> SceneLight:
    return SceneLight(
        name,
        dice.one_of(tuple(LightKind)),
        position=dice.vector(3),
        direction=dice.direction(),
        color=colour(dice),
        intensity=dice.one_of((1.0, dice.between(0, 2), dice.power(-9, 3))),
        attenuation=dice.one_of(ATTENUATIONS),
        range=dice.one_of(ENDS),
        cone_degrees=dice.one_of(CONES),
        fixed_to=EYE if dice.chance(0.15) else WORLD,
        shadows=dice.chance(0.2),
    )


def view(dice: Dice, away: float | None = None) -> View:
    """Look at about the origin, from some distance or any."""
    away = dice.between(2.5, 6) if away is None else away
    x, y, z = dice.direction()
    return View(eye=(away * x, away * y, away * z), target=dice.vector(0.3), up=dice.direction())


def lens(dice: Dice) -> Lens:
    return Lens(
        fov_degrees=dice.between(25, 90),
        near=0.1,
        far=50,
        ortho=Window(-2.1, 2.2, -2.3, 2) if dice.chance(0.15) else None,
        clip=ClipSpace(dice.one_of(tuple(DepthRange))),
    )


def settings(dice: Dice) -> Settings:
    space = dice.one_of(tuple(Space))
    return Settings(
        space=space,
        space_matrix=place(dice).world_from_object if space is Space.CUSTOM else None,
        shading=dice.one_of((*Shading, Shading.PHONG)),
        size=(dice.whole(20, 44), dice.whole(20, 44)),
        samples=dice.one_of((1, 1, 4)),
        background=colour(dice),
        fog=fog(dice) if dice.chance(0.15) else None,
        gamma=dice.chance(0.3),
        depth=dice.one_of((*DepthBuffer, DepthBuffer.FULL)),
        shadow_map=dice.whole(16, 64),
        normals=dice.one_of(tuple(NormalRule)) if dice.chance(0.15) else NormalRule.EXACT,
    )


def fog(dice: Dice) -> Fog:
    start = dice.one_of((0.0, dice.between(0, 8), dice.power(0, 4)))
    return Fog(colour(dice), start, start + dice.power(-3, 2))
