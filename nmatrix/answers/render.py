"""`render`: what is to be drawn and how, and what a picture shows, in numbers and in a sentence."""

from __future__ import annotations

from dataclasses import asdict, dataclass, replace
from pathlib import Path

from nmatrix.enums import Effort, NormalRule, Reflection, Shading, Shown, Space, Theme
from nmatrix.errors import IllegalValueError, did_you_mean, quantity
from nmatrix.raster.proofs.catalogue import PROOFS, catalogued
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import SHEET, Proof, ProofSettings
from nmatrix.report import Block, Figure, Heading, Number, Quantity, Report, Value, Vector, Verdict
from nmatrix.scene.light import SceneLight
from nmatrix.scene.scene import Scene, Settings
from nmatrix.scene.setup import Light, Setup
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES, LightKind

NUMBERS = ("max_angle_error_deg", "mean_angle_error_deg", "triangles", "fragments")
SCENES = (".toml", *GLTF_SUFFIXES)
SHEET_SETTINGS = Settings(size=SHEET)  # of a proof


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
    theme: Theme = Theme.LIGHT
    shown: frozenset[Shown] = frozenset()

    def over(self, settings: Settings) -> Settings:
        """Put what was chosen in place of the settings' own."""
        names = ("size", "shading", "normals", "space", "samples", "effort")
        chosen = {name: getattr(self, name) for name in names}
        return replace(settings, **{k: v for k, v in chosen.items() if v is not None})

    def aspect(self, settings: Settings) -> float:
        """Width over height of a picture with these settings, as chosen."""
        width, height = self.over(settings).size
        return width / height


def proof_frame(
    name: str, own: ProofSettings, setup: Setup, choices: PictureChoices
) -> PictureFrame:
    """Frame a proof of these settings, drawn as chosen; a setup may bring a shading space.

    Raises
    ------
    IllegalValueError
        If marks are asked for.
    """
    if choices.shown:
        raise IllegalValueError(
            f"{quantity('show')} with {name}",
            "a proof has the marks that it needs",
            "show marks on a scene or a mesh",
        )
    settings = replace(
        own,
        picture=replace(choices.over(SHEET_SETTINGS), space_matrix=setup.space_matrix),
        reflection=choices.reflection,
        theme=choices.theme,
    )
    return PictureFrame(name, settings=settings)


def scene_frame(scene: Scene, name: str, choices: PictureChoices) -> PictureFrame:
    """Frame a scene, drawn as chosen."""
    settings = choices.over(scene.settings)
    found = replace(scene.sized(*settings.size), settings=settings)
    if choices.reflection is not None:
        objects = (
            replace(one, material=replace(one.material, reflection=choices.reflection))
            for one in found.objects
        )
        found = replace(found, objects=tuple(objects))
    return PictureFrame(name, scene=found, shown=choices.shown, theme=choices.theme)


def is_proof(subject: str, **beside: object) -> bool:
    """Tell a proof by its name from a file, beside which nothing else may say what to draw.

    Raises
    ------
    IllegalValueError
        If it is neither, or a file beside anything but None.
    """
    if catalogued(subject) is not None:
        return True
    if Path(subject).suffix.lower() not in (*SCENES, *MESH_SUFFIXES):
        raise IllegalValueError(
            f"render ({subject[:60]})",
            f"it is no proof; scenes end in {', '.join(SCENES)}, "
            f"meshes in {', '.join(MESH_SUFFIXES)}",
            did_you_mean(subject, [one.name for one in PROOFS], "see nmatrix render --list"),
        )
    for name, given in beside.items():
        if given is not None:
            raise IllegalValueError(
                f"{subject[:60]} with {quantity(name)}",
                "both say what to draw",
                "keep one of them",
            )
    return False


def scene_lights(light: Light) -> tuple[SceneLight, ...]:
    """Split a setup's light into lights of a scene: one for its direction, one for its place."""
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
        "file_features": [asdict(one) for one in proof.features],
    }
    alternative = f"a picture of {proof.subject}"
    about: tuple[Block, ...] = (
        Verdict(proof.verdict),
        *(Quantity(key, data[key]) for key in NUMBERS if data[key] is not None),  # type: ignore[arg-type]
    )
    if proof.is_slide:  # its claim and its sentence say the numbers that matter
        alternative = proof.texts["Title"]
        about = (Heading(alternative), Verdict(proof.verdict))
    file = (Figure(image, alternative),) if image else ()
    return Report("render", data, (*about, *file), proof.remarks)
