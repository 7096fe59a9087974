"""Surfaces with one change each, for the study of what that change costs."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, Shading
from nmatrix.raster.planning.plan import Plan, everything
from nmatrix.raster.render import Change, render
from nmatrix.raster.shading.normals import angles_deg, unit
from nmatrix.raster.shading.surface import Surface
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.vertices import Projected

Array = NDArray[Any]


def as_it_is(surface: Surface) -> Surface:
    """Change nothing."""
    return surface


def with_effect(effect: Effect, *, on: bool) -> Change:
    """Return a change that turns one effect on or off, whatever the plan says."""

    def change(surface: Surface) -> Surface:
        effects = surface.effects | {effect} if on else surface.effects - {effect}
        return replace(surface, effects=effects)

    return change


class Float32Surface(Surface):
    """A surface whose attributes are float32 from the vertices to the light."""

    def vertex(self, projected: Projected) -> VertexOutputs:
        """Return the attributes rounded."""
        found = super().vertex(projected)
        points, directions, faces = (
            {name: one.astype(np.float32) for name, one in some.items()}
            for some in (found.points, found.directions, found.faces)
        )
        return replace(found, points=points, directions=directions, faces=faces)

    def fragment(self, fragments: Fragments) -> Array:
        """Return the colours of the fragments, their values rounded to float32."""
        kept = {name: one.astype(np.float32) for name, one in fragments.values.items()}
        return super().fragment(replace(fragments, values=kept))


class NormalSurface(Surface):
    """A surface that shows its unit normals in world space, from 0 to 1, in place of its light."""

    def fragment(self, fragments: Fragments) -> Array:
        """Return the normals as colours."""
        world = self.space.measure.normal_in_world(self._normals(fragments))
        return np.asarray(np.broadcast_to((world + 1.0) / 2.0, (3, len(fragments))))


class Float32NormalSurface(Float32Surface, NormalSurface):
    """A surface that shows its normals, from attributes that are float32."""


def in_float32(surface: Surface) -> Surface:
    """Round the attributes of a surface to float32."""
    return Float32Surface(**_fields(surface))


def normals_seen(plan: Plan, change: Change = as_it_is) -> Array:
    """Render the normals (height, width, 3) with one sample a pixel; 0 is background."""
    settings = replace(plan.loaded.settings, samples=1, background=(0.5, 0.5, 0.5))
    again = everything(replace(plan.loaded, settings=settings))
    colour = replace(again.picture[Effect.COLOUR], on=True)
    again = replace(again, picture={**again.picture, Effect.COLOUR: colour})
    return np.asarray(render(again, change=lambda one: _showing(change(one))).rgb * 2.0 - 1.0)


def normal_angles(plan: Plan, change: Change, wanted: Array) -> Array | None:
    """Return the angles in degrees between the normals of a plan and those that are wanted.

    None where light is not evaluated at fragments: then no normal reaches a pixel.
    """
    if plan.loaded.settings.shading is not Shading.PHONG:
        return None
    found = normals_seen(plan, change)
    both = (np.abs(found).max(axis=2) > 0) & (np.abs(wanted).max(axis=2) > 0)
    return angles_deg(unit(found[both]), unit(wanted[both]))


def _showing(surface: Surface) -> Surface:
    kind = Float32NormalSurface if isinstance(surface, Float32Surface) else NormalSurface
    return kind(**_fields(surface))


def _fields(surface: Surface) -> dict[str, Any]:
    """Return the fields of a surface by name."""
    return {name: getattr(surface, name) for name in Surface.__dataclass_fields__}
