"""What to print where the terminal knows ASCII only."""

from __future__ import annotations

from nmatrix.output.options import Charset

_ASCII = str.maketrans(
    {
        "−": "-",
        "–": "-",
        "—": "-",
        "·": "*",
        "×": "x",
        "÷": "/",
        "√": "sqrt",
        "°": " deg",
        "±": "+-",
        "≤": "<=",
        "≥": ">=",
        "≠": "!=",
        "≈": "~",
        "→": "->",
        "⇒": "=>",
        "⇔": "<=>",
        "ᵀ": "^T",
        "⁻": "^-",
        "¹": "1",
        "²": "^2",
        "³": "^3",
        "⁴": "^4",
        "∞": "inf",
        "‖": "|",
        "⊥": " perpendicular to ",
        "∈": " in ",
        "∉": " not in ",
        "…": "...",
        "’": "'",
        "“": '"',
        "”": '"',
        "α": "alpha",
        "β": "beta",
        "γ": "gamma",
        "δ": "delta",
        "ε": "epsilon",
        "θ": "theta",
        "κ": "kappa",
        "λ": "lambda",
        "μ": "mu",
        "π": "pi",
        "σ": "sigma",
        "τ": "tau",
        "φ": "phi",
        "⎡": "[",
        "⎢": "[",
        "⎣": "[",
        "⎤": "]",
        "⎥": "]",
        "⎦": "]",
        "│": "|",
        "─": "-",
        "•": "*",
        "✓": "ok",
        "✗": "(wrong)",
        "₁": "1",
        "₂": "2",
        "₃": "3",
    }
)


def spelled(text: str, charset: Charset) -> str:
    """Return a text in the characters that the terminal has.

    Examples
    --------
    >>> spelled("A⁻ᵀ is 90° − θ", Charset.ASCII)
    'A^-T is 90 deg - theta'
    """
    if charset is Charset.UNICODE or text.isascii():
        return text
    known = text.replace("⁻ᵀ", "^-T").translate(_ASCII)
    return known.encode("ascii", "backslashreplace").decode("ascii")
