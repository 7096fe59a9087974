"""The front page: one picture, one sentence, one command, three paths; and how to cite."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import yaml
from markdown import head, indexed

ROOT = Path(__file__).resolve().parents[2]
OTHER_WAYS = re.compile(r"^## Other ways to get it\n\n(.*?)(?=^## )", re.MULTILINE | re.DOTALL)
SECTION = re.compile(r"^## (.+)\n\n((?:[*] .*\n(?:  .*\n)*)+)", re.MULTILINE)
ENTRY = re.compile(r"^\* \[([^\]]+)\]\(([\w/-]+)\.md\)(?:: )?((?:.*\n?(?:  .*\n)*))", re.MULTILINE)
PATHS = "Three paths"
# Pages that the build makes stand behind these documents in the contents.
BEHIND = {
    "for-engineers": ["install"],
    "command-line": ["commands/index"],
    "architecture": ["cite"],
}
NOTEBOOK_BEHIND = "notebook"
SENTENCE = (
    "The matrices of computer graphics (world, view, projection, normals, any shading space), "
    "computed exactly for the numbers that you give, explained step by step, and checked, with the "
    "name of the mistake in a wrong answer."
)
COMMAND = "nmatrix world --scale 1 2 1"
INSTALL = (
    f"python3 -m venv .venv && .venv/bin/pip install -q -c constraints.txt . && .venv/bin/{COMMAND}"
)
PICTURE = (
    "A circle that becomes an ellipse, an egg with leaning normals and one with upright ones, "
    "and a map of the angle between, up to 36.9 degrees"
)
TRY = """\
<p class="try"><a href="try/index.html">Try it here, in your browser</a> The calculator, “what is
this matrix?”, exercises with instant grading: this very program, nothing to install, nothing leaves
your browser.</p>
"""
HOW_TO_TRY = """\
<p class="try">It runs in a browser too, with nothing to install; this folder was built without that
part. <code>npm install --no-save pyodide &amp;&amp; nmatrix web -o try</code> writes it.</p>
"""


def written(contents: str, notebooks: Sequence[str], *, has_web: bool) -> Iterator[tuple[str, str]]:
    """Write the front page, how to install and how to cite; give names and texts."""
    yield "index.md", page(contents, notebooks, has_web=has_web)
    yield "install.md", install((ROOT / "README.md").read_text(encoding="utf-8"))
    yield "cite.md", cite(yaml.safe_load((ROOT / "CITATION.cff").read_text(encoding="utf-8")))


def page(contents: str, notebooks: Sequence[str], *, has_web: bool) -> str:
    """Write the front page; its contents are those of the documents' own index."""
    sections = {title: ENTRY.findall(rows) for title, rows in SECTION.findall(contents)}
    lines = [head(f"nmatrix: {SENTENCE}"), "# nmatrix\n", f"**{SENTENCE}**\n"]
    lines += [f"[![{PICTURE}](pictures/normals.png)](gallery.md)\n"]
    lines += [f"```sh\n{INSTALL}\n```\n"]
    lines += [f"```{{raw}} html\n{TRY if has_web else HOW_TO_TRY}```\n"]
    lines += [f"## {PATHS}\n", "```{container} paths\n"]
    for title, target, told in sections[PATHS]:
        lines += [f"* [{title}]({target}.md)\\\n  {' '.join(told.split())}"]
    lines += ["```\n", "## What you will find\n"]
    for title, rows in sections.items():
        if title != PATHS:
            named = ", ".join(f"[{one}]({target}.md)" for one, target, _ in rows)
            lines += [f"* **{title}**: {named}"]
    lines += ["* Every [command](commands/index.md), with its options and examples that ran"]
    lines += ["* [How to install](install.md), [how to cite](cite.md)\n"]
    for title, rows in sections.items():
        targets = [one for row in rows for one in _with_made(*row[:2], notebooks)]
        listed = "\n".join(targets).replace("README", "index")
        lines += [f"```{{toctree}}\n:hidden:\n:caption: {title}\n\n{listed}\n```\n"]
    return "\n".join(lines).replace("README.md", "index.md")


def _with_made(title: str, target: str, notebooks: Sequence[str]) -> list[str]:
    """Name a document by its short title, and behind it the pages that the build makes."""
    made = [*BEHIND.get(target, ()), *(notebooks if target == NOTEBOOK_BEHIND else ())]
    return [f"{title.partition(':')[0]} <{target}>", *made]


def install(readme: str) -> str:
    """Tell how to install, by the words of the README."""
    ways = OTHER_WAYS.search(readme)
    if ways is None:
        raise ValueError(f"{ROOT / 'README.md'} has no section of this form: {OTHER_WAYS.pattern}")
    return "\n".join(
        [
            head("How to install nmatrix: pip, pipx, uv, one file, extras."),
            "# How to install nmatrix\n",
            indexed(["install nmatrix", "download nmatrix", "pip install", "pipx uv"]),
            "In a folder with its sources; Python 3.11 or newer is all that it needs:\n",
            f"```sh\n{INSTALL}\n```\n",
            ways[1],
        ]
    )


def cite(citation: dict[str, Any]) -> str:
    """Tell how to cite, made of the citation file.

    Examples
    --------
    >>> one = {"title": "nmatrix", "version": "1.0", "abstract": "Matrices.",
    ...        "authors": [{"name": "Ada Lovelace"}]}
    >>> "Ada Lovelace. (n.d.). *nmatrix* (Version 1.0) [Computer software]." in cite(one)
    True
    """
    authors = [
        one.get("name") or f"{one['family-names']}, {one['given-names']}"
        for one in citation["authors"]
    ]
    title, version = citation["title"], citation["version"]
    year = str(citation.get("date-released", ""))[:4]
    named = ", ".join(authors).rstrip(".")
    bibtex = {
        "author": " and ".join(f"{{{one}}}" for one in authors),
        "title": f"{{{title}}}: {citation['abstract'].strip().rstrip('.')}",
        "version": version,
        **({"year": year} if year else {}),
    }
    fields = ",\n".join(f"  {key} = {{{value}}}" for key, value in bibtex.items())
    return "\n".join(
        [
            head("How to cite nmatrix: APA, BibTeX, and the citation file."),
            "# How to cite nmatrix\n",
            indexed(["citation", "BibTeX", "APA"]),
            "These lines are made of the file `CITATION.cff` of the sources.\n",
            "## APA\n",
            f"{named}. ({year or 'n.d.'}). *{title}* (Version {version}) [Computer software].\n",
            "## BibTeX\n",
            f"```bibtex\n@software{{{title},\n{fields}\n}}\n```\n",
        ]
    )
