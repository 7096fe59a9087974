"""Why nodes are judged as they are: a sentence for each thing that some node of the files is."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping, Sequence

from nmatrix.answers.inspect.file import Special
from nmatrix.answers.inspect.node import Carriers, InspectedNode
from nmatrix.enums import Flaw, Kind
from nmatrix.errors import counted


def remarks_about(
    flawed: Sequence[InspectedNode],
    special: Mapping[Special, int],
    total: int,
    wanted: Callable[[Flaw], bool],
) -> Iterable[str]:
    """Remark on the flaws that are wanted, and on nodes that were not judged by their matrix."""
    if wanted(Flaw.SHEAR):
        yield from _on_shear(flawed)
    if wanted(Flaw.MIRRORED) and any(Flaw.MIRRORED in node.flaws for node in flawed):
        yield "Mirrored nodes flip triangle winding; their normals stay outward."
    if wanted(Flaw.SINGULAR) and any(Flaw.SINGULAR in node.flaws for node in flawed):
        yield (
            "Singular nodes are flattened and have no inverse transpose: the cofactor matrix gives "
            "the normal of the plane that is left."
        )
    if wanted(Flaw.UNREADABLE):
        yield from _unread(flawed)
    for kind, sentence in _OF_SPECIAL.items():
        if special[kind]:
            yield sentence.format(counted(special[kind], "node"))
    needing = sum(node.maps.needs_inverse_transpose for node in flawed)
    if 0 < needing < total:
        yield "Where it is not needed the 3×3 block of the world matrix carries normals."


def _on_shear(flawed: Sequence[InspectedNode]) -> Iterable[str]:
    if any(node.sheared_by_ancestors for node in flawed):
        yield (
            "Sheared by ancestors: a rotation under a non-uniform scale is a shear that no "
            "translate-rotate-scale can hold."
        )
    if any(_is_sheared_by_itself(node) for node in flawed):
        yield (
            "Sheared by itself: glTF wants a matrix that translate, rotate and scale make "
            "(NODE_MATRIX_NON_TRS)."
        )


def _is_sheared_by_itself(node: InspectedNode) -> bool:
    is_sheared = node.maps.carriers is Carriers.NODE and node.maps.kind is Kind.SHEAR
    return is_sheared and not node.sheared_by_ancestors


def _unread(flawed: Sequence[InspectedNode]) -> Iterable[str]:
    """Tell each reason for which meshes, or what carries them, were not read."""
    reasons = Counter(node.unread for node in flawed if node.unread)
    for because, count in reasons.most_common():
        yield f"Not wholly read, {counted(count, 'node')}: {because}."


_OF_SPECIAL = {
    Special.SKINNED: "{} skinned: judged by joint · inverse bind matrix, for glTF ignores the "
    "transform of a skinned mesh's own node (§3.7.3.3).",
    Special.INSTANCED: "{} instanced: judged by the world matrices of all instances.",
    Special.ANIMATED: "{} animated: judged at rest, and by the keys of an animated scale; nodes "
    "below it, at rest.",
    Special.MORPHED: "{} with morph targets: normals are judged at rest.",
    Special.OUTSIDE_SCENE: "{} outside the scene: judged all the same, and marked.",
    Special.COMPUTED_NORMALS: "{} whose mesh lacks normals in the file: those were computed.",
}
