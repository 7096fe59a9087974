"""The plan: which effects a scene calls for, body by body, and what each of them needs.

What is left out with a bound shares one budget of half a level, spent where it saves most. A sample
is a mixture of bodies, so each body has the whole budget to itself. Lights come first: each costs
more than any effect saves.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from collections.abc import Set as AbstractSet
from dataclasses import dataclass, replace
from functools import cached_property

from nmatrix.enums import Effect, Effort, LeftOut, NormalRule
from nmatrix.errors import printable, shortlist
from nmatrix.raster.loaded_scene import Body, LoadedScene
from nmatrix.raster.planning.culled_lights import why_dark
from nmatrix.raster.planning.effects import RECIPES, closure, of_effect
from nmatrix.raster.planning.facts import Facts
from nmatrix.raster.planning.recipe import BUDGET, Decision, too_dear
from nmatrix.raster.planning.seen_body import SeenBody
from nmatrix.raster.planning.shading_rate import ShadingRate, shading_rate
from nmatrix.raster.planning.shadow_casting import light_views, shadow_remarks
from nmatrix.raster.shading.shadow import LightView
from nmatrix.scene.light import PlacedLight
from nmatrix.scene.material import BLACK, DEFAULT_MATERIAL
from nmatrix.scene.meshes.shell import Shell
from nmatrix.scene.words import Sides

MOST_NAMED = 4  # bodies that a remark names


@dataclass(frozen=True)
class LightDecision:
    """The decision on a light of a body: why, and the most that leaving it out moves a channel."""

    placed: PlacedLight
    on: bool
    because: str
    bound: float = 0.0

    @property
    def kind(self) -> LeftOut:
        """How safely the light is left out."""
        return LeftOut.BOUNDED if self.bound else LeftOut.EXACT


@dataclass(frozen=True)
class BodyPlan:
    """The effects and the lights that are computed for one body: none if it cannot be seen.

    `ineffective` holds the settings of its material that change nothing here, and why.
    """

    seen: SeenBody
    decisions: Mapping[Effect, Decision]
    light_decisions: tuple[LightDecision, ...]
    effects: frozenset[Effect]
    ineffective: Mapping[str, str]
    why_unseen: str | None = None
    rate: ShadingRate | None = None

    @property
    def body(self) -> Body:
        """The body."""
        return self.seen.body

    @property
    def lights(self) -> tuple[PlacedLight, ...]:
        """The lights that light this body, ambient ones aside."""
        return tuple(one.placed for one in self.light_decisions if one.on)

    @property
    def bound(self) -> float:
        """The most that all that is left out moves a channel."""
        effects = sum(one.bound for one in self.decisions.values() if not one.on)
        return effects + sum(one.bound for one in self.light_decisions)

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
    def drawn(self) -> tuple[BodyPlan, ...]:
        """The plans of the bodies that some sample of the picture may show."""
        return tuple(one for one in self.bodies if one.why_unseen is None)

    @property
    def channels(self) -> int:
        """1 where everything is grey, else 3."""
        return 3 if self.picture[Effect.COLOUR].on else 1

    @cached_property
    def effects(self) -> frozenset[Effect]:
        """Everything that is on anywhere."""
        on = {effect for effect, one in self.picture.items() if one.on}
        return frozenset(on.union(*(body.effects for body in self.bodies)))

    @cached_property
    def light_views(self) -> Mapping[str, tuple[LightView, ...]]:
        """The views for shadow maps, by the names of the lamps that have any.

        They are fitted to all bodies that anything can shade, whatever else is left out: so one
        scene has one set of maps.
        """
        found = {}
        for placed, lit in self._lit_by_casting_lamps.items():
            if any(Effect.SHADOWS in one.effects for one in lit):
                casters = {one.body: one.seen.casters(placed) for one in self.bodies}
                casting = {body: some for body, some in casters.items() if some}
                found[placed.light.name] = light_views(self.loaded, placed, casting)
        return {name: views for name, views in found.items() if views}

    @property
    def _lit_by_casting_lamps(self) -> Mapping[PlacedLight, Sequence[BodyPlan]]:
        """Return the lamps that cast shadows, and the bodies that each can light."""
        lit: dict[PlacedLight, list[BodyPlan]] = {}
        for one in self.drawn:
            for placed in one.lights:
                if placed.light.shadows:
                    lit.setdefault(placed, []).append(one)
        return lit

    @cached_property
    def remarks(self) -> tuple[str, ...]:
        """What a reader should know: of the scene, of meshes that are inside out, of no picture."""
        found = [*self.loaded.remarks]
        found += [
            f"{one.body.name} is inside out: its triangles are turned inwards, so its fronts face "
            "away; turn their winding around in the program that made the mesh."
            for one in self.bodies
            if Effect.BACK_FACES in one.effects and one.body.mesh.shell is Shell.INSIDE_OUT
        ]
        for placed, lit in self._lit_by_casting_lamps.items():
            views = self.light_views.get(placed.light.name, ())
            found += shadow_remarks(self.loaded, placed, [one.body for one in lit], views)
        found += self._said_in_vain()
        if not self.drawn:
            reasons = [(one.body.name, one.why_unseen or "") for one in self.bodies[:3]]
            found.append(nothing_seen(reasons))
        return tuple(dict.fromkeys(found))

    def _said_in_vain(self) -> list[str]:
        """Say which settings of materials change nothing, on which objects, and why."""
        bodies: dict[tuple[str, str, str], list[str]] = {}
        for one in self.bodies:
            for setting, because in one.ineffective.items():
                names = bodies.setdefault((setting, one.body.material.name, because), [])
                names.append(one.body.name)
        return [
            f"{setting} of material {printable(material)} changes nothing on "
            f"{shortlist(dict.fromkeys(map(printable, names)), MOST_NAMED)}: {because}."
            for (setting, material, because), names in bodies.items()
        ]


def nothing_seen(reasons: Sequence[tuple[str, str]]) -> str:
    """Say that a picture is empty, and why, object by object."""
    told = (f"{printable(name)} {why}" for name, why in reasons)
    return f"Nothing can be seen: {'; '.join(told)}."


def plan_for(loaded: LoadedScene) -> Plan:
    """Make the plan that the loaded scene's settings ask for."""
    return everything(loaded) if loaded.settings.effort is Effort.ALL else planned(loaded)


def planned(loaded: LoadedScene) -> Plan:
    """Make the plan that computes only what the scene calls for."""
    found = [_planned_body(SeenBody(loaded, one)) for one in loaded.bodies]
    return Plan(
        loaded,
        tuple(plan for plan, _ in found),
        _picture(loaded, [facts for plan, facts in found if plan.why_unseen is None]),
    )


def everything(loaded: LoadedScene) -> Plan:
    """Make the plan that takes no shortcut: what the scene names, and all that can be on."""
    lamps = _lamps(loaded)
    lights = tuple(LightDecision(one, on=True, because="everything is on") for one in lamps)
    facts = [Facts(SeenBody(loaded, body), lamps, RECIPES) for body in loaded.bodies]
    bodies = tuple(_full_body(one, lights) for one in facts)
    picture = {
        effect: replace(one, on=one.on or RECIPES[effect].is_shortcut)
        for effect, one in _picture(loaded, facts).items()
    }
    return Plan(loaded, bodies, picture)


def _full_body(facts: Facts, lights: tuple[LightDecision, ...]) -> BodyPlan:
    decided = facts.decisions.items()
    named = {effect for effect, one in decided if one.on or (one.is_asked and one.is_possible)}
    on = closure(_for_shading(named | _shortcuts(facts.body), facts))
    decisions = {one: Decision(on=one in on, because="everything is on") for one in RECIPES}
    return BodyPlan(facts.seen, decisions, lights, on, _ineffective(facts))


def _ineffective(facts: Facts) -> dict[str, str]:
    """Find the settings of a material, other than the default, that no effect on here reads.

    Black asks for nothing.
    """
    return {
        setting: one.because
        for effect, one in facts.decisions.items()
        for setting in RECIPES[effect].settings
        if not one.on
        and getattr(facts.material, setting) not in (getattr(DEFAULT_MATERIAL, setting), BLACK)
    }


def _shortcuts(body: Body) -> AbstractSet[Effect]:
    """Find the shortcuts that apply to a body: one that has a front alone shows no back."""
    found = {effect for effect, one in RECIPES.items() if one.is_shortcut}
    return found - {Effect.BACK_FACES} if body.material.sides is Sides.FRONT else found


def _facts_under_needed_lights(seen: SeenBody) -> tuple[Facts, tuple[LightDecision, ...]]:
    """Decide which lights a body needs, and find the facts that are left under those."""
    under_all = Facts(seen, _lamps(seen.loaded), RECIPES)
    lights = _without_weak_lights(under_all, [_light(under_all, one) for one in under_all.lights])
    lit_by = tuple(one.placed for one in lights if one.on)
    return replace(under_all, lights=lit_by), lights


def _light(facts: Facts, placed: PlacedLight) -> LightDecision:
    why = why_dark(facts, placed)
    return LightDecision(placed, on=why is None, because=why or "it can reach the body")


def _without_weak_lights(facts: Facts, asked: Sequence[LightDecision]) -> tuple[LightDecision, ...]:
    """Leave out the weakest lights first, as long as all of them together stay in the budget."""
    found = list(asked)
    bounds = {i: facts.max_change_without(one.placed) for i, one in enumerate(asked) if one.on}
    left = BUDGET
    for i in sorted(bounds, key=bounds.__getitem__):
        left -= bounds[i]
        if left < 0:
            break
        because = f"adds {bounds[i] * 255:.2g} of 255 levels at the most"
        found[i] = LightDecision(asked[i].placed, on=False, because=because, bound=bounds[i])
    return tuple(found)


def _planned_body(seen: SeenBody) -> tuple[BodyPlan, Facts]:
    """Plan one body, and return the facts under the lights that it needs."""
    if seen.why_unseen is not None:
        unlit = Facts(seen, (), RECIPES)
        return BodyPlan(seen, {}, (), frozenset(), {}, seen.why_unseen), unlit
    facts, lights = _facts_under_needed_lights(seen)
    spent = sum(one.bound for one in lights)
    decisions = _within_budget(facts.decisions, len(facts.lights), BUDGET - spent)
    on = closure(_for_shading({one for one, found in decisions.items() if found.on}, facts))
    for effect in _read_by_others():
        users = [one.value for one in on if effect in RECIPES[one].needs]
        found = decisions.get(effect, Decision(on=False, because="nothing needs it"))
        if effect in on and not found.on:
            found = Decision(on=True, because=f"{', '.join(sorted(users))} needs it")
        decisions[effect] = found
    rate = None if Effect.SAMPLE_SHADING in on else shading_rate(facts)
    once = rate if isinstance(rate, ShadingRate) else None
    return BodyPlan(seen, decisions, lights, on, _ineffective(facts), rate=once), facts


def _read_by_others() -> list[Effect]:
    """Return the effects that others need, in the order of the table."""
    needed = {need for one in RECIPES.values() for need in one.needs}
    return [effect for effect in RECIPES if effect in needed]


def _for_shading(on: AbstractSet[Effect], facts: Facts) -> AbstractSet[Effect]:
    """Return effects without those that work at fragments alone, where light is not evaluated."""
    if facts.is_lit_at_fragments:
        return on
    return {effect for effect in on if not RECIPES[effect].only_at_fragments}


def _lamps(loaded: LoadedScene) -> tuple[PlacedLight, ...]:
    return tuple(
        one for one in loaded.lights if one.position is not None or one.direction is not None
    )


def _within_budget(
    asked: Mapping[Effect, Decision], lights: int, budget: float
) -> dict[Effect, Decision]:
    """Spend the budget where it saves most; what does not fit is computed after all."""
    decisions = dict(asked)
    proposed = [
        effect for effect, one in decisions.items() if not one.on and one.kind is LeftOut.BOUNDED
    ]
    left = budget
    for effect in sorted(proposed, key=lambda it: asked[it].bound / max(1, of_effect(it, lights))):
        one = decisions[effect]
        if one.bound <= left:
            left -= one.bound
            continue
        because = too_dear(one.because, one.bound)
        decisions[effect] = replace(one, on=True, because=because, bound=0.0)
    return decisions


def _picture(loaded: LoadedScene, bodies: Sequence[Facts]) -> dict[Effect, Decision]:
    """Return the decisions that belong to the whole picture."""
    return {
        effect: recipe.picture_judge(loaded, bodies)
        for effect, recipe in RECIPES.items()
        if recipe.picture_judge is not None
    }
