"""The table of flaws: the rule that each goes against, its words, and how much it weighs.

Rules keep their codes for ever: people switch findings off by them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from nmatrix.enums import Flaw, Severity
from nmatrix.report import Rule


@dataclass(frozen=True)
class FlawWords:
    """A flaw's rule, the word for a node or a map that has it, and its weight unless asked for."""

    rule: Rule
    adjective: str
    severity: Severity


FLAWS = {
    Flaw.SHEAR: FlawWords(
        Rule(
            "NM-A01",
            "sheared",
            "The axes of the node are no longer perpendicular in the world.",
            "A rotation under a non-uniform scale is a shear, which no translation, rotation and "
            "scale can hold: an engine that stores these three loses it. Apply the scale of the "
            "ancestors to their meshes before exporting, or transform normals by the inverse "
            "transpose of the whole matrix.",
        ),
        "sheared",
        Severity.WARNING,
    ),
    Flaw.MIRRORED: FlawWords(
        Rule(
            "NM-A02",
            "mirrored",
            "The node turns left hands into right hands: the determinant is negative.",
            "The winding of its triangles flips: exchange front and back faces for it, and the "
            "sign of bitangents. Applying the negative scale to the mesh and turning its faces "
            "around removes it.",
        ),
        "mirrored",
        Severity.WARNING,
    ),
    Flaw.SINGULAR: FlawWords(
        Rule(
            "NM-A03",
            "singular",
            "The node is flattened: the determinant is exactly 0.",
            "There is no inverse, so a shader that computes one gets infinities. Give the scale of "
            "0 another value, or take normals by the cofactor matrix, which exists always.",
        ),
        "singular",
        Severity.WARNING,
    ),
    Flaw.DEGENERATE: FlawWords(
        Rule(
            "NM-A04",
            "degenerate normals",
            "Normals of the mesh are no direction: zero, or not finite.",
            "Normalising such a vector gives not-a-number, which a renderer shows as black or as "
            "sparks. Remove triangles without area, and normals that are zero: let the exporter "
            "compute them again if the file has any.",
        ),
        "with degenerate normals",
        Severity.WARNING,
    ),
    Flaw.NON_UNIFORM_SCALE: FlawWords(
        Rule(
            "NM-A05",
            "non-uniform scale",
            "The node is stretched by different factors along its axes.",
            "The 3×3 block of its world matrix bends normals: transform them by the inverse "
            "transpose, or apply the scale to the mesh before exporting.",
        ),
        "non-uniform",
        Severity.NOTE,
    ),
    Flaw.UNREADABLE: FlawWords(
        Rule(
            "NM-A06",
            "unreadable",
            "The file, or the mesh of a node, could not be read whole.",
            "What was not read was not judged. The message says what is wrong and where.",
        ),
        "not wholly read",
        Severity.ERROR,
    ),
}
RULES = tuple(sorted((one.rule for one in FLAWS.values()), key=lambda rule: rule.code))


def rank(flaws: Sequence[Flaw]) -> int:
    """Place the worst of some flaws in the order of all; those without a flaw come last.

    Examples
    --------
    >>> rank((Flaw.NON_UNIFORM_SCALE, Flaw.SINGULAR)) < rank((Flaw.MIRRORED,)) < rank(())
    True
    """
    order = list(Flaw)
    return min(map(order.index, flaws), default=len(order))
