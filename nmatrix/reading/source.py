"""The matrix of a MATRIX argument: out of stdin, a file, or the argument itself.

An existing file comes first, `-` is stdin, and `#KEY` behind either chooses one of its matrices.
"""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, quoted
from nmatrix.reading import npy
from nmatrix.reading.files import decoded, existing_file, file_bytes, is_folder
from nmatrix.reading.literal import MatrixLiteral
from nmatrix.reading.matrix import matrix_literal

MARKS_OF_A_LITERAL = "[({;,"


def matrix_source(
    text: str,
    stdin_text: Callable[[], str],
    layout: Layout | None = None,
) -> MatrixLiteral:
    """Read the matrix that a MATRIX argument stands for.

    `stdin_text` is called only for `-` or `-#KEY`.

    Raises
    ------
    IllegalValueError
        If there is no such file, or no matrix in what there is.

    Examples
    --------
    >>> matrix_source("-#value", lambda: '{"value": [[1, 0], [0, 1]]}').rows
    ((1.0, 0.0), (0.0, 1.0))
    """
    if text == "-" or text.startswith("-#"):
        return matrix_literal(stdin_text(), layout, text[2:] or None, "stdin")
    path = existing_file(text)
    if path is not None:
        return _from_file(path, None, layout)
    name, mark, key = text.rpartition("#")
    keyed = existing_file(name) if mark and name else None
    if keyed is not None:
        return _from_file(keyed, key or None, layout)
    if any(one.isspace() or one in MARKS_OF_A_LITERAL for one in text):
        return matrix_literal(text, layout)
    raise IllegalValueError(
        f"matrix ({quoted(text)})",
        "it is a folder" if is_folder(text) else "there is no such file",
        'write a matrix like "1 0 0; 0 2 0; 0 0 1", a file, or - for stdin',
    )


def _from_file(path: Path, key: str | None, layout: Layout | None) -> MatrixLiteral:
    content = file_bytes(path)
    source = quoted(str(path))
    if content.startswith(npy.MAGIC) or path.suffix.lower() in npy.ENDINGS:
        if key is not None:
            raise IllegalValueError(
                f"key ({quoted(key)})", f"{source} holds one array without a name", "drop the key"
            )
        return npy.npy_literal(content, layout, source)
    return matrix_literal(decoded(content, source), layout, key, source)
