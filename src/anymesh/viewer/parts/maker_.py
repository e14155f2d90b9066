"""A new part made of faces that are clicked, grown and drawn around."""

from __future__ import annotations

from typing import Any

import numpy as np

from anymesh.correcting import Correction, CorrectionError, FaceSet, MoveFaces, SplitPart, apply
from anymesh.correcting.regions import Level, Regions, faces_inside
from anymesh.types import Mesh
from anymesh.viewer.panels import Page
from anymesh.viewer.parts.card import Choosing, choosing_card
from anymesh.viewer.parts.channel_ import Outline
from anymesh.viewer.scene_ import camera_of
from anymesh.viewer.session import Hit, Session

SAME_POINT = 0.02  # of a ray's length: depth within which a point is the one that a ray hits
NONE_CHOSEN = "click on the object first, or draw around something"
LASSO = '<div id="anymesh-lasso"></div>'  # while it is on the page, a drag draws an outline


class PartMaker:
    """Faces in the making of a part, which the session holds as `chosen`."""

    def __init__(self, page: Page) -> None:
        self._page = page
        self._now: Choosing | None = None
        self._past: list[np.ndarray] = []
        self._regions: tuple[Mesh, Regions] | None = None

    @property
    def busy(self) -> bool:
        """Whether a part is in the making."""
        return self._now is not None

    def leave(self) -> bool:
        """Leave the making of a part; return whether there was one."""
        busy, self._now, self._past = self._now is not None, None, []
        return busy

    def card(self, session: Session) -> str:
        """Return its card."""
        assert self._now is not None
        parts, of = session.asset.segmentation.parts, session.asset.segmentation.face_part[session.chosen]
        counts = {p.name: int((of == k).sum()) for k, p in enumerate(parts) if (of == k).any()}
        return choosing_card(self._now, counts) + (LASSO if self._now.lasso else "")

    def choose(self, level: Level) -> None:
        """Let clicks choose regions of a level. The first region is at the last click; another level replaces that."""
        session = self._page.session
        if session is None:
            return
        self._page.play_joint(None)
        first = self._now is None or len(self._past) == 1
        self._now = Choosing(level)
        if session.face is not None and first:
            self._past = []
            self._put(session, self._region(session, session.face))
        self._page.refresh()

    def draw(self) -> None:
        """Let a drag draw an outline."""
        if self._page.session is not None:
            self._page.play_joint(None)
            now = self._now or Choosing(Level.REGION)
            self._now = Choosing(now.level, lasso=True, seen=now.seen)
            self._page.refresh()

    def toggle_seen(self) -> None:
        """Let outlines take only what is seen, or also what is behind."""
        if self._now is not None:
            self._now.seen = not self._now.seen
            self._page.refresh()

    def clicked(self, session: Session, hit: Hit, *, take_back: bool) -> None:
        """Choose the region at a click; a click on a chosen one takes it back."""
        session.face = hit.face
        chosen = bool(np.isin(hit.face, session.chosen))
        self._change(session, self._region(session, hit.face), take_back=take_back or chosen)

    def outlined(self, client: Any, outline: Outline, take_back: bool) -> None:
        """Choose the faces in an outline, as a tab shows them."""
        session = self._page.session
        if session is None or self._now is None:
            return
        faces, points, inside = faces_inside(session.displayed(), camera_of(client.camera), np.array(outline))
        if self._now.seen and len(faces):
            eye = np.array(client.camera.position, float)
            ways = points.reshape(-1, 3) - eye
            seen = session.seen(np.broadcast_to(eye, ways.shape), ways)
            there = (seen.face == np.repeat(faces, points.shape[1])) | (seen.distance > 1 + SAME_POINT)
            faces = faces[(there.reshape(inside.shape) & inside).any(1)]
        self._change(session, faces, take_back=take_back)

    def grow(self) -> None:
        """Add the rest of the regions, then of the pieces, then what touches them."""
        session = self._page.session
        if session is not None and self._now is not None:
            if not len(session.chosen):
                raise CorrectionError(NONE_CHOSEN)
            self._put(session, self._of(session.asset.mesh).grown(session.chosen, session.asset.segmentation.face_part))

    def back(self) -> None:
        """Take back the last choice."""
        session = self._page.session
        if session is not None and self._now is not None and self._past:
            self._set(session, self._past.pop())

    def make(self) -> str:
        """Make the chosen faces a part in one step, and select it. Return its name."""
        session = self._page.session
        if session is None or not len(session.chosen):
            raise CorrectionError(NONE_CHOSEN)
        chosen, segmentation = session.chosen, session.asset.segmentation
        of = segmentation.face_part[chosen]
        most = int(np.bincount(of).argmax())
        steps: list[Correction] = [SplitPart(segmentation.parts[most].name, FaceSet.of(chosen[of == most]), "part")]
        name = apply(session.asset, steps[0]).segmentation.parts[-1].name
        if (of != most).any():
            steps.append(MoveFaces(FaceSet.of(chosen[of != most]), name))
        session.correct(*steps)
        self.leave()
        session.selected = name
        return name

    def _region(self, session: Session, face: int) -> np.ndarray:
        assert self._now is not None
        return self._of(session.asset.mesh).of(face, self._now.level, session.asset.segmentation.face_part)

    def _of(self, mesh: Mesh) -> Regions:
        if self._regions is None or self._regions[0] is not mesh:
            self._regions = (mesh, Regions(mesh))
        return self._regions[1]

    def _change(self, session: Session, faces: np.ndarray, *, take_back: bool) -> None:
        self._put(session, np.setdiff1d(session.chosen, faces) if take_back else np.union1d(session.chosen, faces))

    def _put(self, session: Session, chosen: np.ndarray) -> None:
        self._past.append(session.chosen)
        self._set(session, chosen)

    def _set(self, session: Session, chosen: np.ndarray) -> None:
        session.chosen = chosen.astype(np.int64)
        self._page.refresh()
