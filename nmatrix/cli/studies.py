"""The panel Studies: what accuracy costs in time, and the hard cases."""

from __future__ import annotations

import re
import time
from collections.abc import Iterable, Mapping
from importlib import import_module
from itertools import chain
from math import radians
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.environment import usual
from nmatrix.cli.shared_options import CommonOptions, among, whole_number
from nmatrix.cli.show import progress, show
from nmatrix.enums import Theme
from nmatrix.errors import IllegalValueError
from nmatrix.output.files import CHARTS, kind_of, refuse_existing, write_file
from nmatrix.reading.numbers import number, numbers
from nmatrix.studies.measurements import Study

if TYPE_CHECKING:
    from nmatrix.enums import PixelFormat, VectorFormat
    from nmatrix.studies.hardcases.case import Case
    from nmatrix.studies.harness import Harness, Timed
    from nmatrix.studies.measurements import Target, Task

HELP = {
    "cost": """nmatrix cost normals --quick

nmatrix cost shading --quick --tolerance 2levels

nmatrix cost normals --quick --budget 5ms --chart normals.svg

Errors against the exact answer, wrong answers, ratios of time.""",
    "stress": """nmatrix stress

nmatrix stress --case N9

nmatrix stress --random 400 --seed 7 --case S17

Exit 1 if nmatrix itself fails one.""",
}

MOST_RANDOM = 100_000
QUICK = (0.0005, 0.04)  # seconds of a turn and of a ratio
ERRORS = {
    Study.NORMALS: {"deg": radians(1.0), "rad": 1.0},
    Study.SHADING: {"levels": 1.0},
    Study.SPACES: {},
}
TIMES = {"ns": 1e-9, "us": 1e-6, "ms": 1e-3, "s": 1.0}
EXAMPLES = {"deg": "1e-3deg", "levels": "2levels", "ns": "5ms"}  # by the first unit
QUANTITY = re.compile(rf"(.+?)\s*({'|'.join(chain(*ERRORS.values(), TIMES))}|)")


def cost(
    *,
    common: CommonOptions,
    study: Annotated[
        Study, Argument(metavar="STUDY", help="normals, shading or spaces.")
    ] = Study.NORMALS,
    tolerance: Annotated[
        str | None,
        Option(metavar="ERROR", help="The cheapest that is as good: 1e-3deg, 1e-6rad, 2levels."),
    ] = None,
    budget: Annotated[
        str | None, Option(metavar="TIME", help="The best that is as fast: 5ms, 200us.")
    ] = None,
    quick: Annotated[bool, Option("--quick", help="Fewer cases, within ten seconds.")] = False,
    everything: Annotated[
        bool, Option("--all", help="Every method and setting, not the few that matter.")
    ] = False,
    chart: Annotated[
        str | None,
        Option(metavar="FILE", help="Draw it: FILE.svg, .pdf, .png, .gif, .webp or .jpg."),
    ] = None,
    size: Annotated[
        str | None, Option(metavar="W H", help="Pixels of the chart (default: 1600 900).")
    ] = None,
    theme: Annotated[Theme | None, Option(help="Colours of the chart (default: light).")] = None,
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """Measure what accuracy costs."""
    target = _target(study, tolerance, budget)
    if chart is None and (given := size or theme):
        option = "--size" if size else "--theme"
        raise IllegalValueError(f"{option} ({given[:20]})", "it is of a chart", "add --chart FILE")
    drawing = None if chart is None else _chart_file(Path(chart), force=force)
    pixels = _pixels(size or "1600 900")
    from nmatrix.studies.harness import Harness, untimed
    from nmatrix.studies.measurements import with_fronts, without_times
    from nmatrix.studies.report import report

    test = Harness(time.perf_counter, 0.002).self_test(_work)
    is_timed = drawing is not None or test.objection is None  # a chart shows how they spread
    timed = _harness(quick=quick).ratio if is_timed else untimed
    tasks = _tasks(study, timed, quick=quick)
    done = (task() for task in tasks)
    measured = list(progress(done, len(tasks), f"measuring {study}"))
    test = test.with_rows([row.timing for row in measured if row.is_reference and row.timing])
    rows = with_fronts(without_times(measured) if test.objection else measured)
    if drawing is not None:
        from nmatrix.studies.chart import Look, chart_file
        from nmatrix.studies.summary import summary

        path, kind = drawing
        colours = theme or usual("NMATRIX_THEME", Theme) or Theme.LIGHT
        look = Look(pixels, colours, everything=everything)
        write_file(path, chart_file(summary(study, rows, measured), look, kind), force=force)
    show(report(study, rows, test, target, everything=everything), common)


def _harness(*, quick: bool) -> Harness:
    from nmatrix.studies.harness import Harness

    return Harness(time.perf_counter, *QUICK) if quick else Harness(time.perf_counter)


def _work() -> int:
    return sum(range(2000))


def _tasks(study: Study, timed: Timed, *, quick: bool) -> list[Task]:
    module = import_module(f"nmatrix.studies.{study}")
    found: list[Task] = module.tasks(timed, module.QUICK if quick else module.FULL)
    return found


def _target(study: Study, tolerance: str | None, budget: str | None) -> Target:
    from nmatrix.studies.measurements import Target

    if tolerance is not None and budget is not None:
        raise IllegalValueError(
            "--tolerance with --budget", "each asks for the best of the other", "keep one of them"
        )
    if tolerance is not None:
        if not ERRORS[study]:
            raise IllegalValueError(
                f"--tolerance with {study}", "all spaces give one picture", "try --budget 5ms"
            )
        return Target(tolerance=_quantity(tolerance, "--tolerance", ERRORS[study]))
    if budget is not None:
        return Target(seconds=_quantity(budget, "--budget", TIMES))
    return Target()


def _quantity(text: str, option: str, units: Mapping[str, float]) -> float:
    """Read a number with its unit, in radians, levels or seconds."""
    found = QUANTITY.fullmatch(text.strip())
    unit, example = found[2] if found else "", EXAMPLES[next(iter(units))]
    if found is None or unit not in units:
        known = ", ".join(units)
        raise IllegalValueError(
            f"{option} ({text[:20]})", f"it is a number with a unit: {known}", f"try {example}"
        )
    value = number(found[1], option)
    if value <= 0:
        raise IllegalValueError(f"{option} ({text[:20]})", "it is positive", f"try {example}")
    return value * units[unit]


def _chart_file(path: Path, *, force: bool) -> tuple[Path, PixelFormat | VectorFormat]:
    """Choose what the chart's file is, before the study runs."""
    kind = kind_of(path, CHARTS, "chart")
    refuse_existing([path], force=force)
    return path, kind


def _pixels(size: str) -> tuple[int, int]:
    """Read the size of a picture."""
    from nmatrix.scene.scene import Settings

    return Settings(size=numbers(size, 2, "--size"), samples=1).size  # type: ignore[arg-type]  # it reads them


def _cases() -> list[str]:
    from nmatrix.studies.stress import CATALOGUE

    return [one.id for one in CATALOGUE]


def stress(
    *,
    common: CommonOptions,
    case: Annotated[
        str | None,
        Option(
            metavar="ID",
            help="Explain one case: N9, or S3 of random ones.",
            autocompletion=among(_cases),
        ),
    ] = None,
    random: Annotated[
        str | None, Option(metavar="N", help="So many directed random cases instead.")
    ] = None,
    seed: Annotated[str, Option(metavar="S", help="Of the random cases.")] = "1",
) -> None:
    """Run the hard cases."""
    from nmatrix.studies.stress import CATALOGUE, case_named
    from nmatrix.studies.stress import stress as answer

    cases: Iterable[Case] = CATALOGUE
    ids = [one.id for one in CATALOGUE]
    if random is not None:
        from nmatrix.studies.hardcases.families import random_cases, random_ids

        count = whole_number(random, "--random", range(1, MOST_RANDOM + 1), 7)
        cases = random_cases(count, whole_number(seed, "--seed", range(MOST_RANDOM + 1), 7))
        ids = random_ids(count)
    if case is not None:
        cases, ids = (case_named(case, cases, ids),), [case]
    show(answer(progress(cases, len(ids), "judging cases")), common)
