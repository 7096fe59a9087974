"""What the result of each function means: one row for each function, by its name."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction

from nmatrix.calculator.arithmetic.meanings import (
    FOR_NORMALS,
    SCENE,
    Carries,
    Kind,
    Located,
    Map,
    Meaning,
)
from nmatrix.calculator.arithmetic.numbers import is_zero, shown
from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.calculator.meaning.deviation import mirrors, orthonormal
from nmatrix.calculator.meaning.operands import (
    UNDIVIDED,
    Operand,
    RefusedError,
    Sort,
    factor,
    together,
    undivided,
)
from nmatrix.calculator.meaning.rules import PROJECTED, raised
from nmatrix.calculator.meaning.rules import meaning_of as meaning_of_operator
from nmatrix.enums import Frame, chosen
from nmatrix.lessons.check.mistake import MistakeId

Given = Operand | str | None  # an argument: a value, a word, or left out
FunctionRule = Callable[[Sequence[Given]], Meaning | None]


def meaning_of(function: str, arguments: Sequence[Given]) -> Meaning | None:
    """Find what the result of a function means.

    Raises
    ------
    RefusedError
        For arguments that no graphics programmer means.
    """
    return RULES.get(function, _nothing)(arguments)


def _values(arguments: Sequence[Given]) -> list[Operand]:
    return [one for one in arguments if isinstance(one, Operand)]


def _nothing(arguments: Sequence[Given]) -> None:
    """Know nothing of the result; vectors come from one space."""
    together(*_values(arguments))


def _always(meaning: Meaning) -> FunctionRule:
    def rule(arguments: Sequence[Given]) -> Meaning:
        together(*_values(arguments))
        return meaning

    return rule


def _of_map(change: Callable[[Map], Map | None]) -> FunctionRule:
    def rule(arguments: Sequence[Given]) -> Meaning | None:
        meaning = _values(arguments)[0].value.meaning
        return change(meaning) if isinstance(meaning, Map) else None

    return rule


def _transposed(arguments: Sequence[Given]) -> Meaning | None:
    """Transpose; of a matrix that only turns this is its inverse, too."""
    A = _values(arguments)[0]
    found = A.value.meaning
    if not isinstance(found, Map):
        return None
    if found.carries is not Carries.FLIPPED and orthonormal(A.value.matrix):
        return Map(found.source, found.to, Carries.ALL)
    return found.transpose


def _raised(arguments: Sequence[Given]) -> Meaning | None:
    """Multiply a map with itself: it must lead back into its own space."""
    A, k = _values(arguments)
    times = A.value.meaning
    exponent = shown(k.value.scalar)
    if not isinstance(times, Map) or not isinstance(exponent, Fraction):
        return times
    found = raised(A, abs(int(exponent)))
    return found.inverse if exponent < 0 and isinstance(found, Map) else found


def _cofactors(arguments: Sequence[Given]) -> Meaning | None:
    """Carry normals, of a mirror with the wrong sign."""
    A = _values(arguments)[0]
    found = A.value.meaning
    if not isinstance(found, Map) or found.carries not in (Carries.PLACES, Carries.ALL):
        return None
    carries = Carries.FLIPPED if mirrors(A.value.matrix) else Carries.NORMALS
    return Map(found.to, found.source, carries)


def _adjugate(arguments: Sequence[Given]) -> Meaning | None:
    """Lead back, but for a mirror, whose adjugate turns directions round."""
    A = _values(arguments)[0]
    found = A.value.meaning
    return None if not isinstance(found, Map) or mirrors(A.value.matrix) else found.inverse


def _block(found: Map) -> Map | None:
    """Keep the way of an affine map; the block of a projection is no map."""
    return None if _projects(found) else found


def _projects(found: Map) -> bool:
    return found.to in PROJECTED or found.source in PROJECTED


def _origin(arguments: Sequence[Given]) -> Meaning | None:
    """Take a translation for the place of the origin, which it is."""
    meaning = _values(arguments)[0].value.meaning
    if not isinstance(meaning, Map) or meaning.carries in FOR_NORMALS or _projects(meaning):
        return None
    if meaning.to is None:
        return None
    return Located(meaning.to, Kind.POINT)


def _normalised(arguments: Sequence[Given]) -> Meaning | None:
    """Keep the kind of a vector; what has length 1 is no place any more."""
    v = _values(arguments)[0]
    space = together(v)
    if v.sort is Sort.BARE:
        entries = v.value.vector
        if len(entries) == 4 and not is_zero(entries[3]):
            why = f"{v.name} has four components and w is not 0: it would count as length"
            form = f"normalize({factor(v.text)}.xyz)"
            raise RefusedError(why, MistakeId.FOUR_COMPONENT_NORMALISE, forms=(form,))
        return None
    kind = Kind.DIRECTION if v.sort is Sort.POINT else Kind[v.sort.name]
    return Located(space, kind)


def _crossed(arguments: Sequence[Given]) -> Meaning | None:
    a, b = _values(arguments)
    return meaning_of_operator("×", a, b)


def _alike(arguments: Sequence[Given]) -> Meaning | None:
    """Keep what all arguments are: points, directions, or maps of one way."""
    a, *others = _values(arguments)
    if not others:
        return None
    b = others[0]
    if ValueKind.MATRIX in (a.value.kind, b.value.kind):
        return meaning_of_operator("+", a, b)
    space = together(a, b)
    if ValueKind.SCALAR in (a.value.kind, b.value.kind):
        return None
    sorts = {a.sort, b.sort} - {Sort.BARE}
    if Sort.POINT in sorts and len(sorts) > 1 and Sort.VECTOR not in sorts:
        why = f"{a.name} is {a.sort.value}, {b.name} {b.sort.value}: nothing lies between them"
        raise RefusedError(why)
    if not sorts:
        return None
    return Located(space, Kind[sorts.pop().name] if len(sorts) == 1 else Kind.VECTOR)


def _reflected(arguments: Sequence[Given]) -> Meaning | None:
    v, *others = _values(arguments)
    space = together(v, *others)
    is_bare = all(one.sort in (Sort.BARE, Sort.NUMBER) for one in (v, *others))
    return None if is_bare else Located(space, Kind.DIRECTION)


def _made(kind: Kind) -> FunctionRule:
    """Say of a vector what it is, and where."""

    def rule(arguments: Sequence[Given]) -> Meaning | None:
        v, *words = arguments
        assert isinstance(v, Operand)  # the function takes a vector
        named = next((chosen(Frame, word, "space") for word in words if word), None)
        if named is Frame.CLIP and kind is not Kind.POINT:
            why = f"in clip space there are points alone, and this would be a {kind}"
            forms = (f"point({x}, clip)" for x in (v.text, f"untyped({v.text})"))
            raise RefusedError(why, forms=forms)
        if v.is_undivided and not (kind is Kind.POINT and named in (None, Frame.CLIP)):
            raise undivided(v)
        refused = _UNMADE.get((kind, v.sort))
        if refused is not None:
            why, mistake = refused
            raise RefusedError(f"{v.name} is {why}", mistake, forms=(v.text,))
        if named and v.space and named is not v.space:
            why = f"{v.name} is in {v.space} space already, and {named} is asked for"
            wanted = Operand(Value(v.value.entries, Located(named, kind)))
            raise RefusedError(why, apart=(v, wanted))
        if v.sort is Sort.BARE and not named and kind in (Kind.POINT, Kind.VECTOR):
            return None  # a literal with its w
        if kind is Kind.VECTOR:  # w is 0 of a direction and of a normal
            return Located(v.space, Kind.NORMAL if v.sort is Sort.NORMAL else Kind.DIRECTION)
        return Located(named or v.space, kind)

    return rule


_UNMADE: dict[tuple[Kind, Sort], tuple[str, MistakeId | None]] = {
    (Kind.POINT, Sort.DIRECTION): (
        "a direction: w = 1 would add the translation",
        MistakeId.DIRECTION_AS_POINT,
    ),
    (Kind.POINT, Sort.NORMAL): (
        "a normal: w = 1 would add the translation",
        MistakeId.TRANSLATED,
    ),
    **dict.fromkeys(
        ((Kind.DIRECTION, Sort.POINT), (Kind.VECTOR, Sort.POINT)),
        ("a point: without its w it would not move along", None),
    ),
    (Kind.NORMAL, Sort.POINT): ("a point, and a place is normal to nothing", None),
}


def _divided(arguments: Sequence[Given]) -> Meaning | None:
    """Divide by w: a point of clip space becomes one of normalised device coordinates."""
    p = _values(arguments)[0]
    if p.sort is Sort.BARE:
        return None
    if p.space not in (None, Frame.CLIP, Frame.NDC):
        why = f"{p.name} is in {p.space} space, and project divides a point of clip space"
        wanted = Operand(Value(p.value.entries, UNDIVIDED))
        raise RefusedError(why, apart=(p, wanted))
    return Located(Frame.NDC, Kind.POINT)


def _unprojected(arguments: Sequence[Given]) -> Meaning | None:
    """Go back to where the matrix starts, from the window where its viewport is given."""
    window, led, *viewport = _values(arguments)
    begins = Frame.WINDOW if viewport else Frame.NDC
    if window.space not in (None, begins):
        why = f"{window.name} is in {window.space} space, and unproject begins in {begins} space"
        if window.space is Frame.WINDOW:
            pixels = f"unproject({window.name}, {led.name}, viewport(640, 480))"
            raise RefusedError(f"{why} without a viewport", forms=(pixels,))
        wanted = Operand(Value(window.value.entries, Located(begins, Kind.POINT)), "")
        raise RefusedError(why, apart=(window, wanted))
    source = led.map.source
    return Located(source, Kind.POINT) if source else None


def _looking(arguments: Sequence[Given]) -> Meaning:
    """Lead from the space of the eye, which is the world where nothing else is said."""
    return Map(Frame.CAMERA, together(*_values(arguments)) or Frame.WORLD)


def _plane(arguments: Sequence[Given]) -> None:
    """Carry a plane, which no kind of vector is; a map for normals is the wrong way to it."""
    M = _values(arguments)[0]
    if M.map.carries in FOR_NORMALS:
        raise RefusedError(f"{M.name} is for normals, and a plane asks for the map of points")


_RIGID = Map(carries=Carries.ALL)

RULES: dict[str, FunctionRule] = {
    "inverse": _of_map(lambda found: found.inverse),
    "transpose": _transposed,
    "inverse_transpose": _of_map(lambda found: found.inverse_transpose),
    "normal_matrix": _of_map(lambda found: found.inverse_transpose),
    "cofactor": _cofactors,
    "adjugate": _adjugate,
    "linear": _of_map(_block),
    "translation": _origin,
    "transform_plane": _plane,
    "point": _made(Kind.POINT),
    "direction": _made(Kind.DIRECTION),
    "normal": _made(Kind.NORMAL),
    "vector": _made(Kind.VECTOR),
    "untyped": lambda _: None,
    "normalize": _normalised,
    "cross": _crossed,
    "reflect": _reflected,
    "lerp": _alike,
    "slerp": _alike,
    "min": _alike,
    "max": _alike,
    "abs": _nothing,
    "project": _divided,
    "unproject": _unprojected,
    "world": _always(SCENE["M"]),
    "look_at": _looking,
    **dict.fromkeys(("perspective", "frustum", "ortho"), _always(SCENE["P"])),
    "viewport": _always(Map(Frame.WINDOW, Frame.NDC)),
    **dict.fromkeys(("rotate_x", "rotate_y", "rotate_z", "axis_angle"), _always(_RIGID)),
    **dict.fromkeys(("quaternion", "translate"), _always(_RIGID)),
    "power": _raised,
    **dict.fromkeys(("scale", "shear"), _always(Map())),
    **dict.fromkeys(
        (
            "det", "rank", "trace", "identity", "length", "norm", "dot", "angle", "outer",
            "cross_matrix", "sqrt", "sin", "cos", "tan", "asin", "acos", "atan", "atan2",
            "depth_of", "distance_of", "solve", "rref", "null_space", "lu", "eigenvalues",
            "singular_values", "polar", "quaternion_of", "euler",
        ),
        _nothing,
    ),
}  # fmt: skip
