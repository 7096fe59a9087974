"""Timing as ratios: two contestants take turns, and the interval of their ratio is reported.

Absolute times drift with everything else that a machine does. A B B A within one round shares the
drift between both, so the ratio stands; the median over rounds ignores bursts, and order statistics
give its interval. How many rounds there are is settled before the first of them: who stops as soon
as the interval is narrow picks the too narrow ones. A function against itself must come out as 1 as
often as its intervals claim, or no time is told.
"""

from __future__ import annotations

import gc
import platform
import sys
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from math import ceil, comb
from os import cpu_count
from statistics import median

Run = Callable[[], object]
Clock = Callable[[], float]

SEED = 7  # of every matrix and every normal
CONFIDENCE = 0.95
FEWEST_ROUNDS = 6  # the range of five misses the median more often than once in twenty
MOST_ROUNDS = 15
NOISIEST = 0.25  # half width of the interval of a function against itself
DOUBLING_ERROR = 0.2  # how far from 2 the ratio for twice the work may be
SIGNIFICANCE = 0.01  # of the test that intervals cover as often as they claim
TRIES = 5  # a burst of other programs spoils one try, hardly five


@dataclass(frozen=True)
class Ratio:
    """A contestant's time: seconds a call, and their ratio to the reference's with its interval."""

    seconds: float
    ratio: float
    low: float
    high: float

    @property
    def half_width(self) -> float:
        """Half the width of the interval."""
        return (self.high - self.low) / 2

    def contains(self, value: float, within: float = 0.0) -> bool:
        """Tell whether the interval comes as close to a value as that."""
        return self.low - within <= value <= self.high + within


Timed = Callable[[Run, Run], Ratio | None]  # a run and its reference; None where no time is told


def untimed(_run: Run, _reference: Run) -> None:
    """Measure nothing: the place of a clock that cannot be trusted."""


@dataclass(frozen=True)
class Harness:
    """A clock, and how long to measure with it.

    Parameters
    ----------
    clock
        Tells seconds, and never goes backwards.
    min_turn
        A turn calls its contestant until it takes so many seconds.
    max_seconds
        Seconds for one ratio, as far as `FEWEST_ROUNDS` rounds A B B A allow.
    """

    clock: Clock
    min_turn: float = 0.02
    max_seconds: float = 1.1

    def ratio(self, run: Run, reference: Run) -> Ratio:
        """Measure the time of `run` over that of `reference`, the first round discarded."""
        (calls, took), (others, other) = self._calibrated(run), self._calibrated(reference)
        fitting = int(self.max_seconds / (2 * took + 2 * other)) - 1
        rounds = min(max(fitting, FEWEST_ROUNDS), MOST_ROUNDS)
        seconds, ratios = [], []
        with _undisturbed():
            for i in range(rounds + 1):
                a = self._turn(run, calls)
                b = self._turn(reference, others) + self._turn(reference, others)
                a += self._turn(run, calls)
                if i:
                    seconds.append(a / 2)
                    ratios.append(a / b)
        return Ratio(median(seconds), median(ratios), *interval(ratios))

    def self_test(self, run: Run) -> SelfTest:
        """Time a function against itself and twice against once, again while that is too noisy."""

        def twice() -> None:
            run()
            run()

        for _ in range(TRIES):
            found = SelfTest(self.ratio(run, run), self.ratio(twice, run))
            if found.objection is None:
                break
        return found

    def _calibrated(self, run: Run) -> tuple[int, float]:
        """Find the calls that fill a turn, and the seconds that they take."""
        calls = 1
        while True:
            started = self.clock()
            for _ in range(calls):
                run()
            took = self.clock() - started
            if took >= self.min_turn:
                # As long as any other turn, so that a burst meets either contestant as often.
                fewer = max(1, ceil(calls * self.min_turn / took))
                return fewer, took / calls * fewer
            if calls >= 1 << 20:
                return calls, self.min_turn
            calls *= 2

    def _turn(self, run: Run, calls: int) -> float:
        """Take one turn and return its seconds per call."""
        started = self.clock()
        for _ in range(calls):
            run()
        return (self.clock() - started) / calls


def interval(ratios: Sequence[float]) -> tuple[float, float]:
    """Bracket the median of what six or more ratios are drawn from, 95 times out of 100 or more.

    Each ratio is above that median as likely as below, so the k-th smallest of n lies above it with
    the probability of fewer than k heads in n throws of a coin, and the k-th largest below it. No
    other property of the noise counts. k is the largest that keeps the claim: 1 of 6, 4 of 15.

    Examples
    --------
    >>> interval([3.0, 1.0, 2.0, 6.0, 5.0, 4.0])
    (1.0, 6.0)
    >>> interval([float(i) for i in range(1, 16)])
    (4.0, 12.0)
    """
    ordered, count = sorted(ratios), len(ratios)
    k = 1
    while 2 * _heads(fewer_than=k + 1, throws=count) <= 1 - CONFIDENCE:
        k += 1
    return ordered[k - 1], ordered[-k]


def _heads(*, fewer_than: int, throws: int, probability: float = 0.5) -> float:
    """Compute the probability of fewer heads than so many."""
    return sum(
        comb(throws, i) * probability**i * (1 - probability) ** (throws - i)
        for i in range(fewer_than)
    )


@dataclass(frozen=True)
class SelfTest:
    """What the clock makes of ratios that are known: a function against itself, and twice its work.

    `rows` are those of a study whose method is the reference itself.
    """

    same: Ratio
    twice: Ratio
    rows: tuple[Ratio, ...] = ()

    def with_rows(self, rows: Sequence[Ratio]) -> SelfTest:
        """Add the rows of a study that are its reference."""
        return replace(self, rows=tuple(rows))

    @property
    def containing_one(self) -> int:
        """The number of rows whose interval contains 1, as it should."""
        return sum(row.contains(1.0) for row in self.rows)

    @property
    def objection(self) -> str | None:
        """The reason not to believe this clock, or None.

        Too few intervals contain 1 where so few, or fewer, would come once in a hundred times if
        each did with a probability of 0.95.

        Examples
        --------
        >>> sound, off = Ratio(1, 1, 0.9, 1.1), Ratio(1, 1.2, 1.1, 1.3)
        >>> twice = Ratio(1, 2, 1.9, 2.1)
        >>> SelfTest(sound, twice, (sound,) * 6 + (off,) * 4).objection is None
        False
        >>> SelfTest(sound, twice, (sound,) * 7 + (off,) * 3).objection is None
        True
        """
        same, twice, count = self.same, self.twice, len(self.rows)
        if not same.contains(1.0) or same.half_width > NOISIEST:
            return f"a function against itself took between {same.low:.2f} and {same.high:.2f}"
        if not twice.contains(2.0, DOUBLING_ERROR):
            return f"twice the work took between {twice.low:.2f} and {twice.high:.2f}"
        as_few = _heads(fewer_than=self.containing_one + 1, throws=count, probability=CONFIDENCE)
        if count and as_few < SIGNIFICANCE:
            return f"only {self.containing_one} of {count} rows against themselves contain 1"
        if count and (wide := median(row.half_width for row in self.rows)) > NOISIEST:
            return f"intervals of a function against itself are ±{wide:.2f} wide"
        return None


def calls(run: Run) -> int:
    """Count the calls of functions, Python's and built-in ones; no busy machine makes more of them.

    Examples
    --------
    >>> calls(lambda: abs(-1)) - calls(lambda: None)
    1
    """
    count = 0

    def watch(_frame: object, event: str, _argument: object) -> None:
        nonlocal count
        count += event in ("call", "c_call")

    before = sys.getprofile()
    with _undisturbed():
        sys.setprofile(watch)
        try:
            run()
        finally:
            sys.setprofile(before)
    return count


@contextmanager
def _undisturbed() -> Iterator[None]:
    """Keep the garbage collector out of the turns."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()


def machine() -> dict[str, str | int | None]:
    """Describe the machine and the versions behind the times, and the seed of random inputs."""
    import numpy as np

    return {
        "system": platform.system(),
        "processor": platform.machine(),
        "cores": cpu_count(),
        "python": platform.python_version(),
        "numpy": np.__version__,
        "seed": SEED,
    }
