"""Any file that can be drawn, as a scene: scene files, glTF files, meshes."""

from __future__ import annotations

from pathlib import Path

from nmatrix.errors import IllegalValueError
from nmatrix.linear.rational import identity
from nmatrix.scene.geometry import FileGeometry
from nmatrix.scene.scene import Scene, SceneNode, SceneObject, settings_of_file
from nmatrix.scene.words import GLTF_SUFFIXES, MESH_SUFFIXES
from nmatrix.scene.world import World

SUFFIXES = (".toml", *GLTF_SUFFIXES, *MESH_SUFFIXES)


def scene_of(path: Path, *, allow_outside: bool = False) -> Scene:
    """Read a scene from a .toml, .gltf or .glb file; a mesh is one object that stands still.

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
    still = SceneObject(path.stem, FileGeometry(path), identity(4), place=World())
    node = SceneNode(path.stem, identity(4), World())
    settings = settings_of_file(gamma=False)
    return Scene((still,), settings=settings, has_camera=False, path=path, nodes=(node,))
