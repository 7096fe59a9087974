"""Options of pictures: how large, how finely, how many, and where they go."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.shared_options import whole_number
from nmatrix.cli.workers import WorkerOptions
from nmatrix.enums import Effort, NormalRule, Reflection, Shading
from nmatrix.reading.numbers import number, numbers

if TYPE_CHECKING:
    from nmatrix.answers.render import PictureChoices
    from nmatrix.enums import Space

PICTURE, FRAMES = "Picture", "Frames"
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

    def choices(self, space: Space | None = None) -> PictureChoices:
        """Read what was chosen of a picture, its shading space beside it."""
        from nmatrix.answers.render import PictureChoices

        return PictureChoices(
            size=None if self.size is None else numbers(self.size, 2, "--size"),
            shading=self.shading,
            reflection=self.reflection,
            normals=self.normals,
            space=space,
            samples=None if self.samples is None else number(self.samples, "--samples"),
            effort=self.effects,
        )


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


def frame_names(target: str, count: int) -> list[Path]:
    """Name the files of so many frames: one file, or numbered ones where a file holds one picture.

    Examples
    --------
    >>> [str(one) for one in frame_names("a.png", 2)], frame_names("a.gif", 2)[0].name
    (['a-0.png', 'a-1.png'], 'a.gif')
    """
    path = Path(target)
    if count == 1 or target == "-" or path.suffix.lower() == ".gif":
        return [path]
    digits = len(str(count - 1))
    return [path.with_stem(f"{path.stem}-{i:0{digits}}") for i in range(count)]
