"""Any file that can be drawn, as a scene: scene files, glTF files, meshes."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import identity
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.material import DEFAULT_MATERIAL
from nmatrix.scene.scene import FileFeature, Scene, SceneNode, SceneObject, settings_of_file
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES
from nmatrix.scene.world import World

SUFFIXES = (".toml", *GLTF_SUFFIXES, *MESH_SUFFIXES)


def scene_of(path: Path, *, allow_outside: bool = False) -> Scene:
    """Read a scene from a .toml, .gltf or .glb file; a mesh stands still.

    What the file names lies in its folder, unless more is allowed.

    Raises
    ------
    IllegalValueError
        For another kind of file, one that is not there, or one that is damaged.
    """
    suffix = path.suffix.lower()
    if suffix == ".toml":
        from nmatrix.scene.toml.file import read_scene

        return read_scene(path, allow_outside=allow_outside)
    if suffix in GLTF_SUFFIXES:
        from nmatrix.scene.gltf.scene import gltf_scene

        return gltf_scene(path, allow_outside=allow_outside)
    if suffix not in MESH_SUFFIXES:
        raise IllegalValueError(
            f"{path}", f"scenes and meshes are {', '.join(SUFFIXES)}", "check the name"
        )
    if not path.is_file():
        raise IllegalValueError(f"{path}", "there is no such file", "check the name")
    return _mesh_scene(path, allow_outside=allow_outside)


def _features(objects: Sequence[SceneObject]) -> Iterator[FileFeature]:
    """Count the materials of a mesh file and what they have."""
    materials = [one.material for one in objects if one.material is not DEFAULT_MATERIAL]
    counted = {
        "material": len(materials),
        "image": sum(one.texture is not None for one in materials),
        "colours of vertices": sum(one.vertex_colours for one in materials),
    }
    for feature, count in counted.items():
        if count:
            yield FileFeature(feature, count, "drawn")


def _mesh_scene(path: Path, *, allow_outside: bool) -> Scene:
    """Make a scene of a mesh file: an object for each material, all in the place of the file."""
    from nmatrix.scene.meshes.file import NO_TRIANGLES, read_surface, with_materials

    file, refusal = read_surface(path), None
    try:
        file = with_materials(path, file, allow_outside=allow_outside)
    except IllegalValueError as error:  # matrices need no material, pictures do
        refusal = error
    if not file.parts:
        refusal = IllegalValueError(f"{path}", *NO_TRIANGLES)
    still = identity(4)
    names = [
        path.stem if len(file.parts) == 1 else f"{path.stem}/{part.name or DEFAULT_MATERIAL.name}"
        for part in file.parts
    ]
    objects = tuple(
        SceneObject(
            name,
            LoadedGeometry(part.mesh),
            still,
            part.material or DEFAULT_MATERIAL,
            World(),
            node=0,
        )
        for name, part in zip(names, file.parts, strict=True)
    )
    return Scene(
        objects,
        settings=settings_of_file(gamma=False),
        has_camera=False,
        path=path,
        remarks=file.remarks,
        features=tuple(_features(objects)),
        nodes=(SceneNode(path.stem, still, World()),),
        refusal=refusal,
    )
