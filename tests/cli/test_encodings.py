"""Help, answers and errors on an output of any encoding: spelled, never escaped, never a defect."""

from __future__ import annotations

import io
import re
import sys
from pathlib import Path

import pytest

from nmatrix.cli.app import run
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.show import put
from nmatrix.enums import PARTICULAR_FORMATS, Format
from nmatrix.output.spelling import sayable

ENCODINGS = ("ascii", "latin-1", "cp1252", "cp437", "cp850", "koi8-r", "shift_jis", "utf-8")
PACKAGE = Path(__file__).resolve().parents[2] / "nmatrix"
ANSWERS = [
    "world --rotate 10 20 30 --scale 1 -2 1",
    "view --eye 0 5 0",
    "projection --far inf --depth reversed --at 1 10",
    "normal --scale 1 2 1 --normal 1 1 0",
    "calc 'inverse(rotate_x(30))' --steps",
    "identify '0.70711 -0.70711 0; 0.70711 0.70711 0; 0 0 1'",
    "light",
    "eye",
    "space object",
    "trace --point 0 0 6",
    "derive all",
    "render --list",
    "plan sample",
    "stress --case N9",
    "check normal '1 0 0; 0 2 0; 0 0 1' --scale 1 2 1",
    "check exercise 3 c --seed 7 --student Łukasz",
    "inspect teapot",
]
HELP = ["--help", "help options", "help --docs", *(f"{name} --help --full" for name in COMMANDS)]
ESCAPED = re.compile(r"\\[uUxN][0-9a-fA-F{]|U\+[0-9A-F]{4}|\ufffd|\?")


@pytest.fixture
def said(monkeypatch):
    """Run a line with an output of an encoding that refuses what it lacks; return what was said."""

    def call(line: list[str], encoding: str) -> tuple[int, str, str]:
        out, err = io.BytesIO(), io.BytesIO()
        with monkeypatch.context() as patch:
            patch.setattr(sys, "stdout", io.TextIOWrapper(out, encoding, errors="strict"))
            patch.setattr(sys, "stderr", io.TextIOWrapper(err, encoding, errors="strict"))
            code = run(line)
            sys.stdout.flush()
            sys.stderr.flush()
            return code, out.getvalue().decode(encoding), err.getvalue().decode(encoding)

    return call


def bare(text: str) -> str:
    """Drop the question marks that are meant: of sentences that ask, of GLSL and formulas."""
    return re.sub(r"(?<=[\w)”\"])\?|\? .* :", "", text)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_every_answer_can_be_said(said, encoding: str, own_folder) -> None:
    import shlex

    for line in ANSWERS:
        code, out, err = said(shlex.split(line), encoding)
        assert code in (0, 1), (line, err)
        assert out
        assert not ESCAPED.search(bare(out)), (line, ESCAPED.search(bare(out)))


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_every_help_can_be_said(said, encoding: str) -> None:
    for line in HELP:
        code, out, err = said(line.split(), encoding)
        assert (code, err) == (0, "")
        assert not ESCAPED.search(bare(out)), (line, ESCAPED.search(bare(out)))


@pytest.mark.parametrize("format_", [one for one in Format if one is not Format.JSON])
def test_every_format_can_be_said(said, format_: Format) -> None:
    for line in ("world --scale 1 2 1/3", "calc 'inverse(M)' --scale 1 3 1", "space camera"):
        import shlex

        code, out, err = said([*shlex.split(line), "-f", format_], "ascii")
        assert code == 0 or format_ in PARTICULAR_FORMATS, err
        assert not re.search(r"\\[uUxN][0-9a-f]{2}|U\+[0-9A-F]{4}|\ufffd", out)


def test_json_keeps_every_character(said) -> None:
    import json

    line = ["world", "--scale", "1", "2", "1", "-f", "json"]
    _, narrow, _ = said(line, "cp1252")
    _, wide, _ = said(line, "utf-8")
    assert json.loads(narrow) == json.loads(wide)


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_an_error_can_be_said(said, encoding: str) -> None:
    for line in (["world", "--scale", "−√2"], ["wrøld"], ["check", "wörld"], ["normal", "目"]):
        code, _, err = said(line, encoding)
        assert code == 2
        assert err.startswith("error: ")
        assert err.count("\n") == 1
        assert "\\u" not in err


def test_every_character_of_the_package_has_a_spelling() -> None:
    text = "".join(
        path.read_text(encoding="utf-8")
        for folder in ("cli", "answers", "lessons", "calculator", "studies", "spaces", "scene")
        for path in (PACKAGE / folder).rglob("*.py")
    )
    without = {one for one in set(text) if "U+" in sayable(one, "ascii")}
    assert without == {"\N{REPLACEMENT CHARACTER}"}  # a file that is not text


@pytest.mark.parametrize(
    ("text", "encoding", "spelled"),
    [
        ("t′ = 10⁻⁷⁶", "ascii", "t' = 10^-76"),
        ("det A⁻¹ᵀ", "cp437", "det A^-1T"),
        ("n² ± 1", "latin-1", "n² ± 1"),
        ("Łukasz Ω λ ½ é", "ascii", "Lukasz Omega lambda 1/2 e"),
        ("目", "ascii", "U+76EE"),
        ("−1", "no-such-encoding", "-1"),
        ("A · B", "utf-8", "A · B"),
    ],
)
def test_a_spelling(text: str, encoding: str, spelled: str) -> None:
    assert sayable(text, encoding) == spelled


def test_a_word_that_is_put_is_encoded_as_the_output_is(monkeypatch) -> None:
    raw = io.BytesIO()
    monkeypatch.setattr(sys, "stdout", io.TextIOWrapper(raw, "cp850", errors="strict"))
    put("½ σ₁ → −z\n")
    assert raw.getvalue().decode("cp850") == "½ sigma1 -> -z\n"
