"""The words before brackets: how many numbers in what groups they take, and what may be inside."""

from __future__ import annotations

import re

from nmatrix.enums import Layout
from nmatrix.errors import IllegalValueError, counted, quoted
from nmatrix.reading.brackets import Group, first_group, rows_of, whole_text
from nmatrix.reading.contents import SQUARES, Contents, Tokens, unreadable

# mat2x3 of GLSL is two columns of three, float2x3 of HLSL two rows of three: two groups of three.
_SIZED = re.compile(
    r"(?:glm::)?(?:[a-z]{0,5}mat|(?:simd_|min16)?(?:float|double|half|int|uint))"
    r"(?P<groups>[234])(?:x(?P<length>[234]))?[fh]?(?:<\w{1,20}>)?"
)
_SPLAT = re.compile(r"(?:glm::)?[a-z]{0,5}mat.*")  # mat3(2.0) is diagonal, float3x3(2.0) is not
_VECTOR = re.compile(
    r"(?:glm::)?(?:[diub]?[Vv]ec|[DIU]Vec|(?:simd_)?(?:float|double|half|int)|SIMD|Vector)"
    r"(?P<size>[234])A?[fdi]?(?:<\w{1,20}>)?|FPlane|(?:DirectX::)?XMVectorSet"
)
_PART = re.compile(r"D?Mat[23]A?|Basis|List|Array|\([0-9]{1,2}\)")  # of a larger value
# Words that take the numbers of a square one by one.
_SQUARE = re.compile(
    r"(?:QMatrix|XMFLOAT|btMatrix|L?Matrix|M)(?P<side>[34])(?:[xX][34]A?|[34])?[df]?"
    r"|matrix3d|XMMATRIX|XMMatrixSet|MMatrix|FromValues|set|Basis"
)
_PLANE, _SPACE = 6, 12  # numbers of a map of the plane in CSS, and of Godot's Transform3D
_TAKES = {"matrix": _PLANE, "Transform3D": _SPACE, "Transform": _SPACE, "matrix3d": 16, "Basis": 9}
_ARRAY = re.compile(r"(?:vec[234]|float)\[[0-9]{0,2}\]")  # of columns, or of numbers
_NAME = r"\b(?P<name>[A-Za-z_][A-Za-z0-9_]{0,200})"
_DECLARED = rf"{_NAME}(?:\[[0-9]{{0,2}}\])?[ \t]*=[ \t]*(?=(?:glm::|np\.|numpy\.)?(?:%s)[ \t\n]*\()"
GLSL_DECLARED = re.compile(
    _DECLARED % r"mat[234](?:x[234])?|vec[234](?:\[[0-9]{0,2}\])?|float\[[0-9]{0,2}\]"
)
NUMPY_DECLARED = re.compile(_DECLARED % "array|matrix")
JS_DECLARED = re.compile(rf"\b(?:const|let|var)[ \t]+{_NAME}[ \t]*=[ \t]*(?=\[)")
_BEFORE_BRACKETS = re.compile(r"\A[^\[({]*")
_NAMESPACE = re.compile(r".*[.:]")
MOST_DECLARED = 1000
_STATED = re.compile(r"^(?:#|//).*layout: (row-major|column-major)", re.MULTILINE)
# nmatrix says in a comment that its matrices are columns, or writes uniforms in comments.
_OURS = re.compile(r"^// (?:nmatrix [^\n]*column-major|uniform )", re.MULTILINE)
# NumPy 2 prints the numbers of a plain list as np.float64(1.0).
_SCALAR = re.compile(r"\b(?:np|numpy)\.(?:float|int)[0-9]{2}\(([^()]{1,60})\)")
_COMMENT = re.compile(r"^[ \t]*//", re.MULTILINE)
LONGEST_PRINT = 10_000  # characters of one matrix in NumPy's scalars


def bracketed(text: str, source: str) -> Contents:
    """Read one value in brackets: a list of lists, a constructor, a struct.

    Raises
    ------
    IllegalValueError
        If a word before a bracket is unknown, or takes another count of numbers.

    Examples
    --------
    >>> bracketed("mat2(vec2(1.0), vec2(2.0))", "x").quantities
    {'': [['1.0', '1.0'], ['2.0', '2.0']]}
    """
    plain = _SCALAR.sub(r"\1", text) if len(text) <= LONGEST_PRINT else text
    return Contents({"": laid_out(whole_text(plain, source), source)})


def declared(text: str, source: str) -> Contents:
    """Read the value in brackets behind a declared name.

    Examples
    --------
    >>> declared("matrix2d m = ((1, 0), (0, 2))", "x").quantities
    {'': [['1', '0'], ['0', '2']]}
    """
    return bracketed(_BEFORE_BRACKETS.sub("", text), source)


def glsl_program(text: str, source: str) -> Contents:
    """Read the declared matrices and vectors of a shader by name.

    Declarations inside `//` comments count: nmatrix writes the uniforms' values there.

    Raises
    ------
    IllegalValueError
        If none of them is made of numbers.

    Examples
    --------
    >>> glsl_program("const mat2 m = mat2(1, 2, 3, 4);", "x").quantities
    {'m': [['1', '2'], ['3', '4']]}
    """
    layout = Layout.COLUMN_MAJOR if _OURS.search(text) else None
    return Contents(_declared(GLSL_DECLARED, _COMMENT.sub("", text), source), layout)


def numpy_program(text: str, source: str) -> Contents:
    """Read the arrays of a Python text by name, in the layout that a comment of it states.

    Examples
    --------
    >>> numpy_program("a = np.array([[1., 2.]])", "x").quantities
    {'a': [['1.', '2.']]}
    """
    return Contents(_declared(NUMPY_DECLARED, text, source), _stated_layout(text))


def js_program(text: str, source: str) -> Contents:
    """Read the lists of numbers of a JavaScript text by name, in the layout that a comment states.

    Examples
    --------
    >>> js_program("const a = [[1, 0], [0, 1]];", "x").quantities
    {'a': [['1', '0'], ['0', '1']]}
    """
    return Contents(_declared(JS_DECLARED, text, source), _stated_layout(text))


def _stated_layout(text: str) -> Layout | None:
    stated = _STATED.search(text)
    return Layout(stated[1]) if stated else None


def _declared(sign: re.Pattern[str], text: str, source: str) -> dict[str, Tokens]:
    quantities: dict[str, Tokens] = {}
    refusals: list[IllegalValueError] = []
    for found in sign.finditer(text):
        if len(quantities) > MOST_DECLARED or len(refusals) > MOST_DECLARED:
            raise unreadable(source, f"it declares more than {MOST_DECLARED} matrices")
        try:
            group, _ = first_group(text, source, found.end())
            quantities[found["name"]] = laid_out(group, source)
        except IllegalValueError as refusal:
            # A program also declares what it computes; that is no literal.
            refusals.append(refusal)
    if refusals and not quantities:
        raise refusals[0]
    return quantities


def laid_out(group: Group, source: str) -> Tokens:
    """Lay out the numbers of a value in the groups that its word says, or that it is written in.

    Examples
    --------
    >>> laid_out(whole_text("mat2(2.0)", "x"), "x")
    [['2.0', '0'], ['0', '2.0']]
    """
    vector = _VECTOR.fullmatch(group.head)
    if vector is not None:
        return [_filled(group, int(vector["size"] or 4), source)]
    if group.groups and _ARRAY.fullmatch(group.head):
        return [row for column in group.groups for row in laid_out(column, source)]
    for inner in group.groups:
        _check_part(inner, source)
    sized = _SIZED.fullmatch(group.head)
    if sized is not None:
        count = int(sized["groups"])
        return _sized(group, count, int(sized["length"] or count), source)
    rows = rows_of(group, source)
    if group.groups:
        return rows
    return _of_word(group.head, [one for row in rows for one in row], source) or rows


def _of_word(head: str, numbers: list[str], source: str) -> Tokens:
    """Lay out the numbers that a word takes one by one; nothing for a word that leaves it open."""
    word = _NAMESPACE.sub("", head)
    square = _SQUARE.fullmatch(word)
    side = 0 if square is None else int(square["side"] or SQUARES.get(len(numbers), 4))
    takes = _TAKES.get(word, side * side)
    if takes and len(numbers) != takes:
        raise _miscounted(word, takes, len(numbers), source)
    if takes == _PLANE:
        a, b, c, d, e, f = numbers
        return [[a, b, "0", "0"], [c, d, "0", "0"], ["0", "0", "1", "0"], [e, f, "0", "1"]]
    if takes == _SPACE:
        return [[*numbers[3 * row : 3 * row + 3], numbers[9 + row]] for row in range(3)]
    return [numbers[at : at + side] for at in range(0, takes, side or 1)]


def _sized(group: Group, count: int, length: int, source: str) -> Tokens:
    if not group.groups and len(group.numbers) == 1 and _SPLAT.fullmatch(group.head):
        number = group.numbers[0]
        return [[number if i == j else "0" for j in range(length)] for i in range(count)]
    flat = list(group.numbers)
    if group.groups:
        if flat:
            raise unreadable(source, f"{quoted(flat[0])} stands between brackets")
        flat = [number for one in group.groups for row in laid_out(one, source) for number in row]
    if len(flat) != count * length:
        raise _miscounted(group.head, count * length, len(flat), source)
    return [flat[start : start + length] for start in range(0, len(flat), length)]


def _filled(group: Group, count: int, source: str) -> list[str]:
    """List the numbers of a vector; a single one is repeated."""
    numbers = [number for row in rows_of(group, source) for number in row]
    if len(numbers) == 1:
        return numbers * count
    if len(numbers) != count:
        raise _miscounted(group.head, count, len(numbers), source)
    return numbers


def _check_part(group: Group, source: str) -> None:
    if group.head and not (_VECTOR.fullmatch(group.head) or _PART.fullmatch(group.head)):
        raise unreadable(source, f"{group.head}(…) is neither a number nor a vector")
    if group.head.startswith("Array") and len(group.numbers) == 1 and not group.groups:
        why = "the console folded its rows: Array(4) stands for four numbers"
        raise unreadable(source, why, "print JSON.stringify(m)")
    for inner in group.groups:
        _check_part(inner, source)


def _miscounted(head: str, takes: int, got: int, source: str) -> IllegalValueError:
    return unreadable(
        source, f"{head} takes {counted(takes, 'number')}, got {got}", "give them all"
    )
