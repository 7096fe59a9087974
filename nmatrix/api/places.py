"""Parameters with leading axes: read, broadcast, and a matrix built for each place.

A builder knows one matrix; here it is called for every place of a batch, and what it refuses there
is told with the index.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from nmatrix.api import arrays
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.linear.angle import Angle
from nmatrix.linear.rounding import nearest
from nmatrix.reading.angles import with_its_unit

Array = NDArray[Any]
Turns = Any  # an Angle, radians, a text with its unit, or an array-like of these


@dataclass(frozen=True, eq=False)
class Parameter:
    """One parameter, read: an array of its own axes behind leading ones, and its float type."""

    name: str
    values: Array
    own: int
    kind: np.dtype[Any] | None = None

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
            f"{name} of shape {given.shape}", f"its shape must be ({wanted})", "give it so"
        )
    return Parameter(name, given, len(own), _float_type(values))


def _float_type(values: object) -> np.dtype[Any] | None:
    """Return the type of an array or a number of NumPy's; Python's own numbers have none."""
    is_typed = isinstance(values, np.ndarray | np.generic) and values.dtype.kind == "f"
    return arrays.native(np.asarray(values)) if is_typed else None


def _looked_at(values: object) -> Array:
    """Return values as an array of any type; ragged ones, which `real` refuses, as an empty one."""
    try:
        return np.asarray(values)
    except ValueError:
        return np.empty(0)


def distance(name: str, values: ArrayLike) -> Parameter:
    """Read distances, which may be infinite."""
    far = _looked_at(values)
    if far.dtype.kind != "f" or not np.isposinf(far).any():
        return real(name, values, ())
    finite = real(name, np.where(np.isposinf(far), 1.0, far), ())
    return replace(finite, values=far, kind=_float_type(values))


def turns(name: str, values: Turns, own: tuple[int, ...]) -> Parameter:
    """Read angles: radians, an `Angle`, a text with its unit, or lists of these."""
    shown = _looked_at(values)
    if shown.dtype.kind in "UO":
        shown = _with_texts_read(name, np.array(values, object))
    is_angle = np.zeros(shown.shape, bool)
    if shown.dtype == object:
        is_angle = np.array([isinstance(one, Angle) for one in shown.flat]).reshape(shown.shape)
    if not is_angle.any():
        return real(name, values, own)
    read = real(name, np.where(is_angle, 0.0, shown), own)
    return replace(read, values=np.where(is_angle, shown, read.values))


def _with_texts_read(name: str, given: Array) -> Array:
    """Make an `Angle` of each text."""
    for index, one in np.ndenumerate(given):
        if isinstance(one, str):
            given[index] = with_its_unit(one, arrays.named(name, index))
    return given


def each(build: Callable[..., Any], given: tuple[Parameter, ...]) -> Array:
    """Build one 4×4 matrix for each place that the parameters' leading axes broadcast to."""
    try:
        leading = np.broadcast_shapes(*(one.leading for one in given))
    except ValueError:
        shapes = ", ".join(f"{one.name} {one.leading}" for one in given if one.leading)
        raise IllegalValueError(
            f"leading axes of {shapes}",
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
