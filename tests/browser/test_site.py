"""The site in a browser without a network: its search, narrow screens, the dark."""

from __future__ import annotations

from pathlib import Path

import pytest
from symptoms import MISTAKES

from nmatrix.cli.catalogue import COMMANDS
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.linting.rules import RuleId

pytestmark = pytest.mark.slow
PHONE = {"width": 390, "height": 844}
WAITED = 10_000  # milliseconds
BEST = 3  # results that a reader looks at
QUESTIONS = {
    "why are my normals wrong when I scale my object": "mistakes/not-inverted.html",
    "normals wrong after non-uniform scale": "mistakes/used-world-matrix.html",
    "lighting changes when the object rotates": "mistakes/used-model-view.html",
    "black faces negative scale": "mistakes/cofactor-sign.html",
    "my camera looks the wrong way with lookAt": "mistakes/wrong-handedness.html",
    "row-major or column-major?": "mistakes/transposed-layout.html",
    "vulkan image is upside down": "mistakes/clip-y.html",
    "gimbal lock": "for-students.html",
    "unproject mouse to ray": "for-students.html",
    "wxyz quaternion order": "mistakes/quaternion-order.html",
    "opencv to opengl camera": "mistakes/camera-axes.html",
    "picture looks stretched": "mistakes/aspect-inverted.html",
    "how to cite": "cite.html",
    "how do I install this": "install.html",
    "moodle question bank": "for-teachers.html",
    "handout for a class": "commands/handout.html",
    "exit codes": "command-line.html#exit-codes",
    "pow negative NaN specular": "lint/NM305.html",
    "transform_normals": "reference.html#transform-normals",
    "FrameError": "reference.html#class-frameerror",
}


RANKED = """
question => Search._performSearch(...Search._parseQuery(question))
    .reverse().map(([page, , anchor]) => `${page}.html${anchor}`)
"""


@pytest.fixture(scope="module")
def asked(browser, site: Path):
    """Ask the search of the site, opened as a file, and return where it leads, the best first."""
    context = browser.new_context(offline=True)
    page = context.new_page()
    page.goto(f"file://{site}/search.html")
    page.wait_for_function("() => Search.hasIndex()", timeout=WAITED)
    yield lambda question: page.evaluate(RANKED, question)
    context.close()


def test_the_page_of_the_search_shows_what_it_finds(browser, site: Path, asked) -> None:
    question = next(iter(QUESTIONS))
    context = browser.new_context(offline=True)
    page = context.new_page()
    complaints: list[str] = []
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.on("console", lambda one: one.type == "error" and complaints.append(one.text))
    page.goto(f"file://{site}/index.html")
    page.locator("input[name=q]").first.fill(question)
    page.locator("input[name=q]").first.press("Enter")
    page.wait_for_selector("ul.search > li:nth-child(3) > a", timeout=WAITED)
    links = page.eval_on_selector_all(
        "ul.search > li > a", "all => all.map(one => one.getAttribute('href'))"
    )
    assert links[:BEST] == asked(question)[:BEST]
    assert not complaints
    context.close()


@pytest.mark.parametrize("question", QUESTIONS)
def test_a_question_finds_its_page_among_the_first(question: str, asked) -> None:
    assert QUESTIONS[question] in asked(question)[:BEST]


@pytest.mark.parametrize("mistake", MistakeId)
def test_what_is_seen_and_the_name_of_a_mistake_find_its_page_first(mistake, asked) -> None:
    name = f"mistakes/{mistake}.html"
    assert asked(MISTAKES[mistake].searched[0])[0] == name
    assert asked(mistake)[0] == name


@pytest.mark.parametrize("command", COMMANDS)
def test_a_command_is_found(command: str, asked) -> None:
    assert f"commands/{command}.html" in asked(f"nmatrix {command}")[:BEST]


@pytest.mark.parametrize("rule", RuleId)
def test_the_code_of_a_rule_finds_its_page_first(rule: RuleId, asked) -> None:
    assert asked(rule.value)[0] == f"lint/{rule.value}.html"


def test_every_page_fits_a_phone_and_is_dark_in_the_dark(browser, site: Path) -> None:
    context = browser.new_context(offline=True, viewport=PHONE, color_scheme="dark")
    page = context.new_page()
    requests: list[str] = []
    page.on("request", lambda request: requests.append(request.url))
    apart = ("samples", "try", "_static")
    names = [one for one in site.rglob("*.html") if one.relative_to(site).parts[0] not in apart]
    for name in names:
        page.goto(f"file://{name}", wait_until="domcontentloaded")
        wide, paper = page.evaluate(
            "[document.scrollingElement.scrollWidth,"
            " getComputedStyle(document.body).backgroundColor]"
        )
        assert wide <= PHONE["width"], name
        levels = [int(part) for part in paper[paper.index("(") + 1 : -1].split(",")[:3]]
        assert max(levels) < 60, (name, paper)
    assert {one.partition(":")[0] for one in requests} <= {"file", "data"}
    context.close()
