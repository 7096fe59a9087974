"""Two thousand random command lines in one process: documented exit codes, one line, no NaN."""

from __future__ import annotations

import io
import random
import sys

import pytest
from typer.core import TyperOption

from nmatrix.cli.app import load, run
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.completion import answer
from nmatrix.cli.help import VARIABLES
from nmatrix.cli.meanings import meanings

DOCUMENTED = {0, 1, 2, 3, 4}
ELABORATE = {"render", "cost", "stress", "handout", "explore"}  # they draw, measure or write files
SHORT = [name for name in COMMANDS if name not in ELABORATE]
OPTIONS = sorted(
    {
        spelling
        for name in SHORT
        for one in load(name).params
        if isinstance(one, TyperOption)
        for spelling in one.opts
        if spelling != "--help"
    }
)
VALUES = [
    "0", "1", "-1", "2.5", "-0", "1e308", "-1e308", "5e-324", "1e-400", "1e999", "nan", "inf",
    "-inf", "NaN", "1/3", "1/0", "0/0", "−1", "1_000", "0x10", "", " ", "\x00", "１", "9" * 400,
    "1e20000000", "--", "-", "-#", "#", "1 2 3", "1,2,3", "1 0 0; 0 1 0; 0 0 1", "[[1,0],[0,1]]",
    "(" * 3000, "[" * 3000, "1 0 0 0; 0 1 0 0; 0 0 1 0; 5 5 5 1", "mat3(2.0)", "mat4(1)",
    "json", "csv", "latex", "glsl", "text", "numpy", "XYZ", "zyx", "XXX", "polimi", "standard",
    "left", "right", "reversed", "vulkan", "world", "camera", "object", "light", "custom",
    "static", "rule", "mirror", "det(M)", "M.T@M", "M.__class__", "2**9**9", "inverse(M)",
    "90deg", "pi/2rad", "-pi", "0.25turn", "1.5708", "16:9", "(1, 2, 1)", "y", "2",
    '{"elements":[1,0,0,0,2,0,0,0,1]}', '{"elements":[1,0,0', '{"0":1,"1":',
    "Float32Array(9) [1, 0", "mat4x4((1, 0, 0, 0), (0, 1", "Mat3 { x_axis: Vec3(1.0, 0.0",
    "<Matrix 3x3 (1, 0, 0)\n(0",
    "{{1.0f, 0}, {0, 1}}", "{", "| 1 0 |\n| 0 1 |", "1,5;0\n0;1", "e00: 1", "\u200b", "\ufeff", "²",
    "640 480", "500 500 320 240", "opencv", "-40 40 -30 30",
    "exact", "inverse", "none", "\ud800", "a=1 0; 0 1", "💥", "\n\n", "../x", ".", "/",
]  # fmt: skip


PROGRAM = ["help", "-h", "--help", "-V", "--json", "--full", "--docs", "options", "-", "-x"]
FOREIGN = sorted(meanings())
ENCODINGS = ["ascii", "cp1252", "cp437", "latin-1", "shift_jis", "utf-16", "utf-8"]


def line(rng: random.Random) -> list[str]:
    words = [rng.choice(SHORT)] if rng.random() < 0.97 else []
    if rng.random() < 0.05:
        words.insert(rng.randrange(len(words) + 1), rng.choice(PROGRAM))
    for _ in range(rng.randrange(6)):
        if rng.random() < 0.6:
            option = rng.choice(OPTIONS)
            if rng.random() < 0.1:
                words.append(f"{option}={rng.choice(VALUES)}")
                continue
            words.append(option)
            words += [rng.choice(VALUES) for _ in range(rng.choice([0, 1, 2, 3, 3, 3, 4]))]
        elif rng.random() < 0.1:
            words.append(f"--{rng.choice(FOREIGN)}")
        else:
            words.append(rng.choice(VALUES))
    return words


@pytest.mark.parametrize("seed", range(4))
def test_random_command_lines(seed: int, capsys: pytest.CaptureFixture[str], monkeypatch) -> None:
    rng = random.Random(seed)
    answered = 0
    for _ in range(520):
        words = line(rng)
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"1 0 0; 0 1 0; 0 0 1")))
        code = run(words)
        captured = capsys.readouterr()
        assert code in DOCUMENTED, (words, code, captured.err)
        assert "Traceback" not in captured.err, words
        if code and words:
            assert captured.err.startswith("error: "), (words, captured.err)
            assert captured.err.count("\n") == 1, (words, captured.err)
        assert "nan" not in captured.out.lower().replace(",", " ").split(), words
        answered += code == 0
    assert answered > 20


@pytest.mark.parametrize("encoding", ENCODINGS)
def test_random_lines_on_an_output_of_another_encoding(encoding: str, monkeypatch) -> None:
    rng = random.Random(encoding)
    for _ in range(60):
        words = line(rng)
        for name in VARIABLES:
            monkeypatch.setenv(name, rng.choice(VALUES).replace("\x00", "").replace("\ud800", ""))
        out, err = io.BytesIO(), io.BytesIO()
        with monkeypatch.context() as patch:
            patch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(b"1 0 0; 0 1 0; 0 0 1")))
            patch.setattr(sys, "stdout", io.TextIOWrapper(out, encoding, errors="strict"))
            patch.setattr(sys, "stderr", io.TextIOWrapper(err, encoding, errors="strict"))
            code = run(words)
            sys.stdout.flush()
            sys.stderr.flush()
            told = err.getvalue().decode(encoding)
            out.getvalue().decode(encoding)
        assert code in DOCUMENTED, (words, code, told)
        if code and words:
            assert told.startswith("error: "), (words, told)
            assert told.count("\n") == 1, (words, told)


def test_a_tab_anywhere_is_answered(monkeypatch, own_folder) -> None:
    rng = random.Random("tab")
    for _ in range(400):
        words = [
            one for one in ("nmatrix", *line(rng)) if "\x00" not in one and "\ud800" not in one
        ]
        typed = " ".join(words)
        typed = typed[: rng.randrange(7, max(8, len(typed) + 1))]
        monkeypatch.setenv("COMP_LINE", typed)
        monkeypatch.setenv("COMP_POINT", str(rng.choice([len(typed), 9])))
        monkeypatch.setenv("_TYPER_COMPLETE_ARGS", typed)
        for shell in ("bash", "zsh", "fish", "powershell"):
            assert isinstance(answer(f"complete_{shell}"), str)
