"""`nmatrix render`: proof images, scenes and meshes to a file, their numbers to stdout."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.pictures import FileOptions, FrameOptions, PictureOptions, frame_names
from nmatrix.cli.scene_group import SceneOptions
from nmatrix.cli.scene_options import Groups, SpaceOptions
from nmatrix.cli.show import progress, put, put_bytes, show, show_picture
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Reflection, Space
from nmatrix.errors import IllegalValueError
from nmatrix.output.files import refuse_existing, write_file
from nmatrix.raster.proofs.catalogue import PROOFS, catalogued
from nmatrix.scene.words import LightKind

if TYPE_CHECKING:
    from collections.abc import Sequence

    from nmatrix.raster.proofs.frames import Frame
    from nmatrix.raster.proofs.proof import Proof, ProofSettings
    from nmatrix.scene.light import SceneLight
    from nmatrix.scene.scene import Scene, Settings
    from nmatrix.scene.setup import Setup

HELP = {
    "render": """nmatrix render normals --scale 1 2 1

nmatrix render normals --mesh teapot.obj --shear 1 0 0 -o teapot.png

nmatrix render scene.toml --frames 36 --turn -o scene.gif

A proof image, a scene, or a mesh. A proof shows wrong beside right, with the number between.""",
}

SCENES = (".toml", ".gltf", ".glb")
MESHES = (".obj", ".ply", ".stl")
PANEL = (360, 360)
PICTURE = (512, 512)


def render(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    light: LightOptions,
    space: SpaceOptions,
    scene: SceneOptions,
    picture: PictureOptions,
    frames: FrameOptions,
    file: FileOptions,
    everywhere: Everywhere,
    subject: Annotated[
        str, Argument(metavar="PROOF|SCENE|MESH", help="A proof (see --list), or a file.")
    ] = "normals",
    mesh: Annotated[str | None, Option(metavar="FILE", help="Draw a proof of this mesh.")] = None,
    list_: Annotated[bool, Option("--list", help="Show the proofs.")] = False,
) -> None:
    """Draw a proof image, a scene or a mesh."""
    if list_:
        put("".join(f"{one.name:14}{one.shows}\n" for one in PROOFS))
        return
    groups = Groups(world, view, lens, light, space, scene=scene)
    _write(_job(subject, mesh, groups, picture, everywhere), frames, file, everywhere)


def _write(job: Frame, frames: FrameOptions, file: FileOptions, everywhere: Everywhere) -> None:
    """Draw, write the files, and show the numbers."""
    target = file.output or f"{job.name}.{'gif' if frames.count > 1 else 'png'}"
    names = _names(target, frames.count)
    refuse_existing(names, force=file.force)
    started = time.perf_counter()
    proofs = _draw(job, frames)
    milliseconds = (time.perf_counter() - started) * 1000
    if target == "-":
        put_bytes(_content(proofs, "-")[0])
        return
    for name, content in zip(names, _content(proofs, target), strict=True):
        write_file(name, content, force=file.force)
    from nmatrix.answers.render import render as answer

    show(answer(proofs[0], _named(names), milliseconds), everywhere)
    if file.preview:
        show_picture(proofs[0].image, everywhere)


def _job(
    subject: str, mesh: str | None, groups: Groups, picture: PictureOptions, everywhere: Everywhere
) -> Frame:
    """Return what the command line asks for: a proof with its settings, or a scene."""
    from nmatrix.raster.proofs.frames import Frame

    suffix = Path(subject).suffix.lower()
    if catalogued(subject) is not None:
        return Frame(subject, settings=_proof_settings(subject, mesh, groups, picture, everywhere))
    if suffix not in SCENES + MESHES:
        raise IllegalValueError(
            f"render ({subject[:60]})",
            f"it is no proof; scenes end in {', '.join(SCENES)}, meshes in {', '.join(MESHES)}",
            "see nmatrix render --list",
        )
    for option, given in (("--mesh", mesh), ("--scene", groups.scene.scene_file)):
        if given is not None:
            raise IllegalValueError(
                f"{subject[:60]} with {option}", "both say what to draw", "keep one of them"
            )
    path = Path(subject)
    return Frame(path.stem, scene=_scene(path, groups, picture, everywhere))


def _proof_settings(
    name: str, mesh: str | None, groups: Groups, picture: PictureOptions, everywhere: Everywhere
) -> ProofSettings:
    """Return a proof's settings: a scene lends its object, its camera and its light."""
    from nmatrix.raster.proofs.proof import ProofSettings
    from nmatrix.scene.meshes.file import read_mesh
    from nmatrix.scene.scene import Settings

    size = picture.checked_size(PANEL)
    setup = groups.setup(everywhere, aspect=size[0] / size[1])
    lent = groups.scene.scene
    has_camera = groups.view.is_given or (lent is not None and lent.has_camera)
    loaded = None if mesh is None else read_mesh(Path(mesh))
    if loaded is None and groups.scene.chosen_object is not None:
        loaded = groups.scene.chosen_object.geometry.mesh()
    return ProofSettings(
        name if mesh is None else Path(mesh).stem,
        loaded,
        setup.world if groups.world.is_given or lent is not None else None,
        setup.view if has_camera else None,
        setup.lens,
        _lights(setup),
        _settings(Settings(size=size), groups, picture, setup),
        picture.reflection or Reflection.LAMBERT,
        time.perf_counter,
    )


def _scene(path: Path, groups: Groups, picture: PictureOptions, everywhere: Everywhere) -> Scene:
    """Return the scene of a file, with what the command line says in place of its own.

    World options move the object that --object names, or the first.
    """
    groups = replace(groups, scene=replace(groups.scene, scene_file=str(path)))
    read, chosen = groups.scene.scene, groups.scene.chosen_object
    assert read is not None  # a file was named
    found = read.sized(*picture.checked_size(read.settings.size))
    setup = groups.setup(everywhere, aspect=found.lens.aspect)
    objects = found.objects
    if groups.world.is_given:
        moved = setup.world.world_from_object
        objects = tuple(
            replace(one, world_from_object=moved) if one is chosen else one for one in objects
        )
    if picture.reflection is not None:
        objects = tuple(
            replace(one, material=replace(one.material, reflection=picture.reflection))
            for one in objects
        )
    return replace(
        found,
        objects=objects,
        lights=_lights(setup) if groups.light.is_given or not found.lights else found.lights,
        view=setup.view,
        lens=setup.lens,
        settings=_settings(found.settings, groups, picture, setup),
        has_camera=found.has_camera or groups.view.is_given,
    )


def _settings(
    settings: Settings, groups: Groups, picture: PictureOptions, setup: Setup
) -> Settings:
    chosen = groups.space.chosen(None, settings.space)
    return replace(
        settings,
        space=chosen or Space.WORLD,
        space_matrix=setup.space_matrix or settings.space_matrix,
        shading=picture.shading or settings.shading,
        samples=picture.checked_samples(settings.samples, settings.size),
        normals=picture.normals or settings.normals,
        effort=picture.effects,
    )


def _lights(setup: Setup) -> tuple[SceneLight, ...]:
    """Return the light of the command line as lights: one for its direction, one for its place."""
    from nmatrix.scene.light import SceneLight

    light = setup.light.placed()
    lights = []
    if light.direction is not None:
        lights.append(SceneLight("sun", LightKind.DIRECTIONAL, direction=light.direction))
    if light.position is not None:
        lights.append(SceneLight("bulb", LightKind.POINT, position=light.position))
    return tuple(lights)


def _draw(job: Frame, frames: FrameOptions) -> list[Proof]:
    from nmatrix.raster.proofs.frames import drawn, turns

    jobs = [job.turned(angle) for angle in turns(frames.count)] if frames.count > 1 else [job]
    with frames.executor() as executor:
        return list(progress(drawn(jobs, executor), len(jobs), "frames"))


def _names(target: str, count: int) -> list[Path]:
    path = Path(target)
    if count == 1 or target == "-" or path.suffix.lower() == ".gif":
        return [path]
    return frame_names(path, count)


def _content(proofs: Sequence[Proof], target: str) -> list[bytes]:
    from nmatrix.raster.proofs.frames import gif

    if Path(target).suffix.lower() == ".gif" or (target == "-" and len(proofs) > 1):
        return [gif([one.image for one in proofs])]
    return [one.png() for one in proofs]


def _named(names: Sequence[Path]) -> str:
    return str(names[0]) if len(names) == 1 else f"{names[0]} … {names[-1]}"
