"""A session of the calculator: names that have values, settings, and the statements that made them.

A `Session` is frozen: a statement makes another one, one that fails leaves it as it is, and `undo`
goes back to the one before.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Protocol

from nmatrix.calculator.answer import keys, value_report, worked
from nmatrix.calculator.arithmetic.values import Arithmetic, Value
from nmatrix.calculator.evaluate import Calculation, calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.language.faults import CalculatorError
from nmatrix.calculator.language.grammar import parse
from nmatrix.calculator.language.statements import Statement, is_matrix, without_comments
from nmatrix.calculator.names import ANSWERS, value_of
from nmatrix.enums import Format, InverseBy, Layout, Numbers
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.reading.matrix import matrix_literal
from nmatrix.report import Report
from nmatrix.report import Value as JsonValue


class Files(Protocol):
    """What reads and writes the files that a session names."""

    def read(self, name: str) -> str:
        """Read a file of statements."""
        ...

    def write(self, name: str, text: str, *, force: bool) -> None:
        """Write a file, over an existing one only with `force`."""
        ...


class NoFiles:
    """The files of a file that is loaded: it reads and writes no other."""

    def read(self, name: str) -> str:
        """Refuse to read a file."""
        raise IllegalValueError(f"load ({name[:40]})", "a loaded file loads no other", "load both")

    def write(self, name: str, text: str, *, force: bool) -> None:
        """Refuse to write a file."""
        raise IllegalValueError(f"save ({name[:40]})", "a loaded file writes none", "write it here")


@dataclass(frozen=True)
class Settings:
    """How values are computed and shown: what the options of `nmatrix calc` begin with."""

    steps: bool = False
    by: InverseBy | None = None
    numbers: Numbers = Numbers.EXACT
    digits: int = 6
    arithmetic: Arithmetic = Arithmetic.EXACT
    untyped: bool = False
    layout: Layout | None = None  # of matrices in other notations


@dataclass(frozen=True)
class Reply:
    """What a statement comes to: a report in a format, or an error and where it lies.

    `at` is the character of the statement that the caret stands under, if there is one, and
    `keys` what data says of a value.
    """

    report: Report | None = None
    keys: Mapping[str, JsonValue] = field(default_factory=dict)
    format: Format = Format.TEXT
    error: NMatrixError | None = None
    at: int | None = None
    quits: bool = False


@dataclass(frozen=True)
class Session:
    """The values by their names, the settings, and what led there.

    Parameters
    ----------
    entered
        The statements that changed something, which `save` writes.
    before
        The session that `undo` goes back to.
    own_files
        What was saved or loaded here, and may be written again.
    """

    names: Mapping[str, Value]
    settings: Settings = Settings()
    entered: tuple[str, ...] = ()
    before: Session | None = field(default=None, repr=False, compare=False)
    own_files: frozenset[str] = frozenset()

    def valued(self, asked: Statement) -> tuple[Session, Reply]:
        """Compute an expression and keep its value, under a name or as the last one.

        Raises
        ------
        IllegalValueError, NoAnswerError
            Where the expression does.
        """
        found = self.calculation(asked.text)
        name = asked.name or ANSWERS[0]
        names = {**self.names, name: found.value}
        if asked.name is None and ANSWERS[0] in self.names:
            names[ANSWERS[1]] = self.names[ANSWERS[0]]
        steps = worked(found, self.settings.by) if self.settings.steps else None
        report = value_report(name, found, steps or ())
        return self.changed(asked, names=names), Reply(report, keys(found, steps))

    def shown(self, name: str) -> Report:
        """Report a value again."""
        found = Calculation(name, self.names[name], Arithmetic.EXACT, ())
        return value_report(name, found)

    def changed(self, asked: Statement, **fields: object) -> Session:
        """Put other names or settings in place of these, as a statement asked."""
        entered = (*self.entered, asked.whole)
        return replace(self, entered=entered, before=self, **fields)  # type: ignore[arg-type]  # its own

    def calculation(self, text: str) -> Calculation:
        """Compute an expression, or read a matrix in a notation that is none.

        Raises
        ------
        CalculatorError, NoValueError
            As `calculate` does.
        """
        if is_matrix(text):
            return self._read(text)
        try:
            parse(text, frozenset((*FUNCTIONS, *self.names)))
        except CalculatorError as fault:
            is_marked_up = text.startswith(("\\", "<", "$"))  # where = is a part of it
            if text.startswith("|") or ("=" in text and not is_marked_up):
                raise  # neither -3 is meant by |-3|, nor the value of A[0, 0] = 5
            try:
                return self._read(text)
            except IllegalValueError:
                raise fault from None
        how = self.settings
        return calculate(text, self.names, how.arithmetic, untyped=how.untyped)

    def _read(self, text: str) -> Calculation:
        found = matrix_literal(without_comments(text), self.settings.layout)
        value = value_of(found.rows_exact).kept_by(self.settings.arithmetic)
        return Calculation(text, value, self.settings.arithmetic, (), found.remarks)
