"""The GLSL of a plan: for each body a program with just the terms that its plan has on."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from nmatrix.enums import Effect
from nmatrix.linear.projection import front_sign
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.plan import BodyPlan, Plan
from nmatrix.raster.shading.outline import OF_HULLS, thickness
from nmatrix.shaders.glsl import Glsl
from nmatrix.shaders.program import Program, program
from nmatrix.shaders.shaded import PLAIN_TARGET, SRGB_TARGET, FrontFace, Shaded, ShadowView


def program_of(plan: Plan, body: BodyPlan) -> Program:
    """Return the program that draws one body, with the values of all that it reads."""
    shaded = shaded_of(plan, body)
    return program(shaded, _lines(shaded))


def outline_of(plan: Plan, body: BodyPlan) -> Program | None:
    """Return the program that draws the outline of a body: its hull, black, before the fog."""
    if Effect.OUTLINE not in body.effects:
        return None
    drawn = shaded_of(plan, body)
    kept = drawn.effects & (OF_HULLS | plan.picture.keys())
    hull = replace(drawn, lights=(), effects=kept, swollen_by=thickness(body.body))
    return program(hull, _lines(hull))


def _lines(shaded: Shaded) -> Iterator[Glsl]:
    """Yield the lines of the effects, in the order of their table."""
    return (RECIPES[one].lines(shaded) for one in RECIPES if one in shaded.effects)


def shaded_of(plan: Plan, body: BodyPlan) -> Shaded:
    """Return what the shaders of one body draw."""
    loaded, settings = plan.loaded, plan.loaded.settings
    effects = body.effects | {effect for effect, one in plan.picture.items() if one.on}
    target = PLAIN_TARGET
    if {Effect.GAMMA, Effect.TRANSPARENCY} <= plan.effects:  # what is mixed must be linear light
        effects, target = effects - {Effect.GAMMA}, SRGB_TARGET
    return Shaded(
        loaded.maps(body.body),
        settings.space,
        settings.shading,
        body.body.material,
        body.lights,
        effects,
        FrontFace.of_sign(front_sign(loaded.clip_from_object(body.body), loaded.clip)),
        loaded.ambient_light,
        settings.fog,
        body.rule(settings.normals),
        _shadow_views(plan, body),
        body.body.sagitta if Effect.SHADOWS in body.effects else 0.0,
        has_zero_normals=body.body.mesh.degenerate_normals > 0,
        target=target,
        clip=loaded.clip,
        texture_has_alpha=body.body.texture_has_alpha,
        vertices_have_alpha=body.body.vertices_have_alpha,
    )


def _shadow_views(plan: Plan, body: BodyPlan) -> dict[str, tuple[ShadowView, ...]]:
    """Return the views of the shadow maps that a body reads, by the names of their lamps."""
    if Effect.SHADOWS not in body.effects:
        return {}
    casting = {placed.light.name for placed in body.lights if placed.light.shadows}
    return {
        name: tuple(ShadowView(one.light_from_world, one.slack) for one in views)
        for name, views in plan.light_views.items()
        if name in casting
    }
