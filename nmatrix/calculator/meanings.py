"""What a value means: a map from one space to another, or a thing of a kind in a space."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Kind(StrEnum):
    """What a vector is: how a map carries it follows from this."""

    POINT = "point"
    DIRECTION = "direction"
    NORMAL = "normal"


@dataclass(frozen=True)
class Map:
    """A matrix that leads from the space `source` to the space `to`."""

    to: str
    source: str


@dataclass(frozen=True)
class Located:
    """A vector of a kind, in a space."""

    space: str
    kind: Kind


Meaning = Map | Located
