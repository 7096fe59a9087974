"""`nmatrix explore`: one page to turn and drag."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Option

from nmatrix.cli.scene_options import OptionGroups
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.output.explorer.sliders import first_look
from nmatrix.output.files import kind_of, refuse_existing, write_file
from nmatrix.report import Report, Text, Verdict

PARTS = ("world", "view", "lens", "light")
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
        given = {name for name in PARTS if getattr(groups, name).given}
        setup = first_look(setup, given)
    fits = groups.scene.scene is None and not groups.view.given
    write_file(path, written(setup, fits=fits), force=force)
    blocks = (Verdict(f"Written: {path}"), Text("Open it in a browser; it needs no network."))
    show(Report("explore", {"file": str(path)}, blocks), common)
