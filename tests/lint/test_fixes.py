"""A correction is right where one is offered: what it mends is gone, and nothing else came."""

from __future__ import annotations

import re
import shutil
import subprocess
from collections import Counter

import pytest
from shader_programs import FAULTY

from nmatrix.answers.lint import Asked, Source, report
from nmatrix.enums import Severity

WORD = re.compile(r"[A-Za-z_]\w*")
OF_ENGINES = {"normalMatrix", "UnityObjectToWorldNormal"}
KNOWN = {*"transpose inverse mat3 vec4 float4 normalize max xyz w".split(), *OF_ENGINES}
# What has no single right change: two spaces, a projection, an inverse that only costs.
UNMENDED = {"NM104", "NM201", "NM401"}


def weighty(sources: list[Source]) -> Counter[str]:
    found = report(sources).data["findings"]
    return Counter(one["rule"] for one in found if one["severity"] != Severity.NOTE)


@pytest.mark.skipif(shutil.which("patch") is None, reason="the program patch is not installed")
@pytest.mark.parametrize("name", FAULTY)
def test_a_patch_takes_findings_away_and_brings_none(name: str, tmp_path, monkeypatch) -> None:
    monkeypatch.chdir(tmp_path)
    sources = [Source(file, text) for file, text in FAULTY[name].items()]
    patch = str(report(sources, Asked(with_fixes=True)).data["patch"])
    if not patch:
        return
    for one in sources:
        (tmp_path / one.name).write_text(one.text)
    subprocess.run(["patch", "-p0"], input=patch, text=True, check=True, capture_output=True)
    mended = [Source(one.name, (tmp_path / one.name).read_text()) for one in sources]
    before, after = weighty(sources), weighty(mended)
    assert after < before, (patch, after)
    for old, new in zip(sources, mended, strict=True):
        said = set(WORD.findall(new.text)) - set(WORD.findall(old.text))
        assert said <= KNOWN | {one for one in said if one.startswith("gl_")}, (patch, said)


def test_most_rules_can_be_mended() -> None:
    mended = set()
    for program in FAULTY.values():
        found = report([Source(name, text) for name, text in program.items()])
        mended |= {one["rule"] for one in found.data["findings"] if one["fix"]}
    told = {
        one["rule"]
        for program in FAULTY.values()
        for one in report([Source(name, text) for name, text in program.items()]).data["findings"]
    }
    assert told - mended <= UNMENDED


def test_the_corrected_line_is_that_line() -> None:
    text = FAULTY["reflect"]["reflect.frag"]
    (one,) = [one for one in report([Source("reflect.frag", text)]).data["findings"] if one["fix"]]
    assert one["fix"] == "    vec3 R = reflect(-L, N); // NM303"
