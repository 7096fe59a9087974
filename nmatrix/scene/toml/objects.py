"""The objects of a scene file: names, geometry, materials, and the hierarchy of their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from nmatrix.enums import Convention
from nmatrix.errors import NMatrixError
from nmatrix.linear.rational import RationalMatrix, to_floats
from nmatrix.scene.geometry import FileGeometry, Geometry, ShapeGeometry, TangentGeometry
from nmatrix.scene.light import EYE, WORLD
from nmatrix.scene.material import DEFAULT_MATERIAL, Material
from nmatrix.scene.scene import SceneNode, SceneObject
from nmatrix.scene.toml.records import ObjectRecord
from nmatrix.scene.toml.table import SceneTable
from nmatrix.scene.words import MESH_SUFFIXES, Shape
from nmatrix.scene.world import World

FEWEST = {Shape.SPHERE: 3, Shape.TORUS: 3, Shape.CONE: 3, Shape.PLANE: 1, Shape.BOX: 1}
_PARTS = (
    "translate",
    "rotate",
    "order",
    "quaternion",
    "axis_angle",
    "scale",
    "shear",
    "convention",
)


@dataclass(frozen=True)
class NamedObject:
    """An object as the file has it, with the name that it goes by."""

    name: str
    record: ObjectRecord
    table: SceneTable

    @property
    def is_group(self) -> bool:
        """True if it draws nothing itself."""
        return self.record.shape is self.record.mesh is self.record.copy_of is None


def named_objects(tables: Sequence[SceneTable]) -> dict[str, NamedObject]:
    """Return the objects by name.

    Raises
    ------
    IllegalValueError
        For a table that is no object, or a name that is taken.
    """
    found: dict[str, NamedObject] = {}
    for index, table in enumerate(tables):
        record = table.checked(ObjectRecord)
        name = record.name or f"object {index + 1}"
        if name in (WORLD, EYE):
            raise table.fault("name", f"lights are fixed to {name} by this word", "choose another")
        if name in found:
            raise table.fault("name", "another object has it already", "choose another")
        found[name] = NamedObject(name, record, table)
    return found


def scene_objects(
    by_name: Mapping[str, NamedObject], materials: Mapping[str, Material]
) -> tuple[tuple[SceneObject, ...], tuple[SceneNode, ...]]:
    """Place the objects that are drawn, and all that have a name, in the file's order.

    Raises
    ------
    IllegalValueError
        For contradictions, unknown names, cycles, and files that are missing.
    """
    own = {name: _own_place(named) for name, named in by_name.items()}
    worlds: dict[str, RationalMatrix] = {}
    for named in _parents_first(by_name):
        worlds[named.name] = _under(named, worlds.get(named.record.parent or ""), own[named.name])
    drawn = {name: named for name, named in by_name.items() if not named.is_group}
    origins = {name: _origin(named, drawn) for name, named in drawn.items()}
    geometries = {name: _geometry(e) for name, e in origins.items() if e.name == name}
    with_tangents = {name: TangentGeometry(plain) for name, plain in geometries.items()}
    index = {name: i for i, name in enumerate(by_name)}
    found = []
    for name, origin in origins.items():
        material = _material(by_name[name], origin, materials)
        source: Mapping[str, Geometry] = with_tangents if material.normal_map else geometries
        above = worlds.get(by_name[name].record.parent or "")
        geometry = source[origin.name]
        place = worlds[name]
        found.append(SceneObject(name, geometry, place, material, own[name], above, index[name]))
    nodes = []
    for name, named in by_name.items():
        parent = named.record.parent or ""
        above = worlds.get(parent)
        nodes.append(SceneNode(name, worlds[name], own[name], above, index.get(parent)))
    return tuple(found), tuple(nodes)


def _parents_first(by_name: Mapping[str, NamedObject]) -> list[NamedObject]:
    """Return the objects so that every parent stands before its children."""
    children: dict[str | None, list[NamedObject]] = {}
    for named in by_name.values():
        parent = named.record.parent
        if parent is not None:
            named.table.known("parent", parent, by_name, "object")
        children.setdefault(parent, []).append(named)
    order = list(children.get(None, ()))
    for named in order:  # grows while it is walked
        order.extend(children.get(named.name, ()))
    if len(order) < len(by_name):
        seen = {named.name for named in order}
        lost = next(named for named in by_name.values() if named.name not in seen)
        raise lost.table.fault("parent", "it is its own ancestor: the hierarchy is a cycle")
    return order


def _under(named: NamedObject, above: RationalMatrix | None, own: World) -> RationalMatrix:
    """Place an object under its parent; beyond float64 there is no place to draw it."""
    try:
        found = own.under(above).world_from_object
        to_floats(found)
    except NMatrixError as error:
        raise named.table.refused("its place", str(error), "") from None
    return found


def _own_place(named: NamedObject) -> World:
    """Return an object's place under its parent.

    Raises
    ------
    IllegalValueError
        For a matrix beside its parts, or parts that contradict each other.
    """
    record, table = named.record, named.table
    if record.matrix is not None:
        table.refuse_beside("matrix", _PARTS, "the matrix is the whole answer")
        return World(matrix=table.affine_matrix("matrix", record.matrix))
    for whole in ("quaternion", "axis_angle"):
        if getattr(record, whole) is not None:
            others = {"rotate", "order", "quaternion", "axis_angle"} - {whole}
            table.refuse_beside(whole, sorted(others), "both are the rotation")
    if record.quaternion is not None and not any(record.quaternion):
        raise table.fault("quaternion", "it has no direction", "no rotation is 0 0 0 1")
    if record.axis_angle is not None and not any(record.axis_angle[:3]):
        raise table.fault("axis_angle", "its axis has no direction", "try 0 1 0 and degrees")
    scale = (record.scale,) * 3 if isinstance(record.scale, float) else record.scale
    try:
        return World(
            translate=record.translate or (0, 0, 0),
            rotate_degrees=record.rotate or (0, 0, 0),
            quaternion=record.quaternion,
            axis_angle=record.axis_angle,
            scale=scale or (1, 1, 1),
            shear=record.shear or (0, 0, 0),
            order=record.order or "XYZ",
            convention=record.convention or Convention.STANDARD,
        )
    except NMatrixError as error:
        raise table.refused("its place", str(error), "") from None


def _origin(named: NamedObject, drawn: Mapping[str, NamedObject]) -> NamedObject:
    """Return the object whose triangles this one shares, itself if it has its own."""
    at, passed = named, [named.name]
    while at.record.copy_of is not None:
        at.table.refuse_beside("copy_of", ("shape", "mesh", "tessellation"), "a copy shares them")
        at = drawn[at.table.known("copy_of", at.record.copy_of, drawn, "drawn object")]
        if at.name in passed:
            raise named.table.fault("copy_of", "it is a copy of itself", "name an original")
        passed.append(at.name)
    return at


def _geometry(named: NamedObject) -> Geometry:
    record, table = named.record, named.table
    if record.mesh is not None:
        table.refuse_beside("mesh", ("shape", "tessellation"), "a mesh has its own triangles")
        path = table.file("mesh")
        if path.suffix.lower() not in MESH_SUFFIXES:
            raise table.fault(
                "mesh", "meshes are .obj, .ply or .stl", "render a glTF file by itself"
            )
        return FileGeometry(path)
    assert record.shape is not None  # groups do not come here
    return ShapeGeometry(record.shape, _tessellation(named, record.shape))


def _tessellation(named: NamedObject, shape: Shape) -> tuple[int, ...]:
    """Return the shape's tessellation; one number for two means twice as many sectors."""
    given = named.record.tessellation
    if given is None:
        return ()
    cells = (given,) if isinstance(given, int) else tuple(given)
    round_ones = (Shape.SPHERE, Shape.TORUS)
    if len(cells) > 1 and shape not in round_ones:
        raise named.table.fault("tessellation", f"a {shape} takes one number", "keep one")
    if min(cells) < FEWEST[shape]:
        raise named.table.fault("tessellation", f"a {shape} needs {FEWEST[shape]} at least")
    return (*cells, 2 * cells[0]) if len(cells) == 1 and shape in round_ones else cells


def _material(
    named: NamedObject, origin: NamedObject, materials: Mapping[str, Material]
) -> Material:
    for one in (named, origin):
        if one.record.material is not None:
            name = one.record.material
            return materials[one.table.known("material", name, materials, "material")]
    return DEFAULT_MATERIAL
