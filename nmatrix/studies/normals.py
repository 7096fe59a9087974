"""`cost normals`: every method on easy and hard matrices: worst error, wrong answers, time."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from math import pi
from statistics import median
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.studies.hardcases.case import CaseVerdict, judge
from nmatrix.studies.hardcases.oracle import exact_rows, true_normal
from nmatrix.studies.harness import SEED, Timed, calls
from nmatrix.studies.measurements import Measurement, Task, Unit
from nmatrix.studies.methods import METHODS, Method, method

Array = NDArray[Any]

KAPPAS = (1e0, 1e4, 1e8, 1e12, 1e16)
BATCH = 100_000
ONE = "one matrix"
REFERENCE = "inverse"


@dataclass(frozen=True, eq=False)
class Family:
    """Matrices and normals of one kind."""

    name: str
    matrices: Array
    normals: Array

    @cached_property
    def true_normals(self) -> list[tuple[Fraction, ...] | None]:
        """Multiples of the exact normals; None where a map leaves no normal."""
        return [
            true_normal(exact_rows(A), [Fraction(x) for x in n])
            for A, n in zip(self.matrices.tolist(), self.normals.tolist(), strict=True)
        ]

    def first(self, count: int) -> Family:
        """Return a family of the first few."""
        return replace(self, matrices=self.matrices[:count], normals=self.normals[:count])


@dataclass(frozen=True)
class Extent:
    """How much to measure: matrices whose answers are checked, matrices a batch, and κ's."""

    checked: int = 200
    batch: int = BATCH
    kappas: tuple[float, ...] = KAPPAS
    slow_methods: bool = True


FULL = Extent()
QUICK = Extent(checked=20, batch=1_000, kappas=(1e0, 1e8, 1e16), slow_methods=False)


def families(count: int, kappas: tuple[float, ...]) -> Iterator[Family]:
    """Generate matrices by condition number, then with exponents whose squares leave the range.

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


WRONG = {
    "not_a_number": CaseVerdict.NAN,
    "zero": CaseVerdict.ZERO,
    "flipped": CaseVerdict.FLIPPED,
    "not_reported": CaseVerdict.NOT_REPORTED,
}


@dataclass(frozen=True)
class Errors:
    """Angles to the true normals in radians, and the number of answers of each verdict."""

    worst: float
    median: float
    verdicts: Counter[CaseVerdict]

    @property
    def failures(self) -> int:
        """The number of wrong answers of all kinds."""
        return sum(self.verdicts[verdict] for verdict in WRONG.values())


def errors(carried: Array, family: Family) -> Errors:
    """Compare carried normals with the exact ones; (0, 0, 0) says that there is no normal.

    A wrong answer without a direction is off by π, as much as one can be.
    """
    angles, verdicts = [], Counter[CaseVerdict]()
    for found, true in zip(carried.tolist(), family.true_normals, strict=True):
        says_none = true is None and not any(found)
        verdict, error = judge(None if says_none else found, true, is_direction=True)
        verdicts[verdict] += 1
        if error is not None:
            angles.append(error)
        elif verdict is not CaseVerdict.RIGHT:
            angles.append(pi)
    return Errors(max(angles, default=0.0), median(angles) if angles else 0.0, verdicts)


def tasks(timed: Timed, extent: Extent) -> list[Task]:
    """List the measurements: every method on every family, in a batch and on one matrix."""
    found: list[Task] = []
    for family in families(extent.batch, extent.kappas):
        checked = family.first(extent.checked)
        methods = [one for one in METHODS if extent.slow_methods or one.is_batched]
        found += [partial(_row, timed, one, family, checked) for one in methods]
    for family in families(1, extent.kappas):
        if family.name.endswith("random"):
            alone = replace(family, name=f"{ONE}, {family.name.partition(',')[0]}")
            found += [partial(_row, timed, one, alone, alone) for one in METHODS]
    return found


def _row(timed: Timed, one: Method, family: Family, checked: Family) -> Measurement:
    found = errors(one.normals(checked.matrices, checked.normals), checked)
    is_long = not one.is_batched and len(family.matrices) > len(checked.matrices)
    A, n = (checked if is_long else family).matrices, (checked if is_long else family).normals
    reference = method(REFERENCE)
    work = one.multiplications + calls(lambda: one.normals(A, n)) / len(A)
    timing = timed(lambda: one.normals(A, n), lambda: reference.normals(A, n))
    if timing is not None and len(family.matrices) > 1:  # as long as 10⁵ normals take
        timing = replace(timing, seconds=timing.seconds * BATCH / len(A))
    more = {
        "matrices": len(checked.matrices),
        "median_error": found.median,
        **{name: found.verdicts[verdict] for name, verdict in WRONG.items()},
    }
    return Measurement(
        one.name,
        checked.name,
        found.worst,
        Unit.RADIANS,
        timing,
        work,
        found.failures,
        is_reference=one is reference,
        more=more,
    )
