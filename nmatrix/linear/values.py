"""Numbers and vectors that Python callers give, as exact numbers; all else is refused by name.

Anything array-like will do: its `tolist` makes Python numbers of it, so NumPy need not be there.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from decimal import Decimal
from fractions import Fraction
from math import isfinite
from numbers import Rational, Real
from os import PathLike, fsencode, fspath
from pathlib import Path
from types import MappingProxyType
from typing import Any, TypeVar

from nmatrix.errors import LONGEST_QUOTE, IllegalValueError, quantity
from nmatrix.report import Number, Vector

WHOLE = "the matrix is the whole answer"
NO_NAMES: Mapping[str, str] = MappingProxyType({})

Frozen = TypeVar("Frozen")
Reader = Callable[[Any, str], object]  # of a value, under the name that an error speaks of


def number(value: object, name: str) -> Number:
    """Return a finite real number as the int, float or fraction that it is.

    Raises
    ------
    IllegalValueError
        For anything else; it says what came.

    Examples
    --------
    >>> number(2, "near"), number(Decimal("0.1"), "near")
    (2, Fraction(1, 10))
    """
    plain = plain_value(value, name)
    if isinstance(plain, float) and isfinite(plain):
        return float(plain)
    if isinstance(plain, int) and not isinstance(plain, bool):
        return int(plain)
    if isinstance(plain, Rational) and not isinstance(plain, bool):
        return Fraction(plain)
    if isinstance(plain, Decimal) and plain.is_finite():
        return Fraction(plain)
    if isinstance(plain, Real) and not isinstance(plain, bool) and isfinite(plain):
        return Fraction(*plain.as_integer_ratio())  # type: ignore[attr-defined]  # a longer float
    raise refused(value, name, "it is not a finite real number", "give a number")


def real(value: object, name: str) -> float:
    """Return the float64 nearest to a number.

    Raises
    ------
    IllegalValueError
        Also for a number beyond the largest float64.
    """
    try:
        return float(number(value, name))
    except OverflowError:
        raise refused(value, name, "no float64 is as large", "give a smaller number") from None


def whole(value: object, name: str) -> int:
    """Return a whole number."""
    found = number(value, name)
    if found != int(found):
        raise refused(value, name, "it is not a whole number", "give a whole number")
    return int(found)


def vector(values: object, name: str, size: int = 3) -> Vector:
    """Return so many numbers from any array-like of one axis.

    Examples
    --------
    >>> vector([1, 2.5, 3], "scale")
    (1, 2.5, 3)
    """
    if type(values) is tuple and len(values) == size and all(map(_is_number, values)):
        return values  # read before: most values are made from others
    entries = listed(values, name, (size,))
    return tuple(number(one, f"{name}[{i}]") for i, one in enumerate(entries))


def _is_number(value: object) -> bool:
    return type(value) in (int, Fraction) or (type(value) is float and isfinite(value))


def listed(values: object, name: str, sizes: tuple[int, ...]) -> list[object]:
    """Return the entries of an array-like of one axis, as many as one of the sizes.

    Raises
    ------
    IllegalValueError
        For anything else, and for another number of entries.
    """
    plain = plain_value(values, name)
    wanted = " or ".join(map(str, sizes))
    if not isinstance(plain, list | tuple):
        raise refused(values, name, "it is not a list of numbers", f"give {wanted} numbers")
    if len(plain) not in sizes:
        raise refused(values, name, f"it has {len(plain)} entries", f"give {wanted} numbers")
    return list(plain)


def plain_value(value: object, name: str) -> object:
    """Return an array as lists, a scalar of an array as a number, everything else as it is."""
    if hasattr(value, "mask"):
        raise refused(value, name, "a masked entry has no value", "fill it: .filled(0.0)")
    if getattr(getattr(value, "dtype", None), "names", None):
        raise refused(value, name, "a structured array has fields, no rows", "give one field of it")
    return value.tolist() if hasattr(value, "tolist") else value


def flag(value: object, name: str) -> bool:
    """Return True or False."""
    plain = plain_value(value, name)
    if isinstance(plain, bool):
        return plain
    raise refused(value, name, "it is neither True nor False", "give one of them")


def text(value: object, name: str) -> str:
    """Return a text."""
    if isinstance(value, str):
        return value
    raise refused(value, name, "it is not text", "put it in quotes")


def named_file(value: object, name: str) -> Path:
    """Return the path that a text or a path names."""
    if isinstance(value, str | PathLike):
        named = fspath(value)
        if isinstance(named, str) and "\0" not in named and _is_encodable(named):
            return Path(named)
    raise refused(value, name, "it is not the name of a file", "give text or a path")


def _is_encodable(name: str) -> bool:
    try:
        fsencode(name)
    except UnicodeError:  # half of a surrogate pair
        return False
    return True


def read_fields(value: object, **readers: Reader) -> None:
    """Read fields of a frozen value while it is made, each by its reader.

    None stays None where that is the default.

    Examples
    --------
    >>> from types import SimpleNamespace
    >>> given = SimpleNamespace(near=Decimal("0.5"), up=None)
    >>> read_fields(given, near=real, up=vector)
    >>> given
    namespace(near=0.5, up=None)
    """
    for field, read in readers.items():
        given = getattr(value, field)
        if given is not None or getattr(type(value), field, None) is not None:
            object.__setattr__(value, field, read(given, field))


def with_fields(value: Frozen, **changes: object) -> Frozen:
    """Copy a frozen value with other fields that were read already: nothing is checked again.

    Examples
    --------
    >>> from nmatrix.linear.projection import Window
    >>> with_fields(Window(-1, 1, -1, 1), top=2).top
    2
    """
    copy = object.__new__(type(value))
    known = value.__dict__
    names = type(value).__dataclass_fields__  # type: ignore[attr-defined]  # a frozen dataclass
    copy.__dict__.update({name: known[name] for name in names}, **changes)
    return copy


def named(name: str, read: Reader) -> Reader:
    """Make a reader whose errors speak of another name than the field's."""
    return lambda given, _: read(given, name)


def refuse_beside(
    value: object,
    field: str,
    parts: Iterable[str],
    because: str = WHOLE,
    *,
    names: Mapping[str, str] = NO_NAMES,
) -> None:
    """Refuse a field of a frozen value beside parts that it takes the place of.

    A part at its default was not given. `names` are what errors call fields, where that differs.
    """
    if getattr(value, field) is None:
        return
    usual = type(value)
    beside = [part for part in parts if getattr(value, part) != getattr(usual, part)]
    if beside:
        called = [names.get(one, one) for one in (field, *beside)]
        raise contradiction(quantity(called[0]), called[1:], because)


def contradiction(what: str, beside: Iterable[str], because: str) -> IllegalValueError:
    """Make the error for two things of which only one can be said."""
    together = f"{what} with {', '.join(map(quantity, beside))}"
    return IllegalValueError(together, because, "keep one of them")


def refused(value: object, name: str, why: str, next_step: str) -> IllegalValueError:
    """Make the error for a value that a parameter cannot take; `name` may end in an index."""
    try:
        shown = " ".join(repr(value).split())
    except Exception:  # too many digits, too deep, or a class's own fault
        shown = type(value).__name__
    short = shown if len(shown) <= LONGEST_QUOTE else f"{shown[: LONGEST_QUOTE - 1]}…"
    return IllegalValueError(f"{marked(name)} ({short})", why, next_step)


def marked(name: str) -> str:
    """Mark a name that may end in an index as that of a quantity."""
    head, bracket, place = name.partition("[")
    return f"{quantity(head)}{bracket}{place}"
