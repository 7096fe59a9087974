"""What is known of a number: SymPy's exact surds for intervals, plain loops for rounded floats."""

from __future__ import annotations

import random
from fractions import Fraction
from math import atan2, cos, degrees, inf, isclose, radians, sin, sqrt

import mpmath
import pytest

from nmatrix.calculator.answer import OVERFLOWED, report
from nmatrix.calculator.arithmetic.numbers import (
    Interval,
    angle,
    bounds,
    degrees_of,
    enclosed,
    root,
    shown,
)
from nmatrix.calculator.arithmetic.values import Arithmetic, Value
from nmatrix.calculator.evaluate import calculate
from nmatrix.errors import NoAnswerError
from nmatrix.linear.rational import rational_matrix, rational_vector
from nmatrix.output.write import OutputOptions, write

ROOT_2 = "length([1,1])"
TINY = f"(99-70*{ROOT_2})"  # 0.005; its powers are as small as one likes, and none is 0
NOTHING = f"({ROOT_2}*{ROOT_2}-2)"  # roots are exact, and it is known to be 0
ROOTS = f"[[{ROOT_2},2],[1,{ROOT_2}]]"  # of rank 1
ZERO = "(sin(20)*sin(20)+cos(20)*cos(20)-1)"  # which no digits tell
SINGULAR = "[[sin(20),cos(20)],[2*sin(20),cos(20)*2]]"
DIGITS = 150  # of the oracle: the intervals know 85 at most


class Expressions:
    """Expressions over some irrationals, each as text and as the oracle's number."""

    def __init__(self, seed):
        self.chance = random.Random(seed)

    def number(self, depth):
        """Draw an expression; its number is None where something was divided by 0."""
        draw = self.chance
        if depth == 0 or draw.random() < 0.1:
            if draw.random() < 0.4:
                n = draw.randint(-3, 3)
                return f"({n})", self.rational(n)
            return draw.choice(list(self.roots.items()))
        if draw.random() < 0.3:
            return self._cancelling(depth - 1)
        (left, a), (right, b) = self.number(depth - 1), self.number(depth - 1)
        return self._joined(draw.choice("+-**/"), (left, a), (right, b))

    def _cancelling(self, depth):
        """(x + y)(x − y) − x² + y² is 0, and one more or less is a unit away from it."""
        (x, a), (y, b) = self.number(depth), self.number(depth)
        more = self.chance.choice(self.more)
        text = f"(({x}+{y})*({x}-{y})-{x}*{x}+{y}*{y}+{more})"
        if a is None or b is None:
            return text, None
        return text, self.rational(Fraction(more))

    def _joined(self, sign, left, right):
        (x, a), (y, b) = left, right
        text = f"({x}{sign}{y})"
        if a is None or b is None or (sign == "/" and self.is_zero(b)):
            return text, None
        return text, {"+": a + b, "-": a - b, "*": a * b}[sign] if sign != "/" else a / b


class Surds(Expressions):
    """Over √2 and √3, exactly, as SymPy's field has them."""

    more = ("0", "0", "1", "1e-60")

    def __init__(self, seed):
        from sympy import QQ, sqrt

        super().__init__(seed)
        self.field = QQ.algebraic_field(sqrt(2), sqrt(3))
        self.roots = {
            f"length([{','.join('1' * n)}])": self.field.from_sympy(sqrt(n)) for n in (2, 3)
        }

    def rational(self, n):
        from sympy import Rational

        exact = Fraction(n)
        return self.field.from_sympy(Rational(exact.numerator, exact.denominator))

    def is_zero(self, number):
        return not number

    def fraction(self, number):
        """Evaluate an exact number to far more digits than an interval knows."""
        return Fraction(str(self.field.to_sympy(number).evalf(DIGITS)))


class Sines(Expressions):
    """Over sines and a nested root, to 150 digits: below 10⁻¹⁰⁰ these numbers are 0."""

    more = ("0", "0", "1", "1e-20")

    def __init__(self, seed):
        super().__init__(seed)
        with mpmath.workdps(DIGITS):
            self.roots = {
                "sin(20)": mpmath.sin(mpmath.radians(20)),
                "cos(20)": mpmath.cos(mpmath.radians(20)),
                "sqrt(1+√2)": mpmath.sqrt(1 + mpmath.sqrt(2)),
            }

    def rational(self, n):
        exact = Fraction(n)
        return mpmath.mpf(exact.numerator) / exact.denominator

    def is_zero(self, number):
        return abs(number) < mpmath.mpf(10) ** -100

    def fraction(self, number):
        return Fraction(mpmath.nstr(number, DIGITS))


@pytest.mark.parametrize("seed", range(2))
def test_expressions_over_roots_are_exact(seed):
    surds = Surds(seed)
    answered = 0
    for _ in range(60):
        text, right = surds.number(3)
        if right is None:
            with pytest.raises(NoAnswerError):
                calculate(text, {})
            continue
        answered += 1
        found = calculate(text, {}).value
        assert found.exact, text
        exactly = surds.fraction(right)
        low, high = bounds(found.scalar)
        assert abs((low + high) / 2 - exactly) <= abs(exactly) / 10**80, text
        assert (found.scalar == 0) == surds.is_zero(right)
    assert answered > 30


@pytest.mark.parametrize("seed", range(4))
def test_no_digit_is_shown_that_an_irrational_does_not_have(seed):
    irrationals = Sines(seed)
    answered = refused = cancelled = 0
    with mpmath.workdps(DIGITS):
        for _ in range(60):
            text, right = irrationals.number(3)
            try:
                (found,) = calculate(text, {}).value.numbers
            except NoAnswerError:
                refused += 1
                continue
            assert right is not None, f"{text} divides by 0"
            answered += 1
            exactly = irrationals.fraction(right)
            if not isinstance(found, Interval):
                assert abs(found - exactly) <= abs(exactly) / 10**80 + Fraction(1, 10**100), text
                continue
            slack = Fraction(1, 10**120)
            assert found.low - slack <= exactly <= found.high + slack, text
            assert abs(found.shown - exactly) <= (found.high - found.low) * 10 + slack, text
            if found.digits:
                unit = abs(found.shown) / 10 ** (found.digits - 1)
                assert abs(found.shown - exactly) <= unit + slack, text
                digits = f"{found.shown.numerator * 10**200 // found.shown.denominator}"
                assert len(digits.rstrip("0").lstrip("-")) <= found.digits, text
                continue
            cancelled += 1
            assert found.shown == 0
            with pytest.raises(NoAnswerError, match="no digit of it is known"):
                shown(found)
    assert answered > 2 * refused > 0
    assert cancelled


def test_an_interval_holds_what_it_is_made_of():
    chance = random.Random(3)
    for _ in range(500):
        low = Fraction(chance.randint(-(10**9), 10**9), chance.randint(1, 10**9))
        high = low + Fraction(chance.randint(1, 10**9), 10 ** chance.randint(1, 60))
        found = enclosed(low, high)
        assert found.low <= low < high <= found.high
        assert found.high - found.low < (high - low) * Fraction(10001, 10000)


def test_sines_roots_and_angles_hold_the_true_ones():
    chance = random.Random(4)
    with mpmath.workdps(DIGITS):
        for _ in range(100):
            turn = Fraction(chance.randint(-(10**6), 10**6), chance.choice([7, 1000, 10**9]))
            size = Fraction(abs(turn.numerator), turn.denominator)
            exactly = mpmath.radians(mpmath.mpf(turn.numerator) / turn.denominator)
            near = Fraction(chance.randint(1, 9), 10 ** chance.randint(0, 40))
            tangent = mpmath.mpf(near.numerator) / near.denominator
            for found, right in (
                (angle(turn).sine, mpmath.sin(exactly)),
                (angle(turn).cosine, mpmath.cos(exactly)),
                (angle(enclosed(turn, turn + near)).sine, mpmath.sin(exactly)),
                (root(size), mpmath.sqrt(mpmath.mpf(size.numerator) / size.denominator)),
                (degrees_of(near, Fraction(1)), mpmath.degrees(mpmath.atan(tangent))),
                (degrees_of(near, Fraction(-1)), 180 - mpmath.degrees(mpmath.atan(tangent))),
            ):
                exact = Fraction(mpmath.nstr(right, DIGITS))
                if isinstance(found, Interval):
                    assert found.low <= exact <= found.high
                else:
                    assert abs(found - exact) < Fraction(1, 10**100)


@pytest.mark.parametrize("seed", range(3))
def test_a_singular_matrix_of_surds_is_never_inverted(seed):
    """The second row is a multiple of the first; with 1 more in it, the inverse has an entry 1."""
    surds = Surds(100 + seed)
    tried = 0
    while tried < 40:
        (x, a), (y, b) = surds.number(1), surds.number(1)
        if a is None or b is None or not a or not b:
            continue
        tried += 1
        factor = surds.chance.choice([*surds.roots, "3", f"({ROOT_2}+1)"])
        rows = f"[[{x},{y}],[{factor}*{x},{y}*{factor}]]"
        for function in ("inverse", "inverse_transpose"):
            with pytest.raises(NoAnswerError):
                calculate(f"{function}({rows})", {})
        det = calculate(f"det({rows})", {}).value
        assert det.shown == 0
        off = calculate(f"inverse([[{x},{y}],[{factor}*{x}+1,{y}*{factor}]])", {}).value
        assert off.shown[0][1] == 1


@pytest.mark.parametrize(
    "expression",
    [
        f"inverse({SINGULAR})",
        f"inverse_transpose({SINGULAR})",
        f"1/{ZERO}",
        f"{SINGULAR}/{ZERO}",
        f"normalize([{ZERO},0,0])",
        f"angle([{ZERO},0,0],[1,0,0])",
        f"angle([1,0,0],[0,{ZERO},0])",
        f"rank({SINGULAR})",
        f"normalize([1,0,0,{ZERO}])",
        "inverse([[length(linear(rotate_z(20)) @ [1,0,0]),1],[1,1]])",
    ],
)
def test_what_may_be_zero_divides_nothing(expression):
    with pytest.raises(NoAnswerError, match=r"within .* of 0, more is not known"):
        calculate(expression, {})


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        (f"rank([[{ROOT_2},2],[1,{ROOT_2}+1]])", 2),
        (f"rank([[{ZERO},1],[1,0]])", 2),
        ("rank(rotate_x(20))", 4),
        (f"rank([[{ROOT_2},0],[0,0]])", 1),
        (f"0*{ROOT_2}", 0),
        ("linear(rotate_z(30))@[0,0,5]", (0, 0, 5)),
        ("rotate_y(30)@[0,1,0,0]", (0, 1, 0, 0)),
    ],
)
def test_what_is_decided_by_known_digits_is_exact(expression, wanted):
    found = calculate(expression, {}).value
    assert (found.exact, found.entries) == (True, wanted)


@pytest.mark.parametrize(
    "expression",
    [f"inverse({ROOTS})", f"1/{NOTHING}", f"normalize([{NOTHING},0,0])", f"tan(90+{NOTHING})"],
)
def test_what_roots_make_zero_is_known_to_be_zero(expression):
    with pytest.raises(NoAnswerError) as refused:
        calculate(expression, {})
    assert "more is not known" not in str(refused.value)
    assert calculate(f"rank({ROOTS})", {}).value.entries == 1
    assert calculate(f"det({ROOTS}) == {NOTHING}", {}).value.entries is True


def test_what_is_small_and_known_is_no_zero():
    power = "*".join([TINY] * 20)
    assert calculate(power, {}).value.shown < Fraction(1, 10**45)
    assert calculate(f"normalize([{power},0,0])", {}).value.shown == (1, 0, 0)
    assert calculate(f"rank([[{power},0],[0,1]])", {}).value.entries == 2


def test_the_remark_tells_how_much_is_known():
    def remarks(expression):
        return " ".join(report(calculate(expression, {}), with_steps=False).remarks)

    # cos 20° = 0.94 is known to 2⁻¹³⁰ of itself on either side: 1.4e-39.
    assert "38 digits are known" in remarks("rotate_z(20)")
    assert remarks(f"[1, {ROOT_2}, sin(20), cos(20)]").count("known") == 1


@pytest.mark.parametrize("expression", [ZERO, f"[1, {ZERO}]", f"identity(2) * {ZERO}"])
def test_what_cancels_to_less_than_its_digits_is_refused_and_never_printed(expression):
    found = calculate(expression, {})
    with pytest.raises(NoAnswerError, match=r"within .* of 0, and no digit of it is known"):
        report(found, with_steps=False)


def test_a_world_that_is_turned_is_as_known_as_a_rotation_of_the_calculator():
    from nmatrix.calculator.names import names_of
    from nmatrix.scene.setup import Setup
    from nmatrix.scene.world import World

    world = World(rotate_degrees=(20, 30, 0), translate=(1, 2, 3), scale=(2, 1, 1))
    names = names_of(Setup(world), "M")
    built = "translate(1,2,3) @ rotate_x(20) @ rotate_y(30) @ scale(2,1,1)"
    assert calculate("det(M)", names).value.shown == 2
    difference = calculate(f"M - {built}", names).value
    for one in difference.numbers:
        low, high = bounds(one)
        assert low <= 0 <= high
        assert high - low < Fraction(1, 10**36)
    assert difference.matrix[0][3] == 0


def test_nested_roots_are_exact_where_they_are_sums_of_roots():
    for inside, outside in (
        ("2 + √3", "(√6 + √2)/2"),
        ("2 - √3", "(√6 - √2)/2"),
        ("(3 + √5)/2", "(1 + √5)/2"),
        ("5 + 2√6", "√2 + √3"),
        ("11 - 6√2", "3 - √2"),
    ):
        assert calculate(f"sqrt({inside}) == {outside}", {}).value.entries is True
    for other in ("2 + √2", "1 + √2", "√2", "1 + √2 + √3"):
        (found,) = calculate(f"sqrt({other})", {}).value.numbers
        assert isinstance(found, Interval)
        (square,) = calculate(f"sqrt({other})*sqrt({other}) - ({other})", {}).value.numbers
        low, high = bounds(square)
        assert low <= 0 <= high
        assert high - low < Fraction(1, 10**80)


@pytest.mark.parametrize("degrees", [Fraction(n, 2) for n in range(-359, 361)])
def test_angles_of_exact_directions_are_exact_where_they_are_rational(degrees):
    """Multiples of 15° and of 18° (for their sines), and halves of what has an exact cosine."""
    sine, cosine = angle(degrees).sine, angle(degrees).cosine
    if isinstance(sine, Interval) or isinstance(cosine, Interval):
        with mpmath.workdps(60):
            radians_ = mpmath.radians(mpmath.mpf(degrees.numerator) / degrees.denominator)
            right = Fraction(mpmath.nstr(mpmath.sin(radians_), 55))
            low, high = bounds(sine)
        assert low - Fraction(1, 10**50) <= right <= high + Fraction(1, 10**50)
        return
    assert degrees % 15 == 0
    assert degrees_of(sine, cosine) == degrees
    assert degrees_of(3 * sine, 3 * cosine) == degrees
    assert isclose(float(sine), sin(radians(degrees)), abs_tol=1e-15)


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        ("asin((√5 - 1)/4)", 18),
        ("acos((√5 - 1)/4)", 72),
        ("acos(-(√5 + 1)/4)", 144),
        ("asin(-(√6 + √2)/4)", -75),
        ("atan(√2 - 1)", Fraction(45, 2)),
        ("atan(2 - √3)", 15),
        ("atan2(0, -1)", 180),
        ("atan2(-1, 0)", -90),
        ("atan2(-√3, -1)", -120),
        ("acos(0)", 90),
        ("asin(-1)", -90),
        ("angle([1, 0], [-1, 0])", 180),
    ],
)
def test_inverse_functions_give_exact_degrees(expression, wanted):
    assert calculate(expression, {}).value.entries == wanted


@pytest.mark.parametrize("seed", range(3))
def test_inverse_functions_hold_the_true_angles_in_every_quadrant(seed):
    chance = random.Random(seed)
    for _ in range(30):
        x, y = (Fraction(chance.randint(-99, 99), chance.randint(1, 9) * 10) for _ in range(2))
        names = {"x": Value(x), "y": Value(y)}
        with mpmath.workdps(60):
            a, b = (mpmath.mpf(one.numerator) / one.denominator for one in (x, y))
            wanted = {"atan(x)": mpmath.atan(a)}
            if x or y:
                wanted["atan2(y, x)"] = mpmath.atan2(b, a)
            if abs(x) < 1:
                wanted |= {"asin(x)": mpmath.asin(a), "acos(x)": mpmath.acos(a)}
            for expression, right in wanted.items():
                low, high = bounds(calculate(expression, names).value.scalar)
                near = Fraction(mpmath.nstr(mpmath.degrees(right), 55))
                assert low - Fraction(1, 10**48) <= near <= high + Fraction(1, 10**48)
                assert high - low < Fraction(1, 10**35)


@pytest.mark.parametrize(
    "expression", [f"atan2({ZERO}, -1)", f"atan2({ZERO}, {ZERO})", f"min(1, 2) / {ZERO}"]
)
def test_an_angle_that_may_be_a_half_turn_to_either_side_is_refused(expression):
    with pytest.raises(NoAnswerError, match="more is not known"):
        calculate(expression, {})


def test_the_least_of_bounds_is_between_bounds():
    for one, other in (("sin(20)", "sin(20)+1e-60"), ("sin(20)", "√2"), ("pi", "3"), ("pi", "√10")):
        for name, choose in (("min", min), ("max", max)):
            found = bounds(calculate(f"{name}({one}, {other})", {}).value.scalar)
            a, b = (bounds(calculate(x, {}).value.scalar) for x in (one, other))
            assert found[0] <= choose(a[0], b[0])
            assert found[1] >= choose(a[1], b[1])
            assert found[1] - found[0] < Fraction(1, 10**37)


# Plain programs over floats, written as one writes them.


def plain_dot(a, b):
    total = 0.0
    for x, y in zip(a, b, strict=True):
        total += x * y
    return total


def plain_cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def plain_product(A, B):
    return [[plain_dot(row, column) for column in zip(*B, strict=True)] for row in A]


def plain_minor(A, i, j):
    return [[*row[:j], *row[j + 1 :]] for k, row in enumerate(A) if k != i]


def plain_det(A):
    if len(A) == 2:
        return A[0][0] * A[1][1] - A[0][1] * A[1][0]
    total = 0.0
    for j in range(len(A)):
        term = A[0][j] * plain_det(plain_minor(A, 0, j))
        total = total - term if j % 2 else total + term
    return total


def plain_cofactors(A):
    if len(A) == 1:
        return [[1.0]]
    if len(A) == 2:
        return [[A[1][1], -A[1][0]], [-A[0][1], A[0][0]]]
    n = range(len(A))
    return [[(-1) ** (i + j) * plain_det(plain_minor(A, i, j)) for j in n] for i in n]


def plain_inverse(A):
    factor = 1.0 / plain_det(A)
    return [[entry * factor for entry in row] for row in zip(*plain_cofactors(A), strict=True)]


def plain_normalize(v):
    length = sqrt(plain_dot(v, v))
    return [x / length for x in v]


def plain_angle(a, b):
    normal = plain_cross(a, b)
    return degrees(atan2(sqrt(plain_dot(normal, normal)), plain_dot(a, b)))


def flat(found):
    if isinstance(found, float):
        return [found]
    return [x for part in found for x in flat(part)]


PLAIN = {
    "dot(u, v)": lambda _A, _B, u, v: plain_dot(u, v),
    "length(u)": lambda _A, _B, u, _v: sqrt(plain_dot(u, u)),
    "cross(u, v)": lambda _A, _B, u, v: plain_cross(u, v),
    "normalize(u)": lambda _A, _B, u, _v: plain_normalize(u),
    "angle(u, v)": lambda _A, _B, u, v: plain_angle(u, v),
    "A @ B": lambda A, B, _u, _v: plain_product(A, B),
    "A @ u": lambda A, _B, u, _v: [plain_dot(row, u) for row in A],
    "det(A)": lambda A, _B, _u, _v: plain_det(A),
    "cofactor(A)": lambda A, _B, _u, _v: plain_cofactors(A),
    "inverse(A)": lambda A, _B, _u, _v: plain_inverse(A),
    "trace(A)": lambda A, _B, _u, _v: sum(A[i][i] for i in range(3)),
    "A * dot(u, v) / 3": lambda A, _B, u, v: [[x * plain_dot(u, v) / 3 for x in row] for row in A],
    "A + B - A": lambda A, B, _u, _v: [
        [a + b - a for a, b in zip(*rows, strict=True)] for rows in zip(A, B, strict=True)
    ],
}


def drawn(chance):
    """Draw what plain sums find easy, or hard: numbers of any size, and zeros."""
    if chance.random() < 0.1:
        return 0.0
    return chance.uniform(-1, 1) * 10 ** chance.choice([0, 0, 0, chance.uniform(-30, 30)])


@pytest.mark.parametrize("expression", PLAIN)
def test_float_is_what_a_plain_loop_over_floats_gives_bit_for_bit(expression):
    chance = random.Random(expression)
    for _ in range(60):
        A, B = ([[drawn(chance) for _ in range(3)] for _ in range(3)] for _ in range(2))
        u, v = ([drawn(chance) for _ in range(3)] for _ in range(2))
        names = {name: Value(rational_matrix(one)) for name, one in (("A", A), ("B", B))}
        names |= {name: Value(rational_vector(one)) for name, one in (("u", u), ("v", v))}
        try:
            wanted = flat(PLAIN[expression](A, B, u, v))
        except ZeroDivisionError:
            with pytest.raises(NoAnswerError):
                calculate(expression, names, Arithmetic.FLOAT)
            continue
        found = calculate(expression, names, Arithmetic.FLOAT).value
        assert list(map(shown, found.numbers)) == wanted


@pytest.mark.parametrize("size", [2, 4])
def test_float_expands_determinants_of_every_size_by_the_first_row(size):
    chance = random.Random(size)
    for _ in range(60):
        A = [[drawn(chance) for _ in range(size)] for _ in range(size)]
        found = calculate("det(A)", {"A": Value(rational_matrix(A))}, Arithmetic.FLOAT).value
        assert found.scalar.value == plain_det(A)


def test_float_rounds_a_sine_once_and_then_multiplies():
    for turn in (20, 33.3, 60, -125, 400):
        names = {"t": Value(Fraction(turn))}
        entries = calculate("rotate_x(t)", names, Arithmetic.FLOAT).value.shown
        assert entries[2][1] == pytest.approx(sin(radians(turn)), rel=1e-15)
        assert entries[1][1] == pytest.approx(cos(radians(turn)), rel=1e-15)
        both = calculate("rotate_x(t) @ rotate_x(t)", names, Arithmetic.FLOAT).value
        assert list(map(shown, both.numbers)) == flat(plain_product(entries, entries))


@pytest.mark.parametrize(
    ("expression", "wanted"),
    [
        ("dot([1e16,1,-1e16],[1,1,1])", 0),
        ("cross([1e16,1,0],[1,1e-16,0])", (0, 0, 0)),
        ("[[1e16,1,-1e16],[0,1,0]]@[1,1,1]", (0, 1)),
        ("det([[1e8,1e8],[1e8,1e8+1e-9]])", 0),
        ("rank([[0.1,0.2],[0.3,0.6]])", 1),
        ("rank([[0.1,0.3],[0.7,2.1]])", 2),
        ("length([1e-200,0])", 0),
        ("length([1e200,0])", inf),
        ("1e308*10", inf),
        ("[1,-1e308*10]", (1, -inf)),
    ],
)
def test_float_shows_what_rounding_does(expression, wanted):
    assert calculate(expression, {}, Arithmetic.FLOAT).value.shown == wanted


def test_an_overflow_is_null_and_told_and_infinities_that_cancel_are_refused():
    found = report(calculate("[1,1e308*10]", {}, Arithmetic.FLOAT), with_steps=False)
    assert OVERFLOWED in found.remarks
    assert '"value": [1.0, null]' in write(found, OutputOptions(format="json"))
    for expression in ("1e308*10-1e308*10", "0*(1e308*10)", "rotate_x(1e308*10)"):
        with pytest.raises(NoAnswerError, match="not a number in float64"):
            calculate(expression, {}, Arithmetic.FLOAT)
