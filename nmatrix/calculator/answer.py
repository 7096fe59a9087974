"""The value of an expression, exactly where it is exact, and the steps if asked for."""

from __future__ import annotations

from collections.abc import Iterator
from math import isinf

from nmatrix.calculator.evaluate import Calculation
from nmatrix.calculator.numbers import Float64, Interval
from nmatrix.calculator.values import Arithmetic, Value, ValueKind, as_strings
from nmatrix.enums import Numbers
from nmatrix.errors import counted
from nmatrix.report import Block, Heading, Quantity, Report, Text
from nmatrix.report import Value as JsonValue

ROUNDED = "Every product, sum, quotient and root was rounded to float64."
OVERFLOWED = "inf is a float64 that overflowed: the result is beyond the largest, 1.8e308."


def report(calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a calculation; `exact` holds fractions and roots where no number was rounded."""
    value = calculation.value
    steps: list[JsonValue] | None = None
    if with_steps:
        steps = [
            {"expression": step.expression, "value": step.value.shown, "rule": step.rule}
            for step in calculation.steps
        ]
    kind = ValueKind.SCALAR if value.kind is ValueKind.TRUTH else value.kind
    data: dict[str, JsonValue] = {
        "expression": calculation.expression,
        "value": value.shown,
        "kind": kind.value,
        "exact": as_strings(value.entries) if value.exact else None,  # type: ignore[dict-item]
        "steps": steps,
    }
    blocks = (
        Heading(calculation.expression),
        *(_steps(calculation) if with_steps else ()),
        _quantity("value", value),
    )
    return Report("calc", data, blocks, _remarks(calculation), numbers=Numbers.EXACT)


def value_report(name: str, calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a value under the name that a session keeps it by."""
    value = calculation.value
    blocks = (*(_steps(calculation) if with_steps else ()), _quantity(name, value))
    remarks = _remarks(calculation)
    return Report("calc", {name: value.shown}, blocks, remarks, numbers=Numbers.EXACT)


def _quantity(name: str, value: Value) -> Quantity:
    if value.kind is ValueKind.TRUTH:
        return Quantity(name, "yes" if value.entries else "no")
    return Quantity(name, value.shown)


def _steps(calculation: Calculation) -> Iterator[Block]:
    """Write the operations in turn, each with its rule and its value."""
    for i, step in enumerate(calculation.steps):
        yield Text(f"{step.expression}: {step.rule}")
        yield Quantity(f"steps.{i}.value", step.value.shown, f"step {i + 1}")


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
