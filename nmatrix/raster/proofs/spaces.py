"""The proof that one scene shaded in five spaces is one picture.

Above, where things are in each space: all of the world is carried there by the space's own matrix,
floor and lamp and eye with it, and looked at from the side. Below, what the eye sees, computed in
that space.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from math import log10
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import Verdict, disc
from nmatrix.canvas.marks import Box
from nmatrix.canvas.slide import HEADING_AT, STAGE_AT, Panel, Slide
from nmatrix.enums import NormalRule, Reflection, Space
from nmatrix.errors import NoAnswerError
from nmatrix.linear import rational
from nmatrix.linear.rational import RationalMatrix, identity, linear_part
from nmatrix.raster.drawn_scene import level_difference
from nmatrix.raster.loaded_scene import Body, LoadedScene, loaded
from nmatrix.raster.overlay.stage import Stage, filling
from nmatrix.raster.overlay.tacks import farthest_apart
from nmatrix.raster.proofs.angles import normals_by
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.staging import Pose, ball, draw_on
from nmatrix.raster.shading.space import as_array
from nmatrix.report import Vector
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

Array = NDArray[Any]

SKEWED = World(
    translate=(0.5, 1.3, 0), scale=(0.9, 1.3, 0.9), rotate_degrees=(0, 25, -14), shear=(0.35, 0, 0)
)
LAMP = SceneLight("lamp", LightKind.POINT, position=(-2.2, 3.2, 2.6))
FROM_THE_SIDE = Pose((3.4, 1.3, 4.2), radius=1.9, room=0.05)
GUTTER = 16.0
LOWER, BETWEEN, BELOW = 214.0, 88.0, 84.0  # units: a picture, the captions above it, the footer
ALIKE = 1e-9  # of full brightness: rounding
CELLS = 6  # of the floor, along an edge
MOST_DOTS, DOTS_APART = 90, 9.0  # vertices that are drawn, and units between them
SIDE, FRONT = (1.7, 0.9, 1.0), (0.5, 0.75, 2.4)
COUNT = {5: "Five", 4: "Four", 3: "Three"}


@dataclass(frozen=True)
class Standpoint:
    """A space, the direction in it from which its stage is seen, and what is so in it."""

    space: Space
    seen_from: Vector
    caption: str
    without: str = ""


STANDPOINTS = (
    Standpoint(
        Space.OBJECT, FRONT, "the shape is plain; lamp and eye are moved by M^{−1}", "no M^{−1}"
    ),
    Standpoint(Space.WORLD, FRONT, "everything stands where you put it"),
    Standpoint(Space.CAMERA, SIDE, "the eye is the origin and looks down −z"),
    Standpoint(
        Space.LIGHT, SIDE, "the lamp is the origin and looks down −z", "no direction of the light"
    ),
    Standpoint(Space.STATIC, FRONT, "M is baked into every vertex; then M = I"),
)


def spaces(settings: ProofSettings) -> Proof:
    """Draw one scene in five shading spaces, and where things are in each of them."""
    one = settings.object(
        settings.placed(SKEWED),
        settings.geometry(LoadedGeometry(letter_r())),
        reflection=settings.reflection or Reflection.BLINN_PHONG,
    )
    scene = settings.scene(one, lights=(LAMP,))
