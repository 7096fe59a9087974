"""What a command answers to a Python caller: values, every format, a notebook's view."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from nmatrix import report
from nmatrix.enums import Format, Layout, Numbers, PixelFormat, chosen
from nmatrix.errors import IllegalValueError, NMatrixError
from nmatrix.linear.values import flag, named_file

if TYPE_CHECKING:
    from nmatrix.raster.proofs.proof import Proof

BESIDE = ("command", "version", "layout", "remarks")  # in the JSON, beside the answer's own keys


@dataclass(frozen=True, repr=False, eq=False)
class Report(report.Displayed):
    """One answer: its numbers in `data`, its sentences in `remarks`, and `to` for every format.

    A notebook shows it with its formulas; `print` shows what a terminal would.

    Examples
    --------
    >>> import nmatrix
    >>> answer = nmatrix.Setup(world={"scale": (1, 2, 1)}).world()
    >>> answer.data["transform"], answer.data["determinant"]
    ('non-uniform-scale', 2.0)
    >>> print(answer.to("numpy").splitlines()[3])
    world_from_object = np.array([
    """

    answer: report.Report

    @property
    def command(self) -> str:
        """The name of the command that answers so."""
        return self.answer.command

    @cached_property
    def data(self) -> dict[str, Any]:
        """The keys of the command's JSON: numbers, rows, texts, None where there is none."""
        return {key: one for key, one in self._json.items() if key not in BESIDE}

    @property
    def remarks(self) -> tuple[str, ...]:
        """The teaching part, sentence by sentence."""
        return tuple(self._json["remarks"])

    @property
    def failure(self) -> NMatrixError | None:
        """The error that the answer still ends in: an undefined normal, a wrong answer."""
        return self.answer.failure

    @cached_property
    def _json(self) -> Mapping[str, Any]:
        found: Mapping[str, Any] = json.loads(self.to("json"))
        return found

    def to(
        self,
        format: str | Format = Format.TEXT,  # the option's name
        *,
        digits: int = 6,
        layout: str | Layout = Layout.ROW_MAJOR,
        numbers: str | Numbers | None = None,
    ) -> str:
        """Return the answer as text, json, csv, latex, markdown, mathml, typst, glsl, js or numpy.

        An answer that looked for faults in files is also written as sarif or github.

        Parameters
        ----------
        format, layout
            As the command line has them.
        digits
            Significant digits for people; machine formats print what reads back as the same float.
        numbers
            For people "exact" (1/3, √3/2 where a number is one), "decimal" or "both"; None is
            the command's own.

        Raises
        ------
        IllegalValueError
            For another word, digits outside 1 to 17, or a format that cannot say this answer.
        """
        how = chosen(Format, format, "format"), digits, chosen(Layout, layout, "layout")
        told = None if numbers is None else chosen(Numbers, numbers, "numbers")
        return _written(self.answer, *how, told)

    def __str__(self) -> str:
        return self.to("text")

    def __repr__(self) -> str:
        """Name the command and the keys of its data."""
        return f"<Report of nmatrix {self.command}: {', '.join(self.data)}>"

    def _repr_report_(self) -> report.Report:
        """Hand on the answer itself."""
        return self.answer


def _written(
    answer: report.Report,
    format_: Format,
    digits: int = 6,
    layout: Layout = Layout.ROW_MAJOR,
    numbers: Numbers | None = None,
) -> str:
    from nmatrix.output.write import OutputOptions, write

    return write(answer, OutputOptions(format_, digits, layout, numbers=numbers))


@dataclass(frozen=True, repr=False, eq=False)
class Picture(Report):
    """A picture with its numbers: pixels in `image`, PNG in `png`; a notebook shows it."""

    drawn: Proof

    @property
    def image(self) -> Any:  # noqa: ANN401  # an array, of a module that is not loaded for words
        """The pixels: (height, width, 3) bytes of sRGB, the top row first."""
        return self.drawn.image

    @property
    def texts(self) -> Mapping[str, str]:
        """The numbers that a file of it tells, by their names."""
        return self.drawn.texts

    @cached_property
    def png(self) -> bytes:
        """The picture as a PNG file, with its numbers in text chunks."""
        return self.drawn.file(PixelFormat.PNG)

    def save(self, path: str | Path, *, force: bool = False) -> None:
        """Write a .png, .gif, .webp or .jpg file, whole or not at all, with its numbers inside.

        A proof may also be a .svg or a .pdf: then its text is text, and its lines are lines.

        Raises
        ------
        IllegalValueError
            For another ending, a file that exists unless `force`, or a place that cannot be
            written.
        """
        from nmatrix.output.files import PICTURES, SLIDES, kind_of, write_file

        target = named_file(path, "path")
        kind = kind_of(target, SLIDES if self.drawn.is_slide else PICTURES, "path")
        if target.exists() and not flag(force, "force"):
            next_step = "give force=True, or another path"
            raise IllegalValueError(f"path ({target})", "the file exists", next_step)
        if not target.parent.is_dir():
            raise IllegalValueError(f"path ({target})", "there is no such folder", "make it first")
        write_file(target, self.drawn.file(kind), force=True)

    def _repr_png_(self) -> bytes:
        return self.png

    def _repr_mimebundle_(self, **_: object) -> dict[str, str | bytes]:
        """Show the picture in a notebook, and its numbers where there are only words."""
        return {"text/plain": str(self), "image/png": self.png}
