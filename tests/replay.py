"""Reads printed steps as a person does, and computes each line again from the lines before it.

It knows nothing of the code that printed them: text goes in, brackets are found by their columns,
and every value is made here, of fractions, or of floats where a root is printed.
"""

from __future__ import annotations

import re
from fractions import Fraction
from itertools import combinations, permutations
from math import acos, cos, degrees, isclose, radians, sin, sqrt, tan

LOWERED = "₀₁₂₃₄₅₆₇₈₉"
NEAR = 2e-5  # of a number that is printed in six digits
ROW_OPERATION = re.compile(
    r"R([₀-₉]) (?:← (?:(.*?) ?)R([₀-₉])(?: ([+−]) (?:(.*?) ?)R([₀-₉]))?|↔ R([₀-₉]))$"
)
_TOKEN = re.compile(
    r"\d+(?:\.\d+)?|[A-Za-zθ][A-Za-z]*[₀-₉]*′?|[²³]|⁻¹|⁻ᵀ|ᵀ|10?[⁻⁰-⁹]+|[()|·×+−/√°,]|⟦\d+⟧|\S"
)


class UnknownError(Exception):
    """A name that no line before has given a value."""


def formulas(text: str) -> list[list]:
    """Find the formulas of a printed answer, each as words and matrices side by side."""
    found, lines = [], []
    for line in text.splitlines():
        if line.startswith("    ✓ "):
            found.append(_parts(lines))
            lines = []
        elif line.startswith("      ") and not lines:
            if any(mark in line for mark in "⎡⎢⎣"):
                lines.append(line)
        elif line.strip():
            lines.append(line)
    return found


def _parts(lines: list[str]) -> list:
    return _whole(_bands(lines))


def _whole(parts: list) -> list:
    """Put the pieces of a matrix together, which was cut between two columns."""
    found: list = []
    for part in parts:
        if isinstance(part, list) and part[0][0] == "…":
            while isinstance(found[-1], str):
                assert not found.pop().strip()
            assert all(row[-1] == "…" for row in found[-1])
            found[-1] = [row[:-1] + more[1:] for row, more in zip(found[-1], part, strict=True)]
        else:
            found.append(part)
    return found


def _bands(lines: list[str]) -> list:
    parts: list = []
    while lines:
        first = lines[0]
        height = 1
        if "⎡" in first:
            column = first.index("⎡")
            height = next(i for i, line in enumerate(lines) if line[column : column + 1] == "⎣") + 1
        parts += _band(lines[:height])
        if isinstance(parts[-1], str) and parts[-1].rstrip().endswith(","):
            parts[-1] = parts[-1].rstrip() + "  "  # it goes on below, with another statement
        lines = lines[height:]
    return parts


def _band(lines: list[str]) -> list:
    """Cut a band at its matrices; the words stand on the middle line."""
    width = max(map(len, lines))
    lines = [line.ljust(width) for line in lines]
    words = lines[(len(lines) - 1) // 2]
    spans = []
    for i, line in enumerate(lines):
        for opening, closing in (("⎡", "⎤"), ("[", "]")):
            for start in (m.start() for m in re.finditer(re.escape(opening), line)):
                end = line.index(closing, start)
                rows = [line]
                if opening == "⎡":
                    last = next(j for j in range(i, len(lines)) if lines[j][start] == "⎣")
                    rows = lines[i : last + 1]
                cells = [re.split(r"\s{2,}", row[start + 1 : end].strip()) for row in rows]
                spans.append((start, end + 1, cells))
    parts, place = [], 0
    for start, end, cells in sorted(spans, key=lambda span: span[0]):
        parts += [words[place:start], cells]
        place = end
    return [*parts, words[place:]]


class Replay:
    """What has been read so far: the values of names, the last matrix, and the lines checked."""

    def __init__(self) -> None:
        self.values: dict = {}
        self.last = None
        self.factors: list | None = None
        self.checked = 0
        self.unchecked: list[str] = []

    def read(self, text: str) -> Replay:
        """Read and check a whole answer."""
        for parts in formulas(text):
            self._line(parts)
        return self

    def _line(self, parts: list) -> None:
        words = " ".join(part if isinstance(part, str) else "⟦⟧" for part in parts)
        before = self.checked
        if "v = 0  ⇒  v = 0" in words:
            assert rank(self.values["A"]) == len(self.values["A"][0])
            self.checked += 1
        elif "⇒" in words:
            operation = words.split("⇒")[0].strip()
            matrix = self._filled(next(part for part in parts if isinstance(part, list)))
            assert matrix == self._operated(operation), words
            self.checked += 1
            self.last = matrix
        elif len(parts) == 3 and not (parts[0] + parts[2]).strip():
            self._begun(parts[1])
        else:
            for statement in _split(parts, ",  "):
                self._statement(statement)
        if self.checked == before:
            self.unchecked.append(words)

    def _begun(self, cells: list) -> None:
        """Take what stands before a bar for A, and one column behind it for b."""
        bar = cells[0].index("│")
        self.last = self._filled(cells)
        self.values["A"] = [row[:bar] for row in self.last]
        if len(cells[0]) == bar + 2:
            self.values["b"] = [row[bar:] for row in self.last]
        self.checked += 1

    def _operated(self, text: str) -> list:
        """Apply a row operation to the matrix of the line before."""
        found = ROW_OPERATION.match(text)
        assert found, text
        target, factor, source, sign, other, second, swapped = found.groups()
        rows = [list(row) for row in self.last]
        i = LOWERED.index(target) - 1
        if swapped:
            j = LOWERED.index(swapped) - 1
            rows[i], rows[j] = rows[j], rows[i]
            return rows
        assert source == target
        rows[i] = [self._factor(factor) * x for x in rows[i]]
        if second:
            by = self._factor(other) * (1 if sign == "+" else -1)
            rows[i] = [
                x + by * y
                for x, y in zip(rows[i], self.last[LOWERED.index(second) - 1], strict=True)
            ]
        return rows

    def _factor(self, text: str | None) -> Fraction:
        if not text:
            return Fraction(1)
        return Fraction(-1) if text == "−" else self.value([text])

    def _filled(self, cells: list) -> list:
        rows = [[cell for cell in row if cell != "│"] for row in cells]
        return [[self.value([cell]) for cell in row] for row in rows]

    def _statement(self, parts: list) -> None:
        sides = [side for side in _split(parts, " = ", " ≈ ") if side]
        for side in sides:
            matrices = [part for part in side if isinstance(part, list)]
            if len(side) == 3 and len(matrices) == 2:
                self._operands(sides, side[1], [self._filled(one) for one in matrices])
        known = []
        for side in sides:
            try:
                known.append(self.value(side))
            except UnknownError:
                known.append(None)
            self._read_sums([part for part in side if isinstance(part, list)])
        values = [one for one in known if one is not None]
        if ["I"] in sides:
            n = len(values[0])
            values.append([[Fraction(int(i == j)) for j in range(n)] for i in range(n)])
        for one in values[1:]:
            assert same(one, values[0]), (sides, values)
        self.checked += len(values) > 1
        head = sides[0][0].strip() if len(sides[0]) == 1 and isinstance(sides[0][0], str) else ""
        is_read_off = len(sides) == 2 and len(values) == 1 and values[0] == self.last
        self.checked += is_read_off
        if values and len(sides) > 1 and re.fullmatch(r"[A-Za-zθ][A-Za-z]*[₀-₉]*′?", head):
            self._judge(head, sides[1], values[-1])
            self.values[head] = values[-1]
        if len(sides) == 1 and values:
            self.last = values[0]
        elif values and isinstance(values[-1], list):
            self.last = values[-1]

    def _operands(self, sides: list, sign: str, matrices: list) -> None:
        """Name the two sides of an operation, or hold them against what their names stand for."""
        if sign == "·":
            self.factors = matrices
        named = [side[0] for side in sides if len(side) == 1 and f" {sign} " in str(side[0])]
        for text in named[:1]:
            for name, matrix in zip(text.rsplit(f" {sign} ", 1), matrices, strict=True):
                try:
                    assert same(self.value([name]), matrix), name
                except UnknownError:
                    self.values[name] = matrix

    def _judge(self, head: str, side: list, value) -> None:
        """Compute what a letter stands for by itself, where it stands for something."""
        A = next((self.values[name] for name in ("B", "A") if name in self.values), None)
        indices = [LOWERED.index(mark) - 1 for mark in head if mark in LOWERED]
        if head == "D" and A:
            assert value == [[det(without(A, i, j)) for j in range(len(A))] for i in range(len(A))]
            self.checked += 1
        elif head == "C" and A:
            assert product(transposed(A), value) == [
                [det(A) if i == j else 0 for j in range(len(A))] for i in range(len(A))
            ]
            self.checked += 1
        elif head[0] == "D" and len(indices) == 2 and A:
            assert value == det(without(A, *indices))
            self.checked += 1
        elif len(indices) == 2 and isinstance(self.values.get(head[0]), list):
            entry = self.values[head[0]][indices[0]][indices[1]]
            assert same(value, entry), (head, value)
            row, column = self.factors[0][indices[0]], transposed(self.factors[1])[indices[1]]
            self._is_sum(side[0], row, column)
        elif head[0] == "M" and indices and A:
            left = A
            for i, j in zip(indices[::2], indices[1::2], strict=True):
                left = without(left, i, j)
            assert value == left
            self.checked += 1

    def _read_sums(self, matrices: list) -> None:
        """Hold each cell of a product against the row and the column that it is made of."""
        cells = matrices[0] if len(matrices) == 1 else []
        if not self.factors or not any("·" in cell for row in cells for cell in row):
            return
        left, right = self.factors
        if (len(cells), len(cells[0])) == (len(left), len(right[0])):
            for row, texts in zip(left, cells, strict=True):
                for column, text in zip(transposed(right), texts, strict=True):
                    self._is_sum(text, row, column)
        self.factors = None

    def _is_sum(self, text: str, row: list, column: list) -> None:
        """Compare the printed products with row times column; those with a 0 may be left out."""
        pairs = list(zip(row, column, strict=True))
        printed = [
            tuple(self.value([factor]) for factor in term.split("·"))
            for term in text.split(" + ")
            if text != "0"
        ]
        assert printed in (pairs, [pair for pair in pairs if 0 not in pair]), (text, pairs)

    def value(self, parts: list):
        """Compute an expression of words and matrices."""
        tokens: list = []
        for part in parts:
            if isinstance(part, str):
                tokens += [one for one in _TOKEN.findall(part) if one.strip()]
            else:
                tokens.append(self._filled(part))
        reader = _Expression(tokens, self.values)
        found = reader.sum()
        reader.rest[:] = [one for one in reader.rest if one != "°"]
        assert not reader.rest, reader.rest
        return found


class _Expression:
    """A sum of products; a minus may stand before the first factor only."""

    def __init__(self, tokens: list, values: dict) -> None:
        self.rest, self.values = tokens, values
        self.bars = 0  # that are open

    def _next(self, *marks: str) -> str | None:
        if self.rest and isinstance(self.rest[0], str) and self.rest[0] in marks:
            return self.rest.pop(0)
        return None

    def sum(self):
        """Read terms with + and − between them."""
        sign = -1 if self._next("−") else 1
        total = scaled(sign, self._product())
        while mark := self._next("+", "−"):
            total = plus(total, scaled(1 if mark == "+" else -1, self._product()))
        return total

    def _product(self):
        total = self._power()
        while self.rest:
            if self._next("·"):
                total = times(total, self._power())
            elif self._next("×"):
                total = cross(total, self._power())
            elif self._next("/"):
                total = scaled(1 / self._power(), total)
            elif self._ends():
                break
            else:
                total = times(total, self._power())
        return total

    def _ends(self) -> bool:
        mark = self.rest[0]
        return isinstance(mark, str) and (mark in tuple("+−),°") or (mark == "|" and self.bars > 0))

    def _power(self):
        base = self._atom()
        while mark := self._next("²", "ᵀ", "⁻¹", "⁻ᵀ"):
            if mark == "²":
                base = base * base
            elif mark == "ᵀ":
                base = transposed(base)
            else:
                base = inverse(base if mark == "⁻¹" else transposed(base))
        return base

    def _atom(self):
        if not self.rest:
            raise UnknownError
        token = self.rest.pop(0)
        if isinstance(token, list):
            return token
        if token == "(":
            inside = self.sum()
            while self._next(","):
                below = self.sum()
                inside = (inside if isinstance(inside, list) else [[inside]]) + [[below]]
            assert self._next(")"), self.rest
            return inside
        if token == "|":
            self.bars += 1
            inside = self.sum()
            self.bars -= 1
            assert self._next("|"), self.rest
            return sqrt(sum(x * x for (x,) in inside))
        if token[0].isdigit():
            number = float(token) if "." in token else Fraction(token)
            return number * root(self._power()) if self._next("√") else number
        return root(self._power()) if token == "√" else self._named(token)

    def _named(self, token: str):
        functions = {"det": det, "rank": rank}
        if token in functions:
            return functions[token](self._power())
        turns = {"cos": cos, "sin": sin, "tan": tan}
        if token in turns:
            if not self._next("("):
                raise UnknownError(token)
            inside = self.sum()
            assert self._next("°")
            assert self._next(")")
            return turns[token](radians(inside))
        if token == "arccos":
            inside = self._power()
            self.rest[:] = []
            return degrees(acos(max(-1.0, min(1.0, float(inside)))))
        if token in self.values:
            return self.values[token]
        whole = self.values.get(token[0])
        if len(token) == 2 and token[1] in LOWERED and isinstance(whole, list):
            return whole[LOWERED.index(token[1]) - 1][0]
        raise UnknownError(token)


def _split(parts: list, *marks: str) -> list[list]:
    """Cut a line at marks that stand in no parentheses."""
    groups: list[list] = [[]]
    pattern = "|".join(map(re.escape, marks))
    for part in parts:
        if not isinstance(part, str):
            groups[-1].append(part)
            continue
        pieces = re.split(pattern, f" {part} ")
        for i, piece in enumerate(pieces):
            if i:
                groups.append([])
            if piece.strip():
                groups[-1].append(piece.strip())
    return groups


def same(a, b) -> bool:
    """Compare numbers or matrices; exactly, unless a root or a decimal is in them."""
    if isinstance(a, list) or isinstance(b, list):
        return len(a) == len(b) and all(
            len(r) == len(s) and all(map(same, r, s)) for r, s in zip(a, b, strict=True)
        )
    if isinstance(a, float) or isinstance(b, float):
        return isclose(a, b, rel_tol=NEAR, abs_tol=NEAR)
    return a == b


def root(square):
    """Take a root; of a square of a fraction exactly."""
    value = sqrt(square)
    if isinstance(square, Fraction):
        near = Fraction(value).limit_denominator(10**6)
        return near if near * near == square else value
    return value


def plus(a, b):
    """Add numbers or matrices."""
    if isinstance(a, list):
        return [[x + y for x, y in zip(r, s, strict=True)] for r, s in zip(a, b, strict=True)]
    return a + b


def scaled(factor, a):
    """Multiply a number or a matrix by a number."""
    return [[factor * x for x in row] for row in a] if isinstance(a, list) else factor * a


def times(a, b):
    """Multiply numbers and matrices; two columns give their dot product."""
    if isinstance(a, list) and isinstance(b, list):
        if len(a[0]) == len(b):
            return product(a, b)
        return sum(x * y for (x,), (y,) in zip(a, b, strict=True))
    return scaled(b, a) if isinstance(a, list) else scaled(a, b)


def cross(a: list, b: list) -> list:
    """Multiply two columns of three crosswise."""
    (x,), (y,), (z,) = a
    (u,), (v,), (w,) = b
    return [[y * w - z * v], [z * u - x * w], [x * v - y * u]]


def product(a: list, b: list) -> list:
    """Multiply two matrices."""
    return [
        [sum(x * y for x, y in zip(row, column, strict=True)) for column in zip(*b, strict=True)]
        for row in a
    ]


def transposed(a: list) -> list:
    """Exchange rows and columns."""
    return [list(row) for row in zip(*a, strict=True)]


def without(a: list, i: int, j: int) -> list:
    """Leave out a row and a column."""
    return [row[:j] + row[j + 1 :] for k, row in enumerate(a) if k != i]


def det(a: list):
    """Add over all permutations, with their signs."""
    total = 0
    for order in permutations(range(len(a))):
        swaps = sum(p > q for i, p in enumerate(order) for q in order[i + 1 :])
        term = Fraction((-1) ** swaps)
        for i, j in enumerate(order):
            term = term * a[i][j]
        total += term
    return total


def inverse(a: list) -> list:
    """Divide the cofactors by the determinant."""
    n, d = len(a), det(a)
    if n == 1:
        return [[1 / d]]
    return [[(-1) ** (i + j) * det(without(a, j, i)) / d for j in range(n)] for i in range(n)]


def rank(a: list) -> int:
    """Find the size of the largest determinant that is not 0."""
    rows, columns = len(a), len(a[0])
    for size in range(min(rows, columns), 0, -1):
        for r in combinations(range(rows), size):
            for c in combinations(range(columns), size):
                if det([[a[i][j] for j in c] for i in r]):
                    return size
    return 0
