"""Any file that can be drawn, as a scene: scene files, glTF files, meshes."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path

from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import identity
from nmatrix.scene.geometry import LoadedGeometry
from nmatrix.scene.material import DEFAULT_MATERIAL
from nmatrix.scene.scene import FileFeature, Scene, SceneNode, SceneObject, settings_of_file
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES
from nmatrix.scene.world import World

SUFFIXES = (".toml", *GLTF_SUFFIXES, *MESH_SUFFIXES)


def scene_of(path: Path, *, allow_outside: bool = False, has_materials: bool = True) -> Scene:
    """Read a scene from a .toml, .gltf or .glb file; a mesh stands still.

    What the file names lies in its folder, unless more is allowed. Without materials no file that a
    mesh names is looked for.

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
    return _mesh_scene(path, allow_outside=allow_outside, has_materials=has_materials)


def _features(objects: Sequence[SceneObject], left_out: Mapping[str, int]) -> Iterator[FileFeature]:
    """Count the materials of a mesh file and what they have, and what is not drawn."""
    materials = [one.material for one in objects if one.material is not DEFAULT_MATERIAL]
    counted = {
        "material": len(materials),
        "image": sum(one.texture is not None for one in materials),
        "colours of vertices": sum(one.vertex_colours for one in materials),
    }
    for feature, count in counted.items():
        if count:
            is_whole = feature != "material" or not any("material" in one for one in left_out)
            made_of_it = "drawn" if is_whole else "drawn but for what is named here"
            yield FileFeature(feature, count, made_of_it)
    for feature, count in left_out.items():
        yield FileFeature(feature, count, "not drawn")


def _mesh_scene(path: Path, *, allow_outside: bool, has_materials: bool) -> Scene:
    """Make a scene of a mesh file: an object for each material, all in the place of the file."""
    from nmatrix.scene.meshes.file import NO_TRIANGLES, read_surface, with_materials

    file, refusal = read_surface(path), None
    try:
        if has_materials:
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
        features=tuple(_features(objects, file.left_out)),
        nodes=(SceneNode(path.stem, still, World()),),
        refusal=refusal,
    )
