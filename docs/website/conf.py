"""How Sphinx makes pages of the sources; `python docs/website` runs it."""

from __future__ import annotations

from nmatrix.version import __version__

project = "nmatrix"
author = "The nmatrix authors"
release = version = __version__
project_copyright = ""
html_show_copyright = False
html_show_sphinx = False

extensions = ["myst_parser", "sphinx_copybutton"]
exclude_patterns = ["samples", "scenes", "pictures"]
suppress_warnings: list[str] = []
nitpicky = True

myst_enable_extensions = ["deflist", "colon_fence"]
myst_heading_anchors = 4
# A link to a file that is no page, such as a scene, downloads it.
myst_all_links_external = False

highlight_language = "text"
pygments_style = "a11y-light"
pygments_dark_style = "a11y-dark"
copybutton_prompt_text = "$ "
copybutton_only_copy_prompt_lines = True
copybutton_remove_prompts = True

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
