"""`nmatrix projection`: the projection matrix, and the smallest gaps that depth resolves."""

from __future__ import annotations

from math import inf

from nmatrix.answers.depth import NOTHING_ASKED, DepthRequest, DepthTable
from nmatrix.enums import ClipY, DepthRange, Projected
from nmatrix.linear.depthstep import DepthAxis
from nmatrix.report import Heading, Quantity, Report, Value, Verdict
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

_WHERE = {
    DepthRange.MINUS_ONE_TO_ONE: "depth −1 at near, 1 at far (OpenGL)",
    DepthRange.ZERO_TO_ONE: "depth 0 at near, 1 at far (Vulkan, Direct3D, Metal, WebGPU)",
    DepthRange.REVERSED: "depth 1 at near, 0 at far (reversed)",
}


def projection(setup: Setup, asked: DepthRequest = NOTHING_ASKED) -> Report:
    """Answer with the projection matrix of a scene.

    Examples
    --------
    >>> projection(Setup()).data["depth_range"]
    'minus-one-to-one'
    """
    lens = setup.lens
    P = lens.clip_from_camera
    table = DepthTable(_axis(lens), asked)
    data: dict[str, Value] = {
        "clip_from_camera": P,
        "depth_range": lens.clip.depth.value,
        **table.data,
    }
    blocks = (
        Heading("Projection matrix: clip from camera"),
        Quantity("clip_from_camera", P, "P"),
        Verdict(_verdict(lens)),
        *table.blocks,
    )
    remarks = (*_remarks(lens), *table.remarks)
    return Report("projection", data, blocks, remarks, glsl=table.glsl)


def _axis(lens: Lens) -> DepthAxis | None:
    """Lay depth along the view direction, which a matrix that was given does not determine."""
    if lens.matrix is not None:
        return None
    projected = Projected.PERSPECTIVE if lens.ortho is None else Projected.PARALLEL
    return DepthAxis(lens.near, lens.far, lens.clip.depth, projected)


def _verdict(lens: Lens) -> str:
    hand = "−z" if lens.clip.forward_z < 0 else "+z"
    y = "down" if lens.clip.clip_y is ClipY.DOWN else "up"
    return f"The camera looks down {hand}, y in clip space points {y}, {_WHERE[lens.clip.depth]}."


def _remarks(lens: Lens) -> tuple[str, ...]:
    remarks = []
    if lens.far == inf:
        remarks.append("far is infinite: the entries are the limits of the finite formulas.")
    if lens.matrix is not None:
        remarks.append("The matrix was given, so near and far are unknown: no table of steps.")
    return tuple(remarks)
