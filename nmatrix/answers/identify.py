"""`nmatrix identify`: what a matrix is, told from its entries, and a command that builds it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from fractions import Fraction
from math import inf, nextafter
from sys import float_info

from nmatrix.answers.world import parts_data
from nmatrix.enums import Api, DepthRange, Handedness, Layout, MatrixKind
from nmatrix.errors import IllegalValueError, quantity
from nmatrix.lessons.map_sentences import verdict
from nmatrix.linear.identify import Camera, Place, Reading, identify
from nmatrix.linear.interval import NO_NUMBER, Bound, Interval, digit_cost, ratio_cost
from nmatrix.linear.lens_readings import LARGEST, LensReading
from nmatrix.linear.rational import (
    AFFINE_ROW,
    ZERO,
    RationalMatrix,
    RationalVector,
    RoundedMatrix,
    determinant,
    rank,
    solve,
    transpose,
)
from nmatrix.linear.rounding import nearest, short_text
from nmatrix.report import Block, Brief, Code, Heading, Number, Report, Table, Text, Value, Verdict

NUMBERS = ("near", "far", "fov_y_deg", "aspect", "left", "right", "bottom", "top")
LINE = 80  # columns of a command
MOST_TOLD = 4  # other readings in the text; every format but text has all
MOST_AT_ONCE = 2  # of them in the short answer
ALLOWED = "The entries allow as well"

_KINDS = {
    MatrixKind.PROJECTION: "a perspective projection",
    MatrixKind.ORTHOGRAPHIC: "a parallel projection",
    MatrixKind.RIGID: "a rigid map",
    MatrixKind.AFFINE: "an affine map",
    MatrixKind.SINGULAR: "a singular matrix",
    MatrixKind.GENERAL: "a general matrix",
}
_RANGES = {
    DepthRange.MINUS_ONE_TO_ONE: "depth −1 at near, 1 at far",
    DepthRange.ZERO_TO_ONE: "depth 0 at near, 1 at far",
    DepthRange.REVERSED: "depth 1 at near, 0 at far",
}
_NAMES = {
    Api.OPENGL: "OpenGL",
    Api.VULKAN: "Vulkan",
    Api.DIRECT3D: "Direct3D",
    Api.METAL: "Metal",
    Api.WEBGPU: "WebGPU",
}


def identify_matrix(rows: RationalMatrix) -> Report:
    """Answer with every reading of a matrix, the likeliest first.

    Raises
    ------
    IllegalValueError
        If it is not of 3×3, 3×4, 4×3 or 4×4 numbers.

    Examples
    --------
    >>> from nmatrix.linear.rational import rational_matrix
    >>> P = rational_matrix([[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, -1], [0, 0, 1, 0]])
    >>> found = identify_matrix(P).data["readings"][0]
    >>> found["kind"], found["handed"], found["depth_range"]
    ('projection', 'left', 'zero-to-one')
    >>> found["command"]
    'nmatrix projection --fov 90 --near 1 --far inf --api direct3d'
    """
    found = identify(_framed(rows))
    readings = [reading_data(one) for one in found]
    data: dict[str, Value] = {"readings": readings, "ambiguous": _ambiguous(found, readings)}
    first, *others = found
    conclusion = Verdict(f"{'Most likely' if others else 'It is'} {described(first)}.")
    evidence, intervals, command = Text(because(first)), _interval_table(first), command_of(first)
    built = () if command is None else (Code("sh", _folded(command), "Built again by"),)
    blocks: list[Block] = [Heading("What is this matrix?"), conclusion, evidence]
    blocks += [*intervals, *built]
    others = [one for one in others if _is_worth_telling(one, first)]
    also: list[Block] = []
    if others:
        told = [f"{i + 2}. {described(one)}" for i, one in enumerate(others[:MOST_TOLD])]
        blocks += [Heading(ALLOWED), Text("\n".join(told))]
        also = [Text("\n".join((f"{ALLOWED}:", *told[:MOST_AT_ONCE])))]
    brief = Brief((conclusion, *built, *also, *intervals, evidence), _further(len(others)))
    return Report("identify", data, tuple(blocks), remarks(found), brief=brief)


def _further(others: int) -> tuple[str, ...]:
    """Count the readings that the short answer leaves out and the whole one has."""
    left = min(others, MOST_TOLD) - MOST_AT_ONCE
    return (f"{left} more reading{'s' if left > 1 else ''}",) if left > 0 else ()


def _is_worth_telling(reading: Reading, first: Reading) -> bool:
    """Leave out views of what lies behind the eye, where a place in the world is likelier."""
    if reading.lens is None or first.lens is not None:
        return True
    return reading.lens.values["far"] > 0 and reading.lens.values["near"] >= 0


def _framed(rows: RationalMatrix) -> RationalMatrix:
    """Complete three rows of four, [R t], or their transpose, to an affine 4×4."""
    shape = len(rows), len(rows[0])
    if shape in {(3, 3), (4, 4)}:
        return rows
    if shape == (4, 3):
        return _transposed(_framed(_transposed(rows)))
    if shape != (3, 4):
        raise IllegalValueError(
            f"a matrix of {shape[0]} × {shape[1]} numbers",
            "only maps of space are told apart",
            "give 3×3, 3×4 or 4×4 numbers",
        )
    if not isinstance(rows, RoundedMatrix):
        return (*rows, AFFINE_ROW)
    exact = ((ZERO,) * 4,)
    halves = (rows.half_units + exact, rows.shared_half_units + exact)
    return RoundedMatrix.of((*rows, AFFINE_ROW), *halves)


def _transposed(rows: RationalMatrix) -> RationalMatrix:
    if not isinstance(rows, RoundedMatrix):
        return transpose(rows)
    halves = (transpose(rows.half_units), transpose(rows.shared_half_units))
    return RoundedMatrix.of(transpose(rows), *halves)


def reading_data(reading: Reading) -> dict[str, Value]:
    """Describe a reading under the keys of the data; what it has not is None."""
    lens, place = reading.lens, reading.place
    numbers = {} if lens is None else lens.bounds
    parts = None if place is None or place.parts is None else place.parts
    return {
        "kind": reading.kind.value,
        "layout": reading.layout.value,
        "handed": None if lens is None else lens.handed.value,
        "depth_range": None if lens is None or lens.depth is None else lens.depth.value,
        "clip_y": None if lens is None else lens.clip_y.value,
        **{name: _outwards(numbers[name]) if name in numbers else None for name in NUMBERS},
        "apis": [] if lens is None else [api.value for api in lens.apis],
        "eye": None if place is None or place.camera is None else place.camera.eye,
        "parts": None if parts is None else parts_data(parts),
        "residual": reading.residual,
        "because": because(reading),
        "command": command_of(reading),
    }


def _outwards(found: Interval) -> tuple[float, float | None]:
    """Return floats that enclose an interval; None for what is beyond the largest."""
    low = nearest(max(min(found.low, LARGEST), -LARGEST))
    low = low if Fraction(low) <= found.low else nextafter(low, -inf)
    if found.high > LARGEST:
        return max(low, -float_info.max), None
    high = nearest(max(Fraction(found.high), -LARGEST))
    return low, high if Fraction(high) >= found.high else nextafter(high, inf)


def _ambiguous(readings: Sequence[Reading], data: Sequence[Mapping[str, Value]]) -> list[str]:
    """List the keys on which the readings differ: the entries do not decide them."""
    words = ("kind", "layout", "handed", "depth_range", "clip_y")
    open_ = [key for key in words if any(one[key] != data[0][key] for one in data)]
    for key in NUMBERS:
        bounds = [None if one.lens is None else one.lens.bounds.get(key) for one in readings]
        if any(not _overlap(bounds[0], other) for other in bounds):
            open_.append(key)
    open_ += [key for key in ("eye", "parts") if any(one[key] != data[0][key] for one in data)]
    return open_


def _overlap(one: Interval | None, other: Interval | None) -> bool:
    if one is None or other is None:
        return one is other
    return one.low <= other.high and other.low <= one.high


def described(reading: Reading) -> str:
    """Describe a reading in a phrase: what it is, for which interface, with which numbers."""
    stored = ", stored by columns," if reading.layout is Layout.COLUMN_MAJOR else ""
    if reading.lens is None:
        return f"{_KINDS[reading.kind]}{stored.rstrip(',')}{_place_numbers(reading.place)}"
    lens = reading.lens
    names = " or ".join(_NAMES[api] for api in lens.apis) or "no usual interface"
    hand = "−z" if lens.handed is Handedness.RIGHT else "+z"
    depth = "depth in no usual range" if lens.depth is None else _RANGES[lens.depth]
    clip = f"that looks down {hand}, y {lens.clip_y} in clip space, {depth}"
    return f"{_KINDS[reading.kind]}{stored} {clip} ({names}){_lens_numbers(lens)}"


def _lens_numbers(lens: LensReading) -> str:
    numbers = lens.values
    told = [f"{name} {_short(numbers[name])}" for name in ("near", "far") if name in numbers]
    if "fov_y_deg" in numbers:
        told.append(f"field of view {_short(numbers['fov_y_deg'])}°")
        told.append(f"aspect {_typed_ratio(numbers['aspect'])}")
    elif "left" in numbers:
        told.append("window " + " ".join(_short(numbers[side]) for side in NUMBERS[-4:]))
    return f"; {', '.join(told)}" if told else ""


def camera_numbers(camera: Camera) -> str:
    """Describe a camera in round numbers: its eye, and where it looks if it looks down −z."""
    eye = f"eye {' '.join(map(_short, camera.eye))}"
    if camera.looks_at_origin:
        ahead = "−z" if camera.handed is Handedness.RIGHT else "+z"
        return f"{eye}, looking at the origin if it looks down {ahead}"
    named = zip(("elevation", "angle", "roll"), camera.turn, strict=True)
    return f"{eye}, " + ", ".join(f"{name} {_short(one)}°" for name, one in named)


def _place_numbers(place: Place | None) -> str:
    if place is not None and place.is_view and place.camera is not None:
        return f", a view: {camera_numbers(place.camera)}"
    if place is None or place.parts is None:
        return ""
    parts = place.parts
    nearly = " nearly" if set(map(_short, parts.scale)) == {"1"} else ""
    told = {
        "moved by": parts.translate if any(parts.translate) else None,
        "turned by": parts.rotate if any(parts.rotate) else None,
        f"scaled by{nearly}": parts.scale if set(parts.scale) != {1} else None,
        "sheared by": parts.shear if any(parts.shear) else None,
    }
    words = [
        f"{word} {' '.join(map(_short, one))}" for word, one in told.items() if one is not None
    ]
    turned = f" ({parts.order})" if told["turned by"] and parts.order != "XYZ" else ""
    return f": {', '.join(words)}{turned}" if words else ": the identity"


def because(reading: Reading) -> str:
    """Give the evidence: which entries say so."""
    try:
        return _evidence(reading)
    except IllegalValueError:
        return "Its numbers are beyond float64."


def _evidence(reading: Reading) -> str:
    turned = "Read by columns: " if reading.layout is Layout.COLUMN_MAJOR else ""
    if reading.lens is not None:
        factor = reading.lens.factor
        times = "" if factor == 1 else f"All of it times {_short(factor)}, which /w undoes: "
        return f"{turned}{times}{_lens_evidence(reading.lens)}"
    if reading.place is not None:
        affine = "" if len(reading.rows) == 3 else "The last row is 0 0 0 1. "
        return f"{turned}{affine}{_place_evidence(reading.place)}"
    return _other_evidence(reading.rows)


def _lens_evidence(lens: LensReading) -> str:
    if lens.is_perspective:
        ahead = "w = −z" if lens.handed is Handedness.RIGHT else "w = +z"
        told = [f"{ahead} is positive in front of the camera"]
    else:
        told = ["w is 1 everywhere, so nothing gets smaller with distance"]
    told.append(f"y is scaled by a {'positive' if lens.clip_y == 'up' else 'negative'} number")
    if lens.depth is None:
        told.append("its z row fits no near and far plane")
    else:
        near, far = (_short(lens.values[name]) for name in ("near", "far"))
        told.append(f"{_RANGES[lens.depth].replace('near', near).replace('far', far)}")
    return f"{'; '.join(told)}."


def _place_evidence(place: Place) -> str:
    told = verdict(place.found)
    if place.camera is None:
        return told
    eye = " ".join(map(_short, place.camera.eye))
    return f"{told} As a view its eye is at {eye}; down −z or down +z is not in the entries."


def _other_evidence(rows: RationalMatrix) -> str:
    if not any(map(any, rows)):
        return "All entries are 0: it sends everything to one point."
    found = rank(rows)
    if found < len(rows):
        return f"Its determinant is exactly 0 (rank {found}), so nothing undoes it."
    if abs(rows[3][2]) == 1 and not (rows[3][0] or rows[3][1] or rows[3][3]):
        return (
            "w is ±z, as of a projection, but x, y or z are mixed in rows 1 to 3: a projection "
            "whose near plane is oblique, that is skewed, or times a view."
        )
    w = " ".join(map(_short, rows[3]))
    told = f"Its last row is {w}: not 0 0 0 1 of an affine map, nor 0 0 ±1 0 of a projection."
    eye = _centre(rows)
    if eye is None:
        return told
    at = " ".join(map(_short, eye))
    return f"{told} Times a view it may be one: x = y = w = 0 at {at}, which would be the eye."


def _centre(rows: RationalMatrix) -> RationalVector | None:
    """Find the one point that projects to x = y = w = 0, if there is one."""
    block = (rows[0][:3], rows[1][:3], rows[3][:3])
    if not any(rows[3][:3]) or not determinant(block):
        return None
    return solve(block, (-rows[0][3], -rows[1][3], -rows[3][3]))


def command_of(reading: Reading) -> str | None:
    """Write the command that builds the matrix again out of round numbers, if floats hold them."""
    try:
        return _command_of(reading)
    except IllegalValueError:
        return None


def _command_of(reading: Reading) -> str | None:
    if reading.lens is not None:
        return None if reading.lens.rebuilt is None else _lens_command(reading.lens)
    if reading.place is None or reading.place.rebuilt is None:
        return None
    if reading.place.is_view and reading.place.camera is not None:
        return _view_command(reading.place.camera)
    return _world_command(reading.place)


def _lens_command(lens: LensReading) -> str:
    numbers = lens.values
    words = ["nmatrix projection"]
    if lens.is_perspective and lens.is_centred:
        words.append(f"--fov {_typed(numbers['fov_y_deg'])}")
        if numbers["aspect"] != 1:
            words.append(f"--aspect {_typed_ratio(numbers['aspect'])}")
    else:
        sides = " ".join(_typed(numbers[side]) for side in NUMBERS[-4:])
        words.append(f"--{'frustum' if lens.is_perspective else 'ortho'} {sides}")
    words.append(f"--near {_typed(numbers['near'])} --far {_typed(numbers['far'])}")
    if lens.apis:
        words += [] if Api.OPENGL in lens.apis else [f"--api {lens.apis[0]}"]
        words += ["--depth reversed"] if lens.depth is DepthRange.REVERSED else []
    else:
        words.append(f"--depth {lens.depth} --handed {lens.handed} --clip-y {lens.clip_y}")
    return " ".join(words)


def _world_command(place: Place) -> str:
    parts = place.parts
    assert parts is not None  # what is rebuilt has parts
    words = ["nmatrix world"]
    for option, numbers, usual in (
        ("translate", parts.translate, 0),
        ("rotate", parts.rotate, 0),
        ("scale", parts.scale, 1),
        ("shear", parts.shear, 0),
    ):
        if any(number != usual for number in numbers):
            words.append(f"--{option} {' '.join(map(_typed, numbers))}")
    if any(parts.rotate) and parts.order != "XYZ":
        words.append(f"--order {parts.order}")
    return " ".join(words)


def _view_command(camera: Camera) -> str:
    words = [f"nmatrix view --eye {' '.join(map(_typed, camera.eye))}"]
    if camera.looks_at_origin:
        words.append("--target 0 0 0")
        words += ["--handed left"] if camera.handed is Handedness.LEFT else []
    else:
        names = ("elevation", "angle", "roll")
        words += [f"--{name} {_typed(one)}" for name, one in zip(names, camera.turn, strict=True)]
    return " ".join(words)


def _interval_table(reading: Reading) -> tuple[Block, ...]:
    if reading.lens is None or not reading.lens.bounds:
        return ()
    lens = reading.lens
    told = NUMBERS[:4] if lens.is_centred else (*NUMBERS[:2], *NUMBERS[-4:])
    rows = tuple(
        (name, *_cells(name, lens.values[name], lens.bounds[name]))
        for name in told
        if name in lens.bounds
    )
    title = "All values that round to the digits given"
    return (Table(("quantity", "roundest", "at least", "at most"), rows, title),)


def _cells(name: str, value: Bound, bounds: Interval) -> tuple[Number | str, ...]:
    """Write a number, or a ratio as p/q, and the interval around it; infinity as a word."""
    low, high = _outwards(bounds)
    if high is None:
        beyond = "inf" if Fraction(low) >= LARGEST else low
        return _typed(value) if value == inf else value, beyond, "inf"
    return _typed_ratio(value) if name == "aspect" else value, low, high


def remarks(readings: Sequence[Reading]) -> tuple[str, ...]:
    """Tell how to read it elsewhere, and what is not in the entries."""
    told = []
    if readings[0].layout is Layout.COLUMN_MAJOR:
        told.append(
            f"Where it is read, say {quantity('input_layout')} column-major: as it stands it is "
            "the transpose."
        )
    ranges = {one.lens.depth for one in readings if one.lens is not None}
    if len(ranges) > 1:
        told.append(
            "A depth range is not in the entries: each of these near and far planes makes them, "
            "and the roundest numbers come first."
        )
    if readings[0].kind is MatrixKind.RIGID and len({r.layout for r in readings}) > 1:
        told.append("Without a translation a matrix and its transpose look alike: both are rigid.")
    return tuple(told)


def _folded(command: str) -> str:
    """Break a command that is longer than a line before an option, as a shell reads it on."""
    first, *options = command.split(" --")
    lines = [first]
    for option in options:
        room = LINE - len(" \\")
        if len(f"{lines[-1]} --{option}") <= room:
            lines[-1] += f" --{option}"
        else:
            lines.append(f"  --{option}")
    return " \\\n".join(lines)


def _short(value: Bound | float) -> str:
    return "inf" if value == inf else short_text(Fraction(value), 6)


def _typed(value: Bound | float) -> str:
    """Write a number so that it reads back as it is, in the fewest digits."""
    if value == inf:
        return "inf"
    exact = Fraction(value)
    if digit_cost(exact) < NO_NUMBER:
        return short_text(exact, int(NO_NUMBER))
    return repr(nearest(exact))


def _typed_ratio(value: Bound) -> str:
    exact = Fraction(value)
    return str(exact) if ratio_cost(exact) < digit_cost(exact) else _typed(exact)
