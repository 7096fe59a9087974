"""The errors of nmatrix: what was wrong, why, and what to do next.

The tree::

    NMatrixError
    ├── CheckFailedError      exit 1   a check or a guarantee failed
    ├── IllegalValueError     exit 2   an illegal value, a contradiction, a bad file
    │   └── FrameError        exit 2   two frames that do not meet
    ├── NoAnswerError         exit 3   legal values for which no answer exists
    └── MissingPackageError   exit 4   an optional package is not installed
"""

from __future__ import annotations

import errno
import re
from collections.abc import Callable, Iterable
from typing import ClassVar

_OPEN, _CLOSE = "\ufdd0", "\ufdd1"  # noncharacters: no text from outside holds them
_UNPRINTABLE = re.compile(r"[\x00-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff]")
_NAME = re.compile(f"{_OPEN}(\\w+){_CLOSE}")


def quantity(name: str) -> str:
    """Mark the name of a quantity in an error or a remark, so that its caller can spell it."""
    return f"{_OPEN}{name}{_CLOSE}"


def spelled(text: str, spell: Callable[[str], str]) -> str:
    """Spell the names of quantities that are marked in a text.

    Examples
    --------
    >>> spelled(f"try {quantity('near')} 0.1", lambda name: f"--{name}")
    'try --near 0.1'
    """
    return _NAME.sub(lambda one: spell(one[1]), text)


OF_THE_SCENE = "with the numbers of the scene"  # a shell puts in what was typed
LONGEST_TYPED = 40  # characters of a word that are compared
SHORT = 4  # letters of a word
PER_SLIP = 4  # letters of a word to one slip


def did_you_mean(
    word: str, known: Iterable[str], otherwise: str, spell: Callable[[str], str] | None = None
) -> str:
    """Ask for the known word that was probably meant, as `spell` writes it, or name another step.

    A slip is a letter too many, too few or another, or two exchanged; a word of three letters has
    one, a longer one more for each further four, and it may be cut short where only one word begins
    so. Others are no guesses, nor is a short word that begins with another letter.

    Examples
    --------
    >>> did_you_mean("wrold", ["view", "world"], "see the list")
    'did you mean world?'
    >>> did_you_mean("--open", ["--space", "--object"], "see the list")
    'see the list'
    """
    typed = word[:LONGEST_TYPED].lstrip("-").casefold()
    near: list[tuple[int, str]] = []
    begun: list[str] = []
    for one in known:
        name = one.lstrip("-").casefold()
        rhymes = typed != name and len(typed) <= SHORT and typed[1:] == name[1:]  # host, cost
        if abs(len(name) - len(typed)) <= (len(typed) + 1) // PER_SLIP and not rhymes:
            near.append((slips(typed, name), one))
        if len(typed) >= 2 and name.startswith(typed):
            begun.append(one)
    slipped, best = min(near, default=(0, ""), key=lambda one: one[0])
    if best and slipped <= (len(typed) + 1) // PER_SLIP:
        return f"did you mean {(spell or printable)(best)}?"
    return f"did you mean {(spell or printable)(begun[0])}?" if len(begun) == 1 else otherwise


def slips(typed: str, meant: str) -> int:
    """Count the slips that make one word of another.

    Examples
    --------
    >>> slips("sacle", "scale"), slips("colour", "color"), slips("dark", "dask")
    (1, 1, 1)
    """
    before: list[int] = []
    row = list(range(len(meant) + 1))
    for i, letter in enumerate(typed, 1):
        earlier, before, row = before, row, [i]
        for j, other in enumerate(meant, 1):
            least = min(before[j] + 1, row[-1] + 1, before[j - 1] + (letter != other))
            if i > 1 and j > 1 and letter == meant[j - 2] and typed[i - 2] == other:
                least = min(least, earlier[j - 2] + 1)
            row.append(least)
    return row[-1]


_REFUSALS = {
    errno.ENOENT: "there is no such file or folder",
    errno.EISDIR: "it is a folder",
    errno.ENOTDIR: "a part of its path is a file and not a folder",
    errno.ENAMETOOLONG: "its name is too long",
    errno.EACCES: "its permissions do not allow it",
    errno.EPERM: "its permissions do not allow it",
    errno.EROFS: "it is on a disk that can only be read",
    errno.ENOSPC: "no space is left there",
    errno.EFBIG: "no file may be so large there",
}


def refusal(error: OSError) -> str:
    """Tell in a sentence why the file system refused.

    Examples
    --------
    >>> refusal(IsADirectoryError(errno.EISDIR, "Is a directory"))
    'it is a folder'
    """
    told = _REFUSALS.get(error.errno or 0)
    return told or f"the system refuses it ({error.strerror or type(error).__name__})"


def shortlist(names: Iterable[str], most: int = 8) -> str:
    """List names in one line, of many only the first.

    Examples
    --------
    >>> shortlist(["sun", "lamp", "moon"], 2)
    'sun, lamp, …'
    """
    listed = list(names)
    return ", ".join(listed if len(listed) <= most else [*listed[:most], "…"])


def counted(count: int, noun: str, plural: str = "") -> str:
    """Count things in words; the plural ends in s unless it is given.

    Examples
    --------
    >>> counted(1, "byte"), counted(0, "byte"), counted(1200, "vertex", "vertices")
    ('1 byte', '0 bytes', '1,200 vertices')
    """
    return f"{count:,} {noun if count == 1 else plural or noun + 's'}"


class NMatrixError(Exception):
    """An error that a person can act on, in one line.

    How the name of a quantity is typed is the caller's business: Python has parameters, the shell
    has options. So the core marks names by `quantity`, and whoever shows the error spells them.

    Parameters
    ----------
    what
        What was wrong, with the value in parentheses.
    why
        The rule that it breaks, with numbers.
    next_step
        What to do instead.

    Examples
    --------
    >>> next_step = f"try {quantity('near')} 0.1"
    >>> error = NMatrixError("near (0)", "it must be positive", next_step)
    >>> print(error)
    near (0): it must be positive; try near 0.1
    >>> print(error.spelled(lambda name: f"--{name}"))
    near (0): it must be positive; try --near 0.1
    """

    exit_code: ClassVar[int] = 70

    def __init__(self, what: str, why: str = "", next_step: str = "") -> None:
        self.parts = (what, why, next_step)
        super().__init__(self.spelled(str))

    def __reduce__(self) -> tuple[object, ...]:
        """Go to another process whole, whatever a subclass is made of."""
        return _restored, (type(self), self.args, self.__dict__)

    def spelled(self, spell: Callable[[str], str]) -> str:
        """Return one line, with the name of every quantity as `spell` types it."""
        what, *others = (spelled(part, spell) for part in self.parts)
        reason = "; ".join(part for part in others if part)
        line = ": ".join(part for part in (what, reason) if part)
        return (
            line if line.isprintable() else _UNPRINTABLE.sub(lambda one: repr(one[0])[1:-1], line)
        )


def _restored(kind: type[NMatrixError], args: tuple[object, ...], state: object) -> NMatrixError:
    """Make an error again in another process."""
    found = kind.__new__(kind, *args)
    found.__setstate__(state)  # type: ignore[arg-type]  # its dict
    return found


class CheckFailedError(NMatrixError):
    """A check or a guarantee did not hold."""

    exit_code = 1


class IllegalValueError(NMatrixError, ValueError):
    """A value that is illegal by itself, a contradiction, or a file that cannot be used."""

    exit_code = 2


class FrameError(IllegalValueError):
    """Two transforms whose frames do not meet."""


class NoAnswerError(NMatrixError, ArithmeticError):
    """Legal values for which the question has no answer."""

    exit_code = 3


class MissingPackageError(NMatrixError, ImportError):
    """An optional package is missing; the message holds the command that installs it."""

    exit_code = 4


def defect(error: Exception) -> str:
    """Tell of an error that no value should cause.

    Examples
    --------
    >>> defect(KeyError("a"))
    "a defect of nmatrix (KeyError: 'a'): it should not happen"
    """
    return f"a defect of nmatrix ({type(error).__name__}: {error}): it should not happen"


def placed(error: NMatrixError, place: str) -> NMatrixError:
    """Make an error of the same kind that says first where it happened.

    Examples
    --------
    >>> print(placed(NoAnswerError("1/0", "nothing is divided by 0"), "line 3"))
    line 3: 1/0: nothing is divided by 0
    """
    kinds = (IllegalValueError, NoAnswerError, CheckFailedError, MissingPackageError)
    kind = next((one for one in kinds if isinstance(error, one)), NMatrixError)
    what, *others = error.parts
    return kind(f"{place}: {what}", *others)


LONGEST_QUOTE = 40  # characters
LONGEST_NAME = 60


def quoted(text: str) -> str:
    r"""Put the beginning of a text in quotes for a one-line message, whatever it holds.

    Examples
    --------
    >>> quoted("1 0\n0"), quoted("x" * 60)[-5:]
    ("'1 0\\n0'", "xxx'…")
    """
    shown = repr(text[:LONGEST_QUOTE])
    safe = shown.encode("utf-8", "backslashreplace").decode()
    return safe if len(text) <= LONGEST_QUOTE else f"{safe}…"


def printable(name: str) -> str:
    """Leave a name as it is, but quote it where it would break the line."""
    return name if name.isprintable() and len(name) <= LONGEST_NAME else quoted(name)
