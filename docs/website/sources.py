"""The sources of the site: the documents as they are, and beside them the pages made of tables.

They are laid into a folder of their own, so that nothing written by the build stands among the
documents. In Markdown the documents lead to one another as files; here they lead to pages.
"""

from __future__ import annotations

import re
import shutil
from collections.abc import Iterator
from pathlib import Path

import command_pages
import front_page
import mistake_pages
from markdown import description_of, head
from notebook_page import as_markdown

from nmatrix.linting.rules import RuleId

DOCS = Path(__file__).resolve().parents[1]
FOLDERS = ("pictures", "samples", "scenes")  # what documents show and lead to
INDEX, SITE_INDEX = "README.md", "index.md"
# What leads out of the documents, and pages to be seen instead of downloaded.
ROOT_README = re.compile(r"\]\(\.\./README\.md\)")
README = re.compile(r"(?<=[(/])README\.md\b")
NOTEBOOK = re.compile(r"(?<=\w)\.ipynb\)")
SAMPLE = re.compile(r"\[([^\]]*)\]\((samples/[\w-]+\.html)\)")
CLASS = re.compile(r"^(?=### ([A-Z]\w+)$)", re.MULTILINE)
PROOF = re.compile(r"^(?=## .*\n\n!\[[^\]]*\]\(pictures/([\w-]+)\.png\))", re.MULTILINE)


def lay(folder: Path, *, has_web: bool) -> None:
    """Write all sources into a folder."""
    for name in FOLDERS:
        shutil.copytree(DOCS / name, folder / name)
    for name, text in _pages(has_web=has_web):
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text, encoding="utf-8")


def _pages(*, has_web: bool) -> Iterator[tuple[str, str]]:
    """Write every page; give its name and its text."""
    for path in sorted([*DOCS.glob("*.md"), *DOCS.glob("lint/*.md")]):
        if path != DOCS / INDEX:
            name = path.relative_to(DOCS).as_posix()
            yield name.replace(INDEX, SITE_INDEX), document(name, path.read_text(encoding="utf-8"))
    notebooks = sorted(DOCS.glob("notebook/*.ipynb"))
    for path in notebooks:
        yield f"notebook/{path.stem}.md", as_markdown(path.read_text(encoding="utf-8"))
    yield from command_pages.written()
    yield from mistake_pages.written()
    contents = (DOCS / INDEX).read_text(encoding="utf-8")
    made = [f"notebook/{path.stem}" for path in notebooks]
    yield from front_page.written(contents, made, has_web=has_web)


def document(name: str, text: str) -> str:
    """Make a page of the site of a document."""
    text = ROOT_README.sub("](/index.md)", text)
    text = README.sub(SITE_INDEX, text)
    text = NOTEBOOK.sub(".md)", text)
    text = SAMPLE.sub(r'<a href="\2">\1</a>', text)
    if name == "mistakes.md":
        text = mistake_pages.listed(text)
    if name == "gallery.md":
        text = PROOF.sub(r"(\1)=\n", text)
    if name == "reference.md":  # anchors know no capitals: world is a function, World a class
        text = CLASS.sub(r"(class-\1)=\n", text)
    rule = Path(name).stem
    if rule in set(RuleId):
        return mistake_pages.rule_page(RuleId(rule), text)
    if name == f"lint/{INDEX}":
        rules = "\n".join(one.value for one in RuleId)
        text += f"\n```{{toctree}}\n:hidden:\n\n{rules}\n```\n"
    return head(description_of(text)) + text
