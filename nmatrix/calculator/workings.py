"""The steps of a calculation as one writes them on paper: which working each operation has.

An operation that no working is for is one line: what was asked, and its value.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nmatrix.calculator.arithmetic.numbers import (
    Float64,
    Interval,
    Number,
    PiMultiple,
    bounds,
)
from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.calculator.arithmetic.values import Value, ValueKind, each
from nmatrix.calculator.functions.camera import HANDS, clip_of
from nmatrix.calculator.functions.maps import CONVENTIONS
from nmatrix.calculator.meaning.homogeneous import with_w
from nmatrix.calculator.meaning.operands import Operand
from nmatrix.enums import InverseBy
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.rational import linear_part
from nmatrix.linear.rounding import nearest
from nmatrix.report import Formula, Step
from nmatrix.scene.lens import Lens
from nmatrix.scene.world import World
from nmatrix.surds import Surd, TooManyRootsError
from nmatrix.working import determinants, elimination, inverses, products, vectors, view
from nmatrix.working.projection import projection_matrix
from nmatrix.working.working import (
    NEAR,
    SHORT,
    Notation,
    Working,
    decimal,
    exactly_or_near,
    raised,
    short,
    transposed,
    written,
)
from nmatrix.working.world import world_matrix

Given = Operand | str | None  # an argument: a value, a word, or left out
_NAME = re.compile(r"[A-Za-zΑ-ω]\w{0,11}")
_ENDINGS = {
    "….T": "ᵀ",
    "…^T": "ᵀ",
    "transpose(…)": "ᵀ",
    "….inv": "⁻¹",
    "…^-1": "⁻¹",
    "inverse(…)": "⁻¹",
    "…^-T": "⁻ᵀ",
    "inverse_transpose(…)": "⁻ᵀ",
}
_OF_NUMBERS = {"+": "added", "-": "subtracted", "*": "multiplied", "/": "divided"}
_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")
MOST_FACTORS = 4  # of a power that is multiplied out
_ON_PAPER = str.maketrans({"*": "·", "@": "·", "-": "−"})


@dataclass(frozen=True)
class Operation:
    """An operator or a function with what it was given, as a working needs it."""

    name: str
    given: tuple[Given, ...]
    inverse_by: InverseBy | None = None

    @property
    def values(self) -> list[Operand]:
        """The arguments that are values."""
        return [one for one in self.given if isinstance(one, Operand)]

    def entries(self, place: int = 0) -> Any:  # noqa: ANN401 - a number, or rows of numbers
        """Take the numbers of an argument; of those between two bounds the middle."""
        return each(self.values[place].value.entries, _middle)

    def called(self, place: int = 0, otherwise: str = "A") -> str:
        """Name an argument by the letter that it was typed as."""
        text = self.values[place].text
        for typed, ending in _ENDINGS.items():
            before, _, after = typed.partition("…")
            base = text.removeprefix(before).removesuffix(after)
            if len(base) == len(text) - len(typed) + 1 and _NAME.fullmatch(base):
                return raised(base, ending)
        return text if _NAME.fullmatch(text) else otherwise

    def both(self, first: str, second: str) -> tuple[str, str]:
        """Name two arguments, by two letters."""
        a, b = self.called(0, first), self.called(1, second)
        if a == b and self.entries(0) != self.entries(1):
            return a, f"{b}₂"
        return a, b


def lines(operation: Operation, expression: str, value: Value, rule: str) -> tuple[Step, ...]:
    """Work an operation out line by line; the last one is its value.

    Raises
    ------
    IllegalValueError
        Where an inverse is asked for by a method that is not for its matrix.
    """
    if value.kind is ValueKind.SCALAR:
        rule = _OF_NUMBERS.get(operation.name, rule)
    is_exact = not any(isinstance(one, Float64) for one in value.numbers)
    working = _worked(operation, value) if is_exact else None
    if working is not None and working.steps:
        return working.steps
    line = _one_line(expression, value, rule)
    is_said = line.formula.parts == (f"{_on_paper(expression)} = {_on_paper(expression)}",)
    return () if is_said else (line,)


def _on_paper(expression: str) -> str:
    return expression.translate(_ON_PAPER)


def _one_line(expression: str, value: Value, rule: str) -> Step:
    head, told = f"{_on_paper(expression)} = ", each(value.entries, _text)
    if isinstance(told, str):
        formula = Formula((head + told,))
    else:
        is_vector = value.kind is ValueKind.VECTOR
        rows: Any = tuple((one,) for one in told) if is_vector else told
        formula = Formula((head, rows))
    return Step(formula, rule, not any(isinstance(one, Float64) for one in value.numbers))


def _text(x: Number) -> str:
    if isinstance(x, Symbolic):
        return written(x)
    if isinstance(x, Fraction | Surd):
        return short(x)
    if isinstance(x, Float64):
        return f"{x.value:.6g}".replace("-", "−")
    low, high = bounds(x)
    return decimal((low + high) / 2)


def _middle(x: Number) -> Number:
    """Take the fraction between the bounds of what is no sum of roots."""
    if isinstance(x, Interval | PiMultiple):
        low, high = bounds(x)
        return (low + high) / 2
    return x


def _worked(operation: Operation, value: Value) -> Working | None:
    """Find the working whose value is the one that was computed; None where there is none."""
    make = WORKINGS.get(operation.name)
    if make is None or not operation.values:
        return None
    given = [one for operand in operation.values for one in operand.value.numbers]
    is_near = any(isinstance(one, Interval | PiMultiple) for one in given)
    try:
        if any(isinstance(one, Symbolic) for one in given):
            by, found = LETTERS, make(operation, LETTERS)
        elif is_near:
            by, found = NEAR, make(operation, NEAR)
        else:
            found = exactly_or_near(lambda chosen: make(operation, chosen) or _NOTHING)
            by = SHORT if value.exact else NEAR
    except (IllegalValueError, NoAnswerError, TooManyRootsError):
        if operation.inverse_by is not None and operation.name == "inverse":
            raise
        return None
    if found is None or found is _NOTHING:
        return None
    return _ending(found, value, by)


_NOTHING = Working((), None)


def _ending(found: Working, value: Value, by: Notation) -> Working | None:
    """Check a working against the value; what left its w out gets a line that says so."""
    wanted, reached = each(value.entries, _middle), found.value
    if not isinstance(wanted, tuple) or not isinstance(reached, Sequence):
        is_same = isinstance(wanted, tuple) == isinstance(reached, Sequence)
        return found if is_same and by.same(reached, wanted) else None
    if len(reached) == len(wanted):
        return found if by.same(reached, wanted) else None
    *place, w = reached
    is_divided = not by.is_zero(w)
    divided = tuple(by.tidy(x / w) for x in place) if is_divided else tuple(place)
    if len(reached) != 4 or not by.same(divided, wanted):
        return None
    is_left_out = not is_divided or by.same(w, Fraction(1))
    about = "w is left out: points have 1, directions 0" if is_left_out else "divided by w"
    last = by.step("(x, y, z) = ", wanted, because=about, proved=True)
    return Working((*found.steps, last), wanted)


def _tidied(x: Any) -> Any:  # noqa: ANN401 - an entry is any number
    return x.tidied() if isinstance(x, Symbolic) else x


def _root(x: Any) -> Any:  # noqa: ANN401 - an entry is any number
    return x.root() if isinstance(x, Symbolic) else SHORT.root(x)


LETTERS = Notation(write=short, tidy=_tidied, root=_root)

Make = Callable[[Operation, Notation], Working | None]


def _of_one(work: Callable[..., Working], letter: str = "A") -> Make:
    def make(asked: Operation, by: Notation) -> Working:
        return work(asked.entries(), asked.called(0, letter), by=by)

    return make


def _of_two(work: Callable[..., Working], letters: tuple[str, str]) -> Make:
    def make(asked: Operation, by: Notation) -> Working:
        return work(asked.entries(0), asked.entries(1), asked.both(*letters), by=by)

    return make


def _product(asked: Operation, by: Notation) -> Working:
    A, b = asked.values
    right: Any = each(with_w(A.value, b.value).entries, _middle)
    letters = ("A", "v" if b.value.kind is ValueKind.VECTOR else "B")
    return products.product(asked.entries(0), right, asked.both(*letters), by=by)


def _sum(work: Callable[..., Working]) -> Make:
    def make(asked: Operation, by: Notation) -> Working | None:
        kind = asked.values[0].value.kind
        if kind is ValueKind.SCALAR:
            return None
        letters = ("A", "B") if kind is ValueKind.MATRIX else ("a", "b")
        return work(asked.entries(0), asked.entries(1), asked.both(*letters), by=by)

    return make


def _times(asked: Operation, by: Notation) -> Working | None:
    first = asked.values[0]
    scalar, other = (0, 1) if first.value.kind is ValueKind.SCALAR else (1, 0)
    kind = asked.values[other].value.kind
    if kind is ValueKind.SCALAR:
        return None
    letter = asked.called(other, "A" if kind is ValueKind.MATRIX else "v")
    factor = by.factor(asked.entries(scalar), is_first=True)
    return products.times(asked.entries(scalar), asked.entries(other), f"{factor} {letter}", by=by)


def _dotted(asked: Operation, by: Notation) -> Working | None:
    kinds = [one.value.kind for one in asked.values]
    if ValueKind.SCALAR in kinds:
        return _times(asked, by)
    return _DOT(asked, by) if kinds == [ValueKind.VECTOR] * 2 else _product(asked, by)


def _crossed(asked: Operation, by: Notation) -> Working | None:
    is_scalar = ValueKind.SCALAR in [one.value.kind for one in asked.values]
    return _times(asked, by) if is_scalar else _CROSS(asked, by)


def _power(asked: Operation, by: Notation) -> Working | None:
    times = int(str(asked.given[1]))
    A, name = asked.entries(), asked.called()
    if asked.values[0].value.kind is not ValueKind.MATRIX or not 2 <= times <= MOST_FACTORS:
        return None
    power = f"{name}{str(times).translate(_RAISED)}"
    return products.chained([A] * times, [name] * times, power, by)


def _inverse(asked: Operation, by: Notation) -> Working:
    return inverses.inverse(asked.entries(), asked.called(), asked.inverse_by, by)


def _adjugate(asked: Operation, by: Notation) -> Working:
    name = asked.called()
    C = determinants.cofactors(asked.entries(), name, by)
    turned = products.transpose(C.value, "C", by)
    return Working((*C.steps, turned.steps[-1]), turned.value)


def _normal_matrix(asked: Operation, by: Notation) -> Working:
    M, name = asked.entries(), asked.called(0, "M")
    if len(M) < 4:
        return inverses.inverse_transpose(M, name, by)
    A = linear_part(M)
    head = by.step("A = ", A, because=f"the 3×3 block of {name}", proved=True)
    found = inverses.inverse_transpose(A, "A", by)
    return Working((head, *found.steps[1:]), found.value)


def _solve(asked: Operation, by: Notation) -> Working | None:
    if asked.values[1].value.kind is not ValueKind.VECTOR:
        return None
    names = (*asked.both("A", "b"), "x")
    return elimination.solve(asked.entries(0), asked.entries(1), names, by)


def _null_space(asked: Operation, by: Notation) -> Working:
    found = elimination.null_space(asked.entries(), asked.called(), by)
    is_one = len(found.value) == 1
    return Working(found.steps, found.value[0] if is_one else transposed(found.value))


def _angle(asked: Operation, by: Notation) -> Working:
    """Take the angle, which is known to 130 bits, for the whole degrees that it is."""
    found = vectors.angle(asked.entries(0), asked.entries(1), asked.both("a", "b"), by)
    whole = Fraction(round(found.value))
    return Working(found.steps, whole if NEAR.same(found.value, whole) else found.value)


def _look_at(asked: Operation, by: Notation) -> Working | None:
    *_, hand = asked.given
    eye, target, up = (asked.entries(i) for i in range(3))
    return None if by is LETTERS else view.look_at(eye, target, up, HANDS[str(hand)])


def _perspective(asked: Operation, by: Notation) -> Working:
    fov, aspect, near, far = map(_as_float, asked.given[:4])
    clip = clip_of(*map(str, asked.given[4:]))
    return projection_matrix(Lens(fov, aspect, near, far, clip=clip))


def _world(asked: Operation, by: Notation) -> Working:
    names = ("translate", "rotate_degrees", "scale", "shear", "quaternion", "axis_angle")
    given: dict[str, Any] = {}
    for name, one in zip(names, asked.given, strict=False):
        if isinstance(one, Operand):
            numbers = each(one.value.entries, _float)
            given[name] = numbers if isinstance(numbers, tuple) else (numbers,) * 3
    order, convention = asked.given[6:]
    if order:
        given["order"] = str(order)
    if convention:
        given["convention"] = CONVENTIONS[str(convention)]
    return world_matrix(World(**given))


def _as_float(given: Given) -> float:
    """Take the number of an argument; of words there is "inf" alone."""
    return _float(given.value.scalar) if isinstance(given, Operand) else float(str(given))


def _float(x: Number) -> float:
    low, high = bounds(x)
    return nearest((low + high) / 2)


_DOT = _of_two(vectors.dot, ("a", "b"))
_CROSS = _of_two(vectors.cross, ("a", "b"))
WORKINGS: Mapping[str, Make] = {
    "^": _power,
    "@": _product,
    "·": _dotted,
    "×": _crossed,
    "+": _sum(products.total),
    "-": _sum(products.difference),
    "*": _times,
    "det": _of_one(determinants.det),
    "cofactor": _of_one(determinants.cofactors),
    "adjugate": _adjugate,
    "inverse": _inverse,
    "inverse_transpose": _of_one(inverses.inverse_transpose),
    "normal_matrix": _normal_matrix,
    "transpose": _of_one(products.transpose),
    "rank": _of_one(elimination.rank),
    "rref": _of_one(elimination.rref),
    "null_space": _null_space,
    "solve": _solve,
    "normalize": _of_one(vectors.normalize, "v"),
    "length": _of_one(vectors.length, "v"),
    "dot": _DOT,
    "cross": _CROSS,
    "angle": _angle,
    "look_at": _look_at,
    "perspective": _perspective,
    "world": _world,
}
