"""The rows of a study: what was measured, which of them nobody beats, and what answers a wish."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from math import inf

from nmatrix.studies.harness import Ratio


@dataclass(frozen=True)
class Row:
    """One method in one setting.

    `error` is None where there is no error to speak of; `failures` counts wrong answers: not a
    number, zero, flipped, or undefined and not reported. `more` are further figures by name. Rows
    of one `setting` compete.
    """

    method: str
    setting: str
    error: float | None
    unit: str
    timing: Ratio
    failures: int = 0
    on_front: bool = False
    more: Mapping[str, float | int | None] = field(default_factory=dict)

    @property
    def rank(self) -> tuple[int, float]:
        """Return how bad it is: failures first, then the error."""
        return self.failures, inf if self.error is None else self.error


Task = Callable[[], Row]  # one row still to be measured


def with_fronts(rows: Sequence[Row]) -> tuple[Row, ...]:
    """Mark in each setting the rows that no other beats in both time and error.

    Examples
    --------
    >>> fast, slow, worse = (Ratio(t, t, t, t) for t in (1.0, 2.0, 3.0))
    >>> rows = [Row("a", "s", 9, "rad", fast), Row("b", "s", 1, "rad", slow)]
    >>> rows.append(Row("c", "s", 5, "rad", worse))
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


def _beats(a: Row, b: Row) -> bool:
    times = a.timing.ratio, b.timing.ratio  # seconds drift between the rows of a study
    no_worse = times[0] <= times[1] and a.rank <= b.rank
    return no_worse and (times[0] < times[1] or a.rank < b.rank)


def overall(rows: Sequence[Row]) -> tuple[Row, ...]:
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


def cheapest(rows: Sequence[Row], tolerance: float) -> Row | None:
    """Return the fastest row without failures whose error is within a tolerance."""
    good = [r for r in rows if not r.failures and r.error is not None and r.error <= tolerance]
    return min(good, key=lambda row: row.timing.ratio, default=None)


def most_accurate(rows: Sequence[Row], seconds: float) -> Row | None:
    """Return the most accurate row that takes no longer than so many seconds."""
    return min(
        (row for row in rows if row.timing.seconds <= seconds),
        key=lambda row: row.rank,
        default=None,
    )
