"""Options of pictures: how large, how finely, how many, and where they go."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.environment import usual
from nmatrix.cli.shared_options import among, whole_number
from nmatrix.cli.workers import WorkerOptions
from nmatrix.enums import (
    Effort,
    NormalRule,
    PixelFormat,
    Reflection,
    Shading,
    Shown,
    Theme,
    chosen_words,
)
from nmatrix.reading.numbers import number, numbers

if TYPE_CHECKING:
    from nmatrix.answers.render import PictureChoices
    from nmatrix.enums import Space, VectorFormat

in_picture = partial(Option, rich_help_panel="Picture")
in_frames = partial(Option, rich_help_panel="Frames")
MOST_FRAMES = 10_000


@dataclass(frozen=True)
class PictureOptions:
    """What a picture looks like; what is not given is the scene file's or the proof's."""

    size: Annotated[str | None, in_picture(metavar="W H", help="Pixels of the whole picture.")] = (
        None
    )
    shading: Annotated[Shading | None, in_picture(help="Where light is evaluated.")] = None
    reflection: Annotated[Reflection | None, in_picture(help="How the surface reflects.")] = None
    normals: Annotated[NormalRule | None, in_picture(help="The rule that carries normals.")] = None
    samples: Annotated[
        str | None,
        in_picture(
            metavar="N",
            help="Samples of each pixel: 1, 4, 16 or 64.",
            autocompletion=among(["1", "4", "16", "64"]),
        ),
    ] = None
    theme: Annotated[
        Theme | None,
        in_picture(help="Colours of proofs and marks: a page (light), a dark slide, grey paper."),
    ] = None
    effects: Annotated[Effort, in_picture(help="What the scene calls for, or everything.")] = (
        Effort.PLANNED
    )

    show: Annotated[
        str | None,
        in_picture(
            metavar="WORDS",
            help=f"Marks over a scene or mesh, with commas: {', '.join(Shown)}.",
            autocompletion=among(Shown),
        ),
    ] = None

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
            theme=self.theme or usual("NMATRIX_THEME", Theme) or Theme.LIGHT,
            shown=frozenset(() if self.show is None else chosen_words(Shown, self.show, "show")),
        )


@dataclass(frozen=True)
class FileOptions:
    """Where a picture goes."""

    output: Annotated[
        str | None,
        Option(
            "--output",
            "-o",
            metavar="FILE",
            help="FILE.png .gif .webp .jpg, proofs .svg .pdf; - is stdout.",
        ),
    ] = None
    force: Annotated[bool, Option("--force", help="Overwrite an existing file.")] = False
    preview: Annotated[bool, Option("--preview", help="Show it in the terminal too.")] = False


@dataclass(frozen=True)
class FrameOptions(WorkerOptions):
    """How many pictures, and who draws them."""

    frames: Annotated[
        str | None,
        in_frames(metavar="N", help="So many pictures: a GIF or WebP, or numbered files."),
    ] = None
    turn: Annotated[
        bool, in_frames("--turn", help="Turn what the picture is about once around.")
    ] = False

    @property
    def count(self) -> int:
        """The number of pictures."""
        default = "36" if self.turn else "1"
        return whole_number(self.frames or default, "--frames", range(1, MOST_FRAMES + 1), 2)


def frame_names(path: Path, count: int, kind: PixelFormat | VectorFormat) -> list[Path]:
    """Name the files of so many frames: one file, or numbered ones where a file holds one picture.

    Examples
    --------
    >>> [str(one) for one in frame_names(Path("a.png"), 2, PixelFormat.PNG)]
    ['a-0.png', 'a-1.png']
    >>> [str(one) for one in frame_names(Path("a.gif"), 2, PixelFormat.GIF)]
    ['a.gif']
    """
    if count == 1 or (isinstance(kind, PixelFormat) and kind.is_animated):
        return [path]
    digits = len(str(count - 1))
    return [path.with_stem(f"{path.stem}-{i:0{digits}}") for i in range(count)]
