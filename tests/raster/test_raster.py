"""Coverage, clipping, order and the proof's claim; each with a mutant or an exact reference."""

from __future__ import annotations

import tracemalloc
from fractions import Fraction

import numpy as np
import pytest

from nmatrix.enums import DepthRange
from nmatrix.errors import NoAnswerError
from nmatrix.linear.classify import classify
from nmatrix.linear.projection import DEFAULT_CLIP_SPACE
from nmatrix.raster import cover as cover_module
from nmatrix.raster import draw as draw_module
from nmatrix.raster import proofs, visibility
from nmatrix.raster.clip import clip, whole
from nmatrix.raster.cover import CENTRE, SUBPIXELS, cover, snap
from nmatrix.raster.draw import Canvas, draw
from nmatrix.raster.heat import Scale
from nmatrix.raster.normals import outward
from nmatrix.raster.proofs import Setup, as_array, normals_proof, subject_in_world
from nmatrix.raster.shade import Lighting
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.mesh import Mesh
from nmatrix.scene.shapes import sphere, torus
from nmatrix.scene.shot import Shot
from nmatrix.scene.world import World


def fan(centre: tuple[float, float], spokes: int, radius: float, grid: float) -> np.ndarray:
    """Triangles around a centre, on a grid of fractions of a pixel; they tile a polygon."""
    turn = np.linspace(0, 2 * np.pi, spokes, endpoint=False)
    rim = np.stack([np.cos(turn), np.sin(turn)], 1) * radius + np.array(centre)
    rim = np.rint(rim / grid) * grid
    middle = np.broadcast_to(np.array(centre), rim.shape)
    return np.stack([middle, rim, np.roll(rim, -1, 0)], axis=1)


def counts(triangles: np.ndarray, size: int) -> np.ndarray:
    found = cover(snap(triangles), size, size)
    return np.bincount(found.y * size + found.x, minlength=size * size).reshape(size, size)


def check_exactly_once(
    triangles: np.ndarray, size: int, radius: float, middle: tuple[float, float] = (64.5, 63.5)
) -> None:
    hits = counts(triangles, size)
    assert hits.max() == 1, "a sample was covered twice"
    y, x = np.mgrid[:size, :size] + 0.5
    inside = (x - middle[0]) ** 2 + (y - middle[1]) ** 2 < (radius * 0.9) ** 2
    assert hits[inside].all(), "a sample was left out"


@pytest.mark.parametrize("grid", [0.5, 1.0, 1 / 256])
@pytest.mark.parametrize("flip", [False, True])
def test_fans_cover_each_sample_exactly_once(grid: float, flip: bool) -> None:
    for spokes in (12, 40, 97):
        triangles = fan((64.5, 63.5), spokes, 60, grid)
        check_exactly_once(triangles[:, ::-1] if flip else triangles, 128, 56)


def test_an_inclusive_edge_covers_samples_twice(monkeypatch: pytest.MonkeyPatch) -> None:
    right = cover_module._ranges
    monkeypatch.setattr(cover_module, "_ranges", lambda a, b: right(a, b + (b > a)))
    with pytest.raises(AssertionError):
        check_exactly_once(fan((64.5, 63.5), 12, 60, 0.5), 128, 56)


def edge_reference(points: np.ndarray, size: int) -> set[tuple[int, int]]:
    """Samples inside by exact edge functions; those on an edge count on its left and top."""
    a, b, c = ([int(x) for x in p] for p in points)
    area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    if area == 0:
        return set()
    if area < 0:
        b, c = c, b
    inside = set()
    for j in range(size):
        for i in range(size):
            s = (i * SUBPIXELS + CENTRE, j * SUBPIXELS + CENTRE)
            for p, q in ((a, b), (b, c), (c, a)):
                e = (q[0] - p[0]) * (s[1] - p[1]) - (q[1] - p[1]) * (s[0] - p[0])
                top_left = q[1] < p[1] or (q[1] == p[1] and q[0] > p[0])
                if e < 0 or (e == 0 and not top_left):
                    break
            else:
                inside.add((i, j))
    return inside


def test_spans_are_the_exact_edge_functions() -> None:
    rng = np.random.default_rng(3)
    for _ in range(150):
        grid = rng.choice([1, 64, 128, 256])
        points = rng.integers(-3 * SUBPIXELS, 15 * SUBPIXELS, (1, 3, 2)) // grid * grid
        found = cover(points, 12, 12)
        assert set(zip(found.x.tolist(), found.y.tolist(), strict=True)) == edge_reference(
            points[0], 12
        )


@pytest.mark.slow
def test_ten_million_samples_without_gap_or_double() -> None:
    total = 0
    for seed in range(12):
        rng = np.random.default_rng(seed)
        size = 1024
        centre = tuple((rng.integers(400, 600, 2) + 0.5).tolist())
        check_exactly_once(fan(centre, int(rng.integers(50, 400)), 390, 0.5), size, 380, centre)
        total += size * size
    assert total >= 10**7


def test_nothing_behind_the_eye_survives_clipping() -> None:
    rng = np.random.default_rng(5)
    corners = rng.normal(size=(2000, 3, 4)) * [3, 3, 3, 2]
    cut = clip(whole(corners), DepthRange.MINUS_ONE_TO_ONE, 64, 64)
    assert len(cut.corners) > 200
    assert (cut.corners[:, :, 3] > 0).all()
    size = np.abs(cut.corners).max()
    assert (cut.corners[:, :, 2] + cut.corners[:, :, 3] >= -1e-12 * size).all()
    assert np.abs(cut.weights.sum(axis=2) - 1).max() < 1e-9


def scene_of(world: World) -> Shot:
    return Shot(world, View(eye=(1.5, 1.2, 4.0)), Lens(near=0.5, far=20.0))


def proof(mesh: Mesh, world: World, size: int = 128):
    stage = scene_of(world).stage
    lighting = Lighting(as_array(stage.eye), as_array(stage.light.direction), None)
    return normals_proof(
        mesh, "test", stage, lighting, Setup(Canvas(size, size), DEFAULT_CLIP_SPACE)
    )


def test_the_order_of_triangles_does_not_matter() -> None:
    mesh = torus(16, 32)
    shuffled = np.random.default_rng(1).permutation(len(mesh.triangles))
    other = Mesh(mesh.positions, mesh.normals, mesh.triangles[shuffled])
    world = World(scale=(1, 2, 1), rotate_degrees=(40, 10, 0))
    assert (proof(mesh, world).image == proof(other, world).image).all()


@pytest.mark.parametrize("scale", [(1, 2, 1), (1, 0.25, 1), (3, 1, 1)])
def test_the_worst_angle_comes_close_to_its_bound_and_never_passes_it(scale: tuple) -> None:
    world = World(scale=scale)
    found = proof(sphere(), world).max_angle_error_deg
    bound = classify(world.world_from_object).worst_angle_deg
    assert bound * 0.98 < found <= bound * (1 + 1e-3)


def test_a_rotation_hides_the_mistake() -> None:
    found = proof(torus(16, 32), World(rotate_degrees=(20, 30, 40)))
    assert found.max_angle_error_deg < 1e-9
    assert found.max_level_difference == 0


def test_a_mirror_without_the_sign_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    world = World(scale=(-1, 1, 1))
    assert proof(sphere(16, 32), world).max_angle_error_deg < 1e-9
    right = proofs.outward
    monkeypatch.setattr(proofs, "outward", lambda a, n: -right(a, n))
    assert proof(sphere(16, 32), world).max_angle_error_deg > 179


def test_a_flattened_sphere_is_one_plane_that_faces_the_eye() -> None:
    mesh, stage = sphere(16, 32), scene_of(World(scale=(1, 0, 1))).stage
    assert len(np.unique(subject_in_world(mesh, stage).right, axis=0)) == 1
    # Without turning, its upper and lower half would fight for every sample.
    assert len(np.unique(outward(stage.world_from_object.linear_map, mesh.normals), axis=0)) == 2
    assert proof(mesh, World(scale=(1, 0, 1))).max_angle_error_deg == pytest.approx(90)


def test_a_condition_beyond_every_float_still_has_a_title() -> None:
    found = proof(sphere(8, 16), World(scale=(1e90, 1e-250, 1)), size=16)
    assert found.image.dtype == np.uint8
    assert classify(World(scale=(1e90, 1e-250, 1)).world_from_object).condition_text == "1e+340"


def test_both_sides_of_a_flattened_sphere_look_alike() -> None:
    found = proof(sphere(16, 32), World(scale=(1, 0, 1)), size=240)
    right = found.image[:, found.image.shape[1] // 3 : found.image.shape[1] * 2 // 3]
    rows, columns = np.nonzero((right[:, :, 0] > 40) & (right[:, :, 0] < 200))
    middle = right[
        int(np.median(rows)), int(np.median(columns)) - 10 : int(np.median(columns)) + 10
    ]
    assert np.ptp(middle[:, 0].astype(int)) <= 8, "a checkerboard of both sides"


@pytest.mark.parametrize("scale", [(1, 0, 0), (0, 0, 0)])
def test_a_line_or_a_point_has_no_normal_to_compare(scale: tuple) -> None:
    assert proof(sphere(16, 32), World(scale=scale)).max_angle_error_deg is None


def test_a_difference_that_is_rounding_alone_is_drawn_in_one_colour() -> None:
    worst = proof(sphere(16, 32), World(rotate_degrees=(20, 30, 40))).max_angle_error_deg
    angles = np.array([0.0, worst])
    none, some = Scale.reaching(worst).colours(angles)
    assert (none == some).all()
    none, some = Scale(worst).colours(angles)  # what stretching to the full range would do
    assert (none != some).any()


@pytest.mark.parametrize("scale", [(1e200, 1e-200, 1), (1e-170, 1, 1), (1e-90, 1e-90, 1e-90)])
def test_extreme_scales_are_drawn_or_refused_in_one_line(scale: tuple) -> None:
    try:
        found = proof(sphere(8, 16), World(scale=scale))
    except NoAnswerError as error:
        assert max(scale) > 1e100
        assert "1e+100" in str(error)
    else:
        assert found.image.dtype == np.uint8


def test_bands_and_chunks_change_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    mesh, world = torus(16, 32), World(scale=(1, 2, 1), rotate_degrees=(40, 10, 0))
    whole_picture = proof(mesh, world)
    monkeypatch.setattr(draw_module, "BAND_SAMPLES", 128 * 5)
    monkeypatch.setattr(visibility, "CHUNK_SAMPLES", 50)
    monkeypatch.setattr(visibility, "CHUNK_TRIANGLES", 7)
    banded = proof(mesh, world)
    assert (banded.image == whole_picture.image).all()
    assert banded.fragments == whole_picture.fragments
    assert banded.work == whole_picture.work


def test_memory_follows_the_band_and_not_the_fragments() -> None:
    size, layers = 256, 60
    screen = np.array([[[0, 0], [2 * size, 0], [0, 2 * size]]], float)
    points, depth = snap(np.tile(screen, (layers, 1, 1))), np.full((layers, 3), 0.5)
    tracemalloc.start()
    seen = visibility.visible(points, depth, size, size)
    _, peak = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert seen.fragments == layers * size * size
    assert peak < 200 * (visibility.CHUNK_SAMPLES + size * size)


def test_the_picture_carries_its_numbers() -> None:
    import io

    from PIL import Image

    found = proof(sphere(16, 32), World(scale=(1, 2, 1)))
    image = Image.open(io.BytesIO(found.png()))
    assert float(image.text["max_angle_error_deg"]) == found.max_angle_error_deg


def test_weights_add_up_and_stay_in_range() -> None:
    stage = scene_of(World(scale=(1, 2, 1))).stage
    matrix = tuple(tuple(float(x) for x in row) for row in stage.clip_from_object)
    frame = draw(sphere(8, 16), matrix, Canvas(96, 96), DEFAULT_CLIP_SPACE)
    assert ((frame.weights >= 0) & (frame.weights <= 1 + 1e-15)).all()
    assert np.abs(frame.weights.sum(axis=1) - 1).max() < 1e-12


def test_perspective_weights_are_those_of_exact_arithmetic() -> None:
    corners = np.array([[-1.0, -1, 0.2, 1], [4.0, -4, 1.0, 5], [0.0, 3, 0.4, 3]])
    mesh = Mesh(corners[:, :3], np.zeros((3, 3)), np.array([[0, 1, 2]]))
    projection = np.zeros((4, 4))
    projection[:, :] = np.linalg.lstsq(
        np.hstack([corners[:, :3], np.ones((3, 1))]), corners, rcond=None
    )[0].T
    frame = draw(mesh, tuple(map(tuple, projection.tolist())), Canvas(32, 32), DEFAULT_CLIP_SPACE)
    i = len(frame.pixel) // 2
    x, y = int(frame.pixel[i] % 32), int(frame.pixel[i] // 32)
    w = [Fraction(c[3]) for c in corners.tolist()]
    screen = [((c[0] / c[3] + 1) / 2 * 32, (1 - c[1] / c[3]) / 2 * 32) for c in corners.tolist()]
    snapped = [
        (Fraction(round(px * 256), 256), Fraction(round(py * 256), 256)) for px, py in screen
    ]
    s = (Fraction(2 * x + 1, 2), Fraction(2 * y + 1, 2))
    areas = []
    for k in range(3):
        p, q = snapped[(k + 1) % 3], snapped[(k + 2) % 3]
        areas.append(abs((p[0] - s[0]) * (q[1] - s[1]) - (p[1] - s[1]) * (q[0] - s[0])))
    true = [a / wk for a, wk in zip(areas, w, strict=True)]
    total = sum(true)
    for found, exact in zip(frame.weights[i].tolist(), true, strict=True):
        assert found == pytest.approx(float(exact / total), rel=1e-9)
