"""What holds of every proof as a picture: legible, honest, the same marks in three themes."""

from __future__ import annotations

from functools import cache
from itertools import combinations

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import SMALLEST_TEXT, Box, Text
from nmatrix.canvas.slide import Panel, Slide
from nmatrix.canvas.text import LEADING, plain
from nmatrix.enums import Theme
from nmatrix.raster.proofs.catalogue import PROOFS
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.scene import Settings

NAMES = [one.name for one in PROOFS]
# Panels that are stages of one idea, or choices: they have no verdict.
WITHOUT_VERDICTS = {"shading", "spaces", "effects"}
SIZES = [(640, 360), (400, 560)]


@cache
def proof(name: str, theme: Theme = Theme.LIGHT, size: tuple[int, int] = (640, 360)) -> Proof:
    picture = Settings(size=size, samples=1)
    return PictureFrame(name, ProofSettings(name, picture=picture, theme=theme)).draw()


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def pixels_of(found: Proof, panel: Panel) -> np.ndarray:
    """Return what is drawn on the stage of a panel."""
    k, box = slide(found).canvas.scale, panel.stage
    left, top, right, bottom = (round(k * s) for s in (box.x, box.y, box.right, box.bottom))
    return found.image[top:bottom, left:right].astype(int)


def texts(found: Proof) -> list[Text]:
    return [one for one in slide(found).canvas.marks if isinstance(one, Text)]


def overlap(a: Box, b: Box) -> bool:
    wide = min(a.right, b.right) - max(a.x, b.x)
    high = min(a.bottom, b.bottom) - max(a.y, b.y)
    return wide > 1 and high > 1


@pytest.mark.parametrize("size", SIZES)
@pytest.mark.parametrize("name", NAMES)
def test_no_text_leaves_the_sheet_or_covers_another(name: str, size: tuple[int, int]) -> None:
    found = proof(name, size=size)
    canvas = slide(found).canvas
    boxes = [(one, one.box) for one in texts(found)]
    for one, box in boxes:
        assert box.x >= -1, one.text
        assert box.right <= canvas.width + 1, one.text
        assert box.y >= -1, one.text
        assert box.bottom <= canvas.height + 1, one.text
    for (one, a), (other, b) in combinations(boxes, 2):
        inner = [Box(c.x, c.y + 0.2 * c.height, c.width, 0.6 * c.height) for c in (a, b)]
        assert not overlap(*inner), (one.text, other.text)


@pytest.mark.parametrize("name", NAMES)
def test_nothing_is_written_smaller_than_can_be_read(name: str) -> None:
    found = proof(name)
    assert min(one.size for one in texts(found)) >= SMALLEST_TEXT
    (title,) = (one for one in texts(found) if one.text == slide(found).title)
    assert 36 <= title.size <= 44
    assert title.box.right <= slide(found).frame.right + 1, "it fits one line"


@pytest.mark.parametrize("name", NAMES)
def test_captions_are_three_short_lines_that_name_no_colour(name: str) -> None:
    found = proof(name)
    colours = {"red", "green", "blue", "yellow", "orange", "purple", "grey", "gray"}
    for panel in slide(found).panels:
        assert not colours & set(panel.caption.lower().replace(",", " ").split())
        below = [
            one
            for one in texts(found)
            if one.size == 22
            and abs(one.place[0] - panel.stage.x) < 1
            and 0 < one.place[1] - panel.stage.bottom < 38 + 3.5 * 22 * LEADING
        ]
        assert len(below) <= 3 or name in {"flashlight", "stuck-light"}


@pytest.mark.parametrize("name", NAMES)
def test_each_panel_has_a_verdict_or_is_known_to_have_none(name: str) -> None:
    panels = slide(proof(name)).panels
    verdicts = {panel.verdict for panel in panels}
    if name in WITHOUT_VERDICTS:
        assert verdicts == {None}
    else:
        assert {Verdict.WRONG, Verdict.RIGHT} <= verdicts


@pytest.mark.parametrize("name", NAMES)
def test_no_two_panels_are_the_same_picture_unless_an_equals_sign_says_so(name: str) -> None:
    found = proof(name)
    panels = slide(found).panels
    said = {frozenset(map(id, pair)) for pair in slide(found).same}
    for a, b in combinations(panels, 2):
        one, other = (pixels_of(found, panel) for panel in (a, b))
        if one.shape == other.shape and (one == other).all():
            assert frozenset((id(a), id(b))) in said or _linked(a, b, said, panels)


def _linked(a: Panel, b: Panel, said: set, panels: list[Panel]) -> bool:
    """Tell whether a chain of = leads from one panel to another."""
    reached, grew = {id(a)}, True
    while grew:
        more = {i for pair in said if pair & reached for i in pair} | reached
        grew, reached = more != reached, more
    return id(b) in reached


@pytest.mark.parametrize("name", sorted(set(NAMES) - WITHOUT_VERDICTS))
def test_wrong_and_right_differ_in_grey(name: str) -> None:
    found = proof(name, Theme.PRINT)
    panels = slide(found).panels
    for wrong in (one for one in panels if one.verdict is Verdict.WRONG):
        rights = [one for one in panels if one.verdict is Verdict.RIGHT]
        same = [
            one for one in rights if pixels_of(found, one).shape == pixels_of(found, wrong).shape
        ]
        for one in same:
            apart = np.abs(pixels_of(found, one) - pixels_of(found, wrong)).max()
            assert apart > 20


@pytest.mark.parametrize("name", NAMES)
def test_the_three_themes_draw_the_same_marks(name: str) -> None:
    first, *others = (
        [type(one) for one in slide(proof(name, theme)).canvas.marks] for theme in Theme
    )
    assert all(first == other for other in others)
    assert np.ptp(proof(name, Theme.PRINT).image.astype(int), axis=2).max() <= 1


@pytest.mark.parametrize("size", [(64, 64), (64, 400), (600, 70)])
@pytest.mark.parametrize("name", NAMES)
def test_a_picture_of_any_shape_is_drawn(name: str, size: tuple[int, int]) -> None:
    assert proof(name, size=size).image.shape == (size[1], size[0], 3)


@pytest.mark.parametrize("entry", PROOFS, ids=NAMES)
def test_the_title_of_a_proof_is_its_claim(entry) -> None:
    """What `--list` says, what the terminal prints, and what stands on the picture."""
    found = proof(entry.name)
    assert found.texts["Title"].startswith(entry.claim)
    assert plain(slide(found).title) == found.texts["Title"]
