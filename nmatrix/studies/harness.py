"""Timing as ratios: two contestants take turns, and the interval of their ratio is reported.

Absolute times drift with everything else that a machine does. A B B A within one round shares the
drift between both, so the ratio stands; the median over rounds ignores bursts, and a bootstrap
gives its interval. Rounds go on until the interval is narrow or time is up. A function against
itself must come out as 1, or nothing is reported.
"""

from __future__ import annotations

import gc
import platform
import random
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from math import inf
from os import cpu_count
from statistics import median

from nmatrix.errors import CheckFailedError

Run = Callable[[], object]
Clock = Callable[[], float]

SEED = 7  # of every matrix, every normal and every resample
RESAMPLES = 400
CONFIDENCE = 0.95
NOISIEST = 0.25  # half width of the interval of a function against itself
SLACK = 0.01  # how far outside its interval 1 may lie
DOUBLING_ERROR = 0.2  # how far from 2 the ratio for twice the work may be
TRIES = 5  # a burst of other programs spoils one try, hardly five


@dataclass(frozen=True)
class Ratio:
    """A contestant's time: seconds a call, and their ratio to the reference's with its interval."""

    seconds: float
    ratio: float
    low: float
    high: float

    @property
    def spread(self) -> float:
        """The farther end of the interval from the ratio, relative to the ratio."""
        return max(self.high - self.ratio, self.ratio - self.low) / self.ratio


@dataclass(frozen=True)
class Harness:
    """A clock, and how long to measure with it.

    Parameters
    ----------
    clock
        Tells seconds, and never goes backwards.
    min_turn
        A turn calls its contestant until it takes so many seconds.
    max_rounds, min_rounds
        The most and the fewest rounds A B B A for one ratio.
    target_spread
        The relative half interval at which rounds end early.
    max_seconds
        Seconds for one ratio, after which `min_rounds` are enough.
    deadline
        The time on the clock from which `min_rounds` are enough for every ratio.
    """

    clock: Clock
    min_turn: float = 0.02
    max_rounds: int = 15
    min_rounds: int = 3
    target_spread: float = 0.02
    max_seconds: float = 1.5
    deadline: float = inf

    def ratio(self, run: Run, reference: Run) -> Ratio:
        """Return the time of `run` over that of `reference`, the first round discarded."""
        deadline = min(self.deadline, self.clock() + self.max_seconds)
        calls, others = self._calibrated(run), self._calibrated(reference)
        seconds, ratios = [], []
        with _undisturbed():
            for i in range(self.max_rounds + 1):
                a = self._turn(run, calls)
                b = self._turn(reference, others) + self._turn(reference, others)
                a += self._turn(run, calls)
                if i:
                    seconds.append(a / 2)
                    ratios.append(a / b)
                    found = Ratio(median(seconds), median(ratios), *interval(ratios))
                    is_enough = self.clock() >= deadline or found.spread <= self.target_spread
                    if i >= self.min_rounds and is_enough:
                        break
        return found

    def self_check(self, run: Run) -> Ratio:
        """Time a function against itself, which must come out as 1.

        Raises
        ------
        CheckFailedError
            If the machine is too noisy to tell it from 1.
        """
        for _ in range(TRIES):
            found = self.ratio(run, run)
            holds = found.low - SLACK <= 1 <= found.high + SLACK
            if holds and (found.high - found.low) / 2 <= NOISIEST:
                return found
        raise CheckFailedError(
            f"timing (a function against itself: {found.ratio:.2f}, between {found.low:.2f} "
            f"and {found.high:.2f})",
            "the machine is too noisy to tell one time from another",
            "close other programs and try again",
        )

    def double_check(self, run: Run) -> Ratio:
        """Time twice the work against once, which must come out as 2.

        Raises
        ------
        CheckFailedError
            If it does not: then this clock cannot tell work apart.
        """

        def twice() -> None:
            run()
            run()

        for _ in range(TRIES):
            found = self.ratio(twice, run)
            if found.low <= 2 + DOUBLING_ERROR and found.high >= 2 - DOUBLING_ERROR:
                return found
        raise CheckFailedError(
            f"timing (twice the work: {found.ratio:.2f} times as long)",
            "this clock cannot tell one amount of work from another",
            "close other programs and try again",
        )

    def _calibrated(self, run: Run) -> int:
        """Count the calls that fill a turn, by doubling."""
        calls = 1
        while True:
            started = self.clock()
            for _ in range(calls):
                run()
            took = self.clock() - started
            if took >= self.min_turn or calls >= 1 << 20:
                return calls
            calls *= 2

    def _turn(self, run: Run, calls: int) -> float:
        """Take one turn and return its seconds per call."""
        started = self.clock()
        for _ in range(calls):
            run()
        return (self.clock() - started) / calls


def interval(ratios: Sequence[float]) -> tuple[float, float]:
    """Return the bootstrap interval of the median; equal ratios give equal intervals.

    Examples
    --------
    >>> interval([1.0, 1.0, 1.0, 1.0, 1.0])
    (1.0, 1.0)
    """
    draw = random.Random(SEED)
    medians = sorted(median(draw.choices(ratios, k=len(ratios))) for _ in range(RESAMPLES))
    cut = round((1 - CONFIDENCE) / 2 * RESAMPLES)
    return medians[cut], medians[-1 - cut]


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
