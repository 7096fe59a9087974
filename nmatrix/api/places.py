"""Parameters with leading axes: read, broadcast, and a matrix built for each place.

A builder knows one matrix; here it is called for every place of a batch, and what it refuses there
is told with the index.
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.api import arrays
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.linear.angle import Angle, as_angle
from nmatrix.linear.rounding import nearest

Array = NDArray[Any]
Turns = Any  # an Angle, radians, or an array-like of either


class Parameter:
    """One parameter, read: an array of its own axes behind leading ones, and its float type."""

    def __init__(self, values: Array, own: int, kind: np.dtype[Any] | None) -> None:
        self.values, self.own, self.kind = values, own, kind

    @property
    def leading(self) -> tuple[int, ...]:
        """The leading axes."""
        return self.values.shape[: self.values.ndim - self.own]

    def broadcast(self, leading: tuple[int, ...]) -> Array:
        """Repeat the parameter along leading axes."""
        return np.broadcast_to(self.values, leading + self.values.shape[len(self.leading) :])


def real(name: str, values: ArrayLike, own: tuple[int, ...]) -> Parameter:
    """Read numbers of so many own axes."""
    given = arrays.reals(values, name)
    if given.shape[given.ndim - len(own) :] != own or given.ndim < len(own):
        wanted = ", ".join(map(str, ("...", *own)))
        raise IllegalValueError(
            f"{name} of shape {given.shape}", f"its shape is ({wanted})", "reshape it"
        )
    is_typed = isinstance(values, np.ndarray | np.generic) and values.dtype.kind == "f"
    return Parameter(given, len(own), arrays.native(given) if is_typed else None)


def distance(name: str, values: ArrayLike) -> Parameter:
    """Read distances, which may be infinite."""
    try:
        far = np.asarray(values)
    except ValueError:  # ragged: to be refused below
        far = np.empty(0)
    if far.dtype.kind != "f" or not np.isposinf(far).any():
        return real(name, values, ())
    found = real(name, np.where(np.isposinf(far), 1.0, far), ())
    found.values = far
    return found


def turns(name: str, values: Turns, own: tuple[int, ...], *, whole: bool = False) -> Parameter:
    """Read angles: `Angle` or radians, and lists of either; `whole` leaves radians as they are."""
    if isinstance(values, Angle):
        values = [values]
        found = _mixed(name, values)[0:1].reshape(())
    elif isinstance(values, list | tuple) and any(isinstance(one, Angle) for one in values):
        found = _mixed(name, values)
    else:
        read = real(name, values, own)
        if whole:
            return read
        turned = np.empty(read.values.shape, object)
        for index in np.ndindex(turned.shape):
            turned[index] = Angle.radians(float(read.values[index]))
        return Parameter(turned, len(own), read.kind)
    if found.shape[found.ndim - len(own) :] != own:
        raise IllegalValueError(
            f"{name} of {found.size} angles", f"it takes {own[0] if own else 1}", "give as many"
        )
    return Parameter(found, len(own), None)


def _mixed(name: str, values: list[Any] | tuple[Any, ...]) -> Array:
    found = np.empty(len(values), object)
    for i, one in enumerate(values):
        found[i] = (
            one if isinstance(one, Angle) else as_angle(float(arrays.reals(one, f"{name}[{i}]")))
        )
    return found


def each(build: Callable[..., Any], given: tuple[Parameter, ...]) -> Array:
    """Build one 4×4 matrix for each place that the parameters' leading axes broadcast to."""
    try:
        leading = np.broadcast_shapes(*(one.leading for one in given))
    except ValueError:
        shapes = ", ".join(str(one.leading) for one in given)
        raise IllegalValueError(
            f"leading axes {shapes}",
            "they do not broadcast",
            "give one of them an axis of length 1",
        ) from None
    kinds = [one.kind for one in given if one.kind is not None]
    found = np.empty((*leading, 4, 4), np.result_type(*kinds) if kinds else np.float64)
    parts = [one.broadcast(leading) for one in given]
    for index in np.ndindex(leading):
        at = [part[index] for part in parts]
        plain = [one.tolist() if isinstance(one, np.ndarray | np.generic) else one for one in at]
        try:
            exact = build(*plain)
        except NMatrixError as error:
            if not index:
                raise
            what, why, next_step = error.parts
            raise type(error)(f"{list(index)}: {what}", why, next_step) from None
        with np.errstate(over="ignore"):
            found[index] = [[nearest(Fraction(x)) for x in row] for row in exact]
    if not np.isfinite(found).all():
        raise IllegalValueError(
            f"an entry beyond the largest {found.dtype}",
            "no number of that type holds it",
            "give float64",
        )
    return found
