"""Pictures for Python callers: proofs, scene files and meshes."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from nmatrix.api.report import Picture
from nmatrix.api.setup import Setup, setup_values
from nmatrix.enums import (
    Effort,
    NormalRule,
    Reflection,
    Shading,
    Shown,
    Space,
    Theme,
    chosen,
    chosen_words,
)
from nmatrix.linear.values import named_file, number, vector
from nmatrix.samples import file_or_sample
from nmatrix.scene.camera import View
from nmatrix.scene.setup import Light
from nmatrix.scene.world import World
from nmatrix.spaces.shading_spaces import space_named


def render(
    subject: str | Path = "normals",
    setup: Setup | None = None,
    *,
    mesh: str | Path | None = None,
    size: object = None,
    shading: str | Shading | None = None,
    reflection: str | Reflection | None = None,
    normals: str | NormalRule | None = None,
    space: str | Space | None = None,
    samples: int | None = None,
    effects: str | Effort = Effort.PLANNED,
    theme: str | Theme = Theme.LIGHT,
    show: str | Iterable[str] = (),
    object: str | None = None,
    allow_outside: bool = False,
) -> Picture:
    r"""Draw a proof by its name, a scene file, a glTF file or a mesh.

    Parameters
    ----------
    subject
        `nmatrix render --list` names the proofs; scenes are .toml, .gltf, .glb, meshes .obj, .ply,
        .stl.
    setup
        For a proof: its world, view, lens and light in place of the proof's own.
    mesh
        For a proof: a mesh file to draw it of.
    size
        Width and height of the picture in pixels.
    shading, reflection, normals, space, samples, effects, theme
        As the command line has them; None leaves them to the file or the proof.
    show
        For a file: what is drawn over it, of `normals`, `tangents`, `axes`, `lights`, `eye`,
        `wireframe`, `bounds`.
    object
        For a file: the name or the path of a node, to draw it alone with what hangs below it.
    allow_outside
        Whether a file may name files outside of its folder.

    Raises
    ------
    IllegalValueError
        For an unknown subject, a file that cannot be drawn, or a setup beside a file.

    Examples
    --------
    >>> picture = render("bias", size=(120, 90))
    >>> picture.image.dtype, picture.png[:4]
    (dtype('uint8'), b'\x89PNG')
    """
    from nmatrix.answers.render import (
        PictureChoices,
        is_proof,
        proof_frame,
        scene_frame,
        scene_lights,
    )
    from nmatrix.answers.render import render as answer
    from nmatrix.raster.proofs.proof import ProofSettings
    from nmatrix.scene.chosen import drawn_alone
    from nmatrix.scene.meshes.file import read_mesh
    from nmatrix.scene.open import scene_of

    name = str(file_or_sample(named_file(subject, "subject")))
    choices = PictureChoices(
        None if size is None else vector(size, "size", size=2),
        None if shading is None else chosen(Shading, shading, "shading"),
        None if reflection is None else chosen(Reflection, reflection, "reflection"),
        None if normals is None else chosen(NormalRule, normals, "normals"),
        None if space is None else space_named(space),
        None if samples is None else number(samples, "samples"),
        chosen(Effort, effects, "effects"),
        chosen(Theme, theme, "theme"),
        frozenset(chosen_words(Shown, show, "show")),
    )
    if is_proof(name, setup=setup, mesh=mesh):
        values = setup_values(Setup() if setup is None else setup)
        of_mesh = None if mesh is None else file_or_sample(named_file(mesh, "mesh"))
        own = ProofSettings(
            name if of_mesh is None else of_mesh.stem,
            None if of_mesh is None else read_mesh(of_mesh),
            None if values.world == World() else values.world,
            None if values.view == View() else values.view,
            values.lens,
            None if values.light == Light() else scene_lights(values.light),
        )
        frame = proof_frame(name, own, values, choices)
    else:
        scene = scene_of(Path(name), allow_outside=allow_outside)
        if object is not None:
            scene = drawn_alone(scene, object)
        frame = scene_frame(scene, Path(name).stem, choices)
    proof = frame.draw()
    return Picture(answer(proof), proof)
