"""nmatrix: the matrices of computer graphics, exact and explained.

The package's face is lazy: `import nmatrix` loads neither NumPy nor SymPy; a name is fetched
from `nmatrix.api` or `nmatrix.enums` when it is first used.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.api import *  # noqa: F403 - the same names that __getattr__ finds

__all__ = ["__version__"]


def __getattr__(name: str) -> object:
    if name.startswith("_"):
        raise AttributeError(f"module 'nmatrix' has no attribute {name!r}")
    from nmatrix import api

    if name in api.__all__:
        return getattr(api, name)
    raise AttributeError(f"module 'nmatrix' has no attribute {name!r}")


def __dir__() -> list[str]:
    from nmatrix import api

    return sorted([*api.__all__, *__all__])
