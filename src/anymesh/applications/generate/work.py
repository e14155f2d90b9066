"""What later runs resume from: a hidden work folder beside the output, and generation.json in it.

generation.json states the origin of an asset's mesh, the tasks paid for it, and the keys of the request.
"""

from __future__ import annotations

import json
import shutil
from collections.abc import Generator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path
from typing import Any

from anymesh import __version__
from anymesh.applications.generate.generators import GivenMesh
from anymesh.applications.generate.job import FREE, GenerationJob
from anymesh.applications.generate.protocol import GeneratedMesh, PaidTask, file_digest
from anymesh.errors import InputError, OutputError, redacted
from anymesh.finishing.meshy import Bought
from anymesh.finishing.meshy_api import RETEXTURE
from anymesh.geometry.topology import components
from anymesh.loading import load_mesh
from anymesh.pipeline.atomic_folder import GENERATED, GENERATION, locked
from anymesh.pipeline.run_folder import RunFolder
from anymesh.runtime import read_json, write_json, write_whole, writing

MADE = "made.json"
ANEW = "anew"  # marker file that exists while another mesh than that of the output is made
ARTICULATED = "articulated"
SCHEMA_VERSION = 1
WORDS = ("category", "texture")  # options that are free text of the user
STILL = "no moving part was found; try --at-least 1, a model (--answerer), or `anymesh view`"


@dataclass(frozen=True)
class WorkFolder:
    """Work folder of an output. folder: `.NAME.generate` beside the output NAME."""

    folder: Path

    @classmethod
    def of(cls, out: Path) -> WorkFolder:
        """Return the work folder of an output without creating it."""
        out = Path(out).resolve()
        return cls(out.parent / f".{out.name[:100]}.generate")

    @contextmanager
    def open(self) -> Generator[None]:
        """Create the folder and lock it for this run. Raise OutputError if that fails."""
        with writing(self.folder):
            self.folder.mkdir(parents=True, exist_ok=True)
        with locked(self.folder) as free:
            if not free:
                raise OutputError(f"another run works in {self.folder}; wait for it, or choose another output folder")
            yield

    @property
    def articulated(self) -> Path:
        """Folder of the asset between the pipeline and stage C."""
        return self.folder / ARTICULATED

    def made(self, key: str) -> GeneratedMesh | None:
        """Return the mesh that was made under a key, and its paid tasks; None if there is none, or it was changed."""
        held = read_json(self.folder / MADE)
        if held is None or held.get("key") != key:
            return None
        try:
            path = self.folder / Path(held["file"]).name
            tasks = tuple(PaidTask(**task) for task in held["tasks"])
            return GeneratedMesh(path, tasks) if file_digest(path) == held["sha256"] else None
        except (InputError, KeyError, TypeError):
            return None

    def keep(self, key: str, mesh: GeneratedMesh) -> None:
        """Record that a mesh of this folder is finished."""
        record = {
            "key": key,
            "file": mesh.path.name,
            "sha256": file_digest(mesh.path),
            "tasks": [asdict(task) for task in mesh.tasks],
        }
        write_whole(self.folder / MADE, (json.dumps(record, indent=1) + "\n").encode())

    @property
    def anew(self) -> bool:
        """Whether a run that makes another mesh was interrupted."""
        return (self.folder / ANEW).exists()

    def begin_anew(self) -> None:
        """Delete the mesh and the ids of paid tasks, unless they belong to an interrupted run that made another mesh."""
        if not self.anew:
            self._forget()
            (self.folder / ANEW).touch()

    def end_anew(self) -> None:
        """Remove the marker, so that the next call of `begin_anew` deletes the folder's content."""
        (self.folder / ANEW).unlink(missing_ok=True)

    def _forget(self) -> None:
        for path in self.folder.iterdir():
            if path.is_dir():
                shutil.rmtree(path, ignore_errors=True)
            else:
                path.unlink(missing_ok=True)


def generation_record(job: GenerationJob, mesh: GeneratedMesh, warnings: Sequence[str]) -> dict[str, Any]:
    """Return the content of generation.json as plain values, without keys, signed addresses and folders."""
    loaded = load_mesh(mesh.path, root=job.options["root"]).mesh
    given = isinstance(job.generator, GivenMesh)
    options = {k: v for k, v in job.options.items() if k not in (*FREE, "root") and v is not None}
    return {
        "schema_version": SCHEMA_VERSION,
        "request": job.request.as_dict(),
        "generator": dict(job.generator.settings(job.request)),
        "mesh": {
            "file": mesh.path.name if given else f"{GENERATED}/{mesh.path.name}",
            "sha256": file_digest(mesh.path),
            "faces": len(loaded.faces),
            "components": int(components(loaded.vertices, loaded.faces).label.max()) + 1,
        },
        **_cost(mesh.tasks),
        "size": {"scale": job.size.scale, "reason": job.size.reason},
        "options": {name: value if name in WORDS else _plain(value) for name, value in sorted(options.items())},
        "versions": {"anymesh": __version__},
        "keys": {
            "mesh": job.mesh_key,
            "articulated": job.key(finished=False),
            "finished": job.key(finished=True),
        },
        "warnings": list(warnings),
    }


def add_record(folder: Path, job: GenerationJob, mesh: GeneratedMesh, warnings: Sequence[str]) -> None:
    """Write generation.json and a generated mesh into an existing output."""
    record = generation_record(job, mesh, warnings)
    with RunFolder.open(folder) as run:
        if not isinstance(job.generator, GivenMesh):
            (run.folder / GENERATED).mkdir()
            (run.folder / GENERATED / mesh.path.name).write_bytes(mesh.path.read_bytes())
        write_json(run.folder / GENERATION, record)


def add_tasks(folder: Path, tasks: Sequence[PaidTask]) -> None:
    """Add paid tasks to the record in an output."""
    record = read_record(folder)
    if record is None or not tasks:
        return
    held = [PaidTask(**task) for task in record["tasks"]]
    with RunFolder.open(folder) as run:
        write_json(run.folder / GENERATION, {**record, **_cost((*held, *tasks))})


def read_record(folder: Path) -> Mapping[str, Any] | None:
    """Read generation.json of an output; None if there is none that can be read."""
    record = read_json(folder / GENERATION)
    return record if record is not None and isinstance(record.get("keys"), dict) else None


def recorded_mesh(out: Path, key: str) -> GeneratedMesh | None:
    """Return the mesh of an output if it was generated under this key and is unchanged; None otherwise."""
    record = read_record(out)
    if record is None or record["keys"].get("mesh") != key:
        return None
    try:
        path = out / GENERATED / Path(record["mesh"]["file"]).name
        tasks = (PaidTask(**task) for task in record["tasks"] if task["kind"] != RETEXTURE.type)
        return GeneratedMesh(path, tuple(tasks)) if file_digest(path) == record["mesh"]["sha256"] else None
    except (InputError, KeyError, TypeError):
        return None


def retexture_task(state: Path) -> tuple[PaidTask, ...]:
    """Return the paid task of retexturing, from the file that stores its id; empty if there is none."""
    held = read_json(state)
    bought = None if held is None else held.get("bought")
    if not isinstance(bought, dict):
        return ()
    purchase = Bought(**bought)
    return (PaidTask(RETEXTURE.type, purchase.task, purchase.credits, purchase.seed),)


def _cost(tasks: Sequence[PaidTask]) -> dict[str, Any]:
    return {"tasks": [asdict(task) for task in tasks], "credits": sum(task.credits for task in tasks)}


def _plain(value: Any) -> Any:
    if isinstance(value, bool | int | float):
        return value
    return [_plain(v) for v in value] if isinstance(value, list | tuple) else redacted(json.dumps(value).strip('"'))
