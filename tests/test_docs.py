"""README and docs refer to things that exist: files and headings, commands and options, names and arguments in Python."""

import ast
import inspect
import re
import shlex
import subprocess
import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path

import pytest
import typer

import anymesh
from anymesh.cli import make_app
from anymesh.errors import PIP_TARGET, pip_install

ROOT = Path(__file__).parents[1]
DOCS = ROOT / "docs"
SOURCE = ROOT / "src" / "anymesh"
# Modules that the tutorials use and that need not be installed here.
OUTSIDE = {"mujoco", "sapien", "pxr", "isaaclab", "sqlite3"}
FENCE = re.compile(r"^[ ]*```([\w{}-]*)\n(.*?)^[ ]*```", re.M | re.S)
LINK = re.compile(r"!?\[(?:[^\[\]]|\[[^\]]*\])*\]\(([^)\s]+)\)")
NAMED_FILE = re.compile(r"`([\w/]+\.py)`")
HEADING = re.compile(r"^#{1,6} +(.+?) *#*$", re.M)


def pages() -> list[Path]:
    names = subprocess.run(
        ["git", "ls-files", "--cached", "--others", "--exclude-standard", "*.md"], cwd=ROOT, capture_output=True, text=True
    ).stdout.split()
    found = [ROOT / name for name in names if "recordings" not in name] or [*ROOT.glob("*.md"), *DOCS.rglob("*.md")]
    return sorted(path for path in found if path.exists())


PAGES = pages()
GUIDES = [path for path in PAGES if path.parent in (ROOT, DOCS) or DOCS in path.parents]
HISTORY = ROOT / "CHANGELOG.md"  # also names options that are gone


def named(path: Path) -> str:
    return str(path.relative_to(ROOT))


def prose(path: Path) -> str:
    """Return the text without blocks and spans of code."""
    return re.sub(r"`[^`\n]*`", "", FENCE.sub("", path.read_text(encoding="utf-8")))


def slugs(path: Path) -> set[str]:
    """Return the anchors of the headings, as code hosts and MyST build them."""
    found: set[str] = set()
    for title in HEADING.findall(FENCE.sub("", path.read_text(encoding="utf-8"))):
        text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", title).replace("`", "").lower()
        slug = re.sub(r"[^\w\- ]", "", text).replace(" ", "-")
        count = 0
        while (unique := slug if not count else f"{slug}-{count}") in found:
            count += 1
        found.add(unique)
    return found


@pytest.mark.parametrize("path", PAGES, ids=named)
def test_links_lead_to_files_and_headings(path: Path) -> None:
    for target in LINK.findall(prose(path)):
        if re.match(r"[a-z]+:", target):
            assert target.startswith("https://"), target
            continue
        place, _, anchor = target.partition("#")
        file = (path.parent / place).resolve() if place else path
        assert file.exists(), f"{target} leads nowhere"
        assert file == ROOT or ROOT in file.parents, f"{target} leads out of the repository"
        if anchor:
            assert anchor in slugs(file), f"{target}: valid are {sorted(slugs(file))}"


def test_python_files_that_are_named_exist() -> None:
    """A path may be given from any folder on; NAME stands for a file to be written."""
    tracked = subprocess.run(["git", "ls-files", "*.py"], cwd=ROOT, capture_output=True, text=True).stdout.split()
    known = {"/".join(parts[k:]) for parts in (name.split("/") for name in tracked) for k in range(len(parts))}
    missing = {
        (named(path), name)
        for path in PAGES
        for name in NAMED_FILE.findall(path.read_text(encoding="utf-8"))
        if name not in known and not re.search("[A-Z]", name)
    }
    assert not tracked or not missing


def commands(text: str) -> Iterator[list[str]]:
    """Yield the words of each `anymesh` command in blocks of code."""
    for kind, block in FENCE.findall(text):
        if kind not in ("", "bash", "console", "sh"):
            continue
        for line in block.replace("\\\n", " ").splitlines():
            for part in re.split(r"&&|\|(?!\w)|;", re.sub(r"(^|\s)#.*$", "", line)):
                words = (
                    shlex.split(part.replace("...", " "))
                    if part.count("'") % 2 == 0 and part.count('"') % 2 == 0
                    else part.split()
                )
                while words and re.match(r"[A-Z_]+=", words[0]):
                    words = words[1:]
                if words and words[0].rsplit("/", 1)[-1] == "anymesh":
                    yield words[1:]


@pytest.mark.parametrize("path", GUIDES, ids=named)
def test_commands_and_options_exist(path: Path) -> None:
    group = typer.main.get_command(make_app())
    top = {name for option in group.params for name in option.opts} | {"--help", "--install-completion", "--show-completion"}
    for words in commands(path.read_text(encoding="utf-8")):
        while words and words[0].startswith("-"):
            assert words[0] in top, f"anymesh {' '.join(words)}"
            words = words[1:]
        if not words or not words[0].islower():
            continue
        name = words[0].strip("`").split("|")[0]
        assert name in group.commands, f"anymesh {name} is not a command; valid are {sorted(group.commands)}"
        options = {o for option in group.commands[name].params for o in (*option.opts, *option.secondary_opts)} | {"--help"}
        for word in words[1:]:
            if re.match(r"--?[A-Za-z]", word.lstrip("[")):
                assert word.strip("[]").split("=")[0] in options, f"anymesh {name} {word}; valid are {sorted(options)}"


def inline_options() -> set[str]:
    pages = (path for path in GUIDES if path != HISTORY)
    return {match for path in pages for match in re.findall(r"`(--[a-z][a-z-]+)", path.read_text(encoding="utf-8"))}


def test_options_in_prose_exist_somewhere() -> None:
    group = typer.main.get_command(make_app())
    known = {
        o
        for command in (group, *group.commands.values())
        for option in command.params
        for o in (*option.opts, *option.secondary_opts)
    }
    scripts = "".join(
        path.read_text(encoding="utf-8")
        for folder in ("benchmarks", "training", "docs")
        for path in sorted((ROOT / folder).glob("**/*.py"))
    )
    foreign = {"--install-completion", "--mesh-input", "--output-dir"}
    missing = {o for o in inline_options() - known - foreign if f'"{o}"' not in scripts}
    assert not missing


def blocks_of_python() -> list[tuple[str, str]]:
    return [
        (f"{named(path)}-{k}", block)
        for path in GUIDES
        for k, (kind, block) in enumerate(FENCE.findall(path.read_text(encoding="utf-8")))
        if kind == "python"
    ]


@pytest.mark.parametrize("block", [b for _, b in blocks_of_python()], ids=[name for name, _ in blocks_of_python()])
def test_python_uses_names_and_arguments_that_exist(block: str) -> None:
    tree = ast.parse(block)
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.module and node.module.split(".")[0] not in OUTSIDE:
            module = import_module(node.module)
            for alias in node.names:
                assert hasattr(module, alias.name), f"{node.module}.{alias.name}"
        elif isinstance(node, ast.Import):
            for alias in node.names:
                if alias.name.split(".")[0] not in OUTSIDE:
                    import_module(alias.name)
        elif isinstance(node, ast.Attribute) and isinstance(node.value, ast.Name) and node.value.id == "anymesh":
            assert node.attr in anymesh.__all__, f"anymesh.{node.attr}"
        if isinstance(node, ast.Call) and ast.unparse(node.func).startswith("anymesh."):
            signature = inspect.signature(getattr(anymesh, ast.unparse(node.func).split(".")[1]))
            open_ended = any(p.kind is p.VAR_KEYWORD for p in signature.parameters.values())
            for keyword in node.keywords:
                assert open_ended or keyword.arg in signature.parameters, f"{ast.unparse(node.func)}({keyword.arg}=)"


def test_readme_begins_with_the_commands_that_ci_runs() -> None:
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    blocks = [(kind, block) for kind, block in FENCE.findall(text) if kind in ("bash", "python")]
    assert [kind for kind, _ in blocks] == ["bash", "bash", "python"]
    assert all(block.count("\n") == 1 for kind, block in blocks if kind == "bash")
    code = [line for line in blocks[2][1].splitlines() if line.strip() and not line.startswith("import")]
    assert len(code) <= 6
    picture = LINK.search(text)
    assert picture is not None
    assert picture[1].endswith(".gif")
    assert (ROOT / picture[1]).stat().st_size < 2e6


def test_every_extra_is_on_the_page_of_the_installation() -> None:
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    page = (DOCS / "install.md").read_text(encoding="utf-8")
    assert not [name for name in extras if f"`{name}`" not in page]


def test_extras_are_installed_in_one_way() -> None:
    """The package is not on PyPI yet, so its name installs nothing; `errors.PIP_TARGET` is what to change then."""
    extras = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]["optional-dependencies"]
    other = []
    for path in [*PAGES, *SOURCE.rglob("*.py")]:
        text = path.read_text(encoding="utf-8")
        for flags, target in re.findall(r"pip install((?: +-[\w-]+)*) +([^\s`]*\[[\w,{}-]+\]\S?)", text):
            known = re.fullmatch(rf"'{re.escape(PIP_TARGET)}\[([\w,-]+)\]'", target)
            if path.suffix == ".py" or not known or not {*known[1].split(",")} <= {*extras}:
                other.append((named(path), f"pip install{flags} {target}"))
        other += [(named(path), found) for found in re.findall(r"pip install[^\n`;&]*anymesh", text)]
    assert [place for place in other if place != ("src/anymesh/errors.py", "pip install '{PIP_TARGET}[{extra}]'")] == []
    assert pip_install("view") == f"`pip install '{PIP_TARGET}[view]'`"


def test_the_api_page_documents_the_public_names() -> None:
    page = (DOCS / "api" / "index.md").read_text(encoding="utf-8")
    found = re.findall(r"^\.\. (?:auto\w+|py:data):: (?:anymesh\.pipeline\.)?(\w+)", page, re.M)
    assert sorted(found) == sorted(anymesh.__all__)


def test_every_page_is_in_the_navigation() -> None:
    trees = [
        (path, block) for path in DOCS.rglob("*.md") for kind, block in FENCE.findall(path.read_text()) if "toctree" in kind
    ]
    listed = set()
    for path, block in trees:
        for line in block.splitlines():
            if line.strip() and not line.startswith(":"):
                name = match[1] if (match := re.search(r"<(.+)>", line)) else line.strip()
                listed.add((path.parent / f"{name}.md").resolve())
    assert all(path.exists() for path in listed)
    assert not [named(path) for path in DOCS.rglob("*.md") if path not in listed and path != DOCS / "index.md"]
