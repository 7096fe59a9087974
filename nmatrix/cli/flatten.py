"""Option groups as frozen dataclasses: a command takes groups, Typer sees the flat options."""

from __future__ import annotations

import inspect
from collections.abc import Callable
from dataclasses import fields, is_dataclass
from functools import wraps
from typing import Any, get_type_hints

Group = Any  # a frozen dataclass type; its fields are Typer's options


def flattened(command: Callable[..., None]) -> Callable[..., None]:
    """Return the command with every parameter that is a dataclass replaced by its fields.

    A field that two groups share, such as `handed`, becomes one option and reaches both.
    """
    hints = get_type_hints(command, include_extras=True)
    hints.pop("return", None)
    groups: dict[str, Group] = {name: kind for name, kind in hints.items() if is_dataclass(kind)}
    parameters: dict[str, inspect.Parameter] = {}
    for name, parameter in inspect.signature(command).parameters.items():
        if name not in groups:
            parameters[name] = parameter.replace(
                annotation=hints[name], kind=inspect.Parameter.KEYWORD_ONLY
            )
    for kind in groups.values():
        parameters |= _field_parameters(kind)

    @wraps(command)
    def flat(**given: object) -> None:
        built = {
            name: kind(**{one.name: given[one.name] for one in fields(kind)})
            for name, kind in groups.items()
        }
        plain = {name: given[name] for name in hints if name not in groups}
        command(**built, **plain)

    signature = inspect.Signature(list(parameters.values()))
    flat.__signature__ = signature  # type: ignore[attr-defined]  # inspect looks for it
    flat.__annotations__ = {name: one.annotation for name, one in parameters.items()}
    return flat


def _field_parameters(group: Group) -> dict[str, inspect.Parameter]:
    hints = get_type_hints(group, include_extras=True)
    return {
        one.name: inspect.Parameter(
            one.name,
            inspect.Parameter.KEYWORD_ONLY,
            default=one.default,
            annotation=hints[one.name],
        )
        for one in fields(group)
    }
