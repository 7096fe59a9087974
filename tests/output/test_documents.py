"""Documents: balanced, escaped, and with every matrix and vector under its key."""

from __future__ import annotations

import re
from fractions import Fraction
from xml.etree import ElementTree

import pytest

from nmatrix.enums import Format
from nmatrix.output import OutputOptions, write
from nmatrix.report import (
    Code,
    Figure,
    Formula,
    Heading,
    Quantity,
    Report,
    Step,
    Table,
    Text,
    Verdict,
)

DOCUMENTS = [Format.LATEX, Format.MARKDOWN, Format.MATHML, Format.TYPST]
NASTY = "50% of A_1 & B^2 {x} <b> $y$ #z ~ \\w | *s* [l](u) κ√ → “é”"
FORMULA = Formula(("a = b",))
DATA = {
    "world_from_object": ((1.0, 2e-30), (0.0, -3.5)),
    "parts": {"translate": (1.0, 2.0, 3.0)},
    "determinant": Fraction(10) ** 600,
}
REPORT = Report(
    "world",
    DATA,
    (
        Heading(NASTY),
        Text(NASTY),
        Quantity("world_from_object", DATA["world_from_object"], NASTY),  # type: ignore[arg-type]
        Quantity("determinant", DATA["determinant"], unit="°"),  # type: ignore[arg-type]
        Quantity("kind", NASTY),
        Table((NASTY, "n"), ((NASTY, 1e-30), (None, True)), NASTY),
        Step(FORMULA, NASTY, verified=False),
        FORMULA,
        Verdict(NASTY),
        Code("python", "print(1)\n"),
        Figure("a.png", NASTY),
    ),
    (NASTY,),
)


def written(format_: Format) -> str:
    return write(REPORT, OutputOptions(format_))


@pytest.mark.parametrize("format_", DOCUMENTS)
@pytest.mark.parametrize("key", ["world_from_object", "parts.translate"])
def test_every_matrix_and_vector_stands_once_under_its_key(format_: Format, key: str) -> None:
    text = written(format_)
    assert len(re.findall(rf"(?:key: |data-key=\"){re.escape(key)}(?:\"| -->|\n)", text)) == 1


@pytest.mark.parametrize("format_", DOCUMENTS)
def test_what_was_not_proved_says_so(format_: Format) -> None:
    assert "NOT PROVED" in written(format_)


def test_latex_is_balanced_and_in_the_characters_of_its_fonts() -> None:
    text = written(Format.LATEX)
    opened = re.findall(r"\\begin\{(\w+)\}", text)
    assert sorted(opened) == sorted(re.findall(r"\\end\{(\w+)\}", text))
    bare = re.sub(r"\\.", "", text)
    assert bare.count("{") == bare.count("}")
    assert bare.count("$") % 2 == 0
    assert {c for c in text if not c.isascii()} == {"é"}
    body = re.sub(r"(?m)^% key: .*$", "", re.sub(r"\\[%&#_]", "", text))
    assert "%" not in body
    assert "#" not in body


def test_latex_writes_numbers_as_mathematics() -> None:
    text = written(Format.LATEX)
    assert "1 & 2 \\times 10^{-30} \\\\\n  0 & -3.5\n" in text
    assert "determinant: $\\det A = 1 \\times 10^{600}$$^{\\circ}$" in text


def test_markdown_keeps_formulas_between_dollars() -> None:
    lines = [line for line in written(Format.MARKDOWN).splitlines() if "\\times" in line]
    assert lines
    inside = {"  1 & 2 \\times 10^{-30} \\\\"}
    assert all(line in inside or re.search(r"\$[^$]*\\times[^$]*\$", line) for line in lines)


def test_markdown_tables_keep_their_columns() -> None:
    table = [line for line in written(Format.MARKDOWN).splitlines() if line.startswith("| ")]
    assert len(table) == 4
    assert {len(re.findall(r"(?<!\\)\|", line)) for line in table} == {3}


def test_mathml_is_well_formed() -> None:
    root = ElementTree.fromstring(f"<div>{written(Format.MATHML)}</div>")
    namespace = "{http://www.w3.org/1998/Math/MathML}"
    first = root.find(f".//{namespace}mtable")
    assert first is not None
    assert [len(row) for row in first] == [2, 2]
    assert NASTY in [paragraph.text for paragraph in root.iter("p")]


def test_typst_matrices() -> None:
    text = written(Format.TYPST)
    assert 'mat(delim: "[", 1, 2 times 10^(-30); 0, -3.5) $' in text
    assert 'mat(delim: "[", 1; 2; 3) $' in text
    assert "determinant: $det A = 1 times 10^(600)$" in text


@pytest.mark.parametrize(
    ("text", "written"),
    [
        ("A⁻ᵀ", r"A$^{-\mathsf T}$"),
        ("σ₁₂/10⁻¹²", r"$\sigma_{12}$/10$^{-12}$"),
        ("x₁²", r"x$_{1}^{2}$"),
        ("$−5, $$κ", r"\$$-$5, \$\$$\kappa$"),
        ("¹′", "$^{1}{}'$"),
    ],
)
def test_latex_has_one_formula_where_signs_meet(text: str, written: str) -> None:
    from nmatrix.output.formulas.latex_words import escaped

    assert escaped(text) == written
