"""The tab "Review" of the live page: verdicts on one output after the other, by keys."""

from __future__ import annotations

from collections.abc import Callable
from html import escape
from pathlib import Path
from typing import Any

from anymesh.correcting import CorrectionError
from anymesh.viewer.gallery import Decision, Filter, Item, Review, Verdict, decide, read_review
from anymesh.viewer.live import Clock, Session
from anymesh.viewer.panels import SMALL, badge, joint_table
from anymesh.viewer.panels_page import Page, offer

COLORS = {Verdict.ACCEPTED: "#2b8a3e", Verdict.REJECTED: "#c92a2a", Verdict.CORRECT: "#b35c00"}
EMPTY = "none"


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
        page.key("Next item", "arrowright", lambda: self._go(1))
        page.key("Item before", "arrowleft", lambda: self._go(-1))
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
