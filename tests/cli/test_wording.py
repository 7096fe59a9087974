"""The one sentence that a person reads first."""

from __future__ import annotations

import pytest

from nmatrix.enums import NORMAL_METHODS, NormalRule

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
    ("trace --point 0 0 -95.00000000000001", "What reads 1 in NDC is 2.85e-19 beyond it"),
    ("view --eye 0 5 0", "−z took its place, as --up 0 0 -1 does; --up 0 0 1 gives the picture"),
]


@pytest.mark.parametrize(("line", "sentence"), SENTENCES)
def test_the_sentence_says_what_it_is(nmatrix, line: str, sentence: str) -> None:
    assert sentence in " ".join(nmatrix(line).out.split())


@pytest.mark.parametrize("sign", [1, -1])
def test_only_a_rotation_is_called_one(nmatrix, sign: int) -> None:
    found = nmatrix(f"world --scale {sign} 1 1 --rotate 10 20 30")
    assert ("is a rotation" in found.out) == (sign > 0)


@pytest.mark.parametrize("method", NORMAL_METHODS)
def test_how_far_a_itself_is_off_does_not_depend_on_the_method(nmatrix, method: NormalRule) -> None:
    for scale, off in (("-1 1 1", 0.0), ("-1 2 1", 36.86989764584402)):
        line = f"normal --scale {scale} --normal 1 1 0 --method {method} -f json"
        found = nmatrix(line).data["normals"][0]
        assert found["without_deg"] == pytest.approx(off, abs=1e-12)


def test_a_remark_names_a_quantity_as_its_caller_types_it(nmatrix) -> None:
    from nmatrix.api.setup import Setup

    (told,) = Setup(view={"eye": (0, 5, 0)}).view().remarks
    assert "as up 0 0 -1 does" in told
    assert "as --up 0 0 -1 does" in nmatrix("view --eye 0 5 0 -f json").data["remarks"][0]
