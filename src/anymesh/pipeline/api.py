"""The pipeline of the paper's overview figure: mesh -> parts -> joints -> asset -> files."""

from __future__ import annotations

import logging
from collections.abc import Generator, Iterator
from contextlib import contextmanager, suppress
from dataclasses import replace
from pathlib import Path
from typing import Unpack

from anymesh.entry_points import CHECK_ZIP, REMOVE_TRANSCRIPT, SAMPLES, WRITE_PACKAGE, WRITE_TRANSCRIPT, WRITE_ZIP, resolve
from anymesh.errors import OpenQuestionError, OptionError, OutputError
from anymesh.export import ExportOptions, Format
from anymesh.isolation import AHEAD, shared_pool
from anymesh.loading.load import reads_joints
from anymesh.pipeline.answering import AnswererSetup, choose_answerer, object_name
from anymesh.pipeline.options import Answering, MakingOptions, PlacementOptions, Writing, divided
from anymesh.pipeline.results import LoadResult
from anymesh.pipeline.run_folder import LAST, RunFolder
from anymesh.pipeline.stage_files import JOINTS, MESH, RECOGNITION, SEGMENTATION
from anymesh.pipeline.stages import Keyed, Run, estimate_joints, find_parts, load, recognize, write_files
from anymesh.runtime import DEFAULT_SECONDS, Deadline, Progress, read_json, silent
from anymesh.types import Asset, Exchange, Joint, Segmentation

log = logging.getLogger("anymesh")


def articulate(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    up: str = "auto",
    scale: str = "auto",
    root: str | Path | None = None,
    animation: str = "read",
    force: bool = False,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **options: Unpack[MakingOptions],
) -> Asset:
    """Turn a rigid mesh into an articulated asset and write it to the folder `out`.

    parts: "auto", "nodes" (the scene's nodes) or a file of face labels; up: auto, infer (not what the
    format defines), an axis such as z or -y, or a direction such as "0,0.7,0.7"; scale: auto, a factor (file units to metres)
    or METRES:AXIS;
    root: folder within which files that the mesh refers to may be read (default: the mesh's own); animation: read, or ignore
    (animations, physics joints, bones and pivots of the file tell no joints);
    time_limit: [s], past a share of which each stage shortens its work, with a warning; options: `FormatOptions` (base,
    formats, drives, hulls) and `AnswererOptions`.
    Raise InputError, OptionError, OutputError or ModelError; then nothing is written. After OpenQuestionError and BudgetError,
    finished stages are kept for the next call.
    """
    answering, writing = divided(options)
    how = ExportOptions.parse(writing)
    with new_run(mesh_path, out, answering, force, time_limit, progress) as run:
        shared_pool().warm(*AHEAD)
        loaded = load(run, Path(mesh_path), PlacementOptions(up, scale, root, animation))
        return articulate_loaded(run, loaded, parts, how, sized=scale == "auto")


def articulate_loaded(run: Run, loaded: Keyed[LoadResult], parts: str, how: ExportOptions, *, sized: bool) -> Asset:
    """Run all stages after the first. sized: whether an answered size sets the scale."""
    solver, recognized = recognize(run, loaded, parts, sized=sized)
    segmented = find_parts(run, solver, recognized, parts)
    estimate_joints(run, solver, recognized.result, segmented)
    del solver, recognized, segmented  # their surfaces need not stay in memory while files are written
    return write_files(run.folder, how, run.deadline, run.progress)


def segment(
    mesh_path: str | Path,
    out: str | Path,
    *,
    parts: str = "auto",
    up: str = "auto",
    scale: str = "auto",
    root: str | Path | None = None,
    animation: str = "read",
    force: bool = False,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **answering: Unpack[Answering],
) -> Segmentation:
    """Run only Stage A: save the parts of a mesh in `out` for `joints`. Options as for `articulate`."""
    with new_run(mesh_path, out, answering, force, time_limit, progress) as run:
        loaded = load(run, Path(mesh_path), PlacementOptions(up, scale, root, animation))
        solver, recognized = recognize(run, loaded, parts, sized=scale == "auto")
        return find_parts(run, solver, recognized, parts).result.segmentation


@contextmanager
def new_run(
    mesh_path: str | Path, out: str | Path, answering: Answering, force: bool, time_limit: float, progress: Progress
) -> Generator[Run]:
    """Begin a run that makes a new output, in the folder `out`."""
    deadline = Deadline(time_limit)
    who = choose_answerer(answering, about=object_name(mesh_path), deadline=deadline)
    with RunFolder.create(Path(out), source=Path(mesh_path), force=force) as folder, _kept_transcript(folder, who):
        yield Run(folder, who, deadline, progress)


def joints(
    folder: str | Path,
    *,
    animation: str = "read",
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **answering: Unpack[Answering],
) -> tuple[Joint, ...]:
    """Run only Stage B, on the parts that `segment` saved in `folder`. Options as for `articulate`."""
    deadline = Deadline(time_limit)
    who = choose_answerer(answering, deadline=deadline)
    with RunFolder.open(Path(folder)) as kept, _kept_transcript(kept, who):
        run = Run(kept, who, deadline, progress)
        recognized, segmented = kept.recognition(), Keyed(kept.need(SEGMENTATION), kept.key(SEGMENTATION))
        sized = recognized.sized(kept.need(MESH))
        solver = run.solver(sized if reads_joints(animation) else replace(sized, mesh=sized.mesh.without_joints()))
        return estimate_joints(run, solver, recognized, segmented).joints


def export_asset(
    folder: str | Path,
    *,
    package: str | Path | None = None,
    archive: str | Path | None = None,
    sample: int = 0,
    seed: int = 0,
    time_limit: float = DEFAULT_SECONDS,
    progress: Progress = silent,
    **writing: Unpack[Writing],
) -> Asset:
    """Write the files of the asset that `segment` and `joints` saved in `folder`.

    writing: as for `articulate`; what is not given stays as it was, and formats that the folder holds are written anew, besides
    those that are given.

    package: folder for a ROS 2 package of the URDF; archive: a zip file of the asset; sample: number of variants to write into
    `samples/`, in each of which a part moves by one of its articulations, drawn by weight with this seed.
    """
    deadline = Deadline(time_limit)
    samples = resolve(SAMPLES)(sample, seed)
    ExportOptions.parse(writing)  # report invalid values before anything is read
    if archive is not None:
        resolve(CHECK_ZIP)(Path(archive))
    with RunFolder.open(Path(folder)) as run:
        written = read_json(run.target / LAST) or {}
        how = ExportOptions.parse(writing, before=written)
        if written:
            how = how.with_formats(ExportOptions.parse({}, before=written).formats)
        if package is not None and Format.URDF not in how.formats:
            raise OptionError(f"--package needs the format urdf, found {','.join(how.formats)!r}")
        asset = write_files(run, how, deadline, progress)
        samples.write(asset, run.folder, how, progress)
    if package is not None:
        resolve(WRITE_PACKAGE)(Path(folder), Path(package), base=how.base)
    if archive is not None:
        resolve(WRITE_ZIP)(Path(folder), Path(archive))
    return asset


@contextmanager
def _kept_transcript(run: RunFolder, who: AnswererSetup) -> Generator[None]:
    """Write OUT.transcript beside the output if the run ends early, else remove that of an earlier run."""
    folder = run.target.parent / f"{run.target.name}.transcript"
    try:
        yield
    except OpenQuestionError:
        raise  # the folders of its questions contain them
    except BaseException:
        _write_exchanges(run, who, folder)
        raise
    if folder.exists():
        with suppress(OSError):
            resolve(REMOVE_TRANSCRIPT)(folder)


def _write_exchanges(run: RunFolder, who: AnswererSetup, folder: Path) -> None:
    saved = list(_saved_exchanges(run))
    exchanges = [*saved, *(e for e in who.exchanges() if e not in saved)]
    if exchanges:
        try:
            resolve(WRITE_TRANSCRIPT)(exchanges, folder)
            log.warning("what was asked and answered until then: %s", folder / "index.html")
        except OSError as error:  # the error that ended the run is more important
            log.warning("the transcript cannot be written to %s: %s", folder, error.strerror or error)


def _saved_exchanges(run: RunFolder) -> Iterator[Exchange]:
    for stage in (RECOGNITION, SEGMENTATION, JOINTS):
        with suppress(OutputError):
            yield from run.need(stage).exchanges
