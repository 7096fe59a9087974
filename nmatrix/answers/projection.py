"""`nmatrix projection`: the projection matrix, and the smallest gaps that depth resolves."""

from __future__ import annotations

from dataclasses import asdict, astuple, fields
from math import inf

from nmatrix.enums import ClipY, DepthRange
from nmatrix.linear.depthstep import DepthStep, orthographic_steps, perspective_steps
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Quantity, Report, Table, Value, Verdict
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

_WHERE = {
    DepthRange.MINUS_ONE_TO_ONE: "depth −1 at near, 1 at far (OpenGL)",
    DepthRange.ZERO_TO_ONE: "depth 0 at near, 1 at far (Vulkan, Direct3D, Metal, WebGPU)",
    DepthRange.REVERSED: "depth 1 at near, 0 at far (reversed)",
}


def projection(setup: Setup) -> Report:
    """Answer with the projection matrix of a scene.

    Examples
    --------
    >>> projection(Setup()).data["depth_range"]
    'minus-one-to-one'
    """
    lens = setup.lens
    P = lens.clip_from_camera
    steps = _steps(lens)
    data: dict[str, Value] = {
        "clip_from_camera": P,
        "depth_range": lens.clip.depth.value,
        "depth_step": None if steps is None else [asdict(step) for step in steps],
    }
    blocks: list[Block] = [
        Heading("Projection matrix: clip from camera"),
        Quantity("clip_from_camera", P, "P"),
        Verdict(_verdict(lens)),
    ]
    if steps is not None:
        title = "Smallest gap in distance that window depth can tell"
        columns = tuple(one.name for one in fields(DepthStep))
        blocks.append(Table(columns, tuple(map(astuple, steps)), title))
    return Report("projection", data, tuple(blocks), _remarks(lens, steps))


def _steps(lens: Lens) -> tuple[DepthStep, ...] | None:
    """Compute the depth steps, which a matrix that was given does not determine."""
    if lens.matrix is not None:
        return None
    steps = perspective_steps if lens.ortho is None else orthographic_steps
    return steps(lens.near, lens.far, lens.clip.depth)


def _verdict(lens: Lens) -> str:
    hand = "−z" if lens.clip.forward_z < 0 else "+z"
    y = "down" if lens.clip.clip_y is ClipY.DOWN else "up"
    return f"The camera looks down {hand}, y in clip space points {y}, {_WHERE[lens.clip.depth]}."


def _remarks(lens: Lens, steps: tuple[DepthStep, ...] | None) -> tuple[str, ...]:
    remarks = []
    if lens.far == inf:
        remarks.append("far is infinite: the entries are the limits of the finite formulas.")
    if steps is not None and lens.ortho is None:
        last = steps[-1]
        if lens.clip.depth is DepthRange.REVERSED:
            remarks.append(
                "Reversed depth puts float32's fine steps near 0 where the far field needs them; "
                "it needs a zero-to-one interface and a float buffer."
            )
        elif last.float32 > last.distance / 100:
            remarks.append(
                "At the far end two surfaces closer than "
                f"{short_text(last.float32, 3)} fight for the same depth: a larger near or "
                "a reversed depth range helps."
            )
    if lens.matrix is not None:
        remarks.append("The matrix was given, so near and far are unknown: no table of steps.")
    return tuple(remarks)
