"""The paper's figure with a generator before it: words or a picture -> mesh -> parts and joints -> a finished asset."""

from __future__ import annotations

import shutil
import time
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, Unpack

from anymesh import pipeline
from anymesh.applications.generate.given import GivenMesh
from anymesh.applications.generate.job import GenerateOptions, Job, open_job
from anymesh.applications.generate.protocol import GeneratedMesh, PaidTask, file_digest
from anymesh.applications.generate.record import STILL, add_record, add_tasks, read_record, retexture_task
from anymesh.applications.generate.work import WorkFolder
from anymesh.errors import InputError, note_stage
from anymesh.models.budget import Account, Spent
from anymesh.progress import Progress, silent
from anymesh.run_folder import RunFolder
from anymesh.storage.outputs import GENERATED
from anymesh.storage.saved import Saved
from anymesh.types import Asset


def generate(
    prompt: str | None,
    out: str | Path,
    *,
    image: str | Path | None = None,
    mesh: str | Path | None = None,
    generator: str = "meshy",
    generator_time_limit: float = 1800.0,
    regenerate: bool = False,
    force: bool = False,
    progress: Progress = silent,
    **options: Unpack[GenerateOptions],
) -> Asset:
    """Make a surface mesh by words or a picture, and of it a finished articulated asset in the folder `out`.

    generator: meshy (MESHY_API_KEY; paid), meshy:untextured, or command:PROGRAM with {out} and {prompt} or {image} (of at
    most generator_time_limit [s]); mesh: a file to start from instead. options: those of `articulate` (but `parts`) and of
    `finish`; max_calls counts paid tasks and calls of a model together.

    A mesh is made once: a rerun of the same request uses it, and goes on with a task that an earlier run paid for;
    regenerate: make, and pay for, another. An output that the same call finished is returned as it is.
    Raises as `articulate` and `finish`; ModelError where no mesh comes back, BudgetError before what would pass the limit.
    """
    job = open_job(prompt, out, image=image, mesh=mesh, generator=generator, time_limit=generator_time_limit, options=options)
    if not (force or regenerate) and (done := _finished(job)) is not None:
        return done
    job.check(force=force)
    work = WorkFolder.of(job.out)
    with work.open():
        if regenerate:
            work.forget()
        begin = time.perf_counter()
        made = _mesh(job, work, progress, again=regenerate)
        seconds = time.perf_counter() - begin
        spent = options.get("spent") or Spent(calls=made.calls)
        asset = _articulated(job, work, made, spent, progress)
        return _finish(job, work, asset, spent, seconds, force, progress)


def finished_before(job: Job) -> bool:
    """Whether the output is what this job makes."""
    record = read_record(job.out)
    return record is not None and record["keys"].get("finished") == job.key(finished=True) and not job.by_files


def mesh_before(job: Job, work: WorkFolder) -> GeneratedMesh | None:
    """The mesh that an earlier run made for this job: that of the work folder, or of the output."""
    return None if isinstance(job.generator, GivenMesh) else work.made(job.mesh_key) or _of_output(job)


def _finished(job: Job) -> Asset | None:
    if not (finished_before(job) and (job.out / "asset.json").is_file()):
        return None
    asset = Saved.at(job.out).asset()
    return None if any(e.given_up for e in asset.exchanges) else _warned(asset, job)


def _mesh(job: Job, work: WorkFolder, progress: Progress, *, again: bool) -> GeneratedMesh:
    """The mesh of an earlier run, or a new one."""
    held = None if again else mesh_before(job, work)
    if held is None:
        progress("generate", job.generator.name, 0, 1)
        try:
            job.generator.check()
            held = job.generator.make(job.request, work.folder, progress)
        except Exception as error:
            note_stage(error, "generate")
            raise
    elif held.path.parent != work.folder:
        held = replace(held, path=Path(shutil.copyfile(held.path, work.folder / held.path.name)))
    if not isinstance(job.generator, GivenMesh):
        work.keep(job.mesh_key, held)
    return held


def _of_output(job: Job) -> GeneratedMesh | None:
    """The mesh that the output was made of, where this job asks for the same."""
    record = read_record(job.out)
    if record is None or record["keys"].get("mesh") != job.mesh_key:
        return None
    path = job.out / GENERATED / Path(record["mesh"]["file"]).name
    try:
        same = file_digest(path) == record["mesh"]["sha256"]
    except InputError:
        return None
    return GeneratedMesh(path, tuple(PaidTask(**task) for task in record["tasks"])) if same else None


def _articulated(job: Job, work: WorkFolder, made: GeneratedMesh, spent: Account, progress: Progress) -> Asset:
    """Stages A and B of the mesh, in the work folder."""
    folder = work.articulated
    record = read_record(folder)
    if record is not None and record["keys"].get("articulated") == job.key(finished=False) and not job.by_files:
        asset = Saved.at(folder).asset()
        if not any(e.given_up for e in asset.exchanges):
            return _warned(asset, job)
    root = {} if isinstance(job.generator, GivenMesh) else {"root": None}
    how: dict[str, Any] = {**job.articulating(), **root, "spent": spent, "progress": progress}
    asset = _warned(pipeline.articulate(made.path, folder, force=folder.exists(), **how), job)
    add_record(folder, job, made, _added(asset, job))
    return asset


def _finish(job: Job, work: WorkFolder, asset: Asset, spent: Account, seconds: float, force: bool, progress: Progress) -> Asset:
    """Stage C, from the work folder to the output. seconds: that the mesh took."""
    options, most = job.options, job.options.get("max_calls")
    finished = pipeline.finish(
        work.articulated,
        job.out,
        completer=options["completer"],
        texture=options["texture"],
        watertight=options["watertight"],
        max_calls=None if most is None else max(0, most - spent.calls),
        base=options["base"],
        formats=options["formats"],
        drives=options["drives"],
        force=force,
        progress=progress,
    )
    timing = _add_timing(job.out, {"generate": seconds, **Saved.at(work.articulated).timing()})
    if options["texture"].startswith("meshy"):
        add_tasks(job.out, retexture_task(job.out.parent / f".{job.out.name}.meshy.json"))
    shutil.rmtree(work.articulated, ignore_errors=True)
    with suppress(OSError):
        work.folder.rmdir()  # nothing was made in it
    return _warned(replace(finished, timing=timing), job)


def _add_timing(out: Path, before: Mapping[str, float]) -> Mapping[str, float]:
    """Add the seconds of the stages before stage C to timing.json of the output."""
    with RunFolder.open(out) as run:
        for stage, seconds in before.items():
            run.add_time("export before stage C" if stage == "export" else stage, seconds)
        return run.timing()


def _added(asset: Asset, job: Job) -> tuple[str, ...]:
    """What a user should know of the whole, beside the warnings of the stages."""
    size = (job.size.warning,) if job.size.warning else ()
    return size if asset.joints else (*size, STILL)


def _warned(asset: Asset, job: Job) -> Asset:
    return replace(asset, warnings=(*_added(asset, job), *asset.warnings))
