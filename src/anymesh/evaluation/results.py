"""The folder of an evaluation: what was done is kept object by object, so that a stopped one goes on."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.evaluation.record import Record, record_of, record_text
from anymesh.storage.stage_files import read_json, write_json

SETTINGS = "eval.json"
OBJECTS = "objects"  # folder of a file an object, a line a record
GENERATOR = "articulate-anymesh eval"
NEW = ("date", "python", "numpy", "machine")  # may differ when an evaluation goes on


@dataclass(frozen=True)
class ResultsFolder:
    """Records by object. `settings` are those that the evaluation began with."""

    folder: Path
    settings: Mapping[str, str]

    @classmethod
    def open(cls, folder: Path, settings: Mapping[str, str], *, force: bool = False) -> ResultsFolder:
        """A new one, or one that was begun with the same settings; `force` begins anew.

        OutputError when the folder holds anything else, or an evaluation with other settings.
        """
        try:
            return cls._open(Path(folder), settings, force)
        except OSError as error:
            raise OutputError(f"cannot write to {folder}: {error.strerror or error}") from error

    @classmethod
    def _open(cls, folder: Path, settings: Mapping[str, str], force: bool) -> ResultsFolder:
        begun = read_json(folder / SETTINGS) if folder.is_dir() else None
        ours = begun is not None and begun.get("generator") == GENERATOR
        if not ours and folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            raise OutputError(f"{folder} is not empty and no evaluation of anymesh; choose another folder")
        kept = {k: v for k, v in (begun or {}).items() if k != "generator"}
        differing = sorted(k for k in {*kept, *settings} - {*NEW} if kept.get(k) != settings.get(k))
        if ours and differing and not force:
            told = ", ".join(f"{k}: {kept.get(k, '-')} (now {settings.get(k, '-')})" for k in differing)
            raise OutputError(f"{folder} holds an evaluation with other settings: {told}; choose another folder, or --force")
        if ours and not force:
            return cls(folder, kept)
        for name in (OBJECTS, "pictures"):
            shutil.rmtree(folder / name, ignore_errors=True)
        (folder / OBJECTS).mkdir(parents=True)
        write_json(folder / SETTINGS, {"generator": GENERATOR, **settings})
        return cls(folder, dict(settings))

    def save(self, name: str, records: Sequence[Record]) -> None:
        """Keeps all records of an object at once."""
        path = self._path(name)
        part = path.with_suffix(".part")
        part.write_text("".join(f"{record_text(r)}\n" for r in records), encoding="utf-8")
        part.replace(path)

    def load(self, name: str) -> list[Record]:
        """All records of an object; none when it was not evaluated yet, or its file is broken."""
        try:
            return [record_of(line) for line in self._path(name).read_text(encoding="utf-8").splitlines()]
        except (OSError, ValueError):
            return []

    def has(self, name: str) -> bool:
        """Whether an object was evaluated without an error; one with an error is tried again."""
        found = self.load(name)
        return bool(found) and not any(r.error for r in found)

    def _path(self, name: str) -> Path:
        return self.folder / OBJECTS / f"{name}.jsonl"
