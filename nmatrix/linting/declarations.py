"""What declarations, names and comments say of values, under the conventions of the program."""

from __future__ import annotations

from dataclasses import dataclass, replace

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.builtins import FIELDS, STRUCTS, built_in
from nmatrix.linting.judging import Judge
from nmatrix.linting.names import annotated, meaning, vector_named
from nmatrix.linting.tree import (
    Expression,
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
    Carried,
    Length,
    Matrix,
    Record,
    Role,
    Scalar,
    ShaderSpace,
    Value,
    Vector,
)


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


class Declarations:
    """The declarations of one shader."""

    def __init__(self, shader: Shader, judge: Judge, conventions: Conventions) -> None:
        self.shader = shader
        self.judge = judge
        self.conventions = conventions
        self.stage = shader.stage
        self.structs = {one.name: one for one in (*STRUCTS, *shader.structs)}
        self.declared = {one.name: one for one in shader.variables}
        self.arrays = {
            parameter.name
            for function in shader.functions
            for parameter in function.parameters
            if parameter.is_array
        }
        self.given: set[str] = set()  # locals that are made of uniforms alone

    def by_name(self, path: str, type_: str, storage: Storage, note: str = "") -> Value:
        """Read a declared name, with the comment beside it."""
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
            return self.as_convened(found)
        if isinstance(found, Vector) and found.role is Role.LIGHT and found.space is None:
            known = self.judge.evidence.lights.get(path)
            if known is not None:
                found = replace(found, space=known, because=Because.ARITHMETIC)
        if isinstance(found, Vector) and not found.origin:
            found = replace(found, origin=path)
        return found

    def as_convened(self, matrix: Matrix) -> Matrix:
        """Take a named matrix as this program multiplies it."""
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
                sense = value.sense or told.sense  # `l = lamp - position` leads to it
                return replace(told, length=value.length, is_assumed=False, sense=sense)
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

    def field(self, owner: Record, name: str) -> Value:
        """Read a field of a struct: what was written there, or what its name says."""
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
        elif self.shader.language is ShaderLanguage.HLSL and self.stage is Stage.VERTEX:
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

    def typed(self, expression: Expression, scope: Scope) -> tuple[str, bool]:
        """Find the struct that an expression is of, if it is, and whether it is an array."""
        match expression:
            case tree.Name(name=name):
                variable = self.declared.get(name)
                value = scope.find(name)
                type_ = value.type if isinstance(value, Record) else ""
                is_array = name in self.arrays or (variable is not None and variable.is_array)
                return type_, is_array
            case tree.Member(of=of, name=name):
                struct = self.structs.get(self.typed(of, scope)[0])
                for one in struct.fields if struct is not None else ():
                    if one.name == name:
                        return one.type, one.is_array
            case tree.Element(of=of):
                return self.typed(of, scope)
            case _:
                pass
        return "", False


def _unless_world(space: ShaderSpace | None) -> ShaderSpace | None:
    return None if space is ShaderSpace.WORLD else space
