"""`nmatrix normal`: the normal matrix of a map, and normals carried through it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from fractions import Fraction

from nmatrix.enums import NormalMethod, NormalStatus, Space
from nmatrix.errors import NoAnswerError
from nmatrix.lessons.map_sentences import transform_blocks, transform_data, transform_remarks
from nmatrix.linear.classify import Classification, classify
from nmatrix.linear.exact import LinearMap, Normal
from nmatrix.linear.rational import RationalMatrix
from nmatrix.linear.rules import RULES, carried_by, normal_rule
from nmatrix.report import Heading, Quantity, Report, Table, Text, Value, Vector
from nmatrix.scene.setup import Setup


@dataclass(frozen=True)
class NormalRequest:
    """The normals to carry, the space to carry them to, and the method."""

    normals: tuple[Vector, ...] = ()
    space: Space = Space.WORLD
    method: NormalMethod = NormalMethod.EXACT


def normal(setup: Setup, request: NormalRequest) -> Report:
    """Answer with the normal matrix of `linear(space_from_world @ M)` and the normals through it.

    Examples
    --------
    >>> from nmatrix.scene.world import World
    >>> flat = normal(Setup(World(scale=(1, 0, 1))), NormalRequest(((0, 1, 0), (1, 0, 0))))
    >>> [found["status"] for found in flat.data["normals"]], flat.failure.exit_code
    (['two-sided', 'undefined'], 3)
    """
    S = setup.maps.space_from_object(request.space).exact
    found = classify(S, setup.tolerance)
    linear_map = found.linear_map
    matrix = normal_rule(request.method, linear_map)
    results = [_carried(linear_map, request.method, matrix, n) for n in request.normals]
    data: dict[str, Value] = {
        "normal_matrix": matrix,
        "cofactor_matrix": linear_map.cofactor_matrix,
        **transform_data(found),
        "normals": [_normal_data(n, r) for n, r in zip(request.normals, results, strict=True)],
    }
    blocks = (
        Heading(f"Normal matrix: object to {request.space} space"),
        Quantity("normal_matrix", matrix, _TITLES[request.method]),
        Quantity("cofactor_matrix", linear_map.cofactor_matrix, "C, the cofactors"),
        *transform_blocks(found),
        *_normal_blocks(request.normals, results),
    )
    return Report(
        "normal",
        data,
        blocks,
        (*setup.remarks, *transform_remarks(found), *_method_remarks(request.method, found)),
        _failure(found, request.normals, results),
    )


SAME_DIRECTION_DEG = 1e-9  # what a matrix built from angles misses by rounding
TWO_AXES = "give at least two axes a scale other than 0"

_TITLES = {rule.method: rule.title for rule in RULES}


def _carried(
    linear_map: LinearMap, method: NormalMethod, matrix: RationalMatrix | None, n: Vector
) -> Normal:
    normal_object = [Fraction(component) for component in n]
    if method is NormalMethod.EXACT:
        return linear_map.normal(normal_object)
    return carried_by(matrix, linear_map, normal_object)


def _normal_data(n: Vector, result: Normal) -> dict[str, Value]:
    return {
        "object": n,
        "transformed": result.direction,
        "status": result.status.value,
        "without_deg": result.angle_without_deg,
    }


def _normal_blocks(
    normals: Sequence[Vector], results: Sequence[Normal]
) -> tuple[Table | Text | Quantity, ...]:
    if not results:
        return ()
    quantities: list[Table | Text | Quantity] = []
    for i, (n, result) in enumerate(zip(normals, results, strict=True)):
        quantities.append(Quantity(f"normals.{i}.object", n, f"normal {i + 1}"))
        quantities.append(
            Quantity(f"normals.{i}.transformed", result.direction, "  becomes (unit)")
        )
        quantities.append(Text(_sentence(result)))
    return tuple(quantities)


def _sentence(result: Normal) -> str:
    if result.status is NormalStatus.UNDEFINED:
        return f"undefined: {result.reason}."
    if result.status is NormalStatus.TWO_SIDED:
        return f"two-sided: {result.reason}."
    if result.angle_without_deg is None:
        return "ok."
    if result.angle_without_deg < SAME_DIRECTION_DEG:
        return "A itself gives the same direction."
    return f"With A itself it would be {result.angle_without_deg:.6g}° off."


def _method_remarks(method: NormalMethod, found: Classification) -> tuple[str, ...]:
    if method is NormalMethod.COFACTOR and found.mirrored:
        return ("This map mirrors: the unsigned cofactor points inwards.",)
    if method is NormalMethod.INVERSE and found.rank < 3:
        return ("np.linalg.inv has no answer, or garbage, for a singular matrix.",)
    if method is NormalMethod.NONE and found.needs_inverse_transpose:
        return ("A itself does not keep normals perpendicular here.",)
    return ()


def _failure(
    found: Classification, normals: Sequence[Vector], results: Sequence[Normal]
) -> NoAnswerError | None:
    for n, result in zip(normals, results, strict=True):
        if result.status is NormalStatus.UNDEFINED:
            shown = " ".join(f"{float(component):g}" for component in n)
            next_step = "choose another normal" if found.rank == 2 else TWO_AXES
            return NoAnswerError(f"normal ({shown})", result.reason, next_step)
    if not results and found.rank <= 1:
        return NoAnswerError(
            f"a map of rank {found.rank}",
            "it leaves no surface, so no normal exists",
            TWO_AXES,
        )
    return None
