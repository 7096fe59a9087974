"""A proof's settings and its result, and the scenes that it draws on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any, assert_never

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Reflection
from nmatrix.linear.affine import rotation_about_axis
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import (
    RationalMatrix,
    affine_matrix,
    apply,
    identity,
    linear_part,
    rational_vector,
)
from nmatrix.raster.image import levels, png
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.planning.plan import Plan, plan_for
from nmatrix.raster.proofs.catalogue import Turn, Turning
from nmatrix.raster.render import Change, Rendered, Work, render
from nmatrix.report import Value
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import Geometry, LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

Array = NDArray[Any]

SPHERE = ShapeGeometry(Shape.SPHERE)
TORUS = ShapeGeometry(Shape.TORUS)
SUN = SceneLight("sun", LightKind.DIRECTIONAL)
IDENTITY = identity(4)


@dataclass(frozen=True)
class ProofSettings:
    """A proof's settings: the object and its place, the camera, the light, the picture.

    `mesh` is None for the proof's own shape, `world` None for its own map, and `view` None for a
    camera that is fitted to what is drawn. `object_turn` turns the object in the world. `clock`
    tells seconds; by default it is always 0.
    """

    subject: str
    mesh: Mesh | None = None
    world: World | None = None
    view: View | None = None
    lens: Lens = field(default_factory=Lens)
    lights: tuple[SceneLight, ...] = (SUN,)
    picture: Settings = field(default_factory=Settings)
    reflection: Reflection = Reflection.LAMBERT
    object_turn: RationalMatrix = IDENTITY
    clock: Callable[[], float] = float

    def turned(self, turn: Turn, degrees: float) -> ProofSettings:
        """Return the settings with one thing turned from where it was."""
        rotation = affine_matrix(rotation_about_axis(turn.axis, Angle.degrees(degrees)))
        match turn.what:
            case Turning.OBJECT:
                return replace(self, object_turn=rotation)
            case Turning.EYE:
                return replace(self, picture=replace(self.picture, turn_degrees=degrees))
            case Turning.LIGHT:
                return replace(self, lights=tuple(_turned(one, rotation) for one in self.lights))
        assert_never(turn.what)

    @property
    def still(self) -> ProofSettings:
        """Return the settings before the object or the eye turned."""
        return replace(self, object_turn=IDENTITY, picture=replace(self.picture, turn_degrees=0.0))

    def placed(self, default: World) -> World:
        """Return the world that was asked for, or the proof's own."""
        return self.world or default

    def geometry(self, default: Geometry = SPHERE) -> Geometry:
        """Return the mesh that was given, or the proof's own shape."""
        return default if self.mesh is None else LoadedGeometry(self.mesh)

    def in_turn(self, world: World) -> World:
        """Return an object's place as far around as the object has turned."""
        return world if self.object_turn is IDENTITY else world.under(self.object_turn)

    def scene(self, world: World, geometry: Geometry | None = None, **picture: Any) -> Scene:  # noqa: ANN401  # fields of Settings
        """Return a scene with the one object; `picture` replaces settings of the picture."""
        material = Material(reflection=self.reflection)
        place = self.in_turn(world).world_from_object
        thing = SceneObject(self.subject, geometry or self.geometry(), place, material)
        return self.with_objects(thing, **picture)

    def with_objects(self, *objects: SceneObject, **picture: Any) -> Scene:  # noqa: ANN401  # fields of Settings
        """Return a scene with these objects; `picture` replaces settings of the picture."""
        return Scene(
            objects,
            self.lights,
            self.view or View(),
            self.lens,
            replace(self.picture, **picture),
            has_camera=self.view is not None,
        )


def _turned(light: SceneLight, rotation: RationalMatrix) -> SceneLight:
    """Return a light that has gone some way around the world's origin."""
    position, direction = (
        tuple(map(float, apply(linear_part(rotation), rational_vector(one))))
        for one in (light.position, light.direction)
    )
    return replace(light, position=position, direction=direction)


@dataclass(frozen=True, eq=False)
class Proof:
    """A finished picture and the numbers that it shows."""

    image: Array
    subject: str
    verdict: str
    work: Work
    effects: tuple[str, ...]
    numbers: Mapping[str, Value] = field(default_factory=dict)
    max_angle_error_deg: float | None = None
    mean_angle_error_deg: float | None = None
    max_level_difference: int = 0
    remarks: tuple[str, ...] = ()

    @classmethod
    def of(
        cls,
        subject: str,
        image: Array,
        verdict: str,
        drawn: Sequence[DrawnScene],
        **measured: Any,  # noqa: ANN401  # the other fields
    ) -> Proof:
        """Return the proof that scenes make: the work of all, effects and remarks of the last."""
        works = (asdict(one.rendered.work).values() for one in drawn)
        work, last = Work(*map(sum, zip(*works, strict=True))), drawn[-1]
        remarks = (*last.plan.remarks, *last.rendered.remarks)
        return cls(image, subject, verdict, work, last.effects, remarks=remarks, **measured)

    @property
    def texts(self) -> dict[str, str]:
        """Return what a file of the picture tells beside it: its numbers, never a time."""
        return {
            "Title": f"nmatrix {self.subject}",
            "Description": self.verdict,
            "max_angle_error_deg": repr(self.max_angle_error_deg),
            "mean_angle_error_deg": repr(self.mean_angle_error_deg),
            "max_level_difference": str(self.max_level_difference),
            **{name: str(count) for name, count in asdict(self.work).items()},
            **{k: repr(v) for k, v in self.numbers.items() if not k.startswith("milliseconds")},
        }

    def png(self) -> bytes:
        """Return the picture as a PNG file, its numbers in text chunks."""
        return png(self.image, self.texts)


@dataclass(frozen=True, eq=False)
class DrawnScene:
    """A scene that was drawn: its plan, and the picture."""

    plan: Plan
    rendered: Rendered

    @property
    def loaded(self) -> LoadedScene:
        """Return the loaded scene."""
        return self.plan.loaded

    @cached_property
    def levels(self) -> Array:
        """Return the 8-bit image (height, width, 3)."""
        return levels(self.rendered.rgb)

    @property
    def effects(self) -> tuple[str, ...]:
        """Return the names of the effects that were on, in the order of the table."""
        return tuple(one.value for one in Effect if one in self.plan.effects)

    def redrawn(self, change: Change) -> DrawnScene:
        """Draw the scene again with its surfaces changed."""
        return DrawnScene(self.plan, render(self.plan, change=change))


def drawn_scene(scene: Scene, **settings: Any) -> DrawnScene:  # noqa: ANN401  # fields of Settings
    """Draw a scene by its plan; `settings` replace those of the scene."""
    changed = replace(scene, settings=replace(scene.settings, **settings))
    return drawn_plan(plan_for(loaded(changed)))


def drawn_plan(plan: Plan) -> DrawnScene:
    """Draw the scene of a plan."""
    return DrawnScene(plan, render(plan))


def level_difference(a: DrawnScene, b: DrawnScene) -> int:
    """Return the largest difference of two pictures, in 8-bit levels."""
    return int(np.abs(a.levels.astype(int) - b.levels).max())
