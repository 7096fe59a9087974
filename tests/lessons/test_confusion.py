"""How well the mistakes are told apart, counted; docs/mistakes.md shows the same table."""

from __future__ import annotations

import pytest
from mistakes import ALSO, PAGE, SCENES, confusion, counted, listed

from nmatrix.lessons.check.mistake import MistakeId

ENOUGH = 0.95


def test_no_mistake_is_given_another_name():
    found = confusion(range(4))
    for made, counts in found.items():
        assert {name for name in counts if not name.startswith(ALSO)} <= {made.value}


def test_the_list_in_the_documentation_is_the_table():
    assert listed() in PAGE.read_text(encoding="utf-8")


@pytest.mark.slow
def test_each_mistake_is_named_in_nearly_every_scene_and_the_documentation_counts_it():
    found = confusion(range(SCENES))
    for made in MistakeId:
        named = found[made][made.value]
        beside = sum(count for name, count in found[made].items() if name.startswith(ALSO))
        assert named > 0, "each is named first somewhere"
        assert named + beside >= ENOUGH * found[made].total()
    assert counted(found) in PAGE.read_text(encoding="utf-8")
