"""The colours of every picture: one idea, one colour, in three themes.

Wrong and right, normals, lights and the eye have a colour each and nothing else has it. Each
difference is also told by a shape, so that grey paper and colour-blind eyes lose nothing.
"""

from __future__ import annotations

from dataclasses import dataclass, fields

from nmatrix.enums import Theme

HEAT_STOPS = ("#0D0850", "#4E238C", "#9E3280", "#D65C52", "#F8A030", "#FAF06E")


@dataclass(frozen=True)
class Palette:
    """A theme's colours by what they stand for, as #RRGGBB.

    `paper` is the sheet, `stage` what objects stand on; `ink` outlines, text and axes; `soft`
    captions and ticks; `rule` hatching and dividers; `grid` floors and grids; `body` the filled
    shape of a diagram; `inside` the hatched inner side of a surface; `shade` and `lit` the surface
    of a solid body without and with light.
    """

    paper: str
    stage: str
    ink: str
    soft: str
    rule: str
    grid: str
    wrong: str
    right: str
    normal: str
    tangent: str
    light: str
    eye: str
    body: str
    inside: str
    heat: tuple[str, ...] = HEAT_STOPS

    @property
    def bright(self) -> str:
        """The lighter one of paper and ink: bodies look the same on a dark sheet."""
        return max(self.paper, self.ink)

    @property
    def dim(self) -> str:
        """The darker one of paper and ink."""
        return min(self.paper, self.ink)

    @property
    def named(self) -> dict[str, str]:
        """The single colours by their names."""
        return {one.name: getattr(self, one.name) for one in fields(self) if one.name != "heat"}


PALETTES = {
    Theme.LIGHT: Palette(
        paper="#FFFFFF",
        stage="#E3E7EC",
        ink="#1B1F27",
        soft="#566070",
        rule="#C3CAD3",
        grid="#A3AFBD",
        wrong="#CC3D0B",
        right="#00674F",
        normal="#1D5FBF",
        tangent="#6B7280",
        light="#F2B100",
        eye="#7A3FA6",
        body="#F0DFBF",
        inside="#F3C4B3",
    ),
    Theme.DARK: Palette(
        paper="#10141B",
        stage="#252C37",
        ink="#F3F5F8",
        soft="#A9B4C2",
        rule="#475364",
        grid="#A3AFBD",
        wrong="#FF7A45",
        right="#4FE0B5",
        normal="#7FB4FF",
        tangent="#A3ADBA",
        light="#FFC933",
        eye="#C79BF2",
        body="#8E7A58",
        inside="#6B3A28",
    ),
    Theme.PRINT: Palette(
        paper="#FFFFFF",
        stage="#FFFFFF",
        ink="#000000",
        soft="#3A3A3A",
        rule="#9A9A9A",
        grid="#9A9A9A",
        wrong="#000000",
        right="#000000",
        normal="#000000",
        tangent="#6B6B6B",
        light="#FFFFFF",
        eye="#000000",
        body="#E9E9E9",
        inside="#FFFFFF",
        heat=("#121212", "#3F3F3F", "#6A6A6A", "#8E8E8E", "#B9B9B9", "#EDEDED"),
    ),
}


def channels(colour: str) -> tuple[float, float, float]:
    """Return the red, green and blue of #RRGGBB, each in [0, 1].

    Examples
    --------
    >>> channels("#FF0033")
    (1.0, 0.0, 0.2)
    """
    red, green, blue = (int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue
