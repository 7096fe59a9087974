"""`nmatrix calc`: an expression over the scene's matrices and those that --let names."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.scene_options import OptionGroups, SceneOptions
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.cli.sources import Sources
from nmatrix.cli.world_options import WorldOptions
from nmatrix.errors import IllegalValueError

if TYPE_CHECKING:
    from nmatrix.calculator.values import Value
    from nmatrix.scene.world import World

HELP = {
    "calc": r"""nmatrix calc "inverse_transpose(linear(M))" --scale 1 2 1

nmatrix calc "P @ V @ M @ point(\[1, 1, 1])" --steps

nmatrix calc "det(A) * inverse(A)" --let "A=2 1; 1 1"

Over M, V, P, literals and --let names.""",
}

SCENE_NAMES = ("M", "V", "P")


def calc(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    scene: SceneOptions,
    common: CommonOptions,
    expression: Annotated[str, Argument(metavar="EXPRESSION", help="What to compute.")],
    let: Annotated[
        list[str] | None,
        Option("--let", metavar="NAME=MATRIX", help="Name a matrix; repeat for more."),
    ] = None,
    steps: Annotated[bool, Option("--steps", help="Show every operation.")] = False,
    float64: Annotated[bool, Option("--float", help="Round every operation to float64.")] = False,
) -> None:
    """Show the value of an expression."""
    from nmatrix.calculator.answer import report
    from nmatrix.calculator.evaluate import calculate
    from nmatrix.calculator.values import Arithmetic

    sources = Sources(common.input_layout)
    names = _scene_names(OptionGroups(world, view, lens, scene=scene), sources, expression)
    for definition in let or ():
        name, value = _named(definition, sources, names)
        names[name] = value
    arithmetic = Arithmetic.FLOAT if float64 else Arithmetic.EXACT
    show(report(calculate(expression, names, arithmetic), with_steps=steps), common)


def _scene_names(groups: OptionGroups, sources: Sources, expression: str) -> dict[str, Value]:
    from nmatrix.calculator.values import Value

    setup = groups.setup_from(sources)
    piped = (groups.world.world_matrix or "").partition("#")[0] == "-"
    typed = setup.world if piped else groups.typed_world(sources, setup)  # stdin is read once
    exact = _is_rational(typed)
    world = typed.exact if exact else setup.world.world_from_object
    names = {"M": Value(world, exact=exact)}
    if "V" in expression:
        names["V"] = Value(setup.camera.camera_from_world)
    if "P" in expression:
        names["P"] = Value(setup.lens.clip_from_camera)
    return names


def _is_rational(world: World) -> bool:
    """Whether the typed world matrix is rational: quarter turns, or no angles at all."""
    if world.matrix is not None or world.quaternion is not None:
        return True
    return all(Fraction(turn) % 90 == 0 for turn in world.rotate_degrees)


def _named(definition: str, sources: Sources, names: dict[str, Value]) -> tuple[str, Value]:
    from nmatrix.calculator.functions import FUNCTIONS
    from nmatrix.calculator.values import Value

    name, equals, text = definition.partition("=")
    name = name.strip()
    if not equals or not (name.isascii() and name.isidentifier()):
        raise IllegalValueError(
            f"--let ({definition[:40]})", "it is NAME=MATRIX", 'try --let "A=1 0; 0 2"'
        )
    if name in FUNCTIONS or name in SCENE_NAMES or name in names:
        raise IllegalValueError(f"--let {name}", "the name is taken", "choose another one")
    rows = sources.literal(text.strip()).rows_exact
    if len(rows) == 1:
        return name, Value(rows[0][0] if len(rows[0]) == 1 else rows[0])
    return name, Value(rows)
