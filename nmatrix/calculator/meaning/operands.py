"""What the rules of spaces are about: things with their texts, and the refusal of an operation."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum

from nmatrix.calculator.arithmetic.meanings import Carries, Kind, Located, Map
from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.enums import Frame
from nmatrix.lessons.check.mistake import MistakeId

LONGEST_NAME = 60  # characters of an operand in a sentence
UNDIVIDED = Located(Frame.CLIP, Kind.POINT)


class Sort(StrEnum):
    """What a rule can see of a value."""

    NUMBER = "a number"
    BARE = "a vector or a matrix of which nothing is known"
    POINT = "a point"
    DIRECTION = "a direction"
    NORMAL = "a normal"
    VECTOR = "a vector"
    PLACES = "a map"
    NORMALS = "a map for normals"
    BACK = "a transposed map"
    FLIPPED = "a map of cofactors"
    ALL = "a rotation"


@dataclass(frozen=True)
class Operand:
    """A value, the text that it comes from, and where that begins; None if it was not written."""

    value: Value
    text: str = "it"
    start: int | None = None

    @property
    def sort(self) -> Sort:
        """What a rule can see of it."""
        match self.value.meaning:
            case Map(carries=carries):
                return Sort[carries.name]
            case Located(kind=kind):
                return Sort[kind.name]
        return Sort.NUMBER if self.value.kind is ValueKind.SCALAR else Sort.BARE

    @property
    def space(self) -> Frame | None:
        """The space that it is in, where that is known."""
        meaning = self.value.meaning
        return meaning.space if isinstance(meaning, Located) else None

    @property
    def map(self) -> Map:
        """The map that a matrix is; one of which nothing is known may lead anywhere."""
        meaning = self.value.meaning
        return meaning if isinstance(meaning, Map) else Map(carries=Carries.ALL)

    @property
    def is_undivided(self) -> bool:
        """Whether it is a point of clip space, whose x, y and z say nothing without its w."""
        return self.value.meaning == UNDIVIDED

    @property
    def name(self) -> str:
        """Its text, cut where it is long, to speak of it."""
        text = " ".join(self.text.split())
        return text if len(text) <= LONGEST_NAME else f"{text[:LONGEST_NAME]}…"


class RefusedError(Exception):
    """An operation that no graphics programmer means.

    `forms` are right forms of the same expression, `swaps` right forms of operands in it, and
    `apart` are operands in two spaces.
    """

    def __init__(
        self,
        why: str,
        mistake: MistakeId | None = None,
        *,
        forms: Iterable[str] = (),
        swaps: Iterable[tuple[Operand, str]] = (),
        apart: tuple[Operand, ...] = (),
    ) -> None:
        super().__init__(why)
        self.why, self.mistake, self.forms = why, mistake, tuple(forms)
        self.swaps, self.apart = tuple(swaps), apart


def together(*operands: Operand) -> Frame | None:
    """Find the one space that all operands are in, as far as it is known.

    Raises
    ------
    RefusedError
        For two spaces, or a point of clip space that was not divided by its w.
    """
    if any(one.is_undivided for one in operands):
        raise undivided(*operands)
    known = [one for one in operands if one.space is not None]
    for other in known[1:]:
        if other.space is not known[0].space:
            first = known[0]
            why = f"{first.name} is in {first.space} space, {other.name} in {other.space} space"
            raise RefusedError(why, apart=(first, other))
    return known[0].space if known else None


def undivided(*operands: Operand) -> RefusedError:
    """Make the refusal of points of clip space where their places are asked for."""
    swaps = []
    for one in operands:
        if one.is_undivided:
            whole = factor(one.text.removesuffix(".xyz"))
            swaps.append((one, f"({whole}.xyz / {whole}.w)"))
    first = swaps[0][0].name
    return RefusedError(f"{first} is in clip space and not yet divided by its w", swaps=swaps)


def factor(text: str) -> str:
    """Put a text in parentheses where an operator in it could take what stands beside it.

    Examples
    --------
    >>> factor("a - b"), factor("dot(a - b, c)"), factor("(a)[0]")
    ('(a - b)', 'dot(a - b, c)', '(a)[0]')
    """
    depth = 0
    for letter in text:
        depth += (letter in "([{") - (letter in ")]}")
        if not depth and letter in "+-*/@·×=≈~√^":
            return f"({text})"
    return text


def bared(text: str) -> str:
    """Leave out parentheses around the whole of a text.

    Examples
    --------
    >>> bared("(a - b)"), bared("(a) - (b)")
    ('a - b', '(a) - (b)')
    """
    inside = text[1:-1]
    return inside if text == f"({inside})" == factor(text) else text
