"""The few things that all written pages need: plain words, descriptions, index entries."""

from __future__ import annotations

import json
import re
from collections.abc import Iterable

LONGEST = 160  # characters of a description that a search engine shows
_ORDERS = re.compile(r"([\\`*_{}\[\]<>#|$])")


def plain(text: str) -> str:
    """Write words so that no character of them is an order."""
    return _ORDERS.sub(r"\\\1", text)


def head(description: str, keywords: Iterable[str] = ()) -> str:
    """Write what search engines read and people do not see.

    Examples
    --------
    >>> print(head("Normals.", ["a", "b"]))
    ---
    myst:
      html_meta:
        description: "Normals."
        keywords: "a, b"
    ---
    <BLANKLINE>
    """
    words = ", ".join(one.replace(",", "") for one in keywords)
    lines = [f"    description: {json.dumps(shortened(description), ensure_ascii=False)}"]
    lines += [f"    keywords: {json.dumps(words, ensure_ascii=False)}"] if words else []
    return "\n".join(["---", "myst:", "  html_meta:", *lines, "---", ""])


def indexed(phrases: Iterable[str]) -> str:
    """Enter phrases into the index of the site, where its search finds them first."""
    entries = (one.replace(";", ",") for one in phrases)
    return "\n".join(f"```{{index}} ! single: {one}\n```" for one in entries) + "\n"


def description_of(text: str) -> str:
    r"""Take the title and the first paragraph of a page for its description, without orders.

    Examples
    --------
    >>> description_of("# Normals\n\n```sh\nls\n```\n\nThey are [`A⁻ᵀn`](x.md).\n")
    'Normals. They are A⁻ᵀn.'
    """
    title, *paragraphs = re.split(r"\n\s*\n", text)
    first = next(one for one in paragraphs if re.match(r"[\w*\[(“\"\\]|`(?!``)", one.lstrip()))
    words = " ".join(f"{title.lstrip('# ')}. {first}".split())
    return re.sub(r"[`*]|\\(?=\W)", "", re.sub(r"!?\[([^\]]*)\]\([^)]*\)", r"\1", words))


def shortened(text: str) -> str:
    """Cut a text at the end of a sentence, else of a word.

    Examples
    --------
    >>> shortened("One. Two.")
    'One. Two.'
    >>> shortened("One two three four. " * 10)
    'One two three four. One two three four. One two three four. One two three four. \
One two three four. One two three four. One two three four. One two three four.'
    """
    if len(text) <= LONGEST:
        return text
    ends = [found.end() for found in re.finditer(r"[.?!](?= )", text[: LONGEST + 1])]
    if ends and ends[-1] > LONGEST // 2:
        return text[: ends[-1]]
    return text[: LONGEST - 1].rsplit(" ", 1)[0].rstrip(",;:") + "…"
