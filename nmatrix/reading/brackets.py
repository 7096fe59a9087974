"""Numbers in brackets of any kind, as a tree: what Python, C, Rust, JavaScript or a shader prints.

A group is a bracket, the word before it (`mat4`, `Vec4`, `tensor`) and what is in it. The scan is
one loop over tokens, so that ten thousand brackets cost no more than ten.
"""

from __future__ import annotations

import re
from dataclasses import dataclass, field

from nmatrix.errors import counted, quoted
from nmatrix.reading.contents import Tokens, cut_off, unreadable
from nmatrix.report import LARGEST_MATRIX

DEEPEST = 4  # brackets without a word before them: a matrix has two, a batch more
MOST = LARGEST_MATRIX**2  # numbers
PAIRS = {"[": "]", "(": ")", "{": "}", "<": ">"}
CUT = ("…", "...", "⋯")

_TOKEN = re.compile(
    # What follows the numbers of an array: dtype=float32, device='cuda:0', grad_fn=<MulBackward0>.
    r"(?P<aside>\b(?:dtype|device|requires_grad|grad_fn|size|shape)\s*=\s*"
    r"(?:<[^<>]{0,80}>|\([^()]{0,80}\)|[^\s,)\]]{0,80}))"
    r"|(?P<label>[\"']?\b(?:elements|columns|matrix[23]|translation|[xyzw]_axis|[XYZO])\b[\"']?\s*:"
    r"|\btype:[\w,]{1,60})"
    r"|<(?P<angle>Matrix [234]x[234])\b"
    # A typed array says how many numbers it has before it opens: Float32Array(16) [.
    r"|(?:(?P<head>(?:new\s+)?[A-Za-z_][\w.:]{0,60}(?:<\w{0,20}>)?"
    r"(?:\s?\([0-9]{1,2}\)(?=\s*\[)|\[[0-9]{0,2}\](?=\())?"
    r"|\([0-9]{1,2}\)(?=\s*\[))\s*)?(?P<open>[\[({])"
    r"|(?P<close>[\])}>])|(?P<comma>,)|(?P<row>;)|(?P<line>\n)"
    r"|(?P<word>[^\s\[\](){}<>,;|│]+|<)"
)
_NEW = re.compile(r"\Anew\s+")
_DECORATION = re.compile(r"(?<=[0-9.])(?:`[0-9.]*|_?f(?:32|64)?\Z|[FhHlL]\Z)")
_TALLY = re.compile(r"(?<=\])[ \n]{0,4}\([0-9]{1,2}\)\Z")  # Safari counts behind: [1, 0] (2)


@dataclass
class Group:
    """A bracket: the word before it, its numbers and groups, and how many stood before a row end.

    `rows` are the ends by semicolons, `lines` those of lines.
    """

    head: str = ""
    entries: list[str | Group] = field(default_factory=list)
    rows: list[int] = field(default_factory=list)
    lines: list[int] = field(default_factory=list)

    @property
    def groups(self) -> list[Group]:
        """The brackets in it."""
        return [one for one in self.entries if isinstance(one, Group)]

    @property
    def numbers(self) -> list[str]:
        """The numbers in it, those in inner brackets left out."""
        return [one for one in self.entries if isinstance(one, str)]


def plain_number(token: str) -> str:
    """Take off what languages put on numbers: 1.0f, 1f32, Mathematica's 1.*^-7 and 0.5`.

    Examples
    --------
    >>> [plain_number(one) for one in ("1.0f", "2f64", "1.*^-7", "0.5`15.2", "3", "x")]
    ['1.0', '2', '1.e-7', '0.5', '3', 'x']
    """
    return _DECORATION.sub("", token.replace("*^", "e"))


def whole_text(text: str, source: str) -> Group:
    """Read a text of brackets and nothing else; several of them are the rows of one.

    Raises
    ------
    IllegalValueError
        If the brackets do not match, nest too deeply, hold too much, or text follows them.

    Examples
    --------
    >>> whole_text("mat2(1, 0, 0, 1)", "x").head, len(whole_text("(1, 2), (3, 4)", "x").entries)
    ('mat2', 2)
    """
    scan = _Scan(source)
    for token in _TOKEN.finditer(_TALLY.sub("", text)):
        scan.take(token)
    found = scan.closed()
    if found.numbers and found.groups:
        raise unreadable(source, f"{quoted(found.numbers[0])} stands outside of the brackets")
    if any(one.head for one in found.groups) and len(found.groups) > 1:
        raise unreadable(source, "it holds several matrices", "give one of them")
    return _only(found.groups[0] if len(found.groups) == 1 else found, source)


def closing(text: str, start: int) -> int:
    """Find the end of the bracket that opens at `start`, behind a word or not.

    Examples
    --------
    >>> closing("mat2(1, 2, 3, 4) + 1", 0)
    16
    """
    depth = 0
    for token in _TOKEN.finditer(text, start):
        if token["open"] or token["angle"]:
            depth += 1
        elif token["close"]:
            depth -= 1
            if depth <= 0:
                return token.end()
    return len(text)


def first_group(text: str, source: str, start: int) -> tuple[Group, int]:
    """Read the bracket that opens at `start`, and find where it ends.

    Examples
    --------
    >>> first_group("a = [1, 2] + 3", "x", 4)[0].numbers, first_group("a = [1, 2] + 3", "x", 4)[1]
    (['1', '2'], 10)
    """
    scan = _Scan(source)
    for token in _TOKEN.finditer(text, start):
        scan.take(token)
        if len(scan.open) == 1 and token["close"]:
            return _only(scan.open[0].groups[-1], source), token.end()
    return scan.closed(), len(text)


def _only(group: Group, source: str) -> Group:
    """Take off brackets that stand around the only thing in others: a batch of one."""
    while len(group.entries) == 1 and group.groups and not (inner := group.groups[0]).head:
        if not inner.groups:
            break
        group.entries = inner.entries
    if any(not one.head and one.groups for one in group.groups):
        raise unreadable(source, "it holds several matrices", "give one of them")
    return group


def rows_of(group: Group, source: str) -> Tokens:
    """Lay out the numbers of a group in rows: inner brackets, semicolons, or lines of one length.

    Examples
    --------
    >>> rows_of(whole_text("[1 2; 3 4]", "x"), "x"), rows_of(whole_text("[[1], [2]]", "x"), "x")
    ([['1', '2'], ['3', '4']], [['1'], ['2']])
    """
    if group.groups:
        return [row for inner in group.groups for row in _inner_rows(inner, group, source)]
    lines = _pieces(group.numbers, group.lines)
    # A long list is wrapped at any number; lines that are rows have one length.
    are_rows = len({len(line) for line in lines}) == 1 and len(lines[0]) > 1
    return lines if are_rows and not group.rows else _pieces(group.numbers, group.rows)


def _inner_rows(inner: Group, outer: Group, source: str) -> Tokens:
    if outer.numbers:
        raise unreadable(source, f"{quoted(outer.numbers[0])} stands between brackets")
    if inner.groups:
        return rows_of(inner, source)
    return _pieces(inner.numbers, inner.rows)


def _pieces(numbers: list[str], ends: list[int]) -> list[list[str]]:
    starts = [0, *ends]
    pieces = [numbers[a:b] for a, b in zip(starts, [*ends, len(numbers)], strict=True)]
    return [one for one in pieces if one]


@dataclass
class _Scan:
    """Where the scan stands: the open brackets, and whether a number is due."""

    source: str
    open: list[Group] = field(default_factory=lambda: [Group()])
    closers: list[str] = field(default_factory=list)
    count: int = 0
    entry_due: bool = True

    def take(self, token: re.Match[str]) -> None:
        here = self.open[-1]
        if token["open"] or token["angle"]:
            self._open(token)
        elif token["close"]:
            self._close(token["close"])
        elif token["row"]:
            here.rows.append(len(here.entries))
        elif token["line"]:
            here.lines.append(len(here.entries))
        elif token["comma"]:
            if self.entry_due and self.closers:
                raise unreadable(self.source, "a number is missing before a comma")
            self.entry_due = True
        elif token["aside"]:
            self.entry_due = False
        elif token["word"]:
            self._number(plain_number(token["word"]))

    def closed(self) -> Group:
        """Take the whole, if every bracket was closed."""
        if self.closers:
            raise cut_off(
                self.source, f"after {counted(self.count, 'number')}: {self.closers[-1]} is missing"
            )
        return self.open[0]

    def _open(self, token: re.Match[str]) -> None:
        head = _NEW.sub("", token["head"] or token["angle"] or "").strip()
        group = Group(head)
        self.open[-1].entries.append(group)
        self.open.append(group)
        self.closers.append(PAIRS[token["open"] or "<"])
        self.entry_due = True
        if sum(not one.head for one in self.open[1:]) > DEEPEST or len(self.open) > DEEPEST + 3:
            raise unreadable(self.source, f"its brackets nest deeper than {DEEPEST}")

    def _close(self, mark: str) -> None:
        if not self.closers or self.closers.pop() != mark:
            raise unreadable(self.source, f"{mark} closes what it did not open")
        self.open.pop()
        self.entry_due = False

    def _number(self, word: str) -> None:
        if word in CUT:
            why = f"the program that printed it left numbers out ({word})"
            raise unreadable(self.source, why, "print all of them, such as JSON.stringify(m)")
        self.open[-1].entries.append(word)
        self.entry_due = False
        self.count += 1
        if self.count > MOST:
            raise unreadable(self.source, f"it holds more than {MOST} numbers")
