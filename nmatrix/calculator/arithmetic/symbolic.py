"""Numbers that stay letters: names without a value, computed with by SymPy.

They have the operators of a fraction, so every formula of the calculator serves them too. Letters
stand for real numbers of which nothing else is known, so a divisor counts as no zero unless it is
always zero; what was divided by is found again in `denominators`.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.surds import Surd

if TYPE_CHECKING:
    from sympy import Basic, Expr

MOST_OPERATIONS = 300  # of an expression that is simplified
HIGHEST_POWER = 8  # of a sum that is multiplied out
SHORT = 40  # operations of one with sines that is searched for a shorter form


@dataclass(frozen=True, eq=False)
class Symbolic:
    """An expression in letters.

    Examples
    --------
    >>> a, b = Symbolic.letter("a"), Symbolic.letter("b")
    >>> print((a * a - b * b) / (a - b), (a + 1) * Fraction(1, 2))
    a + b a/2 + 1/2
    >>> (a + b) * (a + b) == a * a + 2 * a * b + b * b
    True
    """

    expression: Expr

    @classmethod
    def letter(cls, name: str) -> Symbolic:
        """Let a name stand for any real number."""
        from sympy import Symbol

        return cls(Symbol(name, real=True))

    def __neg__(self) -> Symbolic:
        return Symbolic(-self.expression)

    def __add__(self, other: object) -> Symbolic:
        return Symbolic(self.expression + _expression(other))

    def __sub__(self, other: object) -> Symbolic:
        return Symbolic(self.expression - _expression(other))

    def __rsub__(self, other: object) -> Symbolic:
        return Symbolic(_expression(other) - self.expression)

    def __mul__(self, other: object) -> Symbolic:
        return Symbolic(self.expression * _expression(other))

    def __truediv__(self, other: object) -> Symbolic:
        return Symbolic(self.expression / _expression(other))

    def __rtruediv__(self, other: object) -> Symbolic:
        return Symbolic(_expression(other) / self.expression)

    __radd__ = __add__
    __rmul__ = __mul__

    def __eq__(self, other: object) -> bool:
        """Whether both are the same for all values of the letters."""
        return bool(_simplified(self.expression - _expression(other)) == 0)

    def __bool__(self) -> bool:
        return self != 0

    def __hash__(self) -> int:
        return hash(_simplified(self.expression))

    def __str__(self) -> str:
        """Write it as one types it, so that it is read again."""
        return str(_simplified(self.expression)).replace("Abs(", "abs(")

    def _compared(self, other: object) -> bool:
        raise self.unknown

    __lt__ = __le__ = __gt__ = __ge__ = _compared

    def __float__(self) -> float:
        raise self.unknown

    @property
    def unknown(self) -> IllegalValueError:
        """The refusal of what needs to know how large it is."""
        what = f"{str(self)[:40]}, an expression in letters"
        why = "nobody knows how large it is, and here that matters"
        return IllegalValueError(what, why, "give the letters values")

    @property
    def is_negative(self) -> bool:
        """Whether it is below 0 for all values of the letters."""
        return bool(_simplified(self.expression).is_negative)

    @property
    def letters(self) -> list[str]:
        """The names that have no value, in the order of the alphabet."""
        return sorted(str(one) for one in self.expression.free_symbols)

    @property
    def denominators(self) -> Iterator[str]:
        """What must not be 0, a factor at a time."""
        from sympy import Mul, factor, fraction

        below = fraction(_simplified(self.expression))[1]
        for one in Mul.make_args(factor(below)):
            base = one.as_base_exp()[0]
            if base.free_symbols:
                yield str(Symbolic(base))

    def tidied(self) -> Symbolic | Fraction:
        """Simplify it; a fraction in which no letter is left is a fraction again.

        Raises
        ------
        IllegalValueError
            If it has grown too long.
        """
        found = _simplified(self.expression)
        if found.is_Rational:
            return Fraction(int(found.p), int(found.q))
        return Symbolic(found)

    def root(self) -> Symbolic | Fraction:
        """Take its square root.

        Raises
        ------
        NoAnswerError
            If it is a negative number times a square.
        """
        from sympy import I, sqrt

        found = sqrt(_simplified(self.expression))
        if found.has(I):
            raise NoAnswerError(f"the root of {self}", "it is never above 0", "use another")
        return Symbolic(found).tidied()

    def __abs__(self) -> Symbolic:
        return Symbolic(abs(self.expression))

    def sine_and_cosine(self) -> tuple[Symbolic, Symbolic]:
        """Take the sine and the cosine; letters are angles, and numbers beside them degrees."""
        from sympy import cos, pi, sin

        number, letters = self.expression.as_independent(*self.expression.free_symbols, as_Add=True)
        radians = letters + number * pi / 180
        return Symbolic(sin(radians)), Symbolic(cos(radians))


def _expression(x: object) -> Expr:
    """Make a SymPy expression of an exact number, or refuse another one."""
    from sympy import Rational, pi, sqrt

    if isinstance(x, Symbolic):
        return x.expression
    if isinstance(x, int | Fraction):
        return Rational(x.numerator, x.denominator)
    if isinstance(x, Surd):
        return sum(Rational(q.numerator, q.denominator) * sqrt(d) for d, q in x.terms)
    times = getattr(x, "times", None)
    if isinstance(times, Fraction):
        return Rational(times.numerator, times.denominator) * pi
    raise IllegalValueError(
        "a rounded number beside letters",
        "letters go with fractions, roots and multiples of π",
        "give the letters values",
    )


def _simplified(expression: Expr) -> Expr:
    """Write it as one fraction without common factors, and sin² as 1 − cos².

    So what is always 0 becomes 0, however it was written. A short one with sines is made shorter.
    """
    from sympy import cancel, powsimp, sin, together, trigsimp

    _check_length(expression)
    found = cancel(together(expression))
    if found.has(sin):
        top, bottom = (_without_squares(part) for part in found.as_numer_denom())
        found = cancel(top / bottom)
        if found.count_ops() <= SHORT:
            found = trigsimp(found)
    return powsimp(found)


def _check_length(expression: Expr) -> None:
    from sympy import preorder_traversal

    operations = expression.count_ops()
    powers = (
        abs(int(node.exp))
        for node in preorder_traversal(expression)
        if node.is_Pow and node.exp.is_Integer and node.base.is_Add
    )
    highest = max(powers, default=0)
    if operations > MOST_OPERATIONS or highest > HIGHEST_POWER:
        raise IllegalValueError(
            "an expression in letters",
            f"it has {operations} operations and the power {highest}, "
            f"{MOST_OPERATIONS} and {HIGHEST_POWER} are kept",
            "give some letters values",
        )


def _without_squares(polynomial: Expr) -> Expr:
    """Replace sin² by 1 − cos²."""
    from sympy import cos, expand, sin

    def with_cosines(power: Expr) -> Expr:
        (angle,), times = power.base.args, int(power.exp)
        return (1 - cos(angle) ** 2) ** (times // 2) * sin(angle) ** (times % 2)

    def is_square(node: Basic) -> bool:
        is_power = node.is_Pow and isinstance(node.base, sin) and node.exp.is_Integer
        return bool(is_power and node.exp >= 2)

    return expand(expand(polynomial).replace(is_square, with_cosines))
