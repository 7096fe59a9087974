"""Quote what was typed inside a one-line message, whatever it holds."""

from __future__ import annotations

LONGEST = 40


def quoted(text: str) -> str:
    r"""Return the beginning of a text, in quotes and free of control characters.

    Examples
    --------
    >>> quoted("1 0\n0"), quoted("x" * 60)[-5:]
    ("'1 0\\n0'", "xxx'…")
    """
    shown = repr(text[:LONGEST])
    safe = shown.encode("utf-8", "backslashreplace").decode()
    return safe if len(text) <= LONGEST else f"{safe}…"
