"""What a reader waits for in a browser: Python alone, the first answer, and those after it.

    NMATRIX_PYODIDE=… PYTHONPATH=. python tests/benchmarks/web.py [ROUNDS]

Loads of Pyodide alone, loads of the folder up to its first answer, and loads of a terminal's
program take turns in one run, so that a busy machine slows all of them alike; medians are told.
"""

from __future__ import annotations

import functools
import http.server
import json
import os
import subprocess
import sys
import tempfile
import threading
from pathlib import Path
from statistics import median

from nmatrix.output.explorer.page import page as explorer
from nmatrix.output.explorer.sliders import first_look
from nmatrix.scene.setup import Setup
from nmatrix.web.folder import folder, write

ROOT = Path(__file__).resolve().parents[2]
LINES = (
    ["world", "--scale", "1", "2", "1", "--rotate", "10", "20", "30"],
    ["calc", "inverse([2 1 0; 1 3 1; 0 1 4])", "--steps"],
    ["identify", "1.2990 0 0 0; 0 1.7320 0 0; 0 0 -1.0020 -0.2002; 0 0 -1 0"],
    ["check", "normal", "1 0 0; 0 2 0; 0 0 1", "--scale", "1", "2", "1"],
    ["check", "exercise", "2", "1 0 0; 0 2 0; 0 0 4", "--seed", "7", "--student", "Ada"],
    ["space", "object", "--scale", "1", "2", "1"],
)
ALONE = b"""
const {loadPyodide} = await import("./pyodide.mjs");
const python = await loadPyodide({indexURL: new URL(".", self.location).href});
self.postMessage(python.runPython("1 + 1"));
"""
BARE = """() => new Promise((resolve) => {
  const begin = performance.now();
  const worker = new Worker("alone.js", {type: "module"});
  worker.onmessage = () => { worker.terminate(); resolve(performance.now() - begin); };
})"""
FIRST = """async (words) => {
  const begin = performance.now();
  const {ask} = await import('./engine.js');
  await ask("shown", {words});
  return performance.now() - begin;
}"""
LATER = """async (words) => {
  const {ask} = await import('./engine.js');
  await ask("shown", {words});
  const begin = performance.now();
  await ask("shown", {words});
  return performance.now() - begin;
}"""
WARM = """
import contextlib, io, json, sys, time
from nmatrix.cli.app import run
words = json.loads(sys.argv[1])
for _ in range(2):
    begin = time.perf_counter()
    with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()):
        run(words)
print(1000 * (time.perf_counter() - begin))
"""


class Quiet(http.server.SimpleHTTPRequestHandler):
    """A server of files that writes no log."""

    def log_message(self, *_: object) -> None:
        pass


def warm(words: list[str]) -> float:
    done = subprocess.run(
        [sys.executable, "-c", WARM, json.dumps(words)], capture_output=True, text=True, check=True
    )
    return float(done.stdout)


def main() -> None:
    from playwright.sync_api import sync_playwright  # an extra: tests collect this file without it

    rounds = int(sys.argv[1]) if len(sys.argv) > 1 else 5
    pyodide = Path(os.environ.get("NMATRIX_PYODIDE") or ROOT / "node_modules" / "pyodide")
    with tempfile.TemporaryDirectory() as place, sync_playwright() as running:
        content = folder(pyodide, lambda: explorer(first_look(Setup()), fits=True))
        write(Path(place), {**content, "alone.js": ALONE}, force=True)
        print(f"{sum(map(len, content.values())) / 1e6:.2f} MB in {len(content)} files")
        handler = functools.partial(Quiet, directory=place)
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/"
        browser = running.chromium.launch(
            executable_path=os.environ.get("CHROMIUM", "/usr/bin/chromium"), args=["--no-sandbox"]
        )
        alone, first = [], []
        later: dict[str, list[float]] = {line[0] + " " + line[1][:12]: [] for line in LINES}
        terminal: dict[str, list[float]] = {name: [] for name in later}
        for _ in range(rounds):
            opened = browser.new_context().new_page()
            opened.goto(address)
            alone.append(opened.evaluate(BARE))
            opened.context.close()
            opened = browser.new_context().new_page()
            opened.goto(address)
            first.append(opened.evaluate(FIRST, LINES[0]))
            for name, words in zip(later, LINES, strict=True):
                later[name].append(opened.evaluate(LATER, words))
                terminal[name].append(warm(words))
            opened.context.close()
        browser.close()
        server.shutdown()
    print(f"Pyodide alone  {median(alone):6.0f} ms")
    print(f"first answer   {median(first):6.0f} ms  {median(first) / median(alone):.2f} times that")
    for name, times in later.items():
        here, there = median(times), median(terminal[name])
        print(f"{name:24} {here:6.1f} ms  terminal {there:6.1f} ms, warm")


if __name__ == "__main__":
    main()
