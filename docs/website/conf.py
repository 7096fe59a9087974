"""How Sphinx makes pages of the sources; `python docs/website` runs it."""

from __future__ import annotations

from docutils import nodes
from docutils.utils.math.latex2mathml import tex2mathml
from sphinx.addnodes import index
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform
from sphinx.writers.html5 import HTML5Translator

from nmatrix.version import __version__

project = "nmatrix"
author = "The nmatrix authors"
release = version = __version__
project_copyright = ""
html_show_copyright = False
html_show_sphinx = False

extensions = ["myst_parser", "sphinx_copybutton"]
exclude_patterns = ["samples", "scenes", "pictures"]
nitpicky = True
smartquotes = False  # options begin with two minus signs

myst_enable_extensions = ["deflist", "colon_fence"]
myst_heading_anchors = 4

highlight_language = "text"
pygments_style = "a11y-light"
pygments_dark_style = "a11y-dark"
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True
copybutton_remove_prompts = True

html_math_renderer = "mathml"
html_theme = "furo"
html_title = "nmatrix"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["search.js"]
html_extra_path = ["extra"]
html_copy_source = False
html_show_sourcelink = False
html_last_updated_fmt = None
html_permalinks_icon = "#"
html_theme_options = {
    "light_css_variables": {
        "color-brand-primary": "#00674F",
        "color-brand-content": "#1D5FBF",
        "color-brand-visited": "#7A3FA6",
        "font-stack": "system-ui, -apple-system, 'Segoe UI', Roboto, 'DejaVu Sans', sans-serif",
        "font-stack--monospace": "ui-monospace, Menlo, Consolas, 'DejaVu Sans Mono', monospace",
    },
    "dark_css_variables": {
        "color-brand-primary": "#4FE0B5",
        "color-brand-content": "#7FB4FF",
        "color-brand-visited": "#C79BF2",
    },
}


def formula(writer: HTML5Translator, node: nodes.math) -> None:
    """Write a formula as MathML, which browsers show by themselves."""
    writer.body.append(tex2mathml(node.astext()))
    raise nodes.SkipNode


def formula_block(writer: HTML5Translator, node: nodes.math_block) -> None:
    """Write a formula on lines of its own."""
    writer.body.append(f"<div class='math'>{tex2mathml(node.astext(), as_block=True)}</div>")
    raise nodes.SkipNode


class SymptomsAlone(SphinxTransform):
    """Takes the options of commands out of the index, which is of what people see and type."""

    default_priority = 800  # before Sphinx collects the index

    def apply(self, **_: object) -> None:
        """Take them out of one page."""
        for node in list(self.document.findall(index)):
            if all("command line option" in entry[1] for entry in node["entries"]):
                node.parent.remove(node)


def setup(app: Sphinx) -> None:
    """Tell Sphinx of these."""
    app.add_html_math_renderer("mathml", (formula, None), (formula_block, None))
    app.add_transform(SymptomsAlone)
