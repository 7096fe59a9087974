"""A value as a notebook shows it: HTML with MathML, LaTeX, and the text of a terminal.

Colours are those of the notebook, light or dark: lines and tints are made of its own ink. Nothing
is loaded and nothing runs; the classes on the outside keep MathJax away from dollars in names.

A notebook of someone else, before it is trusted, is shown without styles, and JupyterLab drops the
elements of MathML, too. So it is the style that shows the formulas and hides the text beside them.
"""

from __future__ import annotations

from collections.abc import Sequence
from html import escape

from nmatrix.canvas.theme import PALETTES
from nmatrix.enums import Format, Theme
from nmatrix.errors import NMatrixError
from nmatrix.formula import Node, Row, Sign, Words
from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.exact import SAME
from nmatrix.output.formulas.latex import latex
from nmatrix.output.formulas.mathml import equation as displayed
from nmatrix.output.formulas.mathml import mathml
from nmatrix.output.formulas.spoken import spoken
from nmatrix.output.latex import Latex
from nmatrix.output.mathml import StyledMathML, prose
from nmatrix.output.write import OutputOptions, as_told, write
from nmatrix.report import Code, Displayed, Formula, Report, Tone, Verdict

MOST_ROWS = 200  # of a table: a notebook keeps what it shows
TONES = {
    tone: PALETTES[Theme.DARK].named[name]
    for tone, name in ((Tone.RIGHT, "right"), (Tone.WRONG, "wrong"))
}
FONTS = (
    "'STIX Two Math','Cambria Math','Latin Modern Math','Libertinus Math',"
    "'DejaVu Math TeX Gyre',math"
)
EQUALS = Sign(SAME)
INK, LINE, TINT = "currentColor", "rgba(128,128,128,.4)", "rgba(128,128,128,.12)"
STYLE = f"""<style>
.nmatrix[hidden] {{ display: block !important; }}
.nmatrix-untrusted {{ display: none !important; }}
.nmatrix {{ max-width: 60rem; line-height: 1.5; }}
.nmatrix, .nmatrix .quantity, .nmatrix .step {{ overflow-x: auto; overflow-y: hidden; }}
.nmatrix p, .nmatrix ul, .nmatrix pre, .nmatrix dl {{ margin: .4em 0; }}
.nmatrix p {{ white-space: pre-line; }}
.nmatrix sup {{ line-height: 0; }}
.nmatrix .heading {{ font-weight: bold; font-size: 1.1em; margin-top: .9em; }}
.nmatrix .verdict {{ border-left: .25em solid {LINE}; padding-left: .6em; font-weight: bold; }}
.nmatrix .right {{ border-color: {TONES[Tone.RIGHT]}; }}
.nmatrix .wrong {{ border-color: {TONES[Tone.WRONG]}; }}
.nmatrix .quantity {{ display: inline-flex; flex-direction: column; vertical-align: top;
  max-width: 100%; margin: .3em 2.2em .5em 0; }}
.nmatrix .quantity + .quantity > :only-child,
.nmatrix .quantity:has(+ .quantity) > :only-child {{ margin-top: 1.6em; }}
.nmatrix .about, .nmatrix caption, .nmatrix .remarks {{ opacity: .8; font-size: .92em; }}
.nmatrix math {{ font-family: {FONTS}; font-size: 1.08em; }}
.nmatrix math[display="block"] {{ width: fit-content; margin: .15em 0; padding: .1em 0; }}
.nmatrix mtd {{ math-style: normal; padding: .2em .45em; }}
.nmatrix .step {{ margin: .5em 0; }}
.nmatrix .proved, .nmatrix .unproved {{ margin: 0 0 0 1.2em; opacity: .8; font-size: .92em; }}
.nmatrix .proved::before {{ content: "\\2713\\00a0"; }}
.nmatrix .unproved {{ opacity: 1; font-weight: bold; }}
.nmatrix .framed {{ background: {TINT}; border-left: .25em solid {INK}; padding: .3em .8em; }}
.nmatrix .symbols div {{ display: flex; gap: 1em; }}
.nmatrix .symbols dd {{ margin: 0; }}
.nmatrix .wide {{ overflow: auto; max-height: 26em; margin: .5em 0; }}
.nmatrix table {{ border-collapse: collapse; margin: 0; font-size: .95em; }}
.nmatrix table caption, .nmatrix table th, .nmatrix table td {{ text-align: left;
  caption-side: top; white-space: normal; }}
.nmatrix table caption {{ padding: 0 0 .2em; }}
.nmatrix table th, .nmatrix table td {{ padding: .2em 1.2em .2em 0; vertical-align: top; }}
.nmatrix table tr:nth-child(n), .nmatrix table tbody tr:nth-child(n) {{ background: none; }}
.nmatrix table th {{ border-bottom: 1px solid {INK}; }}
.nmatrix table td {{ border-bottom: 1px solid {LINE}; }}
.nmatrix pre {{ background: {TINT}; padding: .5em .8em; overflow-x: auto; white-space: pre;
  line-height: 1.35; }}
.nmatrix pre code {{ background: none; padding: 0; }}
.nmatrix summary {{ cursor: pointer; opacity: .8; font-size: .92em; }}
</style>"""


def bundle(value: Displayed) -> dict[str, str | bytes]:
    """Write a value for every kind of notebook, and for a console.

    A value that has no matrix, such as a camera that stands in its own target, is shown with the
    sentence that says why.

    Examples
    --------
    >>> from nmatrix.linear.projection import Window
    >>> sorted(bundle(Window(-1, 1, -1, 1)))
    ['text/html', 'text/latex', 'text/plain']
    """
    try:
        report = value._repr_report_()
    except NMatrixError as error:
        report = Report("", {}, (Verdict(str(error), Tone.WRONG),))
    shown: dict[str, str | bytes] = {"text/plain": _text(value), "text/html": html(report)}
    if equations := _latex(report):
        shown["text/latex"] = equations
    return shown


def _text(value: Displayed) -> str:
    """Write what a console shows; Python refuses to spell integers of thousands of digits."""
    try:
        return str(value)
    except ValueError:
        return f"<{type(value).__name__}>"


def html(report: Report) -> str:
    r"""Write a report, its style, and the text that stands for it where styles are dropped.

    What is long is folded below its short form.

    Examples
    --------
    >>> shown = html(Report("", {}, (Verdict("It <fits>."),)))
    >>> print(*shown.splitlines()[-3:], sep="\n")
    <p class="verdict neutral">It &lt;fits&gt;.</p>
    </div>
    <pre class="nmatrix-untrusted">It &lt;fits&gt;.</pre>
    """
    told, how = as_told(report, OutputOptions(Format.MATHML))
    dialect, short = _Html(how), told.brief
    body = blocks_in(told.blocks if short is None else short.blocks, dialect)
    if short is not None and short.blocks != told.blocks:
        whole = blocks_in(told.blocks, dialect)
        body += f"\n<details><summary>All of it</summary>\n{whole}\n</details>"
    remarks = dialect.remarks(told.remarks) if told.remarks else ""
    parts = "\n".join(part for part in (body, remarks) if part)
    kind = "nmatrix tex2jax_ignore mathjax_ignore"
    text = escape(write(report, OutputOptions()).strip("\n"))
    beside = f'<pre class="nmatrix-untrusted">{text}</pre>'
    return f'{STYLE}\n<div class="{kind}" hidden="">\n{parts}\n</div>\n{beside}'


class _Html(StyledMathML):
    """How a notebook's output writes each kind of block."""

    def heading(self, text: str) -> str:
        """Write a heading that is none of the notebook's own."""
        return f'<p class="heading" role="heading" aria-level="4">{prose(text)}</p>'

    def verdict(self, text: str, tone: Tone) -> str:
        """Write the conclusion with a bar in the colour of its tone."""
        return f'<p class="verdict {tone}">{prose(text)}</p>'

    def matrix(self, key: str, title: str, equation: Node) -> str:
        """Write a matrix under its words; several stand side by side as far as there is room."""
        words, right = _parted(equation)
        return _quantity(prose(title or words), displayed(mathml(right), spoken(equation), key))

    def scalar(self, title: str, value: str) -> str:
        """Write a number under its words."""
        return _quantity(prose(title), f"<span>{value}</span>")

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write the first rows of a table, and how many more there are."""
        left = len(rows) - MOST_ROWS
        table = super().table(title, columns, rows[:MOST_ROWS])
        return table if left <= 0 else f"{table}<p>… and {left} more rows</p>"

    def remarks(self, remarks: Sequence[str]) -> str:
        """Write the remarks as a quiet list."""
        return super().remarks(remarks).replace("<ul>", '<ul class="remarks">', 1)


def _parted(equation: Node) -> tuple[str, Node]:
    """Part an equation from the words in front of it; a letter stays there."""
    items = equation.items if isinstance(equation, Row) else ()
    words: list[str] = []
    for i, one in enumerate(items):
        if one == EQUALS and words:
            return " ".join(words), Row(items[i + 1 :])
        if not isinstance(one, Words | Sign):
            break
        words.append(one.text)
    return "", equation


def _quantity(about: str, value: str) -> str:
    above = f'<span class="about">{about}</span>' if about else ""
    return f'<div class="quantity">{above}{value}</div>'


def _latex(report: Report) -> str:
    """Write a report as LaTeX that MathJax and KaTeX set as well: all commands are within dollars.

    Words stand between the equations as they are; only what TeX would misread has a backslash. It
    is empty where there is no mathematics.
    """
    told, how = as_told(report, OutputOptions(Format.LATEX))
    dialect = _Latex(how)
    beside_code = [block for block in told.blocks if not isinstance(block, Code)]
    if "$" not in blocks_in(beside_code, dialect):
        return ""
    parts = (blocks_in(told.blocks, dialect), dialect.remarks(told.remarks))
    return "\n\n".join(part for part in parts if part) + "\n"


class _Latex(Latex):
    """How the LaTeX of a notebook writes each kind of block."""

    def heading(self, text: str) -> str:
        """Write a heading as words of their own."""
        return self.words(text)

    def strong(self, text: str) -> str:
        """Write the conclusion as words of their own."""
        return self.words(text)

    def matrix(self, key: str, title: str, equation: Node) -> str:
        """Write an equation between dollars, its words above."""
        about = f"{self.words(title)}\n\n" if title else ""
        return f"{about}$$\n{latex(equation)}\n$$"

    def scalar(self, title: str, value: str) -> str:
        """Write a number and its unit as one formula: a double dollar would begin an equation."""
        return super().scalar(title, value.replace("$$", ""))

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table as an array of words and numbers."""
        head = [rf"\text{{{self.words(one)}}}" for one in columns]
        lines = [head, *([rf"\text{{{one}}}" for one in row] for row in rows[:MOST_ROWS])]
        body = " \\\\\n".join(" & ".join(line) for line in lines)
        array = f"$$\n\\begin{{array}}{{{'l' * len(columns)}}}\n{body}\n\\end{{array}}\n$$"
        return f"{self.words(title)}\n\n{array}" if title else array

    def formula(self, formula: Formula) -> str:
        """Write a formula between dollars."""
        return f"$$\n{latex(formula.tree)}\n$$"

    def code(self, language: str, text: str) -> str:
        """Write the lines of a program one by one."""
        lines = (one for one in text.splitlines() if one.strip())
        return "\n\n".join(rf"$\texttt{{{self.words(one)}}}$" for one in lines)

    def remarks(self, remarks: Sequence[str]) -> str:
        """Write each remark as a paragraph."""
        return "\n\n".join(map(self.words, remarks))
