"""Nodes by name: paths from the root, and for each node one text that means no other.

A text means the nodes whose path ends in it, from one name to the whole path; where several do,
the one whose whole path it is. So `hand` is enough where one node is called so, `left/hand` where
two are, and a path that was copied whole always works unless two nodes share it: they are told
apart by their index, as `#7`.
"""

from __future__ import annotations

import re
from collections import Counter, defaultdict
from collections.abc import Iterable
from dataclasses import dataclass
from functools import cached_property

SEPARATOR = "/"
DEEPEST = 32  # names of a path that is shown, or that make a node's address
LONGEST = 200  # characters of an address
LONGEST_PATH = 1024  # of what stands above a node in a path that is shown
ABOVE = "…/"
_INDEX = re.compile(r"#+(\d+)")


@dataclass(frozen=True)
class Hierarchy:
    """The names of nodes and the index of each one's parent.

    Examples
    --------
    >>> tree = Hierarchy(("root", "hand", "arm", "hand"), (None, 0, 0, 2))
    >>> tree.path(3), tree.addresses
    ('root/arm/hand', ('root', 'root/hand', 'arm', 'arm/hand'))
    >>> tree.meant("hand"), tree.meant("arm/hand"), tree.meant("#3")
    ((1, 3), (3,), (3,))
    """

    names: tuple[str, ...]
    parents: tuple[int | None, ...]

    def path(self, index: int) -> str:
        """Join the names from the root to a node; of a deep one only the last."""
        names: list[str] = []
        length, at = 0, self.parents[index]
        while at is not None and len(names) < DEEPEST - 1:
            length += len(self.names[at]) + 1
            if length > LONGEST_PATH:  # of a name that thousands of nodes are under
                break
            names.append(self.names[at])
            at = self.parents[at]
        whole = SEPARATOR.join((*reversed(names), self.names[index]))
        return whole if at is None else ABOVE + whole

    def called(self, index: int) -> str:
        """Name a node by its path, with its address where others have the same one.

        Examples
        --------
        >>> tree = Hierarchy(("root", "wheel", "wheel"), (None, 0, 0))
        >>> tree.called(0), tree.called(2)
        ('root', 'root/wheel (#2)')
        """
        address = self.addresses[index]
        return f"{self.path(index)} ({address})" if address.startswith("#") else self.path(index)

    def meant(self, text: str) -> tuple[int, ...]:
        """Find the nodes that a text means: one, none, or several that it cannot tell apart."""
        found = self._ending(text)
        if not found and text.startswith(ABOVE):  # a path that is cut, where nothing is called so
            found = self._ending(text.removeprefix(ABOVE))
        return found

    def _ending(self, text: str) -> tuple[int, ...]:
        """Find the nodes whose path a text is, or else ends in it, or else whose index it is."""
        last = self._by_last_name(text)
        ending = [index for index in last if self._ends_in(index, text)]
        whole = [index for index in ending if self._is_whole_path(index, text)]
        if ending:
            return tuple(whole or ending)
        by_index = _INDEX.fullmatch(text)
        if by_index and len(by_index[1]) <= len(str(len(self.names))):
            found = int(by_index[1])
            return (found,) if found < len(self.names) else ()
        return ()

    def below(self, index: int) -> frozenset[int]:
        """Collect a node and every node that hangs below it.

        Examples
        --------
        >>> sorted(Hierarchy(("root", "arm", "lamp", "hand"), (None, 0, None, 1)).below(0))
        [0, 1, 3]
        """
        children = defaultdict(list)
        for child, parent in enumerate(self.parents):
            children[parent].append(child)
        waiting, found = [index], set[int]()
        while waiting:
            at = waiting.pop()
            found.add(at)
            waiting.extend(children[at])
        return frozenset(found)

    @cached_property
    def addresses(self) -> tuple[str, ...]:
        """The shortest text for each node that means it alone and can be typed."""
        found: list[str | None] = [None] * len(self.names)
        waiting = dict(enumerate(self.names))
        for depth in range(1, DEEPEST + 1):
            count, longer, roots = Counter(waiting.values()), {}, []
            for index, text in waiting.items():
                above = self._ancestor(index, depth)
                if count[text] == 1 and self._may_be_typed(text, index):
                    found[index] = text
                elif above is None:
                    roots.append((text, index))
                elif len(text) < LONGEST:
                    longer[index] = f"{self.names[above]}{SEPARATOR}{text}"
            count = Counter(text for text, _ in roots)
            for text, index in roots:  # whole paths, which others end in
                if count[text] == 1 and self._may_be_typed(text, index):
                    found[index] = text
            waiting = longer
        return tuple(
            self._by_number(index) if text is None else text for index, text in enumerate(found)
        )

    def _may_be_typed(self, text: str, index: int) -> bool:
        return self._is_clean(text) and (not self._has_separators or self._means(text, index))

    def _means(self, text: str, index: int) -> bool:
        """Tell whether a text in which a node's path ends means that node alone."""
        is_whole = self._is_whole_path(index, text)
        ending, whole = self._ending_in
        return whole[hash(text)] == 1 if is_whole else ending[hash(text)] == 1

    @cached_property
    def _ending_in(self) -> tuple[Counter[int], Counter[int]]:
        """Count the nodes whose path ends in a text, and those whose whole path it is, by hashes.

        Names may hold separators, so that a text can be cut into names in several ways; to look for
        all nodes of a text would take as long as there are nodes, for each of them.
        """
        ending, whole = Counter[int](), Counter[int]()
        for index in range(len(self.names)):
            text, above = self.names[index], self.parents[index]
            while len(text) <= LONGEST:
                ending[hash(text)] += 1
                if above is None:
                    whole[hash(text)] += 1
                    break
                text, above = f"{self.names[above]}{SEPARATOR}{text}", self.parents[above]
        return ending, whole

    def _is_clean(self, text: str) -> bool:
        plain = bool(text.strip()) and text.isprintable() and len(text) <= LONGEST
        return plain and not text.startswith(("#", "-", ABOVE))

    def _by_number(self, index: int) -> str:
        text = f"#{index}"
        while self.meant(text) != (index,):  # a node is called so
            text = f"#{text}"
        return text

    @cached_property
    def _named(self) -> dict[str, list[int]]:
        found = defaultdict(list)
        for index, name in enumerate(self.names):
            found[name].append(index)
        return found

    @cached_property
    def _has_separators(self) -> bool:
        return any(SEPARATOR in name for name in self._named)

    def _by_last_name(self, text: str) -> Iterable[int]:
        """Find the nodes whose own name ends the text, in their order."""
        starts = [at for at in range(len(text) + 1) if at == 0 or text[at - 1] == SEPARATOR]
        return sorted(index for at in starts for index in self._named.get(text[at:], ()))

    def _ends_in(self, index: int, text: str) -> bool:
        return self._above(index, text) is not None

    def _is_whole_path(self, index: int, text: str) -> bool:
        above = self._above(index, text)
        return above is not None and above[0] is None

    def _above(self, index: int, text: str) -> tuple[int | None] | None:
        """Walk up a path as long as it ends in a text; return the node above, if it all fits."""
        at: int | None = index
        rest = text
        while at is not None:
            name = self.names[at]
            if rest == name:
                return (self.parents[at],)
            if not rest.endswith(f"{SEPARATOR}{name}"):
                return None
            rest = rest[: -len(name) - 1]
            at = self.parents[at]
        return None

    def _ancestor(self, index: int, steps: int) -> int | None:
        at: int | None = index
        for _ in range(steps):
            if at is None:
                return None
            at = self.parents[at]
        return at
