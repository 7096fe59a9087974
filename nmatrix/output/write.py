"""Choose the writer of a format; only that one is loaded."""

from __future__ import annotations

from collections.abc import Callable
from importlib import import_module
from typing import cast

from nmatrix.enums import Format
from nmatrix.output.options import OutputOptions
from nmatrix.report import Report

_MODULES = {
    Format.TEXT: "text",
    Format.JSON: "jsontext",
    Format.CSV: "csvtext",
    Format.LATEX: "latex",
    Format.MARKDOWN: "markdown",
    Format.MATHML: "mathml",
    Format.TYPST: "typst",
    Format.GLSL: "glsl",
    Format.JS: "js",
    Format.NUMPY: "numpytext",
}


def write(report: Report, options: OutputOptions) -> str:
    """Return the report as one text in the chosen format, ending in a newline.

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
    module = import_module(f"nmatrix.output.{_MODULES[options.format]}")
    writer = cast("Callable[[Report, OutputOptions], str]", module.write)
    return writer(report, options)
