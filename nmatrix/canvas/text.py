r"""Text as it is set: runs of one style, raised and lowered, measured before they are drawn.

`A^{−T}*n*` is A with a true superscript −T and an oblique n; `_{…}` lowers. The font is the DejaVu
Sans that matplotlib ships, found without importing matplotlib.
"""

from __future__ import annotations

import re
from dataclasses import dataclass
from functools import cache
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from PIL import ImageFont

SMALL = 0.68  # of the size: superscripts and subscripts
RAISED, LOWERED = 0.36, -0.16  # of the size, above the baseline
LEADING = 1.35
MEASURED_AT = 200  # pixels: hinting is gone there
_MARKUP = re.compile(r"\^\{([^}]*)\}|_\{([^}]*)\}|\*([^*]+)\*")


@dataclass(frozen=True)
class Run:
    """Some letters of one style; `scale` and `shift` are parts of the text's size."""

    letters: str
    oblique: bool = False
    scale: float = 1.0
    shift: float = 0.0


def runs(text: str) -> tuple[Run, ...]:
    """Split marked-up text into runs.

    Examples
    --------
    >>> [(run.letters, run.oblique, run.shift) for run in runs("A^{−T}*n*")]
    [('A', False, 0.0), ('−T', False, 0.36), ('n', True, 0.0)]
    """
    found, place = [], 0
    for one in _MARKUP.finditer(text):
        if one.start() > place:
            found.append(Run(text[place : one.start()]))
        above, below, oblique = one.groups()
        if above is not None:
            found.append(Run(above, scale=SMALL, shift=RAISED))
        elif below is not None:
            found.append(Run(below, scale=SMALL, shift=LOWERED))
        else:
            found.append(Run(oblique, oblique=True))
        place = one.end()
    if place < len(text):
        found.append(Run(text[place:]))
    return tuple(found)


def plain(text: str) -> str:
    """Return marked-up text as one line of characters, for terminals and titles of files.

    Examples
    --------
    >>> plain("A^{−T}*n*, 10^{6} and A^{*}")
    'A⁻ᵀn, 10⁶ and A^*'
    """
    return "".join(
        run.letters
        if run.shift <= 0
        else run.letters.translate(_SMALLS)
        if all(ord(letter) in _SMALLS for letter in run.letters)
        else f"^{run.letters}"
        for run in runs(text)
    )


_SMALLS = str.maketrans("−-0123456789T", "⁻⁻⁰¹²³⁴⁵⁶⁷⁸⁹ᵀ")


def scientific(value: float, digits: int = 2) -> str:
    """Write a number from 0 on as marked-up text, with a power of ten if it is far from 1.

    Examples
    --------
    >>> scientific(2.04e-10, 1), scientific(1e6), scientific(0.231), scientific(140.2)
    ('2 · 10^{−10}', '10^{6}', '0.23', '140')
    """
    if value == 0 or 1e-3 <= value < 1e4:
        return f"{float(f'{value:.{digits}g}'):.12g}"
    return with_power(f"{value:.{digits - 1}e}")


def with_power(number: str) -> str:
    """Write a number with a power of ten as marked-up text; any other one as it is.

    Examples
    --------
    >>> with_power("1.50e-07"), with_power("1e+300"), with_power("12")
    ('1.5 · 10^{−7}', '10^{300}', '12')
    """
    mantissa, e, exponent = number.partition("e")
    if not e:
        return number
    power = f"10^{{{str(int(exponent)).replace('-', '−')}}}"
    mantissa = f"{float(mantissa):g}"
    return power if mantissa == "1" else f"{mantissa} · {power}"


def width(text: str, size: float, *, bold: bool = False) -> float:
    """Return the width of marked-up text on one line, in the units of its size.

    Examples
    --------
    >>> width("nn", 20) == 2 * width("n", 20)
    True
    """
    return sum(
        _font(bold=bold, oblique=run.oblique).getlength(run.letters) * run.scale
        for run in runs(text)
    ) * (size / MEASURED_AT)


def wrapped(text: str, size: float, room: float) -> list[str]:
    """Break marked-up text between its words into lines that fit the room.

    Examples
    --------
    >>> wrapped("one two", 20, 50)
    ['one', 'two']
    """
    lines: list[str] = []
    for paragraph in text.split("\n"):
        line = ""
        for word in paragraph.split(" "):
            longer = f"{line} {word}" if line else word
            if line and width(longer, size) > room:
                lines.append(line)
                longer = word
            line = longer
        lines.append(line)
    return lines


def fitting(text: str, sizes: range, room: float, *, bold: bool = False) -> int:
    """Return the largest of the sizes in which the text fits the room, or the least of them."""
    return max((s for s in sizes if width(text, s, bold=bold) <= room), default=min(sizes))


def font_file(*, bold: bool = False, oblique: bool = False) -> Path:
    """Return the file of the font in one of its four styles."""
    spec = find_spec("matplotlib")
    assert spec is not None and spec.origin is not None  # a dependency
    style = {(1, 0): "-Bold", (0, 1): "-Oblique", (1, 1): "-BoldOblique"}.get((bold, oblique), "")
    folder = Path(spec.origin).parent / "mpl-data" / "fonts" / "ttf"
    return folder / f"DejaVuSans{style}.ttf"


@cache
def _font(*, bold: bool, oblique: bool) -> ImageFont.FreeTypeFont:
    from PIL import ImageFont

    return ImageFont.truetype(font_file(bold=bold, oblique=oblique), MEASURED_AT)
