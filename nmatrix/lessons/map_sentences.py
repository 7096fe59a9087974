"""The sentences that several answers share on kinds of maps."""

from __future__ import annotations

from nmatrix.enums import Kind
from nmatrix.linear.classify import Classification
from nmatrix.report import Block, Quantity, Value, Verdict

_MEANING = {
    Kind.IDENTITY: "the identity: nothing moves",
    Kind.TRANSLATION: "a translation: directions and normals stay as they are",
    Kind.ROTATION: "a rotation: A⁻ᵀ = A, so A itself carries normals",
    Kind.RIGID: "a rigid motion (rotation and translation): A itself carries normals",
    Kind.SIMILARITY: "a similarity (uniform scale): A itself carries normals, up to length",
    Kind.NON_UNIFORM_SCALE: "a non-uniform scale: normals need the inverse transpose",
    Kind.SHEAR: "a shear: normals need the inverse transpose",
    Kind.SINGULAR: "singular: it flattens space, so it has no inverse transpose",
}
_MIRRORED = {
    Kind.ROTATION: "a mirror (orthogonal, determinant −1): A⁻ᵀ = A, so A itself carries normals",
    Kind.RIGID: "a mirror and a translation (A is orthogonal, determinant −1): A carries normals",
    Kind.SIMILARITY: "a mirrored similarity (uniform scale): A carries normals, up to length",
    Kind.NON_UNIFORM_SCALE: "a mirrored non-uniform scale: normals need the inverse transpose",
    Kind.SHEAR: "a mirrored shear: normals need the inverse transpose",
}


def transform_data(found: Classification) -> dict[str, Value]:
    """Describe a map under the keys of the data."""
    return {
        "determinant": found.linear_map.determinant,
        "determinant_sign": found.determinant_sign,
        "rank": found.rank,
        "condition": found.condition,
        "transform": found.kind.value,
        "transform_exact": found.kind_exact,
        "mirrored": found.mirrored,
    }


def transform_blocks(found: Classification) -> tuple[Block, ...]:
    """Show the determinant, the rank, the condition and the verdict."""
    linear_map = found.linear_map
    blocks: list[Block] = [
        Quantity("determinant", linear_map.determinant, "determinant"),
        Quantity("rank", found.rank, "rank"),
    ]
    if found.condition is not None:
        blocks.append(Quantity("condition", found.condition, "condition σ₁/σ₃"))
    blocks.append(Verdict(verdict(found)))
    return tuple(blocks)


def verdict(found: Classification) -> str:
    """Conclude in one sentence: kind, mirror, exact or to rounding, or to the digits given."""
    meaning = (_MIRRORED if found.mirrored else _MEANING)[found.kind]
    by_digits = found.kind is not found.kind_as_typed
    sentence = f"To the digits given this is {meaning}" if by_digits else f"This is {meaning}"
    if found.kind is Kind.SINGULAR:
        return f"{sentence} (rank {found.rank})."
    if found.mirrored:
        sentence += "; triangle winding flips, outward normals stay outward"
    if by_digits:
        sentence += f"; exactly as typed it is {_as_typed(found)}"
    elif not found.kind_exact:
        sentence += " (to rounding, not exactly on these floats)"
    return f"{sentence}."


def _as_typed(found: Classification) -> str:
    named = f"a {found.kind_as_typed.replace('-scale', ' scale')}"
    if found.needs_inverse_transpose or not found.worst_angle_deg:
        return named
    return f"{named}, and A bends a normal by up to {found.worst_angle_deg:.2g}°"


def transform_remarks(found: Classification) -> tuple[str, ...]:
    """Explain the consequences of this kind of map."""
    remarks = []
    if found.kind is Kind.SINGULAR:
        remarks.append(_singular_remark(found.rank))
    elif found.needs_inverse_transpose and found.worst_angle_deg is not None:
        remarks.append(
            f"With A in place of the inverse transpose a normal is off by up to "
            f"{found.worst_angle_deg:.4g}°: arctan((κ − 1/κ)/2), κ = {found.condition_text}."
        )
    if found.kind is Kind.SHEAR and found.linear_map.determinant == 1:
        remarks.append("The determinant is 1 and normals still bend: a determinant is no test.")
    if found.mirrored:
        remarks.append(
            "The determinant is negative: the plain cofactor matrix would turn normals inside "
            "out; the inverse transpose, or sign(det) · cofactor, keeps them outward."
        )
    return tuple(remarks)


def _singular_remark(rank: int) -> str:
    if rank == 2:
        return (
            "Space is flattened to a plane. The cofactor matrix still gives that plane's normal, "
            "but its two sides are alike; a normal that lies in the plane has no image."
        )
    return f"Rank {rank} leaves no surface at all, so no normal exists."
