"""Errors in an expression: one line, with a caret in front of the faulty character."""

from __future__ import annotations

from nmatrix.calculator.meaning.operands import RefusedError
from nmatrix.errors import FrameError, IllegalValueError, NMatrixError, NoAnswerError

WINDOW = 30  # characters shown on either side of the caret


class PlacedError(NMatrixError):
    """An error at one character of an expression; `position` counts characters from 0.

    `without_caret` is for those who draw the caret themselves, under what was typed.
    """

    def __init__(self, expression: str, position: int, what: str, why: str) -> None:
        super().__init__(f"{what} (character {position + 1})", why, _caret(expression, position))
        self.position = position
        self.without_caret = NMatrixError(what, why)


class CalculatorError(PlacedError, IllegalValueError):
    """A fault in an expression.

    Examples
    --------
    >>> print(CalculatorError("M.__class__", 1, "an attribute", "only .T may follow a dot"))
    an attribute (character 2): only .T may follow a dot; see the caret: M^.__class__
    """


class NoValueError(PlacedError, NoAnswerError):
    """A sound expression with an operation that has no answer.

    Examples
    --------
    >>> print(NoValueError("1/0", 1, "/", "nothing is divided by 0"))
    / (character 2): nothing is divided by 0; see the caret: 1^/0
    """


class MeaningError(PlacedError, FrameError):
    """Spaces or kinds that do not fit; it knows the mistake and the nearest right form.

    The form is empty where numbers do not fit either.

    Examples
    --------
    >>> print(MeaningError("V @ l", 2, "@", RefusedError("l is in camera space"), "l"))
    @ (character 3): l is in camera space; write l; see the caret: V ^@ l
    """

    def __init__(
        self, expression: str, position: int, what: str, refused: RefusedError, instead: str = ""
    ) -> None:
        told = f"; write {instead}" if instead else "; untyped(x) forgets the space of x"
        named = f"; check calls it {refused.mistake}" if refused.mistake else ""
        super().__init__(expression, position, what, f"{refused.why}{told}{named}")
        self.instead, self.mistake = instead, refused.mistake


def _caret(expression: str, at: int) -> str:
    before = expression[max(0, at - WINDOW) : at]
    after = expression[at : at + WINDOW]
    opening = "…" if at > WINDOW else ""
    closing = "…" if at + WINDOW < len(expression) else ""
    return f"see the caret: {opening}{_visible(before)}^{_visible(after)}{closing}"


def _visible(text: str) -> str:
    """Escape the control characters of a text, which a terminal would act on."""
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode()
        for character in text
    )
