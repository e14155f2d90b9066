"""Hidden work folder beside an output, in which later runs find meshes that were made or paid for."""

from __future__ import annotations

import json
import shutil
from collections.abc import Generator
from contextlib import contextmanager
from dataclasses import asdict, dataclass
from pathlib import Path

from anymesh.applications.generate.protocol import GeneratedMesh, PaidTask, file_digest
from anymesh.errors import InputError, OutputError
from anymesh.pipeline.storage.atomic_folder import locked
from anymesh.runtime import read_json, write_whole

MADE = "made.json"
ANEW = "anew"  # marker file that exists while another mesh than that of the output is made
ARTICULATED = "articulated"


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
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise OutputError(f"cannot write {self.folder}: {error.strerror or error}") from None
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
