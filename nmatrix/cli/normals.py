"""`nmatrix normal`: the matrix as an argument, the normals as repeated options."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.alternatives import refuse_together
from nmatrix.cli.camera_options import ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.scene_group import SceneOptions
from nmatrix.cli.scene_options import Groups, SpaceOptions, ToleranceOption
from nmatrix.cli.show import show
from nmatrix.cli.world_options import WorldOptions
from nmatrix.enums import NORMAL_METHODS, NormalRule, Space
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import numbers

HELP = {
    "normal": """nmatrix normal "1 0 0; 0 2 0; 0 0 1" --normal 1 1 0

nmatrix normal --scale 1 2 1 --rotate 0 30 0 --space camera

nmatrix world --scale 1 2 1 -f json | nmatrix normal - --normal 1 1 0

The normal matrix (inverse transpose) of a map, and what becomes of each normal.""",
}


def normal(
    *,
    world: WorldOptions,
    view: ViewOptions,
    space: SpaceOptions,
    tolerance: ToleranceOption,
    scene: SceneOptions,
    everywhere: Everywhere,
    matrix: Annotated[
        str | None, Argument(metavar="MATRIX", help="The world matrix; - reads stdin.")
    ] = None,
    normals: Annotated[
        list[str] | None,
        Option("--normal", metavar="X Y Z", help="A normal to carry; repeat for more."),
    ] = None,
    method: Annotated[
        str,
        Option(
            metavar=f"<{'|'.join(NORMAL_METHODS)}>",
            autocompletion=lambda: list(NORMAL_METHODS),
            help="Right, or one of three to compare with.",
        ),
    ] = NORMAL_METHODS[0].value,
) -> None:
    """Show the normal matrix and the normals through it."""
    from nmatrix.answers.normal import NormalRequest
    from nmatrix.answers.normal import normal as answer

    if matrix is not None or scene.scene is None:
        world = _with_matrix(world, matrix)
    groups = Groups(world, view, space=space, tolerance=tolerance, scene=scene)
    request = NormalRequest(
        normals=tuple(numbers(text, 3, "--normal") for text in normals or ()),
        space=space.chosen(None, groups.usual_space(Space.WORLD)) or Space.WORLD,
        method=_method_named(method),
    )
    show(answer(groups.setup(everywhere), request), everywhere)


def _method_named(name: str) -> NormalRule:
    if name not in NORMAL_METHODS:
        raise IllegalValueError(
            f"--method ({name[:20]})",
            f"it is one of {', '.join(NORMAL_METHODS)}",
            f"try {NORMAL_METHODS[0]}",
        )
    return NormalRule(name)


def _with_matrix(world: WorldOptions, matrix: str | None) -> WorldOptions:
    if matrix is None:
        if world.is_given:
            return world
        raise IllegalValueError(
            "normal", "no matrix was given", 'try nmatrix normal "1 0 0; 0 2 0; 0 0 1"'
        )
    others = dict(world.parts_given)
    if world.world_matrix is not None:
        others["--world-matrix"] = world.world_matrix
    refuse_together("MATRIX", others, "the matrix is the whole world matrix")
    return replace(world, world_matrix=matrix)
