"""`nmatrix plan`: which effects a scene calls for, and why."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from typer import Argument, Option

from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.show import put, show
from nmatrix.errors import IllegalValueError

HELP = {
    "plan": """nmatrix plan scene.toml

nmatrix plan scene.glb -f json

nmatrix plan --schema > scene.schema.json

Which effects a scene calls for, why, what each needs, and how safely the others are left out.""",
}


def plan(
    *,
    everywhere: Everywhere,
    scene: Annotated[
        str | None,
        Argument(
            metavar="SCENE", help="A .toml, .gltf or .glb scene, or a mesh.", show_default=False
        ),
    ] = None,
    schema: Annotated[
        bool, Option("--schema", help="Print the JSON Schema of scene files.")
    ] = False,
) -> None:
    """Show the plan of a scene."""
    if schema:
        from nmatrix.scene.toml.schema import schema as scene_schema

        put(scene_schema())
        return
    if scene is None:
        raise IllegalValueError("plan", "it needs a scene file", "try nmatrix plan scene.toml")
    from nmatrix.answers.plan import plan_of_file

    show(plan_of_file(Path(scene)), everywhere)
