"""The packages that nmatrix asks for beside itself, and the command that installs a missing one.

Their ranges stand in `pyproject.toml` alone: a checkout reads them there, an installed package or
a zip file in the metadata that were made of it.
"""

from __future__ import annotations

import re
import shlex
import sys
import tomllib
from collections.abc import Iterable, Sequence
from functools import cache
from importlib.metadata import PackageNotFoundError, requires
from pathlib import Path

from nmatrix.errors import MissingPackageError

PROJECT = Path(__file__).parents[1] / "pyproject.toml"
# Other packages are called as their modules are.
PACKAGES = {"PIL": "pillow", "flint": "python-flint"}
_NAME = re.compile(r"[\w.-]+\w|\w")


def missing(what: str, *modules: str, otherwise: str = "") -> MissingPackageError:
    """Refuse what needs a package that is not installed, with the command that installs it.

    Parameters
    ----------
    what
        What was asked for.
    modules
        What it imports, by the names of the modules.
    otherwise
        What to do instead of installing them.

    Examples
    --------
    >>> missing("a walk", "boots", otherwise="take the bus").parts[1]
    'it needs the package boots, which is not installed'
    >>> str(missing("a walk", "boots", "hat")).partition(";")[0]
    'a walk: it needs the packages boots and hat, and not all are installed'
    """
    if sys.platform == "emscripten":
        return _missing_in_browser(what, modules, otherwise)
    *others, last = (_NAME.findall(requirement_of(one))[0] for one in modules)
    why = (
        f"it needs the packages {', '.join(others)} and {last}, and not all are installed"
        if others
        else f"it needs the package {last}, which is not installed"
    )
    command = install_command(*modules)
    return MissingPackageError(what, why, f"{command}, or {otherwise}" if otherwise else command)


def _missing_in_browser(what: str, modules: Sequence[str], otherwise: str) -> MissingPackageError:
    """Refuse it in a browser, where nothing can be installed."""
    names = ", ".join(map(package_of, modules))
    steps = ("run it in a terminal, where nmatrix is installed", otherwise)
    step = ", or ".join(one for one in steps if one)
    return MissingPackageError(what, f"it needs {names}, which this page does not bring", step)


def missing_part(error: Exception, what: str) -> MissingPackageError | None:
    """Explain an import that failed, if a package that nmatrix asks for is absent.

    Few commands need every package, so each is imported where it is used, and what was asked for
    ends there. What is not here for another reason is a defect, and no part is missing.

    Examples
    --------
    >>> print(missing_part(ModuleNotFoundError("No module named 'boots'", name="boots"), "a walk"))
    None
    """
    name = error.name if isinstance(error, ModuleNotFoundError) else None
    return missing(what, name) if name is not None and is_required(name) else None


def install_command(*modules: str) -> str:
    """Write the command that installs the packages of some modules, in the range that is tried.

    A program that pipx or uv installed has its packages beside it, where pip does not reach.

    Examples
    --------
    >>> install_command("boots", "PIL").replace("'pillow>=11'", "pillow")
    'pip install boots pillow'
    """
    quote = '"' if sys.platform == "win32" else "'"
    wanted = (requirement_of(one) for one in modules)
    words = (f"{quote}{one}{quote}" if set(one) & set("<>=~!;") else one for one in wanted)
    return " ".join([_installer(), *words])


def _installer() -> str:
    prefix = Path(sys.prefix)
    if (prefix / "pipx_metadata.json").is_file():
        return "pipx inject nmatrix"
    if (prefix / "uv-receipt.toml").is_file():
        return f"uv pip install --python {shlex.quote(str(prefix))}"
    return "pip install"


def requirement_of(module: str) -> str:
    """Find the package of a module and the versions that nmatrix asks for, or its bare name."""
    package = package_of(module)
    return _ranges().get(package, package)


def is_required(module: str) -> bool:
    """Find out if nmatrix asks for the package of a module, always or for an extra.

    Examples
    --------
    >>> is_required("boots")
    False
    """
    return package_of(module) in _ranges()


def package_of(module: str) -> str:
    """Name the package that brings a module, as an index spells it.

    Examples
    --------
    >>> package_of("tree_sitter_glsl"), package_of("PIL.Image"), package_of("DracoPy")
    ('tree-sitter-glsl', 'pillow', 'dracopy')
    """
    top = module.partition(".")[0]
    return PACKAGES.get(top, top.replace("_", "-").lower())


@cache
def _ranges() -> dict[str, str]:
    """Read the requirements of nmatrix and of its extras, by package."""
    return dict(map(read_requirement, listed()))


def listed() -> Iterable[str]:
    """List the requirements as the metadata of a package do, those of extras behind a marker."""
    if PROJECT.is_file():  # an editable installation keeps the metadata of the day it was made
        project = tomllib.loads(PROJECT.read_text("utf-8"))["project"]
        extras = project["optional-dependencies"].items()
        marked = (f"{one}; extra == '{extra}'" for extra, wanted in extras for one in wanted)
        return [*project["dependencies"], *marked]
    try:
        return requires("nmatrix") or ()
    except PackageNotFoundError:  # the files of the package alone
        return ()


def read_requirement(line: str) -> tuple[str, str]:
    """Read a line of package metadata: the package, and it with its range, lower bound first.

    Examples
    --------
    >>> read_requirement("typst<0.17,>=0.15; extra == 'pdf'")
    ('typst', 'typst>=0.15,<0.17')
    """
    wanted = line.partition(";")[0].replace(" ", "").replace("(", "").replace(")", "")
    found = _NAME.match(wanted)
    assert found is not None  # metadata are well formed
    bounds = sorted(wanted[found.end() :].split(","), reverse=True)
    return found[0], found[0] + ",".join(bounds)
