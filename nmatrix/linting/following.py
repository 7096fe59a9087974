"""A shader is followed as it runs: from its declarations through its statements to its outputs.

Each loop is followed once, and of branches that part what they leave in common goes on.
"""

from __future__ import annotations

from dataclasses import dataclass, field

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.declarations import Conventions, Scope
from nmatrix.linting.evaluation import Evaluation, compares
from nmatrix.linting.judging import Judge
from nmatrix.linting.tree import (
    Function,
    Shader,
    Stage,
    Storage,
    Variable,
    is_matrix,
    is_vector,
)
from nmatrix.linting.values import (
    ANYTHING,
    Because,
    Matrix,
    Record,
    Value,
    Vector,
    joined,
    spoken,
)


@dataclass
class Passed:
    """What a vertex shader hands on, by the ways in which a fragment shader may name it."""

    values: dict[str, Value] = field(default_factory=dict)

    def put(self, key: str, value: Value) -> None:
        """Hand a value on; one that was there already is joined with it."""
        before = self.values.get(key)
        self.values[key] = value if before is None else joined(before, value)


class Following(Evaluation):
    """One shader of a program."""

    def __init__(
        self, shader: Shader, judge: Judge, passed: Passed, conventions: Conventions
    ) -> None:
        super().__init__(shader, judge, conventions)
        self.passed = passed
        self.returned: list[list[Value]] = []
        self.spaces: dict[str, tuple[str, str]] = {}

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
        if self.shader.language is ShaderLanguage.GLSL:
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
            is_entry = is_staged and self.shader.language is ShaderLanguage.HLSL
            scope.write(parameter.name, self._parameter(parameter, is_of_entry=is_entry))
        value = self.run(function, scope)
        self.keep_globals(function, scope, self.globals)
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

    def _declared(self, variable: Variable) -> Value:
        """Read a variable outside of functions, before anything is written to it."""
        is_between = self.stage in (Stage.FRAGMENT, Stage.BETWEEN)
        if is_between and variable.storage in (Storage.INPUT, Storage.BOTH):
            handed = next(
                (self.passed.values[key] for key in _keys(variable) if key in self.passed.values),
                None,
            )
            if handed is not None and handed is not ANYTHING:
                return self.interpolated(handed, variable)
        if variable.initial is not None and variable.storage is Storage.LOCAL:
            return self.named(self.value(variable.initial, self.globals), variable)
        found = self.by_name(variable.name, variable.type, variable.storage, variable.note)
        return self.interpolated(found, variable) if is_between else found

    def _parameter(self, variable: Variable, *, is_of_entry: bool) -> Value:
        handed = self.passed.values.get(f"type {variable.type}")
        if self.stage is Stage.FRAGMENT and is_of_entry:
            if handed is None and variable.semantic:
                handed = self.passed.values.get(f"semantic {variable.semantic}")
            if handed is not None:
                return self.interpolated(handed, variable)
        storage = variable.storage if is_of_entry else Storage.LOCAL
        found = self.by_name(variable.name, variable.type, storage, variable.note)
        is_between = is_of_entry and self.stage is Stage.FRAGMENT
        return self.interpolated(found, variable) if is_between else found

    def run(self, function: Function, scope: Scope) -> Value:
        """Follow the statements of a function; its value is what all its returns have in common."""
        self.calls[function.name] += 1
        self.running.append(function.name)
        self.returned.append([])
        for statement in function.body:
            self._do(statement, scope)
        values = self.returned.pop()
        self.running.pop()
        if not values:
            return self.by_name("", function.type, Storage.LOCAL) if function.type else ANYTHING
        found = values[0]
        for other in values[1:]:
            found = joined(found, other)
        return found

    def _do(self, statement: tree.Statement, scope: Scope) -> None:
        match statement:
            case tree.Declaration(variables):
                for one in variables:
                    self._declare(one, scope)
            case tree.Evaluated(expression):
                self.value(expression, scope)
            case tree.Return(value):
                if value is not None:
                    self.returned[-1].append(self.value(value, scope))
            case tree.Choice():
                self._choose(statement, scope)
            case tree.Loop(condition, body):
                if condition is not None:
                    self.value(condition, scope)
                self._join(scope, [self._branch(body, scope), Scope(scope)])

    def _declare(self, variable: Variable, scope: Scope) -> None:
        if variable.is_array:
            self.arrays.add(variable.name)
        if variable.initial is None:
            value = self.by_name(variable.name, variable.type, Storage.LOCAL, variable.note)
        else:
            value = self.named(self.value(variable.initial, scope), variable)
            if isinstance(value, Matrix) and self.is_given(variable.initial):
                self.given.add(variable.name)
        scope.write(variable.name, value)

    def _choose(self, choice: tree.Choice, scope: Scope) -> None:
        if choice.condition is not None:
            self.value(choice.condition, scope)
        branches = []
        was_gated = self.judge.is_gated
        self.judge.is_gated |= choice.condition is not None and compares(choice.condition)
        for place, body in enumerate(choice.branches):
            above = Scope(scope)
            if place == 0 and choice.condition is not None:
                self.clamp(choice.condition, above, is_true=True)
            branches.append(self._branch(body, above))
        self.judge.is_gated = was_gated
        self._join(
            scope,
            [one for one, body in zip(branches, choice.branches, strict=True) if not _leaves(body)],
        )
        if choice.condition is not None and choice.branches and _leaves(choice.branches[0]):
            self.clamp(choice.condition, scope, is_true=False)

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


def _keys(variable: Variable) -> list[str]:
    keys = []
    if variable.location is not None:
        keys.append(f"location {variable.location}")
    if not (is_vector(variable.type) or is_matrix(variable.type) or variable.type == "float"):
        keys.append(f"type {variable.type}")
    keys.append(f"name {variable.name}")
    return keys


def _leaves(body: tuple[tree.Statement, ...]) -> bool:
    return bool(body) and isinstance(body[-1], tree.Return)
