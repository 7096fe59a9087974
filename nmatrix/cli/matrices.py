"""The panel Matrices: world, view, projection, normal, identify."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.scene_options import OptionGroups, SceneOptions, SpaceOptions, ToleranceOption
from nmatrix.cli.shared_options import CommonOptions, among, option_name
from nmatrix.cli.show import show
from nmatrix.cli.world_options import OrderOption, WorldOptions
from nmatrix.enums import NORMAL_METHODS, AxisName, NormalRule, chosen
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import number_list, numbers

HELP = {
    "world": """nmatrix world --scale 1 2 1

nmatrix world --translate -3 0 -1.5 --rotate 0 30 0 --order ZYX

nmatrix world --scene sample --object hand -f json""",
    "view": """nmatrix view --eye 3 3 2.5 --target 0 0 0

nmatrix view --eye 3 3 2.5 --elevation -45 --angle -40 --convention polimi""",
    "projection": """nmatrix projection --fov 90 --aspect 16/9 --near 0.1 --far 100

nmatrix projection --api vulkan --far inf --depth reversed --at 1 10 100

nmatrix projection --ortho -2 2 -1 1 --near 0 --far 10""",
    "identify": """nmatrix identify "1.7321 0 0 0; 0 1.7321 0 0; 0 0 1.0101 -1.0101; 0 0 1 0"

nmatrix identify "0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1"

nmatrix view --eye 3 3 2.5 -f json | nmatrix identify -""",
    "axes": """nmatrix axes blender unity

nmatrix axes opengl unreal "0 0 1 5; 0 1 0 0; -1 0 0 0; 0 0 0 1" --order ZYX

nmatrix axes "+x +z +y" opengl

Three axes of your own say which of them point right, up and forward.""",
    "normal": """nmatrix normal "1 0 0; 0 2 0; 0 0 1" --normal 1 1 0

nmatrix normal --scale 1 2 1 --rotate 0 30 0 --space camera

nmatrix world --scale 1 2 1 -f json | nmatrix normal - --normal 1 1 0""",
}


AXES = f"{', '.join(AxisName)}, or three signed axes."


def world(
    world: WorldOptions, tolerance: ToleranceOption, scene: SceneOptions, common: CommonOptions
) -> None:
    """Show the world matrix."""
    from nmatrix.answers.world import world as answer

    groups = OptionGroups(world=world, scene=scene)
    show(answer(groups.setup(common, tolerance=tolerance)), common)


def view(view: ViewOptions, scene: SceneOptions, common: CommonOptions) -> None:
    """Show the view matrix."""
    from nmatrix.answers.view import view as answer

    show(answer(OptionGroups(view=view, scene=scene).setup(common, is_of_node=False)), common)


def projection(
    *,
    lens: LensOptions,
    scene: SceneOptions,
    common: CommonOptions,
    at: Annotated[
        str | None, Option("--at", metavar="DISTANCE...", help="Distances to tell the depth of.")
    ] = None,
    depth_value: Annotated[
        str | None,
        Option("--depth-value", metavar="DEPTH...", help="Stored depths to tell the distance of."),
    ] = None,
) -> None:
    """Show the projection matrix."""
    from nmatrix.answers.depth import DepthRequest
    from nmatrix.answers.projection import projection as answer

    asked = DepthRequest(
        () if at is None else number_list(at, "--at"),
        () if depth_value is None else number_list(depth_value, "--depth-value"),
    )
    setup = OptionGroups(lens=lens, scene=scene).setup(common, is_of_node=False)
    show(answer(setup, asked), common)


def normal(
    *,
    world: WorldOptions,
    view: ViewOptions,
    space: SpaceOptions,
    tolerance: ToleranceOption,
    scene: SceneOptions,
    common: CommonOptions,
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
            "--method",
            metavar=f"<{'|'.join(NORMAL_METHODS)}>",
            autocompletion=among(NORMAL_METHODS),
            help="Right, or one of three to compare with.",
        ),
    ] = NORMAL_METHODS[0].value,
) -> None:
    """Show the normal matrix and the normals through it."""
    from nmatrix.answers.normal import NormalRequest
    from nmatrix.answers.normal import normal as answer

    if matrix is not None or scene.scene is None:
        world = _with_matrix(world, matrix)
    groups = OptionGroups(world, view, space=space, scene=scene)
    request = NormalRequest(
        normals=tuple(numbers(text, 3, "--normal") for text in normals or ()),
        space=groups.shading_space(),
        method=chosen(NormalRule, method, "method", NORMAL_METHODS),
    )
    show(answer(groups.setup(common, tolerance=tolerance), request), common)


def identify(
    *,
    matrix: Annotated[
        str, Argument(metavar="MATRIX", help="Any 3×3, 3×4 or 4×4 matrix; - reads stdin.")
    ],
    common: CommonOptions,
) -> None:
    """Show what a matrix may be."""
    from nmatrix.answers.identify import identify_matrix

    show(identify_matrix(common.sources.literal(matrix).as_floats), common)


def axes(
    *,
    source: Annotated[str, Argument(metavar="FROM", help=AXES, autocompletion=among(AxisName))],
    target: Annotated[
        str, Argument(metavar="TO", help="The same.", autocompletion=among(AxisName))
    ],
    matrix: Annotated[
        str | None, Argument(metavar="MATRIX", help="A matrix of FROM to tell in TO.")
    ] = None,
    order: OrderOption = None,
    common: CommonOptions,
) -> None:
    """Show the way from one axis system to another."""
    from nmatrix.answers.axes import axes as answer

    given = None if matrix is None else common.sources.affine(matrix)
    show(answer(source, target, given, "XYZ" if order is None else order), common)


def _with_matrix(world: WorldOptions, matrix: str | None) -> WorldOptions:
    if matrix is None:
        if world.given:
            return world
        raise IllegalValueError(
            "normal", "no matrix was given", 'try nmatrix normal "1 0 0; 0 2 0; 0 0 1"'
        )
    if world.given:
        beside = ", ".join(map(option_name, world.given))
        raise IllegalValueError(
            f"MATRIX with {beside}", "the matrix is the whole world matrix", "keep one of them"
        )
    return replace(world, world_matrix=matrix)
