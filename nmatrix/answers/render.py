"""`render`: what is to be drawn and how, and what a picture shows, in numbers and in a sentence."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import asdict, dataclass, replace
from pathlib import Path

from nmatrix.enums import Effort, NormalRule, Reflection, Shading, Space
from nmatrix.errors import IllegalValueError
from nmatrix.raster.proofs.catalogue import catalogued
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.report import Block, Figure, Number, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.light import SceneLight
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Scene, Settings
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES, LightKind

NUMBERS = ("max_angle_error_deg", "mean_angle_error_deg", "triangles", "fragments")
SCENES = (".toml", *GLTF_SUFFIXES)
PANEL = (360, 360)  # pixels of one panel of a proof


@dataclass(frozen=True)
class PictureChoices:
    """What a caller chooses of a picture; None leaves it to the scene file, or to the proof."""

    size: Vector | None = None
    shading: Shading | None = None
    reflection: Reflection | None = None
    normals: NormalRule | None = None
    space: Space | None = None
    samples: Number | None = None
    effort: Effort | None = None

    def over(self, settings: Settings) -> Settings:
        """Return settings with what was chosen in place of their own."""
        names = ("size", "shading", "normals", "space", "samples", "effort")
        chosen = {name: getattr(self, name) for name in names}
        return replace(settings, **{k: v for k, v in chosen.items() if v is not None})

    @property
    def panel_aspect(self) -> float:
        """Width over height of a proof's panel."""
        width, height = self.over(Settings(size=PANEL)).size
        return width / height


@dataclass(frozen=True)
class ProofSubject:
    """What a proof is drawn of: a setup, a mesh, and which of them stand for the proof's own."""

    setup: Setup
    mesh: Mesh | None
    name: str
    has_world: bool
    has_view: bool


def proof_frame(
    name: str,
    subject: ProofSubject,
    choices: PictureChoices,
    clock: Callable[[], float] = float,
) -> PictureFrame:
    """Return the picture frame of a proof of a subject; `clock` tells seconds."""
    setup = subject.setup
    settings = replace(choices.over(Settings(size=PANEL)), space_matrix=setup.space_matrix)
    return PictureFrame(
        name,
        settings=ProofSettings(
            subject.name,
            subject.mesh,
            setup.world if subject.has_world else None,
            setup.view if subject.has_view else None,
            setup.lens,
            scene_lights(setup.light),
            settings,
            choices.reflection or Reflection.LAMBERT,
            clock,
        ),
    )


def scene_frame(scene: Scene, name: str, choices: PictureChoices) -> PictureFrame:
    """Return the picture frame of a scene under what was chosen."""
    settings = choices.over(scene.settings)
    found = replace(scene.sized(*settings.size), settings=settings)
    if choices.reflection is not None:
        objects = (
            replace(one, material=replace(one.material, reflection=choices.reflection))
            for one in found.objects
        )
        found = replace(found, objects=tuple(objects))
    return PictureFrame(name, scene=found)


def checked_subject(subject: str) -> str:
    """Return the name of a proof or of a file that can be drawn.

    Raises
    ------
    IllegalValueError
        If it is neither.
    """
    if catalogued(subject) is None and Path(subject).suffix.lower() not in (
        *SCENES,
        *MESH_SUFFIXES,
    ):
        raise IllegalValueError(
            f"render ({subject[:60]})",
            f"it is no proof; scenes end in {', '.join(SCENES)}, "
            f"meshes in {', '.join(MESH_SUFFIXES)}",
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
