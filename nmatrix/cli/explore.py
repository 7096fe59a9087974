"""`nmatrix explore`: one page to turn and drag."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Annotated

from typer import Option

from nmatrix.cli.scene_options import OptionGroups
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.output.files import kind_of, refuse_existing, write_file
from nmatrix.report import Report, Text, Verdict
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.world import World

FROM_ABOVE = (3.6, 1.5, 9.2)  # the page comes as near as the body lets it
LONG_LENS = 30.0  # degrees; a short one bends a ball near the rim
FROM_THE_RIGHT = Light((-0.85, -0.55, -0.65))  # both a lit and a dark side are seen
STRETCHED = World(scale=(1, 2, 1))  # without a stretch every rule is right, and nothing is seen

HELP = {
    "explore": """nmatrix explore

nmatrix explore --scale 1 2 1 --light-direction -1 -2 -1 -o stretch.html

The page is one file and needs no network.""",
}


def explore(
    *,
    groups: OptionGroups,
    common: CommonOptions,
    output: Annotated[
        str, Option("--output", "-o", metavar="FILE", help="Where the page goes.")
    ] = "explore.html",
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False,
) -> None:
    """Write the page."""
    from nmatrix.output.explorer.page import page

    path = Path(output)
    written = kind_of(path, {".html": page, ".htm": page})
    refuse_existing([path], force=force)
    setup = groups.setup(common)
    if groups.scene.scene is None:
        first = first_look(setup)
        setup = replace(
            setup,
            world=setup.world if groups.world.given else first.world,
            view=setup.view if groups.view.given else first.view,
            lens=setup.lens if groups.lens.given else first.lens,
            light=setup.light if groups.light.given else first.light,
        )
    fits = groups.scene.scene is None and not groups.view.given
    write_file(path, written(setup, fits=fits), force=force)
    blocks = (Verdict(f"Written: {path}"), Text("Open it in a browser; it needs no network."))
    show(Report("explore", {"file": str(path)}, blocks), common)


def first_look(setup: Setup) -> Setup:
    """Make of a setup the one that the page begins with, where nothing is given."""
    return replace(
        setup,
        world=STRETCHED,
        view=replace(setup.view, eye=FROM_ABOVE),
        lens=replace(setup.lens, fov_degrees=LONG_LENS),
        light=FROM_THE_RIGHT,
    )
