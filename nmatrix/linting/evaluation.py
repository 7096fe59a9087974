"""Expressions become values: names are looked up, operators judged, functions followed.

Each function is followed for a few calls only, so that the work grows with the length of the source
and with nothing else.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from dataclasses import replace

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.algebra import FOURTHS, negated, swizzled
from nmatrix.linting.builtins import FIELDS, FUNCTIONS, Giving, Moving, built_in
from nmatrix.linting.declarations import Conventions, Declarations, Scope
from nmatrix.linting.intrinsics import INTRINSICS
from nmatrix.linting.judging import Judge
from nmatrix.linting.names import matrix_named, vector_named
from nmatrix.linting.tree import (
    Expression,
    Function,
    Shader,
    Storage,
    Variable,
)
from nmatrix.linting.values import (
    ANYTHING,
    Because,
    Carried,
    Fourth,
    Length,
    Matrix,
    Record,
    Scalar,
    Sense,
    Value,
    Vector,
    joined,
)

MOST_CALLS = 8  # of one function that are followed
MOST_MACROS = 256  # uses of one macro
DEEPEST_CALLS = 24


class Evaluation(Declarations, ABC):
    """The expressions of one shader."""

    def __init__(self, shader: Shader, judge: Judge, conventions: Conventions) -> None:
        super().__init__(shader, judge, conventions)
        self.functions: dict[str, list[Function]] = {}
        for one in shader.functions:
            self.functions.setdefault(one.name, []).append(one)
        self.globals = Scope()
        self.calls: Counter[str] = Counter()
        self.running: list[str] = []

    @abstractmethod
    def run(self, function: Function, scope: Scope) -> Value:
        """Follow the statements of a function; its value is what it returns."""

    def clamp(self, condition: Expression, scope: Scope, *, is_true: bool) -> None:
        """Believe a comparison: what it says is large may be positive from here on."""
        match condition:
            case tree.Binary(operator="&&", left=left, right=right) if is_true:
                self.clamp(left, scope, is_true=True)
                self.clamp(right, scope, is_true=True)
            case tree.Binary(operator="||", left=left, right=right) if not is_true:
                self.clamp(left, scope, is_true=False)
                self.clamp(right, scope, is_true=False)
            case tree.Binary(operator=sign, left=tree.Name(name=name), right=_):
                if sign in ((">", ">=") if is_true else ("<", "<=")):
                    self._clamp_name(name, scope)
            case tree.Binary(operator=sign, left=_, right=tree.Name(name=name)):
                if sign in (("<", "<=") if is_true else (">", ">=")):
                    self._clamp_name(name, scope)
            case _:
                pass

    def _clamp_name(self, name: str, scope: Scope) -> None:
        value = scope.find(name)
        if isinstance(value, Scalar):
            scope.write(name, replace(value, is_clamped=True))

    # Expressions.

    def value(self, expression: Expression, scope: Scope) -> Value:
        """Evaluate an expression."""
        match expression:
            case tree.Name(name=name):
                return self._variable(name, scope)
            case tree.Number(value=number):
                return Scalar(number=number, is_clamped=number >= 0)
            case tree.Unary():
                return self._unary(expression, scope)
            case tree.Unread():
                return ANYTHING
            case _:
                return self._composed(expression, scope)

    def _unary(self, expression: tree.Unary, scope: Scope) -> Value:
        if expression.operator != "-":
            return self.value(expression.operand, scope)
        is_dot = isinstance(expression.operand, tree.Call) and expression.operand.function == "dot"
        was_turned, self.judge.is_turned = self.judge.is_turned, is_dot
        value = self.value(expression.operand, scope)
        self.judge.is_turned = was_turned
        return negated(value)

    def _composed(self, expression: Expression, scope: Scope) -> Value:
        match expression:
            case tree.Binary():
                return self._operated(expression, scope)
            case tree.Call():
                return self._called(expression, scope)
            case tree.Member():
                return self._member(expression, scope)
            case tree.Element():
                return self._element(expression, scope)
            case tree.Conditional():
                return self._conditional(expression, scope)
            case tree.Assignment():
                return self._assigned(expression, scope)
            case _:
                return ANYTHING

    def _element(self, expression: tree.Element, scope: Scope) -> Value:
        self.value(expression.index, scope)
        value = self.value(expression.of, scope)
        if self.typed(expression.of, scope)[1]:
            return value
        if isinstance(value, Matrix):
            return Vector(size=value.size)  # a column
        return Scalar() if isinstance(value, Vector) else value

    def _variable(self, name: str, scope: Scope) -> Value:
        found = scope.find(name)
        if found is not None:
            return found
        macro = self.shader.macros.get(name)
        is_open = name in self.running or len(self.running) >= DEEPEST_CALLS
        if macro is not None and not is_open and self.calls[name] < MOST_MACROS:
            self.calls[name] += 1
            self.running.append(name)
            value = self.value(macro, scope)
            self.running.pop()
            return value
        return self._undeclared(name)

    def _undeclared(self, name: str) -> Value:
        found = built_in(name, self.stage)
        if found is not None:
            return found
        if "matrix" in name.lower():  # of an engine, or of an included file
            named = matrix_named(name)
            if named is not None:
                return self.as_convened(named)
        if name in FIELDS:
            return Record(name, name, ())
        told = vector_named(name, "vec3", Storage.LOCAL, self.stage)
        if told.kind in (Carried.NORMAL, Carried.TANGENT):
            return told
        return ANYTHING

    def _operated(self, expression: tree.Binary, scope: Scope) -> Value:
        left = self.value(expression.left, scope)
        right = self.value(expression.right, scope)
        match expression.operator:
            case "*":
                return self.judge.multiplied(expression, left, right)
            case ".*" | "/":
                if _is_w_of(expression, left) and isinstance(left, Vector):
                    return replace(left, w=None)
                return self.judge.scaled(expression, left, right)
            case "+" | "-":
                self._judge_window(expression, left, right)
                if expression.operator == "-" and _is_zero(expression.left):
                    return negated(right)
                found = self.judge.added(expression, left, right)
                if isinstance(found, Vector) and found.kind is None:
                    return replace(found, sense=self._sense_of(expression, left, right))
                return found
            case _:
                return Scalar()

    def _sense_of(self, difference: tree.Binary, left: Value, right: Value) -> Sense:
        """Tell whether what is not known by name leads away from the surface or to it."""
        if (
            difference.operator == "-"
            and _is_unknown(left)
            and self._is_surface(difference.right, right)
        ):
            return Sense.OUT
        if (
            difference.operator == "-"
            and _is_unknown(right)
            and self._is_surface(difference.left, left)
        ):
            return Sense.IN
        return Sense.UNKNOWN

    def _is_surface(self, written: Expression, value: Value) -> bool:
        """Whether a point is one of the surface: a lamp's may be called a position too."""
        if not isinstance(value, Vector) or value.kind is not Carried.POINT or value.role:
            return False
        while isinstance(written, tree.Member):
            written = written.of
        variable = self.declared.get(written.name) if isinstance(written, tree.Name) else None
        is_input = variable is not None and variable.storage in (Storage.INPUT, Storage.BOTH)
        return is_input or value.because is Because.ARITHMETIC

    def _judge_window(self, sum_: tree.Binary, left: Value, right: Value) -> None:
        """Find a change from −1…1 to 0…1 of what was not divided by w."""
        for value, written, other in (
            (left, sum_.left, sum_.right),
            (right, sum_.right, sum_.left),
        ):
            if isinstance(value, Vector) and value.size < 4 and _is_half(other):
                scaled = _halved(written)
                if scaled is not None:
                    self.judge.undivided(sum_, value, scaled)

    def _conditional(self, expression: tree.Conditional, scope: Scope) -> Value:
        self.value(expression.condition, scope)
        above = Scope(scope)
        self.clamp(expression.condition, above, is_true=True)
        was_gated = self.judge.is_gated
        self.judge.is_gated |= compares(expression.condition)
        chosen = self.value(expression.chosen, above)
        otherwise = self.value(expression.otherwise, scope)
        self.judge.is_gated = was_gated
        return joined(chosen, otherwise)

    def _assigned(self, expression: tree.Assignment, scope: Scope) -> Value:
        value = self.value(expression.value, scope)
        operator = expression.operator.removesuffix("=")
        if operator:
            before = self.value(expression.target, scope)
            at = tree.Binary(expression.span, operator, expression.target, expression.value)
            if operator == "*" and self.shader.language is ShaderLanguage.HLSL:
                value = self.judge.scaled(at, before, value)
            elif operator == "*":
                value = self.judge.multiplied(at, before, value)
            elif operator == "/":
                value = (
                    replace(before, w=None)
                    if isinstance(before, Vector) and _is_w_of(at, before)
                    else self.judge.scaled(at, before, value)
                )
            elif operator in ("+", "-"):
                value = self.judge.added(at, before, value)
            else:
                value = ANYTHING
        if isinstance(expression.target, tree.Name):
            self._write_name(expression.target, value, scope, expression.value)
        else:
            self.write(expression.target, value, scope)
        return value

    def write(self, target: Expression, value: Value, scope: Scope) -> None:
        """Put a value where an expression says."""
        match target:
            case tree.Name(name=name):
                self._write_name(target, value, scope, None)
            case tree.Member(of=of, name=name):
                owner = self.value(of, scope)
                if isinstance(owner, Record):
                    self.write(of, owner.with_field(name, value), scope)
                elif isinstance(owner, Vector):
                    written = _with_components(owner, name, value)
                    if written is not None:
                        self.write(of, written, scope)
            case tree.Element(of=of):
                owner = self.value(of, scope)
                if isinstance(owner, Vector) and isinstance(value, Vector):
                    self.write(of, value, scope)
                elif isinstance(owner, Matrix):
                    self.write(of, Matrix(size=owner.size), scope)
            case _:
                pass

    def _write_name(
        self, target: tree.Name, value: Value, scope: Scope, written: Expression | None
    ) -> None:
        variable, before = self.declared.get(target.name), scope.find(target.name)
        if isinstance(before, Record) and not isinstance(value, Record):
            return
        type_ = variable.type if variable is not None else ""
        if not type_ and isinstance(before, Vector):
            type_ = f"vec{before.size}"
        if not type_ and isinstance(before, Scalar):
            type_ = "float"
        told = Variable(target.span, target.name, type_, initial=written)
        scope.write(target.name, self.named(value, told))

    def _member(self, expression: tree.Member, scope: Scope) -> Value:
        owner = self.value(expression.of, scope)
        name = expression.name
        if isinstance(owner, Record):
            return self.field(owner, name)
        if isinstance(owner, Vector):
            return swizzled(owner, name)
        if isinstance(owner, Matrix):
            return Scalar() if name.startswith("_m") else ANYTHING
        return ANYTHING

    def _called(self, call: tree.Call, scope: Scope) -> Value:
        arguments = [self.value(one, scope) for one in call.arguments]
        name = call.function
        if name in self.functions:
            return self._user_call(call, arguments, scope)
        known = FUNCTIONS.get(name)
        if isinstance(known, Giving):
            return known.value
        if isinstance(known, Moving) and arguments and isinstance(arguments[0], Vector):
            vector = replace(arguments[0], w=known.w, size=4)
            found = self.judge.carried(call, known.matrix, vector)
            size = 4 if known.matrix.has_projection else 3
            return replace(
                found,
                size=size,
                length=Length.UNIT if known.is_unit else None,
                w=found.w if size == 4 else None,
            )
        intrinsic = INTRINSICS.get(name)
        if intrinsic is not None:
            return intrinsic(self, call, arguments)
        if name in self.structs:
            return self._constructed(name, arguments)
        return ANYTHING

    def _constructed(self, name: str, arguments: list[Value]) -> Value:
        fields = self.structs[name].fields
        if len(fields) != len(arguments):
            return Record(name, "", ())
        pairs = zip((one.name for one in fields), arguments, strict=True)
        return Record(name, "", tuple(sorted(pairs)))

    def _user_call(self, call: tree.Call, arguments: list[Value], scope: Scope) -> Value:
        found: Value | None = None
        for function in self.functions[call.function]:
            if len(function.parameters) != len(arguments):
                continue
            is_too_much = (
                self.calls[function.name] >= MOST_CALLS * len(self.functions[call.function])
                or function.name in self.running
                or len(self.running) >= DEEPEST_CALLS
            )
            if is_too_much:
                return self.by_name("", function.type, Storage.LOCAL) if function.type else ANYTHING
            value = self._call_one(function, call, arguments, scope)
            found = value if found is None else joined(found, value)
        return ANYTHING if found is None else found

    def _call_one(
        self, function: Function, call: tree.Call, arguments: list[Value], scope: Scope
    ) -> Value:
        inner = Scope(self._bottom(scope))
        for parameter, given in zip(function.parameters, arguments, strict=True):
            value = given
            if parameter.storage is not Storage.OUTPUT:
                value = self.named(given, replace(parameter, initial=None))
            inner.write(parameter.name, value)
        found = self.run(function, inner)
        for parameter, written in zip(function.parameters, call.arguments, strict=True):
            if parameter.storage in (Storage.OUTPUT, Storage.BOTH):
                left = inner.find(parameter.name)
                if left is not None:
                    self.write(written, left, scope)
        self.keep_globals(function, inner, scope)
        return found

    def keep_globals(self, function: Function, inner: Scope, outer: Scope) -> None:
        """Let what a function wrote to globals be seen by those that come after it."""
        own = {one.name for one in function.parameters}
        for name, value in inner.values.items():
            if name in self.declared and name not in own:
                outer.write(name, value)

    def _bottom(self, scope: Scope) -> Scope:
        """Keep what a called function sees: the globals, as they are written by now."""
        seen = Scope()
        layers = []
        one: Scope | None = scope
        while one is not None:
            layers.append(one)
            one = one.below
        for layer in reversed(layers):
            if layer is self.globals:
                seen.below = layer
                continue
            for name, value in layer.values.items():
                if name in self.declared:
                    seen.write(name, value)
        return seen


def _with_components(owner: Vector, name: str, value: Value) -> Vector | None:
    """Write some components of a vector; None where nothing was known and nothing is."""
    if name in ("xyz", "rgb"):
        if not isinstance(value, Vector):
            return None
        return replace(value, size=max(owner.size, 3), w=owner.w if owner.size == 4 else None)
    if owner.kind is None:
        return None
    if name in ("w", "a"):
        return replace(owner, w=FOURTHS.get(value.number) if isinstance(value, Scalar) else None)
    return replace(owner, w=None, length=None, via=None)


def _is_unknown(value: Value) -> bool:
    return isinstance(value, Vector) and value.kind is None


def compares(condition: Expression) -> bool:
    """Whether a condition compares numbers, so that it may keep a negative one out."""
    match condition:
        case tree.Binary(operator="<" | ">" | "<=" | ">="):
            return True
        case tree.Binary(left=left, right=right):
            return compares(left) or compares(right)
        case tree.Unary(operand=operand):
            return compares(operand)
    return False


def _is_zero(expression: Expression) -> bool:
    match expression:
        case tree.Number(value=value):
            return value == 0
        case tree.Call(function=name, arguments=arguments):
            return name.startswith("vec") and bool(arguments) and all(map(_is_zero, arguments))
    return False


def _is_half(expression: Expression) -> bool:
    match expression:
        case tree.Number(value=value):
            return value == 0.5
        case tree.Call(function=name, arguments=arguments):
            return name.startswith("vec") and bool(arguments) and all(map(_is_half, arguments))
    return False


def _halved(expression: Expression) -> Expression | None:
    """Find what is halved, if a product is that."""
    match expression:
        case tree.Binary(operator="*" | ".*", left=left, right=right):
            if _is_half(left):
                return right
            return left if _is_half(right) else None
        case tree.Binary(operator="/", left=left, right=tree.Number(value=2.0)):
            return left
    return None


def _is_w_of(division: tree.Binary, divided: Value) -> bool:
    if division.operator != "/" or not isinstance(divided, Vector):
        return False
    match division.right:
        case tree.Member(name=name):
            return name in ("w", "a", "q", "z")
    return divided.w is Fourth.DEPTH
