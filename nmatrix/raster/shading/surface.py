"""The surface of one body: its vertex shader and its fragment shader."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from nmatrix.enums import Effect, NormalRule, Shading
from nmatrix.raster.shading.lighting import Lighting, Lit, colour
from nmatrix.raster.shading.normals import bumped, turned_towards
from nmatrix.raster.shading.space import ShadingSpace, quotient
from nmatrix.raster.shading.texture import sample
from nmatrix.raster.triangles.fragments import Fragments, Interpolation, VertexOutputs
from nmatrix.raster.triangles.vertices import Projected
from nmatrix.scene.scene import Fog

Array = NDArray[Any]
READ_UV = frozenset({Effect.TEXTURE, Effect.NORMAL_MAP, Effect.EMISSION})


@dataclass(frozen=True, eq=False)
class PictureStyle:
    """Settings that all bodies of a picture share: shading, the rule for normals, fog, levels.

    `unit_vertices` is False for the mistake of leaving normals at vertices at any length.
    """

    shading: Shading
    channels: int
    rule: NormalRule = NormalRule.EXACT
    fog: Fog | None = None
    linear_light: bool = False
    unit_vertices: bool = True


@dataclass(frozen=True, eq=False)
class Surface:
    """One body in its shading space, under its lights, with the effects that its plan has on.

    `front` is the sign that the area of its front faces has on the canvas.
    """

    space: ShadingSpace
    lighting: Lighting
    style: PictureStyle
    effects: frozenset[Effect]
    front: int

    def vertex(self, projected: Projected) -> VertexOutputs:
        """Run the vertex shader: return the attributes that fragments read."""
        points, directions, faces = self._light_inputs(projected)
        mesh = self.space.body.mesh
        if self._reads_position:
            points["position"] = projected.per_vertex(self._positions)
        if self.effects & READ_UV:
            uv = np.zeros((2, len(mesh.positions))) if mesh.uv is None else mesh.uv.T
            points["uv"] = projected.per_vertex(uv)
        if Effect.VERTEX_COLOURS in self.effects and mesh.colours is not None:
            points["colour"] = projected.per_vertex(mesh.colours.T[: self.style.channels])
        if Effect.NORMAL_MAP in self.effects and mesh.tangents is not None:
            tangents = self.space.vectors(mesh.tangents[:, :3])
            points["tangent"] = projected.per_vertex(tangents)
            points["bitangent_sign"] = projected.per_vertex(mesh.tangents[:, 3:].T)
        front = self.front if self._is_sided else 0
        return VertexOutputs(points, directions, faces, self._interpolation, front)

    def fragment(self, fragments: Fragments) -> Array:
        """Run the fragment shader: return the colours (channels, m) of fragments, in [0, 1]."""
        matte, gloss = self._lit(fragments)
        if Effect.TEXTURE in self.effects:
            texture = self.space.body.material.texture
            assert texture is not None  # the plan has it on where the material names one
            texels = sample(texture, fragments["uv"], linear=self.style.linear_light)
            matte = matte * texels[: self.style.channels]
        if "colour" in fragments.values:
            matte = matte * fragments["colour"]
        if Effect.EMISSION in self.effects:
            matte = matte + self._emission(fragments)
        found = matte if gloss is None else matte + gloss
        found = np.minimum(found, 1.0)
        return self._in_fog(found, fragments) if Effect.FOG in self.effects else found

    def _emission(self, fragments: Fragments) -> Array:
        """Return the light (channels, m or 1) that the surface sends out itself."""
        material, channels = self.space.body.material, self.style.channels
        own = colour(material.emission, channels)
        if material.emission_texture is None:
            return own
        texels = sample(material.emission_texture, fragments["uv"], linear=self.style.linear_light)
        return np.asarray(own * texels[:channels])

    @property
    def _is_sided(self) -> bool:
        """True if backs are lit as backs; the sides of a flattened body cannot be told apart."""
        return Effect.BACK_FACES in self.effects and self.front != 0

    @property
    def _interpolation(self) -> Interpolation:
        if Effect.PERSPECTIVE not in self.effects:
            return Interpolation.AFFINE
        return Interpolation.EXACT if Effect.EXACT_WEIGHTS in self.effects else Interpolation.SUMS

    @property
    def _reads_position(self) -> bool:
        """True if fragments, and not only vertices, ask where they are."""
        if self.style.shading is Shading.PHONG:
            return Effect.POSITION in self.effects
        return Effect.FOG in self.effects

    @cached_property
    def _positions(self) -> Array:
        return self.space.positions()

    @cached_property
    def vertex_normals(self) -> Array:
        """Return the normals (3, V) of the vertices."""
        carry = self.space.normals if self.style.unit_vertices else self.space.carried_normals
        return self._on_seen_side(carry(self.style.rule), self._positions)

    def _on_seen_side(self, normals: Array, positions: Array) -> Array:
        """Return normals (3, n), turned to the eye if the body is flattened.

        It has two sides then and shows one. Normals turn where light or interpolation begins:
        between opposite ones interpolation would find none.
        """
        if self.space.body.linear_map.rank == 3:
            return normals
        return turned_towards(normals, self.lighting.eye - positions)

    def _light_inputs(
        self, projected: Projected
    ) -> tuple[dict[str, Array], dict[str, Array], dict[str, Array]]:
        """Return the inputs of the light: normals, or light itself, by vertex or by triangle."""
        if self.style.shading is Shading.PHONG:
            normals = {"normal": projected.per_vertex(self.vertex_normals)}
            is_unit = Effect.RENORMALISE in self.effects
            return ({}, normals, {}) if is_unit else (normals, {}, {})
        if self.style.shading is Shading.GOURAUD:
            found = self._evaluated(self.vertex_normals, self._positions)
            return {name: projected.per_vertex(one) for name, one in found.items()}, {}, {}
        middles = self._positions[:, self.space.body.mesh.triangles.T].mean(axis=1)
        of_faces = self._on_seen_side(self.space.face_normals(self.style.rule), middles)
        flat = self._evaluated(of_faces, middles)
        return {}, {}, {name: projected.per_triangle(one) for name, one in flat.items()}

    def _evaluated(self, normals: Array, positions: Array) -> dict[str, Array]:
        """Return the light at some points, on the front and, where it is seen, on the back."""
        found = {}
        sides = ("front", "back") if self._is_sided else ("front",)
        for side, sign in zip(sides, (1.0, -1.0), strict=False):
            matte, gloss = self.lighting.light(sign * normals, positions)
            found[f"matte_{side}"] = matte
            if gloss is not None:
                found[f"gloss_{side}"] = gloss
        return found

    def _lit(self, fragments: Fragments) -> Lit:
        if self.style.shading is Shading.PHONG:
            return self.lighting.light(self._normals(fragments), fragments.values.get("position"))
        return Lit(*(self._of_side(fragments.values, name) for name in ("matte", "gloss")))  # type: ignore[arg-type]  # matte is always there

    @staticmethod
    def _of_side(values: Mapping[str, Array], name: str) -> Array | None:
        """Return light of the side that is seen."""
        front, back = values.get(f"{name}_front"), values.get(f"{name}_back")
        if front is None or back is None:
            return front
        return np.where(values["facing"] > 0, front, back)

    def _normals(self, fragments: Fragments) -> Array:
        """Return the unit normals at fragments, on the side that is seen."""
        normals = fragments["normal"]
        if Effect.NORMAL_MAP in self.effects and "tangent" in fragments.values:
            normals = self._bumped(normals, fragments)
        if Effect.RENORMALISE in self.effects:
            normals = quotient(normals, self.space.measure.normal_length(normals))
        if "facing" in fragments.values:
            normals = normals * fragments["facing"]
        return normals

    def _bumped(self, normals: Array, fragments: Fragments) -> Array:
        image = self.space.body.material.normal_map
        assert image is not None  # the plan has it on where the material names one
        texels = sample(image, fragments["uv"], linear=False)
        signs = fragments["bitangent_sign"] * self.space.handed
        return bumped(normals, fragments["tangent"], signs, texels, self.space.measure)

    def _in_fog(self, colours: Array, fragments: Fragments) -> Array:
        fog = self.style.fog
        assert fog is not None  # the plan has it on where the scene names it
        distance = self.lighting.distance_to_eye(fragments["position"])
        share = np.clip((distance - fog.start) / (fog.end - fog.start), 0.0, 1.0)
        return np.asarray(colours + share * (colour(fog.color, len(colours)) - colours))
