"""From words to option groups: what stands between a command and Typer.

A command takes option groups, frozen dataclasses; Typer sees their fields as flat options. It must
not be given more than it can read, so the words are gathered first: an option of N values takes N
words and becomes one `--option=values` token, −3 is a value, and whatever else is a value stands
behind `--`. What is read is told by metavars: an option of `X Y Z` takes three values, one of
`S|X Y Z` one or three, one of `Z...` all up to the next option; an argument EXPRESSION may be `-M`,
and MATRIX may be nine or sixteen words. What Typer would refuse in its
own words is refused here: WHAT (value): why; next step.
"""

from __future__ import annotations

import inspect
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import Field, dataclass, field, fields, is_dataclass
from functools import wraps
from typing import TYPE_CHECKING, Any, get_type_hints

from typer.core import TyperArgument, TyperCommand, TyperOption

from nmatrix.errors import IllegalValueError, did_you_mean

if TYPE_CHECKING:
    from typer._click import Context

Group = Any  # a frozen dataclass type; its fields are Typer's options, or groups again

# A minus with a digit, a point or pi behind it is a number; "-" and "-#KEY" are standard input.
_VALUE = re.compile(r"-(?:[\d.].*|(?:pi|π).*|#.*)?\Z", re.DOTALL)
_NUMBER = re.compile(r"[+\-−]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+|/[+-]?[0-9]+)?")
AXES = ("x", "y", "z")
ONE_OR = "S|"  # begins the metavar of an option that takes one value or several
MATRICES, SIZES = ("MATRIX", "ANSWER"), (16, 12, 9)
# What numbers without an option mean to those who have other programs in their fingers.
IN_ORDER = {
    "trace": ("--point", "--normal"),
    "projection": ("--fov", "--aspect", "--near", "--far"),
    "view": ("--eye", "--target", "--up"),
    "eye": ("--eye",),
    "light": ("--light-direction",),
}
AND_MORE = "..."  # ends the metavar of an option that takes any number of values
_SEPARATOR = re.compile(r"[\s,]")
_DECIMAL = re.compile(r"[+\-−]?[0-9]{1,20}(?:,[0-9]{1,20})?")
EXPRESSION = "EXPRESSION"  # the metavar of an argument that may begin with any minus
# Two minus signs before a word of small letters are an option with a slip, not an expression.
_LONG_OPTION = re.compile(r"--[a-z][a-z-]+(?:=.*)?\Z", re.DOTALL)
HELP_OPTIONS = ("--help", "-h")


def with_flat_options(command: Callable[..., None]) -> Callable[..., None]:
    """Replace every parameter of a command that is a dataclass by its fields, and theirs.

    A field that two groups share, such as `handed`, becomes one option and reaches both.
    """
    hints = get_type_hints(command, include_extras=True)
    hints.pop("return", None)
    groups: dict[str, Group] = {name: kind for name, kind in hints.items() if is_dataclass(kind)}
    parameters: dict[str, inspect.Parameter] = {}
    for name, parameter in inspect.signature(command).parameters.items():
        if name not in groups:
            parameters[name] = parameter.replace(
                annotation=hints[name], kind=inspect.Parameter.KEYWORD_ONLY
            )
    for kind in groups.values():
        parameters |= _field_parameters(kind)

    @wraps(command)
    def flat(**given: object) -> None:
        built = {name: _built(kind, given) for name, kind in groups.items()}
        plain = {name: given[name] for name in hints if name not in groups}
        command(**built, **plain)

    signature = inspect.Signature(list(parameters.values()))
    flat.__signature__ = signature  # type: ignore[attr-defined]  # inspect looks for it
    flat.__annotations__ = {name: one.annotation for name, one in parameters.items()}
    return flat


def _field_parameters(group: Group) -> dict[str, inspect.Parameter]:
    found: dict[str, inspect.Parameter] = {}
    for one, kind in _typed_fields(group):
        if is_dataclass(kind):
            found |= _field_parameters(kind)
        else:
            found[one.name] = inspect.Parameter(
                one.name, inspect.Parameter.KEYWORD_ONLY, default=one.default, annotation=kind
            )
    return found


def _built(group: Group, given: Mapping[str, object]) -> object:
    return group(
        **{
            one.name: _built(kind, given) if is_dataclass(kind) else given[one.name]
            for one, kind in _typed_fields(group)
        }
    )


def _typed_fields(group: Group) -> list[tuple[Field[object], Any]]:
    hints = get_type_hints(group, include_extras=True)
    return [(one, hints[one.name]) for one in fields(group)]


class GatheringCommand(TyperCommand):
    """A command whose options take their values as separate words."""

    examples: tuple[str, ...] = ()

    def parse_args(self, ctx: Context, args: list[str]) -> list[str]:
        """Gather the words first."""
        parameters = self.get_params(ctx)
        options = [one for one in parameters if isinstance(one, TyperOption)]
        reads_expression = any(one.metavar == EXPRESSION for one in parameters)
        words = gather(args, options, command=self.name or "", reads_expression=reads_expression)
        end = words.index("--") if "--" in words else len(words)
        places = [one for one in parameters if isinstance(one, TyperArgument)]
        values = _with_matrix(words[end + 1 :], places)
        self._check_arguments(values, places, options)
        return super().parse_args(ctx, [*words[:end], "--", *values] if values else words)

    def _check_arguments(
        self, values: list[str], places: list[TyperArgument], options: list[TyperOption]
    ) -> None:
        """Refuse a value too many, and say which argument is missing."""
        required = [one for one in places if one.required]
        if len(values) > len(places) and all(one.nargs == 1 for one in places):
            meant = _as_options(values, IN_ORDER.get(self.name or "", ()), options)
            names = " and ".join(one.metavar or one.name or "" for one in places) or "options only"
            raise IllegalValueError(
                f"argument ({values[len(places)][:40]})",
                f"{self.name} takes {names}",
                f"write nmatrix {self.name} {meant}"
                if meant
                else "leave it out, or put what belongs together in quotes",
            )
        if len(values) < len(required):
            name = required[len(values)].metavar or required[len(values)].name
            example = self.examples[0] if self.examples else f"nmatrix {self.name} --help"
            raise IllegalValueError(f"{name}", "it is missing", f"try {example}")


def _with_matrix(values: list[str], places: list[TyperArgument]) -> list[str]:
    """Make one word of the numbers of a matrix at the end, if there are too many words without.

    Examples
    --------
    >>> place = TyperArgument(param_decls=["m"], metavar="MATRIX")
    >>> _with_matrix("1 0 0 0 2 0 0 0 1".split(), [place])
    ['1 0 0 0 2 0 0 0 1']
    """
    if len(values) <= len(places) or not any(one.metavar in MATRICES for one in places):
        return values
    for size in SIZES:
        before, numbers = values[:-size], values[-size:]
        fits = len(numbers) == size and len(before) < len(places)
        if fits and all(map(_NUMBER.fullmatch, numbers)):
            return [*before, " ".join(numbers)]
    return values


def _as_options(values: list[str], names: tuple[str, ...], known: list[TyperOption]) -> str:
    """Write numbers behind the options that they may be meant for; nothing if they do not fit.

    Examples
    --------
    >>> point = TyperOption(param_decls=["--point"], metavar="X Y Z", type=str)
    >>> [_as_options(words, ("--point",), [point]) for words in (["0", "0", "6"], ["6"])]
    ['--point 0 0 6', '']
    """
    sizes = {name: len((one.metavar or "").split()) for one in known for name in one.opts}
    left, written = values, []
    for name in names:
        taken, left = left[: sizes[name]], left[sizes[name] :]
        if len(taken) < sizes[name] or not all(map(_NUMBER.fullmatch, taken)):
            return ""
        written += [name, *taken]
        if not left:
            return " ".join(written)
    return ""


def examples_and_notes(text: str) -> tuple[tuple[str, ...], str]:
    r"""Split a command's help: its paragraphs that are command lines, and the others.

    Examples
    --------
    >>> examples_and_notes("nmatrix calc \"\\[1]\"\n\nExact.")
    (('nmatrix calc "[1]"',), 'Exact.')
    """
    paragraphs = text.split("\n\n")
    examples = tuple(one for one in paragraphs if one.startswith("nmatrix "))
    notes = "\n\n".join(one for one in paragraphs if one not in examples)
    return tuple(one.replace("\\[", "[") for one in examples), notes


def asks_for(names: Iterable[str], words: Sequence[str]) -> bool:
    """Whether one of these options stands among the words, before any `--`."""
    before = words[: words.index("--")] if "--" in words else words
    return any(name in before for name in names)


@dataclass
class _Reader:
    words: list[str]
    at: int = 0
    given: set[str] = field(default_factory=set)

    def all_values(self, option: str) -> str:
        """Take all values up to the next option, one at the least."""
        taken = [self.values(option, 1)]
        while self.at < len(self.words) and is_value(self.words[self.at]):
            taken.append(self.values(option, 1))
        return " ".join(taken)

    def values(self, option: str, count: int, *, or_one: bool = False) -> str:
        """Take so many values, or one word that holds several.

        Where one alone will do, only numbers are taken behind it: the next word may be an argument.
        """
        taken: list[str] = []
        while len(taken) < count and self.at < len(self.words) and is_value(self.words[self.at]):
            if or_one and taken and not _NUMBER.fullmatch(self.words[self.at]):
                break
            taken.append(self.words[self.at])
            self.at += 1
            if count > 1 and len(taken) == 1 and _SEPARATOR.search(taken[0].strip()):
                _refuse_decimal_commas(
                    option, [taken[0], *self.words[self.at :][: count - 1]], count
                )
                return taken[0]
        if len(taken) < count and not (or_one and len(taken) == 1):
            what = "a value" if count == 1 else f"{'1 or ' if or_one else ''}{count} numbers"
            where = f"before {self.words[self.at]}" if self.at < len(self.words) else "at the end"
            raise IllegalValueError(
                f"{option} takes {what}, got {len(taken) or 'none'} {where}",
                next_step=_along_axis(option, taken) if count == len(AXES) else "",
            )
        return " ".join(taken)


def _refuse_decimal_commas(option: str, words: list[str], count: int) -> None:
    """Refuse so many words for so many numbers, some with a comma for a point."""
    if len(words) == count > words[0].count(",") + 1 and all(map(_DECIMAL.fullmatch, words)):
        raise IllegalValueError(
            f"{option} ({' '.join(words)[:60]})",
            "a comma parts numbers, it is no decimal point",
            f"write {option} {' '.join(words).replace(',', '.')[:80]}",
        )


def _along_axis(option: str, words: list[str]) -> str:
    """Write the three numbers of an axis by its letter, and of how much about or along it.

    Examples
    --------
    >>> _along_axis("--rotate", ["y", "45"]), _along_axis("--up", ["z"]), _along_axis("--up", ["1"])
    ('write --rotate 0 45 0', 'write --up 0 0 1', '')
    """
    if not words or words[0] not in AXES:
        return ""
    amount = words[1] if len(words) > 1 else "1"
    return f"write {option} {' '.join(amount if one == words[0] else '0' for one in AXES)}"


def is_value(word: str) -> bool:
    """Whether a word is a value and not an option.

    Examples
    --------
    >>> [is_value(word) for word in ("-3", "-.5", "-", "-#value", "-f", "--scale", "1 0 0")]
    [True, True, True, True, False, False, True]
    """
    return not word.startswith("-") or _VALUE.match(word) is not None


def gather(
    words: Sequence[str],
    known: Iterable[TyperOption],
    *,
    command: str = "",
    reads_expression: bool = False,
) -> list[str]:
    """Join every option and its values into one token.

    Where an expression is read, the first word that no option is spelled like is it.

    Raises
    ------
    IllegalValueError
        For an unknown option, too few values, or an option given twice.

    Examples
    --------
    >>> scale = TyperOption(param_decls=["--scale"], metavar="X Y Z", type=str)
    >>> gather(["--scale", "1", "-2", "1", "-1"], [scale])
    ['--scale=1 -2 1', '--', '-1']
    >>> gather(["-M", "--scale", "1 2 1"], [scale], reads_expression=True)
    ['--scale=1 2 1', '--', '-M']
    """
    by_name = {name: one for one in known for name in one.opts}
    reader = _Reader(list(words))
    options: list[str] = []
    values: list[str] = []
    while reader.at < len(reader.words):
        word = reader.words[reader.at]
        reader.at += 1
        if word == "--":
            values += reader.words[reader.at :]
            break
        may_be_expression = reads_expression and not values
        if is_value(word) or (may_be_expression and not _is_option(word, by_name)):
            values.append(word)
        else:
            options.append(_option(word, by_name, reader, command))
    return [*options, "--", *values] if values else options


def _is_option(word: str, by_name: dict[str, TyperOption]) -> bool:
    """Tell an option from an expression that begins with a minus; `-fjson` is `-f json`."""
    if word.partition("=")[0] in by_name or _LONG_OPTION.match(word) is not None:
        return True
    short = by_name.get(word[:2])
    return short is not None and word[2:] in getattr(short.type, "choices", ())


def takes(option: TyperOption) -> int:
    """Count the values that an option takes."""
    return len((option.metavar or "VALUE").split())


def _option(word: str, by_name: dict[str, TyperOption], reader: _Reader, command: str) -> str:
    name, joined = _split(word)
    option = by_name.get(name)
    if option is None:
        from nmatrix.cli.meanings import option_for

        raise IllegalValueError(
            f"option ({name[:40]})",
            "this command does not know it",
            option_for(name, command, list(by_name), [word, *reader.words[reader.at :]]),
        )
    full = max(option.opts, key=len)
    if full in reader.given and not option.multiple:
        raise IllegalValueError(full, "it is given twice", "keep one of them")
    reader.given.add(full)
    if option.is_flag:
        if joined is not None:
            raise IllegalValueError(f"{name} ({joined[:20]})", "it takes no value", f"use {name}")
        return full
    metavar = option.metavar or "VALUE"
    if joined is not None:
        value = joined
    elif metavar.endswith(AND_MORE):
        value = reader.all_values(full)
    else:
        value = reader.values(full, takes(option), or_one=metavar.startswith(ONE_OR))
    choices = [str(one) for one in getattr(option.type, "choices", ())]
    if choices and value not in choices:
        raise IllegalValueError(
            f"{full} ({value[:40]})",
            f"it is one of {', '.join(choices)}",
            did_you_mean(value, choices, f"try {choices[0]}"),
        )
    return f"{full}={value}"


def _split(word: str) -> tuple[str, str | None]:
    if word.startswith("--"):
        name, equals, value = word.partition("=")
        return name, value if equals else None
    return word[:2], word[2:].removeprefix("=") or None
