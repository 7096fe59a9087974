"""The view matrix step by step: the camera's axes from eye, target and up, or from its angles.

f is the direction in which the camera looks, r its right, u its up; e is the eye, c the target.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from nmatrix.enums import CameraAxes, Convention, Handedness
from nmatrix.errors import NoAnswerError
from nmatrix.linear.rational import ONE, ZERO, rational_vector
from nmatrix.linear.view import looking_along
from nmatrix.report import Step
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.measured_view import OTHER_AXES, Extrinsics, MeasuredView
from nmatrix.working.inverses import affine, inverse
from nmatrix.working.products import difference, product
from nmatrix.working.vectors import crossed, unit
from nmatrix.working.working import (
    NEAR,
    SHORT,
    Matrix,
    Notation,
    Proof,
    Vector,
    Working,
    as_typed,
    cells_or_entries,
    exactly_or_near,
    identity,
    in_one_line,
    stands_for,
    transposed,
)
from nmatrix.working.world import has_roots, turned


def view_matrix(view: View) -> Working:
    """Work out the view matrix of a camera; the last line takes the eye to the origin.

    Raises
    ------
    NoAnswerError
        If eye and target coincide, or `up` is zero.

    Examples
    --------
    >>> found = view_matrix(View(eye=(0, 0, 5)))
    >>> [int(row[3]) for row in found.value]
    [0, 0, -5, 1]
    """
    if view.matrix is not None:
        V = tuple(tuple(map(stands_for, row)) for row in view.matrix)
        about = "the whole matrix, as it is given"
        return Working((SHORT.step("V = ", V, because=about, proved=True),), V)
    if view.measured is not None:
        return _measured(view.measured)
    eye = tuple(map(as_typed, view.eye))
    if view.angles is not None:
        return _first_person(eye, view.angles, view.convention)
    target, up = (tuple(map(as_typed, one)) for one in (view.target, view.up))
    return look_at(eye, target, up, view.handed)


def look_at(
    eye: Vector,
    target: Vector,
    up: Vector = (ZERO, ONE, ZERO),
    handed: Handedness = Handedness.RIGHT,
) -> Working:
    """Work out the view matrix of a camera at `eye` that looks at `target`.

    Where `up` is parallel to the view direction, the axis that takes its place is written down.

    Raises
    ------
    NoAnswerError
        If eye and target coincide, or `up` is zero.

    Examples
    --------
    >>> found = look_at((0, 0, 5), (0, 0, 0))
    >>> print(*found.value[2])
    0 0 1 -5
    """
    e, c, upward = map(rational_vector, (eye, target, up))
    return exactly_or_near(lambda by: _look_at(e, c, upward, handed, by))


def _look_at(eye: Vector, target: Vector, up: Vector, handed: Handedness, by: Notation) -> Working:
    towards = difference(target, eye, ("c", "e"), "d", by)
    d = tuple(towards.value)
    if not any(d):
        raise NoAnswerError(
            "eye and target",
            "they coincide, so there is no direction to look in",
            "move one of them",
        )
    stand_in = looking_along(rational_vector(eye), d, rational_vector(up), handed).stand_in
    ahead = unit(d, "d", "f", by)
    first: list[Step] = [*_whole(towards.steps, "from the eye to the target")]
    first += _whole(ahead.steps, "that direction, with length 1")
    if stand_in is not None:
        up = stand_in
        about = "up is parallel to f and says nothing about roll: this axis takes its place"
        first.append(by.step("up = ", up, because=about, proved=True))
    f, is_left = ahead.value, handed is Handedness.LEFT
    side = crossed(up, f, ("up", "f"), "s", by) if is_left else crossed(f, up, ("f", "up"), "s", by)
    right = unit(side.value, "s", "r", by)
    r = right.value
    upper = crossed(f, r, ("f", "r"), "u", by) if is_left else crossed(r, f, ("r", "f"), "u", by)
    third = f if is_left else by.scaled(f, -ONE)
    first += _whole(side.steps, "to the right: perpendicular to f and to up")
    first += _whole(right.steps, "the camera's right, with length 1")
    first += _whole(upper.steps, "the camera's up, which has length 1 as r and f have")
    about = f"R has the rows r, u and {'f' if is_left else '−f'}"
    return _placed(Block("R", (r, upper.value, third), about), eye, first, by)


def _whole(steps: Sequence[Step], because: str) -> tuple[Step, ...]:
    """Write an operation on one line: what it is, its cells, its result."""
    if len(steps) > 3:  # so wide that each entry has a line
        return tuple(steps)
    return (in_one_line(steps[0], steps[-1], because),)


@dataclass(frozen=True)
class Block:
    """The 3×3 block of a view matrix, its name, and where it comes from."""

    name: str
    rows: Matrix
    because: str


def _placed(R: Block, eye: Vector, steps: Sequence[Step], by: Notation) -> Working:
    """Put the rotation and the eye into one matrix: V = [R, −R e]."""
    t = by.scaled(by.apply(R.rows, eye), -ONE)
    V = affine(R.rows, t)
    image, origin = by.apply(V, (*eye, ONE)), (ZERO, ZERO, ZERO, ONE)
    at_origin = by.same(image, origin)
    is_turn = by.is_identity(by.product(transposed(R.rows), R.rows))
    cells = [(f"−({by.products(list(zip(row, eye, strict=True)))})",) for row in R.rows]
    about = f"{R.because}; the eye must come to the origin"
    proof = Proof(by, "t", about, "minus row {row} times the eye", at_origin)
    moved = cells_or_entries(f"t = −{R.name} e", cells, [(x,) for x in t], about, proof)
    check = by.step(
        "V · (e, 1) = ",
        V,
        " · ",
        (*eye, ONE),
        " = ",
        origin if at_origin else image,
        because="the check: the eye is the camera's origin",
        proved=at_origin,
    )
    matrix = by.step("V = ", V, because=f"{R.name}, and t beside it", proved=is_turn)
    return Working((*steps, *_whole(moved, about), matrix, check), V)


def _first_person(eye: Vector, angles: FirstPerson, convention: Convention) -> Working:
    """Turn the world back by the angles: V = Rz(−roll) Rx(−elevation) Ry(−angle) T(−e)."""
    roll, elevation, angle = map(as_typed, (angles.roll, angles.elevation, angles.angle))
    sideways = angle if convention is Convention.POLIMI else -angle
    turns = [("Z", -roll), ("X", -elevation), ("Y", sideways)]
    by = SHORT if all(has_roots(one) for _, one in turns) else NEAR
    steps, factors = turned([(axis, one) for axis, one in turns if one], by)
    ((name, R),) = factors or [("I", identity(3))]
    about = f"{name} turns the world the other way than the camera was turned"
    if not factors:
        about = "the camera was not turned"
    return _placed(Block(name, R, about), eye, steps, by)


def _measured(measured: MeasuredView) -> Working:
    """Turn a pose round, and half a turn about x where its axes are those of computer vision."""
    given = tuple(tuple(map(stands_for, row)) for row in measured.matrix)
    name, inner = "E", given
    steps: tuple[Step, ...] = (
        SHORT.step("E = ", given, because="[R t], as it is given", proved=True),
    )
    if not isinstance(measured, Extrinsics):
        back = inverse(given, "W", by=SHORT)
        steps, name, inner = back.steps, "W⁻¹", back.value
        if measured.axes is CameraAxes.OPENGL:
            last = SHORT.step("V = W⁻¹ = ", inner, because="the pose turned round", proved=True)
            return Working((*steps, last), inner)
    turned_over = product(OTHER_AXES, inner, ("F", name), "V", SHORT)
    about = "half a turn about x: y down and z ahead become y up and z back"
    F = SHORT.step("F = ", OTHER_AXES, because=about, proved=True)
    return Working((*steps, F, *turned_over.steps), turned_over.value)
