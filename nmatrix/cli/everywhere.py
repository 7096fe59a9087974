"""The options that every command has: format, digits, layouts, colour."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated

from typer import Option

from nmatrix.enums import Format, Layout
from nmatrix.errors import IllegalValueError

PANEL = "Output"
MOST_DIGITS = 17


class ColorWhen(StrEnum):
    """When text carries terminal colours."""

    AUTO = "auto"
    ALWAYS = "always"
    NEVER = "never"


@dataclass(frozen=True)
class Everywhere:
    """How to write the answer, and in which order matrices are read and written."""

    format: Annotated[
        Format, Option("--format", "-f", help="How to write the answer.", rich_help_panel=PANEL)
    ] = Format.TEXT
    digits: Annotated[
        str,
        Option(metavar="N", help="Significant digits for people, 1 to 17.", rich_help_panel=PANEL),
    ] = "6"
    layout: Annotated[Layout, Option(help="Order of written matrices.", rich_help_panel=PANEL)] = (
        Layout.ROW_MAJOR
    )
    input_layout: Annotated[
        Layout, Option(help="Order of matrices that are read.", rich_help_panel=PANEL)
    ] = Layout.ROW_MAJOR
    color: Annotated[ColorWhen, Option(help="Colours in text.", rich_help_panel=PANEL)] = (
        ColorWhen.AUTO
    )

    @property
    def digits_checked(self) -> int:
        """Return the number of digits, or say which are possible."""
        if self.digits.isascii() and self.digits.isdigit() and len(self.digits) < 4:
            found = int(self.digits)
            if 1 <= found <= MOST_DIGITS:
                return found
        raise IllegalValueError(
            f"--digits ({self.digits[:20]})",
            "a float64 has 1 to 17 significant digits",
            "try --digits 6",
        )
