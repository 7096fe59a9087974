"""`nmatrix lint` on the command line: what is told, in which format, and how it ends."""

from __future__ import annotations

import json
import re
import sys
from io import BytesIO, TextIOWrapper
from pathlib import Path

import pytest

from nmatrix.enums import Severity
from nmatrix.lessons.check.mistakes import MistakeId
from nmatrix.linting.parsing import parser_of
from nmatrix.linting.rules import LINT_RULES, RuleId

VERTEX = """#version 330 core
uniform mat4 model, viewProjection;
in vec3 position;
in vec3 normal;
out vec3 n;
void main() {
    n = mat3(model) * normal;
    gl_Position = viewProjection * model * vec4(position, 1.0);
}
"""


@pytest.mark.parametrize("rule", RuleId)
def test_every_rule_has_its_words_and_a_mistake_that_check_knows(rule: RuleId) -> None:
    told = LINT_RULES[rule]
    assert told.sentence.endswith(".")
    assert told.advice.endswith(".")
    assert told.mistake is None or told.mistake in set(MistakeId)


def test_text_shows_the_line_with_its_caret(nmatrix, tmp_path: Path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    Path("a.vert").write_text(VERTEX)
    found = nmatrix("lint a.vert")
    assert found.code == 0
    assert "\na.vert:7:9: warning NM101: The normal in object space is multiplied by" in found.out
    carets = "^" + "~" * len("at3(model) * normal")
    assert f"\n    n = mat3(model) * normal;\n        {carets}\n" in found.out


def test_a_short_answer_fits_a_screen(nmatrix) -> None:
    lines = nmatrix("lint phong.vert phong.frag").out.splitlines()
    assert len(lines) <= 22
    assert max(map(len, lines)) <= 80


@pytest.mark.parametrize(("options", "code"), [("", 0), ("--fail-on warning", 1)])
def test_warnings_fail_where_it_is_asked_for(nmatrix, options: str, code: int) -> None:
    found = nmatrix(f"lint phong.vert {options}")
    assert found.code == code
    assert found.err.count("\n") == code


def test_a_world_tells_degrees_or_that_it_does_not_matter(nmatrix) -> None:
    bent = nmatrix("lint phong.vert --scale 1 2 1 -f json").data["findings"]
    assert [one["degrees"] and round(one["degrees"], 4) for one in bent] == [36.8699, None]
    even = nmatrix("lint phong.vert --rotate 10 20 30 --scale 2 --fail-on warning -f json")
    first = even.data["findings"][0]
    assert (first["degrees"], first["severity"]) == (0, Severity.NOTE)
    assert "does not matter" in first["message"]


def test_sarif_and_github_name_rule_and_line(nmatrix, tmp_path: Path) -> None:
    (tmp_path / "a.vert").write_text(VERTEX)
    log = json.loads(nmatrix(f"lint {tmp_path} -f sarif").out)
    (result,) = log["runs"][0]["results"]
    region = result["locations"][0]["physicalLocation"]["region"]
    assert (result["ruleId"], region) == ("NM101", {"startLine": 7, "startColumn": 9})
    assert [rule["id"] for rule in log["runs"][0]["tool"]["driver"]["rules"]] == list(RuleId)
    line = nmatrix(f"lint {tmp_path} -f github").out
    assert re.match(r"::warning file=.*a\.vert,line=7,col=9,title=NM101 ", line)


def test_a_note_is_a_notice_of_github(nmatrix, tmp_path: Path) -> None:
    (tmp_path / "a.vert").write_text(
        VERTEX.replace("mat3(model)", "transpose(inverse(mat3(model)))")
    )
    assert nmatrix(f"lint {tmp_path} -f github").out.startswith("::notice ")


def test_spaces_say_how_they_are_known(nmatrix) -> None:
    spaces = nmatrix("lint phong.vert phong.frag -f json").data["spaces"]
    assert spaces["model"] == {"space": "world_from_object", "known_by": "name"}
    assert spaces["position"] == {"space": "camera space", "known_by": "arithmetic"}


def test_standard_input_has_the_language_that_is_said(nmatrix, monkeypatch) -> None:
    text = "float4x4 World; float4 vs(float4 p : POSITION, float3 n : NORMAL) : SV_POSITION {\n"
    text += "  float3 m = mul(n, (float3x3)World);\n  return mul(p, World); }\n"
    monkeypatch.setattr("sys.stdin", TextIOWrapper(BytesIO(text.encode())))
    found = nmatrix("lint - --language hlsl -f json")
    assert [one["rule"] for one in found.data["findings"]] == ["NM101"]


def test_two_files_of_any_names_are_one_program(nmatrix, tmp_path: Path) -> None:
    first, second = tmp_path / "one.vert", tmp_path / "two.frag"
    first.write_text(VERTEX.replace("mat3(model) * normal", "normal"))
    second.write_text(
        "#version 330 core\nin vec3 n;\nuniform vec3 lightDirWorld;\nout vec4 c;\n"
        "void main() { c = vec4(max(dot(normalize(n), lightDirWorld), 0.0)); }\n"
    )
    found = nmatrix(f"lint {first} {second} -f json").data["findings"]
    assert [(one["rule"], one["line"]) for one in found] == [("NM206", 5)]
    assert nmatrix(f"lint {tmp_path} -f json").data["findings"] == []  # in a folder they are two


def test_a_patch_is_all_that_fix_prints(nmatrix) -> None:
    found = nmatrix("lint phong.vert --fix")
    assert found.out.startswith("--- ")
    assert "+    normal = transpose(inverse(mat3(view * model))) * aNormal;\n" in found.out


def test_without_the_grammars_one_line_says_what_brings_them(nmatrix, monkeypatch) -> None:
    monkeypatch.setitem(sys.modules, "tree_sitter_hlsl", None)
    parser_of.cache_clear()
    found = nmatrix("lint phong.vert")
    assert (found.code, found.out) == (4, "")
    installed = "pip install 'tree-sitter>=0.25' 'tree-sitter-glsl>=0.2,<0.3'"
    assert installed in found.err
    parser_of.cache_clear()
