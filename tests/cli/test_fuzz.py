"""Two thousand random command lines in one process: documented exit codes, one line, no NaN."""

from __future__ import annotations

import random

import pytest
from typer.core import TyperOption

from nmatrix.cli.app import load, run
from nmatrix.cli.catalogue import COMMANDS

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


def line(rng: random.Random) -> list[str]:
    words = [rng.choice(SHORT)] if rng.random() < 0.97 else []
    for _ in range(rng.randrange(6)):
        if rng.random() < 0.6:
            option = rng.choice(OPTIONS)
            if rng.random() < 0.1:
                words.append(f"{option}={rng.choice(VALUES)}")
                continue
            words.append(option)
            words += [rng.choice(VALUES) for _ in range(rng.choice([0, 1, 2, 3, 3, 3, 4]))]
        else:
            words.append(rng.choice(VALUES))
    return words


@pytest.mark.parametrize("seed", range(4))
def test_random_command_lines(seed: int, capsys: pytest.CaptureFixture[str], monkeypatch) -> None:
    import io
    import sys

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
