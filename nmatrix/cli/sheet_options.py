"""Whose sheet of exercises it is: the options that `check` and `handout` share."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING, Annotated

from typer import Option

from nmatrix.cli.shared_options import OptionGroup, option_name
from nmatrix.errors import IllegalValueError
from nmatrix.reading.files import existing_file, file_bytes, is_folder

if TYPE_CHECKING:
    from nmatrix.lessons.exercises.scheme import Sheet

in_exercises = partial(Option, rich_help_panel="Exercises")
USUAL_SEED = "1"


@dataclass(frozen=True)
class SheetOptions(OptionGroup):
    """A seed for the class, a student, and the teacher's salt."""

    seed: Annotated[
        str | None, in_exercises(metavar="SEED", help="Of the class's numbers (1).")
    ] = None
    student: Annotated[str | None, in_exercises(metavar="NAME", help="Whose sheet it is.")] = None
    salt: Annotated[
        str | None,
        in_exercises(metavar="FILE", help="A secret of the teacher's, for graded tests."),
    ] = None

    def of_a_class(self, option: str) -> tuple[str, bytes]:
        """Take the seed and the salt of a class, whose students stand in the file of an option."""
        if self.student is not None:
            raise IllegalValueError(
                f"--student with {option}", "the students stand in the file", "leave it out"
            )
        return self._seed, self._salt

    @property
    def _seed(self) -> str:
        return USUAL_SEED if self.seed is None else self.seed

    @property
    def _salt(self) -> bytes:
        if self.salt is None:
            return b""
        path = existing_file(self.salt)
        if path is None:
            raise IllegalValueError(
                f"--salt ({self.salt[:60]})",
                "it is a folder" if is_folder(self.salt) else "there is no such file",
                "check the path",
            )
        salt = file_bytes(path)
        if not salt:
            raise IllegalValueError(
                f"--salt ({self.salt[:60]})",
                "the file is empty, so it keeps nothing secret",
                "put some words that nobody guesses into it",
            )
        return salt

    @property
    def identity(self) -> Sheet:
        """The sheet that these options name."""
        from nmatrix.lessons.exercises.scheme import Sheet

        return Sheet(self._seed, self.student or "", self._salt)

    def refuse(self, what: str) -> None:
        """Refuse these options where there are no exercises."""
        for name in self.given:
            option = option_name(name)
            raise IllegalValueError(
                f"{option} with check {what}", "it names a sheet", "use check exercise"
            )
