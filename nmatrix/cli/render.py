"""`nmatrix render`: proof images, scenes and meshes to a file, their numbers to stdout."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.pictures import FileOptions, FrameOptions, PictureOptions, frame_names
from nmatrix.cli.scene_options import DrawnScene, OptionGroups
from nmatrix.cli.shared_options import CommonOptions, among
from nmatrix.cli.show import progress, put, put_bytes, show, show_picture
from nmatrix.enums import Format, PixelFormat
from nmatrix.errors import IllegalValueError, printable
from nmatrix.output.files import PICTURES, SLIDES, kind_of, refuse_existing, write_file
from nmatrix.raster.proofs.catalogue import PROOFS, catalogued
from nmatrix.samples import file_or_sample, samples
from nmatrix.scene.lens import SHAPES
from nmatrix.scene.scene import SceneObject

if TYPE_CHECKING:
    from collections.abc import Sequence

    from nmatrix.enums import VectorFormat
    from nmatrix.raster.proofs.frames import PictureFrame
    from nmatrix.raster.proofs.proof import Proof

HELP = {
    "render": """nmatrix render normals --scale 1 2 1

nmatrix render normals --mesh teapot --shear 1 0 0 -o teapot.png

nmatrix render sample --frames 12 --turn --size 280 210 -o sample.gif

Between wrong and right stands the number by which they differ.""",
}


def _subjects() -> list[str]:
    return [*(one.name for one in PROOFS), *samples(".toml", ".obj")]


def render(
    *,
    groups: OptionGroups,
    picture: PictureOptions,
    frames: FrameOptions,
    file: FileOptions,
    common: CommonOptions,
    subject: Annotated[
        str,
        Argument(
            metavar="PROOF|SCENE|MESH",
            help="A proof (see --list), or a file.",
            autocompletion=among(_subjects),
        ),
    ] = "normals",
    mesh: Annotated[
        str | None,
        Option(
            metavar="FILE",
            help="Draw a proof of this mesh.",
            autocompletion=among(samples, ".obj"),
        ),
    ] = None,
    list_: Annotated[bool, Option("--list", help="Show the proofs.")] = False,
) -> None:
    """Draw a proof image, a scene or a mesh."""
    if list_:
        put("".join(f"{one.name:14}{one.claim}\n" for one in PROOFS))
        return
    subject = subject if catalogued(subject) else str(file_or_sample(subject))
    if picture.size is None and groups.lens.viewport is not None:
        picture = replace(picture, size=groups.lens.viewport)  # a camera's pixels are its picture's
    _write(_frame(subject, mesh, groups, picture, common), frames, file, common)


def _write(
    frame: PictureFrame, frames: FrameOptions, file: FileOptions, common: CommonOptions
) -> None:
    """Draw, write the files, and show the numbers."""
    usual = PixelFormat.GIF if frames.count > 1 else PixelFormat.PNG
    target = Path(file.output or f"{frame.name}.{usual}")
    is_stdout = str(target) == "-"
    if file.preview and not common.format_is_typed:
        common = common.as_text()
    if file.preview and (is_stdout or common.format is not Format.TEXT):
        raise IllegalValueError(
            "--preview",
            f"it would stand within the {'picture' if is_stdout else common.format} on stdout",
            "leave it out, or let the picture go to a file and the numbers be text",
        )
    kind = usual if is_stdout else kind_of(target, SLIDES if frame.is_slide else PICTURES)
    names = frame_names(target, frames.count, kind)
    refuse_existing(names, force=file.force)
    started = time.perf_counter()
    proofs = _draw(frame, frames)
    milliseconds = (time.perf_counter() - started) * 1000
    files = _files(proofs, kind)
    if is_stdout:
        put_bytes(files[0])
        return
    for name, content in zip(names, files, strict=True):
        write_file(name, content, force=file.force)
    from nmatrix.answers.render import render as answer

    show(answer(proofs[0], _named(names), milliseconds), common)
    if file.preview:
        show_picture(proofs[0], common)


def _frame(
    subject: str,
    mesh: str | None,
    groups: OptionGroups,
    picture: PictureOptions,
    common: CommonOptions,
) -> PictureFrame:
    """Frame what the command line asks for: a proof, or a scene."""
    from nmatrix.answers.render import is_proof

    if is_proof(subject, mesh=mesh, scene=groups.scene.scene_file):
        return _proof(subject, mesh, groups, picture, common)
    return _scene(Path(subject), groups, picture, common)


def _proof(
    name: str,
    mesh: str | None,
    groups: OptionGroups,
    picture: PictureOptions,
    common: CommonOptions,
) -> PictureFrame:
    """Frame a proof: a scene lends its object, its camera and its light."""
    from nmatrix.answers.render import SHEET_SETTINGS, proof_frame, scene_lights
    from nmatrix.raster.proofs.proof import ProofSettings
    from nmatrix.scene.meshes.file import read_mesh

    choices = picture.choices(groups.space.chosen())
    lent = groups.scene.scene
    loaded = None if mesh is None else read_mesh(file_or_sample(mesh))
    if loaded is None and groups.scene.chosen is not None:
        loaded = _drawn(groups).geometry.mesh()
    setup = groups.setup(common, aspect=choices.aspect(SHEET_SETTINGS))
    own_view = groups.view.given or (lent is not None and lent.has_camera)
    own = ProofSettings(
        name if mesh is None else Path(mesh).stem,
        loaded,
        setup.world if groups.world.given or lent is not None else None,
        setup.view if own_view else None,
        setup.lens,
        scene_lights(setup.light) if groups.light.given or lent is not None else None,
        clock=time.perf_counter,
    )
    return proof_frame(name, own, setup, choices)


def _scene(
    path: Path, groups: OptionGroups, picture: PictureOptions, common: CommonOptions
) -> PictureFrame:
    """Frame a file's scene, with what the command line says in place of its own.

    An object that is named is drawn alone; world options move it within its scene instead, or the
    first.
    """
    from nmatrix.answers.render import scene_frame, scene_lights
    from nmatrix.scene.chosen import drawn_alone

    choices = picture.choices(groups.space.chosen())
    asked = groups.scene
    drawn = DrawnScene(str(path), asked.object_name, asked.light_name, asked.allow_outside)
    groups = replace(groups, scene=drawn)
    read = groups.scene.scene
    assert read is not None  # a file was named
    if read.refusal is not None:
        raise read.refusal
    aspect = choices.aspect(read.settings)
    setup = groups.setup(common, aspect=aspect, is_of_node=False)
    framing = () if groups.lens.given.keys() & set(SHAPES) else read.framing_remarks(aspect)
    objects, name = read.objects, groups.scene.object_name
    if name is not None and not groups.world.given:
        read = drawn_alone(read, name)
        objects = read.objects
    if groups.world.given:
        one = _drawn(groups)
        moved = setup.world.world_from_object
        objects = tuple(
            replace(other, world_from_object=moved) if _stand_together(one, other) else other
            for other in objects
        )
    scene = replace(
        read,
        objects=objects,
        lights=scene_lights(setup.light) if groups.light.given else read.lights,
        view=setup.view,
        lens=setup.lens,
        settings=replace(read.settings, space_matrix=setup.space_matrix),
        has_camera=read.has_camera or bool(groups.view.given),
        has_aspect=True,  # the picture's own, where the file has none
        is_framed=False,
        remarks=(*read.remarks, *framing),
    )
    return scene_frame(scene, path.stem, choices)


def _drawn(groups: OptionGroups) -> SceneObject:
    """Find the object that was named, or the first, if it has triangles."""
    one, scene = groups.scene.chosen, groups.scene.scene
    if isinstance(one, SceneObject):
        return one
    for other in scene.objects if scene is not None else ():
        if other.node is not None and scene is not None and scene.nodes[other.node] is one:
            return other
    raise IllegalValueError(
        f"--object ({'' if one is None else printable(one.name)})",
        "it has no triangles of its own",
        "name a node that has a mesh",
    )


def _stand_together(one: SceneObject, other: SceneObject) -> bool:
    """Tell whether two objects are pieces of one node's mesh, or one and the same."""
    is_piece = one.node is not None and one.node == other.node
    return one is other or (is_piece and one.world_from_object == other.world_from_object)


def _draw(frame: PictureFrame, frames: FrameOptions) -> list[Proof]:
    from nmatrix.raster.proofs.frames import around, drawn

    pictures = around(frame, frames.count)
    with frames.executor() as executor:
        return list(progress(drawn(pictures, executor), len(pictures), "frames"))


def _files(proofs: Sequence[Proof], kind: PixelFormat | VectorFormat) -> list[bytes]:
    """Encode the pictures: one file of all, or one each; an animation tells the first's numbers."""
    from nmatrix.raster.image import picture_file

    if isinstance(kind, PixelFormat) and kind.is_animated:
        return [picture_file([one.image for one in proofs], proofs[0].texts, kind)]
    return [one.file(kind) for one in proofs]


def _named(names: Sequence[Path]) -> str:
    return str(names[0]) if len(names) == 1 else f"{names[0]} … {names[-1]}"
