"""`nmatrix world`: the world matrix, its kind, its parts, and its normal matrix."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import asdict, replace

from nmatrix.enums import Convention
from nmatrix.lessons.map_sentences import (
    transform_blocks,
    transform_data,
    transform_remarks,
    verdict,
)
from nmatrix.linear.classify import Classification, classify
from nmatrix.linear.decompose import Parts
from nmatrix.report import Block, Brief, Cells, Heading, Quantity, Report, Table, Value, Verdict
from nmatrix.scene.setup import Setup


def world(setup: Setup, *, steps: bool = False) -> Report:
    """Answer with the world matrix of a scene; its steps are for who asks for them.

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
    parts = setup.world.parts
    cofactors = linear_map.cofactor_matrix
    data = {
        "world_from_object": M,
        "normal_matrix": normal_matrix,
        "cofactor_matrix": cofactors,
        **transform_data(found),
        "needs_inverse_transpose": found.needs_inverse_transpose,
        "worst_angle_without_deg": found.worst_angle_deg,
        "parts": None if parts is None else parts_data(parts),
        "steps": None,
    }
    blocks: list[Block] = [
        Heading("World matrix: world from object, M = T · R · S · H"),
        Quantity("world_from_object", M, "M"),
        Heading("Normal matrix"),
        Quantity("normal_matrix", normal_matrix, "A⁻ᵀ, the inverse transpose"),
        Quantity("cofactor_matrix", cofactors, "C, the cofactors"),
        *transform_blocks(found),
    ]
    remarks = [*setup.world.remarks, *transform_remarks(found)]
    if parts is not None:
        how = "as given" if parts.given else "one choice of several"
        blocks += [Heading(f"Parts, {how}"), parts_table(parts)]
        remarks += parts_remarks(parts)
    brief = _brief(setup, blocks, found, parts)
    report = Report("world", data, tuple(blocks), tuple(remarks), brief=brief)
    if steps:
        from nmatrix.answers.steps import of_world, with_steps  # most answers are without

        return with_steps(report, of_world(setup))
    return report


def _brief(
    setup: Setup, blocks: Sequence[Block], found: Classification, parts: Parts | None
) -> Brief:
    """Show what was asked for: the matrix of parts, or the parts of a matrix."""
    by_key = {one.key: one for one in blocks if isinstance(one, Quantity)}
    conclusion, normal_matrix = Verdict(verdict(found)), by_key["normal_matrix"]
    more = ["the cofactors", "determinant, rank and condition"]
    if setup.world.matrix is not None and parts is not None:
        table = replace(parts_table(parts), title="Its parts, one choice of several")
        return Brief((conclusion, table), ("the matrix", "the normal matrix", *more))
    M = replace(by_key["world_from_object"], title="M = T · R · S · H")
    if parts is not None:
        more.append("the parts")
    return Brief((conclusion, M, normal_matrix), tuple(more))


def parts_data(parts: Parts) -> dict[str, Value]:
    """Describe parts under the keys of the data."""
    data = asdict(parts)
    given = data.pop("given")
    return {**data, "unique": parts.unique, "given": given}


def parts_table(parts: Parts) -> Table:
    """Show the parts row by row."""
    angles = f"rotate {parts.order} (deg)"
    if parts.convention is not Convention.STANDARD:
        angles = f"rotate {parts.convention} (deg)"
    rows: list[Cells] = [
        ("translate", *parts.translate, ""),
        (angles, *parts.rotate, ""),
        ("quaternion", *parts.quaternion),
        ("scale", *parts.scale, ""),
        ("shear xy xz yz", *parts.shear, ""),
    ]
    if parts.axis is not None:
        rows.insert(3, ("axis, angle (deg)", *parts.axis, parts.angle_deg))
    return Table(("part", "x", "y", "z", "w"), tuple(rows))


def parts_remarks(parts: Parts) -> list[str]:
    """Tell that angles lose a degree of freedom, and which other parts build the same matrix."""
    angles = " ".join(f"{float(angle):.6g}" for angle in parts.other_angles)
    told = []
    if parts.gimbal_lock:
        told.append(
            "Gimbal lock: the middle angle is a quarter turn, so the two others turn about one "
            f"axis, and only their sum or difference counts: rotate {angles} turns alike."
        )
    if not parts.given:
        told.append(
            f"These parts are one choice of several: rotate {angles} turns alike, so does the "
            "quaternion with its four signs changed, and minus signs on two scales go with "
            "another rotation."
        )
    return told
