"""The site: every Markdown document where it lies, the notebooks executed, the API from the docstrings.

Sources are read from the root of the repository (`sphinx-build -c docs . out/site`), so that a link which
works in the repository works on the site.
"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE / "site"))

import api_pages  # noqa: E402
import docstrings  # noqa: E402
import links  # noqa: E402
import live_page  # noqa: E402
import mathml  # noqa: E402
import navigation  # noqa: E402
import notebook_cache  # noqa: E402

import seacrane  # noqa: E402

project = "seacrane"
author = "The seacrane developers"
copyright = author
version = release = seacrane.__version__

extensions = ["myst_nb", "sphinx.ext.autodoc", "sphinx.ext.autosummary", "sphinx.ext.napoleon"]
root_doc = "docs/index"
include_patterns = [
    "README.md",
    "CHANGELOG.md",
    "docs/*.md",
    "docs/api/*.rst",
    "benchmarks/**.md",
    "examples/**.md",
    "studies/**.md",
    "tests/reference_problems/README.md",
    "notebooks/*.md",
    "python/seacrane/data/warnings.md",
]
exclude_patterns = [".*", "build", "out", "dist", "**/node_modules"]

html_theme = "furo"
html_title = f"seacrane {version}"
templates_path = ["site/templates"]
html_additional_pages = {"index": "redirect.html"}
html_copy_source = False

myst_heading_anchors = 6  # as GitHub makes them
myst_enable_extensions = ["dollarmath"]  # as notebooks write formulas
html_math_renderer = mathml.NAME

nb_execution_mode = "cache"
nb_execution_cache_path = str(notebook_cache.folder(HERE.parent / "build" / "notebooks"))
nb_execution_in_temp = True
nb_execution_raise_on_error = True
nb_execution_timeout = 300

default_role = "py:obj"
autosummary_generate = False
autodoc_member_order = "bysource"
autodoc_typehints_format = "short"
autodoc_type_aliases = {
    "ArrayLike": "ArrayLike",
    "Array": "NDArray[float64]",
    "FloatArray": "NDArray[float64]",
    "ComplexArray": "NDArray[complex128]",
    "Flags": "NDArray[bool]",
}
python_use_unqualified_type_names = True
python_maximum_signature_line_length = 90
napoleon_google_docstring = False
napoleon_custom_sections = [("Attributes", "params_style")]  # several names share a line


def setup(app: Any) -> None:
    """Connects what is ours."""
    api_pages.write(HERE / "api")
    mathml.setup(app)
    docstrings.name_aliases()
    app.connect("doctree-read", navigation.add_toctrees, priority=400)  # before Sphinx collects them
    app.connect("autodoc-process-docstring", docstrings.keep_bars)
    app.connect("autodoc-process-signature", docstrings.shorten)
    app.connect("doctree-read", links.link_named_documents)
    app.connect("doctree-read", links.link_exact_names)
    app.connect("doctree-read", links.unlink_folders)
    app.connect("missing-reference", links.public_name)
    app.connect("build-finished", live_page.write)
