"""nmatrix: the matrices of computer graphics, exact and explained.

The package's face is lazy: `import nmatrix` loads neither NumPy nor SymPy; a name is fetched
from `nmatrix.api` or `nmatrix.enums` when it is first used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING

from nmatrix.version import __version__

if TYPE_CHECKING:
    from nmatrix.api import *  # noqa: F403 - the same names that __getattr__ finds

__all__ = ["__version__"]


def __getattr__(name: str) -> object:
    if not name.startswith("_"):
        api = import_module("nmatrix.api")
        if name in api.__all__:
            return getattr(api, name)
    raise AttributeError(f"module 'nmatrix' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted([*import_module("nmatrix.api").__all__, *__all__])
