"""The paper's figure: mesh -> parts -> joints -> asset -> files."""

from __future__ import annotations

import time
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import replace
from functools import cached_property
from pathlib import Path

import numpy as np

from anymesh.articulation.estimate import ask_motion, estimate_joints
from anymesh.config import Config
from anymesh.errors import OptionError
from anymesh.export import write_asset
from anymesh.geometry.pieces import ObjectShape, object_shape
from anymesh.loading import load_mesh, place_mesh
from anymesh.progress import Progress, silent
from anymesh.reasoning.geometry import GeometryAnswerer
from anymesh.reasoning.questions import Answerer
from anymesh.rendering.preview import write_preview
from anymesh.run_folder import RunFolder, stage_key
from anymesh.segmentation.given import parts_from_file, parts_from_nodes
from anymesh.segmentation.segment import segment_parts
from anymesh.stage_results import JOINTS, MESH, SEGMENTATION, Jointed, Placed, Segmented
from anymesh.types import Asset, Joint, Mesh, Segmentation, Source

ANSWERERS = ("geometry",)


def articulate(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    answerer: str = "geometry",
    category: str | None = None,
    seed: int = 0,
    up: str = "auto",
    scale: str = "auto",
    force: bool = False,
    progress: Progress = silent,
) -> Asset:
    """Turns a rigid mesh into an articulated asset and writes it to the folder `out`.

    parts: "auto", "nodes" (the scene's nodes) or a file of face labels; up: auto, x, y, z; scale: auto, a factor (file units
    to metres) or METRES:AXIS. Raises InputError, OptionError, OutputError; then nothing is written.
    """
    config, who = Config(seed=seed, category=category), make_answerer(answerer)
    with RunFolder.create(Path(out), source=Path(mesh_path), force=force) as run:
        placed, key = _place(run, Path(mesh_path), up, scale, progress)
        ready = _Ready(placed.mesh, config)
        segmented, key = _segment(run, placed, ready, key, parts, who, config, progress)
        _join(run, placed, ready, segmented, key, who, config, progress)
        return _export(run, progress)


def segment(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    answerer: str = "geometry",
    category: str | None = None,
    seed: int = 0,
    up: str = "auto",
    scale: str = "auto",
    force: bool = False,
    progress: Progress = silent,
) -> Segmentation:
    """Stage A alone: the parts of a mesh, saved in `out` for `joints`. Options as for `articulate`."""
    config, who = Config(seed=seed, category=category), make_answerer(answerer)
    with RunFolder.create(Path(out), source=Path(mesh_path), force=force) as run:
        placed, key = _place(run, Path(mesh_path), up, scale, progress)
        return _segment(run, placed, _Ready(placed.mesh, config), key, parts, who, config, progress)[0].segmentation


def joints(
    folder: str | Path,
    *,
    answerer: str = "geometry",
    category: str | None = None,
    seed: int = 0,
    progress: Progress = silent,
) -> tuple[Joint, ...]:
    """Stage B alone, on the parts that `segment` saved in `folder`."""
    config, who = Config(seed=seed, category=category), make_answerer(answerer)
    with RunFolder.open(Path(folder)) as run:
        placed, segmented = run.need(MESH), run.need(SEGMENTATION)
        ready = _Ready(placed.mesh, config)
        return _join(run, placed, ready, segmented, run.key(SEGMENTATION), who, config, progress).joints


def export(folder: str | Path, *, progress: Progress = silent) -> Asset:
    """Writes the files of the asset that `segment` and `joints` saved in `folder`."""
    with RunFolder.open(Path(folder)) as run:
        return _export(run, progress)


def make_answerer(name: str) -> Answerer:
    """The answerer of that name. Raises OptionError for one that is not known."""
    if name != "geometry":
        raise OptionError(f"--answerer: found {name!r}; valid is {', '.join(ANSWERERS)}")
    return GeometryAnswerer()


def find_parts(
    mesh: Mesh, parts: str, who: Answerer, config: Config, progress: Progress = silent, whole: ObjectShape | None = None
) -> Segmentation:
    """Stage A on a placed mesh [m, Z up]. `whole` is the mesh made ready, where that was done already."""
    if parts == "nodes":
        return parts_from_nodes(mesh)
    if parts != "auto":
        return parts_from_file(mesh, Path(parts))
    whole = whole or object_shape(mesh, config.seed, config.pieces)
    return segment_parts(mesh, whole, who, lambda around, label: ask_motion(around, "candidate", label, who), config, progress)


def find_joints(
    mesh: Mesh,
    segmentation: Segmentation,
    who: Answerer,
    config: Config,
    progress: Progress = silent,
    whole: ObjectShape | None = None,
) -> tuple[Joint, ...]:
    """Stage B on a placed mesh and its parts. `whole` serves again where the parts are made of its pieces."""
    label = segmentation.face_part
    if whole is None or (label != label[whole.source][np.unique(whole.piece, return_index=True)[1]][whole.mesh_piece]).any():
        whole = object_shape(mesh, config.seed, config.pieces, label)
    return estimate_joints(whole, segmentation, who, config, progress)


def solve(mesh: Mesh, given: Segmentation | None = None) -> tuple[Segmentation, tuple[Joint, ...]]:
    """Both stages on a placed mesh with the default answerer and settings, for evaluation; the second where parts are given."""
    who, config = make_answerer("geometry"), Config()
    whole = object_shape(mesh, config.seed, config.pieces) if given is None else None
    segmentation = given or find_parts(mesh, "auto", who, config, whole=whole)
    return segmentation, find_joints(mesh, segmentation, who, config, whole=whole)


def _place(run: RunFolder, path: Path, up: str, scale: str, progress: Progress) -> tuple[Placed, str]:
    progress("load", path.name, 0, 1)
    with _timed(run, "load"):
        loaded = load_mesh(path)
        key = stage_key(MESH, previous=loaded.sha256, config={"up": up, "scale": scale, "path": str(path)})
        found = run.load(MESH, key)
        if found is None:
            p = place_mesh(loaded, up=up, scale=scale)
            source = Source(str(path), loaded.sha256, p.T_asset_source, p.up, p.notes)
            found = Placed(p.mesh, source, (*loaded.warnings, *p.warnings))
            run.save(MESH, key, found)
    return found, key


class _Ready:
    """The mesh made ready for both stages, when it is first asked for."""

    def __init__(self, mesh: Mesh, config: Config) -> None:
        self._mesh, self._config = mesh, config

    @cached_property
    def whole(self) -> ObjectShape:
        return object_shape(self._mesh, self._config.seed, self._config.pieces)


def _segment(
    run: RunFolder, placed: Placed, ready: _Ready, previous: str, parts: str, who: Answerer, config: Config, progress: Progress
) -> tuple[Segmented, str]:
    settings = {**config.as_dict(), "parts": parts, "labels": _bytes_of_labels(parts), "answerer": who.name}
    key = stage_key(SEGMENTATION, previous=previous, config=settings)
    found = run.load(SEGMENTATION, key)
    if found is None:
        with _timed(run, "segment"):
            whole = ready.whole if parts == "auto" else None
            segmentation = find_parts(placed.mesh, parts, who, config, progress, whole)
        none = ("nothing was found that moves",) if len(segmentation.parts) == 1 else ()
        found = Segmented(segmentation, who.name, (*placed.warnings, *none))
        run.save(SEGMENTATION, key, found)
    return found, key


def _bytes_of_labels(parts: str) -> str:
    """The label file in hex, "" when there is none that can be read: the stage then tells what is wrong with it."""
    try:
        return Path(parts).read_bytes().hex() if parts not in ("auto", "nodes") and Path(parts).is_file() else ""
    except OSError:
        return ""


def _join(
    run: RunFolder,
    placed: Placed,
    ready: _Ready,
    segmented: Segmented,
    previous: str,
    who: Answerer,
    config: Config,
    progress: Progress,
) -> Jointed:
    key = stage_key(JOINTS, previous=previous, config={**config.as_dict(), "answerer": who.name})
    found = run.load(JOINTS, key)
    if found is None:
        with _timed(run, "joints"):
            made = find_joints(placed.mesh, segmented.segmentation, who, config, progress, ready.whole)
        unsure = tuple(
            f"joint {j.name}: low confidence ({j.confidence:.2f}), please check" for j in made if j.confidence < UNSURE
        )
        found = Jointed(made, who.name, unsure)
        run.save(JOINTS, key, found)
    return found


UNSURE = 0.4  # joints below this confidence are named in the warnings


def _export(run: RunFolder, progress: Progress) -> Asset:
    progress("export", "files", 0, 2)
    asset = run.asset()
    with _timed(run, "export"):
        write_asset(asset, run.folder)
        progress("export", "preview", 1, 2)
        write_preview(asset, run.folder / "preview.png")
    return replace(asset, timing=run.timing())


@contextmanager
def _timed(run: RunFolder, stage: str) -> Generator[None]:
    begin = time.perf_counter()
    yield
    run.add_time(stage, time.perf_counter() - begin)
