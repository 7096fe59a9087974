"""The studies find what is known to be so; each wish has its answer, and each misuse its line."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest

from nmatrix.cli.app import run
from nmatrix.enums import Shading
from nmatrix.linear.methods import METHODS, method
from nmatrix.studies import chart, normals, shading, spaces
from nmatrix.studies.harness import Harness, Ratio
from nmatrix.studies.report import Wish, report


class Ticking:
    """A clock on which every look takes a hundredth of a second."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        self.now += 0.01
        return self.now


HARNESS = Harness(Ticking(), shortest=0.005, rounds=1)
SMALL = normals.Extent(checked=12, batch=12, kappas=(1e0, 1e8, 1e16), slow_methods=False)


@pytest.fixture(scope="module")
def rows() -> tuple:
    with np.errstate(all="ignore"):
        return normals.normals(HARNESS, SMALL)


def of(rows: tuple, name: str, setting: str):
    return next(one for one in rows if one.method == name and one.setting == setting)


def test_ours_is_never_wrong(rows: tuple) -> None:
    for one in rows:
        if one.method == "certified":
            assert one.failures == 0
            assert one.error <= 1e-14


def test_everyone_else_is_wrong_somewhere(rows: tuple) -> None:
    names = [one.name for one in METHODS if not one.is_ours and one.name not in normals.SLOW]
    for name in names:
        mine = [one for one in rows if one.method == name]
        assert max(one.error for one in mine) > 1e-9 or any(one.failures for one in mine), name


def test_plain_cofactors_lose_to_an_inverse_where_normals_cancel(rows: tuple) -> None:
    setting = "κ = 1e+08, adversarial"
    assert of(rows, "cofactor", setting).error > 10 * of(rows, "inverse", setting).error


def test_the_matrix_itself_is_right_for_rotations_alone(rows: tuple) -> None:
    assert of(rows, "matrix", "κ = 1e+00, random").error < 1e-14
    assert of(rows, "matrix", "κ = 1e+08, random").error > 0.5


def test_a_wrong_answer_is_counted() -> None:
    family = next(normals.families(9, (1e0,)))
    right = method("exact").normals(family.matrices, family.normals)
    assert normals.errors(right, family)[1] == 0
    assert normals.errors(-right, family)[1] == 9
    assert normals.errors(right * np.nan, family)[1] == 9
    assert normals.errors(right * 0, family)[1] == 9


def test_more_samples_come_closer_to_the_reference() -> None:
    found = {row.method: row for row in shading.shading(HARNESS, (48, 48))}
    means = [float(found[f"samples {n}"].unit.split()[-1]) for n in (1, 4, 16, 64)]
    assert means == sorted(means, reverse=True)
    assert found[f"shading {Shading.FLAT}"].error > found[f"shading {Shading.PHONG}"].error
    assert found["effects all"].error == pytest.approx(found["effects planned"].error, abs=1)


def test_counted_costs_stand_beside_times() -> None:
    found = spaces.spaces(HARNESS, (100,))
    assert {row.method: row.error for row in found}["world"] == 47
    assert {row.method: row.error for row in found}["object"] == 16


def test_a_chart_is_drawn_in_both_kinds(rows: tuple) -> None:
    assert chart.chart(rows, "title", "png").startswith(b"\x89PNG")
    svg = chart.chart(rows, "title", "svg")
    assert b"<svg" in svg
    assert svg == chart.chart(rows, "title", "svg")


def test_the_report_has_the_keys_of_the_contract(rows: tuple) -> None:
    found = report("normals", rows, Ratio(1, 1, 0.9, 1.1), Wish(tolerance=1e-14)).data
    assert set(found) == {"rows", "cheapest", "harness", "machine"}
    keys = "method setting error unit time_ns ratio ratio_ci failures on_front".split()
    assert list(found["rows"][0]) == keys
    assert found["cheapest"]["error"] <= 1e-14
    assert found["cheapest"]["method"] in ("exact", "certified")
    loose = report("normals", rows, Ratio(1, 1, 1, 1), Wish(tolerance=2.0)).data["cheapest"]
    assert loose["method"] != "cofactor", "it turns mirrors inside out, or is zero somewhere"


def test_the_command_answers(capsys, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    assert run(["cost", "spaces", "--quick", "--chart", "a.svg", "-f", "json"]) in (0, 1)
    out = capsys.readouterr().out
    if out:
        assert json.loads(out)["rows"]
        assert Path("a.svg").read_bytes().startswith(b"<?xml")


MISUSE = [
    (["cost", "normals", "--tolerance", "3"], "deg, rad"),
    (["cost", "shading", "--tolerance", "1deg"], "levels"),
    (["cost", "normals", "--budget", "5"], "ns, us, ms, s"),
    (["cost", "normals", "--budget", "-5ms"], "positive"),
    (["cost", "normals", "--budget", "5ms", "--tolerance", "1deg"], "keep one"),
    (["cost", "--chart", "a.pdf"], ".svg or .png"),
    (["cost", "everything"], "normals"),
]


@pytest.mark.parametrize(("line", "says"), MISUSE)
def test_misuse_is_one_line(capsys, line: list[str], says: str) -> None:
    assert run(line) == 2
    error = capsys.readouterr().err
    assert says in error
    assert error.count("\n") == 1
