"""The words that TAB offers, collected from the commands: `nmatrix/cli/completions.json`.

`python tests/completions.py` writes it anew; a test compares.
"""

from __future__ import annotations

import json
from typing import Any

from typer import Context
from typer.core import TyperArgument, TyperOption

from nmatrix.answers.lint import SUFFIXES as OF_SHADERS
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS
from nmatrix.cli.command import AND_MORE, HELP_OPTIONS, takes
from nmatrix.cli.completion import ANY_NUMBER, PROGRAM, TABLE
from nmatrix.cli.help import PAGES, PROGRAM_OPTIONS
from nmatrix.output.spelling import sayable
from nmatrix.samples import samples
from nmatrix.scene.open import SUFFIXES

KINDS_OF_WORDS = ("arguments", "options", "pages")
HELP_FLAGS = {HELP_OPTIONS: "Show help.", ("--full",): "With --help: describe every option."}
KINDS = {".csv": (".csv",), ".toml": SUFFIXES, ".obj": SUFFIXES, ".vert": OF_SHADERS}


def place(one: TyperArgument | TyperOption, command: Any) -> dict[str, Any]:
    """Describe what may be typed for an option or an argument."""
    choices = [str(word) for word in getattr(one.type, "choices", ())]
    offered = one.shell_complete(Context(command), "") if not choices else []
    words = choices or [item.value for item in offered if item.type == "plain"]
    of_files = [kind for suffix, kind in KINDS.items() if set(words) & set(samples(suffix))]
    return {
        "words": words,
        "listed": one.metavar == "WORDS",
        "endings": sorted({suffix for kind in of_files for suffix in kind}),
    }


def table() -> dict[str, Any]:
    """Describe every command, and what stands before one."""
    found: dict[str, Any] = {
        PROGRAM: {
            "arguments": [_words("COMMAND", [*COMMANDS, "help"])],
            "options": [_flag(list(names), about) for names, about in PROGRAM_OPTIONS.items()],
        },
        "help": {
            "arguments": [_words("COMMAND", [*COMMANDS, *PAGES])],
            "options": [_flag(["--docs"], "Where the documentation is.")],
        },
    }
    for name in COMMANDS:
        command = load(name)
        options = [one for one in command.params if isinstance(one, TyperOption)]
        arguments = [one for one in command.params if isinstance(one, TyperArgument)]
        found[name] = {
            "arguments": [
                {
                    "names": [one.metavar or one.name],
                    "repeats": one.nargs != 1,
                    **place(one, command),
                    **_after(name, at),
                }
                for at, one in enumerate(arguments)
            ],
            "options": [
                {
                    "names": list(one.opts),
                    "about": sayable(one.help or "", "ascii"),
                    "takes": 0 if one.is_flag else _count(one),
                    "repeats": one.multiple,
                    **place(one, command),
                }
                for one in options
            ],
        }
        found[name]["pages"] = [_flag(list(names), about) for names, about in HELP_FLAGS.items()]
    return found


def _count(one: TyperOption) -> int:
    return ANY_NUMBER if (one.metavar or "").endswith(AND_MORE) else takes(one)


def _after(command: str, at: int) -> dict[str, str]:
    return {"after": "exercise"} if (command, at) == ("check", 1) else {}


def _words(name: str, words: list[str]) -> dict[str, Any]:
    return {"names": [name], "repeats": False, "words": words, "listed": False, "endings": []}


def _flag(names: list[str], about: str) -> dict[str, Any]:
    return {
        "names": names, "about": about, "takes": 0, "repeats": False,
        "words": [], "listed": False, "endings": [],
    }  # fmt: skip


def written() -> str:
    """Write the table with one option a line."""
    commands = []
    for name, one in table().items():
        kinds = [
            f'  "{kind}": [\n' + ",\n".join(f"   {json.dumps(x)}" for x in one[kind]) + "\n  ]"
            if one[kind]
            else f'  "{kind}": []'
            for kind in KINDS_OF_WORDS
            if kind in one
        ]
        commands.append(f" {json.dumps(name)}: {{\n" + ",\n".join(kinds) + "\n }")
    return "{\n" + ",\n".join(commands) + "\n}\n"


if __name__ == "__main__":
    TABLE.write_text(written(), encoding="utf-8")
