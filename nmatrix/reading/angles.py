"""Angles as they are typed, in a shell, a scene or Python: degrees, or a number with its unit.

Radians that forgot to say so are recognised.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from fractions import Fraction

from nmatrix.errors import IllegalValueError, quantity, quoted
from nmatrix.linear.angle import DEGREES, PI, Angle
from nmatrix.linear.rounding import nearest
from nmatrix.linear.values import listed, marked, number, real
from nmatrix.reading.numbers import LONGEST, fraction, number_words
from nmatrix.report import Number, Vector

NEAR = Fraction(5, 10_000)  # radians: four digits of a multiple of π/12 are nearer
FULL_TURN = 360
EXAMPLE = "write it like 30, 90deg, 1.5708rad, pi/2rad or 0.25turn"

_UNIT = re.compile(r"(?P<size>.*?)(?P<unit>deg|°|rad|turns?)", re.DOTALL)
_OF_PI = re.compile(
    r"(?P<sign>[+\-−]?)(?P<times>[0-9.]+(?:/[0-9]+)?)?\*?(?:pi|π)(?:/(?P<parts>[0-9.]+))?"
)


def angle(text: str, name: str = "angle") -> Fraction:
    """Read an angle in degrees.

    Multiples of π, degrees and turns are exact, other radians are the nearest float64 of degrees.

    Raises
    ------
    IllegalValueError
        If it is no number, or one of π without a unit.

    Examples
    --------
    >>> [float(angle(one)) for one in ("30", "90deg", "-3pi/4rad", "0.25turn", "1rad")]
    [30.0, 90.0, -135.0, 90.0, 57.29577951308232]
    """
    stripped = text.strip(" \t\r\n")
    found = _UNIT.fullmatch(stripped) if len(stripped) <= LONGEST else None
    if found is None:
        if _OF_PI.fullmatch(stripped[:LONGEST]):
            why = "a multiple of π is in radians"
            raise IllegalValueError(f"{name} ({quoted(text)})", why, f"write {stripped}rad")
        return fraction(text, name)
    size, unit = found["size"].rstrip(), found["unit"]
    if unit in ("deg", "°"):
        return fraction(size, name)
    if unit != "rad":
        return fraction(size, name) * FULL_TURN
    of_pi = _OF_PI.fullmatch(size)
    if of_pi is None:
        return Fraction(nearest(fraction(size, name) * DEGREES))
    turned = fraction(of_pi["times"] or "1", name) * FULL_TURN / 2
    parts = fraction(of_pi["parts"] or "1", name)
    if not parts:
        raise IllegalValueError(f"{name} ({quoted(text)})", "nothing is divided by 0", EXAMPLE)
    return (-turned if of_pi["sign"] in ("-", "−") else turned) / parts


def turn(value: object, name: str) -> Number:
    """Read an angle in degrees: a number of degrees, an `Angle`, or a text as it is typed.

    Examples
    --------
    >>> turn(30, "fov"), float(turn("pi/6rad", "fov"))
    (30, 30.0)
    """
    if isinstance(value, str):
        return angle(value, marked(name))
    return value.in_degrees if isinstance(value, Angle) else number(value, name)


def float_turn(value: object, name: str) -> float:
    """Read the float64 nearest to an angle in degrees."""
    return real(turn(value, name), name)


def turns(values: object, name: str, size: int = 3) -> Vector:
    """Read so many angles in degrees.

    Examples
    --------
    >>> [float(one) for one in turns([30, "0.25turn", "-pi/4rad"], "rotate")]
    [30.0, 90.0, -45.0]
    """
    entries = listed(values, name, (size,))
    return tuple(turn(one, f"{name}[{i}]") for i, one in enumerate(entries))


def with_its_unit(text: str, name: str) -> Angle:
    """Read an angle where a bare number is radians, so that a text must say its unit.

    Raises
    ------
    IllegalValueError
        For a number without one.

    Examples
    --------
    >>> with_its_unit("90deg", "turn")
    Angle.degrees(90)
    """
    degrees = angle(text, name)
    if not _UNIT.fullmatch(text.strip(" \t\r\n")):
        shown, plain = quoted(text), text.strip()
        why = "a text says its unit"
        raise IllegalValueError(f"{name} ({shown})", why, f"write {plain}deg or {plain}rad")
    return Angle.degrees(degrees)


def radians_remark(text: str, name: str) -> str | None:
    """Tell how radians are written, if the angles of one option look like them.

    Examples
    --------
    >>> radians_remark("0 1.5708 0", "rotate") is None, radians_remark("0 3 0.5", "rotate")
    (False, None)
    """
    words = [word for word in number_words(text) if not _UNIT.fullmatch(word)]
    found = like_radians([fraction(word, name) for word in words])
    if found is None:
        return None
    place, times = found
    looks = f"{quantity(name)} is in degrees, but {words[place]} looks like radians"
    return f"{looks}: those are written {words[place]}rad or {of_pi(times)}rad."


def like_radians(sizes: Sequence[Fraction]) -> tuple[int, Fraction] | None:
    """Find the first of some numbers that looks like radians, and which multiple of π it nearly is.

    All are at most 2π, and this one, not whole, is nearly a multiple of π/12.

    Examples
    --------
    >>> like_radians([Fraction(0), Fraction("1.5708")]), like_radians([Fraction(90)])
    ((1, Fraction(1, 2)), None)
    """
    if any(abs(size) > 2 * PI for size in sizes):
        return None
    for place, size in enumerate(sizes):
        twelfths = round(12 * size / PI)
        if twelfths and abs(size - twelfths * PI / 12) <= NEAR and size.denominator != 1:
            return place, Fraction(twelfths, 12)
    return None


def of_pi(times: Fraction) -> str:
    """Write a multiple of π.

    Examples
    --------
    >>> of_pi(Fraction(-3, 4)), of_pi(Fraction(1, 12)), of_pi(Fraction(2))
    ('-3pi/4', 'pi/12', '2pi')
    """
    top = {1: "pi", -1: "-pi"}.get(times.numerator, f"{times.numerator}pi")
    return top if times.denominator == 1 else f"{top}/{times.denominator}"
