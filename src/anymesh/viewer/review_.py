"""Review of many assets: the outputs in a folder, least confident first, and decisions about them (review.json)."""

from __future__ import annotations

import hashlib
import json
import os
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import StrEnum
from html import escape
from pathlib import Path
from typing import Any

from anymesh.correcting import CorrectionError
from anymesh.errors import OutputError
from anymesh.names import confidence_word
from anymesh.pipeline.atomic_folder import locked, written_files
from anymesh.runtime import read_json
from anymesh.viewer.panels import SMALL, Page, badge, joint_table, offer
from anymesh.viewer.session import Clock, Session

REVIEW = "review.json"
DEEP = 3  # maximum depth of folders that are searched for outputs
PATIENCE, PAUSE = 5.0, 0.02  # [s] to wait for another process that writes a decision
EMPTY = "none"


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
    GUESS = "guess"
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
            case Filter.GUESS:
                return confidence_word(item.confidence) == "guess"
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


COLORS = {Verdict.ACCEPTED: "#2b8a3e", Verdict.REJECTED: "#c92a2a", Verdict.CORRECT: "#b35c00"}


class ReviewPanel:
    """Review of a folder of outputs with keys: A accept, R reject, C to correct, right and left arrows."""

    def __init__(
        self, page: Page, tab: Any, folder: Path, *, reviewer: str, clock: Clock, open_: Callable[[Path], None]
    ) -> None:
        self._page, self._folder, self._reviewer, self._clock, self._open = page, folder, reviewer, clock, open_
        self._review: Review = read_review(folder)
        self._at: Item | None = None
        gui = page.gui
        with tab:
            self._status = gui.add_html("")
            self._verdict = gui.add_button_group("Verdict", ("Accept (A)", "Reject (R)", "Correct (C)"))
            self._step = gui.add_button_group("Go", ("← Before", "Next →"))
            self._filter = gui.add_dropdown("Show", tuple(Filter), initial_value=Filter.UNDECIDED)
            self._list = gui.add_dropdown("Item", (EMPTY,))
            self._why = gui.add_html("")
        verdicts = dict(zip(("Accept (A)", "Reject (R)", "Correct (C)"), Verdict, strict=True))
        self._verdict.on_click(lambda event: page.act(lambda: self._decide(verdicts[event.target.value])))
        self._step.on_click(lambda event: page.act(lambda: self._go(1 if event.target.value.startswith("Next") else -1)))
        for control, what in ((self._filter, self._filtered), (self._list, self._picked)):
            control.on_update(lambda event, what=what: page.act(what) if event.client is not None else None)
        for verdict, key in zip(Verdict, "ARC", strict=True):
            page.key(f"Verdict: {verdict}", key, lambda verdict=verdict: self._decide(verdict))
        for label, key, step in (("Next item", "arrowright", 1), ("Item before", "arrowleft", -1)):
            page.key(label, key, lambda step=step: None if page.is_browsing() else self._go(step))
        self._filtered()

    def refresh(self, session: Session) -> None:
        """Update the panel for the displayed asset, and for decisions of others."""
        self._why.content = joint_table(session.shown)
        self._show_state()

    def _labels(self) -> dict[str, Item]:
        chosen = self._review.chosen(Filter(self._filter.value))
        return {f"{k}. {item.confidence:.2f} {item.key}": item for k, item in enumerate(chosen, 1)}

    def _filtered(self) -> None:
        """Show the first item that passes the filter, unless the displayed one does."""
        self._review = read_review(self._folder)
        labels = self._labels()
        offer(self._list, tuple(labels) or (EMPTY,), next(iter(labels), EMPTY))
        keys = {item.key for item in labels.values()}
        if self._at is None or (self._at.key not in keys and keys):
            self._show(next(iter(labels.values()), self._review.items[0]))
        self._show_state()

    def _picked(self) -> None:
        item = self._labels().get(self._list.value)
        if item is not None:
            self._leave()
            self._show(item)

    def _leave(self) -> None:
        if self._page.session is not None and self._page.session.unsaved:
            self._show_state()
            raise CorrectionError("save the corrections of this one first (Ctrl-S), or undo them (Ctrl-Z)")

    def _go(self, step: int) -> None:
        items = list(self._labels().values())
        keys = [item.key for item in items]
        if not items:
            raise CorrectionError(f"no item is {self._filter.value}; choose another filter")
        self._leave()
        here = keys.index(self._at.key) if self._at is not None and self._at.key in keys else (-1 if step > 0 else 0)
        self._show(items[(here + step) % len(items)])

    def _show(self, item: Item) -> None:
        self._at = item
        self._open(item.folder)
        label = next((choice for choice, other in self._labels().items() if other.key == item.key), None)
        if label is not None:
            self._list.value = label
        self._page.play_joint("")
        if self._page.session is not None:
            self.refresh(self._page.session)

    def _decide(self, verdict: Verdict) -> None:
        """Write the verdict and show the next item, or stay if the item is to be corrected."""
        if self._at is None:
            return
        if verdict is not Verdict.CORRECT:
            self._leave()
        self._review = read_review(self._folder)
        item = next((i for i in self._review.items if i.key == self._at.key), self._at)
        before = [i.key for i in self._labels().values()]
        decide(self._folder, item.key, Decision(verdict, self._reviewer, self._clock(), item.version))
        self._review = read_review(self._folder)
        if verdict is Verdict.CORRECT:
            self._show_state()
            return
        after = list(self._labels().values())
        labels = self._labels()
        offer(self._list, tuple(labels) or (EMPTY,), next(iter(labels), EMPTY))
        behind = before[before.index(item.key) + 1 :] if item.key in before else []
        following = next((i for i in after if i.key in behind), after[0] if after else None)
        if following is not None and following.key != item.key:
            self._show(following)
        self._show_state()

    def _show_state(self) -> None:
        done = sum(self._review.standing(i) is not None for i in self._review.items)
        total = len(self._review.items)
        item = self._at and next((i for i in self._review.items if i.key == self._at.key), self._at)
        if item is None:
            return
        decision = self._review.standing(item)
        outcome = "not decided yet"
        if decision is not None:
            color = COLORS[decision.verdict]
            outcome = (
                f'<b style="color:{color}">{decision.verdict}</b> by {escape(decision.reviewer)}, {escape(decision.time[:16])}'
            )
        end = "<br><b>All are decided.</b>" if done == total else ""
        state = f"{badge(item.confidence)} <b>{escape(item.key)}</b>: {outcome}<br>{done} of {total} decided{end}"
        self._status.content = f"<div {SMALL}>{state}</div>"
