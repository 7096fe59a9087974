"""Small scenes of every kind, each from its kind and a seed: the same on every machine.

Each kind turns one thing to its extremes, and throws dice for all the rest.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from math import atan, degrees
from random import Random

import numpy as np
from random_meshes import (
    Dice,
    closed,
    crossing,
    opened,
    painted,
    ruined,
    turned,
    turned_shells,
    with_wild_normals,
)
from random_parts import (
    BUMPS,
    PATTERNS,
    body,
    colour,
    in_a_space_that_is_there,
    lamp,
    lamps,
    place,
    scene_of,
    solid,
    texture,
    view,
)

from nmatrix.enums import DepthRange, Reflection, Space
from nmatrix.linear import rational
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import WORLD
from nmatrix.scene.material import CHECKER, grey
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.meshes.shapes import box, plane, sphere, torus
from nmatrix.scene.meshes.tangents import with_tangents
from nmatrix.scene.scene import Fog, Scene, SceneObject
from nmatrix.scene.words import DepthBuffer, LightKind
from nmatrix.scene.world import World


def random_scene(kind: str, seed: int) -> Scene:
    """Make the scene of a kind and a seed."""
    return in_a_space_that_is_there(KINDS[kind](Dice(Random(f"{kind} {seed}"))))


def any_mesh(dice: Dice) -> Mesh:
    return dice.one_of((closed, opened))(dice)


def company(dice: Dice) -> list[SceneObject]:
    """Stand something beside, now and then."""
    return [body(dice, any_mesh(dice))] if dice.chance(0.3) else []


def room(dice: Dice) -> Scene:
    """A closed body that holds the eye, and most lamps."""
    reach = dice.between(2, 6)
    walls = dice.one_of((box(dice.whole(1, 3)), sphere(6, 8), torus(8, 12, radius=1.0, tube=0.6)))
    around = World(rotate_degrees=dice.vector(180), scale=grey(reach))
    things = [body(dice, closed(dice)) for _ in range(dice.whole(0, 2))]
    lights = lamps(dice, dice.whole(1, 3))
    x, y, z = dice.direction()
    eye = (reach * 0.9 * x, reach * 0.2 * y, reach * 0.9 * z)
    scene = scene_of(dice, solid(dice, walls, around), *things, lights=lights)
    return replace(scene, view=View(eye=eye, target=dice.vector(reach / 2)))


def inside_out(dice: Dice) -> Scene:
    mesh = turned(closed(dice), turns_normals=dice.chance(0.5))
    return scene_of(dice, solid(dice, mesh), *company(dice))


def shells(dice: Dice) -> Scene:
    """Several closed surfaces in one mesh, one of which is inside out."""
    return scene_of(dice, solid(dice, turned_shells(dice)), *company(dice))


def crossing_itself(dice: Dice) -> Scene:
    return scene_of(dice, solid(dice, crossing(dice)), *company(dice))


def open_meshes(dice: Dice) -> Scene:
    return scene_of(dice, solid(dice, opened(dice)), body(dice, opened(dice)))


def ruined_meshes(dice: Dice) -> Scene:
    """Vertices twice, triangles without area."""
    mesh = ruined(dice, dice.one_of((closed, opened, crossing))(dice))
    return scene_of(dice, solid(dice, mesh), *company(dice))


def wild_normals(dice: Dice) -> Scene:
    """Normals that are not those of the faces, at times under lamps that spend the budget."""
    scene = scene_of(dice, solid(dice, with_wild_normals(dice, any_mesh(dice))), *company(dice))
    return dimmed(dice, scene) if dice.chance(0.5) else scene


def dimmed(dice: Dice, scene: Scene) -> Scene:
    """Weaken the lamps to about half a level, and take highlights and bands away."""
    lights = tuple(replace(one, intensity=dice.power(-5, -2)) for one in scene.lights)
    objects = [
        replace(one, material=replace(one.material, reflection=Reflection.LAMBERT, outline=0.0))
        for one in scene.objects
    ]
    return replace(scene, lights=lights, objects=tuple(objects))


def near_lamps(dice: Dice) -> Scene:
    """Lamps on a surface, inside of it, and hardly above; nearer than one unit."""
    mesh = any_mesh(dice)
    lights = []
    for one in lamps(dice, dice.whole(1, 3)):
        vertex = mesh.positions[dice.whole(0, len(mesh.positions) - 1)]
        above = dice.one_of((1.0, 0.5, 1 + dice.power(-6, -0.5)))
        kind = dice.one_of((LightKind.POINT, LightKind.SPOT))
        lights.append(
            replace(
                one,
                kind=kind,
                position=tuple((vertex * above).tolist()),
                fixed_to=WORLD,
                intensity=dice.power(-4, 0),
            )
        )
    return scene_of(dice, solid(dice, mesh, World()), *company(dice), lights=tuple(lights))


def spots(dice: Dice) -> Scene:
    """Spots in every direction, many at the middle of a body and many away from it."""
    things = []
    for _ in range(dice.whole(1, 2)):
        upright = World(translate=dice.vector(0.8)) if dice.chance(0.5) else None
        things.append(body(dice, any_mesh(dice), upright))
    lights = []
    for one in lamps(dice, dice.whole(1, 5)):
        middle = [float(row[3]) for row in dice.one_of(things).world_from_object[:3]]
        x, y, z = (to - here for to, here in zip(middle, one.position, strict=True))
        aimed = dice.one_of((one.direction, (x, y, z), (-x, -y, -z)))
        lights.append(replace(one, kind=LightKind.SPOT, direction=aimed, intensity=1.0))
    return scene_of(dice, *things, lights=tuple(lights))


def many_lamps(dice: Dice) -> Scene:
    lights = lamps(dice, dice.one_of((1, 8, 20, 60)))
    return scene_of(dice, body(dice, closed(dice)), *company(dice), lights=lights)


def weak_lamps(dice: Dice) -> Scene:
    """Many lamps of about half a level in all, beside a bright one."""
    lights = lamps(dice, dice.whole(1, 12))
    scene = dimmed(dice, scene_of(dice, body(dice, any_mesh(dice)), *company(dice), lights=lights))
    if dice.chance(0.4):
        return scene
    bright = replace(lamp(dice, "sun"), kind=LightKind.DIRECTIONAL, intensity=0.8)
    return replace(scene, lights=(*scene.lights, bright))


def huge_floors(dice: Dice) -> Scene:
    far = dice.power(1, 5)
    under = World(translate=(0, -dice.between(0.5, 2), 0), scale=(far, 1, far))
    floor = body(dice, plane(dice.whole(1, 6)), under)
    lights = lamps(dice, dice.whole(1, 3))
    scene = scene_of(dice, floor, body(dice, closed(dice)), lights=lights)
    eye = (dice.between(-2, 2), dice.between(-1, 3), 5)
    lens = replace(scene.lens, far=dice.power(1, 6))
    return replace(scene, view=View(eye=eye, target=dice.vector(1)), lens=lens)


def under_parents(dice: Dice) -> Scene:
    """Objects under parents that mirror, flatten and shear."""
    sizes = (-1.0, 0.0, 1e-8, 1.0, 1.0, 1.0, dice.between(0.3, 2))
    things = []
    for _ in range(dice.whole(1, 3)):
        above = World(
            rotate_degrees=dice.vector(180),
            scale=(dice.one_of(sizes), dice.one_of(sizes), dice.one_of(sizes)),
            shear=dice.vector(1.5) if dice.chance(0.5) else (0, 0, 0),
        )
        things.append(body(dice, any_mesh(dice), place(dice).under(above.world_from_object)))
    return scene_of(dice, *things)


def nearly_rigid(dice: Dice) -> Scene:
    """Maps next to a turn on matt bodies, from near and far: where the budget is spent."""
    size, off = dice.between(0.5, 2), dice.power(-9, -2)
    where = World(
        translate=dice.vector(0.5),
        rotate_degrees=dice.vector(180),
        scale=tuple(size * (1 + dice.one_of((0.0, off, -off))) for _ in range(3)),
        shear=dice.one_of(((0, 0, 0), (off, 0, 0), (0, off, -off))),
    )
    fine = dice.whole(4, 30)
    mesh = dice.one_of((sphere(fine, 2 * fine), torus(fine, fine), box(2), plane(3)))
    if dice.chance(0.3):
        mesh = with_wild_normals(dice, mesh)
    kinds = (LightKind.DIRECTIONAL, LightKind.DIRECTIONAL, LightKind.AMBIENT, LightKind.POINT)
    lights = tuple(
        replace(one, kind=dice.one_of(kinds), fixed_to=WORLD, intensity=dice.power(-3, 0))
        for one in lamps(dice, dice.whole(1, 3))
    )
    thing = solid(dice, mesh, where)
    dull = replace(thing.material, reflection=Reflection.LAMBERT, outline=0.0, texture=None)
    scene = scene_of(dice, replace(thing, material=dull), lights=lights)
    away = dice.power(0.3, 2.5)
    lens = replace(scene.lens, fov_degrees=degrees(2 * atan(2 / away)), far=1e4)
    scene = replace(scene, view=view(dice, away), lens=lens)
    return undone(dice, scene) if dice.chance(0.2) else scene


def undone(dice: Dice, scene: Scene) -> Scene:
    """Stretch the world by what the shading space takes back: only the whole is next to a turn."""
    squeezed = World(rotate_degrees=dice.vector(90), scale=(1, dice.power(0.3, 2), 1))
    matrix = squeezed.world_from_object
    stretched = rational.inverse(matrix)
    objects = [
        replace(one, world_from_object=rational.product(stretched, one.world_from_object))
        for one in scene.objects
    ]
    settings = replace(scene.settings, space=Space.CUSTOM, space_matrix=matrix)
    return replace(scene, objects=tuple(objects), settings=settings)


def images(dice: Dice) -> Scene:
    """Textures, normal maps and colours of vertices, on maps of every kind."""
    mesh = any_mesh(dice)
    thing = body(dice, with_tangents(painted(dice, mesh) if dice.chance(0.6) else mesh))
    material = replace(
        thing.material,
        texture=texture(dice, PATTERNS) if dice.chance(0.7) else None,
        normal_map=texture(dice, BUMPS) if dice.chance(0.7) else None,
        vertex_colours=dice.chance(0.5),
    )
    return scene_of(dice, replace(thing, material=material), *company(dice))


def lenses(dice: Dice) -> Scene:
    """Views that cut bodies: near ones, wide ones, skewed ones, parallel ones."""
    scene = scene_of(dice, solid(dice, closed(dice)), *company(dice))
    away = dice.between(0.7, 3)
    side = dice.power(-0.5, 0.3)
    window = Window(-side, side * dice.between(0.2, 1), -side * dice.between(-0.5, 1), side)
    lens = Lens(
        fov_degrees=dice.one_of((60.0, 20.0, 150.0, 179.0)),
        near=away * dice.one_of((1e-4, 0.1, 0.5, 0.9)),
        far=away * dice.one_of((1.1, 2.0, 1e3)),
        clip=ClipSpace(dice.one_of(tuple(DepthRange))),
    )
    skewed = replace(lens, near=away / 2, frustum=window)
    shaped = (lens, replace(lens, ortho=window), skewed)
    return replace(scene, view=view(dice, away), lens=dice.one_of(shaped))


def unseen(dice: Dice) -> Scene:
    """Bodies off the screen, behind the eye and beyond far, which may cast shadows and be lit."""
    scene = scene_of(dice, body(dice, any_mesh(dice)))
    eye = np.array(scene.view.eye, float)
    side = np.cross(eye, dice.direction())
    around = []
    for _ in range(dice.whole(1, 3)):
        at = dice.one_of((eye * 2, side, -side * 2, -eye * 20, eye * 0.6, -eye))
        there = World(translate=tuple(at.tolist()), rotate_degrees=dice.vector(180))
        around.append(solid(dice, closed(dice), there))
    lights = tuple(replace(one, shadows=dice.chance(0.6)) for one in scene.lights)
    return replace(scene, objects=(*scene.objects, *around), lights=lights)


def shadows(dice: Dice) -> Scene:
    """Lamps above a floor, high and grazing, with things between or alone."""
    floor = solid(dice, plane(2), World(translate=(0, -1, 0), scale=(3, 1, 3)))
    things = [body(dice, any_mesh(dice)) for _ in range(dice.whole(0, 2))]
    lights = []
    for one in lamps(dice, dice.whole(1, 4)):
        (x, y, z), height = one.position, dice.one_of((1.0, 1.0, 0.2, 0.02))
        (across, down, along) = one.direction
        lights.append(
            replace(
                one,
                shadows=True,
                position=(x, height * (abs(y) + 0.5) - (1 - height), z),
                direction=(across, -height * abs(down), along),
                intensity=0.8,
            )
        )
    scene = scene_of(dice, floor, *things, lights=tuple(lights))
    return replace(scene, view=View(eye=(dice.between(-3, 3), dice.between(0, 4), 5)))


def foggy(dice: Dice) -> Scene:
    """Fog that ends before everything, begins behind everything, or lies between."""
    scene = scene_of(dice, *(body(dice, closed(dice)) for _ in range(dice.whole(1, 3))))
    start = dice.one_of((0.0, dice.between(0, 8), 100.0))
    fog = Fog(colour(dice), start, start + dice.one_of((1e-6, 0.5, 4.0, 1e4)))
    return replace(scene, settings=replace(scene.settings, fog=fog))


def shiny(dice: Dice) -> Scene:
    """Highlights of every width, bands and outlines, next to a turn and far from one."""
    off = dice.one_of((0.0, dice.power(-9, -2), 1.0))
    where = World(
        translate=dice.vector(0.3), rotate_degrees=dice.vector(180), scale=(1, 1 + off, 1)
    )
    thing = solid(dice, any_mesh(dice), where)
    material = replace(
        thing.material,
        reflection=dice.one_of((Reflection.PHONG, Reflection.BLINN_PHONG, Reflection.TOON)),
        shininess=dice.one_of((0.0, 0.1, 0.99, 1.0, 2.0, 30.0, 1000.0)),
        outline=dice.between(0, 1) if dice.chance(0.3) else 0.0,
    )
    return scene_of(dice, replace(thing, material=material), lights=lamps(dice, dice.whole(1, 3)))


def straight(dice: Dice) -> Scene:
    """Round numbers: edges that pass through samples, light along faces, cosines of one half."""
    turns, axes = (0, 0, 0, 30, 45, 60, 90, 180), ((0, -1, 0), (1, 0, 0), (0, -1, -1), (-1, -1, -1))
    things = []
    for at in range(dice.whole(1, 2)):
        where = World(
            translate=(2.0 * at, 0, -at),
            rotate_degrees=(dice.one_of(turns), dice.one_of(turns), dice.one_of((0, 0, 90))),
            scale=grey(dice.one_of((1.0, 1.0, 0.5, 2.0))),
        )
        thing = solid(dice, dice.one_of((box(2), plane(2), sphere(6, 8), torus(4, 8))), where)
        material = replace(
            thing.material,
            texture=CHECKER if dice.chance(0.5) else None,
            toon_steps=2,
            shininess=dice.one_of((0.0, 1.0, 20.0)),
        )
        things.append(replace(thing, material=material))
    lights = tuple(
        replace(
            one,
            direction=dice.one_of(axes),
            position=tuple(-2.0 * x for x in dice.one_of(axes)),
            fixed_to=WORLD,
            cone_degrees=dice.one_of(((30.0, 30.0), (45.0, 60.0), (90.0, 90.0))),
        )
        for one in lamps(dice, dice.whole(1, 3))
    )
    scene = scene_of(dice, *things, lights=lights)
    size = dice.one_of(((31, 31), (32, 32), (33, 33)))
    settings = replace(scene.settings, size=size, depth=DepthBuffer.FULL)
    eye = dice.one_of(((0, 0, 4), (0, 0, 5), (0, 3, 4), (4, 4, 4)))
    side = dice.one_of((1.0, 2.0, 17 / 8))
    window = Window(-side, side, -side, side)
    ahead = (Lens(fov_degrees=90), Lens(near=1, ortho=window), Lens(near=2, frustum=window))
    return replace(scene, view=View(eye=eye), lens=dice.one_of(ahead), settings=settings)


def thin(dice: Dice) -> Scene:
    """Bodies all but flat: front and back nearly in one place."""
    thickness = dice.power(-6, -1)
    scale = dice.one_of(((1, thickness, 1), (1, thickness, 0.5), (thickness, 1, 1)))
    where = World(translate=dice.vector(0.3), rotate_degrees=dice.vector(180), scale=scale)
    scene = scene_of(dice, solid(dice, closed(dice), where), *company(dice))
    lens = replace(scene.lens, near=dice.one_of((0.1, 1.0, dice.power(-6, -1))))
    return replace(scene, lens=lens, settings=replace(scene.settings, depth=DepthBuffer.FULL))


def small(dice: Dice) -> Scene:
    """Bodies of a pixel or less, more finely cut than the canvas can tell apart."""
    meshes = (sphere(16, 32), torus(12, 24), box(8), closed(dice))
    things = []
    for _ in range(6):
        size = grey(dice.power(-2.5, -0.5))
        there = World(translate=dice.vector(1.2), rotate_degrees=dice.vector(180), scale=size)
        things.append(solid(dice, dice.one_of(meshes), there))
    scene = scene_of(dice, *things)
    return replace(scene, settings=replace(scene.settings, depth=DepthBuffer.FULL))


KINDS: dict[str, Callable[[Dice], Scene]] = {
    one.__name__: one
    for one in (
        room,
        inside_out,
        shells,
        crossing_itself,
        open_meshes,
        ruined_meshes,
        wild_normals,
        near_lamps,
        spots,
        many_lamps,
        weak_lamps,
        huge_floors,
        under_parents,
        nearly_rigid,
        images,
        lenses,
        unseen,
        shadows,
        foggy,
        shiny,
        straight,
        thin,
        small,
    )
}
