"""TAB: what may stand at the cursor, told to a shell in its own protocol.

A shell asks at every TAB, so nothing is loaded for its answer: neither Typer nor a command, only
`completions.json`, which `tests/completions.py` writes from the commands themselves. Names within a
scene are read from its file. Where nothing is offered, the shell offers files.
"""

from __future__ import annotations

import json
import os
import shlex
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from pathlib import Path
from pkgutil import get_data
from typing import Any, NamedTuple

TABLE = Path(__file__).with_name("completions.json")
PROGRAM = ""  # the entry of what stands before a command
ANY_NUMBER = -1  # an option that takes all values up to the next option
_NUMBER = "0123456789."


@cache
def table() -> dict[str, Any]:
    """Everything that may be typed, by command: arguments, options, how many values they take."""
    found: dict[str, Any] = json.loads(get_data(__name__, TABLE.name) or b"{}")
    return found


class Offer(NamedTuple):
    """A word that may stand at the cursor, and what it is for."""

    word: str
    about: str = ""


class Line:
    """Words behind a command, read by what it knows; `typed` keeps each option with its values."""

    def __init__(self, command: Mapping[str, Any]) -> None:
        self.command = command
        self.arguments: list[str] = []
        self.options: dict[str, list[str]] = {}
        self.typed: list[list[str]] = []
        self.open: Mapping[str, Any] | None = None  # the option whose value stands at the cursor

    def value(self, *names: str) -> str | None:
        """Find what was typed for an option, if anything."""
        return next((self.options[name][0] for name in names if self.options.get(name)), None)


def offers(words: Sequence[str], incomplete: str) -> list[Offer]:
    """Collect what may stand in place of the incomplete word; nothing means any file.

    Examples
    --------
    >>> [one.word for one in offers(["world"], "--sc")]
    ['--scale', '--scene']
    >>> [one.word for one in offers(["render", "normals"], "--theme=d")]
    ['--theme=dark']
    """
    command = table().get(words[0]) if words else table()[PROGRAM]
    if command is None:
        return []
    line = line_of(command, words[1:])
    name, equals, rest = incomplete.partition("=")
    if equals and (option := _option(command, name)) is not None:
        found = _values(line, option, rest)
        return [Offer(f"{name}={one.word}", one.about) for one in found]
    if line.open is not None:
        return _values(line, line.open, incomplete)
    if incomplete == "-" or (incomplete[:1] == "-" and incomplete[1] not in _NUMBER):
        return _starting(_options(line), incomplete)
    places = command["arguments"]
    at = len(line.arguments)
    if at >= len(places) and places and places[-1]["repeats"]:
        at = len(places) - 1
    if at < len(places):
        return _values(line, places[at], incomplete)
    return [] if incomplete else _options(line)


def _option(command: Mapping[str, Any], name: str) -> Mapping[str, Any] | None:
    return next((one for one in command["options"] if name in one["names"]), None)


def line_of(command: Mapping[str, Any], words: Sequence[str]) -> Line:
    """Give each word to its option, or to the arguments."""
    line = Line(command)
    wanted = 0
    for word in words:
        is_word = not word.startswith("-") or word[1:2] in _NUMBER
        if is_word and line.open is not None:
            line.options[line.open["names"][0]].append(word)
            line.typed[-1].append(word)
            wanted -= 1
            if wanted == 0 or " " in word.strip() or "," in word:
                line.open = None
        elif is_word:
            line.arguments.append(word)
        else:
            name, equals, value = word.partition("=")
            line.open = _option(command, name)
            if line.open is not None:
                line.typed.append([word])
                line.options[line.open["names"][0]] = [value] if equals else []
                wanted = line.open["takes"]
                if equals or wanted == 0:
                    line.open = None
    return line


def _options(line: Line) -> list[Offer]:
    """List the options that may still be given, by their longest names first."""
    return [
        Offer(name, one["about"])
        for one in (*line.command["options"], *line.command.get("pages", ()))
        if one["repeats"] or one["names"][0] not in line.options
        for name in sorted(one["names"], key=len, reverse=True)
    ]


def _starting(known: Iterable[Offer], incomplete: str) -> list[Offer]:
    return [one for one in known if one.word.startswith(incomplete)]


def _values(line: Line, place: Mapping[str, Any], incomplete: str) -> list[Offer]:
    """Offer the values of an option or an argument."""
    if (names := _IN_A_SCENE.get(place["names"][0])) is not None:
        return _starting(map(Offer, names(line)), incomplete)
    if place.get("after") and place["after"] not in line.arguments:
        return []
    before, comma, word = incomplete.rpartition(",") if place["listed"] else ("", "", incomplete)
    given = before.split(",")
    found = [Offer(f"{before}{comma}{one}") for one in place["words"] if one not in given]
    found = _starting(found, f"{before}{comma}{word}")
    return found + _files(incomplete, place["endings"]) if place["words"] else found


def _files(incomplete: str, endings: Sequence[str]) -> list[Offer]:
    """List files of some endings and the folders, where words are offered beside them."""
    if not endings:
        return []
    folder, slash, start = incomplete.rpartition("/")
    try:
        listed = sorted(Path(folder + slash or ".").iterdir())
    except OSError:
        return []
    found = [one for one in listed if one.name.startswith(start) and one.name[0] != "."]
    return [
        Offer(f"{folder}{slash}{one.name}{'/' if one.is_dir() else ''}")
        for one in found
        if one.is_dir() or one.suffix.lower() in endings
    ]


def _objects(line: Line) -> list[str]:
    scene = _scene(line)
    return _names(scene.get("object", scene.get("nodes")))


def _lights(line: Line) -> list[str]:
    scene = _scene(line)
    extensions = scene.get("extensions", {})
    return _names(scene.get("light", extensions.get("KHR_lights_punctual", {}).get("lights")))


def _names(tables: Any) -> list[str]:  # noqa: ANN401  # whatever the file holds
    """Collect the names of the tables of a scene file, each once."""
    return list(dict.fromkeys(str(one["name"]) for one in tables or () if "name" in one))


def _scene(line: Line) -> dict[str, Any]:
    """Read the tables of the scene that the line names; one that cannot be read has none."""
    file = line.value("--scene") or next(iter(line.arguments), None)
    if file is None:
        return {}
    from nmatrix.samples import file_or_sample

    try:
        content = file_or_sample(file).read_bytes()
        if content.startswith(b"glTF"):
            content = content[20 : 20 + int.from_bytes(content[12:16], "little")]
        if content.lstrip().startswith(b"{"):
            found = json.loads(content)
        else:
            import tomllib

            found = tomllib.loads(content.decode("utf-8"))
        _names(found.get("object", found.get("nodes")))
    except (OSError, ValueError, TypeError, AttributeError, KeyError):
        return {}  # a TAB is no place for an error
    return found if isinstance(found, dict) else {}


_IN_A_SCENE: Mapping[str, Callable[[Line], list[str]]] = {
    "--object": _objects,
    "--light": _lights,
}


def answer(instruction: str) -> str:
    """Answer a shell that asks, in its protocol; empty where it asks for nothing known."""
    protocol = _PROTOCOLS.get(instruction)
    return "" if protocol is None else protocol()


def _bash() -> str:
    """Write one word a line, without what bash holds for earlier: it parts words at = and : too."""
    line = os.environ.get("COMP_LINE")
    if line is None:
        words = _split(os.environ.get("COMP_WORDS", ""))
        at = int(os.environ.get("COMP_CWORD", "0"))
        words, incomplete = words[1:at], words[at] if at < len(words) else ""
        if incomplete == "=":
            words, incomplete = words[:-1], f"{words[-1]}="
        elif words and words[-1] == "=":
            words, incomplete = words[:-2], f"{words[-2]}={incomplete}"
    else:
        words, incomplete = _cut(line[: int(os.environ.get("COMP_POINT", len(line)))])
    held = 1 + max(incomplete.rfind(mark) for mark in "=:")
    return "\n".join(_escaped(one.word)[held:] for one in offers(words, incomplete))


def _escaped(word: str) -> str:
    """Put a backslash before what a shell would read."""
    return "".join(f"\\{mark}" if mark in " \t\"'\\$`&|;<>()*?[]{}!#" else mark for mark in word)


def _zsh() -> str:
    """Call a function of zsh with the words and what they are for, or with files."""
    found = offers(*_cut(os.environ.get("_TYPER_COMPLETE_ARGS", "")))
    if not found:
        return "_files"
    listed = [
        f'"{_in_zsh(one.word)}":"{_in_zsh(one.about)}"' if one.about else f'"{_in_zsh(one.word)}"'
        for one in found
    ]
    return "_arguments '*: :(({}))'".format("\n".join(listed))


def _in_zsh(text: str) -> str:
    for mark, spelled in (('"', '""'), ("'", "''"), ("$", r"\$"), ("`", r"\`"), (":", r"\\:")):
        text = text.replace(mark, spelled)
    return text


def _fish() -> str:
    """Write one word a line, what it is for behind a tab; asked whether any is there, leave."""
    found = offers(*_cut(os.environ.get("_TYPER_COMPLETE_ARGS", "")))
    if os.environ.get("_TYPER_COMPLETE_FISH_ACTION") == "is-args":
        raise SystemExit(0 if found else 1)
    return "\n".join(f"{one.word}\t{one.about}" if one.about else one.word for one in found)


def _powershell() -> str:
    words, incomplete = _cut(os.environ.get("_TYPER_COMPLETE_ARGS", ""))
    asked = os.environ.get("_TYPER_COMPLETE_WORD_TO_COMPLETE", incomplete)
    words = [*words, incomplete] if incomplete and not asked else words
    return "\n".join(f"{one.word}:::{one.about or ' '}" for one in offers(words, asked))


_PROTOCOLS: Mapping[str, Callable[[], str]] = {
    "complete_bash": _bash,
    "complete_zsh": _zsh,
    "complete_fish": _fish,
    "complete_powershell": _powershell,
    "complete_pwsh": _powershell,
}


def _cut(line: str) -> tuple[list[str], str]:
    """Part a line into the words behind the program, and the incomplete word at its end."""
    words = _split(line)[1:]
    if not words or line[-1:].isspace():
        return words, ""
    return words[:-1], words[-1]


def _split(line: str) -> list[str]:
    """Part a line as a shell does, also within a quotation that has no end yet."""
    for end in ("", '"', "'"):
        try:
            return shlex.split(line + end)
        except ValueError:
            continue
    return line.split()
