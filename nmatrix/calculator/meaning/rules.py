"""The rules of spaces: for each operator and each pair of things, what the result is, or a refusal.

A rule looks at what its operands mean and never at their numbers, save where a refusal measures by
how much it would be wrong. What is not known is never refused.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import replace

from nmatrix.calculator.arithmetic.meanings import (
    FOR_NORMALS,
    Carries,
    Kind,
    Located,
    Map,
    Meaning,
    meets,
)
from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.calculator.meaning.deviation import degrees_off, is_below_0
from nmatrix.calculator.meaning.operands import (
    UNDIVIDED,
    Operand,
    RefusedError,
    Sort,
    bared,
    factor,
    together,
    undivided,
)
from nmatrix.enums import Frame
from nmatrix.lessons.check.mistake import MistakeId
from nmatrix.linear import rational

Rule = Callable[[Operand, Operand], Meaning | None]
Grid = dict[tuple[Sort, Sort], Rule]


def _free(_a: Operand, _b: Operand) -> None:
    """Know nothing of the result: sizes decide whether there is one."""


def _is(kind: Kind) -> Rule:
    def rule(a: Operand, b: Operand) -> Meaning:
        return Located(together(a, b), kind)

    return rule


def _two_points(a: Operand, b: Operand) -> None:
    together(a, b)
    middle = f"{factor(a.text)} + ({factor(b.text)} - {factor(a.text)}) / 2"
    why = f"{a.name} and {b.name} are points, and places have no sum"
    raise RefusedError(why, forms=(middle,))


def _from_no_place(a: Operand, b: Operand) -> None:
    together(a, b)
    kind = a.sort.value.removeprefix("a ")
    why = f"{b.name} is a point and {a.name} a {kind}, which has no place to go from"
    raise RefusedError(why, forms=(f"{factor(b.text)} - {factor(a.text)}",))


def _same_map(a: Operand, b: Operand) -> Meaning | None:
    """Keep the way of two maps that lead the same way; what one does not know the other tells.

    What is left of A by its transpose or its normal matrix is no map, and right all the same.
    """
    one, other = a.map, b.map
    carried = {one.carries, other.carries} - {Carries.ALL}
    if len(carried) > 1:
        return None
    ends = ((one.to, other.to), (one.source, other.source))
    if any(None not in pair and pair[0] is not pair[1] for pair in ends):
        raise RefusedError(f"{_way(a)}, {_way(b)}, and only maps of one way have a sum")
    carries = carried.pop() if carried else Carries.PLACES  # two rotations have no rotation as sum
    return Map(one.to or other.to, one.source or other.source, carries)


def _way(a: Operand) -> str:
    to = f"to {a.map.to} space" if a.map.to else "anywhere"
    return f"{a.name} leads {to} from {f'{a.map.source} space' if a.map.source else 'anywhere'}"


def _of(rows: Mapping[Sort, tuple[Rule, ...]], columns: tuple[Sort, ...]) -> Grid:
    return {
        (row, column): rule
        for row, rules in rows.items()
        for column, rule in zip(columns, rules, strict=True)
    }


def _all(rows: Iterable[Sort], columns: Iterable[Sort], rule: Rule) -> Grid:
    return {(row, column): rule for row in rows for column in columns}


_p, _d, _n, _v = (_is(kind) for kind in Kind)
NUMBER = (Sort.NUMBER,)
VECTORS = (Sort.BARE, Sort.POINT, Sort.DIRECTION, Sort.NORMAL, Sort.VECTOR)
MAPS = (Sort.PLACES, Sort.NORMALS, Sort.BACK, Sort.FLIPPED, Sort.ALL)
_ANYTHING = _all(Sort, Sort, _free)
_SUMS_OF_MAPS = _all((Sort.BARE, *MAPS), MAPS, _same_map) | _all(MAPS, (Sort.BARE,), _same_map)
# A literal beside a point is a step from it; beside other things it may be a point itself.
_SUMS = (
    _ANYTHING
    | _SUMS_OF_MAPS
    | _of(
        {
            Sort.BARE: (_free, _p, _v, _v, _v),
            Sort.POINT: (_p, _two_points, _p, _p, _v),
            Sort.DIRECTION: (_v, _p, _d, _d, _v),
            Sort.NORMAL: (_v, _p, _d, _n, _v),
            Sort.VECTOR: (_v, _v, _v, _v, _v),
        },
        VECTORS,
    )
)
_DIFFERENCES = (
    _ANYTHING
    | _SUMS_OF_MAPS
    | _of(
        {
            Sort.BARE: (_free, _d, _v, _v, _v),
            Sort.POINT: (_v, _d, _p, _p, _v),
            Sort.DIRECTION: (_v, _from_no_place, _d, _d, _v),
            Sort.NORMAL: (_v, _from_no_place, _d, _n, _v),
            Sort.VECTOR: (_v, _v, _v, _v, _v),
        },
        VECTORS,
    )
)


def _scaled(a: Operand, number: Operand) -> Meaning | None:
    """Keep what a multiple still is: half of a point is no place, save in clip space."""
    meaning = a.value.meaning
    if a.is_undivided:
        is_whole = len(a.value.vector) == 4
        return meaning if is_whole else Located(Frame.NDC, Kind.POINT)
    if isinstance(meaning, Located) and meaning.kind is Kind.POINT:
        return Located(meaning.space, Kind.VECTOR)
    if a.sort is Sort.FLIPPED and is_below_0(number.value.scalar):  # such as the determinant
        return replace(a.map, carries=Carries.NORMALS)
    return meaning


_SCALED = _all(NUMBER, Sort, lambda a, b: _scaled(b, a)) | _all(Sort, NUMBER, _scaled)
_PRODUCTS = _ANYTHING | _SCALED


def _quotient(a: Operand, b: Operand) -> Meaning | None:
    """Divide; a point of clip space over its own w is one of normalised device coordinates."""
    if a.is_undivided and a.value.vector[-1] == b.value.scalar:
        return Located(Frame.NDC, Kind.POINT)
    return _scaled(a, b)


_QUOTIENTS = _ANYTHING | _all(Sort, NUMBER, _quotient)


def _measured(a: Operand, b: Operand) -> None:
    together(a, b)


# Two directions span a normal or are an axis and a step: which, nobody knows.
_CROSSED = _ANYTHING | _of(
    {
        Sort.BARE: (_free, _v, _v, _v, _v),
        Sort.POINT: (_v, _v, _v, _v, _v),
        Sort.DIRECTION: (_v, _v, _v, _d, _v),
        Sort.NORMAL: (_v, _v, _d, _d, _v),
        Sort.VECTOR: (_v, _v, _v, _v, _v),
    },
    VECTORS,
)
_DOTTED = _ANYTHING | _all(VECTORS, VECTORS, _measured)

# What two maps carry, one after the other; None is a form that takes places and gives normals, or
# the other way, as AᵀA is. A normal matrix has no business beside a map of places.
_ONE_BY_ONE: dict[frozenset[Carries], Carries | None] = {
    frozenset((Carries.PLACES,)): Carries.PLACES,
    frozenset((Carries.NORMALS,)): Carries.NORMALS,
    frozenset((Carries.BACK,)): Carries.BACK,
    frozenset((Carries.FLIPPED,)): Carries.NORMALS,
    frozenset((Carries.NORMALS, Carries.BACK)): Carries.NORMALS,
    frozenset((Carries.NORMALS, Carries.FLIPPED)): Carries.FLIPPED,
    frozenset((Carries.BACK, Carries.FLIPPED)): Carries.FLIPPED,
    frozenset((Carries.PLACES, Carries.BACK)): None,
}
PROJECTED = frozenset((Frame.CLIP, Frame.NDC, Frame.WINDOW))
POSE = Map(Frame.WORLD, Frame.CAMERA)


def _is_vector(a: Operand) -> bool:
    return a.value.kind is ValueKind.VECTOR


def _composed(a: Operand, b: Operand) -> Meaning | None:
    if _is_vector(a) or _is_vector(b):
        return None
    one, other = a.map, b.map
    if not meets(one.source, other.to):
        why = f"{b.name} leads to {other.to} space, {a.name} starts from {one.source} space"
        is_pose = POSE in (one, other) and {one.source, other.to} == {Frame.WORLD, Frame.CAMERA}
        raise RefusedError(why, MistakeId.VIEW_NOT_INVERTED if is_pose else None)
    if Sort.BARE in (a.sort, b.sort) and not (_is_square(a.value) and _is_square(b.value)):
        return None
    carried = frozenset((one.carries, other.carries)) - {Carries.ALL}
    if carried and carried not in _ONE_BY_ONE:
        why = f"{b.name} carries {other.carries}, {a.name} {one.carries}"
        raise RefusedError(why, MistakeId.USED_WORLD_MATRIX, forms=_both_for_normals(a, b))
    carries = _ONE_BY_ONE[carried] if carried else Carries.ALL
    return None if carries is None else Map(one.to, other.source, carries)


def _both_for_normals(a: Operand, b: Operand) -> Iterator[str]:
    """Write a product of which one factor was for places, with both for normals."""
    is_left = b.map.carries in FOR_NORMALS
    inside = (a if is_left else b).text.removeprefix("linear(").removesuffix(")")
    for text in (inside, (a if is_left else b).text):
        for name in ("normal_matrix", "inverse_transpose"):
            right = f"{name}({text})"
            yield f"{right} @ {factor(b.text)}" if is_left else f"{factor(a.text)} @ {right}"


def _is_square(value: Value) -> bool:
    return len(value.matrix) == len(value.matrix[0])


def _place(a: Operand, b: Operand) -> Meaning:
    """Carry a point or a direction."""
    _begins_there(a, b)
    kind = Kind[b.sort.name]
    if kind is Kind.DIRECTION and a.map.source in PROJECTED and any(a.value.matrix[-1][:3]):
        why = f"{a.name} undoes a projection with a vanishing point, which keeps no directions"
        raise RefusedError(why)
    if kind is Kind.POINT and len(a.value.matrix[0]) == 3 and a.map.to and a.map.source:
        why = f"a point needs the translation, which the 3×3 matrix {a.name} has not"
        raise RefusedError(why)
    return Located(a.map.to, Kind.POINT if a.map.to is Frame.CLIP else kind)


def _begins_there(a: Operand, b: Operand) -> None:
    """Check that a map begins in the space of what it carries."""
    if b.is_undivided and len(b.value.vector) == 3:
        raise undivided(b)
    if not meets(a.map.source, b.space):
        raise RefusedError(_two_spaces(a, b), _by_spaces(a.map, b))


def _two_spaces(a: Operand, b: Operand) -> str:
    return f"{a.name} starts from {a.map.source} space, {b.name} is in {b.space} space"


def _by_spaces(led: Map, b: Operand) -> MistakeId | None:
    """Name the mistake of carrying a thing of the world, or of an object, by a wrong map."""
    match led, b.space:
        case Map(Frame.CAMERA, Frame.OBJECT), Frame.WORLD:
            return MistakeId.USED_MODEL_VIEW
        case Map(Frame.WORLD, Frame.OBJECT, Carries.PLACES), Frame.WORLD:
            return MistakeId.USED_WORLD_MATRIX
        case Map(Frame.WORLD, Frame.CAMERA, Carries.PLACES), Frame.WORLD:
            return MistakeId.VIEW_NOT_INVERTED
    return None


def _no_normal(a: Operand, b: Operand) -> None:
    """Refuse a normal that is carried by a map of places."""
    is_back = not meets(a.map.source, b.space)
    if is_back and a.map.to is not b.space:
        raise RefusedError(_two_spaces(a, b), _by_spaces(a.map, b))
    if PROJECTED & {a.map.to, a.map.source}:
        raise RefusedError(_no_angles(a), MistakeId.USED_WORLD_MATRIX)
    said = f", and {_two_spaces(a, b)}" if is_back else ""
    right = rational.transpose if is_back else rational.inverse_transpose
    mistake = MistakeId.NOT_TRANSPOSED if is_back else MistakeId.USED_WORLD_MATRIX
    raise RefusedError(
        f"a normal is not carried by {a.name}{degrees_off(a, b, right)}{said}", mistake
    )


def _no_angles(a: Operand) -> str:
    return f"a projection keeps no angles, so a normal is not carried by {a.name}"


def _normal(a: Operand, b: Operand) -> Meaning:
    """Carry a normal by a map for normals."""
    if not meets(a.map.source, b.space):
        if a.sort is Sort.BACK and a.map.to is b.space:
            off = degrees_off(a, b, rational.inverse)
            why = f"a normal is not carried by {a.name}{off}, and {_two_spaces(a, b)}"
            raise RefusedError(why, MistakeId.NOT_INVERTED)
        raise RefusedError(_two_spaces(a, b), _by_spaces(a.map, b))
    if PROJECTED & {a.map.to, a.map.source}:
        raise RefusedError(_no_angles(a))
    return Located(a.map.to, Kind.NORMAL)


def _only_normals(a: Operand, b: Operand) -> None:
    """Refuse a point or a direction that is carried by a map for normals."""
    kind, is_there = b.sort.value, meets(a.map.source, b.space)
    if a.sort is Sort.BACK and not is_there and a.map.to is b.space:
        raise RefusedError(
            f"{a.name} is transposed, and {_two_spaces(a, b)}", MistakeId.TRANSPOSED_LAYOUT
        )
    if not is_there:
        raise RefusedError(_two_spaces(a, b), _by_spaces(a.map, b))
    is_step = b.sort is Sort.DIRECTION
    is_measured = is_step and a.sort is not Sort.FLIPPED
    off = degrees_off(a, b, rational.inverse_transpose) if is_measured else ""
    why = f"{kind} is not carried by {a.name}, which is for normals{off}"
    raise RefusedError(why, MistakeId.COURSE_LIGHT_RULE if is_step else None)


def _inside_out(a: Operand, b: Operand) -> None:
    _normal(a, b)
    why = f"{a.name} has the cofactors of a mirror, which turn {b.name} inside out"
    raise RefusedError(why, MistakeId.COFACTOR_SIGN)


def _unknown(a: Operand, b: Operand) -> Meaning:
    """Carry a vector of no known kind, whose w is not known."""
    _begins_there(a, b)
    if len(a.value.matrix[0]) == 4:
        why = f"{b.name} may be a point, whose w is 1, or a direction, whose w is 0"
        forms = (
            f"{factor(a.text)} @ {kind}({bared(b.text)})" for kind in (Kind.POINT, Kind.DIRECTION)
        )
        raise RefusedError(why, forms=forms)
    return Located(a.map.to, Kind.VECTOR)


def _anywhere(a: Operand, b: Operand) -> Meaning | None:
    """Carry a thing by a matrix of which nothing is known: if for normals, it does not tell."""
    if _is_vector(a):
        return None
    if b.sort is Sort.VECTOR:
        return _unknown(a, b)
    _begins_there(a, b)
    return Located(None, Kind.VECTOR if b.sort is Sort.NORMAL else Kind[b.sort.name])


_CARRIED = (
    _ANYTHING
    | _all((Sort.BARE, *MAPS), MAPS, _composed)
    | _all(MAPS, (Sort.BARE,), _composed)
    | _of(
        {
            Sort.BARE: (_anywhere, _anywhere, _anywhere, _anywhere),
            Sort.PLACES: (_place, _place, _no_normal, _unknown),
            Sort.NORMALS: (_only_normals, _only_normals, _normal, _normal),
            Sort.BACK: (_only_normals, _only_normals, _normal, _normal),
            Sort.FLIPPED: (_only_normals, _only_normals, _inside_out, _inside_out),
            Sort.ALL: (_place, _place, _normal, _unknown),
        },
        VECTORS[1:],
    )
)


def _dotted(a: Operand, b: Operand) -> Meaning | None:
    """Choose between the two products that the dot stands for."""
    return (_DOTTED if _is_vector(a) and _is_vector(b) else _CARRIED)[a.sort, b.sort](a, b)


def _crossed(a: Operand, b: Operand) -> Meaning | None:
    """Cross two vectors; matrices have no such product."""
    return _CROSSED[a.sort, b.sort](a, b) if _is_vector(a) and _is_vector(b) else None


def _compared(a: Operand, b: Operand) -> None:
    if not (a.is_undivided and b.is_undivided):
        together(a, b)


def _never_the_same(a: Operand, b: Operand) -> None:
    together(a, b)
    one, other = a.sort.value, b.sort.value
    raise RefusedError(f"{a.name} is {one}, {b.name} {other}: they are never the same")


_WITHOUT_PLACE = (Sort.DIRECTION, Sort.NORMAL)
_COMPARISONS = (
    _ANYTHING
    | _all(VECTORS, VECTORS, _compared)
    | _all((Sort.POINT,), _WITHOUT_PLACE, _never_the_same)
    | _all(_WITHOUT_PLACE, (Sort.POINT,), _never_the_same)
)

RULES: dict[str, Grid] = {
    "+": _SUMS,
    "-": _DIFFERENCES,
    "*": _PRODUCTS,
    "/": _QUOTIENTS,
    "@": _CARRIED,
    "·": _all(Sort, Sort, _dotted) | _SCALED,
    "×": _all(Sort, Sort, _crossed) | _SCALED,
    "==": _COMPARISONS,
    "≈": _COMPARISONS,
}
ENTRY_BY_ENTRY = ("+", "-", "==", "≈")


def meaning_of(sign: str, a: Operand, b: Operand) -> Meaning | None:
    """Find what a result means.

    Raises
    ------
    RefusedError
        For an operation that no graphics programmer means.

    Examples
    --------
    >>> from nmatrix.calculator.arithmetic.meanings import SCENE
    >>> M, V = (Operand(Value(rational.identity(4), SCENE[name]), name) for name in "MV")
    >>> print(meaning_of("@", V, M))
    camera ← object
    >>> meaning_of("@", M, V)  # doctest: +ELLIPSIS
    Traceback (most recent call last):
        ...
    nmatrix.calculator.meaning.operands.RefusedError: V leads to camera space, M starts from ...
    """
    if sign in ENTRY_BY_ENTRY and a.value.kind is not b.value.kind:
        return None  # which has no answer
    return RULES[sign][a.sort, b.sort](a, b)


def negated(meaning: Meaning | None) -> Meaning | None:
    """Keep what stays of a meaning under a minus: −p is no place, save in clip space."""
    if isinstance(meaning, Map) and meaning.carries is Carries.FLIPPED:
        return replace(meaning, carries=Carries.NORMALS)
    if isinstance(meaning, Located) and meaning.kind is Kind.POINT and meaning != UNDIVIDED:
        return Located(meaning.space, Kind.VECTOR)
    return meaning


def raised(base: Operand, exponent: int) -> Meaning | None:
    """Find what a power above 0 of a map is: it must lead back into its own space."""
    meaning = base.value.meaning
    if not isinstance(meaning, Map) or exponent == 1:
        return meaning
    try:
        return _composed(base, base) if exponent else None
    except RefusedError as refused:
        form = f"untyped({base.text})^{exponent}"
        raise RefusedError(refused.why, refused.mistake, forms=(form,)) from None


def different_ways(a: Operand, b: Operand) -> str:
    """Tell that two maps which are compared lead different ways, if they do."""
    one, other = a.value.meaning, b.value.meaning
    if not (isinstance(one, Map) and isinstance(other, Map)):
        return ""
    if meets(one.to, other.to) and meets(one.source, other.source):
        return ""
    return f"Only numbers are compared: {_way(a)}, {_way(b)}."
