"""What a study says: its rows, what is cheapest, how far the clock could be trusted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Report, Table, Value, Verdict
from nmatrix.studies.harness import Ratio, machine
from nmatrix.studies.normals import ONE
from nmatrix.studies.rows import Row, cheapest, most_accurate, overall
from nmatrix.studies.spaces import MULTIPLICATIONS

TITLES = {
    "normals": "What the accuracy of normals costs",
    "shading": "What the accuracy of a picture costs",
    "spaces": "What a shading space costs",
}


@dataclass(frozen=True)
class Wish:
    """What was asked of the study: an error that is good enough, or a time that must do.

    `tolerance` is in the study's own unit; `seconds` are for one call of what was timed.
    """

    tolerance: float | None = None
    seconds: float | None = None

    def answer(self, rows: Sequence[Row]) -> Row | None:
        """Return the row that grants it."""
        if self.tolerance is not None:
            return cheapest(rows, self.tolerance)
        return None if self.seconds is None else most_accurate(rows, self.seconds)


def report(study: str, rows: Sequence[Row], check: Ratio, wish: Wish) -> Report:
    """Return the report of a study: the answer first, then what it rests on."""
    granted = wish.answer(_candidates(study, rows))
    data: dict[str, Value] = {
        "rows": [_data(row) for row in rows],
        "cheapest": None if granted is None else _data(granted),
        "harness": {"aa_ratio": check.ratio, "aa_ci": [check.low, check.high]},
        "machine": dict(machine()),
    }
    tables = [TABLES[study](setting, _of(setting, rows)) for setting in _settings(rows)]
    blocks: list[Block] = [Heading(TITLES[study]), Verdict(_verdict(study, rows, wish, granted))]
    remark = (
        f"A function against itself took {check.ratio:.3f} of its own time, "
        f"between {check.low:.3f} and {check.high:.3f}."
    )
    return Report("cost", data, (*blocks, *tables), (*_checked(rows), READING[study], remark))


def _checked(rows: Sequence[Row]) -> list[str]:
    """Return how many answers the errors are the worst of."""
    count = rows[0].more.get("matrices")
    return [f"Errors are the worst of {count} matrices a family."] if count else []


def _settings(rows: Sequence[Row]) -> list[str]:
    return list(dict.fromkeys(row.setting for row in rows))


def _of(setting: str, rows: Sequence[Row]) -> list[Row]:
    """Return the rows of a setting, the fastest first."""
    found = [row for row in rows if row.setting == setting]
    return sorted(found, key=lambda row: row.timing.ratio)


def _candidates(study: str, rows: Sequence[Row]) -> Sequence[Row]:
    """Return what may grant a wish: for normals, methods by what they do to whole batches."""
    if study != "normals":
        return rows
    return overall([row for row in rows if not row.setting.startswith(ONE)])


def _data(row: Row) -> dict[str, Value]:
    return {
        "method": row.method,
        "setting": row.setting,
        "error": row.error,
        "unit": row.unit,
        "time_ns": row.timing.seconds * 1e9,
        "ratio": row.timing.ratio,
        "ratio_ci": [row.timing.low, row.timing.high],
        "failures": row.failures,
        "on_front": row.on_front,
        **row.more,
    }


def _normals_table(setting: str, rows: Sequence[Row]) -> Table:
    cells = tuple(
        (row.method, _short(row.error), _short(row.more["median_error"]), _wrong(row), *_time(row))
        for row in rows
    )
    return Table(("method", "worst", "median", "wrong", "time ratio", ""), cells, setting)


def _shading_table(setting: str, rows: Sequence[Row]) -> Table:
    figures = ("max_levels", "mean_normal_deg")
    cells = tuple(
        (row.method, _short(row.error), *(_short(row.more[name]) for name in figures), *_time(row))
        for row in rows
    )
    columns = (setting, "rms levels", "largest", "normal °", "time ratio", "")
    return Table(columns, cells)


def _spaces_table(setting: str, rows: Sequence[Row]) -> Table:
    cells = tuple((row.method, row.error, *_time(row)) for row in rows)
    return Table(("space", MULTIPLICATIONS, "time ratio", ""), cells, setting)


TABLES = {"normals": _normals_table, "shading": _shading_table, "spaces": _spaces_table}
WRONG = {
    "not_a_number": "nan",
    "zero": "zero",
    "flipped": "flipped",
    "not_reported": "not reported",
}


def _short(value: float | None) -> str:
    return "" if value is None else short_text(Fraction(value), 2 if value < 10 else 3)


def _wrong(row: Row) -> str:
    """Return the wrong answers in words."""
    return ", ".join(f"{row.more[kind]} {word}" for kind, word in WRONG.items() if row.more[kind])


def _time(row: Row) -> tuple[str, str]:
    found = row.timing
    ratio, low, high = map(_three_digits, (found.ratio, found.low, found.high))
    return f"{ratio} ({low}–{high})", "front" if row.on_front else ""


def _three_digits(ratio: float) -> str:
    return f"{ratio:.2f}" if ratio < 9.995 else f"{ratio:.1f}"


def _verdict(study: str, rows: Sequence[Row], wish: Wish, granted: Row | None) -> str:
    if wish.tolerance is None and wish.seconds is None:
        return _unasked(study, rows)
    if granted is None:
        return "Nothing here grants that: allow a larger error or more time."
    error = "no error" if granted.error is None else f"{granted.error:.2g} {granted.unit}"
    asked = "Cheapest" if wish.tolerance is not None else "Most accurate"
    where = granted.setting if study == "normals" else f"dial: {granted.setting}"
    time = f"{in_time(granted.timing.seconds)} {PER[study]}"
    return f"{asked}: {granted.method} ({where}), {error}, {time}."


def in_time(seconds: float) -> str:
    """Return a time as people say it.

    Examples
    --------
    >>> in_time(2.42), in_time(0.0314), in_time(5e-5)
    ('2.4 s', '31 ms', '50 µs')
    """
    scale, unit = next((one for one in TIMES if seconds >= one[0]), TIMES[-1])
    value = seconds / scale
    return f"{value:.0f} {unit}" if value >= 10 else f"{value:.1f} {unit}"


TIMES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))
SOUND = 1e-10  # radians that no picture and no other program would miss
PER = {"normals": "for 10⁵ normals", "shading": "a frame", "spaces": "for all vertices"}


def _unasked(study: str, rows: Sequence[Row]) -> str:
    """Return the answer for somebody who has not asked for a number."""
    if study == "normals":
        sound = [
            row
            for row in _candidates(study, rows)
            if not row.failures and row.error is not None and row.error <= SOUND
        ]
        names = ", ".join(row.method for row in sound)
        return f"Right to {SOUND:g} rad in every family, and never without an answer: {names}."
    if study == "shading":
        worst = max(rows, key=lambda row: row.error or 0.0)
        return (
            f"What costs the picture most is {worst.setting} {worst.method}: "
            f"{worst.error:.2g} levels (root of the mean square)."
        )
    most = _of(_settings(rows)[-1], rows)
    return f"{most[0].method} space is the cheapest at {most[0].setting}."


READING = {
    "normals": "Errors are in radians, ratios are times over np.linalg.inv(A).T's; rows marked "
    "front are beaten by no other in both error and time.",
    "shading": "Ratios are frames over the usual frame's (4 samples, phong, shadow map of 512); "
    "errors are against 64 samples and everything on, and 4 samples alone make a part of each.",
    "spaces": "Ratios are times over world space's; multiplications are counted, not measured.",
}
