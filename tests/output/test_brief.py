"""Short answers: whole on a screen of 24 lines, whatever is asked; `--full` has the rest."""

from __future__ import annotations

import random
from collections.abc import Callable

import pytest

from nmatrix.enums import Space
from nmatrix.report import SCREEN

EVERYDAY = (
    "world", "normal", "view", "projection", "identify", "axes", "light", "eye", "trace",
)  # fmt: skip


def lines_of(text: str) -> list[str]:
    return text.rstrip("\n").split("\n")


def some_options(command: str, seed: int) -> str:
    """Choose options of a command that make its answer long: mirrors, shears, given matrices."""
    rng = random.Random(seed)

    def number() -> str:
        return f"{rng.choice([0, 1, -1, 2, rng.uniform(-9, 9), 1e-7, 12345.678]):.9g}"

    def three() -> str:
        return " ".join(number() for _ in range(3))

    world = f"--scale {three()} --rotate {three()} --translate {three()} --shear {three()}"
    eye = f"--eye {rng.uniform(1, 9):.6g} {three().split()[0]} 7.25 --roll {number()}"
    plain = "--world-matrix '0.3 1 2 3; 4 5.5 6 7; 8 9.25 1 2; 0 0 0 1'"
    view = "--view-matrix '0 0 1 2.5; 0 1 0 3; -1 0 0 4; 0 0 0 1'"
    lens = "--projection-matrix '1.7321 0 0 0; 0 1.7321 0 0; 0 0 -1.0101 -1.0101; 0 0 -1 0'"
    space = rng.choice(["camera", "object", "static", "light", ""])
    options = {
        "world": [world, plain, f"{world} --convention polimi", f"{world} --order zyx"],
        "normal": [f"{world} --normal {three()}", "--scale 1 0 1 --normal 0 1 0", f"{plain}"],
        "view": [eye.split(" --roll")[0], view, f"{eye} --elevation 20 --convention polimi"],
        "projection": [
            "--far inf --depth reversed",
            lens,
            "--at 1 10 --depth-value 0.5",
            "--fov 1",
        ],
        "light": [f"{space} {world} --light-position {three()} --light-direction 1 {number()} 3"],
        "eye": [f"{space} {world} {eye.split(' --roll')[0]}"],
        "trace": [
            f"{world} --point {three()} --normal 1 {number()} 0",
            "--pixel 10 20 --api vulkan",
        ],
        "identify": [
            "'0.1 0 0 0; 0 0.2 0 0; 0 0 -0.02 -1; 0 0 0 1'",
            "'1.299 0 0 0; 0 -1.732 0 0; 0 0 0 0.1; 0 0 -1 0'",
            f"'{number()} 0 0.123 0; 0 {number()} 0.456 0; 0 0 -1.002 -0.2002; 0 0 -1 0'",
            f"'{three()} {number()}; {three()} 1; {three()} 2; 0 0 0 1'",
            f"'{three()}; {three()}; {three()}'",
            "'0 0 1 2.5; 0 1 0 3; -1 0 0 4; 0 0 0 1'",
        ],
        "axes": [
            "blender unity",
            "unity gltf",
            f"unreal ros '{three()} {number()}; {three()} 1; {three()} 2; 0 0 0 1'",
            f"opencv unreal '{three()}; {three()}; {three()}' --order zyx",
            "unreal opengl '1 0 0 0; 0 0 0 0; 0 0 1 0; 0 0 0 1'",
        ],
    }
    return rng.choice(options[command])


@pytest.mark.parametrize("command", EVERYDAY)
def test_an_everyday_answer_is_whole_on_a_small_screen(nmatrix: Callable, command: str) -> None:
    told = 0
    for seed in range(25):
        line = f"{command} {some_options(command, seed)}"
        found = nmatrix(line)
        if found.code == 2:
            continue
        told += 1
        shown = lines_of(found.out)
        assert len(shown) <= SCREEN, line
        assert max(map(len, shown)) <= 80, line
    assert told > 5


@pytest.mark.parametrize("command", EVERYDAY)
def test_full_has_every_line_that_the_short_answer_counts(nmatrix: Callable, command: str) -> None:
    for seed in range(6):
        line = f"{command} {some_options(command, seed)}"
        short, full = nmatrix(line), nmatrix(f"{line} --full")
        if short.code == 2:
            continue
        assert "--full" not in full.out
        if "--full adds" in short.out:
            assert len(lines_of(full.out)) > len(lines_of(short.out)), line
        for remark in [one for one in lines_of(short.out) if one.startswith("•")]:
            assert remark in full.out


def test_remarks_that_find_no_room_are_counted(nmatrix: Callable) -> None:
    line = "world --rotate 10 20 30 --scale 1 2 -1 --shear 1 0 0"
    short, full = nmatrix(line), nmatrix(f"{line} --full")
    shown = sum(one.startswith("•") for one in lines_of(short.out))
    every = sum(one.startswith("•") for one in lines_of(full.out))
    left = every - shown
    assert left > 0
    assert (f"and {left} remarks" if left > 1 else "and a remark") in " ".join(short.out.split())


def first_entry(matrix: str) -> int:
    """Find the line of a text with the first row of a matrix."""
    return next(at for at, line in enumerate(lines_of(matrix)) if line.strip().startswith("x ⎡"))


def test_what_was_asked_for_stands_on_top(nmatrix: Callable) -> None:
    moved = nmatrix("axes ros unreal '0 -1 0 4; 1 0 0 5; 0 0 1 6; 0 0 0 1'").out
    assert first_entry(moved) <= 3
    assert "rotate XYZ (deg)" in moved
    assert first_entry(nmatrix("axes blender unity").out) <= 3
    lens = nmatrix("identify '1.299 0 0 0; 0 -1.732 0 0; 0 0 0 0.1; 0 0 -1 0'").out
    assert lens.startswith("It is a perspective projection")
    assert lens.index("nmatrix projection --fov 60 --aspect 4/3") < lens.index("at least")


def test_what_is_nearly_one_is_called_so(nmatrix: Callable) -> None:
    told = nmatrix("identify '0.7071067 0 0.7071067 1; 0 1 0 2; -0.7071067 0 0.7071067 3; 0 0 0 1'")
    assert "scaled by nearly 1 1 1" in told.out
    assert "scaled by 1 2 1." in nmatrix("identify '1 0 0; 0 2 0; 0 0 1'").out


def test_each_further_normal_takes_one_line(nmatrix: Callable) -> None:
    one = nmatrix("normal --scale 1 2 1 --normal 1 1 0")
    three = nmatrix("normal --scale 1 2 1 --normal 1 1 0 --normal 0 1 0 --normal 1 2 3")
    assert len(lines_of(three.out)) == len(lines_of(one.out)) + 2


@pytest.mark.parametrize("space", Space)
def test_the_sheet_of_a_space_has_sixty_lines_at_most(nmatrix: Callable, space: Space) -> None:
    matrix = "--space-matrix '0 1 0; 1 0 0; 0 0 2'" if space is Space.CUSTOM else ""
    line = f"space {space} --scale 1 2 -1 --shear 1 0 0 --light-position 1 2 3 {matrix}"
    assert len(lines_of(nmatrix(line).out)) <= 60
    assert "#version" not in nmatrix(line).out
    assert "#version" in nmatrix(f"{line} --full").out


@pytest.mark.parametrize("format_", ["json", "markdown", "latex", "csv"])
def test_other_formats_are_always_full(nmatrix: Callable, format_: str) -> None:
    line = f"world --scale 1 2 1 -f {format_}"
    assert nmatrix(line).out == nmatrix(f"{line} --full").out
