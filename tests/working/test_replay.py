"""What is printed can be computed again by reading it: every line follows from those before."""

from __future__ import annotations

import random
from fractions import Fraction
from math import inf, isclose

import pytest
from drawn_workings import Make, workings
from replay import Replay

from nmatrix.enums import InverseBy
from nmatrix.errors import NMatrixError, NoAnswerError
from nmatrix.linear.measured_lens import HorizontalField
from nmatrix.linear.projection import ClipSpace, Window
from nmatrix.output.write import OutputOptions, write
from nmatrix.report import Report
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.measured_view import Extrinsics, Pose
from nmatrix.scene.world import World
from nmatrix.working import (
    elimination,
    inverses,
    projection,
    view,
    world,
)
from nmatrix.working.working import Working


def printed(working: Working) -> str:
    return write(Report("steps", {}, working.steps), OutputOptions())


def replayed(make: Make) -> Replay | None:
    """Print a working and read it again; None where there is none."""
    try:
        working = make()
    except NMatrixError:
        return None
    assert all(step.verified for step in working.steps)
    text = printed(working)
    assert max(map(len, text.splitlines())) <= 80
    return Replay().read(text)


def checked(seed: int, every: int = 1) -> set[str]:
    """Replay workings of one seed, every so many of the kinds; those that had an answer."""
    found = set()
    for kind, make in list(workings(random.Random(seed)))[seed % every :: every]:
        replay = replayed(make)
        if replay is not None:
            unchecked = [line for line in replay.unchecked if not _is_given(line)]
            assert not unchecked, (seed, kind, unchecked)
            found.add(kind)
    return found


def _is_given(words: str) -> bool:
    """Recognise a line that only writes something down: A = [ ],  t = [ ]."""
    return all(one.endswith("=  ⟦⟧") for one in words.strip().split(" ,  "))


@pytest.mark.parametrize("seed", range(30))
def test_every_printed_line_follows_from_the_lines_before(seed: int) -> None:
    assert len(checked(seed, every=2)) >= 6


def test_every_kind_of_working_is_replayed() -> None:
    kinds = {kind for kind, _ in workings(random.Random(0))}
    assert set().union(*map(checked, range(30, 38))) == kinds


@pytest.mark.slow
def test_five_hundred_random_matrices_are_replayed() -> None:
    for seed in range(100, 600):
        checked(seed, every=8)


@pytest.mark.parametrize(
    "line",
    [
        "A = ⎡ 1  2 ⎤\n    ⎣ 3  4 ⎦\n    ✓\n",
        "R₂ ← R₂ − 3 R₁  ⇒  [ 1  2 ]\n    ✓\n",
    ],
)
def test_the_reader_of_steps_does_not_believe_what_is_wrong(line: str) -> None:
    text = "".join(f"  {one}\n" for one in line.splitlines())
    wrong = Replay()
    wrong.values = {"A": [[Fraction(1)] * 2] * 2}
    wrong.last = [[Fraction(1)] * 2] * 2
    with pytest.raises(AssertionError):
        wrong.read(text.replace("    ✓", "  ✓ "))


SETUPS = (
    {"scale": (1, 2, 1), "rotate_degrees": (0, 30, 0)},
    {"rotate_degrees": (10, 20, 45), "translate": (1, 0.5, -3), "shear": (1, 0, 0.25)},
    {"quaternion": (1, 2, 3, 4), "translate": (0.1, 0, 0), "scale": (2, -1, 0)},
    {"axis_angle": (1, 1, 0, 40), "scale": (1, 3, 1)},
    {},
)


@pytest.mark.parametrize("parts", SETUPS)
def test_a_world_is_replayed_with_its_roots_and_decimals(parts: dict) -> None:
    found = replayed(lambda: world.world_matrix(World(**parts)))
    assert found is not None
    assert found.checked >= 1


LENSES = (
    Lens(60, 16 / 9),
    Lens(50, 1, far=inf, clip=ClipSpace("reversed", "left", "down")),
    Lens(frustum=Window(-1, 2, -0.5, 1.5), near=0.5),
    Lens(ortho=Window(-1, 2, -0.5, 1.5), near=-1, clip="vulkan"),
    Lens(measured=HorizontalField(80), aspect=2),
)


@pytest.mark.parametrize("lens", LENSES, ids=repr)
def test_a_projection_is_replayed(lens: Lens) -> None:
    found = replayed(lambda: projection.projection_matrix(lens))
    assert found is not None
    assert found.checked >= 5


@pytest.mark.parametrize(
    "camera",
    [
        View(eye=(3, 3, 2.5)),
        View(eye=(0, 5, 0)),
        View(eye=(1.23, 4.56, 7.89123), target=(0.1, 0.2, 0.3), handed="left"),
        View(eye=(1, 2, 3), angles=(20, 30, 10)),
        View(eye=(1, 2, 3), angles=(0, 0, 0), convention="polimi"),
        View(measured=Pose(((0, -1, 0, 2), (1, 0, 0, 3), (0, 0, 1, 4), (0, 0, 0, 1)))),
        View(measured=Extrinsics(((0, -1, 0, 2), (1, 0, 0, 3), (0, 0, 1, 4), (0, 0, 0, 1)))),
    ],
    ids=repr,
)
def test_a_view_is_replayed_and_is_the_matrix_that_nmatrix_shows(camera: View) -> None:
    working = view.view_matrix(camera)
    found = replayed(lambda: working)
    assert found is not None
    assert found.checked >= 2
    assert _is_near(working.value, camera.placed().camera_from_world)


@pytest.mark.parametrize("parts", SETUPS)
def test_steps_end_in_the_world_matrix_that_nmatrix_shows(parts: dict) -> None:
    placed = World(**parts)
    assert _is_near(world.world_matrix(placed).value, placed.world_from_object)


@pytest.mark.parametrize("lens", LENSES, ids=repr)
def test_steps_end_in_the_projection_that_nmatrix_shows(lens: Lens) -> None:
    assert _is_near(projection.projection_matrix(lens).value, lens.clip_from_camera)


def _is_near(found, shown) -> bool:
    return all(
        isclose(float(a), float(b), rel_tol=1e-14, abs_tol=1e-14)
        for row, other in zip(found, shown, strict=True)
        for a, b in zip(row, other, strict=True)
    )


def test_looking_at_a_target_takes_eight_lines() -> None:
    assert len(view.look_at((3, 3, 2), (0, 0, 0)).steps) == 8


def test_what_has_no_answer_says_so() -> None:
    flat = ((1, 2), (2, 4))
    for way in (InverseBy.ADJUGATE, InverseBy.GAUSS):
        with pytest.raises(NoAnswerError, match="singular"):
            inverses.inverse(flat, method=way)
    with pytest.raises(NoAnswerError, match="without a solution"):
        elimination.solve(flat, (1, 3))
    with pytest.raises(NoAnswerError, match="many solutions"):
        elimination.solve(flat, (1, 2))
