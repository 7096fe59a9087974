"""`nmatrix world`: the world matrix, its kind, its parts, and its normal matrix."""

from __future__ import annotations

from dataclasses import asdict

from nmatrix.lessons.map_sentences import transform_blocks, transform_data, transform_remarks
from nmatrix.linear.classify import classify
from nmatrix.linear.decompose import Parts, parts
from nmatrix.report import Block, Cells, Heading, Quantity, Report, Table
from nmatrix.scene.setup import Setup


def world(setup: Setup) -> Report:
    """Answer with the world matrix of a scene.

    Examples
    --------
    >>> from nmatrix.scene.world import World
    >>> world(Setup(World(scale=(1, 2, 1)))).data["transform"]
    'non-uniform-scale'
    """
    M = setup.world.world_from_object
    found = classify(M, setup.tolerance)
    linear_map = found.linear_map
    normal_matrix = linear_map.normal_matrix
    taken_apart = parts(M, setup.world.order)
    cofactors = linear_map.cofactor_matrix
    data = {
        "world_from_object": M,
        "normal_matrix": normal_matrix,
        "cofactor_matrix": cofactors,
        **transform_data(found),
        "needs_inverse_transpose": found.needs_inverse_transpose,
        "worst_angle_without_deg": found.worst_angle_deg,
        "parts": None if taken_apart is None else asdict(taken_apart),
    }
    blocks: list[Block] = [
        Heading("World matrix: world from object, M = T · R · S · H"),
        Quantity("world_from_object", M, "M"),
        Heading("Normal matrix"),
        Quantity("normal_matrix", normal_matrix, "A⁻ᵀ, the inverse transpose"),
        Quantity("cofactor_matrix", cofactors, "C, the cofactors"),
        *transform_blocks(found),
    ]
    if taken_apart is not None:
        blocks += [Heading("Parts"), _parts_table(taken_apart)]
    return Report("world", data, tuple(blocks), (*setup.world.remarks, *transform_remarks(found)))


def _parts_table(taken_apart: Parts) -> Table:
    rows: tuple[Cells, ...] = (
        ("translate", *taken_apart.translate),
        ("rotate (deg)", *taken_apart.rotate),
        ("scale", *taken_apart.scale),
        ("shear xy xz yz", *taken_apart.shear),
    )
    return Table(("part", "x", "y", "z"), rows)
