"""A function of the calculator: its parameters, its computation, and the words that explain it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.calculator.values import Value, ValueKind
from nmatrix.errors import IllegalValueError, did_you_mean

if TYPE_CHECKING:
    from nmatrix.working.working import Working

Argument = Value | str  # a word such as "ZYX" is passed as it is
_WORDS = {
    ValueKind.SCALAR: "a number",
    ValueKind.VECTOR: "a vector",
    ValueKind.MATRIX: "a matrix",
}


@dataclass(frozen=True)
class Parameter:
    """A named argument: the kinds of value that it takes, or words, and what it is if left out."""

    name: str
    kinds: tuple[ValueKind, ...] = ()
    default: Argument | None = None
    is_optional: bool = False
    words: str = ""
    is_angle: bool = False

    @property
    def wanted(self) -> str:
        """What it takes, in words."""
        return self.words or " or ".join(_WORDS[kind] for kind in self.kinds)

    def takes(self, argument: Argument) -> bool:
        """Tell whether an argument is of its kinds; what takes none of them takes a word."""
        if isinstance(argument, str):
            return not self.kinds
        return argument.kind in self.kinds


@dataclass(frozen=True)
class Function:
    """One function.

    Parameters
    ----------
    parameters
        In the order in which they are written; each may be given by its name.
    does
        What it computes, in a sentence of the kind that help prints.
    rule
        Why its result is what it is, as a student would quote it beside a step.
    formula
        The formula, as one types mathematics.
    example
        An expression that runs as it stands.
    compute
        From the arguments to the value; raises `IllegalValueError` and `NoAnswerError`.
    working
        The steps by hand, where there is more than one.
    gathers
        Three numbers may stand for the one vector.
    """

    parameters: tuple[Parameter, ...]
    does: str
    rule: str
    formula: str
    example: str
    compute: Callable[..., Value]
    working: Callable[..., Working] | None = None
    gathers: bool = False

    def usage(self, name: str) -> str:
        """Write how it is called: normalize(v)."""
        shown = [
            one.name if one.default is None and not one.is_optional else f"{one.name}=…"
            for one in self.parameters
        ]
        return f"{name}({', '.join(shown)})"

    def bound(
        self, arguments: Sequence[Argument], named: Mapping[str, Argument]
    ) -> tuple[Argument | None, ...]:
        """Give every parameter its argument.

        Raises
        ------
        IllegalValueError
            If there are too many or too few, or one is of another kind; it names what is wanted.
        """
        if self.gathers and not named and len(arguments) == 3:
            arguments = [_gathered(arguments)]
        if len(arguments) > len(self.parameters):
            raise self._refusal(arguments)
        found: dict[str, Argument] = {}
        for parameter, argument in zip(self.parameters, arguments, strict=False):
            found[parameter.name] = argument
        for name, argument in named.items():
            known = [one.name for one in self.parameters]
            if name not in known:
                step = did_you_mean(name, known, f"it takes {', '.join(known)}")
                raise IllegalValueError(f"{name}=", "there is no such argument", step)
            if name in found:
                raise IllegalValueError(f"{name}=", "it is given twice", "leave one out")
            found[name] = argument
        bound = []
        for parameter in self.parameters:
            given = found.get(parameter.name, parameter.default)
            if given is None and not parameter.is_optional:
                raise self._refusal(arguments)
            if given is not None and not parameter.takes(given):
                raise self._refusal(arguments, parameter, given)
            bound.append(given)
        return tuple(bound)

    def _refusal(
        self,
        arguments: Sequence[Argument],
        parameter: Parameter | None = None,
        given: Argument | None = None,
    ) -> IllegalValueError:
        if parameter is not None and given is not None and len(self.parameters) > 1:
            what = f"{parameter.name} takes {parameter.wanted}, got {_shape(given)}"
        else:
            wanted = " and ".join(one.wanted for one in self.parameters if not one.is_optional)
            wanted = "three numbers or a vector" if self.gathers else wanted or "nothing"
            what = f"it takes {wanted}, got {' and '.join(map(_shape, arguments[:4])) or 'nothing'}"
        return IllegalValueError(what, "", f"write {self.example}")


def _shape(argument: Argument) -> str:
    return f'"{argument[:20]}"' if isinstance(argument, str) else argument.shape


def _gathered(arguments: Sequence[Argument]) -> Argument:
    """Make one vector of three numbers."""
    entries = []
    for one in arguments:
        if isinstance(one, str) or one.kind is not ValueKind.SCALAR:
            return Value(Fraction(0))  # which is no vector, and is refused as that
        entries.append(one.scalar)
    return Value(tuple(entries))


def matrix(name: str = "A") -> Parameter:
    """Declare a matrix."""
    return Parameter(name, (ValueKind.MATRIX,))


def vector(name: str = "v") -> Parameter:
    """Declare a vector."""
    return Parameter(name, (ValueKind.VECTOR,))


def scalar(name: str = "x", default: Value | None = None) -> Parameter:
    """Declare a number."""
    return Parameter(name, (ValueKind.SCALAR,), default)


def turn(name: str = "angle", default: Value | None = None) -> Parameter:
    """Declare an angle, in degrees."""
    return Parameter(name, (ValueKind.SCALAR,), default, is_angle=True)


def require_size(value: Value, size: int, what: str) -> None:
    """Refuse a vector or a matrix of another length."""
    if len(value.entries) != size:  # type: ignore[arg-type]  # a vector or a matrix has a length
        raise IllegalValueError(value.shape, f"{what} is needed", "check its size")


def require_square(A: Value) -> None:
    """Refuse a matrix that is not square."""
    if len(A.matrix) != len(A.matrix[0]):
        raise IllegalValueError(A.shape, "a square matrix is needed", "use 2×2, 3×3 or 4×4")
