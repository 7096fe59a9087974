"""How the entries of a calculation are written down, combined, and compared.

An entry is a fraction or a sum of roots, or any other thing that is added and multiplied: then a
`Notation` says how it is written, and when two of it are the same.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from nmatrix.linear import rational
from nmatrix.linear.rounding import inverse_root, nearest, short_text
from nmatrix.report import Formula, Step
from nmatrix.surds import Surd, TooManyRootsError, is_short, root, short_number
from nmatrix.typed import LOWERED, RAISED, columns_of

Entry = Any  # it has + − · /, and nothing else is asked of it
Vector = Sequence[Entry]
Matrix = Sequence[Sequence[Entry]]
Part = str | Sequence[Entry] | Matrix

ONE = Fraction(1)
COLUMNS = 78  # of a line: an indentation by two leaves eighty
DIGITS = 6  # of a number that is no short fraction or root
LARGEST, WIDEST = 10**8, 16  # of the whole numbers in a sum of roots; of its characters
KNOWN = Fraction(1, 2**90)  # how far apart two numbers may be that are known to 130 bits
_ROOT = re.compile(r"sqrt\((\d+)\)")
_INDEX = re.compile(r"_(\d)")
_ZEROS = re.compile(r"(/|(?<!\d))(\d*?[1-9])(0{15,})(?!\d)")
_LOWERED = str.maketrans("0123456789", LOWERED)
_RAISED = str.maketrans("0123456789", RAISED[:10])


def written(value: object) -> str:
    """Write a number or an expression: √3/2, s₁ for s_1, 10²⁰ for a one with twenty zeros.

    Examples
    --------
    >>> written(Fraction(-1, 2)), written(Fraction(3)), written(10**20)
    ('−1/2', '3', '10²⁰')
    """
    text = _ZEROS.sub(_power_of_ten, _ROOT.sub(r"√\1", str(value)))
    return (
        _INDEX.sub(lambda found: lowered(found[1]), text)
        .replace("**2", "²")
        .replace("**3", "³")
        .replace("**", "^")
        .replace("*", "·")
        .replace("sqrt", "√")
        .replace("-", "−")
        .replace("kappa", "κ")
        .replace("_", "")
    )


def _power_of_ten(number: re.Match[str]) -> str:
    slash, factor, zeros = number.groups()
    power = f"10{str(len(zeros)).translate(_RAISED)}"
    if factor == "1":
        return slash + power
    return f"/({factor}*{power})" if slash else f"{factor}*{power}"


def short(value: object, digits: int = DIGITS) -> str:
    """Write a short fraction or root as it is, and any other number in so many digits.

    Examples
    --------
    >>> short(Fraction(-1, 2)), short(Fraction(2, 3 * 10**13 + 1)), short(Fraction(10) ** 400)
    ('−1/2', '6.66667·10⁻¹⁴', '10⁴⁰⁰')
    """
    if isinstance(value, Fraction | Surd) and not _reads_well(value):
        return decimal(value, digits)
    return written(value)


def _reads_well(value: Fraction | Surd) -> bool:
    """Tell whether a number is exact and short enough for an entry of a matrix."""
    if is_short(value):
        return True
    small = isinstance(value, Surd) and all(
        max(abs(q.numerator), q.denominator, d) < LARGEST for d, q in value.terms
    )
    return small and len(str(value)) <= WIDEST


def decimal(value: Fraction | Surd, digits: int = DIGITS) -> str:
    """Write a number in so many digits, with a power of ten where it needs one.

    Examples
    --------
    >>> decimal(Fraction(2, 3)), decimal(Fraction(-3, 10**8))
    ('0.666667', '−3·10⁻⁸')
    """
    text = short_text(middle(value), digits).replace("-", "−")
    mantissa, mark, exponent = text.partition("e")
    if not mark:
        return text
    power = f"10{str(int(exponent.replace('−', '-'))).replace('-', '⁻').translate(_RAISED)}"
    return mantissa.replace("1", power) if mantissa in ("1", "−1") else f"{mantissa}·{power}"


def middle(value: int | Fraction | Surd) -> Fraction:
    """Find the fraction in the middle of what is known of a number.

    Examples
    --------
    >>> float(middle(root(2))), middle(3)
    (1.4142135623730951, Fraction(3, 1))
    """
    if isinstance(value, Surd):
        low, high = value.between()
        return (low + high) / 2
    return Fraction(value)


def as_typed(value: float | Fraction) -> Fraction:
    """Find the short fraction that a float was meant to be, or keep the one that it is.

    Examples
    --------
    >>> print(as_typed(0.1), as_typed(1 / 3), as_typed(Fraction(2, 7)))
    1/10 1/3 2/7
    """
    found = stands_for(value)
    return found if isinstance(found, Fraction) else Fraction(value)


def stands_for(value: float | Fraction) -> Entry:
    """Find the short number, perhaps a root, that an entry of a matrix was meant to be.

    Examples
    --------
    >>> print(stands_for(0.1), stands_for(3**0.5 / 2), stands_for(Fraction(1, 3)))
    1/10 √3/2 1/3
    """
    exact = Fraction(value)
    if is_short(exact) or Fraction(nearest(exact)) != exact:
        return exact
    found = short_number(float(exact))
    return exact if found is None else found


def lowered(*numbers: object) -> str:
    """Write the places of an entry below its letter.

    Examples
    --------
    >>> f"C{lowered(1, 2)}"
    'C₁₂'
    """
    return "".join(map(str, numbers)).translate(_LOWERED)


def is_sum(text: str) -> bool:
    """Recognise a sum, whose signs are in no parentheses and over no denominator.

    Examples
    --------
    >>> is_sum("1 − √2"), is_sum("(1 − √2)/3"), is_sum("−2")
    (True, False, False)
    """
    depth = 0
    for place, mark in enumerate(text):
        depth += (mark == "(") - (mark == ")")
        if depth == 0 and place and mark in "+−" and text[place - 1] == " ":
            return True
    return False


def factor(text: str, *, is_first: bool = False) -> str:
    """Put parentheses around what is no factor by itself; a first one may have its minus.

    Examples
    --------
    >>> factor("−2"), factor("−2", is_first=True), factor("1 + √2"), factor("√3/2")
    ('(−2)', '−2', '(1 + √2)', '√3/2')
    """
    return f"({text})" if is_sum(text) or (text.startswith("−") and not is_first) else text


def squared(text: str) -> str:
    """Write a square.

    Examples
    --------
    >>> squared("3"), squared("−1/2")
    ('3²', '(−1/2)²')
    """
    return f"{text}²" if text.replace(".", "").isdigit() else f"({text})²"


def chain(head: str, texts: Sequence[str]) -> str:
    """Write `head = text = text`, and nothing twice.

    Examples
    --------
    >>> chain("a · b", ["2·4 + 0·1", "8", "8"])
    'a · b = 2·4 + 0·1 = 8'
    """
    return " = ".join((head, *without_repeats(texts)))


def without_repeats(texts: Sequence[str]) -> list[str]:
    """Leave out what says the same as the text before it."""
    return [text for i, text in enumerate(texts) if i == 0 or text != texts[i - 1]]


def lines(head: str, texts: Sequence[str], reasons: Sequence[str], *, proved: bool) -> list[Step]:
    """Write equal expressions on one line, or each on its own where they find no room together."""
    whole = chain(head, texts)
    if fits(whole):
        return [Step(Formula((whole,)), reasons[0], bool(proved))]
    return [
        Step(Formula((f"{head} = {text}",)), because, bool(proved))
        for text, because in zip(without_repeats(texts), reasons, strict=False)
    ]


def added(texts: Iterable[str]) -> str:
    """Write a sum; a term with a minus is subtracted.

    Examples
    --------
    >>> added(["1", "−2", "1 − √2"])
    '1 − 2 + (1 − √2)'
    """
    first, *others = texts
    return first + "".join(map(_added, others))


def _added(text: str) -> str:
    if is_sum(text):
        return f" + ({text})"
    return f" − {text[1:]}" if text.startswith("−") else f" + {text}"


def _equals_zero(value: Entry) -> bool:
    return bool(value == 0)


def _as_it_is(value: Entry) -> Entry:
    return value


def exact_root(square: Entry) -> Fraction | Surd:
    """Take a square root that is a number times one root.

    Raises
    ------
    TooManyRootsError
        For the root of a sum of roots, and where nobody knows the square factors.

    Examples
    --------
    >>> print(exact_root(Fraction(3, 4)))
    √3/2
    """
    if isinstance(square, Surd):
        raise TooManyRootsError("the root of a sum of roots")
    return root(square)


@dataclass(frozen=True)
class Notation:
    """How entries are written, and what is known of them.

    Parameters
    ----------
    write
        Writes an entry as one does in a formula.
    is_zero
        Decides if an entry is 0: it chooses pivots, and leaves out terms.
    tidy
        Simplifies the result of each operation.
    root
        Takes a square root.
    agree
        Decides if two entries are the same number; if their difference is 0, unless it is given.
    spells_out
        Whether minors and sums are written with their terms; terms in letters may fill pages.
    """

    write: Callable[[Entry], str] = written
    is_zero: Callable[[Entry], bool] = _equals_zero
    tidy: Callable[[Entry], Entry] = _as_it_is
    root: Callable[[Entry], Entry] = exact_root
    agree: Callable[[Entry, Entry], bool] | None = None
    spells_out: bool = True

    def same(self, a: Entry, b: Entry) -> bool:
        """Decide if two entries, vectors or matrices are the same."""
        if isinstance(a, Sequence):
            return len(a) == len(b) and all(map(self.same, a, b))
        return self.is_zero(self.tidy(a - b)) if self.agree is None else self.agree(a, b)

    def sum(self, terms: Iterable[Entry]) -> Entry:
        """Add some entries; none are 0."""
        first, *others = terms
        for one in others:
            first = first + one
        return self.tidy(first)

    def dot(self, a: Vector, b: Vector) -> Entry:
        """Compute a · b."""
        return self.sum(x * y for x, y in zip(a, b, strict=True))

    def product(self, A: Matrix, B: Matrix) -> Matrix:
        """Multiply two matrices."""
        columns = tuple(zip(*B, strict=True))
        return tuple(tuple(self.dot(row, column) for column in columns) for row in A)

    def apply(self, A: Matrix, v: Vector) -> Vector:
        """Compute A v."""
        return tuple(self.dot(row, v) for row in A)

    def determinant(self, A: Matrix) -> Entry:
        """Compute det A, by the function that computes with fractions."""
        return self.tidy(rational.determinant(tuple(map(tuple, A))))

    def scaled(self, v: Vector, by: Entry) -> Vector:
        """Multiply every component of a vector."""
        return tuple(self.tidy(x * by) for x in v)

    def is_identity(self, A: Matrix) -> bool:
        """Recognise I."""
        return self.same(A, identity(len(A)))

    def rows(self, value: Sequence[Entry] | Matrix) -> tuple[tuple[str, ...], ...]:
        """Write a matrix, or a vector as one column."""
        rows = value if is_matrix(value) else [(x,) for x in value]
        return tuple(tuple(map(self.write, row)) for row in rows)

    def factor(self, value: Entry, *, is_first: bool = False) -> str:
        """Write a factor of a product."""
        return factor(self.write(value), is_first=is_first)

    def products(self, pairs: Iterable[tuple[Entry, Entry]]) -> str:
        """Write a sum of products, `2·1 + 0·3`.

        Examples
        --------
        >>> Notation().products([(2, 1), (-1, -3)])
        '2·1 + (−1)·(−3)'
        """
        return " + ".join(
            f"{self.factor(a, is_first=not i)}·{self.factor(b)}" for i, (a, b) in enumerate(pairs)
        )

    def added(self, values: Iterable[Entry]) -> str:
        """Write a sum of numbers, `2 − 3`."""
        return added(map(self.write, values))

    def formula(self, *parts: Part) -> Formula:
        """Put words, vectors and matrices side by side."""
        return Formula(tuple(one if isinstance(one, str) else self.rows(one) for one in parts))

    def step(self, *parts: Part, because: str, proved: bool) -> Step:
        """Write one line."""
        return Step(self.formula(*parts), because, bool(proved))


def _near_root(square: Entry) -> Fraction:
    exact = middle(square)
    return exact * inverse_root(exact) if exact else exact


def _are_near(a: Entry, b: Entry) -> bool:
    one, other = middle(a), middle(b)
    size = max(abs(one), abs(other)) if one and other else ONE
    return abs(one - other) <= KNOWN * size


EXACT = Notation()
SHORT = Notation(short)  # as exact, but long numbers are shown in six digits
NEAR = Notation(short, root=_near_root, agree=_are_near)  # of numbers that are known to 130 bits


@dataclass(frozen=True)
class Working:
    """The lines of a calculation, and the number, vector or matrix that it ends in."""

    steps: tuple[Step, ...]
    value: Any


def exactly_or_near(make: Callable[[Notation], Working]) -> Working:
    """Work something out with roots if they can be written down, else with numbers of 130 bits.

    Examples
    --------
    >>> exactly_or_near(lambda by: Working((), by is SHORT)).value
    True
    """
    try:
        return make(SHORT)
    except TooManyRootsError:
        return make(NEAR)


def formulas(working: Working) -> tuple[Formula, ...]:
    """Take the lines of a calculation without their reasons.

    Examples
    --------
    >>> line = EXACT.step("1 + 1 = 2", because="the sum", proved=True)
    >>> formulas(Working((line,), 2))[0].parts
    ('1 + 1 = 2',)
    """
    return tuple(step.formula for step in working.steps)


def is_matrix(value: Sequence[Any]) -> bool:
    """Tell a matrix from a vector."""
    return not isinstance(value[0], str) and isinstance(value[0], Sequence)


def identity(n: int) -> Matrix:
    """Build I."""
    return tuple(tuple(Fraction(int(i == j)) for j in range(n)) for i in range(n))


def transposed(A: Matrix) -> Matrix:
    """Exchange rows and columns."""
    return tuple(zip(*A, strict=True))


def without(A: Matrix, row: int, column: int) -> Matrix:
    """Leave out a row and a column."""
    return tuple((*r[:column], *r[column + 1 :]) for i, r in enumerate(A) if i != row)


def fits(*parts: str | Sequence[Sequence[str]]) -> bool:
    """Tell whether parts find room side by side on one line."""
    return columns_of([p if isinstance(p, str) else tuple(map(tuple, p)) for p in parts]) <= COLUMNS


def raised(name: str, exponent: str) -> str:
    """Write a power or a transpose of what has a name.

    Examples
    --------
    >>> raised("A", "⁻¹"), raised("R · S", "ᵀ")
    ('A⁻¹', '(R · S)ᵀ')
    """
    return f"({name}){exponent}" if " " in name else f"{name}{exponent}"


def in_one_line(first: Step, second: Step, because: str) -> Step:
    """Write two steps on one line: one that goes on with another value, or two statements.

    Examples
    --------
    >>> sum_ = EXACT.step("v = ", (3,), because="the sum", proved=True)
    >>> in_one_line(Step(Formula(("v = ", (("1 + 2",),))), "", True), sum_, "added").formula.parts
    ('v = ', (('1 + 2',),), ' = ', (('3',),))
    """
    (head, *parts), (other, *more) = first.formula.parts, second.formula.parts
    if str(head).startswith(str(other)):
        joined = Formula((head, *parts, " = ", *more))
    else:
        joined = Formula((f"{head},  {other}", *more))
    return Step(joined, because, first.verified and second.verified)


def cells_or_entries(
    name: str, cells: Sequence[Sequence[str]], value: Matrix, because: str, proof: Proof
) -> list[Step]:
    """Write a matrix of expressions and then its numbers; what finds no room, entry by entry."""
    by = proof.by
    shown = tuple(map(tuple, cells))
    last = by.step(f"{name} = ", value, because=proof.because, proved=proof.proved)
    if fits(f"{name} = ", shown):
        first = Step(Formula((f"{name} = ", shown)), because, proof.proved)
        return [first, last]
    steps = []
    is_column = len(value[0]) == 1
    for i, row in enumerate(shown, 1):
        for j, text in enumerate(row, 1):
            entry = f"{proof.letter}{lowered(i) if is_column else lowered(i, j)}"
            result = by.write(value[i - 1][j - 1])
            chain = f"{entry} = {text}" if text == result else f"{entry} = {text} = {result}"
            about = proof.about.format(row=i, column=j)
            steps.append(Step(Formula((chain,)), about, proof.proved))
    return [*steps, last]


@dataclass(frozen=True)
class Proof:
    """What is said of the entries of a matrix that is written down, and whether it was proved.

    `because` is for the numbers, `about` for one entry of {row} and {column}, `letter` its name.
    """

    by: Notation
    letter: str
    because: str
    about: str
    proved: bool
