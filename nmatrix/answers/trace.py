"""`nmatrix trace`: one vertex through the pipeline."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction

from nmatrix.errors import quantity
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Number, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.spaces.trace import Trace, TracedNormal, Viewport
from nmatrix.spaces.trace import trace as follow


def trace(setup: Setup, point: Vector, normal: Vector | None, viewport: Viewport) -> Report:
    """Answer with a vertex in every frame from object to window.

    Examples
    --------
    >>> found = trace(Setup(), (0, 0, 0), None, Viewport(512, 512))
    >>> found.data["inside"], float(found.data["window"][0])
    (True, 256.0)
    """
    # The lens before its rounding has near, far and the sides exactly where they were put.
    maps = replace(setup.maps, clip_from_camera=setup.lens.exact)
    found = follow(maps, point, normal, setup.lens.clip, viewport)
    titles = _TITLES | {"window": _window_title(setup.lens.clip)}
    frames: dict[str, Vector | Number | None] = {key: getattr(found, key) for key in titles}
    carried = None if found.normal is None else _directions(found.normal)
    data: dict[str, Value] = {
        **frames,
        "inside": found.inside,
        "outside_planes": list(found.outside_planes),
        "pixel": found.pixel,
        "normal": None if carried is None else {**carried},
    }
    blocks: tuple[Block, ...] = (
        Heading("One vertex through the pipeline"),
        *(Quantity(key, value, titles[key]) for key, value in frames.items()),
        Quantity("pixel", found.pixel, "pixel   (x, y down)"),
        *(Quantity(f"normal.{key}", v, f"normal, {key}") for key, v in (carried or {}).items()),
        Verdict(_verdict(found)),
    )
    remarks = (*setup.remarks, *_lens_remarks(setup.lens), *_remarks(found))
    return Report("trace", data, blocks, remarks)


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
