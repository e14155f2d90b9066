"""Options of commands, generated from the classes of options of the Python functions, and those shared by several."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Mapping
from dataclasses import Field, dataclass, field
from functools import wraps
from pathlib import Path
from typing import Annotated, Any, get_args, get_type_hints

import typer
from typer.models import OptionInfo

from anymesh.pipeline.options import (
    FLAGS,
    HELP,
    KIND,
    METAVAR,
    AnswererOptions,
    CompletionOptions,
    FormatOptions,
    PlacementOptions,
    RunOptions,
    command_fields,
)

ORDER = INPUT, PARTS, OUTPUT, MODEL, ADVANCED = "Input", "Parts", "Output", "With a model", "Advanced"  # groups of the help
GROUPS = {PlacementOptions: INPUT, FormatOptions: OUTPUT, AnswererOptions: MODEL, RunOptions: OUTPUT}
OTHER_GROUPS = {  # of fields that differ from their class
    "category": INPUT,
    **dict.fromkeys(("parts_list", "at_least", "precision"), PARTS),
    **dict.fromkeys(("hulls", "resistance", "mechanisms", "visuals", "shapes", "profile", "time_limit", "seed"), ADVANCED),
    **dict.fromkeys(("animation", "root", "cache", "timeout", "viewpoints", "verify", "ask", "detail", "proposer"), ADVANCED),
}
MeshPath = Annotated[
    Path, typer.Argument(metavar="MESH", help="GLB, glTF, OBJ, PLY, STL, OFF, DAE, 3MF, USD, FBX, STEP or zip.")
]
Folder = Annotated[Path, typer.Argument(metavar="DIR", help="A folder that `anymesh segment` made.")]
FolderPath = Annotated[
    Path, typer.Argument(metavar="FOLDER", help="An output of `anymesh articulate`, or a folder with several of them.")
]
Out = Annotated[Path, typer.Option("--out", "-o", metavar="DIR", help="Folder to write.", rich_help_panel=OUTPUT)]
Parts = Annotated[
    str,
    typer.Option(
        help="auto, nodes (the scene's nodes), none (nothing moves), or a .npy/.json file of face labels.",
        rich_help_panel=PARTS,
    ),
]
Package = Annotated[
    Path | None, typer.Option(metavar="DIR", help="Also write a ROS 2 package of the URDF, in DIR.", rich_help_panel=OUTPUT)
]
Zip = Annotated[Path | None, typer.Option("--zip", metavar="FILE", help="Also write one .zip file.", rich_help_panel=OUTPUT)]
Sample = Annotated[
    int, typer.Option(metavar="N", help="Also write N variants whose parts move otherwise, by weight.", rich_help_panel=OUTPUT)
]
Json = Annotated[bool, typer.Option("--json", help="Print one JSON object and nothing else.", rich_help_panel=OUTPUT)]
Verbose = Annotated[bool, typer.Option("--verbose", "-v", help="Also the reason of each joint.", rich_help_panel=OUTPUT)]
Quiet = Annotated[bool, typer.Option("--quiet", "-q", help="No progress, no summary.", rich_help_panel=OUTPUT)]


@dataclass(frozen=True)
class OptionsOf:
    """Annotation of a command's parameter: it receives the values of a class of options.

    without: fields that the command does not have; helps, flags: help texts and names that differ from those of the class.
    """

    kind: type
    without: tuple[str, ...] = ()
    helps: Mapping[str, str] = field(default_factory=dict)
    flags: Mapping[str, tuple[str, ...]] = field(default_factory=dict)

    def parameters(self) -> list[inspect.Parameter]:
        """Return one parameter per option."""
        return [self._parameter(f) for f in command_fields(self.kind) if f.name not in self.without]

    def _parameter(self, f: Field[Any]) -> inspect.Parameter:
        kind: Any = f.metadata[KIND]
        default: Any = f.default
        if kind is tuple:
            kind, default = str, ",".join(default)
        hint: Any = kind | None if default is None else kind
        value = _typer_option(self.kind, f, self.helps.get(f.name), self.flags.get(f.name))
        annotation = Annotated[hint, value]
        return inspect.Parameter(f.name, inspect.Parameter.KEYWORD_ONLY, default=default, annotation=annotation)

    def values(self, given: dict[str, Any]) -> dict[str, Any]:
        """Take the values of these options out of a command's arguments."""
        options = {}
        for f in command_fields(self.kind):
            if f.name in given:
                value = given.pop(f.name)
                options[f.name] = tuple(v for v in value.split(",") if v.strip()) if f.metadata[KIND] is tuple else value
        return options


def option_of(kind: type, name: str) -> Any:
    """Return the option of one field, for a command that has no other field of the class."""
    option_field = next(f for f in command_fields(kind) if f.name == name)
    return _typer_option(kind, option_field)


def _typer_option(kind: type, f: Field[Any], text: str | None = None, flags: tuple[str, ...] | None = None) -> Any:
    names = flags or f.metadata[FLAGS] or (f"--{f.name.replace('_', '-')}",)
    group = OTHER_GROUPS.get(f.name, GROUPS.get(kind))
    return typer.Option(*names, metavar=f.metadata[METAVAR], help=text or f.metadata[HELP], rich_help_panel=group)


def _group(parameter: inspect.Parameter) -> int:
    """Return the place of a parameter's group in the help; what has no group comes first."""
    options = [o for o in get_args(parameter.annotation)[1:] if isinstance(o, OptionInfo)]
    return ORDER.index(options[0].rich_help_panel) if options and options[0].rich_help_panel in ORDER else -1


def with_options(function: Callable[..., None]) -> Callable[..., None]:
    """Replace each parameter of a command that is annotated with `OptionsOf` by the options of its class."""
    hints = get_type_hints(function, include_extras=True)
    classes = {name: k for name, hint in hints.items() for k in get_args(hint)[1:] if isinstance(k, OptionsOf)}
    parameters: list[inspect.Parameter] = []
    for name, parameter in inspect.signature(function).parameters.items():
        if name in classes:
            parameters += classes[name].parameters()
        else:
            parameters.append(parameter.replace(kind=inspect.Parameter.KEYWORD_ONLY, annotation=hints[name]))

    parameters.sort(key=_group)

    @wraps(function)
    def command(**given: Any) -> None:
        options = {name: of.values(given) for name, of in classes.items()}
        function(**given, **options)

    command.__signature__ = inspect.Signature(parameters)  # ty: ignore[missing-attribute]
    command.__annotations__ = {p.name: p.annotation for p in parameters}
    return command


Answering = Annotated[dict[str, Any], OptionsOf(AnswererOptions)]
Placement = Annotated[dict[str, Any], OptionsOf(PlacementOptions)]
Completion = Annotated[dict[str, Any], OptionsOf(CompletionOptions)]
Formats = Annotated[dict[str, Any], OptionsOf(FormatOptions)]
Running = Annotated[dict[str, Any], OptionsOf(RunOptions)]
Time = Annotated[dict[str, Any], OptionsOf(RunOptions, without=("force",))]
Force = Annotated[bool, option_of(RunOptions, "force")]
MaxCalls = Annotated[int | None, option_of(AnswererOptions, "max_calls")]
Animation = Annotated[str, option_of(PlacementOptions, "animation")]
Root = Annotated[Path | None, option_of(PlacementOptions, "root")]
Seed = Annotated[int, option_of(AnswererOptions, "seed")]
