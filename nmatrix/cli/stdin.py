"""Standard input, whole and bounded."""

from __future__ import annotations

import sys

from nmatrix.errors import IllegalValueError
from nmatrix.reading.files import LARGEST

NAME = "standard input"


def standard_input(next_step: str) -> bytes:
    """Return all of standard input; `next_step` is what to do where it is too long.

    Raises
    ------
    IllegalValueError
        If it is longer than any file that is read.
    """
    content = sys.stdin.buffer.read(LARGEST + 1)
    if len(content) > LARGEST:
        raise IllegalValueError(NAME, f"it is longer than {LARGEST} bytes", next_step)
    return content
