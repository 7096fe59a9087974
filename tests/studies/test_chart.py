"""Charts by their geometry, and sentences by their truth, on saved and made-up measurements."""

from __future__ import annotations

import csv
from io import BytesIO
from itertools import combinations
from math import log10, nan, pi, radians
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from nmatrix.canvas.marks import SMALLEST_TEXT, Box, Canvas, Polygon, Stroke, Text
from nmatrix.canvas.paint import pixels
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.text import plain
from nmatrix.canvas.theme import PALETTES
from nmatrix.cli.shared_options import option_name
from nmatrix.enums import PixelFormat, Theme, VectorFormat
from nmatrix.studies.chart import Look, chart, chart_file
from nmatrix.studies.easel import Easel
from nmatrix.studies.harness import Ratio, SelfTest
from nmatrix.studies.labels import Ground, Label, Weight, overlap
from nmatrix.studies.measurements import (
    Measurement,
    Study,
    Target,
    Unit,
    with_fronts,
    without_times,
)
from nmatrix.studies.methods import METHODS
from nmatrix.studies.normals import WRONG
from nmatrix.studies.report import report
from nmatrix.studies.summary import MOST, VISIBLE, Role, Summary, summary

UNITS = {Study.NORMALS: Unit.RADIANS, Study.SHADING: Unit.LEVELS}
SAME = Ratio(1.0, 1.0, 1.0, 1.0)
SOUND = SelfTest(SAME, Ratio(1.0, 2.0, 2.0, 2.0))
BUSY = SelfTest(Ratio(1.0, 1.3, 1.2, 1.4), SOUND.twice)


def _saved(study: Study) -> tuple[Measurement, ...]:
    with Path(__file__).with_name("measured.csv").open() as file:
        found = [line for line in csv.DictReader(file) if line["study"] == study]
    rows = []
    for line in found:
        counts = {name: int(line[name]) for name in WRONG}
        rows.append(
            Measurement(
                line["method"],
                line["setting"],
                float(line["error"]),
                UNITS.get(study, Unit.MULTIPLICATIONS),
                Ratio(*(float(line[name]) for name in ("seconds", "ratio", "low", "high"))),
                float(line["work"]),
                sum(counts.values()),
                is_reference=line["is_reference"] == "1",
                more={
                    "matrices": 200,
                    **counts,
                    "median_error": 0.0,
                    "max_levels": 1.0,
                    "mean_normal_deg": None,
                },
            )
        )
    return with_fronts(rows)


SAVED = {study: _saved(study) for study in Study}
SIZES = ((1600, 900), (1024, 768), (900, 1600), (3000, 700), (64, 64))


def summed(study: Study, *, is_told: bool = True) -> Summary:
    rows = SAVED[study]
    return summary(study, rows if is_told else without_times(rows), rows)


def texts(canvas: Canvas) -> list[Text]:
    return [mark for mark in canvas.marks if isinstance(mark, Text)]


LOOKS = [
    (study, is_told, Look(size, everything=everything))
    for study in Study
    for is_told in (True, False)
    for everything in (False, True)
    for size in (SIZES if is_told and not everything else SIZES[:1])
]


@pytest.fixture(
    scope="module", params=LOOKS, ids=lambda look: f"{look[0]}-{look[1]}-{look[2].size}"
)
def drawn(request) -> Slide:
    study, is_told, look = request.param
    return chart(summed(study, is_told=is_told), look)


def test_no_text_overlaps_another_or_leaves_the_canvas(drawn: Slide) -> None:
    canvas = drawn.canvas
    written = texts(canvas)
    for one in written:
        box = one.box
        assert box.x >= 0, one.text
        assert box.y >= 0, one.text
        assert box.right <= canvas.width, one.text
        assert box.bottom <= canvas.height, one.text
    for a, b in combinations(written, 2):
        assert not overlap(a.box, b.box), (a.text, b.text)


def test_no_text_is_too_small(drawn: Slide) -> None:
    assert min(one.size for one in texts(drawn.canvas)) >= SMALLEST_TEXT
    assert 36 <= texts(drawn.canvas)[0].size <= 44


@pytest.mark.parametrize("everything", [False, True])
@pytest.mark.parametrize("study", Study)
def test_every_contestant_that_is_shown_has_its_name_on_the_chart(
    study: Study, everything: bool
) -> None:
    told = summed(study)
    shown = told.shown(everything=everything)
    assert len(shown) == len(told.standings) if everything else len(shown) <= MOST
    written = {one.text for one in texts(chart(told, Look(everything=everything)).canvas)}
    for one in shown:
        named = {one.name, f"{one.name} space", f"{one.name}: A itself"}
        assert named & written or (one.is_reference and "inv(A).T, what people write" in written)


def diamond(canvas: Canvas) -> tuple[float, float]:
    """The middle of the one mark of four corners that stands on its tip."""
    (loop,) = (
        mark.loops[0]
        for mark in canvas.marks
        if isinstance(mark, Polygon)
        and len(mark.loops[0]) == 4
        and mark.loops[0][0][0] == mark.loops[0][2][0]
    )
    return loop[0][0], loop[1][1]


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("is_told", [True, False])
def test_what_people_write_stands_at_one_and_one(is_told: bool, size: tuple[int, int]) -> None:
    canvas = chart(summed(Study.NORMALS, is_told=is_told), Look(size)).canvas
    x, y = diamond(canvas)
    below, right = (one for one in texts(canvas) if one.text == "1×")
    assert below.box.middle[0] == pytest.approx(x)
    assert right.place[1] - 9 == pytest.approx(y)
    dashed = [one for one in canvas.marks if isinstance(one, Stroke) and one.dash == (7.0, 5.0)]
    assert {x, y} <= {value for one in dashed for point in one.points for value in point}


def test_a_decade_is_as_high_on_the_left_axis_as_on_the_right() -> None:
    canvas = chart(summed(Study.NORMALS), Look()).canvas
    at = {one.text: one.place[1] for one in texts(canvas)}
    left = at["10^{−8}"] - at["10^{−4}"]
    assert left == pytest.approx(at["10^{−4}×"] - at["1×"])
    known = summed(Study.NORMALS).reference.worst
    y = diamond(canvas)[1] + 9
    assert log10(known) == pytest.approx(-4 - 4 * (y - at["10^{−4}"]) / left)


def test_names_lie_on_no_mark() -> None:
    """The marks of a plot are as large as their roles; a name beside its own leaves it free."""
    told = summed(Study.NORMALS)
    for everything in (False, True):
        canvas = chart(told, Look(everything=everything)).canvas
        names = [one for one in texts(canvas) if one.halo is not None]
        assert len(names) == len(told.shown(everything=everything)) + 1  # and the band's
        crosses = [
            mark.points for mark in canvas.marks if isinstance(mark, Stroke) and mark.width == 5.2
        ]
        discs = [
            mark.loops[0]
            for mark in canvas.marks
            if isinstance(mark, Polygon) and len(mark.loops[0]) == 64
        ]
        assert crosses
        assert discs
        for name in names:
            for points in (*crosses, *discs):
                assert not any(name.box.holds(point) for point in points), name.text


@pytest.mark.parametrize("study", Study)
def test_the_themes_draw_the_same_marks(study: Study) -> None:
    told = summed(study)
    light, *others = (chart(told, Look(theme=theme)).canvas for theme in Theme)
    for other in others:
        for a, b in zip(light.marks, other.marks, strict=True):
            colours = {"colour", "fill", "edge", "halo", "loops", "points"} & set(vars(a))
            assert type(a) is type(b)
            assert {k: v for k, v in vars(a).items() if k not in colours} == {
                k: v for k, v in vars(b).items() if k not in colours
            }


def test_roles_differ_on_grey_paper_by_their_shape() -> None:
    told = summed(Study.NORMALS)
    canvas = chart(told, Look((800, 450), Theme.PRINT)).canvas
    assert PALETTES[Theme.PRINT].wrong == PALETTES[Theme.PRINT].right
    image = pixels(canvas).astype(int)
    assert (image.max(axis=2) == image.min(axis=2)).all(), "print is grey"
    shapes = {}
    for role in (Role.REFERENCE, Role.FRONT, Role.BEATEN, Role.WRONG):
        alone = Canvas(60, 60, PALETTES[Theme.PRINT])
        Easel(Slide(alone, ""), told, ()).mark((30, 30), role)
        shapes[role] = pixels(alone).astype(int)
    for a, b in combinations(shapes.values(), 2):
        assert (np.abs(a - b) > 128).sum() > 60


@pytest.mark.parametrize("kind", [*PixelFormat, *VectorFormat])
def test_a_chart_is_a_file_of_its_kind_and_twice_the_same(kind) -> None:
    told, look = summed(Study.NORMALS), Look((320, 180))
    found = chart_file(told, look, kind)
    if isinstance(kind, PixelFormat):
        image = Image.open(BytesIO(found))
        assert image.format.lower() == kind
        assert image.size == look.size
    else:
        assert found.startswith({VectorFormat.SVG: b"<?xml", VectorFormat.PDF: b"%PDF"}[kind])
    assert found == chart_file(told, look, kind)


def test_the_text_of_an_svg_is_text_and_tells_the_chart_to_those_who_cannot_see_it() -> None:
    told = summed(Study.NORMALS)
    found = chart_file(told, Look(), VectorFormat.SVG).decode()
    assert "what people write" in found
    assert plain(told.sentence) in found
    for one in told.shown(everything=False):
        assert f"{one.name}: {one.worst:.2g} rad" in found


def test_a_busy_machine_shows_the_spread_of_times_and_says_so() -> None:
    told = summed(Study.NORMALS, is_told=False)
    written = " ".join(one.text for one in texts(chart(told, Look()).canvas))
    assert "the machine was busy: bars are the spread of a time" in written
    assert "faster" not in written
    quiet = " ".join(one.text for one in texts(chart(summed(Study.NORMALS), Look()).canvas))
    assert "busy" not in quiet


def test_without_any_times_the_axis_is_the_counted_work() -> None:
    bare = without_times(SAVED[Study.NORMALS])
    written = [one.text for one in texts(chart(summary(Study.NORMALS, bare), Look()).canvas)]
    assert "counted work, as a multiple of inv(A).T" in written
    assert not [
        one for one in written if "busy" in one or "time" in one.split(":")[0].split(",")[0]
    ]


def made(*given: tuple[str, float, float, int]) -> Summary:
    """Sum up methods by name, error, ratio and failures, beside the reference's."""
    rows = [
        Measurement(
            name,
            "all",
            error,
            Unit.RADIANS,
            Ratio(ratio, ratio, ratio, ratio),
            10 * ratio,
            failures,
            is_reference=name == "inverse",
            more={"matrices": 3, **dict.fromkeys(WRONG, 0), "flipped": failures},
        )
        for name, error, ratio, failures in given
    ]
    return summary(Study.NORMALS, with_fronts(rows))


KNOWN = ("inverse", 1e-8, 1.0, 0)
SENTENCES = [
    ([KNOWN], "More time buys nothing. Nothing takes less time"),
    ([KNOWN, ("a", 1e-3, 2.0, 0)], "More time buys nothing. Nothing takes less time"),
    ([KNOWN, ("a", 1e-8, 1.0, 0)], "More time buys nothing. Nothing takes less time"),
    (
        [KNOWN, ("a", 1e-8, 2.0, 0), ("b", 1e-8, 0.5, 0)],
        "More time buys nothing. Half the time: as exact",
    ),
    (
        [KNOWN, ("a", 2e-16, 2.02, 0), ("b", 1e-5, 0.5, 0)],
        "Twice the time: over 10⁷× as exact. Half the time: off, but invisibly",
    ),
    (
        [KNOWN, ("a", 2e-16, 10.4, 0), ("b", 1e-9, 0.5, 7)],
        "10× the time: over 10⁷× as exact. Less time: visibly wrong",
    ),
    (
        [KNOWN, ("a", 2e-16, 1.0, 0), ("b", nan, 0.3, 0)],
        "The same time: over 10⁷× as exact. Less time: visibly wrong",
    ),
    (
        [KNOWN, ("a", 1e-9, 0.3, 0), ("b", 2e-9, 3.0, 0)],
        "0.3× the time: 10× as exact. More time buys no more",
    ),
    (
        [("inverse", pi, 1.0, 4), ("a", 1e-9, 3.0, 0), ("b", 1e-4, 0.5, 0)],
        "3× the time: off, but invisibly. Half the time: off, but invisibly",
    ),
    (
        [("inverse", pi, 1.0, 4), ("a", 1.0, 3.0, 0), ("b", nan, 0.5, 0)],
        "Every method is visibly wrong somewhere",
    ),
    ([KNOWN, ("a", 0.0, 4.0, 0)], "4× the time: not off at all. Nothing takes less time"),
    (
        [("inverse", 0.0, 1.0, 0), ("a", 0.0, 4.0, 0), ("b", 0.0, 0.5, 0)],
        "More time buys nothing. Half the time: as exact",
    ),
]


@pytest.mark.parametrize(("given", "sentence"), SENTENCES)
def test_the_sentence_is_true_of_what_was_measured(given: list, sentence: str) -> None:
    told = made(*given)
    assert plain(told.sentence) == sentence
    canvas = chart(told, Look()).canvas
    assert texts(canvas)[0].text == told.sentence
    assert texts(canvas)[0].box.right <= canvas.width - 40


@pytest.mark.parametrize("seed", range(24))
def test_no_measurement_makes_a_sentence_false_or_a_chart_crowded(seed: int) -> None:
    draw = np.random.default_rng(seed)
    names = [one.name for one in METHODS if one.name != "inverse"]
    given = [
        (
            name,
            float(10.0 ** draw.uniform(-17, 0.4)) if draw.random() < 0.9 else 0.0,
            float(2.0 ** draw.uniform(-4, 4)),
            int(draw.random() < 0.3),
        )
        for name in names[: draw.integers(1, len(names))]
    ]
    told = made(("inverse", float(10.0 ** draw.uniform(-16, 0)), 1.0, 0), *given)
    faster = [one for one in told.standings if one.price <= 0.95 and not one.is_seen]
    slower = [one for one in told.standings if one.price > 1 / 1.05 and not one.is_seen]
    if "Less time: visibly wrong" in told.sentence:
        assert not faster
    if "More time buys nothing" in told.sentence:
        least = min((one.error for one in slower), default=told.reference.error)
        assert least * 1.06 >= told.reference.error
    for one in told.front:
        cheaper = [other for other in told.standings if other.price < one.price]
        assert all(other.error > one.error or other.is_seen for other in cheaper)
    canvas = chart(told, Look(everything=seed % 2 == 0)).canvas
    written = texts(canvas)
    assert len([one for one in written if one.halo]) == 1 + len(
        told.shown(everything=seed % 2 == 0)
    )
    for a, b in combinations(written, 2):
        assert not overlap(a.box, b.box), (seed, a.text, b.text)
    assert max(one.box.right for one in written) <= canvas.width - 40


def test_a_wrong_answer_is_seen_whatever_the_error_says() -> None:
    told = made(KNOWN, ("a", 1e-12, 2.0, 1), ("b", VISIBLE / 2, 2.0, 0), ("c", 2 * VISIBLE, 2.0, 0))
    assert {name for name, role in told.roles.items() if role is Role.WRONG} == {"a", "c"}
    assert radians(0.1) == VISIBLE


def test_a_price_is_the_highest_and_an_error_the_worst_of_all_kinds() -> None:
    told = summed(Study.NORMALS)
    batches = [row for row in SAVED[Study.NORMALS] if not row.setting.startswith("one matrix")]
    for one in told.standings:
        mine = [row for row in batches if row.method == one.name]
        errors = [pi if row.failures else row.error for row in mine]
        assert one.worst == max(errors)
        assert one.easiest == min(errors)
        assert one.price == (1.0 if one.is_reference else max(row.price for row in mine))
    assert told.settings == len({row.setting for row in batches})


def test_labels_of_one_place_are_written_around_it() -> None:
    frame = Box(0, 0, 800, 600)
    labels = [
        Label((400, 300), name, 22, "#000000", Weight.BOLD, 10) for name in "abcdefghijklmnop"
    ]
    placed = Ground(frame, [Box(390, 290, 20, 20)], []).placed(labels)
    assert [one.label.text for one in placed] == [one.text for one in labels]
    for a, b in combinations(placed, 2):
        assert not overlap(a.box, b.box)


@pytest.mark.parametrize("is_told", [True, False])
@pytest.mark.parametrize("study", Study)
def test_the_everyday_answer_fits_a_terminal_and_names_each_method(
    nmatrix, study: Study, is_told: bool
) -> None:
    from nmatrix.output.text import write
    from nmatrix.output.write import Charset, OutputOptions

    rows = SAVED[study] if is_told else with_fronts(without_times(SAVED[study]))
    test = SOUND.with_rows([SAME] * 10) if is_told else BUSY
    told = summary(study, rows)
    short = write(report(study, rows, test, Target()), OutputOptions())
    lines = short.splitlines()
    assert len(lines) <= 22
    plainly = OutputOptions(charset=Charset.ASCII)
    told_plainly = write(report(study, rows, test, Target()).spelled(option_name), plainly)
    assert "\\" not in told_plainly, "it is spelled, not escaped"
    assert lines[0] == plain(told.sentence)
    for one in told.shown(everything=False):
        assert any(line.startswith(one.name) for line in lines), one.name
    full = write(report(study, rows, test, Target(), everything=True), OutputOptions())
    for one in told.standings:
        assert any(line.startswith(one.name) for line in full.splitlines()), one.name
    assert len(full.splitlines()) > len(lines)
    same = report(study, rows, test, Target(), everything=True).data
    assert same == report(study, rows, test, Target()).data


def test_a_target_names_what_meets_it_and_what_that_costs() -> None:
    rows = SAVED[Study.NORMALS]

    def verdict(target: Target) -> str:
        return report(Study.NORMALS, rows, SOUND, target).blocks[1].text

    assert verdict(Target(tolerance=1e-10)).startswith("Cheapest: certified, ")
    assert "× inv(A).T" in verdict(Target(tolerance=1e-10))
    assert "allow a larger error" in verdict(Target(tolerance=1e-30))
    poor = [row for row in rows if row.method in ("inverse", "cofactor")]
    assert (
        "wrong answers" in report(Study.NORMALS, poor, SOUND, Target(seconds=0.0405)).blocks[1].text
    )


def test_a_clock_that_cannot_tell_two_spaces_apart_is_told_and_no_absence_is() -> None:
    def claim(ratio: float, low: float, high: float) -> str:
        rows = [
            Measurement(
                name,
                "10000 vertices",
                work,
                Unit.MULTIPLICATIONS,
                timing,
                work,
                is_reference=name == "world",
            )
            for name, work, timing in (
                ("world", 47.0, SAME),
                ("static", 16.0, Ratio(1.0, ratio, low, high)),
            )
        ]
        return summary(Study.SPACES, with_fronts(rows)).sentence

    assert claim(0.3, 0.2, 1.1) == "The clock cannot tell static space from world space"
    assert claim(1.5, 1.4, 1.6) == "No space takes less time than world space"
    assert claim(0.3, 0.2, 0.4).startswith("Static space: ")


def test_what_keeps_a_budget_among_spaces_is_not_called_accurate() -> None:
    told = report(Study.SPACES, SAVED[Study.SPACES], SOUND, Target(seconds=10.0)).blocks[1].text
    assert told.startswith("Least work: static space")
