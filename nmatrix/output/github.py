"""GitHub's workflow commands: a line for each finding, which an action shows beside the file.

The percent sign and line ends are escaped, in a property the colon and the comma too, as GitHub's
own toolkit does it; so no name in a file can end a command or begin one.
"""

from __future__ import annotations

from nmatrix.enums import Severity
from nmatrix.output.sarif import findings_of
from nmatrix.output.style import printable
from nmatrix.output.write import OutputOptions
from nmatrix.report import Finding, Report

COMMANDS = {
    Severity.ERROR: "error",
    Severity.WARNING: "warning",
    Severity.NOTE: "notice",
}


def write(report: Report, options: OutputOptions) -> str:
    r"""Write the findings of a report as workflow commands; without any, nothing.

    Raises
    ------
    IllegalValueError
        If the command looks for no faults.

    Examples
    --------
    >>> from nmatrix.report import Finding, Findings, Rule
    >>> found = Finding(Rule("A01", "Odd", "", ""), Severity.NOTE, "50% off\n", "a,b.obj")
    >>> write(Report("lint", {}, (), findings=Findings((), (found,))), OutputOptions())
    '::notice file=a%2Cb.obj,title=A01 Odd::50%25 off%0A\n'
    """
    return "".join(_command(one) for one in findings_of(report, options).found)


def _command(one: Finding) -> str:
    properties = {
        "file": one.file,
        "line": str(one.line) if one.line else "",
        "col": str(one.column) if one.line and one.column else "",
        "title": f"{one.rule.code} {one.rule.name}",
    }
    listed = ",".join(f"{name}={_property(value)}" for name, value in properties.items() if value)
    return f"::{COMMANDS[one.severity]} {listed}::{_message(one.message)}\n"


def _message(text: str) -> str:
    escaped = text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")
    return printable(escaped)


def _property(text: str) -> str:
    return _message(text).replace(":", "%3A").replace(",", "%2C")
