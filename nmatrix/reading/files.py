"""The text of a file that may hold a matrix: decoded, bounded, and never a traceback."""

from __future__ import annotations

import codecs
from pathlib import Path

from nmatrix.errors import IllegalValueError, quoted, refusal

LARGEST = 16_000_000  # bytes

_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)


def existing_file(text: str) -> Path | None:
    """Find the file that a text names; None if there is none, or a folder.

    Pipes and devices count as files, for the sake of a shell's `<(…)`.

    Examples
    --------
    >>> existing_file("1 0 0; 0 1 0; 0 0 1") is None
    True
    """
    path = Path(text)
    try:
        return path if path.exists() and not path.is_dir() else None
    except (OSError, ValueError):  # a name too long, or with a NUL: no file has it
        return None


def is_folder(text: str) -> bool:
    """Recognise the path of a folder.

    Examples
    --------
    >>> is_folder("."), is_folder("1 0; 0 1")
    (True, False)
    """
    try:
        return bool(text) and Path(text).is_dir()
    except (OSError, ValueError):
        return False


def file_bytes(path: Path) -> bytes:
    """Read a file that is small enough to be a matrix or a report.

    Raises
    ------
    IllegalValueError
        If the file cannot be read, or is larger than any report.
    """
    name = f"file ({quoted(str(path))})"
    try:
        with path.open("rb") as stream:
            content = stream.read(LARGEST + 1)
    except OSError as error:
        raise IllegalValueError(name, refusal(error), "check the path") from None
    if len(content) > LARGEST:
        raise IllegalValueError(name, f"it is larger than {LARGEST} bytes", "cut it down")
    return content


def decoded(content: bytes, source: str) -> str:
    """Decode bytes: UTF-8, or UTF-16 where a byte order mark says so.

    Raises
    ------
    IllegalValueError
        If the bytes are neither.

    Examples
    --------
    >>> decoded(b"1 0; 0 1", "x"), decoded("1 0".encode("utf-16"), "x")
    ('1 0; 0 1', '1 0')
    """
    encoding = next((name for mark, name in _MARKS if content.startswith(mark)), "utf-8")
    try:
        return content.decode(encoding)
    except UnicodeDecodeError:
        raise IllegalValueError(
            f"text ({source})", f"it is not {encoding}", "save it as UTF-8"
        ) from None
