"""The harness on a clock that the test owns: drift cancels, intervals cover, noise is told."""

from __future__ import annotations

import random
from collections.abc import Callable
from time import perf_counter as time

import pytest

from nmatrix.cli.studies import QUICK
from nmatrix.studies.harness import (
    CONFIDENCE,
    FEWEST_ROUNDS,
    MOST_ROUNDS,
    Harness,
    Ratio,
    SelfTest,
    calls,
    interval,
)
from nmatrix.studies.measurements import Measurement, Target, Unit, with_fronts, without_times


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


class Busy(Clock):
    """A clock of a machine with other programs, whose bursts come as time goes by.

    In `scale` seconds there is one burst, of any length: `draw` says which.
    """

    def __init__(self, seed: int, scale: float, draw: str) -> None:
        super().__init__()
        self.draw, self.scale, self.kind, self.speed = random.Random(seed), scale, draw, 1.0

    def burst(self, seconds: float) -> float:
        if self.kind == "independent":
            return self.draw.gammavariate(seconds / self.scale, self.scale)
        if self.kind == "heavy-tailed":
            lost, until = 0.0, self.draw.expovariate(1 / self.scale)
            while until < seconds:
                lost += 0.1 * self.scale * self.draw.paretovariate(1.1)
                until += self.draw.expovariate(1 / self.scale)
            return lost
        self.speed *= self.draw.lognormvariate(0.0, 0.1 * (seconds / self.scale) ** 0.5)
        return seconds * self.speed

    def work(self, seconds: float) -> Callable[[], None]:
        def run() -> None:
            self.now += seconds + self.burst(seconds)

        return run


def measured(clock: Clock) -> Harness:
    return Harness(clock, min_turn=0.01)


RUNS = 400


def coverage(settings: tuple[float, ...], noise: str, true: float) -> float:
    """Measure how often an interval of the product's own harness contains the true ratio."""
    covered = 0
    for seed in range(RUNS):
        harness = Harness(Busy(seed, Harness(time, *settings).min_turn, noise), *settings)
        turn, clock = harness.min_turn, harness.clock
        found = harness.ratio(clock.work(true * turn / 4), clock.work(turn / 4))
        covered += found.contains(true, 1e-9)  # a clock that nothing disturbs is off by rounding
    return covered / RUNS


@pytest.mark.parametrize("settings", [(), QUICK], ids=["default", "quick"])
@pytest.mark.parametrize("noise", ["independent", "heavy-tailed", "drifting"])
@pytest.mark.parametrize("true", [1.0, 2.0])
def test_intervals_cover_what_they_claim(settings: tuple, noise: str, true: float) -> None:
    assert coverage(settings, noise, true) >= 0.93


@pytest.mark.parametrize("count", range(FEWEST_ROUNDS, MOST_ROUNDS + 1))
def test_an_interval_is_as_narrow_as_its_claim_allows(count: int) -> None:
    """Every way that so many throws of a coin fall is tried: above the median, or below."""
    low, high = interval([float(i) for i in range(count)])
    k, missed, narrower = int(low) + 1, 0, 0
    assert high == count - k
    for throws in range(1 << count):
        heads = throws.bit_count()
        missed += heads < k or heads > count - k
        narrower += heads < k + 1 or heads > count - k - 1
    assert missed <= (1 - CONFIDENCE) * (1 << count) < narrower


def test_double_work_takes_twice_as_long() -> None:
    clock = Clock(noise=0.2)
    found = measured(clock).ratio(clock.work(0.004), clock.work(0.002))
    assert found.ratio == pytest.approx(2, abs=0.2)
    assert found.contains(2, 0.1)


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


SAME, TWICE = Ratio(1, 1.0, 0.95, 1.05), Ratio(1, 2.0, 1.95, 2.05)
OFF, WIDE = Ratio(1, 1.25, 1.2, 1.3), Ratio(1, 1.0, 0.6, 1.4)


@pytest.mark.parametrize("found", [OFF, WIDE])
def test_a_function_against_itself_is_one_or_no_time_is_told(found: Ratio) -> None:
    assert SelfTest(SAME, TWICE).objection is None
    assert "a function against itself took" in SelfTest(found, TWICE).objection


def test_twice_the_work_is_two_or_no_time_is_told() -> None:
    assert "twice the work took" in SelfTest(SAME, Ratio(1.0, 1.1, 1.0, 1.2)).objection


@pytest.mark.parametrize(("rows", "fewest"), [(1, 0), (2, 1), (3, 2), (4, 2), (10, 7), (16, 13)])
def test_rows_against_themselves_contain_one_as_often_as_a_binomial_test_accepts(
    rows: int, fewest: int
) -> None:
    def objection(good: int) -> str | None:
        return SelfTest(SAME, TWICE, (SAME,) * good + (OFF,) * (rows - good)).objection

    for good in range(rows + 1):
        assert (objection(good) is None) == (good >= fewest), good
    if fewest:
        assert f"only {fewest - 1} of {rows} rows" in objection(fewest - 1)


def test_rows_against_themselves_are_narrow_or_no_time_is_told() -> None:
    assert "wide" in SelfTest(SAME, TWICE, (SAME, WIDE, WIDE)).objection
    assert SelfTest(SAME, TWICE, (SAME, SAME, WIDE)).objection is None


def test_a_clock_that_works_passes_its_own_test_and_one_that_stands_does_not() -> None:
    clock = Clock(noise=0.01)
    found = measured(clock).self_test(clock.work(0.002))
    assert found.objection is None
    assert found.same.ratio == pytest.approx(1, abs=0.01)
    assert found.twice.ratio == pytest.approx(2, abs=0.01)
    jumps = iter(range(1 << 30))
    assert Harness(lambda: float(next(jumps))).self_test(lambda: None).objection is not None


def test_a_burst_spoils_one_try_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    found = iter([OFF, TWICE, SAME, TWICE, OFF])
    monkeypatch.setattr(Harness, "ratio", lambda *_: next(found))
    assert Harness(Clock()).self_test(lambda: None) == SelfTest(SAME, TWICE)


def test_the_same_times_give_the_same_interval() -> None:
    found = [
        measured(clock).ratio(clock.work(0.003), clock.work(0.002))
        for clock in (Clock(noise=0.5), Clock(noise=0.5))
    ]
    assert found[0] == found[1]
    assert found[0].low < found[0].high


@pytest.mark.parametrize("noise", [0.0, 5.0])
@pytest.mark.parametrize(
    ("max_seconds", "rounds"),
    [(0.0, FEWEST_ROUNDS), (0.85, 9), (1e9, MOST_ROUNDS)],
)
def test_the_rounds_are_settled_before_the_first_of_them(
    max_seconds: float, rounds: int, noise: float
) -> None:
    clock = Clock()
    count = 0

    def run() -> None:
        nonlocal count
        count += 1
        if count > 2:
            clock.noise = noise  # only after both are calibrated
        clock.work(0.02)()

    Harness(clock, 0.01, max_seconds).ratio(run, run)
    assert count == 2 + 4 * (1 + rounds)  # two to calibrate, and the first round thrown away


def test_turns_are_as_long_as_one_another() -> None:
    """Else the noise of the two differs, and the median of their ratio is not the true one."""
    clock, turns = Clock(), []
    taken = Harness._turn

    class Watched(Harness):
        def _turn(self, run: Callable[[], object], calls: int) -> float:
            started = clock()
            found = taken(self, run, calls)
            turns.append(clock() - started)
            return found

    Watched(clock, 0.02).ratio(clock.work(0.0017), clock.work(0.0009))
    assert max(turns) / min(turns) < 1.15


def test_calls_are_counted_the_same_every_time() -> None:
    def run() -> None:
        sorted([abs(-1), len("four")])

    assert {calls(run) for _ in range(3)} == {calls(lambda: [1]) + 3}
    assert calls(lambda: [run(), run()]) - calls(lambda: [run()]) == 4


def row(name: str, error: float, seconds: float, failures: int = 0) -> Measurement:
    timing = Ratio(seconds, seconds, seconds, seconds)
    return Measurement(name, "all", error, Unit.RADIANS, timing, 10 - seconds, failures)


def test_the_front_is_what_nobody_beats_and_never_wrong() -> None:
    rows = with_fronts(
        [row("fast", 1e-3, 1), row("fine", 1e-9, 2), row("slow", 1e-3, 3), row("wrong", 0, 0.5, 4)]
    )
    assert [one.method for one in rows if one.on_front] == ["fast", "fine"]


def test_targets_are_met_by_the_cheapest_and_the_most_accurate() -> None:
    rows = [row("fast", 1e-3, 1), row("fine", 1e-9, 2), row("wrong", 0, 0.5, 4)]
    assert Target(tolerance=1e-2).met_by(rows).method == "fast"
    assert Target(tolerance=1e-6).met_by(rows).method == "fine"
    assert Target(tolerance=1e-12).met_by(rows) is None
    assert Target(seconds=1.5).met_by(rows).method == "fast"
    assert Target(seconds=0.1).met_by(rows) is None


def test_without_times_the_counted_work_decides_and_no_budget_is_kept() -> None:
    rows = without_times([row("fast", 1e-3, 1), row("fine", 1e-9, 2)])
    assert [one.price for one in rows] == [9, 8]
    assert [one.on_front for one in with_fronts(rows)] == [False, True]
    assert Target(tolerance=1e-2).met_by(rows).method == "fine"
    assert Target(seconds=1e9).met_by(rows) is None
