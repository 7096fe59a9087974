"""The pages of the rules: the wrong shader has that finding, the right one has none."""

from __future__ import annotations

import re
from math import atan, degrees
from pathlib import Path

import pytest

from nmatrix.answers.lint import Asked, Source, report
from nmatrix.enums import Severity
from nmatrix.linting.rules import LINT_RULES, RuleId
from nmatrix.scene.world import World

PAGES = Path(__file__).resolve().parents[2] / "docs" / "lint"


def page(rule: RuleId) -> str:
    return (PAGES / f"{rule.value}.md").read_text("utf-8")


def source(rule: RuleId, title: str) -> Source:
    block = re.search(rf"## {title}\n\n```glsl\n// (\S+)\n(.*?)```", page(rule), re.DOTALL)
    assert block is not None
    return Source(block[1], block[2])


@pytest.mark.parametrize("rule", RuleId)
def test_the_wrong_shader_has_this_finding_and_no_other_that_weighs_more(rule: RuleId) -> None:
    findings = report([source(rule, "Wrong")]).data["findings"]
    told = {one["rule"] for one in findings if one["severity"] != Severity.NOTE}
    assert told == ({rule.value} if LINT_RULES[rule].severity is not Severity.NOTE else set())
    assert rule.value in {one["rule"] for one in findings}


@pytest.mark.parametrize("rule", RuleId)
def test_the_right_shader_has_none_that_weighs(rule: RuleId) -> None:
    findings = report([source(rule, "Right")]).data["findings"]
    assert rule.value not in {one["rule"] for one in findings}
    assert {one["severity"] for one in findings} <= {Severity.NOTE}


@pytest.mark.parametrize("rule", RuleId)
def test_a_page_names_the_severity_and_the_mistake_of_its_rule(rule: RuleId) -> None:
    told = LINT_RULES[rule]
    assert re.search(rf"^Severity: {told.severity.value}\b", page(rule), re.MULTILINE)
    mistake = re.search(r"the mistake `([\w-]+)`", page(rule).split("## Why")[0])
    assert (mistake and mistake[1]) == told.mistake
    index = (PAGES / "README.md").read_text("utf-8")
    row = rf"^\| \[{rule.value}\]\({rule.value}\.md\) \| .* \| {told.severity.value} \|$"
    assert re.search(row, index, re.MULTILINE)


@pytest.mark.parametrize("rule", [one for one in RuleId if LINT_RULES[one].gains_degrees])
def test_the_degrees_of_a_page_are_those_of_the_command_and_of_the_formula(rule: RuleId) -> None:
    (one,) = report(
        [source(rule, "Wrong")], Asked(world=World(scale=(1, 2, 1)).world_from_object)
    ).data["findings"]
    assert one["degrees"] == pytest.approx(degrees(atan((2 - 1 / 2) / 2)))
    assert f"{one['degrees']:.4g}°" in page(rule)
    (even,) = report(
        [source(rule, "Wrong")], Asked(world=World(scale=(3, 3, 3)).world_from_object)
    ).data["findings"]
    assert (even["degrees"], even["severity"]) == (0, Severity.NOTE)


def test_links_of_the_pages_lead_somewhere() -> None:
    for one in PAGES.glob("*.md"):
        for target in re.findall(r"\]\(([^)#:]+)[^)]*\)", one.read_text("utf-8")):
            assert (PAGES / target).exists(), (one.name, target)
