"""What operators make of two values, and what is wrong where they meet.

A finding leaves a value as it was meant, so that one mistake is told once and not wherever its
result goes.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable
from dataclasses import dataclass, field, replace

from nmatrix.enums import Severity
from nmatrix.lint import tree
from nmatrix.lint.rules import LINT_RULES, PARTICULAR_FIRST, RuleId
from nmatrix.lint.tree import Expression, Span, Stage
from nmatrix.lint.values import (
    ANYTHING,
    PROJECTED,
    Because,
    Carried,
    Fourth,
    Length,
    Matrix,
    Role,
    Scalar,
    Sense,
    ShaderSpace,
    Value,
    Vector,
    moved,
    product,
    right_order,
    spoken,
)


@dataclass(frozen=True)
class Parts:
    """The pieces of an expression that a correction changes.

    `missing` is the function that must be applied to the matrix too, `order` the right order of the
    factors of a product.
    """

    matrix: Expression | None = None
    vector: Expression | None = None
    missing: str = ""
    order: tuple[int, ...] = ()


NO_PARTS = Parts()


@dataclass(frozen=True)
class Fault:
    """One place where spaces meet that must not, and both of them."""

    rule: RuleId
    severity: Severity
    span: Span
    message: str
    left: str = ""
    right: str = ""
    expression: Expression | None = None
    parts: Parts = NO_PARTS


@dataclass
class Evidence:
    """What a first reading of a program shows about all of it.

    Parameters
    ----------
    sides
        How many points stand on the right (False) and on the left (True) of named matrices.
    lights
        Uniforms that a view matrix moves.
    has_model
        Whether a matrix moves what is in object space.
    has_view
        Whether a matrix leads from world to camera space.
    projects_world
        Whether a projection stands right before what the names take for the world: without a view
        matrix, nobody knows where the model matrix leads.
    """

    sides: Counter[bool] = field(default_factory=Counter)
    lights: dict[str, ShaderSpace] = field(default_factory=dict)
    has_model: bool = False
    has_view: bool = False
    projects_world: bool = False


class Judge:
    """Operators on values; what they find wrong is kept by its place."""

    def __init__(self, evidence: Evidence, written: Callable[[Span], str]) -> None:
        self.evidence = evidence
        self.written = written
        self.stage = Stage.UNKNOWN
        self.is_gated = False
        self._parts = NO_PARTS
        self._moves: dict[str, Expression] = {}
        self._calls: dict[str, Expression] = {}
        self.faults: dict[tuple[str, int, int], Fault] = {}
        self.factors: dict[Span, tuple[Matrix, ...]] = {}
        self._told_once: set[tuple[str, str]] = set()

    def tell(
        self,
        rule: RuleId,
        at: Expression,
        message: str,
        spaces: tuple[str, str] = ("", ""),
        severity: Severity | None = None,
        *,
        parts: Parts | None = None,
    ) -> None:
        """Keep a fault; of two at one place the more particular one stays."""
        if not at.span.file:
            return
        key = at.span.file, at.span.start, at.span.end
        before = self.faults.get(key)
        if before is not None and _rank(before.rule) <= _rank(rule):
            return
        weight = LINT_RULES[rule].severity if severity is None else severity
        given = self._parts if parts is None else parts
        self.faults[key] = Fault(rule, weight, at.span, message, *spaces, at, given)

    def space_of(self, vector: Vector) -> ShaderSpace | None:
        """The space of a vector, unless it is only that of a mesh which nothing moves."""
        if vector.is_assumed and not self.evidence.has_model:
            return None
        return vector.space

    # Products.

    def multiplied(self, at: tree.Binary, left: Value, right: Value) -> Value:
        """Multiply as linear algebra does."""
        match left, right:
            case Matrix(), Matrix():
                return self._chained(at, left, right)
            case Matrix(), Vector():
                return self._carried(at, left, right, is_left=False)
            case Vector(), Matrix():
                return self._carried(at, right, left, is_left=True)
            case _:
                return self.scaled(at, left, right)

    def scaled(self, at: tree.Binary, left: Value, right: Value) -> Value:
        """Multiply or divide entry by entry: a vector by a number stays what it is."""
        match left, right:
            case Scalar(), Scalar():
                return _product_of_numbers(at.operator, left, right)
            case Vector(), Scalar():
                return _times(left, right, is_divided=at.operator == "/")
            case Scalar(), Vector() if at.operator != "/":
                return _times(right, left, is_divided=False)
            case Matrix(), Scalar():
                return left
            case Scalar(), Matrix():
                return right
            case Vector(), Vector():
                return Vector(size=max(left.size, right.size))
            case Vector(), _:
                return Vector(size=left.size)
            case _, Vector():
                return Vector(size=right.size)
            case Matrix(), _:
                return Matrix(size=left.size)
        return ANYTHING

    def _chained(self, at: tree.Binary, left: Matrix, right: Matrix) -> Matrix:
        factors = (
            *self.factors.get(at.left.span, (left,)),
            *self.factors.get(at.right.span, (right,)),
        )
        self.factors[at.span] = factors
        for one in factors:
            self._note_view(one)
            self._note_model(one)
        near, far = (right, left) if left.is_transposed and right.is_transposed else (left, right)
        self._note_projection(
            replace(near, is_transposed=False),
            far.to if near.is_transposed == far.is_transposed else None,
        )
        order = right_order(factors)
        if order is None:
            return product(left, right)
        first, *others = (factors[place] for place in order)
        made = first
        for other in others:
            made = product(made, other)
        for key in [key for key, one in self.faults.items() if self._is_within(one, at.span)]:
            del self.faults[key]
        names = " · ".join(one.told for one in factors)
        self.tell(
            RuleId.PRODUCT_ORDER,
            at,
            f"{names}: neighbours do not meet",
            (spoken(left.source), spoken(right.to)),
            parts=Parts(order=order),
        )
        self.factors[at.span] = (made,)
        return replace(made, because=Because.ARITHMETIC)

    def _is_within(self, one: Fault, span: Span) -> bool:
        return one.rule is RuleId.PRODUCT_ORDER and span.holds(one.span)

    def _carried(
        self, at: tree.Binary, written: Matrix, vector: Vector, *, is_left: bool
    ) -> Vector:
        """Multiply a vector by a matrix; on the left of it the vector meets its transpose."""
        if written.because is Because.NAME and (
            vector.kind is Carried.POINT or vector.w is Fourth.ONE
        ):
            self.evidence.sides[is_left] += 1
        matrix = written.transposed if is_left else written
        sides = (at.right, at.left) if is_left else (at.left, at.right)
        self._parts = Parts(*sides)
        found = self.carried(at, matrix, vector)
        self._parts = NO_PARTS
        return found

    def carried(self, at: Expression, matrix: Matrix, vector: Vector) -> Vector:
        """Multiply a column vector by a matrix, and tell if it is none for such a vector."""
        if matrix.is_transposed and matrix.is_rigid:
            matrix = replace(matrix.inverse, is_transposed=False)
        self._note_evidence(matrix, vector)
        if vector.origin:
            self._moves[vector.origin] = at
        if vector.role is Role.LIGHT and self._judge_light(at, matrix, vector):
            return replace(moved(matrix, vector), space=matrix.to)
        match vector.kind:
            case Carried.NORMAL:
                meant = self._judge_normal(at, matrix, vector)
                return replace(moved(meant, vector), kind=Carried.NORMAL)
            case Carried.TANGENT | Carried.DIRECTION:
                self._judge_direction(at, matrix, vector)
            case Carried.POINT:
                self._judge_point(at, matrix, vector)
            case _:
                pass
        return moved(matrix, vector)

    def _note_projection(self, matrix: Matrix, to: ShaderSpace | None) -> None:
        is_projection = (matrix.to, matrix.source) == (ShaderSpace.CLIP, ShaderSpace.CAMERA)
        if is_projection and not matrix.is_transposed and to is ShaderSpace.WORLD:
            self.evidence.projects_world = True

    def _note_evidence(self, matrix: Matrix, vector: Vector) -> None:
        self._note_projection(matrix, vector.space)
        self._note_model(matrix)
        is_view = self._note_view(matrix)
        if is_view and vector.role is Role.LIGHT and vector.space is None and vector.origin:
            self.evidence.lights[vector.origin] = ShaderSpace.WORLD

    def _note_model(self, matrix: Matrix) -> None:
        """Believe in object space where a matrix leads out of it that is no whole product."""
        if matrix.is_known and ShaderSpace.OBJECT in (matrix.to, matrix.source):
            other = matrix.source if matrix.to is ShaderSpace.OBJECT else matrix.to
            is_engine = matrix.because is Because.BUILT_IN
            self.evidence.has_model |= is_engine or other not in PROJECTED
        self.evidence.has_model |= _leads_somewhere(matrix)

    def _note_view(self, matrix: Matrix) -> bool:
        is_view = (matrix.to, matrix.source) == (ShaderSpace.CAMERA, ShaderSpace.WORLD)
        leads_to_clip = (matrix.to, matrix.source) == (ShaderSpace.CLIP, ShaderSpace.WORLD)
        self.evidence.has_view |= is_view or leads_to_clip
        return is_view

    def _judge_light(self, at: Expression, matrix: Matrix, light: Vector) -> bool:
        if matrix.is_transposed or not matrix.is_known or matrix.source is not ShaderSpace.OBJECT:
            return False
        if matrix.to not in (ShaderSpace.WORLD, ShaderSpace.CAMERA) or light.is_assumed:
            return False
        if light.space not in (None, ShaderSpace.OBJECT):
            what = "is moved as if it were in object space"
            told = f"the {light.told} {what}, by {matrix.told}"
            self.tell(RuleId.LIGHT_BY_MODEL_VIEW, at, told, (spoken(light.space), matrix.told))
            return True
        if light.space is None and light.likely and matrix.to is ShaderSpace.CAMERA:
            self.tell(
                RuleId.LIGHT_BY_MODEL_VIEW,
                at,
                f"the {light.noun} is moved by {matrix.told}: right only if the light moves with "
                "the object; one of the world needs the view matrix alone",
                (spoken(light.likely), matrix.told),
                Severity.WARNING,
            )
            return True
        return False

    def _judge_normal(self, at: Expression, matrix: Matrix, normal: Vector) -> Matrix:
        """Judge a product with a normal; the answer is the matrix that was meant."""
        is_four = matrix.size == 4 and normal.size == 4
        if not matrix.is_known and not _leads_somewhere(matrix):
            return matrix
        right = matrix.told
        if matrix.has_projection:
            if matrix.is_transposed and matrix.source in PROJECTED:
                told = "the projection is inverted and transposed for the normal too"
                self.tell(RuleId.NORMAL_BY_PROJECTION, at, told, (normal.told, right))
            return matrix
        if matrix.is_transposed:
            if matrix.source is ShaderSpace.OBJECT and normal.space is ShaderSpace.OBJECT:
                told = f"the {normal.told} is multiplied by the {right}, without its inverse"
                parts = replace(self._parts, missing="inverse")
                spaces = (normal.told, right)
                self.tell(RuleId.HALF_INVERSE_TRANSPOSE, at, told, spaces, parts=parts)
                return matrix.inverse
            return matrix
        if is_four and normal.w is Fourth.ONE:
            told = f"w = 1 adds the translation of {right} to the {normal.told}"
            self.tell(RuleId.NORMAL_WITH_W, at, told, (normal.told, right))
            return matrix
        if matrix.is_rigid:
            return matrix
        if matrix.source is ShaderSpace.OBJECT and normal.space in (None, ShaderSpace.OBJECT):
            told = (
                f"the {normal.told} is multiplied by {right} itself; "
                "a normal needs its inverse transpose"
            )
            self.tell(RuleId.NORMAL_BY_MATRIX, at, told, (normal.told, right))
            return matrix
        if matrix.to is ShaderSpace.OBJECT and normal.space is ShaderSpace.OBJECT:
            told = f"the {normal.told} is multiplied by {right}, which is not transposed"
            parts = replace(self._parts, missing="transpose")
            self.tell(RuleId.HALF_INVERSE_TRANSPOSE, at, told, (normal.told, right), parts=parts)
            return matrix.inverse
        return matrix

    def _judge_direction(self, at: Expression, matrix: Matrix, vector: Vector) -> None:
        is_normal_matrix = matrix.is_transposed and matrix.to is ShaderSpace.OBJECT
        if vector.kind is Carried.TANGENT and is_normal_matrix and not matrix.has_projection:
            told = f"the {vector.told} is multiplied by the matrix for normals"
            self.tell(RuleId.TANGENT_BY_NORMAL_MATRIX, at, told, (vector.told, matrix.told))
        is_four = matrix.size == 4 and vector.size == 4 and matrix.is_known
        if is_four and vector.w is Fourth.ONE and not matrix.has_projection:
            told = f"w = 1 adds the translation of {matrix.told} to the {vector.told}"
            self.tell(RuleId.WRONG_W, at, told, (vector.told, matrix.told))

    def _judge_point(self, at: Expression, matrix: Matrix, vector: Vector) -> None:
        is_four = matrix.size == 4 and vector.size == 4 and matrix.is_known
        if not is_four or vector.w is not Fourth.ZERO or matrix.is_transposed:
            return
        if matrix.source is ShaderSpace.OBJECT and vector.is_assumed and vector.role is None:
            told = f"w = 0 leaves the translation of {matrix.told} out of the {vector.told}"
            self.tell(RuleId.WRONG_W, at, told, (vector.told, matrix.told))

    # Sums and dot products.

    def added(self, at: tree.Binary, left: Value, right: Value) -> Value:
        """Add or subtract."""
        if not isinstance(left, Vector) or not isinstance(right, Vector):
            return _sum_with_number(left, right)
        if at.operator == "+" and Role.ORIGIN in (left.role, right.role):
            self._judge_origin(at, left, right)
        self.meet(at, left, right)
        if at.operator == "-":
            self._judge_lamp(at, left, right)
            return _difference(left, right)
        return _sum(left, right)

    def _judge_lamp(self, at: tree.Binary, left: Vector, right: Vector) -> None:
        """Tell if the place of a lamp was moved with w = 0, as a direction may be."""
        for lamp, other in ((left, right), (right, left)):
            is_moved = lamp.w is Fourth.ZERO and lamp.role is Role.LIGHT and lamp.via is not None
            if not is_moved or lamp.kind is not other.kind or lamp.kind is not Carried.POINT:
                continue
            moved_at = self._moves.get(lamp.origin, at)
            parts = NO_PARTS
            if isinstance(moved_at, tree.Binary):
                parts = Parts(vector=moved_at.right)
            told = f"w = 0 leaves the translation out of the {lamp.noun}"
            self.tell(RuleId.WRONG_W, moved_at, told, (lamp.told, other.told), parts=parts)

    def meet(self, at: Expression, left: Vector, right: Vector) -> None:
        """Tell if two vectors are in two spaces."""
        mine, yours = self.space_of(left), self.space_of(right)
        if mine in PROJECTED or yours in PROJECTED or None in (left.kind, right.kind):
            return
        spaces = (left.told, right.told)
        lit = Role.LIGHT in (left.role, right.role)
        if mine is not None and yours is not None:
            if mine is not yours:
                rule = RuleId.STUCK_LIGHT if lit else RuleId.SPACES_MIXED
                self.tell(rule, at, f"{left.told} meets {right.told}", spaces)
            return
        for one, other in ((left, yours), (right, mine)):
            if one.space is not None or one.likely is None or other in (None, one.likely):
                continue
            if one.role is Role.LIGHT:
                if not self._is_first(at, one):
                    continue
                told = (
                    f"the {one.noun} is taken as it comes, in {spoken(other)}: wrong if the "
                    f"program gives it in {spoken(one.likely)}"
                )
                self.tell(RuleId.STUCK_LIGHT, at, told, spaces, Severity.NOTE)
            elif one.role is Role.EYE and one.kind is Carried.POINT and other is ShaderSpace.CAMERA:
                told = "in camera space the eye is the origin, this one is of another space"
                self.tell(RuleId.SPACES_MIXED, at, told, spaces)

    def dotted(self, at: tree.Call, left: Vector, right: Vector) -> Scalar:
        """Multiply by the scalar product."""
        self.meet(at, left, right)
        same = left == right
        for one, other, place in ((left, right, 0), (right, left, 1)):
            if not same:
                self._judge_length(at, one, place)
            if one.is_reflected and one.role is Role.LIGHT and other.role is Role.EYE:
                self._judge_reflected(at, one, other)
            if one.role is Role.ORIGIN and other.role is Role.LIGHT and other.is_reflected:
                self._judge_origin(at, one, other)
        is_cosine = left.is_direction and right.is_direction and not same
        return Scalar(is_cosine=is_cosine)

    def _judge_length(self, at: tree.Call, one: Vector, place: int) -> None:
        if one.kind is not Carried.NORMAL or one.length is not Length.INTERPOLATED:
            return
        if self.stage is not Stage.FRAGMENT or not self._is_first(at, one):
            return
        told = f"the interpolated {one.told} is shorter than 1 between vertices"
        parts = Parts(vector=at.arguments[place])
        self.tell(RuleId.NOT_NORMALISED, at, told, (one.told, ""), parts=parts)

    def _is_first(self, at: Expression, one: Vector) -> bool:
        """Whether a file has not been told of this vector."""
        key = at.span.file, one.origin or one.told
        is_first = key not in self._told_once
        self._told_once.add(key)
        return is_first

    def _judge_reflected(self, at: Expression, mirrored: Vector, eye: Vector) -> None:
        if mirrored.sense * eye.sense >= 0:
            return
        at = self._calls.get(mirrored.origin, at)
        told = "reflect takes the direction that arrives, and this one leads to the light"
        self.tell(RuleId.REFLECTED_WRONG_WAY, at, told, (mirrored.told, eye.told))

    def _judge_origin(self, at: Expression, left: Vector, right: Vector) -> None:
        origin, other = (left, right) if left.role is Role.ORIGIN else (right, left)
        if origin.because is not Because.ARITHMETIC or other.role is not Role.LIGHT:
            return
        if self.space_of(origin) not in (ShaderSpace.WORLD, ShaderSpace.OBJECT):
            return
        self.tell_origin(at, origin)

    def tell_origin(self, at: Expression, origin: Vector) -> None:
        """Tell that a direction to the origin is taken for one to the eye."""
        told = f"−position leads to the origin of {spoken(origin.space)}, where the eye is not"
        self.tell(
            RuleId.EYE_AT_ORIGIN, at, told, (spoken(origin.space), spoken(ShaderSpace.CAMERA))
        )

    def reflected(self, at: tree.Call, arriving: Vector, normal: Vector) -> Vector:
        """Mirror a direction that arrives."""
        self.meet(at, arriving, normal)
        self._judge_length(at, normal, 1)
        origin = f"reflect at {at.span.file}:{at.span.start}"
        self._calls[origin] = at
        return replace(
            arriving,
            kind=Carried.DIRECTION if arriving.kind is not None else None,
            space=self.space_of(arriving) or self.space_of(normal),
            sense=Sense(-arriving.sense),
            is_reflected=True,
            via=None,
            likely=None,
            origin=origin,
        )

    def crossed(self, at: Expression, left: Vector, right: Vector) -> Vector:
        """Multiply by the vector product: the third direction of a surface's frame."""
        self.meet(at, left, right)
        kinds = {left.kind, right.kind}
        kind = None
        if kinds == {Carried.NORMAL, Carried.TANGENT}:
            kind = Carried.TANGENT
        elif kinds == {Carried.TANGENT}:
            kind = Carried.NORMAL
        space = left.space if left.space is not None else right.space
        is_assumed = left.is_assumed and right.is_assumed
        return Vector(kind, space, 3, is_assumed=is_assumed, because=Because.ARITHMETIC)

    def normalised(self, at: Expression, vector: Vector) -> Vector:
        """Divide by the length."""
        is_counted = vector.w in (Fourth.ONE, Fourth.LEFT_OVER)
        if vector.size == 4 and is_counted and vector.kind is not None:
            told = f"the length of the {vector.told} counts w, which is {vector.w}"
            self.tell(RuleId.FOUR_COMPONENTS, at, told, (vector.told, ""))
        unit = replace(vector, length=Length.UNIT, w=None if vector.size != 4 else vector.w)
        if vector.kind is Carried.POINT:
            return _direction_of(unit)
        return unit

    def undivided(self, at: Expression, vector: Vector, written: Expression) -> None:
        """Tell if coordinates are taken for those of a window that were not divided by w."""
        if vector.w is not Fourth.DEPTH:
            return
        told, severity = f"the point in {spoken(vector.space)} is not divided by its w", None
        if vector.space is ShaderSpace.LIGHT:
            told, severity = f"{told}: right only for a light without perspective", Severity.NOTE
        parts = Parts(vector=written)
        self.tell(RuleId.W_NOT_DIVIDED, at, told, (spoken(vector.space), ""), severity, parts=parts)

    def powered(self, at: Expression, base: Value) -> Scalar:
        """Raise to a power."""
        if self.is_gated:  # what a comparison let through may be positive
            return Scalar()
        if isinstance(base, Scalar) and base.is_cosine and not base.is_clamped:
            told = "the cosine may be negative, and its power is undefined then"
            self.tell(RuleId.POWER_OF_NEGATIVE, at, told)
        return Scalar()

    def inverted(self, at: Expression, matrix: Matrix, *, is_given: bool) -> Matrix:
        """Invert a matrix."""
        if is_given and self.stage in (Stage.VERTEX, Stage.FRAGMENT):
            per = "vertex" if self.stage is Stage.VERTEX else "fragment"
            self.tell(RuleId.INVERSE_IN_SHADER, at, f"the same inverse is computed per {per}")
        return replace(matrix.inverse, because=Because.ARITHMETIC)


def _leads_somewhere(matrix: Matrix) -> bool:
    """Whether a matrix is called that of the model, and nothing is known of where it leads."""
    is_named = matrix.because in (Because.NAME, Because.ARITHMETIC)
    return is_named and matrix.source is ShaderSpace.OBJECT and matrix.to is None


def negated(value: Value) -> Value:
    """Turn a value round: −position leads to the origin."""
    if isinstance(value, Scalar):
        number = None if value.number is None else -value.number
        return Scalar(value.is_cosine, number=number)
    if not isinstance(value, Vector):
        return value
    if value.kind is Carried.POINT and value.role is None:
        role = Role.EYE if value.space is ShaderSpace.CAMERA else Role.ORIGIN
        return replace(value, kind=Carried.DIRECTION, role=role, sense=Sense.OUT, length=None)
    if value.kind is Carried.POINT:
        return replace(value, kind=Carried.DIRECTION, sense=Sense.UNKNOWN, likely=None, length=None)
    w = value.w if value.w is Fourth.ZERO else None
    return replace(value, sense=Sense(-value.sense), w=w)


def _direction_of(point: Vector) -> Vector:
    """Take a place as a direction from the origin."""
    if point.role is None and point.space is ShaderSpace.CAMERA:
        return replace(point, kind=Carried.DIRECTION, role=Role.EYE, sense=Sense.IN)
    if point.role is Role.LIGHT:
        return replace(point, kind=Carried.DIRECTION, sense=Sense.OUT)
    return replace(point, kind=Carried.DIRECTION, role=None)


def _difference(left: Vector, right: Vector) -> Vector:
    space = left.space if left.space is not None else right.space
    if left.space is not None and right.space is not None and left.space is not right.space:
        space = None
    ones = left.w is Fourth.ONE and right.w is Fourth.ONE
    base = Vector(
        space=space,
        size=max(left.size, right.size),
        w=Fourth.ZERO if ones else None,
        is_assumed=left.is_assumed or right.is_assumed,
        because=Because.ARITHMETIC,
    )
    if left.kind is Carried.POINT and right.kind is Carried.POINT:
        role, sense = None, Sense.UNKNOWN
        if left.role in (Role.LIGHT, Role.EYE) and right.role is None:
            role, sense = left.role, Sense.OUT
        elif right.role in (Role.LIGHT, Role.EYE) and left.role is None:
            role, sense = right.role, Sense.IN
        return replace(base, kind=Carried.DIRECTION, role=role, sense=sense)
    if left.kind is Carried.POINT and right.is_direction:
        return replace(base, kind=Carried.POINT, role=left.role)
    if left.kind is not None and right.kind is not None:
        kind = left.kind if left.kind is right.kind else Carried.DIRECTION
        return replace(base, kind=kind)
    return replace(base, space=None)


def _sum(left: Vector, right: Vector) -> Vector:
    space = left.space if left.space is not None else right.space
    if left.space is not None and right.space is not None and left.space is not right.space:
        space = None
    base = Vector(
        space=space,
        size=max(left.size, right.size),
        is_assumed=left.is_assumed or right.is_assumed,
        because=Because.ARITHMETIC,
    )
    kinds = {left.kind, right.kind}
    if None in kinds:
        return Vector(size=base.size)
    if Carried.POINT in kinds:
        point = left if left.kind is Carried.POINT else right
        if kinds == {Carried.POINT}:
            return Vector(Carried.POINT, space, base.size, because=Because.ARITHMETIC)
        return replace(base, kind=Carried.POINT, role=point.role, w=point.w)
    roles = {left.role, right.role}
    if roles == {Role.LIGHT, Role.EYE}:
        return replace(base, kind=Carried.DIRECTION, role=Role.HALFWAY)
    kind = left.kind if left.kind is right.kind else Carried.DIRECTION
    return replace(base, kind=kind)


def _sum_with_number(left: Value, right: Value) -> Value:
    match left, right:
        case Scalar(), Scalar():
            return Scalar()
        case Vector(), _:
            return Vector(size=left.size)
        case _, Vector():
            return Vector(size=right.size)
        case Matrix(), Matrix():
            return Matrix(size=max(left.size, right.size))
    return ANYTHING


def _times(vector: Vector, number: Scalar, *, is_divided: bool) -> Vector:
    sense = vector.sense
    if number.number is None:
        sense = vector.sense if is_divided else Sense.UNKNOWN
    elif number.number < 0:
        turned = negated(vector)
        return replace(turned, w=None) if isinstance(turned, Vector) else vector
    length = vector.length if vector.length is Length.INTERPOLATED else None
    if number.number is None:
        length = None
    is_kept = vector.w is Fourth.ZERO or (vector.w is Fourth.DEPTH and number.number is not None)
    w = vector.w if is_kept else None
    return replace(vector, sense=sense, length=length, w=w)


def _product_of_numbers(operator: str, left: Scalar, right: Scalar) -> Scalar:
    if operator == "/" or (left.number is None and right.number is None):
        return Scalar()
    cosine, number = (left, right.number) if right.number is not None else (right, left.number)
    is_positive = number is not None and number >= 0
    return Scalar(cosine.is_cosine and is_positive, cosine.is_clamped and is_positive)


def _rank(rule: RuleId) -> int:
    try:
        return PARTICULAR_FIRST.index(rule)
    except ValueError:
        return len(PARTICULAR_FIRST)
