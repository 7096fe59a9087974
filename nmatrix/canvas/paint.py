"""Canvases written as pixels, SVG and PDF: one walk over the marks, by matplotlib's renderers.

Text stays text in SVG and PDF; images are embedded as they are.
"""

from __future__ import annotations

import io
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any, assert_never

from nmatrix.canvas.marks import Canvas, Mark, Polygon, Raster, Stroke, Text
from nmatrix.canvas.text import MEASURED_AT, font_file, runs, width
from nmatrix.enums import VectorFormat

if TYPE_CHECKING:
    from matplotlib.backend_bases import RendererBase
    from matplotlib.figure import Figure
    from matplotlib.path import Path
    from numpy.typing import NDArray

POINTS = 72  # in an inch, and units: a unit is a point
HALO = 4.0  # units around letters
HAIR = 1e-6  # points, so that no side is cut to one pixel less
LEAST_TEXT = 2.0  # pixels: fonts have no smaller letters, and no eye reads them
AS_WIDE_AS_MEASURED: Any = {"text.hinting": "none"}  # hinted letters stand on whole pixels
TEXT_AS_TEXT: Any = {"svg.fonttype": "none", "pdf.fonttype": 42, "svg.hashsalt": "nmatrix"}


def pixels(canvas: Canvas) -> NDArray[Any]:
    """Paint a canvas as 8-bit pixels (height, width, 3)."""
    import matplotlib as mpl
    import numpy as np
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    figure = _figure(canvas, canvas.scale)
    agg = FigureCanvasAgg(figure)
    with mpl.rc_context(AS_WIDE_AS_MEASURED):
        agg.draw()
    wide, high = canvas.pixels
    return np.array(np.asarray(agg.buffer_rgba())[:high, :wide, :3])


def vector(canvas: Canvas, kind: VectorFormat, texts: Mapping[str, str]) -> bytes:
    """Write a canvas as SVG or PDF, with a title and a description of it."""
    import matplotlib as mpl

    title, description = texts.get("Title", ""), texts.get("Description", "")
    match kind:
        case VectorFormat.SVG:
            told = {"Title": title, "Description": description, "Date": None, "Creator": "nmatrix"}
        case VectorFormat.PDF:
            told = {"Title": title, "Subject": description, "CreationDate": None}
        case _:
            assert_never(kind)
    out = io.BytesIO()
    with mpl.rc_context(TEXT_AS_TEXT):
        _figure(canvas, 1.0).savefig(out, format=kind.value, metadata=told)
    return out.getvalue()


def _figure(canvas: Canvas, scale: float) -> Figure:
    """Return a figure with one artist, which paints the marks with so many points to a unit.

    A point is a pixel: matplotlib cuts letters for whole numbers of dots in an inch alone.
    """
    from matplotlib.artist import Artist
    from matplotlib.figure import Figure

    class Marks(Artist):
        def draw(self, renderer: RendererBase) -> None:
            painter = _Painter(renderer, canvas, scale)
            for mark in canvas.marks:
                painter.paint(mark)

    points = (side * scale / canvas.scale for side in canvas.pixels)
    wide, high = ((side + HAIR) / POINTS for side in points)
    figure = Figure(figsize=(wide, high), dpi=POINTS, facecolor=canvas.palette.paper)
    figure.add_artist(Marks())
    return figure


class _Painter:
    """One walk over marks with a renderer, whose y goes up and whose unit is its own pixel."""

    def __init__(self, renderer: RendererBase, canvas: Canvas, scale: float) -> None:
        from matplotlib.transforms import Affine2D

        self.renderer, self.canvas = renderer, canvas
        self.scale = renderer.points_to_pixels(scale)
        self.height = canvas.pixels[1] / canvas.scale * self.scale
        flipped = Affine2D().scale(self.scale, -self.scale)
        self.to_renderer = flipped.translate(0, self.height)

    def paint(self, mark: Mark) -> None:
        """Paint one mark."""
        match mark:
            case Stroke():
                self._stroke(mark)
            case Polygon():
                self._polygon(mark)
            case Text():
                self._text(mark)
            case Raster():
                self._raster(mark)
            case _:
                assert_never(mark)

    def _stroke(self, mark: Stroke) -> None:
        from matplotlib.path import Path

        gc = self._gc(mark.colour, mark.width)
        if mark.dash is not None:
            gc.set_dashes(0, mark.dash)
        gc.set_capstyle("round" if mark.round_ends else "butt")
        gc.set_joinstyle("round")
        self.renderer.draw_path(gc, Path(mark.points), self.to_renderer, None)
        gc.restore()

    def _polygon(self, mark: Polygon) -> None:
        from matplotlib.colors import to_rgba
        from matplotlib.path import Path

        loops = [Path((*loop, loop[0]), closed=True) for loop in mark.loops]
        path = Path.make_compound_path(*loops)
        gc = self._gc(mark.edge or mark.fill or "#000000", mark.width if mark.edge else 0.0)
        gc.set_joinstyle("miter")
        if mark.opacity < 1:
            gc.set_alpha(mark.opacity)
        fill = None if mark.fill is None else to_rgba(mark.fill)
        self.renderer.draw_path(gc, path, self.to_renderer, fill)
        gc.restore()

    def _text(self, mark: Text) -> None:
        from matplotlib.font_manager import FontProperties

        x, y = mark.place
        for run in runs(mark.text):
            size = mark.size * run.scale
            if size * self.scale < LEAST_TEXT:
                continue
            face = font_file(bold=mark.bold, oblique=run.oblique)
            place = self.to_renderer.transform((x, y - run.shift * mark.size))
            if mark.halo is not None:
                gc = self._gc(mark.halo, HALO)
                gc.set_joinstyle("round")
                shape = _letters(run.letters, str(face))
                moved = _scaled(size * self.scale / MEASURED_AT, *place)
                self.renderer.draw_path(gc, shape, moved, None)
                gc.restore()
            gc = self._gc(mark.colour, 1.0)
            up = self.height - place[1] if self.renderer.flipy() else place[1]
            font = FontProperties(
                family="DejaVu Sans",
                style="oblique" if run.oblique else "normal",
                weight="bold" if mark.bold else "normal",
                size=size * self.scale,
                fname=str(face),  # found without a search
            )
            self.renderer.draw_text(gc, place[0], up, run.letters, font, 0.0)
            gc.restore()
            slanted = f"*{run.letters}*" if run.oblique else run.letters
            x += width(slanted, size, bold=mark.bold)

    def _raster(self, mark: Raster) -> None:
        import numpy as np
        from matplotlib.transforms import Affine2D

        box = mark.box
        left, bottom = self.to_renderer.transform((box.x, box.bottom))
        opaque = np.full((*mark.pixels.shape[:2], 1), 255, np.uint8)
        upwards = np.concatenate([mark.pixels, opaque], axis=2)[::-1]
        gc = self.renderer.new_gc()
        if self.renderer.option_scale_image():
            sides = Affine2D().scale(box.width * self.scale, box.height * self.scale)
            self.renderer.draw_image(gc, left, bottom, upwards, sides)
        else:
            self.renderer.draw_image(gc, round(left), round(bottom), np.ascontiguousarray(upwards))
        gc.restore()

    def _gc(self, colour: str, line: float) -> Any:  # noqa: ANN401  # matplotlib's graphics context
        gc = self.renderer.new_gc()
        gc.set_foreground(colour)
        gc.set_linewidth(line)  # in points, which the renderer scales
        gc.set_antialiased(True)
        gc.set_snap(False)
        return gc


@cache
def _letters(letters: str, face: str) -> Path:
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import TextPath

    return TextPath((0, 0), letters, size=MEASURED_AT, prop=FontProperties(fname=face))


def _scaled(factor: float, x: float, y: float) -> Any:  # noqa: ANN401  # matplotlib's transform
    from matplotlib.transforms import Affine2D

    return Affine2D().scale(factor).translate(x, y)
