"""What a text holds: quantities as rows of number texts; and the errors of one that holds none."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError

ACCEPTED = 'write a matrix like "1 0 0; 0 2 0; 0 0 1"'
OF_A_QUATERNION = "nmatrix world --quaternion X Y Z W makes one of a quaternion"

SQUARES = {9: 3, 16: 4}  # flat lists that are square matrices
SIZES = (9, 12, 16)  # numbers of 3×3, 3×4 and 4×4
Tokens = Sequence[Sequence[str]]  # rows of numbers that are still text


@dataclass(frozen=True)
class Contents:
    """The quantities of a text, in its order; `layout` is None where the text does not say it.

    A text that is one nameless matrix has the single name "". `exact` is a text of nmatrix itself,
    whose floats are the very floats.
    """

    quantities: Mapping[str, Tokens]
    layout: Layout | None = None
    exact: bool = False

    @property
    def likely(self) -> Sequence[Tokens]:
        """The quantities that may be maps of space, or all if none of them may be one."""
        every = tuple(self.quantities.values())
        return tuple(one for one in every if sum(map(len, one)) in SIZES) or every


def unreadable(source: str, why: str, next_step: str = ACCEPTED) -> IllegalValueError:
    """Make the error of a text that is no matrix: where it came from, why, what to write."""
    return IllegalValueError(f"matrix ({source})", why, next_step)


def cut_off(source: str, where: str) -> IllegalValueError:
    """Make the error of a text that ends too early."""
    return unreadable(source, f"it breaks off {where}", "copy it whole")
