r"""A formula as LaTeX mathematics, for pdflatex with amsmath.

Two factors side by side need a thin space, `\,`, where one of them is in brackets.
"""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.formula import (
    APART,
    FUNCTIONS,
    OPERATORS,
    Fence,
    Grid,
    Name,
    Node,
    Numeral,
    Power,
    Quotient,
    Root,
    Row,
    Sign,
    Words,
)
from nmatrix.output.formulas.latex_words import MATHEMATICS, escaped

SIGNS = {  # a sign that is missing here is a fault of ours, and not to be printed as it is
    APART: r",\; ",
    ",": ", ",
    "=": " = ",
    "+": " + ",
    "−": " - ",
    "-": " - ",
    "·": r" \cdot ",
    "×": r" \times ",
    "/": " / ",
    "≠": r" \neq ",
    "≤": r" \le ",
    "≥": r" \ge ",
    "≈": r" \approx ",
    "<": " < ",
    ">": " > ",
    "→": r" \to ",
    "←": r" \leftarrow ",
    "↔": r" \leftrightarrow ",
    "⇒": r" \;\Rightarrow\; ",
    "⇔": r" \;\Leftrightarrow\; ",
    "°": r"^\circ",
}
EXPONENTS = str.maketrans({"⊤": r"\mathsf T", "′": r"\prime", "−": "-"})


def latex(node: Node) -> str:  # noqa: C901  # one branch for each kind of node
    r"""Print a tree.

    Examples
    --------
    >>> from nmatrix.formula import parse
    >>> print(latex(parse("A⁻ᵀ = C / det A")))
    A^{-\mathsf T} = \frac{C}{\det A}
    """
    match node:
        case Name():
            found = _name(node)
        case Numeral(text):
            found = text
        case Words(text):
            found = rf"\text{{{escaped(text)}}}"
        case Sign(text):
            found = SIGNS[text]
        case Row(items):
            found = _row(items)
        case Power(base, exponent):
            below = f"{{{latex(base)}}}" if isinstance(base, Power) else latex(base)
            found = f"{below}^{{{exponent.translate(EXPONENTS)}}}"
        case Quotient(top, bottom):
            found = rf"\frac{{{latex(top)}}}{{{latex(bottom)}}}"
        case Root(inside):
            found = rf"\sqrt{{{latex(inside)}}}"
        case Fence(inside, bars):
            found = f"|{latex(inside)}|" if bars else f"({latex(inside)})"
        case Grid(rows, bar):
            cells = [list(map(latex, row)) for row in rows]
            found = _augmented(cells, bar) if bar else bmatrix(cells)
    return found


def bmatrix(cells: Sequence[Sequence[str]]) -> str:
    r"""Put printed cells into an amsmath `bmatrix`.

    Examples
    --------
    >>> print(bmatrix([["1", "0"], ["0", "2"]]))
    \begin{bmatrix}
      1 & 0 \\
      0 & 2
    \end{bmatrix}
    """
    return f"\\begin{{bmatrix}}\n{_body(cells)}\n\\end{{bmatrix}}"


def _augmented(cells: Sequence[Sequence[str]], bar: int) -> str:
    """Put printed cells into square brackets, with a line behind so many columns."""
    columns = f"{'c' * bar}|{'c' * (len(cells[0]) - bar)}"
    begin, end = rf"\left[\begin{{array}}{{{columns}}}", r"\end{array}\right]"
    return f"{begin}\n{_body(cells)}\n{end}"


def _body(cells: Sequence[Sequence[str]]) -> str:
    return " \\\\\n".join("  " + " & ".join(row) for row in cells)


def _name(name: Name) -> str:
    if name.text in OPERATORS:
        return f"\\{name.text}"
    if name.text in FUNCTIONS:
        return rf"\operatorname{{{name.text}}}"
    letter, below = name.letter_and_index
    if len(letter) > 1:
        return rf"\mathrm{{{letter}}}"
    return MATHEMATICS.get(letter, letter) + (f"_{{{below}}}" if below else "")


def _row(items: Sequence[Node]) -> str:
    """Print pieces side by side; a minus behind another sign belongs to what follows it."""
    found = ""
    before: Node = Sign("=")
    for item in items:
        printed = latex(item)
        if isinstance(before, Sign):
            found += printed.strip()
        else:
            found += printed if isinstance(item, Sign) else _between(before, item) + printed
        before = item
    return found


def _between(left: Node, right: Node) -> str:
    if isinstance(left, Name) and left.text in FUNCTIONS and isinstance(right, Fence):
        return ""
    return r"\," if _is_bracketed(left) or _is_bracketed(right) else " "


def _is_bracketed(node: Node) -> bool:
    return isinstance(node, Fence | Grid) or (isinstance(node, Power) and _is_bracketed(node.base))
