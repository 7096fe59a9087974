"""The one sentence that a person reads first."""

from __future__ import annotations

import shlex

import pytest

from nmatrix.cli.app import run

SENTENCES = [
    ("world --rotate 0 30 0", "a rotation: A⁻ᵀ = A"),
    ("world --scale -1 1 1", "a mirror (orthogonal, determinant −1): A⁻ᵀ = A"),
    ("world --scale -1 1 1 --translate 1 0 0", "a mirror and a translation"),
    ("world --scale -2 2 2", "a mirrored similarity"),
    ("world --scale -1 2 1", "a mirrored non-uniform scale: normals need"),
    ("world --scale -1 1 1 --shear 1 0 0", "a mirrored shear: normals need"),
    ("trace --point 0 0 6", "Outside: behind the eye, w = -1."),
    ("trace --point 0 0 5", "Outside: beside the eye, w = 0."),
    ("trace --point 5 0 0", "Outside: beyond the right plane."),
    ("trace --point 5 5 0", "Outside: beyond the right and top planes."),
]


@pytest.mark.parametrize(("line", "sentence"), SENTENCES)
def test_the_sentence_says_what_it_is(
    capsys: pytest.CaptureFixture[str], line: str, sentence: str
) -> None:
    run(shlex.split(line))
    assert sentence in " ".join(capsys.readouterr().out.split())


@pytest.mark.parametrize("sign", [1, -1])
def test_only_a_rotation_is_called_one(capsys: pytest.CaptureFixture[str], sign: int) -> None:
    run(["world", "--scale", str(sign), "1", "1", "--rotate", "10", "20", "30"])
    assert ("is a rotation" in capsys.readouterr().out) == (sign > 0)
