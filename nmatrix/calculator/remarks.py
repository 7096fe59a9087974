"""What an expression makes one say: angles that look like radians, letters that have no value."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Sequence
from fractions import Fraction

from nmatrix.calculator.arithmetic.numbers import Number, shown, times_pi
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.function import Argument
from nmatrix.calculator.language.tree import Bracket, Call, Node, Numeral, Prefix
from nmatrix.reading.angles import like_radians, of_pi
from nmatrix.working.working import written


def on_angles(expression: str, call: Call, values: Sequence[Argument]) -> Iterator[str]:
    """Remark on every angle of a call that is a multiple of π, or looks like radians.

    `values` are those of the arguments: first of the ones by place, then of the ones by name.
    """
    parameters = FUNCTIONS[call.function].parameters
    by_name = {one.name: one for one in parameters}
    typed = [
        *zip(parameters, call.arguments, strict=False),
        *((by_name[key], one) for key, one in call.named),
    ]
    for (parameter, argument), value in zip(typed, values, strict=False):
        if not parameter.is_angle or isinstance(value, str):
            continue
        entries = (
            [one for row in argument.rows for one in row]
            if isinstance(argument, Bracket)
            else [argument]
        )
        for entry, turned in zip(entries, value.numbers, strict=False):
            text = expression[entry.start : entry.end]
            yield from _on_angle(call.function, entry, text, turned)


def _on_angle(function: str, node: Node, typed: str, turned: Number) -> Iterator[str]:
    if (times := times_pi(turned)) is not None:
        yield f"{typed} is in radians, {times * 180} degrees."
        return
    number = node.operand if isinstance(node, Prefix) and node.sign in "+-" else node
    size = shown(turned) if isinstance(number, Numeral) else None
    if not isinstance(size, Fraction | float):
        return
    if (found := like_radians([Fraction(size)])) is not None:
        looks = f"{typed} looks like {of_pi(found[1])} radians"
        yield f"{function} takes degrees, but {looks}, {180 * found[1]} degrees."


def on_letters(letters: Collection[str], below: Collection[str]) -> Iterator[str]:
    """Remark on the names that have no value, and on what must not be 0 where it stands below."""
    many = len(letters) > 1
    has = "have no values and stay letters" if many else "has no value and stays a letter"
    yield f"{', '.join(sorted(letters))} {has}."
    if below:
        yield f"It holds where {' and '.join(f'{written(text)} ≠ 0' for text in below)}."
