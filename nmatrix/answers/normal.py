"""`nmatrix normal`: the normal matrix of a map, and normals carried through it."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from nmatrix.enums import NormalRule, NormalStatus, Space
from nmatrix.errors import NoAnswerError, quantity
from nmatrix.lessons.map_sentences import (
    transform_blocks,
    transform_data,
    transform_remarks,
    verdict,
)
from nmatrix.linear.classify import Classification
from nmatrix.linear.exact import LinearMap, Normal
from nmatrix.linear.rational import linear_part, rational_vector
from nmatrix.linear.rounding import integers, unit
from nmatrix.linear.rules import RULES, NormalTransform, normal_transform
from nmatrix.report import (
    SCREEN,
    Block,
    Brief,
    Heading,
    Quantity,
    Report,
    Table,
    Text,
    Value,
    Vector,
    Verdict,
)
from nmatrix.scene.setup import Setup


@dataclass(frozen=True)
class NormalRequest:
    """The normals to carry, the space to carry them to, and one of the `NORMAL_METHODS`."""

    normals: tuple[Vector, ...] = ()
    space: Space = Space.WORLD
    method: NormalRule = NormalRule.EXACT


def normal(setup: Setup, request: NormalRequest, *, steps: bool = False) -> Report:
    """Answer with the normal matrix of S · M, and with the normals through it.

    Examples
    --------
    >>> from nmatrix.scene.world import World
    >>> flat = normal(Setup(World(scale=(1, 0, 1))), NormalRequest(((0, 1, 0), (1, 0, 0))))
    >>> [found["status"] for found in flat.data["normals"]], flat.failure.exit_code
    (['two-sided', 'undefined'], 3)
    """
    S = setup.maps.space_from_object(request.space).exact
    found = setup.maps.classified(request.space)
    linear_map = found.linear_map
    by_rule = normal_transform(request.method, S)
    matrix = linear_map.normal_matrix
    if request.method is not NormalRule.EXACT:
        matrix = None if by_rule is None else linear_part(by_rule.matrix)
    title = RULES[request.method].title
    answered = [_answered(n, request.method, by_rule, linear_map) for n in request.normals]
    data: dict[str, Value] = {
        "normal_matrix": matrix,
        "cofactor_matrix": linear_map.cofactor_matrix,
        **transform_data(found),
        "normals": [one.data for one in answered],
        "steps": None,
    }
    blocks = (
        Heading(f"Normal matrix: object to {request.space} space"),
        Quantity("normal_matrix", matrix, title),
        Quantity("cofactor_matrix", linear_map.cofactor_matrix, "C, the cofactors"),
        *transform_blocks(found),
        *(block for i, one in enumerate(answered) for block in one.blocks(i)),
    )
    report = Report(
        "normal",
        data,
        blocks,
        (*setup.remarks, *transform_remarks(found), *_method_remarks(request.method, found)),
        _failure(found, answered),
        brief=_brief(request, Quantity("normal_matrix", matrix, title), found, answered),
    )
    if steps:
        from nmatrix.answers.steps import of_normals, with_steps  # most answers are without

        return with_steps(report, of_normals(setup, request.space, request.method, request.normals))
    return report


def _brief(
    request: NormalRequest, matrix: Quantity, found: Classification, answered: Sequence[_Answered]
) -> Brief:
    """Show the verdict, the matrix, and each normal in a row: before, after, and A itself off."""
    more = ("the cofactors", "determinant, rank and condition")
    blocks: list[Block] = [Verdict(verdict(found)), matrix]
    if answered:
        methods = () if request.method is NormalRule.EXACT else (f"{request.method} °",)
        has_status = any(one.image.status is not NormalStatus.OK for one in answered)
        columns = ("x", "y", "z", "→ x", "→ y", "→ z", "A itself °", *methods)
        rows = tuple(
            (
                *one.given,
                *(one.image.direction or (None,) * 3),
                one.without_deg,
                *(one.method_error_deg for _ in methods),
                *([one.image.status.value] if has_status else []),
            )
            for one in answered
        )
        status = ("",) if has_status else ()
        blocks.append(Table((*columns, *status), rows, "Normals, and how far A itself is off"))
    return Brief(tuple(blocks), more, SCREEN + max(len(answered) - 1, 0))


SAME_DIRECTION_DEG = 1e-9  # what a matrix built from angles misses by rounding
SAID_OF = {
    NormalRule.INVERSE: "np.linalg.inv(A).T",
    NormalRule.COFACTOR: "The unsigned cofactor",
    NormalRule.NONE: "A itself",
}
TWO_AXES = "give at least two axes a scale other than 0"


@dataclass(frozen=True)
class _Answered:
    """A normal that was asked for, what a method made of it, and how far it and A are off."""

    given: Vector
    image: Normal
    method: NormalRule
    method_error_deg: float | None
    without_deg: float | None

    @property
    def data(self) -> dict[str, Value]:
        return {
            "object": self.given,
            "transformed": self.image.direction,
            "status": self.image.status.value,
            "without_deg": self.without_deg,
            "method_error_deg": self.method_error_deg,
        }

    def blocks(self, place: int) -> tuple[Block, ...]:
        return (
            Quantity(f"normals.{place}.object", self.given, f"normal {place + 1}"),
            Quantity(f"normals.{place}.transformed", self.image.direction, "  becomes (unit)"),
            Text(" ".join(self._sentences())),
        )

    def _sentences(self) -> Iterator[str]:
        """Tell how far the method is off the right rule, and beside it A itself."""
        if self.image.status is not NormalStatus.OK:
            yield f"{self.image.status}: {self.image.reason}."
        elif self.method is not NormalRule.EXACT:
            yield _told(self.method, self.method_error_deg)
            if self.method is not NormalRule.NONE and self.without_deg is not None:
                yield _told(NormalRule.NONE, self.without_deg)
        elif self.without_deg is not None and self.without_deg >= SAME_DIRECTION_DEG:
            yield f"With A itself it would be {self.without_deg:.6g}° off."
        else:
            yield "A itself gives the same direction."


def _told(method: NormalRule, error_deg: float | None) -> str:
    if error_deg is None:
        return f"{SAID_OF[method]} gives a direction where the right rule gives none."
    if error_deg == 0:
        return f"{SAID_OF[method]} gives the right direction."
    if error_deg < SAME_DIRECTION_DEG:
        return f"{SAID_OF[method]} gives the right direction to {error_deg:.2g}°."
    return f"{SAID_OF[method]} is {error_deg:.6g}° off the right direction."


def _answered(
    n: Vector, method: NormalRule, by_rule: NormalTransform | None, linear_map: LinearMap
) -> _Answered:
    """Carry one normal by a method, and measure what comes out against the right rule."""
    without = linear_map.angle_without_deg(n)
    if by_rule is None:
        return _Answered(n, _undefined("this rule has no answer here"), method, None, without)
    moved, _ = integers(by_rule.applied_to(rational_vector(n))[:3])
    if method is NormalRule.EXACT:
        image = linear_map.normal(n)
    elif any(moved):
        image = Normal(unit(moved), NormalStatus.OK, "")
    else:
        image = _undefined("this rule gives length 0")
    return _Answered(n, image, method, linear_map.angle_off_deg(n, moved), without)


def _undefined(reason: str) -> Normal:
    return Normal(None, NormalStatus.UNDEFINED, reason)


def _method_remarks(method: NormalRule, found: Classification) -> tuple[str, ...]:
    if method is NormalRule.COFACTOR and found.mirrored:
        return ("This map mirrors: the unsigned cofactor points inwards.",)
    if method is NormalRule.INVERSE and found.rank < 3:
        return ("np.linalg.inv has no answer, or garbage, for a singular matrix.",)
    if method is NormalRule.NONE and found.needs_inverse_transpose:
        return ("A itself does not keep normals perpendicular here.",)
    return ()


def _failure(found: Classification, answered: Sequence[_Answered]) -> NoAnswerError | None:
    for one in answered:
        if one.image.status is NormalStatus.UNDEFINED:
            shown = " ".join(f"{float(component):g}" for component in one.given)
            next_step = "choose another normal" if found.rank >= 2 else TWO_AXES
            if found.linear_map.normal(one.given).direction is not None:
                next_step = f"try {quantity('method')} {NormalRule.EXACT}"
            return NoAnswerError(f"normal ({shown})", one.image.reason, next_step)
    if not answered and found.rank <= 1:
        return NoAnswerError(
            f"a map of rank {found.rank}",
            "it leaves no surface, so no normal exists",
            TWO_AXES,
        )
    return None
