"""`cost normals`: every method on easy and hard matrices: worst error, wrong answers, time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import partial
from math import pi
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.angle import exact_angle_between
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rounding import integers, nearest
from nmatrix.studies.harness import SEED, Harness
from nmatrix.studies.methods import METHODS, Method, method
from nmatrix.studies.rows import Row, Task

Array = NDArray[Any]

KAPPAS = (1e0, 1e4, 1e8, 1e12, 1e16)
BATCH = 100_000
ONE = "one matrix"


@dataclass(frozen=True, eq=False)
class Family:
    """Matrices and normals of one kind."""

    name: str
    matrices: Array
    normals: Array

    def first(self, count: int) -> Family:
        """Return the first few of them."""
        return replace(self, matrices=self.matrices[:count], normals=self.normals[:count])


@dataclass(frozen=True)
class Extent:
    """How much to measure: matrices whose answers are checked, in a batch, and κ's."""

    checked: int = 200
    batch: int = BATCH
    kappas: tuple[float, ...] = KAPPAS
    slow_methods: bool = True


QUICK = Extent(checked=20, batch=1_000, kappas=(1e0, 1e8, 1e16), slow_methods=False)
SLOW = {"exact", "solve", "qr"}  # one matrix after the other


def families(count: int, kappas: tuple[float, ...]) -> Iterator[Family]:
    """Return matrices by condition, then with exponents that leave the range of squares.

    Adversarial normals all but cancel; mixed exponents differ between the entries of one matrix.
    """
    rng = np.random.default_rng(SEED)
    for kappa in kappas:
        U, V = (np.linalg.qr(rng.normal(size=(count, 3, 3)))[0] for _ in range(2))
        A = U * np.array([1.0, kappa**-0.5, 1.0 / kappa]) @ V
        yield Family(f"κ = {kappa:.0e}, random", A, rng.normal(size=(count, 3)))
        if kappa > 1:
            near = V[:, 0] + 1e-9 * rng.normal(size=(count, 3))
            yield Family(f"κ = {kappa:.0e}, adversarial", A, near)
    Q = np.linalg.qr(rng.normal(size=(count, 3, 3)))[0]
    scale = 10.0 ** rng.integers(-300, 300, size=(count, 1, 1))
    yield Family("extreme exponents", Q * scale, rng.normal(size=(count, 3)))
    rows = rng.integers(-200, 201, size=(count, 3, 1))
    mixed = np.ldexp(Q, rows + rng.integers(-200, 201, size=(count, 1, 3)))
    yield Family("mixed exponents", mixed, rng.normal(size=(count, 3)))


@dataclass(frozen=True)
class Errors:
    """Angles to the true normals in radians, and how many answers are wrong, in which way."""

    worst: float
    median: float
    not_a_number: int = 0
    zero: int = 0
    flipped: int = 0
    not_reported: int = 0

    @property
    def failures(self) -> int:
        """Return how many answers are wrong."""
        return self.not_a_number + self.zero + self.flipped + self.not_reported


def errors(carried: Array, family: Family) -> Errors:
    """Return what became of a family's normals, measured against whole numbers."""
    angles, wrong = [], Counter[str]()
    for A, n, found in zip(
        family.matrices.tolist(), family.normals.tolist(), carried.tolist(), strict=True
    ):
        true = _true_normal(LinearMap.of(A), n)
        if true is None:
            wrong["not_reported"] += any(found)
        elif not np.isfinite(found).all():
            wrong["not_a_number"] += 1
        elif not any(found):
            wrong["zero"] += 1
        else:
            angles.append(nearest(exact_angle_between(true, integers(found)[0])))
            wrong["flipped"] += angles[-1] > pi / 2
    return Errors(max(angles, default=0.0), median(angles) if angles else 0.0, **wrong)


def _true_normal(linear_map: LinearMap, n: Sequence[float]) -> list[int] | None:
    if linear_map.normal(n).direction is None:
        return None
    sign = -1 if linear_map.integer_determinant < 0 else 1
    given = [Fraction(x) for x in n]
    true = [sign * sum(c * x for c, x in zip(r, given, strict=True)) for r in linear_map.cofactors]
    return integers(true)[0]


def tasks(harness: Harness, extent: Extent) -> list[Task]:
    """Return every method on every family still to be measured, in a batch and on one matrix."""
    found: list[Task] = []
    for family in families(extent.batch, extent.kappas):
        checked = family.first(extent.checked)
        methods = [one for one in METHODS if extent.slow_methods or one.name not in SLOW]
        found += [partial(_row, harness, one, family, checked) for one in methods]
    for family in families(1, extent.kappas):
        if family.name.endswith("random"):
            alone = replace(family, name=f"{ONE}, {family.name.partition(',')[0]}")
            found += [partial(_row, harness, one, alone, alone) for one in METHODS]
    return found


def _row(harness: Harness, one: Method, family: Family, checked: Family) -> Row:
    found = errors(one.normals(checked.matrices, checked.normals), checked)
    is_long = one.name in SLOW and len(family.matrices) > len(checked.matrices)
    A, n = (checked if is_long else family).matrices, (checked if is_long else family).normals
    reference = method("inverse")
    timing = harness.ratio(lambda: one.normals(A, n), lambda: reference.normals(A, n))
    if len(family.matrices) > 1:  # times of batches are those of 10⁵ normals
        timing = replace(timing, seconds=timing.seconds * BATCH / len(A))
    more = {
        "matrices": len(checked.matrices),
        "median_error": found.median,
        "not_a_number": found.not_a_number,
        "zero": found.zero,
        "flipped": found.flipped,
        "not_reported": found.not_reported,
    }
    return Row(one.name, checked.name, found.worst, "rad", timing, found.failures, more=more)
