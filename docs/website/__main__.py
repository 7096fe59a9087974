"""Build the documentation as a site: `python docs/website -o FOLDER`.

The folder needs no network, neither to be built nor to be read. With Pyodide (`--pyodide`, or npm's
package in node_modules) the program itself runs in it, under try/.
"""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
from pathlib import Path

from sources import DOCS, lay
from sphinx.cmd.build import main as sphinx

HERE = Path(__file__).resolve().parent
USUAL = "build/site"
PYODIDE = "node_modules/pyodide"


def build(target: Path, pyodide: Path | None) -> int:
    """Build the site into a folder; give Sphinx's exit code."""
    if pyodide is not None:
        os.environ["NMATRIX_PYODIDE"] = str(pyodide.resolve())  # for the examples of web
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        lay(folder / "docs", has_web=pyodide is not None)
        shutil.copytree(DOCS / "samples", folder / "docs" / "extra" / "samples")
        shutil.copytree(HERE / "static", folder / "docs" / "static")
        shutil.copy(HERE / "conf.py", folder / "docs")
        shutil.rmtree(target, ignore_errors=True)
        strict = ["--fail-on-warning", "--keep-going", "--quiet", "-d", str(folder / "trees")]
        code = sphinx([*strict, str(folder / "docs"), str(target)])
    (target / ".buildinfo").unlink(missing_ok=True)
    (target / "objects.inv").unlink(missing_ok=True)
    if code == 0 and pyodide is not None:
        from nmatrix.cli.app import run

        code = run(["web", "-o", str(target / "try"), "--pyodide", str(pyodide)])
    return code


def main() -> int:
    """Read the command line and build."""
    parser = argparse.ArgumentParser(prog="python docs/website", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, default=Path(USUAL), metavar="FOLDER")
    parser.add_argument("--pyodide", type=Path, metavar="FOLDER", help="npm's package pyodide")
    asked = parser.parse_args()
    usual = Path(os.environ.get("NMATRIX_PYODIDE", PYODIDE))
    pyodide = asked.pyodide or (usual if usual.is_dir() else None)
    return build(asked.output, pyodide)


if __name__ == "__main__":
    sys.exit(main())
