"""What `help` answers: the statements of a session, the operators, and each function by itself."""

from __future__ import annotations

from collections.abc import Iterable

from nmatrix.calculator.functions import FUNCTIONS
from nmatrix.calculator.functions.elsewhere import INSTEAD
from nmatrix.calculator.language.statements import Keyword
from nmatrix.enums import PARTICULAR_FORMATS, Format, InverseBy, Numbers
from nmatrix.errors import IllegalValueError, did_you_mean
from nmatrix.report import Block, Report, Table, Text

NO_FORMATS = (Format.TEXT, *PARTICULAR_FORMATS)  # faults and scores are no values
FORMATS = tuple(one for one in Format if one not in NO_FORMATS)
# How each keyword is written, and what it does.
USAGE = {
    Keyword.HELP: ("help inverse", "what a function does, its formula, an example"),
    Keyword.SHOW: ("show M as glsl", f"a value again; as {', '.join(FORMATS)}"),
    Keyword.VARS: ("vars", "every name that has a value"),
    Keyword.UNDO: ("undo", "go back before the last statement that changed something"),
    Keyword.STEPS: ("steps on", f"the way to each value, or off; steps by {', '.join(InverseBy)}"),
    Keyword.NUMBERS: ("numbers exact", f"how numbers are shown: {', '.join(Numbers)}"),
    Keyword.DIGITS: ("digits 8", "significant digits of decimals, 1 to 17"),
    Keyword.SAVE: ("save FILE", "keep the statements, for load or nmatrix calc FILE"),
    Keyword.LOAD: ("load FILE", "carry out the statements of a file"),
    Keyword.QUIT: ("quit", "leave, as Ctrl-D does"),
}
EVERY_FUNCTION = "functions"  # the topic that lists them
OPERATORS = "+  -  *  /  @ of matrices  ^2  ^-1  ^T  .T  .xyz  A[0,3]  ==  ~="


def page(topic: str) -> Report:
    """Explain a function or a keyword; without a topic list them all.

    Raises
    ------
    IllegalValueError
        For a word that is neither.

    Examples
    --------
    >>> page("det").blocks[0].text.splitlines()[0]
    'det(A): the determinant: the factor by which A changes areas or volumes, with its sign'
    """
    word = topic.removesuffix("()")
    if not word:
        return _report(_overview())
    if word == EVERY_FUNCTION:
        return _report([Text(" ".join(sorted(FUNCTIONS)))])
    if word in FUNCTIONS:
        one = FUNCTIONS[word]
        return _report([Text(f"{one.usage(word)}: {one.does}\n{one.formula}\ntry {one.example}")])
    if word in list(Keyword):
        usage, does = USAGE[Keyword(word)]
        return _report([Text(f"{usage}: {does}")])
    step = INSTEAD.get(word.casefold()) or did_you_mean(
        word, (*FUNCTIONS, *Keyword), f"write help {EVERY_FUNCTION}"
    )
    raise IllegalValueError(f"help ({word[:40]})", "there is no such function", step)


def _overview() -> list[Block]:
    given = (
        ("x = 1/3", "give a value a name"),
        ("x + 1", "a value: ans is the last one, ans2 the one before"),
        ("# words", "a remark"),
    )
    functions = (f"help {EVERY_FUNCTION}", f"the names of all {len(FUNCTIONS)}")
    return [
        Table(("statement", "what it does"), (*given, functions, *USAGE.values())),
        Text(f"Operators: {OPERATORS}"),
    ]


def _report(blocks: Iterable[Block]) -> Report:
    return Report("calc", {}, tuple(blocks))
