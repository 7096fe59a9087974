"""The objects of a scene file: names, geometry, materials, and the hierarchy of their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nmatrix.enums import Convention
from nmatrix.errors import NMatrixError
from nmatrix.linear.rational import (
    RationalMatrix,
    affine_matrix,
    product,
    rational_matrix,
    to_floats,
)
from nmatrix.scene.geometry import FileGeometry, Geometry, ShapeGeometry, TangentGeometry
from nmatrix.scene.light import EYE, WORLD
from nmatrix.scene.material import DEFAULT_MATERIAL, Material
from nmatrix.scene.scene import SceneObject
from nmatrix.scene.toml.faults import Place, converted
from nmatrix.scene.toml.records import ObjectRecord
from nmatrix.scene.words import Shape
from nmatrix.scene.world import World

MESHES = (".obj", ".ply", ".stl")
LARGEST_MATRIX = 4
FEWEST = {Shape.SPHERE: 3, Shape.TORUS: 3, Shape.CONE: 3, Shape.PLANE: 1, Shape.BOX: 1}
_PARTS = ("translate", "rotate", "order", "quaternion", "scale", "shear", "convention")


@dataclass(frozen=True)
class Entry:
    """An object as the file has it, with the name that it goes by."""

    name: str
    record: ObjectRecord
    place: Place

    @property
    def is_group(self) -> bool:
        """Return whether it draws nothing itself."""
        return self.record.shape is self.record.mesh is self.record.copy_of is None


def entries(tables: Sequence[Place]) -> dict[str, Entry]:
    """Return the objects by name.

    Raises
    ------
    IllegalValueError
        For a table that is no object, or a name that is taken.
    """
    found: dict[str, Entry] = {}
    for index, place in enumerate(tables):
        record = converted(place, ObjectRecord)
        name = record.name or f"object {index + 1}"
        if name in (WORLD, EYE):
            raise place.fault("name", f"lights are fixed to {name} by this word", "choose another")
        if name in found:
            raise place.fault("name", "another object has it already", "choose another")
        found[name] = Entry(name, record, place)
    return found


def objects(
    by_name: Mapping[str, Entry], materials: Mapping[str, Material]
) -> tuple[SceneObject, ...]:
    """Return what is drawn, in the file's order, each in its place in the world.

    Raises
    ------
    IllegalValueError
        For contradictions, unknown names, cycles, and files that are missing.
    """
    own = {name: own_place(entry) for name, entry in by_name.items()}
    worlds: dict[str, RationalMatrix] = {}
    for entry in _parents_first(by_name):
        worlds[entry.name] = _under(entry, worlds.get(entry.record.parent or ""), own[entry.name])
    drawn = {name: entry for name, entry in by_name.items() if not entry.is_group}
    origins = {name: _origin(entry, drawn) for name, entry in drawn.items()}
    geometries = {name: _geometry(e) for name, e in origins.items() if e.name == name}
    with_tangents = {name: TangentGeometry(plain) for name, plain in geometries.items()}
    found = []
    for name, origin in origins.items():
        material = _material(by_name[name], origin, materials)
        source: Mapping[str, Geometry] = with_tangents if material.normal_map else geometries
        above = worlds.get(by_name[name].record.parent or "")
        geometry = source[origin.name]
        found.append(SceneObject(name, geometry, worlds[name], material, own[name], above))
    return tuple(found)


def _parents_first(by_name: Mapping[str, Entry]) -> list[Entry]:
    """Return the objects so that every parent stands before its children."""
    children: dict[str | None, list[Entry]] = {}
    for entry in by_name.values():
        parent = entry.record.parent
        if parent is not None:
            entry.place.known("parent", parent, by_name, "object")
        children.setdefault(parent, []).append(entry)
    order = list(children.get(None, ()))
    for entry in order:  # grows while it is walked
        order.extend(children.get(entry.name, ()))
    if len(order) < len(by_name):
        seen = {entry.name for entry in order}
        lost = next(entry for entry in by_name.values() if entry.name not in seen)
        raise lost.place.fault("parent", "it is its own ancestor: the hierarchy is a cycle")
    return order


def _under(entry: Entry, above: RationalMatrix | None, own: World) -> RationalMatrix:
    """Return the world matrix, rounded once, under the parent's."""
    try:
        return rational_matrix(to_floats(world_under(above, own).exact))
    except NMatrixError as error:
        raise entry.place.refused("its place", str(error), "") from None


def world_under(world_from_parent: RationalMatrix | None, own: World) -> World:
    """Return an object's place in the world, from its place under its parent.

    Examples
    --------
    >>> above = World(scale=(1, 2, 1)).world_from_object
    >>> found = world_under(above, World(translate=(0, 3, 0)))
    >>> int(found.world_from_object[1][3])
    6
    """
    if world_from_parent is None:
        return own
    return World(convention=own.convention, matrix=product(world_from_parent, own.exact))


def own_place(entry: Entry) -> World:
    """Return an object's place under its parent.

    Raises
    ------
    IllegalValueError
        For a matrix beside its parts, or parts that contradict each other.
    """
    record, place = entry.record, entry.place
    if record.matrix is not None:
        _refuse_beside(place, "matrix", _PARTS, "the matrix is the whole answer")
        return World(matrix=matrix_of(place, "matrix", record.matrix))
    if record.quaternion is not None:
        _refuse_beside(place, "quaternion", ("rotate", "order"), "both are the rotation")
        if not any(record.quaternion):
            raise place.fault("quaternion", "it has no direction", "no rotation is 0 0 0 1")
    scale = (record.scale,) * 3 if isinstance(record.scale, float) else record.scale
    try:
        return World(
            translate=record.translate or (0, 0, 0),
            rotate_degrees=record.rotate or (0, 0, 0),
            quaternion=record.quaternion,
            scale=scale or (1, 1, 1),
            shear=record.shear or (0, 0, 0),
            order=record.order or "XYZ",
            convention=record.convention or Convention.STANDARD,
        )
    except NMatrixError as error:
        raise place.refused("its place", str(error).replace("--", ""), "") from None


def _refuse_beside(place: Place, key: str, others: Sequence[str], because: str) -> None:
    beside = [other for other in others if other in place.raw]
    if beside:
        raise place.refused(f"{key} with {', '.join(beside)}", because, "keep one of them")


def matrix_of(place: Place, key: str, rows: Sequence[Sequence[float]]) -> RationalMatrix:
    """Return an affine 4×4 matrix from its rows; three rows are its linear part.

    Raises
    ------
    IllegalValueError
        For another size, or a last row other than 0 0 0 1.
    """
    size = len(rows)
    if size not in (3, LARGEST_MATRIX) or any(len(row) != size for row in rows):
        raise place.fault(key, "it is three rows of three numbers or four rows of four")
    exact = rational_matrix(rows)
    if size == LARGEST_MATRIX and tuple(rows[3]) != (0, 0, 0, 1):
        raise place.refused(
            f"{key} (last row {' '.join(f'{x:g}' for x in rows[3])})",
            "an affine matrix ends in 0 0 0 1",
            "write rows, not columns",
        )
    return exact if size == LARGEST_MATRIX else affine_matrix(exact)


def _origin(entry: Entry, drawn: Mapping[str, Entry]) -> Entry:
    """Return the object whose triangles this one shares, itself if it has its own."""
    at, passed = entry, [entry.name]
    while at.record.copy_of is not None:
        _refuse_beside(at.place, "copy_of", ("shape", "mesh", "tessellation"), "a copy shares them")
        at = drawn[at.place.known("copy_of", at.record.copy_of, drawn, "drawn object")]
        if at.name in passed:
            raise entry.place.fault("copy_of", "it is a copy of itself", "name an original")
        passed.append(at.name)
    return at


def _geometry(entry: Entry) -> Geometry:
    record, place = entry.record, entry.place
    if record.mesh is not None:
        _refuse_beside(place, "mesh", ("shape", "tessellation"), "a mesh has its own triangles")
        path = place.file("mesh")
        if path.suffix.lower() not in MESHES:
            raise place.fault(
                "mesh", "meshes are .obj, .ply or .stl", "render a glTF file by itself"
            )
        return FileGeometry(path)
    assert record.shape is not None  # groups do not come here
    return ShapeGeometry(record.shape, _tessellation(entry, record.shape))


def _tessellation(entry: Entry, shape: Shape) -> tuple[int, ...]:
    """Return how finely the shape is cut; one number for two means twice as many sectors."""
    given = entry.record.tessellation
    if given is None:
        return ()
    cells = (given,) if isinstance(given, int) else tuple(given)
    round_ones = (Shape.SPHERE, Shape.TORUS)
    if len(cells) > 1 and shape not in round_ones:
        raise entry.place.fault("tessellation", f"a {shape} takes one number", "keep one")
    if min(cells) < FEWEST[shape]:
        raise entry.place.fault("tessellation", f"a {shape} needs {FEWEST[shape]} at least")
    return (*cells, 2 * cells[0]) if len(cells) == 1 and shape in round_ones else cells


def _material(entry: Entry, origin: Entry, materials: Mapping[str, Material]) -> Material:
    for one in (entry, origin):
        if one.record.material is not None:
            name = one.record.material
            return materials[one.place.known("material", name, materials, "material")]
    return DEFAULT_MATERIAL
