"""A page for each command, of the words of its help and of examples that ran."""

from __future__ import annotations

from collections.abc import Iterator

from markdown import head, indexed, plain
from runs import transcript
from typer.core import TyperArgument, TyperOption

from nmatrix.cli import help as pages
from nmatrix.cli.app import load
from nmatrix.cli.catalogue import COMMANDS, CatalogueEntry, Panel

# Where more is told of the commands of a panel: a document, and what it is.
TOLD_IN = {
    Panel.MATRICES: ("conventions", "Conventions: frames, hands, units, memory layout"),
    Panel.SPACES: ("conventions", "Conventions: frames, hands, units, memory layout"),
    Panel.PROOFS: ("rendering", "Pictures that prove something"),
    Panel.STUDIES: ("accuracy", "What accuracy costs, and what it buys"),
    Panel.CLASSROOM: ("for-teachers", "For teachers"),
    Panel.FILES: ("for-engineers", "For engineers"),
}
MEASURED = "cost"  # its numbers are times, which are others on every machine
SLOWEST = 1  # examples of a command that measures


def written() -> Iterator[tuple[str, str]]:
    """Write the pages of the commands, and the page that lists them; give names and texts."""
    yield "commands/index.md", _list()
    for name, one in COMMANDS.items():
        yield f"commands/{name}.md", page(name, one)


def page(name: str, entry: CatalogueEntry) -> str:
    """Write one page."""
    command = load(name)
    sentence, stop = entry.sentence, "" if entry.sentence.endswith("?") else "."
    options = [one for one in command.params if isinstance(one, TyperOption)]
    arguments = [one for one in command.params if isinstance(one, TyperArgument)]
    places = [f"{one.metavar}" if one.required else f"[{one.metavar}]" for one in arguments]
    lines = [head(f"nmatrix {name}: {sentence}{stop} Usage, options, exit codes, examples.")]
    lines += [f"# nmatrix {name}: {plain(sentence[:1].lower() + sentence[1:])}\n"]
    lines += [indexed([f"nmatrix {name}"])]
    lines += [f"{plain(command.help or '')}\n"]
    lines += [f"```text\nnmatrix {' '.join([name, *places, '[OPTIONS]'])}\n```\n"]
    lines += ["## Examples\n", *_examples(name, command.examples)]
    if arguments:
        lines += ["## Arguments\n"]
        lines += [f"`{one.metavar}`\n: {plain(pages.description_of(one))}\n" for one in arguments]
    lines += [f"```{{program}} nmatrix {name}\n```\n"]
    own = [one for one in options if one.rich_help_panel is None]
    if own:
        lines += ["## Options\n", *map(_option, own)]
    for panel, listed in pages.by_panel(options).items():
        lines += [f"## Options: {panel}\n", *map(_option, listed)]
    lines += [f"## Exit codes of nmatrix {name}\n"]
    lines += [f"{code}\n: {plain(told)}\n" for code, told in pages.exit_codes().items()]
    lines += ["## See also\n", *_related(name, entry)]
    return "\n".join(lines)


def _examples(name: str, examples: tuple[str, ...]) -> list[str]:
    """Run the examples; of a command that measures, one."""
    if name != MEASURED:
        return [transcript(one) for one in examples]
    return [
        *(transcript(one) for one in examples[:SLOWEST]),
        "These times are those of the machine on which this page was built. More of it:\n",
        "```sh\n" + "\n".join(examples[SLOWEST:]) + "\n```\n",
    ]


def _option(one: TyperOption) -> str:
    typed, told = pages.as_typed(one), plain(pages.description_of(one))
    return f"````{{option}} {typed}\n{told}\n````\n"


def _related(name: str, entry: CatalogueEntry) -> list[str]:
    """Link what stands near: the other commands of the panel, and the documents."""
    near = [other for other, one in COMMANDS.items() if one.panel is entry.panel and other != name]
    document, told = TOLD_IN[entry.panel]
    lines = [f"* [nmatrix {one}]({one}.md): {plain(COMMANDS[one].sentence)}" for one in near]
    lines += [f"* [{told}](../{document}.md)"]
    return [*lines, "* [The command line](../command-line.md): formats, numbers, files\n"]


def _list() -> str:
    """Write the list of the commands by their panels."""
    lines = [head("Every command of nmatrix: usage, options, exit codes, examples that ran.")]
    lines += ["# Commands of nmatrix\n"]
    lines += [
        "Each with its usage, its options by group, and examples that ran as this was built.\n"
    ]
    for panel in Panel:
        lines += [f"## {panel}\n"]
        lines += [
            f"* [nmatrix {name}]({name}.md): {plain(one.sentence)}"
            for name, one in COMMANDS.items()
            if one.panel is panel
        ]
        lines += [""]
    names = "\n".join(f"nmatrix {name} <{name}>" for name in COMMANDS)
    return "\n".join([*lines, f"```{{toctree}}\n:hidden:\n\n{names}\n```\n"])
