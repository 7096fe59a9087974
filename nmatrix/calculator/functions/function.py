"""A function of the calculator: its parameters, its computation, and the words that explain it."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING

from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.errors import IllegalValueError, NoAnswerError, did_you_mean

if TYPE_CHECKING:
    from nmatrix.working.working import Working

Argument = Value | str  # a word such as "ZYX" is passed as it is
_WORDS = {
    ValueKind.SCALAR: "a number",
    ValueKind.VECTOR: "a vector",
    ValueKind.MATRIX: "a matrix",
}
NUMERALS = ("no", "one", "two", "three", "four", "five", "six", "seven", "eight")
THREE, FOUR = range(3, 4), range(4, 5)


class ArgumentError(IllegalValueError):
    """A fault of one argument, which knows the argument."""

    def __init__(self, given: Argument, what: str, why: str, next_step: str) -> None:
        super().__init__(what, why, next_step)
        self.given = given


class NoAnswerForArgumentError(NoAnswerError):
    """A sound argument for which the function has no answer, which knows the argument."""

    def __init__(self, given: Argument, what: str, why: str, next_step: str) -> None:
        super().__init__(what, why, next_step)
        self.given = given


@dataclass(frozen=True)
class Parameter:
    """A named argument: the kinds of value and the words that it takes.

    If it is left out it is `default`, or the value of the name that it `stands_for`.
    """

    name: str
    kinds: tuple[ValueKind, ...] = ()
    default: Argument | None = None
    is_optional: bool = False
    words: str = ""
    is_angle: bool = False
    choices: tuple[str, ...] = ()
    stands_for: str = ""

    @property
    def wanted(self) -> str:
        """What it takes, in words."""
        named = [_WORDS[kind] for kind in self.kinds] + [f'"{word}"' for word in self.choices]
        return self.words or " or ".join(named)

    @property
    def may_be_left_out(self) -> bool:
        """Whether it need not be written."""
        return self.is_optional or self.default is not None or bool(self.stands_for)

    def takes(self, argument: Argument) -> bool:
        """Tell whether an argument is of its kinds, or one of its words."""
        if isinstance(argument, str):
            return argument in self.choices or not (self.kinds or self.choices)
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
    result
        What the example is equal to, as an expression.
    compute
        From the arguments to the value; raises `IllegalValueError` and `NoAnswerError`.
    working
        The steps by hand, where there is more than one.
    remarks
        What is to be said of a result beside its value.
    gathers
        So many numbers may stand for the one vector.
    """

    parameters: tuple[Parameter, ...]
    does: str
    rule: str
    formula: str
    example: str
    result: str
    compute: Callable[..., Value]
    working: Callable[..., Working] | None = None
    remarks: Callable[..., Iterable[str]] | None = None
    gathers: range = range(0)

    def usage(self, name: str) -> str:
        """Write how it is called: normalize(v)."""
        shown = [f"{one.name}=…" if one.may_be_left_out else one.name for one in self.parameters]
        return f"{name}({', '.join(shown)})"

    def bound(
        self,
        arguments: Sequence[Argument],
        named: Mapping[str, Argument],
        names: Mapping[str, Value] | None = None,
    ) -> tuple[Argument | None, ...]:
        """Give every parameter its argument; `names` has those that parameters stand for.

        Raises
        ------
        IllegalValueError
            If there are too many or too few, or one is of another kind; it names what is wanted.
        """
        if len(arguments) in self.gathers and not named and all(map(_is_number, arguments)):
            arguments = [_gathered(arguments)]
        if len(arguments) > len(self.parameters):
            raise self._refusal(arguments)
        found = dict(zip((one.name for one in self.parameters), arguments, strict=False))
        for name, argument in named.items():
            self._check_named(name, argument, found)
            found[name] = argument
        bound = []
        for parameter in self.parameters:
            given = found.get(parameter.name, parameter.default)
            if given is None and names is not None and parameter.stands_for:
                given = names.get(parameter.stands_for)
            if given is None and not parameter.may_be_left_out:
                raise self._refusal(arguments)
            if given is not None and not parameter.takes(given):
                raise self._refusal_of(parameter, given)
            bound.append(given)
        return tuple(bound)

    def _check_named(self, name: str, argument: Argument, found: Mapping[str, Argument]) -> None:
        known = [one.name for one in self.parameters]
        if name not in known:
            step = did_you_mean(name, known, f"it takes {', '.join(known)}")
            raise ArgumentError(argument, f"{name}=", "there is no such argument", step)
        if name in found:
            raise ArgumentError(argument, f"{name}=", "it is given twice", "leave one out")

    def _refusal(self, arguments: Sequence[Argument]) -> IllegalValueError:
        wanted = " and ".join(one.wanted for one in self.parameters if not one.may_be_left_out)
        got = " and ".join(map(_shape, arguments[:4])) or "nothing"
        what = f"it takes {self._gathered_or(wanted) or 'nothing'}, got {got}"
        return IllegalValueError(what, "", f"write {self.example}")

    def _refusal_of(self, parameter: Parameter, given: Argument) -> ArgumentError:
        is_alone = len(self.parameters) == 1
        wanted = self._gathered_or(parameter.wanted) if is_alone else parameter.wanted
        what = f"{'it' if is_alone else parameter.name} takes {wanted}, got {_shape(given)}"
        step = f"write {self.example}"
        if isinstance(given, str):
            step = did_you_mean(given, parameter.choices, step)
        return ArgumentError(given, what, "", step)

    def _gathered_or(self, wanted: str) -> str:
        """Tell the numbers that may stand for a vector, before what else is taken."""
        if not self.gathers:
            return wanted
        exactly = len(self.gathers) == 1
        return f"{NUMERALS[self.gathers.start] if exactly else 'some'} numbers or {wanted}"


def _shape(argument: Argument) -> str:
    return f'"{argument[:20]}"' if isinstance(argument, str) else argument.shape


def _is_number(argument: Argument) -> bool:
    return isinstance(argument, Value) and argument.kind is ValueKind.SCALAR


def _gathered(arguments: Sequence[Argument]) -> Value:
    """Make one vector of some numbers."""
    return Value(tuple(one.scalar for one in arguments if isinstance(one, Value)))


def matrix(name: str = "A") -> Parameter:
    """Declare a matrix."""
    return Parameter(name, (ValueKind.MATRIX,))


def vector(name: str = "v", default: Value | None = None) -> Parameter:
    """Declare a vector."""
    return Parameter(name, (ValueKind.VECTOR,), default)


def scalar(name: str = "x", default: Value | None = None) -> Parameter:
    """Declare a number."""
    return Parameter(name, (ValueKind.SCALAR,), default)


def turn(name: str = "angle", default: Value | None = None) -> Parameter:
    """Declare an angle, in degrees."""
    return Parameter(name, (ValueKind.SCALAR,), default, is_angle=True)


def word(name: str, *choices: str, default: str | None = None) -> Parameter:
    """Declare a word, one of some."""
    return Parameter(name, default=default, is_optional=default is None, choices=choices)


def whole(value: Value, most: int, what: str, least: int | None = None) -> int:
    """Read a whole number of a size up to `most`, from `least` or else from minus that.

    Raises
    ------
    IllegalValueError
        For any other number.
    """
    least = -most if least is None else least
    x = value.scalar
    held = getattr(x, "value", x)  # a rounded float may be whole
    is_real = isinstance(held, Fraction | float)
    if not (is_real and least <= held <= most and held == int(held)):
        why = f"it is a whole number from {least} to {most}"
        raise ArgumentError(value, what, why, "change it")
    return int(held)


def require_size(value: Value, sizes: int | tuple[int, ...], what: str) -> None:
    """Refuse a vector or a matrix of another length."""
    allowed = sizes if isinstance(sizes, tuple) else (sizes,)
    if len(value.entries) not in allowed:  # type: ignore[arg-type]  # a vector or a matrix has a length
        raise ArgumentError(value, value.shape, f"{what} is needed", "check its size")


def require_square(A: Value) -> None:
    """Refuse a matrix that is not square."""
    if len(A.matrix) != len(A.matrix[0]):
        step = "use one with as many rows as columns"
        raise ArgumentError(A, A.shape, "a square matrix is needed", step)


def require_map(M: Value) -> None:
    """Refuse a matrix that is no 3×3 and no 4×4 one."""
    require_square(M)
    require_size(M, (3, 4), "a 3×3 or a 4×4 matrix")


def require_alike(a: Value, b: Value) -> None:
    """Refuse two values of different size."""
    if a.shape != b.shape:
        what = f"{a.shape} and {b.shape}"
        raise ArgumentError(b, what, "they differ in size", "match them")


def zero_vector(v: Value, what: str) -> NoAnswerError:
    """Make the refusal of a vector that has no direction."""
    why = "the vector is zero and has no direction"
    return NoAnswerForArgumentError(v, what, why, "use another")
