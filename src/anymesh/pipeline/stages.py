"""Stages within a run: each loads its saved result if its inputs and options are unchanged, else computes and saves it."""

from __future__ import annotations

import time
from collections.abc import Generator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar

from anymesh.deadline import Deadline
from anymesh.errors import note_stage
from anymesh.export import write_asset
from anymesh.export.options import ExportOptions
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.answering import AnswererSetup
from anymesh.pipeline.solving import Solver
from anymesh.pipeline.stage_results import (
    JOINTS,
    MESH,
    RECOGNITION,
    SEGMENTATION,
    JointResult,
    LoadResult,
    RecognitionResult,
    SegmentationResult,
)
from anymesh.pipeline.storage.run_folder import RunFolder, stage_key
from anymesh.progress import Progress
from anymesh.rendering.preview import write_preview
from anymesh.segmentation.given import GIVEN
from anymesh.types import Asset, Source
from anymesh.vlm.cache import cache_folder

Result = TypeVar("Result", RecognitionResult, SegmentationResult, JointResult)
ASIDE = 500_000  # faces up to which the preview is drawn in parallel with writing; above, both together need too much memory


@dataclass(frozen=True)
class Placement:
    """Options of `articulate` about reading and placing the mesh."""

    up: str
    scale: str
    root: str | Path | None


def prepare(
    run: RunFolder, path: Path, parts: str, how: Placement, who: AnswererSetup, deadline: Deadline, progress: Progress
) -> tuple[Solver, RecognitionResult, str]:
    """Load, place and recognize the mesh; return the solver of both stages, the recognition, and the key of the last stage."""
    placed, key = place(run, path, how, who.config.category, progress)
    solver = Solver(placed.mesh, who.config, who.factory, deadline)
    if parts != "auto":
        solver.parts(parts)  # report invalid parts before any model call
    recognized, key = recognize(run, solver, key, who, how.scale == "auto", placed.metric)
    sized = recognized.sized(placed)
    return (solver if sized is placed else Solver(sized.mesh, who.config, who.factory, deadline)), recognized, key


def place(run: RunFolder, path: Path, how: Placement, category: str | None, progress: Progress) -> tuple[LoadResult, str]:
    """Load a mesh and bring it to metres, z up."""
    progress("load", path.name, 0, 1)
    with timed(run, "load"):
        loaded = load_mesh(path, root=how.root)
        settings = {"up": how.up, "scale": how.scale, "category": category, "path": str(path), "references": loaded.references}
        key = stage_key(MESH, previous=loaded.sha256, config=settings)
        found = run.load(MESH, key)
        if found is None:
            p = place_mesh(loaded, up=how.up, scale=how.scale, category=category)
            source = Source(str(path), loaded.sha256, p.T_asset_source, p.up, p.notes)
            found = LoadResult(p.mesh, source, (*loaded.warnings, *p.warnings), p.metric)
            run.save(MESH, key, found)
    return found, key


def _answered(found: Result | None, who: AnswererSetup) -> Result | None:
    """Return a saved stage, or None if it was answered by geometry instead of a model or if its answers have changed."""
    if found is None or any(e.given_up for e in found.exchanges) or not who.is_current(found.exchanges):
        return None
    return found


def recognize(
    run: RunFolder, solver: Solver, previous: str, who: AnswererSetup, sized: bool, metric: bool
) -> tuple[RecognitionResult, str]:
    """Recognize the object's category and movable parts with a model (paper, 3.1), or by geometry without requests."""
    if who.factory is None:
        return solver.recognize(), previous
    key = stage_key(
        RECOGNITION, previous=previous, config={**who.settings("verify", "proposer"), "sized": sized, "metric": metric}
    )
    found = _answered(run.load(RECOGNITION, key), who)
    if found is None:
        with timed(run, "recognize"):
            found = solver.recognize(sized=sized, metric=metric)
        run.save(RECOGNITION, key, found)
    return found, key


def segment_parts(
    run: RunFolder,
    solver: Solver,
    recognized: RecognitionResult,
    previous: str,
    parts: str,
    who: AnswererSetup,
    progress: Progress,
) -> tuple[SegmentationResult, str]:
    """Find the movable parts (paper, 3.2)."""
    settings = {**who.settings("verify"), "parts": parts, "labels": _bytes_of_labels(parts), "limit": solver.deadline.seconds}
    key = stage_key(SEGMENTATION, previous=previous, config=settings)
    found = _answered(run.load(SEGMENTATION, key), who)
    if found is None:
        with timed(run, "segment"):
            found = solver.parts(parts, recognized.recognition, progress)
        run.save(SEGMENTATION, key, found)
    return found, key


def _bytes_of_labels(parts: str) -> str:
    """Return the label file in hex, "" if it cannot be read; the stage then reports the error."""
    try:
        return Path(parts).read_bytes().hex() if parts not in ("auto", "nodes") and Path(parts).is_file() else ""
    except OSError:
        return ""


def estimate_joints(
    run: RunFolder,
    solver: Solver,
    recognized: RecognitionResult,
    segmented: SegmentationResult,
    previous: str,
    who: AnswererSetup,
    progress: Progress,
) -> JointResult:
    """Find the joint of each part (paper, 3.3)."""
    key = stage_key(JOINTS, previous=previous, config={**who.settings(), "limit": solver.deadline.seconds})
    found = _answered(run.load(JOINTS, key), who)
    if found is None:
        with timed(run, "joints"):
            grounded = segmented.answerer != GIVEN
            found = solver.joints(segmented.segmentation, recognized.recognition, progress, grounded)
        if found.segmentation is not None:
            run.save(SEGMENTATION, previous, replace(segmented, segmentation=found.segmentation))
        run.save(JOINTS, key, found)
    return found


def write_files(run: RunFolder, how: ExportOptions, deadline: Deadline, progress: Progress) -> Asset:
    """Write the files of the asset and its preview."""
    progress("export", "files", 0, 2)
    asset = run.asset()
    with timed(run, "export"), ThreadPoolExecutor(1) as aside:

        def draw() -> Future[None]:
            return aside.submit(write_preview, asset, run.folder / "preview.png")

        picture = draw() if len(asset.mesh.faces) <= ASIDE else None  # while child processes divide components
        model = write_asset(
            asset, run.folder, base=how.base, formats=how.formats, driven=how.driven, cache=cache_folder("shapes"),
            deadline=deadline,
        )  # fmt: skip
        progress("export", "preview", 1, 2)
        (picture or draw()).result()
    return replace(asset, warnings=model.asset.warnings, timing=run.timing())


@contextmanager
def timed(run: RunFolder, stage: str) -> Generator[None]:
    """Add the time spent inside to that of a stage, and attach the stage's name to errors."""
    begin = time.perf_counter()
    try:
        yield
    except Exception as error:
        note_stage(error, stage)
        raise
    run.add_time(stage, time.perf_counter() - begin)
