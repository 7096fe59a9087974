"""What a matrix is, told from its entries alone: every reading that they allow, likeliest first.

A projection, a parallel projection, a place in the world or a view, stored by rows or by columns.
What its numbers came from is unknown, but people choose round ones: the reading whose numbers take
the fewest digits comes first.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property
from itertools import chain
from math import prod

from nmatrix.enums import Convention, Handedness, Layout, MatrixKind
from nmatrix.errors import NoAnswerError
from nmatrix.linear.affine import compose, rotation_by
from nmatrix.linear.angle import DEGREES, Angle
from nmatrix.linear.classify import Classification, classify
from nmatrix.linear.decompose import Parts, parts, parts_given
from nmatrix.linear.interval import Interval, digit_cost
from nmatrix.linear.lens_readings import LensReading, as_written, lens_readings
from nmatrix.linear.rational import (
    AFFINE_ROW,
    RationalMatrix,
    RationalVector,
    RoundedMatrix,
    affine_matrix,
    determinant,
    inverse,
    linear_part,
    rank,
    rational_vector,
    translation,
    transpose,
)
from nmatrix.linear.rounded import meant
from nmatrix.linear.view import first_person, look_at
from nmatrix.report import Vector

ORDERS = ("XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX")
MIRRORED = 1.0  # digits' worth of doubt: few objects are
NOISE = Fraction(1, 2**51)  # of the largest entry: what is left where nothing should be
# How far from what the digits say a round number is looked for, in parts of what they leave open.
REACHES = (Fraction(4), Fraction(1), Fraction(1, 4), Fraction(0))


@dataclass(frozen=True)
class Reading:
    """One thing that a matrix may be, stored in one layout; `lens` or `place` has the numbers."""

    kind: MatrixKind
    layout: Layout
    rows: RationalMatrix
    half_units: RationalMatrix
    lens: LensReading | None = None
    place: Place | None = None

    @property
    def cost(self) -> float:
        """How many digits its numbers take."""
        told = self.lens or self.place
        return 0.0 if told is None else told.cost

    @property
    def residual(self) -> Fraction | None:
        """The largest difference between an entry and the rebuilt matrix, in half units."""
        told = self.lens or self.place
        rebuilt = None if told is None else told.rebuilt
        if rebuilt is None:
            return None
        return largest_difference(rebuilt, self.rows, self.half_units)


@dataclass(frozen=True)
class Place:
    """Where an object stands, or what a camera sees: an affine matrix apart, in round numbers."""

    found: Classification
    parts: Parts | None
    as_object: RationalMatrix | None
    camera: Camera | None

    @property
    def cost(self) -> float:
        """How many digits it takes, as an object's place or as a camera's."""
        if self.is_view and self.camera is not None:
            return self.camera.cost
        return 0.0 if self.parts is None else parts_cost(self.parts)

    @property
    def is_view(self) -> bool:
        """Whether it takes fewer digits as a view than as an object's place."""
        if self.camera is None or self.camera.rebuilt is None:
            return False
        return self.parts is None or self.camera.cost < parts_cost(self.parts)

    @property
    def rebuilt(self) -> RationalMatrix | None:
        """The matrix that the simpler numbers make."""
        return self.camera.rebuilt if self.is_view and self.camera else self.as_object


@dataclass(frozen=True)
class Camera:
    """A camera whose view matrix it may be.

    `turn` is its elevation, its angle and its roll, in degrees.
    """

    eye: RationalVector
    turn: RationalVector
    mirrored: bool
    looks_at_origin: bool = False
    handed: Handedness = Handedness.RIGHT

    @cached_property
    def rebuilt(self) -> RationalMatrix | None:
        """The view matrix that these numbers make; a mirror makes none."""
        if self.mirrored:
            return None
        if self.looks_at_origin:
            try:
                return look_at(self.eye, (0, 0, 0), handed=self.handed).camera_from_world
            except NoAnswerError:
                return None
        elevation, angle, roll = map(Angle.degrees, self.turn)
        return first_person(self.eye, elevation, angle, roll)

    @property
    def cost(self) -> float:
        """How many digits it takes."""
        return sum(map(digit_cost, self.eye if self.looks_at_origin else (*self.eye, *self.turn)))


def identify(rows: RationalMatrix) -> tuple[Reading, ...]:
    """Read a 3×3 or a 4×4 matrix in every way that its entries allow, the likeliest first.

    Rows that were rounded are known to their shared half units, all others to a float64.

    Examples
    --------
    >>> turned = rotation_by((0, 0, 90))
    >>> [(str(one.kind), str(one.layout)) for one in identify(turned)]
    [('rigid', 'row-major'), ('rigid', 'column-major')]
    """
    rows, known = as_written(rows)
    found = list(_readings(rows, known, Layout.ROW_MAJOR))
    if transpose(rows) != rows:
        found += _readings(transpose(rows), transpose(known), Layout.COLUMN_MAJOR)
    if any(one.lens is not None and one.lens.factor == 1 for one in found):
        found = [one for one in found if one.lens is None or one.lens.factor == 1]
    if not found:
        kind = MatrixKind.GENERAL if rank(rows) == len(rows) else MatrixKind.SINGULAR
        return (Reading(kind, Layout.ROW_MAJOR, rows, known),)
    return tuple(sorted(found, key=lambda one: one.cost))  # equals stay by rows


def largest_difference(
    rebuilt: RationalMatrix, rows: RationalMatrix, half_units: RationalMatrix
) -> Fraction:
    """Return the largest difference of two matrices, entry by entry, in half units of the second.

    Where that has none, in roundings of its largest entry. Of a 4×4 that stands beside a 3×3 only
    the block counts.
    """
    size = len(rows)
    noise = NOISE * max(abs(entry) for entry in chain(*rows))
    built = chain.from_iterable(row[:size] for row in rebuilt[:size])
    return max(
        abs(entry - other) / (half or noise)
        for entry, other, half in zip(chain(*rows), built, chain(*half_units), strict=True)
    )


def _readings(
    rows: RationalMatrix, half_units: RationalMatrix, layout: Layout
) -> Iterator[Reading]:
    if len(rows) == 4:
        for lens in lens_readings(RoundedMatrix.of(rows, half_units)):
            yield Reading(lens.kind, layout, rows, half_units, lens)
    if len(rows) == 3 or rows[3] == AFFINE_ROW:
        place = _place(rows, half_units)
        if place.found.rank < 3:
            kind = MatrixKind.SINGULAR
        else:
            kind = MatrixKind.RIGID if place.found.is_rigid else MatrixKind.AFFINE
        yield Reading(kind, layout, rows, half_units, place=place)


def _place(rows: RationalMatrix, half_units: RationalMatrix) -> Place:
    known = half_units if len(rows) == 4 else affine_matrix(half_units)
    typed = RoundedMatrix.of(rows if len(rows) == 4 else affine_matrix(rows), known)
    sharp = meant(typed)
    found = classify(rows, stands_for=sharp)
    told = [one for one in (_round_parts(sharp, typed, order) for order in ORDERS) if one]
    taken, built = min(told, key=lambda one: parts_cost(one[0]), default=(None, None))
    camera = _camera(sharp, typed) if found.is_rigid else None
    return Place(found, taken, built, camera)


def round_parts(
    typed: RoundedMatrix, order: str, convention: Convention = Convention.STANDARD
) -> Parts | None:
    """Take a rounded 4×4 apart, in the roundest numbers that still make the digits typed.

    Examples
    --------
    >>> turned = affine_matrix(rotation_by((0, 0, 30)))
    >>> known = tuple(tuple(Fraction(1, 20000) for _ in row) for row in turned)
    >>> [float(one) for one in round_parts(RoundedMatrix.of(turned, known), "XYZ").rotate]
    [0.0, 0.0, 30.0]
    """
    found = _round_parts(meant(typed), typed, order, convention)
    return None if found is None else found[0]


def _round_parts(
    sharp: RationalMatrix,
    typed: RoundedMatrix,
    order: str,
    convention: Convention = Convention.STANDARD,
) -> tuple[Parts, RationalMatrix] | None:
    taken = parts(sharp, order, convention)
    if taken is None:
        return None
    columns = [max(column) for column in transpose(linear_part(typed.half_units))]
    known = max(columns)
    least = min(abs(Fraction(one)) for one in taken.scale)
    angle = known / least * Fraction(DEGREES)
    for reach in REACHES:
        rotate = _round_all(taken.rotate, reach, (angle,) * 3)
        R = rotation_by(rotate, order, convention)
        rounder = replace(
            parts_given(R, rotate, order, convention),
            translate=_round_all(taken.translate, reach, translation(typed.half_units)),
            scale=_round_all(taken.scale, reach, columns),
            shear=_round_all(taken.shear, reach, (known / least,) * 3),
            given=False,
        )
        built = compose(
            R,
            rational_vector(rounder.scale),
            rational_vector(rounder.shear),
            rational_vector(rounder.translate),
        )
        if largest_difference(built, typed, typed.half_units) <= 1:
            break
    return rounder, built


def _camera(sharp: RationalMatrix, typed: RoundedMatrix) -> Camera:
    """Read a rigid matrix as a view: V = Rz(−roll) · Rx(−elevation) · Ry(−angle) · T(−eye)."""
    block = linear_part(sharp)
    mirrored = determinant(block) < 0
    if mirrored:
        block = (*block[:2], tuple(-entry for entry in block[2]))
    moved = max(translation(typed.half_units)) + max(map(max, linear_part(typed.half_units))) * sum(
        map(abs, translation(typed))
    )
    eye = translation(inverse(sharp))
    turned = parts(affine_matrix(block), "ZXY")
    assert turned is not None  # a rigid map is not singular
    x, y, z = turned.rotate
    spread = max(map(max, linear_part(typed.half_units))) * Fraction(DEGREES)
    for reach in REACHES:
        camera = Camera(
            _round_all(eye, reach, (moved,) * 3),
            tuple(-one for one in _round_all((x, y, z), reach, (spread,) * 3)),
            mirrored,
        )
        at_origin = replace(camera, looks_at_origin=True)
        for told in (at_origin, replace(at_origin, handed=Handedness.LEFT), camera):
            built = told.rebuilt
            if built is not None and largest_difference(built, typed, typed.half_units) <= 1:
                return told
    return camera


def _round_all(values: Vector, reach: Fraction, spreads: Iterable[Fraction]) -> RationalVector:
    """Return the roundest numbers within so much of what the digits leave open."""
    intervals = (
        Interval.around(Fraction(value), reach * spread)
        for value, spread in zip(values, spreads, strict=True)
    )
    return tuple(Fraction(one.roundest()) for one in intervals)


def parts_cost(taken: Parts) -> float:
    """Count the digits of the parts; one scale for all three axes is one number."""
    scale = set(taken.scale) - {Fraction(1)}
    numbers: tuple[float | Fraction, ...] = (*taken.translate, *taken.rotate, *scale, *taken.shear)
    mirrored = MIRRORED if prod(taken.scale) < 0 else 0.0
    return mirrored + sum(digit_cost(Fraction(one)) for one in numbers)
