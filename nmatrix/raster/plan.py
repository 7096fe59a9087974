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
from nmatrix.raster.decision import Decision
from nmatrix.raster.decisions import decide
from nmatrix.raster.effects import RECIPES, closure, per_sample
from nmatrix.raster.facts import Facts
from nmatrix.raster.lamps import why_dark
from nmatrix.raster.studio import Body, PlacedLamp, Studio
from nmatrix.scene.kinds import Sides

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
class LampDecision:
    """Whether a lamp lights a body, and why not if it does not."""

    placed: PlacedLamp
    on: bool
    because: str


@dataclass(frozen=True)
class BodyPlan:
    """What is computed for one body."""

    body: Body
    decisions: Mapping[Effect, Decision]
    lamp_decisions: tuple[LampDecision, ...]
    effects: frozenset[Effect]

    @property
    def lamps(self) -> tuple[PlacedLamp, ...]:
        """Return the lamps that are asked, ambient ones aside."""
        return tuple(one.placed for one in self.lamp_decisions if one.on)

    @property
    def bound(self) -> float:
        """Return how much all that is left out moves a channel at the most."""
        return sum(one.bound for one in self.decisions.values() if not one.on)


@dataclass(frozen=True)
class Plan:
    """What a picture of a studio computes."""

    studio: Studio
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


def plan_for(studio: Studio) -> Plan:
    """Return the plan that the studio's settings ask for."""
    return everything(studio) if studio.settings.effort is Effort.ALL else planned(studio)


def planned(studio: Studio) -> Plan:
    """Return the plan that computes only what the scene calls for."""
    return Plan(
        studio, tuple(_planned_body(studio, one) for one in studio.bodies), _picture(studio)
    )


def everything(studio: Studio) -> Plan:
    """Return the plan that takes no shortcut: what the scene names, and all that can be on."""
    bodies = []
    for body in studio.bodies:
        lamps = tuple(
            LampDecision(one, on=True, because="everything is on") for one in _lamps(studio)
        )
        facts = Facts(studio, body, tuple(one.placed for one in lamps))
        named = {effect for effect, one in decide(facts).items() if one.on}
        on = closure(_for_shading(named | _possible(body), studio))
        decisions = {
            one: Decision(one, on=one in on, because="everything is on") for one in RECIPES
        }
        bodies.append(BodyPlan(body, decisions, lamps, on))
    picture = {
        effect: replace(one, on=one.on or effect in SHORTCUTS)
        for effect, one in _picture(studio).items()
    }
    return Plan(studio, tuple(bodies), picture)


def _possible(body: Body) -> AbstractSet[Effect]:
    """Return the shortcuts that may be left untaken: what has no back shows none."""
    if body.material.sides is Sides.FRONT:
        return SHORTCUTS - {Effect.BACK_FACES}
    return SHORTCUTS


def _planned_body(studio: Studio, body: Body) -> BodyPlan:
    lamps = tuple(_lamp(studio, body, one) for one in _lamps(studio))
    facts = Facts(studio, body, tuple(one.placed for one in lamps if one.on))
    decisions = _within_budget(decide(facts), len(facts.lamps))
    on = closure(_for_shading({one for one, found in decisions.items() if found.on}, studio))
    for effect in NEEDED:
        users = [one.value for one in on if effect in RECIPES[one].needs]
        found = decisions.get(effect, Decision(effect, on=False, because="nothing needs it"))
        if effect in on and not found.on:
            found = Decision(effect, on=True, because=f"{', '.join(sorted(users))} needs it")
        decisions[effect] = found
    return BodyPlan(body, decisions, lamps, on)


def _for_shading(on: AbstractSet[Effect], studio: Studio) -> AbstractSet[Effect]:
    """Return effects without those that this shading evaluates at vertices, never at fragments."""
    if studio.settings.shading is Shading.PHONG:
        return on
    return on - {Effect.RENORMALISE, Effect.OUTLINE, Effect.NORMAL_MAP}


def _lamps(studio: Studio) -> tuple[PlacedLamp, ...]:
    return tuple(
        one for one in studio.lamps if one.position is not None or one.direction is not None
    )


def _lamp(studio: Studio, body: Body, placed: PlacedLamp) -> LampDecision:
    why = why_dark(studio, body, placed)
    return LampDecision(placed, on=why is None, because=why or "it can reach the body")


def _within_budget(decisions: dict[Effect, Decision], lamps: int) -> dict[Effect, Decision]:
    """Spend the budget where it saves most; what does not fit is computed after all."""
    proposed = [one for one in decisions.values() if not one.on and one.kind is LeftOut.BOUNDED]
    left = BUDGET
    for one in sorted(proposed, key=lambda one: one.bound / max(1, _saving(one.effect, lamps))):
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


def _saving(effect: Effect, lamps: int) -> int:
    return per_sample([effect], lamps) - per_sample([], lamps)


def _picture(studio: Studio) -> dict[Effect, Decision]:
    """Return the decisions that belong to the whole picture."""
    settings = studio.settings
    colours = [studio.settings.background, *(lamp.lamp.color for lamp in studio.lamps)]
    for body in studio.bodies:
        one = body.material
        colours += [one.ambient, one.diffuse, one.specular]
    if settings.fog:
        colours.append(settings.fog.color)
    images = [b.name for b in studio.bodies if b.material.texture not in (None, "checker")]
    images += [b.name for b in studio.bodies if b.material.vertex_colours]
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
