"""Which nodes are certainly plain: nothing but moved, turned and scaled evenly, without a mirror.

A product of such maps is such a map, so most nodes of a file of thousands need no matrix at all:
only how far each may be from an even scale is carried down the hierarchy. The certificate has one
side: what it does not cover may be plain too, and is classified exactly.
"""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.scene.gltf.nodes import Nodes
from nmatrix.scene.gltf.records import NodeRecord

# A map is s · Q · (I + E), with a rotation Q and |E| ≤ d, its deviation; then the cosines of its
# columns are below 3 d and their lengths differ by less than 3 d, for d below 1/8.
SHARE = 1 / 8  # of the tolerance that a deviation may take up
ROUNDING = 2.0**-52  # what rounding a world matrix to floats adds: √3 · 2⁻⁵³
ERROR = 2.0**-48  # of the squares and products of a matrix computed in floats
SMALLEST, LARGEST = 1e-200, 1e200  # scales between which no square is out of range

Spread = tuple[float, float, float]  # deviation, scale, distance from the origin at most


def suspects(nodes: Nodes, tolerance: float) -> list[int]:
    """Find the nodes that are not certainly plain to a tolerance, in the file's order.

    Examples
    --------
    >>> from nmatrix.scene.gltf.nodes import placed
    >>> even, stretched = NodeRecord(scale=[2, 2, 2], children=[1]), NodeRecord(scale=[1, 2, 1])
    >>> suspects(placed(None, [even, stretched, NodeRecord(scale=[-1, 1, 1])], 0), 1e-6)
    [1, 2]
    """
    spreads: list[Spread | None] = [None] * len(nodes)
    most = tolerance * SHARE
    found = []
    for index in nodes.order:
        parent = nodes.hierarchy.parents[index]
        above = (0.0, 1.0, 0.0) if parent is None else spreads[parent]
        local = None if above is None else _spread(nodes.records[index])
        if above is None or local is None:
            found.append(index)
            continue
        deviation = above[0] + local[0] + above[0] * local[0] + ROUNDING
        scale = above[1] * local[1]
        distance = above[2] + 2 * above[1] * local[2]
        if deviation <= most and SMALLEST < scale < LARGEST and distance < LARGEST:
            spreads[index] = deviation, scale, distance
        else:
            found.append(index)
    return sorted(found)


def _spread(record: NodeRecord) -> Spread | None:
    """Bound a node's own map; None if it is not certainly plain."""
    if record.matrix is not None:
        return _spread_of_matrix(record.matrix)
    distance = 0.0
    if record.translation:
        x, y, z = record.translation
        distance = abs(x) + abs(y) + abs(z)
    if not record.scale:
        return 0.0, 1.0, distance
    x, y, z = record.scale  # the rotation beside it is exact, whatever its quaternion's length
    if x == y == z > 0:
        return 0.0, x, distance
    if not x * y * z > 0:
        return None
    x, y, z = abs(x), abs(y), abs(z)
    largest = max(x, y, z)
    return (largest - min(x, y, z)) / largest + ROUNDING, largest, distance


def _spread_of_matrix(entries: Sequence[float]) -> Spread | None:
    """Bound a map by its columns, which are the entries one after the other."""
    a, b, c, _, d, e, f, _, g, h, i, _, x, y, z, _ = entries
    square = a * a + b * b + c * c
    if not SMALLEST < square < LARGEST:
        return None
    off = max(
        abs(d * d + e * e + f * f - square),
        abs(g * g + h * h + i * i - square),
        abs(a * d + b * e + c * f),
        abs(a * g + b * h + c * i),
        abs(d * g + e * h + f * i),
    )
    determinant = a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)
    deviation = 3 * off / square + ERROR
    scale = square**0.5
    if deviation > SHARE or determinant < square * scale / 2:
        return None
    return deviation, scale, abs(x) + abs(y) + abs(z)
