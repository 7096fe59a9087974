"""The real roots of a polynomial over exact numbers: exact where they are, else between bounds.

Sturm's chain counts the roots between two numbers, so none is missed and none is seen twice. A root
that is rational, or one of two of a quadratic factor, is guessed from its bounds and verified by
exact division; rational coefficients make the guess certain, since over the leading one such a
root, or the sum and the product of two, are whole numbers.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from fractions import Fraction
from functools import reduce
from itertools import combinations, pairwise
from math import gcd, lcm

from nmatrix.calculator.arithmetic.numbers import Number, bounds, enclosed, root, size
from nmatrix.calculator.arithmetic.values import Value
from nmatrix.surds import Surd

Polynomial = tuple[Fraction, ...]  # the coefficients, that of the highest power last
BITS = 300  # of a root between bounds
SIMPLE = 10**6  # the largest denominator that is guessed where coefficients have roots


def real_roots(polynomial: Sequence[Fraction]) -> list[tuple[Number, int]]:
    """Find every real root with its multiplicity, the largest first.

    Examples
    --------
    >>> for found, times in real_roots([Fraction(n) for n in (2, -1, -2, 1)]):
    ...     print(found, times)
    2 1
    1 1
    -1 1
    """
    found = [
        (one, times)
        for factor, times in _without_squares(_trimmed(polynomial))
        for one in _simple_roots(factor)
    ]
    return sorted(found, key=lambda one: middle(one[0]), reverse=True)


def middle(x: Number) -> Fraction:
    """Take the middle between the bounds of a number."""
    low, high = bounds(x)
    return (low + high) / 2


def value_at(p: Polynomial, x: Fraction) -> Fraction:
    """Evaluate a polynomial by Horner's rule."""
    return reduce(lambda total, c: total * x + c, reversed(p), Fraction(0))


def divided(p: Polynomial, q: Polynomial) -> tuple[Polynomial, Polynomial]:
    """Divide two polynomials: the quotient and what is left."""
    rest, found = list(p), [Fraction(0)] * max(1, len(p) - len(q) + 1)
    for place in range(len(p) - len(q), -1, -1):
        factor = rest[place + len(q) - 1] / q[-1]
        found[place] = factor
        for i, c in enumerate(q):
            rest[place + i] = rest[place + i] - factor * c
    return tuple(found), _trimmed(rest[: len(q) - 1])


def _trimmed(p: Sequence[Fraction]) -> Polynomial:
    found = list(p)
    while found and found[-1] == 0:
        found.pop()
    return tuple(found)


def _slope(p: Polynomial) -> Polynomial:
    return tuple(i * c for i, c in enumerate(p))[1:]


def _brief(p: Polynomial) -> Polynomial:
    """Shorten the coefficients by a common positive factor."""
    if not p:
        return p
    if all(isinstance(c, Fraction) for c in p):
        common = lcm(*(c.denominator for c in p))
        shared = gcd(*(int(c * common) for c in p))
        return tuple(c * Fraction(common, shared) for c in p)
    over = abs(p[-1])
    return tuple(c / over for c in p)


def _common(p: Polynomial, q: Polynomial) -> Polynomial:
    """Find the greatest common divisor."""
    while q:
        p, q = q, _brief(divided(p, q)[1])
    return p


def _without_squares(p: Polynomial) -> Iterator[tuple[Polynomial, int]]:
    """Part a polynomial into factors without multiple roots, each with its power (Yun)."""
    if len(p) < 2:
        return
    shared = _common(p, _slope(p))
    rest, times = divided(p, shared)[0], 1
    while len(rest) > 1:
        deeper = _common(rest, shared)
        once = divided(rest, deeper)[0]
        if len(once) > 1:
            yield _brief(once), times
        rest, shared, times = deeper, divided(shared, deeper)[0], times + 1


def _simple_roots(p: Polynomial) -> Iterator[Number]:
    """Find the real roots of a polynomial whose roots are all different."""
    isolated: list[tuple[Fraction, Fraction]] = []
    while len(p) > 3:
        hit = _isolated(p, isolated)
        if hit is None:
            break
        yield hit
        p = divided(p, (-hit, Fraction(1)))[0]
    if len(p) <= 3:
        yield from _of_low_degree(p)
        return
    near = [_refined(p, *ends, BITS + _candidate_bits(p)) for ends in isolated]
    for ends in list(near):
        guess = _guessed(p, (ends[0] + ends[1]) / 2)
        if value_at(p, guess) == 0:
            yield guess
            near.remove(ends)
            p = divided(p, (-guess, Fraction(1)))[0]
    for one, other in combinations(list(near), 2):
        if one in near and other in near and len(p) > 3:
            x, y = ((low + high) / 2 for low, high in (one, other))
            factor = (_guessed(p, x * y), -_guessed(p, x + y), Fraction(1))
            quotient, rest = divided(p, factor)
            if not rest:
                yield from _of_low_degree(factor)
                near, p = [ends for ends in near if ends not in (one, other)], quotient
    if len(p) <= 3:
        yield from _of_low_degree(p)
        return
    yield from (enclosed(*ends) for ends in near)


def _of_low_degree(p: Polynomial) -> Iterator[Number]:
    """Solve a linear or a quadratic equation."""
    if len(p) == 2:
        yield -p[0] / p[1]
    if len(p) == 3:
        c, b, a = p
        square = b * b - 4 * a * c
        if square == 0:
            yield -b / (2 * a)
        elif square > 0:
            for sign in (1, -1):
                yield (sign * Value(root(square)).scalar - b) / (2 * a)


def _candidate_bits(p: Polynomial) -> int:
    """Count the bits that tell a guess from its neighbours, over the leading coefficient."""
    most = _bound(p)
    return 2 * (most.numerator // most.denominator).bit_length() + _leading(p).bit_length() + 8


def _leading(p: Polynomial) -> int:
    return abs(p[-1].numerator) if all(isinstance(c, Fraction) for c in p) else SIMPLE**2


def _guessed(p: Polynomial, near: Fraction) -> Fraction:
    """Take the number over the leading coefficient, or the simple one, that is next."""
    if any(isinstance(c, Surd) for c in p):
        return near.limit_denominator(SIMPLE)
    whole = _brief(p)
    return Fraction(round(near * whole[-1]), whole[-1].numerator)


def _bound(p: Polynomial) -> Fraction:
    """Bound every root (Cauchy)."""
    return Fraction(1 + max(size(c / p[-1]) for c in p[:-1]))


def _isolated(p: Polynomial, found: list[tuple[Fraction, Fraction]]) -> Fraction | None:
    """Find intervals with one root each; a root that an end hits is returned instead."""
    chain = _sturm(p)
    most = Fraction(2) ** (int(_bound(p)).bit_length() + 1)
    waiting = [(-most, most, _changes(chain, -most), _changes(chain, most))]
    found.clear()
    while waiting:
        low, high, below, above = waiting.pop()
        if below == above:
            continue
        if below - above == 1:
            found.append((low, high))
            continue
        middle = (low + high) / 2
        if value_at(p, middle) == 0:
            return middle
        between = _changes(chain, middle)
        waiting += [(low, middle, below, between), (middle, high, between, above)]
    return None


def _sturm(p: Polynomial) -> list[Polynomial]:
    chain = [p, _brief(_slope(p))]
    while len(chain[-1]) > 1:
        rest = divided(chain[-2], chain[-1])[1]
        if not rest:
            break
        chain.append(_brief(tuple(-c for c in rest)))
    return chain


def _changes(chain: Sequence[Polynomial], x: Fraction) -> int:
    signs = [value > 0 for p in chain if (value := value_at(p, x)) != 0]
    return sum(one != other for one, other in pairwise(signs))


def _refined(p: Polynomial, low: Fraction, high: Fraction, bits: int) -> tuple[Fraction, Fraction]:
    """Narrow the bounds of one root, by twice as many bits each time that a secant hits well."""
    rises = value_at(p, high) > 0
    leap = 2
    target = Fraction(1, 2**bits) * max(Fraction(1), abs(low), abs(high))
    while high - low > target:
        parts = 1 << leap
        step = (high - low) / parts
        at_low, at_high = value_at(p, low), value_at(p, high)
        share = middle(at_low) / (middle(at_low) - middle(at_high))
        place = min(parts - 1, int(share * parts))  # both signs differ, so it is from 0 to 1
        left = low + place * step
        ends = [value_at(p, left), value_at(p, left + step)]
        for end, value in zip((left, left + step), ends, strict=True):
            if value == 0:
                return end, end
        if (ends[0] > 0) != (ends[1] > 0):
            low, high, leap = left, left + step, 2 * leap
        else:
            low, high = (low, left) if (ends[0] > 0) == rises else (left + step, high)
            leap = max(1, leap // 2)
    return low, high
