"""A person at work on one asset: what is selected, previewed, corrected and saved. No page here; every tab shares one."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from jaxtyping import Float, Int

from anymesh.correcting import (
    ChooseMotion,
    Correction,
    CorrectionError,
    History,
    HistoryEntry,
    Opened,
    apply,
    open_asset,
    ranked_motions,
    save_asset,
)
from anymesh.correcting.motions import Ready, made_ready
from anymesh.geometry.kinematics import link_transforms
from anymesh.rendering.raycast_ import RayScene
from anymesh.types import Asset, Joint, Segmentation
from anymesh.viewer.scene import apart

Clock = Callable[[], str]  # the time now, ISO 8601


@dataclass(frozen=True, eq=False)
class Hit:
    """What a ray met: a face, its part's number, and the point on it [m] where that is at rest."""

    face: int
    part: int
    point: Float[np.ndarray, " 3"]


def part_poses(asset: Asset, positions: Mapping[str, float], explode: float) -> dict[str, Float[np.ndarray, "4 4"]]:
    """Part name -> where it is shown, from rest; explode: 0 in place .. 1 apart."""
    found = link_transforms(asset, positions)
    for name, off in (apart(asset) if explode else {}).items():
        found[name][:3, 3] += explode * off
    return found


class Session:
    """An asset opened by someone. positions: joint name -> [rad or m]; chosen: faces picked for a move or a split."""

    def __init__(self, folder: Path, author: str, clock: Clock) -> None:
        self._opened: Opened = open_asset(folder)
        self._saved: tuple[HistoryEntry, ...] = self._opened.history.done
        self._author, self._clock = author, clock
        self.selected: str | None = None
        self.preview: Correction | None = None
        self.positions: dict[str, float] = {}
        self.explode = 0.0
        self.chosen: Int[np.ndarray, " n"] = np.zeros(0, np.int64)
        self._ready: tuple[Segmentation, Ready] | None = None
        self._scenes: tuple[Segmentation, list[RayScene]] | None = None

    @property
    def folder(self) -> Path:
        return self._opened.folder

    @property
    def history(self) -> History:
        return self._opened.history

    @property
    def asset(self) -> Asset:
        """The asset as corrected so far."""
        return self.history.asset

    @property
    def shown(self) -> Asset:
        """The asset with the correction that is only previewed."""
        return self.asset if self.preview is None else apply(self.asset, self.preview)

    @property
    def unsaved(self) -> bool:
        """Whether a save would change anything."""
        return self.history.done != self._saved

    def joint(self) -> Joint | None:
        """The joint that carries the selected part, as it is (not as previewed)."""
        return next((j for j in self.asset.joints if j.child == self.selected), None)

    def correct(self, correction: Correction) -> None:
        """Makes a correction. CorrectionError when it makes no sense; then nothing changes."""
        self._go(self.history.do(HistoryEntry(correction, self._clock(), self._author)))

    def undo(self) -> None:
        self._go(self.history.undo())

    def redo(self) -> None:
        self._go(self.history.redo())

    def save(self) -> None:
        """Writes the asset again with its corrections. StaleError when somebody else saved it since."""
        self._opened = save_asset(self._opened)
        self._saved = self.history.done

    def reload(self) -> None:
        """Takes what is saved, without what is not."""
        self._opened = open_asset(self.folder)
        self._saved = self.history.done
        self._settle()

    def _go(self, history: History) -> None:
        self._opened = Opened(self._opened.folder, history, self._opened.version)
        self._settle()

    def _settle(self) -> None:
        """What no longer belongs to the asset goes."""
        self.preview, self.chosen = None, np.zeros(0, np.int64)
        if self.selected not in {p.name for p in self.asset.segmentation.parts}:
            self.selected = None
        self.positions = {j.name: self._within(j) for j in self.asset.joints}

    def _within(self, joint: Joint) -> float:
        at = self.positions.get(joint.name, 0.0)
        return at if joint.limits is None else float(np.clip(at, *joint.limits))

    def motions(self) -> tuple[ChooseMotion, ...]:
        """The ranked free motions of the selected part. CorrectionError for the root, or when nothing is selected."""
        if self.selected is None:
            raise CorrectionError("select a part first")
        if self._ready is None or self._ready[0] is not self.asset.segmentation:
            self._ready = (self.asset.segmentation, made_ready(self.asset))
        return ranked_motions(self.asset, self.selected, ready=self._ready[1])

    def hit(self, origin: Float[np.ndarray, " 3"], direction: Float[np.ndarray, " 3"]) -> Hit | None:
        """What a ray meets first, in the pose and the exploded view that are shown; None for nothing."""
        return self.hits(origin[None], direction[None])[0]

    def hits(self, origins: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "n 3"]) -> list[Hit | None]:
        """As `hit`, of many rays."""
        nearest = np.full(len(origins), np.inf)
        what: list[Hit | None] = [None] * len(origins)
        poses = part_poses(self.asset, self.positions, self.explode)
        for number, scene in enumerate(self._parts_to_hit()):
            back = np.linalg.inv(poses[self.asset.segmentation.parts[number].name])
            start, way = origins @ back[:3, :3].T + back[:3, 3], directions @ back[:3, :3].T
            seen = scene.first_hit(start, way)
            faces = self.asset.segmentation.faces(number)
            for k in np.flatnonzero(seen.distance < nearest):
                nearest[k] = seen.distance[k]
                what[k] = Hit(int(faces[seen.face[k]]), number, start[k] + seen.distance[k] * way[k])
        return what

    def _parts_to_hit(self) -> list[RayScene]:
        segmentation, mesh = self.asset.segmentation, self.asset.mesh
        if self._scenes is None or self._scenes[0] is not segmentation:
            pieces = [mesh.subset(segmentation.faces(k)) for k in range(len(segmentation.parts))]
            self._scenes = (segmentation, [RayScene(p.vertices, p.faces) for p in pieces])
        return self._scenes[1]
