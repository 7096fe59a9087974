"""A proof's settings and its result, and the scenes that it draws on the way."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from functools import cached_property
from typing import Any, assert_never

from numpy.typing import NDArray

from nmatrix.canvas.paint import pixels, vector
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.text import plain
from nmatrix.enums import PixelFormat, Reflection, Theme, VectorFormat
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
from nmatrix.raster.drawn_scene import DrawnScene
from nmatrix.raster.image import picture_file
from nmatrix.raster.proofs.catalogue import Turn, Turning
from nmatrix.raster.render import Work
from nmatrix.report import Value
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import Geometry, LoadedGeometry, ShapeGeometry
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import Material, grey
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import FileFeature, Scene, SceneObject, Settings
from nmatrix.scene.words import LightKind, Shape
from nmatrix.scene.world import World

Array = NDArray[Any]

SPHERE = ShapeGeometry(Shape.SPHERE)
SUN = SceneLight("sun", LightKind.DIRECTIONAL)
IDENTITY = identity(4)
SHEET = (1600, 900)  # pixels
AMBIENT, DIFFUSE = (0.19, 0.24, 0.36), (0.79, 0.66, 0.44)
PRINTED_AMBIENT, PRINTED_DIFFUSE = grey(0.24), grey(0.68)


@dataclass(frozen=True)
class ProofSettings:
    """A proof's settings: the object and its place, the camera, the light, the picture.

    What is None is the proof's own: its shape, its map, a camera that is fitted to what is drawn,
    its light. The size of `picture` is that of the whole sheet. `object_turn` turns the object in
    the world. `clock` tells seconds; by default it is always 0.
    """

    subject: str
    mesh: Mesh | None = None
    world: World | None = None
    view: View | None = None
    lens: Lens = field(default_factory=Lens)
    lights: tuple[SceneLight, ...] | None = None
    picture: Settings = field(default_factory=lambda: Settings(size=SHEET))
    reflection: Reflection | None = None
    theme: Theme = Theme.LIGHT
    object_turn: RationalMatrix = IDENTITY
    light_turn: RationalMatrix = IDENTITY
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
                return replace(self, light_turn=rotation)
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

    @property
    def is_moving(self) -> bool:
        """True for a frame of an animation in which the object turns, the first included."""
        return self.object_turn is not IDENTITY

    def lit_by(self, *lights: SceneLight) -> tuple[SceneLight, ...]:
        """Return the lights that were asked for, or the proof's own, as far as they have turned."""
        return tuple(turned_light(one, self.light_turn) for one in self.lights or lights)

    def material(self, **changes: Any) -> Material:  # noqa: ANN401  # fields of Material
        """Return the surface of every proof: warm where light falls, cool where none does."""
        own = Material(
            ambient=PRINTED_AMBIENT if self.theme is Theme.PRINT else AMBIENT,
            diffuse=PRINTED_DIFFUSE if self.theme is Theme.PRINT else DIFFUSE,
            reflection=self.reflection or Reflection.LAMBERT,
        )
        return replace(own, **changes)

    def object(
        self,
        world: World,
        geometry: Geometry | None = None,
        **material: Any,  # noqa: ANN401  # fields of Material
    ) -> SceneObject:
        """Return the object of the proof under a map, as far around as it has turned."""
        place = self.in_turn(world).world_from_object
        return SceneObject(
            self.subject, geometry or self.geometry(), place, self.material(**material)
        )

    def scene(self, *objects: SceneObject, lights: tuple[SceneLight, ...] = (SUN,)) -> Scene:
        """Return a scene with these objects under the proof's light, not yet under a camera."""
        return Scene(objects, self.lit_by(*lights), settings=self.picture, has_camera=False)

    def slide(self, title: str) -> Slide:
        """Begin the picture of a proof with its claim."""
        return Slide.of(title, self.picture.size, self.theme)


def turned_light(light: SceneLight, rotation: RationalMatrix) -> SceneLight:
    """Return a light that has gone some way around the world's origin."""
    position, direction = (
        tuple(map(float, apply(linear_part(rotation), rational_vector(one))))
        for one in (light.position, light.direction)
    )
    return replace(light, position=position, direction=direction)


@dataclass(frozen=True, eq=False)
class Proof:
    """A finished picture and the numbers that it shows: a slide, or an image of a scene."""

    picture: Slide | Array
    subject: str
    verdict: str
    work: Work
    effects: tuple[str, ...]
    numbers: Mapping[str, Value] = field(default_factory=dict)
    max_angle_error_deg: float | None = None
    mean_angle_error_deg: float | None = None
    max_level_difference: int = 0
    remarks: tuple[str, ...] = ()
    features: tuple[FileFeature, ...] = ()

    @classmethod
    def of(
        cls,
        subject: str,
        picture: Slide | Array,
        verdict: str,
        drawn: Sequence[DrawnScene],
        **measured: Any,  # noqa: ANN401  # the other fields
    ) -> Proof:
        """Return the proof that scenes make: the work of all, effects and remarks of the last."""
        works = (asdict(one.rendered.work).values() for one in drawn)
        work, last = Work(*map(sum, zip(*works, strict=True))), drawn[-1]
        remarks = (*last.plan.remarks, *last.rendered.remarks)
        return cls(picture, subject, verdict, work, last.effects, remarks=remarks, **measured)

    @property
    def is_slide(self) -> bool:
        """True if its lines and letters can be written as such."""
        return isinstance(self.picture, Slide)

    @cached_property
    def image(self) -> Array:
        """Return the picture as 8-bit levels (height, width, 3)."""
        return pixels(self.picture.canvas) if isinstance(self.picture, Slide) else self.picture

    def file(self, kind: PixelFormat | VectorFormat) -> bytes:
        """Return the picture as a file with its numbers inside; only a slide has vectors."""
        if isinstance(kind, PixelFormat):
            return picture_file([self.image], self.texts, kind)
        assert isinstance(self.picture, Slide)  # whoever asks knows
        return vector(self.picture.canvas, kind, self.texts)

    @property
    def texts(self) -> dict[str, str]:
        """Return what a file of the picture tells beside it: its numbers, never a time."""
        title = plain(self.picture.title) if isinstance(self.picture, Slide) else self.subject
        return {
            "Title": title,
            "Description": self.verdict,
            "max_angle_error_deg": repr(self.max_angle_error_deg),
            "mean_angle_error_deg": repr(self.mean_angle_error_deg),
            "max_level_difference": str(self.max_level_difference),
            **{name: str(count) for name, count in asdict(self.work).items()},
            **{k: repr(v) for k, v in self.numbers.items() if not k.startswith("milliseconds")},
        }
