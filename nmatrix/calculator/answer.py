"""The value of an expression, exactly where it is exact, and the steps if asked for."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from nmatrix.calculator.evaluate import Calculation
from nmatrix.calculator.numbers import Float64, Interval
from nmatrix.calculator.values import Arithmetic, Value, ValueKind, as_strings
from nmatrix.enums import Numbers
from nmatrix.errors import counted
from nmatrix.report import Block, Formula, Heading, Quantity, Report, Text
from nmatrix.report import Value as JsonValue
from nmatrix.working.working import written

ROUNDED = "Every product, sum, quotient and root was rounded to float64."
OVERFLOWED = "inf is a float64 that overflowed: the result is beyond the largest, 1.8e308."


def report(calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a calculation; `exact` holds fractions and roots where no number was rounded."""
    value = calculation.value
    steps: list[JsonValue] | None = None
    if with_steps:
        steps = [
            {"expression": step.expression, "value": plain(step.value), "rule": step.rule}
            for step in calculation.steps
        ]
    kind = ValueKind.SCALAR if value.kind is ValueKind.TRUTH else value.kind
    data: dict[str, JsonValue] = {
        "expression": calculation.expression,
        "value": plain(value),
        "kind": kind.value,
        "exact": _strings(value) if value.exact or value.letters else None,
        "steps": steps,
    }
    blocks = (
        Heading(calculation.expression),
        *(_steps(calculation) if with_steps else ()),
        _block("value", value),
    )
    return Report("calc", data, blocks, _remarks(calculation), numbers=Numbers.EXACT)


def value_report(name: str, calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a value under the name that a session keeps it by."""
    value = calculation.value
    blocks = (*(_steps(calculation) if with_steps else ()), _block(name, value))
    remarks = _remarks(calculation)
    return Report("calc", {name: plain(value)}, blocks, remarks, numbers=Numbers.EXACT)


def plain(value: Value) -> JsonValue:
    """Take what data says of a value: numbers, or texts where letters stay.

    Raises
    ------
    NoAnswerError
        If not one digit of an entry is known.
    """
    return _strings(value) if value.letters else value.shown


def _strings(value: Value) -> JsonValue:
    return as_strings(value.entries)  # type: ignore[return-value]  # texts, nested as it is


def _block(key: str, value: Value, title: str = "") -> Block:
    """Show a value by its name: as numbers, as a formula of letters, as yes or no."""
    if value.kind is ValueKind.TRUTH:
        return Quantity(key, "yes" if value.entries else "no", title)
    if not value.letters:
        return Quantity(key, value.shown, title)
    named = f"{title or key} = "
    if value.kind is ValueKind.MATRIX:
        return Formula((named, tuple(tuple(map(written, row)) for row in value.matrix)))
    texts = list(map(written, value.numbers))
    return Formula(
        (named + (texts[0] if value.kind is ValueKind.SCALAR else f"({', '.join(texts)})"),)
    )


def _steps(calculation: Calculation) -> Iterator[Block]:
    """Write the operations in turn, each with its rule and its value."""
    for i, step in enumerate(calculation.steps):
        yield Text(f"{step.expression}: {step.rule}")
        yield _block(f"steps.{i}.value", step.value, f"step {i + 1}")


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
