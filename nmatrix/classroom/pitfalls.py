"""What course material claims, where it holds and where it fails, numbered for the classroom."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Pitfall:
    """One claim: what is said, what is true, and the command that shows it."""

    id: str
    claim: str
    verdict: str
    command: str


PITFALLS: tuple[Pitfall, ...] = (
    Pitfall("F1", "Without a non-uniform scale the world matrix carries normals.",
            "Exactly if AᵀA = s² I. A shear has determinant 1 and still bends them.",
            "nmatrix derive shear"),
    Pitfall("F2", "w must be 0, or the translation distorts the normal.",
            "True for M itself; in the inverse transpose w is junk: do not normalise it.",
            "nmatrix derive translation"),
    Pitfall("F3", "Into object space a light direction moves by Mᵀ.",
            "That is the rule for normals; a direction moves by M⁻¹, lengths by the metric.",
            "nmatrix derive lightdirection"),
    Pitfall("F4", "Into camera space a light direction moves by V⁻ᵀ.",
            "For a rigid V both agree; if V scales, a direction moves by V.",
            "nmatrix light camera"),
    Pitfall("F5", "Point lights do not work in object space.",
            "They do: two more 3×3 matrices measure lengths there.",
            "nmatrix space object --scale 1 2 1"),
    Pitfall("F6", "The light moves by V·M.",
            "Only if it is fixed to the object; a lamp of the world moves by V.",
            "nmatrix light camera --light-position 2 2 8"),
    Pitfall("F7", "It looked right, so the matrix is right.",
            "For a rotation A⁻ᵀ = A: a test on rotated objects cannot tell the two apart.",
            "nmatrix derive rotation"),
    Pitfall("F8", "The inverse transpose removes the translation.",
            "Taking the 3×3 block does, or w = 0.",
            "nmatrix derive translation"),
    Pitfall("F9", "The cofactor matrix is the better inverse transpose.",
            "Times the sign of det: without it a mirror turns normals inwards.",
            "nmatrix derive cofactor"),
    Pitfall("F10", "Normalise in the fragment shader.",
            "Before and after interpolation: unequal lengths bend what lies between.",
            "nmatrix derive nonuniform"),
    Pitfall("F11", "Phong is Phong.",
            "Phong shading is light per fragment, Phong reflection is the highlight's formula.",
            "nmatrix space world --shading gouraud"),
    Pitfall("F12", "No highlight where r · v = 0.",
            "Gate on n · l > 0, clamp r · v to [0, 1]; 0⁰ must not glow.",
            "nmatrix derive reflection"),
    Pitfall("F13", "World space is expensive, object space is cheap.",
            "Count it: per vertex yes; a stretched object space costs more per fragment.",
            "nmatrix cost spaces --quick"),
    Pitfall("F14", "Tangents go with the normals.",
            "Tangents move by A, normals by A⁻ᵀ: t · n = 0 survives only so.",
            "nmatrix derive nonuniform"),
    Pitfall("F15", "Ambient light is light.",
            "A constant in place of all light that other surfaces send: no shape, no corner.",
            "nmatrix space world -f glsl"),
    Pitfall("F16", "In camera space the eye's direction is the position.",
            "Its negative: from the point to the eye is −p/|p|.",
            "nmatrix derive reflection"),
)  # fmt: skip
