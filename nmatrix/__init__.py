"""nmatrix: the matrices of computer graphics, exact and explained.

Start with `Setup`: one object under a camera, a lens and a light, whose methods are the commands.
Arrays are row-major and hold column-vector matrices; angles are radians or an `Angle` in functions
on arrays, degrees or an `Angle` in a setup, as on the command line. `docs/python.md` has the tour.

>>> import nmatrix
>>> nmatrix.normal_matrix([[1, 0, 0], [0, 2, 0], [0, 0, 4]]).diagonal().tolist()
[1.0, 0.5, 0.25]

Every name is fetched when it is first used: `import nmatrix` loads neither NumPy nor SymPy.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.api.builders import axis_angle as axis_angle
    from nmatrix.api.builders import first_person as first_person
    from nmatrix.api.builders import frustum as frustum
    from nmatrix.api.builders import look_at as look_at
    from nmatrix.api.builders import orthographic as orthographic
    from nmatrix.api.builders import perspective as perspective
    from nmatrix.api.builders import quaternion as quaternion
    from nmatrix.api.builders import rotation as rotation
    from nmatrix.api.builders import viewport as viewport
    from nmatrix.api.builders import world as world
    from nmatrix.api.commands import axes as axes
    from nmatrix.api.commands import calc as calc
    from nmatrix.api.commands import check as check
    from nmatrix.api.commands import check_exercise as check_exercise
    from nmatrix.api.commands import derive as derive
    from nmatrix.api.commands import identify as identify
    from nmatrix.api.commands import inspect as inspect
    from nmatrix.api.commands import lint as lint
    from nmatrix.api.commands import plan as plan
    from nmatrix.api.normals import TransformedNormals as TransformedNormals
    from nmatrix.api.normals import angle_between as angle_between
    from nmatrix.api.normals import classify as classify
    from nmatrix.api.normals import cofactor_matrix as cofactor_matrix
    from nmatrix.api.normals import normal_matrix as normal_matrix
    from nmatrix.api.normals import normalize as normalize
    from nmatrix.api.normals import transform_normals as transform_normals
    from nmatrix.api.pictures import render as render
    from nmatrix.api.report import Picture as Picture
    from nmatrix.api.report import Report as Report
    from nmatrix.api.setup import Setup as Setup
    from nmatrix.api.showing import show as show
    from nmatrix.enums import Api as Api
    from nmatrix.enums import ClipY as ClipY
    from nmatrix.enums import Convention as Convention
    from nmatrix.enums import DepthRange as DepthRange
    from nmatrix.enums import Effort as Effort
    from nmatrix.enums import Format as Format
    from nmatrix.enums import Frame as Frame
    from nmatrix.enums import Handedness as Handedness
    from nmatrix.enums import Kind as Kind
    from nmatrix.enums import Layout as Layout
    from nmatrix.enums import Level as Level
    from nmatrix.enums import NormalMatrixKind as NormalMatrixKind
    from nmatrix.enums import NormalRule as NormalRule
    from nmatrix.enums import NormalStatus as NormalStatus
    from nmatrix.enums import Reflection as Reflection
    from nmatrix.enums import Shading as Shading
    from nmatrix.enums import Space as Space
    from nmatrix.errors import CheckFailedError as CheckFailedError
    from nmatrix.errors import FrameError as FrameError
    from nmatrix.errors import IllegalValueError as IllegalValueError
    from nmatrix.errors import MissingPackageError as MissingPackageError
    from nmatrix.errors import NMatrixError as NMatrixError
    from nmatrix.errors import NoAnswerError as NoAnswerError
    from nmatrix.linear.angle import Angle as Angle
    from nmatrix.linear.classify import Classification as Classification
    from nmatrix.linear.projection import ClipSpace as ClipSpace
    from nmatrix.linear.projection import Window as Window
    from nmatrix.scene.camera import FirstPerson as FirstPerson
    from nmatrix.scene.camera import View as View
    from nmatrix.scene.lens import Lens as Lens
    from nmatrix.scene.setup import Light as Light
    from nmatrix.scene.world import World as World
    from nmatrix.spaces.transform import Transform as Transform

# Where each public name lives: what the type checker reads above, for the running program.
_NAMES = {
    "api.builders": (
        "axis_angle first_person frustum look_at orthographic perspective quaternion rotation "
        "viewport world"
    ),
    "api.normals": (
        "TransformedNormals angle_between classify cofactor_matrix normal_matrix normalize "
        "transform_normals"
    ),
    "api.setup": "Setup",
    "api.commands": "axes calc check check_exercise derive identify inspect lint plan",
    "api.pictures": "render",
    "api.report": "Picture Report",
    "api.showing": "show",
    "scene.world": "World",
    "scene.camera": "FirstPerson View",
    "scene.lens": "Lens",
    "scene.setup": "Light",
    "linear.angle": "Angle",
    "linear.classify": "Classification",
    "linear.projection": "ClipSpace Window",
    "spaces.transform": "Transform",
    "enums": (
        "Api ClipY Convention DepthRange Effort Format Frame Handedness Kind Layout Level "
        "NormalMatrixKind NormalRule NormalStatus Reflection Shading Space"
    ),
    "errors": (
        "CheckFailedError FrameError IllegalValueError MissingPackageError NMatrixError "
        "NoAnswerError"
    ),
}
_MODULES = {name: module for module, names in _NAMES.items() for name in names.split()}

__all__ = ["__version__", *_MODULES]


def __getattr__(name: str) -> object:
    if name in _MODULES:
        found: object = getattr(import_module(f"nmatrix.{_MODULES[name]}"), name)
        globals()[name] = found
        return found
    raise AttributeError(f"module 'nmatrix' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
