"""`nmatrix inspect`: the nodes of scene and mesh files, and a gate for those with a flaw."""

from __future__ import annotations

import gc
import sys
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.scene_options import ToleranceOption
from nmatrix.cli.shared_options import OUTSIDE, CommonOptions, among, option_name
from nmatrix.cli.show import progress, show, width
from nmatrix.enums import Flaw, NodeOrder, chosen_words
from nmatrix.errors import IllegalValueError, spelled
from nmatrix.linear.classify import FROM_FILE
from nmatrix.samples import file_or_sample, samples

if TYPE_CHECKING:
    from nmatrix.answers.inspect.file import InspectedFile

WORDS = ", ".join(Flaw)

HELP = {
    "inspect": """nmatrix inspect teapot

nmatrix inspect teapot --only degenerate,mirrored -f csv

nmatrix inspect teapot --fail-on mirrored,shear -f github

The nodes whose map is not plain, and why: their normals need more than the world matrix. A folder
is searched to its depths, - is standard input.""",
}


def inspect(
    *,
    tolerance: ToleranceOption,
    common: CommonOptions,
    files: Annotated[
        list[str],
        Argument(
            metavar="FILE...",
            help=".gltf .glb .obj .ply .stl files, folders of them, or -.",
            autocompletion=among(samples, ".obj"),
        ),
    ],
    only: Annotated[
        str | None,
        Option(
            metavar="WORDS",
            help=f"Nodes with one of these alone, with commas: {WORDS}.",
            autocompletion=among(Flaw),
        ),
    ] = None,
    sort: Annotated[
        NodeOrder | None, Option(help="What rows are sorted by (kind; in a file: index).")
    ] = None,
    everything: Annotated[
        bool, Option("--all", help="Every row in text, and nodes without a flaw too.")
    ] = False,
    fail_on: Annotated[
        str | None,
        Option(
            metavar="WORDS",
            help="Exit 1 for a node with one of these; the words of --only.",
            autocompletion=among(Flaw),
        ),
    ] = None,
    allow_outside: Annotated[bool, Option("--allow-outside", help=OUTSIDE)] = False,
) -> None:
    """Show the nodes of files."""
    from nmatrix.answers.inspect.files import SUFFIXES, inspected
    from nmatrix.answers.inspect.report import Chosen, report
    from nmatrix.reading.folders import STANDARD_INPUT, files_of

    chosen = Chosen(
        () if only is None else chosen_words(Flaw, only, "only"),
        sort,
        everything,
        () if fail_on is None else chosen_words(Flaw, fail_on, "fail_on"),
        width(),
    )
    if files.count(STANDARD_INPUT) > 1:
        raise IllegalValueError("- (standard input)", "it can be read only once", "give it once")
    paths = files_of([str(file_or_sample(one)) for one in files], SUFFIXES)
    content = sys.stdin.buffer.read() if STANDARD_INPUT in files else b""
    limit = tolerance.value(FROM_FILE)
    found = []
    for path in progress(paths, len(paths), "inspecting"):
        one = inspected(path, limit, standard_input=content, allow_outside=allow_outside)
        found.append(_spelled(one))
        gc.freeze()  # it stays to the end: looking through it for every file would take longest
    show(report(found, chosen), common)


def _spelled(found: InspectedFile) -> InspectedFile:
    """Let an error that becomes a row speak of options, as those do that are the end."""
    if found.error is None:
        return found
    parts = (spelled(part, option_name) for part in found.error.parts)
    return replace(found, error=IllegalValueError(*parts))
