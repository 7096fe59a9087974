"""The harness on a clock that the test owns: drift cancels, work shows, noise is refused."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from nmatrix.errors import CheckFailedError
from nmatrix.studies.harness import Harness, Ratio
from nmatrix.studies.measurements import Measurement, Target, Unit, with_fronts


class Clock:
    """A clock that work moves; everything slows down as time goes by."""

    def __init__(self, drift: float = 0.0, noise: float = 0.0) -> None:
        self.now, self.drift, self.noise, self.draw = 0.0, drift, noise, random.Random(3)

    def __call__(self) -> float:
        return self.now

    def work(self, seconds: float) -> Callable[[], None]:
        def run() -> None:
            slower = 1 + self.drift * self.now + self.noise * self.draw.random()
            self.now += seconds * slower

        return run


def measured(clock: Clock, rounds: int = 9) -> Harness:
    return Harness(clock, min_turn=0.01, max_rounds=rounds)


def test_double_work_takes_twice_as_long() -> None:
    clock = Clock(noise=0.2)
    found = measured(clock).ratio(clock.work(0.004), clock.work(0.002))
    assert found.ratio == pytest.approx(2, abs=0.2)
    assert found.low <= 2.1
    assert found.high >= 1.9


def test_drift_cancels_because_turns_are_taken() -> None:
    clock = Clock(drift=0.5)
    found = measured(clock).ratio(clock.work(0.002), clock.work(0.002))
    assert found.ratio == pytest.approx(1, abs=0.01)


def test_one_after_the_other_would_not_cancel_it() -> None:
    clock = Clock(drift=0.5)
    run = clock.work(0.002)
    first, second = ([], [])
    for times in (first, second):
        for _ in range(300):
            started = clock()
            run()
            times.append(clock() - started)
    assert sum(second) / sum(first) > 1.2


@pytest.mark.parametrize("found", [Ratio(1, 1.25, 1.2, 1.3), Ratio(1, 1.0, 0.6, 1.4)])
def test_a_function_against_itself_is_one_or_nothing_is_said(
    found: Ratio, monkeypatch: pytest.MonkeyPatch
) -> None:
    clock = Clock()
    assert measured(clock).self_check(clock.work(0.002)).ratio == pytest.approx(1)
    monkeypatch.setattr(Harness, "ratio", lambda *_: found)
    with pytest.raises(CheckFailedError, match="too noisy"):
        measured(clock).self_check(clock.work(0.002))


def test_twice_the_work_is_two_or_nothing_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    clock = Clock()
    assert measured(clock).double_check(clock.work(0.002)).ratio == pytest.approx(2)
    monkeypatch.setattr(Harness, "ratio", lambda *_: Ratio(1.0, 1.1, 1.0, 1.2))
    with pytest.raises(CheckFailedError, match="twice the work"):
        measured(clock).double_check(clock.work(0.002))


def test_the_same_times_give_the_same_interval() -> None:
    found = [
        measured(clock).ratio(clock.work(0.003), clock.work(0.002))
        for clock in (Clock(noise=0.5), Clock(noise=0.5))
    ]
    assert found[0] == found[1]
    assert found[0].low < found[0].high


def test_rounds_end_when_the_interval_is_narrow_or_time_is_up() -> None:
    def rounds(**fields: float) -> int:
        clock = Clock(noise=0.5 if "deadline" in fields else 0.0)
        calls = []
        run = clock.work(0.02)

        def counted() -> None:
            calls.append(1)
            run()

        harness = Harness(clock, 0.01, max_rounds=30, min_rounds=4, max_seconds=1e9, **fields)
        harness.ratio(counted, clock.work(0.02))
        return (len(calls) - 1) // 2 - 1  # one to calibrate, two in a round, the first thrown away

    assert rounds() == 4  # without noise the fewest are enough
    assert rounds(deadline=0.0) == 4
    assert rounds(deadline=1e9, target_spread=1e-9) == 30


def row(name: str, error: float | None, seconds: float, failures: int = 0) -> Measurement:
    timing = Ratio(seconds, seconds, seconds, seconds)
    return Measurement(name, "all", error, Unit.RADIANS, timing, failures)


def test_the_front_is_what_nobody_beats() -> None:
    rows = with_fronts(
        [row("fast", 1e-3, 1), row("fine", 1e-9, 2), row("slow", 1e-3, 3), row("wrong", 0, 1, 4)]
    )
    assert [one.method for one in rows if one.on_front] == ["fast", "fine"]


def test_targets_are_met_by_the_cheapest_and_the_most_accurate() -> None:
    rows = [row("fast", 1e-3, 1), row("fine", 1e-9, 2), row("wrong", 0, 0.5, 4)]
    assert Target(tolerance=1e-2).met_by(rows).method == "fast"
    assert Target(tolerance=1e-6).met_by(rows).method == "fine"
    assert Target(tolerance=1e-12).met_by(rows) is None
    assert Target(seconds=1.5).met_by(rows).method == "fast"
    assert Target(seconds=0.1).met_by(rows) is None
