"""A pixel leads back to the very point that it shows, for every lens, interface and view."""

from __future__ import annotations

from dataclasses import replace
from fractions import Fraction
from math import inf
from typing import Any

import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

import nmatrix
from nmatrix.enums import API_PRESETS, Api, ClipY, DepthRange, Handedness, Projected
from nmatrix.errors import NoAnswerError
from nmatrix.linear.measured_lens import FilmBack, HorizontalField, Intrinsics, SideAngles
from nmatrix.linear.projection import NDC_DEPTH, ClipSpace, Window
from nmatrix.linear.rational import rational_vector
from nmatrix.linear.rounding import nearest
from nmatrix.linear.viewport import Viewport
from nmatrix.scene.camera import View
from nmatrix.scene.lens import Lens
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World
from nmatrix.spaces.pixel_ray import PixelRay, pixel_ray
from nmatrix.spaces.trace import trace

WINDOW = Viewport(640, 480)
SHAPES: dict[str, dict[str, Any]] = {
    "fov": {"fov_degrees": 50, "aspect": 1.5},
    "fov_x": {"measured": HorizontalField(70)},
    "film": {"measured": FilmBack(35, (36, 24))},
    "intrinsics": {"measured": Intrinsics(600, 580, 300, 250), "viewport": WINDOW},
    "angles": {"measured": SideAngles(-50, 30, -40, 45)},
    "frustum": {"frustum": Window(-0.5, 1, -0.25, 0.75)},
    "ortho": {"ortho": Window(-3, 4, -2, 5)},
}
CLIPS = [
    *(ClipSpace(*preset) for preset in API_PRESETS.values()),
    ClipSpace(),
    *(ClipSpace(depth, hand, y) for depth in DepthRange for hand in Handedness for y in ClipY),
]
eighths = st.integers(-40, 40).map(lambda n: n / 8)
places = st.tuples(eighths, eighths, eighths)


def lens_of(shape: str, clip: ClipSpace, far: float) -> Lens:
    return Lens(near=0.5, far=40 if shape == "ortho" else far, clip=clip, **SHAPES[shape])


def seen(setup: Setup) -> Any:
    return replace(setup.maps, clip_from_camera=setup.lens.exact)


def back(setup: Setup, pixel: Any, depth: Fraction | None = None) -> PixelRay:
    return pixel_ray(seen(setup), rational_vector(pixel), depth, setup.lens.clip, WINDOW)


placings = st.tuples(places, places.filter(all), st.booleans()).map(
    lambda drawn: World(
        drawn[0],
        tuple(10 * x for x in drawn[0]),
        scale=drawn[1],
        shear=(1, 2, 3) if drawn[2] else (0, 0, 0),
    )
)
lenses = st.builds(
    lens_of, st.sampled_from(list(SHAPES)), st.sampled_from(CLIPS), st.sampled_from((40.0, inf))
)


@settings(max_examples=300, deadline=None)
@given(lenses, st.booleans(), places, places.filter(any), placings)
def test_a_point_comes_back_from_its_pixel_and_depth_exactly(
    lens: Lens, as_matrix: bool, point: Any, eye: Any, world: World
) -> None:
    clip, is_parallel = lens.clip, lens.ortho is not None
    if as_matrix:  # then nothing is known but sixteen floats
        lens = Lens(matrix=lens.clip_from_camera, clip=clip)
    setup = Setup(world, View(eye=eye, handed=clip.handed), lens)
    there = trace(seen(setup), point, None, clip, WINDOW)
    assume(there.window is not None and there.pixel is not None)
    assert there.window is not None
    assert there.pixel is not None
    found = back(setup, there.pixel, there.window[2])
    assert found.point_object == rational_vector(point)
    assert found.point_world == there.world
    assert found.object is not None
    for ray, place in ((found.world, there.world), (found.object, there.object)):
        leads = tuple(b - a for a, b in zip(ray.origin, place, strict=True))
        length = sum(float(x) ** 2 for x in leads) ** 0.5
        along = sum(float(x) * y for x, y in zip(leads, ray.direction, strict=True))
        # The eye is where it was put, and not where the rounded view matrix has it.
        assert abs(abs(along) - length) <= 1e-12 * (1 + length)
        assert along > 0 or is_parallel or length < 1e-12
    assert (found.projected is Projected.PARALLEL) is is_parallel


@settings(max_examples=60, deadline=None)
@given(st.sampled_from(list(SHAPES)), st.sampled_from(list(Api)), places, places)
def test_what_python_tells_is_within_half_an_ulp(
    shape: str, api: Api, point: Any, eye: Any
) -> None:
    assume(any(eye))
    clip = ClipSpace(*API_PRESETS[api])
    lens = lens_of(shape, clip, 40)
    setup = Setup(World(scale=(1, 3, 1), rotate_degrees=(10, 20, 30)), View(eye=eye), lens)
    setup = replace(setup, view=replace(setup.view, handed=clip.handed))
    there = trace(seen(setup), point, None, clip, WINDOW)
    assume(there.window is not None and 0 <= there.window[2] <= 1)
    assert there.window is not None
    told = nmatrix.Setup(setup.world, setup.view, setup.lens).trace(
        pixel=there.pixel, depth_value=there.window[2], viewport=(640, 480)
    )
    assert told.data["point_object"] == list(point)
    assert told.data["point_world"] == [nearest(x) for x in there.world]


@pytest.mark.parametrize("clip", CLIPS)
@pytest.mark.parametrize("shape", SHAPES)
def test_a_ray_leads_away_from_the_eye_through_near_and_far(shape: str, clip: ClipSpace) -> None:
    setup = Setup(view=View(handed=clip.handed), lens=lens_of(shape, clip, 40))
    pixel = (Fraction(100), Fraction(33))
    found = back(setup, pixel)
    at = {0: back(setup, pixel, Fraction(0)), 1: back(setup, pixel, Fraction(1))}
    first, last = (0, 1) if NDC_DEPTH[clip.depth][0] < NDC_DEPTH[clip.depth][1] else (1, 0)
    near, far = at[first].point_world, at[last].point_world
    assert near is not None
    assert far is not None
    assert (near[2], far[2]) == (Fraction(9, 2), -35)  # the eye is at 0 0 5 and looks down -z
    leads = [float(b - a) for a, b in zip(near, far, strict=True)]
    length = sum(x * x for x in leads) ** 0.5
    assert found.world.direction == pytest.approx([x / length for x in leads], abs=1e-15)
    assert found.world.origin == (near if shape == "ortho" else (0, 0, 5))


@pytest.mark.parametrize("api", [None, *Api])
def test_the_upper_left_pixel_is_up_and_left_in_every_interface(api: Api | None) -> None:
    clip = ClipSpace() if api is None else ClipSpace(*API_PRESETS[api])
    setup = Setup(view=View(handed=clip.handed), lens=Lens(fov_degrees=90, clip=clip))
    x, y, z = back(setup, (0, 0)).world.direction
    left = 1 if clip.handed is Handedness.LEFT else -1  # of a world that looks down -z
    assert (x, y, z) == (left * 3**-0.5, 3**-0.5, -(3**-0.5))


def test_clip_y_down_alone_counts_from_the_top_and_changes_no_ray() -> None:
    up = Setup(lens=Lens(clip=ClipSpace()))
    down = Setup(lens=Lens(clip=ClipSpace(clip_y=ClipY.DOWN)))
    assert back(up, (13, 77)) == replace(back(down, (13, 77)), ndc=back(up, (13, 77)).ndc)
    place = (1, 2, 0)
    there = {one: trace(seen(s), place, None, s.lens.clip, WINDOW) for one, s in
             (("up", up), ("down", down))}  # fmt: skip
    assert there["up"].pixel == there["down"].pixel
    assert there["down"].window is not None
    assert there["down"].window[:2] == there["down"].pixel


@pytest.mark.parametrize(("depth", "at"), [(DepthRange.ZERO_TO_ONE, 1), (DepthRange.REVERSED, 0)])
def test_an_infinite_far_plane_is_reached_by_no_point(depth: DepthRange, at: int) -> None:
    setup = Setup(lens=Lens(far=inf, clip=ClipSpace(depth)))
    with pytest.raises(NoAnswerError, match="infinitely far"):
        back(setup, (5, 5), Fraction(at))


def test_a_flattened_object_has_no_ray_but_the_world_has() -> None:
    found = back(Setup(World(scale=(1, 0, 1))), (320, 240), Fraction(0))
    assert found.object is found.point_object is None
    assert found.world.direction == (0, 0, -1)
    assert found.point_world is not None


def test_a_camera_of_any_matrix_has_its_rays_meet_where_its_lines_do() -> None:
    # An oblique view: the eye stands at 1 0 0 of camera space, which no built lens has.
    moved = ((1, 0, 0, -1), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))
    P = Lens(fov_degrees=90).exact
    off = tuple(tuple(sum(a * b for a, b in zip(row, column, strict=True))
                      for column in zip(*moved, strict=True)) for row in P)  # fmt: skip
    setup = Setup(view=View(matrix=((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (0, 0, 0, 1))),
                  lens=Lens(matrix=off))  # fmt: skip
    assert back(setup, (0, 240)).world.origin == (1, 0, 0)


def test_a_projection_that_flattens_has_no_rays() -> None:
    flat = ((1, 0, 0, 0), (0, 0, 0, 0), (0, 0, -1, -1), (0, 0, -1, 0))
    with pytest.raises(NoAnswerError, match="determinant 0"):
        back(Setup(lens=Lens(matrix=flat)), (0, 0))
