"""How fast pictures are drawn, as ratios to others that draw the same, in one interleaved run.

Run it by hand: `python tests/benchmarks/raster.py [--quick]`. Absolute times mean nothing on a
shared machine; the fastest of rounds in which everyone takes a turn do.
"""

from __future__ import annotations

import argparse
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
from frames import BACKGROUND, CHECKOUT, MATT, Frame, core, frames, panes, scene, screen, with_uv

import nmatrix
from nmatrix.enums import Reflection
from nmatrix.raster.image import levels, png
from nmatrix.raster.loaded_scene import loaded
from nmatrix.raster.planning.plan import everything, planned
from nmatrix.raster.render import render
from nmatrix.scene.material import EmbeddedImage, Material, Texture, grey
from nmatrix.scene.meshes.shapes import torus
from nmatrix.scene.scene import Scene

# The C++ loop is built for speed, and whoever loads it flushes subnormal numbers to zero: constants
# of modules that are compiled from here on would be zero on disk.
sys.dont_write_bytecode = True

Draw = Callable[[], object]
Seconds = Mapping[str, float]
ROUNDS, SLOW_ROUNDS = 15, 2
HEADINGS = "frame triangles size ÷C++ goal ÷llvmpipe goal loop÷ goal scene÷core px>2 cover".split()
ROW = "{:14} {:>9} {:>5} {:>6} {:>5} {:>10} {:>5} {:>7} {:>5} {:>11} {:>5} {:>6}"


def fastest(contestants: Mapping[str, Draw], rounds: int, slow: int = SLOW_ROUNDS) -> Seconds:
    """Return the least seconds of each; the ones called `loop` take part in few rounds only."""
    times: dict[str, list[float]] = {name: [] for name in contestants}
    for draw in contestants.values():
        draw()
    for i in range(rounds):
        for name, draw in contestants.items():
            if name != "loop" or i < slow:
                start = time.perf_counter()
                draw()
                times[name].append(time.perf_counter() - start)
    return {name: min(found) for name, found in times.items() if found}


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
        5.0 if frame.is_screen else 4.0,
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
        seconds = fastest(everyone, rounds)
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
    return f"{ratio(seconds, one, other):.2f}" if known else "-"


def ratio(seconds: Seconds, one: str, other: str) -> float:
    return seconds[one] / seconds[other]


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
    seconds = fastest(
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


def said(what: str, found: float, goal: str) -> None:
    """Print one row: what was measured, the ratio, and the goal beside it."""
    print(f"{what:66} {found:6.2f}   goal {goal}", flush=True)


def drawn(scene: Scene) -> Draw:
    """Return the drawing of a scene whose plan is made."""
    plan = planned(loaded(scene))
    return lambda: render(plan, levels)


def samples(rounds: int) -> None:
    """Print what four samples cost against one, where edges are few and where they are not."""
    shiny = Material("shiny", reflection=Reflection.BLINN_PHONG, specular=grey(0.3), shininess=32)
    for name, mesh, is_screen in (("screen", screen(), True), ("torus", torus(32, 32), False)):
        for material in (MATT, shiny):
            four, one = (
                drawn(Frame(name, mesh, 512, k, is_screen, material=material).scene) for k in (2, 1)
            )
            seconds = fastest({"four": four, "one": one}, rounds)
            said(f"4 samples ÷ 1: {name}, {material.name}", ratio(seconds, "four", "one"), "≤ 1.8")


def textures(rounds: int) -> None:
    """Print what a large texture costs with gamma against the same without."""
    noise = np.random.default_rng(0).integers(0, 256, (2048, 2048, 3), np.uint8)
    painted = Material("painted", texture=Texture(EmbeddedImage("noise", png(noise, {}))))
    frame = Frame("screen", with_uv(screen()), 512, is_screen=True, material=painted)
    plain = frame.scene
    gamma = replace(plain, settings=replace(plain.settings, gamma=True))
    seconds = fastest({"with": drawn(gamma), "without": drawn(plain)}, rounds)
    said("a 2048² texture with gamma ÷ without", ratio(seconds, "with", "without"), "≤ 1.3")


def glass(rounds: int) -> None:
    """Print what twice as many panes of glass cost."""
    pane = Material("glass", opacity=0.01)
    many, few = (
        drawn(Frame("panes", panes(count), 128, is_screen=True, material=pane).scene)
        for count in (1000, 500)
    )
    seconds = fastest({"many": many, "few": few}, rounds)
    said("1000 panes of glass ÷ 500, 128²", ratio(seconds, "many", "few"), "≤ 2.2, linear")


def plans(rounds: int) -> None:
    """Print what plan and picture take of everything on, on the scenes of the documentation."""
    from nmatrix.scene.open import scene_of

    shares = []
    for file in sorted((CHECKOUT / "docs" / "scenes").glob("*.toml")):
        place = loaded(scene_of(file))
        everyone, some = everything(place), planned(place)
        seconds = fastest(
            {
                "plan": lambda p=place: planned(p),
                "both": lambda p=place: render(planned(p), levels),
                "all": lambda p=everyone: render(p, levels),
            },
            rounds,
        )
        saved = render(some).work.multiplications / render(everyone).work.multiplications
        shares.append(ratio(seconds, "both", "all"))
        planning = ratio(seconds, "plan", "all")
        said(f"{file.stem}: plan and picture ÷ everything on", shares[-1], "< 1, or ≤ 1.1 if full")
        print(f"    the plan alone {planning:.2f}, multiplications {saved:.2f}")
    said("median of plan and picture ÷ everything on", median(shares), "≤ 0.75")


MEMORY = {
    "10⁷ triangles through a scene": ("SCENE", {"cells": 2237, "size": 512, "per_side": 1}),
    "64 samples at 2048²": ("DRAWING", {"cells": 20, "size": 2048, "per_side": 8}),
}


def memory() -> None:
    """Print the most that whole processes have had in memory."""
    sys.path.insert(0, str(CHECKOUT / "tests" / "raster"))
    import test_memory

    for name, (way, numbers) in MEMORY.items():
        _, mebibytes = test_memory.resident(getattr(test_memory, way), **numbers)
        said(f"{name}, GiB", mebibytes / 1024, "≤ 1")


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
    warm = fastest({"frame": scene(Frame("torus", torus(32, 32), 512))}, rounds)["frame"]
    # An installed package has its bytecode; a checkout may not.
    package = str(Path(nmatrix.__file__).parent)
    subprocess.run([sys.executable, "-m", "compileall", "-q", package], check=False)
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
            seconds = fastest(
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
    said("cold `nmatrix render` ÷ (1.5 imports + 2 frames)", seconds["render"] / goal, "≤ 1")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--quick", action="store_true", help="few rounds, 512 pixels only")
    is_quick = parser.parse_args().quick
    rounds, sizes = (5, (512,)) if is_quick else (ROUNDS, (512, 1024))
    table(rounds, sizes)
    growth(rounds)
    few = max(3, rounds // 3)
    samples(rounds)
    textures(few)
    glass(1)
    plans(few)
    cold(rounds)
    memory()


if __name__ == "__main__":
    main()
