"""Options of pictures: how large, how finely, how many, and where they go."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from typer import Option

from nmatrix.cli.shared_options import whole_number
from nmatrix.cli.workers import WorkerOptions
from nmatrix.enums import Effort, NormalRule, Reflection, Shading
from nmatrix.errors import IllegalValueError
from nmatrix.reading.numbers import numbers

PICTURE, FRAMES = "Picture", "Frames"
SAMPLES = ("1", "4", "16", "64")
LARGEST = 8192  # pixels on a side
MOST_SAMPLES = 1 << 28
MOST_FRAMES = 10_000


@dataclass(frozen=True)
class PictureOptions:
    """What a picture looks like; what is not given is the scene file's or the proof's."""

    size: Annotated[
        str | None,
        Option(
            metavar="W H", help="Pixels of a picture, or of each panel.", rich_help_panel=PICTURE
        ),
    ] = None
    shading: Annotated[
        Shading | None, Option(help="Where light is evaluated.", rich_help_panel=PICTURE)
    ] = None
    reflection: Annotated[
        Reflection | None, Option(help="How the surface reflects.", rich_help_panel=PICTURE)
    ] = None
    normals: Annotated[
        NormalRule | None,
        Option(help="The rule that carries normals.", rich_help_panel=PICTURE),
    ] = None
    samples: Annotated[
        str | None,
        Option(metavar="N", help="Samples of each pixel: 1, 4, 16 or 64.", rich_help_panel=PICTURE),
    ] = None
    effects: Annotated[
        Effort, Option(help="What the scene calls for, or everything.", rich_help_panel=PICTURE)
    ] = Effort.PLANNED

    def checked_size(self, default: tuple[int, int]) -> tuple[int, int]:
        """Read width and height in pixels, within what memory holds."""
        if self.size is None:
            return default
        width, height = numbers(self.size, 2, "--size")
        if not (width.is_integer() and height.is_integer() and min(width, height) >= 1):
            raise IllegalValueError(
                f"--size ({self.size[:40]})",
                "both sides are whole numbers of pixels, 1 at least",
                "try 360 360",
            )
        if max(width, height) > LARGEST:
            raise IllegalValueError(
                f"--size ({self.size[:40]})",
                f"a side has {LARGEST} pixels at the most",
                "try 1024 1024",
            )
        return int(width), int(height)

    def checked_samples(self, default: int, size: tuple[int, int]) -> int:
        """Read the samples of a pixel, within what memory holds."""
        if self.samples is not None and self.samples not in SAMPLES:
            raise IllegalValueError(
                f"--samples ({self.samples[:20]})",
                "a pixel has 1, 4, 16 or 64",
                "try --samples 4",
            )
        samples = default if self.samples is None else int(self.samples)
        if size[0] * size[1] * samples > MOST_SAMPLES:
            raise IllegalValueError(
                f"--size {size[0]} {size[1]} with {samples} samples",
                f"a picture has {MOST_SAMPLES} samples at the most",
                "take fewer of either",
            )
        return samples


@dataclass(frozen=True)
class FileOptions:
    """Where a picture goes."""

    output: Annotated[
        str | None, Option("--output", "-o", metavar="FILE", help="PNG or GIF; - is stdout.")
    ] = None
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False
    preview: Annotated[bool, Option("--preview", help="Show it in the terminal too.")] = False


@dataclass(frozen=True)
class FrameOptions(WorkerOptions):
    """How many pictures, and who draws them."""

    frames: Annotated[
        str | None,
        Option(
            metavar="N", help="So many pictures: a GIF, or numbered files.", rich_help_panel=FRAMES
        ),
    ] = None
    turn: Annotated[
        bool, Option("--turn", help="Walk once around what is drawn.", rich_help_panel=FRAMES)
    ] = False

    @property
    def count(self) -> int:
        """The number of pictures."""
        default = "36" if self.turn else "1"
        return whole_number(self.frames or default, "--frames", range(1, MOST_FRAMES + 1), 2)


def frame_names(target: Path, count: int) -> list[Path]:
    """Write numbers into the names of a sequence.

    Examples
    --------
    >>> [str(one) for one in frame_names(Path("a.png"), 2)]
    ['a-0.png', 'a-1.png']
    """
    digits = len(str(count - 1))
    return [target.with_stem(f"{target.stem}-{i:0{digits}}") for i in range(count)]
