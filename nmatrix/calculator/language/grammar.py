"""The grammar of expressions: from the pieces of a line to the tree, or to the caret under a fault.

An operator binds as tightly as its number says; a power binds tightest and to the right, so that
−2² is −4. It is written by hand because a blank is a sign of its own here: inside brackets it parts
two entries, and a sign with a blank before it and none behind begins the next one.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

from nmatrix.calculator.arithmetic.values import LARGEST
from nmatrix.calculator.language.faults import CalculatorError
from nmatrix.calculator.language.tokens import Token, TokenKind, tokens
from nmatrix.calculator.language.tree import (
    Bracket,
    Call,
    Index,
    Infix,
    Member,
    Name,
    Node,
    Numeral,
    Pasted,
    Power,
    Prefix,
    Turn,
    Word,
)

DEEPEST = 100  # levels of nesting; Python's own stack holds about 1000
LONGEST_EXPONENT = 4  # digits
COMPARISON, SUM, PRODUCT, SIGN, POWER = 1, 2, 3, 4, 5
OPERATORS = {
    "==": COMPARISON,
    "≈": COMPARISON,
    "+": SUM,
    "-": SUM,
    "*": PRODUCT,
    "/": PRODUCT,
    "@": PRODUCT,
    "·": PRODUCT,
    "×": PRODUCT,
}
_NOTHING = Token(TokenKind.END, "", 0, 0)
EXPONENT = "it is a whole number, T or -T: A^2, A^-1, A^T, A^-T; a root is sqrt(x)"
MEMBERS = ("T", "inv", "xyz", "x", "y", "z", "w")


def parse(line: str, names: frozenset[str] = frozenset()) -> Node:
    """Parse an expression of the closed grammar; `names` are those that begin no notation.

    Raises
    ------
    CalculatorError
        For text that is too long, too deep, no expression, or outside the grammar.

    Examples
    --------
    >>> parse("2 + A").right
    Name(start=4, end=5, name='A')
    """
    found = _Parser(line, tokens(line, names))
    tree = found.expression(0, 0)
    found.end()
    return tree


class _Parser:
    """Reads tokens from left to right; `brackets` tells if a blank parts entries just now.

    A token is asked for only when the tree before it stands, so what is too deep is refused early.
    """

    def __init__(self, line: str, coming: Iterator[Token]) -> None:
        self.line, self.coming, self.place = line, coming, 0
        self.read: list[Token] = []
        self.brackets = False

    def ahead(self, steps: int = 0) -> Token:
        """Look at a token; behind the last there is only the end."""
        while len(self.read) <= self.place + steps:
            self.read.append(next(self.coming, self.read[-1] if self.read else _NOTHING))
        return self.read[self.place + steps]

    @property
    def next(self) -> Token:
        if not self.brackets:
            while self.ahead().kind is TokenKind.LINE_END:
                self.place += 1
        return self.ahead()

    def take(self) -> Token:
        found = self.next
        self.place += 1
        return found

    def fault(self, at: int, what: str, why: str) -> CalculatorError:
        return CalculatorError(self.line, at, what, why)

    def expression(self, least: int, depth: int) -> Node:
        """Read operands and the operators that bind at least so tightly."""
        left = self.operand(depth)
        levels = depth
        while (token := self.next).kind is TokenKind.SIGN and token.text in OPERATORS:
            binds = OPERATORS[token.text]
            if binds < least or self.parts_entries():
                break
            self.take()
            levels += 1  # a long sum is as deep as it has operators
            self.check_depth(levels, token)
            right = self.expression(binds + 1, levels)
            left = Infix(left.start, right.end, token.text, left, right, token.start)
        return left

    def operand(self, depth: int) -> Node:
        token = self.take()
        self.check_depth(depth, token)
        if token.is_sign("-", "+", "√"):
            binds = POWER if token.text == "√" else SIGN
            inner = self.expression(binds, depth + 1)
            return Prefix(token.start, inner.end, token.text, inner)
        return self.followed(self.atom(token, depth), depth)

    def atom(self, token: Token, depth: int) -> Node:  # noqa: PLR0911 - one line for each kind
        start, end = token.start, token.end
        match token.kind:
            case TokenKind.NUMBER:
                return self.numeral(token, depth)
            case TokenKind.ANGLE:
                return Turn(start, end, token.degrees)
            case TokenKind.PASTED:
                return Pasted(start, end, token.rows)
            case TokenKind.WORD:
                return Word(start, end, token.text)
            case TokenKind.NAME:
                if self.is_call():
                    return self.call(token, depth)
                return Name(start, end, token.text)
        if token.is_sign("("):
            return self.parentheses(token, depth)
        if token.is_sign("["):
            return self.bracket(token, depth)
        if token.is_sign("/") and any(
            one.is_sign("/") for one in (self.ahead(), *self.read[self.place - 2 : self.place - 1])
        ):
            raise self.fault(start, "//", "a remark begins with #")
        raise self.fault(start, *_missing(token))

    def numeral(self, token: Token, depth: int) -> Node:
        after = self.ahead()
        number = Numeral(token.start, token.end, token.text)
        if after.after_blank or not (after.kind is TokenKind.NAME or after.is_sign("√", "(")):
            return number
        if after.text == "√":  # 3√2 is one number
            root = self.operand(depth + 1)
            return Infix(number.start, root.end, "*", number, root, root.start)
        raise self.fault(after.start, *_behind_a_number(token.text, after.text))

    def is_call(self) -> bool:
        token = self.ahead()
        return token.is_sign("(") and not (self.brackets and token.after_blank)

    def followed(self, node: Node, depth: int) -> Node:
        """Read what follows an operand: members, indices, powers."""
        while True:
            token = self.next
            adjacent = not token.after_blank
            self.no_sign_behind(token)
            if token.is_sign(".") and adjacent:
                node = self.member(node)
            elif token.is_sign("[") and adjacent:
                node = self.index(node, depth)
            elif token.is_sign("^") and not (self.brackets and not adjacent):
                node = self.power(node, depth)
            else:
                return node
            depth += 1
            self.check_depth(depth, token)

    def member(self, node: Node) -> Node:
        dot, name = self.take(), self.take()
        if name.kind is not TokenKind.NAME or name.text not in MEMBERS:
            known = " ".join(f".{one}" for one in MEMBERS)
            called = "; functions stand alone: write dot(a, b)" if self.is_call() else ""
            raise self.fault(dot.start, "a part", f"after a point there are {known}{called}")
        return Member(node.start, name.end, node, name.text, dot.start)

    def no_sign_behind(self, token: Token) -> None:
        """Refuse MATLAB's .* and its like."""
        if token.is_sign(".") and self.ahead(1).is_sign("*", "/", "^"):
            why = "nothing is computed entry by entry; * is of numbers, @ of matrices"
            raise self.fault(token.start, f".{self.ahead(1).text}", why)

    def index(self, node: Node, depth: int) -> Node:
        opening = self.take()
        outside, self.brackets = self.brackets, False
        places: list[Node | None] = []
        while True:
            if self.next.is_sign(":"):
                self.take()
                places.append(None)
            else:
                places.append(self.expression(0, depth + 1))
            token = self.take()
            if token.is_sign("]"):
                break
            if not token.is_sign(",") or len(places) == 2:
                why = "a place is written A[0, 3], A[0, :] or v[1], counted from 0"
                raise self.fault(token.start, "an index", why)
        self.brackets = outside
        return Index(node.start, token.end, node, tuple(places), opening.start)

    def power(self, node: Node, depth: int) -> Node:
        at = self.take().start
        closing = {"(": ")", "{": "}"}.get(
            self.next.text if self.next.kind is TokenKind.SIGN else ""
        )
        if closing:
            self.take()
        sign = -1 if self.next.is_sign("-") else 1
        if self.next.is_sign("-", "+"):
            self.take()
        token = self.take()
        if token.kind is TokenKind.NAME and token.text in ("T", "t"):
            exponent, transposed = sign, True
        elif token.kind is TokenKind.NUMBER and token.text.isdigit():
            if len(token.text) > LONGEST_EXPONENT:
                raise self.fault(token.start, "an exponent", "it has at most four digits")
            exponent, transposed = sign * int(token.text), False
        else:
            raise self.fault(token.start, "an exponent", EXPONENT)
        if closing and not (token := self.take()).is_sign(closing):
            is_short = token.kind is TokenKind.END
            raise self.fault(
                token.start, "an exponent", f"{closing} is missing" if is_short else EXPONENT
            )
        if self.next.is_sign("^"):
            why = "write (a^b)^c, or the number that the upper power is"
            raise self.fault(self.next.start, "a power of a power", why)
        return Power(node.start, token.end, node, exponent, transposed, at)

    def parentheses(self, opening: Token, depth: int) -> Node:
        outside, self.brackets = self.brackets, False
        inner = self.expression(0, depth + 1)
        token = self.take()
        if token.is_sign(","):
            rows, token = self.listed(inner, depth)
            inner = Bracket(opening.start, token.end, (rows,))
        self.closed(opening, token)
        self.brackets = outside
        return replace(inner, start=opening.start, end=token.end)

    def closed(self, opening: Token, closing: Token) -> None:
        """Refuse what stands where the ) of a bracket belongs."""
        if closing.kind is TokenKind.END:
            raise self.fault(opening.start, "(", "its ) is missing")
        if not closing.is_sign(")"):
            raise self.fault(closing.start, *_stray(closing, "a comma or ) belongs here"))

    def listed(self, first: Node, depth: int) -> tuple[tuple[Node, ...], Token]:
        """Read the rest of a list (1, 2, 3)."""
        found = [first]
        while True:
            if self.next.is_sign(")"):
                return tuple(found), self.take()
            found.append(self.expression(0, depth + 1))
            token = self.take()
            if not token.is_sign(","):
                return tuple(found), token

    def call(self, name: Token, depth: int) -> Node:
        opening = self.take()
        outside, self.brackets = self.brackets, False
        arguments: list[Node] = []
        named: list[tuple[str, Node]] = []
        while not self.next.is_sign(")"):
            token = self.next
            if token.kind is TokenKind.NAME and self.ahead(1).is_sign("="):
                self.place += 2
                named.append((token.text, self.expression(0, depth + 1)))
            else:
                arguments.append(self.expression(0, depth + 1))
            if self.next.is_sign(","):
                self.take()
            elif not self.next.is_sign(")"):
                break
        closing = self.take()
        self.closed(opening, closing)
        self.brackets = outside
        return Call(name.start, closing.end, name.text, tuple(arguments), tuple(named))

    def bracket(self, opening: Token, depth: int) -> Node:
        """Read a list or a matrix; inside, blanks part entries as commas do."""
        outside, self.brackets = self.brackets, True
        rows: list[tuple[Node, ...]] = []
        row: list[Node] = []
        while True:
            token = self.next
            if token.is_sign(";", "]") or token.kind is TokenKind.LINE_END:
                self.place += 1
                if row:
                    rows.append(tuple(row))
                    row = []
                if token.is_sign("]"):
                    break
            elif token.kind is TokenKind.END:
                raise self.fault(opening.start, "[", "its ] is missing")
            else:
                if max(len(rows), len(row)) == LARGEST:
                    why = f"a matrix has at most {LARGEST} rows and columns"
                    raise self.fault(token.start, "bracket", why)
                row.append(self.expression(0, depth + 1))
                self.comma()
        self.brackets = outside
        return Bracket(opening.start, token.end, tuple(rows))

    def comma(self) -> None:
        """Pass a comma, and the line end behind it."""
        if not self.next.is_sign(","):
            return
        comma = self.take()
        while self.ahead().kind is TokenKind.LINE_END:
            self.place += 1
        if self.next.is_sign(",", ";"):
            raise self.fault(comma.end, "an entry", "a number is missing here")

    def parts_entries(self) -> bool:
        """Tell whether the sign before us begins the next entry of a bracket: [1 -2]."""
        token, after = self.ahead(), self.ahead(1)
        apart = token.is_sign("+", "-") and token.after_blank and not after.after_blank
        return self.brackets and apart

    def check_depth(self, depth: int, token: Token) -> None:
        if depth > DEEPEST:
            why = f"nesting ends at {DEEPEST} levels, and every operator is one"
            raise self.fault(token.start, "expression", why)

    def end(self) -> None:
        token = self.next
        if token.is_sign(":") and self.ahead(1).is_sign(":"):
            why = "functions have no prefix: write look_at(eye, target)"
            raise self.fault(token.start, "::", why)
        self.no_sign_behind(token)
        if token.kind is not TokenKind.END:
            raise self.fault(token.start, *_stray(token, "it does not read on from here"))


def _missing(token: Token) -> tuple[str, str]:
    """Tell what stands where a number, a name or a bracket belongs."""
    if token.kind is TokenKind.END:
        return "expression", "it ends too early" if token.start else "it is empty, try det(M)"
    return f"{token.text.strip() or 'a line end'}", "a number, a name or a bracket belongs here"


def _behind_a_number(number: str, after: str) -> tuple[str, str]:
    """Tell what letters or a bracket close behind a number may have been meant for."""
    if after[0] == "_":
        return "a number", f"digits stand together: write {number}{after.replace('_', '')}"
    if number == "0" and after[0] in "xXbBoO":
        return "a number", "numbers are decimal: write 16 for 0x10"
    return "a product", f"it is written with its sign: {number.rstrip('.')}*{after}"


def _stray(token: Token, otherwise: str) -> tuple[str, str]:
    """Tell why an expression ends before this token."""
    if token.kind is TokenKind.NUMBER and not token.after_blank and token.text[0] == ".":
        return "a number", "it has a point already"
    if token.kind in (TokenKind.NAME, TokenKind.NUMBER, TokenKind.ANGLE, TokenKind.PASTED):
        return "expression", "a sign is missing: products are written a*b, of matrices A @ B"
    if token.is_sign("=", ":"):
        return token.text, "name = expression gives a name, a == b compares"
    if token.is_sign(";"):
        return ";", "one line is one statement, and needs no ; at its end"
    if token.is_sign(")", "]", "}"):
        return token.text, "nothing was opened that it closes"
    return "expression", otherwise
