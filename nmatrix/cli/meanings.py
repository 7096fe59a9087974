"""What people type from other tools, and where nmatrix has it: the hints for unknown words.

A word of three.js, GLM, OpenCV, Unity, Blender or NumPy means something that is here by another
name. A hint is an option (`--fov`) or a command with options (`trace --pixel`). The first option
that the command at hand has is told, else the first command that exists. Only then spelling is
looked at.
"""

from __future__ import annotations

import json
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from typing import Any

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.completion import TABLE
from nmatrix.errors import did_you_mean, shortlist

USUAL_COMMAND = "world"  # it answers without any argument
WORDS = Path(__file__).with_name("meanings.txt")


@cache
def _table() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(TABLE.read_text(encoding="utf-8"))
    return found


def _plain(word: str) -> str:
    return word.lstrip("-").replace("-", "").replace("_", "").casefold()


@cache
def meanings() -> dict[str, tuple[str, ...]]:
    """Every foreign word, spelled without marks, with its hints, best first."""
    found: dict[str, tuple[str, ...]] = {}
    for line in WORDS.read_text(encoding="utf-8").splitlines():
        words, _, hints = line.partition(": ")
        if not line.startswith("#"):
            found |= dict.fromkeys(map(_plain, words.split()), tuple(hints.split(" | ")))
    return found


def names_of(command: str) -> list[str]:
    """List the options of a command, in every spelling."""
    return [name for one in _table()[command]["options"] for name in one["names"]]


def _usable(hint: str, command: str) -> str | None:
    """Spell a hint as it is typed here; None for one that names what does not exist."""
    words = hint.split()
    if hint.startswith("-"):
        return hint if command and words[0] in names_of(command) else None
    if words[0] not in COMMANDS and words[0] != "help":
        return None
    options = [word for word in words if word.startswith("--") or word in ("-f", "-o")]
    known = names_of(words[0])
    return f"nmatrix {hint}" if all(one in known for one in options) else None


def meant_by(word: str, command: str = "") -> str | None:
    """Find what a word of another tool is called here, for a command or before any."""
    if command and len(_plain(word)) == 1 and not word.startswith("--"):
        return None  # a letter is a slip, or an expression
    hints = sorted(meanings().get(_plain(word), ()), key=lambda one: not one.startswith("-"))
    return next((found for one in hints if (found := _usable(one, command))), None)


def command_for(word: str) -> str:
    """Say which command was meant by a word that is none."""
    if word.startswith("-") or (found := meant_by(word)) is None:
        return did_you_mean(word, (*COMMANDS, "help"), f"the commands are {', '.join(COMMANDS)}")
    return f"did you mean {found}?"


def option_for(word: str, command: str, known: Iterable[str]) -> str:
    """Say which option was meant by one that a command does not know."""
    found = meant_by(word, command)
    if found is not None:
        return f"did you mean {found}?"
    takers = [other for other in COMMANDS if word in names_of(other)]
    if takers:
        return f"it is an option of nmatrix {shortlist(takers, 3)}"
    return did_you_mean(word, known, "see --help")


def program_option_for(word: str) -> str:
    """Say what was meant by an option that stands before a command."""
    takers = [name for name in COMMANDS if word in names_of(name)]
    if not takers:
        found = meant_by(word)
        return f"did you mean {found}?" if found else did_you_mean(word, names_of(""), "see --help")
    one = next(one for one in _table()[takers[0]]["options"] if word in one["names"])
    if takers[0] != USUAL_COMMAND or not (one["words"] or one["takes"] == 0):
        return f"put it behind a command that takes it, such as nmatrix {takers[0]}"
    value = "json" if "json" in one["words"] else next(iter(one["words"]), "")
    return f"try nmatrix {takers[0]} {word} {value}".rstrip()
