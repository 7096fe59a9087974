"""The panel Proofs without its pictures: the derivations, and the plan of a scene."""

from __future__ import annotations

from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.shared_options import OUTSIDE, CommonOptions, among
from nmatrix.cli.show import put, show
from nmatrix.cli.world_options import WorldOptions
from nmatrix.errors import IllegalValueError
from nmatrix.lessons.derive import lesson
from nmatrix.reading.numbers import fractions
from nmatrix.samples import file_or_sample, samples
from nmatrix.scene.world import World

HELP = {
    "derive": f"""nmatrix derive

nmatrix derive mirror -f latex

nmatrix derive nonuniform --scale 1 2 1 --rotate 0 0 30

Cases: {", ".join(lesson.LESSONS)}, all.""",
    "plan": """nmatrix plan sample

nmatrix plan teapot -f json

nmatrix plan --schema > scene.schema.json

What each of them needs, and how safely the others are left out.""",
}


def derive(
    *,
    world: WorldOptions,
    common: CommonOptions,
    case: Annotated[
        str,
        Argument(
            metavar="CASE",
            help="Which lesson.",
            autocompletion=among((*lesson.LESSONS, lesson.ALL)),
        ),
    ] = "rule",
) -> None:
    """Show a derivation."""
    lesson.chosen(case)
    own = world.over(World(), common.sources, fractions) if world.given else None
    show(lesson.derive(case, own), common)


def plan(
    *,
    common: CommonOptions,
    scene: Annotated[
        str | None,
        Argument(
            metavar="SCENE",
            help="A .toml, .gltf or .glb scene, or a mesh.",
            show_default=False,
            autocompletion=among(samples, ".toml", ".obj"),
        ),
    ] = None,
    schema: Annotated[
        bool, Option("--schema", help="Print the JSON Schema of scene files.")
    ] = False,
    allow_outside: Annotated[bool, Option("--allow-outside", help=OUTSIDE)] = False,
) -> None:
    """Show the plan of a scene."""
    if schema:
        from nmatrix.scene.toml.schema import schema as scene_schema

        put(scene_schema())
        return
    if scene is None:
        raise IllegalValueError("plan", "it needs a scene file", "try nmatrix plan sample")
    from nmatrix.answers.plan import plan_of_file

    show(plan_of_file(file_or_sample(scene), allow_outside=allow_outside), common)
