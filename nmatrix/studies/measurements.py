"""What a study measured: methods in settings, the Pareto front, and the best row for a target."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

from nmatrix.studies.harness import Ratio


class Study(StrEnum):
    """The studies of `nmatrix cost`."""

    NORMALS = "normals"
    SHADING = "shading"
    SPACES = "spaces"


class Unit(StrEnum):
    """The unit of a study's errors."""

    RADIANS = "rad"
    LEVELS = "levels"
    MULTIPLICATIONS = "multiplications a vertex"


@dataclass(frozen=True)
class Measurement:
    """One row of a study: the error, the time and the counted work of one method in one setting.

    `timing` is None where the clock could not be trusted; `work` is the same on every machine.
    `failures` counts wrong answers: not a number, zero, flipped, or undefined and not reported.
    `is_reference` marks the rows that are timed against themselves. `more` are further figures by
    name. Rows of one `setting` compete.
    """

    method: str
    setting: str
    error: float
    unit: Unit
    timing: Ratio | None
    work: float
    failures: int = 0
    on_front: bool = False
    is_reference: bool = False
    more: Mapping[str, float | int | None] = field(default_factory=dict)

    @property
    def rank(self) -> tuple[int, float]:
        """Sort key by badness: failures first, then the error."""
        return self.failures, self.error

    @property
    def price(self) -> float:
        """What a row costs beside the others: its time over the reference's, else its work."""
        return self.work if self.timing is None else self.timing.ratio


Task = Callable[[], Measurement]  # one row still to be measured


def by_setting(rows: Sequence[Measurement]) -> dict[str, list[Measurement]]:
    """Group rows by their setting, in order of appearance; within a setting the cheapest first."""
    found: dict[str, list[Measurement]] = {}
    for row in rows:
        found.setdefault(row.setting, []).append(row)
    for group in found.values():
        group.sort(key=lambda row: row.price)
    return found


def with_fronts(rows: Sequence[Measurement]) -> tuple[Measurement, ...]:
    """Mark in each setting the rows without a failure that no other beats in price and error.

    Examples
    --------
    >>> fast, slow, slower = (Ratio(t, t, t, t) for t in (1.0, 2.0, 3.0))
    >>> rows = [Measurement("a", "s", 9, Unit.RADIANS, fast, 1),
    ...         Measurement("b", "s", 1, Unit.RADIANS, slow, 1),
    ...         Measurement("c", "s", 5, Unit.RADIANS, slower, 1),
    ...         Measurement("d", "s", 0, Unit.RADIANS, fast, 1, failures=3)]
    >>> [row.on_front for row in with_fronts(rows)]
    [True, True, False, False]
    """

    def is_on_front(row: Measurement) -> bool:
        rivals = (other for other in rows if other.setting == row.setting)
        return not row.failures and not any(_beats(other, row) for other in rivals)

    return tuple(replace(row, on_front=is_on_front(row)) for row in rows)


def _beats(a: Measurement, b: Measurement) -> bool:
    no_worse = a.price <= b.price and a.rank <= b.rank
    return no_worse and (a.price < b.price or a.rank < b.rank)


def without_times(rows: Sequence[Measurement]) -> list[Measurement]:
    """Leave out the times, which the clock turned out to be no good for."""
    return [replace(row, timing=None) for row in rows]


def overall(rows: Sequence[Measurement]) -> tuple[Measurement, ...]:
    """Sum each method up in one row: its worst error, highest price and longest time anywhere.

    Who asks for an accuracy does not know which matrices will come.
    """
    found = []
    for name in dict.fromkeys(row.method for row in rows):
        mine = [row for row in rows if row.method == name]
        dearest = max(mine, key=lambda row: row.price)
        worst = max(mine, key=lambda row: row.error)
        failures = sum(row.failures for row in mine)
        timing = dearest.timing
        if timing is not None:
            seconds = max(row.timing.seconds for row in mine if row.timing is not None)
            timing = replace(timing, seconds=seconds)
        found.append(
            replace(
                worst,
                setting="everywhere",
                timing=timing,
                work=dearest.work,
                failures=failures,
            )
        )
    return with_fronts(found)


@dataclass(frozen=True)
class Target:
    """What is asked of a study: an error that is good enough, a time budget, or neither.

    `tolerance` is in the study's own unit; `seconds` are for one call of what was timed.
    """

    tolerance: float | None = None
    seconds: float | None = None

    def met_by(self, rows: Sequence[Measurement]) -> Measurement | None:
        """Find the cheapest right row within the tolerance, or the most accurate in the budget.

        No row is known to keep a budget whose time is not told.
        """
        if self.tolerance is not None:
            good = [row for row in rows if row.rank <= (0, self.tolerance)]
            return min(good, key=lambda row: row.price, default=None)
        if self.seconds is None:
            return None
        quick = [row for row in rows if row.timing and row.timing.seconds <= self.seconds]
        return min(quick, key=lambda row: row.rank, default=None)
