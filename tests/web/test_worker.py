"""Whatever is missing, damaged, too much or too slow is a sentence, and the page goes on."""

from __future__ import annotations

import json

import pytest

pytestmark = pytest.mark.slow

WAITED = """async () => {
  const {progress, start} = await import('./engine.js');
  start();
  return new Promise((resolve) => progress((told) => {
    if (told.failed || told.ready) resolve(told);
  }));
}"""
LONG = ["handout", "--to", "moodle", "--variants", "1000", "-o", "bank.xml"]
LATER = """async ([name, asked]) => {
  const {ask} = await import('./engine.js');
  globalThis.later = ask(name, asked).then((one) => one, (error) => ({refused: error.message}));
}"""
STATES = """async () => {
  const {progress} = await import('./engine.js');
  globalThis.states = [];
  progress((told) => states.push(told));
}"""
# Asked for these words, the worker ends as Python does without memory, or says nothing any more.
BROKEN = """  const words = JSON.stringify(asked);
  if (words.includes("let Python die")) { tell({id, died: true}); return; }
  if (words.includes("let the worker throw")) setTimeout(() => { throw new Error("gone"); });
  if (words.includes("let the worker throw") || words.includes("let it hang")) return;
  try {
    tell({id, answer"""


def is_a_sentence(text: str) -> bool:
    told = ("Error", "undefined", "null", "[object", "Traceback", "\n")
    return 20 < len(text) < 250 and not any(word in text for word in told)


@pytest.mark.parametrize(
    "name",
    [
        "folder.json",
        "nmatrix.zip",
        "pyodide.mjs",
        "pyodide.asm.mjs",
        "pyodide.asm.wasm",
        "python_stdlib.zip",
        "pyodide-lock.json",
        "worker.js",
    ],
)
def test_a_file_that_is_missing_is_named(opened, name: str) -> None:
    page = opened({name: None})
    told = page.evaluate(WAITED)["failed"]
    assert is_a_sentence(told)
    assert name in told or name == "pyodide.asm.mjs"
    assert page.ask("command", words="world")["refused"] == told


@pytest.mark.parametrize("how", ["cut", "changed"])
@pytest.mark.parametrize("name", ["nmatrix.zip", "pyodide.asm.wasm", "folder.json"])
def test_a_file_that_is_damaged_is_named(opened, content, name: str, how: str) -> None:
    whole = content[name]
    half = len(whole) // 2
    damaged = whole[:half] if how == "cut" else whole[:half] + bytes(len(whole) - half)
    told = opened({name: damaged}).evaluate(WAITED)["failed"]
    assert is_a_sentence(told)
    assert name in told


@pytest.mark.parametrize(
    "before",
    [
        "delete globalThis.WebAssembly",
        "delete globalThis.Worker",
        "delete globalThis.TransformStream",
    ],
)
def test_a_browser_that_runs_no_python_is_told_so(opened, before: str) -> None:
    page = opened(before=before)
    told = page.evaluate(WAITED)["failed"]
    assert is_a_sentence(told)
    assert "This browser has no" in told
    assert page.ask("command", words="world")["refused"] == told
    assert not [one for one in page.requested if "worker.js" in one]


def test_a_page_that_was_failed_by_the_network_may_try_again(opened) -> None:
    page = opened()
    page.route("**/nmatrix.zip", lambda route: route.abort())
    page.reload()
    told = page.evaluate(WAITED)["failed"]
    assert told.startswith("file (nmatrix.zip): it cannot be fetched")
    page.unroute("**/nmatrix.zip")
    page.evaluate("async () => (await import('./engine.js')).restart()")
    assert page.ask("command", words="--version")["code"] == 0


def test_the_folder_works_alone_and_asks_only_its_own_host(opened) -> None:
    page = opened()
    assert page.ask("command", words="world")["code"] == 0
    assert page.ask("command", words="derive")["code"] == 4
    assert page.ask("exercise", number=1)["number"] == 1
    assert page.requested
    assert {one for one in page.requested if not one.startswith(page.address)} <= {
        one for one in page.requested if one.endswith("/favicon.ico")
    }
    assert "default-src 'self'" in page.content()


def test_what_dies_or_hangs_is_ended_and_the_session_comes_back(opened, content) -> None:
    worker = content["worker.js"].decode()
    patched = worker.replace("  try {\n    tell({id, answer", BROKEN)
    assert patched != worker
    engine = content["engine.js"].decode()
    hasty = engine.replace("PATIENCE = 20_000", "PATIENCE = 400")
    hasty = hasty.replace("LONGEST = 120_000", "LONGEST = 2_000")
    page = opened({"worker.js": patched.encode(), "engine.js": hasty.encode()})
    page.evaluate(STATES)
    assert page.ask("say", text="a = 7\nb = a + 1")["names"][-1]["value"] == "8"
    for words, sentence in (
        ("let Python die", "ran out of memory or depth"),
        ("let the worker throw", "ran out of memory"),
    ):
        told = page.ask("command", words=words)
        assert sentence in told["refused"]
        assert page.ask("say", text="b")["turns"][0]["text"] == "ans  8\n"
    page.evaluate(LATER, ["command", {"words": "let it hang"}])
    page.evaluate(LATER.replace("later", "other"), ["say", {"text": "a"}])
    assert "took longer than 2 seconds" in page.evaluate("later")["refused"]
    slow = [one["sentence"] for one in page.evaluate("states") if one.get("slow")]
    assert slow
    assert all(map(is_a_sentence, slow))
    assert page.evaluate("other")["turns"][0]["text"] == "ans  7\n", "what waits is not lost"
    assert [one for one in page.evaluate("states") if one.get("restarted")]


def test_what_takes_long_may_be_stopped(opened) -> None:
    page = opened()
    page.ask("say", text="a = 7")
    page.evaluate(LATER, ["command", {"words": LONG}])
    page.wait_for_timeout(300)
    page.evaluate("async () => (await import('./engine.js')).stop()")
    assert page.evaluate("later")["refused"].startswith("stopped: the computation was ended")
    assert page.ask("say", text="a")["turns"][0]["text"] == "ans  7\n"


def test_a_paste_without_end_is_refused_at_once(opened) -> None:
    page, count = opened(), 10**6
    page.ask("command", words="--version")
    for name, asked in (
        ("say", {"text": "1 " * (count // 2)}),
        ("shown", {"words": ["identify", "7" * count]}),
        ("grade", {"number": 1, "answer": "[" * count}),
        ("command", {"words": "calc -", "files": {"-": "(" * count}}),
    ):
        told = page.ask(name, **asked)
        assert told["refused"].startswith("what was typed: it has 1,000,0"), name
    deep = page.ask("say", text="(" * 9000)
    assert json.dumps(deep["turns"])
    assert page.ask("say", text="2")["turns"][0]["text"] == "ans  2\n"
