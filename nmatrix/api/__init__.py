"""The Python face: functions on arrays and frozen values, over the exact core.

Arrays are row-major and hold column-vector matrices; angles are radians or an `Angle`. Every
matrix that comes back is the exact one rounded once. Batches run over the leading axes, one exact
computation each.
"""

from __future__ import annotations

from nmatrix.api.batches import (
    classify,
    cofactor_matrix,
    normal_matrix,
    normalize,
    transform_normals,
)
from nmatrix.api.builders import (
    first_person,
    frustum,
    look_at,
    orthographic,
    perspective,
    rotation,
    world,
)
from nmatrix.api.certified import carry_normals, certified_normals, normal_matrices
from nmatrix.enums import (
    Api,
    ClipY,
    Convention,
    DepthRange,
    Frame,
    Handedness,
    Kind,
    Level,
    NormalStatus,
    Space,
)
from nmatrix.errors import (
    FrameError,
    IllegalValueError,
    MissingPackageError,
    NMatrixError,
    NoAnswerError,
)
from nmatrix.linear.angle import Angle
from nmatrix.linear.certified import CertifiedNormals
from nmatrix.linear.classify import Classification
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.linear.vectors import angle_between
from nmatrix.spaces.transform import Transform

__all__ = [
    "Angle",
    "Api",
    "CertifiedNormals",
    "Classification",
    "ClipSpace",
    "ClipY",
    "Convention",
    "DepthRange",
    "Frame",
    "FrameError",
    "Handedness",
    "IllegalValueError",
    "Kind",
    "Level",
    "MissingPackageError",
    "NMatrixError",
    "NoAnswerError",
    "NormalStatus",
    "Space",
    "Transform",
    "Window",
    "angle_between",
    "carry_normals",
    "certified_normals",
    "classify",
    "cofactor_matrix",
    "first_person",
    "frustum",
    "look_at",
    "normal_matrices",
    "normal_matrix",
    "normalize",
    "orthographic",
    "perspective",
    "rotation",
    "transform_normals",
    "world",
]
