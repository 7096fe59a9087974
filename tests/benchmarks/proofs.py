"""What the marks and letters of each proof cost beside its pictures, as a table.

`python tests/benchmarks/proofs.py [NAME …]` draws each proof, and its scenes alone by the same
calls, in turn, and prints the medians and their ratio.
"""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator
from statistics import median
from time import perf_counter
from typing import Any
from unittest.mock import patch

from nmatrix.raster import drawn_scene
from nmatrix.raster.image import levels
from nmatrix.raster.loaded_scene import LoadedScene, loaded
from nmatrix.raster.planning.plan import Plan, plan_for
from nmatrix.raster.proofs.catalogue import PROOFS
from nmatrix.raster.proofs.frames import PictureFrame
from nmatrix.raster.proofs.proof import ProofSettings
from nmatrix.raster.render import Rendered, render
from nmatrix.scene.scene import Scene

ROUNDS = 9


def scenes_of(draw: Callable[[], object]) -> list[Callable[[], object]]:
    """Collect what a proof draws as scenes: calls that plan each of them again, and draw it."""
    found: list[Callable[[], object]] = []

    def loaded_once(scene: Scene) -> LoadedScene:
        found.append(lambda: plan_for(loaded(scene)))
        return loaded(scene)

    def rendered(plan: Plan, **settings: Any) -> Rendered:
        found.append(lambda: levels(render(plan, **settings).rgb))
        return render(plan, **settings)

    with patch.multiple(drawn_scene, loaded=loaded_once, render=rendered):
        draw()
    return found


def seconds(call: Callable[[], object]) -> float:
    began = perf_counter()
    call()
    return perf_counter() - began


def rows(names: list[str]) -> Iterator[tuple[str, int, float, float]]:
    """Measure each proof and its scenes: its name, the calls that draw them, seconds of both."""
    for name in names:
        frame = PictureFrame(name, ProofSettings(name))

        def whole(frame: PictureFrame = frame) -> object:
            return frame.draw().image

        scenes = scenes_of(whole)
        pairs = [(seconds(whole), sum(map(seconds, scenes))) for _ in range(ROUNDS)]
        proofs, alone = zip(*pairs, strict=True)
        yield name, len(scenes), median(proofs), median(alone)


def main(names: list[str]) -> None:
    print("| proof | calls | whole, ms | scenes, ms | ratio |\n|---|---|---|---|---|")
    for name, count, whole, alone in rows(names):
        told = f"{1000 * whole:.0f} | {1000 * alone:.0f} | {whole / alone:.1f}"
        print(f"| {name} | {count} | {told} |", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:] or [one.name for one in PROOFS])
