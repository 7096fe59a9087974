"""The world matrix step by step: rotations from their angles; T, R, S and H multiplied in turn."""

from __future__ import annotations

from fractions import Fraction
from math import prod

from nmatrix.linear.affine import (
    rotation_about,
    rotation_from_quaternion,
    sequence,
    shear_matrix,
    translation_matrix,
)
from nmatrix.linear.angle import Angle
from nmatrix.linear.rational import diagonal
from nmatrix.report import Formula, Step
from nmatrix.scene.world import World
from nmatrix.surds import sine
from nmatrix.working.inverses import affine
from nmatrix.working.products import chained, unit_check
from nmatrix.working.vectors import unit
from nmatrix.working.working import (
    KNOWN,
    NEAR,
    SHORT,
    Matrix,
    Notation,
    Vector,
    Working,
    as_typed,
    chain,
    decimal,
    exactly_or_near,
    identity,
    middle,
    squared,
    stands_for,
    transposed,
)

Factors = list[tuple[str, Matrix]]
_ABOUT = {
    "X": (("1", "0", "0"), ("0", "cx", "−sx"), ("0", "sx", "cx")),
    "Y": (("cy", "0", "sy"), ("0", "1", "0"), ("−sy", "0", "cy")),
    "Z": (("cz", "−sz", "0"), ("sz", "cz", "0"), ("0", "0", "1")),
}
_BY_QUATERNION = (
    ("|q|² − 2(y² + z²)", "2(x y − z w)", "2(x z + y w)"),
    ("2(x y + z w)", "|q|² − 2(x² + z²)", "2(y z − x w)"),
    ("2(x z − y w)", "2(y z + x w)", "|q|² − 2(x² + y²)"),
)
_BY_AXIS = (
    ("c + (1 − c) x²", "(1 − c) x y − s z", "(1 − c) x z + s y"),
    ("(1 − c) x y + s z", "c + (1 − c) y²", "(1 − c) y z − s x"),
    ("(1 − c) x z − s y", "(1 − c) y z + s x", "c + (1 − c) z²"),
)


def world_matrix(world: World) -> Working:
    """Work out the world matrix of an object; the last line compares its determinant.

    A rotation, a scale or a shear that changes nothing is left out. Sines of multiples of 15° are
    sums of roots, others are known to 130 bits.

    Examples
    --------
    >>> found = world_matrix(World(translate=(1, 2, 3), scale=(2, 2, 1)))
    >>> found.steps[-1].formula.parts
    ('det M = 2·2·1 = 4',)
    >>> [int(row[3]) for row in found.value]
    [1, 2, 3, 1]
    """
    if world.matrix is not None:
        given: Matrix = tuple(tuple(map(stands_for, row)) for row in world.matrix)
        return Working((_part("M", given, "the whole matrix, as it is given", SHORT),), given)
    if _has_roots(world):
        return exactly_or_near(lambda by: _of_parts(world, by))
    return _of_parts(world, NEAR)


def _of_parts(world: World, by: Notation) -> Working:
    steps, factors = _rotation(world, by)
    scale, shear, t = (
        tuple(map(as_typed, one)) for one in (world.scale, world.shear, world.translate)
    )
    if any(one != 1 for one in scale):
        factors.append(("S", diagonal(scale)))
        steps.append(_part(*factors[-1], "the scale: three numbers on the diagonal", by))
    if any(shear):
        factors.append(("H", shear_matrix(shear)))
        steps.append(_part(*factors[-1], "the shear: x moves along with y and z, y with z", by))
    block, name, products = _multiplied(factors, by)
    moved, M = _moved(block, t, name, by)
    volume = prod(scale, start=Fraction(1))
    factors_of_det = "·".join(by.factor(s, is_first=not i) for i, s in enumerate(scale))
    check = by.step(
        chain("det M", (factors_of_det, by.write(volume))),
        because="the check: only the scale changes volumes",
        proved=by.same(by.determinant(transposed(tuple(row[:3] for row in M[:3]))), volume),
    )
    return Working((*steps, *products, *moved, check), M)


def _part(name: str, part: Matrix, because: str, by: Notation) -> Step:
    return by.step(f"{name} = ", part, because=because, proved=True)


def _has_roots(world: World) -> bool:
    """Tell whether all sines and cosines are sums of roots."""
    if world.quaternion is not None:
        return True
    degrees = world.rotate_degrees if world.axis_angle is None else world.axis_angle[3:]
    return all(_exact_angle(angle) is not None for angle in map(as_typed, degrees))


def _exact_angle(degrees: Fraction) -> Angle | None:
    s, c = sine(degrees), sine(90 - degrees)
    if s is None or c is None:
        return None
    return Angle(s, c)  # type: ignore[arg-type]  # the builders only multiply and add them


def _angle(degrees: Fraction) -> Angle:
    return _exact_angle(degrees) or Angle.degrees(degrees)


def _rotation(world: World, by: Notation) -> tuple[list[Step], Factors]:
    """Work out the rotation: its steps, and R itself if it turns anything."""
    if world.quaternion is not None:
        return _by_quaternion(tuple(map(as_typed, world.quaternion)), by)
    if world.axis_angle is not None:
        *axis, angle = map(as_typed, world.axis_angle)
        return _by_axis(tuple(axis), angle, by)
    turns = sequence(tuple(map(as_typed, world.rotate_degrees)), world.order, world.convention)
    return turned([(axis, degrees) for axis, degrees in turns if degrees], by)


def turned(turns: list[tuple[str, Fraction]], by: Notation) -> tuple[list[Step], Factors]:
    """Multiply rotations about axes, by degrees, in their order: the steps, and R if there is any.

    Examples
    --------
    >>> steps, ((name, R),) = turned([("Z", Fraction(90))], SHORT)
    >>> name, steps[0].formula.parts
    ('Rz', ('cz = cos(90°) = 0,  sz = sin(90°) = 1',))
    """
    factors: Factors = []
    steps: list[Step] = []
    for axis, degrees in turns:
        R = rotation_about(axis, _angle(degrees))
        name = f"R{axis.lower()}"
        filled = Formula((f"{name} = ", _ABOUT[axis], " = ", by.rows(R)))
        about = f"the rotation about {axis.lower()}, by the right-hand rule"
        steps += [
            _sine_and_cosine(degrees, by, axis.lower()),
            Step(filled, about, _turns_only(R, by)),
        ]
        factors.append((name, R))
    if len(factors) < 2:
        return steps, factors
    found = chained([R for _, R in factors], [name for name, _ in factors], "R", by)
    return [*steps, *found.steps], [("R", found.value)]


def has_roots(degrees: Fraction) -> bool:
    """Tell whether a sine and a cosine are sums of roots.

    Examples
    --------
    >>> has_roots(Fraction(30)), has_roots(Fraction(20))
    (True, False)
    """
    return _exact_angle(degrees) is not None


def _sine_and_cosine(degrees: Fraction, by: Notation, axis: str = "") -> Step:
    turn, known = _angle(degrees), Angle.degrees(degrees)
    sign = "=" if has_roots(degrees) else "≈"
    text = decimal(degrees)
    near = (
        abs(middle(one) - other) < KNOWN
        for one, other in ((turn.cosine, known.cosine), (turn.sine, known.sine))
    )
    line = (
        f"c{axis} = cos({text}°) {sign} {by.write(turn.cosine)},  "
        f"s{axis} = sin({text}°) {sign} {by.write(turn.sine)}"
    )
    return by.step(line, because="the cosine and the sine of the angle", proved=all(near))


def _turns_only(R: Matrix, by: Notation) -> bool:
    """Tell whether the columns have length 1, stand on each other, and are right-handed."""
    is_orthonormal = by.is_identity(by.product(transposed(R), R))
    return is_orthonormal and by.same(by.determinant(R), Fraction(1))


def _by_quaternion(q: Vector, by: Notation) -> tuple[list[Step], Factors]:
    R = rotation_from_quaternion(q)
    squares = [by.tidy(one * one) for one in q]
    size = by.sum(squares)
    texts = (
        " + ".join(squared(by.write(one)) for one in q),
        by.added(squares),
        by.write(size),
    )
    names = ",  ".join(f"{name} = {by.write(one)}" for name, one in zip("xyzw", q, strict=True))
    undivided = by.rows(tuple(by.scaled(row, size) for row in R))
    over = by.factor(1 / size, is_first=True)
    parts = ("R = 1/|q|² · ", _BY_QUATERNION, f" = {over} · ", undivided, " = ", by.rows(R))
    about = "the rotation of a quaternion of any length"
    steps = [
        by.step(names, because="the quaternion, as it is given", proved=True),
        by.step(
            chain("|q|²", texts),
            because="the square of its length",
            proved=by.same(by.dot(q[::-1], q[::-1]), size),
        ),
        Step(Formula(parts), about, _turns_only(R, by)),
        _check(R, by),
    ]
    return steps, [("R", R)]


def _by_axis(axis: Vector, degrees: Fraction, by: Notation) -> tuple[list[Step], Factors]:
    """Turn about an axis: R = c I + (1 − c) n nᵀ + s [n]× for its unit vector n."""
    found = unit(axis, "a", "n", by)
    R = _about_unit(found.value, _angle(degrees), by)
    steps = [
        by.step("a = ", axis, because="the axis, as it is given", proved=True),
        *found.steps,
        _sine_and_cosine(degrees, by),
        Step(
            Formula(("R = ", _BY_AXIS, " = ", by.rows(R))),
            "the rotation about n = (x, y, z), by the right-hand rule",
            _turns_only(R, by),
        ),
        _check(R, by),
    ]
    return steps, [("R", R)]


def _about_unit(n: Vector, turn: Angle, by: Notation) -> Matrix:
    c, s = turn.cosine, turn.sine
    x, y, z = n
    crossed = ((0, -z, y), (z, 0, -x), (-y, x, 0))
    return tuple(
        tuple(
            by.tidy(c * int(i == j) + (1 - c) * n[i] * n[j] + s * crossed[i][j]) for j in range(3)
        )
        for i in range(3)
    )


def _check(R: Matrix, by: Notation) -> Step:
    about = "the check: its columns have length 1 and stand on each other"
    return unit_check(transposed(R), R, ("Rᵀ", "R"), by, about)


def _multiplied(factors: Factors, by: Notation) -> tuple[Matrix, str, tuple[Step, ...]]:
    """Multiply R, S and H, as far as they are there: the 3×3 block, its name, and the steps."""
    if len(factors) < 2:
        ((name, A),) = factors or [("I", identity(3))]
        return A, name, ()
    found = chained([one for _, one in factors], [name for name, _ in factors], "A", by)
    return found.value, "A", found.steps


def _moved(A: Matrix, t: Vector, name: str, by: Notation) -> tuple[list[Step], Matrix]:
    """Multiply by T from the left, which puts the translation beside the block."""
    grown = affine(A, (Fraction(0),) * 3)
    if not any(t):
        nothing = "nothing is turned, scaled or moved"
        about = (
            nothing
            if name == "I"
            else f"{name} with a fourth row and column; nothing is moved, so T = I"
        )
        return [_part("M", grown, about, by)], grown
    T, M = translation_matrix(t), affine(A, t)
    product = by.step(
        "M = T · L = ",
        T,
        " · ",
        grown,
        " = ",
        M,
        because=f"L is {name} with a fourth row and column; T puts its last column beside it",
        proved=by.same(by.product(T, grown), M),
    )
    return [_part("T", T, "the translation stands in the last column", by), product], M
