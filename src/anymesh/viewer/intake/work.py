"""Articulation of a mesh in a child process that a page can follow and end.

The page's process stays responsive, can end the child at any time, and survives a crash of native code.
"""

from __future__ import annotations

import math
import threading
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any, cast

from anymesh.isolation.pool import ChildError, ChildLimits, ChildPool, Failure
from anymesh.types import Mesh

STAGES = {"load": (0.0, 0.05), "segment": (0.05, 0.5), "joints": (0.5, 0.8), "export": (0.8, 1.0)}  # shares of the work
WORDS = {
    "start": "starting",
    "load": "reading the mesh",
    "segment": "finding the parts",
    "joints": "finding how they move",
    "export": "writing the files",
}
ITEMS = ("segment", "joints")  # stages that say what they work on
CRASHED = "processing of this mesh ended unexpectedly ({}); it may need more memory than there is, or a library crashed"


@dataclass(frozen=True)
class StageState:
    """A stage of the work in words. seconds: how long it has taken, None before it begins; over: whether it is done."""

    words: str
    seconds: float | None
    over: bool


def warm_pool() -> ChildPool:
    """Return a pool whose child imports already what the work needs, so that a mesh is seen at once."""
    pool = _pool()
    pool.warm("anymesh.viewer.intake.work", "anymesh.pipeline", "anymesh.loading")
    return pool


def _pool() -> ChildPool:
    return ChildPool(1, ChildLimits(seconds=math.inf, memory=0))


class ArticulationWork:
    """One run of `articulate`.

    `mesh`: the placed mesh, once it is loaded; `error`: why it failed, in words; `done`: whether the asset is in the folder
    `out`. pool: of `warm_pool`, which ends with the work.
    """

    def __init__(self, mesh: Path, out: Path, pool: ChildPool | None = None, **options: Any) -> None:
        self.out = out
        self.mesh: Mesh | None = None
        self.error: str | None = None
        self.done = self.cancelled = False
        self.stage, self.item, self.share = "start", "", 0.0
        self._began = {"start": time.monotonic()}  # stage -> when it began [s]
        self._pool = pool or _pool()
        self._thread = threading.Thread(target=self._run, args=({"mesh": mesh, "out": out, **options},), daemon=True)
        self._thread.start()

    @property
    def over(self) -> bool:
        """Whether it ended, successfully or not."""
        return self.done or self.cancelled or self.error is not None

    @property
    def begun(self) -> bool:
        """Whether the child process has reported."""
        return self.stage != "start"

    @property
    def words(self) -> str:
        """Description of the current stage."""
        stage = WORDS.get(self.stage, self.stage)
        return f"{stage} ({self.item})" if self.item and self.stage in ITEMS else stage

    @property
    def stages(self) -> list[StageState]:
        """The stages in order, with the time that each has taken."""
        began = [self._began.get(name) for name in STAGES]
        states = []
        for k, (name, begin) in enumerate(zip(STAGES, began, strict=True)):
            end = next((b for b in began[k + 1 :] if b is not None), None)
            words = f"{WORDS[name]}: {self.item}" if self.item and name == self.stage and name in ITEMS else WORDS[name]
            seconds = None if begin is None else (end or time.monotonic()) - begin
            states.append(StageState(words, seconds, begin is not None and (end is not None or self.done)))
        return states

    def wait(self, seconds: float) -> None:
        """Wait until the work is over, at most `seconds` [s]."""
        self._thread.join(seconds)

    def cancel(self) -> None:
        """End the work immediately."""
        self.cancelled = True
        while self._thread.is_alive():  # a child may just be starting
            self._pool.close()
            self._thread.join(0.05)

    def _run(self, arguments: dict[str, Any]) -> None:
        with self._pool:
            try:
                self._pool.run("anymesh.viewer.intake.work", "articulated", arguments, on_message=self._note)
                self.share, self.done = 1.0, True
            except ChildError as error:
                if not self.cancelled:
                    self.error = _reason(error)
            except (OSError, ValueError):  # its pipe was closed while it was read
                if not self.cancelled:
                    raise

    def _note(self, *fields: Any) -> None:
        """Take a message of the child: its placed mesh, or a stage, an item, and how many of how many are done."""
        if len(fields) == 1:
            (self.mesh,) = fields
            return
        self.stage, self.item, done, total = fields
        self._began.setdefault(self.stage, time.monotonic())
        begin, end = STAGES.get(self.stage, (self.share, self.share))
        self.share = max(self.share, begin + (end - begin) * min(done / max(total, 1), 1.0))


def _reason(error: ChildError) -> str:
    detail = " ".join(error.detail.split())
    match error.failure:
        case Failure.INVALID:
            return detail
        case Failure.CRASH:
            return CRASHED.format(detail)
        case _:
            return f"internal defect, {detail[:250]}"


def articulated(report: Callable[..., None], *, mesh: Path, out: Path, parts: str = "auto", **options: Any) -> None:
    """Articulate a mesh in this process and report its progress, and the placed mesh. options: of `articulate`."""
    from anymesh.export import ExportOptions
    from anymesh.isolation import AHEAD, shared_pool
    from anymesh.pipeline.api import articulate_loaded, new_run
    from anymesh.pipeline.options import MakingOptions, PlacementOptions, divided
    from anymesh.pipeline.stages import load
    from anymesh.runtime import DEFAULT_SECONDS

    placing = {name: options.pop(name) for name in ("up", "scale", "root", "animation") if name in options}
    force, seconds = options.pop("force", False), options.pop("time_limit", DEFAULT_SECONDS)
    answering, writing = divided(cast(MakingOptions, options))
    how, placement = ExportOptions.parse(writing), PlacementOptions(**placing)
    with new_run(mesh, out, answering, force, seconds, report) as run:
        shared_pool().warm(*AHEAD)
        loaded = load(run, mesh, placement)
        report(loaded.result.mesh)
        articulate_loaded(run, loaded, parts, how, sized=placement.scale == "auto")
