"""Counts and lists of names in a sentence, right for none, one, and thousands."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from nmatrix.errors import counted
from nmatrix.scene.hierarchy import ABOVE, LONGEST, SEPARATOR

NAMED = 5  # of a list
ROOM = 48  # characters of a path; its end tells it apart


def of_all(count: int, total: int, one: str, many: str, what: str = "node") -> str:
    """Begin a sentence about some of all things, with its verb for one and for many.

    Examples
    --------
    >>> of_all(0, 7, "needs", "need"), of_all(1, 7, "needs", "need"), of_all(7, 7, "needs", "need")
    ('None of 7 nodes needs', '1 of 7 nodes needs', '7 of 7 nodes need')
    >>> of_all(0, 1, "needs", "need"), of_all(1, 1, "needs", "need")
    ('0 of 1 node needs', '1 of 1 node needs')
    """
    if count == 0 and total != 1:
        return f"None of {counted(total, what)} {one}"
    return f"{count:,} of {counted(total, what)} {one if count == 1 or total == 1 else many}"


def elided(text: str, room: int = ROOM) -> str:
    r"""Keep the end of a long path, whose beginning tells it less well from others.

    It is cut between two names, so what is left means the same; only a name of more than twice the
    room is cut itself. Characters that would change the line are spelled out.

    Examples
    --------
    >>> elided("root/arm/hand", 11), elided("root/forearm", 6), elided("roothand", 3), elided("a\n")
    ('…/arm/hand', '…/forearm', '…nd', 'a\\n')
    """
    plain = text if text.isprintable() else repr(text[-room:])[1:-1]
    if len(plain) <= room:
        return plain
    end = plain[1 - room :]
    if SEPARATOR in end:
        return f"…{end[end.find(SEPARATOR) :]}"
    last = plain[plain.rfind(SEPARATOR) + 1 :]
    if len(last) > 2 * room:
        return f"…{end}"
    return last if last == plain else f"{ABOVE}{last}"


def told_apart(texts: Sequence[str], room: int) -> list[str]:
    """Shorten long paths, each by so little that no two different ones look alike.

    Examples
    --------
    >>> told_apart(["meshes/packed/box.glb", "meshes/embedded/box.glb", "meshes/ball.glb"], 9)
    ['…/packed/box.glb', '…/embedded/box.glb', '…/ball.glb']
    """
    alike: dict[str, dict[str, None]] = {}
    for text in texts:
        alike.setdefault(elided(text, room), {})[text] = None
    short = {text: shown for shown, group in alike.items() for text in group}
    for group in (tuple(one) for one in alike.values() if len(one) > 1):
        kept = 1
        while len({_end(text, kept) for text in group}) < len(group):
            kept += 1
        ends = {text: _end(text, kept) for text in group}
        if max(map(len, ends.values())) <= LONGEST:
            longer = {text: ABOVE + end if end != text else end for text, end in ends.items()}
            short |= {text: elided(shown, len(shown)) for text, shown in longer.items()}
    return [short[text] for text in texts]


def _end(path: str, names: int) -> str:
    return SEPARATOR.join(path.split(SEPARATOR)[-names:])


def named(texts: Iterable[str]) -> str:
    """List the first names and count the others.

    Examples
    --------
    >>> named("abcdefg")
    'a, b, c, d, e and 2 more'
    """
    listed = [elided(one) if one.strip() else repr(one) for one in texts]
    more = len(listed) - NAMED
    return ", ".join(listed[:NAMED]) + (f" and {more} more" if more > 0 else "")
