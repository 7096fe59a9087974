"""Every proof with the module that draws it and its one line: all that `--list` needs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Entry:
    """One proof: its name, the module and function that draw it, and what it shows."""

    name: str
    module: str
    shows: str

    @property
    def function(self) -> str:
        """Return the name of the function in the module."""
        return self.name.replace("-", "_")


PROOFS: tuple[Entry, ...] = (
    Entry("normals", "rules", "wrong normals, right normals, and a map of the angle between them"),
    Entry("bias", "rules", "a rotation makes the wrong matrix look right; a scale does not"),
    Entry("spaces", "spaces", "one picture, lit in world, camera, object, static and light space"),
    Entry("object-rule", "lights", "object space: Mᵀl, M⁻¹l and the exact rule; their terminators"),
    Entry("mirror", "rules", "cofactors without the sign, the inverse transpose, winding"),
    Entry("stuck-light", "lights", "a light in model space turns with the torus; in eye space not"),
    Entry("flashlight", "lights", "a light fixed to the eye against one fixed to the world"),
    Entry("shading", "surfaces", "flat, Gouraud, Phong; Phong and Blinn-Phong highlights; toon"),
    Entry(
        "interpolation", "surfaces", "normalise never, after, before and after; perspective or not"
    ),
    Entry("translation", "rules", "w = 1 with M, and a normalise over four components"),
    Entry("flatten", "rules", "scale 1 0 1: what an inverse, a zero matrix and the cofactors draw"),
    Entry("depth", "depth", "z-fighting in 16 and 24 bits and float32, standard and reversed"),
    Entry(
        "accuracy",
        "accuracy",
        "float16, float32, float64 and exact on a hard matrix, with the work",
    ),
    Entry("effects", "spaces", "everything on against the plan: the same picture for less work"),
)


def entry(name: str) -> Entry | None:
    """Return the entry of a proof, if there is one.

    Examples
    --------
    >>> entry("object-rule").function
    'object_rule'
    """
    return next((one for one in PROOFS if one.name == name), None)
