"""Folder of an evaluation, with results per object, so that a stopped evaluation can be resumed."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

from anymesh.errors import OutputError
from anymesh.evaluation.record import Record, record_of, record_text
from anymesh.runtime import read_json, write_json

SETTINGS = "eval.json"
OBJECTS = "objects"  # folder with one file per object and one line per record
GENERATOR = "articulate-anymesh eval"
NEW = ("date", "python", "numpy", "machine")  # settings that may differ when an evaluation is resumed


@dataclass(frozen=True)
class ResultsFolder:
    """Records by object. `settings` are those with which the evaluation started."""

    folder: Path
    settings: Mapping[str, str]

    @classmethod
    def open(cls, folder: Path, settings: Mapping[str, str], *, force: bool = False) -> ResultsFolder:
        """Open a new folder, or one started with the same settings; `force` starts again.

        Raise OutputError if the folder holds anything else, or an evaluation with other settings.
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
            raise OutputError(f"{folder} is not empty and not an evaluation of anymesh; choose another folder")
        kept = {k: v for k, v in (begun or {}).items() if k != "generator"}
        differing = sorted(k for k in {*kept, *settings} - {*NEW} if kept.get(k) != settings.get(k))
        if ours and differing and not force:
            pairs = ", ".join(f"{k}: {kept.get(k, '-')} (now {settings.get(k, '-')})" for k in differing)
            raise OutputError(f"{folder} holds an evaluation with other settings: {pairs}; choose another folder, or --force")
        if ours and not force:
            return cls(folder, kept)
        for name in (OBJECTS, "pictures"):
            shutil.rmtree(folder / name, ignore_errors=True)
        (folder / OBJECTS).mkdir(parents=True)
        write_json(folder / SETTINGS, {"generator": GENERATOR, **settings})
        return cls(folder, dict(settings))

    def save(self, name: str, records: Sequence[Record]) -> None:
        """Write all records of an object atomically."""
        path = self._path(name)
        part = path.with_suffix(".part")
        part.write_text("".join(f"{record_text(r)}\n" for r in records), encoding="utf-8")
        part.replace(path)

    def load(self, name: str) -> list[Record]:
        """Read all records of an object; none if it was not evaluated yet, or if its file is damaged."""
        try:
            return [record_of(line) for line in self._path(name).read_text(encoding="utf-8").splitlines()]
        except (OSError, ValueError):
            return []

    def has(self, name: str) -> bool:
        """Return whether an object was evaluated without an error; objects with errors are evaluated again."""
        records = self.load(name)
        return bool(records) and not any(r.error for r in records)

    def _path(self, name: str) -> Path:
        return self.folder / OBJECTS / f"{name}.jsonl"
