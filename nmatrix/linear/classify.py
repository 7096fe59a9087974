"""What kind of map a matrix is, decided exactly on the given floats and again to rounding.

A is the 3×3 block, G = AᵀA. A itself carries normals exactly when G = s²I; a matrix built from
a rotation by 30° fulfils that to rounding only, and both facts are worth knowing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cached_property

from nmatrix.enums import Kind
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import RationalVector, linear, rational, translation
from nmatrix.linear.rounding import in_short
from nmatrix.linear.spectrum import condition, gram, worst_angle_deg

BUILT = 1e-12  # columns of a matrix built from angles agree to a few 1e-16; room for products
FROM_FILE = 1e-6  # float32 files: 6e-8 a component, room for products

RIGID_KINDS = {Kind.IDENTITY, Kind.TRANSLATION, Kind.ROTATION, Kind.RIGID}
_NEEDS_INVERSE_TRANSPOSE = {Kind.NON_UNIFORM_SCALE, Kind.SHEAR, Kind.SINGULAR}


@dataclass(frozen=True)
class Classification:
    """The kind of one map, with the numbers that belong to it."""

    kind: Kind
    kind_exact: bool
    linear_map: LinearMap

    @property
    def determinant_sign(self) -> int:
        """Return the exact sign of the determinant."""
        return self.linear_map.determinant_sign

    @property
    def mirrored(self) -> bool:
        """Return whether the map turns left hands into right hands."""
        return self.determinant_sign < 0

    @property
    def rank(self) -> int:
        """Return the exact rank of the 3×3 block."""
        return self.linear_map.rank

    @property
    def needs_inverse_transpose(self) -> bool:
        """Return whether A itself would bend normals."""
        return self.kind in _NEEDS_INVERSE_TRANSPOSE

    @property
    def is_rigid(self) -> bool:
        """Return whether lengths and angles stay as they are."""
        return self.kind in RIGID_KINDS

    @cached_property
    def condition(self) -> Fraction | None:
        """Return κ = σ₁/σ₃, or None for a singular map."""
        kappa = condition(self.linear_map)
        return None if kappa is None else Fraction(kappa)

    @property
    def condition_text(self) -> str:
        """Return κ in four digits, also where it is beyond every float; ∞ for a singular map."""
        kappa = self.condition
        if kappa is None:
            return "∞"
        return in_short(kappa, 4)

    @cached_property
    def worst_angle_deg(self) -> float | None:
        """Return the largest angle that A n can be wrong by, in degrees."""
        return worst_angle_deg(self.linear_map)


def classify(
    rows: Sequence[Sequence[float | Fraction]], tolerance: float | Fraction = BUILT
) -> Classification:
    """Say what kind of map a 3×3 or an affine 4×4 matrix is.

    Rank and mirroring are exact. Lengths and angles of the columns may be off by `tolerance`
    (relative); `kind_exact` says whether the kind holds without it.

    Examples
    --------
    >>> found = classify([[0, 2, 0], [2, 0, 0], [0, 0, 2]])
    >>> found.kind.value, found.kind_exact, found.mirrored
    ('similarity', True, True)
    """
    A = rational(rows)
    offset = translation(A) if len(A) == 4 else (Fraction(0),) * 3
    linear_map = LinearMap.of(linear(A))
    kind = _kind(linear_map, offset, Fraction(tolerance))
    exact = kind if tolerance == 0 else _kind(linear_map, offset, Fraction(0))
    return Classification(kind, kind is exact, linear_map)


def _kind(linear_map: LinearMap, offset: RationalVector, tau: Fraction) -> Kind:
    if linear_map.rank < 3:
        return Kind.SINGULAR
    G = gram(linear_map)
    if not _orthogonal(G, tau):
        return Kind.SHEAR
    lengths = [G[i][i] for i in range(3)]
    if max(lengths) > (1 + tau) ** 2 * min(lengths):
        return Kind.NON_UNIFORM_SCALE
    one = linear_map.denominator**2
    if max(lengths) > (1 + tau) ** 2 * one or one > (1 + tau) ** 2 * min(lengths):
        return Kind.SIMILARITY
    if _is_identity(linear_map, tau):
        return Kind.TRANSLATION if any(offset) else Kind.IDENTITY
    return Kind.RIGID if any(offset) else Kind.ROTATION


def _orthogonal(G: list[list[int]], tau: Fraction) -> bool:
    pairs = ((0, 1), (0, 2), (1, 2))
    return all(G[i][j] ** 2 <= tau * tau * G[i][i] * G[j][j] for i, j in pairs)


def _is_identity(linear_map: LinearMap, tau: Fraction) -> bool:
    one = linear_map.denominator
    return all(
        abs(entry - one * (i == j)) <= tau * one
        for i, row in enumerate(linear_map.entries)
        for j, entry in enumerate(row)
    )
