"""OBJ, PLY and STL files as meshes, with the materials that they name."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from pathlib import Path

from nmatrix.errors import IllegalValueError, printable
from nmatrix.scene.beside import asset_bytes, beside, check_content
from nmatrix.scene.material import Texture
from nmatrix.scene.meshes.mesh import Mesh, joined
from nmatrix.scene.meshes.mtl import Materials, coloured
from nmatrix.scene.meshes.obj import read_obj
from nmatrix.scene.meshes.parts import MeshFile, MeshPart
from nmatrix.scene.meshes.ply import read_ply
from nmatrix.scene.meshes.stl import read_stl
from nmatrix.scene.words import MESH_SUFFIXES

NO_TRIANGLES = ("it holds no triangles", "export it again")
READERS: dict[str, Callable[[Path, bytes], MeshFile]] = dict(
    zip(MESH_SUFFIXES, (read_obj, read_ply, read_stl), strict=True)
)


def read_mesh(path: Path) -> Mesh:
    """Read the triangles of a mesh file as one mesh, without its materials.

    Normals are the file's, or made where it has none, and a remark says so; triangles of STL files
    are flat. Texture coordinates and colours come along where every material has them.

    Raises
    ------
    IllegalValueError
        For a file that cannot be read, holds no triangles, or has numbers that are not finite.
    """
    found = read_surface(path)
    if not found.parts:
        raise IllegalValueError(f"{path}", *NO_TRIANGLES)
    mesh = joined([part.mesh for part in found.parts])
    return replace(mesh, remarks=found.remarks)


def read_mesh_file(path: Path, *, allow_outside: bool = False) -> MeshFile:
    """Read a mesh file, one part for each material, with what that material is.

    Raises
    ------
    IllegalValueError
        As `read_mesh` and `with_materials`.
    """
    return with_materials(path, read_surface(path), allow_outside=allow_outside)


def with_materials(path: Path, found: MeshFile, *, allow_outside: bool = False) -> MeshFile:
    """Give the parts of a mesh file their materials.

    Raises
    ------
    IllegalValueError
        For a material or an image that lies outside the file's folder, unless that is allowed.
    """
    materials = Materials(path, found.materials, allow_outside)
    if path.suffix.lower() == ".ply":
        return _with_image(path, found, allow_outside=allow_outside)
    materials.read(found.named or _beside(path, found))
    unused = _unused(path, found)
    parts = [
        replace(
            part,
            material=materials.material(part.name, vertex_colours=part.mesh.colours is not None),
        )
        for part in found.parts
    ]
    return replace(
        found,
        parts=tuple(parts),
        remarks=(*found.remarks, *unused, *materials.remarks),
        left_out={**found.left_out, **materials.counts},
    )


def _unused(path: Path, found: MeshFile) -> list[str]:
    """Tell of libraries that are named, of which no face uses a material."""
    if not found.named or any(part.name for part in found.parts):
        return []
    return [f"{path.name} names {printable(next(iter(found.named)))} and uses no material of it."]


def _beside(path: Path, found: MeshFile) -> Mapping[str, int]:
    """Name the library that is called as the file, where it names none and uses materials."""
    library = path.with_suffix(".mtl")
    is_used = library.is_file() and bool(found.materials)
    return {library.name: min(found.materials.values())} if is_used else {}


def read_surface(path: Path, content: bytes | None = None) -> MeshFile:
    """Read a mesh file, one part for each material, whatever these are.

    `content` is the file's, if it was read already.

    Raises
    ------
    IllegalValueError
        As `read_mesh`.
    """
    read = READERS.get(path.suffix.lower())
    if read is None:
        listed = ", ".join(MESH_SUFFIXES[:-1])
        why = f"meshes are {listed} or {MESH_SUFFIXES[-1]}, scenes .gltf or .glb"
        raise IllegalValueError(f"{path}", why, "check the name")
    if content is None:
        return read(path, asset_bytes(path))
    check_content(path, content)
    return read(path, content)


def _with_image(path: Path, found: MeshFile, *, allow_outside: bool) -> MeshFile:
    """Give the one part of a PLY file its colours, and its image if it has places on it."""
    (part,) = found.parts
    files = [beside(path, name, allow_outside=allow_outside) for name in found.named]
    missing = [
        f"Files are missing: {printable(file.name)} ({path.name}, line {line})."
        for file, line in zip(files, found.named.values(), strict=True)
        if not file.is_file()
    ]
    material = coloured() if part.mesh.colours is not None else None
    if len(files) == 1 and not missing and part.mesh.uv is not None:
        material = replace(
            material or coloured(),
            texture=Texture(files[0], is_optional=True),
            vertex_colours=part.mesh.colours is not None,
        )
    elif files and not missing:
        why = "images, which several faces choose from" if len(files) > 1 else "an image"
        missing = [f"Not drawn of {path.name}: {why}."]
    return replace(
        found,
        parts=(MeshPart(part.name, part.mesh, material),),
        remarks=(*found.remarks, *missing),
    )
