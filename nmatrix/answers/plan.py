"""`plan`: which effects a scene calls for, why, what each needs, and what was left out."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from nmatrix.enums import Effect, LeftOut
from nmatrix.errors import counted
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.effects import RECIPES
from nmatrix.raster.planning.glsl import outline_of, program_of
from nmatrix.raster.planning.plan import BodyPlan, Plan, planned
from nmatrix.raster.planning.recipe import BUDGET, Decision, not_asked
from nmatrix.report import (
    Block,
    Code,
    Heading,
    Report,
    Table,
    Text,
    Value,
    Verdict,
)
from nmatrix.scene.open import scene_of
from nmatrix.scene.words import LightKind
from nmatrix.shaders.program import Program

PASSES = "main"
NOTHING_SEEN = not_asked("no object can be seen")


def plan_of_file(path: Path, *, allow_outside: bool = False) -> Report:
    """Answer with the plan of a scene file, a glTF file or a mesh."""
    return plan(planned(loaded(scene_of(path, allow_outside=allow_outside))))


def plan(found: Plan) -> Report:
    """Answer with the plan of a scene, and the shaders of its first object.

    A row speaks for all bodies: an effect is on if one of them calls for it.
    """
    programs = [program_of(found, one) for one in found.drawn]
    outlines = [outline_of(found, one) for one in found.drawn]
    rows = [_row(effect, found) for effect in Effect]
    rows += [_light_row(i, found) for i in range(len(found.loaded.lights))]
    rows += [_unseen_row(one) for one in found.bodies if one.why_unseen is not None]
    on = [effect for effect in Effect if effect in found.effects]
    data: dict[str, Value] = {
        "effects": rows,
        "attributes": _needs(on, "attributes", ("position", "normal")),
        "passes": _needs(on, "passes", (PASSES,)),
        "objects": [_body(*one) for one in zip(found.drawn, programs, outlines, strict=True)],
    }
    blocks: tuple[Block, ...] = (
        Heading(
            f"{counted(len(found.bodies), 'object')}, {counted(len(found.loaded.lights), 'light')}"
        ),
        _table("Called for", rows, on=True),
        _table("Left out", rows, on=False),
        Verdict(_sentence(found)),
        *_first_shaders(found, programs),
    )
    return Report("plan", data, blocks, found.remarks)


def _first_shaders(found: Plan, programs: Sequence[Program]) -> tuple[Block, ...]:
    if not programs:
        return ()
    first = programs[0]
    return (
        Text(
            f"The shaders of {found.drawn[0].body.name}, with just the terms of its plan "
            "(-f glsl prints those of every object, and what their uniforms hold):"
        ),
        Code("glsl", first.vertex_shader, "vertex shader"),
        Code("glsl", first.fragment_shader, "fragment shader"),
    )


def _row(effect: Effect, found: Plan) -> dict[str, Value]:
    """Sum up one effect's decisions over all bodies."""
    decisions = _decisions(effect, found)
    on = [one for one in decisions if one.on]
    chosen = on[0] if on else max(decisions, key=lambda one: one.bound)
    because = chosen.because
    if on and len(decisions) > 1:
        because = f"{len(on)} of {len(decisions)} objects: {because}"
    return {
        "name": effect.value,
        "on": bool(on),
        "because": because,
        "kind": chosen.kind.value,
        "bound": max((one.bound for one in decisions if not one.on), default=0.0),
        "needs": _needed(effect),
    }


def _decisions(effect: Effect, found: Plan) -> list[Decision]:
    if effect in found.picture:
        return [found.picture[effect]]
    return [one.decisions[effect] for one in found.drawn] or [NOTHING_SEEN]


def _light_row(i: int, found: Plan) -> dict[str, Value]:
    """Sum up which bodies a light can reach."""
    placed = found.loaded.lights[i]
    decisions = [
        one for body in found.bodies for one in body.light_decisions if one.placed is placed
    ]
    on = [one for one in decisions if one.on]
    off = max(decisions, key=lambda one: (not one.on, one.bound), default=None)
    because = f"it can reach {len(on)} of {len(decisions)} objects"
    if placed.light.kind is LightKind.AMBIENT:
        because = "it comes from everywhere"
    elif off is None:
        because = "no object can be seen"
    elif not on:
        because = f"it {off.because}"
    return {
        "name": f"light {placed.light.name}",
        "on": bool(on) or placed.light.kind is LightKind.AMBIENT,
        "because": because,
        "kind": LeftOut.EXACT.value if off is None or on else off.kind.value,
        "bound": max((one.bound for one in decisions), default=0.0),
        "needs": ["position"] if placed.position is not None else [],
    }


def _unseen_row(one: BodyPlan) -> dict[str, Value]:
    """Say why an object cannot be seen."""
    return {
        "name": f"object {one.body.name}",
        "on": False,
        "because": f"it {one.why_unseen}",
        "kind": LeftOut.EXACT.value,
        "bound": 0.0,
        "needs": [],
    }


def _needed(effect: Effect) -> list[Value]:
    recipe = RECIPES[effect]
    needs = (one.value for one in recipe.needs)
    return [*needs, *recipe.attributes, *recipe.passes]


def _needs(on: list[Effect], what: str, always: tuple[str, ...]) -> list[Value]:
    named = (name for effect in on for name in getattr(RECIPES[effect], what))
    return list(dict.fromkeys((*always, *named)))


def _body(one: BodyPlan, drawn_by: Program, outlined_by: Program | None) -> dict[str, Value]:
    return {
        "name": one.body.name,
        **drawn_by.data,
        "outline": None if outlined_by is None else outlined_by.data,
        "effects": [effect.value for effect in Effect if effect in one.effects],
        "lights": [placed.light.name for placed in one.lights],
        "bound": one.bound,
    }


def _table(title: str, rows: list[dict[str, Value]], *, on: bool) -> Table:
    cells = tuple(
        (str(row["name"]), str(row["because"]), "" if on else _safety(row))
        for row in rows
        if row["on"] is on
    )
    return Table(("effect", "because", "" if on else "how safe"), cells, title)


def _safety(row: dict[str, Value]) -> str:
    bound = row["bound"]
    if not isinstance(bound, float) or not bound:
        return str(row["kind"])
    return f"{row['kind']}, ≤ {bound * 255:.2g} levels"


def _sentence(found: Plan) -> str:
    total = len(Effect)
    on = len(found.effects)
    worst = max((one.bound for one in found.bodies), default=0.0)
    return (
        f"{on} of {total} effects are called for; what is left out moves no channel by more than "
        f"{worst * 255:.2g} of the {BUDGET * 255:g} levels allowed."
    )
