"""How an answer is to be written, and the writer of each format; only the chosen one is loaded."""

from __future__ import annotations

from dataclasses import dataclass, replace
from enum import StrEnum
from typing import Protocol, assert_never

from nmatrix.enums import Format, Layout, Numbers
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.linear.values import whole
from nmatrix.report import Report

MOST_DIGITS = 17


class Charset(StrEnum):
    """Which characters the reader's terminal can show."""

    UNICODE = "unicode"
    ASCII = "ascii"


class Colour(StrEnum):
    """Whether text carries terminal colours."""

    PLAIN = "plain"
    ANSI = "ansi"


@dataclass(frozen=True)
class OutputOptions:
    """One format, and how people want to see their numbers.

    Parameters
    ----------
    digits
        Significant digits for people; machine formats print what round-trips.
    layout
        How json, csv, numpy and js order a matrix; glsl is column-major whatever it says.
    width
        Columns of text.
    full
        Whether text shows all of an answer that has a short form.
    numbers
        Whether people read fractions and roots, decimals, or both; None leaves it to the report.
    """

    format: Format = Format.TEXT
    digits: int = 6
    layout: Layout = Layout.ROW_MAJOR
    charset: Charset = Charset.UNICODE
    width: int = 80
    colour: Colour = Colour.PLAIN
    full: bool = False
    numbers: Numbers | None = None

    def __post_init__(self) -> None:
        object.__setattr__(self, "digits", whole(self.digits, "digits"))
        if not 1 <= self.digits <= MOST_DIGITS:
            raise IllegalValueError(
                f"{quantity('digits')} ({self.digits})",
                f"a float64 has 1 to {MOST_DIGITS} significant digits",
                f"try {quantity('digits')} 6",
            )


class Writer(Protocol):
    """What every format has: a module with a function `write`."""

    def __call__(self, report: Report, options: OutputOptions) -> str:
        """Write a report as one text that ends in a newline."""
        ...


def write(report: Report, options: OutputOptions) -> str:
    """Write a report as one text in the chosen format, ending in a newline.

    Raises
    ------
    IllegalValueError
        If the format can say nothing about this report, such as glsl without a number.

    Examples
    --------
    >>> answer = Report("calc", {"value": 2.0}, ())
    >>> print(write(answer, OutputOptions(Format.CSV)).splitlines()[-1])
    value,,,2.0
    """
    told, how = as_told(report, options)
    return _writer(options.format)(told, how)


def as_told(report: Report, options: OutputOptions) -> tuple[Report, OutputOptions]:
    """Settle how the numbers of a report are written, and spell the names in its sentences."""
    how = replace(options, numbers=options.numbers or report.numbers)
    of_floats = report.numbers is Numbers.DECIMAL is not how.numbers
    told = report.in_floats() if of_floats else report
    return told.spelled(str), how


def _writer(chosen: Format) -> Writer:  # noqa: C901, PLR0912  # one branch for each format
    match chosen:
        case Format.TEXT:
            from nmatrix.output.text import write as found
        case Format.JSON:
            from nmatrix.output.jsontext import write as found
        case Format.CSV:
            from nmatrix.output.csvtext import write as found
        case Format.LATEX:
            from nmatrix.output.latex import write as found
        case Format.MARKDOWN:
            from nmatrix.output.markdown import write as found
        case Format.MATHML:
            from nmatrix.output.mathml import write as found
        case Format.TYPST:
            from nmatrix.output.typst import write as found
        case Format.GLSL:
            from nmatrix.output.glsl import write as found
        case Format.JS:
            from nmatrix.output.js import write as found
        case Format.NUMPY:
            from nmatrix.output.numpytext import write as found
        case Format.SARIF:
            from nmatrix.output.sarif import write as found
        case Format.GITHUB:
            from nmatrix.output.github import write as found
        case Format.GRADESCOPE:
            from nmatrix.output.gradescope import write as found
        case _:
            assert_never(chosen)
    return found
