"""`nmatrix calc`: the value of an expression, its exact fractions, and the steps if asked for."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.calculator.evaluate import Calculation
from nmatrix.calculator.values import Arithmetic, Value, ValueKind, as_strings
from nmatrix.report import Block, Heading, Quantity, Report, Text
from nmatrix.report import Value as JsonValue

READABLE = 10**6  # larger denominators come from floats, and mean nothing to a person


def report(calculation: Calculation, *, with_steps: bool) -> Report:
    """Report a calculation; `exact` holds fractions where the value is rational."""
    value = calculation.value
    is_exact = value.exact and calculation.arithmetic is Arithmetic.EXACT
    steps: list[JsonValue] | None = None
    if with_steps:
        steps = [
            {"expression": step.expression, "value": step.value.entries, "rule": step.rule}
            for step in calculation.steps
        ]
    data: dict[str, JsonValue] = {
        "expression": calculation.expression,
        "value": value.entries,
        "kind": value.kind.value,
        "exact": as_strings(value.entries) if is_exact else None,  # type: ignore[dict-item]
        "steps": steps,
    }
    blocks: list[Block] = [Heading(calculation.expression)]
    if with_steps:
        for i, step in enumerate(calculation.steps):
            blocks += [Text(f"{step.expression}: {step.rule}")]
            blocks += [Quantity(f"steps.{i}.value", step.value.entries, f"step {i + 1}")]
    blocks.append(Quantity("value", value.entries, "value"))
    if is_exact and 1 < max(x.denominator for x in _flat(value)) <= READABLE:
        blocks.append(Text(f"exactly: {_fractions(value)}"))
    return Report("calc", data, tuple(blocks), _remarks(value, calculation.arithmetic))


def _flat(value: Value) -> list[Fraction]:
    if value.kind is ValueKind.SCALAR:
        return [value.scalar]
    if value.kind is ValueKind.VECTOR:
        return list(value.vector)
    return [entry for row in value.matrix for entry in row]


def _fractions(value: Value) -> str:
    if value.kind is ValueKind.MATRIX:
        return "; ".join(" ".join(str(entry) for entry in row) for row in value.matrix)
    return " ".join(str(entry) for entry in _flat(value))


def _remarks(value: Value, arithmetic: Arithmetic) -> tuple[str, ...]:
    if arithmetic is Arithmetic.FLOAT:
        return ("Every operation was rounded to float64.",)
    if not value.exact:
        return ("A root or a sine in it is irrational: it is not exact where terms cancel.",)
    return ()
