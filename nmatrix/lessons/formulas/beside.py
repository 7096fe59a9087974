"""A formula in characters: matrices over several lines, beside each other."""

from __future__ import annotations


def matrix(cells: list[list[str]]) -> list[str]:
    """Return the lines of a matrix in tall brackets."""
    widths = [max(map(len, column)) for column in zip(*cells, strict=True)]
    last = len(cells) - 1
    lines = []
    for i, row in enumerate(cells):
        left, right = "[]" if last == 0 else ("⎡⎤" if i == 0 else "⎣⎦" if i == last else "⎢⎥")
        body = "  ".join(cell.rjust(width) for cell, width in zip(row, widths, strict=True))
        lines.append(f"{left} {body} {right}")
    return lines


def side_by_side(blocks: list[list[str]]) -> str:
    """Return blocks of lines beside each other, each in the middle of the tallest."""
    height = max(map(len, blocks))
    padded = []
    for block in blocks:
        above = (height - len(block)) // 2
        width = max(map(len, block))
        empty = " " * width
        lines = [line.ljust(width) for line in block]
        padded.append([empty] * above + lines + [empty] * (height - above - len(block)))
    return "\n".join("".join(line).rstrip() for line in zip(*padded, strict=True))
