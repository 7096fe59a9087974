"""One command: its words gathered before Typer sees them, its help with the examples first.

What Typer would refuse in its own words is refused here: WHAT (value): why; next step.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from typer.core import TyperArgument, TyperCommand, TyperOption

from nmatrix.cli.show import put
from nmatrix.cli.tokens import OptionShape, gather
from nmatrix.errors import IllegalValueError

if TYPE_CHECKING:
    from typer._click import Context, HelpFormatter


class GatheringCommand(TyperCommand):
    """A command whose options take their values as separate words."""

    examples: tuple[str, ...] = ()

    def parse_args(self, ctx: Context, args: list[str]) -> list[str]:
        """Gather the words first; while completing, leave them as they are."""
        if ctx.resilient_parsing:
            return super().parse_args(ctx, args)
        if _ask_for_help(args):
            return super().parse_args(ctx, ["--help"])
        options = [one for one in self.get_params(ctx) if isinstance(one, TyperOption)]
        words = gather(args, [_shape(one) for one in options])
        self._check_arguments(ctx, words[words.index("--") + 1 :] if "--" in words else [])
        return super().parse_args(ctx, words)

    def _check_arguments(self, ctx: Context, values: list[str]) -> None:
        """Refuse a value too many, and say which argument is missing."""
        places = [one for one in self.get_params(ctx) if isinstance(one, TyperArgument)]
        required = [one for one in places if one.required]
        if len(values) > len(places) and all(one.nargs == 1 for one in places):
            names = " and ".join(one.metavar or one.name or "" for one in places) or "options only"
            raise IllegalValueError(
                f"argument ({values[len(places)][:40]})",
                f"{self.name} takes {names}",
                "leave it out, or put what belongs together in quotes",
            )
        if len(values) < len(required):
            name = required[len(values)].metavar or required[len(values)].name
            example = self.examples[0] if self.examples else f"nmatrix {self.name} --help"
            raise IllegalValueError(f"{name}", "it is missing", f"try {example}")

    def format_help(self, ctx: Context, formatter: HelpFormatter) -> None:
        """Write the examples, then the usage, the sentence and the options."""
        put("".join(f"  {example}\n" for example in self.examples))
        super().format_help(ctx, formatter)


def examples_and_sentence(text: str) -> tuple[tuple[str, ...], str]:
    r"""Part a command's help: its paragraphs that are command lines, and the others.

    Examples
    --------
    >>> examples_and_sentence("nmatrix calc \"\\[1]\"\n\nThe calculator.")
    (('nmatrix calc "[1]"',), 'The calculator.')
    """
    paragraphs = text.split("\n\n")
    examples = [one for one in paragraphs if _is_command_line(one)]
    rest = [one for one in paragraphs if not _is_command_line(one)]
    return tuple(one.replace("\\[", "[") for one in examples), "\n\n".join(rest)


def _is_command_line(paragraph: str) -> bool:
    return paragraph.startswith("nmatrix ")


def _ask_for_help(words: list[str]) -> bool:
    return "--help" in (words[: words.index("--")] if "--" in words else words)


def _shape(option: TyperOption) -> OptionShape:
    arity = 0 if option.is_flag else len((option.metavar or "VALUE").split())
    choices = tuple(str(one) for one in getattr(option.type, "choices", ()))
    return OptionShape(
        (*option.opts, *option.secondary_opts), arity, bool(option.multiple), choices
    )
