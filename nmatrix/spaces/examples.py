"""Small stages whose numbers can be checked by hand, for doctests and lessons."""

from __future__ import annotations

from fractions import Fraction
from math import inf

from nmatrix.enums import Frame
from nmatrix.linear.affine import compose, translation_matrix
from nmatrix.linear.angle import Angle
from nmatrix.linear.projection import perspective
from nmatrix.linear.rational import identity, rational_matrix, rational_vector
from nmatrix.spaces.exact_maps import ExactMaps, WorldLight
from nmatrix.spaces.transform import Transform


def tall_object() -> ExactMaps:
    """Return an object twice as tall, a camera 5 away, a light travelling along (1, −1, 0)."""
    return ExactMaps(
        world_from_object=Transform(
            Frame.WORLD, Frame.OBJECT, compose(identity(3), scale=(1, 2, 1))
        ),
        camera_from_world=Transform(Frame.CAMERA, Frame.WORLD, translation_matrix((0, 0, -5))),
        clip_from_camera=rational_matrix(perspective(Angle.degrees(45), 1.0, 1.0, inf)),
        eye=rational_vector((0, 0, 5)),
        light=WorldLight(rational_vector((1, -1, 0)), (Fraction(0), Fraction(3), Fraction(0))),
    )
