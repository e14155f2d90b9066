"""The classes of options hold all names, defaults and help texts; functions and commands agree with them."""

import inspect
import typing
from dataclasses import fields

import pytest
import typer

from anymesh.cli import make_app
from anymesh.errors import OptionError
from anymesh.export.options import ExportOptions
from anymesh.finishing.finishing import finish
from anymesh.pipeline import api
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.options import (
    FLAGS,
    HELP,
    AnswererOptions,
    Answering,
    CompletionOptions,
    FormatOptions,
    PlacementOptions,
    RunOptions,
    Writing,
    command_fields,
    defaults,
)

CLASSES = (AnswererOptions, PlacementOptions, CompletionOptions, FormatOptions, RunOptions)
NAMES = {
    "articulate": api.articulate,
    "segment": api.segment,
    "joints": api.joints,
    "export": api.export_asset,
    "finish": finish,
}


def test_an_unknown_option_is_refused() -> None:
    with pytest.raises(OptionError, match="found the options \\['answerers'\\]; valid are answerer, category"):
        choose_answerer({"answerers": "geometry"})  # ty: ignore[invalid-argument-type, invalid-key]


@pytest.mark.parametrize("name", NAMES)
def test_functions_have_the_defaults_of_the_classes(name: str) -> None:
    known = defaults(*CLASSES)
    given = {p.name: p.default for p in inspect.signature(NAMES[name]).parameters.values() if p.name in known}
    assert given == {key: known[key] for key in given}
    assert given


@pytest.mark.parametrize(("arguments", "of"), [(Answering, AnswererOptions), (Writing, FormatOptions)])
def test_the_keyword_arguments_are_the_fields(arguments: type, of: type) -> None:
    assert typing.get_type_hints(arguments, localns=LOCAL) == typing.get_type_hints(of, localns=LOCAL)


def test_the_options_of_files_are_those_of_the_export() -> None:
    assert {f.name for f in fields(FormatOptions)} == {f.name for f in fields(ExportOptions)}
    assert ExportOptions.parse(defaults(FormatOptions)) == ExportOptions()


@pytest.mark.parametrize("name", ["articulate", "generate", "annotate", "segment", "joints", "export", "finish", "eval"])
def test_commands_have_the_options_of_the_classes(name: str) -> None:
    command = typer.main.get_command(make_app()).commands[name]  # ty: ignore[unresolved-attribute]
    options = {p.name: p for p in command.params}
    for field in (f for kind in CLASSES for f in command_fields(kind)):
        found = options.get(field.name)
        if found is None or (name, field.name) in OWN:
            continue
        assert found.help == field.metadata[HELP], field.name
        assert found.default == ("" if field.default == () else field.default), field.name
        assert not field.metadata[FLAGS] or set(found.opts) == {flag.split("/")[0] for flag in field.metadata[FLAGS]}
    if name == "articulate":
        missing = {f.name for kind in CLASSES for f in fields(kind)} - set(options)
        assert missing == {"suggest", "spent", "limiter", "completer", "texture", "watertight"}


OWN = {
    ("generate", "max_calls"),
    ("export", "seed"),
    *(("eval", name) for name in ("answerer", "viewpoints", "force", "up")),
}  # texts of their own
LOCAL = dict.fromkeys(("Account", "Limiter"), object)
