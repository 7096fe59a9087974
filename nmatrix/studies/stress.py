"""`stress`: the hard cases, and how every method does on each of them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Sequence

from nmatrix.errors import CheckFailedError, IllegalValueError, did_you_mean, quantity
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Report, Table, Text, Tone, Value, Verdict
from nmatrix.studies.hardcases import (
    affine,
    coverage,
    depths,
    normals,
    samples,
    vectors,
    views,
)
from nmatrix.studies.hardcases.case import IMPRECISE, Case, CaseVerdict, Result

_PARTS = (normals, affine, vectors, views, depths, coverage, samples)
FAMILIES = {
    "N": "normals",
    "V": "vectors and angles",
    "E": "eyes, views and lights",
    "D": "depth and projection",
    "R": "rasterization",
    "M": "mistakes of teaching material",
}
REPLAYED = 3  # failing cases that are printed
SHOWN = 80  # rows of the table for people
KEPT = 1_000  # cases whose results are kept, and as many of those that failed
PEERS = ("inverse", "cofactor")  # what most people write
Judged = tuple[Case, tuple[Result, ...]]


def _place(case: Case) -> tuple[int, int, str]:
    """Sort key of a case: by family, by number, by letter."""
    number = case.id[1:].rstrip("bc")
    return list(FAMILIES).index(case.id[0]), int(number), case.id


CATALOGUE: tuple[Case, ...] = tuple(
    sorted((case for part in _PARTS for case in part.CASES), key=_place)
)


def case_named(name: str, cases: Iterable[Case], ids: Sequence[str]) -> Case:
    """Find a case by its name among cases, whose ids are known before the cases are made.

    Raises
    ------
    IllegalValueError
        If there is none of this name.
    """
    if name.lower() in (one.lower() for one in ids):
        return next(one for one in cases if one.id.lower() == name.lower())
    raise IllegalValueError(
        f"{quantity('case')} ({name[:20]})",
        f"there are {len(ids)}, {ids[0]} to {ids[-1]}",
        did_you_mean(name.upper(), ids, f"try {ids[0]}"),
    )


class Tally:
    """What is remembered of any number of judged cases: counts, the first of them, and failures."""

    def __init__(self) -> None:
        self.count = 0
        self.own = 0  # results of nmatrix's own methods
        self.failed = 0
        self.tried: Counter[str] = Counter()
        self.right: Counter[str] = Counter()
        self.kept: list[Judged] = []
        self.failures: list[tuple[Case, Result]] = []

    def add(self, case: Case) -> None:
        """Judge a case, count it, and let go of it unless it is one of the first or failed."""
        results = case.results()
        self.count += 1
        self.tried.update(r.method for r in results)
        self.right.update(r.method for r in results if r.verdict is CaseVerdict.RIGHT)
        ours = [r for r in results if r.is_ours]
        failed = [r for r in ours if r.verdict is not CaseVerdict.RIGHT]
        self.own += len(ours)
        self.failed += len(failed)
        is_kept = self.count <= KEPT
        if failed and len(self.failures) < KEPT:
            is_kept = True
            self.failures += [(case, r) for r in failed]
        if is_kept:
            self.kept.append((case, results))


def stress(cases: Iterable[Case]) -> Report:
    """Report how every method does; it ends in a failure if one of ours is not right.

    Of more cases than `KEPT` the report has the first ones and those that failed.
    """
    tally = Tally()
    for one in cases:
        tally.add(one)
    data: dict[str, Value] = {
        "cases": [_data(case, results) for case, results in tally.kept],
        "passed": tally.own - tally.failed,
        "failed": tally.failed,
    }
    blocks = _explained(*tally.kept[0]) if tally.count == 1 else _overview(tally)
    left_out = tally.count - len(tally.kept)
    counted = (f"{left_out} more cases are counted and not listed.",) if left_out else ()
    remarks = (*_replays(tally.failures), *counted)
    return Report("stress", data, blocks, remarks, _failure(tally))


def _data(case: Case, results: Sequence[Result]) -> dict[str, Value]:
    expected = None if case.expected is None else list(case.expected)
    return {
        "id": case.id,
        "title": case.title,
        "expected": expected,
        "results": [
            {"method": r.method, "verdict": r.verdict.value, "error_rad": r.error} for r in results
        ],
    }


def _overview(tally: Tally) -> tuple[Block, ...]:
    is_right = "is right on all of them" if not tally.failed else f"is wrong {tally.failed} times"
    summary = [f"{tally.count} cases. nmatrix {is_right}."]
    summary += [
        f"{name}: right on {tally.right[name]} of {tally.tried[name]}."
        for name in PEERS
        if tally.tried[name]
    ]
    rows = tuple(
        (case.id, case.title, _own(results), _losers(results)) for case, results in tally.kept
    )
    table = Table(("case", "what is hard", "nmatrix", "who fails"), rows[:SHOWN])
    rest = len(rows) - SHOWN
    more = (Text(f"… and {rest} more; -f json has them."),) if rest > 0 else ()
    tone = Tone.WRONG if tally.failed else Tone.RIGHT
    return Heading("Hard cases"), Verdict(" ".join(summary), tone), table, *more


def _own(results: Sequence[Result]) -> str:
    wrong = [r for r in results if r.is_ours and r.verdict is not CaseVerdict.RIGHT]
    return "right" if not wrong else f"{wrong[0].method}: {wrong[0].verdict}"


def _losers(results: Sequence[Result]) -> str:
    lost = [r for r in results if not r.is_ours and r.verdict is not CaseVerdict.RIGHT]
    named = ", ".join(f"{r.method} ({r.verdict})" for r in lost[:3])
    return f"{named}, and {len(lost) - 3} more" if len(lost) > 3 else named


def _explained(case: Case, results: Sequence[Result]) -> tuple[Block, ...]:
    unit = "rad" if case.is_direction else "relative error"
    rows = tuple(
        (r.method, r.verdict.value, _error(r), "ours" if r.is_ours else "") for r in results
    )
    return (
        Heading(f"{case.id}: {case.title}"),
        Text(f"Given: {case.given}"),
        Text(f"Answer: {_answer(case)}."),
        Text(f"Why it is hard: {case.reason}."),
        Table(("method", "verdict", unit, ""), rows),
        Text(_meaning(case)),
    )


def _answer(case: Case) -> str:
    if case.expected is None:
        return "there is none, and that must be said"
    scale = max(map(abs, case.expected)) if case.is_direction else 1
    numbers = ", ".join(short_text(x / (scale or 1), 6) for x in case.expected)
    about = ", at any positive length" if case.is_direction else ""
    return f"({numbers}){about}" if len(case.expected) > 1 else numbers


def _error(result: Result) -> str:
    return "" if result.error is None else f"{result.error:.2g}"


def _meaning(case: Case) -> str:
    if case.expected is None:
        return "Right is who says so: an error, a status, never a number."
    unit = " rad" if case.is_direction else ", relative to the largest number"
    return (
        f"Right is an error up to {case.within:g}{unit}; imprecise up to {IMPRECISE:g}; wrong, "
        "flipped (by more than 90°), zero or nan is what a picture shows."
    )


def _replays(failed: Sequence[tuple[Case, Result]]) -> tuple[str, ...]:
    """Describe the first failing inputs, with the commands that show them again."""
    return tuple(
        f"{case.id}, {r.method}: {r.verdict}. {case.given}. Again: {case.replay}"
        for case, r in failed[:REPLAYED]
    )


def _failure(tally: Tally) -> CheckFailedError | None:
    if not tally.failures:
        return None
    case, result = tally.failures[0]
    return CheckFailedError(
        f"case {case.id} ({result.method}: {result.verdict})",
        f"{tally.failed} of nmatrix's own answers are not right",
        f"see {case.replay}",
    )
