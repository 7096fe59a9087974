"""What the nodes of a glTF file draw: an object for each primitive in each place of its mesh."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING

from nmatrix.errors import IllegalValueError, printable, shortlist
from nmatrix.linear.classify import FROM_FILE, classify
from nmatrix.linear.rational import RationalMatrix, identity
from nmatrix.scene.geometry import DamagedPartError, Geometry, TangentGeometry, left_out
from nmatrix.scene.gltf.animations import Animated, animated_channels
from nmatrix.scene.gltf.file import GltfFile
from nmatrix.scene.gltf.instances import instance_count, instance_matrices, is_instanced
from nmatrix.scene.gltf.lights import unique
from nmatrix.scene.gltf.materials import Materials
from nmatrix.scene.gltf.primitives import Content, Pose, content_of, corners_of
from nmatrix.scene.gltf.records import LINE_LOOP, LINE_STRIP, LINES, POINTS, Primitive
from nmatrix.scene.gltf.skins import joint_matrices
from nmatrix.scene.material import Material
from nmatrix.scene.scene import SceneNode, SceneObject
from nmatrix.scene.words import Mover
from nmatrix.scene.world import World

if TYPE_CHECKING:
    from nmatrix.scene.meshes.mesh import Mesh

MOST_OBJECTS = 1 << 18
MOST_CORNERS = 1 << 27  # of triangles, those of an instance each time that it is drawn
MOST_NAMED = 5  # nodes that a remark names
STILL = (identity(4),)
WORDS = {POINTS: "points", **dict.fromkeys((LINES, LINE_LOOP, LINE_STRIP), "lines")}


@dataclass(frozen=True)
class GltfGeometry:
    """One primitive of one mesh of a glTF file, at rest."""

    file: GltfFile
    mesh_index: int
    primitive: int
    pose: Pose
    coordinates: int = 0

    def mesh(self) -> Mesh:
        """Read the triangles, with one of their sets of texture coordinates."""
        from nmatrix.scene.gltf.meshes import primitive_mesh

        return primitive_mesh(
            self.file, self.mesh_index, self.primitive, self.pose, self.coordinates
        )


@dataclass(frozen=True, eq=False)
class Objects:
    """The objects of a file; nodes whose places cannot be read become faults."""

    file: GltfFile
    materials: Materials
    faults: list[DamagedPartError] = field(default_factory=list)

    @cached_property
    def drawn(self) -> tuple[SceneObject, ...]:
        """The objects: instances each by itself, and what is the same read once."""
        addresses = self.file.hierarchy.addresses
        names = dict.fromkeys(addresses, 1)
        found = []
        for index, places in self.places.items():
            name, mesh = addresses[index], self.file.nodes[index].mesh
            for world in places:
                for i, primitive in self._with_triangles(mesh):
                    found.append(self._object(index, name, i, primitive, world))
                    name = unique(addresses[index], names)
        return tuple(found)

    def node(self, index: int) -> SceneNode:
        """Return a node under its parent, whether it draws anything or not."""
        if index not in self._nodes:
            node, nodes = self.file.nodes[index], self.file.nodes
            above = None if node.parent is None else nodes[node.parent].world_from_object
            place = _own_place(self.file, index)
            self._nodes[index] = SceneNode(
                node.name, node.world_from_object, place, above, node.parent, self._movers(index)
            )
        return self._nodes[index]

    def _movers(self, index: int) -> tuple[Mover, ...]:
        found = {
            Mover.JOINTS: self.file.nodes[index].mesh is not None and self._is_skinned(index),
            Mover.INSTANCES: is_instanced(self.file, index),
            Mover.ANIMATION: index in self._animated,
        }
        return tuple(mover for mover, applies in found.items() if applies)

    @cached_property
    def _animated(self) -> frozenset[int]:
        """The nodes that an animation moves, or a node above them."""
        moving = {Animated.TRANSLATION, Animated.ROTATION, Animated.SCALE}
        found = {i for i, changed in animated_channels(self.file).items() if changed & moving}
        for index in self.file.nodes.order:  # parents come first
            if self.file.nodes[index].parent in found:
                found.add(index)
        return frozenset(found)

    @cached_property
    def _nodes(self) -> dict[int, SceneNode]:
        return {}

    @cached_property
    def places(self) -> dict[int, tuple[RationalMatrix, ...]]:
        """Where each node of the scene draws its mesh; one that joints carry needs no place."""
        found: dict[int, tuple[RationalMatrix, ...]] = {}
        for index in () if self.too_large else self._drawing:
            try:
                found[index] = self._places(index)
            except IllegalValueError as error:
                name = f"node {index} ({printable(self.file.nodes[index].name)})"
                self.faults.append(DamagedPartError(self.file.path, name, error))
        return found

    @cached_property
    def _drawing(self) -> list[int]:
        """The nodes of the scene that have triangles."""
        return [i for i in self.file.in_scene if self._with_triangles(self.file.nodes[i].mesh)]

    @cached_property
    def too_large(self) -> IllegalValueError | None:
        """Why the scene is more than memory and patience hold, if so; no place is computed yet."""
        objects, corners = self._size(frozenset())
        if corners > MOST_CORNERS:  # some may be claimed without a byte behind them
            objects, corners = self._size(self.file.beyond_bytes)
        for number, most, what in (
            (objects, MOST_OBJECTS, "objects"),
            (corners, MOST_CORNERS, "corners of triangles"),
        ):
            if number > most:
                why = f"its scene has {number} {what}, and {most} are drawn at most"
                return self.file.fault(why, "draw it in parts")
        return None

    def _size(self, false_claims: frozenset[Content]) -> tuple[int, int]:
        """Count the objects and their corners, but for those of some primitives."""
        objects = corners = 0
        of_meshes: dict[int | None, int] = {}
        for index in self._drawing:
            mesh = self.file.nodes[index].mesh
            primitives = self._with_triangles(mesh)
            if mesh not in of_meshes:
                of_meshes[mesh] = sum(
                    corners_of(self.file.document, one)
                    for _, one in primitives
                    if content_of(one) not in false_claims
                )
            count = 1 if self._is_skinned(index) else instance_count(self.file, index)
            objects += count * len(primitives)
            corners += count * of_meshes[mesh]
        return objects, corners

    def remarks(self) -> Iterator[str]:
        """Tell what is not drawn, and of which nodes the own transform does not count."""
        yield from left_out(self.faults)
        if self.others:
            yield f"Primitives that are not drawn: {self.told_of_others}."
        by_joints = [
            printable(self.file.nodes[index].name)
            for index in self.places
            if self._is_skinned(index) and self.file.nodes[index].world_from_object != STILL[0]
        ]
        if by_joints:
            told = shortlist(by_joints, MOST_NAMED)
            yield f"Joints carry the meshes of nodes whose own transforms do not count: {told}."
        yield from self._remarks_on_joints()

    def _remarks_on_joints(self) -> Iterator[str]:
        """Count the joints that bend normals, which a picture does not show: they are undone."""
        skins = {self.file.document.nodes[i].skin for i in self.places if self._is_skinned(i)}
        joints: list[RationalMatrix] = []
        for skin in skins - {None}:
            try:
                joints += joint_matrices(self.file, skin or 0)
            except IllegalValueError:  # a fault of each part that it carries
                continue
        bending = sum(classify(one, FROM_FILE).needs_inverse_transpose for one in joints)
        if bending:
            verb = "needs" if bending == 1 else "need"
            yield (
                f"Of {len(joints)} joints {bending} {verb} the inverse transpose: here skinned "
                "meshes have gone through their joints already, with the right normals; a shader "
                "that blends joints has to see to that."
            )

    @cached_property
    def others(self) -> Counter[str]:
        """What the file's primitives without triangles are made of, counted."""
        return Counter(
            _kind(one)
            for mesh in self.file.document.meshes
            for one in mesh.primitives
            if not one.has_triangles
        )

    @property
    def told_of_others(self) -> str:
        """The same in words."""
        return ", ".join(f"{count} {what}" for what, count in self.others.items())

    def _is_skinned(self, index: int) -> bool:
        return self.file.document.nodes[index].skin is not None

    def _places(self, index: int) -> tuple[RationalMatrix, ...]:
        return STILL if self._is_skinned(index) else instance_matrices(self.file, index)

    def _with_triangles(self, mesh: int | None) -> list[tuple[int, Primitive]]:
        """List the primitives of a mesh that have triangles, with their indices."""
        if mesh is None:
            return []
        if mesh not in self._primitives:
            every = enumerate(self.file.document.meshes[mesh].primitives)
            self._primitives[mesh] = [(i, one) for i, one in every if one.has_triangles]
        return self._primitives[mesh]

    @cached_property
    def _primitives(self) -> dict[int, list[tuple[int, Primitive]]]:
        return {}

    @cached_property
    def _geometries(self) -> dict[Content, Geometry]:
        return {}

    def _object(
        self, index: int, name: str, number: int, primitive: Primitive, world: RationalMatrix
    ) -> SceneObject:
        geometry = self._geometry(index, number, primitive)
        material = self._material(primitive)
        if self._is_skinned(index) or is_instanced(self.file, index):
            return SceneObject(name, geometry, world, material, node=index)
        node = self.node(index)
        return SceneObject(
            name, geometry, world, material, node.place, node.world_from_parent, index
        )

    def _geometry(self, index: int, number: int, primitive: Primitive) -> Geometry:
        """Return the triangles, with tangents that a normal map needs and the file lacks."""
        record, mesh = self.file.document.nodes[index], self.file.nodes[index].mesh or 0
        own = record.weights
        weights = self.file.document.meshes[mesh].weights if own is None else own
        pose = Pose(tuple(weights) if primitive.targets and any(weights) else (), record.skin)
        has_tangents = {"TANGENT", "NORMAL"} <= set(primitive.attributes)
        needs_tangents = self._material(primitive).normal_map is not None and not has_tangents
        coordinates = self.materials.coordinates(primitive.material)
        key = (content_of(primitive), pose, needs_tangents, coordinates)
        if key not in self._geometries:
            plain = GltfGeometry(self.file, mesh, number, pose, coordinates)
            self._geometries[key] = TangentGeometry(plain) if needs_tangents else plain
        return self._geometries[key]

    def _material(self, primitive: Primitive) -> Material:
        coloured = "COLOR_0" in primitive.attributes
        return self.materials.material(primitive.material, vertex_colours=coloured)


def _kind(primitive: Primitive) -> str:
    """Name what a primitive without triangles is made of."""
    if "POSITION" not in primitive.attributes:
        return "without positions"
    return f"of {WORDS.get(primitive.mode, 'an unknown mode')}"


def _own_place(file: GltfFile, index: int) -> World:
    """Return a node's place under its parent, in parts where the file has parts."""
    record = file.document.nodes[index]
    if record.matrix is not None:
        return World(matrix=file.nodes[index].local)
    return World(
        translate=tuple(record.translation or (0, 0, 0)),
        quaternion=None if record.rotation is None else tuple(record.rotation),
        scale=tuple(record.scale or (1, 1, 1)),
    )
