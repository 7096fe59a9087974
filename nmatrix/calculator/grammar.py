"""The closed grammar: what an expression may hold, checked before anything is computed.

Python's own parser makes the tree; this file admits a handful of its nodes and nothing else, and
puts a caret where the first fault is.
"""

from __future__ import annotations

import ast

from nmatrix.errors import IllegalValueError

LONGEST = 10_000  # characters
DEEPEST = 200  # levels of nesting; Python's own stack holds about 1000
WINDOW = 30  # characters shown on either side of the caret

OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "+",
    ast.Sub: "-",
    ast.Mult: "*",
    ast.Div: "/",
    ast.MatMult: "@",
}
_OPENING, _CLOSING = "([{", ")]}"


class CalculatorError(IllegalValueError):
    """A fault in an expression, with the place where it is."""


def fault(expression: str, at: int, what: str, why: str) -> CalculatorError:
    """Return an error whose line shows a caret in front of the faulty character.

    Examples
    --------
    >>> print(fault("M.__class__", 1, "an attribute", "only .T may follow a dot"))
    an attribute (character 2): only .T may follow a dot; see the caret: M^.__class__
    """
    before = expression[max(0, at - WINDOW) : at]
    after = expression[at : at + WINDOW]
    shown = f"{'…' if at > WINDOW else ''}{before}^{after}"
    if at + WINDOW < len(expression):
        shown += "…"
    return CalculatorError(f"{what} (character {at + 1})", why, f"see the caret: {shown}")


def parse(expression: str) -> ast.expr:
    """Return the tree of an expression, if it is one of ours.

    Raises
    ------
    CalculatorError
        For text that is too long, too deep, no expression, or outside the grammar.
    """
    _check_size(expression)
    _check_brackets(expression)
    try:
        tree = ast.parse(expression, mode="eval").body
    except SyntaxError as error:
        at = max(0, min((error.offset or 1) - 1, len(expression)))
        raise fault(expression, at, "expression", "it does not read on from here") from None
    except (ValueError, RecursionError, MemoryError):
        raise fault(expression, 0, "expression", "it is nested too deeply to be read") from None
    _check_nodes(expression, tree)
    return tree


def position(expression: str, node: ast.expr) -> int:
    """Return the character at which a node begins (Python counts bytes)."""
    return len(expression.encode()[: node.col_offset].decode(errors="ignore"))


def _check_size(expression: str) -> None:
    if len(expression) > LONGEST:
        raise fault(expression, LONGEST, "expression", f"{len(expression)} characters are too many")
    if not expression.strip():
        raise fault(expression, 0, "expression", "it is empty, try det(M)")
    for at, character in enumerate(expression):
        if not character.isprintable() or not character.isascii():
            raise fault(expression, at, "character", "only plain ASCII characters mean something")


def _check_brackets(expression: str) -> None:
    depth = 0
    for at, character in enumerate(expression):
        depth += (character in _OPENING) - (character in _CLOSING)
        if depth > DEEPEST:
            raise fault(expression, at, "bracket", f"nesting ends at {DEEPEST} levels")


def _check_nodes(expression: str, tree: ast.expr) -> None:
    """Walk the tree without recursion, so that its depth cannot hurt."""
    waiting: list[tuple[ast.expr, int]] = [(tree, 1)]
    while waiting:
        node, depth = waiting.pop()
        at = position(expression, node)
        if depth > DEEPEST:
            raise fault(expression, at, "expression", f"nesting ends at {DEEPEST} levels")
        waiting += [(child, depth + 1) for child in _children(expression, node, at)]


def _children(expression: str, node: ast.expr, at: int) -> list[ast.expr]:
    match node:
        case ast.BinOp(left=left, op=operator, right=right):
            if type(operator) not in OPERATORS:
                raise fault(expression, at, "operator", "the operators are @ * / + -")
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
        case ast.Attribute(attr=name):
            dot = max(at, (node.end_col_offset or 0) - len(name) - 1)
            raise fault(expression, dot, "an attribute", "only .T may follow a dot")
        case _:
            word = type(node).__name__.lower()
            raise fault(expression, at, word, "only numbers, matrices, names and calls are known")
