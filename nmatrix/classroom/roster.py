"""A class list: every row a student, every student a file name of their own."""

from __future__ import annotations

import re
from collections.abc import Iterable
from dataclasses import dataclass
from unicodedata import normalize

from nmatrix.errors import IllegalValueError
from nmatrix.reading.records import Record

COLUMN = "student"
LONGEST_NAME, LONGEST_SLUG = 200, 40
_NOT_PLAIN = re.compile(r"[^a-z0-9]+")


@dataclass(frozen=True)
class Student:
    """A student and the beginning of their files' names."""

    name: str
    stem: str


def students(records: Iterable[Record], source: str) -> tuple[Student, ...]:
    """Read the students of a list, in its order.

    Raises
    ------
    IllegalValueError
        For a row without a name, a name that is too long or used twice, or no row at all.
    """
    found: list[Student] = []
    lines: dict[str, int] = {}
    for record in records:
        name = " ".join(normalize("NFC", record.cells[COLUMN]).split())
        if record.fault or not name or len(name) > LONGEST_NAME:
            why = record.fault or f"a name has 1 to {LONGEST_NAME} characters"
            raise _refusal(source, record.line, name, why, "mend the row")
        if name in lines:
            why = f"line {lines[name]} has the same name, so the sheets would be alike"
            raise _refusal(source, record.line, name, why, "add an initial, or leave the row out")
        lines[name] = record.line
        found.append(Student(name, stem_of(len(found), name)))
    if not found:
        raise IllegalValueError(f"roster ({source})", "it names no student", "add a row")
    return tuple(found)


def stem_of(place: int, name: str) -> str:
    """Begin the names of a student's files: the place in the list, and the name."""
    return f"{place + 1:04}-{slug(name)}"


def file_names(stem: str, ending: str, *, with_key: bool) -> tuple[str, ...]:
    """Name a student's files: the sheet, then the key."""
    sheet = f"{stem}.{ending}"
    return (sheet, f"{stem}-key.{ending}") if with_key else (sheet,)


def slug(name: str) -> str:
    """Spell a name in the plain letters that every file system knows.

    Examples
    --------
    >>> slug("Åsa O'Hara-Lee <script>"), slug("李")
    ('asa-o-hara-lee-script', 'student')
    """
    plain = normalize("NFKD", name).encode("ascii", "ignore").decode().lower()
    return _NOT_PLAIN.sub("-", plain).strip("-")[:LONGEST_SLUG].strip("-") or "student"


def _refusal(source: str, line: int, name: str, why: str, next_step: str) -> IllegalValueError:
    return IllegalValueError(f"roster ({source}), line {line} ({name[:30]})", why, next_step)
