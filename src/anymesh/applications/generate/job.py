"""Job of `anymesh generate`, checked before anything is made, paid or written."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from anymesh import __version__
from anymesh.applications.generate.generators import GivenMesh, open_generator
from anymesh.applications.generate.protocol import Generator3D, MeshRequest, Unit
from anymesh.errors import OptionError, OutputError
from anymesh.export.options import ExportOptions
from anymesh.finishing.finishing import open_completer, open_retexturer
from anymesh.kinds.usual import usual_size
from anymesh.loading import place_mesh
from anymesh.loading.load import LoadedMesh
from anymesh.pipeline.answering import choose_answerer
from anymesh.pipeline.atomic_folder import FOLDER_PREFIX, check_replaceable
from anymesh.pipeline.options import (
    FILES,
    AnswererOptions,
    Answering,
    CompletionOptions,
    FormatOptions,
    MakingOptions,
    PlacementOptions,
    RunOptions,
    defaults,
)
from anymesh.runtime import Deadline
from anymesh.types import Mesh, Node

ADVICE = "give --scale METRES:AXIS, such as 0.9:z"
FREE = ("max_calls", "max_cost", "cache", "timeout", "wait", "suggest", "spent", "limiter")  # options that affect no result
DEFAULTS = {
    name: value
    for name, value in defaults(PlacementOptions, FormatOptions, RunOptions, CompletionOptions, AnswererOptions).items()
    if name not in (*FREE, "force")
}
FINISHING = ("completer", "texture", "watertight", *defaults(FormatOptions))  # do not affect the pipeline's result


class GenerateOptions(MakingOptions, total=False):
    """Options of `articulate` and `finish` with the same meaning; `max_calls` limits paid tasks and model calls together."""

    up: str
    scale: str
    time_limit: float
    completer: str
    texture: str
    watertight: bool
    root: str | Path | None
    animation: str


@dataclass(frozen=True, eq=False)
class GenerationJob:
    """Generation of one object. options: all, including defaults; size: --scale and --category for the pipeline."""

    request: MeshRequest
    generator: Generator3D
    out: Path
    options: Mapping[str, Any]
    size: Size

    @property
    def mesh_key(self) -> str:
        """Digest that identifies the mesh."""
        return _digest({"request": self.request.as_dict(), "generator": self.generator.settings(self.request)})

    def key(self, *, finished: bool) -> str:
        """Return the digest that identifies the pipeline's result, or the finished asset."""
        left_out = FREE if finished else (*FREE, *FINISHING)
        held = {name: value for name, value in self.options.items() if name not in left_out}
        size = [self.size.scale, self.size.category]
        return _digest({"mesh": self.mesh_key, "options": held, "size": size, "finished": finished, "version": __version__})

    @property
    def answerer(self) -> str:
        """Name of the answerer of the pipeline's questions."""
        return str(self.options["answerer"])

    @property
    def by_files(self) -> bool:
        """Whether answers are read from files, which may change between runs."""
        return self.answerer.startswith(FILES)

    def articulating(self) -> dict[str, Any]:
        """Return the options for `articulate`."""
        kept = {name: value for name, value in self.options.items() if name not in FINISHING[:3]}
        return {**kept, "scale": self.size.scale, "category": self.size.category}

    def check(self, *, force: bool) -> None:
        """Check all options before the run. Raise OptionError, OutputError, ModelError (no key) or MissingExtraError."""
        options = self.options
        ExportOptions.parse(options)
        Deadline(options["time_limit"])
        place_mesh(_cube(), up=options["up"], scale=options["scale"])
        choose_answerer(self.answering())
        open_completer(options["completer"])
        open_retexturer(options["texture"], state=self.out.parent / "none", max_calls=options.get("max_calls"))
        self.check_output(force=force)

    def check_output(self, *, force: bool) -> None:
        """Raise OutputError if the output may not be written."""
        if self.out.exists() and not self.out.is_dir():
            raise OutputError(f"{self.out} is a file; an output is a folder")
        if self.out.is_dir() and any(not path.name.startswith(FOLDER_PREFIX) for path in self.out.iterdir()):
            check_replaceable(self.out, force)

    def answering(self) -> Answering:
        """Return the options that select and configure the answerer."""
        return {name: value for name, value in self.options.items() if name in Answering.__annotations__}  # ty: ignore


def open_job(
    prompt: str | None,
    out: str | Path,
    *,
    image: str | Path | None,
    mesh: str | Path | None,
    generator: str,
    time_limit: float,
    options: GenerateOptions,
) -> GenerationJob:
    """Build a job from options. Raise OptionError or InputError; makes no request and writes nothing."""
    unknown = sorted(set(options) - set(GenerateOptions.__annotations__) - set(Answering.__annotations__))
    if unknown:
        valid = ", ".join(dict.fromkeys((*DEFAULTS, *Answering.__annotations__)))
        raise OptionError(f"found the options {unknown}; valid are {valid}")
    if prompt is None and image is None and mesh is None:
        raise OptionError("found neither a prompt nor --image nor --mesh; one of them says what to make")
    if image is not None and mesh is not None:
        raise OptionError("found --image and --mesh; valid is one of them")
    if mesh is None and options.get("root") is not None:
        raise OptionError("--root applies to files that --mesh refers to; found no --mesh")
    chosen: dict[str, Any] = {**DEFAULTS, **options}
    request = MeshRequest(prompt, None if image is None else Path(image), chosen["seed"])
    who = open_generator(generator, time_limit=time_limit, max_calls=chosen.get("max_calls"))
    if mesh is not None:
        who = GivenMesh(Path(mesh), chosen["root"])
    who.steps(request)  # raises if the generator does not support the request
    name = request.name if mesh is None else Path(mesh).stem
    size = choose_size(chosen["scale"], chosen["category"], prompt, name, who.unit)
    return GenerationJob(request, who, Path(out).resolve(), chosen, size)


@dataclass(frozen=True)
class Size:
    """Values of --scale and --category for the pipeline, with the reason in words; warning: if the size is unknown."""

    scale: str
    category: str | None
    reason: str
    warning: str = ""


def choose_size(scale: str, category: str | None, prompt: str | None, name: str, unit: Unit) -> Size:
    """Return the given size, else the usual size of the kind of object named by the category, the prompt or the file name.

    Units that are stated or estimated are kept if they suit the kind (within a factor of 3) or no kind is known.
    """
    kind = usual_size(category or prompt or name)
    known = category or prompt or (None if kind is None else kind[0].replace("_", " "))
    if unit is Unit.STATED:
        known = category or prompt  # a unit in the file takes precedence over the file's name
    if scale != "auto":
        return Size(scale, known, f"given as {scale}")
    if kind is not None:
        usual = f"a {kind[0].replace('_', ' ')} is about {kind[1]:g} m long"
        if unit is Unit.ARBITRARY:
            return Size(f"{kind[1]:g}:longest", known, f"{usual}; the generator gives no size")
        if known is None:
            return Size("auto", None, "as the mesh file states it")
        source = "the generator estimates" if unit is Unit.ESTIMATED else "the mesh file states"
        return Size("auto", known, f"as {source} it, where that suits the kind ({usual})")
    if unit is Unit.ESTIMATED:
        return Size("auto", known, "as the generator estimated it")
    return Size("auto", known, "as the mesh file states it", f"the size of the object is not known; {ADVICE}")


def _cube() -> LoadedMesh:
    """Return a small mesh for validating --up and --scale."""
    corners = np.array([[x, y, z] for x in (0.0, 1.0) for y in (0.0, 1.0) for z in (0.0, 1.0)])
    faces = np.array([[0, 1, 3], [4, 6, 7], [0, 4, 5]])
    zero = np.zeros(len(faces), int)
    return LoadedMesh(Mesh(corners, faces, zero, (Node("cube"),), zero - 1, ()), "cube.glb", "", "y", 1.0, ())


def _digest(value: Mapping[str, Any]) -> str:
    return hashlib.sha256(json.dumps(value, sort_keys=True, default=str).encode()).hexdigest()
