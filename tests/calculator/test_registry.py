"""Every function: its example holds, its parameters have their names, a fault has its caret."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from nmatrix.calculator.arithmetic.numbers import Interval, shown
from nmatrix.calculator.arithmetic.values import Arithmetic, ValueKind
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.language.faults import CalculatorError, PlacedError
from nmatrix.calculator.language.grammar import parse
from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.surds import Surd

NOT_BY_FLOATS = {"eigenvalues", "singular_values", "polar"}


def called(name):
    """Return the call in a function's example, and the text of each of its arguments."""
    example = FUNCTIONS[name].example
    call = parse(example, frozenset(FUNCTIONS))
    return call, [example[one.start : one.end] for one in call.arguments]


def is_gathered(name):
    return len(called(name)[1]) > len(FUNCTIONS[name].parameters)


def floats(expression, arithmetic=Arithmetic.EXACT):
    return [float(shown(x)) for x in calculate(expression, {}, arithmetic).value.numbers]


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_example_is_what_its_result_says(name):
    function = FUNCTIONS[name]
    assert called(name)[0].function == name
    assert calculate(f"({function.example}) == ({function.result})", {}).value.entries is True


@pytest.mark.parametrize("name", FUNCTIONS)
def test_a_float_program_comes_near_the_result(name):
    function = FUNCTIONS[name]
    if name in NOT_BY_FLOATS:
        with pytest.raises(IllegalValueError, match="in float64"):
            calculate(function.example, {}, Arithmetic.FLOAT)
        return
    found = floats(function.example, Arithmetic.FLOAT)
    assert found == pytest.approx(floats(function.result), abs=1e-12)


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if not is_gathered(name)])
def test_every_argument_may_be_given_by_its_name(name):
    call, arguments = called(name)
    function = FUNCTIONS[name]
    named = [
        f"{one.name}={text}" for one, text in zip(function.parameters, arguments, strict=False)
    ]
    named += [function.example[node.start - len(key) - 1 : node.end] for key, node in call.named]
    backwards = f"{name}({', '.join(reversed(named))})"
    assert calculate(f"({backwards}) == ({function.result})", {}).value.entries is True


@pytest.mark.parametrize("name", [name for name in FUNCTIONS if not is_gathered(name)])
def test_an_argument_of_another_kind_has_the_caret(name):
    call, arguments = called(name)
    for place, node in enumerate(call.arguments):
        wrong = [*arguments]
        wrong[place] = '"nonsense"'
        with pytest.raises(CalculatorError) as refused:
            calculate(f"{name}({', '.join(wrong)})", {})
        before = len(f"{name}({', '.join(arguments[:place])}") + (2 if place else 0)
        assert refused.value.position == before, node
        parameter = FUNCTIONS[name].parameters[place]
        assert parameter.wanted.partition(" ")[0] in str(refused.value)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_nothing_and_too_much_are_refused_with_what_is_wanted(name):
    function = FUNCTIONS[name]
    with pytest.raises(IllegalValueError, match="is no such argument"):
        calculate(f"{name}(nonsense=1)", {})
    most = max(len(function.parameters), *function.gathers, 1)
    with pytest.raises(IllegalValueError):
        calculate(f"{name}({', '.join(['1'] * (most + 1))})", {})
    if not all(one.may_be_left_out for one in function.parameters):
        with pytest.raises(IllegalValueError, match="got nothing"):
            calculate(f"{name}()", {})


@pytest.mark.parametrize("name", FUNCTIONS)
def test_what_explains_a_function_is_there_and_reads_on(name):
    function = FUNCTIONS[name]
    for text in (function.does, function.rule):
        assert text, name
        assert not text.endswith("."), name
    assert function.formula.strip()
    assert function.usage(name).startswith(f"{name}(")


@pytest.mark.parametrize(
    ("expression", "at"),
    [
        ("dot([1, 2], [1, 2, 3])", None),
        ("1 + normalize([0, 0, 0])", "[0, 0, 0]"),
        ("angle([1, 0, 0], [0, 0, 0])", "[0, 0, 0]"),
        ("solve([1 2; 2 4], [1, 3])", "[1, 3]"),
        ("solve([1 2; 2 4], [1, 2])", "[1 2"),
        ("solve([1 2; 3 4], [1, 2, 3])", "[1, 2, 3]"),
        ("2 * inverse([1 2; 2 4])", "[1 2"),
        ("look_at([1, 2, 3], [1, 2, 3])", "[1, 2, 3])"),
        ("look_at([1, 2, 3], [0, 0, 0], [0, 0, 0])", "[0, 0, 0])"),
        ("perspective(200, 1, 1, 2)", "200"),
        ("perspective(60, -1, 1, 2)", "-1"),
        ("perspective(60, 1, 0, 2)", "0, 2"),
        ("frustum(1, 1, 2, 3, 4, 5)", "1, 2"),
        ("viewport(640, 4.5)", "4.5"),
        ("axis_angle([0, 0, 0], 30)", "[0"),
        ("world(rotate=[0, 0, 30], quaternion=[0, 0, 0, 1])", "[0, 0, 0, 1]"),
        ("world(scale=[1, 2])", "[1, 2]"),
        ("power([1 2; 3 4], 1/2)", "1/2"),
        ("transform_plane(scale(1, 2, 1), [0, 0, 0, 1])", "[0"),
        ("tan(90)", "90"),
        ("asin(2)", "2"),
        ("sqrt(-2)", "-2"),
        ("project([1, 2, 3, 0])", "[1"),
        ("depth_of(-1, near=1, far=2)", "-1"),
        ("distance_of(3, near=1, far=2)", "3"),
        ("polar([1 2; 2 4])", "[1 2"),
        ("eigenvalues([0 -1; 1 0])", "[0"),
        ("null_space([1 0; 0 1])", "[1"),
        ("slerp([1, 0], [-1, 0], 1/3)", "[-1"),
        ('euler(rotate_z(30), "XYX")', '"XYX"'),
        ("identity(9)", "9"),
    ],
)
def test_a_fault_has_its_caret_at_the_argument_where_it_lies(expression, at):
    with pytest.raises((IllegalValueError, NoAnswerError)) as refused:
        calculate(expression, {})
    place = 0 if at is None else expression.rindex(at)
    if at == "[1, 2, 3])":
        place = expression.rindex("[1, 2, 3]")
    assert refused.value.position == place, str(refused.value)
    assert "\n" not in str(refused.value)


CANCELS = "(sin(20)*sin(20)+cos(20)*cos(20)-1)"
SCALARS = f"""
    0 1 -1 2 1/3 -5/7 0.1 1e40 1e308 1e-308 1e300*1e300 640 480 90 180 45 30deg pi pi/6
    √2 -√3/2 √2+√3+√5 √97*√89+√83+√79 sqrt(1+√2) sin(20) -cos(33) {CANCELS}
""".split()
MATRICES = """
    rotate_z(30) linear(rotate_x(20)) scale(1,2,3) identity(4) 0*identity(3) translate(1,2,3)
    linear(rotate_x(20)@scale(1,2,1)) rotate_z(30)@scale(1,0,1) look_at([1,2,3],[0,0,0])
""".split()


class Calls:
    """Calls of all functions with arguments of all kinds, most of them of the right ones."""

    def __init__(self, seed):
        self.chance = random.Random(seed)

    def entries(self, count):
        return [self.chance.choice([*SCALARS, "1", "2", "-3"]) for _ in range(count)]

    def written(self, kind):
        pick = self.chance.choice
        if kind is ValueKind.SCALAR:
            return pick(SCALARS)
        if kind is ValueKind.VECTOR:
            return f"[{', '.join(self.entries(pick([1, 2, 3, 3, 3, 4, 4, 5])))}]"
        if self.chance.random() < 0.4:
            return pick(MATRICES)
        width = pick([2, 3, 4])
        rows = [", ".join(self.entries(width)) for _ in range(pick([width, width, 2, 3, 4]))]
        return f"[{'; '.join(rows)}]"

    def argument(self, parameter):
        words = [f'"{word}"' for word in parameter.choices]
        kinds = [self.written(kind) for kind in parameter.kinds]
        wrong = [self.written(self.chance.choice(list(ValueKind)[1:])), '"nonsense"']
        return self.chance.choice((words + kinds) * 8 + wrong)

    def call(self, name):
        function = FUNCTIONS[name]
        if function.gathers and self.chance.random() < 0.6:
            count = min(self.chance.choice(function.gathers), 6)
            return f"{name}({', '.join(self.entries(count))})"
        given = [
            f"{parameter.name}={self.argument(parameter)}"
            for parameter in function.parameters
            if not parameter.may_be_left_out or self.chance.random() < 0.4
        ]
        return f"{name}({', '.join(given)})"


@pytest.mark.parametrize("name", FUNCTIONS)
def test_whatever_is_given_is_answered_or_refused_in_one_line(name):
    calls = Calls(name)
    for _ in range(12):
        expression = calls.call(name)
        arithmetic = calls.chance.choice(list(Arithmetic))
        try:
            found = calculate(expression, {}, arithmetic).value
        except PlacedError as refused:
            assert str(refused).isprintable(), expression
            assert len(str(refused)) < 400, expression
            assert 0 <= refused.position <= len(expression)
            continue
        for x in found.numbers:
            try:
                assert isinstance(shown(x), Fraction | Surd | float), expression
            except NoAnswerError:
                assert isinstance(x, Interval), expression
