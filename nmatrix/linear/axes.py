"""Axis systems: which of its own axes a program points right, up and forward, and what maps them.

B holds a system's right, up and forward in its columns, so B⁻¹ = Bᵀ tells a vector by them. From
one system to another goes F = unit scale · B_to · B_fromᵀ: right to right, up to up, forward to
forward. A matrix M of one becomes F · M · F⁻¹ of the other.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import AxisName
from nmatrix.errors import IllegalValueError, did_you_mean, printable
from nmatrix.linear.rational import (
    ONE,
    ZERO,
    RationalMatrix,
    affine_matrix,
    determinant,
    inverse,
    product,
    transpose,
)

LETTERS = "xyz"
_OWN = re.compile(r"([+-]?[xyz])[\s,]+([+-]?[xyz])[\s,]+([+-]?[xyz])")


_POINTING = {
    AxisName.OPENGL: "+x +y -z",
    AxisName.GLTF: "+x +y -z",
    AxisName.THREE: "+x +y -z",
    AxisName.MAYA: "+x +y -z",
    AxisName.GODOT: "+x +y -z",
    AxisName.BLENDER: "+x +z +y",
    AxisName.USD_Z_UP: "+x +z +y",
    AxisName.UNITY: "+x +y +z",
    AxisName.DIRECTX: "+x +y +z",
    AxisName.UNREAL: "+y +z +x",
    AxisName.OPENCV: "+x -y +z",
    AxisName.ROS: "-y +z +x",
}
_UNITS_IN_A_METRE = {AxisName.UNREAL: 100}


@dataclass(frozen=True)
class AxisSystem:
    """A system of axes: its name or the three signed axes that point right, up and forward.

    Examples
    --------
    >>> blender = axis_system("blender")
    >>> blender.pointing, blender.is_left_handed, axis_system("unity").is_left_handed
    ('+x +z +y', False, True)
    """

    name: str
    pointing: str
    units_in_a_metre: int = 1

    @property
    def basis(self) -> RationalMatrix:
        """Right, up and forward in the columns of a 3×3 matrix."""
        return transpose(tuple(map(_axis, self.pointing.split())))

    @property
    def is_left_handed(self) -> bool:
        """Whether right × up, computed in its numbers, points forward and not backward."""
        return determinant(self.basis) > 0


def axis_system(text: str) -> AxisSystem:
    """Read a system by its name, or three signed axes for right, up and forward.

    Raises
    ------
    IllegalValueError
        For another name, and for axes of which one is missing.

    Examples
    --------
    >>> axis_system("+x, z, +y").pointing
    '+x +z +y'
    """
    word = text.strip().lower()
    if word in set(AxisName):
        name = AxisName(word)
        return AxisSystem(name.value, _POINTING[name], _UNITS_IN_A_METRE.get(name, 1))
    own = _OWN.fullmatch(word)
    if own is None:
        raise IllegalValueError(
            f"axis system ({printable(text)})",
            f"it is {', '.join(AxisName)}, or the axes that point right, up and forward",
            did_you_mean(word, AxisName, 'try "+x +z +y"'),
        )
    axes = [axis if len(axis) == 2 else f"+{axis}" for axis in own.groups()]
    if len({axis[1] for axis in axes}) < len(axes):
        missing = ", ".join(letter for letter in LETTERS if not any(letter in a for a in axes))
        why = f"right, up and forward are three different axes: {missing} is missing"
        raise IllegalValueError(f"axis system ({printable(text)})", why, 'try "+x +z +y"')
    return AxisSystem(" ".join(axes), " ".join(axes))


@dataclass(frozen=True)
class AxisChange:
    """The way from one axis system to another.

    Examples
    --------
    >>> change = AxisChange(axis_system("blender"), axis_system("opengl"))
    >>> [[int(x) for x in row[:3]] for row in change.to_from[:3]]
    [[1, 0, 0], [0, 0, 1], [0, -1, 0]]
    >>> change.mirrors, AxisChange(axis_system("opengl"), axis_system("unreal")).unit_scale
    (False, Fraction(100, 1))
    """

    source: AxisSystem
    target: AxisSystem

    @property
    def unit_scale(self) -> Fraction:
        """How many of the target's units one unit of the source is."""
        return Fraction(self.target.units_in_a_metre, self.source.units_in_a_metre)

    @property
    def rotation(self) -> RationalMatrix:
        """The 3×3 block without the unit scale: a signed permutation."""
        return product(self.target.basis, transpose(self.source.basis))

    @property
    def to_from(self) -> RationalMatrix:
        """F, the affine 4×4 matrix that carries points."""
        scaled = tuple(tuple(self.unit_scale * x for x in row) for row in self.rotation)
        return affine_matrix(scaled)

    @property
    def mirrors(self) -> bool:
        """Whether one system is right-handed and the other left-handed."""
        return determinant(self.rotation) < 0

    def of_matrix(self, M: RationalMatrix) -> RationalMatrix:
        """Tell a matrix between two frames of the source in the target: F · M · F⁻¹."""
        F = self.to_from
        return product(F, M, inverse(F))


def axis_change(names: Sequence[str]) -> AxisChange:
    """Read two axis systems, from and to.

    Raises
    ------
    IllegalValueError
        For another count of them, and for one that is none.

    Examples
    --------
    >>> axis_change(("blender", "opengl")).target.name
    'opengl'
    """
    is_list = isinstance(names, Sequence) and not isinstance(names, str)
    if not is_list or len(names) != 2 or not all(isinstance(name, str) for name in names):
        raise IllegalValueError(
            f"axes ({printable(str(names))})",
            "it is two axis systems, from and to",
            'try ("blender", "opengl")',
        )
    source, target = map(axis_system, names)
    return AxisChange(source, target)


def _axis(signed: str) -> tuple[Fraction, ...]:
    sign = -ONE if signed[0] == "-" else ONE
    return tuple(sign if letter == signed[1] else ZERO for letter in LETTERS)
