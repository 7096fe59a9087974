"""The hard cases: ours is right on each, somebody still fails each, and the judge is strict."""

from __future__ import annotations

import json
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from nmatrix.cli.app import run
from nmatrix.studies import methods
from nmatrix.studies.hardcases import normals
from nmatrix.studies.hardcases.case import Case, CaseVerdict, Contestant, exactly, spelled
from nmatrix.studies.hardcases.families import NAMES, random_cases
from nmatrix.studies.hardcases.oracle import determinant, true_normal
from nmatrix.studies.methods import Method
from nmatrix.studies.stress import CATALOGUE, FAMILIES, case_named, stress

ROWS = {"N": 19, "V": 4, "E": 7, "D": 8, "R": 10, "M": 6}  # the cases of each family


@pytest.mark.parametrize("case", CATALOGUE, ids=lambda case: case.id)
def test_ours_is_right_and_somebody_still_fails(case: Case) -> None:
    results = case.results()
    assert [r for r in results if r.is_ours]
    assert all(r.verdict is CaseVerdict.RIGHT for r in results if r.is_ours), results
    assert any(r.verdict is not CaseVerdict.RIGHT for r in results if not r.is_ours)


def test_every_row_of_the_catalogue_is_there_once_and_in_order() -> None:
    found = [one.id for one in CATALOGUE]
    numbered = [f"{letter}{i + 1}" for letter in FAMILIES for i in range(ROWS[letter])]
    assert [one for one in found if one[-1].isdigit()] == numbered
    assert len(set(found)) == len(found)


def test_the_page_on_accuracy_lists_every_family_and_every_case() -> None:
    lines = (Path(__file__).resolve().parents[2] / "docs" / "accuracy.md").read_text().splitlines()
    families = [f"| {letter} | {words} |" for letter, words in FAMILIES.items()]
    cases = [f"| {one.id} | {one.title} | {one.reason} |" for one in CATALOGUE]
    assert [line for line in lines if line in families] == families
    first = lines.index(cases[0])
    assert lines[first:] == cases


def judged(found: object, expected: object = exactly(1, 0, 0), **case: bool) -> CaseVerdict:
    one = Contestant("x", lambda: found)  # type: ignore[arg-type, return-value]
    row = Case("T", "t", "", expected, "", (one,), **case)  # type: ignore[arg-type]
    return row.results()[0].verdict


def test_the_judge_tells_every_kind_of_answer_apart() -> None:
    assert judged((1.0, 0.0, 0.0)) is CaseVerdict.RIGHT
    assert judged((1.0, 1e-9, 0.0)) is CaseVerdict.IMPRECISE
    assert judged((1.0, 0.1, 0.0)) is CaseVerdict.WRONG
    assert judged((float("nan"),) * 3) is CaseVerdict.NAN
    assert judged((0.0, 0.0, 0.0)) is CaseVerdict.ZERO
    assert judged((-2.0, 0.0, 0.0), is_direction=True) is CaseVerdict.FLIPPED
    assert judged((7.0, 0.0, 0.0), is_direction=True) is CaseVerdict.RIGHT
    assert judged((1.0,), None) is CaseVerdict.NOT_REPORTED
    assert judged(None, None) is CaseVerdict.RIGHT
    assert judged(None) is CaseVerdict.NAN


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
    first, again = random_cases(60, 3), random_cases(60, 3)
    assert [one.given for one in first] == [one.given for one in again]
    assert {one.title for one in first} == set(NAMES)
    assert stress(first).failure is None
    for name in NAMES:
        family = [one for one in first if one.title == name]
        lost = [r for one in family for r in one.results() if r.verdict is not CaseVerdict.RIGHT]
        assert lost, f"{name} is hard for nobody"


def test_the_first_cases_do_not_depend_on_the_count() -> None:
    assert [one.given for one in random_cases(8, 5)] == [
        one.given for one in random_cases(20, 5)[:8]
    ]


@pytest.mark.slow
def test_two_thousand_random_cases_are_right() -> None:
    assert stress(random_cases(2_000, 11)).failure is None


def test_a_failing_random_input_is_printed_to_the_last_bit_and_can_be_replayed(
    monkeypatch, capsys
) -> None:
    mutant = Method("exact", "the sign dropped", dropped_sign, is_ours=True)
    monkeypatch.setattr(normals, "METHODS", (mutant,))
    assert run(["stress", "--random", "12", "--seed", "9", "-f", "json"]) == 1
    printed = capsys.readouterr()
    remark = json.loads(printed.out)["remarks"][0]
    again = remark.partition("Again: ")[2]
    name = again.rpartition(" ")[2]
    case = next(one for one in random_cases(12, 9) if one.id == name)
    assert case.given in remark
    matrix = case.given.partition("A = ")[2].partition(", n = ")[0]
    entries = [float(x) for row in matrix.split(";") for x in row.split()]
    assert spelled(np.reshape(entries, (3, 3)).tolist()) == matrix
    assert run(again.split()[1:]) == 1
    assert name in capsys.readouterr().err


def test_the_guarded_level_is_not_held_to_exactness() -> None:
    assert [one.name for one in methods.METHODS if one.is_ours] == ["exact", "certified"]


def test_the_oracle_agrees_with_a_second_one() -> None:
    flint = pytest.importorskip("flint", reason="python-flint is not installed")
    for case in random_cases(60, 21):
        if case.title == "half-pixel grid":
            continue
        matrix, _, n = case.given.removeprefix("A = ").partition(", n = (")
        rows = [[Fraction(float(x)) for x in row.split()] for row in matrix.split(";")]
        normal = [Fraction(float(x)) for x in n.rstrip(")").split(", ")]
        A = flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator) for x in row] for row in rows])
        det = A.det()
        assert (determinant(rows) > 0, determinant(rows) < 0) == (det > 0, det < 0)
        if det != 0:
            b = flint.fmpq_mat([[flint.fmpq(x.numerator, x.denominator)] for x in normal])
            solved = A.transpose().solve(b)
            true = [Fraction(int(solved[i, 0].p), int(solved[i, 0].q)) for i in range(3)]
            found = true_normal(rows, normal)
            assert found is not None
            assert all(found[i] * true[j] == found[j] * true[i] for i, j in ((0, 1), (1, 2)))
            assert sum(f * t for f, t in zip(found, true, strict=True)) > 0


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
        (["--random", "2", "--case", "N1"], "there are 2, S0 to S1"),
    ],
)
def test_misuse_is_one_line(capsys, line: list[str], says: str) -> None:
    assert run(["stress", *line]) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1


def test_a_case_can_be_named() -> None:
    assert case_named("r1").title.startswith("a floor")
