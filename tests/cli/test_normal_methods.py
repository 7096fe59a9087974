"""What `normal --method` says of itself, against the right rule in fifty digits."""

from __future__ import annotations

from contextlib import suppress
from fractions import Fraction
from itertools import product

import mpmath
import numpy as np
import pytest

from nmatrix.answers.normal import NormalRequest, normal
from nmatrix.enums import NORMAL_METHODS, NormalRule
from nmatrix.report import Text
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

MAPS = {
    "stretched": ((1, 0.5, 0), (0, 2, 0), (0, 0, -3)),
    "mirrored": ((-1, 0, 0), (0, 1, 0), (0, 0, 1)),
    "sheared": ((1, 3, 0.25), (0, 1, 0), (0, 0, 1)),
    "turned": World(rotate_degrees=(10, 20, 30), scale=(1, 2, 3)).world_from_object,
    "nearly flat": ((1, 1, 1), (1, 1 + 1e-9, 1), (1, 1, 1 + 1e-9)),
    "flattened": ((1, 0, 2), (0, 0, 0), (0, 0, 1)),
    "flattened aslant": ((1, 2, 3), (4, 5, 6), (7, 8, 9)),
}
NORMALS = ((1, 1, 1), (1, 0, 0), (0, 1, 0), (0, 0, 1), (0.3, -2, 5))


def adjugate_transpose(A: list[list[Fraction]]) -> list[list[Fraction]]:
    i, j, k = (1, 2, 0), (2, 0, 1), range(3)
    return [[A[i[r]][i[c]] * A[j[r]][j[c]] - A[i[r]][j[c]] * A[j[r]][i[c]] for c in k] for r in k]


def times(A: list[list[Fraction]], v: tuple[float, ...]) -> list[Fraction]:
    return [sum(a * Fraction(x) for a, x in zip(row, v, strict=True)) for row in A]


def angle(a: list[Fraction], b: list[Fraction]) -> mpmath.mpf:
    u, v = ([mpmath.mpf(x.numerator) / x.denominator for x in w] for w in (a, b))
    cosine = sum(x * y for x, y in zip(u, v, strict=True))
    crossed = [u[i - 2] * v[i - 1] - u[i - 1] * v[i - 2] for i in range(3)]
    return mpmath.degrees(mpmath.atan2(mpmath.sqrt(sum(x * x for x in crossed)), cosine))


@pytest.mark.parametrize(("name", "n"), list(product(MAPS, NORMALS)))
@pytest.mark.parametrize("method", NORMAL_METHODS)
def test_a_method_tells_its_own_error_and_that_of_the_plain_matrix(
    method: NormalRule, name: str, n: tuple[float, ...]
) -> None:
    A = [[Fraction(x) for x in row[:3]] for row in MAPS[name][:3]]
    C = adjugate_transpose(A)
    det = sum(a * c for a, c in zip(A[0], C[0], strict=True))
    right = [x * (-1 if det < 0 else 1) for x in times(C, n)]
    world = World(matrix=[[float(x) for x in row] for row in A])
    report = normal(Setup(world), NormalRequest((n,), method=method))
    (found,) = report.data["normals"]
    by_method = {NormalRule.EXACT: right, NormalRule.COFACTOR: times(C, n)}
    by_method[NormalRule.NONE] = times(A, n)
    with suppress(np.linalg.LinAlgError):
        inverse = np.linalg.inv(np.array([[float(x) for x in row] for row in A])).T
        by_method[NormalRule.INVERSE] = times([list(map(Fraction, row)) for row in inverse], n)
    with mpmath.workdps(50):
        for key, image in (
            ("method_error_deg", by_method.get(method)),
            ("without_deg", by_method[NormalRule.NONE]),
        ):
            if image is None or not any(image) or not any(right):
                assert found[key] is None or image is None
                continue
            true = angle(image, right)
            true = true if det else min(true, 180 - true)
            assert found[key] == pytest.approx(float(true), rel=1e-14, abs=1e-40)
    said = " ".join(block.text for block in report.blocks if isinstance(block, Text))
    if found["status"] == "ok" and method is not NormalRule.EXACT:
        error = found["method_error_deg"]
        off = f"is {error:.6g}° off the right direction" if error else "gives the right direction"
        if error and error < 1e-9:
            off = f"gives the right direction to {error:.2g}°"
        assert ("where the right rule gives none" if error is None else off) in said.split(". ")[0]


def test_what_is_said_under_a_flipped_normal_is_about_it(nmatrix) -> None:
    flipped = nmatrix("normal --scale -1 1 1 --normal 1 0 0 --method cofactor --full").out
    assert "The unsigned cofactor is 180° off the right direction." in flipped
    plain = nmatrix('normal "1 0.5 0;0 2 0;0 0 -3" --normal 1 1 1 --method none --full').out
    assert "A itself is 44.836° off the right direction." in plain
    assert "it would be" not in plain
