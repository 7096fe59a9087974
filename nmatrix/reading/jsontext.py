"""Matrices in a JSON object: every list of numbers under its dotted key, digits kept as typed."""

from __future__ import annotations

import json
from collections.abc import Iterator
from functools import partial

from nmatrix.enums import Layout
from nmatrix.errors import quoted
from nmatrix.reading.contents import Contents, Tokens, cut_off, unreadable

DEEPEST = 12  # levels of objects and lists that are looked into

_unreadable = partial(unreadable, next_step='write {"world_from_object": [[…], …]} or pipe -f json')


class _Digits(str):
    """A JSON number as its own characters, so that nothing is rounded before the contract says."""

    __slots__ = ()


def json_notation(text: str, source: str) -> Contents:
    """Read the matrices and vectors of a JSON object or a part of one, and the layout it states.

    Raises
    ------
    IllegalValueError
        If the text is not JSON, or nests deeper than any report.

    Examples
    --------
    >>> json_notation('{"layout": "column-major", "a": [[1, 2.50]]}', "x").quantities
    {'a': [['1', '2.50']]}
    """
    is_part = text.startswith('"')
    whole = f"{{{text.rstrip(', ')}}}" if is_part else text
    try:
        found = json.loads(whole, parse_int=_Digits, parse_float=_Digits, parse_constant=_Digits)
    except RecursionError:
        raise _unreadable(source, "it nests too deeply") from None
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno - (is_part and error.lineno == 1)}"
        if error.pos >= len(whole) - is_part or error.msg.startswith("Unterminated"):
            raise cut_off(source, f"at {place}") from None
        raise _unreadable(source, f"not JSON at {place}: {error.msg}") from None
    if not isinstance(found, dict):
        raise _unreadable(source, "it is not a JSON object")
    ours = "command" in found and "version" in found
    return Contents(dict(_matrices(found, "", 0)), _layout(found.get("layout"), source), ours)


def _layout(stated: object, source: str) -> Layout | None:
    if stated is None:
        return None
    if stated not in tuple(Layout):
        shown = quoted(str(stated))
        raise _unreadable(source, f"its layout is {shown}, neither row-major nor column-major")
    return Layout(str(stated))


def _matrices(value: object, key: str, depth: int) -> Iterator[tuple[str, Tokens]]:
    if depth > DEEPEST:
        return
    if isinstance(value, dict):
        items = list(value.items())
    elif isinstance(value, list):
        tokens = _tokens(value)
        if tokens is not None:
            yield key, tokens
            return
        # A broken matrix is not taken apart: its sound rows are nobody's answer.
        items = [(place, inner) for place, inner in enumerate(value) if _is_record(inner)]
    else:
        return
    for name, inner in items:
        yield from _matrices(inner, f"{key}.{name}" if key else str(name), depth + 1)


def _tokens(value: list[object]) -> Tokens | None:
    """Return a list of numbers as one row, a list of such lists as rows, anything else as None."""
    if _is_row(value):
        return [[str(entry) for entry in value]]
    if value and all(isinstance(row, list) and _is_row(row) for row in value):
        return [[str(entry) for entry in row] for row in value if isinstance(row, list)]
    return None


def _is_record(value: object) -> bool:
    """Recognise an entry that can hold matrices of its own: an object, or a list of lists."""
    return isinstance(value, dict) or (
        isinstance(value, list) and all(isinstance(row, list) for row in value)
    )


def _is_row(value: list[object]) -> bool:
    return bool(value) and all(isinstance(entry, _Digits) for entry in value)
