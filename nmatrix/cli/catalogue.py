"""Every command with its help panel, its module and its sentence: all that `--help` needs."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum


class Panel(StrEnum):
    """The panels of the overview, in its order."""

    MATRICES = "Matrices"
    SPACES = "Spaces"
    PROOFS = "Proofs"
    STUDIES = "Studies"
    CLASSROOM = "Classroom"
    FILES = "Files"


@dataclass(frozen=True)
class CatalogueEntry:
    """Where a command lives, and the sentence that begins every help of it."""

    panel: Panel
    module: str
    sentence: str


COMMANDS = {
    "world": CatalogueEntry(
        Panel.MATRICES, "matrices", "The world matrix T · R · S · H, its kind, its normal matrix"
    ),
    "view": CatalogueEntry(
        Panel.MATRICES, "matrices", "The view matrix, its factors R · T, and the camera's axes"
    ),
    "projection": CatalogueEntry(
        Panel.MATRICES, "matrices", "The projection matrix, and the smallest gap its depth tells"
    ),
    "normal": CatalogueEntry(
        Panel.MATRICES, "matrices", "The normal matrix of any map, and what becomes of normals"
    ),
    "calc": CatalogueEntry(Panel.MATRICES, "calc", "The matrix calculator, in exact fractions"),
    "identify": CatalogueEntry(
        Panel.MATRICES, "matrices", "What is this matrix? Every reading, with its evidence"
    ),
    "axes": CatalogueEntry(
        Panel.MATRICES, "matrices", "From one axis system to another: Unity, Unreal, Blender, …"
    ),
    "light": CatalogueEntry(
        Panel.SPACES, "spaces", "Light direction and position in one space, or in four"
    ),
    "eye": CatalogueEntry(Panel.SPACES, "spaces", "The eye in one space, or in four"),
    "space": CatalogueEntry(
        Panel.SPACES, "spaces", "What a shading space transforms, by what, where, at what price"
    ),
    "trace": CatalogueEntry(Panel.SPACES, "spaces", "One vertex from object space to the window"),
    "derive": CatalogueEntry(
        Panel.PROOFS, "proofs", "The inverse-transpose rule, step by step, each step proved"
    ),
    "render": CatalogueEntry(
        Panel.PROOFS, "render", "Proof images: wrong beside right; scenes and meshes"
    ),
    "plan": CatalogueEntry(Panel.PROOFS, "proofs", "Which effects a scene calls for, and why"),
    "cost": CatalogueEntry(
        Panel.STUDIES, "studies", "What accuracy costs in time, measured on this machine"
    ),
    "stress": CatalogueEntry(
        Panel.STUDIES, "studies", "Every hard case against every method, naive ones included"
    ),
    "check": CatalogueEntry(
        Panel.CLASSROOM, "check", "Is this answer right, and if not, which mistake is it?"
    ),
    "lint": CatalogueEntry(
        Panel.CLASSROOM, "lint", "Which spaces meet in this shader that must not?"
    ),
    "handout": CatalogueEntry(
        Panel.CLASSROOM, "handout", "Printable sheets: theory, numbers, pictures, exercises"
    ),
    "explore": CatalogueEntry(
        Panel.CLASSROOM, "explore", "One page to turn and drag: wrong normals beside right ones"
    ),
    "web": CatalogueEntry(
        Panel.CLASSROOM, "web", "This program as a folder that any browser runs, without a network"
    ),
    "inspect": CatalogueEntry(
        Panel.FILES, "inspect", "Which nodes of a file need the inverse transpose"
    ),
}
