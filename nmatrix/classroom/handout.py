"""One handout: the topics that were asked for, a student's exercises, and the key, kept apart."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from nmatrix.classroom.first_page import CLAIM, Part
from nmatrix.classroom.topics import PARTS, Topic
from nmatrix.classroom.words import WORDS, Language, Words
from nmatrix.lessons.exercises.scheme import SCHEME, Sheet
from nmatrix.output.pages.document import (
    WITH_PICTURES_BESIDE,
    Document,
    Field,
    PageFormat,
    Paper,
    write,
)
from nmatrix.report import Blank, Block, Code, Figure, Formula, Heading, Task, Text
from nmatrix.scene.setup import Setup
from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.lessons.exercises.exercise import Exercise

LONGEST_WORD = 32  # of a command on paper, which has one line for it


@dataclass(frozen=True)
class HandoutPlan:
    """What every sheet of a run has in common."""

    topics: tuple[Topic, ...]
    setup: Setup
    exercises: int = 0
    kind: PageFormat = PageFormat.HTML
    paper: Paper = Paper.A4
    with_key: bool = False
    prefix: str = ""  # of the names of pictures that lie beside the sheet
    title: str = ""  # what stands above the claim: the course, the sheet, the date
    points: int | None = None  # of each exercise
    language: Language = Language.ENGLISH

    @property
    def words(self) -> Words:
        """The fixed words."""
        return WORDS[self.language]

    @property
    def usual_title(self) -> str:
        """The title of a sheet that does not begin with its claim."""
        is_drill = self.topics == (Topic.EXERCISES,)
        return self.words.exercises if is_drill else self.words.theory

    @property
    def note(self) -> str:
        """The small print."""
        return f"nmatrix {__version__}, scheme {SCHEME}"


@dataclass(frozen=True)
class StudentFiles:
    """The files of one student: the sheet, and the key if it was asked for."""

    sheet: bytes
    key: bytes | None


def student_files(plan: HandoutPlan, sheet: Sheet) -> StudentFiles:
    """Make the files of one student."""
    document = handout(plan, sheet)
    key = write(key_of(plan, sheet), plan.kind) if plan.with_key else None
    return StudentFiles(write(document, plan.kind), key)


def pictures_beside(plan: HandoutPlan) -> dict[str, bytes]:
    """Draw the pictures that lie beside every sheet, by name; HTML and PDF hold theirs."""
    if plan.kind not in WITH_PICTURES_BESIDE:
        return {}
    parts = (_common(one, plan.setup, plan.kind) for one in plan.topics if one in PARTS)
    return {name: picture for part in parts for name, picture in _named(part, plan.prefix).items()}


def handout(plan: HandoutPlan, sheet: Sheet) -> Document:
    """Compose the sheet of one student."""
    blocks: list[Block] = []
    pictures: dict[str, bytes] = {}
    for topic in plan.topics:
        if topic is Topic.EXERCISES:
            blocks += _asked(plan, sheet)
        else:
            found = _common(topic, plan.setup, plan.kind)
            blocks += [_beside(one, plan.prefix) for one in found.blocks]
            pictures |= _named(found, plan.prefix)
    title = CLAIM if Topic.RULE in plan.topics else plan.usual_title
    foot = _foot(plan, sheet)
    return Document(title, tuple(blocks), _head(plan, sheet), foot, pictures, plan.paper)


def key_of(plan: HandoutPlan, sheet: Sheet) -> Document:
    """Compose the worked answers to a student's exercises."""
    blocks: list[Block] = []
    for one in _exercises(plan.exercises, sheet):
        blocks += [Heading(one.title), *one.key]
    head, foot = _head(plan, sheet), _foot(plan, sheet)
    return Document(plan.words.key, tuple(blocks), head, foot, paper=plan.paper)


@lru_cache(maxsize=1)  # a sheet and its key have the same ones
def _exercises(count: int, sheet: Sheet) -> tuple[Exercise, ...]:
    from nmatrix.lessons.exercises.sheet import exercises  # a sheet without any starts sooner

    return exercises(count, sheet)


@lru_cache(maxsize=32)  # a class shares its theory and its pictures
def _common(topic: Topic, setup: Setup, kind: PageFormat) -> Part:
    return PARTS[topic](setup, kind)


def _named(part: Part, prefix: str) -> dict[str, bytes]:
    return {prefix + name: picture for name, picture in part.pictures.items()}


def _beside(block: Block, prefix: str) -> Block:
    return replace(block, path=prefix + block.path) if isinstance(block, Figure) else block


def _asked(plan: HandoutPlan, sheet: Sheet) -> Iterator[Block]:
    for one in _exercises(plan.exercises, sheet):
        is_worked_out = any(isinstance(block, Formula) for block in (*one.asked, *one.key))
        blank = Blank(*one.cells, has_room=is_worked_out)
        yield Task(one.title, (*one.asked, blank), plan.points)
    yield from _how_to_check(sheet, plan.words)


def _how_to_check(sheet: Sheet, words: Words) -> Iterator[Block]:
    """Explain the check of an answer; a salted sheet is checked by whoever has the salt."""
    yield Heading(words.are_they_right)
    if sheet.salt:
        yield Text(words.is_graded)
        return
    line = ["nmatrix", "check", "exercise", "1", words.your_answer, "--seed", sheet.seed]
    if sheet.student:
        is_short = len(_in_quotes(sheet.student)) <= LONGEST_WORD
        line += ["--student", sheet.student if is_short else words.your_name]
    yield Text(words.command_says)
    yield Code("sh", f"{' '.join(map(_in_quotes, line))}\n")


def _in_quotes(word: str) -> str:
    """Quote a word for every shell: plain, or in double quotes if that is enough."""
    if word.isascii() and word.replace("-", "").isalnum():
        return word
    is_tame = all(c.isalnum() or c in " ,.'-" for c in word)
    return f'"{word}"' if is_tame else shlex.quote(word)


def _head(plan: HandoutPlan, sheet: Sheet) -> tuple[Field, ...]:
    """Head a sheet by what the teacher calls it, or by lines to fill in, and by its student."""
    words = plan.words
    to_fill_in = (
        Field(words.course, room=32),
        Field(words.sheet, room=10),
        Field(words.date, room=22),
    )
    called = (Field("", plan.title),) if plan.title else to_fill_in
    return (*called, Field(words.name, sheet.student, 44))


def _foot(plan: HandoutPlan, sheet: Sheet) -> str:
    """Name the student and the seed on every page: sheets get dropped, and answers checked."""
    seed = f"seed {sheet.seed}" if Topic.EXERCISES in plan.topics else ""
    return " · ".join(part for part in (sheet.student, seed, plan.note) if part)
