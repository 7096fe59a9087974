"""Timing as ratios: two contestants take turns, and the interval of their ratio is reported.

Absolute times drift with everything else that a machine does. A B B A within one round shares the
drift between both, so the ratio stands; the median over rounds ignores bursts, and a bootstrap
tells how sure it is. A function against itself must come out as 1, or nothing is reported.
"""

from __future__ import annotations

import gc
import platform
import random
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from os import cpu_count
from statistics import median

from nmatrix.errors import CheckFailedError

Run = Callable[[], object]
Clock = Callable[[], float]

RESAMPLES = 400
CONFIDENCE = 0.95
NOISIEST = 0.25  # half width of the interval of a function against itself
SLACK = 0.01  # a hundredth beside the interval is no finding
TWICE = 0.2  # how far from 2 twice the work may come out
TRIES = 5  # a burst of other programs spoils one try, hardly five


@dataclass(frozen=True)
class Ratio:
    """How long a contestant takes: seconds of a call; times its reference's, with an interval."""

    seconds: float
    ratio: float
    low: float
    high: float


@dataclass(frozen=True)
class Harness:
    """A clock, and how patient to be.

    Parameters
    ----------
    clock
        Tells seconds; it only ever goes forwards.
    shortest
        A turn calls its contestant until it takes so many seconds.
    rounds
        A round is A B B A.
    seed
        Of the bootstrap, so that the same times give the same interval.
    """

    clock: Clock
    shortest: float = 0.02
    rounds: int = 15
    seed: int = 1

    def ratio(self, run: Run, reference: Run) -> Ratio:
        """Return the time of `run` over that of `reference`, the first round discarded."""
        calls, others = self._calibrated(run), self._calibrated(reference)
        found, seconds = [], []
        with _undisturbed():
            for _ in range(self.rounds + 1):
                a = self._turn(run, calls)
                b = self._turn(reference, others) + self._turn(reference, others)
                a += self._turn(run, calls)
                found.append(a / b)
                seconds.append(a / 2)
        low, high = self._interval(found[1:])
        return Ratio(median(seconds[1:]), median(found[1:]), low, high)

    def self_check(self, run: Run) -> Ratio:
        """Return a function against itself.

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
        """Return twice the work against once.

        Raises
        ------
        CheckFailedError
            If it does not come out as 2: then this clock cannot tell work apart.
        """

        def twice() -> None:
            run()
            run()

        for _ in range(TRIES):
            found = self.ratio(twice, run)
            if found.low <= 2 + TWICE and found.high >= 2 - TWICE:
                return found
        raise CheckFailedError(
            f"timing (twice the work: {found.ratio:.2f} times as long)",
            "this clock cannot tell one amount of work from another",
            "close other programs and try again",
        )

    def _calibrated(self, run: Run) -> int:
        """Return how many calls make a turn, found by doubling."""
        calls = 1
        while True:
            started = self.clock()
            for _ in range(calls):
                run()
            took = self.clock() - started
            if took >= self.shortest or calls >= 1 << 20:
                return calls
            calls *= 2

    def _turn(self, run: Run, calls: int) -> float:
        """Return the seconds of one call."""
        started = self.clock()
        for _ in range(calls):
            run()
        return (self.clock() - started) / calls

    def _interval(self, ratios: list[float]) -> tuple[float, float]:
        """Return the bootstrap interval of the median."""
        draw = random.Random(self.seed)
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
    """Return what the times were measured on."""
    import numpy as np

    return {
        "system": platform.system(),
        "processor": platform.machine(),
        "cores": cpu_count(),
        "python": platform.python_version(),
        "numpy": np.__version__,
    }
