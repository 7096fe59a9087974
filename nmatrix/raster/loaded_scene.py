"""The loaded scene: a scene with its triangles loaded and its lights in place, ready for a picture.

Nothing is decided here; what must be computed is the plan's business.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Frame, NormalRule, Shading
from nmatrix.errors import MissingPackageError, NoAnswerError, printable, quantity
from nmatrix.linear import rational
from nmatrix.linear.affine import rotation_about, translation_matrix
from nmatrix.linear.angle import Angle
from nmatrix.linear.classify import FROM_FILE, Classification, classify
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import RationalMatrix, RationalVector, rational_vector, to_floats
from nmatrix.linear.rules import NormalTransform, normal_transform
from nmatrix.raster.triangles.convex import Convex, box_around, frustum
from nmatrix.raster.triangles.products import chunks, multiply
from nmatrix.raster.triangles.spans import Canvas
from nmatrix.scene.fitting import Ball, Facets, daylight, enclosing, fitted, octant
from nmatrix.scene.geometry import DamagedPartError, left_out
from nmatrix.scene.images import Room, has_alpha, with_readable_images
from nmatrix.scene.light import EYE, WORLD, PlacedLight, SceneLight
from nmatrix.scene.material import WHITE, Colour, Material
from nmatrix.scene.meshes.mesh import MADE_SMOOTH, Mesh
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Sides
from nmatrix.spaces.exact_maps import ExactMaps, WorldLight
from nmatrix.spaces.transform import Transform

Array = NDArray[Any]

MOST_FACETS, MOST_ASKED = 512, 64  # triangles of a body, and bodies, that place a fitted camera
SMOOTH = (
    "Made normals are smooth across every edge, so sides that meet in one shade into each other: "
    f"if it is meant to be sharp, try {quantity('shading')} {Shading.FLAT}."
)
FARTHEST = 1e100  # squares of longer lengths leave float64


@dataclass(frozen=True, eq=False)
class Body:
    """One object, its triangles in object space."""

    name: str
    mesh: Mesh
    world_from_object: Transform
    material: Material
    _normal_transforms: dict[NormalRule, NormalTransform | None] = field(
        default_factory=dict, init=False
    )

    @cached_property
    def matrix(self) -> Array:
        """Return `world_from_object` (4, 4), each entry rounded once."""
        return np.array(self.world_from_object.matrix)

    @cached_property
    def linear(self) -> Array:
        """Return the 3×3 block of the matrix."""
        return self.matrix[:3, :3].copy()

    def normal_transform(self, rule: NormalRule) -> NormalTransform | None:
        """Build the transform that carries normals to the world by a rule, once; None if none can.

        The plan, the picture and its proof ask for it, each for all bodies.
        """
        if rule not in self._normal_transforms:
            found = normal_transform(rule, self.world_from_object.exact)
            self._normal_transforms[rule] = found
        return self._normal_transforms[rule]

    @cached_property
    def linear_map(self) -> LinearMap:
        """Return the 3×3 block of `world_from_object` at the exact level."""
        return self.world_from_object.linear_map

    @cached_property
    def kind(self) -> Classification:
        """Classify the map that places the body; files hold float32 numbers."""
        return classify(self.world_from_object.exact, FROM_FILE)

    def parts_world(self) -> Iterator[Array]:
        """Yield the vertices in the world, some at a time (3, n), so that memory is bounded."""
        M = self.matrix[:3]
        for part in chunks(self.mesh.positions.T):
            with np.errstate(over="ignore", invalid="ignore"):
                yield multiply(M, part)

    @property
    def positions_world(self) -> Array:
        """Return the vertices (V, 3) in the world."""
        return np.concatenate([part.T for part in self.parts_world()])

    @cached_property
    def box(self) -> tuple[Array, Array]:
        """Return the lowest and the highest coordinates in the world.

        Raises
        ------
        NoAnswerError
            If they are so far or so small that squares of their lengths leave float64.
        """
        boxes = [(part.min(axis=1), part.max(axis=1)) for part in self.parts_world()]
        low = np.min([one for one, _ in boxes], axis=0)
        high = np.max([one for _, one in boxes], axis=0)
        reach = float(np.abs([low, high]).max())
        if not reach <= FARTHEST or 0 < reach < 1 / FARTHEST:
            raise NoAnswerError(
                f"{self.name} (it reaches {reach:.3g} in the world)",
                "a picture can be computed between 1e-100 and 1e+100",
                "scale the scene",
            )
        return low, high

    @cached_property
    def centre(self) -> Array:
        """Return the middle of the box around the body in the world."""
        low, high = self.box
        return np.asarray((low + high) / 2)

    @cached_property
    def radius(self) -> float:
        """Return the radius of a ball around the centre that holds the body."""
        middle = self.centre[:, None]
        return float(np.sqrt(max(((p - middle) ** 2).sum(0).max() for p in self.parts_world())))

    @cached_property
    def hull(self) -> Convex:
        """Return the box of the object's own axes, carried to the world."""
        return box_around(*self.mesh.box, self.matrix)

    @cached_property
    def sagitta(self) -> float:
        """Return the most that the surface of its normals rises above its triangles."""
        return self.mesh.sagitta * float(np.linalg.norm(self.linear, 2))

    @cached_property
    def thickness(self) -> float:
        """The least spread of the vertices about their middle in the world, a root mean square.

        It is 0 where it is less than 1e-8 of the largest: its square is lost in rounding there.
        """
        A = self.linear
        spread = np.linalg.eigvalsh(A @ self.mesh.spread @ A.T)
        return float(np.sqrt(spread[0])) if spread[0] > 1e-16 * spread[2] else 0.0

    @cached_property
    def facets(self) -> Facets:
        """Some of the triangles in the world, from all over the mesh."""
        few = self.mesh.triangles[:: 1 + len(self.mesh.triangles) // MOST_FACETS]
        A = self.linear
        a, b, c = (A @ self.mesh.positions.take(corner, 0).T for corner in few.T)
        areas = np.cross(b - a, c - a, axis=0) * (self.linear_map.determinant_sign or 1)
        return Facets(areas / 2, self.material.sides is Sides.FRONT)

    @cached_property
    def texture_has_alpha(self) -> bool:
        """True if the texture brings an opacity that counts, and the mesh coordinates for it."""
        found = self.material.texture
        counts = self.material.has_alpha and found is not None and self.mesh.uv is not None
        return counts and found is not None and has_alpha(found)

    @property
    def vertices_have_alpha(self) -> bool:
        """True if the vertices' colours bring an opacity that counts."""
        material, colours = self.material, self.mesh.colours
        counts = material.has_alpha and material.vertex_colours
        return counts and colours is not None and colours.shape[1] == 4

    @property
    def ball(self) -> Ball:
        """Return the centre and the radius of a ball that holds the body."""
        return self.centre, self.radius


@dataclass(frozen=True, eq=False)
class LoadedScene:
    """Bodies, lights, one camera, which was fitted if the scene has none, and the canvas."""

    bodies: tuple[Body, ...]
    lights: tuple[PlacedLight, ...]
    camera_from_world: Transform
    eye: RationalVector
    clip_from_camera: RationalMatrix
    clip: ClipSpace
    settings: Settings
    remarks: tuple[str, ...] = ()
    is_fitted: bool = False

    @property
    def canvas(self) -> Canvas:
        """Return the canvas."""
        width, height = self.settings.size
        return Canvas(width, height, round(self.settings.samples**0.5))

    @cached_property
    def ambient_light(self) -> Colour:
        """Return the light that comes from everywhere: white if the scene says nothing of it.

        Materials say how much of it they send back.
        """
        found = [one.colour for one in self.lights if one.light.kind is LightKind.AMBIENT]
        red, green, blue = map(sum, zip(*found, strict=True)) if found else WHITE
        return red, green, blue

    @cached_property
    def clip_from_world(self) -> RationalMatrix:
        """Return P · V exactly."""
        return rational.product(self.clip_from_camera, self.camera_from_world.exact)

    @cached_property
    def frustum(self) -> Convex:
        """Return what the camera sees of the world."""
        clip_from_world = np.array(to_floats(self.clip_from_world))
        world_from_clip = np.array(to_floats(rational.inverse(self.clip_from_world)))
        return frustum(clip_from_world, world_from_clip, self.clip.depth)

    def clip_from_object(self, body: Body) -> RationalMatrix:
        """Return P · V · M exactly."""
        return rational.product(self.clip_from_world, body.world_from_object.exact)

    def maps(self, body: Body) -> ExactMaps:
        """Return the exact maps of one body, from which every shading space follows."""
        custom = self.settings.space_matrix
        return ExactMaps(
            world_from_object=body.world_from_object,
            camera_from_world=self.camera_from_world,
            clip_from_camera=self.clip_from_camera,
            eye=self.eye,
            light=self._leading_light(),
            custom_from_world=None
            if custom is None
            else Transform(Frame.CUSTOM, Frame.WORLD, custom),
        )

    def _leading_light(self) -> WorldLight:
        """Return the light that light space belongs to: the first that is anywhere."""
        for one in self.lights:
            if one.position is not None or one.direction is not None:
                return WorldLight(one.direction, one.position)
        return WorldLight(rational_vector((0, -1, 0)), None)


def loaded(scene: Scene) -> LoadedScene:
    """Load a scene's triangles and put its lights in place.

    Raises
    ------
    IllegalValueError
        For files that cannot be read, or nothing to draw.
    NoAnswerError
        For a singular object that a light is fixed to, or coordinates beyond 1e+100.
    """
    if scene.refusal is not None:
        raise scene.refusal
    bodies, faults, told = _bodies(scene)
    balls = [body.ball for body in bodies]
    made = dict.fromkeys(one for body in bodies for one in body.mesh.remarks)
    remarks = (*scene.remarks, *left_out(faults), *made, *told)
    if scene.settings.shading is not Shading.FLAT and any(MADE_SMOOTH in one for one in remarks):
        remarks = (*remarks, SMOOTH)
    is_fitted, chosen = not scene.has_camera, daylight(scene)
    if is_fitted:
        signs = octant(scene, [one.facets for one in _largest(bodies)])
        scene, chosen = fitted(scene, balls, signs), daylight(scene, signs)
        remarks = (*remarks, "No camera was given: it was fitted to what is drawn.")
    if not scene.lights:
        scene = replace(scene, lights=(chosen,))
        remarks = (*remarks, f"No light was given: daylight was chosen, along {_typed(chosen)}.")
    camera = scene.view.placed()
    turn = _turn(scene.settings.turn_degrees, balls)
    camera_from_world = Transform(
        Frame.CAMERA, Frame.WORLD, rational.product(camera.camera_from_world, turn)
    )
    eye = Transform(Frame.WORLD, Frame.WORLD, rational.inverse(turn)).exact_point(camera.eye)
    placed = {body.name: body.world_from_object for body in reversed(bodies)}
    placed[WORLD] = Transform(Frame.WORLD, Frame.WORLD, rational.identity(4))
    if any(light.fixed_to == EYE for light in scene.lights):
        placed[EYE] = camera_from_world.inverse()
    return LoadedScene(
        bodies,
        tuple(_placed(light, placed[light.fixed_to]) for light in scene.lights),
        camera_from_world,
        eye,
        scene.lens.clip_from_camera,
        scene.lens.clip,
        scene.settings,
        (*remarks, *camera.remarks),
        is_fitted,
    )


def _largest(bodies: Sequence[Body]) -> list[Body]:
    """Return the largest of many bodies: they decide where the eye stands."""
    return sorted(bodies, key=lambda one: -one.radius)[:MOST_ASKED]


def _turn(degrees: float, balls: Sequence[Ball]) -> RationalMatrix:
    """Return the map that turns the world before a camera that stays: the camera walks around."""
    if not degrees:
        return rational.identity(4)
    middle, _ = enclosing(balls)
    back = translation_matrix((-middle).tolist())
    turned = rational.affine_matrix(rotation_about("Y", Angle.degrees(-degrees)))
    return rational.product(translation_matrix(middle.tolist()), turned, back)


def _bodies(scene: Scene) -> tuple[tuple[Body, ...], list[DamagedPartError], list[str]]:
    """Load the objects, instances with one mesh; those that cannot be drawn are faults.

    What their materials could not bring along is told.

    Raises
    ------
    DamagedPartError
        If there are objects, and none of them can be drawn.
    MissingPackageError
        If a package would help.
    """
    meshes: dict[int, Mesh | DamagedPartError] = {}
    materials: dict[int, tuple[Material, list[str]]] = {}  # an image that many share is read once
    room = Room()
    bodies, told = [], []
    for one in scene.objects:
        key = id(one.geometry)
        if key not in meshes:
            try:
                meshes[key] = one.geometry.mesh()
            except DamagedPartError as error:
                meshes[key] = error
        mesh = meshes[key]
        if isinstance(mesh, Mesh):
            if id(one.material) not in materials:
                materials[id(one.material)] = with_readable_images(one.material, room)
            body, remarks = _body(one, mesh, *materials[id(one.material)])
            bodies.append(body)
            told += remarks
    faults = [one for one in meshes.values() if isinstance(one, DamagedPartError)]
    if faults and not bodies:
        packages = [one.cause for one in faults if isinstance(one.cause, MissingPackageError)]
        raise packages[0] if packages else faults[0]
    return tuple(bodies), faults, [*dict.fromkeys(told)]


def _body(
    one: SceneObject, mesh: Mesh, material: Material, remarks: list[str]
) -> tuple[Body, list[str]]:
    """Put an object in its place, with as much of its material as can be drawn."""
    place = Transform(Frame.WORLD, Frame.OBJECT, one.world_from_object)
    told = [*remarks]
    if material.emission_texture is not None and mesh.uv is None:
        material = replace(material, emission_texture=None)
        told.append(
            f"emission_texture of material {printable(material.name)} changes nothing on "
            f"{printable(one.name)}: the mesh has no texture coordinates."
        )
    found = Body(one.name, mesh, place, material)
    if material.has_alpha and not (found.texture_has_alpha or found.vertices_have_alpha):
        found = replace(found, material=replace(material, has_alpha=False))
    return found, told


def _typed(light: SceneLight) -> str:
    return " ".join(map(str, light.direction))


def _placed(light: SceneLight, world_from_home: Transform) -> PlacedLight:
    position = direction = None
    if light.has_position:
        position = world_from_home.exact_point(rational_vector(light.position))
    if light.has_direction:
        direction = world_from_home.exact_vector(rational_vector(light.direction))
        if not any(direction):
            raise NoAnswerError(
                f"light {light.name}",
                f"{light.fixed_to} flattens its direction to nothing",
                "fix it to the world",
            )
    return PlacedLight(light, position, direction)
