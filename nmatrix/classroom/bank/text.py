"""What a platform shows: the task as HTML with MathML, the form, and the feedback of numbers."""

from __future__ import annotations

import re
from collections.abc import Sequence

from nmatrix.classroom.bank.question import BankQuestion, NumberField, Numbers, WrongNumber
from nmatrix.classroom.words import Language, Words
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.lessons.check.question import Subject
from nmatrix.lessons.italian import ITALIAN
from nmatrix.output.documents import blocks_in
from nmatrix.output.mathml import MathML
from nmatrix.output.write import OutputOptions
from nmatrix.report import Block, Text

_NOT_IN_XML = re.compile("[^\t\n\r\x20-\ud7ff\ue000-\ufffd\U00010000-\U0010ffff]")


def allowed(text: str) -> str:
    r"""Leave out the characters that no XML file may hold, such as control characters.

    Examples
    --------
    >>> allowed("A\x00da")
    'Ada'
    """
    return _NOT_IN_XML.sub("", text)


def html(blocks: Sequence[Block]) -> str:
    """Write blocks as HTML that is XML too, with formulas as MathML."""
    return blocks_in(blocks, MathML(OutputOptions()))


def form(numbers: Numbers, words: Words) -> str:
    """Tell how the numbers are to be written."""
    told = [words.decimals]
    if numbers.is_flat:
        told.insert(0, words.one_of_two)
    elif numbers.question.unit:
        is_matrix = numbers.question.subject is Subject.NORMAL and not numbers.question.is_vector
        told.insert(0, words.matrix_itself if is_matrix else words.unit_vector)
    return " ".join(told)


def asked(question: BankQuestion, words: Words) -> str:
    """Write the task, and the form if numbers are asked for."""
    blocks = question.task
    if isinstance(question.form, Numbers):
        blocks = (*blocks, Text(form(question.form, words)))
    return html(blocks)


def place(field: NumberField, numbers: Numbers, words: Words) -> str:
    """Name the place of a field: x, or row 1, column 2."""
    if numbers.coordinates:
        return numbers.coordinates[field.row]
    return words.place.format(row=field.row + 1, column=field.column + 1)


def feedback(wrong: WrongNumber, words: Words) -> str:
    """Tell which mistakes give a number: the first with its rule, the others by what was done."""
    first, *others = wrong.mistakes
    told = [words.known, explained(first, words)]
    if others:
        told += [words.otherwise, *(_sentences(one, words)[0] for one in others)]
    return " ".join(told)


def explained(mistake: MistakeId, words: Words) -> str:
    """Write a mistake as feedback: what was done, and the rule that it broke."""
    return " ".join(_sentences(mistake, words))


def _sentences(mistake: MistakeId, words: Words) -> tuple[str, str]:
    """Take what was done and the rule, which are told in English and Italian."""
    if words.language is Language.ITALIAN:
        return ITALIAN[mistake]
    return MISTAKES[mistake].did, MISTAKES[mistake].rule
