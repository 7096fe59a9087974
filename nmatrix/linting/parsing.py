"""A source becomes a tree: declarations, functions and statements, by the grammars of an extra.

The grammars leave marks where nothing is wrong: a name of no width after `precision … float`, in
`vec2[](…)` and after `: register(b0)`, an error at a pragma that they do not know. What stands in
an error is passed over, what stands beside it is read.
"""

from __future__ import annotations

import re
import warnings
from bisect import bisect_right
from functools import cache
from typing import TYPE_CHECKING

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.expressions import DEEPEST, NUMBER, Expressions
from nmatrix.linting.source import (
    COMMENT,
    language_of,
    notes,
    programs_alone,
    stage_of,
    version_of,
    without_bare_macros,
)
from nmatrix.linting.tree import Shader, Storage, Variable
from nmatrix.requirements import missing

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator

    from tree_sitter import Node, Parser

_UNKNOWN_PRAGMA = re.compile(rb"^\s*#\s*(?:pragma|extension|line|error|warning|undef)\b")
# What the grammars do not know of right sources: qualifiers, default layouts, `precision … int;`,
# a conversion before a product.
_WORDS_ALONE = re.compile(rb"[\w\s().,*]*;?|layout\s*\([^)]*\)[\w\s]*;?")
_HEAD_OF_FUNCTION = re.compile(
    rb"^(?:\w+[ \t]+){1,3}\w+[ \t]*\([^;{}()]*\)[^;{}()]*\{", re.MULTILINE
)
_NOT_LINE_END = re.compile(rb"[^\r\n]")
MOST_AGAIN = 4  # times that a source is parsed once more behind what does not parse
_EVEN_SCALES = re.compile("uniform_?scal", re.IGNORECASE)  # a branch for worlds of one scale
_LOCATION = re.compile(r"\blocation\s*=\s*(\d+)")
_QUALIFIERS = {
    "uniform": Storage.UNIFORM,
    "attribute": Storage.INPUT,
    "in": Storage.INPUT,
    "varying": Storage.BOTH,
    "out": Storage.OUTPUT,
    "inout": Storage.BOTH,
    "buffer": Storage.UNIFORM,
}
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


def parse(file: str, content: bytes, language: ShaderLanguage | None = None) -> Shader:
    """Parse one source; the language is told by the name's ending, or by the words of the text.

    Raises
    ------
    MissingPackageError
        Without the grammars.
    """
    content = without_bare_macros(programs_alone(content))
    told = language or language_of(file, content)
    return _Parsing(file, content, told).shader()


@cache
def parser_of(language: ShaderLanguage) -> Parser:
    """Load the grammar of a language, once.

    Raises
    ------
    MissingPackageError
        Without the grammars.
    """
    try:
        import tree_sitter
        import tree_sitter_glsl
        import tree_sitter_hlsl
    except ImportError:
        raise missing("lint", "tree_sitter", "tree_sitter_glsl", "tree_sitter_hlsl") from None
    grammar = tree_sitter_glsl if language is ShaderLanguage.GLSL else tree_sitter_hlsl
    with warnings.catch_warnings():  # these grammars still give a number where a capsule is wanted
        warnings.simplefilter("ignore", DeprecationWarning)
        return tree_sitter.Parser(tree_sitter.Language(grammar.language()))


class _Parsing(Expressions):
    """One source on its way to a tree."""

    def __init__(self, file: str, content: bytes, language: ShaderLanguage) -> None:
        super().__init__(file, content, language)
        self.variables: list[Variable] = []
        self.functions: list[tree.Function] = []
        self.structs: list[tree.Struct] = []
        self.macros: dict[str, tree.Expression] = {}
        self.again = MOST_AGAIN
        self.loose: list[tree.Statement] = []  # a piece that other sources include in a function
        self.notes = notes(content)
        self.line_starts = [0, *(one.end() for one in re.finditer(rb"\n", content))]

    def shader(self) -> Shader:
        """Parse the whole source."""
        root = parser_of(self.language).parse(self.content).root_node
        self._outer(root.named_children)
        faults = tuple(map(self._fault, self._broken(root)))
        if any(map(_is_done, self.loose)) and not any(one.name == "main" for one in self.functions):
            span = self.span(root)
            self.functions.append(tree.Function(span, "main", "void", (), tuple(self.loose)))
        return Shader(
            self.file,
            self.language,
            version_of(self.content),
            stage_of(self.file, self.content),
            tuple(self.variables),
            tuple(self.functions),
            tuple(self.structs),
            self.macros,
            faults,
        )

    # What stands outside of functions.

    def _outer(self, nodes: Iterable[Node]) -> None:
        previous = None
        for node in nodes:
            read = _OUTSIDE.get(node.type)
            if read is not None:
                read(self, node)
            elif node.type in ("compound_statement", "field_declaration_list"):
                self._block_of(previous, node)
            elif node.type in _BRANCHES:
                self._outer(node.named_children)
            if node.type in _LOOSE:
                self.loose += self._statement(node)
            previous = node

    def _outer_struct(self, node: Node) -> None:
        self._struct(node)

    def _outer_fault(self, node: Node) -> None:
        """Read what stands behind a place that does not parse, once more and by itself."""
        after = _HEAD_OF_FUNCTION.search(self.content, node.start_byte + 1, node.end_byte)
        if after is None or self.again == 0:
            self._outer(node.named_children)
            return
        self.again -= 1
        blank = _NOT_LINE_END.sub(b" ", self.content[: after.start()])
        root = parser_of(self.language).parse(blank + self.content[after.start() :]).root_node
        inside = [one for one in root.named_children if one.start_byte < node.end_byte]
        self._outer(inside)

    def _broken(self, root: Node) -> Iterator[Node]:
        """Find the places that do not parse; words that the grammars do not know are none."""
        waiting = [root]
        while waiting:
            node = waiting.pop()
            if node.type == "ERROR":
                text = self.content[node.start_byte : node.end_byte]
                if not _UNKNOWN_PRAGMA.match(text) and not _WORDS_ALONE.fullmatch(text):
                    yield node
            elif node.has_error:
                waiting += reversed(node.children)

    def _fault(self, node: Node) -> tree.SyntaxFault:
        return tree.SyntaxFault(self.span(node))

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
            block = self.text(names[0])
            self.structs.append(tree.Struct(block, tuple(self._fields(listed[0]))))
            self.variables.append(
                Variable(
                    self.span(node),
                    instance,
                    block,
                    storage,
                    is_flat=_is_flat(node),
                    is_array=is_array,
                )
            )
            return
        outside = Storage.LOCAL if self.language is ShaderLanguage.GLSL else Storage.UNIFORM
        self.variables += self._variables(node, outside)

    def _block_of(self, head: Node | None, body: Node) -> None:
        """Read a constant buffer of HLSL, whose head the grammar takes for a declaration."""
        if head is not None and self.text(head).lstrip().startswith(("cbuffer", "tbuffer")):
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
        called = self.text(name) if name is not None else f"struct at {node.start_byte}"
        if body is not None:
            self.structs.append(tree.Struct(called, tuple(self._fields(body))))
        return called

    def _macro(self, node: Node) -> None:
        name, value = node.child_by_field_name("name"), node.child_by_field_name("value")
        if name is None or value is None:
            return
        parameters = node.child_by_field_name("parameters")
        raw = self.content[value.start_byte : value.end_byte]
        text = COMMENT.sub(lambda one: b" " * len(one[0]), raw).replace(b"\\\n", b"  ")
        if NUMBER.fullmatch(text.strip().decode("utf-8", "replace")):
            return
        expression = self._parsed_alone(text, value.start_byte)
        if expression is None:
            return
        if parameters is None:
            self.macros[self.text(name)] = expression
            return
        span = self.span(node)
        named = tuple(
            Variable(self.span(one), self.text(one), "")
            for one in parameters.named_children
            if one.type == "identifier"
        )
        self.functions.append(
            tree.Function(span, self.text(name), "", named, (tree.Return(expression),))
        )

    def _parsed_alone(self, text: bytes, place: int) -> tree.Expression | None:
        """Parse an expression that stands in a macro, and keep its place in the file."""
        head = b"void f(){x="
        root = parser_of(self.language).parse(head + text + b";}").root_node
        if root.has_error:
            return None
        body = root.named_children[0].child_by_field_name("body")
        if body is None or len(body.named_children) != 1:
            return None
        statement = body.named_children[0]
        if statement.type != "expression_statement" or not statement.named_children:
            return None
        inner = Expressions(self.file, head + text + b";}", self.language, place - len(head))
        found = inner.expression(statement.named_children[0])
        return found.value if isinstance(found, tree.Assignment) else None

    def _function(self, node: Node) -> None:
        declarator, body = node.child_by_field_name("declarator"), node.child_by_field_name("body")
        type_ = node.child_by_field_name("type")
        if declarator is None or body is None or type_ is None:
            return
        if self.text(type_) in ("cbuffer", "tbuffer"):
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
                self.span(name),
                self.text(name),
                self.type_of(type_),
                parameters,
                statements,
                semantic,
            )
        )

    def _storage(self, node: Node, otherwise: Storage) -> Storage:
        found = otherwise
        for child in node.children:
            word = child.type if not child.is_named else self.text(child)
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
        named = self._struct(type_) if type_.type == "struct_specifier" else self.type_of(type_)
        span, is_flat, location = self.span(node), _is_flat(node), self._location(node)
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
                    None if initial is None else self.expression(initial),
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
        found = None if layout is None else _LOCATION.search(self.text(layout))
        return int(found[1]) if found else None

    def _declared(self, node: Node) -> str:
        while node.type not in ("identifier", "field_identifier"):
            inner = node.child_by_field_name("declarator")
            if inner is None:
                return ""
            node = inner
        return self.text(node)

    def _semantic(self, node: Node) -> str:
        names = [one for one in node.named_children if one.type == "identifier"]
        return self.text(names[0]).upper() if names else ""

    def _note(self, node: Node) -> str:
        line = bisect_right(self.line_starts, node.start_byte) - 1
        beside = self.notes.get(line, (False, ""))
        above = self.notes.get(line - 1, (False, ""))
        if not beside[0] and beside[1]:
            return beside[1]
        return above[1] if above[0] and "@space" in above[1] else ""

    def _statements(self, nodes: Iterable[Node]) -> Iterator[tree.Statement]:
        self.depth += 1
        for node in nodes:
            yield from self._statement(node)
        self.depth -= 1

    def _statement(self, node: Node) -> Iterator[tree.Statement]:
        read = _INSIDE.get(node.type)
        if read is not None and self.depth <= DEEPEST:
            yield from read(self, node)

    def _evaluated(self, node: Node) -> Iterator[tree.Statement]:
        for one in node.named_children:
            if one.type not in ("comment", "ERROR"):
                yield tree.Evaluated(self.expression(one))

    def _local(self, node: Node) -> Iterator[tree.Statement]:
        variables = self._variables(node, Storage.LOCAL)
        if variables:
            yield tree.Declaration(tuple(variables))

    def _return(self, node: Node) -> Iterator[tree.Statement]:
        values = [one for one in node.named_children if one.type not in ("comment", "ERROR")]
        yield tree.Return(self.expression(values[0]) if values else None)

    def _block(self, node: Node) -> Iterator[tree.Statement]:
        yield from self._statements(node.named_children)

    def _inner_macro(self, node: Node) -> Iterator[tree.Statement]:
        self._macro(node)
        yield from ()

    def _inner_fault(self, node: Node) -> Iterator[tree.Statement]:
        for one in node.named_children:  # what the parser still saw whole
            if one.type in _WHOLE:
                yield from self._statement(one)

    def _if(self, node: Node) -> Iterator[tree.Statement]:
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
        yield tree.Choice(condition, tuple(branches))

    def _condition(self, node: Node) -> tree.Expression | None:
        found = node.child_by_field_name("condition")
        if found is None:
            return None
        if found.type == "condition_clause":
            inner = found.child_by_field_name("value")
            return None if inner is None else self.expression(inner)
        return self.expression(found)

    def _body(self, node: Node | None) -> tuple[tree.Statement, ...]:
        return () if node is None else tuple(self._statements([node]))

    def _loop(self, node: Node) -> Iterator[tree.Statement]:
        first = node.child_by_field_name("initializer")
        if first is not None and first.type == "declaration":
            yield from self._statement(first)
        condition = self._condition(node)
        yield tree.Loop(condition, self._body(node.child_by_field_name("body")))

    def _switch(self, node: Node) -> Iterator[tree.Statement]:
        body = node.child_by_field_name("body")
        cases = [] if body is None else body.named_children
        branches = [tuple(self._statements([one])) for one in cases]
        yield tree.Choice(self._condition(node), (*branches, ()))

    def _preprocessed(self, node: Node) -> Iterator[tree.Statement]:
        branches: list[tuple[tree.Statement, ...]] = []
        current: Node | None = node
        while current is not None:
            skipped = {"name", "condition", "alternative"}
            inside = [
                child
                for place, child in enumerate(current.children)
                if child.is_named and current.field_name_for_child(place) not in skipped
            ]
            assumed = current.child_by_field_name("name") or current.child_by_field_name(
                "condition"
            )
            is_even = assumed is not None and _EVEN_SCALES.search(self.text(assumed))
            branches.append(() if is_even else tuple(self._statements(inside)))
            current = current.child_by_field_name("alternative")
        if len(branches) == 1:
            branches.append(())
        yield tree.Choice(None, tuple(branches))


def _is_done(statement: tree.Statement) -> bool:
    """Whether a statement is more than a declaration, or has one that is."""
    if isinstance(statement, tree.Choice):
        return any(_is_done(one) for branch in statement.branches for one in branch)
    return not isinstance(statement, tree.Declaration)


def _is_array(declarator: Node) -> bool:
    node: Node | None = declarator
    while node is not None:
        if node.type == "array_declarator":
            return True
        node = node.child_by_field_name("declarator")
    return False


def _is_flat(node: Node) -> bool:
    return any(child.type in ("flat", "nointerpolation") for child in node.children)


_BRANCHES = ("preproc_if", "preproc_ifdef", "preproc_else", "preproc_elif", "preproc_elifdef")
_LOOSE = ("expression_statement", "if_statement", "for_statement", "preproc_if", "preproc_ifdef")
_OUTSIDE = {
    "function_definition": _Parsing._function,
    "declaration": _Parsing._outer_declaration,
    "struct_specifier": _Parsing._outer_struct,
    "preproc_def": _Parsing._macro,
    "preproc_function_def": _Parsing._macro,
    "linkage_specification": lambda self, node: self._outer(node.named_children),
    "ERROR": _Parsing._outer_fault,
}
_INSIDE = {
    "expression_statement": _Parsing._evaluated,
    "declaration": _Parsing._local,
    "return_statement": _Parsing._return,
    "if_statement": _Parsing._if,
    "for_statement": _Parsing._loop,
    "while_statement": _Parsing._loop,
    "do_statement": _Parsing._loop,
    "switch_statement": _Parsing._switch,
    "preproc_ifdef": _Parsing._preprocessed,
    "preproc_if": _Parsing._preprocessed,
    "compound_statement": _Parsing._block,
    "case_statement": _Parsing._block,
    "labeled_statement": _Parsing._block,
    "preproc_def": _Parsing._inner_macro,
    "preproc_function_def": _Parsing._inner_macro,
    "ERROR": _Parsing._inner_fault,
}
