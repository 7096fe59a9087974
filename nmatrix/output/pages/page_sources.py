"""A document as source: LaTeX for every distribution of TeX, Markdown for wikis and notebooks."""

from __future__ import annotations

from collections.abc import Sequence

from nmatrix.output import latex, markdown
from nmatrix.output.documents import Cells, blocks_in
from nmatrix.output.formulas.latex import latex as mathematics
from nmatrix.output.formulas.latex_words import escaped as latex_escaped
from nmatrix.output.pages.document import (
    ANSWER_HIGH,
    ANSWER_WIDE,
    DOTS_APART,
    Document,
    Field,
    Paper,
    shares,
)
from nmatrix.output.write import OutputOptions
from nmatrix.report import Blank, Figure, Formula, Task

LONG = 30  # characters from which a cell is a sentence
LINE_TO_FILL = "____________"
SIZES = {Paper.A4: "a4paper", Paper.LETTER: "letterpaper"}
PACKAGES = r"""\usepackage[utf8]{inputenc}
\usepackage[T1]{fontenc}
\IfFileExists{lmodern.sty}{\usepackage{lmodern}}{}
\usepackage{amsmath,amssymb,graphicx,array,longtable,color}"""
ROOM_LINE = r"\vfil\dottedline"
LOOK = rf"""\definecolor{{tint}}{{rgb}}{{0.94,0.94,0.94}}
\definecolor{{soft}}{{rgb}}{{0.23,0.23,0.23}}
\makeatletter
\renewcommand{{\normalsize}}{{\@setfontsize\normalsize{{10.5}}{{13.5}}%
  \abovedisplayskip 6pt plus 2pt minus 3pt \belowdisplayskip \abovedisplayskip
  \abovedisplayshortskip 2pt plus 2pt \belowdisplayshortskip 5pt plus 2pt\relax}}
\renewcommand{{\section}}{{\@startsection{{section}}{{1}}{{0pt}}{{-14pt plus -4pt}}{{4pt}}%
  {{\large\sffamily\bfseries\raggedright}}}}
\renewcommand{{\@oddfoot}}{{\footnotesize\color{{soft}}\sheetfoot\hfil\thepage}}
\makeatother
\normalsize
\setlength{{\parindent}}{{0pt}}
\setlength{{\parskip}}{{4pt plus 1pt}}
\renewcommand{{\arraystretch}}{{1.25}}
\setlength{{\LTpre}}{{4pt}}
\setlength{{\LTpost}}{{4pt}}
\newcommand{{\columnhead}}[1]{{{{\footnotesize\sffamily\bfseries #1}}}}
\newcommand{{\fillin}}[1]{{\rule[-0.5mm]{{#1}}{{0.4pt}}}}
\newcommand{{\answer}}{{\rule{{0pt}}{{{ANSWER_HIGH}mm}}\rule[-1mm]{{{ANSWER_WIDE}mm}}{{0.4pt}}}}
\newlength{{\inside}}
\newcommand{{\dottedline}}{{\hbox to\inside{{\leaders\hbox to {DOTS_APART}mm{{\hss.\hss}}\hfil}}}}
\newcommand{{\room}}{{\setlength{{\inside}}{{\linewidth}}\addtolength{{\inside}}{{-2\fboxsep}}%
  \addtolength{{\inside}}{{-2\fboxrule}}%
  \fbox{{\vbox to \roomhigh{{{ROOM_LINE * 6}\vfil}}}}\par}}
\newcommand{{\points}}[1]{{%
  \fbox{{\rule{{0pt}}{{9pt}}\hspace{{9mm}}\small\sffamily / #1\hspace{{2mm}}}}}}
\newenvironment{{task}}[2]{{\par\addvspace{{14pt}}\begin{{minipage}}{{\linewidth}}%
  \setlength{{\parskip}}{{2pt}}{{\large\sffamily\bfseries #1}}\hfill\points{{#2}}\par}}%
  {{\end{{minipage}}\par}}
\newsavebox{{\framedbox}}
\newenvironment{{framed}}{{\par\addvspace{{6pt}}\begin{{lrbox}}{{\framedbox}}%
  \begin{{minipage}}{{\dimexpr\linewidth-2\fboxsep\relax}}\setlength{{\parskip}}{{4pt}}}}%
  {{\end{{minipage}}\end{{lrbox}}\colorbox{{tint}}{{\usebox{{\framedbox}}}}\par}}"""


def tex(document: Document) -> bytes:
    """Write the document as LaTeX source."""
    body = blocks_in(document.blocks, LatexPage(OutputOptions()))
    source = rf"""\documentclass[11pt,{SIZES[document.paper]}]{{article}}
{PACKAGES}
\usepackage[hmargin=18mm,top=11mm,bottom=18mm,footskip=8mm]{{geometry}}
\newcommand{{\roomhigh}}{{{document.paper.room}mm}}
\newcommand{{\sheetfoot}}{{{latex_escaped(document.foot)}}}
{LOOK}
\begin{{document}}
{_head(document.head)}{{\Large\sffamily\bfseries {latex_escaped(document.title)}\par}}

{body}
\end{{document}}
"""
    return source.encode("utf-8", "replace")


def _head(fields: Sequence[Field]) -> str:
    """Write the line above the title, whose last field stands at the right."""
    if not fields:
        return ""
    *first, last = map(_latex_field, fields)
    parts = r"\quad ".join(first)
    return f"{{\\small\\sffamily {parts}\\hfill {last}\\par}}\n\\vspace{{-6pt}}\\hrulefill\\par\n"


def _latex_field(field: Field) -> str:
    label = f"{latex_escaped(field.label)} " if field.label else ""
    return label + (latex_escaped(field.value) or rf"\fillin{{{field.room}mm}}")


class LatexPage(latex.Latex):
    """How a page of LaTeX writes each kind of block."""

    def paragraph(self, text: str) -> str:
        """Write a paragraph; one that leads to something stays on the page of it."""
        return latex_escaped(text) + r"\nopagebreak" * text.endswith(":")

    def table(self, title: str, columns: Sequence[str], rows: Cells) -> str:
        """Write a table with rules under its head and its end; long cells wrap, and pages turn."""
        head = " & ".join(rf"\columnhead{{{latex_escaped(column)}}}" for column in columns)
        body = "\n".join(f"{' & '.join(row)} \\\\" for row in rows)
        about = f"\\textbf{{{latex_escaped(title)}}}\n\n" if title else ""
        if all(len(cell) <= LONG or cell.startswith("$") for row in rows for cell in row):
            shape = f"@{{}}{'l' * len(columns)}@{{}}"
            whole = f"{head} \\\\ \\hline\n{body} \\hline"
            return f"{about}\\begin{{tabular}}{{{shape}}}\n{whole}\n\\end{{tabular}}"
        shape = "".join(map(_wrapping, shares(columns, rows)))
        whole = f"{head} \\\\ \\hline \\endhead\n{body} \\hline"
        return f"{about}\\begin{{longtable}}{{@{{}}{shape}@{{}}}}\n{whole}\n\\end{{longtable}}"

    def inline_formula(self, formula: Formula) -> str:
        """Write a formula among words."""
        return f"${mathematics(formula.tree)}$"

    def step(self, formula: Formula, because: str, *, verified: bool) -> str:
        """Write one line of a derivation, with its reason on the same page."""
        mark = r"$\checkmark$" if verified else "not proved:"
        reason = rf"\hspace*{{4mm}}{{\color{{soft}}{mark} {latex_escaped(because)}}}"
        return f"{self.formula(formula)}\\nopagebreak\n{reason}"

    def code(self, language: str, text: str) -> str:
        """Write program text, small enough for the lines that nmatrix prints."""
        return f"{{\\footnotesize\n{super().code(language, text)}\n}}"

    def figure(self, figure: Figure) -> str:
        """Write a picture above its caption; its alternative text stands in a comment."""
        comment = latex_escaped(" ".join(figure.alternative.split()))
        include = rf"\includegraphics[width=\linewidth]{{{figure.path}}}"
        title = rf"\textbf{{{latex_escaped(figure.title)}.}} " if figure.title else ""
        caption = rf"{{\small {title}{latex_escaped(figure.caption)}}}"
        return f"% alt: {comment}\n{include}\\nopagebreak\n\n{caption}"

    def symbols(self, meanings: Sequence[tuple[str, str]]) -> str:
        """Write letters and their words in two columns, read downwards."""
        half = (len(meanings) + 1) // 2
        pairs = zip(meanings[:half], (*meanings[half:], ("", "")), strict=False)
        rows = "\n".join(f"{' & '.join((*left, *right))} \\\\" for left, right in pairs)
        shape = r"@{}lp{0.43\linewidth}lp{0.43\linewidth}@{}"
        return f"\\begin{{tabular}}{{{shape}}}\n{rows}\n\\end{{tabular}}"

    def framed(self, body: str) -> str:
        """Put a tint behind some blocks."""
        return f"\\begin{{framed}}\n{body}\n\\end{{framed}}"

    def blank(self, blank: Blank) -> str:
        """Leave dotted room to work, and lines for the answer."""
        room = "\\room\n" * blank.has_room
        if blank.names:
            names = (f"${name} =$ " if name else "Answer " for name in blank.names)
            return room + r"\quad ".join(f"{name}\\answer" for name in names)
        row = " & ".join([r"\answer"] * blank.columns)
        rows = " \\\\\n".join([row] * blank.rows)
        lines = f"\\begin{{tabular}}{{|{'c' * blank.columns}|}}\n{rows}\n\\end{{tabular}}"
        return f"{room}{{\\renewcommand{{\\arraystretch}}{{1}}%\n{lines}}}"

    def task(self, task: Task, body: str) -> str:
        """Write an exercise that stays on its page, with a box for its points."""
        most = "" if task.points is None else str(task.points)
        title = latex_escaped(task.title)
        return f"\\begin{{task}}{{{title}}}{{{most}}}\n{body}\n\\end{{task}}"

    def page_break(self) -> str:
        """End a page."""
        return r"\clearpage"


def _wrapping(share: float) -> str:
    """Write the shape of a column whose cells wrap, with its share of the line."""
    width = rf"\dimexpr {share:.3f}\linewidth-2\tabcolsep\relax"
    return rf">{{\raggedright\arraybackslash}}p{{{width}}}"


def md(document: Document) -> bytes:
    """Write the document as Markdown."""
    body = blocks_in(document.blocks, MarkdownPage(OutputOptions()))
    head = " · ".join(_markdown_field(one) for one in document.head)
    title, foot = f"# {markdown.escaped(document.title)}", markdown.escaped(document.foot)
    parts = (title, head, body, "---", foot)
    return ("\n\n".join(part for part in parts if part) + "\n").encode("utf-8", "replace")


def _markdown_field(field: Field) -> str:
    label = f"{markdown.escaped(field.label)} " if field.label else ""
    return label + markdown.escaped(field.value or LINE_TO_FILL)


class MarkdownPage(markdown.Markdown):
    """How a page of Markdown writes each kind of block."""

    def inline_formula(self, formula: Formula) -> str:
        """Write a formula among words; a bar would end a table's cell."""
        return f"${mathematics(formula.tree)}$".replace("|", r"\vert ")

    def symbols(self, meanings: Sequence[tuple[str, str]]) -> str:
        """Write letters and their words as a list."""
        return "\n".join(f"- {letter} – {words}" for letter, words in meanings)

    def framed(self, body: str) -> str:
        """Quote some blocks."""
        return "\n".join(f"> {line}".rstrip() for line in body.splitlines())

    def figure(self, figure: Figure) -> str:
        """Write a picture with its alternative text."""
        alternative, caption = map(markdown.escaped, (figure.alternative, figure.caption))
        caption = f"**{markdown.escaped(figure.title)}.** {caption}" if figure.title else caption
        return f"![{alternative}]({figure.path})\n\n{caption}"

    def page_break(self) -> str:
        """Draw a rule."""
        return "---"
