"""The report of a study: its answer, its rows, and how far the clock could be trusted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Report, Table, Value, Verdict
from nmatrix.studies.harness import SelfTest, machine
from nmatrix.studies.measurements import Measurement, Study, Target, Unit, by_setting, overall
from nmatrix.studies.normals import ONE, WRONG

Rows = Sequence[Measurement]

SOUND = 1e-10  # radians that no picture and no other program would miss
TIMES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))


def report(study: Study, rows: Rows, test: SelfTest, target: Target) -> Report:
    """Report a study: the answer first, then the tables, then how to read and trust them."""
    wording = WORDINGS[study]
    met_by = target.met_by(_candidates(study, rows))
    same = test.same
    data: dict[str, Value] = {
        "rows": [_data(row) for row in rows],
        "cheapest": None if met_by is None else _data(met_by),
        "harness": {
            "aa_ratio": same.ratio,
            "aa_ci": [same.low, same.high],
            "aa_rows": len(test.rows),
            "aa_rows_with_one": test.containing_one,
            "untimed_because": test.objection,
        },
        "machine": dict(machine()),
    }
    tables = [wording.table(setting, found) for setting, found in by_setting(rows).items()]
    blocks: list[Block] = [
        Heading(wording.title),
        Verdict(_verdict(study, rows, target, met_by)),
        *tables,
    ]
    remarks = (*_checked(rows), wording.reading, _trust(study, test))
    return Report("cost", data, tuple(blocks), remarks)


def _trust(study: Study, test: SelfTest) -> str:
    """Remark on how far the clock could be trusted, and on what stands in the place of times."""
    if test.objection is not None:
        return (
            f"No time is told: the machine is too busy ({test.objection}). The cheapest and the "
            f"front are those of the counted work: {WORDINGS[study].work}."
        )
    same = test.same
    return (
        f"A function against itself took {same.ratio:.3f} of its own time, between {same.low:.3f} "
        f"and {same.high:.3f}. Of the {len(test.rows)} rows that are the reference itself, "
        f"{test.containing_one} have an interval that contains 1."
    )


def _checked(rows: Rows) -> list[str]:
    """Remark on the number of matrices behind each worst error."""
    count = rows[0].more.get("matrices")
    return [f"Errors are the worst of {count} matrices a family."] if count else []


def _candidates(study: Study, rows: Rows) -> Rows:
    """Return the rows that may meet a target: for normals, methods over all batches."""
    if study is not Study.NORMALS:
        return rows
    return overall([row for row in rows if not row.setting.startswith(ONE)])


def _data(row: Measurement) -> dict[str, Value]:
    timing = row.timing
    return {
        "method": row.method,
        "setting": row.setting,
        "error": row.error,
        "unit": row.unit.value,
        "time_ns": None if timing is None else timing.seconds * 1e9,
        "ratio": None if timing is None else timing.ratio,
        "ratio_ci": None if timing is None else [timing.low, timing.high],
        "failures": row.failures,
        "on_front": row.on_front,
        "work": row.work,
        **row.more,
    }


def _normals_table(setting: str, rows: Rows) -> Table:
    cells = tuple(
        (row.method, _short(row.error), _short(row.more["median_error"]), _wrong(row), *_price(row))
        for row in rows
    )
    return Table(("method", "worst", "median", "wrong", *_prices(rows)), cells, setting)


def _shading_table(setting: str, rows: Rows) -> Table:
    figures = ("max_levels", "mean_normal_deg")
    cells = tuple(
        (row.method, _short(row.error), *(_short(row.more[name]) for name in figures), *_price(row))
        for row in rows
    )
    return Table((setting, "rms levels", "largest", "normal °", *_prices(rows)), cells)


def _spaces_table(setting: str, rows: Rows) -> Table:
    cells = tuple((row.method, row.error, *_price(row)) for row in rows)
    return Table(("space", Unit.MULTIPLICATIONS.value, *_prices(rows)), cells, setting)


@dataclass(frozen=True)
class Wording:
    """The words of one study: its title, what a time is for, what its work is, how to read it."""

    title: str
    time_is_for: str
    work: str
    reading: str
    table: Callable[[str, Rows], Table]


WORDINGS = {
    Study.NORMALS: Wording(
        "What the accuracy of normals costs",
        "for 10⁵ normals",
        "multiplications of the formula and calls of functions, for one normal",
        "Errors are in radians, ratios are times over np.linalg.inv(A).T's; rows marked front have "
        "no wrong answer, and no other is as good and cheaper.",
        _normals_table,
    ),
    Study.SHADING: Wording(
        "What the accuracy of a picture costs",
        "a frame",
        "multiplications at vertices and samples, and texels of shadow maps",
        "Ratios are frames over the usual frame's (4 samples, phong, shadow map of 512); errors "
        "are against 64 samples and everything on, and 4 samples alone make a part of each.",
        _shading_table,
    ),
    Study.SPACES: Wording(
        "What a shading space costs",
        "for all vertices",
        "multiplications a vertex",
        "Ratios are times over world space's; multiplications are counted, not measured.",
        _spaces_table,
    ),
}


def _short(value: float | None) -> str:
    return "" if value is None else short_text(Fraction(value), 2 if value < 10 else 3)


def _wrong(row: Measurement) -> str:
    """Count the wrong answers of a row in words."""
    words = {name: "nan" if name == "not_a_number" else name.replace("_", " ") for name in WRONG}
    return ", ".join(f"{row.more[name]} {word}" for name, word in words.items() if row.more[name])


def _prices(rows: Rows) -> tuple[str, str]:
    """Head the columns of what rows cost."""
    return "work" if rows[0].timing is None else "time ratio", ""


def _price(row: Measurement) -> tuple[str, str]:
    timing, front = row.timing, "front" if row.on_front else ""
    if timing is None:
        return f"{row.work:.0f}", front
    ratio, low, high = map(_three_digits, (timing.ratio, timing.low, timing.high))
    return f"{ratio} ({low}–{high})", front


def _three_digits(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 9.995 else f"{ratio:.1f}"


def _verdict(study: Study, rows: Rows, target: Target, met_by: Measurement | None) -> str:
    if target == Target():
        return _without_target(study, rows)
    if target.seconds is not None and rows[0].timing is None:
        return "No time is told, so nothing is known to keep that budget."
    if met_by is None:
        return "Nothing here grants that: allow a larger error or more time."
    best = "Cheapest" if target.tolerance is not None else "Most accurate"
    where = met_by.setting if study is Study.NORMALS else f"dial: {met_by.setting}"
    price = f"work {met_by.work:.0f}, counted"
    if met_by.timing is not None:
        price = f"{in_time(met_by.timing.seconds)} {WORDINGS[study].time_is_for}"
    return f"{best}: {met_by.method} ({where}), {met_by.error:.2g} {met_by.unit}, {price}."


def in_time(seconds: float) -> str:
    """Write a time with the unit that people would use.

    Examples
    --------
    >>> in_time(2.42), in_time(0.0314), in_time(5e-5)
    ('2.4 s', '31 ms', '50 µs')
    """
    scale, unit = next((one for one in TIMES if seconds >= one[0]), TIMES[-1])
    value = seconds / scale
    return f"{value:.0f} {unit}" if value >= 10 else f"{value:.1f} {unit}"


def _without_target(study: Study, rows: Rows) -> str:
    """Sum a study up where no tolerance and no budget was given."""
    if study is Study.NORMALS:
        sound = [row for row in _candidates(study, rows) if not row.failures and row.error <= SOUND]
        names = ", ".join(row.method for row in sound)
        return f"Right to {SOUND:g} rad in every family, and never without an answer: {names}."
    if study is Study.SHADING:
        worst = max(rows, key=lambda row: row.error)
        return (
            f"What costs the picture most is {worst.setting} {worst.method}: "
            f"{worst.error:.2g} levels (root of the mean square)."
        )
    setting, last = list(by_setting(rows).items())[-1]
    return f"{last[0].method} space is the cheapest at {setting}."
