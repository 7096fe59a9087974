"""What notebooks see: every public value shows itself, safely, and reads back as what it is."""

from __future__ import annotations

import re
import subprocess
import sys
from enum import StrEnum
from fractions import Fraction
from pathlib import Path
from types import FunctionType
from xml.etree import ElementTree

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import nmatrix
from nmatrix.output.notebook import MOST_ROWS
from nmatrix.report import Displayed, Table, Tone, Verdict
from nmatrix.report import Report as Told

ROOT = Path(__file__).resolve().parents[2]
EVIL = "<script>alert('1')</script> $x$ & \\begin{a}_{b}^% #~"
FAULTY = "uniform mat4 model; in vec3 n; out vec3 N; void main() { N = mat3(model) * n; }"
TURNED = nmatrix.Setup(world={"scale": (1, 2, 1), "rotate": (0, 30, 0)})
BUILT = {
    "Angle": nmatrix.Angle.degrees(30),
    "Classification": nmatrix.classify(np.diag([1.0, 2, 1])),
    "ClipSpace": nmatrix.ClipSpace(),
    "FirstPerson": nmatrix.FirstPerson(1, 2, 3),
    "Lens": nmatrix.Lens(),
    "Light": nmatrix.Light(position=(1, 2, 3)),
    "Picture": nmatrix.render("bias", size=(60, 40)),
    "Report": TURNED.world(),
    "Setup": TURNED,
    "Transform": nmatrix.Transform.of("camera", "object", np.diag([1.0, 2, 1])),
    "TransformedNormals": nmatrix.transform_normals(np.eye(3), [(0, 1, 0)], status=True),
    "View": nmatrix.View(eye=(1, 2, 3)),
    "Window": nmatrix.Window(-1, 3, -1, 1),
    "World": nmatrix.World(scale=(1, Fraction(1, 3), 1)),
}
ANSWERS = {
    "a world": TURNED.world(steps=True),
    "a view": TURNED.view(),
    "a projection": TURNED.projection(at=(1, 2)),
    "normals": TURNED.normal([(1, 1, 0), (0, 1, 0)]),
    "a light": TURNED.light(),
    "an eye": TURNED.eye(),
    "a space": TURNED.space("object"),
    "a vertex": TURNED.trace((0, 1, 0)),
    "an expression": nmatrix.calc("inverse(A)", let={"A": [[2, 1], [1, 1]]}, steps=True),
    "a session": nmatrix.calc("a = 2/3\na^2 < 1\nsqrt(ans)"),
    "a lesson": nmatrix.derive("mirror"),
    "a check": nmatrix.check("normal", [[1, 0, 0], [0, 2, 0], [0, 0, 1]], TURNED),
    "an exercise": nmatrix.check_exercise(2, "1 0 0; 0 1 0; 0 0 1", seed=7, student="Ada"),
    "readings": nmatrix.identify("1 0 0 0; 0 1 0 0; 0 0 1.001 -0.1001; 0 0 1 0"),
    "axes": nmatrix.axes("ros", "opencv"),
    "a file": nmatrix.inspect(ROOT / "docs" / "samples" / "gate.gltf"),
    "a plan": nmatrix.plan(ROOT / "docs" / "scenes" / "mirror.toml"),
    "findings": nmatrix.lint({f"{EVIL}.vert": FAULTY}),
    "a batch": nmatrix.show(nmatrix.world(scale=[(1, 2, 1)] * 100), EVIL),
    "rows": nmatrix.show(np.arange(300.0).reshape(100, 3)),
    "large and small": nmatrix.show([[1e300, -1e-300], [5e-324, 0.1]], EVIL),
    "thousands of digits": nmatrix.World(scale=(10**5000, 1, 1)),
    "an eye in its target": nmatrix.View(eye=(0, 0, 0)),
    "a setup without a camera": nmatrix.Setup(view={"eye": (0, 0, 0)}),
    "a lens that is none": nmatrix.Lens(near=5, far=5),
}
EVERYTHING = {**BUILT, **ANSWERS}
# Commands that TeX, MathJax and KaTeX have alike.
KNOWN = set(
    r"\begin \end \frac \sqrt \surd \text \mathrm \mathsf \operatorname \texttt \left \right "
    r"\cdot \times \pm \approx \neq \le \ge \to \leftarrow \leftrightarrow \Rightarrow "
    r"\Leftrightarrow \circ \infty \prime \det \alpha \beta \theta \kappa \lambda \sigma "
    r"\varphi \sin \cos".split()
)
OF_TEXT = {r"\textbackslash", r"\textasciitilde", r"\textasciicircum", r"\dots"}


def shown(value: object) -> dict[str, str]:
    return value._repr_mimebundle_(include=None, exclude=None)  # as marimo and IPython ask


def parsed(html: str) -> ElementTree.Element:
    return ElementTree.fromstring(f"<output>{html}</output>")


def page(value: object) -> ElementTree.Element:
    return parsed(shown(value)["text/html"])


def matrices(latex: str) -> list[str]:
    return re.findall(r"\\begin\{bmatrix\}.*?\\end\{bmatrix\}", latex, re.DOTALL)


def kind_of(name: str) -> type | None:
    """The class of a public name that has values to be shown."""
    one = getattr(nmatrix, name)
    if isinstance(one, FunctionType):
        return None  # its results are shown
    if not isinstance(one, type):
        assert name == "__version__"  # a text
        return None
    if issubclass(one, StrEnum):
        return None  # a word is shown as the word that it is
    return None if issubclass(one, Exception) else one  # the notebook shows errors


def test_every_public_value_shows_itself() -> None:
    kinds = {name: kind for name in nmatrix.__all__ if (kind := kind_of(name))}
    assert set(BUILT) == set(kinds)
    for name, kind in kinds.items():
        assert issubclass(kind, Displayed)
        assert isinstance(BUILT[name], kind)


@pytest.mark.parametrize("name", EVERYTHING)
def test_whatever_is_shown_is_text_and_one_element_that_is_well_formed(name: str) -> None:
    value = EVERYTHING[name]
    bundle = shown(value)
    assert bundle["text/plain"].strip()
    assert "\x1b" not in bundle["text/plain"]
    if isinstance(value, nmatrix.Picture):
        assert set(bundle) == {"text/plain", "image/png"}
        assert bundle["image/png"] == value.png
        return
    style, body, beside = parsed(bundle["text/html"])
    assert (style.tag, body.tag, beside.tag) == ("style", "div", "pre")
    assert "".join(body.itertext()).strip()
    assert beside.text.strip()
    if isinstance(value, nmatrix.Report):
        assert beside.text == value.to("text").strip("\n")


@pytest.mark.parametrize("name", [name for name in EVERYTHING if name != "Picture"])
def test_nothing_that_is_shown_runs_loads_or_styles_what_is_outside(name: str) -> None:
    root = page(EVERYTHING[name])
    for one in root.iter():
        tag = one.tag.rpartition("}")[2]
        assert tag not in {"script", "iframe", "object", "link", "img", "form", "a", "b"}
        loads = {key for key in one.attrib if key in {"id", "href", "src"} or key.startswith("on")}
        assert not loads
    style = root.find("style").text
    rules = re.findall(r"([^{}]+)\{[^}]*\}", style)
    assert rules
    assert all(part.strip().startswith(".nmatrix") for rule in rules for part in rule.split(","))
    assert "url(" not in style
    assert "@" not in style


@pytest.mark.parametrize("name", [name for name in EVERYTHING if name != "Picture"])
def test_latex_is_balanced_and_has_no_command_that_mathjax_lacks(name: str) -> None:
    latex = shown(EVERYTHING[name]).get("text/latex", "")
    bare = re.sub(r"\\[{}$%&#_\\]", " ", latex)
    depth = 0
    for mark in bare:
        depth += (mark == "{") - (mark == "}")
        assert depth >= 0
    assert depth == 0
    opened = re.findall(r"\\begin\{(\w+)\}", bare)
    assert sorted(opened) == sorted(re.findall(r"\\end\{(\w+)\}", bare))
    assert set(opened) <= {"bmatrix", "array"}
    used = set(re.findall(r"\\[A-Za-z]+", bare))
    assert used <= KNOWN | OF_TEXT
    assert set(re.findall(r"\\[A-Za-z]+", outside_of_dollars(bare))) <= OF_TEXT


def outside_of_dollars(latex: str) -> str:
    """What MathJax leaves alone: it looks for the same dollars again, outside of braces."""
    found, opened, depth = "", "", 0
    for mark in re.findall(r"\$\$|[^$]|\$", latex):
        depth += (mark == "{") - (mark == "}")
        if "$" in mark and not opened:
            opened, depth = mark, 0
        elif mark == opened and depth == 0:
            opened = ""
        elif not opened:
            found += mark
    assert not opened
    return found


FRACTIONS = st.fractions(-1000, 1000, max_denominator=999)


@given(st.lists(st.lists(FRACTIONS, min_size=4, max_size=4), min_size=3, max_size=3))
def test_mathml_and_latex_are_read_again_as_the_same_transform(rows: list) -> None:
    exact = (*map(tuple, rows), (Fraction(0), Fraction(0), Fraction(0), Fraction(1)))
    bundle = shown(nmatrix.Transform.of("world", "object", exact))
    (latex,) = matrices(bundle["text/latex"])
    for written in (latex, bundle["text/html"]):
        assert nmatrix.show(written).data["value"] == [[float(x) for x in row] for row in exact]
        assert nmatrix.show(written)._repr_report_().blocks[0].value == exact


def test_roots_and_fractions_are_told_as_such() -> None:
    latex = shown(TURNED)["text/latex"]
    assert r"\frac{\sqrt{3}}{2}" in latex
    assert r"-\frac{1}{2}" in latex
    third = shown(nmatrix.Angle.degrees(45))["text/latex"]
    assert third.count(r"\frac{\sqrt{2}}{2}") == 2


def test_a_transform_names_its_frames() -> None:
    for to, source in (("camera", "object"), ("world", "object"), ("light", "custom")):
        bundle = shown(nmatrix.Transform.of(to, source, np.eye(4)))
        words = "".join(parsed(bundle["text/html"])[1].itertext())
        assert re.search(rf"{to}\s*←\s*{source}", words)
        assert bundle["text/plain"].startswith(f"Transform({to}_from_{source}, ")


def test_names_are_shown_as_they_are() -> None:
    for value in (ANSWERS["large and small"], ANSWERS["findings"]):
        assert EVIL in "".join(page(value)[1].itertext())


def test_mathjax_leaves_the_dollars_of_names_alone() -> None:
    for value in EVERYTHING.values():
        if not isinstance(value, nmatrix.Picture):
            _, body, beside = page(value)
            assert {"tex2jax_ignore", "mathjax_ignore"} <= set(body.get("class").split())
            assert beside.tag == "pre"  # which it leaves alone, too


def test_without_its_style_only_the_text_is_left_to_see() -> None:
    _, body, beside = page(TURNED.world())
    assert body.get("hidden") is not None
    assert beside.get("hidden") is None


def test_what_has_no_matrix_is_shown_with_the_sentence_that_says_why() -> None:
    for name in ("an eye in its target", "a setup without a camera", "a lens that is none"):
        verdict = page(ANSWERS[name]).find(".//p")
        assert verdict.get("class") == f"verdict {Tone.WRONG}"
        assert ":" in verdict.text
        assert ";" in verdict.text


@pytest.mark.parametrize("tone", Tone)
def test_a_conclusion_has_the_class_of_its_tone(tone: Tone) -> None:
    class Concluded(Displayed):
        def _repr_report_(self) -> Told:
            return Told.of_value(Verdict("So it is.", tone))

    assert page(Concluded()).find(".//p").get("class") == f"verdict {tone}"


def test_a_long_answer_is_folded_below_its_short_form_and_complete() -> None:
    whole = page(TURNED.world())
    folded = whole.find(".//details")
    assert folded is not None
    above = [one for one in whole[1] if one.tag != "details"]
    keys = [one.get("data-key") for part in above for one in part.iter() if one.get("data-key")]
    assert keys == ["world_from_object", "normal_matrix"]
    assert {one.get("data-key") for one in folded.iter()} >= {*keys, "cofactor_matrix"}


def test_a_table_ends_after_so_many_rows_and_says_how_many_are_left() -> None:
    class Long(Displayed):
        def _repr_report_(self) -> Told:
            return Told.of_value(Table(("i",), tuple((i,) for i in range(MOST_ROWS + 7))))

    root = page(Long())[1]
    assert len(root.findall(".//tr")) == 1 + MOST_ROWS
    assert "7 more rows" in root.findall(".//p")[-1].text


def test_printing_and_repr_are_what_they_were() -> None:
    assert str(TURNED.world()) == TURNED.world().to("text") == shown(TURNED.world())["text/plain"]
    assert repr(BUILT["Window"]) == "Window(left=-1.0, right=3.0, bottom=-1.0, top=1.0)"
    for name in set(BUILT) - {"Report", "Picture", "TransformedNormals"}:
        assert shown(BUILT[name])["text/plain"] == repr(BUILT[name])


def test_values_that_are_not_shown_load_no_writer() -> None:
    script = (
        "import sys, nmatrix; print(repr(nmatrix.World(scale=(1, 2, 1)))); "
        "print([name for name in sys.modules if name.startswith('nmatrix.output')])"
    )
    done = subprocess.run(
        [sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT
    )
    assert done.stdout.splitlines()[-1] == "[]"


class TestShow:
    def test_it_takes_arrays_exact_rows_and_text(self) -> None:
        half = [[0.5, 0.0], [0.0, 2.0]]
        for value in (half, np.array(half), ((Fraction(1, 2), 0), (0, 2)), "1/2 0; 0 2"):
            assert nmatrix.show(value, "A").data == {"A": half}

    def test_a_number_a_vector_and_a_column_of_many(self) -> None:
        assert nmatrix.show(np.float64(0.25)).data == {"value": 0.25}
        assert nmatrix.show(np.array(3)).data == {"value": 3}
        assert nmatrix.show(range(3)).data == {"value": [0, 1, 2]}
        rows = page(nmatrix.show(np.arange(100.0))).findall(".//tr")
        assert [row[0].text for row in rows] == ["value", *map(str, range(24))]

    def test_of_a_batch_the_first_are_shown_under_their_index(self) -> None:
        told = "".join(page(nmatrix.show(np.ones((30, 2, 3, 3)), "N"))[1].itertext())
        assert "N[23][1]" in told
        assert "N[24]" not in told
        assert "… and 6 more" in told

    def test_a_value_is_shown_as_it_shows_itself(self) -> None:
        lens = nmatrix.Lens()
        assert shown(nmatrix.show(lens))["text/latex"] == shown(lens)["text/latex"]

    def test_a_name_that_has_a_letter_elsewhere_stays_a_name(self) -> None:
        for name in ("matrix", "rotation", "eye", "determinant"):
            assert rf"\text{{{name}}} = " in shown(nmatrix.show(np.eye(3), name))["text/latex"]

    @pytest.mark.parametrize(
        "value",
        [float("nan"), [1, float("inf")], [[1, 2], [3]], [[1, 2], 3], [], np.ones((0, 3)), {"a": 1},
         None, object(), [[]], "no numbers", np.array(["a"]), np.ones(2) * 1j],
    )  # fmt: skip
    def test_what_holds_no_numbers_is_refused(self, value: object) -> None:
        with pytest.raises(nmatrix.IllegalValueError, match="value"):
            nmatrix.show(value)
