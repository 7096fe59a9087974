"""Formulas as one types them: marks above and below the line, cells, the bar of [A | I], widths.

Whoever writes or draws a formula needs no more of it; its tree is read in `nmatrix.formula`.
"""

from __future__ import annotations

from collections.abc import Sequence

TypedRows = tuple[tuple[str, ...], ...]

RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻ᵀ′ˢ"
LOWERED = "₀₁₂₃₄₅₆₇₈₉"
BAR = "|"  # in every cell of a column: no numbers, but the line between two blocks
GAP = "  "  # between two columns of a drawn matrix


def bar_of(rows: TypedRows) -> int:
    """Find the column of a typed matrix that is its bar; 0 where it has none.

    Examples
    --------
    >>> bar_of((("1", "2", "|", "5"), ("3", "4", "|", "6")))
    2
    """
    return next((i for i, column in enumerate(zip(*rows, strict=True)) if {*column} == {BAR}), 0)


def columns_of(parts: Sequence[str | TypedRows]) -> int:
    """Count the characters of the widest line of drawn parts that stand side by side.

    Examples
    --------
    >>> columns_of(("A = ", (("1", "0"), ("0", "−2"))))
    13
    """
    return sum(len(part) if isinstance(part, str) else _columns(part) for part in parts)


def _columns(rows: TypedRows) -> int:
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    return sum(widths) + len(GAP) * (len(widths) - 1) + len("[  ]")
