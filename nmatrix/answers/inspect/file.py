"""One file: every node judged, from what the file says to what carries its mesh.

Nodes are made when someone looks at them. In a file of thousands nearly all are plain, and are
counted without being made; `suspects` are those that may be something else.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from pathlib import Path

from nmatrix.answers.inspect.node import Carriers, FoundNormals, InspectedNode, Maps
from nmatrix.errors import NMatrixError
from nmatrix.linear.classify import FROM_FILE, classify
from nmatrix.linear.rational import identity
from nmatrix.report import OnDemand
from nmatrix.scene.words import GLTF_SUFFIXES


class Special(StrEnum):
    """What some nodes of a file are that changes how they were judged."""

    SKINNED = "skinned"
    INSTANCED = "instanced"
    ANIMATED = "animated"
    MORPHED = "morphed"
    OUTSIDE_SCENE = "outside_scene"
    COMPUTED_NORMALS = "computed_normals"


@dataclass(frozen=True, eq=False)
class InspectedFile:
    """One file: its nodes, or the error that stopped it.

    `suspects` are the indices of all nodes that have a flaw, and perhaps of some others; `special`
    counts nodes by what they are.
    """

    file: str
    nodes: Sequence[InspectedNode] = ()
    suspects: Sequence[int] = ()
    special: Mapping[Special, int] = field(default_factory=dict)
    remarks: tuple[str, ...] = ()
    error: NMatrixError | None = None

    @cached_property
    def flawed(self) -> tuple[InspectedNode, ...]:
        """The nodes that have a flaw, in the file's order."""
        return tuple(node for node in map(self.nodes.__getitem__, self.suspects) if node.flaws)
