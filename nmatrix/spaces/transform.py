"""A matrix that knows its frames: `to_from_source`, with three verbs for three kinds of things.

Points move with the translation, vectors without it, normals by the inverse transpose. Frames
that do not meet refuse to multiply.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial

from nmatrix.enums import Frame, chosen
from nmatrix.errors import FrameError, NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalMatrix, RationalVector, Rows, to_floats
from nmatrix.linear.rounding import nearest
from nmatrix.linear.values import named, read_fields, vector
from nmatrix.reading.arrays import read_affine
from nmatrix.report import Displayed, Quantity, Report


@dataclass(frozen=True)
class Transform(Displayed):
    """An affine map from one frame to another, held exactly.

    Parameters
    ----------
    to, source
        The frames, or their words: object, world, camera, light, static, custom.
    exact
        A (3, 3) or affine (4, 4) matrix: exact fractions, or any array-like.

    Raises
    ------
    IllegalValueError
        For an unknown frame, or a matrix that is not affine.

    Examples
    --------
    >>> camera_from_world = Transform.of("camera", "world", [[1, 0, 0], [0, 0, 1], [0, -1, 0]])
    >>> world_from_object = Transform.of("world", "object", [[2, 0, 0], [0, 1, 0], [0, 0, 1]])
    >>> (camera_from_world @ world_from_object).point((1, 0, 3))
    (2.0, 3.0, 0.0)
    >>> world_from_object @ camera_from_world
    Traceback (most recent call last):
    nmatrix.errors.FrameError: world_from_object @ camera_from_world: ...
    """

    to: Frame
    source: Frame
    exact: RationalMatrix

    __array_ufunc__ = None  # NumPy asks here what an array @ a transform is, and not each entry

    def __post_init__(self) -> None:
        read_fields(
            self,
            to=partial(chosen, Frame),
            source=partial(chosen, Frame),
            exact=named("matrix", read_affine),
        )

    @classmethod
    def of(cls, to: Frame | str, source: Frame | str, matrix: object) -> Transform:
        """Return the transform of an array-like `to_from_source`; NumPy's floats are exact here.

        Examples
        --------
        >>> Transform.of("world", "object", [[1, 0, 0], [0, 2, 0], [0, 0, 1]]).normal((1, 2, 0))
        (0.7071067811865476, 0.7071067811865476, 0.0)
        """
        return cls(to, source, matrix)  # type: ignore[arg-type]  # all three are read there

    def __repr__(self) -> str:
        """Return the name and the rows in floats."""
        return f"Transform({self.name}, {[list(row) for row in self.matrix]})"

    @property
    def name(self) -> str:
        """The name, target first: `camera_from_world`."""
        return f"{self.to}_from_{self.source}"

    @property
    def matrix(self) -> Rows:
        """Return the 4×4 matrix, each entry rounded once."""
        return to_floats(self.exact)

    @property
    def linear_map(self) -> LinearMap:
        """Return the 3×3 block at the exact level."""
        return LinearMap.of(rational.linear_part(self.exact))

    def _repr_report_(self) -> Report:
        """Tell where it leads, where it comes from, and its matrix."""
        return Report.of_value(Quantity(self.name, self.exact, f"{self.to} ← {self.source}"))

    def __matmul__(self, other: Transform) -> Transform:
        """Compose two maps, the right one first; the inner frames must be the same."""
        if not isinstance(other, Transform):
            raise self._frameless(other)
        if self.source is not other.to:
            raise FrameError(
                f"{self.name} @ {other.name}",
                f"the inner frames must meet, and {self.source} is not {other.to}",
                f"put a map {self.source}_from_{other.to} between them, or swap the two",
            )
        return Transform(self.to, other.source, rational.product(self.exact, other.exact))

    def __rmatmul__(self, other: object) -> Transform:
        """Refuse what knows no frames on the left, too."""
        raise self._frameless(other)

    def _frameless(self, other: object) -> FrameError:
        return FrameError(
            f"{self.name} and a {type(other).__name__}",
            "only two transforms compose: an array knows no frames",
            "ask point, vector or normal for an image, or multiply with .matrix",
        )

    def inverse(self) -> Transform:
        """Invert the map.

        Raises
        ------
        NoAnswerError
            If the map is singular.
        """
        if not self.linear_map.integer_determinant:
            raise NoAnswerError(
                f"{self.name} (determinant 0)",
                f"it flattens space to rank {self.linear_map.rank}, so there is no way back",
                "give every axis a scale other than 0",
            )
        return Transform(self.source, self.to, rational.inverse(self.exact))

    def point(self, point: object) -> tuple[float, ...]:
        """Return a point of the source frame in the target frame (w = 1: it moves along)."""
        return tuple(map(nearest, self.exact_point(point)))

    def vector(self, vector: object) -> tuple[float, ...]:
        """Return a vector of the source frame in the target frame (w = 0: no translation)."""
        return tuple(map(nearest, self.exact_vector(vector)))

    def normal(self, normal: object) -> tuple[float, ...]:
        """Return a normal in the target frame, at length one, outward side kept.

        Raises
        ------
        NoAnswerError
            If the map leaves this normal without an image.
        """
        found = self.linear_map.normal(_exact(normal, "normal"))
        if found.direction is None:
            next_step = (
                "give every axis a scale" if any(vector(normal, "normal")) else "give another"
            )
            raise NoAnswerError(f"a normal through {self.name}", found.reason, next_step)
        return found.direction

    def exact_point(self, point: object) -> RationalVector:
        """Return the image of a point without rounding."""
        p = _exact(point, "point")
        return tuple(rational.dot(row[:3], p) + row[3] for row in self.exact[:3])

    def exact_vector(self, vector: object) -> RationalVector:
        """Return the image of a vector without rounding."""
        return rational.apply(rational.linear_part(self.exact), _exact(vector, "vector"))


def _exact(values: object, name: str) -> RationalVector:
    return rational.rational_vector(vector(values, name))
