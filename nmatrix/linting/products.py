"""Products: which vector a matrix may carry, and in which order matrices meet."""

from __future__ import annotations

from dataclasses import replace

from nmatrix.enums import Severity
from nmatrix.linting import tree
from nmatrix.linting.algebra import product_of_numbers, times
from nmatrix.linting.faults import NO_PARTS, Fault, Parts, Telling
from nmatrix.linting.rules import RuleId
from nmatrix.linting.tree import Expression, Span
from nmatrix.linting.values import (
    ANYTHING,
    PROJECTED,
    Because,
    Carried,
    Fourth,
    Matrix,
    Role,
    Scalar,
    ShaderSpace,
    Value,
    Vector,
    moved,
    product,
    right_order,
    spoken,
)


class Products(Telling):
    """Products of matrices with matrices and with vectors, and what is wrong with them."""

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
                return product_of_numbers(at.operator, left, right)
            case Vector(), Scalar():
                return times(left, right, is_divided=at.operator == "/")
            case Scalar(), Vector() if at.operator != "/":
                return times(right, left, is_divided=False)
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
            f"In {names} neighbours do not meet",
            (spoken(left.source), spoken(right.to)),
            parts=Parts(order=order),
        )
        return replace(made, because=Because.ARITHMETIC)

    def _is_within(self, one: Fault, span: Span) -> bool:
        return one.rule is RuleId.PRODUCT_ORDER and span.holds(one.span)

    def _carried(
        self, at: tree.Binary, written: Matrix, vector: Vector, *, is_left: bool
    ) -> Vector:
        """Multiply a vector by a matrix; on the left of it the vector meets its transpose."""
        if (written.because is Because.NAME or written.has_projection) and (
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
            told = f"The {light.told} {what}, by {matrix.told}"
            self.tell(RuleId.LIGHT_BY_MODEL_VIEW, at, told, (spoken(light.space), matrix.told))
            return True
        if light.space is None and light.likely and matrix.to is ShaderSpace.CAMERA:
            self.tell(
                RuleId.LIGHT_BY_MODEL_VIEW,
                at,
                f"The {light.noun} is moved by {matrix.told}: right only if the light moves with "
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
                told = "The projection is inverted and transposed for the normal too"
                self.tell(RuleId.NORMAL_BY_PROJECTION, at, told, (normal.where, right))
            return matrix
        if matrix.is_transposed:
            if matrix.source is ShaderSpace.OBJECT and normal.space is ShaderSpace.OBJECT:
                told = f"The {normal.told} is multiplied by {right}, which is not inverted"
                parts = replace(self._parts, missing="inverse")
                spaces = (normal.where, right)
                self.tell(RuleId.HALF_INVERSE_TRANSPOSE, at, told, spaces, parts=parts)
                return matrix.inverse
            return matrix
        if is_four and normal.w is Fourth.ONE:
            told = f"With w = 1 the translation of {right} is added to the {normal.told}"
            self.tell(RuleId.NORMAL_WITH_W, at, told, (normal.where, right))
            return matrix
        if matrix.is_rigid:
            return matrix
        if matrix.source is ShaderSpace.OBJECT and normal.space in (None, ShaderSpace.OBJECT):
            told = (
                f"The {normal.told} is multiplied by {right} itself; "
                "a normal needs its inverse transpose"
            )
            self.tell(RuleId.NORMAL_BY_MATRIX, at, told, (normal.where, right))
            return matrix
        if matrix.to is ShaderSpace.OBJECT and normal.space is ShaderSpace.OBJECT:
            told = f"The {normal.told} is multiplied by {right}, which is not transposed"
            parts = replace(self._parts, missing="transpose")
            self.tell(RuleId.HALF_INVERSE_TRANSPOSE, at, told, (normal.where, right), parts=parts)
            return matrix.inverse
        return matrix

    def _judge_direction(self, at: Expression, matrix: Matrix, vector: Vector) -> None:
        is_normal_matrix = matrix.is_transposed and matrix.to is ShaderSpace.OBJECT
        if vector.kind is Carried.TANGENT and is_normal_matrix and not matrix.has_projection:
            told = f"The {vector.told} is multiplied by the matrix for normals"
            self.tell(RuleId.TANGENT_BY_NORMAL_MATRIX, at, told, (vector.where, matrix.told))
        is_four = matrix.size == 4 and vector.size == 4 and matrix.is_known
        if is_four and vector.w is Fourth.ONE and not matrix.has_projection:
            told = f"With w = 1 the translation of {matrix.told} is added to the {vector.told}"
            self.tell(RuleId.WRONG_W, at, told, (vector.where, matrix.told))

    def _judge_point(self, at: Expression, matrix: Matrix, vector: Vector) -> None:
        is_four = matrix.size == 4 and vector.size == 4 and matrix.is_known
        if not is_four or vector.w is not Fourth.ZERO or matrix.is_transposed:
            return
        if matrix.source is ShaderSpace.OBJECT and vector.is_assumed and vector.role is None:
            told = f"With w = 0 the {vector.told} is moved without the translation of {matrix.told}"
            self.tell(RuleId.WRONG_W, at, told, (vector.where, matrix.told))


def _leads_somewhere(matrix: Matrix) -> bool:
    """Whether a matrix is called that of the model, and nothing is known of where it leads."""
    is_named = matrix.because in (Because.NAME, Because.ARITHMETIC)
    return is_named and matrix.source is ShaderSpace.OBJECT and matrix.to is None
