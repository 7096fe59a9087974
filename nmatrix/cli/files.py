"""Files that are written whole or not at all, and never over another one by accident."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path

from nmatrix.errors import IllegalValueError


def write_file(path: Path, content: bytes, *, force: bool) -> None:
    """Write a file under a temporary name beside its place, then rename it.

    Raises
    ------
    IllegalValueError
        If the file exists and `force` is not given, or the place cannot be written.
    """
    if path.exists() and not force:
        raise IllegalValueError(
            f"{path}", "the file exists", "use --force, or -o with another name"
        )
    try:
        descriptor, temporary = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
        try:
            with os.fdopen(descriptor, "wb") as file:
                file.write(content)
            Path(temporary).chmod(0o644)
            Path(temporary).replace(path)
        except BaseException:
            Path(temporary).unlink(missing_ok=True)
            raise
    except OSError as error:
        raise IllegalValueError(
            f"{path}", f"it cannot be written ({error.strerror})", "choose another folder with -o"
        ) from None
