"""Every command with its help panel, its module and its one line: all that `--help` needs."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Entry:
    """One command: where it lives and how the overview describes it."""

    name: str
    panel: str
    module: str
    summary: str


MATRICES, SPACES, PROOFS, STUDIES = "Matrices", "Spaces", "Proofs", "Studies"
CLASSROOM, FILES = "Classroom", "Files"

COMMANDS: tuple[Entry, ...] = (
    Entry(
        "world", MATRICES, "matrices", "The world matrix, its kind, its parts, its normal matrix"
    ),
    Entry("view", MATRICES, "matrices", "The view matrix and its two factors"),
    Entry("projection", MATRICES, "matrices", "The projection matrix and its depth steps"),
    Entry("normal", MATRICES, "normals", "The normal matrix of any map, and normals through it"),
    Entry("calc", MATRICES, "calc", "The matrix calculator, exact"),
    Entry("light", SPACES, "spaces", "Light direction and position in any space"),
    Entry("eye", SPACES, "spaces", "The eye in any space"),
    Entry("space", SPACES, "spaces", "The whole sheet of a shading space, and its shaders"),
    Entry("trace", SPACES, "spaces", "One vertex from object space to the window"),
    Entry("derive", PROOFS, "derive", "The inverse-transpose rule, step by step, proved"),
    Entry("render", PROOFS, "render", "Proof images: wrong beside right; scenes and meshes"),
    Entry("plan", PROOFS, "plan", "Which effects a scene calls for, and why"),
    Entry("cost", STUDIES, "cost", "What accuracy costs in time, measured here"),
    Entry("stress", STUDIES, "stress", "The hard cases, and who survives them"),
    Entry("check", CLASSROOM, "check", "Is this answer right, and which mistake is it?"),
    Entry("handout", CLASSROOM, "handout", "Printable sheets: theory, numbers, exercises, keys"),
    Entry("explore", CLASSROOM, "explore", "One page with sliders: wrong beside right, live"),
    Entry("inspect", FILES, "inspect", "Which nodes of a file need the inverse transpose"),
)


def entry(name: str) -> Entry | None:
    """Return the entry of a command, if there is one."""
    return next((one for one in COMMANDS if one.name == name), None)
