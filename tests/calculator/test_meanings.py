"""Spaces and kinds: what the rules refuse, what they let pass, and what they say."""

from __future__ import annotations

import random
from fractions import Fraction
from pathlib import Path

import numpy as np
import pytest

from nmatrix.calculator.arithmetic.meanings import SCENE, Carries, Kind, Located, Map
from nmatrix.calculator.arithmetic.numbers import shown
from nmatrix.calculator.arithmetic.values import Arithmetic, Value, ValueKind
from nmatrix.calculator.evaluate import calculate
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.language.faults import CalculatorError, MeaningError
from nmatrix.calculator.language.grammar import OPERATORS
from nmatrix.calculator.meaning import function_rules, rules
from nmatrix.calculator.meaning.operands import Operand, RefusedError, Sort
from nmatrix.enums import Frame
from nmatrix.errors import FrameError, NMatrixError
from nmatrix.lessons.check.mistake import MistakeId
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
NAMES = SCENE_NAMES | {name: calculate(typed, SCENE_NAMES).value for name, typed in THINGS.items()}
RIGHT = Path(__file__).with_name("right_expressions.txt")


def right_expressions():
    """Return the sections of the file of what is right: expressions with their results."""
    sections = {}
    for line in RIGHT.read_text().splitlines():
        if line.startswith("# "):
            section = sections.setdefault(line.removeprefix("# "), {})
        elif line:
            expression, result = line.split("  =>  ")
            section[expression] = result
    return {title: found for title, found in sections.items() if found}


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
    "reflect": lambda v, m: v - 2 * (three(v) @ three(m) / (three(m) @ three(m))) * m,
    "lerp": lambda a, b, t: a * (1 - t) + b * t,
    "project": lambda p: Homogeneous(p.four / p.w),
    "outer": lambda a, b: matrix(np.outer(three(a), three(b))),
    "cross_matrix": lambda a: matrix(np.cross(three(a), np.eye(3)).T),
    "angle": lambda a, b: np.degrees(
        np.arctan2(np.linalg.norm(np.cross(three(a), three(b))), three(a) @ three(b))
    ),
}
ORACLE |= {name: matrix([[float(x) for x in row] for row in rows]) for name, rows in ROWS.items()}
ORACLE |= {name: eval(typed, dict(ORACLE)) for name, typed in THINGS.items()}


def numbers_of(found, kind, count):
    """Take the numbers that the calculator should show of an oracle's result."""
    if isinstance(found, Homogeneous):
        if count == 4:
            return found.four
        return found.three / found.w if kind is Kind.POINT and found.w else found.three
    rows = [three(row) for row in found] if isinstance(found, list) else found
    return np.asarray(rows, dtype=float).ravel()


@pytest.mark.parametrize("section", right_expressions())
def test_no_right_expression_is_refused_and_numpy_has_its_numbers(section):
    for expression, result in right_expressions()[section].items():
        value = calculate(expression, NAMES).value
        assert told(value) == result, expression
        found = eval(expression, dict(ORACLE))
        if value.kind is ValueKind.TRUTH:
            assert bool(found) is value.entries, expression
            continue
        kind = value.meaning.kind if isinstance(value.meaning, Located) else None
        numbers = [float(shown(x)) for x in value.numbers]
        right = numbers_of(found, kind, len(numbers))
        np.testing.assert_allclose(numbers, right, atol=1e-12, err_msg=expression)


def test_there_are_two_hundred_right_expressions():
    assert sum(map(len, right_expressions().values())) >= 200


WRONG = {
    # maps
    "V @ P @ M": (None, "P @ V @ M"),
    "M @ V": (None, "V @ M"),
    "P @ M": (None, "P @ V @ M"),
    "P @ M @ p": (None, "P @ V @ M @ p"),
    "M @ V @ P @ p": (None, "P @ V @ M @ p"),
    "P @ inverse(V) @ M": (MistakeId.VIEW_NOT_INVERTED, "P @ V @ M"),
    "inverse(V) @ M": (MistakeId.VIEW_NOT_INVERTED, "V @ M"),
    "P @ V^-1 @ M @ p": (MistakeId.VIEW_NOT_INVERTED, "P @ V @ M @ p"),
    "M^2": (None, "untyped(M)^2"),
    "M + V": (None, "untyped(M) + V"),
    "M - P": (None, "untyped(M) - P"),
    # points and lights
    "V @ p": (None, "V @ M @ p"),
    "P @ p": (None, "P @ V @ M @ p"),
    "V @ M @ L": (MistakeId.USED_MODEL_VIEW, "V @ L"),
    "V @ M @ l": (MistakeId.USED_MODEL_VIEW, "V @ l"),
    "(V @ M) @ eye": (MistakeId.USED_MODEL_VIEW, "V @ eye"),
    "M @ L": (MistakeId.USED_WORLD_MATRIX, "inverse(M) @ L"),
    "M @ l": (MistakeId.USED_WORLD_MATRIX, "inverse(M) @ l"),
    "inverse(V) @ L": (MistakeId.VIEW_NOT_INVERTED, "V @ L"),
    "V.inv @ l": (MistakeId.VIEW_NOT_INVERTED, "V @ l"),
    "M^T @ p": (MistakeId.TRANSPOSED_LAYOUT, "M @ p"),
    "V.T @ L": (MistakeId.TRANSPOSED_LAYOUT, "V @ L"),
    "M^T @ l": (MistakeId.COURSE_LIGHT_RULE, "inverse(M) @ l"),
    "normal_matrix(V) @ l": (MistakeId.COURSE_LIGHT_RULE, "V @ l"),
    "normal_matrix(M) @ t": (MistakeId.COURSE_LIGHT_RULE, "M @ t"),
    "V @ point(l)": (MistakeId.DIRECTION_AS_POINT, "l"),
    "V @ point(l, world)": (MistakeId.DIRECTION_AS_POINT, "l"),
    "point(l, camera)": (MistakeId.DIRECTION_AS_POINT, "l"),
    "normal_matrix(M) @ p": (None, "M @ p"),
    "linear(M) @ p": (None, "M @ p"),
    "V @ (L / 2)": (None, "V @ point(L / 2)"),
    "point(L, camera)": (None, "point(V @ L, camera)"),
    # normals
    "M @ n": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(M) @ n"),
    "linear(M) @ n": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(M) @ n"),
    "V @ M @ n": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(V @ M) @ n"),
    "V @ m": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(V) @ m"),
    "scale(1, 2, 1) @ n": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(scale(1, 2, 1)) @ n"),
    "linear(V) @ normal_matrix(M) @ n": (
        MistakeId.USED_WORLD_MATRIX,
        "normal_matrix(V) @ normal_matrix(M) @ n",
    ),
    "inverse(M) @ n": (MistakeId.NOT_TRANSPOSED, "normal_matrix(M) @ n"),
    "inverse(linear(M)) @ n": (MistakeId.NOT_TRANSPOSED, "normal_matrix(linear(M)) @ n"),
    "transpose(linear(M)) @ n": (MistakeId.NOT_INVERTED, "normal_matrix(linear(M)) @ n"),
    "M^T @ n": (MistakeId.NOT_INVERTED, "normal_matrix(M) @ n"),
    "M @ point(n)": (MistakeId.TRANSLATED, "n"),
    "normal_matrix(V @ M) @ m": (MistakeId.USED_MODEL_VIEW, "normal_matrix(V) @ m"),
    "normal_matrix(P @ V @ M) @ n": (None, "normal_matrix(V @ M) @ n"),
    "P @ V @ M @ n": (MistakeId.USED_WORLD_MATRIX, "normal_matrix(V @ M) @ n"),
    "normal_matrix(inverse(P @ V)) @ normal([0, 0, 1], ndc)": (
        None,
        "untyped(normal_matrix(inverse(P @ V))) @ normal([0, 0, 1], ndc)",
    ),
    "cofactor(linear(M @ scale(-1, 1, 1))) @ n": (
        MistakeId.COFACTOR_SIGN,
        "normal_matrix(linear(M @ scale(-1, 1, 1))) @ n",
    ),
    "normalize([1, 2, 3, 1])": (
        MistakeId.FOUR_COMPONENT_NORMALISE,
        "normalize([1, 2, 3, 1].xyz)",
    ),
    # sums, products, comparisons
    "p + q": (None, "p + (q - p) / 2"),
    "l - L": (None, "L - l"),
    "L - p": (None, "L - M @ p"),
    "p - eye": (None, "M @ p - eye"),
    "dot(n, l)": (None, "dot(normal_matrix(M) @ n, l)"),
    "dot(n, V @ l)": (None, "dot(normal_matrix(V @ M) @ n, V @ l)"),
    "V · p": (None, "V @ M @ p"),
    "n · l": (None, "normal_matrix(M) @ n · l"),
    "cross(t, l)": (None, "cross(M @ t, l)"),
    "angle(n, -(V @ l))": (None, "angle(normal_matrix(V @ M) @ n, -(V @ l))"),
    "2 * dot(m, V @ l) * m - l": (None, "dot(normal_matrix(V) @ m, V @ l)"),
    "p == M @ p": (None, "M @ p == M @ p"),
    "L == l": (None, "untyped(L) == l"),
    "dot(m, P @ V @ L)": (None, "dot(m, untyped((P @ V @ L).xyz))"),
    "normalize(P @ V @ L)": (None, "normalize(((P @ V @ L).xyz / (P @ V @ L).w))"),
    "direction([0, 0, 1], clip)": (None, "point([0, 0, 1], clip)"),
    "inverse(P) @ direction([0, 0, 1], ndc)": (
        None,
        "untyped(inverse(P)) @ direction([0, 0, 1], ndc)",
    ),
    "(P @ V @ L).xyz - (P @ V @ M @ p).xyz": (
        None,
        "((P @ V @ L).xyz / (P @ V @ L).w) - ((P @ V @ M @ p).xyz / (P @ V @ M @ p).w)",
    ),
}


def refusal(expression, **names):
    with pytest.raises(MeaningError) as refused:
        calculate(expression, NAMES | names)
    return refused.value


@pytest.mark.parametrize("expression", WRONG)
def test_a_mistake_is_refused_named_and_mended(expression):
    mistake, instead = WRONG[expression]
    error = refusal(expression)
    assert isinstance(error, FrameError)
    assert error.mistake is mistake
    named = f"; check calls it {mistake}" if mistake else ""
    assert f"; write {instead}{named}; see the caret: " in str(error)
    assert calculate(instead, NAMES).value


def test_the_message_of_the_product_is_a_sentence_with_both_spaces():
    assert str(refusal("V @ P @ M")) == (
        "@ (character 3): P leads to clip space, V starts from world space; write P @ V @ M; "
        "see the caret: V ^@ P @ M"
    )
    assert "V @ M starts from object space, l is in world space" in str(refusal("V @ M @ l"))


def test_a_normal_is_refused_with_the_degrees_of_this_very_normal():
    stretched = calculate("scale(1, 2, 1)", {}).value.entries
    M = Value(stretched, SCENE["M"])
    n = calculate("normal([1, 1, 0], object)", {}).value
    said = "a normal is not carried by M: 36.87° off here; write normal_matrix(M) @ n; "
    assert said in str(refusal("M @ n", M=M, n=n))
    for x, y in ((1, 3), (5, 1), (2, -1), (1, 0)):  # M n = (x, 2y), the right one is (x, y/2)
        degrees = np.degrees(np.arctan2(abs(x * y / 2 - 2 * x * y), x * x + y * y))
        error = refusal(f"M @ normal([{x}, {y}, 0], object)", M=M)
        assert f"carried by M: {degrees:.4g}° off here; write " in str(error)


@pytest.mark.parametrize(
    ("typed", "why"),
    [
        ("translate(1, 2, 3) @ rotate_z(30) @ rotate_x(10)", "0° off here, since M is rigid"),
        ("rotate_y(20) @ scale(-1, 1, 1)", "0° off here, since M only turns and mirrors"),
        ("scale(3, 3, 3)", "0° off here; write"),
        ("scale(0, 1, 1)", "a normal is not carried by M; write"),
    ],
)
def test_a_normal_is_refused_by_every_map_even_where_it_would_be_right(typed, why):
    M = Value(calculate(typed, {}).value.entries, SCENE["M"])
    error = refusal("M @ n", M=M)
    assert why in str(error)
    assert error.mistake is MistakeId.USED_WORLD_MATRIX


def test_a_view_in_floats_is_as_rigid_as_floats_are():
    V = Value(tuple(tuple(map(F, row)) for row in turn(1, 33).tolist()), SCENE["V"])
    assert "0° off here, since V is rigid" in str(refusal("V @ m", V=V))
    carried = calculate("linear(V)^T @ direction([1, 2, 3], camera)", NAMES | {"V": V}).value
    assert str(carried.meaning) == "world direction"


def sorted_names(space, way):
    """Make a name of every sort, 3-vectors in a space, 3×3 maps of a way between two."""
    vector, led = (F(1), F(2), F(3)), rational_matrix([[1, 2, 0], [0, 1, 0], [0, 0, 2]])
    names = {Sort.NUMBER: Value(F(2)), Sort.BARE: Value(vector)}
    for kind in Kind:  # in clip space there are points alone
        is_left = space is not Frame.CLIP or kind is Kind.POINT
        names[Sort[kind.name]] = Value(vector, Located(space if is_left else Frame.NDC, kind))
    names |= {Sort[one.name]: Value(led, Map(*way, one)) for one in Carries}
    assert set(names) == set(Sort)
    return names


PLACES = {
    "here": (Frame.OBJECT, (Frame.WORLD, Frame.OBJECT)),
    "there": (Frame.WORLD, (Frame.CAMERA, Frame.WORLD)),
    "projected": (Frame.CLIP, (Frame.CLIP, Frame.CAMERA)),
    "nowhere": (None, (None, None)),
}


def test_every_operator_has_a_rule_for_every_pair_of_things():
    assert set(rules.RULES) == set(OPERATORS)
    for sign, grid in rules.RULES.items():
        assert set(grid) == {(one, other) for one in Sort for other in Sort}, sign


@pytest.mark.parametrize("sign", OPERATORS)
@pytest.mark.parametrize("there", PLACES)
def test_every_pair_has_a_value_or_a_refusal_with_a_right_form(sign, there):
    ours, theirs = sorted_names(*PLACES["here"]), sorted_names(*PLACES[there])
    for one, a in ours.items():
        for other, b in theirs.items():
            names = {"a": a, "b": b}
            try:
                calculate(f"a {sign} b", names)
            except MeaningError as refused:
                assert refused.instead, (sign, one, other)
                calculate(refused.instead, NAMES | names)
            except NMatrixError:
                continue  # sizes, or kinds of value


def test_every_function_has_a_rule():
    assert set(FUNCTIONS) == set(function_rules.RULES)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_every_function_takes_things_of_every_sort_or_refuses_in_one_line(name):
    count = max(1, sum(not one.is_optional for one in FUNCTIONS[name].parameters))
    for place in PLACES.values():
        for value in sorted_names(*place).values():
            try:
                calculate(f"{name}({', '.join(['a'] * count)})", {"a": value})
            except NMatrixError as error:
                assert len(str(error).splitlines()) == 1


def test_untyped_refuses_nothing_and_tells_no_space():
    for expression in WRONG:
        try:
            found = calculate(expression, NAMES, untyped=True).value
        except NMatrixError as error:
            assert not isinstance(error, MeaningError)  # sizes that do not fit
        else:
            assert found.meaning is None


def test_what_untyped_computes_are_the_plain_numbers():
    found = calculate("V @ P @ M", NAMES, untyped=True).value
    plain = ORACLE["V"] @ ORACLE["P"] @ ORACLE["M"]
    np.testing.assert_allclose([float(x) for x in found.numbers], np.asarray(plain).ravel())
    carried = calculate("M @ n", NAMES, untyped=True).value
    assert carried.entries[:3] == (F(-1, 2), 2, 0)


def test_a_space_that_is_a_name_may_be_said_in_quotes_or_by_its_parameter():
    for typed in ('point([1, 2, 3], "world")', "point([1, 2, 3], space=world)"):
        assert calculate(typed, {}).value.meaning == Located(Frame.WORLD, Kind.POINT)
    with pytest.raises(NMatrixError, match="world"):
        calculate("point([1, 2, 3], wrold)", {})


def test_a_comparison_of_maps_says_where_they_lead():
    found = calculate("M == V", NAMES)
    assert found.value.entries is False
    assert found.remarks == (
        "Only numbers are compared: M leads to world space from object space, "
        "V leads to camera space from world space.",
    )
    assert not calculate("linear(V)^-1 == linear(V)^T", NAMES).remarks


def test_floats_know_their_spaces_too():
    found = calculate("normalize(V @ M @ t)", NAMES, Arithmetic.FLOAT).value
    assert str(found.meaning) == "camera direction"
    with pytest.raises(MeaningError):
        calculate("V @ P", NAMES, Arithmetic.FLOAT)


STEPS = {
    "M": ("object", "world", False),
    "V": ("world", "camera", False),
    "inverse(M)": ("world", "object", False),
    "V^-1": ("camera", "world", False),
    "linear(V)": ("world", "camera", False),
    "normal_matrix(M)": ("object", "world", True),
    "M^-T": ("object", "world", True),
    "normal_matrix(V)": ("world", "camera", True),
    "normal_matrix(inverse(M))": ("world", "object", True),
}


@pytest.mark.parametrize("seed", range(4))
def test_a_chain_is_right_if_every_step_begins_where_the_one_before_it_ends(seed):
    """The oracle goes from right to left over the thing; the calculator composes the maps."""
    chance = random.Random(seed)
    refusals = 0
    for _ in range(60):
        thing = chance.choice(["t", "l", "n", "m"])
        space, is_normal = THINGS[thing].split()[-1][:-1], thing in "nm"
        chain = chance.choices(list(STEPS), k=chance.randint(1, 3))
        is_right = True
        for step in reversed(chain):
            source, to, for_normals = STEPS[step]
            is_right = is_right and source == space and for_normals is is_normal
            space = to
        expression = " @ ".join([*chain, thing])
        # 3×3 beside 4×4 is another fault
        sizes = {step.startswith(("normal_matrix", "linear")) for step in chain}
        if len(sizes) > 1:
            continue
        if is_right:
            found = calculate(expression, NAMES).value.meaning
            assert str(found) == f"{space} {'normal' if is_normal else 'direction'}"
        else:
            error = refusal(expression)
            assert calculate(error.instead, NAMES).value, expression
            refusals += 1
    assert refusals > 20


def given(typed):
    return Operand(calculate(typed, NAMES).value, typed)


@pytest.mark.parametrize(
    ("function", "arguments", "meaning"),
    [
        ("look_at", ["eye", "L", "[0, 1, 0]"], "camera ← world"),
        ("look_at", ["p", "q"], "camera ← object"),
        ("look_at", ["[0, 0, 5]"], "camera ← world"),
        ("world", [], "world ← object"),
        ("perspective", ["90", "1", "1", "9"], "clip ← camera"),
        ("frustum", ["1"], "clip ← camera"),
        ("ortho", ["1"], "clip ← camera"),
        ("viewport", ["640", "480"], "window ← ndc"),
        ("project", ["P @ V @ L"], "ndc point"),
        ("unproject", ["point([1, 2, 0], window)", "P @ V", "viewport(8, 6)"], "world point"),
        ("unproject", ["project(P @ V @ L)", "P @ V"], "world point"),
        ("unproject", ["[1, 2, 0]", "P @ V @ M"], "object point"),
        ("lerp", ["p", "q", "1/2"], "object point"),
        ("lerp", ["l", "-l", "1/2"], "world direction"),
        ("lerp", ["n", "n", "1/2"], "object normal"),
        ("lerp", ["V @ M", "V @ M", "1/2"], "camera ← object"),
        ("reflect", ["l", "m"], "world direction"),
        ("slerp", ["[0, 0, 0, 1]", "[1, 0, 0, 0]", "1/2"], "None"),
        ("solve", ["linear(M)", "[1, 2, 3]"], "None"),
        ("adjugate", ["linear(M)"], "object ← world"),
        ("adjugate", ["linear(M @ scale(-1, 1, 1))"], "None"),
        ("linear", ["P"], "None"),
        ("translation", ["P"], "None"),
    ],
)
def test_functions_say_what_their_results_are(function, arguments, meaning):
    found = function_rules.meaning_of(function, [given(typed) for typed in arguments])
    assert str(found) == meaning


@pytest.mark.parametrize(
    ("function", "arguments", "why"),
    [
        ("look_at", ["eye", "p"], "eye is in world space, p in object space"),
        ("project", ["L"], "L is in world space, and project divides"),
        ("unproject", ["L", "P @ V"], "L is in world space, and unproject begins in ndc space"),
        ("unproject", ["point([1, 2, 0], window)", "P @ V"], "in ndc space without a viewport"),
        ("lerp", ["p", "t", "1/2"], "p is a point, t a direction"),
        ("lerp", ["L", "p", "1/2"], "L is in world space, p in object space"),
        ("reflect", ["V @ l", "m"], "V @ l is in camera space, m in world space"),
        ("outer", ["l", "t"], "l is in world space, t in object space"),
        ("transform_plane", ["normal_matrix(M)", "[0, 1, 0, 2]"], "is for normals"),
        ("min", ["p", "L"], "p is in object space, L in world space"),
    ],
)
def test_functions_refuse_what_is_in_two_spaces(function, arguments, why):
    with pytest.raises(RefusedError) as refused:
        function_rules.meaning_of(function, [given(typed) for typed in arguments])
    assert why in refused.value.why


@pytest.mark.parametrize(
    ("expression", "result"),
    [
        ("M @ p == [0, 4, 6, 1]", "yes"),
        ("[0.5, 2, 0, 0] == M @ t", "yes"),
        ("M @ p ≈ [0, 4, 5, 1]", "no"),
        ("p + [1, 0, 0, 0]", "object point (2 2 3)"),
        ("p - [0, 2, 3, 1]", "object direction (1 0 0)"),
        ("[0, 0, 0, 1] - p", "object direction (-1 -2 -3)"),
        ("[0, 0, 0, 1] + l", "world point (1 -2 2)"),
    ],
)
def test_a_literal_with_its_w_is_understood_beside_a_thing_that_leaves_it_out(expression, result):
    assert told(calculate(expression, NAMES).value) == result


@pytest.mark.parametrize("expression", ["p + [1, 0, 0, 1]", "p == [1, 2, 3, 0]"])
def test_a_literal_with_another_w_is_refused_beside_a_point(expression):
    assert calculate(refusal(expression).instead, NAMES).value


def test_a_long_operand_is_cut_in_the_sentence_and_whole_in_the_form():
    long = " + ".join(["l"] * 30)
    error = refusal(f"dot(n, {long})")
    assert f"{long[:60]}… in world space" in str(error)
    assert calculate(error.instead, NAMES).value


def test_a_name_of_another_map_leads_the_way_too():
    names = {"S": Value(NAMES["V"].entries, Map(Frame.LIGHT, Frame.WORLD))}
    error = refusal("dot(l, direction([1, 0, 0], light))", **names)
    assert error.instead == "dot(S @ l, direction([1, 0, 0], light))"


def test_many_roots_are_no_hindrance():
    roots = (
        "["
        + "; ".join(
            " ".join(f"sqrt({prime})" for prime in row)
            for row in ((2, 3, 5), (7, 11, 13), (17, 19, 23))
        )
        + "]"
    )
    M = Value(calculate(roots, {}).value.entries, SCENE["M"])
    assert refusal("M @ n", M=M).mistake is MistakeId.USED_WORLD_MATRIX
    assert str(calculate("M^T @ m", NAMES | {"M": M}).value.meaning) == "object normal"


def test_letters_are_carried_and_refused_as_numbers_are():
    assert str(calculate("V @ M @ point([a, b, c], object)", NAMES).value.meaning) == "camera point"
    assert str(calculate("linear(rotate_z(s))^T @ l", NAMES).value.meaning) == "direction"
    assert "not carried by scale(a, b, c); write " in str(refusal("scale(a, b, c) @ n"))


@pytest.mark.parametrize(
    ("expression", "instead"),
    [
        ("look_at(eye, p)", "look_at(eye, M @ p)"),
        ("dot(b=l, a=n)", "dot(b=l, a=normal_matrix(M) @ n)"),
        ("project(L)", "project(P @ V @ L)"),
        ("project(V @ L)", "project(P @ (V @ L))"),
        ("reflect(V @ l, m)", "reflect(V @ l, normal_matrix(V) @ m)"),
        ("power(M, 2)", "untyped(M)^2"),
        ("lerp(p, t, 1/2)", "lerp(untyped(p), t, 1/2)"),
    ],
)
def test_the_advice_for_functions_moves_the_argument_that_is_elsewhere(expression, instead):
    assert refusal(expression).instead == instead
    assert calculate(instead, NAMES).value


@pytest.mark.parametrize("k", [-2, -1, 0, 1, 3])
def test_a_power_of_a_turn_is_a_turn(k):
    found = calculate(f"V @ power(rotate_z(30), {k}) @ M", NAMES).value.meaning
    assert str(found) == "camera ← object"


def test_an_orthographic_projection_keeps_directions_and_a_perspective_does_not():
    d = "direction([0, 0, 1], ndc)"
    found = calculate(f"inverse(ortho(-2, 2, -1, 1, 1, 9)) @ {d}", {}).value
    assert str(found.meaning) == "camera direction"
    assert "vanishing point" in str(refusal(f"inverse(P) @ {d}"))


def test_a_vector_is_a_direction_and_never_a_point():
    for text in ("vector(p / 2)", "vector(-p)", "vector(p - q)", "vector(t)"):
        still, moved = (calculate(one, NAMES).value for one in (text, f"M @ {text}"))
        x, y, z = still.entries
        assert moved.entries == (-y / 2, 2 * x, z)
        assert moved.meaning == Located(Frame.WORLD, Kind.DIRECTION)
    with pytest.raises(MeaningError, match="would not move along"):
        calculate("M @ vector(p)", NAMES)


def test_a_point_of_clip_space_whose_w_was_cut_off_has_none():
    c = "(P @ V @ M @ p)"
    x, y, z, w = calculate(c, NAMES).value.entries
    assert calculate(f"{c}.w", NAMES).value.scalar == w
    assert w != 1
    assert calculate(f"{c}.xyz / {c}.w", NAMES).value.entries == (x / w, y / w, z / w)
    for text in (f"{c}.xyz.w", f"{c}.xyz / {c}.xyz.w"):
        with pytest.raises(CalculatorError, match="a vector of 3"):
            calculate(text, NAMES)
    with pytest.raises(MeaningError) as refused:
        calculate(f"inverse(P) @ {c}.xyz", NAMES)
    assert ".xyz.w" not in refused.value.instead
