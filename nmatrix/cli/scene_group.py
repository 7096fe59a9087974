"""The Scene group: a file for all the other groups; an option beside it replaces its own key.

An alternative (two angles for a target, a matrix for its parts) replaces the whole alternative.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.errors import IllegalValueError

if TYPE_CHECKING:
    from nmatrix.linear.rational import RationalMatrix
    from nmatrix.scene.camera import View
    from nmatrix.scene.light import SceneLight
    from nmatrix.scene.scene import Scene, SceneObject
    from nmatrix.scene.setup import Light
    from nmatrix.scene.world import World

SCENE = "Scene"


@dataclass(frozen=True)
class SceneOptions:
    """Which scene, and what in it."""

    scene_file: Annotated[
        str | None,
        Option(
            "--scene",
            metavar="FILE",
            help="Take what no option says from a .toml, .gltf or .glb scene.",
            rich_help_panel=SCENE,
        ),
    ] = None
    object_name: Annotated[
        str | None,
        Option("--object", metavar="NAME", help="Which object (the first).", rich_help_panel=SCENE),
    ] = None
    light_name: Annotated[
        str | None,
        Option("--light", metavar="NAME", help="Which light (the first).", rich_help_panel=SCENE),
    ] = None

    @cached_property
    def scene(self) -> Scene | None:
        """Return the scene, if there is one; the readers are imported only then."""
        if self.scene_file is None:
            for option, name in (("--object", self.object_name), ("--light", self.light_name)):
                if name is not None:
                    raise IllegalValueError(
                        f"{option} ({name[:40]})", "it is a name in a scene", "add --scene FILE"
                    )
            return None
        from nmatrix.scene.open import scene_of

        return scene_of(Path(self.scene_file))

    @cached_property
    def chosen_object(self) -> SceneObject | None:
        """Return the object that was named, or the first."""
        if self.scene is None:
            return None
        if self.object_name is None:
            return self.scene.objects[0]
        for one in self.scene.objects:
            if one.name == self.object_name:
                return one
        raise self._unknown("--object", self.object_name, [one.name for one in self.scene.objects])

    @cached_property
    def chosen_light(self) -> SceneLight | None:
        """Return the light that was named, or the first that is anywhere."""
        if self.scene is None:
            return None
        placed = [one for one in self.scene.lights if one.has_position or one.has_direction]
        if self.light_name is None:
            return placed[0] if placed else None
        for one in placed:
            if one.name == self.light_name:
                return one
        if self.light_name in [one.name for one in self.scene.lights]:
            raise IllegalValueError(
                f"--light ({self.light_name[:40]})",
                "ambient light has neither a direction nor a position",
                "name another light",
            )
        raise self._unknown("--light", self.light_name, [one.name for one in placed])

    def _unknown(self, option: str, name: str, names: list[str]) -> IllegalValueError:
        from nmatrix.scene.toml.table import suggestion

        what = option.removeprefix("--")
        listed = f"there are {', '.join(names[:8])}{', …' if len(names) > 8 else ''}"
        near = suggestion(name, names)
        return IllegalValueError(
            f"{option} ({name[:40]})",
            f"{self.scene_file} has no {what} of this name",
            listed if near.startswith("there are") else f"{near} {listed}",
        )

    def light_source(self, view: View, world: World) -> Light | None:
        """Return the chosen light in world space, whatever it is fixed to."""
        from nmatrix.scene.light import EYE, WORLD
        from nmatrix.scene.setup import Light

        light = self.chosen_light
        if self.scene is None or self.chosen_object is None or light is None:
            return None
        source = Light(
            light.direction if light.has_direction else None,
            position=light.position if light.has_position else None,
        )
        if light.fixed_to == WORLD:
            return source
        from nmatrix.linear.rational import inverse

        if light.fixed_to == EYE:
            return _carried(source, inverse(view.placed().camera_from_world))
        if light.fixed_to == self.chosen_object.name:
            return _carried(source, world.world_from_object)
        homes = {one.name: one.world_from_object for one in self.scene.objects}
        return _carried(source, homes[light.fixed_to])


def _carried(source: Light, world_from_home: RationalMatrix) -> Light:
    """Return a light in world space, exactly."""
    from nmatrix.linear.rational import ONE, ZERO, apply, rational_vector

    position, direction = source.position, source.direction
    if position is not None:
        position = apply(world_from_home, (*rational_vector(position), ONE))[:3]
    if direction is not None:
        direction = apply(world_from_home, (*rational_vector(direction), ZERO))[:3]
    return replace(source, direction=direction, position=position)
