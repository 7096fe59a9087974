"""Gather the words of a command line: an option of N values takes N words, and −3 is a value.

Each option with its values becomes one `--option=values` token; whatever else is a value stands
behind `--`. How many values an option takes is read off its metavar: `X Y Z` takes three.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from difflib import get_close_matches

from nmatrix.errors import IllegalValueError

# A minus with a digit or a point behind it is a number; "-" and "-#KEY" are standard input.
_VALUE = re.compile(r"-(?:[\d.].*|#.*)?\Z", re.DOTALL)
_SEPARATOR = re.compile(r"[\s,]")


@dataclass(frozen=True)
class OptionShape:
    """What gathering must know of an option: its names, its values, whether it repeats."""

    names: tuple[str, ...]
    arity: int
    repeats: bool = False
    choices: tuple[str, ...] = ()

    @property
    def name(self) -> str:
        """Return the name that error messages use."""
        return max(self.names, key=len)


@dataclass
class _Reader:
    words: list[str]
    at: int = 0
    given: set[str] = field(default_factory=set)

    def next_is_value(self) -> bool:
        return self.at < len(self.words) and is_value(self.words[self.at])

    def where(self) -> str:
        return f"before {self.words[self.at]}" if self.at < len(self.words) else "at the end"


def is_value(word: str) -> bool:
    """Return whether a word is a value and not an option.

    Examples
    --------
    >>> [is_value(word) for word in ("-3", "-.5", "-", "-#value", "-f", "--scale", "1 0 0")]
    [True, True, True, True, False, False, True]
    """
    return not word.startswith("-") or _VALUE.match(word) is not None


def gather(words: Sequence[str], shapes: Iterable[OptionShape]) -> list[str]:
    """Return the words with every option and its values joined into one token.

    Raises
    ------
    IllegalValueError
        For an unknown option, too few values, or an option given twice.

    Examples
    --------
    >>> scale = OptionShape(("--scale",), 3)
    >>> gather(["--scale", "1", "-2", "1", "-1"], [scale])
    ['--scale=1 -2 1', '--', '-1']
    """
    by_name = {name: shape for shape in shapes for name in shape.names}
    reader = _Reader(list(words))
    options: list[str] = []
    values: list[str] = []
    while reader.at < len(reader.words):
        word = reader.words[reader.at]
        reader.at += 1
        if word == "--":
            values += reader.words[reader.at :]
            break
        if is_value(word):
            values.append(word)
        else:
            options.append(_option(word, by_name, reader))
    return [*options, "--", *values] if values else options


def _option(word: str, by_name: dict[str, OptionShape], reader: _Reader) -> str:
    name, joined = _split(word)
    shape = by_name.get(name)
    if shape is None:
        raise _unknown(name, by_name)
    if shape.name in reader.given and not shape.repeats:
        raise IllegalValueError(f"{shape.name}", "it is given twice", "keep one of them")
    reader.given.add(shape.name)
    if shape.arity == 0:
        if joined is not None:
            raise IllegalValueError(f"{name} ({joined[:20]})", "it takes no value", f"use {name}")
        return shape.name
    value = _values(shape, joined, reader)
    if shape.choices and value not in shape.choices:
        known = ", ".join(shape.choices)
        raise IllegalValueError(
            f"{shape.name} ({value[:40]})",
            f"it is one of {known}",
            did_you_mean(value, shape.choices, f"try {shape.choices[0]}"),
        )
    return f"{shape.name}={value}"


def _split(word: str) -> tuple[str, str | None]:
    if word.startswith("--"):
        name, equals, value = word.partition("=")
        return name, value if equals else None
    return word[:2], word[2:].removeprefix("=") or None


def _values(shape: OptionShape, joined: str | None, reader: _Reader) -> str:
    if joined is not None:
        return joined
    taken: list[str] = []
    while len(taken) < shape.arity and reader.next_is_value():
        word = reader.words[reader.at]
        if shape.arity > 1 and not taken and _SEPARATOR.search(word.strip()):
            reader.at += 1
            return word
        taken.append(word)
        reader.at += 1
    if len(taken) < shape.arity:
        what = "a value" if shape.arity == 1 else f"{shape.arity} numbers"
        got = "none" if not taken else str(len(taken))
        raise IllegalValueError(f"{shape.name} takes {what}, got {got} {reader.where()}")
    return " ".join(taken)


def _unknown(name: str, known: Iterable[str]) -> IllegalValueError:
    return IllegalValueError(
        f"option ({name[:40]})",
        "this command does not know it",
        did_you_mean(name, known, "see --help"),
    )


def did_you_mean(word: str, known: Iterable[str], otherwise: str) -> str:
    """Return a question that names the nearest known word, or another next step.

    Examples
    --------
    >>> did_you_mean("wrold", ["view", "world"], "see --help")
    'did you mean world?'
    """
    near = get_close_matches(word[:40], known, n=1, cutoff=0.6)
    return f"did you mean {near[0]}?" if near else otherwise
