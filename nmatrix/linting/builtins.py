"""What languages and engines declare themselves: their variables, structs and functions.

Sources: the GLSL 1.20 specification (§7.5), three.js's WebGLProgram, Unity's UnityCG.cginc and
SpaceTransforms.hlsl, Blender's draw_view_lib.glsl.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

from nmatrix.linting.tree import Span, Stage, Storage, Struct, Variable
from nmatrix.linting.values import (
    Because,
    Carried,
    Fourth,
    Length,
    Matrix,
    Role,
    Sense,
    ShaderSpace,
    Value,
    Vector,
)

_OBJECT, _WORLD, _CAMERA, _CLIP = (
    ShaderSpace.OBJECT,
    ShaderSpace.WORLD,
    ShaderSpace.CAMERA,
    ShaderSpace.CLIP,
)


def _matrix(to: ShaderSpace, source: ShaderSpace, size: int = 4) -> Matrix:
    return Matrix(to, source, size=size, because=Because.BUILT_IN)


_POINT = Vector(
    Carried.POINT,
    _OBJECT,
    4,
    Fourth.ONE,
    is_assumed=True,
    because=Because.BUILT_IN,
    origin="vertex",
)
_NORMAL = Vector(
    Carried.NORMAL,
    _OBJECT,
    3,
    length=Length.UNIT,
    is_assumed=True,
    because=Because.BUILT_IN,
    origin="normal",
)
_EYE = Vector(Carried.POINT, _WORLD, 3, role=Role.EYE, because=Because.BUILT_IN, origin="eye")
_NORMAL_MATRIX = replace(_matrix(_OBJECT, _CAMERA, 3), is_transposed=True)

# Only a word that begins with `gl_` or that no file declares is one of these.
VARIABLES: dict[str, Value] = {
    "gl_Vertex": _POINT,
    "gl_Normal": _NORMAL,
    "gl_NormalMatrix": _NORMAL_MATRIX,
    "normalMatrix": _NORMAL_MATRIX,
    "cameraPosition": _EYE,
    "_WorldSpaceCameraPos": _EYE,
    "_WorldSpaceLightPos0": Vector(
        Carried.POINT, _WORLD, 4, role=Role.LIGHT, because=Because.BUILT_IN, origin="light"
    ),
    "_MainLightPosition": Vector(
        Carried.DIRECTION, _WORLD, 4, role=Role.LIGHT, sense=Sense.OUT, because=Because.BUILT_IN
    ),
    "unity_ObjectToWorld": _matrix(_WORLD, _OBJECT),
    "unity_WorldToObject": _matrix(_OBJECT, _WORLD),
    "_Object2World": _matrix(_WORLD, _OBJECT),
    "_World2Object": _matrix(_OBJECT, _WORLD),
    "unity_MatrixV": _matrix(_CAMERA, _WORLD),
    "unity_MatrixVP": _matrix(_CLIP, _WORLD),
    "UNITY_MATRIX_M": _matrix(_WORLD, _OBJECT),
    "UNITY_MATRIX_I_M": _matrix(_OBJECT, _WORLD),
    "UNITY_MATRIX_V": _matrix(_CAMERA, _WORLD),
    "UNITY_MATRIX_I_V": _matrix(_WORLD, _CAMERA),
    "UNITY_MATRIX_P": _matrix(_CLIP, _CAMERA),
    "UNITY_MATRIX_VP": _matrix(_CLIP, _WORLD),
    "UNITY_MATRIX_MV": _matrix(_CAMERA, _OBJECT),
    "UNITY_MATRIX_MVP": _matrix(_CLIP, _OBJECT),
    "UNITY_MATRIX_T_MV": _matrix(_CAMERA, _OBJECT).transposed,
    "UNITY_MATRIX_IT_MV": _matrix(_OBJECT, _CAMERA).transposed,
}
for _name, _frames in {
    "ModelView": (_CAMERA, _OBJECT),
    "Projection": (_CLIP, _CAMERA),
    "ModelViewProjection": (_CLIP, _OBJECT),
}.items():
    _one = _matrix(*_frames)
    VARIABLES[f"gl_{_name}Matrix"] = _one
    VARIABLES[f"gl_{_name}MatrixInverse"] = _one.inverse
    VARIABLES[f"gl_{_name}MatrixTranspose"] = _one.transposed
    VARIABLES[f"gl_{_name}MatrixInverseTranspose"] = _one.inverse.transposed

# Attributes that three.js declares before the text of a ShaderMaterial.
ATTRIBUTES: dict[str, Value] = {
    "position": replace(_POINT, size=3, w=None),
    "normal": _NORMAL,
    "tangent": Vector(Carried.TANGENT, _OBJECT, 4, is_assumed=True, because=Because.BUILT_IN),
}

_LIGHT = Vector(Carried.POINT, _CAMERA, 4, role=Role.LIGHT, because=Because.BUILT_IN)
FIELDS: dict[str, dict[str, Value]] = {
    "gl_LightSource": {
        "position": _LIGHT,
        "halfVector": replace(_LIGHT, kind=Carried.DIRECTION, role=Role.HALFWAY, sense=Sense.OUT),
        "spotDirection": replace(_LIGHT, kind=Carried.DIRECTION, size=3, role=None),
    }
}

_NOWHERE = Span("", 0, 0)


def _struct(name: str, **fields: str) -> Struct:
    return Struct(
        name, tuple(Variable(_NOWHERE, one, type_, Storage.LOCAL) for one, type_ in fields.items())
    )


_APPDATA = {"vertex": "vec4", "normal": "vec3", "texcoord": "vec4"}
STRUCTS = (
    _struct("appdata_base", **_APPDATA),
    _struct("appdata_tan", **_APPDATA, tangent="vec4"),
    _struct("appdata_full", **_APPDATA, tangent="vec4", color="vec4"),
)


@dataclass(frozen=True)
class Moving:
    """A function that multiplies its argument by a matrix, and maybe normalises it."""

    matrix: Matrix
    w: Fourth | None
    is_unit: bool = False


@dataclass(frozen=True)
class Giving:
    """A function whose value does not depend on what its argument is."""

    value: Vector


_M, _V = _matrix(_WORLD, _OBJECT), _matrix(_CAMERA, _WORLD)
_MVP, _MV, _VP = _matrix(_CLIP, _OBJECT), _matrix(_CAMERA, _OBJECT), _matrix(_CLIP, _WORLD)
_ONE, _ZERO = Fourth.ONE, Fourth.ZERO


def _direction(space: ShaderSpace, role: Role) -> Giving:
    return Giving(
        Vector(
            Carried.DIRECTION,
            space,
            3,
            role=role,
            sense=Sense.OUT,
            because=Because.BUILT_IN,
        )
    )


FUNCTIONS: dict[str, Moving | Giving] = {
    "UnityObjectToClipPos": Moving(_MVP, _ONE),
    "UnityObjectToViewPos": Moving(_MV, _ONE),
    "UnityObjectToWorldNormal": Moving(_M.inverse.transposed, _ZERO, is_unit=True),
    "UnityObjectToWorldDir": Moving(_M, _ZERO, is_unit=True),
    "UnityWorldToObjectDir": Moving(_M.inverse, _ZERO, is_unit=True),
    "UnityWorldToViewPos": Moving(_V, _ONE),
    "UnityWorldToClipPos": Moving(_VP, _ONE),
    "TransformObjectToWorld": Moving(_M, _ONE),
    "TransformObjectToHClip": Moving(_MVP, _ONE),
    "TransformObjectToWorldNormal": Moving(_M.inverse.transposed, _ZERO, is_unit=True),
    "TransformObjectToWorldDir": Moving(_M, _ZERO, is_unit=True),
    "TransformWorldToView": Moving(_V, _ONE),
    "TransformWorldToViewDir": Moving(_V, _ZERO),
    "TransformWorldToHClip": Moving(_VP, _ONE),
    "UnityWorldSpaceLightDir": _direction(_WORLD, Role.LIGHT),
    "WorldSpaceLightDir": _direction(_WORLD, Role.LIGHT),
    "ObjSpaceLightDir": _direction(_OBJECT, Role.LIGHT),
    "UnityWorldSpaceViewDir": _direction(_WORLD, Role.EYE),
    "WorldSpaceViewDir": _direction(_WORLD, Role.EYE),
    "ObjSpaceViewDir": _direction(_OBJECT, Role.EYE),
    "GetWorldSpaceViewDir": _direction(_WORLD, Role.EYE),
    "GetWorldSpaceNormalizeViewDir": _direction(_WORLD, Role.EYE),
    "normal_object_to_world": Moving(_M.inverse.transposed, _ZERO, is_unit=True),
    "normal_object_to_view": Moving(_MV.inverse.transposed, _ZERO, is_unit=True),
    "point_object_to_world": Moving(_M, _ONE),
    "point_object_to_view": Moving(_MV, _ONE),
    "point_object_to_ndc": Moving(_MVP, _ONE),
    "point_world_to_view": Moving(_V, _ONE),
    "point_world_to_ndc": Moving(_VP, _ONE),
}


def built_in(name: str, stage: Stage) -> Value | None:
    """Find what a name means that no file declares.

    Examples
    --------
    >>> built_in("gl_NormalMatrix", Stage.VERTEX).told
    'object_from_cameraᵀ'
    >>> built_in("normal", Stage.FRAGMENT) is None
    True
    """
    if name in ATTRIBUTES:
        return ATTRIBUTES[name] if stage is Stage.VERTEX else None
    return VARIABLES.get(name)
