"""The tree of a shader, the same for GLSL and HLSL: what the rules and the spaces are read from.

It has what carries vectors and matrices, and `Unread` for all else. Types are GLSL's: `float3x3`
is `mat3`, `mul(a, b)` is a product, and a cast is a constructor.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from enum import StrEnum
from typing import NamedTuple

from nmatrix.enums import ShaderLanguage


def is_vector(type_: str) -> bool:
    """Whether a type is a vector.

    Examples
    --------
    >>> is_vector("vec3"), is_vector("vector")
    (True, False)
    """
    return type_ in ("vec2", "vec3", "vec4")


def is_matrix(type_: str) -> bool:
    """Whether a type is a matrix.

    Examples
    --------
    >>> is_matrix("mat4"), is_matrix("material")
    (True, False)
    """
    return type_ in ("mat2", "mat3", "mat4")


class Stage(StrEnum):
    """Where in the pipeline a shader runs."""

    VERTEX = "vertex"
    BETWEEN = "geometry or tessellation"
    FRAGMENT = "fragment"
    UNKNOWN = "unknown"


class Storage(StrEnum):
    """Where a variable's value comes from."""

    LOCAL = "local"
    UNIFORM = "uniform"
    INPUT = "input"
    OUTPUT = "output"
    BOTH = "input and output"


class Span(NamedTuple):
    """A piece of a source, in bytes."""

    file: str
    start: int
    end: int

    def holds(self, other: Span) -> bool:
        """Whether the other piece lies inside of this one, or is the same."""
        return self.file == other.file and self.start <= other.start and other.end <= self.end


@dataclass(frozen=True, slots=True)
class Name:
    """A variable."""

    span: Span
    name: str


@dataclass(frozen=True, slots=True)
class Number:
    """A literal."""

    span: Span
    value: float


@dataclass(frozen=True, slots=True)
class Call:
    """A function or a constructor of its arguments."""

    span: Span
    function: str
    arguments: tuple[Expression, ...]


@dataclass(frozen=True, slots=True)
class Binary:
    """Two operands; `*` is the product of linear algebra, `.*` goes entry by entry."""

    span: Span
    operator: str
    left: Expression
    right: Expression


@dataclass(frozen=True, slots=True)
class Unary:
    """A sign or a negation."""

    span: Span
    operator: str
    operand: Expression


@dataclass(frozen=True, slots=True)
class Member:
    """A field or a swizzle."""

    span: Span
    of: Expression
    name: str


@dataclass(frozen=True, slots=True)
class Element:
    """An element of an array, a column of a GLSL matrix."""

    span: Span
    of: Expression
    index: Expression


@dataclass(frozen=True, slots=True)
class Conditional:
    """One of two values."""

    span: Span
    condition: Expression
    chosen: Expression
    otherwise: Expression


@dataclass(frozen=True, slots=True)
class Assignment:
    """A value put into a place; the operator is `=`, `+=` and so on."""

    span: Span
    target: Expression
    operator: str
    value: Expression


@dataclass(frozen=True, slots=True)
class Unread:
    """What says nothing of spaces."""

    span: Span


Expression = (
    Name | Number | Call | Binary | Unary | Member | Element | Conditional | Assignment | Unread
)


@dataclass(frozen=True, slots=True)
class Variable:
    """A declared name.

    `semantic` is HLSL's and `location` GLSL's way to say which output is which input; `note` is
    the comment that stands beside it.
    """

    span: Span
    name: str
    type: str
    storage: Storage = Storage.LOCAL
    initial: Expression | None = None
    semantic: str = ""
    note: str = ""
    is_flat: bool = False
    is_array: bool = False
    location: int | None = None


@dataclass(frozen=True, slots=True)
class Declaration:
    """Variables, in the order of their declaration."""

    variables: tuple[Variable, ...]


@dataclass(frozen=True, slots=True)
class Evaluated:
    """An expression by itself."""

    expression: Expression


@dataclass(frozen=True, slots=True)
class Return:
    """The value of a function."""

    value: Expression | None


@dataclass(frozen=True, slots=True)
class Choice:
    """Statements of which one list is run; where none may be, the last list is empty.

    Branches of the preprocessor are choices too: each of them is read.
    """

    condition: Expression | None
    branches: tuple[tuple[Statement, ...], ...]


@dataclass(frozen=True, slots=True)
class Loop:
    """Statements that are run again."""

    condition: Expression | None
    body: tuple[Statement, ...]


Statement = Declaration | Evaluated | Return | Choice | Loop


@dataclass(frozen=True, slots=True)
class Function:
    """A definition; of one name there may be several, by their parameters or by branches."""

    span: Span
    name: str
    type: str
    parameters: tuple[Variable, ...]
    body: tuple[Statement, ...]
    semantic: str = ""


@dataclass(frozen=True, slots=True)
class Struct:
    """A type made of fields."""

    name: str
    fields: tuple[Variable, ...]


@dataclass(frozen=True, slots=True)
class SyntaxFault:
    """A place that does not parse."""

    span: Span


@dataclass(frozen=True)
class Shader:
    """One file: what it declares and defines, and what of it could not be read."""

    file: str
    language: ShaderLanguage
    version: int
    stage: Stage
    variables: tuple[Variable, ...] = ()
    functions: tuple[Function, ...] = ()
    structs: tuple[Struct, ...] = ()
    macros: dict[str, Expression] = field(default_factory=dict)
    faults: tuple[SyntaxFault, ...] = ()
