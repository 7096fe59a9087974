"""The tables of a scene file, as typed records: what each key means and what it accepts.

The reader checks files against them and the exported schema is made from them, so they agree.
"""

from __future__ import annotations

from typing import Annotated, Literal

from msgspec import Meta, Struct

from nmatrix.enums import (
    Api,
    CameraAxes,
    ClipY,
    Convention,
    DepthRange,
    Handedness,
    Reflection,
    Shading,
    Space,
)
from nmatrix.scene.words import LightKind, Shape, Wrap

MOST_PIXELS = 8192  # on a side
FINEST = 2000  # cells on a side of a shape

# Degrees; or a text as on the command line, of which the reader makes degrees before it checks.
ANGLE = Meta(extra_json_schema={"format": "angle"})
Turn = Annotated[float, ANGLE]
HalfAngle = Annotated[Turn, Meta(ge=0)]
Field = Annotated[Turn, Meta(gt=0, lt=180)]
Three = tuple[float, float, float]
Four = tuple[float, float, float, float]
Level = Annotated[float, Meta(ge=0, le=1)]
NotNegative = Annotated[float, Meta(ge=0)]
# Lists of a fixed length, not tuples: msgspec crashes on a bounded number beside a tuple.
ColourValue = Level | Annotated[list[Level], Meta(min_length=3, max_length=3)]
Cells = Annotated[int, Meta(ge=1, le=FINEST)]
Tessellation = Cells | Annotated[list[Cells], Meta(min_length=1, max_length=2)]
Pixels = Annotated[int, Meta(ge=1, le=MOST_PIXELS)]
Rows = list[list[float]]


class Record(Struct, frozen=True, forbid_unknown_fields=True):
    """A table of a scene file: a key that it does not know is an error."""


class CameraRecord(Record, frozen=True):
    """Where the camera is and how it projects."""

    eye: Annotated[Three | None, Meta(description="The camera's place, 0 0 5 by default.")] = None
    target: Annotated[Three | None, Meta(description="What it looks at, 0 0 0 by default.")] = None
    up: Annotated[Three | None, Meta(description="What is up, 0 1 0 by default.")] = None
    elevation: Annotated[
        Turn | None, Meta(description="Look up by degrees, instead of a target.")
    ] = None
    angle: Annotated[Turn | None, Meta(description="Look sideways by degrees.")] = None
    roll: Annotated[Turn | None, Meta(description="Turn about the view axis by degrees.")] = None
    extrinsics: Annotated[
        Rows | None, Meta(description="Rows of [R t], from the world to an OpenCV camera.")
    ] = None
    pose: Annotated[Rows | None, Meta(description="Rows of world from camera instead.")] = None
    pose_axes: Annotated[
        CameraAxes | None, Meta(description="The camera axes of that pose, opengl by default.")
    ] = None
    convention: Annotated[Convention, Meta(description="How angles make a matrix.")] = (
        Convention.STANDARD
    )
    fov: Annotated[
        Field | None,
        Meta(description="Vertical field of view in degrees, 60 by default."),
    ] = None
    fov_x: Annotated[
        Field | None,
        Meta(description="Horizontal field of view in degrees instead."),
    ] = None
    focal: Annotated[
        Annotated[float, Meta(gt=0)] | None,
        Meta(description="Focal length instead, in the unit of the sensor."),
    ] = None
    sensor: Annotated[
        tuple[float, float] | None, Meta(description="Width and height of the sensor.")
    ] = None
    intrinsics: Annotated[
        Four | None,
        Meta(description="fx, fy, cx, cy in pixels of the viewport, from its upper left corner."),
    ] = None
    angles: Annotated[
        tuple[Turn, Turn, Turn, Turn] | None,
        Meta(description="Left, right, down, up from the view axis in degrees, left, down < 0."),
    ] = None
    viewport: Annotated[
        tuple[float, float] | None,
        Meta(description="The image of intrinsics in pixels, by default the picture."),
    ] = None
    aspect: Annotated[
        Annotated[float, Meta(gt=0)] | None,
        Meta(description="Width over height, by default that of the picture."),
    ] = None
    near: Annotated[float, Meta(description="Near distance.")] = 0.1
    far: Annotated[float, Meta(description="Far distance, or inf.")] = 100.0
    ortho: Annotated[
        Four | None, Meta(description="A parallel view: left, right, bottom, top.")
    ] = None
    frustum: Annotated[
        Four | None, Meta(description="Left, right, bottom, top of the near rectangle.")
    ] = None
    api: Annotated[Api | None, Meta(description="Depth, hand and clip y of an interface.")] = None
    depth: Annotated[DepthRange | None, Meta(description="Depth at near and far.")] = None
    handed: Annotated[Handedness | None, Meta(description="Right looks down −z, left down +z.")] = (
        None
    )
    clip_y: Annotated[ClipY | None, Meta(description="Direction of y in clip space.")] = None


class LightRecord(Record, frozen=True):
    """One light."""

    name: Annotated[str | None, Meta(description="By which --light finds it.")] = None
    kind: Annotated[LightKind, Meta(description="What kind of light.")] = LightKind.DIRECTIONAL
    direction: Annotated[Three | None, Meta(description="In which the light travels.")] = None
    angles: Annotated[
        tuple[Turn, Turn] | None,
        Meta(description="The direction by two angles α and β, in degrees."),
    ] = None
    position: Annotated[Three | None, Meta(description="Of a point or spot light.")] = None
    color: Annotated[ColourValue, Meta(description="One grey level, or red, green, blue.")] = 1.0
    intensity: Annotated[NotNegative, Meta(description="Multiplies the colour.")] = 1.0
    attenuation: Annotated[
        tuple[NotNegative, NotNegative, NotNegative],
        Meta(description="c, l, q of 1 / (c + l·d + q·d²)."),
    ] = (1.0, 0.0, 0.0)
    range: Annotated[
        Annotated[float, Meta(gt=0)] | None,
        Meta(description="Beyond this distance nothing arrives, or inf."),
    ] = None
    cone: Annotated[
        tuple[HalfAngle, HalfAngle] | None,
        Meta(
            description="Inner and outer half angle of a spot light in degrees, 20 30 by default."
        ),
    ] = None
    fixed_to: Annotated[str, Meta(description="world, eye, or the name of an object.")] = "world"
    shadows: Annotated[bool, Meta(description="Whether it casts shadows.")] = False


class ObjectRecord(Record, frozen=True):
    """One object; without a shape, a mesh or a copy it is a group, which only places others."""

    name: Annotated[str | None, Meta(description="By which others refer to it.")] = None
    parent: Annotated[
        str | None, Meta(description="The object whose world matrix stands before its own.")
    ] = None
    shape: Annotated[Shape | None, Meta(description="A built-in shape.")] = None
    mesh: Annotated[
        str | None, Meta(description="An .obj, .ply or .stl file, relative to the scene file.")
    ] = None
    copy_of: Annotated[
        str | None, Meta(description="The object whose triangles and material it shares.")
    ] = None
    tessellation: Annotated[
        Tessellation | None,
        Meta(
            description="Rings (and sectors) of a sphere or torus, sectors of a cone, else cells."
        ),
    ] = None
    translate: Annotated[Three | None, Meta(description="Move.")] = None
    rotate: Annotated[
        tuple[Turn, Turn, Turn] | None, Meta(description="Turn about x, y, z, in degrees.")
    ] = None
    order: Annotated[
        str | None, Meta(description="A permutation of XYZ (intrinsic) or xyz (extrinsic).")
    ] = None
    quaternion: Annotated[Four | None, Meta(description="x, y, z, w instead of angles.")] = None
    axis_angle: Annotated[
        tuple[float, float, float, Turn] | None,
        Meta(description="x, y, z of an axis and degrees instead of angles."),
    ] = None
    scale: Annotated[
        float | Three | None, Meta(description="Stretch, by three numbers or one for all.")
    ] = None
    shear: Annotated[Three | None, Meta(description="x along y, x along z, y along z.")] = None
    convention: Annotated[Convention | None, Meta(description="How angles make a matrix.")] = None
    matrix: Annotated[
        Rows | None, Meta(description="Rows of the whole 3×3 or 4×4 matrix instead.")
    ] = None
    material: Annotated[str | None, Meta(description="A name under [materials].")] = None


class MaterialRecord(Record, frozen=True):
    """What a surface does with light."""

    ambient: Annotated[
        ColourValue | None, Meta(description="Reflected ambient light, grey or r, g, b.")
    ] = None
    diffuse: Annotated[
        ColourValue | None, Meta(description="Light reflected evenly, grey or r, g, b.")
    ] = None
    specular: Annotated[
        ColourValue | None, Meta(description="Light in the highlight, grey or r, g, b.")
    ] = None
    shininess: Annotated[NotNegative, Meta(description="Exponent of the highlight.")] = 32.0
    reflection: Annotated[Reflection, Meta(description="The model of reflection.")] = (
        Reflection.LAMBERT
    )
    unlit: Annotated[
        bool, Meta(description="Whether diffuse is shown as it is, whatever light falls on it.")
    ] = False
    emission: Annotated[ColourValue, Meta(description="Light of its own, grey or r, g, b.")] = 0.0
    opacity: Annotated[Level, Meta(description="1 hides what is behind, 0 is glass.")] = 1.0
    alpha_cutoff: Annotated[
        Level | None,
        Meta(description="Holes where opacity, times the texture's and vertices' own, is below."),
    ] = None
    texture: Annotated[
        str | None, Meta(description='"checker", or an image file relative to the scene file.')
    ] = None
    emission_texture: Annotated[
        str | None, Meta(description="An image that multiplies the emission.")
    ] = None
    normal_map: Annotated[str | None, Meta(description="An image of normals.")] = None
    wrap: Annotated[
        Wrap | Annotated[list[Wrap], Meta(min_length=2, max_length=2)],
        Meta(description="What images show outside of the unit square, along u (and v)."),
    ] = Wrap.REPEAT
    uv_scale: Annotated[
        float | tuple[float, float],
        Meta(description="Multiplies u and v: 2 shows an image twice as often."),
    ] = 1.0
    uv_rotation: Annotated[
        Turn, Meta(description="Then turns u and v counter-clockwise, in degrees.")
    ] = 0.0
    uv_offset: Annotated[tuple[float, float], Meta(description="Then is added to u and v.")] = (
        0.0,
        0.0,
    )
    toon_steps: Annotated[
        Annotated[int, Meta(ge=1, le=64)], Meta(description="Bands of toon reflection.")
    ] = 3
    outline: Annotated[
        Level,
        Meta(description="A black line, as thick as a ball's rim with cosines below this."),
    ] = 0.0
    two_sided: Annotated[
        bool | None,
        Meta(description="Whether backs are drawn; without it, where the mesh is open."),
    ] = None
    vertex_colours: Annotated[bool, Meta(description="Whether to use the mesh's colours.")] = False


class FogRecord(Record, frozen=True):
    """Fog between two distances from the eye."""

    end: Annotated[Annotated[float, Meta(gt=0)], Meta(description="All is fog from here on.")]
    start: Annotated[NotNegative, Meta(description="No fog up to here.")] = 0.0
    color: Annotated[
        ColourValue | None, Meta(description="Grey or r, g, b, by default the background.")
    ] = None


class RenderRecord(Record, frozen=True):
    """How the scene is drawn."""

    space: Annotated[Space, Meta(description="The space to compute light in.")] = Space.WORLD
    space_matrix: Annotated[
        Rows | None, Meta(description="Rows of space from world, for space custom.")
    ] = None
    shading: Annotated[Shading, Meta(description="Light per face, vertex or fragment.")] = (
        Shading.PHONG
    )
    size: Annotated[tuple[Pixels, Pixels], Meta(description="Width and height in pixels.")] = (
        512,
        512,
    )
    samples: Annotated[Literal[1, 4, 16, 64], Meta(description="Samples of each pixel.")] = 4
    background: Annotated[
        ColourValue, Meta(description="Colour behind everything, grey or r, g, b.")
    ] = 0.93
    fog: Annotated[FogRecord | None, Meta(description="A table with start, end and color.")] = None
    gamma: Annotated[bool, Meta(description="Write sRGB instead of linear levels.")] = False
    depth_bits: Annotated[
        Literal[16, 24, "float32", "full"], Meta(description="How finely depth is stored.")
    ] = "full"
    shadow_map: Annotated[
        Annotated[int, Meta(ge=16, le=MOST_PIXELS)],
        Meta(description="Pixels on a side of a shadow map."),
    ] = 512


class SceneRecord(Record, frozen=True):
    """A scene: objects, lights, a camera, materials, and how to draw it."""

    object: Annotated[
        list[ObjectRecord], Meta(description="The objects, each under [[object]].", min_length=1)
    ]
    camera: Annotated[
        CameraRecord | None, Meta(description="The camera; without it, one that sees everything.")
    ] = None
    light: Annotated[
        list[LightRecord],
        Meta(description="The lights, each under [[light]]; without one, daylight."),
    ] = []
    materials: Annotated[dict[str, MaterialRecord], Meta(description="Materials by name.")] = {}
    render: Annotated[RenderRecord, Meta(description="How to draw it.")] = RenderRecord()
