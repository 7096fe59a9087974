"""The hard cases: ours is right on each, somebody still fails each, and the judge is strict."""

from __future__ import annotations

import json
import tracemalloc
from collections.abc import Iterator
from fractions import Fraction
from itertools import islice
from pathlib import Path

import numpy as np
import pytest

from nmatrix.cli import studies as command
from nmatrix.studies import methods
from nmatrix.studies import stress as report
from nmatrix.studies.hardcases import families, normals
from nmatrix.studies.hardcases.case import Case, CaseVerdict, Contestant, exactly, judge, spelled
from nmatrix.studies.hardcases.families import NAMES, random_cases, random_ids
from nmatrix.studies.hardcases.oracle import determinant, true_normal
from nmatrix.studies.methods import Method
from nmatrix.studies.stress import CATALOGUE, FAMILIES, KEPT, case_named, stress

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


def test_the_judge_tells_every_kind_of_answer_apart() -> None:
    x, nan = exactly(1, 0, 0), float("nan")
    for found, expected, verdict in (
        ((1.0, 0.0, 0.0), x, CaseVerdict.RIGHT),
        ((1.0, 1e-9, 0.0), x, CaseVerdict.IMPRECISE),
        ((1.0, 0.1, 0.0), x, CaseVerdict.WRONG),
        ((nan, nan, nan), x, CaseVerdict.NAN),
        ((0.0, 0.0, 0.0), x, CaseVerdict.ZERO),
        (None, x, CaseVerdict.NAN),
        (None, None, CaseVerdict.RIGHT),
        ((1.0,), None, CaseVerdict.NOT_REPORTED),
        ((nan,), None, CaseVerdict.NAN),
    ):
        assert judge(found, expected)[0] is verdict
    assert judge((-2.0, 0.0, 0.0), x, is_direction=True)[0] is CaseVerdict.FLIPPED
    assert judge((7.0, 0.0, 0.0), x, is_direction=True)[0] is CaseVerdict.RIGHT


def dropped_sign(A: np.ndarray, n: np.ndarray) -> np.ndarray:
    return methods.plain_cofactor(A, n)


def test_a_mutant_of_ours_is_caught(monkeypatch: pytest.MonkeyPatch) -> None:
    mutant = Method("exact", "the sign dropped", dropped_sign, 27, is_ours=True)
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
    first, again = list(random_cases(60, 3)), list(random_cases(60, 3))
    assert [one.given for one in first] == [one.given for one in again]
    assert {one.title for one in first} == set(NAMES)
    assert stress(first).failure is None
    for name in NAMES:
        family = [one for one in first if one.title == name]
        lost = [r for one in family for r in one.results() if r.verdict is not CaseVerdict.RIGHT]
        assert lost, f"{name} is hard for nobody"


def test_the_first_cases_do_not_depend_on_the_count() -> None:
    few, many = random_cases(8, 5), islice(random_cases(20, 5), 8)
    assert [one.given for one in few] == [one.given for one in many]


@pytest.mark.slow
def test_two_thousand_random_cases_are_right() -> None:
    assert stress(random_cases(2_000, 11)).failure is None


def test_a_failing_random_input_is_printed_to_the_last_bit_and_can_be_replayed(
    monkeypatch, nmatrix
) -> None:
    mutant = Method("exact", "the sign dropped", dropped_sign, 27, is_ours=True)
    monkeypatch.setattr(normals, "METHODS", (mutant,))
    code, out, _ = nmatrix("stress --random 12 --seed 9 -f json")
    assert code == 1
    remark = json.loads(out)["remarks"][0]
    again = remark.partition("Again: ")[2]
    name = again.rpartition(" ")[2]
    case = next(one for one in random_cases(12, 9) if one.id == name)
    assert case.given in remark
    matrix = case.given.partition("A = ")[2].partition(", n = ")[0]
    entries = [float(x) for row in matrix.split(";") for x in row.split()]
    assert spelled(np.reshape(entries, (3, 3)).tolist()) == matrix
    code, _, error = nmatrix(again.partition(" ")[2])
    assert code == 1
    assert name in error


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


def test_the_report_has_the_keys_of_the_contract(nmatrix) -> None:
    code, out, _ = nmatrix("stress --case n9 -f json")
    assert code == 0
    found = json.loads(out)
    assert {"cases", "passed", "failed"} <= set(found)
    (case,) = found["cases"]
    assert set(case) == {"id", "title", "expected", "results"}
    assert set(case["results"][0]) == {"method", "verdict", "error_rad"}


def test_a_failure_prints_all_and_ends_in_one(monkeypatch, nmatrix) -> None:
    from nmatrix.studies import stress as module

    wrong = Contestant("ours", lambda: (2.0,), is_ours=True)
    bad = Case("B1", "made to fail", "", (Fraction(1),), "a test", (wrong,))
    monkeypatch.setattr(module, "CATALOGUE", (bad, *CATALOGUE[:1]))
    code, out, error = nmatrix("stress")
    assert code == 1
    assert "made to fail" in out
    assert error.count("\n") == 1


@pytest.mark.parametrize(
    ("line", "says"),
    [
        ("--case N99", "did you mean"),
        ("--random 0", "whole number"),
        ("--random 2 --seed x", "--seed"),
        ("--random 2 --case N1", "there are 2, S0 to S1"),
    ],
)
def test_misuse_is_one_line(nmatrix, line: str, says: str) -> None:
    code, _, error = nmatrix(f"stress {line}")
    assert code == 2
    assert says in error
    assert error.count("\n") == 1


def test_a_case_can_be_named() -> None:
    ids = [one.id for one in CATALOGUE]
    assert case_named("r1", CATALOGUE, ids).title.startswith("a floor")
    assert case_named("n8B", CATALOGUE, ids).id == "N8b"


def test_a_random_case_is_named_without_making_those_behind_it(monkeypatch) -> None:
    made = []
    make = families._case
    monkeypatch.setattr(families, "_case", lambda *args: made.append(args[0]) or make(*args))
    assert case_named("s3", random_cases(100_000, 1), random_ids(100_000)).id == "S3"
    assert made == ["S0", "S1", "S2", "S3"]


def tiny_cases(count: int, wrong: int = 0) -> Iterator[Case]:
    """Make cases that hold a kilobyte each; ours fails the last ones."""
    for i in range(count):
        answer = (2.0 if i >= count - wrong else 1.0,)
        own = Contestant("exact", lambda answer=answer: answer, is_ours=True)
        naive = Contestant("inverse", lambda: (3.0,))
        yield Case(f"S{i}", "tiny", f"{i:01000}", exactly(1), "none", (own, naive))


def peak(count: int) -> int:
    stress(tiny_cases(9))  # what is imported or compiled once is no case's
    tracemalloc.start()
    try:
        stress(tiny_cases(count, wrong=count // 2))
        return tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


def test_any_number_of_cases_takes_the_memory_of_the_first_ones(monkeypatch) -> None:
    monkeypatch.setattr(report, "KEPT", 50)
    assert peak(2_000) < 2 * peak(200)


def test_cases_that_failed_are_kept_whatever_their_place() -> None:
    found = stress(tiny_cases(KEPT + 50, wrong=3))
    ids = [one["id"] for one in found.data["cases"]]
    assert ids == [f"S{i}" for i in (*range(KEPT), KEPT + 47, KEPT + 48, KEPT + 49)]
    assert found.data["failed"] == 3
    assert found.data["passed"] == KEPT + 47
    assert found.failure is not None
    assert found.remarks[-1].startswith("47 more cases")
    assert not stress(tiny_cases(KEPT)).remarks


@pytest.mark.parametrize("line", ["stress --random 4", "cost spaces --quick"])
def test_a_bar_shows_on_a_terminal_that_work_goes_on(nmatrix, monkeypatch, line: str) -> None:
    seen = []

    def progress(items, total: int, what: str):
        for one in items:
            seen.append((total, what))
            yield one

    monkeypatch.setattr(command, "progress", progress)
    assert nmatrix(line)[0] == 0
    assert len(seen) == seen[0][0]
