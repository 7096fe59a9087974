"""The proof of shading and reflection: where light is computed, and what the shader makes of it."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from nmatrix.canvas.marks import Box, Canvas, Polygon, Raster
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Reflection, Theme
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.shading import (
    CORNERS,
    EVERYWHERE,
    EYE_AT,
    GLOSS,
    HOW,
    LOBE,
    MIDDLE,
    WHERE,
    _brightness,
    _triangle,
)
from nmatrix.scene.material import Material
from nmatrix.scene.meshes.shapes import box
from nmatrix.scene.scene import Settings

SMALL = Settings(size=(400, 225), samples=1)
SHINY = Material(specular=GLOSS)


def proof(**settings: object) -> Proof:
    chosen = ProofSettings("shading", **{"picture": SMALL, **settings})  # type: ignore[arg-type]
    return PictureFrame("shading", chosen).draw()


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def test_every_shading_and_every_reflection_has_its_panel() -> None:
    headings = [one.heading for one in slide(proof()).panels]
    assert set(headings) == {*WHERE.values(), *HOW.values(), "Gouraud − Phong"}
    assert len(HOW) == len(Reflection)


def test_shading_models_differ_where_they_should() -> None:
    found = proof().numbers
    assert found["gouraud_against_phong"] > 0
    assert found["flat_against_phong"] > 30
    assert found["phong_against_blinn_phong"] > 10


def test_no_two_of_the_choices_are_one_picture() -> None:
    rasters = [one.pixels for one in slide(proof()).canvas.marks if isinstance(one, Raster)]
    assert len(rasters) == len(WHERE) + len(HOW) + 1
    for i, one in enumerate(rasters):
        assert all(one.shape != other.shape or (one != other).any() for other in rasters[:i])


@pytest.mark.parametrize(("dots", "count"), [(MIDDLE, 1), (CORNERS, 3), (EVERYWHERE, 21)])
def test_the_dots_of_a_triangle_lie_in_it(dots: tuple, count: int) -> None:
    canvas = Canvas(400, 300, PALETTES[Theme.LIGHT])
    _triangle(canvas, Box(0, 0, 400, 300), dots)
    triangle, *discs = (one for one in canvas.marks if isinstance(one, Polygon))
    assert len(discs) == count
    a, b, c = (np.array(point) for point in triangle.loops[0])
    for disc in discs:
        middle = np.mean(disc.loops[0], axis=0)
        parts = np.linalg.solve(np.stack([b - a, c - a], axis=1), middle - a)
        assert parts.min() >= -1e-9
        assert parts.sum() <= 1 + 1e-9


def test_the_lobe_of_lambert_is_the_cosine() -> None:
    turns = np.radians([-90, -60, 0, 30, 90])
    found = _brightness(replace(SHINY, reflection=Reflection.LAMBERT), turns)
    assert found == pytest.approx(np.cos(turns) * np.mean(SHINY.diffuse), abs=1e-12)


@pytest.mark.parametrize("reflection", [Reflection.PHONG, Reflection.BLINN_PHONG])
def test_a_highlight_is_brightest_where_the_eye_is_mirrored(reflection: Reflection) -> None:
    turns = np.radians(np.linspace(-90, 90, 1801))
    matte = _brightness(replace(SHINY, reflection=Reflection.LAMBERT), turns)
    gloss = _brightness(replace(SHINY, reflection=reflection), turns) - matte
    assert np.degrees(turns[gloss.argmax()]) == pytest.approx(EYE_AT, abs=0.2)
    assert gloss.max() == pytest.approx(GLOSS[0])


def test_a_lobe_of_toon_has_as_many_lengths_as_bands() -> None:
    turns = np.radians(np.linspace(-89, 89, 400))
    found = _brightness(replace(SHINY, reflection=Reflection.TOON), turns)
    assert len(np.unique(np.round(found, 9))) == SHINY.toon_steps


def test_lobes_stay_on_their_stage() -> None:
    turns = np.radians(np.linspace(-90, 90, 181))
    for reflection in Reflection:
        longest = LOBE * _brightness(replace(SHINY, reflection=reflection), turns).max()
        assert longest < 84  # units to the side of the stage


def test_the_footer_says_so_where_the_mesh_shows_no_difference() -> None:
    """On a box normals are even across each face: flat, Gouraud and Phong are one."""
    found = proof(mesh=box(), reflection=Reflection.LAMBERT)
    said = [one.text for one in slide(found).canvas.marks if hasattr(one, "text")]
    assert any("cannot be told apart" in text for text in said)
    assert not any("up to 0 %" in text for text in said)
