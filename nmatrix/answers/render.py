"""`render`: what is to be drawn and how, and what a picture shows, in numbers and in a sentence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from nmatrix.enums import Effort, NormalRule, Reflection, Shading, Space
from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import RationalMatrix
from nmatrix.raster.proofs.catalogue import catalogued
from nmatrix.raster.proofs.frames import Frame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.report import Block, Figure, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.light import SceneLight
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Scene, Settings
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import LightKind
from nmatrix.scene.world import World

NUMBERS = ("max_angle_error_deg", "mean_angle_error_deg", "triangles", "fragments")
SCENES = (".toml", ".gltf", ".glb")
MESHES = (".obj", ".ply", ".stl")
PANEL = (360, 360)  # pixels of one panel of a proof


@dataclass(frozen=True)
class PictureChoices:
    """What a caller chooses of a picture; None leaves it to the scene file, or to the proof."""

    size: Vector | None = None
    shading: Shading | None = None
    reflection: Reflection | None = None
    normals: NormalRule | None = None
    space: Space | None = None
    space_matrix: RationalMatrix | None = None
    samples: int | None = None
    effort: Effort | None = None

    def over(self, settings: Settings) -> Settings:
        """Return settings with what was chosen in place of their own."""
        names = ("size", "shading", "normals", "space", "space_matrix", "samples", "effort")
        chosen = {name: getattr(self, name) for name in names}
        return replace(settings, **{k: v for k, v in chosen.items() if v is not None})


def proof_frame(
    name: str,
    setup: Setup,
    choices: PictureChoices,
    *,
    mesh: Mesh | None = None,
    subject: str | None = None,
    clock: Callable[[], float] = float,
) -> Frame:
    """Return the frame of a proof, of a mesh and under a setup instead of its own.

    A world and a view that are the usual ones leave the proof its own.
    """
    settings = choices.over(Settings(size=PANEL))
    width, height = settings.size
    is_free = setup.lens.aspect == Lens().aspect
    lens = replace(setup.lens, aspect=width / height) if is_free else setup.lens
    return Frame(
        name,
        settings=ProofSettings(
            subject or name,
            mesh,
            None if setup.world == World() else setup.world,
            None if setup.view == View() else setup.view,
            lens,
            scene_lights(setup.light),
            settings,
            choices.reflection or Reflection.LAMBERT,
            clock,
        ),
    )


def scene_frame(scene: Scene, name: str, choices: PictureChoices) -> Frame:
    """Return the frame of a scene under what was chosen."""
    settings = choices.over(scene.settings)
    found = replace(scene.sized(*settings.size), settings=settings)
    if choices.reflection is not None:
        objects = (
            replace(one, material=replace(one.material, reflection=choices.reflection))
            for one in found.objects
        )
        found = replace(found, objects=tuple(objects))
    return Frame(name, scene=found)


def checked_subject(subject: str) -> str:
    """Return the name of a proof or of a file that can be drawn.

    Raises
    ------
    IllegalValueError
        If it is neither.
    """
    if catalogued(subject) is None and Path(subject).suffix.lower() not in SCENES + MESHES:
        raise IllegalValueError(
            f"render ({subject[:60]})",
            f"it is no proof; scenes end in {', '.join(SCENES)}, meshes in {', '.join(MESHES)}",
            "see nmatrix render --list",
        )
    return subject


def scene_lights(light: Light) -> tuple[SceneLight, ...]:
    """Return a setup's light as lights of a scene: one for its direction, one for its place."""
    placed = light.placed()
    lights = []
    if placed.direction is not None:
        lights.append(SceneLight("sun", LightKind.DIRECTIONAL, direction=placed.direction))
    if placed.position is not None:
        lights.append(SceneLight("bulb", LightKind.POINT, position=placed.position))
    return tuple(lights)


def render(proof: Proof, image: str | None = None, milliseconds: float | None = None) -> Report:
    """Answer with the numbers of a picture, and the file that it was written to, if any."""
    height, width = proof.image.shape[:2]
    data: dict[str, Value] = {
        "image": image,
        "width": width,
        "height": height,
        "subject": proof.subject,
        "max_angle_error_deg": proof.max_angle_error_deg,
        "mean_angle_error_deg": proof.mean_angle_error_deg,
        "max_level_difference": proof.max_level_difference,
        "triangles": proof.work.triangles,
        "fragments": proof.work.fragments,
        "work": asdict(proof.work),
        "milliseconds": milliseconds,
        "effects": list(proof.effects),
        "numbers": dict(proof.numbers),
    }
    shown = (Figure(image, f"a picture of {proof.subject}"),) if image else ()
    blocks: tuple[Block, ...] = (
        *shown,
        *(Quantity(key, data[key]) for key in NUMBERS),  # type: ignore[arg-type]  # numbers or None
        Verdict(proof.verdict),
    )
    return Report("render", data, blocks, proof.remarks)
