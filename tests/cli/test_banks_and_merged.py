"""`nmatrix handout` for platforms, for one printed file, and in other languages."""

from __future__ import annotations

import json
import re
from pathlib import Path
from xml.etree import ElementTree as ET

import pytest
from platforms import canvas_items, moodle_questions, unpacked

from nmatrix.classroom.bank.write import BankFormat
from nmatrix.classroom.handout import HandoutPlan, handout, key_of
from nmatrix.classroom.topics import Topic
from nmatrix.classroom.words import WORDS, Language, Words
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.italian import ITALIAN
from nmatrix.output.pages.page_pdf import pdf_of
from nmatrix.output.pages.page_typst import typ_of
from nmatrix.report import Heading
from nmatrix.scene.setup import Setup


@pytest.fixture(autouse=True)
def _in_a_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("class.csv").write_text('Name\n"Lovelace, Ada"\n李小龍\n=1+1\n', encoding="utf-8")


def test_a_class_becomes_a_bank_of_its_names_on_every_platform(nmatrix):
    for kind in BankFormat:
        name = f"bank{kind.ending}"
        code, out, err = nmatrix(
            f"handout --to {kind} --roster class.csv --exercises 3 -o {name} --force -f json"
        )
        assert (code, err) == (0, "")
        assert json.loads(out)["files"] == [name]
        content = Path(name).read_bytes()
        if kind is BankFormat.MOODLE:
            titles = [one.findtext("name/text") or "" for one in moodle_questions(content)]
        elif kind is BankFormat.CANVAS:
            titles = [one.get("title", "") for quiz in canvas_items(content) for one in quiz]
        else:
            items = [
                ET.fromstring(one) for path, one in unpacked(content).items() if "item" in path
            ]
            titles = [one.get("title", "") for one in items]
        for student in ("Lovelace, Ada", "李小龍", "=1+1"):
            assert any(student in title for title in titles)


def test_variants_are_sheets_that_check_knows(nmatrix):
    assert nmatrix("handout --to moodle --variants 2 --exercises 2 --seed 9 -o b.xml")[0] == 0
    content = Path("b.xml").read_bytes()
    titles = [one.findtext("name/text") or "" for one in moodle_questions(content)]
    assert [title.partition(" · ")[2] for title in titles] == ["variant 1", "variant 2"] * 2
    again = "handout --to moodle --student 'variant 2' --exercises 2 --seed 9 -o c.xml"
    assert nmatrix(again)[0] == 0
    alone = Path("c.xml").read_text(encoding="utf-8")
    for field in re.findall(r"\{1:NUMERICAL:=[^#]*#", alone):
        assert field in content.decode()


REFUSED = (
    ("handout --to moodl", "did you mean moodle?"),
    ("handout --to moodle -o bank.zip", ".xml"),
    ("handout --to qti -o bank.xml", ".zip"),
    ("handout --to canvas --variants 0", "--variants"),
    ("handout --to canvas --variants 9 --roster class.csv", "leave one of them out"),
    ("handout --to moodle --key", "grades by itself"),
    ("handout --to moodle --topics rule", "holds exercises"),
    ("handout --to moodle --scale 1 2 1", "numbers of their own"),
    ("handout --variants 3", "--to moodle"),
    ("handout --merged all.pdf", "--roster"),
    ("handout --merged all.pdf --roster class.csv -o out", "--output"),
    ("handout --merged all.pdf --roster class.csv --to html", "--to"),
    ("handout --language fr", "en"),
    ("handout --to qti --roster class.csv --workers 2", "--workers"),
    ("handout --merged all.pdf --roster class.csv --dask x", "--dask"),
)


@pytest.mark.parametrize(("line", "words"), REFUSED)
def test_what_a_bank_or_a_merged_file_cannot_be_is_refused_in_one_line(nmatrix, line, words):
    code, out, err = nmatrix(line)
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert words in err


def test_a_bank_that_is_there_is_kept_unless_force_is_given(nmatrix):
    Path("b.xml").write_text("mine")
    line = "handout --to moodle --exercises 1 -o b.xml"
    assert nmatrix(line)[0] == 2
    assert Path("b.xml").read_text() == "mine"
    assert nmatrix(f"{line} --force")[0] == 0


def sheets(language: Language = Language.ENGLISH):
    plan = HandoutPlan((Topic.EXERCISES,), Setup(), 2, language=language)
    return [handout(plan, Sheet("7", name)) for name in ("Ada", "Bo")]


def test_merged_sheets_each_begin_on_a_right_hand_page_with_their_own_foot():
    pytest.importorskip("typst")
    source = typ_of(sheets(), "Class").decode()
    assert source.count('#pagebreak(weak: true, to: "odd")') == 2
    assert source.index("Ada · seed 7") < source.index("Bo · seed 7")
    found = pdf_of(sheets(), "Class")
    alone = pdf_of(sheets()[:1], "Class")
    pages = [len(re.findall(rb"/Type\s*/Page\b", one)) for one in (found, alone)]
    assert pages[0] > pages[1]
    assert (pages[0] - pages[1]) == pages[1] + pages[1] % 2
    assert found == pdf_of(sheets(), "Class")


def test_a_class_is_merged_with_its_keys_beside_it(nmatrix):
    pytest.importorskip("typst")
    Path("two.csv").write_text("student\nAda\nBo\n")
    line = "handout --roster two.csv --exercises 1 --merged all.pdf --key --points 3 -f json"
    code, out, _ = nmatrix(line)
    assert code == 0
    assert json.loads(out)["files"] == ["all.pdf", "all-key.pdf"]
    assert all(Path(name).read_bytes().startswith(b"%PDF") for name in ("all.pdf", "all-key.pdf"))
    assert nmatrix(line)[0] == 2


def test_every_fixed_word_is_translated_with_the_same_places_to_fill_in():
    english = vars(WORDS[Language.ENGLISH])
    for language in Language:
        assert WORDS[language].language is language
        words = {name: word for name, word in vars(WORDS[language]).items() if name != "language"}
        for name, word in words.items():
            places = re.findall(r"\{\w+\}", english[name])
            assert re.findall(r"\{\w+\}", word) == places
            may_be_alike = language is Language.ENGLISH or name == "name"
            assert may_be_alike or word != english[name], (language, name)
    assert WORDS[Language.ENGLISH] == Words()


@pytest.mark.parametrize("language", Language)
def test_a_sheet_and_its_key_have_the_words_of_their_language(language):
    words = WORDS[language]
    one = sheets(language)[0]
    assert one.title == words.exercises
    assert [field.label for field in one.head] == [
        words.course,
        words.sheet,
        words.date,
        words.name,
    ]
    assert Heading(words.are_they_right) in one.blocks
    plan = HandoutPlan((Topic.EXERCISES,), Setup(), 1, language=language)
    assert key_of(plan, Sheet()).title == words.key


def test_every_mistake_is_told_in_italian_with_the_letters_and_numbers_of_the_english():
    symbols = re.compile(
        r"[A-Z]·[A-Z](?:·[A-Z])?|[A-Z][⁻ᵀ¹]+|\d+×\d+|π/180|[fn]+/\(f − n\)|OpenGL|Vulkan"
    )
    assert list(ITALIAN) == list(MistakeId)
    for mistake, (did, rule) in ITALIAN.items():
        english = MISTAKES[mistake].explanation
        assert sorted(symbols.findall(f"{did} {rule}")) == sorted(symbols.findall(english)), mistake
        assert did.endswith(".")
        assert rule.endswith(".")
        assert did != MISTAKES[mistake].did


def test_an_italian_bank_tells_mistakes_in_italian(nmatrix):
    assert nmatrix("handout --to moodle --exercises 1 --language it -o b.xml")[0] == 0
    text = Path("b.xml").read_text(encoding="utf-8")
    assert WORDS[Language.ITALIAN].known in text
    assert not any(one.did in text for one in MISTAKES.values())
