"""The report about shaders: each finding with its line, its caret and both spaces.

What the world matrix decides is told in degrees where a world is given; where it does not matter
there, the finding is only a note.
"""

from __future__ import annotations

from bisect import bisect_right
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import unified_diff
from functools import cached_property
from pathlib import Path

from nmatrix.enums import Severity
from nmatrix.errors import CheckFailedError, IllegalValueError, NMatrixError, counted, quantity
from nmatrix.linear.classify import BUILT, classify
from nmatrix.linear.rational import RationalMatrix
from nmatrix.lint.faults import Fault
from nmatrix.lint.fixes import fixed
from nmatrix.lint.program import Linted, lint
from nmatrix.lint.rules import LINT_RULES, RULE_OF, RULES
from nmatrix.lint.tree import Language, Shader
from nmatrix.reading.files import file_bytes
from nmatrix.reading.folders import STANDARD_INPUT
from nmatrix.report import (
    Block,
    Brief,
    Code,
    Finding,
    Findings,
    OnDemand,
    Report,
    Text,
    Tone,
    Value,
    Verdict,
)

SUFFIXES = (
    *(".vert", ".frag", ".geom", ".tesc", ".tese", ".vs", ".fs", ".gs", ".vsh", ".fsh", ".glsl"),
    *(".hlsl", ".hlsli", ".fx", ".fxh", ".cginc", ".shader"),
)
SHOWN = 4  # findings of the short answer
ROOM = 76  # columns of a source line
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


def source(path: Path, standard_input: bytes = b"") -> Source:
    """Read a shader; a byte that is no UTF-8 stands in a comment, as a rule, and is replaced.

    Examples
    --------
    >>> source(Path("-"), b"void main() {}").text
    'void main() {}'
    """
    name = str(path)
    try:
        if path.is_dir():
            raise IllegalValueError(name, "it may not be opened", "check its permissions")
        content = standard_input if name == STANDARD_INPUT else file_bytes(path)
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
    language: Language | None = None


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
    found = lint({one.name: one.text.encode() for one in sources if not one.error}, asked.language)
    return _Reporting(tuple(sources), found, asked).report()


@dataclass(frozen=True)
class _Placed:
    """A fault with its place as people count, and the corrected line if there is one."""

    fault: Fault
    line: int
    column: int
    width: int
    severity: Severity
    message: str
    degrees: float | None
    fix: str | None


@dataclass(frozen=True, eq=False)
class _Reporting:
    sources: tuple[Source, ...]
    linted: Linted
    asked: Asked

    def report(self) -> Report:
        data: dict[str, Value] = {
            "findings": [self._data(one) for one in self.placed],
            "spaces": self._spaces(),
            "files": [
                {"file": one.name, "error": one.reason or None, "unparsed": self._unparsed(one)}
                for one in self.sources
            ],
        }
        if self.asked.with_fixes:
            data["patch"] = self.patch
        findings = Findings(RULES, OnDemand(lambda: map(self._finding, self.placed)))
        return Report(
            "lint",
            data,
            (*self._blocks(len(self.placed)),),
            () if self.asked.with_fixes else (*self._remarks(),),
            self._failure(),
            findings=findings,
            brief=self._brief(),
        )

    @cached_property
    def texts(self) -> Mapping[str, str]:
        return {one.name: one.text for one in self.sources}

    @cached_property
    def starts(self) -> Mapping[str, Sequence[int]]:
        """Where the lines of each file begin, in bytes."""
        found = {}
        for one in self.sources:
            lines = one.text.encode().splitlines(keepends=True)
            places = [0]
            for line in lines:
                places.append(places[-1] + len(line))
            found[one.name] = places
        return found

    @cached_property
    def worst(self) -> float | None:
        """How far the world of the question turns a normal or a tangent off, at the most."""
        if self.asked.world is None:
            return None
        kind = classify(self.asked.world, self.asked.tolerance)
        return kind.worst_angle_deg if kind.needs_inverse_transpose else 0.0

    @cached_property
    def placed(self) -> tuple[_Placed, ...]:
        return tuple(map(self._place, self.linted.faults))

    def _place(self, fault: Fault) -> _Placed:
        file = fault.span.file
        content = self.texts[file].encode()
        starts = self.starts[file]
        line = bisect_right(starts, fault.span.start)
        before = content[starts[line - 1] : fault.span.start].decode("utf-8", "replace")
        inside = content[fault.span.start : fault.span.end].decode("utf-8", "replace")
        rule = LINT_RULES[fault.rule]
        severity, message, degrees = fault.severity, f"{fault.message}.", None
        if rule.gains_degrees and self.asked.world is not None:
            degrees = self.worst
            if degrees is None:
                message += " This world has no normals."
            elif degrees == 0:
                severity = Severity.NOTE
                message += " With this world it does not matter."
            else:
                message += f" With this world it is off by up to {degrees:.4g}°."
        message = message[0].upper() + message[1:]
        width = len(inside.split("\n", 1)[0])
        fix = self._fixed_line(fault, line)
        return _Placed(fault, line, len(before) + 1, width, severity, message, degrees, fix)

    def _fixed_line(self, fault: Fault, line: int) -> str | None:
        change = fixed(fault, self._shader_of(fault), self.texts[fault.span.file].encode())
        if change is None:
            return None
        starts = self.starts[fault.span.file]
        content = self.texts[fault.span.file].encode()
        end = bisect_right(starts, max(change.span.end - 1, change.span.start))
        first = bisect_right(starts, change.span.start) - 1
        new = (
            content[starts[first] : change.span.start]
            + change.text.encode()
            + content[change.span.end : starts[end]]
        )
        return new.decode("utf-8", "replace").rstrip("\r\n")

    def _shader_of(self, fault: Fault) -> Shader:
        return self._shaders[fault.span.file]

    @cached_property
    def _shaders(self) -> Mapping[str, Shader]:
        return {one.file: one for one in self.linted.shaders}

    @cached_property
    def patch(self) -> str:
        """The corrected files against the given ones; of changes that overlap the first is made."""
        parts = []
        for one in self.sources:
            content = one.text.encode()
            changes = []
            for placed in self.placed:
                if placed.fault.span.file == one.name:
                    change = fixed(placed.fault, self._shader_of(placed.fault), content)
                    if change is not None:
                        changes.append(change)
            new, end = b"", 0
            for change in sorted(changes, key=lambda each: each.span.start):
                if change.span.start < end:
                    continue
                new += content[end : change.span.start] + change.text.encode()
                end = change.span.end
            if not end:
                continue
            new += content[end:]
            lines = unified_diff(
                one.text.splitlines(keepends=True),
                new.decode("utf-8", "replace").splitlines(keepends=True),
                one.name,
                one.name,
            )
            parts += [line if line.endswith("\n") else f"{line}\n" for line in lines]
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
            "fix": one.fix,
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

    def _unparsed(self, one: Source) -> list[int]:
        starts = self.starts[one.name]
        faults = self._shaders[one.name].faults if one.name in self._shaders else ()
        return sorted({bisect_right(starts, fault.span.start) for fault in faults})

    # For people.

    def _sentence(self) -> str:
        counts = Counter(one.severity for one in self.placed)
        read = [one for one in self.sources if one.error is None]
        told = ", ".join(counted(counts[one], one.value) for one in Severity if counts[one])
        return f"{counted(len(read), 'file')}: {told or 'nothing to find fault with'}."

    @cached_property
    def by_weight(self) -> tuple[_Placed, ...]:
        return tuple(sorted(self.placed, key=lambda one: _WEIGHT[one.severity]))

    def _blocks(self, most: int) -> Iterator[Block]:
        if self.asked.with_fixes:
            if self.patch:
                yield Code("diff", self.patch)
            else:
                yield Text("There is nothing that can be mended by itself.")
            return
        tone = Tone.RIGHT if not self._failing else Tone.WRONG
        yield Verdict(self._sentence(), tone)
        for one in self.by_weight[:most]:
            yield Code("text", self._shown(one), self._title(one))
            yield Text(one.message)

    def _title(self, one: _Placed) -> str:
        rule = one.fault.rule
        where = f"{one.fault.span.file}:{one.line}:{one.column}"
        return f"{where}: {one.severity} {rule.value}"

    def _shown(self, one: _Placed) -> str:
        """Write the line with a caret below, cut to the room around it."""
        lines = self.texts[one.fault.span.file].splitlines()
        line = lines[one.line - 1] if one.line <= len(lines) else ""
        head = line[: one.column - 1].expandtabs(4)
        rest = line[one.column - 1 :].expandtabs(4)
        indent = len(head) - len(head.lstrip())
        head = head[indent:]
        if len(head) > ROOM // 2:
            head = "…" + head[len(head) - ROOM // 2 :]
        caret = min(one.width, ROOM - len(head), len(rest))
        return f"    {head}{rest[: ROOM - len(head)]}\n    {' ' * len(head)}^{'~' * (caret - 1)}\n"

    def _brief(self) -> Brief | None:
        if self.asked.with_fixes:
            return None
        more = len(self.placed) - SHOWN
        told = (counted(more, "more finding"),) if more > 0 else ()
        return Brief((*self._blocks(SHOWN),), told)

    def _remarks(self) -> Iterable[str]:
        for one in self.sources:
            if one.error is not None and len(self.sources) > 1:
                yield f"{one.reason}."
        for one in self.sources:
            lines = self._unparsed(one)
            if lines:
                where = ", ".join(map(str, lines[:3])) + (", …" if len(lines) > 3 else "")
                noun = "line" if len(lines) == 1 else "lines"
                yield f"{one.name} does not parse in {noun} {where}; the rest of it was read."

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
        if self._failing:
            first = self._failing[0]
            counts = Counter(one.severity for one in self._failing)
            told = " and ".join(counted(counts[one], one.value) for one in Severity if counts[one])
            return CheckFailedError(
                f"{quantity('fail_on')} {self.asked.fail_on}",
                f"there {'is' if len(self._failing) == 1 else 'are'} {told}",
                f"begin with {first.fault.span.file} line {first.line}",
            )
        return None
