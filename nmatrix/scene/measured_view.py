"""Views as cameras are measured: the extrinsic matrix of computer vision, and the pose.

A camera of OpenCV and COLMAP looks down +z with y down, one of OpenGL down −z with y up: half a
turn about x, F = diag(1, −1, −1), leads from one to the other. Of extrinsics V = F · [R t], of a
pose with OpenCV's axes V = F · pose⁻¹, of one with OpenGL's V = pose⁻¹.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from nmatrix.enums import CameraAxes, chosen
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.linear.rational import (
    ONE,
    RationalMatrix,
    RationalVector,
    determinant,
    diagonal,
    inverse,
    linear_part,
    product,
    translation,
)
from nmatrix.linear.values import named, read_fields, refused
from nmatrix.reading.arrays import read_affine

OTHER_AXES: RationalMatrix = diagonal((ONE, -ONE, -ONE, ONE))


@dataclass(frozen=True)
class Extrinsics:
    """[R t], from the world to a camera with OpenCV's axes."""

    matrix: RationalMatrix

    def __post_init__(self) -> None:
        read_fields(self, matrix=named("extrinsics", read_affine))
        _check_way_back(self.matrix, "extrinsics")

    @property
    def camera_from_world(self) -> RationalMatrix:
        """The view matrix.

        Examples
        --------
        >>> found = Extrinsics(((1, 0, 0, 2), (0, 1, 0, 3), (0, 0, 1, 4), (0, 0, 0, 1)))
        >>> [int(row[3]) for row in found.camera_from_world]
        [2, -3, -4, 1]
        """
        return product(OTHER_AXES, self.matrix)

    @property
    def eye(self) -> RationalVector:
        """Where the camera is in the world, −R⁻¹ t."""
        return translation(inverse(self.matrix))


@dataclass(frozen=True)
class Pose:
    """Where a camera is and how it is turned, from the camera to the world."""

    matrix: RationalMatrix
    axes: CameraAxes = CameraAxes.OPENGL

    def __post_init__(self) -> None:
        read_fields(
            self,
            matrix=named("pose", read_affine),
            axes=lambda given, _: chosen(CameraAxes, given, "pose_axes"),
        )
        _check_way_back(self.matrix, "pose")

    @property
    def camera_from_world(self) -> RationalMatrix:
        """The view matrix.

        Examples
        --------
        >>> found = Pose(((1, 0, 0, 2), (0, 1, 0, 3), (0, 0, 1, 4), (0, 0, 0, 1)), "opencv")
        >>> [int(row[3]) for row in found.camera_from_world]
        [-2, 3, 4, 1]
        """
        back = inverse(self.matrix)
        return product(OTHER_AXES, back) if self.axes is CameraAxes.OPENCV else back

    @property
    def eye(self) -> RationalVector:
        """Where the camera is in the world, as it was given."""
        return translation(self.matrix)


MeasuredView = Extrinsics | Pose


def measured_view(given: object, name: str) -> MeasuredView:
    """Read a camera that is given as `extrinsics`, or as `pose` and perhaps `pose_axes`.

    Examples
    --------
    >>> measured_view({"pose": [[1, 0, 0, 5], [0, 1, 0, 0], [0, 0, 1, 0]]}, "measured").axes
    <CameraAxes.OPENGL: 'opengl'>
    """
    if isinstance(given, Extrinsics | Pose):
        return given
    if isinstance(given, Mapping) and given.keys() == {"extrinsics"}:
        return Extrinsics(given["extrinsics"])
    if isinstance(given, Mapping) and {"pose"} <= given.keys() <= {"pose", "pose_axes"}:
        return Pose(given["pose"], given.get("pose_axes", CameraAxes.OPENGL))
    raise refused(given, name, "it is no camera as they are measured", "give a dict of its pose")


def _check_way_back(matrix: RationalMatrix, name: str) -> None:
    if not determinant(linear_part(matrix)):
        raise NoAnswerError(
            f"{quantity(name)} (determinant 0)",
            "it flattens space, so it is no place of a camera",
            "give an invertible matrix",
        )
