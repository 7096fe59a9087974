"""The folder that `nmatrix web` writes, served below a path that is not the root."""

from __future__ import annotations

import functools
import http.server
import os
import threading
from collections.abc import Iterator
from pathlib import Path

import pytest

from nmatrix.cli.explore import first_look
from nmatrix.output.explorer.page import page
from nmatrix.scene.setup import Setup
from nmatrix.web.folder import folder, write

CHECKOUT = Path(__file__).resolve().parents[2]
BELOW = "some/where"  # the folder works below any path


def pyodide_folder() -> Path:
    """Find npm's package: NMATRIX_PYODIDE, or node_modules of the checkout."""
    given = os.environ.get("NMATRIX_PYODIDE")
    found = Path(given) if given else CHECKOUT / "node_modules" / "pyodide"
    if not (found / "pyodide.asm.wasm").is_file():
        pytest.skip(
            "Pyodide is not here: npm install pyodide, or set NMATRIX_PYODIDE to its folder"
        )
    return found


@pytest.fixture(scope="session")
def content() -> dict[str, bytes]:
    """Every file of the folder."""
    return folder(pyodide_folder(), lambda: page(first_look(Setup()), fits=True))


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A server of files that writes no log."""

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="session")
def served() -> Iterator:
    """Serve a folder on the loopback, and return the address."""
    running = []

    def serve(root: Path) -> str:
        handler = functools.partial(Quiet, directory=str(root))
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        running.append(server)
        return f"http://127.0.0.1:{server.server_port}/"

    yield serve
    for server in running:
        server.shutdown()
        server.server_close()


ASK = """async ([name, asked]) => {
  const {ask} = await import('./engine.js');
  try { return await ask(name, asked); } catch (error) { return {refused: error.message}; }
}"""


@pytest.fixture
def opened(browser, content, served, tmp_path) -> Iterator:
    """Open the folder in a fresh context; the page notes each request and has `ask`."""
    contexts = []

    def open_(changed: dict[str, bytes | None] | None = None, before: str = "", name: str = ""):
        root = tmp_path / f"root{len(contexts)}"
        site = root / BELOW
        files = {**content, **(changed or {})}
        write(site, {key: one for key, one in files.items() if one is not None}, force=False)
        context = browser.new_context()
        contexts.append(context)
        found = context.new_page()
        found.requested = []
        context.on("request", lambda request: found.requested.append(request.url))
        if before:
            context.add_init_script(before)
        found.address = f"{served(root)}{BELOW}/"
        found.goto(found.address + name)
        found.ask = lambda name, **asked: found.evaluate(ASK, [name, asked])
        return found

    yield open_
    for context in contexts:
        context.close()
