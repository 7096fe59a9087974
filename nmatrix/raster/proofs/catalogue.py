"""Every proof with the module that draws it and its one line: all that `--list` needs."""

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
    """One proof: its name, the module of the function that draws it, and what it shows.

    `turns` is what the proof is about, so that each frame of its animation proves it again.
    """

    name: str
    module: str
    shows: str
    turns: Turn = TUMBLE

    def load(self) -> Callable[[ProofSettings], Proof]:
        """Import the function that draws it."""
        module = import_module(f"nmatrix.raster.proofs.{self.module}")
        found: Callable[[ProofSettings], Proof] = getattr(module, self.name.replace("-", "_"))
        return found


PROOFS: tuple[ProofEntry, ...] = (
    ProofEntry(
        "normals", "rules", "wrong normals, right normals, and a map of the angle between them"
    ),
    ProofEntry("bias", "rules", "a rotation makes the wrong matrix look right; a scale does not"),
    ProofEntry(
        "spaces", "spaces", "one picture, lit in world, camera, object, static and light space"
    ),
    ProofEntry(
        "object-rule", "object_rule", "object space: Mᵀl, M⁻¹l and the exact rule; the light's edge"
    ),
    ProofEntry("mirror", "mirror", "cofactors without the sign, the inverse transpose, winding"),
    ProofEntry(
        "stuck-light",
        "stuck_light",
        "a light in model space turns with the model; in eye space not",
        Turn(Turning.OBJECT, (0, -1, 0)),  # on its turntable
    ),
    ProofEntry(
        "flashlight",
        "flashlight",
        "a light fixed to the eye against one fixed to the world",
        WALK,
    ),
    ProofEntry(
        "shading",
        "shading",
        "flat, Gouraud, Phong; Lambert, Phong and Blinn-Phong highlights, toon",
    ),
    ProofEntry(
        "interpolation",
        "interpolation",
        "normalise never, after, before and after; perspective or not",
        Turn(Turning.OBJECT),  # a floor is among the objects
    ),
    ProofEntry(
        "translation",
        "translation",
        "w = 1 with M, and a normalise over four components",
        Turn(Turning.OBJECT, (0, 0, 1)),  # where it was moved to goes towards the light and away
    ),
    ProofEntry(
        "flatten",
        "flatten",
        "scale 1 0 1: what an inverse, a zero matrix and the cofactors draw",
        Turn(Turning.LIGHT),  # the plane stays in sight, and its own normal answers
    ),
    ProofEntry(
        "depth",
        "depth",
        "z-fighting in 16 and 24 bits and float32, standard and reversed",
        Turn(Turning.EYE, (0, 0, 1)),  # it rolls: from everywhere above, endless floors look alike
    ),
    ProofEntry(
        "accuracy",
        "accuracy",
        "float16, float32, float64 and exact on a hard matrix, with the work",
    ),
    ProofEntry(
        "effects",
        "effects",
        "everything on against the plan: the same picture for less work",
        WALK,  # there are many objects
    ),
)


def catalogued(name: str) -> ProofEntry | None:
    """Return a proof by its name, if there is one.

    Examples
    --------
    >>> catalogued("object-rule").module
    'lights'
    """
    return next((one for one in PROOFS if one.name == name), None)
