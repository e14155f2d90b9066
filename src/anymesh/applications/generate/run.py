"""A generator, then the paper's pipeline: text or image -> mesh -> parts and joints -> finished asset. And its dry run."""

from __future__ import annotations

import shutil
import time
from collections.abc import Generator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any, Unpack

from anymesh import pipeline
from anymesh.applications.generate.generators import GivenMesh
from anymesh.applications.generate.job import GenerateOptions, GenerationJob, open_job
from anymesh.applications.generate.protocol import GeneratedMesh, Step
from anymesh.applications.generate.work import (
    STILL,
    WorkFolder,
    add_record,
    add_tasks,
    read_record,
    recorded_mesh,
    retexture_task,
)
from anymesh.errors import ModelError, OutputError, note_stage
from anymesh.export.options import ExportOptions
from anymesh.finishing.finishing import finish
from anymesh.finishing.meshy_api import RETEXTURE
from anymesh.pipeline.options import GEOMETRY, Account, FormatOptions, Spent, defaults
from anymesh.pipeline.run_folder import RunFolder, Saved
from anymesh.runtime import Progress, silent
from anymesh.types import Asset, JointType

CHECKED = "2026-11-21, docs.meshy.ai/en/api/retexture"  # date and source of the credits of retexturing


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
    """Generate a surface mesh from text or an image and make it a finished articulated asset in the folder `out`.

    generator: meshy (MESHY_API_KEY; paid), meshy:untextured, or command:PROGRAM with {out} and {prompt} or {image} (limited to
    generator_time_limit [s]); mesh: a file to use instead. options: those of `articulate` (except `parts`) and of `finish`;
    max_calls limits paid tasks and model calls together.

    A mesh is made once: a rerun of the same request uses it, and resumes a task that an earlier run paid for; regenerate: make
    and pay for another one. An output that the same call finished is returned unchanged.
    Raise as `articulate` and `finish`; ModelError if no mesh is returned, BudgetError before a task beyond the limit.
    """
    job = open_job(prompt, out, image=image, mesh=mesh, generator=generator, time_limit=generator_time_limit, options=options)
    if not (force or regenerate) and (done := _finished(job)) is not None:
        return done
    job.check(force=force)
    work = WorkFolder.of(job.out)
    with work.open(), _anew(work, regenerate):
        begin = time.perf_counter()
        made = _mesh(job, work, progress, anew=regenerate)
        seconds = time.perf_counter() - begin
        spent = options.get("spent") or Spent(calls=made.calls)
        _articulated(job, work, made, spent, progress)
        return _finish(job, work, spent, seconds, force, progress)


@contextmanager
def _anew(work: WorkFolder, wanted: bool) -> Generator[None]:
    """Start over if `wanted`. If a kill or a ModelError ends the run, the next run that starts over resumes it instead."""
    if wanted:
        work.begin_anew()
    try:
        yield
    except ModelError:
        raise
    except Exception:
        work.end_anew()
        raise
    work.end_anew()


def finished_before(job: GenerationJob) -> bool:
    """Return whether the output is the result of this job."""
    record = read_record(job.out)
    return record is not None and record["keys"].get("finished") == job.key(finished=True) and not job.by_files


def mesh_before(job: GenerationJob, work: WorkFolder, *, anew: bool) -> GeneratedMesh | None:
    """Return the mesh that an earlier run made for this job, from the work folder or the output; None if there is none.

    anew: ignore the mesh of the output, and that of the work folder unless it belongs to an interrupted regeneration.
    """
    if isinstance(job.generator, GivenMesh) or (anew and not work.anew):
        return None
    return work.made(job.mesh_key) or (None if anew else recorded_mesh(job.out, job.mesh_key))


def _finished(job: GenerationJob) -> Asset | None:
    if not (finished_before(job) and (job.out / "asset.json").is_file()):
        return None
    asset = Saved.at(job.out).written()
    return None if any(e.given_up for e in asset.exchanges) else _warned(asset, job)


def _mesh(job: GenerationJob, work: WorkFolder, progress: Progress, *, anew: bool) -> GeneratedMesh:
    """Return the mesh of an earlier run, or a new one."""
    try:
        held = mesh_before(job, work, anew=anew)
        if held is None:
            progress("generate", job.generator.name, 0, 1)
            job.generator.check()
            held = job.generator.make(job.request, work.folder, progress)
        elif held.path.parent != work.folder:
            held = replace(held, path=Path(shutil.copyfile(held.path, work.folder / held.path.name)))
        if not isinstance(job.generator, GivenMesh):
            work.keep(job.mesh_key, held)
        return held
    except OSError as error:
        raise OutputError(f"cannot write {work.folder}: {error.strerror or error}") from error
    except Exception as error:
        note_stage(error, "generate")
        raise


def _articulated(job: GenerationJob, work: WorkFolder, made: GeneratedMesh, spent: Account, progress: Progress) -> None:
    """Run stages A and B on the mesh, in the work folder."""
    folder = work.articulated
    if _articulated_before(job, folder):
        return
    root = {} if isinstance(job.generator, GivenMesh) else {"root": None}
    how: dict[str, Any] = {**job.articulating(), **root, "spent": spent, "progress": progress}
    asset = pipeline.articulate(made.path, folder, force=folder.exists(), **how)
    add_record(folder, job, made, _added(asset, job))


def _articulated_before(job: GenerationJob, folder: Path) -> bool:
    record = read_record(folder)
    if record is None or record["keys"].get("articulated") != job.key(finished=False) or job.by_files:
        return False
    return not any(e.given_up for e in Saved.at(folder).asset().exchanges)


def _finish(job: GenerationJob, work: WorkFolder, spent: Account, seconds: float, force: bool, progress: Progress) -> Asset:
    """Run stage C from the work folder to the output. seconds: spent on the mesh."""
    options, most = job.options, job.options.get("max_calls")
    finished = finish(
        work.articulated,
        job.out,
        completer=options["completer"],
        texture=options["texture"],
        watertight=options["watertight"],
        max_calls=None if most is None else max(0, most - spent.calls),
        force=force,
        progress=progress,
        **{name: options[name] for name in defaults(FormatOptions)},
    )
    timing = _add_timing(job.out, {"generate": seconds, **Saved.at(work.articulated).timing()})
    if options["texture"].startswith("meshy"):
        add_tasks(job.out, retexture_task(job.out.parent / f".{job.out.name}.meshy.json"))
    shutil.rmtree(work.articulated, ignore_errors=True)
    with suppress(OSError):
        work.folder.rmdir()  # only if empty
    return _warned(replace(finished, timing=timing), job)


def _add_timing(out: Path, before: Mapping[str, float]) -> Mapping[str, float]:
    """Add the seconds of the stages before stage C to timing.json of the output."""
    with RunFolder.open(out) as run:
        for stage, seconds in before.items():
            run.add_time("export before stage C" if stage == "export" else stage, seconds)
        return run.timing()


def _added(asset: Asset, job: GenerationJob) -> tuple[str, ...]:
    """Return warnings about the whole run, in addition to those of the stages."""
    size = (job.size.warning,) if job.size.warning else ()
    return size if any(joint.type is not JointType.FIXED for joint in asset.joints) else (*size, STILL)


def _warned(asset: Asset, job: GenerationJob) -> Asset:
    return replace(asset, warnings=(*_added(asset, job), *asset.warnings))


@dataclass(frozen=True)
class Explanation:
    """Result of a dry run. steps: in order; size: of the object, in words; warnings: known before the run."""

    steps: tuple[Step, ...]
    size: str
    warnings: tuple[str, ...] = ()

    @property
    def credits(self) -> float:
        """Approximate total of the credits that services take."""
        return sum(step.credits for step in self.steps)


def explain_generation(
    prompt: str | None,
    out: str | Path,
    *,
    image: str | Path | None = None,
    mesh: str | Path | None = None,
    generator: str = "meshy",
    generator_time_limit: float = 1800.0,
    regenerate: bool = False,
    force: bool = False,
    **options: Unpack[GenerateOptions],
) -> Explanation:
    """Return the steps of `generate` with these options, without writing or sending anything and without a key.

    Raise OptionError or InputError.
    """
    job = open_job(prompt, out, image=image, mesh=mesh, generator=generator, time_limit=generator_time_limit, options=options)
    warnings = (job.size.warning,) if job.size.warning else ()
    if not (force or regenerate) and finished_before(job):
        done = Step(f"return {job.out.name} as it is: it was finished by the same call")
        return Explanation((done,), job.size.reason, warnings)
    try:
        job.check_output(force=force)
    except OutputError as error:
        warnings = (*warnings, f"it would stop immediately: {error}")
    return Explanation((*_making(job, regenerate), *_following(job)), job.size.reason, warnings)


def _making(job: GenerationJob, anew: bool) -> tuple[Step, ...]:
    held = mesh_before(job, WorkFolder.of(job.out), anew=anew)
    if held is None:
        return job.generator.steps(job.request)
    return (Step(f"use the mesh that an earlier run made, {held.path.name}; nothing is paid for it"),)


def _following(job: GenerationJob) -> tuple[Step, ...]:
    options = job.options
    formats = ", ".join(ExportOptions.parse(options).formats)
    who = "geometry, without a model" if job.answerer == GEOMETRY else f"{job.answerer}; its cost is limited by --max-cost"
    return (
        Step(f"find parts and joints, as `anymesh articulate` does; questions are answered by {who}"),
        Step(f"complete shapes, as `anymesh finish` does (by {options['completer']}): inner walls, boxes behind drawers"),
        _looks(options["texture"]),
        Step(f"write {formats}, preview.png, asset.json, generation.json to {job.out}"),
    )


def _looks(texture: str) -> Step:
    if texture.startswith("meshy"):
        description = f"pay Meshy for {RETEXTURE.name} ({RETEXTURE.path}); the finished object is sent"
        return Step(description, float(RETEXTURE.credits), CHECKED)
    return Step("keep the appearance of the mesh" if texture == "builtin" else f"bake the appearance into an atlas ({texture})")
