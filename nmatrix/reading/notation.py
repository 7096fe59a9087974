"""What every notation comes down to: quantities by name, each as rows of number texts."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, quoted
from nmatrix.reading.literal import Tokens, unreadable

FIRST_OF = (
    "world_from_object",
    "camera_from_world",
    "clip_from_camera",
    "space_from_object",
    "space_from_world",
    "normal_matrix",
    "value",
)
SHOWN = 8  # names that a message lists


@dataclass(frozen=True)
class Notation:
    """The quantities of a text, in its order; `layout` is None where the text does not say it.

    A text that is one nameless matrix has the single name "".
    """

    quantities: Mapping[str, Tokens]
    layout: Layout | None = None


def chosen(notation: Notation, key: str | None, source: str) -> Tokens:
    """Return the quantity under a key, else the first that is usually meant, else the only one.

    Dots and underscores in keys are alike, since programs cannot name a value with dots.

    Raises
    ------
    IllegalValueError
        If there is no such key, or no way to choose.

    Examples
    --------
    >>> chosen(Notation({"eye": [["1"]], "value": [["2"]]}), None, "x")
    [['2']]
    """
    found = notation.quantities
    if key is not None:
        for name, tokens in found.items():
            if name == key or _program_name(name) == _program_name(key):
                return tokens
        next_step = f"choose one of {_listed(found)}" if any(found) else "leave the key out"
        raise IllegalValueError(f"key ({quoted(key)})", f"{source} has no such matrix", next_step)
    for name in ("", *FIRST_OF):
        if name in found:
            return found[name]
    if len(found) == 1:
        return next(iter(found.values()))
    if not any(found):
        raise unreadable(source, "it holds no matrix")
    next_step = f"name one of {_listed(found)} after a #"
    raise unreadable(source, "which of its matrices is meant?", next_step)


def _program_name(key: str) -> str:
    return re.sub(r"[^A-Za-z0-9]+", "_", key).strip("_")


def _listed(found: Mapping[str, Tokens]) -> str:
    names = [quoted(name)[1:-1] for name in list(found)[:SHOWN] if name]
    return ", ".join(names) + (", …" if len(found) > SHOWN else "")
