"""What a value means: a map from one space to another, or a thing of a kind in a space.

Places and directions move by a matrix A, normals by its inverse transpose. So a map knows its two
spaces and what it carries, and inverting or transposing it gives a map again. What is not known is
None, and goes anywhere. A vector whose kind is known leaves its w out, since the kind tells it;
only a point in clip space keeps it, until it is divided.
"""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from nmatrix.enums import Frame


class Kind(StrEnum):
    """What a vector is: how a map carries it follows from this.

    `VECTOR` is what is left of a point by an operation after which it is no place any more, or not
    yet one again, such as half of it.
    """

    POINT = "point"
    DIRECTION = "direction"
    NORMAL = "normal"
    VECTOR = "vector"


class Carries(StrEnum):
    """What a map carries rightly.

    `BACK` is Aᵀ, which carries normals the other way; `FLIPPED` are the cofactors of a mirror,
    which turn normals inside out; `ALL` is a map that is its own inverse transpose.
    """

    PLACES = "points and directions"
    NORMALS = "normals"
    BACK = "normals back"
    FLIPPED = "normals turned inside out"
    ALL = "points, directions and normals"


@dataclass(frozen=True)
class Map:
    """A matrix that leads from the space `source` to the space `to`.

    Examples
    --------
    >>> M = Map(Frame.WORLD, Frame.OBJECT)
    >>> print(M.inverse, "|", M.transpose, "|", M.inverse_transpose)
    object ← world | object ← world, for normals | world ← object, for normals
    """

    to: Frame | None = None
    source: Frame | None = None
    carries: Carries = Carries.PLACES

    def __str__(self) -> str:
        if not (self.to or self.source):
            return ""
        ends = f"{self.to or '?'} ← {self.source or '?'}"
        return f"{ends}, for normals" if self.carries in FOR_NORMALS else ends

    @property
    def inverse(self) -> Map:
        """The way back."""
        return Map(self.source, self.to, _INVERTED.get(self.carries, self.carries))

    @property
    def transpose(self) -> Map | None:
        """The transposed map, of which is not known if it turns only; None for a mirror's."""
        carries = _TRANSPOSED.get(self.carries)
        return None if carries is None else Map(self.source, self.to, carries)

    @property
    def inverse_transpose(self) -> Map | None:
        """The map that carries normals where this one carries places, or the other way."""
        if self.carries is Carries.PLACES:
            return Map(self.to, self.source, Carries.NORMALS)
        return self if self.carries is Carries.ALL else self.inverse.transpose


@dataclass(frozen=True)
class Located:
    """A vector of a kind, in a space.

    Examples
    --------
    >>> print(Located(Frame.CAMERA, Kind.DIRECTION))
    camera direction
    """

    space: Frame | None
    kind: Kind

    def __str__(self) -> str:
        return f"{self.space} {self.kind}" if self.space else str(self.kind)


Meaning = Map | Located

FOR_NORMALS = (Carries.NORMALS, Carries.BACK, Carries.FLIPPED)
_INVERTED = {Carries.NORMALS: Carries.BACK, Carries.BACK: Carries.NORMALS}
_TRANSPOSED = {
    Carries.PLACES: Carries.BACK,
    Carries.ALL: Carries.BACK,
    Carries.NORMALS: Carries.PLACES,
    Carries.BACK: Carries.PLACES,
}
# The maps of a scene, by the names that they have in every expression.
SCENE = {
    "M": Map(Frame.WORLD, Frame.OBJECT),
    "V": Map(Frame.CAMERA, Frame.WORLD),
    "P": Map(Frame.CLIP, Frame.CAMERA),
}
_HOMOGENEOUS = {Frame.CLIP, Frame.NDC}  # one space before and after the division by w


def meets(one: Frame | None, other: Frame | None) -> bool:
    """Tell if a map may begin in a space where something is, as far as both are known.

    Normalised device coordinates are clip coordinates whose w is 1, and a matrix does not mind.
    """
    return one is None or other is None or one is other or {one, other} == _HOMOGENEOUS
