"""What is known of a vector and of a matrix in a shader, and how products carry it along.

A matrix leads from one frame to another, or is the transpose of such a one: the inverse transpose
of world-from-object is object-from-world, transposed. What is not known is None, and None meets
everything without a word.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import IntEnum, StrEnum
from itertools import pairwise, permutations


class ShaderSpace(StrEnum):
    """A space that vectors of a shader may be in."""

    OBJECT = "object"
    WORLD = "world"
    CAMERA = "camera"
    CLIP = "clip"
    LIGHT = "light"
    TANGENT = "tangent"


class Carried(StrEnum):
    """What a vector stands for, which decides by what it is moved."""

    POINT = "point"
    DIRECTION = "direction"
    TANGENT = "tangent"
    NORMAL = "normal"


class Role(StrEnum):
    """Whose point a vector is, or where a direction points to or from."""

    LIGHT = "light"
    EYE = "eye"
    HALFWAY = "halfway vector"
    ORIGIN = "origin"


class Sense(IntEnum):
    """Whether a direction points away from the surface, to the light or the eye, or comes in."""

    OUT = 1
    UNKNOWN = 0
    IN = -1


class Fourth(StrEnum):
    """What stands in w."""

    ZERO = "0"
    ONE = "1"
    DEPTH = "the depth of a projection"
    LEFT_OVER = "what the inverse transpose left there"


class Length(StrEnum):
    """What is known of a length."""

    UNIT = "1"
    INTERPOLATED = "shorter than 1 between vertices"
    SUM = "that of a sum of two units"


class Because(StrEnum):
    """How a space is known."""

    ANNOTATION = "annotation"
    COMMENT = "comment"
    BUILT_IN = "built in"
    NAME = "name"
    ARITHMETIC = "arithmetic"


@dataclass(frozen=True, slots=True)
class Vector:
    """What is known of a vector.

    Parameters
    ----------
    likely
        The space that the name suggests and does not say: a light's is mostly the world's.
    is_assumed
        Whether the space is only that of a vertex before any matrix: a mesh may be stored in any.
    is_reflected
        Whether it is what `reflect` made.
    via
        The matrix that it has just come through.
    origin
        The uniform or the input that it was, or the place of the call that made it.
    """

    kind: Carried | None = None
    space: ShaderSpace | None = None
    size: int = 0
    w: Fourth | None = None
    role: Role | None = None
    sense: Sense = Sense.UNKNOWN
    length: Length | None = None
    likely: ShaderSpace | None = None
    is_assumed: bool = False
    is_reflected: bool = False
    via: Matrix | None = None
    because: Because | None = None
    origin: str = ""

    @property
    def is_direction(self) -> bool:
        """Whether it is no point."""
        return self.kind in (Carried.DIRECTION, Carried.TANGENT, Carried.NORMAL)

    @property
    def noun(self) -> str:
        """Name what it is, without its space."""
        if self.role in (Role.LIGHT, Role.EYE) and self.kind in (Carried.POINT, None):
            return f"position of the {self.role}"
        if self.role is not None and self.kind is Carried.DIRECTION:
            return self.role.value if self.role is Role.HALFWAY else f"direction of the {self.role}"
        return "vector" if self.kind is None else self.kind.value

    @property
    def where(self) -> str:
        """Name its space, if it is known."""
        return "" if self.space is None else spoken(self.space)

    @property
    def told(self) -> str:
        """Name it in a sentence, with its space if that is known."""
        return self.noun if self.space is None else f"{self.noun} in {self.where}"


@dataclass(frozen=True, slots=True)
class Matrix:
    """What is known of a matrix: `to` from `source`, or the transpose of that."""

    to: ShaderSpace | None = None
    source: ShaderSpace | None = None
    is_transposed: bool = False
    size: int = 4
    because: Because | None = None

    @property
    def is_known(self) -> bool:
        """Whether both frames are known."""
        return self.to is not None and self.source is not None

    @property
    def is_rigid(self) -> bool:
        """Whether it turns without stretching, so that its transpose is its inverse."""
        return {self.to, self.source} <= RIGID and self.is_known

    @property
    def transposed(self) -> Matrix:
        """The transpose."""
        return replace(self, is_transposed=not self.is_transposed)

    @property
    def inverse(self) -> Matrix:
        """The inverse."""
        return replace(self, to=self.source, source=self.to)

    @property
    def has_projection(self) -> bool:
        """Whether points must be divided by w after it."""
        return self.to in PROJECTED or self.source in PROJECTED

    @property
    def told(self) -> str:
        """Name it in a sentence."""
        if self.to is None or self.source is None:
            return "a matrix" if self.source is None else f"a matrix from {spoken(self.source)}"
        return f"{self.to}_from_{self.source}{'ᵀ' if self.is_transposed else ''}"


@dataclass(frozen=True, slots=True)
class Scalar:
    """A number; a cosine that is not clamped may be negative.

    `origin` is the scalar product that it comes from, if a vector in it was too long or short.
    """

    is_cosine: bool = False
    is_clamped: bool = False
    number: float | None = None
    origin: str = ""


@dataclass(frozen=True, slots=True)
class Record:
    """The fields of a struct; those that were not written are known by `path`, their name."""

    type: str
    path: str
    fields: tuple[tuple[str, Value], ...] = ()

    def field(self, name: str) -> Value | None:
        """Find the value that was written to a field."""
        return dict(self.fields).get(name)

    def with_field(self, name: str, value: Value) -> Record:
        """Write a field."""
        return replace(self, fields=tuple(sorted({**dict(self.fields), name: value}.items())))


@dataclass(frozen=True, slots=True)
class Anything:
    """Nothing is known."""


Value = Vector | Matrix | Scalar | Record | Anything
ANYTHING = Anything()

RIGID = frozenset({ShaderSpace.WORLD, ShaderSpace.CAMERA, ShaderSpace.TANGENT})
PROJECTED = (ShaderSpace.CLIP, ShaderSpace.LIGHT)
_SPOKEN = {
    ShaderSpace.OBJECT: "object space",
    ShaderSpace.WORLD: "world space",
    ShaderSpace.CAMERA: "camera space",
    ShaderSpace.CLIP: "clip space",
    ShaderSpace.LIGHT: "the light's clip space",
    ShaderSpace.TANGENT: "tangent space",
}


def spoken(frame: ShaderSpace | None) -> str:
    """Name a frame in a sentence.

    Examples
    --------
    >>> spoken(ShaderSpace.CAMERA), spoken(None)
    ('camera space', 'an unknown space')
    """
    return "an unknown space" if frame is None else _SPOKEN[frame]


def product(left: Matrix, right: Matrix) -> Matrix:
    """Multiply two matrices; where their frames do not meet, nothing is known of the product.

    Examples
    --------
    >>> view = Matrix(ShaderSpace.CAMERA, ShaderSpace.WORLD)
    >>> model = Matrix(ShaderSpace.WORLD, ShaderSpace.OBJECT)
    >>> product(view, model).told
    'camera_from_object'
    """
    if left.is_transposed != right.is_transposed:
        if left.is_rigid:
            left = _flipped(left)
        elif right.is_rigid:
            right = _flipped(right)
        else:
            return Matrix()
    size = min(left.size, right.size)
    if left.is_transposed:
        met = product(right.transposed, left.transposed)
        return replace(met.transposed, size=size)
    if left.source is not None and right.to is not None and left.source is not right.to:
        return Matrix()
    return Matrix(left.to, right.source, size=size, because=Because.ARITHMETIC)


def _flipped(rigid: Matrix) -> Matrix:
    """Write a matrix that only turns as the transpose of its inverse, which is the same."""
    return replace(rigid.inverse, is_transposed=not rigid.is_transposed)


def right_order(factors: tuple[Matrix, ...]) -> tuple[int, ...] | None:
    """Find the order in which all matrices of a product meet; None if they do as they stand.

    Examples
    --------
    >>> view = Matrix(ShaderSpace.CAMERA, ShaderSpace.WORLD)
    >>> model = Matrix(ShaderSpace.WORLD, ShaderSpace.OBJECT)
    >>> right_order((model, view)), right_order((view, model)) is None
    ((1, 0), True)
    """
    if not 2 <= len(factors) <= 4 or not all(one.is_known for one in factors):
        return None
    if len({one.is_transposed for one in factors}) > 1 or _meet(factors):
        return None
    orders = permutations(range(len(factors)))
    return next((one for one in orders if _meet(tuple(factors[i] for i in one))), None)


def _meet(factors: tuple[Matrix, ...]) -> bool:
    chain = [one.transposed for one in reversed(factors)] if factors[0].is_transposed else factors
    return all(left.source is right.to for left, right in pairwise(chain))


def moved(matrix: Matrix, vector: Vector) -> Vector:
    """Multiply a column vector by a matrix, and believe that both belong together.

    Examples
    --------
    >>> model = Matrix(ShaderSpace.WORLD, ShaderSpace.OBJECT)
    >>> normal = Vector(Carried.NORMAL, ShaderSpace.OBJECT, 3)
    >>> moved(model.inverse.transposed, normal).told
    'normal in world space'
    """
    to = matrix.source if matrix.is_transposed else matrix.to
    kind, w = vector.kind, vector.w
    if matrix.is_transposed and not matrix.is_rigid and matrix.is_known:
        is_whole = matrix.because is not Because.NAME  # a program may have cut one out of 3 × 3
        w = Fourth.LEFT_OVER if vector.size == 4 and is_whole else None
    elif matrix.has_projection:
        w = Fourth.DEPTH if vector.w in (Fourth.ONE, Fourth.DEPTH) else None
    elif not matrix.is_known:
        w = None if vector.w is Fourth.DEPTH else vector.w
    if kind is None and vector.w is Fourth.ONE and not matrix.is_transposed:
        kind = Carried.POINT
    return replace(
        vector,
        kind=kind,
        space=to,
        size=min(vector.size, matrix.size) or matrix.size,
        w=w,
        length=None,
        likely=None,
        is_assumed=False,
        via=matrix,
        because=Because.ARITHMETIC,
    )


def joined(one: Value, other: Value) -> Value:
    """Keep what two values have in common: that of two branches, or of two calls.

    Examples
    --------
    >>> up = Vector(Carried.NORMAL, ShaderSpace.WORLD, 3)
    >>> joined(up, replace(up, space=ShaderSpace.CAMERA)).told
    'normal'
    """
    if one == other:
        return one
    if isinstance(one, Vector) and isinstance(other, Vector):
        return _joined_vectors(one, other)
    if isinstance(one, Matrix) and isinstance(other, Matrix):
        return Matrix(size=max(one.size, other.size))
    if isinstance(one, Record) and isinstance(other, Record) and one.type == other.type:
        mine, yours = dict(one.fields), dict(other.fields)
        both = {
            name: joined(mine[name], yours[name]) if name in mine and name in yours else ANYTHING
            for name in mine.keys() | yours.keys()
        }
        return Record(one.type, one.path, tuple(sorted(both.items())))
    if isinstance(one, Scalar) and isinstance(other, Scalar):
        return Scalar()
    return ANYTHING


def _joined_vectors(one: Vector, other: Vector) -> Vector:
    kind = one.kind if one.kind is other.kind else None
    return Vector(
        kind=kind,
        space=one.space if one.space is other.space else None,
        size=one.size if one.size == other.size else 0,
        w=one.w if one.w is other.w else None,
        role=one.role if one.role is other.role else None,
        sense=one.sense if one.sense is other.sense else Sense.UNKNOWN,
        length=one.length if one.length is other.length else None,
        likely=one.likely if one.likely is other.likely else None,
        is_assumed=one.is_assumed or other.is_assumed,
        is_reflected=one.is_reflected and other.is_reflected,
        because=Because.ARITHMETIC,
        origin=one.origin if one.origin == other.origin else "",
    )
