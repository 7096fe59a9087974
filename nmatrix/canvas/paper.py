"""Slides on paper: cut to their stages and headings, with no letter too small to be read there.

The title and the captions of a slide stand in the type of the document that holds it.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import assert_never

from nmatrix.canvas.marks import Box, Canvas, Mark, Point, Polygon, Raster, Stroke, Text
from nmatrix.canvas.slide import Slide
from nmatrix.canvas.text import plain

LEAST_POINTS = 8.0
LARGEST_CAPTION = 24  # units; a larger line is the number that the panels tell as well
ABOVE, BELOW = 12.0, 4.0  # units around what is kept: a verdict is higher than its heading


@dataclass(frozen=True, eq=False)
class Cutting:
    """What of a slide is drawn on paper, and the words that stood around it, for its caption."""

    canvas: Canvas
    words: str


def on_paper(slide: Slide, points: float) -> Cutting:
    """Cut a slide that is to be so many points wide.

    What stands in a stage or above it is kept, and enlarged to 8 points where it is smaller.
    """
    title, *marks = slide.canvas.marks
    assert isinstance(title, Text)  # a slide begins with it
    stages = [panel.stage for panel in slide.panels]
    bottom = max(stage.bottom for stage in stages)
    around = [mark for mark in marks if isinstance(mark, Text) and _is_below(mark, stages)]
    kept = [mark for mark in marks if mark not in around]
    numbers = {mark.place[1] for mark in around if mark.size > LARGEST_CAPTION}
    words = " ".join(mark.text for mark in around if mark.place[1] not in numbers)
    top = min(mark.box.y for mark in kept if isinstance(mark, Text)) - ABOVE
    frame = slide.frame
    least = LEAST_POINTS * frame.width / points
    canvas = Canvas(frame.width, bottom + BELOW - top, slide.palette, slide.canvas.scale)
    canvas.marks += [_moved(_legible(mark, least), -frame.x, -top) for mark in kept]
    return Cutting(canvas, plain(words))


def _is_below(text: Text, stages: Sequence[Box]) -> bool:
    """Whether a line stands under a stage, and is in none."""
    box = text.box
    over = (stage for stage in stages if stage.x < box.right and box.x < stage.right)
    return not any(stage.holds(box.middle) for stage in stages) and any(
        stage.bottom <= box.y for stage in over
    )


def _legible(mark: Mark, least: float) -> Mark:
    return replace(mark, size=least) if isinstance(mark, Text) and mark.size < least else mark


def _moved(mark: Mark, x: float, y: float) -> Mark:
    """Shift a mark."""

    def shifted(point: Point) -> Point:
        return point[0] + x, point[1] + y

    match mark:
        case Stroke():
            return replace(mark, points=tuple(map(shifted, mark.points)))
        case Polygon():
            return replace(mark, loops=tuple(tuple(map(shifted, loop)) for loop in mark.loops))
        case Text():
            return replace(mark, place=shifted(mark.place))
        case Raster():
            box = mark.box
            return replace(mark, box=Box(box.x + x, box.y + y, box.width, box.height))
    assert_never(mark)
