"""Session of a person with one asset: selection, preview, corrections and saving. It is shared by all tabs of a page."""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
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
from anymesh.correcting.proposals import unsure
from anymesh.geometry.kinematics import link_transforms
from anymesh.geometry.raycast_ import RayScene
from anymesh.mechanisms.following import together
from anymesh.types import Asset, Brief, Joint, Segmentation
from anymesh.viewer.scene import apart

Clock = Callable[[], str]  # the current time, ISO 8601


@dataclass(frozen=True, eq=False)
class Hit(Brief):
    """Hit of a ray: a face, the index of its part, and the point on it [m] in the rest pose."""

    face: int
    part: int
    point: Float[np.ndarray, " 3"]


def part_poses(asset: Asset, positions: Mapping[str, float], explode: float) -> dict[str, Float[np.ndarray, "4 4"]]:
    """Return part name -> displayed pose relative to rest; explode: 0 in place .. 1 apart."""
    poses = link_transforms(asset, together(asset, positions) if asset.loops else positions)
    for name, off in (apart(asset) if explode else {}).items():
        poses[name][:3, 3] += explode * off
    return poses


@dataclass(frozen=True, eq=False)
class Seen(Brief):
    """First hits of rays: face (-1 where nothing is hit), and the distance in lengths of the ray's direction."""

    face: Int[np.ndarray, " n"]
    distance: Float[np.ndarray, " n"]


class Session:
    """An open asset.

    positions, moving: joint name -> [rad or m], as set and, while they play, as displayed; chosen: faces picked for a move or a
    split; face: the one clicked last.
    """

    def __init__(self, folder: Path, author: str, clock: Clock) -> None:
        self._opened: Opened = open_asset(folder)
        self._saved: tuple[HistoryEntry, ...] = self._opened.history.done
        self._author, self._clock = author, clock
        self.selected: str | None = None
        self.preview: Correction | None = None
        self.positions: dict[str, float] = {}
        self.moving: dict[str, float] = {}
        self.explode = 0.0
        self.chosen: Int[np.ndarray, " n"] = np.zeros(0, np.int64)
        self.face: int | None = None
        self._ready: tuple[Segmentation, Ready] | None = None
        self._making_ready = threading.Lock()
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
        """The asset with the previewed correction."""
        return self.asset if self.preview is None else apply(self.asset, self.preview)

    @property
    def proposals(self) -> dict[str, float]:
        """The probability of the joints that are too unsure to be written, by their part."""
        return unsure(self.asset, self._opened.precision)

    @property
    def unsaved(self) -> bool:
        """Whether there are unsaved changes."""
        return self.history.done != self._saved

    def joint(self) -> Joint | None:
        """Return the joint that carries the selected part, without the preview."""
        return next((j for j in self.asset.joints if j.child == self.selected), None)

    def correct(self, *corrections: Correction, joined: bool = False) -> None:
        """Apply corrections as one step. Raise CorrectionError if one is not applicable; then nothing changes.

        joined: they are undone together with the step before.
        """
        history = self.history.do_all(corrections, self._clock(), self._author)
        if joined:
            first = len(self.history.done)
            done = (*history.done[:first], replace(history.done[first], joined=True), *history.done[first + 1 :])
            history = replace(history, done=done)
        self._go(history)

    def undo(self) -> None:
        self._go(self.history.undo())

    def redo(self) -> None:
        self._go(self.history.redo())

    def save(self) -> None:
        """Write the asset with its corrections. Raise StaleError if someone else saved it since."""
        self._opened = save_asset(self._opened)
        self._saved = self.history.done

    def _go(self, history: History) -> None:
        self._opened = replace(self._opened, history=history)
        self._settle()

    def _settle(self) -> None:
        """Reset state that no longer fits the asset."""
        self.preview, self.chosen, self.moving = None, np.zeros(0, np.int64), {}
        if self.selected not in {p.name for p in self.asset.segmentation.parts}:
            self.selected = None
        self.positions = {j.name: self._within(j) for j in self.asset.joints}

    def _within(self, joint: Joint) -> float:
        at = self.positions.get(joint.name, 0.0)
        return at if joint.limits is None else float(np.clip(at, *joint.span))

    def motions(self) -> tuple[ChooseMotion, ...]:
        """Return the ranked free motions of the selected part. Raise CorrectionError for the root, or without a selection."""
        if self.selected is None:
            raise CorrectionError("select a part first")
        return ranked_motions(self.asset, self.selected, ready=self.ready(self.asset))

    def ready(self, asset: Asset) -> Ready:
        """Return an asset of this session prepared for its motions; threads may ask for it at once."""
        with self._making_ready:
            if self._ready is None or self._ready[0] is not asset.segmentation:
                self._ready = (asset.segmentation, made_ready(asset))
            return self._ready[1]

    def hit(self, origin: Float[np.ndarray, " 3"], direction: Float[np.ndarray, " 3"]) -> Hit | None:
        """Return the first hit of a ray, in the displayed pose and exploded view; None if there is none."""
        return self.hits(origin[None], direction[None])[0]

    def hits(self, origins: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "n 3"]) -> list[Hit | None]:
        """Return the hits of many rays, as `hit` does."""
        seen, poses = self.seen(origins, directions), self.poses()
        what: list[Hit | None] = []
        for face, far, origin, way in zip(seen.face, seen.distance, origins, directions, strict=True):
            if face < 0:
                what.append(None)
                continue
            number = int(self.asset.segmentation.face_part[face])
            back = np.linalg.inv(poses[number])
            what.append(Hit(int(face), number, back[:3, :3] @ (origin + far * way) + back[:3, 3]))
        return what

    def poses(self) -> list[Float[np.ndarray, "4 4"]]:
        """Return the displayed pose of each part, relative to rest."""
        poses = part_poses(self.asset, {**self.positions, **self.moving}, self.explode)
        return [poses[p.name] for p in self.asset.segmentation.parts]

    def seen(self, origins: Float[np.ndarray, "n 3"], directions: Float[np.ndarray, "n 3"]) -> Seen:
        """Return what rays hit first, in the displayed pose and exploded view."""
        nearest, face = np.full(len(origins), np.inf), np.full(len(origins), -1)
        for number, (scene, pose) in enumerate(zip(self._parts_to_hit(), self.poses(), strict=True)):
            back = np.linalg.inv(pose)
            hits = scene.first_hit(origins @ back[:3, :3].T + back[:3, 3], directions @ back[:3, :3].T)
            closer = hits.distance < nearest
            nearest[closer] = hits.distance[closer]
            face[closer] = self.asset.segmentation.faces(number)[hits.face[closer]]
        return Seen(face, nearest)

    def displayed(self) -> Float[np.ndarray, "F 3 3"]:
        """Return the triangles in the displayed pose and exploded view [m]."""
        T = np.stack(self.poses())[self.asset.segmentation.face_part]
        return np.einsum("fij,fkj->fki", T[:, :3, :3], self.asset.mesh.triangles) + T[:, None, :3, 3]

    def _parts_to_hit(self) -> list[RayScene]:
        segmentation, mesh = self.asset.segmentation, self.asset.mesh
        if self._scenes is None or self._scenes[0] is not segmentation:
            pieces = [mesh.subset(segmentation.faces(k)) for k in range(len(segmentation.parts))]
            self._scenes = (segmentation, [RayScene(p.vertices, p.faces) for p in pieces])
        return self._scenes[1]
