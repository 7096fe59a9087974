"""Nodes that are passed over as plain: an oracle of its own finds nothing to say of any of them."""

from __future__ import annotations

import json
from fractions import Fraction
from math import degrees
from pathlib import Path

import mpmath
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from nmatrix.answers.inspect.file import inspect_file
from nmatrix.answers.inspect.plain import suspects
from nmatrix.enums import Flaw, Kind
from nmatrix.scene.gltf.nodes import placed
from nmatrix.scene.gltf.records import NodeRecord

Matrix = list[list[Fraction]]

near_one = st.floats(-3e-6, 3e-6).map(lambda off: 1 + off)
lengths = st.one_of(
    st.sampled_from([1.0, -1.0, 2.0, 0.5, 0.0, 1e-3, 1e150, 1e-150, 1 + 1e-7, 1 - 3e-8]),
    near_one,
    st.floats(0.01, 100),
)
scales = st.one_of(
    lengths.map(lambda one: [one] * 3),
    st.tuples(lengths, lengths, lengths).map(list),
    st.tuples(near_one, near_one, near_one).map(list),
)
quaternions = st.lists(st.floats(-1, 1), min_size=4, max_size=4).filter(any)
matrices = st.one_of(
    st.lists(st.floats(-2, 2), min_size=9, max_size=9),
    st.permutations([0, 1, 2]).map(lambda order: [float(i == j) for j in order for i in range(3)]),
)


@st.composite
def node_records(draw) -> dict[str, object]:
    if draw(st.integers(0, 4)) == 0:
        m = draw(matrices)
        return {"matrix": [*m[0:3], 0.0, *m[3:6], 0.0, *m[6:9], 0.0, 1.0, 2.0, 3.0, 1.0]}
    found: dict[str, object] = {}
    if draw(st.booleans()):
        found["rotation"] = draw(quaternions)
    if draw(st.booleans()):
        found["scale"] = draw(scales)
    return found


@st.composite
def trees(draw) -> list[dict[str, object]]:
    nodes = draw(st.lists(node_records(), min_size=1, max_size=7))
    for index in range(1, len(nodes)):
        parent = nodes[draw(st.integers(0, index - 1))]
        parent.setdefault("children", []).append(index)
    return nodes


def block(record: dict[str, object]) -> Matrix:
    """The 3×3 block of a node's own map, by the formulas of the specification."""
    if "matrix" in record:
        m = record["matrix"]
        return [[Fraction(m[4 * j + i]) for j in range(3)] for i in range(3)]
    x, y, z, w = map(Fraction, record.get("rotation", (0, 0, 0, 1)))
    n = x * x + y * y + z * z + w * w
    turned = [
        [1 - 2 * (y * y + z * z) / n, 2 * (x * y - z * w) / n, 2 * (x * z + y * w) / n],
        [2 * (x * y + z * w) / n, 1 - 2 * (x * x + z * z) / n, 2 * (y * z - x * w) / n],
        [2 * (x * z - y * w) / n, 2 * (y * z + x * w) / n, 1 - 2 * (x * x + y * y) / n],
    ]
    size = [Fraction(one) for one in record.get("scale", (1, 1, 1))]
    return [[turned[i][j] * size[j] for j in range(3)] for i in range(3)]


def times(a: Matrix, b: Matrix) -> Matrix:
    return [[sum(a[i][k] * b[k][j] for k in range(3)) for j in range(3)] for i in range(3)]


def worlds(nodes: list[dict[str, object]]) -> list[Matrix]:
    """Exact products down the hierarchy, never rounded."""
    found: dict[int, Matrix] = {0: block(nodes[0])}
    for index, record in enumerate(nodes):
        for child in record.get("children", ()):
            found[child] = times(found[index], block(nodes[child]))
    return [found[index] for index in range(len(nodes))]


def columns(m: Matrix) -> list[list[Fraction]]:
    return [[m[i][j] for i in range(3)] for j in range(3)]


def determinant(m: Matrix) -> Fraction:
    (a, b, c), (d, e, f), (g, h, i) = m
    return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g)


def is_plain(m: Matrix, tolerance: Fraction) -> bool:
    """Perpendicular columns of one length, and no mirror: by the definition of the contract."""
    if determinant(m) <= 0:
        return False
    dots = [[sum(x * y for x, y in zip(p, q, strict=True)) for q in columns(m)] for p in columns(m)]
    squares = [dots[i][i] for i in range(3)]
    if max(squares) > (1 + tolerance) ** 2 * min(squares):
        return False
    pairs = ((0, 1), (0, 2), (1, 2))
    return all(dots[i][j] ** 2 <= tolerance**2 * squares[i] * squares[j] for i, j in pairs)


def written(folder: Path, nodes: list[dict[str, object]]) -> Path:
    path = folder / "tree.gltf"
    path.write_text(json.dumps({"asset": {"version": "2.0"}, "nodes": nodes}))
    return path


def records(nodes: list[dict[str, object]]) -> list[NodeRecord]:
    return [NodeRecord(**node) for node in nodes]


@given(trees())
@settings(max_examples=200, deadline=None)
def test_what_is_passed_over_is_plain(nodes: list[dict[str, object]]) -> None:
    passed_over = set(range(len(nodes))) - set(suspects(placed(Path(), records(nodes), 0), 1e-6))
    exact = worlds(nodes)
    for index in passed_over:
        assert is_plain(exact[index], Fraction(1e-6))


@given(trees())
@settings(
    max_examples=100, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_flaws_found_by_a_look_at_suspects_are_those_of_all_nodes(
    tmp_path: Path, nodes: list[dict[str, object]]
) -> None:
    found = inspect_file(written(tmp_path, nodes))
    assert found.flawed == tuple(node for node in found.nodes if node.flaws)


@given(trees())
@settings(
    max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
def test_kinds_and_angles_agree_with_an_oracle_of_their_own(
    tmp_path: Path, nodes: list[dict[str, object]]
) -> None:
    """κ by singular values of 120 digits; what is next to a limit may fall on either side."""
    for node, exact in zip(
        inspect_file(written(tmp_path, nodes)).nodes, worlds(nodes), strict=True
    ):
        det = determinant(exact)
        assert node.maps.determinant_sign == (det > 0) - (det < 0)
        assert (Flaw.SINGULAR in node.flaws) == (det == 0)
        assert (Flaw.MIRRORED in node.flaws) == (det < 0)
        if det == 0:
            continue
        upright = exact if det > 0 else [[-entry for entry in row] for row in exact]
        looser, tighter = Fraction(1.0001e-6), Fraction(0.9999e-6)
        if is_plain(upright, tighter) == is_plain(upright, looser):
            assert node.maps.needs_inverse_transpose != is_plain(upright, looser)
        largest = max(abs(entry) for row in exact for entry in row)
        if abs(det) < largest**3 / 10**50:
            continue  # beyond the digits of the other side
        with mpmath.workdps(120):
            singular = mpmath.svd_r(
                mpmath.matrix(
                    [[mpmath.mpf(x.numerator) / x.denominator for x in r] for r in exact]
                ),
                compute_uv=False,
            )
            kappa = max(singular) / min(singular)
            right = degrees(float(mpmath.atan((kappa - 1 / kappa) / 2)))
        assert node.maps.worst_angle_deg == pytest.approx(right, rel=1e-9, abs=1e-9)


@pytest.mark.parametrize("scale", [1e-160, 1e160, 5e-324])
def test_chains_that_leave_the_range_of_squares_are_looked_at(scale: float) -> None:
    nodes = [NodeRecord(scale=[scale] * 3, children=[1]), NodeRecord(scale=[scale] * 3)]
    assert 1 in suspects(placed(Path(), nodes, 0), 1e-6)


@pytest.mark.parametrize(("i", "j"), [(0, 1), (0, 2), (1, 2)])
def test_a_matrix_that_leans_by_one_pair_of_columns_is_looked_at(i: int, j: int) -> None:
    """All columns have the length one, and the two others are perpendicular to each other."""
    columns = [[float(row == column) for row in range(3)] for column in range(3)]
    columns[j][i], columns[j][j] = 0.28, 0.96
    entries = [entry for column in columns for entry in (*column, 0.0)]
    node = NodeRecord(matrix=[*entries, 0.0, 0.0, 0.0, 1.0])
    assert suspects(placed(Path(), [node], 0), 1e-6) == [0]


def test_deviations_add_up_down_a_chain(tmp_path: Path) -> None:
    """Each of thirty scales is within the tolerance, and their product is not."""
    step = [1, 1, 1 + 1e-7]
    nodes: list[dict[str, object]] = [{"scale": step, "children": [i + 1]} for i in range(30)]
    found = inspect_file(written(tmp_path, [*nodes, {}]))
    assert found.nodes[5].maps.kind is not Kind.NON_UNIFORM_SCALE
    assert [node.index for node in found.flawed] == list(range(9, 31))


def chain(folder: Path, length: int) -> Path:
    turn = {"rotation": [0, 0, 0.6, 0.8], "translation": [0, 0, 1]}
    nodes: list[dict[str, object]] = [{**turn, "children": [i + 1]} for i in range(length)]
    return written(folder, [*nodes, {"scale": [1, 2, 1]}])


def test_a_chain_of_twenty_thousand_plain_nodes_needs_no_matrix(tmp_path: Path) -> None:
    assert inspect_file(chain(tmp_path, 20_000)).suspects == [20_000]


def test_the_end_of_a_long_chain_is_placed_by_all_above_it(tmp_path: Path) -> None:
    (last,) = inspect_file(chain(tmp_path, 1500)).flawed
    assert last.world_from_object[2][3] == 1500
    assert last.maps.kind is Kind.NON_UNIFORM_SCALE
    assert last.path.startswith("…/")
