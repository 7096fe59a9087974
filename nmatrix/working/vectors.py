"""Lengths, unit vectors, dot and cross products, angles, and the division by w."""

from __future__ import annotations

from fractions import Fraction

from nmatrix.errors import IllegalValueError, NoAnswerError
from nmatrix.linear.angle import DEGREES, Angle, arctangent
from nmatrix.linear.rounding import inverse_root
from nmatrix.report import Formula, Step
from nmatrix.surds import sine
from nmatrix.working.determinants import sum_of
from nmatrix.working.products import given, product
from nmatrix.working.working import (
    EXACT,
    KNOWN,
    ONE,
    Entry,
    Matrix,
    Notation,
    Proof,
    Vector,
    Working,
    added,
    cells_or_entries,
    chain,
    decimal,
    fits,
    lines,
    lowered,
    middle,
    squared,
)


def dot(a: Vector, b: Vector, names: tuple[str, str] = ("a", "b"), by: Notation = EXACT) -> Working:
    """Multiply two vectors, component by component, and add.

    Examples
    --------
    >>> dot((1, 2, 3), (4, -5, 6)).steps[-1].formula.parts
    ('a · b = 1·4 + 2·(−5) + 3·6 = 4 − 10 + 18 = 12',)
    """
    texts, value = sum_of([(1, pair) for pair in zip(a, b, strict=True)], by)
    proved = by.same(value, by.dot(b[::-1], a[::-1]))
    reasons = ("component by component", "the products", "the sum")
    shown = lines(f"{names[0]} · {names[1]}", texts, reasons, proved=proved)
    return Working((*given(tuple(zip(names, (a, b), strict=True)), by), *shown), value)


def length(v: Vector, name: str = "v", by: Notation = EXACT) -> Working:
    """Find the length of a vector: the root of the sum of the squares.

    Examples
    --------
    >>> length((3, 4)).steps[-1].formula.parts
    ('|v| = √(3² + 4²) = √(9 + 16) = √25 = 5',)
    """
    step, value = _length(v, name, by)
    return Working((*given([(name, v)], by), step), value)


def _length(v: Vector, name: str, by: Notation) -> tuple[Step, Entry]:
    squares = [by.tidy(x * x) for x in v]
    square = by.sum(squares)
    value = by.root(square)
    texts = (
        f"√({' + '.join(squared(by.write(x)) for x in v)})",
        f"√({added(map(by.write, squares))})",
        _under_root(by.write(square)),
        by.write(value),
    )
    proved = by.same(by.tidy(value * value), square)
    line = chain(f"|{name}|", texts)
    return Step(Formula((line,)), "the root of the sum of the squares", bool(proved)), value


def _under_root(text: str) -> str:
    return f"√{text}" if text.isdigit() else f"√({text})"


def normalize(v: Vector, name: str = "v", result: str = "", by: Notation = EXACT) -> Working:
    """Divide a vector by its length; the last line finds the length of what comes out.

    Raises
    ------
    NoAnswerError
        For the zero vector.

    Examples
    --------
    >>> [str(x) for x in normalize((3, 4)).value]
    ['3/5', '4/5']
    """
    result = result or f"{name}′"
    found = unit(v, name, result, by)
    norm, value = _length(found.value, result, by)
    check = Step(norm.formula, "the check: its length is 1", bool(by.same(value, ONE)))
    return Working((*given([(name, v)], by), *found.steps, check), found.value)


def unit(v: Vector, name: str, result: str, by: Notation = EXACT) -> Working:
    """Divide a vector, which was written down before, by its length: two lines.

    Raises
    ------
    NoAnswerError
        For the zero vector.

    Examples
    --------
    >>> [step.formula.parts[0] for step in unit((0, -2), "a", "n").steps]
    ['|a| = √(0² + (−2)²) = √(0 + 4) = √4 = 2', 'n = a / |a| = 1/2 · ']
    """
    if all(map(by.is_zero, v)):
        raise NoAnswerError(
            f"a direction of {name} (0)", "the zero vector has none", "give another vector"
        )
    first, size = _length(v, name, by)
    value = by.scaled(v, ONE / size)
    proved = by.same(by.scaled(value, size), tuple(v))
    head, about = f"{result} = {name} / |{name}| = ", "divided by its length"
    if by.same(size, ONE):
        return Working((first, by.step(head, v, because=about, proved=proved)), tuple(v))
    head += f"{by.factor(by.tidy(ONE / size), is_first=True)} · "
    over = by.step(head, v, " = ", value, because=about, proved=proved)
    return Working((first, over), value)


def cross(
    a: Vector,
    b: Vector,
    names: tuple[str, str] = ("a", "b"),
    result: str = "",
    by: Notation = EXACT,
) -> Working:
    """Multiply two vectors of space; the last lines check that both are perpendicular to it.

    Raises
    ------
    IllegalValueError
        For vectors that do not have three components.

    Examples
    --------
    >>> [int(x) for x in cross((1, 0, 0), (0, 1, 0)).value]
    [0, 0, 1]
    """
    if (len(a), len(b)) != (3, 3):
        raise IllegalValueError(
            f"a cross product of {len(a)} and {len(b)} components",
            "it is for vectors of space",
            "give three of each",
        )
    found = crossed(a, b, names, result, by)
    letter = result or f"({names[0]} × {names[1]})"
    checks = []
    for name, v in zip(names, (a, b), strict=True):
        texts, value = sum_of([(1, pair) for pair in zip(v, found.value, strict=True)], by)
        about = f"the check: it is perpendicular to {name}"
        checks.append(
            Step(Formula((chain(f"{name} · {letter}", texts),)), about, bool(by.is_zero(value)))
        )
    return Working(
        (*given(tuple(zip(names, (a, b), strict=True)), by), *found.steps, *checks), found.value
    )


def crossed(
    a: Vector, b: Vector, names: tuple[str, str], result: str = "", by: Notation = EXACT
) -> Working:
    """Multiply two vectors that were written down before: the differences, and their values."""
    head = f"{result} = {names[0]} × {names[1]}" if result else f"{names[0]} × {names[1]}"
    cells, value = [], []
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        texts, entry = sum_of([(1, (a[j], b[k])), (-1, (a[k], b[j]))], by)
        cells.append((texts[0],))
        value.append((entry,))
    v = tuple(entry for (entry,) in value)
    proved = by.is_zero(by.dot(a, v)) and by.is_zero(by.dot(b, v))
    about = "each component of the two others, crosswise"
    proof = Proof(by, result or "r", "the differences", "component {row}", bool(proved))
    name = head if fits(f"{head} = ", cells) else result or "r"
    return Working(tuple(cells_or_entries(name, cells, value, about, proof)), v)


def angle(
    a: Vector, b: Vector, names: tuple[str, str] = ("a", "b"), by: Notation = EXACT
) -> Working:
    """Find the angle between two vectors, in degrees, from their dot product and their lengths.

    Raises
    ------
    NoAnswerError
        For the zero vector.

    Examples
    --------
    >>> angle((1, 0), (1, 1)).steps[-1].formula.parts
    ('θ = arccos(√2/2) = 45°',)
    """
    for name, v in zip(names, (a, b), strict=True):
        if all(map(by.is_zero, v)):
            raise NoAnswerError(
                f"an angle with {name} (0)",
                "the zero vector has no direction",
                "give another vector",
            )
    above = dot(a, b, names, by)
    first, one = _length(a, names[0], by)
    second, other = _length(b, names[1], by)
    below = by.tidy(one * other)
    value = by.tidy(above.value * (ONE / below))
    top, bottom = by.write(above.value), f"({by.factor(one, is_first=True)}·{by.factor(other)})"
    texts = (
        f"({names[0]} · {names[1]}) / (|{names[0]}| |{names[1]}|)",
        f"{top if top.lstrip('−').isdigit() else f'({top})'}/{bottom}",
        by.write(value),
    )
    proved = by.same(by.tidy(value * below), above.value)
    cosine = Step(
        Formula((chain("cos θ", texts),)), "the dot product over the lengths", bool(proved)
    )
    degrees = _degrees(value)
    sign = "=" if _is_whole_angle(value, degrees) else "≈"
    last = Step(
        Formula((f"θ = arccos({by.write(value)}) {sign} {decimal(degrees)}°",)),
        "the angle of this cosine",
        bool(abs(Angle.degrees(degrees).cosine - middle(value)) < KNOWN),
    )
    return Working((*above.steps, first, second, cosine, last), degrees)


def _degrees(cosine: Entry) -> Fraction:
    """Find the angle from 0 to 180° of a cosine, to some 130 bits."""
    c = middle(cosine)
    if c <= -1:
        return Fraction(180)
    below = (1 - c) / (1 + c)
    half = below * inverse_root(below) if below > 0 else below  # tan(θ/2)
    return 2 * arctangent(half) * DEGREES if half > 0 else Fraction(0)


def _is_whole_angle(cosine: Entry, degrees: Fraction) -> bool:
    """Tell if an angle is a multiple of 3°, exactly, as its cosine says."""
    whole = Fraction(round(degrees))
    return bool(sine(90 - whole) == cosine)


def project(
    P: Matrix,
    point: Vector,
    names: tuple[str, str] = ("P", "p"),
    by: Notation = EXACT,
) -> Working:
    """Take a point through a projection and divide by w; the last line multiplies by w again.

    A point of three components gets w = 1.

    Raises
    ------
    NoAnswerError
        If w is 0: the point is seen nowhere.

    Examples
    --------
    >>> P = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, -1, -2), (0, 0, -1, 0))
    >>> [str(x) for x in project(P, (1, 0, -4)).value]
    ['1/4', '0', '1/2']
    """
    p = tuple(point) if len(point) == 4 else (*point, ONE)
    name = names[1]
    clip = product(P, p, names, "c", by)
    c, w = clip.value[:3], clip.value[3]
    if by.is_zero(w):
        raise NoAnswerError(
            f"a projection of {name} (w = 0)",
            "it lies in the plane of the eye, so nothing can be divided",
            "move the point",
        )
    value = by.scaled(c, ONE / w)
    back = by.scaled(value, w)
    read = by.step(f"w = c{lowered(4)} = {by.write(w)}", because="the fourth number", proved=True)
    ndc = by.step(
        f"n = 1/w · (x, y, z) = {by.factor(by.tidy(ONE / w), is_first=True)} · ",
        c,
        " = ",
        value,
        because="divided by w: normalised device coordinates",
        proved=by.same(back, tuple(c)),
    )
    check = by.step(
        f"w n = {by.factor(w, is_first=True)} · ",
        value,
        " = ",
        back,
        because="the check: times w they are the clip coordinates again",
        proved=by.same(back, tuple(c)),
    )
    return Working((*clip.steps, read, ndc, check), value)
