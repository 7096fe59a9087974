"""One decision: is an effect called for, why, and how safe is it to leave out."""

from __future__ import annotations

from dataclasses import dataclass

from nmatrix.enums import Effect, LeftOut


@dataclass(frozen=True)
class Decision:
    """Whether an effect is on, why, and what leaving it out costs at the most."""

    effect: Effect
    on: bool
    because: str
    kind: LeftOut = LeftOut.EXACT
    bound: float = 0.0


Verdict = tuple[bool, str] | tuple[bool, str, LeftOut, float]
