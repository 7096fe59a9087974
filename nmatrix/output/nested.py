"""Vectors and matrices as nested brackets, which JavaScript and Python write alike."""

from __future__ import annotations

from nmatrix.output.numbers import machine
from nmatrix.report import Matrix, Vector


def vector(entries: Vector) -> str:
    """Return a vector in square brackets.

    Examples
    --------
    >>> vector((1.0, 0.5))
    '[1.0, 0.5]'
    """
    return f"[{', '.join(machine(entry) or 'null' for entry in entries)}]"


def matrix(rows: Matrix) -> str:
    """Return a matrix as a list of rows, a row on each line.

    Examples
    --------
    >>> print(matrix(((1, 0), (0, 1))))
    [
      [1, 0],
      [0, 1],
    ]
    """
    return "[\n" + "".join(f"  {vector(row)},\n" for row in rows) + "]"


def flat(rows: Matrix) -> str:
    """Return the rows one after the other in a single list, a row on each line.

    Examples
    --------
    >>> print(flat(((1, 0), (0, 1))))
    [
      1, 0,
      0, 1,
    ]
    """
    return "[\n" + "".join(f"  {vector(row)[1:-1]},\n" for row in rows) + "]"
