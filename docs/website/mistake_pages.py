"""A page for each mistake that `check` names, and what search engines read of each lint rule."""

from __future__ import annotations

import re
from collections.abc import Iterator

from markdown import head, indexed, plain
from runs import transcript
from symptoms import MISTAKES as SYMPTOMS
from symptoms import RULES, Symptom

from nmatrix.lessons.check.mistake import Mistake, MistakeId
from nmatrix.lessons.check.mistakes import MISTAKES
from nmatrix.linting.rules import LINT_RULES, RuleId
from nmatrix.raster.proofs.catalogue import PROOFS

CLAIMS = {one.name: one.claim for one in PROOFS}
# A row of the list in docs/mistakes.md, the head of that list, and a mistake in a page of lint.
ROW = re.compile(r"^\| `([\w-]+)` \|", re.MULTILINE)
NAMED = re.compile(r"the mistake `([\w-]+)`")


def written() -> Iterator[tuple[str, str]]:
    """Write the pages of the mistakes; give names and texts."""
    for mistake, told in MISTAKES.items():
        yield f"mistakes/{mistake}.md", page(mistake, told, SYMPTOMS[mistake])


def page(mistake: MistakeId, told: Mistake, symptom: Symptom) -> str:
    """Write one page."""
    lines = [head(f"{symptom.seen}. {told.explanation}", [mistake, *symptom.searched])]
    lines += [f"# {plain(symptom.seen)}\n", indexed([mistake, symptom.seen, *symptom.searched])]
    lines += [f"{plain(told.did)} **{plain(told.rule)}**\n"]
    lines += [f"[`nmatrix check`](../commands/check.md) calls it `{mistake}`.\n"]
    lines += ["## An example with numbers\n", transcript(symptom.command)]
    if symptom.picture:
        lines += ["## How it looks\n", _picture(symptom.picture)]
    lines += ["## How to put it right\n", f"{plain(symptom.cure.where)}:\n"]
    lines += [f"```{symptom.cure.language}\n{symptom.cure.lines}\n```\n"]
    lines += ["And nmatrix computes it, exactly:\n", transcript(told.command)]
    lines += ["## Also searched as\n", *(f"* {plain(one)}" for one in symptom.searched), ""]
    lines += ["## See also\n", *_related(mistake)]
    return "\n".join(lines)


def _picture(proof: str) -> str:
    claim = CLAIMS[proof]
    link = f"../gallery.md#{proof}"
    return f"[![{plain(claim)}](../pictures/{proof}.png)]({link})\n\n`nmatrix render {proof}`\n"


def _related(mistake: MistakeId) -> list[str]:
    """Link the lint rules that are this mistake, its neighbours, and the list."""
    lines = [
        f"* Lint rule [{rule.value}: {plain(one.name)}](../lint/{rule.value}.md)"
        for rule, one in LINT_RULES.items()
        if one.mistake == mistake
    ]
    alike = SYMPTOMS[mistake].cure
    lines += [
        f"* [{plain(one.seen)}]({other}.md)"
        for other, one in SYMPTOMS.items()
        if one.cure is alike and other is not mistake
    ]
    return [*lines, "* [All mistakes that `check` names](../mistakes.md)\n"]


def listed(text: str) -> str:
    """Let the list of the mistakes lead to their pages, and add what they look like."""
    names = set(MistakeId)
    first, marker, rest = text.partition("\n## All mistakes by name\n")
    rows = ROW.sub(
        lambda row: f"| [`{row[1]}`](mistakes/{row[1]}.md) |" if row[1] in names else row[0], rest
    )
    seen = "\n".join(f"* [{plain(one.seen)}](mistakes/{id_}.md)" for id_, one in SYMPTOMS.items())
    pages = "\n".join(f"{_short(one)} <mistakes/{id_}>" for id_, one in SYMPTOMS.items())
    index = f"```{{toctree}}\n:hidden:\n\n{pages}\n```\n"
    symptoms = f"\n## Symptoms: what you see\n\n{seen}\n"
    return f"{first}{symptoms}{marker}{rows}\n{index}"


def _short(symptom: Symptom) -> str:
    """Take what one sees, without why: enough for a list of contents."""
    return symptom.seen.partition(":")[0]


def rule_page(rule: RuleId, text: str) -> str:
    """Let search engines read what people type, and link the mistake that a rule is."""
    told, words = LINT_RULES[rule], RULES[rule]
    title, _, rest = NAMED.sub(r"the mistake [`\1`](../mistakes/\1.md)", text).partition("\n")
    summary = f"{rule.value}: {told.sentence} {told.advice}"
    also = "\n".join(f"* {plain(one)}" for one in words)
    lines = [head(summary, [rule.value, *words]), title, ""]
    lines += [indexed([rule.value, told.name, *words]), rest.rstrip(), ""]
    return "\n".join([*lines, "## Also searched as\n", also, ""])
