"""A right answer is right in every form in which it may be typed, and never called a mistake."""

from __future__ import annotations

import random
from collections.abc import Callable, Sequence
from fractions import Fraction

import pytest
from mistakes import questions, scene

from nmatrix.errors import NoAnswerError
from nmatrix.lessons.check.answer import read_answer
from nmatrix.lessons.check.judge import Judge, Outcome
from nmatrix.lessons.check.question import Question, Subject

Rows = Sequence[Sequence[Fraction]]
Form = Callable[[Rows], str]


def joined(rows: Rows, number: Callable[[Fraction], str], between: str = " ") -> str:
    return "; ".join(between.join(map(number, row)) for row in rows)


def cut_off(value: Fraction, decimals: int) -> str:
    whole = int(abs(value) * 10**decimals)
    sign = "-" if value < 0 and whole else ""
    return f"{sign}{whole // 10**decimals}.{whole % 10**decimals:0{decimals}d}"


def glsl(rows: Rows) -> str:
    columns = [f"{float(one):.5f}" for column in zip(*rows, strict=True) for one in column]
    return f"mat{len(rows)}({', '.join(columns)})"


FORMS: dict[str, Form] = {
    "three decimals": lambda rows: joined(rows, lambda x: f"{float(x):.3f}"),
    "three decimals, cut off": lambda rows: joined(rows, lambda x: cut_off(x, 3)),
    "six decimals": lambda rows: joined(rows, lambda x: f"{float(x):.6f}"),
    "six digits, as C++ prints them": lambda rows: joined(rows, lambda x: f"{float(x):g}"),
    "with an exponent": lambda rows: joined(rows, lambda x: f"{float(x):.5e}"),
    "all digits": lambda rows: joined(rows, lambda x: repr(float(x)), ", "),
    "fractions": lambda rows: joined(rows, str),
    "a list of lists": lambda rows: repr([list(map(float, row)) for row in rows]),
    "flat": lambda rows: " ".join(f"{float(x):.4f}" for row in rows for x in row),
    "GLSL": glsl,
}
OF_SEVERAL_ROWS = ("GLSL",)


def typed_in_shapes(question: Question, right: Rows) -> list[Rows]:
    """Return the right answer in each shape that counts: with its w, longer, as a column."""
    if question.subject is Subject.TRACE:
        return [right, [right[0][:3]]]
    if question.is_direction:
        longer = [] if question.unit else [[tuple(7 * x for x in right[0][:3])]]
        return [right, [right[0][:3]], [(x,) for x in right[0][:3]], *longer]
    if question.is_vector:
        return [right, [right[0][:3]], [tuple(3 * x for x in right[0])]]
    if question.any_length:
        return [right, [tuple(Fraction(5, 2) * x for x in row) for row in right]]
    return [right]


def judged_in_every_form(seeds: range) -> int:
    count = 0
    for seed in seeds:
        draw = random.Random(seed)
        for question in questions(scene(draw), draw):
            judge = Judge(question)
            try:
                right = judge.right
            except NoAnswerError:
                continue
            for rows in typed_in_shapes(question, right):
                for name, form in FORMS.items():
                    if name in OF_SEVERAL_ROWS and len(rows) != len(rows[0]):
                        continue
                    found = judge.judge(read_answer(form(rows), question))
                    assert found.verdict is Outcome.CORRECT, (seed, question.subject, name)
                    assert not found.mistakes
                    count += 1
    return count


def test_a_right_answer_is_right_in_every_form() -> None:
    assert judged_in_every_form(range(4)) > 500


@pytest.mark.slow
def test_a_right_answer_is_right_in_every_form_of_many_scenes() -> None:
    assert judged_in_every_form(range(4, 28)) > 4_000
