"""`nmatrix trace`: one vertex through the pipeline."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.linear.exact import Normal
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.setup import Setup
from nmatrix.spaces.trace import Trace, Viewport
from nmatrix.spaces.trace import trace as follow


def trace(setup: Setup, point: Vector, normal: Vector | None, viewport: Viewport) -> Report:
    """Answer with a vertex in every frame from object to window.

    Examples
    --------
    >>> found = trace(Setup(), (0, 0, 0), None, Viewport(512, 512))
    >>> found.data["inside"], float(found.data["window"][0])
    (True, 256.0)
    """
    found = follow(
        setup.maps,
        [float(component) for component in point],
        None if normal is None else [float(component) for component in normal],
        setup.lens.clip,
        viewport,
    )
    data: dict[str, Value] = {
        "object": found.object,
        "world": found.world,
        "camera": found.camera,
        "clip": found.clip,
        "ndc": found.ndc,
        "window": found.window,
        "reciprocal_w": found.reciprocal_w,
        "inside": found.inside,
        "outside_planes": list(found.outside_planes),
        "normal": _normal_data(found),
    }
    return Report("trace", data, tuple(_blocks(found)), (*setup.remarks, *_remarks(found)))


def _normal_data(found: Trace) -> dict[str, Value] | None:
    if found.normal is None:
        return None
    return {
        "object": found.normal.object,
        "world": found.normal.world.direction,
        "camera": found.normal.camera.direction,
    }


def _blocks(found: Trace) -> list[Block]:
    blocks: list[Block] = [
        Heading("One vertex through the pipeline"),
        Quantity("object", found.object, "object"),
        Quantity("world", found.world, "world   = M · object"),
        Quantity("camera", found.camera, "camera  = V · world"),
        Quantity("clip", found.clip, "clip    = P · camera"),
        Quantity("ndc", found.ndc, "NDC     = clip / w"),
        Quantity("window", found.window, "window  (x, y, depth)"),
        Quantity("reciprocal_w", found.reciprocal_w, "1/w"),
    ]
    if found.normal is not None:
        blocks += [
            Quantity("normal.object", found.normal.object, "normal, object"),
            Quantity("normal.world", found.normal.world.direction, "normal, world"),
            Quantity("normal.camera", found.normal.camera.direction, "normal, camera"),
        ]
    blocks.append(Verdict(_verdict(found)))
    return blocks


def _verdict(found: Trace) -> str:
    if found.inside:
        return "Inside the view volume."
    w = Fraction(found.clip[3])
    if w <= 0:
        return f"Outside: {'behind' if w else 'beside'} the eye, w = {short_text(w, 6)}."
    *others, last = found.outside_planes
    named = f"{', '.join(others)} and {last} planes" if others else f"{last} plane"
    return f"Outside: beyond the {named}."


def _remarks(found: Trace) -> tuple[str, ...]:
    remarks = []
    if found.clip[3] <= 0:
        remarks.append(
            "Where w ≤ 0, dividing by it would mirror the vertex into view, so it is clipped first "
            "and has no NDC."
        )
    if found.normal is not None:
        remarks += [
            f"The normal has no image: {image.reason}."
            for image in dict.fromkeys((found.normal.world, found.normal.camera))
            if _is_missing(image)
        ][:1]
    return tuple(remarks)


def _is_missing(image: Normal) -> bool:
    return image.direction is None
