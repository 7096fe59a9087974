"""The scheme `nmatrix/1`: how a seed, a student and a number become draws, the same everywhere.

A hash of all that names an exercise seeds Python's generator, of which only `random()` is used:
the one method whose sequence Python documents as stable. Each part of the hash is preceded by its
length, so that no two different inputs look alike.
"""

from __future__ import annotations

import random
from collections.abc import Sequence
from dataclasses import dataclass
from hashlib import blake2b
from typing import TypeVar
from unicodedata import normalize

SCHEME = "nmatrix/1"

Item = TypeVar("Item")


@dataclass(frozen=True)
class Sheet:
    """Whose sheet it is: a seed for the class, a student, a salt that only the teacher knows."""

    seed: str = "1"
    student: str = ""
    salt: bytes = b""

    @property
    def parts(self) -> tuple[bytes, ...]:
        """The parts that are hashed; names that look alike in Unicode are alike."""
        name = normalize("NFC", " ".join(self.student.split()))
        seed, whose = (_bytes(one) for one in (self.seed.strip(), name))
        return (SCHEME.encode(), self.salt, seed, whose)


def _bytes(text: str) -> bytes:
    """Encode a text; a shell passes on what is none, a byte of it as half a character."""
    return text.encode("utf-8", "surrogatepass")


class Draws:
    """The draws of one attempt at one exercise.

    Examples
    --------
    >>> Draws(Sheet("1", "Ada"), 1, 0).choice("abc") in "abc"
    True
    """

    def __init__(self, sheet: Sheet, number: int, attempt: int) -> None:
        self.number = number
        counted = b"".join(
            len(part).to_bytes(8, "big") + part
            for part in (*sheet.parts, str(number).encode(), str(attempt).encode())
        )
        digest = blake2b(counted, digest_size=16).digest()
        self._random = random.Random(int.from_bytes(digest, "big"))

    def randbelow(self, count: int) -> int:
        """Draw a whole number from 0 to count − 1."""
        return int(self._random.random() * count)

    def choice(self, items: Sequence[Item]) -> Item:
        """Draw one of some items."""
        return items[self.randbelow(len(items))]

    def several(self, items: Sequence[Item], count: int) -> tuple[Item, ...]:
        """Draw so many different items, in a drawn order."""
        left = list(items)
        return tuple(left.pop(self.randbelow(len(left))) for _ in range(count))

    def shuffled(self, items: Sequence[Item]) -> tuple[Item, ...]:
        """Draw an order of all items."""
        return self.several(items, len(items))
