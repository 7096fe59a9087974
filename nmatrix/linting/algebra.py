"""What operators and constructors make of values: the algebra alone, without any judgement."""

from __future__ import annotations

from dataclasses import replace

from nmatrix.linting.values import (
    ANYTHING,
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
)

FOURTHS: dict[float | None, Fourth] = {0.0: Fourth.ZERO, 1.0: Fourth.ONE}


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


def direction_of(point: Vector) -> Vector:
    """Take a place as a direction from the origin."""
    if point.role is None and point.space is ShaderSpace.CAMERA:
        return replace(point, kind=Carried.DIRECTION, role=Role.EYE, sense=Sense.IN)
    if point.role is Role.LIGHT:
        return replace(point, kind=Carried.DIRECTION, sense=Sense.OUT)
    return replace(point, kind=Carried.DIRECTION, role=None)


def difference(left: Vector, right: Vector) -> Vector:
    """Subtract: two points make a direction, from the surface to a lamp it leads out.

    Examples
    --------
    >>> lamp = Vector(Carried.POINT, ShaderSpace.WORLD, 3, role=Role.LIGHT)
    >>> difference(lamp, Vector(Carried.POINT, ShaderSpace.WORLD, 3)).sense.name
    'OUT'
    """
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


def total(left: Vector, right: Vector) -> Vector:
    """Add: a point and a direction are a point, directions to light and eye what is halfway.

    Examples
    --------
    >>> light = Vector(Carried.DIRECTION, ShaderSpace.WORLD, 3, role=Role.LIGHT)
    >>> total(light, Vector(Carried.DIRECTION, ShaderSpace.WORLD, 3, role=Role.EYE)).role.value
    'halfway vector'
    """
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
        are_units = left.length is Length.UNIT and right.length is Length.UNIT
        length = Length.SUM if are_units else None
        return replace(base, kind=Carried.DIRECTION, role=Role.HALFWAY, length=length)
    kind = left.kind if left.kind is right.kind else Carried.DIRECTION
    return replace(base, kind=kind)


def total_with_number(left: Value, right: Value) -> Value:
    """Add what are not two vectors: of a vector and a number nothing is known but its size.

    Examples
    --------
    >>> total_with_number(Vector(Carried.NORMAL, size=3), Scalar()).kind is None
    True
    """
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


def times(vector: Vector, number: Scalar, *, is_divided: bool) -> Vector:
    """Stretch a vector by a number, or divide it; a negative one turns it round.

    Examples
    --------
    >>> out = Vector(Carried.DIRECTION, size=3, sense=Sense.OUT)
    >>> times(out, Scalar(number=-2.0), is_divided=False).sense.name
    'IN'
    """
    sense = vector.sense
    if number.number is None:
        sense = vector.sense if is_divided else Sense.UNKNOWN
    elif number.number < 0:
        turned = negated(vector)
        return replace(turned, w=None) if isinstance(turned, Vector) else vector
    length = None if vector.length is Length.UNIT else vector.length
    if number.number is None:
        length = None
    is_kept = vector.w is Fourth.ZERO or (vector.w is Fourth.DEPTH and number.number is not None)
    w = vector.w if is_kept else None
    return replace(vector, sense=sense, length=length, w=w)


def product_of_numbers(operator: str, left: Scalar, right: Scalar) -> Scalar:
    """Multiply or divide two numbers.

    Examples
    --------
    >>> product_of_numbers("*", Scalar(is_cosine=True), Scalar(number=0.5)).is_cosine
    True
    """
    if operator == "/" or (left.number is None and right.number is None):
        return Scalar()
    cosine, number = (left, right.number) if right.number is not None else (right, left.number)
    is_positive = number is not None and number >= 0
    is_cosine, is_clamped = cosine.is_cosine and is_positive, cosine.is_clamped and is_positive
    return Scalar(is_cosine, is_clamped, origin=cosine.origin)


def swizzled(vector: Vector, name: str) -> Value:
    """Choose components of a vector.

    Examples
    --------
    >>> clip = Vector(Carried.POINT, ShaderSpace.CLIP, 4, Fourth.DEPTH)
    >>> swizzled(clip, "xyz").w is Fourth.DEPTH, swizzled(clip, "w").is_cosine
    (True, False)
    """
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


def made_vector(size: int, arguments: list[Value]) -> Value:
    """Construct a vector.

    Examples
    --------
    >>> made_vector(4, [Vector(Carried.POINT, size=3), Scalar(number=1.0)]).w is Fourth.ONE
    True
    """
    if size == 2:
        return Vector(size=2)
    first = arguments[0] if arguments else ANYTHING
    if not isinstance(first, Vector):
        return Vector(size=size)
    if len(arguments) == 1:
        if first.size > size:
            return swizzled(first, "xyz")
        return first if first.size == size else Vector(size=size)
    last = arguments[-1]
    if size == 4 and first.size == 3 and len(arguments) == 2:
        if not isinstance(last, Scalar):
            return replace(first, size=4, w=None)
        w = FOURTHS.get(last.number)
        return replace(first, size=4, w=w)
    return Vector(size=size)


def made_matrix(size: int, arguments: list[Value]) -> Value:
    """Construct a matrix: a part of another one, or the frame of a surface from its columns.

    Examples
    --------
    >>> made_matrix(3, [Matrix(ShaderSpace.WORLD, ShaderSpace.OBJECT)]).size
    3
    """
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
