"""A source becomes a tree: the one module that knows the grammars, which are an optional package.

The grammars leave marks where nothing is wrong: a name of no width after `precision … float`, in
`vec2[](…)` and after `: register(b0)`, an error at a pragma that they do not know. What stands in
an error is passed over, what stands beside it is read.
"""

from __future__ import annotations

import re
import warnings
from bisect import bisect_right
from dataclasses import dataclass, field
from functools import cache
from pathlib import PurePath
from typing import TYPE_CHECKING

from nmatrix.errors import MissingPackageError
from nmatrix.lint import tree
from nmatrix.lint.tree import Language, Shader, Span, Stage, Storage, Variable

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from tree_sitter import Node, Parser

DEEPEST = 120  # of expressions and blocks in one another; no person writes more

STAGES = {
    "vert": Stage.VERTEX,
    "vs": Stage.VERTEX,
    "vsh": Stage.VERTEX,
    "frag": Stage.FRAGMENT,
    "fs": Stage.FRAGMENT,
    "fsh": Stage.FRAGMENT,
    "ps": Stage.FRAGMENT,
    "geom": Stage.BETWEEN,
    "gs": Stage.BETWEEN,
    "tesc": Stage.BETWEEN,
    "tese": Stage.BETWEEN,
    "vertex": Stage.VERTEX,
    "fragment": Stage.FRAGMENT,
    "pixel": Stage.FRAGMENT,
}
HLSL_SUFFIXES = (".hlsl", ".hlsli", ".fx", ".fxh")
_VECTOR = re.compile(r"(?:float|half|fixed|real|double|min16float|d?vec)([234])$")
_MATRIX = re.compile(r"(?:float|half|fixed|real|double|min16float|d?mat)([234])(?:x([234]))?$")
_SCALAR = re.compile(r"(?:float|half|fixed|real|double|min16float|int|uint|bool)$")
_COMMENT = re.compile(rb"//([^\n]*)|/\*(.*?)\*/", re.DOTALL)
_VERSION = re.compile(rb"^[ \t]*#[ \t]*version[ \t]+(\d+)(?:[ \t]+(es))?", re.MULTILINE)
_NUMBER = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?")
_UNKNOWN_PRAGMA = re.compile(rb"^\s*#\s*(?:pragma|extension|line|error|warning|undef)\b")
_GLSL_ONLY = re.compile(rb"\b(?:void\s+main\s*\(\s*(?:void)?\s*\)|gl_Position|vec[234]|mat[34])\b")
_HLSL_ONLY = re.compile(rb"\b(?:float[234](?:x[34])?|cbuffer|SV_\w+|half[234])\b", re.IGNORECASE)
_SHADER_LAB = re.compile(
    rb"^[ \t]*(?:CG|HLSL)(?:PROGRAM|INCLUDE)\b(.*?)^[ \t]*END(?:CG|HLSL)\b",
    re.MULTILINE | re.DOTALL,
)
_NOT_LINE_END = re.compile(rb"[^\r\n]")
_LOCATION = re.compile(r"\blocation\s*=\s*(\d+)")
_HLSL_FUNCTIONS = {"lerp": "mix", "ddx": "dFdx", "ddy": "dFdy", "frac": "fract"}
_QUALIFIERS = {
    "uniform": Storage.UNIFORM,
    "attribute": Storage.INPUT,
    "in": Storage.INPUT,
    "varying": Storage.BOTH,
    "out": Storage.OUTPUT,
    "inout": Storage.BOTH,
    "buffer": Storage.UNIFORM,
}


def parse(file: str, content: bytes, language: Language | None = None) -> Shader:
    """Parse one source; the language is told by the name's ending, or by the words of the text.

    Raises
    ------
    MissingPackageError
        Without the grammars.
    """
    content = _programs_alone(content)
    told = language or language_of(file, content)
    return _Parsing(file, content, told).shader()


def _programs_alone(content: bytes) -> bytes:
    """Blank out what stands around the programs of a file of Unity's; places stay what they are."""
    blocks = list(_SHADER_LAB.finditer(content))
    if not blocks:
        return content
    found = bytearray(_NOT_LINE_END.sub(b" ", content))
    for block in blocks:
        found[block.start(1) : block.end(1)] = content[block.start(1) : block.end(1)]
    return bytes(found)


def language_of(file: str, content: bytes) -> Language:
    """Tell GLSL from HLSL.

    Examples
    --------
    >>> language_of("a.vert", b""), language_of("a.fx", b"")
    (<Language.GLSL: 'glsl'>, <Language.HLSL: 'hlsl'>)
    """
    if PurePath(file).suffix.lower() in HLSL_SUFFIXES:
        return Language.HLSL
    if len(_HLSL_ONLY.findall(content)) > len(_GLSL_ONLY.findall(content)):
        return Language.HLSL
    return Language.GLSL


def stage_of(file: str, content: bytes) -> Stage:
    """Tell the stage by the endings of the name, else by what only one stage writes.

    Examples
    --------
    >>> stage_of("a.vert.glsl", b""), stage_of("a.glsl", b"void main() { gl_Position = p; }")
    (<Stage.VERTEX: 'vertex'>, <Stage.VERTEX: 'vertex'>)
    """
    words = re.split(r"[._-]", PurePath(file).name.lower())
    for word in reversed(words[1:]):
        if word in STAGES:
            return STAGES[word]
    if b"EmitVertex" in content or b"gl_TessCoord" in content:
        return Stage.BETWEEN
    if re.search(rb"\bgl_(?:FragColor|FragData|FragCoord|FragDepth)\b|\bdiscard\b", content):
        return Stage.FRAGMENT
    if re.search(rb"\bgl_Position\b|\battribute\b", content):
        return Stage.VERTEX
    for ending, stage in (("vs", Stage.VERTEX), ("fs", Stage.FRAGMENT), ("ps", Stage.FRAGMENT)):
        if PurePath(file).stem.lower().endswith(ending):
            return stage
    return Stage.UNKNOWN


@cache
def _parser(language: Language) -> Parser:
    try:
        import tree_sitter
        import tree_sitter_glsl
        import tree_sitter_hlsl
    except ImportError:
        raise MissingPackageError(
            "lint",
            "it needs the packages tree-sitter, tree-sitter-glsl and tree-sitter-hlsl",
            "pip install 'nmatrix[lint]'",
        ) from None
    grammar = tree_sitter_glsl if language is Language.GLSL else tree_sitter_hlsl
    with warnings.catch_warnings():  # these grammars still give a number where a capsule is wanted
        warnings.simplefilter("ignore", DeprecationWarning)
        return tree_sitter.Parser(tree_sitter.Language(grammar.language()))


def check_grammars() -> None:
    """Refuse to begin where the grammars are missing."""
    _parser(Language.GLSL)


@dataclass
class _Parsing:
    """One source on its way to a tree."""

    file: str
    content: bytes
    language: Language
    variables: list[Variable] = field(default_factory=list)
    functions: list[tree.Function] = field(default_factory=list)
    structs: list[tree.Struct] = field(default_factory=list)
    macros: dict[str, tree.Expression] = field(default_factory=dict)
    includes: list[str] = field(default_factory=list)
    faults: list[tree.SyntaxFault] = field(default_factory=list)
    depth: int = 0

    def shader(self) -> Shader:
        self.notes = _notes(self.content)
        self.line_starts = [0, *(one.end() for one in re.finditer(rb"\n", self.content))]
        root = _parser(self.language).parse(self.content).root_node
        self._outer(root.named_children)
        version = _VERSION.search(self.content)
        number = int(version[1]) if version else 100
        if version and version[2] is None and number == 300:
            number = 330
        return Shader(
            self.file,
            self.language,
            number,
            stage_of(self.file, self.content),
            tuple(self.variables),
            tuple(self.functions),
            tuple(self.structs),
            self.macros,
            tuple(self.includes),
            tuple(self.faults),
        )

    # What stands outside of functions.

    def _outer(self, nodes: Iterable[Node]) -> None:
        previous = None
        for node in nodes:
            kind = node.type
            if kind == "function_definition":
                self._function(node)
            elif kind == "declaration":
                self._outer_declaration(node)
            elif kind == "struct_specifier":
                self._struct(node)
            elif kind in ("compound_statement", "field_declaration_list"):
                self._block_of(previous, node)
            elif kind in ("preproc_def", "preproc_function_def"):
                self._macro(node)
            elif kind == "preproc_include":
                path = node.child_by_field_name("path")
                if path is not None:
                    self.includes.append(self._text(path).strip('"<>'))
            elif kind.startswith("preproc_") and kind not in ("preproc_call", "preproc_arg"):
                self._outer(node.named_children)
            elif kind == "ERROR":
                self._fault(node)
                self._outer(node.named_children)
            elif kind == "linkage_specification":
                self._outer(node.named_children)
            previous = node

    def _fault(self, node: Node) -> None:
        if not _UNKNOWN_PRAGMA.match(self.content[node.start_byte : node.end_byte]):
            self.faults.append(tree.SyntaxFault(self._span(node)))

    def _outer_declaration(self, node: Node) -> None:
        listed = [one for one in node.named_children if one.type == "field_declaration_list"]
        if listed:  # an interface block
            storage = self._storage(node, Storage.UNIFORM)
            names = [one for one in node.named_children if one.type in _NAMED]
            instance = self._declared(names[1]) if len(names) > 1 else None
            is_array = len(names) > 1 and _is_array(names[1])
            if instance is None:
                self._fields_as_variables(listed[0], storage)
                return
            block = self._text(names[0])
            self.structs.append(tree.Struct(block, tuple(self._fields(listed[0]))))
            self.variables.append(
                Variable(
                    self._span(node),
                    instance,
                    block,
                    storage,
                    is_flat=_is_flat(node),
                    is_array=is_array,
                )
            )
            return
        outside = Storage.LOCAL if self.language is Language.GLSL else Storage.UNIFORM
        self.variables += self._variables(node, outside)

    def _block_of(self, head: Node | None, body: Node) -> None:
        """Read a constant buffer of HLSL, whose head the grammar takes for a declaration."""
        if head is not None and self._text(head).lstrip().startswith(("cbuffer", "tbuffer")):
            self._fields_as_variables(body, Storage.UNIFORM)

    def _fields_as_variables(self, body: Node, storage: Storage) -> None:
        for one in self._declarations(body.named_children):
            self.variables += self._variables(one, storage)

    def _declarations(self, nodes: Iterable[Node]) -> Iterator[Node]:
        for node in nodes:
            if node.type in ("declaration", "field_declaration"):
                yield node
            elif node.type == "struct_specifier":
                self._struct(node)
            elif node.type.startswith("preproc_if") or node.type in (
                "preproc_else",
                "preproc_elif",
                "ERROR",
            ):
                yield from self._declarations(node.named_children)

    def _fields(self, body: Node) -> Iterator[Variable]:
        for one in self._declarations(body.named_children):
            yield from self._variables(one, Storage.LOCAL)

    def _struct(self, node: Node) -> str:
        name, body = node.child_by_field_name("name"), node.child_by_field_name("body")
        called = self._text(name) if name is not None else f"struct at {node.start_byte}"
        if body is not None:
            self.structs.append(tree.Struct(called, tuple(self._fields(body))))
        return called

    def _macro(self, node: Node) -> None:
        name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or value is None:
            return
        parameters = node.child_by_field_name("parameters")
        raw = self.content[value.start_byte : value.end_byte]
        text = _COMMENT.sub(lambda one: b" " * len(one[0]), raw).replace(b"\\\n", b"  ")
        if _NUMBER.fullmatch(text.strip().decode("utf-8", "replace")):
            return
        expression = self._parsed_alone(text, value.start_byte)
        if expression is None:
            return
        if parameters is None:
            self.macros[self._text(name)] = expression
            return
        span = self._span(node)
        named = tuple(
            Variable(self._span(one), self._text(one), "")
            for one in parameters.named_children
            if one.type == "identifier"
        )
        self.functions.append(
            tree.Function(span, self._text(name), "", named, (tree.Return(expression),))
        )

    def _parsed_alone(self, text: bytes, place: int) -> tree.Expression | None:
        """Parse an expression that stands in a macro, and keep its place in the file."""
        head = b"void f(){x="
        root = _parser(self.language).parse(head + text + b";}").root_node
        if root.has_error:
            return None
        body = root.named_children[0].child_by_field_name("body")
        if body is None or len(body.named_children) != 1:
            return None
        statement = body.named_children[0]
        if statement.type != "expression_statement" or not statement.named_children:
            return None
        inner = _Parsing(self.file, head + text + b";}", self.language)
        inner.notes, inner.line_starts = {}, [0]
        inner.moved = place - len(head)
        found = inner._expression(statement.named_children[0])
        return found.value if isinstance(found, tree.Assignment) else None

    def _function(self, node: Node) -> None:
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("body")
        type_ = node.child_by_field_name("type")
        if declarator is None or body is None or type_ is None:
            return
        if self._text(type_) in ("cbuffer", "tbuffer"):
            self._fields_as_variables(body, Storage.UNIFORM)
            return
        if declarator.type != "function_declarator":
            return
        name = declarator.child_by_field_name("declarator")
        listed = declarator.child_by_field_name("parameters")
        if name is None or listed is None:
            return
        parameters = tuple(
            one
            for parameter in listed.named_children
            if parameter.type.endswith("parameter_declaration")
            for one in self._variables(parameter, Storage.INPUT)
        )
        semantic = next(
            (self._semantic(one) for one in declarator.children if one.type == "semantics"), ""
        )
        statements = tuple(self._statements(body.named_children))
        self.functions.append(
            tree.Function(
                self._span(name),
                self._text(name),
                self._type(type_),
                parameters,
                statements,
                semantic,
            )
        )

    # Declarations.

    def _storage(self, node: Node, otherwise: Storage) -> Storage:
        found = otherwise
        for child in node.children:
            word = child.type if not child.is_named else self._text(child)
            if word in ("const", "static", "groupshared", "shared") and otherwise in (
                Storage.UNIFORM,
                Storage.LOCAL,
            ):
                found = Storage.LOCAL
            elif word in _QUALIFIERS:
                if child.is_named and child.type not in ("qualifiers", "type_qualifier"):
                    continue
                found = _QUALIFIERS[word]
        return found

    def _variables(self, node: Node, otherwise: Storage) -> list[Variable]:
        type_ = node.child_by_field_name("type")
        if type_ is None:
            return []
        storage = self._storage(node, otherwise)
        named = self._struct(type_) if type_.type == "struct_specifier" else self._type(type_)
        span, is_flat, location = self._span(node), _is_flat(node), self._location(node)
        found = []
        semantic = next(
            (self._semantic(one) for one in node.children if one.type in _SEMANTICS), ""
        )
        for child in node.children_by_field_name("declarator"):
            name = self._declared(child)
            if not name or child.type == "semantics":
                continue
            initial = (
                child.child_by_field_name("value") if child.type == "init_declarator" else None
            )
            found.append(
                Variable(
                    span,
                    name,
                    named,
                    storage,
                    None if initial is None else self._expression(initial),
                    semantic,
                    self._note(child),
                    is_flat,
                    _is_array(child),
                    location,
                )
            )
        return found

    def _location(self, node: Node) -> int | None:
        layout = next((one for one in node.children if one.type == "layout_specification"), None)
        found = None if layout is None else _LOCATION.search(self._text(layout))
        return int(found[1]) if found else None

    def _declared(self, node: Node) -> str:
        while node.type not in ("identifier", "field_identifier"):
            inner = node.child_by_field_name("declarator")
            if inner is None:
                return ""
            node = inner
        return self._text(node)

    def _semantic(self, node: Node) -> str:
        names = [one for one in node.named_children if one.type == "identifier"]
        return self._text(names[0]).upper() if names else ""

    def _type(self, node: Node) -> str:
        if node.type == "template_type":
            listed = node.child_by_field_name("arguments")
            inner = listed.named_children[0] if listed and listed.named_children else None
            return self._type(inner) if inner is not None else ""
        if node.type == "type_descriptor" and node.named_children:
            return self._type(node.named_children[0])
        return type_named(self._text(node))

    def _note(self, node: Node) -> str:
        line = bisect_right(self.line_starts, node.start_byte) - 1
        beside = self.notes.get(line, (False, ""))
        above = self.notes.get(line - 1, (False, ""))
        if not beside[0] and beside[1]:
            return beside[1]
        return above[1] if above[0] and "@space" in above[1] else ""

    # Statements.

    def _statements(self, nodes: Iterable[Node]) -> Iterator[tree.Statement]:
        self.depth += 1
        for node in nodes:
            yield from self._statement(node)
        self.depth -= 1

    def _statement(self, node: Node) -> Iterator[tree.Statement]:
        kind = node.type
        if self.depth > DEEPEST:
            return
        if kind == "expression_statement":
            for one in node.named_children:
                if one.type not in ("comment", "ERROR"):
                    yield tree.Evaluated(self._expression(one))
        elif kind == "declaration":
            variables = self._variables(node, Storage.LOCAL)
            if variables:
                yield tree.Declaration(tuple(variables))
        elif kind == "return_statement":
            values = [one for one in node.named_children if one.type not in ("comment", "ERROR")]
            yield tree.Return(self._expression(values[0]) if values else None)
        elif kind == "if_statement":
            yield self._if(node)
        elif kind in ("for_statement", "while_statement", "do_statement"):
            yield from self._loop(node)
        elif kind == "switch_statement":
            yield self._switch(node)
        elif kind in ("preproc_ifdef", "preproc_if"):
            yield self._preprocessed(node)
        elif kind in ("compound_statement", "case_statement", "labeled_statement"):
            yield from self._statements(node.named_children)
        elif kind in ("preproc_def", "preproc_function_def"):
            self._macro(node)
        elif kind == "ERROR":
            self._fault(node)
            for one in node.named_children:  # what the parser still saw whole
                if one.type in _WHOLE:
                    yield from self._statement(one)

    def _if(self, node: Node) -> tree.Choice:
        branches: list[tuple[tree.Statement, ...]] = []
        condition = self._condition(node)
        while True:  # a chain of else-if is one choice, however long
            branches.append(self._body(node.child_by_field_name("consequence")))
            otherwise = node.child_by_field_name("alternative")
            inner = otherwise.named_children[-1] if otherwise and otherwise.named_children else None
            if inner is None:
                branches.append(())
                break
            if inner.type != "if_statement":
                branches.append(self._body(inner))
                break
            node = inner
        return tree.Choice(condition, tuple(branches))

    def _condition(self, node: Node) -> tree.Expression | None:
        found = node.child_by_field_name("condition")
        if found is None:
            return None
        if found.type == "condition_clause":
            inner = found.child_by_field_name("value")
            return None if inner is None else self._expression(inner)
        return self._expression(found)

    def _body(self, node: Node | None) -> tuple[tree.Statement, ...]:
        return () if node is None else tuple(self._statements([node]))

    def _loop(self, node: Node) -> Iterator[tree.Statement]:
        first = node.child_by_field_name("initializer")
        if first is not None and first.type == "declaration":
            yield from self._statement(first)
        condition = self._condition(node)
        yield tree.Loop(condition, self._body(node.child_by_field_name("body")))

    def _switch(self, node: Node) -> tree.Choice:
        body = node.child_by_field_name("body")
        cases = [] if body is None else body.named_children
        branches = [tuple(self._statements([one])) for one in cases]
        return tree.Choice(self._condition(node), (*branches, ()))

    def _preprocessed(self, node: Node) -> tree.Choice:
        branches: list[tuple[tree.Statement, ...]] = []
        current: Node | None = node
        while current is not None:
            skipped = {"name", "condition", "alternative"}
            inside = [
                child
                for place, child in enumerate(current.children)
                if child.is_named and current.field_name_for_child(place) not in skipped
            ]
            branches.append(tuple(self._statements(inside)))
            current = current.child_by_field_name("alternative")
        if len(branches) == 1:
            branches.append(())
        return tree.Choice(None, tuple(branches))

    # Expressions.

    def _expression(self, node: Node) -> tree.Expression:
        self.depth += 1
        try:
            if self.depth > DEEPEST:
                return tree.Unread(self._span(node))
            found = _EXPRESSIONS.get(node.type)
            return tree.Unread(self._span(node)) if found is None else found(self, node)
        finally:
            self.depth -= 1

    def _named(self, node: Node) -> tree.Expression:
        return tree.Name(self._span(node), self._text(node))

    def _number(self, node: Node) -> tree.Expression:
        found = _NUMBER.match(self._text(node))
        return tree.Number(self._span(node), float(found[0]) if found else 0.0)

    def _parenthesized(self, node: Node) -> tree.Expression:
        inner = [one for one in node.named_children if one.type != "comment"]
        return self._expression(inner[0]) if inner else tree.Unread(self._span(node))

    def _binary(self, node: Node) -> tree.Expression:
        left, right = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = node.child_by_field_name("operator")
        if left is None or right is None or sign is None:
            return tree.Unread(self._span(node))
        operator = sign.type
        if operator == "*" and self.language is Language.HLSL:
            operator = ".*"
        return tree.Binary(
            self._span(node), operator, self._expression(left), self._expression(right)
        )

    def _unary(self, node: Node) -> tree.Expression:
        operand, sign = node.child_by_field_name("argument"), node.child_by_field_name("operator")
        if operand is None or sign is None:
            return tree.Unread(self._span(node))
        return tree.Unary(self._span(node), sign.type, self._expression(operand))

    def _member(self, node: Node) -> tree.Expression:
        of, name = node.child_by_field_name("argument"), node.child_by_field_name("field")
        if of is None or name is None:
            return tree.Unread(self._span(node))
        return tree.Member(self._span(node), self._expression(of), self._text(name))

    def _element(self, node: Node) -> tree.Expression:
        of, index = node.child_by_field_name("argument"), node.child_by_field_name("index")
        if of is None:
            return tree.Unread(self._span(node))
        place = self._expression(index) if index is not None else tree.Unread(self._span(node))
        return tree.Element(self._span(node), self._expression(of), place)

    def _conditional(self, node: Node) -> tree.Expression:
        parts = [
            node.child_by_field_name(one) for one in ("condition", "consequence", "alternative")
        ]
        condition, chosen, otherwise = (
            tree.Unread(self._span(node)) if one is None else self._expression(one) for one in parts
        )
        return tree.Conditional(self._span(node), condition, chosen, otherwise)

    def _assignment(self, node: Node) -> tree.Expression:
        target, value = node.child_by_field_name("left"), node.child_by_field_name("right")
        sign = node.child_by_field_name("operator")
        if target is None or value is None:
            return tree.Unread(self._span(node))
        operator = "=" if sign is None else sign.type
        return tree.Assignment(
            self._span(node), self._expression(target), operator, self._expression(value)
        )

    def _cast(self, node: Node) -> tree.Expression:
        type_, value = node.child_by_field_name("type"), node.child_by_field_name("value")
        if type_ is None or value is None:
            return tree.Unread(self._span(node))
        return tree.Call(self._span(node), self._type(type_), (self._expression(value),))

    def _call(self, node: Node) -> tree.Expression:
        function, listed = (
            node.child_by_field_name("function"),
            node.child_by_field_name("arguments"),
        )
        span = self._span(node)
        if function is None or listed is None:
            return tree.Unread(span)
        arguments = tuple(
            self._expression(one)
            for one in listed.named_children
            if one.type not in ("comment", "ERROR")
        )
        if function.type == "field_expression":  # a method: of a texture, as far as is known
            of = function.child_by_field_name("argument")
            name = function.child_by_field_name("field")
            if of is not None and name is not None and self._text(name).startswith("Sample"):
                return tree.Call(span, "texture", (self._expression(of), *arguments))
            return tree.Call(span, "?", arguments)
        if function.type not in ("identifier", "primitive_type", "type_identifier"):
            return tree.Call(span, "?", arguments)
        return self._normal_call(span, type_named(self._text(function)), arguments)

    def _normal_call(
        self, span: Span, name: str, arguments: tuple[tree.Expression, ...]
    ) -> tree.Expression:
        """Write a call of HLSL as GLSL has it."""
        if self.language is Language.GLSL:
            return tree.Call(span, name, arguments)
        if name == "mul" and len(arguments) == 2:
            return tree.Binary(span, "*", *arguments)
        called = tree.Call(span, _HLSL_FUNCTIONS.get(name, name), arguments)
        if name.startswith("mat") and len(arguments) > 1:  # rows, where GLSL has columns
            return tree.Call(span, "transpose", (called,))
        return called

    def _list(self, node: Node) -> tree.Expression:
        arguments = tuple(self._expression(one) for one in node.named_children)
        return tree.Call(self._span(node), "?", arguments)

    # Places and words.

    moved: int = 0

    def _span(self, node: Node) -> Span:
        return Span(self.file, node.start_byte + self.moved, node.end_byte + self.moved)

    def _text(self, node: Node) -> str:
        return self.content[node.start_byte : node.end_byte].decode("utf-8", "replace").strip()


_NAMED = ("identifier", "type_identifier", "array_declarator")
_SEMANTICS = ("semantics", "bitfield_clause")
_WHOLE = (
    "expression_statement",
    "declaration",
    "if_statement",
    "for_statement",
    "return_statement",
    "compound_statement",
)
_EXPRESSIONS = {
    "identifier": _Parsing._named,
    "number_literal": _Parsing._number,
    "parenthesized_expression": _Parsing._parenthesized,
    "binary_expression": _Parsing._binary,
    "unary_expression": _Parsing._unary,
    "field_expression": _Parsing._member,
    "subscript_expression": _Parsing._element,
    "conditional_expression": _Parsing._conditional,
    "assignment_expression": _Parsing._assignment,
    "cast_expression": _Parsing._cast,
    "call_expression": _Parsing._call,
    "initializer_list": _Parsing._list,
}


def type_named(name: str) -> str:
    """Spell a type as GLSL does; a matrix of 4 × 3 entries is affine, and counts as `mat4`.

    Examples
    --------
    >>> type_named("float3"), type_named("half4x4"), type_named("mat4x3"), type_named("Light")
    ('vec3', 'mat4', 'mat4', 'Light')
    """
    vector = _VECTOR.match(name)
    if vector:
        return f"vec{vector[1]}"
    matrix = _MATRIX.match(name)
    if matrix:
        return f"mat{max(matrix[1], matrix[2] or matrix[1])}"
    if name in ("matrix", "float4x3"):
        return "mat4"
    return "float" if _SCALAR.match(name) else name


def _is_array(declarator: Node) -> bool:
    node: Node | None = declarator
    while node is not None:
        if node.type == "array_declarator":
            return True
        node = node.child_by_field_name("declarator")
    return False


def _is_flat(node: Node) -> bool:
    return any(child.type in ("flat", "nointerpolation") for child in node.children)


def _notes(content: bytes) -> dict[int, tuple[bool, str]]:
    """Collect the comments by their last line, and whether a comment has the line to itself."""
    found: dict[int, tuple[bool, str]] = {}
    line = place = 0
    for one in _COMMENT.finditer(content):
        start = content.rfind(b"\n", 0, one.start()) + 1
        alone = not content[start : one.start()].strip()
        line += content.count(b"\n", place, one.end())
        place = one.end()
        found[line] = (alone, (one[1] or one[2] or b"").decode("utf-8", "replace").strip())
    return found
