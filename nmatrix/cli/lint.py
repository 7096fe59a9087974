"""`nmatrix lint`: which spaces meet in shaders that must not, and a gate for it."""

from __future__ import annotations

import sys
from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.scene_options import OptionGroups, SceneOptions
from nmatrix.cli.shared_options import CommonOptions, among
from nmatrix.cli.show import put, put_remarks, show
from nmatrix.cli.world_options import WorldOptions
from nmatrix.enums import Format, Severity, ShaderLanguage, chosen
from nmatrix.errors import IllegalValueError
from nmatrix.samples import SHADERS, file_or_sample, samples

FAILING = (Severity.ERROR, Severity.WARNING)

HELP = {
    "lint": """nmatrix lint phong.vert phong.frag

nmatrix lint phong.vert --scale 1 2 1

nmatrix lint phong.vert phong.frag --fix

Files of a folder that differ only in their endings are one program, and so are the
only two that are given. A folder is searched to its depths, - is standard input.""",
}


def lint(
    *,
    world: WorldOptions,
    scene: SceneOptions,
    common: CommonOptions,
    files: Annotated[
        list[str],
        Argument(
            metavar="FILE...",
            help="Shaders in GLSL or HLSL, folders of them, or -.",
            autocompletion=among(samples, *SHADERS),
        ),
    ],
    language: Annotated[
        ShaderLanguage | None, Option(help="The language (told by names and contents).")
    ] = None,
    fix: Annotated[
        bool, Option("--fix", help="Print a patch of the lines that can be mended.")
    ] = False,
    fail_on: Annotated[
        str | None,
        Option(
            metavar="WORD",
            help="Exit 1 for an error (the default), or for a warning too.",
            autocompletion=among(FAILING),
        ),
    ] = None,
) -> None:
    """Show where spaces meet in shaders that must not."""
    from nmatrix.answers.lint import SUFFIXES, Asked, report, source
    from nmatrix.reading.folders import STANDARD_INPUT, files_of

    least = Severity.ERROR if fail_on is None else chosen(Severity, fail_on, "fail_on", FAILING)
    if files.count(STANDARD_INPUT) > 1:
        raise IllegalValueError("- (standard input)", "it can be read only once", "give it once")
    typed = {file_or_sample(one): one for one in files}
    paths = files_of(map(str, typed), SUFFIXES)
    content = sys.stdin.buffer.read() if STANDARD_INPUT in files else b""
    groups = OptionGroups(world=world, scene=scene)
    placed = None
    if groups.is_given:
        setup = groups.setup(common)
        placed = setup.world.world_from_object, setup.tolerance
    asked = Asked(
        world=None if placed is None else placed[0],
        fail_on=least,
        with_fixes=fix,
        language=language,
        are_one_program=len(files) == len(paths) == 2,
    )
    found = report([source(path, content, typed.get(path)) for path in paths], asked)
    if fix and common.format is Format.TEXT:  # so that `patch` takes every byte of it
        put(str(found.data["patch"]))
        put_remarks(found.remarks)
        if found.failure is not None:
            raise found.failure
    else:
        show(found, common)
