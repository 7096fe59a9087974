"""The report about shaders: each finding with its line, its caret and both spaces.

What the world matrix decides is told in degrees where a world is given; where it does not matter
there, the finding is only a note.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import unified_diff
from functools import cached_property
from itertools import accumulate
from pathlib import Path
from textwrap import wrap

from nmatrix.enums import Severity, ShaderLanguage
from nmatrix.errors import CheckFailedError, IllegalValueError, NMatrixError, counted, quantity
from nmatrix.linear.classify import BUILT, classify
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linting.faults import Fault
from nmatrix.linting.mending import Correction, Mended, mended
from nmatrix.linting.program import Linted, lint
from nmatrix.linting.rules import LINT_RULES, RULE_OF, RULES
from nmatrix.linting.tree import Shader
from nmatrix.reading.files import file_bytes
from nmatrix.reading.folders import STANDARD_INPUT
from nmatrix.report import (
    SCREEN,
    Block,
    Brief,
    Code,
    Finding,
    Findings,
    OnDemand,
    Report,
    Tone,
    Value,
    Verdict,
)

SUFFIXES = (
    *(".vert", ".frag", ".geom", ".tesc", ".tese", ".vs", ".fs", ".gs", ".vsh", ".fsh", ".glsl"),
    *(".hlsl", ".hlsli", ".fx", ".fxh", ".cginc", ".shader"),
)
ROOM = 76  # columns of a source line
NARROW = 60  # columns of a title, on a narrow screen
_NO_LINE_END = "\\ No newline at end of file\n"
_WEIGHT = {Severity.ERROR: 0, Severity.WARNING: 1, Severity.NOTE: 2}


@dataclass(frozen=True)
class Source:
    """A file of shader text; one that could not be read has the reason."""

    name: str
    text: str = ""
    error: NMatrixError | None = None

    @property
    def reason(self) -> str:
        """Why it was not read, in one line."""
        return "" if self.error is None else f"{self.error.parts[0]}: {self.error.parts[1]}"


def source(path: Path, standard_input: bytes = b"", called: str | None = None) -> Source:
    """Read a shader; a byte that is no UTF-8 stands in a comment, as a rule, and is replaced.

    Examples
    --------
    >>> source(Path("-"), b"void main() {}").text
    'void main() {}'
    """
    name = str(path) if called is None else called
    try:
        if path.is_dir():
            raise IllegalValueError(name, "it may not be opened", "check its permissions")
        content = standard_input if str(path) == STANDARD_INPUT else file_bytes(path)
    except NMatrixError as error:
        return Source(name, error=error)
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return Source(name, content.decode("utf-16", "replace"))
    if b"\0" in content:
        what = f"file ({name})"
        return Source(
            name, error=IllegalValueError(what, "it is binary", "give the source of a shader")
        )
    return Source(name, content.decode("utf-8-sig", "replace"))


@dataclass(frozen=True)
class Asked:
    """What is asked of shaders: the world that they draw, and what makes the check fail."""

    world: RationalMatrix | None = None
    tolerance: float = BUILT
    fail_on: Severity = Severity.ERROR
    with_fixes: bool = False
    language: ShaderLanguage | None = None
    are_one_program: bool = False


def report(sources: Sequence[Source], asked: Asked | None = None) -> Report:
    r"""Lint sources and report; the report ends in a failure for findings that are asked to fail.

    Raises
    ------
    MissingPackageError
        Without the grammars.

    Examples
    --------
    >>> text = "uniform mat4 model; in vec3 n; out vec3 N;\nvoid main() { N = mat3(model) * n; }"
    >>> report([Source("a.vert", text)]).data["findings"][0]["rule"]
    'NM101'
    """
    asked = Asked() if asked is None else asked
    texts = {one.name: one.text.encode() for one in sources if not one.error}
    found = lint(texts, asked.language, are_one_program=asked.are_one_program)
    return _Reporting(tuple(sources), found, asked).report()


@dataclass(frozen=True)
class _Lines:
    """A source by its lines, so that bytes are found as people count."""

    content: bytes
    shader: Shader | None

    @cached_property
    def starts(self) -> Sequence[int]:
        lengths = map(len, self.content.splitlines(keepends=True))
        return [0, *accumulate(lengths)]

    def line_of(self, place: int) -> int:
        return min(bisect_right(self.starts, place), max(len(self.starts) - 1, 1))

    def text(self, start: int, end: int) -> str:
        return self.content[start:end].decode("utf-8", "replace")

    def line(self, number: int) -> str:
        ends = self.starts
        return (
            self.text(ends[number - 1], ends[number]).rstrip("\r\n") if number < len(ends) else ""
        )

    def column_of(self, place: int) -> int:
        return len(self.text(self.starts[self.line_of(place) - 1], place)) + 1

    @property
    def unparsed(self) -> list[int]:
        faults = () if self.shader is None else self.shader.faults
        return sorted({self.line_of(one.span.start) for one in faults})


@dataclass(frozen=True)
class _Placed:
    """A fault with its place as people count, and its correction if there is one."""

    fault: Fault
    line: int
    column: int
    width: int
    severity: Severity
    message: str
    degrees: float | None
    correction: Correction

    @property
    def unmended(self) -> str:
        """Why the patch does not mend it; empty where it does, or is not asked for."""
        told = self.correction
        if told.reason is None or told.is_gone:
            return ""
        where = f"{self.fault.span.file}:{self.line}:{self.column}"
        return f"{where}: {self.fault.rule.value} is not mended: {told.reason}."

    @property
    def title(self) -> str:
        """Name the place, the weight, the rule, and what is wrong."""
        where = f"{self.fault.span.file}:{self.line}:{self.column}"
        return f"{where}: {self.severity} {self.fault.rule.value}: {self.message}"


@dataclass(frozen=True, eq=False)
class _Reporting:
    """What was found on its way to a report."""

    sources: tuple[Source, ...]
    linted: Linted
    asked: Asked

    def report(self) -> Report:
        data: dict[str, Value] = {
            "findings": [self._data(one) for one in self.placed],
            "spaces": self._spaces(),
            "files": [
                {
                    "file": one.name,
                    "error": one.reason or None,
                    "unparsed": self.lines[one.name].unparsed,
                }
                for one in self.sources
            ],
        }
        if self.asked.with_fixes:
            data["patch"] = self.patch
        return Report(
            "lint",
            data,
            (*self._blocks(len(self.placed)),),
            (*self._remarks(),),
            self._failure(),
            findings=Findings(RULES, OnDemand(lambda: map(self._finding, self.placed))),
            brief=self._brief(),
        )

    @cached_property
    def lines(self) -> Mapping[str, _Lines]:
        shaders = {one.file: one for one in self.linted.shaders}
        return {one.name: _Lines(one.text.encode(), shaders.get(one.name)) for one in self.sources}

    @cached_property
    def worst(self) -> float | None:
        """How far the world of the question turns a normal or a tangent off, at the most."""
        if self.asked.world is None:
            return None
        kind = classify(self.asked.world, self.asked.tolerance)
        return kind.worst_angle_deg if kind.needs_inverse_transpose else 0.0

    @cached_property
    def placed(self) -> tuple[_Placed, ...]:
        corrections = self.mended.corrections
        return tuple(map(self._place, self.linted.faults, corrections))

    @cached_property
    def mended(self) -> Mended:
        """The corrected sources, if they are asked for."""
        texts = {name: one.content for name, one in self.lines.items() if one.shader is not None}
        if not self.asked.with_fixes:
            return Mended(texts, (Correction(),) * len(self.linted.faults))
        is_one = self.asked.are_one_program
        return mended(texts, self.linted, self.asked.language, are_one_program=is_one)

    def _place(self, fault: Fault, correction: Correction) -> _Placed:
        lines, span = self.lines[fault.span.file], fault.span
        severity, message, degrees = fault.severity, f"{fault.message}.", None
        if LINT_RULES[fault.rule].gains_degrees and self.asked.world is not None:
            degrees = self.worst
            if degrees is None:
                message += " This world has no normals."
            elif degrees == 0:
                severity = Severity.NOTE
                message += " With this world it does not matter."
            else:
                message += f" With this world it is off by up to {degrees:.4g}°."
        return _Placed(
            fault,
            lines.line_of(span.start),
            lines.column_of(span.start),
            len(lines.text(span.start, span.end).split("\n", 1)[0]),
            severity,
            message,
            degrees,
            correction,
        )

    @cached_property
    def patch(self) -> str:
        """The corrected files against the given ones, as the program `patch` takes it."""
        parts = []
        for file, new in self.mended.sources.items():
            content = self.lines[file].content
            before, after = (
                [line.decode("utf-8", "replace") for line in text.splitlines(keepends=True)]
                for text in (content, new)
            )
            parts += [
                line if line.endswith("\n") else f"{line}\n{_NO_LINE_END}"
                for line in unified_diff(before, after, file, file)
            ]
        return "".join(parts)

    def _data(self, one: _Placed) -> dict[str, Value]:
        fault = one.fault
        return {
            "file": fault.span.file,
            "line": one.line,
            "column": one.column,
            "rule": fault.rule.value,
            "mistake": fault.mistake,
            "severity": one.severity.value,
            "message": one.message,
            "space_left": fault.left or None,
            "space_right": fault.right or None,
            "fix": one.correction.line,
            "no_fix": one.correction.reason,
            "degrees": one.degrees,
        }

    def _finding(self, one: _Placed) -> Finding:
        fault = one.fault
        return Finding(
            RULE_OF[fault.rule], one.severity, one.message, fault.span.file, one.line, one.column
        )

    def _spaces(self) -> dict[str, Value]:
        found: dict[str, Value] = {}
        for known in self.linted.spaces.values():
            for name, (space, because) in known.items():
                found.setdefault(name, {"space": space, "known_by": because})
        return found

    # For people.

    def _sentence(self) -> str:
        counts = Counter(one.severity for one in self.placed)
        read = [one for one in self.sources if one.error is None]
        told = ", ".join(counted(counts[one], one.value) for one in Severity if counts[one])
        return f"{counted(len(read), 'file')}: {told or 'nothing to find fault with'}."

    def _blocks(self, most: int) -> Iterator[Block]:
        yield Verdict(self._sentence(), Tone.WRONG if self._failing else Tone.RIGHT)
        for one in sorted(self.placed, key=lambda one: _WEIGHT[one.severity])[:most]:
            yield Code("text", self._shown(one), one.title)

    def _shown(self, one: _Placed) -> str:
        """Write the line with a caret below, cut to the room around it."""
        line = self.lines[one.fault.span.file].line(one.line)
        head = line[: one.column - 1].expandtabs(4).lstrip()
        rest = line[one.column - 1 :].expandtabs(4)
        if len(head) > ROOM // 2:
            head = "…" + head[len(head) - ROOM // 2 :]
        room = ROOM - len(head)
        caret = max(min(one.width, room, len(rest)), 1)
        return f"    {head}{rest[:room]}\n    {' ' * len(head)}^{'~' * (caret - 1)}\n"

    def _brief(self) -> Brief:
        """Show as many findings as a screen has room for."""
        left, most = SCREEN - 4 - len(self._remarks()), 0
        for one in sorted(self.placed, key=lambda one: _WEIGHT[one.severity]):
            left -= 3 + len(wrap(one.title, NARROW))
            if left < 0:
                break
            most += 1
        more = len(self.placed) - most
        return Brief((*self._blocks(most),), (counted(more, "more finding"),) if more else ())

    def _remarks(self) -> Sequence[str]:
        told = [f"{one.reason}." for one in self.sources if one.error and len(self.sources) > 1]
        for one in self.sources:
            lines = self.lines[one.name].unparsed
            if lines:
                where = ", ".join(map(str, lines[:3])) + (", …" if len(lines) > 3 else "")
                noun = "line" if len(lines) == 1 else "lines"
                told.append(
                    f"{one.name} does not parse in {noun} {where}; the rest of it was read."
                )
        return (*told, *(one.unmended for one in self.placed if one.unmended))

    @cached_property
    def _failing(self) -> tuple[_Placed, ...]:
        least = _WEIGHT[self.asked.fail_on]
        return tuple(one for one in self.placed if _WEIGHT[one.severity] <= least)

    def _failure(self) -> NMatrixError | None:
        unread = [one.error for one in self.sources if one.error is not None]
        if unread and len(unread) == len(self.sources):
            if len(unread) == 1:
                return unread[0]
            return IllegalValueError(
                f"{len(unread)} files", "none of them could be read", "see the reasons"
            )
        if not self._failing:
            return None
        first = self._failing[0]
        counts = Counter(one.severity for one in self._failing)
        told = " and ".join(counted(counts[one], one.value) for one in Severity if counts[one])
        return CheckFailedError(
            f"{quantity('fail_on')} {self.asked.fail_on}",
            f"there {'is' if len(self._failing) == 1 else 'are'} {told}",
            f"begin with {first.fault.span.file} line {first.line}",
        )
