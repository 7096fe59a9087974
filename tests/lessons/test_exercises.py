"""Exercises: the same everywhere, their keys right, their planned mistakes recognised."""

from __future__ import annotations

import random
from fractions import Fraction

import pytest

from nmatrix.errors import IllegalValueError
from nmatrix.lessons.check.hints import DIVIDE
from nmatrix.lessons.check.judge import Judge, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Subject
from nmatrix.lessons.exercises import scheme
from nmatrix.lessons.exercises import sheet as sheets
from nmatrix.lessons.exercises.bank import CONCEPTS, SPACE_OPTIONS, SPACES
from nmatrix.lessons.exercises.exercise import Choice, Computed, Exercise, ExerciseKind
from nmatrix.lessons.exercises.scheme import SCHEME, Draws, Sheet
from nmatrix.lessons.exercises.sheet import exercise, exercises
from nmatrix.output.drawing import draw_formula
from nmatrix.report import Formula, Text

SIZE = len(ExerciseKind)


def lines(blocks) -> str:
    shown = (block for block in blocks if isinstance(block, (Text, Formula)))
    return "\n".join(draw_formula(one) if isinstance(one, Formula) else one.text for one in shown)


def said(one: Exercise) -> str:
    return lines((*one.asked, *one.key))


def judged_rightly(one: Exercise) -> None:
    assert one.judge(one.right).verdict is Outcome.CORRECT, (one.title, one.right)
    texts = {one.right}
    for wrong in one.planned:
        found = one.judge(wrong.text)
        assert found.verdict is Outcome.MISTAKE
        assert wrong.mistake.value in (found.mistake, *found.also)
        assert wrong.text not in texts, "planned answers differ from each other"
        texts.add(wrong.text)
    if isinstance(one.grader, Choice):
        for i in range(len(one.grader.options)):
            found = one.judge("abcdefgh"[i])
            assert (found.verdict is Outcome.CORRECT) == (i == one.grader.right)
            if i != one.grader.right:  # a hint, not the answer
                assert one.grader.options[one.grader.right].because not in found.explanation


def test_the_draws_are_those_of_the_documented_scheme() -> None:
    """A second writing of the scheme, straight from its description."""
    from hashlib import blake2b

    parts = [b"nmatrix/1", b"salt", b"7", "Zoë".encode(), b"4", b"0"]
    joined = b"".join(len(part).to_bytes(8, "big") + part for part in parts)
    seed = int.from_bytes(blake2b(joined, digest_size=16).digest(), "big")
    raw = random.Random(seed)
    draws = Draws(Sheet("7", "Zoe\u0308", b"salt"), 4, 0)
    assert SCHEME == "nmatrix/1"
    assert [draws.randbelow(1000) for _ in range(5)] == [int(raw.random() * 1000) for _ in range(5)]


def test_golden_draws_never_change() -> None:
    draws = Draws(Sheet("1", "Ada"), 1, 0)
    assert [draws.randbelow(1000) for _ in range(6)] == GOLDEN_DRAWS
    assert [one.right for one in exercises(SIZE, Sheet("1", "Ada"))] == GOLDEN_ANSWERS


GOLDEN_DRAWS = [909, 111, 811, 742, 513, 406]
GOLDEN_ANSWERS = [
    "0 1/4 0 3; -1 0 0 -3; 0 0 2 2; 0 0 0 1",
    "1/2 0 0; 0 4 0; 0 2 1",
    "d",
    "-2 3 -7",
    "-3/2 9 -20",
    "c",
    "1/20 2/5 73/80",
    "c",
    "2 -2 1",
    "c",
]


def test_neighbouring_parts_do_not_run_into_each_other() -> None:
    def first(*parts: object) -> int:
        return Draws(Sheet(*parts), 1, 0).randbelow(10**9)  # type: ignore[arg-type]

    assert first("12", "3") != first("1", "23")
    assert first("1", "a", b"b") != first("1", "ab", b"")
    assert first("1", " Ada  Lovelace ") == first("1", "Ada Lovelace")


def test_a_sheet_takes_turns_through_all_kinds_and_does_not_depend_on_its_length() -> None:
    ten = exercises(SIZE, Sheet("3", "Bo"))
    assert [one.kind for one in ten] == list(ExerciseKind)
    assert exercises(4, Sheet("3", "Bo")) == ten[:4]
    assert exercise(13, Sheet("3", "Bo")).kind is ten[2].kind


@pytest.mark.slow
def test_students_seeds_and_salts_have_sheets_of_their_own() -> None:
    class_of = [Sheet("5", f"student {i}") for i in range(60)]
    told = {"".join(map(said, exercises(SIZE, one))) for one in class_of}
    assert len(told) == len(class_of)
    ada = "".join(map(said, exercises(SIZE, Sheet("5", "Ada"))))
    assert ada != "".join(map(said, exercises(SIZE, Sheet("6", "Ada"))))
    assert ada != "".join(map(said, exercises(SIZE, Sheet("5", "Ada", b"secret"))))


@pytest.mark.parametrize("seed", range(12))
def test_keys_are_right_and_planned_mistakes_are_recognised(seed: int) -> None:
    for one in exercises(SIZE, Sheet(str(seed), "test")):
        judged_rightly(one)


@pytest.mark.slow
def test_a_thousand_sheets_are_right() -> None:
    for seed in range(1_000):
        for one in exercises(SIZE, Sheet(str(seed), "many")):
            judged_rightly(one)


def test_numbers_are_small_enough_for_hand_work() -> None:
    for seed in range(8):
        for one in exercises(SIZE, Sheet(str(seed), "small")):
            for number in one.right.replace(";", " ").split():
                if not number.isalpha():
                    value = Fraction(number)
                    assert value.denominator <= 100
                    assert abs(value.numerator) <= 300


def test_the_key_is_not_on_the_sheet() -> None:
    for one in exercises(SIZE, Sheet("9", "Cy")):
        task = lines(one.asked)
        assert "answer = " not in task or one.kind is ExerciseKind.MISTAKE
        assert "Answer: " not in task


def test_a_planned_mistake_is_found_by_its_rule_and_not_by_its_text(monkeypatch) -> None:
    one = exercise(2, Sheet("1", "x"))
    planned = {each.mistake: each.text for each in one.planned}
    monkeypatch.delitem(MISTAKES[MistakeId.NOT_TRANSPOSED].slips, Subject.NORMAL)
    assert isinstance(one.grader, Computed)
    afresh = Computed(Judge(one.grader.question))
    assert afresh.judge(planned[MistakeId.NOT_TRANSPOSED]).mistake != "not-transposed"


def test_choices_take_a_letter_the_words_or_the_id() -> None:
    one = exercise(8, Sheet("2", "x"))
    assert isinstance(one.grader, Choice)
    right = one.grader.options[one.grader.right]
    for text in (one.right, f"({one.right.upper()})", f"{one.right})", right.mistake, right.text):
        assert one.judge(text).verdict is Outcome.CORRECT
    with pytest.raises(IllegalValueError, match="none of the choices"):
        one.judge("perhaps")


def test_the_bank_holds_no_question_twice_and_every_space() -> None:
    assert len({question for question, _, _ in CONCEPTS}) == len(CONCEPTS) >= 8
    for _, right, wrong in CONCEPTS:
        assert len({right[0], *(text for text, _ in wrong)}) == 4
    assert {space for _, space, _ in SPACES} == set(SPACE_OPTIONS)


def test_numbers_outside_the_sheet_are_refused() -> None:
    for number in (0, 101):
        with pytest.raises(IllegalValueError, match="1 to 100"):
            exercise(number, Sheet())


def test_attempts_that_do_not_show_their_mistakes_are_drawn_again(monkeypatch) -> None:
    built = []
    original = sheets.BUILDERS[ExerciseKind.WORLD]

    def reluctant(draws: Draws) -> Exercise | None:
        built.append(draws)
        return original(draws) if len(built) > 3 else None

    monkeypatch.setitem(sheets.BUILDERS, ExerciseKind.WORLD, reluctant)
    assert exercise(1, Sheet("1", "Ada")).kind is ExerciseKind.WORLD
    assert len(built) == 4


def test_only_the_documented_method_of_the_generator_is_used() -> None:
    import inspect

    source = inspect.getsource(scheme)
    calls = {part.split("(")[0] for part in source.split("self._random.")[1:]}
    assert calls == {"random"}


def test_a_vertex_must_have_been_divided_by_w() -> None:
    one = exercise(7, Sheet("7", "Ada"))
    x, y, z = (Fraction(number) for number in one.right.split())
    assert one.judge(f"{one.right} 1").verdict is Outcome.CORRECT
    named = set()
    for w in range(2, 20):
        found = one.judge(f"{x * w} {y * w} {z * w} {w}")
        assert found.mistake == "w-not-divided" or found.explanation == DIVIDE
        named.add(found.mistake)
        named.add(one.judge(f"{x * w} {y * w} {z * w}").mistake)
    assert named == {None, "w-not-divided"}, "one of these numbers is the vertex's w"


def test_mirrors_are_asked_for_as_often_as_flattenings() -> None:
    asked = [exercise(9, Sheet(str(seed), "mirror")) for seed in range(60)]
    mirrors = [one for one in asked if one.planned]
    assert 15 < len(mirrors) < 45
    for one in mirrors:
        assert [wrong.mistake.value for wrong in one.planned] == [
            "cofactor-sign",
            "used-world-matrix",
        ]


def test_a_choice_is_taken_in_the_words_of_whoever_answers() -> None:
    one = exercise(3, Sheet("7", "Ada"))  # clip space
    for text in ("d", "(D)", "d.", "d) clip", "Clip", "clip space"):
        assert one.judge(text).verdict is Outcome.CORRECT
    for text in ("view space", "eye space", "camera", "model", "local space", "world space"):
        assert one.judge(text).verdict is Outcome.UNKNOWN
    shortcut = next(
        found for seed in range(50) if (found := exercise(6, Sheet(str(seed), "x"))).right == "a"
    )
    assert shortcut.judge("yes").verdict is Outcome.CORRECT
    with pytest.raises(IllegalValueError, match="none of the choices"):
        shortcut.judge("no")  # two of them begin so
