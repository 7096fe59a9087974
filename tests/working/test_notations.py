"""Steps in every notation: what is printed compiles, is heard, and holds the same matrices."""

from __future__ import annotations

import json
import random
import re
import shutil
import subprocess
from collections.abc import Iterator
from functools import cache
from xml.etree import ElementTree

import pytest
from drawn_workings import workings

from nmatrix import Setup
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.output.drawing import draw_formula
from nmatrix.output.formulas.latex import latex
from nmatrix.output.formulas.mathml import equation, mathml
from nmatrix.output.formulas.spoken import spoken
from nmatrix.output.formulas.typst import typst
from nmatrix.report import Formula, Step
from nmatrix.scene.lens import Lens
from nmatrix.scene.world import World
from nmatrix.working.projection import projection_matrix
from nmatrix.working.world import world_matrix

WORLDS = (
    World(translate=(1, 2, 3), rotate_degrees=(10, 30, 45), scale=(1, 2, 1), shear=(1, 0, 0)),
    World(quaternion=(1, 2, 3, 4)),
    World(axis_angle=(1, 1, 0, 40)),
    World(scale=(1e-9, 1e30, 1)),
)


def _steps() -> Iterator[Step]:
    for seed in range(3):
        for _, make in workings(random.Random(seed)):
            try:
                yield from make().steps
            except NMatrixError:
                continue
    for world in WORLDS:
        yield from world_matrix(world).steps
    yield from projection_matrix(Lens(50, 16 / 9)).steps


@cache
def formulas() -> tuple[Formula, ...]:
    return tuple(dict.fromkeys(step.formula for step in _steps()))


def test_every_step_prints_in_every_notation() -> None:
    for formula in formulas():
        tree = formula.tree
        matrices = sum(not isinstance(part, str) for part in formula.parts)
        page = ElementTree.fromstring(equation(mathml(tree), spoken(tree)))
        assert sum(node.tag.endswith("mtable") for node in page.iter()) == matrices
        assert typst(tree).count("mat(") == matrices
        assert len(re.findall(r"\[ |⎡ ", draw_formula(formula, 10**6))) == matrices
        assert not set(spoken(tree)) & set("⁻ᵀ²·×√≤≠θ⇒←↔₁₂₃₄|│"), spoken(tree)


def test_latex_of_steps_is_balanced_and_in_the_characters_that_pdflatex_reads() -> None:
    for formula in formulas():
        printed = latex(formula.tree)
        assert printed.isascii(), printed
        assert printed.count("{") == printed.count("}")
        assert printed.count(r"\begin") == printed.count(r"\end")


def test_typst_accepts_every_step() -> None:
    compiler = pytest.importorskip("typst", reason="typst is not installed")
    source = "\n\n".join(f"$ {typst(formula.tree)} $" for formula in formulas())
    assert compiler.compile(source.encode(), format="pdf").startswith(b"%PDF")


@pytest.mark.slow
def test_pdflatex_accepts_every_step(tmp_path) -> None:
    if shutil.which("pdflatex") is None:
        pytest.skip("pdflatex is not installed")
    body = "\n".join(f"\\[ {latex(formula.tree)} \\]" for formula in formulas())
    head = "\\documentclass{article}\n\\usepackage{amsmath,amssymb}\n\\begin{document}\n"
    (tmp_path / "steps.tex").write_text(f"{head}{body}\n\\end{{document}}\n", encoding="utf-8")
    done = subprocess.run(
        ["pdflatex", "-interaction=nonstopmode", "-halt-on-error", "steps.tex"],
        cwd=tmp_path, capture_output=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stdout[-2000:].decode("utf-8", "replace")


@pytest.mark.parametrize(
    "line",
    [
        "world --rotate 0 30 0 --scale 1 2 1",
        "world --world-matrix '1 2 3; 4 5 6; 7 8 10'",
        "view --eye 3 3 2.5",
        "view --view-matrix '1 0 0 0; 0 1 0 0; 0 0 1 -5; 0 0 0 1'",
        "projection --fov 50 --aspect 16/9",
        "projection --projection-matrix '1 0 0 0; 0 1 0 0; 0 0 -3 -4; 0 0 -1 0'",
        "normal --scale 1 2 1 --rotate 15 18 45 --normal 1 1 0 --normal 0 1 0 --space camera",
        "normal --scale 1 0 1 --normal 0 1 0",
        "normal --scale 1 2 1 --normal 1 1 0 --space object",
        "normal --scale -1 2 1 --normal 1 1 0 --method none",
        "normal --scale -1 2 1 --normal 1 1 0 --method cofactor",
    ],
)
def test_four_commands_show_their_steps_as_text_and_as_data(nmatrix, line: str) -> None:
    assert nmatrix(f"{line} -f json").data["steps"] is None
    assert "step by step" not in nmatrix(line).out
    found = nmatrix(f"{line} --steps -f json").data["steps"]
    assert all(step.keys() == {"text", "latex", "because", "verified"} for step in found)
    assert all(step["verified"] for step in found), json.dumps(found)
    shown = nmatrix(f"{line} --steps").out
    assert "step by step" in shown
    assert max(map(len, shown.splitlines())) <= 80
    for step in found[-1:]:
        assert step["text"].splitlines()[0].strip() in shown


def test_steps_say_that_decimals_are_rounded_and_say_it_only_then(nmatrix) -> None:
    assert "six digits" in nmatrix("world --rotate 0 20 0 --steps").out
    assert "six digits" not in nmatrix("world --rotate 0 30 0 --steps").out


def test_programs_of_numbers_leave_the_steps_out(nmatrix) -> None:
    for name in ("glsl", "numpy", "js"):
        assert nmatrix(f"world --steps -f {name}").out == nmatrix(f"world -f {name}").out


def test_numbers_of_thousands_of_digits_are_shown_in_six(nmatrix) -> None:
    far = "--eye 1e15 0.5 5e-324 --axis-angle 0 0.5 0.157 180 --normal 2.29 7.659 5"
    found = nmatrix(f"normal --steps --space camera {far} -f json")
    assert all(step["verified"] for step in found.data["steps"])
    assert max(len(step["text"]) for step in found.data["steps"]) < 2000


@pytest.mark.parametrize("name", ["world", "view", "projection", "normal"])
def test_python_asks_for_steps_as_the_command_line_does(name: str) -> None:
    setup = Setup(world={"scale": (1, 2, 1)})
    assert getattr(setup, name)().data["steps"] is None
    assert getattr(setup, name)(steps=True).data["steps"][-1]["verified"]
    with pytest.raises(IllegalValueError, match="steps"):
        getattr(setup, name)(steps="yes")
