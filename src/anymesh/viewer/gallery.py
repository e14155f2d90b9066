"""Review of many assets: the outputs in a folder, least confident first, and decisions about them (review.json)."""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from pathlib import Path
from typing import Any

from anymesh.errors import OutputError
from anymesh.pipeline.atomic_folder import locked, written_files
from anymesh.runtime import read_json

REVIEW = "review.json"
DEEP = 3  # maximum depth of folders that are searched for outputs
PATIENCE, PAUSE = 5.0, 0.02  # [s] to wait for another process that writes a decision
UNSURE = 0.4  # an item below this confidence is unsure


class Verdict(StrEnum):
    """A reviewer's verdict on an asset."""

    ACCEPTED = "accepted"
    REJECTED = "rejected"
    CORRECT = "to correct"


class Filter(StrEnum):
    """Filter of the items to review."""

    ALL = "all"
    UNDECIDED = "undecided"
    ACCEPTED = "accepted"
    REJECTED = "rejected"
    CORRECT = "to correct"
    UNSURE = "unsure"
    WARNED = "with warnings"


@dataclass(frozen=True)
class Item:
    """An output. key: its path below the folder; confidence: of its least confident part or joint, 0 if nothing moves."""

    key: str
    folder: Path
    name: str
    confidence: float
    warnings: tuple[str, ...]
    version: str  # digest of asset.json: a decision applies to one version


@dataclass(frozen=True)
class Decision:
    """A verdict with its reviewer, time (ISO 8601) and version of the asset."""

    verdict: Verdict
    reviewer: str
    time: str
    version: str


@dataclass(frozen=True)
class Review:
    """The items of a folder, least confident first, and all decisions about them, in order."""

    folder: Path
    items: tuple[Item, ...]
    decisions: dict[str, tuple[Decision, ...]]

    def standing(self, item: Item) -> Decision | None:
        """Return the last decision about an item; None if there is none or the asset has changed since."""
        last = self.decisions.get(item.key, ())[-1:]
        return last[0] if last and last[0].version == item.version else None

    def chosen(self, filter_: Filter) -> tuple[Item, ...]:
        """Return the items that pass a filter."""
        return tuple(item for item in self.items if self._matches(item, filter_))

    def _matches(self, item: Item, filter_: Filter) -> bool:
        decision = self.standing(item)
        match filter_:
            case Filter.ALL:
                return True
            case Filter.UNDECIDED:
                return decision is None
            case Filter.UNSURE:
                return item.confidence < UNSURE
            case Filter.WARNED:
                return bool(item.warnings)
            case _:
                return decision is not None and str(decision.verdict) == str(filter_)


def read_review(folder: Path) -> Review:
    """Read the outputs below a folder and the decisions beside them. Raise OutputError if there is no output."""
    folder = Path(folder).resolve()
    items = [item for path in _outputs(folder, DEEP) if (item := _item(folder, path)) is not None]
    if not items:
        raise OutputError(f"{folder} holds no output of anymesh; `anymesh articulate MESH -o {folder}/NAME` makes one")
    items.sort(key=lambda item: (item.confidence, item.key))
    return Review(folder, tuple(items), _read_decisions(folder))


def decide(folder: Path, key: str, decision: Decision) -> None:
    """Add a decision to review.json, keeping concurrent ones. Raise OutputError if it cannot be written."""
    end = time.monotonic() + PATIENCE
    while True:
        with locked(folder) as mine:
            if mine:
                decisions = _read_decisions(folder)
                decisions[key] = (*decisions.get(key, ()), decision)
                _write(folder, decisions)
                return
        if time.monotonic() > end:
            raise OutputError(f"{folder / REVIEW} is being written by another process; try again")
        time.sleep(PAUSE)


def _outputs(folder: Path, deep: int) -> Sequence[Path]:
    if written_files(folder) is not None:
        return [folder]
    below = sorted(p for p in folder.iterdir() if p.is_dir() and not p.name.startswith(".")) if deep else []
    return [asset_folder for path in below for asset_folder in _outputs(path, deep - 1)]


def _item(folder: Path, path: Path) -> Item | None:
    """Return an output as an item; None without final files."""
    record = read_json(path / "asset.json")
    if record is None:
        return None
    sure = [float(j["confidence"]) for j in record.get("joints", ())]
    sure += [float(p.get("confidence", 1.0)) for p in record.get("parts", ())[1:]] if sure else []
    digest = hashlib.sha256((path / "asset.json").read_bytes()).hexdigest()[:16]
    key = path.relative_to(folder).as_posix()
    return Item(
        key, path, str(record.get("name", path.name)), min(sure, default=0.0), tuple(record.get("warnings", ())), digest
    )


def _read_decisions(folder: Path) -> dict[str, tuple[Decision, ...]]:
    path = folder / REVIEW
    review = read_json(path)
    if review is None and path.exists():
        raise OutputError(f"{path} cannot be read; move it away to begin a new review")
    try:
        records: dict[str, list[dict[str, Any]]] = (review or {}).get("decisions", {})
        return {key: tuple(Decision(**{**d, "verdict": Verdict(d["verdict"])}) for d in made) for key, made in records.items()}
    except (TypeError, ValueError, KeyError, AttributeError) as error:
        raise OutputError(f"{path} is not a review ({error}); move it away to begin a new one") from error


def _write(folder: Path, decisions: dict[str, tuple[Decision, ...]]) -> None:
    records = {key: [{**vars(d), "verdict": str(d.verdict)} for d in made] for key, made in sorted(decisions.items())}
    new = folder / f".{REVIEW}.{os.getpid()}"
    try:
        new.write_text(json.dumps({"decisions": records}, indent=1) + "\n", encoding="ascii", newline="\n")
        new.replace(folder / REVIEW)
    except OSError as error:
        raise OutputError(f"cannot write {folder / REVIEW}: {error.strerror or error}") from error
    finally:
        new.unlink(missing_ok=True)
