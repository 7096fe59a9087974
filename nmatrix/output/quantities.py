"""What in a report's data is a number, a vector or a matrix, and under which dotted key."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeGuard

from nmatrix.enums import Layout
from nmatrix.linear.rational import transpose
from nmatrix.report import Matrix, Number, Value, Vector

LARGEST_MATRIX = 4


def is_number(value: object) -> TypeGuard[Number]:
    """Say whether a value is a number; a bool is not.

    Examples
    --------
    >>> is_number(1), is_number(True)
    (True, False)
    """
    return isinstance(value, (int, float, Fraction)) and not isinstance(value, bool)


def is_list(value: object) -> TypeGuard[Sequence[Value]]:
    """Say whether a value is a sequence other than a string."""
    return isinstance(value, Sequence) and not isinstance(value, str)


def is_vector(value: object) -> TypeGuard[Vector]:
    """Say whether a value is a list of at least one number, and of nothing else."""
    return is_list(value) and len(value) > 0 and all(is_number(entry) for entry in value)


def is_matrix(value: object) -> TypeGuard[Matrix]:
    """Say whether a value is a matrix: 2 to 4 rows of equally many numbers, 1 to 4 of them.

    Examples
    --------
    >>> is_matrix(((1, 0), (0, 1))), is_matrix(((1, 0), (0,)))
    (True, False)
    """
    return (
        is_list(value)
        and 2 <= len(value) <= LARGEST_MATRIX
        and all(is_vector(row) for row in value)
        and len({len(row) for row in value if is_list(row)}) == 1
        and 1 <= len(value[0] if is_list(value[0]) else ()) <= LARGEST_MATRIX
    )


def arranged(matrix: Matrix, layout: Layout) -> Matrix:
    """Return the rows to write down, one after the other, for a layout."""
    return transpose(matrix) if layout is Layout.COLUMN_MAJOR else matrix


@dataclass(frozen=True)
class Leaf:
    """A value of the data that holds no keys of its own: a scalar, a vector or a matrix."""

    key: str
    value: bool | str | Number | Vector | Matrix | None


def leaves(data: Mapping[str, Value], prefix: str = "") -> Iterator[Leaf]:
    """Walk through the data in order; inner keys and positions are joined by dots.

    Examples
    --------
    >>> [leaf.key for leaf in leaves({"spaces": [{"eye": (0, 0, 5)}], "rank": 3})]
    ['spaces.0.eye', 'rank']
    """
    for name, value in data.items():
        yield from _leaves_of(f"{prefix}{name}", value)


def _leaves_of(key: str, value: Value) -> Iterator[Leaf]:
    if isinstance(value, Mapping):
        yield from leaves(value, f"{key}.")
    elif is_matrix(value) or is_vector(value):
        yield Leaf(key, value)
    elif is_list(value):
        yield from leaves({str(place): entry for place, entry in enumerate(value)}, f"{key}.")
    elif value is None or isinstance(value, (bool, str, int, float, Fraction)):
        yield Leaf(key, value)
