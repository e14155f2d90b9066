"""Many meshes in one run: what stops one object, a question or a fault, does not stop the others."""

from __future__ import annotations

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from anymesh import pipeline
from anymesh.answering import FILES
from anymesh.errors import AnymeshError, BudgetError, InputError, MissingExtraError, OpenQuestionError, OptionError, OutputError
from anymesh.loading.checks import FORMATS
from anymesh.models.budget import Spent
from anymesh.models.question_files import NAME
from anymesh.progress import Progress, silent
from anymesh.storage.stage_files import read_json

ENDING = (BudgetError, MissingExtraError, OptionError)  # would come up again for every other object


@dataclass(frozen=True)
class MeshOutcome:
    """What became of one mesh. error: what stopped it, None when its asset is written."""

    mesh: Path
    out: Path
    error: AnymeshError | None = None

    @property
    def state(self) -> str:
        """done, open (a question waits) or failed."""
        if self.error is None:
            return "done"
        return "open" if isinstance(self.error, OpenQuestionError) else "failed"


def articulate_many(
    meshes: Sequence[str | Path], out: str | Path, *, progress: Progress = silent, **options: Any
) -> list[MeshOutcome]:
    """Articulate each mesh into a folder of its own name in `out`; outputs that are there for the same mesh stay.

    meshes: files, or folders with files; options: as for `articulate`. With `files:FOLDER`, the questions of an object lie in
    the folder of its name in FOLDER. Raises OptionError for meshes that cannot be told apart by name, BudgetError when the
    budget of all is spent.
    """
    found = mesh_files(meshes)
    answerer, spent = str(options.pop("answerer", "geometry")), Spent()
    outcomes = []
    for number, (name, path) in enumerate(found.items()):
        progress("batch", name, number, len(found))
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
    """Find the mesh files by name, those directly in a folder included. Raises InputError, OptionError."""
    found: dict[str, Path] = {}
    for given in map(Path, meshes):
        inside = sorted(p for p in given.iterdir() if p.suffix.lower() in FORMATS) if given.is_dir() else [given]
        if not inside:
            raise InputError(f"{given} holds no mesh; valid are files with {', '.join(FORMATS)}")
        for path in inside:
            if path.stem in found and found[path.stem] != path:
                raise OptionError(f"--batch tells objects apart by name, and {found[path.stem]} and {path} have the same")
            found[path.stem] = path
    return found


def _is_done(mesh: Path, target: Path, answerer: str, *, force: bool) -> bool:
    """Tell whether the asset is there. Raises OutputError when it was made from another mesh or by another answerer."""
    asset = None if force else read_json(target / "asset.json")
    if asset is None:
        return False
    try:
        digest = hashlib.sha256(mesh.read_bytes()).hexdigest()
    except OSError as error:
        raise InputError(f"cannot read {mesh}: {error.strerror or error}") from error
    same = asset.get("source", {}).get("sha256") == digest
    expected = NAME if answerer.startswith(FILES) else answerer
    if not same or (asset.get("answerer") != expected and not answerer.startswith("replay:")):
        what = f"by {asset.get('answerer')!r}" if same else "from another version of the mesh"
        raise OutputError(f"{target} was made {what}; --force makes it anew, or choose another folder")
    return True
