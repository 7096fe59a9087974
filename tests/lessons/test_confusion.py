"""How well the mistakes are told apart, counted; docs/mistakes.md shows the same table."""

from __future__ import annotations

import random
from collections import Counter

import pytest
from mistakes import ALSO, PAGE, SCENES, confusion, counted, listed, questions, scene, typed

from nmatrix.lessons.check.judge import SEVERAL, Judge, Outcome
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


def test_two_mistakes_at_once_are_named_unless_one_or_another_pair_gives_the_same_numbers():
    draw = random.Random(1)
    outcomes = Counter()
    for question in questions(scene(draw), draw):
        judge = Judge(question)
        for pair in draw.sample(judge.doubles, min(8, len(judge.doubles))):
            found = judge.judge(typed(pair.value))
            if found.verdict is not Outcome.CORRECT:  # not even wrong to six decimals
                is_listed = found.explanation.startswith(SEVERAL)
                assert found.mistakes or "+".join(pair.mistakes) in found.explanation
                named = found.mistakes == pair.mistakes
                outcomes["named" if named else "listed" if is_listed else "another"] += 1
    assert outcomes["named"] > 0.7 * outcomes.total() > 40
