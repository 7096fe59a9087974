"""A question bank as Moodle XML: a cloze question with a field for each number, or a choice.

Moodle takes the first answer of a field that a number is within the tolerance of, so the right one
comes first and the mistakes follow in the order of their table, at no credit. Exercises of one
number stand in one category: a quiz that draws from it at random gives each student other numbers.
"""

from __future__ import annotations

from html import escape
from xml.etree import ElementTree as ET

from nmatrix.classroom.bank.package import leaf, written
from nmatrix.classroom.bank.question import Bank, BankQuestion, NumberField, Numbers, decimal
from nmatrix.classroom.bank.text import allowed, asked, feedback
from nmatrix.classroom.words import Words
from nmatrix.lessons.exercises.exercise import Choice
from nmatrix.output.mathml import prose

# In feedback these end an answer, and Moodle reads entities after it has parted the answers.
_SEPARATORS = str.maketrans({"~": "&#126;", "}": "&#125;", "\\": "&#92;"})


def moodle(bank: Bank, words: Words) -> bytes:
    """Write a bank as one XML file."""
    quiz = ET.Element("quiz")
    for same in zip(*bank.sheets, strict=True):
        _category(quiz, bank.name, same[0].exercise.title)
        for one in same:
            _question(quiz, one, bank.points, words)
    return written(quiz)


def _category(quiz: ET.Element, *names: str) -> None:
    """Open a category; a stroke parts their names, and two are one that is meant."""
    question = ET.SubElement(quiz, "question", {"type": "category"})
    path = "/".join(filter(None, (allowed(name).replace("/", "//") for name in names)))
    _text(question, "category", f"$course$/top/{path}")


def _question(quiz: ET.Element, one: BankQuestion, points: int, words: Words) -> None:
    is_choice = isinstance(one.form, Choice)
    question = ET.SubElement(quiz, "question", {"type": "multichoice" if is_choice else "cloze"})
    _text(question, "name", allowed(one.title))
    if isinstance(one.form, Numbers):
        _text(question, "questiontext", f"{asked(one, words)}\n{_fields(one.form, words)}", "html")
        return
    _text(question, "questiontext", asked(one, words), "html")
    for tag, text in (
        ("defaultgrade", str(points)),
        ("single", "true"),
        ("shuffleanswers", "false"),
        ("answernumbering", "abc"),
    ):
        leaf(question, tag, text)
    for i, option in enumerate(one.form.options):
        fraction = "100" if i == one.form.right else "0"
        answer = ET.SubElement(question, "answer", {"fraction": fraction, "format": "html"})
        leaf(answer, "text", prose(option.text))
        _text(answer, "feedback", prose(option.because), "html")


def _text(parent: ET.Element, tag: str, text: str, kind: str = "") -> None:
    leaf(ET.SubElement(parent, tag, {"format": kind} if kind else {}), "text", text)


def _fields(numbers: Numbers, words: Words) -> str:
    """Lay fields out as a table: a matrix as it stands, a vector with its letters before it."""
    names = numbers.coordinates
    rows = (
        (f"<td>{names[i]} =</td>" if names else "")
        + "".join(f"<td>{_cloze(field, words)}</td>" for field in row)
        for i, row in enumerate(numbers.rows)
    )
    return f"<table>{''.join(f'<tr>{row}</tr>' for row in rows)}</table>"


def _cloze(field: NumberField, words: Words) -> str:
    """Write one field in the embedded language: the right number, then the known wrong ones."""
    tolerance = decimal(field.tolerance)
    answers = [f"={decimal(field.right)}:{tolerance}#{_quoted(words.right)}"]
    answers += (
        f"%0%{decimal(wrong.value)}:{tolerance}#{_quoted(feedback(wrong, words))}"
        for wrong in field.wrong
    )
    return f"{{1:NUMERICAL:{'~'.join(answers)}}}"


def _quoted(sentence: str) -> str:
    """Write a sentence as HTML whose entities survive being read once more."""
    return escape(escape(sentence, quote=False), quote=False).translate(_SEPARATORS)
