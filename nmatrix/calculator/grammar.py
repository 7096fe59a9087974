"""The closed grammar of expressions, checked before anything is computed.

Python's own parser makes the tree; only a handful of its nodes are admitted.
"""

from __future__ import annotations

import ast
import re
import string
import warnings

from nmatrix.calculator.faults import CalculatorError
from nmatrix.errors import IllegalValueError
from nmatrix.reading.notations import value_at

LONGEST = 10_000  # characters
DEEPEST = 200  # levels of nesting; Python's own stack holds about 1000

OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.MatMult: "@",
}
_OPENING, _CLOSING, _SIGNS = "([", ")]", "+-"
# Quotes are let through to the parser, so that the call around a string is the fault, if it is one.
_CHARACTERS = frozenset(string.ascii_letters + string.digits + "_., ()[]@*/+-'\"")
_AS_TYPED = str.maketrans("\t\n\r", "   ")
_NUMBER = r"[+-]?(?:[0-9]+(?:\.[0-9]*)?|\.[0-9]+)(?:[eE][+-]?[0-9]+|/[0-9]+)?"
_LITERAL = re.compile(rf"\[\s*({_NUMBER}(?:[\s,;]+{_NUMBER})+)[\s;]*\]")
_NOTATION = re.compile(
    r"(?<![\w.])(?:(?:new )?[A-Za-z_][\w.:<>]{0,40} ?(?:\([0-9]{1,2}\) ?)?[\[({]"
    r"|\{|\[X|<M|\([0-9]{1,2}\) ?\[)"
)
_BETWEEN_ROWS = re.compile(r"\]\s+\[")
_ROW_END = re.compile(r"\s*[;\n]\s*")
_SEPARATOR = re.compile(r"\s*,\s*|\s+")


def plain(expression: str) -> str:
    r"""Write an expression on one line, with hyphens for minus signs and commas between numbers.

    In brackets that hold numbers alone, blanks part them and semicolons or line ends part rows; a
    sign with a blank before it and none behind begins the next number. One column is a vector.

    Examples
    --------
    >>> plain(" 1 −\n2 "), plain("det([1 -2; 3 4])")
    ('1 - 2', 'det([[1, -2], [3, 4]])')
    >>> plain("[[1. 0.]\n [0. 2.]]"), plain("det(mat2(1, 2, 3, 4))")
    ('[[1., 0.], [0., 2.]]', 'det([[1, 3], [2, 4]])')
    """
    if len(expression) > LONGEST:
        return expression
    lists = _with_lists(expression.replace("−", "-"))
    listed = _LITERAL.sub(_with_commas, lists)
    return _BETWEEN_ROWS.sub("], [", listed).translate(_AS_TYPED).strip()


def _with_lists(expression: str) -> str:
    """Write the matrices of other notations, such as mat3(…) or {{…}, {…}}, as lists.

    Raises
    ------
    CalculatorError
        If one of them cannot be read.
    """
    parts, done = [], 0
    for found in _NOTATION.finditer(expression):
        if found.start() < done:
            continue
        try:
            value = value_at(expression, found.start(), "a literal")
        except IllegalValueError as refusal:
            what, why, _ = refusal.parts
            raise CalculatorError(expression, found.start(), what, why) from None
        if value is not None:
            rows, end = value
            lists = ", ".join(f"[{', '.join(row)}]" for row in rows)
            parts += [expression[done : found.start()], f"[{lists}]" if len(rows) > 1 else lists]
            done = end
    return "".join([*parts, expression[done:]])


def _with_commas(literal: re.Match[str]) -> str:
    rows = [_SEPARATOR.split(row.strip()) for row in _ROW_END.split(literal[1]) if row.strip()]
    if len(rows) > 1 and any(len(row) > 1 for row in rows):
        return f"[[{'], ['.join(', '.join(row) for row in rows)}]]"
    numbers = [number for row in rows for number in row]
    has_commas = literal[1].count(",") == len(numbers) - 1
    return literal[0] if has_commas else f"[{', '.join(numbers)}]"


def parse(expression: str) -> ast.expr:
    """Parse an expression of the closed grammar.

    Raises
    ------
    CalculatorError
        For text that is too long, too deep, no expression, or outside the grammar.
    """
    _check_characters(expression)
    _check_depth(expression)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # Python's advice about `1if` is not for our readers
            tree = ast.parse(expression, mode="eval").body
    except SyntaxError as error:
        at = error.offset - 1 if error.offset else len(expression)  # 0 is the end of the text
        at = min(at, len(expression))
        raise CalculatorError(
            expression, at, "expression", "it does not read on from here"
        ) from None
    except (ValueError, RecursionError, MemoryError):
        raise CalculatorError(
            expression, 0, "expression", "it is nested too deeply to be read"
        ) from None
    _check_nodes(expression, tree)
    return tree


def operator_position(expression: str, left: ast.expr) -> int:
    """Find the operator: the character behind its left side and that side's closing brackets."""
    at = left.end_col_offset or 0
    while expression[at] in ") ":
        at += 1
    return at


def _check_characters(expression: str) -> None:
    if len(expression) > LONGEST:
        why = f"it has {len(expression)} characters, {LONGEST} are read"
        raise CalculatorError(expression, LONGEST, "expression", why)
    if not expression:
        raise CalculatorError(expression, 0, "expression", "it is empty, try det(M)")
    for at, character in enumerate(expression):
        if character not in _CHARACTERS:
            why = "only letters, digits, brackets ( ) [ ] and @ * / + - . , mean something"
            raise CalculatorError(expression, at, "character", why)


def _check_depth(expression: str) -> None:
    """Count open brackets and signs in a row, before a parser has to follow them down."""
    depth = signs = 0
    for at, character in enumerate(expression):
        depth += (character in _OPENING) - (character in _CLOSING)
        signs = signs + 1 if character in _SIGNS else signs * (character == " ")
        if depth + signs > DEEPEST:
            raise CalculatorError(
                expression, at, "bracket or sign", f"nesting ends at {DEEPEST} levels"
            )


def _check_nodes(expression: str, tree: ast.expr) -> None:
    """Walk the tree without recursion, so that its depth cannot hurt."""
    waiting: list[tuple[ast.expr, int]] = [(tree, 1)]
    while waiting:
        node, depth = waiting.pop()
        if depth > DEEPEST:
            why = f"nesting ends at {DEEPEST} levels, and every operator is one"
            raise CalculatorError(expression, node.col_offset, "expression", why)
        waiting += [(child, depth + 1) for child in _children(expression, node)]


def _children(expression: str, node: ast.expr) -> list[ast.expr]:
    match node:
        case ast.BinOp(left=left, op=operator, right=right):
            if type(operator) not in OPERATORS:
                at = operator_position(expression, left)
                raise CalculatorError(expression, at, "operator", "the operators are @ * / + -")
            return [left, right]
        case ast.UnaryOp(op=ast.USub() | ast.UAdd(), operand=operand):
            return [operand]
        case ast.Call(func=ast.Name(), args=arguments, keywords=[]):
            return arguments
        case ast.Attribute(value=value, attr="T"):
            return [value]
        case ast.List(elts=elements) | ast.Tuple(elts=elements):
            return elements
        case ast.Name() | ast.Constant():
            return []
        case ast.Attribute(value=value):
            dot = operator_position(expression, value)
            raise CalculatorError(expression, dot, "an attribute", "only .T may follow a dot")
        case _:
            why = "only numbers, [brackets], names, function(…), @ * / + - and .T are read"
            raise CalculatorError(expression, node.col_offset, "expression", why)
