"""The card of the selected part above the tabs of the live page: how it moves, how else it may move, and new parts."""

from __future__ import annotations

import logging
import threading
from collections.abc import Callable
from dataclasses import replace
from typing import Any, Protocol, runtime_checkable

import numpy as np

from anymesh.correcting import (
    ChooseMotion,
    Confirm,
    Correction,
    CorrectionError,
    FlipSign,
    RemovePart,
    apply,
    ranked_motions,
    same_for_copies,
)
from anymesh.correcting.motions import told_apart
from anymesh.correcting.regions import Level
from anymesh.errors import AnymeshError
from anymesh.types import Asset
from anymesh.viewer.panels import Page
from anymesh.viewer.parts.card import BY_PERSON, ShownMotions, nothing_selected, part_card, same_motion
from anymesh.viewer.parts.channel_ import PageMessages
from anymesh.viewer.parts.maker_ import PartMaker
from anymesh.viewer.parts.pictures import MotionPictures
from anymesh.viewer.session import Hit, Session

log = logging.getLogger("anymesh")
COLUMNS = 3  # of the pictures
SAME_PLACE = 0.01  # share of the object's diagonal: distance of hinge lines of copies that move alike


@runtime_checkable
class Tool(Protocol):
    """A tool that takes clicks on the mesh, such as the snapping of an axis."""

    def takes(self, hit: Hit | None) -> bool:
        """Handle a click if the tool is in use; return whether it was."""
        ...


class PartPanel:
    """The card, with its keys. Motions are searched for in a thread; what arrives for another state is dropped."""

    def __init__(self, page: Page) -> None:
        self._page, self._maker = page, PartMaker(page)
        self.html = page.gui.add_html("")
        self._tool: Tool | None = None
        self._about: tuple[Asset, str | None] | None = None  # what was searched for
        self._shown: ShownMotions | None = None
        self._at: int | None = None  # the motion shown
        self._made: str | None = None  # a new part that gets its likeliest motion once it is found
        self._searching, self._ended = threading.Lock(), False
        scene = page.server.scene
        scene.on_click()(lambda event: page.act(lambda: self._clicked(event, take_back=False)))
        scene.on_click(modifier="shift")(lambda event: page.act(lambda: self._clicked(event, take_back=True)))
        for label, key, what in self._keys():
            page.key(label, key, what)

    def _keys(self) -> tuple[tuple[str, str, Callable[[], None]], ...]:
        maker = self._maker
        return (
            ("Show the next motion", "arrowright", lambda: self._step(1)),
            ("Show the motion before", "arrowleft", lambda: self._step(-1)),
            ("Show the motion below", "arrowdown", lambda: self._step(COLUMNS)),
            ("Show the motion above", "arrowup", lambda: self._step(-COLUMNS)),
            ("Take the motion, or make the part", "enter", lambda: self._make() if maker.busy else self._take()),
            ("Grow the new part", "G", maker.grow),
            ("Take back the last choice", "backspace", maker.back),
            ("New part by a click", "N", lambda: maker.choose(Level.REGION)),
            ("New part by an outline", "L", maker.draw),
        )

    def add_channel(self) -> None:
        """Add the hidden field of the page's script, at the end of the page."""
        PageMessages(self._page.gui, self._page.act, self._say, self._maker.outlined)

    def use(self, tool: Tool) -> None:
        """Offer clicks on the mesh to a tool first."""
        self._tool = tool

    def close(self) -> None:
        """Wait for the search to end."""
        self._ended = True
        with self._searching:
            pass

    @property
    def browsing(self) -> bool:
        """Whether motions are shown, so that arrow keys go through them."""
        return self._page.session is not None and not self._maker.busy and bool(self._shown and self._shown.joints)

    def leave(self) -> bool:
        """Leave the making of a new part; return whether there was one."""
        return self._maker.leave()

    def refresh(self, session: Session) -> None:
        """Show the card for the selection, and search for its motions."""
        if not self._is_about(session.asset, session.selected):
            self._about, self._shown = (session.asset, session.selected), None
            self._made = self._made if self._made == session.selected else None
            if session.joint() is not None:
                threading.Thread(target=self._search, args=(session, *self._about), daemon=True).start()
        self._at = None if session.preview is None else self._at
        self._show_card(session)

    def _show_card(self, session: Session) -> None:
        if self._maker.busy:
            content = self._maker.card(session)
        elif session.selected is None:
            content = nothing_selected(session.asset, session.proposals)
        else:
            content = part_card(session.asset, session.selected, self._shown, self._at, session.proposals)
        if self.html.content != content:
            self.html.content = content

    def _clicked(self, event: Any, *, take_back: bool) -> None:
        session = self._page.session
        if session is None:
            return
        hit = session.hit(np.array(event.ray_origin), np.array(event.ray_direction))
        if self._tool is not None and self._tool.takes(hit):
            return
        if not self._maker.busy:
            session.face = None if hit is None else hit.face
            self._page.select(None if hit is None else session.asset.segmentation.parts[hit.part].name)
        elif hit is not None:
            self._maker.clicked(session, hit, take_back=take_back)

    def _search(self, session: Session, asset: Asset, part: str) -> None:
        """Find the motions of a part, then what its copies need; in a thread."""
        with self._searching:
            try:
                if self._is_about(asset, part):
                    motions = _motions(session, asset, part)
                    self._page.act(lambda: self._take_motions(asset, part, motions))
                if self._is_about(asset, part):
                    copies = _copies(asset, part)
                    self._page.act(lambda: self._take_copies(asset, part, copies))
            except Exception as error:  # a bug must not leave a page that waits
                if isinstance(error, AnymeshError):
                    self._page.act(lambda error=error: self._page.show_message(str(error), bad=True))
                else:
                    log.exception("the motions of %s could not be found", part)
                self._page.act(lambda: self._take_motions(asset, part, ShownMotions()))

    def _is_about(self, asset: Asset, part: str | None) -> bool:
        about = self._about
        return not self._ended and about is not None and about[0] is asset and about[1] == part

    def _take_motions(self, asset: Asset, part: str, motions: ShownMotions) -> None:
        """Show the motions; a new part gets the likeliest one."""
        session = self._page.session
        if session is None or not self._is_about(asset, part):
            return
        self._shown = motions
        if self._made == part and motions.joints:
            self._made = None
            self._page.correct(motions.choices[0], joined=True)
            self._page.play_joint(motions.joints[0].name)
        else:
            self._show_card(session)

    def _take_copies(self, asset: Asset, part: str, copies: tuple[Correction, ...]) -> None:
        session = self._page.session
        if session is not None and self._is_about(asset, part) and self._shown is not None:
            self._shown = replace(self._shown, copies=copies)
            self._show_card(session)

    def _say(self, words: str) -> None:
        """Do what a button says."""
        verb, _, value = words.partition(" ")
        maker = self._maker
        plain = {
            "take": self._take, "copies": self._same, "make": self._make, "leave": self._cancel, "cancel": self._cancel,
            "lasso": maker.draw, "seen": maker.toggle_seen, "grow": maker.grow, "back": maker.back,
        }  # fmt: skip
        kinds = {"confirm": Confirm, "flip": FlipSign, "remove": RemovePart}
        if verb in plain:
            plain[verb]()
        elif verb in kinds:
            self._page.correct(kinds[verb](self._selected()))
        elif verb == "look":
            self._page.select(value)
        elif verb == "accept":
            self._page.correct(Confirm(value))
        elif verb == "level" and value in set(Level):
            maker.choose(Level(value))
        elif verb == "motion" and value.isdigit():
            self._show(int(value))

    def _selected(self) -> str:
        session = self._page.session
        if session is None or session.selected is None:
            raise CorrectionError("select a part first")
        return session.selected

    def _step(self, by: int) -> None:
        """Show another motion: the next ones, or those before."""
        session = self._page.session
        if session is None or self._shown is None or not self.browsing:
            return
        joints, joint = self._shown.joints, session.joint()
        now = next((k for k, other in enumerate(joints) if joint is not None and same_motion(joint, other)), None)
        at = self._at if self._at is not None else now
        start = (-1 if by > 0 else 0) if at is None else at
        self._show((start + by) % len(joints))

    def _show(self, number: int) -> None:
        """Show a motion of the selected part: it plays, and nothing is changed yet."""
        session, motions = self._page.session, self._shown
        if session is not None and motions is not None and number < len(motions.joints):
            session.preview, self._at = motions.choices[number], number
            self._page.refresh()
            self._page.play_joint(motions.joints[number].name)

    def _take(self) -> None:
        session = self._page.session
        if session is not None and session.preview is not None:
            self._page.correct(session.preview)

    def _same(self) -> None:
        """Give its copies the joint of the selected part, which is thereby called right."""
        session = self._page.session
        joint = None if session is None else session.joint()
        if joint is not None and self._shown is not None and self._shown.copies:
            own = () if joint.reason.startswith(BY_PERSON) else (Confirm(joint.child),)
            self._page.correct(*own, *self._shown.copies)
            self._page.play_joint("")

    def _make(self) -> None:
        """Make the chosen faces a part; its likeliest motion follows once it is found."""
        self._made = self._maker.make()
        self._page.refresh()

    def _cancel(self) -> None:
        session = self._page.session
        if session is not None:
            self._maker.leave()
            session.preview, session.chosen = None, np.zeros(0, np.int64)
            self._page.play_joint(None)
            self._page.refresh()


def _motions(session: Session, asset: Asset, part: str) -> ShownMotions:
    """Find the motions of a part, with words and pictures."""
    motions = ranked_motions(asset, part, ready=session.ready(asset))
    joints = tuple(next(j for j in apply(asset, m).joints if j.child == part) for m in motions)
    pictures = MotionPictures(asset, part).of(joints) if joints else []
    return ShownMotions(motions, joints, told_apart(asset, motions), tuple(pictures))


def _copies(asset: Asset, part: str) -> tuple[Correction, ...]:
    """Return what gives the copies of a part its joint, without those that have it; nothing if it has no copies."""
    try:
        steps = same_for_copies(asset, part)
    except CorrectionError:
        return ()
    kept = tuple(c for c in steps if not (isinstance(c, ChooseMotion) and _is_so(asset, c)))
    return kept if any(isinstance(c, ChooseMotion) for c in kept) else ()


def _is_so(asset: Asset, c: ChooseMotion) -> bool:
    """Return whether a part moves so already."""
    joint = next((j for j in asset.joints if j.child == c.part), None)
    if joint is None or joint.limits != c.limits:
        return False
    wanted = next(j for j in apply(asset, c).joints if j.child == c.part)
    return same_motion(joint, wanted, near=SAME_PLACE * asset.mesh.diagonal)
