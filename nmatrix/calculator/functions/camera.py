"""Functions of the camera: view and projection matrices, the window, and the ways through them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from math import inf
from typing import Any

from nmatrix.calculator.arithmetic.numbers import angle, in_degrees, is_zero, shown, size
from nmatrix.calculator.arithmetic.values import Value, ValueKind
from nmatrix.calculator.functions.function import (
    ArgumentError,
    Function,
    NoAnswerForArgumentError,
    Parameter,
    matrix,
    require_size,
    require_square,
    scalar,
    turn,
    vector,
    whole,
    word,
    zero_vector,
)
from nmatrix.calculator.functions.matrices import inverted
from nmatrix.calculator.functions.vectors import length_of
from nmatrix.enums import ClipY, DepthRange, Handedness, WindowOrigin
from nmatrix.errors import IllegalValueError, NoAnswerError, spelled
from nmatrix.linear import projection, rational, view
from nmatrix.linear.projection import ClipSpace
from nmatrix.linear.rational import AFFINE_ROW, ONE, ZERO, RationalMatrix, RationalVector
from nmatrix.linear.viewport import WINDOW_DEPTH, window_from_ndc

INFINITE = "inf"
LARGEST_SIDE = 10**9  # of a window, in pixels
LARGEST_SIZE = 10**300  # of a distance: errors show it as a float
DEPTHS = {one.value.replace("-", "_"): one for one in DepthRange}
HANDS = {one.value: one for one in Handedness}
ORIGINS = {one.value.replace("-", "_"): one for one in WindowOrigin}
UPRIGHT = Value((ZERO, ONE, ZERO))
USUAL_DEPTH, USUAL_HAND, USUAL_ORIGIN = (
    one.value.replace("-", "_")
    for one in (ClipSpace().depth, ClipSpace().handed, ClipSpace().origin)
)
DepthRow = tuple[Fraction, Fraction]
Arguments = Any  # values and words, of the kinds that the parameters declare


@dataclass(frozen=True)
class LensValue(Value):
    """A projection matrix that knows how window depth runs: as a 2×2 map of (distance, 1)."""

    window_depth: RationalMatrix = ()


def _three(*values: Value) -> tuple[RationalVector, ...]:
    for one in values:
        require_size(one, 3, "three numbers")
    return tuple(one.vector for one in values)


def viewed(eye: RationalVector, axes: tuple[RationalVector, ...]) -> RationalMatrix:
    """Build the view matrix of an eye and the directions of the camera's x, y and z."""
    rows = []
    for axis in axes:
        length = length_of(axis)
        along = rational.dot(axis, eye)
        rows.append((*(one / length for one in axis), -(along / length)))
    return (*rows, AFFINE_ROW)


def stand_in(eye: Value, target: Value, up: Value) -> RationalVector | None:
    """Choose what takes the place of an up that is parallel to the view direction.

    Raises
    ------
    NoAnswerError
        Where the eye is the target, or up is zero.
    """
    from_eye, to, upwards = _three(eye, target, up)
    forward = tuple(t - e for e, t in zip(from_eye, to, strict=True))
    if is_zero(rational.dot(forward, forward)):
        why = "it is where the eye is, so there is no direction to look in"
        raise NoAnswerForArgumentError(target, "the target", why, "move one of them")
    if is_zero(rational.dot(upwards, upwards)):
        raise zero_vector(up, "up")
    right = rational.cross(forward, upwards)
    if not is_zero(rational.dot(right, right)):
        return None
    return view.upright_for(tuple(Fraction(float(shown(one))) for one in forward))


def looking_at(
    eye: Value, target: Value, up: Value = UPRIGHT, handed: Handedness = Handedness.RIGHT
) -> RationalMatrix:
    """Build the view matrix of a camera that looks at a target, exactly."""
    upright = stand_in(eye, target, up) or up.vector
    forward = tuple(t - e for e, t in zip(eye.vector, target.vector, strict=True))
    return viewed(eye.vector, view.camera_axes(forward, upright, handed))


def _look_at(eye: Value, target: Value, up: Value, handed: str) -> Value:
    return Value(looking_at(eye, target, up, HANDS[handed]))


def _look_at_remarks(eye: Value, target: Value, up: Value, handed: str) -> list[str]:
    instead = stand_in(eye, target, up)
    if instead is None:
        return []
    taken = ", ".join(map(str, instead))
    return [f"up is parallel to the view direction; [{taken}] took its place."]


def clip_of(depth: str, handed: str, clip_y: str) -> ClipSpace:
    """Make a clip space of the words that the functions of lenses take."""
    return ClipSpace(DEPTHS[depth], HANDS[handed], ClipY(clip_y))


def _distance(given: Value | str) -> Fraction:
    """Take a distance that is not too large to be told in an error."""
    if isinstance(given, str):
        return inf  # type: ignore[return-value]  # which the formulas of a lens take
    if size(given.scalar) > LARGEST_SIZE:
        step = f'write "{INFINITE}" for a far plane without end'
        raise ArgumentError(given, "a distance", "it is beyond 1e300", step)
    return given.scalar


def _depth_row(near: Value, far: Value | str, depth: str, of: Callable[..., DepthRow]) -> DepthRow:
    """Compute a and c of the z row, and tell what is wrong with near and far at near."""
    try:
        return of(_distance(near), _distance(far), DEPTHS[depth])
    except (IllegalValueError, NoAnswerError) as error:
        kind = ArgumentError if isinstance(error, IllegalValueError) else NoAnswerForArgumentError
        if isinstance(error, ArgumentError):
            raise
        what, why, _ = error.parts
        step = "near and far are distances in front of the eye"
        raise kind(near, spelled(what, str), why, step) from None


def _perspective(fov: Value, aspect: Value, near: Value, far: Value | str, *words: str) -> Value:
    if not 0 < in_degrees(fov.scalar) < 180:
        why = "it lies between 0 and 180 degrees, both excluded"
        raise ArgumentError(fov, "the field of view", why, "try 60")
    if not aspect.scalar > 0:
        why = "width over height is above 0"
        raise ArgumentError(aspect, "the aspect", why, "try 16/9")
    _depth_row(near, far, words[0], projection.perspective_depth)
    half = angle(Value(in_degrees(fov.scalar)).scalar / 2)
    clip = clip_of(*words)
    shape, *ends = map(_distance, (aspect, near, far))
    return lens_value(projection.perspective(half, shape, ends[0], ends[1], clip), clip)


def _sides(given: Sequence[Value]) -> projection.Sides:
    for low, high in (given[:2], given[2:]):
        if is_zero(high.scalar - low.scalar):
            why = "it lies where the opposite one does, so the view has no extent"
            raise NoAnswerForArgumentError(high, "a side", why, "move one of them")
    left, right, bottom, top = (_distance(one) for one in given)
    return left, right, bottom, top


def _frustum(*given: Arguments) -> Value:
    sides, (near, far, *words) = _sides(given[:4]), given[4:]
    row = _depth_row(near, far, words[0], projection.perspective_depth)
    clip = clip_of(*words)
    return lens_value(projection.through(sides, near.scalar, row, clip), clip)


def _ortho(*given: Arguments) -> Value:
    sides, (near, far, *words) = _sides(given[:4]), given[4:]
    row = _depth_row(near, far, words[0], projection.orthographic_depth)
    clip = clip_of(*words)
    return lens_value(projection.parallel(sides, row, clip), clip)


def _viewport(width: Value, height: Value, depth: str, origin: str) -> Value:
    sides = [whole(one, LARGEST_SIDE, "a side in pixels", least=1) for one in (width, height)]
    clip = ClipSpace(depth=DEPTHS[depth], origin=ORIGINS[origin])
    return Value(window_from_ndc(sides[0], sides[1], clip))


def _project(p: Value) -> Value:
    require_size(p, 4, "a point x, y, z, w of clip space")
    return Value(_divided(p, p.vector))


def _divided(given: Value, p: RationalVector) -> RationalVector:
    *place, w = p
    if is_zero(w):
        why = "nothing is divided by it: the point lies at infinity, or in the plane of the eye"
        raise NoAnswerForArgumentError(given, "w = 0", why, "use a point in front of the eye")
    return tuple(one / w for one in place)


def _unproject(window: Value, M: Value, viewport: Value | None) -> Value:
    require_size(window, 3, "a place x, y and a depth z")
    for one in (M, viewport):
        if one is not None:
            require_size(one, 4, "a 4×4 matrix")
            require_square(one)
    back = inverted(M)
    if viewport is not None:
        back = rational.product(back, inverted(viewport))
    return Value(_divided(window, rational.apply(back, (*window.vector, ONE))))


def window_depth(z_and_w: RationalMatrix, depth: DepthRange) -> RationalMatrix:
    """Build the 2×2 map from (distance, 1) to window depth of the one that leads to z and w."""
    slope, offset = WINDOW_DEPTH[depth]
    return rational.product(((slope, offset), (ZERO, ONE)), z_and_w)


def lens_value(P: RationalMatrix, clip: ClipSpace) -> Value:
    """Keep how window depth runs beside a projection, where it is the same across the picture."""
    (*_, a, c), (*_, w, rest) = P[2:]
    if any(P[2][:2]) or any(P[3][:2]):
        return Value(P)
    forward = clip.forward_z
    depth = window_depth(((forward * a, c), (forward * w, rest)), clip.depth)
    return LensValue(P, window_depth=depth)


def _depth_map(*given: Arguments) -> RationalMatrix:
    near, far, depth, P = given
    if near is not None and far is not None:
        slope, offset = _depth_row(near, far, depth or USUAL_DEPTH, projection.perspective_depth)
        return window_depth(((slope, offset), (ONE, ZERO)), DEPTHS[depth or USUAL_DEPTH])
    if (near, far, depth) != (None, None, None) or not getattr(P, "window_depth", ()):
        why = "depth runs from near to far"
        raise IllegalValueError("near and far are missing", why, "write near=1, far=100")
    return P.window_depth  # type: ignore[no-any-return]  # a matrix


def _depth_of(d: Value, *lens: Arguments) -> Value:
    (a, b), (c, e) = _depth_map(*lens)
    if not is_zero(c) and not d.scalar > 0:
        why = "in a perspective view depth begins in front of the eye"
        raise NoAnswerForArgumentError(d, "a distance", why, "give one above 0")
    return Value((a * d.scalar + b) / (c * d.scalar + e))


def _distance_of(z: Value, *lens: Arguments) -> Value:
    (a, b), (c, e) = _depth_map(*lens)
    bottom = a - z.scalar * c
    if is_zero(bottom):
        why = "what has it is infinitely far away"
        raise NoAnswerForArgumentError(z, "a depth", why, "use one nearer to the eye")
    found = (z.scalar * e - b) / bottom
    if not is_zero(c) and not found > 0:
        why = "what has it would lie behind the eye"
        raise NoAnswerForArgumentError(z, "a depth", why, "use one from 0 to 1")
    return Value(found)


_CLIP_WORDS = (
    word("depth", *DEPTHS, default=USUAL_DEPTH),
    word("handed", *HANDS, default=USUAL_HAND),
    word("clip_y", *ClipY, default=ClipSpace().clip_y.value),
)
_FAR = Parameter("far", (ValueKind.SCALAR,), choices=(INFINITE,))
_LENS = (
    Parameter("near", (ValueKind.SCALAR,), is_optional=True),
    replace(_FAR, is_optional=True),
    word("depth", *DEPTHS),
    Parameter("P", (ValueKind.MATRIX,), stands_for="P"),
)
_SIDES = tuple(scalar(name) for name in ("left", "right", "bottom", "top"))

FUNCTIONS: dict[str, Function] = {
    "look_at": Function(
        (
            vector("eye"),
            vector("target"),
            vector("up", UPRIGHT),
            word("handed", *HANDS, default=USUAL_HAND),
        ),
        "the view matrix of a camera at an eye that looks at a target; it looks down −z",
        "rows are the camera's right, up and back, of length 1; the last column brings the eye "
        "to 0",
        "f = target − eye, r = f × up, u = r × f, rows r, u, −f",
        "look_at([0, 0, 5], [0, 0, 0])",
        "translate(0, 0, -5)",
        _look_at,
        remarks=_look_at_remarks,
    ),
    "perspective": Function(
        (turn("fov"), scalar("aspect"), scalar("near"), _FAR, *_CLIP_WORDS),
        "the projection of a vertical field of view in degrees, width over height, near and far; "
        'far may be "inf"',
        "similar triangles: y over the distance, times cot(fov/2)",
        "P₀₀ = cot(fov/2) / aspect, P₁₁ = cot(fov/2), w = −z",
        "perspective(60, 2, 1, 3)",
        "[√3/2 0 0 0; 0 √3 0 0; 0 0 -2 -3; 0 0 -1 0]",
        _perspective,
    ),
    "frustum": Function(
        (*_SIDES, scalar("near"), _FAR, *_CLIP_WORDS),
        "the projection through a rectangle of the near plane, which need not be centred",
        "similar triangles: x over the distance, times near",
        "P₀₀ = 2n / (r − l), P₀₂ = (r + l) / (r − l)",
        'frustum(0, 2, -1, 1, 1, "inf")',
        "[1 0 1 0; 0 1 0 0; 0 0 -1 -2; 0 0 -1 0]",
        _frustum,
    ),
    "ortho": Function(
        (*_SIDES, scalar("near"), scalar("far"), *_CLIP_WORDS),
        "the parallel projection of a box",
        "the box is moved to the middle and scaled to the cube",
        "P₀₀ = 2 / (r − l), P₀₃ = −(r + l) / (r − l)",
        "ortho(0, 4, -1, 1, -1, 1)",
        "[1/2 0 0 -1; 0 1 0 0; 0 0 -1 0; 0 0 0 1]",
        _ortho,
    ),
    "viewport": Function(
        (
            scalar("width"),
            scalar("height"),
            word("depth", *DEPTHS, default=USUAL_DEPTH),
            word("origin", *ORIGINS, default=USUAL_ORIGIN),
        ),
        "the map from normalised device coordinates to pixels and window depth",
        "−1 to 1 becomes 0 to the width, and 0 to the height",
        "x′ = (x + 1) · width / 2",
        "viewport(640, 480)",
        "[320 0 0 320; 0 240 0 240; 0 0 1/2 1/2; 0 0 0 1]",
        _viewport,
    ),
    "project": Function(
        (vector("p"),),
        "a point of clip space divided by its w: normalised device coordinates",
        "x, y and z over w",
        "(x/w, y/w, z/w)",
        "project(perspective(90, 1, 1, 3) @ point([1, 0, -2]))",
        "[1/2, 0, 1/2]",
        _project,
    ),
    "unproject": Function(
        (
            vector("window"),
            matrix("matrix"),
            Parameter("viewport", (ValueKind.MATRIX,), is_optional=True),
        ),
        "the point that a matrix such as P @ V and the division by w take to a place of normalised "
        "device coordinates, or with viewport(width, height) to a place and depth of the window",
        "the inverse matrix, and its own division by w",
        "p = M⁻¹ (x, y, z, 1), over its w",
        "unproject([1/2, 0, 1/2], perspective(90, 1, 1, 3))",
        "[1, 0, -2]",
        _unproject,
    ),
    "depth_of": Function(
        (scalar("d"), *_LENS),
        "the window depth from 0 to 1 of a distance along the view direction, for the lens of P or "
        "for a perspective view of another near and far",
        "z over w, and the viewport",
        "z′ = a + c/d",
        "depth_of(2, near=1, far=4)",
        "2/3",
        _depth_of,
    ),
    "distance_of": Function(
        (scalar("z"), *_LENS),
        "the distance along the view direction of a window depth from 0 to 1, for the lens of P or "
        "for a perspective view of another near and far",
        "the depth of a distance, solved for the distance",
        "d = c / (z′ − a)",
        "distance_of(2/3, near=1, far=4)",
        "2",
        _distance_of,
    ),
}
