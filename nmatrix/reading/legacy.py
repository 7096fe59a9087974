"""Text in the encodings that spreadsheets save without saying which: guessed by its letters.

A byte means another letter in each encoding, and most encodings give text that nobody writes: a
capital inside a word, a sign of money in a name, letters of two scripts side by side. The encoding
with the least of that is taken, and the reader is told which.
"""

from __future__ import annotations

import re
from unicodedata import category, name

# What Excel saves as CSV on Windows, by country, on a Mac, and as MS-DOS; the likeliest first.
ENCODINGS = {
    "cp1252": "Western Windows",
    "cp1250": "Central European Windows",
    "cp1251": "Cyrillic Windows",
    "mac_roman": "Macintosh",
    "cp850": "MS-DOS",
}
QUOTES = "’“”«»–—…"
MOST_ODD = 0.34  # of the letters that are not ASCII
_WORDS = re.compile(r"[^\W\d_]+")


def guessed(content: bytes) -> tuple[str, str] | None:
    """Guess the encoding of bytes that are no UTF-8; the text and the encoding, if one fits.

    Examples
    --------
    >>> guessed("Müller, Zoë".encode("cp1252")), guessed("Ивана".encode("cp1251"))
    (('Müller, Zoë', 'cp1252'), ('Ивана', 'cp1251'))
    """
    found: list[tuple[int, str, str]] = []
    for encoding in ENCODINGS:
        try:
            text = content.decode(encoding)
        except UnicodeDecodeError:
            continue
        found.append((_oddities(text), encoding, text))
    if not found:
        return None
    odd, encoding, text = min(found, key=lambda one: one[0])
    foreign = sum(not c.isascii() for c in text)
    return (text, encoding) if odd <= MOST_ODD * foreign else None


def _oddities(text: str) -> int:
    """Count what nobody writes: signs and controls that are not ASCII, and odd words."""
    foreign = [c for c in text if not c.isascii() and c not in QUOTES]
    signs = sum(category(c)[0] not in "LMPZ" or c == "ƒ" for c in foreign)
    marks = sum(category(c)[0] == "P" for c in foreign)
    return 2 * signs + marks + sum(map(_oddities_of_word, set(_WORDS.findall(text))))


def _oddities_of_word(word: str) -> int:
    """Count letters of two scripts, capitals inside, and Latin words of accents alone."""
    foreign = sum(not c.isascii() for c in word)
    if not foreign:
        return 0
    scripts = {name(c, "?").partition(" ")[0] for c in word}
    beside = zip(word, word[1:], [*word[2:], ""], strict=False)
    capitals = [
        c
        for before, c, after in beside
        if not c.isascii() and c.isupper() and (before.islower() or after.islower())
    ]
    is_odd = len(scripts) > 1 or (scripts == {"LATIN"} and foreign > max(1, len(word) // 2))
    return 2 * len(capitals) + 2 * foreign * is_odd
