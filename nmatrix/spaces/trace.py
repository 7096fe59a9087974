"""One vertex on its way: object → world → camera → clip → NDC → window, and which planes cut it.

Every number stays exact until a writer rounds it, so numbers and verdict agree; nothing is divided
by w ≤ 0.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from nmatrix.linear.exact import Normal
from nmatrix.linear.projection import NDC_DEPTH, ClipSpace
from nmatrix.linear.rational import RationalVector, apply, rational_vector
from nmatrix.linear.viewport import Viewport, window_from_ndc
from nmatrix.report import Vector
from nmatrix.spaces.exact_maps import ExactMaps


@dataclass(frozen=True)
class TracedNormal:
    """The vertex's normal in three frames; one that has no image is None, with the reason."""

    object: RationalVector
    world: Normal
    camera: Normal


@dataclass(frozen=True)
class Trace:
    """Where one vertex is in every frame of the pipeline.

    Window y is counted as the interface does, `pixel` always from the top.
    """

    object: RationalVector
    world: RationalVector
    camera: RationalVector
    clip: RationalVector
    ndc: RationalVector | None
    window: RationalVector | None
    pixel: RationalVector | None
    reciprocal_w: Fraction | None
    outside_planes: tuple[str, ...]
    normal: TracedNormal | None

    @property
    def inside(self) -> bool:
        """True if the vertex lies in the view volume, its faces included."""
        return not self.outside_planes


def trace(
    maps: ExactMaps,
    point: Vector,
    normal: Vector | None,
    clip: ClipSpace,
    viewport: Viewport,
) -> Trace:
    """Follow a vertex given in object space, in object units, to window pixels.

    The planes of the view volume are those of the projection in `maps`: a caller who knows it
    exactly, not as its rounded matrix, finds a plane's own points inside.

    Examples
    --------
    >>> from math import inf
    >>> from nmatrix.scene.lens import Lens
    >>> from nmatrix.scene.setup import Setup
    >>> seen = Setup(lens=Lens(fov_degrees=90, near=1, far=inf)).maps  # the eye at 0 0 5
    >>> found = trace(seen, (0, 0, 0), None, ClipSpace(), Viewport(512, 512))
    >>> [float(x) for x in found.clip], [float(x) for x in found.window]
    ([0.0, 0.0, 3.0, 5.0], [256.0, 256.0, 0.8])
    """
    point_object = rational_vector(point)
    point_world = maps.world_from_object.exact_point(point_object)
    point_camera = maps.camera_from_world.exact_point(point_world)
    clip_point = apply(maps.clip_from_camera, (*point_camera, Fraction(1)))
    w = clip_point[3]
    ndc = tuple(component / w for component in clip_point[:3]) if w > 0 else None
    window = None if ndc is None else _window(ndc, clip, viewport)
    return Trace(
        object=point_object,
        world=point_world,
        camera=point_camera,
        clip=clip_point,
        ndc=ndc,
        window=window,
        pixel=None if window is None else viewport.pixel(window, clip),
        reciprocal_w=1 / w if w else None,
        outside_planes=outside_planes(clip_point, clip),
        normal=None if normal is None else _traced_normal(maps, normal),
    )


def outside_planes(point: RationalVector, clip: ClipSpace) -> tuple[str, ...]:
    """List the planes of the view volume that a clip-space point lies beyond, decided exactly."""
    x, y, z, w = point
    y *= clip.y_sign
    at_near, at_far = NDC_DEPTH[clip.depth]
    if at_near > at_far:
        z, at_near, at_far = -z, -at_near, -at_far  # so that depth grows away from the eye
    beyond = {
        "left": x < -w,
        "right": x > w,
        "bottom": y < -w,
        "top": y > w,
        "near": z < at_near * w,
        "far": z > at_far * w,
    }
    return tuple(plane for plane, outside in beyond.items() if outside)


def _window(ndc: RationalVector, clip: ClipSpace, viewport: Viewport) -> RationalVector:
    matrix = window_from_ndc(viewport.width, viewport.height, clip)
    return apply(matrix, (*ndc, Fraction(1)))[:3]


def _traced_normal(maps: ExactMaps, normal: Vector) -> TracedNormal:
    world = maps.world_from_object
    return TracedNormal(
        object=rational_vector(normal),
        world=world.linear_map.normal(normal),
        camera=(maps.camera_from_world @ world).linear_map.normal(normal),
    )
