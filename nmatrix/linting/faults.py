"""Findings on their way: what is told of a place, and what is known of a whole program."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, field

from nmatrix.enums import Severity
from nmatrix.linting.rules import LINT_RULES, PARTICULAR_FIRST, RuleId
from nmatrix.linting.tree import Expression, Span, Stage
from nmatrix.linting.values import Matrix, ShaderSpace, Vector


@dataclass(frozen=True)
class Parts:
    """The pieces of an expression that a correction changes.

    `missing` is the function that must be applied to the matrix too, `order` the right order of the
    factors of a product, `met` are the two vectors that must not meet.
    """

    matrix: Expression | None = None
    vector: Expression | None = None
    missing: str = ""
    order: tuple[int, ...] = ()
    met: tuple[Vector, Vector] | None = None


NO_PARTS = Parts()
MISTAKE_OF_MISSING = {"transpose": "not-transposed", "inverse": "not-inverted"}


@dataclass(frozen=True)
class Fault:
    """One place where spaces meet that must not, and both of them."""

    rule: RuleId
    severity: Severity
    span: Span
    message: str
    left: str = ""
    right: str = ""
    expression: Expression | None = None
    parts: Parts = NO_PARTS

    @property
    def mistake(self) -> str | None:
        """The id of `check` for it; half an inverse transpose is one of two."""
        return MISTAKE_OF_MISSING.get(self.parts.missing, LINT_RULES[self.rule].mistake)


@dataclass
class Evidence:
    """What a first reading of a program shows about all of it.

    Parameters
    ----------
    sides
        How many points stand on the right (False) and on the left (True) of named matrices.
    lights
        Uniforms that a view matrix moves.
    has_model
        Whether a matrix moves what is in object space.
    has_view
        Whether a matrix leads from world to camera space.
    projects_world
        Whether a projection stands right before what the names take for the world: without a view
        matrix, nobody knows where the model matrix leads.
    """

    sides: Counter[bool] = field(default_factory=Counter)
    lights: dict[str, ShaderSpace] = field(default_factory=dict)
    has_model: bool = False
    has_view: bool = False
    projects_world: bool = False


class Telling:
    """Findings of a program by their places; of two at one place the more particular one stays."""

    def __init__(self, evidence: Evidence) -> None:
        self.evidence = evidence
        self.stage = Stage.UNKNOWN
        self.is_gated = False  # whether a comparison let through what is evaluated
        self.is_turned = False  # whether a scalar product gets a minus
        self._parts = NO_PARTS
        self._moves: dict[str, Expression] = {}
        self._calls: dict[str, Expression] = {}
        self._halves: dict[str, Expression] = {}
        self.faults: dict[tuple[str, int, int], Fault] = {}
        self.factors: dict[Span, tuple[Matrix, ...]] = {}
        self._told_once: set[tuple[str, str]] = set()

    def tell(
        self,
        rule: RuleId,
        at: Expression,
        message: str,
        spaces: tuple[str, str] = ("", ""),
        severity: Severity | None = None,
        *,
        parts: Parts | None = None,
    ) -> None:
        """Keep a fault; of two at one place the more particular one stays."""
        if not at.span.file:
            return
        key = at.span.file, at.span.start, at.span.end
        before = self.faults.get(key)
        if before is not None and _rank(before.rule) <= _rank(rule):
            return
        weight = LINT_RULES[rule].severity if severity is None else severity
        given = self._parts if parts is None else parts
        self.faults[key] = Fault(rule, weight, at.span, message, *spaces, at, given)

    def space_of(self, vector: Vector) -> ShaderSpace | None:
        """Tell the space of a vector, unless it is only that of a mesh which nothing moves."""
        if vector.is_assumed and not self.evidence.has_model:
            return None
        return vector.space

    def _is_first(self, at: Expression, one: Vector) -> bool:
        """Whether a file has not been told of this vector."""
        key = at.span.file, one.origin or one.told
        is_first = key not in self._told_once
        self._told_once.add(key)
        return is_first


def _rank(rule: RuleId) -> int:
    try:
        return PARTICULAR_FIRST.index(rule)
    except ValueError:
        return len(PARTICULAR_FIRST)
