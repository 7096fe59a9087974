"""Formulas: one line as typed, one tree, and a printer for the eye, the page and the ear."""

from __future__ import annotations

import re
from xml.etree import ElementTree

import pytest

from nmatrix.formula import (
    SIGNS,
    Fence,
    Name,
    Numeral,
    Power,
    Quotient,
    Root,
    Row,
    Sign,
    Words,
    parse,
)
from nmatrix.lessons.derive.lesson import derive
from nmatrix.lessons.exercises.exercise import ExerciseKind
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercises
from nmatrix.output.drawing import draw_formula
from nmatrix.output.formulas.latex import SIGNS as LATEX_SIGNS
from nmatrix.output.formulas.latex import latex
from nmatrix.output.formulas.mathml import equation, mathml
from nmatrix.output.formulas.spoken import SIGNS as SPOKEN_SIGNS
from nmatrix.output.formulas.spoken import spoken
from nmatrix.output.formulas.typst import typst
from nmatrix.report import Formula, Step
from nmatrix.scene.world import World


def of_lessons() -> list[Formula]:
    own = World((1, 2, 3), (20, 30, 40), scale=(1, 2, -3), shear=(1, 0, 0))
    blocks = (*derive("all").blocks, *derive("mirror", own).blocks)
    return [block.formula for block in blocks if isinstance(block, Step)]


def of_exercises() -> list[Formula]:
    sheet = exercises(2 * len(ExerciseKind), Sheet("7", "Ada"))
    blocks = (block for one in sheet for block in (*one.asked, *one.key))
    return [block for block in blocks if isinstance(block, Formula)]


def test_what_a_calculator_takes_keeps_together() -> None:
    """A slash takes a call, a list or a part whole, and no root more than what it was given."""
    assert parse("sqrt(3)/2") == Quotient(Root(Numeral("3")), Numeral("2"))
    assert parse("cross(a, b)/2") == Quotient(
        Row((Name("cross"), Fence(Row((Name("a"), Sign(","), Name("b")))))), Numeral("2")
    )
    assert parse("[1 2; 3 4]/2") == Quotient(Words("[1 2; 3 4]"), Numeral("2"))
    assert parse("A[0, 0]/2") == Quotient(Row((Name("A"), Words("[0, 0]"))), Numeral("2"))
    assert parse("A^-T") == Power(Name("A"), "−⊤")


def test_every_sign_is_known_to_the_writers_that_need_a_word_for_it() -> None:
    assert set(LATEX_SIGNS) == set(SPOKEN_SIGNS) == SIGNS


def test_trees() -> None:
    assert parse("√3/2") == Quotient(Root(Numeral("3")), Numeral("2"))
    assert parse("(κ − 1) / 2") == Quotient(Row((Name("κ"), Sign("−"), Numeral("1"))), Numeral("2"))
    assert parse("C / det A") == Quotient(Name("C"), Row((Name("det"), Name("A"))))
    assert parse("|n|²") == Power(Fence(Name("n"), bars=True), "2")
    assert parse("tan² θ") == Row((Power(Name("tan"), "2"), Name("θ")))
    assert parse("σ₁") == Name("σ₁")


def test_the_printers_agree_on_what_they_say() -> None:
    tree = parse("A⁻ᵀ = C / det A")
    assert latex(tree) == r"A^{-\mathsf T} = \frac{C}{\det A}"
    assert typst(tree) == "A^(- top) = frac(C, det A)"
    assert spoken(tree) == "A inverse transposed equals C over the determinant of A"
    assert mathml(tree).count("<mfrac>") == 1
    assert mathml(parse("σ₁²")) == "<msup><msub><mi>σ</mi><mn>1</mn></msub><mn>2</mn></msup>"


@pytest.mark.parametrize(
    ("line", "printed"),
    [
        ("C (u × v)", r"C\,(u \times v)"),
        ("|A n| |B n|", r"|A n|\,|B n|"),
        ("v = −p / |p|", r"v = -\frac{p}{|p|}"),
        ("sign(det A) · C n", r"\operatorname{sign}(\det A) \cdot C n"),
        ("c₁ = cos(20°)", r"c_{1} = \cos(20^\circ)"),
        ("answer = n′", r"\mathrm{answer} = n^{\prime}"),
        ("a = 1,  b = nx", r"a = 1,\; b = n_{x}"),
        ("A = I  ⇒  (A²)ᵀ = I", r"A = I \;\Rightarrow\; (A^{2})^{\mathsf T} = I"),
        ("x²^3", "{x^{2}}^{3}"),
    ],
)
def test_latex_is_written_as_one_writes_it(line: str, printed: str) -> None:
    assert latex(parse(line)) == printed


@pytest.mark.parametrize("formulas", [of_lessons, of_exercises])
def test_every_formula_prints_in_every_notation(formulas) -> None:
    for formula in formulas():
        tree = formula.tree
        matrices = sum(not isinstance(part, str) for part in formula.parts)
        page = ElementTree.fromstring(equation(mathml(tree), spoken(tree)))
        assert page.get("alttext") == spoken(tree)
        assert sum(node.tag.endswith("mtable") for node in page.iter()) == matrices
        assert typst(tree).count("mat(") == matrices
        assert len(re.findall(r"\[ |⎡ ", draw_formula(formula, 10**6))) == matrices
        assert spoken(tree)
        assert not set(spoken(tree)) & set("⁻ᵀ²·×√≤≠κθσ⇒")


@pytest.mark.parametrize("formulas", [of_lessons, of_exercises])
def test_latex_is_balanced_and_in_the_characters_that_pdflatex_reads(formulas) -> None:
    for formula in formulas():
        printed = latex(formula.tree)
        assert printed.isascii()
        assert printed.count("{") == printed.count("}")
        matrices = sum(not isinstance(part, str) for part in formula.parts)
        brackets = printed.count(r"\begin{bmatrix}") + printed.count(r"\left[\begin{array}")
        assert brackets == matrices


def test_every_piece_of_a_lesson_is_mathematics_and_not_a_word() -> None:
    for formula in of_lessons():
        assert "mtext" not in mathml(formula.tree)
        assert r"\mathrm" not in latex(formula.tree)


def test_typst_accepts_every_formula() -> None:
    compiler = pytest.importorskip("typst", reason="typst is not installed")
    shown = (*of_lessons(), *of_exercises())
    source = "\n\n".join(f"$ {typst(formula.tree)} $" for formula in shown)
    assert compiler.compile(source.encode(), format="pdf").startswith(b"%PDF")


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

    prose = [step.because for case in derive("all").data["cases"] for step in case["steps"]]
    prose += [line for one in PITFALLS for line in (one.claim, one.verdict)]
    for line in prose:
        assert "textbackslash" not in escaped(line), line
