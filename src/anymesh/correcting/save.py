"""Opening of an output for corrections, and atomic saving that never overwrites someone else's changes."""

from __future__ import annotations

from dataclasses import dataclass, replace
from pathlib import Path

from anymesh.correcting.history import History
from anymesh.correcting.log import pack_log, unpack_log
from anymesh.errors import OutputError
from anymesh.export import write_asset
from anymesh.export.formats import ExportOptions
from anymesh.pipeline.results import CorrectionResult
from anymesh.pipeline.storage.atomic_folder import locked
from anymesh.pipeline.storage.outputs import CORRECTIONS
from anymesh.pipeline.storage.packing import CORRECTION
from anymesh.pipeline.storage.run_folder import RunFolder
from anymesh.pipeline.storage.saved import Saved
from anymesh.pipeline.storage.stage_files import stage_key
from anymesh.rendering.preview import write_preview
from anymesh.runtime import cache_folder, read_json, write_json


class StaleError(OutputError):
    """The asset was saved by another process after it was opened; saving now would lose its changes."""


@dataclass(frozen=True, eq=False)
class Opened:
    """An asset under correction. version: of the saved state on which its history is based."""

    folder: Path
    history: History
    version: str


def open_asset(folder: str | Path) -> Opened:
    """Open an output with its corrections. Raise OutputError if the folder is not an output, or lacks a stage."""
    saved = Saved.at(Path(folder))
    version = saved.last_key()
    log = unpack_log(saved.corrections(saved.editing()))
    return Opened(saved.target, History.of(saved.asset(edited=False), log), version)


def save_asset(opened: Opened) -> Opened:
    """Save the corrections and write all files again; earlier stages are kept, so that the original stays available.

    Raise StaleError if another process saved, or is saving, this asset since it was opened; then nothing is written.
    """
    with locked(opened.folder) as mine:
        if not mine:
            raise StaleError(f"{opened.folder} is being saved by another process; try again")
        with RunFolder.revise(opened.folder) as run:
            if run.last_key() != opened.version:
                raise StaleError(f"{opened.folder} was saved by someone else since it was opened; open it again to continue")
            _write(run, opened.history)
            version = run.last_key()
    return replace(opened, version=version)


def _write(run: RunFolder, history: History) -> None:
    stage, log, asset = run.editing(), pack_log(history.done), history.asset
    key = stage_key(stage, previous=run.last_key(edited=False), config={"log": log})
    run.save(stage, key, CorrectionResult(asset.segmentation, asset.joints, asset.warnings, tuple(log)))
    with run.timed("export"):
        how = ExportOptions.of(read_json(run.target / "asset.json") or {})
        cache = cache_folder("shapes")
        write_asset(run.asset(), run.folder, base=how.base, formats=how.formats, driven=how.driven, cache=cache)
        write_preview(asset, run.folder / "preview.png")
    before = () if stage is CORRECTION else run.corrections(CORRECTION)
    write_json(run.folder / CORRECTIONS, {"asset": asset.name, "corrections": [*before, *log]})
