"""Formulas: one tree for the eye, the printer and the ear; and lessons whose links can break."""

from __future__ import annotations

from math import sqrt
from xml.etree import ElementTree

import pytest

from nmatrix.lessons.derive import examples, lighting, reflecting, steps
from nmatrix.lessons.derive import worst_angle as bound
from nmatrix.lessons.derive.cases import TITLES, chosen
from nmatrix.lessons.derive.lesson import LESSONS, derive
from nmatrix.lessons.formulas.mathml import mathml
from nmatrix.lessons.formulas.parse import parse
from nmatrix.lessons.formulas.spoken import spoken
from nmatrix.lessons.formulas.tree import Fence, Fraction, Name, Number, Power, Root, Row, Sign
from nmatrix.lessons.formulas.typst import typst
from nmatrix.report import Step
from nmatrix.scene.world import World

CONTRACT = (
    "rule cofactor translation rotation uniform nonuniform shear mirror singular lightdirection "
    "eye metric reflection"
).split()


def shown() -> list:
    return [block.formula for block in derive("all").blocks if isinstance(block, Step)]


def test_all_stands_for_every_case_of_the_contract() -> None:
    assert list(chosen("all")) == CONTRACT
    assert list(TITLES) == list(LESSONS) == CONTRACT


def test_trees() -> None:
    assert parse("√3/2") == Fraction(Root(Number("3")), Number("2"))
    assert parse("(κ − 1) / 2") == Fraction(Row((Name("κ"), Sign("−"), Number("1"))), Number("2"))
    assert parse("C / det A") == Fraction(Name("C"), Row((Name("det"), Name("A"))))
    assert parse("|n|²") == Power(Fence(Name("n"), bars=True), "²")
    assert parse("tan² θ") == Row((Power(Name("tan"), "²"), Name("θ")))
    assert parse("σ₁") == Name("σ₁")


def test_the_three_printers_agree_on_what_they_say() -> None:
    tree = parse("A⁻ᵀ = C / det A")
    assert typst(tree) == "A^(- top) = frac(C, det A)"
    assert spoken(tree) == "A inverse transposed equals C over the determinant of A"
    assert mathml(tree).count("<mfrac>") == 1
    assert mathml(parse("σ₁²")) == "<msup><msub><mi>σ</mi><mn>1</mn></msub><mn>2</mn></msup>"
    assert spoken(parse("(A t)ᵀ")) == "the group A t end of group transposed"


def test_every_formula_is_well_formed_and_can_be_heard() -> None:
    for formula in shown():
        tree = ElementTree.fromstring(formula.mathml)
        assert tree.get("alttext") == formula.spoken
        assert formula.spoken
        assert "mtext" not in formula.mathml, "every piece is mathematics, not a word"
        assert not set(formula.spoken) & set("⁻ᵀ²·×√≤≠κθσ⇒")


def test_typst_accepts_every_formula() -> None:
    compiler = pytest.importorskip("typst", reason="typst is not installed")
    source = "\n\n".join(f"$ {formula.typst} $" for formula in shown())
    assert compiler.compile(source.encode(), format="pdf").startswith(b"%PDF")


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
    "nothing is equal": (reflecting, "equal", lambda *_: False, reflecting.reflection),
    "a bound from other cofactors": (
        bound.rational, "cofactor_matrix", lambda A: A, lambda: (bound.nothing_is_worse(), ""),
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
    assert examples._angle_between(wrong, right, sp.Rational(3, 4)).verified
    assert not examples._angle_between(wrong, right, sp.Rational(2, 3)).verified
    assert not examples._angle_between(sp.Matrix([5, 7, 1]), right, sp.Rational(3, 4)).verified


def test_the_bound_is_not_proved_for_another_power() -> None:
    import sympy as sp

    first, some, third = sp.symbols("a b c", positive=True)
    gap = first**2 + third**2 - some**2 - first * third / some
    assert not steps.equal(gap * some**2, (first**2 - some**2) * (some**2 - third**2))


def test_ones_own_matrix_follows_once() -> None:
    found = derive("all", World(scale=(1, 2, 1))).data["cases"]
    own = [i for i, case in enumerate(found) for one in case["steps"] if "your" in one["because"]]
    assert set(own) == {0}


def test_a_misspelled_case_is_guessed() -> None:
    with pytest.raises(ValueError, match="did you mean lightdirection"):
        chosen("lightdirecton")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        ("|A n|²", "the squared length of A n"),
        ("|A n| |A⁻ᵀ n|", "the length of A n times the length of A inverse transposed n"),
        ("tan² θ", "tangent squared of theta"),
        ("10¹⁶", "10 to the power 16"),
        ("(A t)ᵀ", "the group A t end of group transposed"),
    ],
)
def test_lengths_and_powers_are_said_as_they_are_meant(line: str, said: str) -> None:
    assert spoken(parse(line)) == said


def test_latex_has_every_sign_of_the_lessons_and_the_pitfalls() -> None:
    from nmatrix.classroom.pitfalls import PITFALLS
    from nmatrix.output.latex import escaped

    prose = [step["because"] for case in derive("all").data["cases"] for step in case["steps"]]
    prose += [text for one in PITFALLS for text in (one.claim, one.verdict)]
    for text in prose:
        assert "textbackslash" not in escaped(text), text
