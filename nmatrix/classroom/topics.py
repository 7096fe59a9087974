"""What a handout may hold: each topic gives the blocks that a terminal shows, and its pictures."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from enum import StrEnum
from functools import cache
from typing import TYPE_CHECKING

from nmatrix.classroom.first_page import Part, rule, spaces
from nmatrix.classroom.worked import in_each, worked
from nmatrix.enums import Space, Theme
from nmatrix.output.pages.document import PageFormat
from nmatrix.report import Block, Cells, Figure, Heading, Table, Text
from nmatrix.scene.setup import Setup
from nmatrix.spaces.shading_spaces import USUAL_SPACES

if TYPE_CHECKING:
    from nmatrix.canvas.paper import Cutting


class Topic(StrEnum):
    """The topics of a handout, in the order in which they are printed."""

    RULE = "rule"
    SPACES = "spaces"
    EXERCISES = "exercises"
    WORKED = "worked"
    PROOFS = "proofs"
    PITFALLS = "pitfalls"
    COST = "cost"


USUAL = (Topic.RULE, Topic.SPACES, Topic.WORKED, Topic.PROOFS, Topic.PITFALLS)
PROOFS = ("normals", "bias", "mirror")
PICTURE_POINTS = 493.0  # the width of a picture on A4


def _worked(setup: Setup, kind: PageFormat) -> Part:
    return Part(worked(setup))


@dataclass(frozen=True)
class PaperProof:
    """A proof on paper: its claim, what it tells for those who cannot see it, and its cutting."""

    name: str
    title: str
    told: str
    cutting: Cutting


@cache  # they are of no scene, and alike in every format
def _drawn_proofs() -> tuple[PaperProof, ...]:
    from nmatrix.canvas.paper import on_paper
    from nmatrix.canvas.slide import Slide
    from nmatrix.canvas.text import plain
    from nmatrix.raster.proofs.catalogue import catalogued
    from nmatrix.raster.proofs.proof import ProofSettings

    found = []
    for name in PROOFS:
        entry = catalogued(name)
        assert entry is not None
        slide = entry.load()(ProofSettings(name, theme=Theme.PRINT)).picture
        assert isinstance(slide, Slide)
        cutting = on_paper(slide, PICTURE_POINTS)
        told = f"{'. '.join(slide.told)}. {cutting.words}"
        found.append(PaperProof(name, plain(slide.title), told, cutting))
    return tuple(found)


def _proofs(setup: Setup, kind: PageFormat) -> Part:
    """Show proofs, each with its claim and the words around its panels as a caption."""
    from nmatrix.canvas.paint import vector

    blocks: list[Block] = [Heading("What it looks like")]
    pictures = {}
    for one in _drawn_proofs():
        path = f"{one.name}.{kind.drawings}"
        texts = {"Title": one.title, "Description": one.told}
        pictures[path] = vector(one.cutting.canvas, kind.drawings, texts)
        blocks.append(Figure(path, one.told, one.cutting.words, one.title))
    return Part(tuple(blocks), pictures)


def _pitfalls(setup: Setup, kind: PageFormat) -> Part:
    from nmatrix.classroom.pitfalls import PITFALLS

    rows = tuple((one.claim, one.verdict) for one in PITFALLS)
    title = Heading("What is often said, and what is true")
    return Part((title, Table(("said", "true"), rows)))


def _cost(setup: Setup, kind: PageFormat) -> Part:
    """Count the work; a time would be another one tomorrow."""
    from nmatrix.shaders.cost import cost
    from nmatrix.shaders.sheet import Request

    def row(space: Space) -> Cells:
        found = cost(setup.maps, Request(space))
        return (
            space.value,
            found.per_vertex_multiplications,
            found.per_fragment_multiplications,
            found.per_object_multiplications,
            found.uniform_bytes,
        )

    columns = ("space", "a vertex", "a fragment", "an object", "bytes of uniforms")
    return Part(
        (
            Heading("What it costs"),
            Text("Multiplications for light with a highlight, counted where they happen."),
            Table(columns, in_each(USUAL_SPACES, row)),
            Text(
                "For one matrix exact whole numbers take less than twice the time of a float64 "
                "inverse. What is visible in a picture are normals that are zero, not a number, "
                "flipped or skewed; the last digits of a good one are not."
            ),
        )
    )


# Exercises belong to a student and are not made here.
PARTS: dict[Topic, Callable[[Setup, PageFormat], Part]] = {
    Topic.RULE: rule,
    Topic.WORKED: _worked,
    Topic.SPACES: spaces,
    Topic.PROOFS: _proofs,
    Topic.PITFALLS: _pitfalls,
    Topic.COST: _cost,
}
