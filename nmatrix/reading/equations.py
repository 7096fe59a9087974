r"""Matrices in the equations of a document: LaTeX and Markdown, Typst, MathML.

nmatrix writes the key of a quantity beside its equation. Where both exact numbers and decimals are
wanted it writes the matrix twice, A = … ≈ …: what stands behind the second sign says the same once
more, and is passed over.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from dataclasses import dataclass
from html import unescape

from nmatrix.enums import Layout
from nmatrix.reading.contents import Contents, Tokens, cut_off
from nmatrix.reading.roots import CLOSE, OPEN

LONGEST = 40_000  # characters of a matrix
DEEPEST = 4  # fractions and roots inside of one another

_POWER = re.compile(r"×10\^[({⟮]?(-?[0-9]{1,6})[)}⟯]?")
_RATIO = re.compile(rf"([+-]?){OPEN}([+-]?[0-9]+){CLOSE}/{OPEN}([0-9]+){CLOSE}")


@dataclass(frozen=True)
class Markup:
    """How a format marks matrices: where each begins and ends, and what its cells are.

    `begin` matches a key, named `key`, or the beginning of a matrix. `again` matches from the end
    of a matrix to the beginning of another one that is the same. `end` finds where a matrix ends
    and how that is called, or -1.
    """

    begin: re.Pattern[str]
    again: re.Pattern[str]
    end: Callable[[str, re.Match[str]], tuple[int, str]]
    rows: Callable[[str], Tokens]

    def read(self, text: str, source: str) -> Contents:
        """Read the matrices of a document by their keys.

        Raises
        ------
        IllegalValueError
            If a matrix is not complete.
        """
        quantities: dict[str, Tokens] = {}
        name, is_again = "", False
        found = self.begin.search(text)
        while found:
            after = found.end()
            if found["key"] is not None:
                name = unescape(found["key"])
            else:
                rows, end = self.matrix(text, found, source)
                if not is_again:
                    quantities.setdefault(name, rows)
                again = self.again.match(text, end)
                name, after, is_again = "", again.end() if again else end, again is not None
            found = self.begin.search(text, after)
        return Contents(quantities, Layout.ROW_MAJOR)

    def matrix(self, text: str, found: re.Match[str], source: str) -> tuple[Tokens, int]:
        """Read the matrix that begins with a match, and find where it ends."""
        end, called = self.end(text, found)
        if end < 0 or end - found.end() > LONGEST:
            raise cut_off(source, f"before {called}")
        return self.rows(text[found.end() : end]), end


def _rows(cells: list[list[str]]) -> Tokens:
    rows = [[_plain(cell) for cell in row] for row in cells]
    return [row for row in rows if any(row)]


def _plain(cell: str) -> str:
    """Write a cell as one types it: 1×10^(-7) is 1e-7, a fraction of whole numbers p/q."""
    tight = _POWER.sub(r"e\1", cell.replace("−", "-").replace("- ", "-").strip())
    ratio = _RATIO.fullmatch(tight)
    return f"{ratio[1]}{ratio[2]}/{ratio[3]}" if ratio else tight


def _resolved(text: str, *meanings: tuple[re.Pattern[str], str]) -> str:
    """Write fractions and roots by signs, the innermost first."""
    for _ in range(DEEPEST):
        for sign, written in meanings:
            text = sign.sub(written, text)
    return text


# ---- LaTeX, and Markdown with LaTeX between dollars ----

_MATRIX = r"\\begin\{(?P<kind>[bpvBV]?matrix|smallmatrix|array)\}(?:\{[lcr|]{1,20}\})?"
LATEX_MATRIX = re.compile(_MATRIX)
_ONE = r"[ ]?(?:(?P<{0}>[0-9])|\{{(?P<{0}s>[^{{}}]{{1,400}})\}})"  # \frac13 is \frac{1}{3}
_LATEX_FRACTION = re.compile(rf"\\[dt]?frac{_ONE.format('a')}{_ONE.format('b')}")
_LATEX_ROOT = re.compile(rf"\\sqrt{_ONE.format('a')}")
# A shell takes one of the two backslashes between double quotes.
_LATEX_ROW_END = re.compile(r"\\\\(?:\[[^\[\]]{1,12}\])?|\\(?=\s|\Z)")
_LATEX_SIGNS = ((re.compile(r"[ ]?\\times[ ]?"), "×"), (re.compile(r"[ ]?\\cdot[ ]?"), "·"))


def _latex_end(text: str, found: re.Match[str]) -> tuple[int, str]:
    called = rf"\end{{{found['kind']}}}"
    return text.find(called, found.end()), called


def _latex_rows(body: str) -> Tokens:
    plain = " ".join(body.split()).replace("·10^", "×10^")
    for sign, written in _LATEX_SIGNS:
        plain = sign.sub(written, plain)
    plain = _resolved(
        plain.replace("·10^", "×10^"),
        (_LATEX_ROOT, rf"√{OPEN}\g<a>\g<as>{CLOSE}"),
        (_LATEX_FRACTION, rf"{OPEN}\g<a>\g<as>{CLOSE}/{OPEN}\g<b>\g<bs>{CLOSE}"),
    )
    rows = _LATEX_ROW_END.split(plain)
    return _rows([[one.strip(" {}$") for one in row.split("&")] for row in rows])


LATEX = Markup(
    re.compile(rf"^(?:%|<!--) key: (?P<key>\S{{1,200}})(?: -->)?[ \t]*$|{_MATRIX}", re.MULTILINE),
    re.compile(rf"\\end\{{\w{{1,20}}\}}\s*(?:\\approx|=)\s*(?={_MATRIX})"),
    _latex_end,
    _latex_rows,
)


# ---- Typst ----

_MAT = r"(?<![\w.])mat\(\s*(?:delim:\s*(?:\"[^\"\n]{0,3}\"|#?none)\s*,)?"
TYPST_MATRIX = re.compile(rf"\A(?:\$\s*)?{_MAT}|\$[^$]{{0,200}}{_MAT}")
_FLAT = r"\s*([^(),;]{1,400}?)\s*"
_TYPST_FRACTION = re.compile(rf"frac\({_FLAT},{_FLAT}\)")
_TYPST_ROOT = re.compile(rf"sqrt\({_FLAT}\)")
_TYPST_POWER = re.compile(rf"\s*(?:times|dot)\s+10\^\({_FLAT}\)")
_NESTED = r"[^()]*+"
for _ in range(DEEPEST):
    _NESTED = rf"[^()]*+(?:\({_NESTED}\)[^()]*+)*+"
_TYPST_BODY = re.compile(_NESTED)


def _typst_end(text: str, found: re.Match[str]) -> tuple[int, str]:
    body = _TYPST_BODY.match(text, found.end(), found.end() + LONGEST)
    end = body.end() if body else len(text)
    return (end if text[end : end + 1] == ")" else -1), ")"


def _typst_rows(body: str) -> Tokens:
    plain = _resolved(
        " ".join(body.split()),
        (_TYPST_ROOT, rf"√{OPEN}\1{CLOSE}"),
        (_TYPST_FRACTION, rf"{OPEN}\1{CLOSE}/{OPEN}\2{CLOSE}"),
        (_TYPST_POWER, r"×10^\1"),
    )
    return _rows([[one.strip() for one in row.split(",")] for row in plain.split(";")])


TYPST = Markup(
    re.compile(rf"^// key: (?P<key>\S{{1,200}})[ \t]*$|{_MAT}", re.MULTILINE),
    re.compile(rf"\)\s*(?:approx|=)\s*(?={_MAT})"),
    _typst_end,
    _typst_rows,
)


# ---- MathML ----

_TABLE = r"<mtable\b[^<>]{0,200}>"
_KEY = r"<math\b[^<>]{0,200}?\sdata-key=\"(?P<key>[^\"]{1,200})\""
_BETWEEN = r"(?:<[^<>]{1,200}>|[\s\[\]()|])*"
_PLAIN_TAGS = ("mtd", "mrow", "mn", "mo", "mi", "mtext", "mstyle", "mpadded")
_MARKUP = re.compile(r"<(?P<close>/?)(?P<tag>\w{1,20})[^<>]{0,200}>|(?P<text>[^<]+)")


def _mathml_end(text: str, found: re.Match[str]) -> tuple[int, str]:
    return text.find("</mtable>", found.end()), "</mtable>"


def _mathml_rows(body: str) -> Tokens:
    rows = [row.split("<mtd")[1:] for row in body.split("<mtr")[1:]]
    return _rows([[_linear(f"<mtd{cell}") for cell in row] for row in rows])


def _linear(cell: str) -> str:
    """Write elements on one line."""
    open_: list[tuple[str, list[str]]] = [("", [])]
    for piece in _MARKUP.finditer(cell):
        if piece["text"]:
            open_[-1][1].append(unescape(piece["text"]).strip())
        elif piece[0].endswith("/>"):
            continue
        elif not piece["close"]:
            open_.append((piece["tag"], []))
        elif len(open_) > 1:
            tag, inner = open_.pop()
            open_[-1][1].append(_element(tag, inner))
    return "".join(open_[0][1])


def _element(tag: str, inner: list[str]) -> str:
    if tag == "mfrac" and len(inner) == 2:
        return f"{OPEN}{inner[0]}{CLOSE}/{OPEN}{inner[1]}{CLOSE}"
    if tag == "msup" and len(inner) == 2:
        return f"{inner[0]}^{inner[1]}"
    joined = "".join(inner)
    if tag == "msqrt":
        return f"√{OPEN}{joined}{CLOSE}"
    return joined if tag in _PLAIN_TAGS else f"<{tag}>"  # which is no number


MATHML = Markup(
    re.compile(rf"{_KEY}|{_TABLE}"),
    re.compile(rf"</mtable>{_BETWEEN}[=≈]{_BETWEEN}(?={_TABLE})"),
    _mathml_end,
    _mathml_rows,
)
