"""How a scene file is drawn: its camera, its materials and its settings."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from msgspec.structs import asdict

from nmatrix.enums import Convention, Handedness, Space
from nmatrix.errors import NMatrixError
from nmatrix.linear.projection import (
    DEFAULT_CLIP_SPACE,
    ClipSpace,
    Window,
    clip_space_over,
)
from nmatrix.scene.camera import FirstPerson, View
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import AMBIENT_SHARE, Colour, Material, Texture, colour
from nmatrix.scene.scene import Fog, Settings
from nmatrix.scene.toml.records import CameraRecord, FogRecord, MaterialRecord, RenderRecord
from nmatrix.scene.toml.table import SceneTable
from nmatrix.scene.words import DepthBuffer, Pattern, Sides, Wrap

IMAGES = ("texture", "emission_texture", "normal_map")
PLACING = ("wrap", "uv_scale", "uv_rotation", "uv_offset")
SIDES = {None: Sides.AS_NEEDED, True: Sides.BOTH, False: Sides.FRONT}


def camera(table: SceneTable, aspect: float) -> tuple[View, Lens]:
    """Return the camera and its lens; `aspect` is the picture's.

    Raises
    ------
    IllegalValueError
        For contradictions, an eye that is its target, distances out of order.
    """
    record = table.checked(CameraRecord)
    clip = clip_space_over(DEFAULT_CLIP_SPACE, asdict(record))
    view, lens = _view(table, record, clip.handed), _lens(table, record, clip, aspect)
    _check_distances(table, record)
    try:
        view.placed()
        _ = lens.clip_from_camera
    except NMatrixError as error:
        raise table.refused("the camera", str(error), "") from None
    return view, lens


def _view(table: SceneTable, record: CameraRecord, handed: Handedness) -> View:
    angles = [key for key in ("elevation", "angle", "roll") if key in table.raw]
    if angles:
        table.refuse_beside(angles[0], ("target", "up"), "both say where to look")
        if handed is Handedness.LEFT:
            because = "the angles are for a camera that looks down −z"
            table.refuse_beside(angles[0], ("handed", "api"), because)
    elif record.convention is not Convention.STANDARD:
        raise table.fault("convention", "it is about elevation and angle", "add them")
    turned = FirstPerson(record.elevation or 0.0, record.angle or 0.0, record.roll or 0.0)
    return View(
        eye=record.eye or View.eye,
        target=record.target or View.target,
        up=record.up or View.up,
        angles=turned if angles else None,
        handed=handed,
        convention=record.convention,
    )


def _lens(table: SceneTable, record: CameraRecord, clip: ClipSpace, aspect: float) -> Lens:
    if record.ortho is not None:
        table.refuse_beside("ortho", ("fov", "aspect", "frustum"), "both shape the view")
    if record.frustum is not None:
        table.refuse_beside("frustum", ("fov", "aspect"), "both shape the view")
    return Lens(
        fov_degrees=record.fov or Lens.fov_degrees,
        aspect=record.aspect or aspect,
        near=record.near,
        far=record.far,
        ortho=None if record.ortho is None else Window(*record.ortho),
        frustum=None if record.frustum is None else Window(*record.frustum),
        clip=clip,
    )


def _check_distances(table: SceneTable, record: CameraRecord) -> None:
    if record.ortho is None and record.near <= 0:
        raise table.fault("near", "a perspective view needs it above 0", "try near = 0.1")
    if record.near >= record.far:
        key = "far" if "far" in table.raw else "near"
        raise table.fault(key, f"near is {record.near:g} and far is {record.far:g}", "swap them")


def material(table: SceneTable, name: str) -> Material:
    """Return a material.

    Raises
    ------
    IllegalValueError
        For levels out of bounds and for images that are missing.
    """
    record = table.checked(MaterialRecord)
    placing = [key for key in PLACING if key in table.raw]
    images = [key for key in IMAGES if getattr(record, key) is not None]
    if placing and not images:
        raise table.fault(placing[0], "there is no image to place", "add texture or normal_map")
    if record.emission_texture is not None and "emission" not in table.raw:
        raise table.fault(
            "emission_texture", "it multiplies emission, which is 0", "add emission = 1"
        )
    own = Material(
        name=name,
        shininess=record.shininess,
        reflection=record.reflection,
        emission=colour(record.emission),
        opacity=record.opacity,
        has_alpha=record.alpha_cutoff is not None,
        alpha_cutoff=record.alpha_cutoff,
        toon_steps=record.toon_steps,
        outline=record.outline,
        vertex_colours=record.vertex_colours,
        sides=SIDES[record.two_sided],
    )
    drawn: dict[str, Any] = {key: _texture(table, record, key) for key in images}
    coloured = replace(own, **drawn, **_colours(record))
    return coloured.without_light() if record.unlit else coloured


def _texture(table: SceneTable, record: MaterialRecord, key: str) -> Texture:
    """Return the image of a key, placed as all images of the material are."""
    is_pattern = key == "texture" and record.texture in set(Pattern)
    wrap, scale = record.wrap, record.uv_scale
    return Texture(
        Pattern(table.raw[key]) if is_pattern else table.file(key),
        (wrap, wrap) if isinstance(wrap, Wrap) else (wrap[0], wrap[1]),
        scale if isinstance(scale, tuple) else (scale, scale),
        record.uv_rotation,
        record.uv_offset,
    )


def _colours(record: MaterialRecord) -> dict[str, Any]:
    """Return the colours that were given; ambient follows diffuse."""
    given: dict[str, Any] = {}
    if record.diffuse is not None:
        given["diffuse"] = colour(record.diffuse)
        given["ambient"] = tuple(AMBIENT_SHARE * channel for channel in given["diffuse"])
    if record.ambient is not None:
        given["ambient"] = colour(record.ambient)
    if record.specular is not None:
        given["specular"] = colour(record.specular)
    return given


def settings(table: SceneTable) -> Settings:
    """Return the settings of the table [render].

    Raises
    ------
    IllegalValueError
        For values out of bounds, and a space matrix without its space.
    """
    if isinstance(table.raw, dict) and isinstance(table.raw.get("fog"), dict):
        table.inner("fog").checked(FogRecord)  # so that its faults are told under its own header
    record = table.checked(RenderRecord)
    if record.space_matrix is None and record.space is Space.CUSTOM:
        raise table.fault("space", "it needs its matrix", "add space_matrix")
    if record.space_matrix is not None and record.space is not Space.CUSTOM:
        raise table.refused(
            f"space_matrix with space {record.space}",
            "only custom space takes a matrix",
            'write space = "custom"',
        )
    background = colour(record.background)
    return Settings(
        space=record.space,
        space_matrix=None
        if record.space_matrix is None
        else table.affine_matrix("space_matrix", record.space_matrix),
        shading=record.shading,
        size=record.size,
        samples=record.samples,
        background=background,
        fog=None if record.fog is None else _fog(table.inner("fog"), record.fog, background),
        gamma=record.gamma,
        depth=DepthBuffer(str(record.depth_bits)),
        shadow_map=record.shadow_map,
    )


def _fog(table: SceneTable, record: FogRecord, background: Colour) -> Fog:
    if record.start >= record.end:
        raise table.fault("start", f"it is not before the end, {record.end:g}", "swap them")
    own = background if record.color is None else colour(record.color)
    return Fog(own, record.start, record.end)
