"""One handout: the topics that were asked for, a student's exercises, and the key, kept apart."""

from __future__ import annotations

import shlex
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING

from nmatrix.classroom.topics import PARTS, Part, Topic
from nmatrix.lessons.exercises.scheme import SCHEME, Sheet
from nmatrix.output.pages.document import WITH_PICTURES_BESIDE, Document, PageFormat, Paper, write
from nmatrix.report import Blank, Block, Code, Figure, Heading, Text
from nmatrix.scene.setup import Setup
from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.lessons.exercises.exercise import Exercise

LONGEST_WORD = 32  # of a command on paper, which has one line for it
TITLE = "Normals, spaces and lights"


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

    @property
    def note(self) -> str:
        """The small print."""
        return f"nmatrix {__version__}, exercises by the scheme {SCHEME}"


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
    return dict(_theory(plan)[1]) if plan.kind in WITH_PICTURES_BESIDE else {}


def handout(plan: HandoutPlan, sheet: Sheet) -> Document:
    """Compose the sheet of one student."""
    theory, pictures = _theory(plan)
    blocks = (*theory, *_asked(plan, sheet))
    return Document(TITLE, blocks, _whose(plan, sheet), pictures, plan.note, plan.paper)


def _theory(plan: HandoutPlan) -> tuple[list[Block], dict[str, bytes]]:
    """Compose the part that all sheets of a run have in common, with its pictures."""
    blocks: list[Block] = []
    pictures: dict[str, bytes] = {}
    for topic in plan.topics:
        if topic is not Topic.EXERCISES:
            found = _common(topic, plan.setup)
            blocks += [_beside(one, plan.prefix) for one in found.blocks]
            pictures |= {plan.prefix + name: one for name, one in found.pictures.items()}
    return blocks, pictures


def key_of(plan: HandoutPlan, sheet: Sheet) -> Document:
    """Compose the worked answers to a student's exercises."""
    blocks: list[Block] = []
    for one in _exercises(plan.exercises, sheet):
        blocks += [Heading(one.title), *one.key]
    title = f"{TITLE}: the key"
    return Document(title, tuple(blocks), _whose(plan, sheet), {}, plan.note, plan.paper)


@lru_cache(maxsize=1)  # a sheet and its key have the same ones
def _exercises(count: int, sheet: Sheet) -> tuple[Exercise, ...]:
    from nmatrix.lessons.exercises.sheet import exercises  # a sheet without any starts sooner

    return exercises(count, sheet)


@lru_cache(maxsize=32)  # a class shares its theory and its pictures
def _common(topic: Topic, setup: Setup) -> Part:
    return PARTS[topic](setup)


def _beside(block: Block, prefix: str) -> Block:
    return replace(block, path=prefix + block.path) if isinstance(block, Figure) else block


def _asked(plan: HandoutPlan, sheet: Sheet) -> Iterator[Block]:
    if Topic.EXERCISES in plan.topics:
        for one in _exercises(plan.exercises, sheet):
            yield Heading(one.title)
            yield from one.task
            yield Blank(*one.cells)
        yield from _how_to_check(sheet)


def _how_to_check(sheet: Sheet) -> Iterator[Block]:
    """Explain the check of an answer; a salted sheet is checked by whoever has the salt."""
    yield Heading("Are your answers right?")
    if sheet.salt:
        yield Text("This sheet is part of a graded test: your teacher has what checks it.")
        return
    words = ["nmatrix", "check", "exercise", "1", "YOUR ANSWER", "--seed", sheet.seed]
    if sheet.student:
        is_short = len(_in_quotes(sheet.student)) <= LONGEST_WORD
        words += ["--student", sheet.student if is_short else "YOUR NAME, AS IT STANDS ABOVE"]
    yield Text("This command says so, and names the mistake if there is one:")
    yield Code("sh", f"{' '.join(map(_in_quotes, words))}\n")


def _in_quotes(word: str) -> str:
    """Quote a word for every shell: plain, or in double quotes if that is enough."""
    if word.isascii() and word.replace("-", "").isalnum():
        return word
    is_tame = all(c.isalnum() or c in " ,.'-" for c in word)
    return f'"{word}"' if is_tame else shlex.quote(word)


def _whose(plan: HandoutPlan, sheet: Sheet) -> str:
    if Topic.EXERCISES not in plan.topics:
        return sheet.student
    name = sheet.student or "Name: ____________________"
    return f"{name} · seed {sheet.seed}"
