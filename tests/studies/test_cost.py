"""The studies find what is known to be so; each target has its answer, and each misuse its line."""

from __future__ import annotations

import json
import random
from collections.abc import Callable
from dataclasses import replace
from math import pi
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from PIL import Image, ImageColor

from nmatrix.canvas.theme import PALETTES
from nmatrix.cli import studies as command
from nmatrix.enums import Shading, Theme
from nmatrix.studies import methods, normals, shading, spaces
from nmatrix.studies.hardcases.case import CaseVerdict
from nmatrix.studies.harness import SEED, Ratio, Run, SelfTest, untimed
from nmatrix.studies.measurements import (
    Measurement,
    Study,
    Target,
    Unit,
    overall,
    with_fronts,
    without_times,
)
from nmatrix.studies.methods import METHODS, VISITORS, Array, method
from nmatrix.studies.report import report
from nmatrix.studies.stress import CATALOGUE

EVEN = Ratio(1.0, 1.0, 1.0, 1.0)
SOUND = SelfTest(EVEN, Ratio(1.0, 2.0, 2.0, 2.0))
BUSY = SelfTest(Ratio(1.0, 1.3, 1.2, 1.4), SOUND.twice)


def evenly(run: Run, reference: Run) -> Ratio:
    """Run both contestants once and call them equally fast."""
    run()
    reference()
    return EVEN


def measured(tasks: list) -> tuple:
    return with_fronts([task() for task in tasks])


SMALL = normals.Extent(checked=12, batch=12, kappas=(1e0, 1e8, 1e16), slow_methods=False)


@pytest.fixture(scope="module")
def rows() -> tuple:
    with np.errstate(all="ignore"):
        return measured(normals.tasks(evenly, SMALL))


def of(rows: tuple, name: str, setting: str):
    return next(one for one in rows if one.method == name and one.setting == setting)


def test_ours_is_never_wrong(rows: tuple) -> None:
    for one in rows:
        if one.method == "certified":
            assert one.failures == 0
            assert one.more["median_error"] <= one.error <= 1e-14


def test_the_guarded_level_is_never_wrong_by_more_than_it_says(rows: tuple) -> None:
    for one in rows:
        if one.method == "guarded":
            assert one.failures == 0
            assert one.error <= 2.0**-36


def test_everyone_else_is_wrong_somewhere(rows: tuple) -> None:
    visitors = {one.name for one in VISITORS.values()}
    others = (one for one in METHODS if not one.is_ours and one.name not in {"guarded", *visitors})
    names = [one.name for one in others if one.is_batched]
    for name in names:
        mine = [one for one in rows if one.method == name]
        assert max(one.error for one in mine) > 1e-9, name


def test_plain_cofactors_lose_to_an_inverse_where_normals_cancel(rows: tuple) -> None:
    setting = "κ = 1e+08, adversarial"
    assert of(rows, "cofactor", setting).error > 10 * of(rows, "inverse", setting).error


def test_the_matrix_itself_is_right_for_rotations_alone(rows: tuple) -> None:
    assert of(rows, "matrix", "κ = 1e+00, random").error < 1e-14
    assert of(rows, "matrix", "κ = 1e+08, random").error > 0.5


def test_a_wrong_answer_is_counted_by_its_kind() -> None:
    family = next(normals.families(9, (1e0,)))
    right = method("exact").normals(family.matrices, family.normals)
    flat = normals.Family("flat", np.zeros((9, 3, 3)), np.ones((9, 3)))
    for carried, given, verdict in (
        (right, family, CaseVerdict.RIGHT),
        (-right, family, CaseVerdict.FLIPPED),
        (right * np.nan, family, CaseVerdict.NAN),
        (right * 0, family, CaseVerdict.ZERO),
        (right, flat, CaseVerdict.NOT_REPORTED),
        (right * 0, flat, CaseVerdict.RIGHT),
    ):
        found = normals.errors(carried, given)
        assert found.verdicts == {verdict: 9}
        is_wrong = verdict is not CaseVerdict.RIGHT
        assert found.failures == (9 if is_wrong else 0)
        assert (found.worst, found.median) == pytest.approx((pi, pi) if is_wrong else (0, 0))


def test_a_wrong_answer_counts_in_the_error_and_is_not_on_the_front(rows: tuple) -> None:
    cofactor = of(rows, "cofactor", "extreme exponents")
    assert 0 < cofactor.failures < cofactor.more["matrices"]
    assert cofactor.error == pi
    for row in rows:
        assert not (row.failures and row.on_front), row
        assert row.error > 1 if row.failures else row.error <= pi


def test_every_kappa_is_measured_on_one_matrix_and_on_many(rows: tuple) -> None:
    settings = {row.setting for row in rows}
    for kappa in ("1e+00", "1e+08", "1e+16"):
        assert {f"κ = {kappa}, random", f"one matrix, κ = {kappa}"} <= settings
    assert {"extreme exponents", "mixed exponents"} <= settings


def test_medians_hide_what_the_worst_shows(rows: tuple) -> None:
    found = of(rows, "inverse", "κ = 1e+16, adversarial")
    assert 0 < found.more["median_error"] < found.error


@pytest.fixture(scope="module")
def pictures() -> dict:
    found = measured(shading.tasks(evenly, shading.Resolution((48, 48))))
    return {(row.setting, row.method): row for row in found}


def test_more_samples_come_closer_to_the_reference(pictures: dict) -> None:
    errors = [pictures["samples", str(n)].error for n in (1, 4, 16, 64)]
    assert errors == sorted(errors, reverse=True)


def test_light_at_fragments_is_closer_than_at_vertices_or_faces(pictures: dict) -> None:
    flat, gouraud, phong = (pictures["shading", one.value].error for one in Shading)
    assert flat > gouraud > phong


def test_finer_meshes_have_better_normals(pictures: dict) -> None:
    names = [f"{rings} × {sectors}" for rings, sectors in shading.TESSELLATIONS]
    angles = [pictures["tessellation", name].more["mean_normal_deg"] for name in names]
    assert angles[0] > 2 * angles[1] > 4 * angles[2]
    assert angles[0] > 10 * angles[3]


def test_affine_interpolation_ruins_the_floor(pictures: dict) -> None:
    affine, right = (pictures["interpolation", one] for one in ("affine", "perspective"))
    assert affine.error > 5 * right.error


def test_float32_attributes_cost_a_picture_nothing_that_can_be_seen(pictures: dict) -> None:
    single, double = (pictures["attributes", one] for one in ("float32", "float64"))
    assert single.error == pytest.approx(double.error, abs=1e-3)  # levels
    assert 0 < single.more["max_normal_deg"] < 1e-3
    assert double.more["max_normal_deg"] == 0


def test_leaving_out_the_normalising_shortens_normals_and_turns_none(pictures: dict) -> None:
    left_out, done = (pictures["normalising", one] for one in ("left out", "done"))
    assert left_out.error != done.error
    assert left_out.more["max_normal_deg"] < 1e-9


def test_a_larger_shadow_map_comes_closer(pictures: dict) -> None:
    errors = [pictures["shadow map", str(n)].error for n in shading.SHADOW_MAPS]
    assert errors == sorted(errors, reverse=True)


def test_the_plan_costs_the_picture_nothing(pictures: dict) -> None:
    planned, everything = (pictures["effects", one].error for one in ("planned", "all"))
    assert planned == pytest.approx(everything, abs=0.5)


def test_errors_are_ordered_as_their_names_say(pictures: dict) -> None:
    for row in pictures.values():
        found = row.more
        assert found["mean_levels"] <= found["rms_levels"] <= found["max_levels"] <= 255
        assert row.error == found["rms_levels"]


def test_counted_costs_stand_beside_times() -> None:
    found = measured(spaces.tasks(evenly, (100,)))
    assert {row.method: row.error for row in found}["world"] == 47
    assert {row.method: row.error for row in found}["object"] == 16 + 9 + 6  # the metric
    assert {row.method: row.error for row in found}["static"] == 16


def test_the_report_has_the_keys_of_the_contract(rows: tuple) -> None:
    found = report(Study.NORMALS, rows, SOUND.with_rows([EVEN] * 3), Target(tolerance=1e-14)).data
    assert set(found) == {"rows", "cheapest", "harness", "machine"}
    keys = "method setting error unit time_ns ratio ratio_ci failures on_front work".split()
    assert list(found["rows"][0])[: len(keys)] == keys
    assert found["harness"] == {
        "aa_ratio": 1.0,
        "aa_ci": [1.0, 1.0],
        "aa_rows": 3,
        "aa_rows_with_one": 3,
        "untimed_because": None,
    }
    assert found["machine"]["seed"] == SEED
    assert found["cheapest"]["error"] <= 1e-14
    assert found["cheapest"]["method"] in ("exact", "certified")
    loose = report(Study.NORMALS, rows, SOUND, Target(tolerance=2.0)).data["cheapest"]
    assert loose["method"] != "cofactor", "it turns mirrors inside out, or is zero somewhere"


def test_a_budget_is_kept_by_the_longest_time_not_by_that_of_the_highest_ratio() -> None:
    slow_reference = Measurement("a", "s", 1.0, Unit.RADIANS, Ratio(9.0, 0.1, 0.1, 0.1), 1.0)
    quick_reference = replace(slow_reference, setting="t", timing=Ratio(2.0, 3.0, 3.0, 3.0))
    (found,) = overall([slow_reference, quick_reference])
    assert (found.timing.seconds, found.timing.ratio) == (9.0, 3.0)
    assert Target(seconds=5.0).met_by([found]) is None


def test_on_a_busy_machine_errors_failures_and_work_are_told(rows: tuple) -> None:
    bare = with_fronts(without_times(rows))
    found = report(Study.NORMALS, bare, BUSY, Target(tolerance=1e-14))
    timed = {"time_ns", "ratio", "ratio_ci", "on_front"}
    for row, known in zip(found.data["rows"], report_of(rows).data["rows"], strict=True):
        assert row["time_ns"] is row["ratio"] is row["ratio_ci"] is None
        assert {k: v for k, v in row.items() if k not in timed} == {
            k: v for k, v in known.items() if k not in timed
        }
    batches = [row for row in bare if not row.setting.startswith(normals.ONE)]
    right = {row.method: row.work for row in overall(batches) if row.rank <= (0, 1e-14)}
    assert found.data["cheapest"]["method"] == min(right, key=right.get) != "exact"
    assert found.data["harness"]["untimed_because"] == BUSY.objection
    assert [remark for remark in found.remarks if "counted work" in remark]
    assert not [remark for remark in found.remarks if "contains 1" in remark]
    assert found.failure is None
    budget = report(Study.NORMALS, bare, BUSY, Target(seconds=1e9))
    assert budget.data["cheapest"] is None


def report_of(rows: tuple):
    return report(Study.NORMALS, rows, SOUND, Target())


def test_counted_work_is_the_same_again(rows: tuple) -> None:
    with np.errstate(all="ignore"):
        again = [task() for task in normals.tasks(untimed, SMALL)]
    assert [row.work for row in again] == [row.work for row in rows]
    assert all(row.timing is None for row in again)


def test_counted_work_grows_where_whole_numbers_must_decide(rows: tuple) -> None:
    easy, hard = (
        of(rows, "certified", f"κ = {kappa}").work
        for kappa in ("1e+00, random", "1e+16, adversarial")
    )
    assert hard > easy


class Counting:
    """A number that counts multiplications and divisions."""

    count = 0

    def __init__(self, value: float) -> None:
        self.value = value

    def __mul__(self, other: Counting) -> Counting:
        Counting.count += 1
        return Counting(self.value * other.value)

    def __truediv__(self, other: Counting) -> Counting:
        Counting.count += 1
        return Counting(self.value / other.value)

    def __add__(self, other: Counting | int) -> Counting:
        return Counting(self.value + (other.value if isinstance(other, Counting) else other))

    __radd__ = __add__

    def __sub__(self, other: Counting) -> Counting:
        return Counting(self.value - other.value)

    def __neg__(self) -> Counting:
        return Counting(-self.value)

    def __eq__(self, other: object) -> bool:
        return self.value == other

    def __lt__(self, other: float) -> bool:
        return self.value < other

    __hash__ = None


WORDS = 4  # products of 64-bit words in one of numbers of 113 bits


@pytest.mark.parametrize(
    ("carry", "said"),
    [
        (methods.matrix_itself, method("matrix").multiplications),
        (methods.plain_cofactor, method("cofactor").multiplications),
        (methods.plain_cofactor, method("float16-cofactor").multiplications),
        (methods.zero_matrix, method("zero-matrix").multiplications),
        (methods.oriented_cofactor, VISITORS["numpy_quaddtype"].multiplications / WORDS),
    ],
)
def test_a_formula_takes_as_many_multiplications_as_is_said(
    carry: methods.Carry, said: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(methods, "_unit", lambda vectors: vectors)
    family = next(normals.families(4, (1e4,)))
    A, n = (np.vectorize(Counting, otypes=[object])(x) for x in (family.matrices, family.normals))
    Counting.count = 0
    carry(A, n)
    assert Counting.count == said * len(A)


@pytest.mark.parametrize("package", VISITORS)
def test_contestants_of_other_packages_answer_where_they_are_installed(package: str) -> None:
    pytest.importorskip(package)
    visitor = VISITORS[package]
    assert visitor in METHODS
    found: Array
    for family in normals.families(9, (1e0, 1e16)):
        found = visitor.normals(family.matrices, family.normals)
        assert normals.errors(found, family).worst <= 1e-15, family.name
    silhouette = next(case for case in CATALOGUE if case.id == "N6").results()
    (judged,) = (result for result in silhouette if result.method == visitor.name)
    assert judged.verdict is not CaseVerdict.RIGHT, "it does not say that there is no normal"


def test_rows_of_the_reference_are_marked_in_each_study(rows: tuple, pictures: dict) -> None:
    assert {row.method for row in rows if row.is_reference} == {"inverse"}
    found = {name for name, row in pictures.items() if row.is_reference}
    assert {("shading", "phong"), ("samples", "4"), ("effects", "planned")} <= found
    assert ("shadow map", "64") not in found
    assert ("interpolation", "affine") not in found
    many = measured(spaces.tasks(evenly, (100,)))
    assert [row.method for row in many if row.is_reference] == ["world"]


def quiet_work(monkeypatch: pytest.MonkeyPatch, took: Callable[[], float]) -> None:
    """Give the command a clock that only its own work moves."""
    now = 0.0

    def work() -> None:
        nonlocal now
        now += took()

    monkeypatch.setattr(command, "time", SimpleNamespace(perf_counter=lambda: now))
    monkeypatch.setattr(command, "_work", work)
    monkeypatch.setattr(spaces, "_vertex_stage", lambda *_: work)


def test_the_command_answers_and_draws(nmatrix, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    quiet_work(monkeypatch, lambda: 0.01)
    code, out, _ = nmatrix("cost spaces --quick --chart a.svg -f json")
    assert code == 0
    found = json.loads(out)
    assert found["harness"]["aa_ratio"] == pytest.approx(1)
    assert found["harness"]["aa_rows"] == found["harness"]["aa_rows_with_one"] == 2
    assert [row["ratio"] for row in found["rows"]] == pytest.approx([1] * len(found["rows"]))
    assert Path("a.svg").read_bytes().startswith(b"<?xml")


def test_the_size_and_the_theme_are_those_of_the_chart(
    nmatrix, tmp_path: Path, monkeypatch
) -> None:
    monkeypatch.chdir(tmp_path)
    quiet_work(monkeypatch, lambda: 0.01)
    assert nmatrix("cost spaces --quick --chart a.png --size 320 200 --theme dark")[0] == 0
    image = Image.open("a.png")
    assert image.size == (320, 200)
    assert image.getpixel((1, 1)) == ImageColor.getrgb(PALETTES[Theme.DARK].paper)


def test_all_adds_tables_and_no_key(nmatrix, monkeypatch) -> None:
    quiet_work(monkeypatch, lambda: 0.01)
    (_, few, _), (_, full, _) = (nmatrix(f"cost spaces --quick {one}") for one in ("", "--all"))
    assert len(full.splitlines()) > len(few.splitlines())
    assert "--all adds" in few
    keys = [json.loads(nmatrix(f"cost spaces --quick {one} -f json")[1]) for one in ("", "--all")]
    assert keys[0].keys() == keys[1].keys()


def test_a_busy_machine_draws_the_spread_of_times(nmatrix, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    draw = random.Random(1)
    quiet_work(monkeypatch, lambda: 0.01 * draw.paretovariate(0.5))
    code, out, _ = nmatrix("cost spaces --quick --chart a.svg -f json")
    assert code == 0
    assert {row["time_ns"] for row in json.loads(out)["rows"]} == {None}
    assert "bars are the spread of a time" in Path("a.svg").read_text()


def test_the_command_answers_on_a_busy_machine_too(nmatrix, monkeypatch) -> None:
    draw = random.Random(1)
    quiet_work(monkeypatch, lambda: 0.01 * draw.paretovariate(0.5))
    code, out, error = nmatrix("cost spaces --quick --tolerance 20multiplications -f json")
    assert code == 2
    assert "all spaces give one picture" in error
    code, out, _ = nmatrix("cost spaces --quick -f json")
    assert code == 0
    found = json.loads(out)
    assert found["harness"]["untimed_because"]
    assert {row["time_ns"] for row in found["rows"]} == {None}
    assert {row["method"]: row["work"] for row in found["rows"]} == {
        row["method"]: row["error"] for row in found["rows"]
    }
    code, out, _ = nmatrix("cost spaces --quick")
    assert code == 0
    assert out.count("No time is told") == 1


def test_where_the_rows_against_themselves_fail_no_time_is_told(nmatrix, monkeypatch) -> None:
    """The clock passes its own test, and then the machine slows down whoever runs first."""
    quiet_work(monkeypatch, lambda: 0.01)
    off = Ratio(1.0, 1.2, 1.1, 1.3)
    monkeypatch.setattr(command, "_harness", lambda **_: SimpleNamespace(ratio=lambda *_: off))
    code, out, _ = nmatrix("cost spaces --quick -f json")
    assert code == 0
    found = json.loads(out)
    assert found["harness"]["untimed_because"] == "only 0 of 2 rows against themselves contain 1"
    assert {row["ratio"] for row in found["rows"]} == {None}
    assert [row["method"] for row in found["rows"] if row["on_front"]] == ["static"] * 2


MISUSE = [
    ("cost normals --tolerance 3", "deg, rad"),
    ("cost shading --tolerance 1deg", "levels"),
    ("cost normals --budget 5", "ns, us, ms, s"),
    ("cost normals --budget -5ms", "positive"),
    ("cost normals --budget 5ms --tolerance 1deg", "keep one"),
    ("cost --chart a.mp4", ".svg, .pdf, .png, .gif, .webp, .jpeg, .jpg; end it in .svg"),
    ("cost everything", "normals"),
    ("cost --size 800 450", "add --chart FILE"),
    ("cost --theme dark", "add --chart FILE"),
    ("cost --chart a.svg --size 0 9", "whole numbers of pixels"),
    ("cost --chart a.svg --theme pink", "light"),
]


@pytest.mark.parametrize(("line", "says"), MISUSE)
def test_misuse_is_one_line(nmatrix, line: str, says: str) -> None:
    code, _, error = nmatrix(line)
    assert code == 2
    assert says in error
    assert error.count("\n") == 1


def test_the_front_is_that_of_the_ratios_whatever_the_seconds_drifted_to() -> None:
    slower_clock = Ratio(seconds=2.0, ratio=0.5, low=0.5, high=0.5)
    usual_clock = Ratio(seconds=1.0, ratio=1.0, low=1.0, high=1.0)
    fast, slow = (
        Measurement("fast", "s", 1.0, Unit.RADIANS, slower_clock, 1.0),
        Measurement("slow", "s", 2.0, Unit.RADIANS, usual_clock, 1.0),
    )
    assert [row.on_front for row in with_fronts([fast, slow])] == [True, False]
    assert Target(tolerance=3.0).met_by([slow, fast]) == fast


@pytest.mark.parametrize(
    ("line", "hint"),
    [
        ("cost shading --quick --tolerance 0levels", "try 2levels"),
        ("cost shading --quick --tolerance 1e-3deg", "try 2levels"),
        ("cost normals --quick --tolerance 2levels", "try 1e-3deg"),
        ("cost normals --quick --budget 0ms", "try 5ms"),
    ],
)
def test_the_unit_that_a_hint_has_is_one_that_the_study_takes(nmatrix, line, hint) -> None:
    code, _, error = nmatrix(line)
    assert code == 2
    assert error.strip().endswith(hint)
