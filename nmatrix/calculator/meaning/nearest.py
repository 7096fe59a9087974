"""The nearest right form of an expression that the rules of spaces refuse.

Forms are written down in the order of nearness; the first one that has a value and is not refused
itself is told. In the last of them the space of an operand is forgotten on purpose, so there is
always one.
"""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise, permutations

from nmatrix.calculator.arithmetic.meanings import FOR_NORMALS, SCENE, Located, Map, Meaning
from nmatrix.calculator.arithmetic.values import ValueKind
from nmatrix.calculator.meaning.operands import Operand, RefusedError, Sort, factor
from nmatrix.calculator.meaning.rules import PROJECTED
from nmatrix.enums import Frame

LONGEST = 5  # factors of a product that are put in another order
_MADE_OF = re.compile(
    r"(?:inverse|transpose|inverse_transpose|normal_matrix|cofactor|adjugate|linear)\((?P<in>.*)\)"
    r"|(?P<base>.+?)(?:\.T|\.inv|\^-?T|\^-1)"
)


@dataclass(frozen=True)
class Part:
    """A part of an expression: its text, where it begins, and its operands from left to right.

    Of a product these are all factors of the chain, and `rest` is what follows the refused part.
    """

    text: str
    start: int
    operands: tuple[Operand, ...]
    is_product: bool = False
    rest: str = ""

    def with_texts(self, texts: Mapping[int, str]) -> str:
        """Write the part with other texts for some operands, by their places."""
        written, end = [], self.start
        for place, operand in enumerate(self.operands):
            start = operand.start or 0
            before = self.text[end - self.start : start - self.start]
            written += [before, texts.get(place, operand.text)]
            end = start + len(operand.text)
        return "".join([*written, self.text[end - self.start :]])


def forms(refused: RefusedError, part: Part, names: dict[str, Meaning | None]) -> Iterator[str]:
    """Write the forms that may be meant, the nearest first.

    Parameters
    ----------
    refused
        The refusal, which may know forms of its own.
    part
        What was refused.
    names
        What the names of the expression mean.
    """
    led = {
        name: one
        for name, one in (SCENE | names).items()
        if isinstance(one, Map) and one.carries not in FOR_NORMALS
    }
    yield from (f"{form}{part.rest}" for form in refused.forms)
    if refused.swaps:
        yield _swapped(part, *refused.swaps)
    yield from _brought_together(refused, part, led)
    if part.is_product:
        yield from _products(part, led)
    yield from _forgetting(part)


def _swapped(part: Part, *swaps: tuple[Operand, str]) -> str:
    texts = {operand.start: text for operand, text in swaps}
    starts = enumerate(one.start for one in part.operands)
    return part.with_texts({i: texts[start] for i, start in starts if start in texts})


def _brought_together(refused: RefusedError, part: Part, led: Mapping[str, Map]) -> Iterator[str]:
    """Carry one of two things into the space of the other, forwards if a way leads there."""
    pairs = [(one, other) for one in refused.apart for other in refused.apart if one is not other]
    for with_inverses in (False, True):
        for one, other in pairs:
            if one.space and other.space and one.start is not None:
                way = _way(one.space, other.space, led, with_inverses=with_inverses)
                if way:
                    moved = _carried(one, way)
                    yield _swapped(part, (one, moved))
                    yield _swapped(part, (one, f"({moved})"))


def _carried(one: Operand, way: Sequence[str]) -> str:
    """Write how a thing is carried along a way."""
    product = " @ ".join(way)
    if one.sort is Sort.NORMAL:
        return f"normal_matrix({product}) @ {factor(one.text)}"
    if one.sort is Sort.VECTOR:
        return f"linear({product}) @ {factor(one.text)}"
    return f"{product} @ {factor(one.text)}"


def _way(
    start: Frame, end: Frame, led: Mapping[str, Map], *, with_inverses: bool
) -> tuple[str, ...]:
    """Find the shortest product of named maps from a space to another, as its factors.

    Examples
    --------
    >>> _way(Frame.OBJECT, Frame.CLIP, SCENE, with_inverses=False)
    ('P', 'V', 'M')
    """
    steps = [(one.source, one.to, name) for name, one in led.items()]
    if with_inverses:
        steps += [(one.to, one.source, f"inverse({name})") for name, one in led.items()]
    ways: dict[Frame, tuple[str, ...]] = {start: ()}
    ends = deque([start])
    while ends:
        here = ends.popleft()
        for source, to, name in steps:
            if source is here and to is not None and to not in ways:
                ways[to] = (name, *ways[here])
                ends.append(to)
    return ways.get(end, ())


def _products(part: Part, led: Mapping[str, Map]) -> Iterator[str]:
    """Write products of the same things: in another order, with one changed, more, or fewer."""
    operands = part.operands
    is_vector = operands[-1].value.kind is ValueKind.VECTOR
    last = operands[-1:] if is_vector else ()
    maps = operands[:-1] if is_vector else operands
    texts = [factor(one.text) for one in maps]
    end = [factor(one.text) for one in last]
    if len(maps) <= LONGEST:
        yield from (" @ ".join([*order, *end]) for order in permutations(texts))
    for i, one in enumerate(maps):
        for other in _variants(one.text, is_vector=is_vector):
            yield " @ ".join([*texts[:i], other, *texts[i + 1 :], *end])
    if last and last[0].sort is Sort.NORMAL:
        yield f"normal_matrix({' @ '.join(texts)}) @ {end[0]}"
    end_space = maps[0].map.to
    if last and last[0].sort is Sort.NORMAL and end_space in PROJECTED:
        end_space = Frame.CAMERA  # the last one in which there is light
    if last and last[0].space and end_space:
        way = _way(last[0].space, end_space, led, with_inverses=False)
        if way:
            yield _carried(last[0], way)
    yield from _bridged([*maps, *last], led)
    if is_vector and len(maps) > 1:
        yield from (" @ ".join([*texts[:i], *texts[i + 1 :], *end]) for i in range(len(texts)))


def _variants(text: str, *, is_vector: bool) -> Iterator[str]:
    """Write what a matrix is made of, its inverse and its normal matrix."""
    found = _MADE_OF.fullmatch(text)
    inside = (found["in"] or found["base"]) if found else text
    if found:
        yield factor(inside)
    if found or is_vector:
        yield f"inverse({inside})"
        yield f"normal_matrix({inside})"


def _bridged(factors: Sequence[Operand], led: Mapping[str, Map]) -> Iterator[str]:
    """Put a way between two factors that do not meet."""
    texts = [factor(one.text) for one in factors]
    for i, (one, other) in enumerate(pairwise(factors), 1):
        start = other.space or other.map.to
        if start and one.map.source:
            way = _way(start, one.map.source, led, with_inverses=False)
            if way:
                yield " @ ".join([*texts[:i], *way, *texts[i:]])


def _forgetting(part: Part) -> Iterator[str]:
    """Forget what an operand means, the first, another, or all of them."""
    places = range(len(part.operands))
    forgotten = [tuple(_untyped(part, i)) for i in places]
    for i in places:
        yield from (part.with_texts({i: text}) for text in forgotten[i])
    for choice in (0, -1):
        yield part.with_texts({i: forgotten[i][choice] for i in places})


def _untyped(part: Part, place: int) -> Iterator[str]:
    operand = part.operands[place]
    text = f"untyped({operand.text})"
    yield text
    if operand.value.kind is ValueKind.VECTOR:  # four may be written, where three are compared
        yield f"untyped({factor(operand.text)}.xyz)"
    if part.is_product and isinstance(operand.value.meaning, Located):
        yield from (f"point({text})", f"vector({text})")
