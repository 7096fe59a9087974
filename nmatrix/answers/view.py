"""`nmatrix view`: the view matrix, its factors, the camera's axes."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from nmatrix.answers.identify import camera_numbers, reading_data
from nmatrix.enums import Handedness
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.lessons.map_sentences import transform_remarks, verdict
from nmatrix.linear import rational
from nmatrix.linear.affine import translation_matrix
from nmatrix.linear.classify import RIGID_KINDS, Classification, classify
from nmatrix.linear.identify import Reading, identify
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rounding import integers, unit
from nmatrix.report import (
    Block,
    Brief,
    Heading,
    Matrix,
    Quantity,
    Report,
    Text,
    Value,
    Vector,
    Verdict,
)
from nmatrix.scene.setup import Setup


def view(setup: Setup, *, steps: bool = False) -> Report:
    """Answer with the view matrix of a scene, also as R · T; its steps are for who asks.

    Examples
    --------
    >>> [float(x) for x in view(Setup()).data["forward"]]
    [0.0, 0.0, -1.0]
    """
    placed = setup.camera
    V = placed.camera_from_world
    R = rational.affine_matrix(rational.linear_part(V))
    T = translation_matrix(tuple(-component for component in placed.eye))
    meant = setup.to_digits
    stands_for = None if meant is setup else meant.camera.camera_from_world
    found = classify(V, setup.tolerance, stands_for)
    right, up, forward = _camera_axes(V, found, setup.view.handed)
    if not found.linear_map.integer_determinant:
        raise NoAnswerError("view matrix (determinant 0)", "it flattens space", "give another")
    normal_matrix = found.linear_map.inverse_transpose
    given = setup.view.matrix is not None
    readings = identify(V) if given else ()
    shown: dict[str, Vector | Matrix] = {
        "camera_from_world": V,
        "rotation": R,
        "translation": T,
        "eye": placed.eye,
        "right": right,
        "up": up,
        "forward": forward,
        "normal_matrix": normal_matrix,
    }
    elsewhere: dict[str, Matrix | None] = {
        "world_from_camera": rational.affine_matrix(_back(V, found), placed.eye),
        "extrinsics": _extrinsics(V, setup.view.handed),
    }
    undecided = given and setup.view.handed is Handedness.RIGHT  # nobody said so
    data: dict[str, Value] = {
        **shown,
        "handed": None if undecided else setup.view.handed.value,
        "mirrored": found.mirrored,
        "readings": [reading_data(one) for one in readings] if given else None,
        **elsewhere,
        "steps": None,
    }
    remarks = [*placed.remarks, *transform_remarks(found)]
    whole = setup.view.typed_matrix is not None
    if whole and (found.mirrored or not found.is_rigid):
        remarks.append(_no_pose(found))
    if undecided:
        remarks.append(_NO_HAND)
    told = shown | {key: matrix for key, matrix in elsewhere.items() if matrix is not None}
    blocks = _blocks(told, found, readings)
    report = Report("view", data, blocks, tuple(remarks), brief=_brief(blocks))
    if steps:
        from nmatrix.answers.steps import of_view, with_steps  # most answers are without

        return with_steps(report, of_view(setup))
    return report


def _brief(blocks: Sequence[Block]) -> Brief:
    """Show the verdict, the matrix, and where the camera is and looks."""
    by_key = {one.key: one for one in blocks if isinstance(one, Quantity)}
    told = [one for one in blocks if isinstance(one, Verdict | Text)]
    V = replace(by_key["camera_from_world"], title="V = R · T")
    placed = (by_key[key] for key in ("eye", "right", "up", "forward"))
    more = ("the factors R and T", "the normal matrix", "the pose and OpenCV's extrinsics")
    return Brief((*told[:1], V, *placed, *told[1:]), more)


_NO_HAND = (
    "A view matrix does not say whether the camera looks down −z, as taken here, or down +z: with "
    f"{quantity('handed')} left forward is the other way."
)


def _no_pose(found: Classification) -> str:
    also = [
        *(["stretches"] if not found.is_rigid else []),
        *(["mirrors"] if found.mirrored else []),
    ]
    return (
        f"A camera only moves and turns, and this matrix also {' and '.join(also)}: is it a view "
        "matrix, or one times something else?"
    )


def _extrinsics(V: RationalMatrix, handed: Handedness) -> RationalMatrix | None:
    """Return [R t] for a camera of computer vision: x right, y down, z ahead; pixels of OpenCV."""
    if handed is Handedness.LEFT:
        return None
    right, up, backward = V[:3]
    return right, tuple(-x for x in up), tuple(-x for x in backward)


_HEADINGS = {
    "camera_from_world": "View matrix: camera from world, V = R · T",
    "rotation": "Its factors: first move the eye to the origin, then the 3×3 block",
    "eye": "The camera in the world",
    "world_from_camera": "The same camera elsewhere",
}
_TITLES = {
    "camera_from_world": "V",
    "rotation": "R",
    "translation": "T",
    "normal_matrix": "normal matrix, V⁻ᵀ of the 3×3 block",
    "world_from_camera": "V⁻¹, its pose",
    "extrinsics": "[R t] of OpenCV and COLMAP",
}


def _blocks(
    data: Mapping[str, Vector | Matrix], found: Classification, readings: Sequence[Reading]
) -> tuple[Block, ...]:
    """List every quantity in the order of the data, under three headings."""
    blocks: list[Block] = []
    for key, value in data.items():
        if key in _HEADINGS:
            blocks.append(Heading(_HEADINGS[key]))
        blocks.append(Quantity(key, value, _TITLES.get(key, key)))
    blocks.append(Verdict(_verdict(found)))
    cameras = (one.place.camera for one in readings if one.place is not None)
    camera = next((one for one in cameras if one is not None and not one.mirrored), None)
    if camera is not None:
        blocks.append(Text(f"Read back from the entries: {camera_numbers(camera)}."))
    return tuple(blocks)


def _camera_axes(
    camera_from_world: RationalMatrix, found: Classification, handed: Handedness
) -> tuple[Vector, ...]:
    """Find the world directions that the camera calls right, up and forward, at length one.

    They are the columns of V⁻¹; where V is rigid they are its rows, already rounded once.
    """
    axes = rational.transpose(_back(camera_from_world, found))
    ahead = 1 if handed is Handedness.LEFT else -1
    named = (axes[0], axes[1], tuple(ahead * component for component in axes[2]))
    if found.kind_as_typed in RIGID_KINDS:
        return named
    return tuple(unit(integers(axis)[0]) for axis in named)


def _back(camera_from_world: RationalMatrix, found: Classification) -> RationalMatrix:
    """Invert the 3×3 block; of a rotation of floats by turning it over, which rounds nothing."""
    block = rational.linear_part(camera_from_world)
    is_built = rational.rounded_for_display(block) == block
    rigid = is_built and found.kind_as_typed in RIGID_KINDS
    return rational.transpose(block) if rigid else rational.inverse(block)


def _verdict(found: Classification) -> str:
    if found.is_rigid and not found.mirrored and found.kind is found.kind_as_typed:
        return "The 3×3 block is a rotation, so V⁻ᵀ = V: one block carries directions and normals."
    return f"Of the 3×3 block A of V: {verdict(found)[0].lower()}{verdict(found)[1:]}"
