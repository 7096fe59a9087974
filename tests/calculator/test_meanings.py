"""Spaces and kinds: what the rules refuse, what they let pass, and what they say."""

from __future__ import annotations

from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from nmatrix.calculator import function_rules, rules
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.faults import MeaningError
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.grammar import OPERATORS
from nmatrix.calculator.meanings import SCENE, Carries, Kind, Located, Map
from nmatrix.calculator.numbers import shown
from nmatrix.calculator.operands import Sort
from nmatrix.calculator.values import Arithmetic, Value, ValueKind
from nmatrix.enums import Frame
from nmatrix.errors import FrameError, NMatrixError
from nmatrix.lessons.check.mistakes import MistakeId
from nmatrix.linear.rational import rational_matrix

F = Fraction
ROWS = {
    "M": [[0, F(-1, 2), 0, 1], [2, 0, 0, 2], [0, 0, 1, 3], [0, 0, 0, 1]],
    "V": [[1, 0, 0, 0], [0, F(4, 5), F(-3, 5), 0], [0, F(3, 5), F(4, 5), -5], [0, 0, 0, 1]],
    "P": [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, F(-5, 4), F(-9, 4)], [0, 0, -1, 0]],
}
SCENE_NAMES = {name: Value(rational_matrix(rows), SCENE[name]) for name, rows in ROWS.items()}
THINGS = {
    "p": "point([1, 2, 3], object)",
    "q": "point([-1, 0, 2], object)",
    "r": "point([2, 2, -1], object)",
    "n": "normal([1, 1, 0], object)",
    "t": "direction([1, -1, 0], object)",
    "L": "point([4, 6, 2], world)",
    "l": "direction([1, -2, 2], world)",
    "eye": "point([0, 3, 4], world)",
    "m": "normal([0, 1, 0], world)",
}
NAMES = SCENE_NAMES | {
    name: calculate(typed, SCENE_NAMES).value for name, typed in THINGS.items()
}
RIGHT = Path(__file__).with_name("right_expressions.txt")


def right_lines():
    """Return the expressions of the file that are right, each with its result."""
    lines = RIGHT.read_text().splitlines()
    return [tuple(line.split("  =>  ")) for line in lines if line and not line.startswith("#")]


def told(value):
    """Write a value as the file does: what it is, and its numbers to six digits."""
    if value.kind is ValueKind.TRUTH:
        return "yes" if value.entries else "no"
    numbers = " ".join(short(float(shown(x))) for x in value.numbers)
    return f"{value.meaning or ''} ({numbers})".strip()


def short(number):
    return f"{round(number, 9) + 0.0:.6g}"


class Homogeneous:
    """The oracle's vectors: floats with their w, by NumPy, which know nothing of spaces."""

    def __init__(self, four):
        self.four = np.asarray(four, dtype=float)

    def __add__(self, other):
        return Homogeneous(self.four + four(other))

    def __sub__(self, other):
        w = four(other)[3]
        if self.four[3] and w:  # two places
            return Homogeneous(self.four / self.four[3] - four(other) / w)
        return Homogeneous(self.four - four(other))

    def __rsub__(self, other):
        return Homogeneous(four(other, w=1) - self.four)

    def __neg__(self):
        return Homogeneous(-self.four)

    def __mul__(self, number):
        return Homogeneous(self.four * number)

    def __truediv__(self, number):
        return Homogeneous(self.four / number)

    def __rmatmul__(self, matrix):
        if len(matrix) == 4:
            return Homogeneous(matrix @ self.four)
        return Homogeneous([*(matrix @ self.three), self.four[3]])

    def __eq__(self, other):
        return np.allclose(self.four, other.four, atol=1e-12)

    def __getitem__(self, place):
        return self.three[place]

    __rmul__ = __mul__
    __array_ufunc__ = None
    __hash__ = None

    @property
    def three(self):
        return self.four[:3]

    @property
    def xyz(self):
        return Homogeneous([*self.three, 0])

    x, y, z, w = (property(lambda self, i=i: self.four[i]) for i in range(4))


class Matrix(np.ndarray):
    """NumPy's matrices with the calculator's ==."""

    def __eq__(self, other):
        return np.allclose(np.asarray(self), np.asarray(other), atol=1e-12)

    __hash__ = None


def four(value, w=0):
    if isinstance(value, Homogeneous):
        return value.four
    return np.array([*value, w], dtype=float)


def three(value):
    return value.three if isinstance(value, Homogeneous) else np.asarray(value, dtype=float)


def matrix(rows):
    return np.array(rows, dtype=float).view(Matrix)


def turn(axis, degrees):
    rest = [i for i in range(3) if i != axis]
    if axis == 1:
        rest.reverse()
    found = np.eye(4)
    sine, cosine = np.sin(np.radians(degrees)), np.cos(np.radians(degrees))
    found[np.ix_(rest, rest)] = [[cosine, -sine], [sine, cosine]]
    return matrix(found)


def moved(*by):
    found = np.eye(4)
    found[:3, 3] = by
    return matrix(found)


def cofactors(A):
    return np.linalg.det(A) * np.linalg.inv(A).T


def unit(v):
    return Homogeneous([*(three(v) / np.linalg.norm(three(v))), 0])


def made(w):
    def make(v, space=None):
        if space is None and not isinstance(v, Homogeneous):
            return Homogeneous([*three(v), w])
        return Homogeneous(v) if len(three(v)) == 4 else Homogeneous([*three(v)[:3], w])

    return make


ORACLE = {
    **{str(frame): str(frame) for frame in Frame},
    "identity": lambda n: matrix(np.eye(n)),
    "inverse": lambda A: matrix(np.linalg.inv(A)),
    "transpose": lambda A: A.T,
    "inverse_transpose": lambda A: matrix(np.linalg.inv(A).T),
    "normal_matrix": lambda A: matrix(np.linalg.inv(A[:3, :3]).T),
    "cofactor": lambda A: matrix(cofactors(A)),
    "linear": lambda A: A[:3, :3],
    "translation": lambda A: Homogeneous([*A[:3, 3], 1]),
    "det": lambda A: round(np.linalg.det(A), 12),
    "trace": np.trace,
    "rank": np.linalg.matrix_rank,
    "translate": moved,
    "scale": lambda *by: matrix(np.diag([*by, 1])),
    "rotate_x": lambda degrees: turn(0, degrees),
    "rotate_y": lambda degrees: turn(1, degrees),
    "rotate_z": lambda degrees: turn(2, degrees),
    "point": made(1),
    "direction": made(0),
    "normal": made(0),
    "vector": made(0),
    "untyped": lambda x: three(x) if isinstance(x, Homogeneous) else x,
    "dot": lambda a, b: three(a) @ three(b),
    "cross": lambda a, b: Homogeneous([*np.cross(three(a), three(b)), 0]),
    "length": lambda v: np.linalg.norm(three(v)),
    "normalize": unit,
    "angle": lambda a, b: np.degrees(
        np.arctan2(np.linalg.norm(np.cross(three(a), three(b))), three(a) @ three(b))
    ),
}
ORACLE |= {name: matrix([[float(x) for x in row] for row in rows]) for name, rows in ROWS.items()}
ORACLE |= {name: eval(typed, dict(ORACLE)) for name, typed in THINGS.items()}  # noqa: S307


def numbers_of(found, kind, count):
    """Take the numbers that the calculator should show of an oracle's result."""
    if isinstance(found, Homogeneous):
        if count == 4:
            return found.four
        return found.three / found.w if kind is Kind.POINT and found.w else found.three
    rows = [three(row) for row in found] if isinstance(found, list) else found
    return np.asarray(rows, dtype=float).ravel()
