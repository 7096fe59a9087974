"""`nmatrix projection`: the projection matrix, what it is, and what its depth resolves."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from fractions import Fraction
from math import inf

from nmatrix.answers.depth import NOTHING_ASKED, DepthRequest, DepthTable
from nmatrix.answers.identify import because, described, reading_data
from nmatrix.enums import ClipY, DepthRange, Projected
from nmatrix.errors import quantity
from nmatrix.linear.angle import DEGREES, arctangent
from nmatrix.linear.depthstep import DepthAxis
from nmatrix.linear.identify import Reading, identify
from nmatrix.linear.interval import Bound
from nmatrix.linear.lens_readings import LARGEST
from nmatrix.linear.measured_lens import intrinsics_of
from nmatrix.linear.projection import Sides, sides_seen
from nmatrix.linear.rational import scaled
from nmatrix.report import (
    SCREEN,
    Block,
    Brief,
    Heading,
    Number,
    Quantity,
    Report,
    Text,
    Value,
    Vector,
    Verdict,
)
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup

NUMBERS = ("near", "far", "left", "right", "bottom", "top", "fov_y_deg", "fov_x_deg", "aspect")

FEW = 5  # depths that find room on a screen
GAPS = "the gaps at seven distances"

_WHERE = {
    DepthRange.MINUS_ONE_TO_ONE: "depth −1 at near, 1 at far (OpenGL)",
    DepthRange.ZERO_TO_ONE: "depth 0 at near, 1 at far (Vulkan, Direct3D, Metal, WebGPU)",
    DepthRange.REVERSED: "depth 1 at near, 0 at far (reversed)",
}


def projection(setup: Setup, asked: DepthRequest = NOTHING_ASKED, *, steps: bool = False) -> Report:
    """Answer with the projection matrix of a scene; of a given one, with what its entries say.

    Examples
    --------
    >>> found = projection(Setup()).data
    >>> found["depth_range"], found["near"], float(found["fov_y_deg"])
    ('minus-one-to-one', 0.1, 60.0)
    """
    lens = setup.lens
    P = lens.clip_from_camera
    readings = _readings(lens)
    table = DepthTable(_axis(lens), asked)
    numbers = _numbers(lens) if readings is None else _numbers_read(lens)
    sides = _sides_seen(lens)
    if sides is not None:
        numbers = {**_fields(sides), **numbers}
    viewport = lens.viewport
    intrinsics = None if sides is None or viewport is None else intrinsics_of(sides, viewport)
    data: dict[str, Value] = {
        "clip_from_camera": P,
        **_clip_data(lens),
        **{name: _finite(numbers.get(name)) for name in NUMBERS},
        "intrinsics": intrinsics,
        "readings": None if readings is None else [reading_data(one) for one in readings],
        **table.data,
        "steps": None,
    }
    shown = Quantity("clip_from_camera", P, "P")
    told = (Verdict(_verdict(lens)),) if readings is None else tuple(_told(readings))
    measured = tuple(_measured_blocks(lens, numbers, intrinsics))
    blocks = (
        Heading("Projection matrix: clip from camera"),
        shown,
        *told,
        *measured,
        *table.blocks,
    )
    remarks = (*lens.remarks, *_remarks(lens), *table.remarks)
    own = (shown,) if readings is None else ()
    brief = Brief(
        (*told, *own, *measured, *table.brief),
        (*(() if own else ("the matrix",)), *((GAPS,) if table.steps is not None else ())),
        SCREEN + max(len(table.pairs or ()) - FEW, 0),
    )
    report = Report("projection", data, blocks, remarks, glsl=table.glsl, brief=brief)
    if steps:
        from nmatrix.answers.steps import of_projection, with_steps  # most answers are without

        return with_steps(report, of_projection(setup))
    return report


def _readings(lens: Lens) -> tuple[Reading, ...] | None:
    """Read a matrix that was given in every way that its entries, and what is said of it, allow.

    It was given as a projection: what reads it as one comes before what does not.
    """
    if lens.matrix is None:
        return None
    said = {part: lens.clip.parts[part] for part in lens.said}
    found = sorted(identify(lens.matrix), key=lambda one: one.lens is None)
    return tuple(one for one in found if one.lens is None or one.lens.fits(said))


def _clip_data(lens: Lens) -> dict[str, Value]:
    """Describe the clip space; of a given matrix what is not decided is None."""
    if lens.matrix is None:
        hand, y, depth = lens.clip.handed, lens.clip.clip_y, lens.clip.depth
        return {"handed": hand.value, "clip_y": y.value, "depth_range": depth.value}
    return {
        "handed": _only({one.handed for one in lens.readings}),
        "clip_y": _only({one.clip_y for one in lens.readings}),
        "depth_range": _only({one.depth for one in lens.readings}),
    }


def _only(words: Collection[object]) -> str | None:
    """Return the one word that all readings agree on."""
    (word,) = words if len(words) == 1 else (None,)
    return None if word is None else str(word)


def _numbers_read(lens: Lens) -> Mapping[str, Bound]:
    """Return the round numbers of the likeliest reading, without those that others deny."""
    if not lens.readings:
        return {}
    first, *others = lens.readings
    return {
        name: value
        for name, value in first.values.items()
        if all(one.bounds.get(name) == first.bounds.get(name) for one in others)
    }


def _numbers(lens: Lens) -> Mapping[str, Number]:
    """Compute the sides at near, the field of view and the aspect of a lens that was built."""
    x, y = lens.exact[0], lens.exact[1]
    y = tuple(entry * lens.clip.y_sign for entry in y)
    forward, near = lens.clip.forward_z, Fraction(lens.near)
    parallel = lens.ortho is not None
    reach, across, upwards = (1, x[3], y[3]) if parallel else (near, forward * x[2], forward * y[2])
    sides = {
        "left": (-1 - across) * reach / x[0],
        "right": (1 - across) * reach / x[0],
        "bottom": (-1 - upwards) * reach / y[1],
        "top": (1 - upwards) * reach / y[1],
    }
    found: dict[str, Number] = {"near": lens.near, "far": lens.far, **sides}
    found["aspect"] = (sides["right"] - sides["left"]) / (sides["top"] - sides["bottom"])
    return found


def _sides_seen(lens: Lens) -> Sides | None:
    """Find what a perspective lens shows at distance 1; a given one by its entries as they are."""
    if lens.matrix is None:
        return sides_seen(lens.exact, lens.clip)
    if not lens.readings:
        return None
    return sides_seen(scaled(lens.matrix, 1 / lens.readings[0].factor), lens.clip)


def _fields(sides: Sides) -> dict[str, Number]:
    """Measure the angles between left and right and between bottom and top, seen from the eye."""
    left, right, bottom, top = sides
    if left > right or bottom > top:  # the picture is mirrored
        return {}
    return {
        "fov_x_deg": _turn(right) - _turn(left),
        "fov_y_deg": _turn(top) - _turn(bottom),
    }


def _turn(tangent: Fraction) -> Fraction:
    size = arctangent(abs(tangent)) * DEGREES
    return size if tangent > 0 else -size


def _measured_blocks(
    lens: Lens, numbers: Mapping[str, Bound | Number], intrinsics: Vector | None
) -> Iterator[Block]:
    """Tell the same lens as other programs ask for it, where it was given so or has a viewport."""
    if lens.measured is None and intrinsics is None:
        return
    for key in ("fov_x_deg", "fov_y_deg"):
        if numbers.get(key) is not None:
            yield Quantity(key, numbers[key], f"field of view, {key[4]}", "°")
    if intrinsics is not None:
        yield Quantity("intrinsics", intrinsics, "fx fy cx cy, from the corner")


def _finite(value: Number | None) -> Number | None:
    return None if value == inf else value


def _axis(lens: Lens) -> DepthAxis | None:
    """Lay depth along the view direction; of a given matrix, by its likeliest near and far."""
    if lens.matrix is None:
        projected = Projected.PERSPECTIVE if lens.ortho is None else Projected.PARALLEL
        return DepthAxis(lens.near, lens.far, lens.clip.depth, projected)
    read = lens.readings[0] if lens.readings else None
    if read is None or read.depth is None:
        return None
    near, far = read.values["near"], read.values["far"]
    if max(abs(one) for one in (near, far) if isinstance(one, Fraction)) > LARGEST:
        return None
    projected = Projected.PERSPECTIVE if read.is_perspective else Projected.PARALLEL
    return DepthAxis(float(near), float(far), read.depth, projected)


def _verdict(lens: Lens) -> str:
    hand = "−z" if lens.clip.forward_z < 0 else "+z"
    y = "down" if lens.clip.clip_y is ClipY.DOWN else "up"
    return f"The camera looks down {hand}, y in clip space points {y}, {_WHERE[lens.clip.depth]}."


def _told(readings: tuple[Reading, ...]) -> tuple[Block, ...]:
    """Name the likeliest reading of a given matrix, its evidence, and all the others."""
    first, *others = readings
    if first.lens is None:
        return (Verdict(f"This is no projection: {described(first)}."), Text(because(first)))
    verdict = f"{'Most likely' if others else 'This is'} {described(first)}."
    lines = [f"{i + 2}. {described(one)}" for i, one in enumerate(others)]
    also = (Text("\n".join(("The entries allow as well:", *lines))),) if lines else ()
    return (Verdict(verdict), Text(because(first)), *also)


def _remarks(lens: Lens) -> tuple[str, ...]:
    remarks = []
    if lens.far == inf:
        remarks.append("far is infinite: the entries are the limits of the finite formulas.")
    if len({one.depth for one in lens.readings}) > 1:
        remarks.append(
            "A depth range is not in the entries: the table takes the likeliest; "
            f"{quantity('depth')} says it."
        )
    return tuple(remarks)
