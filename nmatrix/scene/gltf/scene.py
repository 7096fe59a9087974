"""A glTF file as a scene: an object for each primitive of each node, cameras, lights, materials."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from nmatrix.scene.camera import View
from nmatrix.scene.geometry import Geometry, TangentGeometry
from nmatrix.scene.gltf.file import GltfFile, Node, read_gltf
from nmatrix.scene.gltf.lights import LIGHTS, camera, carried_lights, radius_of, read_lights, unique
from nmatrix.scene.gltf.materials import TEXTURE_TRANSFORM, Materials
from nmatrix.scene.gltf.records import NodeRecord, Primitive
from nmatrix.scene.lens import Lens
from nmatrix.scene.material import Material
from nmatrix.scene.scene import Scene, SceneObject, Settings
from nmatrix.scene.world import World

if TYPE_CHECKING:
    from nmatrix.scene.meshes.mesh import Mesh

SIDE = 512  # pixels, the longer one
DRAWN = (LIGHTS, TEXTURE_TRANSFORM)  # extensions
# Their meshes cannot be read without them.
PACKED = ("KHR_draco_mesh_compression", "EXT_meshopt_compression")


def gltf_scene(path: Path) -> Scene:
    """Read a glTF file as a scene; what is not drawn is named in the remarks.

    Raises
    ------
    IllegalValueError
        For a damaged file, or one that draws nothing.
    """
    return _Reading(read_gltf(path)).scene()


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

    @cached_property
    def drawn(self) -> tuple[int, ...]:
        """The nodes of the default scene, parents first, in the file's order."""
        document = self.file.document
        if not document.scenes:
            roots = [i for i, node in enumerate(self.file.nodes) if node.parent is None]
        else:
            roots = self.file.entry("scene", document.scenes, document.scene or 0).nodes
        waiting, found = list(reversed(roots)), dict[int, None]()
        while waiting:
            at = waiting.pop()
            node = self.file.entry("node", document.nodes, at)
            if at not in found:
                found[at] = None
                waiting.extend(reversed(node.children))
        return tuple(found)

    def scene(self) -> Scene:
        packed = [one for one in PACKED if one in self.file.document.extensions_required]
        if packed:
            raise self.file.fault(
                f"its meshes are packed by {packed[0]}, which this reader does not know"
            )
        objects = self._objects()
        if not objects:
            raise self.file.fault("it draws nothing: there are no triangles in its scene")
        carried = carried_lights(self.file, self.drawn)
        places = [
            (node.world_from_object, node.mesh)
            for node in (self.file.nodes[i] for i in self.drawn)
            if node.mesh is not None
        ]
        lights = read_lights(self.file, carried, radius_of(self.file, places)) if carried else ()
        view, lens, has_camera = self._camera()
        return Scene(
            objects=objects,
            lights=lights,
            view=view,
            lens=lens,
            settings=Settings(size=_size(lens.aspect)),
            has_camera=has_camera,
            path=self.file.path,
            remarks=(*self.file.remarks, *self._remarks(len(carried))),
        )

    def _objects(self) -> tuple[SceneObject, ...]:
        names: dict[str, int] = {}
        shared: dict[tuple[int, int], Geometry] = {}
        found = []
        for index in self.drawn:
            node = self.file.nodes[index]
            if node.mesh is None:
                continue
            for i, primitive in enumerate(self.file.document.meshes[node.mesh].primitives):
                if not primitive.has_triangles:
                    continue
                key = (node.mesh, i)
                if key not in shared:
                    shared[key] = self._geometry(GltfGeometry(self.file, *key), primitive)
                geometry = shared[key]
                found.append(self._object(index, unique(node.name, names), geometry, primitive))
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
            name, geometry, node.world_from_object, self._material(primitive), own, above
        )

    def _material(self, primitive: Primitive) -> Material:
        coloured = "COLOR_0" in primitive.attributes
        return self.materials.material(primitive.material, vertex_colours=coloured)

    @cached_property
    def _cameras(self) -> tuple[int, ...]:
        nodes = self.file.document.nodes
        return tuple(i for i in self.drawn if nodes[i].camera is not None)

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
        unknown = [one for one in document.extensions_used if one not in DRAWN]
        outside = len(document.nodes) - len(self.drawn)
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
            f"Extensions are left out: {', '.join(unknown)[:200]}.": unknown,
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
