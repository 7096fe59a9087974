"""A light of a scene: where it is, what it sends, how far it reaches, what it is fixed to."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, radians
from typing import TYPE_CHECKING

from nmatrix.linear.rational import RationalVector
from nmatrix.linear.rounding import normalize
from nmatrix.report import Vector
from nmatrix.scene.words import LightKind

if TYPE_CHECKING:
    from nmatrix.scene.material import Colour

WORLD, EYE = "world", "eye"


@dataclass(frozen=True)
class SceneLight:
    """One light, in the frame of what it is fixed to.

    Parameters
    ----------
    position
        For point and spot lights.
    direction
        In which the light travels, any length but zero; for directional and spot lights.
    color, intensity
        Their product is what arrives at distance 0.
    attenuation
        c, l, q of 1 / (c + l·d + q·d²), for point and spot lights.
    range
        Beyond this distance nothing arrives.
    cone_degrees
        Half angles of a spot light: full light inside the first, none outside the second.
    fixed_to
        `world`, `eye` (a flashlight), or the name of an object.
    shadows
        Whether what stands in its way keeps it off.
    """

    name: str
    kind: LightKind
    position: Vector = (0, 0, 0)
    direction: Vector = (-1, -1, -1)
    color: Colour = (1.0, 1.0, 1.0)
    intensity: float = 1.0
    attenuation: tuple[float, float, float] = (1.0, 0.0, 0.0)
    range: float = inf
    cone_degrees: tuple[float, float] = (20.0, 30.0)
    fixed_to: str = WORLD
    shadows: bool = False

    @property
    def has_position(self) -> bool:
        """True if the light comes from somewhere."""
        return self.kind in (LightKind.POINT, LightKind.SPOT)

    @property
    def fades(self) -> bool:
        """True if less arrives farther away."""
        return self.attenuation != (1.0, 0.0, 0.0) or self.range < inf

    @property
    def has_direction(self) -> bool:
        """True if the light has a direction of travel of its own."""
        return self.kind in (LightKind.DIRECTIONAL, LightKind.SPOT)

    @property
    def cone_cosines(self) -> tuple[float, float]:
        """The cosines of the cone's half angles."""
        inner, outer = self.cone_degrees
        return cos(radians(inner)), cos(radians(outer))


@dataclass(frozen=True)
class PlacedLight:
    """A light in the world: where it is, and the unit direction in which its light travels."""

    light: SceneLight
    position: RationalVector | None
    direction: RationalVector | None

    @property
    def colour(self) -> Colour:
        """Return the light that it sends: colour times intensity."""
        red, green, blue = self.light.color
        strength = self.light.intensity
        return red * strength, green * strength, blue * strength


USUAL_DIRECTION = normalize((-1, -1, -1))  # of a light that says nothing of it
