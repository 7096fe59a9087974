"""Expressions become values: names are looked up, operators judged, functions followed.

Each function is followed for a few calls only, so that the work grows with the length of the source
and with nothing else.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections import Counter
from dataclasses import dataclass, replace

from nmatrix.lint import tree
from nmatrix.lint.algebra import FOURTHS, negated, swizzled
from nmatrix.lint.builtins import FIELDS, FUNCTIONS, STRUCTS, Giving, Moving, built_in
from nmatrix.lint.intrinsics import INTRINSICS
from nmatrix.lint.judging import Judge
from nmatrix.lint.names import annotated, matrix_named, meaning, vector_named
from nmatrix.lint.tree import (
    Expression,
    Function,
    Language,
    Shader,
    Stage,
    Storage,
    Variable,
    is_matrix,
    is_vector,
)
from nmatrix.lint.values import (
    ANYTHING,
    Because,
    Carried,
    Fourth,
    Length,
    Matrix,
    Record,
    Role,
    Scalar,
    ShaderSpace,
    Value,
    Vector,
    joined,
)

MOST_CALLS = 8  # of one function that are followed
MOST_MACROS = 256  # uses of one macro
DEEPEST_CALLS = 24


class Scope:
    """Names with their values; what a branch writes stays above what was there before."""

    def __init__(self, below: Scope | None = None) -> None:
        self.values: dict[str, Value] = {}
        self.below = below

    def find(self, name: str) -> Value | None:
        """Find the value that was written last."""
        scope: Scope | None = self
        while scope is not None:
            found = scope.values.get(name)
            if found is not None:
                return found
            scope = scope.below
        return None

    def write(self, name: str, value: Value) -> None:
        """Write a value."""
        self.values[name] = value


@dataclass(frozen=True, slots=True)
class Conventions:
    """How named matrices stand: for columns, for rows (True), or nobody knows (None).

    A projection right before `model` without any view matrix: `model` leads nobody knows where.
    """

    named_are_transposed: bool | None = False
    model_leads_elsewhere: bool = False


class Evaluation(ABC):
    """The expressions of one shader."""

    def __init__(self, shader: Shader, judge: Judge, conventions: Conventions) -> None:
        self.shader = shader
        self.judge = judge
        self.conventions = conventions
        self.stage = shader.stage
        self.structs = {one.name: one for one in (*STRUCTS, *shader.structs)}
        self.functions: dict[str, list[Function]] = {}
        for one in shader.functions:
            self.functions.setdefault(one.name, []).append(one)
        self.declared = {one.name: one for one in shader.variables}
        self.arrays = {
            parameter.name
            for function in shader.functions
            for parameter in function.parameters
            if parameter.is_array
        }
        self.globals = Scope()
        self.given: set[str] = set()  # locals that are made of uniforms alone
        self.calls: Counter[str] = Counter()
        self.running: list[str] = []

    @abstractmethod
    def run(self, function: Function, scope: Scope) -> Value:
        """Follow the statements of a function; its value is what it returns."""

    # Names.

    def by_name(self, path: str, type_: str, storage: Storage, note: str = "") -> Value:
        if type_ in self.structs:
            return Record(type_, path, ())
        if type_ == "float":
            return Scalar()
        found = built_in(path, self.stage) if path.startswith(("gl_", "unity_", "_World")) else None
        if found is None:
            found = meaning(path, type_, storage, self.stage)
        if note:
            size = int(type_[-1]) if type_[-1:].isdigit() else 0
            found = annotated(note, found, size)
        if isinstance(found, Matrix):
            return self._as_convened(found)
        if isinstance(found, Vector) and found.role is Role.LIGHT and found.space is None:
            known = self.judge.evidence.lights.get(path)
            if known is not None:
                found = replace(found, space=known, because=Because.ARITHMETIC)
        if isinstance(found, Vector) and not found.origin:
            found = replace(found, origin=path)
        return found

    def _as_convened(self, matrix: Matrix) -> Matrix:
        if matrix.because is not Because.NAME:
            return matrix
        if self.conventions.named_are_transposed is None:
            return Matrix(size=matrix.size, because=Because.NAME)
        if self.conventions.model_leads_elsewhere:
            matrix = replace(
                matrix, to=_unless_world(matrix.to), source=_unless_world(matrix.source)
            )
        return matrix.transposed if self.conventions.named_are_transposed else matrix

    def named(self, value: Value, variable: Variable) -> Value:
        """Let the name of a local say what its value leaves open."""
        type_ = variable.type
        if variable.note:
            size = int(type_[-1]) if type_[-1:].isdigit() else 0
            value = annotated(variable.note, value, size)
        if is_vector(type_) and not isinstance(value, Vector):
            value = Vector(size=int(type_[-1]))
        if isinstance(value, Vector):
            told = vector_named(variable.name, type_, Storage.LOCAL, self.stage)
            value = self._judged_eye(variable, told, value)
            if value.kind is None:
                return replace(told, length=value.length, is_assumed=False)
            return value
        if is_matrix(type_) and not isinstance(value, Matrix):
            return self.by_name(variable.name, type_, Storage.LOCAL)
        if isinstance(value, Matrix) and is_matrix(type_):
            if not value.is_known and value.to is None and value.source is None:
                named = self.by_name(variable.name, type_, Storage.LOCAL)
                return named if isinstance(named, Matrix) else value
            return replace(value, size=min(value.size, int(type_[-1])))
        if type_ in self.structs and not isinstance(value, Record):
            return Record(type_, variable.name, ())
        if type_ == "float" and not isinstance(value, Scalar):
            return Scalar()
        return value

    def _judged_eye(self, variable: Variable, told: Vector, value: Vector) -> Vector:
        is_eye = told.role is Role.EYE and told.kind is Carried.DIRECTION
        if not is_eye or value.role is not Role.ORIGIN or variable.initial is None:
            return value
        is_sure = value.because is Because.ARITHMETIC
        if is_sure and self.judge.space_of(value) is not None:
            self.judge.tell_origin(variable.initial, value)
            return replace(value, role=Role.EYE, space=None)
        return value

    def clamp(self, condition: Expression, scope: Scope, *, is_true: bool) -> None:
        """Believe a comparison with zero: what it says is positive is so from here on."""
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

    def interpolated(self, value: Value, variable: Variable) -> Value:
        """Take a value as a fragment gets it: a normal is short of 1 between vertices."""
        is_input = variable.storage in (Storage.INPUT, Storage.BOTH)
        if isinstance(value, Record):
            fields = tuple((name, self._field_between(one, name)) for name, one in value.fields)
            return Record(value.type, value.path, fields)
        if not isinstance(value, Vector) or not is_input:
            return value
        value = replace(value, via=None, origin=variable.name)
        if value.kind is Carried.NORMAL and not variable.is_flat:
            return replace(value, length=Length.INTERPOLATED)
        return replace(value, length=None)

    def _field_between(self, value: Value, name: str) -> Value:
        return self.interpolated(value, Variable(tree.Span("", 0, 0), name, "", Storage.INPUT))

    # Expressions.

    def value(self, expression: Expression, scope: Scope) -> Value:
        """Evaluate an expression."""
        match expression:
            case tree.Name(name=name):
                return self._variable(name, scope)
            case tree.Number(value=number):
                return Scalar(number=number, is_clamped=number >= 0)
            case tree.Unary(operator=sign, operand=operand):
                value = self.value(operand, scope)
                return negated(value) if sign == "-" else value
            case tree.Unread():
                return ANYTHING
            case _:
                return self._composed(expression, scope)

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
        if self._typed(expression.of, scope)[1]:
            return value
        if isinstance(value, Matrix):
            return Vector(size=value.size)  # a column
        return Scalar() if isinstance(value, Vector) else value

    def is_given(self, expression: Expression) -> bool:
        """Whether a value is the same for all vertices or fragments, made of uniforms alone."""
        match expression:
            case tree.Name(name=name):
                variable = self.declared.get(name)
                if variable is not None:
                    return variable.storage is Storage.UNIFORM
                return name in self.given or built_in(name, self.stage) is not None
            case tree.Member(of=of):
                return self.is_given(of)
            case tree.Call(function=name, arguments=arguments):
                is_known = is_matrix(name) or is_vector(name) or name in ("transpose", "inverse")
                return is_known and all(map(self.is_given, arguments))
            case tree.Binary(left=left, right=right):
                return self.is_given(left) and self.is_given(right)
            case tree.Number():
                return True
        return False

    def _typed(self, expression: Expression, scope: Scope) -> tuple[str, bool]:
        """The struct of an expression, if it is of one, and whether it is an array."""
        match expression:
            case tree.Name(name=name):
                variable = self.declared.get(name)
                value = scope.find(name)
                type_ = value.type if isinstance(value, Record) else ""
                is_array = name in self.arrays or (variable is not None and variable.is_array)
                return type_, is_array
            case tree.Member(of=of, name=name):
                struct = self.structs.get(self._typed(of, scope)[0])
                for one in struct.fields if struct is not None else ():
                    if one.name == name:
                        return one.type, one.is_array
            case tree.Element(of=of):
                return self._typed(of, scope)
            case _:
                pass
        return "", False

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
                return self._as_convened(named)
        if name in FIELDS:
            return Record(name, name, ())
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
                return self.judge.added(expression, left, right)
            case _:
                return Scalar()

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
            if operator == "*" and self.shader.language is Language.HLSL:
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
            return self._field(owner, name)
        if isinstance(owner, Vector):
            return swizzled(owner, name)
        if isinstance(owner, Matrix):
            return Scalar() if name.startswith("_m") else ANYTHING
        return ANYTHING

    def _field(self, owner: Record, name: str) -> Value:
        given = owner.field(name)
        if given is not None:
            return given
        known = FIELDS.get(owner.type, {}).get(name)
        if known is not None:
            return known
        struct = self.structs.get(owner.type)
        declared = None
        if struct is not None:
            declared = next((one for one in struct.fields if one.name == name), None)
        if declared is None:
            return ANYTHING
        storage = Storage.LOCAL
        variable = self.declared.get(owner.path)
        if variable is not None:
            storage = variable.storage
        elif self.shader.language is Language.HLSL and self.stage is Stage.VERTEX:
            semantic = declared.semantic.rstrip("0123456789")
            is_mesh = semantic in ("POSITION", "NORMAL", "TANGENT", "BINORMAL")
            if is_mesh or owner.type.startswith("appdata"):
                storage = Storage.INPUT
        is_between = self.stage in (Stage.FRAGMENT, Stage.BETWEEN)
        path = f"{owner.path}.{name}" if owner.path and storage is not Storage.INPUT else name
        found = self.by_name(path, declared.type, storage, declared.note)
        if is_between and storage is Storage.INPUT:
            return self._field_between(found, name)
        if is_between and variable is None and declared.semantic:
            return self._field_between(found, name)
        return found

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
                value = inner.find(parameter.name)
                if value is not None:
                    self.write(written, value, scope)
        self.keep_globals(function, inner, scope)
        return found

    def keep_globals(self, function: Function, inner: Scope, outer: Scope) -> None:
        """Let what a function wrote to globals be seen by those that come after it."""
        own = {one.name for one in function.parameters}
        for name, value in inner.values.items():
            if name in self.declared and name not in own:
                outer.write(name, value)

    def _bottom(self, scope: Scope) -> Scope:
        """What a called function sees: the globals, as they are written by now."""
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


def _unless_world(space: ShaderSpace | None) -> ShaderSpace | None:
    return None if space is ShaderSpace.WORLD else space


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
