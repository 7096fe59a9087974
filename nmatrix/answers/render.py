"""`render`: what a picture shows, in numbers and in a sentence."""

from __future__ import annotations

from dataclasses import asdict

from nmatrix.raster.proofs.proof import Proof
from nmatrix.report import Block, Figure, Quantity, Report, Value, Verdict

SHOWN = ("max_angle_error_deg", "mean_angle_error_deg", "triangles", "fragments")


def render(proof: Proof, image: str, milliseconds: float) -> Report:
    """Return the report of a picture that was written to a file."""
    height, width = proof.image.shape[:2]
    data: dict[str, Value] = {
        "image": image,
        "width": width,
        "height": height,
        "subject": proof.subject,
        "max_angle_error_deg": proof.max_angle_error_deg,
        "mean_angle_error_deg": proof.mean_angle_error_deg,
        "max_level_difference": proof.max_level_difference,
        "triangles": proof.work.triangles,
        "fragments": proof.work.fragments,
        "work": asdict(proof.work),
        "milliseconds": milliseconds,
        "effects": list(proof.effects),
        "numbers": dict(proof.numbers),
    }
    blocks: tuple[Block, ...] = (
        Figure(image, f"a picture of {proof.subject}"),
        *(Quantity(key, data[key]) for key in SHOWN),  # type: ignore[arg-type]  # numbers or None
        Verdict(proof.verdict),
    )
    return Report("render", data, blocks, proof.remarks)
