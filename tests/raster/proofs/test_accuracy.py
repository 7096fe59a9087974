"""The proof of accuracy: exact sums against fractions, and what each precision leaves."""

from __future__ import annotations

from fractions import Fraction

import numpy as np
import pytest

from nmatrix.canvas.glyphs import Verdict
from nmatrix.canvas.slide import Slide
from nmatrix.linear.exact import LinearMap
from nmatrix.linear.rational import linear_part
from nmatrix.raster.proofs.accuracy import (
    LEAST_DEG,
    MOST_DEG,
    PRECISIONS,
    SEEN_DEG,
    Cofactors,
    _part,
    hard_world,
)
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.shading.normals import unit
from nmatrix.scene.meshes.shapes import sphere
from nmatrix.scene.scene import Settings
from nmatrix.scene.world import World

SMALL = Settings(size=(400, 225), samples=1)
HARD = Cofactors(LinearMap.of(linear_part(hard_world().world_from_object)))
FLAT = World(scale=(1, 1e-4, 1), rotate_degrees=(10, 20, 30)).world_from_object


def proof(**settings: object) -> Proof:
    chosen = ProofSettings("accuracy", **{"picture": SMALL, **settings})  # type: ignore[arg-type]
    return PictureFrame("accuracy", chosen).draw()


def slide(found: Proof) -> Slide:
    assert isinstance(found.picture, Slide)
    return found.picture


def directions(count: int) -> np.ndarray:
    """Return unit vectors, half of them where the map leaves next to nothing of a normal."""
    some = np.random.default_rng(3).normal(size=(count, 3))
    axis = np.linalg.svd(np.array(HARD.linear_map.cofactors, float))[2][0]
    some[::2] -= np.outer(some[::2] @ axis, axis)
    return unit(some)


def test_exact_sums_are_those_of_fractions() -> None:
    normals = directions(40)
    found = HARD.exactly(normals)
    for n, one in zip(normals, found, strict=True):
        exact = [
            sum(c * Fraction(x) for c, x in zip(row, n.tolist(), strict=True))
            for row in HARD.linear_map.cofactors
        ]
        largest = max(map(abs, exact))
        expected = unit(np.array([float(x / largest) for x in exact]))
        assert one == pytest.approx(expected, abs=4e-16)


def test_floats_alone_would_not_do_as_a_reference() -> None:
    normals = directions(400)
    assert HARD.errors_deg(HARD.rounded(np.float64, normals), HARD.exactly(normals)).max() > 1e-10


def test_accuracy_falls_step_by_step() -> None:
    found = proof().numbers
    assert found["worst_deg_float16"] > 20
    assert SEEN_DEG < found["worst_deg_float32"] < 20
    assert 0 < found["worst_deg_float64"] < 1e-6


def test_what_can_be_seen_is_wrong() -> None:
    verdicts = [one.verdict for one in slide(proof()).panels]
    assert verdicts == [Verdict.WRONG, Verdict.WRONG, Verdict.RIGHT, Verdict.RIGHT]


def test_the_worst_does_not_depend_on_the_size_or_the_turn_of_the_ball() -> None:
    names = [f"worst_deg_{np.dtype(one).name}" for one in PRECISIONS]
    found = [proof(), proof(picture=Settings(size=(150, 200), samples=1))]
    frame = PictureFrame("accuracy", ProofSettings("accuracy", picture=SMALL))
    found.append(frame.turned(100).draw())
    assert len({tuple(one.numbers[name] for name in names) for one in found}) == 1


@pytest.mark.parametrize(
    ("world", "title"),
    [
        (World(rotate_degrees=(10, 20, 30)), "Here every precision will do"),
        (World(rotate_degrees=(35, -20, 50)).under(FLAT), "Squeeze a shape 10⁴ : 1"),
        (World(scale=(1, 0, 1)), "Flatten a shape"),
        (World(scale=(1, 0, 0)), "Where no plane is left"),
        (World(scale=(0, 0, 0)), "Where no plane is left"),
    ],
)
def test_the_title_is_true_of_other_maps(world: World, title: str) -> None:
    found = proof(world=world)
    assert slide(found).told[0].startswith(title)
    worst = [found.numbers[f"worst_deg_{np.dtype(one).name}"] for one in PRECISIONS]
    for angle, panel in zip(worst, slide(found).panels, strict=False):
        if angle is None:
            assert panel.verdict is None
        else:
            assert (panel.verdict is Verdict.WRONG) == (angle >= SEEN_DEG)


def test_normals_that_are_lost_are_seen() -> None:
    """In float16 10⁻¹² is 0, so that what lies across the axis has no normal at all."""
    found = proof(world=World(scale=(1, 1e-12, 1)))
    half, single, _, _ = slide(found).panels
    assert half.verdict is Verdict.WRONG
    assert single.verdict is Verdict.RIGHT
    assert slide(found).title.startswith("Squeeze a shape 10^{12} : 1")


def test_a_mesh_shows_its_own_normals() -> None:
    mesh = sphere(6, 12)
    captions = [one.caption for one in slide(proof(mesh=mesh)).panels]
    assert all(f"worst of {len(mesh.normals)} normals" in one for one in captions)


def test_the_scale_grows_from_end_to_end() -> None:
    parts = _part(np.array([0.0, LEAST_DEG, 1e-6, SEEN_DEG, MOST_DEG]))
    assert parts[[0, 1, -1]].tolist() == [0, 0, 1]
    assert (np.diff(parts[1:]) > 0).all()
