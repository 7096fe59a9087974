"""Question banks: their structure, and that platforms grade as `check` does, cell by cell."""

from __future__ import annotations

import random
import re
from collections.abc import Iterator
from fractions import Fraction
from functools import cache
from html import unescape
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from platforms import (
    QtiItem,
    canvas_is_right,
    canvas_items,
    canvas_kind,
    canvas_points,
    moodle_choice,
    moodle_grades,
    moodle_questions,
    unpacked,
)

from nmatrix.classroom.bank.question import (
    Bank,
    BankQuestion,
    Numbers,
    decimal,
    definite,
    forwards,
    numbers_of,
    questions,
)
from nmatrix.classroom.bank.text import feedback
from nmatrix.classroom.bank.write import BankFormat, write
from nmatrix.classroom.words import WORDS, Language
from nmatrix.lessons.check.answer import read_answer
from nmatrix.lessons.check.judge import Judge, Judgement, Outcome
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.exercises.exercise import Choice, Computed
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.output.mathml import prose

NAMES = ("Ada", "Bo", "Lovelace, Ada", "李小龍", "Ж/O'Hara & <b>", "x\x01{1:SA:=a}~#\\")
COUNT, POINTS = 10, 4
ENGLISH = WORDS[Language.ENGLISH]


@cache
def bank() -> Bank:
    return Bank("Normals", tuple(questions(Sheet("7", name), COUNT) for name in NAMES), POINTS)


@cache
def written(kind: BankFormat) -> bytes:
    return write(bank(), kind, ENGLISH)


def of_numbers() -> Iterator[tuple[int, BankQuestion, Numbers]]:
    for i, sheet in enumerate(bank().sheets):
        for one in sheet:
            if isinstance(one.form, Numbers):
                yield i, one, one.form


def rounded(value: Fraction) -> str:
    return f"{float(value):.4f}"


def answers(form: Numbers) -> Iterator[tuple[str, ...]]:
    """Type the right answer, those of known mistakes, and numbers that are off a little."""
    right = tuple(field.right for field in form.fields)
    yield tuple(map(rounded, right))
    for wrong in judge_of(form).singles:
        if wrong.value is not None:
            value = forwards(wrong.value) if form.is_flat else wrong.value
            rows = (value[0][:3],) if form.question.is_vector else value
            yield tuple(rounded(entry) for row in rows for entry in row)
    draws = random.Random(len(right))
    for times in ("0.4", "1.6", "3", "900"):
        place = draws.randrange(len(right))
        off = [*right]
        off[place] += Fraction(times) * form.fields[place].tolerance
        yield tuple(map(rounded, off))


def judged(form: Numbers, typed: tuple[str, ...]) -> Judgement:
    """Judge typed numbers; of a flattened surface from the side that the question names."""
    if form.is_flat and next(x for x in judge_of(form).right[0] if x) < 0:
        typed = tuple(rounded(-Fraction(text)) for text in typed)
    columns = len(form.rows[0]) if not form.question.is_vector else 3
    rows = [typed[i : i + columns] for i in range(0, len(typed), columns)]
    text = "; ".join(" ".join(row) for row in rows)
    return judge_of(form).judge(read_answer(text, form.question))


JUDGES: dict[int, Judge] = {}  # by the identity of what they judge: banks are made once


def judge_of(form: Numbers) -> Judge:
    return JUDGES.setdefault(id(form), Judge(form.question))


@cache
def judged_answers(sheet: int, number: int) -> list[tuple[tuple[str, ...], Judgement]]:
    form = bank().sheets[sheet][number - 1].form
    assert isinstance(form, Numbers)
    return [(typed, judged(form, typed)) for typed in answers(form)]


def wrong_fields(form: Numbers, found: Judgement) -> set[int]:
    if found.verdict is Outcome.CORRECT:
        return set()
    if form.question.is_vector:
        return {j for _, j in found.wrong_entries}
    columns = len(form.rows[0])
    return {i * columns + j for i, j in found.wrong_entries}


@cache
def all_moodle_questions() -> list[ET.Element]:
    return moodle_questions(written(BankFormat.MOODLE))


def moodle_of(sheet: int, number: int) -> ET.Element:
    return all_moodle_questions()[(number - 1) * len(NAMES) + sheet]


@cache
def qti_files() -> dict[str, bytes]:
    return unpacked(written(BankFormat.QTI))


def qti_of(sheet: int, number: int) -> QtiItem:
    files = qti_files()
    return QtiItem(ET.fromstring(files[f"items/exercise-{number}-{sheet + 1:04}.xml"]))


def test_platforms_grade_each_number_as_check_does_for_six_students() -> None:
    compared = 0
    canvas = canvas_items(written(BankFormat.CANVAS))
    for sheet, one, form in of_numbers():
        number = one.exercise.number
        moodle, qti = moodle_of(sheet, number), qti_of(sheet, number)
        ident = f"_exercise{number}_"
        cells = [item for item in canvas[sheet] if ident in item.get("ident", "")]
        assert len(cells) == len(qti.responses) == len(form.fields)
        for typed, found in judged_answers(sheet, number):
            wrong = wrong_fields(form, found)
            right = tuple(rounded(field.right) for field in form.fields)
            if form.is_flat and found.verdict is Outcome.CORRECT and typed != right:
                continue  # the other side, which the question's own words exclude
            numbers = {i: float(text) for i, text in enumerate(typed)}
            graded = moodle_grades(moodle, numbers)
            assert {i for i, is_right in graded.right.items() if not is_right} == wrong, typed
            assert {
                i for i, text in enumerate(typed) if not canvas_is_right(cells[i], text)
            } == wrong
            score, _, _ = qti.grades(dict(zip(qti.responses, numbers.values(), strict=True)))
            share = 1 - len(wrong) / len(form.fields)
            assert score == pytest.approx(POINTS * share)
            assert graded.score == pytest.approx(share)
            compared += len(typed)
    assert compared > 4000


def test_a_known_mistake_is_named_by_each_number_that_it_alone_changes() -> None:
    named = 0
    for sheet, one, form in of_numbers():
        moodle, qti = moodle_of(sheet, one.exercise.number), qti_of(sheet, one.exercise.number)
        truths = [field.right for field in form.fields]
        for typed, found in judged_answers(sheet, one.exercise.number):
            if len(found.mistakes) != 1 or found.mistake == MistakeId.MISSING_NORMALISE:
                continue  # of the lengths that are not 1, a field knows one
            numbers = {i: float(text) for i, text in enumerate(typed)}
            graded = moodle_grades(moodle, numbers)
            _, shown, _ = qti.grades(dict(zip(qti.responses, numbers.values(), strict=True)))
            for i in wrong_fields(form, found):
                field = form.fields[i]
                given = Fraction(typed[i])
                if any(abs(given - truth) <= field.tolerance for truth in truths):
                    assert graded.feedback[i] == ""
                    continue
                did = MISTAKES[found.mistakes[0]].did
                assert did in graded.feedback[i], (typed, found.mistakes, i)
                assert any(did in said for said in shown)
                named += 1
    assert named > 500


def test_choices_are_graded_as_check_grades_them_and_say_why() -> None:
    canvas = canvas_items(written(BankFormat.CANVAS))
    for sheet, questions_of in enumerate(bank().sheets):
        for one in questions_of:
            if not isinstance(one.form, Choice):
                continue
            number = one.exercise.number
            qti = qti_of(sheet, number)
            (item,) = (x for x in canvas[sheet] if x.get("ident", "").endswith(f"e{number}"))
            assert canvas_points(item) == POINTS
            for i, option in enumerate(one.form.options):
                is_right = one.exercise.judge("abcdefgh"[i]).verdict is Outcome.CORRECT
                graded = moodle_choice(moodle_of(sheet, number), i)
                assert (graded.score == 1) is is_right
                assert graded.feedback[0] == prose(option.because)
                score, shown, _ = qti.grades({"RESPONSE": "abcdefgh"[i]})
                assert (score == POINTS) is is_right
                assert len(shown) == 1
                assert canvas_is_right(item, str(i + 1)) is is_right


def test_moodle_files_hold_what_the_documentation_asks_for() -> None:
    root = ET.fromstring(written(BankFormat.MOODLE))
    assert root.tag == "quiz"
    kinds = [one.get("type") for one in root]
    assert set(kinds) == {"category", "cloze", "multichoice"}
    assert kinds[0] == "category"
    assert kinds.count("category") == COUNT
    for one in root:
        if one.get("type") == "category":
            assert (one.findtext("category/text") or "").startswith("$course$/top/Normals/")
            continue
        assert one.findtext("name/text")
        assert one.find("questiontext").get("format") == "html"  # type: ignore[union-attr]
        text = unescape(one.findtext("questiontext/text") or "")
        assert "<script" not in text
        if one.get("type") == "multichoice":
            fractions = [answer.get("fraction") for answer in one.iter("answer")]
            assert sorted(fractions) == [*["0"] * (len(fractions) - 1), "100"]
            assert one.findtext("single") == "true"


def test_qti_items_and_the_test_are_valid_by_the_published_schema(data: Path) -> None:
    etree = pytest.importorskip("lxml.etree")
    published = data / "qti" / "qtiv2p1" / "imsqti_v2p1.xsd"
    if not published.is_file():
        pytest.skip("the reference data has no schema of QTI")
    schema = etree.XMLSchema(etree.parse(str(published)))
    files = unpacked(written(BankFormat.QTI))
    for name, content in files.items():
        if name != "imsmanifest.xml":
            schema.assertValid(etree.fromstring(content))


def test_packages_name_each_of_their_files_once() -> None:
    for kind in (BankFormat.QTI, BankFormat.CANVAS):
        files = unpacked(written(kind))
        manifest = ET.fromstring(files["imsmanifest.xml"])
        named = [one.get("href") for one in manifest.iter() if one.tag.endswith("}file")]
        assert sorted(named) == sorted(set(files) - {"imsmanifest.xml"})
        identifiers = [
            one.get("identifier") for one in manifest.iter() if one.tag.endswith("}resource")
        ]
        assert len(set(identifiers)) == len(identifiers)
        for identifier in identifiers:
            assert re.fullmatch(r"[A-Za-z_][\w.-]*", identifier or "", re.ASCII)


def test_a_qti_test_draws_one_question_of_each_exercise_from_items_that_exist() -> None:
    files = unpacked(written(BankFormat.QTI))
    test = ET.fromstring(files["test.xml"])
    sections = [one for one in test.iter() if one.tag.endswith("}assessmentSection")]
    assert len(sections) == COUNT
    for section in sections:
        items = [one for one in section if one.tag.endswith("}assessmentItemRef")]
        assert len(items) == len(NAMES)
        assert all(one.get("href") in files for one in items)


def test_canvas_questions_have_one_number_each_and_share_the_points_of_their_exercise() -> None:
    quizzes = canvas_items(written(BankFormat.CANVAS))
    idents = [item.get("ident") for quiz in quizzes for item in quiz]
    assert len(set(idents)) == len(idents)
    for quiz in quizzes:
        assert {canvas_kind(item) for item in quiz} == {
            "numerical_question",
            "multiple_choice_question",
        }
        assert sum(map(canvas_points, quiz)) == pytest.approx(POINTS * COUNT, abs=1e-6)


def test_a_bank_is_the_same_bytes_every_time() -> None:
    for kind in BankFormat:
        assert write(bank(), kind, ENGLISH) == written(kind)


def test_numbers_are_asked_for_in_one_definite_form() -> None:
    for _, one, form in of_numbers():
        text = moodle_of(0, one.exercise.number).findtext("questiontext/text") or ""
        assert "positive multiple" not in text
        assert ENGLISH.decimals in unescape(text)
        assert not form.question.any_length
        if form.question.is_direction:
            length = sum(field.right**2 for field in form.fields)
            assert float(length) == pytest.approx(1)


def test_of_two_normals_of_a_flattened_surface_the_one_that_the_words_name_is_right() -> None:
    flat = 0
    for i in range(40):
        grader = exercise(9, Sheet(str(i), "Ada")).grader
        assert isinstance(grader, Computed)
        form = numbers_of(definite(grader.question))
        if form.is_flat:
            flat += 1
            assert next(field.right for field in form.fields if field.right) > 0
    assert flat > 5


def test_decimals_have_a_point_and_no_exponent() -> None:
    assert decimal(Fraction(1, 10**9)) == "0.000000001"
    assert decimal(Fraction(-1, 10**12)) == "0"
    assert decimal(Fraction(10**7)) == "10000000"


def test_every_language_words_the_same_things() -> None:
    form = numbers_of(next(of_numbers())[2].question)
    wrong = next(one for field in form.fields for one in field.wrong)
    told = {feedback(wrong, WORDS[language]) for language in Language}
    assert len(told) == len(Language)
