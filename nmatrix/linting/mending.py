"""A correction is offered only if the program is better after it: it is linted again to know.

Of several changes that may mend a finding the one is taken that leaves the fewest findings and
brings none. What is told once in a file is mended wherever it comes to light, or nowhere.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple

from nmatrix.enums import Severity, ShaderLanguage
from nmatrix.linting.faults import Fault
from nmatrix.linting.fixes import Change, candidates, unmendable
from nmatrix.linting.program import Linted, lint, programs
from nmatrix.linting.rules import RuleId
from nmatrix.linting.tree import Shader

TOLD_ONCE = frozenset({RuleId.NOT_NORMALISED})  # in a file of each vector
MOST_TOGETHER = 6  # changes that mend one finding
MOST_READ = 1_000_000  # bytes of a program that are read again, so that the work grows with files


@dataclass(frozen=True)
class Correction:
    """What becomes of a finding: the line after its change, or why there is none."""

    line: str | None = None
    reason: str | None = None
    is_gone: bool = False  # with the changes of others


@dataclass(frozen=True)
class Mended:
    """The sources after all corrections, and the correction of each finding, in their order."""

    sources: Mapping[str, bytes]
    corrections: tuple[Correction, ...]


def mended(
    sources: Mapping[str, bytes],
    linted: Linted,
    language: ShaderLanguage | None = None,
    *,
    are_one_program: bool = False,
) -> Mended:
    """Correct what can be corrected without a new finding; a note about costs may come.

    Examples
    --------
    >>> text = {"a.frag": b"in vec3 vNormal; void main() { float d = dot(vNormal, vec3(1.0)); }"}
    >>> mended(text, lint(text)).corrections[0].line
    'in vec3 vNormal; void main() { float d = dot(normalize(vNormal), vec3(1.0)); }'
    """
    shaders = linted.shaders
    together = [tuple(shaders)] if are_one_program else programs(shaders)
    found: dict[Fault, Correction] = {}
    after = dict(sources)
    for program in together:
        names = {one.file for one in program}
        faults = tuple(one for one in linted.faults if one.span.file in names)
        if faults:
            own = {name: text for name, text in sources.items() if name in names}
            mending = _Program(own, program, faults, language)
            found |= mending.corrections()
            after |= mending.state.sources
    return Mended(after, tuple(found[one] for one in linted.faults))


class _Place(NamedTuple):
    """A finding wherever changes have moved it: its rule, weight and place in the given text."""

    rule: RuleId
    severity: Severity
    file: str
    start: int


@dataclass(frozen=True)
class _Made:
    """A change that was made, and what had stood there."""

    change: Change
    before: bytes

    def back(self, place: int) -> int:
        """Find where a byte stood before the change."""
        start, old, new = self.change.span.start, self.before, self.change.text.encode()
        inside = place - start
        if inside < 0:
            return place
        if inside >= len(new):
            return place - len(new) + len(old)
        kept = new.find(old)  # what was wrapped is still there
        return start + inside - kept if 0 <= inside - kept < len(old) and kept >= 0 else start


@dataclass(frozen=True)
class _State:
    """A program after some changes, with its findings."""

    sources: Mapping[str, bytes]
    shaders: Sequence[Shader]
    faults: Sequence[Fault]
    made: tuple[_Made, ...] = ()

    def place_of(self, fault: Fault) -> _Place:
        start = fault.span.start
        for one in reversed(self.made):
            if one.change.span.file == fault.span.file:
                start = one.back(start)
        return _Place(fault.rule, fault.severity, fault.span.file, start)

    @property
    def places(self) -> Counter[_Place]:
        return Counter(map(self.place_of, self.faults))

    def fault_at(self, place: _Place) -> Fault | None:
        return next((one for one in self.faults if self.place_of(one) == place), None)

    @property
    def weight(self) -> tuple[int, int, int]:
        """Count what weighs, then the changes, then the notes."""
        notes = sum(one.severity is Severity.NOTE for one in self.faults)
        return len(self.faults) - notes, len(self.made), notes

    def candidates(self, fault: Fault) -> Iterable[Change]:
        file = fault.span.file
        (shader,) = (one for one in self.shaders if one.file == file)
        return candidates(fault, shader, self.sources[file])

    def with_change(self, change: Change) -> bytes:
        """Write the file of a change as it is after it."""
        text, span = self.sources[change.span.file], change.span
        return text[: span.start] + change.text.encode() + text[span.end :]

    def line_after(self, change: Change) -> str:
        """Write the lines of a change as they are after it."""
        text, start = self.with_change(change), change.span.start
        first = text.rfind(b"\n", 0, start) + 1
        last = text.find(b"\n", start + len(change.text.encode()))
        return text[first : last if last >= 0 else len(text)].decode("utf-8", "replace").rstrip()


class _Program:
    """One program on its way from the given text to a better one."""

    def __init__(
        self,
        sources: Mapping[str, bytes],
        shaders: Sequence[Shader],
        faults: Sequence[Fault],
        language: ShaderLanguage | None,
    ) -> None:
        self.given = faults
        self.state = _State(sources, shaders, faults)
        self.language = language
        self.left = MOST_READ

    def corrections(self) -> dict[Fault, Correction]:
        """Try every finding in its turn."""
        return {one: self._corrected(one) for one in self.given}

    def _corrected(self, fault: Fault) -> Correction:
        start = _State({}, (), ()).place_of(fault)
        now = self.state.fault_at(start)
        if now is None:
            return Correction(reason="what mends another finding mends it too", is_gone=True)
        shader = next(one for one in self.state.shaders if one.file == fault.span.file)
        reason = unmendable(now, shader)
        if reason is not None:
            return Correction(reason=reason)
        tried = [
            (state, change)
            for change in self.state.candidates(now)
            if (state := self._after(self.state, change)) is not None
        ]
        if not tried:
            is_short = self.left > 0
            told = (
                "the source does not tell what was meant"
                if is_short
                else "too many changes were tried before"
            )
            return Correction(reason=told)
        better = [(state, change) for state, change in tried if self._is_better(state, start)]
        if not better:
            chains = [(self._completed(state, start), change) for state, change in tried]
            better = [(state, change) for state, change in chains if state is not None]
        if not better:
            return Correction(reason="what was tried leaves it, or brings another finding")
        best, change = min(better, key=lambda one: one[0].weight)
        line = self.state.line_after(change)
        self.state = best
        return Correction(line)

    def _after(self, state: _State, change: Change) -> _State | None:
        """Make a change and lint again, unless too much was read already."""
        if self.left <= 0:
            return None
        self.left -= sum(map(len, state.sources.values()))
        file, start, end = change.span
        sources = {**state.sources, file: state.with_change(change)}
        found = lint(sources, self.language, are_one_program=True)
        made = _Made(change, state.sources[file][start:end])
        return _State(sources, found.shaders, found.faults, (*state.made, made))

    def _new(self, state: _State) -> Counter[_Place]:
        """Collect the findings that a change has brought; one about costs says nothing wrong."""
        brought = state.places - self.state.places
        for place in tuple(brought):
            if place.rule is RuleId.INVERSE_IN_SHADER:
                del brought[place]
        return brought

    def _is_better(self, state: _State, target: _Place) -> bool:
        is_gone = state.places[target] < self.state.places[target]
        return is_gone and not self._new(state)

    def _completed(self, state: _State, target: _Place) -> _State | None:
        """Mend where else it is to be told, if that is told once; None if anything else comes."""
        if target.rule not in TOLD_ONCE:
            return None
        while len(state.made) - len(self.state.made) < MOST_TOGETHER:
            if self._is_better(state, target):
                return state
            brought = self._new(state)
            if not brought or {one.rule for one in brought} != {target.rule}:
                return None
            fault = state.fault_at(min(brought))
            change = None if fault is None else next(iter(state.candidates(fault)), None)
            after = None if change is None else self._after(state, change)
            if after is None:
                return None
            state = after
        return state if self._is_better(state, target) else None
