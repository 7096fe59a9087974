"""What a study measured: methods in settings, the Pareto front, and the best row for a target."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum
from math import inf

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
    """One row of a study: the error and the time of one method in one setting.

    `error` is None where there is no error to speak of; `failures` counts wrong answers: not a
    number, zero, flipped, or undefined and not reported. `more` are further figures by name. Rows
    of one `setting` compete.
    """

    method: str
    setting: str
    error: float | None
    unit: Unit
    timing: Ratio
    failures: int = 0
    on_front: bool = False
    more: Mapping[str, float | int | None] = field(default_factory=dict)

    @property
    def rank(self) -> tuple[int, float]:
        """Sort key by badness: failures first, then the error."""
        return self.failures, inf if self.error is None else self.error


Task = Callable[[], Measurement]  # one row still to be measured


def by_setting(rows: Sequence[Measurement]) -> dict[str, list[Measurement]]:
    """Group rows by their setting, in order of appearance; within a setting the fastest first."""
    found: dict[str, list[Measurement]] = {}
    for row in rows:
        found.setdefault(row.setting, []).append(row)
    for group in found.values():
        group.sort(key=lambda row: row.timing.ratio)
    return found


def with_fronts(rows: Sequence[Measurement]) -> tuple[Measurement, ...]:
    """Mark in each setting the rows that no other beats in both time and error.

    Examples
    --------
    >>> fast, slow, slower = (Ratio(t, t, t, t) for t in (1.0, 2.0, 3.0))
    >>> rows = [Measurement("a", "s", 9, Unit.RADIANS, fast),
    ...         Measurement("b", "s", 1, Unit.RADIANS, slow),
    ...         Measurement("c", "s", 5, Unit.RADIANS, slower)]
    >>> [row.on_front for row in with_fronts(rows)]
    [True, True, False]
    """
    return tuple(
        replace(
            row,
            on_front=not any(_beats(other, row) for other in rows if other.setting == row.setting),
        )
        for row in rows
    )


def _beats(a: Measurement, b: Measurement) -> bool:
    times = a.timing.ratio, b.timing.ratio  # seconds drift between the rows of a study
    no_worse = times[0] <= times[1] and a.rank <= b.rank
    return no_worse and (times[0] < times[1] or a.rank < b.rank)


def overall(rows: Sequence[Measurement]) -> tuple[Measurement, ...]:
    """Return one row for each method: its worst error and longest time over all its settings.

    Who asks for an accuracy does not know which matrices will come.
    """
    found = []
    for name in dict.fromkeys(row.method for row in rows):
        mine = [row for row in rows if row.method == name]
        slowest = max(mine, key=lambda row: row.timing.ratio)
        worst = max(mine, key=lambda row: inf if row.error is None else row.error)
        failures = sum(row.failures for row in mine)
        found.append(replace(worst, setting="everywhere", timing=slowest.timing, failures=failures))
    return with_fronts(found)


@dataclass(frozen=True)
class Target:
    """What is asked of a study: an error that is good enough, a time budget, or neither.

    `tolerance` is in the study's own unit; `seconds` are for one call of what was timed.
    """

    tolerance: float | None = None
    seconds: float | None = None

    def met_by(self, rows: Sequence[Measurement]) -> Measurement | None:
        """Find the fastest right row within the tolerance, or the most accurate in the budget."""
        if self.tolerance is not None:
            good = [row for row in rows if row.rank <= (0, self.tolerance)]
            return min(good, key=lambda row: row.timing.ratio, default=None)
        if self.seconds is None:
            return None
        quick = [row for row in rows if row.timing.seconds <= self.seconds]
        return min(quick, key=lambda row: row.rank, default=None)
