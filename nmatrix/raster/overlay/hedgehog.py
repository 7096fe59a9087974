"""Normals and tangents on the meshes of a scene, as many as can be told apart.

They are the vertices' own: the mesh's normals as the chosen rule carries them, on the true normal's
disc. Under flat shading they are the triangles'.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.canvas.glyphs import Ink
from nmatrix.canvas.marks import Box
from nmatrix.enums import Effect, NormalRule, Shading
from nmatrix.errors import counted, printable, shortlist
from nmatrix.linear.projection import front_sign
from nmatrix.raster.loaded_scene import Body
from nmatrix.raster.overlay.labels import Labels
from nmatrix.raster.overlay.stage import ARROW, Stage
from nmatrix.raster.overlay.tacks import Tack, farthest_apart
from nmatrix.raster.planning.plan import BodyPlan
from nmatrix.raster.shading.normals import angles_deg, face_normals_by, normals_by, unit
from nmatrix.raster.shading.space import as_array

Array = NDArray[Any]

MOST = 80  # tacks
APART = 80.0  # units, between two of them that point one way
CLEAR = 14.0  # units around a tack that no name covers
SHORTEST, LONGEST = 34.0, 84.0  # units of an arrow across the view
LEANING_DEG = 1e-4  # far below what a picture can show
TANGENT = 4.0  # units


@dataclass(frozen=True, eq=False)
class _Places:
    """Where a body can show its normals: places (n, 3), true normals, the rule's, and tangents."""

    body: Body
    points: Array
    true: Array
    ruled: Array
    tangents: Array

    def some(self, which: Array) -> _Places:
        parts = (one[which] for one in (self.points, self.true, self.ruled, self.tangents))
        return _Places(self.body, *parts)


@dataclass(frozen=True, eq=False)
class Hedgehog:
    """The chosen places of each body, the far bodies first."""

    stage: Stage
    chosen: tuple[_Places, ...]
    told: str
    bare: str
    remarks: list[str]

    @classmethod
    def on(cls, stage: Stage, labels: Labels, remarks: list[str]) -> Hedgehog:
        """Choose places that are seen, spread over the picture and over the ways they point."""
        is_flat = stage.loaded.settings.shading is Shading.FLAT
        kinds = "faces" if is_flat else "vertices"
        all_seen = [_seen_places(stage, plan) for plan in stage.drawn.plan.bodies]
        features = np.concatenate(
            [np.concatenate([stage.window(p.points)[:, :2] / APART, p.true], 1) for p in all_seen]
        )
        few = _thinned(features)
        kept = few[farthest_apart(features[few], MOST, 1.0)]
        starts = np.cumsum([0, *(len(one.points) for one in all_seen)])
        chosen = [
            one.some(kept[(kept >= first) & (kept < last)] - first)
            for one, first, last in zip(all_seen, starts[:-1], starts[1:], strict=True)
        ]
        for x, y in features[kept, :2] * APART:
            labels.keep_free(Box(x - CLEAR, y - CLEAR, 2 * CLEAR, 2 * CLEAR))
        told = f"at {len(kept)} of the {len(features):,} {kinds} that are seen"
        far_first = sorted(
            chosen, key=lambda one: -float(((one.body.centre - stage.eye) ** 2).sum())
        )
        hidden = [printable(one.body.name) for one in all_seen if not len(one.points)]
        bare = ""
        if hidden and not stage.is_empty:
            place = "middle of a face" if is_flat else "vertex"
            bare = f"No {place} of {shortlist(hidden, 3)} that has a normal is seen"
        told = told if len(kept) < len(features) else ""
        return cls(stage, tuple(far_first), told, bare, remarks)

    def normals(self) -> None:
        """Draw the normals as tacks; those that lean are wrong."""
        self._tell("Normals")
        for one in self.chosen:
            ink, long = _ink(one), self._length(one)
            is_bare = np.zeros(len(one.points), bool)
            if ink is Ink.NORMAL:  # where several begin, their discs would cut one another
                _, place, count = np.unique(
                    one.points, axis=0, return_inverse=True, return_counts=True
                )
                is_bare = (count > 1)[place.reshape(-1)]
            vectors = zip(one.points, one.true, one.ruled, strict=True)
            tacks = [Tack(place, true, ruled) for place, true, ruled in vectors]
            self.stage.tacks([tacks[i] for i in np.flatnonzero(~is_bare)], ink, long / ARROW)
            for i in np.flatnonzero(is_bare):
                self.stage.vector(tacks[i].place, long * tacks[i].arrow, ink)
        without = sum(int((~one.ruled.any(axis=1)).sum()) for one in self.chosen)
        if without:
            drawn = counted(sum(len(one.points) for one in self.chosen), "normal")
            self.remarks.append(f"Zero by this rule, a 0 on the disc: {without} of {drawn} drawn.")

    def tangents(self) -> None:
        """Draw a line along a tangent through each place."""
        self._tell("Tangents")
        palette = self.stage.canvas.palette
        for one in self.chosen:
            half = 0.6 * self._length(one) * one.tangents
            ends = (self.stage.window(one.points + s * half)[:, :2] for s in (-1, 1))
            for line in np.stack(list(ends), axis=1):
                if np.isfinite(line).all():
                    self.stage.canvas.stroke(line, TANGENT, palette.tangent, halo=1.6)
        shown = [one.body.mesh for one in self.chosen if len(one.points)]
        if shown and self.stage.loaded.settings.shading is Shading.FLAT:
            self.remarks.append("Tangents of faces are level: across the object's y axis.")
        elif any(mesh.tangents is None for mesh in shown):
            self.remarks.append(
                "Where a mesh has no tangents, those drawn are level: across the object's y axis."
            )

    def _tell(self, kind: str) -> None:
        if self.told:
            self.remarks.append(f"{kind} are drawn {self.told}, spread over the picture.")
        if self.bare:
            self.remarks.append(f"{self.bare}: no {kind.lower()} are drawn there.")

    def _length(self, one: _Places) -> float:
        """Return the length of a body's arrows in the world: a part of it that can be seen."""
        if not len(one.points):
            return 0.0
        stage = self.stage
        across = ARROW * (float(one.body.radius) or 1.0)
        a, b = (stage.window(p)[:, :2] for p in (one.points, one.points + across * stage.across))
        shown = float(np.nanmedian(np.sqrt(((b - a) ** 2).sum(axis=1))))
        return across * float(np.clip(shown, SHORTEST, LONGEST)) / shown


def _ink(one: _Places) -> Ink:
    """Return the ink of a body's normals: that of a mistake if any of them leans."""
    both = one.true.any(axis=1) & one.ruled.any(axis=1)
    lean = angles_deg(one.true[both], unit(one.ruled[both]))
    return Ink.WRONG if lean.max(initial=0.0) > LEANING_DEG else Ink.NORMAL


def _seen_places(stage: Stage, plan: BodyPlan) -> _Places:
    """Return where a body's normals begin, of those that a seen triangle has."""
    loaded, body = stage.loaded, plan.body
    mesh, points = body.mesh, body.positions_world
    facing = _facing(stage, plan, points)
    by_rule = loaded.settings.normals
    if loaded.settings.shading is Shading.FLAT:
        which = np.flatnonzero(facing)
        points = points[mesh.triangles[which]].mean(axis=1)
        carried = face_normals_by
        along = _level(mesh.face_normals)
    else:
        used = np.zeros(len(points), bool)
        used[mesh.triangles[facing]] = True
        which = np.flatnonzero(used)
        points = points[which]
        carried = normals_by
        along = _level(mesh.normals) if mesh.tangents is None else mesh.tangents[:, :3]
    is_seen = stage.sees(points)
    which, points = which[is_seen], points[is_seen]
    true = unit(carried(loaded, body, NormalRule.EXACT).T[which])
    ruled = carried(loaded, body, by_rule).T[which]
    A = as_array(body.world_from_object.exact)[:3, :3]
    found = _Places(body, points, true, ruled, unit(along[which] @ A.T))
    return found.some(np.flatnonzero(true.any(axis=1)))


def _facing(stage: Stage, plan: BodyPlan, points: Array) -> Array:
    """Return a mask of the triangles whose side towards the eye is drawn."""
    corners = stage.window(points)[plan.body.mesh.triangles, :2]
    a, b = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    sign = front_sign(stage.loaded.clip_from_object(plan.body), stage.loaded.clip)
    area = a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0]
    with np.errstate(invalid="ignore"):
        is_front = area * sign > 0 if sign else area != 0
    if Effect.BACK_FACES in plan.effects:
        is_front = np.isfinite(area)
    return np.asarray(is_front | ~np.isfinite(area))


def _level(normals: Array) -> Array:
    """Return directions (n, 3) across the normals and the y axis, or across x at the poles."""
    found = np.cross([0.0, 1.0, 0.0], normals)
    poles = (np.abs(found) < 1e-6).all(axis=1)
    found[poles] = np.cross(normals[poles], [1.0, 0.0, 0.0])
    return found


def _thinned(features: Array) -> Array:
    """Return one of those that are almost the same in place and direction."""
    cells = np.floor(features * 3).astype(np.int64)
    return np.sort(np.unique(cells, axis=0, return_index=True)[1])
