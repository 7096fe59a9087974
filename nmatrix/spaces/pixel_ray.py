"""A pixel's way back: window → NDC → camera → world → object, as the ray of all that it may show.

Whatever the lens, the points that share x and y in NDC lie on one line of camera space. P⁻¹ takes
the direction of NDC's z to where all such lines meet: the eye of a perspective view, or a direction
of a parallel one. So no case is made of the depth range, of far, or of who built the matrix.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Projected
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.linear.projection import NDC_DEPTH, ClipSpace
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    RationalVector,
    apply,
    determinant,
    inverse,
)
from nmatrix.linear.rounding import integers, short_text, unit
from nmatrix.linear.viewport import Viewport, ndc_depth
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.transform import Transform


@dataclass(frozen=True)
class Ray:
    """Where a ray begins, exactly, and its unit direction, correctly rounded."""

    origin: RationalVector
    direction: tuple[float, ...]


@dataclass(frozen=True)
class PixelRay:
    """What a pixel may show: a ray from the eye, or from the near plane of a parallel view.

    `object` is None where no map leads back to the object; `point_world` and `point_object` are
    known where a depth is.
    """

    projected: Projected
    ndc: RationalVector
    world: Ray
    object: Ray | None
    point_world: RationalVector | None
    point_object: RationalVector | None


def pixel_ray(
    maps: ExactMaps,
    pixel: RationalVector,
    depth: Fraction | None,
    clip: ClipSpace,
    viewport: Viewport,
) -> PixelRay:
    """Follow a pixel, counted from the top, back into the world and the object.

    Raises
    ------
    NoAnswerError
        If the projection or the view flattens space, or what has this depth is infinitely far away.

    Examples
    --------
    >>> from nmatrix.scene.lens import Lens
    >>> from nmatrix.scene.setup import Setup
    >>> seen = Setup(lens=Lens(fov_degrees=90, near=1)).maps  # the eye at 0 0 5
    >>> corner = (Fraction(0), Fraction(0))
    >>> found = pixel_ray(seen, corner, Fraction(0), ClipSpace(), Viewport(64, 64))
    >>> found.world.direction
    (-0.5773502691896257, 0.5773502691896257, -0.5773502691896257)
    >>> [round(float(x), 12) for x in found.point_object]
    [-1.0, 1.0, 4.0]
    """
    camera_from_clip = _camera_from_clip(maps.clip_from_camera)
    x, y = viewport.ndc(pixel, clip)
    at_near, at_far = NDC_DEPTH[clip.depth]
    near = _in_front(apply(camera_from_clip, (x, y, Fraction(at_near), ONE)))
    if near is None:
        raise NoAnswerError(
            "the projection matrix",
            "its near plane is not in front of the eye, so no ray begins there",
            f"give another, or {quantity('depth')} and {quantity('handed')} that fit it",
        )
    *meeting, weight = apply(camera_from_clip, (ZERO, ZERO, ONE, ZERO))
    if weight:
        projected = Projected.PERSPECTIVE
        origin: RationalVector = tuple(one / weight for one in meeting)
        direction = tuple(n - o for n, o in zip(near, origin, strict=True))
    else:
        projected, origin = Projected.PARALLEL, near
        direction = tuple(one * (at_far - at_near) for one in meeting)
    world_from_camera = maps.camera_from_world.inverse()
    # The eye is where it was put, also where the view matrix is rounded.
    starts = world_from_camera.exact_point(origin) if any(origin) else maps.eye
    leads = world_from_camera.exact_vector(direction)
    point = None if depth is None else _point(camera_from_clip, (x, y), depth, clip)
    point_world = None if point is None else world_from_camera.exact_point(point)
    back = _object_from_world(maps.world_from_object)
    return PixelRay(
        projected=projected,
        ndc=(x, y) if depth is None else (x, y, ndc_depth(depth, clip.depth)),
        world=_ray(starts, leads),
        object=None if back is None else _ray(back.exact_point(starts), back.exact_vector(leads)),
        point_world=point_world,
        point_object=None if back is None or point_world is None else back.exact_point(point_world),
    )


def _camera_from_clip(clip_from_camera: RationalMatrix) -> RationalMatrix:
    if not determinant(clip_from_camera):
        raise NoAnswerError(
            "projection matrix (determinant 0)",
            "it flattens space, so a pixel has no one ray",
            "give an invertible matrix",
        )
    return inverse(clip_from_camera)


def _in_front(point: RationalVector) -> RationalVector | None:
    """Divide a point by its weight, whose sign is that of w in clip space: above 0 is in front."""
    *place, weight = point
    return tuple(one / weight for one in place) if weight > 0 else None


def _point(
    camera_from_clip: RationalMatrix, ndc: RationalVector, depth: Fraction, clip: ClipSpace
) -> RationalVector:
    """Find the point of camera space that has this place and depth in the window."""
    found = apply(camera_from_clip, (*ndc, ndc_depth(depth, clip.depth), ONE))
    place = _in_front(found)
    if place is None:
        raise NoAnswerError(
            f"{quantity('depth_value')} ({short_text(depth, 6)})",
            "what has it lies behind the eye" if found[3] else "what has it is infinitely far away",
            "take a depth nearer to the eye, or leave it out for the ray",
        )
    return place


def _object_from_world(world_from_object: Transform) -> Transform | None:
    is_singular = not world_from_object.linear_map.integer_determinant
    return None if is_singular else world_from_object.inverse()


def _ray(origin: RationalVector, direction: RationalVector) -> Ray:
    return Ray(origin, unit(integers(direction)[0]))
