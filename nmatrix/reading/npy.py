"""Matrices in NumPy's own files, read without pickles; the only reader that loads NumPy."""

from __future__ import annotations

import warnings
from functools import partial
from io import BytesIO
from typing import TYPE_CHECKING

from nmatrix.enums import Layout
from nmatrix.reading.contents import unreadable
from nmatrix.reading.literal import MatrixLiteral, literal_from_tokens
from nmatrix.report import LARGEST_MATRIX

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import NDArray

MAGIC = b"\x93NUMPY"
ENDINGS = (".npy", ".npz")
LARGEST = 4096  # bytes of a header and 64 numbers, and room to spare

_unreadable = partial(unreadable, next_step="save a matrix of floats with np.save")


def npy_literal(content: bytes, layout: Layout | None, source: str) -> MatrixLiteral:
    """Read the array of a .npy file as a matrix, every float exact.

    Raises
    ------
    IllegalValueError
        If the file is damaged, or holds something other than up to 64 finite numbers.
    """
    array = _array(content, source)
    if array.dtype.kind not in "fiu" or array.dtype.itemsize > 8:
        raise _unreadable(source, f"its entries are {array.dtype}, not numbers")
    if array.ndim not in (1, 2) or array.size > LARGEST_MATRIX**2:
        raise _unreadable(source, f"its shape is {array.shape}")
    rows = array.reshape(1, -1) if array.ndim == 1 else array
    return literal_from_tokens(
        [[repr(entry) for entry in row] for row in rows.tolist()],
        layout or Layout.ROW_MAJOR,
        source,
        exact=True,
    )


def _array(content: bytes, source: str) -> NDArray[np.generic]:
    import numpy as np

    if not content.startswith(MAGIC):
        raise _unreadable(source, "it does not begin as a .npy file does")
    if len(content) > LARGEST:
        raise _unreadable(source, f"{len(content)} bytes are more than a matrix takes")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            loaded: NDArray[np.generic] = np.load(BytesIO(content), allow_pickle=False)
    except Exception:  # a damaged header raises whatever Python's own parser raises
        raise _unreadable(source, "it is damaged, or holds Python objects") from None
    return loaded
