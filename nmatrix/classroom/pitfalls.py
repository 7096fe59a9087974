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
    Pitfall("F1", "Without an uneven scale the world matrix itself may carry normals.",
            "Only if it turns, mirrors and scales all directions alike. A shear scales nothing "
            "and still bends normals.",
            "nmatrix derive shear"),
    Pitfall("F2", "w must be 0, or the translation distorts the normal.",
            "True with M itself. With the inverse transpose the fourth number means nothing: "
            "drop it before you normalise.",
            "nmatrix derive translation"),
    Pitfall("F3", "Into object space a light direction moves by Mᵀ.",
            "That is how a normal goes back. A direction goes back by M⁻¹, and lengths there are "
            "measured by AᵀA.",
            "nmatrix derive lightdirection"),
    Pitfall("F4", "Into camera space a light direction moves by V⁻ᵀ.",
            "For a camera that only turns and moves that is V itself. If V scales, a direction "
            "still moves by V.",
            "nmatrix light camera"),
    Pitfall("F5", "Point lights do not work in object space.",
            "They do, once lengths and angles there are measured by AᵀA.",
            "nmatrix space object --scale 1 2 1"),
    Pitfall("F6", "The light moves by V · M.",
            "Only a lamp that is fixed to the object. A lamp of the world moves by V alone.",
            "nmatrix light camera --light-position 2 2 8"),
    Pitfall("F7", "It looked right, so the matrix is right.",
            "A turned object proves nothing: for a rotation A⁻ᵀ = A. Test with an uneven scale.",
            "nmatrix derive rotation"),
    Pitfall("F8", "The inverse transpose removes the translation.",
            "Taking the 3×3 block does, or w = 0.",
            "nmatrix derive translation"),
    Pitfall("F9", "Cofactors are as good as the inverse transpose.",
            "Times the sign of det A they are, and better where A flattens. Without the sign a "
            "mirror turns normals inwards.",
            "nmatrix derive cofactor"),
    Pitfall("F10", "Normalise in the fragment shader.",
            "Before and after: normals of unequal lengths bend what is interpolated between them.",
            "nmatrix derive nonuniform"),
    Pitfall("F11", "Phong is Phong.",
            "Phong shading says where light is computed: in every pixel. Phong reflection is the "
            "formula of the highlight.",
            "nmatrix space world --shading gouraud"),
    Pitfall("F12", "Where the mirrored ray misses the eye there is no highlight.",
            "A power can glow even so, for computers say 0⁰ = 1. Leave the highlight out wherever "
            "n · l is not above 0.",
            "nmatrix derive reflection"),
    Pitfall("F13", "World space is expensive, object space is cheap.",
            "Count it: for each vertex, yes. Each pixel costs more in a stretched object space.",
            "nmatrix cost spaces --quick"),
    Pitfall("F14", "Tangents go with the normals.",
            "Tangents move by A, normals by A⁻ᵀ: only so do they stay at a right angle.",
            "nmatrix derive nonuniform"),
    Pitfall("F15", "Ambient light is light.",
            "It is one constant in place of all the light that other surfaces send: it shows no "
            "shape.",
            "nmatrix space world -f glsl"),
    Pitfall("F16", "In camera space a point's own position is the direction to the eye.",
            "It is the opposite: from a point p to the eye goes −p, brought to length 1.",
            "nmatrix derive reflection"),
)  # fmt: skip
