"""Next steps that repeat what was typed: `check eye --scale 2` is told a line with its `--scale 2`.

An error from below names a command with an example. Here the example gets the arguments and the
options of the line at hand, as far as its command takes them, so that it runs as it stands.
"""

from __future__ import annotations

import re
import shlex
from collections.abc import Iterator, Sequence

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.completion import Line, line_of, table
from nmatrix.errors import OF_THE_SCENE

INSTEAD = "--batch"  # what takes the place of the argument behind the first
LONGEST = 400  # characters of a line that are worth reading

_EXAMPLE = re.compile(r"(?<=\Atry nmatrix ).+\Z")
_SAME_SCENE = re.compile(rf"(?<=\Anmatrix )(?P<command>[a-z]+)(?P<space>[a-z ]*) {OF_THE_SCENE}")
_PLAIN = re.compile(r"[\w@%+=:,./-]+")


def with_own_words(told: str, words: Sequence[str]) -> str:
    """Put what was typed into the example of a next step.

    Examples
    --------
    >>> with_own_words("try nmatrix axes blender unity", ["axes", "ros", "--json"])
    'try nmatrix axes ros unity --json'
    """
    command = words[0] if words and words[0] in COMMANDS else None
    if command is None or not all(map(str.isprintable, words)):
        return told
    found = told
    if (example := _EXAMPLE.search(told)) is not None:
        found = told[: example.start()] + _repeated(example[0], command, words)
    elif (scene := _SAME_SCENE.search(told)) is not None:
        own = _line(command, words)
        space = "" if own.value("--space") else scene["space"]
        line = " ".join([scene["command"] + space, *_options(scene["command"], own)])
        found = told[: scene.start()] + line + told[scene.end() :]
    return found if len(found) <= LONGEST else told


def _repeated(example: str, command: str, words: Sequence[str]) -> str:
    """Write an example with the arguments and options of a line of the same command."""
    name, *others = shlex.split(example)
    if name != command:
        return example
    own, usual = _line(command, words), _line(command, [name, *others])
    arguments = usual.arguments
    if len(own.arguments) < len(arguments):  # else one of them is what was refused
        arguments = [*own.arguments, *arguments[len(own.arguments) :]]
    if own.value(INSTEAD) is not None:
        arguments = arguments[:1]
    panels = _panels(command)
    taken = {panels.get(one[0].partition("=")[0]) for one in own.typed}
    kept = [one for one in usual.typed if panels.get(one[0]) not in taken]
    options = [" ".join(map(_quoted, one)) for one in kept]
    return " ".join([name, *map(_quoted, arguments), *options, *_options(command, own)])


def _options(command: str, line: Line) -> Iterator[str]:
    """Write the options of a line that a command takes, each with its values."""
    known = {name for one in table()[command]["options"] for name in one["names"]}
    for name, *values in line.typed:
        if name.partition("=")[0] in known:
            yield " ".join([_quoted(name), *map(_quoted, values)])


def _line(command: str, words: Sequence[str]) -> Line:
    return line_of(table()[command], words[1:])


def _panels(command: str) -> dict[str, str | None]:
    """Find the group of each option: what stands in one may contradict the others of it."""
    from nmatrix.cli.app import load

    return {
        name: getattr(one, "rich_help_panel", None)
        for one in load(command).params
        for name in one.opts
    }


def _quoted(word: str) -> str:
    """Quote a word as people do, and where that does not hold, as a shell needs it."""
    if _PLAIN.fullmatch(word):
        return word
    return shlex.quote(word) if set(word) & set('"$`\\!') else f'"{word}"'
