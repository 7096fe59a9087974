"""A script that runs inside an explorer: the names that it lets others ask are in scope."""

from __future__ import annotations

PLACE = "document.querySelector('#nmatrix-explorer').explorer"


def inside(script: str, place: str = PLACE) -> str:
    """A function of the page whose body sees the explorer's own names."""
    return f"(...given) => {{ with ({place}) {{ return ({script})(...given); }} }}"
