"""`nmatrix stress`: the hard cases, and who survives them."""

from __future__ import annotations

from typing import Annotated

from typer import Option

from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.show import show
from nmatrix.errors import IllegalValueError

HELP = {
    "stress": """nmatrix stress

nmatrix stress --case N9

nmatrix stress --random 400 --seed 7 --case S17

Every hard case against every method, naive ones included; exit 1 if nmatrix itself fails one.""",
}

MOST_RANDOM = 100_000


def stress(
    *,
    everywhere: Everywhere,
    case: Annotated[
        str | None, Option(metavar="ID", help="Explain one case: N9, or S3 of random ones.")
    ] = None,
    random: Annotated[
        str | None, Option(metavar="N", help="So many directed random cases instead.")
    ] = None,
    seed: Annotated[str, Option(metavar="S", help="Of the random cases.")] = "1",
) -> None:
    """Run the hard cases."""
    from nmatrix.studies.stress import CATALOGUE, case_named
    from nmatrix.studies.stress import stress as answer

    cases = CATALOGUE
    if random is not None:
        from nmatrix.studies.hardcases.families import random_cases

        cases = random_cases(_whole(random, "--random", 1), _whole(seed, "--seed", 0))
    show(answer(cases if case is None else (case_named(case, cases),)), everywhere)


def _whole(text: str, option: str, least: int) -> int:
    if not (text.isascii() and text.isdigit() and least <= int(text[:9]) <= MOST_RANDOM):
        raise IllegalValueError(
            f"{option} ({text[:20]})",
            f"it is a whole number from {least} to {MOST_RANDOM}",
            f"try {option} 7",
        )
    return int(text)
