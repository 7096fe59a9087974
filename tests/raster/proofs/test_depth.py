"""The proof of depth: the steps of buffers in closed form, and the floors that they confuse."""

from __future__ import annotations

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.slide import Slide
from nmatrix.raster.proofs.depth import (
    CROSSING,
    FAR,
    GAP,
    HEIGHT,
    NEAR,
    gap,
    reversed_step,
    standard_step,
)
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.scene import Settings

DISTANCES = np.array([10.0, 280.0, 1000.0, 2500.0])


def proof(size: tuple[int, int] = (400, 225)) -> Proof:
    return PictureFrame(
        "depth", ProofSettings("depth", picture=Settings(size=size, samples=1))
    ).draw()


def test_reversed_float_depth_alone_ends_the_fight() -> None:
    found = proof().numbers
    assert found["wrong_float32_reversed"] == 0
    assert found["wrong_float32_standard"] > 0.02
    assert found["wrong_unorm24_reversed"] == pytest.approx(
        found["wrong_unorm24_standard"], abs=0.02
    )
    assert found["wrong_unorm16_standard"] > 0.5


def test_the_verdicts_are_those_of_the_counted_shares() -> None:
    found = proof()
    assert isinstance(found.picture, Slide)
    *wrong, right = found.picture.panels[:4]
    assert {one.verdict for one in wrong} == {Verdict.WRONG}
    assert right.verdict is Verdict.RIGHT
    assert right.heading == "reversed, 32-bit float"


@pytest.mark.parametrize("distance", DISTANCES)
def test_a_standard_step_is_the_spacing_of_floats_below_one(distance: float) -> None:
    stored = np.float32(FAR * (distance - NEAR) / distance / (FAR - NEAR))
    slope = FAR * NEAR / (FAR - NEAR) / distance**2
    assert standard_step(np.array(distance)) == pytest.approx(np.spacing(stored) / slope)


@pytest.mark.parametrize("distance", DISTANCES)
def test_a_reversed_step_is_the_widest_spacing_of_its_float(distance: float) -> None:
    stored = np.float32(NEAR * (FAR - distance) / distance / (FAR - NEAR))
    slope = FAR * NEAR / (FAR - NEAR) / distance**2
    step = np.spacing(stored) / slope
    assert step <= reversed_step(np.array(distance)) * (1 + 1e-6)
    assert reversed_step(np.array(distance)) <= 2 * step * (1 + 1e-6)


@pytest.mark.parametrize("distance", DISTANCES)
def test_the_gap_is_what_a_ray_goes_on_between_the_floors(distance: float) -> None:
    assert gap(np.array(distance)) == pytest.approx(distance * ((HEIGHT + GAP) / HEIGHT - 1))


def test_a_step_is_as_wide_as_the_gap_where_the_lines_cross() -> None:
    assert standard_step(np.array(CROSSING)) == pytest.approx(gap(np.array(CROSSING)), rel=1e-4)
    assert (reversed_step(DISTANCES) < gap(DISTANCES) / 1000).all()


def test_shares_do_not_depend_on_the_size() -> None:
    assert proof((300, 400)).numbers == proof().numbers
