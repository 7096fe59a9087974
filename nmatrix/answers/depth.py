"""What `projection` tells of depth: gaps that a buffer tells apart, depths and distances."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import asdict, astuple, dataclass, fields
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import DepthRange, Projected
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.depthstep import DepthAxis, DepthStep, orthographic_steps, perspective_steps
from nmatrix.linear.rounding import nearest, short_text
from nmatrix.report import Block, Number, Table, Value

STEPS = "Gap to the nearest surface in front that gets another stored depth"
FINEST = Fraction(1, 2**26)  # a quarter of the least that moves a float32 vertex, relatively


@dataclass(frozen=True)
class DepthRequest:
    """Distances whose depth is asked for, and window depths whose distance is."""

    distances: tuple[Number, ...] = ()
    depths: tuple[Number, ...] = ()

    def __post_init__(self) -> None:
        for depth in self.depths:
            if not 0 <= depth <= 1:
                raise IllegalValueError(
                    f"{quantity('depth_value')} ({float(depth):g})",
                    "a buffer stores depths from 0 to 1",
                    f"give such a number, or {quantity('at')} DISTANCE",
                )


NOTHING_ASKED = DepthRequest()


@dataclass(frozen=True)
class DepthTable:
    """The part of an answer that is about depth; without an axis there is none."""

    axis: DepthAxis | None
    request: DepthRequest

    @cached_property
    def steps(self) -> tuple[DepthStep, ...] | None:
        """The gaps at seven distances."""
        if self.axis is None:
            return None
        is_parallel = self.axis.projected is Projected.PARALLEL
        tabulate = orthographic_steps if is_parallel else perspective_steps
        return tabulate(self.axis.near, self.axis.far, self.axis.depth)

    @cached_property
    def pairs(self) -> tuple[tuple[Number | None, Number], ...] | None:
        """Each distance with its window depth: those asked by distance, then those by depth."""
        axis, asked = self.axis, self.request
        if axis is None or asked == NOTHING_ASKED:
            return None
        return (
            *((distance, axis.depth_at(Fraction(distance))) for distance in asked.distances),
            *((axis.distance_at(Fraction(depth)), depth) for depth in asked.depths),
        )

    @property
    def data(self) -> dict[str, Value]:
        """The keys `depth_step` and `depths`."""
        pairs = self.pairs
        return {
            "depth_step": None if self.steps is None else [asdict(step) for step in self.steps],
            "depths": None if pairs is None else [{"distance": z, "depth": d} for z, d in pairs],
        }

    @property
    def blocks(self) -> Iterator[Block]:
        """The two tables, those depths first that were asked for."""
        if self.pairs is not None:
            yield Table(("distance", "depth"), self.pairs, "Window depth of a distance")
        if self.steps is not None:
            columns = tuple(one.name for one in fields(DepthStep))
            yield Table(columns, tuple(map(astuple, self.steps)), STEPS)

    @property
    def brief(self) -> Iterator[Block]:
        """The depths that were asked for, or the gaps at near, far and between."""
        if self.pairs is not None:
            yield Table(("distance", "depth"), self.pairs, "Window depth of a distance")
        elif self.steps is not None:
            columns = tuple(one.name for one in fields(DepthStep))
            few = (self.steps[0], self.steps[len(self.steps) // 2], self.steps[-1])
            yield Table(columns, tuple(map(astuple, few)), STEPS)

    @property
    def glsl(self) -> str:
        """The line of a shader that turns a stored depth into a distance."""
        if self.axis is None:
            return ""
        slope, offset = self.axis.coefficients
        try:
            constant, factor = nearest(-offset / slope), nearest(1 / slope)
        except IllegalValueError:
            return "// The distance of a depth takes numbers beyond float64."
        sign = "+" if factor > 0 else "-"
        scaled = f"{abs(factor)!r} * depth"
        inner = f"{constant!r} {sign} {scaled}" if constant else scaled
        over = f"1.0 / ({inner})" if self.axis.projected is Projected.PERSPECTIVE else inner
        return f"float distance_of(float depth) {{ return {over}; }}"

    @property
    def remarks(self) -> Iterator[str]:
        """What the numbers mean for two surfaces that are close together."""
        if any(distance is None for distance, _ in self.pairs or ()):
            yield "far is infinite: its depth is reached at no distance."
        if any(not 0 <= depth <= 1 for _, depth in self.pairs or ()):
            yield "A depth below 0 or above 1 is outside near and far: it is clipped, never stored."
        if self.steps is None or self.axis is None:
            return
        last, perspective = self.steps[-1], self.axis.projected is Projected.PERSPECTIVE
        if perspective and self.axis.depth is DepthRange.REVERSED:
            yield (
                "Reversed depth puts float32's fine steps near 0 where the far field needs them; "
                "it needs a zero-to-one interface and a float buffer."
            )
        elif perspective and last.float32 is not None and last.float32 > last.distance / 100:
            yield (
                f"At distance {short_text(Fraction(last.distance), 6)} two surfaces closer than "
                f"{short_text(last.float32, 3)} fight for the same depth: a larger near or a "
                "reversed depth range helps."
            )
        if any(
            step.float32 is None or step.float32 < FINEST * abs(Fraction(step.distance))
            for step in self.steps
        ):
            yield (
                "Near a stored depth of 0 a float32 buffer is finer than float32 vertices, which "
                "move by 6e-8 of their distance or more."
            )
