"""Articulation of many meshes in one run; an open question or an error of one object does not stop the others."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh import pipeline
from anymesh.errors import AnymeshError, BudgetError, InputError, MissingExtraError, OpenQuestionError, OptionError, OutputError
from anymesh.loading.files import FORMATS
from anymesh.pipeline.options import FILES, GEOMETRY, Spent
from anymesh.runtime import Progress, read_json, silent

ENDING = (BudgetError, MissingExtraError, OptionError)  # errors that would recur for every other object


@dataclass(frozen=True)
class MeshOutcome:
    """Result for one mesh. error: what stopped it, None if its asset is written."""

    mesh: Path
    out: Path
    error: AnymeshError | None = None

    @property
    def state(self) -> str:
        """done, open (a question is unanswered) or failed."""
        if self.error is None:
            return "done"
        return "open" if isinstance(self.error, OpenQuestionError) else "failed"


def articulate_many(
    meshes: Sequence[str | Path], out: str | Path, *, progress: Progress = silent, **options: Any
) -> list[MeshOutcome]:
    """Articulate each mesh into a folder with its name in `out`; existing outputs of the same mesh are kept.

    meshes: files, or folders with files; options: as for `articulate`. With `files:FOLDER`, the questions of an object are in a
    folder with its name in FOLDER.
    Raise OptionError for meshes with the same name, BudgetError if the common budget is exceeded.
    """
    files = mesh_files(meshes)
    answerer, spent = str(options.pop("answerer", GEOMETRY)), Spent()
    outcomes = []
    for number, (name, path) in enumerate(files.items()):
        progress("batch", name, number, len(files))
        target = Path(out) / name
        who = f"{FILES}{Path(answerer.removeprefix(FILES)) / name}" if answerer.startswith(FILES) else answerer
        try:
            if not _is_done(path, target, who, force=bool(options.get("force"))):
                pipeline.articulate(path, target, answerer=who, spent=spent, progress=progress, **options)
            outcomes.append(MeshOutcome(path, target))
        except ENDING:
            raise
        except AnymeshError as error:
            outcomes.append(MeshOutcome(path, target, error))
    return outcomes


def mesh_files(meshes: Sequence[str | Path]) -> dict[str, Path]:
    """Find the mesh files by name, including those directly in a folder. Raise InputError or OptionError."""
    files: dict[str, Path] = {}
    for given in map(Path, meshes):
        inside = sorted(p for p in given.iterdir() if p.suffix.lower() in FORMATS) if given.is_dir() else [given]
        if not inside:
            raise InputError(f"{given} holds no mesh; valid are files with {', '.join(FORMATS)}")
        for path in inside:
            if path.stem in files and files[path.stem] != path:
                raise OptionError(f"--batch identifies objects by name; {files[path.stem]} and {path} have the same")
            files[path.stem] = path
    return files


def _is_done(mesh: Path, target: Path, answerer: str, *, force: bool) -> bool:
    """Return whether the asset exists. Raise OutputError if it was made from another mesh or by another answerer."""
    asset = None if force else read_json(target / "asset.json")
    if asset is None:
        return False
    try:
        digest = hashlib.sha256(mesh.read_bytes()).hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {mesh}: {error.strerror or error}") from error
    same = asset.get("source", {}).get("sha256") == digest
    expected = FILES.rstrip(":") if answerer.startswith(FILES) else answerer
    if not same or (asset.get("answerer") != expected and not answerer.startswith("replay:")):
        what = f"by {asset.get('answerer')!r}" if same else "from another version of the mesh"
        raise OutputError(f"{target} was made {what}; --force replaces it, or choose another folder")
    return True
