"""The errors of nmatrix: what was wrong, why, and what to do next.

The tree::

    NMatrixError
    ├── CheckFailedError      exit 1   a check or a guarantee failed
    ├── IllegalValueError     exit 2   an illegal value, a contradiction, a bad file
    │   └── FrameError        exit 2   two frames that do not meet
    ├── NoAnswerError         exit 3   legal values for which no answer exists
    └── MissingPackageError   exit 4   an optional package is not installed
"""

from __future__ import annotations

from typing import ClassVar


class NMatrixError(Exception):
    """An error that a person can act on, in one line.

    Parameters
    ----------
    what
        What was wrong, with the value in parentheses.
    why
        The rule that it breaks, with numbers.
    next_step
        What to type instead.

    Examples
    --------
    >>> print(NMatrixError("near (0)", "it must be positive", "try --near 0.1"))
    near (0): it must be positive; try --near 0.1
    """

    exit_code: ClassVar[int] = 70

    def __init__(self, what: str, why: str = "", next_step: str = "") -> None:
        reason = "; ".join(part for part in (why, next_step) if part)
        super().__init__(": ".join(part for part in (what, reason) if part))


class CheckFailedError(NMatrixError):
    """A check or a guarantee did not hold."""

    exit_code = 1


class IllegalValueError(NMatrixError, ValueError):
    """A value that is illegal by itself, a contradiction, or a file that cannot be used."""

    exit_code = 2


class FrameError(IllegalValueError):
    """Two transforms whose frames do not meet."""


class NoAnswerError(NMatrixError, ArithmeticError):
    """Legal values for which the question has no answer."""

    exit_code = 3


class MissingPackageError(NMatrixError, ImportError):
    """An optional package is missing; the message holds the command that installs it."""

    exit_code = 4


LONGEST_QUOTE = 40  # characters


def quoted(text: str) -> str:
    r"""Put the beginning of a text in quotes for a one-line message, whatever it holds.

    Examples
    --------
    >>> quoted("1 0\n0"), quoted("x" * 60)[-5:]
    ("'1 0\\n0'", "xxx'…")
    """
    shown = repr(text[:LONGEST_QUOTE])
    safe = shown.encode("utf-8", "backslashreplace").decode()
    return safe if len(text) <= LONGEST_QUOTE else f"{safe}…"
