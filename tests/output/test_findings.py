"""Findings as SARIF and as GitHub's workflow commands: by the standard, by GitHub's escaping."""

from __future__ import annotations

import json
from pathlib import Path
from urllib.parse import unquote

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.enums import Format, Severity
from nmatrix.output import OutputOptions, write
from nmatrix.output.sarif import uri
from nmatrix.report import Finding, Findings, Report, Rule

ODD = Rule("NM-X01", "odd", "It is odd.", "Make it even.")
UNUSED = Rule("NM-X02", "unused", "Nothing has it.", "Do nothing.")
# What the published schema of SARIF 2.1.0 allows at these places.
LEVELS = {"none", "note", "warning", "error"}
LOGICAL = {"object"}

texts = st.text(st.characters(codec="utf-8"), max_size=20)
findings = st.builds(
    Finding,
    st.just(ODD),
    st.sampled_from(Severity),
    texts,
    texts.filter(lambda one: one and "\0" not in one),
    line=st.integers(0, 9),
    column=st.integers(0, 9),
    place=texts,
)


def report(*found: Finding) -> Report:
    return Report("lint", {}, (), findings=Findings((UNUSED, ODD), found))


def sarif(*found: Finding) -> dict:
    return json.loads(write(report(*found), OutputOptions(Format.SARIF)))


def lines(*found: Finding) -> list[str]:
    return write(report(*found), OutputOptions(Format.GITHUB)).splitlines()


def test_a_log_has_what_the_standard_requires_and_every_rule() -> None:
    log = sarif()
    assert log["version"] == "2.1.0"
    assert log["$schema"].endswith("sarif-2.1.0.json")
    (run,) = log["runs"]
    driver = run["tool"]["driver"]
    assert driver["name"] == "nmatrix"
    assert [rule["id"] for rule in driver["rules"]] == [UNUSED.code, ODD.code]
    for rule in driver["rules"]:
        assert rule["shortDescription"]["text"]
        assert rule["help"]["text"]
    assert run["results"] == []


@given(st.lists(findings, max_size=4))
def test_every_result_has_its_rule_its_level_and_its_place(found: list[Finding]) -> None:
    log = sarif(*found)
    (run,) = log["runs"]
    assert len(run["results"]) == len(found)
    for result, one in zip(run["results"], found, strict=True):
        assert run["tool"]["driver"]["rules"][result["ruleIndex"]]["id"] == result["ruleId"]
        assert result["level"] in LEVELS
        assert result["message"] == {"text": one.message}
        (location,) = result["locations"]
        named = location["physicalLocation"]["artifactLocation"]["uri"]
        assert named.isascii() and named.isprintable() and " " not in named
        region = location["physicalLocation"].get("region")
        assert (region is None) == (one.line == 0)
        assert region is None or min(region.values()) >= 1  # the standard counts from 1
        (logical,) = location.get("logicalLocations", [{"kind": "object"}])
        assert logical["kind"] in LOGICAL
        assert logical.get("fullyQualifiedName", "") == one.place


def test_findings_of_one_rule_in_one_file_are_told_apart(tmp_path: Path) -> None:
    """On no line of a file, a host would take the second for the first seen again."""
    made = [Finding(ODD, Severity.NOTE, "odd", "a.gltf", place=name) for name in ("a", "b", "a")]
    first, second, again = (
        one["partialFingerprints"] for one in sarif(*made)["runs"][0]["results"]
    )
    assert first != second
    assert first == again


@pytest.mark.usefixtures("own_folder")
@pytest.mark.parametrize(
    ("file", "named"),
    [
        ("a.obj", "a.obj"),
        ("./sub/../a.obj", "a.obj"),
        ("a b/ü#?.glb", "a%20b/%C3%BC%23%3F.glb"),
        ("100%.obj", "100%25.obj"),
        ("-", "-"),
    ],
)
def test_files_are_named_from_the_working_directory(file: str, named: str) -> None:
    assert uri(file) == named
    assert uri(str(Path.cwd() / file)) == named


def test_a_file_elsewhere_has_a_whole_address(own_folder, tmp_path: Path) -> None:
    found = uri(str(tmp_path.parent / "a b.obj"))
    assert found.startswith("file:///")
    assert unquote(found.removeprefix("file://")) == str(tmp_path.parent / "a b.obj")


@given(st.lists(findings, max_size=4))
def test_a_line_for_each_finding_whatever_it_holds(found: list[Finding]) -> None:
    """GitHub's toolkit: % CR LF are escaped in data, and : and , in properties too."""
    assert len(lines(*found)) == len(found)
    for line, one in zip(lines(*found), found, strict=True):
        command, properties, message = line.removeprefix("::").partition(" ")[0], "", ""
        assert command in {"error", "warning", "notice"}
        properties, _, message = line.removeprefix(f"::{command} ").partition("::")
        parts = dict(part.split("=", 1) for part in properties.split(","))
        assert set(parts) == {"file", "title"} | ({"line"} if one.line else set()) | (
            {"col"} if one.line and one.column else set()
        )
        assert ":" not in properties
        assert "\r" not in message and "\n" not in message


def test_escapes_are_those_of_the_toolkit() -> None:
    found = Finding(ODD, Severity.NOTE, "50% :, a\r\nb", "c:d,e.obj", line=3, column=2)
    assert lines(found) == [
        "::notice file=c%3Ad%2Ce.obj,line=3,col=2,title=NM-X01 odd::50%25 :, a%0D%0Ab"
    ]


def test_without_findings_nothing_is_written_for_github() -> None:
    assert write(report(), OutputOptions(Format.GITHUB)) == ""
