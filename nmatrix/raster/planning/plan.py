"""The plan: which effects a scene calls for, body by body, and what each of them needs.

What is left out with a bound shares one budget of half a level, spent where it saves most. A sample
is a mixture of bodies, so each body has the whole budget to itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import cached_property

from nmatrix.enums import Effect, Effort, LeftOut, Shading
from nmatrix.raster.loaded_scene import Body, LoadedScene, PlacedLight
from nmatrix.raster.planning.culled_lights import why_dark
from nmatrix.raster.planning.decision import Decision
from nmatrix.raster.planning.effects import RECIPES, closure, per_sample
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.judges import decide
from nmatrix.scene.words import Sides

BUDGET = 0.5 / 255
NEEDED = (Effect.POSITION, Effect.EYE)  # on when something else reads them

# Shortcuts that everything-on does without; other effects exist only where the scene names them.
SHORTCUTS = frozenset(
    {
        Effect.AMBIENT,
        Effect.DIFFUSE,
        Effect.INVERSE_TRANSPOSE,
        Effect.METRIC,
        Effect.POSITION,
        Effect.EYE,
        Effect.SPECULAR,
        Effect.ATTENUATION,
        Effect.RENORMALISE,
        Effect.PERSPECTIVE,
        Effect.EXACT_WEIGHTS,
        Effect.NEAR_CLIP,
        Effect.BACK_FACES,
        Effect.COLOUR,
    }
)


@dataclass(frozen=True)
class LightDecision:
    """Whether a light lights a body, and why not if it does not."""

    placed: PlacedLight
    on: bool
    because: str


@dataclass(frozen=True)
class BodyPlan:
    """What is computed for one body."""

    body: Body
    decisions: Mapping[Effect, Decision]
    light_decisions: tuple[LightDecision, ...]
    effects: frozenset[Effect]

    @property
    def lights(self) -> tuple[PlacedLight, ...]:
        """Return the lights that are asked, ambient ones aside."""
        return tuple(one.placed for one in self.light_decisions if one.on)

    @property
    def bound(self) -> float:
        """Return how much all that is left out moves a channel at the most."""
        return sum(one.bound for one in self.decisions.values() if not one.on)


@dataclass(frozen=True)
class Plan:
    """What a picture of a loaded scene computes."""

    loaded: LoadedScene
    bodies: tuple[BodyPlan, ...]
    picture: Mapping[Effect, Decision]

    @property
    def channels(self) -> int:
        """Return 1 where everything is grey, else 3."""
        return 3 if self.picture[Effect.COLOUR].on else 1

    @cached_property
    def effects(self) -> frozenset[Effect]:
        """Return everything that is on anywhere."""
        on = {effect for effect, one in self.picture.items() if one.on}
        return frozenset(on.union(*(body.effects for body in self.bodies)))


def plan_for(loaded: LoadedScene) -> Plan:
    """Return the plan that the loaded scene's settings ask for."""
    return everything(loaded) if loaded.settings.effort is Effort.ALL else planned(loaded)


def planned(loaded: LoadedScene) -> Plan:
    """Return the plan that computes only what the scene calls for."""
    return Plan(
        loaded, tuple(_planned_body(loaded, one) for one in loaded.bodies), _picture(loaded)
    )


def everything(loaded: LoadedScene) -> Plan:
    """Return the plan that takes no shortcut: what the scene names, and all that can be on."""
    bodies = []
    for body in loaded.bodies:
        lights = tuple(
            LightDecision(one, on=True, because="everything is on") for one in _lights(loaded)
        )
        facts = Facts(loaded, body, tuple(one.placed for one in lights))
        named = {effect for effect, one in decide(facts).items() if one.on}
        on = closure(_for_shading(named | _possible(body), loaded))
        decisions = {
            one: Decision(one, on=one in on, because="everything is on") for one in RECIPES
        }
        bodies.append(BodyPlan(body, decisions, lights, on))
    picture = {
        effect: replace(one, on=one.on or effect in SHORTCUTS)
        for effect, one in _picture(loaded).items()
    }
    return Plan(loaded, tuple(bodies), picture)


def _possible(body: Body) -> AbstractSet[Effect]:
    """Return the shortcuts that may be left untaken: what has no back shows none."""
    if body.material.sides is Sides.FRONT:
        return SHORTCUTS - {Effect.BACK_FACES}
    return SHORTCUTS


def _planned_body(loaded: LoadedScene, body: Body) -> BodyPlan:
    lights = tuple(_light(loaded, body, one) for one in _lights(loaded))
    facts = Facts(loaded, body, tuple(one.placed for one in lights if one.on))
    decisions = _within_budget(decide(facts), len(facts.lights))
    on = closure(_for_shading({one for one, found in decisions.items() if found.on}, loaded))
    for effect in NEEDED:
        users = [one.value for one in on if effect in RECIPES[one].needs]
        found = decisions.get(effect, Decision(effect, on=False, because="nothing needs it"))
        if effect in on and not found.on:
            found = Decision(effect, on=True, because=f"{', '.join(sorted(users))} needs it")
        decisions[effect] = found
    return BodyPlan(body, decisions, lights, on)


def _for_shading(on: AbstractSet[Effect], loaded: LoadedScene) -> AbstractSet[Effect]:
    """Return effects without those that this shading evaluates at vertices, never at fragments."""
    if loaded.settings.shading is Shading.PHONG:
        return on
    return on - {Effect.RENORMALISE, Effect.OUTLINE, Effect.NORMAL_MAP}


def _lights(loaded: LoadedScene) -> tuple[PlacedLight, ...]:
    return tuple(
        one for one in loaded.lights if one.position is not None or one.direction is not None
    )


def _light(loaded: LoadedScene, body: Body, placed: PlacedLight) -> LightDecision:
    why = why_dark(loaded, body, placed)
    return LightDecision(placed, on=why is None, because=why or "it can reach the body")


def _within_budget(decisions: dict[Effect, Decision], lights: int) -> dict[Effect, Decision]:
    """Spend the budget where it saves most; what does not fit is computed after all."""
    proposed = [one for one in decisions.values() if not one.on and one.kind is LeftOut.BOUNDED]
    left = BUDGET
    for one in sorted(proposed, key=lambda one: one.bound / max(1, _saving(one.effect, lights))):
        if one.bound <= left:
            left -= one.bound
        else:
            decisions[one.effect] = replace(
                one,
                on=True,
                because=f"{one.because}; "
                f"it could move a channel by {one.bound * 255:.2g} of 255 levels",
                bound=0.0,
            )
    return decisions


def _saving(effect: Effect, lights: int) -> int:
    return per_sample([effect], lights) - per_sample([], lights)


def _picture(loaded: LoadedScene) -> dict[Effect, Decision]:
    """Return the decisions that belong to the whole picture."""
    settings = loaded.settings
    colours = [loaded.settings.background, *(light.light.color for light in loaded.lights)]
    for body in loaded.bodies:
        one = body.material
        colours += [one.ambient, one.diffuse, one.specular]
    if settings.fog:
        colours.append(settings.fog.color)
    images = [b.name for b in loaded.bodies if b.material.texture not in (None, "checker")]
    images += [b.name for b in loaded.bodies if b.material.vertex_colours]
    tinted = bool(images) or any(len(set(colour)) > 1 for colour in colours)
    per_pixel = settings.samples
    found = (
        (Effect.COLOUR, tinted, "something has a colour" if tinted else "everything is grey"),
        (
            Effect.GAMMA,
            settings.gamma,
            "the scene asks for sRGB" if settings.gamma else "levels are linear",
        ),
        (Effect.SUPERSAMPLING, per_pixel > 1, f"{per_pixel} samples in a pixel"),
    )
    return {effect: Decision(effect, on, because) for effect, on, because in found}
