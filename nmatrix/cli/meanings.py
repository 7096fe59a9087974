"""What people type from other tools, and where nmatrix has it: the hints for unknown words.

A word of three.js, GLM, OpenCV, Unity, Blender or NumPy means something that is here by another
name, with or without what those put around it (gluPerspective, Quaternion.Euler, to_euler). A
hint is an option (`--fov`) or a command with options (`trace --pixel`). The first option that the
command at hand has is told, else the first command that exists. Only then spelling is looked at.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from functools import cache
from itertools import takewhile
from pkgutil import get_data

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import AXES
from nmatrix.cli.completion import table
from nmatrix.errors import did_you_mean, shortlist

USUAL_COMMAND = "world"  # it answers without any argument
WORDS = "meanings.txt"


_PART = re.compile(r"[A-Z]+(?![a-z])|[A-Z]?[a-z]+[0-9x]*|[0-9]+")  # gluLookAt is glu, Look, At
_ONE_AXIS = re.compile(r"--(?P<name>[a-z][a-zA-Z-]*?)[-_]?(?P<axis>[xyzXYZ])")
_NUMBER = re.compile(r"[+\-−]?[0-9.][0-9./e+\-]{0,30}")
_AMOUNT = re.compile(r"[+\-−]?[0-9.p][0-9./pie+\-]{0,30}(?:deg|rad|turn)?")
_MATRIX = re.compile(r"[\w\[({.#][\w ,;.:/#+\-\[\](){}]{0,200}")  # a literal, or a file
# What other tools put before and behind the word that has the meaning.
_BEFORE = frozenset(
    {"as", "build", "camera", "compute", "create", "cv", "d3dx", "extract", "from", "get", "gl"}
    | {"glu", "is", "make", "mat", "matrix", "quaternion", "set", "to", "transform", "with", "xm"}
)
_AFTER = frozenset(
    {"d", "deg", "f", "fv", "lh", "mat", "mat4", "matrix", "matrix4", "no", "rad", "rh", "zo"}
)


def _plain(word: str) -> str:
    return word.lstrip("-").replace("-", "").replace("_", "").casefold()


def _spellings(word: str) -> Iterator[str]:
    """Spell a word as it is, then without its namespace and what others put around it.

    Examples
    --------
    >>> list(_spellings("XMMatrixLookAtLH"))
    ['xmmatrixlookatlh', 'xmmatrixlookat', 'matrixlookatlh', 'matrixlookat', 'lookatlh', 'lookat']
    """
    yield _plain(word)
    parts = [one.casefold() for one in _PART.findall(re.split(r"[.:]+", word)[-1])]
    first = next((i for i, one in enumerate(parts) if one not in _BEFORE), len(parts) - 1)
    behind = next((i for i, one in enumerate(reversed(parts)) if one not in _AFTER), 0)
    for start in range(first + 1):
        for end in range(len(parts), max(len(parts) - behind, start + 1) - 1, -1):
            if (found := "".join(parts[start:end])) not in ("from", "to", _plain(word)):
                yield found


@cache
def meanings() -> dict[str, tuple[str, ...]]:
    """Every foreign word, spelled without marks, with its hints, best first."""
    found: dict[str, tuple[str, ...]] = {}
    for line in (get_data(__name__, WORDS) or b"").decode().splitlines():
        words, _, hints = line.partition(": ")
        if not line.startswith("#"):
            found |= dict.fromkeys(map(_plain, words.split()), tuple(hints.split(" | ")))
    return found


def names_of(command: str) -> list[str]:
    """List the options of a command, in every spelling."""
    return [name for one in table()[command]["options"] for name in one["names"]]


def _usable(hint: str, command: str) -> str | None:
    """Spell a hint as it is typed here; None for one that names what does not exist."""
    words = hint.split()
    if hint.startswith("-"):
        return hint if words[0].partition("=")[0] in names_of(command) else None
    if words[0] not in COMMANDS and words[0] != "help":
        return None
    options = [
        word.partition("=")[0] for word in words if word.startswith("--") or word in ("-f", "-o")
    ]
    known = names_of(words[0])
    return f"nmatrix {hint}" if all(one in known for one in options) else None


def meant_by(word: str, command: str = "") -> str | None:
    """Find what a word of another tool is called here, for a command or before any."""
    if command and len(_plain(word)) == 1 and not word.startswith("--"):
        return None  # a letter is a slip, or an expression
    known = next((meanings()[one] for one in _spellings(word) if one in meanings()), ())
    hints = sorted(known, key=lambda one: not one.startswith("-"))
    return next((found for one in hints if (found := _usable(one, command))), None)


def command_for(word: str) -> str:
    """Say which command was meant by a word that is none."""
    found = None if word.startswith("-") else meant_by(word)
    if found is not None:
        return f"did you mean {'nmatrix ' if found.startswith('-') else ''}{found}?"
    return (None if word.startswith("-") else _taken_by(f"--{word}")) or did_you_mean(
        word, (*COMMANDS, "help"), f"the commands are {', '.join(COMMANDS)}"
    )


def _taken_by(option: str) -> str | None:
    """Name commands that have an option."""
    takers = [name for name in COMMANDS if option in names_of(name)]
    if not takers:
        return None
    return f"{option} is an option of nmatrix {shortlist(takers, 3)}"


def option_for(word: str, command: str, known: Sequence[str], words: Sequence[str] = ()) -> str:
    """Say which option was meant by one that a command does not know, among the words typed."""
    whole = _of_axes(word, command, words)
    if whole is not None:
        return f"write {whole}"
    found = meant_by(word, command)
    if found is not None:
        return f"did you mean {_with_own_numbers(found, words)}?"
    return _taken_by(word) or did_you_mean(word, known, "see --help")


def _with_own_numbers(hint: str, words: Sequence[str]) -> str:
    """Put the numbers or the matrix typed behind a word in place of those of its hint.

    Only as many plain numbers for as many: an angle in radians has another unit.

    Examples
    --------
    >>> _with_own_numbers("--eye 3 3 3", ["--position", "1", "-2", "0", "--up", "0"])
    '--eye 1 -2 0'
    """
    head, _, given = f" {hint}".partition(" --")
    option, *numbers = given.split(" ")
    if numbers and numbers[0].startswith('"'):
        matrix = next(filter(_MATRIX.fullmatch, words[1:2]), None)
        return hint if matrix is None else f'{head} --{option} "{matrix}"'.lstrip()
    typed = [
        one for first in words[:1] for one in first.partition("=")[2].replace(",", " ").split()
    ]
    typed = typed or [*takewhile(_NUMBER.fullmatch, words[1:])]
    if len(typed) != len(numbers) or not all(map(_NUMBER.fullmatch, (*typed, *numbers))):
        return hint
    return f"{head} --{option} {' '.join(typed)}".lstrip() if numbers else hint


def _of_axes(word: str, command: str, words: Sequence[str]) -> str | None:
    """Write one option of three numbers for those that have an axis in their names.

    Examples
    --------
    >>> _of_axes("--rotate-y", "world", ["--rotate-y", "45", "--rotate-z=10"])
    '--rotate 0 45 10'
    """
    meant = _along(word, command)
    if meant is None:
        return None
    option, rest = meant[0], "1" if meant[0] == "--scale" else "0"
    numbers = dict.fromkeys("xyz", rest)
    for at, one in enumerate(words):
        name, equals, value = one.partition("=")
        if (found := _along(name, command)) is not None and found[0] == option:
            numbers[found[1]] = value if equals else next(iter(words[at + 1 :]), "")
    if not all(map(_AMOUNT.fullmatch, numbers.values())):
        return None
    return f"{option} {' '.join(numbers.values())}"


def _along(word: str, command: str) -> tuple[str, str] | None:
    """Part a name such as --rotate-y into an option of three numbers and an axis."""
    found = _ONE_AXIS.fullmatch(word)
    if found is None:
        return None
    bare = f"--{found['name']}"
    option = bare if bare in names_of(command) else (meant_by(bare, command) or "").split(" ")[0]
    taken = next((one for one in table()[command]["options"] if option in one["names"]), None)
    return (option, found["axis"].lower()) if taken and taken["takes"] == len(AXES) else None


def program_option_for(word: str) -> str:
    """Find what was meant by an option that stands before a command."""
    takers = [name for name in COMMANDS if word in names_of(name)]
    if not takers:
        found = meant_by(word)
        return f"did you mean {found}?" if found else did_you_mean(word, names_of(""), "see --help")
    one = next(one for one in table()[takers[0]]["options"] if word in one["names"])
    if takers[0] != USUAL_COMMAND or not (one["words"] or one["takes"] == 0):
        return f"put it behind a command that takes it, such as nmatrix {takers[0]}"
    value = "json" if "json" in one["words"] else next(iter(one["words"]), "")
    return f"try nmatrix {takers[0]} {word} {value}".rstrip()
