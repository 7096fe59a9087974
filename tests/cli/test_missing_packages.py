"""Without a package, each command that needs it says so in one line, and all others run."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from nmatrix import requirements
from nmatrix.errors import MissingPackageError
from nmatrix.requirements import missing, missing_part
from nmatrix.web.desk import NEEDS

ROOT = Path(__file__).resolve().parents[2]
ABSENT = ("numpy", "sympy", "msgspec", "matplotlib", "PIL", "tree_sitter", "typst", "contourpy")
NEEDED = {  # a line, and a package that it cannot do without
    "derive": "sympy",
    "calc x*2": "sympy",
    "plan sample": "msgspec",
    "render normals": "numpy",
    "stress --case N1": "numpy",
    "cost": "numpy",
    "inspect teapot": "msgspec",
    "world --scene sample": "msgspec",
    "explore": "numpy",
    "handout --to pdf": "PIL",
    "lint phong.vert": "tree-sitter",
}
UNNEEDED = (
    "world --scale 1 2 1",
    "view",
    "projection -f json",
    "normal '1 0 0; 0 2 0; 0 0 1'",
    "calc 'inverse([1 2; 3 4])' --steps",
    "identify '1 0 0; 0 2 0; 0 0 1'",
    "axes unity blender",
    "light object --scale 1 2 1",
    "eye object --scale 1 2 1",
    "space object -f glsl",
    "trace --point 1 1 1",
    "check normal '1 0 0; 0 0.5 0; 0 0 1' --scale 1 2 1",
    "check exercise 3 d --seed 7 --student Ada",
    "help calc",
)


STRIPPED = """
import contextlib, io, json, shlex, sys

class Nowhere:
    def find_spec(name, path=None, target=None):
        if name.partition(".")[0] in ABSENT:
            raise ModuleNotFoundError(f"No module named {name!r}", name=name)

ABSENT, lines = json.load(sys.stdin)
sys.meta_path.insert(0, Nowhere)
from nmatrix.cli.app import run

told = {}
for line in lines:
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = run(shlex.split(line))
    told[line] = code, out.getvalue(), err.getvalue()
json.dump(told, sys.stdout)
"""
SESSION = "a = 2\na*x\na*3\n"


@pytest.fixture(scope="module")
def told(tmp_path_factory) -> dict[str, tuple[int, str, str]]:
    """Every line in a program that finds none of the packages."""
    folder = tmp_path_factory.mktemp("stripped")
    (folder / "a.calc").write_text(SESSION)
    done = subprocess.run(
        [sys.executable, "-c", STRIPPED],
        input=json.dumps([ABSENT, [*NEEDED, *UNNEEDED, "calc a.calc"]]),
        capture_output=True,
        text=True,
        check=True,
        cwd=folder,
        env={**os.environ, "PYTHONPATH": str(ROOT)},
    )
    return json.loads(done.stdout)


@pytest.mark.parametrize("line", NEEDED)
def test_a_command_says_which_package_it_needs_and_how_to_get_it(told, line: str) -> None:
    code, out, err = told[line]
    assert (code, out) == (MissingPackageError.exit_code, "")
    assert err.startswith("error: ")
    assert err.count("\n") == 1
    assert "; pip install " in err
    assert not any(word in err for word in ("defect", "Error", "Traceback", "nmatrix["))


@pytest.mark.parametrize("line", UNNEEDED)
def test_a_command_without_need_runs_all_the_same(told, line: str) -> None:
    code, out, err = told[line]
    assert (code, err) == (0, "")
    assert out


def test_the_packages_that_commands_always_need_are_known() -> None:
    needed = {line.split()[0] for line in NEEDED} - {"calc", "world", "handout"}
    assert needed == set(NEEDS)
    assert not {line.split()[0] for line in UNNEEDED} & set(NEEDS)


def test_a_session_goes_on_without_letters(told) -> None:
    code, out, err = told["calc a.calc"]
    assert code == MissingPackageError.exit_code
    assert out.endswith("> a*3\nans  6\n")
    assert "letters: it needs the package sympy" in err


def test_a_module_of_our_own_that_is_not_there_is_a_defect() -> None:
    for error in (
        ModuleNotFoundError("No module named 'nmatrix.nowhere'", name="nmatrix.nowhere"),
        ModuleNotFoundError("No module named 'nowhere'", name="nowhere"),
        ModuleNotFoundError("no name"),
        KeyError("numpy"),
    ):
        assert missing_part(error, "render") is None
    found = missing_part(ModuleNotFoundError("", name="numpy.linalg"), "render")
    assert str(found).startswith("render: it needs the package numpy, which is not installed; pip ")


def test_in_a_browser_nothing_is_installed(monkeypatch) -> None:
    monkeypatch.setattr(requirements.sys, "platform", "emscripten")
    told = str(missing("lint", "tree_sitter", "tree_sitter_glsl"))
    assert told == (
        "lint: it needs tree-sitter, tree-sitter-glsl, which this page does not bring; "
        "run it in a terminal, where nmatrix is installed"
    )
    assert str(missing("--to pdf", "typst", otherwise="print the page")).endswith(
        "where nmatrix is installed, or print the page"
    )
