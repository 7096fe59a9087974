"""`nmatrix axes`: from one axis system to another, for points, matrices, quaternions and angles."""

from __future__ import annotations

from dataclasses import replace

from nmatrix.answers.world import parts_data, parts_remarks, parts_table
from nmatrix.enums import AxisName
from nmatrix.linear.axes import LETTERS, AxisChange, axis_system
from nmatrix.linear.decompose import Parts, parts
from nmatrix.linear.rational import RationalMatrix, RationalVector
from nmatrix.report import Block, Brief, Heading, Quantity, Report, Table, Text, Value, Verdict

POINTS = ("right", "up", "forward")
PARTS = "Its parts, one choice of several"
NO_PARTS = "The matrix is singular: it has no parts."
ASSET = "-x +y +z"  # of glTF: an asset's front looks along +z, its right is −x


def axes(
    source: str, target: str, matrix: RationalMatrix | None = None, order: str = "XYZ"
) -> Report:
    """Answer with F, which tells vectors of one axis system in another, and a matrix told by it.

    Raises
    ------
    IllegalValueError
        For an axis system that is none.

    Examples
    --------
    >>> found = axes("blender", "opengl")
    >>> [[int(x) for x in row[:3]] for row in found.data["to_from"][:3]]
    [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    """
    change = AxisChange(axis_system(source), axis_system(target))
    told = None if matrix is None else change.of_matrix(matrix)
    found = None if told is None else parts(told, order)
    data: dict[str, Value] = {
        "to_from": change.to_from,
        "mirrors": change.mirrors,
        "unit_scale": change.unit_scale,
        "matrix": told,
        "parts": None if found is None else parts_data(found),
        "winding_flips": change.mirrors,
    }
    blocks: list[Block] = [Heading(_from_to(change))]
    remarks = _remarks(change)
    if told is not None:
        blocks.append(Quantity("matrix", told, "F · M · F⁻¹"))
    blocks.append(Quantity("to_from", change.to_from, "F"))
    if told is None:
        blocks.append(_pointing(change))
    blocks.append(Verdict(_verdict(change)))
    if found is not None:
        blocks += [Heading(PARTS), parts_table(found)]
        remarks += parts_remarks(found)
    elif told is not None:
        blocks.append(Text(NO_PARTS))
    brief = _brief(change, told, found)
    return Report("axes", data, tuple(blocks), tuple(remarks), brief=brief)


def _brief(change: AxisChange, told: RationalMatrix | None, found: Parts | None) -> Brief:
    """Show what was asked for: the matrix and its parts in the other system, or F alone."""
    conclusion, named = Verdict(_verdict(change)), _from_to(change).lower()
    if told is None:
        F = Quantity("to_from", change.to_from, f"F, {named}")
        return Brief((F, _pointing(change), conclusion))
    shown = Quantity("matrix", told, f"F · M · F⁻¹, {named}")
    of_it = Text(NO_PARTS) if found is None else replace(parts_table(found), title=PARTS)
    return Brief((shown, of_it, conclusion), ("F",))


def _from_to(change: AxisChange) -> str:
    return f"From {change.source.name} to {change.target.name}"


def _pointing(change: AxisChange) -> Table:
    """Show which axis points where in both systems."""
    source, target = change.source.pointing.split(), change.target.pointing.split()
    rows = tuple(zip(POINTS, source, target, strict=True))
    return Table(("", change.source.name, change.target.name), rows)


def _verdict(change: AxisChange) -> str:
    hands = ["left" if one.is_left_handed else "right" for one in (change.source, change.target)]
    if change.mirrors:
        told = (
            f"F mirrors, from a {hands[0]}-handed system to a {hands[1]}-handed one: triangles "
            "change their winding"
        )
    else:
        told = f"Both systems are {hands[0]}-handed: F turns, and triangles keep their winding"
    scale = change.unit_scale
    return f"{told}; one unit becomes {scale}." if scale != 1 else f"{told}."


def _remarks(change: AxisChange) -> list[str]:
    x, y, z = (_signed(row) for row in change.rotation)
    sign = "each sign changed, " if change.mirrors else ""
    told = [
        f"A point (x y z) becomes ({x} {y} {z})"
        + (f" · {change.unit_scale}." if change.unit_scale != 1 else ".")
        + f" A quaternion keeps its w, and its x y z go the same way, {sign}never scaled.",
    ]
    sides = {change.source.pointing, change.target.pointing}
    if sides == {axis_system(AxisName.UNITY).pointing, axis_system(AxisName.GLTF).pointing}:
        told.append(
            "Importers of glTF into Unity flip x, where this flips z: an asset's front looks along "
            f'+z, so its axes are "{ASSET}" in place of {AxisName.GLTF}.'
        )
    return told


def _signed(row: RationalVector) -> str:
    """Name the component that a row of a signed permutation takes."""
    index = next(i for i, entry in enumerate(row) if entry)
    return ("−" if row[index] < 0 else "") + LETTERS[index]
