"""The formats of question banks, and the writer of each; only the chosen one is loaded."""

from __future__ import annotations

from enum import StrEnum
from typing import TYPE_CHECKING, assert_never

if TYPE_CHECKING:
    from nmatrix.classroom.bank.question import Bank
    from nmatrix.classroom.words import Words


class BankFormat(StrEnum):
    """The platforms that question banks are written for."""

    MOODLE = "moodle"
    QTI = "qti"
    CANVAS = "canvas"

    @property
    def ending(self) -> str:
        """How the name of its file ends."""
        return ".xml" if self is BankFormat.MOODLE else ".zip"

    @property
    def how_to_import(self) -> str:
        """What to do with the file."""
        return _IMPORTED[self]

    @property
    def limits(self) -> tuple[str, ...]:
        """What the platform cannot hold."""
        return _LIMITS[self]


_IMPORTED = {
    BankFormat.MOODLE: "In Moodle: Question bank, Import, Moodle XML format.",
    BankFormat.QTI: "Import it as a QTI 2.1 package.",
    BankFormat.CANVAS: "In Canvas: Settings, Import Course Content, QTI .zip file.",
}
_DIGITS = (
    "The platform compares each number by itself, within 5e-4 of the largest of its kind or "
    "0.0001, and reads no fractions."
)
_LIMITS = {
    BankFormat.MOODLE: (
        _DIGITS,
        "Moodle counts one mark for each number of an exercise: set the exercise's marks in the "
        "quiz.",
    ),
    BankFormat.QTI: (_DIGITS,),
    BankFormat.CANVAS: (
        _DIGITS,
        "Canvas gives every listed number full marks, so wrong ones are not listed: the known "
        "mistakes stand in the general feedback, whatever was answered.",
    ),
}


def write(bank: Bank, kind: BankFormat, words: Words) -> bytes:
    """Write a bank as one file."""
    match kind:
        case BankFormat.MOODLE:
            from nmatrix.classroom.bank.moodle import moodle as found
        case BankFormat.QTI:
            from nmatrix.classroom.bank.qti import qti as found
        case BankFormat.CANVAS:
            from nmatrix.classroom.bank.canvas import canvas as found
        case _:
            assert_never(kind)
    return found(bank, words)
