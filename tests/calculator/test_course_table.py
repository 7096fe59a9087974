"""The table of the course's functions: every calculator row gives what the course's code gives.

The right-hand sides are the course's own formulas, sixteen numbers in row-major order.
"""

from __future__ import annotations

import re
from fractions import Fraction
from math import cos, radians, sin
from pathlib import Path

import numpy as np
import pytest

from nmatrix.calculator.arithmetic.values import Value
from nmatrix.calculator.evaluate import calculate
from nmatrix.linear.rational import rational_matrix, rational_vector

PAGE = Path(__file__).resolve().parents[2] / "docs" / "calculator.md"

M = np.array([[2, 1, 0, 5], [0, 3, 1, -6], [1, 0, 2, 7], [0, 0, 0, 1]], dtype=float)
N = np.array([[1, 0, 4, 1], [2, 1, 0, 0], [0, 5, 1, -2], [0, 0, 0, 1]], dtype=float)
U, W = np.array([1.0, -2, 3]), np.array([4.0, 0, -5])
X, Y, Z, S, TURN = 2, 3, 5, 7, 25


def placed(**entries):
    """Return the course's `out = identityMatrix(); out[i] = …` as a 4×4 array."""
    out = np.eye(4).reshape(-1)
    for name, value in entries.items():
        out[int(name[1:])] = value
    return out.reshape(4, 4)


COSINE, SINE = cos(radians(TURN)), sin(radians(TURN))
COURSE = {
    "identityMatrix": np.eye(4),
    "identityMatrix3": np.eye(3),
    "sub3x3from4x4": M[:3, :3],
    "transposeMatrix": M.T,
    "transposeMatrix3": M[:3, :3].T,
    "invertMatrix": np.linalg.inv(M),
    "invertMatrix3": np.linalg.inv(M[:3, :3]),
    "invertMatrix(transposeMatrix": np.linalg.inv(M.T),
    "multiplyMatrices": M @ N,
    "multiplyMatrixVector": M @ [*U, 1],
    "multiplyMatrix3Vector3": M[:3, :3] @ U,
    "crossVector": np.cross(U, W),
    "normalizeVector3": U / np.sqrt(U @ U),
    "MakeTranslateMatrix": placed(_3=X, _7=Y, _11=Z),
    "MakeRotateXMatrix": placed(_5=COSINE, _10=COSINE, _6=-SINE, _9=SINE),
    "MakeRotateYMatrix": placed(_0=COSINE, _10=COSINE, _2=-SINE, _8=SINE),
    "MakeRotateZMatrix": placed(_0=COSINE, _5=COSINE, _4=-SINE, _1=SINE),
    "MakeScaleMatrix": placed(_0=S, _5=S, _10=S),
    "MakeScaleNuMatrix": placed(_0=X, _5=Y, _10=Z),
    "MakeShearXMatrix": placed(_4=Y, _8=Z),
    "MakeShearYMatrix": placed(_1=X, _9=Z),
    "MakeShearZMatrix": placed(_2=X, _6=Y),
}


def rows():
    """Return the course's name and the first calculator expression of every row that has one."""
    row = re.compile(r"^\| `([\w(]+)\(.*?\)` \| `nmatrix calc \"(.*?)\"`", re.MULTILINE)
    return row.findall(PAGE.read_text())


def floats(entries):
    if isinstance(entries, tuple):
        return [floats(entry) for entry in entries]
    return float(entries)


def names_for(function):
    turn = function.startswith("MakeRotate")
    numbers = {"X": X, "Y": Y, "Z": Z, "S": S}
    return {
        "A": Value(Fraction(TURN)) if turn else Value(rational_matrix(M.tolist())),
        "B": Value(rational_matrix(M[:3, :3].tolist())),
        "C": Value(rational_matrix(N.tolist())),
        "u": Value(rational_vector(U.tolist())),
        "v": Value(rational_vector(W.tolist())),
        **{name: Value(Fraction(number)) for name, number in numbers.items()},
    }


def test_every_row_of_the_table_is_checked():
    assert {function for function, _ in rows()} == set(COURSE)


@pytest.mark.parametrize(("function", "expression"), rows())
def test_the_calculator_gives_what_the_course_gives(function, expression):
    found = floats(calculate(expression, names_for(function)).value.shown)
    np.testing.assert_allclose(found, COURSE[function], rtol=1e-13, atol=1e-15)
