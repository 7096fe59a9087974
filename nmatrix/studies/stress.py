"""`stress`: every hard case against everyone who tries; and directed random ones."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from difflib import get_close_matches
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.errors import CheckFailedError, IllegalValueError
from nmatrix.report import Block, Heading, Report, Table, Text, Value
from nmatrix.report import Verdict as Sentence
from nmatrix.studies.hardcases import depths, mistakes, normals, pictures, vectors, views
from nmatrix.studies.hardcases.case import Case, Result, Verdict

FAMILIES = (normals, vectors, views, depths, pictures, mistakes)
CATALOGUE: tuple[Case, ...] = tuple(case for family in FAMILIES for case in family.CASES)
REPLAYED = 3  # failing random cases that are printed
Judged = tuple[Case, tuple[Result, ...]]


def case_named(name: str) -> Case:
    """Return a case of the catalogue.

    Raises
    ------
    IllegalValueError
        If there is none of this name.
    """
    found = next((one for one in CATALOGUE if one.id.lower() == name.lower()), None)
    if found is None:
        ids = [one.id for one in CATALOGUE]
        near = get_close_matches(name.upper(), ids, 1)
        hint = f"did you mean {near[0]}?" if near else f"try {ids[0]}"
        raise IllegalValueError(f"--case ({name[:20]})", f"there are {', '.join(ids)}", hint)
    return found


def random_cases(count: int, seed: int) -> tuple[Case, ...]:
    """Return directed random normals: near singular, powers of two, subnormal, any bit patterns."""
    rng = np.random.default_rng(seed)
    found = []
    for i in range(count):
        A: NDArray[Any] = rng.normal(size=(3, 3))
        kind = ("near singular", "power of two", "subnormal", "bit patterns")[i % 4]
        if kind == "near singular":
            A[2] = 2 * A[0] - A[1]
            A[2, 0] += rng.integers(-2, 3) * np.spacing(A[2, 0])
        elif kind == "power of two":
            A = np.ldexp(A, rng.integers(-900, 900))
        elif kind == "subnormal":
            A = rng.integers(-9, 10, size=(3, 3)) * 5e-324
        else:
            bits = rng.integers(0, 2**64, size=(3, 3), dtype=np.uint64).view(np.float64)
            A = np.where(np.isfinite(bits), bits, 1.0)
        n = tuple(rng.normal(size=3).tolist())
        found.append(normals.normal_case(f"S{i}", kind, A, n, "made to be hard"))
    return tuple(found)


def stress(cases: Sequence[Case]) -> Report:
    """Return what became of everyone; it ends in a failure if one of ours is not right."""
    judged: list[Judged] = [(one, one.results()) for one in cases]
    ours = [(case, r) for case, results in judged for r in results if r.is_ours]
    failed = [(case, r) for case, r in ours if r.verdict is not Verdict.RIGHT]
    data: dict[str, Value] = {
        "cases": [_data(case, results) for case, results in judged],
        "passed": len(ours) - len(failed),
        "failed": len(failed),
    }
    blocks = _explained(*judged[0]) if len(judged) == 1 else _overview(judged, len(failed))
    return Report("stress", data, blocks, _replays(failed), _failure(failed))


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


def _overview(judged: Sequence[Judged], failed: int) -> tuple[Block, ...]:
    rows = tuple((case.id, case.title, _own(results), _losers(results)) for case, results in judged)
    table = Table(("case", "what is hard", "nmatrix", "who fails"), rows)
    fallen = Counter(
        r.method for _, results in judged for r in results if r.verdict is not Verdict.RIGHT
    )
    worst = ", ".join(f"{name} {count}" for name, count in fallen.most_common(5))
    total = f"{len(judged)} cases; nmatrix fails {failed}. Most failures: {worst}."
    return Heading("Hard cases"), table, Sentence(total)


def _own(results: Sequence[Result]) -> str:
    wrong = [r for r in results if r.is_ours and r.verdict is not Verdict.RIGHT]
    return "right" if not wrong else f"{wrong[0].method}: {wrong[0].verdict}"


def _losers(results: Sequence[Result]) -> str:
    lost = [r for r in results if not r.is_ours and r.verdict is not Verdict.RIGHT]
    named = ", ".join(f"{r.method} ({r.verdict})" for r in lost[:3])
    return f"{named}, and {len(lost) - 3} more" if len(lost) > 3 else named


def _explained(case: Case, results: Sequence[Result]) -> tuple[Block, ...]:
    answer = "there is none, and that must be said"
    if case.expected is not None:
        answer = "(" + ", ".join(f"{_nearest(x):.6g}" for x in case.expected) + ")"
        answer += ", its direction" if case.is_direction else ""
    rows = tuple(
        (r.method, r.verdict.value, "" if r.error is None else f"{r.error:.2g}") for r in results
    )
    return (
        Heading(f"{case.id}: {case.title}"),
        Text(f"Given: {case.given}"),
        Text(f"Answer: {answer}. {case.reason[:1].upper()}{case.reason[1:]}."),
        Table(("method", "verdict", "rad" if case.is_direction else "relative error"), rows),
    )


def _nearest(value: object) -> float:
    try:
        return float(value)  # type: ignore[arg-type]  # a fraction
    except OverflowError:
        return float("inf")


def _replays(failed: Sequence[tuple[Case, Result]]) -> tuple[str, ...]:
    """Return how to see each failing input again."""
    return tuple(f"{case.id}, {r.method}: {case.given}" for case, r in failed[:REPLAYED])


def _failure(failed: Sequence[tuple[Case, Result]]) -> CheckFailedError | None:
    if not failed:
        return None
    case, result = failed[0]
    return CheckFailedError(
        f"case {case.id} ({result.method}: {result.verdict})",
        f"{len(failed)} of nmatrix's own answers are not right",
        f"see nmatrix stress --case {case.id}",
    )
