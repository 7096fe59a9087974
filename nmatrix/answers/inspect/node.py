"""What a node is found to be: the maps that carry its mesh into the world, and its normals.

Most nodes have one map, their world matrix. A skinned mesh has one for each joint (and its own
node's does not count), an instanced one for each instance, and a node whose scale is animated one
for each of its scales, at rest and by the keys.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from enum import StrEnum
from functools import cached_property
from math import atan, degrees, inf, sqrt

from nmatrix.answers.inspect.flaws import FLAWS
from nmatrix.enums import Flaw, Kind
from nmatrix.errors import counted
from nmatrix.linear.classify import Classification, most_excess, near_worst_angle_deg
from nmatrix.linear.rational import RationalMatrix
from nmatrix.report import Vector
from nmatrix.scene.hierarchy import Hierarchy
from nmatrix.scene.words import NormalsFrom

KINDS = list(Kind)
# The flaws of one map.
OF_MAPS: dict[Flaw, Callable[[Classification], bool]] = {
    Flaw.MIRRORED: lambda one: one.mirrored,
    Flaw.SHEAR: lambda one: one.kind is Kind.SHEAR,
    Flaw.SINGULAR: lambda one: one.kind is Kind.SINGULAR,
    Flaw.NON_UNIFORM_SCALE: lambda one: one.kind is Kind.NON_UNIFORM_SCALE,
}


class Carriers(StrEnum):
    """What a node has one map for each of; `NODE` for the node itself, which has one."""

    NODE = "node"
    JOINTS = "joints"
    INSTANCES = "instances"
    SCALES = "scales over time"


@dataclass(frozen=True)
class Maps:
    """The maps of one node, classified, and what there is one of each for.

    `total` counts them with those that are plain and were passed over; `name` tells what one of
    `each` is the map of.
    """

    carriers: Carriers
    each: tuple[Classification, ...]
    total: int
    name: Callable[[int], str] = field(default=str, compare=False)

    @classmethod
    def of(
        cls,
        carriers: Carriers,
        each: Iterable[Classification],
        name: Callable[[int], str] = str,
    ) -> Maps:
        """Put maps together of which none was left out."""
        found = tuple(each)
        return cls(carriers, found, len(found), name)

    def having(self, flaw: Flaw) -> Maps:
        """Leave only the maps with a flaw of maps, the worst first; `total` stays."""
        order = [i for i, one in enumerate(self.each) if OF_MAPS[flaw](one)]
        if flaw is not Flaw.MIRRORED:  # the only one without an angle
            order.sort(key=lambda i: -_bound_deg(self.each[i]))
        each = tuple(self.each[i] for i in order)
        return Maps(self.carriers, each, self.total, lambda i: self.name(order[i]))

    @cached_property
    def kind(self) -> Kind:
        """The least special kind among them."""
        return max((one.kind for one in self.each), key=KINDS.index)

    @property
    def kind_exact(self) -> bool:
        """Whether each has its kind exactly."""
        return all(one.kind_exact for one in self.each)

    @property
    def needs_inverse_transpose(self) -> bool:
        """Whether some of them would bend normals."""
        return any(one.needs_inverse_transpose for one in self.each)

    @property
    def determinant_sign(self) -> int | None:
        """The sign of all determinants; None where they differ."""
        signs = {one.determinant_sign for one in self.each}
        return signs.pop() if len(signs) == 1 else None

    @cached_property
    def worst_angle_deg(self) -> float | None:
        """The largest angle that any of them is wrong by without the inverse transpose.

        The exact angle of a map is dear, and a bound of it cheap: those that cannot be the worst
        are passed over.
        """
        distinct = {id(one.linear_map): one for one in self.each}.values()
        if len(distinct) == 1:
            return next(iter(distinct)).worst_angle_deg
        worst: float | None = None
        for bound, one in sorted(
            ((_bound_deg(one), one) for one in distinct), key=lambda each: -each[0]
        ):
            if worst is not None and bound < worst:
                break
            found = one.worst_angle_deg
            worst = found if worst is None else max(worst, found or 0.0)
        return worst

    @cached_property
    def near_worst_angle_deg(self) -> float:
        """The worst angle to a millionth of a degree, to put nodes in order."""
        return max(near_worst_angle_deg(one.linear_map) for one in self.each)

    def count(self, flaw: Flaw) -> int:
        """Count the maps that have a flaw."""
        return sum(map(OF_MAPS[flaw], self.each)) if flaw in OF_MAPS else 0


def _bound_deg(one: Classification) -> float:
    """Bound the worst angle of a map from above."""
    excess = most_excess(one.linear_map) if one.rank == 3 else inf
    if excess > 1e30:
        return 90.0
    return degrees(atan(excess / (2 * sqrt(1 + excess)))) * (1 + 1e-9)


@dataclass(frozen=True)
class FoundNormals:
    """Where the normals of a node's mesh come from, and how many of them are no direction.

    `unread` is why some of them were not read, if so; `at` is where the first of those that are no
    direction stands, in object space.
    """

    origin: NormalsFrom = NormalsFrom.NONE
    degenerate: int = 0
    unread: str = ""
    at: Vector | None = None

    @property
    def told(self) -> str:
        """How many are no direction, whose fault that is, and where the first one stands."""
        told = f"{counted(self.degenerate, 'normal is', 'normals are')} no direction"
        if self.origin is NormalsFrom.COMPUTED:
            told += (
                ": the file lacks some or all, and triangles without area, or that undo each "
                "other, give none"
            )
        if self.at is None:
            return told
        return f"{told}; the first at {' '.join(f'{float(one):.6g}' for one in self.at)}"


@dataclass(frozen=True)
class InspectedNode:
    """One node in its file: where it stands, what carries its mesh, and the mesh's normals.

    `unplaced` is why its joints or instances could not be read, if so: its maps are its own then.
    """

    file: str
    index: int
    hierarchy: Hierarchy
    world_from_object: RationalMatrix
    maps: Maps
    normals: FoundNormals = FoundNormals()
    mesh: int | None = None
    mesh_name: str = ""
    in_scene: bool = True
    skinned: bool = False
    animated: tuple[str, ...] = ()
    sheared_by_ancestors: bool = False
    unplaced: str = ""

    @property
    def path(self) -> str:
        """The names from the root to the node."""
        return self.hierarchy.path(self.index)

    @property
    def called(self) -> str:
        """The same, told apart from other nodes of this path."""
        return self.hierarchy.called(self.index)

    @property
    def normal_matrix(self) -> RationalMatrix | None:
        """The one matrix that carries its normals; None without one, or with one for each map."""
        is_one = self.maps.carriers is Carriers.NODE
        return self.maps.each[0].linear_map.normal_matrix if is_one else None

    @property
    def instances(self) -> dict[str, int] | None:
        """How many instances there are, are mirrored, and need the inverse transpose."""
        if self.maps.carriers is not Carriers.INSTANCES:
            return None
        return {
            "count": self.maps.total,
            "mirrored": self.maps.count(Flaw.MIRRORED),
            "non_uniform": sum(one.needs_inverse_transpose for one in self.maps.each),
        }

    @property
    def unread(self) -> str:
        """Why its mesh, or what carries it, was not wholly read; empty where it was."""
        return "; ".join(filter(None, (self.unplaced, self.normals.unread)))

    @cached_property
    def flaws(self) -> tuple[Flaw, ...]:
        """What is the matter with the node, the worst first."""
        return tuple(flaw for flaw in Flaw if self._has(flaw))

    def _has(self, flaw: Flaw) -> bool:
        if flaw is Flaw.DEGENERATE:
            return self.normals.degenerate > 0
        if flaw is Flaw.UNREADABLE:
            return bool(self.unread)
        return self.maps.count(flaw) > 0

    @property
    def found(self) -> str:
        """What the node is, in words: its flaws, or the kind of its map."""
        parts = {
            self._maps_in_words(): True,
            "degenerate normals": self.normals.degenerate > 0,
            "mesh not wholly read": bool(self.normals.unread),
            "not wholly read": bool(self.unplaced),
        }
        told = [part for part, applies in parts.items() if part and applies]
        told = told or [self._kind_in_words()]
        return ", ".join([*told, *([] if self.in_scene else ["outside the scene"])])

    def told(self, flaw: Flaw) -> str:
        """Tell one flaw of the node in a sentence."""
        if flaw is Flaw.DEGENERATE:
            return f"{self.called}: {self.normals.told}."
        if flaw is Flaw.UNREADABLE:
            return f"{self.called}: not wholly read: {self.unread}."
        having = self.maps.having(flaw)
        parts = [self._of_one_map(flaw)]
        if self.maps.carriers is not Carriers.NODE:
            words = FLAWS[flaw].adjective
            parts = [f"{len(having.each)} of {having.total} {self._each} {words}"]
        parts += [] if self.in_scene else ["outside the scene"]
        told = [", ".join(parts)]
        worst = None if flaw is Flaw.MIRRORED else having.worst_angle_deg
        if worst:
            told.append(f"without the inverse transpose normals are up to {worst:.4g}° off")
        if self.maps.carriers is not Carriers.NODE:
            told.append(f"the {'worst' if worst else 'first'} is {having.name(0)}")
        return f"{self.called}: {'; '.join(told)}."

    def _of_one_map(self, flaw: Flaw) -> str:
        """Tell a flaw of a node's one map."""
        if flaw is not Flaw.SHEAR:
            return FLAWS[flaw].adjective
        return f"sheared by {'ancestors' if self.sheared_by_ancestors else 'itself'}"

    def _kind_in_words(self) -> str:
        kind = self.maps.kind.value
        return kind if self.maps.carriers is Carriers.NODE else f"{kind} by its {self._each}"

    @property
    def _each(self) -> str:
        return self.maps.carriers.value

    def _maps_in_words(self) -> str:
        found = {flaw: self.maps.count(flaw) for flaw in self.flaws if flaw in OF_MAPS}
        if not found:
            return ""
        if self.maps.carriers is Carriers.NODE:
            return " and ".join(self._of_one_map(flaw) for flaw in self._in_speech(found))
        words = {flaw: FLAWS[flaw].adjective for flaw in found}
        total = self.maps.total
        if len({*found.values()}) == 1 and self._are_the_same(tuple(found)):
            spoken = " and ".join(words[flaw] for flaw in self._in_speech(found))
            return f"{next(iter(found.values()))} of {total} {self._each} {spoken}"
        listed = ", ".join(f"{found[flaw]} {words[flaw]}" for flaw in self._in_speech(found))
        return f"of {total} {self._each} {listed}"

    def _in_speech(self, flaws: dict[Flaw, int]) -> list[Flaw]:
        """Put a mirror first, then what else the map is."""
        return sorted(flaws, key=lambda flaw: flaw is not Flaw.MIRRORED)

    def _are_the_same(self, flaws: tuple[Flaw, ...]) -> bool:
        """Whether the maps with one of the flaws have them all."""
        return all(
            all(OF_MAPS[flaw](one) for flaw in flaws)
            or not any(OF_MAPS[flaw](one) for flaw in flaws)
            for one in self.maps.each
        )
