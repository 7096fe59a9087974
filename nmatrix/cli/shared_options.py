"""What the option groups share: options that two groups have, and typed text to numbers."""

from __future__ import annotations

from collections.abc import Callable
from typing import Annotated

from typer import Option

from nmatrix.enums import Convention, Handedness
from nmatrix.linear.projection import Window
from nmatrix.reading.numbers import number, numbers
from nmatrix.report import Vector

WORLD, VIEW, LENS, LIGHT = "World", "View", "Lens", "Light"
CONVENTIONS = "Conventions"  # options of two groups, of which a command may take only one

ReadNumbers = Callable[[str, int, str], Vector]

ConventionOption = Annotated[
    Convention | None,
    Option(
        "--convention",
        help="How angles make a matrix (default: standard).",
        rich_help_panel=CONVENTIONS,
    ),
]
HandedOption = Annotated[
    Handedness | None,
    Option(
        "--handed",
        help="The camera looks down −z (right, the default) or +z (left).",
        rich_help_panel=CONVENTIONS,
    ),
]


def given(named: dict[str, str | None]) -> dict[str, str]:
    """Return the options that were given."""
    return {name: value for name, value in named.items() if value is not None}


def vector(read: ReadNumbers, text: str | None, name: str, default: Vector) -> Vector:
    """Return three numbers, or the default."""
    return default if text is None else read(text, 3, name)


def scalar(text: str | None, name: str, default: float) -> float:
    """Return one number, or the default."""
    return default if text is None else number(text, name)


def window(text: str | None, name: str) -> Window | None:
    """Return four sides, if they were given."""
    return None if text is None else Window(*numbers(text, 4, name))
