"""How fast pictures are drawn, as ratios to others that draw the same, in one interleaved run.

Run it by hand: `python tests/benchmarks/raster.py [--quick]`. Absolute times mean nothing on a
shared machine; medians of rounds in which everyone takes a turn do.
"""

from __future__ import annotations

import argparse
import compileall
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path
from statistics import median

import numpy as np
import peers
from frames import BACKGROUND, CHECKOUT, Frame, core, frames, scene

import nmatrix
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.render import render
from nmatrix.scene.meshes.shapes import torus

Draw = Callable[[], object]
Seconds = Mapping[str, float]
ROUNDS, SLOW_ROUNDS = 15, 2
HEADINGS = "frame triangles size ÷C++ goal ÷llvmpipe goal loop÷ goal scene÷core px>2 cover".split()
ROW = "{:14} {:>9} {:>5} {:>6} {:>5} {:>10} {:>5} {:>7} {:>5} {:>11} {:>5} {:>6}"


def medians(contestants: Mapping[str, Draw], rounds: int, slow: int = SLOW_ROUNDS) -> Seconds:
    """Return the median seconds of each; the ones called `loop` take part in few rounds only."""
    times: dict[str, list[float]] = {name: [] for name in contestants}
    for draw in contestants.values():
        draw()
    for i in range(rounds):
        for name, draw in contestants.items():
            if name != "loop" or i < slow:
                start = time.perf_counter()
                draw()
                times[name].append(time.perf_counter() - start)
    return {name: median(found) for name, found in times.items() if found}


def contestants(frame: Frame, absent: set[str]) -> dict[str, Draw]:
    """Return everyone who is here; the others say why they are not."""
    found: dict[str, Draw] = {"core": core(frame), "scene": scene(frame)}
    for name, peer in (("cpp", peers.cpp), ("gl", peers.opengl), ("loop", peers.python)):
        try:
            found[name] = peer(frame)
        except peers.AbsentError as error:
            absent.add(str(error))
    return found


def goals(frame: Frame) -> tuple[float, float, float]:
    """Return the goals: at most so much of C++ and llvmpipe, at least so much of the loop."""
    is_large = len(frame.mesh.triangles) > 50_000
    return (
        5.0 if frame.is_screen else 3.0,
        1.0 if is_large and frame.size == 512 else 2.0,
        200.0 if is_large else 15.0,
    )


def table(rounds: int, sizes: tuple[int, ...]) -> None:
    """Print the ratios of every frame beside their goals, and how far the pictures agree."""
    absent: set[str] = set()
    print(ROW.format(*HEADINGS))
    for frame in frames(sizes):
        everyone = contestants(frame, absent)
        pictures = {name: np.array(everyone[name]()) for name in everyone if name != "loop"}
        seconds = medians(everyone, rounds)
        cells = [f"{frame.name}", str(len(frame.mesh.triangles)), str(frame.size)]
        at_most_cpp, at_most_gl, at_least = goals(frame)
        for name, goal in (("cpp", f"≤{at_most_cpp:g}"), ("gl", f"≤{at_most_gl:g}")):
            cells += [over(seconds, "core", name), goal]
        cells += [over(seconds, "loop", "core"), f"≥{at_least:g}", over(seconds, "scene", "core")]
        print(ROW.format(*cells, *agreement(frame, pictures)), flush=True)
    for why in sorted(absent):
        print(why)


def over(seconds: Seconds, one: str, other: str) -> str:
    known = one in seconds and other in seconds
    return f"{seconds[one] / seconds[other]:.2f}" if known else "-"


def agreement(frame: Frame, pictures: Mapping[str, np.ndarray]) -> tuple[str, str]:
    """Return pixels more than 2/255 off llvmpipe's, and those that are covered wrongly."""
    ours = pictures["core"].astype(int)
    far = str((np.abs(pictures["gl"] - ours) > 2).sum()) if "gl" in pictures else "-"
    if "cpp" not in pictures:
        return far, "-"
    covered = peers.exact_counts(frame) > 0
    return far, str(((ours != round(BACKGROUND * 255)) != covered).sum())


def growth(rounds: int) -> None:
    """Print what twice the triangles, four times the samples and hidden triangles cost."""
    base = Frame("torus", torus(64, 64), 512)
    hidden = replace(base, others=(torus(64, 64, 1.0, 0.2),))
    finer, larger = replace(base, mesh=torus(128, 64)), replace(base, per_side=2)
    seconds = medians(
        {"base": core(base), "finer": core(finer), "larger": core(larger), "hidden": core(hidden)},
        rounds,
    )
    shaded = [sum(one.picture().shaded) for one in (base, hidden)]
    print(f"\ntriangles x 2: time x {over(seconds, 'finer', 'base')}, goal ≤ 2")
    print(f"samples x 4: time x {over(seconds, 'larger', 'base')}, goal ≤ 4")
    print(
        f"hidden triangles as many again: time x {over(seconds, 'hidden', 'base')}, goal ≤ 2;",
        end=" ",
    )
    print(f"samples shaded x {shaded[1] / shaded[0]:.3f}, goal 1")


def plans(rounds: int) -> None:
    """Print what the plan saves on the scenes of the documentation."""
    from nmatrix.scene.open import scene_of

    for file in sorted((CHECKOUT / "docs" / "scenes").glob("*.toml")):
        place = loaded(scene_of(file))
        some, everyone = planned(place), everything(place)
        seconds = medians(
            {"plan": lambda p=some: render(p, levels), "all": lambda p=everyone: render(p, levels)},
            rounds,
        )
        saved = render(some).work.multiplications / render(everyone).work.multiplications
        print(f"{file.stem}: planned takes {over(seconds, 'plan', 'all')} of the time", end=" ")
        print(f"and {saved:.2f} of the multiplications of everything on")


SCENE = """
[camera]
eye = [0, 2, 3]
target = [0, 0, 0]
[[light]]
kind = "directional"
direction = [-1, -2, -1]
[[object]]
shape = "torus"
tessellation = [32, 32]
[render]
size = [512, 512]
samples = 1
"""


def cold(rounds: int) -> None:
    """Print a whole process that draws a torus, against its imports and two warm frames."""
    warm = medians({"frame": scene(Frame("torus", torus(32, 32), 512))}, rounds)["frame"]
    # An installed package has its bytecode; a checkout may not.
    compileall.compile_dir(Path(nmatrix.__file__).parent, quiet=1)
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "torus.toml").write_text(SCENE)
        render_it = "-m nmatrix render torus.toml --force -o torus.png".split()
        environment = {**os.environ, "PYTHONPATH": str(CHECKOUT)}

        def run(*words: str) -> None:
            subprocess.run(
                [sys.executable, *words],
                cwd=folder,
                env=environment,
                check=True,
                capture_output=True,
            )

        try:
            seconds = medians(
                {
                    "render": lambda: run(*render_it),
                    "imports": lambda: run("-c", "import numpy, typer"),
                },
                rounds,
            )
        except subprocess.CalledProcessError as error:
            print("no cold render:", error.stderr.decode().strip().splitlines()[-1:])
            return
    goal = 1.5 * seconds["imports"] + 2 * warm
    print(f"cold `nmatrix render` of a torus: {seconds['render'] / goal:.2f} of its goal,", end=" ")
    print("1.5 x (import numpy, typer) + 2 warm frames")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few rounds, 512 pixels only")
    is_quick = parser.parse_args().quick
    rounds, sizes = (5, (512,)) if is_quick else (ROUNDS, (512, 1024))
    table(rounds, sizes)
    growth(rounds)
    plans(rounds)
    cold(rounds)


if __name__ == "__main__":
    main()
