"""Options of the pipeline, each defined once: the functions, the commands and the applications read them from here.

Calls to models and their cost are counted here too, towards the limits of one run or of several.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import Field, dataclass, field, fields
from pathlib import Path
from threading import Lock
from typing import Any, Protocol, TypedDict, runtime_checkable

from anymesh.config import DEFAULT_VIEWS
from anymesh.errors import BudgetError
from anymesh.runtime import CALL_SECONDS, DEFAULT_SECONDS

GEOMETRY = "geometry"  # name of the answerer that needs no key and no network
FILES = "files:"  # prefix of the name of answers in files
FLAGS, METAVAR, KIND, HELP = "flags", "metavar", "kind", "help"  # metadata of a field that is also an option of commands


def _option(default: Any, text: str, *flags: str, metavar: str | None = None, kind: type | None = None) -> Any:
    """Return the field of an option. kind: type of a value other than the default, for a default of None or a sequence.

    A sequence is comma-separated text on the command line.
    """
    return field(default=default, metadata={HELP: text, FLAGS: flags, METAVAR: metavar, KIND: kind or type(default)})


def command_fields(kind: Any) -> tuple[Field[Any], ...]:
    """Return the fields of a class of options that are options of commands too."""
    return tuple(f for f in fields(kind) if HELP in f.metadata)


def defaults(*kinds: Any) -> dict[str, Any]:
    """Return the default values of all fields."""
    return {f.name: f.default for kind in kinds for f in fields(kind)}


@dataclass(frozen=True)
class Limit:
    """Maximum number of calls, and maximum cost [USD]; None for no limit."""

    calls: int | None = None
    cost: float | None = None

    def check(self, kind: str, calls: int, cost: float, most: float, spent: str) -> None:
        """Raise BudgetError if one more call of at most `most` [USD] could exceed the limit.

        calls, cost: spent and reserved so far; kind: kind of the question; spent: both in words.
        """
        if self.calls is not None and calls >= self.calls:
            raise BudgetError(f"{kind}: call {calls + 1} would exceed --max-calls {self.calls}; {spent}")
        if self.cost is not None and cost + most > self.cost:
            reason = f"the next call may cost up to {most:.4f} USD, which could exceed --max-cost {self.cost:g}"
            raise BudgetError(f"{kind}: {reason}; {spent}")


@runtime_checkable
class Account(Protocol):
    """Protocol of a counter of calls and their cost [USD], shared by threads or by processes."""

    @property
    def calls(self) -> int: ...

    @property
    def cost(self) -> float: ...

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call of at most `most` [USD] and return the reservation's number. Raise BudgetError beyond the limit."""
        ...

    def settle(self, hold: int, cost: float | None) -> None:
        """Replace a reservation by the cost of the call; None for a call that failed and was not billed."""
        ...


@dataclass
class Spent:
    """Calls and their cost [USD, of known prices] so far; shared by threads and by the runs of a batch."""

    calls: int = 0
    cost: float = 0.0
    _held: dict[int, float] = field(default_factory=dict, repr=False)
    _lock: Lock = field(default_factory=Lock, repr=False, compare=False)
    _last: int = field(default=0, repr=False)

    def hold(self, kind: str, most: float, limit: Limit) -> int:
        """Reserve a call, so that threads cannot exceed the limit together. Raise BudgetError beyond the limit."""
        with self._lock:
            spent = spent_words(self.calls, self.cost)
            limit.check(kind, self.calls + len(self._held), self.cost + sum(self._held.values()), most, spent)
            self._last += 1
            self._held[self._last] = most
            return self._last

    def settle(self, hold: int, cost: float | None) -> None:
        """Count an answered call; drop the reservation of a failed one."""
        with self._lock:
            del self._held[hold]
            self.calls += cost is not None
            self.cost += cost or 0.0


def spent_words(calls: int, cost: float) -> str:
    """Describe calls and cost [USD] in words."""
    return f"spent so far: {calls} calls, {cost:.4f} USD"


@dataclass(frozen=True)
class AnswererOptions:
    """Who answers the questions of both stages, and what limits it. The help texts below are the documentation of the fields.

    parts_list: labels, which a model is then not asked for; at_least: minimum number of parts that geometry selects;
    viewpoints: see `Config`; max_calls, max_cost [USD]: limits that no call may exceed; timeout [s]; suggest: write
    geometry's answer beside each question in files that is waited for; spent: calls and cost counted towards max_calls and
    max_cost, shared by several runs; limiter: delays calls above a provider's rate limit.
    """

    answerer: str = _option(
        GEOMETRY,
        "geometry, openai:MODEL, openai-responses:MODEL, anthropic:MODEL, google:MODEL, ollama:MODEL, lmstudio:MODEL, "
        "vllm:MODEL, openai-compatible:BASE_URL#MODEL, files:FOLDER (answers in files) or replay:FOLDER.",
    )
    parts_list: Sequence[str] | str = _option(
        (), "Labels of the moving parts, such as door,drawer, instead of asking a model.", metavar="LABELS"
    )
    at_least: int = _option(0, "Parts accepted regardless of evidence; 1 if the object is known to move.", metavar="N")
    proposer: str = _option("exact", "Source of masks for a model: exact, sam:WEIGHTS or exact+sam:WEIGHTS.")
    viewpoints: str = _option(
        DEFAULT_VIEWS,
        "For a model: cameras as COUNT@ELEVATION[+AZIMUTH],... in degrees; 8@15 is the paper's.",
        "--views",
        "--viewpoints",
    )
    verify: str = _option(
        "motion", "motion: a model chooses among motions; free: its picks are used unless blocked; off: the paper's method."
    )
    ask: str = _option("unsure", "unsure: a model is not asked about joints that geometry is sure of; all: about each.")
    pictures: str = _option("many", "few: a model sees one picture per question, as small models need it; many: up to 8.")
    detail: str = _option("high", "high, or low: a model is not asked about regions below 3 % of the object's diagonal.")
    category: str | None = _option(None, "Kind of object, such as fridge; for models and for --scale auto.", kind=str)
    timeout: float = _option(CALL_SECONDS, "Time-out of one model call.", metavar="SECONDS")
    wait: bool = _option(False, "With files:FOLDER, wait for missing answers.", "--wait")
    max_calls: int | None = _option(None, "Maximum number of model calls.", kind=int)
    max_cost: float | None = _option(None, "Maximum cost of model calls.", metavar="USD", kind=float)
    cache: Path | str | None = _option(  # noqa: RUF009
        "auto", "Cache of model answers: auto (the user's cache folder), off, or a folder.", metavar="DIR"
    )
    seed: int = _option(0, "From 0 up; the same input and seed give the same bytes.")
    suggest: bool = False
    spent: Account | None = None
    limiter: Any = None


class Answering(TypedDict, total=False):
    """The keyword arguments of `AnswererOptions`, for the Python functions: see there."""

    answerer: str
    category: str | None
    seed: int
    parts_list: Sequence[str] | str
    at_least: int
    proposer: str
    viewpoints: str
    verify: str
    ask: str
    pictures: str
    detail: str
    max_calls: int | None
    max_cost: float | None
    cache: Path | str | None
    timeout: float
    wait: bool
    suggest: bool
    spent: Account | None
    limiter: Any


@dataclass(frozen=True)
class PlacementOptions:
    """How the mesh is read and placed."""

    up: str = _option("auto", "What points up in the file: auto, infer, x, y, z, -x, -y, -z, or a direction such as 0,0.7,0.7.")
    scale: str = _option("auto", "auto, a factor to metres, or METRES:AXIS such as 0.9:z.")
    root: str | Path | None = _option(  # noqa: RUF009
        None, "Folder for textures, and for package:// and model:// references.", metavar="FOLDER", kind=Path
    )
    animation: str = _option("read", "read or ignore: whether animations, physics joints, bones and pivots of the file count.")


@dataclass(frozen=True)
class CompletionOptions:
    """What Stage C does."""

    completer: str = _option("builtin", "Completer of shapes: builtin, off, holopart:FOLDER(#PYTHON) or holopart:URL.")
    texture: str = _option("builtin", "builtin, bake or bake:PIXELS (one atlas), meshy or meshy:PROMPT (paid).")
    watertight: bool = _option(True, "Also close surfaces that no motion uncovers.", "--watertight/--no-watertight")


@dataclass(frozen=True)
class FormatOptions:
    """Which files are written and how; None stands for what an asset that is written again has, else for the usual value."""

    base: str | None = _option(None, "fixed (usual) or free: whether the root link is fixed to the world.", kind=str)
    formats: str | None = _option(
        None, "Comma-separated, of urdf, mjcf, usd, sdf, glb, usdz; usually without usd and usdz, of an extra.", kind=str
    )
    drives: str | None = _option(
        None, "passive (usual), or position: joints follow a commanded position, initially 0.", kind=str
    )
    hulls: int | None = _option(None, "Maximum number of collision shapes per link, 0 for no limit.", metavar="N", kind=int)
    resistance: str | None = _option(
        None, "light, typical (usual) or stiff: how strongly joints resist, within the range of their kind.", kind=str
    )
    mechanisms: str | None = _option(
        None, "auto (usual: the sure ones), off, all, or LABEL=KIND,...: springs, catches and detents of joints.", kind=str
    )
    visuals: str | None = _option(None, "Visual meshes of URDF and SDF: obj (usual) or dae, which web viewers read.", kind=str)
    shapes: str | None = _option(
        None, "Collision shapes: primitives (usual), or hulls: boxes and cylinders as convex meshes too, for MJX.", kind=str
    )
    profile: str | None = _option(
        None, "none (usual), or simready: also USD in layers, as NVIDIA's SimReady asks for it, in DIR/simready.", kind=str
    )
    target: str | None = _option(
        None, "none (usual), robocasa, robosuite, maniskill, isaaclab or genesis: also a folder for that project, DIR/TARGET.",
        kind=str,
    )  # fmt: skip
    mass: float | None = _option(
        None, "Mass of the whole object, 0 for that of its materials and walls.", metavar="KG", kind=float
    )
    precision: float | None = _option(
        None, "Write only joints that are right with this probability, such as 0.9, and propose the others; 0: all.",
        metavar="P", kind=float,
    )  # fmt: skip


class Writing(TypedDict, total=False):
    """The keyword arguments of `FormatOptions`, for the Python functions: see there."""

    base: str | None
    formats: str | None
    drives: str | None
    hulls: int | None
    resistance: str | None
    mechanisms: str | None
    visuals: str | None
    shapes: str | None
    profile: str | None
    target: str | None
    mass: float | None
    precision: float | None


class MakingOptions(Answering, Writing):
    """The keyword arguments of functions that answer questions and write an asset."""


def divided(options: MakingOptions) -> tuple[Answering, Writing]:
    """Divide options into those of the answerer, with any unknown ones, and those of the files."""
    written = {k: v for k, v in options.items() if k in Writing.__annotations__}
    return {k: v for k, v in options.items() if k not in written}, written  # ty: ignore[invalid-explicit-return]


@dataclass(frozen=True)
class RunOptions:
    """How a run treats its output and its time."""

    force: bool = _option(False, "Replace an existing output.", "--force")
    time_limit: float = _option(
        DEFAULT_SECONDS, "Time limit of a run; when shares of it are spent, stages shorten their work.", metavar="SECONDS"
    )
