"""A notebook as a page: its text, its code, and what its cells showed when they ran."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from typing import Any

from markdown import description_of, head

FORMULA = re.compile(r"(\$\$?)([^$]+)\1")


def as_markdown(notebook: str) -> str:
    """Write a notebook as Markdown; of what a cell showed, the richest that a page can hold."""
    cells = json.loads(notebook)["cells"]
    text = "\n".join(part for cell in cells for part in _cell(cell))
    return head(description_of(text)) + text


def _cell(cell: dict[str, Any]) -> Iterator[str]:
    source = "".join(cell["source"])
    if cell["cell_type"] == "markdown":
        yield FORMULA.sub(_formula, source) + "\n"
        return
    yield f"```python\n{source}\n```\n"
    for one in cell.get("outputs", ()):
        yield _shown(one.get("data", {"text/plain": one.get("text", "")}))


def _formula(found: re.Match[str]) -> str:
    if found[1] == "$":
        return f"{{math}}`{found[2]}`"
    return f"\n```{{math}}\n{found[2].strip()}\n```\n"


def _shown(data: dict[str, Any]) -> str:
    """Write one output of a cell."""
    if "image/png" in data:
        picture = "".join(data["image/png"]).replace("\n", "")
        alt = "".join(data.get("text/plain", "A picture")).replace('"', "")
        return f'```{{raw}} html\n<img alt="{alt}" src="data:image/png;base64,{picture}">\n```\n'
    if "text/html" in data:
        page = "".join(data["text/html"])
        return f'````{{raw}} html\n<div class="cell-output">{page}</div>\n````\n'
    return f"```text\n{''.join(data.get('text/plain', ''))}\n```\n"
