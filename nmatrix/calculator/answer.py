"""The value of an expression, exactly where it is exact, its space, and the steps if asked for."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from nmatrix.calculator.evaluate import Calculation
from nmatrix.calculator.meanings import Located, Map
from nmatrix.calculator.numbers import Float64, Interval
from nmatrix.calculator.values import Arithmetic, Value, ValueKind, as_strings, each
from nmatrix.enums import InverseBy, Numbers
from nmatrix.errors import counted
from nmatrix.report import Block, Formula, Heading, Quantity, Report, Step
from nmatrix.report import Value as JsonValue

ROUNDED = "Every product, sum, quotient and root was rounded to float64."
OVERFLOWED = "inf is a float64 that overflowed: the result is beyond the largest, 1.8e308."


def report(
    calculation: Calculation, *, with_steps: bool, inverse_by: InverseBy | None = None
) -> Report:
    """Report a calculation; `exact` holds fractions and roots where no number was rounded."""
    value = calculation.value
    steps = _steps(calculation, inverse_by) if with_steps else ()
    strings: JsonValue = as_strings(value.entries)  # type: ignore[assignment]  # lists of them
    data: dict[str, JsonValue] = {
        "expression": calculation.expression,
        "value": strings if value.letters else value.shown,
        **_meant(value),
        "exact": strings if value.exact or value.letters else None,
        "steps": steps if with_steps else None,
    }
    blocks: tuple[Block, ...] = (Heading(calculation.expression), *steps, _shown("value", value))
    return Report("calc", data, blocks, _remarks(calculation), numbers=Numbers.EXACT)


def value_report(
    name: str,
    calculation: Calculation,
    *,
    with_steps: bool,
    inverse_by: InverseBy | None = None,
) -> Report:
    """Report a value under the name that a session keeps it by."""
    value = calculation.value
    steps = _steps(calculation, inverse_by) if with_steps else ()
    data: dict[str, JsonValue] = {}
    if not value.letters:
        data[name] = value.shown
    blocks: tuple[Block, ...] = (*steps, _shown(name, value))
    return Report("calc", data, blocks, _remarks(calculation), numbers=Numbers.EXACT)


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
    if value.letters:
        return _formula(name, value)
    if value.kind is ValueKind.TRUTH:
        return Quantity(name, "yes" if value.entries else "no")
    if value.meaning is None:
        return Quantity(name, value.shown)
    title = str(value.meaning) if name == "value" else f"{name}, {value.meaning}"
    return Quantity(name, value.shown, title)


def _formula(name: str, value: Value) -> Formula:
    """Write letters as one does on paper, a vector as a column."""
    from nmatrix.working.working import written

    texts = each(value.entries, written)
    if value.kind is ValueKind.SCALAR:
        return Formula((f"{name} = {texts}",))
    columns = value.kind is ValueKind.VECTOR
    rows = tuple((one,) for one in texts) if columns else texts
    return Formula((f"{name} = ", rows))  # type: ignore[arg-type]  # rows of texts


def _steps(calculation: Calculation, inverse_by: InverseBy | None) -> tuple[Step, ...]:
    """Work the operations out in turn, each line from the one before."""
    from nmatrix.calculator.workings import Operation, lines

    def worked() -> Iterator[Step]:
        for step in calculation.steps:
            operation = Operation(step.operation, step.given, inverse_by)
            yield from lines(operation, step.expression, step.value, step.rule)

    return tuple(worked())


def _remarks(calculation: Calculation) -> tuple[str, ...]:
    """Tell what is known of a value that is not exact, behind what was remarked on its way."""
    value, told = calculation.value, list(calculation.remarks)
    if calculation.arithmetic is Arithmetic.FLOAT:
        overflowed = any(isinstance(x, Float64) and isinf(x.value) for x in value.numbers)
        told += [ROUNDED, OVERFLOWED] if overflowed else [ROUNDED]
    digits = [x.digits for x in value.numbers if isinstance(x, Interval)]
    if digits:
        known = counted(min(digits), "digit is", "digits are")
        told.append(f"A number in it is irrational: {known} known.")
    return tuple(told)
