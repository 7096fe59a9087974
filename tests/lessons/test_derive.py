"""Lessons: every step is proved, a false step is not, and the user's matrix is exact."""

from __future__ import annotations

from fractions import Fraction
from math import sqrt

import pytest

from nmatrix.enums import Convention
from nmatrix.errors import IllegalValueError
from nmatrix.lessons.derive import derivations, kinds_of_maps, lighting
from nmatrix.lessons.derive.lesson import LESSONS, chosen, derive
from nmatrix.lessons.derive.steps import equal
from nmatrix.lessons.derive.users_matrix import exact_matrix
from nmatrix.linear import rational
from nmatrix.output.numbers import members
from nmatrix.scene.world import World


def steps(case: str, world: World | None = None) -> list[dict]:
    return [members(step) for one in derive(case, world).data["cases"] for step in one["steps"]]


def test_all_stands_for_every_lesson() -> None:
    assert tuple(LESSONS) == chosen("all")


@pytest.mark.parametrize("case", LESSONS)
def test_every_step_is_proved(case: str) -> None:
    found = steps(case)
    assert len(found) >= 2
    assert all(step["verified"] is True for step in found), found


def test_a_wrong_cofactor_is_not_proved(monkeypatch: pytest.MonkeyPatch) -> None:
    right = rational.cofactor_matrix
    monkeypatch.setattr(rational, "cofactor_matrix", lambda A: rational.transpose(right(A)))
    assert [step["verified"] for step in steps("rule")].count(False) >= 2


def test_a_false_claim_is_not_proved() -> None:
    import sympy as sp

    x = sp.Symbol("x")
    assert equal((x + 1) ** 2, x**2 + 2 * x + 1)
    assert not equal((x + 1) ** 2, x**2 + 1)


def test_thirty_degrees_give_half_the_root_of_three() -> None:
    import sympy as sp

    block = exact_matrix(World(scale=(1, 2, 1), rotate_degrees=(0, 0, 30)))[:3, :3]
    assert block[0, 0] == sp.sqrt(3) / 2
    assert block[0, 1] == -1
    assert all(step["verified"] for step in steps("nonuniform", World(rotate_degrees=(0, 0, 30))))


@pytest.mark.parametrize(
    "world",
    [
        World(scale=(Fraction(1, 3), 2, 1)),
        World(rotate_degrees=(7, 0, 0)),
        World(scale=(1, 0, 1)),
        World(scale=(-1, 1, 1), rotate_degrees=(45, 30, 60)),
        World(quaternion=(1, 2, 3, 4)),
        World(shear=(1, 2, 3)),
    ],
)
def test_the_users_own_matrix_is_proved_too(world: World) -> None:
    assert all(step["verified"] for step in steps("rule", world))


def test_an_unknown_case_names_the_known_ones() -> None:
    with pytest.raises(IllegalValueError, match="mirror"):
        derive("nothing")


@pytest.mark.parametrize(
    "world",
    [
        World(rotate_degrees=(7, 11, 13)),
        World(rotate_degrees=(50, 20, 40), scale=(1, 2, 3)),
        World(rotate_degrees=(7, 7, 7), shear=(1, 2, 3)),
        World(rotate_degrees=(7, 11, 13), scale=(1, 0, 1)),
    ],
)
def test_several_angles_without_surds_are_proved_without_a_search(world: World) -> None:
    assert all(step["verified"] for step in steps("rule", world))


def test_a_singular_world_with_angles_has_its_rank() -> None:
    found = steps("rule", World(rotate_degrees=(7, 11, 13), scale=(1, 0, 1)))
    assert "the rank is 2" in found[-1]["because"]


def test_a_false_claim_about_several_angles_is_not_proved() -> None:
    import sympy as sp

    A = exact_matrix(World(rotate_degrees=(7, 11, 13), scale=(1, 2, 1)))[:3, :3]
    assert equal(A.det(), sp.Integer(2))
    assert not equal(A.det(), sp.Integer(2) + sp.sin(sp.pi * 7 / 180) / 10**9)
    assert not equal(A.T * A, sp.eye(3))


@pytest.mark.parametrize(
    ("case", "world", "told", "remark"),
    [
        ("nonuniform", World(scale=(2, 2, 2)), "a similarity", None),
        ("nonuniform", World(scale=(3, 1, Fraction(1, 2))), "a non-uniform scale", "71.08°"),
        ("rotation", World(scale=(1, 2, 1)), "a non-uniform scale", "36.87°"),
        ("rotation", World(rotate_degrees=(7, 11, 13)), "a rotation", None),
        ("mirror", World(scale=(1, -2, 1)), "a mirrored non-uniform scale", "inside out"),
        ("rule", World(scale=(1, 0, 1)), "rank 2", "two sides are alike"),
        ("rule", World(scale=(1, 0, 0)), "rank 1", "no normal exists"),
        ("rule", World(quaternion=(0.1, 0.2, 0.3, 0.9)), "a rotation", None),
        ("rule", World(convention=Convention.POLIMI, rotate_degrees=(1, 2, 3)), "a rotation",
         "convention polimi"),
    ],
)  # fmt: skip
def test_ones_own_matrix_has_a_conclusion_of_its_own(case, world, told, remark) -> None:
    report = derive(case, world)
    (lesson,) = report.data["cases"]
    assert told in lesson["own_conclusion"]
    assert "rounding" not in lesson["own_conclusion"], "surds have none"
    assert lesson["conclusion"] == derive(case).data["cases"][0]["conclusion"]
    assert (remark is None and not report.remarks) or remark in " ".join(report.remarks)


def test_a_third_is_a_third_and_not_its_float() -> None:
    thirds = rational.rational_matrix([[1, 2, 0], [2, 4, 0], [0, 0, 3]])
    world = World(matrix=rational.affine_matrix(rational.scaled(thirds, Fraction(1, 3))))
    assert "rank 2" in derive("rule", world).data["cases"][0]["own_conclusion"]


def test_ones_own_translation_goes_to_the_last_row() -> None:
    world = World(translate=(1, 2, 3), scale=(2, 4, 1))
    last = steps("translation", world)[-1]
    assert last["verified"]
    assert last["text"].split("=")[1].split() == ["[", "−1/2", "−1/2", "−3", "]"]


def test_angles_without_short_roots_keep_a_name_and_matrices_a_page() -> None:
    world = World(rotate_degrees=(20, 35.5, 50), scale=(1, 2, 1))
    found = steps("rule", world)[-8:]
    assert all(step["verified"] for step in found)
    assert all(len(line) <= 78 for step in found for line in step["text"].split("\n"))
    assert [step["text"] for step in found[1:4]] == [
        f"c{i} = cos({angle}°),  s{i} = sin({angle}°)"
        for i, angle in (("₁", "20"), ("₂", "35.5"), ("₃", "50"))
    ]
    roots = steps("rule", World(rotate_degrees=(30, 45, 60)))
    assert not any("cos(" in step["text"] for step in roots)


@pytest.mark.parametrize(
    ("scale", "shown"),
    [
        ((10**200, 1, 1), "10²⁰⁰"),
        ((3 * 10**20, 1, 1), "1/(3·10²⁰)"),
        ((1, Fraction(1, 10**30), 1), "1/10³⁰"),
    ],
)  # fmt: skip
def test_long_rows_of_zeros_are_powers_of_ten(scale, shown) -> None:
    found = steps("rule", World(scale=scale))
    assert any(shown in step["text"] for step in found)
    assert all("0" * 15 not in step["text"] + step["latex"] for step in found)


def test_the_three_shades_are_those_of_floats() -> None:
    n, light = (1 / sqrt(2), 1 / sqrt(2), 0), (0.3, 0.9, 0.2)
    world = (n[0], 4 * n[1], 0)

    def cosine(a, b):
        dot = sum(x * y for x, y in zip(a, b, strict=True))
        return dot / sqrt(sum(x * x for x in a)) / sqrt(sum(x * x for x in b))

    for found, closed in (
        (cosine(world, light), 39 / sqrt(1598)),
        (cosine(n, (0.3, 0.225, 0.2)), 21 / (17 * sqrt(2))),
        (cosine(n, (0.3, 3.6, 0.2)), 39 / sqrt(2618)),
    ):
        assert found == pytest.approx(closed, rel=1e-12)


def unproved(lesson) -> int:
    return [one.verified for one in lesson()[0]].count(False)


MUTANTS = {
    "light by another rule": (lighting, "adjugate", lambda A: A, lighting.lightdirection),
    "a length by another metric": (
        lighting, "product", lambda A, B: B, lighting.lightdirection,
    ),
    "the eye by other cofactors": (
        lighting, "cofactors", lambda A: A.T, lighting.eye,
    ),
    "a metric without its inverse": (lighting, "cofactors", lambda A: A, lighting.metric),
    "nothing is equal": (lighting, "equal", lambda *_: False, lighting.reflection),
    "a bound from other cofactors": (
        derivations.rational, "cofactor_matrix", lambda A: A,
        lambda: (derivations.worst_angle_bound(), ""),
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", MUTANTS)
def test_a_broken_link_is_not_proved(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    module, attribute, mutant, lesson = MUTANTS[name]
    assert unproved(lesson) == 0
    monkeypatch.setattr(module, attribute, mutant)
    assert unproved(lesson) > 0


def test_another_angle_is_not_proved() -> None:
    import sympy as sp

    wrong, right = sp.Matrix([1, 2, 0]), sp.Matrix([2, 1, 0])
    assert kinds_of_maps._angle_between(wrong, right, sp.Rational(3, 4)).verified
    assert not kinds_of_maps._angle_between(wrong, right, sp.Rational(2, 3)).verified
    assert not kinds_of_maps._angle_between(sp.Matrix([5, 7, 1]), right, sp.Rational(3, 4)).verified


def test_the_bound_is_not_proved_for_another_power() -> None:
    import sympy as sp

    first, some, third = sp.symbols("a b c", positive=True)
    gap = first**2 + third**2 - some**2 - first * third / some
    assert not equal(gap * some**2, (first**2 - some**2) * (some**2 - third**2))


def test_ones_own_matrix_follows_once() -> None:
    found = derive("all", World(scale=(1, 2, 1))).data["cases"]
    own = [i for i, case in enumerate(found) for one in case["steps"] if "your" in one.because]
    assert set(own) == {0}


def test_a_misspelled_case_is_guessed() -> None:
    with pytest.raises(ValueError, match="did you mean lightdirection"):
        chosen("lightdirecton")
