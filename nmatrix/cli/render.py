"""`nmatrix render`: proof images to a file, their numbers to stdout."""

from __future__ import annotations

import time
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Argument, Option

from nmatrix.cli.camera_options import LensOptions, ViewOptions
from nmatrix.cli.everywhere import Everywhere
from nmatrix.cli.files import write_file
from nmatrix.cli.scene_options import Groups
from nmatrix.cli.show import put, put_bytes, show
from nmatrix.cli.world_options import LightOptions, WorldOptions
from nmatrix.enums import Reflection, Shading
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import numbers
from nmatrix.report import Block, Figure, Quantity, Report, Value, Verdict

if TYPE_CHECKING:
    from nmatrix.raster.draw import Canvas
    from nmatrix.raster.proofs import Proof
    from nmatrix.scene.mesh import Mesh
    from nmatrix.scene.shot import Shot

HELP = {
    "render": """nmatrix render normals --scale 1 2 1

nmatrix render normals --mesh teapot.obj --shear 1 0 0 -o teapot.png

nmatrix render teapot.ply --samples 16

A proof image: the wrong normals, the right ones, and the angle between them.""",
}

PROOFS = {"normals": "wrong normals, right normals, and a map of the angle between them"}
SAMPLES = {"1": 1, "4": 2, "16": 4, "64": 8}
MESHES = (".obj", ".ply", ".stl")
LARGEST = 8192  # pixels on a side
MOST_SAMPLES = 1 << 26


def render(
    *,
    world: WorldOptions,
    view: ViewOptions,
    lens: LensOptions,
    light: LightOptions,
    everywhere: Everywhere,
    subject: Annotated[
        str, Argument(metavar="PROOF", help="A proof (see --list) or a mesh file.")
    ] = "normals",
    mesh: Annotated[
        str | None, Option(metavar="FILE", help="Draw this mesh, not a sphere.")
    ] = None,
    output: Annotated[
        str | None, Option("--output", "-o", metavar="FILE", help="PNG file; - is stdout.")
    ] = None,
    size: Annotated[str, Option(metavar="W H", help="Pixels of each panel.")] = "360 360",
    shading: Annotated[Shading, Option(help="Where light is evaluated.")] = Shading.PHONG,
    reflection: Annotated[
        Reflection, Option(help="How the surface reflects.")
    ] = Reflection.LAMBERT,
    samples: Annotated[
        str, Option(metavar="N", help="Samples of each pixel: 1, 4, 16 or 64.")
    ] = "4",
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False,
    list_: Annotated[bool, Option("--list", help="Show the proofs.")] = False,
) -> None:
    """Draw a proof image."""
    if list_:
        put("".join(f"{name:10}{line}\n" for name, line in PROOFS.items()))
        return
    from nmatrix.raster.draw import Canvas

    width, height = _size(size)
    canvas = Canvas(width, height, _per_side(samples, width, height))
    model, name = _subject(subject, mesh)
    target = f"{name}.png" if output is None else output
    groups = Groups(_with_default_scale(world), view, lens, light)
    started = time.perf_counter()
    proof, remarks = _proof(model, name, groups, everywhere, (canvas, shading, reflection))
    content = proof.png()
    milliseconds = (time.perf_counter() - started) * 1000
    if target == "-":
        put_bytes(content)
        return
    write_file(Path(target), content, force=force)
    show(_report(proof, target, milliseconds, remarks), everywhere)


def _proof(
    model: Mesh,
    name: str,
    groups: Groups,
    everywhere: Everywhere,
    drawing: tuple[Canvas, Shading, Reflection],
) -> tuple[Proof, tuple[str, ...]]:
    from nmatrix.raster.proofs import Setup, as_array, normals_proof
    from nmatrix.raster.shade import Lighting

    canvas, shading, reflection = drawing
    shot = groups.shot(everywhere, aspect=canvas.width / canvas.height)
    remarks: tuple[str, ...] = ()
    if not groups.view.is_given:
        shot, remarks = _fitted(shot, model, groups)
    stage = shot.stage
    eye = as_array(stage.eye)
    assert eye is not None  # a camera always has one
    lighting = Lighting(
        eye, as_array(stage.light.direction), as_array(stage.light.position), reflection
    )
    setup = Setup(canvas, shot.lens.clip, shading)
    return normals_proof(model, name, stage, lighting, setup), (*shot.remarks, *remarks)


def _fitted(shot: Shot, model: Mesh, groups: Groups) -> tuple[Shot, tuple[str, ...]]:
    """Return the scene with a camera that sees the whole mesh."""
    from math import atan, radians, tan

    from nmatrix.raster.proofs import bounding_ball, fitted_eye

    centre, radius = bounding_ball(model, shot.stage)
    half = radians(shot.lens.fov_degrees / 2)
    half = min(half, atan(tan(half) * shot.lens.aspect))
    eye, near, far = fitted_eye(centre, radius, half)
    view = replace(shot.view, eye=tuple(eye.tolist()), target=tuple(centre.tolist()))
    lens = shot.lens
    if groups.lens.near is None and groups.lens.far is None:
        lens = replace(lens, near=max(near, radius * 1e-3), far=far)
    remark = "No camera was given: it was fitted to the bounding sphere of the mesh."
    return replace(shot, view=view, lens=lens), (remark,)


def _subject(subject: str, mesh: str | None) -> tuple[Mesh, str]:
    from nmatrix.scene.meshfile import read_mesh
    from nmatrix.scene.shapes import sphere

    if subject not in PROOFS and Path(subject).suffix.lower() not in MESHES:
        raise IllegalValueError(
            f"render ({subject[:60]})",
            f"the proofs are {', '.join(PROOFS)}; meshes end in {', '.join(MESHES)}",
            "see nmatrix render --list",
        )
    if subject not in PROOFS and mesh is not None:
        raise IllegalValueError(f"{subject[:60]} with --mesh", "both are the mesh", "keep one")
    file = mesh if subject in PROOFS else subject
    if file is None:
        return sphere(), "normals"
    path = Path(file)
    return read_mesh(path), path.stem


def _with_default_scale(world: WorldOptions) -> WorldOptions:
    return world if world.is_given else replace(world, scale="1 2 1")


def _size(text: str) -> tuple[int, int]:
    width, height = numbers(text, 2, "--size")
    if not (width.is_integer() and height.is_integer() and min(width, height) >= 1):
        raise IllegalValueError(
            f"--size ({text[:40]})",
            "both sides are whole numbers of pixels, 1 at least",
            "try 360 360",
        )
    if max(width, height) > LARGEST:
        raise IllegalValueError(
            f"--size ({text[:40]})", f"a side has {LARGEST} pixels at the most", "try 1024 1024"
        )
    return int(width), int(height)


def _per_side(samples: str, width: int, height: int) -> int:
    if samples not in SAMPLES:
        raise IllegalValueError(
            f"--samples ({samples[:20]})", "a pixel has 1, 4, 16 or 64", "try --samples 4"
        )
    if width * height * int(samples) > MOST_SAMPLES:
        raise IllegalValueError(
            f"--size {width} {height} --samples {samples}",
            f"more than {MOST_SAMPLES} samples would not fit into memory",
            "take fewer of either",
        )
    return SAMPLES[samples]


def _report(proof: Proof, image: str, milliseconds: float, remarks: tuple[str, ...]) -> Report:
    height, width = proof.image.shape[:2]
    data: dict[str, Value] = {
        "image": image,
        "width": width,
        "height": height,
        "subject": proof.subject,
        "max_angle_error_deg": proof.max_angle_error_deg,
        "mean_angle_error_deg": proof.mean_angle_error_deg,
        "max_level_difference": proof.max_level_difference,
        "triangles": proof.triangles,
        "fragments": proof.fragments,
        "work": dict(proof.work),
        "milliseconds": milliseconds,
        "effects": ["diffuse"],
    }
    shown = ("max_angle_error_deg", "mean_angle_error_deg", "triangles", "fragments")
    blocks: tuple[Block, ...] = (
        Figure(image, f"{proof.subject}: wrong normals, right normals, the angle between them"),
        *(Quantity(key, data[key]) for key in shown),  # type: ignore[arg-type]  # numbers or None
        Verdict(_verdict(proof)),
    )
    return Report("render", data, blocks, remarks)


def _verdict(proof: Proof) -> str:
    worst = proof.max_angle_error_deg
    if not proof.fragments:
        return "Nothing of the mesh covers a sample: move the camera or make the picture larger."
    if worst is None:
        return "No normal survives this map."
    if worst < 1e-4:
        return "Both are the same here: a test on this map cannot tell a wrong normal matrix."
    return f"With A itself the normals are up to {worst:.2f}° off."
