"""Work that a test counts: the calls of a piece of code, which no busy machine makes more."""

from __future__ import annotations

import gc
import sys
from collections.abc import Iterator
from contextlib import contextmanager


class TooManyCallsError(BaseException):
    """More calls than the work may take; no `except Exception` under test swallows it."""


@contextmanager
def at_most(most: int) -> Iterator[None]:
    """Stop what runs inside at more calls than `most`, of Python functions or built-in ones."""
    count = 0

    def profile(frame: object, event: str, argument: object) -> None:
        nonlocal count
        if event in ("call", "c_call"):
            count += 1
            if count > most:
                sys.setprofile(None)
                raise TooManyCallsError(f"more than {most} calls")

    before = sys.getprofile()
    gc.disable()  # others may have hooked calls of their own onto the collector
    sys.setprofile(profile)
    try:
        yield
    finally:
        sys.setprofile(before)
        gc.enable()
