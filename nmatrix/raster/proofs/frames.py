"""Picture frames: one picture after another while what a picture is about goes once around."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from dataclasses import dataclass, replace

from nmatrix.enums import Shown, Theme
from nmatrix.raster.drawn_scene import drawn_scene
from nmatrix.raster.proofs.catalogue import catalogued
from nmatrix.raster.proofs.plain import picture
from nmatrix.raster.proofs.proof import Proof, ProofSettings
from nmatrix.scene.scene import Scene


@dataclass(frozen=True)
class PictureFrame:
    """A picture to draw: a proof by its name and settings, or a scene. A process can take it.

    `shown` are marks over a scene, in the colours of `theme`.
    """

    name: str
    settings: ProofSettings | None = None
    scene: Scene | None = None
    shown: frozenset[Shown] = frozenset()
    theme: Theme = Theme.LIGHT

    @property
    def is_slide(self) -> bool:
        """True for a proof: its lines and letters can be written as such."""
        return self.scene is None

    def turned(self, degrees: float) -> PictureFrame:
        """Return the picture frame some way around: what the proof is about, or a scene's eye."""
        entry = catalogued(self.name)
        if self.settings is not None and entry is not None:
            return replace(self, settings=self.settings.turned(entry.turns, degrees))
        assert self.scene is not None  # what has no settings of a proof has a scene
        settings = replace(self.scene.settings, turn_degrees=degrees)
        return replace(self, scene=replace(self.scene, settings=settings))

    def before_one_background(self) -> PictureFrame:
        """Choose the background of a scene that leaves it open, for this and all frames to come."""
        if self.scene is None or self.scene.settings.other_background is None:
            return self
        chosen = drawn_scene(self.scene).loaded.settings.background
        settings = replace(self.scene.settings, background=chosen, other_background=None)
        return replace(self, scene=replace(self.scene, settings=settings))

    def draw(self) -> Proof:
        """Draw the proof, or the scene."""
        if self.scene is not None:
            return picture(self.scene, self.name, self.shown, self.theme)
        found = catalogued(self.name)
        assert found is not None and self.settings is not None  # a proof has settings
        return found.load()(self.settings)


def around(frame: PictureFrame, count: int) -> list[PictureFrame]:
    """Return the frames of a full turn, all before one background."""
    if count == 1:
        return [frame]
    still = frame.before_one_background()
    return [still.turned(angle) for angle in turns(count)]


def turns(frames: int) -> list[float]:
    """Return the angles of a full turn, in degrees.

    Examples
    --------
    >>> turns(4)
    [0.0, 90.0, 180.0, 270.0]
    """
    return [360.0 * i / frames for i in range(frames)]


def drawn(frames: Sequence[PictureFrame], executor: Executor | None) -> Iterator[Proof]:
    """Draw picture frames in their order, here or wherever an executor runs them."""
    if executor is None:
        yield from map(PictureFrame.draw, frames)
        return
    waiting = [executor.submit(PictureFrame.draw, one) for one in frames]
    for one in waiting:
        yield one.result()
