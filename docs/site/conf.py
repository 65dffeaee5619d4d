"""Sphinx: what `make docs` reads beside the pages of scripts/hopper_workflow/site."""

import hopper

project = "hopper"
author = "The hopper maintainers"
version = release = hopper.__version__
language = "en"
root_doc = "index"
extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "hopper_workflow.site.docstrings",
    "hopper_workflow.site.mathml",
]
exclude_patterns = ["results", "figures"]

myst_enable_extensions = ["dollarmath", "deflist"]
myst_heading_anchors = 3
napoleon_google_docstring = False
napoleon_use_ivar = True
napoleon_use_rtype = False
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
python_use_unqualified_type_names = True
add_module_names = False
toc_object_entries = False

# Attributes of several results have the same name, and need no link.
suppress_warnings = ["ref.python"]

html_theme = "furo"
html_title = "hopper"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
html_copy_source = False
html_show_copyright = False
html_show_sourcelink = False
# Summaries would be fetched page by page, which browsers refuse for files.
html_show_search_summary = False
