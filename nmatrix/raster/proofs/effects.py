"""The effects proof: what a plan leaves out of a picture, and that nobody can see it."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace
from decimal import ROUND_CEILING, Context

import numpy as np

from nmatrix.canvas.glyphs import Verdict, hatch
from nmatrix.canvas.marks import Box
from nmatrix.canvas.slide import CAPTION, GUTTER, NARROW_HEADING, Panel, Slide
from nmatrix.canvas.text import scientific
from nmatrix.canvas.theme import channels
from nmatrix.enums import Effect, Theme
from nmatrix.raster.drawn_scene import DrawnScene, drawn_plan, level_difference
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.overlay.stage import Stage
from nmatrix.raster.planning.effects import RECIPES, of_effect, per_sample
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.raster.proofs.showpiece import showpiece
from nmatrix.raster.shading.outline import OF_HULLS
from nmatrix.raster.shading.texture import from_srgb
from nmatrix.report import Value

PICTURES, BELOW = 0.70, 116.0  # of the width; units
BAR_HIGH, LIST_BELOW, LINE, SHARE_WIDE = 54.0, 62.0, 44.0, 68.0
NAMED = 5  # of what is left out: the dearest
LUMA = (0.2126, 0.7152, 0.0722)  # of red, green and blue in grey
UNSEEN = "objects that are out of sight"
ONCE = "samples of a pixel that one may stand for"
FAR_LAMPS = "lamps that do not reach"


@dataclass(frozen=True, eq=False)
class Both:
    """One scene drawn with everything on, and by its plan; the seconds that they took."""

    full: DrawnScene
    plan: DrawnScene
    seconds: tuple[float, float]

    @property
    def most(self) -> int:
        """Return the multiplications of everything."""
        return self.full.rendered.work.multiplications

    @property
    def needed(self) -> int:
        """Return the multiplications of the plan."""
        return self.plan.rendered.work.multiplications

    @property
    def saved(self) -> float:
        """Return the part of the multiplications that is left out."""
        return 1 - self.needed / self.most

    @property
    def difference(self) -> float:
        """Return the most by which a channel of a pixel differs, of white."""
        return float(np.abs(self.full.rendered.rgb - self.plan.rendered.rgb).max())

    @property
    def left_out(self) -> list[tuple[str, int]]:
        """Return what is left out, in words, and its multiplications; the dearest first.

        An effect costs as much as its samples under the lamps that the plan keeps; samples and
        lamps that are not computed at all cost all their effects.
        """
        found: Counter[str] = Counter()
        kept = _shaded(self.plan)
        for name, one in _shaded(self.full).items():
            if name not in kept:
                found[UNSEEN] += one.multiplications
                continue
            other = kept[name]
            fewer = replace(one, samples=other.samples)
            found[ONCE] += one.multiplications - fewer.multiplications
            nearer = replace(fewer, lamps=other.lamps)
            found[FAR_LAMPS] += fewer.multiplications - nearer.multiplications
            for effect in one.effects - other.effects:
                found[RECIPES[effect].says] += other.samples * of_effect(effect, other.lamps)
        return [(words, count) for words, count in found.most_common() if count]


@dataclass(frozen=True)
class Shaded:
    """The samples of a body or of its outline that were coloured, with what effects and lamps."""

    effects: frozenset[Effect]
    lamps: int
    samples: int

    @property
    def multiplications(self) -> int:
        """Return what they took."""
        return self.samples * per_sample(self.effects, self.lamps)


def _shaded(drawn: DrawnScene) -> dict[str, Shaded]:
    """Return what was shaded of each body and, behind it, of each outline, by name."""
    bodies = drawn.plan.drawn
    parts = [(one.body.name, one.effects, len(one.lights)) for one in bodies]
    parts += [
        (f"the outline of {one.body.name}", one.effects & OF_HULLS, 0)
        for one in bodies
        if Effect.OUTLINE in one.effects
    ]
    return {
        name: Shaded(effects, lamps, samples)
        for (name, effects, lamps), samples in zip(parts, drawn.rendered.shaded, strict=True)
    }


def effects(settings: ProofSettings) -> Proof:
    """Draw a scene with everything on and by its plan: the same picture for less work."""
    found = _drawn(settings, _places(settings.slide(""))[0])
    slide = settings.slide(
        f"The plan leaves out the unseen: {_percent(found.saved)} less work, the same picture"
    )
    first, second, beside = _places(slide)
    panels = (
        slide.panel(first, "everything on"),
        slide.panel(second, "what the scene calls for"),
    )
    for panel, drawn in zip(panels, (found.full, found.plan), strict=True):
        _put(slide, panel, drawn, in_grey=settings.theme is Theme.PRINT)
    slide.compare(*panels, same=True)
    _list(slide, _bars(slide, beside, found), found)
    most = Context(prec=1, rounding=ROUND_CEILING).create_decimal_from_float(found.difference)
    told = f"by more than {scientific(float(most), 1)} of white" if most else "at all"
    slide.footer(f"No channel of any pixel differs {told}.", Verdict.RIGHT)
    numbers: dict[str, Value] = {
        "difference": found.difference,
        "multiplications_everything": found.most,
        "multiplications_planned": found.needed,
        "milliseconds_everything": found.seconds[0] * 1000,
        "milliseconds_planned": found.seconds[1] * 1000,
    }
    return Proof.of(
        settings.subject,
        slide,
        f"The plan saves {found.saved:.0%} of the multiplications; no channel moves by more than "
        f"{float(most):.0e}.",
        [found.full, found.plan],
        numbers=numbers,
        max_level_difference=level_difference(found.full, found.plan),
    )


def _places(slide: Slide) -> tuple[Box, Box, Box]:
    """Return the stages of both pictures, of one size, and the box beside them."""
    body = slide.body(BELOW)
    left = replace(body, width=PICTURES * body.width)
    one, other = (slide.canvas.on_pixels(box) for box in left.columns(2, GUTTER))
    x = left.right + 2 * GUTTER
    return one, replace(one, x=other.x), Box(x, body.y, body.right - x, body.height)


def _drawn(settings: ProofSettings, stage: Box) -> Both:
    """Draw the scene both ways for a stage."""
    slide = settings.slide("")
    red, green, blue = from_srgb(np.array(channels(slide.palette.stage))).tolist()
    size = slide.canvas.pixels_of(stage)
    picture = replace(settings.picture, size=size, background=(red, green, blue))
    ready = loaded(showpiece(picture))
    started = settings.clock()
    full = drawn_plan(everything(ready))
    between = settings.clock()
    plan = drawn_plan(planned(ready))
    return Both(full, plan, (between - started, settings.clock() - between))


def _put(slide: Slide, panel: Panel, drawn: DrawnScene, *, in_grey: bool) -> None:
    """Lay a picture on its stage, and the lamps that are in sight."""
    shown = drawn.levels
    if in_grey:
        shown = np.rint(shown @ np.array(LUMA))[:, :, None].repeat(3, axis=2).astype(np.uint8)
    slide.canvas.image(panel.stage, shown)
    Stage(slide.canvas, panel.stage, drawn).lights()


def _bars(slide: Slide, box: Box, found: Both) -> float:
    """Draw the multiplications of both as bars; return the y below them."""
    canvas, palette = slide.canvas, slide.palette
    slide.heading(box.x, box.y - 16, "Multiplications", size=NARROW_HEADING)
    upper = replace(box, height=BAR_HIGH)
    lower = replace(upper, y=upper.bottom + GUTTER)
    needed = replace(lower, width=lower.width * found.needed / found.most)
    canvas.polygon(upper.corners, fill=palette.soft)
    canvas.polygon(needed.corners, fill=palette.right)
    saved = Box(needed.right, lower.y, lower.right - needed.right, lower.height)
    _hatched(slide, saved)
    for bar, words, count in (
        (upper, "everything", found.most),
        (needed, "plan", found.needed),
    ):
        told = f"{words}: {_counted(count)}"
        place = bar.x + 14, bar.middle[1] + 8
        canvas.text(place, told, CAPTION, palette.paper, bold=True)
    return lower.bottom


def _hatched(slide: Slide, box: Box) -> None:
    soft = slide.palette.soft
    hatch(slide.canvas, box.corners, 14.0, soft, 2.4)
    slide.canvas.polygon(box.corners, fill=None, edge=soft, width=2.4)


def _list(slide: Slide, top: float, found: Both) -> None:
    """Name what is left out under the bars, the dearest first, each with its part of all."""
    box = _places(slide)[2]
    y = top + LIST_BELOW
    swatch = Box(box.x, y - 22, 34, 26)
    _hatched(slide, swatch)
    slide.heading(swatch.right + 14, y, "left out, of everything", size=NARROW_HEADING)
    y += LINE
    for words, count in found.left_out[:NAMED]:
        slide.canvas.text((box.x, y), _percent(count / found.most), CAPTION, bold=True)
        room = box.width - SHARE_WIDE
        y = slide.canvas.paragraph((box.x + SHARE_WIDE, y), words, CAPTION, room) + 6


def _percent(part: float) -> str:
    return f"{100 * part:.0f} %"


def _counted(multiplications: int) -> str:
    """Write a large number in words.

    Examples
    --------
    >>> _counted(249_477_807), _counted(812_345)
    ('249 million', '0.81 million')
    """
    millions = multiplications / 1e6
    return f"{millions:.0f} million" if millions >= 10 else f"{millions:.2g} million"
