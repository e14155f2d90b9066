"""Configuration of the documentation site. Build it from the root of the repository, offline:

sphinx-build -W --keep-going -c docs . out/site
"""

import re
import sys
from pathlib import Path

from sphinx.application import Sphinx
from sphinx.errors import ConfigError

from anymesh import __version__

ROOT = Path(__file__).parents[1]
sys.path.insert(0, str(ROOT / "docs"))
from commands import Commands  # noqa: E402 - beside this file

project = "Articulate AnyMesh"
copyright = "the authors of Articulate AnyMesh, Apache-2.0"
version = release = __version__

# The pages stand where a code host shows them; the site takes the same files.
root_doc = "docs/index"
include_patterns = [
    "docs/**.md",
    "benchmarks/reports/*.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "SECURITY.md",
    "examples/README.md",
    "findings/README.md",
    "training/README.md",
]
exclude_patterns = ["README.md", "**/.venv", "out", "**/.*"]
extensions = ["myst_parser", "sphinx.ext.autodoc"]
myst_heading_anchors = 4
myst_enable_extensions = ["attrs_inline"]

smartquotes = False  # options begin with two hyphens
default_role = "literal"  # docstrings write `name` as Markdown does
autodoc_member_order = "bysource"
autodoc_typehints = "signature"
autodoc_typehints_format = "short"
autodoc_preserve_defaults = True
autodoc_class_signature = "mixed"
python_maximum_signature_line_length = 88
add_module_names = False

highlight_language = "text"  # of blocks without a language
html_theme = "furo"
html_title = f"Articulate AnyMesh {__version__}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_extra_path = ["_root"]  # index.html, which leads to docs/index.html
html_copy_source = False
html_show_sourcelink = False
pygments_style, pygments_dark_style = "friendly", "monokai"

PARAMETER = r"(?:[A-Za-z_*][\w*]*)(?:(?:,| and) [A-Za-z_*][\w*]*)*"


def list_parameters(app: Sphinx, what: str, name: str, found: object, options: object, lines: list[str]) -> None:
    """Turn a docstring's "a: text; b: text." into a list with an entry per parameter."""
    text, out = "\n".join(lines), []
    for paragraph in text.split("\n\n"):
        flat = " ".join(paragraph.split())
        if re.match(rf"{PARAMETER}(?: \[[^\]]+\])?: ", flat) and not paragraph.startswith((" ", "-", "Raise")):
            end = re.search(r"\. (?=[A-Z])", flat)
            rest = flat[end.end() :] if end else ""
            entries = re.split(rf"; (?={PARAMETER}(?: \[[^\]]+\])?: )", flat[: end.start()] if end else flat.rstrip("."))
            out += ["- " + re.sub(r"^([^:]+): ", r"**\1**: ", entry.replace("*", r"\*")) for entry in entries] + ["", rest, ""]
        else:
            out += [*paragraph.split("\n"), ""]
    lines[:] = out


def leave_out_of_navigation(app: Sphinx, doctree: object) -> None:
    """Mark the reports as pages that no table of contents lists; their README links them."""
    name = app.env.current_document.docname
    if name.startswith("benchmarks/reports/") and not name.endswith("README"):
        app.env.metadata[name]["orphan"] = True


def setup(app: Sphinx) -> dict[str, bool]:
    if not (ROOT / "docs" / "index.md").exists():
        raise ConfigError("build the site from the repository, with `-c docs .`")
    app.add_directive("anymesh-commands", Commands)
    app.connect("doctree-read", leave_out_of_navigation)
    app.connect("autodoc-process-docstring", list_parameters)
    return {"parallel_read_safe": True}
