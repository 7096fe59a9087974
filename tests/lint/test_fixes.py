"""A correction is right where one is offered: what it mends is gone, and nothing else came."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter
from collections.abc import Mapping
from random import Random

import pytest
from shader_programs import FAULTY

from nmatrix.answers.lint import Asked, Source, report
from nmatrix.linting.rules import LINT_RULES, RuleId

WORD = re.compile(r"[A-Za-z_]\w*")
OF_ENGINES = {"normalMatrix", "UnityObjectToWorldNormal"}
KNOWN = {*"transpose inverse mat3 vec4 float4 normalize max xyz w".split(), *OF_ENGINES}
# What has no single right change: a projection, an inverse that only costs.
UNMENDED = {RuleId.NORMAL_BY_PROJECTION, RuleId.INVERSE_IN_SHADER}
FIXED = Asked(with_fixes=True, are_one_program=True)

VERTEX = """#version 330 core
in vec3 aPos;
in vec3 aNormal;
uniform mat4 model, view, projection;
uniform mat3 normalMatrix;
uniform vec3 lightPos;
out vec3 position;
out vec3 normal;
out vec3 toLight;
void main() {
    position = vec3(view * model * vec4(aPos, 1.0));
    normal = transpose(inverse(mat3(view * model))) * aNormal;
    vec3 lamp = vec3(view * vec4(lightPos, 1.0));
    toLight = lamp - position;
    gl_Position = projection * view * model * vec4(aPos, 1.0);
}
"""
FRAGMENT = """#version 330 core
in vec3 position;
in vec3 normal;
in vec3 toLight;
uniform mat4 view;
uniform vec3 viewPos;
uniform vec3 sunDirWorld;
out vec4 colour;
void main() {
    vec3 n = normalize(normal);
    vec3 l = normalize(toLight);
    vec3 v = normalize(-position);
    vec3 r = reflect(-l, n);
    vec3 s = normalize(vec3(view * vec4(sunDirWorld, 0.0)));
    float d = max(dot(n, l), 0.0) + max(dot(n, s), 0.0);
    colour = vec4(d + pow(max(dot(r, v), 0.0), 8.0));
}
"""
SLIPS = (
    ("transpose(inverse(mat3(view * model))) * aNormal", "mat3(view * model) * aNormal"),
    ("transpose(inverse(mat3(view * model))) * aNormal", "inverse(mat3(view * model)) * aNormal"),
    ("transpose(inverse(mat3(view * model))) * aNormal", "vec3(view * model * vec4(aNormal, 1.0))"),
    (
        "transpose(inverse(mat3(view * model))) * aNormal",
        "transpose(inverse(mat3(model))) * aNormal",
    ),
    ("vec3(view * vec4(lightPos, 1.0))", "vec3(view * model * vec4(lightPos, 1.0))"),
    ("vec3(view * vec4(lightPos, 1.0))", "vec3(view * vec4(lightPos, 0.0))"),
    ("position = vec3(view * model * vec4(aPos, 1.0))", "position = vec3(model * vec4(aPos, 1.0))"),
    ("projection * view * model * vec4", "model * view * projection * vec4"),
    ("normalize(normal)", "normal"),
    ("normalize(-position)", "normalize(viewPos - position)"),
    ("reflect(-l, n)", "reflect(l, n)"),
    ("vec3(view * vec4(sunDirWorld, 0.0))", "sunDirWorld"),
    ("vec3(view * vec4(sunDirWorld, 0.0))", "vec3(view * vec4(sunDirWorld, 1.0))"),
    ("pow(max(dot(r, v), 0.0), 8.0)", "pow(dot(r, v), 8.0)"),
)
WORLD_WITH_ONE_SLIP = """#version 330 core
// @space world point
in vec3 FragPos;
// @space world normal
in vec3 Normal;
uniform vec3 lightPos, viewPos;
uniform mat4 view;
out vec4 colour;
void main() {
    vec3 N = normalize(Normal);
    vec3 L = normalize(vec3(view * vec4(lightPos, 1.0)) - FragPos);
    vec3 V = normalize(viewPos - FragPos);
    colour = vec4(max(dot(N, L), 0.0) + max(dot(reflect(-L, N), V), 0.0));
}
"""


def fixed(program: Mapping[str, str]) -> dict:
    return report([Source(file, text) for file, text in program.items()], FIXED).data


def places(found: dict) -> Counter[tuple[str, str, int]]:
    """Count findings by their lines; a note about costs says nothing wrong."""
    return Counter(
        (one["rule"], one["file"], one["line"])
        for one in found["findings"]
        if one["rule"] != RuleId.INVERSE_IN_SHADER
    )


def applied(program: Mapping[str, str], patch: str) -> dict[str, str]:
    """Apply a patch of whole lines by its line numbers alone, knowing nothing of who wrote it."""
    texts = {file: text.splitlines(keepends=True) for file, text in program.items()}
    file, moved, place = "", 0, 0
    for line in patch.splitlines(keepends=True):
        head = re.match(r"@@ -(\d+)", line)
        if line.startswith("+++ "):
            file, moved = line[4:].split("\t")[0].strip(), 0
        elif head is not None:
            place = int(head[1]) - 1 + moved
        elif line.startswith("-") and not line.startswith("--- "):
            assert texts[file].pop(place) == line[1:]
            moved -= 1
        elif line.startswith("+"):
            texts[file].insert(place, line[1:])
            place, moved = place + 1, moved + 1
        else:
            place += 1
    return {file: "".join(lines) for file, lines in texts.items()}


def assert_only_better(program: Mapping[str, str]) -> None:
    found = fixed(program)
    before, after = places(found), places(fixed(applied(program, found["patch"])))
    assert after <= before, (found["patch"], after - before)
    mended = Counter(
        (one["rule"], one["file"], one["line"]) for one in found["findings"] if one["fix"]
    )
    assert after <= before - mended, found["patch"]
    assert bool(mended) == bool(found["patch"])
    assert all(one["fix"] or one["no_fix"] for one in found["findings"])


@pytest.mark.parametrize("name", FAULTY)
def test_a_patch_brings_no_finding_and_takes_away_what_it_is_for(name: str) -> None:
    assert_only_better(FAULTY[name])


@pytest.mark.parametrize("seed", range(40))
def test_a_patch_of_many_slips_at_once_brings_no_finding(seed: int) -> None:
    random = Random(seed)
    program = {"a.vert": VERTEX, "a.frag": FRAGMENT}
    for right, wrong in random.sample(SLIPS, random.randint(1, 5)):
        program = {file: text.replace(right, wrong) for file, text in program.items()}
    assert_only_better(program)


def test_the_program_without_a_slip_is_right() -> None:
    assert not places(fixed({"a.vert": VERTEX, "a.frag": FRAGMENT}))


def test_the_matrix_is_taken_off_the_light_where_all_else_is_in_the_world() -> None:
    (one,) = fixed({"a.frag": WORLD_WITH_ONE_SLIP})["findings"]
    assert one["fix"] == "    vec3 L = normalize(lightPos - FragPos);"


def test_the_change_that_leaves_the_fewest_findings_is_made() -> None:
    text = WORLD_WITH_ONE_SLIP.replace(
        "vec3 L = normalize(vec3(view * vec4(lightPos, 1.0)) - FragPos)",
        "vec3 lamp = vec3(view * vec4(lightPos, 1.0));\n"
        "    float far = distance(lamp, FragPos);\n    vec3 L = normalize(lamp - FragPos)",
    )
    found = fixed({"a.frag": text})
    assert len(found["findings"]) == 2
    assert [one["fix"] for one in found["findings"]] == ["    vec3 lamp = lightPos;", None]
    assert found["findings"][1]["no_fix"] == "what mends another finding mends it too"


def test_a_normal_that_is_used_twice_is_normalised_twice() -> None:
    text = FRAGMENT.replace("    vec3 n = normalize(normal);\n", "")
    program = {"a.vert": VERTEX, "a.frag": re.sub(r"\bn\b", "normal", text)}
    patch = fixed(program)["patch"]
    assert not places(fixed(applied(program, patch)))


def test_where_every_change_brings_another_finding_there_is_none() -> None:
    text = WORLD_WITH_ONE_SLIP.replace("vec3(view * vec4(lightPos, 1.0))", "lamp").replace(
        "uniform mat4", "// @space camera point\nuniform vec3 lamp;\nuniform mat4"
    )
    found = fixed({"a.frag": text})
    assert (found["patch"], [bool(one["no_fix"]) for one in found["findings"]]) == ("", [True])


def test_what_is_not_mended_says_why(nmatrix, tmp_path) -> None:
    (tmp_path / "a.vert").write_text(FAULTY["through_projection"]["through_projection.vert"])
    found = nmatrix(f"lint {tmp_path / 'a.vert'} --fix")
    assert found.out == ""
    assert re.search(r"^note: \S+a\.vert:7:9: NM104 is not mended: the source", found.err, re.M)


@pytest.mark.skipif(shutil.which("patch") is None, reason="the program patch is not installed")
@pytest.mark.parametrize("name", FAULTY)
def test_the_program_patch_takes_it_and_no_name_is_invented(
    name: str, tmp_path, monkeypatch
) -> None:
    monkeypatch.chdir(tmp_path)
    program = FAULTY[name]
    patch = str(fixed(program)["patch"])
    if not patch:
        return
    for file, text in program.items():
        (tmp_path / file).write_text(text)
    subprocess.run(["patch", "-p0"], input=patch, text=True, check=True, capture_output=True)
    mended = {file: (tmp_path / file).read_text() for file in program}
    assert mended == applied(program, patch)
    for file, text in mended.items():
        said = set(WORD.findall(text)) - set(WORD.findall(program[file]))
        assert said <= KNOWN | {one for one in said if one.startswith("gl_")}, (patch, said)


def test_each_rule_that_one_change_can_mend_is_mended() -> None:
    mended = {
        one["rule"]
        for program in FAULTY.values()
        for one in fixed(program)["findings"]
        if one["fix"]
    }
    assert mended == set(LINT_RULES) - UNMENDED


def test_the_corrected_line_is_that_line() -> None:
    (one,) = [one for one in fixed(FAULTY["reflect"])["findings"] if one["rule"] == "NM303"]
    assert one["fix"] == "    vec3 R = reflect(-L, N); // NM303"
