"""`nmatrix calc`: an expression over the scene's matrices and those that --let names."""

from __future__ import annotations

from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.command import EXPRESSION
from nmatrix.cli.scene_options import OptionGroups, SceneOptions
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.cli.world_options import WorldOptions
from nmatrix.errors import IllegalValueError

HELP = {
    "calc": r"""nmatrix calc "inverse_transpose(linear(M))" --scale 1 2 1

nmatrix calc "P @ V @ M @ point(\[1, 1, 1])" --steps

nmatrix calc "det(A) * inverse(A)" --let "A=2 1; 1 1"

Over M, V, P, literals and --let names.""",
}


def calc(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    scene: SceneOptions,
    common: CommonOptions,
    expression: Annotated[str, Argument(metavar=EXPRESSION, help="What to compute.")],
    let: Annotated[
        list[str] | None,
        Option("--let", metavar="NAME=MATRIX", help="Name a matrix; repeat for more."),
    ] = None,
    steps: Annotated[bool, Option("--steps", help="Show every operation.")] = False,
    float64: Annotated[
        bool, Option("--float", help="Round every product and sum to float64.")
    ] = False,
) -> None:
    """Show the value of an expression."""
    from nmatrix.calculator.answer import report
    from nmatrix.calculator.evaluate import calculate
    from nmatrix.calculator.names import names_of, with_name
    from nmatrix.calculator.values import Arithmetic

    groups = OptionGroups(world, view, lens, scene=scene)
    setup = groups.setup(common, is_of_node=False)
    piped = (world.world_matrix or "").partition("#")[0] == "-"  # stdin is read once
    names = names_of(setup, expression, None if piped else groups.typed_world(common, setup))
    for definition in let or ():
        name, equals, text = definition.partition("=")
        if not equals:
            raise IllegalValueError(
                f"--let ({definition[:40]})", "it is NAME=MATRIX", 'try --let "A=1 0; 0 2"'
            )
        names = with_name(names, name.strip(), common.sources.literal(text.strip()).rows_exact)
    arithmetic = Arithmetic.FLOAT if float64 else Arithmetic.EXACT
    show(report(calculate(expression, names, arithmetic), with_steps=steps), common)
