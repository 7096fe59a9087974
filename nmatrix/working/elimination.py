"""Row operations, one to a line: rank, reduced echelon form, linear systems and null spaces."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from fractions import Fraction

from nmatrix.errors import NoAnswerError
from nmatrix.report import Formula, Step
from nmatrix.typed import BAR
from nmatrix.working.working import (
    EXACT,
    ONE,
    Entry,
    Matrix,
    Notation,
    Vector,
    Working,
    is_sum,
    lowered,
    transposed,
)


@dataclass
class Elimination:
    """A matrix under row operations; `bar` columns stand before its vertical line, if it has one.

    Each operation writes one line, and is checked by undoing it.
    """

    rows: list[Vector]
    by: Notation = EXACT
    bar: int = 0
    steps: list[Step] = field(default_factory=list)
    pivots: list[tuple[int, int]] = field(default_factory=list)
    swaps: int = 0

    def shown(self) -> tuple[tuple[str, ...], ...]:
        """Write the matrix, with its bar."""
        rows = self.by.rows(self.rows)
        if not self.bar:
            return rows
        return tuple((*row[: self.bar], BAR, *row[self.bar :]) for row in rows)

    def begin(self, because: str, name: str = "") -> None:
        """Write down the matrix that the operations start from."""
        parts = (f"{name} = ", self.shown()) if name else (self.shown(),)
        self.steps.append(Step(Formula(parts), because, verified=True))

    def to_echelon(self, columns: int, *, reduced: bool) -> None:
        """Clear each column below its pivot; reduced, make pivots 1 and clear above them too."""
        for column in range(columns):
            place = len(self.pivots)
            if place == len(self.rows):
                break
            pivot = self._pivot(column, place)
            if pivot is None:
                continue
            if pivot != place:
                self._swap(place, pivot)
            self.pivots.append((place, column))
            if reduced:
                self._make_one(place, column)
            for row in range(0 if reduced else place + 1, len(self.rows)):
                if row != place and not self.by.is_zero(self.rows[row][column]):
                    self._clear(row, place, column)

    def _pivot(self, column: int, place: int) -> int | None:
        """Find a row with a 1 in the column, else the first that is not 0 there."""
        usable = [
            i for i in range(place, len(self.rows)) if not self.by.is_zero(self.rows[i][column])
        ]
        ones = (i for i in usable if self.by.same(self.rows[i][column], ONE))
        first = usable[0] if usable else None
        return next(ones, first) if first != place else place

    def _swap(self, one: int, other: int) -> None:
        self.rows[one], self.rows[other] = self.rows[other], self.rows[one]
        self.swaps += 1
        words = f"{_row(one)} ↔ {_row(other)}"
        self._write(words, "the pivot must not be 0: two rows change places", proved=True)

    def _make_one(self, place: int, column: int) -> None:
        before = self.rows[place]
        pivot = before[column]
        if self.by.same(pivot, ONE):
            return
        by = ONE / pivot
        self.rows[place] = self.by.scaled(before, by)
        proved = self.by.same(self.by.scaled(self.rows[place], pivot), before)
        words = f"{_row(place)} ← {self._coefficient(by)}{_row(place)}"
        self._write(words, f"the pivot of row {place + 1} becomes 1", proved=proved)

    def _clear(self, row: int, place: int, column: int) -> None:
        before, head = self.rows[row], self.rows[place]
        by = self.by.tidy(before[column] * (ONE / head[column]))
        self.rows[row] = tuple(self.by.tidy(a - by * b) for a, b in zip(before, head, strict=True))
        back = [a + by * b for a, b in zip(self.rows[row], head, strict=True)]
        proved = self.by.same(list(map(self.by.tidy, back)), before)
        text = self.by.write(by)
        sign, size = (" + ", -by) if text.startswith("−") and not is_sum(text) else (" − ", by)
        words = f"{_row(row)} ← {_row(row)}{sign}{self._coefficient(size)}{_row(place)}"
        about = f"row {row + 1} gets 0 below the pivot of row {place + 1}"
        if row < place:
            about = about.replace("below", "above")
        self._write(words, about, proved=proved)

    def _coefficient(self, value: Entry) -> str:
        text = self.by.write(value)
        if text in ("1", "−1"):
            return text[:-1]
        return f"({text}) " if is_sum(text) else f"{text} "

    def _write(self, words: str, because: str, *, proved: bool) -> None:
        self.steps.append(Step(Formula((f"{words}  ⇒  ", self.shown())), because, bool(proved)))


def _row(place: int) -> str:
    return f"R{lowered(place + 1)}"


def rank(A: Matrix, name: str = "A", by: Notation = EXACT) -> Working:
    """Count the independent rows: those with a pivot in the echelon form.

    Examples
    --------
    >>> rank(((1, 2), (2, 4))).value
    1
    """
    work = _started(A, name, by, "row operations keep the rank")
    work.to_echelon(len(A[0]), reduced=False)
    found = len(work.pivots)
    other = _started(transposed(A), name, by, "")
    other.to_echelon(len(A), reduced=False)
    last = by.step(
        f"rank {name} = {found}",
        because="as many rows have a pivot",
        proved=len(other.pivots) == found,
    )
    return Working((*work.steps, last), found)


def rref(A: Matrix, name: str = "A", by: Notation = EXACT) -> Working:
    """Bring a matrix to its reduced echelon form, in which pivots are 1 and alone in their columns.

    Examples
    --------
    >>> [[int(x) for x in row] for row in rref(((2, 4), (1, 3))).value]
    [[1, 0], [0, 1]]
    """
    work = _started(A, name, by, "row operations follow")
    work.to_echelon(len(A[0]), reduced=True)
    last = by.step(
        f"rref {name} = ",
        work.rows,
        because="every pivot is 1 and alone in its column",
        proved=_is_reduced(work),
    )
    return Working((*work.steps, last), tuple(work.rows))


def solve(
    A: Matrix, b: Vector, names: tuple[str, str, str] = ("A", "b", "x"), by: Notation = EXACT
) -> Working:
    """Solve A x = b.

    Raises
    ------
    NoAnswerError
        If there is no solution, or more than one.

    Examples
    --------
    >>> [int(x) for x in solve(((0, 2), (1, 1)), (4, 5)).value]
    [3, 2]
    """
    n = len(A[0])
    name, right, unknown = names
    rows: list[Vector] = [(*row, entry) for row, entry in zip(A, b, strict=True)]
    work = Elimination(rows, by, n)
    work.begin(f"{name} on the left, {right} on the right of the bar")
    work.to_echelon(n, reduced=True)
    found = len(work.pivots)
    if not all(by.is_zero(row[n]) for row in work.rows[found:]):
        raise NoAnswerError(
            "a system without a solution", "a row says that 0 is another number", "check its rows"
        )
    if found < n:
        raise NoAnswerError(
            "a system with many solutions",
            f"{n} unknowns, and {found} of its rows are independent",
            "ask for the null space",
        )
    value = tuple(row[n] for row in work.rows[:n])
    image = by.apply(A, value)
    read = by.step(f"{unknown} = ", value, because="the column behind the bar", proved=True)
    check = by.step(
        f"{name} · {unknown} = ",
        image,
        f" = {right}",
        because="the check: the solution put in",
        proved=by.same(image, tuple(b)),
    )
    return Working((*work.steps, read, check), value)


def null_space(A: Matrix, name: str = "A", by: Notation = EXACT) -> Working:
    """Find vectors that span all that a matrix takes to 0; none, where it takes only 0 there.

    Examples
    --------
    >>> [[int(x) for x in v] for v in null_space(((1, 2), (2, 4))).value]
    [[-2, 1]]
    """
    n = len(A[0])
    reduced = rref(A, name, by)
    work = _started(A, name, by, "")
    work.to_echelon(n, reduced=True)
    leading = {column: row for row, column in work.pivots}
    free = [column for column in range(n) if column not in leading]
    steps = list(reduced.steps)
    if not free:
        about = "every column has a pivot, so only 0 is taken to 0"
        steps.append(by.step(f"{name} v = 0  ⇒  v = 0", because=about, proved=not free))
        return Working(tuple(steps), ())
    found = []
    for count, column in enumerate(free, 1):
        v = tuple(
            -work.rows[leading[i]][column] if i in leading else Fraction(int(i == column))
            for i in range(n)
        )
        image = by.apply(A, v)
        letter = f"v{lowered(count)}" if len(free) > 1 else "v"
        because = f"column {column + 1} has no pivot: its unknown is 1, other such unknowns are 0"
        proved = all(map(by.is_zero, image))
        steps.append(by.step(f"{letter} = ", v, because=because, proved=proved))
        shown = by.step(
            f"{name} · {letter} = ", image, because="the check: it is taken to 0", proved=proved
        )
        steps.append(shown)
        found.append(v)
    return Working(tuple(steps), tuple(found))


def _started(A: Matrix, name: str, by: Notation, because: str) -> Elimination:
    rows: list[Vector] = [tuple(row) for row in A]
    work = Elimination(rows, by)
    work.begin(because, name)
    return work


def _is_reduced(work: Elimination) -> bool:
    return all(
        work.by.same(row[column], Fraction(int(i == place)))
        for place, column in work.pivots
        for i, row in enumerate(work.rows)
    ) and all(work.by.is_zero(entry) for row in work.rows[len(work.pivots) :] for entry in row)


def identity_beside(A: Matrix, unit: Matrix, name: str, by: Notation) -> Elimination:
    """Write [A | I], and begin the operations that turn A into I."""
    rows: Sequence[Vector] = [(*row, *ones) for row, ones in zip(A, unit, strict=True)]
    work = Elimination(list(rows), by, len(A))
    work.begin(f"{name} on the left, I on the right of the bar")
    return work
