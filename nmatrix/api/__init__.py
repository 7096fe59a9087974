"""The Python face: functions on arrays and frozen values, over the exact core.

Arrays are row-major and hold column-vector matrices; angles are radians or an `Angle`. Every
matrix that comes back is the exact one rounded once. Batches run over the leading axes.
"""

from __future__ import annotations

from nmatrix.api.builders import (
    first_person,
    frustum,
    look_at,
    orthographic,
    perspective,
    rotation,
    world,
)
from nmatrix.api.normals import (
    TransformedNormals,
    angle_between,
    classify,
    cofactor_matrix,
    normal_matrix,
    normalize,
    transform_normals,
)
from nmatrix.enums import (
    Api,
    ClipY,
    Convention,
    DepthRange,
    Frame,
    Handedness,
    Kind,
    Level,
    NormalMatrixKind,
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
from nmatrix.linear.classify import Classification
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.spaces.transform import Transform

__all__ = [
    "Angle",
    "Api",
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
    "NormalMatrixKind",
    "NormalStatus",
    "Space",
    "Transform",
    "TransformedNormals",
    "Window",
    "angle_between",
    "classify",
    "cofactor_matrix",
    "first_person",
    "frustum",
    "look_at",
    "normal_matrix",
    "normalize",
    "orthographic",
    "perspective",
    "rotation",
    "transform_normals",
    "world",
]
