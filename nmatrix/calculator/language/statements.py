"""The statements of a session: where each begins and ends in a text, and what it asks for.

A statement is a line, or several: one goes on until its brackets close, and a matrix without
brackets until an empty line, so that what other programs print may be pasted behind `M =`.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from enum import StrEnum

from nmatrix.calculator.language.tokens import LONGEST
from nmatrix.reading.notations import has_no_end, is_no_list


class Keyword(StrEnum):
    """The words that begin a statement which is no expression."""

    HELP = "help"
    SHOW = "show"
    VARS = "vars"
    UNDO = "undo"
    STEPS = "steps"
    NUMBERS = "numbers"
    DIGITS = "digits"
    SAVE = "save"
    LOAD = "load"
    QUIT = "quit"


@dataclass(frozen=True)
class Statement:
    """What a statement asks for: the text behind its name or keyword, and where that begins.

    Without a keyword the text is an expression, and empty where nothing is asked.
    """

    whole: str
    text: str
    at: int
    name: str | None = None
    keyword: Keyword | None = None


REMARKS = ("#", "//", "%", "<!--")  # of a session, and of what other programs print
_NUMBER = r"[+\-−]?(?:[0-9]+(?:[.,][0-9]*)?|\.[0-9]+)(?:[eE][+\-−]?[0-9]+)?(?:/[0-9]+)?"
_GIVEN = re.compile(r"\s*(?!π)([A-Za-z_Α-Ωα-ω][A-Za-z0-9_]*)\s*=(?!=)\s*")
_KEYWORD = re.compile(rf"\s*({'|'.join(Keyword)})(?:\s+|\Z)")
_COMMENT = re.compile(r"(?:\A|(?<=\s))#.*")
# What a program declares, with the type before its name: const mat2 m = …, float m[2][2] = …
_DECLARED = re.compile(
    r"\s*(?:[A-Za-z_][\w:.<>\[\]]*\s+)+([A-Za-z_]\w*)(?:\s*\[[0-9]*\])*\s*=(?!=)\s*"
)
# A row: numbers with a blank, a tab, a comma or a semicolon between two of them, not a sum of two.
_ROW = re.compile(
    rf"\s*{_NUMBER}(?:\s*[,;]\s*|\s+){_NUMBER}(?:(?:\s*[,;]\s*|\s+){_NUMBER})*[\s,;]*"
)
_SUM = re.compile(r"[^\s,;]+(?:\s+[+\-−]\S+)+\s*")
# |v| and |-2|, but not the row | 1 0 |
_BARS = re.compile(rf"\|+\s*(?:{_NUMBER}\s*\|+\s*\Z|[A-Za-zα-ω_([√])")
_OPENING = re.compile(r'\\begin\{|\\end\{|[\[({]|[\])}]|<(?=Matrix)|>|"[^"]*"|#.*')
_LATEX = re.compile(r"\\(?:begin|end)\{\w*\}")


def is_row(line: str) -> bool:
    """Recognise a row of a matrix that has no brackets; 1 -2 is a difference.

    Examples
    --------
    >>> [is_row(line) for line in ("1 0 -2", "1,5; 0", "1 -2", "3", "1 + 2")]
    [True, True, False, False, False]
    """
    return _ROW.fullmatch(line) is not None and _SUM.fullmatch(line) is None


@dataclass
class _Growing:
    """A statement while its lines come: how deep its brackets are, and if it has none."""

    lines: list[str] = field(default_factory=list)
    depth: int = 0
    length: int = 0
    is_empty: bool = True  # nothing stands behind the equals sign yet
    is_bare: bool = False
    is_framed: bool = False

    def add(self, line: str) -> None:
        content = line if self.lines else line[_given_to(line) :]
        self.lines.append(line)
        self.length += len(line) + 1
        if self.is_empty:
            self.is_framed = has_no_end(content.lstrip()) and not _is_length(content.lstrip())
            self.is_bare = self.is_framed or _is_open_row(content)
            self.is_empty = not _COMMENT.sub("", content).strip()
        self.depth = _depth_after(content, self.depth)

    @property
    def is_open(self) -> bool:
        """Whether more lines belong to it."""
        if self.length > LONGEST:
            return False
        if self.is_empty:
            return _GIVEN.match(self.lines[0]) is not None
        if self.is_bare:
            return bool(self.lines[-1].strip())
        return self.depth > 0

    def takes(self, line: str) -> bool:
        """Whether a line goes on with it; a new statement does not."""
        if self.is_empty or self.is_framed or not line.strip():
            return True
        if self.is_bare:
            return is_row(_COMMENT.sub("", line))
        return self.depth > 0 and not _begins_another(line)


def _given_to(line: str) -> int:
    """Find where the value begins that a line gives a name to; 0 where it does not."""
    given = _GIVEN.match(line)
    return given.end() if given else 0


def _is_open_row(content: str) -> bool:
    """Recognise the first row of a matrix of several lines: semicolons would part its rows."""
    bare = _COMMENT.sub("", content)
    return is_row(bare) and not (";" in bare and not re.search("[0-9],[0-9]", bare))


def _begins_another(line: str) -> bool:
    """Recognise a line that no bracket holds, so that one that was left open ends before it."""
    return _KEYWORD.match(line) is not None


def _depth_after(line: str, depth: int) -> int:
    for sign in _OPENING.findall(_LATEX.sub(_as_bracket, line)):
        if sign in ("[", "(", "{", "<"):
            depth += 1
        elif sign in ("]", ")", "}") or (sign == ">" and depth):
            depth -= 1
    return depth


def _as_bracket(latex: re.Match[str]) -> str:
    return "(" if latex[0].startswith("\\begin") else ")"


def statements(lines: Iterable[str]) -> Iterator[tuple[int, str]]:
    r"""Part lines into statements, each with the line that it begins in and the line ends inside.

    Examples
    --------
    >>> list(statements(["a = [1 2", "3 4]", "b = 1 0", "0 1", "", "# done"]))
    [(1, 'a = [1 2\n3 4]'), (3, 'b = 1 0\n0 1\n'), (6, '# done')]
    """
    held, begin = _Growing(), 1
    for place, line in enumerate(lines, 1):
        if held.lines and not (held.is_open and held.takes(line)):
            yield begin, "\n".join(held.lines)
            held, begin = _Growing(), place
        held.add(line)
    if held.lines:
        yield begin, "\n".join(held.lines)


def is_open(text: str) -> bool:
    r"""Whether what was typed goes on in the next line.

    Examples
    --------
    >>> [is_open(text) for text in ("[1 2", "[1 2]", "M =", "v = 1 2", "v = 1 2\n")]
    [True, False, True, True, False]
    """
    held = _Growing()
    for line in text.split("\n"):
        held.add(line)
    return held.is_open


def statement(whole: str) -> Statement:
    """Read what a statement asks for.

    Examples
    --------
    >>> found = statement("a = 2*3")
    >>> found.name, found.text, found.at, statement("help inverse").keyword.value
    ('a', '2*3', 4, 'help')
    >>> statement("const mat2 m = mat2(1, 2, 3, 4);").name
    'm'
    """
    given = _GIVEN.match(whole)
    if given:
        return Statement(whole, whole[given.end() :].rstrip(), given.end(), given[1])
    word = _KEYWORD.match(whole)
    if word:
        rest = _COMMENT.sub("", whole[word.end() :]).strip()
        at = word.end() if rest else word.start(1)
        return Statement(whole, rest, at, keyword=Keyword(word[1]))
    declared = _DECLARED.match(whole)
    if declared:  # with its type, where that says how its numbers are laid out
        at = 0 if is_no_list(whole.lstrip()) else declared.end()
        return Statement(whole, whole[at:].rstrip(), at, declared[1])
    text = whole.strip()
    at = whole.index(text)
    return Statement(whole, "" if text.startswith(REMARKS) else text, at)


def is_matrix(text: str) -> bool:
    """Recognise a matrix without brackets, which the grammar of expressions has no place for.

    Examples
    --------
    >>> [is_matrix(text) for text in ("1 2; 3 4", "| 1 0 |", "2 - 1", "|-2|")]
    [True, True, False, False]
    """
    is_row_first = is_row(without_comments(text.split("\n")[0]))
    return is_row_first or (is_no_list(text) and not _is_length(text))


def _is_length(text: str) -> bool:
    """Recognise bars around a value, which ask for its length."""
    return _BARS.match(text) is not None


def without_comments(text: str) -> str:
    """Leave out what stands behind a # in each line.

    Examples
    --------
    >>> without_comments("1 2 # a row")
    '1 2 '
    """
    return "\n".join(_COMMENT.sub("", line) for line in text.split("\n"))
