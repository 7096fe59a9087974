"""Evaluate an expression of the closed grammar, one operation at a time, and keep the steps."""

from __future__ import annotations

import ast
from collections.abc import Mapping
from dataclasses import dataclass, field

from nmatrix.calculator.faults import CalculatorError, NoValueError
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.grammar import OPERATORS, operator_position, parse, plain
from nmatrix.calculator.operators import BINARY
from nmatrix.calculator.values import Arithmetic, Value, ValueKind
from nmatrix.errors import IllegalValueError, NMatrixError, NoAnswerError, quantity
from nmatrix.reading.angles import like_radians, of_pi
from nmatrix.reading.literal import BARE_POINT
from nmatrix.reading.numbers import fraction
from nmatrix.report import LARGEST_MATRIX

Names = Mapping[str, Value]


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
    >>> calculate("det([[1, 2], [3, 4]]) / 4", {}).value.entries
    Fraction(-1, 2)
    """
    expression = plain(expression)
    evaluation = _Evaluation(expression, names, arithmetic)
    value = evaluation.value_of(parse(expression))
    steps, remarks = tuple(evaluation.steps), tuple(dict.fromkeys(evaluation.remarks))
    return Calculation(expression, value, arithmetic, steps, remarks)


@dataclass
class _Evaluation:
    expression: str
    names: Names
    arithmetic: Arithmetic
    steps: list[CalculationStep] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)

    def value_of(self, node: ast.expr) -> Value:  # noqa: PLR0911 - one line for each kind of node
        match node:
            case ast.Constant():
                return self._constant(node)
            case ast.Name(id=name):
                return self._name(node, name)
            case ast.List(elts=elements) | ast.Tuple(elts=elements):
                return self._bracket(node, elements)
            case ast.Attribute(value=inner):
                return self._call(node, "transpose", [inner])
            case ast.Call(func=ast.Name(id=name), args=arguments):
                return self._call(node, name, arguments)
            case ast.UnaryOp(op=ast.USub(), operand=operand):
                return -self.value_of(operand)
            case ast.UnaryOp(operand=operand):
                return self.value_of(operand)
            case ast.BinOp(left=left, op=operator, right=right):
                return self._binary(node, OPERATORS[type(operator)], left, right)
        raise self._fault(node, "expression", "it is outside the grammar")

    def _error(self, at: int, what: str, error: NMatrixError) -> NMatrixError:
        """Repeat the error of an operation with its place in the expression."""
        kind = NoValueError if isinstance(error, NoAnswerError) else CalculatorError
        return kind(self.expression, at, what, str(error))

    def _fault(self, node: ast.expr, what: str, why: str) -> NMatrixError:
        return CalculatorError(self.expression, node.col_offset, what, why)

    def _constant(self, node: ast.Constant) -> Value:
        try:
            value = Value(fraction(BARE_POINT.sub("", self._typed(node))))
        except IllegalValueError as error:
            _, _, why = str(error).partition(": ")
            raise self._fault(node, "number", why) from None
        return self._kept(node, value)

    def _name(self, node: ast.expr, name: str) -> Value:
        if name in self.names:
            return self._kept(node, self.names[name])
        if name in FUNCTIONS:
            raise self._fault(node, name, f"it is a function: write {name}(…)")
        known = ", ".join(self.names) or "none"
        raise self._fault(
            node, f"name {name[:20]}", f"the names are {known}; {quantity('let')} adds more"
        )

    def _bracket(self, node: ast.expr, elements: list[ast.expr]) -> Value:
        values = [self.value_of(element) for element in elements[: LARGEST_MATRIX + 1]]
        kinds = {value.kind for value in values}
        sizes = {value.shape for value in values}
        is_long = len(values) > LARGEST_MATRIX
        if not values or is_long or len(sizes) != 1 or ValueKind.MATRIX in kinds:
            holds = f"it holds up to {LARGEST_MATRIX} numbers, or rows of equal length"
            raise self._fault(node, "bracket", holds)
        return Value(tuple(value.entries for value in values))  # type: ignore[arg-type]

    def _call(self, node: ast.expr, name: str, arguments: list[ast.expr]) -> Value:
        function = FUNCTIONS.get(name)
        if function is None:
            raise self._fault(node, f"function {name[:20]}", f"there are {', '.join(FUNCTIONS)}")
        values = [self.value_of(argument) for argument in arguments]
        if function.gathers and [v.kind for v in values] == [ValueKind.SCALAR] * 3:
            values = [Value(tuple(v.scalar for v in values))]
        if tuple(value.kind for value in values) != function.takes:
            got = " and ".join(value.shape for value in values[:4]) or "nothing"
            raise self._fault(node, name, f"it takes {function.wanted}, got {got}")
        try:
            found = function.compute(*values)
        except (IllegalValueError, NoAnswerError) as error:
            raise self._error(node.col_offset, name, error) from None
        if function.turns:
            self._remark_radians(name, arguments[0], values[0])
        return self._step(node, found, function.rule)

    def _remark_radians(self, name: str, argument: ast.expr, turn: Value) -> None:
        """Keep a remark on an angle that was typed and looks like radians."""
        typed = argument.operand if isinstance(argument, ast.UnaryOp) else argument
        if isinstance(typed, ast.Constant):
            found = like_radians([turn.scalar])
            if found is not None:
                looks = f"{self._typed(argument)} looks like {of_pi(found[1])} radians"
                self.remarks.append(f"{name} takes degrees, but {looks}, {180 * found[1]} degrees.")

    def _binary(self, node: ast.expr, sign: str, left: ast.expr, right: ast.expr) -> Value:
        a, b = self.value_of(left), self.value_of(right)
        try:
            entries, rule = BINARY[sign](a, b)
        except (IllegalValueError, NoAnswerError) as error:
            at = operator_position(self.expression, left)
            raise self._error(at, sign, error) from None
        return self._step(node, Value(entries), rule)

    def _step(self, node: ast.expr, value: Value, rule: str) -> Value:
        kept = self._kept(node, value)
        self.steps.append(CalculationStep(self._typed(node), kept, rule))
        return kept

    def _typed(self, node: ast.expr) -> str:
        return self.expression[node.col_offset : node.end_col_offset]

    def _kept(self, node: ast.expr, value: Value) -> Value:
        try:
            return value.kept_by(self.arithmetic)
        except (IllegalValueError, NoAnswerError) as error:
            raise self._error(node.col_offset, "value", error) from None
