"""`nmatrix cost`: accuracy against time, measured on this machine."""

from __future__ import annotations

import re
import time
from enum import StrEnum
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.show import progress, show
from nmatrix.errors import IllegalValueError
from nmatrix.output.files import refuse_existing, write_file
from nmatrix.reading.numbers import number

if TYPE_CHECKING:
    from nmatrix.studies.harness import Harness
    from nmatrix.studies.report import Wish
    from nmatrix.studies.rows import Row, Task

HELP = {
    "cost": """nmatrix cost normals --quick

nmatrix cost shading --tolerance 2levels

nmatrix cost normals --budget 5ms --chart normals.svg

What accuracy costs in time: errors against the exact answer, wrong answers, ratios of time.""",
}

QUICK_SECONDS = 4.5  # after which each row takes the fewest rounds
CHARTS = (".svg", ".png")
WISH = re.compile(r"(.+?)\s*(deg|rad|levels|ns|us|ms|s)?")
SCALES = {
    "rad": 1.0,
    "levels": 1.0,
    "deg": radians(1.0),
    "ns": 1e-9,
    "us": 1e-6,
    "ms": 1e-3,
    "s": 1.0,
}


class Study(StrEnum):
    """What can be studied."""

    NORMALS = "normals"
    SHADING = "shading"
    SPACES = "spaces"


UNITS = {Study.NORMALS: ("deg", "rad"), Study.SHADING: ("levels",), Study.SPACES: ()}


def cost(
    *,
    everywhere: Everywhere,
    study: Annotated[Study, Argument(help="normals, shading or spaces.")] = Study.NORMALS,
    tolerance: Annotated[
        str | None,
        Option(metavar="ERROR", help="The cheapest that is as good: 1e-3deg, 1e-6rad, 2levels."),
    ] = None,
    budget: Annotated[
        str | None, Option(metavar="TIME", help="The best that is as fast: 5ms, 200us.")
    ] = None,
    quick: Annotated[bool, Option("--quick", help="Fewer cases, within ten seconds.")] = False,
    chart: Annotated[
        str | None, Option(metavar="FILE", help="Draw it: FILE.svg or FILE.png.")
    ] = None,
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """Measure what accuracy costs."""
    wish = _wish(study, tolerance, budget)
    target = None if chart is None else _chart_file(chart, force=force)
    from nmatrix.studies.harness import Harness
    from nmatrix.studies.report import TITLES, report

    trial = Harness(time.perf_counter, 0.002)
    check = trial.self_check(_work)
    trial.double_check(_work)
    rows = _rows(_tasks(study, _harness(quick=quick), quick=quick), study)
    if target is not None:
        from nmatrix.studies.chart import chart as drawn

        kind = target.suffix.lower().removeprefix(".")
        write_file(target, drawn(rows, TITLES[study], kind), force=force)
    show(report(study, rows, check, wish), everywhere)


def _harness(*, quick: bool) -> Harness:
    from nmatrix.studies.harness import Harness

    if not quick:
        return Harness(time.perf_counter)
    return Harness(
        time.perf_counter, 0.0005, rounds=7, fewest=3, late=time.perf_counter() + QUICK_SECONDS
    )


def _work() -> int:
    return sum(range(2000))


def _rows(tasks: list[Task], study: Study) -> tuple[Row, ...]:
    from nmatrix.studies.rows import with_fronts

    done = (task() for task in tasks)
    return with_fronts(list(progress(done, len(tasks), f"measuring {study}")))


def _tasks(study: Study, harness: Harness, *, quick: bool) -> list[Task]:
    if study is Study.NORMALS:
        from nmatrix.studies import normals

        return normals.tasks(harness, normals.QUICK if quick else normals.Extent())
    if study is Study.SHADING:
        from nmatrix.studies import shading

        return shading.tasks(harness, shading.QUICK if quick else shading.FULL)
    from nmatrix.studies import spaces

    return spaces.tasks(harness, spaces.QUICK if quick else spaces.VERTICES)


def _wish(study: Study, tolerance: str | None, budget: str | None) -> Wish:
    from nmatrix.studies.report import Wish

    if tolerance is not None and budget is not None:
        raise IllegalValueError(
            "--tolerance with --budget", "each asks for the best of the other", "keep one of them"
        )
    if tolerance is not None:
        return Wish(tolerance=_quantity(tolerance, "--tolerance", UNITS[study], "1e-3deg"))
    if budget is not None:
        return Wish(seconds=_quantity(budget, "--budget", ("ns", "us", "ms", "s"), "5ms"))
    return Wish()


def _quantity(text: str, option: str, units: tuple[str, ...], example: str) -> float:
    """Return a number with its unit, in radians, levels or seconds."""
    found = WISH.fullmatch(text.strip())
    unit = found[2] if found else None
    if found is None or unit not in units:
        known = ", ".join(units) or "none here"
        raise IllegalValueError(
            f"{option} ({text[:20]})", f"it is a number with a unit: {known}", f"try {example}"
        )
    value = number(found[1], option)
    if value <= 0:
        raise IllegalValueError(f"{option} ({text[:20]})", "it is positive", f"try {example}")
    return value * SCALES[unit]


def _chart_file(name: str, *, force: bool) -> Path:
    path = Path(name)
    if path.suffix.lower() not in CHARTS:
        raise IllegalValueError(
            f"--chart ({name[:60]})", f"charts end in {' or '.join(CHARTS)}", "try chart.svg"
        )
    refuse_existing([path], force=force)
    return path
