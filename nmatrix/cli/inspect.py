"""`nmatrix inspect`: the nodes of a scene or mesh file."""

from __future__ import annotations

from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.scene_options import ToleranceOption
from nmatrix.cli.shared_options import CommonOptions
from nmatrix.cli.show import show
from nmatrix.errors import IllegalValueError
from nmatrix.linear.classify import FROM_FILE
from nmatrix.reading.files import existing_file, is_folder
from nmatrix.samples import file_or_sample

HELP = {
    "inspect": """nmatrix inspect teapot

nmatrix inspect teapot -f json

nmatrix inspect teapot --fail-on mirrored,shear

For each node the kind of its world matrix, and why it needs it or not.""",
}


def inspect(
    *,
    tolerance: ToleranceOption,
    common: CommonOptions,
    file: Annotated[str, Argument(metavar="FILE", help="A .gltf, .glb, .obj, .ply or .stl file.")],
    fail_on: Annotated[
        str | None,
        Option(metavar="WORDS", help="Exit 1 for mirrored, shear, degenerate (with commas)."),
    ] = None,
) -> None:
    """Show the nodes of a file."""
    from nmatrix.answers.inspect import FAILURES, inspect_file, report

    words = tuple(word.strip() for word in fail_on.split(",")) if fail_on else ()
    for word in words:
        if word not in FAILURES:
            raise IllegalValueError(
                f"--fail-on ({word[:20]})", f"it knows {', '.join(FAILURES)}", "choose from them"
            )
    path = existing_file(str(file_or_sample(file)))
    if path is None:
        raise IllegalValueError(
            f"file ({file[:60]})",
            "it is a folder" if is_folder(file) else "it does not exist",
            "give a .gltf, .glb, .obj, .ply or .stl file",
        )
    show(report(inspect_file(path, tolerance.value(FROM_FILE)), words), common)
