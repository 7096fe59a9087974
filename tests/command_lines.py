"""Command lines from everywhere: the documentation, the helps, every format, slips, and input."""

from __future__ import annotations

import re
import shlex
from importlib import import_module
from itertools import product
from pathlib import Path

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import examples_and_notes
from nmatrix.enums import Format, Space
from nmatrix.lessons.check.mistakes import MISTAKES

ROOT = Path(__file__).resolve().parents[1]
PAGES = [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]
IN_A_SHELL = re.compile(r"[|<>;&$*~\\]|<\(")  # what only a shell does
MEASURES = ("cost", "stress", "render", "web", "explore")  # times, files of other places, long work
SUBJECTS = (
    "world --translate 1 2 3 --rotate 10 20 30 --scale 1 2 1/3 --shear 0.1 0 0",
    "world --axis-angle 1 1 0 33 --scale -1 1 1 --full",
    "view --eye 3 4 5 --target 0 1 0",
    "projection --fov 50 --aspect 16:9 --api vulkan",
    "normal --scale 1 2 1 --rotate 0 40 0 --normal 1 1 0",
    "light camera --eye 3 3 3 --light-angles -60 -120",
    "eye object --rotate 0 30 0 --translate 1e7 0 0 --eye 10000003 1 2",
    "space object --scale 1 2 1",
    "trace --point 1 1 1 --normal 0 0 1 --rotate 10 0 0",
    "axes blender unity",
    "identify '1.2990 0 0 0; 0 1.7320 0 0; 0 0 -1.0020 -0.2002; 0 0 -1 0'",
    "check normal '1 0 0; 0 2 0; 0 0 1' --scale 1 2 1",
    "calc 'inverse_transpose(linear(M))' --scale 1 2 1 --rotate 0 0 30",
    "check exercise 2 '1 0 0; 0 2 0; 0 0 4' --seed 7 --student Ada",
)
SLIPS = (
    "wrold",
    "world --sacle 1 2 1",
    "world --scale 1 2",
    "world --scale 0 0 0",
    "world --scale 1,5 2 1",
    "world --scale 1 2 1 -f pdf",
    "world --digits 99",
    "view --eye 0 0 0 --target 0 0 0",
    "view --up 0 0 0",
    "projection --near -1",
    "projection --fov 180",
    "projection --near 5 --far 1",
    "normal",
    "normal '1 0; 0 1'",
    "normal '1 0 0; 0 0 0; 0 0 0'",
    "calc",
    "calc '1 +'",
    "calc 'det(A)'",
    "calc 'inverse([1 2; 2 4])'",
    "calc '1/0'",
    "calc '9^9^9^9'",
    "calc 'V @ inverse(M) @ point([1 2 3])'",
    "calc missing.txt",
    "identify 'a b c'",
    "identify '1 2 3'",
    "axes unity",
    "axes nowhere unity",
    "light nowhere",
    "space custom",
    "space tangent",
    "trace --pixel 1",
    "trace --depth-value 0.5",
    "check",
    "check normal",
    "check nothing '1 0 0'",
    "check exercise 3 z --seed 7",
    "check exercise 999 a",
    "check normal --batch missing.csv",
    "check projection '1 0 0; 0 1 0; 0 0 1'",
    "inspect missing.gltf",
    "help wrold",
    "help --full world",
    "--version",
    "--nothing",
    "--",
    "",
)
TYPED = {  # what is typed in: lines, then the files of the folder, - for stdin
    "calc -": {"-": "A = [1 2; 3 4]\ninverse(A)\n2 +\nshow A as latex\nvars\nundo\n"},
    "calc - --steps": {"-": "det([2 1; 1 3])\nsteps off\nsqrt(8)"},
    "calc session.calc": {"session.calc": "a = 1/3\nb = a^2 + √2\nb"},
    "calc empty.calc": {"empty.calc": ""},
    "identify -": {"-": "[[1, 0, 0, 3], [0, 1, 0, 4], [0, 0, 1, 5], [0, 0, 0, 1]]"},
    "identify matrix.json": {"matrix.json": '{"world": [[1,0,0],[0,2,0],[0,0,1]]}'},
    "normal -": {"-": "1 0 0\n0 2 0\n0 0 4\n"},
    "normal - -f json": {"-": ""},
    "check normal --batch a.csv --scale 1 2 1": {
        "a.csv": "student,answer\nAda,1 0 0; 0 0.5 0; 0 0 1\nBob,1 0 0; 0 2 0; 0 0 1\nCy,x\n"
    },
    "check normal --batch a.csv --scale 1 2 1 -f csv": {
        "a.csv": "Name;Antwort\nAda;1 0 0 0 0,5 0 0 0 1\n"
    },
    "check exercise --batch b.csv --seed 7 --points 4": {
        "b.csv": "student,exercise,answer\nAda,3,a\nAda,2,1 0 0; 0 1 0; 0 0 1\nAda,77,\n"
    },
    "world --world-matrix -": {"-": "0 -1 0; 2 0 0; 0 0 -1"},
}


def command_lines() -> list[dict[str, object]]:
    """Every line once, as words, with the files that it finds."""
    found: dict[tuple[str, ...], dict[str, str]] = {}
    for line in (*_documented(), *_examples(), *_in_every_format(), *_of_lessons(), *SLIPS):
        words = tuple(shlex.split(line))
        if not words or words[0] not in MEASURES:
            found.setdefault(words, {})
    for line, files in TYPED.items():
        found[tuple(shlex.split(line))] = files
    return [{"words": list(words), "files": files} for words, files in found.items()]


def _documented() -> list[str]:
    """The lines of the transcripts, without those that only a shell understands."""
    lines = [
        line.removeprefix("$ nmatrix ")
        for page in PAGES
        for line in page.read_text("utf-8").splitlines()
        if line.startswith("$ nmatrix ")
    ]
    return [line for line in lines if not IN_A_SHELL.search(_unquoted(line)) and _closes(line)]


def _unquoted(line: str) -> str:
    return re.sub(r"\"[^\"]*\"|'[^']*'", "", line)


def _closes(line: str) -> bool:
    try:
        shlex.split(line)
    except ValueError:
        return False
    return True


def _examples() -> list[str]:
    modules = {one.module for one in COMMANDS.values()}
    helps = [import_module(f"nmatrix.cli.{module}").HELP for module in sorted(modules)]
    texts = [text for one in helps for text in one.values()]
    lines = [example for text in texts for example in examples_and_notes(text)[0]]
    asked = [f"{name} {option}" for name in COMMANDS for option in ("--help", "--help --full")]
    return (
        [line.removeprefix("nmatrix ") for line in lines]
        + [f"help {one}" for one in COMMANDS]
        + [one for one in asked if one.split()[0] not in MEASURES]
    )


def _in_every_format() -> list[str]:
    return [f"{line} -f {one}" for line, one in product(SUBJECTS, Format)]


def _of_lessons() -> list[str]:
    shown = {one.command.removeprefix("nmatrix ") for one in MISTAKES.values()}
    return [*sorted(shown), *(f"space {one} --scale 1 2 1" for one in Space)]
