"""Array-likes in, arrays of finite floats out: every function on arrays reads its input here.

Numbers are taken exactly: float16, float32 and float64 in any byte order and memory layout as they
are, everything else as float64, if that holds every number exactly. Nothing is rounded in silence.
"""

from __future__ import annotations

from collections.abc import Iterator
from decimal import Decimal
from itertools import product
from math import inf, isfinite
from numbers import Integral, Real
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, DTypeLike, NDArray

from nmatrix.errors import IllegalValueError

Array = NDArray[Any]
Index = tuple[int, ...]

FEW = 90  # numbers that Python looks at before NumPy has begun


def reals(values: ArrayLike, parameter: str) -> Array:
    """Read an array of finite floats of any shape.

    Raises
    ------
    IllegalValueError
        For complex, masked and ragged arrays, text and other objects, for a number that is not
        finite, and for an integer that no float64 holds; it names the parameter and the entry.

    Examples
    --------
    >>> reals([[1, 2]], "A").dtype, reals(np.ones(3, np.float16), "n").dtype
    (dtype('float64'), dtype('float16'))
    """
    if isinstance(values, np.ma.MaskedArray):
        raise IllegalValueError(
            f"{parameter}, a masked array", "a masked entry has no value", "fill it: .filled(0.0)"
        )
    try:
        given = np.asarray(values)
    except (TypeError, ValueError, RuntimeError):
        raise IllegalValueError(
            f"{parameter}, a {type(values).__name__}",
            "it must be an array of real numbers, all rows of one shape",
            "give an array of real numbers",
        ) from None
    if given.dtype.kind == "f" and given.dtype.itemsize <= 8:
        return _finite(given, parameter)
    if given.dtype.kind in "biufO":
        return _exactly(_finite(given, parameter) if given.dtype.kind == "f" else given, parameter)
    what = "text" if given.dtype.kind in "US" else str(given.dtype)
    raise IllegalValueError(
        f"{parameter} of {what}", "its entries must be real numbers", "give real numbers"
    )


def _exactly(given: Array, parameter: str) -> Array:
    """Turn numbers of any real type into float64, fractions into the nearest one.

    An integer counts something or names something: one that would be rounded is refused.
    """
    if given.dtype.kind in "biu" and not (np.abs(given.astype(np.float64)) >= 2.0**53).any():
        return given.astype(np.float64)
    found = np.empty(given.shape)
    for index, number in np.ndenumerate(given.astype(object)):
        if not isinstance(number, Real | Decimal):
            raise IllegalValueError(
                f"{named(parameter, index)} ({type(number).__name__})",
                "it is not a real number",
                "give an array of real numbers",
            )
        try:
            value = float(number)
        except (ArithmeticError, ValueError):
            value = inf
        if isinstance(number, Integral) and value != number:
            raise IllegalValueError(
                f"{named(parameter, index)} (an integer of {len(str(abs(number)))} digits)",
                "no float64 is exactly that number",
                "give a float",
            )
        found[index] = value
    return _finite(found, parameter)


def _finite(given: Array, parameter: str) -> Array:
    """Check that every number is finite: the least and the largest are, and nothing is copied."""
    if given.size > FEW:
        is_finite = isfinite(given.min()) and isfinite(given.max())
    else:
        is_finite = all(map(isfinite, given.ravel().tolist()))
    if not is_finite:
        index = tuple(np.argwhere(~np.isfinite(given))[0].tolist())
        raise IllegalValueError(
            f"{named(parameter, index)} ({given[index]})",
            "it is not a finite number",
            "use finite numbers",
        )
    return given


def matrices(values: ArrayLike, parameter: str) -> Array:
    """Read linear maps (..., 3, 3) or affine maps (..., 4, 4), whose last row is 0 0 0 1.

    Examples
    --------
    >>> matrices(np.eye(4), "A").shape
    (4, 4)
    """
    given = reals(values, parameter)
    if given.shape[-2:] not in ((3, 3), (4, 4)):
        raise _shaped(given, parameter, "(..., 3, 3) or (..., 4, 4)")
    if given.shape[-1] == 4:
        projective = np.argwhere((given[..., 3, :] != (0, 0, 0, 1)).any(axis=-1))
        if len(projective):
            index = tuple(projective[0].tolist())
            row = " ".join(f"{x:g}" for x in given[index][3].tolist())
            raise IllegalValueError(
                f"{named(parameter, index)} with last row ({row})",
                "the last row of an affine map of column vectors is 0 0 0 1",
                "transpose it, or leave the projection out",
            )
    return given


def vectors(values: ArrayLike, parameter: str) -> Array:
    """Read vectors (..., 3).

    Examples
    --------
    >>> vectors([1, 2, 3], "n").tolist()
    [1.0, 2.0, 3.0]
    """
    given = reals(values, parameter)
    if given.shape[-1:] != (3,):
        raise _shaped(given, parameter, "(..., 3)")
    return given


def _shaped(given: Array, parameter: str, wanted: str) -> IllegalValueError:
    return IllegalValueError(
        f"{parameter} of shape {given.shape}", f"its shape is {wanted}", "reshape it"
    )


def native(given: Array) -> np.dtype[Any]:
    """Return the float type of an array in the byte order of this machine."""
    return given.dtype.newbyteorder("=")


def room(out: Array | None, shape: tuple[int, ...], dtype: DTypeLike) -> Array:
    """Return where a result is written: a new array, or `out` if the result fits there.

    Examples
    --------
    >>> room(None, (2, 3), np.float32).shape
    (2, 3)
    """
    if out is None:
        return np.empty(shape, dtype)
    if not isinstance(out, np.ndarray) or isinstance(out, np.ma.MaskedArray):
        what = f", a {type(out).__name__},"
    elif out.shape != shape or out.dtype.kind != "f":
        what = f" of shape {out.shape} and type {out.dtype}"
    elif not out.flags.writeable:
        what = ", a read-only array,"
    else:
        return out
    raise IllegalValueError(
        f"out{what}", f"the result is a float array of shape {shape}", "leave it out"
    )


def apart(given: Array, out: Array) -> Array:
    """Copy an input that shares memory with the output, unless they are the very same places.

    Examples
    --------
    >>> a = np.zeros(3)
    >>> apart(a, a) is a, apart(a, a[::-1]) is a
    (True, False)
    """
    if not np.may_share_memory(given, out):
        return given
    is_same = (given.ctypes.data, given.shape, given.strides, given.dtype) == (
        out.ctypes.data,
        out.shape,
        out.strides,
        out.dtype,
    )
    return given if is_same else given.copy()


def lines(shape: tuple[int, ...]) -> Iterator[tuple[int | slice, ...]]:
    """Index a batch of any shape line by line, along its longest axis.

    Examples
    --------
    >>> list(lines((2, 9)))
    [(0, slice(None, None, None)), (1, slice(None, None, None))]
    """
    if 0 in shape:
        return
    axis = shape.index(max(shape))
    for rest in product(*map(range, shape[:axis] + shape[axis + 1 :])):
        yield (*rest[:axis], slice(None), *rest[axis:])


def place(line: tuple[int | slice, ...], position: int) -> Index:
    """Return the index of one element of a line."""
    return tuple(position if isinstance(part, slice) else part for part in line)


def named(parameter: str, index: Index) -> str:
    """Name one element of a parameter in an error.

    Examples
    --------
    >>> named("A", (2, 0)), named("A", ())
    ('A[2, 0]', 'A')
    """
    return f"{parameter}[{', '.join(map(str, index))}]" if index else parameter
