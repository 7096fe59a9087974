"""The plan: which effects a scene calls for, body by body, and what each of them needs.

What is left out with a bound shares one budget of half a level, spent where it saves most. A sample
is a mixture of bodies, so each body has the whole budget to itself.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import cached_property

from nmatrix.enums import Effect, Effort, LeftOut, NormalRule
from nmatrix.errors import printable, shortlist
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.culled_lights import why_dark
from nmatrix.raster.planning.effects import RECIPES, closure, per_sample
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.recipe import Decision
from nmatrix.raster.planning.shadow_casting import light_views, shadow_remarks
from nmatrix.raster.shading.shadow import LightView
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import DEFAULT_MATERIAL
from nmatrix.scene.words import Sides

BUDGET = 0.5 / 255
MOST_NAMED = 4  # bodies that a remark names


@dataclass(frozen=True)
class LightDecision:
    """The decision on a light of a body, and the reason if it is left out."""

    placed: PlacedLight
    on: bool
    because: str


@dataclass(frozen=True)
class BodyPlan:
    """The effects and the lights that are computed for one body.

    `ineffective` holds the settings of its material that change nothing here, and why.
    """

    body: Body
    decisions: Mapping[Effect, Decision]
    light_decisions: tuple[LightDecision, ...]
    effects: frozenset[Effect]
    ineffective: Mapping[str, str]

    @property
    def lights(self) -> tuple[PlacedLight, ...]:
        """Return the lights that light this body, ambient ones aside."""
        return tuple(one.placed for one in self.light_decisions if one.on)

    @property
    def bound(self) -> float:
        """Return the most that all that is left out moves a channel."""
        return sum(one.bound for one in self.decisions.values() if not one.on)

    def rule(self, wanted: NormalRule) -> NormalRule:
        """Return the rule that carries normals: the matrix itself where that is right."""
        if wanted is NormalRule.EXACT and Effect.INVERSE_TRANSPOSE not in self.effects:
            return NormalRule.NONE
        return wanted


@dataclass(frozen=True)
class Plan:
    """The plans of the bodies of a loaded scene, and the effects of the whole picture."""

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

    @cached_property
    def light_views(self) -> Mapping[str, tuple[LightView, ...]]:
        """Return the views for shadow maps, by the names of the lamps that have any."""
        found = {
            placed.light.name: light_views(
                self.loaded, placed, [one.body for one in lit if Effect.SHADOWS in one.effects]
            )
            for placed, lit in self._lit_by_casting_lamps.items()
        }
        return {name: views for name, views in found.items() if views}

    @property
    def _lit_by_casting_lamps(self) -> Mapping[PlacedLight, Sequence[BodyPlan]]:
        """Return the lamps that cast shadows, and the bodies that each can light."""
        lit: dict[PlacedLight, list[BodyPlan]] = {}
        for one in self.bodies:
            for placed in one.lights:
                if placed.light.shadows:
                    lit.setdefault(placed, []).append(one)
        return lit

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """The scene's remarks, what a setting says in vain, and shadows coarse or not cast."""
        found = [
            remark
            for placed, lit in self._lit_by_casting_lamps.items()
            for remark in shadow_remarks(
                self.loaded,
                placed,
                [one.body for one in lit],
                self.light_views.get(placed.light.name, ()),
            )
        ]
        return (*self.loaded.remarks, *self._said_in_vain(), *dict.fromkeys(found))

    def _said_in_vain(self) -> Iterator[str]:
        """Yield a sentence for all that a setting of a material does not change."""
        bodies: dict[tuple[str, str, str], list[str]] = {}
        for one in self.bodies:
            for setting, because in one.ineffective.items():
                names = bodies.setdefault((setting, one.body.material.name, because), [])
                names.append(one.body.name)
        for (setting, material, because), names in bodies.items():
            yield (
                f"{setting} of material {printable(material)} changes nothing on "
                f"{shortlist(dict.fromkeys(map(printable, names)), MOST_NAMED)}: {because}."
            )


def plan_for(loaded: LoadedScene) -> Plan:
    """Return the plan that the loaded scene's settings ask for."""
    return everything(loaded) if loaded.settings.effort is Effort.ALL else planned(loaded)


def planned(loaded: LoadedScene) -> Plan:
    """Return the plan that computes only what the scene calls for."""
    facts = [_facts_under_reaching_lights(loaded, one) for one in loaded.bodies]
    bodies = tuple(_planned_body(*one) for one in facts)
    return Plan(loaded, bodies, _picture(loaded, [one for one, _ in facts]))


def everything(loaded: LoadedScene) -> Plan:
    """Return the plan that takes no shortcut: what the scene names, and all that can be on."""
    lights = tuple(
        LightDecision(one, on=True, because="everything is on") for one in _lights(loaded)
    )
    facts = [Facts(loaded, body, _lights(loaded), RECIPES) for body in loaded.bodies]
    bodies = tuple(_full_body(one, lights) for one in facts)
    picture = {
        effect: replace(one, on=one.on or RECIPES[effect].is_shortcut)
        for effect, one in _picture(loaded, facts).items()
    }
    return Plan(loaded, bodies, picture)


def _full_body(facts: Facts, lights: tuple[LightDecision, ...]) -> BodyPlan:
    named = {effect for effect, one in facts.decisions.items() if one.on}
    on = closure(_for_shading(named | _shortcuts(facts.body), facts))
    decisions = {one: Decision(on=one in on, because="everything is on") for one in RECIPES}
    return BodyPlan(facts.body, decisions, lights, on, _ineffective(facts))


def _ineffective(facts: Facts) -> dict[str, str]:
    """Return the settings of a material, other than the default, that no effect on here reads."""
    return {
        setting: one.because
        for effect, one in facts.decisions.items()
        for setting in RECIPES[effect].settings
        if not one.on and getattr(facts.material, setting) != getattr(DEFAULT_MATERIAL, setting)
    }


def _shortcuts(body: Body) -> AbstractSet[Effect]:
    """Return the shortcuts that apply to a body: one that has a front alone shows no back."""
    found = {effect for effect, one in RECIPES.items() if one.is_shortcut}
    return found - {Effect.BACK_FACES} if body.material.sides is Sides.FRONT else found


def _facts_under_reaching_lights(
    loaded: LoadedScene, body: Body
) -> tuple[Facts, tuple[LightDecision, ...]]:
    """Decide which lights can light a body, and return the facts that are left under those."""
    under_all = Facts(loaded, body, _lights(loaded), RECIPES)
    lights = tuple(_light(under_all, one) for one in under_all.lights)
    return replace(under_all, lights=tuple(one.placed for one in lights if one.on)), lights


def _light(facts: Facts, placed: PlacedLight) -> LightDecision:
    why = why_dark(facts, placed)
    return LightDecision(placed, on=why is None, because=why or "it can reach the body")


def _planned_body(facts: Facts, lights: tuple[LightDecision, ...]) -> BodyPlan:
    decisions = _within_budget(facts.decisions, len(facts.lights))
    on = closure(_for_shading({one for one, found in decisions.items() if found.on}, facts))
    for effect in _read_by_others():
        users = [one.value for one in on if effect in RECIPES[one].needs]
        found = decisions.get(effect, Decision(on=False, because="nothing needs it"))
        if effect in on and not found.on:
            found = Decision(on=True, because=f"{', '.join(sorted(users))} needs it")
        decisions[effect] = found
    return BodyPlan(facts.body, decisions, lights, on, _ineffective(facts))


def _read_by_others() -> list[Effect]:
    """Return the effects that others need, in the order of the table."""
    needed = {need for one in RECIPES.values() for need in one.needs}
    return [effect for effect in RECIPES if effect in needed]


def _for_shading(on: AbstractSet[Effect], facts: Facts) -> AbstractSet[Effect]:
    """Return effects without those that work at fragments alone, where light is not evaluated."""
    if facts.is_lit_at_fragments:
        return on
    return {effect for effect in on if not RECIPES[effect].only_at_fragments}


def _lights(loaded: LoadedScene) -> tuple[PlacedLight, ...]:
    return tuple(
        one for one in loaded.lights if one.position is not None or one.direction is not None
    )


def _within_budget(asked: Mapping[Effect, Decision], lights: int) -> dict[Effect, Decision]:
    """Spend the budget where it saves most; what does not fit is computed after all."""
    decisions = dict(asked)
    proposed = [
        effect for effect, one in decisions.items() if not one.on and one.kind is LeftOut.BOUNDED
    ]
    left = BUDGET
    for effect in sorted(proposed, key=lambda it: asked[it].bound / max(1, _saving(it, lights))):
        one = decisions[effect]
        if one.bound <= left:
            left -= one.bound
            continue
        because = f"{one.because}; it could move a channel by {one.bound * 255:.2g} of 255 levels"
        decisions[effect] = replace(one, on=True, because=because, bound=0.0)
    return decisions


def _saving(effect: Effect, lights: int) -> int:
    return per_sample([effect], lights) - per_sample([], lights)


def _picture(loaded: LoadedScene, bodies: Sequence[Facts]) -> dict[Effect, Decision]:
    """Return the decisions that belong to the whole picture."""
    return {
        effect: recipe.picture_judge(loaded, bodies)
        for effect, recipe in RECIPES.items()
        if recipe.picture_judge is not None
    }
