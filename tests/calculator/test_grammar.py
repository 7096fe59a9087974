"""The grammar is closed: whatever is outside it is refused in one line, with a caret."""

from __future__ import annotations

import random
import re
import warnings
from dataclasses import fields
from math import inf

import pytest
from counted import at_most

from nmatrix.calculator.arithmetic.values import Arithmetic, Value
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.elsewhere import INSTEAD
from nmatrix.calculator.language.faults import CalculatorError, NoValueError
from nmatrix.calculator.language.grammar import DEEPEST, parse
from nmatrix.calculator.language.tree import Node, Word
from nmatrix.errors import NMatrixError
from nmatrix.linear.rational import rational_matrix

NAMES = {"M": Value(rational_matrix([[1, 0, 0, 5], [0, 2, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]))}
FEW_CALLS = 100_000  # cofactors of cofactors take 66 000, nothing else takes 7 000

HUGE = {
    "a million characters": "1" * 10**6,
    "a million additions": "1+" * 10**6 + "1",
    "a power tower": "9**9**9**9**9",
    "a long power tower": "9**" * 3000 + "9",
    "brackets 100 000 deep": "(" * 10**5 + "1" + ")" * 10**5,
    "lists 4 900 deep": "[" * 4900 + "1" + "]" * 4900,
    "9 999 minus signs": "-" * 9999 + "1",
    "4 000 minus signs, parted": "- " * 4000 + "1",
    "a long sum": "1+" * 4999 + "1",
    "a long chain of not": "not " * 2400 + "1",
    "a long chain of attributes": "M" + ".T" * 4900,
    "a long chain of calls": "det" + "()" * 4900,
    "a long conditional": "1if 1else " * 990 + "1",
    "an exponent of millions": "1e20000000",
    "a tiny exponent of millions": "1e-20000000",
    "an integer of 9 999 digits": "9" * 9999,
    "cofactors of cofactors": "cofactor(" * 150
    + "[[1.5,2,3,1],[2,1.1,4,5],[3,5,7,8],[1,2,1,9]]"
    + ")" * 150,
    "a huge product": "*".join(["1e308"] * 100),
    "an identity of 10⁹": "identity(1000000000)",
}


@pytest.mark.parametrize("expression", HUGE.values(), ids=HUGE.keys())
@pytest.mark.parametrize("arithmetic", Arithmetic)
def test_what_would_hang_or_crash_ends_in_few_calls(expression, arithmetic):
    if arithmetic is Arithmetic.FLOAT and expression == HUGE["a huge product"]:
        with at_most(FEW_CALLS):
            assert calculate(expression, NAMES, arithmetic).value.scalar == inf
        return
    with pytest.raises((CalculatorError, NoValueError)) as refused, at_most(FEW_CALLS):
        calculate(expression, NAMES, arithmetic)
    assert len(str(refused.value)) < 300


@pytest.mark.parametrize(
    ("expression", "position"),
    [
        ("M.__class__", 1),
        ("(M).__class__", 3),
        ("inverse(M).__class__", 10),
        ("M.T.real", 3),
        ("().__class__.__bases__[0]", 1),
        ("__import__('os')", 0),
        ("eval(M)", 0),
        ("M[4]", 1),
        ("M[0, 1, 2]", 6),
        ("M[0.5]", 1),
        ("[x for x in M]", 3),
        ("lambda: 1", 6),
        ("(x := 1)", 3),
        ("(M) // 2", 5),
        ("M % 2", 2),
        ("1 if M else 2", 2),
        ("M and M", 2),
        ("not M", 4),
        ("det(*M)", 4),
        ("det(M, **M)", 7),
        ("M ! comment", 2),
        ("M; M", 1),
        ("M @", 3),
        ("[1, 2", 0),
        ("[1, 2]]", 6),
        ("det(M) + Q", 9),
        ("det(M) + detr(M)", 9),
        ("det", 0),
        ("det(M, M)", 0),
        ("det([1, 2, 3])", 4),
        ("1 + True", 4),
        ("1 + 0x10", 5),
        ("1 + 2j", 5),
        ("1 + 1_000", 5),
        ("1 + nan", 4),
        ("[[1, 2], [3]]", 9),
        ("[1, 2, 3, 4, 5, 6, 7, 8, 9]", 25),
        ("1.2.3", 3),
        ("2M", 1),
        ("M M", 2),
        ("M(2)", 0),
        ("M != M", 2),
        ("1 = 1", 2),
        ("(1, 2", 0),
        ("M.foo", 1),
        ("1 + M", 2),
        ("((M)) @ [1, 2, 3]", 6),
        ("M * M", 2),
        ("M\u200b", 1),
        ("dеt(M)", 1),  # a Cyrillic letter
        ("", 0),
        ("\x1b[31m", 0),
        ("1 + \x00", 4),
    ],
)
def test_the_caret_stands_before_the_fault(expression, position):
    with pytest.raises(CalculatorError) as refused:
        calculate(expression, NAMES)
    error = refused.value
    assert error.position == position
    assert f"(character {position + 1})" in str(error)
    before, caret, after = str(error).rpartition("see the caret: ")[2].partition("^")
    assert caret
    assert before == expression[max(0, position - 30) : position]
    assert (before + after).isprintable()


@pytest.mark.parametrize(
    ("expression", "position"),
    [("2^x", 2), ("2^3^2", 3), ("2^-10000", 3), ("2 ** 0.5", 5), ("M^", 2), ("M^(T", 4), ("^2", 0)],
)
def test_an_exponent_is_a_whole_number_or_a_t(expression: str, position: int) -> None:
    with pytest.raises(CalculatorError) as refused:
        calculate(expression, NAMES)
    assert refused.value.position == position


def test_the_caret_finds_its_character_in_a_long_line():
    expression = "+".join(["det(M)"] * 20) + "+ oops +" + "+".join(["det(M)"] * 20)
    with pytest.raises(CalculatorError) as refused:
        calculate(expression, NAMES)
    assert expression[refused.value.position :].startswith("oops")
    assert "^oops" in str(refused.value)
    assert len(str(refused.value)) < 200


def test_an_operation_without_an_answer_shows_its_place_too():
    for expression, position in (("1 + 2/0", 5), ("2 * inverse(0*M)", 12)):
        with pytest.raises(NMatrixError) as refused:
            calculate(expression, NAMES)
        assert refused.value.exit_code == 3
        assert refused.value.position == position
        assert f"{expression[:position]}^{expression[position:]}" in str(refused.value)


@pytest.mark.parametrize("deep", ["(", "[", "-", "- + ", "M.T @ (", "2^(", "√", "det("])
def test_depth_is_refused_where_it_begins(deep: str) -> None:
    """The rest of the line is not looked at: only the tokens up to there are read."""
    line = deep * 1000 + "1" + ")" * 1000
    with at_most(FEW_CALLS // 4), pytest.raises(CalculatorError) as refused:
        parse(line)
    assert refused.value.position <= (DEEPEST + 1) * len(deep)
    is_deep = f"{DEEPEST} levels" in str(refused.value)
    assert is_deep or deep == "2^(", "an exponent is a number alone"


def test_depth_that_is_admitted_is_computed() -> None:
    assert calculate("transpose(" * 98 + "M" + ")" * 98, NAMES).value == NAMES["M"]
    assert calculate("-" * 90 + "1", NAMES).value.scalar == 1
    assert calculate("+".join("1" * 99), NAMES).value.scalar == 99


def test_lines_tabs_and_the_minus_of_mathematics_are_read():
    assert calculate(" 5\n\t−  2 ", {}).value.scalar == 3


@pytest.mark.parametrize("expression", ["1if 2else 3", "1or 2", "0x1for x in M", "[1]is 1"])
def test_python_gives_no_advice_of_its_own(expression, capfd):
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        with pytest.raises(CalculatorError):
            calculate(expression, NAMES)
    assert heard == []
    assert capfd.readouterr() == ("", "")


def test_nothing_but_our_errors_comes_out_of_any_text():
    chance = random.Random(7)
    pieces = [*FUNCTIONS, "M", ".T", "(", ")", "[", "]", ",", "@", "*", "/", "+", "-", " ", "**"]
    pieces += ["1", "0", "2.5", "1e308", "5e-324", "[1,2,3]", "lambda", ".", "_", "\n", "é", "\x07"]
    for _ in range(3000):
        expression = "".join(chance.choices(pieces, k=chance.randint(1, 9)))
        try:
            calculate(expression, NAMES, chance.choice(list(Arithmetic)))
        except NMatrixError as error:
            assert str(error).isprintable(), expression
            assert len(str(error)) < 600, expression
            assert 0 <= error.position <= len(expression)


@pytest.mark.parametrize(
    ("typed", "list_of_numbers"),
    [
        ("[1 2;3 4]", "[[1, 2], [3, 4]]"),
        ("[1 2\n3 4]", "[[1, 2], [3, 4]]"),
        ("[1, 2; 3, 4;]", "[[1, 2], [3, 4]]"),
        ("[[1., 0.],[0., 1.]]", "[[1, 0], [0, 1]]"),
        ("[[1. 0.]\n [0. 1.]]", "[[1, 0], [0, 1]]"),
        ("[1.e+01 -.5e0 −2]", "[10, -0.5, -2]"),
        ("[1 -2]", "[1, -2]"),
        ("[1 - 2]", "[-1]"),
        ("[1 2 3]", "[1, 2, 3]"),
        ("[1; 2; 3]", "[1, 2, 3]"),
        ("[1/3 -2/3]", "[1/3, -2/3]"),
        ("[[1 2; 3 4] @ [1 1], [0 1]]", "[[3, 7], [0, 1]]"),
    ],
)
def test_literals_are_read_as_matrices_are_elsewhere(typed, list_of_numbers):
    wanted = calculate(list_of_numbers, {}).value
    assert calculate(typed, {}).value == wanted
    assert calculate(f"-{typed}", {}).value == -wanted


@pytest.mark.parametrize("typed", ["[1 2; 3]", "[1 2;; x]", "[1,,2]", "[M 1]", "1; 2", "[1 2"])
def test_what_is_no_literal_of_numbers_stays_a_fault(typed):
    with pytest.raises(CalculatorError):
        calculate(typed, NAMES)


@pytest.mark.parametrize("end", ["", "]", " " * 4000, ";" * 4000, "1" * 4000])
def test_a_long_literal_is_read_at_once(end):
    with at_most(FEW_CALLS), pytest.raises(CalculatorError):
        calculate("[" + "1 " * 2500 + end, {})


def test_lists_with_commas_stay_as_they_were_typed():
    for typed in ("[1,2, 3]", "[[1,2],[3 , 4]]", "M@[1,-1,0,1]"):
        assert calculate(typed, NAMES).expression == typed


def kinds_of(node: object) -> set[type]:
    """The kinds of a tree's nodes, looked for in whatever its fields hold."""
    if isinstance(node, tuple):
        return set().union(*map(kinds_of, node))
    if not isinstance(node, Node):
        return set()
    return {type(node)}.union(*(kinds_of(getattr(node, one.name)) for one in fields(node)))


def test_every_kind_of_node_can_be_typed_and_is_evaluated() -> None:
    lines = ("-30° + 1", "[1 2 3] · M[0, :].xyz", "det(M.T ^ 2)", "mat2(1,2,3,4)")
    seen = {kind for line in lines for kind in kinds_of(parse(line, frozenset(NAMES)))}
    assert seen | {Word} == set(Node.__subclasses__())
    found = [calculate(line, NAMES).value.entries for line in lines]
    assert found == [-29, 1, 4**1, ((1, 3), (2, 4))]  # OpenGL's mat2 is written by columns


def test_words_are_read_where_one_is_asked_for_alone() -> None:
    for line in ('"ZYX"', '1 + "ZYX"', '["ZYX"]', '"ZYX".T', '"ZYX"[0]', '-"ZYX"'):
        with pytest.raises(CalculatorError) as refused:
            calculate(line, {})
        assert refused.value.position == line.index('"')


@pytest.mark.parametrize(
    ("expression", "at"), [('__import__("os")', 0), ("1 + eval('2')", 9), ('det("M")', 4), ('"', 0)]
)
def test_the_caret_stands_before_the_beginning_of_the_fault(expression: str, at: int) -> None:
    with pytest.raises(CalculatorError) as found:
        calculate(expression, {})
    assert found.value.position == at
    assert f"{expression[:at]}^{expression[at:]}" in str(found.value)


def test_the_words_of_other_programs_are_answered_by_those_of_the_calculator():
    assert not set(INSTEAD) & set(FUNCTIONS)
    for name in INSTEAD:
        for written in (name, name.upper()):
            with pytest.raises(CalculatorError) as refusal:
                calculate(f"2 * {written}(a)", {})
            assert INSTEAD[name] in str(refusal.value)
            assert refusal.value.position == 4


@pytest.mark.parametrize(
    "written",
    [
        form
        for told in INSTEAD.values()
        if told.startswith("write ")
        for form in re.findall(r"\w+\([^)]*\)", told)
    ],
)
def test_what_is_to_be_written_instead_is_a_function_with_as_many_arguments(written):
    name, arguments = written[:-1].split("(")
    parameters = FUNCTIONS[name].parameters
    count = len(arguments.split(","))
    assert count <= len(parameters) or len(parameters) == 1


@pytest.mark.parametrize(
    ("line", "at", "told"),
    [
        ("transpose(inverse(mat3(M)))", 18, "write linear(M)"),
        ("2 * vec4(p, 1)", 4, "write point(v)"),
        ("[1, mat2(1, 2, x, 4)]", 4, "write its numbers"),
        ("A .* A", 2, "entry by entry"),
        ("A.^2", 1, "entry by entry"),
        ("A ./ A", 2, "entry by entry"),
        ("glm::lookAt(e, t)", 3, "no prefix"),
        ("np.dot(a, b)", 2, "write dot(a, b)"),
        ("// words", 0, "begins with #"),
        ("A // words", 3, "begins with #"),
        ("% words", 0, "begins with #"),
        ("4^(3/2)", 4, "whole number"),
        ("4^{1/2}", 4, "whole number"),
        ("4^(2", 4, ") is missing"),
    ],
)
def test_other_languages_are_refused_at_the_sign_that_is_theirs(line, at, told):
    names = dict.fromkeys(("M", "A", "np"), Value(rational_matrix([[1, 2], [3, 4]])))
    with pytest.raises(CalculatorError) as refusal:
        calculate(line, names)
    assert (refusal.value.position, told in str(refusal.value)) == (at, True), refusal.value


@pytest.mark.parametrize(
    ("printed", "typed"),
    [("7 – 2", "7 - 2"), ("3\xa0+\u202f4", "3 + 4"), ("6÷4", "6/4"), ("2⋅5∙3", "2*5*3")],
)
def test_the_signs_and_blanks_of_print_are_read_as_those_of_the_keyboard(printed, typed):
    assert calculate(printed, {}).value == calculate(typed, {}).value
