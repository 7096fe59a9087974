"""The projection matrix step by step: similar triangles for x and y, two equations for depth.

d is the distance in front of the eye, n that of near and f that of far; l, r, b, t are the sides of
what is seen, X, Y, D a place on the screen and its depth.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from math import inf

from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import NDC_DEPTH
from nmatrix.linear.rational import ONE, ZERO
from nmatrix.report import Step
from nmatrix.scene.lens import Lens
from nmatrix.surds import sine
from nmatrix.working.working import (
    NEAR,
    SHORT,
    Entry,
    Matrix,
    Notation,
    Vector,
    Working,
    as_typed,
    chain,
    decimal,
    stands_for,
)


def projection_matrix(lens: Lens) -> Working:
    """Work out the projection matrix of a lens; the last lines put two corners through it.

    Raises
    ------
    IllegalValueError, NoAnswerError
        For a lens that shows nothing.

    Examples
    --------
    >>> found = projection_matrix(Lens(fov_degrees=90, near=1, far=3))
    >>> for row in found.value:
    ...     print(*row)
    1 0 0 0
    0 1 0 0
    0 0 -2 -3
    0 0 -1 0
    """
    exact = lens.exact
    if lens.matrix is not None:
        P = tuple(tuple(map(stands_for, row)) for row in exact)
        about = "the whole matrix, as it is given"
        return Working((SHORT.step("P = ", P, because=about, proved=True),), P)
    return _Derivation(lens, NEAR if _tangent(lens) is None else SHORT).whole()


def _tangent(lens: Lens) -> Entry | None:
    """Find the tangent of half the field of view where it is a sum of roots."""
    half = as_typed(lens.fov_degrees) / 2
    s, c = sine(half), sine(90 - half)
    return None if s is None or c is None or not c else s / c


@dataclass(frozen=True)
class _Derivation:
    """The lines of one lens."""

    lens: Lens
    by: Notation

    def whole(self) -> Working:
        """Put the sides, the depth and the matrix one after the other, and check two corners."""
        is_parallel = self.lens.ortho is not None
        first, sides = self._parallel_sides() if is_parallel else self._sides()
        g, y = self.lens.clip.forward_z, self.lens.clip.y_sign
        wide, (kx, ox) = self._mapped("x", "l", "r", sides[:2], 1)
        high, (ky, oy) = self._mapped("y", "b", "t", sides[2:], y)
        depth, (p, q) = self._parallel_depth() if is_parallel else self._depth()
        if is_parallel:
            offsets, last = ((ZERO, -ox), (ZERO, -oy)), (ZERO, ZERO, ZERO, ONE)
            about = "the factors of x, y and z, and behind them what is added; w stays 1"
        else:
            offsets, last = ((-g * ox, ZERO), (-g * oy, ZERO)), (ZERO, ZERO, Fraction(g), ZERO)
            about = f"X, Y and D times d = {self._distance}, and w = d: the division comes later"
        P: Matrix = (
            (kx, ZERO, *offsets[0]),
            (ZERO, ky, *offsets[1]),
            (ZERO, ZERO, g * p, q),
            last,
        )
        checks = tuple(self._checks(P, sides))
        proved = all(one.verified for one in checks)
        matrix = self.by.step("P = ", P, because=about, proved=proved)
        return Working((*first, *wide, *high, *depth, matrix, *checks), P)

    @property
    def _distance(self) -> str:
        return "−z" if self.lens.clip.forward_z < 0 else "z"

    def _sides(self) -> tuple[list[Step], Vector]:
        """Find what is seen at distance 1."""
        triangles = self.by.step(
            f"x′ = x/d,  y′ = y/d,  d = {self._distance}",
            because="similar triangles: at distance 1 a point is seen at x′, y′",
            proved=True,
        )
        line, sides = self._sides_at_one()
        return [triangles, line], sides

    def _sides_at_one(self) -> tuple[Step, Vector]:
        if self.lens.frustum is not None:
            window, n = self.lens.frustum, as_typed(self.lens.near)
            near = tuple(map(as_typed, (window.left, window.right, window.bottom, window.top)))
            sides = self.by.scaled(near, ONE / n)
            texts = (
                chain(
                    name,
                    (f"{_above(self.by.write(a))}/{_below(self.by.write(n))}", self.by.write(b)),
                )
                for name, a, b in zip("lrbt", near, sides, strict=True)
            )
            about = "the sides of the rectangle at near, over its distance n"
            proved = self.by.same(self.by.scaled(sides, n), near)
            return self.by.step(",  ".join(texts), because=about, proved=proved), sides
        measured = self.lens.measured_sides
        if measured is not None:
            sides = tuple(map(as_typed, measured))
            told = zip("lrbt", sides, strict=True)
            line = ",  ".join(f"{name} = {self.by.write(side)}" for name, side in told)
            about = "the sides of what the camera sees at distance 1, as it was measured"
            return self.by.step(line, because=about, proved=True), sides
        return self._by_angle()

    def _by_angle(self) -> tuple[Step, Vector]:
        """Find the sides of a field of view: t = tan(fov/2), r = aspect · t."""
        fov, aspect = as_typed(self.lens.fov_degrees), as_typed(self.lens.aspect_ratio)
        known, near = _tangent(self.lens), Angle.degrees(fov / 2)
        t = near.sine / near.cosine if known is None else known
        r = self.by.tidy(aspect * t)
        sign = "≈" if known is None else "="
        across = chain("r", (f"{self.by.write(aspect)} t", self.by.write(r)))
        if aspect == 1:
            across = "r = t"
        line = (
            f"t = tan({decimal(fov / 2)}°) {sign} {self.by.write(t)},  b = −t,  {across},  l = −r"
        )
        about = "half the field of view is above the axis; the width is the aspect times the height"
        proved = NEAR.same(t * near.cosine, near.sine)
        return self.by.step(line, because=about, proved=proved), (-r, r, -t, t)

    def _parallel_sides(self) -> tuple[list[Step], Vector]:
        window = self.lens.ortho
        assert window is not None  # who calls has looked
        sides = tuple(map(as_typed, (window.left, window.right, window.bottom, window.top)))
        told = zip("lrbt", sides, strict=True)
        line = ",  ".join(f"{name} = {self.by.write(side)}" for name, side in told)
        about = "the sides of the box, which are the same at every distance"
        return [self.by.step(line, because=about, proved=True)], sides

    def _mapped(
        self, axis: str, low_name: str, high_name: str, ends: Vector, sign: int
    ) -> tuple[list[Step], tuple[Entry, Entry]]:
        """Take a side to −1 and its opposite to 1: X = k x′ − o."""
        low, high = ends
        write, tidy = self.by.write, self.by.tidy
        extent, middle = tidy(high - low), tidy(high + low)
        k, o = tidy(sign * 2 / extent), tidy(sign * middle / extent)
        minus = "−" if sign < 0 else ""
        below = _below(write(extent))
        top = self.by.factor(middle) if minus else write(middle)
        scale = chain(
            f"k{axis}", (f"{minus}2/({high_name} − {low_name})", f"{minus}2/{below}", write(k))
        )
        offset = chain(
            f"o{axis}",
            (
                f"{minus}({high_name} + {low_name})/({high_name} − {low_name})",
                f"{minus}{_above(top)}/{below}",
                write(o),
            ),
        )
        prime = "′" if self.lens.ortho is None else ""
        about = f"{axis.upper()} = k{axis} {axis}{prime} − o{axis} takes {low_name} to "
        about += f"{'1' if sign < 0 else '−1'} and {high_name} to {'−1' if sign < 0 else '1'}"
        if sign < 0:
            about += ": y runs down in clip space"
        proved = self.by.same(tidy(k * high - o), Fraction(sign))
        proved = proved and self.by.same(tidy(k * low - o), Fraction(-sign))
        return [self.by.step(f"{scale},  {offset}", because=about, proved=proved)], (k, o)

    def _depth(self) -> tuple[list[Step], tuple[Fraction, Fraction]]:
        """Solve p + q/n = D at near, p + q/f = D at far; 1/f is 0 for a far at infinity."""
        at_near, at_far = NDC_DEPTH[self.lens.clip.depth]
        n, write = as_typed(self.lens.near), self.by.write
        over_n = ONE / n
        over_f = ZERO if self.lens.far == inf else ONE / as_typed(self.lens.far)
        q = (at_near - at_far) / (over_n - over_f)
        p = at_far - q * over_f
        at_n = f"p + q/n = p + {_times(over_n, 'q', self.by)} = {write(at_near)}"
        at_f = f"p + q/f = p + {_times(over_f, 'q', self.by)} = {write(at_far)}"
        put_in = f"{write(at_far)} − {self.by.factor(over_f)}·{self.by.factor(q)}"
        about = "depth is D = p + q/d, so that lines stay straight: one equation for each plane"
        if not over_f:
            at_f, put_in = f"p = {write(at_far)}", write(at_far)
            about = "depth is D = p + q/d, so that lines stay straight; infinitely far 1/d is 0"
        proved = p + q * over_n == at_near and p + q * over_f == at_far
        return self._solved(
            (f"{at_n},  {at_f}", about),
            chain(_times(over_n - over_f, "q", self.by), self._gap(at_near, at_far)),
            f"q = {write(q)},  {chain('p', (put_in, write(p)))}",
            proved=proved,
        ), (p, q)

    def _gap(self, one: int, other: int) -> tuple[str, str]:
        return f"{one} − {other}".replace("-", "−"), self.by.write(Fraction(one - other))

    def _solved(
        self, equations: tuple[str, str], difference: str, solution: str, *, proved: bool
    ) -> list[Step]:
        """Write two equations, what is left of their difference, and the two unknowns."""
        line, about = equations
        return [
            self.by.step(line, because=about, proved=proved),
            self.by.step(difference, because="one subtracted from the other", proved=proved),
            self.by.step(solution, because="divided, and put into one of them", proved=proved),
        ]

    def _parallel_depth(self) -> tuple[list[Step], tuple[Fraction, Fraction]]:
        """Solve p n + q = D at near, p f + q = D at far."""
        at_near, at_far = NDC_DEPTH[self.lens.clip.depth]
        n, f, write = as_typed(self.lens.near), as_typed(self.lens.far), self.by.write
        p = (at_far - at_near) / (f - n)
        q = at_near - p * n
        at_n, at_f = (
            f"{_times(one, 'p', self.by)} + q = {write(Fraction(depth))}"
            for one, depth in ((n, at_near), (f, at_far))
        )
        put_in = f"{at_near} − {self.by.factor(p)}·{self.by.factor(n)}"
        proved = p * n + q == at_near and p * f + q == at_far
        return self._solved(
            (f"{at_n},  {at_f}", "depth is D = p d + q: an equation for near and one for far"),
            chain(_times(f - n, "p", self.by), self._gap(at_far, at_near)),
            f"p = {write(p)},  {chain('q', (put_in.replace('-', '−'), write(q)))}",
            proved=proved,
        ), (p, q)

    def _checks(self, P: Matrix, sides: Vector) -> list[Step]:
        """Put the right upper corner at near through the matrix, and the left lower one at far."""
        lens, y = self.lens, Fraction(self.lens.clip.y_sign)
        at_near, at_far = map(Fraction, NDC_DEPTH[lens.clip.depth])
        left, right, bottom, top = sides
        corners = [("right upper corner at near", lens.near, right, top, (ONE, y, at_near, ONE))]
        if lens.far != inf:
            corners.append(
                ("left lower corner at far", lens.far, left, bottom, (-ONE, -y, at_far, ONE))
            )
        return [
            self._check(P, name, as_typed(distance), (x, up), ndc)
            for name, distance, x, up, ndc in corners
        ]

    def _check(self, P: Matrix, name: str, distance: Fraction, side: Vector, ndc: Vector) -> Step:
        reach = ONE if self.lens.ortho is not None else distance
        corner = (*self.by.scaled(side, reach), self.lens.clip.forward_z * distance, ONE)
        proved = self.by.same(self.by.apply(P, corner), self.by.scaled(ndc, reach))
        where = ", ".join(map(self.by.write, ndc[:3]))
        over = "" if reach == 1 else f"{self.by.factor(reach, is_first=True)} · "
        shown = ndc if proved else self.by.apply(P, corner)
        return self.by.step(
            "P · ",
            corner,
            f" = {over if proved else ''}",
            shown,
            because=f"the check: over w, the {name} is at ({where})",
            proved=proved,
        )


def _below(text: str) -> str:
    return text if text.replace(".", "").isdigit() else f"({text})"


def _above(text: str) -> str:
    return text if text.strip("()−").replace(".", "").isdigit() else f"({text.strip('()')})"


def _times(number: Fraction, name: str, by: Notation) -> str:
    return name if number == 1 else f"{by.factor(number, is_first=True)} {name}"
