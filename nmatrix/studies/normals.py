"""`cost normals`: every method on easy and hard matrices: worst error, wrong answers, time."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from math import pi
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.linear.exact import LinearMap
from nmatrix.linear.methods import METHODS, Method, method
from nmatrix.linear.rounding import angle, integers
from nmatrix.studies.harness import Harness
from nmatrix.studies.rows import Row, with_fronts

Array = NDArray[Any]

KAPPAS = (1e0, 1e4, 1e8, 1e12, 1e16)
BATCH = 100_000
SEED = 7
ONE = "one matrix"


@dataclass(frozen=True, eq=False)
class Family:
    """Matrices and normals of one kind."""

    name: str
    matrices: Array
    normals: Array


@dataclass(frozen=True)
class Extent:
    """How much to measure: matrices whose answers are checked, in a batch, and κ's."""

    checked: int = 200
    batch: int = BATCH
    kappas: tuple[float, ...] = KAPPAS
    slow_methods: bool = True


QUICK = Extent(checked=25, batch=2_000, kappas=(1e0, 1e8, 1e16), slow_methods=False)
SLOW = {"exact", "solve", "qr"}  # one matrix after the other


def families(count: int, kappas: tuple[float, ...]) -> Iterator[Family]:
    """Return matrices by condition: random normals, adversarial ones, extreme exponents."""
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


def errors(carried: Array, family: Family) -> tuple[float | None, int]:
    """Return the worst angle to the true normals in radians, and how many answers are wrong."""
    worst, failures = 0.0, 0
    for A, n, found in zip(
        family.matrices.tolist(), family.normals.tolist(), carried.tolist(), strict=True
    ):
        linear_map = LinearMap.of(A)
        if linear_map.normal(n).direction is None:
            failures += any(found)
            continue
        if not np.isfinite(found).all() or not any(found):
            failures += 1
            continue
        sign = -1 if linear_map.integer_determinant < 0 else 1
        given = [Fraction(x) for x in n]
        true = [
            sign * sum(c * x for c, x in zip(r, given, strict=True)) for r in linear_map.cofactors
        ]
        error = angle(integers(true)[0], integers([Fraction(x) for x in found])[0])
        failures += error > pi / 2
        worst = max(worst, error)
    return worst, failures


def study(harness: Harness, extent: Extent) -> Iterator[Row]:
    """Measure every method on every family, in a batch and on one matrix."""
    reference = method("inverse")
    for family in families(extent.batch, extent.kappas):
        checked = Family(
            family.name, family.matrices[: extent.checked], family.normals[: extent.checked]
        )
        for one in METHODS:
            if one.name in SLOW and not extent.slow_methods:
                continue
            yield _row(harness, one, reference, family, checked)
    single = next(families(1, (1e0,)))
    for one in METHODS:
        checked = Family(ONE, single.matrices, single.normals)
        yield _row(harness, one, reference, checked, checked)


def _row(harness: Harness, one: Method, reference: Method, family: Family, checked: Family) -> Row:
    worst, failures = errors(one.normals(checked.matrices, checked.normals), checked)
    timed = family
    if one.name in SLOW and len(family.matrices) > len(checked.matrices):
        timed = checked
    A, n = timed.matrices, timed.normals
    timing = harness.ratio(lambda: one.normals(A, n), lambda: reference.normals(A, n))
    if family.name != ONE:  # times of batches are those of 10⁵ normals, whatever was measured
        timing = replace(timing, seconds=timing.seconds * BATCH / len(A))
    return Row(one.name, checked.name, worst, "rad", timing, failures)


def normals(harness: Harness, extent: Extent) -> tuple[Row, ...]:
    """Return all the rows, with the fronts marked."""
    return with_fronts(list(study(harness, extent)))
