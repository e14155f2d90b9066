"""Stages within a run: each loads its saved result if its inputs and options are unchanged, else computes and saves it."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Generic, TypeVar

from anymesh.entry_points import SCENE_WARNING, resolve
from anymesh.export import load_libraries, write_asset
from anymesh.export.options import ExportOptions
from anymesh.loading import load_mesh, place_mesh
from anymesh.pipeline.answering import AnswererSetup
from anymesh.pipeline.options import PlacementOptions
from anymesh.pipeline.results import JointResult, LoadResult, RecognitionResult, SegmentationResult
from anymesh.pipeline.run_folder import RunFolder
from anymesh.pipeline.solving import Solver
from anymesh.pipeline.stage_files import JOINTS, MESH, RECOGNITION, SEGMENTATION, Stage, stage_key
from anymesh.rendering.preview import write_legend, write_preview
from anymesh.runtime import PREVIEW, Deadline, Progress, cache_folder
from anymesh.segmentation.naming import GIVEN
from anymesh.types import Asset, Source

Result = TypeVar("Result")
Answered = TypeVar("Answered", RecognitionResult, SegmentationResult, JointResult)
ASIDE = 500_000  # faces up to which the preview is drawn in parallel with writing; above, both together need too much memory


@dataclass(frozen=True, eq=False)
class Run:
    """One run of the pipeline: its output folder, its answerer, its deadline and its progress."""

    folder: RunFolder
    who: AnswererSetup
    deadline: Deadline
    progress: Progress

    def solver(self, loaded: LoadResult) -> Solver:
        """Return the solver of both stages for a mesh."""
        return Solver(loaded.mesh, self.who.config, self.who.factory, self.deadline, Path(loaded.source.path).stem)

    def answered(self, stage: Stage[Answered], key: str, name: str, compute: Callable[[], Answered]) -> Answered:
        """Return the saved result of a stage, or compute and save it.

        A saved result is not used if geometry answered it instead of a model, or if its answers have changed.
        """
        answered = self.folder.load(stage, key)
        if answered is None or any(e.given_up for e in answered.exchanges) or not self.who.is_current(answered.exchanges):
            with self.folder.timed(name):
                answered = compute()
            self.folder.save(stage, key, answered)
        return answered


@dataclass(frozen=True, eq=False)
class Keyed(Generic[Result]):
    """The result of a stage, with the key that it is saved under."""

    result: Result
    key: str


def load(run: Run, path: Path, how: PlacementOptions) -> Keyed[LoadResult]:
    """Load a mesh and bring it to metres, z up."""
    run.progress("load", path.name, 0, 1)
    with run.folder.timed("load"):
        loaded = load_mesh(path, root=how.root, animation=how.animation)
        category = run.who.config.category
        settings = {"up": how.up, "scale": how.scale, "category": category, "path": str(path), "references": loaded.references}
        settings |= {} if how.animation == "read" else {"animation": how.animation}
        settings |= {"credits": repr(loaded.credits)} if loaded.credits else {}
        key = stage_key(MESH, previous=loaded.sha256, config=settings)
        placed = run.folder.load(MESH, key)
        if placed is None:
            p = place_mesh(loaded, up=how.up, scale=how.scale, category=category)
            source = Source(str(path), loaded.sha256, p.T_asset_source, p.up, p.notes, loaded.credits)
            scene = resolve(SCENE_WARNING)(p.mesh)
            warnings = (*loaded.warnings, *p.warnings, *([scene] if scene else []))
            placed = LoadResult(p.mesh, source, warnings, p.metric, category or "")
            run.folder.save(MESH, key, placed)
    return Keyed(placed, key)


def recognize(run: Run, loaded: Keyed[LoadResult], parts: str, *, sized: bool) -> tuple[Solver, Keyed[RecognitionResult]]:
    """Recognize the object's category and movable parts with a model (paper, 3.1), or by geometry without requests.

    sized: whether the answered size sets the scale. Return also the solver of both stages for the mesh in its final size.
    """
    solver, who = run.solver(loaded.result), run.who
    if parts != "auto":
        solver.parts(parts)  # report invalid parts before any model call
    if not solver.answers.recognizes:
        return solver, Keyed(solver.answers.recognize(), loaded.key)
    metric = loaded.result.metric
    settings = {**who.settings("verify", "ask", "detail", "proposer", "probed"), "sized": sized, "metric": metric}
    key = stage_key(RECOGNITION, previous=loaded.key, config=settings)
    recognized = run.answered(RECOGNITION, key, "recognize", lambda: solver.answers.recognize(sized=sized, metric=metric))
    final = recognized.sized(loaded.result)
    return (solver if final.mesh is loaded.result.mesh else run.solver(final)), Keyed(recognized, key)


def find_parts(run: Run, solver: Solver, recognized: Keyed[RecognitionResult], parts: str) -> Keyed[SegmentationResult]:
    """Find the movable parts (paper, 3.2)."""
    settings = run.who.settings("verify", "ask") | {"parts": parts, "labels": _bytes_of_labels(parts)}
    settings["limit"] = run.deadline.limit
    key = stage_key(SEGMENTATION, previous=recognized.key, config=settings)
    recognition = recognized.result.recognition
    return Keyed(run.answered(SEGMENTATION, key, "segment", lambda: solver.parts(parts, recognition, run.progress)), key)


def _bytes_of_labels(parts: str) -> str:
    """Return the label file in hex, "" if it cannot be read; the stage then reports the error."""
    try:
        return Path(parts).read_bytes().hex() if parts not in ("auto", "nodes", "none") and Path(parts).is_file() else ""
    except OSError:
        return ""


def estimate_joints(
    run: Run, solver: Solver, recognized: RecognitionResult, segmented: Keyed[SegmentationResult]
) -> JointResult:
    """Find the joint of each part (paper, 3.3)."""

    def compute() -> JointResult:
        parts, grounded = segmented.result, segmented.result.answerer != GIVEN
        estimated = solver.joints(parts.segmentation, recognized.recognition, run.progress, grounded)
        if estimated.segmentation is not None:
            run.folder.save(SEGMENTATION, segmented.key, replace(parts, segmentation=estimated.segmentation))
        return estimated

    settings = {**run.who.settings(), "limit": run.deadline.limit} | ({"stated": True} if solver.mesh.joints else {})
    key = stage_key(JOINTS, previous=segmented.key, config=settings)
    return run.answered(JOINTS, key, "joints", compute)


def write_files(folder: RunFolder, how: ExportOptions, deadline: Deadline, progress: Progress) -> Asset:
    """Write the files of the asset and its preview; only the legend of the preview if the deadline is near."""
    progress("export", "files", 0, 2)
    load_libraries(how.formats)
    asset = how.written(folder.asset())
    brief = deadline.late(PREVIEW)
    if brief:
        deadline.leave_out("preview: it shows only the list of joints")
    with folder.timed("export"), ThreadPoolExecutor(1) as aside:

        def draw() -> Future[None]:
            return aside.submit(write_legend if brief else write_preview, asset, folder.folder / "preview.png")

        picture = draw() if len(asset.mesh.faces) <= ASIDE else None  # while child processes divide components
        warnings = write_asset(asset, folder.folder, how, cache=cache_folder("shapes"), deadline=deadline).asset.warnings
        progress("export", "preview", 1, 2)
        (picture or draw()).result()
    return replace(asset, warnings=warnings, timing=folder.timing())
