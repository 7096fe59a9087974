"""A correction of one finding, as text in place of text; none where it would be a guess."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from nmatrix.enums import ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.faults import Fault
from nmatrix.linting.names import matrix_named, vector_named
from nmatrix.linting.rules import RuleId
from nmatrix.linting.tree import Expression, Shader, Span, Storage
from nmatrix.linting.values import Carried, Role, ShaderSpace, spoken


@dataclass(frozen=True)
class Change:
    """New text in place of a piece of a source."""

    span: Span
    text: str


def fixed(fault: Fault, shader: Shader, content: bytes) -> Change | None:
    """Correct a finding where one change of its expression is right.

    Examples
    --------
    >>> from nmatrix.linting.program import lint
    >>> text = b"in vec3 vNormal; void main() { float d = dot(vNormal, vec3(1.0)); }"
    >>> found = lint({"a.frag": text})
    >>> fixed(found.faults[0], found.shaders[0], text).text
    'normalize(vNormal)'
    """
    mend = _MENDERS.get(fault.rule)
    if mend is None or fault.expression is None:
        return None
    if shader.macros and any(one.span.holds(fault.span) for one in shader.macros.values()):
        return None  # what is right in one use of a macro may be wrong in another
    return mend(_Mending(fault, shader, content))


def changed(content: bytes, changes: Iterable[Change]) -> bytes:
    """Make all changes; of two that overlap the first one is made.

    Examples
    --------
    >>> changed(b"a + b", [Change(Span("", 4, 5), "c"), Change(Span("", 0, 1), "x")])
    b'x + c'
    """
    made, end = [], 0
    for one in sorted(changes, key=lambda each: each.span.start):
        if one.span.start >= end:
            made += [content[end : one.span.start], one.text.encode()]
            end = one.span.end
    return b"".join((*made, content[end:]))


@dataclass(frozen=True)
class _Mending:
    """One fault with its source at hand."""

    fault: Fault
    shader: Shader
    content: bytes

    def text(self, expression: Expression) -> str:
        span = expression.span
        return self.content[span.start : span.end].decode("utf-8", "replace")

    @property
    def has_inverse(self) -> bool:
        """Whether the language has inverse() and transpose()."""
        return self.shader.language is ShaderLanguage.GLSL and self.shader.version >= 140

    def uniforms(self) -> Iterator[tree.Variable]:
        return (one for one in self.shader.variables if one.storage is Storage.UNIFORM)

    def matrix(self, to: ShaderSpace, source: ShaderSpace) -> str | None:
        """Find a uniform that is this matrix."""
        for one in self.uniforms():
            found = matrix_named(one.name) if one.type == "mat4" else None
            if found is not None and (found.to, found.source) == (to, source):
                return None if found.is_transposed else one.name
        return None


def _with_normal_matrix(mending: _Mending) -> Change | None:
    """Put the inverse transpose in the place of the matrix."""
    fault, parts = mending.fault, mending.fault.parts
    if parts.matrix is None or parts.vector is None:
        return None
    matrix = _upper(parts.matrix)
    name = mending.text(matrix)
    if mending.has_inverse:
        right = f"transpose(inverse(mat3({name})))"
    elif name == "gl_ModelViewMatrix":
        right = "gl_NormalMatrix"
    elif name == "modelViewMatrix":
        right = "normalMatrix"
    elif name == "unity_ObjectToWorld" and not _homogeneous(parts.vector):
        return Change(fault.span, f"UnityObjectToWorldNormal({mending.text(parts.vector)})")
    else:
        return None
    homogeneous = _homogeneous(parts.vector)
    if homogeneous is None:
        return Change(parts.matrix.span, right)
    if not isinstance(fault.expression, tree.Binary) or parts.matrix is not fault.expression.left:
        return None
    return Change(fault.span, f"vec4({right} * {mending.text(homogeneous)}, 0.0)")


def _upper(matrix: Expression) -> Expression:
    """Take what is inside of `mat3(…)`."""
    is_upper = isinstance(matrix, tree.Call) and matrix.function in ("mat3", "mat4")
    if isinstance(matrix, tree.Call) and is_upper and len(matrix.arguments) == 1:
        return _upper(matrix.arguments[0])
    return matrix


def _homogeneous(vector: Expression) -> Expression | None:
    """Take the three components of `vec4(v, w)`."""
    if isinstance(vector, tree.Call) and vector.function == "vec4" and len(vector.arguments) == 2:
        return vector.arguments[0]
    return None


def _without_normal_matrix(mending: _Mending) -> Change | None:
    matrix = mending.fault.parts.matrix
    known = {"gl_NormalMatrix": "mat3(gl_ModelViewMatrix)", "normalMatrix": "mat3(modelViewMatrix)"}
    if isinstance(matrix, tree.Name):
        right = known.get(matrix.name)
        own = re.search(rf"\b(?:mat|float)[34]\w*\s+{matrix.name}\b".encode(), mending.content)
        return None if own or right is None else Change(matrix.span, right)
    bare: Expression | None = matrix
    taken = []
    while isinstance(bare, tree.Call) and bare.function in ("transpose", "inverse", "mat3"):
        taken.append(bare.function)
        bare = bare.arguments[0]
    if matrix is None or bare is None or {"transpose", "inverse"} - set(taken):
        return None
    return Change(matrix.span, f"mat3({mending.text(bare)})")


def _whole_inverse_transpose(mending: _Mending) -> Change | None:
    parts = mending.fault.parts
    if parts.matrix is None or not parts.missing or not mending.has_inverse:
        return None
    return Change(parts.matrix.span, f"{parts.missing}({mending.text(parts.matrix)})")


def _view_alone(mending: _Mending) -> Change | None:
    matrix = mending.fault.parts.matrix
    if matrix is None:
        return None
    inner = _upper(matrix)
    view = mending.matrix(ShaderSpace.CAMERA, ShaderSpace.WORLD)
    if view is None:
        return None
    return Change(inner.span, view)


def _other_w(mending: _Mending) -> Change | None:
    vector = mending.fault.parts.vector
    if not isinstance(vector, tree.Call) or vector.function != "vec4":
        return None
    last = vector.arguments[-1]
    if not isinstance(last, tree.Number):
        return None
    return Change(last.span, "1.0" if last.value == 0 else "0.0")


def _in_order(mending: _Mending) -> Change | None:
    expression, order = mending.fault.expression, mending.fault.parts.order
    factors = list(_factors(expression)) if mending.shader.language is ShaderLanguage.GLSL else []
    if expression is None or len(factors) != len(order):
        return None
    return Change(expression.span, " * ".join(mending.text(factors[place]) for place in order))


def _factors(expression: Expression | None) -> Iterator[Expression]:
    if isinstance(expression, tree.Binary) and expression.operator == "*":
        yield from _factors(expression.left)
        yield from _factors(expression.right)
    elif expression is not None:
        yield expression


def _from_the_eye(mending: _Mending) -> Change | None:
    expression = mending.fault.expression
    while isinstance(expression, tree.Call) and expression.arguments:
        expression = expression.arguments[0]
    if not isinstance(expression, tree.Unary) or mending.fault.left != spoken(ShaderSpace.WORLD):
        return None
    stage = mending.shader.stage
    for one in mending.uniforms():
        if one.type == "vec3":
            found = vector_named(one.name, one.type, one.storage, stage)
            if found.role is Role.EYE and found.kind is Carried.POINT:
                return Change(expression.span, f"{one.name} - {mending.text(expression.operand)}")
    return None


def _moved_light(mending: _Mending) -> Change | None:
    """Move the place of the world, where it is a name and the other one is in camera space."""
    fault = mending.fault
    spaces = spoken(ShaderSpace.WORLD), spoken(ShaderSpace.CAMERA)
    view = mending.matrix(ShaderSpace.CAMERA, ShaderSpace.WORLD)
    expression = fault.expression
    if view is None or mending.shader.language is not ShaderLanguage.GLSL:
        return None
    if not isinstance(expression, tree.Binary) or expression.operator != "-":
        return None
    if spaces not in ((fault.left, fault.right), (fault.right, fault.left)):
        return None
    light = expression.left if fault.left == spaces[0] else expression.right
    if not isinstance(light, tree.Name):
        return None
    return Change(light.span, f"({view} * vec4({mending.text(light)}, 1.0)).xyz")


def _normalised(mending: _Mending) -> Change | None:
    vector = mending.fault.parts.vector
    return None if vector is None else Change(vector.span, f"normalize({mending.text(vector)})")


def _three_components(mending: _Mending) -> Change | None:
    call = mending.fault.expression
    if not isinstance(call, tree.Call) or not call.arguments:
        return None
    four = "vec4" if mending.shader.language is ShaderLanguage.GLSL else "float4"
    inner = mending.text(call.arguments[0])
    bare = inner if isinstance(call.arguments[0], tree.Name | tree.Call) else f"({inner})"
    return Change(call.span, f"{four}(normalize({bare}.xyz), 0.0)")


def _turned_round(mending: _Mending) -> Change | None:
    call = mending.fault.expression
    if not isinstance(call, tree.Call) or not call.arguments:
        return None
    arriving = call.arguments[0]
    if isinstance(arriving, tree.Unary):
        return Change(arriving.span, mending.text(arriving.operand))
    is_simple = isinstance(arriving, tree.Name | tree.Call | tree.Member)
    text = mending.text(arriving)
    return Change(arriving.span, f"-{text}" if is_simple else f"-({text})")


def _divided(mending: _Mending) -> Change | None:
    vector = mending.fault.parts.vector
    if not isinstance(vector, tree.Member):
        return None
    return Change(vector.span, f"{mending.text(vector)} / {mending.text(vector.of)}.w")


def _clamped(mending: _Mending) -> Change | None:
    call = mending.fault.expression
    if not isinstance(call, tree.Call) or not call.arguments:
        return None
    base = call.arguments[0]
    return Change(base.span, f"max({mending.text(base)}, 0.0)")


_MENDERS: dict[RuleId, Callable[[_Mending], Change | None]] = {
    RuleId.NORMAL_BY_MATRIX: _with_normal_matrix,
    RuleId.NORMAL_WITH_W: _with_normal_matrix,
    RuleId.TANGENT_BY_NORMAL_MATRIX: _without_normal_matrix,
    RuleId.HALF_INVERSE_TRANSPOSE: _whole_inverse_transpose,
    RuleId.LIGHT_BY_MODEL_VIEW: _view_alone,
    RuleId.WRONG_W: _other_w,
    RuleId.PRODUCT_ORDER: _in_order,
    RuleId.EYE_AT_ORIGIN: _from_the_eye,
    RuleId.STUCK_LIGHT: _moved_light,
    RuleId.NOT_NORMALISED: _normalised,
    RuleId.FOUR_COMPONENTS: _three_components,
    RuleId.REFLECTED_WRONG_WAY: _turned_round,
    RuleId.W_NOT_DIVIDED: _divided,
    RuleId.POWER_OF_NEGATIVE: _clamped,
}
