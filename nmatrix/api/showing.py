"""Numbers as a report: an array has no notebook display of its own, and exact rows have none.

Values of the package show themselves; `show` does it for what NumPy and Python hold.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence, Set
from dataclasses import replace
from typing import Any

from nmatrix import report
from nmatrix.api.report import Report
from nmatrix.errors import IllegalValueError, counted
from nmatrix.linear.values import number, plain_value, refused, text
from nmatrix.reading.arrays import read_matrix
from nmatrix.report import (
    LARGEST_MATRIX,
    Block,
    Displayed,
    Matrix,
    Number,
    Quantity,
    Table,
    Text,
    Vector,
)

MOST = 24  # of many things: a notebook keeps what it shows


def show(value: object, name: str = "value") -> Report:
    """Show numbers as mathematics: an array, exact rows, a text in any notation.

    1/3 and √3/2 are told as such where a number is one: a float64 if it is the nearest to it.

    Parameters
    ----------
    value
        A number, a vector, a matrix of at most 8×8 entries; many of them, of which the first 24
        are shown; or a value that shows itself.
    name
        What stands before the sign of equality, and names the numbers in programs.

    Raises
    ------
    IllegalValueError
        For what holds no finite real numbers, or rows of unequal lengths.

    Examples
    --------
    >>> print(show([[0.5, 3**0.5 / 2], [1 / 3, 1]], "A"), end="")
    A
      ⎡ 1/2  √3/2 ⎤
      ⎣ 1/3     1 ⎦
    """
    if isinstance(value, Displayed):
        return Report(value._repr_report_())
    told = read_matrix(value, "value").rows_exact if isinstance(value, str) else value
    blocks = tuple(_blocks(told, "value", text(name, "name")))
    answer = report.Report.of_value(*blocks)
    match blocks:
        case (Quantity(key, numbers),):
            return Report(replace(answer, data={key: numbers}))
    return Report(answer)


def first_rows(columns: Sequence[str], rows: Sequence[Any], count: int) -> Iterator[Block]:
    """Show the first of many rows, and say how many more there are."""
    yield Table(tuple(columns), tuple(rows))
    if count > len(rows):
        yield Text(f"… and {counted(count - len(rows), 'more row')}")


def _blocks(value: object, place: str, name: str) -> Iterator[Block]:
    """Show a number, a vector or a matrix; of many the first ones, each under its index."""
    if isinstance(value, str) or not hasattr(value, "__len__") or getattr(value, "ndim", 1) == 0:
        yield _named(name, number(value, place))
        return
    entries: Any = value
    if isinstance(value, bytes | Mapping | Set) or not len(entries):
        raise refused(value, place, "it is no row of numbers", "give an array of numbers")
    first = [plain_value(one, place) for one in entries[:MOST]]
    depth = max(map(_depth, first))
    if min(map(_depth, first)) != depth:
        raise _ragged(value, place)
    if depth > 1:
        for i, one in enumerate(first):
            yield from _blocks(one, f"{place}[{i}]", f"{name}[{i}]")
        if len(entries) > MOST:
            yield Text(f"… and {len(entries) - MOST} more")
        return
    rows = [_numbers(one if depth else [one], f"{place}[{i}]") for i, one in enumerate(first)]
    wide = len(rows[0])
    if any(len(row) != wide for row in rows):
        raise _ragged(value, place)
    if not depth and len(entries) <= LARGEST_MATRIX:
        yield _named(name, tuple(row[0] for row in rows))
    elif max(len(entries), wide) <= LARGEST_MATRIX:
        yield _named(name, tuple(rows))
    else:
        columns = [name] if not depth else [f"{name}[{j}]" for j in range(wide)]
        yield from first_rows(columns, rows, len(entries))


def _named(name: str, value: Number | Vector | Matrix) -> Quantity:
    """Name a quantity as the caller does, unless documents have a letter for that word."""
    from nmatrix.output.symbols import letter

    is_key = name.isidentifier() and not letter(name)
    return Quantity(name, value) if is_key else Quantity("value", value, name)


def _ragged(value: object, place: str) -> IllegalValueError:
    return refused(value, place, "its rows have unequal lengths", "give rows of one length")


def _numbers(row: Any, place: str) -> tuple[Number, ...]:  # noqa: ANN401  # a list of anything
    return tuple(number(one, f"{place}[{j}]") for j, one in enumerate(row))


def _depth(value: object) -> int:
    if isinstance(value, list | tuple) and value:
        return 1 + max(map(_depth, value))
    return 0
