"""A formula in characters: matrices over several lines, beside each other."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output.drawing import brackets
from nmatrix.output.options import Charset
from nmatrix.report import Formula


def text(formula: Formula) -> str:
    """Draw a formula as it was typed, with tall brackets around its matrices.

    Examples
    --------
    >>> print(text(Formula(("A = ", (("1", "0"), ("0", "−2"))))))
    A = ⎡ 1   0 ⎤
        ⎣ 0  −2 ⎦
    """
    blocks = [[part] if isinstance(part, str) else _matrix(part) for part in formula.parts]
    height = max(map(len, blocks))
    padded = []
    for block in blocks:
        above = (height - len(block)) // 2
        width = max(map(len, block))
        empty = " " * width
        lines = [line.ljust(width) for line in block]
        padded.append([empty] * above + lines + [empty] * (height - above - len(block)))
    return "\n".join("".join(line).rstrip() for line in zip(*padded, strict=True))


def _matrix(cells: Sequence[Sequence[str]]) -> list[str]:
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    lines = []
    for row, (left, right) in zip(cells, brackets(len(cells), Charset.UNICODE), strict=True):
        body = "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        lines.append(f"{left} {body} {right}")
    return lines
