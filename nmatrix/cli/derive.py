"""`nmatrix derive`: a lesson, and the user's own matrix in it."""

from __future__ import annotations

from typing import Annotated

from typer import Argument

from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.show import show
from nmatrix.cli.sources import Sources
from nmatrix.cli.world_options import WorldOptions
from nmatrix.lessons.derive.cases import ALL, TITLES, chosen

HELP = {
    "derive": f"""nmatrix derive

nmatrix derive mirror -f latex

nmatrix derive nonuniform --scale 1 2 1 --rotate 0 0 30

The inverse-transpose rule, step by step, each step proved. Cases: {", ".join(TITLES)}, all.""",
}


def _complete_case(incomplete: str) -> list[str]:
    return [name for name in (*TITLES, ALL) if name.startswith(incomplete)]


def derive(
    *,
    world: WorldOptions,
    everywhere: Everywhere,
    case: Annotated[
        str, Argument(metavar="CASE", help="Which lesson.", autocompletion=_complete_case)
    ] = "rule",
) -> None:
    """Show a derivation."""
    chosen(case)
    own = world.build_exact(Sources(everywhere.input_layout)) if world.is_given else None
    from nmatrix.lessons.derive.lesson import derive as answer

    show(answer(case, own), everywhere)
