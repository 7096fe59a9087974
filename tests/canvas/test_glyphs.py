"""Marks by their geometry: where an arrow ends, what is a right angle, what tells wrong."""

from __future__ import annotations

from math import hypot

import pytest

from nmatrix.canvas import glyphs
from nmatrix.canvas.diagrams import circle_to_ellipse
from nmatrix.canvas.glyphs import Ink, Verdict
from nmatrix.canvas.marks import Box, Canvas, Polygon, Stroke
from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme


def sheet(theme: Theme = Theme.LIGHT) -> Canvas:
    return Canvas(1600, 900, PALETTES[theme])


def reached(canvas: Canvas, colour: str) -> list[tuple[float, float]]:
    """Return all points of the marks of a colour."""
    found = []
    for mark in canvas.marks:
        if isinstance(mark, Stroke) and mark.colour == colour:
            found += mark.points
        if isinstance(mark, Polygon) and mark.fill == colour:
            found += [point for loop in mark.loops for point in loop]
    return found


@pytest.mark.parametrize("ink", Ink)
@pytest.mark.parametrize("end", [(300, 200), (100, 350), (40, 120), (101, 200)])
def test_an_arrow_begins_and_ends_where_it_is_said(ink: Ink, end: tuple) -> None:
    canvas, start = sheet(), (100, 200)
    glyphs.arrow(canvas, start, end, ink)
    points = reached(canvas, ink.colour(canvas.palette))
    assert start in points
    assert end in points
    long = hypot(end[0] - start[0], end[1] - start[1])
    along = [(x - start[0]) * (end[0] - start[0]) + (y - start[1]) * (end[1] - start[1])
             for x, y in points]  # fmt: skip
    assert max(along) == pytest.approx(long**2), "nothing passes the tip"


def test_an_arrow_of_no_length_is_nothing() -> None:
    canvas = sheet()
    glyphs.arrow(canvas, (5, 5), (5, 5), Ink.RIGHT)
    assert canvas.marks == []


@pytest.mark.parametrize("theme", Theme)
def test_wrong_and_right_differ_by_shape_and_not_by_colour_alone(theme: Theme) -> None:
    def shape(ink: Ink) -> tuple:
        canvas = sheet(theme)
        glyphs.arrow(canvas, (0, 0), (90, 0), ink)
        colour = ink.colour(canvas.palette)
        dashed = any(isinstance(one, Stroke) and one.dash for one in canvas.marks)
        filled = any(isinstance(one, Polygon) and one.fill == colour for one in canvas.marks)
        return dashed, filled

    assert shape(Ink.WRONG) == (True, False)
    assert shape(Ink.RIGHT) == (False, True)


def test_the_two_verdicts_have_different_outlines() -> None:
    corners = []
    for verdict in Verdict:
        canvas = sheet()
        glyphs.badge(canvas, (50, 50), verdict)
        first = canvas.marks[0]
        assert isinstance(first, Polygon)
        corners.append(max(hypot(x - 50, y - 50) for x, y in first.loops[0]))
    assert corners[0] > 1.15 * corners[1], "a square reaches farther than a disc"


def test_a_right_angle_is_one() -> None:
    canvas = sheet()
    glyphs.right_angle(canvas, (0, 0), (0.6, 0.8), (-0.8, 0.6), Ink.PLAIN)
    (mark,) = canvas.marks
    assert isinstance(mark, Stroke)
    a, b, c = mark.points
    assert (a[0] - b[0]) * (c[0] - b[0]) + (a[1] - b[1]) * (c[1] - b[1]) == pytest.approx(0)


def test_hatching_stays_inside_a_loop_that_is_not_convex() -> None:
    loop = [(0, 0), (100, 0), (100, 100), (60, 100), (60, 40), (40, 40), (40, 100), (0, 100)]
    stripes = glyphs.hatching(loop, 7)
    assert len(stripes) > 20
    for a, b in stripes:
        x, y = (a[0] + b[0]) / 2, (a[1] + b[1]) / 2
        assert 0 <= x <= 100
        assert 0 <= y <= 100
        assert not (40 < x < 60 and y > 40), "the notch is outside"


@pytest.mark.parametrize("towards", [(1, 0), (-3, 2), (0, -1)])
def test_the_sun_sends_three_parallel_arrows_the_way_of_its_light(towards: tuple) -> None:
    canvas = sheet()
    glyphs.sun(canvas, (100, 100), towards)
    arrows = [one for one in canvas.marks[1:] if isinstance(one, Polygon)]
    assert len(arrows) == 3
    for one in arrows:
        tail, tip = one.loops[0][0], one.loops[0][3]
        dx, dy = tip[0] - tail[0], tip[1] - tail[1]
        cosine = (dx * towards[0] + dy * towards[1]) / hypot(dx, dy) / hypot(*towards)
        assert cosine > 0.99


def test_a_lamp_that_is_not_where_it_should_be_is_hollow() -> None:
    canvas = sheet()
    glyphs.lamp(canvas, (0, 0), lost=True)
    assert canvas.palette.light not in {getattr(one, "fill", None) for one in canvas.marks}


def test_the_scale_of_a_map_grows_in_lightness_from_end_to_end() -> None:
    for theme in Theme:
        stops = PALETTES[theme].heat
        colours = [glyphs.blend(stops, i / 40) for i in range(41)]
        light = [
            0.2126 * int(c[1:3], 16) + 0.7152 * int(c[3:5], 16) + 0.0722 * int(c[5:], 16)
            for c in colours
        ]
        assert light == sorted(light)
        assert light[-1] - light[0] > 150


@pytest.mark.parametrize("stretch", [0.4, 1.0, 2.0, 3.0])
@pytest.mark.parametrize("box", [Box(0, 0, 361, 554), Box(0, 0, 900, 400)])
def test_the_idea_keeps_one_right_angle_and_loses_the_other(stretch: float, box: Box) -> None:
    canvas = sheet()
    found = circle_to_ellipse(canvas, box, stretch)

    def cosine(tip: tuple, other: tuple, start: tuple) -> float:
        a, b = ([p - s for p, s in zip(one, start, strict=True)] for one in (tip, other))
        return (a[0] * b[0] + a[1] * b[1]) / hypot(*a) / hypot(*b)

    assert cosine(found.normal, found.tangent, found.before) == pytest.approx(0, abs=1e-12)
    assert cosine(found.right, found.moved_tangent, found.after) == pytest.approx(0, abs=1e-12)
    if stretch == 1:
        assert found.wrong is None
    else:
        assert found.wrong is not None
        assert abs(cosine(found.wrong, found.moved_tangent, found.after)) > 0.3
    for mark in canvas.marks:
        points = getattr(mark, "points", ())
        assert all(box.holds(point) for point in points)
