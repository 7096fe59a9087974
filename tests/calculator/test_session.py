"""A session: each statement alone, what stays when one fails, and a transcript that is the same."""

from __future__ import annotations

import json
import re
from fractions import Fraction
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import nmatrix
from nmatrix.calculator.arithmetic.values import Arithmetic
from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.language.statements import Keyword, is_open, statement, statements
from nmatrix.calculator.sessions.handbook import FORMATS, USAGE
from nmatrix.calculator.sessions.offers import offers
from nmatrix.calculator.sessions.orders import enter
from nmatrix.calculator.sessions.session import NoFiles, Reply, Session
from nmatrix.enums import InverseBy, Numbers
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.output.transcript import Disk, run, text_of, transcript, turn
from nmatrix.output.write import Charset, OutputOptions
from nmatrix.reading.matrix import matrix_literal
from nmatrix.reading.notations import NOTATIONS
from nmatrix.report import ENVELOPE

EMPTY, NO_FILES = Session({}), NoFiles()


PAGE = (Path(__file__).parents[2] / "docs" / "calculator.md").read_text(encoding="utf-8")


def after(*lines: str, files=NO_FILES) -> Session:
    """Enter lines that all succeed."""
    session = EMPTY
    for line in lines:
        session, reply = enter(session, line, files)
        assert reply.error is None, (line, reply.error)
    return session


def refused(line: str, session: Session = EMPTY, files=NO_FILES) -> NMatrixError:
    """Enter a line that fails, and check that it changes nothing."""
    same, reply = enter(session, line, files)
    assert same is session
    assert reply.error is not None, line
    return reply.error


def shown(*lines: str, session: Session = EMPTY) -> str:
    report = transcript(session, "\n".join(lines), OutputOptions(), NoFiles())
    return report.blocks[0].text


def test_a_value_is_kept_under_its_name_and_the_last_two_without_one():
    session = after("a = 1/3", "a + 1/6", "7", "b = ans * ans2")
    assert {name: one.scalar for name, one in session.names.items()} == {
        "a": Fraction(1, 3), "ans": 7, "ans2": Fraction(1, 2), "b": Fraction(7, 2),
    }  # fmt: skip


def test_a_statement_that_fails_keeps_everything():
    session = after("a = 2", "a + 1")
    for line in ("a = 1/0", "a = ", "a = Q", "b = a +", "1 2 x", "show q", "digits 0", "load no"):
        refused(line, session)
    assert refused("1/0").exit_code == 3
    assert refused("1/").exit_code == 2


@pytest.mark.parametrize(
    ("line", "column"),
    [
        ("2 + Q", 4), ("  x = 2 + Q", 10), ("x=1/0", 3), ("inverse([1 2; 2 4])", 8),
        ("det = 3", 0), ("steps sideways", 6), ("show q", 5), ("[1 2", 0), ("digits", 0),
        ("x = 3 $ 4", 6),
    ],
)  # fmt: skip
def test_the_caret_stands_under_the_fault(line, column):
    echo, caret, error, *more = shown(line).splitlines()
    assert echo == f"> {line}"
    assert caret == f"{' ' * (2 + column)}^"
    assert error.startswith("error: ")
    assert all(len(one) <= 80 and "caret" not in one for one in (error, *more))


def test_the_caret_of_a_statement_of_several_lines_stands_under_its_line():
    lines = shown("a = [1 2", "3 Q", "5 6]").splitlines()
    assert lines[3:5] == ["  3 Q", "    ^"]


def test_the_caret_of_a_long_line_stands_under_the_part_that_is_shown():
    line = "+".join(["1000"] * 20) + "+Q+" + "+".join(["1000"] * 20)
    part, caret, _ = shown(line).splitlines()[1:]
    assert part[caret.index("^")] == "Q"
    assert len(part) < 80


def test_the_caret_counts_the_columns_that_are_shown():
    ascii_only = OutputOptions(charset=Charset.ASCII)
    assert turn(EMPTY, "1+√2+)", ascii_only, NO_FILES).text.startswith(f"{' ' * 12}^\n")
    assert turn(EMPTY, "1+√2+)", OutputOptions(), NO_FILES).text.startswith(f"{' ' * 7}^\n")
    assert turn(EMPTY, "'界' + )", OutputOptions(), NO_FILES).text.startswith("  ^\n")
    assert turn(EMPTY, "[1 #界\n+)", OutputOptions(), NO_FILES).text.startswith("   ^\n")


def test_undo_goes_back_one_change_at_a_time():
    session = after("a = 1", "a = 2", "digits 3", "vars", "# nothing", "a = 3")
    values = []
    while session.before is not None:
        values.append((session.names["a"].scalar, session.settings.digits))
        session, _ = enter(session, "undo", NoFiles())
    assert values == [(3, 3), (2, 3), (2, 6), (1, 6)]
    assert refused("undo", session).exit_code == 2


def test_settings_change_what_follows():
    lines = shown("1/3", "numbers decimal", "digits 3", "ans", "numbers both", "ans").splitlines()
    assert lines[1] == "ans  1/3"
    assert lines[5] == "ans  0.333"
    assert re.fullmatch(r"ans  1/3 ≈ 0\.333", lines[8])
    assert after("steps on").settings.steps
    assert not after("steps on", "steps off").settings.steps
    for way in InverseBy:
        assert after(f"steps by {way}").settings.by is way
    for one in Numbers:
        assert after(f"numbers {one}").settings.numbers is one


@pytest.mark.parametrize("keyword", Keyword)
def test_every_keyword_is_explained_offered_and_no_name(keyword):
    assert USAGE[keyword][1] in shown("help").replace("\n                ", " ")
    assert USAGE[keyword][0] in shown(f"help {keyword}")
    assert keyword in offers((), keyword[:2]).words
    assert refused(f"{keyword} = 1").exit_code == 2
    assert statement(USAGE[keyword][0]).keyword is keyword


def test_help_fits_on_a_small_screen_and_lists_every_function_elsewhere():
    assert len(shown("help").splitlines()) <= 22
    assert set(FUNCTIONS) <= set(shown("help functions").split())


@pytest.mark.parametrize("name", FUNCTIONS)
def test_help_of_a_function_has_what_it_does_its_formula_and_an_example_that_runs(name):
    told = shown(f"help {name}")
    one = FUNCTIONS[name]
    assert one.does.split()[-1] in told
    assert one.formula.split()[0] in told
    assert told.splitlines()[-1].endswith(one.example.split()[-1])
    after(one.example)
    assert re.search(rf"\b{name}\b", PAGE)
    assert f"{name}(" in offers((), f"2 * {name[:-1]}").words


def test_a_word_that_help_does_not_know_is_guessed():
    assert "did you mean inverse?" in str(refused("help invrese"))
    assert "did you mean glsl?" in str(refused("show a as glls", after("a = 1")))
    assert "did you mean det" in str(refused("dett([1 2; 3 4])"))


@pytest.mark.parametrize("format_", FORMATS)
def test_a_value_is_shown_in_every_format(format_):
    text = shown("A = [2 3; 5 7]", f"show A as {format_}").partition(f"as {format_}\n")[2]
    assert all(digit in text for digit in "2357")
    if format_ in ("json", "csv", "numpy", "glsl", "latex"):
        found = matrix_literal(text)
        assert found.rows_exact == ((2, 3), (5, 7))


@pytest.mark.parametrize("notation", NOTATIONS, ids=lambda one: one.name)
def test_every_notation_is_a_value_when_it_is_pasted(notation):
    wanted = matrix_literal(notation.example).rows_exact
    text = f"B = {notation.example}"
    if statement(notation.example).name is not None:  # it has a name of its own
        text = f"{notation.example}\nB = {statement(notation.example).name}"
    if notation.example.startswith("M\n"):  # its first line is a name
        text = f"B =\n{notation.example.removeprefix('M')}"
    [*_, (_, last)] = run(EMPTY, f"{text}\n\n", OutputOptions(), NoFiles())
    assert last.error is None
    assert last.session.names["B"].matrix == wanted


@pytest.mark.parametrize(
    "text",
    ["1 0 0\n0 2 0\n0 0 1", "1\t0\t0\n0\t2\t0\n0\t0\t1", "\n\n  1  0  0\n  0  2  0\n  0  0  1",
     "1,0 0,0 0,0\n0,0 2,0 0,0\n0,0 0,0 1,0", "1 0 0; 0 2 0; 0 0 1", "[1 0 0\n0 2 0\n\n0 0 1]",
     "-1 -0 0\n0 2 0\n0 0 1"],
)  # fmt: skip
def test_rows_without_brackets_end_at_an_empty_line_or_a_statement(text):
    first = -1 if text.startswith("-") else 1
    for end in ("\n\ndet(B)", "\ndet(B)"):
        if end == "\ndet(B)" and "[" in text:
            continue
        [*_, (_, last)] = run(EMPTY, f"B = {text}{end}", OutputOptions(), NoFiles())
        assert last.error is None
        assert last.session.names["ans"].scalar == 2 * first


def test_what_is_assigned_to_anything_but_a_name_is_refused():
    session = after("A = [1 2; 3 4]")
    for line in (
        "A[0, 0] = 5",
        "A[0, :] = [5 6]",
        "é = [1 2]",
        "2 = 3",
        "A.T = [1 2; 3 4]",
        "a b c",
    ):
        assert refused(line, session).exit_code == 2


def test_a_declaration_of_a_program_gives_the_name_that_it_declares():
    session = after(
        "const mat2 m = mat2(1, 2, 3, 4);",
        "let y = 5",
        "float q[2][2] = {{1, 0}, {0, 7}};",
        "var z = 2*y",
        "const mat2x3 r = mat2x3(\n 1, 2, 3,\n 4, 5, 6);",
    )
    assert session.names["m"].matrix == ((1, 3), (2, 4))
    assert session.names["q"].matrix == ((1, 0), (0, 7))
    assert session.names["r"].matrix == ((1, 4), (2, 5), (3, 6))
    assert (session.names["y"].scalar, session.names["z"].scalar) == (5, 10)
    assert "ans" not in session.names
    taken = enter(session, "const float cos = 3;", NO_FILES)[1]
    assert taken.error is not None and taken.at == len("const float ")


def test_a_greek_letter_may_be_given_a_value_and_pi_may_not():
    session = after("λ = 2", "θ2 = 30")
    assert enter(session, "λ^3 * sin(θ2)", NO_FILES)[0].names["ans"].scalar == 4
    assert refused("π = 3", session).exit_code == 2


@pytest.mark.parametrize("line", ["|[3, 4]|", "|v|", "|-3|", "||[3, 4]||", "x = | -2.5 |"])
def test_bars_ask_for_a_length_and_begin_no_matrix(line):
    session = after("v = [3, 4]")
    assert "write length(v)" in str(refused(line, session))
    assert list(statements([line, "1 + 1"])) == [(1, line), (2, "1 + 1")]


@pytest.mark.parametrize("line", ["exit", "quit()", "whos", "?", "quit now", "undo 2", "vars all"])
def test_what_other_programs_write_is_told_its_word_here(line):
    assert refused(line, after("a = 1")).parts[2].startswith("write ")


def test_a_difference_is_no_row():
    assert after("x = 1 -2").names["x"].scalar == -1
    assert not is_open("x = 1 -2")
    assert is_open("x = 1 2")


def test_statements_that_were_saved_make_the_same_session(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    lines = ("a = [1 2", "3 4]", "# remark", "b = 1 0", "0 1", "", "a @ b", "digits 4", "c = Q",
             "ans^2", "undo")  # fmt: skip
    [*_, (_, last)] = run(EMPTY, "\n".join((*lines, "save it.txt")), OutputOptions(), Disk())
    assert last.error is None
    again = after("load it.txt", files=Disk())
    assert again.names == last.session.names
    assert again.settings == last.session.settings
    assert enter(again, "undo", NoFiles())[0].names == {}


def test_a_file_that_fails_changes_nothing_and_the_error_names_its_line(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("bad.txt").write_text("a = 1\nb = [1\n2]\nc = Dd\n")
    error = refused("load bad.txt", after("a = 2"), Disk())
    assert str(error).startswith("bad.txt, line 4: name Dd")
    assert error.exit_code == 2


def test_a_file_that_is_loaded_reads_and_writes_no_other(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("self.txt").write_text("a = 1\nload self.txt\n")
    Path("writes.txt").write_text("save other.txt\n")
    for name in ("self.txt", "writes.txt"):
        refused(f"load {name}", files=Disk())
    assert sorted(path.name for path in tmp_path.iterdir()) == ["self.txt", "writes.txt"]


def test_only_a_file_of_the_session_is_written_again(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    Path("theirs.txt").write_text("precious\n")
    refused("save theirs.txt", after("a = 1"), Disk())
    assert Path("theirs.txt").read_text() == "precious\n"
    for name in ("x" * 5000, "no/where", ".", "~nobody/x", "theirs.txt/x"):
        refused(f"save {name}", after("a = 1"), Disk())
        refused(f"load {name}", after("a = 1"), Disk())
    after("a = 1 # \udcff", "save odd.txt", files=Disk())
    session = after("a = 1", "save mine.txt", "b = 2", "save mine.txt", files=Disk())
    assert Path("mine.txt").read_text() == "a = 1\nb = 2\n"
    session, _ = enter(session, "undo", Disk())
    assert enter(session, "save mine.txt", Disk())[1].error is None


@pytest.mark.parametrize(
    "content",
    [b"\x00\x01", b"\xff\xfe\xff", b"a = 1\x1b[2J\n", b"1" * 10**6, b"[\n" * 10**5, b"\x89PNG\r\n"],
)
def test_a_file_that_is_no_text_or_too_long_is_refused(content):
    with pytest.raises(IllegalValueError):
        text_of(content, "x")


def test_a_line_of_a_million_characters_is_refused_and_the_session_goes_on():
    session = after("a = 1")
    a_name = f"{'a' * 9000} = 1"
    for text in ("1+" * 500_000, "(" * 10**6, "x=" + "1 " * 10**6, "help " + "x" * 10**6, a_name):
        done = turn(session, text, OutputOptions(), NoFiles())
        assert done.error is not None
        assert done.error.exit_code == 2
        assert len(done.text) < 700
        assert done.session is session


SIGNS = "= == - + * / @ ^ ** ( ) [ ] { } , ; .T .inv [0] # ' √ π ° ≈ \\begin{ mat2( 90deg".split()
WORDS = ("a", "M", "ans", "1", "1/3", "0", "1e308", "as", "json", "on", "by", "__class__", "é", "λ")
HOSTILE = ("\n", " ", "\t", "| ", '"', "\x00", "\x1b[2J", "\ud800")
PIECES = (*Keyword, *FUNCTIONS, *SIGNS, *WORDS, *HOSTILE)


@given(st.lists(st.lists(st.sampled_from(PIECES), max_size=8).map("".join), max_size=6))
@settings(max_examples=150, deadline=None)
def test_a_session_survives_everything(lines):
    session = after("a = 2", "M = [1 2; 3 4]")
    for _, text in statements("\n".join(lines).split("\n")):
        done = turn(session, text, OutputOptions(), NoFiles())
        assert "Traceback" not in done.text
        assert (done.error is None) or done.session is session
        session = done.session


def test_statements_hold_every_line_once_and_in_order():
    lines = [
        "a = [1",
        "2]",
        "",
        "b =",
        "",
        "1 2",
        "3 4",
        "c = 1 2",
        "show b",
        "# x",
        "load f",
        "M =",
        "",
    ]
    parts = list(statements(lines))
    assert "\n".join(text for _, text in parts).split("\n") == lines
    assert [line for line, _ in parts] == [1, 3, 4, 8, 9, 10, 11, 12]


def test_python_runs_the_same_lines():
    text = "A = [2 1; 1 1]\ninverse(A)\nA @ ans\nx = Q\nsteps on\ndet(A)\n"
    session = Session(nmatrix_names())
    wanted = transcript(session, text, OutputOptions(), NoFiles()).blocks[0].text
    report = nmatrix.calc(text)
    assert str(report) == wanted
    lines = report.data["lines"]
    assert [line["expression"] for line in lines] == text.splitlines()
    assert [line["exact"] for line in lines[1:3]] == [
        [["1", "-1"], ["-1", "2"]], [["1", "0"], ["0", "1"]]
    ]  # fmt: skip
    assert (lines[3]["value"], lines[3]["column"], lines[0]["error"]) == (None, 5, None)
    assert lines[3]["error"].startswith("name Q (character 1): ")
    assert lines[5]["steps"][-1]["text"].endswith("1")
    assert report.failure.exit_code == 2
    assert nmatrix.calc("1/3").data["exact"] == "1/3"
    assert nmatrix.calc("a = 1/3").data["lines"][0]["value"] == 1 / 3


def nmatrix_names():
    from nmatrix.calculator.names import EVERY_NAME, names_of
    from nmatrix.scene.setup import Setup

    return names_of(Setup(), EVERY_NAME)


def test_a_rounded_session_stays_rounded():
    report = nmatrix.calc("a = 0.1\na + 0.2 - 0.3", rounded=True)
    assert report.data["lines"][1]["value"] == 0.1 + 0.2 - 0.3
    assert after("1").settings.arithmetic is Arithmetic.EXACT


def test_quit_ends_a_run():
    assert shown("a = 1", "quit", "b = 2") == "> a = 1\na  1\n> quit\n"


def test_tab_offers_what_may_stand_there():
    assert offers(["Mars"], "2 + M").words == ("Mars",)
    assert offers(["Mars"], "Mars.").words == ("T", "inv", "w", "x", "xyz", "y", "z")
    assert offers(["Mars"], "show ").words == ("Mars",)
    assert offers(["Mars"], "show Mars as ").words == tuple(sorted(FORMATS))
    assert offers([], "steps by ").words == tuple(sorted(InverseBy))
    assert offers([], "load a b").is_file
    assert offers([], "load a b").begun == "a b"


@pytest.mark.parametrize("name", [*ENVELOPE, "M", "remarks_"])
def test_a_name_keeps_its_value_beside_the_keys_of_every_answer(name):
    session = after(f"{name} = 7/2")
    reply = turn(session, f"show {name} as json", OutputOptions(), NO_FILES)
    pairs = json.loads(reply.text, object_pairs_hook=list)
    keys = [key for key, _ in pairs]
    assert len(set(keys)) == len(keys)
    assert [value for key, value in pairs if key.startswith(name) and value == 3.5]
    assert dict(pairs)["command"] == "calc"


@pytest.mark.parametrize("text", ["[[5]]", "[[1, 2, 3]]", "[[√2, 1/3]]", "[[a, 2]]"])
@pytest.mark.parametrize("format_", FORMATS)
def test_a_matrix_of_one_row_is_shown_in_every_format(text, format_):
    session = after(f"R = {text}")
    assert "\n  [ " in shown(f"R = {text}") or "[ a  2 ]" in shown(f"R = {text}")
    done = turn(session, f"show R as {format_}", OutputOptions(), NO_FILES)
    assert "Fraction" not in done.text
    assert done.error is None or "a" in text


def test_one_row_is_told_from_a_vector_where_a_format_can():
    shows = {f: turn(after("R = [[1, 2]]"), f"show R as {f}", OutputOptions(), NO_FILES).text
             for f in FORMATS}  # fmt: skip
    assert json.loads(shows["json"])["R"] == [[1, 2]]
    assert "R,0,1,2.0" in shows["csv"]
    assert "1 & 2" in shows["latex"]
    assert "1 & 2" in shows["markdown"]
    assert 'mat(delim: "[", 1, 2)' in shows["typst"]
    assert "const vec2 R = vec2(1.0, 2.0);" in shows["glsl"]  # which has no matrix of one row


@pytest.mark.parametrize("line", ["# words", "// words", "% words", "  %", "<!-- key: M -->"])
def test_remarks_of_other_programs_are_remarks(line):
    session = after("a = 1")
    assert enter(session, line, NO_FILES) == (session, Reply())


@pytest.mark.parametrize(
    "printed",
    [
        '// key: M\n$ "M" = mat(delim: "[", 1, 2/3; 4, 5) $',
        '<math display="block"><mtable><mtr><mtd><mn>1</mn></mtd><mtd><mfrac><mn>2</mn><mn>3</mn>'
        "</mfrac></mtd></mtr><mtr><mtd><mn>4</mn></mtd><mtd><mn>5</mn></mtd></mtr></mtable></math>",
        "% key: M\n\\[ M = \\begin{bmatrix} 1 & 2/3 \\\\ 4 & 5 \\end{bmatrix} \\]",
    ],
)
def test_markup_that_holds_an_equals_sign_is_read(printed):
    done = list(run(EMPTY, printed, OutputOptions(), NO_FILES))
    assert done[-1][1].error is None
    assert done[-1][1].session.names["ans"].matrix == ((1, Fraction(2, 3)), (4, 5))


@pytest.mark.parametrize("line", ["save /nonexistent/q", "b = 1 == 1\nshow b as glsl", "Nope + 1"])
def test_the_error_that_a_run_ends_in_is_spelled_as_in_its_transcript(line):
    report = transcript(EMPTY, line, OutputOptions(), Disk())
    *_, shown_as = report.blocks[0].text.split("error: ")
    told = report.failure.spelled(lambda name: f"--{name}").split(": see the caret")[0]
    assert "--" not in told
    assert " ".join(shown_as.split()) in told.replace(" (character 1)", "")


def test_an_option_in_the_advice_of_an_operation_is_spelled_as_one():
    assert shown("2^9999").endswith("try --float\n")
