"""The scene: objects with materials, lights, one camera, and how to draw them; frozen."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path

from nmatrix.enums import Effort, NormalRule, Shading, Space
from nmatrix.errors import IllegalValueError, NMatrixError, quantity
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.values import number, read_fields, vector
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import Geometry
from nmatrix.scene.hierarchy import Hierarchy
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.material import DEFAULT_MATERIAL, WHITE, Colour, Material, grey
from nmatrix.scene.words import DepthBuffer, Mover
from nmatrix.scene.world import World


@dataclass(frozen=True)
class SceneNode:
    """A place that has a name, with triangles or without.

    `place`, `world_from_parent`: as of a `SceneObject`; `parent` is the index of the node above.
    `movers` are what moves it or its mesh beside its matrix, which is that at rest.
    """

    name: str
    world_from_object: RationalMatrix
    place: World | None = None
    world_from_parent: RationalMatrix | None = None
    parent: int | None = None
    movers: tuple[Mover, ...] = ()


@dataclass(frozen=True)
class SceneObject:
    """One object: its triangles, its place in the world, its material.

    `place` and `world_from_parent` are what the file says of that place, where it says it in parts:
    world_from_object is their product. `node` is the index of its node in the scene, which may have
    several objects.
    """

    name: str
    geometry: Geometry
    world_from_object: RationalMatrix
    material: Material = DEFAULT_MATERIAL
    place: World | None = None
    world_from_parent: RationalMatrix | None = None
    node: int | None = None


@dataclass(frozen=True)
class FileFeature:
    """Something that a file has, how much of it, and what a picture makes of it."""

    feature: str
    count: int
    made_of_it: str


@dataclass(frozen=True)
class Fog:
    """Fog that grows linearly with the distance to the eye: none at `start`, all at `end`."""

    color: Colour
    start: float
    end: float


SAMPLES = (1, 4, 16, 64)  # of a pixel
LARGEST = 8192  # pixels on a side
DARK_LEVEL = 0.1  # of a background on which white stands out, its shaded side too
MOST_SAMPLES = 1 << 28


@dataclass(frozen=True)
class Settings:
    """How a scene is drawn.

    `samples` are those of one pixel: 1, 4, 16 or 64. `gamma` writes sRGB instead of linear levels.
    `other_background` takes the place of `background` if what is drawn stands out better from it.
    `turn_degrees` walks the camera around the middle of what is drawn, about the world's y axis.
    `normals` is the rule that carries them; every one but the first is a mistake worth seeing.
    """

    space: Space = Space.WORLD
    space_matrix: RationalMatrix | None = None
    shading: Shading = Shading.PHONG
    size: tuple[int, int] = (512, 512)
    samples: int = 4
    background: Colour = (0.93, 0.93, 0.93)
    other_background: Colour | None = None
    fog: Fog | None = None
    gamma: bool = False
    depth: DepthBuffer = DepthBuffer.FULL
    shadow_map: int = 512
    normals: NormalRule = NormalRule.EXACT
    effort: Effort = Effort.PLANNED
    turn_degrees: float = 0.0

    def __post_init__(self) -> None:
        read_fields(self, size=_read_size, samples=_read_samples)
        width, height = self.size
        if width * height * self.samples > MOST_SAMPLES:
            raise IllegalValueError(
                f"{quantity('size')} {width} {height} with {self.samples} samples",
                f"a picture has {MOST_SAMPLES} samples at the most",
                "take fewer of either",
            )


def settings_of_file(*, gamma: bool, size: tuple[int, int] = Settings.size) -> Settings:
    """Return the settings of a file that says nothing of its background: white, or else dark."""
    dark = (DARK_LEVEL + 0.055) / 1.055 if gamma else DARK_LEVEL
    other = grey(dark**2.4 if gamma else dark)
    return Settings(size=size, gamma=gamma, background=WHITE, other_background=other)


def _read_size(size: object, name: str) -> tuple[int, int]:
    width, height = vector(size, name, size=2)
    sides = f"{quantity(name)} ({width:g} {height:g})"
    if not all(float(side).is_integer() and side >= 1 for side in (width, height)):
        why = "both sides are whole numbers of pixels, 1 at least"
        raise IllegalValueError(sides, why, "try 360 360")
    if max(width, height) > LARGEST:
        raise IllegalValueError(sides, f"a side has {LARGEST} pixels at the most", "try 1024 1024")
    return int(width), int(height)


def _read_samples(samples: object, name: str) -> int:
    found = number(samples, name)
    if found not in SAMPLES:
        why, next_step = "a pixel has 1, 4, 16 or 64", f"try {quantity(name)} 4"
        raise IllegalValueError(f"{quantity(name)} ({samples})", why, next_step)
    return int(found)


@dataclass(frozen=True)
class Scene:
    """Everything that a scene file says.

    Without lights it is drawn in daylight. `has_camera` tells whether the file chose the view; if
    not, it is fitted to what is drawn.
    `has_aspect` tells whether it chose the lens's width over height; if not, the picture's is used.
    Where it `is_framed` for its own, a picture of another shape shows all of it and more.
    `features` count what an asset's file has. `nodes` are all places that have a name; `refusal` is
    why nothing of it can be drawn, if so.
    """

    objects: tuple[SceneObject, ...]
    lights: tuple[SceneLight, ...] = ()
    view: View = field(default_factory=View)
    lens: Lens = field(default_factory=Lens)
    settings: Settings = field(default_factory=Settings)
    has_camera: bool = True
    has_aspect: bool = False
    is_framed: bool = False
    path: Path | None = None
    remarks: tuple[str, ...] = ()
    nodes: tuple[SceneNode, ...] = ()
    features: tuple[FileFeature, ...] = ()
    refusal: NMatrixError | None = None

    @cached_property
    def hierarchy(self) -> Hierarchy:
        """The nodes by name."""
        return Hierarchy(
            tuple(node.name for node in self.nodes), tuple(node.parent for node in self.nodes)
        )

    def sized(self, width: int, height: int) -> Scene:
        """Return the scene at another size, with the lens's aspect to match if it is free.

        Examples
        --------
        >>> Scene(()).sized(640, 320).lens.aspect
        2.0
        """
        remarks = (*self.remarks, *self.framing_remarks(width / height))
        settings = replace(self.settings, size=(width, height))
        return replace(self, lens=self.lens_for(width / height), settings=settings, remarks=remarks)

    def lens_for(self, aspect: float) -> Lens:
        """Adapt the lens to a picture's width over height."""
        if self.has_aspect:
            return self.lens
        return self.lens.framing(aspect) if self.is_framed else replace(self.lens, aspect=aspect)

    def framing_remarks(self, aspect: float) -> tuple[str, ...]:
        """Tell that a picture of this width over height shows more than the camera framed."""
        shape = self.lens.shape_of(aspect)
        if not self.is_framed or shape == 1.0:
            return ()
        where = "above and below" if shape > 1.0 else "on both sides"
        own = f"{float(self.lens.aspect_ratio):.4g}"
        return (
            f"The camera is framed for {own} : 1 and the picture is {aspect:.4g} : 1: it shows "
            f"more {where}.",
        )
