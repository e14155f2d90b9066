"""Sphinx directive that writes a section per command of `anymesh`, with a table of its options."""

from __future__ import annotations

import typer
from docutils import nodes
from sphinx.util.docutils import SphinxDirective
from typer.core import TyperArgument, TyperCommand, TyperGroup

from anymesh.cli import make_app

VALUES = {int: "INTEGER", float: "NUMBER", str: "TEXT"}  # of options without a metavar, by the type of their default


class Commands(SphinxDirective):
    """Document every command that is not hidden."""

    def run(self) -> list[nodes.Node]:
        group = typer.main.get_command(make_app())
        assert isinstance(group, TyperGroup)
        return [self.section(name, command) for name, command in group.commands.items() if not command.hidden]

    def section(self, name: str, command: TyperCommand) -> nodes.section:
        found = nodes.section(ids=[f"anymesh-{name}"], names=[f"anymesh {name}"])
        found += nodes.title("", "", nodes.literal("", f"anymesh {name}"))
        for paragraph in (command.help or "").split("\n\n"):
            found += nodes.paragraph("", "", *inline(" ".join(paragraph.split())))
        rows = []
        for option in command.params:
            if getattr(option, "hidden", False) or option.name == "help":
                continue
            argument = isinstance(option, TyperArgument)
            flag = argument or getattr(option, "is_flag", False)
            value = "" if flag else f" {option.metavar or VALUES.get(type(option.default), 'VALUE')}"
            shown = (option.metavar or option.human_readable_name) if argument else ", ".join(option.opts)
            default = None if flag or argument or callable(option.default) else option.default
            rows.append((f"{shown}{value}", option.help or "", "" if default in (None, (), []) else str(default)))
        if rows:
            found.append(table(rows))
        return found


def table(rows: list[tuple[str, str, str]]) -> nodes.table:
    group = nodes.tgroup(cols=3)
    group += [nodes.colspec(colwidth=width) for width in (30, 55, 15)]
    head, body = nodes.thead(), nodes.tbody()
    head += row(*(nodes.paragraph("", text) for text in ("argument or option", "meaning", "default")))
    for shown, meaning, default in rows:
        cells = ([nodes.literal("", shown)], inline(meaning), [nodes.literal("", default)] if default else [])
        body += row(*(nodes.paragraph("", "", *cell) for cell in cells))
    group += [head, body]
    return nodes.table("", group)


def inline(text: str) -> list[nodes.Node]:
    """Return text in which every second part between backticks is code."""
    return [nodes.literal("", part) if k % 2 else nodes.Text(part) for k, part in enumerate(text.split("`"))]


def row(*cells: nodes.paragraph) -> nodes.row:
    found = nodes.row()
    found += [nodes.entry("", cell) for cell in cells]
    return found
