"""The explorer where it does not own the page: notebooks' widgets, frames, refused storage."""

from __future__ import annotations

import json

import pytest
from browser.inside import inside

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Theme
from nmatrix.output.explorer.page import module, page, page_data
from nmatrix.output.explorer.sliders import first_look
from nmatrix.scene.setup import Setup

pytestmark = pytest.mark.slow  # a browser draws by software

SETUP = first_look(Setup())
HOST = "http://nmatrix.test"
NOTEBOOK = """<!doctype html><html lang="en"><head><title>cells</title></head>
<body data-jp-theme-light="true"><h1>A heading</h1><div id="one"></div><div id="two"></div>
<script type="application/json" id="cell">DATA</script><script type="module">
import widget from "./module.js";
class Model {  // as little of a widget's model as there may be
  constructor(data) { this.kept = { data, state: {} }; this.told = new Map(); this.saved = 0; }
  get(key) { return this.kept[key]; }
  set(key, value) {
    this.kept[key] = value;
    for (const react of this.told.get(`change:${key}`) || []) react();
  }
  on(what, react) { this.told.set(what, [...(this.told.get(what) || []), react]); }
  save_changes() { this.saved += 1; }
}
window.cells = {};
for (const id of ["one", "two"]) {
  const model = new Model(JSON.parse(document.getElementById("cell").textContent));
  cells[id] = { model, leave: widget.render({ model, el: document.getElementById(id) }) };
}
</script></body></html>"""


@pytest.fixture
def visited(browser):
    """Open a page of a host that exists in this test alone."""
    contexts = []

    def visit(path: str, files: dict[str, str], **options):
        context = browser.new_context(**options)
        contexts.append(context)
        found = context.new_page()
        found.complaints, found.requests_made = [], []
        found.on("pageerror", lambda error: found.complaints.append(str(error)))

        def answer(route) -> None:
            asked = route.request.url.removeprefix(HOST)
            found.requests_made.append(asked)
            kind = "text/javascript" if asked.endswith(".js") else "text/html"
            if asked in files:
                route.fulfill(body=files[asked], content_type=f"{kind}; charset=utf-8")
            else:
                route.fulfill(status=404, body="")

        found.route("**/*", answer)
        found.goto(f"{HOST}{path}")
        return found

    yield visit
    for context in contexts:
        context.close()


def cell(which: str) -> str:
    return f"document.querySelector('#{which} > div').explorer"


@pytest.fixture
def notebook(visited):
    data = json.dumps(page_data(SETUP, fits=True)).replace("<", "\\u003c")
    files = {"/lab/": NOTEBOOK.replace("DATA", data), "/lab/module.js": module()}
    found = visited("/lab/", files)
    found.wait_for_function("window.cells && cells.two")
    return found


def number(found, which: str) -> str:
    return found.locator(f"#{which} #number").text_content()


def test_a_slider_moves_its_own_model_and_a_model_its_own_slider(notebook) -> None:
    assert [number(notebook, which) for which in ("one", "two")] == ["36.9°", "36.9°"]
    slider = notebook.locator("#one #sy")
    slider.scroll_into_view_if_needed()
    box = slider.bounding_box()
    notebook.mouse.move(box["x"] + box["width"] / 2, box["y"] + box["height"] / 2)
    notebook.mouse.down()
    notebook.mouse.move(box["x"] + 0.75 * box["width"], box["y"] + box["height"] / 2, steps=4)
    notebook.mouse.up()
    notebook.wait_for_function("cells.one.model.saved > 0")
    moved = notebook.evaluate("cells.one.model.get('state').sy")
    assert 2.5 < moved < 3.5
    assert set(notebook.evaluate("cells.one.model.get('state')")) == {"sy"}
    assert notebook.evaluate("cells.two.model.get('state')") == {}
    assert number(notebook, "two") == "36.9°"
    notebook.evaluate("cells.two.model.set('state', { sy: 1, rz: 30, tx: 0.5 })")
    assert number(notebook, "two") == "0°"
    assert notebook.locator("#two #rz").input_value() == "30"
    assert "moved 0.5 along x" in notebook.locator("#two #sentence").text_content()
    assert notebook.locator("#one #rz").input_value() == "0"
    assert float(notebook.locator("#one #sy").input_value()) == moved
    assert notebook.complaints == []


def test_what_python_sets_is_followed_and_nonsense_is_left_out(notebook) -> None:
    notebook.evaluate("cells.one.model.set('state', { sy: NaN, sx: '<b>', rule: 'x', mx: 1 })")
    seen = json.loads(notebook.locator("#one #state").text_content())
    assert seen["A"] == [[-1, 0, 0], [0, 2, 0], [0, 0, 1]]
    assert notebook.complaints == []


def test_labels_belong_to_the_sliders_beside_them(notebook) -> None:
    same = """() => [...root.querySelectorAll('label[for]')].every(one =>
        one.control && one.control.getRootNode() === root)"""
    for which in ("one", "two"):
        assert notebook.evaluate(inside(same, cell(which)))
        hidden = inside("() => ['copy-link', 'print'].every(id => byId(id).hidden)", cell(which))
        assert notebook.evaluate(hidden), "a cell has no address and no paper of its own"


def test_the_notebook_keeps_its_looks_and_its_address(notebook) -> None:
    styles = "document.querySelectorAll('style, link').length + document.adoptedStyleSheets.length"
    assert notebook.evaluate(styles) == 0
    margin = "getComputedStyle(document.body).margin"
    assert notebook.evaluate(margin) == "8px"
    notebook.locator("#one #reset").click()
    notebook.wait_for_timeout(300)
    assert notebook.url == f"{HOST}/lab/"


def stage(found, which: str) -> list[int]:
    levels = "() => [...byId('right').getContext('2d').getImageData(4, 4, 1, 1).data].slice(0, 3)"
    return found.evaluate(inside(levels, cell(which)))


def rgb(theme: Theme) -> list[int]:
    colour = PALETTES[theme].stage
    return [int(colour[i : i + 2], 16) for i in (1, 3, 5)]


def test_it_has_the_theme_of_the_notebook_until_another_is_chosen(notebook) -> None:
    assert stage(notebook, "one") == rgb(Theme.LIGHT)
    notebook.evaluate("document.body.dataset.jpThemeLight = 'false'")
    notebook.wait_for_timeout(100)
    assert stage(notebook, "one") == stage(notebook, "two") == rgb(Theme.DARK)
    notebook.locator("#one #theme").click()
    assert (stage(notebook, "one"), stage(notebook, "two")) == (rgb(Theme.LIGHT), rgb(Theme.DARK))


def test_a_widget_that_leaves_takes_all_with_it(notebook) -> None:
    notebook.evaluate("cells.one.leave()")
    assert notebook.evaluate("document.getElementById('one').childElementCount") == 0
    notebook.evaluate("document.body.dataset.jpThemeLight = 'false'")
    notebook.evaluate("cells.one.model.set('state', { sy: 1 })")
    notebook.wait_for_timeout(300)
    assert number(notebook, "two") == "36.9°"
    assert notebook.complaints == []


FRAME = """<!doctype html><html lang="en" data-theme="light"><title>web</title>
<style>body { margin: 0 } iframe { width: 100%; height: 844px; border: 0; display: block }</style>
<iframe title="explorer" SOURCE></iframe></html>"""


def framed(visited, source: str, **options):
    files = {
        "/class/web/": FRAME.replace("SOURCE", source),
        "/class/web/explorer.html": page(SETUP, fits=True).decode(),
    }
    found = visited("/class/web/", files, **options)
    inner = found.frame_locator("iframe")
    inner.locator("#number").wait_for()
    return found, inner


def test_a_frame_below_any_path_follows_the_theme_of_its_page(visited) -> None:
    found, inner = framed(
        visited, 'src="explorer.html#sy=3"', viewport={"width": 390, "height": 844}
    )
    assert set(found.requests_made) <= {"/class/web/", "/class/web/explorer.html", "/favicon.ico"}
    assert inner.locator("#number").text_content() == "53.1°"
    frame = found.frames[1]
    assert frame.evaluate("document.documentElement.scrollWidth") <= 390
    paper = "getComputedStyle(document.querySelector('#nmatrix-explorer')).backgroundColor"
    assert frame.evaluate(paper) == "rgb(255, 255, 255)"
    found.evaluate("document.documentElement.dataset.theme = 'dark'")
    found.wait_for_timeout(150)
    dark = PALETTES[Theme.DARK].paper
    levels = ", ".join(str(int(dark[i : i + 2], 16)) for i in (1, 3, 5))
    assert frame.evaluate(paper) == f"rgb({levels})"
    assert found.complaints == []


@pytest.mark.parametrize("source", ['src="explorer.html"', "srcdoc"])
def test_where_storage_and_address_are_refused_the_numbers_go_on(visited, source) -> None:
    if source == "srcdoc":
        text = page(SETUP, fits=True).decode().replace("&", "&amp;").replace('"', "&quot;")
        source = f'srcdoc="{text}"'
    found, inner = framed(visited, f'sandbox="allow-scripts" {source}')
    inner.locator("#sy-n").fill("1")
    found.wait_for_timeout(400)
    assert inner.locator("#number").text_content() == "0°"
    inner.locator("#theme").click()
    assert found.complaints == []
