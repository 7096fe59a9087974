"""The panel Spaces: light, eye, space, trace."""

from __future__ import annotations

from typing import Annotated

from typer import Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.scene_options import OptionGroups, SceneOptions, SpaceArgument, SpaceOptions
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Reflection, Shading
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import number, numbers

HELP = {
    "light": """nmatrix light camera --eye 3 3 3 --light-angles -60 -120

nmatrix light object --scale 1 1/4 1 --light-direction 0.3 0.9 0.2

nmatrix light --light-position 2 2 8""",
    "eye": """nmatrix eye object --rotate 0 30 0 --translate 1e7 0 0 --eye 10000003 1 2

nmatrix eye --eye 3 3 2.5

The course's formula stands beside it.""",
    "space": """nmatrix space camera --scale 1 2 1

nmatrix space object --shear 1 0 0 -f glsl

nmatrix space custom --space-matrix "2 0 0; 0 1 0; 0 0 1"

With -f glsl its shaders.""",
    "trace": """nmatrix trace --point 1 1 1 --normal 0 0 1

nmatrix trace --point 0 0 6 --viewport 1920 1080 --api vulkan

nmatrix trace --pixel 960 540 --viewport 1920 1080 --depth-value 0.5

It names the planes that the vertex is outside of.""",
}


def light(
    *,
    world: WorldOptions,
    view: ViewOptions,
    light: LightOptions,
    space: SpaceOptions,
    scene: SceneOptions,
    common: CommonOptions,
    where: SpaceArgument = None,
) -> None:
    """Show the light in a space."""
    from nmatrix.answers.light import light as answer

    setup = OptionGroups(world, view, light=light, space=space, scene=scene).setup(common)
    show(answer(setup, space.chosen(where)), common)


def eye(
    *,
    world: WorldOptions,
    view: ViewOptions,
    space: SpaceOptions,
    scene: SceneOptions,
    common: CommonOptions,
    where: SpaceArgument = None,
) -> None:
    """Show the eye in a space."""
    from nmatrix.answers.light import eye as answer

    setup = OptionGroups(world, view, space=space, scene=scene).setup(common)
    show(answer(setup, space.chosen(where)), common)


def space(
    *,
    groups: OptionGroups,
    common: CommonOptions,
    where: SpaceArgument = None,
    shading: Annotated[
        Shading, Option(help="Light per vertex (gouraud) or per fragment (phong).")
    ] = Shading.PHONG,
    reflection: Annotated[
        Reflection, Option(help="How the surface reflects.")
    ] = Reflection.BLINN_PHONG,
) -> None:
    """Show the sheet of a shading space."""
    from nmatrix.answers.space import space as answer
    from nmatrix.shaders.sheet import Request

    if shading is Shading.FLAT:
        raise IllegalValueError(
            "--shading flat",
            "the sheet's shaders light per vertex or per fragment",
            "use gouraud or phong",
        )
    chosen = groups.shading_space(where)
    show(answer(groups.setup(common), Request(chosen, shading, reflection)), common)


def trace(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    scene: SceneOptions,
    common: CommonOptions,
    point: Annotated[
        str | None, Option(metavar="X Y Z", help="The vertex, in object space (0 0 0).")
    ] = None,
    normal: Annotated[
        str | None, Option(metavar="X Y Z", help="Its normal, in object space.")
    ] = None,
    pixel: Annotated[
        str | None,
        Option(metavar="X Y", help="Back from a pixel instead: 0.5 0.5 is the upper left one."),
    ] = None,
    depth_value: Annotated[
        str | None, Option(metavar="D", help="The depth that is stored there, 0 to 1.")
    ] = None,
) -> None:
    """Show one vertex on its way, or the ray of one pixel."""
    from nmatrix.answers.trace import answer_to

    setup = OptionGroups(world, view, lens, scene=scene).setup(common)
    given = {
        "point": None if point is None else numbers(point, 3, "--point"),
        "normal": None if normal is None else numbers(normal, 3, "--normal"),
        "pixel": None if pixel is None else numbers(pixel, 2, "--pixel"),
        "depth_value": None if depth_value is None else number(depth_value, "--depth-value"),
    }
    show(answer_to(given, setup, scene.window(setup.lens)), common)
