"""Defaults from the environment: an option wins, and what a command cannot use is passed over."""

from __future__ import annotations

import os
from enum import StrEnum
from typing import TypeVar

Word = TypeVar("Word", bound=StrEnum)


def usual(variable: str, words: type[Word]) -> Word | None:
    """Read a word that a variable sets, if it is one of these.

    Examples
    --------
    >>> from nmatrix.enums import Theme
    >>> os.environ["NMATRIX_THEME"] = "dark"
    >>> usual("NMATRIX_THEME", Theme)
    <Theme.DARK: 'dark'>
    >>> os.environ["NMATRIX_THEME"] = "pink"
    >>> usual("NMATRIX_THEME", Theme)
    >>> del os.environ["NMATRIX_THEME"]
    """
    typed = os.environ.get(variable)
    return words(typed) if typed in list(words) else None


def usual_number(variable: str, among: range) -> int | None:
    """Read a whole number that a variable sets, if it is in the range."""
    typed = os.environ.get(variable, "")
    is_number = typed.isascii() and typed.isdigit() and len(typed) < 9
    return int(typed) if is_number and int(typed) in among else None
