r"""Words in LaTeX: what its fonts lack is mathematics, σ₁/σ₃ as $\sigma_{1}/\sigma_{3}$."""

from __future__ import annotations

import re
from itertools import groupby

from nmatrix.output.spelling import greek
from nmatrix.output.style import spelled
from nmatrix.output.write import Charset

_CHARACTERS = {
    "\\": r"\textbackslash{}",
    **{c: f"\\{c}" for c in "&%$#_{}"},
    "~": r"\textasciitilde{}",
    "^": r"\textasciicircum{}",
    "…": r"\dots{}",
    "—": "---",
}
MATHEMATICS = {
    **{letter: f"\\{greek(letter)}" for letter in "αβγδεζηθκλμνξπρστφχψωΓΔΘΛΞΠΣΦΨΩ"},
    "·": r"\cdot",
    "×": r"\times",
    "−": "-",
    "±": r"\pm",
    "≠": r"\neq",
    "≈": r"\approx",
    "≤": r"\le",
    "≥": r"\ge",
    "→": r"\to",
    "←": r"\leftarrow",
    "⇒": r"\Rightarrow",
    "⇔": r"\Leftrightarrow",
    "✗": r"\times",
    "√": r"\surd",
    "°": r"^{\circ}",
    "∞": r"\infty",
    "′": "{}'",  # it may follow an exponent
}
_RAISED = dict(zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ", (*"0123456789-", r"\mathsf T"), strict=True))
_LOWERED = dict(zip("₀₁₂₃₄₅₆₇₈₉", "0123456789", strict=True))
_PIECE = re.compile(f"[{''.join(_RAISED)}]+|[{''.join(_LOWERED)}]+|.", re.DOTALL)
_OVER = re.compile(r"(?<=[\w}])\$/\$(?=[\\\w])")  # between two formulas
# What the T1 fonts have beyond Latin-1.
_EASTERN = "ĂăĄąĆćČčĎďĐđĘęĚěĞğİıĹĺĽľŁłŃńŇňŐőŔŕŘřŚśŞşŠšŢţŤťŮůŰűŸŹźŻżŽž"


def escaped(text: str) -> str:
    r"""Escape text, so that LaTeX shows it as it is, also where its fonts lack a character.

    Examples
    --------
    >>> print(escaped("50 % of A⁻ᵀ"), escaped("condition σ₁/σ₃"))
    50 \% of A$^{-\mathsf T}$ condition $\sigma_{1}/\sigma_{3}$
    """
    pieces = [_piece(one[0]) for one in _PIECE.finditer(text)]
    runs = groupby(pieces, key=lambda piece: piece[0])
    parts = (
        f"${''.join(one for _, one in run)}$" if is_formula else "".join(one for _, one in run)
        for is_formula, run in runs
    )
    return _OVER.sub("/", "".join(parts))


def _piece(mark: str) -> tuple[bool, str]:
    """Write a character or a run of raised or lowered ones, and whether it is mathematics."""
    if mark[0] in _RAISED:
        return True, f"^{{{''.join(_RAISED[one] for one in mark)}}}"
    if mark[0] in _LOWERED:
        return True, f"_{{{''.join(_LOWERED[one] for one in mark)}}}"
    if mark in MATHEMATICS:
        return True, MATHEMATICS[mark]
    return False, _CHARACTERS.get(mark) or _in_latin(mark)


def _in_latin(mark: str) -> str:
    """Keep a letter that LaTeX's fonts have, and spell any other character in ASCII."""
    if mark.isascii() or (mark.isalpha() and mark <= "ÿ") or mark in _EASTERN:
        return mark if mark.isprintable() else " "
    return "".join(_CHARACTERS.get(c, c) for c in spelled(mark, Charset.ASCII))
