"""Choose the writer of a format; only that one is loaded."""

from __future__ import annotations

from typing import Protocol, assert_never

from nmatrix.enums import Format
from nmatrix.output.options import OutputOptions
from nmatrix.report import Report


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
    return _writer(options.format)(report, options)


def _writer(chosen: Format) -> Writer:  # noqa: C901  # one branch for each format
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
        case _:
            assert_never(chosen)
    return found
