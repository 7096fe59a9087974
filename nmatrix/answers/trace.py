"""`nmatrix trace`: one vertex through the pipeline, or one pixel back through it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from fractions import Fraction
from typing import Any

from nmatrix.enums import Projected
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import rational_vector
from nmatrix.linear.rounding import short_text
from nmatrix.linear.values import contradiction
from nmatrix.linear.viewport import Viewport
from nmatrix.report import Block, Brief, Heading, Number, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.spaces.exact_maps import ExactMaps
from nmatrix.spaces.pixel_ray import PixelRay, Ray, pixel_ray
from nmatrix.spaces.trace import Trace, TracedNormal
from nmatrix.spaces.trace import trace as follow

VERTEX, PIXEL = ("point", "normal"), ("pixel", "depth_value")


def answer_to(given: Mapping[str, Any], setup: Setup, viewport: Viewport) -> Report:
    """Answer what was given by name: a vertex, by default the origin, or a pixel.

    Raises
    ------
    IllegalValueError
        If both were given, or a depth without a pixel.
    """
    found = {name: value for name, value in given.items() if value is not None}
    if "pixel" in found:
        beside = [name for name in VERTEX if name in found]
        if beside:
            because = "one goes to the window, the other comes back from it"
            raise contradiction(quantity("pixel"), beside, because)
        return pixel(setup, found["pixel"], found.get("depth_value"), viewport)
    if "depth_value" in found:
        why = "it is the depth of a pixel"
        raise IllegalValueError(
            f"{quantity('depth_value')} alone", why, f"add {quantity('pixel')} X Y"
        )
    return trace(setup, found.get("point", (0, 0, 0)), found.get("normal"), viewport)


def trace(setup: Setup, point: Vector, normal: Vector | None, viewport: Viewport) -> Report:
    """Answer with a vertex in every frame from object to window.

    Examples
    --------
    >>> found = trace(Setup(), (0, 0, 0), None, Viewport(512, 512))
    >>> found.data["inside"], float(found.data["window"][0])
    (True, 256.0)
    """
    found = follow(_exact_maps(setup), point, normal, setup.lens.clip, viewport)
    titles = _TITLES | {"window": _window_title(setup.lens.clip)}
    frames: dict[str, Vector | Number | None] = {key: getattr(found, key) for key in titles}
    carried = None if found.normal is None else _directions(found.normal)
    data: dict[str, Value] = {
        **frames,
        "inside": found.inside,
        "outside_planes": list(found.outside_planes),
        "pixel": found.pixel,
        "normal": None if carried is None else {**carried},
        "ray": None,
        "point_world": None,
        "point_object": None,
    }
    blocks: tuple[Block, ...] = (
        Heading("One vertex through the pipeline"),
        *(Quantity(key, value, titles[key]) for key, value in frames.items()),
        Quantity("pixel", found.pixel, "pixel   (x, y down)"),
        *(Quantity(f"normal.{key}", v, f"normal, {key}") for key, v in (carried or {}).items()),
        Verdict(_verdict(found)),
    )
    remarks = (*setup.remarks, *setup.lens.remarks, *_lens_remarks(setup.lens), *_remarks(found))
    return Report("trace", data, blocks, remarks, brief=_brief(blocks))


def _brief(blocks: Sequence[Block]) -> Brief:
    """Put the verdict first; nothing is left out but the heading."""
    _, *shown, conclusion = blocks
    return Brief((conclusion, *shown))


def pixel(setup: Setup, place: Vector, depth: Number | None, viewport: Viewport) -> Report:
    """Answer with the ray of all that a pixel may show, and with the point that has a depth there.

    Examples
    --------
    >>> found = pixel(Setup(), (256, 256), None, Viewport(512, 512))
    >>> found.data["ray"]["direction_world"]
    (0.0, 0.0, -1.0)
    """
    if depth is not None and not 0 <= depth <= 1:
        raise IllegalValueError(
            f"{quantity('depth_value')} ({float(depth):g})",
            "a buffer stores depths from 0 to 1",
            "give such a number",
        )
    clip, counted = setup.lens.clip, rational_vector(place)
    stored = None if depth is None else Fraction(depth)
    found = pixel_ray(_exact_maps(setup), counted, stored, clip, viewport)
    window = viewport.pixel(counted, clip)
    points = {"point_world": found.point_world, "point_object": found.point_object}
    data: dict[str, Value] = {
        **dict.fromkeys(_TITLES),
        "ndc": None if stored is None else found.ndc,
        "window": None if stored is None else (*window, stored),
        "inside": None,
        "outside_planes": None,
        "pixel": counted,
        "normal": None,
        "ray": {**_ray_data("world", found.world), **_ray_data("object", found.object)},
        **points,
    }
    blocks: list[Block] = [Heading("The ray of a pixel")]
    for space, ray in (("world", found.world), ("object", found.object)):
        if ray is not None:
            blocks += [
                Quantity(f"ray.origin_{space}", ray.origin, f"origin, {space}"),
                Quantity(f"ray.direction_{space}", ray.direction, f"direction, {space}"),
            ]
    for key, point in points.items():
        if point is not None:
            blocks.append(Quantity(key, point, f"point, {key.removeprefix('point_')}"))
    blocks.append(Verdict(_how_found(found)))
    remarks = (
        *setup.remarks,
        *setup.lens.remarks,
        *_lens_remarks(setup.lens),
        *_ray_remarks(found),
    )
    return Report("trace", data, tuple(blocks), remarks, brief=_brief(blocks))


def _exact_maps(setup: Setup) -> ExactMaps:
    """Take the lens before its rounding, which has near, far and the sides where they were put."""
    return replace(setup.maps, clip_from_camera=setup.lens.exact)


def _ray_data(space: str, ray: Ray | None) -> dict[str, Value]:
    return {
        f"origin_{space}": None if ray is None else ray.origin,
        f"direction_{space}": None if ray is None else ray.direction,
    }


def _how_found(found: PixelRay) -> str:
    x, y = (short_text(one, 6) for one in found.ndc[:2])
    begins = {
        Projected.PERSPECTIVE: "it begins in the eye, as all rays of this lens do",
        Projected.PARALLEL: "it begins on the near plane, and all rays of this lens are parallel",
    }
    return f"Back by P⁻¹, V⁻¹ and M⁻¹ from x = {x}, y = {y} in NDC: {begins[found.projected]}."


def _ray_remarks(found: PixelRay) -> tuple[str, ...]:
    remarks = []
    if max(map(abs, found.ndc[:2])) > 1:
        remarks.append("The pixel is outside of the window, and its ray is outside of the view.")
    if found.object is None:
        remarks.append("M flattens space, so no M⁻¹ leads from the world back to the object.")
    return tuple(remarks)


_TITLES = {
    "object": "object",
    "world": "world   = M · object",
    "camera": "camera  = V · world",
    "clip": "clip    = P · camera",
    "ndc": "NDC     = clip / w",
    "window": "window",
    "reciprocal_w": "1/w",
}


def _window_title(clip: ClipSpace) -> str:
    return f"window  (x, y {'up' if clip.window_y_sign > 0 else 'down'}, depth)"


def _directions(normal: TracedNormal) -> dict[str, Vector | None]:
    return {
        "object": normal.object,
        "world": normal.world.direction,
        "camera": normal.camera.direction,
    }


def _verdict(found: Trace) -> str:
    if found.inside:
        return "Inside the view volume."
    w = Fraction(found.clip[3])
    if w <= 0:
        return f"Outside: {'behind' if w else 'beside'} the eye, w = {short_text(w, 6)}."
    *others, last = found.outside_planes
    named = f"{', '.join(others)} and {last} planes" if others else f"{last} plane"
    return f"Outside: beyond the {named}."


def _lens_remarks(lens: Lens) -> tuple[str, ...]:
    """Tell that a given projection was taken for the likeliest of several, or is none."""
    if lens.matrix is not None and not lens.readings:
        return ("The matrix is no projection of a camera: its clip space is taken as it is.",)
    depths = {one.depth for one in lens.readings}
    if len(depths) < 2:
        return ()
    return (
        f"The entries do not decide the depth range, taken as {lens.clip.depth} here: "
        f"{quantity('depth')} says it.",
    )


def _remarks(found: Trace) -> tuple[str, ...]:
    remarks = [
        f"What reads {'−1' if one < 0 else '1'} in NDC is {short_text(abs(one) - 1, 3)} beyond it: "
        "numbers are read as the nearest float64, which may be that far from what was typed."
        for one in found.ndc or ()
        if abs(one) > 1 and short_text(abs(one), 6) == "1"
    ]
    if not found.clip[3]:
        remarks.append("w is 0: the vertex is in the plane of the eye, which has no place in NDC.")
    elif found.clip[3] < 0:
        remarks.append(
            "Where w < 0, dividing by it would mirror the vertex into view, so it is clipped first "
            "and has no NDC."
        )
    if found.normal is not None:
        images = (found.normal.world, found.normal.camera)
        missing = [image.reason for image in images if image.direction is None]
        remarks += [f"The normal has no image: {reason}." for reason in missing[:1]]
    return tuple(remarks)
