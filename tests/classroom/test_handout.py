"""Handouts: every writer writes every block, nothing leaks, a class is finished after a kill."""

from __future__ import annotations

import json
import re
import shlex
from dataclasses import replace
from html.parser import HTMLParser
from itertools import combinations
from pathlib import Path

import pytest

from nmatrix.canvas import marks as canvas_text
from nmatrix.classroom import run as running
from nmatrix.classroom.first_page import CLAIM, SYMBOLS, drawn_idea, rule
from nmatrix.classroom.handout import HandoutPlan, handout, key_of, pictures_beside, student_files
from nmatrix.classroom.pitfalls import PITFALLS
from nmatrix.classroom.roster import slug, students
from nmatrix.classroom.topics import PROOFS, Topic
from nmatrix.classroom.worked import worked
from nmatrix.cli.app import run
from nmatrix.lessons.check.judge import Outcome
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.linear.rational import cofactor_matrix, determinant, linear_part
from nmatrix.output.pages.document import Document, Field, PageFormat, Paper, write
from nmatrix.raster.image import png
from nmatrix.reading.records import records_of
from nmatrix.report import (
    Blank,
    Code,
    Figure,
    Formula,
    Framed,
    Heading,
    PageBreak,
    Quantity,
    Step,
    Symbols,
    Table,
    Task,
    Text,
    Verdict,
)
from nmatrix.scene.setup import Setup
from nmatrix.scene.world import World

pytestmark = pytest.mark.usefixtures("own_folder")

EVIL = "<script>alert(1)</script> #import $x$ \\input{x} `c` *b* [l](u) ]] </style> _ % & \" '"
FORMATS = list(PageFormat)
PAGE_POINTS = (210 - 2 * 18) / 25.4 * 72  # the width of a picture on A4


def typst_or_skip() -> None:
    pytest.importorskip("typst", reason="typst is not installed")


def a_picture() -> bytes:
    import numpy as np

    return png(np.zeros((2, 2, 3), np.uint8), {})


def everything(word: str = "word") -> Document:
    formula = Formula(("a = b",))
    blocks = (
        Heading(word),
        Text(word),
        Verdict(word),
        Quantity("world_from_object", ((1.5, 0.0), (0.0, -1e-9)), word),
        Quantity("scalar", 2.5, word),
        Table((word, "n"), ((word, 1.5), (None, True)), word),
        formula,
        Step(formula, word, verified=True),
        Step(formula, word, verified=False),
        Code("glsl", "void main() {}\n"),
        Figure("a.png", word, word, word),
        Symbols((("M", word), ("l", word), ("n", word))),
        Framed((Verdict(word), formula)),
        Task(word, (Text(word), Code("glsl", "x;\n"), Blank(2, 3, has_room=True)), 4),
        Task(word, (Blank(3, 1), Blank(1, 1))),
        Table((word, "n"), tuple((word, formula) for _ in range(30))),
        PageBreak(),
        Text("- 1. + = /"),
    )
    head = (Field(word, word), Field(word))
    return Document(word, blocks, head, word, {"a.png": a_picture()})


@pytest.mark.parametrize("kind", FORMATS)
def test_every_writer_writes_every_block(kind: PageFormat) -> None:
    if kind is PageFormat.PDF:
        typst_or_skip()
    assert len(write(everything(), kind)) > 200


@pytest.mark.parametrize("kind", FORMATS)
@pytest.mark.parametrize("paper", Paper)
def test_hostile_words_are_only_words(kind: PageFormat, paper: Paper) -> None:
    if kind is PageFormat.PDF:
        typst_or_skip()
    document = everything(EVIL)
    text = write(replace(document, paper=paper), kind)
    if kind is PageFormat.HTML:
        assert b"<script" not in text
    if kind is PageFormat.TEX:
        assert b"\\input{" not in text
    if kind is PageFormat.MD:
        assert b"<script" not in text.replace(b"\\<script", b"")


class Reader(HTMLParser):
    """Collects what a page refers to, and whether its tags close."""

    VOID = ("meta", "img", "br", "link")

    def __init__(self) -> None:
        super().__init__()
        self.open: list[str] = []
        self.images: list[dict] = []
        self.formulas: list[dict] = []
        self.drawings: list[dict] = []
        self.tags: set[str] = set()

    def handle_starttag(self, tag: str, attrs: list) -> None:
        self.tags.add(tag)
        if tag == "img":
            self.images.append(dict(attrs))
        if tag == "div" and ("role", "img") in attrs and ("class", "room") not in attrs:
            self.drawings.append(dict(attrs))
        if tag == "math":
            self.formulas.append(dict(attrs))
        if tag not in self.VOID:
            self.open.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.open.pop() == tag


def test_a_page_stands_alone_and_can_be_heard() -> None:
    plan = HandoutPlan(tuple(Topic), Setup(World(scale=(1, 2, 1))), 10)
    text = student_files(plan, Sheet("1", "Ada")).sheet.decode()
    reader = Reader()
    reader.feed(text)
    assert not reader.open
    assert not reader.tags & {"script", "link", "iframe", "object"}
    assert not re.findall(r"(?:src|href)=\"(?!data:|#)", text)
    assert not re.findall(r"url\(\"?(?!data:|\"data:)", text)
    assert "default-src 'none'" in text
    assert all(len(image["alt"]) > 40 for image in reader.images)
    assert all(len(drawing["aria-label"]) > 40 for drawing in reader.drawings)
    assert len(reader.drawings) == 1 + len(PROOFS)
    assert all(formula.get("alttext") for formula in reader.formulas)
    assert len(text) < 700_000


def test_the_font_is_small_and_its_licence_is_beside_it() -> None:
    from importlib.resources import files

    folder = files("nmatrix.output.pages")
    assert len(folder.joinpath("math.woff2").read_bytes()) <= 60 * 1024
    assert "SIL OPEN FONT LICENSE Version 1.1" in folder.joinpath("OFL.txt").read_text()


def test_pdf_is_the_same_bytes_twice() -> None:
    typst_or_skip()
    plan = HandoutPlan((Topic.RULE, Topic.EXERCISES), Setup(), 3, PageFormat.PDF)
    first, second = (student_files(plan, Sheet("1", "Ada")).sheet for _ in range(2))
    assert first == second
    assert first.startswith(b"%PDF")


@pytest.mark.slow
def test_pdflatex_accepts_a_whole_sheet_and_fills_no_line_too_far(tmp_path) -> None:
    import shutil
    import subprocess

    if shutil.which("pdflatex") is None:
        pytest.skip("pdflatex is not installed")
    plan = HandoutPlan(
        tuple(Topic), Setup(World(scale=(1, 2, 1))), 10, PageFormat.TEX, with_key=True
    )
    found = student_files(plan, Sheet("1", f"Łucja {EVIL}"))
    beside = pictures_beside(plan).items()
    for name, content in (("sheet.tex", found.sheet), ("key.tex", found.key), *beside):
        (tmp_path / name).write_bytes(content)
    for name in ("sheet.tex", "key.tex"):
        done = subprocess.run(
            ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", name],
            cwd=tmp_path, capture_output=True, check=False,
        )  # fmt: skip
        assert done.returncode == 0, done.stdout[-2000:].decode("utf-8", "replace")
        widest = re.findall(rb"Overfull .hbox .([0-9.]+)pt too wide", done.stdout)
        assert all(float(width) < 8 for width in widest), widest


def test_latex_opens_and_closes_everything_in_order() -> None:
    plan = HandoutPlan(tuple(Topic), Setup(World(scale=(1, 2, 1))), 10, PageFormat.TEX)
    source = student_files(plan, Sheet("1", f"Łucja {EVIL}")).sheet.decode()
    source = re.sub(r"\\begin\{verbatim\}.*?\\end\{verbatim\}", "", source, flags=re.DOTALL)
    source = re.sub(
        r"\\newenvironment.*?(?=\\newsavebox|\\begin\{document)", "", source, flags=re.DOTALL
    )
    source = re.sub(r"(?<!\\)%.*", "", source)
    found: list[str] = []
    for what, name in re.findall(r"\\(begin|end)\{(\w+)\}", source):
        if what == "begin":
            found.append(name)
        else:
            assert found.pop() == name
    assert not found
    plain = re.sub(r"\\[{}\\]", "", source)
    assert plain.count("{") == plain.count("}")
    assert len(re.findall(r"(?<!\\)\$", source)) % 2 == 0
    used = set(re.findall(r"\\includegraphics\[[^]]*\]\{([^}]*)\}", source))
    assert used == set(pictures_beside(plan))


def test_a_picture_without_words_is_refused_in_every_format() -> None:
    for words in ("", " "):
        with pytest.raises(ValueError, match="needs words"):
            Figure("a.png", words)


def test_a_pdf_refuses_a_picture_without_words_by_itself(monkeypatch) -> None:
    typst_or_skip()
    import typst

    figure = Figure("a.png", "words")
    object.__setattr__(figure, "alternative", "")
    with pytest.raises(typst.TypstError, match="alt"):
        write(Document("t", (figure,), pictures={"a.png": a_picture()}), PageFormat.PDF)


def test_the_key_is_another_document_and_not_on_the_sheet() -> None:
    plan = HandoutPlan((Topic.EXERCISES,), Setup(), 10, PageFormat.MD, with_key=True)
    found = student_files(plan, Sheet("3", "Bo"))
    assert b"Answer: " not in found.sheet
    assert found.key is not None
    assert found.key.count(b"Answer: ") >= 3
    assert b"nmatrix/1" in found.sheet
    assert handout(plan, Sheet("3", "Bo")).title != key_of(plan, Sheet("3", "Bo")).title


def test_the_pitfalls_are_sixteen_and_their_commands_run(capsys) -> None:
    assert [one.id for one in PITFALLS] == [f"F{i}" for i in range(1, 17)]
    for one in PITFALLS:
        words = shlex.split(one.command)[1:]
        if words[0] != "cost":  # it measures, and may refuse on a busy machine
            assert run(words) == 0, one.command
    capsys.readouterr()


# The command.


def test_a_sheet_and_its_key_are_two_files(nmatrix) -> None:
    line = "handout --topics rule --exercises 3 --student Ada --key -f json"
    code, out, _ = nmatrix(line)
    assert code == 0
    assert json.loads(out)["files"] == ["handout.html", "handout-key.html"]
    assert all(Path(name).exists() for name in json.loads(out)["files"])
    assert nmatrix(line)[0] == 2
    assert nmatrix(f"{line} --force")[0] == 0


def test_sources_have_their_pictures_beside_them(nmatrix) -> None:
    for kind in ("typ", "tex", "md"):
        code, _, err = nmatrix(f"handout --topics proofs --to {kind} -o sheet.{kind}")
        assert (code, err) == (0, "")
        text = Path(f"sheet.{kind}").read_text()
        assert "sheet-normals." in text
    assert Path("sheet-bias.svg").read_bytes().startswith(b"<?xml")
    assert Path("sheet-bias.pdf").read_bytes().startswith(b"%PDF")


def test_the_same_command_writes_the_same_bytes(nmatrix) -> None:
    for name in ("a.html", "b.html"):
        assert nmatrix(f"handout --scale 1 2 1 --exercises 2 --student Ada -o {name}")[0] == 0
    assert Path("a.html").read_bytes() == Path("b.html").read_bytes()


CLASS = 'Student\nAda\n"Lovelace, ""Countess"" A."\n\n<script>\n李\n'


def test_a_class_gets_a_folder(nmatrix) -> None:
    Path("class.csv").write_text(CLASS, encoding="utf-8")
    code, out, _ = nmatrix("handout --roster class.csv --exercises 2 --key -o out -f json")
    assert code == 0
    names = [Path(name).name for name in json.loads(out)["files"]]
    assert names[0::2] == [
        "0001-ada.html",
        "0002-lovelace-countess-a.html",
        "0003-script.html",
        "0004-student.html",
    ]
    assert sorted(path.name for path in Path("out").iterdir()) == sorted([*names, "manifest.json"])
    assert b"<script" not in Path("out/0003-script.html").read_bytes()
    assert "李" in Path("out/0004-student.html").read_text(encoding="utf-8")


def test_a_rerun_writes_what_is_missing_and_nothing_else(nmatrix) -> None:
    Path("class.csv").write_text("student\nAda\nBo\nCy\n")
    line = "handout --roster class.csv --exercises 1 -o out"
    assert nmatrix(line)[0] == 0
    kept, lost = Path("out/0001-ada.html"), Path("out/0002-bo.html")
    content = lost.read_bytes()
    lost.unlink()
    kept.write_bytes(b"touched")
    assert nmatrix(line)[0] == 0
    assert lost.read_bytes() == content
    assert kept.read_bytes() == b"touched"
    code, _, err = nmatrix(f"{line} --seed 9")
    assert code == 2
    assert "seed differ" in err
    assert nmatrix(f"{line} --seed 9 --force")[0] == 0
    assert kept.read_bytes() != b"touched"


def test_a_run_that_is_killed_is_finished_by_the_next(nmatrix, monkeypatch) -> None:
    Path("class.csv").write_text("student\n" + "\n".join(f"s{i}" for i in range(6)))
    line = "handout --roster class.csv --exercises 1 -o out"
    original, made = running.run, []

    def dying(job):
        made.append(job)
        if len(made) == 4:
            raise KeyboardInterrupt
        return original(job)

    monkeypatch.setattr(running, "run", dying)
    assert nmatrix(line)[0] == 130
    assert len(list(Path("out").glob("*.html"))) == 3
    assert not list(Path("out").glob(".*"))
    monkeypatch.setattr(running, "run", original)
    assert nmatrix(line)[0] == 0
    assert len(list(Path("out").glob("*.html"))) == 6


@pytest.mark.slow
def test_two_processes_write_what_one_writes(nmatrix) -> None:
    Path("class.csv").write_text("student\nAda\nBo\nCy\n")
    for folder, more in (("one", ""), ("two", "--workers 2")):
        line = f"handout --roster class.csv --exercises 3 --key {more} -o {folder}"
        assert nmatrix(line)[0] == 0
    for path in Path("one").iterdir():
        assert path.read_bytes() == (Path("two") / path.name).read_bytes()


@pytest.mark.slow
def test_a_cluster_loses_a_worker_and_no_sheet(nmatrix, monkeypatch) -> None:
    """A real scheduler and two workers on loopback, of which one is killed midway."""
    distributed = pytest.importorskip("distributed", reason="distributed is not installed")
    import subprocess
    import sys

    Path("class.csv").write_text("student\n" + "\n".join(f"student {i}" for i in range(40)))
    start = [sys.executable, "-m", "distributed.cli.dask_worker"]
    options = ["--nthreads", "1", "--no-nanny", "--no-dashboard"]
    with distributed.LocalCluster(n_workers=0, processes=True, dashboard_address=None) as cluster:
        address = cluster.scheduler_address
        workers = [subprocess.Popen([*start, address, *options]) for _ in range(2)]
        try:
            with distributed.Client(address) as client:
                client.wait_for_workers(2, timeout=60)
            arrived: list[str] = []
            original = running.finished

            def watched(jobs, executor):
                for i, found in enumerate(original(jobs, executor)):
                    if i == 5:
                        workers[0].kill()
                    arrived.append(found[0].student.name)
                    yield found

            monkeypatch.setattr(running, "finished", watched)
            line = f"handout --roster class.csv --exercises 10 --dask {address} -o out"
            assert nmatrix(line)[0] == 0
        finally:
            for worker in workers:
                worker.kill()
    assert sorted(arrived) == sorted(f"student {i}" for i in range(40)), "each arrives once"
    assert len(list(Path("out").glob("*.html"))) == 40


ROSTERS = [
    (b"", "it is empty"),
    (b"grade\nAda\n", "column student"),
    (b"student\nAda\nAda\n", "line 2 has the same name"),
    (b"student,mail\nAda,a\n,b\n", "1 to 200 characters"),
    (b"student\nAda,Bo\n", "cells under 1 column:"),
    ("student\n山田太郎\n".encode("shift_jis"), "UTF-8"),
    (b"student\n", "names no student"),
    (b"student\n" + b"x" * 300 + b"\n", "1 to 200 characters"),
]


@pytest.mark.parametrize(("content", "words"), ROSTERS)
def test_a_roster_that_cannot_be_used_is_refused(nmatrix, content: bytes, words: str) -> None:
    Path("class.csv").write_bytes(content)
    code, out, err = nmatrix("handout --roster class.csv -o out")
    assert (code, out) == (2, "")
    assert words in err
    assert err.count("\n") == 1
    assert not Path("out").exists()


def test_a_roster_may_be_long() -> None:
    text = "student\n" + "\n".join(f"student {i}" for i in range(10_000))
    found = students(records_of(text, ("student",), "x"), "x")
    assert len({one.stem for one in found}) == 10_000


def test_slugs_are_plain_and_never_paths() -> None:
    for name in ("../../etc/passwd", "a/b\\c", "NUL", "….", "Ünïcödé", "\x00"):
        assert re.fullmatch(r"[a-z0-9-]+", slug(name))


def test_the_ending_of_a_sheet_chooses_its_format(nmatrix) -> None:
    for kind, begins in ((PageFormat.TEX, "\\documentclass"), (PageFormat.MD, "# "), ("HTM", "<!")):
        assert nmatrix(f"handout --topics rule -o sheet.{kind}")[0] == 0
        assert Path(f"sheet.{kind}").read_text().startswith(begins)


MISUSE = [
    ("handout --topics nothing", 2, "choose from them"),
    ("handout --exercises 0", 2, "1 to 100"),
    ("handout --exercises many", 2, "1 to 100"),
    ("handout --topics rule --key", 2, "no exercises"),
    ("handout --topics rule --points 4", 2, "no exercises"),
    ("handout --exercises 1 --points 0", 2, "1 to 100"),
    ("handout --exercises 1 --points many", 2, "1 to 100"),
    ("handout --roster none.csv", 2, "no such file"),
    ("handout --to docx", 2, "docx"),
    ("handout -o nowhere/x.html", 2, "no folder"),
    ("handout -o x.docx", 2, ".html, .pdf, .typ, .tex, .md, .htm"),
    ("handout -o x", 2, ".html, .pdf, .typ, .tex, .md, .htm"),
    ("handout -o x.pdf --to html", 2, "two formats"),
    ("handout --topics rule --exercises 1 --salt none", 2, "no such file"),
]


@pytest.mark.parametrize(("line", "code", "words"), MISUSE)
def test_misuse_is_one_line(nmatrix, line: str, code: int, words: str) -> None:
    found, out, err = nmatrix(line)
    assert (found, out) == (code, "")
    assert words in err
    assert err.count("\n") == 1


def test_a_missing_typst_says_how_to_install_it(nmatrix, monkeypatch) -> None:
    import sys

    monkeypatch.setitem(sys.modules, "typst", None)
    code, _, err = nmatrix("handout --to pdf")
    assert code == 4
    assert "pip install 'typst>=" in err
    assert not list(Path().iterdir())


def test_a_flattened_scene_has_a_sheet_too(nmatrix) -> None:
    assert nmatrix("handout --scale 1 0 1 --topics worked,spaces,cost")[0] == 0


def test_students_of_one_class_have_different_sheets() -> None:
    plan = HandoutPlan((Topic.EXERCISES,), Setup(), 10)
    found = {student_files(plan, Sheet("1", f"s{i}")).sheet for i in range(12)}
    assert len(found) == 12


# The first page, and what stays together.

SCENES = [
    Setup(),
    Setup(World(scale=(1, 2, 1))),
    Setup(World(scale=(1, 0, 1), rotate_degrees=(20, 30, 40))),
    Setup(World(scale=(0, 0, 1))),
    Setup(World(shear=(3, 0, 0), translate=(1e9, 1e-9, 0))),
]


def kinds_before_the_first_formula(blocks: tuple) -> list[type]:
    kinds = [type(block) for block in blocks]
    formulas = [
        i
        for i, block in enumerate(blocks)
        if isinstance(block, Formula | Quantity | Step)
        or (isinstance(block, Framed) and any(isinstance(one, Formula) for one in block.blocks))
    ]
    return kinds[: formulas[0]]


@pytest.mark.parametrize("setup", SCENES)
def test_the_drawing_comes_before_the_first_formula(setup: Setup) -> None:
    sheet = handout(HandoutPlan(tuple(Topic), setup, 1), Sheet())
    assert sheet.title == CLAIM
    assert Figure in kinds_before_the_first_formula(sheet.blocks)


def letters_of(blocks: tuple) -> set[str]:
    """The single letters of formulas, of words and of tables' cells."""
    found: set[str] = set()
    for block in blocks:
        match block:
            case Framed(inner):
                found |= letters_of(inner)
            case Table(_, rows):
                found |= letters_of(tuple(cell for row in rows for cell in row))
            case Formula(parts):
                found |= set(re.findall(r"[A-Za-z]+", " ".join(map(str, parts))))
            case str() | Text() | Verdict():
                words = block if isinstance(block, str) else block.text
                found |= set(re.findall(r"[A-Za-z]+", words))
    return found


def test_eight_letters_are_introduced_and_each_of_them_is_used() -> None:
    setup = Setup(World(scale=(1, 2, 1)))
    blocks = handout(HandoutPlan((Topic.RULE, Topic.SPACES), setup), Sheet()).blocks
    (symbols,) = (block for block in blocks if isinstance(block, Symbols))
    assert len(symbols.meanings) == 8
    assert all(len(words) > 8 for _, words in symbols.meanings)
    assert {letter for letter, _ in symbols.meanings} <= letters_of(blocks)


@pytest.mark.parametrize("setup", SCENES)
def test_every_letter_of_a_formula_on_the_first_page_was_introduced(setup: Setup) -> None:
    blocks = handout(HandoutPlan((Topic.RULE, Topic.SPACES), setup), Sheet()).blocks
    formulas = tuple(one for one in blocks if isinstance(one, Framed | Table))
    letters = {one for one in letters_of(formulas) if len(one) == 1 and one != "a"}
    known = {letter for letter, _ in SYMBOLS} | {"v"}  # v stands in the head of its column
    told = " ".join(block.text for block in blocks if isinstance(block, Text))
    assert letters - known <= ({"C"} if "C are its cofactors" in told else set())


@pytest.mark.parametrize("setup", SCENES)
@pytest.mark.parametrize("kind", FORMATS)
def test_letters_in_drawings_are_read_on_paper_and_stand_apart(
    setup: Setup, kind: PageFormat
) -> None:
    canvas = drawn_idea(setup, kind.theme)
    per_unit = PAGE_POINTS / canvas.width
    texts = [mark for mark in canvas.marks if isinstance(mark, canvas_text.Text)]
    assert texts
    for one in texts:
        assert one.size * per_unit >= 8
        assert one.box.x >= 0 and one.box.y >= 0
        assert one.box.right <= canvas.width and one.box.bottom <= canvas.height
    for a, b in combinations([one.box for one in texts], 2):
        assert a.right <= b.x or b.right <= a.x or a.bottom <= b.y or b.bottom <= a.y


def test_an_exercise_is_one_block_with_its_room_and_its_answer() -> None:
    blocks = handout(HandoutPlan((Topic.EXERCISES,), Setup(), 10, points=4), Sheet()).blocks
    tasks = [block for block in blocks if isinstance(block, Task)]
    assert len(tasks) == 10
    assert all(isinstance(one.blocks[-1], Blank) and one.points == 4 for one in tasks)
    assert sum(one.blocks[-1].has_room for one in tasks) >= 7
    assert not [block for block in blocks if isinstance(block, Blank)]


def test_every_format_keeps_an_exercise_on_its_page() -> None:
    marks = {
        PageFormat.HTML: ('<section class="task">', ".task,"),
        PageFormat.TYP: ("#task[", "#let task(title, most, body) = block(breakable: false"),
        PageFormat.TEX: ("\\begin{task}", "{\\par\\addvspace{14pt}\\begin{minipage}"),
    }
    for kind, (begins, whole) in marks.items():
        plan = HandoutPlan((Topic.EXERCISES,), Setup(), 10, kind)
        text = student_files(plan, Sheet()).sheet.decode()
        assert text.count(begins) == 10
        assert whole in text


def test_what_the_sheet_asks_is_what_the_key_and_the_check_answer() -> None:
    for number in range(1, 11):
        asked = exercise(number, Sheet("7", "Ada"))
        plan = HandoutPlan((Topic.EXERCISES,), Setup(), number)
        sheet, key = (make(plan, Sheet("7", "Ada")) for make in (handout, key_of))
        task = [block for block in sheet.blocks if isinstance(block, Task)][-1]
        assert task.title == asked.title
        assert task.blocks[:-1] == asked.asked
        assert key.blocks[-len(asked.key) :] == asked.key
        assert asked.judge(asked.right).verdict == Outcome.CORRECT


@pytest.mark.parametrize("setup", SCENES)
def test_worked_numbers_are_those_of_the_scene(setup: Setup) -> None:
    A = linear_part(setup.maps.world_from_object.exact)
    blocks = worked(setup)
    told = " ".join(block.text for block in blocks if isinstance(block, Text))
    assert ("flattens" in told) == (not determinant(A))
    products = [
        str(block.parts[0])
        for block in blocks
        if isinstance(block, Formula) and "n) · (A t) = " in str(block.parts[0])
    ]
    if any(any(row) for row in cofactor_matrix(A)):
        right = [line for line in products if not line.startswith("(A n)")]
        assert right[-1].endswith(" = 0")
    else:
        assert not products
        assert "no normal" in told


def test_the_pitfalls_are_told_in_words_and_without_codes() -> None:
    for one in PITFALLS:
        words = f"{one.claim} {one.verdict}"
        assert not re.search(r"\bF[0-9]+\b|κ|σ|metric|clamp|det(?! A)", words)
    sheet = student_files(HandoutPlan((Topic.PITFALLS,), Setup()), Sheet()).sheet.decode()
    assert not re.search(r">F[0-9]+<", sheet)


def test_a_teacher_names_the_sheet_or_its_lines_are_left_to_fill_in(nmatrix) -> None:
    assert nmatrix("handout --topics rule -o a.md")[0] == 0
    assert "Course ____" in Path("a.md").read_text().replace("\\", "")
    line = ["handout", "--topics", "rule", "--title", "Graphics, sheet 4", "-o", "b.md"]
    assert run(line) == 0
    text = Path("b.md").read_text()
    assert "Graphics, sheet 4" in text
    assert "Course" not in text


@pytest.mark.parametrize("scale", [(1, 1, 1), (0, 2, 1), (0.5, 1, 1), (1, 3, 1)])
def test_the_first_drawing_says_how_wide_its_own_ellipse_is(scale) -> None:
    setup = Setup(World(scale=scale))
    (figure,) = (one for one in rule(setup, PageFormat.HTML).blocks if isinstance(one, Figure))
    times = "3 times" if scale == (1, 3, 1) else "twice"
    assert f"Drawn for an A that makes the circle {times} as wide as high" in figure.caption
