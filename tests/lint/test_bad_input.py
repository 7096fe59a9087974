"""Sources that no compiler would take: one line told, the rest looked at, and never a long wait."""

from __future__ import annotations

from collections import Counter

import pytest

from nmatrix.answers.lint import Source, report, source
from nmatrix.linting.evaluation import Evaluation
from nmatrix.linting.program import lint

HEAD = """#version 330 core
uniform mat4 model, viewProjection;
in vec3 position;
in vec3 normal;
out vec3 n;
"""
FAULT = "void main() { n = mat3(model) * normal; gl_Position = vec4(position, 1.0); }\n"


def rules(text: str, name: str = "a.vert") -> list[str]:
    return [one.rule.value for one in lint({name: text.encode()}).faults]


@pytest.mark.parametrize(
    "broken",
    [
        "void broken( { vec3 x = ; }\n",
        "}}}}\n",
        "int f() { return 1 + ; }\n",
        "#if defined(A) && \\\n  defined(B)\n#endif\n",
        '#include "nowhere.glsl"\n',
        "#define TWICE(x) ((x) + (x)\n",
        "layout(std140) uniform Broken { mat4 a; \n};\n",
    ],
)
def test_the_readable_rest_is_looked_at(broken: str) -> None:
    assert rules(HEAD + broken + FAULT) == ["NM101"]


def test_what_does_not_parse_is_told_in_one_line() -> None:
    found = report([Source("a.vert", HEAD + FAULT + "void g() { vec3 a = = b; }\n")])
    assert found.remarks == ("a.vert does not parse in line 7; the rest of it was read.",)
    assert found.data["files"] == [{"file": "a.vert", "error": None, "unparsed": [7]}]


@pytest.mark.parametrize(
    "fine",
    [
        "precision mediump float;\nprecision highp int;\n",
        "vec2 corners[2] = vec2[](vec2(0.0), vec2(1.0));\n",
        "#pragma unknown_to_all thing(1)\n#extension GL_OES_standard_derivatives : enable\n",
    ],
)
def test_the_marks_that_the_grammar_leaves_are_no_faults(fine: str) -> None:
    assert report([Source("a.vert", HEAD + fine + FAULT)]).remarks == ()


def test_a_register_is_no_fault() -> None:
    text = "cbuffer P : register(b0) { float4x4 World; };\nTexture2D t : register(t0);\n"
    assert report([Source("a.hlsl", text)]).remarks == ()


def test_a_binary_file_costs_only_itself(tmp_path) -> None:
    (tmp_path / "a.vert").write_bytes(b"\x7fELF\0\0\0")
    (tmp_path / "b.vert").write_text(HEAD + FAULT)
    found = report([source(tmp_path / "a.vert"), source(tmp_path / "b.vert")])
    assert [one["rule"] for one in found.data["findings"]] == ["NM101"]
    assert found.failure is None
    assert len(found.remarks) == 1
    assert "binary" in found.remarks[0]


@pytest.mark.parametrize("encoding", ["utf-8-sig", "utf-16", "latin-1", "cp1252"])
def test_any_encoding_is_read_and_columns_count_characters(tmp_path, encoding: str) -> None:
    text = HEAD + "void main() { /* ü */ n = mat3(model) * normal; }\n"
    (tmp_path / "a.vert").write_bytes(text.encode(encoding))
    (one,) = report([source(tmp_path / "a.vert")]).data["findings"]
    assert (one["line"], one["column"]) == (6, 27)


def test_line_ends_of_windows_are_lines() -> None:
    (one,) = report([Source("a.vert", (HEAD + FAULT).replace("\n", "\r\n"))]).data["findings"]
    assert one["line"] == 6


@pytest.mark.parametrize(
    "text",
    [
        "void main() { float x = " + "(" * 5000 + "1" + ")" * 5000 + "; }",
        "void main() { float x = " + "-" * 5000 + "1; }",
        "void main() " + "{" * 3000 + "}" * 3000,
        "void main() { x" + "[0].y" * 3000 + " = 1; }",
        "void main() { " + "if (a > 0.) {" * 2000 + "}" * 2000 + " }",
        "".join(f"#define A{i} A{i + 1}*A{i + 1}\n" for i in range(60)) + "void main() { x = A0; }",
        "".join(f"float f{i}() {{ return f{i + 1}() + f{i + 1}(); }}\n" for i in range(60)),
        "void f() { f(); g(); }\nvoid g() { f(); g(); }\nvoid main() { f(); }",
        "#define A B\n#define B A\nvoid main() { vec3 x = A; }",
        "\xff\xfe" * 10,
        "",
        "//" + "x" * 100_000,
    ],
)
def test_what_is_deep_or_goes_in_a_circle_ends(text: str) -> None:
    assert rules(text) == []


LINE = "    p = twice(model * vec4(position, 1.0)); if (p.x > 0.0) { p = p * 2.0; }\n"


def long_source(lines: int, line: str = LINE) -> str:
    head = HEAD + "vec4 twice(vec4 v) { return 2.0 * v; }\n"
    body = "void main() {\n    vec4 p;\n" + line * lines + "    n = mat3(model) * normal;\n}\n"
    return head + body


def test_work_grows_with_the_lines(monkeypatch) -> None:
    """Twice the lines are twice the expressions that are evaluated, and no more."""
    evaluated = Counter()

    def counted(self, expression, scope, value=Evaluation.value):
        evaluated[lines] += 1
        return value(self, expression, scope)

    monkeypatch.setattr(Evaluation, "value", counted)
    for lines in (200, 400):
        assert rules(long_source(lines)) == ["NM101"]
    assert 1.9 * evaluated[200] < evaluated[400] <= 2 * evaluated[200]


@pytest.mark.slow
def test_a_hundred_thousand_lines_are_read_to_the_last() -> None:
    assert rules(long_source(100_000, "    p.x += 1.0;\n")) == ["NM101"]
