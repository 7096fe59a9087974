"""The panel Spaces: light, eye, space, trace."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.scene_options import OptionGroups, SceneOptions, SpaceArgument, SpaceOptions
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Reflection, Shading
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import numbers

if TYPE_CHECKING:
    from nmatrix.spaces.trace import Viewport

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
    point: Annotated[str, Option(metavar="X Y Z", help="The vertex, in object space.")] = "0 0 0",
    normal: Annotated[
        str | None, Option(metavar="X Y Z", help="Its normal, in object space.")
    ] = None,
    viewport: Annotated[
        str | None, Option(metavar="W H", help="The window in pixels (512 512).")
    ] = None,
) -> None:
    """Show one vertex on its way."""
    from nmatrix.answers.trace import trace as answer

    window = _window(viewport, scene)
    aspect = None if viewport is None else window.width / window.height
    setup = OptionGroups(world, view, lens, scene=scene).setup(common, aspect=aspect)
    n = None if normal is None else numbers(normal, 3, "--normal")
    show(answer(setup, numbers(point, 3, "--point"), n, window), common)


def _window(viewport: str | None, scene: SceneOptions) -> Viewport:
    """Read the window, by default the scene's picture."""
    from nmatrix.spaces.trace import Viewport

    if viewport is None:
        size = (512, 512) if scene.scene is None else scene.scene.settings.size
        return Viewport(*map(float, size))
    return Viewport(*numbers(viewport, 2, "--viewport"))
