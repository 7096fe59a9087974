"""What is in front: any order, any depth buffer, any tiling, and glass against a reference."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.raster.triangles import layers as layers_module
from nmatrix.raster.triangles import picture as picture_module
from nmatrix.raster.triangles import visibility as visibility_module
from nmatrix.raster.triangles.fragments import Fragments, VertexOutputs
from nmatrix.raster.triangles.picture import Drawable, Drawing, Picture
from nmatrix.raster.triangles.spans import SUBPIXELS, Canvas
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.raster.triangles.visibility import EMPTY, TRIANGLE_MASK, Runs, Tile, depth_code
from nmatrix.scene.words import DepthBuffer

SIZE = 48
CANVAS = Canvas(SIZE, SIZE)


def loose(count: int, seed: int, canvas: Canvas = CANVAS) -> Projected:
    """Return triangles with corners of their own, anywhere on the canvas and a little beyond."""
    rng = np.random.default_rng(seed)
    size = canvas.columns
    x, y = rng.integers(-size * 64, size * 320, (2, 3 * count)).astype(float)
    depth, inverse_w = rng.uniform(0.1, 0.9, (2, 3 * count))
    return Projected(x, y, depth, inverse_w, np.arange(3 * count).reshape(-1, 3).T)


def drawable(projected: Projected, opacity: float = 1.0) -> Drawable:
    """Return triangles with a colour at each corner that is the corner's own."""
    colours = np.random.default_rng(len(projected.x)).uniform(0, 1, (3, len(projected.x)))
    read = VertexOutputs(points={"colour": colours})
    return Drawable(projected, read, lambda found: found["colour"], letting_through(opacity))


def letting_through(opacity: float) -> Callable[[Fragments], np.ndarray] | None:
    return None if opacity == 1.0 else lambda found: np.full(len(found), opacity)


def drawn(*drawables: Drawable, canvas: Canvas = CANVAS, depth: str = "full") -> Picture:
    return Drawing(drawables, canvas, np.array([0.1, 0.2, 0.3]), DepthBuffer(depth)).picture()


def shuffled(one: Projected, seed: int) -> Projected:
    order = np.random.default_rng(seed).permutation(one.triangles.shape[1])
    return replace(one, triangles=one.triangles[:, order])


@pytest.mark.parametrize("seed", range(4))
def test_the_order_of_triangles_does_not_matter(seed: int) -> None:
    triangles = loose(200, seed)
    one, other = drawn(drawable(triangles)), drawn(drawable(shuffled(triangles, seed)))
    assert (one.image == other.image).all()
    assert one.fragments == other.fragments


def test_the_order_of_opaque_drawables_does_not_matter() -> None:
    a, b = drawable(loose(60, 1)), drawable(loose(70, 2))
    assert (drawn(a, b).image == drawn(b, a).image).all()


def test_painting_in_the_order_of_names_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    triangles = loose(200, 0)
    monkeypatch.setattr(visibility_module, "depth_code", lambda z, buffer: np.zeros(z.shape, int))
    one, other = drawn(drawable(triangles)), drawn(drawable(shuffled(triangles, 0)))
    assert (one.image != other.image).any()


def areas_at_samples(projected: Projected) -> np.ndarray:
    """Return the three areas (3, F, rows, columns) that every sample cuts triangles into."""
    corners = (one[projected.triangles] for one in (projected.x, projected.y))
    x, y = (one[:, :, None, None] for one in corners)
    column, row = np.meshgrid(np.arange(SIZE) * SUBPIXELS, np.arange(SIZE) * SUBPIXELS)
    x, y = x - column, y - row
    return np.stack([x[i - 2] * y[i - 1] - x[i - 1] * y[i - 2] for i in range(3)])


def exact_depths(projected: Projected) -> np.ndarray:
    """Return the depth of every triangle at every sample (F, rows, columns), infinite outside."""
    areas, z = areas_at_samples(projected), projected.depth[projected.triangles]
    total = areas.sum(axis=0)
    inside = (areas * np.sign(total) > 0).all(axis=0)
    return np.where(inside, np.einsum("ifrc,if->frc", areas, z) / total, np.inf)


def off_samples(count: int, seed: int) -> Projected:
    """Return triangles of which no edge meets a sample, so that no tie has to be decided."""
    found = loose(count, seed)
    meets = (areas_at_samples(found) == 0).any(axis=(0, 2, 3))
    return replace(found, triangles=found.triangles[:, ~meets])


def seen(*all_projected: Projected, depth: DepthBuffer = DepthBuffer.FULL) -> np.ndarray:
    """Return the number of the triangle in front at each sample, −1 where there is none."""
    tile, first = Tile.empty((0, SIZE), SIZE, depth), 0
    for one in all_projected:
        tile.add(one, first)
        first += one.triangles.shape[1]
    names = np.where(tile.keys == EMPTY, -1, tile.keys & TRIANGLE_MASK)
    return names.reshape(SIZE, SIZE)


def test_the_nearest_triangle_is_seen() -> None:
    triangles = off_samples(40, 3)
    depths = exact_depths(triangles)
    nearest = np.where(np.isfinite(depths).any(axis=0), depths.argmin(axis=0), -1)
    ours = seen(triangles)
    # Depths are told apart to 2⁻³⁸.
    two = np.sort(depths, axis=0)[:2]
    clear = ~(two[1] < two[0] + 1e-9)
    assert clear.mean() > 0.99
    assert (ours == nearest)[clear].all()


@pytest.mark.parametrize("buffer", DepthBuffer)
def test_depth_codes_grow_with_depth(buffer: DepthBuffer) -> None:
    rng = np.random.default_rng(6)
    z = np.concatenate([rng.uniform(0, 1, 2000), 10.0 ** rng.uniform(-12, 0, 2000), [0.0, 1.0]])
    z.sort()
    code = depth_code(z, buffer)
    assert (np.diff(code) >= 0).all()
    assert code[0] >= 0
    assert int(code[-1]) < 1 << 39


@pytest.mark.parametrize(("buffer", "bits"), [("16", 16), ("24", 24)])
def test_integer_buffers_round_to_their_steps(buffer: str, bits: int) -> None:
    steps = 2**bits - 1
    whole = np.random.default_rng(7).integers(0, steps + 1, 1000)
    for shift in (-0.49, 0.0, 0.49):
        z = np.clip((whole + shift) / steps, 0, 1)
        assert (depth_code(z, DepthBuffer(buffer)) == whole).all()


def test_a_float_buffer_keeps_what_float32_keeps() -> None:
    z = np.random.default_rng(8).uniform(0, 1, 1000).astype(np.float32)
    stored = depth_code(z.astype(float), DepthBuffer.FLOAT32)
    assert (stored.astype(np.int32).view(np.float32) == z).all()
    close = np.array([0.5, 0.5 + 2.0**-26, 0.5 + 2.0**-23])
    assert np.diff(depth_code(close, DepthBuffer.FLOAT32)).tolist() == [0, 2]
    assert (np.diff(depth_code(close, DepthBuffer.FULL)) > 0).all()


@pytest.mark.parametrize("buffer", DepthBuffer)
def test_at_equal_depth_the_first_named_is_seen(buffer: DepthBuffer) -> None:
    triangles = replace(loose(60, 9), depth=np.full(180, 0.25))
    ours = seen(triangles, depth=buffer)
    inside = np.stack(
        [seen(replace(triangles, triangles=triangles.triangles[:, [i]])) == 0 for i in range(60)]
    )
    assert (ours == np.where(inside.any(axis=0), inside.argmax(axis=0), -1)).all()


def test_a_coarse_buffer_fights_where_a_fine_one_does_not() -> None:
    far = loose(1, 10)
    far = replace(far, depth=np.array([0.31, 0.31 + 1e-6, 0.31]))
    near = replace(far, depth=far.depth - 1e-7)
    assert set(np.unique(seen(far, near))) == {-1, 1}
    assert set(np.unique(seen(far, near, depth=DepthBuffer.UNORM16))) == {-1, 0}


SIZES = {"TILE_SAMPLES": SIZE * 5, "STRIPE_SAMPLES": SIZE * 3}


@pytest.mark.parametrize("per_side", [1, 2])
@pytest.mark.parametrize("chunk", [1 << 14, 7])
@pytest.mark.parametrize("which", [["TILE_SAMPLES"], ["STRIPE_SAMPLES"], list(SIZES)])
def test_tiles_stripes_and_chunks_change_nothing(
    which: list[str], chunk: int, per_side: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    canvas = Canvas(SIZE, SIZE, per_side)
    parts = [
        drawable(loose(80, 11, canvas)),
        drawable(loose(5, 12, canvas), 0.4),
        drawable(loose(8, 13, canvas)),
    ]
    whole = drawn(*parts, canvas=canvas)
    for name in which:
        monkeypatch.setattr(picture_module, name, SIZES[name])
    monkeypatch.setattr(visibility_module, "CHUNK", chunk)
    cut = drawn(*parts, canvas=canvas)
    assert (whole.image == cut.image).all()
    assert (whole.fragments, whole.shaded) == (cut.fragments, cut.shaded)


def blended(
    parts: list[Drawable], opacities: tuple[float, ...], background: np.ndarray
) -> np.ndarray:
    """Return the colour of each sample, sorted one sample at a time; colours are flat."""
    depths = [exact_depths(one.projected) for one in parts]
    image = np.empty((SIZE, SIZE, 3))
    for row in range(SIZE):
        for column in range(SIZE):
            at = [(z, i) for i, one in enumerate(depths) for z in one[:, row, column].tolist()]
            layers = [(z, i) for z, i in at if z < np.inf]
            colour = background
            for _, i in sorted(layers, reverse=True):
                own = np.array(COLOURS[i])
                colour = opacities[i] * own + (1 - opacities[i]) * colour
            image[row, column] = colour
    return image


COLOURS = [(0.9, 0.1, 0.1), (0.1, 0.8, 0.2), (0.1, 0.2, 0.9)]


def flat(i: int, projected: Projected, opacity: float) -> Drawable:
    def colours(found: Fragments) -> np.ndarray:
        return np.repeat(np.array(COLOURS[i])[:, None], len(found), axis=1)

    return Drawable(projected, VertexOutputs(), colours, letting_through(opacity))


def pane(left: float, right: float) -> Projected:
    """Return one triangle over the whole canvas, its depth running from left to right."""
    edge = float(SIZE * SUBPIXELS)
    x, y = np.array([-edge - 7, 3 * edge + 5, -edge - 7]), np.array([-edge, -edge - 3, 3 * edge])
    depth = left + (right - left) * x / edge
    return Projected(x, y, depth, np.ones(3), np.array([[0], [1], [2]]))


@pytest.mark.parametrize(("opaque", "looks"), [(0.05, 1), (0.501, 4), (0.95, 2)])
def test_crossing_panes_are_sorted_at_every_sample(opaque: float, looks: int) -> None:
    parts = [
        flat(0, pane(0.2, 0.8), 0.3),
        flat(1, pane(0.8, 0.1), 0.6),
        flat(2, pane(opaque, opaque), 1.0),
    ]
    found = drawn(*parts)
    assert (
        np.abs(found.image - blended(parts, (0.3, 0.6, 1.0), np.array([0.1, 0.2, 0.3]))).max()
        < 1e-15
    )
    assert (drawn(*parts[::-1]).image == found.image).all()
    assert len(np.unique(found.image.reshape(-1, 3), axis=0)) == looks


def test_many_layers_of_glass_are_sorted_at_every_sample() -> None:
    parts = [flat(0, off_samples(12, 14), 0.3), flat(1, off_samples(12, 15), 0.5)]
    expected = blended(parts, (0.3, 0.5), np.array([0.1, 0.2, 0.3]))
    assert np.abs(drawn(*parts).image - expected).max() < 1e-14


@pytest.mark.parametrize("most", [1, SIZE * 3, SIZE * SIZE])
def test_layers_that_do_not_fit_are_blended_some_rows_at_a_time(
    most: int, monkeypatch: pytest.MonkeyPatch
) -> None:
    parts = [
        flat(0, pane(0.2, 0.8), 0.3),
        drawable(loose(30, 12), 0.4),
        flat(1, pane(0.8, 0.1), 0.6),
        flat(2, pane(0.5, 0.5), 1.0),
    ]
    whole = drawn(*parts)
    monkeypatch.setattr(layers_module, "MOST_LAYERED", most)
    cut = drawn(*parts)
    assert (whole.image == cut.image).all()
    assert whole.shaded == cut.shaded


def test_a_pane_is_coloured_once_however_many_cross_it() -> None:
    """Its layers differ from sample to sample; coloured level by level it would be often."""
    calls = []

    def counted(one: Drawable) -> Drawable:
        def fragment(found: Fragments) -> np.ndarray:
            calls.append(len(found))
            return one.fragment(found)

        return replace(one, fragment=fragment)

    panes = [flat(i % 3, pane(0.1 + 0.02 * i, 0.9 - 0.03 * i), 0.3) for i in range(20)]
    found = drawn(*(counted(one) for one in panes))
    assert calls == [SIZE * SIZE] * 20
    assert np.abs(found.image).max() <= 1


def test_more_triangles_than_a_key_can_name_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(picture_module, "TRIANGLE_MASK", 9)
    assert drawn(drawable(loose(9, 16))).fragments
    with pytest.raises(IllegalValueError):
        drawn(drawable(loose(5, 16)), drawable(loose(5, 17)))


@pytest.mark.parametrize("first", [[0, 40], [0, 3, 3, 20, 40], [0, 0, 40, 40]])
def test_runs_go_to_the_owners_of_their_triangles_in_their_order(first: list[int]) -> None:
    """The owners that have none, or no triangle at all, are passed over."""
    rng = np.random.default_rng(7)
    runs = Runs(rng.integers(0, 30, 200), *rng.integers(0, 99, (3, 200)))
    found = dict(runs.by_owner(first))
    for i, (low, high) in enumerate(pairwise(first)):
        mine = runs.of(low, high)
        assert (i in found) is bool(len(mine.triangle))
        if i in found:
            assert all(np.array_equal(a, b) for a, b in zip(found[i], mine, strict=True))
    nothing = Runs(*(np.zeros(0, np.intp) for _ in Runs._fields))
    assert not list(nothing.by_owner(first))
