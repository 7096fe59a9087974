"""The proof of effects: the plan's picture is that of everything, and what it saves adds up."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from nmatrix.canvas.marks import Raster, Text
from nmatrix.canvas.slide import Slide
from nmatrix.enums import Theme
from nmatrix.raster.proofs.effects import _drawn, _places, effects
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.scene import Settings

SMALL = Settings(size=(400, 225), samples=1)


@cache
def proof(theme: Theme = Theme.LIGHT) -> Proof:
    return effects(ProofSettings("effects", picture=SMALL, theme=theme))


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def test_effects_are_left_out_without_a_trace() -> None:
    found = proof().numbers
    assert found["difference"] <= 1e-12
    assert found["multiplications_planned"] < 0.9 * found["multiplications_everything"]
    assert len(slide(proof()).same) == 1


def test_what_is_named_adds_up_to_what_is_saved() -> None:
    settings = ProofSettings("effects", picture=SMALL)
    found = _drawn(settings, _places(settings.slide(""))[0])
    counts = [count for _, count in found.left_out]
    assert counts == sorted(counts, reverse=True)
    assert sum(counts) == found.most - found.needed


def test_the_title_and_the_list_have_the_numbers_of_the_work() -> None:
    found = proof().numbers
    saved = 1 - found["multiplications_planned"] / found["multiplications_everything"]
    assert f"{100 * saved:.0f} % less work" in slide(proof()).title
    words = [one.text for one in slide(proof()).canvas.marks if isinstance(one, Text)]
    shares = [int(one.removesuffix(" %")) for one in words if one.endswith(" %")]
    assert len(shares) == 5
    assert sum(shares) <= 100 * saved + len(shares) / 2


def test_the_footer_promises_no_less_than_what_was_measured() -> None:
    words = [one.text for one in slide(proof()).canvas.marks if isinstance(one, Text)]
    (footer,) = (one for one in words if one.startswith("No channel"))
    mantissa, exponent = footer.split("more than ")[1].split(" of")[0].split(" · 10^{")
    said = float(mantissa) * 10.0 ** int(exponent.rstrip("}").replace("−", "-"))
    assert proof().numbers["difference"] <= said * (1 + 1e-9)


@pytest.mark.parametrize("theme", Theme)
def test_the_scene_stands_before_the_colour_of_the_stage(theme: Theme) -> None:
    first, _ = (one for one in slide(proof(theme)).canvas.marks if isinstance(one, Raster))
    stage = slide(proof(theme)).palette.stage
    expected = [int(stage[i : i + 2], 16) for i in (1, 3, 5)]
    if theme is Theme.PRINT:
        assert np.ptp(first.pixels.astype(int), axis=2).max() == 0
    assert np.abs(first.pixels[0, 0].astype(int) - expected).max() <= 1
