"""Nodes by name: every path and every address means its node, by a search of all of them."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from nmatrix.scene.hierarchy import ABOVE, DEEPEST, Hierarchy

NAMES = st.sampled_from(["a", "b", "a/b", "/", "", "#0", "#1", "##1", "-x", "a\nb", "…/a"])


@st.composite
def trees(draw: st.DrawFn) -> Hierarchy:
    """Build a forest whose nodes stand in any order."""
    size = draw(st.integers(1, 9))
    order = draw(st.permutations(range(size)))
    parents: list[int | None] = [None] * size
    for place, index in enumerate(order):
        if place and draw(st.booleans()):
            parents[index] = order[draw(st.integers(0, place - 1))]
    return Hierarchy(tuple(draw(NAMES) for _ in range(size)), tuple(parents))


def names_to(tree: Hierarchy, index: int) -> list[str]:
    above = tree.parents[index]
    return [*([] if above is None else names_to(tree, above)), tree.names[index]]


def expected(tree: Hierarchy, text: str) -> tuple[int, ...]:
    """Find the nodes whose whole path is the text, else those whose path ends in it."""
    paths = [names_to(tree, index) for index in range(len(tree.names))]
    whole = [i for i, names in enumerate(paths) if "/".join(names) == text]
    ends = [
        i
        for i, names in enumerate(paths)
        if text in ("/".join(names[k:]) for k in range(len(names)))
    ]
    return tuple(whole or ends)


@given(trees())
def test_an_address_means_its_node_alone_and_can_be_typed(tree: Hierarchy) -> None:
    assert len(set(tree.addresses)) == len(tree.names)
    for index, address in enumerate(tree.addresses):
        assert tree.meant(address) == (index,)
        assert address.isprintable()
        assert address.strip()
        assert not address.startswith("-")


@given(trees())
def test_a_path_means_the_nodes_that_have_it(tree: Hierarchy) -> None:
    for index in range(len(tree.names)):
        path = "/".join(names_to(tree, index))
        assert tree.path(index) == path
        assert tree.meant(path) == expected(tree, path)


@given(trees(), st.sampled_from(["a", "b", "a/b", "b/a", "a/a", "x", "/", "//", ""]))
def test_a_text_means_the_paths_that_end_in_it(tree: Hierarchy, text: str) -> None:
    assert tree.meant(text) == expected(tree, text)


def test_a_deep_node_shows_the_last_of_its_path_which_still_means_it() -> None:
    size = 3 * DEEPEST
    chain = Hierarchy(tuple(f"n{i}" for i in range(size)), (None, *range(size - 1)))
    path = chain.path(size - 1)
    assert path.startswith(ABOVE)
    assert path.count("/") == DEEPEST
    assert chain.meant(path) == (size - 1,)
    assert chain.meant("/".join(chain.names)) == (size - 1,)


def test_twins_are_told_apart_by_their_index() -> None:
    twins = Hierarchy(("cube", "cube"), (None, None))
    assert twins.addresses == ("#0", "#1")
    assert twins.meant("cube") == (0, 1)
    assert twins.meant("#2") == ()
    assert twins.meant("#" + "1" * 5000) == ()


def test_a_path_is_short_however_long_the_name_above_many_nodes_is() -> None:
    tree = Hierarchy(("R" * 10**6, *map(str, range(9))), (None, *(0,) * 9))
    assert [tree.path(i) for i in range(1, 10)] == [f"…/{i}" for i in range(9)]
    assert [tree.meant(tree.path(i)) for i in range(1, 10)] == [(i,) for i in range(1, 10)]
    assert tree.path(0) == tree.names[0]


def test_separators_in_names_cost_no_search_of_all_nodes_for_each(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    looks = []
    above = Hierarchy._above
    monkeypatch.setattr(Hierarchy, "_above", lambda *of: looks.append(of) or above(*of))
    size = 100
    names = [name for i in range(size) for name in (f"p{i}", "a/b")]
    parents = [above for i in range(size) for above in (None, 2 * i)]
    tree = Hierarchy(tuple(names), tuple(parents))
    assert tree.addresses[1::2] == tuple(f"p{i}/a/b" for i in range(size))
    assert len(looks) < 4 * len(names)


def test_a_name_that_spells_a_path_is_no_address_beside_that_path() -> None:
    deep = DEEPEST + 8
    names = (*"a" * deep, "/".join("a" * deep))
    tree = Hierarchy(names, (None, *range(deep - 1), None))
    assert [tree.meant(one) for one in tree.addresses] == [(i,) for i in range(deep + 1)]
