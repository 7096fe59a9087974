"""The first page: the claim, the drawing that shows it, its proof in one line, and the four spaces.

Whoever has read it has met every letter that the rest of the sheet uses.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field, replace
from decimal import Decimal
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.canvas.diagrams import circle_to_ellipse
from nmatrix.canvas.marks import Box, Canvas
from nmatrix.canvas.paint import vector
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Space, Theme
from nmatrix.linear.classify import condition
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Figure, Formula, Framed, Heading, Symbols, Table, Text, Verdict
from nmatrix.spaces.shading_spaces import PROFILES

if TYPE_CHECKING:
    from collections.abc import Mapping

    from nmatrix.output.pages.document import PageFormat
    from nmatrix.scene.setup import Setup

CLAIM = "A normal is carried by the inverse transpose"
IDEA = "idea"  # the name of the drawing
IDEA_SIZE = (
    900.0,
    236.0,
)  # units: the width of a page, so that 26 of them are letters of 14 points
IDEA_BOX = Box(0, -11, 900, 282)  # of the diagram, whose pad paper does not need
DOUBLED = 2
DRAWN = (Decimal("1.8"), Decimal(4))  # conditions that can be seen and fit the page

SYMBOLS = (
    ("M", "world from object, 4×4"),
    ("A", "its 3×3 block: no translation"),
    ("n", "normal: at a right angle to the surface"),
    ("t", "tangent: lies in the surface"),
    ("l", "direction to a light far away, length 1"),
    ("e", "place of the eye"),
    ("V", "camera from world, 4×4"),
    ("L", "light from world, 4×4"),
)
LETTERS = {Space.OBJECT: "M⁻¹", Space.WORLD: "", Space.CAMERA: "V", Space.LIGHT: "L"}
INVERTIBLE = "moves a surface and has an inverse"
BLOCKS = "For a direction take the 3×3 block of V and of L. Every row gives the same picture."


@dataclass(frozen=True)
class Part:
    """One topic on paper: its blocks, and the files that their figures name."""

    blocks: tuple[Block, ...]
    pictures: Mapping[str, bytes] = field(default_factory=dict)


def rule(setup: Setup, kind: PageFormat) -> Part:
    """State the theorem under its drawing, prove it in one line, and introduce the letters."""
    shown = short_text(_stretch(setup), 3)
    times = "twice" if shown == str(DOUBLED) else f"{shown} times"
    name = f"{IDEA}.{kind.drawings}"
    figure = Figure(
        name,
        f"A circle and the ellipse that A makes of it, {times} as wide as high. On the circle the "
        "normal n stands at a right angle to the tangent t. On the ellipse A n, dashed, leans "
        "away from the right angle to A t; the inverse transpose of A times n keeps it.",
        f"Drawn for an A that makes the circle {times} as wide as high: its tangent t becomes A t. "
        "The normal does not become A n (dashed), which leans: at a right angle to A t stands "
        "A⁻ᵀ n.",
    )
    premise = "moves a surface" if setup.maps.world_from_object.linear_map.rank == 3 else INVERTIBLE
    theorem = Framed(
        (
            Verdict(f"If A {premise}, then A⁻ᵀ, the inverse of A transposed, moves normals."),
            Text(
                "Why: the new normal A⁻ᵀ n and the new tangent A t make a right angle, as n and t."
            ),
            Formula(("(A⁻ᵀ n) · (A t) = nᵀ A⁻¹ A t = n · t = 0",)),
        )
    )
    drawing = drawn_idea(setup, kind.theme)
    written = vector(drawing, kind.drawings, {"Title": CLAIM, "Description": figure.alternative})
    return Part((figure, theorem, Symbols(SYMBOLS)), {name: written})


def _stretch(setup: Setup) -> Fraction:
    """Return the ratio of A's largest stretch to its least, where that can be drawn; else 2."""
    kappa = condition(setup.maps.world_from_object.linear_map)
    if kappa is None or not DRAWN[0] <= kappa <= DRAWN[1]:
        return Fraction(DOUBLED)
    return Fraction(kappa)


def drawn_idea(setup: Setup, theme: Theme) -> Canvas:
    """Draw the circle and its ellipse on paper, without a stage."""
    palette = PALETTES[theme]
    canvas = Canvas(*IDEA_SIZE, replace(palette, stage=palette.paper))
    circle_to_ellipse(canvas, IDEA_BOX, float(_stretch(setup)))
    return canvas


def spaces(setup: Setup, kind: PageFormat) -> Part:
    """Tabulate what normals, lights, the eye and lengths are in each of the four spaces."""
    is_flat = setup.maps.world_from_object.linear_map.rank < 3
    columns = ("space", "normal", "direction to the light", "eye", "length of a vector v")
    there = [space for space in LETTERS if not (is_flat and space is Space.OBJECT)]
    rows = tuple(tuple(_row(space, is_flat=is_flat)) for space in there)
    blocks = (Heading("Where can the light be computed?"), Table(columns, rows), Text(BLOCKS))
    if not is_flat:
        return Part(blocks)
    flat = "A flattens: it has no inverse and no object space to go back to; C are its cofactors."
    return Part((*blocks, Text(flat)))


def _row(space: Space, *, is_flat: bool) -> Iterator[str | Formula]:
    """Fill the line of a space by the matrix that leads there."""
    letter, profile = LETTERS[space], PROFILES[space]
    block = letter.replace("M", "A")
    yield space.value
    if profile.moves_vertices:
        by = f"({letter} A)⁻ᵀ" if letter else "A⁻ᵀ"
        yield Formula((f"{letter} C n" if is_flat else f"{by} n",))
    else:
        yield "n, as in the file"
    yield Formula((f"{block} l = (0, 0, 1)" if space is Space.LIGHT else f"{block} l",))
    yield Formula(("(0, 0, 0)" if profile.eye_is_origin else f"{letter} e",))
    yield Formula(("|v|² = vᵀ Aᵀ A v",)) if space is Space.OBJECT else "as usual"
