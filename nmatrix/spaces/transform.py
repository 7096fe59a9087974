"""A matrix that knows its frames: `to_from_source`, with three verbs for three kinds of things.

Points move with the translation, vectors without it, normals by the inverse transpose. Frames
that do not meet refuse to multiply.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import Frame
from nmatrix.errors import FrameError, IllegalValueError, NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalMatrix, RationalVector, Rows, to_floats
from nmatrix.linear.rounding import nearest


@dataclass(frozen=True)
class Transform:
    """An affine map from one frame to another, held exactly.

    Parameters
    ----------
    to, source
        The frame that it leads to, and the one that it comes from.
    exact
        A 3×3 or an affine 4×4 matrix of fractions or floats, such as an array; kept as a 4×4 matrix
        of fractions, which is what every float is.

    Raises
    ------
    IllegalValueError
        If an entry is not a finite number, or the matrix is not affine.

    Examples
    --------
    >>> from nmatrix.linear.affine import compose, translation_matrix
    >>> camera_from_world = Transform(Frame.CAMERA, Frame.WORLD, translation_matrix((0, 0, -5)))
    >>> world_from_object = Transform(Frame.WORLD, Frame.OBJECT, translation_matrix((1, 0, 0)))
    >>> (camera_from_world @ world_from_object).point((0, 0, 0))
    (1.0, 0.0, -5.0)
    >>> world_from_object @ camera_from_world
    Traceback (most recent call last):
    nmatrix.errors.FrameError: world_from_object @ camera_from_world: ...
    """

    to: Frame
    source: Frame
    exact: RationalMatrix

    def __post_init__(self) -> None:
        object.__setattr__(self, "exact", _affine(self.exact, self.name))

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

    def _repr_latex_(self) -> str:
        """Show the matrix under its name in a notebook."""
        rows = r" \\ ".join(" & ".join(map(_in_latex, row)) for row in self.matrix)
        name = self.name.replace("_", r"\_")
        return rf"$\mathtt{{{name}}} = \begin{{bmatrix}} {rows} \end{{bmatrix}}$"

    def __matmul__(self, other: Transform) -> Transform:
        """Compose two maps, the right one first; the inner frames must be the same."""
        if self.source is not other.to:
            raise FrameError(
                f"{self.name} @ {other.name}",
                f"the inner frames must meet, and {self.source} is not {other.to}",
                f"put a map {self.source}_from_{other.to} between them, or swap the two",
            )
        return Transform(self.to, other.source, rational.product(self.exact, other.exact))

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

    def point(self, point: Sequence[float]) -> tuple[float, ...]:
        """Transform a point (w = 1: it moves along), each component rounded once."""
        return tuple(map(nearest, self.exact_point(rational.rational_vector(point))))

    def vector(self, vector: Sequence[float]) -> tuple[float, ...]:
        """Transform a vector (w = 0: no translation), each component rounded once."""
        return tuple(map(nearest, self.exact_vector(rational.rational_vector(vector))))

    def normal(self, normal: Sequence[float]) -> tuple[float, ...]:
        """Transform a normal to length one in the target frame; it keeps to the outward side.

        Raises
        ------
        NoAnswerError
            If the map leaves this normal without an image.
        """
        found = self.linear_map.normal(normal)
        if found.direction is None:
            raise NoAnswerError(
                f"a normal through {self.name}", found.reason, "give every axis a scale"
            )
        return found.direction

    def exact_point(self, point: RationalVector) -> RationalVector:
        """Transform a point without rounding."""
        return tuple(rational.dot(row[:3], point) + row[3] for row in self.exact[:3])

    def exact_vector(self, vector: RationalVector) -> RationalVector:
        """Transform a vector without rounding."""
        return rational.apply(rational.linear_part(self.exact), vector)


def _affine(rows: Sequence[Sequence[float | Fraction]], name: str) -> RationalMatrix:
    """Take an affine 4×4 matrix exactly, or a 3×3 block without a translation."""
    try:
        # An array's own numbers, such as float32, are no fractions; its list holds Python's.
        exact = rational.rational_matrix(getattr(rows, "tolist", lambda: rows)())
    except (TypeError, ValueError, OverflowError):
        raise IllegalValueError(
            name, "an entry is not a finite number", "give three or four rows of finite numbers"
        ) from None
    if [len(row) for row in exact] == [3, 3, 3]:
        return rational.affine_matrix(exact)
    if not rational.is_affine(exact) or any(len(row) != 4 for row in exact):
        raise IllegalValueError(
            name,
            "it is neither 3×3 nor a 4×4 matrix with the last row 0 0 0 1",
            "give an affine matrix; a projection is none",
        )
    return exact


def _in_latex(value: float) -> str:
    mantissa, power, exponent = f"{value:.6g}".partition("e")
    return rf"{mantissa} \times 10^{{{int(exponent)}}}" if power else mantissa
