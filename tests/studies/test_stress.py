"""The hard cases: ours is right on each, somebody still fails each, and the judge is strict."""

from __future__ import annotations

import json
from fractions import Fraction

import numpy as np
import pytest

from nmatrix.cli.app import run
from nmatrix.linear import methods
from nmatrix.linear.methods import Method
from nmatrix.studies.hardcases import normals
from nmatrix.studies.hardcases.case import Case, Contestant, Verdict, exactly
from nmatrix.studies.stress import CATALOGUE, case_named, random_cases, stress


@pytest.mark.parametrize("case", CATALOGUE, ids=lambda case: case.id)
def test_ours_is_right_and_somebody_still_fails(case: Case) -> None:
    results = case.results()
    assert [r for r in results if r.is_ours]
    assert all(r.verdict is Verdict.RIGHT for r in results if r.is_ours), results
    assert any(r.verdict is not Verdict.RIGHT for r in results if not r.is_ours)


def test_every_family_is_there() -> None:
    assert {one.id[0] for one in CATALOGUE} == set("NVEDRM")
    assert len({one.id for one in CATALOGUE}) == len(CATALOGUE)


def judged(found: object, expected: object = exactly(1, 0, 0), **case: bool) -> Verdict:
    one = Contestant("x", lambda: found)  # type: ignore[arg-type, return-value]
    row = Case("T", "t", "", expected, "", (one,), **case)  # type: ignore[arg-type]
    return row.results()[0].verdict


def test_the_judge_tells_every_kind_of_answer_apart() -> None:
    assert judged((1.0, 0.0, 0.0)) is Verdict.RIGHT
    assert judged((1.0, 1e-9, 0.0)) is Verdict.IMPRECISE
    assert judged((1.0, 0.1, 0.0)) is Verdict.WRONG
    assert judged((float("nan"),) * 3) is Verdict.NAN
    assert judged((0.0, 0.0, 0.0)) is Verdict.ZERO
    assert judged((-2.0, 0.0, 0.0), is_direction=True) is Verdict.FLIPPED
    assert judged((7.0, 0.0, 0.0), is_direction=True) is Verdict.RIGHT
    assert judged((1.0,), None) is Verdict.NOT_REPORTED
    assert judged(None, None) is Verdict.RIGHT
    assert judged(None) is Verdict.NAN


def dropped_sign(A: np.ndarray, n: np.ndarray) -> np.ndarray:
    return methods.plain_cofactor(A, n)


def test_a_mutant_of_ours_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    mutant = Method("exact", "the sign dropped", dropped_sign, is_ours=True)
    monkeypatch.setattr(normals, "METHODS", (mutant,))
    caught = [
        one.id
        for one in (
            normals.normal_case("N3", "", np.diag([-1.0, 1, 1]), (1, 0, 0), ""),
            normals.normal_case("N9", "", normals.Q * 1e300, (1, 2, 3), ""),
        )
        if stress([one]).failure is not None
    ]
    assert caught == ["N3", "N9"]


def test_random_cases_are_directed_and_the_same_again() -> None:
    first, again = random_cases(40, 3), random_cases(40, 3)
    assert [one.given for one in first] == [one.given for one in again]
    assert stress(first).failure is None
    assert any(r.verdict is not Verdict.RIGHT for one in first for r in one.results())


def test_the_report_has_the_keys_of_the_contract(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["stress", "--case", "n9", "-f", "json"]) == 0
    found = json.loads(capsys.readouterr().out)
    assert {"cases", "passed", "failed"} <= set(found)
    (case,) = found["cases"]
    assert set(case) == {"id", "title", "expected", "results"}
    assert set(case["results"][0]) == {"method", "verdict", "error_rad"}


def test_a_failure_prints_all_and_ends_in_one(monkeypatch, capsys) -> None:
    from nmatrix.studies import stress as module

    wrong = Contestant("ours", lambda: (2.0,), is_ours=True)
    bad = Case("B1", "made to fail", "", (Fraction(1),), "a test", (wrong,))
    monkeypatch.setattr(module, "CATALOGUE", (bad, *CATALOGUE[:1]))
    assert run(["stress"]) == 1
    printed = capsys.readouterr()
    assert "made to fail" in printed.out
    assert printed.err.count("\n") == 1


@pytest.mark.parametrize(
    ("line", "says"),
    [
        (["--case", "N99"], "did you mean"),
        (["--random", "0"], "whole number"),
        (["--random", "2", "--seed", "x"], "--seed"),
        (["--random", "2", "--case", "N1"], "keep one"),
    ],
)
def test_misuse_is_one_line(capsys, line: list[str], says: str) -> None:
    assert run(["stress", *line]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1


def test_a_case_can_be_named() -> None:
    assert case_named("r1").title.startswith("a floor")
