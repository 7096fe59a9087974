"""Mirror, translation and flatten: their claims, by geometry, and what they say of other maps."""

from __future__ import annotations

from functools import cache
from itertools import pairwise

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.marks import Polygon, Raster, Stroke, Text
from nmatrix.canvas.slide import Panel, Slide
from nmatrix.raster.drawn_scene import drawn_scene
from nmatrix.raster.proofs import mirror
from nmatrix.raster.proofs.catalogue import Turning, catalogued
from nmatrix.raster.proofs.frames import PictureFrame, turns
from nmatrix.raster.proofs.letter import letter_r
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.meshes.mesh import Mesh
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World

NAMES = ("mirror", "translation", "flatten")
SMALL = Settings(size=(320, 180), samples=1)
MAPS = {
    "identity": World(),
    "rotation": World(rotate_degrees=(20, 30, 40)),
    "larger": World(scale=(3, 3, 3)),
    "stretch": World(scale=(1, 2, 1)),
    "mirror": World(scale=(1, 1, -1.3), translate=(0, 5, 1)),
    "rank 2": World(scale=(1, 0, 2), translate=(1, 0, 0)),
    "rank 1": World(scale=(0, 1, 0), translate=(0, 2, 0)),
    "rank 0": World(scale=(0, 0, 0)),
    "hard": World(scale=(1, 1e-9, 1), rotate_degrees=(33, 22, 11)),
    "hardly moved": World(translate=(1e-7, 0, 0)),
    "far": World(translate=(1e6, 0, 0)),
    "huge": World(scale=(1e30, -1e30, 1e30)),
    "shear": World(shear=(1, 0.5, 0), translate=(1, 1, -2)),
}


@cache
def proof(name: str, of: str | None = None) -> Proof:
    world = None if of is None else MAPS[of]
    return PictureFrame(name, ProofSettings(name, world=world, picture=SMALL)).draw()


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def words(found: Proof) -> str:
    marks = slide(found).canvas.marks
    return " ".join(one.text for one in marks if isinstance(one, Text))


def verdicts(found: Proof) -> list[Verdict | None]:
    return [one.verdict for one in slide(found).panels]


def marks_on(found: Proof, panel: Panel, kind: type) -> list:
    """Return the marks of a kind whose first point is on a stage."""
    chosen = [one for one in slide(found).canvas.marks if isinstance(one, kind)]
    first = [one.points[0] if kind is Stroke else one.loops[0][0] for one in chosen]
    return [one for one, point in zip(chosen, first, strict=True) if panel.stage.holds(point)]


def picture_of(found: Proof, panel: Panel) -> np.ndarray:
    """Return the last picture that was laid on a stage."""
    layers = [one for one in slide(found).canvas.marks if isinstance(one, Raster)]
    return next(one.pixels for one in reversed(layers) if one.box == panel.stage).astype(int)


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("of", MAPS)
def test_every_map_is_drawn_and_no_text_leaves_the_sheet(name: str, of: str) -> None:
    found = proof(name, of)
    canvas = slide(found).canvas
    assert found.verdict.endswith(".")
    for mark in canvas.marks:
        if isinstance(mark, Text):
            assert mark.box.x >= -1, mark.text
            assert mark.box.right <= canvas.width + 1, mark.text


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("of", MAPS)
def test_right_panels_side_by_side_are_the_same_picture_and_an_equals_sign_says_so(
    name: str, of: str
) -> None:
    found = proof(name, of)
    said = {(id(a), id(b)) for a, b in slide(found).same}
    for a, b in pairwise(slide(found).panels):
        both = a.verdict is b.verdict is Verdict.RIGHT
        assert ((id(a), id(b)) in said) == both
        if both:
            assert np.abs(picture_of(found, a) - picture_of(found, b)).max() <= 1


# mirror


def test_without_the_sign_normals_are_upside_down_and_the_winding_shows_the_inside() -> None:
    found = proof("mirror")
    assert verdicts(found) == [None, Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT]
    assert found.max_angle_error_deg == pytest.approx(180)
    assert found.max_level_difference > 100
    assert found.numbers["winding_level_difference"] > 100
    assert "det A = −1" in words(found)


def test_before_a_mirror_the_letter_is_as_bright_as_after() -> None:
    found = proof("mirror")
    before, wrong, _, right = (picture_of(found, one) for one in slide(found).panels)
    bright, dark, again = (
        (one.max(axis=2) - one.min(axis=2) < 40)
        & (one.mean(axis=2) > 180)
        & (np.abs(one - one[0, 0]).sum(axis=2) > 24)
        for one in (before, wrong, right)
    )  # the face in the light
    assert bright.mean() == pytest.approx(again.mean(), rel=0.05)
    assert dark.mean() < bright.mean() / 20


def test_the_letter_after_is_the_mirror_image_of_the_letter_before() -> None:
    """From the same side the outlines have the same area, and are not the same."""
    found = proof("mirror")
    covered = [
        (np.abs(one - one[0, 0]).sum(axis=2) > 24)
        for one in (picture_of(found, panel) for panel in slide(found).panels)
    ]
    assert covered[0].sum() == pytest.approx(covered[3].sum(), rel=0.1)
    assert (covered[0] != covered[3]).mean() > 0.05
    assert (covered[2] == covered[3]).mean() > 0.99, "the inside is seen where the shape is"


def test_what_the_other_winding_shows_lies_behind_the_front() -> None:
    settings = ProofSettings("letter", letter_r(), picture=SMALL)
    one = settings.object(mirror.MIRRORED)
    front, inside = (
        drawn_scene(settings.scene(thing), keeps_depth=True).rendered.depth.farthest
        for thing in (one, mirror.inside_out(one))
    )
    both = np.isfinite(front) & np.isfinite(inside)
    assert both.sum() > 1000
    assert (inside[both] > front[both]).mean() > 0.98


@pytest.mark.parametrize("of", ["identity", "rotation", "larger", "stretch", "shear", "hard"])
def test_without_a_mirror_the_sign_is_no_mistake_and_a_flipped_winding_is(of: str) -> None:
    found = proof("mirror", of)
    assert slide(found).title.startswith("No mirror")
    assert [one for one in verdicts(found) if one] == [Verdict.WRONG, Verdict.RIGHT]
    assert found.max_angle_error_deg == pytest.approx(0, abs=1e-6)
    assert (slide(found).panels[0].heading == "Before") == (of not in {"identity", "larger"})


@pytest.mark.parametrize(
    ("of", "told"), [("mirror", "det A ≈ −1.3"), ("stretch", "det A = 2"), ("huge", "det A < 0"),
                     ("rank 2", "det A = 0"), ("hard", "det A > 0")],
)  # fmt: skip
def test_the_determinant_is_told_in_few_digits_or_by_its_sign(of: str, told: str) -> None:
    assert told in words(proof("mirror", of))


# translation


def test_with_w_1_a_translation_turns_normals_around() -> None:
    found = proof("translation")
    assert verdicts(found) == [Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT]
    assert "up to 180°" in words(found)
    assert found.numbers["shortest_normal"] == pytest.approx(1 / np.hypot(1, 2.6), rel=1e-6)
    assert "0.36" in slide(found).panels[1].caption


def test_t_is_drawn_as_long_as_the_ball_went() -> None:
    """The arrow joins the places under the origin and under the ball, in every panel alike."""
    found = proof("translation")
    lengths = []
    for panel in slide(found).panels:
        lines = [
            one
            for one in marks_on(found, panel, Stroke)
            if len(one.points) == 2 and one.colour == slide(found).palette.ink and one.width > 5
        ]
        (line,) = lines
        lengths.append(np.hypot(*np.subtract(*line.points)))
    assert np.ptp(lengths) < 1
    assert lengths[0] > 100


@pytest.mark.parametrize(
    ("of", "begins"),
    [("identity", "Without a translation"), ("stretch", "Without a translation"),
     ("hardly moved", "So small a translation"), ("far", "A normal has no place"),
     ("rank 2", "A normal has no place"), ("rank 1", "No surface"), ("rank 0", "No surface")],
)  # fmt: skip
def test_the_title_of_translation_is_true_of_the_map(of: str, begins: str) -> None:
    assert slide(proof("translation", of)).title.startswith(begins)


def test_without_a_translation_a_stretch_is_not_blamed_on_it() -> None:
    found = proof("translation", "stretch")
    assert verdicts(found) == [Verdict.WRONG, Verdict.RIGHT, Verdict.RIGHT]
    assert "A itself" in slide(found).panels[0].caption
    assert "not by the translation" in words(found)


# flatten


def test_a_plane_has_no_inverse_and_two_normals() -> None:
    found = proof("flatten")
    assert verdicts(found) == [None, Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT]
    assert found.numbers["rank"] == 2
    assert found.max_level_difference > 50
    written = words(found)
    assert "1 / 0" in written
    assert written.endswith("0 0 0"), "one on each tack of the zero matrix"
    heads = [
        one
        for one in marks_on(found, slide(found).panels[3], Polygon)
        if one.fill == slide(found).palette.right
    ]
    assert len(heads) == 6, "each of three tacks goes through the coin"


@pytest.mark.parametrize("of", ["identity", "rotation", "stretch", "mirror", "hard"])
def test_a_map_that_flattens_nothing_is_said_to_have_an_inverse(of: str) -> None:
    found = proof("flatten", of)
    assert "flattens nothing" in slide(found).title
    assert verdicts(found) == [Verdict.RIGHT, Verdict.RIGHT]
    assert found.max_level_difference <= 1
    assert len(slide(found).same) == 1


@pytest.mark.parametrize(("of", "left"), [("rank 1", "a line"), ("rank 0", "a point")])
def test_a_line_or_a_point_has_no_normal(of: str, left: str) -> None:
    found = proof("flatten", of)
    assert left in slide(found).title
    assert words(found).count(left) >= 2, "it stands on the stage as well"
    assert found.max_angle_error_deg is None


# what all three share


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("normal", [(0.0, 0.0, 1.0), (0.0, 0.0, 0.0)])
def test_one_triangle_with_or_without_normals_is_drawn(name: str, normal: tuple) -> None:
    corners = np.array([[0.0, 0, 0], [1, 0, 0], [0, 1, 0]])
    mesh = Mesh(corners, np.array([normal] * 3), np.array([[0, 1, 2]]))
    found = PictureFrame(name, ProofSettings(name, mesh, picture=SMALL)).draw()
    if not any(normal):
        assert slide(found).title.startswith("No surface")


@pytest.mark.parametrize("name", NAMES)
def test_nothing_jumps_between_frames(name: str) -> None:
    """The words stay, and what does not turn stays where it is."""
    frame = PictureFrame(name, ProofSettings(name, picture=SMALL))
    frames = [frame.turned(angle).draw() for angle in turns(2)]
    told = {tuple(slide(one).told) for one in frames}
    assert len(told) == 1
    entry = catalogued(name)
    assert entry is not None
    suns = [
        {one.loops[0][0] for one in slide(found).canvas.marks
         if isinstance(one, Polygon) and one.fill == slide(found).palette.light}
        for found in frames
    ]  # fmt: skip
    assert (suns[0] == suns[1]) == (entry.turns.what is not Turning.LIGHT)


def test_light_that_turns_changes_the_coin_by_its_normals_and_not_by_a_zero_matrix() -> None:
    frame = PictureFrame("flatten", ProofSettings("flatten", picture=SMALL))
    one, other = (frame.turned(angle).draw() for angle in (0, 120))
    changed = [
        (picture_of(one, a) != picture_of(other, b)).any()
        for a, b in zip(slide(one).panels[2:], slide(other).panels[2:], strict=True)
    ]
    assert changed == [False, True]
