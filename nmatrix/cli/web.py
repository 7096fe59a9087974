"""`nmatrix web`: a folder in which this program runs in a reader's browser."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show, witnessed
from nmatrix.report import Report, Text, Value, Verdict
from nmatrix.scene.setup import Setup

if TYPE_CHECKING:
    from nmatrix.web.desk import Desk

USUAL_PYODIDE = "node_modules/pyodide"

HELP = {
    "web": """nmatrix web

nmatrix web -o site --force

Any server of files will do, below any path: python -m http.server -d site. Pyodide, the Python
that browsers run, is npm's: npm install pyodide.""",
}


def web(
    *,
    common: CommonOptions,
    output: Annotated[
        str, Option("--output", "-o", metavar="DIR", help="Where the folder goes.")
    ] = "site",
    pyodide: Annotated[
        str | None, Option(metavar="DIR", help="npm's package pyodide (node_modules/pyodide).")
    ] = None,
    force: Annotated[
        bool, Option("--force", help="Write into a folder that is not empty.")
    ] = False,
) -> None:
    """Write the folder."""
    from nmatrix.output.explorer.page import page
    from nmatrix.output.explorer.sliders import first_look
    from nmatrix.web.folder import folder, write

    target = Path(output)
    place = pyodide or os.environ.get("NMATRIX_PYODIDE") or USUAL_PYODIDE
    content = folder(Path(place), lambda: page(first_look(Setup()), fits=True))
    write(target, content, force=force)
    size = sum(map(len, content.values()))
    told = f"Written: {len(content)} files of {size / 1e6:.1f} MB in {target}"
    blocks = (Verdict(told), Text(f"Look at it with python -m http.server -d {target}"))
    data: dict[str, Value] = {"folder": str(target), "files": sorted(content), "bytes": size}
    show(Report("web", data, blocks), common)


def desk() -> Desk:
    """Open the desk of this command line: what the worker of the pages begins with."""
    from nmatrix.cli.app import run
    from nmatrix.web.desk import Desk, Shell

    return Desk(Shell(run, witnessed, COMMANDS))
