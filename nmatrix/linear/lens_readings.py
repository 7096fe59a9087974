"""A projection matrix read backwards: near, far, field and clip space, from its entries alone.

Each entry is known to an interval, and so is all that is read from it. w = g·z decides the hand;
the z row (a, c) gives NDC depth A + c/d at distance d, A = g·a, and so a near and a far plane for
each depth range that fits: the entries do not decide between them, only how round the numbers are.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain
from math import inf
from sys import float_info

from nmatrix.enums import API_PRESETS, Api, ClipY, DepthRange, Handedness, MatrixKind
from nmatrix.errors import NMatrixError
from nmatrix.linear.angle import DEGREES, Angle, arctangent
from nmatrix.linear.interval import (
    NO_NUMBER,
    Bound,
    Interval,
    digit_cost,
    hull,
    quotient,
    ratio_cost,
    roundest_ratio,
)
from nmatrix.linear.projection import (
    NDC_DEPTH,
    ClipSpace,
    Window,
    frustum,
    orthographic,
    perspective,
)
from nmatrix.linear.rational import DOUBLE, ONE, ZERO, RationalMatrix, RoundedMatrix, scaled
from nmatrix.linear.rounding import nearest, spacing

SIDES = ("left", "right", "bottom", "top")
LARGEST = Fraction(float_info.max)

# What makes a reading less likely, in digits (see `interval.digit_cost`).
NO_INTERFACE = 1.2  # a clip space that no interface has
NOT_OPENGL = 0.1  # among equals, the interface that most matrices are written for
BEHIND = 0.5  # a near plane behind the eye
MOSTLY_BEHIND = 1.5  # and farther behind it than the far plane is ahead
ALL_BEHIND = 2.0  # a far plane there
MULTIPLE = 2.0  # a factor that the division by w undoes
NO_RANGE = 2 * NO_NUMBER  # a z row that is of no depth range


@dataclass(frozen=True)
class LensReading:
    """One way to read a projection matrix.

    `bounds` are all values that each quantity may have, `values` round ones that fit together; an
    absent one is not known. `depth` is None where no depth range fits. The whole matrix may carry
    a positive factor, which the division by w undoes.
    """

    kind: MatrixKind
    handed: Handedness
    clip_y: ClipY
    depth: DepthRange | None
    bounds: Mapping[str, Interval]
    values: Mapping[str, Bound]
    factor: Fraction = ONE

    @property
    def clip(self) -> ClipSpace:
        """The clip space, with the usual depth range where none fits."""
        return ClipSpace(self.depth or DepthRange.MINUS_ONE_TO_ONE, self.handed, self.clip_y)

    def fits(self, said: Mapping[str, object]) -> bool:
        """Decide if it has all parts of a clip space that are said; any depth range fits none."""
        mine = {"depth": self.depth, "handed": self.handed, "clip_y": self.clip_y}
        return all(mine[part] in (word, None) for part, word in said.items())

    @property
    def apis(self) -> tuple[Api, ...]:
        """The interfaces with this clip space; reversed depth is for those from 0 to 1."""
        depth = DepthRange.ZERO_TO_ONE if self.depth is DepthRange.REVERSED else self.depth
        mine = (depth, self.handed, self.clip_y)
        return tuple(api for api, preset in API_PRESETS.items() if preset[:3] == mine)

    @property
    def is_perspective(self) -> bool:
        """Whether things get smaller with distance."""
        return self.kind is MatrixKind.PROJECTION

    @property
    def is_centred(self) -> bool:
        """Whether the view axis goes through the middle of the window."""
        return "fov_y_deg" in self.bounds

    @cached_property
    def cost(self) -> float:
        """How many digits its numbers take, and what makes it unlikely besides."""
        near, far = self.values.get("near", inf), self.values.get("far", inf)
        cost = NO_RANGE if self.depth is None else _pair_cost(near, far)
        if self.factor != 1:
            cost += MULTIPLE + digit_cost(self.factor)
        if near < 0:
            cost += 0 if (near, far) == (-1, 1) else BEHIND
        if -near > far:
            cost += MOSTLY_BEHIND
        if far <= 0:
            cost += ALL_BEHIND
        if Api.OPENGL not in self.apis:
            cost += NOT_OPENGL if self.apis else NO_INTERFACE
        if self.is_centred and self.is_perspective:
            return cost + digit_cost(self.values["fov_y_deg"]) + ratio_cost(self.values["aspect"])
        sides = [self.values[side] for side in SIDES if side in self.values]
        if len(sides) < len(SIDES):
            return cost
        window = _pair_cost(*sides[:2]) + _pair_cost(*sides[2:])
        return cost + (window / 2 if self.is_perspective else window)

    @cached_property
    def rebuilt(self) -> RationalMatrix | None:
        """The matrix that the values and the factor make, if they can be built."""
        built = self._built()
        return None if built is None else scaled(built, self.factor)

    def _built(self) -> RationalMatrix | None:
        if self.depth is None:
            return None
        try:
            near, far = (_as_float(self.values[name]) for name in ("near", "far"))
            if self.is_centred and self.is_perspective:
                half = Angle.degrees(Fraction(self.values["fov_y_deg"]) / 2)
                return perspective(half, _as_float(self.values["aspect"]), near, far, self.clip)
            window = Window(*(_as_float(self.values[side]) for side in SIDES))
            build = frustum if self.is_perspective else orthographic
            return build(window, near, far, self.clip)
        except NMatrixError:
            return None


def as_written(rows: RationalMatrix) -> tuple[RationalMatrix, RationalMatrix]:
    """Return the numbers that a program wrote down, and how far each may be from what it computed.

    A float32 is that float, however it was spelled; where nothing is said, each is a float64.
    """
    if not isinstance(rows, RoundedMatrix):
        return rows, tuple(tuple(spacing(entry) / 2 for entry in row) for row in rows)
    if rows.bits == DOUBLE:
        return tuple(rows), rows.shared_half_units
    floats = (
        tuple(round(x / step) * step if (step := spacing(x, rows.bits)) else x for x in row)
        for row in rows
    )
    return tuple(floats), rows.shared_half_units


def lens_readings(rows: RationalMatrix) -> tuple[LensReading, ...]:
    """Read a 4×4 matrix as a projection in every way that its entries allow, the roundest first.

    Rows that were rounded are known to their shared half units, all others to a float64.

    Examples
    --------
    >>> P = perspective(Angle.degrees(45), 2, 1, 3)
    >>> [(one.depth.value, str(one.values["near"])) for one in lens_readings(P)]
    [('minus-one-to-one', '1'), ('zero-to-one', '3/2')]
    """
    rows, known = as_written(rows)
    factor = abs(rows[3][2]) if not any((*rows[3][:2], rows[3][3])) else ONE
    if factor in (0, 1):
        found = chain(*(read(_Entries(rows, known)) for read in (_perspectives, _parallels)))
    else:
        read = _perspectives(_Entries(scaled(rows, 1 / factor), scaled(known, 1 / factor)))
        found = chain(replace(one, factor=factor) for one in read)
    return tuple(sorted(found, key=lambda one: one.cost))


@dataclass(frozen=True)
class _Entries:
    """The entries of a matrix as intervals."""

    rows: RationalMatrix
    half_units: RationalMatrix

    def at(self, i: int, j: int) -> Interval:
        return Interval.around(self.rows[i][j], self.half_units[i][j])

    def may_be_zero(self, *places: str) -> bool:
        return all(0 in self.at(int(place[0]), int(place[1])) for place in places)


@dataclass(frozen=True)
class _Line:
    """NDC as a line, scale·x + offset, that is `at_low` at one end of the view and `at_high` there.

    Across a parallel view x is a place; along a perspective one it is 1/distance, in which depth is
    a line too.
    """

    scale: Interval
    offset: Interval
    at_low: int = -1
    at_high: int = 1

    def end(self, at: int) -> Interval:
        """Return where NDC is `at`."""
        found = quotient(self.offset.image(lambda o: at - o), self.scale)
        assert found is not None  # the scale has a sign
        return found

    def high_beside(self, low: Fraction) -> Interval | None:
        """Return the high ends that fit the entries together with a low one."""
        return _other_end(low, self.at_low, self.at_high, self)

    def low_beside(self, high: Fraction) -> Interval | None:
        """Return the low ends that fit the entries together with a high one."""
        return _other_end(high, self.at_high, self.at_low, self)

    def round_ends(self) -> tuple[Bound, Bound] | None:
        """Return round ends that fit the entries together, the rounder one chosen first."""
        lows, highs = self.end(self.at_low), self.end(self.at_high)
        low, high = lows.roundest(), highs.roundest()
        from_low = self.high_beside(lows.nearest_to(low))
        from_high = self.low_beside(highs.nearest_to(high))
        pairs = []
        if from_low is not None:
            pairs.append((low, from_low.roundest()))
        if from_high is not None:
            pairs.append((from_high.roundest(), high))
        return min(pairs, key=lambda pair: _pair_cost(*pair), default=None)


def _other_end(known: Fraction, at: int, at_other: int, line: _Line) -> Interval | None:
    """Return the other ends that fit the scale alone, and the offset alone.

    scale · (other − known) = at_other − at, and other/known = (at_other − offset)/(at − offset).
    """
    grown = line.scale.image(lambda scale: known + (at_other - at) / scale)
    if at in line.offset:
        return grown
    return grown.meets(line.offset.image(lambda o: known * (at_other - o) / (at - o)))


def _perspectives(P: _Entries) -> Iterator[LensReading]:
    if not P.may_be_zero("01", "03", "10", "13", "20", "21", "30", "31", "33"):
        return
    g = next((g for g in (-1, 1) if g in P.at(3, 2)), None)
    x, y, c = P.at(0, 0), P.at(1, 1), P.at(2, 3)
    if g is None or not (x.sign and y.sign and c.sign):
        return
    hand = Handedness.RIGHT if g < 0 else Handedness.LEFT
    clip_y = ClipY.UP if y.sign > 0 else ClipY.DOWN
    across = _Line(x, P.at(0, 2) * g)
    upwards = _Line(y * y.sign, P.at(1, 2) * (g * y.sign))
    is_centred = 0 in across.offset and 0 in upwards.offset and x.sign > 0
    fits = False
    for depth in DepthRange:
        planes = _planes(_Line(c, P.at(2, 2) * g, *NDC_DEPTH[depth]))
        if planes is None:
            continue
        fits = True
        bounds, values = planes
        near = Fraction(values["near"])
        for line, names in ((across, SIDES[:2]), (upwards, SIDES[2:])):
            at_one = (line.end(-1), line.end(1))  # at distance 1
            bounds |= {n: one * bounds["near"] for n, one in zip(names, at_one, strict=True)}
            ends = _Line(line.scale * (1 / near), line.offset).round_ends()
            values |= dict(zip(names, ends or (ZERO, ZERO), strict=True))
        if is_centred:
            seen, chosen = _fields(x, upwards.scale)
            bounds |= seen
            values |= chosen | (_window(near, chosen) if chosen else {})
        yield LensReading(MatrixKind.PROJECTION, hand, clip_y, depth, bounds, values)
    if not fits:
        seen, chosen = _fields(x, upwards.scale) if is_centred else ({}, {})
        yield LensReading(MatrixKind.PROJECTION, hand, clip_y, None, seen, chosen)


def _planes(line: _Line) -> tuple[dict[str, Interval], dict[str, Bound]] | None:
    """Find near and far: at 1/near and 1/far depth is what its range has there.

    Of the offset only that part counts which puts far in front of the eye, or infinitely far.
    """
    low, high = line.offset.ends
    beyond = Fraction(line.at_high)
    if line.scale.sign < 0:
        low = max(low, beyond)
    else:
        high = min(high, beyond)
    if low > high:
        return None
    line = replace(line, offset=Interval(low, high))
    near, far = line.end(line.at_low), line.end(line.at_high)
    if near.low <= 0 or far.low >= near.high:
        return None
    bounds = {"near": _reciprocal(near), "far": _reciprocal(far)}
    chosen = Fraction(bounds["near"].roundest())
    beside = line.high_beside(1 / bounds["near"].nearest_to(chosen))
    if beside is None or beside.high < 0:
        return None
    return bounds, {"near": chosen, "far": _reciprocal(beside).roundest()}


def _reciprocal(x: Interval) -> Interval:
    """Return 1/x; where x may be 0 or less the far end is infinite."""
    high = Fraction(x.high)
    return Interval(1 / high if high > 0 else LARGEST, 1 / x.low if x.low > 0 else inf)


def _fields(x: Interval, y: Interval) -> tuple[dict[str, Interval], dict[str, Bound]]:
    """Find the field of view in y and x, in degrees, and the aspect, of the focal lengths."""
    bounds = {
        "fov_y_deg": y.image(_field_of),
        "fov_x_deg": x.image(_field_of),
        "aspect": hull(q / p for p in x.ends for q in y.ends),
    }
    field_y = Fraction(bounds["fov_y_deg"].roundest())
    half = Angle.degrees(field_y / 2)
    if not half.sine or not half.cosine:
        return {}, {}  # of no angle that can be told from 0 or from 180°
    focal = half.cosine / half.sine
    aspect = roundest_ratio(x.image(lambda focal_x: focal / focal_x))
    return bounds, {
        "fov_y_deg": field_y,
        "fov_x_deg": _field_of(focal / aspect),
        "aspect": aspect,
    }


def _field_of(focal: Fraction) -> Fraction:
    return 2 * arctangent(1 / focal) * DEGREES


def _window(near: Fraction, fields: Mapping[str, Bound]) -> dict[str, Bound]:
    half = Angle.degrees(Fraction(fields["fov_y_deg"]) / 2)
    top = near * half.sine / half.cosine
    right = top * Fraction(fields["aspect"])
    return {"left": -right, "right": right, "bottom": -top, "top": top}


def _parallels(P: _Entries) -> Iterator[LensReading]:
    if not P.may_be_zero("01", "02", "10", "12", "20", "21", "30", "31", "32"):
        return
    x, y, z = P.at(0, 0), P.at(1, 1), P.at(2, 2)
    if 1 not in P.at(3, 3) or not (x.sign and y.sign and z.sign):
        return
    clip_y = ClipY.UP if y.sign > 0 else ClipY.DOWN
    sides = {
        ("left", "right"): _Line(x, P.at(0, 3)),
        ("bottom", "top"): _Line(y * y.sign, P.at(1, 3) * y.sign),
    }
    for hand, g in ((Handedness.RIGHT, -1), (Handedness.LEFT, 1)):
        for depth, (at_near, at_far) in NDC_DEPTH.items():
            if z.sign * g != (1 if at_far > at_near else -1):
                continue
            lines = sides | {("near", "far"): _Line(z * g, P.at(2, 3), at_near, at_far)}
            bounds: dict[str, Interval] = {}
            values: dict[str, Bound] = {}
            for names, line in lines.items():
                ends = line.round_ends()
                if ends is not None:
                    bounds |= dict(
                        zip(names, (line.end(line.at_low), line.end(line.at_high)), strict=True)
                    )
                    values |= dict(zip(names, ends, strict=True))
            yield LensReading(MatrixKind.ORTHOGRAPHIC, hand, clip_y, depth, bounds, values)


def _pair_cost(low: Bound, high: Bound) -> float:
    """Return the digits of two numbers; one that mirrors the other comes for nothing."""
    return digit_cost(high) + (0 if low == -high else digit_cost(low))


def _as_float(value: Bound) -> float:
    return nearest(value) if isinstance(value, Fraction) else inf
