"""The report of a study: its answer, its rows, and how far the clock could be trusted."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from math import isfinite

from nmatrix.canvas.text import plain
from nmatrix.errors import quantity
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Cells, Heading, Report, Table, Value, Verdict
from nmatrix.studies.harness import SelfTest, machine
from nmatrix.studies.measurements import Measurement, Study, Target, Unit, by_setting, overall
from nmatrix.studies.methods import METHODS
from nmatrix.studies.normals import ONE, WRONG
from nmatrix.studies.summary import Role, Standing, Summary, multiple, summary

Rows = Sequence[Measurement]

TIMES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"))
KINDS = {name: "nan" if name == "not_a_number" else name.replace("_", " ") for name in WRONG}


def report(
    study: Study, rows: Rows, test: SelfTest, target: Target, *, everything: bool = False
) -> Report:
    """Report a study: the answer first, a short table of what matters, then how far to trust it.

    With everything, all contestants and the tables of all settings are told.
    """
    wording, told = WORDINGS[study], summary(study, rows)
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
    answer = _on_target(told, target, met_by) if target != Target() else _answer(told)
    blocks: list[Block] = [
        Heading(plain(told.sentence)),
        Verdict(answer),
        wording.short_table(told, told.shown(everything=everything)),
    ]
    remarks = [_counted_on(told, wording), *_trust(study, test, everything=everything)]
    if everything:
        blocks += [wording.table(setting, found) for setting, found in by_setting(rows).items()]
        remarks.append(ON_THE_FRONT)
    else:
        remarks.append(f"{quantity('all')} adds {wording.rest}.")
    return Report("cost", data, tuple(blocks), tuple(remarks))


ON_THE_FRONT = (
    "Rows marked front have no wrong answer, and no other of their table is as good and cheaper."
)


def _counted_on(told: Summary, wording: Wording) -> str:
    """Remark on what the errors are of."""
    count = told.rows[0].more.get("matrices")
    return f"{wording.errors}{f' of {told.settings} kinds of {count} matrices' if count else ''}."


def _trust(study: Study, test: SelfTest, *, everything: bool) -> list[str]:
    """Remark on how far the clock could be trusted, and on what stands in the place of times."""
    if test.objection is not None:
        return [
            f"No time is told, the machine is too busy ({test.objection}): counted work stands in, "
            f"{WORDINGS[study].work}."
        ]
    same = test.same
    itself = f"A function against itself took {same.ratio:.3f} of its own time"
    if not everything:
        return [f"{itself}."]
    return [
        f"{itself}, between {same.low:.3f} and {same.high:.3f}. Of the {len(test.rows)} rows that "
        f"are the reference itself, {test.containing_one} have an interval that contains 1."
    ]


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


def _short_normals(told: Summary, shown: Sequence[Standing]) -> Table:
    titles = {one.name: one.title for one in METHODS}
    cells = tuple(
        (one.name, titles.get(one.name, ""), _short(one.easiest), _worst(one), _multiple(one))
        for one in shown
    )
    return Table(("method", "what it is", "easiest", "worst", f"{told.measure.noun} ×"), cells)


def _short_shading(told: Summary, shown: Sequence[Standing]) -> Table:
    cells = tuple(
        (
            one.name,
            _short(one.worst),
            _multiple(one),
            "front" if told.roles[one.name] is Role.FRONT else "",
        )
        for one in shown
    )
    return Table(("setting", "rms levels", f"{told.measure.noun} ×", ""), cells)


def _short_spaces(told: Summary, shown: Sequence[Standing]) -> Table:
    """Build the table of spaces, with a column of times for each number of vertices."""
    settings = {} if told.rows[0].timing is None else by_setting(told.rows)
    cells: list[Cells] = []
    for one in shown:
        mine = (row for found in settings.values() for row in found if row.method == one.name)
        cells.append((one.name, one.worst, *(_three_digits(row.price) for row in mine)))
    columns = (f"× {int(name.partition(' ')[0]):,}" for name in settings)
    title = "Times are multiples of world space's, for so many vertices." if settings else ""
    return Table(("space", Unit.MULTIPLICATIONS.value, *columns), tuple(cells), title)


def _worst(one: Standing) -> str:
    """Write the largest error, or the commonest of the wrong answers."""
    counts = {name: sum(int(row.more.get(name) or 0) for row in one.rows) for name in KINDS}
    commonest = max(counts, key=lambda name: counts[name])
    return KINDS[commonest] if counts[commonest] else _short(one.worst)


def _multiple(one: Standing) -> str:
    low, high = (multiple(price).removesuffix("×") for price in one.prices)
    return low if low == high else f"{low}–{high}"


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
    """The words of one study: what is timed, counted and compared, and its tables."""

    time_is_for: str
    work: str
    errors: str
    rest: str
    short_table: Callable[[Summary, Sequence[Standing]], Table]
    table: Callable[[str, Rows], Table]


WORDINGS = {
    Study.NORMALS: Wording(
        "for 10⁵ normals",
        "multiplications and calls of functions, a normal",
        "Errors: radians, for the easiest and hardest",
        "every method on every kind of matrix",
        _short_normals,
        _normals_table,
    ),
    Study.SHADING: Wording(
        "a frame",
        "multiplications and texels",
        "Errors: levels of 255, against 64 samples and everything on",
        "every setting of every dial",
        _short_shading,
        _shading_table,
    ),
    Study.SPACES: Wording(
        "for all vertices",
        "multiplications a vertex",
        "Multiplications are counted, not measured",
        "the intervals",
        _short_spaces,
        _spaces_table,
    ),
}


def _short(value: float | None) -> str:
    if value is None or not isfinite(value):
        return "" if value is None else str(value)
    return short_text(Fraction(value), 2 if value < 10 else 3)


def _wrong(row: Measurement) -> str:
    """Count the wrong answers of a row in words."""
    return ", ".join(f"{row.more[name]} {word}" for name, word in KINDS.items() if row.more[name])


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


def _on_target(told: Summary, target: Target, met_by: Measurement | None) -> str:
    """Name what meets the target: what it is worth, and what it costs."""
    if target.seconds is not None and told.rows[0].timing is None:
        return "No time is told, so nothing is known to keep that budget."
    if met_by is None:
        return "Nothing here grants that: allow a larger error or more time."
    best = "Cheapest" if target.tolerance is not None else "Most accurate"
    if told.study is Study.SPACES:  # they give one picture
        best = "Least work"
    name = {
        Study.NORMALS: met_by.method,
        Study.SHADING: f"{met_by.setting} {met_by.method}",
        Study.SPACES: f"{met_by.method} space for {met_by.setting}",
    }[told.study]
    worth = f"{met_by.error:.2g} {met_by.unit}"
    if met_by.failures:
        worth = f"with {met_by.failures} wrong answers"
    price = f"work {met_by.work:.0f}, counted"
    if met_by.timing is not None:
        most = "at most " if told.study is Study.NORMALS else ""
        seconds = f"{in_time(met_by.timing.seconds)} {WORDINGS[told.study].time_is_for}"
        price = f"{most}{seconds}, {multiple(met_by.timing.ratio)} {told.reference.spoken}"
    return f"{best}: {name}, {worth}, {price}."


def _answer(told: Summary) -> str:
    """Name what is worth its price, where no tolerance and no budget was given."""
    if told.study is Study.SPACES:
        return _cheapest_space(told)
    known = told.reference
    bought = [
        f"{_price_of(told, one)} buys {one.name}, off by {_short(one.worst)} {one.unit}; "
        for one in (told.more, told.less)
        if one is not None
    ]
    answer = "".join(bought) or "No other here is right and better; "
    answer += f"{known.spoken} is off by {_short(known.worst)} {known.unit}"
    alone = [row for row in told.rows if row.setting.startswith(ONE)]
    if not alone or told.study is not Study.NORMALS:
        return f"{answer}."
    best = summary(told.study, alone)
    one = best.more or best.reference
    return (
        f"{answer}. One matrix alone: {one.name}, {multiple(one.price)} "
        f"{known.spoken}, {_short(one.worst)} {one.unit}."
    )


def _price_of(told: Summary, one: Standing) -> str:
    """Write what a contestant costs, as a multiple and in all."""
    price = f"{multiple(one.price)} the {told.measure.noun}"
    times = [row.timing.seconds for row in one.rows if row.timing is not None]
    if not times:
        return price
    most = "at most " if len(times) > 1 else ""
    return f"{price} ({most}{in_time(max(times))} {WORDINGS[told.study].time_is_for})"


def _cheapest_space(told: Summary) -> str:
    """Name the spaces of the least price, and what they have to multiply."""
    known, least = told.reference, told.cheapest
    names = " or ".join(one.spoken for one in least)
    counts = " or ".join(f"{one.worst:.0f}" for one in least)
    count, _, noun = told.rows[-1].setting.partition(" ")
    return (
        f"{names.capitalize()} is the cheapest at {int(count):,} {noun}: {counts} multiplications "
        f"a vertex, world space {known.worst:.0f}."
    )
