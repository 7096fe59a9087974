"""SARIF 2.1.0: findings as the JSON that code hosts and editors show beside a file.

Files are named relative to the working directory, as the standard wants it of a checkout.
"""

from __future__ import annotations

import json
from hashlib import sha256
from pathlib import Path
from urllib.parse import quote

from nmatrix.errors import IllegalValueError, quantity
from nmatrix.output.write import OutputOptions
from nmatrix.report import Finding, Findings, Report, Rule
from nmatrix.version import __version__

SCHEMA = "https://json.schemastore.org/sarif-2.1.0.json"


def write(report: Report, options: OutputOptions) -> str:
    """Write the findings of a report as a SARIF log of one run.

    Raises
    ------
    IllegalValueError
        If the command looks for no faults.

    Examples
    --------
    >>> log = json.loads(write(Report("lint", {}, (), findings=Findings((), ())), OutputOptions()))
    >>> log["version"], log["runs"][0]["results"]
    ('2.1.0', [])
    """
    findings = findings_of(report, options)
    places = {rule.code: place for place, rule in enumerate(findings.rules)}
    driver = {
        "name": "nmatrix",
        "version": __version__,
        "rules": [_rule(rule) for rule in findings.rules],
    }
    run = {
        "tool": {"driver": driver},
        "columnKind": "unicodeCodePoints",
        "results": [_result(one, places[one.rule.code]) for one in findings.found],
    }
    log = {"$schema": SCHEMA, "version": "2.1.0", "runs": [run]}
    return json.dumps(log, indent=2) + "\n"


def findings_of(report: Report, options: OutputOptions) -> Findings:
    """Take the findings of a report, which only a check of files has.

    Raises
    ------
    IllegalValueError
        For the report of any other command.
    """
    if report.findings is None:
        raise IllegalValueError(
            f"{quantity('format')} ({options.format})",
            f"it lists faults in files, and {report.command} looks for none",
            f"use {quantity('format')} json",
        )
    return report.findings


def _rule(rule: Rule) -> dict[str, object]:
    return {
        "id": rule.code,
        "name": rule.name,
        "shortDescription": {"text": rule.sentence},
        "help": {"text": rule.advice},
    }


def _result(one: Finding, place_of_rule: int) -> dict[str, object]:
    where: dict[str, object] = {"artifactLocation": {"uri": uri(one.file)}}
    if one.line:
        start = {"startLine": one.line}
        where["region"] = start | ({"startColumn": one.column} if one.column else {})
    location: dict[str, object] = {"physicalLocation": where}
    if one.place:
        location["logicalLocations"] = [{"fullyQualifiedName": one.place, "kind": "object"}]
    return {
        "ruleId": one.rule.code,
        "ruleIndex": place_of_rule,
        "level": one.severity.value,
        "message": {"text": one.message},
        "locations": [location],
        # Without it, findings of one rule on no line of one file are taken for one and the same.
        "partialFingerprints": {"primaryLocationLineHash": _fingerprint(one)},
    }


def _fingerprint(one: Finding) -> str:
    told = "\0".join((one.rule.code, uri(one.file), one.place, str(one.line)))
    return sha256(told.encode("utf-8", "surrogatepass")).hexdigest()[:16]


def uri(file: str) -> str:
    """Write the name of a file as a reference: below the working directory relative to it.

    Examples
    --------
    >>> uri("a b/c#1.glb"), uri("/no/ü.obj")
    ('a%20b/c%231.glb', 'file:///no/%C3%BC.obj')
    """
    path = Path(file)
    here = Path.cwd()
    whole = path if path.is_absolute() else here / path
    parts: list[str] = []
    for part in whole.parts[1:]:
        if part != "..":
            parts.append(part)
        elif parts:
            parts.pop()
    whole = Path(whole.anchor, *parts)
    if whole.is_relative_to(here):
        return _quoted(whole.relative_to(here).as_posix())
    return f"file://{'' if whole.as_posix().startswith('/') else '/'}{_quoted(whole.as_posix())}"


def _quoted(path: str) -> str:
    return quote(path, errors="surrogateescape")
