"""The paper's figure: mesh -> parts -> joints -> asset -> files."""

from __future__ import annotations

import time
from collections.abc import Generator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TypeVar, Unpack

from anymesh import stage_results as results
from anymesh.answering import AnswererSetup, Answering, choose_answerer, object_name
from anymesh.deadline import DEFAULT_SECONDS, Deadline
from anymesh.errors import OptionError, note_stage
from anymesh.export import Base, Driven, Format, write_asset
from anymesh.export.archive import write_zip
from anymesh.export.formats import DEFAULT
from anymesh.export.package import write_package
from anymesh.export_options import ExportOptions
from anymesh.isolation import AHEAD, shared_pool
from anymesh.loading import load_mesh, place_mesh
from anymesh.models.cache import cache_folder
from anymesh.progress import Progress, silent
from anymesh.rendering.preview import write_preview
from anymesh.run_folder import RunFolder, stage_key
from anymesh.segmentation.given import GIVEN
from anymesh.solving import Solver
from anymesh.stage_results import COMPLETION, JOINTS, MESH, RECOGNITION, SEGMENTATION
from anymesh.stopped_run import kept_transcript
from anymesh.types import Asset, Joint, Segmentation, Source

Result = TypeVar("Result", results.RecognitionResult, results.SegmentationResult, results.JointResult)
ASIDE = 500_000  # faces up to which the preview is drawn beside the files; with more, both together take too much memory


def articulate(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    up: str = "auto",
    scale: str = "auto",
    root: str | Path | None = None,
    force: bool = False,
    base: str = Base.FIXED,
    formats: str = ",".join(DEFAULT),
    drives: str = Driven.PASSIVE,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **answering: Unpack[Answering],
) -> Asset:
    """Turns a rigid mesh into an articulated asset and writes it to the folder `out`.

    parts: "auto", "nodes" (the scene's nodes) or a file of face labels; up: auto, x, y, z; scale: auto, a factor (file units
    to metres) or METRES:AXIS; root: the folder within which files that the mesh refers to may be read (default: the mesh's
    own); base: fixed or free; formats: of urdf, mjcf, usd, sdf, glb, with commas between;
    drives: passive, or position (joints are led to a commanded position); time_limit: [s], past a share of which each stage
    cuts its work short and says so in the warnings. Raises InputError, OptionError, OutputError, ModelError; then nothing is
    written. OpenQuestionError and BudgetError: what is finished is kept for the next call.
    """
    how, deadline = ExportOptions.parse(base, formats, drives), Deadline(time_limit)
    who = choose_answerer(answering, about=object_name(mesh_path), deadline=deadline)
    shared_pool().warm(*AHEAD)
    with RunFolder.create(Path(out), source=Path(mesh_path), force=force) as run, kept_transcript(run, who):
        solver, recognized, key = _seen(run, Path(mesh_path), parts, Placement(up, scale, root), who, deadline, progress)
        segmented, key = _segment(run, solver, recognized, key, parts, who, progress)
        _join(run, solver, recognized, segmented, key, who, progress)
        return _export(run, how, deadline, progress)


def segment(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    up: str = "auto",
    scale: str = "auto",
    root: str | Path | None = None,
    force: bool = False,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **answering: Unpack[Answering],
) -> Segmentation:
    """Stage A alone: the parts of a mesh, saved in `out` for `joints`. Options as for `articulate`."""
    deadline = Deadline(time_limit)
    who = choose_answerer(answering, about=object_name(mesh_path), deadline=deadline)
    with RunFolder.create(Path(out), source=Path(mesh_path), force=force) as run, kept_transcript(run, who):
        solver, recognized, key = _seen(run, Path(mesh_path), parts, Placement(up, scale, root), who, deadline, progress)
        return _segment(run, solver, recognized, key, parts, who, progress)[0].segmentation


def joints(
    folder: str | Path, *, time_limit: float = DEFAULT_SECONDS, progress: Progress = silent, **answering: Unpack[Answering]
) -> tuple[Joint, ...]:
    """Stage B alone, on the parts that `segment` saved in `folder`. Options as for `articulate`."""
    deadline = Deadline(time_limit)
    who = choose_answerer(answering, deadline=deadline)
    with RunFolder.open(Path(folder)) as run, kept_transcript(run, who):
        recognized, segmented = run.recognition(), run.need(SEGMENTATION)
        solver = Solver(recognized.sized(run.need(MESH)).mesh, who.config, who.factory, deadline)
        return _join(run, solver, recognized, segmented, run.key(SEGMENTATION), who, progress).joints


def export(
    folder: str | Path,
    *,
    base: str = Base.FIXED,
    formats: str = ",".join(DEFAULT),
    drives: str = Driven.PASSIVE,
    package: str | Path | None = None,
    archive: str | Path | None = None,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
) -> Asset:
    """Writes the files of the asset that `segment` and `joints` saved in `folder`. Options as for `articulate`.

    package: a folder that gets a ROS 2 package of the URDF; archive: a zip file of the asset.
    """
    how, deadline = ExportOptions.parse(base, formats, drives), Deadline(time_limit)
    if package is not None and Format.URDF not in how.formats:
        raise OptionError(f"--package needs the format urdf, found {formats!r}")
    with RunFolder.open(Path(folder)) as run:
        asset = _export(run, how, deadline, progress)
    if package is not None:
        write_package(Path(folder), Path(package), base=how.base)
    if archive is not None:
        write_zip(Path(folder), Path(archive))
    return asset


def finish(
    folder: str | Path,
    out: str | Path,
    *,
    completer: str = "builtin",
    texture: str = "builtin",
    watertight: bool = True,
    max_calls: int | None = None,
    base: str = Base.FIXED,
    formats: str = ",".join(DEFAULT),
    drives: str = Driven.PASSIVE,
    force: bool = False,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
) -> Asset:
    """Stage C: completes shapes and looks of the asset in `folder`, an output of `articulate`, and writes it to `out`.

    completer: builtin, off, holopart:FOLDER[#PYTHON] or holopart:URL; texture: builtin, bake, bake:PIXELS, meshy or
    meshy:PROMPT, with at most `max_calls` paid tasks; watertight: also close what no motion lays open; time_limit: [s], as
    for `articulate`. Raises OptionError, OutputError, ModelError, BudgetError; a paid task that was begun is resumed by the
    next run.
    """
    from anymesh.finishing import finish_asset
    from anymesh.postprocessing.outside import open_completer, open_retexturer
    from anymesh.postprocessing.settings import ShapeConfig

    how, deadline = ExportOptions.parse(base, formats, drives), Deadline(time_limit)
    out = Path(out)
    who = open_completer(completer)
    looks = open_retexturer(texture, state=out.parent / f".{out.name}.meshy.json", max_calls=max_calls)
    with RunFolder.create(out, source=Path(folder) / "asset.json", force=force) as run:
        run.take_over(Path(folder))
        progress("finish", completer, 0, 1)
        settings = {"by": completer, "texture": texture, "tight": watertight, "limit": time_limit}
        key = stage_key(COMPLETION, previous=run.last_key(), config=settings)
        if run.load(COMPLETION, key) is None:
            with _timed(run, "finish"):
                done = finish_asset(
                    run.asset(),
                    shapes=completer != "off",
                    completer=who,
                    retexturer=looks,
                    config=ShapeConfig(watertight=watertight),
                    deadline=deadline,
                )
            run.save(COMPLETION, key, done)
        return _export(run, how, deadline, progress)


@dataclass(frozen=True)
class Placement:
    """How a mesh is read and placed; the words of the options."""

    up: str
    scale: str
    root: str | Path | None


def _seen(
    run: RunFolder, path: Path, parts: str, how: Placement, who: AnswererSetup, deadline: Deadline, progress: Progress
) -> tuple[Solver, results.RecognitionResult, str]:
    """The mesh placed, looked at, and in the size that was answered; ready for both stages."""
    placed, key = _place(run, path, how, who.config.category, progress)
    solver = Solver(placed.mesh, who.config, who.factory, deadline)
    if parts != "auto":
        solver.parts(parts)  # what is wrong with them is better told before anything is asked
    recognized, key = _recognize(run, solver, key, who, how.scale == "auto", placed.metric)
    sized = recognized.sized(placed)
    return (solver if sized is placed else Solver(sized.mesh, who.config, who.factory, deadline)), recognized, key


def _place(
    run: RunFolder, path: Path, how: Placement, category: str | None, progress: Progress
) -> tuple[results.LoadResult, str]:
    progress("load", path.name, 0, 1)
    with _timed(run, "load"):
        loaded = load_mesh(path, root=how.root)
        settings = {"up": how.up, "scale": how.scale, "category": category, "path": str(path), "references": loaded.references}
        key = stage_key(MESH, previous=loaded.sha256, config=settings)
        found = run.load(MESH, key)
        if found is None:
            p = place_mesh(loaded, up=how.up, scale=how.scale, category=category)
            source = Source(str(path), loaded.sha256, p.T_asset_source, p.up, p.notes)
            found = results.LoadResult(p.mesh, source, (*loaded.warnings, *p.warnings), p.metric)
            run.save(MESH, key, found)
    return found, key


def _answered(found: Result | None, who: AnswererSetup) -> Result | None:
    """A saved stage, unless geometry stood in for a model there (the model is asked again), or its answers have changed."""
    if found is None or any(e.given_up for e in found.exchanges) or not who.is_current(found.exchanges):
        return None
    return found


def _recognize(
    run: RunFolder, solver: Solver, previous: str, who: AnswererSetup, sized: bool, metric: bool
) -> tuple[results.RecognitionResult, str]:
    if who.factory is None:
        return solver.recognize(), previous
    key = stage_key(
        RECOGNITION, previous=previous, config={**who.settings("verify", "proposer"), "sized": sized, "metric": metric}
    )
    found = _answered(run.load(RECOGNITION, key), who)
    if found is None:
        with _timed(run, "recognize"):
            found = solver.recognize(sized=sized, metric=metric)
        run.save(RECOGNITION, key, found)
    return found, key


def _segment(
    run: RunFolder, solver: Solver, recognized: results.RecognitionResult, previous: str, parts: str, who: AnswererSetup,
    progress: Progress,
) -> tuple[results.SegmentationResult, str]:  # fmt: skip
    settings = {**who.settings("verify"), "parts": parts, "labels": _bytes_of_labels(parts), "limit": solver.deadline.seconds}
    key = stage_key(SEGMENTATION, previous=previous, config=settings)
    found = _answered(run.load(SEGMENTATION, key), who)
    if found is None:
        with _timed(run, "segment"):
            found = solver.parts(parts, recognized.recognition, progress)
        run.save(SEGMENTATION, key, found)
    return found, key


def _bytes_of_labels(parts: str) -> str:
    """The label file in hex, "" when there is none that can be read: the stage then tells what is wrong with it."""
    try:
        return Path(parts).read_bytes().hex() if parts not in ("auto", "nodes") and Path(parts).is_file() else ""
    except OSError:
        return ""


def _join(
    run: RunFolder, solver: Solver, recognized: results.RecognitionResult, segmented: results.SegmentationResult,
    previous: str, who: AnswererSetup, progress: Progress,
) -> results.JointResult:  # fmt: skip
    key = stage_key(JOINTS, previous=previous, config={**who.settings(), "limit": solver.deadline.seconds})
    found = _answered(run.load(JOINTS, key), who)
    if found is None:
        with _timed(run, "joints"):
            grounded = segmented.answerer != GIVEN
            found = solver.joints(segmented.segmentation, recognized.recognition, progress, grounded)
        if found.segmentation is not None:
            run.save(SEGMENTATION, previous, replace(segmented, segmentation=found.segmentation))
        run.save(JOINTS, key, found)
    return found


def _export(run: RunFolder, how: ExportOptions, deadline: Deadline, progress: Progress) -> Asset:
    progress("export", "files", 0, 2)
    asset = run.asset()
    with _timed(run, "export"), ThreadPoolExecutor(1) as aside:

        def draw() -> Future[None]:
            return aside.submit(write_preview, asset, run.folder / "preview.png")

        picture = draw() if len(asset.mesh.faces) <= ASIDE else None  # while children divide components
        model = write_asset(
            asset, run.folder, base=how.base, formats=how.formats, driven=how.driven, cache=cache_folder("shapes"),
            deadline=deadline,
        )  # fmt: skip
        progress("export", "preview", 1, 2)
        (picture or draw()).result()
    return replace(asset, warnings=model.asset.warnings, timing=run.timing())


@contextmanager
def _timed(run: RunFolder, stage: str) -> Generator[None]:
    begin = time.perf_counter()
    try:
        yield
    except Exception as error:
        note_stage(error, stage)
        raise
    run.add_time(stage, time.perf_counter() - begin)
