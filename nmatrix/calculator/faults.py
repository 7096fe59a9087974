"""Where an expression went wrong: one line, with a caret in front of the faulty character."""

from __future__ import annotations

from nmatrix.errors import IllegalValueError, NoAnswerError

WINDOW = 30  # characters shown on either side of the caret


class CalculatorError(IllegalValueError):
    """A fault in an expression; `position` counts characters from 0."""

    def __init__(self, what: str, why: str, next_step: str, position: int) -> None:
        super().__init__(what, why, next_step)
        self.position = position


class NoValueError(NoAnswerError):
    """An operation that has no answer; `position` counts characters from 0."""

    def __init__(self, what: str, why: str, next_step: str, position: int) -> None:
        super().__init__(what, why, next_step)
        self.position = position


def fault(expression: str, at: int, what: str, why: str) -> CalculatorError:
    """Return the error for an expression that is wrong at a character.

    Examples
    --------
    >>> print(fault("M.__class__", 1, "an attribute", "only .T may follow a dot"))
    an attribute (character 2): only .T may follow a dot; see the caret: M^.__class__
    """
    return CalculatorError(f"{what} (character {at + 1})", why, _caret(expression, at), at)


def no_value(expression: str, at: int, what: str, why: str) -> NoValueError:
    """Return the error for a sound expression with an operation that has no answer.

    Examples
    --------
    >>> print(no_value("1/0", 1, "/", "nothing is divided by 0"))
    / (character 2): nothing is divided by 0; see the caret: 1^/0
    """
    return NoValueError(f"{what} (character {at + 1})", why, _caret(expression, at), at)


def _caret(expression: str, at: int) -> str:
    before = expression[max(0, at - WINDOW) : at]
    after = expression[at : at + WINDOW]
    opening = "…" if at > WINDOW else ""
    closing = "…" if at + WINDOW < len(expression) else ""
    return f"see the caret: {opening}{_visible(before)}^{_visible(after)}{closing}"


def _visible(text: str) -> str:
    """Return the text with whatever a terminal would act on spelled out."""
    return "".join(
        character if character.isprintable() else character.encode("unicode_escape").decode()
        for character in text
    )
