"""A program is followed as it runs: values go from declarations through statements and calls.

Each function is followed for a few calls only and each loop once, so that the work grows with the
length of the source and with nothing else.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field, replace

from nmatrix.lint import tree
from nmatrix.lint.builtins import FIELDS, FUNCTIONS, STRUCTS, Giving, Moving, built_in
from nmatrix.lint.judging import Judge, negated
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
    spoken,
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


@dataclass
class Passed:
    """What a vertex shader hands on, by the ways in which a fragment shader may name it."""

    values: dict[str, Value] = field(default_factory=dict)

    def put(self, key: str, value: Value) -> None:
        """Hand a value on; one that was there already is joined with it."""
        before = self.values.get(key)
        self.values[key] = value if before is None else joined(before, value)


@dataclass(frozen=True, slots=True)
class Conventions:
    """How named matrices stand: for columns, for rows (True), or nobody knows (None).

    A projection right before `model` without any view matrix: `model` leads nobody knows where.
    """

    named_are_transposed: bool | None = False
    model_leads_elsewhere: bool = False


class Following:
    """One shader of a program."""

    def __init__(
        self, shader: Shader, judge: Judge, passed: Passed, conventions: Conventions
    ) -> None:
        self.shader = shader
        self.judge = judge
        self.passed = passed
        self.conventions = conventions
        self.structs = {one.name: one for one in (*STRUCTS, *shader.structs)}
        self.functions: dict[str, list[Function]] = {}
        for one in shader.functions:
            self.functions.setdefault(one.name, []).append(one)
        self.declared = {one.name: one for one in shader.variables}
        self.globals = Scope()
        self.calls: Counter[str] = Counter()
        self.arrays = {
            parameter.name
            for function in shader.functions
            for parameter in function.parameters
            if parameter.is_array
        }
        self.given: set[str] = set()
        self.running: list[str] = []
        self.returned: list[list[Value]] = []
        self.spaces: dict[str, tuple[str, str]] = {}
        self.stage = shader.stage

    # The whole shader.

    def follow(self) -> None:
        """Follow every function: the first ones first, then those that nobody called."""
        self.judge.stage = self.stage
        for variable in self.shader.variables:
            self.globals.write(variable.name, self._declared(variable))
        entries = sorted(self.shader.functions, key=self._turn)
        for function in entries:
            if function.name != "main" and self.calls[function.name]:
                continue
            self._enter(function)
        for variable in self.shader.variables:
            self._hand_on(variable)
            self._note_space(variable)

    def _turn(self, function: Function) -> int:
        if function.name == "main":
            return 0
        stage = self._stage_of(function)
        return {Stage.VERTEX: 1, Stage.BETWEEN: 2, Stage.FRAGMENT: 3}.get(stage, 4)

    def _stage_of(self, function: Function) -> Stage:
        """Tell by what a function of HLSL returns in which stage it is an entry."""
        if self.shader.language is Language.GLSL:
            return self.shader.stage
        struct = self.structs.get(function.type)
        semantics = {function.semantic} | {
            one.semantic for one in (struct.fields if struct is not None else ())
        }
        semantics |= {one.semantic for one in function.parameters if one.storage is Storage.OUTPUT}
        if any(one.startswith(("SV_TARGET", "COLOR")) for one in (function.semantic,)) or any(
            one.startswith("SV_TARGET") for one in semantics
        ):
            return Stage.FRAGMENT
        if semantics & {"SV_POSITION", "POSITION", "POSITION0"}:
            return Stage.VERTEX
        return Stage.UNKNOWN

    def _enter(self, function: Function) -> None:
        """Follow an entry, or a function that only other files call."""
        stage = self._stage_of(function)
        self.judge.stage = self.stage = stage
        scope = Scope(self.globals)
        for parameter in function.parameters:
            is_staged = stage in (Stage.VERTEX, Stage.FRAGMENT)
            is_entry = is_staged and self.shader.language is Language.HLSL
            scope.write(parameter.name, self._parameter(parameter, is_of_entry=is_entry))
        value = self._run(function, scope)
        self._keep_globals(function, scope, self.globals)
        if stage is Stage.VERTEX and isinstance(value, Record):
            self.passed.put(f"type {value.type}", value)
            self._hand_on_fields(value)
        self.judge.stage = self.stage = self.shader.stage

    def _hand_on_fields(self, record: Record) -> None:
        struct = self.structs.get(record.type)
        for one in struct.fields if struct is not None else ():
            value = record.field(one.name)
            if value is not None and one.semantic:
                self.passed.put(f"semantic {one.semantic}", value)

    def _hand_on(self, variable: Variable) -> None:
        is_out = variable.storage in (Storage.OUTPUT, Storage.BOTH)
        if self.shader.stage not in (Stage.VERTEX, Stage.BETWEEN) or not is_out:
            return
        value = self.globals.find(variable.name)
        if value is None:
            return
        for key in _keys(variable):
            self.passed.put(key, value)

    def _note_space(self, variable: Variable) -> None:
        if variable.storage is Storage.LOCAL:
            return
        value = self.globals.find(variable.name)
        if isinstance(value, Vector) and value.kind is not None and value.space is not None:
            known = spoken(value.space)
        elif isinstance(value, Matrix) and value.is_known:
            known = value.told
        else:
            return
        self.spaces[variable.name] = known, str(value.because or Because.ARITHMETIC)

    # Declarations.

    def _declared(self, variable: Variable) -> Value:
        """The value of a variable outside of functions before anything is written to it."""
        is_between = self.stage in (Stage.FRAGMENT, Stage.BETWEEN)
        if is_between and variable.storage in (Storage.INPUT, Storage.BOTH):
            handed = next(
                (self.passed.values[key] for key in _keys(variable) if key in self.passed.values),
                None,
            )
            if handed is not None and handed is not ANYTHING:
                return self._interpolated(handed, variable)
        if variable.initial is not None and variable.storage is Storage.LOCAL:
            return self._named(self._value(variable.initial, self.globals), variable)
        found = self._by_name(variable.name, variable.type, variable.storage, variable.note)
        return self._interpolated(found, variable) if is_between else found

    def _interpolated(self, value: Value, variable: Variable) -> Value:
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
        return self._interpolated(value, Variable(tree.Span("", 0, 0), name, "", Storage.INPUT))

    def _parameter(self, variable: Variable, *, is_of_entry: bool) -> Value:
        handed = self.passed.values.get(f"type {variable.type}")
        if self.stage is Stage.FRAGMENT and is_of_entry:
            if handed is None and variable.semantic:
                handed = self.passed.values.get(f"semantic {variable.semantic}")
            if handed is not None:
                return self._interpolated(handed, variable)
        storage = variable.storage if is_of_entry else Storage.LOCAL
        found = self._by_name(variable.name, variable.type, storage, variable.note)
        is_between = is_of_entry and self.stage is Stage.FRAGMENT
        return self._interpolated(found, variable) if is_between else found

    def _by_name(self, path: str, type_: str, storage: Storage, note: str = "") -> Value:
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

    def _named(self, value: Value, variable: Variable) -> Value:
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
            return self._by_name(variable.name, type_, Storage.LOCAL)
        if isinstance(value, Matrix) and is_matrix(type_):
            if not value.is_known and value.to is None and value.source is None:
                named = self._by_name(variable.name, type_, Storage.LOCAL)
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

    # Statements.

    def _run(self, function: Function, scope: Scope) -> Value:
        self.calls[function.name] += 1
        self.running.append(function.name)
        self.returned.append([])
        for statement in function.body:
            self._do(statement, scope)
        values = self.returned.pop()
        self.running.pop()
        if not values:
            return self._by_name("", function.type, Storage.LOCAL) if function.type else ANYTHING
        found = values[0]
        for other in values[1:]:
            found = joined(found, other)
        return found

    def _do(self, statement: tree.Statement, scope: Scope) -> None:
        match statement:
            case tree.Declaration(variables):
                for one in variables:
                    if one.is_array:
                        self.arrays.add(one.name)
                    if one.initial is None:
                        value = self._by_name(one.name, one.type, Storage.LOCAL, one.note)
                    else:
                        value = self._named(self._value(one.initial, scope), one)
                        if isinstance(value, Matrix) and self.is_given(one.initial):
                            self.given.add(one.name)
                    scope.write(one.name, value)
            case tree.Evaluated(expression):
                self._value(expression, scope)
            case tree.Return(value):
                if value is not None:
                    self.returned[-1].append(self._value(value, scope))
            case tree.Choice():
                self._choose(statement, scope)
            case tree.Loop(condition, body):
                if condition is not None:
                    self._value(condition, scope)
                self._join(scope, [self._branch(body, scope), Scope(scope)])

    def _choose(self, choice: tree.Choice, scope: Scope) -> None:
        if choice.condition is not None:
            self._value(choice.condition, scope)
        branches = []
        was_gated = self.judge.is_gated
        self.judge.is_gated |= choice.condition is not None and _compares(choice.condition)
        for place, body in enumerate(choice.branches):
            above = Scope(scope)
            if place == 0 and choice.condition is not None:
                self._clamp(choice.condition, above, is_true=True)
            branches.append(self._branch(body, above))
        self.judge.is_gated = was_gated
        self._join(
            scope,
            [one for one, body in zip(branches, choice.branches, strict=True) if not _leaves(body)],
        )
        if choice.condition is not None and choice.branches and _leaves(choice.branches[0]):
            self._clamp(choice.condition, scope, is_true=False)

    def _branch(self, body: tuple[tree.Statement, ...], scope: Scope) -> Scope:
        above = Scope(scope)
        for statement in body:
            self._do(statement, above)
        return above

    def _join(self, scope: Scope, branches: list[Scope]) -> None:
        written = {name for one in branches for name in one.values}
        for name in written:
            values = [one.find(name) for one in branches]
            known = [one for one in values if one is not None]
            found = known[0]
            for other in known[1:]:
                found = joined(found, other)
            scope.write(name, found)

    def _clamp(self, condition: Expression, scope: Scope, *, is_true: bool) -> None:
        """Believe a comparison with zero: what it says is positive is so from here on."""
        match condition:
            case tree.Binary(operator="&&", left=left, right=right) if is_true:
                self._clamp(left, scope, is_true=True)
                self._clamp(right, scope, is_true=True)
            case tree.Binary(operator="||", left=left, right=right) if not is_true:
                self._clamp(left, scope, is_true=False)
                self._clamp(right, scope, is_true=False)
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

    def _value(self, expression: Expression, scope: Scope) -> Value:
        match expression:
            case tree.Name(name=name):
                return self._variable(name, scope)
            case tree.Number(value=number):
                return Scalar(number=number, is_clamped=number >= 0)
            case tree.Binary():
                return self._operated(expression, scope)
            case tree.Unary(operator=sign, operand=operand):
                value = self._value(operand, scope)
                return negated(value) if sign == "-" else value
            case tree.Call():
                return self._called(expression, scope)
            case tree.Member():
                return self._member(expression, scope)
            case tree.Element(of=of, index=index):
                self._value(index, scope)
                value = self._value(of, scope)
                if self._typed(of, scope)[1]:
                    return value
                if isinstance(value, Matrix):
                    return Vector(size=value.size)  # a column
                return Scalar() if isinstance(value, Vector) else value
            case tree.Conditional():
                return self._conditional(expression, scope)
            case tree.Assignment():
                return self._assigned(expression, scope)
            case _:
                return ANYTHING

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
            value = self._value(macro, scope)
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
        left = self._value(expression.left, scope)
        right = self._value(expression.right, scope)
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
        self._value(expression.condition, scope)
        above = Scope(scope)
        self._clamp(expression.condition, above, is_true=True)
        was_gated = self.judge.is_gated
        self.judge.is_gated |= _compares(expression.condition)
        chosen = self._value(expression.chosen, above)
        otherwise = self._value(expression.otherwise, scope)
        self.judge.is_gated = was_gated
        return joined(chosen, otherwise)

    def _assigned(self, expression: tree.Assignment, scope: Scope) -> Value:
        value = self._value(expression.value, scope)
        operator = expression.operator.removesuffix("=")
        if operator:
            before = self._value(expression.target, scope)
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
        self._write(expression.target, value, scope, expression.value)
        return value

    def _write(
        self, target: Expression, value: Value, scope: Scope, written: Expression | None = None
    ) -> None:
        match target:
            case tree.Name(name=name):
                variable = self.declared.get(name)
                scope_value = scope.find(name)
                if isinstance(scope_value, Record) and not isinstance(value, Record):
                    return
                type_ = variable.type if variable is not None else ""
                if not type_ and isinstance(scope_value, Vector):
                    type_ = f"vec{scope_value.size}"
                if not type_ and isinstance(scope_value, Scalar):
                    type_ = "float"
                span = target.span
                value = self._named(value, Variable(span, name, type_, initial=written))
                self._home(name, scope).write(name, value)
            case tree.Member(of=of, name=name):
                owner = self._value(of, scope)
                if isinstance(owner, Record):
                    self._write(of, owner.with_field(name, value), scope)
                elif isinstance(owner, Vector) and name in ("xyz", "rgb"):
                    if isinstance(value, Vector):
                        kept = owner.w if owner.size == 4 else None
                        value = replace(value, size=max(owner.size, 3), w=kept)
                        self._write(of, value, scope)
                elif isinstance(owner, Vector) and owner.kind is not None:
                    changed = replace(owner, w=None, length=None, via=None)
                    if name in ("w", "a"):
                        number = value.number if isinstance(value, Scalar) else None
                        fourth = {0.0: Fourth.ZERO, 1.0: Fourth.ONE}.get(number)  # type: ignore[arg-type]
                        changed = replace(owner, w=fourth)
                    self._write(of, changed, scope)
            case tree.Element(of=of):
                owner = self._value(of, scope)
                if isinstance(owner, Vector) and isinstance(value, Vector):
                    self._write(of, value, scope)
                elif isinstance(owner, Matrix):
                    self._write(of, Matrix(size=owner.size), scope)
            case _:
                pass

    def _home(self, name: str, scope: Scope) -> Scope:
        """The scope to write in: outputs and globals stay visible to all functions."""
        return scope

    def _member(self, expression: tree.Member, scope: Scope) -> Value:
        owner = self._value(expression.of, scope)
        name = expression.name
        if isinstance(owner, Record):
            return self._field(owner, name)
        if isinstance(owner, Vector):
            return _swizzled(owner, name)
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
        found = self._by_name(path, declared.type, storage, declared.note)
        if is_between and storage is Storage.INPUT:
            return self._field_between(found, name)
        if is_between and variable is None and declared.semantic:
            return self._field_between(found, name)
        return found

    # Calls.

    def _called(self, call: tree.Call, scope: Scope) -> Value:
        arguments = [self._value(one, scope) for one in call.arguments]
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
        made = _CONSTRUCTORS.get(name)
        if made is not None:
            return made(self, call, arguments)
        worker = _WORKERS.get(name)
        if worker is not None:
            return worker(self, call, arguments)
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
                return (
                    self._by_name("", function.type, Storage.LOCAL) if function.type else ANYTHING
                )
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
                value = self._named(given, replace(parameter, initial=None))
            inner.write(parameter.name, value)
        found = self._run(function, inner)
        for parameter, written in zip(function.parameters, call.arguments, strict=True):
            if parameter.storage in (Storage.OUTPUT, Storage.BOTH):
                value = inner.find(parameter.name)
                if value is not None:
                    self._write(written, value, scope)
        self._keep_globals(function, inner, scope)
        return found

    def _keep_globals(self, function: Function, inner: Scope, outer: Scope) -> None:
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


def _unless_world(space: ShaderSpace | None) -> ShaderSpace | None:
    return None if space is ShaderSpace.WORLD else space


def _keys(variable: Variable) -> list[str]:
    keys = []
    if variable.location is not None:
        keys.append(f"location {variable.location}")
    if not (is_vector(variable.type) or is_matrix(variable.type) or variable.type == "float"):
        keys.append(f"type {variable.type}")
    keys.append(f"name {variable.name}")
    return keys


def _compares(condition: Expression) -> bool:
    match condition:
        case tree.Binary(operator="<" | ">" | "<=" | ">="):
            return True
        case tree.Binary(left=left, right=right):
            return _compares(left) or _compares(right)
        case tree.Unary(operand=operand):
            return _compares(operand)
    return False


def _leaves(body: tuple[tree.Statement, ...]) -> bool:
    return bool(body) and isinstance(body[-1], tree.Return)


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


def _swizzled(vector: Vector, name: str) -> Value:
    order = name.translate(str.maketrans("rgbastpq", "xyzwxyzw"))
    if len(name) == 1:
        return Scalar()
    if order == "xyz":
        is_lamp = vector.kind is Carried.POINT and vector.role is Role.LIGHT
        is_kept = vector.w is Fourth.DEPTH or (is_lamp and vector.w is Fourth.ZERO)
        return replace(vector, size=3, w=vector.w if is_kept else None)
    if order == "xyzw":
        return vector
    if len(order) == 2:
        w = vector.w if vector.w is Fourth.DEPTH and order == "xy" else None
        return Vector(size=2, w=w, space=vector.space if w is not None else None)
    return Vector(size=len(order))


def _made_vector(size: int, arguments: list[Value]) -> Value:
    if size == 2:
        return Vector(size=2)
    first = arguments[0] if arguments else ANYTHING
    if not isinstance(first, Vector):
        return Vector(size=size)
    if len(arguments) == 1:
        if first.size > size:
            return _swizzled(first, "xyz")
        return first if first.size == size else Vector(size=size)
    last = arguments[-1]
    if size == 4 and first.size == 3 and len(arguments) == 2:
        if not isinstance(last, Scalar):
            return replace(first, size=4, w=None)
        w = {0.0: Fourth.ZERO, 1.0: Fourth.ONE}.get(last.number)  # type: ignore[arg-type]
        return replace(first, size=4, w=w)
    return Vector(size=size)


def _made_matrix(size: int, arguments: list[Value]) -> Value:
    if len(arguments) == 1 and isinstance(arguments[0], Matrix):
        return replace(arguments[0], size=min(size, arguments[0].size))
    if len(arguments) == 3 and all(isinstance(one, Vector) for one in arguments):
        columns = [one for one in arguments if isinstance(one, Vector)]
        kinds = tuple(one.kind for one in columns)
        spaces = {one.space for one in columns if one.kind is not None}
        if kinds[-1] is Carried.NORMAL and Carried.TANGENT in kinds and len(spaces) == 1:
            space = spaces.pop()
            return Matrix(space, ShaderSpace.TANGENT, size=3, because=Because.ARITHMETIC)
    return Matrix(size=size)


_CONSTRUCTORS = {
    **{
        f"vec{size}": (lambda _, call, arguments, size=size: _made_vector(size, arguments))
        for size in (2, 3, 4)
    },
    **{
        f"mat{size}": (lambda _, call, arguments, size=size: _made_matrix(size, arguments))
        for size in (2, 3, 4)
    },
    "float": lambda _, call, arguments: (
        arguments[0] if arguments and isinstance(arguments[0], Scalar) else Scalar()
    ),
}


def _first_vector(arguments: list[Value]) -> Vector | None:
    return arguments[0] if arguments and isinstance(arguments[0], Vector) else None


def _two(arguments: list[Value]) -> tuple[Vector, Vector] | None:
    if len(arguments) >= 2:
        one, other = arguments[0], arguments[1]
        if isinstance(one, Vector) and isinstance(other, Vector):
            return one, other
    return None


def _normalize(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    one = _first_vector(arguments)
    return ANYTHING if one is None else self.judge.normalised(call, one)


def _dot(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Scalar() if pair is None else self.judge.dotted(call, *pair)


def _distance(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    if pair is not None:
        self.judge.meet(call, *pair)
    return Scalar(is_clamped=True)


def _cross(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Vector(size=3) if pair is None else self.judge.crossed(call, *pair)


def _reflect(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    return Vector(size=3) if pair is None else self.judge.reflected(call, *pair)


def _refract(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    pair = _two(arguments)
    if pair is None:
        return Vector(size=3)
    self.judge.meet(call, *pair)
    return Vector(Carried.DIRECTION, pair[0].space or pair[1].space, 3)


def _faceforward(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    return arguments[0] if arguments else ANYTHING


def _pow(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    return self.judge.powered(call, arguments[0]) if arguments else ANYTHING


def _transpose(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and isinstance(arguments[0], Matrix):
        return replace(arguments[0].transposed, because=Because.ARITHMETIC)
    return ANYTHING


def _inverse(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    if not arguments or not isinstance(arguments[0], Matrix):
        return ANYTHING
    is_given = self.is_given(call.arguments[0])
    return self.judge.inverted(call, arguments[0], is_given=is_given)


def _clamped(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and all(isinstance(one, Scalar) for one in arguments):
        is_cosine = any(isinstance(one, Scalar) and one.is_cosine for one in arguments)
        return Scalar(is_cosine, is_clamped=True)
    return Vector(size=_size(arguments))


def _smaller(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    if arguments and all(isinstance(one, Scalar) for one in arguments):
        numbers = [one for one in arguments if isinstance(one, Scalar)]
        return Scalar(any(one.is_cosine for one in numbers), all(one.is_clamped for one in numbers))
    return Vector(size=_size(arguments))


def _mixed(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    return joined(arguments[0], arguments[1]) if len(arguments) == 3 else ANYTHING


def _number(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    return Scalar(is_clamped=True) if _size(arguments) == 0 else Vector(size=_size(arguments))


def _texture(self: Following, call: tree.Call, arguments: list[Value]) -> Value:
    if len(arguments) > 1 and isinstance(arguments[1], Vector) and arguments[1].size < 4:
        self.judge.undivided(call, arguments[1], call.arguments[1])
    return Vector(size=4)


def _size(arguments: list[Value]) -> int:
    return max((one.size for one in arguments if isinstance(one, Vector)), default=0)


_WORKERS = {
    "normalize": _normalize,
    "dot": _dot,
    "distance": _distance,
    "cross": _cross,
    "reflect": _reflect,
    "refract": _refract,
    "faceforward": _faceforward,
    "pow": _pow,
    "transpose": _transpose,
    "inverse": _inverse,
    "max": _clamped,
    "clamp": _clamped,
    "saturate": _clamped,
    "abs": _clamped,
    "min": _smaller,
    "mix": _mixed,
    "length": _number,
    **dict.fromkeys(
        ["texture", "texture2D", "textureCube", "tex2D", "texCUBE", "tex2Dlod", "texture2DLod"],
        _texture,
    ),
}

Values = Mapping[str, Value]
