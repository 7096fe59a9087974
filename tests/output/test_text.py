"""Text for people: aligned, at most 80 columns, the same story in ASCII and in colour."""

from __future__ import annotations

import re
import subprocess
import sys
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nmatrix.output import Charset, Colour, OutputOptions, write
from nmatrix.output.drawing import aligned, draw_matrix
from nmatrix.output.style import render
from nmatrix.report import (
    Block,
    Brief,
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

FLOATS = st.floats(allow_nan=False, allow_infinity=False)
MATRIX = st.lists(st.lists(FLOATS, min_size=4, max_size=4).map(tuple), min_size=4, max_size=4)
WORDS = st.lists(st.sampled_from(["normal", "of", "A⁻ᵀ", "the", "κ", "−1", "perpendicular"])).map(
    " ".join
)
ESCAPE = re.compile(r"\x1b\[[0-9;]*m")


def text_of(*blocks: Block, remarks: tuple[str, ...] = (), **options: object) -> str:
    return write(Report("x", {}, blocks, remarks), OutputOptions(**options))  # type: ignore[arg-type]


AFFINE = ((1.0, 0.0, 0.0, 5.0), (0.0, 0.5, -0.25, 0.0), (0.0, 0.0, 1.0, 10.5), (0.0, 0.0, 0.0, 1.0))


def test_an_affine_matrix() -> None:
    assert text_of(Quantity("world_from_object", AFFINE)) == (
        "world_from_object\n"
        "      x  y     z       t\n"
        "  x ⎡ 1  0     0    │  5   ⎤\n"
        "  y ⎢ 0  0.5  -0.25 │  0   ⎥\n"
        "  z ⎢ 0  0     1    │ 10.5 ⎥\n"
        "  w ⎣ 0  0     0    │  1   ⎦\n"
    )


def test_only_an_affine_matrix_has_a_bar() -> None:
    projection = (*AFFINE[:3], (0.0, 0.0, -1.0, 0.0))
    assert "│" not in text_of(Quantity("clip_from_camera", projection))
    assert "t" not in text_of(Quantity("P", projection))


@given(MATRIX, st.integers(1, 17), st.sampled_from([40, 60, 80]))
@settings(max_examples=150, deadline=None)
def test_no_matrix_is_wider_than_the_page(matrix: list, digits: int, width: int) -> None:
    text = text_of(Quantity("wide", tuple(matrix)), digits=digits, width=width)
    assert max(map(len, text.splitlines())) <= width


@given(MATRIX, st.integers(1, 17))
@settings(max_examples=100, deadline=None)
def test_every_entry_is_there_and_every_row_equally_long(matrix: list, digits: int) -> None:
    lines = draw_matrix(tuple(matrix), OutputOptions(digits=digits, width=400))
    rows = [render(line, Colour.PLAIN) for line in lines[1:]]
    assert len({len(row) for row in rows}) == 1
    for row, entries in zip(rows, matrix, strict=True):
        numbers = re.sub(r"[⎡⎢⎣⎤⎥⎦│]", " ", row[2:]).split()
        assert [float(number) for number in numbers] == [
            float(f"{entry:.{digits}g}") for entry in entries
        ]


@given(st.lists(FLOATS.map(lambda value: f"{value:.6g}"), min_size=1))
def test_points_stand_under_each_other(texts: list[str]) -> None:
    found = aligned(texts)
    assert [cell.strip() for cell in found] == texts
    ones = {re.split(r"[.e]", cell.rstrip())[0].__len__() for cell in found}
    assert len(ones) == 1


def test_vectors_scalars_and_words_line_up() -> None:
    found = text_of(
        Quantity("eye", (0.0, 0.0, 5.0)),
        Quantity("determinant", Fraction(10) ** 600),
        Quantity("angle", 90.0, unit="deg"),
        Quantity("parts", None),
    )
    assert found == (
        "eye          ( 0  0  5 )\ndeterminant  1e+600\nangle        90 deg\nparts        none\n"
    )


def test_a_vector_too_wide_for_a_row_is_a_column() -> None:
    found = text_of(Quantity("v", (1e-300, -1.2345678901e-300, 3.0) * 2), digits=17, width=60)
    assert max(map(len, found.splitlines())) <= 60
    assert found.count("⎢") == 4


@given(WORDS, st.lists(st.tuples(WORDS, FLOATS), min_size=1, max_size=3))
@settings(max_examples=80, deadline=None)
def test_prose_tables_and_steps_keep_the_width(words: str, rows: list) -> None:
    formula = Formula((words or "x",))
    found = text_of(
        Heading(words or "x"),
        Text(words),
        Table(("what", "a long name for a column of numbers"), tuple(rows), words),
        Step(formula, words, verified=True),
        Verdict(words),
        Figure("a.png", f"seen: {words}", "caption"),
        remarks=(words,),
    )
    assert max(map(len, found.splitlines())) <= 80


def test_a_table_that_cannot_fit_becomes_records() -> None:
    columns = tuple(f"column{i}" for i in range(12))
    found = text_of(Table(columns, (tuple(float(f"1.{i}e-100") for i in range(12)),)))
    assert "column11: 1.11e-100\n" in found


def test_a_failed_proof_is_not_called_ok() -> None:
    formula = Formula(("x = y",))
    for charset, good, bad in (
        (Charset.UNICODE, "✓", "✗ not proved"),
        (Charset.ASCII, "ok", "NOT PROVED"),
    ):
        proved = text_of(Step(formula, "so", verified=True), charset=charset)
        failed = text_of(Step(formula, "so", verified=False), charset=charset)
        assert f"{good} so" in proved
        assert bad in failed
        assert good not in failed


@given(st.text(max_size=60))
def test_ascii_is_ascii_and_no_control_character_gets_through(words: str) -> None:
    blocks = (Text(words), Quantity(words, AFFINE, words), Code("x", words), Table((words,), ()))
    assert text_of(*blocks, charset=Charset.ASCII).isascii()
    assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f]", text_of(*blocks))


def test_ascii_spells_what_it_lacks() -> None:
    found = text_of(Text("A⁻ᵀ turns 90° − θ"), Quantity("M", AFFINE), charset=Charset.ASCII)
    assert "A^-T turns 90 deg - theta" in found
    assert "x [ 1  0     0    |  5   ]" in found


def test_colour_changes_no_character() -> None:
    blocks = (Heading("World"), Quantity("M", AFFINE), Verdict("Rigid."), Text("So."))
    coloured = text_of(*blocks, colour=Colour.ANSI)
    assert "\x1b[1m" in coloured
    bare = "\n".join(line.rstrip() for line in ESCAPE.sub("", coloured).split("\n"))
    assert bare == text_of(*blocks)
    assert "\x1b" not in text_of(*blocks)


@pytest.mark.parametrize("module", ["numpy", "rich", "sympy", "typer"])
def test_writing_text_loads_nothing_heavy(module: str) -> None:
    program = (
        "import sys\n"
        "from nmatrix.output import OutputOptions, write\n"
        "from nmatrix.report import Report, Quantity\n"
        "write(Report('x', {}, (Quantity('M', ((1, 0), (0, 1))),)), OutputOptions())\n"
        f"sys.exit({module!r} in sys.modules)"
    )
    assert subprocess.run([sys.executable, "-c", program], check=False).returncode == 0


def test_a_long_path_breaks_after_a_separator() -> None:
    path = "a-folder-of-models/packed-by-its-exporter/BoxTextured.gltf"
    shown = text_of(Table(("path", "why"), ((path, "it is not read " * 6),)), width=60)
    cells = [line.split()[0] for line in shown.splitlines()[2:] if not line.startswith(" ")]
    assert [cell for cell in cells if cell.endswith(("/", "gltf"))] == [
        "a-folder-of-models/",
        "packed-by-its-exporter/",
        "BoxTextured.gltf",
    ]


ABOUT = "Of this node, whose path is long enough for two lines of a page of eighty columns."


@pytest.mark.parametrize("lines", range(6, 20))
def test_what_an_answer_is_of_is_told_whatever_room_there_is(lines: int) -> None:
    blocks = (Verdict("It is so."), Quantity("M", ((1, 0), (0, 1)), "M"), Text("More. " * 20))
    brief = Brief(blocks, ("the cofactors", "determinant, rank and condition", "the parts"), lines)
    report = Report("x", {}, blocks, (ABOUT, "Another."), brief=brief, about=1)
    shown = write(report, OutputOptions())
    assert "It is so." in shown and "Of this node" in shown
    assert len(shown.splitlines()) <= lines
