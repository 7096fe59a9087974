r"""The pieces of a line: numbers, names, signs, and matrices pasted from other programs.

The signs of mathematics are read as those of the keyboard: − · × √ ² ⁻¹ ᵀ ≈ π °. A piece knows if a
blank stands before it, which inside brackets parts two entries.
"""

from __future__ import annotations

import re
import string
from collections.abc import Iterator
from enum import StrEnum
from fractions import Fraction
from itertools import chain
from typing import NamedTuple

from nmatrix.calculator.language.faults import CalculatorError
from nmatrix.errors import IllegalValueError
from nmatrix.reading.angles import angle
from nmatrix.reading.literal import BARE_POINT
from nmatrix.reading.notations import value_at
from nmatrix.reading.numbers import fraction

LONGEST = 10_000  # characters


class TokenKind(StrEnum):
    """What a piece of a line is."""

    NUMBER = "number"
    ANGLE = "angle"
    NAME = "name"
    WORD = "word"
    SIGN = "sign"
    PASTED = "pasted"
    LINE_END = "line end"
    END = "end"


class Token(NamedTuple):
    """One piece: its text and place, if a blank stands before it, and what it was read as."""

    kind: TokenKind
    text: str
    start: int
    end: int
    after_blank: bool = False
    degrees: Fraction = Fraction(0)
    rows: tuple[tuple[str, ...], ...] = ()

    def is_sign(self, *signs: str) -> bool:
        """Tell whether it is one of these signs."""
        return self.kind is TokenKind.SIGN and self.text in signs


_DIGITS = r"(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+)?"
_TOKEN = re.compile(
    rf"""
    (?P<blank>[ \t\r\xa0\u2000-\u200a\u202f\u3000]+ | \#[^\n]*)
    | (?P<line_end>\n)
    | (?P<angle>(?:{_DIGITS}(?:\*?(?:pi|π))?|pi|π)(?:/[0-9]+(?:\.[0-9]+)?)?
        [ ]?(?:deg|rad|turns?|°)(?![A-Za-z0-9_]))
    | (?P<number>{_DIGITS}(?![0-9]))
    | (?P<name>[A-Za-zΑ-Ωα-ω_][A-Za-z0-9_]*)
    | "(?P<word>[A-Za-z_]{{1,40}})" | '(?P<letters>[A-Za-z_]{{1,40}})'
    | (?P<raised>[⁻ᵀ⁰¹²³⁴⁵⁶⁷⁸⁹]+)
    | (?P<sign>\*\*|==|~=|≈|[-+*/@^=()\[\],;:.·⋅∙×√−–÷{{}}])
    """,
    re.VERBOSE,
)
_NOTATION = re.compile(
    r"(?:new )?[A-Za-z_][\w.:<>]{0,40} ?(?:\([0-9]{1,2}\) ?)?[\[({]"
    r"|\{|\[X|<M|\([0-9]{1,2}\) ?\["
)
_CALL = re.compile(r"[A-Za-z]\w* ?\([^)\n]*(?<![0-9.\w])[A-Za-z_α-ω]")
_BEGINS_NOTATION = frozenset(string.ascii_letters + "_{[<(")
_AS_TYPED = {"−": "-", "–": "-", "⋅": "·", "∙": "·", "÷": "/", "**": "^", "~=": "≈", "π": "pi"}
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
NEAREST = {  # what other languages write, and what is written here
    "'": "write A.T or A^T for a transpose",
    "%": "there is no remainder here; a remark begins with #",
    "!": "write 1*2*3 for a factorial, (a == b) for a comparison",
    "&": "write the two expressions on lines of their own",
    "|": "write length(v) for the length of a vector, abs(x) for a size",
    "$": "write the expression without the signs of TeX",
    "\\": "write inverse(A) @ b, or solve(A, b)",
    "<": "only == and ≈ compare",
    ">": "only == and ≈ compare",
    "?": "write help, or help inverse",
    '"': "letters in quotes are read only where an order is asked for",
}


def tokens(line: str, names: frozenset[str] = frozenset()) -> Iterator[Token]:
    """Part a line into its pieces, one after the other; no notation begins with one of the names.

    Raises
    ------
    CalculatorError
        At a character that means nothing, and for a line that is too long.

    Examples
    --------
    >>> [one.text for one in tokens("2*inverse(A)^−1 # twice")]
    ['2', '*', 'inverse', '(', 'A', ')', '^', '-', '1', '']
    """
    if len(line) > LONGEST:
        why = f"it has {len(line)} characters, {LONGEST} are read"
        raise CalculatorError(line, LONGEST, "expression", why)
    at, blank, before = 0, False, ""
    while at < len(line):
        piece = _TOKEN.match(line, at)
        kind = piece.lastgroup if piece else None
        if kind == "blank":
            at, blank = piece.end(), True  # type: ignore[union-attr]  # it is a match
            continue
        begins = line[at] in _BEGINS_NOTATION and before != "^"
        pasted = _pasted(line, at, blank, names) if begins else None
        if pasted:
            found = [pasted]
        elif piece is None or kind is None:
            what = "only numbers, names, brackets and + - * / @ ^ == mean something"
            raise CalculatorError(line, at, "character", NEAREST.get(line[at], what))
        elif kind == "raised":
            found = _raised(line, piece)
        else:
            found = [_token(line, piece, kind, blank=blank)]
        yield from found
        at, blank, before = found[-1].end, False, found[-1].text
    yield Token(TokenKind.END, "", len(line), len(line), after_blank=True)


def _token(line: str, piece: re.Match[str], kind: str, *, blank: bool) -> Token:
    text = piece[kind]
    known = TokenKind.WORD if kind == "letters" else TokenKind(kind.replace("_", " "))
    if kind != "angle":
        text = _AS_TYPED.get(text, text)
        return Token(known, text, piece.start(), piece.end(), blank)
    try:
        degrees = angle(text)
    except IllegalValueError as refusal:
        raise CalculatorError(line, piece.start(), "angle", refusal.parts[1]) from None
    return Token(known, text, piece.start(), piece.end(), blank, degrees)


def _raised(line: str, piece: re.Match[str]) -> list[Token]:
    """Read an exponent above the line as the one behind ^ that it stands for."""
    at, end = piece.span()
    is_negative = piece[0].startswith("⁻")
    rest = piece[0].removeprefix("⁻")
    digits = "".join("T" if c == "ᵀ" else str(_RAISED.find(c)) for c in rest)
    if not (digits == "T" or digits.isdigit()):
        raise CalculatorError(line, at, "exponent", "it is a whole number, ᵀ or ⁻ᵀ")
    signs = [Token(TokenKind.SIGN, sign, at, at) for sign in ("^-" if is_negative else "^")]
    kind = TokenKind.NAME if digits == "T" else TokenKind.NUMBER
    return [*signs, Token(kind, digits, at, end)]


def _pasted(line: str, at: int, blank: bool, names: frozenset[str]) -> Token | None:  # noqa: FBT001 - of a token
    sign = _NOTATION.match(line, at)
    if not sign or sign[0].rstrip("([{ ") in names:
        return None
    try:
        value = value_at(line, at, "a literal")
        for entry in chain.from_iterable(value[0] if value else ()):
            fraction(BARE_POINT.sub("", entry))
    except IllegalValueError as refusal:
        if _CALL.match(line, at):
            return None  # a name in it makes it a function, which has its own refusal
        what, why, _ = refusal.parts
        raise CalculatorError(line, at, what, why) from None
    if value is None:
        return None
    rows, end = value
    return Token(TokenKind.PASTED, line[at:end], at, end, blank, rows=tuple(map(tuple, rows)))
