"""The lights of a scene file: each kind has its own keys."""

from __future__ import annotations

from collections.abc import Collection
from dataclasses import replace
from math import inf

from nmatrix.linear.angle import Angle, direction_from_angles
from nmatrix.report import Vector
from nmatrix.scene.light import EYE, USUAL_DIRECTION, WORLD, SceneLight
from nmatrix.scene.material import colour
from nmatrix.scene.toml.records import LightRecord
from nmatrix.scene.toml.table import SceneTable, suggestion
from nmatrix.scene.words import LightKind

AHEAD: Vector = (0, 0, -1)  # in front of an eye
WIDEST = 90  # degrees

_EVERY = {"name", "kind", "color", "intensity"}
_PLACED = _EVERY | {"position", "attenuation", "range", "fixed_to", "shadows"}
_DIRECTED = {"direction", "angles"}
_KEYS = {
    LightKind.AMBIENT: _EVERY,
    LightKind.DIRECTIONAL: _EVERY | _DIRECTED | {"fixed_to", "shadows"},
    LightKind.POINT: _PLACED,
    LightKind.SPOT: _PLACED | _DIRECTED | {"cone"},
}


def read_lights(tables: list[SceneTable], homes: Collection[str]) -> tuple[SceneLight, ...]:
    """Return the lights in the file's order; `homes` are the objects they may follow.

    Raises
    ------
    IllegalValueError
        For a key that the kind does not have, one that it lacks, an unknown object, a name that
        is taken.
    """
    found: dict[str, SceneLight] = {}
    for index, table in enumerate(tables):
        light = _light(table, table.checked(LightRecord), index, homes)
        if light.name in found:
            raise table.fault("name", "another light has it already", "choose another")
        found[light.name] = light
    return tuple(found.values())


def _light(
    table: SceneTable, record: LightRecord, index: int, homes: Collection[str]
) -> SceneLight:
    _check_keys(table, record)
    if record.fixed_to not in (WORLD, EYE, *homes):
        near = suggestion(record.fixed_to, (WORLD, EYE, *homes))
        raise table.fault("fixed_to", "it is world, eye, or an object that is drawn", near)
    light = SceneLight(
        name=record.name or f"light {index + 1}",
        kind=record.kind,
        color=colour(record.color),
        intensity=record.intensity,
        fixed_to=record.fixed_to,
        shadows=record.shadows,
        attenuation=record.attenuation,
        range=inf if record.range is None else record.range,
        cone_degrees=_cone(table, record),
    )
    if light.has_position:
        light = replace(light, position=_position(table, record))
    return replace(light, direction=_direction(table, record)) if light.has_direction else light


def _check_keys(table: SceneTable, record: LightRecord) -> None:
    kind = record.kind
    for key in table.raw:
        if key not in _KEYS[kind]:
            fitting = [k.value for k, keys in _KEYS.items() if key in keys]
            raise table.fault(
                key, f"light of kind {kind} has no {key}", f"kind {' or '.join(fitting)} has"
            )
    if not any(record.attenuation):
        raise table.fault("attenuation", "c, l and q are all zero", "no attenuation is 1 0 0")


def _position(table: SceneTable, record: LightRecord) -> Vector:
    if record.position is not None:
        return record.position
    if record.fixed_to == WORLD:
        raise table.refused(
            "position", f"light of kind {record.kind} is somewhere", "add position = [x, y, z]"
        )
    return (0, 0, 0)


def _direction(table: SceneTable, record: LightRecord) -> Vector:
    if record.direction is not None and record.angles is not None:
        raise table.refused("direction with angles", "both are the direction", "keep one of them")
    if record.angles is not None:
        alpha, beta = map(Angle.degrees, record.angles)
        return direction_from_angles(alpha, beta)
    if record.direction is not None:
        if not any(record.direction):
            raise table.fault(
                "direction", "light that travels nowhere lights nothing", "try [-1, -1, -1]"
            )
        return record.direction
    if record.fixed_to == EYE:
        return AHEAD
    if record.kind is LightKind.SPOT:
        raise table.refused(
            "direction", "light of kind spot points somewhere", "add direction = [x, y, z]"
        )
    return USUAL_DIRECTION


def _cone(table: SceneTable, record: LightRecord) -> tuple[float, float]:
    if record.cone is None:
        return (20.0, 30.0)
    inner, outer = record.cone
    if not inner <= outer <= WIDEST or outer == 0:
        raise table.fault(
            "cone", "it is the inner and the outer half angle, at most 90 degrees", "try [20, 30]"
        )
    return record.cone
