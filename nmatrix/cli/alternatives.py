"""Options that exclude each other: one sentence for every contradiction."""

from __future__ import annotations

from collections.abc import Mapping

from nmatrix.errors import IllegalValueError


def refuse_together(option: str, others: Mapping[str, object], because: str) -> None:
    """Refuse an option beside any of the others that was given.

    Raises
    ------
    IllegalValueError
        If there is one.
    """
    if others:
        raise IllegalValueError(f"{option} with {', '.join(others)}", because, "keep one of them")
