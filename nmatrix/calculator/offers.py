"""What TAB offers in a session: names, functions and keywords, and what may follow each keyword."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass

from nmatrix.calculator.evaluate import CONSTANTS
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.grammar import MEMBERS
from nmatrix.calculator.handbook import EVERY_FUNCTION, FORMATS
from nmatrix.calculator.statements import Keyword
from nmatrix.enums import InverseBy, Numbers

_BEGUN = re.compile(r"(\.?)([A-Za-z_][A-Za-z0-9_]*|)\Z")
_WORDS = re.compile(r"\s*(\w+)((?:\s+\S+)*)\s+(\S*)\Z")


@dataclass(frozen=True)
class Offer:
    """The words that may stand in place of the last one, as it is typed; or files that begin so."""

    begun: str
    words: tuple[str, ...] = ()
    is_file: bool = False


def offers(names: Iterable[str], before: str) -> Offer:
    """Offer what may be meant by the end of the text before the cursor.

    Examples
    --------
    >>> offers(["M"], "2 * inv"), offers(["M"], "show M as gl").words
    (Offer(begun='inv', words=('inverse(', 'inverse_transpose('), is_file=False), ('glsl',))
    """
    asked = _WORDS.match(before)
    if asked and asked[1] in list(Keyword):
        keyword, others, begun = Keyword(asked[1]), asked[2].split(), asked[3]
        if keyword in (Keyword.SAVE, Keyword.LOAD):
            return Offer(before[asked.end(1) :].lstrip(), is_file=True)
        return _beginning(begun, _following(keyword, others, names))
    point, begun = _BEGUN.search(before).groups()  # type: ignore[union-attr]  # it may be empty
    if point:
        return _beginning(begun, MEMBERS)
    words = [*names, *CONSTANTS, *(f"{name}(" for name in FUNCTIONS)]
    if before.strip() == begun:
        words += Keyword
    return _beginning(begun, words)


def _beginning(begun: str, words: Iterable[str]) -> Offer:
    return Offer(begun, tuple(sorted({str(one) for one in words if one.startswith(begun)})))


def _following(keyword: Keyword, others: list[str], names: Iterable[str]) -> Iterable[str]:
    """List what may stand behind a keyword and the words after it."""
    known: dict[tuple[str, ...], Iterable[str]] = {
        (Keyword.HELP,): (EVERY_FUNCTION, *FUNCTIONS, *Keyword),
        (Keyword.SHOW,): names,
        (Keyword.SHOW, "as"): FORMATS,
        (Keyword.STEPS,): ("on", "off", "by"),
        (Keyword.STEPS, "by"): InverseBy,
        (Keyword.NUMBERS,): Numbers,
    }
    if keyword is Keyword.SHOW and len(others) == 1:
        return ("as",)
    shown = others[1:] if keyword is Keyword.SHOW else others  # behind the name that is shown
    return known.get((keyword, *shown), ())
