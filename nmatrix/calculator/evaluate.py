"""Evaluate an expression of the closed grammar, one operation at a time, and keep the steps."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from typing import TypeVar

from nmatrix.calculator.faults import CalculatorError, NoValueError
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.function import Argument
from nmatrix.calculator.grammar import parse
from nmatrix.calculator.numbers import Number, PiMultiple, shown, times_pi
from nmatrix.calculator.operators import binary, equal, nearly_equal, part, power
from nmatrix.calculator.tree import (
    Bracket,
    Call,
    Index,
    Infix,
    Member,
    Name,
    Node,
    Numeral,
    Pasted,
    Power,
    Prefix,
    Turn,
    Word,
)
from nmatrix.calculator.values import LARGEST, Arithmetic, Value, ValueKind
from nmatrix.errors import IllegalValueError, NMatrixError, NoAnswerError, did_you_mean, quantity
from nmatrix.reading.angles import like_radians, of_pi
from nmatrix.reading.literal import BARE_POINT
from nmatrix.reading.numbers import fraction
from nmatrix.surds import TooManyRootsError

T = TypeVar("T")
Names = Mapping[str, Value]
CONSTANTS: dict[str, Value] = {"pi": Value(PiMultiple(Fraction(1)))}
COMPONENTS = "xyzw"


@dataclass(frozen=True)
class CalculationStep:
    """One operation: the part of the expression, its value, and the rule."""

    expression: str
    value: Value
    rule: str


@dataclass(frozen=True)
class Calculation:
    """The answer to one expression."""

    expression: str
    value: Value
    arithmetic: Arithmetic
    steps: tuple[CalculationStep, ...]
    remarks: tuple[str, ...] = ()


def calculate(
    expression: str, names: Names, arithmetic: Arithmetic = Arithmetic.EXACT
) -> Calculation:
    """Compute an expression over named matrices, exactly.

    Raises
    ------
    CalculatorError
        For a fault in the expression, with a caret in front of it.
    NoValueError
        For the inverse of a singular matrix, a division by zero, a direction of length zero.

    Examples
    --------
    >>> calculate("det([1 2; 3 4]) / 4", {}).value.entries
    Fraction(-1, 2)
    """
    expression = expression.strip()
    evaluation = _Evaluation(expression, names, arithmetic)
    value = evaluation.value_of(parse(expression, frozenset((*FUNCTIONS, *names))))
    steps, remarks = tuple(evaluation.steps), tuple(dict.fromkeys(evaluation.remarks))
    return Calculation(expression, value, arithmetic, steps, remarks)


@dataclass
class _Evaluation:
    expression: str
    names: Names
    arithmetic: Arithmetic
    steps: list[CalculationStep] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)

    def value_of(self, node: Node) -> Value:  # noqa: C901, PLR0911 - one line for each kind
        match node:
            case Numeral():
                return self._numeral(node)
            case Turn():
                return self._kept(node, Value(node.degrees))
            case Pasted():
                rows = tuple(tuple(map(fraction, row)) for row in node.rows)
                return self._kept(node, Value(rows if len(rows) > 1 else rows[0]))
            case Name():
                return self._name(node)
            case Bracket():
                return self._bracket(node)
            case Prefix():
                return self._prefix(node)
            case Infix():
                return self._infix(node)
            case Power():
                return self._power(node)
            case Member():
                return self._member(node)
            case Index():
                return self._index(node)
            case Call():
                return self._call(node)
        raise self._fault(node, "letters in quotes", "they are read only where an order is asked")

    def _error(self, at: int, what: str, error: NMatrixError) -> NMatrixError:
        """Repeat the error of an operation with its place in the expression."""
        kind = NoValueError if isinstance(error, NoAnswerError) else CalculatorError
        return kind(self.expression, at, what, str(error))

    def _fault(self, node: Node, what: str, why: str) -> NMatrixError:
        return CalculatorError(self.expression, node.start, what, why)

    def _numeral(self, node: Numeral) -> Value:
        try:
            return self._kept(node, Value(fraction(BARE_POINT.sub("", node.text))))
        except IllegalValueError as error:
            if isinstance(error, CalculatorError):
                raise
            _, _, why = str(error).partition(": ")
            raise self._fault(node, "number", why) from None

    def _name(self, node: Name) -> Value:
        name = node.name
        if name in self.names:
            return self._kept(node, self.names[name])
        if name in CONSTANTS:
            return self._kept(node, CONSTANTS[name])
        if name in FUNCTIONS:
            usage = FUNCTIONS[name].usage(name)
            raise self._fault(node, name, f"it is a function: write {usage}")
        known = [*self.names, *CONSTANTS]
        listed = f"the names are {', '.join(known)}; {quantity('let')} adds more"
        why = did_you_mean(name, [*known, *FUNCTIONS], listed)
        raise self._fault(node, f"name {name[:20]}", why)

    def _bracket(self, node: Bracket) -> Value:
        rows = [[self.value_of(entry) for entry in row[: LARGEST + 1]] for row in node.rows]
        entries = [value for row in rows for value in row]
        kinds = {value.kind for value in entries}
        if kinds == {ValueKind.SCALAR}:
            if len({len(row) for row in rows}) > 1:
                sizes = ", ".join(str(len(row)) for row in rows[:LARGEST])
                raise self._fault(
                    node, "bracket", f"its rows have {sizes} numbers: make them equal"
                )
            numbers = tuple(tuple(value.scalar for value in row) for row in rows)
            if len(numbers) == 1 or len(numbers[0]) == 1:  # one row or one column is a vector
                numbers = (tuple(number for row in numbers for number in row),)
        elif kinds == {ValueKind.VECTOR} and len({value.shape for value in entries}) == 1:
            numbers = tuple(value.vector for value in entries)
        else:
            why = "it holds numbers, or rows of equal length" if entries else "it is empty"
            raise self._fault(node, "bracket", why)
        if max(len(numbers), len(numbers[0])) > LARGEST:
            raise self._fault(node, "bracket", f"it has at most {LARGEST} rows and columns")
        return Value(numbers[0] if kinds == {ValueKind.SCALAR} and len(numbers) == 1 else numbers)

    def _prefix(self, node: Prefix) -> Value:
        value = self.value_of(node.operand)
        if node.sign == "√":
            return self._applied(node, "sqrt", [value], {})
        if value.kind is ValueKind.TRUTH:
            raise self._fault(node, node.sign, "it is for numbers, not for a comparison")
        return -value if node.sign == "-" else value

    def _infix(self, node: Infix) -> Value:
        a, b = self.value_of(node.left), self.value_of(node.right)
        if node.sign == "==":
            return Value(self._tried(node.at, "==", equal, (a, b)))
        if node.sign == "≈":
            is_near, told = self._tried(node.at, "≈", nearly_equal, (a, b))
            self.remarks.append(told)
            return Value(is_near)
        value, rule = self._tried(node.at, node.sign, partial(binary, node.sign), (a, b))
        return self._step(node, value, rule)

    def _tried(
        self,
        at: int,
        what: str,
        compute: Callable[..., T],
        values: Sequence[Argument | None],
        places: Mapping[int, int] | None = None,
    ) -> T:
        """Compute with exact roots, or with their bounds where the roots grow too many.

        `places` tells where in the expression each argument stands, by its identity.
        """
        try:
            try:
                return compute(*values)
            except TooManyRootsError:
                bounds = (one.enclosed() if isinstance(one, Value) else one for one in values)
                return compute(*bounds)
        except (IllegalValueError, NoAnswerError) as error:
            given = getattr(error, "given", None)
            raise self._error((places or {}).get(id(given), at), what, error) from None

    def _power(self, node: Power) -> Value:
        base = self.value_of(node.base)
        if node.is_transposed:
            name = "transpose" if node.exponent > 0 else "inverse_transpose"
            return self._applied(node, name, [base], {})
        if base.kind is ValueKind.MATRIX and node.exponent < 0:
            base = self._applied(node, "inverse", [base], {})
        raised = partial(power, exponent=node.exponent, arithmetic=self.arithmetic)
        value = self._tried(node.at, "^", raised, [base])
        return value if abs(node.exponent) == 1 else self._step(node, value, "multiplied by itself")

    def _member(self, node: Member) -> Value:
        value = self.value_of(node.value)
        if node.name in ("T", "inv"):
            name = "transpose" if node.name == "T" else "inverse"
            return self._applied(node, name, [value], {})
        if value.kind is not ValueKind.VECTOR:
            why = f"it is of vectors, and this is {value.shape}"
            raise CalculatorError(self.expression, node.at, f".{node.name}", why)
        if node.name == "xyz":
            if len(value.vector) < 3:
                raise CalculatorError(self.expression, node.at, ".xyz", f"this is {value.shape}")
            return replace(value, entries=value.vector[:3])
        place = COMPONENTS.index(node.name)
        if place >= len(value.vector):
            why = f"this is {value.shape}"
            raise CalculatorError(self.expression, node.at, f".{node.name}", why)
        return Value(value.vector[place])

    def _index(self, node: Index) -> Value:
        value = self.value_of(node.value)
        places = [None if place is None else self.value_of(place) for place in node.places]
        return self._tried(node.at, "an index", lambda one: part(one, places), [value])

    def _call(self, node: Call) -> Value:
        name = node.function
        if name not in FUNCTIONS:
            if name in self.names:
                why = f"{name} is a value: * and @ multiply it, {name}[0] is its first part"
                raise self._fault(node, name, why)
            step = did_you_mean(name, FUNCTIONS, "help lists them")
            raise self._fault(node, f"function {name[:20]}", step)
        arguments = [self._argument(one) for one in node.arguments]
        named = {key: self._argument(one) for key, one in node.named}
        if len(named) < len(node.named):
            raise self._fault(node, name, "an argument is given twice")
        value = self._applied(node, name, arguments, named)
        self._remark_angles(node, [*arguments, *named.values()])
        return value

    def _argument(self, node: Node) -> Argument:
        return node.word if isinstance(node, Word) else self.value_of(node)

    def _applied(
        self, node: Node, name: str, arguments: list[Argument], named: Mapping[str, Argument]
    ) -> Value:
        function = FUNCTIONS[name]
        at = node.at if isinstance(node, (Member, Power)) else node.start
        places = _places(node, [*arguments, *named.values()])
        binding = partial(function.bound, arguments, named, self.names)
        bound = self._tried(at, name, binding, [], places)
        value = self._tried(at, name, function.compute, bound, places)
        if function.remarks:
            self.remarks += self._tried(at, name, function.remarks, bound, places)
        return self._step(node, value, function.rule)

    def _remark_angles(self, node: Call, values: Sequence[Argument]) -> None:
        """Keep a remark on every angle that is a multiple of π, or looks like radians."""
        parameters = FUNCTIONS[node.function].parameters
        named = {one.name: one for one in parameters}
        written = [
            *zip(parameters, node.arguments, strict=False),
            *((named[key], one) for key, one in node.named),
        ]
        for (parameter, argument), value in zip(written, values, strict=False):
            if not parameter.is_angle or isinstance(value, str):
                continue
            entries = (
                [one for row in argument.rows for one in row]
                if isinstance(argument, Bracket)
                else [argument]
            )
            for one, x in zip(entries, value.numbers, strict=False):
                self._remark_radians(node.function, one, x)

    def _remark_radians(self, function: str, node: Node, turned: Number) -> None:
        typed, times = self._typed(node), times_pi(turned)
        if times is not None:
            self.remarks.append(f"{typed} is in radians, {times * 180} degrees.")
            return
        number = node.operand if isinstance(node, Prefix) and node.sign in "+-" else node
        size = shown(turned) if isinstance(number, Numeral) else None
        if not isinstance(size, Fraction | float):
            return
        found = like_radians([Fraction(size)])
        if found is not None:
            looks = f"{typed} looks like {of_pi(found[1])} radians"
            said = f"{function} takes degrees, but {looks}, {180 * found[1]} degrees."
            self.remarks.append(said)

    def _step(self, node: Node, value: Value, rule: str) -> Value:
        kept = self._kept(node, value)
        self.steps.append(CalculationStep(self._typed(node), kept, rule))
        return kept

    def _typed(self, node: Node) -> str:
        return self.expression[node.start : node.end]

    def _kept(self, node: Node, value: Value) -> Value:
        try:
            return value.kept_by(self.arithmetic)
        except (IllegalValueError, NoAnswerError) as error:
            raise self._error(node.start, "value", error) from None


def _places(node: Node, given: Sequence[Argument]) -> dict[int, int]:
    """Tell where each argument of a call stands, by the identity of its value."""
    if not isinstance(node, Call):
        return {}
    written = [*node.arguments, *(one for _, one in node.named)]
    pairs = list(zip(given, written, strict=False))
    return {id(value): one.start for value, one in reversed(pairs)}
