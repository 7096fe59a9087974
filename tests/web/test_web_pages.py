"""The pages by hand: keyboard, phone, names, both themes, paper, and a sheet to its end."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest

from nmatrix.cli.web import desk
from nmatrix.lessons.exercises.exercise import Choice, ExerciseKind
from nmatrix.lessons.exercises.scheme import Sheet
from nmatrix.lessons.exercises.sheet import exercise
from nmatrix.web.folder import pages, write

slow = pytest.mark.slow
MOST_BYTES = 300_000
LOADED = "#engine[hidden]"
WIDE, PHONE = {"width": 1280, "height": 860}, {"width": 390, "height": 844}
NO_STORAGE = """Object.defineProperty(window, 'localStorage', {get() {
  throw new DOMException('refused', 'SecurityError'); }});"""
# Each page in a state, and what stands there when it is reached.
STATES = {
    "#start": "#page-start h1",
    "#calc": "#offers button",
    "#calc?s=A+%3D+%5B2+1%3B+1+3%5D%0AA%5E-1%0A1%2F0": "#transcript .note",
    "#identify": "#identify-examples button",
    "#identify?m=0+-1+0%3B+1+0+0%3B+0+0+1": "#identify-answer .report",
    "#identify?m=1+2": "#identify-answer .note",
    "#check?what=normal&answer=1+0+0%3B+0+2+0%3B+0+0+1&scale=1+2+1": "#check-answered .report",
    "#exercises?seed=5&course=CG": "#sheet-form button",
    "#exercises?teach=1": "#teach-link",
    "#exercises?seed=3&student=Ada&n=1&done=wr": "#cards .grid input",
    "#exercises?seed=3&student=Ada&n=3": "#cards .choice input",
    "#exercises?seed=3&student=Ada&all=1": "#exercise-10",
    "#spaces?space=object&scale=1+2+1&full=1": "#spaces-answer .report",
    "#explorer": "#explorer-frame",
    "#lint": "#lint-why:not([hidden])",
    "#line?line=nmatrix+world+--scale+1+2+1": "#line-answer pre",
}


# --- what needs no browser ---


def test_the_pages_are_small() -> None:
    assert sum(map(len, pages().values())) <= MOST_BYTES


def test_each_part_that_a_script_asks_for_stands_on_the_page() -> None:
    """A word mistyped in a script or in the page breaks this."""
    told = {name: one.decode() for name, one in pages().items() if name.endswith((".js", ".html"))}
    standing = set(re.findall(r'\bid="([\w-]+)"', told["index.html"]))
    for name, text in told.items():
        asked = set(re.findall(r'\bat\("([\w-]+)"\)', text))
        assert asked <= standing, name


def test_nothing_on_the_page_is_a_script_of_its_own() -> None:
    text = pages()["index.html"].decode()
    assert "script-src 'self' 'wasm-unsafe-eval'" in text
    assert re.findall(r"<script(?![^>]* src=)", text) == []
    assert re.findall(r"<style|\son\w+=|javascript:", text) == []


# --- the pages in a browser ---


@pytest.fixture(scope="module")
def address(content, served, tmp_path_factory) -> str:
    root = tmp_path_factory.mktemp("site")
    write(root / "below", content, force=False)
    return f"{served(root)}below/"


@pytest.fixture(scope="module")
def visit(browser, address) -> Iterator:
    """Open the pages in a context of its own; what goes wrong there is collected."""
    contexts = []

    def visit_(fragment: str = "#start", before: str = "", **options):
        context = browser.new_context(**{"viewport": PHONE, **options})
        contexts.append(context)
        if before:
            context.add_init_script(before)
        page = context.new_page()
        page.set_default_timeout(30_000)
        page.complaints, page.asked = [], []
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on(
            "console",
            lambda told: told.type in ("error", "warning") and page.complaints.append(told.text),
        )
        context.on("request", lambda request: page.asked.append(request.url))
        page.goto(address + fragment)
        return page

    yield visit_
    for context in contexts:
        context.close()


@pytest.fixture(scope="module")
def page(visit):
    """One page for many tests, with Python loaded."""
    found = visit(viewport=WIDE, reduced_motion="reduce")
    found.wait_for_selector(LOADED, state="attached", timeout=90_000)
    return found


def reach(page, fragment: str, *, shows: str = "") -> None:
    """Go to an address within the page, and wait for what stands there."""
    page.evaluate("location.hash = '#lint'")
    page.wait_for_selector("#page-lint:not([hidden])")
    page.evaluate("fragment => { location.hash = fragment; }", fragment)
    page.wait_for_selector(shows or STATES[fragment])


def each_state(page) -> Iterator[str]:
    for fragment in STATES:
        reach(page, fragment)
        yield fragment


UNNAMED = """() => [...document.querySelectorAll('main *, header *, footer *')]
  .filter(one => one.matches('button, input, textarea, select, a, summary, iframe'))
  .filter(one => one.checkVisibility())
  .filter(one => !(one.getAttribute('aria-label') || one.title
    || [...(one.labels ?? [])].some(label => label.textContent.trim())
    || (!one.matches('input, textarea, select') && one.textContent.trim())))
  .map(one => one.outerHTML.slice(0, 80))"""
SMALL = """() => [...document.querySelectorAll('button, input, textarea, select, summary, .pill')]
  .concat([...document.querySelectorAll('nav a, .more a, .doors h2 a')])
  .filter(one => one.checkVisibility() && one.id !== 'skip')
  .map(one => one.matches('[type=radio], [type=checkbox], [type=file]') ? one.labels[0] : one)
  .map(one => [one, one.getBoundingClientRect()])
  .filter(([, box]) => box.height < 39.5 || box.width < 39.5)
  .map(([one]) => one.outerHTML.slice(0, 80))"""
FAINT = """() => {
  const paint = document.createElement('canvas').getContext('2d', {willReadFrequently: true});
  const channels = colour => { paint.clearRect(0, 0, 1, 1); paint.fillStyle = colour;
    paint.fillRect(0, 0, 1, 1); return [...paint.getImageData(0, 0, 1, 1).data]; };
  const light = ([r, g, b]) => [r, g, b].map(c => c / 255)
    .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4)
    .reduce((sum, c, i) => sum + c * [0.2126, 0.7152, 0.0722][i], 0);
  const behind = one => { for (let up = one; up; up = up.parentElement) {
    const found = channels(getComputedStyle(up).backgroundColor);
    if (found[3] === 255) return found; }
    return [255, 255, 255, 255]; };
  return [...document.querySelectorAll('body *')]
    .filter(one => one.checkVisibility() && !one.closest('svg, iframe')
      && [...one.childNodes].some(node => node.nodeType === 3 && node.data.trim()))
    .map(one => { const style = getComputedStyle(one), size = parseFloat(style.fontSize);
      const [a, b] = [light(channels(style.color)), light(behind(one))].sort((x, y) => y - x);
      const large = size >= 24 || (size >= 18.6 && parseInt(style.fontWeight) >= 700);
      return [(a + 0.05) / (b + 0.05), large ? 3 : 4.5, one.outerHTML.slice(0, 90)]; })
    .filter(([ratio, least]) => ratio < least);
}"""


@slow
def test_every_page_is_reached_by_keyboard_alone(page) -> None:
    names = page.evaluate("[...document.querySelectorAll('nav a')].map(one => one.hash.slice(1))")
    assert len(names) == len(set(names)) >= 8
    for count, name in enumerate(names, 1):
        reach(page, "#start")
        page.evaluate("document.activeElement.blur(); getSelection().removeAllRanges()")
        page.locator("#skip").focus()
        for _ in range(count + 1):  # the skip link, the name of the program, then the pages
            page.keyboard.press("Tab")
        page.keyboard.press("Enter")
        page.wait_for_selector(f"#page-{name}:not([hidden])")
        page.wait_for_function("() => document.activeElement.tagName === 'H1'")
        assert page.locator("main > section:visible").count() == 1
        assert page.title().endswith("nmatrix")


@slow
def test_everything_to_press_or_fill_has_a_name_and_shows_where_the_keyboard_is(page) -> None:
    for fragment in each_state(page):
        assert page.evaluate(UNNAMED) == [], fragment
    reach(page, "#check?what=normal&answer=1+0+0%3B+0+2+0%3B+0+0+1&scale=1+2+1")
    for _ in range(14):
        page.keyboard.press("Tab")
        style = page.evaluate("getComputedStyle(document.activeElement).outlineStyle")
        assert style == "solid"


@slow
def test_a_phone_scrolls_one_way_and_its_targets_fit_a_thumb(page) -> None:
    page.set_viewport_size(PHONE)
    for fragment in each_state(page):
        assert page.evaluate("document.documentElement.scrollWidth") <= 390, fragment
        assert page.evaluate(SMALL) == [], fragment
    page.set_viewport_size(WIDE)


@slow
@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_every_word_stands_out_from_its_ground(page, scheme) -> None:
    page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    for fragment in each_state(page):
        assert page.evaluate(FAINT) == [], fragment


@slow
def test_the_theme_may_be_chosen(page) -> None:
    page.emulate_media(color_scheme="light", reduced_motion="reduce")
    ground = "getComputedStyle(document.body).backgroundColor"
    before = page.evaluate(ground)
    page.click("#theme")
    assert page.evaluate(ground) != before
    assert page.get_attribute("#theme", "aria-pressed") == "true"
    page.click("#theme")
    assert page.evaluate(ground) == before


@slow
def test_paper_has_answers_and_no_buttons(page) -> None:
    for fragment in each_state(page):
        page.emulate_media(media="print")
        pressed = page.locator("main button:visible, nav:visible, footer:visible, #theme:visible")
        assert pressed.count() == 0, fragment
        assert page.locator("main").inner_text().strip(), fragment
        page.emulate_media(media="screen")
    page.emulate_media(media="screen", color_scheme="light", reduced_motion="reduce")


@slow
def test_nothing_moves_for_whoever_wants_it_still(page) -> None:
    reach(page, "#start")
    moves = "getComputedStyle(document.querySelector('.pill')).transitionDuration"
    page.emulate_media(reduced_motion="reduce")
    assert page.evaluate(moves) == "0s"
    page.emulate_media(reduced_motion="no-preference")
    assert page.evaluate(moves) != "0s"
    page.emulate_media(reduced_motion="reduce")


@slow
def test_a_session_goes_on_at_its_address_and_goes_back_by_undo(page) -> None:
    reach(page, "#calc")
    page.click("#calc-clear")
    page.wait_for_selector("#transcript:empty", state="attached")
    for line in ("A = [2 1; 1 3]", "A^-1"):
        page.fill("#calc-input", line)
        page.keyboard.press("Enter")
        page.wait_for_function(
            "line => document.querySelector('#transcript li:last-child').innerText.includes(line)"
            " && !document.querySelector('#transcript [aria-busy]')",
            arg=line,
        )
    shown = page.locator("#transcript math").all_text_contents()
    assert "5" in shown[-1]  # det A = 2 · 3 − 1 · 1
    page.context.grant_permissions(["clipboard-read", "clipboard-write"])
    page.click("#calc-copy")
    page.wait_for_selector("#calc-copy:text('Copied')")
    copied = page.evaluate("navigator.clipboard.readText()")
    assert copied == "".join(run_lines("A = [2 1; 1 3]", "A^-1"))
    held = page.evaluate("location.hash")
    page.click("#calc-clear")
    page.wait_for_selector("#transcript:empty", state="attached")
    reach(page, held, shows="#transcript li:nth-child(2) math")
    assert page.locator("#transcript math").all_text_contents() == shown
    assert page.evaluate("location.hash") == held
    page.fill("#calc-input", "")
    page.focus("#calc-input")
    page.keyboard.press("ArrowUp")
    assert page.input_value("#calc-input") == "A = [2 1; 1 3]\nA^-1"
    page.click("#calc-undo")
    page.wait_for_function("() => !location.hash.includes('%5E-1')")


def run_lines(*lines: str) -> list[str]:
    """The transcript of the calculator's lines, as a terminal has it."""
    told = desk().say("\n".join(lines))["turns"]
    return ["\n".join(f"{one['echo']}{one['text']}" for one in told)]


@slow
def test_steps_open_and_close(page) -> None:
    reach(page, "#calc?s=inverse(%5B2+1%3B+1+3%5D)", shows="#transcript li:last-child math")
    page.wait_for_function("() => !document.querySelector('#transcript [aria-busy]')")
    one = page.locator("#transcript li").last
    before = one.locator("math").count()
    steps = one.get_by_role("button", name="Steps")
    steps.click()
    page.wait_for_selector("#transcript li:last-child .step")
    assert one.locator("math").count() > before
    assert steps.get_attribute("aria-expanded") == "true"
    steps.click()
    page.wait_for_function("() => !document.querySelector('#transcript li:last-child .step')")
    assert one.locator("math").count() == before


@slow
def test_what_is_typed_is_never_taken_for_markup(page) -> None:
    planted = "<img src=x onerror=window.planted=1>"
    for fragment, shows in (
        (f"#identify?m={planted}", "#identify-answer .note"),
        (f"#calc?s={planted}", "#transcript li:last-child .note"),
        (f"#exercises?seed={planted}&student={planted}&course={planted}", "#cards .grid input"),
        (f"#line?line={planted}", "#line-answer pre"),
        (f"#spaces?space={planted}", "#spaces-answer .note"),
    ):
        reach(page, fragment, shows=shows)
    assert page.locator("main img").count() == 0
    assert page.evaluate("window.planted") is None


@slow
def test_a_million_characters_are_a_sentence_on_every_page(page) -> None:
    for name, field, answer in (
        ("identify", "#identify-matrix", "#identify-answer .note"),
        ("check", "#check-answer", "#check-answered .note"),
        ("calc", "#calc-input", "#transcript li:last-child .note"),
        ("line", "#line-input", "#line-answer .note"),
    ):
        reach(page, f"#{name}", shows=field)
        page.evaluate("field => { document.querySelector(field).value = '1 '.repeat(5e5); }", field)
        page.locator(field).evaluate("one => one.form.requestSubmit()")
        page.wait_for_selector(answer)
        assert "characters" in page.inner_text(answer)
        assert len(page.url) < 10_000
        page.fill(field, "")
    page.click("a.name")


@slow
def test_a_sheet_is_solved_on_a_phone_without_storage_and_without_a_mouse(visit) -> None:
    phone = visit("#exercises?seed=7&course=CG", NO_STORAGE, has_touch=True, is_mobile=True)
    assert phone.inner_text("#exercises-title") == "CG"
    phone.fill("#sheet-student", "Ada")  # while Python is still loading
    phone.keyboard.press("Enter")
    kinds = len(ExerciseKind)
    for number in range(1, kinds + 1):
        one = exercise(number, Sheet("7", "Ada"))
        heading = phone.locator(f"#exercise-{number}")
        heading.filter(has_text=one.title).wait_for(timeout=90_000)  # Python loads before
        assert phone.get_by_role("button", name="Show me").count() == 0
        solve(phone, one)
        phone.wait_for_selector(".told.right")
        assert phone.get_by_role("button", name="Show me").count() == 1
        if number < kinds:
            phone.get_by_role("button", name=f"Go on to {number + 1}").press("Enter")
    assert phone.inner_text("#score") == f"All {kinds} right. Well done."
    assert f"done={'r' * kinds}" in phone.url
    assert phone.complaints == []


def solve(page, one) -> None:
    """Type an answer that is right, by keyboard: a blank leads to the next cell, Enter checks."""
    page.wait_for_selector("#cards form")
    if isinstance(one.grader, Choice):
        page.focus("#cards input[type=radio]")
        page.keyboard.press(one.right)
    else:
        page.focus("#cards .grid input")
        numbers = one.right.replace(";", " ").replace(",", " ").split()
        for i, number in enumerate(numbers):
            page.keyboard.insert_text(number)
            if i + 1 < len(numbers):
                page.keyboard.press(" ")
    page.keyboard.press("Enter")


@slow
def test_a_wrong_answer_is_told_with_its_cells_and_the_solution_only_then(page, nmatrix) -> None:
    reach(page, "#exercises?seed=3&student=Bea&n=2", shows="#cards .grid input")
    page.wait_for_function("() => document.querySelector('#whose').textContent.includes('Bea')")
    one = exercise(2, Sheet("3", "Bea"))
    page.wait_for_function("() => document.querySelectorAll('#cards .grid input').length === 9")
    page.get_by_role("button", name="Check", exact=True).click()
    assert "empty" in page.inner_text("#cards .judgement")
    right = one.right.replace(";", " ").split()
    wrong = [*right]
    wrong[4] = "77"
    cells = page.locator("#cards .grid input")
    for i, number in enumerate(wrong):
        cells.nth(i).fill(number)
    assert page.get_by_role("button", name="Show me").count() == 0
    page.keyboard.press("Enter")
    page.wait_for_selector("#cards .told.wrong")
    rows = "; ".join(" ".join(wrong[i : i + 3]) for i in (0, 3, 6))
    told = nmatrix(f"check exercise 2 --seed 3 --student Bea -f json -- '{rows}'").data
    marked = [cells.nth(i).get_attribute("aria-invalid") == "true" for i in range(9)]
    assert [divmod(i, 3) for i in range(9) if marked[i]] == [
        tuple(entry) for entry in told["wrong_entries"]
    ]
    assert any(marked)
    page.get_by_role("button", name="Show me").click()
    page.wait_for_selector("#cards .key math")
    assert "done=.w" in page.url


@slow
def test_without_webassembly_a_sentence_tells_it_and_the_explorer_still_opens(visit) -> None:
    page = visit("#identify", "delete window.WebAssembly;")
    page.wait_for_selector("#engine.failed")
    assert "WebAssembly" in page.inner_text("#engine-sentence")
    page.click("#identify-examples button")
    page.wait_for_selector("#identify-answer .note")
    page.click("nav a[href='#explorer']")
    page.frame_locator("#explorer-frame").locator("#number").wait_for()
    assert not any("pyodide" in url for url in page.asked)


@slow
def test_no_page_complained_and_nothing_left_its_host(page, address) -> None:
    assert page.complaints == []
    assert {url for url in page.asked if not url.startswith((address, "blob:", "data:"))} == set()
