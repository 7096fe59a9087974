"""Changes that may correct a finding, as text in place of text; none where each would be a guess.

Which of them does is not known here: `mending` reads the program again after each.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass

from nmatrix.enums import Severity, ShaderLanguage
from nmatrix.linting import tree
from nmatrix.linting.faults import Fault
from nmatrix.linting.names import matrix_named, vector_named
from nmatrix.linting.rules import RuleId
from nmatrix.linting.tree import Expression, Shader, Span, Storage, is_matrix
from nmatrix.linting.values import Carried, Role, ShaderSpace, Vector, spoken


@dataclass(frozen=True)
class Change:
    """New text in place of a piece of a source."""

    span: Span
    text: str


def candidates(fault: Fault, shader: Shader, content: bytes) -> tuple[Change, ...]:
    """List the changes that may correct a finding, what was meant most often first.

    Examples
    --------
    >>> from nmatrix.linting.program import lint
    >>> text = b"in vec3 vNormal; void main() { float d = dot(vNormal, vec3(1.0)); }"
    >>> found = lint({"a.frag": text})
    >>> [one.text for one in candidates(found.faults[0], found.shaders[0], text)]
    ['normalize(vNormal)']
    """
    if fault.expression is None or unmendable(fault, shader):
        return ()
    mending = _Mending(fault, shader, content)
    found = (mend(mending) for mend in _MENDERS[fault.rule])
    return tuple(dict.fromkeys(one for one in found if one is not None))


def unmendable(fault: Fault, shader: Shader) -> str | None:
    """Tell why nothing is tried for a finding, if that is so."""
    if any(one.span.holds(fault.span) for one in shader.macros.values()):
        return "it stands in a macro, which may be right in another place"
    if fault.severity is Severity.NOTE and fault.rule in _MENDERS:
        return "it is wrong only if what it says is so"
    return None if fault.rule in _MENDERS else _UNMENDED[fault.rule]


@dataclass(frozen=True)
class _Mending:
    """One fault with its source at hand."""

    fault: Fault
    shader: Shader
    content: bytes

    def text(self, expression: Expression) -> str:
        span = expression.span
        return self.content[span.start : span.end].decode("utf-8", "replace")

    def bare(self, expression: Expression) -> str:
        """Write an expression so that a sign or a swizzle is one of all of it."""
        text = self.text(expression)
        is_simple = isinstance(expression, tree.Name | tree.Call | tree.Member | tree.Element)
        return text if is_simple else f"({text})"

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
    expression, shader = mending.fault.expression, mending.shader
    written = (expression, *_operands(expression))
    turned = (_followed(one, shader) for one in written if one is not None)
    expression = next((one for one in turned if isinstance(one, tree.Unary)), None)
    if expression is None or mending.fault.left != spoken(ShaderSpace.WORLD):
        return None
    stage = mending.shader.stage
    for one in mending.uniforms():
        if one.type == "vec3":
            found = vector_named(one.name, one.type, one.storage, stage)
            if found.role is Role.EYE and found.kind is Carried.POINT:
                return Change(expression.span, f"{one.name} - {mending.text(expression.operand)}")
    return None


def _moved_light(mending: _Mending) -> Change | None:
    """Move the light to where it meets something."""
    met = mending.fault.parts.met or ()
    lights = [place for place, one in enumerate(met) if one.role is Role.LIGHT]
    return _moved(mending, lights[0]) if len(lights) == 1 else None


def _moved_first(mending: _Mending) -> Change | None:
    return _moved(mending, 0)


def _moved_second(mending: _Mending) -> Change | None:
    return _moved(mending, 1)


def _moved(mending: _Mending, place: int) -> Change | None:
    """Move one of two vectors that meet into the space of the other one."""
    met, operands = mending.fault.parts.met, _operands(mending.fault.expression)
    if met is None or len(operands) != 2 or mending.shader.language is not ShaderLanguage.GLSL:
        return None
    one, other, operand = met[place], met[1 - place], operands[place]
    if one.space is None or other.space is None or one.size != 3:
        return None
    matrix = mending.matrix(other.space, one.space)
    if matrix is None:
        return None
    if one.kind is Carried.NORMAL and ShaderSpace.OBJECT in (one.space, other.space):
        if not mending.has_inverse:
            return None
        right = f"transpose(inverse(mat3({matrix})))"
        return Change(operand.span, f"({right} * {mending.bare(operand)})")
    w = "1.0" if one.kind is Carried.POINT else "0.0"
    return Change(operand.span, f"({matrix} * vec4({mending.text(operand)}, {w})).xyz")


def _operands(expression: Expression | None) -> tuple[Expression, ...]:
    match expression:
        case tree.Binary(left=left, right=right):
            return left, right
        case tree.Call(arguments=arguments):
            return arguments[:2]
    return ()


def _first_left_alone(mending: _Mending) -> Change | None:
    return _left_alone(mending, 0)


def _second_left_alone(mending: _Mending) -> Change | None:
    return _left_alone(mending, 1)


def _left_alone(mending: _Mending, place: int) -> Change | None:
    """Take the matrix off one of two vectors that meet, if the other one stands before it."""
    met, operands = mending.fault.parts.met, _operands(mending.fault.expression)
    if met is None or len(operands) != 2:
        return None
    whole = _followed(operands[place], mending.shader)
    inner = _uncut(whole)
    is_cut = inner is not whole
    if whole is None or not isinstance(inner, tree.Binary) or inner.operator != "*":
        return None
    sides = inner.left, inner.right
    vectors = [one for one in sides if not _is_matrix_written(one, mending.shader)]
    if len(vectors) != 1:
        return None
    bare = _homogeneous(vectors[0])
    if bare is not None and is_cut:
        return Change(whole.span, mending.bare(bare))
    return Change(whole.span, f"{mending.bare(vectors[0])}{'.xyz' if is_cut else ''}")


def _followed(written: Expression, shader: Shader) -> Expression | None:
    """Follow locals to what they are made of, and take what is inside of `normalize(…)`."""
    whole: Expression | None = written
    for _ in range(4):  # names of names
        while isinstance(whole, tree.Call) and whole.function == "normalize" and whole.arguments:
            whole = whole.arguments[0]
        if not isinstance(whole, tree.Name):
            break
        whole = _initial(shader, whole.name)
    return whole


def _uncut(vector: Expression | None) -> Expression | None:
    """Take what is inside of `vec3(…)` and before `.xyz`."""
    match vector:
        case tree.Call(function="vec3", arguments=(inner,)):
            return _uncut(inner)
        case tree.Member(of=inner, name="xyz" | "rgb"):
            return _uncut(inner)
    return vector


def _initial(shader: Shader, name: str) -> Expression | None:
    """Find what a local is made of, if one of that name is declared in the whole file."""
    found = [one for each in shader.functions for one in _locals(each.body) if one.name == name]
    return found[0].initial if len(found) == 1 else None


def _locals(body: Iterable[tree.Statement]) -> Iterator[tree.Variable]:
    for one in body:
        match one:
            case tree.Declaration(variables):
                yield from variables
            case tree.Choice(branches=branches):
                for branch in branches:
                    yield from _locals(branch)
            case tree.Loop(body=inner):
                yield from _locals(inner)
            case _:
                pass


def _is_matrix_written(expression: Expression, shader: Shader) -> bool:
    match expression:
        case tree.Name(name=name):
            types = {one.name: one.type for one in shader.variables}
            return is_matrix(types.get(name, "")) or matrix_named(name) is not None
        case tree.Member(name=name):
            return matrix_named(name) is not None
        case tree.Call(function=name):
            return is_matrix(name) or name in ("transpose", "inverse")
        case tree.Binary(operator="*", left=left, right=right):
            return _is_matrix_written(left, shader) and _is_matrix_written(right, shader)
    return False


def _eye_at_the_origin(mending: _Mending) -> Change | None:
    """Leave the eye of the world out of a difference in camera space, where it is the origin."""
    met, expression = mending.fault.parts.met, mending.fault.expression
    if met is None or not isinstance(expression, tree.Binary) or expression.operator != "-":
        return None
    if _is_eye(met[0]) and met[1].space is ShaderSpace.CAMERA:
        return Change(expression.span, f"-{mending.bare(expression.right)}")
    if _is_eye(met[1]) and met[0].space is ShaderSpace.CAMERA:
        return Change(expression.span, mending.text(expression.left))
    return None


def _is_eye(vector: Vector) -> bool:
    return vector.role is Role.EYE and vector.kind is Carried.POINT


def _normalised(mending: _Mending) -> Change | None:
    vector = mending.fault.parts.vector
    return None if vector is None else Change(vector.span, f"normalize({mending.text(vector)})")


def _three_components(mending: _Mending) -> Change | None:
    call = mending.fault.expression
    if not isinstance(call, tree.Call) or not call.arguments:
        return None
    four = "vec4" if mending.shader.language is ShaderLanguage.GLSL else "float4"
    return Change(call.span, f"{four}(normalize({mending.bare(call.arguments[0])}.xyz), 0.0)")


def _turned_round(mending: _Mending) -> Change | None:
    call = mending.fault.expression
    if not isinstance(call, tree.Call) or not call.arguments:
        return None
    arriving = call.arguments[0]
    if isinstance(arriving, tree.Unary):
        return Change(arriving.span, mending.text(arriving.operand))
    return Change(arriving.span, f"-{mending.bare(arriving)}")


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


_Mender = Callable[[_Mending], Change | None]
_MEETING: tuple[_Mender, ...] = (
    _eye_at_the_origin,
    _moved_light,
    _first_left_alone,
    _second_left_alone,
    _moved_first,
    _moved_second,
)
_MENDERS: dict[RuleId, tuple[_Mender, ...]] = {
    RuleId.NORMAL_BY_MATRIX: (_with_normal_matrix,),
    RuleId.NORMAL_WITH_W: (_with_normal_matrix,),
    RuleId.TANGENT_BY_NORMAL_MATRIX: (_without_normal_matrix,),
    RuleId.HALF_INVERSE_TRANSPOSE: (_whole_inverse_transpose,),
    RuleId.SPACES_MIXED: _MEETING,
    RuleId.LIGHT_BY_MODEL_VIEW: (_view_alone,),
    RuleId.WRONG_W: (_other_w,),
    RuleId.PRODUCT_ORDER: (_in_order,),
    RuleId.EYE_AT_ORIGIN: (_from_the_eye,),
    RuleId.STUCK_LIGHT: _MEETING,
    RuleId.NOT_NORMALISED: (_normalised,),
    RuleId.FOUR_COMPONENTS: (_three_components,),
    RuleId.REFLECTED_WRONG_WAY: (_turned_round,),
    RuleId.W_NOT_DIVIDED: (_divided,),
    RuleId.POWER_OF_NEGATIVE: (_clamped,),
    RuleId.HALFWAY_NOT_UNIT: (_normalised,),
}
_UNMENDED = {
    RuleId.NORMAL_BY_PROJECTION: "the source does not tell which matrix was meant",
    RuleId.INVERSE_IN_SHADER: "the inverse belongs into the program around the shader",
}
