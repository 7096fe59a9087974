"""A hard case: an input, its exact answer, why it is hard, and the contestants that are judged."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from fractions import Fraction
from math import isfinite, pi

from nmatrix.errors import NMatrixError
from nmatrix.studies.hardcases.oracle import angle

Numbers = tuple[float, ...]
Compute = Callable[[], Sequence[float] | None]

RIGHT, IMPRECISE = 1e-14, 1e-6  # radians, or relative


class CaseVerdict(StrEnum):
    """The judgement of one contestant on one case."""

    RIGHT = "right"
    IMPRECISE = "imprecise"
    WRONG = "wrong"
    NAN = "nan"
    ZERO = "zero"
    FLIPPED = "flipped"
    NOT_REPORTED = "undefined-not-reported"


@dataclass(frozen=True)
class Contestant:
    """One way to answer: `compute` returns numbers, or None to say that there is no answer."""

    name: str
    compute: Compute
    is_ours: bool = False


@dataclass(frozen=True)
class Result:
    """One contestant's judgement; the error is in radians for directions, else relative."""

    method: str
    verdict: CaseVerdict
    error: float | None
    is_ours: bool


@dataclass(frozen=True)
class Case:
    """One row of the catalogue.

    Parameters
    ----------
    expected
        The exact answer, or None where there is none and that must be said.
    is_direction
        Only the direction of the answer counts, not its length.
    within
        What still counts as right, relative or in radians.
    """

    id: str
    title: str
    given: str
    expected: tuple[Fraction, ...] | None
    reason: str
    contestants: tuple[Contestant, ...]
    is_direction: bool = False
    within: float = RIGHT
    made_by: str = ""  # the options of a case that is not of the catalogue

    @property
    def replay(self) -> str:
        """The command that shows this case again."""
        return f"nmatrix stress {self.made_by}--case {self.id}"

    def results(self) -> tuple[Result, ...]:
        """Judge every contestant."""
        return tuple(self._judged(one) for one in self.contestants)

    def _judged(self, one: Contestant) -> Result:
        found = _tried(one)
        verdict, error = judge(
            found, self.expected, is_direction=self.is_direction, within=self.within
        )
        return Result(one.name, verdict, error, one.is_ours)


def judge(
    found: Numbers | None,
    expected: Sequence[Fraction] | None,
    *,
    is_direction: bool = False,
    within: float = RIGHT,
) -> tuple[CaseVerdict, float | None]:
    """Judge an answer against the exact one, and measure its error where it has one.

    None is the answer that there is none. Errors are in radians for directions, else relative to
    the largest number.

    Examples
    --------
    >>> judge((0.0, 2.0), exactly(1, 0), is_direction=True)[0].value
    'wrong'
    >>> judge((-1.0, 0.0), exactly(1, 0), is_direction=True)[0].value
    'flipped'
    """
    is_number = found is not None and all(map(isfinite, found))
    if expected is None:
        silent = CaseVerdict.NOT_REPORTED if is_number else CaseVerdict.NAN
        return (CaseVerdict.RIGHT if found is None else silent), None
    if found is None or not is_number:
        return CaseVerdict.NAN, None
    if any(expected) and not any(found):
        return CaseVerdict.ZERO, None
    exact = [Fraction(x) for x in found]
    error = angle(exact, expected) if is_direction else _relative(exact, expected)
    if is_direction and error > pi / 2:
        return CaseVerdict.FLIPPED, error
    judged = CaseVerdict.IMPRECISE if error <= IMPRECISE else CaseVerdict.WRONG
    return (CaseVerdict.RIGHT if error <= within else judged), error


def _relative(found: Sequence[Fraction], true: Sequence[Fraction]) -> float:
    size = max(abs(t) for t in true) or Fraction(1)
    error = max(abs(f - t) for f, t in zip(found, true, strict=True)) / size
    return float(min(error, Fraction(10) ** 300))


def _tried(one: Contestant) -> Numbers | None:
    """Let a contestant answer: an NMatrixError says that there is none, other errors are NaN."""
    import numpy as np

    with np.errstate(all="ignore"):
        try:
            found = one.compute()
        except NMatrixError:
            return None
        except (ArithmeticError, ValueError, np.linalg.LinAlgError):
            return (float("nan"),)
    return None if found is None else tuple(map(float, found))


def own(name: str, compute: Compute) -> Contestant:
    """Make a contestant of one of nmatrix's own ways."""
    return Contestant(name, compute, is_ours=True)


def spelled(rows: Iterable[Iterable[float]]) -> str:
    """Write a matrix as text that is read back to the very same floats.

    Examples
    --------
    >>> spelled([[0.1, 2.0], [5e-324, 0.0]])
    '0.1 2; 5e-324 0'
    """
    return "; ".join(" ".join(_digits(float(x)) for x in row) for row in rows)


def _digits(x: float) -> str:
    return str(int(x)) if x.is_integer() and abs(x) < 1e6 else repr(x)


def exactly(*values: float | str | Fraction) -> tuple[Fraction, ...]:
    """Return exact numbers: floats as they are, text as fractions.

    Examples
    --------
    >>> exactly(0.5, "1/3")
    (Fraction(1, 2), Fraction(1, 3))
    """
    return tuple(Fraction(value) for value in values)
