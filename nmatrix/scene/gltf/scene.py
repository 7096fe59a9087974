"""A glTF file as a scene: an object for each primitive of each node, cameras, lights, materials."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from nmatrix.errors import NMatrixError, printable, shortlist
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import Geometry, TangentGeometry
from nmatrix.scene.gltf.extensions import Treatment, treated
from nmatrix.scene.gltf.file import GltfFile, Node, read_gltf
from nmatrix.scene.gltf.lights import camera, carried_lights, radius_of, read_lights, unique
from nmatrix.scene.gltf.materials import Materials
from nmatrix.scene.gltf.records import NodeRecord, Primitive
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import Material
from nmatrix.scene.scene import Scene, SceneNode, SceneObject, Settings
from nmatrix.scene.world import World

if TYPE_CHECKING:
    from nmatrix.scene.meshes.mesh import Mesh

SIDE = 512  # pixels, the longer one
MOST_NAMED = 5  # extensions that a refusal names


def gltf_scene(path: Path, *, allow_outside: bool = False) -> Scene:
    """Read a glTF file as a scene; what is not drawn is named in the remarks.

    Raises
    ------
    IllegalValueError
        For a damaged file.
    """
    return _Reading(read_gltf(path, allow_outside=allow_outside)).scene()


@dataclass(frozen=True)
class GltfGeometry:
    """One primitive of one mesh of a glTF file."""

    file: GltfFile
    mesh_index: int
    primitive: int

    def mesh(self) -> Mesh:
        """Read the triangles."""
        from nmatrix.scene.gltf.accessors import primitive_mesh

        return primitive_mesh(self.file, self.mesh_index, self.primitive)


@dataclass(frozen=True, eq=False)
class _Reading:
    """A file on its way to a scene."""

    file: GltfFile

    @cached_property
    def materials(self) -> Materials:
        return Materials(self.file)

    def scene(self) -> Scene:
        objects = self._objects()
        carried = carried_lights(self.file, self.file.in_scene)
        places = [
            (node.world_from_object, node.mesh)
            for node in (self.file.nodes[i] for i in self.file.in_scene)
            if node.mesh is not None
        ]
        lights = read_lights(self.file, carried, radius_of(self.file, places)) if carried else ()
        view, lens, has_camera = self._camera()
        return Scene(
            objects=objects,
            lights=lights,
            view=view,
            lens=lens,
            settings=Settings(size=_size(float(lens.aspect_ratio))),
            has_camera=has_camera,
            path=self.file.path,
            remarks=(*self.file.remarks, *self._remarks(len(carried))),
            nodes=tuple(map(self._node, range(len(self.file.nodes)))),
            refusal=self._refusal(objects),
        )

    def _refusal(self, objects: tuple[SceneObject, ...]) -> NMatrixError | None:
        """Say why nothing of the file can be drawn, if so."""
        unknown = treated(self.file.document.extensions_required, Treatment.UNKNOWN)
        if unknown:
            names = shortlist(map(printable, unknown), MOST_NAMED)
            return self.file.fault(f"it requires {names}, which is not known here")
        if not objects:
            return self.file.fault("it draws nothing: there are no triangles in its scene")
        return None

    def _node(self, index: int) -> SceneNode:
        node = self.file.nodes[index]
        above = None if node.parent is None else self.file.nodes[node.parent].world_from_object
        own = _own_place(node, self.file.document.nodes[index])
        return SceneNode(node.name, node.world_from_object, own, above, node.parent)

    def _objects(self) -> tuple[SceneObject, ...]:
        addresses = self.file.hierarchy.addresses
        names = dict.fromkeys(addresses, 1)
        shared: dict[tuple[int, int], Geometry] = {}
        found = []
        for index in self.file.in_scene:
            node = self.file.nodes[index]
            if node.mesh is None:
                continue
            name = addresses[index]
            for i, primitive in enumerate(self.file.document.meshes[node.mesh].primitives):
                if not primitive.has_triangles:
                    continue
                key = (node.mesh, i)
                if key not in shared:
                    shared[key] = self._geometry(GltfGeometry(self.file, *key), primitive)
                found.append(self._object(index, name, shared[key], primitive))
                name = unique(addresses[index], names)
        return tuple(found)

    def _geometry(self, plain: GltfGeometry, primitive: Primitive) -> Geometry:
        """Return the triangles, with tangents that a normal map needs and the file lacks."""
        needed = self._material(primitive).normal_map and "TANGENT" not in primitive.attributes
        return TangentGeometry(plain) if needed else plain

    def _object(
        self, index: int, name: str, geometry: Geometry, primitive: Primitive
    ) -> SceneObject:
        node = self.file.nodes[index]
        above = None if node.parent is None else self.file.nodes[node.parent].world_from_object
        own = _own_place(node, self.file.document.nodes[index])
        return SceneObject(
            name, geometry, node.world_from_object, self._material(primitive), own, above, index
        )

    def _material(self, primitive: Primitive) -> Material:
        coloured = "COLOR_0" in primitive.attributes
        return self.materials.material(primitive.material, vertex_colours=coloured)

    @cached_property
    def _cameras(self) -> tuple[int, ...]:
        nodes = self.file.document.nodes
        return tuple(i for i in self.file.in_scene if nodes[i].camera is not None)

    def _camera(self) -> tuple[View, Lens, bool]:
        for index in self._cameras:
            camera_index = self.file.document.nodes[index].camera
            if camera_index is not None:
                return (*camera(self.file, self.file.nodes[index], camera_index), True)
        return View(), Lens(), False

    def _remarks(self, lights: int) -> tuple[str, ...]:
        document = self.file.document
        primitives = [p for mesh in document.meshes for p in mesh.primitives]
        others = sum(not one.has_triangles for one in primitives)
        left_out = treated(document.extensions_used, Treatment.LEFT_OUT, Treatment.UNKNOWN)
        outside = len(document.nodes) - len(self.file.in_scene)
        spoken = {
            f"Of {len(self._cameras)} cameras the first is used.": len(self._cameras) > 1,
            "Intensities of light are relative: the brightest light is 1.": lights,
            "Animations are not played.": document.animations,
            "Skins are not applied: meshes stand as they were modelled.": any(
                node.skin is not None for node in document.nodes
            ),
            "Morph targets are not applied.": any(one.targets for one in primitives),
            f"Points and lines are not drawn: {others}.": others,
            f"Nodes outside of the scene are not drawn: {outside}.": outside,
            f"Extensions are left out: {shortlist(map(printable, left_out))}.": left_out,
        }
        return (*(text for text, applies in spoken.items() if applies), *self.materials.remarks)


def _own_place(node: Node, record: NodeRecord) -> World:
    """Return a node's place under its parent, in parts where the file has parts."""
    if record.matrix is not None:
        return World(matrix=node.local)
    return World(
        translate=tuple(record.translation or (0, 0, 0)),
        quaternion=None if record.rotation is None else tuple(record.rotation),
        scale=tuple(record.scale or (1, 1, 1)),
    )


def _size(aspect: float) -> tuple[int, int]:
    """Return a picture of the lens's shape.

    Examples
    --------
    >>> _size(2.0), _size(0.5)
    ((512, 256), (256, 512))
    """
    if aspect >= 1:
        return SIDE, max(1, round(SIDE / aspect))
    return max(1, round(SIDE * aspect)), SIDE
