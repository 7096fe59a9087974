"""A glTF file as a scene: an object for each primitive of each node, cameras, lights, materials."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

from nmatrix.errors import IllegalValueError, NMatrixError, counted, printable, shortlist
from nmatrix.scene.camera import View
from nmatrix.scene.geometry import DamagedPartError, left_out
from nmatrix.scene.gltf.extensions import Treatment, treated
from nmatrix.scene.gltf.file import GltfFile, read_gltf
from nmatrix.scene.gltf.instances import is_instanced
from nmatrix.scene.gltf.lights import camera, carried_lights, placed_lights, radius_of
from nmatrix.scene.gltf.materials import Materials
from nmatrix.scene.gltf.objects import Objects
from nmatrix.scene.lens import Lens
from nmatrix.scene.scene import FileFeature, Scene, SceneObject, settings_of_file

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


@dataclass(frozen=True, eq=False)
class _Reading:
    """A file on its way to a scene."""

    file: GltfFile
    dark: list[DamagedPartError] = field(default_factory=list)  # lights that are left out
    blind: list[DamagedPartError] = field(default_factory=list)  # cameras that are left out

    @cached_property
    def materials(self) -> Materials:
        return Materials(self.file)

    @cached_property
    def objects(self) -> Objects:
        return Objects(self.file, self.materials)

    def scene(self) -> Scene:
        objects = self.objects.drawn
        carried = carried_lights(self.file, self.file.in_scene, self.dark)
        places = [
            (world, mesh)
            for index, worlds in self.objects.places.items()
            for world in worlds
            if (mesh := self.file.nodes[index].mesh) is not None
        ]
        lights = placed_lights(carried, radius_of(self.file, places)) if carried else ()
        view, lens, has_camera = self._camera
        return Scene(
            objects=objects,
            lights=lights,
            view=view,
            lens=lens,
            settings=settings_of_file(gamma=True, size=_size(float(lens.aspect_ratio))),
            has_camera=has_camera,
            is_framed=has_camera and lens.aspect is not None,
            path=self.file.path,
            remarks=(*self.file.remarks, *self._remarks(len(carried))),
            nodes=tuple(map(self.objects.node, range(len(self.file.nodes)))),
            refusal=self._refusal(objects),
            features=tuple(self._features(len(carried))),
        )

    def _features(self, lights: int) -> Iterator[FileFeature]:
        """Count what the file has, drawn or not."""
        document, shown = self.file.document, self.file.in_scene
        nodes = [document.nodes[i] for i in shown]
        primitives = [one for mesh in document.meshes for one in mesh.primitives]
        counted = {
            "camera": (len(self._cameras), self._use_of_cameras),
            "light": (lights, "drawn, relative to the brightest"),
            "material": (len(document.materials), "drawn but for what is named here"),
            "skinned node": (
                sum(node.skin is not None for node in nodes),
                "carried by its joints, at rest",
            ),
            "primitive with morph targets": (
                sum(bool(one.targets) for one in primitives),
                "at the weights of rest",
            ),
            "instanced node": (
                sum(is_instanced(self.file, i) for i in shown),
                "each instance is drawn",
            ),
            "animation": (len(document.animations), "not played"),
            "node outside of the scene": (len(document.nodes) - len(shown), "not drawn"),
        }
        for feature, (count, made_of_it) in counted.items():
            if count:
                yield FileFeature(feature, count, made_of_it)
        for what, count in self.objects.others.items():
            yield FileFeature(f"primitive {what}", count, "not drawn")
        for what, materials in sorted(self.materials.left_out.items()):
            yield FileFeature(f"material with {what}", len(materials), f"{what} not drawn")
        for one in treated(document.extensions_used, Treatment.LEFT_OUT, Treatment.UNKNOWN):
            yield FileFeature(f"extension {printable(one)}", 1, "left out")

    def _refusal(self, objects: tuple[SceneObject, ...]) -> NMatrixError | None:
        """Say why nothing of the file can be drawn, if so."""
        unknown = treated(self.file.document.extensions_required, Treatment.UNKNOWN)
        if unknown:
            names = shortlist(map(printable, unknown), MOST_NAMED)
            return self.file.fault(f"it requires {names}, which is not known here")
        if self.objects.too_large:
            return self.objects.too_large
        if not objects and self.objects.faults:
            return self.objects.faults[0]
        if not objects:
            others = self.objects.told_of_others
            beside = f" (other primitives: {others})" if others else ""
            why = f"it draws nothing: there are no triangles in its scene{beside}"
            shown = set(self.file.in_scene)
            outside = sum(
                one.mesh is not None and i not in shown
                for i, one in enumerate(self.file.document.nodes)
            )
            if not outside:
                return self.file.fault(why, "nmatrix inspect lists its nodes")
            nodes = counted(outside, "node with a mesh is", "nodes with a mesh are")
            return self.file.fault(f"{why}, and {nodes} outside of it", "put them into the scene")
        return None

    @cached_property
    def _cameras(self) -> tuple[int, ...]:
        nodes = self.file.document.nodes
        return tuple(i for i in self.file.in_scene if nodes[i].camera is not None)

    @cached_property
    def _camera(self) -> tuple[View, Lens, bool]:
        """Find the first camera that can be used; one that cannot becomes a fault."""
        for index in self._cameras:
            node = self.file.nodes[index]
            try:
                return (*camera(self.file, node), True)
            except IllegalValueError as error:
                name = f"the camera of node {index} ({printable(node.name)})"
                self.blind.append(DamagedPartError(self.file.path, name, error))
        return View(), Lens(), False

    @property
    def _use_of_cameras(self) -> str:
        """Which of the cameras is used."""
        *_, is_used = self._camera
        if not is_used:
            return "none can be used"
        return "the first that can be is used" if self.blind else "the first is used"

    def _remarks(self, lights: int) -> tuple[str, ...]:
        document = self.file.document
        passed_over = treated(document.extensions_used, Treatment.LEFT_OUT, Treatment.UNKNOWN)
        outside = len(document.nodes) - len(self.file.in_scene)
        spoken = {
            f"Of {len(self._cameras)} cameras {self._use_of_cameras}.": len(self._cameras) > 1,
            "Intensities of light are relative: the brightest light is 1.": lights,
            "Animations are not played.": document.animations,
            f"Nodes outside of the scene are not drawn: {outside}.": outside,
            f"Extensions are left out: {shortlist(map(printable, passed_over))}.": passed_over,
        }
        return (
            *(text for text, applies in spoken.items() if applies),
            *left_out((*self.dark, *self.blind), "used"),
            *self.objects.remarks(),
            *self.materials.remarks,
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
