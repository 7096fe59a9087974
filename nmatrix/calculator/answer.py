"""The value of an expression, exactly where it is exact, its space, and the steps if asked for."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from math import isinf

from nmatrix.calculator.arithmetic.meanings import Located, Map
from nmatrix.calculator.arithmetic.numbers import Float64, Interval, bits_of
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, ValueKind, as_strings, each
from nmatrix.calculator.evaluate import Calculation
from nmatrix.enums import InverseBy, Numbers
from nmatrix.errors import counted
from nmatrix.report import ENVELOPE, Block, Formula, Heading, Quantity, Report, Step
from nmatrix.report import Value as JsonValue
from nmatrix.surds import Surd, is_short

BITS_OF_A_LINE = 128  # of the longest integer in it: at most 39 digits
KEYS = ("expression", "value", "kind", "to", "from", "space", "exact", "steps")
ROUNDED = "Every product, sum, quotient and root was rounded to float64."
OVERFLOWED = "inf is a float64 that overflowed: the result is beyond the largest, 1.8e308."


def report(
    calculation: Calculation, *, with_steps: bool, inverse_by: InverseBy | None = None
) -> Report:
    """Report a calculation; `exact` holds fractions and roots where no number was rounded."""
    steps = worked(calculation, inverse_by) if with_steps else None
    data = keys(calculation, steps)
    value = _shown("value", calculation.value)
    blocks: tuple[Block, ...] = (Heading(calculation.expression), *(steps or ()), value)
    return Report("calc", data, blocks, _remarks(calculation), numbers=Numbers.EXACT)


def value_report(name: str, calculation: Calculation, steps: tuple[Step, ...] = ()) -> Report:
    """Report a value under the name that a session keeps it by."""
    value = calculation.value
    blocks: tuple[Block, ...] = (*steps, _shown(name, value))
    remarks = _remarks(calculation)
    key = f"{name}_" if name in ENVELOPE else name
    return Report("calc", {key: _plain(value)}, blocks, remarks, numbers=Numbers.EXACT)


def keys(calculation: Calculation, steps: tuple[Step, ...] | None) -> dict[str, JsonValue]:
    """Collect the keys of the contract for a value.

    Raises
    ------
    NoAnswerError
        If not one digit of an entry is known.
    """
    value = calculation.value
    return {
        "expression": calculation.expression,
        "value": _plain(value),
        **_meant(value),
        "exact": _strings(value) if value.exact or value.letters else None,
        "steps": steps,
    }


def _plain(value: Value) -> JsonValue:
    """Take what data says of a value: numbers, or texts where letters stay."""
    return _strings(value) if value.letters else value.shown


def _strings(value: Value) -> JsonValue:
    return as_strings(value.entries)  # type: ignore[return-value]  # texts, nested as it is


def _meant(value: Value) -> dict[str, JsonValue]:
    """Tell the kind of a value, and its space, or the two that a map leads between."""
    kind = ValueKind.SCALAR if value.kind is ValueKind.TRUTH else value.kind
    match value.meaning:
        case Map(to, source):
            return {"kind": kind, "to": to, "from": source, "space": None}
        case Located(space, found):
            return {"kind": found, "to": None, "from": None, "space": space}
    return {"kind": kind, "to": None, "from": None, "space": None}


def _shown(name: str, value: Value) -> Block:
    """Show a value by its name and what it means: numbers, letters, yes or no."""
    if value.letters:
        return _formula(name, value)
    if value.kind is ValueKind.TRUTH:
        return Quantity(name, "yes" if value.entries else "no")
    meaning = "" if value.meaning is None else str(value.meaning)
    if value.kind is ValueKind.MATRIX or not meaning:
        return Quantity(name, value.shown, meaning)
    return Quantity(name, value.shown, meaning if name == "value" else f"{name}: {meaning}")


def _formula(name: str, value: Value) -> Formula:
    """Write letters as one does on paper, a vector as a column."""
    from nmatrix.working.working import written

    texts = each(value.entries, written)
    if value.kind is ValueKind.SCALAR:
        return Formula((f"{name} = {texts}",))
    columns = value.kind is ValueKind.VECTOR
    rows = tuple((one,) for one in texts) if columns else texts
    return Formula((f"{name} = ", rows))  # type: ignore[arg-type]  # rows of texts


def worked(calculation: Calculation, inverse_by: InverseBy | None = None) -> tuple[Step, ...]:
    """Work the operations out in turn, each line from the one before."""
    from nmatrix.calculator.workings import Operation, lines

    def every() -> Iterator[Step]:
        for step in calculation.steps:
            operation = Operation(step.operation, step.given, inverse_by)
            yield from lines(operation, step.expression, step.value, step.rule)

    return tuple(every())


def _remarks(calculation: Calculation) -> tuple[str, ...]:
    """Tell what is known of a value that is not exact, behind what was remarked on its way."""
    value, told = calculation.value, list(calculation.remarks)
    if calculation.arithmetic is Arithmetic.FLOAT:
        overflowed = any(isinstance(x, Float64) and isinf(x.value) for x in value.numbers)
        told += [ROUNDED, OVERFLOWED] if overflowed else [ROUNDED]
    digits = [x.digits for x in value.numbers if isinstance(x, Interval)]
    if digits:
        known = counted(min(digits), "digit is", "digits are")
        told.append(f"A number in it is not exact: {known} known.")
    return (*told, *_kept_exactly(value))


def _kept_exactly(value: Value) -> tuple[str, ...]:
    """Tell of exact numbers too long to be shown, and the number where a line holds it."""
    rounded = [x for x in value.numbers if isinstance(x, Fraction | Surd) and not is_short(x)]
    if not rounded:
        return ()
    if value.kind is ValueKind.SCALAR and bits_of(rounded[0]) < BITS_OF_A_LINE:
        return (f"It is {rounded[0]} exactly.",)
    return ("What is too long to be shown whole is rounded there, and kept exactly.",)
