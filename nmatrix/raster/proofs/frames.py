"""Frames: one picture after another while the camera walks around."""

from __future__ import annotations

import io
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from importlib import import_module
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

from nmatrix.raster.proofs.brief import Brief, Proof
from nmatrix.raster.proofs.catalogue import entry
from nmatrix.raster.proofs.plain import picture
from nmatrix.scene.scene import Scene

Array = NDArray[Any]

GIF_MILLISECONDS = 60


@dataclass(frozen=True)
class Job:
    """What to draw: a proof by its name with a brief, or a scene. It can be sent to a process."""

    name: str
    brief: Brief | None = None
    scene: Scene | None = None

    def turned(self, degrees: float) -> Job:
        """Return the job with the camera some way around."""
        if self.brief is not None:
            settings = replace(self.brief.settings, turn_degrees=degrees)
            return replace(self, brief=replace(self.brief, settings=settings))
        assert self.scene is not None  # a job has a brief or a scene
        settings = replace(self.scene.settings, turn_degrees=degrees)
        return replace(self, scene=replace(self.scene, settings=settings))

    def draw(self) -> Proof:
        """Draw it."""
        if self.scene is not None:
            return picture(self.scene, self.name)
        found = entry(self.name)
        assert found is not None and self.brief is not None  # a proof has a brief
        proof: Callable[[Brief], Proof] = getattr(
            import_module(f"nmatrix.raster.proofs.{found.module}"), found.function
        )
        return proof(self.brief)


def turns(frames: int) -> list[float]:
    """Return the angles of a full walk around, in degrees.

    Examples
    --------
    >>> turns(4)
    [0.0, 90.0, 180.0, 270.0]
    """
    return [360.0 * i / frames for i in range(frames)]


def drawn(jobs: Sequence[Job], executor: Executor | None) -> Iterator[Proof]:
    """Draw jobs in their order, here or wherever an executor runs them."""
    if executor is None:
        yield from map(Job.draw, jobs)
        return
    waiting = [executor.submit(Job.draw, one) for one in jobs]
    for one in waiting:
        yield one.result()


def gif(images: Sequence[Array]) -> bytes:
    """Return images of one size as an endless GIF."""
    first, *rest = (Image.fromarray(np.ascontiguousarray(one)) for one in images)
    out = io.BytesIO()
    first.save(out, "GIF", save_all=True, append_images=rest, duration=GIF_MILLISECONDS, loop=0)
    return out.getvalue()
