"""Pages in a real Chromium."""

from __future__ import annotations

from pathlib import Path

import pytest


@pytest.fixture(scope="module")
def blank(browser):
    """A page with nothing on it."""
    page = browser.new_page()
    yield page
    page.close()


@pytest.fixture
def opened(browser):
    """Open a file with no network and no error; return its page."""
    contexts = []

    def open_(path: Path, fragment: str = "", **options):
        context = browser.new_context(**options)
        contexts.append(context)
        page = context.new_page()
        page.requests_made, page.complaints = [], []
        page.on("request", lambda request: page.requests_made.append(request.url))
        page.on("pageerror", lambda error: page.complaints.append(str(error)))
        page.on(
            "console",
            lambda message: message.type == "error" and page.complaints.append(message.text),
        )
        page.goto(f"file://{path}{fragment}")
        return page

    yield open_
    for context in contexts:
        context.close()
