"""Characters that an output cannot say, spelled in those of ASCII: one table for every encoding."""

from __future__ import annotations

import re
import unicodedata

RAISED = re.compile("[⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ]+")  # a whole exponent
_ROOT = re.compile(r"√(\w+)")
_ON_THE_LINE = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ", "0123456789-T")
# Letters with accents, indices and Greek need no line: their Unicode names spell them.
_SPELLINGS = {
    "−": "-",
    "–": "-",
    "—": "-",
    "‑": "-",
    "·": "*",
    "∙": "*",
    "⋅": "*",
    "∗": "*",
    "×": "x",
    "÷": "/",
    "⁄": "/",
    "√": "sqrt",
    "°": " deg",
    "′": "'",
    "″": "''",
    "±": "+-",
    "∓": "-+",
    "≤": "<=",
    "≥": ">=",
    "≠": "!=",
    "≈": "~",
    "≡": "==",
    "←": "<-",
    "→": "->",
    "↔": "<->",
    "↑": "^",
    "↓": "v",
    "↦": "->",
    "⇒": "=>",
    "⇔": "<=>",
    "∞": "inf",
    "∂": "d",
    "∇": "grad ",
    "∑": "sum ",
    "∏": "product ",
    "∫": "integral ",
    "∘": " o ",
    "∅": "{}",
    "‖": "|",
    "∥": "|",
    "⟨": "<",
    "⟩": ">",
    "⊥": " perpendicular to ",
    "⟂": " perpendicular to ",
    "⊤": "T",
    "∈": " in ",
    "∉": " not in ",
    "⊂": " part of ",
    "∧": " and ",
    "∨": " or ",
    "¬": "not ",
    "∀": "for all ",
    "∃": "there is ",
    "…": "...",
    "⋯": "...",
    "‘": "'",
    "’": "'",
    "“": '"',
    "”": '"',
    "„": '"',
    "«": '"',
    "»": '"',
    "ß": "ss",
    "§": "section ",
    "ı": "i",
    "λ": "lambda",
    "Λ": "Lambda",
    "µ": "u",
    "⎡": "[",
    "⎢": "[",
    "⎣": "[",
    "⎤": "]",
    "⎥": "]",
    "⎦": "]",
    "⎛": "(",
    "⎜": "(",
    "⎝": "(",
    "⎞": ")",
    "⎟": ")",
    "⎠": ")",
    "│": "|",
    "┃": "|",
    "─": "-",
    "━": "-",
    "═": "=",
    "├": "+",
    "└": "+",
    "•": "*",
    "█": "#",
    "▀": "#",
    "▄": "#",
    "✓": "ok",
    "✗": "(wrong)",
    "☐": "[ ]",
    "\N{NO-BREAK SPACE}": " ",
    "\N{THIN SPACE}": " ",
    "\N{NARROW NO-BREAK SPACE}": " ",
    "\N{INVISIBLE TIMES}": " ",
    "\N{FUNCTION APPLICATION}": "",
    "\N{ZERO WIDTH SPACE}": "",
    "\N{ZERO WIDTH JOINER}": "",
    "\N{ZERO WIDTH NON-JOINER}": "",
    "\N{BYTE ORDER MARK}": "",
}
_LETTER = re.compile(r"(?:GREEK|LATIN|CYRILLIC) (SMALL|CAPITAL) LETTER (?:FINAL )?(\w+)")


def sayable(text: str, encoding: str) -> str:
    """Write a text in the characters of an encoding; what it lacks is spelled, not escaped.

    A character that has no spelling is called by its number, as in U+76EE.

    Examples
    --------
    >>> sayable("A⁻ᵀ is 90° − θ, to 10⁻¹⁴", "ascii")
    'A^-T is 90 deg - theta, to 10^-14'
    >>> sayable("90° − θ, to 10⁻¹ or n²", "cp1252")
    '90° - theta, to 10^-1 or n²'
    >>> sayable("√3/2", "ascii")
    'sqrt(3)/2'
    """
    if text.isascii() or _knows(encoding, text):
        return text
    level = RAISED.sub(
        lambda found: (
            found[0] if _knows(encoding, found[0]) else "^" + found[0].translate(_ON_THE_LINE)
        ),
        text if _knows(encoding, "√") else _ROOT.sub(r"sqrt(\1)", text),
    )
    return "".join(one if _knows(encoding, one) else _spelling(one) for one in level)


def greek(letter: str) -> str | None:
    """Name a Greek letter, as LaTeX and people call it; None for any other text.

    Examples
    --------
    >>> greek("κ"), greek("λ"), greek("Σ"), greek("k"), greek("det")
    ('kappa', 'lambda', 'Sigma', None, None)
    """
    is_greek = len(letter) == 1 and unicodedata.name(letter, "").startswith("GREEK")
    return _spelling(letter) if is_greek else None


def _knows(encoding: str, text: str) -> bool:
    try:
        text.encode(encoding)
    except UnicodeEncodeError:
        return False
    except LookupError:  # an encoding that Python has never heard of
        return text.isascii()
    return True


def _spelling(character: str) -> str:
    if character in _SPELLINGS:
        return _SPELLINGS[character]
    parts = unicodedata.normalize("NFKD", character)
    if parts != character:
        shown = [one for one in parts if not unicodedata.combining(one)]
        return "".join(one if one.isascii() else _spelling(one) for one in shown)
    letter = _LETTER.match(unicodedata.name(character, ""))
    if letter is None:
        return f"U+{ord(character):04X}"
    return letter[2].capitalize() if letter[1] == "CAPITAL" else letter[2].lower()
