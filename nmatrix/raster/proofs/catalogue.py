"""Every proof with the module that draws it and its claim: all that `--list` needs."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from importlib import import_module
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from nmatrix.raster.proofs.proof import Proof, ProofSettings


class Turning(StrEnum):
    """What goes once around in the frames of a proof, while all else stays."""

    OBJECT = "object"
    LIGHT = "light"
    EYE = "eye"


@dataclass(frozen=True)
class Turn:
    """What goes around, and about which axis of the world."""

    what: Turning
    axis: tuple[int, int, int] = (0, 1, 0)


TUMBLE = Turn(Turning.OBJECT, (1, 1, 1))  # an upright shape about y would look the same throughout
WALK = Turn(Turning.EYE)


@dataclass(frozen=True)
class ProofEntry:
    """One proof: its name, the module of the function that draws it, and its claim.

    The claim is what the title of its own picture says, or begins with; other maps may have others.
    `turns` is what the proof is about, so that each frame of its animation proves it again.
    """

    name: str
    module: str
    claim: str
    turns: Turn = TUMBLE

    def load(self) -> Callable[[ProofSettings], Proof]:
        """Import the function that draws it."""
        module = import_module(f"nmatrix.raster.proofs.{self.module}")
        found: Callable[[ProofSettings], Proof] = getattr(module, self.name.replace("-", "_"))
        return found


PROOFS: tuple[ProofEntry, ...] = (
    ProofEntry("normals", "rules", "Stretch a shape by A, and A bends its normals off the surface"),
    ProofEntry("bias", "rules", "A test that only turns things passes the wrong code"),
    ProofEntry("spaces", "spaces", "Five places to stand, one picture"),
    ProofEntry(
        "object-rule",
        "object_rule",
        "Object space: carry the light by M⁻¹, then measure with the metric",
    ),
    ProofEntry(
        "mirror",
        "mirror",
        "Mirror a shape: keep the sign of det A, and flip the winding",
        Turn(Turning.OBJECT),  # a letter is read upright
    ),
    ProofEntry(
        "stuck-light",
        "stuck_light",
        "A light left in model space turns with the model",
        Turn(Turning.OBJECT, (0, -1, 0)),  # on its turntable
    ),
    ProofEntry(
        "flashlight",
        "flashlight",
        "A flashlight is a light whose place is given in camera space",
        WALK,
    ),
    ProofEntry(
        "shading",
        "shading",
        "Shading says where the light is computed, reflection says how it bounces",
    ),
    ProofEntry(
        "interpolation",
        "interpolation",
        "Unequal lengths bend normals; unequal depths bend patterns",
    ),
    ProofEntry(
        "translation",
        "translation",
        "A normal has no place: with w = 1 a translation blows it away",
        Turn(Turning.OBJECT, (0, 0, 1)),  # where it was moved to goes towards the light and away
    ),
    ProofEntry(
        "flatten",
        "flatten",
        "Flatten a shape: the inverse is gone, the plane's normal is not",
        Turn(Turning.LIGHT),  # the plane stays in sight, and its own normal answers
    ),
    ProofEntry(
        "depth",
        "depth",
        "Float depth pays off only when it runs backwards: near = 1, far = 0",
        Turn(Turning.EYE, (0, 0, 1)),  # it rolls: from everywhere above, endless floors look alike
    ),
    ProofEntry(
        "accuracy",
        "accuracy",
        "Squeeze a shape 10⁶ : 1, and precision decides what is left of a normal",
    ),
    ProofEntry(
        "effects",
        "effects",
        "The plan leaves out the unseen",
        WALK,  # there are many objects
    ),
)


def catalogued(name: str) -> ProofEntry | None:
    """Return a proof by its name, if there is one.

    Examples
    --------
    >>> catalogued("object-rule").module
    'object_rule'
    """
    return next((one for one in PROOFS if one.name == name), None)
