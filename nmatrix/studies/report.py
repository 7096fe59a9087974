"""What a study says: its rows, what is cheapest, how far the clock could be trusted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from nmatrix.report import Block, Heading, Report, Table, Value, Verdict
from nmatrix.studies.harness import Ratio, machine
from nmatrix.studies.normals import ONE
from nmatrix.studies.rows import Row, cheapest, most_accurate, overall

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
    """Return the report of a study."""
    granted = wish.answer(_candidates(study, rows))
    data: dict[str, Value] = {
        "rows": [_data(row) for row in rows],
        "cheapest": None if granted is None else _data(granted),
        "harness": {"aa_ratio": check.ratio, "aa_ci": [check.low, check.high]},
        "machine": dict(machine()),
    }
    blocks: list[Block] = [Heading(TITLES[study])]
    blocks += [_table(setting, rows) for setting in dict.fromkeys(row.setting for row in rows)]
    blocks.append(Verdict(_verdict(study, rows, wish, granted)))
    remark = (
        f"A function against itself took {check.ratio:.3f} of its own time, "
        f"between {check.low:.3f} and {check.high:.3f}."
    )
    return Report("cost", data, tuple(blocks), (remark,))


def _candidates(study: str, rows: Sequence[Row]) -> Sequence[Row]:
    """Return what may grant a wish: for normals, methods by what they do to whole batches."""
    if study != "normals":
        return rows
    return overall([row for row in rows if row.setting != ONE])


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
    }


def _table(setting: str, rows: Sequence[Row]) -> Table:
    of_setting = sorted(
        (row for row in rows if row.setting == setting), key=lambda row: row.timing.seconds
    )
    cells = tuple(
        (
            row.method,
            "none" if row.error is None else f"{row.error:.2g} {row.unit}",
            row.failures,
            f"{row.timing.ratio:.2f} ({row.timing.low:.2f} … {row.timing.high:.2f})",
            "front" if row.on_front else "",
        )
        for row in of_setting
    )
    measured = "counted" if of_setting[0].unit.startswith("multi") else "worst error"
    return Table(("method", measured, "wrong", "time ratio", ""), cells, setting)


def _verdict(study: str, rows: Sequence[Row], wish: Wish, granted: Row | None) -> str:
    if wish.tolerance is None and wish.seconds is None:
        failing = {row.method for row in rows if row.failures}
        if study != "normals":
            return "Rows marked front are beaten by no other in both error and time."
        never = [name for name in dict.fromkeys(row.method for row in rows) if name not in failing]
        return f"Never wrong in these families: {', '.join(never)}."
    if granted is None:
        return "Nothing here grants that: allow a larger error or more time."
    error = "no error" if granted.error is None else f"{granted.error:.2g} {granted.unit}"
    return f"{granted.method} ({granted.setting}): {error}, {granted.timing.seconds * 1e3:.3g} ms."
