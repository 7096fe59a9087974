"""Where two vectors meet: sums, scalar and vector products, reflections, lengths and powers.

A finding leaves a value as it was meant, so that one mistake is told once and not wherever its
result goes.
"""

from __future__ import annotations

from dataclasses import replace

from nmatrix.enums import Severity
from nmatrix.linting import tree
from nmatrix.linting.algebra import difference, direction_of, total, total_with_number
from nmatrix.linting.faults import NO_PARTS, Parts
from nmatrix.linting.products import Products
from nmatrix.linting.rules import RuleId
from nmatrix.linting.tree import Expression, Stage
from nmatrix.linting.values import (
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
    spoken,
)


class Judge(Products):
    """What operators and functions make of two values, and what is wrong where they meet."""

    def added(self, at: tree.Binary, left: Value, right: Value) -> Value:
        """Add or subtract."""
        if not isinstance(left, Vector) or not isinstance(right, Vector):
            return total_with_number(left, right)
        if at.operator == "+" and Role.ORIGIN in (left.role, right.role):
            self._judge_origin(at, left, right)
        self.meet(at, left, right)
        if at.operator == "-":
            self._judge_lamp(at, left, right)
            return difference(left, right)
        return total(left, right)

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
            told = f"With w = 0 the {lamp.noun} is moved without the translation"
            self.tell(RuleId.WRONG_W, moved_at, told, (lamp.where, other.where), parts=parts)

    def meet(self, at: Expression, left: Vector, right: Vector) -> None:
        """Tell if two vectors are in two spaces."""
        mine, yours = self.space_of(left), self.space_of(right)
        if mine in PROJECTED or yours in PROJECTED or None in (left.kind, right.kind):
            return
        spaces, parts = (left.where, right.where), Parts(met=(left, right))
        lit = Role.LIGHT in (left.role, right.role)
        if mine is not None and yours is not None:
            if mine is not yours:
                rule = RuleId.STUCK_LIGHT if lit else RuleId.SPACES_MIXED
                told = f"The {left.told} meets the {right.told}"
                self.tell(rule, at, told, spaces, parts=parts)
            return
        for one, other in ((left, yours), (right, mine)):
            if one.space is not None or one.likely is None or other in (None, one.likely):
                continue
            if one.role is Role.LIGHT:
                never_moved = other is ShaderSpace.OBJECT and not self.evidence.has_model
                if never_moved or not self._is_first(at, one):
                    continue
                told = (
                    f"The {one.noun} is taken as it comes, in {spoken(other)}: wrong if the "
                    f"program gives it in {spoken(one.likely)}"
                )
                self.tell(RuleId.STUCK_LIGHT, at, told, spaces, Severity.NOTE)
            elif one.role is Role.EYE and one.kind is Carried.POINT and other is ShaderSpace.CAMERA:
                told = "The eye is the origin of camera space, and this one is of another space"
                self.tell(RuleId.SPACES_MIXED, at, told, spaces, parts=parts)

    def dotted(self, at: tree.Call, left: Vector, right: Vector) -> Scalar:
        """Multiply by the scalar product."""
        self.meet(at, left, right)
        same = left == right
        for one, other, place in ((left, right, 0), (right, left, 1)):
            if not same:
                self._judge_length(at, one, place)
            is_seen = other.role is Role.EYE or (other.role is Role.ORIGIN and not other.space)
            if one.is_reflected and one.role is Role.LIGHT and is_seen:
                self._judge_reflected(at, one, other)
            if one.role is Role.ORIGIN and other.role is Role.LIGHT and other.is_reflected:
                self._judge_origin(at, one, other)
        is_cosine = left.is_direction and right.is_direction and not same
        return Scalar(is_cosine=is_cosine, origin=self._too_long(at, left, right))

    def _too_long(self, at: tree.Call, left: Vector, right: Vector) -> str:
        """Note a product with a halfway vector that is none of length 1: a power of it is wrong."""
        for place, one, other in ((0, left, right), (1, right, left)):
            is_half = one.role is Role.HALFWAY and one.length is Length.SUM
            if is_half and other.kind is Carried.NORMAL:
                origin = f"dot at {at.span.file}:{at.span.start}"
                self._calls[origin], self._halves[origin] = at, at.arguments[place]
                return origin
        return ""

    def _judge_length(self, at: tree.Call, one: Vector, place: int) -> None:
        if one.kind is not Carried.NORMAL or one.length is not Length.INTERPOLATED:
            return
        if self.stage is not Stage.FRAGMENT or not self._is_first(at, one):
            return
        told = f"The interpolated {one.told} is shorter than 1 between vertices"
        normal = at.arguments[place]
        self.tell(RuleId.NOT_NORMALISED, normal, told, (one.where, ""), parts=Parts(vector=normal))

    def _judge_reflected(self, at: Expression, mirrored: Vector, eye: Vector) -> None:
        if mirrored.sense * eye.sense * (-1 if self.is_turned else 1) >= 0:
            return
        at = self._calls.get(mirrored.origin, at)
        told = "The first argument leads to the light, and reflect takes what arrives from it"
        self.tell(RuleId.REFLECTED_WRONG_WAY, at, told, (mirrored.where, eye.where))

    def _judge_origin(self, at: Expression, left: Vector, right: Vector) -> None:
        origin, other = (left, right) if left.role is Role.ORIGIN else (right, left)
        if origin.because is not Because.ARITHMETIC or other.role is not Role.LIGHT:
            return
        if self.space_of(origin) not in (ShaderSpace.WORLD, ShaderSpace.OBJECT):
            return
        self.tell_origin(at, origin)

    def tell_origin(self, at: Expression, origin: Vector) -> None:
        """Tell that a direction to the origin is taken for one to the eye."""
        told = f"This leads to the origin of {spoken(origin.space)}, where the eye is not"
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
            told = f"The length of the {vector.told} counts w, which is {vector.w}"
            self.tell(RuleId.FOUR_COMPONENTS, at, told, (vector.where, ""))
        unit = replace(vector, length=Length.UNIT, w=None if vector.size != 4 else vector.w)
        if vector.kind is Carried.POINT:
            return direction_of(unit)
        return unit

    def undivided(self, at: Expression, vector: Vector, written: Expression) -> None:
        """Tell if coordinates are taken for those of a window that were not divided by w."""
        if vector.w is not Fourth.DEPTH:
            return
        told, severity = f"The point in {spoken(vector.space)} is not divided by its w", None
        if vector.space is ShaderSpace.LIGHT:
            told, severity = f"{told}: right only for a light without perspective", Severity.NOTE
        parts = Parts(vector=written)
        self.tell(RuleId.W_NOT_DIVIDED, at, told, (spoken(vector.space), ""), severity, parts=parts)

    def powered(self, at: Expression, base: Value) -> Scalar:
        """Raise to a power."""
        if isinstance(base, Scalar) and base.origin in self._halves:
            told = "The halfway vector is a sum of two unit vectors, and no unit vector itself"
            parts = Parts(vector=self._halves[base.origin])
            self.tell(RuleId.HALFWAY_NOT_UNIT, self._calls[base.origin], told, parts=parts)
        if self.is_gated:  # what a comparison let through may be positive
            return Scalar()
        if isinstance(base, Scalar) and base.is_cosine and not base.is_clamped:
            told = "The cosine may be negative, and its power is undefined then"
            self.tell(RuleId.POWER_OF_NEGATIVE, at, told)
        return Scalar()

    def inverted(self, at: Expression, matrix: Matrix, *, is_given: bool) -> Matrix:
        """Invert a matrix."""
        if is_given and self.stage in (Stage.VERTEX, Stage.FRAGMENT):
            per = "vertex" if self.stage is Stage.VERTEX else "fragment"
            self.tell(RuleId.INVERSE_IN_SHADER, at, f"The same inverse is computed for each {per}")
        return replace(matrix.inverse, because=Because.ARITHMETIC)
