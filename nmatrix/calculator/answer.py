"""`nmatrix calc`: the value of an expression, its exact fractions, and the steps if asked for."""

from __future__ import annotations

from fractions import Fraction
from math import isinf

from nmatrix.calculator.evaluate import Calculation
from nmatrix.calculator.meanings import Located, Map
from nmatrix.calculator.numbers import Float64, Interval
from nmatrix.calculator.values import Arithmetic, Value, ValueKind, as_strings
from nmatrix.errors import counted
from nmatrix.linear.rounding import short_text
from nmatrix.report import Block, Heading, Quantity, Report, Text
from nmatrix.report import Value as JsonValue

READABLE = 10**6  # larger denominators come from floats, and mean nothing to a person
ROUNDED = "Every product, sum, quotient and root was rounded to float64."
OVERFLOWED = "inf is a float64 that overflowed: the result is beyond the largest, 1.8e308."


def report(calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a calculation; `exact` holds fractions where the value is rational."""
    value = calculation.value
    steps: list[JsonValue] | None = None
    if with_steps:
        steps = [
            {"expression": step.expression, "value": step.value.shown, "rule": step.rule}
            for step in calculation.steps
        ]
    data: dict[str, JsonValue] = {
        "expression": calculation.expression,
        "value": value.shown,
        **_meant(value),
        "exact": as_strings(value.entries) if value.exact else None,  # type: ignore[dict-item]
        "steps": steps,
    }
    blocks: list[Block] = [Heading(calculation.expression)]
    if with_steps:
        for i, step in enumerate(calculation.steps):
            blocks += [Text(f"{step.expression}: {step.rule}")]
            blocks += [Quantity(f"steps.{i}.value", step.value.shown, f"step {i + 1}")]
    blocks.append(Quantity("value", value.shown, str(value.meaning or "value")))
    denominators = [x.denominator for x in value.numbers if isinstance(x, Fraction)]
    if value.exact and 1 < max(denominators) <= READABLE:
        blocks.append(Text(f"exactly: {_fractions(value)}"))
    remarks = (*calculation.remarks, *_remarks(value, calculation.arithmetic))
    return Report("calc", data, tuple(blocks), remarks)


def _meant(value: Value) -> dict[str, JsonValue]:
    """Tell the kind of a value, and its space, or the two that a map leads between."""
    kind = ValueKind.SCALAR if value.kind is ValueKind.TRUTH else value.kind
    match value.meaning:
        case Map(to, source):
            return {"kind": kind, "to": to, "from": source, "space": None}
        case Located(space, found):
            return {"kind": found, "to": None, "from": None, "space": space}
    return {"kind": kind, "to": None, "from": None, "space": None}


def _fractions(value: Value) -> str:
    if value.kind is ValueKind.MATRIX:
        return "; ".join(" ".join(map(str, row)) for row in value.matrix)
    return " ".join(map(str, value.numbers))


def _remarks(value: Value, arithmetic: Arithmetic) -> list[str]:
    if arithmetic is Arithmetic.FLOAT:
        overflowed = any(isinstance(x, Float64) and isinf(x.value) for x in value.numbers)
        return [ROUNDED, OVERFLOWED] if overflowed else [ROUNDED]
    intervals = [x for x in value.numbers if isinstance(x, Interval)]
    digits = [x.digits for x in intervals if x.digits]
    remarks = []
    if digits:
        known = counted(min(digits), "digit is", "digits are")
        remarks.append(f"A root or a sine in it is irrational: {known} known.")
    if len(digits) < len(intervals):
        within = short_text(max(x.farthest for x in intervals if not x.digits), 2)
        remarks.append(
            f"Roots or sines cancel: what is shown as 0 is within {within} of it, and may differ."
        )
    return remarks
