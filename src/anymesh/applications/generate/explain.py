"""Dry run: the steps and costs of a run, before anything is made, sent, paid or written."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Unpack

from anymesh.applications.generate.job import GenerateOptions, GenerationJob, open_job
from anymesh.applications.generate.protocol import Step
from anymesh.applications.generate.run import finished_before, mesh_before
from anymesh.applications.generate.work import WorkFolder
from anymesh.errors import OutputError
from anymesh.export.options import ExportOptions
from anymesh.finishing.meshy_api import RETEXTURE
from anymesh.pipeline.options import GEOMETRY

CHECKED = "2026-11-21, docs.meshy.ai/en/api/retexture"  # date and source of the credits of retexturing


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
    formats = ", ".join(ExportOptions.parse(options["base"], options["formats"], options["drives"]).formats)
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
