"""One command line between pipes, in an empty folder: what a shell does for a program.

The bytes are those of a pipe: UTF-8, no terminal, the usual width.
"""

from __future__ import annotations

import io
import shlex
import sys
import tempfile
from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import chdir, contextmanager
from dataclasses import dataclass
from pathlib import Path

from nmatrix.errors import IllegalValueError, printable, refusal

STANDARD_INPUT = "-"

Written = dict[str, str | None]  # the name of a file, and its text, or else its bytes in Base64


@dataclass(frozen=True)
class Told:
    """What a command line came to: its exit code, both outputs, and the files that it wrote."""

    code: int
    out: str
    err: str
    files: list[Written]


def run_between_pipes(
    run: Callable[[Sequence[str]], int], words: Sequence[str], given: Mapping[str, str]
) -> Told:
    r"""Run a command line beside the given files; the one called `-` is standard input.

    Examples
    --------
    >>> def shout(words):
    ...     print(*words, input().upper())
    ...     return 3
    >>> run_between_pipes(shout, ["hear"], {"-": "a b"})
    Told(code=3, out='hear A B\n', err='', files=[])
    """
    with (
        tempfile.TemporaryDirectory() as folder,
        chdir(folder),
        _piped(given.get(STANDARD_INPUT, "")) as (out, err),
    ):
        for name, text in given.items():
            if name != STANDARD_INPUT:
                _lay(name, text)
        code = run(words)
        sys.stdout.flush()
        sys.stderr.flush()
        written = [one for one in _written(Path()) if given.get(str(one["name"])) != one["text"]]
        return Told(code, _text(out), _text(err), written)


def split_line(words: str | Sequence[str]) -> list[str]:
    """Part a line as a shell does, and leave out the program's name.

    Examples
    --------
    >>> split_line("nmatrix normal '1 0; 0 1'")
    ['normal', '1 0; 0 1']
    """
    if not isinstance(words, str):
        return list(words)
    try:
        found = shlex.split(words.strip())
    except ValueError:
        raise IllegalValueError(
            "command line", "a quotation mark is opened and not closed", "close it"
        ) from None
    return found[1:] if found[:1] == ["nmatrix"] else found


@contextmanager
def _piped(given: str) -> Iterator[tuple[io.BytesIO, io.BytesIO]]:
    """Put pipes in the place of the three standard streams, as a shell does."""
    out, err = io.BytesIO(), io.BytesIO()
    before = sys.stdin, sys.stdout, sys.stderr
    sys.stdin = io.TextIOWrapper(io.BytesIO(given.encode("utf-8", "surrogatepass")), "utf-8")
    sys.stdout = io.TextIOWrapper(out, "utf-8", newline="\n")
    sys.stderr = io.TextIOWrapper(err, "utf-8", "backslashreplace", newline="\n")
    try:
        yield out, err
    finally:
        sys.stdin, sys.stdout, sys.stderr = before


def _text(stream: io.BytesIO) -> str:
    return stream.getvalue().decode("utf-8", "backslashreplace")


def _written(folder: Path) -> Iterator[Written]:
    """Read the files that a command wrote: text where they are, else Base64."""
    for path in sorted(one for one in folder.rglob("*") if one.is_file()):
        content = path.read_bytes()
        try:
            yield {"name": str(path), "text": content.decode("utf-8"), "base64": None}
        except UnicodeDecodeError:
            yield {"name": str(path), "text": None, "base64": b64encode(content).decode()}


def _lay(name: str, text: str) -> None:
    """Lay a file into the folder in which a command runs."""
    path, told = Path(name), f"file ({printable(name)})"
    if len(path.parts) != 1 or path.name in ("", ".", "..") or not name.isprintable():
        raise IllegalValueError(told, "it is no name", "give it a name")
    try:
        path.write_text(text, encoding="utf-8", newline="")
    except OSError as error:
        raise IllegalValueError(told, refusal(error), "give it another name") from None
