"""Evaluate an expression of the closed grammar, one operation at a time, and keep the steps."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import partial
from itertools import zip_longest
from typing import TypeVar

from nmatrix.calculator.arithmetic.meanings import SCENE, Meaning
from nmatrix.calculator.arithmetic.numbers import PiMultiple
from nmatrix.calculator.arithmetic.operators import binary, equal, nearly_equal, part, power
from nmatrix.calculator.arithmetic.symbolic import Symbolic
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, ValueKind
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.elsewhere import instead_of
from nmatrix.calculator.functions.function import Argument, Parameter
from nmatrix.calculator.language.faults import CalculatorError, MeaningError, NoValueError
from nmatrix.calculator.language.grammar import parse
from nmatrix.calculator.language.tree import (
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
from nmatrix.calculator.meaning import function_rules, rules
from nmatrix.calculator.meaning.homogeneous import settled, understood, w_of, with_w
from nmatrix.calculator.meaning.nearest import Part, forms
from nmatrix.calculator.meaning.operands import Operand, RefusedError, bared
from nmatrix.calculator.remarks import on_angles, on_letters
from nmatrix.errors import IllegalValueError, NMatrixError, NoAnswerError, did_you_mean, quantity
from nmatrix.linear import rational
from nmatrix.reading.literal import BARE_POINT
from nmatrix.reading.numbers import fraction
from nmatrix.surds import TooManyRootsError

T = TypeVar("T")
Names = Mapping[str, Value]
CONSTANTS: dict[str, Value] = {"pi": Value(PiMultiple(Fraction(1)))}
COMPONENTS = "xyzw"
LETTERED = 16  # entries of a matrix that may hold letters
LETTER = re.compile(r"[a-zα-ω][0-9]{0,2}")  # a name that may stay without a value


@dataclass(frozen=True)
class CalculationStep:
    """One operation on its operands: the part of the expression, its value, and the rule."""

    expression: str
    value: Value
    operation: str
    rule: str
    given: tuple[Operand | str | None, ...]


@dataclass(frozen=True)
class Calculation:
    """The answer to one expression."""

    expression: str
    value: Value
    arithmetic: Arithmetic
    steps: tuple[CalculationStep, ...]
    remarks: tuple[str, ...] = ()


def calculate(
    expression: str,
    names: Names,
    arithmetic: Arithmetic = Arithmetic.EXACT,
    *,
    untyped: bool = False,
) -> Calculation:
    """Compute an expression over named matrices, exactly; `untyped` lets any two spaces meet.

    Raises
    ------
    CalculatorError
        For a fault in the expression, with a caret in front of it.
    MeaningError
        For an operation between spaces that do not meet, or kinds that do not go together.
    NoValueError
        For the inverse of a singular matrix, a division by zero, a direction of length zero.

    Examples
    --------
    >>> calculate("det([1 2; 3 4]) / 4", {}).value.entries
    Fraction(-1, 2)
    """
    expression = expression.strip()
    evaluation = _Evaluation(expression, names, arithmetic, untyped=untyped)
    value = evaluation.value_of(parse(expression, frozenset((*FUNCTIONS, *names))))
    evaluation.remark_letters(value)
    if untyped:
        value = Value(value.entries)
    steps, remarks = tuple(evaluation.steps), tuple(dict.fromkeys(evaluation.remarks))
    return Calculation(expression, value, arithmetic, steps, remarks)


@dataclass
class _Evaluation:
    expression: str
    names: Names
    arithmetic: Arithmetic
    untyped: bool = False
    advises: bool = True
    steps: list[CalculationStep] = field(default_factory=list)
    remarks: list[str] = field(default_factory=list)
    letters: set[str] = field(default_factory=set)
    below: dict[str, None] = field(default_factory=dict)
    products: dict[int, Infix] = field(default_factory=dict)

    def value_of(self, node: Node) -> Value:  # noqa: C901, PLR0911 - one line for each kind
        match node:
            case Numeral():
                return self._numeral(node)
            case Turn():
                return self._kept(node, Value(node.degrees))
            case Pasted():
                rows = tuple(tuple(map(_entry, row)) for row in node.rows)
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
        told, *reasons = error.parts
        reason = "; ".join(filter(None, reasons))
        return kind(self.expression, at, what, ": ".join(filter(None, (told, reason))))

    def _fault(self, node: Node, what: str, why: str) -> NMatrixError:
        return CalculatorError(self.expression, node.start, what, why)

    def _numeral(self, node: Numeral) -> Value:
        try:
            return self._kept(node, Value(_entry(node.text)))
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
        if LETTER.fullmatch(name) and self.arithmetic is Arithmetic.EXACT:
            self.letters.add(name)
            return Value(Symbolic.letter(name))
        known = [*self.names, *CONSTANTS]
        listed = f"the names are {', '.join(known)}; {quantity('let')} adds more"
        why = did_you_mean(name, [*known, *FUNCTIONS], listed)
        raise self._fault(node, f"name {name[:20]}", why)

    def _bracket(self, node: Bracket) -> Value:
        rows = [[self.value_of(entry) for entry in row] for row in node.rows]
        entries = [value for row in rows for value in row]
        kinds = {value.kind for value in entries}
        if kinds == {ValueKind.SCALAR}:
            if len({len(row) for row in rows}) > 1:
                sizes = ", ".join(str(len(row)) for row in rows)
                raise self._fault(
                    node, "bracket", f"its rows have {sizes} numbers: make them equal"
                )
            numbers = tuple(tuple(value.scalar for value in row) for row in rows)
            if len(numbers) == 1 or len(numbers[0]) == 1:  # one row or one column is a vector
                numbers = (tuple(number for row in numbers for number in row),)
        elif kinds == {ValueKind.VECTOR} and len({value.shape for value in entries}) == 1:
            numbers = tuple(value.vector for value in entries)
        else:
            raise self._no_bracket(node, entries)
        return Value(numbers[0] if kinds == {ValueKind.SCALAR} and len(numbers) == 1 else numbers)

    def _no_bracket(self, node: Bracket, entries: Sequence[Value]) -> NMatrixError:
        """Tell which entry of a bracket does not go with the first one."""
        if not entries:
            return self._fault(node, "bracket", "it is empty")
        typed = [entry for row in node.rows for entry in row]
        for entry, value in zip(typed, entries, strict=True):
            if value.shape != entries[0].shape:
                among = f"{entries[0].shape}, {self._typed(typed[0])}"
                why = f"it is {value.shape} beside {among}: one bracket holds one kind"
                return self._fault(entry, self._typed(entry), why)
        return self._fault(node, "bracket", f"it holds numbers or vectors, not {entries[0].shape}")

    def _prefix(self, node: Prefix) -> Value:
        value = self.value_of(node.operand)
        if node.sign == "√":
            return self._applied(node, "sqrt", [value], {})
        if value.kind is ValueKind.TRUTH:
            raise self._fault(node, node.sign, "it is for numbers, not for a comparison")
        if node.sign == "-":
            return replace(-value, meaning=rules.negated(value.meaning))
        return value

    def _infix(self, node: Infix) -> Value:
        if node.sign == "@" and isinstance(node.left, Infix):
            self.products[id(node.left)] = self.products.get(id(node), node)
        a, b = self.value_of(node.left), self.value_of(node.right)
        if node.sign in rules.ENTRY_BY_ENTRY:
            a, b = understood(a, b), understood(b, a)
        operands = self._operand(node.left, a), self._operand(node.right, b)
        found = partial(rules.meaning_of, node.sign, *operands)
        meaning = self._meaning(node, node.sign, found, operands)
        if node.sign in ("==", "≈"):
            return self._comparison(node, operands)
        value, rule = self._tried(node.at, node.sign, partial(binary, node.sign), (a, with_w(a, b)))
        if node.sign == "/" and isinstance(b.entries, Symbolic):
            self._divided(Value(1 / b.entries))
        value = self._tried(node.at, node.sign, settled, [replace(value, meaning=meaning)])
        return self._step(node, value, (node.sign, rule), operands)

    def _comparison(self, node: Infix, operands: tuple[Operand, Operand]) -> Value:
        a, b = (one.value for one in operands)
        told = rules.different_ways(*operands)
        self.remarks += [told] if told and not self.untyped else []
        if node.sign == "==":
            return Value(self._tried(node.at, "==", equal, (a, b)))
        is_near, told = self._tried(node.at, "≈", nearly_equal, (a, b))
        self.remarks.append(told)
        return Value(is_near)

    def _operand(self, node: Node, value: Value) -> Operand:
        return Operand(value, self._typed(node), node.start)

    def _meaning(
        self,
        node: Node,
        what: str,
        found: Callable[[], Meaning | None],
        operands: Sequence[Operand],
    ) -> Meaning | None:
        """Find what a result means, or refuse it with the nearest right form."""
        try:
            return found()
        except RefusedError as refused:
            if self.untyped:
                return None
            part = self._part(node, operands)
            meant = {name: value.meaning for name, value in self.names.items()}
            written = forms(refused, part, meant) if self.advises else ()
            instead = next(filter(self._is_right, written), "")
            at = node.at if isinstance(node, (Infix, Member, Power)) else node.start
            raise MeaningError(self.expression, at, what, refused, instead) from None

    def _part(self, node: Node, operands: Sequence[Operand]) -> Part:
        """Take the part of the expression that a refusal is about: of products the whole chain."""
        if not (isinstance(node, Infix) and node.sign == "@"):
            written = sorted({one.start: one for one in operands if one.start is not None}.items())
            found = tuple(one for _, one in written)
            is_dot = isinstance(node, Infix) and node.sign == "·"
            is_product = is_dot and found[0].value.kind is ValueKind.MATRIX
            return Part(self._typed(node), node.start, found, is_product=is_product)
        whole = self.products.get(id(node), node)
        factors: list[Node] = [whole]
        while isinstance(factors[0], Infix) and factors[0].sign == "@":
            factors[:1] = [factors[0].left, factors[0].right]
        quiet = replace(self, steps=[], remarks=[], products={}, advises=False)
        chain: list[Operand] = []
        try:
            for factor in factors:
                chain.append(self._operand(factor, quiet.value_of(factor)))
                if chain[-1].value.kind is ValueKind.VECTOR:
                    break
        except NMatrixError:  # further on there is another fault
            return Part(self._typed(node), node.start, tuple(operands), is_product=True)
        end = whole.end if len(chain) == len(factors) else factors[len(chain) - 1].end
        text, rest = self.expression[whole.start : end], self.expression[node.end : end]
        return Part(text, whole.start, tuple(chain), is_product=True, rest=rest)

    def _is_right(self, form: str) -> bool:
        """Try a form, over V and P too where these have no name yet."""
        scene = {name: Value(rational.identity(4), led) for name, led in SCENE.items()}
        names = scene | dict(self.names)
        tried = _Evaluation(form, names, self.arithmetic, advises=False)
        try:
            tried.value_of(parse(form, frozenset((*FUNCTIONS, *names))))
        except NMatrixError:
            return False
        return True

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
        if node.exponent < 0 and isinstance(base.entries, Symbolic):
            self._divided(Value(1 / base.entries))
        operand = self._operand(node.base, base)
        meaning = self._meaning(
            node, "^", partial(rules.raised, operand, abs(node.exponent)), [operand]
        )
        raised = partial(power, exponent=node.exponent, arithmetic=self.arithmetic)
        value = replace(self._tried(node.at, "^", raised, [base]), meaning=meaning)
        if abs(node.exponent) == 1:
            return value
        given = (operand, str(abs(node.exponent)))
        return self._step(node, value, ("^", "multiplied by itself"), given)

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
        if node.name == "w" and (w := w_of(value)) is not None:
            return Value(w)
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
            raise self._fault(node, f"function {name[:20]}", instead_of(name))
        taken = FUNCTIONS[name].parameters
        by_name = {one.name: one for one in taken}
        arguments = [
            self._argument(one, parameter)
            for one, parameter in zip_longest(node.arguments, taken[: len(node.arguments)])
        ]
        named = {key: self._argument(one, by_name.get(key)) for key, one in node.named}
        if len(named) < len(node.named):
            raise self._fault(node, name, "an argument is given twice")
        value = self._applied(node, name, arguments, named)
        self.remarks += on_angles(self.expression, node, [*arguments, *named.values()])
        return value

    def _argument(self, node: Node, parameter: Parameter | None) -> Argument:
        """Evaluate an argument; where only words are taken, a name is a word."""
        if isinstance(node, Name) and parameter is not None and not parameter.kinds:
            return node.name
        return node.word if isinstance(node, Word) else self.value_of(node)

    def _applied(
        self, node: Node, name: str, arguments: list[Argument], named: Mapping[str, Argument]
    ) -> Value:
        function = FUNCTIONS[name]
        for one in arguments:
            if isinstance(one, Value) and one.letters and len(list(one.numbers)) > LETTERED:
                why = "letters are kept in matrices up to 4×4: give them values"
                raise self._fault(node, name, why)
        at = node.at if isinstance(node, (Member, Power)) else node.start
        places = _places(node, [*arguments, *named.values()])
        binding = partial(function.bound, arguments, named, self.names)
        bound = self._tried(at, name, binding, [], places)
        given = self._given(node, [*arguments, *named.values()], bound)
        operands = [one for one in given if isinstance(one, Operand)]
        found = partial(self._tried, at, name, partial(function_rules.meaning_of, name, given), [])
        meaning = self._meaning(node, name, found, operands)
        value = self._tried(at, name, function.compute, bound, places)
        if function.remarks:
            self.remarks += self._tried(at, name, function.remarks, bound, places)
        value = settled(replace(value, meaning=meaning))
        return self._step(node, value, (name, function.rule), given)

    def _given(
        self, node: Node, arguments: Sequence[Argument], bound: Sequence[Argument | None]
    ) -> list[Operand | str | None]:
        """Give the values that a function takes the texts that they come from."""
        match node:
            case Call():
                nodes = (*node.arguments, *(one for _, one in node.named))
            case Member():
                nodes = (node.value,)
            case Power():
                nodes = (node.base,)
            case Prefix():
                nodes = (node.operand,)
        typed = {id(one): at for one, at in zip(arguments, nodes, strict=True)}
        given: list[Operand | str | None] = []
        for one in bound:
            if isinstance(one, Value):
                at = typed.get(id(one))
                given.append(Operand(one) if at is None else self._operand(at, one))
            else:
                given.append(one)
        return given

    def remark_letters(self, value: Value) -> None:
        """Keep a remark on names without a value, and on what must not be 0."""
        if self.letters:
            self._divided(value)
            self.remarks += on_letters(self.letters, self.below)

    def _divided(self, value: Value) -> None:
        """Keep what a value is divided by, which may cancel later and must not be 0 even so."""
        for one in value.numbers:
            if isinstance(one, Symbolic):
                self.below |= dict.fromkeys(one.denominators)

    def _step(
        self,
        node: Node,
        value: Value,
        what: tuple[str, str],
        given: Sequence[Operand | str | None],
    ) -> Value:
        """Keep an operation, by its name and its rule, with what it was given."""
        kept = self._kept(node, value)
        if kept.kind is not ValueKind.TRUTH:
            self._divided(kept)
        self.steps.append(CalculationStep(bared(self._typed(node)), kept, *what, tuple(given)))
        return kept

    def _typed(self, node: Node) -> str:
        return self.expression[node.start : node.end]

    def _kept(self, node: Node, value: Value) -> Value:
        try:
            return value.kept_by(self.arithmetic)
        except (IllegalValueError, NoAnswerError) as error:
            raise self._error(node.start, "value", error) from None


def _entry(text: str) -> Fraction:
    """Read a number of another program, which may print 1. for 1."""
    return fraction(BARE_POINT.sub("", text))


def _places(node: Node, given: Sequence[Argument]) -> dict[int, int]:
    """Tell where each argument of a call stands, by the identity of its value."""
    if not isinstance(node, Call):
        return {}
    written = [*node.arguments, *(one for _, one in node.named)]
    pairs = list(zip(given, written, strict=False))
    return {id(value): one.start for value, one in reversed(pairs)}
