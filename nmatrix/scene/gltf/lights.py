"""The lights and the camera of a glTF file, in their places.

A light travels along its node's −z, and a camera looks along it. glTF counts light in candela and
lux and leaves the exposure open: here the brightest light is 1, and light from a place fades as
1 / (1 + d²/r²), where r is the radius of what is drawn: far away that is the inverse square.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import product as iterproduct
from math import degrees, inf

from nmatrix.enums import Handedness
from nmatrix.errors import IllegalValueError, NMatrixError, printable
from nmatrix.linear.projection import Window
from nmatrix.linear.rational import ONE, RationalMatrix, apply, translation
from nmatrix.linear.rounding import nearest
from nmatrix.linear.view import looking_along
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import DamagedPartError
from nmatrix.scene.gltf.document import converted
from nmatrix.scene.gltf.extensions import LIGHTS
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.nodes import Node
from nmatrix.scene.gltf.records import (
    CameraRecord,
    PunctualLight,
    PunctualLights,
    PunctualReference,
)
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.words import LightKind

WIDEST = 90.0  # degrees, of half a cone


@dataclass(frozen=True)
class CarriedLight:
    """A light and the node that carries it."""

    light: PunctualLight
    node: Node


def carried_lights(
    file: GltfFile, drawn: Sequence[int], faults: list[DamagedPartError]
) -> tuple[CarriedLight, ...]:
    """List the lights of the nodes that are drawn; one that cannot be read becomes a fault."""
    if LIGHTS not in file.document.extensions:
        return ()
    found = []
    for index in drawn:
        if LIGHTS in file.document.nodes[index].extensions:
            node = file.nodes[index]
            try:
                found.append(CarriedLight(_light_of(file, node), node))
            except IllegalValueError as error:
                name = f"the light of node {index} ({printable(node.name)})"
                faults.append(DamagedPartError(file.path, name, error))
    return tuple(found)


def _light_of(file: GltfFile, node: Node) -> PunctualLight:
    """Read the light that a node carries.

    Raises
    ------
    IllegalValueError
        For a light that does not exist or is not as the extension says.
    """
    at = converted(node.record.extensions[LIGHTS], PunctualReference, LIGHTS).light
    lights = converted(file.document.extensions[LIGHTS], PunctualLights, LIGHTS).lights
    record = file.entry("light", lights, at)
    light = converted(record, PunctualLight, f"{LIGHTS}.lights[{at}]")
    if light.type not in (LightKind.DIRECTIONAL, LightKind.POINT, LightKind.SPOT):
        raise file.fault(f"a light of type {printable(light.type)} is unknown")
    reach = inf if light.range is None else light.range
    if min(light.color) < 0 or light.intensity < 0 or not reach > 0:
        raise file.fault("its colour, its intensity or its range is below zero")
    if not any(_direction(node)):
        raise file.fault("its node flattens its direction to nothing")
    if light.spot is not None:
        inner, outer = light.spot.inner_cone_angle, light.spot.outer_cone_angle
        if not 0 <= inner <= outer or outer == 0:
            raise file.fault(f"its cone goes from {inner:g} to {outer:g} radians")
    return light


def placed_lights(carried: Sequence[CarriedLight], radius: float) -> tuple[SceneLight, ...]:
    """Put the lights into their places, the brightest with intensity 1."""
    brightest = max((one.light.intensity for one in carried), default=0.0) or 1.0
    names: dict[str, int] = {}
    return tuple(
        _placed(one, brightest, radius, unique(one.light.name or one.node.name, names))
        for one in carried
    )


def unique(name: str, taken: dict[str, int]) -> str:
    """Return the name, or with a number behind it if it is taken.

    Examples
    --------
    >>> taken = {}
    >>> [unique("light", taken) for _ in range(3)]
    ['light', 'light 2', 'light 3']
    """
    count = taken.get(name, 0)
    found = f"{name} {count + 1}" if count else name
    while found in taken:
        count += 1
        found = f"{name} {count + 1}"
    taken[name] = count + 1  # where the next one goes on
    taken.setdefault(found, 1)
    return found


def _direction(node: Node) -> Vector:
    """Find where a node looks, along its −z."""
    ahead = (Fraction(0), Fraction(0), -ONE, Fraction(0))
    return _floats(apply(node.world_from_object, ahead)[:3])


def _placed(one: CarriedLight, brightest: float, radius: float, name: str) -> SceneLight:
    light = one.light
    kind = LightKind(light.type)
    return SceneLight(
        name=name,
        kind=kind,
        position=_floats(translation(one.node.world_from_object)),
        direction=_direction(one.node),
        color=light.color,
        intensity=light.intensity / brightest,
        attenuation=(1.0, 0.0, 0.0)
        if kind is LightKind.DIRECTIONAL
        else (1.0, 0.0, 1.0 / (radius * radius)),
        range=inf if light.range is None else light.range,
        cone_degrees=_cone(light),
    )


def _cone(light: PunctualLight) -> tuple[float, float]:
    if light.spot is None:
        return (0.0, 45.0)
    inner, outer = light.spot.inner_cone_angle, light.spot.outer_cone_angle
    return min(degrees(inner), WIDEST), min(degrees(outer), WIDEST)


def camera(file: GltfFile, node: Node) -> tuple[View, Lens]:
    """Return a node's camera; the node's scale does not matter, as the format says.

    Raises
    ------
    IllegalValueError
        For a camera that does not exist, cannot be read, or sees nothing.
    """
    index = -1 if node.record.camera is None else node.record.camera
    lens = _lens(file.entry("camera", file.document.cameras, index))
    world = node.world_from_object
    back, up = (tuple(row[i] for row in world[:3]) for i in (2, 1))
    if lens is None or not any(back):
        raise file.fault("it sees nothing")
    ahead = tuple(-component for component in back)
    try:
        found = looking_along(translation(world), ahead, up, Handedness.RIGHT)
        _ = lens.clip_from_camera
    except NMatrixError as error:
        raise file.fault(": ".join(error.parts[:2])) from None
    return View(matrix=found.camera_from_world), lens


def _lens(record: CameraRecord) -> Lens | None:
    if record.type == "perspective" and record.perspective is not None:
        seen = record.perspective
        return Lens(
            fov_degrees=degrees(seen.yfov),
            aspect=seen.aspect_ratio or None,
            near=seen.znear,
            far=inf if seen.zfar is None else seen.zfar,
        )
    if record.orthographic is None:
        return None
    box = record.orthographic
    window = Window(-box.xmag, box.xmag, -box.ymag, box.ymag)
    return Lens(ortho=window, near=box.znear, far=box.zfar, aspect=abs(box.xmag / (box.ymag or 1)))


def radius_of(file: GltfFile, places: Sequence[tuple[RationalMatrix, int]]) -> float:
    """Return half the diagonal of what is drawn, by the bounds that the file states; 1 if none.

    `places` are world matrices with the index of a mesh.
    """
    corners = [
        apply(world, (*map(Fraction, corner), ONE))[:3]
        for world, mesh in places
        for bounds in _bounds(file, mesh)
        for corner in corners_of(*bounds)
    ]
    sides = [max(axis) - min(axis) for axis in zip(*corners, strict=True)]
    try:
        found = float(sum(side * side for side in sides)) ** 0.5 / 2
    except OverflowError:
        return 1.0
    return found or 1.0


def corners_of(low: Sequence[float], high: Sequence[float]) -> Iterator[tuple[float, ...]]:
    """Return the eight corners of a box.

    Examples
    --------
    >>> list(corners_of((0, 0, 0), (1, 1, 1)))[-1]
    (1, 1, 1)
    """
    return iterproduct(*zip(low, high, strict=True))


def _bounds(file: GltfFile, mesh: int) -> list[tuple[list[float], list[float]]]:
    found = []
    for primitive in file.document.meshes[mesh].primitives:
        index = primitive.attributes.get("POSITION", -1)
        if 0 <= index < len(file.document.accessors):
            one = file.document.accessors[index]
            if one.min and one.max and len(one.min) == len(one.max) == 3:
                found.append((one.min, one.max))
    return found


def _floats(values: Sequence[Fraction]) -> Vector:
    return tuple(nearest(value) for value in values)
