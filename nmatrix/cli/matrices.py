"""The panel Matrices: world, view, projection."""

from __future__ import annotations

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.scene_group import SceneOptions
from nmatrix.cli.scene_options import Groups, ToleranceOption
from nmatrix.cli.show import show
from nmatrix.cli.world_options import WorldOptions

HELP = {
    "world": """nmatrix world --scale 1 2 1

nmatrix world --translate -3 0 -1.5 --rotate 0 30 0 --order ZYX

nmatrix world --scene arm.toml --object hand -f json

The world matrix M = T · R · S · H, what kind of map it is, its parts, its normal matrix.""",
    "view": """nmatrix view --eye 3 3 2.5 --target 0 0 0

nmatrix view --eye 3 3 2.5 --elevation -45 --angle -40 --convention polimi

The view matrix, its factors R · T, and the camera's axes.""",
    "projection": """nmatrix projection --fov 90 --aspect 16/9 --near 0.1 --far 100

nmatrix projection --api vulkan --far inf --depth reversed

nmatrix projection --ortho -2 2 -1 1 --near 0 --far 10

The projection matrix, and the smallest gap that its depth can tell.""",
}


def world(
    world: WorldOptions, tolerance: ToleranceOption, scene: SceneOptions, everywhere: Everywhere
) -> None:
    """Show the world matrix."""
    from nmatrix.answers.world import world as answer

    groups = Groups(world=world, tolerance=tolerance, scene=scene)
    show(answer(groups.setup(everywhere)), everywhere)


def view(view: ViewOptions, scene: SceneOptions, everywhere: Everywhere) -> None:
    """Show the view matrix."""
    from nmatrix.answers.view import view as answer

    show(answer(Groups(view=view, scene=scene).setup(everywhere)), everywhere)


def projection(lens: LensOptions, scene: SceneOptions, everywhere: Everywhere) -> None:
    """Show the projection matrix."""
    from nmatrix.answers.projection import projection as answer

    show(answer(Groups(lens=lens, scene=scene).setup(everywhere)), everywhere)
