"""The report about inspected files: counts first, then the rows that matter, then why.

People see the nodes that have a flaw, the worst first; machines get every node. What is chosen
(`only`, `order`) holds for both, and counts are always of all nodes.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property
from math import inf
from pathlib import Path

from nmatrix.answers.inspect.file import InspectedFile, Special
from nmatrix.answers.inspect.flaws import FLAWS, RULES, rank
from nmatrix.answers.inspect.node import InspectedNode
from nmatrix.answers.inspect.records import COLUMNS, cells_of_node, cells_of_unread, node_data
from nmatrix.answers.inspect.remarks import remarks_about
from nmatrix.answers.inspect.words import ROOM, elided, named, of_all, told_apart
from nmatrix.enums import Flaw, NodeOrder, Severity
from nmatrix.errors import CheckFailedError, IllegalValueError, NMatrixError, counted, quantity
from nmatrix.reading.folders import STANDARD_INPUT
from nmatrix.report import (
    Block,
    Cells,
    Finding,
    Findings,
    Heading,
    Number,
    OnDemand,
    Report,
    Table,
    Text,
    Value,
    Verdict,
)

SEEN_DEG = 0.1  # of a normal: 8 bits of a diffuse colour turn by half a level at 0.11°
BENDING = (Flaw.SHEAR, Flaw.NON_UNIFORM_SCALE)
SCREEN_WIDTH = 80
SHOWN = 10  # rows for people, so that all of it stays on one screen
PATH_ROOM, FILE_ROOM, MESH_ROOM = 24, 20, 10  # characters in a table


@dataclass(frozen=True)
class Chosen:
    """Which nodes are shown, in which order, whether all, and what makes the check fail.

    `width` is that of the text, in columns: more leave more room for names.
    """

    only: tuple[Flaw, ...] = ()
    order: NodeOrder | None = None
    show_all: bool = False
    fail_on: tuple[Flaw, ...] = ()
    width: int = SCREEN_WIDTH


EVERYTHING = Chosen()


def report(files: Sequence[InspectedFile], chosen: Chosen = EVERYTHING) -> Report:
    """Report on files; it ends in a failure where one of them has a flaw of `fail_on`.

    Where there is one file only, it could not be read, and this is not what was checked for, it
    ends in the error of the file: people have that one line then, machines a finding and a row too.
    """
    return _Reporting(tuple(files), chosen).report()


@dataclass(frozen=True, eq=False)
class _Reporting:
    """Files on their way to a report."""

    files: tuple[InspectedFile, ...]
    chosen: Chosen

    def report(self) -> Report:
        data: dict[str, Value] = {
            "files": [{"file": one.file, "error": one.reason or None} for one in self.files],
            "nodes": OnDemand(lambda: map(node_data, self._listed)),
            "summary": self._summary(),
        }
        return Report(
            "inspect",
            data,
            (*self._blocks(),),
            self._remarks(),
            self._failure(),
            records=Table(COLUMNS, OnDemand(self._records)),
            findings=Findings(RULES, OnDemand(self._findings)),
        )

    @cached_property
    def flawed(self) -> tuple[InspectedNode, ...]:
        return tuple(node for one in self.files for node in one.flawed)

    @cached_property
    def unread(self) -> tuple[InspectedFile, ...]:
        return tuple(one for one in self.files if one.error is not None)

    @cached_property
    def total(self) -> int:
        return sum(one.count for one in self.files)

    def having(self, flaw: Flaw) -> tuple[InspectedNode, ...]:
        return tuple(node for node in self.flawed if flaw in node.flaws)

    @property
    def _has_several(self) -> bool:
        return len(self.files) > 1

    def _summary(self) -> dict[str, Value]:
        needing = sum(node.maps.needs_inverse_transpose for node in self.flawed)
        return {
            "files": len(self.files),
            "unreadable_files": len(self.unread),
            "nodes": self.total,
            "needs_inverse_transpose": needing,
            **{flaw.value.replace("-", "_"): len(self.having(flaw)) for flaw in Flaw},
            "sheared_by_ancestors": sum(node.sheared_by_ancestors for node in self.flawed),
            **{kind.value: self._counted(kind) for kind in Special},
            "sentence": self._sentence(),
        }

    def _counted(self, kind: Special) -> int:
        return sum(one.special.get(kind, 0) for one in self.files)

    def _sentence(self) -> str:
        """Tell in one sentence how many nodes need it, then count them by what they are."""
        flat = len(self.having(Flaw.SINGULAR))
        needing = sum(node.maps.needs_inverse_transpose for node in self.flawed) - flat
        counts = ((len(self.having(flaw)), FLAWS[flaw].adjective) for flaw in Flaw)
        by_kind = ", ".join(f"{count} {adjective}" for count, adjective in counts if count)
        told = f"{of_all(needing, self.total, 'needs', 'need')} the inverse transpose"
        if not self.total:
            told = "There are no nodes"
        told = f"{told}. Found: {by_kind}." if by_kind else f"{told}."
        if not self.unread:
            return told
        was = of_all(len(self.unread), len(self.files), "was", "were", "file")
        return f"{told} {was} not read."

    @cached_property
    def _folder(self) -> str:
        """The folder that all files are in; people see their names from there."""
        try:
            return os.path.commonpath([str(Path(one.file).parent) for one in self.files])
        except ValueError:  # some are absolute, or on another drive
            return ""

    def _from_folder(self, file: str) -> str:
        return file.removeprefix(self._folder).lstrip(os.sep) if self._folder else file

    @property
    def _only_error(self) -> NMatrixError | None:
        """The error of the one file that there is, unless it was checked for."""
        if self._has_several or not self.files or Flaw.UNREADABLE in self.chosen.fail_on:
            return None
        return self.files[0].error

    def _blocks(self) -> Iterable[Block]:
        if self._only_error is not None:
            return
        if self._has_several:
            yield Heading(f"{len(self.files)} files" + (self._folder and f" of {self._folder}"))
        else:
            file = self.files[0].file
            yield Heading("standard input" if file == STANDARD_INPUT else Path(file).name)
        yield Verdict(self._sentence())
        rows = self._rows_for_people()
        shown = rows if self.chosen.show_all else rows[:SHOWN]
        if shown:
            yield self._table(shown)
        reasons = self.unread if self._wanted(Flaw.UNREADABLE) else ()
        some = reasons if self.chosen.show_all else reasons[:SHOWN]
        if some:
            names = told_apart([self._from_folder(one.file) for one in some], ROOM)
            cells = tuple(zip(names, (one.reason for one in some), strict=True))
            yield Table(("file", "reason"), cells, "Could not be read")
        hidden = len(rows) - len(shown) + len(reasons) - len(some)
        if hidden:
            yield Text(f"{counted(hidden, 'more row')}: {quantity('all')} shows them.")

    def _wanted(self, flaw: Flaw) -> bool:
        return not self.chosen.only or flaw in self.chosen.only

    def _rows_for_people(self) -> list[InspectedNode]:
        if self.chosen.show_all and not self.chosen.only:
            return self._sorted([node for one in self.files for node in one.nodes])
        return self._sorted([node for node in self.flawed if any(map(self._wanted, node.flaws))])

    @cached_property
    def _listed(self) -> list[InspectedNode]:
        """The nodes for machines: those that were chosen, in the files' order unless it was."""
        if self.chosen.only:
            found = [node for node in self.flawed if any(map(self._wanted, node.flaws))]
        else:
            found = [node for one in self.files for node in one.nodes]
        return found if self.chosen.order is None else self._sorted(found)

    def _sorted(self, nodes: list[InspectedNode]) -> list[InspectedNode]:
        match self.chosen.order:
            case None | NodeOrder.KIND:
                return sorted(nodes, key=_weight)
            case NodeOrder.ANGLE:
                return sorted(nodes, key=lambda node: -(_worst(node) or 0.0))
            case NodeOrder.PATH:
                return sorted(nodes, key=lambda node: node.path)
            case NodeOrder.MESH:
                return sorted(nodes, key=lambda node: inf if node.mesh is None else node.mesh)
            case NodeOrder.INDEX:
                return nodes

    def _table(self, nodes: Sequence[InspectedNode]) -> Table:
        normals = [node.normals for node in nodes]
        more = max(self.chosen.width - SCREEN_WIDTH, 0) // 2
        files = [self._from_folder(node.file) for node in nodes]
        columns: dict[str, Sequence[Number | str | None]] = {
            "file": told_apart(files, FILE_ROOM + more),
            "index": [node.index for node in nodes],
            "path": told_apart([node.path for node in nodes], PATH_ROOM + more),
            "mesh": [None if node.mesh is None else _mesh_name(node) for node in nodes],
            "found": [node.found for node in nodes],
            "bad normals": [None if one.unread else one.degenerate for one in normals],
            "worst °": [_worst(node) for node in nodes],
        }
        if not self._has_several:
            del columns["file"]
        if self._has_several or not any(columns["mesh"]):
            del columns["mesh"]
        if not any(columns["bad normals"]):
            del columns["bad normals"]
        return Table(tuple(columns), tuple(zip(*columns.values(), strict=True)))

    def _remarks(self) -> tuple[str, ...]:
        special = {kind: self._counted(kind) for kind in Special}
        told = [
            *self._own_remarks(),
            *remarks_about(self.flawed, special, self.total, self._wanted),
        ]
        empty = [one.file for one in self.files if one.error is None and not one.count]
        if empty and self._has_several:
            told.append(f"Without any node: {named(empty)}.")
        checked = self.chosen.fail_on
        if self.unread and checked and Flaw.UNREADABLE not in checked:
            told.append(
                f"{of_all(len(self.unread), len(self.files), 'was', 'were', 'file')} not read and "
                f"so not checked; {quantity('fail_on')} {Flaw.UNREADABLE} fails for that."
            )
        return tuple(told)

    def _own_remarks(self) -> Iterable[str]:
        """Tell what files say of themselves, of many once what several say alike."""
        if not self._has_several:
            yield from self.files[0].remarks
            return
        alike: dict[str, list[str]] = {}
        for one in self.files:
            for remark in one.remarks:
                alike.setdefault(remark, []).append(self._from_folder(one.file))
        listed = list(alike.items())
        for remark, names in listed[:SHOWN]:
            yield f"{named(names)}: {remark}"
        others = {name for _, names in listed[SHOWN:] for name in names}
        if others:
            yield f"There are remarks on {counted(len(others), 'more file')} ({named(others)})."

    def _failure(self) -> NMatrixError | None:
        """Name every flaw that was asked for and found, with its nodes and files."""
        if self._only_error is not None:
            return self._only_error
        fail_on = self.chosen.fail_on
        told = dict.fromkeys(words for flaw in fail_on for words in self._failing(flaw))
        if told:
            return CheckFailedError(
                f"{quantity('fail_on')} {','.join(fail_on)}",
                "; ".join(told),
                f"see their rows, or {quantity('format')} json",
            )
        if self.files and len(self.unread) == len(self.files):
            return IllegalValueError(
                f"{len(self.files)} files", "none of them could be read", "see the reasons"
            )
        return None

    def _failing(self, flaw: Flaw) -> Iterable[str]:
        nodes = self.having(flaw)
        if flaw is Flaw.UNREADABLE and self.unread:
            count = of_all(len(self.unread), len(self.files), "was", "were", "file")
            yield f"{count} not read ({named(one.file for one in self.unread)})"
        if flaw is Flaw.DEGENERATE:  # what nobody saw is not right, nor wrong
            blind = [node for node in self.having(Flaw.UNREADABLE) if node.normals.unread]
            if blind:
                count = of_all(len(blind), self.total, "has", "have")
                yield f"{count} normals that were not wholly read ({self._named(blind)})"
        if nodes:
            verb = ("has", "have") if flaw is Flaw.DEGENERATE else ("is", "are")
            words = FLAWS[flaw].adjective.removeprefix("with ")
            yield f"{of_all(len(nodes), self.total, *verb)} {words} ({self._named(nodes)})"

    def _named(self, nodes: Sequence[InspectedNode]) -> str:
        if not self._has_several:
            return named(node.called for node in nodes)
        return named(f"{node.file}: {node.called}" for node in nodes)

    def _records(self) -> Iterable[Cells]:
        yield from map(cells_of_node, self._listed)
        if self._wanted(Flaw.UNREADABLE):
            for one in self.unread:
                yield cells_of_unread(one.file, one.reason)

    def _findings(self) -> Iterable[Finding]:
        if self._wanted(Flaw.UNREADABLE):
            for one in self.unread:
                words = FLAWS[Flaw.UNREADABLE]
                yield Finding(words.rule, words.severity, one.reason, one.file, one.line)
        for node in self._sorted(list(self.flawed)) if self.chosen.order else self.flawed:
            for flaw in filter(self._wanted, node.flaws):
                words = FLAWS[flaw]
                severity = Severity.ERROR if flaw in self.chosen.fail_on else words.severity
                yield Finding(words.rule, severity, node.told(flaw), node.file, place=node.called)


def _weight(node: InspectedNode) -> tuple[int, float, int]:
    """Place a node by what matters: angles that can be seen, other flaws, then smaller angles.

    Equal angles, to a millionth of a degree, stay in the file's order.
    """
    needs_it = node.maps.needs_inverse_transpose
    angle = round(node.maps.near_worst_angle_deg, 6) if needs_it else 0.0
    if angle >= SEEN_DEG:
        return 0, -angle, rank(node.flaws)
    others = [flaw for flaw in node.flaws if flaw not in BENDING]
    if others:
        return 1, rank(others), 0
    return (2 if node.flaws else 3), -angle, rank(node.flaws)


def _worst(node: InspectedNode) -> float | None:
    """Measure what is wrong without the inverse transpose: nothing, where it is not needed."""
    return node.maps.worst_angle_deg if node.maps.needs_inverse_transpose else 0.0


def _mesh_name(node: InspectedNode) -> str:
    return elided(node.mesh_name, MESH_ROOM) if node.mesh_name else str(node.mesh)
