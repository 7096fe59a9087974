"""Expressions of the grammars become expressions of the tree, the same for GLSL and HLSL."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.source import type_named
from nmatrix.linting.tree import Span

if TYPE_CHECKING:
    from tree_sitter import Node

DEEPEST = 120  # of expressions and blocks in one another; no person writes more
NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_HLSL_FUNCTIONS = {"lerp": "mix", "ddx": "dFdx", "ddy": "dFdy", "frac": "fract"}


class Expressions:
    """The expressions of one source; `moved` is how far it is from where it stands in the file."""

    def __init__(self, file: str, content: bytes, language: ShaderLanguage, moved: int = 0) -> None:
        self.file = file
        self.content = content
        self.language = language
        self.moved = moved
        self.depth = 0

    def expression(self, node: Node) -> tree.Expression:
        """Read one expression; what says nothing of spaces, or is too deep, is unread."""
        self.depth += 1
        try:
            if self.depth > DEEPEST:
                return tree.Unread(self.span(node))
            found = _EXPRESSIONS.get(node.type)
            return tree.Unread(self.span(node)) if found is None else found(self, node)
        finally:
            self.depth -= 1

    def _named(self, node: Node) -> tree.Expression:
        return tree.Name(self.span(node), self.text(node))

    def _number(self, node: Node) -> tree.Expression:
        found = NUMBER.match(self.text(node))
        return tree.Number(self.span(node), float(found[0]) if found else 0.0)

    def _parenthesized(self, node: Node) -> tree.Expression:
        inner = [one for one in node.named_children if one.type != "comment"]
        return self.expression(inner[0]) if inner else tree.Unread(self.span(node))

    def _binary(self, node: Node) -> tree.Expression:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = node.child_by_field_name("operator")
        if left is None or right is None or sign is None:
            return tree.Unread(self.span(node))
        operator = sign.type
        if operator == "*" and self.language is ShaderLanguage.HLSL:
            operator = ".*"
        return tree.Binary(self.span(node), operator, self.expression(left), self.expression(right))

    def _unary(self, node: Node) -> tree.Expression:
        operand, sign = node.child_by_field_name("argument"), node.child_by_field_name("operator")
        if operand is None or sign is None:
            return tree.Unread(self.span(node))
        return tree.Unary(self.span(node), sign.type, self.expression(operand))

    def _member(self, node: Node) -> tree.Expression:
        of, name = node.child_by_field_name("argument"), node.child_by_field_name("field")
        if of is None or name is None:
            return tree.Unread(self.span(node))
        return tree.Member(self.span(node), self.expression(of), self.text(name))

    def _element(self, node: Node) -> tree.Expression:
        of, index = node.child_by_field_name("argument"), node.child_by_field_name("index")
        if of is None:
            return tree.Unread(self.span(node))
        place = self.expression(index) if index is not None else tree.Unread(self.span(node))
        return tree.Element(self.span(node), self.expression(of), place)

    def _conditional(self, node: Node) -> tree.Expression:
        parts = [
            node.child_by_field_name(one) for one in ("condition", "consequence", "alternative")
        ]
        condition, chosen, otherwise = (
            tree.Unread(self.span(node)) if one is None else self.expression(one) for one in parts
        )
        return tree.Conditional(self.span(node), condition, chosen, otherwise)

    def _assignment(self, node: Node) -> tree.Expression:
        target, value = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = node.child_by_field_name("operator")
        if target is None or value is None:
            return tree.Unread(self.span(node))
        operator = "=" if sign is None else sign.type
        return tree.Assignment(
            self.span(node), self.expression(target), operator, self.expression(value)
        )

    def _cast(self, node: Node) -> tree.Expression:
        type_, value = node.child_by_field_name("type"), node.child_by_field_name("value")
        if type_ is None or value is None:
            return tree.Unread(self.span(node))
        return tree.Call(self.span(node), self.type_of(type_), (self.expression(value),))

    def _call(self, node: Node) -> tree.Expression:
        function, listed = (
            node.child_by_field_name("function"),
            node.child_by_field_name("arguments"),
        )
        span = self.span(node)
        if function is None or listed is None:
            return tree.Unread(span)
        arguments = tuple(
            self.expression(one)
            for one in listed.named_children
            if one.type not in ("comment", "ERROR")
        )
        if function.type == "field_expression":  # a method: of a texture, as far as is known
            of = function.child_by_field_name("argument")
            name = function.child_by_field_name("field")
            if of is not None and name is not None and self.text(name).startswith("Sample"):
                return tree.Call(span, "texture", (self.expression(of), *arguments))
            return tree.Call(span, "?", arguments)
        if function.type not in ("identifier", "primitive_type", "type_identifier"):
            return tree.Call(span, "?", arguments)
        return self._normal_call(span, type_named(self.text(function)), arguments)

    def _normal_call(
        self, span: Span, name: str, arguments: tuple[tree.Expression, ...]
    ) -> tree.Expression:
        """Write a call of HLSL as GLSL has it."""
        if self.language is ShaderLanguage.GLSL:
            return tree.Call(span, name, arguments)
        if name == "mul" and len(arguments) == 2:
            return tree.Binary(span, "*", *arguments)
        called = tree.Call(span, _HLSL_FUNCTIONS.get(name, name), arguments)
        if name.startswith("mat") and len(arguments) > 1:  # rows, where GLSL has columns
            return tree.Call(span, "transpose", (called,))
        return called

    def _list(self, node: Node) -> tree.Expression:
        arguments = tuple(self.expression(one) for one in node.named_children)
        return tree.Call(self.span(node), "?", arguments)

    def span(self, node: Node) -> Span:
        """Tell where a node stands in the file."""
        return Span(self.file, node.start_byte + self.moved, node.end_byte + self.moved)

    def text(self, node: Node) -> str:
        """Read the text of a node."""
        return self.content[node.start_byte : node.end_byte].decode("utf-8", "replace").strip()

    def type_of(self, node: Node) -> str:
        """Read a type as GLSL spells it."""
        if node.type == "template_type":
            listed = node.child_by_field_name("arguments")
            inner = listed.named_children[0] if listed and listed.named_children else None
            return self.type_of(inner) if inner is not None else ""
        if node.type == "type_descriptor" and node.named_children:
            return self.type_of(node.named_children[0])
        return type_named(self.text(node))


_EXPRESSIONS = {
    "identifier": Expressions._named,
    "number_literal": Expressions._number,
    "parenthesized_expression": Expressions._parenthesized,
    "binary_expression": Expressions._binary,
    "unary_expression": Expressions._unary,
    "field_expression": Expressions._member,
    "subscript_expression": Expressions._element,
    "conditional_expression": Expressions._conditional,
    "assignment_expression": Expressions._assignment,
    "cast_expression": Expressions._cast,
    "call_expression": Expressions._call,
    "initializer_list": Expressions._list,
}
